//! Bodies that break: where the load of contacts passes a threshold a body is cut, its pieces get
//! spheres, and its motion is handed over to them by the room of fragments.
//!
//! The spheres of fragments stay within those of the body that breaks, so that neighbours are not
//! pushed: mass, momentum and angular momentum are those of the body (dust included), and the
//! energy of motion, of place and of springs together does not rise.

use crate::dem::breaking::errors;
use crate::dem::rotate::Orientation;
use crate::dem::state::{Placed, State};
use crate::dem::template::Template;
use crate::error::{Error, Result, figure};
use crate::fragment::{Cut, Held, Parent, Region, ShatterOptions, Shattered, shatter};
use crate::mass::Body;
use crate::math::{Inertia, Vec3};
use crate::run::Run;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};
use std::sync::Arc;

/// When a body breaks. The load of a body is the sum of the forces of all bodies and walls that touch it, each by its
/// size, so that what is squeezed from two sides counts twice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threshold {
    /// The load over time, what is older than `window` forgotten exponentially.
    Impulse {
        /// Force times time.
        limit: f64,
        /// Time.
        window: f64,
    },
    /// Half of the load over the section of the sphere that has the body's radius of gyration.
    Stress {
        /// Force per area.
        limit: f64,
    },
}

/// How a body is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BreakBy {
    /// Into cells of so many points, evenly spread.
    Seeded(usize),
    /// Into cells of so many points, the denser the nearer to the deepest contact.
    Impact(usize),
}

/// A template that breaks, and the shape that it stands for.
#[derive(Clone)]
pub struct Breakable {
    /// Number of the template.
    pub template: u32,
    /// Its solid and spheres.
    pub parent: Arc<Parent>,
    /// The body in the frame of the shape, from which the template was made.
    pub body: Body,
}

/// Breakage.
#[derive(Clone)]
pub struct Fragmentation {
    /// What breaks.
    pub breakable: Vec<Breakable>,
    /// When; without it at the given steps alone, and loads are neither kept nor looked at.
    pub threshold: Option<Threshold>,
    /// Bodies that break at a step whatever their load, by (step, label); what is not there then, or is no whole body and
    /// may not break again, does not.
    pub at: Vec<(u64, u64)>,
    /// How.
    pub by: BreakBy,
    /// Pieces and their spheres.
    pub options: ShatterOptions,
    /// How often pieces may break again: 1 breaks whole bodies only.
    pub generations: u32,
    /// Of the random cuts.
    pub seed: u64,
}

/// Energies, each summed over all bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energies {
    /// Of motion.
    pub kinetic: f64,
    /// In the field of gravity, 0 at the origin.
    pub potential: f64,
    /// Of springs in contacts.
    pub stored: f64,
}

impl Energies {
    /// All together.
    pub fn sum(&self) -> f64 {
        self.kinetic + self.potential + self.stored
    }
}

/// Contacts: how many, and the deepest overlap.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Touching {
    /// How many.
    pub count: usize,
    /// The deepest; 0 where there is none.
    pub deepest: f64,
}

/// One break. What is before is of the whole bed, what is after too, dust included.
#[derive(Debug, Clone, PartialEq)]
pub struct BreakRecord {
    /// At which step.
    pub step: u64,
    /// Which body.
    pub label: u64,
    /// Its fragments.
    pub fragments: Vec<u64>,
    /// Mass of its dust, which is taken away.
    pub dust: f64,
    /// Energies before.
    pub before: Energies,
    /// Energies after, those of the dust among them.
    pub after: Energies,
    /// Masses, momenta and angular momenta about the origin of all pieces as they stand, dust among them, less those
    /// of the body.
    pub mass: f64,
    /// As above.
    pub momentum: Vec3,
    /// As above.
    pub angular_momentum: Vec3,
    /// What these are to be seen beside: the sums of the sizes of the pieces' own.
    pub sizes: [f64; 3],
    /// Contacts of its fragments with each other.
    pub between: Touching,
    /// Contacts of the body with its neighbours and walls, and those of its fragments.
    pub around: [Touching; 2],
}

