//! What MSS works on: the cells of the solid, their distance transform, and the
//! true depth of a point.

use super::depth::Rims;
use super::lattice::{Ball, Lattice};
use super::slots::without_slots;
use super::symmetry::Mirrors;
use super::transform;
use crate::error::{Error, Result, filled};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::shape::{Body, Mesh};
use crate::solid::nearest::Surface;
use crate::solid::{Grid, Solid};
use std::sync::atomic::{AtomicU64, Ordering};

/// The target on a lattice whose unit is the cell, with the centre of cell (0, 0, 0) as origin.
pub(super) struct Target<'a> {
    pub lattice: Lattice,
    /// The solid cells.
    pub bits: Vec<u64>,
    /// How many they are.
    pub cells: u64,
    /// E: distance from each solid cell to the nearest empty one.
    pub distance: Vec<f32>,
    pub mirrors: Mirrors,
    /// Not for meshes whose every triangle is a boundary of the solid.
    rims: Option<Rims>,
    truth: Option<Truth<'a>>,
}

/// The solid behind the cells.
struct Truth<'a> {
    solid: &'a Solid,
    /// Length of one cell in the unit frame.
    cell: f64,
    mesh: bool,
    /// Where exact distances are asked for.
    surface: Option<&'a Surface>,
    /// How many of them were.
    asked: AtomicU64,
}

impl<'a> Target<'a> {
    /// The target of a solid; `confine`: spheres are held to its true surface.
    pub fn of(solid: &'a Solid, confine: bool, run: &Run) -> Result<Target<'a>> {
        let grid = solid.grid();
        let (cell, step) = cell_and_step(&grid.spacing);
        let mesh = matches!(solid.body(), Body::Mesh(_));
        let mut target = Target::bare(solid.inside()?, grid.dims, step, run)?;
        match solid.body() {
            // Neither open nor crossing itself: every triangle is a boundary of the solid.
            Body::Mesh(m) if m.clean && solid.unit_moments().relative_error == 0.0 => {
                target.keep_off_slots(m, grid, run)?;
            }
            _ => target.rims = Some(Rims::find(&target.lattice, &target.bits)?),
        }
        let surface = if mesh || confine { Some(solid.surface(run)?) } else { None };
        target.truth = Some(Truth { solid, cell, mesh, surface, asked: AtomicU64::new(0) });
        Ok(target)
    }

    /// The target of bare cells, whose depth is not known.
    fn bare(mask: &[u8], dims: [usize; 3], step: [f64; 3], run: &Run) -> Result<Target<'a>> {
        let lattice = Lattice::new(dims, step);
        let bits = lattice.pack(mask)?;
        let cells = bits.iter().map(|w| u64::from(w.count_ones())).sum();
        if cells == 0 {
            return Err(Error::Empty("no cell of the grid is solid".into()));
        }
        let mut distance = filled("the distance transform", mask.len(), 0f32)?;
        transform::distance(&lattice, &bits, dims, &mut distance, run.pool())?;
        run.count(|c| c.transforms += 1);
        let mirrors = Mirrors::find(&lattice, &bits);
        Ok(Target { lattice, bits, cells, distance, mirrors, rims: None, truth: None })
    }

    /// Where the mesh has gaps that no cell shows, E becomes the distance to them as well.
    fn keep_off_slots(&mut self, mesh: &Mesh, grid: &Grid, run: &Run) -> Result<()> {
        let l = &self.lattice;
        if let Some(bits) = without_slots(mesh, grid, l, &self.bits, &self.distance)? {
            transform::distance(l, &bits, l.dims, &mut self.distance, run.pool())?;
            run.count(|c| c.transforms += 1);
        }
        Ok(())
    }

    /// Bytes of the arrays.
    pub fn bytes(&self) -> usize {
        self.bits.len() * 8 + self.distance.len() * 4 + self.rims.as_ref().map_or(0, Rims::bytes)
    }

    /// Length of a cell in the unit frame.
    pub fn cell(&self) -> f64 {
        self.truth.as_ref().map_or(1.0, |t| t.cell)
    }

    /// E at a cell; 0 beyond the array.
    pub fn at(&self, cell: [i64; 3]) -> f32 {
        value(&self.distance, &self.lattice, cell)
    }

    /// Whether the cell that holds the point is solid.
    pub fn solid_at(&self, p: &[f64; 3]) -> bool {
        let c = self.cell_of(p);
        (0..3).all(|a| c[a] >= 0)
            && self.lattice.get(&self.bits, c[0] as usize, c[1] as usize, c[2] as usize)
    }

