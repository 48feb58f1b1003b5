//! The result: spheres, quality, what the call did and why it stopped.

use crate::error::figure;
use crate::math::Sphere;
use crate::measure::Quality;
use crate::run::Counters;
use std::fmt;

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

/// What limits a clump and is no fault of the call: one name each, so that a solver can decide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Limit {
    /// Fewer spheres than were asked for: how many, of how many.
    FewerSpheres,
    /// So far from the origin that places are rounded: by which part of the size.
    FarAway,
    /// The target's moments are not exact integrals: by which part they may be off.
    InexactTarget,
    /// The grid has few cells across the target's mean thickness 2 V/A: how many.
    Thin,
    /// D is known poorly: its error over itself.
    CoarseOverlap,
    /// Greatest distances are known poorly: how much more they may be, over the equivalent diameter.
    CoarseDistance,
}

impl Limit {
    /// Its word in the C ABI and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Limit::FewerSpheres => "fewer spheres",
            Limit::FarAway => "far away",
            Limit::InexactTarget => "inexact target",
            Limit::Thin => "thin",
            Limit::CoarseOverlap => "coarse overlap",
            Limit::CoarseDistance => "coarse distance",
        }
    }
}

/// A limit that a clump meets, with the figure.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Warning {
    /// Which limit.
    pub limit: Limit,
    /// The figure found.
    pub figure: f64,
    /// The bound that it misses.
    pub bound: f64,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x, bound) = (figure(self.figure), figure(self.bound));
        match self.limit {
            Limit::FewerSpheres => write!(f, "{x} of {bound} spheres: the note says why"),
            Limit::FarAway => write!(
                f,
                "so far from the origin that places are rounded by {x} of the size, more than {bound}: \
                 move the shape near it"
            ),
            Limit::InexactTarget => write!(
                f,
                "the surface is open or crosses itself: mass, centre and inertia are off by up to {x}, \
                 more than {bound}"
            ),
            Limit::Thin => write!(
                f,
                "{x} cells of the grid lie across the mean thickness of the shape, fewer than {bound}: \
                 ask for more cells"
            ),
            Limit::CoarseOverlap => write!(
                f,
                "the mismatch is known to {x} of itself, more than {bound}: ask for more columns"
            ),
            Limit::CoarseDistance => write!(
                f,
                "greatest distances may be more by {x} of the equivalent diameter, more than {bound}"
            ),
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
    /// What limits it, with figures.
    pub warnings: Vec<Warning>,
    /// Quality, when it was wanted.
    pub quality: Option<Quality>,
    /// What the call did.
    #[serde(skip)]
    pub counters: Counters,
}
