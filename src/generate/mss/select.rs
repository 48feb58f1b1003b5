//! Which of the places get a sphere: the one whose orbit brings D down most a
//! sphere. D decides, never the position, so truncation is fair and mirror images
//! go together.

use super::candidates::Place;
use super::center::refined;
use super::counts::Counts;
use super::lattice::{Ball, distance_squared};
use super::residue::Residue;
use super::target::Target;
use crate::error::{Result, collected, push};
use crate::run::Run;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// What a sphere must be like; lengths in cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rules {
    pub offset: f64,
    pub min_radius: f64,
    pub min_distance: f64,
    pub confine: bool,
}

/// A place with what is known about it.
struct Candidate {
    place: Place,
    /// The spheres of the orbit, once they have been looked at.
    orbit: Vec<Ball>,
    tried: bool,
    /// Refused for its radius, which never changes.
    small: bool,
}

/// An entry of the heap: a candidate and its score a sphere when it was last looked at; before
/// that, a bound from its volume. Both can but fall while the clump grows (the first nearly so:
/// outside cells may be taken by others); when spheres move, [`Pool::renew`] makes them anew.
/// Equals go by their distance from the centre of symmetry, then in the order of coming, and are
/// not looked at when they come after the best: late in the search thousands gain as little.
#[derive(Debug, Clone, Copy)]
struct Entry {
    score: f64,
    /// Squared distance from the centre of symmetry.
    key: f64,
    index: usize,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        let order = self.score.total_cmp(&other.score).then(other.key.total_cmp(&self.key));
        order.then(other.index.cmp(&self.index))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

/// The spheres that a choice adds, in order, and what D gains a sphere.
pub(super) struct Choice {
    pub orbit: Vec<Ball>,
    pub score: f64,
    entry: Entry,
}

/// What came of looking at a candidate.
enum Look {
    /// New cells in and out of the target, a sphere.
    Good {
        orbit: Vec<Ball>,
        gain: (f64, f64),
    },
    TooSmall(Vec<Ball>),
    Never,
}

/// An orbit that fits counts when it gains this part of what one does that must be cut.
const FAIR: f64 = 0.25;

/// Candidates evaluated together, so that threads have work.
const TOGETHER: usize = 8;

/// The caller is asked whether to go on once for so many batches of candidates.
const ASK: usize = 16;

/// What is reserved.
const WHAT: &str = "the places of spheres";

/// All places found so far.
pub(super) struct Pool {
    rules: Rules,
    candidates: Vec<Candidate>,
    heap: BinaryHeap<Entry>,
}

impl Pool {
    pub fn new(rules: Rules) -> Pool {
        Pool { rules, candidates: Vec::new(), heap: BinaryHeap::new() }
    }

    /// Takes in places, and lowers the bounds of those before to the uncovered cells around them.
    pub fn add(&mut self, target: &Target, places: Vec<Place>, residue: &Residue) -> Result<()> {
        let mut entries = std::mem::take(&mut self.heap).into_vec();
        for place in places {
            let entry = self.entry(target, &place, place.covered, self.candidates.len());
            push(WHAT, &mut entries, entry)?;
            let candidate = Candidate { place, orbit: Vec::new(), tried: false, small: false };
            push(WHAT, &mut self.candidates, candidate)?;
        }
        entries.retain_mut(|e| self.lowered(*e, residue).map(|lower| *e = lower).is_some());
        self.heap = entries.into();
        Ok(())
    }

    /// Puts every place back that has ever been found, but those that are too small, with the
    /// bound of its whole ball: spheres have moved, and where they were a place that gained
    /// little, or nothing, may gain again.
    pub fn renew(&mut self, target: &Target, residue: &Residue) -> Result<()> {
        let places = self.candidates.iter().enumerate().filter(|(_, c)| !c.small);
        let entries =
            places.filter_map(|(n, c)| self.lowered(self.entry(target, &c.place, 0.0, n), residue));
        self.heap = collected(WHAT, entries)?.into();
        Ok(())
    }

