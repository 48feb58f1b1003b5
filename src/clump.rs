//! The result: spheres, quality, what the call did and why it stopped.

use crate::math::Sphere;
use crate::measure::Quality;
use crate::run::Counters;

/// Why a generator stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Stopped {
    /// The number of spheres asked for was reached.
    Spheres,
    /// The mismatch asked for was reached.
    Mismatch,
    /// Every further sphere would be smaller than the least radius.
    Radius,
    /// The deadline passed.
    Deadline,
    /// The caller cancelled; these are the spheres found so far.
    Cancelled,
    /// The method finds no further sphere that brings the clump closer; `note` says why.
    Exhausted,
    /// The coverage asked for was reached.
    Coverage,
}

impl Stopped {
    /// The word of the command line and the C ABI.
    pub fn name(self) -> &'static str {
        match self {
            Stopped::Spheres => "spheres",
            Stopped::Mismatch => "mismatch",
            Stopped::Radius => "radius",
            Stopped::Deadline => "deadline",
            Stopped::Cancelled => "cancelled",
            Stopped::Exhausted => "exhausted",
            Stopped::Coverage => "coverage",
        }
    }
}

/// A clump.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Clump {
    /// Component spheres in the caller's frame, in the order in which the method chose them, or
    /// by falling radius where it makes all at once.
    pub spheres: Vec<Sphere>,
    /// Why the method stopped.
    pub stopped: Stopped,
    /// What is to be said of it: fewer spheres than were asked for, a deadline, a demand that could not
    /// be met; else empty.
    pub note: String,
    /// Quality, when it was wanted.
    pub quality: Option<Quality>,
    /// What the call did.
    #[serde(skip)]
    pub counters: Counters,
}
