//! Making many clumps in one call.

use super::callbacks::{MORULA_LOG_WARNING, log};
use super::clump::{Asked, asked, morula_clump};
use super::guard::{borrow, check_bytes, guard, require, slice};
use super::options::read;
use super::shape::{import, morula_shape};
use super::solid::{morula_solid, solid_options};
use super::structs::*;
use super::voxels::{cells, layout};
use crate::error::{Error, Result, reserve};
use crate::generate::{each, each_label, generate, levels};
use crate::run::{Counters, Run};
use crate::shape::Shape;
use crate::solid::{Solid, SolidOptions};

/// Makes clumps of one solid with several numbers of spheres: levels of detail.
///
/// Parameters: `spheres` holds `count` numbers of spheres, which stand in for that of `options`;
/// `options` may be NULL for the defaults; `clumps` has room for `count` handles, in the same
/// order. Each clump is, byte for byte, what morula_clump_from_solid() gives for its number;
/// the deadline is one for all.
/// Returns: MORULA_STATUS_OK; the statuses of morula_clump_from_solid(), of the first that
/// failed: then none is written.
/// Ownership: the solid stays the caller's; free each clump with morula_clump_free().
/// Threads: any thread; the solid is only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clumps_from_solid(
    solid: *const morula_solid,
    options: *const morula_clump_options,
    spheres: *const u64,
    count: usize,
    clumps: *mut *mut morula_clump,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        room(count, clumps, "clumps", std::ptr::null_mut())?;
        let counts = unsafe { slice(spheres, count, "spheres")? };
        let (asked, run) = unsafe { asked(options)? };
        let mut wanted = reserve("numbers of spheres", count)?;
        wanted.extend(counts.iter().map(|&n| usize::try_from(n).unwrap_or(usize::MAX)));
        let made = levels(&solid.inner, &asked.generate, &wanted, &run);
        let made = made.into_iter().map(|c| asked.wrap(&solid.inner, c?, &solid.counters));
        unsafe {
            give_all("level", made.collect(), clumps, std::ptr::null_mut(), morula_clump::log)
        }
    })
}

/// Makes a clump of each of many shapes; their solids are made inside. Threads share the
/// shapes, one each.
///
/// Parameters: `shapes` holds `count` handles; `solid_options` and `options` may be NULL for the
/// defaults; threads, progress and user are those of `options`, its deadline is one for all;
/// memory limits are for each shape by itself. `clumps` has room for `count` handles, and
/// `statuses`, which may be NULL, for `count` statuses, in the same order. Each clump is, byte
/// for byte, what morula_clump_from_shape() gives.
/// Returns: MORULA_STATUS_OK; the statuses of morula_clump_from_shape(), of the first shape that
/// failed. Then, with `statuses`, both arrays are written all the same, with NULL for each clump
/// that failed, and the log is told each failure; without, none is written.
/// Ownership: the shapes stay the caller's; free each clump with morula_clump_free().
/// Threads: any thread; the shapes are only read. The same bytes come out for any number of
/// threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clumps_from_shapes(
    shapes: *const *const morula_shape,
    count: usize,
    solid_options: *const morula_solid_options,
    options: *const morula_clump_options,
    clumps: *mut *mut morula_clump,
    statuses: *mut i32,
) -> i32 {
    guard(|| {
        room(count, clumps, "clumps", statuses)?;
        let handles = unsafe { slice(shapes, count, "shapes")? };
        let mut shapes = reserve("shapes", count)?;
        for (i, &handle) in handles.iter().enumerate() {
            shapes.push(unsafe { borrow(handle, &format!("shape {i}"))? });
        }
        let grid = self::solid_options(&unsafe { read(solid_options)? })?;
        let (asked, run) = unsafe { asked(options)? };
        let made = each(count, &run, |k, run| {
            one(&shapes[k].inner, &shapes[k].counters, &grid, &asked, run)
        });
        unsafe { give_all("shape", made, clumps, statuses, morula_clump::log) }
    })
}

/// Makes a clump of each of many labels of a label volume. Threads share the labels, one
/// each, and look at a label's own box alone.
///
/// Parameters: `labels`, `dims`, `spacing`, `origin`, `import_options` as
/// morula_shape_from_label(); `wanted` holds the `count` labels, see morula_labels_copy();
/// all others as morula_clumps_from_shapes().
/// Returns: as morula_clumps_from_shapes() and morula_shape_from_label().
/// Ownership: free each clump with morula_clump_free().
/// Threads: any thread. The same bytes come out for any number of threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clumps_from_labels(
    labels: *const u32,
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
    wanted: *const u32,
    count: usize,
    import_options: *const morula_import_options,
    solid_options: *const morula_solid_options,
    options: *const morula_clump_options,
    clumps: *mut *mut morula_clump,
    statuses: *mut i32,
) -> i32 {
    guard(|| {
        room(count, clumps, "clumps", statuses)?;
        let (import, _, _) = unsafe { import(import_options)? };
        let layout = unsafe { layout(dims, spacing, origin)? };
        let labels = unsafe { cells(labels, layout.dims, "labels")? };
        let wanted = unsafe { slice(wanted, count, "wanted")? };
        let grid = self::solid_options(&unsafe { read(solid_options)? })?;
        let (asked, run) = unsafe { asked(options)? };
        let made = each_label(labels, &layout, wanted, &import, &run, |shape, run| {
            one(shape, &Counters::default(), &grid, &asked, run)
        })?;
        unsafe { give_all("label at", made, clumps, statuses, morula_clump::log) }
    })
}

/// A clump of a shape.
fn one(
    shape: &Shape,
    before: &Counters,
    grid: &SolidOptions,
    asked: &Asked,
    run: &Run,
) -> Result<morula_clump> {
    let solid = Solid::new(shape, grid, run)?;
    asked.wrap(&solid, generate(&solid, &asked.generate, run)?, before)
}

/// Whether there may be room for `count` handles, and statuses where they are asked for.
pub(super) fn room<T>(
    count: usize,
    handles: *mut *mut T,
    name: &str,
    statuses: *mut i32,
) -> Result<()> {
    if count == 0 {
        return Ok(());
    }
    check_bytes::<*mut T>(count, name)?;
    require(handles, name)?;
    if statuses.is_null() { Ok(()) } else { require(statuses, "statuses") }
}

/// Hands what was made over, told to the log; without `statuses` all of it or nothing.
pub(super) unsafe fn give_all<T>(
    what: &str,
    made: Vec<Result<T>>,
    handles: *mut *mut T,
    statuses: *mut i32,
    tell: impl Fn(&T),
) -> Result<()> {
    let failed = |(i, e): (usize, &Error)| e.about(&format!("{what} {i}"));
    let failures = made.iter().enumerate().filter_map(|(i, c)| Some((i, c.as_ref().err()?)));
    let first = failures.clone().next().map(failed);
    if statuses.is_null() {
        if let Some(error) = first {
            return Err(error);
        }
    } else {
        for failure in failures {
            log(MORULA_LOG_WARNING, || failed(failure).to_string());
        }
    }
    for (i, one) in made.into_iter().enumerate() {
        let status = one.as_ref().err().map_or(super::MORULA_STATUS_OK, Error::status);
        let handle = one.map_or(std::ptr::null_mut(), |one| {
            tell(&one);
            Box::into_raw(Box::new(one))
        });
        unsafe {
            handles.add(i).write(handle);
            if !statuses.is_null() {
                statuses.add(i).write(status);
            }
        }
    }
    first.map_or(Ok(()), Err)
}
