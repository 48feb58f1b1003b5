//! Files that DEM codes read: one file of this folder for each format, all from one record in the
//! principal frame, which no code misreads.
//!
//! Numbers are printed with the fewest digits that read back the same. A code that adds up
//! spheres is given masses that add up to the body; one that takes the body's mass and inertia is given
//! these.

mod deme;
mod format;
mod kratos;
mod lammps;
mod liggghts;
mod mercury;
mod mfix;
mod pfc;
pub mod read;
mod record;
mod save;
mod surface;
mod table;
mod text;
mod vtp;
mod yade;

pub use format::Format;
pub use record::Record;
pub use save::{save, save_in};
pub use surface::{ply, stl};
pub use table::csv;
pub use vtp::{vtp, vtp_points};

use crate::error::{Error, Result, collected, push};
use crate::mass::single_precision;
use crate::math::{Sphere, Vec3};
use std::borrow::Cow;

/// How a file is written.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportOptions {
    /// How many units of length of the file one of the caller's has: 1000 from metres to
    /// millimetres.
    pub length: f64,
    /// The same of mass.
    pub mass: f64,
    /// Whether coordinates are in the caller's frame instead of the body's, where the format has a
    /// choice.
    pub placed: bool,
    /// Facets of a sphere where a surface is written: 20 · 4^`facets` triangles, at most 6.
    pub facets: u32,
    /// Whether centres and radii are numbers of single precision, each sphere within the one that it
    /// stands for: for codes that read them so. Masses and moments keep all digits; what the spheres miss of
    /// them is that of 1e-7 of the clump's size.
    pub single: bool,
}

impl Default for ExportOptions {
    fn default() -> Self {
        ExportOptions { length: 1.0, mass: 1.0, placed: false, facets: 3, single: false }
    }
}

/// One of the files of a format.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct File {
    /// What is added to the path asked for: nothing for the file itself, an ending for what stands
    /// beside it, or a path below the folder that it names.
    pub place: Place,
    /// The bytes.
    pub bytes: Vec<u8>,
}

/// Where one of the files of a format is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// At the path.
    At,
    /// Beside it: the path with this ending.
    Beside(&'static str),
    /// In the folder that the path names.
    Below(&'static str),
}

/// The files of a format.
pub fn files(record: &Record, format: Format, options: &ExportOptions) -> Result<Vec<File>> {
    record.check()?;
    if options.placed && !format.can_be_placed() {
        return Err(Error::InvalidArgument(format!(
            "the format {} is always in the frame of the body",
            format.name()
        )));
    }
    let mut r = record.clone().in_units(options.length, options.mass)?;
    let placed = options.placed;
    let spheres = if placed { r.placed()? } else { r.spheres.clone() };
    let spheres = &rounded(&spheres, options.single)?;
    // Those of MFiX are rounded when they are relative.
    if format != Format::Mfix {
        r.spheres = rounded(&r.spheres, options.single && !placed)?.into_owned();
    }
    let r = &r;
    let masses = &r.masses;
    let texts = match format {
        Format::Mercury => mercury::files(r),
        Format::Lammps => vec![(Place::At, lammps::molecule(r)?)],
        Format::LammpsRigid => vec![(Place::At, lammps::rigid(r, placed)?)],
        Format::Liggghts => liggghts::files(r),
        Format::Yade => vec![(Place::At, yade::script(r))],
        Format::Deme => vec![(Place::At, deme::table(r))],
        Format::Mfix => vec![(Place::At, mfix::table(r, options.single)?)],
        Format::Kratos => vec![(Place::At, kratos::cluster(r))],
        Format::Pfc => vec![(Place::At, pfc::template(r))],
        Format::Edem => vec![(Place::At, table::bare(spheres, "\t"))],
        Format::Csv => vec![(Place::At, table::csv(spheres, masses))],
        Format::Json => vec![(Place::At, text::json(r, spheres, placed)?)],
        Format::Vtp => vec![(Place::At, vtp::vtp(spheres, masses))],
        Format::Ply => return one(surface::ply(spheres, options.facets)?),
        Format::Stl => return one(surface::stl(spheres, options.facets)?),
    };
    let mut files = Vec::new();
    for (place, text) in texts {
        push("files of a format", &mut files, File { place, bytes: text.into_bytes() })?;
    }
    Ok(files)
}

/// The spheres as they are, or within themselves in single precision.
fn rounded(spheres: &[Sphere], single: bool) -> Result<Cow<'_, [Sphere]>> {
    if !single {
        return Ok(Cow::Borrowed(spheres));
    }
    let wide = |&[x, y, z, r]: &[f32; 4]| {
        Sphere::new(Vec3::new(x.into(), y.into(), z.into()), f64::from(r))
    };
    Ok(Cow::Owned(collected("spheres of a file", single_precision(spheres)?.iter().map(wide))?))
}

fn one(bytes: Vec<u8>) -> Result<Vec<File>> {
    Ok(vec![File { place: Place::At, bytes }])
}
