//! The convex hull as an intersection of half-spaces: even directions and the body's own normals.
//! Exact for a convex body in whose normals they are found; elsewhere it holds the hull and a little
//! more, and the distance to the surface decides.

use crate::error::{Result, reserve};
use crate::math::Vec3;
use crate::run::Run;

/// Even directions, and normals of the body.
const EVEN: usize = 256;
const OWN: usize = 256;
/// Directions worked on together.
const CHUNK: usize = 16;

/// A half-space `normal · x ≤ reach`.
type HalfSpace = (Vec3, f64);

/// The hull of points.
pub(super) struct Hull(Vec<HalfSpace>);

impl Hull {
    /// Of `points`; `normals` are those of the surface.
    pub fn new(points: &[Vec3], normals: &[Vec3], run: &Run) -> Result<Hull> {
        let mut directions = reserve("directions of the hull", EVEN + OWN)?;
        // A spiral of even steps along z, turned by the golden angle.
        let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        for k in 0..EVEN {
            let z = (2 * k + 1) as f64 / EVEN as f64 - 1.0;
            let (sin, cos) = (golden * k as f64).sin_cos();
            let s = (1.0 - z * z).sqrt();
            directions.push(Vec3::new(s * cos, s * sin, z));
        }
        let step = normals.len().div_ceil(OWN).max(1);
        directions.extend(normals.iter().step_by(step).filter(|n| n.norm_squared() > 0.5));
        let chunks = run.pool().map(directions.len().div_ceil(CHUNK), |c| {
            let some = directions.iter().skip(c * CHUNK).take(CHUNK);
            let reach = |n: &Vec3| points.iter().map(|p| n.dot(p)).fold(-f64::MAX, f64::max);
            some.map(|n| (*n, reach(n))).collect::<Vec<HalfSpace>>()
        });
        Ok(Hull(chunks.into_iter().flatten().collect()))
    }

    /// How deep `p` lies in the hull: the least of its distances to the faces' planes, negative
    /// outside; or something below `enough` once that is plain.
    pub fn depth(&self, p: &Vec3, enough: f64) -> f64 {
        let mut least = f64::MAX;
        for (n, reach) in &self.0 {
            least = least.min(reach - n.dot(p));
            if least < enough {
                break;
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_box_is_the_box() {
        let half = Vec3::new(0.5, 0.3, 0.2);
        let corner =
            |i: usize| Vec3::from_fn(|a, _| if i >> a & 1 == 1 { half[a] } else { -half[a] });
        let points: Vec<Vec3> = (0..8).map(corner).collect();
        let normals = [Vec3::x(), -Vec3::x(), Vec3::y(), -Vec3::y(), Vec3::z(), -Vec3::z()];
        let hull = Hull::new(&points, &normals, &Run::serial()).unwrap();
        for i in 0..500 {
            let at = |k: f64| (i as f64 * k).fract() * 1.2 - 0.6;
            let p = Vec3::new(at(0.618), at(0.755), at(0.57));
            let exact = (half - p.abs()).min();
            let depth = hull.depth(&p, -f64::MAX);
            // Outside, planes of edges may be the farther ones; never beyond the true distance.
            assert!(depth <= exact + 1e-15);
            assert!(exact < 0.0 || depth > exact - 1e-12, "{p:?}: {depth} {exact}");
            let out = (p.abs() - half).sup(&Vec3::zeros()).norm();
            assert!(depth >= -out - 1e-12);
            // Early answers are on the same side.
            assert_eq!(hull.depth(&p, -0.1) < -0.1, depth < -0.1);
        }
    }

    #[test]
    fn no_point_lies_outside() {
        let points: Vec<Vec3> = (0..300)
            .map(|i| Vec3::from_fn(|a, _| (i as f64 * [0.618, 0.755, 0.57][a]).fract()))
            .collect();
        let hull = Hull::new(&points, &[], &Run::serial()).unwrap();
        assert!(points.iter().all(|p| hull.depth(p, -f64::MAX) >= 0.0));
        assert!(hull.depth(&Vec3::repeat(1.1), -f64::MAX) < -0.05);
    }
}
