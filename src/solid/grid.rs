//! The grid of a solid and how fine it is.

use super::{Solid, SolidOptions};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Shape;

/// How fine a grid is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Resolution {
    /// Cells along the longest edge of the bounding box.
    CellsLongest(u32),
    /// Cells along the shortest edge of the bounding box (the rule of paper 002).
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

/// Makes the solid: grid, inside, surface, moments.
pub(super) fn build(shape: &Shape, options: &SolidOptions, run: &Run) -> Result<Solid> {
    let _ = (shape, options, run);
    Err(Error::Internal("solids are not built yet".into()))
}
