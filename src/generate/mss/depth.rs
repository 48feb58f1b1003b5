//! How deep a point lies below the surface: the radius that a sphere has there.
//!
//! The distance transform of cells is not that depth: it measures to the nearest *empty cell
//! centre*, which lies half a cell beyond a flat face along the axes but nearly nothing beyond a
//! round or slanted one, where many cells compete to be nearest. Meshes have their exact
//! distance. For voxels all that is known is that the surface passes between an empty cell and
//! the solid ones that share a face with it. On a flat face along the axes the farthest of
//! them lies a whole cell before the nearest empty one; elsewhere, of the many empty cells that
//! are about as near, one has a solid neighbour that is nearly as far. The depth is the middle
//! between: the distance to the nearest empty cell less half the smallest gap. The figures are in
//! docs/mss.md.

use super::lattice::Lattice;
use crate::error::{Result, filled};

/// Cells along each edge of a bucket.
const BUCKET: usize = 8;

/// Empty cells this much farther than the nearest, in cells, count as well: so little that on a
/// slant it makes no difference, so much that on round faces there are several.
const NEARLY: f64 = 0.1;

/// More than so many of them are looked for a second time instead of being kept.
const HELD: usize = 32;

/// An empty cell with solid neighbours.
#[derive(Debug, Clone, Copy)]
struct Rim {
    cell: [u32; 3],
    /// Bit 2a for a solid cell before it along axis a, bit 2a + 1 for one behind it.
    solid: u32,
}

impl Rim {
    /// Offset of its centre from `p`.
    fn from(&self, p: &[f64; 3], step: &[f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| f64::from(self.cell[a]) * step[a] - p[a])
    }

    /// How much nearer the farthest solid neighbour is that is nearer; `d2` is its own squared
    /// distance.
    fn gap(&self, p: &[f64; 3], step: &[f64; 3], d2: f64) -> Option<f64> {
        let d = self.from(p, step);
        let sides = (0..6).filter(|n| self.solid >> n & 1 == 1);
        // The neighbour's squared distance less d².
        let more = |n: usize| {
            let (a, s) = (n / 2, [-step[n / 2], step[n / 2]][n % 2]);
            s * (2.0 * d[a] + s)
        };
        let farthest = sides.map(more).filter(|m| *m < 0.0).reduce(f64::max)?;
        Some(d2.sqrt() - (d2 + farthest).max(0.0).sqrt())
    }
}

/// The empty cells beside solid ones, in buckets.
pub(super) struct Rims {
    dims: [usize; 3],
    step: [f64; 3],
    starts: Vec<u32>,
    rims: Vec<Rim>,
}

impl Rims {
    /// Finds the empty cells beside the solid ones.
    pub fn find(lattice: &Lattice, bits: &[u64]) -> Result<Rims> {
        let dims = lattice.dims.map(|n| n.div_ceil(BUCKET));
        let bucket = |c: &[u32; 3]| {
            let b = c.map(|n| n as usize / BUCKET);
            b[0] + dims[0] * (b[1] + dims[1] * b[2])
        };
        let mut starts =
            filled("the buckets of the rim", dims.iter().product::<usize>() + 1, 0u32)?;
        rim_cells(lattice, bits, |c| starts[bucket(&c) + 1] += 1);
        for n in 1..starts.len() {
            starts[n] += starts[n - 1];
        }
        let count = starts.last().map_or(0, |n| *n as usize);
        let mut rims = filled("the rim", count, Rim { cell: [0; 3], solid: 0 })?;
        // Each start moves to its end, which is the next one's start.
        rim_cells(lattice, bits, |cell| {
            let next = &mut starts[bucket(&cell)];
            if let Some(rim) = rims.get_mut(*next as usize) {
                *rim = Rim { cell, solid: solid_sides(lattice, bits, &cell) };
            }
            *next += 1;
        });
        starts.rotate_right(1);
        if let Some(first) = starts.first_mut() {
            *first = 0;
        }
        Ok(Rims { dims, step: lattice.step, starts, rims })
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.rims.len() * size_of::<Rim>() + self.starts.len() * size_of::<u32>()
    }

