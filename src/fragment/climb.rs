//! The climb: balls take feasible steps that cover more, one after the other. A ball's radius is
//! its depth, so that it has three unknowns. For each visit of a ball the points that it may cover
//! and no other does are gathered once; then many places are tried against these few. Borders are
//! soft by a spacing of the points, so that small steps are told apart.

use super::cloud::{Cloud, bits};
use super::room::{Ball, Room, along, dot, times};
use super::spread::Random;
use crate::error::{Result, filled, reserve};
use wide::f32x8;

/// First step of a ball and the least, of its radius.
const FIRST: f32 = 0.3;
const LEAST: f32 = 0.01;
/// By what a step changes when it covers more, and when not.
const LONGER: f32 = 1.5;
const SHORTER: f32 = 0.75;
/// Part of the steps that end where the ball is greatest.
const GROWN: f32 = 0.7;
/// How far the gathered points reach beyond the ball, of its radius.
const BEYOND: f32 = 0.25;

/// What a visit costs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Visit {
    pub tries: usize,
}

/// Balls in a room.
pub(super) struct Climb<'a> {
    room: &'a Room<'a>,
    cloud: &'a Cloud,
    pub balls: Vec<Ball>,
    steps: Vec<f32>,
    /// Width of the border.
    soft: f32,
    /// Least radius.
    least: f32,
    /// Points that may be covered, and how much of each no other ball covers.
    points: Vec<[f32x8; 4]>,
    others: Vec<Ball>,
    cuts: Vec<(Soft, u32)>,
    here: Vec<Soft>,
}

