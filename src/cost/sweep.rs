//! Curves over methods, resolutions and deadlines.

use super::curve::{Curve, CurveOptions, curve};
use crate::error::{Error, Result, reserve};
use crate::generate::{Effort, Method};
use crate::run::{Run, Stage};
use crate::shape::Shape;
use crate::solid::{Resolution, Solid, SolidOptions};

/// What is swept: every resolution with every method and every deadline.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepOptions {
    /// Grids; those of a voxel shape are its own, so that one is enough.
    pub resolutions: Vec<Resolution>,
    /// Methods with their efforts.
    pub methods: Vec<(Method, Effort)>,
    /// Seconds for each clump; 0: as long as it takes.
    pub seconds: Vec<f64>,
    /// The rest of the solids.
    pub solid: SolidOptions,
    /// The rest of the curves, with their numbers of spheres.
    pub curve: CurveOptions,
}

/// One curve of a sweep.
#[derive(Debug, Clone)]
pub struct Swept {
    /// The grid.
    pub resolution: Resolution,
    /// Its cells.
    pub cells: [usize; 3],
    /// Seconds that the solid took.
    pub solid_seconds: f64,
    /// Method and effort.
    pub method: (Method, Effort),
    /// Seconds for each clump.
    pub seconds: f64,
    /// The curve, or why there is none.
    pub curve: Result<Curve>,
}

/// Makes all curves, the resolutions one after the other, in each the methods, of each the
/// deadlines. But for seconds, and for clumps that meet a deadline, the result is the same for any
/// machine and any number of threads. After a cancel the curves that were not begun are
/// [`Error::Cancelled`]; a solid that fails is the error of its curves.
pub fn sweep(shape: &Shape, options: &SweepOptions, run: &Run) -> Result<Vec<Swept>> {
    for (name, none) in [
        ("resolution", options.resolutions.is_empty()),
        ("method", options.methods.is_empty()),
        ("deadline", options.seconds.is_empty()),
    ] {
        if none {
            return Err(Error::Empty(format!("there is no {name} to sweep over")));
        }
    }
    let (methods, deadlines) = (options.methods.len(), options.seconds.len());
    let all = options.resolutions.len().saturating_mul(methods).saturating_mul(deadlines);
    let mut swept = reserve("curves", all)?;
    for &resolution in &options.resolutions {
        run.count_anew();
        let part = |k: usize| k as f64 / all as f64;
        let first = swept.len();
        let wanted = SolidOptions { resolution, ..options.solid };
        let each = part(1) * 0.1;
        let solid = run.within([part(first), part(first) + each], || {
            run.check(0.0, "making the solids of a sweep")?;
            Solid::new(shape, &wanted, run)
        });
        let solid_seconds = run.counters().seconds[Stage::Solid as usize];
        for &method in &options.methods {
            for &seconds in &options.seconds {
                let k = swept.len();
                let from = if k == first { part(k) + each } else { part(k) };
                let curve = run.within([from, part(k + 1)], || {
                    let solid = solid.as_ref().map_err(Error::clone)?;
                    run.check(0.0, "making the curves of a sweep")?;
                    let mut wanted = CurveOptions { seconds, ..options.curve.clone() };
                    (wanted.generate.method, wanted.generate.effort) = method;
                    curve(solid, &wanted, run)
                });
                let cells = solid.as_ref().map_or([0; 3], |s| s.grid().dims);
                swept.push(Swept { resolution, cells, solid_seconds, method, seconds, curve });
            }
        }
    }
    Ok(swept)
}

#[cfg(test)]
#[path = "sweep_tests.rs"]
mod tests;
