//! `morula export`: a clump in, the files of a DEM code out.

use crate::fail::{About, Done, Fail};
use crate::given::Given;
use crate::input;
use crate::input::parse::{positive, whole};
use crate::progress::Bar;
use crate::weighing::Weighing;
use crate::write;
use clap::ValueEnum;
use clap::builder::PossibleValue;
use morula::Run;
use morula::error::count;
use morula::export::{ExportOptions, Format, Record, files, save};
use morula::mass::{Body, MassStatus, Masses};
use std::path::Path;

#[derive(clap::Args)]
pub struct Args {
    /// The clump: CSV or JSON as written by `morula clump`, or a file of a DEM code (LAMMPS, LIGGGHTS,
    /// Kratos, Chrono, a folder of MercuryDPM)
    clump: String,
    /// The shape whose mass, centre and inertia the clump has, as for `morula clump` [default: the
    /// union of the spheres]
    #[arg(long, value_name = "IN")]
    target: Option<String>,
    /// Density, mass per cubed length unit
    #[arg(long, value_parser = positive)]
    density: f64,
    /// Format
    #[arg(long, value_enum)]
    to: To,
    /// File to write, for mercury a folder
    #[arg(short, long, value_name = "PATH")]
    output: String,
    /// Name of the template [default: that of the output]
    #[arg(long)]
    name: Option<String>,
    /// Units of length of the file in one of yours (1000: m to mm)
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = positive)]
    length: f64,
    /// Units of mass of the file in one of yours
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = positive)]
    mass: f64,
    /// Write coordinates in the target's frame instead of the body's, where the format has a choice
    #[arg(long)]
    placed: bool,
    /// Facets of each sphere of ply and stl: 20 · 4^N triangles, N at most 6
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = whole::<u32>)]
    facets: u32,
    /// f32: centres and radii are numbers of single precision, each sphere within the one that it
    /// stands for, for codes that read them so
    #[arg(long, value_enum, default_value_t = Precision::F64)]
    precision: Precision,
    #[command(flatten)]
    weighing: Weighing,
    #[command(flatten)]
    given: Given,
}

/// The numbers of a file.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum Precision {
    F64,
    F32,
}

/// A format by the library's name for it.
#[derive(Clone, Copy)]
struct To(Format);

impl ValueEnum for To {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [To; Format::ALL.len()] = {
            let mut all = [To(Format::Csv); Format::ALL.len()];
            let mut i = 0;
            while i < all.len() {
                all[i] = To(Format::ALL[i]);
                i += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()))
    }
}

pub fn run(args: &Args) -> Done {
    let inputs: Vec<&str> =
        std::iter::once(&args.clump).chain(&args.target).map(|p| &p[..]).collect();
    input::keep(&inputs, &args.output)?;
    if args.output == "-" {
        return Err(Fail::Usage(
            "a format may have several files: -o - is no place for them".into(),
        ));
    }
    let bar = Bar::new("export", args.given.quiet);
    let run = bar.attach(Run::new(args.given.threads).about("")?);
    let (mut template, frame) = args.given.clump(&args.clump)?;
    let body = match &args.target {
        Some(path) => {
            let (_, solid) = args.given.target(path, (&mut template, frame), &run)?;
            Body::of_solid(&solid, args.density).about(path)?
        }
        None => {
            args.given.unread()?;
            Body::of_union(&template.spheres, args.density, &run).about(&args.clump)?
        }
    };
    let spheres = &template.spheres;
    let masses = self::masses(args, &template.spheres, &body, &run)?;
    let stem = || Path::new(&args.output).file_stem().and_then(|n| n.to_str()).unwrap_or("clump");
    let name = args.name.as_deref().unwrap_or_else(stem);
    let record = Record::new(name, spheres, &masses.masses, &body).about(&args.clump)?;
    let options = ExportOptions {
        length: args.length,
        mass: args.mass,
        placed: args.placed,
        facets: args.facets,
        single: args.precision == Precision::F32,
    };
    let files = files(&record, args.to.0, &options).about(&args.clump)?;
    drop(bar);
    save(&files, Path::new(&args.output)).about("")?;
    if args.given.quiet {
        return Ok(());
    }
    write::to_terminal(|out| {
        files.iter().try_for_each(|f| {
            let place = f.place.of(Path::new(&args.output));
            writeln!(out, "{}: {} bytes", place.display(), f.bytes.len())
        })?;
        let r = masses.residuals;
        match masses.status {
            MassStatus::Exact => Ok(()),
            MassStatus::Relaxed => writeln!(
                out,
                "no masses of {} have the inertia of the body: least error {:.2e}",
                count(spheres.len() as u64, "sphere"),
                r.inertia
            ),
            MassStatus::MassOnly => writeln!(
                out,
                "no masses have the centre of the body: {:.2e} of its radius of gyration off",
                r.center
            ),
        }
    })
}

fn masses(args: &Args, spheres: &[morula::Sphere], body: &Body, run: &Run) -> Done<Masses> {
    let masses = args.weighing.masses(spheres, body, &args.clump, run)?;
    masses.ok_or_else(|| {
        Fail::Usage("--masses none: the formats of DEM codes have a mass for each sphere".into())
    })
}
