//! Parents: particles that may break, and the caller's cache of them.

use super::callbacks::run;
use super::clump::{morula_clump, rows};
use super::fragment_structs::*;
use super::guard::{array_or, borrow, give, guard, require, take};
use super::options::{check, fill, init, read};
use super::shape::{morula_shape, put};
use super::solid::{morula_solid, solid_options};
use super::structs::morula_solid_options;
use crate::error::{Error, Result, collected};
use crate::fragment::{Cache, Held, Parent};
use crate::mass::Body;
use crate::math::{Sphere, Vec3};
use std::sync::Arc;

/// A particle that may break: its solid and the spheres of its clump, with what every break of it
/// reads. Made once a template by morula_parent_from_solid(), morula_parent_from_clump() or
/// morula_cache_parent(), freed by morula_parent_free(). It needs neither the solid nor the clump any more.
pub struct morula_parent {
    pub(super) inner: Arc<Parent>,
}

/// Prepared parents that are used again, within a bound of memory. Made by morula_cache_new(), freed
/// by morula_cache_free(). The parents that it gave do not need it any more.
pub struct morula_cache {
    inner: Cache,
}

const _: () = {
    // Const functions may run at the same time on one handle.
    const fn shared<T: Send + Sync>() {}
    shared::<morula_parent>();
    shared::<morula_cache>();
};

/// Spheres of the caller's.
unsafe fn spheres_of(xyzr: *const f64, count: usize, name: &str) -> Result<Vec<Sphere>> {
    let all = unsafe { rows::<4>(xyzr, count, name)? };
    collected(name, all.iter().map(|&[x, y, z, r]| Sphere::new(Vec3::new(x, y, z), r)))
}

pub(super) unsafe fn checked_spheres(
    xyzr: *const f64,
    count: usize,
    name: &str,
) -> Result<Vec<Sphere>> {
    let all = unsafe { spheres_of(xyzr, count, name)? };
    for (i, s) in all.iter().enumerate() {
        let c = s.center;
        if !(c.iter().all(|v| v.is_finite()) && s.radius.is_finite()) {
            return Err(Error::NotFinite(format!(
                "sphere {i} of {name} is ({}, {}, {}) with radius {}",
                c.x, c.y, c.z, s.radius
            )));
        }
        if s.radius <= 0.0 {
            let r = s.radius;
            return Err(Error::InvalidArgument(format!(
                "sphere {i} of {name} has the radius {r}, not above 0"
            )));
        }
    }
    Ok(all)
}

/// Makes ready for breaks a particle of spheres that were made elsewhere.
///
/// Parameters: `xyzr` holds the `count` spheres of its clump in the frame and unit of the shape, x,
/// y, z and radius each, or none: then fragments fill the solid, and nothing is known of time steps;
/// `threads` is the number of threads of this call, 0: all cores.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (threads, a radius); NOT_FINITE (a
/// sphere); TOO_LARGE (the count); MEMORY_LIMIT (of the solid's options); OUT_OF_MEMORY; INTERNAL.
/// Ownership: inputs stay the caller's and may be freed at once; free *parent with
/// morula_parent_free(). *parent is written only on success.
/// Threads: any thread; the solid is only read. The same bytes come out for any number of threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_parent_from_solid(
    solid: *const morula_solid,
    xyzr: *const f64,
    count: usize,
    threads: i32,
    parent: *mut *mut morula_parent,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        require(parent, "parent")?;
        let spheres = unsafe { checked_spheres(xyzr, count, "xyzr")? };
        let run = run(threads, None, std::ptr::null_mut())?;
        let inner = Arc::new(Parent::new(Arc::clone(&solid.inner), &spheres, &run)?);
        unsafe { give(parent, morula_parent { inner }) };
        Ok(())
    })
}

/// Makes a particle with its clump ready for breaks.
///
/// Parameters: `clump` was made of `solid`; `threads` as morula_parent_from_solid().
/// Returns: as morula_parent_from_solid(); INVALID_ARGUMENT also for a clump of another solid.
/// Ownership: as morula_parent_from_solid().
/// Threads: any thread; solid and clump are only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_parent_from_clump(
    solid: *const morula_solid,
    clump: *const morula_clump,
    threads: i32,
    parent: *mut *mut morula_parent,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        let clump = unsafe { borrow(clump, "clump")? };
        require(parent, "parent")?;
        let (moments, frame) = &clump.target;
        if (moments, frame) != (solid.inner.unit_moments(), solid.inner.frame()) {
            return Err(Error::InvalidArgument("the clump was made of another solid".into()));
        }
        let run = run(threads, None, std::ptr::null_mut())?;
        let made = Parent::new(Arc::clone(&solid.inner), &clump.inner.spheres, &run)?;
        unsafe { give(parent, morula_parent { inner: Arc::new(made) }) };
        Ok(())
    })
}

/// Bytes that a parent holds beside its solid.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_parent_bytes(parent: *const morula_parent, bytes: *mut u64) -> i32 {
    guard(|| {
        let parent = unsafe { borrow(parent, "parent")? };
        unsafe { put(bytes, parent.inner.bytes(), "bytes") }
    })
}

/// Takes a parent back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_parent_free(parent: *mut morula_parent) {
    unsafe { take(parent) };
}

/// Fills a body at rest at the origin, with mass, centre and inertia of 0, to be set by hand.
///
/// Parameters: `size` is sizeof *held.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_held_init(held: *mut morula_held, size: usize) -> i32 {
    guard(|| unsafe { init(held, size) })
}

/// Three numbers of the caller's, which may be left out.
unsafe fn finite(pointer: *const f64, default: Vec3, name: &str) -> Result<Vec3> {
    let three = unsafe { array_or(pointer, [default.x, default.y, default.z], name)? };
    match three.iter().position(|v| !v.is_finite()) {
        Some(i) => Err(Error::NotFinite(format!("{name}[{i}] is {}", three[i]))),
        None => Ok(three.into()),
    }
}

