//! The time step that a scene allows, by the library's own figure; with several contacts at once by
//! what they do together.

use super::contact::{DampingLaw, Laws, NormalLaw};
use super::effects::Coefficients;
use super::state::State;
use super::template::Template;
use crate::error::Result;
use crate::error::figure;
use crate::mass::{Body, Contact, ContactOptions, time_step};
use crate::math::{Inertia, PrincipalFrame, Sphere, Vec3};
use nalgebra::Matrix3;

/// The part of the greatest stable step that is advised.
pub const SAFE: f64 = 0.2;

/// What is advised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advice {
    /// Beyond this step a contact gains energy without bound.
    pub limit: f64,
    /// The step that is advised: [`SAFE`] times that.
    pub step: f64,
    /// The template that demands it.
    pub template: u32,
    /// Its sphere, of those handed in.
    pub sphere: u32,
    /// The greatest overlap over the least radius at the speed given.
    pub overlap: f64,
}

/// The template as the room of masses sees a body.
fn body(t: &Template) -> Body {
    let [a, b, c] = t.moments();
    let volume: f64 = t.spheres().iter().map(Sphere::volume).sum();
    Body {
        density: t.mass() / volume,
        volume,
        mass: t.mass(),
        center: Vec3::zeros(),
        inertia: Inertia { xx: a, yy: b, zz: c, ..Inertia::default() },
        principal: PrincipalFrame {
            moments: t.moments(),
            axes: Matrix3::identity(),
            quaternion: [1.0, 0.0, 0.0, 0.0],
        },
        relative_error: 0.0,
    }
}

/// The step for these bodies: two of the worst template that meet with `speed`, in `contacts` contacts at once that push the
/// same way (1 with contact averaging): on as many of its spheres, those that together are stiffest.
///
/// Refused: what [`time_step`] refuses, such as a speed of 0 with Hertz.
pub fn advise(
    laws: &Laws,
    coefficients: &[Coefficients],
    state: &State,
    speed: f64,
    contacts: u32,
) -> Result<Option<Advice>> {
    let stiffest = coefficients.iter().map(|c| c.stiffness).fold(0.0, f64::max);
    // Of one material, 1/E is (1 − ν²)/Y twice: Poisson's ratio is in E already.
    let contact = match laws.normal {
        NormalLaw::Linear => Contact::Stiffness(stiffest),
        NormalLaw::Hertz => Contact::Material { young: 2.0 * stiffest, poisson: 0.0 },
    };
    let contacts = if laws.averaging { 1 } else { contacts };
    let options = ContactOptions { contact, speed, contacts };
    let mut found: Option<Advice> = None;
    for (k, t) in state.templates.iter().enumerate() {
        let own = time_step(t.spheres(), &[], &body(t), &options)?;
        let limit = own.together;
        if found.is_none_or(|f| limit < f.limit) {
            let sphere = t.order().get(own.sphere as usize).copied().unwrap_or(own.sphere);
            found = Some(Advice {
                limit,
                step: SAFE * limit,
                template: k as u32,
                sphere,
                overlap: own.overlap,
            });
        }
    }
    Ok(found)
}

impl Advice {
    /// What to say of a step that is larger than the advice, once.
    pub fn warning(&self, dt: f64, laws: &Laws) -> Option<String> {
        let unstable = dt > self.limit;
        if dt <= self.step * (1.0 + 1e-9) {
            return None;
        }
        let what = if unstable { "is unstable beyond" } else { "is allowed, at most" };
        let damped = if laws.damping == DampingLaw::None { "" } else { ", damping aside" };
        Some(format!(
            "the time step {} is larger than the {} advised; template {} {what} {}{damped}",
            figure(dt),
            figure(self.step),
            self.template,
            figure(self.limit)
        ))
    }
}
