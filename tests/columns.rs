//! Columns against a slow exact oracle, against formulas, and through edges and vertices.

#![allow(clippy::unwrap_used)]

mod common;

use morula::math::Vec3;
use morula::run::Pool;
use morula::shape::{Body, Mesh, Voxels};
use morula::solid::Columns;
use proptest::prelude::*;
use std::f64::consts::PI;

fn mesh(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Mesh {
    let vertices = vertices.iter().map(|&v| Vec3::from(v)).collect();
    Mesh { vertices, faces: faces.to_vec(), clean: true }
}

fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> Mesh {
    let (vertices, faces) = common::cuboid(lo, hi);
    mesh(&vertices, &faces)
}

/// A ring about an axis parallel to z.
fn torus(major: f64, minor: f64, n: usize) -> Mesh {
    let mut v = Vec::new();
    let mut f = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let (s, t) = (2.0 * PI * i as f64 / n as f64, 2.0 * PI * j as f64 / n as f64);
            let r = major + minor * t.cos();
            v.push([0.5 + r * s.cos(), 0.5 + r * s.sin(), 0.5 + minor * t.sin()]);
            let at = |i: usize, j: usize| ((i % n) * n + j % n) as u32;
            f.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            f.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh(&v, &f)
}

fn sphere(radius: f64, n: usize) -> Mesh {
    let (vertices, faces) = common::sphere(n, 2 * n, radius, [0.5; 3]);
    mesh(&vertices, &faces)
}

fn signed_volume(m: &Mesh) -> f64 {
    (0..m.faces.len())
        .map(|f| {
            let [a, b, c] = m.corners(f);
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum()
}

fn join(parts: &[Mesh]) -> Mesh {
    let mut all = Mesh { clean: true, ..Mesh::default() };
    for p in parts {
        let n = all.vertices.len() as u32;
        all.vertices.extend_from_slice(&p.vertices);
        all.faces.extend(p.faces.iter().map(|f| f.map(|v| v + n)));
    }
    all
}

fn turned(mut m: Mesh) -> Mesh {
    for f in &mut m.faces {
        f.swap(1, 2);
    }
    m
}

/// Columns over the unit square, `n` by `n`.
fn unit_columns(m: &Mesh, axis: usize, n: usize) -> Columns {
    let step = 1.0 / n as f64;
    let body = Body::Mesh(m.clone());
    Columns::new(&body, axis, [n, n], [0.0, 0.0], [step, step], &Pool::serial()).unwrap()
}

/// Sign of the turn p → q → c for the point c shifted by (ε, ε²); exact where products are.
fn turn(p: [f64; 2], q: [f64; 2], c: [f64; 2]) -> i32 {
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    let d = dx * (c[1] - p[1]) - dy * (c[0] - p[0]);
    let sign = |x: f64| i32::from(x > 0.0) - i32::from(x < 0.0);
    [sign(d), -sign(dy), sign(dx)].into_iter().find(|&s| s != 0).unwrap_or(0)
}

/// Every face against one column, one by one.
fn oracle(m: &Mesh, axis: usize, c: [f64; 2]) -> Vec<[f64; 2]> {
    let mut crossings = Vec::new();
    for f in 0..m.faces.len() {
        let corners = m.corners(f);
        let p = corners.map(|p| [p[(axis + 1) % 3], p[(axis + 2) % 3]]);
        let s = [turn(p[0], p[1], c), turn(p[1], p[2], c), turn(p[2], p[0], c)];
        if s[0] != 0 && s[0] == s[1] && s[1] == s[2] {
            let n = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
            let d = n.dot(&corners[0]) - n[(axis + 1) % 3] * c[0] - n[(axis + 2) % 3] * c[1];
            crossings.push((d / n[axis], -s[0]));
        }
    }
    crossings.sort_by(|x, y| x.0.total_cmp(&y.0));
    assert_eq!(crossings.iter().map(|c| c.1).sum::<i32>(), 0);
    let (mut out, mut count, mut last): (Vec<[f64; 2]>, _, _) = (Vec::new(), 0, 0.0);
    for (at, turn) in crossings {
        if count > 0 && at > last {
            out.push([last, at]);
        }
        count += turn;
        last = at;
    }
    out
}

fn overlap(x: &[[f64; 2]], y: &[[f64; 2]]) -> f64 {
    let mut sum = 0.0;
    for a in x {
        for b in y {
            sum += (a[1].min(b[1]) - a[0].max(b[0])).max(0.0);
        }
    }
    sum
}

fn length(x: &[[f64; 2]]) -> f64 {
    x.iter().map(|i| i[1] - i[0]).sum()
}

fn same(x: &[[f64; 2]], y: &[[f64; 2]], tolerance: f64) {
    let o = overlap(x, y);
    assert!(length(x) - o < tolerance && length(y) - o < tolerance, "{x:?} against {y:?}");
}

fn against_oracle(m: &Mesh, axis: usize, n: usize) {
    let columns = unit_columns(m, axis, n);
    for b in 0..n {
        for a in 0..n {
            let p = columns.point(a, b, 0.0);
            let c = [p[(axis + 1) % 3], p[(axis + 2) % 3]];
            same(columns.column(a, b), &oracle(m, axis, c), 1e-12);
            for w in columns.column(a, b).windows(2) {
                assert!(w[0][0] < w[0][1] && w[0][1] < w[1][0], "not disjoint: {w:?}");
            }
        }
    }
}

#[test]
fn columns_through_edges_and_vertices_of_a_cube() {
    // Columns at odd multiples of 1/16: the faces at 3/16 and 13/16 are met by many.
    for axis in 0..3 {
        let m = cuboid([3.0 / 16.0; 3], [13.0 / 16.0; 3]);
        against_oracle(&m, axis, 8);
        let columns = unit_columns(&m, axis, 8);
        // Ties belong to the lower face: columns 1..6 of 8 on both axes, each counted once.
        let hit = (0..64).filter(|c| !columns.column(c % 8, c / 8).is_empty()).count();
        assert_eq!(hit, 25);
        assert!((columns.volume() - (10.0f64 / 16.0).powi(3)).abs() < 1e-15);
        for i in &columns.intervals {
            assert_eq!(*i, [3.0 / 16.0, 13.0 / 16.0]);
        }
    }
}

#[test]
fn volumes_by_formula() {
    let n = 128;
    for axis in 0..3 {
        let s = sphere(0.4, 48);
        let t = torus(0.3, 0.12, 48);
        for (m, name) in [(s, "sphere"), (t, "torus")] {
            let exact = signed_volume(&m);
            assert!(exact > 0.0);
            let by_columns = unit_columns(&m, axis, n);
            let error = (by_columns.volume() / exact - 1.0).abs();
            // Midpoint rule over chords that end like square roots: the 3/2th power of the step
            // over the tube's radius.
            assert!(error < 5e-3, "{name} along {axis}: {error}");
            assert!(by_columns.miscounted < 1e-12);
        }
    }
}

#[test]
fn cavities_are_void_and_overlaps_filled_once() {
    let outer = cuboid([0.1; 3], [0.9; 3]);
    let inner = cuboid([0.3; 3], [0.7; 3]);
    let n = 20;
    let hollow = unit_columns(&join(&[outer.clone(), turned(inner.clone())]), 2, n);
    assert!((hollow.volume() - (0.512 - 0.064)).abs() < 1e-12);
    assert!(hollow.miscounted < 1e-12);
    let nested = unit_columns(&join(&[outer.clone(), inner]), 2, n);
    assert!((nested.volume() - 0.512).abs() < 1e-12);
    assert!((nested.miscounted - 0.064).abs() < 1e-12);
    let inverted = unit_columns(&turned(outer), 2, n);
    assert!(inverted.volume() == 0.0 && (inverted.miscounted - 0.512).abs() < 1e-12);
}

#[test]
fn mirror_images_have_mirror_intervals() {
    // A mesh of dyadic coordinates, and its image in x = ½; columns that meet no vertex.
    let m = mesh(
        &[[0.0625, 0.25, 0.125], [0.875, 0.125, 0.25], [0.5, 0.9375, 0.375], [0.375, 0.5, 0.875]],
        &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    );
    let mut image = turned(m.clone());
    for v in &mut image.vertices {
        v.x = 1.0 - v.x;
    }
    let n = 37;
    let (x, y) = (unit_columns(&m, 2, n), unit_columns(&image, 2, n));
    for b in 0..n {
        for a in 0..n {
            let (x, y) = (x.column(a, b), y.column(n - 1 - a, b));
            assert_eq!(x.len(), y.len());
            same(x, y, 1e-14);
        }
    }
}

#[test]
fn threads_change_nothing() {
    let body = Body::Mesh(torus(0.3, 0.12, 40));
    let make = |threads| {
        let pool = Pool::new(threads).unwrap();
        Columns::new(&body, 0, [61, 47], [0.0, 0.01], [1.0 / 61.0, 0.02], &pool).unwrap()
    };
    let (x, y) = (make(1), make(3));
    assert!(x.starts == y.starts && x.intervals == y.intervals);
    assert_eq!(x.miscounted.to_bits(), y.miscounted.to_bits());
}

#[test]
fn voxels_are_runs_of_cells() {
    let dims = [3, 4, 5];
    let mut state = 1u32;
    let cells: Vec<u8> = (0..60)
        .map(|_| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            u8::from(state >> 31 == 1)
        })
        .collect();
    let spacing = Vec3::new(0.25, 0.125, 0.0625);
    let body = Body::Voxels(Voxels { dims, spacing, cells: cells.clone() });
    let solid = cells.iter().filter(|&&c| c != 0).count() as f64 * spacing.product();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        // Two columns to a cell, one cell beyond the array on each side.
        let d = [2 * dims[u] + 4, 2 * dims[v] + 4];
        let origin = [-spacing[u], -spacing[v]];
        let step = [spacing[u] / 2.0, spacing[v] / 2.0];
        let columns = Columns::new(&body, axis, d, origin, step, &Pool::serial()).unwrap();
        assert!((columns.volume() - solid).abs() < 1e-15);
        for b in 0..d[1] {
            for a in 0..d[0] {
                for k in 0..dims[axis] {
                    let p = columns.point(a, b, (k as f64 + 0.5) * spacing[axis]);
                    let at = [0, 1, 2].map(|i| (p[i] / spacing[i]).floor());
                    let is = (0..3).all(|i| at[i] >= 0.0 && at[i] < dims[i] as f64)
                        && cells[at[0] as usize + 3 * (at[1] as usize + 4 * at[2] as usize)] != 0;
                    let t = p[axis];
                    let by = columns.column(a, b).iter().any(|i| i[0] < t && t < i[1]);
                    assert_eq!(by, is, "axis {axis}, column {a}, {b}, cell {k}");
                }
            }
        }
    }
}

#[test]
fn bad_lattices_are_refused() {
    let body = Body::Mesh(cuboid([0.0; 3], [1.0; 3]));
    let pool = Pool::serial();
    let huge = [usize::MAX / 2, 3];
    assert!(Columns::new(&body, 2, huge, [0.0; 2], [1.0; 2], &pool).is_err());
    assert!(Columns::new(&body, 3, [1, 1], [0.0; 2], [1.0; 2], &pool).is_err());
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Columns::new(&body, 2, [1, 1], [0.0; 2], [1.0, step], &pool).is_err());
    }
    let none = Columns::new(&body, 2, [0, 4], [0.0; 2], [1.0; 2], &pool).unwrap();
    assert_eq!(none.starts, [0]);
}

