//! A clump, with what it was made for.

use super::shape::check_frame;
use super::{Kind, from_bytes, possible, to_bytes};
use crate::clump::Clump;
use crate::error::{Error, Result};
use crate::math::{Moments, UnitFrame};
use serde::{Deserialize, Serialize};

/// A clump and what it was made for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClumpRecord {
    /// The clump; what its calls counted is not handed on.
    pub clump: Clump,
    /// The spheres as they were asked for, `x, y, z, r` each: in the caller's frame or the body's.
    pub given: Vec<f64>,
    /// What was wanted of it, as the C ABI has it, and whether planes were.
    pub wants: u32,
    /// Whether contacts with planes were counted.
    pub planes: bool,
    /// Moments of the target at unit density, in the unit frame.
    pub moments: Moments,
    /// From the caller's frame to the unit frame.
    pub frame: UnitFrame,
}

impl ClumpRecord {
    /// The bytes of a clump.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        to_bytes(Kind::Clump, self)
    }

    /// The clump of bytes, to the last bit. Refused with `Format`: bytes that are no clump's or not
    /// whole, and spheres that no clump has; with `Unsupported`: another version.
    pub fn from_bytes(bytes: &[u8]) -> Result<ClumpRecord> {
        let found: ClumpRecord = from_bytes(Kind::Clump, bytes)?;
        check_frame(&found.frame)?;
        let spheres = &found.clump.spheres;
        let real = |r: f64| r.is_finite() && r > 0.0;
        let good = |c: &[f64]| c.iter().all(|x| x.is_finite());
        let bad = spheres.iter().position(|s| !(real(s.radius) && good(s.center.as_slice())));
        let bad = bad.or_else(|| {
            found.given.chunks(4).position(|s| !(good(s) && s.get(3).is_some_and(|r| real(*r))))
        });
        if let Some(i) = bad {
            return Err(Error::Format(format!("sphere {i} of the bytes is not a sphere")));
        }
        if found.given.len() != 4 * spheres.len() {
            return Err(Error::Format(format!(
                "the bytes hold {} spheres and {} numbers for them",
                spheres.len(),
                found.given.len()
            )));
        }
        let m = &found.moments;
        if !possible(m) {
            return Err(Error::Format("the moments of the bytes are those of no body".into()));
        }
        if found.clump.quality.as_ref().is_some_and(|q| !q.is_finite()) {
            return Err(Error::Format("a figure of quality of the bytes is not finite".into()));
        }
        Ok(found)
    }
}
