//! A folder of MercuryDPM: `Clump/Clump.txt`, and the mass beside it.

use super::{Template, table, text};
use crate::error::{Error, Result};
use std::path::Path;

pub(super) fn read(folder: &Path) -> Result<Template> {
    let clump = folder.join("Clump").join("Clump.txt");
    if !clump.is_file() {
        return Err(Error::Format(format!("{} has no Clump/Clump.txt", folder.display())));
    }
    let mut t = table::parse(&text(&clump)?).map_err(|e| e.about(&clump.display().to_string()))?;
    t.body_frame = Some(true);
    let mass = folder.join("Inertia").join("Mass.txt");
    if mass.is_file() {
        let said = text(&mass)?;
        let bad = || Error::Format(format!("{} is {:?}, no number", mass.display(), said.trim()));
        t.mass = Some(said.trim().parse().map_err(|_| bad())?);
    }
    Ok(t)
}
