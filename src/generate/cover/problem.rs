//! The set cover of one body: its cells and its candidates.

use super::CoverOptions;
use super::candidates::candidates;
use super::cells::Cells;
use super::turned::Turned;
use crate::error::{Result, reserve};
use crate::generate::ball::Ball;
use crate::generate::select::Choice;
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::solid::Solid;

/// Cells to be covered and spheres to cover them with, in the unit frame. For those who want to
/// look into the method; [`super::super::generate`] goes all the way.
pub struct Problem<'a> {
    turned: Turned<'a>,
    cells: Cells,
    candidates: Vec<Sphere>,
}

/// A sphere of the cover.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// In the unit frame.
    pub sphere: Sphere,
    /// Share of the cells' volume that it and all before cover: a cell is covered when the
    /// centroid of its part inside is.
    pub covered: f64,
}

impl<'a> Problem<'a> {
    /// Fills the body with cells and finds the candidates.
    ///
    /// Errors: `Empty`, `ZeroVolume`, `InvalidArgument` (analytic candidates of voxels),
    /// `MemoryLimit`, `TooLarge`, `OutOfMemory`, `Cancelled`.
    pub fn new(solid: &'a Solid, options: &CoverOptions, run: &Run) -> Result<Problem<'a>> {
        run.check(0.0, "turning the body")?;
        let turned = Turned::new(solid)?;
        let limit = solid.memory_limit().saturating_sub(solid.bytes());
        let candidates = candidates(&turned, solid, options, limit, run)?;
        let limit = solid.memory_limit().saturating_sub(solid.bytes());
        let cells = Cells::new(&turned, options.cells_inside, limit, run)?;
        run.count(|c| {
            c.cells += cells.count as u64;
            c.peak_bytes = c.peak_bytes.max(solid.bytes() + cells.bytes);
        });
        Ok(Problem { turned, cells, candidates })
    }

    /// The candidates, the largest first, in the unit frame.
    pub fn candidates(&self) -> &[Sphere] {
        &self.candidates
    }

    /// Keeps the candidates that pass.
    pub fn keep(&mut self, passes: impl Fn(&Sphere) -> bool) {
        self.candidates.retain(passes);
    }

    /// Gives every candidate the radius that `radius` says of its centre. Nothing then promises
    /// that they lie within the body.
    pub fn set_radii(&mut self, radius: impl Fn(&Vec3) -> f64) {
        self.candidates.iter_mut().for_each(|s| s.radius = radius(&s.center));
        self.candidates.sort_by(|a, b| b.radius.total_cmp(&a.radius));
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.cells.count
    }

    /// Volume of the parts of all cells inside, in the unit frame (V_p).
    pub fn volume(&self) -> f64 {
        self.cells.weight as f64 * self.cells.unit
    }

    /// Share of that which all candidates together cover (V_cs / V_p).
    pub fn within_reach(&self) -> Result<f64> {
        Ok(self.cells.within_reach(&self.balls()?) as f64 / self.cells.weight as f64)
    }

    /// The candidates as the cells see them.
    fn balls(&self) -> Result<Vec<Ball>> {
        let mut balls = reserve("the candidates", self.candidates.len())?;
        balls.extend(self.candidates.iter().map(|s| Ball {
            center: self.turned.turn(&s.center).map(|x| x as f32).into(),
            radius: s.radius as f32,
        }));
        Ok(balls)
    }

    /// The spheres of the greedy cover, one after the other, each the one that adds most.
    pub fn solve(&self, run: &Run) -> Result<impl Iterator<Item = Step>> {
        let mut choice = Choice::new(self.cells.points.clone(), self.balls()?, run.pool())?;
        let mut covered = 0;
        Ok(std::iter::from_fn(move || {
            let (i, gain) = choice.next()?;
            covered += gain;
            let sphere = *self.candidates.get(i)?;
            Some(Step { sphere, covered: covered as f64 / self.cells.weight as f64 })
        }))
    }
}

#[cfg(test)]
#[path = "problem_tests.rs"]
mod tests;
