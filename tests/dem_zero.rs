//! What a scene does not name does no work and holds no memory: calls and bytes, counted by an allocator of this binary.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used, clippy::print_stdout, unsafe_code)]

use morula::dem::contact::{CohesionLaw, DampingLaw, Laws, NormalLaw, TangentialLaw};
use morula::dem::effects::fragmentation::{BreakBy, Breakable, Fragmentation, Threshold};
use morula::dem::effects::wear::Wear;
use morula::dem::{
    Coefficients, Drag, Engine, InsertRegion, Insertion, Placed, Setup, State, Template,
    WallMotion, WallSetup, WallShape,
};
use morula::fragment::{Parent, ReclumpOptions, ShatterOptions};
use morula::mass::Body;
use morula::math::{Sphere, Vec3};
use morula::shape::{ImportOptions, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Run, Shape, Solid};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::{Arc, LazyLock};

/// Counts the bytes that a thread holds, and those that it ever took.
struct Counting;

thread_local! {
    static HELD: Cell<i64> = const { Cell::new(0) };
    static TAKEN: Cell<i64> = const { Cell::new(0) };
}

fn count(bytes: i64) {
    let _ = HELD.try_with(|h| h.set(h.get() + bytes));
    let _ = TAKEN.try_with(|t| t.set(t.get() + bytes.max(0)));
}

// SAFETY: the system's allocator does it all.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as i64);
        // SAFETY: as the caller promises.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        count(-(layout.size() as i64));
        // SAFETY: as the caller promises.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A dumbbell as what breaks or wears.
static SHAPE: LazyLock<(Arc<Solid>, Arc<Parent>, Body)> = LazyLock::new(|| {
    let run = Run::serial();
    let primitive = Primitive::Ellipsoid { axes: [0.02, 0.01, 0.01] };
    let shape = Shape::from_primitive(&primitive, 12, &ImportOptions::default(), &run).unwrap();
    let resolution = Resolution::CellsLongest(16);
    let options = SolidOptions { resolution, ..SolidOptions::default() };
    let solid = Arc::new(Solid::new(&shape, &options, &run).unwrap());
    let body = Body::of_solid(&solid, 2000.0).unwrap();
    let parent = Arc::new(Parent::new(solid.clone(), &spheres(), &run).unwrap());
    (solid, parent, body)
});

fn spheres() -> [Sphere; 2] {
    [-0.01, 0.01].map(|x| Sphere::new(Vec3::new(x, 0.0, 0.0), 0.01))
}

/// A scene: its setup, and what is asked for beside it.
struct Asked {
    setup: Setup,
    breaks: bool,
    wears: bool,
}

