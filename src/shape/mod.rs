//! What the user hands in: meshes, voxels, labels, analytic particles, files;
//! checked, repaired where that is safe, or refused with the reason.

pub mod mesh;
pub mod primitive;
#[cfg(feature = "io")]
pub mod read;
pub mod report;
#[cfg(test)]
pub(crate) mod samples;
pub mod silhouettes;
pub mod voxels;

pub use mesh::Mesh;
pub use primitive::{Parameter, Primitive};
pub use report::Report;
pub use silhouettes::{Carve, Silhouette};
pub use voxels::{Layout, Voxels};

use crate::error::{Result, figure};
use crate::math::UnitFrame;
use std::sync::Arc;

/// What to do with a shape that is several disconnected bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Bodies {
    /// Refuse, with the count.
    #[default]
    Refuse,
    /// Keep the body of greatest volume, and say so in the report.
    Largest,
    /// Keep all of them as one particle.
    All,
}

/// How a shape is taken in.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportOptions {
    /// Vertices at open edges that are nearer to each other than this times the longest
    /// bounding-box edge, and than a quarter of the median edge of the faces, are one where that
    /// closes the surface further than welding equal ones does. 0: only equal ones.
    pub weld_tolerance: f64,
    /// The file's or array's length unit in the caller's unit: coordinates are multiplied by it.
    pub length_unit: f64,
    /// What to do with several bodies.
    pub bodies: Bodies,
    /// Most bytes that the shape's arrays may take.
    pub memory_limit: u64,
}

impl Default for ImportOptions {
    fn default() -> Self {
        ImportOptions {
            weld_tolerance: 1e-6,
            length_unit: 1.0,
            bodies: Bodies::Refuse,
            memory_limit: 2 << 30,
        }
    }
}

impl ImportOptions {
    /// What the report says of a length unit.
    fn unit_note(&self) -> Option<String> {
        let unit = self.length_unit;
        (unit != 1.0).then(|| format!("lengths were multiplied by {} on import", figure(unit)))
    }
}

/// The body of a shape, in the unit frame.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Body {
    /// A triangle mesh.
    Mesh(Mesh),
    /// Solid cells.
    Voxels(Voxels),
}

impl Body {
    /// Bytes of its arrays.
    pub(crate) fn bytes(&self) -> u64 {
        match self {
            Body::Mesh(mesh) => mesh.bytes(),
            Body::Voxels(v) => v.cells.len() as u64,
        }
    }

    /// Whether it is a body as checks leave them: for bytes that come from outside.
    pub(crate) fn check(&self) -> Result<()> {
        match self {
            Body::Mesh(mesh) => mesh.check(),
            Body::Voxels(voxels) => voxels.check(),
        }
    }
}

/// A checked shape: something with an inside.
#[derive(Debug, Clone)]
pub struct Shape {
    /// The body, in the unit frame; shared with the solids made from it.
    pub body: Arc<Body>,
    /// From the caller's frame to the unit frame.
    pub frame: UnitFrame,
    /// What was found and what was done about it, in the caller's frame.
    pub report: Report,
}
