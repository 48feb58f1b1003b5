//! The MSS algorithm of Buchele, Pöschel and Müller (arXiv:2603.05877, 2026): spheres at
//! the local maxima of the distance transform E, then at those of 2E − Ẽ.
//!
//! What differs from the paper, and why, is in docs/mss.md. In short: the
//! radius is the true depth, not E, which has a bias; of the maxima those
//! are taken first that bring D down most; where maxima run out, the cells
//! still uncovered lead to further spheres.

mod candidates;
mod center;
pub(in crate::generate) mod counts;
mod depth;
pub(in crate::generate) mod lattice;
mod maxima;
mod residue;
mod select;
mod settle;
mod slots;
mod subvoxel;
mod symmetry;
pub(in crate::generate) mod target;
mod transform;

use super::GenerateOptions;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, collected, count, figure, filled, push};
use crate::run::Run;
use crate::solid::Solid;
use candidates::Fields;
use counts::Counts;
use lattice::Ball;
use residue::Residue;
use select::{Pool, Rules, stop};
use settle::{SETTLING, settle};
use target::Target;

/// Spheres of a round, as a part of those before it, and at least.
const ROUND: (usize, usize) = (2, 4);

/// A round ends when the best place left gains less than this part of its first.
const WORTH: f64 = 0.3;

/// Uncovered cells count as deep from this part of the deepest on, until they run out.
const DEEP: f32 = 0.5;

/// Makes a clump by MSS.
pub(super) fn mss(solid: &Solid, options: &GenerateOptions, run: &Run) -> Result<Clump> {
    run.check(0.0, "measuring the distances of cells")?;
    let target = Target::of(solid, options.confine, run)?;
    let cell = target.cell() * solid.frame().scale;
    let rules = Rules {
        offset: options.radius_offset,
        min_radius: options.min_radius / cell,
        min_distance: options.min_distance,
        confine: options.confine,
    };
    let made = grow(&target, rules, options, run);
    run.count(|c| c.exact_distances += target.asked());
    let made = made?;
    let spheres = collected("the spheres", made.balls.iter().map(|b| target.sphere(b)))?;
    let note = note(&made, options, spheres.len());
    Ok(Clump {
        spheres,
        stopped: made.stopped,
        note,
        warnings: Vec::new(),
        quality: None,
        counters: run.counters(),
    })
}

/// What the search came to.
struct Made {
    balls: Vec<Ball>,
    stopped: Stopped,
    mismatch: f64,
}

