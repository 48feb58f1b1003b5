//! What a step of a solver costs with clumps, in units of one with single spheres.

use crate::error::{Error, Result, figure};

/// A model of the cost of one step of one particle of n spheres, over that of a single sphere:
/// a + b n + c n² for contacts, integration and communication, and (d n + e n²) / K for
/// neighbour lists, which are made anew every K steps; 1 at n = 1.
///
/// The squares: two neighbours have n² pairs of spheres, of which lists hold the more the
/// smaller the spheres are beside the lists' skin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepModel {
    /// a, b, c.
    pub step: [f64; 3],
    /// d, e.
    pub lists: [f64; 2],
    /// K, at least 1.
    pub rebuild: f64,
}

impl StepModel {
    /// Fitted to LAMMPS with 1 to 300 spheres by `scripts/step_cost.py`, which states scene and machine;
    /// what it measured stands in `scripts/step_cost.csv`, from which the model is at most a fifth off.
    pub const LAMMPS: StepModel =
        StepModel { step: [2.728, 1.227, 0.02576], lists: [6.481, 0.7738], rebuild: 50.0 };

    /// The cost of a step with clumps of `spheres` spheres.
    pub fn cost(&self, spheres: usize) -> f64 {
        if spheres <= 1 {
            return 1.0;
        }
        let n = spheres as f64;
        let ([a, b, c], [d, e]) = (self.step, self.lists);
        (a + b * n + c * n * n + (d * n + e * n * n) / self.rebuild).max(1.0)
    }

    /// Refused: coefficients that are not numbers of 0 or more, K below 1.
    pub(super) fn check(&self) -> Result<()> {
        for x in self.step.iter().chain(&self.lists) {
            if !(x.is_finite() && *x >= 0.0) {
                return Err(Error::InvalidArgument(format!(
                    "a coefficient of the cost of a step is {}, not a number ≥ 0",
                    figure(*x)
                )));
            }
        }
        if !(self.rebuild.is_finite() && self.rebuild >= 1.0) {
            return Err(Error::InvalidArgument(format!(
                "lists are made anew every {} steps, not 1 or more",
                figure(self.rebuild)
            )));
        }
        Ok(())
    }
}

impl Default for StepModel {
    fn default() -> Self {
        StepModel::LAMMPS
    }
}
