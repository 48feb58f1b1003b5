//! Maximal inscribed spheres about a thinned skeleton, chosen by a greedy set cover of cells
//! (Yuan 2019, update of Granular Matter 21:19): no sphere reaches beyond the surface, and each
//! next one covers the most volume that those before do not.

mod candidates;
mod cells;
mod cliques;
mod fill;
mod problem;
mod simple;
mod thinning;
mod turned;

pub use candidates::Candidates;
pub use problem::{Problem, Step};
pub use thinning::{Ends, Skeleton, thin};

use super::GenerateOptions;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, count, reserve};
use crate::math::Sphere;
use crate::run::Run;
use crate::solid::Solid;

/// How a body is covered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CoverOptions {
    /// What thinning keeps beside the topology.
    pub ends: Ends,
    /// Where candidates have their centres.
    pub candidates: Candidates,
    /// Voxels to be thinned, along the diameter of the sphere of equal volume.
    pub thinning_cells: u32,
    /// Cells to be covered, along the same diameter within the body; half their size at its surface.
    pub cells_inside: u32,
}

impl Default for CoverOptions {
    fn default() -> Self {
        CoverOptions {
            ends: Ends::Surface,
            candidates: Candidates::Thinned,
            thinning_cells: 60,
            cells_inside: 50,
        }
    }
}

/// Most voxels and cells along the diameter.
const FINEST: u32 = 4096;

/// Makes a clump.
pub(super) fn cover(solid: &Solid, options: &GenerateOptions, run: &Run) -> Result<Clump> {
    check(options)?;
    let mut problem = Problem::new(solid, &options.cover, run)?;
    let least = options.min_radius / solid.frame().scale;
    let all = problem.candidates().len();
    problem.keep(|s| s.radius >= least);
    let dropped = all - problem.candidates().len();
    if problem.candidates().is_empty() {
        return Err(Error::NoSpheres(format!(
            "all {} are smaller than the least radius of {}",
            count(all as u64, "candidate sphere"),
            options.min_radius
        )));
    }
    // Spheres within the body: D follows from what they cover.
    let enough = |covered: f64| 1.0 - 2.0 * covered / (1.0 + covered);
    let most = if options.spheres == 0 { usize::MAX } else { options.spheres };
    let mut spheres: Vec<Sphere> = reserve("the clump", most.min(problem.candidates().len()))?;
    let mut covered = 0.0;
    let mut stopped = None;
    let steps = problem.solve(run)?;
    for step in steps {
        spheres.push(solid.frame().sphere_to_input(&step.sphere));
        covered = step.covered;
        let done = (spheres.len() as f64 / most as f64).max(covered * covered).min(1.0);
        stopped = if spheres.len() >= most {
            Some(Stopped::Spheres)
        } else if options.coverage > 0.0 && covered >= options.coverage {
            Some(Stopped::Coverage)
        } else if options.mismatch > 0.0 && enough(covered) <= options.mismatch {
            Some(Stopped::Mismatch)
        } else if run.cancelled(0.6 + 0.4 * done) {
            Some(Stopped::Cancelled)
        } else if run.late() {
            Some(Stopped::Deadline)
        } else {
            None
        };
        if stopped.is_some() {
            break;
        }
    }
    run.count(|c| c.spheres_tried += all as u64);
    let share = format!("{:.2} % of the volume, by cells", 100.0 * covered);
    let n = count(spheres.len() as u64, "sphere");
    let (stopped, note) = match stopped {
        Some(Stopped::Deadline) => {
            (Stopped::Deadline, format!("the deadline passed at {n}, which cover {share}"))
        }
        Some(Stopped::Cancelled) => {
            (Stopped::Cancelled, format!("cancelled by the caller at {n}, which cover {share}"))
        }
        Some(met) => (met, String::new()),
        None if dropped > 0 => (
            Stopped::Radius,
            format!("{n} cover {share}: all that candidates of the least radius can"),
        ),
        None => (
            Stopped::Exhausted,
            format!(
                "{n} cover {share}: all that the {} can; {} more",
                count(all as u64, "candidate sphere"),
                match options.cover.candidates {
                    Candidates::Thinned => "analytic ones, or more voxels to thin, cover",
                    Candidates::Analytic => "a finer mesh has",
                }
            ),
        ),
    };
    Ok(Clump {
        spheres,
        stopped,
        note,
        warnings: Vec::new(),
        quality: None,
        counters: run.counters(),
    })
}

fn check(o: &GenerateOptions) -> Result<()> {
    let confine = f64::from(u8::from(o.confine));
    for (name, value) in
        [("min_distance", o.min_distance), ("radius_offset", o.radius_offset), ("confine", confine)]
    {
        if value != 0.0 {
            return Err(Error::InvalidArgument(format!(
                "{name} is an option of the method mss, not of cover"
            )));
        }
    }
    for (name, value) in
        [("thinning_cells", o.cover.thinning_cells), ("cells_inside", o.cover.cells_inside)]
    {
        if !(4..=FINEST).contains(&value) {
            return Err(Error::InvalidArgument(format!(
                "{name} is {value}, not between 4 and {FINEST}"
            )));
        }
    }
    Ok(())
}
