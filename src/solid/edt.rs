//! Exact Euclidean distance transform in linear time (Felzenszwalb and
//! Huttenlocher 2012; Meijster et al. 2000), anisotropic, parallel.
//!
//! Two phases. Steps along z to the nearest background cell are two scans, done
//! row by row. Then each slice along z is finished by lower envelopes of
//! parabolas along x and along y. Background cells cut a line into runs, and no
//! source beyond a run's ends can matter inside it, so empty space costs nothing.

use crate::error::{Error, Result, filled};
use crate::run::Pool;
use std::sync::atomic::{AtomicBool, Ordering};

/// No background in reach: marks steps along z, and no axis may be this long.
const NO_STEPS: u16 = u16::MAX;
/// The same for heights, which are otherwise not negative.
const NO_HEIGHT: f64 = -1.0;
/// Columns along y that are copied together, so that each cache line is read once.
const TILE: usize = 16;

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

/// A parabola of the lower envelope.
#[derive(Clone, Copy, Default)]
struct Arc {
    /// Where its source is.
    at: usize,
    /// Its height there.
    height: f64,
    /// From where on it is the lowest.
    start: f64,
}

/// Scratch of one thread.
struct Work {
    /// Squared distances within the slice's rows, x fastest.
    plane: Vec<f64>,
    /// The x of the source of each, when tracked.
    plane_source: Vec<u16>,
    /// Columns along y, one after the other.
    tile: Vec<f64>,
    line: Vec<f64>,
    source: Vec<u16>,
    arcs: Vec<Arc>,
    /// `1 / (2 weight d)` for envelopes along x and y.
    reciprocal: [Vec<f64>; 2],
}

impl Work {
    fn new(dims: [usize; 3], metric: &Metric, track: bool) -> Result<Work> {
        let [nx, ny, _] = dims;
        let what = "the distance transform";
        let n = nx.max(ny);
        let mut reciprocal = [filled(what, nx + 1, 0.0)?, filled(what, ny + 1, 0.0)?];
        for (table, weight) in reciprocal.iter_mut().zip(metric.weight) {
            for (d, r) in table.iter_mut().enumerate().skip(1) {
                *r = 1.0 / (2.0 * weight * d as f64);
            }
        }
        Ok(Work {
            plane: filled(what, nx * ny, 0.0)?,
            plane_source: filled(what, if track { nx * ny } else { 0 }, 0)?,
            tile: filled(what, TILE * ny, 0.0)?,
            line: filled(what, n, 0.0)?,
            source: filled(what, n, 0)?,
            arcs: filled(what, n, Arc::default())?,
            reciprocal,
        })
    }

    /// One slice: envelopes along x, then along y.
    fn slice<const TRACK: bool>(
        &mut self,
        steps: &[u16],
        dims: [usize; 3],
        z: usize,
        metric: &Metric,
        out: &mut [f32],
        finish: &impl Fn(Option<f64>, [usize; 3]) -> f32,
    ) {
        let [nx, ny, nz] = dims;
        let steps_row = |y: usize| &steps[(y * nz + z) * nx..][..nx];
        let [wx, wy, wz] = metric.weight;
        let mut solid = false;
        for y in 0..ny {
            let row = &mut self.plane[y * nx..][..nx];
            let steps = steps_row(y);
            if steps.iter().all(|&s| s == 0) {
                row.fill(0.0);
                if TRACK {
                    own_source(&mut self.plane_source[y * nx..], 0, nx);
                }
                continue;
            }
            solid = true;
            for (h, &s) in self.line.iter_mut().zip(steps) {
                let s_f = f64::from(s);
                *h = if s == NO_STEPS { NO_HEIGHT } else { wz * (s_f * s_f) };
            }
            let line = &self.line[..nx];
            envelope::<TRACK>(line, wx, &self.reciprocal[0], &mut self.arcs, row, &mut self.source);
            if TRACK {
                self.plane_source[y * nx..][..nx].copy_from_slice(&self.source[..nx]);
            }
        }
        if !solid {
            return;
        }
        for x0 in (0..nx).step_by(TILE) {
            let width = TILE.min(nx - x0);
            for (y, row) in self.plane.chunks_exact(nx).enumerate() {
                for (c, &v) in row[x0..x0 + width].iter().enumerate() {
                    self.tile[c * ny + y] = v;
                }
            }
            for (c, column) in self.tile.chunks_exact(ny).take(width).enumerate() {
                let x = x0 + c;
                if column.iter().all(|&v| v == 0.0) {
                    continue;
                }
                let line = &mut self.line[..ny];
                envelope::<TRACK>(
                    column,
                    wy,
                    &self.reciprocal[1],
                    &mut self.arcs,
                    line,
                    &mut self.source,
                );
                for y in 0..ny {
                    let d = self.line[y];
                    if d == 0.0 {
                        continue;
                    }
                    let squared = (d > 0.0).then_some(d);
                    let mut to = [0; 3];
                    if TRACK && squared.is_some() {
                        let ys = usize::from(self.source[y]);
                        let xs = usize::from(self.plane_source[ys * nx + x]);
                        to = [xs.abs_diff(x), ys.abs_diff(y), usize::from(steps_row(ys)[xs])];
                    }
                    out[y * nx + x] = finish(squared, to);
                }
            }
        }
    }
}

