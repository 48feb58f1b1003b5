//! Meshes that unit tests start from.

use super::Mesh;
use crate::math::Vec3;
use std::f64::consts::PI;

/// A box: corners counted x fastest, two faces a side.
pub fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> Mesh {
    let corner = |c: usize| [0, 1, 2].map(|a| if c >> a & 1 == 1 { hi[a] } else { lo[a] });
    let sides =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Mesh {
        vertices: (0..8).map(|c| Vec3::from(corner(c))).collect(),
        faces: sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        clean: true,
    }
}

/// An ellipsoid of `n` rings from pole to pole, twice as many vertices around.
pub fn ellipsoid(center: [f64; 3], axes: [f64; 3], n: usize) -> Mesh {
    let at = |j: usize, i: usize| {
        let (s, t) = (PI * i as f64 / n as f64, PI * j as f64 / n as f64);
        let p = [t.sin() * s.cos(), t.sin() * s.sin(), -t.cos()];
        Vec3::from([0, 1, 2].map(|k| center[k] + axes[k] * p[k]))
    };
    let mut vertices = vec![at(0, 0)];
    for j in 1..n {
        vertices.extend((0..2 * n).map(|i| at(j, i)));
    }
    vertices.push(at(n, 0));
    let id = |j: usize, i: usize| match j {
        0 => 0,
        j if j == n => vertices.len() as u32 - 1,
        _ => (1 + (j - 1) * 2 * n + i % (2 * n)) as u32,
    };
    let mut faces = Vec::new();
    for i in 0..2 * n {
        for j in 0..n {
            let [a, b, c, d] = [id(j, i), id(j, i + 1), id(j + 1, i + 1), id(j + 1, i)];
            faces.extend(
                [[a, b, c], [a, c, d]].iter().filter(|[a, b, c]| a != b && b != c && c != a),
            );
        }
    }
    Mesh { vertices, faces, clean: true }
}