/// Adds spheres until a criterion is met.
fn grow(target: &Target, rules: Rules, options: &GenerateOptions, run: &Run) -> Result<Made> {
    let limit = if options.spheres == 0 { usize::MAX } else { options.spheres };
    let aim = options.mismatch;
    let mut covered = filled("the cells of the clump", target.bits.len(), 0u64)?;
    let mut fields = Fields::new(target)?;
    run.count(|c| {
        let bytes = target.bytes() + fields.bytes() + covered.len() * 8;
        c.peak_bytes = c.peak_bytes.max(c.cells + bytes as u64);
    });
    let mut counts = Counts { target: target.cells, ..Counts::default() };
    let mut pool = Pool::new(rules);
    let mut balls: Vec<Ball> = Vec::new();
    let mut orbits: Vec<Vec<Ball>> = Vec::new();
    let places = fields.of_target(target, run)?;
    pool.add(target, places, &Residue::count(&target.lattice, &target.bits, &covered)?)?;
    let mut part = DEEP;
    let mut led = false;
    let stopped = 'search: loop {
        let quota = (balls.len() / ROUND.0).max(ROUND.1);
        let before = balls.len();
        let mut first = None;
        while balls.len() - before < quota {
            let share = balls.len() as f64 / limit as f64;
            let done = share.max((1.0 - counts.mismatch()) / (1.0 - aim).max(1e-6)).min(1.0);
            if run.cancelled(0.1 + 0.9 * done) {
                break 'search Stopped::Cancelled;
            }
            if !balls.is_empty() && run.late() {
                break 'search Stopped::Deadline;
            }
            let Some(choice) =
                pool.best(target, &covered, &counts, &balls, limit - balls.len(), run)?
            else {
                if stop(run, &balls) {
                    continue; // The checks above say why.
                }
                break;
            };
            // New places may be better than what is left of the old ones.
            if choice.score < WORTH * *first.get_or_insert(choice.score) {
                pool.put_back(choice);
                break;
            }
            let mut added = Vec::new();
            let mut reached = None;
            let whole = choice.orbit.len();
            for ball in choice.orbit {
                let gain = target.lattice.gain(&ball, &target.bits, &covered);
                let next = counts.with(gain);
                if next.mismatch() >= counts.mismatch() {
                    continue;
                }
                target.lattice.cover(&ball, &target.bits, &mut covered);
                counts = next;
                push("the spheres", &mut balls, ball)?;
                added.push(ball);
                if aim > 0.0 && counts.mismatch() <= aim {
                    reached = Some(Stopped::Mismatch);
                } else if balls.len() >= limit {
                    reached = Some(Stopped::Spheres);
                }
                if reached.is_some() {
                    break;
                }
            }
            let settles = added.len() == whole && balls.len() <= SETTLING;
            if !added.is_empty() {
                push("the spheres", &mut orbits, added)?;
            }
            if settles && orbits.len() > 1 && reached != Some(Stopped::Mismatch) {
                let cells = [covered.as_mut_slice(), fields.spare()];
                if settle(&pool, target, &mut orbits, cells, &mut counts, run) {
                    balls = orbits.concat();
                    pool.renew(target, &Residue::count(&target.lattice, &target.bits, &covered)?)?;
                }
                if aim > 0.0 && counts.mismatch() <= aim {
                    reached = Some(Stopped::Mismatch);
                }
            }
            if let Some(reason) = reached {
                break 'search reason;
            }
        }
        if balls.len() == before && led {
            if part == 0.0 {
                break match pool.small_one_helps(target, &covered, &counts, &balls) {
                    true => Stopped::Radius,
                    false => Stopped::Exhausted,
                };
            }
            part = 0.0;
        }
        led = true;
        let places = fields.of_clump(target, &covered, part, run)?;
        pool.add(target, places, &Residue::count(&target.lattice, &target.bits, &covered)?)?;
    };
    if balls.is_empty() {
        return Err(match stopped {
            Stopped::Cancelled => {
                Error::Cancelled("cancelled by the caller before the first sphere".into())
            }
            Stopped::Radius => Error::NoSpheres(format!(
                "no sphere that fits has a radius of {} or more",
                figure(options.min_radius)
            )),
            _ => Error::NoSpheres("no sphere in the solid brings the mismatch down".into()),
        });
    }
    Ok(Made { balls, stopped, mismatch: counts.mismatch() })
}

/// Why there are fewer spheres than were asked for.
fn note(made: &Made, options: &GenerateOptions, n: usize) -> String {
    let of = match options.spheres {
        0 => count(n as u64, "sphere"),
        asked if n < asked => format!("{n} of {asked} spheres"),
        _ => return String::new(),
    };
    let d = made.mismatch;
    match made.stopped {
        Stopped::Spheres | Stopped::Coverage => String::new(),
        Stopped::Mismatch => format!("{of}: the mismatch on the grid is {d:.4}, as low as asked"),
        Stopped::Radius => {
            let least = figure(options.min_radius);
            format!("{of}: every further sphere that helps is smaller than {least}")
        }
        Stopped::Deadline => format!("{of}: the deadline passed"),
        Stopped::Cancelled => format!("{of}: cancelled by the caller"),
        Stopped::Exhausted => {
            let apart = match options.min_distance {
                0.0 => String::new(),
                least => format!(" at a distance of {least} cells or more"),
            };
            format!(
                "{of}: no further sphere{apart} brings the mismatch on the grid below {d:.4}; a \
                 finer grid takes more"
            )
        }
    }
}
