//! The body with its closed cavities filled: spheres cannot leave one open, and fitted to its wall
//! they would only shrink.

use crate::error::{Error, Result, collected, filled, fits, push, reserve};
use crate::shape::{Body, Mesh, Voxels};

/// The body without its cavities; `None` where it has none. Refused where that may take more
/// than `room` bytes.
pub(super) fn without_cavities(body: &Body, room: u64) -> Result<Option<Body>> {
    match body {
        Body::Mesh(mesh) => {
            let (v, f) = (mesh.vertices.len() as u64, mesh.faces.len() as u64);
            // Two numbers for each vertex; what is kept.
            let bytes = v.saturating_mul(12 + 24).saturating_add(f.saturating_mul(12));
            fits(format_args!("the parts of {f} faces"), bytes, room)?;
            let faces = outer_faces(mesh)?;
            if faces.len() == mesh.faces.len() {
                return Ok(None);
            }
            let vertices = collected("the outer surface", mesh.vertices.iter().copied())?;
            Ok(Some(Body::Mesh(Mesh { vertices, faces, clean: mesh.clean })))
        }
        Body::Voxels(voxels) => {
            let outside = exterior(voxels, room)?;
            let solid = voxels.cells.iter().filter(|c| **c != 0).count();
            let open = outside.iter().filter(|o| **o != 0).count();
            if solid + open == voxels.cells.len() {
                return Ok(None);
            }
            let mut cells = outside;
            cells.iter_mut().for_each(|c| *c = 1 - *c);
            Ok(Some(Body::Voxels(Voxels { dims: voxels.dims, spacing: voxels.spacing, cells })))
        }
    }
}

/// The faces of a mesh that belong to no inward part.
fn outer_faces(mesh: &Mesh) -> Result<Vec<[u32; 3]>> {
    let what = "parts of the surface";
    let mut parent: Vec<u32> = reserve(what, mesh.vertices.len())?;
    parent.extend(0..mesh.vertices.len() as u32);
    for face in &mesh.faces {
        let a = root(&mut parent, face[0]);
        let b = root(&mut parent, face[1]);
        join(&mut parent, a, b);
        let a = root(&mut parent, face[0]);
        let c = root(&mut parent, face[2]);
        join(&mut parent, a, c);
    }
    // Six times the signed volume of each part, about a vertex of it.
    let mut volumes = filled(what, mesh.vertices.len(), 0.0f64)?;
    for i in 0..mesh.faces.len() {
        let part = root(&mut parent, mesh.faces[i][0]) as usize;
        let [a, b, c] = mesh.corners(i);
        let o = mesh.vertices[part];
        volumes[part] += (a - o).cross(&(b - o)).dot(&(c - o));
    }
    let mut outer = reserve(what, mesh.faces.len())?;
    for face in &mesh.faces {
        if volumes[root(&mut parent, face[0]) as usize] >= 0.0 {
            outer.push(*face);
        }
    }
    Ok(outer)
}

fn root(parent: &mut [u32], mut i: u32) -> u32 {
    while parent[i as usize] != i {
        let above = parent[parent[i as usize] as usize];
        parent[i as usize] = above;
        i = above;
    }
    i
}

fn join(parent: &mut [u32], a: u32, b: u32) {
    parent[a.max(b) as usize] = a.min(b);
}

/// 1 for the empty cells that are joined to the border by faces, else 0: flooded from there.
fn exterior(voxels: &Voxels, room: u64) -> Result<Vec<u8>> {
    let what = "the cells outside";
    let n = voxels.cells.len();
    fits(format_args!("{what} of {n} cells"), (n as u64).saturating_mul(9), room)?;
    let [nx, ny, nz] = voxels.dims;
    if nx.checked_mul(ny).and_then(|m| m.checked_mul(nz)) != Some(n) {
        return Err(Error::Internal(format!("{n} cells in {nx} x {ny} x {nz}")));
    }
    let mut outside = filled(what, n, 0u8)?;
    let mut stack: Vec<usize> = Vec::new();
    for i in 0..n {
        let c = place(i, voxels.dims);
        if (0..3).any(|a| c[a] == 0 || c[a] + 1 == voxels.dims[a]) {
            reach(i, voxels, &mut outside, &mut stack)?;
        }
    }
    while let Some(i) = stack.pop() {
        for axis in 0..3 {
            for up in [false, true] {
                if let Some(j) = beside(i, axis, up, voxels.dims) {
                    reach(j, voxels, &mut outside, &mut stack)?;
                }
            }
        }
    }
    Ok(outside)
}

fn reach(i: usize, v: &Voxels, outside: &mut [u8], stack: &mut Vec<usize>) -> Result<()> {
    if v.cells[i] == 0 && outside[i] == 0 {
        outside[i] = 1;
        push("the cells outside", stack, i)?;
    }
    Ok(())
}

fn place(i: usize, [nx, ny, _]: [usize; 3]) -> [usize; 3] {
    [i % nx, i / nx % ny, i / (nx * ny)]
}

/// The cell beside cell `i`; `None` beyond the border.
fn beside(i: usize, axis: usize, up: bool, dims: [usize; 3]) -> Option<usize> {
    let stride = [1, dims[0], dims[0] * dims[1]][axis];
    let c = place(i, dims)[axis];
    match up {
        true => (c + 1 < dims[axis]).then(|| i + stride),
        false => (c > 0).then(|| i - stride),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    fn tetrahedron(at: Vec3, size: f64, inward: bool) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let corners = [Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()];
        let vertices = corners.iter().map(|c| at + c * size).collect();
        let mut faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        if inward {
            faces.iter_mut().for_each(|f| f.swap(1, 2));
        }
        (vertices, faces)
    }

    #[test]
    fn inward_parts_are_left_out() {
        let (mut vertices, mut faces) = tetrahedron(Vec3::zeros(), 1.0, false);
        let (inner, turned) = tetrahedron(Vec3::repeat(0.1), 0.2, true);
        faces.extend(turned.iter().map(|f| f.map(|v| v + 4)));
        vertices.extend(inner);
        let mesh = Mesh { vertices, faces, clean: true };
        let whole = Body::Mesh(mesh);
        let Some(Body::Mesh(outer)) = without_cavities(&whole, 1 << 20).unwrap() else { panic!() };
        assert_eq!((outer.faces.len(), outer.faces[3]), (4, [1, 2, 3]));
        assert!(without_cavities(&Body::Mesh(outer), 1 << 20).unwrap().is_none());
        let refused = without_cavities(&whole, 100);
        assert!(matches!(refused.err(), Some(Error::MemoryLimit(_))));
    }

    #[test]
    fn a_closed_hole_is_filled_and_an_open_one_is_not() {
        let mut cells = vec![1u8; 27];
        cells[13] = 0;
        let mut v = Voxels { dims: [3; 3], spacing: Vec3::repeat(1.0), cells };
        let body = Body::Voxels(v.clone());
        let Some(Body::Voxels(full)) = without_cavities(&body, 1 << 20).unwrap() else { panic!() };
        assert_eq!(full.cells, vec![1; 27]);
        v.cells[4] = 0;
        let body = Body::Voxels(v);
        assert!(without_cavities(&body, 1 << 20).unwrap().is_none());
        assert!(matches!(without_cavities(&body, 10).err(), Some(Error::MemoryLimit(_))));
    }
}
