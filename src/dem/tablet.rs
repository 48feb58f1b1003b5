//! A biconvex tablet that meets a wall at many tilts (Kodam et al. 2012; Yuan 2019, section 5.1): the formula of
//! a rigid body, and the tablet itself in the hands of the engine.

use super::contact::{DampingLaw, Law, Motion, Visitor, choose};
use super::effects::Touch;
use super::impact::{After, Throw};
use super::integrate;
use super::state::{Placed, State};
use crate::error::{Error, Result};
use crate::math::Vec3;
use nalgebra::Matrix3;
use std::f64::consts::FRAC_PI_2;

/// Nearer than this to 90° a tablet lies on the line of its band.
const LINE: f64 = 1e-9;

/// A tablet: a band between two spherical caps.
#[derive(Debug, Clone, Copy, PartialEq)]
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
}

impl Default for Tablet {
    /// That of the paper, in metres and kilograms.
    fn default() -> Tablet {
        Tablet {
            radius: 5.675e-3,
            band: 4.0e-3,
            cap: 1.23e-3,
            mass: 6.328e-4,
            moments: [6.2298e-9, 6.2298e-9, 9.3943e-9],
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

impl Tablet {
    /// The radius of a cap's sphere.
    fn round(&self) -> f64 {
        (self.radius * self.radius + self.cap * self.cap) / (2.0 * self.cap)
    }

    /// How far the centre of a cap's sphere is beyond the middle of the tablet.
    fn beyond(&self) -> f64 {
        self.round() - self.cap - 0.5 * self.band
    }

    /// The formula (Kodam et al. 2012), its lever put right: h sin θ on the cap, r cos(α + θ) on the edge.
    pub fn formula(&self, tilt: f64, restitution: f64) -> Rebound {
        let (b, half) = (self.radius, 0.5 * self.band);
        let lever = if tilt < (b / self.round()).asin() {
            self.beyond() * tilt.sin()
        } else if tilt >= FRAC_PI_2 - LINE {
            0.0
        } else {
            (b * b + half * half).sqrt() * ((half / b).atan() + tilt).cos()
        };
        let (m, i) = (self.mass, self.moments[0]);
        let spin = m * (1.0 + restitution) * lever / (i + m * lever * lever);
        Rebound { velocity: spin * lever - restitution, spin: spin.abs() * b }
    }

    /// What became of a throw.
    pub fn rebound(&self, throw: &Throw, after: &After) -> Rebound {
        let speed = -throw.velocity.dot(&throw.normal);
        Rebound {
            velocity: -after.velocity.dot(&throw.normal) / speed,
            spin: after.angular_velocity.norm() * self.radius / speed,
        }
    }

    /// The point of the tablet that is farthest along `down`, from its middle; its third axis is `axis`.
    pub fn farthest(&self, axis: &Vec3, down: &Vec3) -> Vec3 {
        let along = axis.dot(down);
        let end = if along < 0.0 { -axis } else { *axis };
        let across = down - axis * along;
        let sine = across.norm();
        if sine * self.round() < self.radius {
            return down * self.round() - end * self.beyond();
        }
        let rim = across * (self.radius / sine);
        if along.abs() < LINE { rim } else { rim + end * (0.5 * self.band) }
    }

    /// A throw of the tablet itself, with the mass and moments of the body thrown: the same laws and the same steps, one contact
    /// at its farthest point with the effective radius of the band. The floor of what any clump can reach.
    pub fn exact(&self, throw: &Throw, rotation: [f64; 4]) -> Result<After> {
        match &throw.setup.laws {
            Some(laws) => choose(laws, Exact { tablet: self, throw, rotation })?,
            None => Err(Error::InvalidArgument("a tablet is thrown where nothing touches".into())),
        }
    }
}

struct Exact<'a> {
    tablet: &'a Tablet,
    throw: &'a Throw,
    rotation: [f64; 4],
}

impl Visitor for Exact<'_> {
    type Out = Result<After>;

    fn visit<L: Law>(self) -> Result<After> {
        let Exact { tablet, throw, rotation } = self;
        let (n, dt, speed) = (throw.normal, throw.setup.dt, -throw.velocity.dot(&throw.normal));
        let c = throw.coefficients();
        let felt = throw.setup.laws.is_some_and(|l| l.damping == DampingLaw::Contact);
        let mut state = State::new(vec![throw.template.clone()]);
        state.add(&Placed { rotation, velocity: throw.velocity, ..Placed::at(Vec3::zeros()) })?;
        let lowest = |r: &Matrix3<f64>| tablet.farthest(&r.column(2).into_owned(), &-n);
        // Of the plane through the origin.
        let low = lowest(&state.kin[0].r).dot(&n);
        state.position[0] = n * (0.5 * speed * dt - low);
        state.refresh(0);
        let mut memory = vec![0.0; L::WIDTH];
        let mut calls = Default::default();
        let (mut open, mut touched) = (0u64, false);
        for steps in 0..1000 * throw.lasting {
            integrate::drift(&mut state, dt, throw.setup.exact_rotation);
            let kin = state.kin[0];
            let arm = lowest(&kin.r);
            let point = kin.x + arm;
            let (mut force, mut torque) = (Vec3::zeros(), Vec3::zeros());
            let overlap = -point.dot(&n);
            open += 1;
            if overlap > 0.0 {
                let motion = Motion {
                    turn: kin.r,
                    v: kin.v,
                    wa: Vec3::zeros(),
                    wb: kin.w,
                    vh: kin.vh,
                    wah: Vec3::zeros(),
                    wbh: kin.wh,
                    inertia: [Vec3::zeros(), *throw.template.inverse()],
                    inverse_mass: throw.template.inverse_mass(),
                    mass: throw.template.mass(),
                    ease: 1.0,
                };
                let touch = Touch {
                    normal: n,
                    overlap,
                    radius: tablet.radius,
                    arms: [point, arm],
                    velocity: kin.v + kin.w.cross(&arm),
                    coefficients: &c,
                    motion: &motion,
                    dt,
                    step: dt,
                    stride: state.stride[0],
                };
                if let Some(action) = L::act(&touch, felt, &mut memory, &mut calls) {
                    force = action.force;
                    torque = arm.cross(&force) + action.couple;
                }
                (open, touched) = (0, true);
            }
            (state.force[0], state.torque[0]) = (force, torque);
            integrate::kick(&mut state, dt);
            if 2 * open > throw.lasting && touched {
                let (velocity, angular_velocity) = (state.velocity[0], state.angular_velocity(0));
                return Ok(After { velocity, angular_velocity, most: 1, steps });
            }
        }
        Err(Error::InvalidArgument("a tablet that was thrown did not leave the plane".into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sphere;
    use crate::dem::{
        Between, Coefficients, Laws, Material, NormalLaw, Setup, Template, WallSetup, WallShape,
    };
    use std::sync::Arc;

    /// A throw of these spheres with the mass of the tablet at a plane that is not level.
    fn throw(spheres: &[Sphere], damping: DampingLaw) -> Throw {
        let t = Tablet::default();
        let laws = Laws { damping, ..Laws::elastic(NormalLaw::Hertz) };
        let between = Between { restitution: Some(0.6), ..Between::default() };
        let steel = Material { young: 2.0 * 1.15e9 * 1.3, poisson: 0.3 };
        let normal = Vec3::new(0.3, -0.2, 2.0);
        let setup = Setup {
            laws: Some(laws),
            coefficients: vec![Coefficients::of(&laws, Some([steel; 2]), &between).unwrap()],
            walls: vec![WallSetup::still(WallShape::Plane { normal, offset: 0.7 })],
            ..Setup::free(1e-7)
        };
        let template = Arc::new(Template::new(spheres, t.mass, t.moments).unwrap());
        Throw::new(&setup, template, 0, -normal.normalize()).unwrap()
    }

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
            let f = tablet.formula(f64::to_radians(degrees), 0.6);
            assert!((f.velocity - v).abs() < 1e-3 && (f.spin - w).abs() < 1e-3, "{degrees}: {f:?}");
        }
    }

    #[test]
    fn a_ball_with_a_lever_rebounds_as_a_rigid_body_does() {
        // One sphere beside the centre: the lever of its contact is known in every pose.
        let at = Vec3::new(3e-3, 1e-3, 0.0);
        let throw = throw(&[Sphere::new(at, 4e-3)], DampingLaw::Contact);
        assert!((throw.restitution() - 0.6).abs() < 1e-9);
        for k in 0..10 {
            let rotation = throw.rotation(0.17 * k as f64, 0.9 * k as f64);
            let (found, rigid) = (throw.at(rotation).unwrap(), throw.rigid(rotation).unwrap());
            // It turns by up to a degree while it touches.
            assert!((found.velocity - rigid.velocity).norm() < 1e-2, "{k}: {found:?} {rigid:?}");
            let spin = found.angular_velocity - rigid.angular_velocity;
            assert!(spin.norm() * 5.675e-3 < 2e-2, "{k}: {found:?} {rigid:?}");
            assert_eq!(found.most, 1);
        }
    }

    #[test]
    fn the_farthest_point_is_that_of_a_fine_sample() {
        let t = Tablet::default();
        let axis = Vec3::new(0.2, -0.5, 0.7).normalize();
        let (p, q) =
            (axis.cross(&Vec3::x()).normalize(), axis.cross(&Vec3::x()).normalize().cross(&axis));
        // Half the profile: pole, cap, rim; both ends.
        let profile: Vec<(f64, f64)> = (0..=400)
            .map(|k| {
                let r = t.radius * f64::from(k) / 400.0;
                (r, (t.round().powi(2) - r * r).sqrt() - t.beyond())
            })
            .collect();
        for k in 0..60 {
            let (s, c) = (0.11 * f64::from(k)).sin_cos();
            let down = (axis * c + p * s + q * 0.3).normalize();
            let mut most = f64::MIN;
            for (r, z) in &profile {
                for end in [-1.0, 1.0] {
                    let along = down.dot(&axis);
                    let across = (1.0 - along * along).max(0.0).sqrt();
                    most = most.max(r * across + end * z * along);
                }
            }
            let found = t.farthest(&axis, &down).dot(&down);
            assert!((found - most).abs() < 1e-7, "{k}: {found} {most}");
        }
    }

    #[test]
    fn the_tablet_itself_rebounds_as_the_formula_says() {
        let t = Tablet::default();
        let ball = [Sphere::new(Vec3::zeros(), t.radius)];
        let rms = |damping| {
            let throw = throw(&ball, damping);
            let mut squares = 0.0f64;
            for k in 0..=18 {
                let tilt = (5.0 * f64::from(k)).to_radians();
                let rotation = throw.rotation(tilt, 0.3);
                let found = t.rebound(&throw, &t.exact(&throw, rotation).unwrap());
                squares += (found.velocity - t.formula(tilt, 0.6).velocity).powi(2);
            }
            (squares / 19.0).sqrt()
        };
        // What is left turns by a degree while it touches; with the damping of the whole mass a blow beside the centre
        // rebounds too slowly.
        let (contact, bodies) = (rms(DampingLaw::Contact), rms(DampingLaw::Bodies));
        assert!(contact < 6e-3, "{contact}");
        assert!((0.02..0.06).contains(&bodies), "{bodies}");
    }
}