    /// Distance from `p` to the surface. `within` must not be less than that to the nearest
    /// empty cell centre.
    pub fn depth(&self, p: &[f64; 3], within: f64) -> f64 {
        let square = |x: f64| x * x;
        let mut best = within * within;
        let mut limit = square(within + NEARLY);
        // Those about as near as the nearest so far, while they are few.
        let mut held = [(0.0, Rim { cell: [0; 3], solid: 0 }); HELD];
        let mut count = 0;
        self.around(p, within + NEARLY, |d2, rim| {
            if d2 < best {
                best = d2;
                limit = square(best.sqrt() + NEARLY);
            }
            if d2 <= limit {
                if count == HELD {
                    count = 0;
                    for n in 0..HELD {
                        if held[n].0 <= limit {
                            held[count] = held[n];
                            count += 1;
                        }
                    }
                }
                if let Some(free) = held.get_mut(count) {
                    *free = (d2, *rim);
                    count += 1;
                } else {
                    count = HELD + 1;
                }
            }
            limit
        });
        let nearest = best.sqrt();
        let mut gap: Option<f64> = None;
        let mut look = |d2: f64, rim: &Rim| {
            if d2 <= limit
                && let Some(next) = rim.gap(p, &self.step, d2)
            {
                gap = Some(gap.map_or(next, |g| g.min(next)));
            }
        };
        match held.get(..count) {
            Some(few) => few.iter().for_each(|(d2, rim)| look(*d2, rim)),
            None => self.around(p, nearest + NEARLY, |d2, rim| {
                look(d2, rim);
                limit
            }),
        }
        nearest - 0.5 * gap.unwrap_or(0.0)
    }

    /// Visits the rim in the buckets nearer than `within`; the visitor returns the
    /// squared distance beyond which nothing matters any more.
    fn around(&self, p: &[f64; 3], within: f64, mut visit: impl FnMut(f64, &Rim) -> f64) {
        let mut limit = within * within;
        let edge = self.step.map(|s| s * BUCKET as f64);
        let reach = |a: usize, at: f64| {
            ((at / edge[a]).max(0.0) as usize).min(self.dims[a].saturating_sub(1))
        };
        let first: [usize; 3] = std::array::from_fn(|a| reach(a, p[a] - within));
        let last: [usize; 3] = std::array::from_fn(|a| reach(a, p[a] + within));
        // Centres of the cells of bucket n lie in [n·edge, n·edge + 7 steps].
        let gap = |a: usize, n: usize| {
            let lo = n as f64 * edge[a];
            (lo - p[a]).max(p[a] - (lo + edge[a] - self.step[a])).max(0.0).powi(2)
        };
        for c in first[2]..=last[2] {
            let dz = gap(2, c);
            for b in first[1]..=last[1] {
                let dy = dz + gap(1, b);
                if dy > limit {
                    continue;
                }
                for a in first[0]..=last[0] {
                    if dy + gap(0, a) > limit {
                        continue;
                    }
                    let n = a + self.dims[0] * (b + self.dims[1] * c);
                    let (Some(&from), Some(&to)) = (self.starts.get(n), self.starts.get(n + 1))
                    else {
                        continue;
                    };
                    for r in self.rims.get(from as usize..to as usize).unwrap_or(&[]) {
                        let d = r.from(p, &self.step);
                        limit = visit(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], r);
                    }
                }
            }
        }
    }
}

/// Calls `found` for each empty cell that shares a face with a solid one, in order.
fn rim_cells(lattice: &Lattice, bits: &[u64], mut found: impl FnMut([u32; 3])) {
    let [_, ny, nz] = lattice.dims;
    let words = lattice.words;
    let row = |j: usize, k: usize| {
        if j >= ny || k >= nz {
            return None;
        }
        let start = words * (j + ny * k);
        bits.get(start..start + words)
    };
    let word = |r: Option<&[u64]>, n: usize| r.and_then(|r| r.get(n)).copied().unwrap_or(0);
    for k in 0..nz {
        for j in 0..ny {
            let here = row(j, k);
            let beside = [
                row(j.wrapping_sub(1), k),
                row(j + 1, k),
                row(j, k.wrapping_sub(1)),
                row(j, k + 1),
            ];
            for n in 0..words {
                let w = word(here, n);
                let left = w << 1 | if n > 0 { word(here, n - 1) >> 63 } else { 0 };
                let right = w >> 1 | word(here, n + 1) << 63;
                let sides = beside.iter().fold(left | right, |s, r| s | word(*r, n));
                let mut rim = sides & !w;
                while rim != 0 {
                    let i = n * 64 + rim.trailing_zeros() as usize;
                    rim &= rim - 1;
                    if i < lattice.dims[0] {
                        found([i as u32, j as u32, k as u32]);
                    }
                }
            }
        }
    }
}

