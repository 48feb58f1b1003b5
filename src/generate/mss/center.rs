//! Where exactly the centre of a sphere at a maximum of E lies.

use super::subvoxel::along_axis;
use super::target::Target;

/// Steps of the search after the lines, in cells: the first, and the least.
const STEPS: [f64; 2] = [0.25, 0.01];

/// A gain in depth that is no rounding, in cells: without it the place on a plateau would hang on
/// the last bits, that change with the unit.
const GAIN: f64 = 1e-6;

/// Along the axes and the diagonals.
const WAYS: [[f64; 3]; 14] = [
    [-1.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, -1.0],
    [0.0, 0.0, 1.0],
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];

/// Most such steps: a place is hardly a cell off.
const MOST: usize = 32;

/// A maximum of E made exact: the lines of section 3.3 on the true depth about the point, with
/// the grid moved to it and made finer, as the paper suggests; then small steps while they
/// lead deeper, since lines are exact for cones only.
pub(super) fn refined(target: &Target, center: &[f64; 3]) -> [f64; 3] {
    let at = |p: &[f64; 3]| if target.solid_at(p) { target.depth(p) } else { 0.0 };
    let mut here = *center;
    target.mirrors.snap(&mut here);
    let mut depth = at(&here);
    for width in [1.0, 0.5, 0.25] {
        let mut next = here;
        for a in 0..3 {
            let step = width * target.lattice.step[a];
            let e = std::array::from_fn(|n| {
                let mut q = here;
                q[a] += (n as f64 - 2.0) * step;
                at(&q)
            });
            next[a] += along_axis(&e).0 * step;
        }
        target.mirrors.snap(&mut next);
        let deeper = at(&next);
        if deeper <= depth + GAIN {
            break;
        }
        (here, depth) = (next, deeper);
    }
    let mut step = STEPS[0];
    for _ in 0..MOST {
        if step < STEPS[1] {
            break;
        }
        let (mut deeper, mut best) = (None, depth);
        for to in WAYS {
            let mut next: [f64; 3] =
                std::array::from_fn(|a| here[a] + to[a] * step * target.lattice.step[a]);
            target.mirrors.snap(&mut next);
            let there = at(&next);
            if there > best + GAIN {
                (deeper, best) = (Some(next), there);
            }
        }
        match deeper {
            Some(next) => (here, depth) = (next, best),
            None => step *= 0.5,
        }
    }
    here
}
