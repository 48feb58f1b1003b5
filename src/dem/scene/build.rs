//! From what a file says to an engine that is ready to run.

use super::file::*;
use super::materials::{coefficients, known};
use super::templates::{Made, make};
use super::watch::Watch;
use crate::dem::{
    Coefficients, CohesionLaw, DampingLaw, Engine, Laws, NormalLaw, Placed, Setup, State,
    TangentialLaw, WallMotion, WallSetup, WallShape,
};
use crate::error::{Error, Result, figure, push};
use crate::mass::{Contact, ContactOptions, time_step};
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
    /// What a user should know.
    pub notes: Vec<String>,
}

/// Builds a scene; files of shapes are looked for in `folder`.
///
/// Refused: names that are not there, numbers out of their range, effects that can do nothing, a time
/// step of 0 or beyond what the clumps allow without being told so.
pub fn build(file: &SceneFile, folder: &Path, run: &Run) -> Result<Scene> {
    let (names, coefficients) = coefficients(file)?;
    let mut templates: Vec<Made> = Vec::new();
    for (k, (name, part)) in file.templates.iter().enumerate() {
        run.check(k as f64 / file.templates.len() as f64, "making clumps")?;
        push("templates", &mut templates, make(name, part, folder, run)?)?;
    }
    let materials: Result<Vec<usize>> = file
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
            material: materials[place] as u32,
            position: b.position.into(),
            rotation: b.rotation,
            velocity: b.velocity.into(),
            angular_velocity: b.angular_velocity.into(),
            fixed: b.fixed,
        })?;
    }
    let walls: Result<Vec<WallSetup>> =
        file.walls.iter().enumerate().map(|(i, w)| wall(i, w, file)).collect();
    let walls = walls?;
    let laws = laws(&file.effects)?;
    refuse_idle(file, &templates, &state, &walls, &coefficients)?;
    let limit = match laws {
        Some(laws) => Some(limit(file, &laws, &templates, &coefficients)?),
        None => None,
    };
    let r = &file.run;
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
    if let Some(limit) = limit
        && dt > 0.8 * limit
    {
        if dt > limit && r.guard {
            return Err(Error::InvalidArgument(format!(
                "the time step {} is beyond what the clumps allow, {} (run.guard = false lets it run)",
                figure(dt),
                figure(limit)
            )));
        }
        notes.push(format!(
            "the time step {} is beyond 0.8 of what the clumps allow, {}: the run may gain energy without bound",
            figure(dt),
            figure(limit)
        ));
    }
    let setup = Setup {
        dt,
        laws,
        materials: names.len().max(1),
        coefficients: if names.is_empty() { vec![Coefficients::default()] } else { coefficients },
        walls,
        gravity: file.effects.gravity.map(Vec3::from),
        drag: None,
        insertion: Vec::new(),
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
    let mut engine = Engine::new(setup, state)?;
    engine.start(run)?;
    refuse_overlap(&engine, r.overlap)?;
    let state = engine.state();
    let watch = Watch::new(file.output.measures.as_deref(), state.len())?;
    Ok(Scene {
        title: file.title.clone(),
        engine,
        templates,
        limit,
        end: r.end,
        rest: r.rest,
        parted: r.parted,
        watch,
        every: file.output.every,
        frames: file.output.frames,
        checkpoint: file.output.checkpoint,
        notes,
    })
}

fn laws(e: &EffectsPart) -> Result<Option<Laws>> {
    let Some(normal) = e.normal else {
        let others = [
            ("damping", e.damping.is_some()),
            ("tangential", e.tangential.is_some()),
            ("rolling", e.rolling),
            ("cohesion", e.cohesion.is_some()),
            ("averaging", e.averaging),
        ];
        return match others.iter().find(|o| o.1) {
            Some((name, _)) => Err(Error::InvalidArgument(format!(
                "effects.{name} does nothing without effects.normal: there are no contacts"
            ))),
            None => Ok(None),
        };
    };
    Ok(Some(Laws {
        normal: match normal {
            NormalName::Linear => NormalLaw::Linear,
            NormalName::Hertz => NormalLaw::Hertz,
        },
        damping: match e.damping {
            None => DampingLaw::None,
            Some(DampingName::Bodies) => DampingLaw::Bodies,
            Some(DampingName::Contact) => DampingLaw::Contact,
        },
        tangential: match e.tangential {
            None => TangentialLaw::None,
            Some(TangentialName::Viscous) => TangentialLaw::Viscous,
            Some(TangentialName::Mindlin) => TangentialLaw::Mindlin,
            Some(TangentialName::NoSlip) => TangentialLaw::NoSlip,
        },
        rolling: e.rolling,
        cohesion: match e.cohesion {
            None => CohesionLaw::None,
            Some(CohesionName::Linear) => CohesionLaw::Linear,
            Some(CohesionName::Jkr) => CohesionLaw::Jkr,
        },
        averaging: e.averaging,
    }))
}

