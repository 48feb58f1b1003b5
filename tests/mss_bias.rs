//! Radii and centres of MSS on voxels have no bias.

#![allow(clippy::unwrap_used)]

#[path = "common/cells.rs"]
mod shared;

use morula::generate::GenerateOptions;
use shared::{ask, balls, cells, make, mismatch, square};

/// Positions between cells, spread evenly (multiples of the generalised golden ratio).
fn between(n: usize) -> [f64; 3] {
    [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|g| (n as f64 * g).fract())
}

#[test]
fn balls_of_voxels_have_no_bias() {
    for (r, positions) in [(5.0, 20), (6.3, 12), (7.3, 12), (10.0, 8), (15.6, 4), (20.0, 4)] {
        let mut bias = 0.0;
        for n in 0..positions {
            let c = between(n + 1).map(|x| r + 3.0 + x);
            let size = (2.0 * r) as usize + 8;
            let (solid, _) = cells([size; 3], [1.0; 3], &balls(&[(c, r)]));
            let s = make(&solid, &ask(1)).spheres[0];
            let off = square(s.center.into(), c).sqrt();
            assert!((s.radius - r).abs() < 0.1, "radius {} of {r} at {c:?}", s.radius);
            assert!(off < 0.1, "centre of {r} at {c:?} is {off} off");
            bias += (s.radius - r) / positions as f64;
        }
        assert!(bias.abs() < 0.05, "radius {r}: mean {bias:+}");
    }
}

#[test]
fn cylinders_and_turned_cubes_of_voxels_have_no_bias() {
    for (r, most) in [(5.0, 0.2), (10.0, 0.15), (20.0, 0.1)] {
        let mut bias = [0.0; 2];
        for n in 0..6 {
            let c = between(n + 1).map(|x| r + 3.0 + x);
            let round = |p: [f64; 3]| {
                (p[0] - c[0]).powi(2) + (p[1] - c[1]).powi(2) <= r * r
                    && p[2] > 2.5
                    && p[2] < 4.0 * r
            };
            let size = (2.0 * r) as usize + 8;
            let (solid, _) = cells([size, size, 4 * r as usize + 4], [1.0; 3], &round);
            let s = make(&solid, &ask(1)).spheres[0];
            bias[0] += (s.radius - r) / 6.0;
            // Turned by a proper quaternion, another one each time.
            let q = [1.0 + n as f64, 2.0, 3.0 - n as f64, 1.5];
            let norm = q.iter().map(|x: &f64| x * x).sum::<f64>().sqrt();
            let [w, x, y, z] = q.map(|v| v / norm);
            let axes = [
                [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
                [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
                [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
            ];
            let c = c.map(|x| x + 0.8 * r);
            let cube = |p: [f64; 3]| {
                let d: [f64; 3] = std::array::from_fn(|a| p[a] - c[a]);
                axes.iter().all(|e| (e[0] * d[0] + e[1] * d[1] + e[2] * d[2]).abs() <= r)
            };
            let (solid, _) = cells([(3.6 * r) as usize + 8; 3], [1.0; 3], &cube);
            let s = make(&solid, &ask(1)).spheres[0];
            bias[1] += (s.radius - r) / 6.0;
        }
        assert!(bias.iter().all(|b| b.abs() < most), "half edge {r}: {bias:?}");
    }
}

#[test]
fn boxes_of_voxels_have_no_bias() {
    for (n, r) in [(20, 10.0), (31, 15.5), (9, 4.5)] {
        let top = n as f64 + 2.5;
        let (solid, _) = cells([n + 6, n + 8, n + 12], [1.0; 3], &|p| {
            p.iter().all(|x| *x > 2.5) && p[0] < top && p[1] < top + 2.0 && p[2] < top + 6.0
        });
        let s = make(&solid, &ask(1)).spheres[0];
        assert!((s.radius - r).abs() < 0.06, "radius {} of {r}", s.radius);
    }
}

#[test]
fn anisotropic_cells_make_round_spheres() {
    let (r, c) = (14.0, [16.2, 17.0, 18.4]);
    let spacing = [1.0, 0.7, 1.6];
    let dims = [36, 50, 24];
    let (solid, mask) = cells(dims, spacing, &balls(&[(c, r)]));
    let clump = make(&solid, &ask(1));
    let s = clump.spheres[0];
    assert!((s.radius - r).abs() < 0.4, "{s:?}");
    assert!(square(s.center.into(), c).sqrt() < 0.5, "{s:?}");
    assert!(mismatch(&mask, dims, spacing, &clump.spheres) < 0.05);
}

#[test]
fn an_offset_adds_to_every_radius() {
    let inside = |p: [f64; 3]| square(p, [14.0; 3]) < 101.0;
    let (solid, _) = cells([29; 3], [0.5, 0.5, 0.5], &|p| inside(p.map(|x| 2.0 * x)));
    let plain = make(&solid, &ask(1)).spheres[0];
    let wide = make(&solid, &GenerateOptions { radius_offset: 1.5, ..ask(1) }).spheres[0];
    assert!((wide.radius - plain.radius - 0.75).abs() < 1e-9);
}
