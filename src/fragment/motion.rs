//! What a parent hands over to its fragments: mass, place and velocities, so that nothing is lost.
//!
//! The solver's own body counts, not the solid: fragments and dust take its mass in proportion to
//! their volumes, stand about its centre, and move as one rigid body with its momentum and angular
//! momentum. Where its inertia is the solid's that is v = V + ω × r and ω; where it is not, the
//! pieces take the one ω′ that has its angular momentum: of all motions with both momenta the one
//! of least kinetic energy. The difference is told.

use crate::error::{Error, Result, figure, reserve};
use crate::mass::Body;
use crate::math::{Inertia, Moments, PrincipalFrame, Vec3};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};

/// A rigid body as a solver holds it: the shape in its place, and how it moves.
///
/// A point x of the shape is at `position` + `rotation` (`scale` (x − `center`)). Velocities are
/// those of the world's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Held {
    /// Mass.
    pub mass: f64,
    /// Centre of mass, frame and unit of the shape.
    pub center: Vec3,
    /// Inertia about the centre, along the axes of the shape: mass × length² of the world.
    pub inertia: Inertia,
    /// What lengths of the shape are multiplied by.
    pub scale: f64,
    /// Where the centre is.
    pub position: Vec3,
    /// From the axes of the shape to those of the world: a quaternion `w, x, y, z`, any length but 0.
    pub rotation: [f64; 4],
    /// Velocity of the centre.
    pub velocity: Vec3,
    /// Angular velocity.
    pub angular_velocity: Vec3,
}

/// What a fragment, or a crumb of dust, takes over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moving {
    /// Mass.
    pub mass: f64,
    /// Centre of mass, frame and unit of the shape.
    pub center: Vec3,
    /// Inertia about it, along the axes of the shape: mass × length² of the world.
    pub inertia: Inertia,
    /// Principal moments, and the body axes in the frame of the shape.
    pub principal: PrincipalFrame,
    /// Where the centre is.
    pub position: Vec3,
    /// The body axes in the world, `w, x, y, z`, w ≥ 0.
    pub rotation: [f64; 4],
    /// Velocity of the centre.
    pub velocity: Vec3,
    /// Angular velocity, along the axes of the world.
    pub angular_velocity: Vec3,
}

/// A parent's body among its pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct HandOver {
    /// In the order of the pieces.
    pub pieces: Vec<Moving>,
    /// Kinetic energy of all pieces less that of the parent: rounding where the parent's inertia
    /// is that of its pieces.
    pub energy: f64,
    /// How far the parent's centre lies from that of its pieces, frame and unit of the shape:
    /// by so much all of them are shifted.
    pub shift: Vec3,
    /// The greatest entry of the parent's inertia less that of its pieces, over its greatest.
    pub inertia: f64,
}

/// Below this part of its greatest entry inertia is rounding.
const ROUNDING: f64 = 1e-13;

/// A rotation of any length but 0, `w, x, y, z`.
fn turn_of(rotation: &[f64; 4], whose: &str) -> Result<UnitQuaternion<f64>> {
    let most = rotation.iter().fold(0.0f64, |m, c| m.max(c.abs()));
    if !rotation.iter().all(|c| c.is_finite()) {
        return Err(Error::NotFinite(format!("{whose} rotation is not finite")));
    }
    if most == 0.0 {
        return Err(Error::InvalidArgument(format!("{whose} rotation is 0")));
    }
    let [w, x, y, z] = rotation.map(|c| c / most);
    Ok(UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)))
}

impl Moving {
    /// A point of the shape in the body frame, in the unit of the world.
    pub fn to_body(&self, p: &Vec3, scale: f64) -> Vec3 {
        self.principal.axes.transpose() * (p - self.center) * scale
    }

    /// A point of the shape in the world.
    pub fn to_world(&self, p: &Vec3, scale: f64) -> Vec3 {
        let [w, x, y, z] = self.rotation;
        let turn = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        self.position + turn * self.to_body(p, scale)
    }
}

impl Held {
    /// A body of a shape at rest, in its place times the scale. Refused: a scale that is not above
    /// 0, and sizes beyond the numbers.
    pub fn of_body(body: &Body, scale: f64) -> Result<Held> {
        let volume = scale * scale * scale;
        let inertia = body.inertia.matrix() * (volume * scale * scale);
        let (mass, position) = (body.mass * volume, body.center * scale);
        let finite = inertia.iter().chain(position.iter()).all(|v| v.is_finite());
        if !(scale.is_finite() && scale > 0.0 && mass > 0.0 && mass.is_finite() && finite) {
            return Err(Error::InvalidArgument(format!(
                "scale is {}, and the body's mass {}",
                figure(scale),
                figure(body.mass)
            )));
        }
        Ok(Held {
            mass,
            center: body.center,
            inertia: Inertia::from_matrix(&inertia),
            scale,
            position,
            rotation: [1.0, 0.0, 0.0, 0.0],
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        })
    }

    /// Turns it so that its body axes, `axes` in the frame of the shape, are turned to `rotation`
    /// in the world.
    pub fn turn_to(&mut self, rotation: [f64; 4], axes: [f64; 4]) -> Result<()> {
        let both = turn_of(&rotation, "the body's")? * turn_of(&axes, "the axes'")?.inverse();
        self.rotation = [both.w, both.i, both.j, both.k];
        Ok(())
    }

