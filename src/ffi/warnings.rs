//! What limits a clump: numbers, figures and sentences.

use super::choices::*;
use super::clump::morula_clump;
use super::guard::{borrow, copy_out, copy_text, guard, require};
use super::shape::put;
use crate::clump::{Limit, Warning};
use crate::error::{Error, Result, collected, count};
use std::ffi::c_char;

/// The number of a limit.
fn number(limit: Limit) -> i32 {
    match limit {
        Limit::FewerSpheres => MORULA_WARNING_FEWER_SPHERES,
        Limit::FarAway => MORULA_WARNING_FAR_AWAY,
        Limit::InexactTarget => MORULA_WARNING_INEXACT_TARGET,
        Limit::Thin => MORULA_WARNING_THIN,
        Limit::CoarseOverlap => MORULA_WARNING_COARSE_OVERLAP,
        Limit::CoarseDistance => MORULA_WARNING_COARSE_DISTANCE,
    }
}

/// How many limits of the method, of the numbers or of the measure a clump meets; mostly 0.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_warning_count(
    clump: *const morula_clump,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let clump = unsafe { borrow(clump, "clump")? };
        unsafe { put(count, clump.inner.warnings.len(), "count") }
    })
}

/// Copies what limits a clump: of each limit its number, the figure found and the bound that it misses.
///
/// Parameters: `codes`, `figures` and `bounds` have room for `capacity` numbers each; the codes are
/// of MORULA_WARNING_*.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written); OUT_OF_MEMORY.
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_copy_warnings(
    clump: *const morula_clump,
    capacity: usize,
    codes: *mut i32,
    figures: *mut f64,
    bounds: *mut f64,
) -> i32 {
    guard(|| {
        let all = unsafe { &borrow(clump, "clump")?.inner.warnings };
        if !all.is_empty() {
            require(codes, "codes")?;
            require(figures, "figures")?;
            require(bounds, "bounds")?;
        }
        let of = |f: fn(&Warning) -> f64| collected("warnings", all.iter().map(f));
        let numbers: Vec<i32> = collected("warnings", all.iter().map(|w| number(w.limit)))?;
        let (found, missed) = (of(|w| w.figure)?, of(|w| w.bound)?);
        unsafe {
            copy_out(&numbers, capacity, codes, "codes")?;
            copy_out(&found, capacity, figures, "figures")?;
            copy_out(&missed, capacity, bounds, "bounds")
        }
    })
}

/// Copies the sentence of warning `index` (counted from 0) with its closing NUL.
///
/// Parameters: `text`, `capacity` and `length` as morula_clump_copy_note().
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_clump_copy_warning(
    clump: *const morula_clump,
    index: usize,
    capacity: usize,
    text: *mut c_char,
    length: *mut usize,
) -> i32 {
    guard(|| {
        let all = unsafe { &borrow(clump, "clump")?.inner.warnings };
        let one: Result<&Warning> = all.get(index).ok_or_else(|| {
            let n = count(all.len() as u64, "warning");
            Error::IndexOutOfRange(format!("there is no warning {index} of {n}"))
        });
        unsafe { copy_text(&one?.to_string(), capacity, text, length) }
    })
}

/// The word for a MORULA_WARNING_* number ("far away").
///
/// Returns: static text, never NULL ("unknown" for other numbers); do not free it.
/// Threads: any thread at any time. Never fails.
#[unsafe(no_mangle)]
pub extern "C" fn morula_warning_name(warning: i32) -> *const c_char {
    let name = match warning {
        MORULA_WARNING_FEWER_SPHERES => c"fewer spheres",
        MORULA_WARNING_FAR_AWAY => c"far away",
        MORULA_WARNING_INEXACT_TARGET => c"inexact target",
        MORULA_WARNING_THIN => c"thin",
        MORULA_WARNING_COARSE_OVERLAP => c"coarse overlap",
        MORULA_WARNING_COARSE_DISTANCE => c"coarse distance",
        _ => c"unknown",
    };
    name.as_ptr()
}
