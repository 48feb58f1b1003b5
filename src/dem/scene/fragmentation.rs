//! Bodies of a scene that break, and the lines that are written of it.

use super::file::SceneFile;
use super::templates::Made;
use crate::dem::contact::Laws;
use crate::dem::effects::fragmentation::{
    BreakBy, BreakRecord, Breakable, Energies, Fragmentation, Threshold, Touching,
};
use crate::dem::state::State;
use crate::dem::template::Template;
use crate::error::{Error, Result, figure, push};
use crate::fragment::{CutOptions, Parent, ReclumpOptions, ShatterOptions};
use crate::math::Sphere;
use crate::run::Run;
use serde::Deserialize;
use std::sync::Arc;

/// Which bodies break, when, and into what. The load of a body is the sum of the forces of all that touch it, each by
/// its size.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FragmentationPart {
    /// Names of the templates whose bodies break.
    pub templates: Vec<String>,
    /// A body breaks where its load over time, what is older than `window` forgotten, passes this.
    pub impulse: Option<f64>,
    /// See there.
    pub window: Option<f64>,
    /// Or where half of its load over the section of the sphere with its radius of gyration passes this stress.
    pub stress: Option<f64>,
    /// Breaks at a time, whatever the load.
    #[serde(default)]
    pub at: Vec<BreakAt>,
    /// Points whose cells a body is cut into; of a body that is not convex there may be more pieces.
    pub cells: usize,
    /// Where the points are.
    #[serde(default)]
    pub pattern: PatternName,
    /// Most spheres of a fragment.
    #[serde(default = "twenty")]
    pub spheres: usize,
    /// Their least radius.
    #[serde(default)]
    pub min_radius: f64,
    /// Pieces of less volume become dust and are taken away; without it a tenth of the mean piece of the last generation.
    /// The time step is one that pieces of this volume bear.
    pub least_volume: Option<f64>,
    /// Spheres of two fragments are this far apart.
    #[serde(default)]
    pub gap: f64,
    /// Whether spheres stay within the union of the body's old ones, which neighbours touch.
    #[serde(default = "yes")]
    pub union: bool,
    /// How often pieces may break again: 1 breaks whole bodies only.
    #[serde(default = "once")]
    pub generations: u32,
}

/// A break at a time.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BreakAt {
    /// When.
    pub time: f64,
    /// The label of the body; bodies are numbered as they come, pieces among them.
    pub body: u64,
}

/// Where the points are whose cells a body is cut into.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PatternName {
    /// Evenly spread.
    #[default]
    Seeded,
    /// The denser the nearer to the deepest contact.
    Impact,
}

fn twenty() -> usize {
    20
}

fn yes() -> bool {
    true
}

fn once() -> u32 {
    1
}

/// Most points of a cut.
const MOST: usize = 1 << 16;

/// Whether bodies of this template break.
pub(super) fn breaks(file: &SceneFile, template: &str) -> bool {
    file.fragmentation.as_ref().is_some_and(|f| f.templates.iter().any(|t| t == template))
}

/// What the engine is told of a scene's breakage; `None` where none is named.
///
/// Refused: numbers out of their range, and what can do nothing.
pub(super) fn fragmentation(
    file: &SceneFile,
    templates: &[Made],
    state: &State,
    laws: Option<&Laws>,
    dt: f64,
    run: &Run,
) -> Result<Option<Fragmentation>> {
    let Some(part) = &file.fragmentation else { return Ok(None) };
    let bad = |what: String| Err(Error::InvalidArgument(format!("fragmentation.{what}")));
    let idle =
        |why: &str| Err(Error::InvalidArgument(format!("fragmentation can do nothing: {why}")));
    let threshold = threshold(part)?;
    if threshold.is_none() && part.at.is_empty() {
        return idle("it names no impulse, no stress and no time");
    }
    if threshold.is_some() && laws.is_none() {
        return idle("without effects.normal there are no contacts to load a body");
    }
    if part.pattern == PatternName::Impact && laws.is_none() {
        return idle("without effects.normal nothing is hit, as the pattern impact needs");
    }
    if part.generations == 0 {
        return idle("generations is 0");
    }
    if !(2..=MOST).contains(&part.cells) {
        return bad(format!("cells is {}, not 2 to {MOST}", part.cells));
    }
    if part.spheres == 0 {
        return bad("spheres is 0".into());
    }
    for (name, v) in [("min_radius", part.min_radius), ("gap", part.gap)] {
        if !(v.is_finite() && v >= 0.0) {
            return bad(format!("{name} is {}, not a number of 0 or more", figure(v)));
        }
    }
    let mut breakable = Vec::new();
    for name in &part.templates {
        let Some(at) = templates.iter().position(|t| t.name == *name) else {
            return bad(format!("templates names {name}, which is not there"));
        };
        let Some((solid, spheres)) = &templates[at].source else {
            return bad(format!("templates names {name}, which has no surface to cut"));
        };
        if file.templates.get(name).is_some_and(|t| t.inertia != super::file::TargetName::Solid) {
            return bad(format!(
                "templates names {name}, whose mass is that of its spheres: fragments are cut from the solid"
            ));
        }
        let about = |e: Error| e.about(&format!("template {name}"));
        let parent = Arc::new(Parent::new(solid.clone(), spheres, run).map_err(about)?);
        let body = templates[at].body;
        push("templates", &mut breakable, Breakable { template: at as u32, parent, body })?;
    }
    let coming = |name: &String| {
        file.insertion.iter().any(|i| i.total > 0 && i.templates.iter().any(|t| t == name))
    };
    let of = |i: &usize| breakable.iter().any(|b| b.template == state.template[*i]);
    let moves = (0..state.len()).any(|i| of(&i) && !state.fixed[i]);
    if !moves && !part.templates.iter().any(coming) {
        return idle("no body that moves is of its templates");
    }
    let mut at = Vec::new();
    for (i, a) in part.at.iter().enumerate() {
        if !(a.time > 0.0 && a.time <= file.run.end) {
            let (time, end) = (figure(a.time), figure(file.run.end));
            return bad(format!("at.{i} is at {time}, not within the run up to {end}"));
        }
        let there = state.label.binary_search(&a.body).ok();
        if there.is_some_and(|i| !of(&i) || state.fixed[i]) {
            return bad(format!("at.{i} is of the body {}, which does not break", a.body));
        }
        push("breaks", &mut at, (((a.time / dt).round() as u64).max(1), a.body))?;
    }
    let reclump = ReclumpOptions {
        spheres: part.spheres,
        min_radius: part.min_radius,
        gap: part.gap,
        union: part.union,
        quality: false,
        ..ReclumpOptions::default()
    };
    let cut = CutOptions { least_volume: least_volume(part, templates)? };
    Ok(Some(Fragmentation {
        breakable,
        threshold,
        at,
        by: match part.pattern {
            PatternName::Seeded => BreakBy::Seeded(part.cells),
            PatternName::Impact => BreakBy::Impact(part.cells),
        },
        options: ShatterOptions { cut, reclump, masses: None },
        generations: part.generations,
        seed: file.run.seed,
    }))
}

