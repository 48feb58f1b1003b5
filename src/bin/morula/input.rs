//! The shape that a subcommand works on and the options that say how it is read.

use crate::fail::{About, Done, Fail};
use clap::ValueEnum;
use morula::Run;
use morula::shape::read::{FileOptions, Meaning, RawType};
use morula::shape::voxels::Threshold;
use morula::shape::{Bodies, ImportOptions, Primitive, Shape};
use morula::solid::{Resolution, Solid, SolidOptions};
use std::path::Path;

/// How the shape is read.
#[derive(clap::Args)]
#[command(next_help_heading = "Input")]
pub struct Reading {
    /// What to do with several disconnected bodies
    #[arg(long, value_enum, default_value_t = BodiesArg::Refuse)]
    bodies: BodiesArg,
    /// The file's length unit in yours: coordinates are multiplied by it (0.001: mm to m)
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = positive)]
    length_unit: f64,
    /// Vertices nearer than this times the longest edge of the bounding box are one
    #[arg(long, value_name = "TOLERANCE", default_value_t = 1e-6, value_parser = not_negative)]
    weld: f64,
    /// Grey voxels above this are solid: a number, or otsu
    #[arg(long, value_name = "VALUE", conflicts_with = "label")]
    threshold: Option<String>,
    /// Take this label of a label volume
    #[arg(long, value_name = "LABEL")]
    label: Option<u32>,
    /// Edge lengths of a voxel along x,y,z (one number: cubes)
    #[arg(long, value_name = "H|HX,HY,HZ", default_value = "1", value_parser = triple)]
    spacing: [f64; 3],
    /// Lower corner of the first voxel
    #[arg(long, value_name = "X,Y,Z", default_value = "0", value_parser = triple, allow_hyphen_values = true)]
    origin: [f64; 3],
    /// Order of the axes of a .npy array
    #[arg(long, value_enum, default_value_t = Axes::Zyx)]
    axes: Axes,
    /// Raw voxels, x fastest: dimensions, type (u8, u16, f32) and header bytes to skip
    #[arg(long, value_name = "NXxNYxNZ[:TYPE[:SKIP]]", value_parser = raw)]
    raw: Option<Raw>,
    /// Edges around a built-in particle (sample:NAME)
    #[arg(long, default_value_t = 64)]
    segments: usize,
    /// Most memory that arrays may take: bytes, or with KiB, MiB, GiB
    #[arg(long, value_name = "BYTES", default_value = "2GiB", value_parser = bytes)]
    pub memory_limit: u64,
}

#[derive(Clone, Copy, ValueEnum)]
enum BodiesArg {
    Refuse,
    Largest,
    All,
}

#[derive(Clone, Copy, ValueEnum)]
enum Axes {
    Zyx,
    Xyz,
}

type Raw = ([usize; 3], RawType, usize);

impl Reading {
    fn import(&self) -> ImportOptions {
        ImportOptions {
            weld_tolerance: self.weld,
            length_unit: self.length_unit,
            bodies: match self.bodies {
                BodiesArg::Refuse => Bodies::Refuse,
                BodiesArg::Largest => Bodies::Largest,
                BodiesArg::All => Bodies::All,
            },
            memory_limit: self.memory_limit,
        }
    }

    /// The library's options for a file.
    pub fn file_options(&self) -> Done<FileOptions> {
        let meaning = match (&self.label, self.threshold.as_deref()) {
            (Some(label), _) => Meaning::Label(*label),
            (None, None) => Meaning::Auto,
            (None, Some("otsu")) => Meaning::Grey(Threshold::Otsu),
            (None, Some(text)) => match text.parse::<f64>() {
                Ok(t) if t.is_finite() => Meaning::Grey(Threshold::Above(t)),
                _ => {
                    return Err(Fail::Usage(format!(
                        "--threshold is {text}, neither a number nor otsu"
                    )));
                }
            },
        };
        Ok(FileOptions {
            import: self.import(),
            meaning,
            spacing: self.spacing,
            origin: self.origin,
            npy_xyz: matches!(self.axes, Axes::Xyz),
            raw: self.raw,
            ..FileOptions::default()
        })
    }

    /// Reads and checks the shape: a file, or `sample:NAME[,key=value…]`.
    pub fn shape(&self, input: &str, run: &Run) -> Done<Shape> {
        if let Some(text) = input.strip_prefix("sample:") {
            let particle = particle(text)?;
            return Shape::from_primitive(&particle, self.segments, &self.import(), run)
                .about(input);
        }
        let options = self.file_options()?;
        Shape::from_file(Path::new(input), &options, run).about(input)
    }
}

/// `tablet` or `tablet,band_height=3,cap_height=1`.
fn particle(text: &str) -> Done<Primitive> {
    let mut parts = text.split(',');
    let name = parts.next().unwrap_or("");
    let mut particle = Primitive::from_name(name).about("")?;
    for pair in parts {
        set(&mut particle, pair)?;
    }
    Ok(particle)
}

