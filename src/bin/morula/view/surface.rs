//! The target as triangles to draw: smooth where the mesh is smooth, with
//! creases where faces meet at an angle; voxels as their outer faces.

use morula::math::Vec3;
use morula::shape::{Body, Mesh, Voxels};

/// A triangle to draw.
pub struct Triangle {
    pub corners: [Vec3; 3],
    pub normals: [Vec3; 3],
    /// Neighbours with different ids may show an edge between them.
    pub id: u32,
}

/// Faces that meet at more than this look creased; cosine of 32°.
const CREASE: f64 = 0.848;

/// The triangles of a body, in its unit frame.
pub fn triangles(body: &Body) -> Vec<Triangle> {
    match body {
        Body::Mesh(mesh) => of_mesh(mesh),
        Body::Voxels(voxels) => of_voxels(voxels),
    }
}

fn of_mesh(mesh: &Mesh) -> Vec<Triangle> {
    let areas: Vec<Vec3> = (0..mesh.faces.len())
        .map(|i| {
            let [a, b, c] = mesh.corners(i);
            (b - a).cross(&(c - a))
        })
        .collect();
    let units: Vec<Vec3> =
        areas.iter().map(|n| n.try_normalize(0.0).unwrap_or_else(Vec3::zeros)).collect();
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); mesh.vertices.len()];
    for (i, f) in mesh.faces.iter().enumerate() {
        for v in f {
            around[*v as usize].push(i as u32);
        }
    }
    (0..mesh.faces.len())
        .map(|i| Triangle {
            corners: mesh.corners(i),
            normals: mesh.faces[i].map(|v| {
                let near = around[v as usize].iter().map(|&j| j as usize);
                let sum: Vec3 =
                    near.filter(|&j| units[i].dot(&units[j]) > CREASE).map(|j| areas[j]).sum();
                sum.try_normalize(0.0).unwrap_or(units[i])
            }),
            id: 1,
        })
        .collect()
}

fn of_voxels(v: &Voxels) -> Vec<Triangle> {
    let solid = |at: [i64; 3]| {
        (0..3).all(|a| at[a] >= 0 && at[a] < v.dims[a] as i64)
            && v.cells[at[0] as usize + v.dims[0] * (at[1] as usize + v.dims[1] * at[2] as usize)]
                != 0
    };
    let mut out = Vec::new();
    for k in 0..v.dims[2] as i64 {
        for j in 0..v.dims[1] as i64 {
            for i in 0..v.dims[0] as i64 {
                if !solid([i, j, k]) {
                    continue;
                }
                for axis in 0..3 {
                    for side in [-1, 1] {
                        let mut next = [i, j, k];
                        next[axis] += side;
                        if !solid(next) {
                            face(&mut out, v, [i, j, k], axis, side);
                        }
                    }
                }
            }
        }
    }
    out
}

/// The outer face of a cell, as two triangles.
fn face(out: &mut Vec<Triangle>, v: &Voxels, cell: [i64; 3], axis: usize, side: i64) {
    let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
    let corner = |s: f64, t: f64| {
        let mut p = Vec3::new(cell[0] as f64, cell[1] as f64, cell[2] as f64);
        p[axis] += if side > 0 { 1.0 } else { 0.0 };
        p[b] += s;
        p[c] += t;
        p.component_mul(&v.spacing)
    };
    let mut normal = Vec3::zeros();
    normal[axis] = side as f64;
    let square = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
    for [i, j, k] in [[0, 1, 2], [0, 2, 3]] {
        let corners = [square[i], square[j], square[k]];
        out.push(Triangle { corners, normals: [normal; 3], id: 1 });
    }
}
