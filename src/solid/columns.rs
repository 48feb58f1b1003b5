//! Exact inside intervals along parallel columns: only two axes are sampled,
//! the third is exact. Used for coverage of cells, for moments of meshes that
//! cross themselves, and by every quality figure.

use crate::error::{Error, Result};
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

impl Columns {
    /// The columns of `body` (unit frame) on the given lattice. Clean meshes by exact crossings;
    /// defective ones by the winding number between crossings; voxels by runs of cells.
    pub fn new(
        body: &Body,
        axis: usize,
        dims: [usize; 2],
        lattice_origin: [f64; 2],
        step: [f64; 2],
        pool: &Pool,
    ) -> Result<Columns> {
        let _ = (body, axis, dims, lattice_origin, step, pool);
        Err(Error::Internal("columns are not built yet".into()))
    }

    /// The intervals of column (a, b).
    pub fn column(&self, a: usize, b: usize) -> &[[f64; 2]] {
        let c = a + self.dims[0] * b;
        &self.intervals[self.starts[c]..self.starts[c + 1]]
    }

    /// The point of column (a, b) at `t` along the axis.
    pub fn point(&self, a: usize, b: usize, t: f64) -> Vec3 {
        let mut p = Vec3::zeros();
        p[self.axis] = t;
        p[(self.axis + 1) % 3] = self.lattice_origin[0] + (a as f64 + 0.5) * self.step[0];
        p[(self.axis + 2) % 3] = self.lattice_origin[1] + (b as f64 + 0.5) * self.step[1];
        p
    }
}