/// What is dust below.
fn least_volume(part: &FragmentationPart, templates: &[Made]) -> Result<f64> {
    let all = templates.iter().filter(|t| part.templates.contains(&t.name));
    let least = all.map(|t| t.body.volume).fold(f64::MAX, f64::min);
    let pieces = (part.cells as f64).powi(part.generations.min(64) as i32);
    let v = part.least_volume.unwrap_or(0.1 * least / pieces);
    if !(v.is_finite() && v > 0.0 && v < least) {
        let (v, least) = (figure(v), figure(least));
        return Err(Error::InvalidArgument(format!(
            "fragmentation.least_volume is {v}, not a number above 0 and below {least}, that of a body"
        )));
    }
    Ok(v)
}

/// The templates, with a copy of each that breaks as small as its least piece: what a time step must bear.
pub(super) fn with_pieces(file: &SceneFile, templates: &[Made]) -> Result<State> {
    let mut all: Vec<Arc<Template>> = templates.iter().map(|t| t.template.clone()).collect();
    if let Some(part) = &file.fragmentation {
        for t in templates.iter().filter(|t| part.templates.contains(&t.name)) {
            let share = least_volume(part, templates)? / t.body.volume;
            let size = share.cbrt();
            let small = |s: &Sphere| Sphere::new(s.center * size, s.radius * size);
            let spheres: Vec<Sphere> = t.template.spheres().iter().map(small).collect();
            let moments = t.template.moments().map(|m| m * share * size * size);
            let small = Template::new(&spheres, t.template.mass() * share, moments)?;
            push("templates", &mut all, Arc::new(small))?;
        }
    }
    Ok(State::new(all))
}

fn threshold(part: &FragmentationPart) -> Result<Option<Threshold>> {
    let bad = |what: &str| Err(Error::InvalidArgument(format!("fragmentation.{what}")));
    match (part.impulse, part.window, part.stress) {
        (Some(_), _, Some(_)) => bad("impulse and stress are both there: one of them breaks"),
        (Some(_), None, None) => bad("impulse needs a window, a time"),
        (None, Some(_), _) => bad("window does nothing without impulse"),
        (Some(limit), Some(window), None) => Ok(Some(Threshold::Impulse { limit, window })),
        (None, None, Some(limit)) => Ok(Some(Threshold::Stress { limit })),
        (None, None, None) => Ok(None),
    }
}

/// What a line of breaks.csv tells of a break.
pub const BREAK_COLUMNS: &str = "step,time,body,fragments,dust,mass-error,momentum-error,\
    angular-momentum-error,kinetic-before,kinetic-after,potential-before,potential-after,\
    stored-before,stored-after,energy-change,overlaps,deepest,touching-before,touching-after,\
    touched-before,touched-after";

/// A line of breaks.csv, in the order of [`BREAK_COLUMNS`]: errors are relative, with the dust; energies are those of
/// the whole bed; overlaps are between the fragments, what touches are neighbours and walls, with the deepest overlap.
pub fn break_line(b: &BreakRecord, dt: f64) -> String {
    let [mass, momentum, angular] = b.errors();
    format!(
        "{},{:?},{},{},{:?},{mass:?},{momentum:?},{angular:?},{},{},{:?},{}",
        b.step,
        b.step as f64 * dt,
        b.label,
        b.fragments.len(),
        b.dust,
        energies(&b.before, &b.after),
        b.between.count,
        b.between.deepest,
        touched(&b.around),
    )
}

/// Energies before and after, and how much they rise together.
pub(super) fn energies(x: &Energies, y: &Energies) -> String {
    let [kinetic, potential, stored] =
        [[x.kinetic, y.kinetic], [x.potential, y.potential], [x.stored, y.stored]]
            .map(|[x, y]| format!("{x:?},{y:?}"));
    format!("{kinetic},{potential},{stored},{:?}", y.sum() - x.sum())
}

/// Contacts before and after: how many, and how deep.
pub(super) fn touched([before, after]: &[Touching; 2]) -> String {
    let deepest = format!("{:?},{:?}", before.deepest, after.deepest);
    format!("{},{},{deepest}", before.count, after.count)
}
