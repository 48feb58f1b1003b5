//! Voxels from arrays: masks, grey volumes, labels.

use super::{ImportOptions, Shape};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::run::Run;

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
#[derive(Debug, Clone)]
pub struct Voxels {
    /// Cells along x, y, z.
    pub dims: [usize; 3],
    /// Edge lengths of a cell (unit frame).
    pub spacing: Vec3,
    /// 1 for solid cells, 0 elsewhere; x fastest. The lower corner of the first cell is the
    /// unit frame's origin.
    pub cells: Vec<u8>,
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

impl Shape {
    /// A shape from a mask: cells other than 0 are solid.
    pub fn from_mask(
        mask: &[u8],
        layout: &Layout,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        let _ = (mask, layout, options, run);
        Err(Error::Internal("voxels are not built yet".into()))
    }

    /// A shape from a grey volume.
    pub fn from_grey(
        values: Grey,
        layout: &Layout,
        threshold: Threshold,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        let _ = (values, layout, threshold, options, run);
        Err(Error::Internal("grey volumes are not built yet".into()))
    }

    /// The shape of one label of a label volume.
    pub fn from_label(
        labels: &[u32],
        layout: &Layout,
        label: u32,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        let _ = (labels, layout, label, options, run);
        Err(Error::Internal("label volumes are not built yet".into()))
    }
}

/// The labels of a volume, ascending, without 0.
pub fn list_labels(labels: &[u32], layout: &Layout) -> Result<Vec<LabelInfo>> {
    let _ = (labels, layout);
    Err(Error::Internal("label volumes are not built yet".into()))
}
