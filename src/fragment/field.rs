//! The depth of a parent between the cells of its grid, better than by interpolation: each cell
//! knows the way to what is nearest, and the least of what the eight cells around a place make of
//! it keeps the creases of the depth, where balls are greatest, as sharp as they are.

use super::union::Union;
use crate::error::{Result, filled};
use crate::math::Vec3;
use crate::run::Run;
use crate::solid::Grid;
use crate::solid::nearest::Surface;
use wide::{i16x8, i32x4};

/// Cells that a thread takes at once.
const CHUNK: usize = 2048;
/// Outside cells farther than this from the surface, in cells, have no way.
const NEAR: f32 = 2.0;
/// The length of a direction.
const ONE: f32 = 16384.0;
/// The greatest depth, in units of a field.
const DEEPEST: f64 = 32766.0;

/// Bytes of a cell.
pub(super) const BYTES: u64 = size_of::<Cell>() as u64;

/// Depth at a cell's centre, less than 0 outside, in units of the field, and the direction in
/// which it grows.
pub(super) type Cell = [i16; 4];

/// The depth at the cells of a grid, in whole numbers, so that the planes of eight cells are
/// compared by a few instructions.
#[derive(Debug)]
pub(super) struct Field {
    cells: Vec<Cell>,
    unit: f64,
}

impl Field {
    /// Bytes that it holds.
    pub(super) fn bytes(&self) -> u64 {
        BYTES * self.cells.len() as u64
    }

    fn cell(&self, depth: f64, way: Vec3) -> Cell {
        let [x, y, z] = [way.x, way.y, way.z].map(|w| (w as f32 * ONE).round() as i16);
        [(depth / self.unit).clamp(-DEEPEST, DEEPEST).round() as i16, x, y, z]
    }
}

/// The depth in the solid at the cells of a grid; `distance` is the signed one there.
pub(super) fn of_solid(
    grid: &Grid,
    distance: &[f32],
    surface: &Surface,
    run: &Run,
) -> Result<Field> {
    let near = NEAR * grid.spacing.max() as f32;
    let deepest = distance.iter().fold(near, |most, d| most.max(-d));
    let mut field = Field { cells: Vec::new(), unit: f64::from(deepest) * 1.01 / DEEPEST };
    let mut out = filled("the depth of cells", distance.len(), Cell::default())?;
    run.pool().chunks_mut(&mut out, CHUNK, |chunk, out| {
        for (k, to) in out.iter_mut().enumerate() {
            let at = chunk * CHUNK + k;
            let Some(&value) = distance.get(at) else { continue };
            *to = field.cell(f64::from(-value), Vec3::zeros());
            if value < near {
                let p = center(grid, at);
                let reach = f64::from(value.abs()) * 1.01 + f64::from(near);
                if let Some(found) = surface.nearest_within(&p, reach) {
                    let sign = if value < 0.0 { 1.0 } else { -1.0 };
                    let way = (p - found.point) * (sign / found.distance.max(1e-300));
                    *to = field.cell(sign * found.distance, way);
                }
            }
        }
    });
    field.cells = out;
    Ok(field)
}

/// The same in solid and union together.
pub(super) fn narrowed(grid: &Grid, solid: &Field, union: &Union, run: &Run) -> Result<Field> {
    let near = f64::from(NEAR) * grid.spacing.max();
    let mut out = filled("the depth of cells", solid.cells.len(), Cell::default())?;
    run.pool().chunks_mut(&mut out, CHUNK, |chunk, out| {
        for (k, to) in out.iter_mut().enumerate() {
            let at = chunk * CHUNK + k;
            let Some(cell) = solid.cells.get(at) else { continue };
            *to = *cell;
            let own = f64::from(cell[0]) * solid.unit;
            if own > -near {
                let p = center(grid, at);
                let (depth, point) = union.nearest(&p);
                if depth < own {
                    let way =
                        (p - point) * (1.0 / if depth.abs() > 1e-300 { depth } else { 1e-300 });
                    *to = solid.cell(depth, way);
                }
            }
        }
    });
    Ok(Field { cells: out, unit: solid.unit })
}

fn center(grid: &Grid, at: usize) -> Vec3 {
    let [nx, ny, _] = grid.dims;
    grid.center(at % nx.max(1), at / nx.max(1) % ny.max(1), at / (nx * ny).max(1))
}

