//! Meshes on which a careless import takes for ever, and meshes far from the origin.
//! No test here looks at a clock: the inputs are so large that comparing all pairs would
//! not come to an end.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Arrays, add, cuboid, pieces, soup, sphere, turned};
use morula::shape::{Bodies, ImportOptions};
use morula::{Error, Run, Shape};

fn import(m: &Arrays) -> Result<Shape, Error> {
    let options = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    Shape::from_mesh(&m.0, &m.1, &options, &Run::serial())
}

fn tetrahedron(at: [f64; 3], edge: f64) -> Arrays {
    let [x, y, z] = at;
    let v = vec![at, [x + edge, y, z], [x, y + edge, z], [x, y, z + edge]];
    (v, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
}

/// Numbers in −1 to 1, the same ones each time.
fn numbers() -> impl FnMut() -> f64 {
    let mut n = 0u64;
    move || {
        n += 1;
        let x = n.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        ((x ^ x >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

#[test]
fn one_vertex_far_away_neither_slows_nor_collapses() {
    // The body is open, so that it is welded; the box, and the tolerance with it, is a
    // million times larger than the body.
    let mut m = sphere(300, 600, 1.0, [0.0; 3]);
    m.1.retain(|f| f.iter().all(|&i| m.0[i as usize][2] < 0.5));
    let faces = m.1.len() as u64;
    add(&mut m, &tetrahedron([1e6, 0.0, 0.0], 1.0));
    let r = import(&m).unwrap().report;
    assert_eq!((r.faces, r.components, r.bodies), (faces + 4, 2, 2));
    assert_eq!((r.boundary_edges, r.welded_vertices), (600, 0));
    // As a heap of triangles with seams.
    let mut noise = numbers();
    let mut m = soup(&sphere(40, 80, 1.0, [0.0; 3]));
    m.0.iter_mut().flatten().for_each(|x| *x += 1e-8 * noise());
    let faces = m.1.len() as u64;
    add(&mut m, &tetrahedron([2e6, 0.0, 0.0], 1.0));
    let r = import(&m).unwrap().report;
    assert!(r.watertight && r.bodies == 2 && r.faces + 1000 > faces, "{r:?}");
}

#[test]
fn faces_that_vanish_close_nothing() {
    // Triangles so small and so near to each other that welding would make them one point.
    let mut m = sphere(24, 48, 1.0, [0.0; 3]);
    let whole = import(&m).unwrap().report;
    let mut x = numbers();
    for _ in 0..20 {
        let corners = (0..3).map(|_| [0.3, 0.2, 2.0].map(|c| c + 1e-8 * x())).collect();
        add(&mut m, &(corners, vec![[0, 1, 2]]));
    }
    let r = import(&m).unwrap().report;
    assert_eq!((r.welded_vertices, r.faces, r.bodies), (0, whole.faces, 1));
    assert!(r.watertight && r.volume == whole.volume);
}

#[test]
fn a_surface_in_pieces_is_one_surface() {
    let m = pieces(&sphere(200, 400, 1.0, [0.0; 3]));
    let r = import(&m).unwrap().report;
    // But for the smallest, at the poles, which are nearer than the tolerance.
    assert_eq!((r.bodies, r.faces), (1, m.1.len() as u64));
    assert!(r.components > 150_000);
    assert!((r.volume - 4.105).abs() < 0.01, "{}", r.volume);
}

#[test]
fn triangles_at_random_have_no_inside() {
    for size in [0.01, 0.3] {
        let mut x = numbers();
        let n = 40_000u32;
        let mut m: Arrays = (Vec::new(), Vec::new());
        for i in 0..n {
            let at = [x(), x(), x()];
            m.0.extend((0..3).map(|_| at.map(|a| a + size * x())));
            m.1.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let e = import(&m).unwrap_err();
        assert!(matches!(e, Error::OpenSurface(_)), "{e}");
    }
}

#[test]
fn many_parts_at_one_edge_and_in_one_part() {
    // Leaves of a book: tetrahedra that share an edge. All are in each other's boxes.
    for n in [500u32, 40_000] {
        let mut m: Arrays = (vec![[0.0; 3], [0.0, 0.0, 1.0]], Vec::new());
        for i in 0..n {
            let turn = |k: f64| (f64::from(i) + k) / f64::from(n) * std::f64::consts::TAU;
            let k = m.0.len() as u32;
            m.0.extend([0.1, 0.6].map(|k| [turn(k).cos(), turn(k).sin(), 0.5]));
            m.1.extend([[0, 1, k + 1], [1, 0, k], [0, k + 1, k], [1, k, k + 1]]);
        }
        match import(&m) {
            Ok(s) => {
                let r = s.report;
                assert_eq!((r.components, r.bodies, r.nonmanifold_edges), (500, 500, 1));
            }
            Err(e) => {
                assert!(n > 500);
                assert!(
                    matches!(&e, Error::TooLarge(s) if s.contains("40000 closed parts")),
                    "{e}"
                );
            }
        }
    }
    // Bubbles in a fine ball.
    let mut m = sphere(300, 600, 1.0, [0.0; 3]);
    let mut count = 0;
    for i in 0..24_i32.pow(3) {
        let at = [i % 24, i / 24 % 24, i / 576].map(|k| f64::from(k - 12) * 0.08);
        if at.iter().map(|x| x * x).sum::<f64>() < 0.75 {
            add(&mut m, &turned(tetrahedron(at, 0.03)));
            count += 1;
        }
    }
    let r = import(&m).unwrap().report;
    assert_eq!((r.components, r.bodies, count > 4000), (count + 1, 1, true));
}

/// What is to be the same wherever a mesh lies.
fn findings(m: &Arrays) -> String {
    match import(m) {
        Ok(s) => {
            let r = s.report;
            format!(
                "{} faces, {} parts, {} bodies, {} {} {}, {} {} edges, {} flat, {} twice, {} turned",
                r.faces,
                r.components,
                r.bodies,
                r.watertight,
                r.oriented,
                r.inverted,
                r.boundary_edges,
                r.nonmanifold_edges,
                r.degenerate_faces,
                r.duplicate_faces,
                r.faces_turned
            )
        }
        Err(e) => format!("status {}", e.status()),
    }
}

#[test]
fn a_mesh_is_the_same_wherever_it_lies() {
    let ball = |at: [f64; 3]| sphere(16, 32, 0.7, at);
    // A vertex in an edge, stitched in with a face without area.
    let mut stitched = ball([0.0; 3]);
    for k in (0..stitched.1.len()).step_by(5) {
        let [a, b, c] = stitched.1[k];
        let [p, q] = [a, b].map(|i| stitched.0[i as usize]);
        let n = stitched.0.len() as u32;
        stitched.0.push([0, 1, 2].map(|i| 0.3 * p[i] + 0.7 * q[i]));
        stitched.1[k] = [a, n, c];
        stitched.1.extend([[n, b, c], [a, b, n]]);
    }
    let boxed = |at: [f64; 3], edges: [f64; 3]| cuboid(at, [0, 1, 2].map(|k| at[k] + edges[k]));
    let both = |a: &Arrays, b: &Arrays| {
        let mut m = a.clone();
        add(&mut m, b);
        m
    };
    let one = boxed([0.0; 3], [0.7, 0.5, 0.3]);
    // Sharing part of a wall; a corner; an edge; overlapping; one above the other.
    let pairs =
        [[0.7, 0.1, 0.1], [0.7, 0.5, 0.3], [0.7, 0.5, 0.1], [0.3, 0.1, 0.1], [0.0, 0.0, 0.31]];
    let mut cases: Vec<Arrays> =
        pairs.iter().map(|&p| both(&one, &boxed(p, [0.7, 0.5, 0.3]))).collect();
    cases.push(stitched);
    cases.push(ball([0.0; 3]));
    cases.push(both(&ball([0.0; 3]), &ball([1.1, 0.2, 0.3])));
    // Turned so that no face has a direction of its own; a flat sheet; half a ball.
    for i in 0..pairs.len() {
        let mut m = cases[i].clone();
        for v in &mut m.0 {
            let [x, y, z] = *v;
            *v = [0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z];
        }
        cases.push(m);
    }
    let mut sheet = cases[pairs.len() + 3].clone();
    sheet.1.truncate(2);
    cases.push(sheet);
    let mut half = ball([0.0; 3]);
    half.1.retain(|f| f.iter().all(|&i| half.0[i as usize][0] < 0.01));
    cases.push(half);
    for (k, m) in cases.iter().enumerate() {
        let here = findings(m);
        for far in [1e6, 3e7, 1e8] {
            let moved =
                m.0.iter().map(|v| [v[0] + far, v[1] - 0.3 * far, v[2] + 0.77 * far]).collect();
            assert_eq!(findings(&(moved, m.1.clone())), here, "case {k} at {far:e}");
        }
    }
}
