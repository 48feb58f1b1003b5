//! Fragments: pieces of a solid between planes, and the clumps that take the place of the parent's.
//!
//! All work is done in the unit frame of the first parent, and every piece, of whatever generation,
//! is cut out of the first parent's own surface or cells by its half-spaces: nothing is cut out of
//! something that was cut, so nothing drifts.

mod climb;
mod cloud;
mod field;
mod grow;
mod map;
#[allow(dead_code)]
mod mark;
mod motion;
mod parent;
mod reclump;
#[allow(dead_code)]
mod region;
mod room;
mod spread;
mod union;

pub use grow::{grow, grown_radii};
pub use map::ParentMap;
pub use mark::Mark;
pub use motion::{HandOver, Held, Moving};
pub use parent::Parent;
pub use reclump::{Reclump, ReclumpOptions, reclump};
pub use region::Region;
pub use union::Union;
