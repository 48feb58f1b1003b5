//! One object: the figures of the clump, and `spheres` as `[x, y, z, r]`.

use morula::Sphere;
use serde_json::{Value, json};
use std::io::Write;

pub fn write(out: &mut dyn Write, spheres: &[Sphere], figures: &Value) -> std::io::Result<()> {
    let mut object = figures.clone();
    if let Some(map) = object.as_object_mut() {
        map.insert("spheres".into(), list(spheres));
    }
    writeln!(out, "{object}")
}

fn list(spheres: &[Sphere]) -> Value {
    spheres.iter().map(|s| json!([s.center.x, s.center.y, s.center.z, s.radius])).collect()
}
