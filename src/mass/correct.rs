//! A mass for each sphere, so that the spheres together have the mass, centre and inertia of the
//! target (Yuan 2019, section 4).

use super::body::Body;
use super::outside::outside;
use super::pile::{Pile, check};
use super::problem::{INERTIA, Problem, ROWS, greatest, unitless};
use super::project::project;
use super::relax::{ALL, Demand, Goal, best, largest_least, least_error};
use super::share::shares;
use crate::error::{Error, Result, figure, filled};
use crate::math::Sphere;
use crate::run::Run;
use nalgebra::Matrix3;

/// Spheres at most: the solver takes about a kilobyte for each.
const MOST: usize = 1_000_000;
/// Equations met to this are met.
const EXACT: f64 = 1e-10;
/// What is left of equations that are met to rounding.
const ROUNDING: f64 = 1e-13;
/// Least inertia errors below this may be zero but for the solver's own.
const NEARLY: f64 = 1e-7;

/// What is wished of the masses beside the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Objective {
    /// Least Σ (m_i − s_i)² / s_i, where s_i is the part of the union's volume that the sphere
    /// stands for (overlaps shared equally among their spheres), at least m_min: the density
    /// varies as little as it can.
    #[default]
    Even,
    /// The greatest least mass (Yuan 2019, end of section 4).
    MaxMin,
    /// The greatest mass of the last sphere (Yuan 2019, eq 7).
    MaxLast,
}

/// What to do where no masses give the centre of mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Infeasible {
    /// Fail with [`Error::NoMasses`] and the reason.
    #[default]
    Refuse,
    /// Keep the total mass and make the greatest error of centre and inertia least.
    LeastError,
}

/// How masses are found. Masses are in the unit of the body's.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MassOptions {
    /// What is wished beside the equations.
    pub objective: Objective,
    /// Least mass of a sphere (the papers' lower bound). `None`: a thousandth of the body's mass,
    /// or a tenth of the mean where that is less. 0 stands for a billionth of the mean: a mass
    /// is never zero.
    pub m_min: Option<f64>,
    /// Greatest mass of a sphere; `None`: no bound.
    pub m_max: Option<f64>,
    /// What to do where even the centre of mass cannot be met.
    pub infeasible: Infeasible,
}

/// How far the equations are met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MassStatus {
    /// Mass, centre and inertia to 1e-10 or better.
    Exact,
    /// Mass and centre so; inertia with the least error that masses within the bounds allow.
    Relaxed,
    /// Mass so; centre and inertia with the least error. Only with [`Infeasible::LeastError`].
    MassOnly,
}

impl MassStatus {
    /// The word of the command line and the C ABI.
    pub fn name(self) -> &'static str {
        match self {
            MassStatus::Exact => "exact",
            MassStatus::Relaxed => "relaxed",
            MassStatus::MassOnly => "mass_only",
        }
    }
}

/// What the masses, as returned, miss of the target; all relative.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residuals {
    /// |Σ m − M| / M.
    pub mass: f64,
    /// Greatest component, along the body axes, of the distance between the centres, over the
    /// radius of gyration.
    pub center: f64,
    /// ε: the greatest |ΔI_jk| / √(J_j J_k) in the body frame, J the target's principal moments;
    /// on the diagonal that is the ε of Yuan 2019, eq 8.
    pub inertia: f64,
}

/// Masses of the spheres of a clump.
#[derive(Debug, Clone, PartialEq)]
pub struct Masses {
    /// One for each sphere, in its order; none is less than m_min.
    pub masses: Vec<f64>,
    /// How far the equations are met.
    pub status: MassStatus,
    /// What is left of them.
    pub residuals: Residuals,
    /// Spheres whose mass is m_min or m_max, to a ten-thousandth of the mean mass; ascending.
    pub binding: Vec<u32>,
    /// The least mass that was demanded.
    pub m_min: f64,
    /// Where not all equations are met: the greatest m_min with which they could be, under the
    /// same m_max; `None` where no positive masses meet them.
    pub largest_m_min: Option<f64>,
    /// Of [`Objective::Even`]: √(Σ (m_i − s_i)² / s_i / M), how far the density varies; else 0.
    pub spread: f64,
}

