//! The surface of a region of cells: the faces of its cells but those between two of them, what a
//! plane cuts being cut. Neighbours' corners are the same to the last bit, so that the surface
//! is closed.

use super::Region;
use super::blocks::Blocks;
use super::clip::{CAP, Surface};
use super::piece::Piece;
use crate::error::{Result, push};
use crate::generate::Plane;
use crate::math::Vec3;
use std::collections::HashMap;

/// The axis of each two triangles of a box, and whether they are its upper side.
const SIDES: [(usize, bool); 6] =
    [(2, false), (2, true), (1, false), (1, true), (0, false), (0, true)];

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
            let open = SIDES.map(|(axis, up)| {
                let mut next = at;
                next[axis] = if up { at[axis] + 1 } else { at[axis].wrapping_sub(1) };
                next[axis] >= self.dims[axis] || !is_own(next)
            });
            if !cut && !open.contains(&true) {
                continue;
            }
            let [lo, hi] = self.corners(at);
            let mut piece = Piece::cuboid(&lo, &hi);
            if cut {
                self.through(&region.planes, &((lo + hi) * 0.5), &mut through);
                let Some(left) = piece.within(&through)? else { continue };
                piece = left;
                piece.close()?;
            }
            let view = piece.view();
            for (i, f) in view.faces.iter().enumerate() {
                let tag = view.tag(i);
                let side = open.get(tag as usize / 2).copied().unwrap_or(false);
                if tag & CAP == 0 && !side {
                    continue;
                }
                let mut face = [0; 3];
                for (to, v) in face.iter_mut().zip(view.corners(f)) {
                    *to = number(&v, &mut numbers, &mut out.vertices)?;
                }
                if face[0] != face[1] && face[1] != face[2] && face[2] != face[0] {
                    push("faces of a piece", &mut out.faces, face)?;
                }
            }
        }
        Ok(out)
    }
}

/// The number of the vertex at a place.
fn number(p: &Vec3, numbers: &mut HashMap<[u64; 3], u32>, vertices: &mut Vec<Vec3>) -> Result<u32> {
    // Zeros of both signs are one.
    let key = [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits());
    if let Some(&v) = numbers.get(&key) {
        return Ok(v);
    }
    let v = vertices.len() as u32;
    push("vertices of a piece", vertices, *p)?;
    numbers
        .try_reserve(1)
        .map_err(|_| crate::error::Error::OutOfMemory("no memory for vertices".into()))?;
    numbers.insert(key, v);
    Ok(v)
}
