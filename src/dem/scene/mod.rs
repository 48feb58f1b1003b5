//! Scenes: files that say what is simulated, and what of it is written down.

mod bed;
mod build;
pub mod file;
pub mod fragmentation;
mod frames;
mod given;
pub mod impacts;
mod keys;
mod laws;
mod materials;
mod mean;
mod play;
mod refuse;
mod shares;
pub mod shows;
pub mod sweep;
mod templates;
mod walls;
mod watch;
pub mod wear;

pub use build::{Scene, build, build_with};
pub use file::SceneFile;
pub use fragmentation::{BREAK_COLUMNS, break_line};
pub use keys::parse;
pub use mean::{Mean, block_mean};
pub use play::{Over, Place, Sink, play, rows_before};
pub use shares::{Share, shares};
pub use templates::{Made, Makes};
pub use watch::Watch;
pub use wear::{WEAR_COLUMNS, wear_line};
