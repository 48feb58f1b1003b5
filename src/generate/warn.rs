//! What limits a clump and is no fault of the call, found out and told with its figure.

use super::GenerateOptions;
use crate::clump::{Clump, Limit, Stopped, Warning};
use crate::shape::Body;
use crate::solid::Solid;
use crate::solid::grid::ACROSS_THICKNESS;
use crate::solid::moments::area;
use std::f64::consts::PI;

/// Rounding of places over the size: beyond this nine digits of the shape are not left.
const AWAY: f64 = 1e-9;
/// Error of the target's moments.
const INEXACT: f64 = 1e-4;
/// Error of D over D.
const OVERLAP: f64 = 0.1;
/// Slack of the greatest distances over the equivalent diameter, and over the Hausdorff distance, which
/// the measure promises.
const DISTANCE: f64 = 4e-3;
const OF_DISTANCE: f64 = 1e-2;

/// The limits that a clump meets.
pub(super) fn warnings(solid: &Solid, options: &GenerateOptions, clump: &Clump) -> Vec<Warning> {
    let mut all = Vec::new();
    let mut tell = |limit, figure: f64, bound: f64, met: bool| {
        if met {
            all.push(Warning { limit, figure, bound });
        }
    };
    let (n, asked) = (clump.spheres.len() as f64, options.spheres as f64);
    let short = matches!(clump.stopped, Stopped::Exhausted | Stopped::Radius | Stopped::Deadline);
    tell(Limit::FewerSpheres, n, asked, short && n < asked);
    let noise = solid.frame().noise();
    tell(Limit::FarAway, noise, AWAY, noise > AWAY);
    let moments = solid.unit_moments();
    let off = moments.relative_error;
    tell(Limit::InexactTarget, off, INEXACT, off > INEXACT);
    if let Body::Mesh(mesh) = solid.body() {
        let across = 2.0 * moments.volume / (area(mesh) * solid.grid().spacing.amax());
        // A grid made for the thickness has so many.
        let enough = ACROSS_THICKNESS;
        tell(Limit::Thin, across, enough, across < enough * (1.0 - 1e-9));
    }
    if let Some(q) = &clump.quality {
        let share = if q.mismatch > 0.0 { q.error_bound / q.mismatch } else { 0.0 };
        tell(Limit::CoarseOverlap, share, OVERLAP, share > OVERLAP);
        let size = (6.0 / PI * moments.volume).cbrt() * solid.frame().scale;
        let slack = q.distance_bound / size;
        let poor = slack > DISTANCE && q.distance_bound > OF_DISTANCE * q.hausdorff;
        tell(Limit::CoarseDistance, slack, DISTANCE, poor);
    }
    all
}
