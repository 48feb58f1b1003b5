//! Weighted set cover: points with weights, balls that hold them, and the greedy choice of balls
//! (Yuan 2019, algorithm 2).
//!
//! Points lie in chunks of 64 that are close together, one bit each: a chunk that a ball misses
//! or holds whole is not looked at point by point. Chunks stand in a tree of eights, whose boxes
//! are compared with a ball together; those without a point left are passed over. Weights are whole
//! numbers, so that sums do not depend on their order and the lazy choice is that of the plain
//! algorithm.

use super::ball::Ball;
use super::lazy::Lazy;
use crate::error::{Result, collected, reserve};
use crate::run::Pool;
use wide::f32x8;

/// A point and its weight.
pub(super) type Point = ([f32; 3], u32);

/// Balls that a thread takes at once.
const CHUNK: usize = 128;
/// Where boxes stand that are none.
const NOWHERE: f32 = 1e15;

/// Points, and which of them no ball holds yet.
#[derive(Clone)]
pub(super) struct Points {
    chunks: Vec<Chunk>,
    /// Points of each chunk that no ball holds.
    left: Vec<u64>,
    /// Over each eight of the level below, the first over chunks, the last a single one.
    levels: Vec<Vec<Eight>>,
}

#[derive(Debug, Clone, Copy)]
struct Box {
    low: [f32; 3],
    high: [f32; 3],
}

/// Eight boxes, and the weight of the points in each that no ball holds.
#[derive(Clone)]
struct Eight {
    low: [f32x8; 3],
    high: [f32x8; 3],
    left: [u64; 8],
    /// A bit for each of which that is not 0.
    open: u32,
}

#[derive(Clone)]
struct Chunk {
    points: [[f32x8; 3]; 8],
    weights: Weights,
}

#[derive(Clone)]
enum Weights {
    Same(u32),
    Each(std::boxed::Box<[u32; 64]>),
}

impl Box {
    const EMPTY: Box = Box { low: [f32::MAX; 3], high: [f32::MIN; 3] };

    fn add(&mut self, other: &Box) {
        for a in 0..3 {
            self.low[a] = self.low[a].min(other.low[a]);
            self.high[a] = self.high[a].max(other.high[a]);
        }
    }

    fn of<'a>(all: impl IntoIterator<Item = &'a Box>) -> Box {
        let mut bounds = Box::EMPTY;
        all.into_iter().for_each(|b| bounds.add(b));
        bounds
    }
}

impl Eight {
    fn new(boxes: &[Box], weights: &[u64]) -> Eight {
        let lanes = |f: &dyn Fn(&Box) -> f32| {
            f32x8::new(std::array::from_fn(|l| boxes.get(l).map_or(NOWHERE, f)))
        };
        let left = std::array::from_fn(|l| weights.get(l).copied().unwrap_or(0));
        Eight {
            low: std::array::from_fn(|a| lanes(&|b| b.low[a])),
            high: std::array::from_fn(|a| lanes(&|b| b.high[a])),
            left,
            open: (0..8).filter(|&l| left[l] > 0).map(|l| 1 << l).sum(),
        }
    }

    /// Which boxes have points left that the ball may hold, and which of these lie in it.
    #[inline(always)]
    fn meets(&self, ball: &Ball) -> (u32, u32) {
        let (mut near, mut far) = (f32x8::ZERO, f32x8::ZERO);
        for a in 0..3 {
            let at = f32x8::splat(ball.center[a]);
            let (x, y) = (self.low[a] - at, at - self.high[a]);
            let out = x.fast_max(y).fast_max(f32x8::ZERO);
            near += out * out;
            let over = x.abs().fast_max(y.abs());
            far += over * over;
        }
        // Rounding must not tell a chunk's points apart from its box: a hair to each side.
        let r2 = ball.radius * ball.radius;
        let met = near.simd_le(f32x8::splat(r2 * 1.00001)).to_bitmask() & self.open;
        (met, far.simd_lt(f32x8::splat(r2 * 0.99999)).to_bitmask() & met)
    }

