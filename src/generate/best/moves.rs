//! A move: a ball that is worth little goes to where much is missing (or is shaken where it is)
//! and is refined with what is around both places. It helps when D by columns falls.
//!
//! In two stages: what looks hopeless after a rough refinement is not refined further; and what
//! few directions gain by chance is gone when many look.

use super::cover::Look;
use super::dexels::Seen;
use super::directions::Directions;
use super::medial;
use super::random::Random;
use super::refine::{Refiner, Schedule, Task};
use super::state::State;
use crate::generate::ball::Ball;

/// Part of the moves that shake a ball where it is.
const SHAKEN: f64 = 0.25;
/// Places tried for a ball that is moved.
const PLACES: usize = 4;
/// Most balls refined by a move.
const AROUND: usize = 12;
/// How many times as large as the ball that moves these may be.
const LARGER: f32 = 4.0;
/// A move whose best place loses more than this part of what the ball was worth is given up every
/// other time.
const LOST: f64 = 0.6;
/// After the first refinement a move may be worse by this part of the mismatch that falls to as
/// many balls, and is still refined further.
const HOPE: f64 = 0.3;

/// Directions of the refinements.
pub(super) struct Fans {
    few: Directions,
    some: Directions,
    many: Directions,
}

impl Fans {
    pub(super) fn new() -> Fans {
        Fans { few: Directions::new(32), some: Directions::new(64), many: Directions::new(192) }
    }
}

/// Balls that a move changes.
pub(super) struct Moved {
    pub of: Vec<u32>,
    pub balls: Vec<Ball>,
}

/// What tries moves: buffers, and a copy of the clump that it changes and puts back.
#[derive(Default)]
pub(super) struct Mover {
    refiner: Refiner,
    look: Look,
    gaps: Vec<[f32; 2]>,
    trial: Vec<Ball>,
    seen: Vec<Seen>,
    /// The state's version of which `trial` is a copy.
    version: u64,
}

impl Mover {
    /// Tries a move of ball `i`; what it changes, when D falls.
    pub(super) fn attempt(
        &mut self,
        state: &State,
        fans: &Fans,
        i: usize,
        random: &mut Random,
    ) -> Option<Moved> {
        if self.version != state.version {
            self.trial.clone_from(&state.balls);
            self.seen.clone_from(&state.seen);
            self.version = state.version;
        }
        let mut of = vec![i as u32];
        let helps = self.go(state, fans, i, &mut of, random);
        let balls = of.iter().map(|&j| self.trial[j as usize]).collect();
        for &j in &of {
            self.trial[j as usize] = state.balls[j as usize];
            self.seen[j as usize] = state.seen[j as usize];
        }
        helps.then_some(Moved { of, balls })
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
        } else {
            let lost = self.insert(state, fans, i, random);
            if lost > LOST * state.worth(i) && random.unit() < 0.5 {
                return false;
            }
        }
        self.around(state, i, of);
        let schedule = Schedule { iterations: 16, from: 4.0 * width, to: 0.4 * width };
        self.refine(state, &schedule, &fans.some, of, random);
        let hope = HOPE * state.left() * of.len() as f64 / state.balls.len() as f64;
        if self.cost(state, of) > hope {
            return false;
        }
        let schedule = Schedule { iterations: 12, from: 0.8 * width, to: 0.2 * width };
        self.refine(state, &schedule, &fans.many, of, random);
        self.cost(state, of) < 0.0
    }

    /// Refines some balls of the trial.
    fn refine(
        &mut self,
        state: &State,
        schedule: &Schedule,
        directions: &Directions,
        of: &[u32],
        random: &mut Random,
    ) {
        let task = Task {
            field: state.ground.field,
            directions,
            weights: state.weights(),
            radii: state.ground.radii,
            limits: state.ground.limits,
        };
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
            let cost = self.cost(state, &[i as u32]);
            if cost < best.0 {
                best = (cost, self.trial[i]);
            }
        }
        self.trial[i] = best.1;
        best.0
    }

    /// Adds to `of` the balls that meet ball `i` at its old or new place, those that overlap it
    /// most. Much larger ones stay: all their columns would have to be looked at.
    fn around(&self, state: &State, i: usize, of: &mut Vec<u32>) {
        let (old, new) = (&state.balls[i], &self.trial[i]);
        let most = LARGER * old.radius.max(new.radius);
        let mut near: Vec<(f32, u32)> = Vec::new();
        for (j, b) in (0u32..).zip(&self.trial) {
            if j as usize != i && b.radius <= most && (b.meets(old, 0.0) || b.meets(new, 0.0)) {
                // How far apart the surfaces are.
                let gap = |x: &Ball| b.apart(x).sqrt() - b.radius - x.radius;
                near.push((gap(old).min(gap(new)), j));
            }
        }
        near.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        of.extend(near.into_iter().take(AROUND - 1).map(|(_, j)| j));
    }

    /// The cost of the trial less that of the clump, when only the balls `of` differ.
    fn cost(&mut self, state: &State, of: &[u32]) -> f64 {
        let dexels = state.ground.dexels;
        for &j in of {
            self.seen[j as usize] = dexels.seen(&self.trial[j as usize]);
        }
        state.aim(of, &self.seen, &mut self.look);
        state.cost(&self.look.exchange(&state.cover, &state.piles, dexels, of, &self.seen))
    }
}
