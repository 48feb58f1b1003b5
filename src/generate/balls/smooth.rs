//! How far the surfaces of clump and target are apart, as a second measure beside D.
//!
//! From clump to target by columns ([`Between`]). From target to clump by points spread evenly over
//! the target's surface: the distance of a point p from the clump with
//! balls (c, r) is g = min |p − c| − r. Outside the clump that is exact, inside it is the depth
//! in one ball. A step makes least the squares of what each ball is nearest to, as in fits of
//! spheres to surfaces, beside what the step makes least anyway.

use super::between::{Between, Fresh};
use super::cover::Region;
use super::dexels::{Dexels, Seen};
use super::field::Field;
use super::nearest;
use super::random::Random;
use crate::error::{Result, reserve};
use crate::generate::ball::Ball;
use crate::solid::Grid;

/// Points for each ball, and at least.
const EACH: usize = 30;
const LEAST: usize = 3000;
/// Half the width of the layer from which points move to the surface, in cells.
const LAYER: f32 = 0.75;
/// How far from the surface a point may stay, in cells.
const OFF: f32 = 0.05;

/// The stream of random numbers for points.
const POINTS: u64 = 1 << 40;

/// A distance and the number of the ball that has it.
pub(crate) type Nearest = (f32, u32);

/// Points of the target's surface, and its area.
pub(crate) fn points(
    field: &Field,
    grid: &Grid,
    balls: usize,
    random: &mut Random,
) -> Result<(Vec<[f32; 3]>, f64)> {
    let wanted = LEAST.max(balls.saturating_mul(EACH));
    let layer = LAYER * field.cell();
    let reach = 0.5 * grid.spacing.norm() as f32;
    let [nx, ny, _] = grid.dims;
    let mut cells: Vec<[f32; 3]> = Vec::new();
    for i in 0..grid.len() {
        let center = grid.center(i % nx, i / nx % ny, i / nx / ny);
        let center = [0, 1, 2].map(|a| center[a] as f32);
        if field.one(center).abs() < layer + reach {
            crate::error::push("cells about the surface", &mut cells, center)?;
        }
    }
    // One place in each of many parts of the cells, evenly; a third of them or more are in the
    // layer, and of these evenly as many as are wanted stay.
    let tries = wanted.saturating_mul(3);
    let mut points = reserve("points of the surface", tries)?;
    for k in 0..tries {
        let at = (k as f64 + random.unit()) / tries as f64 * cells.len() as f64;
        let Some(cell) = cells.get(at as usize) else { continue };
        let p = [0, 1, 2].map(|a| cell[a] + (grid.spacing[a] * random.between(-0.5, 0.5)) as f32);
        if field.one(p).abs() < layer
            && let Some(p) = onto(field, p)
        {
            points.push(p);
        }
    }
    let found = points.len();
    let tried = cells.len() as f64 * grid.spacing.product();
    let area = tried * found as f64 / tries as f64 / (2.0 * f64::from(layer));
    if found > wanted {
        (0..wanted).for_each(|k| points[k] = points[k * found / wanted]);
        points.truncate(wanted);
    }
    Ok((points, area))
}

/// The point of the surface below or above `p`.
fn onto(field: &Field, mut p: [f32; 3]) -> Option<[f32; 3]> {
    for _ in 0..4 {
        let (f, slope) = (field.one(p), field.slope(p));
        let steep = slope.iter().map(|s| s * s).sum::<f32>().max(0.1);
        p = [0, 1, 2].map(|a| p[a] - f * slope[a] / steep);
    }
    (field.one(p).abs() < OFF * field.cell()).then_some(p)
}

/// The measure of a clump.
pub(crate) struct Smooth {
    weight: f64,
    /// Unit frame.
    points: Vec<[f32; 3]>,
    /// The same along the columns.
    seen: Vec<[f32; 3]>,
    /// In units of the columns.
    nearest: Vec<Nearest>,
    /// Sum of their squares.
    sum: f64,
    between: Between,
    /// Of the target, unit frame.
    area: f64,
    /// Three over the target's equivalent diameter.
    scale: f64,
    /// Distance between columns.
    step: f64,
}

/// What a change needs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Buffers {
    marked: Vec<bool>,
    fresh: Vec<(u32, Nearest)>,
    columns: Fresh,
    search: nearest::Nearest,
}

impl Smooth {
    /// For so many balls, of which there is none yet. `volume`: the target's, unit frame;
    /// `room`: bytes that it may take.
    pub(crate) fn new(
        weight: f64,
        grid: &Grid,
        (field, dexels): (&Field, &Dexels),
        (balls, volume): (usize, f64),
        seed: u64,
        room: u64,
    ) -> Result<Smooth> {
        let (points, area) = points(field, grid, balls, &mut Random::new(seed, POINTS))?;
        let between = Between::new(field, dexels, room)?;
        Smooth::of(weight, (points, area), between, dexels, volume)
    }

