//! Balls of nearly one size that do not overlap, as large as their number allows: the grains of
//! a body that may break. They cover it poorly, a half to two thirds of it (docs/packed.md).

mod lattice;
mod near;
mod radii;
mod relax;
mod room;
mod starts;
#[cfg(test)]
mod test_bodies;

use super::balls::random::Random;
use super::baselines::climb::climb;
use super::{Effort, GenerateOptions};
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, collected, figure, reserve};
use crate::math::{PrincipalFrame, Sphere, Vec3};
use crate::run::Run;
use crate::solid::Solid;
use relax::{Packing, Push, relax};
use room::Room;
use starts::{Ground, Start};

/// Most spheres of a clump.
const MOST: usize = 100_000;
/// Starts that are pushed side by side between two looks at the clock.
const BATCH: usize = 8;
/// Tries to fit in more spheres of a given radius.
const TRIES: usize = 6;

/// What is done for `n` balls, by counts.
struct Plan {
    poses: usize,
    crystals: usize,
    lots: usize,
    steps: usize,
    /// How many of the best are pushed to the end, and in how many steps.
    finals: usize,
    last_steps: usize,
}

impl Plan {
    fn of(n: usize) -> Plan {
        // Steps of single balls in all: a million is about a quarter of a second.
        let share = |total: usize, least: usize, most: usize| (total / n.max(1)).clamp(least, most);
        Plan {
            poses: share(20_000, 8, 32),
            crystals: share(1_000, 2, 6),
            lots: share(600, 2, 26),
            steps: share(60_000, 60, 500),
            finals: 3,
            last_steps: share(100_000, 80, 800),
        }
    }
}

/// Makes a clump.
pub(super) fn packed(solid: &Solid, options: &GenerateOptions, run: &Run) -> Result<Clump> {
    check(options)?;
    run.check(0.0, "measuring the distances of cells")?;
    let scale = solid.frame().scale;
    let room = Room::new(solid, run)?;
    let volume = solid.unit_moments().volume;
    let inertia = PrincipalFrame::of_rounded(&solid.unit_moments().inertia, solid.frame().noise());
    let axes = [0, 1, 2].map(|a| inertia.axes.column(a).into_owned());
    let mut random = Random::new(run.seed(), 0);
    let poses = Plan::of(options.spheres.max(1)).poses;
    let ground = Ground::new(&room, volume, axes, poses, &mut random)?;
    let mut search = Search { room: &room, ground: &ground, run, ended: None, tried: 0 };

    let noise = solid.frame().noise();
    // The last step takes the roundings off.
    let least = match options.min_radius.min(2.0 * scale) / scale {
        0.0 => 0.0,
        least => least + 2.0 * radii::ROUNDINGS * noise,
    };
    let asked = options.spheres;
    let mut found = None;
    if asked > 0 {
        found = search.pack(asked)?;
    }
    let fits = |p: &Packing| p.radius > 0.0 && p.radius >= least;
    if !found.as_ref().is_some_and(fits) && search.ended.is_none() && asked != 1 {
        found = search.most(least, asked)?;
    }
    if !found.as_ref().is_some_and(fits) && search.ended == Some(Stopped::Deadline) {
        // There is a clump however early the deadline.
        found = search.pack(1)?;
    }
    let ended = search.ended;
    let tried = search.tried;
    run.count(|c| {
        c.spheres_tried += tried;
        c.peak_bytes = c.peak_bytes.max(solid.bytes());
    });
    let frame = solid.frame();
    let spheres = match found.filter(fits) {
        Some(packing) => radii::spheres(&room, &packing.centers, noise)?,
        None => Vec::new(),
    };
    if spheres.is_empty() {
        return Err(match ended {
            Some(Stopped::Cancelled) => {
                Error::Cancelled("cancelled by the caller before the first sphere".into())
            }
            _ if least > 0.0 => Error::NoSpheres(format!(
                "no sphere within the target has a radius of {} or more",
                figure(options.min_radius)
            )),
            _ => Error::NoSpheres("no place within the target was found".into()),
        });
    }
    let n = spheres.len();
    let stopped = match ended {
        Some(stopped) => stopped,
        None if n == asked => Stopped::Spheres,
        None => Stopped::Radius,
    };
    let of = if asked == 0 { format!("{n} spheres") } else { format!("{n} of {asked} spheres") };
    let note = match stopped {
        Stopped::Deadline => format!("{of}: the deadline passed before larger ones were found"),
        Stopped::Cancelled => {
            format!("{of}: cancelled by the caller before larger ones were found")
        }
        Stopped::Radius => {
            format!("{of}: more were found only smaller than {}", figure(options.min_radius))
        }
        _ => String::new(),
    };
    let spheres: Vec<Sphere> =
        collected("the spheres", spheres.iter().map(|s| frame.sphere_to_input(s)))?;
    Ok(Clump {
        spheres,
        stopped,
        note,
        warnings: Vec::new(),
        quality: None,
        counters: run.counters(),
    })
}

/// The search for packings.
struct Search<'a, 'r> {
    room: &'a Room<'a>,
    ground: &'a Ground<'a>,
    run: &'a Run<'r>,
    /// Why it ended early.
    ended: Option<Stopped>,
    tried: u64,
}

