//! The loop over time: [`Engine`] holds all of a running simulation, `step` moves it on, `resume` keeps it, `report`
//! tells what it did.

mod report;
mod resume;
mod setup;
mod step;

pub use setup::{EffectReport, Setup, Work};

use crate::dem::breaking::Broken;
use crate::dem::broad::Broad;
use crate::dem::built::check_all;
use crate::dem::contact::{Law, Visitor, choose};
use crate::dem::effects::fragmentation::Breaker;
use crate::dem::effects::wear::{Wearer, Worn};
use crate::dem::energy;
use crate::dem::kernel::{Kernel, Of};
use crate::dem::narrow::Pair;
use crate::dem::state::{Placed, State};
use crate::dem::walls::Wall;
use crate::error::{Error, Result, figure};
use crate::math::Vec3;
use std::marker::PhantomData;

/// A running simulation.
pub struct Engine {
    pub(super) setup: Setup,
    pub(super) state: State,
    walls: Vec<Wall>,
    wall_pairs: Vec<Pair>,
    wall_force: Vec<Vec3>,
    wall_torque: Vec<Vec3>,
    broad: Broad,
    kernel: Option<Box<dyn Kernel>>,
    pub(super) work: Work,
    step: u64,
    /// Energy that was put in: kinetic and potential of the bodies, springs, work of walls.
    pub(super) put_in: f64,
    /// Bodies of each insertion so far.
    inserted: Vec<u64>,
    started: bool,
    pub(super) breaker: Option<Breaker>,
    /// What a checkpoint said of pieces, until it is asked for.
    pub(super) broken: Option<Broken>,
    pub(super) wearer: Option<Wearer>,
    pub(super) worn: Option<Vec<Worn>>,
}

struct Make;

impl Visitor for Make {
    type Out = Box<dyn Kernel>;

    fn visit<L: Law>(self) -> Box<dyn Kernel> {
        Box::new(Of::<L>(PhantomData))
    }
}

impl Engine {
    /// An engine over these bodies.
    ///
    /// Refused: a time step that is not a number above 0, coefficients that are not numbers of 0 or more,
    /// materials that do not exist, walls that are none, combinations of laws that are not built.
    pub fn new(setup: Setup, state: State) -> Result<Engine> {
        if !(setup.dt.is_finite() && setup.dt > 0.0) {
            let dt = figure(setup.dt);
            return Err(Error::InvalidArgument(format!(
                "the time step is {dt}, not a number above 0"
            )));
        }
        check_all(&setup)?;
        let walls: Result<Vec<Wall>> =
            setup.walls.iter().enumerate().map(|(i, w)| Wall::new(w, i)).collect();
        let walls = walls?;
        let m = setup.materials;
        if setup.coefficients.len() != m * m {
            let n = setup.coefficients.len();
            return Err(Error::InvalidArgument(format!("{n} coefficients for {m} materials")));
        }
        for (i, c) in setup.coefficients.iter().enumerate() {
            c.check(i / m, i % m)?;
        }
        let of_walls = walls.iter().map(|w| w.material);
        if let Some(k) = state.material.iter().copied().chain(of_walls).find(|k| *k as usize >= m) {
            return Err(Error::IndexOutOfRange(format!("there is no material {k} of {m}")));
        }
        if let Some(d) = &setup.drag {
            d.check()?;
        }
        for i in &setup.insertion {
            i.check(state.templates.len(), m)?;
        }
        for (i, w) in walls.iter().enumerate() {
            for (k, t) in state.templates.iter().enumerate() {
                let radius = t.spheres().iter().map(|s| s.radius).fold(0.0, f64::max);
                if let Some(r) = w.narrowest()
                    && radius >= r
                {
                    let (r, radius) = (figure(r), figure(radius));
                    return Err(Error::InvalidArgument(format!(
                        "a sphere of template {k} has the radius {radius}, wall {i} {r}"
                    )));
                }
            }
        }
        let kernel = match &setup.laws {
            Some(laws) => Some(choose(laws, Make)?),
            None => None,
        };
        let (force, torque) = (vec![Vec3::zeros(); walls.len()], vec![Vec3::zeros(); walls.len()]);
        let inserted = vec![0; setup.insertion.len()];
        Ok(Engine {
            inserted,
            setup,
            state,
            walls,
            wall_pairs: Vec::new(),
            wall_force: force,
            wall_torque: torque,
            broad: Broad::default(),
            kernel,
            work: Work::default(),
            step: 0,
            put_in: 0.0,
            started: false,
            breaker: None,
            broken: None,
            wearer: None,
            worn: None,
        })
    }

