//! Random four-point spheres and their culling (Price et al. 2007, sections 2.1.1 and 2.1.2).

use super::draw::Draw;
use super::four_point::{FourPoints, through};
use super::hull::Hull;
use super::points::Points;
use super::rules::Rules;
use crate::error::{Result, push, reserve};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::solid::nearest::Surface;

/// Quadruples of a round, and those worked on together.
const ROUND: usize = 4096;
const CHUNK: usize = 64;
/// Most rounds.
const ROUNDS: usize = 30;
/// Sampling ends when no more than this part of the points is left.
const LEFT: f64 = 0.01;
/// Every second quadruple comes from a window of the list, at least so wide.
const WINDOW: usize = 12;
/// The stream of random numbers.
const STREAM: u64 = 2;

/// Decides which spheres are of use.
pub(super) struct Sieve<'a> {
    pub hull: &'a Hull,
    pub surface: &'a Surface,
    pub points: &'a [Vec3],
    pub rules: &'a Rules,
}

impl Sieve<'_> {
    /// Whether a sphere touches the surface from inside to within a tolerance: it reaches no
    /// farther beyond the hull (eq 7 with the other side), nor beyond the surface itself, is no
    /// farther from it (eq 7; for a convex body the distance to the hull is that to the surface),
    /// and its centre lies inside.
    pub fn keeps(&self, s: &Sphere) -> bool {
        let rules = self.rules;
        if !(s.radius >= rules.min_radius && s.radius <= rules.most) {
            return false;
        }
        let slack = rules.slack(s.radius);
        let enough = s.radius - slack;
        if self.hull.depth(&s.center, enough) < enough {
            return false;
        }
        // The nearest of the points: as exact as their distance is small beside the radius, and no
        // wall inside the body counts.
        let near =
            self.points.iter().map(|p| (p - s.center).norm_squared()).fold(f64::MAX, f64::min);
        let near = near.sqrt();
        near >= enough && near <= s.radius + slack && self.surface.contains(&s.center)
    }
}

/// What the sampling came to.
pub(super) struct Sampled {
    pub spheres: Vec<Sphere>,
    /// Quadruples drawn.
    pub drawn: u64,
}

/// Draws spheres until nearly every point is close to one. `go` is asked before each round but the
/// first, with whether there is a sphere.
pub(super) fn sample(
    points: &Points,
    sieve: &Sieve,
    run: &Run,
    go: &mut impl FnMut(f64, bool) -> bool,
) -> Result<Sampled> {
    let mut left: Vec<u32> = reserve("the list of points", points.at.len())?;
    left.extend(0..points.at.len() as u32);
    let enough = (points.at.len() as f64 * LEFT) as usize;
    let mut out = Sampled { spheres: Vec::new(), drawn: 0 };
    for round in 0..ROUNDS {
        if left.len() <= enough.max(3) {
            break;
        }
        if !go(round as f64 / ROUNDS as f64, !out.spheres.is_empty()) {
            break;
        }
        let seed = run.seed();
        let found = run.pool().map(ROUND / CHUNK, |c| {
            let places = (c * CHUNK..(c + 1) * CHUNK).map(|i| (round * ROUND + i) as u64);
            let grain = sieve.rules.grain;
            let spheres = places.filter_map(|p| draw(points, &left, seed, p, grain));
            spheres.filter(|s| sieve.keeps(s)).collect::<Vec<Sphere>>()
        });
        out.drawn += ROUND as u64;
        let first = out.spheres.len();
        for s in found.into_iter().flatten() {
            push("four-point spheres", &mut out.spheres, s)?;
        }
        let fresh = out.spheres.get(first..).unwrap_or_default();
        let tolerance = sieve.rules.satisfied;
        left.retain(|&i| {
            let p = points.at.get(i as usize).copied().unwrap_or_default();
            !fresh.iter().any(|s| ((p - s.center).norm() - s.radius).abs() <= tolerance)
        });
    }
    Ok(out)
}

