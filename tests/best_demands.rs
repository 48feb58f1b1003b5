//! What clumps of the generator of least mismatch must keep to.

#![allow(clippy::unwrap_used)]

use morula::generate::{BestOptions, Effort, GenerateOptions, Method, generate};
use morula::measure::{Quality, QualityOptions, quality};
use morula::shape::primitive::Primitive;
use morula::shape::{ImportOptions, Shape};
use morula::solid::{Resolution, SolidOptions};
use morula::{Clump, Run, Solid};

fn solid(name: &str) -> Solid {
    let run = Run::serial();
    let primitive = Primitive::from_name(name).unwrap();
    let shape = Shape::from_primitive(&primitive, 32, &ImportOptions::default(), &run).unwrap();
    let resolution = Resolution::CellsLongest(48);
    Solid::new(&shape, &SolidOptions { resolution, ..SolidOptions::default() }, &run).unwrap()
}

fn ask(spheres: usize, effort: Effort, best: BestOptions) -> GenerateOptions {
    GenerateOptions { method: Method::Best, spheres, effort, best, ..GenerateOptions::default() }
}

fn make(solid: &Solid, spheres: usize, best: &BestOptions) -> Clump {
    generate(solid, &ask(spheres, Effort::Normal, best.clone()), &Run::serial()).unwrap()
}

fn overlap(solid: &Solid, clump: &Clump) -> Quality {
    let options = QualityOptions { surface: false, ..QualityOptions::default() };
    quality(solid, &clump.spheres, &options, &Run::serial()).unwrap()
}

#[test]
fn overshoot_falls_with_its_weight() {
    for name in ["box", "torus", "stone"] {
        let solid = solid(name);
        let weights = [0.3, 1.0, 3.0, 10.0];
        let q = weights.map(|overshoot_weight| {
            let best = BestOptions { overshoot_weight, ..BestOptions::default() };
            overlap(&solid, &make(&solid, 12, &best))
        });
        for k in 0..3 {
            assert!(q[k + 1].overshoot < 0.8 * q[k].overshoot, "{name} {}: {q:?}", weights[k]);
            assert!(q[k + 1].coverage < q[k].coverage, "{name} {}: {q:?}", weights[k]);
        }
        // Each is the best of the four by its own measure.
        for (w, mine) in weights.iter().zip(&q) {
            let goal = |q: &Quality| {
                let (missing, beyond) = (1.0 - q.coverage, w * q.overshoot);
                (missing + beyond) / (1.0 + q.coverage + beyond)
            };
            for other in &q {
                assert!(goal(mine) < 1.02 * goal(other), "{name} {w}: {q:?}");
            }
        }
    }
}
