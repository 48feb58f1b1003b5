//! Fragments: pieces of a solid between planes, and the clumps that take the place of the parent's.
//!
//! All work is done in the unit frame of the first parent, and every piece, of whatever generation,
//! is cut out of the first parent's own surface or cells by its half-spaces: nothing is cut out of
//! something that was cut, so nothing drifts.

mod blocks;
mod by_cells;
mod by_labels;
mod cache;
mod cap;
mod cells;
mod climb;
mod clip;
mod cloud;
mod cut;
mod differences;
mod ears;
mod field;
mod grow;
mod hash;
mod labels;
mod lookup;
mod map;
mod mark;
mod mark_bits;
mod motion;
mod parent;
mod parts;
mod piece;
mod reclump;
mod region;
mod reshape;
mod room;
mod shatter;
mod skin;
mod spread;
mod union;

pub use by_labels::shatter_labels;
pub use cache::{Cache, CacheCounters};
pub use cells::Cut;
pub use cut::{CutOptions, Dust, Fragments, cut, cut_region, shape};
pub use grow::{grow, grown_radii};
pub use labels::{Labelled, label_solids};
pub use map::ParentMap;
pub use mark::Mark;
pub use motion::{HandOver, Held, Moving};
pub use parent::Parent;
pub use reclump::{Reclump, ReclumpOptions, reclump};
pub use region::Region;
pub use reshape::reshape;
pub use shatter::{
    Crumb, Fragment, Job, ShatterOptions, Shattered, restore, shatter, shatter_many,
};
pub use union::Union;
