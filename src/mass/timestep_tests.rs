use super::super::correct::tests::{ellipsoid, of_union, scattered};
use super::*;
use nalgebra::Matrix3;

fn spring(k: f64, contacts: u32) -> ContactOptions {
    ContactOptions { contact: Contact::Stiffness(k), speed: 0.5, contacts }
}

fn glass(speed: f64) -> ContactOptions {
    let contact = Contact::Material { young: 7e10, poisson: 0.22 };
    ContactOptions { contact, speed, contacts: 1 }
}

/// How far a rod that stands on a spring at its end, perpendicular to it, gets from rest in many
/// steps of the leapfrog.
fn swing(mass: f64, inertia: f64, lever: f64, k: f64, step: f64) -> f64 {
    let (mut x, mut angle, mut v, mut w) = (1e-6, 0.0, 0.0, 0.0);
    let mut most = 0.0f64;
    for _ in 0..4000 {
        let force = -k * (x + lever * angle);
        v += force / mass * step;
        w += lever * force / inertia * step;
        x += v * step;
        angle += w * step;
        most = most.max((x + lever * angle).abs());
        if most > 1.0 {
            break;
        }
    }
    most
}

#[test]
fn the_clump_is_stable_up_to_its_step_and_not_beyond() {
    // A rod: the sphere at its end, pushed across it, turns it most easily.
    let body = ellipsoid(1.0, 0.2, 0.2, 2500.0);
    let spheres = [0.0, 0.5, -0.8].map(|x| Sphere::new(Vec3::new(x, 0.0, 0.0), 0.15));
    for contacts in [1, 4] {
        let found = time_step(&spheres, &[], &body, &spring(1e5, contacts)).unwrap();
        assert_eq!((found.sphere, found.stiffness, found.rayleigh), (2, 1e5, None));
        let across = body.principal.moments[2];
        let felt = 1.0 / (1.0 / body.mass + 0.64 / across);
        assert!((found.effective_mass / felt - 1.0).abs() < 1e-12);
        // Two equal clumps that meet mirror each other: each stands on a spring twice as stiff.
        let k = 2e5 * f64::from(contacts);
        assert!(swing(body.mass, across, 0.8, k, 0.99 * found.clump) < 1e-3);
        assert!(swing(body.mass, across, 0.8, k, 1.01 * found.clump) > 0.9);
    }
}

#[test]
fn a_sphere_alone_is_felt_whole() {
    let one = [Sphere::new(Vec3::zeros(), 2e-3)];
    let body = of_union(&one, 2500.0);
    let found = time_step(&one, &[body.mass], &body, &spring(1e4, 1)).unwrap();
    assert!((found.effective_mass / body.mass - 1.0).abs() < 1e-9);
    assert!((found.clump / (2.0 * body.mass / 1e4).sqrt() - 1.0).abs() < 1e-9);
    let depth = 0.5 * (0.5 * body.mass / 1e4).sqrt();
    assert!((found.overlap / (depth / 2e-3) - 1.0).abs() < 1e-9);
    // Of glass: the wave of Rayleigh, and the overlap at which the energy is used up.
    let found = time_step(&one, &[body.mass], &body, &glass(0.5)).unwrap();
    let shear = 7e10 / 2.44;
    let wave = PI * 2e-3 * (2500.0f64 / shear).sqrt() / (0.1631 * 0.22 + 0.8766);
    assert!((found.rayleigh.unwrap() / wave - 1.0).abs() < 1e-9);
    let (e, r) = (0.5 * 7e10 / (1.0 - 0.0484), 1e-3f64);
    let d = found.overlap * 2e-3;
    let work: f64 = (0..10_000)
        .map(|i| 4.0 / 3.0 * e * r.sqrt() * ((f64::from(i) + 0.5) * d / 1e4).powf(1.5) * d / 1e4)
        .sum();
    assert!((work / (0.25 * body.mass * 0.25) - 1.0).abs() < 1e-6);
    // F = 4/3 E √R δ^1.5
    let force = |d: f64| 4.0 / 3.0 * e * r.sqrt() * d.powf(1.5);
    let slope = (force(1.001 * d) - force(0.999 * d)) / (0.002 * d);
    assert!((found.stiffness / slope - 1.0).abs() < 1e-5);
}