    fn take(&mut self, lane: usize, weight: u64) {
        self.left[lane] -= weight;
        if self.left[lane] == 0 {
            self.open &= !(1 << lane);
        }
    }
}

/// The numbers of the bits of a mask.
fn bits(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = (mask != 0).then(|| mask.trailing_zeros() as usize)?;
        mask &= mask - 1;
        Some(bit)
    })
}

impl Chunk {
    fn of(some: &[Point]) -> Chunk {
        let at = |i: usize, a: usize| some.get(i).map_or(0.0, |(p, _)| p[a]);
        let lanes = |k: usize, a: usize| f32x8::new(std::array::from_fn(|l| at(8 * k + l, a)));
        let points = std::array::from_fn(|k| std::array::from_fn(|a| lanes(k, a)));
        let weight = |i: usize| some.get(i).map_or(0, |p| p.1);
        let weights = if some.iter().all(|p| p.1 == weight(0)) {
            Weights::Same(weight(0))
        } else {
            Weights::Each(std::boxed::Box::new(std::array::from_fn(weight)))
        };
        Chunk { points, weights }
    }

    #[inline(always)]
    fn held(&self, ball: &Ball) -> u64 {
        let r2 = f32x8::splat(ball.radius * ball.radius);
        let mut bits = 0;
        for (k, p) in self.points.iter().enumerate() {
            // One by one: `map` of arrays is not inlined here.
            let (x, y) = (p[0] - ball.center[0], p[1] - ball.center[1]);
            let z = p[2] - ball.center[2];
            let d2 = x * x + y * y + z * z;
            bits |= u64::from(d2.simd_le(r2).to_bitmask()) << (8 * k);
        }
        bits
    }

    fn weight(&self, bits: u64) -> u64 {
        match &self.weights {
            Weights::Same(w) => u64::from(bits.count_ones()) * u64::from(*w),
            Weights::Each(all) => {
                let (mut rest, mut sum) = (bits, 0);
                while rest != 0 {
                    sum += u64::from(all[rest.trailing_zeros() as usize & 63]);
                    rest &= rest - 1;
                }
                sum
            }
        }
    }
}

impl Points {
    /// Of several sets; points of one set share chunks.
    pub(super) fn new(sets: Vec<Vec<Point>>) -> Result<Points> {
        let what = "the points of the cover";
        let total = sets.iter().map(|s| s.len().div_ceil(64)).sum();
        let mut chunks = reserve(what, total)?;
        let (mut left, mut boxes, mut weights) =
            (reserve(what, total)?, reserve(what, total)?, reserve(what, total)?);
        for mut set in sets {
            gather(&mut set);
            for some in set.chunks(64) {
                let chunk = Chunk::of(some);
                let bits = u64::MAX >> (64 - some.len());
                left.push(bits);
                weights.push(chunk.weight(bits));
                boxes.push(bounds(some));
                chunks.push(chunk);
            }
        }
        let mut levels = Vec::new();
        loop {
            let pairs = boxes.chunks(8).zip(weights.chunks(8));
            let level: Vec<Eight> = collected(what, pairs.map(|(b, w)| Eight::new(b, w)))?;
            let last = level.len() <= 1;
            levels.push(level);
            if last {
                return Ok(Points { chunks, left, levels });
            }
            boxes = collected(what, boxes.chunks(8).map(Box::of))?;
            weights = collected(what, weights.chunks(8).map(|w| w.iter().sum()))?;
        }
    }

    /// Weight of all points that no ball holds.
    pub(super) fn left(&self) -> u64 {
        self.levels.last().and_then(|l| l.first()).map_or(0, |e| e.left.iter().sum())
    }

    /// Calls `f` for each chunk with the bits of its points that the ball holds and none did.
    pub(super) fn held(&self, ball: &Ball, mut f: impl FnMut(usize, u64)) {
        self.below(self.levels.len(), 0, ball, &mut f);
    }

