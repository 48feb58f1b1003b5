//! The distances of a brick of at most 4³ cells from its candidates.

use super::features::Features;
use super::regions::{self, FAR, Feature, Lanes, Points};
use super::space::{Brick, Parts, Space};
use super::split::Candidates;
use crate::math::Vec3;

/// Eight groups of at most 2³ cells.
struct Groups {
    parts: Parts,
    /// The cell centres of each group, and their squared distances.
    at: [Points; 8],
    best: [Lanes; 8],
}

/// Writes the distances of a brick, in shortest cell edges, into the block that holds it.
pub(super) fn fill(
    features: &Features,
    space: &Space,
    brick: &Brick,
    candidates: &Candidates,
    witness: &Vec3,
    block: &Brick,
    out: &mut [f32],
) {
    let parts = space.parts(brick);
    let mut at = [Points::default(); 8];
    for (at, part) in at.iter_mut().zip(&parts.bricks) {
        *at = space.corners(part);
    }
    let mut groups = Groups { parts, at, best: [Lanes::splat(FAR); 8] };
    groups.take(&features.faces, &candidates.faces);
    groups.take(&features.edges, &candidates.edges);
    groups.take(&features.corners, &candidates.corners);
    let [nx, ny, _] = block.size();
    let witness = regions::single(witness);
    for (g, part) in groups.parts.bricks.iter().enumerate() {
        if groups.parts.there >> g & 1 == 0 {
            continue;
        }
        // Only where rounding has opened a gap between regions.
        let last = regions::from_point(&witness, &groups.at[g]);
        let best = groups.best[g].fast_min(last).sqrt().to_array();
        let (i, width) = (part.lo[0] - block.lo[0], part.hi[0] - part.lo[0]);
        for l in part.lo[2]..part.hi[2] {
            for j in part.lo[1]..part.hi[1] {
                let row = i + nx * (j - block.lo[1] + ny * (l - block.lo[2]));
                let k = 2 * (j - part.lo[1]) + 4 * (l - part.lo[2]);
                out[row..row + width].copy_from_slice(&best[k..k + width]);
            }
        }
    }
}

impl Groups {
    /// Lowers the distances of the groups that the candidates' regions touch.
    #[inline(never)]
    fn take<F: Feature>(&mut self, features: &[F], candidates: &[u32]) {
        let (middle, half, there) = (self.parts.middle, self.parts.half, self.parts.there);
        for &i in candidates {
            let feature = &features[i as usize];
            let mut mark = regions::bits(feature.touches(&middle, half)) & there;
            while mark != 0 {
                let g = mark.trailing_zeros() as usize & 7;
                mark &= mark - 1;
                self.best[g] = feature.nearer(&self.at[g], self.best[g]);
            }
        }
    }
}
