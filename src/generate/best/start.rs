//! The start of a search: seeds, and all balls refined at once.

use super::cover::Look;
use super::directions::Directions;
use super::effort::Plan;
use super::exposed::Weights;
use super::random::Random;
use super::refine::{Refiner, Schedule};
use super::seeds;
use super::smooth::Smooth;
use super::state::{Ground, State};
use super::symmetry::{self, Orbits, Sites};
use crate::error::Result;
use crate::run::Run;

/// Huber's width at the first iteration, as a part of the body's size, for so many balls; of more
/// balls, which are smaller, less.
const WIDE: f32 = 0.03;
const FEW: f32 = 30.0;
/// From so many samples of an iteration on, threads share it.
const SHARED: usize = 6144;

/// What starts have in common.
pub(super) struct Start<'a, 'r> {
    pub ground: Ground<'a>,
    pub plan: Plan,
    pub n: usize,
    pub run: &'a Run<'r>,
}

impl<'a> Start<'a, '_> {
    /// A clump, with this symmetry. `go` is asked after every iteration whether to go on.
    pub(super) fn state(
        &self,
        sites: Option<&'a Sites>,
        smooth: Option<Smooth>,
        look: &mut Look,
        go: &mut dyn FnMut() -> bool,
    ) -> Result<State<'a>> {
        let Start { ground, plan, n, run } = self;
        let mut random = Random::new(run.seed(), 0);
        let (mut balls, orbits) = match sites {
            None => (seeds::seeds(ground, plan, *n, &mut random)?, Orbits::default()),
            Some(sites) => symmetry::seeds(sites, ground, plan, *n, &mut random)?,
        };
        // Least squares of distances first; then the volume between the surfaces.
        let directions = Directions::new(plan.directions);
        let mut refiner = Refiner::default();
        let leads = orbits.leads(*n);
        let shared = (*n * plan.directions >= SHARED).then(|| run.pool());
        let wide = WIDE * ground.size * (FEW / (*n as f32).max(FEW)).cbrt();
        let first = plan.iterations / 2;
        let schedule = Schedule { iterations: first, from: wide, to: wide / 6.0 };
        let free = ground.task(&directions, Weights::at(0.0, ground.overshoot), &orbits, None);
        refiner.refine(&free, &schedule, &mut balls, &leads, &mut random, shared, go);
        let mut state = State::new(*ground, balls, orbits, plan.moves > 0, smooth, look)?;
        state.measure_width(refiner.area);
        if go() {
            let task = ground.task(&directions, state.weights(), &state.orbits, state.pull());
            let schedule = Schedule {
                iterations: plan.iterations - first,
                from: 2.0 * state.width,
                to: 0.3 * state.width,
            };
            let mut balls = state.balls.clone();
            refiner.refine(&task, &schedule, &mut balls, &leads, &mut random, shared, go);
            state.balls = balls;
            state.renew(look);
            state.measure_width(refiner.area);
        }
        Ok(state)
    }
}