    fn below(&self, level: usize, at: usize, ball: &Ball, f: &mut impl FnMut(usize, u64)) {
        let Some(eight) = self.levels.get(level - 1).and_then(|l| l.get(at)) else { return };
        let (met, within) = eight.meets(ball);
        for lane in bits(met) {
            let k = 8 * at + lane;
            if level > 1 {
                self.below(level - 1, k, ball, f);
            } else if within >> lane & 1 == 1 {
                f(k, self.left[k]);
            } else {
                f(k, self.chunks[k].held(ball) & self.left[k]);
            }
        }
    }

    /// Weight of the points that the ball holds and no other does yet.
    pub(super) fn gain(&self, ball: &Ball) -> u64 {
        self.gain_below(self.levels.len(), 0, ball)
    }

    fn gain_below(&self, level: usize, at: usize, ball: &Ball) -> u64 {
        let Some(eight) = self.levels.get(level - 1).and_then(|l| l.get(at)) else { return 0 };
        let (met, within) = eight.meets(ball);
        let whole: u64 = bits(within).map(|lane| eight.left[lane]).sum();
        let parts = bits(met & !within).map(|lane| {
            let k = 8 * at + lane;
            match level {
                1 => self.chunks[k].weight(self.chunks[k].held(ball) & self.left[k]),
                _ => self.gain_below(level - 1, k, ball),
            }
        });
        whole + parts.sum::<u64>()
    }

    /// The ball's points are held from now on.
    pub(super) fn hold(&mut self, ball: &Ball) {
        let mut held = Vec::new();
        self.held(ball, |k, bits| held.push((k, bits)));
        for (k, bits) in held {
            let weight = self.chunks[k].weight(bits);
            self.left[k] &= !bits;
            let mut at = k;
            for level in &mut self.levels {
                level[at / 8].take(at % 8, weight);
                at /= 8;
            }
        }
    }
}

/// The choice, one ball after the other.
pub(super) struct Choice {
    points: Points,
    balls: Vec<Ball>,
    lazy: Lazy,
    /// Gains counted.
    pub counts: u64,
}

impl Choice {
    pub(super) fn new(points: Points, balls: Vec<Ball>, pool: &Pool) -> Result<Choice> {
        let chunks: Vec<&[Ball]> = balls.chunks(CHUNK).collect();
        let gains = pool.map(chunks.len(), |i| {
            let some = chunks.get(i).copied().unwrap_or_default();
            some.iter().map(|b| points.gain(b)).collect::<Vec<u64>>()
        });
        let lazy = Lazy::counted(gains.into_iter().flatten(), balls.len())?;
        let counts = balls.len() as u64;
        Ok(Choice { points, balls, lazy, counts })
    }

    /// The ball that holds the greatest weight that those before do not, the first of equal ones,
    /// and that weight; `None` when no ball holds more.
    pub(super) fn next(&mut self) -> Option<(usize, u64)> {
        let Choice { points, balls, lazy, counts } = self;
        let (i, gain) = lazy.best(|i| {
            *counts += 1;
            points.gain(&balls[i])
        })?;
        points.hold(&balls[i]);
        Some((i, gain))
    }
}

/// Up to `n` of `balls`, each the one that holds most points that those before do not; their
/// numbers.
pub(super) fn choose(points: Vec<[f32; 3]>, balls: &[Ball], n: usize) -> Result<Vec<usize>> {
    let mut set: Vec<Point> = reserve("the points of the cover", points.len())?;
    set.extend(points.into_iter().map(|p| (p, 1)));
    let mut copies = reserve("candidates", balls.len())?;
    copies.extend_from_slice(balls);
    let mut choice = Choice::new(Points::new(vec![set])?, copies, &Pool::serial())?;
    let mut chosen = reserve("balls", n.min(balls.len()))?;
    chosen.extend(std::iter::from_fn(|| choice.next()).map(|(i, _)| i).take(n));
    Ok(chosen)
}

fn bounds(points: &[Point]) -> Box {
    let mut bounds = Box::EMPTY;
    points.iter().for_each(|(p, _)| bounds.add(&Box { low: *p, high: *p }));
    bounds
}

