//! Exact volume, centroid and inertia of a body.

use crate::error::{Error, Result};
use crate::math::Moments;
use crate::run::Run;
use crate::shape::Body;

/// Moments at unit density in the unit frame: polyhedral integrals for a closed mesh
/// that does not cross itself, columns with a stated error otherwise, sums over cells
/// (each with its own inertia) for voxels.
pub fn moments(body: &Body, run: &Run) -> Result<Moments> {
    let _ = (body, run);
    Err(Error::Internal("moments are not built yet".into()))
}
