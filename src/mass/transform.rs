//! One template in many sizes, places and densities, without generating again.

use super::body::Body;
use super::pile::check;
use crate::error::{Error, Result, collected, figure, reserve};
use crate::math::{Inertia, PrincipalFrame, Sphere, Vec3};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// Where a template goes: x becomes `translation` + `rotation` (`scale` x), in whatever frame the
/// template is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// What lengths are multiplied by.
    pub scale: f64,
    /// A rotation as a quaternion `w, x, y, z`; any length but 0.
    pub rotation: [f64; 4],
    /// Where the origin goes.
    pub translation: Vec3,
}

impl Default for Placement {
    /// Where it was.
    fn default() -> Self {
        Placement { scale: 1.0, rotation: [1.0, 0.0, 0.0, 0.0], translation: Vec3::zeros() }
    }
}

impl Placement {
    fn turn(&self) -> Result<UnitQuaternion<f64>> {
        let [w, x, y, z] = self.rotation;
        let all = [self.scale, w, x, y, z];
        if let Some(bad) = all.iter().chain(self.translation.iter()).find(|v| !v.is_finite()) {
            return Err(Error::NotFinite(format!("the placement holds {bad}")));
        }
        if self.scale <= 0.0 {
            let scale = figure(self.scale);
            return Err(Error::InvalidArgument(format!("the scale is {scale}, not above 0")));
        }
        let most = self.rotation.iter().fold(0.0f64, |m, c| m.max(c.abs()));
        if most == 0.0 {
            return Err(Error::InvalidArgument("the quaternion of the rotation is 0".into()));
        }
        let q = self.rotation.map(|c| c / most);
        Ok(UnitQuaternion::new_normalize(Quaternion::new(q[0], q[1], q[2], q[3])))
    }

    /// The spheres there: lengths × scale.
    pub fn spheres(&self, spheres: &[Sphere]) -> Result<Vec<Sphere>> {
        let turn = self.turn()?.to_rotation_matrix();
        let place = |s: &Sphere| {
            let center = turn * (s.center * self.scale) + self.translation;
            Sphere::new(center, s.radius * self.scale)
        };
        let placed = collected("spheres", spheres.iter().map(place))?;
        check(&placed)?;
        Ok(placed)
    }

    /// The masses there, of a body of density `from` made of one of density `to`: × scale³ and
    /// the ratio of the densities.
    pub fn masses(&self, masses: &[f64], from: f64, to: f64) -> Result<Vec<f64>> {
        self.turn()?;
        for density in [from, to] {
            if !(density.is_finite() && density > 0.0) {
                let density = figure(density);
                return Err(Error::InvalidArgument(format!(
                    "the density is {density}, not a number above 0"
                )));
            }
        }
        let factor = self.scale.powi(3) * (to / from);
        let placed: Vec<f64> = collected("masses", masses.iter().map(|m| m * factor))?;
        match placed.iter().position(|m| !m.is_normal() || *m < 0.0) {
            None => Ok(placed),
            Some(i) => Err(Error::InvalidArgument(format!(
                "mass {i} becomes {}: beyond the numbers",
                figure(placed[i])
            ))),
        }
    }

    /// The body there, of another density: mass × scale³, inertia × scale⁵, times the ratio of
    /// the densities. Its axes turn with it; they are not chosen anew.
    pub fn body(&self, body: &Body, density: f64) -> Result<Body> {
        let q = self.turn()?;
        let mass = *self.masses(&[body.mass], body.density, density)?.first().unwrap_or(&0.0);
        let turn: Matrix3<f64> = q.to_rotation_matrix().into_inner();
        let factor = mass / body.mass * self.scale * self.scale;
        let [w, x, y, z] = body.principal.quaternion;
        let both = q * UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        let placed = Body {
            density,
            volume: body.volume * self.scale.powi(3),
            mass,
            center: turn * (body.center * self.scale) + self.translation,
            inertia: Inertia::from_matrix(
                &(turn * body.inertia.matrix() * turn.transpose() * factor),
            ),
            principal: PrincipalFrame {
                moments: body.principal.moments.map(|m| m * factor),
                axes: turn * body.principal.axes,
                quaternion: upright([both.w, both.i, both.j, both.k]),
            },
            relative_error: body.relative_error,
        };
        let all = placed.principal.moments.iter().chain([&placed.volume]);
        if !(all.clone().all(|v| v.is_normal()) && placed.center.iter().all(|v| v.is_finite())) {
            return Err(Error::InvalidArgument(format!(
                "at scale {} the body is beyond the numbers",
                figure(self.scale)
            )));
        }
        Ok(placed)
    }
}

/// The quaternion of the same rotation with w ≥ 0; where w is 0, its first component that is not
/// is positive.
fn upright(q: [f64; 4]) -> [f64; 4] {
    let first = q.iter().find(|c| c.abs() > 0.0);
    let sign = if first.is_some_and(|c| *c < 0.0) { -1.0 } else { 1.0 };
    q.map(|c| c * sign + 0.0)
}

/// `count` rotations, uniform over all of them, as quaternions `w, x, y, z` with w ≥ 0: the same
/// for the same seed, and the first ones the same for any count (Marsaglia 1972; Shoemake 1992).
pub fn random_orientations(seed: u64, count: usize) -> Result<Vec<[f64; 4]>> {
    let mut random = Pcg64::new(u128::from(seed), 0x006f_7269_656e_7473);
    let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
    let mut disc = || loop {
        let (x, y) = (unit(), unit());
        let s = x * x + y * y;
        if s < 1.0 && s > 1e-12 {
            break (x, y, s);
        }
    };
    let mut out = reserve("orientations", count)?;
    for _ in 0..count {
        let ((a, b, s), (c, d, t)) = (disc(), disc());
        let k = ((1.0 - s) / t).sqrt();
        out.push(upright([a, b, c * k, d * k]));
    }
    Ok(out)
}

#[cfg(test)]
#[path = "transform_tests.rs"]
mod tests;
