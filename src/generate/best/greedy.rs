//! Greedy cover of points by balls: each time the ball that holds most points not yet held.
//!
//! Points lie in chunks of 64 that are close together, one bit each: a chunk that a ball misses
//! or holds whole is not looked at point by point. A gain only falls while others are chosen, so
//! the gains of most balls need not be brought up to date (Minoux 1978).

use super::ball::Ball;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use wide::f32x8;

/// Chunks of points under one box.
const GROUP: usize = 16;

/// Points that are not held yet.
pub(super) struct Points {
    chunks: Vec<Chunk>,
    groups: Vec<Box>,
    left: Vec<u64>,
    /// Gains counted.
    pub counts: u64,
}

#[derive(Debug, Clone, Copy)]
struct Box {
    low: [f32; 3],
    high: [f32; 3],
}

struct Chunk {
    bounds: Box,
    points: [[f32x8; 3]; 8],
}

/// How a box lies to a ball.
enum Lies {
    Out,
    In,
    Across,
}

impl Box {
    const EMPTY: Box = Box { low: [f32::MAX; 3], high: [f32::MIN; 3] };

    fn add(&mut self, other: &Box) {
        for a in 0..3 {
            self.low[a] = self.low[a].min(other.low[a]);
            self.high[a] = self.high[a].max(other.high[a]);
        }
    }

    #[inline(always)]
    fn lies(&self, ball: &Ball) -> Lies {
        let (mut near, mut far) = (0.0f32, 0.0f32);
        for a in 0..3 {
            let (x, y) = (self.low[a] - ball.center[a], ball.center[a] - self.high[a]);
            let out = x.max(y).max(0.0);
            near += out * out;
            let over = x.abs().max(y.abs());
            far += over * over;
        }
        // Rounding must not tell a chunk's points apart from its box: a hair to each side.
        let r2 = ball.radius * ball.radius;
        if near > r2 * 1.00001 {
            Lies::Out
        } else if far < r2 * 0.99999 {
            Lies::In
        } else {
            Lies::Across
        }
    }
}

impl Points {
    pub(super) fn new(mut points: Vec<[f32; 3]>) -> Points {
        gather(&mut points);
        let mut chunks = Vec::with_capacity(points.len().div_ceil(64));
        let mut left = Vec::with_capacity(chunks.capacity());
        for some in points.chunks(64) {
            let mut bounds = Box::EMPTY;
            some.iter().for_each(|p| bounds.add(&Box { low: *p, high: *p }));
            let at = |i: usize, a: usize| some.get(i).map_or(0.0, |p| p[a]);
            let lanes = |k: usize, a: usize| f32x8::new(std::array::from_fn(|l| at(8 * k + l, a)));
            let points = std::array::from_fn(|k| std::array::from_fn(|a| lanes(k, a)));
            chunks.push(Chunk { bounds, points });
            left.push(u64::MAX >> (64 - some.len()));
        }
        let groups = chunks.chunks(GROUP).map(|some| {
            let mut bounds = Box::EMPTY;
            some.iter().for_each(|c| bounds.add(&c.bounds));
            bounds
        });
        Points { groups: groups.collect(), chunks, left, counts: 0 }
    }

    /// Number of points not held.
    #[cfg(test)]
    pub(super) fn left(&self) -> u32 {
        self.left.iter().map(|l| l.count_ones()).sum()
    }

    /// Calls `f` for each chunk with the bits of its points in the ball.
    fn held(&self, ball: &Ball, mut f: impl FnMut(usize, u64)) {
        for (g, bounds) in self.groups.iter().enumerate() {
            if let Lies::Out = bounds.lies(ball) {
                continue;
            }
            let first = g * GROUP;
            let last = self.chunks.len().min(first + GROUP);
            for (k, chunk) in self.chunks[first..last].iter().enumerate() {
                if self.left[first + k] == 0 {
                    continue;
                }
                match chunk.bounds.lies(ball) {
                    Lies::Out => {}
                    Lies::In => f(first + k, u64::MAX),
                    Lies::Across => f(first + k, chunk.held(ball)),
                }
            }
        }
    }

    /// Number of points that the ball holds and no other does yet.
    pub(super) fn gain(&mut self, ball: &Ball) -> u32 {
        self.counts += 1;
        let mut sum = 0;
        self.held(ball, |k, bits| sum += (bits & self.left[k]).count_ones());
        sum
    }

    /// The ball's points are held from now on.
    pub(super) fn hold(&mut self, ball: &Ball) {
        let mut held = Vec::new();
        self.held(ball, |k, bits| held.push((k, bits)));
        for (k, bits) in held {
            self.left[k] &= !bits;
        }
    }
}

