//! What part of the union's volume each sphere stands for: where k spheres overlap, each has a
//! k-th of it.

use super::pile::Pile;
use crate::error::{Result, reserve};
use crate::run::Run;
use std::f64::consts::FRAC_PI_2;

/// Columns through a quarter of each sphere. With four times as many as this the shares are
/// about 1e-3 of the sphere's volume off, whatever its size.
const QUARTER: usize = 48;
/// Spheres worked on together.
const CHUNK: usize = 16;
/// Spheres between two looks at the caller's cancel.
const GROUP: usize = 1024;

/// The shares of the spheres of a pile, in its order and in its unit of volume.
///
/// Each sphere is cut by columns of its own, parallel to z, each of which stands for the same
/// part of the disc; along them the overlaps are exact. They lie alike on both sides of the
/// planes x = 0 and y = 0 through the sphere's centre, and of z = 0, so that mirror images about
/// planes of the frame have equal shares.
pub(super) fn shares(pile: &Pile, run: &Run) -> Result<Vec<f64>> {
    let n = pile.spheres.len();
    let mut out = reserve("shares", n)?;
    for first in (0..n).step_by(GROUP) {
        run.check(0.0, "sharing the volume among the spheres")?;
        let last = n.min(first + GROUP);
        let found = run.pool().map((last - first).div_ceil(CHUNK), |c| {
            let from = first + c * CHUNK;
            let mut near = Vec::new();
            (from..last.min(from + CHUNK)).map(|i| share(pile, i, &mut near)).collect::<Vec<_>>()
        });
        out.extend(found.into_iter().flatten());
    }
    Ok(out)
}

/// A neighbour: its centre from the sphere's, and its squared radius.
type Near = ([f64; 3], f64);

fn share(pile: &Pile, i: usize, near: &mut Vec<Near>) -> f64 {
    let s = &pile.spheres[i];
    near.clear();
    pile.neighbours(i, |_, o| {
        let d = o.center - s.center;
        near.push(([d.x, d.y, d.z], o.radius * o.radius));
    });
    if near.is_empty() {
        return s.volume();
    }
    let (mut own, mut part) = (0.0, 0.0);
    let mut ends = Vec::new();
    for k in 0..QUARTER {
        let rho = s.radius * ((k as f64 + 0.5) / QUARTER as f64).sqrt();
        let angle = FRAC_PI_2 * (0.618_033_988_749_894_9 * (k as f64 + 0.5)).fract();
        let (x, y) = (rho * angle.cos(), rho * angle.sin());
        let half = (s.radius * s.radius - rho * rho).sqrt();
        for (x, y) in [(x, y), (-x, y), (x, -y), (-x, -y)] {
            own += 2.0 * half;
            part += column(near, x, y, half, &mut ends);
        }
    }
    s.volume() * part / own
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
        sum += (z - at) / k as f64;
        at = z;
        k += if begins { 1 } else { -1 };
    }
    // Ends that are equal may come in any order: k is never below 1 over a length.
    sum + (half - at) / k.max(1) as f64
}

#[cfg(test)]
#[path = "share_tests.rs"]
mod tests;
