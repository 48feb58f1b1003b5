//! The clump's spheres fitted to the surface: points to spheres, spheres to points, in turn
//! (Price et al. 2007, section 2.2).

use super::cluster::difference;
use super::levenberg::levenberg;
use super::rules::Rules;
use crate::error::{Result, filled, push, reserve};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::solid::nearest::Surface;

/// Most rounds, besides one for each sphere that goes, and steps of a sphere in one.
const ROUNDS: usize = 80;
const STEPS: usize = 4;
/// Farthest that a sphere moves in a round, over the equivalent diameter. Points of a nearly flat
/// patch have their best sphere far away and much too large; on its way there it comes to hold
/// others, which keep it.
const STRIDE: f64 = 0.01;
/// It has settled when no sphere moves farther than this, over the equivalent diameter.
const SETTLED: f64 = 1e-5;
/// Spheres nearer to each other than this in centre and radius (eq 10), over the equivalent
/// diameter, are one.
const ALIKE: f64 = 0.02;
/// Points worked on together.
const CHUNK: usize = 128;

/// Which sphere each point belongs to: the one whose surface it lies farthest within, or least
/// far outside of, so that its distance is that from the union.
pub(super) fn assign(spheres: &[Sphere], points: &[Vec3], run: &Run) -> Vec<u32> {
    let chunks = run.pool().map(points.len().div_ceil(CHUNK), |c| {
        let nearest = |p: &Vec3| {
            let mut best = (f64::MAX, 0);
            for (i, s) in spheres.iter().enumerate() {
                let d = (p - s.center).norm() - s.radius;
                if d < best.0 {
                    best = (d, i as u32);
                }
            }
            best.1
        };
        points.iter().skip(c * CHUNK).take(CHUNK).map(nearest).collect::<Vec<u32>>()
    });
    chunks.into_iter().flatten().collect()
}

/// The points of each sphere, in their order.
fn groups(spheres: &[Sphere], points: &[Vec3], run: &Run) -> Result<Vec<Vec<Vec3>>> {
    let mut groups: Vec<Vec<Vec3>> = filled("the points of spheres", spheres.len(), Vec::new())?;
    for (p, i) in points.iter().zip(assign(spheres, points, run)) {
        if let Some(group) = groups.get_mut(i as usize) {
            push("the points of spheres", group, *p)?;
        }
    }
    Ok(groups)
}

/// What spheres are fitted to.
pub(super) struct Target<'a> {
    pub points: &'a [Vec3],
    pub surface: &'a Surface,
    pub rules: &'a Rules,
}

impl Target<'_> {
    /// Fits `spheres` until they settle. Spheres with too few points, too small ones and those whose
    /// centre leaves the body go; never the last. Ends early where `go`, asked before each round,
    /// says so.
    pub fn fit(
        &self,
        spheres: &mut Vec<Sphere>,
        run: &Run,
        go: &mut impl FnMut(f64) -> bool,
    ) -> Result<()> {
        let Target { points, surface, rules } = *self;
        let rounds = ROUNDS + spheres.len();
        for round in 0..rounds {
            if !go(round as f64 / rounds as f64) {
                return Ok(());
            }
            let all = groups(spheres, points, run)?;
            if let Some(i) = self.needless(spheres, &all) {
                spheres.remove(i);
                continue;
            }
            let moved = run.pool().map(spheres.len(), |i| match (spheres.get(i), all.get(i)) {
                (Some(s), Some(group)) => {
                    let best = levenberg(s, group, STEPS);
                    let far = (best.center - s.center).norm().max((best.radius - s.radius).abs());
                    let stride = STRIDE * rules.diameter;
                    let share = if far > stride { stride / far } else { 1.0 };
                    let center = s.center + (best.center - s.center) * share;
                    let new = Sphere::new(center, s.radius + (best.radius - s.radius) * share);
                    let fits = new.radius >= rules.min_radius && surface.contains(&new.center);
                    fits.then_some((new, far))
                }
                _ => None,
            });
            let far = moved.iter().flatten().map(|m| m.1).fold(0.0, f64::max);
            let mut kept: Vec<Sphere> = reserve("the spheres", spheres.len())?;
            kept.extend(moved.iter().flatten().map(|m| m.0));
            if kept.is_empty() {
                return Ok(());
            }
            let whole = kept.len() == spheres.len();
            *spheres = kept;
            if whole && far <= SETTLED * rules.diameter {
                break;
            }
        }
        Ok(())
    }

    /// A sphere to squeeze out, one at a time, so that what it held may save others: that of
    /// fewest points, if these are too few; else one that is like another and has fewer.
    fn needless(&self, spheres: &[Sphere], groups: &[Vec<Vec3>]) -> Option<usize> {
        let count = |i: usize| groups.get(i).map_or(0, Vec::len);
        if spheres.len() < 2 {
            return None;
        }
        let fewest = (0..spheres.len()).min_by_key(|&i| count(i))?;
        if count(fewest) < self.rules.least {
            return Some(fewest);
        }
        let alike = ALIKE * self.rules.diameter;
        spheres.iter().enumerate().find_map(|(i, a)| {
            let twin = |(_, b): &(usize, &Sphere)| difference(a, b) < alike;
            let (j, _) = spheres.iter().enumerate().skip(i + 1).find(twin)?;
            Some(if count(j) > count(i) { i } else { j })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Body;
    use crate::shape::samples;

    fn sphere(x: f64, radius: f64) -> Sphere {
        Sphere::new(Vec3::new(x, 0.5, 0.5), radius)
    }

    #[test]
    fn a_point_belongs_to_the_sphere_that_gives_its_distance_from_the_union() {
        let spheres = [sphere(0.0, 0.5), sphere(1.0, 0.7), sphere(0.2, 0.1)];
        let at = [-1.0, -0.4, 0.2, 0.25, 0.45, 0.5, 3.0];
        let points = at.map(|x| Vec3::new(x, 0.5, 0.5));
        // 0.45: 0.05 within the first, 0.15 within the second, in the third not at all.
        assert_eq!(assign(&spheres, &points, &Run::serial()), [0, 0, 0, 0, 1, 1, 1]);
        let many: Vec<Vec3> = (0..999).map(|i| points[i % 7]).collect();
        let run = Run::new(3).unwrap();
        let of_many = assign(&spheres, &many, &run);
        assert!(of_many.iter().enumerate().all(|(i, s)| *s == u32::from(i % 7 > 3)));
    }

    #[test]
    fn the_poorest_goes_first_then_one_of_twins() {
        let surface = Surface::new(&Body::Mesh(samples::cuboid([0.0; 3], [1.0; 3]))).unwrap();
        let rules = Rules {
            diameter: 1.0,
            min_radius: 0.0,
            most: 1.0,
            satisfied: 0.1,
            merge: 0.1,
            least: 3,
            grain: 1e-9,
        };
        let target = Target { points: &[], surface: &surface, rules: &rules };
        let spheres = [sphere(0.0, 0.5), sphere(1.0, 0.5), sphere(0.005, 0.501)];
        let groups = |n: [usize; 3]| n.map(|n| vec![Vec3::zeros(); n]);
        assert_eq!(target.needless(&spheres, &groups([2, 5, 1])), Some(2));
        assert_eq!(target.needless(&spheres, &groups([9, 5, 4])), Some(2));
        assert_eq!(target.needless(&spheres, &groups([4, 5, 9])), Some(0));
        assert_eq!(target.needless(&spheres[..2], &groups([9, 5, 4])), None);
        assert_eq!(target.needless(&spheres[..1], &groups([0, 0, 0])), None);
    }
}
