//! Advice on the time step that a clump allows.

use super::body::Body;
use super::pile::check;
use super::together::together;
use crate::error::{Error, Result, figure};
use crate::math::{Sphere, Vec3};
use std::f64::consts::PI;

/// What resists when two particles touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Contact {
    /// A linear spring of this stiffness (force per length).
    Stiffness(f64),
    /// Elastic spheres (Hertz 1882), both of this material.
    Material {
        /// Young's modulus (force per area).
        young: f64,
        /// Poisson's ratio, −1 to ½, without −1.
        poisson: f64,
    },
}

/// What is known of the contacts of a particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactOptions {
    /// What resists.
    pub contact: Contact,
    /// Greatest speed at which two particles meet.
    pub speed: f64,
    /// How many contacts act on a particle at once, as far as they push the same way; at least 1.
    pub contacts: u32,
}

/// What a clump allows. Three figures that answer three questions; a solver takes a part (a tenth
/// to a fifth) of the first, or of the second where it demands that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStep {
    /// What the rigid clump obeys: beyond √(2 m_c / (N k)) an explicit integration of two equal
    /// clumps that touch in N contacts at their worst points gains energy without bound. m_c is
    /// the mass that is felt at the point of a sphere where pushing turns the clump most easily,
    /// 1 / m_c = 1/M + (p × n)·I⁻¹(p × n).
    pub clump: f64,
    /// The sphere of that point.
    pub sphere: u32,
    /// m_c there.
    pub effective_mass: f64,
    /// k there: the spring's, or that of Hertz at the greatest overlap.
    pub stiffness: f64,
    /// The Rayleigh step π r √(ρ/G) / (0.1631 ν + 0.8766), least over the spheres, each with the
    /// density that its mass gives it: what some codes demand although in a clump no sphere moves
    /// by itself. `None` for a spring, which has no wave speed.
    pub rayleigh: Option<f64>,
    /// The greatest overlap over the least radius when two clumps meet centrally at that speed, in
    /// one contact of their smallest spheres: contact laws hold far below 0.1.
    pub overlap: f64,
    /// The same limit as `clump` where the N contacts push the same way on N spheres, those that are stiffest
    /// together, instead of all at the worst point; never less than `clump`, at most four times as
    /// much, and the same for one contact.
    pub together: f64,
}

/// No limit for contacts on several spheres is more than this times that of all of them at the worst
/// point, so that a fifth of it is stable there, too, at 0.8 of that limit.
const MOST: f64 = 4.0;

/// The time step that `spheres` (caller's frame) with `masses`, together `body`, allow; units are
/// the caller's. Without masses the spheres have the body's density.
///
/// Refused: no sphere, another number of masses than of spheres, a mass, stiffness or modulus that is not
/// above 0, a Poisson's ratio outside −1 to ½, a speed that is negative (or 0 with a material),
/// no contact.
pub fn time_step(
    spheres: &[Sphere],
    masses: &[f64],
    body: &Body,
    options: &ContactOptions,
) -> Result<TimeStep> {
    check(spheres)?;
    check_options(options)?;
    if !(masses.is_empty() || masses.len() == spheres.len()) {
        return Err(Error::InvalidArgument(format!(
            "{} spheres have {} masses",
            spheres.len(),
            masses.len()
        )));
    }
    if let Some((i, m)) = masses.iter().enumerate().find(|(_, m)| !(m.is_finite() && **m > 0.0)) {
        let m = figure(*m);
        return Err(Error::InvalidArgument(format!("mass {i} is {m}, not a number above 0")));
    }
    let (mut least, mut rayleigh) = (f64::MAX, f64::MAX);
    let (mut sphere, mut mass, mut spring) = (0, body.mass, 0.0);
    let own = body.to_body(spheres);
    for (i, s) in own.iter().enumerate() {
        let felt = effective_mass(body, &s.center);
        let k = stiffness(options, body.mass, s.radius);
        let step = (2.0 * felt / (f64::from(options.contacts) * k)).sqrt();
        if step < least {
            (least, sphere, mass, spring) = (step, i as u32, felt, k);
        }
        if let Contact::Material { young, poisson } = options.contact {
            let density = masses.get(i).map_or(body.density, |m| m / s.volume());
            let shear = young / (2.0 * (1.0 + poisson));
            let wave = s.radius * (density / shear).sqrt();
            rayleigh = rayleigh.min(PI * wave / (0.1631 * poisson + 0.8766));
        }
    }
    let together = if options.contacts > 1 && least.is_normal() {
        let spring = |s: &Sphere| stiffness(options, body.mass, s.radius);
        let all = together(&own, body.mass, body.principal.moments, spring, options.contacts);
        least.max(all.min(MOST * least))
    } else {
        least
    };
    let smallest = spheres.iter().map(|s| s.radius).fold(f64::MAX, f64::min);
    let found = TimeStep {
        clump: least,
        sphere,
        effective_mass: mass,
        stiffness: spring,
        rayleigh: matches!(options.contact, Contact::Material { .. }).then_some(rayleigh),
        overlap: depth(options, body.mass, smallest) / smallest,
        together,
    };
    if !(found.clump.is_normal() && found.overlap.is_finite()) {
        return Err(Error::InvalidArgument(format!(
            "a stiffness of {} for a mass of {} is beyond the numbers",
            figure(spring),
            figure(mass)
        )));
    }
    Ok(found)
}

