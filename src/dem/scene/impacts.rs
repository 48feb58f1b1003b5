//! Throws of a body at a plane in many poses, instead of a run over time.

use super::build::Scene;
use super::file::SceneFile;
use crate::dem::impact::{After, Throw};
use crate::dem::random::Random;
use crate::dem::tablet::{Rebound, Tablet};
use crate::error::{Error, Result, push};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Primitive;
use serde::Deserialize;
use std::f64::consts::TAU;

/// The most throws.
const MOST: usize = 1_000_000;

/// The poses, and what the rebounds are held against. Thrown is the first body, with its velocity, at the first wall.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImpactsPart {
    /// Tilts of the body's third axis from the normal of the plane, in degrees.
    #[serde(default)]
    pub tilts: Vec<f64>,
    /// For each of them so many turns about that axis, evenly spread.
    #[serde(default = "dozen")]
    pub azimuths: u32,
    /// Or so many random poses.
    #[serde(default)]
    pub poses: u32,
    /// A formula that tells the rebound of the true shape.
    pub formula: Option<FormulaName>,
    /// Columns of the sweep: the rebounds of a run are held against those of the run that differs in this one alone and has its
    /// last value there.
    #[serde(default)]
    pub compare: Vec<String>,
}

fn dozen() -> u32 {
    12
}

/// Formulas of rebounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FormulaName {
    /// A biconvex tablet (Kodam et al. 2012).
    Tablet,
}

/// One throw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thrown {
    /// Tilt and azimuth in degrees, where they were asked for.
    pub pose: Option<[f64; 2]>,
    /// The rotation, `w, x, y, z`.
    pub rotation: [f64; 4],
    /// What became of it.
    pub after: After,
}

/// What throws are worth against the formula: roots of the mean squares of the errors (velocity, spin) over the tilts, over the
/// speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// For each tilt what the formula says.
    pub formula: Vec<Rebound>,
    /// Mean over the azimuths.
    pub mean: [f64; 2],
    /// The worst azimuth.
    pub worst: [f64; 2],
    /// Mean over the azimuths, were each blow one at the lowest point of the lowest sphere, of a rigid body.
    pub rigid: [f64; 2],
    /// The true shape itself in the hands of the engine.
    pub floor: [f64; 2],
}

/// What came of all throws.
#[derive(Debug, Clone, PartialEq)]
pub struct Impacts {
    /// The throws, tilt by tilt.
    pub thrown: Vec<Thrown>,
    /// Against the formula, where one is named.
    pub agreement: Option<Agreement>,
    /// Velocity before.
    pub velocity: Vec3,
}

impl Impacts {
    /// The steps of all throws.
    pub fn steps(&self) -> u64 {
        self.thrown.iter().map(|t| t.after.steps).sum()
    }

    /// The most spheres that touched at once, in the mean of the throws.
    pub fn most(&self) -> f64 {
        let all: u64 = self.thrown.iter().map(|t| t.after.most).sum();
        all as f64 / self.thrown.len().max(1) as f64
    }

    /// The root of the mean square of the differences of velocity from other throws in the same poses, over the speed before, and of the
    /// differences of spin times `radius`. `None` where the throws are not as many.
    pub fn against(&self, other: &Impacts, radius: f64) -> Option<[f64; 2]> {
        if self.thrown.is_empty() || self.thrown.len() != other.thrown.len() {
            return None;
        }
        let mut squares = [0.0f64; 2];
        for (a, b) in self.thrown.iter().zip(&other.thrown) {
            let (a, b) = (&a.after, &b.after);
            squares[0] += (a.velocity - b.velocity).norm_squared();
            squares[1] += (a.angular_velocity - b.angular_velocity).norm_squared() * radius.powi(2);
        }
        let speed = self.velocity.norm();
        Some(squares.map(|s| (s / self.thrown.len() as f64).sqrt() / speed))
    }
}

/// The tablet that the template of this name is made of.
fn tablet(file: &SceneFile, name: &str, scene: &Scene) -> Result<Tablet> {
    let part = file.templates.get(name);
    let bad = || {
        let why = format!("impacts.formula is of a tablet, the template {name} is none");
        Error::InvalidArgument(why)
    };
    let part = part.filter(|p| p.shape.as_deref() == Some("tablet")).ok_or_else(bad)?;
    let mut particle = Primitive::from_name("tablet")?;
    for (key, value) in &part.set {
        particle.set(key, *value)?;
    }
    let Primitive::Tablet { band_radius, band_height, cap_height } = particle else {
        return Err(bad());
    };
    let template = scene.engine.state().template_of(0);
    Ok(Tablet {
        radius: band_radius * part.scale,
        band: band_height * part.scale,
        cap: cap_height * part.scale,
        mass: template.mass(),
        moments: template.moments(),
    })
}

