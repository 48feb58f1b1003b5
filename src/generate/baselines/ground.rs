//! What the methods stand on: exact depths, and the cells of the solid as bits.

use super::super::GenerateOptions;
use super::super::mss::lattice::{Ball, Lattice};
use super::super::mss::target::cell_and_step;
use crate::error::{Error, Result, figure};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::solid::Solid;
use crate::solid::nearest::Surface;
use std::sync::atomic::{AtomicU64, Ordering};

/// The solid, unit frame.
pub(super) struct Ground<'a> {
    pub solid: &'a Solid,
    pub surface: &'a Surface,
    /// How far a sphere may reach beyond the surface.
    pub tolerance: f64,
    /// Least radius.
    pub least: f64,
    /// Edge of a cell (of the cube of the same volume).
    pub cell: f64,
    pub lattice: Lattice,
    /// The solid cells.
    pub target: Vec<u64>,
    asked: AtomicU64,
}

impl<'a> Ground<'a> {
    pub fn new(solid: &'a Solid, options: &GenerateOptions, run: &Run) -> Result<Ground<'a>> {
        let scale = solid.frame().scale;
        if options.tolerance > scale {
            return Err(Error::InvalidArgument(format!(
                "tolerance is {}, more than the size of the body",
                figure(options.tolerance)
            )));
        }
        let grid = solid.grid();
        let (cell, step) = cell_and_step(&grid.spacing);
        let lattice = Lattice::new(grid.dims, step);
        let target = lattice.pack(solid.inside()?)?;
        Ok(Ground {
            solid,
            surface: solid.surface(run)?,
            tolerance: options.tolerance / scale,
            // More than twice the size is no more than that: no quotient overflows.
            least: options.min_radius.min(2.0 * scale) / scale,
            cell,
            lattice,
            target,
            asked: AtomicU64::new(0),
        })
    }

    /// Exact distance to the surface, below zero outside; a hair less than it, so that rounding
    /// takes no ball across.
    pub fn depth(&self, p: &Vec3) -> f64 {
        let distance = self.distance(p);
        if self.surface.contains(p) { distance } else { -distance }
    }

    /// The same where a point `from` inside, of the depth `known`, is near: mostly no inside test.
    pub fn depth_from(&self, p: &Vec3, from: &Vec3, known: f64) -> f64 {
        if (p - from).norm() < known { self.distance(p) } else { self.depth(p) }
    }

    /// The nearest point of the surface if it is nearer than `reach`.
    pub fn nearer(&self, p: &Vec3, reach: f64) -> Option<Vec3> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        self.surface.nearest_within(p, reach).map(|n| n.point)
    }

    /// Distance to the surface, whatever the side.
    fn distance(&self, p: &Vec3) -> f64 {
        self.asked.fetch_add(1, Ordering::Relaxed);
        self.surface.nearest(p).distance * (1.0 - 4.0 * f64::EPSILON)
    }

    /// How many exact distances were asked for.
    pub fn asked(&self) -> u64 {
        self.asked.load(Ordering::Relaxed)
    }

    /// A sphere on the lattice.
    pub fn ball(&self, s: &Sphere) -> Ball {
        let grid = self.solid.grid();
        let at = |a: usize| {
            ((s.center[a] - grid.origin[a]) / grid.spacing[a] - 0.5) * self.lattice.step[a]
        };
        Ball { center: [at(0), at(1), at(2)], radius: s.radius / self.cell }
    }
}
