//! Shapes from arrays of voxels: masks, grey volumes, labels.

use super::guard::{array_or, guard, require, slice};
use super::shape::{make, morula_shape, put};
use super::structs::morula_import_options;
use crate::error::{Error, Result};
use crate::run::Run;
use crate::shape::voxels::{Grey, LabelInfo, Threshold, list_labels};
use crate::shape::{ImportOptions, Layout, Shape};

/// Spacing and origin as the library wants them.
pub(super) fn check_layout(spacing: [f64; 3], origin: [f64; 3]) -> Result<()> {
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        if !(spacing[axis].is_finite() && spacing[axis] > 0.0) {
            return Err(Error::InvalidArgument(format!(
                "spacing along {name} is {}, not a number greater than 0",
                spacing[axis]
            )));
        }
        if !origin[axis].is_finite() {
            return Err(Error::NotFinite(format!("origin along {name} is {}", origin[axis])));
        }
    }
    Ok(())
}

/// A threshold that is a number.
pub(super) fn above(threshold: f64) -> Result<Threshold> {
    if threshold.is_finite() {
        return Ok(Threshold::Above(threshold));
    }
    Err(Error::NotFinite(format!("threshold is {threshold}")))
}

pub(super) unsafe fn layout(
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
) -> Result<Layout> {
    require(dims, "dims")?;
    let dims = unsafe { array_or(dims, [0; 3], "dims")? };
    let spacing = unsafe { array_or(spacing, [1.0; 3], "spacing")? };
    let origin = unsafe { array_or(origin, [0.0; 3], "origin")? };
    check_layout(spacing, origin)?;
    Ok(Layout { dims, spacing, origin })
}

/// The caller's voxels, as many as `dims` says.
pub(super) unsafe fn cells<'a, T>(
    pointer: *const T,
    dims: [usize; 3],
    name: &str,
) -> Result<&'a [T]> {
    let count = dims.iter().try_fold(1usize, |n, &d| n.checked_mul(d)).ok_or_else(|| {
        Error::TooLarge(format!("dims {dims:?} are more cells than memory can address"))
    })?;
    unsafe { slice(pointer, count, name) }
}

/// Makes a shape from a mask of voxels: those that are not 0 are solid.
///
/// Parameters: `dims` holds the numbers of cells nx, ny, nz along x, y, z and
/// `mask` a byte for each, x fastest: the cell (i, j, k) is element
/// i + nx (j + ny k) and covers origin + (i, j, k) times spacing up to
/// origin + (i+1, j+1, k+1) times spacing; `spacing` the edge lengths of a cell (NULL: 1, 1, 1);
/// `origin` the lower corner of the first cell (NULL: 0, 0, 0). No empty border
/// is needed. `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (spacing or an
/// option); NOT_FINITE (origin); EMPTY; SEVERAL_BODIES; STRUCT_SIZE; TOO_LARGE;
/// MEMORY_LIMIT; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_mask(
    mask: *const u8,
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    let from = |import: &ImportOptions, run: &Run| {
        let layout = unsafe { layout(dims, spacing, origin)? };
        let mask = unsafe { cells(mask, layout.dims, "mask")? };
        Shape::from_mask(mask, &layout, import, run)
    };
    unsafe { make(options, shape, from) }
}

/// A shape of the grey values that `values` finds for `dims`.
unsafe fn grey<'a>(
    values: impl FnOnce([usize; 3]) -> Result<Grey<'a>>,
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
    threshold: *const f64,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    let from = |import: &ImportOptions, run: &Run| {
        let layout = unsafe { layout(dims, spacing, origin)? };
        let values = values(layout.dims)?;
        let threshold = if threshold.is_null() {
            Threshold::Otsu
        } else {
            above(unsafe { array_or(threshold, [0.0], "threshold")? }[0])?
        };
        Shape::from_grey(values, &layout, threshold, import, run)
    };
    unsafe { make(options, shape, from) }
}

/// Makes a shape from a grey volume of 8 bits.
///
/// Parameters: `values`, `dims`, `spacing`, `origin`, `options` as
/// morula_shape_from_mask(); cells greater than *threshold are solid, NULL
/// means Otsu's threshold.
/// Returns: as morula_shape_from_mask(); NOT_FINITE also for the threshold.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_grey_u8(
    values: *const u8,
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
    threshold: *const f64,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    let values = |dims| Ok(Grey::U8(unsafe { cells(values, dims, "values")? }));
    unsafe { grey(values, dims, spacing, origin, threshold, options, shape) }
}

/// Makes a shape from a grey volume of 16 bits.
///
/// Parameters, returns, ownership, threads: as morula_shape_from_grey_u8().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_grey_u16(
    values: *const u16,
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
    threshold: *const f64,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    let values = |dims| Ok(Grey::U16(unsafe { cells(values, dims, "values")? }));
    unsafe { grey(values, dims, spacing, origin, threshold, options, shape) }
}

