//! Shapes, clumps and fragments as bytes, for another rank or a restart file.
//!
//! A header of 24 bytes, all numbers little-endian: `MORULA` and two bytes that texts do not have;
//! the version of the format, 16 bits; what it is, 16 bits; the CRC-32 of what follows; its length
//! in bytes, 64 bits. What follows is in the format of postcard 1 (<https://postcard.jamesmunns.com>).
//! The same value gives the same bytes; times that a call took are left out. Bytes that are cut short,
//! changed, of another kind or of another version are refused with a sentence.

mod clump;
mod fragment;
mod shape;

pub use clump::ClumpRecord;
pub use fragment::{FragmentRecord, fragment_from_bytes, fragment_to_bytes};
pub use shape::{shape_from_bytes, shape_to_bytes};

use crate::error::{Error, Result};
use crate::math::Moments;
use serde::Serialize;
use serde::de::DeserializeOwned;

const MAGIC: [u8; 8] = *b"MORULA\x1a\n";
/// Of what follows the header. It rises with every change of a struct that is handed on.
const VERSION: u16 = 2;
/// Bytes of the header.
const HEADER: usize = 24;
/// Farther from its unit frame's origin no body lies, whose box has edges of 1 at most.
const NEAR: f64 = 5.0;

/// What bytes hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Shape = 1,
    Clump = 2,
    Fragment = 3,
}

impl Kind {
    fn name(number: u16) -> &'static str {
        match number {
            1 => "a shape",
            2 => "a clump",
            3 => "a fragment",
            _ => "something unknown",
        }
    }
}

/// Whether moments may be those of a body in its unit frame, at unit density: nothing of it is farther away than [`NEAR`].
fn possible(m: &Moments) -> bool {
    let [xx, yy, zz, xy, xz, yz] = m.inertia.to_array();
    let most = 6.0 * NEAR * NEAR * m.volume;
    let (real, near) = (m.volume.is_finite() && m.volume > 0.0, |x: f64| x.abs() <= NEAR);
    let some = |x: f64| (-1e-9 * most..=most).contains(&x);
    let error = m.relative_error;
    real && m.centroid.iter().all(|x| near(*x))
        && [xx, yy, zz].into_iter().all(some)
        && [xy, xz, yz].into_iter().all(|x| x.abs() <= most)
        && error.is_finite()
        && error >= 0.0
}

/// The bytes of a value.
pub(crate) fn to_bytes<T: Serialize>(kind: Kind, value: &T) -> Result<Vec<u8>> {
    let said = |e: postcard::Error| Error::Internal(format!("no bytes could be made: {e}"));
    let length = postcard::experimental::serialized_size(value).map_err(said)?;
    let mut out: Vec<u8> = crate::error::reserve("the bytes", HEADER.saturating_add(length))?;
    out.extend([0; HEADER]);
    let mut out = postcard::to_extend(value, out).map_err(said)?;
    let (head, body) = out.split_at_mut(HEADER);
    let sum = crc32fast::hash(body);
    let fields: [&[u8]; 5] = [
        &MAGIC,
        &VERSION.to_le_bytes(),
        &(kind as u16).to_le_bytes(),
        &sum.to_le_bytes(),
        &(body.len() as u64).to_le_bytes(),
    ];
    for (to, from) in head.iter_mut().zip(fields.into_iter().flatten()) {
        *to = *from;
    }
    Ok(out)
}

/// The value of bytes; its numbers are not looked at.
pub(crate) fn from_bytes<T: DeserializeOwned>(kind: Kind, bytes: &[u8]) -> Result<T> {
    let Some((head, body)) = bytes.split_at_checked(HEADER) else {
        let count = bytes.len();
        return Err(Error::Format(format!("{count} bytes, fewer than the {HEADER} of the header")));
    };
    let number = |from: usize, len: usize| {
        head[from..from + len].iter().rev().fold(0u64, |n, b| n << 8 | u64::from(*b))
    };
    if head[..8] != MAGIC {
        return Err(Error::Format("the bytes do not begin as those of this library do".into()));
    }
    let (version, found) = (number(8, 2) as u16, number(10, 2) as u16);
    if version != VERSION {
        return Err(Error::Unsupported(format!(
            "the bytes have version {version} of the format, and this library reads {VERSION}"
        )));
    }
    if found != kind as u16 {
        return Err(Error::Format(format!(
            "the bytes hold {}, not {}",
            Kind::name(found),
            Kind::name(kind as u16)
        )));
    }
    let (sum, length) = (number(12, 4) as u32, number(16, 8));
    if length != body.len() as u64 {
        return Err(Error::Format(format!(
            "{} bytes follow the header, which says {length}",
            body.len()
        )));
    }
    if crc32fast::hash(body) != sum {
        return Err(Error::Format("the bytes have changed: their checksum is another".into()));
    }
    let (value, rest) = postcard::take_from_bytes(body)
        .map_err(|e| Error::Format(format!("the bytes are no {kind:?}: {e}")))?;
    match rest.len() {
        0 => Ok(value),
        left => Err(Error::Format(format!("{left} bytes are left over"))),
    }
}

#[cfg(test)]
mod tests;
