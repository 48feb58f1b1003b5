//! Clumps that stay within the surface: every radius is the exact depth of its centre (and a
//! tolerance). With the radius bound to the place, three unknowns are left for each sphere:
//! a greedy cover by medial balls, a climb of the covered volume by feasible steps only, and
//! swaps of the ball that covers least alone for one in a gap.

mod climb;
mod depth;
mod effort;
mod swap;

use super::GenerateOptions;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, figure, filled, fits, reserve};
use crate::generate::balls::bounds;
use crate::generate::balls::dexels::Dexels;
use crate::generate::balls::field::Field;
use crate::generate::balls::random::Random;
use crate::generate::select::choose;
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::solid::Solid;
use climb::Climb;
use depth::{Depth, Inside};
use swap::Swaps;

/// Most spheres of a clump.
const MOST: usize = 100_000;
/// Least radius, as a part of the body's size.
const LEAST: f64 = 0.002;

/// What balls must stay in beside the surface: for a place, unit frame, the depth there, less than 0
/// outside, and the nearest point of what bounds it.
pub type Bound<'a> = &'a (dyn Fn(&Vec3) -> (f64, Vec3) + Sync);

/// Makes a clump.
pub(in crate::generate) fn inscribed(
    solid: &Solid,
    options: &GenerateOptions,
    bound: Option<Bound>,
    run: &Run,
) -> Result<Clump> {
    let n = check(options)?;
    if options.tolerance > solid.frame().scale {
        return Err(Error::InvalidArgument(format!(
            "tolerance is {}, more than the size of the body",
            figure(options.tolerance)
        )));
    }
    run.check(0.0, "measuring the distances of cells")?;
    let mut field = Field::new(solid.grid(), solid.distance(run)?, run.pool())?;
    if let Some(bound) = bound {
        field.narrow(solid.grid(), bound, run.pool());
    }
    let plan = effort::plan(options.effort, n);
    let dexels = Dexels::new(solid, &bounds(solid)?, plan.columns, run.pool())?;
    let surface = solid.surface(run)?;
    run.count(|c| {
        c.columns += (dexels.dims[0] * dexels.dims[1]) as u64;
        c.peak_bytes = c.peak_bytes.max(solid.bytes() + field.bytes() + dexels.bytes());
    });
    // Points and candidates of the greedy cover, and what columns hold: twice.
    let own = 44 * plan.points as u64 + 72 * plan.candidates as u64;
    let own = own + 16 * (dexels.dims[0] * dexels.dims[1]) as u64 + 160 * n as u64;
    let held = solid.bytes() + field.bytes() + dexels.bytes();
    let room = solid.memory_limit().saturating_sub(held);
    fits(format_args!("{n} spheres of the method inscribed"), own, room)?;
    run.count(|c| c.peak_bytes = c.peak_bytes.max(held + own));
    let size = (solid.unit_moments().volume / 0.2).cbrt();
    let scale = solid.frame().scale;
    let least = (LEAST * size).max(options.min_radius / scale);
    let tolerance = options.tolerance / scale;
    let depth = Depth { field: &field, surface, bound, tolerance, least, size: size as f32 };
    let mut random = Random::new(run.seed(), 0);

    run.check(0.1, "looking for medial balls")?;
    let mut candidates = reserve("candidates", plan.candidates)?;
    let places = dexels.points(plan.candidates, &mut random)?;
    candidates.extend(places.into_iter().map(|p| depth.nearly(p)));
    candidates.retain(|b| f64::from(b.radius) >= least);
    let points = dexels.points(plan.points, &mut random)?;
    let chosen = choose(points, &candidates, n)?;
    // Where all points are covered before there are enough: any further ones.
    let mut left = filled("candidates", candidates.len(), true)?;
    chosen.iter().for_each(|&i| left[i] = false);
    let rest = (0..candidates.len()).filter(|&i| left[i]);
    let mut balls: Vec<Inside> = reserve("balls", n)?;
    let exact =
        chosen.iter().copied().chain(rest).filter_map(|i| depth.exact(candidates[i].center));
    balls.extend(exact.take(n));
    if balls.is_empty() {
        return Err(Error::NoSpheres(format!(
            "none of {} balls within the target has a radius of {:e} or more",
            plan.candidates,
            least * scale
        )));
    }
    let mut stopped = Stopped::Spheres;
    let mut go = |done: f64| {
        if run.cancelled(done) {
            stopped = Stopped::Cancelled;
        } else if run.late() {
            stopped = Stopped::Deadline;
        }
        stopped == Stopped::Spheres
    };
    let mut climb = Climb::new(&dexels, &depth, balls)?;
    climb.climb(plan.sweeps, &mut random, &mut |k| go(0.2 + 0.3 * k));
    let mut swaps = Swaps::new(climb.balls.len());
    swaps.search(&mut climb, plan.swaps, &mut random, &mut |k| go(0.5 + 0.5 * k));

    let coverage = climb.coverage();
    let mut spheres: Vec<Sphere> = reserve("spheres", climb.balls.len())?;
    spheres.extend(climb.balls.iter().map(|b| depth.sphere(&b.ball)));
    spheres.sort_by(|x, y| y.radius.total_cmp(&x.radius));
    for s in &mut spheres {
        *s = solid.frame().sphere_to_input(s);
    }
    let short = spheres.len() < n && stopped == Stopped::Spheres;
    let note = match stopped {
        Stopped::Deadline => format!("the deadline passed at a coverage of about {coverage:.4}"),
        Stopped::Cancelled => {
            format!("cancelled by the caller at a coverage of about {coverage:.4}")
        }
        _ if short => format!("{} balls were found within the target", spheres.len()),
        _ => String::new(),
    };
    if short {
        stopped = Stopped::Exhausted;
    }
    Ok(Clump {
        spheres,
        stopped,
        note,
        warnings: Vec::new(),
        quality: None,
        counters: run.counters(),
    })
}

/// The number of spheres.
fn check(o: &GenerateOptions) -> Result<usize> {
    for (name, given) in [
        ("min_distance", o.min_distance != 0.0),
        ("radius_offset", o.radius_offset != 0.0),
        ("confine", o.confine),
        ("mismatch", o.mismatch != 0.0),
    ] {
        if given {
            return Err(Error::InvalidArgument(format!(
                "{name} is not an option of the method inscribed"
            )));
        }
    }
    if o.spheres == 0 || o.spheres > MOST {
        return Err(Error::InvalidArgument(format!(
            "{} spheres are asked of the method inscribed, and it makes 1 to {MOST}",
            o.spheres
        )));
    }
    Ok(o.spheres)
}

#[cfg(test)]
mod tests;
