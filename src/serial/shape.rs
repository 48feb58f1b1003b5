//! A checked shape: nothing is checked, welded or repaired again, so that every bit is as it was.

use super::{Kind, from_bytes, to_bytes};
use crate::error::{Error, Result};
use crate::math::UnitFrame;
use crate::shape::{Body, Report, Shape};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

#[derive(Serialize)]
struct Out<'a> {
    frame: UnitFrame,
    report: &'a Report,
    body: &'a Body,
}

#[derive(Deserialize)]
struct In {
    frame: UnitFrame,
    report: Report,
    body: Body,
}

/// The bytes of a shape.
pub fn shape_to_bytes(shape: &Shape) -> Result<Vec<u8>> {
    let Shape { frame, report, body } = shape;
    to_bytes(Kind::Shape, &Out { frame: *frame, report, body })
}

/// The shape of bytes, to the last bit. Refused with `Format`: bytes that are no shape's or not
/// whole, and a body that no import makes; with `Unsupported`: another version.
pub fn shape_from_bytes(bytes: &[u8]) -> Result<Shape> {
    let In { frame, report, body } = from_bytes(Kind::Shape, bytes)?;
    check_frame(&frame)?;
    body.check().map_err(|e| match e {
        Error::OutOfMemory(_) => e,
        _ => Error::Format(format!("the bytes hold no body: {e}")),
    })?;
    Ok(Shape { body: Arc::new(body), frame, report })
}

pub(super) fn check_frame(frame: &UnitFrame) -> Result<()> {
    let whole = frame.scale.is_normal() && frame.scale > 0.0;
    if !(whole && frame.offset.iter().all(|x| x.is_finite())) {
        return Err(Error::Format(format!("the bytes hold a unit of {}", frame.scale)));
    }
    Ok(())
}
