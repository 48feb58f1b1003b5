//! Cells as bits, row by row, and spheres on them: which cells of a sphere are
//! new, inside and outside of the target. Popcounts of row intervals make one
//! sphere cost as many steps as it has rows, not cells.

use crate::error::{Result, filled};

/// A sphere on the lattice: cell (i, j, k) has its centre at `(i, j, k) * step`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::generate) struct Ball {
    pub center: [f64; 3],
    pub radius: f64,
}

pub(super) fn distance_squared(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

/// An estimate takes this many rows across the radius.
const ROWS: f64 = 10.0;

/// Rows of cells along x, 64 to a word.
#[derive(Debug, Clone, Copy)]
pub(in crate::generate) struct Lattice {
    pub dims: [usize; 3],
    /// Edge lengths of a cell; all exactly 1 when the cells are cubes.
    pub step: [f64; 3],
    /// Words of a row.
    pub words: usize,
}

/// A stretch of a row, both ends included.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::generate) struct Span {
    pub row: usize,
    pub first: usize,
    pub last: usize,
}

impl Lattice {
    pub fn new(dims: [usize; 3], step: [f64; 3]) -> Self {
        Lattice { dims, step, words: dims[0].div_ceil(64) }
    }

    /// Number of words of a bit array.
    pub fn len(&self) -> usize {
        self.words * self.dims[1] * self.dims[2]
    }

    /// The bits of a mask with one byte a cell.
    pub fn pack(&self, mask: &[u8]) -> Result<Vec<u64>> {
        let mut bits = filled("the bits of the target", self.len(), 0u64)?;
        let rows = mask.chunks_exact(self.dims[0].max(1));
        for (row, out) in rows.zip(bits.chunks_exact_mut(self.words.max(1))) {
            for (cells, word) in row.chunks(64).zip(out) {
                *word = cells.iter().enumerate().fold(0, |w, (b, &c)| w | (u64::from(c != 0) << b));
            }
        }
        Ok(bits)
    }

    /// Whether the bit of cell (i, j, k) is set; cells beyond the array are not.
    pub fn get(&self, bits: &[u64], i: usize, j: usize, k: usize) -> bool {
        i < self.dims[0]
            && j < self.dims[1]
            && k < self.dims[2]
            && bits
                .get(i / 64 + self.words * (j + self.dims[1] * k))
                .is_some_and(|w| w >> (i % 64) & 1 == 1)
    }

    /// The cells whose centres lie in the ball, as stretches of rows, in order.
    pub fn spans(&self, ball: &Ball, visit: impl FnMut(Span)) {
        self.some_spans(ball, 1, &[f64::INFINITY; 3], visit);
    }

    /// The same for every `stride`-th row along y and z, up to the cell `most` on each axis.
    fn some_spans(&self, ball: &Ball, stride: usize, most: &[f64; 3], mut visit: impl FnMut(Span)) {
        let stride = stride as f64;
        let on = |n: f64| ceil(n / stride) * stride;
        let r2 = ball.radius * ball.radius;
        let range = |a: usize, reach: f64| {
            let lo = ceil((ball.center[a] - reach) / self.step[a]).max(0.0);
            let hi = -ceil(-(ball.center[a] + reach) / self.step[a]);
            (lo, hi.min(most[a]).min(self.dims[a] as f64 - 1.0))
        };
        let (k0, k1) = range(2, ball.radius);
        let mut k = on(k0);
        while k <= k1 {
            let dz = k * self.step[2] - ball.center[2];
            let left = r2 - dz * dz;
            if left >= 0.0 {
                let (j0, j1) = range(1, left.sqrt());
                let mut j = on(j0);
                while j <= j1 {
                    let dy = j * self.step[1] - ball.center[1];
                    let rest = left - dy * dy;
                    if rest >= 0.0 {
                        let (i0, i1) = range(0, rest.sqrt());
                        if i0 <= i1 {
                            visit(Span {
                                row: j as usize + self.dims[1] * k as usize,
                                first: i0 as usize,
                                last: i1 as usize,
                            });
                        }
                    }
                    j += stride;
                }
            }
            k += stride;
        }
    }

    /// How many cells of the stretch are not in `covered`, in and out of `target`.
    pub fn fresh(&self, span: &Span, target: &[u64], covered: &[u64]) -> (u64, u64) {
        let base = span.row * self.words;
        let (w0, w1) = (span.first / 64, span.last / 64);
        let (Some(t), Some(c)) =
            (target.get(base + w0..=base + w1), covered.get(base + w0..=base + w1))
        else {
            return (0, 0);
        };
        let (mut inside, mut outside) = (0u64, 0u64);
        for n in 0..t.len().min(c.len()) {
            let free = mask_of(span, w0 + n) & !c[n];
            // Counting bits takes a dozen steps where the processor may be an old one.
            if free & t[n] != 0 {
                inside += u64::from((free & t[n]).count_ones());
            }
            if free & !t[n] != 0 {
                outside += u64::from((free & !t[n]).count_ones());
            }
        }
        (inside, outside)
    }

