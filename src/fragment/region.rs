//! One piece of a parent.

use super::Mark;
use crate::error::Error;
use crate::generate::{HalfSpace, Plane};
use crate::math::{Moments, UnitFrame, Vec3};

/// Depth below the planes of a piece that has none: far more than any body.
const FAR: f64 = 1e6;

/// One piece of a parent: what of it lies within some half-spaces, and of that one component.
/// It holds no surface and no field of its own: the parent's serve every piece.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// The planes that the piece touches, in the unit frame of the first parent.
    pub(crate) planes: Vec<Plane>,
    /// Which component, where the half-spaces leave several.
    pub(crate) mark: Option<Mark>,
    /// At unit density, in the unit frame.
    pub(crate) moments: Moments,
    /// Corners of the box about it, in the unit frame.
    pub(crate) lo: Vec3,
    pub(crate) hi: Vec3,
    /// A face or a cell of the first parent that belongs to it, in part or as a whole. What the
    /// half-spaces leave of a face is convex, so it tells the component; a piece that touches no
    /// face is all that the half-spaces hold.
    pub(crate) anchor: Option<u64>,
    /// The cell of the cut that it comes from: the number of the seed, or of the side.
    pub(crate) cell: usize,
}

/// Of a region that its parent does not have: bytes may tell of one.
pub(super) fn no_part() -> Error {
    Error::InvalidArgument(
        "the fragment is no part of its parent: the bytes it came from were not made by this library".into(),
    )
}

impl Region {
    /// Depth of a point below the piece's planes: less than 0 beyond one of them, and a large
    /// finite figure where there is none.
    #[inline]
    pub(crate) fn wall(&self, p: &Vec3) -> f64 {
        self.planes.iter().fold(FAR, |least, plane| least.min(plane.offset - plane.normal.dot(p)))
    }

    /// Whether a point of the parent is surely of the piece: within its planes, and in a cell of
    /// the mark where no other component reaches.
    pub(crate) fn holds(&self, p: &Vec3) -> bool {
        self.wall(p) >= 0.0 && self.mark.as_ref().is_none_or(|mark| mark.holds(p))
    }

    /// The same of a ball within the parent and the planes, which is connected: it is of the piece
    /// when some of its points surely are. Only balls among cells in doubt alone are missed.
    pub(crate) fn holds_ball(&self, center: &Vec3, radius: f64) -> bool {
        self.wall(center) >= 0.0 && self.mark.as_ref().is_none_or(|mark| mark.meets(center, radius))
    }

    /// The half-spaces that bound it within the parent, in the caller's frame; those that it does
    /// not touch are left out.
    pub fn half_spaces(&self, frame: &UnitFrame) -> Vec<HalfSpace> {
        let input = |p: &Plane| HalfSpace {
            normal: p.normal,
            offset: p.offset * frame.scale + p.normal.dot(&frame.offset),
        };
        self.planes.iter().map(input).collect()
    }

    /// Volume, centroid and inertia at unit density, in the caller's frame.
    pub fn moments(&self, frame: &UnitFrame) -> Moments {
        frame.moments_to_input(&self.moments)
    }

    /// Corners of the box about it, in the caller's frame.
    pub fn bounds(&self, frame: &UnitFrame) -> [Vec3; 2] {
        [frame.to_input(&self.lo), frame.to_input(&self.hi)]
    }

    /// The cell of the cut that it comes from: the number of the seed, or of the cell of planes.
    pub fn cell(&self) -> usize {
        self.cell
    }

    /// Bytes that it holds beside the parent.
    pub fn bytes(&self) -> usize {
        size_of::<Region>()
            + size_of_val(self.planes.as_slice())
            + self.mark.as_ref().map_or(0, Mark::bytes)
    }
}
