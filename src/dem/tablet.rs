//! A biconvex tablet that meets a wall at many tilts (Kodam et al. 2012; Yuan 2019, section 5.1), against
//! the formula of a rigid body.

use super::Coefficients;
use super::contact::{DampingLaw, Laws, NormalLaw};
use super::engine::{Engine, Setup};
use super::materials::{Between, Material};
use super::state::{Placed, State};
use super::template::Template;
use super::walls::{WallSetup, WallShape};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::run::Run;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// The tablet of the paper, in metres and kilograms, and how it meets the wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Tablet {
    /// Radius of the band.
    pub radius: f64,
    /// Height of the band.
    pub band: f64,
    /// Height of each cap.
    pub cap: f64,
    /// Mass.
    pub mass: f64,
    /// Principal moments: two across the axis of the tablet, then along it.
    pub moments: [f64; 3],
    /// Of tablet and wall.
    pub material: Material,
    /// Restitution.
    pub restitution: f64,
    /// Speed.
    pub speed: f64,
    /// Time step.
    pub dt: f64,
    /// Tilts from lying flat, in radians.
    pub tilts: Vec<f64>,
    /// How many turns about the tablet's own axis, evenly spread.
    pub azimuths: u32,
    /// Laws: damping from the contact's mass or the body's, averaging or not; no friction.
    pub laws: Laws,
}

impl Default for Tablet {
    fn default() -> Tablet {
        let degrees = (0..18).map(|k| 5.0 * f64::from(k)).chain([87.5, 90.0]);
        Tablet {
            radius: 5.675e-3,
            band: 4.0e-3,
            cap: 1.23e-3,
            mass: 6.328e-4,
            moments: [6.2298e-9, 6.2298e-9, 9.3943e-9],
            material: Material { young: 2.0 * 1.15e9 * 1.3, poisson: 0.3 },
            restitution: 0.6,
            speed: 1.0,
            dt: 1e-7,
            tilts: degrees.map(f64::to_radians).collect(),
            azimuths: 12,
            laws: Laws { damping: DampingLaw::Contact, ..Laws::elastic(NormalLaw::Hertz) },
        }
    }
}

/// Velocities after one impact, over the speed before: along the approach (−e is a full rebound), and |ω| R.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rebound {
    /// Along the approach.
    pub velocity: f64,
    /// |ω| R_b over the speed.
    pub spin: f64,
}

/// What a clump's impacts are worth.
#[derive(Debug, Clone, PartialEq)]
pub struct TabletResult {
    /// For each tilt what the formula says.
    pub formula: Vec<Rebound>,
    /// For each tilt those of all azimuths.
    pub found: Vec<Vec<Rebound>>,
    /// Root of the mean square of the errors (velocity, spin) over the tilts: mean over the azimuths, and
    /// the worst of them.
    pub rms: [f64; 2],
    /// As above.
    pub worst: [f64; 2],
}

impl Tablet {
    /// The formula (Kodam et al. 2012), its lever put right: h sin θ on the cap, r cos(α + θ) on the edge.
    pub fn formula(&self, tilt: f64) -> Rebound {
        let (b, half, c) = (self.radius, 0.5 * self.band, self.cap);
        let round = (b * b + c * c) / (2.0 * c);
        let lever = if tilt < (b / round).asin() {
            (round - c - half) * tilt.sin()
        } else if tilt >= FRAC_PI_2 - 1e-9 {
            0.0
        } else {
            (b * b + half * half).sqrt() * ((half / b).atan() + tilt).cos()
        };
        let (m, i, e) = (self.mass, self.moments[0], self.restitution);
        let spin = m * (1.0 + e) * lever / (i + m * lever * lever);
        Rebound { velocity: spin * lever - e, spin: spin.abs() * b }
    }

    /// The impacts of a clump (body frame, its third axis the tablet's) with the mass and moments of the tablet.
    ///
    /// The wall is met once: what is measured is the motion when the last contact has been open for half of a time of
    /// contact. Impacts are spread over the run's threads, each on one.
    pub fn impacts(&self, spheres: &[crate::Sphere], run: &Run) -> Result<TabletResult> {
        let template = Arc::new(Template::new(spheres, self.mass, self.moments)?);
        let azimuths = self.azimuths.max(1) as usize;
        let all = run.pool().map(self.tilts.len() * azimuths, |k| {
            let azimuth = TAU * ((k % azimuths) as f64 + 0.25) / azimuths as f64;
            self.impact(&template, self.tilts[k / azimuths], azimuth)
        });
        run.check(1.0, "letting a tablet fall")?;
        let all: Vec<Rebound> = all.into_iter().collect::<Result<_>>()?;
        let found: Vec<Vec<Rebound>> = all.chunks(azimuths).map(<[Rebound]>::to_vec).collect();
        let formula: Vec<Rebound> = self.tilts.iter().map(|t| self.formula(*t)).collect();
        let (mut rms, mut worst) = ([0.0f64; 2], [0.0f64; 2]);
        for a in 0..azimuths {
            let mut squares = [0.0; 2];
            for (row, f) in found.iter().zip(&formula) {
                squares[0] += (row[a].velocity - f.velocity).powi(2);
                squares[1] += (row[a].spin - f.spin).powi(2);
            }
            for k in 0..2 {
                let own = (squares[k] / formula.len().max(1) as f64).sqrt();
                rms[k] += own / azimuths as f64;
                worst[k] = worst[k].max(own);
            }
        }
        Ok(TabletResult { formula, found, rms, worst })
    }

