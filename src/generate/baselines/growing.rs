//! A clump that grows sphere by sphere, with its books: cells covered, mismatch, why it ends.

use super::super::GenerateOptions;
use super::super::mss::counts::Counts;
use super::ground::Ground;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, collected, count, figure, filled, push};
use crate::math::Sphere;
use crate::run::Run;

/// The clump so far, unit frame.
pub(super) struct Growing<'a> {
    ground: &'a Ground<'a>,
    options: &'a GenerateOptions,
    spheres: Vec<Sphere>,
    covered: Vec<u64>,
    counts: Counts,
}

impl<'a> Growing<'a> {
    pub fn new(ground: &'a Ground, options: &'a GenerateOptions) -> Result<Growing<'a>> {
        let cells = ground.target.iter().map(|w| u64::from(w.count_ones())).sum();
        if cells == 0 {
            return Err(Error::Empty("no cell of the grid is solid".into()));
        }
        Ok(Growing {
            ground,
            options,
            spheres: Vec::new(),
            covered: filled("the cells of the clump", ground.target.len(), 0)?,
            counts: Counts { target: cells, ..Counts::default() },
        })
    }

    /// Starts anew.
    pub fn clear(&mut self) {
        self.spheres.clear();
        self.covered.fill(0);
        self.counts = Counts { target: self.counts.target, ..Counts::default() };
    }

    pub fn spheres(&self) -> &[Sphere] {
        &self.spheres
    }

    /// D of equation 27 of Buchele et al. 2026, in cells.
    pub fn mismatch(&self) -> f64 {
        self.counts.mismatch()
    }

    /// Cells of the target that a further sphere would cover; of a large one, some rows of cells
    /// stand for all. It never grows.
    pub fn gain(&self, s: &Sphere) -> u64 {
        let ground = self.ground;
        let all = [f64::INFINITY; 3];
        ground.lattice.estimate(&ground.ball(s), &all, &ground.target, &self.covered).0 as u64
    }

    pub fn add(&mut self, s: Sphere) -> Result<()> {
        let ground = self.ground;
        let gain = ground.lattice.cover(&ground.ball(&s), &ground.target, &mut self.covered);
        self.counts = self.counts.with(gain);
        push("the spheres", &mut self.spheres, s)
    }

    /// Whether the clump is as it was asked for, or the call shall end: asked before each sphere.
    pub fn done(&self, run: &Run) -> Option<Stopped> {
        let (n, limit, aim) = (self.spheres.len(), self.options.spheres, self.options.mismatch);
        let share = if limit == 0 { 0.0 } else { n as f64 / limit as f64 };
        let done = match aim {
            0.0 => share,
            aim => share.max((1.0 - self.mismatch()) / (1.0 - aim).max(1e-6)),
        };
        if aim > 0.0 && n > 0 && self.mismatch() <= aim {
            Some(Stopped::Mismatch)
        } else if limit > 0 && n >= limit {
            Some(Stopped::Spheres)
        } else if run.cancelled(0.2 + 0.8 * done.min(1.0)) {
            Some(Stopped::Cancelled)
        } else if n > 0 && run.late() {
            Some(Stopped::Deadline)
        } else {
            None
        }
    }

    /// The clump. `none_left`: why there is no further sphere, for a method that ends by itself.
    pub fn end(self, stopped: Stopped, none_left: &str, run: &Run) -> Result<Clump> {
        let ground = self.ground;
        run.count(|c| {
            c.exact_distances += ground.asked();
            let bytes = 8 * (self.covered.len() + ground.target.len()) as u64;
            c.peak_bytes = c.peak_bytes.max(ground.solid.bytes() + bytes);
        });
        if self.spheres.is_empty() {
            return Err(match stopped {
                Stopped::Cancelled => {
                    Error::Cancelled("cancelled by the caller before the first sphere".into())
                }
                Stopped::Radius => Error::NoSpheres(format!(
                    "no sphere has a radius of {} or more",
                    figure(self.options.min_radius)
                )),
                _ => Error::NoSpheres(format!("there is no sphere: {none_left}")),
            });
        }
        let note = self.note(stopped, none_left);
        let frame = ground.solid.frame();
        let spheres =
            collected("the spheres", self.spheres.iter().map(|s| frame.sphere_to_input(s)))?;
        Ok(Clump {
            spheres,
            stopped,
            note,
            warnings: Vec::new(),
            quality: None,
            counters: run.counters(),
        })
    }

    /// Why there are fewer spheres than were asked for.
    fn note(&self, stopped: Stopped, none_left: &str) -> String {
        let n = self.spheres.len();
        let of = match self.options.spheres {
            0 => count(n as u64, "sphere"),
            asked if n < asked => format!("{n} of {asked} spheres"),
            _ => return String::new(),
        };
        match stopped {
            Stopped::Spheres | Stopped::Coverage => String::new(),
            Stopped::Mismatch => {
                format!("{of}: the mismatch on the grid is {:.4}, as low as asked", self.mismatch())
            }
            Stopped::Radius => {
                format!(
                    "{of}: every further one is smaller than {}",
                    figure(self.options.min_radius)
                )
            }
            Stopped::Deadline => format!("{of}: the deadline passed"),
            Stopped::Cancelled => format!("{of}: cancelled by the caller"),
            Stopped::Exhausted => format!("{of}: {none_left}"),
        }
    }
}
