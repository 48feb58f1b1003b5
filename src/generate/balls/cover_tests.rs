//! Lengths of columns against the quality figures, and changes against whole sums.

use super::super::random::Random;
use super::super::test_bodies::bodies;
use super::*;
use crate::generate::ball::Ball;
use crate::measure::{QualityOptions, quality};
use crate::run::Run;

fn clump(n: usize, seed: u64) -> Vec<Ball> {
    let mut random = Random::new(seed, 2);
    (0..n)
        .map(|_| Ball {
            center: [0; 3].map(|_| random.between(0.0, 0.9) as f32),
            radius: random.between(0.03, 0.2) as f32,
        })
        .collect()
}

#[test]
fn the_mismatch_is_that_of_the_quality_figures() {
    for body in bodies() {
        let dexels = body.dexels(30_000);
        let mut cover = Cover::new(&dexels).unwrap();
        for n in [1, 3, 10, 40] {
            // Within the room that columns have.
            let balls: Vec<Ball> = clump(n, n as u64)
                .iter()
                .map(|b| Ball { center: b.center.map(|x| 0.2 + 0.3 * x), radius: 0.5 * b.radius })
                .collect();
            let seen: Vec<Seen> = balls.iter().map(|b| dexels.seen(b)).collect();
            let lengths = cover.whole(&dexels, &seen, &mut Look::default());
            let frame = body.solid.frame();
            let spheres: Vec<_> =
                balls.iter().map(|b| frame.sphere_to_input(&b.sphere())).collect();
            let options =
                QualityOptions { columns: 512, surface: false, ..QualityOptions::default() };
            let q = quality(&body.solid, &spheres, &options, &Run::serial()).unwrap();
            let d = lengths.mismatch(dexels.target);
            assert!((d - q.mismatch).abs() < 5e-4, "{n}: {d} {}", q.mismatch);
            let volume = lengths.union * dexels.cell() * frame.scale.powi(3);
            assert!((volume / q.union_volume - 1.0).abs() < 2e-3, "{n}");
        }
    }
}

#[test]
fn changes_add_up_to_whole_sums() {
    for body in bodies() {
        let dexels = body.dexels(3000);
        let (mut cover, mut other) = (Cover::new(&dexels).unwrap(), Cover::new(&dexels).unwrap());
        let mut seen: Vec<Seen> = clump(25, 4).iter().map(|b| dexels.seen(b)).collect();
        let fresh: Vec<Seen> = clump(60, 5).iter().map(|b| dexels.seen(b)).collect();
        let mut look = Look::default();
        let mut sum = cover.whole(&dexels, &seen, &mut look);
        for (k, new) in fresh.iter().enumerate() {
            let i = k % seen.len();
            look.region.of(&dexels, [seen[i], *new].into_iter());
            seen[i] = *new;
            sum = sum.plus(&look.change(&cover, &dexels, &seen));
            cover.take(&dexels, &look);
            let whole = other.whole(&dexels, &seen, &mut Look::default());
            let close = |x: f64, y: f64| (x - y).abs() < 1e-5 * dexels.target;
            assert!(close(sum.union, whole.union) && close(sum.both, whole.both));
        }
        for c in 0..dexels.dims[0] * dexels.dims[1] {
            assert_eq!(cover.columns[c], other.columns[c], "column {c}");
        }
    }
}

#[test]
fn what_a_ball_covers_alone_is_lost_without_it() {
    for body in bodies() {
        let dexels = body.dexels(3000);
        let mut cover = Cover::new(&dexels).unwrap();
        let seen: Vec<Seen> = clump(30, 8).iter().map(|b| dexels.seen(b)).collect();
        let mut look = Look::default();
        let whole = cover.whole(&dexels, &seen, &mut look);
        let mut alone = vec![Lengths::default(); seen.len()];
        look.alone(&dexels, &seen, 1.0, &mut alone);
        for (i, alone) in alone.iter().enumerate() {
            let mut rest = seen.clone();
            rest.remove(i);
            let left = cover.whole(&dexels, &rest, &mut look);
            let lost = Lengths { union: whole.union - left.union, both: whole.both - left.both };
            let close = |x: f64, y: f64| (x - y).abs() < 1e-5 * dexels.target;
            assert!(close(lost.union, alone.union), "{i}: {lost:?} {:?}", alone);
            assert!(close(lost.both, alone.both), "{i}: {lost:?} {:?}", alone);
        }
    }
}

