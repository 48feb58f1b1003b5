//! What can be asked of a clump.

use super::choices::*;
use super::clump::morula_clump;
use super::guard::{borrow, copy_out, copy_text, guard};
use super::options::{check, fill};
use super::shape::{counters_struct, moments_struct, put};
use super::structs::*;
use crate::clump::Stopped;
use crate::error::{Error, Result};
use crate::measure::Quality;
use std::ffi::c_char;

impl morula_clump {
    /// The quality, when `wanted` says that this part of it was asked for.
    fn quality(&self, wanted: bool, what: &str) -> Result<&Quality> {
        if !wanted {
            return Err(Error::NotWanted(format!("{what} was not wanted when the clump was made")));
        }
        self.inner.quality.as_ref().ok_or_else(|| {
            Error::Cancelled(format!("the call was cancelled before {what} was measured"))
        })
    }
}

/// How many spheres a clump has; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_sphere_count(
    clump: *const morula_clump,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        unsafe { put(count, clump.inner.spheres.len(), "count") }
    })
}

/// Copies the spheres, in the order in which the method chose them, or by falling radius where it
/// makes all at once.
///
/// Parameters: `xyzr` has room for `capacity` spheres of four numbers each: x,
/// y, z and radius, in the caller's unit and in the frame that the options
/// asked for (in Fortran an array xyzr(4, n)).
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_copy_spheres(
    clump: *const morula_clump,
    capacity: usize,
    xyzr: *mut f64,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        let count = clump.inner.spheres.len();
        if capacity < count {
            return Err(Error::BufferTooSmall(format!(
                "xyzr has room for {capacity} of {count} spheres"
            )));
        }
        unsafe { copy_out(&clump.spheres, 4 * count, xyzr, "xyzr") }
    })
}

/// The number of a reason to stop.
pub(super) fn stopped_choice(stopped: Stopped) -> i32 {
    match stopped {
        Stopped::Spheres => MORULA_STOPPED_SPHERES,
        Stopped::Mismatch => MORULA_STOPPED_MISMATCH,
        Stopped::Radius => MORULA_STOPPED_RADIUS,
        Stopped::Deadline => MORULA_STOPPED_DEADLINE,
        Stopped::Cancelled => MORULA_STOPPED_CANCELLED,
        Stopped::Exhausted => MORULA_STOPPED_EXHAUSTED,
        Stopped::Coverage => MORULA_STOPPED_COVERAGE,
    }
}

/// Why the method stopped: one of MORULA_STOPPED_*.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_stopped(
    clump: *const morula_clump,
    stopped: *mut i32,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        unsafe { put(stopped, stopped_choice(clump.inner.stopped), "stopped") }
    })
}

/// The word for a MORULA_STOPPED_* number ("deadline").
///
/// Returns: static text, never NULL ("unknown" for other numbers); do not free it.
/// Threads: any thread at any time. Never fails.
#[unsafe(no_mangle)]
pub extern "C" fn morula_stopped_name(stopped: i32) -> *const c_char {
    let name = match stopped {
        MORULA_STOPPED_SPHERES => c"spheres",
        MORULA_STOPPED_MISMATCH => c"mismatch",
        MORULA_STOPPED_RADIUS => c"radius",
        MORULA_STOPPED_DEADLINE => c"deadline",
        MORULA_STOPPED_CANCELLED => c"cancelled",
        MORULA_STOPPED_EXHAUSTED => c"exhausted",
        MORULA_STOPPED_COVERAGE => c"coverage",
        _ => c"unknown",
    };
    name.as_ptr()
}

/// Copies the clump's note with its closing NUL: what is to be
/// said of it (fewer spheres than were asked for, a deadline, a demand that could not be met), else
/// empty.
///
/// Parameters: `text` has room for `capacity` bytes; `length` (may be NULL)
/// becomes the length without the NUL. With `text` NULL and `capacity` 0 only
/// `length` is written.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_copy_note(
    clump: *const morula_clump,
    capacity: usize,
    text: *mut c_char,
    length: *mut usize,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        unsafe { copy_text(&clump.inner.note, capacity, text, length) }
    })
}

