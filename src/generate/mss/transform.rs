//! The Euclidean distance transform of a bit array, for the transforms that
//! MSS repeats in every round. Same result as [`crate::solid::edt`], but only
//! the set cells are worked on: a run of set cells along an axis sees nothing
//! beyond the two empty cells at its ends, since these are nearer.

use super::lattice::Lattice;
use crate::error::{Result, reserve};
use crate::run::Pool;

/// Columns that are transformed together, so that whole cache lines are read; a part of a word.
const BLOCK: usize = 16;

/// Writes into `out` the distance (not squared) from each set cell to the
/// nearest empty one, 0 for empty cells. Cells beyond the array are empty. What is written at
/// or above `most` along x or y means nothing: it is not wanted where mirror images are known.
pub(super) fn distance(
    lattice: &Lattice,
    bits: &[u64],
    most: [usize; 3],
    out: &mut [f32],
    pool: &Pool,
) -> Result<()> {
    let [nx, ny, nz] = lattice.dims;
    let slab = nx * ny;
    if slab == 0 || nz == 0 {
        return Ok(());
    }
    let word = |row: usize, w: usize| bits.get(lattice.words * row + w).copied().unwrap_or(0);
    pool.chunks_mut(out, slab, |k, slab| {
        let start = k * ny * lattice.words;
        let rows = bits.get(start..start + ny * lattice.words).unwrap_or(&[]);
        for (row, words) in slab.chunks_exact_mut(nx).zip(rows.chunks_exact(lattice.words)) {
            along_x(row, words, lattice.step[0]);
        }
        let mut work = Columns::new(ny, lattice.step[1]);
        let mut rows: Vec<&mut [f32]> = slab.chunks_exact_mut(nx).collect();
        work.transform(&mut rows, most[0], false, |j, w| word(j + ny * k, w));
    });
    // The rows with the same j, across all slabs, belong together along z.
    let planes = (0..ny).map(|_| reserve("the rows of the transform", nz));
    let mut planes = planes.collect::<Result<Vec<Vec<&mut [f32]>>>>()?;
    for (n, row) in out.chunks_exact_mut(nx).enumerate() {
        if let Some(plane) = planes.get_mut(n % ny) {
            plane.push(row);
        }
    }
    planes.truncate(most[1]);
    pool.chunks_mut(&mut planes, 1, |j, plane| {
        for rows in plane {
            let mut work = Columns::new(nz, lattice.step[2]);
            work.transform(rows, most[0], true, |k, w| word(j + ny * k, w));
        }
    });
    Ok(())
}

/// Squared distance to the nearest empty cell of the row.
fn along_x(row: &mut [f32], words: &[u64], step: f64) {
    row.fill(0.0);
    let n = row.len();
    let set = |i: usize| words.get(i / 64).is_some_and(|w| w >> (i % 64) & 1 == 1);
    let mut i = 0;
    while i < n {
        // The next set cell, a word at a time.
        let rest = words.get(i / 64).map_or(0, |w| w >> (i % 64));
        if rest == 0 {
            i = (i / 64 + 1) * 64;
            continue;
        }
        let first = i + rest.trailing_zeros() as usize;
        let mut end = first;
        while end < n && set(end) {
            end += 1;
        }
        let len = end.saturating_sub(first);
        for (t, v) in row.get_mut(first..end).unwrap_or(&mut []).iter_mut().enumerate() {
            let d = (t + 1).min(len - t) as f64 * step;
            *v = (d * d) as f32;
        }
        i = end.max(first + 1);
    }
}

/// Scratch space for columns across rows.
struct Columns {
    step2: f64,
    block: Vec<f32>,
    envelope: Vec<Parabola>,
    /// 1 / 2d for every distance d of two cells of a run.
    halves: Vec<f64>,
}

/// A piece of the lower envelope.
#[derive(Clone, Copy, Default)]
struct Parabola {
    site: f64,
    height: f64,
    /// Height at position 0.
    base: f64,
    /// Where the piece begins.
    from: f64,
}

impl Columns {
    fn new(n: usize, step: f64) -> Self {
        Columns {
            step2: step * step,
            block: vec![0.0; n * BLOCK],
            envelope: vec![Parabola::default(); n + 2],
            halves: (0..n + 2).map(|d| 0.5 / d.max(1) as f64).collect(),
        }
    }

    /// Transforms the columns across `rows` below `most`; takes the square root when this is
    /// the last axis. `word(t, w)` is the word `w` of the bits of row `t`.
    fn transform(
        &mut self,
        rows: &mut [&mut [f32]],
        most: usize,
        last: bool,
        word: impl Fn(usize, usize) -> u64,
    ) {
        let n = rows.len();
        let width = rows.first().map_or(0, |r| r.len()).min(most);
        for x0 in (0..width).step_by(BLOCK) {
            // Only the rows between the first and the last set cell of the block.
            let set = |t: &usize| word(*t, x0 / 64) >> (x0 % 64) & 0xffff != 0;
            let (Some(first), Some(end)) = ((0..n).find(set), (0..n).rev().find(set)) else {
                continue;
            };
            let w = BLOCK.min(width - x0);
            let Some(rows) = rows.get_mut(first..=end) else { continue };
            let n = rows.len();
            for (t, row) in rows.iter().enumerate() {
                for (b, &v) in row[x0..x0 + w].iter().enumerate() {
                    self.block[b * n + t] = v;
                }
            }
            for b in 0..w {
                self.column(b * n, n);
            }
            for (t, row) in rows.iter_mut().enumerate() {
                for (b, v) in row[x0..x0 + w].iter_mut().enumerate() {
                    let d = self.block[b * n + t];
                    *v = if last { d.sqrt() } else { d };
                }
            }
        }
    }

