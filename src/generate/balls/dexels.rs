//! Columns of the target as exact inside intervals, on a square lattice turned to a generic
//! orientation: faces parallel to the columns would be exploited on a straight one. Everything
//! is in units of the distance between columns, with column (a, b) at the place (a, b).

use super::Plane;
use super::random::Random;
use crate::error::{Error, Result, reserve};
use crate::generate::ball::Ball;
use crate::math::Vec3;
use crate::run::Pool;
use crate::solid::columns::Lattice;
use crate::solid::{Columns, Grid, Solid};

/// Room around the target's box on the sampled axes, as a part of its longer edge there: what
/// balls reach beyond it is not seen.
const ROOM: f64 = 0.2;

/// Most columns along an edge of the lattice.
const MOST: f64 = 16_384.0;

/// The target's columns.
pub(crate) struct Dexels {
    lattice: Lattice,
    /// Distance between columns.
    step: f64,
    /// Columns along both axes of the lattice.
    pub dims: [usize; 2],
    starts: Vec<u32>,
    intervals: Vec<[f32; 2]>,
    /// Length inside of all columns.
    pub target: f64,
}

/// A ball seen along the columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Seen {
    /// Place across the columns.
    pub u: f32,
    pub v: f32,
    /// Along them.
    pub t: f32,
    pub r: f32,
}

/// Area of the cells inside, seen along an axis.
fn shadow(grid: &Grid, inside: &[u8], axis: usize) -> f64 {
    let stride = [1, grid.dims[0], grid.dims[0] * grid.dims[1]];
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    let mut cells = 0u32;
    for j in 0..grid.dims[v] {
        for i in 0..grid.dims[u] {
            let first = i * stride[u] + j * stride[v];
            let column = inside[first..].iter().step_by(stride[axis]).take(grid.dims[axis]);
            cells += u32::from(column.into_iter().any(|&c| c != 0));
        }
    }
    f64::from(cells.max(1)) * grid.spacing[u] * grid.spacing[v]
}

impl Dexels {
    /// So many columns that about `wanted` meet the target, along its box's shortest edge.
    pub(crate) fn new(
        solid: &Solid,
        bounds: &[Vec3; 2],
        wanted: usize,
        pool: &Pool,
    ) -> Result<Self> {
        Dexels::among(solid, (solid.grid(), solid.inside()?), bounds, wanted, pool)
    }

    /// The same for a part of the body: its cells in a grid, and its box.
    pub(crate) fn among(
        solid: &Solid,
        (grid, inside): (&Grid, &[u8]),
        [low, high]: &[Vec3; 2],
        wanted: usize,
        pool: &Pool,
    ) -> Result<Self> {
        let edges = high - low;
        let axis = (0..3).rev().min_by(|&i, &j| edges[i].total_cmp(&edges[j])).unwrap_or(2);
        let sampled = [(axis + 1) % 3, (axis + 2) % 3];
        let width = edges[sampled[0]].max(edges[sampled[1]]) * (1.0 + 2.0 * ROOM);
        let middle = sampled.map(|a| 0.5 * (low[a] + high[a]));
        let shadow = shadow(grid, inside, axis);
        let n = width * (wanted as f64 / shadow).sqrt();
        if !(1.0..=MOST).contains(&n) {
            return Err(Error::TooLarge(format!(
                "{wanted} columns through the target are {n:.0} along an edge, more than {MOST}"
            )));
        }
        let n = n.ceil() as usize;
        let lattice = Lattice::slanted(
            axis,
            n,
            middle.map(|m| m - 0.5 * width),
            middle.map(|m| m + 0.5 * width),
        );
        let columns = Columns::on(solid.body(), lattice, pool)?;
        let step = width / n as f64;
        let too_many = || Error::TooLarge("the columns have too many intervals".into());
        let mut starts = reserve("columns", columns.starts.len())?;
        for &s in &columns.starts {
            starts.push(u32::try_from(s).map_err(|_| too_many())?);
        }
        let mut intervals = reserve("intervals of columns", columns.intervals.len())?;
        let mut target = 0.0;
        for i in &columns.intervals {
            let i = i.map(|t| (t / step) as f32);
            target += f64::from(i[1]) - f64::from(i[0]);
            intervals.push(i);
        }
        if target <= 0.0 {
            return Err(Error::ZeroVolume(format!("none of {n} × {n} columns meets the target")));
        }
        Ok(Dexels { lattice, step, dims: lattice.dims, starts, intervals, target })
    }

