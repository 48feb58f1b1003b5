//! Solids: a shape with a grid, ready for clumps and for distances.

use super::callbacks::{log_notes, run};
use super::choices::*;
use super::guard::{borrow, check_bytes, copy_text, give, guard, require, slice, take};
use super::options::{check, fill, init, read};
use super::shape::{counters_struct, moments_struct, morula_shape, note, put};
use super::structs::*;
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::run::{Counters, Run};
use crate::shape::Shape;
use crate::solid::{Resolution, Solid, SolidOptions};
use std::ffi::c_char;
use std::sync::Arc;

/// A shape with a grid. Made by morula_solid_from_shape(), freed by
/// morula_solid_free(). It does not need its shape any more.
pub struct morula_solid {
    pub(super) inner: Arc<Solid>,
    /// Of the calls that made its shape and itself.
    pub(super) counters: Counters,
}

const _: () = {
    // Const functions may run at the same time on one handle.
    const fn shared<T: Send + Sync>() {}
    shared::<morula_solid>();
};

/// Makes the solid of a shape as the caller's options say.
pub(super) fn build(shape: &Shape, o: &morula_solid_options, run: &Run) -> Result<Solid> {
    let solid = Solid::new(shape, &solid_options(o)?, run)?;
    log_notes(solid.notes());
    Ok(solid)
}

/// The caller's options, checked.
pub(super) fn solid_options(o: &morula_solid_options) -> Result<SolidOptions> {
    let cells = o.cells;
    if o.resolution != MORULA_RESOLUTION_CELL_SIZE && cells == 0 {
        return Err(Error::InvalidArgument("cells is 0".into()));
    }
    let resolution = match o.resolution {
        MORULA_RESOLUTION_CELLS_LONGEST => Resolution::CellsLongest(cells),
        MORULA_RESOLUTION_CELLS_SHORTEST => Resolution::CellsShortest(cells),
        MORULA_RESOLUTION_CELLS_DIAMETER => Resolution::CellsDiameter(cells),
        MORULA_RESOLUTION_CELL_SIZE if o.cell_size.is_finite() && o.cell_size > 0.0 => {
            Resolution::CellSize(o.cell_size)
        }
        MORULA_RESOLUTION_CELL_SIZE => {
            return Err(Error::InvalidArgument(format!(
                "cell_size is {}, not a number greater than 0",
                o.cell_size
            )));
        }
        other => return Err(Error::InvalidArgument(format!("resolution is {other}, no choice"))),
    };
    if !(2..=1 << 20).contains(&o.padding) {
        return Err(Error::InvalidArgument(format!(
            "padding is {}, not between 2 and {}",
            o.padding,
            1 << 20
        )));
    }
    Ok(SolidOptions { resolution, padding: o.padding as usize, memory_limit: o.memory_limit })
}

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_options_init(
    options: *mut morula_solid_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// Makes the solid of a shape: grid, inside, exact moments. One solid serves many clumps.
///
/// Parameters: `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option);
/// STRUCT_SIZE; EMPTY; ZERO_VOLUME; OPEN_SURFACE; MEMORY_LIMIT (with both
/// figures); TOO_LARGE; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: the shape stays the caller's and may be freed at once; free
/// *solid with morula_solid_free(). *solid is written only on success.
/// Threads: any thread; the shape is only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_from_shape(
    shape: *const morula_shape,
    options: *const morula_solid_options,
    solid: *mut *mut morula_solid,
) -> i32 {
    guard(|| {
        let shape = unsafe { borrow(shape, "shape")? };
        require(solid, "solid")?;
        let o = unsafe { read(options)? };
        let run = run(o.threads, o.progress, o.user)?;
        let inner = Arc::new(build(&shape.inner, &o, &run)?);
        let counters = shape.counters.then(&run.counters());
        unsafe { give(solid, morula_solid { inner, counters }) };
        Ok(())
    })
}

/// Takes a solid back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_free(solid: *mut morula_solid) {
    unsafe { take(solid) };
}

