//! The generator of least mismatch: for a number of spheres, the clump whose union is closest to
//! the target by volume.
//!
//! A greedy cover by grown medial balls; then all balls move and grow at once so that the exposed
//! surface comes to lie on the target's, in a loss that turns from least squares of distances
//! into the volume between the surfaces; then single balls are moved to where they help more,
//! with what is around them refined, and kept when the mismatch by exact columns falls.

mod connected;
mod effort;
pub(super) mod fewest;
mod finish;
mod limits;
pub(super) mod memory;
mod moves;
mod options;
mod refine;
mod search;
mod seeds;
mod start;
mod state;
mod symmetry;
mod target;
mod volume;
mod watch;

pub use effort::Effort;
pub use options::{BestOptions, HalfSpace, Symmetry};

use super::GenerateOptions;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, figure, fits};
use crate::generate::balls::cover::Look;
use crate::generate::balls::piles::Piles;
use crate::generate::balls::smooth::Smooth;
use crate::run::Run;
use crate::solid::Solid;
use limits::{Exact, Limits};
use memory::Memory;
use refine::Radii;
use search::{BATCH, Search};
use start::Start;
use state::Ground;
use watch::Watch;

/// Most spheres of a clump. Their numbers fit in the tags of chords.
const MOST: usize = 100_000;
/// Least radius, as a part of the body's size.
const LEAST: f64 = 0.002;

/// Least directions and iterations of a refinement to a volume.
const LAST: usize = 50;

/// Makes a clump.
fn best(solid: &Solid, options: &GenerateOptions, run: &Run) -> Result<Clump> {
    after(solid, options, &mut Memory::default(), run)
}

/// Makes the field that levels of these options share: all, or of [`Effort::Draft`] those of about as
/// many spheres.
pub(super) fn prepare(
    solid: &Solid,
    options: &GenerateOptions,
    memory: &mut Memory,
    run: &Run,
) -> Result<()> {
    let planes = limits::planes(&options.best, solid.frame());
    memory.field(solid, &planes, options.effort.plan(options.spheres).cells, run)?;
    Ok(())
}

