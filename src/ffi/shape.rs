//! Shapes from meshes and analytic particles, and what can be asked of a shape.

use super::callbacks::{log_notes, run};
use super::choices::*;
use super::guard::{borrow, copy_text, give, guard, require, slice, take};
use super::options::{fill, init, read};
use super::structs::*;
use crate::error::{Error, Result};
use crate::math::{Moments, PrincipalFrame, UnitFrame};
use crate::run::{Counters, Run, Stage};
use crate::shape::{Bodies, ImportOptions, Shape};
use crate::solid::moments::moments as unit_moments;
use std::ffi::c_char;

/// A checked shape: something with an inside. Made by the morula_shape_from_
/// functions, freed by morula_shape_free().
pub struct morula_shape {
    pub(super) inner: Shape,
    /// Of the call that made it.
    pub(super) counters: Counters,
}

const _: () = {
    // Const functions may run at the same time on one handle.
    const fn shared<T: Send + Sync>() {}
    shared::<morula_shape>();
};

/// The caller's options as the library's, the run of the call and the index base.
pub(super) unsafe fn import<'a>(
    options: *const morula_import_options,
) -> Result<(ImportOptions, Run<'a>, u32)> {
    let o = unsafe { read(options)? };
    reserved("import", o.reserved)?;
    let bodies = match o.bodies {
        MORULA_BODIES_REFUSE => Bodies::Refuse,
        MORULA_BODIES_LARGEST => Bodies::Largest,
        MORULA_BODIES_ALL => Bodies::All,
        other => return Err(Error::InvalidArgument(format!("bodies is {other}, no choice"))),
    };
    if !(o.weld_tolerance.is_finite() && (0.0..0.5).contains(&o.weld_tolerance)) {
        return Err(Error::InvalidArgument(format!(
            "weld_tolerance is {}, not in [0, 0.5)",
            o.weld_tolerance
        )));
    }
    if !(o.length_unit.is_finite() && o.length_unit > 0.0) {
        return Err(Error::InvalidArgument(format!(
            "length_unit is {}, not a number greater than 0",
            o.length_unit
        )));
    }
    let base = match o.index_base {
        0 => 0,
        1 => 1,
        other => return Err(Error::InvalidArgument(format!("index_base is {other}, not 0 or 1"))),
    };
    let import = ImportOptions {
        weld_tolerance: o.weld_tolerance,
        length_unit: o.length_unit,
        bodies,
        memory_limit: o.memory_limit,
    };
    Ok((import, run(o.threads, o.progress, o.user)?, base))
}

pub(super) fn reserved(name: &str, value: i32) -> Result<()> {
    if value != 0 {
        return Err(Error::InvalidArgument(format!(
            "reserved of the {name} options is {value}, not 0"
        )));
    }
    Ok(())
}

/// Makes a shape `from` what the caller gave and hands it out.
pub(super) unsafe fn make(
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
    from: impl FnOnce(&ImportOptions, &Run) -> Result<Shape>,
) -> i32 {
    guard(|| {
        require(shape, "shape")?;
        let (import, run, _) = unsafe { import(options)? };
        unsafe { give_shape(shape, from(&import, &run)?, &run) };
        Ok(())
    })
}

