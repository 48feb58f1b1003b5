//! Clumps.

use super::one;
use serde::Deserialize;
use std::collections::BTreeMap;

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
    /// Edges around it; 64 without.
    pub segments: Option<usize>,
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
    /// Cells of the grid along the longest edge; 128 without.
    pub cells: Option<u32>,
    /// How its clump is made.
    pub method: Option<MethodName>,
    /// How long that looks for it.
    pub effort: Option<EffortName>,
    /// Spheres; 50 without.
    pub spheres: Option<usize>,
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

pub(in crate::dem::scene) fn edges() -> usize {
    64
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
