use super::super::correct::tests::{of_union, run, scattered};
use super::super::{MassOptions, correct};
use super::*;

#[test]
fn what_is_placed_is_what_would_be_found_there() {
    let spheres = scattered(40, 0.0);
    let body = of_union(&spheres, 2.0);
    let masses = correct(&spheres, &body, &MassOptions::default(), &run()).unwrap();
    let q = random_orientations(7, 5).unwrap();
    for (i, scale) in [1.0, 0.5, 3.0, 1e-3, 40.0].into_iter().enumerate() {
        let t = Vec3::new(0.3, -2.0, 5.0) * scale;
        let place = Placement { scale, rotation: q[i], translation: t };
        let density = 2.0 + i as f64;
        let there = place.spheres(&spheres).unwrap();
        let (moved, found) = (place.body(&body, density).unwrap(), of_union(&there, density));
        assert!((moved.mass / found.mass - 1.0).abs() < 1e-9);
        assert!((moved.volume / found.volume - 1.0).abs() < 1e-9);
        assert!((moved.center - found.center).norm() < 1e-9 * scale);
        let size = found.principal.moments[2];
        for (a, b) in moved.inertia.to_array().iter().zip(found.inertia.to_array()) {
            assert!((a - b).abs() < 1e-9 * size);
        }
        for k in 0..3 {
            let along = moved.principal.axes.column(k).dot(&found.principal.axes.column(k));
            assert!((along.abs() - 1.0).abs() < 1e-8);
        }
        let [w, x, y, z] = moved.principal.quaternion;
        let back = UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
        let apart = back.to_rotation_matrix().into_inner() - moved.principal.axes;
        assert!(w >= 0.0 && apart.abs().max() < 1e-14);
        // Masses go along: they are those of the body there.
        let m = place.masses(&masses.masses, 2.0, density).unwrap();
        let again = correct(&there, &moved, &MassOptions::default(), &run()).unwrap();
        for (a, b) in m.iter().zip(&again.masses) {
            assert!((a / b - 1.0).abs() < 1e-7, "{a} {b}");
        }
    }
    let same = Placement::default();
    assert_eq!(same.spheres(&spheres).unwrap(), spheres);
    assert_eq!(same.body(&body, 2.0).unwrap().mass, body.mass);
}

#[test]
fn placements_that_are_none_are_refused() {
    let spheres = scattered(3, 0.0);
    let body = of_union(&spheres, 1.0);
    let refused = |p: Placement, text: &str| {
        for e in [p.spheres(&spheres).err(), p.body(&body, 1.0).err()] {
            assert_eq!(e.unwrap().to_string(), text);
        }
    };
    let plain = Placement::default();
    refused(Placement { scale: 0.0, ..plain }, "the scale is 0, not above 0");
    refused(Placement { scale: f64::NAN, ..plain }, "the placement holds NaN");
    refused(Placement { rotation: [0.0; 4], ..plain }, "the quaternion of the rotation is 0");
    let far = Placement { translation: Vec3::new(f64::INFINITY, 0.0, 0.0), ..plain };
    refused(far, "the placement holds inf");
    let e = plain.body(&body, -1.0).unwrap_err();
    assert_eq!(e.to_string(), "the density is -1, not a number above 0");
    for scale in [1e-200, 1e200] {
        let p = Placement { scale, ..plain };
        assert!(matches!(p.body(&body, 1.0), Err(Error::InvalidArgument(_))));
    }
    // A quaternion of any length is the same rotation.
    let long = Placement { rotation: [3e200, 0.0, 0.0, 3e200], ..plain };
    let half = 0.5f64.sqrt();
    let short = Placement { rotation: [half, 0.0, 0.0, half], ..plain };
    for (a, b) in long.spheres(&spheres).unwrap().iter().zip(short.spheres(&spheres).unwrap()) {
        assert!((a.center - b.center).norm() < 1e-15);
    }
}

#[test]
fn orientations_have_no_preferred_way() {
    let q = random_orientations(3, 20_000).unwrap();
    assert_eq!(random_orientations(3, 10).unwrap(), q[..10]);
    assert_ne!(random_orientations(4, 10).unwrap(), q[..10]);
    let mut mean = Matrix3::zeros();
    let mut second = nalgebra::Matrix4::zeros();
    for [w, x, y, z] in q {
        let r = Quaternion::new(w, x, y, z);
        assert!(w >= 0.0 && (r.norm() - 1.0).abs() < 1e-12);
        mean += UnitQuaternion::new_unchecked(r).to_rotation_matrix().into_inner() / 20_000.0;
        let v = nalgebra::Vector4::new(w, x, y, z);
        second += v * v.transpose() / 20_000.0;
    }
    assert!(mean.abs().max() < 0.02, "{mean}");
    // On the sphere in four dimensions no direction is preferred.
    assert!((second - nalgebra::Matrix4::identity() * 0.25).abs().max() < 0.01, "{second}");
}
