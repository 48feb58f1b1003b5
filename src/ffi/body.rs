//! Weighing clumps: spheres with their masses, and what a solver takes of the whole.

use super::callbacks::run;
use super::choices::*;
use super::clump::morula_clump;
use super::guard::{array_or, borrow, check_bytes, copy_out, give, guard, require, slice, take};
use super::mass_structs::*;
use super::options::{check, fill, init, read};
use super::shape::reserved;
use super::solid::morula_solid;
use crate::error::{Error, Result, collected, reserve};
use crate::mass::{
    Body, Contact, ContactOptions, Infeasible, MassOptions, Masses, Objective, Placement, correct,
    inertia_error, random_orientations, time_step, union_moments,
};
use crate::math::{Moments, PrincipalFrame, Sphere, Vec3};
use crate::run::Run;

/// A weighed clump: its spheres with a mass each, such that all of them, as solid spheres, add up to the
/// mass, centre and inertia of the body. Made by morula_body_from_clump(),
/// morula_body_from_spheres() or morula_body_transform(), freed by morula_body_free().
pub struct morula_body {
    pub(super) body: Body,
    /// Caller's frame.
    pub(super) spheres: Vec<Sphere>,
    pub(super) masses: Masses,
    /// How much less inertia the union has than the target.
    pub(super) lacking: f64,
}

const _: () = {
    // Const functions may run at the same time on one handle.
    const fn shared<T: Send + Sync>() {}
    shared::<morula_body>();
};

struct Asked {
    density: f64,
    union: bool,
    masses: MassOptions,
}

fn no_choice<T>(name: &str, value: i32) -> Result<T> {
    Err(Error::InvalidArgument(format!("{name} is {value}, no choice")))
}

pub(super) fn objective_of(choice: i32) -> Result<Objective> {
    match choice {
        MORULA_OBJECTIVE_EVEN => Ok(Objective::Even),
        MORULA_OBJECTIVE_MAX_MIN => Ok(Objective::MaxMin),
        MORULA_OBJECTIVE_MAX_LAST => Ok(Objective::MaxLast),
        other => no_choice("objective", other),
    }
}

pub(super) fn infeasible_of(choice: i32) -> Result<Infeasible> {
    match choice {
        MORULA_INFEASIBLE_REFUSE => Ok(Infeasible::Refuse),
        MORULA_INFEASIBLE_LEAST_ERROR => Ok(Infeasible::LeastError),
        other => no_choice("infeasible", other),
    }
}

fn asked(o: &morula_mass_options) -> Result<Asked> {
    let union = match o.target {
        MORULA_TARGET_SOLID => false,
        MORULA_TARGET_UNION => true,
        other => return no_choice("target", other),
    };
    let objective = objective_of(o.objective)?;
    let infeasible = infeasible_of(o.infeasible)?;
    // NaN is neither below 0 nor equal to it, and refused where it is read.
    let m_min = if o.m_min < 0.0 { None } else { Some(o.m_min) };
    let m_max = if o.m_max == 0.0 { None } else { Some(o.m_max) };
    let masses = MassOptions { objective, m_min, m_max, infeasible };
    Ok(Asked { density: o.density, union, masses })
}

impl Asked {
    /// `target`: moments at unit density and their frame, where there is a true shape.
    fn weigh(
        &self,
        spheres: Vec<Sphere>,
        target: Option<(Moments, PrincipalFrame)>,
        run: &Run,
    ) -> Result<morula_body> {
        let union = union_moments(&spheres, run)?;
        let (body, lacking) = match target {
            Some((moments, frame)) => {
                (Body::with_frame(&moments, frame, self.density)?, inertia_error(&moments, &union))
            }
            None => (Body::of_moments(&union, self.density)?, 0.0),
        };
        let masses = correct(&spheres, &body, &self.masses, run)?;
        Ok(morula_body { body, spheres, masses, lacking })
    }
}

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_mass_options_init(
    options: *mut morula_mass_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// Weighs the spheres of a clump.
///
/// Parameters: `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK, also where only masses with an error of the inertia exist (ask
/// morula_body_masses()); NULL_POINTER; INVALID_ARGUMENT (an option; bounds of masses that leave no
/// choice; spheres far from the target); NOT_FINITE; STRUCT_SIZE; NOT_WANTED (the clump was made
/// without MORULA_WANT_MOMENTS, and the target is the solid); NO_MASSES (no masses have the centre
/// of the body); TOO_LARGE; CANCELLED; OUT_OF_MEMORY; INTERNAL.
/// Ownership: the clump stays the caller's and may be freed at once; free *body with
/// morula_body_free(). *body is written only on success.
/// Threads: any thread; the clump is only read. The same bytes come out for any number of
/// threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_from_clump(
    clump: *const morula_clump,
    options: *const morula_mass_options,
    body: *mut *mut morula_body,
) -> i32 {
    guard(|| {
        require(body, "body")?;
        let made = unsafe { weighed(clump, options)? };
        unsafe { give(body, made) };
        Ok(())
    })
}

