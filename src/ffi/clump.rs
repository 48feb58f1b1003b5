//! Making clumps.

use super::callbacks::{MORULA_LOG_INFO, log, log_notes, run};
use super::choices::*;
use super::guard::{borrow, give, guard, require, slice, take};
use super::options::{init, read};
use super::shape::{morula_shape, reserved};
use super::solid::{build, morula_solid};
use super::structs::*;
use crate::clump::Clump;
use crate::error::{Error, Result, collected};
use crate::generate::cover::{Candidates, CoverOptions, Ends};
use crate::generate::{
    BestOptions, Effort, GenerateOptions, HalfSpace, Method, Symmetry, generate,
};
use crate::math::{Moments, UnitFrame, Vec3};
use crate::measure::QualityOptions;
use crate::run::{Counters, Run};
use crate::solid::Solid;

/// A clump: spheres and what was measured on them. Made by
/// morula_clump_from_shape() or morula_clump_from_solid(), freed by
/// morula_clump_free(). It needs neither shape nor solid any more.
pub struct morula_clump {
    pub(super) inner: Clump,
    /// In the frame that was asked for.
    pub(super) spheres: Vec<f64>,
    pub(super) wants: u32,
    pub(super) planes: bool,
    /// Moments in the unit frame, and that frame.
    pub(super) target: (Moments, UnitFrame),
}

const _: () = {
    // Const functions may run at the same time on one handle.
    const fn shared<T: Send + Sync>() {}
    shared::<morula_clump>();
};

const ALL_WANTS: u32 = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;

/// The caller's options, checked.
pub(super) struct Asked {
    pub generate: GenerateOptions,
    wants: u32,
    body_frame: bool,
}

/// `count` rows of N numbers.
pub(super) unsafe fn rows<'a, const N: usize>(
    pointer: *const f64,
    count: usize,
    name: &str,
) -> Result<&'a [[f64; N]]> {
    unsafe { slice(pointer.cast::<[f64; N]>(), count, name) }
}

pub(super) unsafe fn half_space_rows(
    pointer: *const f64,
    count: usize,
    name: &str,
) -> Result<Vec<HalfSpace>> {
    let all = unsafe { rows::<4>(pointer, count, name)? };
    let each =
        all.iter().map(|&[x, y, z, offset]| HalfSpace { normal: Vec3::new(x, y, z), offset });
    collected("half-spaces", each)
}

unsafe fn symmetry(o: &morula_clump_options) -> Result<Symmetry> {
    let count = o.symmetry_plane_count as usize;
    if o.symmetry != MORULA_SYMMETRY_PLANES && count > 0 {
        return Err(Error::InvalidArgument(format!(
            "symmetry_plane_count is {count}, but symmetry is not MORULA_SYMMETRY_PLANES"
        )));
    }
    match o.symmetry {
        MORULA_SYMMETRY_NONE => Ok(Symmetry::None),
        MORULA_SYMMETRY_AUTO => Ok(Symmetry::Auto),
        MORULA_SYMMETRY_PLANES => {
            let normals = unsafe { rows::<3>(o.symmetry_planes, count, "symmetry_planes")? };
            let normals = normals.iter().map(|n| Vec3::from(*n));
            Ok(Symmetry::Planes(collected("symmetry planes", normals)?))
        }
        other => Err(Error::InvalidArgument(format!("symmetry is {other}, no choice"))),
    }
}

/// The method of a MORULA_METHOD_*.
pub(super) fn method(value: i32) -> Result<Method> {
    Ok(match value {
        MORULA_METHOD_MSS => Method::Mss,
        MORULA_METHOD_BEST => Method::Best,
        MORULA_METHOD_SURFACE_FIT => Method::SurfaceFit,
        MORULA_METHOD_INSCRIBED => Method::Inscribed,
        MORULA_METHOD_COVER => Method::Cover,
        MORULA_METHOD_PACKED => Method::Packed,
        MORULA_METHOD_EUCLIDEAN => Method::Euclidean,
        MORULA_METHOD_FERELLEC_MCDOWELL => Method::FerellecMcDowell,
        MORULA_METHOD_FAVIER => Method::Favier,
        MORULA_METHOD_UNIFORM_GRID => Method::UniformGrid,
        other => return Err(Error::InvalidArgument(format!("method is {other}, no choice"))),
    })
}

