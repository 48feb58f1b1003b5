//! The depth of a parent between its cells: by the field that was made of it, or by the distances
//! alone.

use super::differences::Differences;
use super::field::{Field, Planes};
use crate::math::Vec3;
use crate::solid::Grid;

/// What is known of the depth at the cells.
#[derive(Debug, Clone, Copy)]
pub(super) enum Depths<'a> {
    Field(&'a Field),
    /// Signed distances, less than 0 inside.
    Distance(&'a [f32]),
}

/// The depth between the cells, about a middle.
#[derive(Debug, Clone)]
pub(super) enum Lookup<'a> {
    Planes(Planes<'a>),
    Differences(Differences<'a>),
}

impl<'a> Lookup<'a> {
    pub(super) fn new(grid: &Grid, depths: Depths<'a>, middle: &Vec3) -> Lookup<'a> {
        match depths {
            Depths::Field(field) => Lookup::Planes(Planes::new(grid, field, middle)),
            Depths::Distance(d) => Lookup::Differences(Differences::new(grid, d, middle)),
        }
    }

    /// The depth at a place, clamped to the grid, and the way in which it grows.
    #[inline]
    pub(super) fn at(&self, p: &[f32; 3]) -> (f32, [f32; 3]) {
        match self {
            Lookup::Planes(planes) => planes.at(p),
            Lookup::Differences(differences) => differences.at(p),
        }
    }

    /// Whether the depth at a place is more than a length: at a glance where it is so all about the
    /// nearest cell's centre.
    #[inline]
    pub(super) fn deeper(&self, p: &[f32; 3], than: f32) -> bool {
        match self {
            Lookup::Planes(planes) => planes.deeper(p, than),
            Lookup::Differences(differences) => differences.deeper(p, than),
        }
    }

    /// Whether the nearest cell's centre is inside.
    pub(super) fn inside(&self, p: &Vec3) -> bool {
        match self {
            Lookup::Planes(planes) => planes.inside(p),
            Lookup::Differences(differences) => differences.inside(p),
        }
    }
}
