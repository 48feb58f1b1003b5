//! File formats. The format is told by content, then by name; what a header
//! declares is checked against what is really there before anything is reserved.

mod detect;
mod npy;
mod numbers;
mod obj;
mod off;
mod ply;
mod polygon;
mod raw;
mod reading;
mod stl;
mod text;
mod tiff;
mod voxels;

use super::voxels::{LabelInfo, Threshold, list_labels};
use super::{ImportOptions, Layout, Shape};
use crate::error::{Error, Result, reserve};
use crate::run::{Run, Stage};
use reading::Reading;
use std::io::Read;
use std::path::Path;

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
    /// Raw bytes: needs [`FileOptions::raw`].
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
    /// One value, or 0 and another: anything but 0 is solid. Other data are grey and
    /// thresholded by Otsu.
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
    /// One sentence for each conversion of the values.
    pub notes: Vec<String>,
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

impl RawValues {
    /// How many there are.
    fn len(&self) -> usize {
        match self {
            RawValues::U8(v) => v.len(),
            RawValues::U16(v) => v.len(),
            RawValues::U32(v) => v.len(),
            RawValues::F32(v) => v.len(),
        }
    }

    /// What they take.
    fn bytes(&self) -> u64 {
        let each = match self {
            RawValues::U8(_) => 1,
            RawValues::U16(_) => 2,
            RawValues::U32(_) | RawValues::F32(_) => 4,
        };
        each * self.len() as u64
    }
}

/// What a file holds.
enum Raw {
    Mesh(RawMesh),
    Voxels(RawVoxels),
}

impl Shape {
    /// A shape from the bytes of a file; `name` helps where content does not tell.
    ///
    /// The memory limit holds for all arrays that are there at one time.
    pub fn from_bytes(bytes: &[u8], name: &str, options: &FileOptions, run: &Run) -> Result<Shape> {
        let raw = run.time(Stage::Read, || read(bytes, name, options, 0, run))?;
        shape(raw, options, run)
    }

    /// A shape from a file. The file itself counts towards the memory limit.
    pub fn from_file(path: &Path, options: &FileOptions, run: &Run) -> Result<Shape> {
        let raw = run.time(Stage::Read, || {
            let bytes = load(path, options.import.memory_limit, run)?;
            read(&bytes, &name_of(path), options, bytes.len() as u64, run)
        })?;
        shape(raw, options, run)
    }
}

fn shape(raw: Raw, options: &FileOptions, run: &Run) -> Result<Shape> {
    match raw {
        Raw::Mesh(m) => {
            Shape::from_read_mesh(&m.vertices, &m.faces, &options.import, m.bytes(), run)
        }
        Raw::Voxels(v) => voxels::shape(v, options, run),
    }
}

fn name_of(path: &Path) -> std::borrow::Cow<'_, str> {
    path.file_name().map(|n| n.to_string_lossy()).unwrap_or_default()
}

/// The labels of a label volume in a file, ascending, without 0; [`Meaning::Label`]
/// takes one of them. The meaning in the options plays no part.
pub fn file_labels(path: &Path, options: &FileOptions, run: &Run) -> Result<Vec<LabelInfo>> {
    let name = name_of(path);
    let raw = {
        let bytes = load(path, options.import.memory_limit, run)?;
        read(&bytes, &name, options, bytes.len() as u64, run)?
    };
    labels(raw, &name, options, run)
}

/// The labels of a label volume in the bytes of a file, as [`file_labels`].
pub fn bytes_labels(
    bytes: &[u8],
    name: &str,
    options: &FileOptions,
    run: &Run,
) -> Result<Vec<LabelInfo>> {
    labels(read(bytes, name, options, 0, run)?, name, options, run)
}

fn labels(raw: Raw, name: &str, options: &FileOptions, run: &Run) -> Result<Vec<LabelInfo>> {
    run.check(0.5, "listing the labels")?;
    match raw {
        Raw::Voxels(v) => {
            list_labels(&voxels::labels(v.values, options.import.memory_limit)?, &v.layout)
        }
        Raw::Mesh(_) => {
            let name = if name.is_empty() { "the file" } else { name };
            Err(Error::InvalidArgument(format!("{name} is a mesh: it has no labels")))
        }
    }
}

/// Reads; `held`: bytes of the limit that are taken already.
fn read(bytes: &[u8], name: &str, options: &FileOptions, held: u64, run: &Run) -> Result<Raw> {
    let format = match options.format {
        Some(format) => format,
        None => detect::format(bytes, name, options.raw.is_some())?,
    };
    if bytes.is_empty() {
        return Err(detect::empty(name));
    }
    let reading = Reading { run, limit: options.import.memory_limit, held };
    match format {
        Format::Stl => stl::read(bytes, &reading).map(Raw::Mesh),
        Format::Obj => obj::read(bytes, &reading).map(Raw::Mesh),
        Format::Ply => ply::read(bytes, &reading).map(Raw::Mesh),
        Format::Off => off::read(bytes, &reading).map(Raw::Mesh),
        Format::Npy | Format::Tiff | Format::Raw => {
            voxels::read(bytes, format, options, &reading).map(Raw::Voxels)
        }
    }
}

/// Bytes that are read between two questions whether to go on.
const PIECE: u64 = 1 << 24;

/// The bytes of a file no larger than `limit`.
fn load(path: &Path, limit: u64, run: &Run) -> Result<Vec<u8>> {
    let fail = |e: std::io::Error| Error::Io(format!("{} cannot be read: {e}", path.display()));
    let file = std::fs::File::open(path).map_err(fail)?;
    let size = file.metadata().map_err(fail)?.len();
    let refuse = |size: String| {
        Err(Error::MemoryLimit(format!(
            "{} has {size} bytes, the limit is {limit}",
            path.display()
        )))
    };
    if size > limit {
        return refuse(size.to_string());
    }
    let mut bytes = reserve("the file", usize::try_from(size).unwrap_or(usize::MAX))?;
    // What is not a plain file may hold more than it says.
    loop {
        run.check(0.0, "reading the file")?;
        let most = (limit.saturating_add(1) - bytes.len() as u64).min(PIECE);
        let got = (&file).take(most).read_to_end(&mut bytes).map_err(fail)?;
        if bytes.len() as u64 > limit {
            return refuse(format!("more than {limit}"));
        }
        if got == 0 {
            return Ok(bytes);
        }
    }
}