/// The spheres of a clump, weighed.
pub(super) unsafe fn weighed(
    clump: *const morula_clump,
    options: *const morula_mass_options,
) -> Result<morula_body> {
    let clump = unsafe { borrow(clump, "clump")? };
    let o = unsafe { read(options)? };
    let asked = asked(&o)?;
    let run = run(o.threads, o.progress, o.user)?;
    let spheres = collected("spheres", clump.inner.spheres.iter().copied())?;
    asked.weigh(spheres, target_of(clump, asked.union)?, &run)
}

fn target_of(clump: &morula_clump, union: bool) -> Result<Option<(Moments, PrincipalFrame)>> {
    if union {
        return Ok(None);
    }
    if clump.wants & MORULA_WANT_MOMENTS == 0 {
        return Err(Error::NotWanted(
            "MORULA_WANT_MOMENTS was not wanted when the clump was made".into(),
        ));
    }
    let (unit, frame) = &clump.target;
    let mut principal = PrincipalFrame::of_rounded(&unit.inertia, frame.noise());
    let scale = frame.scale.powi(5);
    principal.moments = principal.moments.map(|m| m * scale);
    Ok(Some((frame.moments_to_input(unit), principal)))
}

/// Weighs spheres that were made elsewhere.
///
/// Parameters: `xyzr` holds `count` spheres of four numbers each, in the caller's unit and frame;
/// `solid` is their true shape in the same frame, or NULL for the union of the spheres; `options` may
/// be NULL for the defaults (of a solid, `target` says whose moments are taken).
/// Returns: as morula_body_from_clump(); EMPTY (no sphere); INVALID_ARGUMENT also for a radius that
/// is not above 0.
/// Ownership: inputs are copied; free *body with morula_body_free(). *body is written only on
/// success.
/// Threads: any thread; the solid is only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_from_spheres(
    xyzr: *const f64,
    count: usize,
    solid: *const morula_solid,
    options: *const morula_mass_options,
    body: *mut *mut morula_body,
) -> i32 {
    guard(|| {
        require(body, "body")?;
        let rows = unsafe { slice(xyzr.cast::<[f64; 4]>(), count, "xyzr")? };
        let each = rows.iter().map(|&[x, y, z, r]| Sphere::new(Vec3::new(x, y, z), r));
        let spheres = collected("spheres", each)?;
        let o = unsafe { read(options)? };
        let asked = asked(&o)?;
        let run = run(o.threads, o.progress, o.user)?;
        let target = if solid.is_null() || asked.union {
            None
        } else {
            let solid = unsafe { borrow(solid, "solid")? };
            Some((solid.inner.moments(), solid.inner.principal()))
        };
        let made = asked.weigh(spheres, target, &run)?;
        unsafe { give(body, made) };
        Ok(())
    })
}

/// The same body in another size, place, orientation and density: x becomes position + rotation
/// (scale x). Masses scale by scale^3, inertia by scale^5, both by the ratio of the densities;
/// nothing is solved again.
///
/// Parameters: `position` holds three numbers, or is NULL for 0, 0, 0; `quaternion` holds w, x, y,
/// z of any length but 0, or is NULL for no turn; `density` 0 leaves the body's.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (scale or density not above 0, a
/// quaternion of 0, a size beyond the numbers); NOT_FINITE; OUT_OF_MEMORY; INTERNAL.
/// Ownership: the body stays the caller's; free *placed with morula_body_free(). *placed is
/// written only on success.
/// Threads: any thread; the body is only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_transform(
    body: *const morula_body,
    scale: f64,
    position: *const f64,
    quaternion: *const f64,
    density: f64,
    placed: *mut *mut morula_body,
) -> i32 {
    guard(|| {
        let from = unsafe { borrow(body, "body")? };
        require(placed, "placed")?;
        let to = unsafe { placement(scale, position, quaternion)? };
        let density = if density == 0.0 { from.body.density } else { density };
        let made = from.placed(&to, density)?;
        unsafe { give(placed, made) };
        Ok(())
    })
}

