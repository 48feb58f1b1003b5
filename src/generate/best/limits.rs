//! What spheres keep within: half-spaces, a distance beyond the surface, radii. While a clump is
//! looked for by the field in single precision, at its end exactly.

use super::options::{BestOptions, HalfSpace};
use super::refine::Radii;
use crate::error::{Result, reserve};
use crate::generate::ball::Ball;
use crate::generate::balls::Plane;
use crate::generate::balls::exposed::Normal;
use crate::generate::balls::field::Field;
use crate::math::{Sphere, UnitFrame, Vec3};
use crate::run::Run;
use crate::solid::Solid;
use crate::solid::nearest::Surface;

/// Rounds of projections on one limit after the other.
const ROUNDS: usize = 4;
/// Stiffness of a limit in the normal equations, of their trace.
const STIFF: f64 = 1e4;
/// Steps by which a sphere that is too small for its place is moved at the end.
const STEPS: usize = 24;
/// Cells from the surface from which on the field tells inside from outside in a search.
const SURE: f32 = 0.3;
/// Beyond so many sizes a plane says nothing more.
const FAR: f64 = 1e6;

/// The half-spaces asked for.
pub(super) fn planes(options: &BestOptions, frame: &UnitFrame) -> Vec<Plane> {
    options.half_spaces.iter().map(|h| h.plane(frame)).collect()
}

/// What balls keep within while the clump is looked for.
#[derive(Clone, Default)]
pub(super) struct Limits<'a> {
    planes: Vec<([f32; 3], f32)>,
    /// How far beyond the surface. The exact distance: the field is less deep than the body where
    /// medial balls have their centres, by up to half a cell.
    protrusion: Option<(f32, &'a Surface)>,
}