impl BreakRecord {
    /// Errors of mass, momentum and angular momentum, relative; 0 where nothing moves.
    pub fn errors(&self) -> [f64; 3] {
        errors(&(self.mass, self.momentum, self.angular_momentum), &self.sizes)
    }
}

/// What a template is a piece of.
#[derive(Clone)]
pub(crate) struct Shard {
    pub parent: usize,
    pub region: Option<Region>,
    /// Centre of mass and body axes (`w, x, y, z`) in the frame of the shape.
    pub center: Vec3,
    pub axes: [f64; 4],
    pub generation: u32,
}

/// What breaks in a run, and what has broken.
pub(crate) struct Breaker {
    pub setup: Fragmentation,
    /// For each template.
    pub shards: Vec<Option<Shard>>,
    /// For each body.
    pub load: Vec<f64>,
    pub impulse: Vec<f64>,
    pub log: Vec<BreakRecord>,
    pub calls: u64,
}

/// A body in pieces: each with its template and what it is a piece of.
pub(crate) struct Pieces {
    pub fragments: Vec<(Arc<Template>, Shard, Placed)>,
    pub shattered: Shattered,
}

pub(crate) fn unit(q: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(q[0], q[1], q[2], q[3]))
}

/// Body `i` as its shape has it, of which the centre and the body axes (`w, x, y, z`) are known; and the turn from the axes
/// of the shape to those of space.
pub(crate) fn held(
    state: &State,
    i: usize,
    center: Vec3,
    axes: [f64; 4],
) -> (Held, UnitQuaternion<f64>) {
    let (template, axes) = (state.template_of(i), unit(axes));
    let turn = unit(state.orientation[i].quaternion) * axes.inverse();
    let a = axes.to_rotation_matrix().into_inner();
    let own = Matrix3::from_diagonal(&Vec3::from(template.moments()));
    let held = Held {
        mass: template.mass(),
        center,
        inertia: Inertia::from_matrix(&(a * own * a.transpose())),
        scale: 1.0,
        position: state.position[i],
        rotation: [turn.w, turn.i, turn.j, turn.k],
        velocity: state.velocity[i],
        angular_velocity: state.angular_velocity(i),
    };
    (held, turn)
}

impl Breaker {
    /// Refused: templates that do not exist, a limit or window that is not a number above 0.
    pub fn new(setup: Fragmentation, state: &State) -> Result<Breaker> {
        let mut shards = vec![None; state.templates.len()];
        for (k, b) in setup.breakable.iter().enumerate() {
            let Some(shard) = shards.get_mut(b.template as usize) else {
                return Err(Error::IndexOutOfRange(format!(
                    "template {} is to break, of {}",
                    b.template,
                    state.templates.len()
                )));
            };
            let axes = b.body.principal.quaternion;
            *shard =
                Some(Shard { parent: k, region: None, center: b.body.center, axes, generation: 0 });
        }
        let (limit, window) = match setup.threshold {
            Some(Threshold::Impulse { limit, window }) => (limit, window),
            Some(Threshold::Stress { limit }) => (limit, 1.0),
            None => (1.0, 1.0),
        };
        for (what, v) in [("limit", limit), ("window", window)] {
            if !(v.is_finite() && v > 0.0) {
                let v = figure(v);
                return Err(Error::InvalidArgument(format!(
                    "the {what} of fragmentation is {v}, not a number above 0"
                )));
            }
        }
        let n = if setup.threshold.is_some() { state.len() } else { 0 };
        let (load, impulse) = (vec![0.0; n], vec![0.0; n]);
        Ok(Breaker { setup, shards, load, impulse, log: Vec::new(), calls: 0 })
    }

