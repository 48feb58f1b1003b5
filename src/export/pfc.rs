//! PFC: a command file; the inertia is that of the unit density.

use super::Record;
use std::fmt::Write;

pub(super) fn template(r: &Record) -> String {
    let name = r.name.replace('\'', "_");
    let mut out = format!(
        "; {name}: centroid at the origin, principal axes\nclump template create ...\n  name '{name}' ...\n  pebbles {} ...\n",
        r.spheres.len()
    );
    for s in &r.spheres {
        let c = &s.center;
        let _ = writeln!(out, "    {:?} {:?} {:?} {:?} ...", s.radius, c.x, c.y, c.z);
    }
    let [a, b, c] = r.moments.map(|m| m / r.density());
    let _ = writeln!(out, "  volume {:?} ...\n  inertia {a:?} {b:?} {c:?} 0.0 0.0 0.0", r.volume);
    out
}