/// Mass, centre and inertia of the clump's target: what the solver should give
/// the body (not the sum over the spheres, which overlap).
///
/// All of it is in the input frame, whatever the frame of the spheres: `centre`
/// and `rotation` are the pose that takes body-frame spheres back to the input
/// frame, and `principal` is the inertia in the body frame.
///
/// Parameters: `density` is mass per (caller's unit)^3; `moments` is filled:
/// set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; NOT_WANTED (without
/// MORULA_WANT_MOMENTS); INVALID_ARGUMENT (the density is not a number greater
/// than 0, or so great that mass or inertia overflow).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_moments(
    clump: *const morula_clump,
    density: f64,
    moments: *mut morula_moments,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        unsafe { check(moments)? };
        if clump.wants & MORULA_WANT_MOMENTS == 0 {
            return Err(Error::NotWanted(
                "MORULA_WANT_MOMENTS was not wanted when the clump was made".into(),
            ));
        }
        let value = moments_struct(&clump.target.0, &clump.target.1, density)?;
        unsafe { fill(moments, &value) }
    })
}

/// How far the clump is from its target by volume.
///
/// Parameters: `overlap` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; NOT_WANTED (without
/// MORULA_WANT_OVERLAP); CANCELLED (the call was cancelled before it was measured).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_overlap(
    clump: *const morula_clump,
    overlap: *mut morula_overlap,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        unsafe { check(overlap)? };
        let q = clump.quality(clump.wants & MORULA_WANT_OVERLAP != 0, "MORULA_WANT_OVERLAP")?;
        let value = morula_overlap {
            struct_size: 0,
            mismatch: q.mismatch,
            error_bound: q.error_bound,
            eta: q.eta,
            iou: q.iou,
            coverage: q.coverage,
            overshoot: q.overshoot,
            target_volume: q.target_volume,
            union_volume: q.union_volume,
            volume_error: q.volume_error,
            centroid_error: q.centroid_error,
            moment_errors: q.moment_errors,
        };
        unsafe { fill(overlap, &value) }
    })
}

/// How far the clump's surface is from its target's.
///
/// Parameters: `surface` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; NOT_WANTED (without
/// MORULA_WANT_SURFACE); CANCELLED (the call was cancelled before it was measured).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_surface(
    clump: *const morula_clump,
    surface: *mut morula_surface,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        unsafe { check(surface)? };
        let q = clump.quality(clump.wants & MORULA_WANT_SURFACE != 0, "MORULA_WANT_SURFACE")?;
        let value = morula_surface {
            struct_size: 0,
            protrusion: q.protrusion,
            rms_distance: q.rms_distance,
            hausdorff: q.hausdorff,
            distance_bound: q.distance_bound,
            roughness: q.roughness,
            samples: q.samples,
            never_exposed: q.never_exposed,
            reserved: 0,
            asymmetry: q.asymmetry,
            symmetry_planes: q.symmetry_planes.into(),
        };
        unsafe { fill(surface, &value) }
    })
}

/// Copies the exposed area of each sphere, in the order of the spheres.
///
/// Parameters: `areas` has room for `capacity` numbers, as many as there are spheres.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is
/// written); NOT_WANTED (without MORULA_WANT_SURFACE); CANCELLED (the call was
/// cancelled before they were measured).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_copy_exposed_areas(
    clump: *const morula_clump,
    capacity: usize,
    areas: *mut f64,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        let q = clump.quality(clump.wants & MORULA_WANT_SURFACE != 0, "MORULA_WANT_SURFACE")?;
        unsafe { copy_out(&q.exposed_areas, capacity, areas, "areas") }
    })
}

/// Copies the greatest number of spheres that one plane touches within each of
/// the plane_tolerances of the options, in their order.
///
/// Parameters: `counts` has room for `capacity` numbers, as many as there were tolerances.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is
/// written); NOT_WANTED (without plane_tolerances); CANCELLED (the call was
/// cancelled before they were counted).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_copy_plane_contacts(
    clump: *const morula_clump,
    capacity: usize,
    counts: *mut u32,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        let q = clump.quality(clump.planes, "a count of plane contacts")?;
        unsafe { copy_out(&q.plane_contacts, capacity, counts, "counts") }
    })
}

/// What was done on the whole road to the clump: stage times and counters of
/// the calls that made its shape, its solid and itself, added up (of peak_bytes
/// the greatest). What was not wanted stays 0. The calls that made a solid or a
/// shape count in every clump that was made from it.
///
/// Parameters: `counters` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_counters(
    clump: *const morula_clump,
    counters: *mut morula_counters,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        unsafe { fill(counters, &counters_struct(&clump.inner.counters)) }
    })
}