/// Makes a shape from a grey volume of single precision.
///
/// Parameters, returns, ownership, threads: as morula_shape_from_grey_u8();
/// NOT_FINITE also for a value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_grey_f32(
    values: *const f32,
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
    threshold: *const f64,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    let values = |dims| Ok(Grey::F32(unsafe { cells(values, dims, "values")? }));
    unsafe { grey(values, dims, spacing, origin, threshold, options, shape) }
}

/// Makes a shape from one label of a label volume.
///
/// Parameters: `labels`, `dims`, `spacing`, `origin`, `options` as
/// morula_shape_from_mask(); the cells that hold `label` are solid. The report
/// says whether they touch the border of the array.
/// Returns: as morula_shape_from_mask(); INDEX_OUT_OF_RANGE when no cell holds the label;
/// INVALID_ARGUMENT for label 0, which is background.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_label(
    labels: *const u32,
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
    label: u32,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    let from = |import: &ImportOptions, run: &Run| {
        let layout = unsafe { layout(dims, spacing, origin)? };
        let labels = unsafe { cells(labels, layout.dims, "labels")? };
        Shape::from_label(labels, &layout, label, import, run)
    };
    unsafe { make(options, shape, from) }
}

/// How many labels other than 0 a label volume holds.
///
/// Parameters: `labels` and `dims` as morula_shape_from_label().
/// Returns: MORULA_STATUS_OK; NULL_POINTER; TOO_LARGE; EMPTY (no cell);
/// OUT_OF_MEMORY; INTERNAL.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_labels_count(
    labels: *const u32,
    dims: *const usize,
    count: *mut usize,
) -> i32 {
    guard(|| {
        require(count, "count")?;
        let layout = unsafe { layout(dims, std::ptr::null(), std::ptr::null())? };
        let labels = unsafe { cells(labels, layout.dims, "labels")? };
        unsafe { put(count, list_labels(labels, &layout)?.len(), "count") }
    })
}

/// Lists the labels of a label volume, ascending, without 0.
///
/// Parameters: `labels` and `dims` as morula_shape_from_label(); each of the
/// arrays may be NULL when it is not asked for, the others have room for
/// `capacity` labels: `ids` the labels, `cells` their numbers of cells, `boxes`
/// six numbers each (the first cell along x, y, z and the last, inclusive),
/// `touches_border` 1 where the label touches the border of the array, so that
/// the particle may be cut off.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is
/// written); TOO_LARGE; EMPTY (no cell); OUT_OF_MEMORY; INTERNAL.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_labels_copy(
    labels: *const u32,
    dims: *const usize,
    capacity: usize,
    ids: *mut u32,
    cells: *mut u64,
    boxes: *mut u64,
    touches_border: *mut i32,
) -> i32 {
    guard(|| {
        let layout = unsafe { layout(dims, std::ptr::null(), std::ptr::null())? };
        let labels = unsafe { self::cells(labels, layout.dims, "labels")? };
        let to = LabelArrays { capacity, ids, cells, boxes, touches_border };
        unsafe { to.put(&list_labels(labels, &layout)?) }
    })
}

/// The caller's arrays for labels; those not asked for are NULL.
pub(super) struct LabelArrays {
    pub capacity: usize,
    pub ids: *mut u32,
    pub cells: *mut u64,
    pub boxes: *mut u64,
    pub touches_border: *mut i32,
}

impl LabelArrays {
    /// Whether any is asked for.
    pub fn any(&self) -> bool {
        !(self.ids.is_null()
            && self.cells.is_null()
            && self.boxes.is_null()
            && self.touches_border.is_null())
    }

    /// Writes the labels; nothing where there is no room for all of them.
    pub unsafe fn put(self, all: &[LabelInfo]) -> Result<()> {
        if self.capacity < all.len() {
            return Err(Error::BufferTooSmall(format!(
                "the arrays have room for {} of {} labels",
                self.capacity,
                all.len()
            )));
        }
        // All of them are looked at before the first is written.
        fn writable<T>(to: *mut T, name: &str) -> Result<()> {
            if to.is_null() { Ok(()) } else { require(to, name) }
        }
        writable(self.ids, "ids")?;
        writable(self.cells, "cells")?;
        writable(self.boxes, "boxes")?;
        writable(self.touches_border, "touches_border")?;
        unsafe fn each<T>(to: *mut T, values: impl Iterator<Item = T>) {
            if !to.is_null() {
                for (i, value) in values.enumerate() {
                    unsafe { to.add(i).write(value) };
                }
            }
        }
        let corners = all.iter().flat_map(|l| l.first.into_iter().chain(l.last));
        unsafe {
            each(self.ids, all.iter().map(|l| l.label));
            each(self.cells, all.iter().map(|l| l.cells));
            each(self.boxes, corners.map(|v| v as u64));
            each(self.touches_border, all.iter().map(|l| l.touches_border.into()));
        }
        Ok(())
    }
}