impl<'a> Limits<'a> {
    /// `protrusion`: in the unit frame, if any.
    pub(super) fn new(planes: &[Plane], protrusion: Option<(f64, &'a Surface)>) -> Limits<'a> {
        let single = |p: &Plane| ([0, 1, 2].map(|a| p.normal[a] as f32), p.offset as f32);
        Limits {
            planes: planes.iter().map(single).collect(),
            protrusion: protrusion.map(|(most, surface)| (most.min(FAR) as f32, surface)),
        }
    }

    /// Whether there are any.
    pub(super) fn none(&self) -> bool {
        self.planes.is_empty() && self.protrusion.is_none()
    }

    /// Calls `f` for each limit with its number, the slope of the excess by the centre (that by
    /// the radius is 1), and the excess; `f` may change the ball.
    fn each(&self, field: &Field, ball: &mut Ball, mut f: impl FnMut(&mut Ball, [f32; 3], f32)) {
        for (normal, offset) in &self.planes {
            let [x, y, z] = ball.center;
            let at = normal[0] * x + normal[1] * y + normal[2] * z;
            f(ball, *normal, at + ball.radius - offset);
        }
        if let Some((most, surface)) = self.protrusion {
            let p = Vec3::from(ball.center.map(f64::from));
            // The field is right to a part of a cell, and near the surface to a tenth.
            let rough = field.one(ball.center);
            let about = f64::from(rough.abs() + field.cell());
            let nearest = surface.nearest_within(&p, about).unwrap_or_else(|| surface.nearest(&p));
            let sure = rough.abs() > SURE * field.cell();
            let inside = if sure { rough < 0.0 } else { surface.contains(&p) };
            let sign = if inside { -1.0 } else { 1.0 };
            let way = p - nearest.point;
            let norm = way.norm();
            let slope = if norm > 0.0 { way * (sign / norm) } else { nearest.normal };
            // No point of the ball is farther beyond the surface than its centre is, and a radius.
            let excess = (sign * nearest.distance) as f32 + ball.radius - most;
            f(ball, [0, 1, 2].map(|a| slope[a] as f32), excess);
        }
    }

    /// By how much a ball reaches too far.
    pub(super) fn excess(&self, field: &Field, ball: &Ball) -> f32 {
        let mut most = 0.0f32;
        self.each(field, &mut { *ball }, |_, _, e| most = most.max(e));
        most
    }

    /// By how much a ball may grow.
    pub(super) fn room(&self, field: &Field, ball: &Ball) -> f32 {
        let mut room = f32::MAX;
        self.each(field, &mut { *ball }, |_, _, e| room = room.min(-e));
        room.max(0.0)
    }

    /// Puts a ball that reaches too far where it does not: by equal parts the centre moves and the
    /// radius falls.
    pub(super) fn hold(&self, field: &Field, radii: &Radii, ball: &mut Ball) {
        for _ in 0..ROUNDS {
            let mut held = true;
            self.each(field, ball, |ball, slope, excess| {
                if excess <= 0.0 {
                    return;
                }
                held = false;
                let steep = slope.iter().map(|s| s * s).sum::<f32>();
                let radius = (ball.radius - excess / (1.0 + steep)).max(radii.least);
                let by = (excess + radius - ball.radius) / steep.max(0.1);
                ball.radius = radius;
                for (x, s) in ball.center.iter_mut().zip(slope) {
                    *x -= by * s;
                }
            });
            if held {
                return;
            }
        }
        ball.radius = (ball.radius - self.excess(field, ball)).max(radii.least);
    }

    /// The step by the normal equations that leads beyond no limit, to first order; `solve` has the
    /// free one.
    pub(super) fn step(
        &self,
        field: &Field,
        ball: &Ball,
        normal: &mut Normal,
        solve: impl Fn(&Normal) -> [f64; 4],
    ) -> [f64; 4] {
        let mut step = solve(normal);
        let trace = normal.m[0] + normal.m[4] + normal.m[7] + normal.m[9];
        let stiff = STIFF * trace.max(1.0);
        // A limit that the free step would break is made stiff, and perhaps one more by this.
        let mut done = 0u64;
        for _ in 0..2 {
            let mut k = 0;
            let mut more = false;
            self.each(field, &mut { *ball }, |_, [x, y, z], excess| {
                let (row, excess) = ([x, y, z, 1.0].map(f64::from), f64::from(excess));
                let mark = 1u64 << (k % 64);
                k += 1;
                let after = excess + row.iter().zip(&step).map(|(a, b)| a * b).sum::<f64>();
                if after <= 0.0 || done & mark != 0 {
                    return;
                }
                done |= mark;
                more = true;
                stiffen(normal, &row, excess, stiff);
            });
            if !more {
                break;
            }
            step = solve(normal);
        }
        step
    }
}

/// Adds a stiff equation, row · step = −excess.
fn stiffen(normal: &mut Normal, row: &[f64; 4], excess: f64, stiff: f64) {
    let mut upper = normal.m.iter_mut();
    for i in 0..4 {
        for (x, m) in row[i..].iter().zip(&mut upper) {
            *m += stiff * row[i] * x;
        }
        normal.b[i] -= stiff * excess * row[i];
    }
}

/// The greatest x with `at + x ≤ most`, or a few roundings less.
fn below(most: f64, at: f64) -> f64 {
    let mut x = most - at;
    while at + x > most {
        x -= f64::EPSILON * (at.abs() + most.abs());
    }
    x
}

/// What spheres keep within at the end: exactly, as the caller gets them.
pub(super) struct Exact<'a> {
    frame: UnitFrame,
    planes: Vec<(Vec3, f64)>,
    /// Unit frame.
    protrusion: Option<(f64, &'a Surface)>,
    /// 0: any.
    most: f64,
    /// That of the caller, and the least that is kept.
    asked: f64,
    least: f64,
}

impl<'a> Exact<'a> {
    /// `asked` is the least radius that the caller wants, `least` one that makes sense.
    pub(super) fn new(
        solid: &'a Solid,
        options: &BestOptions,
        [asked, least]: [f64; 2],
        run: &Run,
    ) -> Result<Exact<'a>> {
        let frame = *solid.frame();
        let protrusion = if options.max_protrusion > 0.0 {
            // Within methods the body has a unit of its own, and corners rounded once more.
            let rounding = 8.0 * f64::EPSILON;
            Some((options.max_protrusion / frame.scale - rounding, solid.surface(run)?))
        } else {
            None
        };
        let mut planes = reserve("half-spaces", options.half_spaces.len())?;
        planes.extend(options.half_spaces.iter().map(HalfSpace::unit));
        let least = least.max(asked);
        Ok(Exact { frame, planes, protrusion, most: options.max_radius, asked, least })
    }

    /// Whether there are any.
    pub(super) fn none(&self) -> bool {
        self.planes.is_empty() && self.protrusion.is_none() && [self.most, self.asked] == [0.0; 2]
    }

    /// The greatest radius that a sphere about `center` may have, where none is too large; less
    /// than 0 where it may have none. And the way in which it grows.
    fn room(&self, center: &Vec3) -> (f64, Vec3) {
        let mut room = (if self.most > 0.0 { self.most } else { f64::MAX }, Vec3::zeros());
        let mut lower = |radius: f64, way: &dyn Fn() -> Vec3| {
            if radius < room.0 {
                room = (radius, way());
            }
        };
        for (normal, offset) in &self.planes {
            let at = normal.dot(center);
            lower(below(*offset, at), &|| -normal);
        }
        if let Some((most, surface)) = self.protrusion {
            let p = self.frame.to_unit(center);
            let (nearest, inside) = (surface.nearest(&p), surface.contains(&p));
            let signed = if inside { -nearest.distance } else { nearest.distance };
            let way = || {
                let way = if inside { p - nearest.point } else { nearest.point - p };
                let norm = way.norm();
                let way = if norm > 0.0 { way / norm } else { -nearest.normal };
                self.frame.direction_to_input(&way)
            };
            lower(below(most, signed) * self.frame.scale, &way);
        }
        room
    }

    /// The greatest radius about `center`.
    pub(super) fn greatest(&self, center: &Vec3) -> f64 {
        self.room(center).0
    }

    /// A sphere within the limits, moved where its place has too little room; none where that does
    /// not help.
    pub(super) fn hold(&self, sphere: &Sphere) -> Option<Sphere> {
        let mut center = sphere.center;
        for _ in 0..STEPS {
            let (room, way) = self.room(&center);
            if room >= self.least {
                return Some(Sphere::new(center, sphere.radius.max(self.asked).min(room)));
            }
            center += way * (1.01 * (self.least - room));
        }
        None
    }

    /// The least radius that is kept.
    pub(super) fn least(&self) -> f64 {
        self.least
    }
}

#[cfg(test)]
#[path = "limits_tests.rs"]
mod tests;
