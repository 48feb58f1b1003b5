//! The loop over time.

use super::breaking::Broken;
use super::broad::Broad;
use super::built::{built, check_all};
use super::contact::{Calls, Law, Laws, Visitor, choose};
use super::effects::cohesion::jkr_range;
use super::effects::drag::{self, Drag};
use super::effects::fragmentation::Breaker;
use super::effects::insertion::Insertion;
use super::effects::wear::{Wearer, Worn};
use super::effects::{Coefficients, gravity};
use super::energy;
use super::integrate;
use super::kernel::{Context, Kernel, Of, Scratch, Sums};
use super::narrow::{ContactRecord, Pair};
use super::snapshot::{self, Bodies, Snapshot};
use super::state::{Placed, State};
use super::walls::{Wall, WallSetup};
use crate::error::{Error, Result, figure};
use crate::math::Vec3;
use crate::run::Run;
use std::cell::RefCell;
use std::marker::PhantomData;
use std::sync::Mutex;

/// Pairs that one thread takes at a time.
const CHUNK: usize = 32;
/// Steps between looks at the energy.
const GUARD: u64 = 32;

/// What is simulated: effects that are not named do no work and hold no memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Time step.
    pub dt: f64,
    /// Laws of contact; `None`: bodies pass through each other.
    pub laws: Option<Laws>,
    /// How many materials there are.
    pub materials: usize,
    /// For each two materials, `materials`² rows by rows.
    pub coefficients: Vec<Coefficients>,
    /// The walls.
    pub walls: Vec<WallSetup>,
    /// Acceleration of gravity.
    pub gravity: Option<Vec3>,
    /// A fluid that slows bodies down.
    pub drag: Option<Drag>,
    /// Bodies that come while it runs.
    pub insertion: Vec<Insertion>,
    /// Whether bodies turn exactly between the forces (else by splitting, with an error of dt²).
    pub exact_rotation: bool,
    /// Whether a run that has more kinetic energy than was put in is stopped.
    pub guard: bool,
}

impl Setup {
    /// Bodies alone: a time step, one material, no contacts.
    pub fn free(dt: f64) -> Setup {
        Setup {
            dt,
            laws: None,
            materials: 1,
            coefficients: vec![Coefficients::default()],
            walls: Vec::new(),
            gravity: None,
            drag: None,
            insertion: Vec::new(),
            exact_rotation: false,
            guard: true,
        }
    }
}

/// How much was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Steps.
    pub steps: u64,
    /// Lists of near bodies made.
    pub broad: u64,
    /// Searches of two sphere trees, or of a wall and one.
    pub searches: u64,
    /// Contacts, summed over the steps.
    pub contacts: u64,
    /// Calls of each law of contact.
    pub calls: Calls,
    /// Bodies that gravity pulled, summed over the steps.
    pub gravity: u64,
    /// Bodies that a fluid slowed down, summed over the steps.
    pub drag: u64,
    /// Batches of bodies that were looked for.
    pub insertion: u64,
    /// Places of walls that were reckoned.
    pub motion: u64,
}

/// What one effect did and holds: nothing, where it is not named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EffectReport {
    /// Its name.
    pub name: &'static str,
    /// How often it was called.
    pub calls: u64,
    /// Bytes that it holds.
    pub bytes: u64,
}

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

