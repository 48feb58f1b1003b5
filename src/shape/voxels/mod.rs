//! Voxels from arrays: masks, grey volumes, labels. Every way in ends in
//! `mask::build`, which finds the bodies, crops and reports.

mod bits;
mod bodies;
mod grey;
mod labels;
mod mask;
mod specks;

pub use grey::{F32_BINS, otsu};
pub use labels::{list_labels, widen_labels};
pub(crate) use specks::drop_specks;

use crate::error::{Error, Result, figure};
use crate::math::Vec3;

/// How an array of voxels lies in space. The array is stored with x fastest:
/// the cell (i, j, k) is element `i + nx (j + ny k)` and covers
/// `origin + [i, i+1] × [j, j+1] × [k, k+1] * spacing`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layout {
    /// Cells along x, y, z.
    pub dims: [usize; 3],
    /// Edge lengths of a cell along x, y, z, in the caller's unit.
    pub spacing: [f64; 3],
    /// Lower corner of the first cell, in the caller's frame.
    pub origin: [f64; 3],
}

/// Solid cells after checks, in the unit frame, cropped to the body's bounding
/// box: no padding is kept here, the solid adds its own.
#[derive(Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Voxels {
    /// Cells along x, y, z.
    pub dims: [usize; 3],
    /// Edge lengths of a cell (unit frame).
    pub spacing: Vec3,
    /// 1 for solid cells, 0 elsewhere; x fastest. The lower corner of the first cell is the
    /// unit frame's origin.
    #[serde(with = "bits")]
    pub cells: Vec<u8>,
}

impl Voxels {
    /// Whether its numbers are those of cells after checks.
    pub(crate) fn check(&self) -> Result<()> {
        let [nx, ny, nz] = self.dims;
        let count = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
        if count != Some(self.cells.len()) {
            return Err(Error::InvalidArgument(format!(
                "{} cells in a grid of {nx} × {ny} × {nz}",
                self.cells.len()
            )));
        }
        if !self.cells.contains(&1) {
            return Err(Error::Empty("no solid cell".into()));
        }
        if !self.spacing.iter().all(|x| x.is_normal() && (0.0..=1.0).contains(x)) {
            let s = self.spacing;
            return Err(Error::InvalidArgument(format!("cells of {} × {} × {}", s.x, s.y, s.z)));
        }
        Ok(())
    }
}

impl std::fmt::Debug for Voxels {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        // Without the cells: there may be millions.
        f.debug_struct("Voxels")
            .field("dims", &self.dims)
            .field("spacing", &self.spacing)
            .finish_non_exhaustive()
    }
}

/// A grey volume, x fastest.
#[derive(Debug, Clone, Copy)]
pub enum Grey<'a> {
    /// 8 bit.
    U8(&'a [u8]),
    /// 16 bit.
    U16(&'a [u16]),
    /// Single precision.
    F32(&'a [f32]),
}

/// Which grey values are solid: those above the threshold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threshold {
    /// Otsu's threshold: greatest variance between the two classes.
    Otsu,
    /// Values greater than this are solid.
    Above(f64),
}

/// What a label volume holds of one label.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LabelInfo {
    /// The label; never 0, which is background.
    pub label: u32,
    /// Its cells.
    pub cells: u64,
    /// First cell of its bounding box.
    pub first: [usize; 3],
    /// Last cell of its bounding box (inclusive).
    pub last: [usize; 3],
    /// Whether it touches the border of the array, so that the particle may be cut off.
    pub touches_border: bool,
}

impl Layout {
    /// Checks dimensions, spacing and origin, and that the array has `len` cells.
    pub(crate) fn check(&self, len: usize) -> Result<()> {
        let [nx, ny, nz] = self.dims;
        let cells = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz)).ok_or_else(|| {
            Error::TooLarge(format!("{nx} x {ny} x {nz} voxels are more than can be counted"))
        })?;
        if cells != len {
            return Err(Error::InvalidArgument(format!(
                "the array has {len} values, but {nx} x {ny} x {nz} voxels are {cells}"
            )));
        }
        if cells == 0 {
            return Err(Error::Empty(format!("an array of {nx} x {ny} x {nz} voxels holds none")));
        }
        for a in 0..3 {
            let axis = ["x", "y", "z"][a];
            // Rows and runs are counted in 32 bits.
            if u32::try_from(self.dims[a]).is_err() {
                return Err(Error::TooLarge(format!(
                    "{} voxels along {axis} are more than 2^32 - 1",
                    self.dims[a]
                )));
            }
            let (h, o) = (self.spacing[a], self.origin[a]);
            if !h.is_finite() || !o.is_finite() {
                let (what, value) = if h.is_finite() { ("origin", o) } else { ("spacing", h) };
                return Err(Error::NotFinite(format!("the {what} along {axis} is {value}")));
            }
            if h <= 0.0 {
                return Err(Error::InvalidArgument(format!(
                    "the spacing along {axis} is {}, not greater than 0",
                    figure(h)
                )));
            }
        }
        Ok(())
    }
}
