//! The MSS algorithm of paper 002 (Buchele, Pöschel and Müller 2026).

use super::GenerateOptions;
use crate::clump::Clump;
use crate::error::{Error, Result};
use crate::run::Run;
use crate::solid::Solid;

/// Makes a clump by MSS.
pub(super) fn mss(solid: &Solid, options: &GenerateOptions, run: &Run) -> Result<Clump> {
    let _ = (solid, options, run);
    Err(Error::Internal("MSS is not built yet".into()))
}
