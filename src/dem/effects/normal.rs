//! Elastic repulsion along the normal: a linear spring, or Hertz (1882).

use super::Coefficients;
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
}
