//! Morula turns the shape of a particle into a clump of overlapping spheres
//! that a DEM solver can use, from inside that solver, while it runs.
//!
//! The way of the data, and the order of the modules:
//! [`shape`] (what the user hands in) → [`solid`] (signed distance and exact
//! moments) → [`measure`] (how far a clump is from its solid) → [`clump`] (the
//! result) → [`generate`] (the methods that make it) and [`mass`] (what a solver
//! takes of it) → [`cost`] (what accuracy costs in time), [`fragment`] (pieces of a solid that breaks), `export` (files that
//! DEM codes read; with the feature `io`) and [`serial`] (bytes for another rank or a
//! restart), `dem` (simulation; with the feature `dem`). A module imports only from those before
//! it, `mass` not from `generate`, nor `fragment` and `export` from `cost`, nor `export` from
//! `fragment`.
//! [`ffi`] is the C ABI and the only `unsafe`.
//!
//! The library is unit-free: lengths are in the caller's unit, moments are per
//! unit density, and a density is mass per (that length)³.

pub mod clump;
pub mod cost;
#[cfg(feature = "dem")]
pub mod dem;
pub mod error;
#[cfg(feature = "io")]
pub mod export;
pub mod ffi;
pub mod fragment;
pub mod generate;
pub mod mass;
pub mod math;
pub mod measure;
pub mod run;
pub mod serial;
pub mod shape;
pub mod solid;

pub use clump::Clump;
pub use error::{Error, Result};
pub use math::Sphere;
pub use run::Run;
pub use shape::Shape;
pub use solid::Solid;
