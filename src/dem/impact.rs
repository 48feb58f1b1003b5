//! One body thrown at a plane, once, in a pose: what shape does to a rebound, and nothing else.

use super::contact::{DampingLaw, NormalLaw};
use super::effects::Coefficients;
use super::effects::damping::restitution;
use super::engine::{Engine, Setup};
use super::state::{Placed, State};
use super::template::Template;
use super::walls::WallShape;
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::run::Run;
use nalgebra::{Quaternion, UnitQuaternion};
use std::f64::consts::PI;
use std::sync::Arc;

/// A body, a plane and a velocity, to be thrown in many poses.
#[derive(Debug, Clone)]
pub struct Throw {
    pub(super) setup: Setup,
    pub(super) template: Arc<Template>,
    pub(super) velocity: Vec3,
    pub(super) normal: Vec3,
    offset: f64,
    material: u32,
    /// Steps that a contact of the whole mass would last.
    pub(super) lasting: u64,
}

/// A body after the blow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct After {
    /// Velocity of the centre.
    pub velocity: Vec3,
    /// Angular velocity, along the axes of space.
    pub angular_velocity: Vec3,
    /// The most spheres that touched in one step.
    pub most: u64,
    /// Steps.
    pub steps: u64,
}

impl Throw {
    /// Laws, coefficients, time step and the plane (the first wall) are those of `setup`.
    ///
    /// Refused: no laws, a first wall that is not a plane, a velocity that does not lead towards it.
    pub fn new(
        setup: &Setup,
        template: Arc<Template>,
        material: u32,
        velocity: Vec3,
    ) -> Result<Throw> {
        let bad = |what: &str| Err(Error::InvalidArgument(what.into()));
        let Some(laws) = setup.laws else { return bad("a body is thrown where nothing touches") };
        let Some(wall) = setup.walls.first() else {
            return bad("a body is thrown where there is no wall");
        };
        let WallShape::Plane { normal, offset } = wall.shape else {
            return bad("a body is thrown at a wall that is not a plane");
        };
        let length = normal.norm();
        if !(length.is_finite() && length > 0.0) {
            return bad("a body is thrown at a plane without a normal");
        }
        // As the engine has it, the offset is along the unit normal.
        let normal = normal / length;
        let speed = -velocity.dot(&normal);
        if !(speed.is_finite() && speed > 0.0) {
            return Err(Error::InvalidArgument(format!(
                "a body is thrown at the plane with ({}, {}, {}), which does not lead there",
                velocity.x, velocity.y, velocity.z
            )));
        }
        let wall = wall.clone();
        let at = wall.material as usize * setup.materials + material as usize;
        let c = setup.coefficients.get(at).copied().unwrap_or_default();
        let time = whole_contact(laws.normal, &c, &template, speed);
        let mut setup = Setup {
            laws: Some(laws),
            materials: setup.materials,
            coefficients: setup.coefficients.clone(),
            gravity: setup.gravity,
            exact_rotation: setup.exact_rotation,
            guard: false,
            ..Setup::free(setup.dt)
        };
        setup.walls = vec![wall];
        let lasting = (time / setup.dt).ceil().min(1e9) as u64 + 1;
        Ok(Throw { setup, template, velocity, normal, offset, material, lasting })
    }

    /// What the two do to each other.
    pub(super) fn coefficients(&self) -> Coefficients {
        let of_wall = self.setup.walls.first().map_or(0, |w| w.material) as usize;
        let at = of_wall * self.setup.materials + self.material as usize;
        self.setup.coefficients.get(at).copied().unwrap_or_default()
    }

    /// The restitution asked.
    pub fn restitution(&self) -> f64 {
        match &self.setup.laws {
            Some(l) if l.damping != DampingLaw::None => {
                let linear = l.normal == NormalLaw::Linear;
                restitution(self.coefficients().damping / if linear { 2.0 } else { 5f64.sqrt() })
            }
            _ => 1.0,
        }
    }