/// The grid of a solid.
///
/// Parameters (each may be NULL when it is not asked for): `dims` becomes the
/// numbers of cells along x, y, z, padding included; `spacing` the edge lengths
/// of a cell and `origin` the lower corner of the first cell, in the caller's
/// unit and frame.
/// Returns: MORULA_STATUS_OK; NULL_POINTER (the solid).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_grid(
    solid: *const morula_solid,
    dims: *mut usize,
    spacing: *mut f64,
    origin: *mut f64,
) -> i32 {
    guard(|| {
        let solid = &unsafe { borrow(solid, "solid")? }.inner;
        let (grid, frame) = (solid.grid(), solid.frame());
        unsafe fn three<T>(to: *mut T, value: [T; 3]) {
            if !to.is_null() {
                unsafe { to.cast::<[T; 3]>().write_unaligned(value) };
            }
        }
        unsafe {
            three(dims, grid.dims);
            three(spacing, (grid.spacing * frame.scale).into());
            three(origin, frame.to_input(&grid.origin).into());
        }
        Ok(())
    })
}

/// Exact signed distances from points to the surface, negative inside.
///
/// Parameters: `points` holds x, y, z of `count` points, one after the other,
/// in the caller's unit and frame; `distances` has room for `count` numbers.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; NOT_FINITE (a coordinate);
/// INVALID_ARGUMENT (a point farther than 1e100 sizes of the body); TOO_LARGE;
/// MEMORY_LIMIT (the tree over the surface, which the first call makes);
/// OUT_OF_MEMORY; INTERNAL.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_distance(
    solid: *const morula_solid,
    count: usize,
    points: *const f64,
    distances: *mut f64,
) -> i32 {
    guard(|| {
        let solid = &unsafe { borrow(solid, "solid")? }.inner;
        check_bytes::<[f64; 3]>(count, "points")?;
        let points = unsafe { slice(points, 3 * count, "points")? };
        if count > 0 {
            require(distances, "distances")?;
        }
        for (i, v) in points.iter().enumerate() {
            let (point, name) = (i / 3, ["x", "y", "z"][i % 3]);
            if !v.is_finite() {
                return Err(Error::NotFinite(format!("point {point} has {name} = {v}")));
            }
            // Farther out, squares would overflow.
            if v.abs() > 1e100 * solid.frame().scale.min(1e100) {
                return Err(Error::InvalidArgument(format!(
                    "point {point} has {name} = {v}, too far from the body"
                )));
            }
        }
        // Made whole first: an error or panic must leave the caller's array as it was.
        let mut found = crate::error::reserve("the distances", count)?;
        let surface = solid.surface(&Run::serial())?;
        for p in points.chunks_exact(3) {
            let p = solid.frame().to_unit(&Vec3::from_column_slice(p));
            found.push(surface.signed_distance(&p) * solid.frame().scale);
        }
        unsafe { super::guard::copy_out(&found, count, distances, "distances") }
    })
}

/// How many notes there are on the solid: sentences that a user should know,
/// such as too few cells across its thinnest part.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_note_count(
    solid: *const morula_solid,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        unsafe { put(count, solid.inner.notes().len(), "count") }
    })
}

/// Copies note `index` (from 0) with its closing NUL.
///
/// Parameters: `text` has room for `capacity` bytes; `length` (may be NULL)
/// becomes the length without the NUL. With `text` NULL and `capacity` 0 only
/// `length` is written.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_copy_note(
    solid: *const morula_solid,
    index: usize,
    capacity: usize,
    text: *mut c_char,
    length: *mut usize,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        unsafe { copy_text(note(solid.inner.notes(), index)?, capacity, text, length) }
    })
}

/// Mass, centre and inertia of a solid.
///
/// Parameters, returns, threads: as morula_shape_moments(); nothing is computed anew.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_moments(
    solid: *const morula_solid,
    density: f64,
    moments: *mut morula_moments,
) -> i32 {
    guard(|| {
        let solid = &unsafe { borrow(solid, "solid")? }.inner;
        unsafe { check(moments)? };
        let value = moments_struct(solid.unit_moments(), solid.frame(), density)?;
        unsafe { fill(moments, &value) }
    })
}

/// What was done on the road to the solid: stage times and counters of the
/// calls that made its shape and itself, added up (of peak_bytes the greatest).
/// Clumps made from it do not count.
///
/// Parameters: `counters` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_solid_counters(
    solid: *const morula_solid,
    counters: *mut morula_counters,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        unsafe { fill(counters, &counters_struct(&solid.counters)) }
    })
}