/// `out[q] = min over s of line[s] + weight (q − s)²` wherever `line` is not 0; sources
/// without height do not count, and with none left the result has no height either.
/// If `TRACK`, `source[q]` is the s that won.
fn envelope<const TRACK: bool>(
    line: &[f64],
    weight: f64,
    reciprocal: &[f64],
    arcs: &mut [Arc],
    out: &mut [f64],
    source: &mut [u16],
) {
    let n = line.len();
    let mut next = 0;
    while let Some(skip) = line[next..].iter().position(|&h| h != 0.0) {
        out[next..next + skip].fill(0.0);
        if TRACK {
            own_source(source, next, next + skip);
        }
        let begin = next + skip;
        let end = line[begin..].iter().position(|&h| h == 0.0).map_or(n, |d| begin + d);
        next = end;
        let (low, high) = (begin as f64, (end - 1) as f64);
        // The run with the background cells at its ends: nothing farther can win.
        let first = begin.saturating_sub(1);
        let last = (end + 1).min(n);
        let mut count = 0;
        'sources: for (at, &height) in line[..last].iter().enumerate().skip(first) {
            if height < 0.0 {
                continue;
            }
            let mut start = low;
            while count > 0 {
                let top = arcs[count - 1];
                start =
                    (height - top.height) * reciprocal[at - top.at] + 0.5 * (at + top.at) as f64;
                if start > high {
                    continue 'sources;
                }
                if start > top.start {
                    break;
                }
                start = low;
                count -= 1;
            }
            arcs[count] = Arc { at, height, start };
            count += 1;
        }
        if count == 0 {
            out[begin..end].fill(NO_HEIGHT);
            continue;
        }
        let mut k = 0;
        let mut arc = arcs[0];
        for q in begin..end {
            let here = q as f64;
            while k + 1 < count && arcs[k + 1].start < here {
                k += 1;
                arc = arcs[k];
            }
            let d = here - arc.at as f64;
            out[q] = arc.height + weight * (d * d);
            if TRACK {
                source[q] = arc.at as u16;
            }
        }
    }
    out[next..n].fill(0.0);
    if TRACK {
        own_source(source, next, n);
    }
}

