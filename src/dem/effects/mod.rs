//! The physics that a scene can name, one file for each effect. What is not named does nothing and holds nothing.
//!
//! Laws of contact (normal, damping, tangential, rolling, cohesion) are types that [`super::contact`] composes;
//! effects on bodies are passes outside the loop over contacts.

pub mod averaging;
pub mod cohesion;
pub mod damping;
pub mod drag;
pub mod fragmentation;
pub mod gravity;
pub mod insertion;
pub mod motion;
pub mod normal;
pub mod rolling;
pub mod tangential;
pub mod wear;

use super::contact::Motion;
use super::small::tr_mul;
use crate::error::{Error, Result, figure};
use crate::math::Vec3;

/// What the laws of contact need to know of two materials, resolved once for a scene.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coefficients {
    /// k of a linear spring, or E of Hertz, 1/E = Σ (1 − ν²)/Y.
    pub stiffness: f64,
    /// Stiffness in the plane of contact, or 8 G of Mindlin, 1/G = Σ (2 − ν)/G_i.
    pub shear: f64,
    /// 2 ζ, or α = √5 ζ with Hertz: see [`damping::ratio`].
    pub damping: f64,
    /// Damping in the plane of contact, as a part of that along the normal.
    pub tangential_damping: f64,
    /// μ.
    pub friction: f64,
    /// Force over speed of viscous friction.
    pub viscosity: f64,
    /// μ_r: the couple is at most μ_r R N.
    pub rolling: f64,
    /// Stress of cohesion (force per area), or the work of adhesion (energy per area) of JKR.
    pub cohesion: f64,
}

/// One contact, in the frame of the first body.
pub(crate) struct Touch<'a> {
    /// From the first body to the second.
    pub normal: Vec3,
    /// How deep they are in each other; negative where they are apart.
    pub overlap: f64,
    /// Effective radius.
    pub radius: f64,
    /// The place of contact from the first centre of mass, and from the second.
    pub arms: [Vec3; 2],
    /// Of the second body's matter at that place from the first's.
    pub velocity: Vec3,
    pub coefficients: &'a Coefficients,
    pub motion: &'a Motion,
    pub dt: f64,
    /// The time step, also where springs do not move on.
    pub step: f64,
    /// The most that the two have moved against each other in this step; 0 where contacts do not act by themselves.
    pub stride: f64,
}

impl Touch<'_> {
    /// The velocity in the middle of the step.
    #[inline(always)]
    pub fn half_velocity(&self) -> Vec3 {
        let m = self.motion;
        m.vh + m.wbh.cross(&self.arms[1]) - m.wah.cross(&self.arms[0])
    }

    /// How fast the second body turns from the first.
    #[inline(always)]
    pub fn spin(&self) -> Vec3 {
        self.motion.wb - self.motion.wa
    }

    /// The same in the middle of the step.
    #[inline(always)]
    pub fn half_spin(&self) -> Vec3 {
        self.motion.wbh - self.motion.wah
    }

    /// The mass that the contact feels along its normal: 1/Σ (1/m + (r × n)·I⁻¹(r × n)).
    #[inline(always)]
    pub fn felt_mass(&self) -> f64 {
        let m = self.motion;
        let a = self.arms[0].cross(&self.normal);
        let b = tr_mul(&m.turn, &self.arms[1].cross(&self.normal));
        let turned =
            a.dot(&a.component_mul(&m.inertia[0])) + b.dot(&b.component_mul(&m.inertia[1]));
        let inverse = m.inverse_mass + turned;
        if inverse > 0.0 { 1.0 / inverse } else { 0.0 }
    }
}

impl Coefficients {
    /// Refused: what is not a number of 0 or more.
    pub(crate) fn check(&self, a: usize, b: usize) -> Result<()> {
        for (what, v) in [
            ("stiffness", self.stiffness),
            ("stiffness in the plane", self.shear),
            ("damping", self.damping),
            ("damping in the plane", self.tangential_damping),
            ("friction", self.friction),
            ("viscosity", self.viscosity),
            ("rolling resistance", self.rolling),
            ("cohesion", self.cohesion),
        ] {
            if !(v.is_finite() && v >= 0.0) {
                let v = figure(v);
                return Err(Error::InvalidArgument(format!(
                    "the {what} of materials {a} and {b} is {v}, not a number of 0 or more"
                )));
            }
        }
        Ok(())
    }
}
