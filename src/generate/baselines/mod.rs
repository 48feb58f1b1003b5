//! The generators that the field compares with, each as its source says, on exact distances.
//!
//! What differs from the sources, and why, is in docs/baselines.md.

pub(super) mod climb;
mod euclidean;
mod favier;
mod ferellec_mcdowell;
mod ground;
mod growing;
mod uniform_grid;

pub(super) use euclidean::euclidean;
pub(super) use favier::favier;
pub(super) use ferellec_mcdowell::ferellec_mcdowell;
pub(super) use uniform_grid::uniform_grid;

use super::{Effort, GenerateOptions};
use crate::error::{Error, Result};

/// Overlap of the Euclidean method unless another is given.
pub const OVERLAP: f64 = 0.9;

/// Refuses what the method `name` does not read.
fn check(o: &GenerateOptions, name: &str) -> Result<()> {
    let unread = [
        ("min_distance", o.min_distance != 0.0, "mss"),
        ("radius_offset", o.radius_offset != 0.0, "mss"),
        ("confine", o.confine, "mss"),
        ("effort", o.effort != Effort::Normal, "best"),
    ];
    match unread.iter().find(|u| u.1) {
        None => Ok(()),
        Some((option, _, of)) => Err(Error::InvalidArgument(format!(
            "{option} is an option of the method {of}, not of {name}"
        ))),
    }
}
