//! Shapes from files and from the bytes of files.

#[cfg(feature = "io")]
use super::choices::*;
use super::guard::{guard, require, slice, text};
use super::options::init;
#[cfg(feature = "io")]
use super::options::read;
use super::shape::morula_shape;
#[cfg(feature = "io")]
use super::shape::{give_shape, import, reserved};
use super::structs::*;
use crate::error::{Error, Result};
#[cfg(feature = "io")]
use crate::shape::{
    Shape,
    read::{FileOptions, Format, Meaning, RawType},
    voxels::Threshold,
};
use std::ffi::c_char;

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_file_options_init(
    options: *mut morula_file_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// Makes a shape from a file: STL, OBJ, PLY, OFF, npy, TIFF or raw voxels.
///
/// The format is told by the content, then by the name, unless the options
/// force one. What a header declares is checked against the file's length
/// before memory is taken.
///
/// Parameters: `path` is the file's name (UTF-8); `import` and `file` may be
/// NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option); IO;
/// FORMAT (with the byte or line); UNSUPPORTED; STRUCT_SIZE; NOT_FINITE;
/// INDEX_OUT_OF_RANGE; EMPTY; ZERO_VOLUME; OPEN_SURFACE; SEVERAL_BODIES;
/// TOO_LARGE; MEMORY_LIMIT; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: free *shape with morula_shape_free(). *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_file(
    path: *const c_char,
    import: *const morula_import_options,
    file: *const morula_file_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    guard(|| {
        require(shape, "shape")?;
        let path = unsafe { text(path, "path")? };
        unsafe { read_file(Source::Path(path), import, file, shape) }
    })
}

/// Makes a shape from the bytes of a file in memory, as morula_shape_from_file().
///
/// Parameters: `bytes` holds `count` bytes; `name` is the file's name, which
/// helps where the content does not tell the format (may be NULL); `import` and
/// `file` may be NULL for the defaults.
/// Returns: as morula_shape_from_file(), but never IO.
/// Ownership: the bytes are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_bytes(
    bytes: *const u8,
    count: usize,
    name: *const c_char,
    import: *const morula_import_options,
    file: *const morula_file_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    guard(|| {
        require(shape, "shape")?;
        let bytes = unsafe { slice(bytes, count, "bytes")? };
        let name = if name.is_null() { "" } else { unsafe { text(name, "name")? } };
        unsafe { read_file(Source::Bytes(bytes, name), import, file, shape) }
    })
}

enum Source<'a> {
    Path(&'a str),
    Bytes(&'a [u8], &'a str),
}

#[cfg(not(feature = "io"))]
unsafe fn read_file(
    source: Source,
    _: *const morula_import_options,
    _: *const morula_file_options,
    _: *mut *mut morula_shape,
) -> Result<()> {
    let what = match source {
        Source::Path(path) => path.to_owned(),
        Source::Bytes(bytes, name) => format!("{} bytes named \"{name}\"", bytes.len()),
    };
    Err(Error::Unsupported(format!("{what}: this build of the library reads no files")))
}

#[cfg(feature = "io")]
unsafe fn read_file(
    source: Source,
    import_options: *const morula_import_options,
    file: *const morula_file_options,
    shape: *mut *mut morula_shape,
) -> Result<()> {
    let (import, run, _) = unsafe { import(import_options)? };
    let o = unsafe { read(file)? };
    reserved("file", o.reserved)?;
    let wrong = |name: &str, value: i32| {
        Err(Error::InvalidArgument(format!("{name} is {value}, no choice")))
    };
    let format = match o.format {
        MORULA_FORMAT_AUTO => None,
        MORULA_FORMAT_STL => Some(Format::Stl),
        MORULA_FORMAT_OBJ => Some(Format::Obj),
        MORULA_FORMAT_PLY => Some(Format::Ply),
        MORULA_FORMAT_OFF => Some(Format::Off),
        MORULA_FORMAT_NPY => Some(Format::Npy),
        MORULA_FORMAT_TIFF => Some(Format::Tiff),
        MORULA_FORMAT_RAW => Some(Format::Raw),
        other => return wrong("format", other),
    };
    let meaning = match o.meaning {
        MORULA_MEANING_AUTO => Meaning::Auto,
        MORULA_MEANING_OTSU => Meaning::Grey(Threshold::Otsu),
        MORULA_MEANING_ABOVE => Meaning::Grey(super::voxels::above(o.threshold)?),
        MORULA_MEANING_LABEL => Meaning::Label(o.label),
        other => return wrong("meaning", other),
    };
    let raw_type = match o.raw_type {
        MORULA_RAW_U8 => RawType::U8,
        MORULA_RAW_U16 => RawType::U16,
        MORULA_RAW_F32 => RawType::F32,
        other => return wrong("raw_type", other),
    };
    let size = |v: u64| {
        usize::try_from(v)
            .map_err(|_| Error::TooLarge(format!("{v} is more than memory can address")))
    };
    let raw = if format == Some(Format::Raw) {
        let [x, y, z] = o.raw_dims;
        Some(([size(x)?, size(y)?, size(z)?], raw_type, size(o.raw_skip)?))
    } else {
        None
    };
    let npy_xyz = match o.npy_xyz {
        0 => false,
        1 => true,
        other => return wrong("npy_xyz", other),
    };
    super::voxels::check_layout(o.spacing, o.origin)?;
    let options =
        FileOptions { import, format, meaning, spacing: o.spacing, origin: o.origin, npy_xyz, raw };
    let made = match source {
        Source::Path(path) => Shape::from_file(std::path::Path::new(path), &options, &run)?,
        Source::Bytes(bytes, name) => Shape::from_bytes(bytes, name, &options, &run)?,
    };
    unsafe { give_shape(shape, made, &run) };
    Ok(())
}
