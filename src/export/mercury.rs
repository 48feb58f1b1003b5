//! MercuryDPM, `Clumps/<Name>`: the centre of mass at the origin, principal directions the axes.
//! Its loader reads single precision; the file has all digits.

use super::{Place, Record, table};

pub(super) fn files(r: &Record) -> Vec<(Place, String)> {
    let spheres = table::bare(&r.spheres, ",");
    let [a, b, c] = r.moments;
    vec![
        (Place::Below("Clump/Clump.txt"), spheres),
        (Place::Below("Inertia/Mass.txt"), format!("{:?}\n", r.mass)),
        (Place::Below("Inertia/TOI.txt"), diagonal([a, b, c])),
        (Place::Below("Inertia/PD.txt"), diagonal([1.0; 3])),
    ]
}

fn diagonal([a, b, c]: [f64; 3]) -> String {
    format!("{a:?},0.0,0.0\n0.0,{b:?},0.0\n0.0,0.0,{c:?}\n")
}
