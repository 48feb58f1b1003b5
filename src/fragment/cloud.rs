//! Points of a fragment, spread evenly, and what balls hold of them: 64 to a chunk, chunks small in
//! space, so that most are within a ball or without at a glance.

use super::room::{Ball, along, times};
use crate::error::{Result, filled, push, reserve};
use wide::f32x8;

/// Cells along an edge of the box by which points are sorted, a power of two.
const CELLS: u32 = 8;
/// Where a point stands that is none.
const NOWHERE: f32 = 1e15;

/// Sixty-four points.
#[derive(Clone)]
pub(super) struct Chunk {
    pub points: [[f32x8; 3]; 8],
}

/// Balls about eight chunks.
pub(super) struct Group {
    center: [f32x8; 3],
    reach: f32x8,
}

impl Group {
    fn of(some: &[[[f32; 3]; 2]]) -> Group {
        let mut reach = [0.0; 8];
        for (to, [_, [r, ..]]) in reach.iter_mut().zip(some) {
            *to = *r;
        }
        let centers = some.iter().map(|[c, _]| c);
        Group { center: eight(centers), reach: f32x8::new(reach) }
    }

    /// Which chunks a ball may hold some of, and which it holds all of; `soft`: half the width of
    /// its border.
    #[inline(always)]
    pub(super) fn meets(&self, ball: &Ball, soft: f32) -> (u32, u32) {
        let [x, y, z] = [
            self.center[0] - ball.center[0],
            self.center[1] - ball.center[1],
            self.center[2] - ball.center[2],
        ];
        let d2 = x * x + y * y + z * z;
        let far = self.reach + (ball.radius + soft);
        let near = f32x8::splat(ball.radius - soft) - self.reach;
        let within = near.simd_gt(f32x8::splat(0.0)) & d2.simd_le(near * near);
        (d2.simd_lt(far * far).to_bitmask(), within.to_bitmask())
    }
}

/// Up to eight points by coordinates.
#[inline(always)]
fn eight<'a>(points: impl Iterator<Item = &'a [f32; 3]>) -> [f32x8; 3] {
    let mut out = [[NOWHERE; 8]; 3];
    for (l, p) in points.take(8).enumerate() {
        (out[0][l], out[1][l], out[2][l]) = (p[0], p[1], p[2]);
    }
    let [x, y, z] = out;
    [f32x8::new(x), f32x8::new(y), f32x8::new(z)]
}

/// The numbers of the bits of a mask.
#[inline(always)]
pub(super) fn bits(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = (mask != 0).then(|| mask.trailing_zeros() as usize)?;
        mask &= mask - 1;
        Some(bit)
    })
}

/// Middle and reach of some points.
fn about(some: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let mut sum = [0.0f32; 3];
    for p in some {
        sum = along(&sum, 1.0, p);
    }
    let center = times(&sum, 1.0 / some.len().max(1) as f32);
    let ball = Ball { center, radius: 0.0 };
    let mut reach = 0.0f32;
    for p in some {
        reach = reach.max(ball.apart(p));
    }
    let reach = reach.sqrt();
    [center, [reach * 1.00001 + f32::MIN_POSITIVE; 3]]
}

impl Chunk {
    fn of(some: &[[f32; 3]]) -> Chunk {
        let mut points = [[f32x8::splat(NOWHERE); 3]; 8];
        for (to, some) in points.iter_mut().zip(some.chunks(8)) {
            *to = eight(some.iter());
        }
        Chunk { points }
    }

    #[inline]
    fn point(&self, i: usize) -> [f32; 3] {
        let [x, y, z] = &self.points[i >> 3 & 7];
        let of = |lanes: &f32x8| lanes.as_array()[i & 7];
        [of(x), of(y), of(z)]
    }

