//! One piece: spheres that hang together by overlaps. Where the closest clump falls into parts, they
//! are joined in the way that costs least, and no move or refinement parts them again.

use super::state::State;
use super::watch::Watch;
use crate::error::{Result, reserve};
use crate::generate::ball::Ball;
use crate::generate::balls::cover::Look;
use crate::generate::balls::dexels::Seen;
use crate::generate::balls::near::Near;
use crate::math::{Sphere, Vec3};
use crate::measure::tree::Tree;

/// How deep an overlap holds, as a part of the smaller radius: rounding, in a solver's own numbers
/// as well, must not part spheres.
const HOLDS: f32 = 0.01;
/// How deep overlaps are made.
const MADE: f32 = 0.03;
/// How many spheres may be put between two that are apart, and how much larger their radii are than
/// half their part of the gap.
const CHAINS: [usize; 7] = [1, 2, 3, 5, 8, 13, 21];
const BRIDGES: [f32; 3] = [1.1, 1.5, 2.5];

fn hold(a: &Ball, b: &Ball) -> bool {
    a.meets(b, -HOLDS * a.radius.min(b.radius))
}

/// The part of each ball, by the number of one ball in it, and how many parts there are.
pub(super) fn parts(balls: &[Ball], near: &mut Near) -> (Vec<u32>, usize) {
    let all: Vec<u32> = (0..balls.len() as u32).collect();
    near.make(balls, &all, 0.0);
    group(balls.len(), |k| {
        near.of(k).iter().copied().filter(move |&j| hold(&balls[k], &balls[j as usize]))
    })
}

/// As [`parts`], of the spheres that the caller gets.
pub(super) fn count(spheres: &[Sphere]) -> Result<usize> {
    let holds = |a: &Sphere, b: &Sphere| {
        let depth = 0.5 * f64::from(HOLDS) * a.radius.min(b.radius);
        (a.center - b.center).norm() < a.radius + b.radius - depth
    };
    let tree = Tree::new(spheres, |_| true)?;
    let beside = |k: usize| {
        let s = &spheres[k];
        let r = Vec3::repeat(s.radius);
        let (lo, hi) = (s.center - r, s.center + r);
        let mut found = Vec::new();
        tree.any(
            |l, h| (0..3).all(|a| l[a] <= hi[a] && lo[a] <= h[a]),
            |j| {
                if holds(s, &spheres[j as usize]) {
                    found.push(j);
                }
                false
            },
        );
        found.into_iter()
    };
    Ok(group(spheres.len(), beside).1)
}

/// Groups by pairs that hang together.
fn group<I: Iterator<Item = u32>>(n: usize, beside: impl Fn(usize) -> I) -> (Vec<u32>, usize) {
    let mut of = vec![u32::MAX; n];
    let mut found = 0;
    let mut open = Vec::new();
    for first in 0..n {
        if of[first] != u32::MAX {
            continue;
        }
        found += 1;
        of[first] = first as u32;
        open.push(first);
        while let Some(k) = open.pop() {
            for j in beside(k) {
                if of[j as usize] == u32::MAX {
                    of[j as usize] = first as u32;
                    open.push(j as usize);
                }
            }
        }
    }
    (of, found)
}

/// How many parts there are with the balls `new` in the place of those with the numbers `of`.
/// `near`: the lists of the balls as they are, of which `part` are the parts.
fn parts_after(balls: &[Ball], near: &Near, (of, new): (&[u32], &[Ball])) -> usize {
    let mut slots = vec![u32::MAX; balls.len()];
    for (k, &j) in (0u32..).zip(of) {
        slots[j as usize] = k;
    }
    let now = |j: u32| match slots[j as usize] {
        u32::MAX => &balls[j as usize],
        k => &new[k as usize],
    };
    // Who hangs together with a changed ball.
    let mut beside: Vec<Vec<u32>> = vec![Vec::new(); of.len()];
    let mut also: Vec<Vec<u32>> = vec![Vec::new(); balls.len()];
    for (k, &i) in of.iter().enumerate() {
        for j in (0..balls.len() as u32).filter(|&j| j != i && hold(&new[k], now(j))) {
            beside[k].push(j);
            also[j as usize].push(i);
        }
    }
    let (none, still): (&[u32], _) = (&[], |j: u32| slots[j as usize] == u32::MAX);
    let found = group(balls.len(), |i| {
        let (listed, more) = match slots[i] {
            u32::MAX => (near.of(i), &also[i]),
            k => (none, &beside[k as usize]),
        };
        let held = move |&j: &u32| still(j) && hold(&balls[i], &balls[j as usize]);
        listed.iter().copied().filter(held).chain(more.iter().copied())
    });
    found.1
}

