//! The mean square of the distance of a clump's surface from the target's, by columns.
//!
//! With f the signed distance of the target, E = ∫_C f − ∫_S f is the integral of |f| over what
//! only one of clump C and target S holds, and so about half that of f² over the surface of C. In
//! the columns that also give the volumes it is exact along them, and a change of a few balls
//! changes only the columns that they touch.

use super::chords::Row;
use super::cover::Region;
use super::dexels::{Dexels, Seen};
use super::field::Field;
use super::tiles::for_tiles;
use crate::error::{Error, Result, filled, fits};

/// Most places in a column where the distance is read.
const MOST: f32 = 4096.0;

/// ∫ f in columns: f in the unit frame, along columns in their own units.
#[derive(Debug, Clone)]
pub(crate) struct Between {
    /// Place of the first node along the columns, and distance between nodes.
    low: f32,
    step: f32,
    nodes: usize,
    /// In each column, the distance at the nodes, and its integral up to there.
    values: Vec<[f32; 2]>,
    /// Over the target, all columns.
    target: f64,
    /// Over the clump: each column, and all.
    columns: Vec<f32>,
    clump: f64,
}

/// What a look at a region needs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fresh {
    row: Row,
    order: Vec<u32>,
    /// The columns' new integrals.
    columns: Vec<f32>,
}

impl Between {
    /// Of no ball; in no more than `room` bytes.
    pub(crate) fn new(field: &Field, dexels: &Dexels, room: u64) -> Result<Between> {
        let [low, high] = dexels.ends();
        let cell = f64::from(field.cell()) / dexels.cell().cbrt();
        // Room for balls that reach out.
        let margin = 0.2 * (high - low) + 4.0 * cell as f32;
        let [low, high] = [low - margin, high + margin];
        let step = (cell as f32).max((high - low) / MOST);
        let nodes = ((high - low) / step) as usize + 2;
        let total = dexels.dims[0] * dexels.dims[1];
        let all = total.checked_mul(nodes).ok_or_else(|| {
            Error::TooLarge(format!("{total} columns with {nodes} distances each are too many"))
        })?;
        let bytes = 8 * all as u64 + 4 * total as u64;
        fits(format_args!("{total} columns with {nodes} distances each"), bytes, room)?;
        let mut values = filled("distances along columns", all, [0.0f32; 2])?;
        for (c, out) in values.chunks_mut(nodes).enumerate() {
            let (a, b) = (c % dexels.dims[0], c / dexels.dims[0]);
            let (mut sum, mut before) = (0.0, 0.0);
            for (k, node) in out.iter_mut().enumerate() {
                let f = field.one(dexels.point(a, b, low + k as f32 * step));
                if k > 0 {
                    sum += 0.5 * step * (before + f);
                }
                before = f;
                *node = [f, sum];
            }
        }
        let columns = filled("distances along columns", total, 0.0)?;
        let mut out = Between { low, step, nodes, values, target: 0.0, columns, clump: 0.0 };
        out.target = (0..total).map(|c| f64::from(out.integral(c, dexels.column(c)))).sum();
        Ok(out)
    }

    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        (8 * self.values.len() + 4 * self.columns.len()) as u64
    }

    /// ∫ f from the first node to `t` in column `c`.
    #[inline(always)]
    fn up_to(&self, c: usize, t: f32) -> f32 {
        let values = &self.values[c * self.nodes..(c + 1) * self.nodes];
        // Beyond both ends as between the last nodes.
        let u = (t - self.low) / self.step;
        let k = (u.max(0.0) as usize).min(self.nodes - 2);
        let part = u - k as f32;
        let ([f, sum], [next, _]) = (values[k], values[k + 1]);
        sum + self.step * part * (f + 0.5 * part * (next - f))
    }

    /// ∫ f over some intervals of column `c`.
    #[inline(always)]
    fn integral(&self, c: usize, intervals: &[[f32; 2]]) -> f32 {
        intervals.iter().map(|i| self.up_to(c, i[1]) - self.up_to(c, i[0])).sum()
    }

    /// By how much ∫ f over the clump would change in the region's columns with these balls.
    pub(crate) fn change(
        &self,
        dexels: &Dexels,
        region: &Region,
        balls: &[Seen],
        fresh: &mut Fresh,
    ) -> f64 {
        let Fresh { row, order, columns } = fresh;
        let met = |(i, s): (u32, &Seen)| region.may_meet(s).then_some(i);
        by_lower_ends((0u32..).zip(balls).filter_map(met), balls, order);
        columns.clear();
        let mut sum = 0.0;
        for (b, [from, to]) in region.runs() {
            row.join(b, [from, to], balls, order);
            let first = b * dexels.dims[0] + from;
            for k in 0..to - from {
                let new = self.integral(first + k, row.joined(k));
                sum += f64::from(new) - f64::from(self.columns[first + k]);
                columns.push(new);
            }
        }
        sum
    }

    /// Takes over what the last [`Between::change`] found.
    pub(crate) fn take(&mut self, dexels: &Dexels, region: &Region, change: f64, fresh: &Fresh) {
        let mut fresh = fresh.columns.iter();
        for (b, [from, to]) in region.runs() {
            let first = b * dexels.dims[0];
            for (old, new) in self.columns[first + from..first + to].iter_mut().zip(&mut fresh) {
                *old = *new;
            }
        }
        self.clump += change;
    }

    /// All columns anew.
    pub(crate) fn whole(&mut self, dexels: &Dexels, balls: &[Seen], fresh: &mut Fresh) {
        let Fresh { row, order, columns } = fresh;
        by_lower_ends(0..balls.len() as u32, balls, order);
        columns.clear();
        columns.resize(self.columns.len(), 0.0);
        for_tiles(dexels.dims, balls, order, 1, &mut |tile| {
            for b in tile.b {
                row.join_part(b, 0, [tile.a.start, tile.a.end], balls, tile.balls);
                for (k, a) in tile.a.clone().enumerate() {
                    let c = a + dexels.dims[0] * b;
                    columns[c] = self.integral(c, row.joined(k));
                }
            }
        });
        self.columns.copy_from_slice(columns);
        self.clump = self.columns.iter().map(|&x| f64::from(x)).sum();
    }

    /// E after a change.
    pub(crate) fn sum(&self, change: f64) -> f64 {
        (self.clump - self.target + change).max(0.0)
    }
}

