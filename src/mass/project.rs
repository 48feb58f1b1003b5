//! The masses nearest to given ones that meet linear equations within bounds, to rounding:
//! minimise ½ Σ (x_i − s_i)² / w_i. The dual has ten unknowns and is piecewise quadratic; Newton
//! steps on it end at the solution itself, not near it (Qi and Sun 1993).

use super::problem::{Problem, ROWS, greatest};
use nalgebra::{SMatrix, SVector};

type Vector = SVector<f64, ROWS>;

/// Newton steps at most; a dozen is usual, thin sets of solutions take more.
const STEPS: usize = 100;
/// Equations met to this are met to rounding.
const MET: f64 = 4e-15;
/// Entries of an equation that are less than this, beside those of the mass, are nothing.
const NOTHING: f64 = 1e-12;

/// The x nearest to `near` in the weights, of the first `rows` equations. `None` where the
/// steps end without meeting the equations to `tolerance`: they contradict each other or the
/// bounds, or nearly so.
pub(super) fn project(
    p: &Problem,
    rows: usize,
    near: &[f64],
    weights: &[f64],
    tolerance: f64,
) -> Option<Vec<f64>> {
    // Equations without entries but for rounding, such as those across a plane that holds all
    // centres, are left alone; the others get one size.
    let mut size = [1.0; ROWS];
    let square = |row: &[f64]| -> f64 { row.iter().zip(weights).map(|(a, w)| w * a * a).sum() };
    let whole = p.rows.first().map_or(0.0, |mass| square(mass));
    for (size, row) in size.iter_mut().zip(&p.rows) {
        let sum = square(row);
        if sum > NOTHING * NOTHING * whole {
            *size = 1.0 / sum.sqrt();
        }
    }
    let dual = Dual { p, rows, near, weights, size, start: p.residuals(near) };
    let mut multipliers = Vector::zeros();
    let mut now = dual.at(&multipliers);
    for _ in 0..STEPS {
        let missed = greatest(now.missed.as_slice());
        if missed <= MET {
            break;
        }
        let Some(step) = dual.step(&now) else { break };
        let slope = now.gradient.dot(&step);
        let mut length = 1.0;
        let next = loop {
            let to = multipliers + step * length;
            let next = dual.at(&to);
            // Near the end the value no longer tells, but the equations do.
            let better = next.value < now.value + 1e-4 * length * slope
                || greatest(next.missed.as_slice()) < 0.5 * missed;
            if better {
                break Some((to, next));
            }
            length *= 0.5;
            if length < 1e-12 {
                break None;
            }
        };
        match next {
            Some((to, next)) => (multipliers, now) = (to, next),
            None => break,
        }
    }
    // Written so that a NaN is refused.
    (greatest(now.missed.as_slice()) <= tolerance).then_some(now.x)
}

struct Dual<'a> {
    p: &'a Problem,
    rows: usize,
    near: &'a [f64],
    weights: &'a [f64],
    /// What each equation is multiplied by.
    size: [f64; ROWS],
    /// The equations at `near`.
    start: [f64; ROWS],
}

struct Place {
    x: Vec<f64>,
    /// Whether x_i is within its bounds.
    free: Vec<bool>,
    value: f64,
    /// In the sizes of the equations.
    gradient: Vector,
    /// The equations as they are.
    missed: Vector,
}

impl Dual<'_> {
    fn column(&self, i: usize) -> Vector {
        Vector::from_fn(|r, _| if r < self.rows { self.p.rows[r][i] * self.size[r] } else { 0.0 })
    }

    fn at(&self, multipliers: &Vector) -> Place {
        let n = self.p.n;
        let mut place = Place {
            x: Vec::with_capacity(n),
            free: Vec::with_capacity(n),
            value: 0.0,
            gradient: Vector::zeros(),
            missed: Vector::zeros(),
        };
        for i in 0..n {
            let column = self.column(i);
            let (near, weight, pull) = (self.near[i], self.weights[i], column.dot(multipliers));
            let wish = near + weight * pull;
            let x = self.p.clamp(wish);
            place.free.push(x == wish);
            // About x = near, so that large parts that do not change do not hide the rest.
            place.value += pull * (x - near) - 0.5 * (x - near) * (x - near) / weight;
            place.x.push(x);
        }
        let all = self.p.residuals(&place.x);
        for r in 0..self.rows {
            place.missed[r] = all[r];
            place.gradient[r] = all[r] * self.size[r];
            place.value += self.start[r] * self.size[r] * multipliers[r];
        }
        place
    }

    /// The Newton step; along directions in which nothing is free, a little of the gradient.
    fn step(&self, at: &Place) -> Option<Vector> {
        let mut h = SMatrix::<f64, ROWS, ROWS>::zeros();
        for i in 0..self.p.n {
            if at.free[i] {
                let c = self.column(i);
                h += c * c.transpose() * self.weights[i];
            }
        }
        let trace = h.trace();
        let damp = 1e-14 * if trace > 0.0 { trace } else { 1.0 };
        for r in 0..ROWS {
            h[(r, r)] += damp;
        }
        let factor = h.cholesky()?;
        let mut step = factor.solve(&-at.gradient);
        // Once more for what rounding left.
        let rest = -at.gradient - h * step;
        step += factor.solve(&rest);
        step.iter().all(|s| s.is_finite()).then_some(step)
    }
}
