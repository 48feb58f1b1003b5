//! The shape that a subcommand works on and the options that say how it is read.

pub mod parse;

use crate::fail::{About, Done, Fail};
use clap::ValueEnum;
use morula::Run;
use morula::shape::read::{FileOptions, Format, Meaning};
use morula::shape::voxels::Threshold;
use morula::shape::{Bodies, Body, ImportOptions, Primitive, Shape};
use morula::solid::{Resolution, Solid, SolidOptions};
use parse::{Raw, above_0, bytes, not_negative, positive, positive_triple, raw, triple, whole};
use std::io::{IsTerminal, Write};
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
    /// [default: 0.000001]
    #[arg(long, value_name = "TOLERANCE", value_parser = not_negative)]
    weld: Option<f64>,
    /// Grey voxels above this are solid: a number, or otsu
    #[arg(long, value_name = "VALUE", conflicts_with = "label")]
    threshold: Option<String>,
    /// Take this label of a label volume
    #[arg(long, value_name = "LABEL", value_parser = whole::<u32>)]
    label: Option<u32>,
    /// Edge lengths of a voxel along x,y,z (one number: cubes) [default: 1]
    #[arg(long, value_name = "H|HX,HY,HZ", value_parser = positive_triple, allow_hyphen_values = true)]
    spacing: Option<[f64; 3]>,
    /// Lower corner of the first voxel [default: 0]
    #[arg(long, value_name = "X,Y,Z", value_parser = triple, allow_hyphen_values = true)]
    origin: Option<[f64; 3]>,
    /// Order of the axes of a .npy array [default: zyx]
    #[arg(long, value_enum, conflicts_with = "raw")]
    axes: Option<Axes>,
    /// Take the file for raw voxels, x fastest, whatever it looks like: dimensions, type (u8, u16,
    /// f32) and header bytes to skip
    #[arg(long, value_name = "NXxNYxNZ[:TYPE[:SKIP]]", value_parser = raw)]
    raw: Option<Raw>,
    /// Edges around a built-in particle (sample:NAME) [default: 64]
    #[arg(long, value_parser = whole::<usize>)]
    segments: Option<usize>,
    /// Seed of random choices, and which stone sample:stone is unless it says seed=N itself
    /// [default: 0, and the stone's own]
    #[arg(long, value_parser = whole::<u64>)]
    pub seed: Option<u64>,
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

impl Reading {
    fn import(&self) -> ImportOptions {
        ImportOptions {
            weld_tolerance: self.weld.unwrap_or(1e-6),
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
            spacing: self.spacing.unwrap_or([1.0; 3]),
            origin: self.origin.unwrap_or([0.0; 3]),
            npy_xyz: matches!(self.axes, Some(Axes::Xyz)),
            raw: self.raw,
            format: self.raw.map(|_| Format::Raw),
        })
    }

    /// Reads and checks the shape: a file, or `sample:NAME[,key=value…]`. Options that say
    /// nothing about such an input are refused: they would have been meant to.
    pub fn shape(&self, input: &str, run: &Run) -> Done<Shape> {
        let voxels = [
            ("--threshold", self.threshold.is_some()),
            ("--label", self.label.is_some()),
            ("--spacing", self.spacing.is_some()),
            ("--origin", self.origin.is_some()),
            ("--axes", self.axes.is_some()),
            ("--raw", self.raw.is_some()),
        ];
        if let Some(text) = input.strip_prefix("sample:") {
            refuse(input, "a built-in particle", &voxels)?;
            let particle = self.particle(text)?;
            return Shape::from_primitive(
                &particle,
                self.segments.unwrap_or(64),
                &self.import(),
                run,
            )
            .about(input);
        }
        let path = file(input)?;
        refuse(input, "a file", &[("--segments", self.segments.is_some())])?;
        let mut shape = Shape::from_file(path, &self.file_options()?, run).about(input)?;
        match *shape.body {
            Body::Mesh(_) => refuse(input, "a mesh", &voxels)?,
            Body::Voxels(_) => refuse(input, "voxels", &[("--weld", self.weld.is_some())])?,
        }
        if shape.report.label_like > 0 {
            // The library's own last note, in terms of the command line.
            shape.report.notes.pop();
            shape.report.notes.push(format!(
                "the volume holds {} different whole values and may be one of labels: morula info \
                 --labels lists them, --label takes one, --threshold otsu says that it is grey",
                shape.report.label_like
            ));
        }
        Ok(shape)
    }

    /// `tablet` or `tablet,band_height=3,cap_height=1`.
    fn particle(&self, text: &str) -> Done<Primitive> {
        let mut parts = text.split(',');
        let name = parts.next().unwrap_or("");
        let mut particle = Primitive::from_name(name).about("")?;
        if let (Primitive::Stone { seed: which, .. }, Some(seed)) = (&mut particle, self.seed) {
            if seed > 1 << 53 {
                return Err(Fail::Usage(format!("--seed {seed} of the stone is above 2^53")));
            }
            *which = seed;
        }
        for pair in parts {
            set(&mut particle, pair)?;
        }
        Ok(particle)
    }

    /// For the list of labels, which counts cells and takes all of them.
    pub fn counts_only(&self) -> Done {
        let given = [
            ("--label", self.label.is_some()),
            ("--threshold", self.threshold.is_some()),
            ("--spacing", self.spacing.is_some()),
            ("--origin", self.origin.is_some()),
            ("--weld", self.weld.is_some()),
            ("--segments", self.segments.is_some()),
        ];
        refuse("--labels", "a list of cells by label", &given)
    }

    /// For a command without a target.
    pub fn unread(&self) -> Done {
        let given = [
            ("--label", self.label.is_some()),
            ("--threshold", self.threshold.is_some()),
            ("--spacing", self.spacing.is_some()),
            ("--origin", self.origin.is_some()),
            ("--axes", self.axes.is_some()),
            ("--raw", self.raw.is_some()),
            ("--weld", self.weld.is_some()),
            ("--segments", self.segments.is_some()),
            ("--seed", self.seed.is_some()),
            ("--length-unit", self.length_unit != 1.0),
        ];
        refuse("a clump", "read without a --target", &given)
    }

    /// For commands that make no random choice.
    pub fn seed_is_of_stone(&self, input: &str) -> Done {
        let stone = input.split(',').next() == Some("sample:stone");
        refuse(input, "no sample:stone", &[("--seed", self.seed.is_some() && !stone)])
    }
}

