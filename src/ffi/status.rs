//! Statuses, version and the thread's message.

use super::guard;
use super::options::size_of_struct;
use std::ffi::c_char;

/// The call did what it was asked.
pub const MORULA_STATUS_OK: i32 = 0;
/// A pointer that must not be NULL is NULL.
pub const MORULA_STATUS_NULL_POINTER: i32 = 1;
/// An option or argument lies outside its range.
pub const MORULA_STATUS_INVALID_ARGUMENT: i32 = 2;
/// A coordinate or value is NaN or infinite.
pub const MORULA_STATUS_NOT_FINITE: i32 = 3;
/// A triangle, label or sphere index does not exist.
pub const MORULA_STATUS_INDEX_OUT_OF_RANGE: i32 = 4;
/// There is nothing to work on: no face, no solid cell.
pub const MORULA_STATUS_EMPTY: i32 = 5;
/// The shape has no volume.
pub const MORULA_STATUS_ZERO_VOLUME: i32 = 6;
/// The surface is so open that its inside is not defined.
pub const MORULA_STATUS_OPEN_SURFACE: i32 = 7;
/// The shape is several disconnected bodies and the choice was to refuse.
pub const MORULA_STATUS_SEVERAL_BODIES: i32 = 8;
/// A file is malformed or truncated, or its header lies.
pub const MORULA_STATUS_FORMAT: i32 = 9;
/// A file or request of a kind that this build does not handle.
pub const MORULA_STATUS_UNSUPPORTED: i32 = 10;
/// The operating system refused to read or write.
pub const MORULA_STATUS_IO: i32 = 11;
/// The work would take more memory than the option allows.
pub const MORULA_STATUS_MEMORY_LIMIT: i32 = 12;
/// The system has no memory left for a reservation.
pub const MORULA_STATUS_OUT_OF_MEMORY: i32 = 13;
/// The caller's array is too short; nothing was written to it.
pub const MORULA_STATUS_BUFFER_TOO_SMALL: i32 = 14;
/// The progress callback asked to stop before there was a result.
pub const MORULA_STATUS_CANCELLED: i32 = 15;
/// A struct's struct_size is one that this library does not know, or bytes that it does not know are not zero.
pub const MORULA_STATUS_STRUCT_SIZE: i32 = 16;
/// A count is larger than the library can index.
pub const MORULA_STATUS_TOO_LARGE: i32 = 17;
/// The value asked for was not among the wants of the call that made the clump.
pub const MORULA_STATUS_NOT_WANTED: i32 = 18;
/// No sphere satisfies the constraints.
pub const MORULA_STATUS_NO_SPHERES: i32 = 19;
/// A defect of the library itself: please report it.
pub const MORULA_STATUS_INTERNAL: i32 = 20;
/// No masses of the spheres satisfy the constraints.
pub const MORULA_STATUS_NO_MASSES: i32 = 21;

/// The version of the library that runs: 1000000 major + 1000 minor + patch.
///
/// Returns: the number; it equals MORULA_VERSION when the program runs with the
/// library whose header it was compiled with.
/// Threads: any thread at any time. Never fails.
#[unsafe(no_mangle)]
pub extern "C" fn morula_version() -> u32 {
    const fn number(text: &str) -> u32 {
        let (mut value, mut i) = (0, 0);
        while i < text.len() {
            value = value * 10 + (text.as_bytes()[i] - b'0') as u32;
            i += 1;
        }
        value
    }
    const VERSION: u32 = 1_000_000 * number(env!("CARGO_PKG_VERSION_MAJOR"))
        + 1000 * number(env!("CARGO_PKG_VERSION_MINOR"))
        + number(env!("CARGO_PKG_VERSION_PATCH"));
    VERSION
}

/// The version of the library that runs, as text ("0.1.0").
///
/// Returns: static text, never NULL; do not free it.
/// Threads: any thread at any time. Never fails.
#[unsafe(no_mangle)]
pub extern "C" fn morula_version_string() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// The name of a status ("NOT_FINITE" for MORULA_STATUS_NOT_FINITE).
///
/// Returns: static text, never NULL ("UNKNOWN" for a number that is no status); do not free it.
/// Threads: any thread at any time. Never fails.
#[unsafe(no_mangle)]
pub extern "C" fn morula_status_name(status: i32) -> *const c_char {
    const NAMES: [&std::ffi::CStr; 22] = [
        c"OK",
        c"NULL_POINTER",
        c"INVALID_ARGUMENT",
        c"NOT_FINITE",
        c"INDEX_OUT_OF_RANGE",
        c"EMPTY",
        c"ZERO_VOLUME",
        c"OPEN_SURFACE",
        c"SEVERAL_BODIES",
        c"FORMAT",
        c"UNSUPPORTED",
        c"IO",
        c"MEMORY_LIMIT",
        c"OUT_OF_MEMORY",
        c"BUFFER_TOO_SMALL",
        c"CANCELLED",
        c"STRUCT_SIZE",
        c"TOO_LARGE",
        c"NOT_WANTED",
        c"NO_SPHERES",
        c"INTERNAL",
        c"NO_MASSES",
    ];
    let name = usize::try_from(status).ok().and_then(|i| NAMES.get(i));
    name.unwrap_or(&c"UNKNOWN").as_ptr()
}

