//! What can be asked of a weighed clump.

use super::body::morula_body;
use super::choices::*;
use super::guard::{borrow, copy_out, guard};
use super::mass_structs::*;
use super::options::{check, fill};
use super::shape::put;
use super::structs::morula_moments;
use crate::error::{Error, Result, reserve};
use crate::mass::{MassStatus, single_precision};
use crate::math::Sphere;
use std::borrow::Cow;
use std::ffi::c_char;

impl morula_body {
    /// The spheres in a frame.
    fn in_frame(&self, frame: i32) -> Result<Cow<'_, [Sphere]>> {
        match frame {
            MORULA_FRAME_INPUT => Ok(Cow::Borrowed(&self.spheres)),
            MORULA_FRAME_BODY => Ok(Cow::Owned(self.body.to_body(&self.spheres))),
            other => Err(Error::InvalidArgument(format!("frame is {other}, no choice"))),
        }
    }

    fn room(&self, capacity: usize, name: &str) -> Result<()> {
        let count = self.spheres.len();
        if capacity < count {
            return Err(Error::BufferTooSmall(format!(
                "{name} has room for {capacity} of {count} spheres"
            )));
        }
        Ok(())
    }
}

/// How many spheres a weighed clump has; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_sphere_count(
    body: *const morula_body,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let body = unsafe { borrow(body, "body")? };
        unsafe { put(count, body.spheres.len(), "count") }
    })
}

/// Copies the spheres, in their order.
///
/// Parameters: `frame` is one of MORULA_FRAME_*; `xyzr` has room for `capacity` spheres of four
/// numbers each: x, y, z and radius (in Fortran an array xyzr(4, n)).
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (the frame); BUFFER_TOO_SMALL (nothing
/// is written); OUT_OF_MEMORY.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_copy_spheres(
    body: *const morula_body,
    frame: i32,
    capacity: usize,
    xyzr: *mut f64,
) -> i32 {
    guard(|| {
        let body = unsafe { borrow(body, "body")? };
        let spheres = body.in_frame(frame)?;
        body.room(capacity, "xyzr")?;
        let mut flat = reserve("the spheres", 4 * spheres.len())?;
        for s in spheres.iter() {
            flat.extend([s.center.x, s.center.y, s.center.z, s.radius]);
        }
        unsafe { copy_out(&flat, flat.len(), xyzr, "xyzr") }
    })
}

/// Copies the spheres for a code that reads single precision: each lies within the one it stands
/// for, so that what was inside before is inside after.
///
/// Parameters: as morula_body_copy_spheres().
/// Returns: as morula_body_copy_spheres(); INVALID_ARGUMENT also for a sphere that single
/// precision cannot hold.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_copy_spheres_f32(
    body: *const morula_body,
    frame: i32,
    capacity: usize,
    xyzr: *mut f32,
) -> i32 {
    guard(|| {
        let body = unsafe { borrow(body, "body")? };
        let rounded = single_precision(&body.in_frame(frame)?)?;
        body.room(capacity, "xyzr")?;
        let mut flat = reserve("the spheres", 4 * rounded.len())?;
        flat.extend(rounded.iter().flatten());
        unsafe { copy_out(&flat, flat.len(), xyzr, "xyzr") }
    })
}

/// Copies the mass of each sphere, in their order.
///
/// Parameters: `masses` has room for `capacity` numbers.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_copy_masses(
    body: *const morula_body,
    capacity: usize,
    masses: *mut f64,
) -> i32 {
    guard(|| {
        let body = unsafe { borrow(body, "body")? };
        unsafe { copy_out(&body.masses.masses, capacity, masses, "masses") }
    })
}

/// Copies the numbers of the spheres whose mass is m_min or m_max, ascending.
///
/// Parameters: `spheres` has room for `capacity` numbers, as many as morula_masses.binding says.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_copy_binding(
    body: *const morula_body,
    capacity: usize,
    spheres: *mut u32,
) -> i32 {
    guard(|| {
        let body = unsafe { borrow(body, "body")? };
        unsafe { copy_out(&body.masses.binding, capacity, spheres, "spheres") }
    })
}

/// Mass, centre, inertia and body frame of the whole: what a solver that takes them is given.
///
/// Parameters: `moments` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_moments(
    body: *const morula_body,
    moments: *mut morula_moments,
) -> i32 {
    guard(|| {
        let b = unsafe { &borrow(body, "body")?.body };
        unsafe { check(moments)? };
        let mut rotation = [0.0; 9];
        rotation.copy_from_slice(b.principal.axes.as_slice());
        let value = morula_moments {
            struct_size: 0,
            volume: b.volume,
            mass: b.mass,
            centre: b.center.into(),
            inertia: b.inertia.to_array(),
            principal: b.principal.moments,
            rotation,
            quaternion: b.principal.quaternion,
            relative_error: b.relative_error,
        };
        unsafe { fill(moments, &value) }
    })
}

/// How far the masses of the spheres add up to the body.
///
/// Parameters: `masses` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_masses(
    body: *const morula_body,
    masses: *mut morula_masses,
) -> i32 {
    guard(|| {
        let body = unsafe { borrow(body, "body")? };
        unsafe { check(masses)? };
        let m = &body.masses;
        let value = morula_masses {
            struct_size: 0,
            mass: body.body.mass,
            m_min: m.m_min,
            largest_m_min: m.largest_m_min.unwrap_or(0.0),
            mass_residual: m.residuals.mass,
            centre_residual: m.residuals.center,
            inertia_residual: m.residuals.inertia,
            spread: m.spread,
            union_inertia_error: body.lacking,
            status: status_choice(m.status),
            binding: u32::try_from(m.binding.len()).unwrap_or(u32::MAX),
        };
        unsafe { fill(masses, &value) }
    })
}

/// The number of a status.
pub(super) fn status_choice(status: MassStatus) -> i32 {
    match status {
        MassStatus::Exact => MORULA_MASSES_EXACT,
        MassStatus::Relaxed => MORULA_MASSES_RELAXED,
        MassStatus::MassOnly => MORULA_MASSES_MASS_ONLY,
    }
}

/// The word for a MORULA_MASSES_* number ("relaxed").
///
/// Returns: static text, never NULL ("unknown" for other numbers); do not free it.
/// Threads: any thread at any time. Never fails.
#[unsafe(no_mangle)]
pub extern "C" fn morula_masses_status_name(status: i32) -> *const c_char {
    let name = match status {
        MORULA_MASSES_EXACT => c"exact",
        MORULA_MASSES_RELAXED => c"relaxed",
        MORULA_MASSES_MASS_ONLY => c"mass_only",
        MORULA_MASSES_NONE => c"none",
        _ => c"unknown",
    };
    name.as_ptr()
}
