//! The signed distance at cell centres, negative inside.
//!
//! Meshes: the exact distance to the triangles (promised within 0.01 cell; f32 leaves
//! less than 0.001), everywhere; the
//! sign is that of the cell's centre (which may differ from "more than half covered"),
//! from the same exact columns that decide coverage. Voxels: the exact Euclidean
//! distance transform of both sides, less what the surface lies before the nearest centre of
//! the other side (half a cell over faces along the axes).

mod bricks;
mod cells;
mod clusters;
mod corners;
mod features;
mod leaf;
mod regions;
mod sides;
mod space;
mod split;

use super::Solid;
use super::columns::{Columns, Lattice};
use crate::error::{Result, filled, fits};
use crate::run::Run;
use crate::shape::{Body, Mesh};

/// Signed distance at every cell centre, negative inside; unit frame.
pub(super) fn signed_distance(solid: &Solid, run: &Run) -> Result<Vec<f32>> {
    match solid.body() {
        Body::Mesh(mesh) => of_mesh(solid, mesh, run),
        Body::Voxels(_) => cells::signed_distance(solid.inside(), solid.grid(), run),
    }
}

/// The field of a mesh: distances brick by brick, then the sign along rows of cell centres.
fn of_mesh(solid: &Solid, mesh: &Mesh, run: &Run) -> Result<Vec<f32>> {
    run.check(0.0, "making the distance field")?;
    let grid = solid.grid();
    let cells = grid.len();
    let left = solid.memory_limit().saturating_sub(solid.bytes());
    let bytes = 4 * cells as u64;
    fits(format_args!("the distance field of {cells} cells"), bytes, left)?;
    let mut out = filled("the distance field", cells, 0.0f32)?;
    if out.is_empty() {
        return Ok(out);
    }
    let most = bricks::distances(mesh, grid, left - bytes, run, &mut out)?;
    sign(solid, left - bytes, run, &mut out)?;
    run.count(|c| c.peak_bytes = c.peak_bytes.max(solid.bytes() + bytes + most));
    Ok(out)
}

/// Turns the distances of cell centres inside to negative ones; takes no more than `room` bytes.
fn sign(solid: &Solid, room: u64, run: &Run, out: &mut [f32]) -> Result<()> {
    let grid = solid.grid();
    let [nx, ny, nz] = grid.dims;
    let (origin, step) = (grid.origin, grid.spacing);
    let lattice = Lattice::straight(0, [ny, nz], [origin.y, origin.z], [step.y, step.z]);
    let held = solid.bytes() + 4 * out.len() as u64;
    let columns = Columns::within(solid.body(), lattice, room, held, run)?;
    run.pool().chunks_mut(out, nx, |row, out| {
        for &[lo, hi] in columns.column(row % ny, row / ny) {
            // First centre at or after a place; the guess is a rounding off at most.
            let first = |x: f64| {
                let u = ((x - origin.x) / step.x - 0.5).ceil().clamp(0.0, nx as f64) as usize;
                let mut i = u.saturating_sub(1);
                while i < nx && grid.center(i, 0, 0).x < x {
                    i += 1;
                }
                i
            };
            for d in out.iter_mut().take(first(hi)).skip(first(lo)) {
                *d = -*d;
            }
        }
    });
    Ok(())
}