#[test]
fn a_cube_without_lid_is_filled_by_its_winding_number() {
    let mut m = cuboid([0.2; 3], [0.8; 3]);
    m.clean = false;
    // Still closed: the exact way is taken and agrees.
    assert!((unit_columns(&m, 2, 20).volume() - 0.216).abs() < 1e-12);
    // Without its two upper faces (z): columns through the hole have one crossing only.
    m.faces.retain(|f| !f.iter().all(|&v| v >= 4));
    for axis in 0..3 {
        let columns = unit_columns(&m, axis, 20);
        // The level ½ sags into the opening: at its middle 5/6 of the solid angle above are
        // closed at the lid's height, so little is lost.
        let share = columns.volume() / 0.216;
        assert!((0.8..1.0).contains(&share), "axis {axis}: {share}");
    }
    let (x, z) = (unit_columns(&m, 0, 40), unit_columns(&m, 2, 40));
    assert!((x.volume() / z.volume() - 1.0).abs() < 0.02, "{} {}", x.volume(), z.volume());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Tetrahedra with vertices on the lattice's own multiples of 1/32, so that many columns
    /// pass exactly through vertices and edges; several of them, so that they overlap.
    #[test]
    fn random_tetrahedra_against_the_oracle(
        raw in prop::collection::vec([0i32..=32, 0i32..=32, 0i32..=32], 4..=12),
        axis in 0usize..3,
    ) {
        let mut parts = Vec::new();
        for four in raw.chunks_exact(4) {
            let v: Vec<[f64; 3]> =
                four.iter().map(|p| p.map(|x| f64::from(x) / 32.0)).collect();
            parts.push(mesh(&v, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]));
        }
        against_oracle(&join(&parts), axis, 16);
    }
}
