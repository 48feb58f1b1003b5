//! One slice along z: envelopes along x, then along y.

use super::envelope::{Arc, NO_HEIGHT, envelope, own_source};
use super::{Metric, NO_STEPS};
use crate::error::{Result, filled};

/// Columns along y that are copied together, so that each cache line is read once.
const TILE: usize = 16;

/// Scratch of one thread.
pub(super) struct Work {
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
    pub(super) fn new(dims: [usize; 3], metric: &Metric, track: bool) -> Result<Work> {
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
    pub(super) fn slice<const TRACK: bool>(
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