/// Joins the parts of a clump, as many as the limits allow; returns how many there are then.
pub(super) fn join(state: &mut State, look: &mut Look, watch: &Watch) -> Result<usize> {
    let mut near = Near::default();
    let mut seen: Vec<Seen> = Vec::new();
    loop {
        let (part, count) = parts(&state.balls, &mut near);
        if count < 2 || !watch.go() {
            return Ok(count);
        }
        let Some(pair) = closest(&state.balls, &part)? else { return Ok(count) };
        let mut best: Option<(f64, Vec<u32>, Vec<Ball>)> = None;
        for mut balls in ways(state, &part, pair) {
            if !watch.go() {
                return Ok(count);
            }
            state.orbits.even(&state.balls, &mut balls);
            let differs = |&j: &u32| balls[j as usize] != state.balls[j as usize];
            let of: Vec<u32> = (0..balls.len() as u32).filter(differs).collect();
            let new: Vec<Ball> = of.iter().map(|&j| balls[j as usize]).collect();
            if parts_after(&state.balls, &near, (&of, &new)) >= count {
                continue;
            }
            seen.clone_from(&state.seen);
            for (&j, ball) in of.iter().zip(&new) {
                seen[j as usize] = state.ground.dexels.seen(ball);
            }
            let cost = state.price(&of, &seen, 1, look);
            if best.as_ref().is_none_or(|b| cost < b.0) {
                best = Some((cost, of, new));
            }
        }
        let Some((_, of, new)) = best else { return Ok(count) };
        state.put(&of, &new, look);
    }
}

/// The two balls with the least gap of which one is in the smallest part and the other is not.
fn closest(balls: &[Ball], part: &[u32]) -> Result<Option<[usize; 2]>> {
    let mut sizes = vec![0u32; balls.len()];
    part.iter().for_each(|&p| sizes[p as usize] += 1);
    let smallest = (0..balls.len()).filter(|&p| sizes[p] > 0).min_by_key(|&p| sizes[p]);
    let Some(small) = smallest.map(|p| p as u32) else { return Ok(None) };
    let mut spheres = reserve("spheres", balls.len())?;
    spheres.extend(balls.iter().map(|b| b.sphere()));
    let tree = Tree::new(&spheres, |j| part[j] != small)?;
    let mut best = (f32::MAX, [0; 2]);
    for i in (0..balls.len()).filter(|&i| part[i] == small) {
        let p = spheres[i].center;
        let away = |j: u32| {
            let s = &spheres[j as usize];
            ((s.center - p).norm() - s.radius).max(0.0)
        };
        tree.nearest_first(&p, away, |j, _| {
            let j = j as usize;
            let gap = balls[i].apart(&balls[j]).sqrt() - balls[i].radius - balls[j].radius;
            if gap < best.0 || (gap == best.0 && [i, j] < best.1) {
                best = (gap, [i, j]);
            }
            // Beyond this none is nearer, for all that rounding does.
            (f64::from(best.0) + spheres[i].radius) * (1.0 + 1e-5) + 1e-6
        });
    }
    Ok((best.0 < f32::MAX).then_some(best.1))
}