impl<'a> Climb<'a> {
    pub(super) fn new(
        room: &'a Room<'a>,
        cloud: &'a Cloud,
        balls: Vec<Ball>,
        spacing: f32,
        least: f32,
    ) -> Result<Climb<'a>> {
        Ok(Climb {
            room,
            cloud,
            steps: filled("spheres", balls.len(), FIRST)?,
            soft: spacing,
            least,
            points: reserve("points", 2 * 8 * cloud.chunks.len())?,
            others: reserve("spheres", balls.len())?,
            cuts: reserve("spheres", balls.len())?,
            here: reserve("spheres", balls.len())?,
            balls,
        })
    }

    /// One visit of each ball.
    pub(super) fn sweep(&mut self, visit: &Visit, random: &mut Random) {
        for i in 0..self.balls.len() {
            self.step(i, visit, random);
        }
    }

    /// Gathers what ball `i` may cover about its place.
    fn gather(&mut self, i: usize, about: &Ball) {
        let half = 0.5 * self.soft;
        let reach2 = f32x8::splat(about.radius * about.radius);
        self.points.clear();
        self.others.clear();
        for (j, o) in self.balls.iter().enumerate() {
            let reach = about.radius + o.radius + half;
            if j != i && o.apart(&about.center) < reach * reach {
                self.others.push(*o);
            }
        }
        let (mut stage, mut filled) = ([[0.0f32; 8]; 4], 0);
        for (group, chunks) in self.cloud.groups.iter().zip(self.cloud.chunks.chunks(8)) {
            let (mut met, _) = group.meets(about, 0.0);
            if met == 0 {
                continue;
            }
            self.cuts.clear();
            for o in &self.others {
                let (some, all) = group.meets(o, half);
                met &= !all;
                if some & met != 0 {
                    self.cuts.push((Soft::new(o, self.soft), some));
                }
            }
            for k in bits(met) {
                let Some(chunk) = chunks.get(k) else { continue };
                self.here.clear();
                for (o, some) in &self.cuts {
                    if some >> k & 1 == 1 {
                        self.here.push(*o);
                    }
                }
                for p in &chunk.points {
                    let (x, y) = (p[0] - about.center[0], p[1] - about.center[1]);
                    let z = p[2] - about.center[2];
                    let near = (x * x + y * y + z * z).simd_lt(reach2);
                    if near.to_bitmask() == 0 {
                        continue;
                    }
                    let mut covered = f32x8::splat(0.0);
                    for o in &self.here {
                        covered = covered.fast_max(o.cover(p[0], p[1], p[2]));
                    }
                    let kept = near & covered.simd_lt(f32x8::splat(1.0));
                    for lane in bits(kept.to_bitmask()) {
                        for (to, from) in stage.iter_mut().zip([&p[0], &p[1], &p[2], &covered]) {
                            to[filled & 7] = from.as_array()[lane & 7];
                        }
                        filled += 1;
                        if filled == 8 {
                            self.points.push(lanes(&stage));
                            filled = 0;
                        }
                    }
                }
            }
        }
        if filled > 0 {
            // The others are covered.
            stage[3][filled..].fill(1.0);
            self.points.push(lanes(&stage));
        }
    }

    /// How much a ball covers of what is gathered, beyond what others do.
    #[inline]
    fn value(&self, ball: &Ball) -> f32 {
        let mut sum = f32x8::splat(0.0);
        let ball = Soft::new(ball, self.soft);
        for [x, y, z, covered] in &self.points {
            let own = ball.raw(*x, *y, *z).fast_min(f32x8::splat(1.0));
            sum += (own - *covered).fast_max(f32x8::splat(0.0));
        }
        sum.reduce_add()
    }

    /// The way in which what it covers grows fastest, the radius growing with the depth.
    fn way(&self, ball: &Ball) -> [f32; 3] {
        let zero = f32x8::splat(0.0);
        let one = f32x8::splat(1.0);
        let (mut sum, mut count) = ([zero; 3], zero);
        let soft = Soft::new(ball, self.soft);
        for [x, y, z, covered] in &self.points {
            let own = soft.cover(*x, *y, *z);
            let edge = own.simd_gt(*covered) & own.simd_lt(one) & one;
            sum[0] += edge * (*x - ball.center[0]);
            sum[1] += edge * (*y - ball.center[1]);
            sum[2] += edge * (*z - ball.center[2]);
            count += edge;
        }
        let (_, out) = self.room.depth(&ball.center);
        let count = count.reduce_add() * ball.radius;
        let sum = [sum[0].reduce_add(), sum[1].reduce_add(), sum[2].reduce_add()];
        let way = along(&sum, -count, &out);
        times(&way, 1.0 / dot(&way, &way).sqrt().max(f32::MIN_POSITIVE))
    }

    fn step(&mut self, i: usize, visit: &Visit, random: &mut Random) {
        let old = self.balls[i];
        let about = Ball { radius: old.radius * (1.0 + BEYOND) + 0.5 * self.soft, ..old };
        self.gather(i, &about);
        let mut ball = old;
        let mut best = self.value(&old);
        let mut way = self.way(&old);
        let mut step = self.steps[i];
        for _ in 0..visit.tries {
            let weight = random.unit();
            let any = random.direction();
            let length = step * old.radius;
            let to = along(&times(&any, 1.0 - weight), weight, &way);
            let to = along(&ball.center, length, &to);
            let new = if random.unit() < GROWN { self.room.grown(to) } else { self.room.ball(to) };
            let moved = old.apart(&new.center).sqrt();
            // No farther than what is gathered, and than what the ball itself shows to be within.
            let near = moved + new.radius <= about.radius && moved < 0.9 * old.radius;
            if !near || new.radius < self.least {
                step = (step * SHORTER).max(LEAST);
                continue;
            }
            let value = self.value(&new);
            if value > best {
                (ball, best) = (new, value);
                way = self.way(&ball);
                step = (step * LONGER).min(FIRST);
            } else {
                step = (step * SHORTER).max(LEAST);
            }
        }
        self.steps[i] = (step * LONGER).clamp(2.0 * LEAST, FIRST);
        self.balls[i] = ball;
    }
}

#[inline(always)]
fn lanes(stage: &[[f32; 8]; 4]) -> [f32x8; 4] {
    let [x, y, z, covered] = *stage;
    [f32x8::new(x), f32x8::new(y), f32x8::new(z), f32x8::new(covered)]
}

/// A ball with a soft border: how much it covers is `from − by d²`, from 0 to 1.
#[derive(Debug, Clone, Copy)]
struct Soft {
    center: [f32; 3],
    from: f32,
    by: f32,
}

impl Soft {
    fn new(ball: &Ball, width: f32) -> Soft {
        let by = 0.5 / (ball.radius * width);
        Soft { center: ball.center, from: 0.5 + ball.radius * ball.radius * by, by }
    }

    /// How much it covers of points: 1 within, 0 without, in between over the border's width.
    #[inline(always)]
    fn cover(&self, x: f32x8, y: f32x8, z: f32x8) -> f32x8 {
        self.raw(x, y, z).fast_max(f32x8::splat(0.0)).fast_min(f32x8::splat(1.0))
    }

    /// The same without bounds.
    #[inline(always)]
    fn raw(&self, x: f32x8, y: f32x8, z: f32x8) -> f32x8 {
        let (x, y, z) = (x - self.center[0], y - self.center[1], z - self.center[2]);
        f32x8::splat(self.from) - (x * x + y * y + z * z) * self.by
    }
}
