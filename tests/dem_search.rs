//! What touches, against all pairs; and the same bytes however it is run.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used)]

use morula::Run;
use morula::dem::contact::{CohesionLaw, DampingLaw, Laws, NormalLaw, TangentialLaw};
use morula::dem::{
    Between, Coefficients, Engine, InsertRegion, Insertion, Material, Placed, Setup, State,
    Template, WallMotion, WallSetup, WallShape,
};
use morula::math::{Sphere, Vec3};
use std::sync::Arc;

/// Numbers that look random.
fn noise(k: u64) -> f64 {
    let mut z = k.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x1234_5678_9abc_def1);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A clump of `n` spheres about the shell of an ellipsoid.
fn clump(n: usize, size: f64) -> Arc<Template> {
    let golden = 2.399_963_229_728_653;
    let at = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / n as f64;
        let r = (1.0 - z * z).sqrt();
        let a = golden * i as f64;
        Sphere::new(
            Vec3::new(r * a.cos(), 0.8 * r * a.sin(), 0.4 * z) * (0.7 * size),
            size * (0.2 + 0.1 * noise(i as u64)),
        )
    };
    let spheres: Vec<Sphere> = (0..n).map(at).collect();
    let mass = 1000.0 * size.powi(3);
    let i = mass * size * size;
    Arc::new(Template::new(&spheres, mass, [0.2 * i, 0.25 * i, 0.4 * i]).unwrap())
}

fn laws() -> Laws {
    Laws {
        normal: NormalLaw::Hertz,
        damping: DampingLaw::Contact,
        tangential: TangentialLaw::Mindlin,
        rolling: true,
        cohesion: CohesionLaw::None,
        averaging: false,
    }
}

fn between() -> Between {
    Between {
        restitution: Some(0.5),
        friction: Some(0.4),
        rolling: Some(0.1),
        ..Between::default()
    }
}

/// What these laws read of it.
fn between_of(laws: &Laws) -> Between {
    if laws.damping == DampingLaw::None { Between::default() } else { between() }
}

/// Clumps of two kinds thrown into a box, while more are let in.
fn scene(laws: Laws, between: Between) -> (Setup, State) {
    let mut state = State::new(vec![clump(40, 0.01), clump(11, 0.014)]);
    for k in 0..24u64 {
        let r = |j: u64| noise(100 * k + j);
        let cell = Vec3::new((k % 3) as f64, (k / 3 % 3) as f64, (k / 9) as f64);
        state
            .add(&Placed {
                template: (k % 2) as u32,
                rotation: [r(1) - 0.5, r(2) - 0.5, r(3) - 0.5, r(4) - 0.5],
                velocity: Vec3::new(r(5) - 0.5, r(6) - 0.5, r(7) - 1.0),
                angular_velocity: Vec3::new(r(8), r(9), r(10)) * 50.0,
                ..Placed::at((cell + Vec3::repeat(0.5)) * 0.032)
            })
            .unwrap();
    }
    let material = Material { young: 1e7, poisson: 0.3 };
    let c = Coefficients::of(&laws, Some([material; 2]), &between).unwrap();
    let room = WallShape::Box { lo: Vec3::zeros(), hi: Vec3::new(0.097, 0.097, 0.4) };
    let mut setup = Setup {
        laws: Some(laws),
        walls: vec![WallSetup::still(room)],
        gravity: Some(Vec3::new(0.0, 0.0, -9.81)),
        ..Setup::free(1e-5)
    };
    setup.coefficients[0] = c;
    (setup, state)
}

#[test]
fn contacts_are_those_of_all_against_all() {
    let (mut setup, state) = scene(laws(), between());
    // Pressed together, so that much touches.
    setup.gravity = Some(Vec3::new(-100.0, -50.0, -300.0));
    let mut engine = Engine::new(setup, state).unwrap();
    let run = Run::serial();
    let mut seen = 0;
    for _ in 0..120 {
        engine.advance(37, &run).unwrap();
        let s = engine.state();
        let mut slow = Vec::new();
        for a in 0..s.len() {
            for b in a + 1..s.len() {
                for (i, p) in s.template_of(a).spheres().iter().enumerate() {
                    for (j, q) in s.template_of(b).spheres().iter().enumerate() {
                        let d = (s.sphere_center(a, i) - s.sphere_center(b, j)).norm();
                        let gap = d - p.radius - q.radius;
                        if gap < 0.0 {
                            slow.push((a as u32, b as u32, j as u32, i as u32, -gap));
                        }
                    }
                }
            }
        }
        slow.sort_by_key(|c| (c.0, c.1, c.2, c.3));
        let found = &engine.contacts()[0];
        assert_eq!(found.len(), slow.len());
        for (f, s) in found.iter().zip(&slow) {
            assert_eq!((f.a, f.b, f.sphere_b, f.sphere_a), (s.0, s.1, s.2, s.3));
            assert!((f.overlap - s.4).abs() < 1e-15);
        }
        seen += slow.len();
    }
    assert!(seen > 1000, "only {seen} contacts");
    // Trees were searched far less often than pairs were near.
    let work = engine.work();
    println!("{work:?}");
    assert!(work.searches < work.contacts / 2);
}