/// Background cells are their own source.
fn own_source(source: &mut [u16], from: usize, to: usize) {
    for (q, s) in source.iter_mut().enumerate().take(to).skip(from) {
        *s = q as u16;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Every pair of cells.
    fn brute_force(mask: &[u8], dims: [usize; 3], spacing: [f64; 3]) -> Vec<f32> {
        let [nx, ny, _] = dims;
        let at = |c: usize| [c % nx, c / nx % ny, c / nx / ny];
        let squared = |c: usize, b: usize| {
            let (c, b) = (at(c), at(b));
            if spacing[0] == spacing[1] && spacing[1] == spacing[2] {
                let n: usize = (0..3).map(|a| c[a].abs_diff(b[a]).pow(2)).sum();
                n as f64 * (spacing[0] * spacing[0])
            } else {
                (0..3).map(|a| (c[a].abs_diff(b[a]) as f64 * spacing[a]).powi(2)).sum()
            }
        };
        let diagonal: f64 = (0..3).map(|a| (dims[a] as f64 * spacing[a]).powi(2)).sum();
        (0..mask.len())
            .map(|c| {
                (0..mask.len())
                    .filter(|&b| mask[b] == 0)
                    .map(|b| if mask[c] == 0 { 0.0 } else { squared(c, b) })
                    .min_by(f64::total_cmp)
                    .unwrap_or(diagonal) as f32
            })
            .collect()
    }

    fn masks() -> impl Strategy<Value = (Vec<u8>, [usize; 3])> {
        ([1usize..12, 1usize..12, 1usize..12], 0u32..=100).prop_flat_map(|(dims, percent)| {
            let cell = (0u32..100).prop_map(move |v| u8::from(v < percent) * 7);
            (prop::collection::vec(cell, dims.iter().product::<usize>()), Just(dims))
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn equal_spacing_is_bit_for_bit((mask, dims) in masks(), h in 0.001f64..10.0) {
            let d = squared_distance(&mask, dims, [h; 3], &Pool::serial()).unwrap();
            prop_assert_eq!(d, brute_force(&mask, dims, [h; 3]));
        }

        #[test]
        fn unequal_spacing_is_within_one_ulp(
            (mask, dims) in masks(),
            spacing in [0.1f64..3.0, 0.1f64..3.0, 0.1f64..3.0],
        ) {
            let d = squared_distance(&mask, dims, spacing, &Pool::serial()).unwrap();
            for (c, (a, b)) in d.iter().zip(brute_force(&mask, dims, spacing)).enumerate() {
                prop_assert!(a.to_bits().abs_diff(b.to_bits()) <= 1, "cell {c}: {a} and {b}");
            }
        }

        #[test]
        fn steps_lead_to_the_nearest_background((mask, dims) in masks()) {
            let spacing = [0.7, 1.0, 1.9];
            let metric = Metric::new(dims, spacing).unwrap();
            let mut out = Vec::new();
            transform::<true>(&mask, false, dims, &metric, &Pool::serial(), &mut out,
                &mut Scratch::default(), |squared, to| match squared {
                    Some(_) => (0..3).map(|a| (to[a] as f64 * spacing[a]).powi(2)).sum::<f64>() as f32,
                    None => metric.diagonal_squared as f32,
                }).unwrap();
            for (c, (a, b)) in out.iter().zip(brute_force(&mask, dims, spacing)).enumerate() {
                prop_assert!((a - b).abs() <= 1e-6 * b, "cell {c}: {a} and {b}");
            }
        }
    }

    #[test]
    fn one_background_cell_far_away() {
        let n = 4096;
        let mut mask = vec![1; 2 * n];
        mask[0] = 0;
        let d = squared_distance(&mask, [n, 1, 2], [1.0; 3], &Pool::serial()).unwrap();
        assert_eq!(d[n - 1], (4095.0f32).powi(2));
        assert_eq!(d[2 * n - 1], 4095.0f32.powi(2) + 1.0);
        let d = squared_distance(&mask, [2, 1, n], [1.0; 3], &Pool::serial()).unwrap();
        assert_eq!(d[2 * n - 1], 4095.0f32.powi(2) + 1.0);
    }

    #[test]
    fn threads_and_used_memory_change_nothing() {
        let dims = [33, 40, 57];
        let mask: Vec<u8> = (0..dims.iter().product())
            .map(|i: usize| u8::from(i.wrapping_mul(2654435761) >> 7 & 15 != 0))
            .collect();
        let spacing = [1.0, 1.5, 0.8];
        let one = squared_distance(&mask, dims, spacing, &Pool::serial()).unwrap();
        let mut out = vec![9.0; 1000];
        let mut scratch = Scratch { steps: vec![5; 9] };
        for threads in [1, 2, 8] {
            let pool = Pool::new(threads).unwrap();
            squared_distance_into(&mask, dims, spacing, &pool, &mut out, &mut scratch).unwrap();
            assert!(one.iter().zip(&out).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
    }

    #[test]
    fn bad_input_is_refused() {
        let go = |n: usize, dims, spacing| {
            squared_distance(&vec![1; n], dims, spacing, &Pool::serial()).unwrap_err().status()
        };
        assert_eq!(go(7, [2, 2, 2], [1.0; 3]), 2);
        assert_eq!(go(0, [usize::MAX, 2, 2], [1.0; 3]), 17);
        assert_eq!(go(70000, [70000, 1, 1], [1.0; 3]), 17);
        assert_eq!(go(8, [2, 2, 2], [1.0, f64::NAN, 1.0]), 2);
        assert_eq!(go(8, [2, 2, 2], [1.0, 0.0, 1.0]), 2);
        assert!(squared_distance(&[], [0, 3, 3], [1.0; 3], &Pool::serial()).unwrap().is_empty());
        assert!(squared_distance(&[], [65000, 65000, 0], [1.0; 3], &Pool::serial()).is_ok());
    }
}
