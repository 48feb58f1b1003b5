//! Elastic repulsion along the normal: a linear spring, or Hertz (1882).

use super::{Coefficients, Touch};
use std::fmt::Debug;

/// What a law says of one contact along its normal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Elastic {
    /// Force that drives the bodies apart.
    pub force: f64,
    /// Force over overlap of the repulsion: what damping goes by.
    pub stiffness: f64,
    /// Stiffness of the contact along its plane.
    pub shear: f64,
    /// What friction feels beside the force: the pull of cohesion.
    pub pull: f64,
}

/// A law of repulsion.
pub(crate) trait Normal: Copy + Debug + Send + Sync + 'static {
    /// At an overlap of two spheres of effective radius `radius`.
    fn push(c: &Coefficients, overlap: f64, radius: f64) -> Elastic;
    /// The work it takes to get there.
    fn energy(c: &Coefficients, overlap: f64, radius: f64) -> f64;
    /// What a contact that lasts for a part t of a step pushes with, over the force after a whole one: ζ(−p, 1) − ζ(−p, 1 + t)
    /// for a force by the overlap to the p. The sum over all steps is then the integral, but for ζ(−p, 1) of that force at
    /// each end, which is the same at both where they part as fast as they met.
    fn begun(part: f64) -> f64;
}

/// The force of a contact that is less than a step old, or ends within the next; `whole` of any other. Leapfrog samples
/// the force at whole steps. Where a spring begins between two of them the sum errs by up to an eighth of
/// what it pushes with after a whole step (Euler–Maclaurin), now up, now down, and an elastic gas keeps that for ever.
#[cold]
pub(crate) fn brief<N: Normal>(t: &Touch, whole: f64) -> f64 {
    let c = t.coefficients;
    let force = |way: f64| {
        if t.overlap >= way {
            return whole;
        }
        N::push(c, way, t.radius).force * N::begun(t.overlap / way)
    };
    let speed = t.half_velocity().dot(&t.normal);
    let held = force(speed.abs() * t.step);
    if speed <= 0.0 {
        return held;
    }
    // They part at the speed after this kick.
    let mass = t.felt_mass();
    if mass > 0.0 { force((speed + held / mass * t.step) * t.step) } else { held }
}

/// A spring of stiffness k: F = k δ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Linear;

/// Elastic spheres: F = 4/3 E √R δ^(3/2), with 1/E = Σ (1 − ν²)/Y.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hertz;

impl Normal for Linear {
    #[inline(always)]
    fn push(c: &Coefficients, overlap: f64, _: f64) -> Elastic {
        Elastic { force: c.stiffness * overlap, stiffness: c.stiffness, shear: c.shear, pull: 0.0 }
    }

    fn energy(c: &Coefficients, overlap: f64, _: f64) -> f64 {
        0.5 * c.stiffness * overlap * overlap
    }

    #[inline(always)]
    fn begun(part: f64) -> f64 {
        0.5 * part * (1.0 + part)
    }
}

impl Normal for Hertz {
    #[inline(always)]
    fn push(c: &Coefficients, overlap: f64, radius: f64) -> Elastic {
        let area = (radius * overlap).sqrt();
        let stiffness = 4.0 / 3.0 * c.stiffness * area;
        Elastic { force: stiffness * overlap, stiffness, shear: c.shear * area, pull: 0.0 }
    }

    fn energy(c: &Coefficients, overlap: f64, radius: f64) -> f64 {
        8.0 / 15.0 * c.stiffness * (radius * overlap).sqrt() * overlap * overlap
    }

    #[inline(always)]
    fn begun(part: f64) -> f64 {
        // A polynomial within 2e-6 of it.
        const C: [f64; 5] = [0.31178, 0.548307, 0.160018, -0.023945, 0.00384];
        part * C.iter().rev().fold(0.0, |sum, c| sum * part + c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The excess of n^-1 Σ ((k + t)/n)^p over the integral, as the sum over n steps has it.
    fn excess(p: f64, t: f64) -> f64 {
        let n = 4000u32;
        let sum: f64 = (0..n).map(|k| (f64::from(k) + t).powf(p)).sum();
        // Up to the last half step: the midpoint rule has no excess there to second order.
        let end = f64::from(n) + t - 0.5;
        let rest = p * end.powf(p - 1.0) / 24.0;
        sum - end.powf(p + 1.0) / (p + 1.0) + rest
    }

    #[test]
    fn what_has_begun_makes_up_for_where_in_a_step_it_did() {
        fn check<N: Normal>(p: f64) {
            assert_eq!(N::begun(0.0), 0.0);
            for k in 1..=10 {
                let t = f64::from(k) / 10.0;
                let exact = t.powf(p) - (excess(p, t) - excess(p, 1.0));
                assert!((N::begun(t) - exact).abs() < 1e-5, "{p} {t}: {} {exact}", N::begun(t));
            }
        }
        check::<Linear>(1.0);
        check::<Hertz>(1.5);
    }
}
