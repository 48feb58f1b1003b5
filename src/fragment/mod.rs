//! Fragments: pieces of a solid between planes, and the clumps that take the place of the parent's.
//!
//! All work is done in the unit frame of the first parent, and every piece, of whatever generation,
//! is cut out of the first parent's own surface or cells by its half-spaces: nothing is cut out of
//! something that was cut, so nothing drifts.

#[allow(dead_code)]
mod mark;
mod motion;
#[allow(dead_code)]
mod region;
mod union;

pub use mark::Mark;
pub use motion::{HandOver, Held, Moving};
pub use region::Region;
pub use union::Union;
