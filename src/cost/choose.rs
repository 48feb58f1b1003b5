//! A choice from a price list, with its reason.

use super::curve::Point;
use crate::error::{Error, Result, figure};

/// What a clump may cost and how good it must be; `None` bounds nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bounds {
    /// Most spheres.
    pub spheres: Option<usize>,
    /// Greatest D.
    pub mismatch: Option<f64>,
    /// Least coverage.
    pub coverage: Option<f64>,
    /// Greatest distance between the surfaces (RMS), over the equivalent diameter.
    pub surface: Option<f64>,
    /// Most seconds of the generator.
    pub seconds: Option<f64>,
    /// Greatest cost of a step, in steps with single spheres.
    pub step_cost: Option<f64>,
    /// Greatest cost of simulated time, in the same unit.
    pub time_cost: Option<f64>,
}

/// What is made best within the bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Goal {
    /// Fewest spheres.
    Spheres,
    /// Least D.
    Mismatch,
    /// Fewest seconds of the generator.
    Seconds,
    /// Cheapest step.
    StepCost,
    /// Cheapest simulated time.
    TimeCost,
    /// Where more spheres stop paying: the point that lies farthest below the straight line from
    /// first to last, on logarithmic axes of the cost of a step and of D.
    #[default]
    Knee,
}

/// A choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Number of the point.
    pub index: usize,
    /// One sentence that says why.
    pub why: String,
}

/// By how much, in natural logarithms, a curve must sag below the straight line to have a knee:
/// a tenth of D.
const SAG: f64 = 0.1;

/// The best point within the bounds. Of equal ones, that of least D, then that of fewest spheres.
///
/// Refused: no point, a bound that is not a number. Where no point is within the bounds:
/// [`Error::NoSpheres`], which names the bound that leaves the least and what would have met it.
pub fn choose(points: &[Point], bounds: &Bounds, goal: Goal) -> Result<Choice> {
    if points.is_empty() {
        return Err(Error::Empty("there is no point to choose from".into()));
    }
    let limits = limits(bounds)?;
    let within: Vec<usize> = (0..points.len())
        .filter(|&i| points.get(i).is_some_and(|p| limits.iter().all(|l| l.met(p))))
        .collect();
    let Some(&first) = within.first() else { return Err(none(points, &limits)) };
    let at = |i: &usize| &points[*i];
    let (index, mut why) = if goal == Goal::Knee {
        knee(points, &within)
    } else {
        let value = |p: &Point| match goal {
            Goal::Spheres => p.spheres as f64,
            Goal::Seconds => p.seconds,
            Goal::StepCost => p.step_cost,
            Goal::TimeCost => p.time_cost,
            Goal::Mismatch | Goal::Knee => p.mismatch,
        };
        let key = |i: &usize| [value(at(i)), at(i).mismatch, at(i).spheres as f64];
        let less = |a: &[f64; 3], b: &[f64; 3]| {
            let pairs = a.iter().zip(b).map(|(x, y)| x.total_cmp(y));
            pairs.fold(std::cmp::Ordering::Equal, |so_far, next| so_far.then(next)).is_lt()
        };
        let best = within.iter().fold(first, |b, i| if less(&key(i), &key(&b)) { *i } else { b });
        let what = match goal {
            Goal::Spheres => "has the fewest spheres",
            Goal::Seconds => "is made in the least time",
            Goal::StepCost => "makes the cheapest step",
            Goal::TimeCost => "makes simulated time cheapest",
            Goal::Mismatch | Goal::Knee => "has the least mismatch",
        };
        (best, what.to_string())
    };
    let met: Vec<String> = limits.iter().map(|l| l.words.clone()).collect();
    if !met.is_empty() {
        why += &format!(" of those with {}", joined(&met));
    }
    // What stands in the way of more.
    let p = &points[index];
    if goal == Goal::Mismatch
        && let Some(next) = points.iter().find(|q| q.mismatch < p.mismatch)
        && let Some(limit) = limits.iter().find(|l| !l.met(next))
    {
        why += &format!(
            "; D {:.4} with {} spheres would take {}",
            next.mismatch,
            next.spheres,
            limit.said(next)
        );
    }
    let why = format!(
        "the clump of {}, D {:.4}, a step {} times that of a sphere, {why}",
        crate::error::count(p.spheres as u64, "sphere"),
        p.mismatch,
        short(p.step_cost),
    );
    Ok(Choice { index, why })
}

/// A bound.
struct Limit {
    words: String,
    name: &'static str,
    value: fn(&Point) -> f64,
    most: f64,
    /// −1 where more is better.
    sign: f64,
}

impl Limit {
    fn met(&self, p: &Point) -> bool {
        self.sign * (self.value)(p) <= self.sign * self.most
    }

    /// What a point has of it.
    fn said(&self, p: &Point) -> String {
        format!("{} of {}", self.name, short((self.value)(p)))
    }
}