/// Weighs a clump and puts it in another size, place and orientation, as morula_body_from_clump()
/// and morula_body_transform() do. For many particles of one template weigh it once and use those.
///
/// Parameters: `masses` may be NULL for the defaults; its density is that of the particle; the rest as
/// morula_body_transform().
/// Returns: the statuses of morula_body_from_clump() and morula_body_transform().
/// Ownership: the clump stays the caller's; free *placed with morula_body_free(). *placed is
/// written only on success.
/// Threads: any thread; the clump is only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_transform(
    clump: *const morula_clump,
    masses: *const morula_mass_options,
    scale: f64,
    position: *const f64,
    quaternion: *const f64,
    placed: *mut *mut morula_body,
) -> i32 {
    guard(|| {
        require(placed, "placed")?;
        let to = unsafe { placement(scale, position, quaternion)? };
        let from = unsafe { weighed(clump, masses)? };
        let made = from.placed(&to, from.body.density)?;
        unsafe { give(placed, made) };
        Ok(())
    })
}

unsafe fn placement(scale: f64, position: *const f64, quaternion: *const f64) -> Result<Placement> {
    let at = unsafe { array_or(position, [0.0; 3], "position")? };
    let rotation = unsafe { array_or(quaternion, [1.0, 0.0, 0.0, 0.0], "quaternion")? };
    Ok(Placement { scale, rotation, translation: Vec3::from(at) })
}

impl morula_body {
    fn placed(&self, to: &Placement, density: f64) -> Result<morula_body> {
        let old = self.body.density;
        let mut masses = self.masses.clone();
        masses.masses = to.masses(&masses.masses, old, density)?;
        masses.m_min = to.masses(&[masses.m_min], old, density)?.into_iter().sum();
        if let Some(least) = masses.largest_m_min {
            masses.largest_m_min = to.masses(&[least], old, density)?.first().copied();
        }
        Ok(morula_body {
            body: to.body(&self.body, density)?,
            spheres: to.spheres(&self.spheres)?,
            masses,
            lacking: self.lacking,
        })
    }

    unsafe fn timestep(
        &self,
        options: *const morula_contact_options,
        timestep: *mut morula_timestep,
    ) -> Result<()> {
        let o = unsafe { read(options)? };
        reserved("contact", o.reserved as i32)?;
        let contact = if o.stiffness == 0.0 {
            Contact::Material { young: o.young, poisson: o.poisson }
        } else {
            Contact::Stiffness(o.stiffness)
        };
        let asked = ContactOptions { contact, speed: o.speed, contacts: o.contacts };
        let t = time_step(&self.spheres, &self.masses.masses, &self.body, &asked)?;
        let value = morula_timestep {
            struct_size: 0,
            clump: t.clump,
            effective_mass: t.effective_mass,
            stiffness: t.stiffness,
            rayleigh: t.rayleigh.unwrap_or(0.0),
            overlap: t.overlap,
            sphere: t.sphere,
            reserved: 0,
            together: t.together,
        };
        unsafe { fill(timestep, &value) }
    }
}

/// Rotations drawn evenly from all, for the orientations of many particles: the same for the same
/// seed, and the first ones the same for any count.
///
/// Parameters: `quaternions` has room for 4 * `count` numbers: w, x, y, z each, w >= 0.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; TOO_LARGE; OUT_OF_MEMORY.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_random_orientations(
    seed: u64,
    count: usize,
    quaternions: *mut f64,
) -> i32 {
    guard(|| {
        check_bytes::<[f64; 4]>(count, "quaternions")?;
        let drawn = random_orientations(seed, count)?;
        let mut flat = reserve("orientations", count.saturating_mul(4))?;
        flat.extend(drawn.iter().flatten());
        unsafe { copy_out(&flat, flat.len(), quaternions, "quaternions") }
    })
}

/// Takes a body back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_free(body: *mut morula_body) {
    unsafe { take(body) };
}

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_contact_options_init(
    options: *mut morula_contact_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// The time step that a weighed clump allows.
///
/// Parameters: `options` says what is known of its contacts; `timestep` is filled: set its
/// struct_size first. Units are the caller's, mass by those of the density.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INVALID_ARGUMENT (an option out of its
/// range, or figures beyond the numbers).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_timestep(
    body: *const morula_body,
    options: *const morula_contact_options,
    timestep: *mut morula_timestep,
) -> i32 {
    guard(|| {
        let of = unsafe { borrow(body, "body")? };
        require(options, "options")?;
        unsafe {
            check(timestep)?;
            of.timestep(options, timestep)
        }
    })
}

/// Weighs a clump and tells the time step that it allows, as morula_body_from_clump() and
/// morula_body_timestep() do.
///
/// Parameters: `masses` may be NULL for the defaults; `options` and `timestep` as
/// morula_body_timestep().
/// Returns: the statuses of morula_body_from_clump() and morula_body_timestep().
/// Threads: any thread; the clump is only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_timestep(
    clump: *const morula_clump,
    masses: *const morula_mass_options,
    options: *const morula_contact_options,
    timestep: *mut morula_timestep,
) -> i32 {
    guard(|| {
        require(options, "options")?;
        unsafe {
            check(timestep)?;
            weighed(clump, masses)?.timestep(options, timestep)
        }
    })
}