/// Throws the first body of a scene. Throws are spread over the run's threads, each on one.
///
/// Refused: no body, poses of both kinds or none, what [`Throw::new`] refuses, a formula of another shape.
pub fn impacts(scene: &Scene, file: &SceneFile, part: &ImpactsPart, run: &Run) -> Result<Impacts> {
    let bad = |what: String| Err(Error::InvalidArgument(what));
    let Some(body) = file.bodies.first() else {
        return bad("impacts need a body to throw".into());
    };
    if part.tilts.is_empty() == (part.poses == 0) {
        return bad("impacts need tilts or poses, one of them".into());
    }
    if let Some(t) = part.tilts.iter().find(|t| !(0.0..=180.0).contains(*t)) {
        return bad(format!("impacts.tilts has {t}, not from 0 to 180"));
    }
    let azimuths = part.azimuths.max(1) as usize;
    if part.tilts.len().saturating_mul(azimuths).max(part.poses as usize) > MOST {
        return bad(format!("impacts ask for more than {MOST} throws"));
    }
    let s = scene.engine.state();
    let velocity = Vec3::from(body.velocity);
    let (template, material) = (s.template_of(0).clone(), s.material[0]);
    let throw = Throw::new(scene.engine.setup(), template, material, velocity)?;
    let mut poses = Vec::new();
    for tilt in &part.tilts {
        for k in 0..azimuths {
            let azimuth = (k as f64 + 0.25) / azimuths as f64;
            let rotation = throw.rotation(tilt.to_radians(), TAU * azimuth);
            push("poses", &mut poses, (Some([*tilt, 360.0 * azimuth]), rotation))?;
        }
    }
    for k in 0..u64::from(part.poses) {
        push("poses", &mut poses, (None, Random::of(&[file.run.seed, k]).rotation()))?;
    }
    let tablet = match part.formula {
        Some(FormulaName::Tablet) if part.tilts.is_empty() => {
            return bad("impacts.formula needs tilts".into());
        }
        Some(FormulaName::Tablet) => Some(tablet(file, &body.template, scene)?),
        None => None,
    };
    let done = run.pool().map(poses.len(), |k| throw.at(poses[k].1));
    run.check(1.0, "throwing a body")?;
    let mut thrown = Vec::new();
    for ((pose, rotation), after) in poses.into_iter().zip(done) {
        push("throws", &mut thrown, Thrown { pose, rotation, after: after? })?;
    }
    let agreement = match tablet {
        Some(tablet) => Some(agree(&tablet, &throw, &thrown, azimuths, &part.tilts)?),
        None => None,
    };
    Ok(Impacts { thrown, agreement, velocity })
}

/// The root of the mean square over the tilts of each azimuth: mean and worst.
fn errors(found: &[Rebound], formula: &[Rebound], azimuths: usize) -> [[f64; 2]; 2] {
    let (mut mean, mut worst) = ([0.0; 2], [0.0f64; 2]);
    for a in 0..azimuths {
        let mut squares = [0.0; 2];
        for (row, f) in found.chunks(azimuths).zip(formula) {
            let Some(r) = row.get(a) else { continue };
            squares[0] += (r.velocity - f.velocity).powi(2);
            squares[1] += (r.spin - f.spin).powi(2);
        }
        for k in 0..2 {
            let own = (squares[k] / formula.len().max(1) as f64).sqrt();
            mean[k] += own / azimuths as f64;
            worst[k] = worst[k].max(own);
        }
    }
    [mean, worst]
}

fn agree(
    tablet: &Tablet,
    throw: &Throw,
    thrown: &[Thrown],
    azimuths: usize,
    tilts: &[f64],
) -> Result<Agreement> {
    let e = throw.restitution();
    let formula: Vec<Rebound> = tilts.iter().map(|t| tablet.formula(t.to_radians(), e)).collect();
    let found: Vec<Rebound> = thrown.iter().map(|t| tablet.rebound(throw, &t.after)).collect();
    let [mean, worst] = errors(&found, &formula, azimuths);
    let rigid: Result<Vec<Rebound>> =
        thrown.iter().map(|t| Ok(tablet.rebound(throw, &throw.rigid(t.rotation)?))).collect();
    // The tablet is the same at all azimuths.
    let one = |t: &f64| {
        let rotation = throw.rotation(t.to_radians(), 0.0);
        Ok(tablet.rebound(throw, &tablet.exact(throw, rotation)?))
    };
    let exact: Result<Vec<Rebound>> = tilts.iter().map(one).collect();
    let [rigid, _] = errors(&rigid?, &formula, azimuths);
    let [floor, _] = errors(&exact?, &formula, 1);
    Ok(Agreement { formula, mean, worst, rigid, floor })
}
