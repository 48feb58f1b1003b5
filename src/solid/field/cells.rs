//! The signed distance of voxels: the exact Euclidean distance transform of both sides,
//! less half a cell.

use crate::error::Result;
use crate::run::Run;
use crate::solid::edt::{self, Metric, Scratch};
use crate::solid::grid::Grid;

/// The distance to the nearest cell centre of the other side, less half of that cell's extent
/// along the way there: zero at the faces between solid and empty cells, exact over flat ones.
pub(super) fn signed_distance(inside: &[u8], grid: &Grid, run: &Run) -> Result<Vec<f32>> {
    let spacing: [f64; 3] = grid.spacing.into();
    let metric = Metric::new(grid.dims, spacing)?;
    let mut scratch = Scratch::default();
    let mut out = Vec::new();
    for (flip, sign) in [(false, -1.0), (true, 1.0)] {
        run.check(0.0, "making the distance field")?;
        let finish = |squared: Option<f64>, to: [usize; 3]| {
            let Some(squared) = squared else {
                return (sign * metric.diagonal_squared.sqrt()) as f32;
            };
            let d = (squared * metric.factor).sqrt();
            (sign * (d - half_extent(to, d))) as f32
        };
        let pool = run.pool();
        edt::transform::<true>(
            inside,
            flip,
            grid.dims,
            &metric,
            pool,
            &mut out,
            &mut scratch,
            finish,
        )?;
    }
    run.count(|c| {
        c.transforms += 2;
        c.peak_bytes = c.peak_bytes.max(7 * grid.len() as u64);
    });
    Ok(out)
}

/// Half the length of a cell along a way of `steps` cells and the length `d`: a way crosses
/// one cell in 1 / (its greatest number of steps) of its length.
fn half_extent(steps: [usize; 3], d: f64) -> f64 {
    0.5 * d / steps.into_iter().fold(1, usize::max) as f64
}
