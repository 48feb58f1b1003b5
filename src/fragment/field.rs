//! The depth of a parent between the cells of its grid, better than by interpolation: each cell
//! knows the way to what is nearest, and the least of what the eight cells around a place make of
//! it keeps the creases of the depth, where balls are greatest, as sharp as they are.

use super::union::Union;
use crate::error::{Result, filled};
use crate::math::Vec3;
use crate::run::Run;
use crate::solid::Grid;
use crate::solid::nearest::Surface;

/// Cells that a thread takes at once.
const CHUNK: usize = 2048;
/// Outside cells farther than this from the surface, in cells, have no way.
const NEAR: f32 = 2.0;
/// Steps of a direction's components.
const STEPS: f32 = 127.0;

/// Bytes of a cell.
pub(super) const BYTES: u64 = size_of::<Cell>() as u64;

/// Depth at a cell's centre, less than 0 outside, and the direction in which it grows.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Cell {
    depth: f32,
    way: [i8; 4],
}

impl Cell {
    fn new(depth: f64, way: Vec3) -> Cell {
        let [x, y, z] = [way.x, way.y, way.z].map(|w| (w as f32 * STEPS).round() as i8);
        Cell { depth: depth as f32, way: [x, y, z, 0] }
    }
}

/// The depth in the solid at the cells of a grid; `distance` is the signed one there.
pub(super) fn of_solid(
    grid: &Grid,
    distance: &[f32],
    surface: &Surface,
    run: &Run,
) -> Result<Vec<Cell>> {
    let near = NEAR * grid.spacing.max() as f32;
    let mut out = filled("the depth of cells", distance.len(), Cell::default())?;
    run.pool().chunks_mut(&mut out, CHUNK, |chunk, out| {
        for (k, to) in out.iter_mut().enumerate() {
            let at = chunk * CHUNK + k;
            let Some(&value) = distance.get(at) else { continue };
            *to = Cell { depth: -value, way: [0; 4] };
            if value < near {
                let p = center(grid, at);
                let reach = f64::from(value.abs()) * 1.01 + f64::from(near);
                if let Some(found) = surface.nearest_within(&p, reach) {
                    let sign = if value < 0.0 { 1.0 } else { -1.0 };
                    let way = (p - found.point) * (sign / found.distance.max(1e-300));
                    *to = Cell::new(sign * found.distance, way);
                }
            }
        }
    });
    Ok(out)
}

/// The same in solid and union together.
pub(super) fn narrowed(grid: &Grid, solid: &[Cell], union: &Union, run: &Run) -> Result<Vec<Cell>> {
    let near = NEAR * grid.spacing.max() as f32;
    let mut out = filled("the depth of cells", solid.len(), Cell::default())?;
    run.pool().chunks_mut(&mut out, CHUNK, |chunk, out| {
        for (k, to) in out.iter_mut().enumerate() {
            let at = chunk * CHUNK + k;
            let Some(cell) = solid.get(at) else { continue };
            *to = *cell;
            if cell.depth > -near {
                let p = center(grid, at);
                let (depth, point) = union.nearest(&p);
                if depth < f64::from(cell.depth) {
                    let way =
                        (p - point) * (1.0 / if depth.abs() > 1e-300 { depth } else { 1e-300 });
                    *to = Cell::new(depth, way);
                }
            }
        }
    });
    Ok(out)
}

fn center(grid: &Grid, at: usize) -> Vec3 {
    let [nx, ny, _] = grid.dims;
    grid.center(at % nx.max(1), at / nx.max(1) % ny.max(1), at / (nx * ny).max(1))
}

/// The depth between the cells, about a middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lookup<'a> {
    cells: &'a [Cell],
    row: usize,
    layer: usize,
    /// The first cell centre from the middle, cells to a length, and just below the last centre.
    origin: [f32; 3],
    inverse: [f32; 3],
    /// Edges of a cell, over the steps of a direction.
    edges: [f32; 3],
    last: [f32; 3],
}

impl<'a> Lookup<'a> {
    pub(super) fn new(grid: &Grid, cells: &'a [Cell], middle: &Vec3) -> Lookup<'a> {
        let first = grid.center(0, 0, 0) - middle;
        Lookup {
            cells,
            row: grid.dims[0],
            layer: grid.dims[0] * grid.dims[1],
            origin: [0, 1, 2].map(|a| first[a] as f32),
            inverse: [0, 1, 2].map(|a| (1.0 / grid.spacing[a]) as f32),
            edges: [0, 1, 2].map(|a| grid.spacing[a] as f32 / STEPS),
            last: grid.dims.map(|n| (n.saturating_sub(1) as f32).next_down().max(0.0)),
        }
    }

    /// Whether the nearest cell's centre is inside.
    pub(super) fn inside(&self, p: &Vec3) -> bool {
        let strides = [1, self.row, self.layer];
        let at = (0..3).map(|a| {
            let u = (p[a] as f32 - self.origin[a]) * self.inverse[a];
            (u.max(0.0).min(self.last[a]) + 0.5) as usize * strides[a]
        });
        self.cells.get(at.sum::<usize>()).is_some_and(|c| c.depth > 0.0)
    }

    /// The depth at a place, clamped to the grid, and the way in which it grows.
    #[inline]
    pub(super) fn at(&self, p: &[f32; 3]) -> (f32, [f32; 3]) {
        let strides = [1, self.row, self.layer];
        let (mut at, mut t) = (0, [[0.0f32; 2]; 3]);
        for a in 0..3 {
            let u = ((p[a] - self.origin[a]) * self.inverse[a]).max(0.0).min(self.last[a]);
            let whole = u as usize;
            at += whole * strides[a];
            let from = u - whole as f32;
            t[a] = [from * self.edges[a], (from - 1.0) * self.edges[a]];
        }
        let Some(cells) = self.cells.get(at..at + self.layer + self.row + 2) else {
            return (0.0, [0.0; 3]);
        };
        let (mut least, mut way) = (f32::MAX, [0; 4]);
        for (dz, cells) in [(0, &cells[..self.row + 2]), (1, &cells[self.layer..])] {
            for (dy, cells) in [(0, &cells[..2]), (1, &cells[self.row..self.row + 2])] {
                for (dx, c) in cells.iter().enumerate() {
                    let [x, y, z, _] = c.way.map(f32::from);
                    let depth = c.depth + x * t[0][dx & 1] + y * t[1][dy] + z * t[2][dz];
                    if depth < least {
                        (least, way) = (depth, c.way);
                    }
                }
            }
        }
        let [x, y, z, _] = way.map(|w| f32::from(w) / STEPS);
        (least, [x, y, z])
    }
}
