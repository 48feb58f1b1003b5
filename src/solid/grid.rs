//! The grid of a solid and how fine it is.

use super::{Solid, SolidOptions, coverage, lids, moments};
use crate::error::{Error, Result, filled};
use crate::math::{Moments, Vec3};
use crate::run::{Run, Stage};
use crate::shape::{Body, Mesh, Shape, Voxels};
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, OnceLock};

/// How fine a grid is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Resolution {
    /// Cells along the longest edge of the bounding box.
    CellsLongest(u32),
    /// Cells along the shortest edge of the bounding box (the rule of Buchele et al. 2026).
    CellsShortest(u32),
    /// Cells along the diameter of the sphere of equal volume.
    CellsDiameter(u32),
    /// Edge length of a cell, in the caller's unit.
    CellSize(f64),
}

/// A grid of cells in the unit frame; values sit at the cell centres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Cells along x, y, z.
    pub dims: [usize; 3],
    /// Edge lengths of a cell.
    pub spacing: Vec3,
    /// Lower corner of the cell (0, 0, 0).
    pub origin: Vec3,
}

impl Grid {
    /// Number of cells.
    pub fn len(&self) -> usize {
        self.dims[0] * self.dims[1] * self.dims[2]
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position of the cell (i, j, k) in the arrays: x fastest.
    pub fn index(&self, i: usize, j: usize, k: usize) -> usize {
        i + self.dims[0] * (j + self.dims[1] * k)
    }

    /// Centre of the cell (i, j, k).
    pub fn center(&self, i: usize, j: usize, k: usize) -> Vec3 {
        self.origin
            + Vec3::new(i as f64 + 0.5, j as f64 + 0.5, k as f64 + 0.5).component_mul(&self.spacing)
    }

    /// The value between cell centres: trilinear, clamped to the grid outside it.
    pub fn trilinear(&self, values: &[f32], p: &Vec3) -> f64 {
        let mut base = [0usize; 3];
        let mut t = [0.0; 3];
        for a in 0..3 {
            let last = self.dims[a].saturating_sub(1);
            let u = ((p[a] - self.origin[a]) / self.spacing[a] - 0.5).clamp(0.0, last as f64);
            base[a] = (u as usize).min(last.saturating_sub(1));
            t[a] = u - base[a] as f64;
        }
        let mut sum = 0.0;
        for corner in 0..8 {
            let mut weight = 1.0;
            let mut at = base;
            for a in 0..3 {
                if corner >> a & 1 == 1 {
                    weight *= t[a];
                    at[a] = (at[a] + 1).min(self.dims[a] - 1);
                } else {
                    weight *= 1.0 - t[a];
                }
            }
            if weight != 0.0 {
                sum += weight * f64::from(values[self.index(at[0], at[1], at[2])]);
            }
        }
        sum
    }
}

/// Bytes that the arrays of the whole pipeline may hold per cell at once: inside 1, distance 4,
/// nearest triangle or transform 8, and the generator's own distances and marks 11.
pub const BYTES_PER_CELL: u64 = 24;
/// Most cells of a grid.
const MOST_CELLS: u64 = 1 << 31;
/// Most cells that a grid made finer for a thin shape may have (100 MB, some seconds).
const MOST_REFINED: f64 = (4u64 << 20) as f64;
/// The same where fewer show nothing of the shape.
const MOST_NEEDED: f64 = (16u64 << 20) as f64;
/// Cells wanted across the shortest edge of the box.
const ACROSS_BOX: f64 = 4.0;
/// Cells wanted across the mean thickness 2V/A (the thickness of a plate; half the
/// diameter of a rod; a third of a ball's).
pub(crate) const ACROSS_THICKNESS: f64 = 1.5;
/// Fewest cells across it that show a plate: a little below 1, which makes it one cell thick,
/// not two that are half covered.
const ACROSS_LEAST: f64 = 0.9;

/// A grid of larger cells about a solid's mesh, `cells` along its longest edge or more where it is
/// thin; the solid's own where that is not finer.
pub(super) fn coarser(solid: &Solid, mesh: &Mesh, cells: u32) -> Grid {
    let grid = solid.grid();
    let Some((lo, hi)) = moments::bounds(mesh) else { return *grid };
    let edges = hi - lo;
    let thickness = 2.0 * solid.unit_moments().volume / moments::area(mesh);
    let wanted = (edges.min() / ACROSS_BOX).min(thickness / ACROSS_THICKNESS);
    let h = (edges.max() / f64::from(cells.max(1))).min(wanted);
    if h.is_nan() || h <= 1.001 * grid.spacing.x {
        return *grid;
    }
    let dims = [0, 1, 2].map(|a| (edges[a] / h).ceil().max(1.0) as usize + 2 * ROOM);
    about([lo, hi], dims, h)
}

/// So many cubic cells about the middle of a box.
pub(super) fn about([lo, hi]: [Vec3; 2], dims: [usize; 3], edge: f64) -> Grid {
    let half = Vec3::new(dims[0] as f64, dims[1] as f64, dims[2] as f64) * (0.5 * edge);
    Grid { dims, spacing: Vec3::repeat(edge), origin: (lo + hi) * 0.5 - half }
}

/// Empty cells about the mesh in a coarser grid.
const ROOM: usize = 4;

/// Makes the solid: grid, inside, moments.
pub(super) fn build(shape: &Shape, options: &SolidOptions, run: &Run) -> Result<Solid> {
    if options.padding < 2 {
        return Err(Error::InvalidArgument(format!(
            "padding is {} cells, less than 2",
            options.padding
        )));
    }
    let mut notes = Vec::new();
    let lidded =
        run.time(Stage::Solid, || lids::of_shape(shape, options.memory_limit, &mut notes, run))?;
    let shape = lidded.as_ref().unwrap_or(shape);
    let moments =
        run.time(Stage::Moments, || moments::within(&shape.body, options.memory_limit, run))?;
    run.time(Stage::Solid, || {
        if moments.relative_error > 0.0 {
            notes.push(format!(
                "the surface is open or crosses itself: moments by columns, within {:.2e}",
                moments.relative_error
            ));
        }
        let (grid, inside) = match &*shape.body {
            Body::Voxels(v) => {
                let (grid, inside) = of_voxels(v, options)?;
                (grid, Some(inside))
            }
            Body::Mesh(m) => of_mesh(shape, m, &moments, options, &mut notes, run)?,
        };
        let cells = grid.len() as u64;
        run.count(|c| {
            c.cells += cells;
            c.peak_bytes = c.peak_bytes.max(cells);
        });
        Ok(Solid {
            body: Arc::clone(&shape.body),
            frame: shape.frame,
            grid,
            padding: options.padding,
            early: inside.is_some(),
            inside: inside.map(OnceLock::from).unwrap_or_default(),
            distance: OnceLock::new(),
            surface: OnceLock::new(),
            moments,
            notes,
            memory_limit: options.memory_limit,
            held: Arc::new(AtomicU64::new(cells)),
            told: OnceLock::new(),
        })
    })
}

/// Refuses a grid that is too large, before anything is reserved for it.
fn check(dims: [f64; 3], limit: u64) -> Result<()> {
    let cells = dims[0] * dims[1] * dims[2];
    let bytes = cells * BYTES_PER_CELL as f64;
    if bytes > limit as f64 {
        return Err(Error::MemoryLimit(format!(
            "a grid of {} × {} × {} = {cells:.0} cells may take {bytes:.0} bytes \
             ({BYTES_PER_CELL} a cell), more than the limit of {limit}",
            dims[0], dims[1], dims[2]
        )));
    }
    if cells > MOST_CELLS as f64 {
        return Err(Error::TooLarge(format!(
            "a grid of {} × {} × {} cells has more than {MOST_CELLS}",
            dims[0], dims[1], dims[2]
        )));
    }
    Ok(())
}

/// The voxels' own cells, with padding.
fn of_voxels(v: &Voxels, options: &SolidOptions) -> Result<(Grid, Vec<u8>)> {
    let p = options.padding;
    check(v.dims.map(|n| n as f64 + 2.0 * p as f64), options.memory_limit)?;
    let dims = v.dims.map(|n| n + 2 * p);
    let grid = Grid { dims, spacing: v.spacing, origin: -v.spacing * p as f64 };
    let mut inside = filled("the inside of the grid", grid.len(), 0u8)?;
    for (row, cells) in v.cells.chunks(v.dims[0].max(1)).enumerate() {
        let (j, k) = (row % v.dims[1].max(1), row / v.dims[1].max(1));
        let at = grid.index(p, j + p, k + p);
        if let Some(to) = inside.get_mut(at..at + cells.len()) {
            to.copy_from_slice(cells);
        }
    }
    Ok((grid, inside))
}

/// With this much memory for closed meshes of no more faces than that, or other meshes of no more
/// than that, the cells inside can be found later: columns need some hundred bytes a face at most,
/// of a mesh with openings less than a thousand.
const AMPLE: (u64, [usize; 2]) = (1 << 28, [1 << 20, 1 << 17]);

/// Cubic cells about the middle of the box, as fine as asked for, or finer where the shape is thin;
/// which are inside, where that cannot wait.
fn of_mesh(
    shape: &Shape,
    mesh: &Mesh,
    moments: &Moments,
    options: &SolidOptions,
    notes: &mut Vec<String>,
    run: &Run,
) -> Result<(Grid, Option<Vec<u8>>)> {
    let Some((lo, hi)) = moments::bounds(mesh) else {
        return Err(Error::Empty("the mesh has no face".into()));
    };
    let edges = hi - lo;
    let count = |n: u32| match n {
        0 => Err(Error::InvalidArgument("the number of cells is 0".into())),
        n => Ok(f64::from(n)),
    };
    let (asked, may_refine) = match options.resolution {
        Resolution::CellsLongest(n) => (edges.max() / count(n)?, true),
        Resolution::CellsShortest(n) => (edges.min() / count(n)?, true),
        Resolution::CellsDiameter(n) => {
            ((6.0 / std::f64::consts::PI * moments.volume).cbrt() / count(n)?, true)
        }
        Resolution::CellSize(size) => {
            if !(size.is_finite() && size > 0.0) {
                return Err(Error::InvalidArgument(format!("the cell size is {size}")));
            }
            let least = shape.frame.scale * 1e-10;
            if size < least {
                return Err(Error::MemoryLimit(format!(
                    "cells of {size} are too small for a shape of size {}",
                    shape.frame.scale
                )));
            }
            (size / shape.frame.scale, false)
        }
    };
    let dims_of = |h: f64| {
        [0, 1, 2].map(|a| (edges[a] / h - 1e-9).ceil().max(1.0) + 2.0 * options.padding as f64)
    };
    check(dims_of(asked), options.memory_limit)?;

    // Finer for a thin shape, as far as that stays cheap.
    let thickness = 2.0 * moments.volume / moments::area(mesh);
    let wanted = (edges.min() / ACROSS_BOX).min(thickness / ACROSS_THICKNESS);
    let least = thickness / ACROSS_LEAST;
    let room = (options.memory_limit / BYTES_PER_CELL) as f64;
    let cells_of = |h: f64| dims_of(h).iter().product::<f64>();
    let fits = |h: f64, most: f64| cells_of(h) <= most.min(room);
    let mut h = asked;
    if may_refine && wanted < asked {
        if fits(wanted, MOST_REFINED) {
            h = wanted;
        } else {
            // The finest of 64 steps between the two that fits.
            let step = |i: u32| asked * (wanted / asked).powf(f64::from(i) / 64.0);
            h = (1..64).rev().map(step).find(|&h| fits(h, MOST_REFINED)).unwrap_or(asked);
        }
    }
    let made = |h: f64| {
        let dims = dims_of(h).map(|n| n as usize);
        let grid = about([lo, hi], dims, h);
        let limit = options.memory_limit;
        let (body, padding) = (&shape.body, options.padding);
        let most = AMPLE.1[usize::from(!mesh.clean)];
        let ample = limit >= AMPLE.0 && mesh.faces.len() <= most;
        if ample && coverage::shows(body, &grid, padding, limit, run)? {
            return Ok((true, grid, None));
        }
        let inside = coverage::inside(body, &grid, padding, limit, run)?;
        Ok((inside.contains(&1), grid, Some(inside)))
    };
    let (mut shown, mut grid, mut inside) = made(h)?;
    if !shown && may_refine && least < h && fits(least, MOST_NEEDED) {
        h = least;
        (shown, grid, inside) = made(h)?;
    }
    let scale = shape.frame.scale;
    if h < asked {
        notes.push(format!(
            "the shape is thin (about {:.3e}): cells of {:.3e} instead of {:.3e}",
            thickness * scale,
            h * scale,
            asked * scale
        ));
    }
    // How many cells lie across the shape, and what to ask for to have enough of them.
    let short_of = |enough: f64| {
        format!(
            "about {:.2} cells of {:.3e} lie across its thickness of {:.3e}; for {:.1} ask for cells \
             of {:.3e}, {} along its longest edge (which may take {:.1e} bytes)",
            thickness / h,
            h * scale,
            thickness * scale,
            thickness / enough,
            enough * scale,
            (edges.max() / enough).ceil(),
            cells_of(enough) * BYTES_PER_CELL as f64
        )
    };
    if wanted < h * (1.0 - 1e-9) {
        notes.push(format!("the shape is thin: {}", short_of(wanted)));
    }
    if !shown && h >= edges.max() {
        return Err(Error::Empty(format!(
            "cells of {:.3e} are larger than the shape, {:.3e} along its longest edge",
            h * scale,
            edges.max() * scale
        )));
    }
    if !shown {
        return Err(Error::Empty(format!(
            "the shape is too thin for its grid, no cell is more than half covered: {}",
            short_of(thickness / ACROSS_THICKNESS)
        )));
    }
    Ok((grid, inside))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{ImportOptions, Primitive};

    #[test]
    fn between_nodes_a_linear_field_is_exact_and_beyond_them_clamped() {
        let (spacing, origin) = (Vec3::new(0.5, 0.25, 1.0), Vec3::new(-1.0, 2.0, 0.5));
        // One cell along y: nothing changes there.
        for dims in [[4, 3, 5], [4, 1, 5]] {
            let grid = Grid { dims, spacing, origin };
            let linear = |p: &Vec3| 1.0 + 2.0 * p.x - 3.0 * p.y + 0.5 * p.z;
            let mut values = vec![0.0f32; grid.len()];
            for k in 0..dims[2] {
                for j in 0..dims[1] {
                    for i in 0..dims[0] {
                        values[grid.index(i, j, k)] = linear(&grid.center(i, j, k)) as f32;
                    }
                }
            }
            let [lo, hi] =
                [grid.center(0, 0, 0), grid.center(dims[0] - 1, dims[1] - 1, dims[2] - 1)];
            let (mut within, mut beyond) = (0, 0);
            for n in 0..1000 {
                // From a cell below the grid to one above it.
                let at = |step: usize| (n * step % 1000) as f64 / 999.0;
                let t = Vec3::new(at(1), at(37), at(411));
                let size = Vec3::from_fn(|a, _| (dims[a] + 2) as f64 * spacing[a]);
                let p = origin - spacing + size.component_mul(&t);
                let clamped = p.sup(&lo).inf(&hi);
                let found = grid.trilinear(&values, &p);
                assert!((found - linear(&clamped)).abs() < 1e-12, "{p} {found}");
                *(if p == clamped { &mut within } else { &mut beyond }) += 1;
            }
            assert!(beyond > 100 && (dims[1] == 1 || within > 100), "{within} {beyond}");
        }
    }

    #[test]
    fn the_distance_between_cells_is_that_of_a_ball() {
        let run = Run::serial();
        let ball = Primitive::Sphere { radius: 1.0 };
        let shape = Shape::from_primitive(&ball, 128, &ImportOptions::default(), &run).unwrap();
        let options =
            SolidOptions { resolution: Resolution::CellsLongest(32), ..SolidOptions::default() };
        let solid = Solid::new(&shape, &options, &run).unwrap();
        let (scale, h) = (shape.frame.scale, solid.grid().spacing.x * shape.frame.scale);
        for n in 0..1000 {
            // Off the cell centres, from inside to almost the end of the padding.
            let r = 0.3 + 0.85 * f64::from(n) / 999.0;
            let z = 1.0 - f64::from(n * 7 % 1000) / 499.5;
            let (sin, cos) = (2.4 * f64::from(n)).sin_cos();
            let flat = (1.0 - z * z).max(0.0).sqrt();
            let p = Vec3::new(flat * cos, flat * sin, z) * r;
            let found = solid.distance_at(&run, &shape.frame.to_unit(&p)).unwrap() * scale;
            // h²/8 times the second derivatives, 2/r near by; the mesh lies 0.0006 within.
            let error = found - (r - 1.0);
            assert!((-1e-4..h * h / 4.0 / (r - h) + 1e-3).contains(&error), "{p} {error}");
        }
        // Beyond the grid: the value of its border.
        let far = shape.frame.to_unit(&Vec3::new(50.0, 0.0, 0.0));
        let far = solid.distance_at(&run, &far).unwrap() * scale;
        assert!((far - 3.5 * h).abs() < 0.1 * h, "{far}");
    }
}
