//! A closed surface cut by a plane: what lies below it and what lies above, each closed again.
//!
//! Every decision is made by the sign of a vertex's height alone, and the vertex where an edge
//! meets the plane is made once, for all faces at the edge and for both sides. So whatever the
//! rounding, each side is closed where the whole was, and the two add up to the whole.
//! Faces in the plane are left out, on both sides: the cap that closes a side has them again.

use super::cap::{Cap, caps};
use crate::error::{Error, Result, collected, filled, push, reserve};
use crate::generate::Plane;
use crate::math::Vec3;
use std::collections::HashMap;

/// A vertex as near to the plane as this counts as on it: some roundings of unit-frame coordinates.
const ON: f64 = 4e-15;

/// Marks the tag of a face that lies in a plane.
pub(super) const CAP: u32 = 1 << 31;

/// A closed surface. The tag of a face is the number of the parent's face that it is part of, or
/// [`CAP`] and the number of a plane.
#[derive(Debug, Clone, Default)]
pub(super) struct Surface {
    pub vertices: Vec<Vec3>,
    pub faces: Vec<[u32; 3]>,
    pub tags: Vec<u32>,
}

/// A surface that may be the parent's own, whose faces are their own tags.
#[derive(Debug, Clone, Copy)]
pub(super) struct View<'a> {
    pub vertices: &'a [Vec3],
    pub faces: &'a [[u32; 3]],
    pub tags: Option<&'a [u32]>,
}

impl View<'_> {
    /// The tag of face `i`.
    #[inline]
    pub fn tag(&self, i: usize) -> u32 {
        self.tags.map_or(i as u32, |tags| tags.get(i).copied().unwrap_or(CAP))
    }

    /// The corners of a face.
    #[inline]
    pub fn corners(&self, f: &[u32; 3]) -> [Vec3; 3] {
        f.map(|v| self.vertices[v as usize])
    }
}

impl Surface {
    /// What is read of it.
    pub fn view(&self) -> View<'_> {
        View { vertices: &self.vertices, faces: &self.faces, tags: Some(&self.tags) }
    }
}

/// What a plane leaves of a surface on one side of it.
#[derive(Debug)]
pub(super) enum Side {
    /// Nothing.
    None,
    /// All of it: the plane misses or only touches it.
    Whole,
    /// A part, closed but for the caps.
    Part(Surface, Vec<Cap>),
}

/// Cuts the surface; `wanted`: which of the sides below and above.
pub(super) fn cut(view: View, plane: &Plane, wanted: [bool; 2]) -> Result<[Side; 2]> {
    let mut heights = reserve("heights of vertices", view.vertices.len())?;
    let (mut below, mut above) = (false, false);
    for v in view.vertices {
        let h = plane.normal.dot(v) - plane.offset;
        let h = if h.abs() <= ON { 0.0 } else { h };
        below |= h < 0.0;
        above |= h > 0.0;
        heights.push(h);
    }
    match (below, above) {
        (_, false) => return Ok([Side::Whole, Side::None]),
        (false, _) => return Ok([Side::None, Side::Whole]),
        _ => {}
    }
    let mut cutter = Cutter {
        view,
        heights: &heights,
        cuts: HashMap::with_hasher(Mixed),
        made: Vec::new(),
        halves: [Half::new(wanted[0]), Half::new(wanted[1])],
    };
    cutter.faces()?;
    let Cutter { made, halves: [low, high], .. } = cutter;
    let n = view.vertices.len();
    let place = |v: u32| match (v as usize).checked_sub(n) {
        None => view.vertices[v as usize],
        Some(k) => made[k],
    };
    let total = n + made.len();
    Ok([low.side(total, &place, &plane.normal)?, high.side(total, &place, &-plane.normal)?])
}

/// One side while it is made, with vertices numbered as the whole's, then the new ones.
struct Half {
    wanted: bool,
    faces: Vec<[u32; 3]>,
    tags: Vec<u32>,
    /// Edges of its faces in the plane, as the faces run.
    rim: Vec<[u32; 2]>,
}

impl Half {
    fn new(wanted: bool) -> Half {
        Half { wanted, faces: Vec::new(), tags: Vec::new(), rim: Vec::new() }
    }

    fn face(&mut self, f: [u32; 3], tag: u32) -> Result<()> {
        push("faces of a piece", &mut self.faces, f)?;
        push("faces of a piece", &mut self.tags, tag)
    }

