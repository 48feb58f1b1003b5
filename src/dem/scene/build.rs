//! From what a file says to an engine that is ready to run.

use super::file::*;
use super::fragmentation::{breaks, fragmentation, with_pieces};
use super::laws::laws;
use super::materials::{coefficients, known};
use super::refuse::{refuse_idle, refuse_overlap};
use super::templates::{Made, Makes};
use super::walls::{insertion, wall};
use super::watch::Watch;
use super::wear::{wear, wears};
use crate::dem::advice::advise;
use crate::dem::effects::fragmentation::Fragmentation;
use crate::dem::effects::wear::Wear;
use crate::dem::{Drag, Engine, Insertion, Placed, Setup, State, WallSetup};
use crate::error::{Error, Result, figure, push};
use crate::math::Vec3;
use crate::run::Run;
use std::path::Path;

/// A scene that is ready to run.
pub struct Scene {
    /// Its title.
    pub title: String,
    /// Bodies, walls, laws.
    pub engine: Engine,
    /// What its bodies are made of.
    pub templates: Vec<Made>,
    /// What of it breaks.
    pub fragmentation: Option<Fragmentation>,
    /// What of it wears.
    pub wear: Vec<Wear>,
    /// Beyond this time step the worst of its clumps gains energy without bound; `None` without contacts.
    pub limit: Option<f64>,
    /// When it ends.
    pub end: f64,
    /// Kinetic energy below which it ends before.
    pub rest: Option<f64>,
    /// Whether it ends when nothing touches any more.
    pub parted: bool,
    /// What is measured.
    pub watch: Watch,
    /// Time between two lines of measures.
    pub every: Option<f64>,
    /// Time between two frames.
    pub frames: Option<f64>,
    /// Time between two checkpoints.
    pub checkpoint: Option<f64>,
    /// From when on measures are averaged.
    pub average: Option<f64>,
    /// What a user should know.
    pub notes: Vec<String>,
}

/// Builds a scene; files of shapes are looked for in `folder`.
///
/// Refused: names that are not there, numbers out of their range, effects that can do nothing, a time
/// step of 0 or beyond what the clumps allow without being told so.
pub fn build(file: &SceneFile, folder: &Path, run: &Run) -> Result<Scene> {
    build_with(file, folder, &mut Makes::default(), run)
}