    /// Bodies that break in this step, by their numbers.
    pub fn due(&mut self, state: &State, step: u64, dt: f64) -> Vec<usize> {
        let mut found = Vec::new();
        let at = self.setup.at.iter().filter(|a| a.0 == step);
        found.extend(at.filter_map(|a| state.label.binary_search(&a.1).ok()));
        if let Some(threshold) = self.setup.threshold {
            self.calls += state.len() as u64;
            found.extend((0..state.len()).filter(|&i| {
                let load = self.load[i];
                match threshold {
                    Threshold::Impulse { limit, window } => {
                        let own = &mut self.impulse[i];
                        *own = *own * (-dt / window).exp() + load * dt;
                        *own > limit
                    }
                    Threshold::Stress { limit } => {
                        let r = super::drag::radius(state.template_of(i));
                        load > 2.0 * limit * std::f64::consts::PI * r * r
                    }
                }
            }));
        }
        found.sort_unstable();
        found.dedup();
        let again = |i: &usize| {
            let shard = self.shards.get(state.template[*i] as usize).and_then(|s| s.as_ref());
            shard.is_some_and(|s| s.generation < self.setup.generations) && !state.fixed[*i]
        };
        found.retain(again);
        found
    }

    /// Body `i` in pieces; `hit` is where in space it is hit, and which way.
    pub fn pieces(&self, state: &State, i: usize, hit: Option<(Vec3, Vec3)>) -> Result<Pieces> {
        let missing = || Error::Internal("what breaks is missing".into());
        let shard = self.shards[state.template[i] as usize].as_ref().ok_or_else(missing)?;
        let parent = &self.setup.breakable[shard.parent].parent;
        let (held, turn) = held(state, i, shard.center, shard.axes);
        let cut = match (self.setup.by, hit) {
            (BreakBy::Impact(count), Some((point, direction))) => Cut::Impact {
                point: shard.center + turn.inverse() * (point - state.position[i]),
                direction: turn.inverse() * direction,
                count,
            },
            (BreakBy::Seeded(count) | BreakBy::Impact(count), _) => Cut::Seeded { count },
        };
        let run = Run::serial().with_seed(self.setup.seed ^ state.label[i]);
        let region = shard.region.as_ref();
        let shattered = shatter(parent, region, &held, &cut, &self.setup.options, &run)?;
        let mut fragments = Vec::new();
        for f in &shattered.fragments {
            let m = &f.moving;
            let own = |s: &crate::Sphere| crate::Sphere::new(m.to_body(&s.center, 1.0), s.radius);
            let spheres: Vec<_> = f.clump.spheres.iter().map(own).collect();
            let template = Template::new(&spheres, m.mass, m.principal.moments)?;
            let shard = Shard {
                parent: shard.parent,
                region: Some(f.region.clone()),
                center: m.center,
                axes: m.principal.quaternion,
                generation: shard.generation + 1,
            };
            let placed = Placed {
                template: 0,
                material: state.material[i],
                position: m.position,
                rotation: m.rotation,
                velocity: m.velocity,
                angular_velocity: m.angular_velocity,
                fixed: false,
            };
            fragments.push((Arc::new(template), shard, placed));
        }
        Ok(Pieces { fragments, shattered })
    }

    /// A body has come.
    pub fn add(&mut self) {
        if self.setup.threshold.is_some() {
            self.load.push(0.0);
            self.impulse.push(0.0);
        }
    }

    /// A body has gone.
    pub fn remove(&mut self, i: usize) {
        if self.setup.threshold.is_some() {
            self.load.remove(i);
            self.impulse.remove(i);
        }
    }

    pub fn bytes(&self) -> u64 {
        let own = self.shards.capacity() * size_of::<Option<Shard>>()
            + self.setup.breakable.capacity() * size_of::<Breakable>()
            + self.setup.at.capacity() * 16;
        (own + 8 * (self.load.capacity() + self.impulse.capacity())) as u64
    }
}

/// Mass, momentum, angular momentum about the origin, and kinetic energy of a body that moves so.
pub(crate) fn motion_of(
    mass: f64,
    moments: [f64; 3],
    rotation: [f64; 4],
    (x, v, w): (Vec3, Vec3, Vec3),
) -> (f64, Vec3, Vec3, f64) {
    let r = Orientation::new(rotation).unwrap_or_else(Orientation::identity).matrix();
    let l = r * (r.transpose() * w).component_mul(&Vec3::from(moments));
    (mass, v * mass, l + x.cross(&(v * mass)), 0.5 * (mass * v.norm_squared() + w.dot(&l)))
}
