//! The surface of a region of cells: the faces of its cells but those between two of them, what a
//! plane cuts being cut.
//!
//! Cells are clipped as polygons, not as triangles: corners arise where planes meet edges of
//! polygons and nowhere else, by sums that are the same from both sides. So neighbours' corners
//! are the same to the last bit, and the surface is closed.

use super::Region;
use super::blocks::{Blocks, ON};
use super::clip::Surface;
use crate::error::{Error, Result, push};
use crate::generate::Plane;
use crate::math::Vec3;
use std::collections::HashMap;

/// The sides of a box, seen from outside, by the bits of their corners; the axis of each, and
/// whether it is the upper one.
const SIDES: [([usize; 4], usize, bool); 6] = [
    ([0, 2, 3, 1], 2, false),
    ([4, 5, 7, 6], 2, true),
    ([0, 1, 5, 4], 1, false),
    ([2, 6, 7, 3], 1, true),
    ([0, 4, 6, 2], 0, false),
    ([1, 3, 7, 5], 0, true),
];

/// A face of what is left of a cell.
struct Face {
    /// Whether it is between this cell and another one.
    inner: bool,
    corners: Vec<Vec3>,
}

impl Blocks<'_> {
    /// The surface of a region.
    pub fn skin(&self, region: &Region) -> Result<Surface> {
        let found = self.within(&region.planes, &[region.lo, region.hi])?;
        let own = region.anchor.map(|a| found.component(self.place(a as usize)));
        let is_own = |at: [usize; 3]| {
            let component = found.component(at);
            component.is_some() && own.is_none_or(|own| own == component)
        };
        let (mut out, mut numbers) = (Surface::default(), HashMap::new());
        let mut through: Vec<Plane> = Vec::new();
        for (cell, cut) in found.cells() {
            let at = self.place(cell);
            if !is_own(at) {
                continue;
            }
            let inner = SIDES.map(|(_, axis, up)| {
                let mut next = at;
                next[axis] = if up { at[axis] + 1 } else { at[axis].wrapping_sub(1) };
                next[axis] < self.dims[axis] && is_own(next)
            });
            if !cut && !inner.contains(&false) {
                continue;
            }
            let ends = self.corners(at);
            let corner = |c: usize| Vec3::from_fn(|a, _| ends[c >> a & 1][a]);
            let sides = SIDES.iter().zip(inner);
            let mut faces: Vec<Face> = sides
                .map(|((four, ..), inner)| Face { inner, corners: four.map(corner).to_vec() })
                .collect();
            if cut {
                self.through(&region.planes, &((ends[0] + ends[1]) * 0.5), &mut through);
                through.iter().for_each(|plane| clip(&mut faces, plane));
            }
            for face in faces.iter().filter(|f| !f.inner) {
                let mut fan = [0; 2];
                for (k, p) in face.corners.iter().enumerate() {
                    let v = number(p, &mut numbers, &mut out.vertices)?;
                    if k < 2 {
                        fan[k] = v;
                        continue;
                    }
                    let triangle = [fan[0], fan[1], v];
                    fan[1] = v;
                    if triangle[0] != triangle[1] && triangle[1] != v && v != triangle[0] {
                        push("faces of a piece", &mut out.faces, triangle)?;
                    }
                }
            }
        }
        Ok(out)
    }
}

/// Leaves of a convex body what lies below a plane, with a face in the plane.
fn clip(faces: &mut Vec<Face>, plane: &Plane) {
    let height = |p: &Vec3| {
        let h = plane.normal.dot(p) - plane.offset;
        if h.abs() <= ON { 0.0 } else { h }
    };
    if !faces.iter().flat_map(|f| &f.corners).any(|p| height(p) > 0.0) {
        return;
    }
    let mut rim: Vec<[Vec3; 2]> = Vec::new();
    faces.retain_mut(|face| {
        if !face.corners.iter().any(|p| height(p) < 0.0) {
            return false;
        }
        // With each corner, whether it lies in the plane.
        let mut left: Vec<(Vec3, bool)> = Vec::with_capacity(face.corners.len() + 1);
        for (p, q) in face.corners.iter().zip(face.corners.iter().cycle().skip(1)) {
            let (a, b) = (height(p), height(q));
            if a <= 0.0 {
                left.push((*p, a == 0.0));
            }
            if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
                // The same either way round.
                left.push(((p * b.abs() + q * a.abs()) / (a.abs() + b.abs()), true));
            }
        }
        for (p, q) in left.iter().zip(left.iter().cycle().skip(1)) {
            if p.1 && q.1 && p.0 != q.0 {
                rim.push([q.0, p.0]);
            }
        }
        face.corners.clear();
        face.corners.extend(left.iter().map(|(p, _)| *p));
        true
    });
    let Some([first, mut end]) = rim.pop() else { return };
    let mut corners = vec![first];
    while end != first {
        let Some(next) = rim.iter().position(|[from, _]| *from == end) else { break };
        corners.push(end);
        end = rim.swap_remove(next)[1];
    }
    if corners.len() > 2 {
        faces.push(Face { inner: false, corners });
    }
}

/// The number of the vertex at a place.
fn number(p: &Vec3, numbers: &mut HashMap<[u64; 3], u32>, vertices: &mut Vec<Vec3>) -> Result<u32> {
    // Zeros of both signs are one.
    let key = [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits());
    if let Some(&v) = numbers.get(&key) {
        return Ok(v);
    }
    let v = u32::try_from(vertices.len())
        .map_err(|_| Error::TooLarge("a surface of more than 2^32 vertices".into()))?;
    push("vertices of a piece", vertices, *p)?;
    numbers.try_reserve(1).map_err(|_| Error::OutOfMemory("no memory for vertices".into()))?;
    numbers.insert(key, v);
    Ok(v)
}
