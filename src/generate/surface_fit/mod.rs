//! Spheres fitted to the surface (M. Price, V. Murariu, G. Morrison, *Sphere clump generation and
//! trajectory comparison for real particles*, DEM 2007).
//!
//! Spheres through four random points of the surface; those that touch it from inside are kept,
//! until nearly every point lies on one; those alike are brought together; then points are given
//! to spheres and spheres fitted to their points, in turn, which squeezes some out. The number of
//! spheres is the method's own; asked for fewer, the largest are kept and fitted again.
//!
//! What differs from the paper, and why, is in docs/surface_fit.md.

mod cavities;
mod cluster;
mod draw;
mod fit;
mod four_point;
mod hull;
mod levenberg;
pub(in crate::generate) mod points;
mod rules;
mod sample;

use super::GenerateOptions;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, collected, count, figure};
use crate::math::Sphere;
use crate::run::Run;
use crate::solid::Solid;
use crate::solid::nearest::Surface;
use cavities::without_cavities;
use cluster::clusters;
use fit::Target;
use hull::Hull;
use points::Points;
use rules::Rules;
use sample::{Sieve, sample};
use std::cell::Cell;

/// Makes a clump.
pub(super) fn surface_fit(solid: &Solid, options: &GenerateOptions, run: &Run) -> Result<Clump> {
    check(options)?;
    run.check(0.0, "spreading points over the surface")?;
    let room = |held: u64| solid.memory_limit().saturating_sub(solid.bytes()).saturating_sub(held);
    let full = without_cavities(solid.body(), room(0))?;
    let own = match &full {
        Some(body) => Some(Surface::within(body, room(0))?),
        None => None,
    };
    let surface = match &own {
        Some(surface) => surface,
        None => solid.surface(run)?,
    };
    let held = own.as_ref().map_or(0, Surface::bytes);
    let body = full.as_ref().unwrap_or(solid.body());
    let points = Points::new(body, surface, room(held), run)?;
    run.check(0.05, "finding the convex hull")?;
    let hull = Hull::new(&points.at, &points.normals, run)?;
    let rules = Rules::of(solid, options, points.at.len());
    let sieve = Sieve { hull: &hull, surface, points: &points.at, rules: &rules };

    let ended = Cell::new(None);
    let ask = |fraction: f64, any: bool| {
        if run.cancelled(fraction) {
            ended.set(Some(Stopped::Cancelled));
        } else if any && run.late() {
            ended.set(Some(Stopped::Deadline));
        }
        ended.get().is_none()
    };
    let sampled = sample(&points, &sieve, run, &mut |f, any| ask(0.1 + 0.5 * f, any))?;
    run.count(|c| {
        c.spheres_tried += sampled.drawn;
        c.peak_bytes = c.peak_bytes.max(solid.bytes() + held);
    });
    let clusters = clusters(&sampled.spheres, rules.merge)?;
    let mut spheres = collected("the spheres", clusters.iter().map(|c| c.mean))?;
    if spheres.is_empty() {
        return Err(match ended.get() {
            None => Error::NoSpheres(none(options)),
            Some(_) => Error::Cancelled("cancelled by the caller before the first sphere".into()),
        });
    }
    let limit = if options.spheres == 0 { usize::MAX } else { options.spheres };
    let target = Target { points: &points.at, surface, rules: &rules };
    if ended.get().is_none() {
        target.fit(&mut spheres, run, &mut |f| ask(0.6 + 0.2 * f, true))?;
    }
    largest_first(&mut spheres);
    if spheres.len() > limit {
        spheres.truncate(limit);
        if ended.get().is_none() {
            target.fit(&mut spheres, run, &mut |f| ask(0.8 + 0.2 * f, true))?;
            largest_first(&mut spheres);
        }
    }
    let stopped = ended.get().unwrap_or(match spheres.len() >= limit {
        true => Stopped::Spheres,
        false => Stopped::Exhausted,
    });
    let note = note(stopped, options, spheres.len());
    let spheres =
        collected("the spheres", spheres.iter().map(|s| solid.frame().sphere_to_input(s)))?;
    Ok(Clump {
        spheres,
        stopped,
        note,
        warnings: Vec::new(),
        quality: None,
        counters: run.counters(),
    })
}

fn largest_first(spheres: &mut [Sphere]) {
    spheres.sort_by(|a, b| b.radius.total_cmp(&a.radius));
}

/// Refuses what the method does not read.
fn check(o: &GenerateOptions) -> Result<()> {
    let unread = [
        ("mismatch", o.mismatch != 0.0),
        ("min_distance", o.min_distance != 0.0),
        ("radius_offset", o.radius_offset != 0.0),
        ("confine", o.confine),
    ];
    match unread.iter().find(|u| u.1) {
        None => Ok(()),
        Some((name, _)) => Err(Error::InvalidArgument(format!(
            "{name} is an option of the method mss, not of surface-fit"
        ))),
    }
}

fn none(o: &GenerateOptions) -> String {
    match o.min_radius {
        0.0 => "no sphere through four points of the surface touches it from inside".into(),
        least => format!(
            "no sphere through four points of the surface that touches it from inside has a \
             radius of {} or more",
            figure(least)
        ),
    }
}

/// Why there are fewer spheres than were asked for.
fn note(stopped: Stopped, options: &GenerateOptions, n: usize) -> String {
    let of = match options.spheres {
        0 => count(n as u64, "sphere"),
        asked if n < asked => format!("{n} of {asked} spheres"),
        asked => format!("{asked} spheres"),
    };
    match stopped {
        Stopped::Deadline => format!("{of}: the deadline passed before they were fitted"),
        Stopped::Cancelled => format!("{of}: cancelled by the caller before they were fitted"),
        Stopped::Exhausted => format!("{of}: so many fit the surface from inside and differ"),
        _ => String::new(),
    }
}