/// Masses for `spheres` (caller's frame) such that solid spheres of these masses, which may
/// overlap, have the mass, centre and inertia of `body`: all ten equations of Yuan 2019, (2) to
/// (5). Where no masses within the bounds do, mass and centre stay exact and the inertia error ε
/// is the least possible, then the objective the best at that ε.
///
/// The masses do not depend on the order of the spheres, on the caller's frame or unit, or on
/// the density but for its factor; with [`Objective::Even`] they are unique. Mirror images in the
/// planes of the body frame get equal masses.
///
/// Fails: no sphere; a sphere or bound that is not finite; a radius that is not above 0; a sphere
/// over 1000 radii of gyration large or away; m_min < 0, m_max < m_min, n m_min > M, n m_max < M;
/// more than a million spheres; [`Error::NoMasses`] where the centre of mass cannot be met;
/// cancelled by the caller.
pub fn correct(
    spheres: &[Sphere],
    body: &Body,
    options: &MassOptions,
    run: &Run,
) -> Result<Masses> {
    check(spheres)?;
    let n = spheres.len();
    if n > MOST {
        return Err(Error::TooLarge(format!(
            "{n} spheres are too many: masses are found for {MOST} at most"
        )));
    }
    let (m_min, m_max) = bounds(options, n, body.mass)?;
    let pile = Pile::new(&unitless(spheres, body)?)?;
    let mean = body.mass / n as f64;
    let problem = Problem::new(&pile, body, m_min / mean, m_max.map(|m| m / mean))?;
    let wish = match options.objective {
        Objective::Even => relative(shares(&pile, run)?, &problem),
        _ => Vec::new(),
    };
    let goal = match options.objective {
        Objective::Even => Goal::Even(&wish),
        Objective::MaxMin => Goal::MaxMin,
        Objective::MaxLast => {
            let last = n as u32 - 1;
            Goal::MaxOne(pile.order.iter().position(|i| *i == last).unwrap_or(0))
        }
    };
    run.check(0.5, "solving for the masses")?;
    let x = match exact(&problem, goal)? {
        Some(x) => x,
        None => {
            run.check(0.6, "solving for the masses")?;
            relaxed(&problem, goal, run, || match options.infeasible {
                Infeasible::LeastError => Ok(()),
                Infeasible::Refuse => Err(outside(&problem, &pile, body)?),
            })?
        }
    };
    let mut masses = filled("masses", n, 0.0)?;
    for (&i, x) in pile.order.iter().zip(&x) {
        masses[i as usize] = (x * mean).max(m_min).min(m_max.unwrap_or(f64::MAX));
    }
    let residuals = residuals(spheres, &masses, body);
    let status = if greatest(&[residuals.mass, residuals.center, residuals.inertia]) <= EXACT {
        MassStatus::Exact
    } else if residuals.mass.max(residuals.center) <= EXACT {
        MassStatus::Relaxed
    } else {
        MassStatus::MassOnly
    };
    let largest_m_min = if status == MassStatus::Exact {
        None
    } else {
        run.check(0.9, "solving for the masses")?;
        largest_least(&problem)?.map(|t| t * mean).filter(|m| *m > 0.0)
    };
    let touch = 1e-4 * mean;
    let bound = |m: f64| m - m_min <= touch || m_max.is_some_and(|most| most - m <= touch);
    let binding = (0..n as u32).filter(|&i| bound(masses[i as usize])).collect();
    let spread: f64 = x.iter().zip(&wish).map(|(x, s)| (x - s) * (x - s) / s).sum();
    let spread = (spread / n as f64).sqrt();
    Ok(Masses { masses, status, residuals, binding, m_min, largest_m_min, spread })
}

/// The least and the greatest mass of a sphere.
fn bounds(options: &MassOptions, n: usize, mass: f64) -> Result<(f64, Option<f64>)> {
    let mean = mass / n as f64;
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    for (name, m) in [("m_min", options.m_min), ("m_max", options.m_max)] {
        if let Some(m) = m.filter(|m| !m.is_finite()) {
            return Err(Error::NotFinite(format!("{name} is {m}")));
        }
    }
    let least = match options.m_min {
        None => (mass / 1000.0).min(0.1 * mean),
        Some(m) if m < 0.0 => return refuse(format!("m_min is {}, below 0", figure(m))),
        Some(m) => m.max(1e-9 * mean),
    };
    if let Some(m) = options.m_max.filter(|m| *m < options.m_min.unwrap_or(0.0) || *m <= 0.0) {
        return refuse(format!(
            "m_max is {}, less than m_min = {}",
            figure(m),
            figure(options.m_min.unwrap_or(least))
        ));
    }
    // A mean that the caller computed may be rounded.
    if least > mean * (1.0 + 1e-12) {
        return refuse(format!(
            "m_min is {}: {n} spheres of that mass are heavier than the target, whose mass is {}",
            figure(least),
            figure(mass)
        ));
    }
    if let Some(m) = options.m_max.filter(|m| *m < mean * (1.0 - 1e-12)) {
        return refuse(format!(
            "m_max is {}: {n} spheres of that mass are lighter than the target, whose mass is {}",
            figure(m),
            figure(mass)
        ));
    }
    // No sphere is heavier than the whole.
    Ok((least.min(mean), options.m_max.filter(|m| *m < mass).map(|m| m.max(mean))))
}

