//! Breaks: nothing is lost, nothing is gained, nothing overlaps.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used)]

use morula::dem::contact::{DampingLaw, Laws, NormalLaw, TangentialLaw};
use morula::dem::effects::fragmentation::{BreakBy, Breakable, Fragmentation, Threshold};
use morula::dem::{
    Between, Coefficients, Engine, Material, Placed, Setup, State, Template, WallSetup, WallShape,
};
use morula::fragment::{Parent, ReclumpOptions, ShatterOptions};
use morula::generate::{Effort, GenerateOptions, generate};
use morula::mass::Body;
use morula::math::Vec3;
use morula::shape::{ImportOptions, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Run, Shape, Solid};
use std::sync::{Arc, LazyLock};

/// A pebble of 2 cm, as a template and as what breaks.
static PEBBLE: LazyLock<(Arc<Template>, Arc<Parent>, Body)> = LazyLock::new(|| {
    let run = Run::serial();
    let axes = [0.01, 0.008, 0.006];
    let primitive = Primitive::Ellipsoid { axes };
    let shape = Shape::from_primitive(&primitive, 24, &ImportOptions::default(), &run).unwrap();
    let resolution = Resolution::CellsLongest(40);
    let solid = SolidOptions { resolution, ..SolidOptions::default() };
    let solid = Arc::new(Solid::new(&shape, &solid, &run).unwrap());
    let options =
        GenerateOptions { spheres: 15, effort: Effort::Draft, ..GenerateOptions::default() };
    let clump = generate(&solid, &options, &run).unwrap();
    let body = Body::of_solid(&solid, 2500.0).unwrap();
    let template = Arc::new(Template::of_body(&clump.spheres, &body).unwrap());
    let parent = Arc::new(Parent::new(solid, &clump.spheres, &run).unwrap());
    (template, parent, body)
});

fn laws() -> Laws {
    Laws {
        damping: DampingLaw::Contact,
        tangential: TangentialLaw::Mindlin,
        ..Laws::elastic(NormalLaw::Hertz)
    }
}

fn setup() -> Setup {
    let floor =
        WallShape::Box { lo: Vec3::new(-0.015, -0.015, 0.0), hi: Vec3::new(0.015, 0.015, 1.0) };
    let between = Between { restitution: Some(0.4), friction: Some(0.4), ..Between::default() };
    let material = Material { young: 2e7, poisson: 0.3 };
    let mut s = Setup {
        laws: Some(laws()),
        walls: vec![WallSetup::still(floor)],
        gravity: Some(Vec3::new(0.0, 0.0, -9.81)),
        ..Setup::free(2e-6)
    };
    s.coefficients[0] = Coefficients::of(&laws(), Some([material; 2]), &between).unwrap();
    s
}

fn fragmentation(threshold: Option<Threshold>, by: BreakBy) -> Fragmentation {
    let (_, parent, body) = &*PEBBLE;
    let reclump = ReclumpOptions { spheres: 8, quality: false, ..ReclumpOptions::default() };
    Fragmentation {
        breakable: vec![Breakable { template: 0, parent: parent.clone(), body: *body }],
        threshold,
        at: Vec::new(),
        by,
        options: ShatterOptions { reclump, ..ShatterOptions::default() },
        generations: 2,
        seed: 5,
    }
}

/// What holds after every break.
fn check(e: &Engine) {
    for b in e.breaks() {
        let scale = b.before.kinetic + b.before.stored + 1e-6;
        assert!(b.after.sum() <= b.before.sum() + 1e-9 * scale, "{b:?}");
        assert!((b.after.kinetic - b.before.kinetic).abs() < 1e-9 * scale, "{b:?}");
        assert!(b.mass.abs() < 1e-15 && b.momentum.norm() < 1e-13, "{b:?}");
        assert!(b.angular_momentum.norm() < 1e-13, "{b:?}");
        assert!(b.fragments.len() > 1, "{b:?}");
        assert!(b.errors().iter().all(|e| *e < 1e-13), "{b:?}");
        assert_eq!(b.between.count, 0, "{b:?}");
        let [whole, pieces] = b.around;
        assert!(pieces.deepest <= whole.deepest * (1.0 + 1e-9), "{b:?}");
    }
}

