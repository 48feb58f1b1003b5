//! What can be asked of fragments.

use super::body_read::status_choice;
use super::choices::*;
use super::clump_read::stopped_choice;
use super::fragment::morula_fragments;
use super::fragment_structs::*;
use super::guard::{borrow, copy_out, copy_text, guard, require};
use super::options::{check, fill};
use super::parent::checked_spheres;
use super::shape::{give_shape, morula_shape, note, put};
use crate::error::{Error, Result, collected, reserve};
use crate::fragment::{Fragment, Moving, Parent, grow, grown_radii, shape};
use crate::math::Sphere;
use crate::run::Run;
use std::ffi::c_char;
use std::sync::Arc;

impl morula_fragments {
    /// Fragment `index`.
    pub(super) fn at(&self, index: usize) -> Result<&Fragment> {
        let all = &self.found.fragments;
        all.get(index).ok_or_else(|| {
            Error::IndexOutOfRange(format!(
                "fragment {index} does not exist, there are {}",
                all.len()
            ))
        })
    }

    /// What fragment `index` is a part of.
    pub(super) fn parent_of(&self, index: usize) -> Result<&Arc<Parent>> {
        let own = if self.parents.len() == 1 { 0 } else { index };
        self.parents.get(own).ok_or_else(|| Error::Internal("a fragment has no parent".into()))
    }

    /// Spheres of a fragment, from the frame of the shape in another.
    fn in_frame(&self, m: &Moving, spheres: &[Sphere], frame: i32) -> Result<Vec<Sphere>> {
        let scale = self.scale_of(frame)?;
        collected(
            "spheres",
            spheres.iter().map(|s| match frame {
                MORULA_FRAME_BODY => Sphere::new(m.to_body(&s.center, scale), s.radius * scale),
                MORULA_FRAME_WORLD => Sphere::new(m.to_world(&s.center, scale), s.radius * scale),
                _ => *s,
            }),
        )
    }

    /// The unit of length of a frame.
    fn scale_of(&self, frame: i32) -> Result<f64> {
        match frame {
            MORULA_FRAME_INPUT => Ok(1.0),
            MORULA_FRAME_BODY | MORULA_FRAME_WORLD => Ok(self.held.scale),
            other => Err(Error::InvalidArgument(format!("frame is {other}, no choice"))),
        }
    }
}

/// Spheres into the caller's array.
unsafe fn hand(spheres: &[Sphere], capacity: usize, xyzr: *mut f64) -> Result<()> {
    let count = spheres.len();
    if capacity < count {
        return Err(Error::BufferTooSmall(format!(
            "xyzr has room for {capacity} of {count} spheres"
        )));
    }
    let mut flat = reserve("the spheres", count.saturating_mul(4))?;
    for s in spheres {
        flat.extend([s.center.x, s.center.y, s.center.z, s.radius]);
    }
    unsafe { copy_out(&flat, flat.len(), xyzr, "xyzr") }
}

fn moving_struct(m: &Moving) -> morula_fragment {
    let mut rotation = [0.0; 9];
    rotation.copy_from_slice(m.principal.axes.as_slice());
    morula_fragment {
        struct_size: 0,
        mass: m.mass,
        centre: m.center.into(),
        inertia: m.inertia.to_array(),
        principal: m.principal.moments,
        rotation,
        position: m.position.into(),
        quaternion: m.rotation,
        velocity: m.velocity.into(),
        angular_velocity: m.angular_velocity.into(),
        volume: 0.0,
        coverage: 0.0,
        volume_share: 0.0,
        step_factor: 0.0,
        inertia_residual: 0.0,
        sphere_count: 0,
        map_count: 0,
        half_space_count: 0,
        cell: 0,
        stopped: MORULA_STOPPED_EXHAUSTED,
        masses: MORULA_MASSES_NONE,
    }
}

/// How many fragments there are; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_count(
    fragments: *const morula_fragments,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        unsafe { put(count, all.found.fragments.len(), "count") }
    })
}

/// How many pieces of dust there are: too small for a sphere or for the volume asked for.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_dust_count(
    fragments: *const morula_fragments,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        unsafe { put(count, all.found.dust.len(), "count") }
    })
}