    /// Transforms the runs of one column of the block.
    fn column(&mut self, base: usize, n: usize) {
        let mut t = 0;
        while t < n {
            if self.block[base + t] == 0.0 {
                t += 1;
                continue;
            }
            let start = t;
            while t < n && self.block[base + t] > 0.0 {
                t += 1;
            }
            self.run(base + start, t - start);
        }
    }

    /// Lower envelope of the parabolas of one run and of the empty cells at its ends
    /// (Felzenszwalb and Huttenlocher 2012), at positions 1 … m between 0 and m + 1.
    fn run(&mut self, base: usize, m: usize) {
        let s2 = self.step2;
        if m <= 2 {
            for v in &mut self.block[base..base + m] {
                *v = v.min(s2 as f32);
            }
            return;
        }
        let (Some(values), Some(envelope)) =
            (self.block.get_mut(base..base + m), self.envelope.get_mut(..m + 2))
        else {
            return;
        };
        let scale = 1.0 / s2;
        let mut top = 0;
        envelope[0] = Parabola::default();
        for q in 1..=m + 1 {
            let height = values.get(q - 1).map_or(0.0, |v| f64::from(*v) * scale);
            let site = q as f64;
            let base = height + site * site;
            let mut from =
                self.halves[q - envelope[top].site as usize] * (base - envelope[top].base);
            while top > 0 && from <= envelope[top].from {
                top -= 1;
                let last = &envelope[top];
                from = self.halves[q - last.site as usize] * (base - last.base);
            }
            top += 1;
            envelope[top] = Parabola { site, height, base, from };
        }
        let mut pieces = envelope[..=top].iter();
        let mut piece = pieces.next().copied().unwrap_or_default();
        let mut next = pieces.next().copied().unwrap_or_default();
        for (t, value) in values.iter_mut().enumerate() {
            let p = (t + 1) as f64;
            while next.from < p {
                piece = next;
                match pieces.next() {
                    Some(n) => next = *n,
                    None => next.from = f64::MAX,
                }
            }
            let d = p - piece.site;
            // Sums of squares of whole numbers stay exact.
            *value = ((piece.height + d * d) * s2) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn slow(mask: &[u8], dims: [usize; 3], step: [f64; 3]) -> Vec<f64> {
        let [nx, ny, nz] = dims.map(|n| n as i64);
        let empty = |i: i64, j: i64, k: i64| {
            i < 0
                || j < 0
                || k < 0
                || i >= nx
                || j >= ny
                || k >= nz
                || mask[(i + nx * (j + ny * k)) as usize] == 0
        };
        let mut out = Vec::new();
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let mut best = f64::INFINITY;
                    for c in -1..=nz {
                        for b in -1..=ny {
                            for a in -1..=nx {
                                if empty(a, b, c) {
                                    let d = [
                                        (a - i) as f64 * step[0],
                                        (b - j) as f64 * step[1],
                                        (c - k) as f64 * step[2],
                                    ];
                                    best = best.min(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                                }
                            }
                        }
                    }
                    out.push(best.sqrt());
                }
            }
        }
        out
    }

    fn check(mask: &[u8], dims: [usize; 3], step: [f64; 3]) {
        let l = Lattice::new(dims, step);
        let bits = l.pack(mask).unwrap();
        let mut out = vec![7.0; mask.len()];
        distance(&l, &bits, dims, &mut out, &Pool::serial()).unwrap();
        let part = [dims[0].div_ceil(2), dims[1].div_ceil(3), dims[2]];
        let mut some = vec![7.0; mask.len()];
        distance(&l, &bits, part, &mut some, &Pool::serial()).unwrap();
        for (n, (a, b)) in some.iter().zip(&out).enumerate() {
            let (i, j) = (n % dims[0], n / dims[0] % dims[1]);
            assert!(i >= part[0] || j >= part[1] || a == b);
        }
        for (n, (a, b)) in out.iter().zip(slow(mask, dims, step)).enumerate() {
            assert!((f64::from(*a) - b).abs() <= 1e-5 * (1.0 + b), "cell {n}: {a} and {b}");
        }
    }

    #[test]
    fn full_block_and_long_rows() {
        check(&[1; 70 * 3 * 4], [70, 3, 4], [1.0; 3]);
        check(&[1; 6 * 9 * 5], [6, 9, 5], [1.0, 0.5, 2.0]);
        check(&[0; 60], [5, 4, 3], [1.0; 3]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn equals_brute_force(
            dims in [1usize..10, 1usize..9, 1usize..8],
            step in prop_oneof![Just([1.0, 1.0, 1.0]), Just([1.0, 0.7, 1.9])],
            density in 1u32..12,
            seed in any::<u32>(),
        ) {
            let mut state = seed | 1;
            let mask: Vec<u8> = (0..dims[0] * dims[1] * dims[2])
                .map(|_| {
                    state = state.wrapping_mul(1664525).wrapping_add(1013904223);
                    u8::from((state >> 16) % 12 != 0 || density == 1)
                })
                .collect();
            check(&mask, dims, step);
        }
    }
}