    /// The bodies.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// What is simulated.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Steps so far.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Time so far.
    pub fn time(&self) -> f64 {
        self.step as f64 * self.setup.dt
    }

    /// What was done.
    pub fn work(&self) -> Work {
        Work { steps: self.step, broad: self.broad.renewed, ..self.work }
    }

    /// Force and torque (about its origin) that bodies have on wall `i` in this step.
    pub fn on_wall(&self, i: usize) -> Option<[Vec3; 2]> {
        Some([*self.wall_force.get(i)?, *self.wall_torque.get(i)?])
    }

    /// Adds a body and returns its label.
    pub fn add(&mut self, body: &Placed) -> Result<u64> {
        if body.material as usize >= self.setup.materials {
            return Err(Error::IndexOutOfRange(format!(
                "there is no material {} of {}",
                body.material, self.setup.materials
            )));
        }
        let label = self.state.add(body)?;
        if let Some(b) = &mut self.breaker {
            b.add();
        }
        if self.started {
            let i = self.state.len() - 1;
            let [a, b] = self.energy_of(i);
            self.put_in += a + b;
        }
        Ok(label)
    }

    fn energy_of(&self, i: usize) -> [f64; 2] {
        let s = &self.state;
        if s.fixed[i] {
            return [0.0; 2];
        }
        let straight = 0.5 * s.mass(i) * s.velocity[i].norm_squared();
        let turning = 0.5 * s.angular_velocity(i).dot(&s.momentum[i]);
        let g = self.setup.gravity.unwrap_or_default();
        [straight + turning, -s.mass(i) * g.dot(&s.position[i])]
    }

    /// Forgets all contacts of these bodies.
    pub(super) fn forget(&mut self, those: std::ops::Range<usize>) {
        let own = |i: u32| those.contains(&(i as usize));
        self.broad.pairs.retain(|p| !own(p.a) && !own(p.b));
        self.wall_pairs.retain(|p| !own(p.b));
        self.broad.forget();
    }

    /// How many bodies each insertion has brought.
    pub fn inserted(&self) -> &[u64] {
        &self.inserted
    }

    /// Takes a body away.
    pub fn remove(&mut self, label: u64) -> Result<()> {
        let Ok(i) = self.state.label.binary_search(&label) else {
            return Err(Error::IndexOutOfRange(format!("there is no body {label}")));
        };
        self.state.remove(i);
        if let Some(b) = &mut self.breaker {
            b.remove(i);
        }
        let i = i as u32;
        self.broad.remove(i);
        self.wall_pairs.retain_mut(|p| {
            let keep = p.b != i;
            p.b -= u32::from(p.b > i);
            keep
        });
        Ok(())
    }

    /// Adds a template and returns its number.
    pub fn add_template(
        &mut self,
        template: std::sync::Arc<crate::dem::template::Template>,
    ) -> u32 {
        self.state.templates.push(template);
        self.state.templates.len() as u32 - 1
    }

    /// Changes bodies in place. Lists of what is near are made anew.
    pub fn edit<T>(&mut self, change: impl FnOnce(&mut State) -> T) -> T {
        let out = change(&mut self.state);
        (0..self.state.len()).for_each(|i| self.state.refresh(i));
        self.broad.forget();
        self.wall_pairs.iter_mut().for_each(Pair::forget);
        out
    }

    pub(super) fn potential(&self) -> f64 {
        self.setup.gravity.map_or(0.0, |g| energy::potential(&self.state, &g))
    }
}
