//! Chrono DEM-Engine: header `x,y,z,r`; what `LoadClumpType` takes beside it stands in comments.

use super::{Record, csv};
use std::fmt::Write;

pub(super) fn table(r: &Record) -> String {
    let mut out = csv(&r.spheres, &[]);
    let [a, b, c] = r.moments;
    let _ = writeln!(out, "# {}, LoadClumpType(mass, make_float3(moi), file, material):", r.name);
    let _ = writeln!(
        out,
        "# mass = {:?}\n# moi = {a:?}, {b:?}, {c:?}\n# volume = {:?}",
        r.mass, r.volume
    );
    out
}