#[test]
fn small_spheres_and_light_ones_rule_the_rayleigh_step() {
    let spheres = scattered(30, 0.0);
    let body = of_union(&spheres, 2500.0);
    let plain = time_step(&spheres, &[], &body, &glass(1.0)).unwrap();
    let least = spheres.iter().map(|s| s.radius).fold(f64::MAX, f64::min);
    let alone = [Sphere::new(Vec3::zeros(), least)];
    let same = time_step(&alone, &[], &of_union(&alone, 2500.0), &glass(1.0)).unwrap();
    assert!((plain.rayleigh.unwrap() / same.rayleigh.unwrap() - 1.0).abs() < 1e-9);
    let mut masses: Vec<f64> = spheres.iter().map(|s| 2500.0 * s.volume()).collect();
    masses[3] *= 1e-4;
    let light = time_step(&spheres, &masses, &body, &glass(1.0)).unwrap();
    assert!(light.rayleigh.unwrap() < 0.1 * plain.rayleigh.unwrap());
    // The rigid clump does not care.
    assert_eq!(light.clump, plain.clump);
    // Faster means deeper, stiffer, and so a shorter step.
    let fast = time_step(&spheres, &[], &body, &glass(4.0)).unwrap();
    assert!(fast.clump < plain.clump && fast.overlap > plain.overlap);
}

#[test]
fn contacts_that_are_none_are_refused() {
    let one = [Sphere::new(Vec3::zeros(), 1.0)];
    let body = of_union(&one, 1.0);
    let plain = glass(1.0);
    let material = |young, poisson| Contact::Material { young, poisson };
    for (options, text) in [
        (spring(0.0, 1), "the stiffness is 0, not a number above 0"),
        (spring(f64::NAN, 1), "the stiffness is NaN, not a number above 0"),
        (spring(1.0, 0), "the number of contacts is 0"),
        (glass(0.0), "the speed is 0, not a number above 0"),
        (glass(-1.0), "the speed is -1, not a number above 0"),
        (
            ContactOptions { contact: material(-1.0, 0.3), ..plain },
            "the Young's modulus is -1, not a number above 0",
        ),
        (
            ContactOptions { contact: material(1.0, 0.6), ..plain },
            "Poisson's ratio is 0.6, not between -1 and 0.5",
        ),
    ] {
        let e = time_step(&one, &[], &body, &options).unwrap_err();
        assert_eq!(e.to_string(), text);
    }
    let e = time_step(&one, &[1.0, 2.0], &body, &plain).unwrap_err();
    assert_eq!(e.to_string(), "1 spheres have 2 masses");
    let e = time_step(&one, &[-1.0], &body, &plain).unwrap_err();
    assert_eq!(e.to_string(), "mass 0 is -1, not a number above 0");
    assert!(matches!(time_step(&[], &[], &body, &plain), Err(Error::Empty(_))));
    let e = time_step(&one, &[], &body, &spring(1e308, u32::MAX));
    assert!(e.is_err() || e.unwrap().clump > 0.0);
}

#[test]
fn contacts_on_many_spheres_allow_more_than_all_at_the_worst_point() {
    // Nine spheres in a plane, a step apart, of mass 1 and moments 1, 1, 2.
    let at = |i: usize| i as f64 - 1.0;
    let spheres: Vec<Sphere> =
        (0..9).map(|i| Sphere::new(Vec3::new(at(i % 3), at(i / 3), 0.0), 0.6)).collect();
    let moments = [1.0, 1.0, 2.0];
    let body = Body {
        mass: 1.0,
        inertia: crate::math::Inertia { xx: 1.0, yy: 1.0, zz: 2.0, ..Default::default() },
        principal: crate::math::PrincipalFrame {
            moments,
            axes: Matrix3::identity(),
            quaternion: [1.0, 0.0, 0.0, 0.0],
        },
        center: Vec3::zeros(),
        ..of_union(&spheres, 1.0)
    };
    let k = 1e4;
    let found = time_step(&spheres, &[], &body, &spring(k, 9)).unwrap();
    // All nine along the normal of the plane push 9 k; turning about its axes, 6 k and 3 k.
    assert!((found.together / (2.0 / (9.0 * k)).sqrt() - 1.0).abs() < 1e-9);
    // At a corner, across: 1 + 2 of the mass is felt.
    assert!((found.together / found.clump - 3f64.sqrt()).abs() < 1e-9);
    let one = time_step(&spheres, &[], &body, &spring(k, 1)).unwrap();
    assert_eq!(one.together, one.clump);
}
