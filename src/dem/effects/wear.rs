//! Bodies that wear: from time to time a flat is cut off a side, what is cut off is dust, and what is left gets new
//! spheres in place. Nothing breaks: the body keeps its label, and its motion is handed over as at a break.

use super::fragmentation::{Energies, Touching, held, unit};
use crate::dem::state::State;
use crate::dem::template::Template;
use crate::error::{Error, Result, figure, push, reserve};
use crate::fragment::{
    Cut, CutOptions, Held, Moving, ReclumpOptions, ShatterOptions, cut, reshape,
};
use crate::generate::HalfSpace;
use crate::mass::Body;
use crate::math::{Moments, Sphere, Vec3};
use crate::run::Run;
use crate::solid::Solid;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// One body that wears.
#[derive(Clone)]
pub struct Wear {
    /// Its label.
    pub label: u64,
    /// The shape that its template stands for.
    pub solid: Arc<Solid>,
    /// The body in the frame of the shape, from which the template was made.
    pub body: Body,
    /// Steps between two flats.
    pub every: u64,
    /// How many flats.
    pub times: u32,
    /// How deep a flat is, from the outermost point of the spheres.
    pub depth: f64,
    /// The side that wears, in space as the body lies then; of any length but 0.
    pub direction: Vec3,
    /// The spheres of what is left; its quality is always asked for.
    pub reclump: ReclumpOptions,
}

/// One flat. What is before is of all bodies, what is after too, dust included.
#[derive(Debug, Clone, PartialEq)]
pub struct WearRecord {
    /// At which step.
    pub step: u64,
    /// Which body.
    pub label: u64,
    /// Its spheres now.
    pub spheres: usize,
    /// Its mass now.
    pub mass: f64,
    /// Mass of the dust, which is taken away.
    pub dust: f64,
    /// Share of the shape that the spheres cover; none reaches beyond it.
    pub coverage: f64,
    /// Errors of mass, momentum and angular momentum (about the origin) of body and dust, relative; 0 where nothing moves.
    pub errors: [f64; 3],
    /// Energies before.
    pub before: Energies,
    /// Energies after, those of the dust among them.
    pub after: Energies,
    /// Its contacts before and after.
    pub around: [Touching; 2],
}

impl WearRecord {
    /// Mismatch D of spheres that stay within the shape: 1 − 2 c/(1 + c) with the coverage c.
    pub fn mismatch(&self) -> f64 {
        (1.0 - self.coverage) / (1.0 + self.coverage)
    }
}

/// What is left of a shape, and where its body stands in the frame of the shape.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Worn {
    /// Normals and offsets of the flats.
    flats: Vec<[f64; 4]>,
    center: Vec3,
    /// Body axes, `w, x, y, z`.
    axes: [f64; 4],
    /// The template that is its own, once it has one.
    pub own: Option<u32>,
    done: u32,
}

/// What wears in a run.
pub(crate) struct Wearer {
    pub setup: Vec<Wear>,
    pub worn: Vec<Worn>,
    pub log: Vec<WearRecord>,
    pub calls: u64,
}

/// A body after a flat.
pub(crate) struct Flat {
    pub template: Arc<Template>,
    pub moving: Moving,
    pub coverage: f64,
    pub dust: Vec<Moving>,
}

fn space(f: &[f64; 4]) -> HalfSpace {
    HalfSpace { normal: Vec3::new(f[0], f[1], f[2]), offset: f[3] }
}

impl Wearer {
    /// Refused: bodies that are not there, intervals and counts of 0, depths that are not numbers above 0, directions of 0.
    pub fn new(setup: Vec<Wear>, state: &State) -> Result<Wearer> {
        let mut worn = reserve("bodies that wear", setup.len())?;
        for (k, w) in setup.iter().enumerate() {
            let bad = |what: String| Err(Error::InvalidArgument(format!("wear {k} {what}")));
            if state.label.binary_search(&w.label).is_err() {
                return bad(format!("is of the body {}, which is not there", w.label));
            }
            if w.every == 0 || w.times == 0 {
                return bad(format!("comes {} times, every {} steps", w.times, w.every));
            }
            if !(w.depth.is_finite() && w.depth > 0.0) {
                let depth = figure(w.depth);
                return bad(format!("has the depth {depth}, not a number above 0"));
            }
            let d = &w.direction;
            if !(d.iter().all(|c| c.is_finite()) && d.amax() > 0.0) {
                return bad(format!("has the direction ({}, {}, {})", d.x, d.y, d.z));
            }
            let (center, axes) = (w.body.center, w.body.principal.quaternion);
            worn.push(Worn { flats: Vec::new(), center, axes, own: None, done: 0 });
        }
        Ok(Wearer { setup, worn, log: Vec::new(), calls: 0 })
    }