impl Chunk {
    #[inline(always)]
    fn held(&self, ball: &Ball) -> u64 {
        let r2 = f32x8::splat(ball.radius * ball.radius);
        let mut bits = 0;
        for (k, p) in self.points.iter().enumerate() {
            let [x, y, z] = [0, 1, 2].map(|a| p[a] - ball.center[a]);
            let d2 = x * x + y * y + z * z;
            bits |= u64::from(d2.simd_le(r2).to_bitmask()) << (8 * k);
        }
        bits
    }
}

/// Up to `n` of `balls`, each the one that holds most points that those before do not; the first
/// of equal ones. Ends when none holds a further point. Their numbers.
pub(super) fn choose(points: &mut Points, balls: &[Ball], n: usize) -> Vec<usize> {
    let mut heap: BinaryHeap<(u32, Reverse<usize>)> =
        balls.iter().enumerate().map(|(i, b)| (points.gain(b), Reverse(i))).collect();
    let mut chosen = Vec::with_capacity(n);
    // For how many chosen balls each gain was counted.
    let mut counted = vec![0usize; balls.len()];
    while chosen.len() < n {
        let Some((gain, Reverse(i))) = heap.pop() else { break };
        if gain == 0 {
            break;
        }
        if counted[i] == chosen.len() {
            points.hold(&balls[i]);
            chosen.push(i);
        } else {
            counted[i] = chosen.len();
            heap.push((points.gain(&balls[i]), Reverse(i)));
        }
    }
    chosen
}

/// Sorts so that points next to each other in the list are next to each other in space: halves
/// across the longest extent, in whole chunks.
fn gather(points: &mut [[f32; 3]]) {
    if points.len() <= 64 {
        return;
    }
    let mut bounds = Box::EMPTY;
    points.iter().for_each(|p| bounds.add(&Box { low: *p, high: *p }));
    let extent = |a: usize| bounds.high[a] - bounds.low[a];
    let longest = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let half = points.len().div_ceil(128) * 64;
    points.select_nth_unstable_by(half, |p, q| p[longest].total_cmp(&q[longest]));
    let (low, high) = points.split_at_mut(half);
    gather(low);
    gather(high);
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    fn point(random: &mut Random) -> [f32; 3] {
        [0; 3].map(|_| random.unit() as f32)
    }

    fn holds(b: &Ball, p: &[f32; 3]) -> bool {
        let [x, y, z] = [0, 1, 2].map(|a| p[a] - b.center[a]);
        x * x + y * y + z * z <= b.radius * b.radius
    }

    /// As `choose`, with every gain counted anew each time, point by point.
    fn naive(points: &[[f32; 3]], balls: &[Ball], n: usize) -> Vec<usize> {
        let mut left: Vec<[f32; 3]> = points.to_vec();
        let mut chosen = Vec::new();
        while chosen.len() < n {
            let gain = |b: &Ball| left.iter().filter(|p| holds(b, p)).count();
            let best = balls.iter().map(gain).enumerate().max_by_key(|&(i, g)| (g, Reverse(i)));
            let Some((i, 1..)) = best else { break };
            left.retain(|p| !holds(&balls[i], p));
            chosen.push(i);
        }
        chosen
    }

    #[test]
    fn lazy_is_naive() {
        for (seed, n_points) in [(1, 1), (2, 64), (3, 65), (4, 700), (5, 2500)] {
            let mut random = Random::new(seed, 0);
            let points: Vec<[f32; 3]> = (0..n_points).map(|_| point(&mut random)).collect();
            let balls: Vec<Ball> = (0..200)
                .map(|i| Ball {
                    center: point(&mut random),
                    // Some twice, so that there are ties.
                    radius: [0.05, 0.1, 0.2, 0.35][i % 4],
                })
                .flat_map(|b| [b, b])
                .collect();
            let mut lazy = Points::new(points.clone());
            let chosen = choose(&mut lazy, &balls, 60);
            assert_eq!(chosen, naive(&points, &balls, 60));
            let held = |p: &[f32; 3]| chosen.iter().any(|&i| holds(&balls[i], p));
            assert_eq!(lazy.left() as usize, points.iter().filter(|p| !held(p)).count());
        }
    }

    #[test]
    fn few_gains_are_counted_twice() {
        let mut random = Random::new(9, 0);
        let mut points = Points::new((0..4000).map(|_| point(&mut random)).collect());
        let balls: Vec<Ball> =
            (0..1000).map(|_| Ball { center: point(&mut random), radius: 0.08 }).collect();
        let chosen = choose(&mut points, &balls, 100);
        assert_eq!(chosen.len(), 100);
        assert!(points.counts < 6000, "{}", points.counts);
    }
}