/// Makes a clump, with what is remembered of one before.
pub(super) fn after(
    solid: &Solid,
    options: &GenerateOptions,
    memory: &mut Memory,
    run: &Run,
) -> Result<Clump> {
    let wanted = check(options)?;
    run.check(0.0, "measuring the distances of cells")?;
    let (frame, asked) = (solid.frame(), &options.best);
    let planes = limits::planes(asked, frame);
    let plan = options.effort.plan(wanted);
    let (before, overshoot) = memory.start(wanted, asked);
    let (field, cells) = memory.field(solid, &planes, plan.cells, run)?;
    let choices = symmetry::choices(solid, field, asked, &planes, wanted)?;
    let n = choices.first().map_or(wanted, |s| s.most(wanted));
    let columns = choices.first().map_or(plan.columns, |s| s.columns(plan.columns));
    let (dexels, volume) = target::dexels(solid, &planes, cells, columns, run)?;
    run.count(|c| {
        c.columns += (dexels.dims[0] * dexels.dims[1]) as u64;
        c.peak_bytes = c.peak_bytes.max(solid.bytes() + field.bytes() + dexels.bytes());
    });
    // The length for which the widths were found: a body of a fifth of its box's cube has 1.
    let size = (volume / 0.2).cbrt();
    if asked.max_radius > 0.0 && asked.max_radius / frame.scale < LEAST * size {
        return Err(Error::NoSpheres(format!(
            "max_radius is {}, less than {LEAST} of the body's size",
            figure(asked.max_radius)
        )));
    }
    let most = if asked.max_radius > 0.0 { asked.max_radius / frame.scale } else { f64::MAX };
    let most = most.min(f64::from(f32::MAX)) as f32;
    let least = (LEAST * size).max(options.min_radius / frame.scale) as f32;
    let radii = Radii { least: least.min(most), most };
    let protrusion = match asked.max_protrusion {
        0.0 => None,
        most => Some((most / frame.scale, solid.surface(run)?)),
    };
    let limits = Limits::new(&planes, protrusion);
    let least = 0.5 * f64::from(radii.least) * frame.scale;
    let exact = Exact::new(solid, asked, [options.min_radius, least], run)?;
    let ground = Ground {
        field,
        dexels: &dexels,
        radii,
        limits: &limits,
        overshoot,
        connected: asked.connected,
        size: size as f32,
        room: solid.memory_limit().saturating_sub(solid.bytes() + field.bytes() + dexels.bytes()),
    };
    let held = solid.bytes() + field.bytes() + dexels.bytes();
    let columns = dexels.dims[0] * dexels.dims[1];
    let start = (plan.starts as u64 - 1).max(1) * seeds::bytes(&plan);
    let later = 16 * columns as u64 + Piles::expected(columns, plan.columns, n);
    fits(format_args!("{n} spheres of the method best"), start.max(later), ground.room)?;
    run.count(|c| c.peak_bytes = c.peak_bytes.max(held + start));
    let mut look = Look::default();
    let watch = Watch::new(run);
    let mut done = 0.0;
    let mut go = || {
        done += 1.0 / plan.iterations as f64;
        watch.at(0.1 + 0.3 * f64::min(done, 1.0))
    };
    let smooth = if asked.smoothness > 0.0 {
        let (grid, seed) = (solid.grid(), run.seed());
        let room = ground.room.saturating_sub(later);
        Some(Smooth::new(asked.smoothness, grid, (field, &dexels), (n, volume), seed, room)?)
    } else {
        None
    };
    let start = Start { ground, plan, n, seed: run.seed(), pool: run.pool() };
    let mut state = match &before {
        Some((balls, fixed)) => start.after(balls, *fixed, smooth, &mut look, &mut go)?,
        None => start.best(&choices, smooth, &mut look, &mut go)?,
    };
    state.join(&mut look, &watch)?;
    let mut peak = state.bytes();
    let mut search = Search::new(&mut state, run.seed(), run.pool(), &watch, plan.around);
    let batches = plan.moves.div_ceil(BATCH);
    for k in 0..batches {
        if !watch.at(0.4 + 0.5 * k as f64 / batches as f64) {
            break;
        }
        search.batch()?;
    }
    peak = peak.max(search.state.bytes()) + search.bytes();
    // No more moves.
    search.state.keep_books(false);
    if watch.at(0.9) && plan.polish[1] > 0 {
        search.polish(plan.polish)?;
    }
    let mut whole = None;
    if asked.equal_volume {
        whole = Some(target::volume(solid, &planes, run)?);
        if watch.at(0.95) {
            volume::swell(&mut search, plan.polish.map(|count| count.max(LAST)))?;
        }
    }
    peak = peak.max(search.state.bytes() + search.bytes()) + look.bytes();
    run.count(|c| c.peak_bytes = c.peak_bytes.max(held + peak));
    let d = state.mismatch();
    let volume = (whole, run.pool(), &watch);
    let (spheres, mut short) = finish::finish(&state.balls, &state.orbits, frame, &exact, volume)?;
    if let Some(chosen) = state.orbits.sites() {
        short = [symmetry::note(chosen, wanted, n), short].concat();
    }
    let mut stopped = watch.stopped().unwrap_or(Stopped::Spheres);
    if n < wanted && stopped == Stopped::Spheres {
        stopped = Stopped::Exhausted;
    }
    let note = match stopped {
        Stopped::Deadline => format!("the deadline passed at a mismatch of about {d:.4}"),
        Stopped::Cancelled => format!("cancelled by the caller at a mismatch of about {d:.4}"),
        _ => short,
    };
    let note = if asked.connected { finish::pieces(&spheres, note)? } else { note };
    if spheres.len() < n && stopped == Stopped::Spheres {
        stopped = Stopped::Exhausted;
    }
    let balls = state.balls;
    memory.keep(balls);
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
    let only_mss = |name: &str| {
        Err(Error::InvalidArgument(format!("{name} is an option of the method mss, not of best")))
    };
    if o.min_distance != 0.0 {
        return only_mss("min_distance");
    }
    if o.radius_offset != 0.0 {
        return only_mss("radius_offset");
    }
    if o.confine {
        return only_mss("confine");
    }
    if o.spheres > MOST {
        return Err(Error::InvalidArgument(format!(
            "{} spheres are asked of the method best, more than {MOST}",
            o.spheres
        )));
    }
    Ok(o.spheres)
}
