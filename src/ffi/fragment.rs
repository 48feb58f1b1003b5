//! Breaking parents, and what takes their place.

use super::body::{infeasible_of, objective_of};
use super::callbacks::{log_notes, run};
use super::choices::*;
use super::clump::{half_space_rows, rows};
use super::clumps::{give_all, room};
use super::fragment_structs::*;
use super::guard::{borrow, give, guard, require, slice, take};
use super::options::{check, fill, init, read, read_all};
use super::parent::{held_struct, morula_parent, state};
use crate::error::{Error, Result, collected, reserve};
use crate::fragment::{
    Cut, CutOptions, Held, Parent, ParentMap, ReclumpOptions, ShatterOptions, Shattered, shatter,
};
use crate::generate::each;
use crate::mass::MassOptions;
use crate::math::{Inertia, Vec3};
use crate::run::Run;
use std::sync::{Arc, OnceLock};

/// The fragments of one break, and its dust. Made by morula_parent_break(), morula_parents_break(),
/// morula_fragments_from_labels(), morula_reclump_shape() or morula_fragments_deserialize(), freed by
/// morula_fragments_free(). It does not need the handle of its parent any more.
pub struct morula_fragments {
    /// One for all fragments, or one for each.
    pub(super) parents: Vec<Arc<Parent>>,
    pub(super) held: Held,
    pub(super) found: Shattered,
    /// The radii of least mismatch of each fragment, once they were asked for.
    pub(super) grown: Vec<OnceLock<Vec<f64>>>,
}

const _: () = {
    // Const functions may run at the same time on one handle.
    const fn shared<T: Send + Sync>() {}
    shared::<morula_fragments>();
};

/// The body of fragment `index` (from 0) as the solver holds it now, for it to break again.
///
/// Parameters: `position`, `quaternion`, `velocity` and `angular_velocity` as
/// morula_parent_held(), the quaternion that of the fragment's body axes; NULL: as they were handed
/// over. `held` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INDEX_OUT_OF_RANGE; INVALID_ARGUMENT (a
/// quaternion of 0); NOT_FINITE (a number of position, quaternion and velocities).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_held(
    fragments: *const morula_fragments,
    index: usize,
    position: *const f64,
    quaternion: *const f64,
    velocity: *const f64,
    angular_velocity: *const f64,
    held: *mut morula_held,
) -> i32 {
    guard(|| {
        let all = unsafe { borrow(fragments, "fragments")? };
        let m = &all.at(index)?.moving;
        unsafe { check(held)? };
        let mut of = Held {
            mass: m.mass,
            center: m.center,
            inertia: m.inertia,
            position: m.position,
            velocity: m.velocity,
            angular_velocity: m.angular_velocity,
            ..all.held
        };
        let axes = m.principal.quaternion;
        unsafe {
            state(&mut of, axes, position, quaternion, velocity, angular_velocity)?;
            fill(held, &held_struct(&of))
        }
    })
}

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_break_options_init(
    options: *mut morula_break_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// What is asked of one break.
pub(super) struct Asked {
    pub(super) cut: Cut,
    pub(super) options: ShatterOptions,
    seed: u64,
}

unsafe fn cut_of(o: &morula_break_options) -> Result<Cut> {
    let planes = || unsafe { half_space_rows(o.half_spaces, o.half_space_count, "half_spaces") };
    let count = usize::try_from(o.cells).unwrap_or(usize::MAX);
    Ok(match o.kind {
        MORULA_CUT_PLANES => Cut::Planes(planes()?),
        MORULA_CUT_WITHIN => Cut::Within(planes()?),
        MORULA_CUT_POINTS => {
            let points = unsafe { rows::<3>(o.points, o.point_count, "points")? };
            let weights = match o.weights.is_null() {
                true => &[][..],
                false => unsafe { slice(o.weights, o.point_count, "weights")? },
            };
            Cut::Points {
                points: collected("points", points.iter().map(|p| Vec3::from(*p)))?,
                weights: collected("weights", weights.iter().copied())?,
            }
        }
        MORULA_CUT_SEEDED => Cut::Seeded { count },
        MORULA_CUT_IMPACT => {
            Cut::Impact { point: o.point.into(), direction: o.direction.into(), count }
        }
        other => return Err(Error::InvalidArgument(format!("kind is {other}, no choice"))),
    })
}

pub(super) unsafe fn asked(o: &morula_break_options) -> Result<Asked> {
    let yes = |name: &str, value: i32| match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Error::InvalidArgument(format!("{name} is {other}, neither 0 nor 1"))),
    };
    let single = match o.precision {
        MORULA_PRECISION_F64 => false,
        MORULA_PRECISION_F32 => true,
        other => return Err(Error::InvalidArgument(format!("precision is {other}, no choice"))),
    };
    if !(o.deadline_seconds.is_finite() && o.deadline_seconds >= 0.0) {
        return Err(Error::InvalidArgument(format!(
            "deadline_seconds is {}, not a number >= 0",
            o.deadline_seconds
        )));
    }
    // NaN is not below 0, and refused where it is read.
    let m_min = if o.m_min < 0.0 { None } else { Some(o.m_min) };
    let masses = MassOptions {
        objective: objective_of(o.objective)?,
        infeasible: infeasible_of(o.infeasible)?,
        m_min,
        m_max: None,
    };
    let reclump = ReclumpOptions {
        spheres: usize::try_from(o.spheres).unwrap_or(usize::MAX),
        min_radius: o.min_radius,
        gap: o.gap,
        union: yes("within_union", o.within_union)?,
        walls: unsafe { half_space_rows(o.walls, o.wall_count, "walls")? },
        single,
        quality: yes("quality", o.quality)?,
    };
    let options = ShatterOptions {
        cut: CutOptions { least_volume: o.least_volume },
        reclump,
        masses: yes("masses", o.masses)?.then_some(masses),
    };
    Ok(Asked { cut: unsafe { cut_of(o)? }, options, seed: o.seed })
}

