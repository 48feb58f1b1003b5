//! The keys of quality in JSON. What was not measured is null.

use morula::clump::Warning;
use morula::mass::{coverage_rule, inertia_error, union_moments};
use morula::measure::Quality;
use morula::{Clump, Result, Run, Solid};
use serde_json::{Map, Value, json};

/// What the union of the spheres lacks of the target's inertia (ε_w), where overlaps are measured.
pub fn lacking(solid: &Solid, clump: &Clump, run: &Run) -> Result<Option<f64>> {
    if clump.quality.is_none() {
        return Ok(None);
    }
    Ok(Some(inertia_error(&solid.moments(), &union_moments(&clump.spheres, run)?)))
}

/// What limits the clump.
pub fn warnings(clump: &Clump) -> Vec<Value> {
    let one = |w: &Warning| {
        json!({
            "limit": w.limit.name(), "figure": w.figure, "bound": w.bound, "text": w.to_string(),
        })
    };
    clump.warnings.iter().map(one).collect()
}

/// `lacking`: ε_w, which stands beside what a target shrunk to the same coverage would lack.
pub fn quality(
    q: Option<&Quality>,
    surface: Option<&Quality>,
    lacking: Option<f64>,
) -> Map<String, Value> {
    let all = json!({
        "D": q.map(|q| q.mismatch),
        "eta": q.map(|q| q.eta),
        "iou": q.map(|q| q.iou),
        "coverage": q.map(|q| q.coverage),
        "overshoot": q.map(|q| q.overshoot),
        "error_bound": q.map(|q| q.error_bound),
        "union_volume": q.map(|q| q.union_volume),
        "volume_error": q.map(|q| q.volume_error),
        "centroid_error": q.map(|q| q.centroid_error),
        "moment_errors": q.map(|q| q.moment_errors),
        "inertia_error": q.and(lacking),
        "inertia_error_of_coverage": q.map(|q| coverage_rule(q.coverage)),
        "protrusion": surface.map(|q| q.protrusion),
        "rms_distance": surface.map(|q| q.rms_distance),
        "hausdorff": surface.map(|q| q.hausdorff),
        "distance_bound": surface.map(|q| q.distance_bound),
        "roughness": surface.map(|q| q.roughness),
        "never_exposed": surface.map(|q| q.never_exposed),
        "asymmetry": surface.map(|q| q.asymmetry),
        "symmetry_planes": surface.map(|q| q.symmetry_planes),
    });
    match all {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}
