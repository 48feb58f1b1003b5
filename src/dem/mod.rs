//! Rigid clumps that move and touch: a proving ground for what a clump's accuracy buys.
//!
//! The way of a step: [`integrate`] moves the bodies, `broad` and `narrow` find what touches, [`contact`] composes the laws
//! that the scene names into one type, [`effects`] holds one file for each, [`walls`] are what cannot be moved, and
//! [`engine`] is the loop. Forces depend on the state alone, never on lists or threads.

// Seams that are not used yet.
#![allow(dead_code)]

mod broad;
pub mod contact;
pub mod effects;
pub mod energy;
pub mod engine;
mod integrate;
pub mod narrow;
pub mod rotate;
pub mod scene;
pub mod state;
pub mod template;
mod tree;
pub mod walls;

pub use contact::{CohesionLaw, DampingLaw, Laws, NormalLaw, TangentialLaw};
pub use effects::Coefficients;
pub use effects::motion::WallMotion;
pub use engine::{Engine, Setup};
pub use state::{Placed, State};
pub use template::Template;
pub use walls::{WallSetup, WallShape};
