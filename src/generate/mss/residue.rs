//! How many uncovered cells a box of cells holds at most, in constant time: sums over blocks.

use super::lattice::{Ball, Lattice};
use crate::error::{Result, filled};

/// Cells along each edge of a block.
const BLOCK: usize = 8;

/// Sums of uncovered solid cells over all blocks below a corner.
pub(super) struct Residue {
    /// Blocks along each axis, and one.
    dims: [usize; 3],
    step: [f64; 3],
    sums: Vec<u32>,
}

impl Residue {
    /// Counts the cells that are in `target` and not in `covered`.
    pub fn count(lattice: &Lattice, target: &[u64], covered: &[u64]) -> Result<Residue> {
        let dims = lattice.dims.map(|n| n.div_ceil(BLOCK) + 1);
        let mut sums = filled("the sums of uncovered cells", dims[0] * dims[1] * dims[2], 0u32)?;
        let words = target.iter().zip(covered).map(|(t, c)| t & !c);
        for (n, word) in words.enumerate().filter(|(_, w)| *w != 0) {
            let (row, w) = (n / lattice.words, n % lattice.words);
            let (j, k) = (row % lattice.dims[1], row / lattice.dims[1]);
            let at = dims[0] * (j / BLOCK + 1 + dims[1] * (k / BLOCK + 1)) + w * 8 + 1;
            for (b, byte) in word.to_le_bytes().into_iter().enumerate().filter(|(_, b)| *b != 0) {
                if let Some(sum) = sums.get_mut(at + b) {
                    *sum += byte.count_ones();
                }
            }
        }
        for (stride, axis) in [(1, 0), (dims[0], 1), (dims[0] * dims[1], 2)] {
            for n in stride..sums.len() {
                if n / stride % dims[axis] != 0 {
                    sums[n] += sums[n - stride];
                }
            }
        }
        Ok(Residue { dims, step: lattice.step, sums })
    }

    /// No fewer than the uncovered cells in the ball.
    pub fn bound(&self, ball: &Ball) -> f64 {
        let cut = |a: usize, reach: f64| {
            let n = (ball.center[a] + reach) / self.step[a] / BLOCK as f64;
            (n.max(0.0) as usize).min(self.dims[a] - 1)
        };
        let lo: [usize; 3] = std::array::from_fn(|a| cut(a, -ball.radius));
        let hi: [usize; 3] =
            std::array::from_fn(|a| (cut(a, ball.radius) + 1).min(self.dims[a] - 1));
        let mut sum = 0i64;
        for corner in 0..8 {
            let c: [usize; 3] =
                std::array::from_fn(|a| if corner >> a & 1 == 1 { hi[a] } else { lo[a] });
            let value = self.sums.get(c[0] + self.dims[0] * (c[1] + self.dims[1] * c[2]));
            let value = i64::from(value.copied().unwrap_or(0));
            sum += if (corner as u32).count_ones() % 2 == 1 { value } else { -value };
        }
        sum.max(0) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn never_fewer_than_there_are() {
        let l = Lattice::new([70, 19, 24], [1.0, 1.2, 0.9]);
        let mask: Vec<u8> = (0..70 * 19 * 24).map(|n| u8::from(n % 5 != 0 && n % 7 < 4)).collect();
        let target = l.pack(&mask).unwrap();
        let mut covered = vec![0u64; l.len()];
        l.cover(&Ball { center: [30.0, 10.0, 9.0], radius: 8.0 }, &target, &mut covered);
        let residue = Residue::count(&l, &target, &covered).unwrap();
        for (center, radius) in [
            ([35.0, 10.0, 10.0], 7.5),
            ([69.0, 18.0, 20.0], 5.0),
            ([0.0, 0.0, 0.0], 3.0),
            ([8.0, 9.6, 7.2], 0.4),
            ([30.0, 10.0, 9.0], 100.0),
        ] {
            let ball = Ball { center, radius };
            let exact = l.gain(&ball, &target, &covered).0 as f64;
            let bound = residue.bound(&ball);
            assert!(bound >= exact, "{ball:?}: {bound} and {exact}");
            if radius == 100.0 {
                assert_eq!(bound, exact);
            }
        }
    }
}
