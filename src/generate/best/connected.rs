//! One piece: spheres that hang together by overlaps. Where the closest clump falls into parts, they
//! are joined in the way that costs least, and no move or refinement parts them again.

use super::state::State;
use super::watch::Watch;
use crate::error::Result;
use crate::generate::ball::Ball;
use crate::generate::balls::cover::Look;
use crate::generate::balls::near::Near;
use crate::math::Sphere;

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
pub(super) fn count(spheres: &[Sphere]) -> usize {
    let holds = |a: &Sphere, b: &Sphere| {
        let depth = 0.5 * f64::from(HOLDS) * a.radius.min(b.radius);
        (a.center - b.center).norm() < a.radius + b.radius - depth
    };
    let beside = |k: usize| {
        (0..spheres.len() as u32).filter(move |&j| holds(&spheres[k], &spheres[j as usize]))
    };
    group(spheres.len(), beside).1
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

/// Joins the parts of a clump, as many as the limits allow; returns how many there are then.
pub(super) fn join(state: &mut State, look: &mut Look, watch: &Watch) -> Result<usize> {
    let mut near = Near::default();
    loop {
        let (part, count) = parts(&state.balls, &mut near);
        if count < 2 || !watch.go() {
            return Ok(count);
        }
        let Some([i, j]) = closest(&state.balls, &part) else { return Ok(count) };
        let mut best: Option<(f64, Vec<Ball>)> = None;
        for mut balls in ways(state, &part, [i, j]) {
            if !watch.go() {
                break;
            }
            state.orbits.even(&state.balls, &mut balls);
            if parts(&balls, &mut near).1 >= count {
                continue;
            }
            let cost = state.cost_of(&balls, look);
            if best.as_ref().is_none_or(|b| cost < b.0) {
                best = Some((cost, balls));
            }
        }
        let Some((_, balls)) = best else { return Ok(count) };
        state.balls = balls;
        state.renew(look)?;
    }
}

/// The two balls with the least gap of which one is in the smallest part and the other is not.
fn closest(balls: &[Ball], part: &[u32]) -> Option<[usize; 2]> {
    let mut sizes = vec![0u32; balls.len()];
    part.iter().for_each(|&p| sizes[p as usize] += 1);
    let small = (0..balls.len()).filter(|&p| sizes[p] > 0).min_by_key(|&p| sizes[p])? as u32;
    let mut best = (f32::MAX, None);
    for i in (0..balls.len()).filter(|&i| part[i] == small) {
        for j in (0..balls.len()).filter(|&j| part[j] != small) {
            let gap = balls[i].apart(&balls[j]).sqrt() - balls[i].radius - balls[j].radius;
            if gap < best.0 {
                best = (gap, Some([i, j]));
            }
        }
    }
    best.1
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
            assert!(count(&spheres) <= found);
        }
    }

    #[test]
    fn spheres_that_only_touch_do_not_hold() {
        let at = |x: f64| Sphere::new(Vec3::new(x, 0.0, 0.0), 0.5);
        assert_eq!(count(&[at(0.0), at(1.0), at(1.9)]), 2);
        assert_eq!(count(&[at(0.0), at(0.99), at(1.9)]), 1);
    }
}