/// One sphere, if four points make one.
fn draw(points: &Points, left: &[u32], seed: u64, place: u64, grain: f64) -> Option<Sphere> {
    let mut draw = Draw::new(seed, STREAM, place);
    let n = left.len();
    // Four of the whole list, or of a window of it of any width: neighbours on the surface.
    let (mut from, mut width) = (0, n);
    if place % 2 == 1 {
        let halvings = (n / WINDOW).max(1).ilog2() as usize + 1;
        width = (n >> draw.below(halvings)).max(4).min(n);
        from = draw.below(n - width + 1);
    }
    let mut corner = || {
        let i = left.get(from + draw.below(width))?;
        points.at.get(*i as usize).copied()
    };
    match through(&[corner()?, corner()?, corner()?, corner()?], grain) {
        FourPoints::Sphere(s) => Some(s),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Body, Voxels, samples};

    fn with_sieve(body: &Body, test: impl FnOnce(&Points, &Sieve)) {
        let run = Run::serial();
        let surface = Surface::new(body).unwrap();
        let points = Points::new(body, &surface, u64::MAX, &run).unwrap();
        let hull = Hull::new(&points.at, &points.normals, &run).unwrap();
        let rules = Rules {
            diameter: 1.0,
            min_radius: 0.05,
            most: 1.0,
            satisfied: 0.02,
            merge: 0.2,
            least: 100,
            grain: 1e-9,
        };
        test(&points, &Sieve { hull: &hull, surface: &surface, points: &points.at, rules: &rules });
    }

    fn sphere(x: f64, y: f64, z: f64, radius: f64) -> Sphere {
        Sphere::new(Vec3::new(x, y, z), radius)
    }

    #[test]
    fn spheres_that_touch_a_cube_from_inside_are_kept() {
        with_sieve(&Body::Mesh(samples::cuboid([0.0; 3], [1.0; 3])), |_, sieve| {
            for (s, kept) in [
                (sphere(0.5, 0.5, 0.5, 0.5), true),
                (sphere(0.3, 0.3, 0.3, 0.3), true),
                (sphere(0.5, 0.5, 0.5, 0.52), true),
                // Beyond the surface, not up to it, outside, too small.
                (sphere(0.5, 0.5, 0.5, 0.56), false),
                (sphere(0.5, 0.5, 0.5, 0.44), false),
                (sphere(1.3, 0.5, 0.5, 0.3), false),
                (sphere(0.04, 0.5, 0.5, 0.04), false),
            ] {
                assert_eq!(sieve.keeps(&s), kept, "{s:?}");
            }
        });
    }

    #[test]
    fn a_sphere_in_a_notch_lies_in_the_hull_and_not_in_the_body() {
        // An L of 1 × 1 × 0.5.
        let dims = [20, 20, 10];
        let cell = |i: usize| u8::from(i % 20 < 10 || i / 20 % 20 < 10);
        let cells = (0..4000).map(cell).collect();
        let body = Body::Voxels(Voxels { dims, spacing: Vec3::repeat(0.05), cells });
        with_sieve(&body, |_, sieve| {
            let notch = sphere(0.62, 0.62, 0.25, 0.12);
            assert!(sieve.hull.depth(&notch.center, 0.0) > 0.15);
            assert!(!sieve.keeps(&notch));
            assert!(sieve.keeps(&sphere(0.25, 0.25, 0.25, 0.25)));
            // Over the edge of the notch: inside, within the hull, beyond the body.
            let over = sphere(0.4, 0.6, 0.25, 0.2);
            assert!(sieve.hull.depth(&over.center, 0.0) > 0.2 && !sieve.keeps(&over));
        });
    }

    #[test]
    fn points_stand_evenly_and_every_kept_sphere_touches() {
        let mut mesh = samples::cuboid([0.0; 3], [1.0, 0.5, 0.25]);
        // One part of it far finer than the rest.
        let [a, b, c] = mesh.faces[0];
        let middle = mesh.vertices.len() as u32;
        mesh.vertices.push((mesh.vertices[a as usize] + mesh.vertices[b as usize]) * 0.5);
        mesh.faces[0] = [a, middle, c];
        mesh.faces.push([middle, b, c]);
        mesh.clean = false;
        with_sieve(&Body::Mesh(mesh), |points, sieve| {
            // Areas of the sides: 0.5, 0.25 and 0.125, of 1.75 in all.
            for (axis, area) in [0.125, 0.25, 0.5].into_iter().enumerate() {
                let n = points.normals.iter().filter(|n| n[axis].abs() > 0.5).count();
                let expected = points.at.len() as f64 * 2.0 * area / 1.75;
                assert!((n as f64 - expected).abs() < 8.0, "{axis}: {n} {expected}");
            }
            let run = Run::serial();
            let sampled = sample(points, sieve, &run, &mut |_, _| true).unwrap();
            assert!(sampled.spheres.len() > 20 && sampled.drawn > 0);
            assert!(sampled.spheres.iter().all(|s| {
                let depth = s.center.inf(&(Vec3::new(1.0, 0.5, 0.25) - s.center)).min();
                (depth - s.radius).abs() < 0.04
            }));
            let mut rounds = 0;
            let stopped = sample(points, sieve, &run, &mut |_, _| {
                rounds += 1;
                rounds < 2
            });
            assert!(stopped.unwrap().drawn <= ROUND as u64);
        });
    }
}
