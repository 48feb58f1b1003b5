//! A move: a ball that is worth little goes to where much is missing (or is shaken where it is)
//! and is refined with what is around both places. It helps when D by columns falls.
//!
//! In two stages: what looks hopeless after a rough refinement is not refined further; and what
//! few directions gain by chance is gone when many look.

use super::refine::{Refiner, Schedule};
use super::state::State;
use super::symmetry::{Orbit, Orbits};
use crate::generate::ball::Ball;
use crate::generate::balls::cover::Look;
use crate::generate::balls::dexels::Seen;
use crate::generate::balls::directions::Directions;
use crate::generate::balls::medial;
use crate::generate::balls::random::Random;

/// Part of the moves that shake a ball where it is.
const SHAKEN: f64 = 0.25;
/// Places tried for a ball that is moved.
pub(super) const PLACES: usize = 4;
/// How many times as large as the ball that moves these may be.
const LARGER: f32 = 4.0;
/// A move whose best place loses more than this part of what the ball was worth is given up every
/// other time.
const LOST: f64 = 0.6;
/// After the first refinement a move may be worse by this part of the mismatch that falls to as
/// many balls, and is still refined further.
const HOPE: f64 = 0.3;

/// Until it is decided whether a move is kept, no more rows of columns are looked at than so many
/// through the ball that moves.
const ROWS: f32 = 8.0;

/// Directions of the refinements, and the most balls of one.
pub(super) struct Fans {
    pub few: Directions,
    some: Directions,
    many: Directions,
    around: usize,
}

impl Fans {
    pub(super) fn new(around: usize) -> Fans {
        let [few, some, many] = [32, 64, 128].map(Directions::new);
        Fans { few, some, many, around }
    }
}

/// Balls that a move changes.
pub(super) struct Moved {
    pub of: Vec<u32>,
    pub balls: Vec<Ball>,
    /// Their orbits.
    pub orbits: Vec<Orbit>,
}

/// What tries moves: buffers, and a copy of the clump that it changes and puts back.
#[derive(Default)]
pub(super) struct Mover<'a> {
    refiner: Refiner,
    pub look: Look,
    pub gaps: Vec<[f32; 2]>,
    pub trial: Vec<Ball>,
    pub orbits: Orbits<'a>,
    seen: Vec<Seen>,
    /// The state's version of which `trial` is a copy.
    version: u64,
}

impl<'a> Mover<'a> {
    /// Bytes of its large arrays.
    pub(super) fn bytes(&self) -> u64 {
        let balls = 16 * (self.trial.capacity() + self.seen.capacity()) as u64;
        balls + self.look.bytes() + self.refiner.bytes()
    }

    /// Tries a move of ball `i`; what it changes, when D falls.
    pub(super) fn attempt(
        &mut self,
        state: &State<'a>,
        fans: &Fans,
        i: usize,
        random: &mut Random,
    ) -> Option<Moved> {
        if self.version != state.version {
            self.trial.clone_from(&state.balls);
            self.seen.clone_from(&state.seen);
            self.orbits.clone_from(&state.orbits);
            self.version = state.version;
        }
        let mut leads = vec![i as u32];
        let helps = self.go(state, fans, i, &mut leads, random);
        let of = self.orbits.balls(&leads);
        let balls = of.iter().map(|&j| self.trial[j as usize]).collect();
        let orbits = leads.iter().filter_map(|&j| self.orbits.orbit(j).cloned()).collect();
        for &j in &of {
            self.trial[j as usize] = state.balls[j as usize];
            self.seen[j as usize] = state.seen[j as usize];
        }
        self.orbits.restore(&state.orbits, &of);
        helps.then_some(Moved { of, balls, orbits })
    }

    fn go(
        &mut self,
        state: &State,
        fans: &Fans,
        i: usize,
        of: &mut Vec<u32>,
        random: &mut Random,
    ) -> bool {
        let width = state.width;
        if random.unit() < SHAKEN {
            let ball = &mut self.trial[i];
            for x in &mut ball.center {
                *x += ball.radius * random.between(-0.25, 0.25) as f32;
            }
            ball.radius *= random.between(0.8, 1.2) as f32;
            self.orbits.follow(of, &mut self.trial);
        } else if let Some(sites) = state.orbits.sites() {
            let [lost, without] = self.replant(sites, state, fans, of, random);
            if lost == f64::MAX || (lost > LOST * without && random.unit() < 0.5) {
                return false;
            }
        } else {
            let lost = self.insert(state, fans, i, random);
            if lost > LOST * state.worth(i) && random.unit() < 0.5 {
                return false;
            }
        }
        self.around(state, fans.around, of);
        let all = self.orbits.balls(of);
        let schedule = Schedule { iterations: 16, from: 4.0 * width, to: 0.4 * width };
        self.refine(state, &schedule, &fans.some, of, random);
        let hope = HOPE * state.left() * all.len() as f64 / state.balls.len() as f64;
        if self.rough_cost(state, &all, i) > hope {
            return false;
        }
        let schedule = Schedule { iterations: 12, from: 0.8 * width, to: 0.2 * width };
        self.refine(state, &schedule, &fans.many, of, random);
        self.cost(state, &all) < 0.0
    }

