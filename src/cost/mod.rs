//! What accuracy costs in time: the price list of one particle, and a choice from it.
//!
//! A [`curve`] has, for each number of spheres, how good the clump is, how long it takes to make,
//! and what a solver pays for it: the time step that it allows, and the cost of a step by a stated
//! model ([`StepModel`]). [`choose`] picks a point within bounds and says why. A [`sweep`] makes
//! curves over methods, resolutions and deadlines.

mod choose;
mod curve;
mod step;
mod sweep;

pub use choose::{Bounds, Choice, Goal, choose};
pub use curve::{Curve, CurveOptions, Point, curve, ladder};
pub use step::StepModel;
pub use sweep::{SweepOptions, Swept, sweep, sweep_each};
