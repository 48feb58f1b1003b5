//! The search: moves in batches of a fixed size, tried side by side on the same clump. Those that
//! help are taken one after the other, each only if it still helps after those before it. The
//! result does not depend on how many threads share a batch.

use super::moves::{Fans, Moved, Mover};
use super::refine::{Refiner, Schedule};
use super::state::State;
use super::watch::Watch;
use crate::error::Result;
use crate::generate::ball::Ball;
use crate::generate::balls::cover::Look;
use crate::generate::balls::directions::Directions;
use crate::generate::balls::exposed::Weights;
use crate::generate::balls::random::Random;
use crate::run::Pool;
use std::sync::{Mutex, PoisonError};

/// Moves tried side by side.
pub(super) const BATCH: usize = 8;
/// Part of the moves that take the ball worth least.
const CHEAPEST: f64 = 0.85;
/// All balls are refined after so many moves that helped, and for so many balls one more.
const HELPED: u64 = 12;
const HELPED_OF: usize = 16;
/// From so many samples of an iteration on, threads share it.
const SHARED: usize = 6144;

/// A search with its random numbers and buffers.
pub(super) struct Search<'s, 'a> {
    pub state: &'s mut State<'a>,
    pool: &'s Pool,
    pub watch: &'s Watch<'s>,
    fans: Fans,
    movers: Vec<Mutex<Mover<'a>>>,
    look: Look,
    refiner: Refiner,
    random: Random,
    seed: u64,
    moves: u64,
    helped: u64,
    /// So many moves that helped before all balls are refined.
    enough: u64,
}

impl<'s, 'a> Search<'s, 'a> {
    /// `around`: most balls that a move refines.
    pub(super) fn new(
        state: &'s mut State<'a>,
        seed: u64,
        pool: &'s Pool,
        watch: &'s Watch<'s>,
        around: usize,
    ) -> Search<'s, 'a> {
        Search {
            state,
            pool,
            watch,
            fans: Fans::new(around),
            movers: (0..BATCH).map(|_| Mutex::default()).collect(),
            look: Look::default(),
            refiner: Refiner::default(),
            random: Random::new(seed, 1),
            seed,
            moves: 0,
            helped: 0,
            enough: HELPED,
        }
    }

    /// Bytes of its large arrays.
    pub(super) fn bytes(&self) -> u64 {
        let mover = |m: &Mutex<Mover>| m.lock().unwrap_or_else(PoisonError::into_inner).bytes();
        let movers: u64 = self.movers.iter().map(mover).sum();
        movers + self.look.bytes() + self.refiner.bytes()
    }

    /// Tries a batch of moves.
    pub(super) fn batch(&mut self) -> Result<()> {
        let picked: Vec<usize> = (0..BATCH).map(|_| self.pick()).collect();
        let (state, fans, movers) = (&*self.state, &self.fans, &self.movers);
        let (seed, moves) = (self.seed, self.moves);
        let found: Vec<Option<Moved>> = self.pool.map(BATCH, |k| {
            let mut random = Random::new(seed, 2 + moves + k as u64);
            let mut mover = movers[k].lock().unwrap_or_else(PoisonError::into_inner);
            mover.attempt(state, fans, picked[k], &mut random)
        });
        self.moves += BATCH as u64;
        let mut changed: Vec<u32> = Vec::new();
        for moved in found.into_iter().flatten() {
            if moved.of.iter().any(|j| changed.contains(j)) {
                continue;
            }
            if self.state.take(&moved.of, &moved.balls, &mut self.look) {
                moved.orbits.iter().for_each(|o| self.state.orbits.set(o));
                changed.extend(&moved.of);
                self.helped += 1;
                if self.helped >= self.enough {
                    self.enough += HELPED + (self.state.balls.len() / HELPED_OF) as u64;
                    self.settle(20, [1.2, 0.25], &Directions::new(192))?;
                    break;
                }
            }
        }
        Ok(())
    }

    /// The ball that is moved next.
    fn pick(&mut self) -> usize {
        let state = &mut *self.state;
        let n = state.balls.len();
        let mut best = (f64::MAX, 0);
        if self.random.unit() >= CHEAPEST {
            let i = state.fixed + self.random.below(n - state.fixed);
            best.1 = state.orbits.lead(i as u32) as usize;
        } else {
            let least = 1e-3 * state.left() / n as f64;
            for i in (state.fixed..n).filter(|&i| state.orbits.lead(i as u32) as usize == i) {
                let worth = state.worth(i).max(least);
                let key =
                    worth * (1.0 + 0.5 * f64::from(state.tried[i])) * self.random.between(0.7, 1.3);
                if key < best.0 {
                    best = (key, i);
                }
            }
        }
        state.tried[best.1] += 1;
        best.1
    }

    /// The last refinement, with this many directions and iterations.
    pub(super) fn polish(&mut self, [directions, iterations]: [usize; 2]) -> Result<()> {
        self.settle(iterations, [0.8, 0.04], &Directions::new(directions))
    }

    /// Refines all balls, with Huber's widths at the first and last iteration in units of the
    /// state's; the clump stays as it was where that does not help.
    fn settle(
        &mut self,
        iterations: usize,
        [from, to]: [f32; 2],
        directions: &Directions,
    ) -> Result<()> {
        let before = (self.state.goal(), self.state.parts);
        let weights = self.state.weights();
        let balls = self.refined(iterations, [from, to], directions, weights);
        let old = std::mem::replace(&mut self.state.balls, balls);
        self.state.renew(&mut self.look)?;
        self.state.join(&mut self.look, self.watch)?;
        if self.state.goal() >= before.0 || self.state.parts > before.1 {
            self.state.parts = before.1;
            self.put(old)?;
        } else {
            self.state.measure_width(self.refiner.area);
        }
        Ok(())
    }

    /// Puts other balls in the place of all.
    pub(super) fn put(&mut self, balls: Vec<Ball>) -> Result<()> {
        self.state.balls = balls;
        self.state.renew(&mut self.look)
    }

    /// The same, and joins them where they must hang together.
    pub(super) fn put_joined(&mut self, balls: Vec<Ball>) -> Result<()> {
        self.put(balls)?;
        self.state.join(&mut self.look, self.watch)
    }

    /// All balls after a refinement.
    fn refined(
        &mut self,
        iterations: usize,
        [from, to]: [f32; 2],
        directions: &Directions,
        weights: Weights,
    ) -> Vec<Ball> {
        let state = &*self.state;
        let mut balls = state.balls.clone();
        let all = state.free();
        let task = state.ground.task(directions, weights, &state.orbits, state.pull());
        let schedule = Schedule { iterations, from: from * state.width, to: to * state.width };
        let shared = (all.len() * directions.len() >= SHARED).then_some(self.pool);
        let (random, go) = (&mut self.random, &mut || self.watch.go());
        self.refiner.refine(&task, &schedule, &mut balls, &all, random, shared, go);
        balls
    }

    /// All balls after a last refinement with this many directions and iterations, in which
    /// volume costs so much more.
    pub(super) fn swollen(&mut self, [directions, iterations]: [usize; 2], cost: f64) -> Vec<Ball> {
        let mut weights = self.state.weights();
        weights.inside -= cost as f32;
        weights.outside += cost as f32;
        self.refined(iterations, [0.8, 0.04], &Directions::new(directions), weights)
    }
}
