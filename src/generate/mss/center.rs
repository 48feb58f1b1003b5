//! Where exactly the centre of a sphere at a maximum of E lies.

use super::subvoxel::along_axis;
use super::target::Target;

/// A maximum of E made exact: the lines of section 3.3 on the true depth about the point, with
/// the grid moved to it and made finer, as the paper suggests.
pub(super) fn refined(target: &Target, center: &[f64; 3]) -> [f64; 3] {
    let mut here = *center;
    target.mirrors.snap(&mut here);
    let mut depth = target.depth(&here);
    for width in [1.0, 0.5, 0.25] {
        let mut next = here;
        for a in 0..3 {
            let step = width * target.lattice.step[a];
            let e = std::array::from_fn(|n| {
                let mut q = here;
                q[a] += (n as f64 - 2.0) * step;
                if target.solid_at(&q) { target.depth(&q) } else { 0.0 }
            });
            next[a] += along_axis(&e).0 * step;
        }
        target.mirrors.snap(&mut next);
        let deeper = if target.solid_at(&next) { target.depth(&next) } else { 0.0 };
        if deeper <= depth {
            break;
        }
        (here, depth) = (next, deeper);
    }
    here
}