/// Some of the balls by their lower ends.
fn by_lower_ends(some: impl Iterator<Item = u32>, balls: &[Seen], order: &mut Vec<u32>) {
    order.clear();
    order.extend(some);
    let low = |i: u32| balls[i as usize].t - balls[i as usize].r;
    order.sort_unstable_by(|&i, &j| low(i).total_cmp(&low(j)).then(i.cmp(&j)));
}

#[cfg(test)]
mod tests {
    use super::super::cover::Look;
    use super::super::random::Random;
    use super::super::test_bodies::{Bodies, bodies};
    use super::*;
    use crate::generate::ball::Ball;
    use crate::run::Pool;

    fn clump(n: usize, seed: u64, body: &Bodies) -> Vec<Ball> {
        let mut random = Random::new(seed, 2);
        let [low, high] = body.bounds;
        (0..n)
            .map(|_| Ball {
                center: [0, 1, 2].map(|a| random.between(low[a], high[a]) as f32),
                radius: random.between(0.03, 0.08) as f32,
            })
            .collect()
    }

    #[test]
    fn sums_are_those_over_points_and_changes_add_up() {
        for body in bodies() {
            let dexels = body.dexels(4000);
            let field = Field::new(body.solid.grid(), &body.distance, &Pool::serial()).unwrap();
            let mut between = Between::new(&field, &dexels, u64::MAX).unwrap();
            let (mut look, mut fresh) = (Look::default(), Fresh::default());
            let mut balls = clump(20, 3, &body);
            let mut seen: Vec<Seen> = balls.iter().map(|b| dexels.seen(b)).collect();
            look.region.all(&dexels);
            between.whole(&dexels, &seen, &mut fresh);
            // |f| over what only one of both holds, by points of a grid.
            let by_points = |balls: &[Ball]| {
                let (n, mut sum) = (90, 0.0);
                for i in 0..n * n * n {
                    let at = [i % n, i / n % n, i / n / n];
                    let center = at.map(|k| 1.2 * (k as f32 + 0.5) / n as f32 - 0.1);
                    let point = Ball { center, radius: 0.0 };
                    let held = balls.iter().any(|b| b.apart(&point) < b.radius * b.radius);
                    let f = field.one(center);
                    sum += f64::from(if held != (f < 0.0) { f.abs() } else { 0.0 });
                }
                sum * (1.2 / n as f64).powi(3)
            };
            let (e, slow) = (between.sum(0.0) * dexels.cell(), by_points(&balls));
            assert!((e / slow - 1.0).abs() < 0.01, "{e} {slow}");
            for (k, new) in clump(40, 9, &body).into_iter().enumerate() {
                let i = k % balls.len();
                let moved = dexels.seen(&new);
                look.region.of(&dexels, [seen[i], moved].into_iter());
                balls[i] = new;
                seen[i] = moved;
                let change = between.change(&dexels, &look.region, &seen, &mut fresh);
                between.take(&dexels, &look.region, change, &fresh);
            }
            let (added, slow) = (between.sum(0.0), by_points(&balls));
            look.region.all(&dexels);
            between.whole(&dexels, &seen, &mut fresh);
            assert!((added / between.sum(0.0) - 1.0).abs() < 1e-3, "{added}");
            assert!((added * dexels.cell() / slow - 1.0).abs() < 0.01, "{added} {slow}");
        }
    }
}
