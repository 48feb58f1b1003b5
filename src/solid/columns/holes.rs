//! The border of an open mesh, and cones that close it.
//!
//! The winding number of an open mesh is the crossing number of the mesh with
//! its holes closed, less the winding number of what closes them. A cone over
//! each connected part of the border closes it, whatever the border's form:
//! every vertex has as many edges coming in as going out.

use crate::error::{Result, reserve};
use crate::math::Vec3;
use crate::shape::Mesh;
use crate::solid::winding::Winding;
use std::f64::consts::PI;

/// Directed edges that are run through more often than the other way round, once for each time
/// too many. None: the mesh is closed, its winding number an integer, and the signed crossings
/// of a column give it.
pub(super) fn border(mesh: &Mesh) -> Result<Vec<[u32; 2]>> {
    let mut edges: Vec<(u32, u32, bool)> = reserve("edges", mesh.faces.len().saturating_mul(3))?;
    for f in &mesh.faces {
        for (a, b) in [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])] {
            if a != b {
                edges.push((a.min(b), a.max(b), a < b));
            }
        }
    }
    edges.sort_unstable();
    let mut out = Vec::new();
    for same in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        let up = same.iter().filter(|e| e.2).count();
        let down = same.len() - up;
        if let Some(&(a, b, _)) = same.first() {
            let edge = if up > down { [a, b] } else { [b, a] };
            out.extend(std::iter::repeat_n(edge, up.abs_diff(down)));
        }
    }
    Ok(out)
}

/// Whether the mesh has no border.
pub(in crate::solid) fn closed(mesh: &Mesh) -> Result<bool> {
    Ok(border(mesh)?.is_empty())
}

/// What closes an open mesh.
pub(super) struct Cones {
    /// The mesh and its cones.
    pub closed: Mesh,
    winding: Winding,
    parts: Vec<Part>,
}

/// The cone over one part of the border.
struct Part {
    apex: Vec3,
    radius: f64,
    area: f64,
}

impl Cones {
    pub(super) fn new(mesh: &Mesh, border: &[[u32; 2]]) -> Result<Cones> {
        let mut ids: Vec<u32> = border.iter().flatten().copied().collect();
        ids.sort_unstable();
        ids.dedup();
        let place = |v: u32| ids.partition_point(|&i| i < v);
        let mut root: Vec<usize> = (0..ids.len()).collect();
        fn find(root: &mut [usize], mut i: usize) -> usize {
            while root[i] != i {
                root[i] = root[root[i]];
                i = root[i];
            }
            i
        }
        for &[a, b] in border {
            let (a, b) = (find(&mut root, place(a)), find(&mut root, place(b)));
            root[a.max(b)] = a.min(b);
        }
        // The apex is the mean of the part's vertices.
        let mut sums = vec![(Vec3::zeros(), 0.0f64); ids.len()];
        for (i, &v) in ids.iter().enumerate() {
            let sum = &mut sums[find(&mut root, i)];
            sum.0 += mesh.vertices[v as usize];
            sum.1 += 1.0;
        }
        let mut closed = Mesh {
            vertices: reserve("vertices", mesh.vertices.len() + ids.len())?,
            faces: reserve("faces", mesh.faces.len() + border.len())?,
            clean: false,
        };
        closed.vertices.extend_from_slice(&mesh.vertices);
        let mut parts = Vec::new();
        let mut part_of = vec![usize::MAX; ids.len()];
        for (i, (sum, count)) in sums.iter().enumerate() {
            if *count > 0.0 {
                part_of[i] = parts.len();
                let apex = sum / *count;
                closed.vertices.push(apex);
                parts.push(Part { apex, radius: 0.0, area: 0.0 });
            }
        }
        for &[a, b] in border {
            let k = part_of[find(&mut root, place(a))];
            let (p, q) = (mesh.vertices[a as usize], mesh.vertices[b as usize]);
            let part = &mut parts[k];
            part.radius = part.radius.max((p - part.apex).norm()).max((q - part.apex).norm());
            part.area += 0.5 * (p - part.apex).cross(&(q - part.apex)).norm();
            closed.faces.push([b, a, (mesh.vertices.len() + k) as u32]);
        }
        // The tree wants the cones alone; the mesh's own faces come after.
        let winding = Winding::new(&closed)?;
        closed.faces.extend_from_slice(&mesh.faces);
        Ok(Cones { closed, winding, parts })
    }

    pub(super) fn bytes(&self) -> u64 {
        let mesh = 24 * self.closed.vertices.len() + 12 * self.closed.faces.len();
        mesh as u64 + self.winding.bytes()
    }

    /// Winding number of the cones about `p`.
    pub(super) fn at(&self, p: &Vec3) -> f64 {
        self.winding.at(p)
    }

    /// Whether the winding number of the cones stays below ½ in size all along the column
    /// through `p` from `from` to `to`: seen from a distance D, a surface of area A within a
    /// ball of radius R covers at most A / (D − R)² of the sphere of directions.
    pub(super) fn small(&self, p: &Vec3, axis: usize, from: f64, to: f64) -> bool {
        let mut sum = 0.0;
        for part in &self.parts {
            let mut w = part.apex - p;
            w[axis] = part.apex[axis] - part.apex[axis].clamp(from, to);
            let gap = w.norm() - part.radius;
            if gap <= 0.0 || part.area > 2.0 * PI * gap * gap {
                return false;
            }
            sum += part.area / (4.0 * PI * gap * gap);
        }
        sum < 0.5
    }
}