    fn cell_of(&self, p: &[f64; 3]) -> [i64; 3] {
        std::array::from_fn(|a| (p[a] / self.lattice.step[a]).round() as i64)
    }

    /// The radius of the greatest ball about `p` that stays in the solid, in cells; not above zero
    /// when `p` is outside. Meshes: the exact distance, but, where the surface crosses itself or
    /// is open, that to the cells when the nearest triangle is no boundary of them (it lies
    /// within an overlap of bodies). Voxels: see [`super::depth`].
    pub fn depth(&self, p: &[f64; 3]) -> f64 {
        let exact = || self.truth.as_ref().and_then(|t| t.signed(&self.lattice, p));
        let Some(rims) = &self.rims else { return exact().unwrap_or(0.0) };
        let c = self.cell_of(p);
        let away: f64 = (0..3).map(|a| (p[a] - c[a] as f64 * self.lattice.step[a]).powi(2)).sum();
        let widest = self.lattice.step.iter().fold(0.0, |m: f64, s| m.max(*s));
        let bound = (f64::from(self.at(c)).max(widest) + away.sqrt()) * (1.0 + 1e-6);
        let depth = rims.depth(p, bound);
        match if self.images_differ() { exact() } else { None } {
            Some(exact) if (exact - depth).abs() <= 1.0 => exact,
            _ => depth,
        }
    }

    /// Whether each image of a point has a depth of its own: a mesh may be less
    /// symmetric than its cells.
    pub fn images_differ(&self) -> bool {
        self.truth.as_ref().is_some_and(|t| t.mesh)
    }

    /// Exact distance to the true surface, in cells; `None` when `p` is not inside (Buchele et al. 2026,
    /// section 3.5).
    pub fn limit(&self, p: &[f64; 3]) -> Option<f64> {
        match &self.truth {
            Some(t) => t
                .surface?
                .contains(&t.unit(&self.lattice, p))
                .then(|| t.exact(&self.lattice, p))?
                .map(|d| d * (1.0 - 4.0 * f64::EPSILON)),
            None => self.solid_at(p).then(|| self.depth(p)),
        }
    }

    /// How many exact distances were asked for.
    pub fn asked(&self) -> u64 {
        self.truth.as_ref().map_or(0, |t| t.asked.load(Ordering::Relaxed))
    }

    /// The ball as a sphere in the caller's frame.
    pub fn sphere(&self, ball: &Ball) -> Sphere {
        match &self.truth {
            Some(t) => t.solid.frame().sphere_to_input(&Sphere::new(
                t.unit(&self.lattice, &ball.center),
                ball.radius * t.cell,
            )),
            None => Sphere::new(Vec3::from(ball.center), ball.radius),
        }
    }
}

impl Truth<'_> {
    fn unit(&self, lattice: &Lattice, p: &[f64; 3]) -> Vec3 {
        let grid = self.solid.grid();
        Vec3::from_fn(|a, _| grid.origin[a] + (p[a] / lattice.step[a] + 0.5) * grid.spacing[a])
    }

    fn exact(&self, lattice: &Lattice, p: &[f64; 3]) -> Option<f64> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        Some(self.surface?.nearest(&self.unit(lattice, p)).distance / self.cell)
    }

    /// The distance, below zero outside. Only near the surface is a point in a solid cell outside.
    fn signed(&self, lattice: &Lattice, p: &[f64; 3]) -> Option<f64> {
        let distance = self.exact(lattice, p)?;
        let reach: f64 = lattice.step.iter().map(|s| s * s).sum();
        let near = distance * distance <= reach;
        let outside = near && !self.surface?.contains(&self.unit(lattice, p));
        Some(if outside { -distance } else { distance })
    }
}

/// The length that counts as one cell (the edge of a cube of the same volume) and the edges in it.
pub(in crate::generate) fn cell_and_step(spacing: &Vec3) -> (f64, [f64; 3]) {
    let cube = (0..3).all(|a| (spacing[a] / spacing[0] - 1.0).abs() < 1e-9);
    if cube {
        return (spacing[0], [1.0; 3]);
    }
    let cell = (spacing[0] * spacing[1] * spacing[2]).cbrt();
    (cell, [spacing[0] / cell, spacing[1] / cell, spacing[2] / cell])
}

/// A value of a field; 0 beyond the array.
pub(super) fn value(field: &[f32], lattice: &Lattice, cell: [i64; 3]) -> f32 {
    let d = lattice.dims;
    if (0..3).any(|a| cell[a] < 0 || cell[a] >= d[a] as i64) {
        return 0.0;
    }
    let [i, j, k] = cell.map(|n| n as usize);
    field.get(i + d[0] * (j + d[1] * k)).copied().unwrap_or(0.0)
}
