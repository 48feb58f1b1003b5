//! The C ABI: the only room with `unsafe`. One file per noun of the header;
//! every function passes through `guard`, which catches panics and keeps the
//! thread's error message.
//!
//! The doc comments here are the manual of `include/morula.h`, which is
//! generated from them; they are written for a C reader, so that what Rust
//! calls safety is said there as ownership, sizes and threads.
#![allow(unsafe_code)]
#![allow(non_camel_case_types)]
// Every pointer's contract is in the text of the function and in the header's introduction.
#![allow(clippy::missing_safety_doc)]
// In the texts [0] is an element of a C array, not a link.
#![allow(rustdoc::broken_intra_doc_links)]
// A C function has no builder to hide its parameters in.
#![allow(clippy::too_many_arguments)]

mod body;
mod body_read;
mod callbacks;
mod choices;
mod clump;
mod clump_read;
mod clumps;
mod cost;
mod cost_structs;
mod defaults;
mod export;
#[cfg(test)]
mod failing;
mod fenv;
mod file;
mod fragment;
mod fragment_read;
mod fragment_structs;
mod guard;
mod mass_structs;
mod options;
mod parent;
mod primitive;
mod reshape;
#[cfg(test)]
mod roads;
mod serial;
mod shape;
mod silhouettes;
mod solid;
mod status;
mod structs;
mod sweep;
#[cfg(test)]
mod tests;
mod voxels;
mod warnings;

pub use body::*;
pub use body_read::*;
pub use callbacks::*;
pub use choices::*;
pub use clump::*;
pub use clump_read::*;
pub use clumps::*;
pub use cost::*;
pub use cost_structs::*;
pub use export::*;
pub use file::*;
pub use fragment::*;
pub use fragment_read::*;
pub use fragment_structs::*;
pub use mass_structs::*;
pub use parent::*;
pub use primitive::*;
pub use reshape::*;
pub use serial::*;
pub use shape::*;
pub use silhouettes::*;
pub use solid::*;
pub use status::*;
pub use structs::*;
pub use sweep::*;
pub use voxels::*;
pub use warnings::*;
