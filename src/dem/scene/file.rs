//! What a scene file may say. Lengths, masses and times are in any one system of units.

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

/// The effects.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EffectsPart {
    /// Acceleration of gravity.
    pub gravity: Option<[f64; 3]>,
    /// Repulsion along the normal.
    pub normal: Option<NormalName>,
    /// Damping along the normal by restitution, and which mass it goes by.
    pub damping: Option<DampingName>,
    /// Friction.
    pub tangential: Option<TangentialName>,
    /// Resistance to rolling.
    #[serde(default)]
    pub rolling: bool,
    /// Cohesion.
    pub cohesion: Option<CohesionName>,
    /// Contact averaging per pair of bodies.
    #[serde(default)]
    pub averaging: bool,
    /// A fluid that slows bodies down.
    pub drag: Option<DragPart>,
}

/// A fluid.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DragPart {
    /// Dynamic viscosity.
    pub viscosity: f64,
    /// Density.
    #[serde(default)]
    pub density: f64,
    /// Drag coefficient of the quadratic part.
    #[serde(default)]
    pub coefficient: f64,
    /// Velocity of the fluid.
    #[serde(default)]
    pub flow: [f64; 3],
}

/// Repulsion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NormalName {
    /// A spring.
    Linear,
    /// Hertz.
    Hertz,
}

/// Damping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DampingName {
    /// By the masses of the bodies.
    Bodies,
    /// By the mass that the contact feels.
    Contact,
}

/// Friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TangentialName {
    /// Against the sliding, without memory.
    Viscous,
    /// A spring with history.
    Mindlin,
    /// Hertz–Mindlin, no slip.
    NoSlip,
}

/// Cohesion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CohesionName {
    /// A stress on the area of contact.
    Linear,
    /// Johnson, Kendall and Roberts.
    Jkr,
}

/// A material, and what two bodies of it do to each other.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialPart {
    /// Young's modulus, for Hertz.
    pub young: Option<f64>,
    /// Poisson's ratio, for Hertz.
    pub poisson: Option<f64>,
    /// Spring of a contact of two bodies of it, for the linear law.
    pub stiffness: Option<f64>,
    /// Speed after a central blow over that before, 0 to 1.
    pub restitution: Option<f64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Force over speed, for viscous friction.
    pub viscosity: Option<f64>,
    /// Stiffness in the plane of contact over that along the normal, for the linear law with friction; 0.8 without.
    pub shear: Option<f64>,
    /// Coefficient of resistance to rolling.
    pub rolling: Option<f64>,
    /// Stress, or with jkr the work of adhesion per area.
    pub cohesion: Option<f64>,
}

/// Two materials.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairPart {
    /// Their names.
    pub between: [String; 2],
    /// Spring of their contact, for the linear law.
    pub stiffness: Option<f64>,
    /// Speed after a central blow over that before, 0 to 1.
    pub restitution: Option<f64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Force over speed, for viscous friction.
    pub viscosity: Option<f64>,
    /// Stiffness in the plane of contact over that along the normal, for the linear law with friction; 0.8 without.
    pub shear: Option<f64>,
    /// Coefficient of resistance to rolling.
    pub rolling: Option<f64>,
    /// Stress, or with jkr the work of adhesion per area.
    pub cohesion: Option<f64>,
}

/// A clump.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TemplatePart {
    /// A single sphere of this radius.
    pub ball: Option<f64>,
    /// A built-in particle (`morula sample --list`).
    pub shape: Option<String>,
    /// Its parameters.
    #[serde(default)]
    pub set: BTreeMap<String, f64>,
    /// Edges around it.
    #[serde(default = "edges")]
    pub segments: usize,
    /// A mesh or voxel file instead.
    pub file: Option<String>,
    /// Or given spheres, of which the body is the union: a file of a clump, in any format that `morula export` writes.
    pub spheres_file: Option<String>,
    /// Or a flat grid of equal spheres.
    pub grid: Option<GridPart>,
    /// What its lengths are multiplied by.
    #[serde(default = "one")]
    pub scale: f64,
    /// What the lengths of a built-in particle are multiplied by along x, y, z, beside that.
    pub stretch: Option<[f64; 3]>,
    /// Cells of the grid along the longest edge.
    #[serde(default = "cells")]
    pub cells: u32,
    /// How its clump is made.
    #[serde(default)]
    pub method: MethodName,
    /// How long that looks for it.
    #[serde(default)]
    pub effort: EffortName,
    /// Spheres.
    #[serde(default = "fifty")]
    pub spheres: usize,
    /// Whether the union of the spheres has the volume of the shape.
    #[serde(default)]
    pub equal_volume: bool,
    /// Mass per volume.
    pub density: f64,
    /// Whose mass and inertia it has.
    #[serde(default)]
    pub inertia: TargetName,
    /// The material of bodies that are made of it.
    pub material: String,
}

