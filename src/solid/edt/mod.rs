//! Exact Euclidean distance transform in linear time (Felzenszwalb and
//! Huttenlocher 2012; Meijster et al. 2000), anisotropic, parallel.
//!
//! Two phases. Steps along z to the nearest background cell are two scans, done
//! row by row. Then each slice along z is finished by lower envelopes of
//! parabolas along x and along y. Background cells cut a line into runs, and no
//! source beyond a run's ends can matter inside it, so empty space costs nothing.

mod envelope;
mod slice;
#[cfg(test)]
mod tests;

use crate::error::{Error, Result};
use crate::run::Pool;
use slice::Work;
use std::sync::atomic::{AtomicBool, Ordering};

/// No background in reach: marks steps along z, and no axis may be this long.
const NO_STEPS: u16 = u16::MAX;

/// Memory that transforms of the same size can share.
#[derive(Debug, Default)]
pub struct Scratch {
    steps: Vec<u16>,
}

/// For every cell with `mask != 0`, the squared distance from its centre to the
/// centre of the nearest cell with `mask == 0`; 0 for the others. Cells beyond
/// the array do not count as background. x fastest; `spacing` along x, y, z.
///
/// With equal spacing h the result is h² times the exact integer, rounded once to
/// f32 (with h = 1: exact below 2²⁴, the nearest f32 above); with unequal spacing
/// it is within one unit in the last place. When no cell is background, every
/// cell gets the squared diagonal of the array, more than any distance within it.
///
/// Fails on a length that is not the product of `dims`, on an axis of more than
/// 65534 cells, and on spacings whose squares f32 cannot hold.
pub fn squared_distance(
    mask: &[u8],
    dims: [usize; 3],
    spacing: [f64; 3],
    pool: &Pool,
) -> Result<Vec<f32>> {
    let mut out = Vec::new();
    squared_distance_into(mask, dims, spacing, pool, &mut out, &mut Scratch::default())?;
    Ok(out)
}

/// As [`squared_distance`], into the caller's vector (made as long as `mask`) and
/// with memory that may be used again: 2 bytes a cell, and a slice or so a thread.
pub fn squared_distance_into(
    mask: &[u8],
    dims: [usize; 3],
    spacing: [f64; 3],
    pool: &Pool,
    out: &mut Vec<f32>,
    scratch: &mut Scratch,
) -> Result<()> {
    let metric = Metric::new(dims, spacing)?;
    let finish = |squared: Option<f64>, _: [usize; 3]| match squared {
        Some(d) => (d * metric.factor) as f32,
        None => metric.diagonal_squared as f32,
    };
    out.fill(0.0);
    transform::<false>(mask, false, dims, &metric, pool, out, scratch, finish)
}

/// Units of the envelopes: cells when the spacing is equal (so that all heights are
/// integers and nothing is rounded), else the caller's.
pub(super) struct Metric {
    /// Squared length of one step along x, y, z.
    weight: [f64; 3],
    /// From these units to squared length.
    pub factor: f64,
    /// Squared diagonal of the array.
    pub diagonal_squared: f64,
}

impl Metric {
    pub(super) fn new(dims: [usize; 3], spacing: [f64; 3]) -> Result<Metric> {
        let mut diagonal_squared = 0.0;
        for a in 0..3 {
            if dims[a] >= usize::from(NO_STEPS) {
                return Err(Error::TooLarge(format!(
                    "axis {a} has {} cells, and a distance transform takes at most {}",
                    dims[a],
                    NO_STEPS - 1
                )));
            }
            // Squares that f32 can hold; the comparison is also false for NaN.
            if !(spacing[a] >= 1e-18 && spacing[a] <= 1e13) {
                return Err(Error::InvalidArgument(format!(
                    "spacing {a} is {}, not between 1e-18 and 1e13",
                    spacing[a]
                )));
            }
            diagonal_squared += (dims[a] as f64 * spacing[a]).powi(2);
        }
        let [x, y, z] = spacing;
        let (weight, factor) =
            if x == y && y == z { ([1.0; 3], x * x) } else { ([x * x, y * y, z * z], 1.0) };
        Ok(Metric { weight, factor, diagonal_squared })
    }
}

