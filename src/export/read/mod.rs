//! Reads clumps back: tables (CSV and those of LIGGGHTS, EDEM and Chrono), the JSON record, a folder of
//! MercuryDPM, a molecule of LAMMPS, a cluster of Kratos. Which it is is told by what it holds.

mod json;
mod kratos;
mod lammps;
mod mercury;
mod table;

use crate::error::{Error, Result, figure};
use crate::math::{Sphere, Vec3};
use std::path::Path;

/// Most bytes of a file of spheres.
const MOST: u64 = 1 << 30;

/// What a file says of a clump.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Template {
    /// Component spheres, the frame of the file.
    pub spheres: Vec<Sphere>,
    /// A mass for each, or none.
    pub masses: Vec<f64>,
    /// Mass of the body, where the file has it.
    pub mass: Option<f64>,
    /// Volume of the body, where the file has it.
    pub volume: Option<f64>,
    /// Whether the spheres are in the frame of the body (`true`) or of the caller, where the file
    /// says so.
    pub body_frame: Option<bool>,
}

/// Reads a file, or the folder of a format that has several.
pub fn read(path: &Path) -> Result<Template> {
    if path.is_dir() {
        return checked(mercury::read(path)?);
    }
    parse(&text(path)?)
}

/// Reads the text of a file.
pub fn parse(text: &str) -> Result<Template> {
    let starts = |word: &str| text.lines().any(|l| l.trim_start().starts_with(word));
    checked(if text.trim_start().starts_with('{') {
        json::parse(text)?
    } else if starts("Begin centers_and_radii") {
        kratos::parse(text)?
    } else if text.lines().any(|l| l.trim() == "Coords") {
        lammps::parse(text)?
    } else {
        table::parse(text)?
    })
}

fn text(path: &Path) -> Result<String> {
    let said = |e: std::io::Error| Error::Io(format!("{}: {e}", path.display()));
    let bytes = std::fs::metadata(path).map_err(said)?.len();
    if bytes > MOST {
        return Err(Error::TooLarge(format!(
            "{} has {bytes} bytes, more than {MOST}",
            path.display()
        )));
    }
    let bytes = std::fs::read(path).map_err(said)?;
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        Error::Format(format!("{} is no text: byte {at} is not UTF-8", path.display()))
    })
}

fn checked(t: Template) -> Result<Template> {
    if t.spheres.is_empty() {
        return Err(Error::Empty("there is no sphere".into()));
    }
    if !t.masses.is_empty() && t.masses.len() != t.spheres.len() {
        return Err(Error::Format(format!(
            "{} spheres have {} masses",
            t.spheres.len(),
            t.masses.len()
        )));
    }
    Ok(t)
}

/// A sphere of finite numbers and a radius above 0.
fn sphere([x, y, z, r]: [f64; 4], place: &str) -> Result<Sphere> {
    if [x, y, z, r].iter().any(|v| !v.is_finite()) {
        return Err(Error::NotFinite(format!("{place} holds a number that is not finite")));
    }
    if r <= 0.0 {
        return Err(Error::InvalidArgument(format!("{place} has the radius {}", figure(r))));
    }
    Ok(Sphere::new(Vec3::new(x, y, z), r))
}

/// The numbers of a line between commas, semicolons, tabs or blanks; none where one is no number,
/// or where nothing stands between two commas.
fn numbers(line: &str) -> Option<Vec<f64>> {
    let line = line.trim();
    let row = line.strip_suffix([',', ';']).unwrap_or(line);
    let mut all = Vec::new();
    for cell in row.split([',', ';']) {
        let before = all.len();
        for word in cell.split_whitespace() {
            all.push(word.parse().ok()?);
        }
        if all.len() == before {
            return None;
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests;
