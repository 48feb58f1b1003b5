//! How deep a point lies below the surface: the radius that a sphere has there.
//!
//! The distance transform of cells is not that depth: it measures to the
//! nearest *empty cell centre*, which lies half a cell beyond a flat face along
//! the axes but nearly nothing beyond a round one, where many cells compete to be
//! nearest. Meshes have their exact distance. For voxels, each empty cell that
//! could be nearest carries its expected distance to the surface, told by how
//! full its neighbourhood is: smoothed with the weights (1, 2, 1)/4 along each
//! axis, an empty cell on a flat face is a quarter full, one in a round face nearly half. The
//! depth is the distance to the nearest empty cells less what they carry. The
//! figures are in docs/mss.md.

use super::lattice::Lattice;
use crate::error::{Result, filled};

/// Cells along each edge of a bucket.
const BUCKET: usize = 8;

/// Empty cells this much farther than the nearest, in cells, count as well.
const NEARLY: f64 = 0.02;

/// An empty cell with a solid neighbour.
#[derive(Debug, Clone, Copy)]
struct Rim {
    cell: [u32; 3],
    /// Expected distance of its centre from the surface.
    beyond: f32,
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
        let mut rims = filled("the rim", count, Rim { cell: [0; 3], beyond: 0.0 })?;
        // Each start moves to its end, which is the next one's start.
        rim_cells(lattice, bits, |cell| {
            let next = &mut starts[bucket(&cell)];
            if let Some(rim) = rims.get_mut(*next as usize) {
                *rim = Rim { cell, beyond: beyond(lattice, bits, &cell) };
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

    /// Distance from `p` to the surface, and to the nearest empty cell centre. `within` must
    /// not be less than the latter.
    pub fn depth(&self, p: &[f64; 3], within: f64) -> (f64, f64) {
        let mut best = within * within;
        self.around(p, within, |d2, _| {
            best = best.min(d2);
            best
        });
        let nearest = best.sqrt();
        let limit = nearest + NEARLY;
        let (mut sum, mut count) = (0.0, 0.0);
        self.around(p, limit, |d2, beyond| {
            if d2 <= limit * limit {
                sum += f64::from(beyond);
                count += 1.0;
            }
            limit * limit
        });
        if count > 0.0 { ((nearest - sum / count).max(0.0), nearest) } else { (nearest, nearest) }
    }

    /// Visits the rim in the buckets nearer than `within`; the visitor returns the
    /// squared distance beyond which nothing matters any more.
    fn around(&self, p: &[f64; 3], within: f64, mut visit: impl FnMut(f64, f32) -> f64) {
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
                        let mut d2 = 0.0;
                        for (x, q) in p.iter().enumerate() {
                            let d = f64::from(r.cell[x]) * self.step[x] - q;
                            d2 += d * d;
                        }
                        limit = visit(d2, r.beyond);
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

const SMOOTH: [i32; 5] = [0, 1, 2, 1, 0];
const SLOPE: [i32; 5] = [-1, -2, 0, 2, 1];

/// The bits of the cells i − 2 … i + 2 of a row.
fn window(lattice: &Lattice, bits: &[u64], i: u32, j: usize, k: usize) -> u64 {
    if j >= lattice.dims[1] || k >= lattice.dims[2] {
        return 0;
    }
    let start = lattice.words * (j + lattice.dims[1] * k);
    let Some(row) = bits.get(start..start + lattice.words) else { return 0 };
    let word = |n: usize| row.get(n).copied().unwrap_or(0);
    if i < 2 {
        return word(0) << (2 - i) & 31;
    }
    let first = i as usize - 2;
    let (w, b) = (first / 64, first % 64);
    let high = if b > 59 { word(w + 1) << (64 - b) } else { 0 };
    (word(w) >> b | high) & 31
}

/// Expected distance of an empty cell's centre from the surface, when it is the nearest to some
/// centre: half a cell on a flat face, where the smoothed occupancy g is ¼ and falls by ½ a cell;
/// less where g is nearer to ½. The cube is fitted to balls, boxes and turned boxes: cells are
/// nearest because the surface comes close to them, so a partly flat face counts for little.
fn beyond(lattice: &Lattice, bits: &[u64], cell: &[u32; 3]) -> f32 {
    let mut moments = [0i32; 4];
    // Smoothed occupancy, and its central differences: (1, 2, 1) against (−1, −2, 0, 2, 1) / 2.
    for z in 0..5 {
        for y in 0..5 {
            let (Some(j), Some(k)) =
                ((cell[1] as usize + y).checked_sub(2), (cell[2] as usize + z).checked_sub(2))
            else {
                continue;
            };
            let five = window(lattice, bits, cell[0], j, k);
            if five == 0 {
                continue;
            }
            let sum = |weights: [i32; 5]| -> i32 {
                weights.iter().enumerate().map(|(x, w)| w * (five >> x & 1) as i32).sum()
            };
            let (smooth, slope) = (sum(SMOOTH), sum(SLOPE));
            moments[0] += smooth * SMOOTH[y] * SMOOTH[z];
            moments[1] += slope * SMOOTH[y] * SMOOTH[z];
            moments[2] += smooth * SLOPE[y] * SMOOTH[z];
            moments[3] += smooth * SMOOTH[y] * SLOPE[z];
        }
    }
    let full = f64::from(moments[0]) / 64.0;
    // Halved once more: a central difference spans two cells.
    let slope: [f64; 3] =
        std::array::from_fn(|a| f64::from(moments[a + 1]) / 128.0 / lattice.step[a]);
    let steep = (slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2]).sqrt();
    if steep <= 0.0 {
        return 0.5 * lattice.step[0].min(lattice.step[1]).min(lattice.step[2]) as f32;
    }
    // Width of a cell along the slope.
    let width: f64 = (0..3).map(|a| (slope[a] / steep).powi(2) * lattice.step[a]).sum();
    let flat = ((0.5 - full) / steep / (0.5 * width)).clamp(0.0, 1.0);
    (0.5 * width * flat.powi(3)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_and_rims_are_those_of_the_cells() {
        let l = Lattice::new([131, 6, 5], [1.0; 3]);
        let mask: Vec<u8> = (0..131 * 6 * 5).map(|n| u8::from(n * n % 11 < 4)).collect();
        let bits = l.pack(&mask).unwrap();
        let mut rims = Vec::new();
        rim_cells(&l, &bits, |c| rims.push(c));
        let mut slow = Vec::new();
        for k in 0..5 {
            for j in 0..6 {
                for i in 0..131usize {
                    let five = (0..5).fold(0, |w, x| {
                        w | u64::from((i + x).checked_sub(2).is_some_and(|q| l.get(&bits, q, j, k)))
                            << x
                    });
                    assert_eq!(window(&l, &bits, i as u32, j, k), five, "{i} {j} {k}");
                    let beside = [
                        (i.wrapping_sub(1), j, k),
                        (i + 1, j, k),
                        (i, j.wrapping_sub(1), k),
                        (i, j + 1, k),
                        (i, j, k.wrapping_sub(1)),
                        (i, j, k + 1),
                    ];
                    let solid = |(a, b, c): &(usize, usize, usize)| l.get(&bits, *a, *b, *c);
                    if !solid(&(i, j, k)) && beside.iter().any(solid) {
                        slow.push([i as u32, j as u32, k as u32]);
                    }
                }
            }
        }
        assert_eq!(rims, slow);
    }

    #[test]
    fn a_flat_face_lies_half_a_cell_off_and_a_lone_cell_too() {
        let l = Lattice::new([12; 3], [1.0; 3]);
        let mask: Vec<u8> = (0..1728).map(|n| u8::from(n % 12 < 6)).collect();
        let bits = l.pack(&mask).unwrap();
        assert_eq!(beyond(&l, &bits, &[6, 5, 6]), 0.5);
        let rims = Rims::find(&l, &bits).unwrap();
        let (depth, nearest) = rims.depth(&[2.0, 6.0, 6.0], 5.0);
        assert!((depth - 3.5).abs() < 1e-9 && (nearest - 4.0).abs() < 1e-9);
    }
}
