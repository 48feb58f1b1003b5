//! Steps per second of the engine beside LAMMPS (`lmp`, 29 Sep 2021), in one run and on one thread each: the same
//! M&M clumps in a cylinder, the same law, from the same state; and what a step costs against the spheres of a clump.
//! Times are those on the processor, so that other work on the machine counts little.
//!
//!     cargo bench --bench dem [-- lammps | spheres | packing]
//!
//! packing: 250 M&Ms of 48 spheres fall from the same random poses in both until they lie; three seeds, some minutes.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

#[path = "dem/lammps.rs"]
mod lammps;

use morula::dem::contact::{CohesionLaw, DampingLaw, Laws, NormalLaw, TangentialLaw};
use morula::dem::energy;
use morula::dem::{
    Between, Coefficients, Engine, InsertRegion, Insertion, Material, Setup, State, Template,
    WallSetup, WallShape,
};
use morula::generate::{Effort, GenerateOptions, generate};
use morula::mass::Body;
use morula::math::Vec3;
use morula::shape::{ImportOptions, Primitive};
use morula::solid::SolidOptions;
use morula::{Run, Shape, Solid};
use std::sync::Arc;

pub const YOUNG: f64 = 5e7;
pub const POISSON: f64 = 0.29;
pub const FRICTION: f64 = 0.35;
pub const RADIUS: f64 = 0.0254;
pub const STEP: f64 = 5e-6;
/// Steps until the bed lies, and steps that are timed.
const SETTLE: u64 = 30_000;

/// Steps until all lie that were hung in a column.
const FALL: u64 = 200_000;

/// Seconds of this process on a processor.
pub fn seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap();
    text.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9
}

/// An M&M of `n` spheres.
fn candy(solid: &Solid, n: usize) -> Arc<Template> {
    let run = Run::serial();
    let options =
        GenerateOptions { spheres: n, effort: Effort::Draft, ..GenerateOptions::default() };
    let clump = generate(solid, &options, &run).unwrap();
    let body = Body::of_solid(solid, 1377.0).unwrap();
    Arc::new(Template::of_body(&clump.spheres, &body).unwrap())
}

/// A bed of M&Ms that have fallen into a cylinder for so many steps.
fn bed(template: Arc<Template>, bodies: u64, seed: u64, steps: u64) -> Engine {
    let laws = Laws {
        normal: NormalLaw::Hertz,
        damping: DampingLaw::Bodies,
        tangential: TangentialLaw::Mindlin,
        rolling: false,
        cohesion: CohesionLaw::None,
        averaging: false,
    };
    let between =
        Between { restitution: Some(0.5), friction: Some(FRICTION), ..Between::default() };
    let material = Material { young: YOUNG, poisson: POISSON };
    let cylinder = WallShape::Cylinder {
        center: Vec3::zeros(),
        axis: Vec3::z(),
        radius: RADIUS,
        length: None,
    };
    let floor = WallShape::Plane { normal: Vec3::z(), offset: 0.0 };
    let mut setup = Setup {
        laws: Some(laws),
        walls: vec![WallSetup::still(floor), WallSetup::still(cylinder)],
        gravity: Some(Vec3::new(0.0, 0.0, -9.81)),
        ..Setup::free(STEP)
    };
    setup.coefficients[0] = Coefficients::of(&laws, Some([material; 2]), &between).unwrap();
    setup.insertion.push(Insertion {
        templates: vec![0],
        material: 0,
        region: InsertRegion::Cylinder {
            center: Vec3::new(0.0, 0.0, 0.01),
            radius: 0.018,
            height: 0.0025 * bodies as f64,
        },
        velocity: Vec3::new(0.0, 0.0, -0.5),
        total: bodies,
        batch: [bodies, bodies],
        every: 1,
        attempts: 20_000,
        seed,
    });
    let mut engine = Engine::new(setup, State::new(vec![template])).unwrap();
    engine.advance(steps, &Run::serial()).unwrap();
    assert_eq!(engine.state().len() as u64, bodies);
    engine
}

/// Seconds of a step.
fn time(engine: &mut Engine, steps: u64) -> f64 {
    let begin = seconds();
    engine.advance(steps, &Run::serial()).unwrap();
    (seconds() - begin) / steps as f64
}

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |name: &str| asked.is_empty() || asked.iter().any(|a| a == name);
    let run = Run::serial();
    let axes = [6.585e-3, 6.585e-3, 3.395e-3];
    let shape =
        Shape::from_primitive(&Primitive::Ellipsoid { axes }, 96, &ImportOptions::default(), &run)
            .unwrap();
    let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    if wanted("lammps") {
        println!(
            "bodies spheres  ours steps/s  lammps steps/s  ratio  (mean height after, ours and lammps)"
        );
        for (bodies, n, steps) in [(60, 48, 3000), (250, 120, 400)] {
            let mut engine = bed(candy(&solid, n), bodies, 3, SETTLE);
            let theirs = lammps::time(&engine, steps, &[1e-4, 3e-4, 1e-3]);
            let ours = time(&mut engine, steps);
            let height = lammps::height(&engine);
            let Some((step, z, skin)) = theirs else {
                println!("{bodies:6} {n:7}  {:12.0}  lmp is not there", 1.0 / ours);
                continue;
            };
            println!(
                "{bodies:6} {n:7}  {:12.0}  {:14.0}  {:5.1}  ({height:.9} {z:.9}, skin {skin})",
                1.0 / ours,
                1.0 / step,
                step / ours
            );
        }
    }
    if wanted("spheres") {
        println!("60 bodies: spheres, microseconds a step, of that at 10 spheres, contacts a step");
        let mut first = None;
        for n in [10, 30, 48, 120, 300, 1000] {
            let mut engine = bed(candy(&solid, n), 60, 3, SETTLE);
            let before = engine.work().contacts;
            let step = time(&mut engine, 5000);
            let contacts = (engine.work().contacts - before) as f64 / 5000.0;
            let of = step / *first.get_or_insert(step);
            println!("{n:5} {:8.1} {of:6.2} {contacts:7.1}", step * 1e6);
        }
    }
    if asked.iter().any(|a| a == "packing") {
        println!("seed  mean height of the spheres in mm: ours, lammps  kinetic energy of ours");
        let mut gaps = Vec::new();
        for seed in [3, 4, 5] {
            let mut engine = bed(candy(&solid, 48), 250, seed, 1);
            let Some((_, z, _)) = lammps::time(&engine, FALL, &[1e-3]) else { continue };
            engine.advance(FALL, &run).unwrap();
            let (ours, [a, b]) = (lammps::height(&engine), energy::kinetic(engine.state()));
            println!("{seed:4} {:9.3} {:9.3}  {:.1e}", 1e3 * ours, 1e3 * z, a + b);
            gaps.push(1e3 * (ours - z));
        }
        let n = gaps.len() as f64;
        let mean = gaps.iter().sum::<f64>() / n;
        let error = gaps.iter().map(|g| (g - mean) * (g - mean)).sum::<f64>() / (n - 1.0) / n;
        println!("difference {mean:.3} ± {:.3} mm", error.sqrt());
    }
}
