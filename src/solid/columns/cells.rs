//! Columns through voxels: runs of cells.

use super::{Band, Lattice, empty_band, map_bands, push};
use crate::error::{Error, Result, reserve};
use crate::run::Pool;
use crate::shape::Voxels;

pub(super) fn bands(voxels: &Voxels, lattice: &Lattice, pool: &Pool) -> Result<Vec<Band>> {
    let [nx, ny, nz] = voxels.dims;
    let n = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
    if n != Some(voxels.cells.len()) {
        return Err(Error::Internal(format!("voxels hold {} cells", voxels.cells.len())));
    }
    let axis = lattice.axis;
    let stride = [1, nx, nx * ny];
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    // The cell under each column; a column on the face between two cells belongs to the upper one.
    let under = |k: usize, a: usize| -> Result<Vec<Option<usize>>> {
        let mut out = reserve("columns", lattice.dims[k])?;
        for i in 0..lattice.dims[k] {
            let x = lattice.at(k, i) / voxels.spacing[a];
            let cell = (x >= 0.0).then_some(x as usize).filter(|&c| c < voxels.dims[a]);
            out.push(cell);
        }
        Ok(out)
    };
    let (us, vs) = (under(0, u)?, under(1, v)?);
    let h = voxels.spacing[axis];
    map_bands(lattice, pool, |first, rows| {
        let mut band = empty_band(rows * lattice.dims[0])?;
        let mut counts = band.counts.iter_mut();
        for row in &vs[first..first + rows] {
            for (column, count) in us.iter().zip(&mut counts) {
                let (Some(i), Some(j)) = (column, row) else { continue };
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
    })
}