/// The transform. A cell is solid when `(mask != 0) != flip`. `finish` makes the result
/// of a solid cell from the squared distance (in the units of `metric`; `None` when
/// there is no background) and, if `TRACK`, the steps to that background cell along
/// x, y, z, without sign. Background cells keep what `out` held (0 where it grows).
#[allow(clippy::too_many_arguments)]
pub(super) fn transform<const TRACK: bool>(
    mask: &[u8],
    flip: bool,
    dims: [usize; 3],
    metric: &Metric,
    pool: &Pool,
    out: &mut Vec<f32>,
    scratch: &mut Scratch,
    finish: impl Fn(Option<f64>, [usize; 3]) -> f32 + Sync + Send,
) -> Result<()> {
    let [nx, ny, nz] = dims;
    let cells = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
    if cells != Some(mask.len()) {
        return Err(Error::InvalidArgument(format!(
            "the mask has {} cells, not {nx} × {ny} × {nz}",
            mask.len()
        )));
    }
    resize(out, mask.len(), 0.0, "the distance transform")?;
    resize(&mut scratch.steps, mask.len(), 0, "the distance transform")?;
    if mask.is_empty() {
        return Ok(());
    }
    pool.chunks_mut(&mut scratch.steps, nz * nx, |y, steps| {
        scan_z(mask, dims, y, flip, steps);
    });
    let steps = scratch.steps.as_slice();
    let slice = nx * ny;
    // Some slices at a time, so that scratch memory is taken seldom.
    let together = ((1 << 17) / slice).clamp(1, nz.div_ceil(8));
    let starved = AtomicBool::new(false);
    pool.chunks_mut(out, slice * together, |chunk, out| {
        let Ok(mut work) = Work::new(dims, metric, TRACK) else {
            starved.store(true, Ordering::Relaxed);
            return;
        };
        for (s, out) in out.chunks_mut(slice).enumerate() {
            work.slice::<TRACK>(steps, dims, chunk * together + s, metric, out, &finish);
        }
    });
    if starved.into_inner() {
        return Err(Error::OutOfMemory(format!(
            "no memory for a slice of {nx} × {ny} cells of the distance transform"
        )));
    }
    Ok(())
}

/// Gives `v` the length `len` without aborting; old contents may stay.
fn resize<T: Clone>(v: &mut Vec<T>, len: usize, value: T, what: &str) -> Result<()> {
    if v.len() < len && v.try_reserve_exact(len - v.len()).is_err() {
        return Err(Error::OutOfMemory(format!(
            "no memory for {what}: {len} elements of {} bytes",
            std::mem::size_of::<T>()
        )));
    }
    v.resize(len, value);
    Ok(())
}

/// Steps along z to the nearest background cell, for the plane at `y`: rows of x, z by z.
fn scan_z(mask: &[u8], dims: [usize; 3], y: usize, flip: bool, steps: &mut [u16]) {
    let [nx, ny, nz] = dims;
    for z in 0..nz {
        let mask = &mask[(z * ny + y) * nx..][..nx];
        let (before, here) = steps.split_at_mut(z * nx);
        let here = &mut here[..nx];
        if z == 0 {
            for (s, &m) in here.iter_mut().zip(mask) {
                *s = if (m != 0) != flip { NO_STEPS } else { 0 };
            }
        } else {
            for ((s, &m), &b) in here.iter_mut().zip(mask).zip(&before[(z - 1) * nx..]) {
                *s = if (m != 0) != flip { b.saturating_add(1) } else { 0 };
            }
        }
    }
    for z in (1..nz).rev() {
        let (here, after) = steps.split_at_mut(z * nx);
        for (s, &a) in here[(z - 1) * nx..].iter_mut().zip(&after[..nx]) {
            *s = (*s).min(a.saturating_add(1));
        }
    }
}
