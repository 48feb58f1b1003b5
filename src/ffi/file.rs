//! Shapes from files and from the bytes of files.

#[cfg(feature = "io")]
use super::choices::*;
use super::guard::{guard, require, slice, text};
use super::options::init;
#[cfg(feature = "io")]
use super::options::read;
use super::shape::{give_shape, morula_shape, put};
#[cfg(feature = "io")]
use super::shape::{import, reserved};
use super::structs::*;
use super::voxels::LabelArrays;
use crate::error::{Error, Result};
use crate::run::Run;
use crate::shape::Shape;
#[cfg(feature = "io")]
use crate::shape::read::{FileOptions, Format, Meaning, RawType, bytes_labels, file_labels};
use crate::shape::voxels::LabelInfo;
#[cfg(feature = "io")]
use crate::shape::voxels::Threshold;
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
        let (made, run) = unsafe { Source::Path(path).shape(import, file)? };
        unsafe { give_shape(shape, made, &run) };
        Ok(())
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
        let (made, run) = unsafe { of_bytes(bytes, count, name)?.shape(import, file)? };
        unsafe { give_shape(shape, made, &run) };
        Ok(())
    })
}

/// Lists the labels of a label volume in a file, ascending, without 0;
/// morula_shape_from_file() makes a shape of one of them with the meaning
/// MORULA_MEANING_LABEL. The file is read as by that function; values of 8 or 16
/// bits or whole floating-point numbers are labels as well.
///
/// Parameters: `path` is the file's name (UTF-8); `import` (memory_limit,
/// progress) and `file` (not its meaning) may be NULL for the defaults;
/// `capacity`, `ids`, `cells`, `boxes`, `touches_border` as
/// morula_labels_copy(), and with all of the arrays NULL the labels are only
/// counted; `count` becomes their number.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option, a mesh,
/// or a value that is no label); BUFFER_TOO_SMALL (nothing is written); IO;
/// FORMAT (with the byte); UNSUPPORTED; STRUCT_SIZE; EMPTY; TOO_LARGE;
/// MEMORY_LIMIT; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_labels_from_file(
    path: *const c_char,
    import: *const morula_import_options,
    file: *const morula_file_options,
    capacity: usize,
    ids: *mut u32,
    cells: *mut u64,
    boxes: *mut u64,
    touches_border: *mut i32,
    count: *mut usize,
) -> i32 {
    guard(|| {
        require(count, "count")?;
        let path = unsafe { text(path, "path")? };
        let all = unsafe { Source::Path(path).labels(import, file)? };
        let to = LabelArrays { capacity, ids, cells, boxes, touches_border };
        unsafe { put_labels(&all, to, count) }
    })
}

/// Lists the labels of a label volume in the bytes of a file in memory, as
/// morula_labels_from_file().
///
/// Parameters: `bytes` holds `byte_count` bytes; `name` is the file's name, which
/// helps where the content does not tell the format (may be NULL); the others as
/// morula_labels_from_file().
/// Returns: as morula_labels_from_file(), but never IO.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_labels_from_bytes(
    bytes: *const u8,
    byte_count: usize,
    name: *const c_char,
    import: *const morula_import_options,
    file: *const morula_file_options,
    capacity: usize,
    ids: *mut u32,
    cells: *mut u64,
    boxes: *mut u64,
    touches_border: *mut i32,
    count: *mut usize,
) -> i32 {
    guard(|| {
        require(count, "count")?;
        let all = unsafe { of_bytes(bytes, byte_count, name)?.labels(import, file)? };
        let to = LabelArrays { capacity, ids, cells, boxes, touches_border };
        unsafe { put_labels(&all, to, count) }
    })
}

/// Writes the labels that are asked for and how many there are.
unsafe fn put_labels(all: &[LabelInfo], to: LabelArrays, count: *mut usize) -> Result<()> {
    if to.any() {
        unsafe { to.put(all)? };
    }
    unsafe { put(count, all.len(), "count") }
}

/// What is read.
enum Source<'a> {
    Path(&'a str),
    Bytes(&'a [u8], &'a str),
}

unsafe fn of_bytes<'a>(bytes: *const u8, count: usize, name: *const c_char) -> Result<Source<'a>> {
    let bytes = unsafe { slice(bytes, count, "bytes")? };
    let name = if name.is_null() { "" } else { unsafe { text(name, "name")? } };
    Ok(Source::Bytes(bytes, name))
}

#[cfg(not(feature = "io"))]
impl Source<'_> {
    unsafe fn shape<'r>(
        &self,
        _: *const morula_import_options,
        _: *const morula_file_options,
    ) -> Result<(Shape, Run<'r>)> {
        Err(self.unread())
    }

    unsafe fn labels(
        &self,
        _: *const morula_import_options,
        _: *const morula_file_options,
    ) -> Result<Vec<LabelInfo>> {
        Err(self.unread())
    }

    fn unread(&self) -> Error {
        let what = match self {
            Source::Path(path) => (*path).to_owned(),
            Source::Bytes(bytes, name) => format!("{} bytes named \"{name}\"", bytes.len()),
        };
        Error::Unsupported(format!("{what}: this build of the library reads no files"))
    }
}

#[cfg(feature = "io")]
impl Source<'_> {
    unsafe fn shape<'r>(
        &self,
        import: *const morula_import_options,
        file: *const morula_file_options,
    ) -> Result<(Shape, Run<'r>)> {
        let (options, run) = unsafe { options(import, file)? };
        let made = match self {
            Source::Path(path) => Shape::from_file(path.as_ref(), &options, &run)?,
            Source::Bytes(bytes, name) => Shape::from_bytes(bytes, name, &options, &run)?,
        };
        Ok((made, run))
    }

    unsafe fn labels(
        &self,
        import: *const morula_import_options,
        file: *const morula_file_options,
    ) -> Result<Vec<LabelInfo>> {
        let (options, run) = unsafe { options(import, file)? };
        match self {
            Source::Path(path) => file_labels(path.as_ref(), &options, &run),
            Source::Bytes(bytes, name) => bytes_labels(bytes, name, &options, &run),
        }
    }
}

/// The caller's options as the library's, and the run of the call.
#[cfg(feature = "io")]
unsafe fn options<'a>(
    import_options: *const morula_import_options,
    file: *const morula_file_options,
) -> Result<(FileOptions, Run<'a>)> {
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
    Ok((options, run))
}
