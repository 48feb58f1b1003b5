//! The thresholds, in the unit frame.

use super::super::GenerateOptions;
use crate::solid::Solid;

/// Lengths over the equivalent diameter: how far a kept sphere may be from touching the surface,
/// how near a point must be to one to need no other, how alike spheres of one cluster are.
const TOUCH: f64 = 0.03;
const SATISFIED: f64 = 0.02;
const MERGE: f64 = 0.2;
/// The first also over the radius.
const OF_RADIUS: f64 = 0.15;
/// Part of the points that a sphere must have.
const LEAST: f64 = 0.025;

/// The thresholds of one call.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rules {
    /// Equivalent diameter.
    pub diameter: f64,
    /// Least and greatest radius.
    pub min_radius: f64,
    pub most: f64,
    /// Tolerance of a point's distance from its sphere (section 2.1.2).
    pub satisfied: f64,
    /// T_merge.
    pub merge: f64,
    /// Least number of points of a sphere (section 2.2.1).
    pub least: usize,
    /// What counts as nothing beside the longest distance of four points.
    pub grain: f64,
}

impl Rules {
    pub fn of(solid: &Solid, options: &GenerateOptions, points: usize) -> Rules {
        let volume = solid.unit_moments().volume;
        let diameter = (6.0 * volume / std::f64::consts::PI).cbrt();
        Rules {
            diameter,
            min_radius: (options.min_radius / solid.frame().scale).max(1e-3 * diameter),
            most: diameter,
            satisfied: SATISFIED * diameter,
            merge: MERGE * diameter,
            least: ((LEAST * points as f64) as usize).max(4),
            grain: (8.0 * solid.frame().noise()).max(1e-9),
        }
    }

    /// T_ch: how far a sphere of this radius may be from touching the surface.
    pub fn slack(&self, radius: f64) -> f64 {
        (TOUCH * self.diameter).min(OF_RADIUS * radius)
    }
}
