//! The sphere through four points (Price et al. 2007, eqs 1 to 6, with the columns x, y, z).

use crate::math::{Sphere, Vec3};

/// What four points determine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FourPoints {
    /// One sphere.
    Sphere(Sphere),
    /// Two of them are one point: at most a circle.
    Coincident,
    /// Three of them lie on a line: no sphere.
    Collinear,
    /// They lie on a circle: any number of spheres.
    Cocircular,
    /// They lie in a plane, and not on a circle: no sphere.
    Coplanar,
}

/// The sphere through four points. Lengths below the share `grain` of the longest distance
/// between them count as nothing.
pub(super) fn through(p: &[Vec3; 4], grain: f64) -> FourPoints {
    // About the first point, where the determinants lose least.
    let [a, b, c] = [p[1] - p[0], p[2] - p[0], p[3] - p[0]];
    let edges = [a, b, c, b - a, c - a, c - b];
    let (mut longest, mut shortest) = (0.0f64, f64::MAX);
    for e in &edges {
        let length = e.norm();
        longest = longest.max(length);
        shortest = shortest.min(length);
    }
    let least = grain * longest;
    if shortest <= least {
        return FourPoints::Coincident;
    }
    // Twice the area of each face over its longest edge: its height.
    let normals = [a.cross(&b), b.cross(&c), c.cross(&a), (b - a).cross(&(c - a))];
    let bases = [[0, 1, 3], [1, 2, 5], [0, 2, 4], [3, 4, 5]];
    let mut widest = 0.0f64;
    for (n, of) in normals.iter().zip(bases) {
        let base = of.iter().fold(0.0f64, |m, &e| m.max(edges.get(e).map_or(0.0, |e| e.norm())));
        let area = n.norm();
        if area <= least * base {
            return FourPoints::Collinear;
        }
        widest = widest.max(area);
    }
    // Six times the volume over twice the greatest area: the least height of the tetrahedron.
    let [ab, bc, ca, _] = normals;
    let volume = a.dot(&bc);
    if volume.abs() <= least * widest {
        let n = ab / ab.norm();
        let center = circle(&a, &b, &n);
        let radius = center.norm();
        // Where the circle is wide, rounding moves its centre by its square.
        let off = (c - center).norm() - radius;
        let round = off.abs() <= 4.0 * grain * radius.max(longest) * (radius / shortest).max(1.0);
        return if round { FourPoints::Cocircular } else { FourPoints::Coplanar };
    }
    let sum = bc * a.norm_squared() + ca * b.norm_squared() + ab * c.norm_squared();
    let center = sum / (2.0 * volume);
    FourPoints::Sphere(Sphere::new(p[0] + center, center.norm()))
}

/// Centre of the circle through the origin, `a` and `b` in the plane of normal `n`.
fn circle(a: &Vec3, b: &Vec3, n: &Vec3) -> Vec3 {
    let twice = 2.0 * a.cross(b).dot(n);
    (b.cross(n) * a.norm_squared() + n.cross(a) * b.norm_squared()) / twice
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Unit};
    use proptest::prelude::*;

    const GRAIN: f64 = 1e-9;

    fn turned(points: [[f64; 3]; 4], axis: [f64; 3], angle: f64, scale: f64) -> [Vec3; 4] {
        let axis = Unit::new_normalize(Vec3::from(axis) + Vec3::new(0.0, 0.0, 3.0));
        let turn = Rotation3::from_axis_angle(&axis, angle);
        points.map(|p| turn * Vec3::from(p) * scale + Vec3::new(0.3, 0.7, 0.1))
    }

    /// The minors of the determinant of eq 1, as eqs 3 to 6 use them.
    fn by_minors(p: &[Vec3; 4]) -> Sphere {
        let row = |q: &Vec3| [q.norm_squared(), q.x, q.y, q.z, 1.0];
        let minor = |column: usize| {
            let m =
                nalgebra::Matrix4::from_fn(|i, j| row(&p[i])[if j < column { j } else { j + 1 }]);
            m.determinant()
        };
        let [m11, m12, m13, m14, m15] = [0, 1, 2, 3, 4].map(minor);
        let center = Vec3::new(m12, -m13, m14) / (2.0 * m11);
        Sphere::new(center, (center.norm_squared() - m15 / m11).sqrt())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn points_of_a_sphere_give_it_back(
            directions in [[-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
                [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
                [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
                [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0]],
            radius in 0.01f64..1.0,
        ) {
            let center = Vec3::new(0.3, 0.4, 0.5);
            let d = directions.map(|d| Vec3::from(d).normalize());
            let volume = (d[1] - d[0]).dot(&(d[2] - d[0]).cross(&(d[3] - d[0])));
            prop_assume!(volume.abs() > 0.05);
            let p = d.map(|d| center + d * radius);
            let FourPoints::Sphere(s) = through(&p, GRAIN) else { panic!("{p:?}") };
            prop_assert!((s.center - center).norm() < 1e-12 && (s.radius - radius).abs() < 1e-12);
            let m = by_minors(&p);
            prop_assert!((s.center - m.center).norm() < 1e-7 / radius.powi(2));
            prop_assert!((s.radius - m.radius).abs() < 1e-7 / radius.powi(2));
        }

        #[test]
        fn degenerate_points_are_told_apart(
            axis in [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
            angle in 0.0f64..6.0,
            scale in prop::sample::select(vec![1.0, 1e-3, 1e-6]),
            order in Just([0usize, 1, 2, 3]).prop_shuffle(),
            t in 0.1f64..1.4,
        ) {
            // The offset costs digits: grains of the coordinates, not of the shape.
            let grain = GRAIN.max(1e-15 / scale);
            let (c, s) = (t.cos(), t.sin());
            for (points, expected) in [
                ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [c, s, 0.0]], FourPoints::Cocircular),
                ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [c, 1.2 * s, 0.0]], FourPoints::Coplanar),
                ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0 - t, t, 0.0], [0.1, 0.1, 1.0]], FourPoints::Collinear),
                ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [t, 0.2, 1.0]], FourPoints::Coincident),
            ] {
                // Points that meet by chance.
                prop_assume!((t - 1.0).abs() > 0.05);
                let p = turned(points, axis, angle, scale);
                prop_assert_eq!(through(&order.map(|i| p[i]), grain), expected);
            }
        }
    }

    #[test]
    fn a_height_above_the_grain_gives_a_sphere() {
        let at = |h: f64| [Vec3::x(), Vec3::y(), -Vec3::x(), Vec3::new(0.6, 0.8, h)];
        assert_eq!(through(&at(1e-10), GRAIN), FourPoints::Cocircular);
        let FourPoints::Sphere(s) = through(&at(1e-7), GRAIN) else { panic!() };
        assert!(s.radius.is_finite() && s.radius >= 1.0 - 1e-6);
        assert_eq!(through(&[Vec3::zeros(); 4], GRAIN), FourPoints::Coincident);
    }
}
