//! Distances beyond the band: foot points are handed on from node to node of a lattice of every
//! second cell (vector distance transform, Danielsson 1980, in three dimensions), and a cell
//! takes the nearest of those of the eight nodes around it.

use super::band::Foot;
use crate::error::{Result, filled};
use crate::run::Pool;
use wide::f32x8;

const WHAT: &str = "the distances far from the surface";
/// A place that nothing is near to.
const NOWHERE: f32 = 1e7;

/// The nodes, the foot point of each, and its squared distance.
struct Nodes {
    dims: [usize; 3],
    feet: Vec<[f32; 3]>,
    squared: Vec<f32>,
}

/// Fills in the distances that are below 0.
pub(super) fn fill<'a>(
    dims: [usize; 3],
    feet: impl Iterator<Item = &'a Foot>,
    pool: &Pool,
    out: &mut [f32],
) -> Result<()> {
    let nodes = Nodes::new(dims, feet)?;
    let [nx, ny, _] = dims;
    pool.chunks_mut(out, 2 * nx * ny, |pair, out| {
        let layers = out.len() / (nx * ny);
        for j in (0..ny).step_by(2) {
            for i in (0..nx).step_by(2) {
                let cells: [usize; 8] = std::array::from_fn(|c| {
                    let at = [i + (c & 1), j + (c >> 1 & 1), c >> 2];
                    let there = at[0] < nx && at[1] < ny && at[2] < layers;
                    if there { at[0] + nx * (at[1] + ny * at[2]) } else { usize::MAX }
                });
                if cells.iter().all(|&c| out.get(c).is_none_or(|d| *d >= 0.0)) {
                    continue;
                }
                let found = nodes.around([i / 2, j / 2, pair]).to_array();
                for (c, d) in cells.into_iter().zip(found) {
                    if let Some(out) = out.get_mut(c).filter(|d| **d < 0.0) {
                        *out = d;
                    }
                }
            }
        }
    });
    Ok(())
}

impl Nodes {
    fn new<'a>(cells: [usize; 3], feet: impl Iterator<Item = &'a Foot>) -> Result<Nodes> {
        let dims = cells.map(|n| n.saturating_sub(1) / 2 + 2);
        let total = dims.iter().product();
        let mut nodes = Nodes {
            dims,
            feet: filled(WHAT, total, [NOWHERE; 3])?,
            squared: filled(WHAT, total, f32::MAX)?,
        };
        for &(cell, foot) in feet {
            let node = cell.map(|i| (i as usize).div_ceil(2));
            let at = node[0] + dims[0] * (node[1] + dims[1] * node[2]);
            nodes.offer(at, node, foot);
        }
        nodes.sweep();
        Ok(nodes)
    }

    #[inline(always)]
    fn offer(&mut self, at: usize, node: [usize; 3], foot: [f32; 3]) {
        // One by one: `map` of arrays is not inlined here and takes a third of the time.
        let x = (2 * node[0]) as f32 - foot[0];
        let y = (2 * node[1]) as f32 - foot[1];
        let z = (2 * node[2]) as f32 - foot[2];
        let squared = x * x + y * y + z * z;
        if squared < self.squared[at] {
            self.squared[at] = squared;
            self.feet[at] = foot;
        }
    }

    /// Offers the feet of a row beside it to a row of nodes, each those of the three next to it.
    fn row(&mut self, [j, k]: [usize; 2], beside: [usize; 2]) {
        let [nx, ny, _] = self.dims;
        let (first, other) = (nx * (j + ny * k), nx * (beside[0] + ny * beside[1]));
        for i in 0..nx {
            for from in i.saturating_sub(1)..(i + 2).min(nx) {
                self.offer(first + i, [i, j, k], self.feet[other + from]);
            }
        }
    }

    /// Offers feet along a row and back.
    fn along(&mut self, [j, k]: [usize; 2]) {
        let (n, first) = (self.dims[0], self.dims[0] * (j + self.dims[1] * k));
        for i in 1..n {
            self.offer(first + i, [i, j, k], self.feet[first + i - 1]);
        }
        for i in (0..n - 1).rev() {
            self.offer(first + i, [i, j, k], self.feet[first + i + 1]);
        }
    }

    /// Offers feet within a layer, and from the one beside it.
    fn layer(&mut self, k: usize, beside: Option<usize>) {
        let ny = self.dims[1];
        for j in 0..ny {
            if let Some(beside) = beside {
                for from in j.saturating_sub(1)..(j + 2).min(ny) {
                    self.row([j, k], [from, beside]);
                }
            }
            if j > 0 {
                self.row([j, k], [j - 1, k]);
            }
            self.along([j, k]);
        }
        for j in (0..ny - 1).rev() {
            self.row([j, k], [j + 1, k]);
            self.along([j, k]);
        }
    }

    fn sweep(&mut self) {
        let nz = self.dims[2];
        (0..nz).for_each(|k| self.layer(k, k.checked_sub(1)));
        (0..nz - 1).rev().for_each(|k| self.layer(k, Some(k + 1)));
    }

    /// The distances of the eight cells from twice this node on to the nearest of the feet of
    /// the eight nodes around them.
    #[inline(always)]
    fn around(&self, [i, j, k]: [usize; 3]) -> f32x8 {
        let place = |n: usize, far: [f32; 8]| f32x8::new(far) + (2 * n) as f32;
        let x = place(i, [0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]);
        let y = place(j, [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0]);
        let z = place(k, [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
        let [nx, ny, _] = self.dims;
        let at = i + nx * (j + ny * k);
        let mut least = f32x8::splat(f32::MAX);
        for corner in 0..8 {
            let step = (corner & 1) + nx * (corner >> 1 & 1) + nx * ny * (corner >> 2);
            let [fx, fy, fz] = self.feet[at + step];
            let (dx, dy, dz) = (x - fx, y - fy, z - fz);
            least = least.fast_min(dx * dx + dy * dy + dz * dz);
        }
        least.sqrt()
    }
}