/// Clumps in which the balls i and j may hang together: one or both have grown or moved, the part
/// of i has moved, or other balls have come between them.
fn ways(state: &State, part: &[u32], [i, j]: [usize; 2]) -> Vec<Vec<Ball>> {
    let balls = &state.balls;
    let (a, b) = (balls[i], balls[j]);
    let distance = a.apart(&b).sqrt();
    let way = a.way(&b).map(|x| x / distance.max(f32::MIN_POSITIVE));
    let need = distance - a.radius - b.radius + MADE * a.radius.min(b.radius);
    let mut out = Vec::new();
    let mut with = |change: &dyn Fn(&mut Vec<Ball>)| {
        let mut clump = balls.clone();
        change(&mut clump);
        for (new, old) in clump.iter_mut().zip(balls) {
            if new != old {
                let radii = &state.ground.radii;
                new.radius = new.radius.max(radii.least).min(radii.most);
                state.ground.limits.hold(state.ground.field, radii, new);
            }
        }
        out.push(clump);
    };
    let moved = |ball: &mut Ball, by: f32| {
        ball.center.iter_mut().zip(way).for_each(|(x, w)| *x += by * w);
    };
    for share in [0.0, 0.5, 1.0] {
        with(&|clump| {
            // All images of a ball grow with it.
            for (k, by) in [(i, share * need), (j, (1.0 - share) * need)] {
                let radius = balls[k].radius + by;
                for image in state.orbits.balls(&[state.orbits.lead(k as u32)]) {
                    clump[image as usize].radius = radius;
                }
            }
        });
    }
    if state.orbits.sites().is_some() {
        return out;
    }
    for share in [0.0, 0.5, 1.0] {
        with(&|clump| {
            moved(&mut clump[i], share * need);
            moved(&mut clump[j], (share - 1.0) * need);
        });
        // Half of it by growing, half by moving.
        with(&|clump| {
            moved(&mut clump[i], 0.5 * share * need);
            moved(&mut clump[j], 0.5 * (share - 1.0) * need);
            clump[i].radius += 0.25 * need;
            clump[j].radius += 0.25 * need;
        });
    }
    with(&|clump| {
        for (ball, p) in clump.iter_mut().zip(part) {
            if *p == part[i] {
                moved(ball, need);
            }
        }
    });
    // Those that are worth least may be spared for a chain across the gap.
    let mut spare: Vec<usize> = (0..balls.len()).filter(|&k| k != i && k != j).collect();
    spare.sort_by(|&x, &y| state.worth(x).total_cmp(&state.worth(y)));
    for links in CHAINS.into_iter().filter(|&m| 2 * m <= balls.len()) {
        for wide in BRIDGES {
            with(&|clump| {
                for (k, &spared) in spare.iter().take(links).enumerate() {
                    let radius = 0.5 * need / links as f32;
                    let mut ball = Ball { center: a.center, radius: wide * radius };
                    moved(&mut ball, a.radius + (2 * k + 1) as f32 * radius);
                    clump[spared] = ball;
                }
            });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::balls::random::Random;
    use crate::math::Vec3;

    #[test]
    fn parts_are_those_of_a_search_from_each_ball() {
        let mut random = Random::new(3, 0);
        for n in [1, 7, 60, 300] {
            let edge = (n as f64).cbrt();
            let balls: Vec<Ball> = (0..n)
                .map(|_| Ball {
                    center: [0; 3].map(|_| (edge * random.unit()) as f32),
                    radius: random.between(0.1, 0.55) as f32,
                })
                .collect();
            let (of, found) = parts(&balls, &mut Near::default());
            // Whether b can be reached from a, by Warshall's closure.
            let mut reach: Vec<Vec<bool>> = balls
                .iter()
                .map(|a| balls.iter().map(|b| a == b || hold(a, b)).collect())
                .collect();
            for k in 0..n {
                let onward = reach[k].clone();
                for from in reach.iter_mut().filter(|from| from[k]) {
                    from.iter_mut().zip(&onward).for_each(|(to, &there)| *to |= there);
                }
            }
            for i in 0..n {
                assert!((0..n).all(|j| reach[i][j] == (of[i] == of[j])));
            }
            let firsts = (0..n).filter(|&i| (0..i).all(|j| !reach[i][j])).count();
            assert_eq!(found, firsts);
            let spheres: Vec<Sphere> = balls.iter().map(|b| b.sphere()).collect();
            assert!(count(&spheres).unwrap() <= found);
        }
    }

    #[test]
    fn spheres_that_only_touch_do_not_hold() {
        let at = |x: f64| Sphere::new(Vec3::new(x, 0.0, 0.0), 0.5);
        assert_eq!(count(&[at(0.0), at(1.0), at(1.9)]).unwrap(), 2);
        assert_eq!(count(&[at(0.0), at(0.99), at(1.9)]).unwrap(), 1);
    }

    #[test]
    fn the_closest_pair_and_parts_after_a_change_are_as_by_all_pairs() {
        let mut random = Random::new(6, 0);
        for n in [2, 30, 400] {
            let edge = 2.0 * (n as f64).cbrt();
            let mut ball = || Ball {
                center: [0; 3].map(|_| (edge * random.unit()) as f32),
                radius: random.between(0.1, 0.9) as f32,
            };
            for _ in 0..5 {
                let mut balls: Vec<Ball> = (0..n).map(|_| ball()).collect();
                let mut near = Near::default();
                let (part, count) = parts(&balls, &mut near);
                if count > 1 {
                    let [i, j] = closest(&balls, &part).unwrap().unwrap();
                    let gap = |i: usize, j: usize| {
                        balls[i].apart(&balls[j]).sqrt() - balls[i].radius - balls[j].radius
                    };
                    let small = part[i];
                    let inside = |k: &usize| part[*k] == small;
                    let size = |p: u32| part.iter().filter(|&&q| q == p).count();
                    assert!(part.iter().all(|&p| size(small) <= size(p)));
                    for a in (0..n).filter(inside) {
                        assert!((0..n).filter(|b| !inside(b)).all(|b| gap(a, b) >= gap(i, j)));
                    }
                }
                let of: Vec<u32> = (0..n as u32).filter(|j| j % 7 == 1).collect();
                let new: Vec<Ball> = of.iter().map(|_| ball()).collect();
                let found = parts_after(&balls, &near, (&of, &new));
                for (&j, new) in of.iter().zip(&new) {
                    balls[j as usize] = *new;
                }
                assert_eq!(found, parts(&balls, &mut near).1);
            }
        }
    }
}