    /// Keeps what lies within all planes.
    pub(crate) fn clip(&mut self, planes: &[Plane]) {
        let (axis, mut kept, mut first) = (self.lattice.axis, 0, 0);
        self.target = 0.0;
        for c in 0..self.dims[0] * self.dims[1] {
            let place = self.point(c % self.dims[0], c / self.dims[0], 0.0);
            let place = Vec3::from(place.map(f64::from));
            let mut ends = [f32::MIN, f32::MAX];
            for plane in planes {
                let left = (plane.offset - plane.normal.dot(&place)) / self.step;
                let along = plane.normal[axis];
                if along.abs() < 1e-9 {
                    ends[1] = if left < 0.0 { f32::MIN } else { ends[1] };
                } else if along > 0.0 {
                    ends[1] = ends[1].min((left / along) as f32);
                } else {
                    ends[0] = ends[0].max((left / along) as f32);
                }
            }
            let last = std::mem::replace(&mut self.starts[c], kept as u32);
            let next = self.starts[c + 1] as usize;
            debug_assert_eq!(last as usize, first);
            for i in first..next {
                let [low, high] = self.intervals[i];
                let [low, high] = [low.max(ends[0]), high.min(ends[1])];
                if low < high {
                    self.intervals[kept] = [low, high];
                    self.target += f64::from(high) - f64::from(low);
                    kept += 1;
                }
            }
            first = next;
        }
        if let Some(last) = self.starts.last_mut() {
            *last = kept as u32;
        }
        self.intervals.truncate(kept);
    }

    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        (self.starts.len() * 4 + self.intervals.len() * 8) as u64
    }

    /// Volume of a unit of length in one column, unit frame.
    pub(crate) fn cell(&self) -> f64 {
        self.step.powi(3)
    }

    /// The lowest and highest end of all intervals.
    pub(crate) fn ends(&self) -> [f32; 2] {
        let ends = |[low, high]: [f32; 2], i: &[f32; 2]| [low.min(i[0]), high.max(i[1])];
        self.intervals.iter().fold([f32::MAX, f32::MIN], ends)
    }

    /// A ball along the columns.
    pub(crate) fn seen(&self, ball: &Ball) -> Seen {
        let l = &self.lattice;
        let [x, y, t] = l.turn(&Vec3::from(ball.center.map(f64::from)));
        let place = |k: usize, x: f64| ((x - l.origin[k]) / l.step[k] - 0.5) as f32;
        Seen {
            u: place(0, x),
            v: place(1, y),
            t: (t / self.step) as f32,
            r: (f64::from(ball.radius) / self.step) as f32,
        }
    }

    /// The point of column (a, b) at `t`, unit frame.
    pub(crate) fn point(&self, a: usize, b: usize, t: f32) -> [f32; 3] {
        let [x, y] = self.lattice.place(a, b);
        let mut p = [0.0; 3];
        p[self.lattice.axis] = (f64::from(t) * self.step) as f32;
        p[(self.lattice.axis + 1) % 3] = x as f32;
        p[(self.lattice.axis + 2) % 3] = y as f32;
        p
    }

    /// The intervals of column `c = a + dims[0] b`.
    #[inline(always)]
    pub(crate) fn column(&self, c: usize) -> &[[f32; 2]] {
        &self.intervals[self.starts[c] as usize..self.starts[c + 1] as usize]
    }

    /// Points inside, one in each of `n` equal parts of all lengths inside.
    pub(crate) fn points(&self, n: usize, random: &mut Random) -> Result<Vec<[f32; 3]>> {
        let mut out = reserve("points inside", n)?;
        let part = self.target / n.max(1) as f64;
        let (mut before, mut next) = (0.0, part * random.unit());
        for b in 0..self.dims[1] {
            for a in 0..self.dims[0] {
                for i in self.column(a + self.dims[0] * b) {
                    let length = f64::from(i[1]) - f64::from(i[0]);
                    while out.len() < n && next < before + length {
                        let t = f64::from(i[0]) + (next - before);
                        out.push(self.point(a, b, t as f32));
                        next = (out.len() as f64 + random.unit()) * part;
                    }
                    before += length;
                }
            }
        }
        Ok(out)
    }
}
