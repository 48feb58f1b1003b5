//! The skeleton of a set of voxels by parallel thinning (Yuan 2019, algorithm 1, after Bertrand
//! and Couprie 2014): in each pass all voxels go at once that are neither ends nor needed by a
//! critical clique.
//!
//! Only voxels of the border can go, and only cliques of voxels that could go can matter: each
//! pass looks at lists of these, not at the whole grid. Of a critical clique the voxel of least
//! index stays. So of those that might go in a pass the one of greatest index always goes, and
//! thinning ends when no voxel is left that is simple and not an end.

use super::cliques::{BORDER, KEPT, LOOSE, Lattice, SOLID};
use super::simple::simple;
use crate::error::{Error, Result, collected, filled, fits, push};
use crate::run::{Pool, Run};

/// Which voxels stay, beside those that the topology needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ends {
    /// Voxels of the border none of whose neighbours by a face lies inside: the skeleton is a
    /// medial surface.
    #[default]
    Surface,
    /// Voxels with a single neighbour: the skeleton is made of curves. For shapes about an axis.
    Curve,
}

/// A skeleton.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Skeleton {
    /// Its voxels, ascending: `i + nx (j + ny k)`.
    pub voxels: Vec<usize>,
    /// How many of them are neither ends nor needed by the topology one by one: 0.
    pub simple: usize,
    /// Passes made.
    pub passes: usize,
}

/// Voxels that a thread takes at once.
const CHUNK: usize = 2048;

/// Thins the voxels that are not 0 in `cells`, `dims` along x, y, z, x fastest.
///
/// Errors: `InvalidArgument` (sizes that do not agree), `TooLarge`, `MemoryLimit` (more than
/// `limit` bytes), `OutOfMemory`, `Cancelled`.
pub fn thin(dims: [usize; 3], cells: &[u8], ends: Ends, limit: u64, run: &Run) -> Result<Skeleton> {
    let wide = dims.map(|n| n.saturating_add(2));
    let product = |d: [usize; 3]| d[0].checked_mul(d[1])?.checked_mul(d[2]);
    let total = product(wide).filter(|&n| n < u32::MAX as usize).ok_or_else(|| {
        let [x, y, z] = dims;
        Error::TooLarge(format!("{x} × {y} × {z} voxels are too many to be thinned"))
    })?;
    if product(dims) != Some(cells.len()) {
        return Err(Error::InvalidArgument(format!(
            "{} voxels were given for {} × {} × {}",
            cells.len(),
            dims[0],
            dims[1],
            dims[2]
        )));
    }
    fits(format_args!("the thinning of {total} voxels"), total as u64, limit)?;
    let mut state = filled("the voxels to be thinned", total, 0u8)?;
    let [nx, ny, _] = dims;
    for (row, from) in cells.chunks(nx.max(1)).enumerate() {
        let at = 1 + wide[0] * (row % ny.max(1) + 1 + wide[1] * (row / ny.max(1) + 1));
        if let Some(to) = state.get_mut(at..at + from.len()) {
            to.iter_mut().zip(from).for_each(|(t, &f)| *t = u8::from(f != 0));
        }
    }
    let step = [1, wide[0] as isize, (wide[0] * wide[1]) as isize];
    let mut work = Work { state, step, border: Vec::new(), passes: 0 };
    work.find_border(run.pool())?;
    run.count(|c| c.peak_bytes = c.peak_bytes.max((total + 4 * work.border.len()) as u64));
    let depth = dims.iter().min().map_or(1, |&n| n.div_ceil(2).max(1));
    loop {
        let done = (work.passes as f64 / depth as f64).min(1.0);
        run.check(0.3 * done, "thinning the voxels")?;
        if !work.pass(ends, run.pool())? {
            break;
        }
    }
    let simple = work.some(run.pool(), &work.border, |l, at| simple(l.around(at)))?.len();
    let inner = |at: usize| {
        let (i, j, k) = (at % wide[0], at / wide[0] % wide[1], at / (wide[0] * wide[1]));
        (i - 1) + nx * ((j - 1) + ny * (k - 1))
    };
    let left = work.state.iter().enumerate().filter(|&(_, s)| s & SOLID != 0);
    let voxels = collected("the skeleton", left.map(|(at, _)| inner(at)))?;
    Ok(Skeleton { voxels, simple, passes: work.passes })
}

struct Work {
    state: Vec<u8>,
    step: [isize; 3],
    /// Voxels of the border that are no ends.
    border: Vec<u32>,
    passes: usize,
}

