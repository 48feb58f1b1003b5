//! What of a simulation is measured.

use super::bed::{bed, needs_container, needs_drum, profile, repose, top};
use crate::dem::energy;
use crate::dem::engine::Engine;
use crate::error::{Error, Result, push};

/// Measures in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Watch {
    names: Vec<String>,
    measures: Vec<Measure>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Measure {
    Whole(Whole),
    /// A figure of the body with this label.
    Of(u64, Own),
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Whole {
    Time,
    Steps,
    Bodies,
    Kinetic,
    Translation,
    Rotation,
    Potential,
    Stored,
    Energy,
    Contacts,
    Overlap,
    Speed,
    Top,
    Height,
    Profile,
    Solid,
    Angle,
    Momentum(usize),
    AngularMomentum(usize),
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Own {
    Position(usize),
    Velocity(usize),
    Spin(usize),
    Quaternion(usize),
    Force(usize),
    AlongAxes(usize),
}

const WHOLE: [(&str, Whole); 23] = [
    ("time", Whole::Time),
    ("steps", Whole::Steps),
    ("bodies", Whole::Bodies),
    ("kinetic", Whole::Kinetic),
    ("translation", Whole::Translation),
    ("rotation", Whole::Rotation),
    ("potential", Whole::Potential),
    ("stored", Whole::Stored),
    ("energy", Whole::Energy),
    ("contacts", Whole::Contacts),
    ("overlap", Whole::Overlap),
    ("speed", Whole::Speed),
    ("top", Whole::Top),
    ("height", Whole::Height),
    ("profile", Whole::Profile),
    ("solid", Whole::Solid),
    ("angle", Whole::Angle),
    ("momentum-x", Whole::Momentum(0)),
    ("momentum-y", Whole::Momentum(1)),
    ("momentum-z", Whole::Momentum(2)),
    ("angular-momentum-x", Whole::AngularMomentum(0)),
    ("angular-momentum-y", Whole::AngularMomentum(1)),
    ("angular-momentum-z", Whole::AngularMomentum(2)),
];

const OWN: [(&str, Own); 19] = [
    ("x", Own::Position(0)),
    ("y", Own::Position(1)),
    ("z", Own::Position(2)),
    ("vx", Own::Velocity(0)),
    ("vy", Own::Velocity(1)),
    ("vz", Own::Velocity(2)),
    ("wx", Own::Spin(0)),
    ("wy", Own::Spin(1)),
    ("wz", Own::Spin(2)),
    ("qw", Own::Quaternion(0)),
    ("qx", Own::Quaternion(1)),
    ("qy", Own::Quaternion(2)),
    ("qz", Own::Quaternion(3)),
    ("fx", Own::Force(0)),
    ("fy", Own::Force(1)),
    ("fz", Own::Force(2)),
    ("own-wx", Own::AlongAxes(0)),
    ("own-wy", Own::AlongAxes(1)),
    ("own-wz", Own::AlongAxes(2)),
];

impl Watch {
    /// The measures of these names: those of the whole, or `x:3` and the like for the body with the label 3 (bodies are
    /// numbered as they come). Without names: time, kinetic, potential, stored, energy, contacts.
    pub(super) fn new(names: Option<&[String]>, bodies: u64, engine: &Engine) -> Result<Watch> {
        let usual = ["time", "kinetic", "potential", "stored", "energy", "contacts"];
        let names: Vec<String> = match names {
            Some(names) => names.to_vec(),
            None => usual.map(String::from).to_vec(),
        };
        let mut measures = Vec::new();
        for name in &names {
            let found = measure(name, bodies)?;
            match found {
                Measure::Whole(Whole::Height | Whole::Profile | Whole::Solid) => {
                    needs_container(name, engine)?;
                }
                Measure::Whole(Whole::Angle) => needs_drum(name, engine)?,
                _ => {}
            }
            push("measures", &mut measures, found)?;
        }
        Ok(Watch { names, measures })
    }

    /// Their names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Their values now; those of a body that is gone are those of nothing: NaN is not written, an empty field is.
    pub fn row(&self, engine: &Engine) -> Vec<Option<f64>> {
        let s = engine.state();
        let [straight, turning] = energy::kinetic(s);
        let potential = engine.setup().gravity.map_or(0.0, |g| energy::potential(s, &g));
        let needs = |m: &Measure| {
            matches!(
                m,
                Measure::Whole(Whole::Stored | Whole::Energy | Whole::Contacts | Whole::Overlap)
            )
        };
        let contacts = if self.measures.iter().any(needs) {
            engine.contacts()
        } else {
            [Vec::new(), Vec::new()]
        };
        let each = || contacts.iter().flatten();
        let beds = |m: &Measure| matches!(m, Measure::Whole(Whole::Height | Whole::Solid));
        let bed = if self.measures.iter().any(beds) { bed(engine) } else { None };
        let stored: f64 = each().map(|c| c.energy).sum();
        let of = |m: &Measure| match *m {
            Measure::Whole(Whole::Height) => bed.map(|b| b[0]),
            Measure::Whole(Whole::Profile) => profile(engine),
            Measure::Whole(Whole::Solid) => bed.map(|b| b[1]),
            Measure::Whole(Whole::Angle) => repose(engine),
            Measure::Whole(w) => Some(match w {
                Whole::Height | Whole::Profile | Whole::Solid | Whole::Angle => return None,
                Whole::Time => engine.time(),
                Whole::Steps => engine.steps() as f64,
                Whole::Bodies => s.len() as f64,
                Whole::Kinetic => straight + turning,
                Whole::Translation => straight,
                Whole::Rotation => turning,
                Whole::Potential => potential,
                Whole::Stored => stored,
                Whole::Energy => straight + turning + potential + stored,
                Whole::Contacts => each().count() as f64,
                Whole::Overlap => each().map(|c| c.overlap).fold(0.0, f64::max),
                Whole::Speed => s.velocity.iter().map(|v| v.norm()).fold(0.0, f64::max),
                Whole::Top => top(engine),
                Whole::Momentum(k) => energy::momentum(s)[k],
                Whole::AngularMomentum(k) => energy::angular_momentum(s)[k],
            }),
            Measure::Of(label, own) => {
                let i = s.label.iter().position(|l| *l == label)?;
                Some(match own {
                    Own::Position(k) => s.position[i][k],
                    Own::Velocity(k) => s.velocity[i][k],
                    Own::Spin(k) => s.angular_velocity(i)[k],
                    Own::Quaternion(k) => s.orientation[i].quaternion[k],
                    Own::Force(k) => s.force[i][k],
                    Own::AlongAxes(k) => {
                        (s.orientation[i].matrix().transpose() * s.angular_velocity(i))[k]
                    }
                })
            }
        };
        self.measures.iter().map(of).collect()
    }
}

fn measure(name: &str, bodies: u64) -> Result<Measure> {
    if let Some((_, w)) = WHOLE.iter().find(|w| w.0 == name) {
        return Ok(Measure::Whole(*w));
    }
    if let Some((own, label)) = name.split_once(':')
        && let Some((_, own)) = OWN.iter().find(|o| o.0 == own)
    {
        let label: u64 = label.parse().map_err(|_| {
            Error::InvalidArgument(format!(
                "the measure {name} names no body: {label} is no number"
            ))
        })?;
        if label >= bodies {
            return Err(Error::InvalidArgument(format!(
                "the measure {name} names a body that is not there: {bodies} are"
            )));
        }
        return Ok(Measure::Of(label, *own));
    }
    let all = WHOLE.iter().map(|w| w.0).chain(OWN.iter().map(|o| o.0));
    let near = all.max_by_key(|n| (strsim::jaro_winkler(name, n) * 1e6) as u64);
    Err(Error::InvalidArgument(format!(
        "unknown measure {name}; the nearest is {}",
        near.unwrap_or("time")
    )))
}
