//! The solid: what every generator and every measure reads. A grid of cells,
//! which of them are in, the signed distance at their centres, exact distances
//! and intervals, exact moments. All in the unit frame.

pub mod columns;
pub mod coverage;
pub mod edt;
pub mod field;
pub mod grid;
mod lids;
pub mod moments;
pub mod nearest;
mod told;
mod triangle;
pub mod winding;

pub use columns::Columns;
pub use grid::{Grid, Resolution};

use crate::error::{Error, Result};
use crate::math::{Moments, PrincipalFrame, Sphere, UnitFrame, Vec3};
use crate::run::Run;
use crate::shape::{Body, Shape};
use nearest::Surface;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

/// How a solid is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidOptions {
    /// How fine the grid is. Voxel shapes keep their own cells.
    pub resolution: Resolution,
    /// Empty cells around the shape, at least 2 (Buchele et al. 2026, eq 6).
    pub padding: usize,
    /// Most bytes that grid arrays may take together, and what tells the inside of an open mesh;
    /// the tree over the surface and the quality figures are held to what is left of it.
    pub memory_limit: u64,
}

impl Default for SolidOptions {
    fn default() -> Self {
        SolidOptions { resolution: Resolution::CellsLongest(64), padding: 4, memory_limit: 2 << 30 }
    }
}

/// A shape with a grid. The signed distance field and the tree over the surface are made when
/// first asked for.
pub struct Solid {
    body: Arc<Body>,
    frame: UnitFrame,
    grid: Grid,
    padding: usize,
    inside: OnceLock<Vec<u8>>,
    /// Whether the cells inside were found when the solid was made.
    early: bool,
    distance: OnceLock<Vec<f32>>,
    surface: OnceLock<Surface>,
    moments: Moments,
    notes: Vec<String>,
    memory_limit: u64,
    /// Bytes of the large arrays of this solid and of the one below, or above, together.
    held: Arc<AtomicU64>,
    /// Itself with the axes that the body tells, where they are others.
    told: OnceLock<Option<Box<Solid>>>,
}

impl Solid {
    /// The body, in the unit frame: the shape's; of an open mesh with lids over its openings.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// From the caller's frame to the unit frame.
    pub fn frame(&self) -> &UnitFrame {
        &self.frame
    }

    /// The grid, in the unit frame.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// 1 for cells of which more than half is covered (Buchele et al. 2026, eq 5), else 0; x fastest.
    ///
    /// Of a mesh that is not huge they are found when first asked for: `OutOfMemory` where there is no
    /// room then, which leaves the solid as it was.
    pub fn inside(&self) -> Result<&[u8]> {
        self.find_inside(&Run::serial())?;
        let cells = self.inside.get().map(Vec::as_slice);
        cells.ok_or_else(|| Error::Internal("the cells inside were not kept".into()))
    }

    /// Has the cells inside found by the threads of a run, if they are not known.
    pub(crate) fn find_inside(&self, run: &Run) -> Result<()> {
        if self.inside.get().is_none() {
            let _ = self.inside.set(self.cells(run)?);
        }
        Ok(())
    }

    fn cells(&self, run: &Run) -> Result<Vec<u8>> {
        coverage::inside(&self.body, &self.grid, self.padding, self.memory_limit, run)
    }

    /// Exact distances to the surface: a tree over it, made when first asked for.
    pub fn surface(&self, run: &Run) -> Result<&Surface> {
        if self.surface.get().is_none() {
            let room = self.memory_limit.saturating_sub(self.bytes());
            let surface = Surface::within(&self.body, room)?;
            let bytes = surface.bytes();
            if self.surface.set(surface).is_ok() {
                self.hold(bytes);
            }
            run.count(|c| c.peak_bytes = c.peak_bytes.max(self.bytes()));
        }
        self.surface.get().ok_or_else(|| Error::Internal("the surface was not kept".into()))
    }

    /// Bytes of the large arrays that it holds, with those of itself in other axes.
    pub(crate) fn bytes(&self) -> u64 {
        self.held.load(Ordering::Relaxed)
    }

    fn hold(&self, bytes: u64) {
        self.held.fetch_add(bytes, Ordering::Relaxed);
    }

    /// Volume, centroid, inertia at unit density, in the caller's frame.
    pub fn moments(&self) -> Moments {
        self.frame.moments_to_input(&self.moments)
    }

    /// The same in the unit frame.
    pub fn unit_moments(&self) -> &Moments {
        &self.moments
    }

    /// The body frame: its axes, found in the unit frame so that they do not depend on the
    /// caller's unit, and the principal moments at unit density in the caller's unit. Of the solid as the
    /// caller made it: methods do not ask.
    pub fn principal(&self) -> PrincipalFrame {
        let unit = PrincipalFrame::of_rounded(&self.moments.inertia, self.frame.noise());
        let s5 = self.frame.scale.powi(5);
        PrincipalFrame { moments: unit.moments.map(|m| m * s5), ..unit }
    }

    /// Spheres of the caller's frame in the body frame: origin at the centre of mass, axes principal.
    pub fn to_body(&self, spheres: &[Sphere]) -> Vec<Sphere> {
        spheres.iter().map(self.body_frame()).collect()
    }

    /// One sphere of [`Solid::to_body`]. By way of the unit frame: far from the origin it
    /// loses nothing more.
    pub(crate) fn body_frame(&self) -> impl Fn(&Sphere) -> Sphere + use<> {
        let (frame, centroid) = (self.frame, self.moments.centroid);
        let principal = PrincipalFrame::of_rounded(&self.moments.inertia, frame.noise());
        let turn = principal.axes.transpose();
        move |s| {
            let center = turn * (frame.to_unit(&s.center) - centroid) * frame.scale;
            Sphere::new(center, s.radius)
        }
    }

    /// What a user should know about the solid: too few cells across, overlaps found.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The solid with the axes and the unit that the body tells, in which methods work and clumps are
    /// measured: a body whose axes are exchanged or mirrored, or of any other unit, has the same clump
    /// then. The frame leads back to the caller's.
    pub(crate) fn with_told_axes(&self, run: &Run) -> Result<&Solid> {
        if self.told.get().is_none() {
            let told = told::turned(self, run)?.map(Box::new);
            let bytes = told.as_deref().map_or(0, |t| t.grid.len() as u64 + t.body.bytes());
            if self.told.set(told).is_ok() {
                self.hold(bytes);
            }
            run.count(|c| c.peak_bytes = c.peak_bytes.max(self.bytes()));
        }
        Ok(self.told.get().and_then(|told| told.as_deref()).unwrap_or(self))
    }

    /// Signed distance at the cell centres, negative inside.
    pub fn distance(&self, run: &Run) -> Result<&[f32]> {
        if self.distance.get().is_none() {
            let distance = field::signed_distance(self, run)?;
            let bytes = 4 * distance.len() as u64;
            if self.distance.set(distance).is_ok() {
                self.hold(bytes);
            }
        }
        Ok(self.distance.get().map_or(&[], |d| d.as_slice()))
    }

    /// The distance field between cell centres: trilinear, clamped to the grid outside it.
    pub fn distance_at(&self, run: &Run, p: &Vec3) -> Result<f64> {
        Ok(self.grid.trilinear(self.distance(run)?, p))
    }

    /// The memory limit that the solid was made with, for what is made from it.
    pub fn memory_limit(&self) -> u64 {
        self.memory_limit
    }

    /// Makes the grid of `shape`, decides which cells are in and integrates the moments.
    pub fn new(shape: &Shape, options: &SolidOptions, run: &Run) -> Result<Solid> {
        grid::build(shape, options, run)
    }
}
