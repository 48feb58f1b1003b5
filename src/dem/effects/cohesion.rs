//! Cohesion: a stress on the area of contact, or JKR (Johnson, Kendall and Roberts 1971).

use super::Coefficients;
use super::normal::Elastic;
use std::f64::consts::PI;
use std::fmt::Debug;

/// A law of cohesion.
pub(crate) trait Cohesion: Copy + Debug + Send + Sync + 'static {
    /// Whether there is any.
    const ON: bool;
    /// How many numbers a contact remembers.
    const WIDTH: usize;
    /// Whether a contact may last beyond touching.
    const FAR: bool;
    /// The repulsion `e` with the pull; `None` where the contact has ended.
    fn pull(
        c: &Coefficients,
        overlap: f64,
        radius: f64,
        e: Elastic,
        memory: &mut [f64],
    ) -> Option<Elastic>;
    /// How much energy it takes off that of the repulsion, `elastic`.
    fn energy(c: &Coefficients, overlap: f64, radius: f64, elastic: f64) -> f64;
}

/// None.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dry;

/// A stress on the area 2π R δ in which the spheres cut each other: F = −2π R σ δ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stress;

/// JKR: with w the work of adhesion per area, the contact comes about at δ = 0, lasts down to
/// δ = −¾ (π² w² R/E²)^(1/3) and pulls with at most 3/2 π w R.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jkr;

impl Cohesion for Dry {
    const ON: bool = false;
    const WIDTH: usize = 0;
    const FAR: bool = false;

    #[inline(always)]
    fn pull(_: &Coefficients, _: f64, _: f64, e: Elastic, _: &mut [f64]) -> Option<Elastic> {
        Some(e)
    }

    fn energy(_: &Coefficients, _: f64, _: f64, elastic: f64) -> f64 {
        elastic
    }
}

impl Cohesion for Stress {
    const ON: bool = true;
    const WIDTH: usize = 0;
    const FAR: bool = false;

    #[inline(always)]
    fn pull(
        c: &Coefficients,
        overlap: f64,
        radius: f64,
        e: Elastic,
        _: &mut [f64],
    ) -> Option<Elastic> {
        let pull = 2.0 * PI * radius * c.cohesion * overlap;
        Some(Elastic { force: e.force - pull, pull, ..e })
    }

    fn energy(c: &Coefficients, overlap: f64, radius: f64, elastic: f64) -> f64 {
        elastic - PI * radius * c.cohesion * overlap * overlap
    }
}

/// How far beyond touching a JKR contact lasts.
pub fn jkr_range(work: f64, modulus: f64, radius: f64) -> f64 {
    let a = PI * work / modulus;
    0.75 * (a * a * radius).cbrt()
}

/// The radius of a JKR contact: the greater root of a²/R − √(2π w a/E) = δ. From above, by Newton steps on
/// s = √a, where s⁴/R − b s − δ is convex.
fn jkr_radius(c: &Coefficients, overlap: f64, radius: f64) -> f64 {
    let b = (2.0 * PI * c.cohesion / c.stiffness).sqrt();
    // Above the root: s³ ≥ b R and s⁴ ≥ R δ, together.
    let mut s = (b * radius).cbrt() + (radius * overlap.max(0.0)).sqrt().sqrt();
    for _ in 0..60 {
        let cube = s * s * s / radius;
        let slope = 4.0 * cube - b;
        if slope <= 0.0 {
            break;
        }
        let step = (cube * s - b * s - overlap) / slope;
        s -= step;
        if step.abs() <= 1e-15 * s {
            break;
        }
    }
    s * s
}

impl Cohesion for Jkr {
    const ON: bool = true;
    const WIDTH: usize = 1;
    const FAR: bool = true;

    #[inline(always)]
    fn pull(
        c: &Coefficients,
        overlap: f64,
        radius: f64,
        _: Elastic,
        memory: &mut [f64],
    ) -> Option<Elastic> {
        if overlap < 0.0
            && (memory[0] == 0.0 || overlap < -jkr_range(c.cohesion, c.stiffness, radius))
        {
            return None;
        }
        memory[0] = 1.0;
        let a = jkr_radius(c, overlap, radius);
        let (e, w) = (c.stiffness, c.cohesion);
        let force = 4.0 / 3.0 * e * a * a * a / radius - (8.0 * PI * w * e * a * a * a).sqrt();
        // Friction feels what presses the surfaces together: twice the pull-off (Thornton 1991).
        let pull = 3.0 * PI * w * radius;
        Some(Elastic { force, stiffness: 4.0 / 3.0 * e * a, shear: c.shear * a, pull })
    }

    fn energy(c: &Coefficients, overlap: f64, radius: f64, _: f64) -> f64 {
        // ∫ F dδ along the branch of equilibrium from a = 0.
        let (e, w, a) = (c.stiffness, c.cohesion, jkr_radius(c, overlap, radius));
        8.0 / 15.0 * e * a.powi(5) / (radius * radius)
            - 4.0 / 3.0 * (2.0 * PI * w * e).sqrt() * a.powf(3.5) / radius
            + PI * w * a * a
    }
}