    #[inline]
    fn held(&self, ball: &Ball) -> u64 {
        let r2 = f32x8::splat(ball.radius * ball.radius);
        let mut bits = 0;
        for (k, p) in self.points.iter().enumerate() {
            let (x, y) = (p[0] - ball.center[0], p[1] - ball.center[1]);
            let z = p[2] - ball.center[2];
            let d2 = x * x + y * y + z * z;
            bits |= u64::from(d2.simd_le(r2).to_bitmask()) << (8 * k);
        }
        bits
    }
}

/// The points.
pub(super) struct Cloud {
    pub chunks: Vec<Chunk>,
    /// Over each eight of them.
    pub groups: Vec<Group>,
    /// Points that no chosen ball holds.
    left: Vec<u64>,
    len: usize,
}

impl Cloud {
    /// Of points within a box about the origin, by half its edges.
    pub(super) fn new(points: &[[f32; 3]], half: [f32; 3]) -> Result<Cloud> {
        Cloud::of_sorted(&sorted(points, half)?)
    }

    fn of_sorted(sorted: &[[f32; 3]]) -> Result<Cloud> {
        let mut cloud = Cloud {
            chunks: reserve("points", sorted.len().div_ceil(64))?,
            groups: reserve("points", sorted.len().div_ceil(512))?,
            left: reserve("points", sorted.len().div_ceil(64))?,
            len: sorted.len(),
        };
        for some in sorted.chunks(64) {
            cloud.left.push(u64::MAX >> (64 - some.len()));
            cloud.chunks.push(Chunk::of(some));
        }
        for some in sorted.chunks(512) {
            let mut balls = [[[0.0; 3]; 2]; 8];
            let count = some.len().div_ceil(64);
            balls.iter_mut().zip(some.chunks(64)).for_each(|(b, points)| *b = about(points));
            cloud.groups.push(Group::of(&balls[..count]));
        }
        Ok(cloud)
    }

    /// Those left alone, when fewer than half are.
    fn rest(&self) -> Result<Option<Cloud>> {
        let count = self.left.iter().map(|l| l.count_ones() as usize).sum::<usize>();
        if 2 * count >= self.len {
            return Ok(None);
        }
        let mut rest = reserve("points", count)?;
        for (chunk, left) in self.chunks.iter().zip(&self.left) {
            for (from, half) in [(0, *left as u32), (32, (left >> 32) as u32)] {
                for k in bits(half) {
                    rest.push(chunk.point(from + k));
                }
            }
        }
        Cloud::of_sorted(&rest).map(Some)
    }

    /// Points that the ball holds and no chosen one.
    pub(super) fn gain(&self, ball: &Ball) -> u32 {
        let mut sum = 0;
        let groups = self.groups.iter().zip(self.chunks.chunks(8)).zip(self.left.chunks(8));
        for ((group, chunks), left) in groups {
            let (met, within) = group.meets(ball, 0.0);
            for k in bits(met) {
                let (Some(chunk), Some(&left)) = (chunks.get(k), left.get(k)) else { continue };
                if left != 0 {
                    let held = if within >> k & 1 == 1 { u64::MAX } else { chunk.held(ball) };
                    sum += (held & left).count_ones();
                }
            }
        }
        sum
    }

    /// The ball is chosen.
    pub(super) fn choose(&mut self, ball: &Ball) {
        let groups = self.groups.iter().zip(self.chunks.chunks(8)).zip(self.left.chunks_mut(8));
        for ((group, chunks), left) in groups {
            for k in bits(group.meets(ball, 0.0).0) {
                if let (Some(chunk), Some(left)) = (chunks.get(k), left.get_mut(k)) {
                    *left &= !chunk.held(ball);
                }
            }
        }
    }
}

