//! How many spheres one plane touches: what a wall does to a clump.

use crate::error::Result;
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use std::collections::BTreeSet;

use super::surface::direction;

/// Directions from which planes are lowered on the clump.
const DIRECTIONS: usize = 2048;
/// Spheres nearest to each such plane, of which each pair and triple gives a plane that
/// touches them exactly.
const NEAR: usize = 5;
/// Directions worked on together.
const CHUNK: usize = 64;
/// Gaps below this are rounding (unit frame).
const ROUNDING: f64 = 1e-12;

/// For each δ the most spheres whose gap to one supporting plane of the clump is at most δ.
///
/// A plane with outward normal u touches the clump at h(u) = max(c·u + r); the gap of a sphere
/// is h − (c·u + r). Looked at: [`DIRECTIONS`] directions, and for each the planes tangent to
/// the pairs and triples of the [`NEAR`] spheres nearest to its plane. A lower bound: exact
/// where the best plane is one of those.
pub(super) fn contacts(spheres: &[Sphere], tolerances: &[f64], run: &Run) -> Result<Vec<u32>> {
    // About the middle, so that heights do not lose digits.
    let middle = spheres.iter().map(|s| s.center).sum::<Vec3>() / spheres.len().max(1) as f64;
    let size = spheres.iter().map(|s| (s.center - middle).norm() + s.radius).fold(0.0, f64::max);
    let rounding = ROUNDING * size.max(1.0);
    let mut most = vec![0u32; tolerances.len()];
    // Between groups of chunks the caller may cancel; which group does not change the maximum.
    let chunks = DIRECTIONS / CHUNK;
    for group in 0..chunks.div_ceil(8) {
        run.check(0.0, "looking for plane contacts")?;
        let first = group * 8;
        let found = run.pool().map(8.min(chunks - first), |c| {
            of_chunk(spheres, &middle, tolerances, rounding, (first + c) * CHUNK)
        });
        for counts in &found {
            most.iter_mut().zip(counts).for_each(|(m, c)| *m = (*m).max(*c));
        }
    }
    Ok(most)
}

fn of_chunk(
    spheres: &[Sphere],
    middle: &Vec3,
    tolerances: &[f64],
    rounding: f64,
    first: usize,
) -> Vec<u32> {
    let mut most = vec![0u32; tolerances.len()];
    let mut heights = vec![0.0; spheres.len()];
    let mut tried = BTreeSet::new();
    let mut near: Vec<usize> = Vec::new();
    for k in first..first + CHUNK {
        let u = direction(k, DIRECTIONS);
        count(spheres, middle, &u, tolerances, rounding, &mut heights, &mut most);
        near.clear();
        near.extend(0..spheres.len());
        let higher = |i: &usize, j: &usize| heights[*j].total_cmp(&heights[*i]).then(i.cmp(j));
        if near.len() > NEAR {
            near.select_nth_unstable_by(NEAR, higher);
            near.truncate(NEAR);
        }
        near.sort_unstable();
        for (x, &i) in near.iter().enumerate() {
            for (y, &j) in near.iter().enumerate().skip(x + 1) {
                // A pair has a family of planes: the one nearest to u, so each u counts.
                if let Some(v) = tangent_to_two(&spheres[i], &spheres[j], &u) {
                    count(spheres, middle, &v, tolerances, rounding, &mut heights, &mut most);
                }
                for &l in near.iter().skip(y + 1) {
                    if !tried.insert((i, j, l)) {
                        continue;
                    }
                    let three = [&spheres[i], &spheres[j], &spheres[l]];
                    for v in tangent_to_three(three).into_iter().flatten() {
                        count(spheres, middle, &v, tolerances, rounding, &mut heights, &mut most);
                    }
                }
            }
        }
    }
    most
}

fn count(
    spheres: &[Sphere],
    middle: &Vec3,
    u: &Vec3,
    tolerances: &[f64],
    rounding: f64,
    heights: &mut [f64],
    most: &mut [u32],
) {
    let mut top = f64::MIN;
    for (h, s) in heights.iter_mut().zip(spheres) {
        *h = (s.center - middle).dot(u) + s.radius;
        top = top.max(*h);
    }
    for (m, delta) in most.iter_mut().zip(tolerances) {
        let least = top - delta - rounding;
        *m = (*m).max(heights.iter().filter(|h| **h >= least).count() as u32);
    }
}

