//! What is simulated, and how much was done.

use crate::dem::contact::{Calls, Laws};
use crate::dem::effects::Coefficients;
use crate::dem::effects::drag::Drag;
use crate::dem::effects::insertion::Insertion;
use crate::dem::walls::WallSetup;
use crate::math::Vec3;

/// What is simulated: effects that are not named do no work and hold no memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Time step.
    pub dt: f64,
    /// Laws of contact; `None`: bodies pass through each other.
    pub laws: Option<Laws>,
    /// How many materials there are.
    pub materials: usize,
    /// For each two materials, `materials`² rows by rows.
    pub coefficients: Vec<Coefficients>,
    /// The walls.
    pub walls: Vec<WallSetup>,
    /// Acceleration of gravity.
    pub gravity: Option<Vec3>,
    /// A fluid that slows bodies down.
    pub drag: Option<Drag>,
    /// Bodies that come while it runs.
    pub insertion: Vec<Insertion>,
    /// Whether bodies turn exactly between the forces (else by splitting, with an error of dt²).
    pub exact_rotation: bool,
    /// Whether a run that has more kinetic energy than was put in is stopped.
    pub guard: bool,
}

impl Setup {
    /// Bodies alone: a time step, one material, no contacts.
    pub fn free(dt: f64) -> Setup {
        Setup {
            dt,
            laws: None,
            materials: 1,
            coefficients: vec![Coefficients::default()],
            walls: Vec::new(),
            gravity: None,
            drag: None,
            insertion: Vec::new(),
            exact_rotation: false,
            guard: true,
        }
    }
}

/// How much was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Steps.
    pub steps: u64,
    /// Lists of near bodies made.
    pub broad: u64,
    /// Searches of two sphere trees, or of a wall and one.
    pub searches: u64,
    /// Contacts, summed over the steps.
    pub contacts: u64,
    /// Calls of each law of contact.
    pub calls: Calls,
    /// Bodies that gravity pulled, summed over the steps.
    pub gravity: u64,
    /// Bodies that a fluid slowed down, summed over the steps.
    pub drag: u64,
    /// Batches of bodies that were looked for.
    pub insertion: u64,
    /// Places of walls that were reckoned.
    pub motion: u64,
}

/// What one effect did and holds: nothing, where it is not named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EffectReport {
    /// Its name.
    pub name: &'static str,
    /// How often it was called.
    pub calls: u64,
    /// Bytes that it holds.
    pub bytes: u64,
}