/// The same, with clumps that were made before.
pub fn build_with(file: &SceneFile, folder: &Path, makes: &mut Makes, run: &Run) -> Result<Scene> {
    let laws = laws(&file.effects)?;
    let coefficients = coefficients(file, laws.as_ref())?;
    let mut templates: Vec<Made> = Vec::new();
    for (k, (name, part)) in file.templates.iter().enumerate() {
        run.check(k as f64 / file.templates.len() as f64, "making clumps")?;
        let keep = breaks(file, name) || wears(file, name);
        push("templates", &mut templates, makes.make(name, part, keep, folder, run)?)?;
    }
    let materials: Result<Vec<u32>> = file
        .templates
        .iter()
        .map(|(name, t)| known(&file.materials, &t.material, &format!("the template {name}")))
        .collect();
    let materials = materials?;
    let mut state = State::new(templates.iter().map(|t| t.template.clone()).collect());
    for (i, b) in file.bodies.iter().enumerate() {
        let place = file.templates.keys().position(|n| *n == b.template).ok_or_else(|| {
            Error::InvalidArgument(format!(
                "body {i} is of the template {}, which is not there",
                b.template
            ))
        })?;
        state.add(&Placed {
            template: place as u32,
            material: materials[place],
            position: b.position.into(),
            rotation: b.rotation,
            velocity: b.velocity.into(),
            angular_velocity: b.angular_velocity.into(),
            fixed: b.fixed,
        })?;
    }
    let walls: Result<Vec<WallSetup>> =
        file.walls.iter().enumerate().map(|(i, w)| wall(i, w, file, folder, run)).collect();
    let walls = walls?;
    refuse_idle(file, &templates, &state, &walls, &coefficients)?;
    let r = &file.run;
    let advice = match &laws {
        Some(laws) => {
            let all = with_pieces(file, &templates)?;
            advise(laws, &coefficients, &all, r.speed, r.contacts)?
        }
        None => None,
    };
    let limit = advice.map(|a| a.limit);
    if !(r.end.is_finite() && r.end > 0.0) {
        let end = figure(r.end);
        return Err(Error::InvalidArgument(format!("run.end is {end}, not a number above 0")));
    }
    if !(r.step_part > 0.0 && r.step_part <= 1.0) {
        let part = figure(r.step_part);
        return Err(Error::InvalidArgument(format!(
            "run.step_part is {part}, not above 0 and up to 1"
        )));
    }
    let dt = match (r.step, limit) {
        (Some(step), _) => step,
        (None, Some(limit)) => limit * r.step_part,
        (None, None) => {
            return Err(Error::InvalidArgument("run.step is needed where nothing touches".into()));
        }
    };
    let mut notes = Vec::new();
    if let (Some(advice), Some(laws)) = (advice, &laws) {
        if dt > advice.limit && r.guard {
            return Err(Error::InvalidArgument(format!(
                "the time step {} is beyond what the clumps allow, {} (run.guard = false lets it run)",
                figure(dt),
                figure(advice.limit)
            )));
        }
        notes.extend(advice.warning(dt, laws));
    }
    let drag = file.effects.drag.map(|d| Drag {
        viscosity: d.viscosity,
        density: d.density,
        coefficient: d.coefficient,
        flow: d.flow.into(),
    });
    let insertion: Result<Vec<Insertion>> = file
        .insertion
        .iter()
        .enumerate()
        .map(|(i, part)| insertion(i, part, file, &materials, dt))
        .collect();
    let setup = Setup {
        dt,
        laws,
        materials: file.materials.len().max(1),
        coefficients,
        walls,
        gravity: file.effects.gravity.map(Vec3::from),
        drag,
        insertion: insertion?,
        exact_rotation: r.rotation == RotationName::Exact,
        guard: r.guard,
    };
    for (name, v) in [
        ("every", file.output.every),
        ("frames", file.output.frames),
        ("checkpoint", file.output.checkpoint),
    ] {
        if let Some(v) = v
            && !(v.is_finite() && v > 0.0)
        {
            let v = figure(v);
            return Err(Error::InvalidArgument(format!(
                "output.{name} is {v}, not a number above 0"
            )));
        }
    }
    let fragmentation = fragmentation(file, &templates, &state, laws.as_ref(), dt, run)?;
    let mut engine = Engine::new(setup, state)?;
    if let Some(f) = &fragmentation {
        engine.break_by(f.clone())?;
    }
    let wear = wear(file, &templates, dt)?;
    if !wear.is_empty() {
        engine.wear_by(wear.clone())?;
    }
    engine.start(run)?;
    refuse_overlap(&engine, r.overlap)?;
    let coming: u64 = file.insertion.iter().map(|i| i.total).sum();
    let all = file.bodies.len() as u64 + coming;
    let watch = Watch::new(file.output.measures.as_deref(), all, &engine)?;
    if let Some(v) = file.output.average
        && !(v.is_finite() && v >= 0.0)
    {
        let v = figure(v);
        return Err(Error::InvalidArgument(format!("output.average is {v}, not a time")));
    }
    if file.output.average.is_some() && !watch.names().iter().any(|n| n == "time") {
        return Err(Error::InvalidArgument("output.average needs the measure time".into()));
    }
    Ok(Scene {
        title: file.title.clone(),
        engine,
        templates,
        fragmentation,
        wear,
        limit,
        end: r.end,
        rest: r.rest,
        parted: r.parted,
        watch,
        every: file.output.every,
        frames: file.output.frames,
        checkpoint: file.output.checkpoint,
        average: file.output.average,
        notes,
    })
}

impl Scene {
    /// Goes on from a checkpoint of this scene. Refused: what [`Engine::resume`] refuses.
    pub fn resume(&mut self, checkpoint: &[u8]) -> Result<()> {
        let mut engine = Engine::resume(self.engine.setup().clone(), checkpoint)?;
        if let Some(f) = &self.fragmentation {
            engine.break_by(f.clone())?;
        }
        if !self.wear.is_empty() {
            engine.wear_by(self.wear.clone())?;
        }
        self.engine = engine;
        Ok(())
    }
}