/// What a solver takes of fragment `index` (from 0), and its quality.
///
/// Parameters: `fragment` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INDEX_OUT_OF_RANGE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_get(
    fragments: *const morula_fragments,
    index: usize,
    fragment: *mut morula_fragment,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        let f = all.at(index)?;
        unsafe { check(fragment)? };
        let frame = all.parent_of(index)?.solid().frame();
        let value = morula_fragment {
            volume: f.region.moments(frame).volume,
            coverage: f.clump.coverage,
            volume_share: f.clump.volume_share,
            step_factor: f.clump.step_factor.unwrap_or(0.0),
            inertia_residual: f.masses.as_ref().map_or(0.0, |m| m.residuals.inertia),
            sphere_count: f.clump.spheres.len() as u64,
            map_count: f.clump.map.parents.len() as u64,
            half_space_count: f.region.half_spaces(frame).len() as u64,
            cell: f.region.cell() as u64,
            stopped: stopped_choice(f.clump.stopped),
            masses: f.masses.as_ref().map_or(MORULA_MASSES_NONE, |m| status_choice(m.status)),
            ..moving_struct(&f.moving)
        };
        unsafe { fill(fragment, &value) }
    })
}

/// What piece `index` (from 0) of the dust takes over. Its stopped, sphere_count and what concerns
/// spheres say nothing.
///
/// Parameters: `dust` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INDEX_OUT_OF_RANGE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_dust(
    fragments: *const morula_fragments,
    index: usize,
    dust: *mut morula_fragment,
) -> i32 {
    guard(|| {
        let all = &unsafe { borrow(fragments, "fragments")? }.found.dust;
        let crumb = all.get(index).ok_or_else(|| {
            Error::IndexOutOfRange(format!(
                "piece {index} of the dust does not exist, there are {}",
                all.len()
            ))
        })?;
        let value = morula_fragment {
            volume: crumb.dust.moments.volume,
            cell: crumb.dust.cell as u64,
            ..moving_struct(&crumb.moving)
        };
        unsafe { fill(dust, &value) }
    })
}

/// What the break has made of the whole.
///
/// Parameters: `totals` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_totals(
    fragments: *const morula_fragments,
    totals: *mut morula_break_totals,
) -> i32 {
    guard(|| {
        let found = &unsafe { borrow(fragments, "fragments")? }.found;
        let value = morula_break_totals {
            struct_size: 0,
            energy: found.energy,
            inertia_error: found.inertia_error,
            shift: found.shift.into(),
        };
        unsafe { fill(totals, &value) }
    })
}

/// Copies the spheres of fragment `index` (from 0), the largest first.
///
/// Parameters: `frame` is one of MORULA_FRAME_*: that of the shape, in its unit, or the fragment's
/// body frame or the world, in the unit of the world; `xyzr` has room for `capacity` spheres of four
/// numbers each: x, y, z and radius (in Fortran an array xyzr(4, n)).
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; INVALID_ARGUMENT (the frame);
/// BUFFER_TOO_SMALL (nothing is written); OUT_OF_MEMORY.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_copy_spheres(
    fragments: *const morula_fragments,
    index: usize,
    frame: i32,
    capacity: usize,
    xyzr: *mut f64,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        let f = all.at(index)?;
        let spheres = all.in_frame(&f.moving, &f.clump.spheres, frame)?;
        unsafe { hand(&spheres, capacity, xyzr) }
    })
}

/// Copies the masses of the spheres of fragment `index` (from 0), in their order. Where their status
/// is not MORULA_MASSES_EXACT they add up to the fragment's mass, but not to its inertia, which is
/// exact in morula_fragment.
///
/// Parameters: `masses` has room for `capacity` numbers.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; NOT_WANTED (no masses were wanted);
/// NO_MASSES (none were found: the notes tell why); BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_copy_masses(
    fragments: *const morula_fragments,
    index: usize,
    capacity: usize,
    masses: *mut f64,
) -> i32 {
    guard(|| {
        let f = unsafe { borrow(fragments, "fragments")? }.at(index)?;
        let found = f.masses.as_ref().ok_or_else(|| match f.no_masses.as_str() {
            "" => Error::NotWanted("masses were not wanted when the particle broke".into()),
            why => Error::NoMasses(why.to_owned()),
        })?;
        unsafe { copy_out(&found.masses, capacity, masses, "masses") }
    })
}

/// Copies which spheres of what broke those of fragment `index` (from 0) come from, so that the
/// history of contacts can be carried over: for each sphere those of the parent's clump (or, where a
/// fragment broke, of its own) that it overlaps, the greatest common volume first.
///
/// Parameters: `starts` has room for sphere_count + 1 numbers: those of sphere i are the pairs
/// starts[i] up to starts[i + 1], the last excluded; `parents` (numbers of spheres, from 0) and
/// `shares` (common volume over the volume of the fragment's sphere) have room for `capacity`
/// pairs, of which there are map_count.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is
/// written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_copy_map(
    fragments: *const morula_fragments,
    index: usize,
    starts: *mut u32,
    capacity: usize,
    parents: *mut u32,
    shares: *mut f64,
) -> i32 {
    guard(|| {
        let map = &unsafe { borrow(fragments, "fragments")? }.at(index)?.clump.map;
        require(starts, "starts")?;
        if !map.parents.is_empty() {
            require(parents, "parents")?;
            require(shares, "shares")?;
        }
        unsafe {
            copy_out(&map.parents, capacity, parents, "parents")?;
            copy_out(&map.shares, capacity, shares, "shares")?;
            copy_out(&map.starts, map.starts.len(), starts, "starts")
        }
    })
}