#[test]
fn gaps_are_what_is_missing() {
    for body in bodies() {
        let dexels = body.dexels(3000);
        let mut cover = Cover::new(&dexels).unwrap();
        let seen: Vec<Seen> = clump(20, 6).iter().map(|b| dexels.seen(b)).collect();
        let mut look = Look::default();
        cover.whole(&dexels, &seen, &mut look);
        let mut gaps = Vec::new();
        for b in 0..dexels.dims[1] {
            for a in 0..dexels.dims[0] {
                let c = a + dexels.dims[0] * b;
                look.gaps(&dexels, [a, b], &seen, &mut gaps);
                let sum: f32 = gaps.iter().map(|g| g[1] - g[0]).sum();
                assert!((sum - cover.missing(&dexels, c)).abs() < 1e-3, "{a} {b}");
                assert!(gaps.iter().all(|g| g[0] < g[1]));
            }
        }
    }
}

#[test]
fn exchanges_are_changes() {
    for body in bodies() {
        let dexels = body.dexels(3000);
        let (mut cover, mut piles) = (Cover::new(&dexels).unwrap(), Piles::new(&dexels).unwrap());
        let mut look = Look::default();
        let mut seen: Vec<Seen> = clump(40, 11).iter().map(|b| dexels.seen(b)).collect();
        cover.whole(&dexels, &seen, &mut look);
        piles.fill(&dexels, &seen, look.order(&dexels, &seen), u64::MAX).unwrap();
        let mut alone = vec![Lengths::default(); seen.len()];
        piles.alone(&dexels, &mut alone);
        let fresh = clump(90, 12);
        for some in fresh.chunks(3) {
            let of = [1, 7, 8].map(|k| (some[0].radius.to_bits() + k) % 40);
            let mut moved = seen.clone();
            for (&j, b) in of.iter().zip(some) {
                moved[j as usize] = dexels.seen(b);
            }
            let both = of.iter().flat_map(|&j| [seen[j as usize], moved[j as usize]]);
            look.region.of(&dexels, both);
            let slow = look.change(&cover, &dexels, &moved);
            let fast = look.exchange(&cover, &piles, &dexels, &of, &moved);
            let close = |x: f64, y: f64| (x - y).abs() < 1e-5 * dexels.target;
            assert!(close(slow.union, fast.union) && close(slow.both, fast.both));
            look.take(&mut cover, &mut piles, &dexels, &moved, &mut alone);
            seen = moved;
        }
        let (mut whole, mut other) = (Cover::new(&dexels).unwrap(), Look::default());
        whole.whole(&dexels, &seen, &mut other);
        for (x, y) in whole.columns.iter().zip(&cover.columns) {
            assert!((x[0] - y[0]).abs() < 1e-3 && (x[1] - y[1]).abs() < 1e-3);
        }
        let mut anew = vec![Lengths::default(); seen.len()];
        other.region.all(&dexels);
        other.alone(&dexels, &seen, 1.0, &mut anew);
        for (x, y) in alone.iter().zip(&anew) {
            assert!((x.union - y.union).abs() < 1e-5 * dexels.target, "{x:?} {y:?}");
            assert!((x.both - y.both).abs() < 1e-5 * dexels.target, "{x:?} {y:?}");
        }
    }
}

