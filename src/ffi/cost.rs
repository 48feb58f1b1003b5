//! What accuracy costs in time.

use super::choices::*;
use super::clump::{Asked, asked, morula_clump};
use super::clump_read::stopped_choice;
use super::cost_structs::*;
use super::guard::{borrow, check_bytes, copy_text, give, guard, require, slice, take};
use super::options::{check, fill, init, read};
use super::shape::{put, reserved};
use super::solid::morula_solid;
use crate::cost::{Bounds, Curve, CurveOptions, Goal, Point, StepModel, choose, curve, ladder};
use crate::error::{Error, Result, reserve};
use crate::generate::Levels;
use crate::mass::{Contact, ContactOptions, MassStatus};
use crate::run::Counters;
use crate::solid::Solid;
use std::ffi::c_char;
use std::sync::Arc;

/// A price list: for each number of spheres how good the clump is, how long it took and what a
/// solver pays for it. Made by morula_cost_curve() or morula_sweep_curve(), freed by morula_cost_free().
/// It needs the solid no more.
#[derive(Clone)]
pub struct morula_cost(pub(super) Arc<List>);

/// Shared by the handles of one list.
pub(super) struct List {
    pub points: Vec<Point>,
    clumps: Vec<morula_clump>,
    pub cut: bool,
}

impl morula_cost {
    /// The handle of a curve; `before` is what the calls that made shape and solid did.
    pub(super) fn new(
        made: Curve,
        asked: &Asked,
        surface: bool,
        solid: &Solid,
        before: &Counters,
    ) -> Result<morula_cost> {
        let mut wants = MORULA_WANT_OVERLAP | MORULA_WANT_MOMENTS;
        if surface {
            wants |= MORULA_WANT_SURFACE;
        }
        let mut clumps = reserve("clumps", made.clumps.len())?;
        for one in made.clumps {
            let mut clump = asked.wrap(solid, one, before)?;
            (clump.wants, clump.planes) = (wants, false);
            clumps.push(clump);
        }
        Ok(morula_cost(Arc::new(List { points: made.points, clumps, cut: made.cut })))
    }
}

const _: () = {
    // Const functions may run at the same time on one handle.
    const fn shared<T: Send + Sync>() {}
    shared::<morula_cost>();
};

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_options_init(
    options: *mut morula_cost_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// Fills bounds that bound nothing, with the goal MORULA_GOAL_KNEE.
///
/// Parameters: `size` is sizeof *bounds.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_bounds_init(
    bounds: *mut morula_cost_bounds,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(bounds, size) })
}

fn yes(name: &str, value: i32) -> Result<bool> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Error::InvalidArgument(format!("{name} is {other}, neither 0 nor 1"))),
    }
}

pub(super) unsafe fn wanted(o: &morula_cost_options) -> Result<CurveOptions> {
    let counts = unsafe { slice(o.counts, o.count, "counts")? };
    let number = |n: u64| usize::try_from(n).unwrap_or(usize::MAX);
    let counts = match counts {
        [] => ladder(number(o.most)),
        some => {
            let mut all = reserve("numbers of spheres", some.len())?;
            all.extend(some.iter().map(|&n| number(n)));
            all
        }
    };
    let levels = match o.levels {
        MORULA_LEVELS_FREE => Levels::Free,
        MORULA_LEVELS_CHAINED => Levels::Chained,
        MORULA_LEVELS_NESTED => Levels::Nested,
        other => return Err(Error::InvalidArgument(format!("levels is {other}, no choice"))),
    };
    let contact = if o.contact.is_null() {
        CurveOptions::default().contact
    } else {
        let c = unsafe { read(o.contact)? };
        reserved("contact", c.reserved as i32)?;
        let contact = match c.stiffness {
            0.0 => Contact::Material { young: c.young, poisson: c.poisson },
            stiffness => Contact::Stiffness(stiffness),
        };
        ContactOptions { contact, speed: c.speed, contacts: c.contacts }
    };
    let mut options = CurveOptions {
        counts,
        levels,
        seconds: o.seconds,
        density: o.density,
        contact,
        masses: yes("masses", o.masses)?,
        step: StepModel { step: o.step, lists: o.lists, rebuild: o.rebuild },
        ..CurveOptions::default()
    };
    options.quality.surface = yes("surface", o.surface)?;
    if o.quality_columns > 0 {
        options.quality.columns = o.quality_columns as usize;
    }
    Ok(options)
}

