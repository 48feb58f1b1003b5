//! Damping along the normal by restitution.
//!
//! A linear dashpot makes a contact pull before it ends. Where that tension is cut off (it is, unless there is cohesion)
//! the rebound is faster than the textbook's e = exp(−π ζ/√(1 − ζ²)), and ends when the force does (Schwager and
//! Pöschel 2007): e = exp(−2 ζ acos ζ / √(1 − ζ²)), with acosh beyond ζ = 1. With s = δ^(5/4) a Hertz contact with the
//! damping of Tsuji et al. (1992), η = α √(m K) δ^(1/4), is that same oscillator with ζ = α/√5, so one function
//! serves both.

use super::Coefficients;
use std::fmt::Debug;

/// A law of damping.
pub(crate) trait Damping: Copy + Debug + Send + Sync + 'static {
    /// Whether there is any.
    const ON: bool;
}

/// None.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Elasticity;

/// By restitution, from the mass that the contact feels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Restitution;

impl Damping for Elasticity {
    const ON: bool = false;
}

impl Damping for Restitution {
    const ON: bool = true;
}

/// Force over speed: `c.damping` √(m F/δ).
#[inline(always)]
pub(crate) fn dashpot(c: &Coefficients, mass: f64, stiffness: f64) -> f64 {
    c.damping * (mass * stiffness).sqrt()
}

/// e of a damping ratio ζ when tension is cut off.
pub fn restitution(ratio: f64) -> f64 {
    let z = ratio;
    // acos ζ / √(1 − ζ²) is smooth about ζ = 1: by its series there.
    let x = 1.0 - z;
    let quotient = if x.abs() < 1e-3 {
        1.0 + x / 3.0 + 2.0 / 15.0 * x * x
    } else if z < 1.0 {
        z.acos() / (1.0 - z * z).sqrt()
    } else {
        z.acosh() / (z * z - 1.0).sqrt()
    };
    (-2.0 * z * quotient).exp()
}

/// The damping ratio that gives a restitution e of 0 to 1; for 0, and below what any contact can be damped to in
/// a sensible number of steps, that of e = 0.01.
pub fn ratio(e: f64) -> f64 {
    let e = e.clamp(0.01, 1.0);
    let (mut lo, mut hi) = (0.0, 64.0);
    for _ in 0..200 {
        let middle = 0.5 * (lo + hi);
        if restitution(middle) > e {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    if e == 1.0 { 0.0 } else { 0.5 * (lo + hi) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ratio_gives_its_restitution() {
        for e in [0.02, 0.1, 0.135, 0.1354, 0.2, 0.5, 0.6, 0.9, 0.999] {
            assert!((restitution(ratio(e)) / e - 1.0).abs() < 1e-9, "{e}");
        }
        assert_eq!(ratio(1.0), 0.0);
        // A dashpot made for 0.6 without the cut-off rebounds with 0.632.
        let z = 0.6f64.ln() / (0.6f64.ln().powi(2) + std::f64::consts::PI.powi(2)).sqrt();
        assert!((restitution(-z) - 0.632).abs() < 5e-4);
        // On both sides of ζ = 1 and across the series' border.
        for z in [0.9985, 0.9995, 1.0005, 1.0015] {
            let slope = (restitution(z + 1e-6) - restitution(z - 1e-6)) / 2e-6;
            assert!((slope + 0.18).abs() < 0.01, "{z}: {slope}");
        }
    }
}