/// What a run of it told and took.
#[derive(Debug, PartialEq)]
struct Told {
    effects: Vec<(&'static str, u64, u64)>,
    /// Bytes held after some steps, those taken until then, and in the steps thereafter.
    held: i64,
    taken: i64,
    later: i64,
}

/// Four dumbbells that lie on a plane and stay; on a thread of its own, where no room for searches is left over.
fn run(asked: Asked) -> Told {
    let run = move || {
        let template = Template::new(&spheres(), 0.02, [1e-6, 2e-6, 2e-6]).unwrap();
        let mut state = State::new(vec![Arc::new(template)]);
        for k in 0..4 {
            let at = Vec3::new(0.05 * f64::from(k), 0.0, 0.01 - 1e-6);
            state.add(&Placed { fixed: true, ..Placed::at(at) }).unwrap();
        }
        let (solid, parent, body) = &*SHAPE;
        let reclump = ReclumpOptions::default();
        let fragmentation = asked.breaks.then(|| Fragmentation {
            breakable: vec![Breakable { template: 0, parent: parent.clone(), body: *body }],
            threshold: Some(Threshold::Stress { limit: 1e30 }),
            at: Vec::new(),
            by: BreakBy::Seeded(4),
            options: ShatterOptions::default(),
            generations: 1,
            seed: 0,
        });
        let wear = asked.wears.then(|| {
            vec![Wear {
                label: 0,
                solid: solid.clone(),
                body: *body,
                every: u64::MAX,
                times: 1,
                depth: 1e-3,
                direction: Vec3::z(),
                reclump,
            }]
        });
        let steps = Run::serial();
        let at = || (HELD.get(), TAKEN.get());
        let first = at();
        let mut engine = Engine::new(asked.setup, state).unwrap();
        if let Some(f) = fragmentation {
            engine.break_by(f).unwrap();
        }
        if let Some(w) = wear {
            engine.wear_by(w).unwrap();
        }
        engine.advance(10, &steps).unwrap();
        let begun = at();
        engine.advance(1000, &steps).unwrap();
        let end = at();
        let effects = engine.effects().iter().map(|e| (e.name, e.calls, e.bytes)).collect();
        Told { effects, held: begun.0 - first.0, taken: begun.1 - first.1, later: end.1 - begun.1 }
    };
    std::thread::spawn(run).join().unwrap()
}

/// Bodies on a plane, no effect.
fn bare() -> Asked {
    let plane = WallShape::Plane { normal: Vec3::z(), offset: 0.0 };
    let mut setup = Setup { walls: vec![WallSetup::still(plane)], ..Setup::free(1e-6) };
    setup.coefficients[0] = Coefficients {
        stiffness: 1e6,
        shear: 1e6,
        damping: 0.1,
        tangential_damping: 1.0,
        friction: 0.5,
        viscosity: 1.0,
        rolling: 0.1,
        cohesion: 10.0,
    };
    Asked { setup, breaks: false, wears: false }
}

fn touching(laws: Laws) -> Asked {
    let mut asked = bare();
    asked.setup.laws = Some(laws);
    asked
}

const ELASTIC: Laws = Laws {
    normal: NormalLaw::Hertz,
    damping: DampingLaw::None,
    tangential: TangentialLaw::None,
    rolling: false,
    cohesion: CohesionLaw::None,
    averaging: false,
};

/// A scene without an effect, and the same with it.
fn pairs() -> Vec<(&'static str, Asked, Asked)> {
    let with = |name, change: fn(&mut Asked)| {
        let mut more = touching(ELASTIC);
        change(&mut more);
        (name, touching(ELASTIC), more)
    };
    let rough = Laws { tangential: TangentialLaw::Mindlin, ..ELASTIC };
    let law = |name, without: Laws, laws: Laws| (name, touching(without), touching(laws));
    vec![
        with("gravity", |a| a.setup.gravity = Some(Vec3::z())),
        ("normal", bare(), touching(ELASTIC)),
        law("damping", ELASTIC, Laws { damping: DampingLaw::Contact, ..ELASTIC }),
        law("tangential", ELASTIC, rough),
        law("tangential", ELASTIC, Laws { tangential: TangentialLaw::NoSlip, ..ELASTIC }),
        law("tangential", ELASTIC, Laws { tangential: TangentialLaw::Viscous, ..ELASTIC }),
        law("rolling", rough, Laws { rolling: true, ..rough }),
        law("cohesion", ELASTIC, Laws { cohesion: CohesionLaw::Linear, ..ELASTIC }),
        law("cohesion", ELASTIC, Laws { cohesion: CohesionLaw::Jkr, ..ELASTIC }),
        law("cohesion", rough, Laws { cohesion: CohesionLaw::Jkr, ..rough }),
        law("averaging", ELASTIC, Laws { averaging: true, ..ELASTIC }),
        with("drag", |a| {
            let (viscosity, flow) = (1e-3, Vec3::zeros());
            a.setup.drag = Some(Drag { viscosity, density: 0.0, coefficient: 0.0, flow });
        }),
        // Where there is no room for what would come.
        with("insertion", |a| {
            let at = Vec3::new(0.01, 0.0, 0.01);
            a.setup.insertion.push(Insertion {
                templates: vec![0],
                material: 0,
                region: InsertRegion::Box { lo: at, hi: at },
                velocity: Vec3::zeros(),
                total: 1,
                batch: [1, 1],
                every: 5000,
                attempts: 1,
                seed: 0,
            });
        }),
        with("motion", |a| a.setup.walls[0].motion = WallMotion::Slide(Vec3::x() * 1e-9)),
        with("fragmentation", |a| a.breaks = true),
        with("wear", |a| a.wears = true),
    ]
}

#[test]
fn what_is_not_named_does_nothing_and_holds_nothing() {
    LazyLock::force(&SHAPE);
    let _ = run(bare());
    let mut names: Vec<&str> = Vec::new();
    for (name, without, with) in pairs() {
        let (without, with) = (run(without), run(with));
        let find = |t: &Told| *t.effects.iter().find(|e| e.0 == name).unwrap();
        assert_eq!(find(&without), (name, 0, 0));
        let (_, calls, bytes) = find(&with);
        assert!(calls > 0, "{name} did nothing");
        // No more than it says is held for it.
        let more = with.held - without.held;
        println!("{name}: {calls} calls, says {bytes} bytes, holds {more}");
        if name == "normal" {
            assert!(more > 0);
        } else {
            assert!((0..=bytes as i64).contains(&more), "{name} holds {more} bytes, not {bytes}");
        }
        // Once it runs, nothing is taken any more, with the effect or without.
        assert_eq!((without.later, with.later), (0, 0), "{name}");
        names.push(name);
        for (other, calls, bytes) in &with.effects {
            let named = *other == name
                || *other == "normal"
                || (*other == "tangential" && name != "gravity" && *calls > 0);
            assert!(named || (*calls, *bytes) == (0, 0), "{name} makes {other} work");
        }
    }
    // All effects that there are.
    let all = run(bare()).effects;
    assert!(all.iter().all(|e| names.contains(&e.0) && (e.1, e.2) == (0, 0)), "{all:?}");
}

#[test]
fn bodies_alone_take_no_byte() {
    let mut asked = bare();
    asked.setup.walls.clear();
    let told = run(asked);
    assert_eq!((told.held, told.taken, told.later), (0, 0, 0));
}
