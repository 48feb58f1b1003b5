//! Which of the places get a sphere: the one whose orbit brings D down most a
//! sphere. D decides, never the position, so truncation is fair and mirror images
//! go together.

use super::candidates::Place;
use super::lattice::{Ball, distance_squared};
use super::residue::Residue;
use super::subvoxel::along_axis;
use super::target::Target;
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

/// Cell counts of the clump and the target.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Counts {
    pub target: u64,
    pub inside: u64,
    pub outside: u64,
}

impl Counts {
    /// D of equation 27.
    pub fn mismatch(&self) -> f64 {
        1.0 - 2.0 * self.inside as f64 / (self.target + self.inside + self.outside) as f64
    }

    /// The counts after a gain.
    pub fn with(&self, gain: (u64, u64)) -> Counts {
        Counts { inside: self.inside + gain.0, outside: self.outside + gain.1, ..*self }
    }
}

/// A place with what is known about it.
struct Candidate {
    place: Place,
    /// The spheres of the orbit, once they have been looked at.
    orbit: Vec<Ball>,
    tried: bool,
}

/// An entry of the heap: a candidate and its new inside cells a sphere, less what its outside
/// cells cost, when it was last looked at; before that, a bound from its volume. Both can
/// but fall while the clump grows (the second nearly so: outside cells may be taken by others).
#[derive(Clone, Copy)]
struct Entry {
    bound: f64,
    index: usize,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound).then(other.index.cmp(&self.index))
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
    TooSmall,
    Never,
}

/// An orbit that fits counts when it gains this part of what one does that must be cut.
const FAIR: f64 = 0.25;

/// The best candidate so far.
struct Best {
    score: f64,
    /// Squared distance from the centre of symmetry.
    key: f64,
    index: usize,
}

impl Best {
    fn before(&self, other: &Best) -> bool {
        let order = other.score.total_cmp(&self.score).then(self.key.total_cmp(&other.key));
        order.then(self.index.cmp(&other.index)) == Ordering::Less
    }
}

/// Candidates evaluated together, so that threads have work.
const TOGETHER: usize = 8;

/// All places found so far.
pub(super) struct Pool {
    rules: Rules,
    candidates: Vec<Candidate>,
    heap: BinaryHeap<Entry>,
    /// Whether a place was refused for its radius alone.
    pub too_small: bool,
}

impl Pool {
    pub fn new(rules: Rules) -> Pool {
        Pool { rules, candidates: Vec::new(), heap: BinaryHeap::new(), too_small: false }
    }

    /// Takes in places, and lowers the bounds of those before to the uncovered cells around them.
    pub fn add(&mut self, target: &Target, places: Vec<Place>, residue: &Residue) {
        let step = target.lattice.step;
        let cell = step[0] * step[1] * step[2];
        for place in places {
            let r = (place.deep + self.rules.offset).max(0.0);
            let shell = (r.powi(3) - place.covered.min(r).powi(3)).max(0.0);
            let bound = 4.0 / 3.0 * std::f64::consts::PI * shell / cell + 1.0;
            self.heap.push(Entry { bound, index: self.candidates.len() });
            self.candidates.push(Candidate { place, orbit: Vec::new(), tried: false });
        }
        let entries = std::mem::take(&mut self.heap).into_iter().filter_map(|mut entry| {
            let place = &self.candidates.get(entry.index)?.place;
            let radius = (place.deep + self.rules.offset).max(0.0);
            entry.bound = entry.bound.min(residue.bound(&Ball { center: place.center, radius }));
            (entry.bound > 0.0).then_some(entry)
        });
        self.heap = entries.collect();
    }

    /// The orbit that brings D down most a sphere, or none that does. `chosen` are the spheres so
    /// far, `room` is for how many more there is room: an orbit that needs more is cut, and
    /// one that fits is taken instead when it does a fair part as well.
    pub fn best(
        &mut self,
        target: &Target,
        covered: &[u64],
        counts: &Counts,
        chosen: &[Ball],
        room: usize,
        run: &Run,
    ) -> Option<Choice> {
        let mismatch = counts.mismatch();
        let score = |gain: (f64, f64)| (1.0 + mismatch) * gain.0 - (1.0 - mismatch) * gain.1;
        let mut best: Option<Best> = None;
        let mut cut: Option<Best> = None;
        let mut looked: Vec<Entry> = Vec::new();
        loop {
            let mut batch = Vec::new();
            let score_of = |b: &Option<Best>| b.as_ref().map_or(0.0, |b| b.score);
            let least = score_of(&best).max(FAIR * score_of(&cut));
            while batch.len() < TOGETHER {
                match self.heap.peek() {
                    Some(top) if top.bound * (1.0 + mismatch) >= least => {
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
                    Look::TooSmall => self.too_small = true,
                    Look::Good { orbit, gain } => {
                        let index = entry.index;
                        let s = score(gain);
                        let key =
                            orbit.first().map_or(0.0, |b| target.mirrors.off_centre(&b.center));
                        let next = Best { score: s, key, index };
                        let of = if orbit.len() > room { &mut cut } else { &mut best };
                        if s > 0.0 && of.as_ref().is_none_or(|b| next.before(b)) {
                            *of = Some(next);
                        }
                        if let Some(c) = self.candidates.get_mut(index) {
                            c.orbit = orbit;
                            c.tried = true;
                        }
                        looked.push(Entry { bound: s.max(0.0) / (1.0 + mismatch), index });
                    }
                }
            }
        }
        let best = match (best, cut) {
            (Some(b), Some(c)) if b.score < FAIR * c.score => Some(c),
            (None, c) => c,
            (b, _) => b,
        };
        let winner = best.as_ref().map(|b| b.index);
        let mut taken = None;
        for entry in looked {
            if Some(entry.index) == winner {
                taken = Some(entry);
            } else {
                self.heap.push(entry);
            }
        }
        let Best { score: value, index, .. } = best?;
        let candidate = self.candidates.get(index)?;
        let mut choice = Choice { orbit: candidate.orbit.clone(), score: value, entry: taken? };
        if candidate.place.peak {
            let center = refined(target, &candidate.place.center);
            if let Look::Good { orbit, gain } = self.consider(target, covered, chosen, &center)
                && score(gain) >= value
            {
                (choice.orbit, choice.score) = (orbit, score(gain));
            }
        }
        Some(choice)
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
            return Look::TooSmall;
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

/// A maximum of E made exact: the lines of section 3.3 on the true depth about the point, with
/// the grid moved to it and made finer, as the paper suggests.
fn refined(target: &Target, center: &[f64; 3]) -> [f64; 3] {
    let mut here = *center;
    target.mirrors.snap(&mut here);
    let mut depth = target.depth(&here);
    for width in [1.0, 0.5, 0.25] {
        let mut next = here;
        for a in 0..3 {
            let step = width * target.lattice.step[a];
            let e = std::array::from_fn(|n| {
                let mut q = here;
                q[a] += (n as f64 - 2.0) * step;
                if target.solid_at(&q) { target.depth(&q) } else { 0.0 }
            });
            next[a] += along_axis(&e).0 * step;
        }
        target.mirrors.snap(&mut next);
        let deeper = if target.solid_at(&next) { target.depth(&next) } else { 0.0 };
        if deeper <= depth {
            break;
        }
        (here, depth) = (next, deeper);
    }
    here
}
