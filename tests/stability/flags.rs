//! No step from a shape to files raises invalid, divide-by-zero or overflow: what a host traps that calls
//! the crate from Rust, without the C border that keeps the host's environment. Only the solver for masses
//! raises some inside.
#![allow(unsafe_code, clippy::unwrap_used)]

use crate::stability::bodies::{Ask, METHODS};
use morula::cost::{CurveOptions, curve};
use morula::dem::advice::advise;
use morula::dem::{
    Coefficients, DampingLaw, Engine, Laws, NormalLaw, Placed, Setup, State, TangentialLaw,
    Template, WallSetup, WallShape,
};
use morula::export::{ExportOptions, Format, Record, files};
use morula::fragment::{Cut, CutOptions, Parent, ReclumpOptions, cut, reclump};
use morula::generate::{Method, generate};
use morula::mass::{
    Body, Contact, ContactOptions, Infeasible, MassOptions, Objective, correct, time_step,
    union_moments,
};
use morula::math::{Sphere, Vec3};
use morula::measure::{QualityOptions, quality};
use morula::shape::{Bodies, ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Run, Shape, Solid};
use std::sync::Arc;

unsafe extern "C" {
    fn feclearexcept(flags: i32) -> i32;
    fn fetestexcept(flags: i32) -> i32;
}

/// Invalid, divide by zero, overflow.
const TRAPPED: i32 = if cfg!(target_arch = "aarch64") { 1 | 2 | 4 } else { 1 | 4 | 8 };

/// Runs a step and notes it where it raised a flag.
fn step<T>(raised: &mut Vec<String>, name: String, work: impl FnOnce() -> T) -> T {
    unsafe { feclearexcept(TRAPPED) };
    let out = work();
    let flags = unsafe { fetestexcept(TRAPPED) };
    if flags != 0 {
        raised.push(format!("{name}: {flags:#x}"));
    }
    out
}

fn weigh(raised: &mut Vec<String>, name: &str, solid: &Solid, spheres: &[morula::Sphere]) {
    let run = Run::serial();
    let body = step(raised, format!("{name}: body"), || Body::of_solid(solid, 2500.0)).unwrap();
    step(raised, format!("{name}: union"), || union_moments(spheres, &run)).unwrap();
    for objective in [Objective::Even, Objective::MaxMin, Objective::MaxLast] {
        let options =
            MassOptions { objective, infeasible: Infeasible::LeastError, ..MassOptions::default() };
        // Not looked at: clarabel divides by what vanishes where it finds that no masses exist.
        let Ok(masses) = correct(spheres, &body, &options, &run) else { continue };
        let contact = Contact::Material { young: 1e11, poisson: 0.3 };
        step(raised, format!("{name}: time step"), || {
            let options = ContactOptions { contact, speed: 1.0, contacts: 4 };
            time_step(spheres, &masses.masses, &body, &options)
        })
        .unwrap();
        if objective == Objective::Even {
            let record = Record::new("clump", spheres, &masses.masses, &body).unwrap();
            for format in Format::ALL {
                step(raised, format!("{name}: {}", format.name()), || {
                    files(&record, format, &ExportOptions::default())
                })
                .ok();
            }
        }
    }
}

fn break_up(raised: &mut Vec<String>, name: &str, solid: &Arc<Solid>, spheres: &[morula::Sphere]) {
    let run = Run::serial();
    let parent =
        step(raised, format!("{name}: parent"), || Parent::new(Arc::clone(solid), spheres, &run));
    let (middle, size) = (solid.moments().centroid, solid.moments().volume.cbrt());
    let c = |k: usize| [0.37, 0.61, 0.83].map(|a| (a * (k as f64 + 1.0)).fract() - 0.5);
    let points = (0..5).map(|k| middle + Vec3::from(c(k)) * size).collect();
    let by = Cut::Points { points, weights: Vec::new() };
    let made =
        step(raised, format!("{name}: cut"), || cut(solid, &by, &CutOptions::default(), &run));
    let (Ok(parent), Ok(made)) = (parent, made) else { return };
    for region in &made.regions {
        let options = ReclumpOptions { spheres: 6, ..ReclumpOptions::default() };
        step(raised, format!("{name}: reclump"), || reclump(&parent, region, &options, &run)).ok();
    }
}

