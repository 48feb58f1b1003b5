//! Which cells are in: those of which more than half is covered (Buchele et al. 2026, eq 5).
//!
//! Coverage is the mean length inside of k × k columns through a cell, taken
//! along x, where the arrays are contiguous. The columns of a cell lie
//! symmetrically about its centre and one runs through it, so a cell that a
//! plane cuts is in exactly when its centre is; what is sampled are edges,
//! corners and curvature.

use super::columns::Lattice;
use super::moments::wide_open;
use super::{Columns, Grid};
use crate::error::{Error, Result, filled};
use crate::run::Run;
use crate::shape::Body;

/// Columns per cell along each sampled axis; odd, so that one runs through the centre. On a ball
/// of 12 cells 3 decide as 12³ points do but for cells within 0.03 of a half.
const COLUMNS: usize = 3;
/// For meshes that are wide open, where a column costs many winding numbers.
const COLUMNS_OPEN: usize = 1;
/// The lattice is widened by this about the box's middle: faces at round fractions of a cell,
/// such as cell centres, then meet no column, and mirrored faces are decided alike.
const WIDER: f64 = 1.0 + 1.0 / (1u64 << 33) as f64;
/// Coverage above ½ by less than this is a tie, and out.
const TIE: f64 = 1.0 / (1u64 << 20) as f64;
/// Most columns made at once.
const AT_ONCE: usize = 1 << 21;

/// 1 for the cells of `grid` of which more than half is covered by `body`, a mesh that keeps
/// `padding` cells clear around it. Refused where that and what an open mesh needs may take more
/// than `limit` bytes.
pub fn inside(body: &Body, grid: &Grid, padding: usize, limit: u64, run: &Run) -> Result<Vec<u8>> {
    covered(body, grid, padding, columns_of(body, limit, run)?, limit, run)
}

/// Columns per cell along each sampled axis.
fn columns_of(body: &Body, limit: u64, run: &Run) -> Result<usize> {
    Ok(match body {
        Body::Mesh(m) if !m.clean && wide_open(m, limit, run)? => COLUMNS_OPEN,
        _ => COLUMNS,
    })
}

/// Whether some of the middle layers' cells are in.
pub(super) fn shows(
    body: &Body,
    grid: &Grid,
    padding: usize,
    limit: u64,
    run: &Run,
) -> Result<bool> {
    const LAYERS: usize = 2;
    let [nx, ny, nz] = grid.dims;
    if nz < LAYERS + 2 * padding {
        return Ok(false);
    }
    let mut some = Grid { dims: [nx, ny, LAYERS + 2 * padding], ..*grid };
    some.origin.z += (nz / 2 - padding - LAYERS / 2) as f64 * grid.spacing.z;
    let k = columns_of(body, limit, run)?;
    Ok(covered(body, &some, padding, k, limit, run)?.contains(&1))
}

/// As [`inside`], by `k` × `k` columns a cell.
fn covered(
    body: &Body,
    grid: &Grid,
    padding: usize,
    k: usize,
    limit: u64,
    run: &Run,
) -> Result<Vec<u8>> {
    let [nx, ny, nz] = grid.dims;
    if padding >= ny.div_ceil(2) || padding >= nz.div_ceil(2) {
        return Err(Error::InvalidArgument(format!(
            "padding of {padding} cells leaves nothing of a grid of {nx} × {ny} × {nz}"
        )));
    }
    let mut inside = filled("the inside of the grid", grid.len(), 0u8)?;
    let h = grid.spacing.x;
    let step = grid.spacing.map(|h| h * (WIDER / k as f64));
    let middle = grid.origin + grid.spacing.component_mul(&size(grid)) * 0.5;
    let (my, mz) = (ny - 2 * padding, nz - 2 * padding);
    let slab = (AT_ONCE / (my * k * k)).max(1);
    let half = TIE.mul_add(1.0, 0.5) * (k * k) as f64;
    for first in (0..mz).step_by(slab) {
        run.check(0.0, "finding the inside")?;
        let layers = slab.min(mz - first);
        let lattice_origin = [
            middle.y - 0.5 * (my * k) as f64 * step.y,
            middle.z + (first as f64 - 0.5 * mz as f64) * k as f64 * step.z,
        ];
        let dims = [my * k, layers * k];
        let lattice = Lattice::straight(0, dims, lattice_origin, [step.y, step.z]);
        let held = inside.len() as u64;
        let c = Columns::within(body, lattice, limit.saturating_sub(held), held, run)?;
        let from = grid.index(0, 0, padding + first);
        let to = grid.index(0, 0, padding + first + layers);
        let Some(part) = inside.get_mut(from..to) else { continue };
        run.pool().chunks_mut(part, nx * ny, |layer, cells| {
            let mut sum = vec![0.0f64; nx + 1];
            let mut whole = vec![0i32; nx + 1];
            for (j, row) in cells.chunks_mut(nx).enumerate().skip(padding).take(my) {
                sum.fill(0.0);
                whole.fill(0);
                let mut any = false;
                for b in layer * k..(layer + 1) * k {
                    for a in (j - padding) * k..(j - padding + 1) * k {
                        for t in c.column(a, b) {
                            any = true;
                            let u = t.map(|t| ((t - grid.origin.x) / h).clamp(0.0, nx as f64));
                            let (i0, i1) = (u[0] as usize, u[1] as usize);
                            // Part of the first and last cell; the whole of those between.
                            sum[i0] -= u[0] - i0 as f64;
                            sum[i1] += u[1] - i1 as f64;
                            whole[i0] += 1;
                            whole[i1] -= 1;
                        }
                    }
                }
                if any {
                    let mut n = 0;
                    for ((cell, s), w) in row.iter_mut().zip(&sum).zip(&whole) {
                        n += w;
                        *cell = u8::from(f64::from(n) + s > half);
                    }
                }
            }
        });
    }
    Ok(inside)
}

fn size(grid: &Grid) -> crate::math::Vec3 {
    crate::math::Vec3::from_fn(|a, _| grid.dims[a] as f64)
}
