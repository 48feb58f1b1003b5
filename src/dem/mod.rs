//! Rigid clumps that move and touch: a proving ground for what a clump's accuracy buys.
//!
//! The way of a step: `integrate` moves the bodies, `broad` and `narrow` find what touches, [`contact`] composes the laws
//! that the scene names into one type, [`effects`] holds one file for each, [`walls`] are what cannot be moved, and
//! [`engine`] is the loop. Forces depend on the state alone, never on lists or threads.

pub mod advice;
mod breaking;
mod broad;
mod built;
pub mod contact;
pub mod effects;
pub mod energy;
pub mod engine;
pub mod impact;
mod integrate;
mod kernel;
pub mod materials;
pub mod narrow;
mod random;
pub mod rotate;
pub mod scene;
mod small;
mod snapshot;
pub mod state;
pub mod tablet;
pub mod template;
mod tree;
pub mod walls;
mod wearing;

pub use contact::{CohesionLaw, DampingLaw, Laws, NormalLaw, TangentialLaw};
pub use effects::Coefficients;
pub use effects::drag::Drag;
pub use effects::insertion::{InsertRegion, Insertion};
pub use effects::motion::WallMotion;
pub use engine::{Engine, Setup};
pub use materials::{Between, Material};
pub use state::{Placed, State};
pub use template::Template;
pub use walls::{WallSetup, WallShape};
