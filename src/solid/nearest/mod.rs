//! Exact distances to the surface: to the triangles of a mesh, to the faces
//! between solid and empty cells of voxels.

mod boxes;
mod faces;

use super::triangle;
use super::winding::Winding;
use crate::error::{Error, Result, fits, reserve};
use crate::math::Vec3;
use crate::shape::{Body, Mesh, Voxels};
use boxes::{Boxes, Lie};
use faces::{Occupied, Rectangle};
use std::mem::size_of;

/// What is nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The nearest point of the surface.
    pub point: Vec3,
    /// Its distance, not negative.
    pub distance: f64,
    /// Outward normal of the surface there: the triangle's (zero if that has no area),
    /// or the voxel face's. On an edge, of one of the faces that meet there.
    pub normal: Vec3,
}

/// A tree over the surface of a body.
pub struct Surface {
    tree: Boxes,
    leaves: Leaves,
    bytes: u64,
}

/// Bytes of a face in the tree, and while that is built.
const TREE: u64 = boxes::BYTES + boxes::BUILDING;
/// … and of a triangle and of a rectangle.
const TRIANGLE: u64 = size_of::<[Vec3; 3]>() as u64;
const RECTANGLE: u64 = size_of::<Rectangle>() as u64;

/// What the leaves of the tree are.
enum Leaves {
    /// Corners of each face; the winding number says what is inside.
    Triangles(Vec<[Vec3; 3]>, Winding),
    /// Rectangles of cell faces; the cells say what is inside.
    Rectangles(Vec<Rectangle>, Occupied),
}

impl Surface {
    /// Builds the tree.
    pub fn new(body: &Body) -> Result<Surface> {
        Surface::within(body, u64::MAX)
    }

    /// The same, refused where it may take more than `limit` bytes.
    pub fn within(body: &Body, limit: u64) -> Result<Surface> {
        match body {
            Body::Mesh(mesh) => Surface::of_mesh(mesh, limit),
            Body::Voxels(voxels) => Surface::of_voxels(voxels, limit),
        }
    }

    /// Bytes that it holds (estimate from the sizes of its arrays).
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    fn of_mesh(mesh: &Mesh, limit: u64) -> Result<Surface> {
        let faces = mesh.faces.len() as u64;
        let winding = Winding::most_bytes(mesh.faces.len());
        check(faces, faces * (TREE + TRIANGLE) + winding, limit)?;
        let mut triangles = reserve("the surface tree", mesh.faces.len())?;
        for (i, face) in mesh.faces.iter().enumerate() {
            if face.iter().any(|&v| v as usize >= mesh.vertices.len()) {
                return Err(Error::IndexOutOfRange(format!(
                    "face {i} is {face:?}, and there are {} vertices",
                    mesh.vertices.len()
                )));
            }
            let t = mesh.corners(i);
            if t.iter().any(|v| !v.iter().all(|c| c.is_finite())) {
                return Err(Error::NotFinite(format!("face {i} has a vertex that is not finite")));
            }
            triangles.push(t);
        }
        let corners = |i: u32| triangles.get(i as usize).copied().unwrap_or_default();
        let tree = Boxes::new(checked(triangles.len())?, corners, Lie::Turned)?;
        let winding = Winding::new(mesh)?;
        let bytes = tree.bytes() + faces * TRIANGLE + winding.bytes();
        Ok(Surface { tree, leaves: Leaves::Triangles(triangles, winding), bytes })
    }

    fn of_voxels(voxels: &Voxels, limit: u64) -> Result<Surface> {
        let bits = voxels.cells.len() as u64 / 8;
        let total = |faces: u64| bits + faces * (TREE + RECTANGLE);
        // How many rectangles there are is known when they are made, so they are counted then.
        let most = limit.saturating_sub(bits) / (TREE + RECTANGLE);
        let rectangles = faces::rectangles(voxels, most)?;
        let found = rectangles.len() as u64;
        check(found, total(found), limit)?;
        let occupied = Occupied::new(voxels)?;
        let corners = |i: u32| {
            let ends = rectangles.get(i as usize).map(|r| r.bounds(&voxels.spacing));
            ends.map_or_else(Default::default, |(lo, hi)| [lo, hi, hi])
        };
        let tree = Boxes::new(checked(rectangles.len())?, corners, Lie::Straight)?;
        let bytes = bits + tree.bytes() + found * RECTANGLE;
        Ok(Surface { tree, leaves: Leaves::Rectangles(rectangles, occupied), bytes })
    }

    /// The nearest point of the surface. Of a point that is not finite: `p` itself, at the
    /// greatest finite distance.
    pub fn nearest(&self, p: &Vec3) -> Nearest {
        self.nearest_within(p, f64::MAX).unwrap_or(Nearest {
            point: *p,
            distance: f64::MAX,
            normal: Vec3::zeros(),
        })
    }

