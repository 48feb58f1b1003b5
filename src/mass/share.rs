//! What part of the union's volume each sphere stands for: where k spheres overlap, each has a
//! k-th of it.

use super::lattice::Lattice;
use super::pile::Pile;
use crate::error::{Result, collected, reserve};
use crate::math::Sphere;
use crate::run::Run;
use std::f64::consts::FRAC_PI_2;

/// Columns through a quarter of a sphere that has few neighbours, and at least. With four times
/// as many the share is about half a percent of the sphere's volume off.
const QUARTER: usize = 48;
const FEWEST: usize = 8;
/// Of more neighbours than this the columns become fewer, so that their chords do not become more.
const MANY: usize = 64;
/// Spheres worked on together.
const CHUNK: usize = 16;
/// Spheres between two looks at the caller's cancel.
const GROUP: usize = 1024;

/// The shares of the spheres of a pile, in its order and in its unit of volume; they are about 1 %
/// of the sphere's own volume off at most, and less together.
///
/// A sphere has columns of its own, parallel to z, each of which stands for the same part of the
/// disc; large ones with many neighbours share those of one lattice. Along the columns overlaps
/// are exact. All lie alike on both sides of the planes x = 0 and y = 0, and of z = 0, so that mirror images in
/// these planes have equal shares.
pub(super) fn shares(pile: &Pile, run: &Run) -> Result<Vec<f64>> {
    let lattice = Lattice::new(pile);
    let own = each(pile.spheres.len(), run, |i| {
        let s = &pile.spheres[i];
        let mut near = Vec::new();
        pile.neighbours(i, |_, o| {
            let d = o.center - s.center;
            near.push(([d.x, d.y, d.z], o.radius * o.radius));
        });
        let crowded = near.len() > MANY && lattice.resolves(s);
        (!crowded).then(|| share(s, &near))
    })?;
    if own.iter().all(Option::is_some) {
        return collected("shares", own.into_iter().flatten());
    }
    let common = lattice.shares(pile, run)?;
    collected("shares", own.iter().zip(common).map(|(own, common)| own.unwrap_or(common)))
}

/// `f(0), f(1), …, f(n−1)`, with looks at the caller's cancel between.
fn each<T: Send>(n: usize, run: &Run, f: impl Fn(usize) -> T + Sync + Send) -> Result<Vec<T>> {
    let mut out = reserve("shares", n)?;
    for first in (0..n).step_by(GROUP) {
        run.check(0.0, "sharing the volume among the spheres")?;
        let last = n.min(first + GROUP);
        let found = run.pool().map((last - first).div_ceil(CHUNK), |c| {
            let from = first + c * CHUNK;
            (from..last.min(from + CHUNK)).map(&f).collect::<Vec<_>>()
        });
        out.extend(found.into_iter().flatten());
    }
    Ok(out)
}

/// A neighbour: its centre from the sphere's, and its squared radius.
type Near = ([f64; 3], f64);

fn share(s: &Sphere, near: &[Near]) -> f64 {
    if near.is_empty() {
        return s.volume();
    }
    let (mut own, mut part) = (0.0, 0.0);
    let mut ends = Vec::new();
    let quarter = (QUARTER * MANY / near.len()).clamp(FEWEST, QUARTER);
    for k in 0..quarter {
        let rho = s.radius * ((k as f64 + 0.5) / quarter as f64).sqrt();
        let angle = FRAC_PI_2 * (0.618_033_988_749_894_9 * (k as f64 + 0.5)).fract();
        let (x, y) = (rho * angle.cos(), rho * angle.sin());
        let half = (s.radius * s.radius - rho * rho).sqrt();
        for (x, y) in [(x, y), (-x, y), (x, -y), (-x, -y)] {
            own += 2.0 * half;
            part += column(near, x, y, half, &mut ends);
        }
    }
    // A sphere may be too small to have a length.
    if own > 0.0 { s.volume() * part / own } else { 0.0 }
}

/// ∫ dz / k over −half..half, k the number of spheres there, the own one among them.
fn column(near: &[Near], x: f64, y: f64, half: f64, ends: &mut Vec<(f64, bool)>) -> f64 {
    ends.clear();
    for &([a, b, c], r2) in near {
        let h2 = r2 - (a - x) * (a - x) - (b - y) * (b - y);
        if h2 > 0.0 {
            let h = h2.sqrt();
            let (from, to) = ((c - h).max(-half), (c + h).min(half));
            if from < to {
                ends.push((from, true));
                ends.push((to, false));
            }
        }
    }
    ends.sort_unstable_by(|p, q| p.0.total_cmp(&q.0));
    let (mut sum, mut at, mut k) = (0.0, -half, 1i64);
    for &(z, begins) in ends.iter() {
        // Ends that are equal may come in any order; k is never below 1 over a length.
        sum += (z - at) / k.max(1) as f64;
        at = z;
        k += if begins { 1 } else { -1 };
    }
    sum + (half - at) / k.max(1) as f64
}

#[cfg(test)]
#[path = "share_tests.rs"]
mod tests;
