//! Grey volumes: a threshold given, or Otsu's.

use super::{Grey, Layout, Threshold};
use crate::error::{Error, Result, figure};
use crate::run::{Run, Stage};
use crate::shape::voxels::mask::build;
use crate::shape::{ImportOptions, Shape};

/// Bins of the histogram of single-precision values, over their finite range.
/// 8- and 16-bit values have one bin for each value.
pub const F32_BINS: usize = 65536;

impl Grey<'_> {
    /// How many voxels.
    pub fn len(&self) -> usize {
        match self {
            Grey::U8(v) => v.len(),
            Grey::U16(v) => v.len(),
            Grey::F32(v) => v.len(),
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Shape {
    /// A shape from a grey volume: voxels whose value is greater than the
    /// threshold are solid. The threshold used is in the report.
    pub fn from_grey(
        values: Grey,
        layout: &Layout,
        threshold: Threshold,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        Shape::from_read_grey(values, layout, threshold, options, 0, run)
    }

    /// As [`Shape::from_grey`], beside `held` bytes of a file's values.
    pub(crate) fn from_read_grey(
        values: Grey,
        layout: &Layout,
        threshold: Threshold,
        options: &ImportOptions,
        held: u64,
        run: &Run,
    ) -> Result<Shape> {
        layout.check(values.len())?;
        run.time(Stage::Check, || {
            if let Grey::F32(v) = values
                && let Some(i) = v.iter().position(|x| !x.is_finite())
            {
                return Err(Error::NotFinite(format!("voxel {i} is {}", v[i])));
            }
            let above = match threshold {
                Threshold::Above(t) if t.is_finite() => t,
                Threshold::Above(t) => {
                    return Err(Error::NotFinite(format!("the threshold is {t}")));
                }
                Threshold::Otsu => otsu(values)?,
            };
            let mut shape = match values {
                Grey::U8(v) => {
                    let solid = |i: usize| v.get(i).is_some_and(|&x| f64::from(x) > above);
                    build(&solid, layout, None, options, held, run)
                }
                Grey::U16(v) => {
                    let solid = |i: usize| v.get(i).is_some_and(|&x| f64::from(x) > above);
                    build(&solid, layout, None, options, held, run)
                }
                Grey::F32(v) => {
                    let solid = |i: usize| v.get(i).is_some_and(|&x| f64::from(x) > above);
                    build(&solid, layout, None, options, held, run)
                }
            }
            .map_err(|e| match e {
                Error::Empty(_) => Error::Empty(format!(
                    "no voxel is greater than the threshold {}",
                    figure(above)
                )),
                e => e,
            })?;
            shape.report.threshold = above;
            if threshold == Threshold::Otsu {
                shape.report.notes.push(format!(
                    "voxels greater than {} are solid (Otsu's threshold)",
                    figure(above)
                ));
            }
            Ok(shape)
        })
    }
}

/// Otsu's threshold (IEEE Trans. Syst. Man Cybern. 9, 1979): of all ways to cut
/// the histogram in two, the one with the greatest variance between the
/// classes; the first of equal ones. Values greater than it are the upper class.
///
/// 8- and 16-bit values use the exact histogram. Single-precision values, all
/// finite, use [`F32_BINS`] bins between the least and the greatest; the
/// threshold then is the greatest value in the last bin of the lower class.
pub fn otsu(values: Grey) -> Result<f64> {
    let histogram = |bins: usize, bin: &dyn Fn(usize) -> usize| {
        let mut h = vec![0u64; bins];
        for i in 0..values.len() {
            h[bin(i).min(bins - 1)] += 1;
        }
        cut(&h)
    };
    let (bin, constant) = match values {
        Grey::U8(v) => (histogram(256, &|i| v[i].into()), v.first().map(|&x| f64::from(x))),
        Grey::U16(v) => (histogram(65536, &|i| v[i].into()), v.first().map(|&x| f64::from(x))),
        Grey::F32(v) => {
            let lo = v.iter().copied().fold(f32::INFINITY, f32::min);
            let hi = v.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            let (lo, width) = (f64::from(lo), f64::from(hi) - f64::from(lo));
            let bin = |x: f32| match width > 0.0 {
                true => ((f64::from(x) - lo) / width * F32_BINS as f64) as usize,
                false => 0,
            };
            let t = histogram(F32_BINS, &|i| bin(v[i])).map(|t| {
                let below = v.iter().copied().filter(|&x| bin(x).min(F32_BINS - 1) <= t);
                below.fold(f32::NEG_INFINITY, f32::max)
            });
            return t.map(f64::from).ok_or_else(|| {
                Error::InvalidArgument(format!(
                    "every voxel is {}: a constant volume has no threshold",
                    figure(lo)
                ))
            });
        }
    };
    bin.map(|t| t as f64).ok_or_else(|| {
        Error::InvalidArgument(format!(
            "every voxel is {}: a constant volume has no threshold",
            constant.unwrap_or(0.0)
        ))
    })
}

/// The last bin of the lower class; `None` when all values are in one bin.
fn cut(histogram: &[u64]) -> Option<usize> {
    let total: u64 = histogram.iter().sum();
    let moment: f64 = histogram.iter().enumerate().map(|(i, &n)| i as f64 * n as f64).sum();
    let (mut below, mut sum) = (0u64, 0.0);
    let mut best = None;
    let mut greatest = 0.0;
    for (t, &n) in histogram.iter().enumerate() {
        if n == 0 {
            continue;
        }
        below += n;
        sum += t as f64 * n as f64;
        if below == total {
            break;
        }
        let (w0, w1) = (below as f64, (total - below) as f64);
        let gap = (moment - sum) / w1 - sum / w0;
        let between = w0 * w1 * gap * gap;
        if best.is_none() || between > greatest {
            (best, greatest) = (Some(t), between);
        }
    }
    best
}