    /// The nearest point of the surface if it is nearer than `reach`; the smaller the reach, the
    /// faster.
    pub fn nearest_within(&self, p: &Vec3, reach: f64) -> Option<Nearest> {
        if !p.iter().all(|c| c.abs() <= 1e150) {
            return None;
        }
        // The square is made of what has one, since it may be made before it is chosen.
        let short = reach.min(1e150);
        let reach2 = if reach < 1e150 { short * short } else { f64::MAX };
        let distance2 = |q: Vec3| ((q - p).norm_squared(), q);
        let (leaf, distance2, point) = match &self.leaves {
            Leaves::Triangles(all, _) => self.tree.nearest(p, reach2, |leaf| {
                distance2(all.get(leaf as usize).map_or(*p, |t| triangle::closest(t, p)))
            }),
            Leaves::Rectangles(all, occupied) => self.tree.nearest(p, reach2, |leaf| {
                let ends = all.get(leaf as usize).map(|r| r.bounds(&occupied.spacing));
                distance2(ends.map_or(*p, |(lo, hi)| p.sup(&lo).inf(&hi)))
            }),
        }?;
        let normal = match &self.leaves {
            Leaves::Triangles(all, _) => all.get(leaf as usize).map(triangle::normal)?,
            Leaves::Rectangles(all, _) => all.get(leaf as usize)?.normal(),
        };
        Some(Nearest { point, distance: distance2.sqrt(), normal })
    }

    /// Whether `p` is inside: the winding number is above ½ (on a closed mesh it jumps by a
    /// whole number at the surface, so this is as sharp as counting crossings), or the cell
    /// is solid.
    pub fn contains(&self, p: &Vec3) -> bool {
        match &self.leaves {
            Leaves::Triangles(_, winding) => winding.at(p) > 0.5,
            Leaves::Rectangles(_, occupied) => occupied.at(p),
        }
    }

    /// Exact signed distance, negative inside.
    pub fn signed_distance(&self, p: &Vec3) -> f64 {
        let d = self.nearest(p).distance;
        if self.contains(p) { -d } else { d }
    }
}

/// Refuses a surface that may take more than `limit` bytes.
fn check(faces: u64, bytes: u64, limit: u64) -> Result<()> {
    fits(format_args!("a tree over the surface of {faces} faces"), bytes, limit)
}

/// The number of faces, of which there must be some and not too many.
fn checked(faces: usize) -> Result<u32> {
    match u32::try_from(faces) {
        Ok(0) => Err(Error::Empty("the surface has no face".into())),
        Ok(n) if n < 1 << 30 => Ok(n),
        _ => Err(Error::TooLarge(format!("the surface has {faces} faces"))),
    }
}