fn bodies() -> Vec<(&'static str, Shape)> {
    let of = |name, p: Primitive, n| {
        let (vertices, faces) = p.mesh(n).unwrap();
        let options = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
        (name, Shape::from_mesh(&vertices, &faces, &options, &Run::serial()).unwrap())
    };
    let cells = |name, dims: [usize; 3], cells: &[u8]| {
        let layout = Layout { dims, spacing: [1e-6; 3], origin: [0.0; 3] };
        let options = ImportOptions::default();
        (name, Shape::from_mask(cells, &layout, &options, &Run::serial()).unwrap())
    };
    let l = [1, 1, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0];
    vec![
        of("stone", Primitive::Stone { seed: 3, diameter: 1.0, roughness: 0.6 }, 20),
        of("box", Primitive::Box { edges: [1e-9, 0.5e-9, 0.25e-9] }, 8),
        of("needle", Primitive::Box { edges: [50.0, 1.0, 1.0] }, 8),
        of("plate", Primitive::Box { edges: [50.0, 50.0, 1.0] }, 8),
        of("torus", Primitive::Torus { major: 1e9, minor: 0.1e9 }, 16),
        of("cone", Primitive::Cone { radius: 1.0, height: 10.0 }, 16),
        cells("one cell", [1; 3], &[1]),
        cells("an L of cells", [3, 2, 2], &l),
    ]
}

#[test]
fn no_step_raises_what_hosts_trap() {
    let mut raised = Vec::new();
    let run = Run::serial();
    for (name, shape) in step(&mut raised, "import".into(), bodies) {
        let solid = step(&mut raised, format!("{name}: solid"), || {
            let resolution = Resolution::CellsLongest(24);
            Solid::new(&shape, &SolidOptions { resolution, ..SolidOptions::default() }, &run)
        });
        let solid = Arc::new(solid.unwrap());
        for method in METHODS {
            let made = step(&mut raised, format!("{name}: {method:?}"), || {
                generate(&solid, &Ask::new(method, 12).options(), &run)
            });
            let Ok(clump) = made else { continue };
            let name = format!("{name}, {method:?}");
            let asked =
                QualityOptions { plane_tolerances: vec![1e-3], ..QualityOptions::default() };
            step(&mut raised, format!("{name}: quality"), || {
                quality(&solid, &clump.spheres, &asked, &run)
            })
            .unwrap();
            weigh(&mut raised, &name, &solid, &clump.spheres);
            if method == Method::Best {
                break_up(&mut raised, &name, &solid, &clump.spheres);
            }
        }
        let options = CurveOptions {
            generate: Ask::new(Method::Best, 0).options(),
            counts: vec![1, 4],
            masses: false,
            ..CurveOptions::default()
        };
        step(&mut raised, format!("{name}: cost"), || curve(&solid, &options, &run)).ok();
    }
    assert!(raised.is_empty(), "{} of them: {:#?}", raised.len(), raised);
}

/// Blows, rest and a time step of the engine, with and without damping and friction.
#[test]
fn no_step_of_a_simulation_raises_what_hosts_trap() {
    let mut raised = Vec::new();
    let run = Run::serial();
    let damped = |normal| Laws {
        damping: DampingLaw::Contact,
        tangential: TangentialLaw::Mindlin,
        ..Laws::elastic(normal)
    };
    for (name, laws) in [
        ("linear, elastic", Laws::elastic(NormalLaw::Linear)),
        ("hertz, elastic", Laws::elastic(NormalLaw::Hertz)),
        ("linear, damped", damped(NormalLaw::Linear)),
        ("hertz, damped", damped(NormalLaw::Hertz)),
        ("hertz, averaged", Laws { averaging: true, ..damped(NormalLaw::Hertz) }),
    ] {
        let spheres = [-0.3, 0.0, 0.3].map(|x| Sphere::new(Vec3::new(x, 0.0, 0.0), 0.3));
        let template = Template::new(&spheres, 1.0, [0.04, 0.1, 0.1]).unwrap();
        let mut state = State::new(vec![Arc::new(template)]);
        for k in 0..8 {
            let at = |a: u32| f64::from(k >> a & 1) * 1.5 - 0.75;
            let turn = f64::from(k) / 8.0;
            state
                .add(&Placed {
                    rotation: [0.5, turn, 1.0 - turn, 0.2],
                    velocity: Vec3::new(1.0 - turn, turn, -1.0),
                    ..Placed::at(Vec3::new(at(0), at(1), at(2)))
                })
                .unwrap();
        }
        let wall = WallShape::Box { lo: Vec3::repeat(-1.6), hi: Vec3::repeat(1.6) };
        let mut setup = Setup {
            laws: Some(laws),
            walls: vec![WallSetup::still(wall)],
            gravity: Some(Vec3::new(0.0, 0.0, -9.81)),
            ..Setup::free(2e-4)
        };
        setup.coefficients[0] = Coefficients {
            stiffness: 1e5,
            shear: 8e4,
            damping: 0.3,
            tangential_damping: 1.0,
            friction: 0.4,
            ..Coefficients::default()
        };
        let c = setup.coefficients.clone();
        step(&mut raised, format!("{name}: time step"), || advise(&laws, &c, &state, 1.0, 4))
            .unwrap();
        let mut engine = Engine::new(setup, state).unwrap();
        step(&mut raised, name.into(), || engine.advance(4000, &run)).unwrap();
        assert!(engine.work().contacts > 100, "{name}: nothing touched");
    }
    assert!(raised.is_empty(), "{raised:#?}");
}
