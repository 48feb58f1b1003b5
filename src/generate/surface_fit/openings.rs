//! What closes an open surface: without points there, spheres would bulge out of its openings.

use crate::error::{Result, collected, push};
use crate::math::Vec3;
use crate::shape::Mesh;

/// Triangles over the openings: from each open edge to the middle of its rim, as the report's
/// volume has it. They face outward as the faces beside them do.
pub(super) fn lids(mesh: &Mesh) -> Result<Vec<[Vec3; 3]>> {
    let mut lids = Vec::new();
    if mesh.clean {
        return Ok(lids);
    }
    let what = "the edges of the surface";
    let sides = mesh.faces.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut edges = collected(what, sides.map(|(a, b)| (a.min(b), a.max(b), a < b)))?;
    edges.sort_unstable();
    // Open edges, as the face has them.
    let mut open: Vec<(u32, u32)> = Vec::new();
    for group in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        if let &[(a, b, up)] = group {
            push(what, &mut open, if up { (a, b) } else { (b, a) })?;
        }
    }
    // Rims: what open edges join, by the least vertex.
    let mut vertices = collected(what, open.iter().flat_map(|e| [e.0, e.1]))?;
    vertices.sort_unstable();
    vertices.dedup();
    let number = |v: u32| vertices.binary_search(&v).unwrap_or(0);
    let mut rim = collected(what, 0..vertices.len())?;
    let root = |rim: &mut [usize], mut i: usize| {
        while rim[i] != i {
            rim[i] = rim[rim[i]];
            i = rim[i];
        }
        i
    };
    for &(a, b) in &open {
        let (a, b) = (root(&mut rim, number(a)), root(&mut rim, number(b)));
        rim[a.max(b)] = a.min(b);
    }
    let mut middles = collected(what, rim.iter().map(|_| (Vec3::zeros(), 0.0)))?;
    let ends = |&(a, b): &(u32, u32)| [mesh.vertices[a as usize], mesh.vertices[b as usize]];
    for edge in &open {
        let [p, q] = ends(edge);
        let (sum, length) = &mut middles[root(&mut rim, number(edge.0))];
        *sum += (p + q) * (0.5 * (q - p).norm());
        *length += (q - p).norm();
    }
    for edge in &open {
        let [p, q] = ends(edge);
        let (sum, length) = middles[root(&mut rim, number(edge.0))];
        if length > 0.0 {
            push(what, &mut lids, [q, p, sum / length])?;
        }
    }
    Ok(lids)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_without_lid_gets_one() {
        let vertices: Vec<Vec3> =
            (0..8).map(|i| Vec3::from_fn(|a, _| f64::from(i >> a & 1))).collect();
        // All sides but the upper one.
        let quads = [[0, 2, 3, 1], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let mut mesh = Mesh { vertices, faces, clean: false };
        let lids = lids(&mesh).unwrap();
        assert_eq!(lids.len(), 4);
        let normal: Vec3 = lids.iter().map(|[a, b, c]| (b - a).cross(&(c - a)) * 0.5).sum();
        assert!((normal - Vec3::z()).norm() < 1e-12, "{normal}");
        assert!(lids.iter().all(|t| (t[2] - Vec3::new(0.5, 0.5, 1.0)).norm() < 1e-12));
        mesh.clean = true;
        assert!(super::lids(&mesh).unwrap().is_empty());
    }
}
