//! What the points of the target's surface add to a step of the balls that are nearest to them.

use super::exposed::Normal;
use super::near::Near;
use super::nearest;
use super::smooth::{Nearest, Pull};
use crate::generate::ball::Ball;

/// Of more balls that move, the nearest to all points are found together.
const MANY: usize = 128;
/// Of the mean radius: how much nearer to balls that move a point may come.
const SLACK: f32 = 0.5;

/// The same in the unit frame.
#[inline(always)]
fn closer(p: &[f32; 3], b: &Ball, j: u32, best: &mut Nearest) {
    let [x, y, z] = [0, 1, 2].map(|a| p[a] - b.center[a]);
    let apart = x * x + y * y + z * z;
    let reach = best.0 + b.radius;
    if reach > 0.0 && apart < reach * reach {
        *best = (apart.sqrt() - b.radius, j);
    }
}

/// The points that may draw some balls, and what they add to the normal equations.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drawn {
    /// Points, with their distance from all balls that stay.
    local: Vec<([f32; 3], f32)>,
    /// The ball that each was nearest to.
    last: Vec<u32>,
    /// Balls that move: those that lead, and their images.
    moving: Vec<u32>,
    /// Of each ball its place among those that lead and move, or what else it does.
    slots: Vec<u32>,
    sums: Vec<Normal>,
    /// Of many balls: the points, the balls, and what is found.
    points: Vec<[f32; 3]>,
    places: Vec<([f32; 3], f32)>,
    best: Vec<Nearest>,
    search: nearest::Nearest,
}

/// No ball, or one that stays; and one that follows its image.
const NONE: u32 = u32::MAX;
const FOLLOWS: u32 = u32::MAX - 1;

impl Drawn {
    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        (16 * self.local.capacity()
            + 4 * (self.last.capacity() + self.moving.capacity() + self.slots.capacity())
            + size_of::<Normal>() * self.sums.capacity()
            + 12 * self.points.capacity()
            + 16 * self.places.capacity()
            + 8 * self.best.capacity()) as u64
    }

    /// Finds the points for the balls `of` that are about to move; `all`: with their images.
    pub(crate) fn begin(
        &mut self,
        pull: &Pull,
        balls: &[Ball],
        of: &[u32],
        all: impl IntoIterator<Item = u32>,
    ) {
        let Drawn { local, last, moving, slots, .. } = self;
        local.clear();
        slots.clear();
        slots.resize(balls.len(), NONE);
        moving.clear();
        moving.extend(all);
        moving.iter().for_each(|&j| slots[j as usize] = FOLLOWS);
        for (k, &j) in (0u32..).zip(of) {
            slots[j as usize] = k;
        }
        let sum: f32 = of.iter().map(|&j| balls[j as usize].radius).sum();
        let slack = SLACK * sum / of.len().max(1) as f32;
        for (p, &(g, i)) in pull.points.iter().zip(pull.nearest) {
            let mut rest = (f32::MAX, 0);
            if moving.len() < balls.len() {
                if slots[i as usize] == NONE {
                    rest.0 = g * pull.step;
                    let mut near = (rest.0 + slack, NONE);
                    moving.iter().for_each(|&j| closer(p, &balls[j as usize], j, &mut near));
                    if near.1 == NONE {
                        continue;
                    }
                } else {
                    let stay = (0u32..).zip(balls).filter(|(j, _)| slots[*j as usize] == NONE);
                    stay.for_each(|(j, b)| closer(p, b, j, &mut rest));
                }
            }
            local.push((*p, rest.0));
        }
        last.clear();
        last.resize(local.len(), NONE);
    }

    /// The nearest to each point of the balls that move.
    fn find(&mut self, balls: &[Ball]) {
        let Drawn { local, moving, points, places, best, search, .. } = self;
        points.clear();
        points.extend(local.iter().map(|p| p.0));
        places.clear();
        let place = |&j: &u32| (balls[j as usize].center, balls[j as usize].radius);
        places.extend(moving.iter().map(place));
        best.clear();
        best.resize(points.len(), (f32::MAX, NONE));
        search.each(points, places, |k, some| {
            for j in some.iter().map(|&m| moving[m as usize]) {
                closer(&points[k], &balls[j as usize], j, &mut best[k]);
            }
        });
    }

    /// Sums up what the points add for each ball. `near`: which balls meet each that moves;
    /// `anew`: those lists have changed.
    pub(crate) fn draw(&mut self, balls: &[Ball], of: &[u32], near: &Near, anew: bool) {
        let many = self.moving.len() > MANY;
        if many {
            self.find(balls);
        }
        let Drawn { local, last, moving, slots, sums, best: found, .. } = self;
        sums.clear();
        sums.resize(of.len(), Normal::default());
        for (at, ((p, rest), last)) in local.iter().zip(last).enumerate() {
            let mut best = (f32::MAX, NONE);
            // The lists are of those that lead.
            let slot = if *last == NONE { NONE } else { slots[*last as usize] };
            if many {
                best = found[at];
            } else if slot >= FOLLOWS || anew {
                moving.iter().for_each(|&j| closer(p, &balls[j as usize], j, &mut best));
            } else {
                closer(p, &balls[*last as usize], *last, &mut best);
                for &j in near.of(slot as usize) {
                    if slots[j as usize] != NONE {
                        closer(p, &balls[j as usize], j, &mut best);
                    }
                }
            }
            *last = best.1;
            let (g, j) = best;
            if j == NONE || g >= *rest || slots[j as usize] >= FOLLOWS {
                continue;
            }
            let k = slots[j as usize];
            let ball = &balls[of[k as usize] as usize];
            let apart = f64::from((g + ball.radius).max(1e-6));
            let way = [0, 1, 2].map(|a| f64::from(p[a] - ball.center[a]) / apart);
            let row = [way[0], way[1], way[2], 1.0];
            let sum = &mut sums[k as usize];
            let mut upper = sum.m.iter_mut();
            for i in 0..4 {
                row[i..].iter().zip(&mut upper).for_each(|(x, m)| *m += row[i] * x);
                sum.b[i] += f64::from(g) * row[i];
            }
        }
    }

    /// Adds to the equations of the ball that came `k`th, whose directions stand for `area` each.
    pub(crate) fn add(&self, pull: &Pull, k: usize, width: f32, area: f64, normal: &mut Normal) {
        let Some(sum) = self.sums.get(k) else { return };
        let weight = pull.weight * f64::from(width) / area;
        normal.m.iter_mut().zip(&sum.m).for_each(|(m, s)| *m += weight * s);
        normal.b.iter_mut().zip(&sum.b).for_each(|(b, s)| *b += weight * s);
    }
}