#[cfg(test)]
mod parry_tests;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn voxels(dims: [usize; 3], spacing: Vec3, cells: Vec<u8>) -> Voxels {
        Voxels { dims, spacing, cells }
    }

    /// Every boundary face of every cell.
    fn brute_force(v: &Voxels, p: &Vec3) -> f64 {
        let [nx, ny, _] = v.dims;
        let solid = |c: [i64; 3]| {
            (0..3).all(|a| c[a] >= 0 && c[a] < v.dims[a] as i64)
                && v.cells[c[0] as usize + nx * (c[1] as usize + ny * c[2] as usize)] != 0
        };
        let mut best = f64::MAX;
        for i in 0..v.cells.len() {
            let c = [(i % nx) as i64, (i / nx % ny) as i64, (i / nx / ny) as i64];
            for axis in 0..3 {
                for side in [0, 1] {
                    let mut other = c;
                    other[axis] += 2 * side - 1;
                    if !solid(c) || solid(other) {
                        continue;
                    }
                    let mut lo = Vec3::from(c.map(|i| i as f64));
                    lo[axis] += side as f64;
                    let mut hi = lo + Vec3::repeat(1.0);
                    hi[axis] = lo[axis];
                    let (lo, hi) = (lo.component_mul(&v.spacing), hi.component_mul(&v.spacing));
                    best = best.min((p.sup(&lo).inf(&hi) - p).norm());
                }
            }
        }
        best
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn voxels_are_exact(
            dims in [1usize..7, 1usize..7, 1usize..7],
            spacing in [0.2f64..1.0, 0.2f64..1.0, 0.2f64..1.0],
            seed in any::<u64>(),
            fill in 1u64..16,
            points in prop::collection::vec([-1.0f64..2.0, -1.0f64..2.0, -1.0f64..2.0], 20),
        ) {
            let mut cells: Vec<u8> = (0..dims.iter().product::<usize>() as u64)
                .map(|i| u8::from((i + 1).wrapping_mul(seed | 1) >> 40 & 15 < fill))
                .collect();
            cells[0] = 1;
            let v = voxels(dims, Vec3::from(spacing), cells);
            let surface = Surface::new(&Body::Voxels(v.clone())).unwrap();
            for p in points {
                let p = Vec3::from(p) * 4.0;
                let n = surface.nearest(&p);
                prop_assert!((n.distance - brute_force(&v, &p)).abs() < 1e-12);
                prop_assert!(((n.point - p).norm() - n.distance).abs() < 1e-12);
                prop_assert!((n.normal.norm() - 1.0).abs() < 1e-15);
            }
        }

        #[test]
        fn triangles_are_exact(
            vertices in prop::collection::vec([-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0], 12),
            picks in prop::collection::vec([0u32..12, 0u32..12, 0u32..12], 1..30),
            points in prop::collection::vec([-2.0f64..2.0, -2.0f64..2.0, -2.0f64..2.0], 10),
        ) {
            let vertices = vertices.into_iter().map(Vec3::from).collect();
            let mesh = Mesh { vertices, faces: picks, clean: false };
            let all: Vec<_> = (0..mesh.faces.len()).map(|i| mesh.corners(i)).collect();
            let surface = Surface::new(&Body::Mesh(mesh)).unwrap();
            for p in points {
                let p = Vec3::from(p);
                let best = all
                    .iter()
                    .map(|t| (triangle::closest(t, &p) - p).norm())
                    .min_by(f64::total_cmp)
                    .unwrap();
                prop_assert!((surface.nearest(&p).distance - best).abs() < 1e-15);
                prop_assert!(surface.nearest_within(&p, best * 0.999).is_none());
                prop_assert!(surface.nearest_within(&p, best * 1.001).is_some());
            }
        }
    }

    #[test]
    fn normals_of_a_bar_point_outwards() {
        let v = voxels([4, 2, 1], Vec3::repeat(0.25), vec![1; 8]);
        let surface = Surface::new(&Body::Voxels(v)).unwrap();
        for (p, normal, distance) in [
            ([-1.0, 0.3, 0.1], -Vec3::x(), 1.0),
            ([2.0, 0.3, 0.1], Vec3::x(), 1.0),
            ([0.5, -0.5, 0.1], -Vec3::y(), 0.5),
            ([0.5, 0.45, 0.1], Vec3::y(), 0.05),
            ([0.5, 0.25, -3.0], -Vec3::z(), 3.0),
            ([0.5, 0.25, 0.2], Vec3::z(), 0.05),
        ] {
            let n = surface.nearest(&Vec3::from(p));
            assert_eq!(n.normal, normal);
            assert!((n.distance - distance).abs() < 1e-15);
        }
        assert!(surface.contains(&Vec3::new(0.5, 0.45, 0.1)));
        assert!(!surface.contains(&Vec3::new(0.5, 0.55, 0.1)));
        assert!(surface.signed_distance(&Vec3::new(0.5, 0.45, 0.1)) < 0.0);
    }

    #[test]
    fn bad_input_neither_panics_nor_gives_nan() {
        let empty = Mesh::default();
        assert_eq!(Surface::new(&Body::Mesh(empty)).err().map(|e| e.status()), Some(5));
        let v = voxels([2, 1, 1], Vec3::repeat(0.5), vec![0; 2]);
        assert_eq!(Surface::new(&Body::Voxels(v)).err().map(|e| e.status()), Some(5));
        let v = voxels([2, 2, 1], Vec3::repeat(0.5), vec![1; 2]);
        assert_eq!(Surface::new(&Body::Voxels(v)).err().map(|e| e.status()), Some(2));
        let mut mesh = Mesh {
            vertices: vec![Vec3::zeros(), Vec3::x(), Vec3::y()],
            faces: vec![[0, 1, 7]],
            clean: false,
        };
        assert_eq!(Surface::new(&Body::Mesh(mesh.clone())).err().map(|e| e.status()), Some(4));
        mesh.faces = vec![[0, 1, 1], [0, 0, 0], [2, 2, 2]];
        let surface = Surface::new(&Body::Mesh(mesh)).unwrap();
        let n = surface.nearest(&Vec3::new(0.5, -0.25, 0.0));
        assert_eq!((n.distance, n.normal), (0.25, Vec3::zeros()));
        for p in [f64::NAN, f64::INFINITY, 1e300] {
            let n = surface.nearest(&Vec3::new(0.0, p, 0.0));
            assert_eq!(n.distance, f64::MAX);
        }
    }

    #[test]
    fn threads_may_share_it() {
        fn shared<T: Send + Sync>() {}
        shared::<Surface>();
    }
}
