//! Points that papers state, for shapes that are theirs.

use morula::Solid;

/// A point of a paper: spheres and D.
#[derive(Debug, Clone, Copy)]
pub struct Mark {
    pub what: &'static str,
    pub spheres: usize,
    pub mismatch: f64,
}

/// A shape of a paper: its principal moments over volume^(5/3), and what is stated of it.
struct Known {
    moments: [f64; 3],
    what: &'static str,
    /// Spheres, and D or, where it is above ½, coverage by spheres within the body.
    points: &'static [(usize, f64)],
}

const KNOWN: [Known; 4] = [
    Known {
        moments: [0.0970, 0.2425, 0.2425],
        what: "MSS, Buchele et al. 2026",
        points: &[(10, 0.0626)],
    },
    Known {
        moments: [0.1297, 0.4528, 0.5259],
        what: "MSS, Buchele et al. 2026",
        points: &[(70, 0.1760)],
    },
    Known {
        moments: [0.1515, 0.1515, 0.2394],
        what: "thinning and greedy cover, Yuan 2019",
        points: &[(48, 0.95), (181, 0.99), (461, 0.999), (675, 0.9999)],
    },
    Known {
        moments: [0.1271, 0.2351, 0.2637],
        what: "thinning and greedy cover, Yuan 2019",
        points: &[(255, 0.95), (1147, 0.99), (2855, 0.999), (4090, 0.9999)],
    },
];

/// How near the moments of a shape must be.
const NEAR: f64 = 0.01;

/// What papers state of a shape.
pub fn marks(solid: &Solid) -> Vec<Mark> {
    let whole = solid.unit_moments().volume.powf(5.0 / 3.0);
    let scale = solid.frame().scale.powi(5);
    let own = solid.principal().moments.map(|m| m / scale / whole);
    let is = |k: &&Known| k.moments.iter().zip(own).all(|(k, o)| (o / k - 1.0).abs() < NEAR);
    let of = |k: &Known| {
        let mark = |&(spheres, value): &(usize, f64)| {
            // Spheres within the body: D follows from what they cover.
            let mismatch = if value > 0.5 { (1.0 - value) / (1.0 + value) } else { value };
            Mark { what: k.what, spheres, mismatch }
        };
        k.points.iter().map(mark).collect()
    };
    KNOWN.iter().find(is).map_or(Vec::new(), of)
}
