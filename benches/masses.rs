//! What masses cost: the moments of the union and each objective, on one thread, the least of
//! several runs in milliseconds. One JSON line for each number of spheres, with the spheres and the
//! body, so that `scripts/masses.py` can give other solvers the same problem.
//!
//!     cargo bench --bench masses [-- N …]

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use morula::mass::{Body, MassOptions, Objective, correct, union_moments};
use morula::math::Vec3;
use morula::{Run, Sphere};
use std::hint::black_box;
use std::time::Instant;

const RUNS: usize = 15;

/// Overlapping spheres without any order, about twenty neighbours each.
fn scattered(n: u32) -> Vec<Sphere> {
    let of = |t: f64, k: f64| (t * k).fract();
    let size = 0.35 / f64::from(n).cbrt();
    let ball = |i: u32| {
        let t = f64::from(i) + 0.5;
        let c = Vec3::new(of(t, 0.819_172_5), 0.8 * of(t, 0.671_043_6), 0.6 * of(t, 0.549_700_5));
        Sphere::new(c, size * (1.0 + of(t, 0.313_7)))
    };
    (0..n).map(ball).collect()
}

fn least(mut work: impl FnMut()) -> f64 {
    let timed = (0..RUNS).map(|_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e3
    });
    timed.fold(f64::MAX, f64::min)
}

fn main() {
    let run = Run::serial();
    let asked: Vec<u32> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    let numbers = if asked.is_empty() { vec![20, 50, 100, 300, 1000] } else { asked };
    for n in numbers {
        let spheres = scattered(n);
        let union = least(|| {
            black_box(union_moments(&spheres, &run).unwrap());
        });
        let body = Body::of_union(&spheres, 1.0, &run).unwrap();
        let masses = |objective| {
            let options = MassOptions { objective, ..MassOptions::default() };
            correct(&spheres, &body, &options, &run).unwrap()
        };
        let time = |objective| least(|| drop(masses(objective)));
        let lowest = |m: &[f64]| m.iter().copied().fold(f64::MAX, f64::min);
        let found = [Objective::Even, Objective::MaxMin, Objective::MaxLast].map(masses);
        let rows: Vec<[f64; 4]> =
            spheres.iter().map(|s| [s.center.x, s.center.y, s.center.z, s.radius]).collect();
        let line = serde_json::json!({
            "n": n, "union": union,
            "even": time(Objective::Even),
            "max_min": time(Objective::MaxMin),
            "max_last": time(Objective::MaxLast),
            "statuses": found.each_ref().map(|m| m.status.name()),
            "best_least": lowest(&found[1].masses), "best_last": found[2].masses[n as usize - 1],
            "min_mass": found[2].m_min,
            "mass": body.mass, "centre": body.center.as_slice(),
            "inertia": body.inertia.to_array(), "spheres": rows,
        });
        println!("{line}");
    }
}