thread_local! {
    /// Room for searches: what is in it never matters.
    static SCRATCH: RefCell<Scratch> = RefCell::default();
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
    pub fn add_template(&mut self, template: std::sync::Arc<super::template::Template>) -> u32 {
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

    /// Bytes that all of it holds.
    pub fn bytes(&self) -> u64 {
        let templates: u64 = self.state.templates.iter().map(|t| t.bytes()).sum();
        let walls: u64 = self.walls.iter().map(Wall::bytes).sum();
        let pairs: u64 = self.wall_pairs.iter().map(|p| p.bytes() + p.memory_bytes()).sum();
        let held: u64 = self.broad.pairs.iter().map(Pair::memory_bytes).sum();
        self.state.bytes() + templates + walls + pairs + held + self.broad.bytes()
    }

    /// What each effect did and holds.
    pub fn effects(&self) -> Vec<EffectReport> {
        let (c, w) = (&self.work.calls, &self.work);
        let held: u64 =
            self.broad.pairs.iter().chain(&self.wall_pairs).map(Pair::memory_bytes).sum();
        // A contact's memory is of several effects.
        let widths = self.kernel.as_ref().map_or([0; 3], |k| k.widths());
        let each = held / (widths.iter().sum::<usize>() as u64).max(1);
        let [friction, rolling, cohesion] = widths.map(|w| w as u64 * each);
        let insertion = self.setup.insertion.capacity() * (size_of::<Insertion>() + 8);
        let moving = self.walls.iter().filter(|w| w.moves()).count() * size_of::<Wall>();
        [
            ("gravity", w.gravity, 0),
            ("normal", c.normal, 0),
            ("damping", c.damping, 0),
            ("tangential", c.tangential, friction),
            ("rolling", c.rolling, rolling),
            ("cohesion", c.cohesion, cohesion),
            ("averaging", c.averaging, 0),
            ("drag", w.drag, 0),
            ("insertion", w.insertion, insertion as u64),
            ("motion", w.motion, moving as u64),
            (
                "fragmentation",
                self.breaker.as_ref().map_or(0, |b| b.calls),
                self.breaker.as_ref().map_or(0, Breaker::bytes),
            ),
            (
                "wear",
                self.wearer.as_ref().map_or(0, |w| w.calls),
                self.wearer.as_ref().map_or(0, Wearer::bytes),
            ),
        ]
        .map(|(name, calls, bytes)| EffectReport { name, calls, bytes })
        .to_vec()
    }

    /// A checkpoint: with the same setup it goes on to the same bytes.
    pub fn checkpoint(&self) -> Result<Vec<u8>> {
        let width = self.kernel.as_ref().map_or(0, |k| k.width());
        Snapshot {
            step: self.step,
            put_in: self.put_in,
            inserted: self.inserted.clone(),
            bodies: Bodies::of(&self.state),
            pairs: snapshot::memories(&self.broad.pairs, width),
            walls: snapshot::memories(&self.wall_pairs, width),
            wall_force: self.wall_force.clone(),
            wall_torque: self.wall_torque.clone(),
            broken: self.broken()?,
            worn: self.wearer.as_ref().map(|w| w.worn.clone()),
        }
        .to_bytes()
    }

    /// Goes on from a checkpoint of the same setup, which must have been started. Refused: what is none, is damaged, is of another
    /// version, or of another number of walls or insertions.
    pub fn resume(setup: Setup, checkpoint: &[u8]) -> Result<Engine> {
        let s = Snapshot::of_bytes(checkpoint)?;
        let mut engine = Engine::new(setup, s.bodies.state()?)?;
        if s.wall_force.len() != engine.walls.len() || s.inserted.len() != engine.inserted.len() {
            return Err(Error::InvalidArgument(format!(
                "the checkpoint has {} walls and {} insertions, the scene {} and {}",
                s.wall_force.len(),
                s.inserted.len(),
                engine.walls.len(),
                engine.inserted.len()
            )));
        }
        let width = engine.kernel.as_ref().map_or(0, |k| k.width());
        engine.broad.pairs = snapshot::recalled(s.pairs, width);
        engine.wall_pairs = snapshot::recalled(s.walls, width);
        (engine.wall_force, engine.wall_torque) = (s.wall_force, s.wall_torque);
        (engine.step, engine.put_in, engine.inserted) = (s.step, s.put_in, s.inserted);
        let (time, dt) = (engine.time(), engine.setup.dt);
        for wall in &mut engine.walls {
            wall.to(time, dt);
        }
        (engine.broken, engine.worn) = (s.broken, s.worn);
        engine.started = true;
        Ok(engine)
    }

    pub(super) fn potential(&self) -> f64 {
        self.setup.gravity.map_or(0.0, |g| energy::potential(&self.state, &g))
    }

    fn one(&mut self, run: &Run) -> Result<()> {
        let dt = self.setup.dt;
        integrate::drift(&mut self.state, dt, self.setup.exact_rotation);
        self.step += 1;
        let time = self.time();
        if built("motion") {
            for wall in &mut self.walls {
                if wall.to(time, dt) {
                    self.work.motion += 1;
                }
            }
        }
        self.forces(run, self.setup.dt);
        integrate::kick(&mut self.state, dt);
        for (i, wall) in self.walls.iter().enumerate().filter(|_| built("motion")) {
            let power = self.wall_force[i].dot(&wall.kin.v) + self.wall_torque[i].dot(&wall.kin.w);
            self.put_in -= power * dt;
        }
        if built("fragmentation") && self.breaker.is_some() {
            self.break_due(run)?;
        }
        if built("wear") && self.wearer.is_some() {
            self.wear_due(run)?;
        }
        if built("insertion") {
            self.insert()?;
        }
        if self.setup.guard && self.step.is_multiple_of(GUARD) {
            self.look()?;
        }
        Ok(())
    }

    /// Forces and torques at this time, `dt` after the last.
    pub(super) fn forces(&mut self, run: &Run, dt: f64) {
        let n = self.state.len();
        self.state.force.fill(Vec3::zeros());
        self.state.torque.fill(Vec3::zeros());
        if built("gravity")
            && let Some(g) = &self.setup.gravity
        {
            gravity::pull(&mut self.state, g);
            self.work.gravity += n as u64;
        }
        if built("drag")
            && let Some(d) = &self.setup.drag
        {
            drag::slow(&mut self.state, d);
            self.work.drag += n as u64;
        }
        let Some(kernel) = self.kernel.as_ref().filter(|_| built("normal")) else { return };
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
            felt: self.setup.laws.is_some_and(|l| l.damping == super::contact::DampingLaw::Contact),
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
            felt: false,
            averaging: false,
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
fn range(setup: &Setup, templates: &[std::sync::Arc<super::template::Template>]) -> f64 {
    let bound = templates.iter().map(|t| t.bound()).fold(0.0, f64::max);
    let rounding = 1e-12 * bound;
    if setup.laws.is_some_and(|l| l.cohesion == super::contact::CohesionLaw::Jkr) {
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
