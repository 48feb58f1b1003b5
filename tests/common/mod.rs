//! What several tests start from.
// Each of them uses some of it.
#![allow(dead_code, clippy::panic, clippy::print_stdout, clippy::unwrap_used)]

pub mod c_header;

use std::path::PathBuf;

/// Vertices and triangles.
pub type Arrays = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A box: corners counted x fastest, triangles counter-clockwise seen from outside, two for
/// each face.
pub fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> Arrays {
    let corner = |c: usize| [0, 1, 2].map(|a| if c >> a & 1 == 1 { hi[a] } else { lo[a] });
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    ((0..8).map(corner).collect(), faces)
}

/// A cube with its lower corner at `at`.
pub fn cube(at: [f64; 3], edge: f64) -> Arrays {
    cuboid(at, at.map(|x| x + edge))
}

/// The folder of third-party data, where there is one; says when there is none.
pub fn data() -> Option<PathBuf> {
    let data = std::env::var_os("MORULA_DATA").map(PathBuf::from);
    if data.is_none() {
        println!("skipped: MORULA_DATA is not set");
    }
    data
}
