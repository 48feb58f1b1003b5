//! The mass correction as linear and quadratic programs: exact, or with the least error.

use super::cone::Program;
use super::problem::{Problem, ROWS};
use crate::error::Result;

/// What is wished of the masses beside the equations.
#[derive(Debug, Clone, Copy)]
pub(super) enum Goal<'a> {
    /// Least Σ (x − s)² / s from these shares.
    Even(&'a [f64]),
    /// The greatest least mass (Yuan 2019, end of section 4).
    MaxMin,
    /// The greatest mass of this sphere (Yuan 2019, eq 7).
    MaxOne(usize),
}

/// Which equations hold, and how well: those before `hard` exactly, those from there up to `soft`
/// but for an error that is the same for all.
#[derive(Debug, Clone, Copy)]
pub(super) struct Demand {
    pub hard: usize,
    pub soft: usize,
}

/// All ten.
pub(super) const ALL: Demand = Demand { hard: ROWS, soft: ROWS };

/// The least error with which the soft equations can be met, and masses that do: Yuan 2019, eq 8,
/// in one step instead of many, and with the products of inertia: |Δ_jk| ≤ ε √(J_j J_k). `None`
/// where the hard ones cannot be met.
pub(super) fn least_error(p: &Problem, demand: Demand) -> Result<Option<(f64, Vec<f64>)>> {
    let n = p.n;
    let errors = demand.soft - demand.hard;
    let eps = n + errors;
    let mut q = Program::new(eps + 1);
    q.linear[eps] = 1.0;
    equations(&mut q, p, demand, None);
    bounds(&mut q, p, p.least, None);
    for e in n..eps {
        q.less([(e, 1.0), (eps, -1.0)], 0.0);
        q.less([(e, -1.0), (eps, -1.0)], 0.0);
    }
    let Some(mut x) = q.solve()? else { return Ok(None) };
    let error = x[eps].max(0.0);
    x.truncate(n);
    Ok(Some((error, x)))
}

/// The masses of which the soft equations miss the least, by the sum of squares. `None` where the
/// hard ones cannot be met.
pub(super) fn least_squares(p: &Problem, demand: Demand) -> Result<Option<Vec<f64>>> {
    let n = p.n;
    let mut q = Program::new(n + demand.soft - demand.hard);
    q.square.iter_mut().skip(n).for_each(|s| *s = 1.0);
    equations(&mut q, p, demand, None);
    bounds(&mut q, p, p.least, None);
    let found = q.solve()?;
    Ok(found.map(|mut x| {
        x.truncate(n);
        x
    }))
}

/// The masses that serve `goal` best, with errors of the soft equations up to `error`.
pub(super) fn best(
    p: &Problem,
    goal: Goal,
    demand: Demand,
    error: f64,
) -> Result<Option<Vec<f64>>> {
    let n = p.n;
    let errors = demand.soft - demand.hard;
    let common = matches!(goal, Goal::MaxMin).then_some(n + errors);
    let mut q = Program::new(n + errors + usize::from(common.is_some()));
    match goal {
        Goal::Even(shares) => {
            for (j, &s) in shares.iter().enumerate() {
                q.square[j] = 1.0 / (s * n as f64);
                q.linear[j] = -1.0 / n as f64;
            }
        }
        Goal::MaxMin => q.linear[n + errors] = -1.0,
        Goal::MaxOne(j) => q.linear[j] = -1.0 / n as f64,
    }
    equations(&mut q, p, demand, common);
    match common {
        Some(t) => {
            bounds(&mut q, p, 0.0, Some(t));
            q.less([(t, -1.0)], -p.least);
        }
        None => bounds(&mut q, p, p.least, None),
    }
    for e in n..n + errors {
        q.less([(e, 1.0)], error);
        q.less([(e, -1.0)], error);
    }
    let Some(mut x) = q.solve()? else { return Ok(None) };
    let t = common.map_or(0.0, |t| x[t]);
    x.truncate(n);
    x.iter_mut().for_each(|x| *x = p.clamp(*x + t));
    Ok(Some(x))
}

/// The greatest least mass with which all ten equations can be met, of any sign; `None` where
/// they contradict each other.
pub(super) fn largest_least(p: &Problem) -> Result<Option<f64>> {
    let t = p.n;
    let mut q = Program::new(t + 1);
    q.linear[t] = -1.0;
    equations(&mut q, p, ALL, Some(t));
    bounds(&mut q, p, 0.0, Some(t));
    Ok(q.solve()?.and_then(|x| x.get(t).copied()))
}

/// The equations in x_j + x_t, less the errors that follow the n masses.
fn equations(q: &mut Program, p: &Problem, demand: Demand, common: Option<usize>) {
    for r in 0..demand.soft {
        let row = p.rows[r].iter().copied().enumerate();
        let together = common.map(|t| (t, p.rows[r].iter().sum::<f64>()));
        let error = (r >= demand.hard).then(|| (p.n + r - demand.hard, -1.0));
        q.equal(row.chain(together).chain(error), p.target[r]);
    }
}

fn bounds(q: &mut Program, p: &Problem, least: f64, common: Option<usize>) {
    for j in 0..p.n {
        q.less([(j, -1.0)], -least);
    }
    if let Some(most) = p.most {
        for j in 0..p.n {
            q.less([(j, 1.0)].into_iter().chain(common.map(|t| (t, 1.0))), most);
        }
    }
}
