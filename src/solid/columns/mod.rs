//! Exact inside intervals along parallel columns: only two axes are sampled,
//! the third is exact. Used for coverage of cells, for moments of meshes that
//! cross themselves, and by every quality figure.

mod cells;
mod open;
mod raster;

pub(super) use raster::closed;

use crate::error::{Error, Result, filled, reserve};
use crate::math::Vec3;
use crate::run::Pool;
use crate::shape::Body;

/// Parallel columns through a body and the intervals of them that lie inside.
/// The columns run along `axis`; column (a, b) passes through
/// `lattice_origin + (a + ½) step[0]` and `… (b + ½) step[1]` on the other two
/// axes, taken in cyclic order (axis z: x, y; axis x: y, z; axis y: z, x).
#[derive(Debug, Clone)]
pub struct Columns {
    /// Direction of the columns: 0, 1 or 2.
    pub axis: usize,
    /// Number of columns along the other two axes.
    pub dims: [usize; 2],
    /// Lower corner of the lattice on the other two axes.
    pub lattice_origin: [f64; 2],
    /// Distance between columns.
    pub step: [f64; 2],
    /// Column `c = a + dims[0] * b` owns `intervals[starts[c]..starts[c + 1]]`.
    pub starts: Vec<usize>,
    /// Disjoint ascending intervals.
    pub intervals: Vec<[f64; 2]>,
    /// Length of column counted more than once by a signed sum (overlap of a mesh with itself)
    /// or negatively, times the column's area: what the polyhedral integral gets wrong.
    pub miscounted: f64,
}

/// Where the columns stand.
#[derive(Debug, Clone, Copy)]
struct Lattice {
    axis: usize,
    dims: [usize; 2],
    origin: [f64; 2],
    step: [f64; 2],
}

impl Lattice {
    /// Coordinate of the column `i` on the sampled axis `k` (0 or 1).
    fn at(&self, k: usize, i: usize) -> f64 {
        self.origin[k] + (i as f64 + 0.5) * self.step[k]
    }

    /// Number of columns whose coordinate on the sampled axis `k` is less than `x`.
    fn below(&self, k: usize, x: f64) -> usize {
        let n = self.dims[k];
        let guess = ((x - self.origin[k]) / self.step[k] - 0.5).ceil();
        let mut i = if guess > 0.0 { (guess as usize).min(n) } else { 0 };
        while i > 0 && self.at(k, i - 1) >= x {
            i -= 1;
        }
        while i < n && self.at(k, i) < x {
            i += 1;
        }
        i
    }

    /// A point as (first sampled axis, second sampled axis, along the column).
    fn turn(&self, p: &Vec3) -> [f64; 3] {
        [p[(self.axis + 1) % 3], p[(self.axis + 2) % 3], p[self.axis]]
    }

    /// The point of column (a, b) at `t` along the axis.
    fn point(&self, a: usize, b: usize, t: f64) -> Vec3 {
        let mut p = Vec3::zeros();
        p[self.axis] = t;
        p[(self.axis + 1) % 3] = self.at(0, a);
        p[(self.axis + 2) % 3] = self.at(1, b);
        p
    }
}

/// Rows of columns that are worked on together: fixed, so that results do not
/// depend on the number of threads.
const BAND: usize = 8;

/// The intervals of a band of rows, column after column.
#[derive(Debug, Default)]
struct Band {
    counts: Vec<u32>,
    intervals: Vec<[f64; 2]>,
    /// Miscounted length.
    miscounted: f64,
}