/// Makes the price list of a solid.
///
/// Parameters: `options` says how each clump is made and may be NULL for the defaults; its
/// `spheres`, `mismatch`, `wants` and quality are not read, its deadline is one for the whole list;
/// `cost` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK, also when the deadline passed or the callback cancelled after there
/// was a line (ask morula_cost_cut()); the statuses of morula_clump_from_solid() and
/// morula_clump_timestep() where no line can be made; EMPTY; UNSUPPORTED (levels that the method
/// cannot nest); OUT_OF_MEMORY (at any line). A number of spheres that else fails while others do
/// not is left out.
/// Ownership: the solid stays the caller's and may be freed at once; free *curve with
/// morula_cost_free(). *curve is written only on success.
/// Threads: any thread; the solid is only read. But for seconds the same bytes come out for any
/// number of threads, as long as no deadline is met.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_curve(
    solid: *const morula_solid,
    options: *const super::morula_clump_options,
    cost: *const morula_cost_options,
    curve: *mut *mut morula_cost,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        require(curve, "curve")?;
        let mut wanted = unsafe { wanted(&read(cost)?)? };
        let (asked, run) = unsafe { asked(options)? };
        wanted.generate = asked.generate.clone();
        let made = self::curve(&solid.inner, &wanted, &run)?;
        let surface = wanted.quality.surface;
        let made = morula_cost::new(made, &asked, surface, &solid.inner, &solid.counters)?;
        unsafe { give(curve, made) };
        Ok(())
    })
}

/// How many lines a price list has; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_count(curve: *const morula_cost, count: *mut usize) -> i32 {
    guard(|| {
        let curve = unsafe { borrow(curve, "curve")? };
        unsafe { put(count, curve.0.points.len(), "count") }
    })
}

/// Whether cancel or the deadline ended a price list before its last number of spheres: 0 or 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_cut(curve: *const morula_cost, cut: *mut i32) -> i32 {
    guard(|| {
        let curve = unsafe { borrow(curve, "curve")? };
        unsafe { put(cut, i32::from(curve.0.cut), "cut") }
    })
}

fn line(p: &Point) -> morula_cost_point {
    morula_cost_point {
        struct_size: 0,
        asked: p.asked as u64,
        spheres: p.spheres as u64,
        mismatch: p.mismatch,
        coverage: p.coverage,
        overshoot: p.overshoot,
        surface: p.surface,
        hausdorff: p.hausdorff,
        protrusion: p.protrusion,
        roughness: p.roughness,
        union_inertia: p.union_inertia,
        inertia: p.inertia,
        seconds: p.seconds,
        seconds_so_far: p.seconds_so_far,
        time_step: p.time_step.clump,
        rayleigh: p.time_step.rayleigh.unwrap_or(0.0),
        step_factor: p.step_factor,
        least_radius: p.least_radius,
        step_cost: p.step_cost,
        time_cost: p.time_cost,
        masses: match p.masses {
            None => MORULA_MASSES_NONE,
            Some(MassStatus::Exact) => MORULA_MASSES_EXACT,
            Some(MassStatus::Relaxed) => MORULA_MASSES_RELAXED,
            Some(MassStatus::MassOnly) => MORULA_MASSES_MASS_ONLY,
        },
        stopped: stopped_choice(p.stopped),
    }
}

