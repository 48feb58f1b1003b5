//! File formats. The format is told by content, then by name; what a header
//! declares is checked against what is really there before anything is reserved.

use super::voxels::Threshold;
use super::{ImportOptions, Layout, Shape};
use crate::error::{Error, Result};
use crate::run::Run;

/// A file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// STL, ascii or binary.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// PLY, ascii or binary.
    Ply,
    /// OFF, COFF, NOFF.
    Off,
    /// NumPy array.
    Npy,
    /// Multi-page TIFF.
    Tiff,
    /// Raw bytes: needs [`RawLayout`].
    Raw,
}

/// The element type of raw data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RawType {
    /// 8-bit unsigned.
    U8,
    /// 16-bit unsigned, little-endian.
    U16,
    /// 32-bit float, little-endian.
    F32,
}

/// How voxel files are understood.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meaning {
    /// Two values: anything but 0 is solid. Grey data (more than two values) is thresholded by Otsu.
    Auto,
    /// Grey values with a threshold.
    Grey(Threshold),
    /// A label volume, and which label.
    Label(u32),
}

/// How a file is read.
#[derive(Debug, Clone, PartialEq)]
pub struct FileOptions {
    /// How the shape is taken in.
    pub import: ImportOptions,
    /// Force a format instead of telling it by content.
    pub format: Option<Format>,
    /// How voxel values are understood.
    pub meaning: Meaning,
    /// Spacing of voxels along x, y, z (before `length_unit`).
    pub spacing: [f64; 3],
    /// Lower corner of the first voxel (before `length_unit`).
    pub origin: [f64; 3],
    /// An npy array of shape (a, b, c) is taken as (z, y, x); `true`: as (x, y, z).
    pub npy_xyz: bool,
    /// Dimensions (x fastest), element type and header bytes to skip, for raw data.
    pub raw: Option<([usize; 3], RawType, usize)>,
}

impl Default for FileOptions {
    fn default() -> Self {
        FileOptions {
            import: ImportOptions::default(),
            format: None,
            meaning: Meaning::Auto,
            spacing: [1.0; 3],
            origin: [0.0; 3],
            npy_xyz: false,
            raw: None,
        }
    }
}

/// A triangle mesh as a file holds it: nothing checked but indices and numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RawMesh {
    /// Vertices as x, y, z.
    pub vertices: Vec<[f64; 3]>,
    /// 0-based vertex indices.
    pub faces: Vec<[u32; 3]>,
}

/// A voxel array as a file holds it, x fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct RawVoxels {
    /// Dimensions, spacing, origin.
    pub layout: Layout,
    /// Values.
    pub values: RawValues,
}

/// The values of a voxel file, by element type.
#[derive(Debug, Clone, PartialEq)]
pub enum RawValues {
    /// 8-bit unsigned or boolean.
    U8(Vec<u8>),
    /// 16-bit unsigned.
    U16(Vec<u16>),
    /// 32-bit unsigned (labels).
    U32(Vec<u32>),
    /// Floating point.
    F32(Vec<f32>),
}

impl Shape {
    /// A shape from the bytes of a file; `name` helps where content does not tell.
    pub fn from_bytes(bytes: &[u8], name: &str, options: &FileOptions, run: &Run) -> Result<Shape> {
        let _ = (bytes, name, options, run);
        Err(Error::Internal("files are not read yet".into()))
    }

    /// A shape from a file.
    pub fn from_file(path: &std::path::Path, options: &FileOptions, run: &Run) -> Result<Shape> {
        let _ = (path, options, run);
        Err(Error::Internal("files are not read yet".into()))
    }
}