    fn of(
        weight: f64,
        (points, area): (Vec<[f32; 3]>, f64),
        between: Between,
        dexels: &Dexels,
        volume: f64,
    ) -> Result<Smooth> {
        let mut seen = reserve("points along columns", points.len())?;
        seen.extend(points.iter().map(|&center| {
            let s = dexels.seen(&Ball { center, radius: 0.0 });
            [s.u, s.v, s.t]
        }));
        let nearest = reserve("distances of points", points.len())?;
        let scale = 3.0 / (6.0 * volume / std::f64::consts::PI).cbrt();
        let step = dexels.cell().cbrt();
        Ok(Smooth { weight, points, seen, nearest, sum: 0.0, between, area, scale, step })
    }

    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        32 * self.points.len() as u64 + self.between.bytes()
    }

    /// All points and columns anew.
    pub(crate) fn whole(&mut self, dexels: &Dexels, balls: &[Seen], buffers: &mut Buffers) {
        self.between.whole(dexels, balls, &mut buffers.columns);
        let Smooth { seen, nearest, sum, .. } = self;
        nearest.clear();
        nearest.resize(seen.len(), (f32::MAX, 0));
        let places: Vec<([f32; 3], f32)> = balls.iter().map(|s| ([s.u, s.v, s.t], s.r)).collect();
        buffers.search.each(seen, &places, |k, some| {
            for &j in some {
                nearer(&seen[k], &balls[j as usize], j, &mut nearest[k]);
            }
        });
        *sum = nearest.iter().map(|n| square(n.0)).sum();
    }

    /// By how much the sums of points and columns would change with the balls `of` at the places
    /// that `balls` has for them. The region has one in `step` of the rows that they touch.
    pub(crate) fn change(
        &self,
        dexels: &Dexels,
        region: &Region,
        step: u32,
        of: &[u32],
        balls: &[Seen],
        buffers: &mut Buffers,
    ) -> [f64; 2] {
        let Buffers { marked, fresh, columns, .. } = buffers;
        let between = self.between.change(dexels, region, balls, columns);
        marked.clear();
        marked.resize(balls.len(), false);
        of.iter().for_each(|&j| marked[j as usize] = true);
        fresh.clear();
        let mut change = 0.0;
        for (k, (p, now)) in (0u32..).zip(self.seen.iter().zip(&self.nearest)) {
            let mut best = *now;
            if marked[now.1 as usize] {
                best = (f32::MAX, 0);
                for (j, s) in (0u32..).zip(balls) {
                    nearer(p, s, j, &mut best);
                }
            } else {
                for &j in of {
                    nearer(p, &balls[j as usize], j, &mut best);
                }
            }
            if best != *now {
                change += square(best.0) - square(now.0);
                fresh.push((k, best));
            }
        }
        [change, f64::from(step) * between]
    }

    /// Takes over what the last [`Smooth::change`] found.
    pub(crate) fn take(
        &mut self,
        dexels: &Dexels,
        region: &Region,
        [change, between]: [f64; 2],
        buffers: &Buffers,
    ) {
        self.between.take(dexels, region, between, &buffers.columns);
        for &(k, nearest) in &buffers.fresh {
            self.nearest[k as usize] = nearest;
        }
        self.sum += change;
    }

    /// The root of the mean square both ways, unit frame, when the sums are changed so.
    fn distance(&self, [change, between]: [f64; 2]) -> f64 {
        let count = self.points.len().max(1) as f64;
        let to_clump = self.step * self.step * (self.sum + change).max(0.0) / count;
        let to_target = 2.0 * self.between.sum(between) * self.step.powi(3) / self.area;
        (0.5 * (to_clump + to_target)).sqrt()
    }

    /// What the clump is charged now: the weight times three distances over the target's
    /// equivalent diameter.
    pub(crate) fn now(&self) -> f64 {
        self.weight * self.scale * self.distance([0.0; 2])
    }

    /// By how much the charge rises with a change.
    pub(crate) fn rise(&self, change: [f64; 2]) -> f64 {
        self.weight * self.scale * (self.distance(change) - self.distance([0.0; 2]))
    }

    /// By how much the charge rises for a unit of ∫ f in columns.
    pub(crate) fn slope(&self) -> f64 {
        let least = self.distance([0.0; 2]).max(1e-9);
        0.5 * self.weight * self.scale * self.step.powi(3) / (self.area * least)
    }

    /// What draws balls; `volumes`: of union and target together, unit frame.
    pub(crate) fn pull(&self, volumes: f64) -> Pull<'_> {
        let count = self.points.len().max(1) as f64;
        let least = self.distance([0.0; 2]).max(1e-9);
        let weight = 0.5 * self.weight * self.scale * volumes / (count * least);
        Pull { points: &self.points, nearest: &self.nearest, step: self.step as f32, weight }
    }
}

fn square(x: f32) -> f64 {
    f64::from(x) * f64::from(x)
}

/// Lowers `best` to the distance of a point from ball `j`.
#[inline(always)]
fn nearer([u, v, t]: &[f32; 3], s: &Seen, j: u32, best: &mut Nearest) {
    let (u, v, t) = (u - s.u, v - s.v, t - s.t);
    let apart = u * u + v * v + t * t;
    let reach = best.0 + s.r;
    if reach > 0.0 && apart < reach * reach {
        *best = (apart.sqrt() - s.r, j);
    }
}

/// The points of the surface as they draw the balls that are nearest to them.
#[derive(Clone, Copy)]
pub(crate) struct Pull<'a> {
    pub points: &'a [[f32; 3]],
    pub nearest: &'a [Nearest],
    pub step: f32,
    /// Of a point's half square, in units of volume.
    pub weight: f64,
}

#[cfg(test)]
#[path = "smooth_tests.rs"]
mod tests;