/// The effort of a MORULA_EFFORT_*.
pub(super) fn effort(value: i32) -> Result<Effort> {
    match value {
        MORULA_EFFORT_DRAFT => Ok(Effort::Draft),
        MORULA_EFFORT_NORMAL => Ok(Effort::Normal),
        MORULA_EFFORT_THOROUGH => Ok(Effort::Thorough),
        other => Err(Error::InvalidArgument(format!("effort is {other}, no choice"))),
    }
}

pub(super) unsafe fn asked<'a>(options: *const morula_clump_options) -> Result<(Asked, Run<'a>)> {
    let o = unsafe { read(options)? };
    reserved("clump", o.reserved)?;
    let no_choice = |name: &str, value: i32| {
        Err(Error::InvalidArgument(format!("{name} is {value}, no choice")))
    };
    let (method, effort) = (method(o.method)?, effort(o.effort)?);
    let ends = match o.ends {
        MORULA_ENDS_SURFACE => Ends::Surface,
        MORULA_ENDS_CURVE => Ends::Curve,
        other => return no_choice("ends", other),
    };
    let candidates = match o.candidates {
        MORULA_CANDIDATES_THINNED => Candidates::Thinned,
        MORULA_CANDIDATES_ANALYTIC => Candidates::Analytic,
        other => return no_choice("candidates", other),
    };
    let yes = |name: &str, value: i32| match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Error::InvalidArgument(format!("{name} is {other}, neither 0 nor 1"))),
    };
    let confine = yes("confine", o.confine)?;
    let best = BestOptions {
        overshoot_weight: o.overshoot_weight,
        max_protrusion: o.max_protrusion,
        max_radius: o.max_radius,
        half_spaces: unsafe { half_space_rows(o.half_spaces, o.half_space_count, "half_spaces")? },
        connected: yes("connected", o.connected)?,
        equal_volume: yes("equal_volume", o.equal_volume)?,
        smoothness: o.smoothness,
        symmetry: unsafe { symmetry(&o)? },
    };
    let body_frame = match o.frame {
        MORULA_FRAME_INPUT => false,
        MORULA_FRAME_BODY => true,
        other => return no_choice("frame", other),
    };
    if o.wants & !ALL_WANTS != 0 {
        return Err(Error::InvalidArgument(format!(
            "wants is {}, of which {} is unknown",
            o.wants,
            o.wants & !ALL_WANTS
        )));
    }
    if !(o.deadline_seconds.is_finite() && o.deadline_seconds >= 0.0) {
        return Err(Error::InvalidArgument(format!(
            "deadline_seconds is {}, not a number >= 0",
            o.deadline_seconds
        )));
    }
    let planes = unsafe { slice(o.plane_tolerances, o.plane_tolerance_count, "plane_tolerances")? };
    for (i, t) in planes.iter().enumerate() {
        if !(t.is_finite() && *t >= 0.0) {
            return Err(Error::InvalidArgument(format!(
                "plane tolerance {i} is {t}, not a number >= 0"
            )));
        }
    }
    let mut quality = QualityOptions {
        overlap: o.wants & MORULA_WANT_OVERLAP != 0,
        surface: o.wants & MORULA_WANT_SURFACE != 0,
        plane_tolerances: planes.to_vec(),
        ..QualityOptions::default()
    };
    if o.quality_columns > 0 {
        quality.columns = o.quality_columns as usize;
    }
    let measured = quality.overlap || quality.surface || !planes.is_empty();
    let generate = GenerateOptions {
        method,
        spheres: usize::try_from(o.spheres).unwrap_or(usize::MAX),
        mismatch: o.mismatch,
        min_radius: o.min_radius,
        min_distance: o.min_distance,
        radius_offset: o.radius_offset,
        confine,
        coverage: o.coverage,
        cover: CoverOptions {
            ends,
            candidates,
            thinning_cells: o.thinning_cells,
            cells_inside: o.cells_inside,
        },
        tolerance: o.tolerance,
        overlap: o.overlap,
        effort,
        best,
        quality: measured.then_some(quality),
    };
    let mut run = run(o.threads, o.progress, o.user)?.with_seed(o.seed);
    if o.deadline_seconds > 0.0 {
        run = run.with_deadline(o.deadline_seconds);
    }
    Ok((Asked { generate, wants: o.wants, body_frame }, run))
}

