//! The signed distance at cell centres, negative inside.
//!
//! Meshes: the exact distance to the triangles (promised within 0.01 cell; f32 leaves
//! less than 0.001), everywhere; the
//! sign is that of the cell's centre (which may differ from "more than half covered"),
//! from the same exact columns that decide coverage. Voxels: the exact Euclidean
//! distance transform of both sides, less what the surface lies before the nearest centre of
//! the other side (half a cell over faces along the axes).

mod band;
mod bricks;
mod cells;
mod clusters;
mod corners;
mod facet;
mod far;
mod features;
mod leaf;
mod margins;
mod regions;
mod sides;
mod space;
mod split;

use super::columns::{Columns, Lattice};
use super::{Grid, Solid, grid};
use crate::error::{Result, filled, fits};
use crate::run::Run;
use crate::shape::{Body, Mesh};

/// Signed distance at every cell centre, negative inside; unit frame.
pub(super) fn signed_distance(solid: &Solid, run: &Run) -> Result<Vec<f32>> {
    match solid.body() {
        Body::Mesh(mesh) => of_mesh(solid, mesh, run),
        Body::Voxels(_) => cells::signed_distance(solid.inside()?, solid.grid(), run),
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
    sign(solid, grid, left - bytes, run, &mut out)?;
    run.count(|c| c.peak_bytes = c.peak_bytes.max(solid.bytes() + bytes + most));
    Ok(out)
}

/// The signed distance for searches, with its grid: exact near the surface, beyond 1.8 cells about
/// a tenth of a cell too far, and much cheaper. At cells of the solid's edge, or larger ones:
/// `cells` along the longest edge, as far as the body is not too thin for that.
pub(crate) fn rough(solid: &Solid, cells: u32, run: &Run) -> Result<(Grid, Vec<f32>)> {
    let Body::Mesh(mesh) = solid.body() else {
        return Ok((*solid.grid(), solid.distance(run)?.to_vec()));
    };
    run.check(0.0, "making the distance field")?;
    let grid = grid::coarser(solid, mesh, cells);
    let cells = grid.len();
    let left = solid.memory_limit().saturating_sub(solid.bytes());
    let bytes = 4 * cells as u64;
    fits(format_args!("the distance field of {cells} cells"), bytes, left)?;
    let mut out = filled("the distance field", cells, 0.0f32)?;
    let most = band::distances(mesh, &grid, left - bytes, run, &mut out)?;
    sign(solid, &grid, left - bytes, run, &mut out)?;
    run.count(|c| c.peak_bytes = c.peak_bytes.max(solid.bytes() + bytes + most));
    Ok((grid, out))
}

/// Turns the distances of cell centres inside to negative ones; takes no more than `room` bytes.
fn sign(solid: &Solid, grid: &Grid, room: u64, run: &Run, out: &mut [f32]) -> Result<()> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{ImportOptions, Primitive, Shape};
    use crate::solid::{Resolution, SolidOptions};

    #[test]
    fn rough_distances_are_exact_near_the_surface_and_close_beyond() {
        let run = Run::serial();
        for (name, segments) in [("torus", 40), ("stone", 90), ("box", 16), ("cone", 30)] {
            let primitive = Primitive::from_name(name).unwrap();
            let shape =
                Shape::from_primitive(&primitive, segments, &ImportOptions::default(), &run)
                    .unwrap();
            let options =
                SolidOptions { resolution: Resolution::CellsLongest(37), ..Default::default() };
            let solid = Solid::new(&shape, &options, &run).unwrap();
            let (grid, found) = rough(&solid, 64, &run).unwrap();
            assert_eq!(&grid, solid.grid());
            let exact = solid.distance(&run).unwrap();
            let h = grid.spacing.x as f32;
            let (mut worst, mut sum, mut near) = (0.0f32, 0.0f32, 0);
            for (x, y) in found.iter().zip(exact) {
                let (x, y) = (x / h, y / h);
                let far = (x - y) * y.signum();
                if y.abs() < 1.79 {
                    near += 1;
                    assert!(far.abs() < 2e-3, "{name}: {x} for {y}");
                } else {
                    assert!(far > -2e-3, "{name}: {x} for {y}");
                    worst = worst.max(far);
                    sum += far;
                }
            }
            let mean = sum / (found.len() - near) as f32;
            assert!(near > 2000 && worst < 1.0 && mean < 0.15, "{name}: {near} {worst} {mean}");
            let two = Run::new(2).unwrap();
            assert_eq!(rough(&solid, 64, &two).unwrap().1, found);
        }
    }

    #[test]
    fn coarser_grids_hold_the_mesh_and_show_what_is_thin() {
        let run = Run::serial();
        let of = |p: Primitive| {
            let shape = Shape::from_primitive(&p, 40, &ImportOptions::default(), &run).unwrap();
            Solid::new(&shape, &SolidOptions::default(), &run).unwrap()
        };
        let ball = of(Primitive::Sphere { radius: 1.0 });
        let (grid, found) = rough(&ball, 20, &run).unwrap();
        assert!(grid.dims.iter().all(|&n| (27..30).contains(&n)), "{:?}", grid.dims);
        let middle = grid.trilinear(&found, &ball.unit_moments().centroid);
        let radius = 1.0 / ball.frame().scale;
        assert!((middle + radius).abs() < grid.spacing.x, "{middle} {radius}");
        let plate = of(Primitive::Box { edges: [1.0, 1.0, 0.05] });
        let (grid, found) = rough(&plate, 20, &run).unwrap();
        assert!(found.iter().any(|d| *d < 0.0) && grid.dims[0] > 60, "{:?}", grid.dims);
    }
}
