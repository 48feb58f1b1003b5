//! Friction: none, viscous, and springs with a history.
//!
//! A history is kept in the frame of the first body, turned into the plane of contact at every step with its length
//! kept, and moved by the velocities in the middle of the step, as the positions are: a spring that is loaded and unloaded
//! gives back what it took.

use super::normal::Elastic;
use super::{Coefficients, Touch};
use crate::math::Vec3;
use std::fmt::Debug;

/// A law of friction.
pub(crate) trait Tangential: Copy + Debug + Send + Sync + 'static {
    /// Whether there is any.
    const ON: bool;
    /// How many numbers a contact remembers.
    const WIDTH: usize;
    /// The force on the second body in the plane of contact. `limit` is the force that presses, `dashpot` the damping
    /// along the normal.
    fn hold(t: &Touch, e: &Elastic, limit: f64, dashpot: f64, memory: &mut [f64]) -> Vec3;
    /// What its spring holds.
    fn energy(_: &Coefficients, _: &Elastic, _: &[f64]) -> f64 {
        0.0
    }
}

/// None.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Smooth;

/// min(γ v, μ N) against the sliding, no memory.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Viscous;

/// Mindlin with history: a spring of displacement, k = 8 G √(R δ) with Hertz, up to μ N; with a
/// linear law of constant stiffness (Cundall and Strack 1979).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spring;

/// Hertz–Mindlin no-slip (Di Renzo and Di Maio 2004): increments of the force, 8 G √(R δ) Δs, up to μ N;
/// the force shrinks with the contact's radius when that does.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NoSlip;

impl Tangential for Smooth {
    const ON: bool = false;
    const WIDTH: usize = 0;

    #[inline(always)]
    fn hold(_: &Touch, _: &Elastic, _: f64, _: f64, _: &mut [f64]) -> Vec3 {
        Vec3::zeros()
    }
}

impl Tangential for Viscous {
    const ON: bool = true;
    const WIDTH: usize = 0;

    #[inline(always)]
    fn hold(t: &Touch, _: &Elastic, limit: f64, _: f64, _: &mut [f64]) -> Vec3 {
        let v = t.velocity;
        let f = (v - t.normal * v.dot(&t.normal)) * -t.coefficients.viscosity;
        let (most, size) = (t.coefficients.friction * limit.max(0.0), f.norm());
        if size > most { f * (most / size) } else { f }
    }
}

/// A vector remembered, turned into the plane of contact.
#[inline(always)]
pub(crate) fn turned(memory: &[f64], n: &Vec3) -> Vec3 {
    let old = Vec3::new(memory[0], memory[1], memory[2]);
    let flat = old - n * old.dot(n);
    let (a, b) = (old.norm_squared(), flat.norm_squared());
    if b > 0.0 { flat * (a / b).sqrt() } else { flat }
}

impl Tangential for Spring {
    const ON: bool = true;
    const WIDTH: usize = 3;

    #[inline(always)]
    fn hold(t: &Touch, e: &Elastic, limit: f64, dashpot: f64, memory: &mut [f64]) -> Vec3 {
        let n = &t.normal;
        let (v, vh) = (t.velocity, t.half_velocity());
        let v = v - n * v.dot(n);
        let mut stretch = turned(memory, n) + (vh - n * vh.dot(n)) * t.dt;
        let slow = v * (dashpot * t.coefficients.tangential_damping);
        let mut force = stretch * -e.shear - slow;
        let (most, size) = (t.coefficients.friction * limit.max(0.0), force.norm());
        if size > most {
            force *= most / size;
            if e.shear > 0.0 {
                stretch = (force + slow) / -e.shear;
            }
        }
        memory[..3].copy_from_slice(stretch.as_slice());
        force
    }

    fn energy(_: &Coefficients, e: &Elastic, memory: &[f64]) -> f64 {
        let square: f64 = memory[..3].iter().map(|s| s * s).sum();
        0.5 * e.shear * square
    }
}

impl Tangential for NoSlip {
    const ON: bool = true;
    const WIDTH: usize = 4;

    #[inline(always)]
    fn hold(t: &Touch, e: &Elastic, limit: f64, dashpot: f64, memory: &mut [f64]) -> Vec3 {
        let n = &t.normal;
        let (v, vh) = (t.velocity, t.half_velocity());
        let v = v - n * v.dot(n);
        let mut spring = turned(memory, n);
        let before = memory[3];
        if e.shear < before {
            spring *= e.shear / before;
        }
        spring -= (vh - n * vh.dot(n)) * (e.shear * t.dt);
        let slow = v * (dashpot * t.coefficients.tangential_damping);
        let mut force = spring - slow;
        let (most, size) = (t.coefficients.friction * limit.max(0.0), force.norm());
        if size > most {
            force *= most / size;
            spring = force + slow;
        }
        memory[..3].copy_from_slice(spring.as_slice());
        memory[3] = e.shear;
        force
    }

    fn energy(_: &Coefficients, e: &Elastic, memory: &[f64]) -> f64 {
        let square: f64 = memory[..3].iter().map(|f| f * f).sum();
        if e.shear > 0.0 { 0.5 * square / e.shear } else { 0.0 }
    }
}