fn check_options(o: &ContactOptions) -> Result<()> {
    let positive = |what: &str, v: f64| {
        if v.is_finite() && v > 0.0 {
            return Ok(());
        }
        let v = figure(v);
        Err(Error::InvalidArgument(format!("the {what} is {v}, not a number above 0")))
    };
    match o.contact {
        Contact::Stiffness(k) => {
            positive("stiffness", k)?;
            if !(o.speed.is_finite() && o.speed >= 0.0) {
                let speed = figure(o.speed);
                return Err(Error::InvalidArgument(format!(
                    "the speed is {speed}, not a number of 0 or more"
                )));
            }
        }
        Contact::Material { young, poisson } => {
            positive("Young's modulus", young)?;
            positive("speed", o.speed)?;
            if !(poisson > -1.0 && poisson <= 0.5) {
                return Err(Error::InvalidArgument(format!(
                    "Poisson's ratio is {}, not between -1 and 0.5",
                    figure(poisson)
                )));
            }
        }
    }
    if o.contacts == 0 {
        return Err(Error::InvalidArgument("the number of contacts is 0".into()));
    }
    Ok(())
}

/// The least mass felt on the surface of a sphere about `c` in the body frame: the normal passes
/// through c, so that its lever is c × n wherever on the sphere. Over all directions n, exposed
/// or not: never more than is felt.
fn effective_mass(body: &Body, c: &Vec3) -> f64 {
    let weights = Vec3::from(body.principal.moments.map(|j| body.mass / j));
    // A push along c turns nothing. Bounded below, so that no division is by 0 whatever is reckoned first.
    let along = c / c.norm().max(f64::MIN_POSITIVE);
    let mut u = Vec3::from_fn(|i, _| f64::from(u8::from(i == along.iamin())));
    u -= along * along.dot(&u);
    u /= u.norm().max(0.5);
    let v = along.cross(&u);
    // The greater eigenvalue of the form of the lever c × n over the plane of the two.
    let [p, q] = [c.cross(&u), c.cross(&v)];
    let [pp, qq, pq] = [(p, p), (q, q), (p, q)].map(|(x, y)| x.dot(&weights.component_mul(&y)));
    let most = 0.5 * (pp + qq) + (0.25 * (pp - qq) * (pp - qq) + pq * pq).sqrt();
    body.mass / (1.0 + most)
}

/// Modulus and radius of two equal spheres of a material.
fn hertz(young: f64, poisson: f64, radius: f64) -> (f64, f64) {
    // Bounded: the compiler reckons it also where a spring is given and no Poisson's ratio.
    (0.5 * young / (1.0 - poisson * poisson).max(1e-12), 0.5 * radius)
}

/// The greatest overlap of two clumps of mass `mass` that meet centrally in one contact.
fn depth(o: &ContactOptions, mass: f64, radius: f64) -> f64 {
    let reduced = 0.5 * mass;
    match o.contact {
        Contact::Stiffness(k) => o.speed * (reduced / k).sqrt(),
        Contact::Material { young, poisson } => {
            let (e, r) = hertz(young, poisson, radius);
            // ½ m v² = 8/15 E √R δ^(5/2)
            (15.0 / 16.0 * (reduced / (e * r.sqrt())) * o.speed * o.speed).powf(0.4)
        }
    }
}

/// The stiffness at that overlap, dF/dδ.
fn stiffness(o: &ContactOptions, mass: f64, radius: f64) -> f64 {
    match o.contact {
        Contact::Stiffness(k) => k,
        Contact::Material { young, poisson } => {
            let (e, r) = hertz(young, poisson, radius);
            2.0 * e * (r * depth(o, mass, radius)).sqrt()
        }
    }
}

#[cfg(test)]
#[path = "timestep_tests.rs"]
mod tests;
