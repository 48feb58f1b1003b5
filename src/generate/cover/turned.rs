//! The body as the method sees it: turned so that its principal axes lie along the lattice, which
//! leaves the fewest spurious branches on the skeleton (Yuan 2019, section 2.4).

use crate::error::{Error, Result, filled, fits, reserve};
use crate::math::{PrincipalFrame, Vec3};
use crate::run::Run;
use crate::shape::{Body, Mesh};
use crate::solid::columns::{Columns, Lattice};
use crate::solid::{Grid, Solid};
use nalgebra::Matrix3;
use std::borrow::Cow;
use std::f64::consts::PI;

/// Cells across the mean thickness 2V/A, at least: thinner bodies get finer lattices.
const ACROSS: f64 = 3.0;
/// … of no more cells than this.
const MOST: f64 = (16u64 << 20) as f64;
/// The lattice is narrower by this about its middle, so that a centre on the surface is inside.
const NARROWER: f64 = 1.0 - 1.0 / (1u64 << 33) as f64;

/// A body with its principal axes along x, y, z and its centroid at the origin; voxels stay as
/// they are.
pub(super) struct Turned<'a> {
    pub body: Cow<'a, Body>,
    axes: Matrix3<f64>,
    origin: Vec3,
    pub low: Vec3,
    pub high: Vec3,
    /// Diameter of the sphere of equal volume.
    pub diameter: f64,
    /// 2V/A.
    thickness: f64,
    /// Whether the winding number is 0 outside and 1 inside, so that the faces bound the volume.
    pub exact: bool,
}