    /// An entry with no less than the cells that a sphere at the place has outside of a ball
    /// about it.
    fn entry(&self, target: &Target, place: &Place, covered: f64, index: usize) -> Entry {
        let [a, b, c] = target.lattice.step;
        let r = (place.deep + self.rules.offset).max(0.0);
        let shell = (r.powi(3) - covered.min(r).powi(3)).max(0.0);
        let mut center = place.center;
        target.mirrors.snap(&mut center);
        Entry {
            score: 4.0 / 3.0 * std::f64::consts::PI * shell / (a * b * c) + 1.0,
            key: target.mirrors.off_centre(&center),
            index,
        }
    }

    /// The entry with no more than the uncovered cells around its place; none without any.
    fn lowered(&self, entry: Entry, residue: &Residue) -> Option<Entry> {
        let place = &self.candidates.get(entry.index)?.place;
        let radius = (place.deep + self.rules.offset).max(0.0);
        let score = entry.score.min(residue.bound(&Ball { center: place.center, radius }));
        (score > 0.0).then_some(Entry { score, ..entry })
    }

    /// Whether a place that was refused for its radius would bring D down.
    pub fn small_one_helps(
        &self,
        target: &Target,
        covered: &[u64],
        counts: &Counts,
        chosen: &[Ball],
    ) -> bool {
        self.candidates.iter().filter(|c| c.small).any(|c| {
            match self.measure(target, covered, chosen, c.orbit.clone()) {
                Look::Good { gain, .. } => counts.score(gain) > 0.0,
                _ => false,
            }
        })
    }

    /// The orbit that brings D down most a sphere, or none that does. `chosen` are the spheres so
    /// far, `room` is for how many more there is room: an orbit that needs more is cut, and
    /// one that fits is taken instead when it does a fair part as well. None as well when the
    /// caller cancels or, but for the first sphere, when the deadline passes.
    pub fn best(
        &mut self,
        target: &Target,
        covered: &[u64],
        counts: &Counts,
        chosen: &[Ball],
        room: usize,
        run: &Run,
    ) -> Result<Option<Choice>> {
        let mut best: Option<Entry> = None;
        let mut cut: Option<Entry> = None;
        let mut looked: Vec<Entry> = Vec::new();
        let mut interrupted = false;
        for round in 1.. {
            if usize::is_multiple_of(round, ASK) && stop(run, chosen) {
                interrupted = true;
                break;
            }
            let mut batch = Vec::new();
            let least = cut.map_or(0.0, |c| FAIR * c.score);
            while batch.len() < TOGETHER {
                match self.heap.peek() {
                    Some(top) if top.score >= least && best.is_none_or(|b| *top > b) => {
                        batch.extend(self.heap.pop());
                    }
                    _ => break,
                }
            }
            // No end of search for an orbit that fits where hardly any does.
            if batch.is_empty() || (cut.is_some() && best.is_none() && looked.len() > 256) {
                self.heap.extend(batch);
                break;
            }
            run.count(|c| c.spheres_tried += batch.len() as u64);
            let pool = &*self;
            let looks = run.pool().map(batch.len(), |n| {
                pool.look(target, covered, chosen, &pool.candidates[batch[n].index])
            });
            for (entry, look) in batch.into_iter().zip(looks) {
                match look {
                    Look::Never => {}
                    Look::TooSmall(orbit) => {
                        if let Some(c) = self.candidates.get_mut(entry.index) {
                            (c.orbit, c.small) = (orbit, true);
                        }
                    }
                    Look::Good { orbit, gain } => {
                        let next = Entry { score: counts.score(gain), ..entry };
                        let of = if orbit.len() > room { &mut cut } else { &mut best };
                        if next.score > 0.0 && of.is_none_or(|b| next > b) {
                            *of = Some(next);
                        }
                        if let Some(c) = self.candidates.get_mut(entry.index) {
                            c.orbit = orbit;
                            c.tried = true;
                        }
                        let again = Entry { score: next.score.max(0.0), ..entry };
                        push(WHAT, &mut looked, again)?;
                    }
                }
            }
        }
        let best = match (best, cut) {
            (Some(b), Some(c)) if b.score < FAIR * c.score => Some(c),
            (None, c) => c,
            (b, _) => b,
        };
        let best = if interrupted { None } else { best };
        let winner = best.map(|b| b.index);
        self.heap.extend(looked.into_iter().filter(|entry| Some(entry.index) != winner));
        let Some(entry) = best else { return Ok(None) };
        let Some(candidate) = self.candidates.get(entry.index) else { return Ok(None) };
        let mut orbit = candidate.orbit.clone();
        let mut score = entry.score;
        if candidate.place.peak {
            let center = refined(target, &candidate.place.center);
            if let Look::Good { orbit: other, gain } =
                self.consider(target, covered, chosen, &center)
                && counts.score(gain) >= score
            {
                (orbit, score) = (other, counts.score(gain));
            }
        }
        Ok(Some(Choice { orbit, score: score * (1.0 + counts.mismatch()), entry }))
    }