impl Asked {
    /// Makes a clump and tells the log; `before` is what the calls that made shape and solid did.
    fn make(&self, solid: &Solid, run: &Run, before: &Counters) -> Result<morula_clump> {
        let made = self.wrap(solid, generate(solid, &self.generate, run)?, before)?;
        made.log();
        Ok(made)
    }

    /// The handle of a clump.
    pub(super) fn wrap(
        &self,
        solid: &Solid,
        mut inner: Clump,
        before: &Counters,
    ) -> Result<morula_clump> {
        let target = (*solid.unit_moments(), *solid.frame());
        let count = inner.spheres.len().saturating_mul(4);
        let mut spheres = crate::error::reserve("the spheres", count)?;
        let body_frame = self.body_frame.then(|| solid.body_frame());
        for s in &inner.spheres {
            let s = body_frame.as_ref().map_or(*s, |f| f(s));
            spheres.extend([s.center.x, s.center.y, s.center.z, s.radius]);
        }
        inner.counters = before.then(&inner.counters);
        let planes = self.generate.quality.as_ref().is_some_and(|q| !q.plane_tolerances.is_empty());
        Ok(morula_clump { inner, spheres, wants: self.wants, planes, target })
    }
}

impl morula_clump {
    /// Tells the log what was made. Only on the thread that made the call.
    pub(super) fn log(&self) {
        log(MORULA_LOG_INFO, || {
            let c = &self.inner.counters;
            format!(
                "{} in {:.1} ms, stopped by {}",
                crate::error::count(self.inner.spheres.len() as u64, "sphere"),
                1e3 * c.seconds.iter().sum::<f64>(),
                self.inner.stopped.name()
            )
        });
        if !self.inner.note.is_empty() {
            log_notes(std::slice::from_ref(&self.inner.note));
        }
    }
}

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_options_init(
    options: *mut morula_clump_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// Makes a clump of a shape; the solid is made inside. For several clumps of
/// one shape make the solid once and use morula_clump_from_solid().
///
/// Parameters: `solid_options` and `options` may be NULL for the defaults;
/// threads, progress and user are those of `options`.
/// Returns: MORULA_STATUS_OK; the statuses of morula_solid_from_shape() and of
/// morula_clump_from_solid().
/// Ownership: the shape stays the caller's and may be freed at once; free
/// *clump with morula_clump_free(). *clump is written only on success.
/// Threads: any thread; the shape is only read. The same bytes come out for any
/// number of threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_from_shape(
    shape: *const morula_shape,
    solid_options: *const morula_solid_options,
    options: *const morula_clump_options,
    clump: *mut *mut morula_clump,
) -> i32 {
    guard(|| {
        let shape = unsafe { borrow(shape, "shape")? };
        require(clump, "clump")?;
        let solid_options = unsafe { read(solid_options)? };
        let (asked, run) = unsafe { asked(options)? };
        let solid = build(&shape.inner, &solid_options, &run)?;
        let made = asked.make(&solid, &run, &shape.counters)?;
        unsafe { give(clump, made) };
        Ok(())
    })
}

/// Makes a clump of a solid.
///
/// Parameters: `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK, also when the deadline passed or the callback
/// cancelled after there were spheres (ask morula_clump_stopped());
/// NULL_POINTER; INVALID_ARGUMENT (an option); STRUCT_SIZE; CANCELLED (before
/// there was a sphere); NO_SPHERES; ZERO_VOLUME (half-spaces that leave nothing of the body);
/// UNSUPPORTED; TOO_LARGE; MEMORY_LIMIT; OUT_OF_MEMORY; INTERNAL.
/// Ownership: the solid stays the caller's and may be freed at once; free
/// *clump with morula_clump_free(). *clump is written only on success.
/// Threads: any thread; the solid is only read. The same bytes come out for any
/// number of threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_from_solid(
    solid: *const morula_solid,
    options: *const morula_clump_options,
    clump: *mut *mut morula_clump,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        require(clump, "clump")?;
        let (asked, run) = unsafe { asked(options)? };
        let made = asked.make(&solid.inner, &run, &solid.counters)?;
        unsafe { give(clump, made) };
        Ok(())
    })
}

/// Takes a clump back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_free(clump: *mut morula_clump) {
    unsafe { take(clump) };
}