/// Hands a new shape to the caller.
pub(super) unsafe fn give_shape(out: *mut *mut morula_shape, shape: Shape, run: &Run) {
    log_notes(&shape.report.notes);
    unsafe { give(out, morula_shape { inner: shape, counters: run.counters() }) };
}

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_import_options_init(
    options: *mut morula_import_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// Makes a shape from a triangle mesh.
///
/// The mesh is welded, its defects are repaired where that is safe, and what
/// was done is in the report. Open meshes are taken while their inside is
/// defined; a sheet or a single triangle is refused.
///
/// Parameters: `vertices` holds x, y, z of `vertex_count` vertices, one after
/// the other, in the caller's unit and frame; `triangles` holds three vertex
/// indices for each of `triangle_count` triangles, counter-clockwise seen from
/// outside, the first vertex being index_base of the options; `options` may be
/// NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option);
/// STRUCT_SIZE; NOT_FINITE (a vertex); INDEX_OUT_OF_RANGE (a triangle); EMPTY;
/// ZERO_VOLUME; OPEN_SURFACE; SEVERAL_BODIES; TOO_LARGE; MEMORY_LIMIT;
/// OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_mesh(
    vertices: *const f64,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    guard(|| {
        require(shape, "shape")?;
        let (import, run, base) = unsafe { import(options)? };
        let vertices = unsafe { triples(vertices, vertex_count, "vertices")? };
        let mut faces =
            std::borrow::Cow::Borrowed(unsafe { triples(triangles, triangle_count, "triangles")? });
        if base != 0 {
            faces = std::borrow::Cow::Owned(rebased(&faces, vertices.len(), base)?);
        }
        let made = Shape::from_mesh(vertices, &faces, &import, &run)?;
        unsafe { give_shape(shape, made, &run) };
        Ok(())
    })
}

/// A flat array of triples.
unsafe fn triples<'a, T>(flat: *const T, count: usize, name: &str) -> Result<&'a [[T; 3]]> {
    if count > 0 {
        require(flat, name)?;
    }
    unsafe { slice(flat.cast::<[T; 3]>(), count, name) }
}

/// Triangles whose first vertex is `base`, as 0-based; the message is in the caller's counting.
fn rebased(faces: &[[u32; 3]], vertices: usize, base: u32) -> Result<Vec<[u32; 3]>> {
    let mut moved = crate::error::reserve("the triangles", faces.len())?;
    for (i, face) in faces.iter().enumerate() {
        let mut f = *face;
        for v in &mut f {
            let index = v.checked_sub(base).filter(|&at| (at as usize) < vertices);
            *v = index.ok_or_else(|| {
                Error::IndexOutOfRange(format!(
                    "triangle {} refers to vertex {v}, but the vertices are {base} to {}",
                    i + base as usize,
                    vertices + base as usize - 1
                ))
            })?;
        }
        moved.push(f);
    }
    Ok(moved)
}

/// Takes a shape back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_free(shape: *mut morula_shape) {
    unsafe { take(shape) };
}

/// What was found in the input and what was done about it.
///
/// Parameters: `report` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_report(
    shape: *const morula_shape,
    report: *mut morula_report,
) -> i32 {
    guard(|| {
        let r = &unsafe { borrow(shape, "shape")? }.inner.report;
        let value = morula_report {
            struct_size: 0,
            input_vertices: r.input_vertices,
            input_faces: r.input_faces,
            vertices: r.vertices,
            faces: r.faces,
            solid_cells: r.solid_cells,
            components: r.components,
            bodies: r.bodies,
            bodies_dropped: r.bodies_dropped,
            faces_turned: r.faces_turned,
            boundary_edges: r.boundary_edges,
            nonmanifold_edges: r.nonmanifold_edges,
            degenerate_faces: r.degenerate_faces,
            duplicate_faces: r.duplicate_faces,
            welded_vertices: r.welded_vertices,
            watertight: r.watertight.into(),
            oriented: r.oriented.into(),
            inverted: r.inverted.into(),
            touches_border: r.touches_border.into(),
            volume: r.volume,
            area: r.area,
            box_min: r.box_min,
            box_max: r.box_max,
            length_unit: r.length_unit,
            threshold: r.threshold,
        };
        unsafe { fill(report, &value) }
    })
}

/// How many notes there are on the input: sentences that a user should know.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_note_count(
    shape: *const morula_shape,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let shape = unsafe { borrow(shape, "shape")? };
        unsafe { put(count, shape.inner.report.notes.len(), "count") }
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
pub unsafe extern "C" fn morula_shape_copy_note(
    shape: *const morula_shape,
    index: usize,
    capacity: usize,
    text: *mut c_char,
    length: *mut usize,
) -> i32 {
    guard(|| {
        let shape = unsafe { borrow(shape, "shape")? };
        unsafe { copy_text(note(&shape.inner.report.notes, index)?, capacity, text, length) }
    })
}