/// All that a run leaves.
fn bytes(e: &Engine) -> Vec<u8> {
    e.checkpoint().unwrap()
}

#[test]
fn threads_do_not_change_a_byte() {
    let all = [
        laws(),
        Laws { tangential: TangentialLaw::NoSlip, rolling: false, averaging: true, ..laws() },
        Laws { normal: NormalLaw::Linear, cohesion: CohesionLaw::Linear, ..laws() },
        Laws::elastic(NormalLaw::Hertz),
        Laws::elastic(NormalLaw::Linear),
    ];
    for laws in all {
        let mut b = between_of(&laws);
        b.rolling = laws.rolling.then_some(0.1);
        b.stiffness = (laws.normal == NormalLaw::Linear).then_some(3e3);
        b.cohesion = (laws.cohesion != CohesionLaw::None).then_some(1e3);
        let mut first = None;
        for threads in [1, 2, 3] {
            let (setup, state) = scene(laws, b);
            let mut engine = Engine::new(setup, state).unwrap();
            engine.advance(1500, &Run::new(threads).unwrap()).unwrap();
            let now = bytes(&engine);
            assert!(*first.get_or_insert(now.clone()) == now, "{threads} threads, {laws:?}");
        }
    }
}

#[test]
fn a_checkpoint_goes_on_to_the_same_bytes() {
    let averaged = Laws { averaging: true, ..laws() };
    for laws in [laws(), averaged, Laws::elastic(NormalLaw::Hertz)] {
        let (mut setup, state) = scene(laws, between_of(&laws));
        setup.insertion.push(Insertion {
            templates: vec![0, 1],
            material: 0,
            region: InsertRegion::Box { lo: Vec3::repeat(0.02), hi: Vec3::new(0.07, 0.07, 0.3) },
            velocity: Vec3::zeros(),
            total: 12,
            batch: [1, 3],
            every: 300,
            attempts: 200,
            seed: 7,
        });
        setup.walls.push(WallSetup {
            shape: WallShape::Plane { normal: Vec3::z(), offset: 0.002 },
            material: 0,
            motion: WallMotion::Shake { amplitude: Vec3::new(0.0, 0.0, 0.001), frequency: 40.0 },
        });
        let run = Run::serial();
        let mut whole = Engine::new(setup.clone(), state.clone()).unwrap();
        whole.advance(1100, &run).unwrap();
        let half = whole.checkpoint().unwrap();
        whole.advance(900, &run).unwrap();
        let mut again = Engine::resume(setup.clone(), &half).unwrap();
        assert!(again.checkpoint().unwrap() == half);
        again.advance(900, &run).unwrap();
        assert!(bytes(&again) == bytes(&whole));
        assert_eq!(whole.inserted(), [12]);
        // What is cut, changed or of another version is told.
        for (at, text) in [(3, "no checkpoint"), (9, "version"), (60, "damaged")] {
            let mut bad = half.clone();
            bad[at] ^= 1;
            let e = Engine::resume(setup.clone(), &bad).err().unwrap();
            assert!(e.to_string().contains(text), "{e}");
        }
        assert!(Engine::resume(setup.clone(), &half[..half.len() - 1]).is_err());
    }
}

#[test]
fn inserted_bodies_overlap_nothing() {
    let (mut setup, state) = scene(laws(), between());
    setup.insertion.push(Insertion {
        templates: vec![0],
        material: 0,
        region: InsertRegion::Cylinder {
            center: Vec3::new(0.05, 0.05, 0.11),
            radius: 0.03,
            height: 0.2,
        },
        velocity: Vec3::new(0.0, 0.0, -1.0),
        total: 40,
        batch: [3, 5],
        every: 50,
        attempts: 100,
        seed: 1,
    });
    let mut engine = Engine::new(setup, state).unwrap();
    let run = Run::serial();
    let mut last = 24;
    for _ in 0..20 {
        engine.advance(50, &run).unwrap();
        let fresh = last..engine.state().len();
        let touching = engine.contacts();
        for c in touching.iter().flatten() {
            assert!(!fresh.contains(&(c.b as usize)), "{c:?}");
        }
        last = fresh.end;
    }
    assert_eq!(engine.inserted(), [40]);
}

#[test]
fn what_is_removed_is_gone_and_the_rest_goes_on() {
    let (setup, state) = scene(laws(), between());
    let mut engine = Engine::new(setup, state).unwrap();
    let run = Run::serial();
    engine.advance(600, &run).unwrap();
    for label in [5, 0, 23] {
        engine.remove(label).unwrap();
        engine.advance(100, &run).unwrap();
    }
    assert_eq!(engine.state().len(), 21);
    assert!(engine.remove(5).is_err());
    assert!(engine.contacts()[0].iter().all(|c| c.a < c.b && c.b < 21));
}
