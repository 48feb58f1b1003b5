//! What a union of balls has in common with a target, counted again for a few balls at a time: what
//! the methods that move balls read.

pub(crate) mod among;
pub(crate) mod between;
pub(crate) mod chords;
pub(crate) mod cover;
pub(crate) mod dexels;
pub(crate) mod directions;
pub(crate) mod drawn;
pub(crate) mod exposed;
pub(crate) mod field;
pub(crate) mod medial;
pub(crate) mod near;
pub(crate) mod nearest;
pub(crate) mod piles;
pub(crate) mod random;
pub(crate) mod smooth;
#[cfg(test)]
pub(crate) mod test_bodies;
pub(crate) mod tiles;

use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::shape::Body;
use crate::solid::Solid;

/// The points p with normal · p ≤ offset, unit frame; the normal has length 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plane {
    pub normal: Vec3,
    pub offset: f64,
}

/// Bounding box of the body.
pub(crate) fn bounds(solid: &Solid) -> Result<[Vec3; 2]> {
    let empty = || Error::Empty("the target has no vertex and no cell".into());
    match solid.body() {
        Body::Voxels(v) => {
            let dims = Vec3::from(v.dims.map(|d| d as f64));
            Ok([Vec3::zeros(), dims.component_mul(&v.spacing)])
        }
        Body::Mesh(m) => {
            let first = m.vertices.first().ok_or_else(empty)?;
            Ok(m.vertices.iter().fold([*first, *first], |[l, h], v| [l.inf(v), h.sup(v)]))
        }
    }
}
