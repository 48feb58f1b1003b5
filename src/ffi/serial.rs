//! Shapes, clumps and fragments as bytes.

use super::clump::morula_clump;
use super::fragment::{held_of, morula_fragments, wrap};
use super::fragment_structs::morula_held;
use super::guard::{borrow, copy_out, give, guard, require, slice};
use super::options::read;
use super::parent::morula_parent;
use super::shape::morula_shape;
use crate::error::Result;
use crate::fragment::restore;
use crate::run::Counters;
use crate::serial::{
    ClumpRecord, fragment_from_bytes, fragment_to_bytes, shape_from_bytes, shape_to_bytes,
};
use std::sync::Arc;

/// Copies the bytes and tells how many there are; `bytes` may be NULL with a capacity of 0.
unsafe fn hand(all: Vec<u8>, capacity: usize, bytes: *mut u8, size: *mut usize) -> Result<()> {
    if !size.is_null() {
        require(size, "size")?;
    }
    if !(capacity == 0 && bytes.is_null() && !size.is_null()) {
        unsafe { copy_out(&all, capacity, bytes, "bytes")? };
    }
    if !size.is_null() {
        unsafe { size.write(all.len()) };
    }
    Ok(())
}

/// Writes a shape as bytes, for another rank or a restart file: little-endian, with a version and a
/// checksum. The same shape gives the same bytes.
///
/// Parameters: `bytes` takes `capacity` bytes, or is NULL with a capacity of 0 to learn the size
/// alone; *size is the number of bytes; `size` may be NULL when `bytes` is not.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL; OUT_OF_MEMORY; INTERNAL.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_serialize(
    shape: *const morula_shape,
    capacity: usize,
    bytes: *mut u8,
    size: *mut usize,
) -> i32 {
    guard(|| {
        let shape = unsafe { borrow(shape, "shape")? };
        unsafe { hand(shape_to_bytes(&shape.inner)?, capacity, bytes, size) }
    })
}

/// Makes the shape again, to the last bit: nothing is checked, welded or repaired anew.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER; FORMAT (bytes that are cut short, changed, of
/// something else or of no shape); UNSUPPORTED (another version); TOO_LARGE (the size);
/// OUT_OF_MEMORY; INTERNAL.
/// Ownership: the bytes are copied; free *shape with morula_shape_free(). *shape is written only
/// on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_deserialize(
    bytes: *const u8,
    size: usize,
    shape: *mut *mut morula_shape,
) -> i32 {
    guard(|| {
        require(shape, "shape")?;
        let inner = shape_from_bytes(unsafe { slice(bytes, size, "bytes")? })?;
        unsafe { give(shape, morula_shape { inner, counters: Counters::default() }) };
        Ok(())
    })
}

/// Writes a clump as bytes, as morula_shape_serialize() does a shape. The counters of the calls
/// that made it are left out.
///
/// Parameters, returns, threads: as morula_shape_serialize().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_serialize(
    clump: *const morula_clump,
    capacity: usize,
    bytes: *mut u8,
    size: *mut usize,
) -> i32 {
    guard(|| {
        let c = unsafe { borrow(clump, "clump")? };
        let record = ClumpRecord {
            clump: c.inner.clone(),
            given: c.spheres.clone(),
            wants: c.wants,
            planes: c.planes,
            moments: c.target.0,
            frame: c.target.1,
        };
        unsafe { hand(record.to_bytes()?, capacity, bytes, size) }
    })
}

/// Makes the clump again, to the last bit; its counters are 0.
///
/// Returns: as morula_shape_deserialize().
/// Ownership: the bytes are copied; free *clump with morula_clump_free(). *clump is written only
/// on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_deserialize(
    bytes: *const u8,
    size: usize,
    clump: *mut *mut morula_clump,
) -> i32 {
    guard(|| {
        require(clump, "clump")?;
        let r = ClumpRecord::from_bytes(unsafe { slice(bytes, size, "bytes")? })?;
        let made = morula_clump {
            inner: r.clump,
            spheres: r.given,
            wants: r.wants,
            planes: r.planes,
            target: (r.moments, r.frame),
        };
        unsafe { give(clump, made) };
        Ok(())
    })
}

/// Writes fragment `index` (from 0) as bytes, as morula_shape_serialize() does a shape: which part of
/// its first parent it is, and its spheres; 20 spheres make about 1.5 KiB. What the solver holds of it
/// (morula_held) travels with the solver's own data.
///
/// Parameters, returns, threads: as morula_shape_serialize(); INDEX_OUT_OF_RANGE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_serialize(
    fragments: *const morula_fragments,
    index: usize,
    capacity: usize,
    bytes: *mut u8,
    size: *mut usize,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        let f = all.at(index)?;
        let made = fragment_to_bytes(all.parent_of(index)?, &f.region, &f.clump.spheres)?;
        unsafe { hand(made, capacity, bytes, size) }
    })
}

/// Makes a fragment again, beside a parent of the same shape and grid: fragment 0 of *fragments, which
/// can be read, grown and broken as the one that was written. Its spheres are the same to the last bit.
/// It has no masses of spheres and no map, its coverage, volume_share and step_factor are 0.
///
/// Parameters: `held` is the fragment as the solver holds it: what it takes over.
/// Returns: as morula_shape_deserialize(); INVALID_ARGUMENT (bytes of a fragment of another parent;
/// the held body); NOT_FINITE and STRUCT_SIZE (the held body).
/// Ownership: inputs are copied; free *fragments with morula_fragments_free(). *fragments is written
/// only on success.
/// Threads: any thread; the parent is only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_deserialize(
    parent: *const morula_parent,
    bytes: *const u8,
    size: usize,
    held: *const morula_held,
    fragments: *mut *mut morula_fragments,
) -> i32 {
    guard(|| {
        let parent = &unsafe { borrow(parent, "parent")? }.inner;
        require(held, "held")?;
        require(fragments, "fragments")?;
        let held = held_of(&unsafe { read(held)? });
        let record = fragment_from_bytes(parent, unsafe { slice(bytes, size, "bytes")? })?;
        let found = restore(parent, record.region, record.spheres, &held)?;
        unsafe { give(fragments, wrap(vec![Arc::clone(parent)], &held, found)?) };
        Ok(())
    })
}
