//! A step: bodies move, forces are summed, what is due comes, breaks or wears.

use super::{Engine, Setup, Work};
use crate::dem::built::built;
use crate::dem::contact::{Calls, CohesionLaw, DampingLaw};
use crate::dem::effects::cohesion::jkr_range;
use crate::dem::effects::{Coefficients, drag, gravity};
use crate::dem::kernel::{Context, Scratch, Sums};
use crate::dem::narrow::{ContactRecord, Pair};
use crate::dem::template::Template;
use crate::dem::{energy, integrate};
use crate::error::{Error, Result, figure};
use crate::math::Vec3;
use crate::run::Run;
use std::cell::RefCell;
use std::sync::{Arc, Mutex};

/// Pairs that one thread takes at a time.
const CHUNK: usize = 32;
/// Steps between looks at the energy.
const GUARD: u64 = 32;

thread_local! {
    /// Room for searches: what is in it never matters.
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

impl Engine {
    /// Goes on by `steps` steps. Stops with an error where more kinetic energy has come about than was put in, and
    /// when the caller cancels.
    pub fn advance(&mut self, steps: u64, run: &Run) -> Result<()> {
        self.start(run)?;
        for n in 0..steps {
            self.one(run)?;
            if n % 64 == 63 {
                run.check(n as f64 / steps as f64, "simulating")?;
            }
        }
        Ok(())
    }

    /// Forces at the start.
    pub fn start(&mut self, run: &Run) -> Result<()> {
        if self.started {
            return Ok(());
        }
        self.insert()?;
        self.started = true;
        self.forces(run, self.setup.dt);
        let [a, b] = energy::kinetic(&self.state);
        let stored: f64 = self.contacts().iter().flatten().map(|c| c.energy.max(0.0)).sum();
        self.put_in += a + b + stored + self.potential();
        Ok(())
    }

    /// The bodies that are due.
    fn insert(&mut self) -> Result<()> {
        for k in 0..self.setup.insertion.len() {
            let (i, before) = (&self.setup.insertion[k], self.inserted[k]);
            if before >= i.total || !self.step.is_multiple_of(i.every) {
                continue;
            }
            self.work.insertion += 1;
            let batch = i.batch(before, self.step, &self.state, &self.walls);
            self.inserted[k] += batch.len() as u64;
            for body in &batch {
                self.add(body)?;
            }
        }
        Ok(())
    }

    fn one(&mut self, run: &Run) -> Result<()> {
        let dt = self.setup.dt;
        integrate::drift(&mut self.state, dt, self.setup.exact_rotation);
        self.step += 1;
        let time = self.time();
        if const { built("motion") } {
            for wall in &mut self.walls {
                if wall.to(time, dt) {
                    self.work.motion += 1;
                }
            }
        }
        self.forces(run, self.setup.dt);
        integrate::kick(&mut self.state, dt);
        for (i, wall) in self.walls.iter().enumerate().filter(|_| const { built("motion") }) {
            let power = self.wall_force[i].dot(&wall.kin.v) + self.wall_torque[i].dot(&wall.kin.w);
            self.put_in -= power * dt;
        }
        if const { built("fragmentation") } && self.breaker.is_some() {
            self.break_due(run)?;
        }
        if const { built("wear") } && self.wearer.is_some() {
            self.wear_due(run)?;
        }
        if const { built("insertion") } {
            self.insert()?;
        }
        if self.setup.guard && self.step.is_multiple_of(GUARD) {
            self.look()?;
        }
        Ok(())
    }

    /// Forces and torques at this time, `dt` after the last.
    pub(in crate::dem) fn forces(&mut self, run: &Run, dt: f64) {
        let n = self.state.len();
        self.state.force.fill(Vec3::zeros());
        self.state.torque.fill(Vec3::zeros());
        if const { built("gravity") }
            && let Some(g) = &self.setup.gravity
        {
            gravity::pull(&mut self.state, g);
            self.work.gravity += n as u64;
        }
        if const { built("drag") }
            && let Some(d) = &self.setup.drag
        {
            drag::slow(&mut self.state, d);
            self.work.drag += n as u64;
        }
        let Some(kernel) = self.kernel.as_ref().filter(|_| const { built("normal") }) else {
            return;
        };
        self.wall_force.fill(Vec3::zeros());
        self.wall_torque.fill(Vec3::zeros());
        self.broad.update(&self.state);
        if self.wall_pairs.len() != n * self.walls.len() {
            pair_walls(&mut self.wall_pairs, self.walls.len(), n);
        }
        let s = &mut self.state;
        let context = Context {
            kin: &s.kin,
            moved: &s.moved,
            stride: &s.stride,
            templates: &s.templates,
            template: &s.template,
            material: &s.material,
            fixed: &s.fixed,
            walls: &self.walls,
            materials: self.setup.materials,
            coefficients: &self.setup.coefficients,
            range: range(&self.setup, &s.templates),
            dt,
            step: self.setup.dt,
            felt: self.setup.laws.is_some_and(|l| l.damping == DampingLaw::Contact),
            averaging: self.setup.laws.is_some_and(|l| l.averaging),
        };
        let mut sums = Sums {
            force: &mut s.force,
            torque: &mut s.torque,
            wall_force: &mut self.wall_force,
            wall_torque: &mut self.wall_torque,
            load: self.breaker.as_mut().filter(|b| b.setup.threshold.is_some()).map(|b| {
                b.load.fill(0.0);
                b.load.as_mut_slice()
            }),
        };
        let (pairs, walls) = (&mut self.broad.pairs, &mut self.wall_pairs);
        let pool = run.pool();
        if pool.threads() == 1 {
            SCRATCH.with_borrow_mut(|scratch| {
                kernel.bodies(pairs, &context, scratch, Some(&mut sums));
                kernel.walls(walls, &context, scratch, Some(&mut sums));
                collect(scratch, &mut self.work);
            });
            return;
        }
        let work = Mutex::new(&mut self.work);
        let done = |scratch: &mut Scratch| {
            if let Ok(mut work) = work.lock() {
                collect(scratch, &mut work);
            }
        };
        pool.chunks_mut(pairs, CHUNK, |_, chunk| {
            SCRATCH.with_borrow_mut(|scratch| {
                kernel.bodies(chunk, &context, scratch, None);
                done(scratch);
            });
        });
        pool.chunks_mut(walls, 4 * CHUNK, |_, chunk| {
            SCRATCH.with_borrow_mut(|scratch| {
                kernel.walls(chunk, &context, scratch, None);
                done(scratch);
            });
        });
        for pair in pairs.iter_mut() {
            if let Some(w) = pair.wrench.take() {
                sums.bodies(pair, &w);
            }
        }
        for pair in walls.iter_mut() {
            if let Some(w) = pair.wrench.take() {
                sums.wall(pair, &w);
            }
        }
    }

    /// The contacts as they are: between bodies, and of walls with bodies.
    pub fn contacts(&self) -> [Vec<ContactRecord>; 2] {
        let Some(kernel) = &self.kernel else { return [Vec::new(), Vec::new()] };
        let s = &self.state;
        let context = Context {
            kin: &s.kin,
            moved: &s.moved,
            stride: &s.stride,
            templates: &s.templates,
            template: &s.template,
            material: &s.material,
            fixed: &s.fixed,
            walls: &self.walls,
            materials: self.setup.materials,
            coefficients: &self.setup.coefficients,
            range: range(&self.setup, &s.templates),
            dt: self.setup.dt,
            step: self.setup.dt,
            felt: false,
            averaging: self.setup.laws.is_some_and(|l| l.averaging),
        };
        kernel.records(&self.broad.pairs, &self.wall_pairs, &context)
    }

    /// Stops a run that has more kinetic energy than was put in.
    fn look(&self) -> Result<()> {
        let [a, b] = energy::kinetic(&self.state);
        let most = self.put_in - self.potential();
        if a + b <= 1.05 * most.max(0.0) + f64::MIN_POSITIVE {
            return Ok(());
        }
        let [bodies, walls] = self.contacts();
        let deepest =
            |c: &[ContactRecord]| c.iter().copied().max_by(|x, y| x.overlap.total_cmp(&y.overlap));
        let (p, w) = (deepest(&bodies), deepest(&walls));
        let of_wall = w.is_some_and(|w| p.is_none_or(|p| w.overlap > p.overlap));
        let name = |i: u32| format!("body {}", self.state.label[i as usize]);
        let place = match if of_wall { w } else { p } {
            Some(c) if of_wall => {
                format!("wall {} and {}, {} deep", c.a, name(c.b), figure(c.overlap))
            }
            Some(c) => format!("{} and {}, {} deep", name(c.a), name(c.b), figure(c.overlap)),
            None => "no contact any more".into(),
        };
        Err(Error::InvalidArgument(format!(
            "the run blew up at step {}: a kinetic energy of {} where at most {} was put in; the deepest contact is {place}; the \
             time step of {} is too large, or bodies overlapped",
            self.step,
            figure(a + b),
            figure(most),
            figure(self.setup.dt)
        )))
    }
}

fn collect(scratch: &mut Scratch, work: &mut Work) {
    work.calls.add(&scratch.calls);
    work.contacts += scratch.contacts;
    work.searches += scratch.searches;
    (scratch.calls, scratch.contacts, scratch.searches) = (Calls::default(), 0, 0);
}

/// How far beyond touching lists must look.
fn range(setup: &Setup, templates: &[Arc<Template>]) -> f64 {
    let bound = templates.iter().map(|t| t.bound()).fold(0.0, f64::max);
    let rounding = 1e-12 * bound;
    if setup.laws.is_some_and(|l| l.cohesion == CohesionLaw::Jkr) {
        let far = |c: &Coefficients| {
            if c.stiffness > 0.0 { jkr_range(c.cohesion, c.stiffness, bound) } else { 0.0 }
        };
        return setup.coefficients.iter().map(far).fold(rounding, f64::max);
    }
    rounding
}

/// A pair for every wall and body, in the order of (wall, body); what there is of them is kept.
fn pair_walls(pairs: &mut Vec<Pair>, walls: usize, bodies: usize) {
    let mut old = std::mem::take(pairs).into_iter().peekable();
    for a in 0..walls as u32 {
        for b in 0..bodies as u32 {
            let kept = old.next_if(|p| (p.a, p.b) == (a, b));
            pairs.push(kept.unwrap_or_else(|| Pair::new(a, b)));
        }
    }
}
