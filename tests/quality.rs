//! Quality of clumps against formulas.

#![allow(clippy::unwrap_used)]

mod common;

use common::{cuboid, join, turned};
use morula::math::{Sphere, Vec3};
use morula::measure::{Quality, QualityOptions, quality};
use morula::shape::{ImportOptions, Primitive};
use morula::solid::SolidOptions;
use morula::{Error, Run, Shape, Solid};
use std::f64::consts::PI;

fn solid(primitive: Primitive, segments: usize) -> Solid {
    let run = Run::serial();
    let shape =
        Shape::from_primitive(&primitive, segments, &ImportOptions::default(), &run).unwrap();
    Solid::new(&shape, &SolidOptions::default(), &run).unwrap()
}

fn sphere(c: [f64; 3], r: f64) -> Sphere {
    Sphere::new(Vec3::from(c), r)
}

fn measure(solid: &Solid, spheres: &[Sphere], columns: usize) -> Quality {
    let options = QualityOptions { columns, ..QualityOptions::default() };
    quality(solid, spheres, &options, &Run::new(2).unwrap()).unwrap()
}

#[test]
fn a_sphere_in_a_box() {
    let cube = solid(Primitive::Box { edges: [2.0, 2.0, 2.0] }, 8);
    for r in [0.8, 1.0, 1.3] {
        let q = measure(&cube, &[sphere([0.0; 3], r)], 128);
        let v = 4.0 / 3.0 * PI * r * r * r;
        // Caps beyond the six faces (they do not meet for r < √2).
        let h = (r - 1.0f64).max(0.0);
        let out = 6.0 * PI * h * h * (3.0 * r - h) / 3.0;
        let d = 1.0 - 2.0 * (v - out) / (8.0 + v);
        assert!((q.mismatch - d).abs() <= q.error_bound && q.error_bound < 2e-3);
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-3, "{x} {y} at r = {r}");
        close(q.coverage, (v - out) / 8.0);
        close(q.overshoot, out / 8.0);
        close(q.iou, (v - out) / (8.0 + out));
        close(q.eta, (8.0 - v + 2.0 * out) / 8.0);
        close(q.target_volume, 8.0);
        close(q.union_volume / v, 1.0);
        close(q.volume_error, v / 8.0 - 1.0);
        close(q.centroid_error, 0.0);
        for m in q.moment_errors {
            close(m, 0.4 * v * r * r / (8.0 * 4.0 / 6.0) - 1.0);
        }
        // Lengths to the tolerances of the search: 1e-4 of the edge, or 1 %.
        assert!((q.protrusion - h).abs() < 3e-4, "{} {h}", q.protrusion);
        let corner = 3f64.sqrt() - r;
        let hausdorff = corner.max(h);
        assert!((q.hausdorff / hausdorff - 1.0).abs() < 0.011, "{} {hausdorff}", q.hausdorff);
        assert!(q.rms_distance > 0.0 && q.rms_distance < q.hausdorff);
        assert!((q.exposed_areas[0] - 4.0 * PI * r * r).abs() < 1e-9);
        assert_eq!((q.never_exposed, q.exposed_areas.len()), (0, 1));
    }
}

#[test]
fn a_sphere_against_itself_and_its_neighbours() {
    let target = solid(Primitive::Sphere { radius: 3.0 }, 96);
    let q = measure(&target, &[sphere([0.0; 3], 3.0)], 128);
    assert!(q.mismatch < 2e-3 && q.rms_distance < 6e-3 && q.roughness < 0.03, "{q:?}");
    // Concentric: every distance is the difference of the radii.
    let q = measure(&target, &[sphere([0.0; 3], 2.5)], 128);
    assert!((q.rms_distance - 0.5).abs() < 0.01 && (q.hausdorff - 0.5).abs() < 0.01, "{q:?}");
    assert_eq!(q.protrusion, 0.0);
    // Shifted by 0.7: it reaches 0.7 beyond.
    let q = measure(&target, &[sphere([0.7, 0.0, 0.0], 3.0)], 128);
    assert!((q.protrusion - 0.7).abs() < 5e-3 && (q.hausdorff - 0.7).abs() < 8e-3, "{q:?}");
    let centroid = 0.7 / 6.0;
    assert!((q.centroid_error - centroid).abs() < 1e-3);
    // A lens with the target.
    let d: f64 = 0.7;
    let lens = PI * (6.0 - d).powi(2) * (d * d + 12.0 * d) / (12.0 * d);
    let exact = 1.0 - 2.0 * lens / (2.0 * 36.0 * PI);
    assert!((q.mismatch - exact).abs() < q.error_bound + 1e-3, "{} {exact}", q.mismatch);
}

