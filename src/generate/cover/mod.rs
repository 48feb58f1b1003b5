//! Maximal inscribed spheres about a thinned skeleton, chosen by a greedy set cover of cells
//! (Yuan 2019, update of Granular Matter 21:19).

mod cliques;
mod simple;
mod thinning;

pub use thinning::{Ends, Skeleton, thin};
