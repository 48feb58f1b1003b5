//! The price list of a particle.

use super::step::StepModel;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, figure, reserve};
use crate::generate::{GenerateOptions, Levels, Series};
use crate::mass::{
    Body, Contact, ContactOptions, Infeasible, MassOptions, MassStatus, TimeStep, correct,
    inertia_error, time_step, union_moments,
};
use crate::math::{Inertia, Moments, Sphere, Vec3};
use crate::measure::{Quality, QualityOptions, quality};
use crate::run::{Run, Stage};
use crate::solid::Solid;
use std::time::Instant;

/// What a curve is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveOptions {
    /// Method, effort and demands of every clump; its number of spheres, mismatch and quality are
    /// not read.
    pub generate: GenerateOptions,
    /// Numbers of spheres, ascending; [`ladder`] makes them.
    pub counts: Vec<usize>,
    /// What the clumps have to do with each other.
    pub levels: Levels,
    /// Seconds that each clump may take; 0: as long as it takes.
    pub seconds: f64,
    /// How finely quality is measured, and whether the surface is.
    pub quality: QualityOptions,
    /// Whether spheres are weighed.
    pub masses: bool,
    /// Mass per volume.
    pub density: f64,
    /// The contacts for which the time step holds.
    pub contact: ContactOptions,
    /// What a step costs.
    pub step: StepModel,
}

impl Default for CurveOptions {
    fn default() -> Self {
        CurveOptions {
            generate: GenerateOptions::default(),
            counts: ladder(100),
            levels: Levels::Free,
            seconds: 0.0,
            quality: QualityOptions::default(),
            masses: true,
            density: 1.0,
            contact: ContactOptions { contact: Contact::Stiffness(1.0), speed: 0.0, contacts: 1 },
            step: StepModel::LAMMPS,
        }
    }
}

/// Numbers of spheres from 1 to `most`, about ten between each and its tenfold.
pub fn ladder(most: usize) -> Vec<usize> {
    let mut all = Vec::new();
    for k in 0..200 {
        let n = 10f64.powf(f64::from(k) / 10.0).round();
        if n >= most as f64 {
            break;
        }
        if all.last() != Some(&(n as usize)) {
            all.push(n as usize);
        }
    }
    if most > 0 {
        all.push(most);
    }
    all
}

/// One line of the price list. Lengths are over the equivalent diameter; what was not wanted is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Spheres asked for.
    pub asked: usize,
    /// Spheres of the clump.
    pub spheres: usize,
    /// D.
    pub mismatch: f64,
    /// |S∩C| / |S|.
    pub coverage: f64,
    /// |C∖S| / |S|.
    pub overshoot: f64,
    /// Root mean square distance between the surfaces, both ways.
    pub surface: f64,
    /// Greatest distance between the surfaces.
    pub hausdorff: f64,
    /// Greatest distance of the clump beyond the target.
    pub protrusion: f64,
    /// RMS angle between the normals, radians.
    pub roughness: f64,
    /// ε_w: what the union of the spheres lacks of the target's inertia.
    pub union_inertia: f64,
    /// What is left of the inertia's error with the masses of the spheres corrected.
    pub inertia: f64,
    /// How far the masses meet the equations; `None` where none were wanted.
    pub masses: Option<MassStatus>,
    /// Seconds that this clump takes from a ready solid: of the generator with the distance
    /// field, and where the clump starts from those before, theirs, too.
    pub seconds: f64,
    /// Seconds of the generator so far: distance field, this clump and all before it.
    pub seconds_so_far: f64,
    /// The time step that the clump allows.
    pub time_step: TimeStep,
    /// That of the rigid clump over that of a sphere of the same mass and volume.
    pub step_factor: f64,
    /// The least radius over that of the sphere of equal volume; Rayleigh's step falls as it does.
    pub least_radius: f64,
    /// What one step of the solver costs, in units of one with single spheres.
    pub step_cost: f64,
    /// What simulated time costs, in the same unit: the step's cost over its factor.
    pub time_cost: f64,
    /// Why the method stopped.
    pub stopped: Stopped,
}

/// A price list with its clumps.
#[derive(Debug, Clone)]
pub struct Curve {
    /// By the numbers of spheres asked for.
    pub points: Vec<Point>,
    /// The clump of each point, with its quality.
    pub clumps: Vec<Clump>,
    /// Numbers of spheres for which there is no clump, and why.
    pub failed: Vec<(usize, Error)>,
    /// The target's equivalent diameter, caller's unit.
    pub diameter: f64,
    /// Seconds of what all clumps share: the distance field.
    pub prepared: f64,
    /// Whether cancel or the deadline ended it before the last number.
    pub cut: bool,
}

