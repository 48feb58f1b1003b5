//! What a scene file may say. Lengths, masses and times are in any one system of units.

mod bodies;
mod effects;
mod templates;

pub use bodies::*;
pub use effects::*;
pub(super) use templates::edges;
pub use templates::*;

use super::impacts::ImpactsPart;
use super::shows::{PlotPart, ShowPart};
use super::sweep::SweepPart;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A scene as its file has it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// One line for tables and logs.
    #[serde(default)]
    pub title: String,
    /// Time and what goes with it.
    pub run: RunPart,
    /// What happens; what is not named does not.
    #[serde(default)]
    pub effects: EffectsPart,
    /// What bodies and walls are made of, by name.
    #[serde(default)]
    pub materials: BTreeMap<String, MaterialPart>,
    /// What two materials do to each other, where the materials alone do not say it.
    #[serde(default)]
    pub pairs: Vec<PairPart>,
    /// Clumps that bodies are made of, by name.
    #[serde(default)]
    pub templates: BTreeMap<String, TemplatePart>,
    /// Bodies that are there at the start.
    #[serde(default)]
    pub bodies: Vec<BodyPart>,
    /// Bodies that come while it runs.
    #[serde(default)]
    pub insertion: Vec<InsertionPart>,
    /// Walls, in order.
    #[serde(default)]
    pub walls: Vec<WallPart>,
    /// Bodies that break.
    pub fragmentation: Option<super::fragmentation::FragmentationPart>,
    /// Bodies that wear.
    #[serde(default)]
    pub wear: Vec<super::wear::WearPart>,
    /// What is written down.
    #[serde(default)]
    pub output: OutputPart,
    /// Throws of the first body at the first wall, instead of a run over time.
    pub impacts: Option<ImpactsPart>,
    /// Many runs instead of one: every combination of what these list.
    #[serde(default)]
    pub sweep: Vec<SweepPart>,
    /// Figures that it is there for, beside their references.
    #[serde(default)]
    pub shows: Vec<ShowPart>,
    /// Pictures of its table.
    #[serde(default)]
    pub plots: Vec<PlotPart>,
    /// What of all this a quick run has differently.
    #[serde(default)]
    pub quick: toml::Table,
}

/// Time, threads, chance.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunPart {
    /// The simulation ends at this time.
    pub end: f64,
    /// Time step; without it a part of what the clumps allow is taken.
    pub step: Option<f64>,
    /// That part.
    #[serde(default = "fifth")]
    pub step_part: f64,
    /// Greatest speed at which two bodies meet, for the advice on the time step.
    #[serde(default = "one")]
    pub speed: f64,
    /// Contacts that act on a body at once the same way, for that advice.
    #[serde(default = "one_contact")]
    pub contacts: u32,
    /// How bodies turn between the forces.
    #[serde(default)]
    pub rotation: RotationName,
    /// Seed of every random choice.
    #[serde(default)]
    pub seed: u64,
    /// Stop a run that has more kinetic energy than was put in.
    #[serde(default = "yes")]
    pub guard: bool,
    /// How deep bodies may be in each other and in walls at the start, over the smaller radius.
    #[serde(default = "hundredth")]
    pub overlap: f64,
    /// End before `end` once the kinetic energy falls below this.
    pub rest: Option<f64>,
    /// End before `end` once nothing touches any more, after something has.
    #[serde(default)]
    pub parted: bool,
}

fn fifth() -> f64 {
    0.2
}

fn hundredth() -> f64 {
    0.01
}

fn one() -> f64 {
    1.0
}

fn one_contact() -> u32 {
    1
}

fn yes() -> bool {
    true
}

/// How bodies turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RotationName {
    /// By splitting: symplectic, with an error of dt² in the energy.
    #[default]
    Splitting,
    /// Exactly between the forces.
    Exact,
}

/// What is written.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutputPart {
    /// Time between two lines of measures.csv; without it there is one at the start and one at the end.
    pub every: Option<f64>,
    /// The measures, see the manual of scenes; without them time, energies, contacts.
    pub measures: Option<Vec<String>>,
    /// Time between two frames for ParaView; without it there are none.
    pub frames: Option<f64>,
    /// Time between two checkpoints; without it there is one at the end.
    pub checkpoint: Option<f64>,
    /// From this time on the lines of measures are averaged; without it the last one counts.
    pub average: Option<f64>,
}
