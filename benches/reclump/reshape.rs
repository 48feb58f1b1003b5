//! Shapes that change without breaking: how long new spheres take from a ready solid.

use super::breaks::{Random, mean, median, parent, particles};
use super::latency::{TIMES, cpu, held, volume};
use morula::Run;
use morula::fragment::{Cut, CutOptions, Parent, ShatterOptions, cut, reshape, shatter};
use morula::generate::HalfSpace;
use std::sync::Arc;
use std::time::Instant;

/// Every particle is dented by a plane that takes a part of it away; its old spheres are those of
/// the whole.
pub fn reshaped(dents: usize) {
    let particles = particles();
    let mut random = Random(4);
    let mut all: Vec<[Vec<f64>; 6]> = vec![Default::default(); 2];
    let mut apart: Vec<[Vec<f64>; 2]> = vec![Default::default(); 2];
    for (k, (_, solid)) in particles.iter().enumerate() {
        let old = parent(solid);
        let frame = solid.frame();
        let spheres: Vec<_> = old.unit_spheres().iter().map(|s| frame.sphere_to_input(s)).collect();
        let held = held(solid);
        let run = Run::serial();
        for _ in (k..dents).step_by(particles.len()) {
            let HalfSpace { normal, .. } = random.plane(solid);
            let reach = spheres.iter().map(|s| normal.dot(&s.center) + s.radius);
            let reach = reach.fold(f64::MIN, f64::max);
            let offset = 0.8 * reach + 0.2 * normal.dot(&solid.moments().centroid);
            let dent = Cut::Within(vec![HalfSpace { normal, offset }]);
            for (i, n) in [10, 50].into_iter().enumerate() {
                let mut options = ShatterOptions::default();
                (options.reclump.spheres, options.reclump.union) = (n, false);
                let (mut least, mut ready, mut made) = (f64::MAX, f64::MAX, None);
                let mut used = 0.0;
                for _ in 0..TIMES {
                    let start = Instant::now();
                    let parent = Parent::reshaped(Arc::clone(solid), &spheres, &run).unwrap();
                    ready = ready.min(start.elapsed().as_secs_f64());
                    std::hint::black_box(parent);
                    let (start, before) = (Instant::now(), cpu());
                    made = reshape(Arc::clone(solid), &spheres, &held, &dent, &options, &run).ok();
                    least = least.min(start.elapsed().as_secs_f64());
                    used += (cpu() - before) / TIMES as f64;
                }
                // The same where nothing is cut off, and the cut alone.
                let (mut uncut, mut cutting) = (f64::MAX, f64::MAX);
                let none = Cut::Within(Vec::new());
                for _ in 0..TIMES {
                    let start = Instant::now();
                    let one = reshape(Arc::clone(solid), &spheres, &held, &none, &options, &run);
                    uncut = uncut.min(start.elapsed().as_secs_f64());
                    let start = Instant::now();
                    let parts = cut(solid, &dent, &CutOptions::default(), &run);
                    cutting = cutting.min(start.elapsed().as_secs_f64());
                    std::hint::black_box((one.is_ok(), parts.is_ok()));
                }
                apart[i].iter_mut().zip([uncut, cutting]).for_each(|(to, v)| to.push(v * 1e3));
                let full = shatter(&old, None, &held, &dent, &options, &run).ok();
                let (Some((_, made)), Some(full)) = (made, full) else { continue };
                let cover = |f: &morula::fragment::Fragment| {
                    volume(&f.clump.spheres) / f.region.moments(frame).volume
                };
                let (own, theirs) = (cover(&made.fragments[0]), cover(&full.fragments[0]));
                let row = [least * 1e3, used * 1e3, ready * 1e3, own, theirs, own - theirs];
                all[i].iter_mut().zip(row).for_each(|(to, v)| to.push(v));
            }
        }
    }
    println!("{} dents", all[0][0].len());
    println!();
    println!(
        "| n | median ms | 90 % ms | mean CPU ms | of it getting ready | the cut alone | nothing cut off | \
         coverage | with fields | mean difference | least |"
    );
    println!("| ---: |{}", " ---: |".repeat(10));
    let rows = [10, 50].into_iter().zip(&mut all).zip(&mut apart);
    for ((n, [times, used, ready, own, theirs, less]), [uncut, cutting]) in rows {
        let middle = median(times);
        let late = times.get(times.len() * 9 / 10).copied().unwrap_or(0.0);
        let worst = less.iter().copied().fold(f64::MAX, f64::min);
        println!(
            "| {n} | {middle:.3} | {late:.3} | {:.3} | {:.3} | {:.3} | {:.3} | {:.4} | {:.4} | {:.4} | {worst:.4} |",
            mean(used),
            median(ready),
            median(cutting),
            median(uncut),
            mean(own),
            mean(theirs),
            mean(less)
        );
    }
}