#[test]
fn a_pebble_breaks_in_free_flight() {
    let (template, ..) = &*PEBBLE;
    let mut state = State::new(vec![template.clone()]);
    state
        .add(&Placed {
            rotation: [0.3, -0.5, 0.7, 0.2],
            velocity: Vec3::new(0.3, -0.2, 0.5),
            angular_velocity: Vec3::new(40.0, -30.0, 20.0),
            ..Placed::at(Vec3::new(0.0, 0.0, 0.5))
        })
        .unwrap();
    let mut e = Engine::new(setup(), state).unwrap();
    e.break_by(fragmentation(None, BreakBy::Seeded(5))).unwrap();
    let run = Run::serial();
    e.advance(10, &run).unwrap();
    e.break_now(0, &run).unwrap();
    check(&e);
    assert_eq!(e.breaks().len(), 1);
    // Spheres of fragments keep off each other.
    let bodies = &e.contacts()[0];
    let deepest = bodies.iter().map(|c| c.overlap).fold(0.0, f64::max);
    assert!(deepest < 1e-12, "{deepest}");
    // A piece breaks again, once.
    let piece = e.breaks()[0].fragments[0];
    e.break_now(piece, &run).unwrap();
    check(&e);
    assert!(e.break_now(0, &run).is_err());
    e.advance(100, &run).unwrap();
}

#[test]
fn pebbles_break_on_impact_and_under_load() {
    let (template, ..) = &*PEBBLE;
    for (threshold, by) in [
        (Some(Threshold::Impulse { limit: 1.5e-3, window: 1e-3 }), BreakBy::Impact(4)),
        (Some(Threshold::Stress { limit: 1e4 }), BreakBy::Seeded(3)),
    ] {
        let mut state = State::new(vec![template.clone()]);
        for k in 0..4 {
            let z = 0.012 + 0.021 * f64::from(k);
            let velocity = Vec3::new(0.0, 0.0, -1.0);
            let rotation = [1.0, 0.2 * f64::from(k), 0.1, 0.3];
            state
                .add(&Placed { velocity, rotation, ..Placed::at(Vec3::new(0.0, 0.0, z)) })
                .unwrap();
        }
        let mut e = Engine::new(setup(), state).unwrap();
        e.break_by(fragmentation(threshold, by)).unwrap();
        let run = Run::serial();
        e.advance(12_000, &run).unwrap();
        let half = e.checkpoint().unwrap();
        e.advance(8_000, &run).unwrap();
        check(&e);
        assert!(e.breaks().len() > 1, "{threshold:?}: {}", e.breaks().len());
        println!("{threshold:?}: {} breaks, {} bodies", e.breaks().len(), e.state().len());
        // A restart with pieces about goes on to the same bytes.
        let mut again = Engine::resume(setup(), &half).unwrap();
        again.break_by(fragmentation(threshold, by)).unwrap();
        again.advance(8_000, &run).unwrap();
        assert!(again.checkpoint().unwrap() == e.checkpoint().unwrap());
    }
}

#[test]
fn what_cannot_break_is_told() {
    let (template, ..) = &*PEBBLE;
    let mut state = State::new(vec![template.clone()]);
    state.add(&Placed::at(Vec3::new(0.0, 0.0, 0.5))).unwrap();
    let mut e = Engine::new(setup(), state).unwrap();
    let run = Run::serial();
    let error = e.break_now(0, &run).unwrap_err().to_string();
    assert!(error.contains("body 0 cannot break"), "{error}");
    let mut wrong = fragmentation(Some(Threshold::Stress { limit: 0.0 }), BreakBy::Seeded(3));
    let error = e.break_by(wrong.clone()).unwrap_err().to_string();
    assert!(error.contains("limit of fragmentation is 0"), "{error}");
    wrong.breakable[0].template = 4;
    assert!(e.break_by(wrong).unwrap_err().to_string().contains("template 4"));
}