/// Refuses effects that are named and can do nothing.
fn refuse_idle(
    file: &SceneFile,
    templates: &[Made],
    state: &State,
    walls: &[WallSetup],
    coefficients: &[Coefficients],
) -> Result<()> {
    let e = &file.effects;
    let no = |what: &str, why: &str| {
        Err(Error::InvalidArgument(format!("effects.{what} can do nothing: {why}")))
    };
    if let Some(g) = e.gravity {
        if !g.iter().all(|c| c.is_finite()) {
            return Err(Error::NotFinite(format!(
                "effects.gravity is ({}, {}, {})",
                g[0], g[1], g[2]
            )));
        }
        if g == [0.0; 3] {
            return no("gravity", "it is 0");
        }
        if !state.is_empty() && state.fixed.iter().all(|f| *f) {
            return no("gravity", "every body is fixed");
        }
    }
    if e.normal.is_some() && state.len() + walls.len() < 2 {
        return no("normal", "there are no two things that could touch");
    }
    let zero = |of: &dyn Fn(&Coefficients) -> f64| coefficients.iter().all(|c| of(c) == 0.0);
    if e.damping.is_some() && zero(&|c| c.damping) {
        return no("damping", "every restitution is 1");
    }
    if e.tangential.is_some() && zero(&|c| c.friction) {
        return no("tangential", "every friction is 0");
    }
    if e.rolling && zero(&|c| c.rolling) {
        return no("rolling", "every coefficient of rolling is 0");
    }
    if e.cohesion.is_some() && zero(&|c| c.cohesion) {
        return no("cohesion", "every cohesion is 0");
    }
    let single = templates.iter().all(|t| t.spheres.len() == 1);
    let flat = walls.iter().all(|w| matches!(w.shape, WallShape::Plane { .. }));
    if e.averaging && single && flat {
        return no(
            "averaging",
            "every body is one sphere and every wall a plane: two never touch twice",
        );
    }
    Ok(())
}

/// Refuses bodies that are in each other or in a wall at the start.
fn refuse_overlap(engine: &Engine, part: f64) -> Result<()> {
    let s = engine.state();
    let radius = |body: u32, sphere: u32| {
        s.template_of(body as usize).spheres().get(sphere as usize).map_or(0.0, |s| s.radius)
    };
    let [bodies, walls] = engine.contacts();
    for (of_walls, c) in bodies.iter().map(|c| (false, c)).chain(walls.iter().map(|c| (true, c))) {
        let own = radius(c.b, c.sphere_b);
        let least = if of_walls { own } else { own.min(radius(c.a, c.sphere_a)) };
        if c.overlap > part * least {
            let first = if of_walls { "wall" } else { "body" };
            return Err(Error::InvalidArgument(format!(
                "{first} {} and body {} overlap by {} at the start, more than {} of the smaller radius \
                 (run.overlap)",
                c.a,
                s.label[c.b as usize],
                figure(c.overlap),
                figure(part)
            )));
        }
    }
    Ok(())
}

/// The least of what the clumps allow.
fn limit(
    file: &SceneFile,
    laws: &Laws,
    templates: &[Made],
    coefficients: &[Coefficients],
) -> Result<f64> {
    let stiffest = coefficients.iter().map(|c| c.stiffness).fold(0.0, f64::max);
    let contact = match laws.normal {
        NormalLaw::Linear => Contact::Stiffness(stiffest),
        // Of two alike: E = Y/(2 (1 − ν²)).
        NormalLaw::Hertz => Contact::Material { young: 2.0 * stiffest, poisson: 0.0 },
    };
    let averaged = if laws.averaging { 1 } else { file.run.contacts };
    let options = ContactOptions { contact, speed: file.run.speed, contacts: averaged };
    let mut least = f64::MAX;
    for t in templates {
        let spheres = t.body.to_input(&t.spheres);
        least = least.min(time_step(&spheres, &[], &t.body, &options)?.clump);
    }
    Ok(least)
}

fn wall(i: usize, w: &WallPart, file: &SceneFile) -> Result<WallSetup> {
    let material = known(&file.materials, &w.material, &format!("wall {i}"))? as u32;
    let shape = match (&w.plane, &w.cuboid, &w.cylinder) {
        (Some(p), None, None) => WallShape::Plane { normal: p.normal.into(), offset: p.offset },
        (None, Some(b), None) => WallShape::Box { lo: b.lo.into(), hi: b.hi.into() },
        (None, None, Some(c)) => WallShape::Cylinder {
            center: c.center.into(),
            axis: c.axis.into(),
            radius: c.radius,
            length: c.length,
        },
        _ => {
            return Err(Error::InvalidArgument(format!(
                "wall {i} needs one of plane, box and cylinder"
            )));
        }
    };
    let motion = match (w.slide, w.convey, &w.shake, &w.turn) {
        (None, None, None, None) => WallMotion::Still,
        (Some(v), None, None, None) => WallMotion::Slide(v.into()),
        (None, Some(v), None, None) => WallMotion::Convey(v.into()),
        (None, None, Some(s), None) => {
            WallMotion::Shake { amplitude: s.amplitude.into(), frequency: s.frequency }
        }
        (None, None, None, Some(t)) => WallMotion::Turn {
            center: t.center.into(),
            axis: t.axis.into(),
            rate: t.rate,
            spin: t.spin,
        },
        _ => return Err(Error::InvalidArgument(format!("wall {i} moves in more than one way"))),
    };
    Ok(WallSetup { shape, material, motion })
}
