//! Bricks of cells and where their cell centres lie.

use super::regions::{Points, rounding};
use crate::error::{Result, reserve};
use crate::math::Vec3;
use crate::solid::grid::Grid;

/// Cells `lo..hi` along each axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Brick {
    pub lo: [usize; 3],
    pub hi: [usize; 3],
}

impl Brick {
    pub(super) fn size(&self) -> [usize; 3] {
        let size = |a: usize| self.hi[a].saturating_sub(self.lo[a]);
        [size(0), size(1), size(2)]
    }

    pub(super) fn longest(&self) -> usize {
        let [x, y, z] = self.size();
        x.max(y).max(z)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.size().contains(&0)
    }

    /// Its eight parts, x fastest; some may be empty. The first is a cube of 2, 4, 8, 16 … cells
    /// where there are as many; the longest edge leaves something for the others.
    pub(super) fn parts(&self) -> [Brick; 8] {
        let mut parts = [*self; 8];
        let cube = (self.longest().next_power_of_two() / 2).max(2);
        for (a, n) in self.size().into_iter().enumerate() {
            let cut = self.lo[a] + n.min(cube);
            for (k, part) in parts.iter_mut().enumerate() {
                if k >> a & 1 == 0 {
                    part.hi[a] = cut;
                } else {
                    part.lo[a] = cut;
                }
            }
        }
        parts
    }
}

/// The eight parts of a brick, and what all of them have in common.
pub(super) struct Parts {
    pub bricks: [Brick; 8],
    /// Bits of the parts that are not empty.
    pub there: u8,
    /// Of the cell centres in each part: the middle, and the greatest half extents of any.
    pub middle: Points,
    pub half: [f32; 3],
}

/// Places of cell centres along each axis, in shortest cell edges from the grid's origin.
pub(super) struct Space {
    at: [Vec<f32>; 3],
    round: f32,
}

impl Space {
    pub(super) fn new(grid: &Grid, unit: f64) -> Result<Space> {
        let mut at = [Vec::new(), Vec::new(), Vec::new()];
        for (a, at) in at.iter_mut().enumerate() {
            let step = grid.spacing[a] / unit;
            *at = reserve("the places of cells", grid.dims[a])?;
            at.extend((0..grid.dims[a]).map(|i| ((i as f64 + 0.5) * step) as f32));
        }
        Ok(Space { at, round: rounding(longest(grid, unit)) })
    }

    /// First and last place of cells `lo..hi` along an axis; of none, any.
    #[inline(always)]
    fn ends(&self, a: usize, lo: usize, hi: usize) -> [f32; 2] {
        let at = |i: usize| self.at[a].get(i).copied().unwrap_or(0.0);
        [at(lo), at(hi.max(lo + 1) - 1)]
    }

    /// The outermost cell centres.
    #[inline(always)]
    pub(super) fn corners(&self, b: &Brick) -> Points {
        let ends = |a: usize| self.ends(a, b.lo[a], b.hi[a]);
        Points::new([ends(0), ends(1), ends(2)], self.round)
    }

    /// The middle of the cell centres.
    pub(super) fn middle(&self, b: &Brick) -> Vec3 {
        let middle = |a: usize| {
            let [lo, hi] = self.ends(a, b.lo[a], b.hi[a]);
            0.5 * (f64::from(lo) + f64::from(hi))
        };
        Vec3::new(middle(0), middle(1), middle(2))
    }

    pub(super) fn parts(&self, brick: &Brick) -> Parts {
        let bricks = brick.parts();
        let (mut middle, mut half) = ([[0.0f32; 2]; 3], [0.0f32; 3]);
        for (a, middle) in middle.iter_mut().enumerate() {
            for (side, part) in [bricks[0], bricks[7]].iter().enumerate() {
                let [lo, hi] = self.ends(a, part.lo[a], part.hi[a]);
                middle[side] = 0.5 * (lo + hi);
                half[a] = half[a].max(0.5 * (hi - lo));
            }
        }
        let mut there = 0;
        for (k, part) in bricks.iter().enumerate() {
            there |= u8::from(!part.is_empty()) << k;
        }
        Parts { bricks, there, middle: Points::new(middle, self.round), half }
    }
}

/// Cells of the shortest edge along the grid's longest one.
pub(super) fn longest(grid: &Grid, unit: f64) -> usize {
    let edge = |a: usize| (grid.dims[a] as f64 * grid.spacing[a] / unit).ceil() as usize;
    edge(0).max(edge(1)).max(edge(2))
}
