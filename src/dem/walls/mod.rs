//! Walls: what bodies touch and cannot move.

use crate::dem::effects::motion::WallMotion;
use crate::dem::narrow::{Meeting, Surface};
use crate::dem::state::Kin;
use crate::dem::template::Template;
use crate::dem::tree::Near;
use crate::error::{Error, Result, figure};
use crate::math::Vec3;
use nalgebra::Matrix3;

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

/// A wall in its own frame, whose origin is what it turns about.
#[derive(Debug, Clone)]
pub(crate) struct Wall {
    sides: Sides,
    pub material: u32,
    pub motion: WallMotion,
    pub kin: Kin,
    /// How far any part of it may have moved, and in the last step.
    pub moved: f64,
    pub stride: f64,
    /// Whether it is without end and turns.
    pub turning: bool,
}

/// Planes, each (normal, offset), and a cylinder (point, axis, radius) as the feature after them.
#[derive(Debug, Clone)]
struct Sides {
    planes: Vec<(Vec3, f64)>,
    round: Option<(Vec3, Vec3, f64)>,
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
        let mut sides = Sides { planes: Vec::new(), round: None };
        match &setup.shape {
            WallShape::Plane { normal, offset } => {
                let n = direction("normal", i, normal)?;
                if !offset.is_finite() {
                    return Err(Error::NotFinite(format!("wall {i} has the offset {offset}")));
                }
                sides.planes.push((n, offset - n.dot(&origin)));
            }
            WallShape::Box { lo, hi } => {
                finite("corner", i, lo)?;
                finite("corner", i, hi)?;
                for k in 0..3 {
                    if hi[k] <= lo[k] {
                        return Err(Error::InvalidArgument(format!(
                            "wall {i} is a box from {} to {} along axis {k}",
                            figure(lo[k]),
                            figure(hi[k])
                        )));
                    }
                    let n = Vec3::ith(k, 1.0);
                    sides.planes.push((n, lo[k] - origin[k]));
                    sides.planes.push((-n, origin[k] - hi[k]));
                }
            }
            WallShape::Cylinder { center, axis, radius, length } => {
                finite("centre", i, center)?;
                let axis = direction("axis", i, axis)?;
                for (what, v) in [("radius", Some(*radius)), ("length", *length)] {
                    if let Some(v) = v
                        && !(v.is_finite() && v > 0.0)
                    {
                        let v = figure(v);
                        return Err(Error::InvalidArgument(format!(
                            "wall {i} has a {what} of {v}, not a number above 0"
                        )));
                    }
                }
                let middle = center - origin;
                if let Some(length) = length {
                    for n in [axis, -axis] {
                        sides.planes.push((n, n.dot(&middle) - 0.5 * length));
                    }
                }
                sides.round = Some((middle, axis, *radius));
            }
        }
        let at = Kin {
            x: origin,
            r: Matrix3::identity(),
            v: Vec3::zeros(),
            w: Vec3::zeros(),
            vh: Vec3::zeros(),
            wh: Vec3::zeros(),
        };
        let turning = setup.motion.turns();
        let mut wall = Wall {
            sides,
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

    /// Moves to where it is at `time`, `dt` after the last.
    pub fn to(&mut self, time: f64, dt: f64) {
        if matches!(self.motion, WallMotion::Still) {
            return;
        }
        let before = self.kin.x;
        self.motion.place(time, dt, &mut self.kin);
        self.stride = (self.kin.x - before).norm();
        self.moved += self.stride;
    }

    /// Radius of the narrowest part: spheres must be smaller.
    pub fn narrowest(&self) -> Option<f64> {
        self.sides.round.map(|r| r.2)
    }

    pub fn bytes(&self) -> u64 {
        (size_of::<Wall>() + self.sides.planes.capacity() * 32) as u64
    }
}

impl Surface for Wall {
    fn turns(&self) -> bool {
        self.turning
    }

    fn far(&self, center: &Vec3, radius: f64) -> f64 {
        let planes = self.sides.planes.iter().map(|(n, d)| n.dot(center) - d);
        let mut least = planes.fold(f64::MAX, f64::min);
        if let Some((middle, axis, r)) = &self.sides.round {
            let d = center - middle;
            least = least.min(r - (d - axis * d.dot(axis)).norm());
        }
        least - radius
    }

    fn search(
        &self,
        body: &Template,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<Near>,
    ) {
        let spheres = body.spheres();
        for (a, (n, d)) in self.sides.planes.iter().enumerate() {
            // The plane in the frame of the body.
            let (m, e) = (turn.tr_mul(n), d - n.dot(shift));
            let gap = |c: &Vec3, r: f64| m.dot(c) - e - r;
            body.tree().each(
                stack,
                |c, r| gap(c, r) < reach,
                |b| {
                    let s = &spheres[b as usize];
                    let gap = gap(&s.center, s.radius);
                    if gap < reach {
                        found.push(Near { a: a as u32, b, gap });
                    }
                },
            );
        }
        if let Some((middle, axis, radius)) = &self.sides.round {
            let gap = |c: &Vec3, r: f64| {
                let d = turn * c + shift - middle;
                radius - r - (d - axis * d.dot(axis)).norm()
            };
            body.tree().each(
                stack,
                |c, r| gap(c, r) < reach,
                |b| {
                    let s = &spheres[b as usize];
                    let gap = gap(&s.center, s.radius);
                    if gap < reach {
                        found.push(Near { a: self.sides.planes.len() as u32, b, gap });
                    }
                },
            );
        }
    }

    #[inline(always)]
    fn meet(&self, a: u32, center: &Vec3, radius: f64) -> Option<Meeting> {
        let (normal, distance) = match (self.sides.planes.get(a as usize), &self.sides.round) {
            (Some((n, d)), _) => (*n, n.dot(center) - d),
            (None, Some((middle, axis, r))) => {
                let d = center - middle;
                let out = d - axis * d.dot(axis);
                let rho = out.norm();
                // On the axis nothing is near: any direction serves.
                (if rho > 0.0 { out / -rho } else { Vec3::zeros() }, r - rho)
            }
            (None, None) => return None,
        };
        let gap = distance - radius;
        Some(Meeting { normal, gap, radius, point: center - normal * (radius + 0.5 * gap) })
    }
}