/// Shares as multiples of their mean, within the bounds.
fn relative(shares: Vec<f64>, p: &Problem) -> Vec<f64> {
    let sum: f64 = shares.iter().sum();
    let mean = sum / p.n as f64;
    // Spheres too small to have a volume share alike.
    if !(mean > 0.0 && mean.is_finite()) {
        return vec![p.clamp(1.0); p.n];
    }
    shares.iter().map(|s| p.clamp(s / mean)).collect()
}

/// Masses that meet all ten equations to rounding; `None` where none were found.
fn exact(p: &Problem, goal: Goal) -> Result<Option<Vec<f64>>> {
    if let Goal::Even(s) = goal {
        return Ok(project(p, ROWS, s, s, EXACT).map(|x| settle(p, x)));
    }
    let Some(x) = best(p, goal, ALL, 0.0)? else { return Ok(None) };
    Ok(polish(p, goal, ROWS, &x))
}

/// The nearest masses that meet the first `rows` equations to rounding.
fn polish(p: &Problem, goal: Goal, rows: usize, x: &[f64]) -> Option<Vec<f64>> {
    let weights = vec![1.0; p.n];
    let least = x.iter().fold(f64::MAX, |m, x| m.min(*x));
    if matches!(goal, Goal::MaxMin) {
        // What was won is not given away.
        for less in [1e-9, 1e-7, 1e-5] {
            let p = Problem { least: p.least.max(least - less), ..p.clone() };
            if let Some(x) = project(&p, rows, x, &weights, EXACT) {
                return Some(settle(&p, x));
            }
        }
    }
    project(p, rows, x, &weights, EXACT).map(|x| settle(p, x))
}

/// Equations that contradict each other by rounding are all missed a little: then mass and centre
/// are met, or the mass, and the others take what is left.
fn settle(p: &Problem, x: Vec<f64>) -> Vec<f64> {
    if greatest(&p.residuals(&x)[..INERTIA]) <= ROUNDING {
        return x;
    }
    let weights = vec![1.0; p.n];
    let better = |rows| project(p, rows, &x, &weights, ROUNDING);
    better(INERTIA).or_else(|| better(1)).unwrap_or(x)
}

/// Masses with the least error: of the inertia, or, where the centre of mass cannot be met and
/// `otherwise` allows it, of both.
fn relaxed(
    p: &Problem,
    goal: Goal,
    run: &Run,
    otherwise: impl FnOnce() -> Result<()>,
) -> Result<Vec<f64>> {
    let stages = [Demand { hard: INERTIA, soft: ROWS }, Demand { hard: 1, soft: ROWS }];
    let mut otherwise = Some(otherwise);
    for demand in stages {
        if demand.hard == 1
            && let Some(ask) = otherwise.take()
        {
            ask()?;
        }
        let Some((error, x)) = least_error(p, demand)? else { continue };
        run.check(0.7, "solving for the masses")?;
        if error <= NEARLY
            && let Some(x) = best(p, goal, ALL, 0.0)?.or(Some(x.clone()))
            && let Some(x) = polish(p, goal, ROWS, &x)
        {
            return Ok(x);
        }
        // A little room, without which the solver finds no inside.
        let x = best(p, goal, demand, error * (1.0 + 1e-4) + 1e-9)?.unwrap_or(x);
        if let Some(x) = polish(p, goal, demand.hard, &x) {
            return Ok(x);
        }
    }
    Err(Error::Internal("no masses were found, not even such that add up".into()))
}

/// What the masses miss, by plain sums in the caller's frame.
fn residuals(spheres: &[Sphere], masses: &[f64], body: &Body) -> Residuals {
    let turn = body.principal.axes;
    let (mut mass, mut first) = (0.0, nalgebra::Vector3::zeros());
    let mut inertia = Matrix3::zeros();
    for (s, &m) in spheres.iter().zip(masses) {
        let d = s.center - body.center;
        mass += m;
        first += d * m;
        let own = 0.4 * s.radius * s.radius + d.norm_squared();
        inertia += (Matrix3::identity() * own - d * d.transpose()) * m;
    }
    let off = turn.transpose() * first / (body.mass * body.gyration());
    let miss = turn.transpose() * (inertia - body.inertia.matrix()) * turn;
    let root = body.principal.moments.map(f64::sqrt);
    let mut worst = 0.0f64;
    for j in 0..3 {
        for k in 0..3 {
            worst = worst.max(miss[(j, k)].abs() / (root[j] * root[k]));
        }
    }
    Residuals { mass: (mass - body.mass).abs() / body.mass, center: off.amax(), inertia: worst }
}

#[cfg(test)]
#[path = "correct_tests.rs"]
pub(super) mod tests;