    /// Refines some balls of the trial, which lead.
    pub(super) fn refine(
        &mut self,
        state: &State,
        schedule: &Schedule,
        directions: &Directions,
        of: &[u32],
        random: &mut Random,
    ) {
        let task = state.ground.task(directions, state.weights(), &self.orbits, state.pull());
        self.refiner.refine(&task, schedule, &mut self.trial, of, random, None, &mut || true);
    }

    /// Puts ball `i` of the trial to the best of some places; returns by how much the cost rises.
    fn insert(&mut self, state: &State, fans: &Fans, i: usize, random: &mut Random) -> f64 {
        let (field, size, radii) = (state.ground.field, state.ground.size, state.ground.radii);
        let mut best = (f64::MAX, state.balls[i]);
        let schedule = Schedule { iterations: 4, from: 4.0 * state.width, to: state.width };
        for _ in 0..PLACES {
            let Some(p) = state.gap(random, &mut self.look, &mut self.gaps) else { continue };
            let center = medial::ball(field, p, size).center;
            let t = random.unit() as f32;
            let center = std::array::from_fn(|a| p[a] + t * (center[a] - p[a]));
            let radius = -field.one(center) * random.between(1.0, 1.1) as f32;
            let radius = radius.max(radii.least).min(radii.most);
            self.trial[i] = Ball { center, radius };
            self.refine(state, &schedule, &fans.few, &[i as u32], random);
            let cost = self.rough_cost(state, &[i as u32], i);
            if cost < best.0 {
                best = (cost, self.trial[i]);
            }
        }
        self.trial[i] = best.1;
        best.0
    }

    /// Adds to `of` who leads the balls that meet those moved at their old or new places, those
    /// that overlap them most. Much larger ones stay: all their columns would have to be looked
    /// at.
    fn around(&self, state: &State, most: usize, of: &mut Vec<u32>) {
        let moved = self.orbits.balls(of);
        let old = moved.iter().filter(|&&j| state.orbits.lead(j) == j);
        let mut places: Vec<Ball> = old.map(|&j| state.balls[j as usize]).collect();
        places.extend(of.iter().map(|&j| self.trial[j as usize]));
        let largest = LARGER * places.iter().fold(0.0, |r, p| p.radius.max(r));
        let mut near: Vec<(f32, u32)> = Vec::new();
        for (j, b) in (0u32..).zip(&self.trial) {
            let lead = self.orbits.lead(j);
            let free = j as usize >= state.fixed;
            if free
                && !of.contains(&lead)
                && b.radius <= largest
                && places.iter().any(|p| b.meets(p, 0.0))
            {
                // How far apart the surfaces are.
                let gap = |x: &Ball| b.apart(x).sqrt() - b.radius - x.radius;
                near.push((places.iter().map(gap).fold(f32::MAX, f32::min), lead));
            }
        }
        near.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        for (_, lead) in near {
            if of.len() >= most {
                break;
            }
            if !of.contains(&lead) {
                of.push(lead);
            }
        }
    }

    /// The cost of the trial less that of the clump, when only the balls `of` differ.
    pub(super) fn cost(&mut self, state: &State, of: &[u32]) -> f64 {
        self.cost_by_rows(state, of, 1)
    }

    /// The same by some of the rows, fewer for a large ball `i`.
    fn rough_cost(&mut self, state: &State, of: &[u32], i: usize) -> f64 {
        let rows = 2.0 * state.ground.dexels.seen(&self.trial[i]).r;
        self.cost_by_rows(state, of, ((rows / ROWS) as u32).clamp(1, 4))
    }

    fn cost_by_rows(&mut self, state: &State, of: &[u32], step: u32) -> f64 {
        let dexels = state.ground.dexels;
        for &j in of {
            self.seen[j as usize] = dexels.seen(&self.trial[j as usize]);
        }
        state.price(of, &self.seen, step, &mut self.look)
    }
}
