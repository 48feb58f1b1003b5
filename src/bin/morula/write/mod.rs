//! What the program writes: clumps and meshes, one file per format.

mod clump_json;
pub mod mesh;

use crate::fail::{About, Done, Fail};
use clap::ValueEnum;
use morula::export::{File, Place, save};
use morula::{Sphere, export};
use std::io::{BufWriter, IsTerminal, Write};
use std::path::Path;

/// A file format for clumps.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum ClumpFormat {
    /// One sphere a line under the header x,y,z,r, with a density x,y,z,r,mass
    Csv,
    /// One object with the spheres as [x, y, z, r] and the figures of the clump
    Json,
    /// VTK XML PolyData: points with a radius
    Vtp,
    /// A mesh in which each sphere is an icosphere of 1280 faces (not the union)
    Ply,
}

impl ClumpFormat {
    /// The format that a file name stands for; CSV when it says nothing.
    pub fn of_name(name: &str) -> ClumpFormat {
        let extension = Path::new(name).extension().and_then(|e| e.to_str()).unwrap_or("");
        match extension.to_ascii_lowercase().as_str() {
            "json" => ClumpFormat::Json,
            "vtp" => ClumpFormat::Vtp,
            "ply" => ClumpFormat::Ply,
            _ => ClumpFormat::Csv,
        }
    }
}

/// Writes a clump; `figures` go into formats that have room for them.
pub fn clump(
    out: &mut dyn Write,
    format: ClumpFormat,
    (spheres, masses): (&[Sphere], &[f64]),
    figures: &serde_json::Value,
) -> std::io::Result<()> {
    match format {
        ClumpFormat::Csv => out.write_all(export::csv(spheres, masses).as_bytes()),
        ClumpFormat::Json => clump_json::write(out, spheres, figures),
        ClumpFormat::Vtp => out.write_all(export::vtp(spheres, masses).as_bytes()),
        ClumpFormat::Ply => {
            let bytes = export::ply(spheres, 3).map_err(std::io::Error::other)?;
            out.write_all(&bytes)
        }
    }
}

/// Writes to a file, or to stdout when `path` is `-`.
pub fn to(path: &str, body: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Done {
    if path == "-" {
        return to_stdout(body);
    }
    let path = Path::new(path);
    let mut bytes = Vec::new();
    body(&mut bytes).map_err(|e| Fail::file(path, e))?;
    // Nothing half-written has that name.
    save(&[File { place: Place::At, bytes }], path).about("")
}

/// Writes to stdout.
pub fn to_stdout(body: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Done {
    let mut out = BufWriter::new(std::io::stdout().lock());
    body(&mut out).and_then(|()| out.flush()).map_err(Fail::stdout)
}

/// Writes to stdout for a person: nothing in a pipe.
pub fn to_terminal(body: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Done {
    if std::io::stdout().is_terminal() { to_stdout(body) } else { Ok(()) }
}
