//! Walls: what bodies touch and cannot move.

mod mesh;
mod sides;

use super::effects::motion::WallMotion;
use super::narrow::{Meeting, Surface};
use super::state::Kin;
use super::template::Template;
use super::tree::Near;
use crate::error::{Error, Result};
use crate::math::Vec3;
use mesh::Mesh;
use nalgebra::Matrix3;
use sides::Sides;
use std::sync::Arc;

/// The shape of a wall, in space at the start.
#[derive(Debug, Clone, PartialEq)]
pub enum WallShape {
    /// The half-space behind a plane: bodies are where n·x > offset.
    Plane {
        /// Towards the bodies, any length but 0.
        normal: Vec3,
        /// n̂·x of its points.
        offset: f64,
    },
    /// A box around the bodies: its six sides.
    Box {
        /// Least corner.
        lo: Vec3,
        /// Greatest corner.
        hi: Vec3,
    },
    /// A cylinder around the bodies; with `length` a drum, closed at both ends.
    Cylinder {
        /// A point of the axis; the middle, where it has a length.
        center: Vec3,
        /// Along the axis, any length but 0.
        axis: Vec3,
        /// Radius.
        radius: f64,
        /// Length between its ends; `None`: without ends.
        length: Option<f64>,
    },
    /// Triangles, touched on both sides, in faces, edges and corners, each place once. A sphere whose centre has come
    /// through is driven out on the other side.
    Mesh {
        /// Vertices.
        vertices: Vec<Vec3>,
        /// Three of them for each triangle.
        triangles: Vec<[u32; 3]>,
    },
}

/// A wall as a scene names it.
#[derive(Debug, Clone, PartialEq)]
pub struct WallSetup {
    /// Its shape.
    pub shape: WallShape,
    /// The number of its material.
    pub material: u32,
    /// How it moves.
    pub motion: WallMotion,
}

impl WallSetup {
    /// A wall of material 0 that stays.
    pub fn still(shape: WallShape) -> WallSetup {
        WallSetup { shape, material: 0, motion: WallMotion::Still }
    }
}

/// A wall in its own frame, whose origin is what it turns about.
#[derive(Debug, Clone)]
pub(crate) struct Wall {
    form: Form,
    pub material: u32,
    pub motion: WallMotion,
    pub kin: Kin,
    /// How far any part of it may have moved, and in the last step.
    pub moved: f64,
    pub stride: f64,
    /// Whether it is without end and turns.
    pub turning: bool,
}

#[derive(Debug, Clone)]
enum Form {
    Sides(Sides),
    Mesh(Arc<Mesh>),
}

fn finite(what: &str, i: usize, v: &Vec3) -> Result<()> {
    if v.iter().all(|c| c.is_finite()) {
        return Ok(());
    }
    Err(Error::NotFinite(format!("wall {i} has the {what} ({}, {}, {})", v.x, v.y, v.z)))
}

fn direction(what: &str, i: usize, v: &Vec3) -> Result<Vec3> {
    finite(what, i, v)?;
    let most = v.amax();
    if most <= 0.0 {
        return Err(Error::InvalidArgument(format!("wall {i} has the {what} (0, 0, 0)")));
    }
    Ok((v / most).normalize())
}

impl Wall {
    /// Checks wall number `i`.
    pub fn new(setup: &WallSetup, i: usize) -> Result<Wall> {
        setup.motion.check(i)?;
        let origin = setup.motion.origin();
        let form = match &setup.shape {
            WallShape::Mesh { vertices, triangles } => {
                Form::Mesh(Arc::new(Mesh::new(vertices, triangles, &origin, i)?))
            }
            shape => Form::Sides(Sides::new(shape, &origin, i)?),
        };
        let at = Kin {
            x: origin,
            r: Matrix3::identity(),
            v: Vec3::zeros(),
            w: Vec3::zeros(),
            vh: Vec3::zeros(),
            wh: Vec3::zeros(),
        };
        let turning = setup.motion.turns() && matches!(form, Form::Sides(_));
        let mut wall = Wall {
            form,
            material: setup.material,
            motion: setup.motion.clone(),
            kin: at,
            moved: 0.0,
            stride: 0.0,
            turning,
        };
        wall.to(0.0, 0.0);
        Ok(wall)
    }

    /// Whether it moves.
    pub fn moves(&self) -> bool {
        !matches!(self.motion, WallMotion::Still)
    }

    /// Moves to where it is at `time`, `dt` after the last; `false` for a wall that stays.
    pub fn to(&mut self, time: f64, dt: f64) -> bool {
        if !self.moves() {
            return false;
        }
        let (before, turn) = (self.kin.x, self.kin.r);
        self.motion.place(time, dt, &mut self.kin);
        let mut stride = (self.kin.x - before).norm();
        if let Form::Mesh(mesh) = &self.form {
            stride += (self.kin.r - turn).norm() * std::f64::consts::FRAC_1_SQRT_2 * mesh.reach();
        }
        self.stride = stride * (1.0 + 1e-12);
        self.moved += self.stride;
        true
    }

    /// Radius of the narrowest part: spheres must be smaller.
    pub fn narrowest(&self) -> Option<f64> {
        match &self.form {
            Form::Sides(s) => s.narrowest(),
            Form::Mesh(_) => None,
        }
    }

    pub fn bytes(&self) -> u64 {
        size_of::<Wall>() as u64
            + match &self.form {
                Form::Sides(s) => s.bytes(),
                Form::Mesh(m) => m.bytes(),
            }
    }
}

impl Surface for Wall {
    fn turns(&self) -> bool {
        self.turning
    }

    fn parts(&self) -> bool {
        matches!(self.form, Form::Mesh(_))
    }

    fn far(&self, center: &Vec3, radius: f64) -> f64 {
        match &self.form {
            Form::Sides(s) => s.far(center, radius),
            Form::Mesh(m) => m.far(center, radius),
        }
    }

    fn search(
        &self,
        body: &Template,
        place: (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<Near>,
    ) -> u64 {
        match &self.form {
            Form::Sides(s) => s.search(body, place, reach, stack, found),
            Form::Mesh(m) => m.search(body, place, reach, stack, found),
        }
    }

    fn gap(&self, a: u32, center: &Vec3, radius: f64) -> f64 {
        match &self.form {
            Form::Sides(s) => s.gap(a, center, radius),
            Form::Mesh(m) => m.gap(a, center, radius),
        }
    }

    #[inline(always)]
    fn meet(&self, a: u32, center: &Vec3, radius: f64) -> Option<Meeting> {
        match &self.form {
            Form::Sides(s) => s.meet(a, center, radius),
            Form::Mesh(m) => m.meet(a, center, radius),
        }
    }
}