    /// With vertices of its own, and caps; `normal`: out of the side.
    fn side(mut self, total: usize, place: &impl Fn(u32) -> Vec3, normal: &Vec3) -> Result<Side> {
        if !self.wanted || self.faces.is_empty() {
            return Ok(Side::None);
        }
        let mut index = filled("vertices of a piece", total, u32::MAX)?;
        let mut vertices = Vec::new();
        for v in self.faces.iter_mut().flatten() {
            let new = &mut index[*v as usize];
            if *new == u32::MAX {
                *new = vertices.len() as u32;
                push("vertices of a piece", &mut vertices, place(*v))?;
            }
            *v = *new;
        }
        // The cap runs against the faces.
        let rim = collected(
            "edges of a cut",
            self.rim.iter().map(|[a, b]| [index[*b as usize], index[*a as usize]]),
        )?;
        let caps = caps(rim, &vertices, normal)?;
        Ok(Side::Part(Surface { vertices, faces: self.faces, tags: self.tags }, caps))
    }
}

struct Cutter<'a> {
    view: View<'a>,
    heights: &'a [f64],
    /// The new vertex of an edge.
    cuts: HashMap<u64, u32, Mixed>,
    made: Vec<Vec3>,
    halves: [Half; 2],
}

impl Cutter<'_> {
    fn faces(&mut self) -> Result<()> {
        let view = self.view;
        for (i, f) in view.faces.iter().enumerate() {
            let h = f.map(|v| self.heights[v as usize]);
            let below = h.iter().any(|h| *h < 0.0);
            let above = h.iter().any(|h| *h > 0.0);
            if below && above {
                self.across(f, &h, view.tag(i))?;
                continue;
            }
            // In the plane: left to the caps.
            if below == above {
                continue;
            }
            let half = &mut self.halves[usize::from(above)];
            if !half.wanted {
                continue;
            }
            half.face(*f, view.tag(i))?;
            for k in 0..3 {
                let l = (k + 1) % 3;
                if h[k] == 0.0 && h[l] == 0.0 {
                    push("edges of a cut", &mut half.rim, [f[k], f[l]])?;
                }
            }
        }
        Ok(())
    }

    /// A face with corners on both sides.
    fn across(&mut self, f: &[u32; 3], h: &[f64; 3], tag: u32) -> Result<()> {
        // Turned so that the first corner is alone on its side, or the second lies in the plane.
        let alone = |k: usize| {
            let others = [h[(k + 1) % 3], h[(k + 2) % 3]];
            others.iter().all(|o| *o == 0.0 || (*o > 0.0) != (h[k] > 0.0)) && h[k] != 0.0
        };
        let k = (0..3).find(|&k| alone(k)).unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|j| f[(k + j) % 3]);
        let [ha, hb, hc] = [0, 1, 2].map(|j| h[(k + j) % 3]);
        let p = if hb == 0.0 { b } else { self.cut(a, b, ha, hb)? };
        let q = if hc == 0.0 { c } else { self.cut(c, a, hc, ha)? };
        let own = usize::from(ha > 0.0);
        let half = &mut self.halves[own];
        if half.wanted {
            half.face([a, p, q], tag)?;
            push("edges of a cut", &mut half.rim, [p, q])?;
        }
        let half = &mut self.halves[1 - own];
        if half.wanted {
            if hb == 0.0 {
                half.face([p, c, q], tag)?;
            } else if hc == 0.0 {
                half.face([p, b, q], tag)?;
            } else {
                half.face([p, b, c], tag)?;
                half.face([p, c, q], tag)?;
            }
            push("edges of a cut", &mut half.rim, [q, p])?;
        }
        Ok(())
    }

    /// The vertex where an edge meets the plane.
    fn cut(&mut self, a: u32, b: u32, ha: f64, hb: f64) -> Result<u32> {
        let key = u64::from(a.min(b)) << 32 | u64::from(a.max(b));
        if let Some(&v) = self.cuts.get(&key) {
            return Ok(v);
        }
        let [pa, pb] = [a, b].map(|v| self.view.vertices[v as usize]);
        // The same either way round, to the last bit; between the ends.
        let (wa, wb) = (hb.abs(), ha.abs());
        let p = (pa * wa + pb * wb) / (wa + wb);
        let v = u32::try_from(self.view.vertices.len() + self.made.len())
            .map_err(|_| Error::TooLarge("a cut makes more than 2^32 vertices".into()))?;
        push("vertices of a cut", &mut self.made, p)?;
        self.cuts
            .try_reserve(1)
            .map_err(|_| Error::OutOfMemory("no memory for the edges of a cut".into()))?;
        self.cuts.insert(key, v);
        Ok(v)
    }
}

/// Spreads the numbers of two vertices over all bits: the map is only looked up, its order plays
/// no part.
#[derive(Clone, Copy, Default)]
struct Mixed;

impl std::hash::BuildHasher for Mixed {
    type Hasher = Mixer;
    fn build_hasher(&self) -> Mixer {
        Mixer(0)
    }
}

struct Mixer(u64);

impl std::hash::Hasher for Mixer {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for b in bytes {
            self.write_u64(u64::from(*b));
        }
    }

    fn write_u64(&mut self, x: u64) {
        let x = (self.0 ^ x).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = x ^ x >> 32;
    }
}