    fn check(&self) -> Result<UnitQuaternion<f64>> {
        let entries = self.inertia.to_array();
        let all = self.center.iter().chain(&entries).chain(self.position.iter());
        let all = all.chain(&self.rotation).chain(self.velocity.iter());
        let mut all = all.chain(self.angular_velocity.iter()).chain([&self.mass, &self.scale]);
        if let Some(bad) = all.find(|v| !v.is_finite()) {
            return Err(Error::NotFinite(format!("the parent's body holds {bad}")));
        }
        for (name, value) in [("mass", self.mass), ("scale", self.scale)] {
            if value <= 0.0 {
                let value = figure(value);
                return Err(Error::InvalidArgument(format!(
                    "the parent's {name} is {value}, not above 0"
                )));
            }
        }
        for (name, value) in ["xx", "yy", "zz"].into_iter().zip(entries) {
            if value < 0.0 {
                let value = figure(value);
                return Err(Error::InvalidArgument(format!(
                    "the parent's inertia {name} is {value}, below 0"
                )));
            }
        }
        turn_of(&self.rotation, "the parent's")
    }

    /// Hands this body over to its pieces, the moments of which are at unit density in the frame
    /// and unit of the shape. `noise`: how far coordinates are rounded, of the shape's size.
    ///
    /// Mass, momentum and angular momentum of all pieces are those of the parent, to rounding; so
    /// is the kinetic energy where the inertia is. Fails on a value that is not finite, a mass or
    /// a scale that is not above 0, a piece without volume, and no piece.
    pub fn hand_over(&self, pieces: &[Moments], noise: f64) -> Result<HandOver> {
        let turn = self.check()?;
        if pieces.is_empty() {
            return Err(Error::Empty("no piece takes the parent's body over".into()));
        }
        for (i, p) in pieces.iter().enumerate() {
            let mut all = p.centroid.iter().copied().chain(p.inertia.to_array());
            if !(p.volume.is_finite() && all.all(f64::is_finite)) {
                return Err(Error::NotFinite(format!("the moments of piece {i} are not finite")));
            }
            if p.volume <= 0.0 {
                let volume = figure(p.volume);
                return Err(Error::ZeroVolume(format!("piece {i} has a volume of {volume}")));
            }
        }
        let volume: f64 = pieces.iter().map(|p| p.volume).sum();
        // From the first centroid, so that nothing is lost far from the origin; then what
        // rounding leaves.
        let from = pieces[0].centroid;
        let mean = |at: &dyn Fn(&Moments) -> Vec3| {
            pieces.iter().map(|p| at(p) * (p.volume / volume)).sum::<Vec3>()
        };
        let middle = mean(&|p| p.centroid - from);
        let left = mean(&|p| p.centroid - from - middle);
        let shift = self.center - from - middle - left;
        let mut found: Vec<Moving> = reserve("pieces", pieces.len())?;
        let mut whole = Matrix3::zeros();
        // The last takes what rounding leaves of the mass.
        let mut rest = self.mass;
        for (i, p) in pieces.iter().enumerate() {
            let last = i + 1 == pieces.len();
            let mass = if last { rest } else { self.mass * (p.volume / volume) };
            rest -= mass;
            let factor = self.mass / volume * self.scale * self.scale;
            let inertia = Inertia::from_matrix(&(p.inertia.matrix() * factor));
            let at = (p.centroid - from - middle - left) * self.scale;
            whole += inertia.shifted(mass, &at).matrix();
            let principal = PrincipalFrame::of_rounded(&inertia, noise.max(p.relative_error));
            let [w, x, y, z] = principal.quaternion;
            let both = turn * UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
            let sign = if both.w < 0.0 { -1.0 } else { 1.0 };
            found.push(Moving {
                mass,
                center: p.centroid + shift,
                inertia,
                principal,
                position: at,
                rotation: [both.w, both.i, both.j, both.k].map(|c| c * sign + 0.0),
                velocity: self.velocity,
                angular_velocity: Vec3::zeros(),
            });
        }
        if found.iter().any(|m| m.mass <= 0.0 || !m.inertia.xx.is_finite()) {
            return Err(Error::InvalidArgument(format!(
                "the mass {} among {} pieces is beyond the numbers",
                figure(self.mass),
                pieces.len()
            )));
        }
        let spin = turn.inverse() * self.angular_velocity;
        let own = self.inertia.matrix();
        let differs = part_of((own - whole).amax(), own.amax());
        let taken = if differs <= ROUNDING { spin } else { rigid(&whole, &(own * spin), &spin) };
        for m in &mut found {
            m.velocity += turn * taken.cross(&m.position);
            m.angular_velocity = turn * taken;
            m.position = self.position + turn * m.position;
        }
        let energy = 0.5 * (taken.dot(&(whole * taken)) - spin.dot(&(own * spin)));
        Ok(HandOver { pieces: found, energy, shift, inertia: differs })
    }
}

/// `some` over `all`, and the greatest number where that is beyond the numbers: of a body without
/// inertia for instance.
fn part_of(some: f64, all: f64) -> f64 {
    match some * 1e-300 < all {
        true => some / all,
        false if some > 0.0 => f64::MAX,
        false => 0.0,
    }
}

/// The angular velocity at which a body of this inertia has this angular momentum; `else` where
/// it has none about some axis.
fn rigid(inertia: &Matrix3<f64>, momentum: &Vec3, or_else: &Vec3) -> Vec3 {
    // In units of its own, so that nothing under- or overflows.
    let (unit, scale) = (inertia.amax(), momentum.amax());
    if unit <= 0.0 || scale <= 0.0 {
        return if scale <= 0.0 { Vec3::zeros() } else { *or_else };
    }
    let (matrix, wanted) = (inertia / unit, momentum / scale);
    let Some(factors) = matrix.cholesky() else { return *or_else };
    let mut found = factors.solve(&wanted);
    // Once more, for what rounding left.
    found += factors.solve(&(wanted - matrix * found));
    let found = found * (scale / unit);
    if found.iter().all(|v| v.is_finite()) { found } else { *or_else }
}

#[cfg(test)]
#[path = "motion_tests.rs"]
mod tests;