/// Copies the lines, by the number of spheres.
///
/// Parameters: `points` has room for `capacity` structs, one after the other, all of the size that
/// struct_size of the first says; that of the others is set.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written); STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_copy(
    curve: *const morula_cost,
    capacity: usize,
    points: *mut morula_cost_point,
) -> i32 {
    guard(|| {
        let curve = unsafe { borrow(curve, "curve")? };
        let count = curve.0.points.len();
        unsafe { check(points)? };
        if capacity < count {
            return Err(Error::BufferTooSmall(format!(
                "points has room for {capacity} of {count} lines"
            )));
        }
        check_bytes::<morula_cost_point>(count, "points")?;
        let size = unsafe { points.cast::<usize>().read() };
        for (i, p) in curve.0.points.iter().enumerate() {
            let one = points.cast::<u8>().wrapping_add(i * size).cast::<morula_cost_point>();
            require(one, "points")?;
            unsafe {
                one.cast::<usize>().write(size);
                fill(one, &line(p))?;
            }
        }
        Ok(())
    })
}

/// The clump of a line, with overlap, moments and, where they were wanted, surface.
///
/// Parameters: `index` counts lines from 0.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; OUT_OF_MEMORY.
/// Ownership: free *clump with morula_clump_free(); it lives on without the list. *clump is
/// written only on success.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_clump(
    curve: *const morula_cost,
    index: usize,
    clump: *mut *mut morula_clump,
) -> i32 {
    guard(|| {
        let curve = unsafe { borrow(curve, "curve")? };
        require(clump, "clump")?;
        let of = curve.0.clumps.get(index).ok_or_else(|| {
            Error::IndexOutOfRange(format!(
                "line {index} is not among the {} of the list",
                curve.0.clumps.len()
            ))
        })?;
        let copy = morula_clump {
            inner: of.inner.clone(),
            spheres: of.spheres.clone(),
            wants: of.wants,
            planes: of.planes,
            target: of.target,
        };
        unsafe { give(clump, copy) };
        Ok(())
    })
}

fn bounds(b: &morula_cost_bounds) -> Result<(Bounds, Goal)> {
    reserved("cost bounds", b.reserved)?;
    let goal = match b.goal {
        MORULA_GOAL_KNEE => Goal::Knee,
        MORULA_GOAL_SPHERES => Goal::Spheres,
        MORULA_GOAL_MISMATCH => Goal::Mismatch,
        MORULA_GOAL_SECONDS => Goal::Seconds,
        MORULA_GOAL_STEP_COST => Goal::StepCost,
        MORULA_GOAL_TIME_COST => Goal::TimeCost,
        other => return Err(Error::InvalidArgument(format!("goal is {other}, no choice"))),
    };
    let some = |x: f64| (x != 0.0).then_some(x);
    let spheres = (b.spheres > 0).then(|| usize::try_from(b.spheres).unwrap_or(usize::MAX));
    let bounds = Bounds {
        spheres,
        mismatch: some(b.mismatch),
        coverage: some(b.coverage),
        surface: some(b.surface),
        seconds: some(b.seconds),
        step_cost: some(b.step_cost),
        time_cost: some(b.time_cost),
    };
    Ok((bounds, goal))
}

/// Chooses a line within bounds, and says why in one sentence.
///
/// Parameters: `bounds` may be NULL for the knee: where more spheres stop paying; *index becomes
/// the number of the line; the sentence goes to `text`, which has room for `capacity` bytes;
/// `length` (may be NULL) becomes its length without the closing NUL. With `text` NULL and
/// `capacity` 0 no sentence is copied.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (a bound that is not a number, a goal
/// that is none); NO_SPHERES (no line is within the bounds; the message names the nearest);
/// BUFFER_TOO_SMALL; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_choose(
    curve: *const morula_cost,
    bounds: *const morula_cost_bounds,
    index: *mut usize,
    capacity: usize,
    text: *mut c_char,
    length: *mut usize,
) -> i32 {
    guard(|| {
        let curve = unsafe { borrow(curve, "curve")? };
        require(index, "index")?;
        let (bounds, goal) = self::bounds(&unsafe { read(bounds)? })?;
        let choice = choose(&curve.0.points, &bounds, goal)?;
        if !(capacity == 0 && text.is_null() && length.is_null()) {
            unsafe { copy_text(&choice.why, capacity, text, length)? };
        }
        unsafe { put(index, choice.index, "index") }
    })
}

/// Takes a price list back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_cost_free(curve: *mut morula_cost) {
    unsafe { take(curve) };
}
