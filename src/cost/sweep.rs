//! Curves over methods, resolutions and deadlines.

use super::curve::{Curve, CurveOptions, curve};
use crate::error::{Error, Result, figure, reserve};
use crate::generate::{Effort, Method};
use crate::run::{Counters, Run, Stage};
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
    let mut swept = reserve("curves", options.curves())?;
    sweep_each(shape, options, run, |_, one| {
        swept.push(one);
        Ok(())
    })?;
    Ok(swept)
}

/// As [`sweep`], but hands each curve over when it is made, with its solid, and what was counted
/// while that was made, where there is one. An error of `take` ends the sweep.
pub fn sweep_each(
    shape: &Shape,
    options: &SweepOptions,
    run: &Run,
    mut take: impl FnMut(Option<(&Solid, &Counters)>, Swept) -> Result<()>,
) -> Result<()> {
    options.check()?;
    let all = options.curves();
    let part = |k: usize| k as f64 / all as f64;
    let mut k = 0;
    for &resolution in &options.resolutions {
        run.count_anew();
        let first = k;
        let wanted = SolidOptions { resolution, ..options.solid };
        let each = part(1) * 0.1;
        let solid = run.within([part(first), part(first) + each], || {
            run.check(0.0, "making the solids of a sweep")?;
            Solid::new(shape, &wanted, run)
        });
        let counters = run.counters();
        let solid_seconds = counters.seconds[Stage::Solid as usize];
        let cells = solid.as_ref().map_or([0; 3], |s| s.grid().dims);
        for &method in &options.methods {
            for &seconds in &options.seconds {
                let from = if k == first { part(k) + each } else { part(k) };
                let curve = run.within([from, part(k + 1)], || {
                    let solid = solid.as_ref().map_err(Error::clone)?;
                    run.check(0.0, "making the curves of a sweep")?;
                    let mut wanted = CurveOptions { seconds, ..options.curve.clone() };
                    (wanted.generate.method, wanted.generate.effort) = method;
                    curve(solid, &wanted, run)
                });
                let of = solid.as_ref().ok().map(|s| (s, &counters));
                take(of, Swept { resolution, cells, solid_seconds, method, seconds, curve })?;
                k += 1;
            }
        }
    }
    Ok(())
}

impl SweepOptions {
    /// How many curves there will be.
    pub fn curves(&self) -> usize {
        let methods = self.methods.len();
        self.resolutions.len().saturating_mul(methods).saturating_mul(self.seconds.len())
    }

    /// Refused: nothing to sweep over, seconds that are not numbers of 0 or more.
    fn check(&self) -> Result<()> {
        for (name, none) in [
            ("resolution", self.resolutions.is_empty()),
            ("method", self.methods.is_empty()),
            ("deadline", self.seconds.is_empty()),
        ] {
            if none {
                return Err(Error::Empty(format!("there is no {name} to sweep over")));
            }
        }
        let wrong = |s: &f64| !(s.is_finite() && *s >= 0.0);
        if let Some(k) = self.seconds.iter().position(wrong) {
            return Err(Error::InvalidArgument(format!(
                "deadline {k} is {}, not a number ≥ 0",
                figure(self.seconds[k])
            )));
        }
        Ok(())
    }
}

#[cfg(test)]
#[path = "sweep_tests.rs"]
mod tests;
