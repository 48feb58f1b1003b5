//! The bodies: one array for each of their properties.

use super::rotate::Orientation;
use super::small::{mul, tr_mul};
use super::template::Template;
use crate::error::{Error, Result, push};
use crate::math::Vec3;
use nalgebra::Matrix3;
use std::sync::Arc;

/// A body as it is handed in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// The number of its template.
    pub template: u32,
    /// The number of its material.
    pub material: u32,
    /// Where its centre of mass is.
    pub position: Vec3,
    /// Its body axes in space, `w, x, y, z`, any length but 0.
    pub rotation: [f64; 4],
    /// Velocity of the centre.
    pub velocity: Vec3,
    /// Angular velocity, along the axes of space.
    pub angular_velocity: Vec3,
    /// Whether it keeps its velocity whatever pushes it, and does not turn.
    pub fixed: bool,
}

impl Placed {
    /// A body of template 0 and material 0 at rest.
    pub fn at(position: Vec3) -> Placed {
        Placed {
            template: 0,
            material: 0,
            position,
            rotation: [1.0, 0.0, 0.0, 0.0],
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
            fixed: false,
        }
    }
}

/// The bodies, structure of arrays. Vectors are those of the axes of space.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// What the bodies are made of.
    pub templates: Vec<Arc<Template>>,
    /// The template of each body.
    pub template: Vec<u32>,
    /// The material of each body.
    pub material: Vec<u32>,
    /// Centres of mass.
    pub position: Vec<Vec3>,
    /// Velocities of the centres.
    pub velocity: Vec<Vec3>,
    /// Orientations.
    pub orientation: Vec<Orientation>,
    /// Angular momenta about the centres.
    pub momentum: Vec<Vec3>,
    /// Forces.
    pub force: Vec<Vec3>,
    /// Torques about the centres.
    pub torque: Vec<Vec3>,
    /// Bodies that keep their velocity.
    pub fixed: Vec<bool>,
    /// A number for each body that stays with it for ever.
    pub label: Vec<u64>,
    /// The label of the next body.
    pub(crate) next: u64,
    /// How far the centre of any of its spheres may have moved so far: a length of path.
    pub(crate) moved: Vec<f64>,
    /// By how much of it in the last step.
    pub(crate) stride: Vec<f64>,
    /// What contacts need of each body.
    pub(crate) kin: Vec<Kin>,
}

/// A body as contacts see it in this step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kin {
    pub x: Vec3,
    /// Body to space.
    pub r: Matrix3<f64>,
    /// Velocities at the end of the step, as far as the last forces tell.
    pub v: Vec3,
    pub w: Vec3,
    /// Velocities in the middle of the step: what the positions moved by.
    pub vh: Vec3,
    pub wh: Vec3,
}

impl State {
    /// Bodies to be made of these templates.
    pub fn new(templates: Vec<Arc<Template>>) -> State {
        State { templates, ..State::default() }
    }

    /// How many bodies there are.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is no body.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// The template of body `i`.
    pub fn template_of(&self, i: usize) -> &Arc<Template> {
        &self.templates[self.template[i] as usize]
    }

    /// Mass of body `i`.
    pub fn mass(&self, i: usize) -> f64 {
        self.template_of(i).mass()
    }

    /// Adds a body and returns its label. Refused: a template that does not exist, what is not finite,
    /// a rotation of 0.
    pub fn add(&mut self, b: &Placed) -> Result<u64> {
        let i = self.len();
        let Some(template) = self.templates.get(b.template as usize) else {
            return Err(Error::IndexOutOfRange(format!(
                "body {i} has template {} of {}",
                b.template,
                self.templates.len()
            )));
        };
        for (what, v) in [
            ("position", &b.position),
            ("velocity", &b.velocity),
            ("angular velocity", &b.angular_velocity),
        ] {
            if !v.iter().all(|c| c.is_finite()) {
                return Err(Error::NotFinite(format!(
                    "body {i} has the {what} ({}, {}, {})",
                    v.x, v.y, v.z
                )));
            }
        }
        let Some(orientation) = Orientation::new(b.rotation) else {
            let [w, x, y, z] = b.rotation;
            return Err(Error::InvalidArgument(format!(
                "body {i} has the rotation ({w}, {x}, {y}, {z})"
            )));
        };
        let r = orientation.matrix();
        let spin = r.tr_mul(&b.angular_velocity);
        let momentum = r * spin.component_mul(&Vec3::from(template.moments()));
        let what = "bodies";
        push(what, &mut self.template, b.template)?;
        push(what, &mut self.material, b.material)?;
        push(what, &mut self.position, b.position)?;
        push(what, &mut self.velocity, b.velocity)?;
        push(what, &mut self.orientation, orientation)?;
        push(what, &mut self.momentum, if b.fixed { Vec3::zeros() } else { momentum })?;
        push(what, &mut self.force, Vec3::zeros())?;
        push(what, &mut self.torque, Vec3::zeros())?;
        push(what, &mut self.fixed, b.fixed)?;
        push(what, &mut self.moved, 0.0)?;
        push(what, &mut self.stride, 0.0)?;
        let (x, v) = (b.position, b.velocity);
        let w = if b.fixed { Vec3::zeros() } else { b.angular_velocity };
        push(what, &mut self.kin, Kin { x, r, v, w, vh: v, wh: w })?;
        push(what, &mut self.label, self.next)?;
        self.next += 1;
        Ok(self.next - 1)
    }

    /// Takes body `i` away; the later ones move up by one.
    pub(crate) fn remove(&mut self, i: usize) {
        self.template.remove(i);
        self.material.remove(i);
        self.position.remove(i);
        self.velocity.remove(i);
        self.orientation.remove(i);
        self.momentum.remove(i);
        self.force.remove(i);
        self.torque.remove(i);
        self.fixed.remove(i);
        self.label.remove(i);
        self.moved.remove(i);
        self.stride.remove(i);
        self.kin.remove(i);
    }

    /// Angular velocity of body `i`, along the axes of space.
    pub fn angular_velocity(&self, i: usize) -> Vec3 {
        if self.fixed[i] {
            return Vec3::zeros();
        }
        let r = self.orientation[i].matrix();
        mul(&r, &self.template_of(i).inverse().component_mul(&tr_mul(&r, &self.momentum[i])))
    }

    /// The centre of sphere `s` of body `i` (in the order of its template) in space.
    pub fn sphere_center(&self, i: usize, s: usize) -> Vec3 {
        self.position[i] + self.orientation[i].matrix() * self.template_of(i).spheres()[s].center
    }

    /// Sets the velocities of body `i`.
    pub fn set_velocity(&mut self, i: usize, velocity: Vec3, angular_velocity: Vec3) {
        let r = self.orientation[i].matrix();
        let moments = Vec3::from(self.template_of(i).moments());
        self.velocity[i] = velocity;
        if !self.fixed[i] {
            self.momentum[i] = r * moments.component_mul(&r.tr_mul(&angular_velocity));
        }
        self.refresh(i);
    }

    /// Sets place and orientation of body `i`.
    pub(crate) fn refresh(&mut self, i: usize) {
        let (v, w) = (self.velocity[i], self.angular_velocity(i));
        let r = self.orientation[i].matrix();
        self.kin[i] = Kin { x: self.position[i], r, v, w, vh: v, wh: w };
    }

    /// Bytes of the arrays, templates apart.
    pub fn bytes(&self) -> u64 {
        let each = 4 + 4 + 5 * 24 + size_of::<Orientation>() + 1 + 8 + 8 + size_of::<Kin>();
        (self.position.capacity() * each) as u64
    }
}