/// Sets one parameter from `key=value`.
pub fn set(particle: &mut Primitive, pair: &str) -> Done {
    let parsed = pair.split_once('=').and_then(|(k, v)| Some((k, v.parse::<f64>().ok()?)));
    let Some((key, value)) = parsed else {
        return Err(Fail::Usage(format!("{pair} is not of the form key=number")));
    };
    particle.set(key, value).about("")
}

/// How fine the grid is.
#[derive(clap::Args)]
#[command(next_help_heading = "Grid")]
pub struct Fineness {
    /// Cells along the edge that --cells-along names
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..))]
    cells: u32,
    /// Which length --cells counts along
    #[arg(long, value_enum, default_value_t = Along::Longest)]
    cells_along: Along,
    /// Edge length of a cell instead
    #[arg(long, value_name = "LENGTH", conflicts_with_all = ["cells", "cells_along"], value_parser = positive)]
    cell_size: Option<f64>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Along {
    /// The longest edge of the bounding box
    Longest,
    /// The shortest edge of the bounding box (the rule of the MSS paper)
    Shortest,
    /// The diameter of the sphere of equal volume
    Diameter,
}

impl Fineness {
    /// The solid of a shape on this grid.
    pub fn solid(&self, shape: &Shape, reading: &Reading, run: &Run) -> morula::Result<Solid> {
        let resolution = match (self.cell_size, self.cells_along) {
            (Some(h), _) => Resolution::CellSize(h),
            (None, Along::Longest) => Resolution::CellsLongest(self.cells),
            (None, Along::Shortest) => Resolution::CellsShortest(self.cells),
            (None, Along::Diameter) => Resolution::CellsDiameter(self.cells),
        };
        let options = SolidOptions {
            resolution,
            memory_limit: reading.memory_limit,
            ..SolidOptions::default()
        };
        Solid::new(shape, &options, run)
    }
}

fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(v) if v.is_finite() => Ok(v),
        _ => Err(format!("{text} is not a finite number")),
    }
}

/// A number greater than 0.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text).and_then(|v| if v > 0.0 { Ok(v) } else { Err(format!("{v} is not above 0")) })
}

/// A number of at least 0.
pub fn not_negative(text: &str) -> Result<f64, String> {
    number(text).and_then(|v| if v >= 0.0 { Ok(v) } else { Err(format!("{v} is below 0")) })
}

/// One number for all three axes, or three with commas.
fn triple(text: &str) -> Result<[f64; 3], String> {
    let values = text.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
    match values[..] {
        [a] => Ok([a; 3]),
        [a, b, c] => Ok([a, b, c]),
        _ => Err(format!("{text} holds {} numbers, not 1 or 3", values.len())),
    }
}

fn raw(text: &str) -> Result<Raw, String> {
    let mut parts = text.split(':');
    let dims = parts
        .next()
        .unwrap_or("")
        .split('x')
        .map(|n| n.parse::<usize>().map_err(|_| format!("{n} is not a number of cells")))
        .collect::<Result<Vec<_>, _>>()?;
    let [nx, ny, nz] = dims[..] else {
        return Err(format!("{text} names {} dimensions, not 3", dims.len()));
    };
    let element = match parts.next() {
        None | Some("u8") => RawType::U8,
        Some("u16") => RawType::U16,
        Some("f32") => RawType::F32,
        Some(other) => return Err(format!("{other} is none of u8, u16, f32")),
    };
    let skip = match parts.next() {
        None => 0,
        Some(n) => n.parse().map_err(|_| format!("{n} is not a number of bytes"))?,
    };
    Ok(([nx, ny, nz], element, skip))
}

fn bytes(text: &str) -> Result<u64, String> {
    let split = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (digits, unit) = text.split_at(split);
    let shift = match unit {
        "" | "B" => 0,
        "KiB" => 10,
        "MiB" => 20,
        "GiB" => 30,
        _ => return Err(format!("{unit} is none of B, KiB, MiB, GiB")),
    };
    let value = number(digits)? * f64::from(1u32 << shift);
    if (0.0..1e18).contains(&value) { Ok(value as u64) } else { Err(format!("{text} is no size")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_triples_parse() {
        assert_eq!(bytes("2GiB"), Ok(2 << 30));
        assert_eq!(bytes("1.5KiB"), Ok(1536));
        assert_eq!(bytes("77"), Ok(77));
        assert!(bytes("-1").is_err() && bytes("3 cats").is_err() && bytes("1e30").is_err());
        assert_eq!(triple("2"), Ok([2.0; 3]));
        assert_eq!(triple("1,2.5,-3"), Ok([1.0, 2.5, -3.0]));
        assert!(triple("1,2").is_err() && triple("1,nan,2").is_err());
    }

    #[test]
    fn raw_layouts_parse() {
        assert_eq!(raw("4x5x6"), Ok(([4, 5, 6], RawType::U8, 0)));
        assert_eq!(raw("4x5x6:u16:512"), Ok(([4, 5, 6], RawType::U16, 512)));
        assert!(raw("4x5").is_err() && raw("4x5x6:i8").is_err() && raw("axbxc").is_err());
    }
}