/// Makes the price list of a solid.
///
/// All clumps share the solid and its distance field. After a cancel, or once the deadline has
/// passed, the curve ends with the points that there are; before the first one it is an error. A
/// number of spheres for which the method fails is left out, and the reason kept; where that is
/// so of all, the first is the error, as is memory that runs out at any. But for seconds the result is the same for any machine and
/// any number of threads, as long as no deadline is met.
pub fn curve(solid: &Solid, options: &CurveOptions, run: &Run) -> Result<Curve> {
    check(options)?;
    let n = options.counts.len();
    let mut made = Curve {
        points: reserve("points", n)?,
        clumps: reserve("clumps", n)?,
        failed: Vec::new(),
        diameter: (6.0 * solid.moments().volume / std::f64::consts::PI).cbrt(),
        prepared: 0.0,
        cut: false,
    };
    let start = Instant::now();
    let first = options.counts.first().copied().unwrap_or(0);
    let most = options.counts.last().copied().unwrap_or(0);
    let mut series = run
        .within([0.0, 0.01], || Series::new(solid, &options.generate, options.levels, most, run))?;
    run.within([0.01, 0.05], || series.prepare(first, run))?;
    made.prepared = start.elapsed().as_secs_f64();
    let prices = Prices::new(solid, options, made.diameter)?;
    let part = |k: usize| 0.05 + 0.95 * k as f64 / n as f64;
    let mut so_far = made.prepared;
    for (k, &asked) in options.counts.iter().enumerate() {
        if run.cancelled(part(k)) || (run.late() && !made.points.is_empty()) {
            made.cut = true;
            break;
        }
        run.count_anew();
        let level = run.within([part(k), part(k + 1)], || {
            let mut clump = run.within([0.0, 0.6], || {
                run.in_seconds(options.seconds, || series.next(asked, run))
            })?;
            let own = clump.counters.seconds[Stage::Generate as usize];
            so_far += own;
            let alone = options.levels == Levels::Free;
            let seconds = [if alone { made.prepared + own } else { so_far }, so_far];
            // A clump whose figures were not measured is none of the list.
            let point = run.within([0.6, 1.0], || prices.point(asked, &mut clump, seconds, run))?;
            Ok((clump, point))
        });
        match level {
            Ok((clump, point)) => {
                made.clumps.push(clump);
                made.points.push(point);
            }
            Err(Error::Cancelled(_)) => {
                made.cut = true;
                break;
            }
            // Not a matter of this number alone.
            Err(error @ Error::OutOfMemory(_)) => return Err(error),
            Err(error) => made.failed.push((asked, error)),
        }
    }
    match (made.points.is_empty(), made.failed.first()) {
        (false, _) => Ok(made),
        (true, Some((_, error))) if !made.cut => Err(error.clone()),
        _ => Err(Error::Cancelled("cancelled by the caller before the first clump".into())),
    }
}

fn check(o: &CurveOptions) -> Result<()> {
    if o.counts.is_empty() {
        return Err(Error::Empty("there is no number of spheres to make a curve of".into()));
    }
    if let Some(k) = o.counts.windows(2).position(|w| w[0] >= w[1]) {
        return Err(Error::InvalidArgument(format!(
            "number of spheres {} is {}, not more than {} before it",
            k + 1,
            o.counts.get(k + 1).unwrap_or(&0),
            o.counts.get(k).unwrap_or(&0)
        )));
    }
    if o.counts.first() == Some(&0) {
        return Err(Error::InvalidArgument("number of spheres 0 is 0".into()));
    }
    if !(o.seconds.is_finite() && o.seconds >= 0.0) {
        return Err(Error::InvalidArgument(format!(
            "the seconds of a clump are {}, not a number ≥ 0",
            figure(o.seconds)
        )));
    }
    o.step.check()
}

/// What a clump is held against.
struct Prices<'a> {
    solid: &'a Solid,
    options: &'a CurveOptions,
    moments: Moments,
    body: Body,
    /// The time step of the sphere of equal volume.
    ball: TimeStep,
    diameter: f64,
}

impl<'a> Prices<'a> {
    fn new(solid: &'a Solid, options: &'a CurveOptions, diameter: f64) -> Result<Prices<'a>> {
        let moments = solid.moments();
        let body = Body::of_solid(solid, options.density)?;
        let own = 0.1 * moments.volume * diameter * diameter;
        let inertia = Inertia { xx: own, yy: own, zz: own, ..Inertia::default() };
        let ball = Moments { centroid: Vec3::zeros(), inertia, ..moments };
        let ball = Body::of_moments(&ball, options.density)?;
        let sphere = [Sphere::new(Vec3::zeros(), 0.5 * diameter)];
        let ball = time_step(&sphere, &[], &ball, &options.contact)?;
        Ok(Prices { solid, options, moments, body, ball, diameter })
    }

    /// The line of a clump.
    fn point(
        &self,
        asked: usize,
        clump: &mut Clump,
        [seconds, seconds_so_far]: [f64; 2],
        run: &Run,
    ) -> Result<Point> {
        let Prices { solid, options: o, body, diameter, .. } = self;
        let spheres = &clump.spheres;
        let q: Quality = quality(solid, spheres, &o.quality, run)?;
        let union_inertia = inertia_error(&self.moments, &union_moments(spheres, run)?);
        let masses = if o.masses {
            let wanted = MassOptions { infeasible: Infeasible::LeastError, ..Default::default() };
            Some(correct(spheres, body, &wanted, run)?)
        } else {
            None
        };
        let weights = masses.as_ref().map_or(&[][..], |m| &m.masses);
        let time_step = time_step(spheres, weights, body, &o.contact)?;
        let step_factor = time_step.clump / self.ball.clump;
        let step_cost = o.step.cost(spheres.len());
        let least = spheres.iter().map(|s| s.radius).fold(f64::MAX, f64::min);
        let point = Point {
            asked,
            spheres: spheres.len(),
            mismatch: q.mismatch,
            coverage: q.coverage,
            overshoot: q.overshoot,
            surface: q.rms_distance / diameter,
            hausdorff: q.hausdorff / diameter,
            protrusion: q.protrusion / diameter,
            roughness: q.roughness,
            union_inertia,
            inertia: masses.as_ref().map_or(0.0, |m| m.residuals.inertia),
            masses: masses.map(|m| m.status),
            seconds,
            seconds_so_far,
            time_step,
            step_factor,
            least_radius: 2.0 * least / diameter,
            step_cost,
            time_cost: step_cost / step_factor,
            stopped: clump.stopped,
        };
        clump.quality = Some(q);
        Ok(point)
    }
}

#[cfg(test)]
#[path = "curve_tests.rs"]
mod tests;