#[test]
fn protrusion_misses_no_sphere() {
    // Twenty spheres inside and one that just reaches out: samples would hardly meet it.
    let cube = solid(Primitive::Box { edges: [1.0, 1.0, 1.0] }, 8);
    let mut spheres: Vec<Sphere> = (0..20)
        .map(|i| {
            let t = f64::from(i);
            let c = [0.37, 0.61, 0.83].map(|g| 0.6 * ((t * g).fract() - 0.5));
            sphere(c, 0.15)
        })
        .collect();
    spheres.push(sphere([0.497, 0.1, 0.2], 0.005));
    let q = measure(&cube, &spheres, 64);
    assert!((q.protrusion - 0.002).abs() < 1.1e-4, "{}", q.protrusion);
}

#[test]
fn a_ball_that_fills_a_cavity_protrudes() {
    let cavity = turned(cuboid([0.4, -0.3, -0.3], [1.0, 0.3, 0.3]));
    let mesh = join(&[cuboid([-2.0; 3], [2.0; 3]), cavity]);
    let run = Run::serial();
    let shape = Shape::from_mesh(&mesh.0, &mesh.1, &ImportOptions::default(), &run).unwrap();
    let hollow = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    // Centre and whole surface in the material; only the cavity's middle tells.
    let q = measure(&hollow, &[sphere([0.0; 3], 1.5)], 64);
    let lacks = 0.3 - q.protrusion;
    assert!((-1e-9..=q.distance_bound + 1e-9).contains(&lacks), "{} {}", lacks, q.distance_bound);
    let diameter = (6.0 / PI * (64.0 - 0.216f64)).cbrt();
    assert!(q.distance_bound < 0.005 * diameter, "{}", q.distance_bound);
    // A ball beside the cavity stays in.
    assert_eq!(measure(&hollow, &[sphere([-0.9, 0.0, 0.0], 1.0)], 64).protrusion, 0.0);
}

#[test]
fn a_ball_in_the_hole_of_a_torus() {
    let (major, minor) = (1.0, 0.3);
    let ring = solid(Primitive::Torus { major, minor }, 96);
    for r in [0.5f64, 0.8] {
        let q = measure(&ring, &[sphere([0.0; 3], r)], 64);
        // Farthest are the poles; the middle of the hole comes second.
        let poles = (major * major + r * r).sqrt() - minor;
        assert!((q.protrusion / poles - 1.0).abs() < 3e-3, "{} {poles}", q.protrusion);
    }
}

/// How near the greatest distances are known does not grow with the number of spheres.
#[test]
fn the_distance_bound_stays_small() {
    let target = solid(Primitive::Ellipsoid { axes: [1.0, 0.8, 0.5] }, 32);
    let diameter = 2.0 * (0.4f64).cbrt();
    for n in [40u32, 400] {
        // On the surface of a smaller ellipsoid, so that all lies about as far away.
        let spheres: Vec<Sphere> = (0..n)
            .map(|i| {
                let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(n);
                let (s, t) = ((1.0 - z * z).sqrt(), 2.399_963 * f64::from(i));
                sphere([0.71 * s * t.cos(), 0.51 * s * t.sin(), 0.21 * z], 0.28)
            })
            .collect();
        let q = measure(&target, &spheres, 64);
        assert!(q.distance_bound <= 0.005 * diameter, "{n}: {}", q.distance_bound);
    }
}

