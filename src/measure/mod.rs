//! How far a clump is from its solid, independent of the grid that made it.

use crate::error::{Error, Result};
use crate::math::Sphere;
use crate::run::Run;
use crate::solid::Solid;

/// What is measured, and how finely.
#[derive(Debug, Clone, PartialEq)]
pub struct QualityOptions {
    /// Columns along each of the two sampled axes.
    pub columns: usize,
    /// D, η, IoU, coverage, overshoot, and the union's volume, centroid and principal moments.
    pub overlap: bool,
    /// Greatest protrusion, RMS and Hausdorff surface distance, roughness, exposed areas.
    pub surface: bool,
    /// Most spheres that one plane touches within δ, for each of these δ (caller's unit).
    pub plane_tolerances: Vec<f64>,
}

impl Default for QualityOptions {
    fn default() -> Self {
        QualityOptions { columns: 256, overlap: true, surface: true, plane_tolerances: Vec::new() }
    }
}

/// The quality of a clump. Lengths, areas and volumes in the caller's unit.
/// What was not asked for is 0 or empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Quality {
    /// D = 1 − 2|S∩C| / (|S|+|C|) (paper 002, eq 27).
    pub mismatch: f64,
    /// η = |S△C| / |S| (paper 002, eq 7).
    pub eta: f64,
    /// |S∩C| / |S∪C|.
    pub iou: f64,
    /// |S∩C| / |S|.
    pub coverage: f64,
    /// |C∖S| / |S|.
    pub overshoot: f64,
    /// Bound on the error of D from the sampling of two axes.
    pub error_bound: f64,
    /// Volume of the target by the same columns.
    pub target_volume: f64,
    /// Volume of the union.
    pub union_volume: f64,
    /// Union volume over target volume, less one.
    pub volume_error: f64,
    /// Distance between the centroids over the equivalent diameter.
    pub centroid_error: f64,
    /// Each principal moment of the union over the target's, less one.
    pub moment_errors: [f64; 3],
    /// How far the union reaches beyond the surface.
    pub protrusion: f64,
    /// RMS distance between the two surfaces.
    pub rms_distance: f64,
    /// Hausdorff distance between the two surfaces.
    pub hausdorff: f64,
    /// RMS angle between the normals of clump and target, radians.
    pub roughness: f64,
    /// Most spheres that one plane touches within δ, for each δ asked for.
    pub plane_contacts: Vec<u32>,
    /// Exposed area of each sphere.
    pub exposed_areas: Vec<f64>,
    /// Spheres that no direction exposes.
    pub never_exposed: u32,
    /// Surface samples used.
    pub samples: u64,
}

/// Measures `spheres` (caller's frame) against `solid`.
pub fn quality(
    solid: &Solid,
    spheres: &[Sphere],
    options: &QualityOptions,
    run: &Run,
) -> Result<Quality> {
    let _ = (solid, spheres, options, run);
    Err(Error::Internal("quality is not built yet".into()))
}