/// The normal nearest to `u` of a plane that touches both spheres from the same side.
fn tangent_to_two(a: &Sphere, b: &Sphere, u: &Vec3) -> Option<Vec3> {
    let w = b.center - a.center;
    let d = w.norm();
    let step = a.radius - b.radius;
    if d <= step.abs() || d == 0.0 {
        return None;
    }
    let (axis, t) = (w / d, step / d);
    let side = u - axis * u.dot(&axis);
    let length = side.norm();
    (length > 1e-9).then(|| axis * t + side * ((1.0 - t * t).max(0.0).sqrt() / length))
}

/// The two normals of planes that touch all three spheres from the same side.
fn tangent_to_three([a, b, c]: [&Sphere; 3]) -> [Option<Vec3>; 2] {
    let (p, q) = (b.center - a.center, c.center - a.center);
    let (s, t) = (a.radius - b.radius, a.radius - c.radius);
    let (pp, qq, pq) = (p.norm_squared(), q.norm_squared(), p.dot(&q));
    let det = pp * qq - pq * pq;
    // Centres in a line have no plane of their own.
    if det <= 1e-18 * pp * qq || det <= 0.0 {
        return [None; 2];
    }
    let base = p * ((s * qq - t * pq) / det) + q * ((t * pp - s * pq) / det);
    let rest = 1.0 - base.norm_squared();
    if rest < 0.0 {
        return [None; 2];
    }
    let out = p.cross(&q) * (rest / det).sqrt();
    [Some(base + out), Some(base - out)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spheres(centers: &[[f64; 3]], r: f64) -> Vec<Sphere> {
        centers.iter().map(|&c| Sphere::new(Vec3::from(c), r)).collect()
    }

    fn most(s: &[Sphere], tolerances: &[f64]) -> Vec<u32> {
        contacts(s, tolerances, &Run::serial()).unwrap()
    }

    #[test]
    fn known_configurations() {
        let one = spheres(&[[0.1, 0.2, 0.3]], 0.2);
        assert_eq!(most(&one, &[0.0]), [1]);
        let line = spheres(&[0.0, 0.1, 0.2, 0.3, 0.4].map(|x| [x, 0.7 * x, -0.2 * x]), 0.07);
        assert_eq!(most(&line, &[0.0]), [5]);
        let square =
            spheres(&[[0.0, 0.0, 0.0], [0.3, 0.1, 0.0], [-0.1, 0.3, 0.0], [0.2, 0.4, 0.0]], 0.17);
        assert_eq!(most(&square, &[0.0]), [4]);
        let mut cube = Vec::new();
        for i in 0..8 {
            cube.push([0, 1, 2].map(|k| if i >> k & 1 == 1 { 0.9 } else { 0.1 }));
        }
        // All within a gap: from a face on to the whole.
        assert_eq!(most(&spheres(&cube, 0.1), &[0.0, 0.1, 0.81]), [4, 4, 8]);
    }

    #[test]
    fn a_plane_on_unequal_spheres() {
        // Radii grow along a line: the tangent plane leans, and still touches all.
        let line: Vec<Sphere> = (0..6)
            .map(|i| {
                let t = f64::from(i) / 6.0;
                Sphere::new(Vec3::new(t, 0.3 * t, 0.1 * t), 0.02 + 0.1 * t)
            })
            .collect();
        assert_eq!(most(&line, &[0.0]), [6]);
        // A tripod on a floor, and one sphere that hangs 0.01 above it.
        let mut s: Vec<Sphere> = [(0.0, 0.0, 0.1), (1.0, 0.1, 0.2), (0.2, 0.9, 0.15)]
            .map(|(x, y, r)| Sphere::new(Vec3::new(x, y, r), r))
            .to_vec();
        s.push(Sphere::new(Vec3::new(0.4, 0.3, 0.13), 0.12));
        assert_eq!(most(&s, &[0.0, 0.009, 0.0101]), [3, 3, 4]);
    }

    #[test]
    fn never_less_than_any_direction() {
        let s: Vec<Sphere> = (0..30)
            .map(|i| {
                let t = f64::from(i);
                let c = Vec3::new((t * 0.37).fract(), (t * 0.61).fract(), (t * 0.83).fract());
                Sphere::new(c, 0.05 + 0.1 * (t * 0.29).fract())
            })
            .collect();
        let found = most(&s, &[0.0, 0.01, 0.05]);
        assert!(found[0] >= 3 && found[0] <= found[1] && found[1] <= found[2]);
        let mut heights = vec![0.0; s.len()];
        for k in 0..20_000 {
            let mut best = vec![0; 2];
            let u = direction(k, 20_000);
            count(&s, &Vec3::zeros(), &u, &[0.01, 0.05], 0.0, &mut heights, &mut best);
            assert!(best[0] <= found[1] && best[1] <= found[2], "{best:?} {found:?}");
        }
    }
}
