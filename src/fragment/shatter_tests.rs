use super::*;
use crate::generate::{GenerateOptions, Method, generate};
use crate::mass::MassStatus;
use crate::math::Vec3;
use crate::shape::{ImportOptions, Primitive, Shape};
use crate::solid::{Solid, SolidOptions};
use std::sync::Arc;

fn stone() -> Parent {
    let run = Run::serial();
    let stone = Primitive::from_name("stone").unwrap();
    let shape = Shape::from_primitive(&stone, 30, &ImportOptions::default(), &run).unwrap();
    let solid = Arc::new(Solid::new(&shape, &SolidOptions::default(), &run).unwrap());
    let options =
        GenerateOptions { method: Method::Inscribed, spheres: 40, ..GenerateOptions::default() };
    let clump = generate(&solid, &options, &run).unwrap();
    Parent::new(solid, &clump.spheres, &run).unwrap()
}

fn held(parent: &Parent) -> Held {
    let body = Body::of_solid(parent.solid(), 2600.0).unwrap();
    Held {
        mass: body.mass,
        center: body.center,
        inertia: body.inertia,
        scale: 1.0,
        position: Vec3::new(3.0, -2.0, 1.0),
        rotation: [0.9, 0.1, -0.3, 0.2],
        velocity: Vec3::new(1.0, 2.0, -4.0),
        angular_velocity: Vec3::new(5.0, -3.0, 8.0),
    }
}

#[test]
fn a_stone_breaks_and_nothing_is_lost() {
    let parent = stone();
    let held = held(&parent);
    let options =
        ShatterOptions { masses: Some(MassOptions::default()), ..ShatterOptions::default() };
    let run = Run::serial().with_seed(4);
    let by = Cut::Seeded { count: 6 };
    let found = shatter(&parent, None, &held, &by, &options, &run).unwrap();
    assert!(found.fragments.len() >= 5, "{}", found.fragments.len());
    let all =
        || found.fragments.iter().map(|f| f.moving).chain(found.dust.iter().map(|d| d.moving));
    let mass: f64 = all().map(|m| m.mass).sum();
    assert!((mass / held.mass - 1.0).abs() < 1e-14);
    let momentum: Vec3 = all().map(|m| m.velocity * m.mass).sum();
    assert!((momentum - held.velocity * held.mass).norm() < 1e-12 * momentum.norm());
    // A closed mesh: the pieces' inertia is the solid's.
    assert!(found.inertia_error < 1e-11 && found.shift.norm() < 1e-12, "{}", found.inertia_error);
    let energy = 0.5 * held.mass * held.velocity.norm_squared();
    assert!(found.energy.abs() < 1e-11 * energy);
    for f in &found.fragments {
        assert_eq!(f.clump.spheres.len(), 20);
        let Some(masses) = &f.masses else {
            assert!(!f.no_masses.is_empty());
            continue;
        };
        let sum: f64 = masses.masses.iter().sum();
        assert!((sum / f.moving.mass - 1.0).abs() < 1e-10);
        assert!(masses.status != MassStatus::Exact || masses.residuals.inertia < 1e-9);
    }
    // No two fragments overlap.
    for (i, a) in found.fragments.iter().enumerate() {
        for b in &found.fragments[..i] {
            for s in &a.clump.spheres {
                let apart = |t: &crate::Sphere| (s.center - t.center).norm() - s.radius - t.radius;
                assert!(b.clump.spheres.iter().all(|t| apart(t) >= 0.0));
            }
        }
    }
    // A fragment breaks again, as the solver holds it now, and nothing is lost either.
    let f = &found.fragments[0];
    let next = Held {
        mass: f.moving.mass,
        center: f.moving.center,
        inertia: f.moving.inertia,
        position: f.moving.position,
        velocity: f.moving.velocity,
        ..held
    };
    let again = shatter(&parent, Some(&f.region), &next, &Cut::Seeded { count: 3 }, &options, &run);
    let again = again.unwrap();
    assert!(again.inertia_error < 1e-9 && again.shift.norm() < 1e-10);
    let mass: f64 = again.fragments.iter().map(|f| f.moving.mass).sum::<f64>()
        + again.dust.iter().map(|d| d.moving.mass).sum::<f64>();
    assert!((mass / next.mass - 1.0).abs() < 1e-14);
}

#[test]
fn many_breaks_are_each_as_one() {
    let parent = stone();
    let held = held(&parent);
    let options = ShatterOptions::default();
    let cuts = [Cut::Seeded { count: 3 }, Cut::Seeded { count: 0 }, Cut::Seeded { count: 5 }];
    let job = |(k, cut)| Job { parent: &parent, region: None, held: &held, cut, seed: k as u64 };
    let jobs: Vec<Job> = cuts.iter().enumerate().map(job).collect();
    let one: Vec<_> = jobs
        .iter()
        .map(|j| {
            let run = Run::serial().with_seed(j.seed);
            shatter(&parent, None, &held, j.cut, &options, &run).ok()
        })
        .collect();
    assert!(one[0].is_some() && one[1].is_none());
    for threads in [1, 2, 3] {
        let run = Run::new(threads).unwrap();
        let many = shatter_many(&jobs, &options, &run);
        let many: Vec<_> = many.into_iter().map(|m| m.ok()).collect();
        assert_eq!(many, one);
    }
}

#[test]
fn what_holds_no_sphere_is_dust() {
    let parent = stone();
    let held = held(&parent);
    let mut options = ShatterOptions::default();
    options.reclump.min_radius = 0.12;
    let run = Run::serial().with_seed(1);
    let found = shatter(&parent, None, &held, &Cut::Seeded { count: 12 }, &options, &run).unwrap();
    assert!(!found.dust.is_empty() && found.notes.iter().any(|n| n.contains("became dust")));
    let all = found.fragments.iter().map(|f| f.moving.mass);
    let mass: f64 = all.chain(found.dust.iter().map(|d| d.moving.mass)).sum();
    assert!((mass / held.mass - 1.0).abs() < 1e-14);
    options.reclump.min_radius = 10.0;
    let none = shatter(&parent, None, &held, &Cut::Seeded { count: 12 }, &options, &run);
    assert!(matches!(none, Err(Error::NoSpheres(_))));
}
