//! Linear and diagonal quadratic programs: the only file that names the solver.

use crate::error::{Error, Result};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT,
};

/// Minimise ½ Σ `square`_j x_j² + Σ `linear`_j x_j under equations and inequalities.
#[derive(Default)]
pub(super) struct Program {
    pub square: Vec<f64>,
    pub linear: Vec<f64>,
    equal: Rows,
    less: Rows,
}

#[derive(Default)]
struct Rows {
    /// (column, row, value)
    entries: Vec<(usize, usize, f64)>,
    right: Vec<f64>,
}

impl Program {
    /// A program of `n` unknowns without costs.
    pub(super) fn new(n: usize) -> Program {
        Program { square: vec![0.0; n], linear: vec![0.0; n], ..Program::default() }
    }

    /// Σ values x = right.
    pub(super) fn equal(&mut self, values: impl IntoIterator<Item = (usize, f64)>, right: f64) {
        self.equal.push(values, right);
    }

    /// Σ values x ≤ right.
    pub(super) fn less(&mut self, values: impl IntoIterator<Item = (usize, f64)>, right: f64) {
        self.less.push(values, right);
    }

    /// The solution, or `None` where the solver finds that there is none, or no end.
    ///
    /// It runs on the calling thread with a factorisation of its own, so that the same program
    /// gives the same bytes.
    pub(super) fn solve(self) -> Result<Option<Vec<f64>>> {
        let n = self.linear.len();
        let squares = (0..n).map(|j| (j, j, self.square[j])).filter(|e| e.2 != 0.0).collect();
        let p = sparse(n, n, squares);
        let (equal, less) = (self.equal.right.len(), self.less.right.len());
        let below = self.less.entries.into_iter().map(|(j, i, v)| (j, i + equal, v));
        let a = sparse(equal + less, n, self.equal.entries.into_iter().chain(below).collect());
        let right = [self.equal.right, self.less.right].concat();
        let cones = [ZeroConeT(equal), NonnegativeConeT(less)];
        let settings = DefaultSettings {
            verbose: false,
            max_threads: 1,
            direct_solve_method: "qdldl".into(),
            tol_gap_abs: 1e-10,
            tol_gap_rel: 1e-10,
            tol_feas: 1e-10,
            // At its default what is left of the dual equations, times the masses of a thousand
            // spheres, was a millionth of the objective.
            static_regularization_constant: 1e-10,
            ..DefaultSettings::default()
        };
        let mut solver = DefaultSolver::new(&p, &self.linear, &a, &right, &cones, settings)
            .map_err(|e| Error::Internal(format!("the solver of masses refuses: {e}")))?;
        solver.solve();
        let found =
            matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        let x = std::mem::take(&mut solver.solution.x);
        Ok((found && x.len() == n && x.iter().all(|x| x.is_finite())).then_some(x))
    }
}

impl Rows {
    fn push(&mut self, values: impl IntoIterator<Item = (usize, f64)>, right: f64) {
        let row = self.right.len();
        self.entries.extend(values.into_iter().filter(|v| v.1 != 0.0).map(|(j, v)| (j, row, v)));
        self.right.push(right);
    }
}

/// A matrix by columns from (column, row, value).
fn sparse(rows: usize, columns: usize, mut entries: Vec<(usize, usize, f64)>) -> CscMatrix<f64> {
    entries.sort_by_key(|e| (e.0, e.1));
    let mut starts = vec![0; columns + 1];
    for e in &entries {
        starts[e.0 + 1] += 1;
    }
    for j in 0..columns {
        starts[j + 1] += starts[j];
    }
    let places = entries.iter().map(|e| e.1).collect();
    CscMatrix::new(rows, columns, starts, places, entries.iter().map(|e| e.2).collect())
}
