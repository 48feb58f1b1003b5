//! Clumps of one solid with ascending numbers of spheres, which share what they can.

use super::best::memory::Memory;
use super::{GenerateOptions, Method, best, generate};
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result};
use crate::run::{Run, Stage};
use crate::solid::Solid;

/// What the levels of detail of one body have to do with each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Levels {
    /// Nothing: each is, byte for byte, what a call of its own gives.
    #[default]
    Free,
    /// Each starts from the one before where the method can ([`Method::Best`] without symmetry),
    /// so that levels are alike; else as free ones. As good, and hardly quicker: most of the time
    /// goes into the search after the start.
    Chained,
    /// Each holds all spheres of the one before, in the same order, and further ones after them,
    /// so that a solver takes as many of the last one's spheres as it needs: for
    /// [`Method::Best`], [`Method::Cover`] and [`Method::Euclidean`]. Small levels of
    /// [`Method::Best`] reach less beyond the target than free ones and have more mismatch.
    Nested,
}

/// A generator of levels.
pub(crate) struct Series<'a> {
    solid: &'a Solid,
    options: &'a GenerateOptions,
    levels: Levels,
    most: usize,
    memory: Memory,
    /// The last clump of levels that nest.
    last: Option<Clump>,
}

impl<'a> Series<'a> {
    /// For levels up to `most` spheres. The number of spheres, the mismatch and the quality of
    /// the options are not read.
    pub(crate) fn new(
        solid: &'a Solid,
        options: &'a GenerateOptions,
        levels: Levels,
        most: usize,
        run: &Run,
    ) -> Result<Series<'a>> {
        let nest = [Method::Best, Method::Cover, Method::Euclidean];
        if levels == Levels::Nested && !nest.contains(&options.method) {
            return Err(Error::Unsupported(
                "levels nest with the methods best, cover and euclidean alone".into(),
            ));
        }
        Memory::check(levels, &options.best)?;
        let memory = Memory::new(levels, most);
        let solid = solid.with_told_axes(run)?;
        Ok(Series { solid, options, levels, most, memory, last: None })
    }

    /// Makes what all levels from `first` spheres on read, so that none of them pays for the others.
    pub(crate) fn prepare(&mut self, first: usize, run: &Run) -> Result<()> {
        run.check(0.0, "measuring the distances of cells")?;
        let options = GenerateOptions { spheres: first, ..self.options.clone() };
        match options.method {
            Method::Best => best::prepare(self.solid, &options, &mut self.memory, run)?,
            Method::Mss => self.solid.find_inside(run)?,
            _ => {
                self.solid.distance(run)?;
            }
        }
        if options.method != Method::Best || options.best.max_protrusion > 0.0 {
            self.solid.surface(run)?;
        }
        Ok(())
    }

    /// The clump of `n` spheres, more than the one before.
    pub(crate) fn next(&mut self, n: usize, run: &Run) -> Result<Clump> {
        let options =
            GenerateOptions { spheres: n, mismatch: 0.0, quality: None, ..self.options.clone() };
        if options.method != Method::Best {
            return if self.levels == Levels::Nested {
                self.first(n, options, run)
            } else {
                generate(self.solid, &options, run)
            };
        }
        super::check(&options, run)?;
        let mut clump = run.time(Stage::Generate, || {
            best::fewest::fits(self.solid, &options)?;
            best::after(self.solid, &options, &mut self.memory, run)
        })?;
        super::keep_radii(&mut clump.spheres, &options);
        if self.levels == Levels::Nested {
            if let Some(last) = &self.last {
                clump.spheres = append(last, clump.spheres);
            }
            self.last = Some(clump.clone());
        }
        clump.counters = run.counters();
        Ok(clump)
    }

    /// The first `n` spheres of the largest clump, of methods that choose one after the other.
    fn first(&mut self, n: usize, mut options: GenerateOptions, run: &Run) -> Result<Clump> {
        if self.last.is_none() {
            options.spheres = self.most.max(n);
            self.last = Some(generate(self.solid, &options, run)?);
        }
        let whole = self.last.as_ref();
        let whole = whole.ok_or_else(|| Error::Internal("the clump was not kept".into()))?;
        let mut clump = whole.clone();
        if n < clump.spheres.len() {
            clump.spheres.truncate(n);
            (clump.stopped, clump.note) = (Stopped::Spheres, String::new());
        }
        clump.counters = run.counters();
        Ok(clump)
    }
}

/// The spheres of the clump before in their order, then those of `all` that are new.
fn append(before: &Clump, all: Vec<crate::math::Sphere>) -> Vec<crate::math::Sphere> {
    let mut out = before.spheres.clone();
    let mut known = vec![false; before.spheres.len()];
    for s in all {
        let twin = before.spheres.iter().zip(&known).position(|(b, known)| *b == s && !known);
        match twin.and_then(|i| known.get_mut(i)) {
            Some(known) => *known = true,
            None => out.push(s),
        }
    }
    out
}
