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
    /// Fitted to LAMMPS with 1 to 300 spheres by `scripts/step_cost.py`, which states scene and machine, and held to 1000;
    /// what it measured stands in `scripts/step_cost.csv`, from which the model is at most a tenth off.
    pub const LAMMPS: StepModel =
        StepModel { step: [1.063, 1.751, 0.005317], lists: [10.88, 0.5679], rebuild: 50.0 };

    /// Fitted to the library's own engine with 1 to 1000 spheres, in the same way; what was measured stands in
    /// `scripts/step_cost_morula.csv`, from which the model is at most a quarter off. Its lists are of bodies, and
    /// their cost is in that of the step.
    pub const MORULA: StepModel =
        StepModel { step: [1.16, 0.0, 2.55e-6], lists: [0.0, 0.0], rebuild: 50.0 };

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

#[cfg(test)]
mod tests {
    use super::*;

    /// Both models against what was measured: the whole step over that with single spheres.
    #[test]
    fn the_models_are_those_of_the_measurements() {
        let lammps = include_str!("../../scripts/step_cost.csv");
        let morula = include_str!("../../scripts/step_cost_morula.csv");
        for (model, table, first, least) in
            [(StepModel::LAMMPS, lammps, 4, 7), (StepModel::MORULA, morula, 4, 7)]
        {
            let rows = table.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
            let rows: Vec<Vec<f64>> =
                rows.map(|l| l.split(',').map(|v| v.parse().unwrap()).collect()).collect();
            assert!(rows.len() >= least && rows[0][0] == 1.0);
            let seconds = |row: &[f64]| row[first..].iter().sum::<f64>();
            for row in &rows {
                let (n, measured) = (row[0] as usize, seconds(row) / seconds(&rows[0]));
                let off = model.cost(n) / measured - 1.0;
                assert!(off.abs() < 0.3, "{n} spheres: {} for {measured}", model.cost(n));
            }
        }
        assert_eq!(StepModel::default(), StepModel::LAMMPS);
    }
}
