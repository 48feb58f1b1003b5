//! Rolling resistance: a couple against the relative rotation across the normal, a spring and dashpot up to μ_r R N
//! (Luding 2008; Ai et al. 2011, type C), so that it holds at rest without trembling.

use super::Touch;
use super::normal::Elastic;
use super::tangential::turned;
use crate::math::Vec3;
use std::fmt::Debug;

/// A law of rolling resistance.
pub(crate) trait Rolling: Copy + Debug + Send + Sync + 'static {
    /// Whether there is any.
    const ON: bool;
    /// How many numbers a contact remembers.
    const WIDTH: usize;
    /// The couple on the second body.
    fn resist(t: &Touch, e: &Elastic, limit: f64, memory: &mut [f64]) -> Vec3;
    /// What its spring holds.
    fn energy(_: &Elastic, _: &[f64]) -> f64 {
        0.0
    }
}

/// None.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Free;

/// As above; the spring is as stiff as the contact in its plane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Resistance;

/// Damping ratio of its dashpot.
const RATIO: f64 = 0.3;

impl Rolling for Free {
    const ON: bool = false;
    const WIDTH: usize = 0;

    #[inline(always)]
    fn resist(_: &Touch, _: &Elastic, _: f64, _: &mut [f64]) -> Vec3 {
        Vec3::zeros()
    }
}

impl Rolling for Resistance {
    const ON: bool = true;
    const WIDTH: usize = 3;

    #[inline(always)]
    fn resist(t: &Touch, e: &Elastic, limit: f64, memory: &mut [f64]) -> Vec3 {
        let n = &t.normal;
        let speed = t.spin().cross(n) * t.radius;
        let mut stretch = turned(memory, n) + t.half_spin().cross(n) * (t.radius * t.dt);
        let slow = speed * (2.0 * RATIO * (t.motion.mass * e.shear).sqrt());
        let mut force = stretch * -e.shear - slow;
        let (most, size) = (t.coefficients.rolling * limit.max(0.0), force.norm());
        if size > most {
            force *= most / size;
            if e.shear > 0.0 {
                stretch = (force + slow) / -e.shear;
            }
        }
        memory[..3].copy_from_slice(stretch.as_slice());
        n.cross(&force) * t.radius
    }

    fn energy(e: &Elastic, memory: &[f64]) -> f64 {
        let square: f64 = memory[..3].iter().map(|s| s * s).sum();
        0.5 * e.shear * square
    }
}