/// By cells, and these along a curve of Morton's.
fn sorted(points: &[[f32; 3]], half: [f32; 3]) -> Result<Vec<[f32; 3]>> {
    let scale = half.map(|h| 0.5 * CELLS as f32 / h.max(f32::MIN_POSITIVE));
    let spread = |x: u32| x & 1 | (x & 2) << 2 | (x & 4) << 4;
    let cell = |p: &[f32; 3]| {
        let of = |a: usize| (((p[a] + half[a]) * scale[a]).max(0.0) as u32).min(CELLS - 1);
        (spread(of(0)) | spread(of(1)) << 1 | spread(of(2)) << 2) as usize
    };
    let mut starts = [0u32; (CELLS * CELLS * CELLS) as usize + 1];
    for p in points {
        starts[cell(p) + 1] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += *start;
        *start = sum;
    }
    let mut out = filled("points", points.len(), [0.0; 3])?;
    for p in points {
        let to = &mut starts[cell(p)];
        out[*to as usize] = *p;
        *to += 1;
    }
    Ok(out)
}

/// Up to `n` of `balls`, each the one that holds most points that those before do not (Minoux
/// 1978: a gain counted earlier is a bound); their numbers. `bound` is of the first gains.
pub(super) fn choose(
    cloud: &mut Cloud,
    balls: &[Ball],
    n: usize,
    bound: impl Fn(&Ball) -> u32,
) -> Result<Vec<usize>> {
    use std::cmp::Reverse;
    use std::collections::BinaryHeap;
    let mut heap = reserve("candidates", balls.len())?;
    heap.extend(balls.iter().enumerate().map(|(i, b)| (bound(b), Reverse(i), usize::MAX)));
    let mut heap = BinaryHeap::from(heap);
    let mut chosen: Vec<usize> = Vec::new();
    // Points that no chosen ball holds, when they are few.
    let mut rest: Option<Cloud> = None;
    while chosen.len() < n
        && let Some((gain, Reverse(i), counted)) = heap.pop()
    {
        let Some(ball) = balls.get(i).filter(|_| gain > 0) else { break };
        let left = rest.as_mut().unwrap_or(&mut *cloud);
        // Those chosen since it was counted may not touch it.
        let since = chosen.get(counted..).map(|since| {
            since.iter().filter_map(|&j| balls.get(j)).any(|other| {
                let touch = ball.radius + other.radius;
                other.apart(&ball.center) < touch * touch
            })
        });
        if since == Some(false) {
            left.choose(ball);
            let fewer = left.rest()?;
            if fewer.is_some() {
                rest = fewer;
            }
            push("spheres", &mut chosen, i)?;
        } else {
            heap.push((left.gain(ball), Reverse(i), chosen.len()));
        }
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use super::super::spread::Random;
    use super::*;

    #[test]
    fn the_lazy_choice_is_that_of_counting_every_ball_each_time() {
        let mut random = Random::new(4);
        let mut place = |by: f32| [0; 3].map(|_| by * (2.0 * random.unit() - 1.0));
        let points: Vec<[f32; 3]> = (0..1500).map(|_| place(1.0)).collect();
        let radii = (0..300).map(|k| 0.05 + 0.001 * k as f32);
        let balls: Vec<Ball> = radii.map(|radius| Ball { center: place(0.9), radius }).collect();
        let mut cloud = Cloud::new(&points, [1.0; 3]).unwrap();
        let chosen = choose(&mut cloud, &balls, 60, |_| u32::MAX).unwrap();
        let mut left = points;
        let mut oracle = Vec::new();
        while oracle.len() < 60 {
            let holds = |b: &Ball, p: &[f32; 3]| b.apart(p) <= b.radius * b.radius;
            let gain = |b: &Ball| left.iter().filter(|p| holds(b, p)).count();
            let best = (0..balls.len()).rev().max_by_key(|&i| gain(&balls[i])).unwrap();
            if gain(&balls[best]) == 0 {
                break;
            }
            left.retain(|p| !holds(&balls[best], p));
            oracle.push(best);
        }
        assert_eq!(chosen, oracle);
        assert!(left.len() < 700, "few enough to be sorted anew: {}", left.len());
    }
}