/// The depth between the cells, about a middle.
#[derive(Debug, Clone)]
pub(super) struct Planes<'a> {
    cells: &'a [Cell],
    row: usize,
    layer: usize,
    /// The first cell centre from the middle, cells to a length, and just below the last centre.
    origin: [f32; 3],
    inverse: [f32; 3],
    last: [f32; 3],
    /// Edges of a cell in units of depth, and those along y and z for both cells of a pair.
    edges: [f32; 3],
    next: [i16x8; 2],
    /// Of a sum over the products of two cells.
    unit: f32,
    /// Of a depth, more than half a cell's diagonal.
    far: i16,
}

impl<'a> Planes<'a> {
    pub(super) fn new(grid: &Grid, field: &'a Field, middle: &Vec3) -> Planes<'a> {
        let first = grid.center(0, 0, 0) - middle;
        let edges = [0, 1, 2].map(|a| (grid.spacing[a] / field.unit) as f32);
        let [_, y, z] = edges.map(|e| e.round() as i16);
        let diagonal = 0.5 * grid.spacing.norm() / field.unit + 2.0;
        Planes {
            cells: &field.cells,
            row: grid.dims[0],
            layer: grid.dims[0] * grid.dims[1],
            origin: [0, 1, 2].map(|a| first[a] as f32),
            inverse: [0, 1, 2].map(|a| (1.0 / grid.spacing[a]) as f32),
            last: grid.dims.map(|n| (n.saturating_sub(1) as f32).next_down().max(0.0)),
            edges,
            next: [[0, 0, y, 0, 0, 0, y, 0], [0, 0, 0, z, 0, 0, 0, z]].map(i16x8::new),
            unit: field.unit as f32 / ONE,
            far: (diagonal * 1.01).min(DEEPEST) as i16,
        }
    }

    /// The depth at the cell's centre that is nearest.
    #[inline]
    fn nearest(&self, p: &[f32; 3]) -> i16 {
        let strides = [1, self.row, self.layer];
        let mut at = 0;
        for a in 0..3 {
            let u = ((p[a] - self.origin[a]) * self.inverse[a]).max(0.0).min(self.last[a]);
            at += (u + 0.5) as u32 as usize * strides[a];
        }
        self.cells.get(at).map_or(0, |c| c[0])
    }

    /// Whether the nearest cell's centre is inside.
    pub(super) fn inside(&self, p: &Vec3) -> bool {
        self.nearest(&[p.x as f32, p.y as f32, p.z as f32]) > 0
    }

    /// Whether the depth at a place is more than a length.
    #[inline]
    pub(super) fn deeper(&self, p: &[f32; 3], than: f32) -> bool {
        let least = than / (self.unit * ONE);
        let about = f32::from(self.nearest(p)) - least;
        about > f32::from(self.far) || (about > -f32::from(self.far) && self.at(p).0 > than)
    }

    /// The depth at a place, clamped to the grid, and the way in which it grows.
    #[inline]
    pub(super) fn at(&self, p: &[f32; 3]) -> (f32, [f32; 3]) {
        let strides = [1, self.row, self.layer];
        let (mut at, mut t) = (0, [0i16; 3]);
        for a in 0..3 {
            let u = ((p[a] - self.origin[a]) * self.inverse[a]).max(0.0).min(self.last[a]);
            let whole = u as i32;
            at += whole as usize * strides[a];
            t[a] = ((u - whole as f32) * self.edges[a] + 0.5) as i32 as i16;
        }
        let Some(cells) = self.cells.get(at..at + self.layer + self.row + 2) else {
            return (0.0, [0.0; 3]);
        };
        let [x, y, z] = t;
        let before = x.wrapping_sub((self.edges[0] + 0.5) as i32 as i16);
        let here = i16x8::new([ONE as i16, x, y, z, ONE as i16, before, y, z]);
        let up = here - self.next[1];
        let starts = [0, self.row, self.layer, self.layer + self.row];
        let a = products(cells, starts[0], here);
        let b = products(cells, starts[1], here - self.next[0]);
        let c = products(cells, starts[2], up);
        let d = products(cells, starts[3], up - self.next[0]);
        // The last bits are nothing, and hold the number of the cell.
        let low = i32x4::new([a[0], a[2], b[0], b[2]]) + i32x4::new([a[1], a[3], b[1], b[3]]);
        let high = i32x4::new([c[0], c[2], d[0], d[2]]) + i32x4::new([c[1], c[3], d[1], d[3]]);
        let clear = i32x4::splat(!7);
        let low = (low & clear) | i32x4::new([0, 1, 2, 3]);
        let high = (high & clear) | i32x4::new([4, 5, 6, 7]);
        let [p, q, r, s] = low.min(high).to_array();
        let least = p.min(q).min(r.min(s));
        let which = (least & 7) as usize;
        let [_, x, y, z] = cells[starts[which >> 1] + (which & 1)];
        let part = |w: i16| f32::from(w) * (1.0 / ONE);
        (least as f32 * self.unit, [part(x), part(y), part(z)])
    }
}

/// Of two cells, each times four numbers: the sums of the first two and of the last two products.
#[inline(always)]
fn products(cells: &[Cell], at: usize, by: i16x8) -> [i32; 4] {
    let Some(&[[a, b, c, d], [e, f, g, h]]) = cells.get(at..).and_then(|c| c.first_chunk::<2>())
    else {
        return [0; 4];
    };
    i16x8::new([a, b, c, d, e, f, g, h]).dot(by).to_array()
}

#[cfg(test)]
mod tests {
    use super::super::spread::Random;
    use super::*;

