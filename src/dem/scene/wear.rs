//! Bodies of a scene that wear, and the lines that are written of it.

use super::file::{SceneFile, TargetName};
use super::fragmentation::{energies, touched};
use super::templates::Made;
use crate::dem::effects::wear::{Wear, WearRecord};
use crate::error::{Error, Result, figure, push};
use crate::fragment::ReclumpOptions;
use serde::Deserialize;

/// A body that wears: from time to time a flat is cut off its side, and what is left gets new spheres in place.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WearPart {
    /// Its label.
    pub body: u64,
    /// Time between two flats.
    pub every: f64,
    /// How many flats.
    pub times: u32,
    /// How deep a flat is, from the outermost point of the spheres.
    pub depth: f64,
    /// The side that wears, in space as the body lies then.
    pub direction: [f64; 3],
    /// Most spheres of what is left.
    #[serde(default = "fifty")]
    pub spheres: usize,
    /// Their least radius.
    #[serde(default)]
    pub min_radius: f64,
}

fn fifty() -> usize {
    50
}

/// Whether a body of this template wears.
pub(super) fn wears(file: &SceneFile, template: &str) -> bool {
    let of =
        |w: &WearPart| file.bodies.get(w.body as usize).is_some_and(|b| b.template == template);
    file.wear.iter().any(of)
}

/// What the engine is told of a scene's wear.
///
/// Refused: numbers out of their range, bodies that are not there or cannot wear.
pub(super) fn wear(file: &SceneFile, templates: &[Made], dt: f64) -> Result<Vec<Wear>> {
    let mut all = Vec::new();
    for (k, part) in file.wear.iter().enumerate() {
        let bad = |what: String| Err(Error::InvalidArgument(format!("wear {k} {what}")));
        let Some(body) = file.bodies.get(part.body as usize) else {
            return bad(format!("is of the body {}, which is not there", part.body));
        };
        if body.fixed {
            return bad(format!("can do nothing: the body {} is fixed", part.body));
        }
        if file.wear[..k].iter().any(|w| w.body == part.body) {
            return bad(format!("is of the body {} as an earlier one is", part.body));
        }
        let name = &body.template;
        if super::fragmentation::breaks(file, name) {
            return bad(format!("is of the body {}, which breaks", part.body));
        }
        let made = templates.iter().find(|t| t.name == *name);
        let Some((made, (solid, _))) = made.and_then(|t| Some((t, t.source.as_ref()?))) else {
            return bad(format!("is of {name}, which has no surface to cut"));
        };
        if file.templates.get(name).is_some_and(|t| t.inertia != TargetName::Solid) {
            return bad(format!(
                "is of {name}, whose mass is that of its spheres, not of the solid"
            ));
        }
        if !(part.every.is_finite() && part.every > 0.0 && part.every <= file.run.end) {
            let (every, end) = (figure(part.every), figure(file.run.end));
            return bad(format!("comes every {every}, not above 0 and within the run up to {end}"));
        }
        if part.spheres == 0 {
            return bad("leaves 0 spheres".into());
        }
        if !(part.min_radius.is_finite() && part.min_radius >= 0.0) {
            let radius = figure(part.min_radius);
            return bad(format!("has the min_radius {radius}, not a number of 0 or more"));
        }
        let reclump = ReclumpOptions {
            spheres: part.spheres,
            min_radius: part.min_radius,
            ..ReclumpOptions::default()
        };
        push(
            "wear",
            &mut all,
            Wear {
                label: part.body,
                solid: solid.clone(),
                body: made.body,
                every: ((part.every / dt).round().max(1.0)) as u64,
                times: part.times,
                depth: part.depth,
                direction: part.direction.into(),
                reclump,
            },
        )?;
    }
    Ok(all)
}

/// What a line of wear.csv tells of a flat.
pub const WEAR_COLUMNS: &str = "step,time,body,spheres,mass,dust,coverage,mismatch,mass-error,momentum-error,\
    angular-momentum-error,kinetic-before,kinetic-after,potential-before,potential-after,\
    stored-before,stored-after,energy-change,touching-before,touching-after,touched-before,touched-after";

/// A line of wear.csv, in the order of [`WEAR_COLUMNS`]: as [`super::break_line`] has it.
pub fn wear_line(w: &WearRecord, dt: f64) -> String {
    let [mass, momentum, angular] = w.errors;
    format!(
        "{},{:?},{},{},{:?},{:?},{:?},{:?},{mass:?},{momentum:?},{angular:?},{},{}",
        w.step,
        w.step as f64 * dt,
        w.label,
        w.spheres,
        w.mass,
        w.dust,
        w.coverage,
        w.mismatch(),
        energies(&w.before, &w.after),
        touched(&w.around),
    )
}