fn limits(b: &Bounds) -> Result<Vec<Limit>> {
    let mut all = Vec::new();
    let mut add = |most: Option<f64>, sign: f64, name: &'static str, value: fn(&Point) -> f64| {
        let Some(most) = most else { return Ok(()) };
        if !(most.is_finite() && most >= 0.0) {
            return Err(Error::InvalidArgument(format!(
                "the bound of {name} is {}, not a number ≥ 0",
                figure(most)
            )));
        }
        let relation = if sign > 0.0 { "≤" } else { "≥" };
        let words = format!("{name} {relation} {}", short(most));
        all.push(Limit { words, name, value, most, sign });
        Ok(())
    };
    add(b.spheres.map(|n| n as f64), 1.0, "spheres", |p| p.spheres as f64)?;
    add(b.mismatch, 1.0, "D", |p| p.mismatch)?;
    add(b.coverage, -1.0, "coverage", |p| p.coverage)?;
    add(b.surface, 1.0, "surface error", |p| p.surface)?;
    add(b.seconds, 1.0, "seconds", |p| p.seconds)?;
    add(b.step_cost, 1.0, "step cost", |p| p.step_cost)?;
    add(b.time_cost, 1.0, "cost of simulated time", |p| p.time_cost)?;
    Ok(all)
}

/// Why there is no point.
fn none(points: &[Point], limits: &[Limit]) -> Error {
    let alone = |l: &Limit| points.iter().filter(|p| l.met(p)).count();
    let Some(tight) = limits.iter().min_by_key(|l| alone(l)) else {
        return Error::Empty("there is no point to choose from".into());
    };
    let nearest = points
        .iter()
        .min_by(|p, q| (tight.sign * (tight.value)(p)).total_cmp(&(tight.sign * (tight.value)(q))));
    let words: Vec<String> = limits.iter().map(|l| l.words.clone()).collect();
    let near = nearest.map_or(String::new(), |p| {
        format!(": the nearest to {} has {}", tight.words, tight.said(p))
    });
    let but = match alone(tight) {
        0 => near,
        _ => ": each bound is met by some clump, all of them by none".into(),
    };
    Error::NoSpheres(format!("no clump of {} has {}{but}", points.len(), joined(&words)))
}

/// Where more spheres stop paying.
fn knee(points: &[Point], within: &[usize]) -> (usize, String) {
    // Only points that are better than all cheaper ones: D is not quite monotone.
    let mut order = within.to_vec();
    order.sort_by(|&i, &j| {
        let (a, b) = (&points[i], &points[j]);
        a.step_cost.total_cmp(&b.step_cost).then(a.mismatch.total_cmp(&b.mismatch))
    });
    let mut front: Vec<usize> = Vec::new();
    for i in order {
        if front.last().is_none_or(|&l| points[i].mismatch < points[l].mismatch) {
            front.push(i);
        }
    }
    let place = |i: usize| {
        let p = &points[i];
        [p.step_cost.max(1e-9).ln(), p.mismatch.max(1e-9).ln()]
    };
    let (Some(&first), Some(&last)) = (front.first(), front.last()) else {
        return (within.first().copied().unwrap_or(0), "is the only one".into());
    };
    let ([x0, y0], [x1, y1]) = (place(first), place(last));
    if front.len() < 3 || x1 <= x0 {
        return (last, "is as far as the curve goes: too few points for a knee".into());
    }
    let slope = (y1 - y0) / (x1 - x0);
    let sag = |i: usize| {
        let [x, y] = place(i);
        y0 + slope * (x - x0) - y
    };
    let best = front.iter().fold(first, |b, &i| if sag(i) > sag(b) { i } else { b });
    if sag(best) < SAG {
        let cut = 100.0 * (1.0 - 2f64.powf(slope));
        return (
            last,
            format!(
                "is the last: the curve has no knee, each doubling of the step's cost takes {cut:.0} % off D"
            ),
        );
    }
    let [x, y] = place(best);
    let cut = |from: [f64; 2], to: [f64; 2]| {
        100.0 * (1.0 - 2f64.powf((to[1] - from[1]) / (to[0] - from[0])))
    };
    let before = cut([x0, y0], [x, y]);
    let after = cut([x, y], [x1, y1]);
    (
        best,
        format!(
            "is the knee: up to it each doubling of the step's cost takes {before:.0} % off D, \
             beyond it {after:.0} %"
        ),
    )
}

/// Three figures.
fn short(x: f64) -> String {
    if x == x.trunc() && x.abs() < 1e6 {
        return format!("{x}");
    }
    let digits = (2 - x.abs().max(1e-300).log10().floor() as i32).clamp(0, 6) as usize;
    format!("{x:.digits$}")
}

fn joined(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [all @ .., last] => format!("{} and {last}", all.join(", ")),
    }
}

#[cfg(test)]
#[path = "choose_tests.rs"]
mod tests;