    #[test]
    fn the_least_of_eight_planes_is_found() {
        let dims = [7, 6, 5];
        let spacing = Vec3::new(0.1, 0.13, 0.08);
        let grid = Grid { dims, spacing, origin: Vec3::new(3.0, 2.0, 1.0) };
        let mut random = Random::new(2);
        let mut unit = || f64::from(random.unit());
        let known: Vec<(f64, Vec3)> = (0..210)
            .map(|_| {
                let way = Vec3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalize();
                (unit() * 0.7 - 0.2, way)
            })
            .collect();
        let mut field = Field { cells: Vec::new(), unit: 0.8 / DEEPEST };
        field.cells = known.iter().map(|(depth, way)| field.cell(*depth, *way)).collect();
        let middle = Vec3::new(3.3, 2.4, 1.2);
        let lookup = Planes::new(&grid, &field, &middle);
        let (mut ways, mut deep) = (0, 0);
        for _ in 0..3000 {
            let at = Vec3::new(unit() * 6.0, unit() * 5.0, unit() * 4.0);
            let p = grid.center(0, 0, 0) + at.component_mul(&spacing);
            let planes = (0..8).map(|k| {
                let corner = [0, 1, 2].map(|a| (at[a] as usize).min(dims[a] - 2) + (k >> a & 1));
                let (depth, way) = known[corner[0] + 7 * (corner[1] + 6 * corner[2])];
                (depth + way.dot(&(p - grid.center(corner[0], corner[1], corner[2]))), way)
            });
            let mut planes: Vec<(f64, Vec3)> = planes.collect();
            planes.sort_by(|a, b| a.0.total_cmp(&b.0));
            let local = p - middle;
            let local = [local.x as f32, local.y as f32, local.z as f32];
            let (depth, way) = lookup.at(&local);
            assert!((f64::from(depth) - planes[0].0).abs() < 2e-4, "{depth} {:?}", planes[0]);
            if planes[1].0 - planes[0].0 > 1e-3 {
                ways += 1;
                assert!((Vec3::from(way.map(f64::from)) - planes[0].1).norm() < 1e-3);
            }
        }
        // The depth below a plane is told at a glance as by the planes themselves.
        let flat = |at: usize| field.cell(center(&grid, at).x - 3.35, Vec3::x());
        let flat = Field { cells: (0..210).map(flat).collect(), unit: field.unit };
        let lookup = Planes::new(&grid, &flat, &middle);
        for _ in 0..3000 {
            let x = 0.7 * unit() - 0.3;
            let p = [x as f32, 0.2 * unit() as f32, 0.1 * unit() as f32];
            let depth = x.clamp(-0.25, 0.35) - 0.05;
            if (depth - 0.1).abs() > 1e-3 {
                assert_eq!(lookup.deeper(&p, 0.1), depth > 0.1, "{x}");
                deep += usize::from(depth > 0.1);
            }
        }
        assert!(ways > 2500 && deep > 500, "{ways} {deep}");
    }
}
