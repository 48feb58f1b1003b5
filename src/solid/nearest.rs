//! Exact distances to the surface: to the triangles of a mesh, to the faces
//! between solid and empty cells of voxels. The only file that names parry.

use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::shape::Body;

/// What is nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The nearest point of the surface.
    pub point: Vec3,
    /// Its distance, not negative.
    pub distance: f64,
    /// Outward normal of the surface there: the triangle's, or the voxel face's.
    pub normal: Vec3,
}

/// A tree over the surface of a body.
pub struct Surface {}

impl Surface {
    /// Builds the tree.
    pub fn new(body: &Body) -> Result<Surface> {
        let _ = body;
        Err(Error::Internal("the surface tree is not built yet".into()))
    }

    /// The nearest point of the surface.
    pub fn nearest(&self, p: &Vec3) -> Nearest {
        Nearest { point: *p, distance: 0.0, normal: Vec3::zeros() }
    }

    /// Whether `p` is inside: crossings for clean meshes, winding number (above ½) otherwise,
    /// the cell for voxels.
    pub fn contains(&self, p: &Vec3) -> bool {
        let _ = p;
        false
    }

    /// Exact signed distance, negative inside.
    pub fn signed_distance(&self, p: &Vec3) -> f64 {
        let d = self.nearest(p).distance;
        if self.contains(p) { -d } else { d }
    }
}