impl<'a> Turned<'a> {
    pub(super) fn new(solid: &'a Solid) -> Result<Turned<'a>> {
        let moments = solid.unit_moments();
        let diameter = (6.0 / PI * moments.volume).cbrt();
        if !(diameter.is_normal() && diameter > 0.0) {
            return Err(Error::ZeroVolume(format!("the volume is {}", moments.volume)));
        }
        match solid.body() {
            Body::Voxels(v) => {
                let high = Vec3::from(v.dims.map(|n| n as f64)).component_mul(&v.spacing);
                Ok(Turned {
                    body: Cow::Borrowed(solid.body()),
                    axes: Matrix3::identity(),
                    origin: Vec3::zeros(),
                    low: Vec3::zeros(),
                    high,
                    diameter,
                    thickness: f64::MAX,
                    exact: true,
                })
            }
            Body::Mesh(mesh) => {
                let noise = solid.frame().noise();
                let axes = PrincipalFrame::of_rounded(&moments.inertia, noise).axes;
                let turn = axes.transpose();
                let mut vertices = reserve("the turned mesh", mesh.vertices.len())?;
                vertices.extend(mesh.vertices.iter().map(|v| turn * (v - moments.centroid)));
                let mut faces = reserve("the turned mesh", mesh.faces.len())?;
                faces.extend_from_slice(&mesh.faces);
                let turned = Mesh { vertices, faces, clean: mesh.clean };
                let corners = || (0..turned.faces.len()).map(|i| turned.corners(i));
                let Some([first, ..]) = corners().next() else {
                    return Err(Error::Empty("the mesh has no face".into()));
                };
                let (low, high) =
                    corners().flatten().fold((first, first), |(l, h), v| (l.inf(&v), h.sup(&v)));
                let area: f64 =
                    corners().map(|[a, b, c]| 0.5 * (b - a).cross(&(c - a)).norm()).sum();
                Ok(Turned {
                    body: Cow::Owned(Body::Mesh(turned)),
                    axes,
                    origin: moments.centroid,
                    low,
                    high,
                    diameter,
                    thickness: 2.0 * moments.volume / area,
                    exact: mesh.clean && moments.relative_error == 0.0,
                })
            }
        }
    }

    /// From the turned frame to the unit frame.
    pub(super) fn to_unit(&self, p: &Vec3) -> Vec3 {
        self.axes * p + self.origin
    }

    /// And back.
    pub(super) fn turn(&self, p: &Vec3) -> Vec3 {
        self.axes.transpose() * (p - self.origin)
    }

    /// The edge of cells, `per_diameter` of them to the equivalent diameter; smaller where the
    /// body is thin.
    pub(super) fn cell(&self, per_diameter: u32) -> f64 {
        let asked = self.diameter / f64::from(per_diameter.max(1));
        // Cells have no thickness to be asked for: its cube is still a number.
        let wanted = self.thickness.min(1e100) / ACROSS;
        let box_volume: f64 = (self.high - self.low).iter().map(|e| e + 4.0 * wanted).product();
        let least = (box_volume / MOST).cbrt();
        asked.min(wanted.max(least))
    }

    /// A lattice of cubes of edge `h` about the middle of the box: an odd number along each axis,
    /// so that there are centres on the planes of a symmetric body, with `margin` cells around.
    pub(super) fn lattice(&self, h: f64, margin: usize, limit: u64, bytes: u64) -> Result<Grid> {
        let counts = (self.high - self.low).map(|e| 2.0 * (0.5 * e / h).ceil() + 1.0);
        let wide = counts.map(|n| n + 2.0 * margin as f64);
        let total = wide.x * wide.y * wide.z;
        let what = format_args!("a lattice of {} × {} × {} cells", wide.x, wide.y, wide.z);
        if total >= f64::from(u32::MAX) {
            return Err(Error::TooLarge(format!("{what} has too many cells")));
        }
        fits(what, total as u64 * bytes, limit)?;
        let origin = (self.low + self.high - wide * h) * 0.5;
        let dims = [wide.x as usize, wide.y as usize, wide.z as usize];
        Ok(Grid { dims, spacing: Vec3::repeat(h), origin })
    }

    /// The lattice of the skeleton and which of its cells have their centre inside: cells of
    /// voxels themselves where those are cubes and no finer ones are asked for.
    pub(super) fn voxels(
        &self,
        per_diameter: u32,
        limit: u64,
        run: &Run,
    ) -> Result<(Grid, Vec<u8>)> {
        let mut h = self.cell(per_diameter);
        if let Body::Voxels(v) = self.body.as_ref() {
            let cubes = v.spacing.max() - v.spacing.min() <= 1e-9 * v.spacing.max();
            if cubes && h < 1.5 * v.spacing.x {
                fits(format_args!("{} voxels", v.cells.len()), v.cells.len() as u64, limit)?;
                let grid = Grid { dims: v.dims, spacing: v.spacing, origin: Vec3::zeros() };
                let mut inside = reserve("the voxels of the body", v.cells.len())?;
                inside.extend_from_slice(&v.cells);
                return Ok((grid, inside));
            }
            h = h.max(v.spacing.min());
        }
        let grid = self.lattice(h, 0, limit, 1)?;
        let [nx, ny, nz] = grid.dims;
        let step = h * NARROWER;
        let at = |a: usize| grid.origin[a] + 0.5 * (h - step) * grid.dims[a] as f64;
        let lattice = Lattice::straight(0, [ny, nz], [at(1), at(2)], [step, step]);
        let mut inside = filled("the voxels of the body", grid.len(), 0u8)?;
        let held = inside.len() as u64;
        let columns = Columns::within(&self.body, lattice, limit.saturating_sub(held), held, run)?;
        let slack = h * (1.0 - NARROWER);
        run.pool().chunks_mut(&mut inside, nx.max(1), |row, cells| {
            for &[lo, hi] in columns.column(row % ny, row / ny) {
                for (i, cell) in cells.iter_mut().enumerate() {
                    let x = grid.center(i, 0, 0).x;
                    if x >= lo - slack && x <= hi + slack {
                        *cell = 1;
                    }
                }
            }
        });
        Ok((grid, inside))
    }
}