#[test]
fn a_change_costs_less_than_nothing_exactly_where_the_goal_falls() {
    let mut random = Random::new(5, 5);
    for overshoot in [0.1, 0.5, 1.0, 2.0, 10.0] {
        for _ in 0..500 {
            let target = random.between(0.5, 2.0);
            // Covered, beyond, and what changes of both.
            let [b, o] = [random.between(0.3, 0.5), random.between(0.0, 0.2)];
            let [db, mut dn] = [0; 2].map(|_| random.between(-0.1, 0.1));
            dn = dn.max(-o);
            let lengths = Lengths { union: b + o, both: b };
            let change = Lengths { union: db + dn, both: db };
            let goal = |b: f64, o: f64| {
                let (missing, beyond) = (target - b, overshoot * o);
                (missing + beyond) / (target + b + beyond)
            };
            let before = lengths.weighed(overshoot).mismatch(target);
            assert!((before - goal(b, o)).abs() < 1e-12);
            let cost = change.weighed(overshoot).cost(before);
            let rise = goal(b + db, o + dn) - goal(b, o);
            // A change of the lengths over what the goal is divided by.
            let by = target + b + db + overshoot * (o + dn);
            assert!((cost / by - rise).abs() < 1e-12, "{overshoot}: {cost} {rise}");
        }
    }
}

/// Of so many balls most chords are left out of the piles, and nothing shows it.
#[test]
fn exchanges_of_many_balls_are_changes() {
    let body = &bodies()[1];
    let dexels = body.dexels(1500);
    let (mut cover, mut piles) = (Cover::new(&dexels).unwrap(), Piles::new(&dexels).unwrap());
    let mut look = Look::default();
    let n = 700;
    let mut random = Random::new(5, 5);
    // All about one place, so that each column has hundreds.
    let mut balls = |n: usize| -> Vec<Seen> {
        let of = |_| {
            let center = [0; 3].map(|_| random.between(0.35, 0.45) as f32);
            dexels.seen(&Ball { center, radius: random.between(0.1, 0.25) as f32 })
        };
        (0..n).map(of).collect()
    };
    let mut seen = balls(n);
    cover.whole(&dexels, &seen, &mut look);
    let by_runs = {
        let mut other = Look::default();
        other.region.all(&dexels);
        other.change(&Cover::new(&dexels).unwrap(), &dexels, &seen)
    };
    assert_eq!(by_runs, Cover::new(&dexels).unwrap().whole(&dexels, &seen, &mut look));
    piles.fill(&dexels, &seen, look.order(&dexels, &seen), u64::MAX).unwrap();
    let all: f64 = seen.iter().map(|s| f64::from(s.r * s.r) * std::f64::consts::PI).sum();
    let least = piles.bytes() as f64 / 12.0;
    assert!(least < 0.3 * all, "{least} of {all} chords");
    let mut alone = vec![Lengths::default(); n];
    piles.alone(&dexels, &mut alone);
    // Few at a time, and so many that columns have to be made anew: those that reach farthest.
    for (k, count) in [3, 12, 40, 12, 200, 5].into_iter().enumerate() {
        let mut of: Vec<u32> = (0..n as u32).collect();
        of.sort_by(|&i, &j| seen[j as usize].r.total_cmp(&seen[i as usize].r));
        of.truncate(count);
        of.sort_unstable();
        let mut moved = seen.clone();
        for (&j, s) in of.iter().zip(balls(count)) {
            moved[j as usize] = Seen { r: if k % 2 == 0 { 0.5 * s.r } else { s.r }, ..s };
        }
        let both = of.iter().flat_map(|&j| [seen[j as usize], moved[j as usize]]);
        look.region.of(&dexels, both);
        let slow = look.change(&cover, &dexels, &moved);
        let fast = look.exchange(&cover, &piles, &dexels, &of, &moved);
        let close = |x: f64, y: f64| (x - y).abs() < 1e-5 * dexels.target;
        assert!(close(slow.union, fast.union) && close(slow.both, fast.both), "{slow:?} {fast:?}");
        look.take(&mut cover, &mut piles, &dexels, &moved, &mut alone);
        seen = moved;
        let mut other = Look::default();
        let mut anew = vec![Lengths::default(); n];
        other.region.all(&dexels);
        other.alone(&dexels, &seen, 1.0, &mut anew);
        for (x, y) in alone.iter().zip(&anew) {
            assert!(close(x.union, y.union) && close(x.both, y.both), "{x:?} {y:?}");
        }
    }
    let mut other = Piles::new(&dexels).unwrap();
    let refused = other.fill(&dexels, &seen, look.order(&dexels, &seen), 1000);
    assert!(matches!(refused, Err(crate::error::Error::MemoryLimit(_))));
}