#[test]
fn scaling_by_two_changes_no_bit() {
    let spheres = [sphere([0.1, 0.2, -0.3], 0.7), sphere([-0.4, 0.1, 0.2], 0.6)];
    let of = |s: f64| {
        let edges = [1.5, 1.7, 1.9].map(|e| e * s);
        let spheres: Vec<Sphere> =
            spheres.iter().map(|x| Sphere::new(x.center * s, x.radius * s)).collect();
        measure(&solid(Primitive::Box { edges }, 8), &spheres, 64)
    };
    let (x, y) = (of(1.0), of(2f64.powi(-20)));
    assert_eq!(x.mismatch.to_bits(), y.mismatch.to_bits());
    assert_eq!(x.moment_errors.map(f64::to_bits), y.moment_errors.map(f64::to_bits));
    assert_eq!(x.protrusion.to_bits(), (y.protrusion * 2f64.powi(20)).to_bits());
    assert_eq!(x.rms_distance.to_bits(), (y.rms_distance * 2f64.powi(20)).to_bits());
}

#[test]
fn threads_change_no_bit() {
    let target = solid(Primitive::Ellipsoid { axes: [1.0, 0.8, 0.5] }, 32);
    let spheres: Vec<Sphere> = (0..12)
        .map(|i| {
            let t = f64::from(i);
            let c = [0.37, 0.61, 0.83].map(|g| (t * g).fract() - 0.5);
            sphere(c, 0.3 + 0.2 * (t * 0.29).fract())
        })
        .collect();
    let options = QualityOptions {
        columns: 64,
        plane_tolerances: vec![0.0, 0.1],
        ..QualityOptions::default()
    };
    let of = |n| quality(&target, &spheres, &options, &Run::new(n).unwrap()).unwrap();
    assert_eq!(of(1), of(3));
}

#[test]
fn nothing_is_measured_that_was_not_asked_for() {
    let cube = solid(Primitive::Box { edges: [1.0, 1.0, 1.0] }, 8);
    let run = Run::serial();
    let off = QualityOptions { overlap: false, surface: false, ..QualityOptions::default() };
    let spheres = [sphere([0.0; 3], 0.4)];
    assert_eq!(quality(&cube, &spheres, &off, &run).unwrap(), Quality::default());
    assert_eq!((run.counters().columns, run.counters().exact_distances), (0, 0));
    let planes = QualityOptions { plane_tolerances: vec![0.0], ..off };
    assert_eq!(quality(&cube, &spheres, &planes, &run).unwrap().plane_contacts, [1]);
    assert_eq!((run.counters().columns, run.counters().exact_distances), (0, 0));
}

#[test]
fn bad_arguments_are_named() {
    let cube = solid(Primitive::Box { edges: [1.0, 1.0, 1.0] }, 8);
    let run = Run::serial();
    let fails = |spheres: &[Sphere], options: &QualityOptions| {
        quality(&cube, spheres, options, &run).unwrap_err().to_string()
    };
    let options = QualityOptions::default();
    assert!(fails(&[], &options).contains("no sphere"));
    let one = [sphere([0.0; 3], 0.4)];
    for (bad, word) in [
        (sphere([0.0, f64::NAN, 0.0], 1.0), "sphere 1"),
        (sphere([0.0; 3], 0.0), "radius 0"),
        (sphere([0.0; 3], -1.0), "radius -1"),
        (sphere([0.0; 3], f64::INFINITY), "radius inf"),
        (sphere([1e300, 0.0, 0.0], 1.0), "sphere 1"),
    ] {
        let message = fails(&[one[0], bad], &options);
        assert!(message.contains(word), "{message}");
    }
    // So large or so far that the columns over both pass by the target.
    for bad in [sphere([0.0; 3], 1e9), sphere([1e6, 0.0, 0.0], 0.5)] {
        let error = quality(&cube, &[one[0], bad], &options, &run).unwrap_err();
        let named = error.to_string().contains("sphere 1 has radius");
        assert!(named && matches!(error, Error::InvalidArgument(_)), "{error}");
    }
    assert!(fails(&one, &QualityOptions { columns: 0, ..options.clone() }).contains("columns"));
    let negative = QualityOptions { plane_tolerances: vec![0.0, -1.0], ..options };
    assert!(fails(&one, &negative).contains("tolerance 1"));
}
