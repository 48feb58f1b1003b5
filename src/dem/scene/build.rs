//! From what a file says to an engine that is ready to run.

use super::file::*;
use super::fragmentation::{breaks, fragmentation, with_pieces};
use super::materials::{coefficients, known};
use super::templates::{Made, Makes, Source};
use super::watch::Watch;
use super::wear::{wear, wears};
use crate::dem::advice::advise;
use crate::dem::effects::fragmentation::Fragmentation;
use crate::dem::effects::wear::Wear;
use crate::dem::{
    Coefficients, CohesionLaw, DampingLaw, Engine, Laws, NormalLaw, Placed, Setup, State,
    TangentialLaw, WallMotion, WallSetup, WallShape,
};
use crate::dem::{Drag, InsertRegion, Insertion};
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
    let coming = file.insertion.iter().map(|i| i.total).sum::<u64>();
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
        if coming == 0 && state.fixed.iter().all(|f| *f) {
            return no("gravity", "every body is fixed");
        }
    }
    let alone = (state.len() + walls.len()) as u64 + coming < 2;
    if e.normal.is_some() && alone && file.fragmentation.is_none() {
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

fn insertion(
    i: usize,
    part: &InsertionPart,
    file: &SceneFile,
    materials: &[u32],
    dt: f64,
) -> Result<Insertion> {
    let bad = |what: String| Err(Error::InvalidArgument(format!("insertion {i} {what}")));
    let mut templates = Vec::new();
    for name in &part.templates {
        match file.templates.keys().position(|n| n == name) {
            Some(at) => push("templates", &mut templates, at as u32)?,
            None => return bad(format!("is of the template {name}, which is not there")),
        }
    }
    let of = |t: &u32| materials[*t as usize];
    let Some(material) = templates.first().map(of) else {
        return bad("names no template".into());
    };
    if templates.iter().any(|t| of(t) != material) {
        return bad("is of templates of several materials".into());
    }
    if !(part.every.is_finite() && part.every > 0.0) {
        return bad(format!("comes every {}, not a number above 0", figure(part.every)));
    }
    let region = match (&part.cuboid, &part.cylinder) {
        (Some(b), None) => InsertRegion::Box { lo: b.lo.into(), hi: b.hi.into() },
        (None, Some(c)) => {
            InsertRegion::Cylinder { center: c.center.into(), radius: c.radius, height: c.height }
        }
        _ => return bad("needs one of box and cylinder".into()),
    };
    Ok(Insertion {
        templates,
        material,
        region,
        velocity: part.velocity.into(),
        total: part.total,
        batch: part.at_once,
        every: ((part.every / dt).round().max(1.0)) as u64,
        attempts: part.attempts,
        seed: file.run.seed.wrapping_add(i as u64),
    })
}

/// The triangles of a mesh, in the frame of the scene.
fn mesh(i: usize, part: &MeshPart, folder: &Path, run: &Run) -> Result<WallShape> {
    if part.file.is_some() == part.shape.is_some() {
        return Err(Error::InvalidArgument(format!(
            "the mesh of wall {i} needs one of file and shape"
        )));
    }
    let source = Source {
        shape: part.shape.as_deref(),
        set: &part.set,
        segments: part.segments,
        file: part.file.as_deref(),
        scale: part.scale,
        stretch: None,
    };
    let shape = source.shape(folder, run).map_err(|e| e.about(&format!("wall {i}")))?;
    match shape.body.as_ref() {
        crate::shape::Body::Mesh(m) => Ok(WallShape::Mesh {
            vertices: m.vertices.iter().map(|v| shape.frame.to_input(v)).collect(),
            triangles: m.faces.clone(),
        }),
        crate::shape::Body::Voxels(_) => {
            Err(Error::Unsupported(format!("wall {i} is of voxels, not of triangles")))
        }
    }
}

fn wall(i: usize, w: &WallPart, file: &SceneFile, folder: &Path, run: &Run) -> Result<WallSetup> {
    let material = known(&file.materials, &w.material, &format!("wall {i}"))?;
    let shape = match (&w.plane, &w.cuboid, &w.cylinder, &w.mesh) {
        (Some(p), None, None, None) => {
            WallShape::Plane { normal: p.normal.into(), offset: p.offset }
        }
        (None, Some(b), None, None) => WallShape::Box { lo: b.lo.into(), hi: b.hi.into() },
        (None, None, Some(c), None) => WallShape::Cylinder {
            center: c.center.into(),
            axis: c.axis.into(),
            radius: c.radius,
            length: c.length,
        },
        (None, None, None, Some(m)) => mesh(i, m, folder, run)?,
        _ => {
            return Err(Error::InvalidArgument(format!(
                "wall {i} needs one of plane, box, cylinder and mesh"
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
