//! The keys of quality in JSON. What was not measured is null.

use morula::measure::Quality;
use serde_json::{Map, Value, json};

pub fn quality(q: Option<&Quality>, surface: Option<&Quality>) -> Map<String, Value> {
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
        "protrusion": surface.map(|q| q.protrusion),
        "rms_distance": surface.map(|q| q.rms_distance),
        "hausdorff": surface.map(|q| q.hausdorff),
        "distance_bound": surface.map(|q| q.distance_bound),
        "roughness": surface.map(|q| q.roughness),
        "never_exposed": surface.map(|q| q.never_exposed),
    });
    match all {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}