    /// One impact.
    fn impact(&self, template: &Arc<Template>, tilt: f64, azimuth: f64) -> Result<Rebound> {
        // About the axis first, then tilted about y.
        let ((s, c), (t, d)) = ((0.5 * azimuth).sin_cos(), (0.5 * tilt).sin_cos());
        let rotation = [d * c, t * s, t * c, d * s];
        let mut state = State::new(vec![template.clone()]);
        state.add(&Placed { rotation, ..Placed::at(Vec3::zeros()) })?;
        let low = (0..template.spheres().len())
            .map(|k| state.sphere_center(0, k).z - template.spheres()[k].radius)
            .fold(f64::MAX, f64::min);
        let start = 0.5 * self.speed * self.dt - low;
        let velocity = Vec3::new(0.0, 0.0, -self.speed);
        let body = Placed { rotation, velocity, ..Placed::at(Vec3::new(0.0, 0.0, start)) };
        let mut state = State::new(vec![template.clone()]);
        state.add(&body)?;
        let between = Between { restitution: Some(self.restitution), ..Between::default() };
        let c = Coefficients::of(&self.laws, Some([self.material; 2]), &between)?;
        let floor = WallShape::Plane { normal: Vec3::z(), offset: 0.0 };
        let setup = Setup {
            laws: Some(self.laws),
            coefficients: vec![c],
            walls: vec![WallSetup::still(floor)],
            guard: false,
            ..Setup::free(self.dt)
        };
        let mut engine = Engine::new(setup, state)?;
        let run = Run::serial();
        // Hertz: 2.94 δ/v of the whole mass in the middle.
        let depth = (15.0 / 16.0 * self.mass * self.speed.powi(2)
            / (c.stiffness * self.radius.sqrt()))
        .powf(0.4);
        let lasting = (2.94 * depth / self.speed / self.dt).ceil() as u64 + 1;
        let (mut open, mut contacts, mut touched) = (0, 0, false);
        for _ in 0..1000 * lasting {
            engine.advance(1, &run)?;
            let now = engine.work().contacts;
            if now > contacts {
                (contacts, open, touched) = (now, 0, true);
            } else {
                open += 1;
            }
            if open > lasting / 2 && touched {
                let (v, w) = (engine.state().velocity[0], engine.state().angular_velocity(0));
                return Ok(Rebound {
                    velocity: -v.z / self.speed,
                    spin: w.norm() * self.radius / self.speed,
                });
            }
            if open > 10 * lasting {
                break;
            }
        }
        let tilt = tilt.to_degrees();
        Err(Error::InvalidArgument(format!("the tablet tilted by {tilt}° did not leave the wall")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sphere;

    #[test]
    fn the_formula_gives_its_table() {
        let tablet = Tablet::default();
        for (degrees, v, w) in [
            (0.0, -0.600, 0.0),
            (5.0, -0.475, 0.776),
            (15.0, 0.084, 1.432),
            (25.0, 0.444, 1.378),
            (50.0, -0.100, 1.341),
            (70.0, -0.599, 0.057),
            (75.0, -0.566, 0.418),
            (87.5, -0.220, 1.231),
            (90.0, -0.600, 0.0),
        ] {
            let f = tablet.formula(f64::to_radians(degrees));
            assert!((f.velocity - v).abs() < 1e-3 && (f.spin - w).abs() < 1e-3, "{degrees}: {f:?}");
        }
    }

    #[test]
    fn a_ball_with_a_lever_rebounds_as_a_rigid_body_does() {
        // One sphere beside the centre: the lever of its contact is known at every tilt.
        let tablet = Tablet { azimuths: 1, ..Tablet::default() };
        let at = Vec3::new(3e-3, 0.0, 0.0);
        let r = tablet.impacts(&[Sphere::new(at, 4e-3)], &Run::serial()).unwrap();
        for (tilt, found) in tablet.tilts.iter().zip(&r.found) {
            let azimuth = TAU * 0.25;
            // Turned about z by the azimuth, then about y by the tilt: horizontal distance of the contact.
            let p = Vec3::new(azimuth.cos(), azimuth.sin(), 0.0) * 3e-3;
            let p = Vec3::new(p.x * tilt.cos(), p.y, -p.x * tilt.sin());
            // Inertia about the axes across the normal, in the frame of the wall.
            let axis = Vec3::new(tilt.sin(), 0.0, tilt.cos());
            let i = nalgebra::Matrix3::identity() * tablet.moments[0]
                + axis * axis.transpose() * (tablet.moments[2] - tablet.moments[0]);
            let arm = p.cross(&Vec3::z());
            let turn = i.try_inverse().unwrap() * arm;
            let felt = 1.0 / (1.0 / tablet.mass + arm.dot(&turn));
            let impulse = felt * 1.6;
            let v = impulse / tablet.mass - 1.0;
            let w = (turn * impulse).norm() * tablet.radius;
            let f = found[0];
            assert!((f.velocity + v).abs() < 2e-3, "{tilt}: {f:?} {v}");
            assert!((f.spin - w).abs() < 4e-3, "{tilt}: {f:?} {w}");
        }
    }
}
