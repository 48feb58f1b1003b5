//! Masses of the spheres of a clump.

use crate::fail::{Done, Fail};
use crate::input::parse::{not_negative, positive};
use clap::ValueEnum;
use morula::mass::{Body, Infeasible, MassOptions, Masses, Objective, correct};
use morula::{Error, Run, Sphere};
use serde_json::{Map, Value, json};

#[derive(clap::Args)]
#[command(next_help_heading = "Masses")]
pub struct Weighing {
    /// What is wished of the spheres' masses, beside that they add up to the body's mass, centre and
    /// inertia [default: even]
    #[arg(long, value_enum)]
    masses: Option<ObjectiveArg>,
    /// Least mass of a sphere [default: a thousandth of the body's, or a tenth of the mean]
    #[arg(long, value_name = "MASS", value_parser = not_negative)]
    min_mass: Option<f64>,
    /// Greatest mass of a sphere
    #[arg(long, value_name = "MASS", value_parser = positive)]
    max_mass: Option<f64>,
    /// Where no masses have the centre of the body: keep their sum, with the least error of the rest
    #[arg(long)]
    least_error: bool,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum ObjectiveArg {
    /// Least spread from each sphere's share of the union's volume
    Even,
    /// The greatest least mass
    #[value(name = "max_min", alias = "max-min")]
    MaxMin,
    /// The greatest mass of the last sphere
    #[value(name = "max_last", alias = "max-last")]
    MaxLast,
    /// No masses of spheres
    None,
}

impl Weighing {
    /// Refused where there is nothing to weigh.
    pub fn needs_density(&self) -> Done {
        let given = [
            ("--masses", self.masses.is_some_and(|m| m != ObjectiveArg::None)),
            ("--min-mass", self.min_mass.is_some()),
            ("--max-mass", self.max_mass.is_some()),
            ("--least-error", self.least_error),
        ];
        match given.iter().find(|(_, is)| *is) {
            Some((option, _)) => Err(Fail::Usage(format!("{option} takes a --density"))),
            None => Ok(()),
        }
    }

    /// What is asked of the masses; none where none are wanted.
    pub fn options(&self) -> Option<MassOptions> {
        let objective = match self.masses.unwrap_or(ObjectiveArg::Even) {
            ObjectiveArg::None => return None,
            ObjectiveArg::Even => Objective::Even,
            ObjectiveArg::MaxMin => Objective::MaxMin,
            ObjectiveArg::MaxLast => Objective::MaxLast,
        };
        let infeasible = if self.least_error { Infeasible::LeastError } else { Infeasible::Refuse };
        Some(MassOptions { objective, m_min: self.min_mass, m_max: self.max_mass, infeasible })
    }

    /// The masses of spheres in the frame of the body's `center`; none where none are wanted.
    pub fn masses(
        &self,
        spheres: &[Sphere],
        body: &Body,
        about: &str,
        run: &Run,
    ) -> Done<Option<Masses>> {
        let Some(options) = self.options() else { return Ok(None) };
        let masses = correct(spheres, body, &options, run).map_err(|error| match error {
            Error::NoMasses(text) => Error::NoMasses(format!(
                "{text} (--least-error keeps the total mass, --masses none leaves masses out)"
            )),
            error => error,
        });
        crate::fail::About::about(masses, about).map(Some)
    }
}

/// The keys of masses in JSON.
pub fn keys(masses: &Masses) -> Map<String, Value> {
    let r = &masses.residuals;
    let all = json!({
        "masses": masses.masses,
        "mass_status": masses.status.name(),
        "mass_residual": r.mass,
        "centre_residual": r.center,
        "inertia_residual": r.inertia,
        "mass_spread": masses.spread,
        "min_mass": masses.m_min,
        "largest_min_mass": masses.largest_m_min,
        "binding": masses.binding,
    });
    match all {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// The keys of a body in JSON: in the caller's frame, or in its own.
pub fn body_keys(body: &Body, own_frame: bool) -> Map<String, Value> {
    let (centre, inertia) = if own_frame {
        let [a, b, c] = body.principal.moments;
        ([0.0; 3], [a, b, c, 0.0, 0.0, 0.0])
    } else {
        ([body.center.x, body.center.y, body.center.z], body.inertia.to_array())
    };
    let all = json!({
        "density": body.density,
        "mass": body.mass,
        "centre": centre,
        "inertia": inertia,
        "principal_moments": body.principal.moments,
    });
    match all {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}
