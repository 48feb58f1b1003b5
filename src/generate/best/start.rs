//! The start of a search: seeds, and all balls refined at once.

use super::effort::{Effort, Plan};
use super::refine::{Refiner, Schedule};
use super::seeds;
use super::state::{Ground, State};
use super::symmetry::{self, Orbits, Sites};
use crate::error::Result;
use crate::generate::ball::Ball;
use crate::generate::balls::cover::Look;
use crate::generate::balls::directions::Directions;
use crate::generate::balls::exposed::Weights;
use crate::generate::balls::random::Random;
use crate::generate::balls::smooth::Smooth;
use crate::run::Pool;

/// Huber's width at the first iteration, as a part of the body's size, for so many balls; of more
/// balls, which are smaller, less.
const WIDE: f32 = 0.03;
const FEW: f32 = 30.0;
/// From so many samples of an iteration on, threads share it.
const SHARED: usize = 6144;

/// A symmetry may cost this part of what is made least.
const COSTS: f64 = 0.1;
/// Where so many steps down in the number of images bring no more than this, no further are tried.
const STEPS: usize = 2;
/// Starts with a symmetry: this, times its number of images, for each ball; but no more than so
/// many. Of few orbits all may be stuck, and starts are cheap.
const TRIES_OF: usize = 12;
const TRIES: usize = 4;

/// What starts have in common.
pub(super) struct Start<'a> {
    pub ground: Ground<'a>,
    pub plan: Plan,
    pub n: usize,
    pub seed: u64,
    pub pool: &'a Pool,
}

