//! Triangle meshes from arrays.

use super::{ImportOptions, Shape};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::run::Run;

/// A triangle mesh after checks, in the unit frame.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// Vertices.
    pub vertices: Vec<Vec3>,
    /// Vertex indices of each face, counter-clockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
    /// Watertight, oriented and manifold at its edges: crossings along a line may be
    /// counted. Otherwise inside is decided by the winding number.
    pub clean: bool,
}

impl Mesh {
    /// The corners of face `i`.
    pub fn corners(&self, i: usize) -> [Vec3; 3] {
        self.faces[i].map(|v| self.vertices[v as usize])
    }
}

impl Shape {
    /// A shape from a triangle mesh: `vertices` as x, y, z in the caller's unit
    /// and frame, `faces` as 0-based vertex indices.
    pub fn from_mesh(
        vertices: &[[f64; 3]],
        faces: &[[u32; 3]],
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        let _ = (vertices, faces, options, run);
        Err(Error::Internal("meshes are not built yet".into()))
    }
}
