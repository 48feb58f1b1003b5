//! The winding number by the tree against its exact sum, and the inside that it
//! gives against crossings.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use morula::math::Vec3;
use morula::run::Pool;
use morula::shape::read::FileOptions;
use morula::shape::{Bodies, Body, ImportOptions, Mesh, Primitive};
use morula::solid::winding::Winding;
use morula::solid::{Columns, Resolution, SolidOptions, coverage};
use morula::{Error, Run, Shape, Solid};

/// Largest error of the tree that is accepted.
const ERROR: f64 = 4e-3;

fn primitive(name: &str, segments: usize) -> Mesh {
    let p = Primitive::from_name(name).unwrap();
    let o = ImportOptions::default();
    let shape = Shape::from_primitive(&p, segments, &o, &Run::serial()).unwrap();
    let Body::Mesh(m) = &*shape.body else { unreachable!() };
    m.clone()
}

fn scattered(n: usize) -> impl Iterator<Item = Vec3> {
    let mut s = 0x9e37_79b9_7f4a_7c15u64;
    let mut next = move || {
        s ^= s << 13;
        s ^= s >> 7;
        s ^= s << 17;
        (s >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..n).map(move |_| Vec3::from_fn(|_, _| 1.2 * next() - 0.1))
}

/// The tree is near the exact sum, and decides alike unless that is near ½.
fn close_to_exact(mesh: &Mesh, points: usize) {
    let w = Winding::new(mesh).unwrap();
    for p in scattered(points) {
        let (tree, exact) = (w.at(&p), w.exact(&p));
        assert!((tree - exact).abs() < ERROR, "{tree} instead of {exact} at {p}");
        if (exact - 0.5).abs() > ERROR {
            assert_eq!(tree > 0.5, exact > 0.5, "at {p}");
        }
    }
}

#[test]
fn close_to_the_exact_sum_on_closed_meshes() {
    for name in Primitive::NAMES {
        close_to_exact(&primitive(name, 40), 200);
    }
}

#[test]
fn close_to_the_exact_sum_on_open_and_crossing_meshes_and_soups() {
    let sphere = primitive("sphere", 40);
    let mut bowl = sphere.clone();
    bowl.faces.retain(|f| f.iter().all(|&v| sphere.vertices[v as usize].z < 0.6));
    assert!(bowl.faces.len() < sphere.faces.len());
    close_to_exact(&bowl, 400);
    // Two spheres that cross.
    let mut two = sphere.clone();
    let n = sphere.vertices.len() as u32;
    two.vertices.extend(sphere.vertices.iter().map(|v| v * 0.7 + Vec3::new(0.25, 0.1, 0.0)));
    two.faces.extend(sphere.faces.iter().map(|f| f.map(|v| v + n)));
    close_to_exact(&two, 400);
    // Loose triangles.
    let corners: Vec<Vec3> = scattered(300).collect();
    let faces = (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    close_to_exact(&Mesh { vertices: corners, faces, clean: false }, 400);
    // Faces in one place: the tree cannot split them by place.
    let mut pile = Mesh { vertices: sphere.vertices, faces: Vec::new(), clean: false };
    pile.faces = vec![sphere.faces[0]; 100];
    close_to_exact(&pile, 100);
}

#[test]
fn a_mesh_without_faces_has_no_inside() {
    let w = Winding::new(&Mesh::default()).unwrap();
    assert_eq!(w.at(&Vec3::zeros()), 0.0);
}

#[test]
fn on_a_vertex_edge_or_face_the_number_is_finite() {
    let mesh = primitive("box", 8);
    let w = Winding::new(&mesh).unwrap();
    for i in 0..mesh.faces.len() {
        let [a, b, c] = mesh.corners(i);
        for p in [a, (a + b) * 0.5, (a + b + c) / 3.0] {
            let n = w.at(&p);
            assert!(n.is_finite() && n.abs() < 1.5, "{n}");
        }
    }
}

/// Inside by winding number is inside by crossings.
fn alike(mesh: &Mesh, name: &str) {
    assert!(mesh.clean, "{name}");
    let w = Winding::new(mesh).unwrap();
    let hi = mesh.vertices.iter().fold(Vec3::zeros(), |m, v| m.sup(v));
    let n = 24;
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let step = [hi[u] * 1.01 / n as f64, hi[v] * 1.01 / n as f64];
        let body = Body::Mesh(mesh.clone());
        let c = Columns::new(&body, axis, [n, n], [0.0; 2], step, &Pool::serial()).unwrap();
        for b in 0..n {
            for a in 0..n {
                for i in 0..n {
                    let t = hi[axis] * (i as f64 + 0.37) / n as f64;
                    let inside = c.column(a, b).iter().any(|s| s[0] < t && t < s[1]);
                    let near = c.column(a, b).iter().flatten().any(|e| (e - t).abs() < 1e-9);
                    let at = w.at(&c.point(a, b, t));
                    assert!(
                        near || inside == (at > 0.5),
                        "{name}: winding {at}, crossings {inside}"
                    );
                }
            }
        }
    }
}

#[test]
fn inside_by_winding_number_is_inside_by_crossings() {
    for name in Primitive::NAMES {
        alike(&primitive(name, 24), name);
    }
    let Some(data) = common::data() else { return };
    let mut options = FileOptions::default();
    options.import.bodies = Bodies::All;
    for name in ["classic/armadillo.obj", "classic/bunny.obj", "classic/spot_low_resolution.obj"] {
        let path = data.join(name);
        let shape = Shape::from_file(&path, &options, &Run::serial()).unwrap();
        if let Body::Mesh(m) = &*shape.body
            && m.clean
        {
            alike(m, name);
        }
    }
}

/// What the winding number of an open mesh needs counts, and is not taken beyond the limit.
#[test]
fn trees_over_open_meshes_count_and_are_refused_beyond_the_limit() {
    let ball = common::sphere(24, 48, 1.0, [0.0; 3]);
    // A hole, closed by a lid; each face apart.
    let mut bowl = ball.clone();
    bowl.1.retain(|f| f.iter().all(|&i| ball.0[i as usize][2] < 0.8));
    for (mesh, soup) in [(bowl, false), (common::pieces(&ball), true)] {
        let run = Run::serial();
        let shape = Shape::from_mesh(&mesh.0, &mesh.1, &ImportOptions::default(), &run).unwrap();
        let with = |memory_limit| {
            let resolution = Resolution::CellsLongest(8);
            let run = Run::serial();
            let options = SolidOptions { resolution, memory_limit, ..SolidOptions::default() };
            (Solid::new(&shape, &options, &run), run.counters().peak_bytes)
        };
        let refused = |memory_limit| match with(memory_limit).0.err() {
            Some(Error::MemoryLimit(text)) => text,
            e => panic!("{e:?}"),
        };
        let (solid, peak) = with(1 << 30);
        let grid = *solid.unwrap().grid();
        let (faces, cells) = (shape.report.faces, grid.len() as u64);
        // The mesh with its lid, and trees over all faces.
        let least = if soup { 100 } else { 24 };
        assert!((least..400).contains(&((peak - cells) / faces)), "{peak} bytes, {faces} faces");
        let text = refused(peak / 2);
        let bytes = text.split_once("may take ").and_then(|t| t.1.split_once(" bytes")).unwrap().0;
        let most: u64 = bytes.parse().unwrap();
        assert!(text.contains(&(peak / 2).to_string()) && most > peak / 2, "{text}");
        refused(most - 1);
        // What is needed does not fit beside the mask of the grid.
        if soup {
            let e = coverage::inside(&shape.body, &grid, 4, most, &run).unwrap_err().to_string();
            assert!(e.contains(&(most - cells).to_string()), "{e}");
        }
        with(2 * peak).0.unwrap();
    }
}
