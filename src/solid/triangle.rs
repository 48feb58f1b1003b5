//! The point of a triangle that is nearest to a point.

use crate::math::Vec3;

/// Triangles thinner than this (height over longest edge) have no normal that
/// rounding leaves alone; their edges are as near to within that fraction.
const THINNEST: f64 = 1e-12;

/// The nearest point of the triangle. Over the face when `p` lies above it (all three
/// edge planes), otherwise on the nearest edge; triangles without area are their edges.
pub(super) fn closest(t: &[Vec3; 3], p: &Vec3) -> Vec3 {
    let [a, b, c] = t;
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let normal = ab.cross(&-ca);
    let edge2 = ab.norm_squared().max(bc.norm_squared()).max(ca.norm_squared());
    let normal2 = normal.norm_squared();
    if normal2 > THINNEST * THINNEST * edge2 * edge2 {
        let over = |v: &Vec3, edge: &Vec3| normal.cross(edge).dot(&(p - v)) >= 0.0;
        if over(a, &ab) && over(b, &bc) && over(c, &ca) {
            return p - normal * (normal.dot(&(p - a)) / normal2);
        }
    }
    let mut best = on_edge(a, &ab, p);
    for q in [on_edge(b, &bc, p), on_edge(c, &ca, p)] {
        if (q - p).norm_squared() < (best - p).norm_squared() {
            best = q;
        }
    }
    best
}

/// The nearest point of the edge from `v` along `edge`.
fn on_edge(v: &Vec3, edge: &Vec3, p: &Vec3) -> Vec3 {
    let length2 = edge.norm_squared();
    let along = edge.dot(&(p - v));
    if along <= 0.0 || length2 <= 0.0 {
        *v
    } else if along >= length2 {
        v + edge
    } else {
        v + edge * (along / length2)
    }
}

/// The unit normal, counter-clockwise seen from outside; zero when there is no area.
pub(super) fn normal(t: &[Vec3; 3]) -> Vec3 {
    let n = (t[1] - t[0]).cross(&(t[2] - t[0]));
    // By the greatest component first: the square of a small area must not vanish.
    let scale = n.amax();
    if scale > 0.0 { (n / scale).normalize() } else { Vec3::zeros() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vec3> {
        [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0].prop_map(Vec3::from)
    }

    proptest! {
        #[test]
        fn no_sample_of_the_triangle_is_nearer(a in vector(), b in vector(), c in vector(), p in vector()) {
            let t = [a, b, c];
            let q = closest(&t, &(p * 2.0));
            let d = (q - p * 2.0).norm();
            let mut least = f64::MAX;
            for i in 0..=60 {
                for j in 0..=60 - i {
                    let (u, v) = (f64::from(i) / 60.0, f64::from(j) / 60.0);
                    least = least.min((a + (b - a) * u + (c - a) * v - p * 2.0).norm());
                }
            }
            prop_assert!(d <= least + 1e-12 && least <= d + 0.06);
            // The point lies on the triangle: it is its own nearest point.
            prop_assert!((closest(&t, &q) - q).norm() < 1e-9);
        }
    }

    #[test]
    fn without_area_it_is_a_segment_or_a_point() {
        let (o, x) = (Vec3::zeros(), Vec3::x());
        let p = Vec3::new(0.25, 1.0, 0.0);
        assert_eq!(closest(&[o, x, x * 0.5], &p), Vec3::new(0.25, 0.0, 0.0));
        assert_eq!(closest(&[o, o, x], &p), Vec3::new(0.25, 0.0, 0.0));
        assert_eq!(closest(&[x, x, x], &p), x);
        assert_eq!(normal(&[o, x, x * 0.5]), Vec3::zeros());
        assert_eq!(normal(&[o, x * 1e-170, Vec3::y() * 1e-100]), Vec3::z());
    }
}
