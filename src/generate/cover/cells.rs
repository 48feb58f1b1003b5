//! The set to be covered: small cells along the surface, with the volume and the centroid of
//! their part inside, and cells of twice the edge within (Yuan 2019, section 3.1).

use super::fill::{CUT, FULL, fill};
use super::turned::Turned;
use crate::error::{Error, Result, fits, push};
use crate::generate::ball::Ball;
use crate::generate::select::{Point, Points};
use crate::run::Run;
use crate::solid::Grid;

/// Weight of a small cell that is full.
const UNIT: f64 = (1u32 << 20) as f64;
/// Bytes of a small cell: its kind, and the point that it becomes, twice.
const BYTES: u64 = 33;

/// Cells with their weights.
pub(super) struct Cells {
    pub points: Points,
    /// Number of cells.
    pub count: usize,
    /// Weight of all.
    pub weight: u64,
    /// Volume of a weight of 1, in the unit frame.
    pub unit: f64,
    /// Bytes that it held at most (estimate from the sizes of its arrays).
    pub bytes: u64,
}

impl Cells {
    /// `inside` cells to the equivalent diameter within the body, twice as many at its surface.
    pub(super) fn new(turned: &Turned, inside: u32, limit: u64, run: &Run) -> Result<Cells> {
        let coarse = turned.lattice(turned.cell(inside), 1, limit, 8 * BYTES)?;
        let grid =
            Grid { dims: coarse.dims.map(|n| 2 * n), spacing: coarse.spacing * 0.5, ..coarse };
        fits(format_args!("{} cells", grid.len()), grid.len() as u64 * BYTES, limit)?;
        let fill = fill(turned, &grid, limit, run)?;
        run.check(0.35, "filling the body with cells")?;
        let [nx, ny, nz] = grid.dims;
        let kind =
            |i: usize, j: usize, k: usize| fill.kind.get(grid.index(i, j, k)).copied().unwrap_or(0);
        // A large cell stands where all around it is full.
        let is_deep = |i: usize, j: usize, k: usize| {
            let around = |n: usize| (2 * n).saturating_sub(2)..2 * n + 4;
            let rows = around(k).flat_map(|c| around(j).map(move |b| (b, c)));
            rows.into_iter().all(|(b, c)| around(i).all(|a| kind(a, b, c) == FULL))
        };
        let (mut large, mut small, mut cut) = (Vec::new(), Vec::new(), Vec::new());
        let what = "the cells of the cover";
        for (k, j) in (0..nz / 2).flat_map(|k| (0..ny / 2).map(move |j| (k, j))) {
            for i in 0..nx / 2 {
                if kind(2 * i, 2 * j, 2 * k) == FULL && is_deep(i, j, k) {
                    let center = coarse.center(i, j, k).map(|x| x as f32);
                    push(what, &mut large, (center.into(), (8.0 * UNIT) as u32))?;
                    continue;
                }
                for m in 0..8 {
                    let at = [2 * i + (m & 1), 2 * j + (m >> 1 & 1), 2 * k + (m >> 2)];
                    if kind(at[0], at[1], at[2]) == FULL {
                        let center = grid.center(at[0], at[1], at[2]).map(|x| x as f32);
                        push(what, &mut small, (center.into(), UNIT as u32))?;
                    }
                }
            }
        }
        for part in &fill.cut {
            debug_assert_eq!(fill.kind.get(part.cell), Some(&CUT));
            let weight = (part.volume * UNIT).round().max(1.0) as u32;
            push(what, &mut cut, (part.center.map(|x| x as f32).into(), weight))?;
        }
        let sets: Vec<Vec<Point>> = vec![large, small, cut];
        let count = sets.iter().map(Vec::len).sum();
        let points = Points::new(sets)?;
        let weight = points.left();
        if weight == 0 {
            return Err(Error::Empty("no cell lies in the body".into()));
        }
        let unit = grid.spacing.x.powi(3) / UNIT;
        let bytes = grid.len() as u64 + 32 * count as u64;
        Ok(Cells { points, count, weight, unit, bytes })
    }

    /// Weight of the cells that any of `balls` holds.
    pub(super) fn within_reach(&self, balls: &[Ball]) -> u64 {
        let mut points = self.points.clone();
        balls.iter().for_each(|b| points.hold(b));
        self.weight - points.left()
    }
}
