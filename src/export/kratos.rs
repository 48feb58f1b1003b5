//! Kratos, `.clu`: the inertia is that of a unit of mass.

use super::{Record, table};
use std::fmt::Write;

pub(super) fn cluster(r: &Record) -> String {
    let mut out =
        format!("//\n// {}: centre of mass at the origin, principal axes\n//\n\n", r.name);
    // The name is read as one word.
    let word: String = r.name.chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect();
    let _ = writeln!(out, "Name\n{word}\n\nBegin centers_and_radii");
    out.push_str(&table::bare(&r.spheres, " "));
    let size = r.diameter();
    let [a, b, c] = r.moments.map(|m| m / r.mass);
    let _ = writeln!(
        out,
        "End centers_and_radii\n\nParticle_center_and_diameter\n0.0 0.0 0.0 {size:?}\n\n\
         Size\n{size:?}\n\nVolume\n{:?}\n\nInertia per unit mass\n{a:?}\n{b:?}\n{c:?}",
        r.volume
    );
    out
}
