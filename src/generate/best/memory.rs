//! What clumps of one body with several numbers of spheres share: the distance field, and the
//! balls from which the next one starts.

use super::options::{BestOptions, Symmetry};
use super::target;
use crate::error::{Error, Result};
use crate::generate::Levels;
use crate::generate::ball::Ball;
use crate::generate::balls::Plane;
use crate::generate::balls::field::Field;
use crate::run::Run;
use crate::solid::{Grid, Solid};

/// Of nested levels those of fewer spheres may reach less beyond the target, as what reaches out
/// once does so in all later ones: the weight of that grows with this power of the last number of
/// spheres over theirs.
const NESTED: f64 = 0.5;

/// A field that was made for some cells along the longest edge.
struct Made {
    cells: u32,
    field: Field,
    grid: (Grid, Vec<f32>),
}

/// What is kept from one clump to the next; by default nothing.
#[derive(Default)]
pub(in crate::generate) struct Memory {
    levels: Levels,
    /// The most spheres of any level; 0: there is one level only.
    most: usize,
    made: Option<Made>,
    balls: Vec<Ball>,
}

/// Where a clump starts: balls of the one before and how many of them stay.
pub(super) type Before = Option<(Vec<Ball>, usize)>;

impl Memory {
    /// For levels up to so many spheres.
    pub(in crate::generate) fn new(levels: Levels, most: usize) -> Memory {
        Memory { levels, most, ..Memory::default() }
    }

    /// Refuses demands that nested levels cannot keep.
    pub(in crate::generate) fn check(levels: Levels, o: &BestOptions) -> Result<()> {
        let demands = [
            ("connected", o.connected),
            ("equal_volume", o.equal_volume),
            ("symmetry", o.symmetry != Symmetry::None),
        ];
        match demands.iter().find(|(_, wanted)| *wanted) {
            Some((name, _)) if levels == Levels::Nested => Err(Error::Unsupported(format!(
                "levels that nest cannot keep {name}: spheres of a smaller clump would have to move"
            ))),
            _ => Ok(()),
        }
    }

    /// The field, which is made when it is not the one before.
    pub(super) fn field(
        &mut self,
        solid: &Solid,
        planes: &[Plane],
        cells: u32,
        run: &Run,
    ) -> Result<(&Field, (Grid, Vec<f32>))> {
        if self.made.as_ref().is_none_or(|m| m.cells != cells) {
            let (field, grid) = target::field(solid, planes, cells, run)?;
            self.made = Some(Made { cells, field, grid });
        }
        let alone = self.most == 0;
        let made = self.made.as_mut();
        let made = made.ok_or_else(|| Error::Internal("the field was not kept".into()))?;
        // Of one clump alone nothing is kept that only its columns read.
        let values = if alone { std::mem::take(&mut made.grid.1) } else { made.grid.1.clone() };
        Ok((&made.field, (made.grid.0, values)))
    }

    /// Where a clump of `n` spheres starts, and what overshoot weighs.
    pub(super) fn start(&self, n: usize, asked: &BestOptions) -> (Before, f64) {
        let weight = asked.overshoot_weight;
        let some = !self.balls.is_empty() && self.balls.len() < n;
        match self.levels {
            Levels::Chained if some && asked.symmetry == Symmetry::None => {
                (Some((self.balls.clone(), 0)), weight)
            }
            Levels::Nested => {
                let share = self.most.max(n) as f64 / n as f64;
                let before = some.then(|| (self.balls.clone(), self.balls.len()));
                (before, weight * share.powf(NESTED))
            }
            _ => (None, weight),
        }
    }

    pub(super) fn keep(&mut self, balls: Vec<Ball>) {
        if self.most > 0 && self.levels != Levels::Free {
            self.balls = balls;
        }
    }
}
