//! Files for DEM codes, on disk and in memory.

use super::body::{morula_body, weighed};
#[cfg(feature = "io")]
use super::choices::*;
use super::clump::morula_clump;
#[cfg(feature = "io")]
use super::guard::give;
use super::guard::{borrow, copy_out, copy_text, guard, require, take, text};
use super::mass_structs::{morula_export_options, morula_mass_options};
use super::options::init;
#[cfg(feature = "io")]
use super::options::read;
use super::shape::put;
#[cfg(feature = "io")]
use super::shape::reserved;
use crate::error::{Error, Result};
use std::ffi::c_char;

#[cfg(feature = "io")]
use crate::export::{ExportOptions, File, Format, Place, Record, files, save};

/// The files of a format in memory. Made by morula_body_export(), freed by morula_files_free().
pub struct morula_files {
    names: Vec<String>,
    bytes: Vec<Vec<u8>>,
}

#[cfg(feature = "io")]
unsafe fn made(
    body: &morula_body,
    format: i32,
    options: *const morula_export_options,
) -> Result<Vec<File>> {
    let o = unsafe { read(options)? };
    let format = match format {
        MORULA_EXPORT_MERCURY => Format::Mercury,
        MORULA_EXPORT_LAMMPS => Format::Lammps,
        MORULA_EXPORT_LAMMPS_RIGID => Format::LammpsRigid,
        MORULA_EXPORT_LIGGGHTS => Format::Liggghts,
        MORULA_EXPORT_YADE => Format::Yade,
        MORULA_EXPORT_DEME => Format::Deme,
        MORULA_EXPORT_MFIX => Format::Mfix,
        MORULA_EXPORT_KRATOS => Format::Kratos,
        MORULA_EXPORT_PFC => Format::Pfc,
        MORULA_EXPORT_EDEM => Format::Edem,
        MORULA_EXPORT_CSV => Format::Csv,
        MORULA_EXPORT_JSON => Format::Json,
        MORULA_EXPORT_VTP => Format::Vtp,
        MORULA_EXPORT_PLY => Format::Ply,
        MORULA_EXPORT_STL => Format::Stl,
        other => return Err(Error::InvalidArgument(format!("format is {other}, no choice"))),
    };
    let placed = match o.placed {
        0 => false,
        1 => true,
        other => {
            return Err(Error::InvalidArgument(format!("placed is {other}, neither 0 nor 1")));
        }
    };
    let name = if o.name.is_null() { "clump" } else { unsafe { text(o.name, "name")? } };
    let record = Record::new(name, &body.spheres, &body.masses.masses, &body.body)?;
    let single = match o.precision {
        MORULA_PRECISION_F64 => false,
        MORULA_PRECISION_F32 => true,
        other => return Err(Error::InvalidArgument(format!("precision is {other}, no choice"))),
    };
    reserved("export", o.reserved)?;
    let options =
        ExportOptions { length: o.length, mass: o.mass, placed, facets: o.facets, single };
    files(&record, format, &options)
}

#[cfg(not(feature = "io"))]
fn without() -> Result<()> {
    Err(Error::Unsupported("this build has no file formats".into()))
}

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_export_options_init(
    options: *mut morula_export_options,
    size: usize,
) -> i32 {
    guard(|| unsafe { init(options, size) })
}

/// Writes a weighed clump as the file or files that a DEM code reads. Each is written under another
/// name and renamed when all are whole; a device or a link stays what it is.
///
/// Parameters: `format` is one of MORULA_EXPORT_*; `options` may be NULL for the defaults; `path`
/// (UTF-8) names the file, for MORULA_EXPORT_MERCURY the folder.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option; a format that has no other
/// frame; spheres that single precision cannot hold); UNSUPPORTED (a clump of one sphere for LAMMPS; a build without file formats); IO (what
/// the system said, and nothing half-written); STRUCT_SIZE; TOO_LARGE; OUT_OF_MEMORY; INTERNAL.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_write(
    body: *const morula_body,
    format: i32,
    options: *const morula_export_options,
    path: *const c_char,
) -> i32 {
    guard(|| {
        let path = unsafe { text(path, "path")? };
        #[cfg(feature = "io")]
        return save(
            &unsafe { made(borrow(body, "body")?, format, options)? },
            std::path::Path::new(path),
        );
        #[cfg(not(feature = "io"))]
        {
            let _ = (body, format, options, path);
            without()
        }
    })
}

