//! Insertion of bodies in random poses that overlap nothing.

use crate::dem::narrow::Surface;
use crate::dem::random::Random;
use crate::dem::rotate::Orientation;
use crate::dem::state::{Placed, State};
use crate::dem::walls::Wall;
use crate::error::{Error, Result};
use crate::math::Vec3;

/// Where centres may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InsertRegion {
    /// A box.
    Box {
        /// Least corner.
        lo: Vec3,
        /// Greatest corner.
        hi: Vec3,
    },
    /// An upright cylinder.
    Cylinder {
        /// The middle of its lower end.
        center: Vec3,
        /// Radius.
        radius: f64,
        /// Height, along z.
        height: f64,
    },
}

/// Bodies that come while the simulation runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Insertion {
    /// The templates to choose from, each as likely.
    pub templates: Vec<u32>,
    /// Their material.
    pub material: u32,
    /// Where their centres may be.
    pub region: InsertRegion,
    /// Their velocity.
    pub velocity: Vec3,
    /// How many in all.
    pub total: u64,
    /// How many at a time: the least and the most.
    pub batch: [u64; 2],
    /// Steps between two batches.
    pub every: u64,
    /// Poses tried for each body; those that find no room come with the next batch.
    pub attempts: u32,
    /// Of the random poses.
    pub seed: u64,
}

impl Insertion {
    pub(crate) fn check(&self, templates: usize, materials: usize) -> Result<()> {
        if let Some(t) = self.templates.iter().find(|t| **t as usize >= templates) {
            return Err(Error::IndexOutOfRange(format!(
                "the insertion has template {t} of {templates}"
            )));
        }
        if self.material as usize >= materials {
            return Err(Error::IndexOutOfRange(format!(
                "the insertion has material {} of {materials}",
                self.material
            )));
        }
        let [least, most] = self.batch;
        if self.templates.is_empty() || self.every == 0 || least == 0 || most < least {
            return Err(Error::InvalidArgument(format!(
                "an insertion of {least} to {most} of {} templates every {} steps does nothing",
                self.templates.len(),
                self.every
            )));
        }
        let good = match &self.region {
            InsertRegion::Box { lo, hi } => {
                lo.iter().chain(hi).all(|c| c.is_finite()) && (0..3).all(|k| lo[k] <= hi[k])
            }
            InsertRegion::Cylinder { center, radius, height } => {
                center.iter().chain([radius, height]).all(|c| c.is_finite())
                    && *radius >= 0.0
                    && *height >= 0.0
            }
        };
        if !(good && self.velocity.iter().all(|c| c.is_finite())) {
            return Err(Error::InvalidArgument("the region of an insertion is none".into()));
        }
        Ok(())
    }

    /// The bodies of the batch of a step; `inserted` is how many came before.
    pub(crate) fn batch(
        &self,
        inserted: u64,
        step: u64,
        state: &State,
        walls: &[Wall],
    ) -> Vec<Placed> {
        let mut random = Random::of(&[self.seed, inserted, step]);
        let [least, most] = self.batch;
        let wanted = least + random.below((most - least) as usize + 1) as u64;
        let mut found: Vec<Placed> = Vec::new();
        for _ in 0..wanted.min(self.total - inserted.min(self.total)) {
            for _ in 0..self.attempts.max(1) {
                let template = self.templates[random.below(self.templates.len())];
                let position = match &self.region {
                    InsertRegion::Box { lo, hi } => random.within(lo, hi),
                    InsertRegion::Cylinder { center, radius, height } => {
                        let (r, a) = (random.unit().sqrt(), std::f64::consts::TAU * random.unit());
                        let (r, z) = (r * radius, random.unit() * height);
                        center + Vec3::new(r * a.cos(), r * a.sin(), z)
                    }
                };
                let rotation = random.rotation();
                let body = Placed {
                    template,
                    material: self.material,
                    rotation,
                    velocity: self.velocity,
                    ..Placed::at(position)
                };
                if free(&body, &found, state, walls) {
                    found.push(body);
                    break;
                }
            }
        }
        found
    }
}

/// Whether a body overlaps neither bodies nor walls.
pub(crate) fn free(body: &Placed, more: &[Placed], state: &State, walls: &[Wall]) -> bool {
    let template = &state.templates[body.template as usize];
    let Some(own) = Orientation::new(body.rotation).map(|o| o.matrix()) else { return false };
    let (mut stack, mut near) = (Vec::new(), Vec::new());
    for w in walls {
        let (shift, turn) = (w.kin.r.tr_mul(&(body.position - w.kin.x)), w.kin.r.transpose() * own);
        near.clear();
        w.search(template, (&shift, &turn), 0.0, &mut stack, &mut near);
        if !near.is_empty() {
            return false;
        }
    }
    let mut clear = |t: u32, x: &Vec3, r: &nalgebra::Matrix3<f64>| {
        let other = &state.templates[t as usize];
        if (body.position - x).norm() > other.bound() + template.bound() {
            return true;
        }
        let (shift, turn) = (r.tr_mul(&(body.position - x)), r.transpose() * own);
        near.clear();
        other.search(template, (&shift, &turn), 0.0, &mut stack, &mut near);
        near.is_empty()
    };
    (0..state.len()).all(|i| clear(state.template[i], &state.position[i], &state.kin[i].r))
        && more.iter().all(|m| {
            Orientation::new(m.rotation)
                .is_some_and(|o| clear(m.template, &m.position, &o.matrix()))
        })
}