pub(super) fn run_of<'a>(o: &morula_break_options) -> Result<Run<'a>> {
    let run = run(o.threads, o.progress, o.user)?.with_seed(o.seed);
    Ok(match o.deadline_seconds > 0.0 {
        true => run.with_deadline(o.deadline_seconds),
        false => run,
    })
}

pub(super) fn held_of(h: &morula_held) -> Held {
    let [xx, yy, zz, xy, xz, yz] = h.inertia;
    Held {
        mass: h.mass,
        center: h.centre.into(),
        inertia: Inertia { xx, yy, zz, xy, xz, yz },
        scale: h.scale,
        position: h.position.into(),
        rotation: h.quaternion,
        velocity: h.velocity.into(),
        angular_velocity: h.angular_velocity.into(),
    }
}

/// What breaks: a parent, or a fragment of an earlier break.
struct Broken<'a> {
    parent: &'a Arc<Parent>,
    from: Option<(&'a morula_fragments, usize)>,
}

unsafe fn broken<'a>(
    parent: *const morula_parent,
    from: *const morula_fragments,
    index: usize,
) -> Result<Broken<'a>> {
    if from.is_null() {
        let parent = unsafe { borrow(parent, "parent")? };
        return Ok(Broken { parent: &parent.inner, from: None });
    }
    let from = unsafe { borrow(from, "from")? };
    from.at(index)?;
    if !parent.is_null() {
        let parent = unsafe { borrow(parent, "parent")? };
        if !Arc::ptr_eq(&parent.inner, from.parent_of(index)?) {
            return Err(Error::InvalidArgument("the fragment is of another parent".into()));
        }
    }
    Ok(Broken { parent: from.parent_of(index)?, from: Some((from, index)) })
}

impl Broken<'_> {
    fn break_up(&self, held: &Held, asked: &Asked, run: &Run) -> Result<morula_fragments> {
        let from = match self.from {
            Some((from, index)) => Some(from.at(index)?),
            None => None,
        };
        let region = from.map(|f| &f.region);
        let mut found = shatter(self.parent, region, held, &asked.cut, &asked.options, run)?;
        if let Some(from) = from {
            // The spheres that touched something were the fragment's.
            for f in &mut found.fragments {
                f.clump.map = ParentMap::between(&from.clump.spheres, &f.clump.spheres)?;
            }
        }
        wrap(vec![Arc::clone(self.parent)], held, found)
    }
}

pub(super) fn wrap(
    parents: Vec<Arc<Parent>>,
    held: &Held,
    mut found: Shattered,
) -> Result<morula_fragments> {
    for (i, f) in found.fragments.iter().enumerate() {
        if !f.no_masses.is_empty() {
            found.notes.push(format!("fragment {i} has no masses: {}", f.no_masses));
        }
    }
    let mut grown = reserve("fragments", found.fragments.len())?;
    grown.resize_with(found.fragments.len(), OnceLock::new);
    Ok(morula_fragments { parents, held: *held, found, grown })
}