/// Which of the cells that share a face with the cell are solid, as in [`Rim::solid`].
fn solid_sides(lattice: &Lattice, bits: &[u64], cell: &[u32; 3]) -> u32 {
    let mut sides = 0;
    for n in 0..6 {
        let mut c = cell.map(|x| x as usize);
        c[n / 2] = if n % 2 == 0 { c[n / 2].wrapping_sub(1) } else { c[n / 2] + 1 };
        sides |= u32::from(lattice.get(bits, c[0], c[1], c[2])) << n;
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rims_are_the_empty_cells_beside_solid_ones() {
        let l = Lattice::new([131, 6, 5], [1.0; 3]);
        let mask: Vec<u8> = (0..131 * 6 * 5).map(|n| u8::from(n * n % 11 < 4)).collect();
        let bits = l.pack(&mask).unwrap();
        let mut slow = Vec::new();
        for k in 0..5usize {
            for j in 0..6usize {
                for i in 0..131usize {
                    let beside = [
                        (i.wrapping_sub(1), j, k),
                        (i + 1, j, k),
                        (i, j.wrapping_sub(1), k),
                        (i, j + 1, k),
                        (i, j, k.wrapping_sub(1)),
                        (i, j, k + 1),
                    ];
                    let solid = |(a, b, c): &(usize, usize, usize)| l.get(&bits, *a, *b, *c);
                    let sides = (0..6).filter(|n| solid(&beside[*n])).fold(0, |s, n| s | 1 << n);
                    if !solid(&(i, j, k)) && sides != 0 {
                        slow.push((k, j, i, sides));
                    }
                }
            }
        }
        let rims = Rims::find(&l, &bits).unwrap().rims;
        let mut found: Vec<_> = rims
            .iter()
            .map(|r| (r.cell[2] as usize, r.cell[1] as usize, r.cell[0] as usize, r.solid))
            .collect();
        found.sort_unstable();
        assert_eq!(found, slow);
    }

    /// By all cells: the nearest empty one, and of those about as near the smallest gap.
    fn slow_depth(l: &Lattice, bits: &[u64], p: &[f64; 3]) -> f64 {
        let [nx, ny, nz] = l.dims;
        let away = |c: [usize; 3]| {
            let d: [f64; 3] = std::array::from_fn(|a| c[a] as f64 * l.step[a] - p[a]);
            (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
        };
        let mut empty = Vec::new();
        for n in 0..nx * ny * nz {
            let c = [n % nx, n / nx % ny, n / nx / ny];
            if l.get(bits, c[0], c[1], c[2]) {
                continue;
            }
            let mut gap = f64::INFINITY;
            for side in 0..6 {
                let mut q = c;
                q[side / 2] = (q[side / 2] + side % 2 * 2).wrapping_sub(1);
                if l.get(bits, q[0], q[1], q[2]) && away(q) < away(c) {
                    gap = gap.min(away(c) - away(q));
                }
            }
            empty.push((away(c), gap));
        }
        let nearest = empty.iter().map(|e| e.0).fold(f64::INFINITY, f64::min);
        let near = empty.iter().filter(|e| e.0 <= nearest + NEARLY);
        nearest - 0.5 * near.map(|e| e.1).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn depths_are_those_of_a_search_over_all_cells() {
        let l = Lattice::new([34, 21, 26], [1.0, 1.3, 0.8]);
        let at = |n: usize| {
            let c = [n % 34, n / 34 % 21, n / 34 / 21];
            let q: [f64; 3] = std::array::from_fn(|a| c[a] as f64 * l.step[a]);
            (q[0] - 16.0).powi(2) / 2.0 + (q[1] - 13.0).powi(2) + (q[2] - 10.0).powi(2)
        };
        let mask: Vec<u8> =
            (0..34 * 21 * 26).map(|n| u8::from(at(n) < 90.0 && n % 34 > 8)).collect();
        let bits = l.pack(&mask).unwrap();
        let rims = Rims::find(&l, &bits).unwrap();
        for n in 0..60 {
            let f = f64::from(n);
            let p = [11.0 + 0.17 * f, 8.0 + 0.13 * f, 6.5 + 3.0 * (0.7 * f).sin()];
            let (fast, slow) = (rims.depth(&p, 20.0), slow_depth(&l, &bits, &p));
            assert!((fast - slow).abs() < 1e-9, "{p:?}: {fast} and {slow}");
        }
    }

    #[test]
    fn a_flat_face_lies_half_a_cell_before_the_empty_centres() {
        let l = Lattice::new([12; 3], [1.0; 3]);
        let mask: Vec<u8> = (0..1728).map(|n| u8::from(n % 12 < 6)).collect();
        let rims = Rims::find(&l, &l.pack(&mask).unwrap()).unwrap();
        assert!((rims.depth(&[2.0, 6.0, 6.0], 5.0) - 3.5).abs() < 1e-9);
    }
}