impl Work {
    fn lattice(&self) -> Lattice<'_> {
        Lattice { state: &self.state, step: self.step }
    }

    fn beside(&self, at: u32) -> [usize; 6] {
        let [x, y, z] = self.step;
        [-z, -y, -x, x, y, z].map(|s| (at as isize + s) as usize)
    }

    /// Those of `list` that pass, in its order.
    fn some(
        &self,
        pool: &Pool,
        list: &[u32],
        passes: impl Fn(&Lattice, isize) -> bool + Sync,
    ) -> Result<Vec<u32>> {
        let lattice = self.lattice();
        let chunks: Vec<&[u32]> = list.chunks(CHUNK).collect();
        let found = pool.map(chunks.len(), |i| {
            let chunk = chunks.get(i).copied().unwrap_or_default();
            chunk.iter().copied().filter(|&at| passes(&lattice, at as isize)).collect::<Vec<u32>>()
        });
        collected("the border of voxels", found.into_iter().flatten())
    }

    fn set(&mut self, list: &[u32], bits: u8) {
        for &at in list {
            if let Some(s) = self.state.get_mut(at as usize) {
                *s |= bits;
            }
        }
    }

    fn clear(&mut self, list: &[u32], bits: u8) {
        for &at in list {
            if let Some(s) = self.state.get_mut(at as usize) {
                *s &= !bits;
            }
        }
    }

    /// Without those that have one of `bits`.
    fn drop_with(&self, list: &mut Vec<u32>, bits: u8) {
        list.retain(|&at| self.state.get(at as usize).is_some_and(|s| s & bits == 0));
    }

    fn find_border(&mut self, pool: &Pool) -> Result<()> {
        let layer = self.step[2] as usize;
        let lattice = self.lattice();
        let found = pool.map(self.state.len() / layer.max(1), |k| {
            let first = (k * layer) as isize;
            let [x, y, z] = lattice.step;
            (first..first + layer as isize)
                .filter(|&at| {
                    lattice.solid(at)
                        && [-z, -y, -x, x, y, z].into_iter().any(|s| !lattice.solid(at + s))
                })
                .map(|at| at as u32)
                .collect::<Vec<u32>>()
        });
        self.border = collected("the border of voxels", found.into_iter().flatten())?;
        let border = std::mem::take(&mut self.border);
        self.set(&border, BORDER);
        self.border = border;
        Ok(())
    }

    /// One pass; `false` when nothing goes any more.
    fn pass(&mut self, ends: Ends, pool: &Pool) -> Result<bool> {
        // Critical 3-cliques are the voxels that are not simple.
        let mut loose = self.some(pool, &self.border, |l, at| simple(l.around(at)))?;
        self.set(&loose, LOOSE);
        for rank in [2, 1, 0] {
            let stay = self.some(pool, &loose, |l, at| match rank {
                2 => l.first_by_face(at),
                1 => l.first_by_edge(at),
                _ => l.first_by_vertex(at),
            })?;
            self.clear(&stay, LOOSE);
            loose.retain(|&at| self.state.get(at as usize).is_some_and(|s| s & LOOSE != 0));
        }
        if loose.is_empty() {
            return Ok(false);
        }
        self.passes += 1;
        let mut border = std::mem::take(&mut self.border);
        self.clear(&loose, u8::MAX);
        border.retain(|&at| self.state.get(at as usize).is_some_and(|s| s & SOLID != 0));
        for &at in &loose {
            for near in self.beside(at) {
                if let Some(s) = self.state.get_mut(near)
                    && *s & (SOLID | BORDER) == SOLID
                {
                    *s |= BORDER;
                    push("the border of voxels", &mut border, near as u32)?;
                }
            }
        }
        let kept = match ends {
            Ends::Surface => self.some(pool, &border, |l, at| {
                let [x, y, z] = l.step;
                [-z, -y, -x, x, y, z].into_iter().all(|s| l.get(at + s) & (SOLID | BORDER) != SOLID)
            }),
            Ends::Curve => {
                self.some(pool, &border, |l, at| (l.around(at) & !(1 << 13)).count_ones() == 1)
            }
        }?;
        self.set(&kept, KEPT);
        self.drop_with(&mut border, KEPT);
        self.border = border;
        Ok(true)
    }
}

#[cfg(test)]
#[path = "thinning_tests.rs"]
mod tests;