/// Sorts so that points next to each other in the list are next to each other in space: halves
/// across the longest extent, in whole chunks.
fn gather(points: &mut [Point]) {
    if points.len() <= 64 {
        return;
    }
    let bounds = bounds(points);
    let extent = |a: usize| bounds.high[a] - bounds.low[a];
    let longest = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let half = points.len().div_ceil(128) * 64;
    points.select_nth_unstable_by(half, |p, q| p.0[longest].total_cmp(&q.0[longest]));
    let (low, high) = points.split_at_mut(half);
    gather(low);
    gather(high);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cmp::Reverse;

    struct Noise(u64);

    impl Noise {
        fn unit(&mut self) -> f32 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (self.0 >> 40) as f32 / (1u64 << 24) as f32
        }

        fn point(&mut self) -> [f32; 3] {
            [0; 3].map(|_| self.unit())
        }
    }

    fn holds(b: &Ball, p: &[f32; 3]) -> bool {
        let [x, y, z] = [0, 1, 2].map(|a| p[a] - b.center[a]);
        x * x + y * y + z * z <= b.radius * b.radius
    }

    /// As `Choice`, with every gain counted anew each time, point by point.
    fn naive(points: &[Point], balls: &[Ball]) -> Vec<(usize, u64)> {
        let mut left: Vec<Point> = points.to_vec();
        let mut chosen = Vec::new();
        loop {
            let held = |b: &Ball| {
                let some = left.iter().filter(|(p, _)| holds(b, p));
                some.map(|(_, w)| u64::from(*w)).sum::<u64>()
            };
            let best = balls.iter().map(held).enumerate().max_by_key(|&(i, g)| (g, Reverse(i)));
            let Some((i, gain @ 1..)) = best else { return chosen };
            left.retain(|(p, _)| !holds(&balls[i], p));
            chosen.push((i, gain));
        }
    }

    #[test]
    fn lazy_is_naive_with_any_weights() {
        for (seed, sizes) in [(1, [1, 0]), (2, [64, 65]), (3, [700, 130]), (4, [1500, 900])] {
            let mut noise = Noise(seed);
            let mut set = |n: usize, same: bool| -> Vec<Point> {
                let mut point =
                    || (noise.point(), 1 + (if same { 7.0 } else { 9.0 * noise.unit() }) as u32);
                (0..n).map(|_| point()).collect()
            };
            let sets = vec![set(sizes[0], true), set(sizes[1], false)];
            let all: Vec<Point> = sets.iter().flatten().copied().collect();
            let balls: Vec<Ball> = (0..160)
                .map(|i| Ball { center: noise.point(), radius: [0.05, 0.1, 0.2, 0.35][i % 4] })
                .flat_map(|b| [b, b])
                .collect();
            let expected = naive(&all, &balls);
            for threads in [1, 2] {
                let pool = Pool::new(threads).unwrap();
                let mut choice =
                    Choice::new(Points::new(sets.clone()).unwrap(), balls.clone(), &pool).unwrap();
                let total = choice.points.left();
                assert_eq!(total, all.iter().map(|p| u64::from(p.1)).sum::<u64>());
                let mut chosen = Vec::new();
                while let Some(next) = choice.next() {
                    chosen.push(next);
                }
                assert_eq!(chosen, expected);
                let gains: u64 = chosen.iter().map(|c| c.1).sum();
                assert_eq!(choice.points.left(), total - gains);
            }
        }
    }

    #[test]
    fn few_gains_are_counted_twice() {
        let mut noise = Noise(9);
        let points: Vec<Point> = (0..4000).map(|_| (noise.point(), 5)).collect();
        let balls: Vec<Ball> =
            (0..1000).map(|_| Ball { center: noise.point(), radius: 0.08 }).collect();
        let points = Points::new(vec![points]).unwrap();
        let mut choice = Choice::new(points, balls, &Pool::serial()).unwrap();
        for _ in 0..100 {
            assert!(choice.next().is_some());
        }
        assert!(choice.counts < 6000, "{}", choice.counts);
    }
}