    /// The orbit about a point and its new cells a sphere, when the rules allow it.
    pub fn trial(
        &self,
        target: &Target,
        covered: &[u64],
        others: &[Ball],
        center: &[f64; 3],
    ) -> Option<(Vec<Ball>, (f64, f64))> {
        if !target.solid_at(center) {
            return None;
        }
        match self.consider(target, covered, others, center) {
            Look::Good { orbit, gain } => Some((orbit, gain)),
            _ => None,
        }
    }

    /// Leaves a choice for later.
    pub fn put_back(&mut self, choice: Choice) {
        self.heap.push(choice.entry);
    }

    fn look(&self, target: &Target, covered: &[u64], chosen: &[Ball], c: &Candidate) -> Look {
        if !c.tried {
            return self.consider(target, covered, chosen, &c.place.center);
        }
        self.measure(target, covered, chosen, c.orbit.clone())
    }

    /// The orbit of spheres about a point and what it gains.
    fn consider(
        &self,
        target: &Target,
        covered: &[u64],
        chosen: &[Ball],
        center: &[f64; 3],
    ) -> Look {
        let mut at = *center;
        target.mirrors.snap(&mut at);
        let radius = |p: &[f64; 3]| {
            let r = target.depth(p) + self.rules.offset;
            if !self.rules.confine {
                return Some(r);
            }
            target.limit(p).map(|limit| r.min(limit))
        };
        let Some(first) = radius(&at) else { return Look::Never };
        let own = target.images_differ() || self.rules.confine;
        let mut orbit = Vec::new();
        for p in target.mirrors.orbit(&at) {
            let r = if own && p != at { radius(&p) } else { Some(first) };
            match r {
                Some(r) if r > 0.0 => orbit.push(Ball { center: p, radius: r }),
                _ => return Look::Never,
            }
        }
        if orbit.iter().any(|b| b.radius < self.rules.min_radius) {
            return Look::TooSmall(orbit);
        }
        self.measure(target, covered, chosen, orbit)
    }

    fn measure(&self, target: &Target, covered: &[u64], chosen: &[Ball], orbit: Vec<Ball>) -> Look {
        let least = self.rules.min_distance * self.rules.min_distance;
        if least > 0.0 {
            let near = |a: &Ball, b: &Ball| distance_squared(&a.center, &b.center) < least;
            let crowded = orbit.iter().enumerate().any(|(n, a)| {
                chosen.iter().any(|b| near(a, b)) || orbit[..n].iter().any(|b| near(a, b))
            });
            if crowded {
                return Look::Never;
            }
        }
        let Some(first) = orbit.first() else { return Look::Never };
        let part = target.mirrors.part(&first.center);
        let gain = target.lattice.estimate(first, &part, &target.bits, covered);
        if gain.0 > 0.0 { Look::Good { orbit, gain } } else { Look::Never }
    }
}

/// Whether the caller or the deadline ends the work, that is not without a sphere.
pub(super) fn stop(run: &Run, chosen: &[Ball]) -> bool {
    run.cancelled(0.0) || (!chosen.is_empty() && run.late())
}

#[cfg(test)]
#[path = "select_tests.rs"]
mod tests;
