//! Columns through voxels: runs of cells.

use super::{Band, Lattice, empty_band, push};
use crate::error::{Error, Result};
use crate::shape::Voxels;

pub(super) fn check(voxels: &Voxels) -> Result<()> {
    let [nx, ny, nz] = voxels.dims;
    let n = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
    if n != Some(voxels.cells.len()) {
        return Err(Error::Internal(format!("voxels hold {} cells", voxels.cells.len())));
    }
    Ok(())
}

/// The intervals of the rows `first..first + rows`.
pub(super) fn band(voxels: &Voxels, lattice: &Lattice, first: usize, rows: usize) -> Result<Band> {
    let [nx, ny, _] = voxels.dims;
    let axis = lattice.axis;
    let stride = [1, nx, nx * ny];
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    // The cell under a column; one on the face between two cells belongs to the upper cell.
    let under = |x: f64, a: usize| {
        let x = x / voxels.spacing[a];
        (x >= 0.0).then_some(x as usize).filter(|&c| c < voxels.dims[a])
    };
    let h = voxels.spacing[axis];
    let mut band = empty_band(rows * lattice.dims[0])?;
    let mut counts = band.counts.iter_mut();
    for b in first..first + rows {
        for (a, count) in (0..lattice.dims[0]).zip(&mut counts) {
            let [x, y] = lattice.place(a, b);
            let (Some(i), Some(j)) = (under(x, u), under(y, v)) else { continue };
            let base = i * stride[u] + j * stride[v];
            let mut start = None;
            for k in 0..voxels.dims[axis] {
                let solid = voxels.cells[base + k * stride[axis]] != 0;
                match (solid, start) {
                    (true, None) => start = Some(k),
                    (false, Some(s)) => {
                        push(&mut band.intervals, [s as f64 * h, k as f64 * h])?;
                        *count += 1;
                        start = None;
                    }
                    _ => {}
                }
            }
            if let Some(s) = start {
                push(&mut band.intervals, [s as f64 * h, voxels.dims[axis] as f64 * h])?;
                *count += 1;
            }
        }
    }
    Ok(band)
}
