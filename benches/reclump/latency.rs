//! How long the spheres of a fragment take, alone and with all that a break does, and what they
//! cover.

use super::breaks::{Random, mean, median, parent, particles, pieces};
use morula::fragment::{
    CutOptions, Held, Parent, Reclump, ReclumpOptions, Region, ShatterOptions, Union, reclump,
    shape, shatter,
};
use morula::generate::{GenerateOptions, Method, generate, inscribed_within};
use morula::mass::{Body, union_moments};
use morula::math::Vec3;
use morula::solid::SolidOptions;
use morula::{Run, Solid, Sphere};
use std::time::Instant;

/// How often each fragment is made.
pub const TIMES: usize = 5;

/// CPU seconds of this thread so far, in steps of some milliseconds; without Linux's figure 0.
pub fn cpu() -> f64 {
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|s| s.split(' ').next()?.parse::<f64>().ok())
        .map_or(0.0, |ns| ns * 1e-9)
}

/// The clump, the least of some times, in seconds, since other work on the machine only adds, and
/// the mean CPU time, right in the mean over many calls alone.
pub fn timed(
    parent: &Parent,
    region: &Region,
    n: usize,
    union: bool,
) -> Option<(Reclump, [f64; 2])> {
    let options = ReclumpOptions { spheres: n, union, quality: false, ..ReclumpOptions::default() };
    let mut least = f64::MAX;
    let mut found = None;
    let before = cpu();
    for _ in 0..TIMES {
        let run = Run::serial();
        let start = Instant::now();
        let made = reclump(parent, region, &options, &run);
        least = least.min(start.elapsed().as_secs_f64());
        found = made.ok();
    }
    let cpu = (cpu() - before) / TIMES as f64;
    found.map(|made| (made, [least, cpu]))
}

pub fn volume(spheres: &[Sphere]) -> f64 {
    union_moments(spheres, &Run::serial()).map_or(0.0, |m| m.volume)
}

/// Spheres by the full generator within the clipped body, and within the union of the parent's.
fn full_generator(parent: &Parent, clipped: &Solid, n: usize, union: bool) -> Vec<Sphere> {
    let (method, run) = (Method::Inscribed, Run::serial());
    let options = GenerateOptions { method, spheres: n, ..GenerateOptions::default() };
    if !union {
        return generate(clipped, &options, &run).unwrap().spheres;
    }
    let (whole, own) = (parent.solid().frame(), clipped.frame());
    let around = parent.unit_spheres().iter();
    let around = around.map(|s| own.sphere_to_unit(&whole.sphere_to_input(s)));
    let around = Union::new(&around.collect::<Vec<Sphere>>()).unwrap();
    let made = inscribed_within(clipped, &options, &|p| around.nearest(p), &run);
    made.map_or_else(|_| Vec::new(), |clump| clump.spheres)
}

/// Milliseconds, CPU milliseconds, coverage and that of the full generator under the same
/// constraints.
type Row = [Vec<f64>; 4];

/// Latency and coverage; `full`: beside the full generator on the clipped body, which takes most
/// of the time.
pub fn latency(cuts: usize, full: bool) {
    // Of both numbers without and with the union.
    let mut all: Vec<Row> = vec![Default::default(); 4];
    pieces(cuts, |solid, parent, region| {
        let whole = region.moments(solid.frame()).volume;
        let run = Run::serial();
        let clipped = full.then(|| {
            let body = shape(solid, region, &run).unwrap();
            Solid::new(&body, &SolidOptions::default(), &run).unwrap()
        });
        for (i, n) in [10, 50].into_iter().enumerate() {
            for union in [false, true] {
                let theirs = clipped.as_ref().map_or(0.0, |clipped| {
                    volume(&full_generator(parent, clipped, n, union)) / whole
                });
                let Some((made, [time, cpu])) = timed(parent, region, n, union) else { continue };
                let row = [time * 1e3, cpu * 1e3, volume(&made.spheres) / whole, theirs];
                all[2 * i + usize::from(union)].iter_mut().zip(row).for_each(|(to, v)| to.push(v));
            }
        }
    });
    println!("{} fragments", all[0][0].len());
    println!();
    println!(
        "| n | within the union | median ms | 90 % ms | mean CPU ms | coverage | of `inscribed` | \
         mean difference | least |"
    );
    println!("| ---: | --- |{}", " ---: |".repeat(7));
    for (i, [times, cpu, coverage, theirs]) in all.iter_mut().enumerate() {
        let less: Vec<f64> = coverage.iter().zip(theirs.iter()).map(|(a, b)| a - b).collect();
        let worst = less.iter().copied().fold(f64::MAX, f64::min);
        let middle = median(times);
        let late = times.get(times.len() * 9 / 10).copied().unwrap_or(0.0);
        let (n, union) = ([10, 50][i / 2], ["no", "yes"][i % 2]);
        let (cpu, coverage) = (mean(cpu), mean(coverage));
        print!("| {n} | {union} | {middle:.3} | {late:.3} | {cpu:.3} | {coverage:.4} ");
        if full {
            println!("| {:.4} | {:.4} | {worst:.4} |", mean(theirs), mean(&less));
        } else {
            println!("| | | |");
        }
    }
}

pub fn held(solid: &Solid) -> Held {
    let body = Body::of_solid(solid, 1.0).unwrap();
    Held {
        mass: body.mass,
        center: body.center,
        inertia: body.inertia,
        scale: 1.0,
        position: body.center,
        rotation: [1.0, 0.0, 0.0, 0.0],
        velocity: Vec3::x(),
        angular_velocity: Vec3::z(),
    }
}

/// The whole of a break, on one thread: cutting, spheres with their quality, and the hand-over.
pub fn whole(breaks: usize) {
    let particles = particles();
    let mut random = Random(3);
    let mut all: Vec<[Vec<f64>; 3]> = vec![Default::default(); 2];
    for (k, (_, solid)) in particles.iter().enumerate() {
        let parent = parent(solid);
        let held = held(solid);
        for _ in (k..breaks).step_by(particles.len()) {
            let by = random.cut(solid);
            for (i, n) in [10, 50].into_iter().enumerate() {
                let cut = CutOptions { least_volume: 0.001 * solid.moments().volume };
                let reclump = ReclumpOptions { spheres: n, ..ReclumpOptions::default() };
                let options = ShatterOptions { cut, reclump, masses: None };
                let (mut least, mut count) = (f64::MAX, 0);
                let before = cpu();
                for _ in 0..TIMES {
                    let start = Instant::now();
                    let made = shatter(&parent, None, &held, &by, &options, &Run::serial());
                    least = least.min(start.elapsed().as_secs_f64());
                    count = made.map_or(0, |made| made.fragments.len());
                }
                if count > 0 {
                    let each = 1e3 / count as f64;
                    let cpu = (cpu() - before) / TIMES as f64;
                    let row = [least * each, cpu * each, count as f64];
                    all[i].iter_mut().zip(row).for_each(|(to, v)| to.push(v));
                }
            }
        }
    }
    println!("{} breaks", all[0][0].len());
    println!();
    println!("| n | fragments, mean | median ms a fragment | 90 % ms | mean CPU ms |");
    println!("| ---: |{}", " ---: |".repeat(4));
    for (n, [times, cpu, count]) in [10, 50].into_iter().zip(&mut all) {
        let middle = median(times);
        let late = times.get(times.len() * 9 / 10).copied().unwrap_or(0.0);
        println!("| {n} | {:.1} | {middle:.3} | {late:.3} | {:.3} |", mean(count), mean(cpu));
    }
}
