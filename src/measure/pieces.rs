//! The surface of a body in triangles: of a mesh its faces, of voxels the
//! faces between solid and empty cells, each cut in two.

use crate::math::Vec3;
use crate::shape::{Body, Voxels};

/// Calls `f` for each triangle of the surface, counter-clockwise seen from outside.
pub(super) fn for_each(body: &Body, mut f: impl FnMut([Vec3; 3])) {
    match body {
        Body::Mesh(m) => (0..m.faces.len()).for_each(|i| f(m.corners(i))),
        Body::Voxels(v) => cells(v, f),
    }
}

fn cells(v: &Voxels, mut f: impl FnMut([Vec3; 3])) {
    let dims = v.dims;
    let stride = [1, dims[0], dims[0] * dims[1]];
    let solid = |i: usize| v.cells.get(i).is_some_and(|&c| c != 0);
    for k in 0..dims[2] {
        for j in 0..dims[1] {
            for i in 0..dims[0] {
                let at = [i, j, k];
                let index = i + stride[1] * j + stride[2] * k;
                if !solid(index) {
                    continue;
                }
                for a in 0..3 {
                    let low = at[a] > 0 && solid(index - stride[a]);
                    let high = at[a] + 1 < dims[a] && solid(index + stride[a]);
                    let (b, c) = ((a + 1) % 3, (a + 2) % 3);
                    let corner = |x: usize, y: usize, z: usize| {
                        let mut p = at;
                        p[a] += x;
                        p[b] += y;
                        p[c] += z;
                        Vec3::from(p.map(|x| x as f64)).component_mul(&v.spacing)
                    };
                    if !low {
                        f([corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1)]);
                        f([corner(0, 0, 0), corner(0, 1, 1), corner(0, 1, 0)]);
                    }
                    if !high {
                        f([corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1)]);
                        f([corner(1, 0, 0), corner(1, 1, 1), corner(1, 0, 1)]);
                    }
                }
            }
        }
    }
}

/// Area and number of the triangles.
pub(super) fn area(body: &Body) -> (f64, usize) {
    let (mut sum, mut count) = (0.0, 0);
    for_each(body, |t| {
        sum += (t[1] - t[0]).cross(&(t[2] - t[0])).norm() * 0.5;
        count += 1;
    });
    (sum, count)
}

/// About `n` points evenly over the surface with the normal there, `f(point, normal)`: equal
/// steps of area along the triangles, and within them the additive sequence of least
/// discrepancy in two dimensions (the plastic number's).
pub(super) fn samples(body: &Body, area: f64, n: usize, mut f: impl FnMut(Vec3, Vec3)) {
    const G: f64 = 1.324_717_957_244_746;
    let step = area / n as f64;
    let (mut passed, mut next, mut k) = (0.0, 0.5 * step, 0u32);
    for_each(body, |[a, b, c]| {
        let normal = (b - a).cross(&(c - a));
        let size = normal.norm();
        passed += 0.5 * size;
        while next < passed {
            k += 1;
            let (mut s, mut t) = ((f64::from(k) / G).fract(), (f64::from(k) / (G * G)).fract());
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            f(a + (b - a) * s + (c - a) * t, normal / size);
            next = (f64::from(k) + 0.5) * step;
        }
    });
}