/// Breaks a particle, or a fragment of an earlier break, in one call: cuts it, fills the pieces with
/// spheres, and hands mass, place and velocities over, so that mass, momentum and angular momentum
/// of fragments and dust are those of the held body.
///
/// No sphere crosses a cut, the surface, or a wall, and none of two fragments overlap; in the world
/// that holds to rounding. A fragment that breaks again is cut out of the first parent anew.
///
/// Parameters: `from` is NULL for the whole parent; else fragment `index` (from 0) of `from` breaks,
/// and `parent` is its parent or NULL; `held` is the body as the solver holds it; `options` may be
/// NULL for the defaults.
/// Returns: MORULA_STATUS_OK, also when the deadline passed: then the spheres are coarse;
/// NULL_POINTER; INVALID_ARGUMENT (an option, a plane; the held body; a fragment of another parent);
/// STRUCT_SIZE; NOT_FINITE (a point, a wall, the held body); INDEX_OUT_OF_RANGE; NO_SPHERES (no
/// piece holds one); ZERO_VOLUME; EMPTY (nothing is left); TOO_LARGE; MEMORY_LIMIT; CANCELLED;
/// UNSUPPORTED; OUT_OF_MEMORY; INTERNAL.
/// Ownership: all inputs stay the caller's and may be freed at once; free *fragments with
/// morula_fragments_free(). *fragments is written only on success.
/// Threads: any thread; parent and fragments are only read. The same bytes come out for any number
/// of threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_parent_break(
    parent: *const morula_parent,
    from: *const morula_fragments,
    index: usize,
    held: *const morula_held,
    options: *const morula_break_options,
    fragments: *mut *mut morula_fragments,
) -> i32 {
    guard(|| {
        require(fragments, "fragments")?;
        require(held, "held")?;
        let broken = unsafe { broken(parent, from, index)? };
        let held = held_of(&unsafe { read(held)? });
        let o = unsafe { read(options)? };
        let asked = unsafe { asked(&o)? };
        let made = broken.break_up(&held, &asked, &run_of(&o)?)?;
        log_notes(&made.found.notes);
        unsafe { give(fragments, made) };
        Ok(())
    })
}

/// Breaks all particles that break in one time step. Threads share them, one each; each break is,
/// byte for byte, what morula_parent_break() gives, and one that fails does not stop the others.
///
/// Parameters: `count` breaks; `parents` holds a handle each; `from` a handle or NULL each, with
/// `indices`, or both are NULL: whole parents break; `held` holds a struct each, one after another;
/// `options` too, of which the first one's threads, deadline, progress and user are those of the
/// call; NULL: the defaults. `fragments` has room for `count` handles, and `statuses`, which may be
/// NULL, for `count` statuses, in the same order.
/// Returns: MORULA_STATUS_OK; the statuses of morula_parent_break(), of the first break that
/// failed. Then, with `statuses`, both arrays are written all the same, with NULL for each break
/// that failed, and the log is told each failure; without, none is written. Arrays that cannot be
/// read fail as a whole.
/// Ownership: as morula_parent_break().
/// Threads: as morula_parent_break().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_parents_break(
    parents: *const *const morula_parent,
    from: *const *const morula_fragments,
    indices: *const usize,
    held: *const morula_held,
    options: *const morula_break_options,
    count: usize,
    fragments: *mut *mut morula_fragments,
    statuses: *mut i32,
) -> i32 {
    guard(|| {
        room(count, fragments, "fragments", statuses)?;
        let parents = unsafe { slice(parents, count, "parents")? };
        let some = if from.is_null() { 0 } else { count };
        let from = unsafe { slice(from, some, "from")? };
        let indices = unsafe { slice(indices, some, "indices")? };
        let held = unsafe { read_all(held, count)? };
        let options = match options.is_null() {
            true => Vec::new(),
            false => unsafe { read_all(options, count)? },
        };
        let default = unsafe { read(std::ptr::null::<morula_break_options>())? };
        let option = |k: usize| options.get(k).unwrap_or(&default);
        let mut jobs = reserve("breaks", count)?;
        for (k, (&parent, held)) in parents.iter().zip(&held).enumerate() {
            let from = from.get(k).copied().unwrap_or(std::ptr::null());
            let index = indices.get(k).copied().unwrap_or(0);
            // What fails here is one break's own failure.
            let job = unsafe {
                broken(parent, from, index)
                    .and_then(|broken| Ok((broken, held_of(held), asked(option(k))?)))
            };
            jobs.push(job);
        }
        let run = run_of(option(0))?;
        let made = each(count, &run, |k, run| match &jobs[k] {
            Ok((broken, held, asked)) => {
                broken.break_up(held, asked, &run.part().run().with_seed(asked.seed))
            }
            Err(e) => Err(e.clone()),
        });
        unsafe { give_all("break", made, fragments, statuses, |f| log_notes(&f.found.notes)) }
    })
}

/// Takes fragments back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_free(fragments: *mut morula_fragments) {
    unsafe { take(fragments) };
}