/// Weighs a clump and writes it, as morula_body_from_clump() and morula_body_write() do.
///
/// Parameters: `masses` and `options` may be NULL for the defaults; the rest as morula_body_write().
/// Returns: the statuses of morula_body_from_clump() and morula_body_write().
/// Threads: any thread; the clump is only read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_write(
    clump: *const morula_clump,
    masses: *const morula_mass_options,
    format: i32,
    options: *const morula_export_options,
    path: *const c_char,
) -> i32 {
    guard(|| {
        let path = unsafe { text(path, "path")? };
        let body = unsafe { weighed(clump, masses)? };
        #[cfg(feature = "io")]
        return save(&unsafe { made(&body, format, options)? }, std::path::Path::new(path));
        #[cfg(not(feature = "io"))]
        {
            let _ = (body, format, options, path);
            without()
        }
    })
}

/// Makes the same files in memory.
///
/// Parameters: as morula_body_write().
/// Returns: as morula_body_write(), but never IO.
/// Ownership: the body stays the caller's; free *files with morula_files_free(). *files is
/// written only on success.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_body_export(
    body: *const morula_body,
    format: i32,
    options: *const morula_export_options,
    files: *mut *mut morula_files,
) -> i32 {
    guard(|| {
        require(files, "files")?;
        #[cfg(feature = "io")]
        {
            let mut all = morula_files { names: Vec::new(), bytes: Vec::new() };
            for file in unsafe { made(borrow(body, "body")?, format, options)? } {
                all.names.push(match file.place {
                    Place::At => String::new(),
                    Place::Beside(ending) => format!(".{ending}"),
                    Place::Below(name) => name.into(),
                });
                all.bytes.push(file.bytes);
            }
            unsafe { give(files, all) };
            Ok(())
        }
        #[cfg(not(feature = "io"))]
        {
            let _ = (body, format, options);
            without()
        }
    })
}

/// How many files there are; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_files_count(files: *const morula_files, count: *mut usize) -> i32 {
    guard(|| {
        let files = unsafe { borrow(files, "files")? };
        unsafe { put(count, files.names.len(), "count") }
    })
}

fn one<T>(all: &[T], index: usize) -> Result<&T> {
    all.get(index).ok_or_else(|| {
        Error::IndexOutOfRange(format!("file {index} does not exist: there are {}", all.len()))
    })
}

/// Copies what a file's name adds to the path, with its closing NUL: nothing for the file itself, an ending
/// (".in") for what stands beside it, a path below the folder for the files of a folder.
///
/// Parameters: `index` from 0; `text` has room for `capacity` bytes; `length` (may be NULL) becomes
/// the length without the NUL. With `text` NULL and `capacity` 0 only `length` is written.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is
/// written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_files_copy_name(
    files: *const morula_files,
    index: usize,
    capacity: usize,
    text: *mut c_char,
    length: *mut usize,
) -> i32 {
    guard(|| {
        let files = unsafe { borrow(files, "files")? };
        unsafe { copy_text(one(&files.names, index)?, capacity, text, length) }
    })
}

/// How many bytes a file has.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_files_size(
    files: *const morula_files,
    index: usize,
    size: *mut usize,
) -> i32 {
    guard(|| {
        let files = unsafe { borrow(files, "files")? };
        unsafe { put(size, one(&files.bytes, index)?.len(), "size") }
    })
}

/// Copies the bytes of a file; text has no closing NUL.
///
/// Parameters: `bytes` has room for `capacity`.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is
/// written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_files_copy_bytes(
    files: *const morula_files,
    index: usize,
    capacity: usize,
    bytes: *mut u8,
) -> i32 {
    guard(|| {
        let files = unsafe { borrow(files, "files")? };
        unsafe { copy_out(one(&files.bytes, index)?, capacity, bytes, "bytes") }
    })
}

/// Takes the files back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_files_free(files: *mut morula_files) {
    unsafe { take(files) };
}
