//! The first few spheres settle: after each addition, each moves to where D is
//! least with the others as they are. A place that was best for the first two
//! spheres is poor once there are five (on an ellipsoid the mismatch of five
//! spheres falls by half); with more, the next spheres make up for it.

use super::counts::Counts;
use super::lattice::{Ball, Lattice};
use super::select::{Pool, stop};
use super::target::Target;
use crate::run::Run;

/// Up to this many spheres settle.
pub(super) const SETTLING: usize = 10;

/// First step of a move, as a part of the radius.
const STRIDE: f64 = 0.25;

/// Moves each orbit in turn, until the caller or the deadline ends it; `covered` and `counts`
/// follow, `spare` is as long as `covered`. D never rises. Whether an orbit moved.
pub(super) fn settle(
    pool: &Pool,
    target: &Target,
    orbits: &mut [Vec<Ball>],
    [covered, spare]: [&mut [u64]; 2],
    counts: &mut Counts,
    run: &Run,
) -> bool {
    let mut any = false;
    for n in 0..orbits.len() {
        if orbits.first().is_some_and(|first| stop(run, first)) {
            break;
        }
        covered.fill(0);
        let mut rest = Counts { target: target.cells, ..Counts::default() };
        let mut others = Vec::new();
        for (m, orbit) in orbits.iter().enumerate() {
            if m != n {
                rest = rest.with(cover(&target.lattice, orbit, target, covered));
                others.extend(orbit.iter().copied());
            }
        }
        let Some(orbit) = orbits.get_mut(n) else { continue };
        if let Some(moved) = moved(pool, target, orbit, covered, &rest, &others) {
            spare.copy_from_slice(covered);
            let next = rest.with(cover(&target.lattice, &moved, target, spare));
            if next.mismatch() < counts.mismatch() {
                *counts = next;
                *orbit = moved;
                covered.copy_from_slice(spare);
                any = true;
                continue;
            }
        }
        cover(&target.lattice, orbit, target, covered);
    }
    any
}

fn cover(lattice: &Lattice, orbit: &[Ball], target: &Target, covered: &mut [u64]) -> (u64, u64) {
    orbit.iter().fold((0, 0), |sum, ball| {
        let gain = lattice.cover(ball, &target.bits, covered);
        (sum.0 + gain.0, sum.1 + gain.1)
    })
}

/// The orbit where a search along the axes finds the least D; `None` when it stays.
fn moved(
    pool: &Pool,
    target: &Target,
    orbit: &[Ball],
    covered: &[u64],
    rest: &Counts,
    others: &[Ball],
) -> Option<Vec<Ball>> {
    let start = *orbit.first()?;
    let size = orbit.len() as f64;
    let try_at = |center: &[f64; 3]| {
        let (orbit, gain) = pool.trial(target, covered, others, center)?;
        (orbit.len() as f64 == size).then(|| {
            let inside = rest.inside as f64 + size * gain.0;
            let all = rest.target as f64 + rest.outside as f64 + inside + size * gain.1;
            (orbit, 1.0 - 2.0 * inside / all)
        })
    };
    let (_, mut least) = try_at(&start.center)?;
    let mut here = start.center;
    let mut best = None;
    let mut stride = (start.radius * STRIDE).max(1.0);
    while stride >= 0.5 {
        let mut found = None;
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let mut p = here;
                p[axis] += sign * stride;
                if let Some((orbit, d)) = try_at(&p)
                    && d < least
                {
                    least = d;
                    found = Some(orbit);
                }
            }
        }
        match found {
            Some(orbit) => {
                here = orbit.first()?.center;
                best = Some(orbit);
            }
            None => stride *= 0.5,
        }
    }
    best
}
