use super::Vec3;
use nalgebra::Matrix3;

/// A symmetric inertia tensor, order `xx, yy, zz, xy, xz, yz`; the products
/// carry their sign: `xy = −∫ x y dm`, so these are the tensor's own entries.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Inertia {
    /// ∫ (y² + z²) dm
    pub xx: f64,
    /// ∫ (x² + z²) dm
    pub yy: f64,
    /// ∫ (x² + y²) dm
    pub zz: f64,
    /// −∫ x y dm
    pub xy: f64,
    /// −∫ x z dm
    pub xz: f64,
    /// −∫ y z dm
    pub yz: f64,
}

impl Inertia {
    /// The tensor from its second moments `∫ x², y², z², xy, xz, yz`.
    pub fn from_second_moments(m: [f64; 6]) -> Self {
        let [x2, y2, z2, xy, xz, yz] = m;
        Inertia { xx: y2 + z2, yy: x2 + z2, zz: x2 + y2, xy: -xy, xz: -xz, yz: -yz }
    }

    /// The full matrix.
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::new(
            self.xx, self.xy, self.xz, self.xy, self.yy, self.yz, self.xz, self.yz, self.zz,
        )
    }

    /// The six entries of a symmetric matrix.
    pub fn from_matrix(m: &Matrix3<f64>) -> Self {
        Inertia {
            xx: m[(0, 0)],
            yy: m[(1, 1)],
            zz: m[(2, 2)],
            xy: m[(0, 1)],
            xz: m[(0, 2)],
            yz: m[(1, 2)],
        }
    }

    /// In the order of the C ABI: `xx, yy, zz, xy, xz, yz`.
    pub fn to_array(&self) -> [f64; 6] {
        [self.xx, self.yy, self.zz, self.xy, self.xz, self.yz]
    }

    /// The tensor about a point `d` away from the centre of a body of mass `mass`
    /// whose tensor about its centre is `self` (Steiner).
    pub fn shifted(&self, mass: f64, d: &Vec3) -> Self {
        Inertia::from_matrix(
            &(self.matrix() + (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * mass),
        )
    }
}

/// Volume, centroid and inertia about the centroid, at unit density.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Moments {
    /// Volume.
    pub volume: f64,
    /// Centre of mass.
    pub centroid: Vec3,
    /// Inertia about the centroid at unit density.
    pub inertia: Inertia,
    /// Estimate of the relative error, 0 for exact integrals (up to rounding): the greatest of
    /// the volume's, the centroid's over the cube root of the volume, and the inertia's over its
    /// greatest entry. From columns along three axes: twice how far they lie from their mean.
    pub relative_error: f64,
}
