//! What is fuzzed, through the C ABI as a host calls it. The targets of cargo-fuzz and the test that
//! replays their findings share it.
//!
//! No bytes may make the library panic (INTERNAL), give a status without a sentence, or give a number
//! that is none.

#![allow(
    unsafe_code,
    dead_code,
    unused_imports,
    clippy::unwrap_used,
    clippy::redundant_closure_call,
    missing_docs
)]

mod calls;
mod files;
mod reads;
mod serial;
mod series;
mod solver;

pub use calls::calls;
pub use files::{meshes, voxels};
pub use serial::serial;

use morula::ffi::*;
use std::cell::Cell;
use std::ffi::CStr;

/// Most bytes of a call; a small machine runs several at once.
const LIMIT: u64 = 64 << 20;

thread_local! {
    static MADE: Cell<u32> = const { Cell::new(0) };
}

/// How many things a body made of bytes.
pub fn made(body: fn(&[u8]), data: &[u8]) -> u32 {
    MADE.set(0);
    body(data);
    MADE.get()
}

/// Whether a call succeeded; the status and the sentence must be in order.
#[track_caller]
fn ok(status: i32) -> bool {
    let said = unsafe { CStr::from_ptr(morula_last_error_message()) }.to_str().unwrap();
    assert_eq!(status == MORULA_STATUS_OK, said.is_empty(), "status {status}: {said:?}");
    let known = (0..=MORULA_STATUS_NO_MASSES).contains(&status);
    assert!(known && status != MORULA_STATUS_INTERNAL, "status {status}: {said}");
    status == MORULA_STATUS_OK
}

/// A struct that the library fills.
fn sized<T>() -> T {
    let mut value: T = unsafe { std::mem::zeroed() };
    unsafe { (&raw mut value).cast::<usize>().write(size_of::<T>()) };
    value
}

#[track_caller]
fn finite(all: &[f64]) {
    assert!(all.iter().all(|x| x.is_finite()), "{all:?}");
}

#[track_caller]
fn moments_are_real(m: &morula_moments) {
    finite(&[m.volume, m.mass, m.relative_error]);
    for part in [&m.centre[..], &m.inertia, &m.principal, &m.rotation, &m.quaternion] {
        finite(part);
    }
}

#[track_caller]
fn spheres_are_real(xyzr: &[f64]) {
    finite(xyzr);
    assert!(xyzr.chunks(4).all(|s| s[3] > 0.0), "{xyzr:?}");
}

/// Bytes that are taken from the front; where none are left, zeros.
struct Input<'a>(&'a [u8]);

impl<'a> Input<'a> {
    fn byte(&mut self) -> u8 {
        self.take(1).first().copied().unwrap_or(0)
    }

    fn take(&mut self, n: usize) -> &'a [u8] {
        let (now, rest) = self.0.split_at(n.min(self.0.len()));
        self.0 = rest;
        now
    }

    fn word(&mut self) -> u64 {
        let mut all = [0; 8];
        let taken = self.take(8);
        all[..taken.len()].copy_from_slice(taken);
        u64::from_le_bytes(all)
    }

    /// A number: often a small one, now and then a hard one, or any bits at all.
    fn number(&mut self) -> f64 {
        let b = self.byte();
        match b {
            0..200 => f64::from(i16::from(b) - 100) / 16.0,
            200 => f64::NAN,
            201 => f64::INFINITY,
            202 => f64::MAX,
            203 => f64::MIN_POSITIVE / 8.0,
            204 => 1e-300,
            205 => 1e300,
            206 => -0.0,
            207..230 => 2f64.powi(i32::from(self.byte()) - 128),
            _ => f64::from_bits(self.word()),
        }
    }
}
