//! Fragments: pieces cut from a solid, and the clumps that take the place of its own.

mod union;

pub use union::Union;