impl Columns {
    /// The columns of `body` (unit frame) on the given lattice.
    ///
    /// Meshes whose directed edges cancel (all clean ones): signed crossings, inside where
    /// the winding number is above ½; a column through an edge or a vertex is counted as one
    /// that passes an infinitesimal step beside it. Other meshes: the winding number between
    /// crossings, at a finite number of places over holes. Voxels: runs of cells.
    pub fn new(
        body: &Body,
        axis: usize,
        dims: [usize; 2],
        lattice_origin: [f64; 2],
        step: [f64; 2],
        pool: &Pool,
    ) -> Result<Columns> {
        let lattice = Lattice { axis, dims, origin: lattice_origin, step };
        let total = check(&lattice)?;
        let bands = match body {
            Body::Voxels(voxels) => cells::bands(voxels, &lattice, pool)?,
            Body::Mesh(mesh) if mesh.clean || closed(mesh)? => raster::bands(mesh, &lattice, pool)?,
            Body::Mesh(mesh) => open::bands(mesh, &lattice, pool)?,
        };
        let mut starts = reserve("columns", total + 1)?;
        let mut intervals =
            reserve("intervals of columns", bands.iter().map(|b| b.intervals.len()).sum())?;
        let (mut sum, mut miscounted) = (0usize, 0.0);
        starts.push(0);
        for band in &bands {
            for &n in &band.counts {
                sum += n as usize;
                starts.push(sum);
            }
            intervals.extend_from_slice(&band.intervals);
            miscounted += band.miscounted;
        }
        miscounted *= step[0] * step[1];
        Ok(Columns { axis, dims, lattice_origin, step, starts, intervals, miscounted })
    }

    /// The intervals of column (a, b).
    pub fn column(&self, a: usize, b: usize) -> &[[f64; 2]] {
        let c = a + self.dims[0] * b;
        &self.intervals[self.starts[c]..self.starts[c + 1]]
    }

    /// The point of column (a, b) at `t` along the axis.
    pub fn point(&self, a: usize, b: usize, t: f64) -> Vec3 {
        self.lattice().point(a, b, t)
    }

    /// Length of all intervals times the area of a column: the volume inside, by the midpoint
    /// rule over the two sampled axes.
    pub fn volume(&self) -> f64 {
        self.intervals.iter().map(|i| i[1] - i[0]).sum::<f64>() * self.step[0] * self.step[1]
    }

    fn lattice(&self) -> Lattice {
        Lattice { axis: self.axis, dims: self.dims, origin: self.lattice_origin, step: self.step }
    }
}

/// The number of columns.
fn check(l: &Lattice) -> Result<usize> {
    if l.axis > 2 {
        return Err(Error::InvalidArgument(format!("the axis of columns is {}, not 0–2", l.axis)));
    }
    for k in 0..2 {
        if !(l.step[k].is_normal() && l.step[k] > 0.0 && l.origin[k].is_finite()) {
            return Err(Error::InvalidArgument(format!(
                "the lattice of columns starts at {} with step {}",
                l.origin[k], l.step[k]
            )));
        }
    }
    l.dims[0].checked_mul(l.dims[1]).filter(|&n| n < u32::MAX as usize).ok_or_else(|| {
        Error::TooLarge(format!("{} × {} columns are too many", l.dims[0], l.dims[1]))
    })
}

/// `f(first row, rows)` for each band of rows, in order.
fn map_bands(
    lattice: &Lattice,
    pool: &Pool,
    f: impl Fn(usize, usize) -> Result<Band> + Sync + Send,
) -> Result<Vec<Band>> {
    let rows = lattice.dims[1];
    pool.map(rows.div_ceil(BAND), |i| f(i * BAND, BAND.min(rows - i * BAND))).into_iter().collect()
}

/// Pushes without aborting when memory is short.
fn push<T>(v: &mut Vec<T>, value: T) -> Result<()> {
    if v.len() == v.capacity() {
        v.try_reserve(v.len().max(256)).map_err(|_| {
            Error::OutOfMemory(format!("no memory for {} crossings of columns", v.len()))
        })?;
    }
    v.push(value);
    Ok(())
}

/// A band without intervals.
fn empty_band(columns: usize) -> Result<Band> {
    Ok(Band { counts: filled("columns", columns, 0)?, ..Band::default() })
}
