//! Bodies and walls.

use super::one;
use super::templates::edges;
use serde::Deserialize;
use std::collections::BTreeMap;

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
