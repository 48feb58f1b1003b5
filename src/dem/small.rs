//! Products of 3 × 3 matrices written out: those of nalgebra are loops that are not inlined.

use crate::math::Vec3;
use nalgebra::Matrix3;

/// m v
#[inline(always)]
pub(crate) fn mul(m: &Matrix3<f64>, v: &Vec3) -> Vec3 {
    Vec3::new(
        m.m11 * v.x + m.m12 * v.y + m.m13 * v.z,
        m.m21 * v.x + m.m22 * v.y + m.m23 * v.z,
        m.m31 * v.x + m.m32 * v.y + m.m33 * v.z,
    )
}

/// mᵀ v
#[inline(always)]
pub(crate) fn tr_mul(m: &Matrix3<f64>, v: &Vec3) -> Vec3 {
    Vec3::new(
        m.m11 * v.x + m.m21 * v.y + m.m31 * v.z,
        m.m12 * v.x + m.m22 * v.y + m.m32 * v.z,
        m.m13 * v.x + m.m23 * v.y + m.m33 * v.z,
    )
}

/// aᵀ b
#[inline(always)]
pub(crate) fn between(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    let c = |k: usize| tr_mul(a, &Vec3::new(b[(0, k)], b[(1, k)], b[(2, k)]));
    let (x, y, z) = (c(0), c(1), c(2));
    Matrix3::new(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_nalgebra() {
        let a = Matrix3::new(1.0, 2.0, -3.0, 0.5, 7.0, 1.5, -2.0, 0.25, 4.0);
        let b = Matrix3::new(0.5, -2.0, 3.0, 1.5, 1.0, 2.5, 8.0, 0.75, -4.0);
        let v = Vec3::new(1.0, -2.0, 0.5);
        assert_eq!(mul(&a, &v), a * v);
        assert_eq!(tr_mul(&a, &v), a.transpose() * v);
        assert_eq!(between(&a, &b), a.transpose() * b);
    }
}
