//! Price lists over resolutions, methods and deadlines.

use super::choices::*;
use super::clump::{Asked, asked, effort, method};
use super::cost::{morula_cost, wanted};
use super::cost_structs::*;
use super::guard::{borrow, check_bytes, give, guard, require, slice, take};
use super::options::{check, fill, init, read};
use super::shape::{morula_shape, put};
use super::solid::solid_options;
use super::status::MORULA_STATUS_OK;
use super::structs::*;
use crate::cost::{SweepOptions, Swept, sweep_each};
use crate::error::{Error, Result, collected, reserve};
use crate::generate::{Effort, Method};
use crate::run::Counters;
use crate::solid::{Resolution, Solid, SolidOptions};

/// Price lists of one shape: for each resolution, in it for each method, of each for each deadline.
/// Made by morula_sweep_from_shape(), freed by morula_sweep_free(). It needs the shape no more.
pub struct morula_sweep {
    all: Vec<One>,
}

struct One {
    info: morula_swept,
    list: Result<morula_cost>,
}

const _: () = {
    // Const functions may run at the same time on one handle.
    const fn shared<T: Send + Sync>() {}
    shared::<morula_sweep>();
};

/// Fills options that sweep over nothing yet.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_sweep_options_init(
    options: *mut morula_sweep_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// The grids, with what the caller wrote for each.
unsafe fn grids(
    o: &morula_sweep_options,
    solid: &morula_solid_options,
) -> Result<Vec<SolidOptions>> {
    let resolutions = unsafe { slice(o.resolutions, o.resolution_count, "resolutions")? };
    let each = resolutions.iter().enumerate().map(|(k, &x)| {
        let mut one = morula_solid_options { cell_size: x, ..*solid };
        if solid.resolution != MORULA_RESOLUTION_CELL_SIZE {
            if x.fract() != 0.0 || !(1.0..=f64::from(u32::MAX)).contains(&x) {
                return Err(Error::InvalidArgument(format!(
                    "resolution {k} is {x}, not a whole number of cells"
                )));
            }
            one.cells = x as u32;
        }
        solid_options(&one).map_err(|e| e.about(&format!("resolution {k}")))
    });
    let mut all = reserve("resolutions", resolutions.len())?;
    for one in each {
        all.push(one?);
    }
    Ok(all)
}

/// The methods with their efforts.
unsafe fn methods(o: &morula_sweep_options, common: Effort) -> Result<Vec<(Method, Effort)>> {
    let methods = unsafe { slice(o.methods, o.method_count, "methods")? };
    let efforts = match o.efforts.is_null() {
        true => &[][..],
        false => unsafe { slice(o.efforts, o.method_count, "efforts")? },
    };
    let mut all = reserve("methods", methods.len())?;
    for (k, &value) in methods.iter().enumerate() {
        let of = |e: Error| e.about(&format!("method {k}"));
        let effort = efforts.get(k).map_or(Ok(common), |&e| effort(e).map_err(of))?;
        all.push((method(value).map_err(of)?, effort));
    }
    Ok(all)
}

/// What a caller's number of a resolution was.
fn number(resolution: Resolution) -> f64 {
    match resolution {
        Resolution::CellsLongest(n)
        | Resolution::CellsShortest(n)
        | Resolution::CellsDiameter(n) => f64::from(n),
        Resolution::CellSize(size) => size,
    }
}

/// Makes the price lists of a shape over resolutions, methods and deadlines.
///
/// Parameters: `solid_options` and `options` may be NULL for the defaults; of the former the
/// number of cells (with MORULA_RESOLUTION_CELL_SIZE the edge of a cell) is not read, of the latter
/// neither the method nor, where the sweep has efforts, the effort, nor what morula_cost_curve()
/// does not read. Threads, progress and user are those of `options`, whose deadline is one for the
/// whole sweep: the lists that are begun after it have a line each. `cost` may be NULL for the
/// defaults; its `seconds` are not read. `what` says what is swept over.
/// Returns: MORULA_STATUS_OK, also when some lists could not be made, or the callback cancelled
/// after there was a line: morula_swept has the status of each list; NULL_POINTER; EMPTY (nothing
/// to sweep over); INVALID_ARGUMENT (a resolution, method, effort or deadline that is none, an
/// option); STRUCT_SIZE; TOO_LARGE; OUT_OF_MEMORY; INTERNAL; where there is no list at all, the
/// statuses of morula_solid_from_shape() and morula_cost_curve(), of the first list.
/// Ownership: the shape stays the caller's and may be freed at once; free *sweep with
/// morula_sweep_free(). *sweep is written only on success.
/// Threads: any thread; the shape is only read. But for seconds the same bytes come out for any
/// number of threads, as long as no deadline is met.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_sweep_from_shape(
    shape: *const morula_shape,
    solid_options: *const morula_solid_options,
    options: *const morula_clump_options,
    cost: *const morula_cost_options,
    what: *const morula_sweep_options,
    sweep: *mut *mut morula_sweep,
) -> i32 {
    guard(|| {
        let shape = unsafe { borrow(shape, "shape")? };
        require(sweep, "sweep")?;
        require(what, "what")?;
        let what = unsafe { read(what)? };
        let mut curve = unsafe { wanted(&read(cost)?)? };
        let (asked, run) = unsafe { asked(options)? };
        curve.generate = asked.generate.clone();
        let surface = curve.quality.surface;
        let grids = unsafe { grids(&what, &read(solid_options)?)? };
        let seconds = unsafe { slice(what.deadlines, what.deadline_count, "deadlines")? };
        let options = SweepOptions {
            resolutions: collected("resolutions", grids.iter().map(|g| g.resolution))?,
            methods: unsafe { methods(&what, asked.generate.effort)? },
            seconds: collected("deadlines", seconds.iter().copied())?,
            solid: grids.first().copied().unwrap_or_default(),
            curve,
        };
        let mut all = reserve("curves", options.curves())?;
        sweep_each(&shape.inner, &options, &run, |solid, one| {
            all.push(wrap(one, solid, &shape.counters, &asked, surface));
            Ok(())
        })?;
        if all.iter().all(|one| one.list.is_err())
            && let Some(Err(error)) = all.first().map(|one| &one.list)
        {
            return Err(error.clone());
        }
        unsafe { give(sweep, morula_sweep { all }) };
        Ok(())
    })
}

