//! What meets spheres: the first of a pair, in its own frame.

use crate::dem::small::mul;
use crate::dem::template::Template;
use crate::dem::tree::Near;
use crate::math::Vec3;
use nalgebra::Matrix3;

/// Where two surfaces are nearest: normal from the first to the second, gap, effective radius, place.
pub(crate) struct Meeting {
    pub normal: Vec3,
    pub gap: f64,
    pub radius: f64,
    pub point: Vec3,
}

/// What the first of a pair is, in its own frame.
pub(crate) trait Surface {
    /// Whether it turns so that no length bounds how far its parts move.
    fn turns(&self) -> bool {
        false
    }
    /// Whether a sphere goes from one feature of it to the next as it moves along.
    fn parts(&self) -> bool {
        false
    }
    /// A lower bound of the gap to a ball.
    fn far(&self, center: &Vec3, radius: f64) -> f64;
    /// Finds what of it is nearer than `reach` to which spheres of `body`; returns how much was looked at.
    fn search(
        &self,
        body: &Template,
        place: (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<Near>,
    ) -> u64;
    /// How far feature `a` of it is from a sphere, whoever meets it.
    fn gap(&self, a: u32, center: &Vec3, radius: f64) -> f64;
    /// How feature `a` of it meets a sphere; `None` where another feature does.
    fn meet(&self, a: u32, center: &Vec3, radius: f64) -> Option<Meeting>;
}

impl Surface for Template {
    #[inline]
    fn far(&self, center: &Vec3, radius: f64) -> f64 {
        center.norm() - radius - self.bound()
    }

    fn search(
        &self,
        body: &Template,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<Near>,
    ) -> u64 {
        let (own, other) = (self.spheres(), body.spheres());
        self.tree().pairs(body.tree(), (shift, turn), reach, stack, |p, q| {
            for (t, j) in other[q.clone()].iter().zip(q) {
                let center = mul(turn, &t.center) + shift;
                for (s, i) in own[p.clone()].iter().zip(p.clone()) {
                    let d = (center - s.center).norm_squared();
                    let far = s.radius + t.radius + reach;
                    if d < far * far {
                        let gap = d.sqrt() - s.radius - t.radius;
                        found.push(Near { a: i as u32, b: j as u32, gap });
                    }
                }
            }
        })
    }

    #[inline(always)]
    fn gap(&self, a: u32, center: &Vec3, radius: f64) -> f64 {
        let s = &self.spheres()[a as usize];
        (center - s.center).norm() - (s.radius + radius)
    }

    #[inline(always)]
    fn meet(&self, a: u32, center: &Vec3, radius: f64) -> Option<Meeting> {
        let s = &self.spheres()[a as usize];
        let d = center - s.center;
        let distance = d.norm();
        // Concentric spheres are driven along the line between the bodies' origins.
        let normal = if distance > 0.0 {
            d / distance
        } else {
            -s.center.try_normalize(0.0).unwrap_or(Vec3::z())
        };
        let both = s.radius + radius;
        let gap = distance - both;
        let point = s.center + normal * (s.radius + 0.5 * gap);
        Some(Meeting { normal, gap, radius: s.radius * radius / both, point })
    }
}