/// Copies the half-spaces that bound fragment `index` (from 0) within the first parent's solid: nx,
/// ny, nz and offset each, in the frame of the shape.
///
/// Parameters: `half_spaces` has room for `capacity` of them, of which there are half_space_count.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is
/// written); OUT_OF_MEMORY.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_copy_half_spaces(
    fragments: *const morula_fragments,
    index: usize,
    capacity: usize,
    half_spaces: *mut f64,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        let found = all.at(index)?.region.half_spaces(all.parent_of(index)?.solid().frame());
        if capacity < found.len() {
            let n = found.len();
            return Err(Error::BufferTooSmall(format!(
                "half_spaces has room for {capacity} of {n} half-spaces"
            )));
        }
        let mut flat = reserve("half-spaces", found.len().saturating_mul(4))?;
        for h in &found {
            flat.extend([h.normal.x, h.normal.y, h.normal.z, h.offset]);
        }
        unsafe { copy_out(&flat, flat.len(), half_spaces, "half_spaces") }
    })
}

/// The surface of fragment `index` (from 0) as a shape of its own, in the frame of the shape.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; UNSUPPORTED (the parent is a mesh that
/// is open or crosses itself); the statuses of morula_shape_from_mesh().
/// Ownership: free *shape with morula_shape_free(). *shape is written only on success.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_shape(
    fragments: *const morula_fragments,
    index: usize,
    shape: *mut *mut morula_shape,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        let f = all.at(index)?;
        require(shape, "shape")?;
        let run = Run::serial();
        let made = self::shape(all.parent_of(index)?.solid(), &f.region, &run)?;
        unsafe { give_shape(shape, made, &run) };
        Ok(())
    })
}

/// Copies the spheres of fragment `index` (from 0) grown: inscribed spheres leave part of a fragment
/// empty, which makes a bed more porous at once; in steps of the host they grow to the radii of least
/// mismatch. The fragment itself keeps its spheres.
///
/// Parameters: `part` is how far, from 0 (as they are) to 1; `others` holds the `other_count` spheres
/// of siblings and neighbours, x, y, z and radius each, that the grown ones keep `gap` off at
/// least, as far as they do so now; `frame`, `capacity` and `xyzr` as
/// morula_fragments_copy_spheres(): others and gap are in that frame and its unit.
/// Returns: as morula_fragments_copy_spheres(); INVALID_ARGUMENT also for a part, gap or radius out
/// of its range; NOT_FINITE (a sphere of the others); TOO_LARGE (other_count).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_grow(
    fragments: *const morula_fragments,
    index: usize,
    part: f64,
    others: *const f64,
    other_count: usize,
    gap: f64,
    frame: i32,
    capacity: usize,
    xyzr: *mut f64,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        let f = all.at(index)?;
        let others = unsafe { checked_spheres(others, other_count, "others")? };
        let scale = all.scale_of(frame)?;
        let own = &f.clump.spheres;
        let slot = all.grown.get(index).and_then(|slot| slot.get());
        let radii = match slot {
            Some(radii) => radii,
            None => {
                let found = grown_radii(all.parent_of(index)?, &f.region, own, &Run::serial())?;
                // Two threads that come at once find the same.
                let lost = || Error::Internal("a fragment without a slot".into());
                all.grown.get(index).ok_or_else(lost)?.get_or_init(|| found)
            }
        };
        let radii = collected("radii", radii.iter().map(|r| r * scale))?;
        let spheres = all.in_frame(&f.moving, own, frame)?;
        let grown = grow(&spheres, &radii, part, &others, gap)?;
        unsafe { hand(&grown, capacity, xyzr) }
    })
}

/// How many notes there are on a break: sentences that a user should know.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_note_count(
    fragments: *const morula_fragments,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        unsafe { put(count, all.found.notes.len(), "count") }
    })
}

/// Copies note `index` (from 0) with its closing NUL.
///
/// Parameters, returns, threads: as morula_shape_copy_note().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_copy_note(
    fragments: *const morula_fragments,
    index: usize,
    capacity: usize,
    text: *mut c_char,
    length: *mut usize,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        unsafe { copy_text(note(&all.found.notes, index)?, capacity, text, length) }
    })
}