/// One sentence on why this thread's last call failed, with the value and index
/// at fault; empty when it did not fail. Every call clears it on entry, except
/// the `_free`, `_name`, `_version` and `_sizeof` functions and this one.
///
/// Returns: text, never NULL, owned by the library and valid until this
/// thread's next call of the library; copy it to keep it.
/// Threads: each thread has its own message. Never fails.
#[unsafe(no_mangle)]
pub extern "C" fn morula_last_error_message() -> *const c_char {
    guard::message()
}

/// The size that the library gives one of its structs, for programs that are
/// not written in C to check their own declaration.
///
/// Parameters: `which` is one of MORULA_STRUCT_*.
/// Returns: the size in bytes, 0 for a number that names no struct.
/// Threads: any thread at any time. Never fails.
#[unsafe(no_mangle)]
pub extern "C" fn morula_sizeof(which: i32) -> usize {
    size_of_struct(which)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use std::ffi::CStr;

    #[test]
    fn every_error_has_the_status_of_its_name() {
        let s = String::new;
        let pairs = [
            (Error::NullPointer(s()), MORULA_STATUS_NULL_POINTER, "NULL_POINTER"),
            (Error::InvalidArgument(s()), MORULA_STATUS_INVALID_ARGUMENT, "INVALID_ARGUMENT"),
            (Error::NotFinite(s()), MORULA_STATUS_NOT_FINITE, "NOT_FINITE"),
            (Error::IndexOutOfRange(s()), MORULA_STATUS_INDEX_OUT_OF_RANGE, "INDEX_OUT_OF_RANGE"),
            (Error::Empty(s()), MORULA_STATUS_EMPTY, "EMPTY"),
            (Error::ZeroVolume(s()), MORULA_STATUS_ZERO_VOLUME, "ZERO_VOLUME"),
            (Error::OpenSurface(s()), MORULA_STATUS_OPEN_SURFACE, "OPEN_SURFACE"),
            (Error::SeveralBodies(s()), MORULA_STATUS_SEVERAL_BODIES, "SEVERAL_BODIES"),
            (Error::Format(s()), MORULA_STATUS_FORMAT, "FORMAT"),
            (Error::Unsupported(s()), MORULA_STATUS_UNSUPPORTED, "UNSUPPORTED"),
            (Error::Io(s()), MORULA_STATUS_IO, "IO"),
            (Error::MemoryLimit(s()), MORULA_STATUS_MEMORY_LIMIT, "MEMORY_LIMIT"),
            (Error::OutOfMemory(s()), MORULA_STATUS_OUT_OF_MEMORY, "OUT_OF_MEMORY"),
            (Error::BufferTooSmall(s()), MORULA_STATUS_BUFFER_TOO_SMALL, "BUFFER_TOO_SMALL"),
            (Error::Cancelled(s()), MORULA_STATUS_CANCELLED, "CANCELLED"),
            (Error::StructSize(s()), MORULA_STATUS_STRUCT_SIZE, "STRUCT_SIZE"),
            (Error::TooLarge(s()), MORULA_STATUS_TOO_LARGE, "TOO_LARGE"),
            (Error::NotWanted(s()), MORULA_STATUS_NOT_WANTED, "NOT_WANTED"),
            (Error::NoSpheres(s()), MORULA_STATUS_NO_SPHERES, "NO_SPHERES"),
            (Error::Internal(s()), MORULA_STATUS_INTERNAL, "INTERNAL"),
            (Error::NoMasses(s()), MORULA_STATUS_NO_MASSES, "NO_MASSES"),
        ];
        for (error, status, name) in pairs {
            assert_eq!(error.status(), status);
            assert_eq!(unsafe { CStr::from_ptr(morula_status_name(status)) }.to_str(), Ok(name));
        }
        for unknown in [-1, 22, i32::MAX, i32::MIN] {
            assert_eq!(unsafe { CStr::from_ptr(morula_status_name(unknown)) }, c"UNKNOWN");
        }
    }
}