    /// Those that are due in this step: their numbers here, and those of their bodies.
    pub fn due(&mut self, state: &State, step: u64) -> Vec<(usize, usize)> {
        self.calls += 1;
        let all = self.setup.iter().zip(&self.worn).enumerate();
        let due = all.filter(|(_, (w, now))| step.is_multiple_of(w.every) && now.done < w.times);
        due.filter_map(|(k, (w, _))| Some((k, state.label.binary_search(&w.label).ok()?))).collect()
    }

    /// Cuts the next flat off body `i`; `None` where that leaves nothing or would break it, which ends it.
    pub fn flat(&mut self, k: usize, state: &State, i: usize, run: &Run) -> Result<Option<Flat>> {
        let missing = || Error::Internal("what wears is missing".into());
        let (wear, worn) = self.setup.get(k).zip(self.worn.get_mut(k)).ok_or_else(missing)?;
        worn.done += 1;
        let template = state.template_of(i);
        let (held, turn) = held(state, i, worn.center, worn.axes);
        let axes = unit(worn.axes);
        let spheres = template.spheres().iter();
        let old: Vec<Sphere> =
            spheres.map(|s| Sphere::new(worn.center + axes * s.center, s.radius)).collect();
        let normal = turn.inverse() * (wear.direction / wear.direction.amax()).normalize();
        let reach = old.iter().map(|s| normal.dot(&s.center) + s.radius).fold(f64::MIN, f64::max);
        let offset = reach - wear.depth;
        let mut left: Vec<HalfSpace> = worn.flats.iter().map(space).collect();
        let mut off = left.clone();
        push("flats", &mut left, HalfSpace { normal, offset })?;
        push("flats", &mut off, HalfSpace { normal: -normal, offset: -offset })?;
        let options = CutOptions::default();
        let cut_to = |by: &[HalfSpace]| cut(&wear.solid, &Cut::Within(by.to_vec()), &options, run);
        let (kept, gone) = (cut_to(&left)?, cut_to(&off)?);
        let frame = wear.solid.frame();
        let [region] = &kept.regions[..] else {
            worn.done = wear.times;
            return Ok(None);
        };
        let mut moments: Vec<Moments> = vec![region.moments(frame)];
        for m in gone
            .regions
            .iter()
            .map(|r| r.moments(frame))
            .chain(gone.dust.iter().chain(&kept.dust).map(|d| d.moments))
        {
            push("dust", &mut moments, m)?;
        }
        let over = held.hand_over(&moments, frame.noise())?;
        let (rest, dust) = over.pieces.split_first().ok_or_else(missing)?;
        let rest = Held {
            mass: rest.mass,
            center: rest.center,
            inertia: rest.inertia,
            position: rest.position,
            velocity: rest.velocity,
            angular_velocity: rest.angular_velocity,
            ..held
        };
        let reclump = ReclumpOptions { quality: true, ..wear.reclump.clone() };
        let options = ShatterOptions { reclump, ..ShatterOptions::default() };
        let solid = wear.solid.clone();
        let by = Cut::Within(left);
        let found = match reshape(solid, &old, &rest, &by, &options, run) {
            Ok((_, found)) => found,
            Err(Error::NoSpheres(_)) => {
                worn.done = wear.times;
                return Ok(None);
            }
            Err(e) => return Err(e),
        };
        let fragment = found.fragments.first().ok_or_else(missing)?;
        let m = &fragment.moving;
        let body = |s: &Sphere| Sphere::new(m.to_body(&s.center, 1.0), s.radius);
        let spheres: Vec<Sphere> = fragment.clump.spheres.iter().map(body).collect();
        let template = Arc::new(Template::new(&spheres, m.mass, m.principal.moments)?);
        push("flats", &mut worn.flats, [normal.x, normal.y, normal.z, offset])?;
        (worn.center, worn.axes) = (m.center, m.principal.quaternion);
        let coverage = fragment.clump.coverage;
        Ok(Some(Flat { template, moving: *m, coverage, dust: dust.to_vec() }))
    }

    pub fn bytes(&self) -> u64 {
        let flats: usize = self.worn.iter().map(|w| w.flats.capacity() * 32).sum();
        let own =
            self.setup.capacity() * size_of::<Wear>() + self.worn.capacity() * size_of::<Worn>();
        (flats + own) as u64
    }
}
