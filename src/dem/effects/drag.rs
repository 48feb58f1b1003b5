//! Drag of a fluid around each body, as on a sphere of its radius of gyration: Stokes' and a quadratic part.

use crate::dem::state::State;
use crate::dem::template::Template;
use crate::error::{Error, Result, figure};
use crate::math::Vec3;
use std::f64::consts::PI;

/// A fluid: F = −(6π η R + ½ ρ C π R² |u|) u and T = −8π η R³ ω, with u the velocity in the fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drag {
    /// Dynamic viscosity η.
    pub viscosity: f64,
    /// Density ρ.
    pub density: f64,
    /// Drag coefficient C of the quadratic part.
    pub coefficient: f64,
    /// Velocity of the fluid.
    pub flow: Vec3,
}

impl Drag {
    pub(crate) fn check(&self) -> Result<()> {
        for (what, v) in [
            ("viscosity", self.viscosity),
            ("density", self.density),
            ("drag coefficient", self.coefficient),
        ] {
            if !(v.is_finite() && v >= 0.0) {
                let v = figure(v);
                return Err(Error::InvalidArgument(format!(
                    "the {what} of the fluid is {v}, not a number of 0 or more"
                )));
            }
        }
        if !self.flow.iter().all(|c| c.is_finite()) {
            return Err(Error::NotFinite("the velocity of the fluid is not finite".into()));
        }
        if self.viscosity == 0.0 && self.density * self.coefficient == 0.0 {
            return Err(Error::InvalidArgument(
                "a drag without viscosity or density does nothing".into(),
            ));
        }
        Ok(())
    }
}

/// The radius of the sphere that has the template's radius of gyration.
pub fn radius(t: &Template) -> f64 {
    let [a, b, c] = t.moments();
    (5.0 / 6.0 * (a + b + c) / t.mass()).sqrt()
}

/// Adds the drag to the forces. Velocities are those that the last forces lead to at this time.
pub(crate) fn slow(state: &mut State, d: &Drag) {
    for i in 0..state.len() {
        if state.fixed[i] {
            continue;
        }
        let r = radius(&state.templates[state.template[i] as usize]);
        let (u, w) = (state.kin[i].v - d.flow, state.kin[i].w);
        let quadratic = 0.5 * d.density * d.coefficient * PI * r * r * u.norm();
        state.force[i] -= u * (6.0 * PI * d.viscosity * r + quadratic);
        state.torque[i] -= w * (8.0 * PI * d.viscosity * r.powi(3));
    }
}