impl<'a> Start<'a> {
    /// A clump, with the largest of these symmetries that does not cost much. `go` is asked
    /// after every iteration, or every symmetry tried, whether to go on.
    pub(super) fn best(
        &self,
        choices: &'a [Sites],
        smooth: Option<Smooth>,
        look: &mut Look,
        go: &mut dyn FnMut() -> bool,
    ) -> Result<State<'a>> {
        let Start { ground, plan, n, seed, pool } = self;
        let mut random = Random::new(*seed, 0);
        let shared = (*n * plan.directions >= SHARED).then_some(*pool);
        if choices.is_empty() {
            if smooth.is_none() && plan.starts > 1 {
                return self.best_of(shared, go);
            }
            let seeds = (seeds::seeds(ground, plan, *n, &mut random)?, Orbits::default());
            return self.descend(plan, seeds, smooth, &mut random, shared, look, go);
        }
        let mut drafts: Vec<State<'a>> = Vec::new();
        let mut in_vain = 0;
        for some in choices.chunk_by(|a, b| a.order() == b.order()) {
            let before = chosen(&drafts);
            for sites in some {
                let tries = (TRIES_OF * sites.order() / n).clamp(1, TRIES);
                let states = match tries {
                    1 => vec![self.draft(sites, 0, shared)],
                    _ => pool.map(tries, |k| self.draft(sites, k as u64, None)),
                };
                let states = states.into_iter().collect::<Result<Vec<_>>>()?;
                let better = |a: State<'a>, b: State<'a>| if b.goal() < a.goal() { b } else { a };
                drafts.extend(states.into_iter().reduce(better));
            }
            in_vain = if chosen(&drafts) == before { in_vain + 1 } else { 0 };
            if !go() || in_vain == STEPS {
                break;
            }
        }
        let State { balls, orbits, width, .. } = drafts.swap_remove(chosen(&drafts).unwrap_or(0));
        let mut state = State::new(*ground, balls, orbits, smooth, look)?;
        state.width = width;
        let directions = Directions::new(plan.directions);
        let iterations = plan.iterations - plan.iterations / 2;
        self.settle(&mut state, &directions, iterations, &mut random, shared, look, go)?;
        Ok(state)
    }

    /// The best of a few starts, the first where time is up: of few balls one in ten or so leads
    /// to a clump that no move mends.
    fn best_of(&self, pool: Option<&Pool>, go: &mut dyn FnMut() -> bool) -> Result<State<'a>> {
        let Start { ground, plan, n, seed, .. } = self;
        let one = |k: u64, pool, go: &mut dyn FnMut() -> bool| {
            let mut random = Random::new(*seed, k.wrapping_neg());
            let seeds = (seeds::seeds(ground, plan, *n, &mut random)?, Orbits::default());
            self.descend(plan, seeds, None, &mut random, pool, &mut Look::default(), go)
        };
        let mut best = one(0, pool, go)?;
        if !go() {
            return Ok(best);
        }
        let more = self.pool.map(plan.starts - 1, |k| one(1 + k as u64, None, &mut || true));
        for other in more {
            let other = other?;
            if other.goal() < best.goal() {
                best = other;
            }
        }
        Ok(best)
    }

    /// A clump from a smaller one: `fixed` of its balls stay, further ones are added where most is
    /// missing. They come into place first, then all that do not stay move.
    pub(super) fn after(
        &self,
        before: &[Ball],
        fixed: usize,
        smooth: Option<Smooth>,
        look: &mut Look,
        go: &mut dyn FnMut() -> bool,
    ) -> Result<State<'a>> {
        let Start { ground, plan, n, seed, pool } = self;
        let mut random = Random::new(*seed, 0);
        let shared = (*n * plan.directions >= SHARED).then_some(*pool);
        let balls = seeds::more(ground, plan, before, *n, &mut random)?;
        let new: Vec<u32> = (before.len() as u32..*n as u32).collect();
        let mut state = State::new(*ground, balls, Orbits::default(), smooth, look)?;
        state.fixed = before.len();
        let mut refiner = Refiner::default();
        let directions = Directions::new(plan.directions);
        let wide = self.wide(*n);
        let iterations = plan.iterations / 2;
        let schedule = Schedule { iterations, from: 0.5 * wide, to: wide / 6.0 };
        let weights = Weights::at(0.0, ground.overshoot);
        let task = ground.task(&directions, weights, &state.orbits, None);
        let mut balls = state.balls.clone();
        refiner.refine(&task, &schedule, &mut balls, &new, &mut random, shared, go);
        state.balls = balls;
        state.renew(look)?;
        state.measure_width(refiner.area);
        state.fixed = fixed;
        if go() {
            let iterations = plan.iterations - iterations;
            self.settle(&mut state, &directions, iterations, &mut random, shared, look, go)?;
        }
        Ok(state)
    }

    /// Huber's width at the first iteration.
    fn wide(&self, balls: usize) -> f32 {
        WIDE * self.ground.size * (FEW / (balls as f32).max(FEW)).cbrt()
    }

    /// A start with this symmetry, the `k`th.
    fn draft(&self, sites: &'a Sites, k: u64, pool: Option<&Pool>) -> Result<State<'a>> {
        let plan = Effort::Draft.plan(self.n);
        let mut random = Random::new(self.seed, k.wrapping_neg());
        let seeds = symmetry::seeds(sites, &self.ground, &plan, self.n, &mut random)?;
        let look = &mut Look::default();
        self.descend(&plan, seeds, None, &mut random, pool, look, &mut || true)
    }

    /// Refines seeds: first for the least squares of distances, then for the volume between the
    /// surfaces.
    #[expect(clippy::too_many_arguments)]
    fn descend(
        &self,
        plan: &Plan,
        (mut balls, orbits): (Vec<Ball>, Orbits<'a>),
        smooth: Option<Smooth>,
        random: &mut Random,
        pool: Option<&Pool>,
        look: &mut Look,
        go: &mut dyn FnMut() -> bool,
    ) -> Result<State<'a>> {
        let ground = &self.ground;
        let directions = Directions::new(plan.directions);
        let mut refiner = Refiner::default();
        let leads = orbits.leads(balls.len());
        let wide = self.wide(balls.len());
        let first = plan.iterations / 2;
        let schedule = Schedule { iterations: first, from: wide, to: wide / 6.0 };
        let task = ground.task(&directions, Weights::at(0.0, ground.overshoot), &orbits, None);
        refiner.refine(&task, &schedule, &mut balls, &leads, random, pool, go);
        let mut state = State::new(*ground, balls, orbits, smooth, look)?;
        state.measure_width(refiner.area);
        if go() {
            let iterations = plan.iterations - first;
            self.settle(&mut state, &directions, iterations, random, pool, look, go)?;
        }
        Ok(state)
    }

    /// Refines a clump for the volume between the surfaces.
    #[expect(clippy::too_many_arguments)]
    fn settle(
        &self,
        state: &mut State,
        directions: &Directions,
        iterations: usize,
        random: &mut Random,
        pool: Option<&Pool>,
        look: &mut Look,
        go: &mut dyn FnMut() -> bool,
    ) -> Result<()> {
        let mut refiner = Refiner::default();
        let leads = state.free();
        let task = self.ground.task(directions, state.weights(), &state.orbits, state.pull());
        let schedule = Schedule { iterations, from: 2.0 * state.width, to: 0.3 * state.width };
        let mut balls = state.balls.clone();
        refiner.refine(&task, &schedule, &mut balls, &leads, random, pool, go);
        state.balls = balls;
        state.keep_books(self.plan.moves > 0);
        state.renew(look)?;
        state.measure_width(refiner.area);
        Ok(())
    }
}

/// The first that is not much worse than the best.
fn chosen(drafts: &[State]) -> Option<usize> {
    let least = drafts.iter().map(|s| s.goal()).fold(f64::MAX, f64::min);
    drafts.iter().position(|s| s.goal() <= (1.0 + COSTS) * least)
}
