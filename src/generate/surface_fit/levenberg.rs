//! Levenberg–Marquardt on one sphere: least squares of the distances of its points.
//!
//! With every point given to one sphere the problem of the clump falls apart into these, each of
//! four unknowns (Price et al. 2007, section 2.2.2, solves all at once, with the same result).

use crate::math::{Sphere, Vec3};
use nalgebra::{Matrix4, Vector4};

/// Distance of `p` from the sphere, and its derivatives by centre and radius.
pub(super) fn residual(s: &Sphere, p: &Vec3) -> (f64, Vector4<f64>) {
    let w = s.center - p;
    let length = w.norm();
    // At the very centre every direction is as good.
    let d = if length > 0.0 { w / length } else { Vec3::zeros() };
    (length - s.radius, Vector4::new(d.x, d.y, d.z, -1.0))
}

fn cost(s: &Sphere, points: &[Vec3]) -> f64 {
    points.iter().map(|p| (p - s.center).norm() - s.radius).map(|d| d * d).sum()
}

/// Moves the sphere towards least squares over `points`, in at most `steps` steps (Moré 1977: the
/// damping is scaled by the diagonal). Never to a greater sum.
pub(super) fn levenberg(start: &Sphere, points: &[Vec3], steps: usize) -> Sphere {
    let mut s = *start;
    let mut sum = cost(&s, points);
    let mut damping = 1e-3;
    for _ in 0..steps {
        let (mut normal, mut right) = (Matrix4::zeros(), Vector4::zeros());
        for p in points {
            let (d, g) = residual(&s, p);
            normal += g * g.transpose();
            right -= g * d;
        }
        let mut moved = false;
        while damping < 1e9 {
            let mut damped = normal;
            for i in 0..4 {
                damped[(i, i)] += damping * (normal[(i, i)] + 1e-9 * points.len() as f64);
            }
            if let Some(step) = damped.cholesky().map(|c| c.solve(&right)) {
                let radius = s.radius + step.w;
                let next = Sphere::new(s.center + step.xyz(), radius);
                let now = cost(&next, points);
                if radius > 0.0 && now < sum {
                    let gain = sum - now;
                    s = next;
                    moved = gain > 1e-15 * sum;
                    sum = now;
                    damping = (damping * 0.1).max(1e-12);
                    break;
                }
            }
            damping *= 10.0;
        }
        if !moved {
            break;
        }
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cap(s: &Sphere, n: usize, least: f64) -> Vec<Vec3> {
        (0..n)
            .map(|i| {
                let z = 1.0 - (1.0 - least) * (i as f64 + 0.5) / n as f64;
                let (sin, cos) = (2.4 * i as f64).sin_cos();
                let t = (1.0 - z * z).sqrt();
                s.center + Vec3::new(t * cos, t * sin, z) * s.radius
            })
            .collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn derivatives_are_those_of_differences(
            center in [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
            radius in 0.1f64..2.0,
            point in [-2.0f64..2.0, -2.0f64..2.0, -2.0f64..2.0],
        ) {
            let s = Sphere::new(Vec3::from(center), radius);
            let p = Vec3::from(point);
            prop_assume!((p - s.center).norm() > 0.1);
            let (_, g) = residual(&s, &p);
            let h = 1e-6;
            for k in 0..4 {
                let moved = |h: f64| {
                    let mut m = s;
                    if k < 3 { m.center[k] += h } else { m.radius += h }
                    residual(&m, &p).0
                };
                let numeric = (moved(h) - moved(-h)) / (2.0 * h);
                prop_assert!((numeric - g[k]).abs() < 1e-8, "{k}: {numeric} {}", g[k]);
            }
        }

        #[test]
        fn a_part_of_a_sphere_gives_it_back(
            center in [-0.1f64..0.1, -0.1f64..0.1, -0.1f64..0.1],
            radius in 0.5f64..1.5,
            least in -1.0f64..0.7,
        ) {
            let s = Sphere::new(Vec3::from(center), radius);
            let points = cap(&s, 200, least);
            let start = Sphere::new(Vec3::zeros(), 1.0);
            let found = levenberg(&start, &points, 200);
            prop_assert!((found.center - s.center).norm() < 1e-6, "{found:?} {s:?}");
            prop_assert!((found.radius - s.radius).abs() < 1e-6);
        }
    }

    #[test]
    fn the_sum_never_rises_and_odd_points_do_no_harm() {
        let start = Sphere::new(Vec3::zeros(), 0.5);
        let plane: Vec<Vec3> =
            (0..50).map(|i| Vec3::new((i % 7) as f64 * 0.1, (i / 7) as f64 * 0.1, 0.4)).collect();
        for points in [plane, vec![Vec3::zeros(); 9], vec![Vec3::x()], Vec::new()] {
            let found = levenberg(&start, &points, 50);
            assert!(cost(&found, &points) <= cost(&start, &points));
            assert!(found.center.iter().all(|x| x.is_finite()) && found.radius > 0.0);
        }
    }
}