/// What C is told of a curve, and its handle.
fn wrap(
    one: Swept,
    solid: Option<(&Solid, &Counters)>,
    shape: &Counters,
    asked: &Asked,
    surface: bool,
) -> One {
    let list = one.curve.and_then(|curve| {
        let (solid, counters) =
            solid.ok_or_else(|| Error::Internal("a curve without its solid".into()))?;
        morula_cost::new(curve, asked, surface, solid, &shape.then(counters))
    });
    let info = morula_swept {
        struct_size: 0,
        resolution: number(one.resolution),
        cells: one.cells.map(|n| n as u64),
        solid_seconds: one.solid_seconds,
        deadline: one.seconds,
        lines: list.as_ref().map_or(0, |l| l.0.points.len() as u64),
        method: method_choice(one.method.0),
        effort: effort_choice(one.method.1),
        status: list.as_ref().err().map_or(MORULA_STATUS_OK, Error::status),
        cut: list.as_ref().map_or(0, |l| i32::from(l.0.cut)),
    };
    One { info, list }
}

fn method_choice(method: Method) -> i32 {
    match method {
        Method::Mss => MORULA_METHOD_MSS,
        Method::Best => MORULA_METHOD_BEST,
        Method::SurfaceFit => MORULA_METHOD_SURFACE_FIT,
        Method::Inscribed => MORULA_METHOD_INSCRIBED,
        Method::Cover => MORULA_METHOD_COVER,
        Method::Packed => MORULA_METHOD_PACKED,
        Method::Euclidean => MORULA_METHOD_EUCLIDEAN,
        Method::FerellecMcDowell => MORULA_METHOD_FERELLEC_MCDOWELL,
        Method::Favier => MORULA_METHOD_FAVIER,
        Method::UniformGrid => MORULA_METHOD_UNIFORM_GRID,
    }
}

fn effort_choice(effort: Effort) -> i32 {
    match effort {
        Effort::Draft => MORULA_EFFORT_DRAFT,
        Effort::Normal => MORULA_EFFORT_NORMAL,
        Effort::Thorough => MORULA_EFFORT_THOROUGH,
    }
}

/// How many price lists a sweep has, those that could not be made among them.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_sweep_count(sweep: *const morula_sweep, count: *mut usize) -> i32 {
    guard(|| {
        let sweep = unsafe { borrow(sweep, "sweep")? };
        unsafe { put(count, sweep.all.len(), "count") }
    })
}

/// Copies what each price list is of: the resolutions one after the other, in each the methods, of
/// each the deadlines.
///
/// Parameters: `lists` has room for `capacity` structs, one after the other, all of the size that
/// struct_size of the first says; that of the others is set.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written); STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_sweep_copy(
    sweep: *const morula_sweep,
    capacity: usize,
    lists: *mut morula_swept,
) -> i32 {
    guard(|| {
        let sweep = unsafe { borrow(sweep, "sweep")? };
        let count = sweep.all.len();
        unsafe { check(lists)? };
        if capacity < count {
            return Err(Error::BufferTooSmall(format!(
                "lists has room for {capacity} of {count} lists"
            )));
        }
        check_bytes::<morula_swept>(count, "lists")?;
        let size = unsafe { lists.cast::<usize>().read() };
        for (i, one) in sweep.all.iter().enumerate() {
            let to = lists.cast::<u8>().wrapping_add(i * size).cast::<morula_swept>();
            require(to, "lists")?;
            unsafe {
                to.cast::<usize>().write(size);
                fill(to, &one.info)?;
            }
        }
        Ok(())
    })
}

/// A price list of a sweep.
///
/// Parameters: `index` counts lists from 0, in the order of morula_sweep_copy().
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; where the list could not be made,
/// the status that morula_swept has, with its sentence: CANCELLED for one that was not begun.
/// Ownership: free *curve with morula_cost_free(); it lives on without the sweep. *curve is
/// written only on success.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_sweep_curve(
    sweep: *const morula_sweep,
    index: usize,
    curve: *mut *mut morula_cost,
) -> i32 {
    guard(|| {
        let sweep = unsafe { borrow(sweep, "sweep")? };
        require(curve, "curve")?;
        let one = sweep.all.get(index).ok_or_else(|| {
            Error::IndexOutOfRange(format!(
                "list {index} is not among the {} of the sweep",
                sweep.all.len()
            ))
        })?;
        let list = one.list.as_ref().map_err(Error::clone)?;
        unsafe { give(curve, list.clone()) };
        Ok(())
    })
}

/// Takes a sweep back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_sweep_free(sweep: *mut morula_sweep) {
    unsafe { take(sweep) };
}