/// What must be heard even in a pipe, of which `shape` is the result: that it may be the union
/// of several labels. On a terminal the notes are shown in their place.
pub fn warn(shape: &Shape, quiet: bool) {
    let mut err = std::io::stderr();
    if let Some(note) = shape.report.notes.last()
        && shape.report.label_like > 0
        && !quiet
        && !err.is_terminal()
    {
        let _ = writeln!(err, "note: {note}");
    }
}

/// A path that can be one.
pub fn file(input: &str) -> Done<&Path> {
    match input {
        "" => Err(Fail::Usage("the path of the input is empty".into())),
        path => Ok(Path::new(path)),
    }
}

/// Refuses the first option that was given (`true`) though it has no effect on `input`.
pub fn refuse(input: &str, what: &str, options: &[(&str, bool)]) -> Done {
    match options.iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((option, _)) => {
            Err(Fail::Usage(format!("{option} has no effect here: {input} is {what}")))
        }
    }
}

/// Refuses an output that would overwrite one of the inputs.
pub fn keep(inputs: &[&str], output: &str) -> Done {
    if output.is_empty() {
        return Err(Fail::Usage("the path of the output is empty".into()));
    }
    let Ok(there) = Path::new(output).canonicalize() else { return Ok(()) };
    for input in inputs {
        if Path::new(input).canonicalize().is_ok_and(|path| path == there) {
            return Err(Fail::Usage(format!("{output} is the input: it would be overwritten")));
        }
    }
    Ok(())
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
    /// Cells along the edge that --cells-along names [default: 64]
    #[arg(long, value_name = "N", value_parser = above_0)]
    cells: Option<u32>,
    /// Which length --cells counts along [default: longest]
    #[arg(long, value_enum)]
    cells_along: Option<Along>,
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
    fn given(&self) -> [(&'static str, bool); 3] {
        [
            ("--cells", self.cells.is_some()),
            ("--cells-along", self.cells_along.is_some()),
            ("--cell-size", self.cell_size.is_some()),
        ]
    }

    /// For a command without a target.
    pub fn unread(&self) -> Done {
        refuse("a clump", "read without a --target", &self.given())
    }

    /// The solid of a shape, read from `input`, on this grid.
    pub fn solid(&self, shape: &Shape, input: &str, reading: &Reading, run: &Run) -> Done<Solid> {
        Solid::new(shape, &self.options(shape, input, reading)?, run).about(input)
    }

    /// How the solid of a shape, read from `input`, is made.
    pub fn options(&self, shape: &Shape, input: &str, reading: &Reading) -> Done<SolidOptions> {
        if let Body::Voxels(_) = *shape.body {
            refuse(input, "voxels, whose own cells are the grid", &self.given())?;
        }
        let cells = self.cells.unwrap_or(64);
        let resolution = match (self.cell_size, self.cells_along.unwrap_or(Along::Longest)) {
            (Some(h), _) => Resolution::CellSize(h),
            (None, Along::Longest) => Resolution::CellsLongest(cells),
            (None, Along::Shortest) => Resolution::CellsShortest(cells),
            (None, Along::Diameter) => Resolution::CellsDiameter(cells),
        };
        Ok(SolidOptions {
            resolution,
            memory_limit: reading.memory_limit,
            ..SolidOptions::default()
        })
    }
}
