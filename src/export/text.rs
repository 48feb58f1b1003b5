//! The record as JSON.

use super::Record;
use crate::error::{Error, Result};
use crate::math::Sphere;
use serde_json::json;

pub(super) fn json(r: &Record, spheres: &[Sphere], placed: bool) -> Result<String> {
    let spheres: Vec<[f64; 4]> =
        spheres.iter().map(|s| [s.center.x, s.center.y, s.center.z, s.radius]).collect();
    let axes: Vec<[f64; 3]> = r.axes.column_iter().map(|c| [c[0], c[1], c[2]]).collect();
    let record = json!({
        "name": r.name,
        "n": r.spheres.len(),
        "frame": if placed { "input" } else { "body" },
        "spheres": spheres,
        "masses": r.masses,
        "mass": r.mass,
        "volume": r.volume,
        "density": r.density(),
        "principal_moments": r.moments,
        "center": [r.center.x, r.center.y, r.center.z],
        "axes": axes,
        "quaternion": r.quaternion,
    });
    let text = serde_json::to_string_pretty(&record).map_err(|e| Error::Internal(e.to_string()))?;
    Ok(text + "\n")
}