/// Mass, centre and inertia of a shape, exact for closed meshes and voxels.
///
/// Parameters: `density` is mass per (caller's unit)^3; `moments` is filled:
/// set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INVALID_ARGUMENT (the
/// density is not a number greater than 0, or so great that mass or inertia
/// overflow); OUT_OF_MEMORY; INTERNAL.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_moments(
    shape: *const morula_shape,
    density: f64,
    moments: *mut morula_moments,
) -> i32 {
    guard(|| {
        let shape = &unsafe { borrow(shape, "shape")? }.inner;
        unsafe { super::options::check(moments)? };
        check_density(density)?;
        let unit = unit_moments(&shape.body, &Run::serial())?;
        let value = moments_struct(&unit, &shape.frame, density)?;
        unsafe { fill(moments, &value) }
    })
}

/// What was done to make the shape: stage times and counters of the call that
/// made it. What comes later (solids, moments, clumps) does not count.
///
/// Parameters: `counters` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_counters(
    shape: *const morula_shape,
    counters: *mut morula_counters,
) -> i32 {
    guard(|| {
        let shape = unsafe { borrow(shape, "shape")? };
        unsafe { fill(counters, &counters_struct(&shape.counters)) }
    })
}

/// Note `index`.
pub(super) fn note(notes: &[String], index: usize) -> Result<&str> {
    notes.get(index).map(String::as_str).ok_or_else(|| {
        Error::IndexOutOfRange(format!("note {index} does not exist, there are {}", notes.len()))
    })
}

/// Writes one value of the caller's.
pub(super) unsafe fn put<T>(to: *mut T, value: T, name: &str) -> Result<()> {
    require(to, name)?;
    unsafe { to.write(value) };
    Ok(())
}

pub(super) fn check_density(density: f64) -> Result<()> {
    if density.is_finite() && density > 0.0 {
        return Ok(());
    }
    Err(Error::InvalidArgument(format!("density is {density}, not a number greater than 0")))
}

/// Moments of the unit frame as the caller gets them. The principal frame is
/// found in the unit frame, so that it does not depend on the caller's unit.
pub(super) fn moments_struct(
    unit: &Moments,
    frame: &UnitFrame,
    density: f64,
) -> Result<morula_moments> {
    check_density(density)?;
    let input = frame.moments_to_input(unit);
    let principal = PrincipalFrame::of_rounded(&unit.inertia, frame.noise());
    let to_mass = frame.scale.powi(5) * density;
    let mut rotation = [0.0; 9];
    rotation.copy_from_slice(principal.axes.as_slice());
    let value = morula_moments {
        struct_size: 0,
        volume: input.volume,
        mass: input.volume * density,
        centre: input.centroid.into(),
        inertia: input.inertia.to_array().map(|v| v * density),
        principal: principal.moments.map(|v| v * to_mass),
        rotation,
        quaternion: principal.quaternion,
        relative_error: unit.relative_error,
    };
    let finite = [value.volume, value.mass].iter().all(|v| v.is_finite())
        && value.inertia.iter().chain(&value.principal).all(|v| v.is_finite());
    if !finite {
        return Err(Error::InvalidArgument(format!(
            "density is {density}: the mass or the inertia is greater than any number"
        )));
    }
    Ok(value)
}

/// Counters as the caller gets them.
pub(super) fn counters_struct(c: &Counters) -> morula_counters {
    let seconds = |stage: Stage| c.seconds[stage as usize];
    morula_counters {
        struct_size: 0,
        seconds_read: seconds(Stage::Read),
        seconds_check: seconds(Stage::Check),
        seconds_solid: seconds(Stage::Solid),
        seconds_generate: seconds(Stage::Generate),
        seconds_measure: seconds(Stage::Measure),
        seconds_moments: seconds(Stage::Moments),
        cells: c.cells,
        peak_bytes: c.peak_bytes,
        transforms: c.transforms,
        exact_distances: c.exact_distances,
        maxima: c.maxima,
        spheres_tried: c.spheres_tried,
        columns: c.columns,
    }
}