    /// The rotation of a body that is turned by `azimuth` about its third axis, which then is tilted by `tilt` from the
    /// plane's normal.
    pub fn rotation(&self, tilt: f64, azimuth: f64) -> [f64; 4] {
        let ((s, c), (t, d)) = ((0.5 * azimuth).sin_cos(), (0.5 * tilt).sin_cos());
        // About the axis first, then about y.
        let own = UnitQuaternion::new_unchecked(Quaternion::new(d * c, t * s, t * c, d * s));
        let up = UnitQuaternion::rotation_between(&Vec3::z(), &self.normal);
        let turned = match up {
            Some(up) => up * own,
            // The plane looks down.
            None => UnitQuaternion::new_unchecked(Quaternion::new(0.0, 1.0, 0.0, 0.0)) * own,
        };
        [turned.w, turned.i, turned.j, turned.k]
    }

    /// The sphere that meets the plane first, and how far its lowest point is from it with the centre at the origin.
    fn lowest(&self, rotation: [f64; 4]) -> Result<(Vec3, f64)> {
        let mut state = State::new(vec![self.template.clone()]);
        state.add(&Placed { rotation, ..Placed::at(Vec3::zeros()) })?;
        let mut low = (Vec3::zeros(), f64::MAX);
        for (k, s) in self.template.spheres().iter().enumerate() {
            let at = state.sphere_center(0, k);
            let height = at.dot(&self.normal) - s.radius;
            if height < low.1 {
                low = (at, height);
            }
        }
        Ok(low)
    }

    /// One throw. The plane is met once: what is measured is the motion when the last contact has been open for half of
    /// the time that a contact of the whole mass lasts.
    pub fn at(&self, rotation: [f64; 4]) -> Result<After> {
        let (_, low) = self.lowest(rotation)?;
        let start = 0.5 * -self.velocity.dot(&self.normal) * self.setup.dt - low;
        let mut state = State::new(vec![self.template.clone()]);
        state.add(&Placed {
            rotation,
            velocity: self.velocity,
            material: self.material,
            ..Placed::at(self.normal * (self.offset + start))
        })?;
        let mut engine = Engine::new(self.setup.clone(), state)?;
        let run = Run::serial();
        let (mut open, mut contacts, mut most) = (0u64, 0, 0);
        for steps in 0..1000 * self.lasting {
            engine.advance(1, &run)?;
            let now = engine.work().contacts;
            if now > contacts {
                most = most.max(now - contacts);
                (contacts, open) = (now, 0);
            } else {
                open += 1;
            }
            if 2 * open > self.lasting && most > 0 {
                let (velocity, angular_velocity) =
                    (engine.state().velocity[0], engine.state().angular_velocity(0));
                if !velocity.iter().chain(angular_velocity.iter()).all(|v| v.is_finite()) {
                    return Err(Error::NotFinite("a body that was thrown left all numbers".into()));
                }
                return Ok(After { velocity, angular_velocity, most, steps });
            }
            if open > 10 * self.lasting {
                break;
            }
        }
        Err(Error::InvalidArgument("a body that was thrown did not leave the plane".into()))
    }

    /// What a rigid body does after a blow without friction at the lowest point of the lowest sphere alone: where [`Throw::at`]
    /// gives the same, it is the place of that point that tells the clump from its target.
    pub fn rigid(&self, rotation: [f64; 4]) -> Result<After> {
        let mut state = State::new(vec![self.template.clone()]);
        state.add(&Placed { rotation, ..Placed::at(Vec3::zeros()) })?;
        let (arm, _) = self.lowest(rotation)?;
        let r = state.orientation[0].matrix();
        let lever = arm.cross(&self.normal);
        let turn = r * self.template.inverse().component_mul(&r.tr_mul(&lever));
        let felt = 1.0 / (1.0 / self.template.mass() + lever.dot(&turn));
        let impulse = -felt * (1.0 + self.restitution()) * self.velocity.dot(&self.normal);
        Ok(After {
            velocity: self.velocity + self.normal * (impulse / self.template.mass()),
            angular_velocity: turn * impulse,
            most: 1,
            steps: 0,
        })
    }
}

/// How long a contact of the whole mass lasts.
fn whole_contact(law: NormalLaw, c: &Coefficients, t: &Template, speed: f64) -> f64 {
    let stiffness = c.stiffness.max(f64::MIN_POSITIVE);
    match law {
        NormalLaw::Linear => PI * (t.mass() / stiffness).sqrt(),
        NormalLaw::Hertz => {
            let energy = 15.0 / 16.0 * t.mass() * speed * speed;
            let depth = (energy / (stiffness * t.bound().sqrt())).powf(0.4);
            2.94 * depth / speed
        }
    }
}