/// The state of a body as a solver holds it.
pub(super) unsafe fn state(
    held: &mut Held,
    axes: [f64; 4],
    position: *const f64,
    quaternion: *const f64,
    velocity: *const f64,
    angular_velocity: *const f64,
) -> Result<()> {
    unsafe {
        held.position = finite(position, held.position, "position")?;
        held.velocity = finite(velocity, held.velocity, "velocity")?;
        let spin = held.angular_velocity;
        held.angular_velocity = finite(angular_velocity, spin, "angular_velocity")?;
        if !quaternion.is_null() {
            held.turn_to(array_or(quaternion, [0.0; 4], "quaternion")?, axes)?;
        }
    }
    Ok(())
}

pub(super) fn held_struct(h: &Held) -> morula_held {
    morula_held {
        struct_size: 0,
        mass: h.mass,
        centre: h.center.into(),
        inertia: h.inertia.to_array(),
        scale: h.scale,
        position: h.position.into(),
        quaternion: h.rotation,
        velocity: h.velocity.into(),
        angular_velocity: h.angular_velocity.into(),
    }
}

/// The body of a whole parent: mass, centre and inertia of its solid, in its place.
///
/// Parameters: `density` is mass per (unit of the world)^3; `scale` is what lengths of the shape are
/// multiplied by; `position` is where the centre is (NULL: where the shape has it, times the
/// scale); `quaternion` turns the body axes (those of morula_solid_moments()) into the world: w, x,
/// y, z of any length but 0 (NULL: the shape is not turned); `velocity` and `angular_velocity` hold
/// three numbers of the world (NULL: 0). `held` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INVALID_ARGUMENT (density or scale not
/// above 0, a quaternion of 0, a size beyond the numbers); NOT_FINITE (the density, or a number of
/// position, quaternion and velocities).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_parent_held(
    parent: *const morula_parent,
    density: f64,
    scale: f64,
    position: *const f64,
    quaternion: *const f64,
    velocity: *const f64,
    angular_velocity: *const f64,
    held: *mut morula_held,
) -> i32 {
    guard(|| {
        let parent = unsafe { borrow(parent, "parent")? };
        unsafe { check(held)? };
        let body = Body::of_solid(parent.inner.solid(), density)?;
        let mut of = Held::of_body(&body, scale)?;
        let axes = body.principal.quaternion;
        unsafe {
            state(&mut of, axes, position, quaternion, velocity, angular_velocity)?;
            fill(held, &held_struct(&of))
        }
    })
}

/// An empty cache of parents, the caller's own: nothing is global.
///
/// Parameters: `limit` is how many bytes the parents that it keeps may hold, with their solids; those
/// not used for longest go first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; OUT_OF_MEMORY.
/// Ownership: free *cache with morula_cache_free(). *cache is written only on success.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cache_new(limit: u64, cache: *mut *mut morula_cache) -> i32 {
    guard(|| {
        require(cache, "cache")?;
        unsafe { give(cache, morula_cache { inner: Cache::new(limit) }) };
        Ok(())
    })
}

/// The parent of a shape with its spheres: the one that was made before of the same shape, grid and
/// spheres, else a new one, which stays in the cache when there is room. The parent, and all that
/// is made of it, does not depend on what the cache holds.
///
/// Parameters: `options` are those of its solid, NULL for the defaults; their threads, progress and
/// user are those of the call. `xyzr` and `count` as morula_parent_from_solid().
/// Returns: the statuses of morula_solid_from_shape() and morula_parent_from_solid().
/// Ownership: inputs stay the caller's and may be freed at once; free *parent with
/// morula_parent_free(): the cache keeps its own. *parent is written only on success.
/// Threads: may run at the same time as other functions on this handle but morula_cache_free().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cache_parent(
    cache: *const morula_cache,
    shape: *const morula_shape,
    options: *const morula_solid_options,
    xyzr: *const f64,
    count: usize,
    parent: *mut *mut morula_parent,
) -> i32 {
    guard(|| {
        let cache = &unsafe { borrow(cache, "cache")? }.inner;
        let shape = &unsafe { borrow(shape, "shape")? }.inner;
        require(parent, "parent")?;
        let o = unsafe { read(options)? };
        let spheres = unsafe { checked_spheres(xyzr, count, "xyzr")? };
        let run = run(o.threads, o.progress, o.user)?;
        let inner = cache.parent(shape, &solid_options(&o)?, &spheres, &run)?;
        unsafe { give(parent, morula_parent { inner }) };
        Ok(())
    })
}

/// What a cache has done, and what it holds.
///
/// Parameters: `counters` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: as morula_cache_parent().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cache_counters(
    cache: *const morula_cache,
    counters: *mut morula_cache_counts,
) -> i32 {
    guard(|| {
        let c = unsafe { borrow(cache, "cache")? }.inner.counters();
        let value = morula_cache_counts {
            struct_size: 0,
            hits: c.hits,
            misses: c.misses,
            evicted: c.evicted,
            parents: c.parents as u64,
            bytes: c.bytes,
        };
        unsafe { fill(counters, &value) }
    })
}

/// Lets all parents of a cache go; its counters of what was done stay.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: as morula_cache_parent().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cache_clear(cache: *const morula_cache) -> i32 {
    guard(|| {
        unsafe { borrow(cache, "cache")? }.inner.clear();
        Ok(())
    })
}

/// Takes a cache back, not the parents that it gave. NULL is ignored; a handle must not be used
/// afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cache_free(cache: *mut morula_cache) {
    unsafe { take(cache) };
}
