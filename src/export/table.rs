//! Tables of spheres.

use crate::math::Sphere;
use std::fmt::Write;

/// Header `x,y,z,r,mass` and a sphere a line; without masses where there are none.
pub fn csv(spheres: &[Sphere], masses: &[f64]) -> String {
    let mut out = String::from(if masses.is_empty() { "x,y,z,r\n" } else { "x,y,z,r,mass\n" });
    let mut masses = masses.iter();
    for s in spheres {
        let _ = row(&mut out, s, ",");
        if let Some(m) = masses.next() {
            let _ = write!(out, ",{m:?}");
        }
        out.push('\n');
    }
    out
}

/// A sphere a line, no header.
pub(super) fn bare(spheres: &[Sphere], between: &str) -> String {
    let mut out = String::new();
    for s in spheres {
        let _ = row(&mut out, s, between);
        out.push('\n');
    }
    out
}

fn row(out: &mut String, s: &Sphere, between: &str) -> std::fmt::Result {
    let [x, y, z] = [s.center.x, s.center.y, s.center.z];
    write!(out, "{x:?}{between}{y:?}{between}{z:?}{between}{:?}", s.radius)
}
