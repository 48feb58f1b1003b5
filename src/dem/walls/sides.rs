//! Walls of planes and cylinders.

use super::{WallShape, direction, finite};
use crate::dem::narrow::Meeting;
use crate::dem::small::{mul, tr_mul};
use crate::dem::template::Template;
use crate::dem::tree::Near;
use crate::error::{Error, Result, figure};
use crate::math::Vec3;
use nalgebra::Matrix3;

/// Planes, each (normal, offset), and a cylinder (point, axis, radius) as the feature after them, in the frame of
/// the wall.
#[derive(Debug, Clone)]
pub(crate) struct Sides {
    planes: Vec<(Vec3, f64)>,
    round: Option<(Vec3, Vec3, f64)>,
}

impl Sides {
    /// Checks wall number `i`.
    pub fn new(shape: &WallShape, origin: &Vec3, i: usize) -> Result<Sides> {
        let mut sides = Sides { planes: Vec::new(), round: None };
        match shape {
            WallShape::Plane { normal, offset } => {
                let n = direction("normal", i, normal)?;
                if !offset.is_finite() {
                    return Err(Error::NotFinite(format!("wall {i} has the offset {offset}")));
                }
                sides.planes.push((n, offset - n.dot(origin)));
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
            WallShape::Mesh { .. } => {
                return Err(Error::Internal("a mesh among planes".into()));
            }
        }
        Ok(sides)
    }

    /// Radius of the cylinder: spheres must be smaller.
    pub fn narrowest(&self) -> Option<f64> {
        self.round.map(|r| r.2)
    }

    pub fn bytes(&self) -> u64 {
        (self.planes.capacity() * 32) as u64
    }

    pub fn far(&self, center: &Vec3, radius: f64) -> f64 {
        let planes = self.planes.iter().map(|(n, d)| n.dot(center) - d);
        let mut least = planes.fold(f64::MAX, f64::min);
        if let Some((middle, axis, r)) = &self.round {
            let d = center - middle;
            least = least.min(r - (d - axis * d.dot(axis)).norm());
        }
        least - radius
    }

    pub fn search(
        &self,
        body: &Template,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<Near>,
    ) -> u64 {
        let spheres = body.spheres();
        let mut looked = 0;
        let mut each = |a: usize, gap: &dyn Fn(&Vec3, f64) -> f64| {
            looked += body.tree().each(
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
        };
        for (a, (n, d)) in self.planes.iter().enumerate() {
            // The plane in the frame of the body.
            let (m, e) = (tr_mul(turn, n), d - n.dot(shift));
            each(a, &|c, r| m.dot(c) - e - r);
        }
        if let Some((middle, axis, radius)) = &self.round {
            each(self.planes.len(), &|c, r| {
                let d = mul(turn, c) + shift - middle;
                radius - r - (d - axis * d.dot(axis)).norm()
            });
        }
        looked
    }

    /// How far side `a` is from a sphere.
    pub fn gap(&self, a: u32, center: &Vec3, radius: f64) -> f64 {
        self.meet(a, center, radius).map_or(f64::MAX, |m| m.gap)
    }

    #[inline(always)]
    pub fn meet(&self, a: u32, center: &Vec3, radius: f64) -> Option<Meeting> {
        let (normal, distance) = match (self.planes.get(a as usize), &self.round) {
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