impl Search<'_, '_> {
    /// Whether to go on.
    fn go(&mut self, done: f64) -> bool {
        if self.run.cancelled(done) {
            self.ended = Some(Stopped::Cancelled);
        } else if self.run.late() {
            self.ended = Some(Stopped::Deadline);
        }
        self.ended.is_none()
    }

    /// `n` balls, as large as they are found.
    fn pack(&mut self, n: usize) -> Result<Option<Packing>> {
        let plan = Plan::of(n);
        let mut starts: Vec<Start> = reserve("starts", plan.crystals + plan.lots + 1)?;
        starts.extend(self.ground.greedy(n)?);
        if n > 2 {
            starts.extend(self.ground.crystals(n, plan.crystals, self.run)?);
        }
        let mut random = Random::new(self.run.seed(), n as u64);
        for _ in 0..plan.lots {
            starts.extend(self.ground.lot(n, &mut random)?);
        }
        let first = Push { steps: plan.steps, overlap: [0.2, 2e-3], exact: false };
        let last = Push { steps: plan.last_steps, overlap: [0.02, 1e-6], exact: true };
        let mut found: Vec<Packing> = reserve("packings", starts.len())?;
        let all = starts.len().max(1) as f64;
        for (i, batch) in starts.chunks(BATCH).enumerate() {
            // The first batch is always pushed: there is a clump however early the deadline.
            if i > 0 && !self.go(0.7 * (i * BATCH) as f64 / all) {
                break;
            }
            if i == 0 && self.run.cancelled(0.0) {
                self.ended = Some(Stopped::Cancelled);
                return Ok(None);
            }
            let pushed = self
                .run
                .pool()
                .map(batch.len(), |k| relax(self.room, &batch[k].centers, batch[k].radius, &first));
            for packing in pushed {
                found.push(packing?);
            }
            self.tried += (batch.len() * n) as u64;
        }
        found.sort_by(|a, b| b.radius.total_cmp(&a.radius));
        found.truncate(plan.finals);
        if found.is_empty() {
            return Ok(None);
        }
        if self.ended.is_some() {
            found.truncate(1);
        }
        let pushed = self
            .run
            .pool()
            .map(found.len(), |k| relax(self.room, &found[k].centers, found[k].radius, &last));
        let mut best: Option<Packing> = None;
        for packing in pushed {
            let packing = packing?;
            if best.as_ref().is_none_or(|b| packing.radius > b.radius) {
                best = Some(packing);
            }
        }
        // What holds several holds one only across: it drifts along a ridge for long.
        if let Some(Packing { centers, radius }) = &mut best
            && let [center] = centers.as_mut_slice()
        {
            let depth = |p: &Vec3| self.room.depth(p);
            (*center, *radius) = climb(*center, depth(center), 0.1 * self.ground.bound(1), depth);
        }
        Ok(best)
    }

    /// As many balls of the radius `least` or more as are found, fewer than `limit` if that
    /// is not 0.
    fn most(&mut self, least: f64, limit: usize) -> Result<Option<Packing>> {
        let limit = if limit == 0 { MOST + 1 } else { limit };
        if limit > MOST && self.ground.by_volume(least) > 1.5 * MOST as f64 {
            return Err(Error::InvalidArgument(format!(
                "by volume, {:.0} spheres of the least radius go into the target, and the method \
                 packed makes at most {MOST}",
                self.ground.by_volume(least)
            )));
        }
        let fitting = if least > 0.0 { self.ground.fitting(least, self.run) } else { 0 };
        // `fits` balls have been packed, `fails` balls have not.
        let (mut fits, mut fails) = (0, limit);
        let mut best = None;
        let mut next = fitting.clamp(1, limit.saturating_sub(1).max(1));
        let mut tries = 0usize;
        while fails - fits > 1 && (tries < TRIES || best.is_none()) {
            match self.pack(next)? {
                Some(packing) if packing.radius >= least => {
                    fits = next;
                    best = Some(packing);
                }
                _ => fails = next,
            }
            tries += 1;
            if self.ended.is_some() || fails <= 1 {
                break;
            }
            next = match best {
                // Not far above what fits: a lattice has nearly as many as there can be.
                Some(_) => (fits + (fits / 8).max(2)).min(fits + (fails - fits) / 2).max(fits + 1),
                // Fewer, and in ever longer steps.
                None => (fails - (fails >> 4usize.saturating_sub(tries).max(1)).max(1)).max(1),
            };
        }
        Ok(best)
    }
}

/// Refuses what the method does not read.
fn check(o: &GenerateOptions) -> Result<()> {
    for (name, given) in [
        ("min_distance", o.min_distance != 0.0),
        ("radius_offset", o.radius_offset != 0.0),
        ("confine", o.confine),
        ("mismatch", o.mismatch != 0.0),
        ("effort", o.effort != Effort::Normal),
    ] {
        if given {
            return Err(Error::InvalidArgument(format!(
                "{name} is not an option of the method packed"
            )));
        }
    }
    if o.spheres > MOST {
        return Err(Error::InvalidArgument(format!(
            "{} spheres are asked of the method packed, and it makes at most {MOST}",
            o.spheres
        )));
    }
    if o.spheres == 0 && o.min_radius == 0.0 {
        return Err(Error::InvalidArgument(
            "the method packed needs a number of spheres or min_radius, and both are 0".into(),
        ));
    }
    Ok(())
}