/// Equal spheres in rows and columns, their centres in the plane z = 0.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridPart {
    /// Along x, and along y.
    pub count: [u32; 2],
    /// From centre to centre.
    pub spacing: f64,
    /// Of each sphere.
    pub radius: f64,
}

fn edges() -> usize {
    64
}

fn cells() -> u32 {
    128
}

fn fifty() -> usize {
    50
}

/// Methods of making clumps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MethodName {
    /// Least mismatch.
    #[default]
    Best,
    /// Maxima of the distance transform.
    Mss,
    /// No sphere beyond the surface.
    Inscribed,
    /// Greedy set cover.
    Cover,
}

/// How long a method looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EffortName {
    /// Short.
    Draft,
    /// As usual.
    #[default]
    Normal,
    /// Long.
    Thorough,
}

/// Whose mass, centre and inertia.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TargetName {
    /// Of the true shape.
    #[default]
    Solid,
    /// Of the union of the spheres.
    Union,
    /// Of a built-in particle by its formulas, without the facets of its mesh.
    Exact,
}

/// A body.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyPart {
    /// Name of its template.
    pub template: String,
    /// Where its centre of mass is.
    pub position: [f64; 3],
    /// Its body axes in space, `w, x, y, z`, of any length but 0.
    #[serde(default = "upright")]
    pub rotation: [f64; 4],
    /// Velocity of the centre.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Angular velocity, along the axes of space.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
    /// Whether it keeps its velocity whatever pushes it, and does not turn.
    #[serde(default)]
    pub fixed: bool,
}

fn upright() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

/// Bodies that come in random poses that overlap nothing.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InsertionPart {
    /// Names of the templates, of one material, to choose from.
    pub templates: Vec<String>,
    /// Where their centres may be.
    #[serde(rename = "box")]
    pub cuboid: Option<BoxPart>,
    /// Or an upright cylinder: the middle of its lower end, radius, height.
    pub cylinder: Option<UprightPart>,
    /// Their velocity.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// How many in all.
    pub total: u64,
    /// How many at a time: the least and the most.
    #[serde(default = "one_by_one")]
    pub at_once: [u64; 2],
    /// Time between two batches.
    pub every: f64,
    /// Poses tried for each body; those without room come with the next batch.
    #[serde(default = "hundred")]
    pub attempts: u32,
}

fn one_by_one() -> [u64; 2] {
    [1, 1]
}

fn hundred() -> u32 {
    100
}

/// An upright cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct UprightPart {
    pub center: [f64; 3],
    pub radius: f64,
    pub height: f64,
}

/// A wall: one of its shapes, a material, a motion.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WallPart {
    /// Bodies are where normal · x > offset.
    pub plane: Option<PlanePart>,
    /// A box around the bodies.
    #[serde(rename = "box")]
    pub cuboid: Option<BoxPart>,
    /// A cylinder around the bodies.
    pub cylinder: Option<CylinderPart>,
    /// Triangles, touched on both sides.
    pub mesh: Option<MeshPart>,
    /// Name of its material.
    pub material: String,
    /// It moves with this velocity.
    pub slide: Option<[f64; 3]>,
    /// Its surface moves with this velocity, the wall stays.
    pub convey: Option<[f64; 3]>,
    /// It moves to and fro.
    pub shake: Option<ShakePart>,
    /// It turns.
    pub turn: Option<TurnPart>,
}

/// A plane.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct PlanePart {
    pub normal: [f64; 3],
    pub offset: f64,
}

/// A box by its corners.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct BoxPart {
    pub lo: [f64; 3],
    pub hi: [f64; 3],
}

/// A cylinder; with a length it has ends.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct CylinderPart {
    pub center: [f64; 3],
    pub axis: [f64; 3],
    pub radius: f64,
    pub length: Option<f64>,
}

/// A mesh: a file, or a built-in particle.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct MeshPart {
    pub file: Option<String>,
    pub shape: Option<String>,
    #[serde(default)]
    pub set: BTreeMap<String, f64>,
    #[serde(default = "edges")]
    pub segments: usize,
    #[serde(default = "one")]
    pub scale: f64,
}

/// amplitude sin(2π frequency t).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct ShakePart {
    pub amplitude: [f64; 3],
    pub frequency: f64,
}

/// Turns about an axis, by an angle in a unit of time.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct TurnPart {
    pub center: [f64; 3],
    pub axis: [f64; 3],
    pub rate: f64,
    /// Whether the wall is a body of revolution about that axis, as a drum is.
    #[serde(default)]
    pub spin: bool,
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