    /// New cells of one ball, in and out of `target`.
    pub fn gain(&self, ball: &Ball, target: &[u64], covered: &[u64]) -> (u64, u64) {
        let mut sum = (0, 0);
        self.spans(ball, |s| {
            let g = self.fresh(&s, target, covered);
            sum = (sum.0 + g.0, sum.1 + g.1);
        });
        sum
    }

    /// About how many new cells a ball has up to the cells `most`, from some of its rows: always
    /// the same ones, so that the figure never grows while `covered` does.
    pub fn estimate(
        &self,
        ball: &Ball,
        most: &[f64; 3],
        target: &[u64],
        covered: &[u64],
    ) -> (f64, f64) {
        let stride = ((ball.radius / ROWS) as usize).clamp(1, 16);
        let mut sum = (0, 0);
        self.some_spans(ball, stride, most, |s| {
            let g = self.fresh(&s, target, covered);
            sum = (sum.0 + g.0, sum.1 + g.1);
        });
        let each = (stride * stride) as f64;
        (sum.0 as f64 * each, sum.1 as f64 * each)
    }

    /// Sets the cells of the ball; returns how many were new, in and out of `target`.
    pub fn cover(&self, ball: &Ball, target: &[u64], covered: &mut [u64]) -> (u64, u64) {
        let mut sum = (0, 0);
        self.spans(ball, |s| {
            let g = self.fresh(&s, target, covered);
            sum = (sum.0 + g.0, sum.1 + g.1);
            let base = s.row * self.words;
            let (w0, w1) = (s.first / 64, s.last / 64);
            for (n, word) in
                covered.get_mut(base + w0..=base + w1).unwrap_or(&mut []).iter_mut().enumerate()
            {
                *word |= mask_of(&s, w0 + n);
            }
        });
        sum
    }
}

/// The whole number at or above a number of cells. `f64::ceil` is a call into the C library where
/// the processor may be an old one, and there are two for every row.
fn ceil(x: f64) -> f64 {
    let below = x as i64 as f64;
    if below < x { below + 1.0 } else { below }
}

/// The bits of word `w` that belong to the stretch.
fn mask_of(span: &Span, w: usize) -> u64 {
    let lo = span.first.saturating_sub(w * 64);
    let hi = (span.last - w * 64).min(63);
    (u64::MAX << lo) & (u64::MAX >> (63 - hi))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gains_are_the_cells_whose_centres_lie_in_the_ball() {
        let l = Lattice::new([130, 9, 8], [1.0, 1.5, 0.75]);
        let at = |i: usize, j: usize, k: usize| i + 130 * (j + 9 * k);
        let mut mask = vec![0u8; 130 * 9 * 8];
        for (n, m) in mask.iter_mut().enumerate() {
            *m = u8::from(n % 7 < 3);
        }
        let target = l.pack(&mask).unwrap();
        let mut covered = vec![0u64; l.len()];
        let mut seen = vec![0u8; mask.len()];
        let balls = [
            Ball { center: [63.5, 5.0, 2.0], radius: 4.2 },
            Ball { center: [66.0, 6.5, 3.0], radius: 3.0 },
            Ball { center: [-1.0, 0.0, 0.0], radius: 2.5 },
            Ball { center: [129.0, 12.0, 5.25], radius: 9.0 },
        ];
        for b in &balls {
            let mut expected = (0, 0);
            for k in 0..8 {
                for j in 0..9 {
                    for i in 0..130 {
                        let p = [i as f64, j as f64 * 1.5, k as f64 * 0.75];
                        if distance_squared(&p, &b.center) <= b.radius * b.radius
                            && seen[at(i, j, k)] == 0
                        {
                            seen[at(i, j, k)] = 1;
                            if mask[at(i, j, k)] == 1 { expected.0 += 1 } else { expected.1 += 1 }
                        }
                    }
                }
            }
            assert_eq!(l.gain(b, &target, &covered), expected);
            assert_eq!(l.cover(b, &target, &mut covered), expected);
        }
        for k in 0..8 {
            for j in 0..9 {
                for i in 0..130 {
                    assert_eq!(l.get(&covered, i, j, k), seen[at(i, j, k)] == 1);
                }
            }
        }
    }
}
