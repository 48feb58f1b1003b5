//! What several tests start from.
// Each of them uses some of it.
#![allow(dead_code, clippy::panic, clippy::print_stdout, clippy::unwrap_used)]

pub mod c_header;
pub mod fragments;

use morula::math::{Sphere, Vec3};
use morula::shape::primitive::Primitive;
use morula::shape::{ImportOptions, Shape};
use morula::solid::{Resolution, SolidOptions};
use morula::{Run, Solid};
use std::f64::consts::PI;
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

/// A sphere about `at`, poles at its ends along z, triangles counter-clockwise seen from outside.
pub fn sphere(rings: usize, segments: usize, radius: f64, at: [f64; 3]) -> Arrays {
    let mut v = vec![[0.0, 0.0, 1.0]];
    for i in 1..rings {
        let t = PI * i as f64 / rings as f64;
        for j in 0..segments {
            let p = 2.0 * PI * j as f64 / segments as f64;
            v.push([t.sin() * p.cos(), t.sin() * p.sin(), t.cos()]);
        }
    }
    v.push([0.0, 0.0, -1.0]);
    v.iter_mut().for_each(|v| *v = [0, 1, 2].map(|k| at[k] + radius * v[k]));
    let at = |i: usize, j: usize| (1 + (i - 1) * segments + j % segments) as u32;
    let last = v.len() as u32 - 1;
    let mut f = Vec::new();
    for j in 0..segments {
        f.push([0, at(1, j), at(1, j + 1)]);
        for i in 1..rings - 1 {
            f.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            f.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
        f.push([last, at(rings - 1, j + 1), at(rings - 1, j)]);
    }
    (v, f)
}

/// Every face with corners of its own, as STL has them.
pub fn soup(m: &Arrays) -> Arrays {
    let v: Vec<_> = m.1.iter().flatten().map(|&i| m.0[i as usize]).collect();
    let f = (0..m.1.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    (v, f)
}

/// Each face apart, a little smaller than its place.
pub fn pieces(m: &Arrays) -> Arrays {
    let mut m = soup(m);
    for f in m.0.chunks_exact_mut(3) {
        let middle = [0, 1, 2].map(|k| (f[0][k] + f[1][k] + f[2][k]) / 3.0);
        f.iter_mut().for_each(|v| *v = [0, 1, 2].map(|k| middle[k] + 0.99 * (v[k] - middle[k])));
    }
    m
}

/// Inside out.
pub fn turned(mut m: Arrays) -> Arrays {
    m.1.iter_mut().for_each(|f| f.swap(1, 2));
    m
}

/// Adds a part to a mesh.
pub fn add(m: &mut Arrays, (v, f): &Arrays) {
    let base = m.0.len() as u32;
    m.0.extend(v);
    m.1.extend(f.iter().map(|f| f.map(|i| i + base)));
}

/// One mesh of several parts.
pub fn join(parts: &[Arrays]) -> Arrays {
    let mut all = (Vec::new(), Vec::new());
    parts.iter().for_each(|part| add(&mut all, part));
    all
}

/// Distance from a point to a triangle by its plane, its edges and its corners, apart from the
/// library's.
pub fn to_triangle(p: &Vec3, [a, b, c]: &[Vec3; 3]) -> f64 {
    let edge = |a: &Vec3, b: &Vec3| {
        let l = (b - a).norm_squared();
        let t = if l > 0.0 { ((p - a).dot(&(b - a)) / l).clamp(0.0, 1.0) } else { 0.0 };
        (a + (b - a) * t - p).norm()
    };
    let edges = edge(a, b).min(edge(b, c)).min(edge(c, a));
    let n = (b - a).cross(&(c - a));
    if n.norm() == 0.0 {
        return edges;
    }
    let q = p - n * (n.dot(&(p - a)) / n.norm_squared());
    let inside = |u: &Vec3, v: &Vec3| (v - u).cross(&(q - u)).dot(&n) >= 0.0;
    let within = inside(a, b) && inside(b, c) && inside(c, a);
    if within { edges.min((p - q).norm()) } else { edges }
}

/// Distance from a point to the nearest of all triangles.
pub fn to_mesh(p: &Vec3, (vertices, faces): &Arrays) -> f64 {
    let corners = |f: &[u32; 3]| f.map(|v| Vec3::from(vertices[v as usize]));
    faces.iter().map(|f| to_triangle(p, &corners(f))).fold(f64::MAX, f64::min)
}

/// Winding number of a point by solid angles, apart from the library's.
pub fn winding(faces: &[[Vec3; 3]], p: &Vec3) -> f64 {
    faces
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| v - p);
            let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
            let y = a.dot(&b.cross(&c));
            let x = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
            y.atan2(x) / (2.0 * PI)
        })
        .sum()
}

/// Greatest reach of a sphere beyond the surface: below 0 where all lie within it.
pub fn beyond(mesh: &Arrays, spheres: &[Sphere]) -> f64 {
    let corners = |f: &[u32; 3]| f.map(|v| Vec3::from(mesh.0[v as usize]));
    let faces: Vec<[Vec3; 3]> = mesh.1.iter().map(corners).collect();
    let reach = spheres.iter().map(|s| {
        let distance = to_mesh(&s.center, mesh);
        s.radius + if winding(&faces, &s.center) > 0.5 { -distance } else { distance }
    });
    reach.fold(f64::MIN, f64::max)
}

/// A solid of so many cells along the longest edge.
pub fn solid_of(shape: &Shape, cells: u32) -> Solid {
    let resolution = Resolution::CellsLongest(cells);
    let options = SolidOptions { resolution, ..SolidOptions::default() };
    Solid::new(shape, &options, &Run::serial()).unwrap()
}

/// The same of a mesh.
pub fn solid_of_mesh((vertices, faces): &Arrays, cells: u32) -> Solid {
    let options = ImportOptions::default();
    solid_of(&Shape::from_mesh(vertices, faces, &options, &Run::serial()).unwrap(), cells)
}

/// The same of a built-in particle.
pub fn particle(name: &str, cells: u32) -> Solid {
    let primitive = Primitive::from_name(name).unwrap();
    let options = ImportOptions::default();
    solid_of(&Shape::from_primitive(&primitive, 48, &options, &Run::serial()).unwrap(), cells)
}

/// The folder of third-party data, where there is one; says when there is none.
pub fn data() -> Option<PathBuf> {
    let data = std::env::var_os("MORULA_DATA").map(PathBuf::from);
    if data.is_none() {
        println!("skipped: MORULA_DATA is not set");
    }
    data
}
