//! `morula clump`: a shape in, spheres out.

use crate::covering::Covering;
use crate::demands::Demands;
use crate::fail::{About, Done, Fail};
use crate::figures;
use crate::input::parse::{finite, not_negative, positive, whole};
use crate::input::{self, Fineness, Reading};
use crate::method::{EffortArg, MethodArg};
use crate::progress::Bar;
use crate::weighing::{self, Weighing};
use crate::write::{self, ClumpFormat};
use clap::ValueEnum;
use morula::error::count;
use morula::generate::{GenerateOptions, Method, OVERLAP, generate};
use morula::mass::{Body, Masses};
use morula::measure::QualityOptions;
use morula::{Clump, Run, Shape, Solid};
use serde_json::{Value, json};
use std::io::{IsTerminal, Write};
use std::time::Instant;

#[derive(clap::Args)]
pub struct Args {
    /// Shape: STL, OBJ, PLY, OFF, npy, TIFF or raw voxels, or sample:NAME[,key=value…]
    input: String,
    /// Number of spheres; 0: no limit, which takes another criterion [default: 50, or 0 with
    /// --mismatch, --min-radius, --coverage or --method surface-fit]
    #[arg(short = 'n', long = "spheres", value_name = "N", value_parser = whole::<usize>)]
    spheres: Option<usize>,
    /// File to write; - is stdout [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<String>,
    /// Format of the file [default: told by its extension, else csv]
    #[arg(long, value_enum)]
    format: Option<ClumpFormat>,
    /// Print one JSON object with the figures on stdout (with the spheres when no file is named)
    #[arg(long)]
    json: bool,
    /// Frame of the spheres: the input's, or the body's (centre of mass, principal axes)
    #[arg(long, value_enum, default_value_t = Frame::Input)]
    frame: Frame,
    /// Density, mass per cubed length unit: adds mass, centre and inertia to the figures, and a mass
    /// to each sphere
    #[arg(long, value_parser = positive)]
    density: Option<f64>,
    /// Quality to measure: overlap (D, coverage, overshoot), full (also the surface), none
    #[arg(long, value_enum, default_value_t = Wanted::Full)]
    quality: Wanted,
    /// Columns along each of the two sampled axes of the quality figures, 8 to 8192 [default: 256]
    #[arg(long, value_name = "N", value_parser = whole::<usize>)]
    columns: Option<usize>,
    /// Count the spheres that one plane touches within this length; may be given more than once
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    plane_tolerance: Vec<f64>,
    /// Threads; 0: all cores. The result does not depend on it
    #[arg(long, default_value_t = 0, value_parser = whole::<usize>)]
    threads: usize,
    /// No progress bar, no summary, no notes
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    weighing: Weighing,
    /// Whose mass, centre and inertia the clump has: the shape's (mesh or voxels), or those of
    /// the union of its spheres
    #[arg(long, value_enum, default_value_t = TargetArg::Mesh, help_heading = "Masses")]
    target: TargetArg,
    #[command(flatten)]
    making: Making,
    #[command(flatten)]
    covering: Covering,
    #[command(flatten)]
    demands: Demands,
    #[command(flatten)]
    fineness: Fineness,
    #[command(flatten)]
    reading: Reading,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Method")]
struct Making {
    /// How spheres are found
    #[arg(long, value_enum, default_value_t = MethodArg::Best)]
    method: MethodArg,
    /// How long methods best and inscribed look for a clump
    #[arg(long, value_enum, default_value_t = EffortArg::Normal)]
    effort: EffortArg,
    /// Stop at this mismatch D. Method mss counts it on its own grid: the D that is measured on the
    /// result may differ a little, less so with more --cells
    #[arg(long, value_name = "D", value_parser = not_negative)]
    mismatch: Option<f64>,
    /// Stop at the first checkpoint after this many seconds, with the spheres found so far;
    /// with -n 0 the only criterion
    #[arg(long, value_name = "SECONDS", value_parser = not_negative)]
    deadline: Option<f64>,
    /// Least radius, in your length unit
    #[arg(long, value_name = "LENGTH", value_parser = not_negative)]
    min_radius: Option<f64>,
    /// Least distance between centres, in cells
    #[arg(long, value_name = "CELLS", default_value_t = 0.0, value_parser = not_negative)]
    min_distance: f64,
    /// Added to every radius, in cells
    #[arg(long, value_name = "CELLS", default_value_t = 0.0, value_parser = finite)]
    radius_offset: f64,
    /// Let no sphere reach beyond the true surface
    #[arg(long)]
    confine: bool,
    /// How far spheres of the methods inscribed, euclidean, ferellec-mcdowell, favier and
    /// uniform-grid may reach beyond the surface, in your length unit
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = not_negative)]
    tolerance: f64,
    /// By which part of its radius method euclidean shrinks a sphere before it is taken from the
    /// body, 0 to 1; 0: no sphere overlaps another
    #[arg(long, value_name = "PART", default_value_t = OVERLAP, value_parser = not_negative)]
    overlap: f64,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Wanted {
    Full,
    Overlap,
    None,
}

/// Whose mass a clump has.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum TargetArg {
    Mesh,
    Union,
}

/// The frame of spheres in a file.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum Frame {
    /// The input's coordinates
    Input,
    /// Origin at the centre of mass, principal axes
    Body,
}

impl Frame {
    /// Its name in a JSON clump.
    pub fn name(self) -> &'static str {
        match self {
            Frame::Input => "input",
            Frame::Body => "body",
        }
    }
}

pub fn run(args: &Args) -> Done {
    let start = Instant::now();
    let output = match (args.output.as_deref(), args.json) {
        (Some("-"), true) => {
            return Err(Fail::Usage("--json and -o - both want stdout".into()));
        }
        (Some(path), _) => Some(path),
        (None, true) => match args.format {
            None | Some(ClumpFormat::Json) => None,
            Some(_) => {
                return Err(Fail::Usage(
                    "--format is of a file, but --json prints on stdout: name a file with -o"
                        .into(),
                ));
            }
        },
        (None, false) => Some("-"),
    };
    if let Some(path) = output.filter(|path| *path != "-") {
        input::keep(&[&args.input], path)?;
    }
    let told = args.json || output.is_some_and(|path| args.format_of(path) == ClumpFormat::Json);
    if !args.plane_tolerance.is_empty() && !told {
        return Err(Fail::Usage(
            "--plane-tolerance has no effect here: only JSON holds the counts".into(),
        ));
    }
    if args.columns.is_some() && args.quality == Wanted::None {
        return Err(Fail::Usage(
            "--columns has no effect here: --quality none measures none".into(),
        ));
    }
    if args.density.is_none() {
        args.weighing.needs_density()?;
        if args.target == TargetArg::Union {
            return Err(Fail::Usage("--target union takes a --density".into()));
        }
    }
    let options = args.generate_options();
    // The library would take the progress bar for one who can cancel.
    if options.spheres == 0
        && options.method != Method::SurfaceFit
        && options.mismatch == 0.0
        && options.min_radius == 0.0
        && options.coverage == 0.0
        && args.making.deadline.is_none()
    {
        return Err(Fail::Usage(
            "-n 0 takes a criterion: --mismatch, --min-radius, --coverage or --deadline".into(),
        ));
    }
    let bar = Bar::new("clump", args.quiet);
    let mut run = Run::new(args.threads).about("")?.with_seed(args.reading.seed.unwrap_or(0));
    if let Some(seconds) = args.making.deadline {
        run = run.with_deadline(seconds);
    }
    let run = bar.attach(run);
    let shape = args.reading.shape(&args.input, &run)?;
    let solid = args.fineness.solid(&shape, &args.input, &args.reading, &run)?;
    let clump = generate(&solid, &options, &run).about(&args.input)?;
    drop(bar);
    input::warn(&shape, args.quiet);

    let spheres = match args.frame {
        Frame::Input => clump.spheres.clone(),
        Frame::Body => solid.to_body(&clump.spheres),
    };
    let weighed = args.weigh(&solid, &clump, &run)?;
    let lacking = figures::lacking(&solid, &clump, &run).about(&args.input)?;
    let weighing = (weighed.as_ref(), lacking);
    let figures = figures(args, (&shape, &solid), &clump, weighing, start);
    let masses = weighed.as_ref().and_then(|(_, m)| m.as_ref()).map_or(&[][..], |m| &m.masses);
    let spheres = (&spheres[..], masses);
    if let Some(path) = output {
        write::to(path, |out| write::clump(out, args.format_of(path), spheres, &figures))?;
    }
    if args.json {
        let format = ClumpFormat::Json;
        return write::to_stdout(|out| match output {
            None => write::clump(out, format, spheres, &figures),
            Some(_) => writeln!(out, "{figures}"),
        });
    }
    if !args.quiet {
        remarks(&figures);
        if let Some(path) = output.filter(|path| *path != "-") {
            return write::to_terminal(|out| summary(out, path, &figures));
        }
    }
    Ok(())
}

impl Args {
    /// The format of the file at `path`.
    fn format_of(&self, path: &str) -> ClumpFormat {
        self.format.unwrap_or_else(|| ClumpFormat::of_name(path))
    }

    /// Mass, centre and inertia at the density, and the masses of the spheres.
    fn weigh(
        &self,
        solid: &Solid,
        clump: &Clump,
        run: &Run,
    ) -> Done<Option<(Body, Option<Masses>)>> {
        let Some(density) = self.density else { return Ok(None) };
        let body = match self.target {
            TargetArg::Mesh => Body::of_solid(solid, density),
            TargetArg::Union => Body::of_union(&clump.spheres, density, run),
        };
        let body = body.about(&self.input)?;
        let masses = self.weighing.masses(&clump.spheres, &body, &self.input, run)?;
        Ok(Some((body, masses)))
    }

    /// Whether anything is measured: plane contacts are asked for by their tolerances.
    fn measures(&self) -> bool {
        self.quality != Wanted::None || !self.plane_tolerance.is_empty()
    }

    fn generate_options(&self) -> GenerateOptions {
        let m = &self.making;
        let coverage = self.covering.coverage;
        let unbounded = m.mismatch.is_some()
            || m.min_radius.is_some()
            || coverage.is_some()
            || matches!(m.method, MethodArg::SurfaceFit);
        GenerateOptions {
            method: m.method.into(),
            effort: m.effort.into(),
            spheres: self.spheres.unwrap_or(if unbounded { 0 } else { 50 }),
            mismatch: m.mismatch.unwrap_or(0.0),
            min_radius: m.min_radius.unwrap_or(0.0),
            min_distance: m.min_distance,
            radius_offset: m.radius_offset,
            confine: m.confine,
            coverage: coverage.unwrap_or(0.0),
            cover: self.covering.options(),
            best: self.demands.options(),
            tolerance: m.tolerance,
            overlap: m.overlap,
            quality: self.measures().then(|| QualityOptions {
                overlap: self.quality != Wanted::None,
                surface: self.quality == Wanted::Full,
                plane_tolerances: self.plane_tolerance.clone(),
                columns: self.columns.unwrap_or(QualityOptions::default().columns),
            }),
        }
    }
}

/// The keys of `--json`. What was not measured is null.
fn figures(
    args: &Args,
    (shape, solid): (&Shape, &Solid),
    clump: &Clump,
    (weighed, lacking): (Option<&(Body, Option<Masses>)>, Option<f64>),
    start: Instant,
) -> Value {
    let measured = clump.quality.as_ref();
    let q = measured.filter(|_| args.quality != Wanted::None);
    let surface = measured.filter(|_| args.quality == Wanted::Full);
    let planes = measured.filter(|_| !args.plane_tolerance.is_empty());
    let (moments, principal) = (solid.moments(), solid.principal());
    let c = &clump.counters;
    let [read, check, grid, generate, measure, integrate] = c.seconds;
    let notes: Vec<&String> = shape.report.notes.iter().chain(solid.notes()).collect();
    let mut v = json!({
        "input": args.input,
        "n": clump.spheres.len(),
        "plane_contacts": planes.map(|q| q.plane_contacts.clone()),
        "stopped": clump.stopped.name(),
        "note": clump.note,
        "notes": notes,
        "warnings": figures::warnings(clump),
        "volume": moments.volume,
        "equivalent_diameter": equivalent_diameter(moments.volume),
        "cells": solid.grid().dims,
        "frame": args.frame.name(),
        "position": moments.centroid.as_slice(),
        "quaternion": principal.quaternion,
        "stages": {
            "read": read, "check": check, "solid": grid, "generate": generate,
            "measure": measure, "moments": integrate,
        },
        "peak_bytes": c.peak_bytes,
    });
    if let Some(map) = v.as_object_mut() {
        map.extend(figures::quality(q, surface, lacking));
        map.extend(
            weighed
                .map(|(body, _)| weighing::body_keys(body, args.frame == Frame::Body))
                .unwrap_or_default(),
        );
        map.extend(
            weighed.and_then(|(_, masses)| masses.as_ref()).map(weighing::keys).unwrap_or_default(),
        );
    }
    if let Some(map) = v.as_object_mut() {
        map.insert("seconds".into(), start.elapsed().as_secs_f64().into());
    }
    v
}

/// Diameter of the sphere of this volume.
pub fn equivalent_diameter(volume: f64) -> f64 {
    (6.0 * volume.max(0.0) / std::f64::consts::PI).cbrt()
}

/// What a person wants to know after a clump was written.
fn summary(out: &mut dyn Write, path: &str, figures: &Value) -> std::io::Result<()> {
    let number = |key: &str| figures.get(key).and_then(Value::as_f64);
    write!(out, "{path}: {}", count(figures["n"].as_u64().unwrap_or(0), "sphere"))?;
    if let Some(d) = number("D") {
        write!(out, ", D {d:.4}")?;
    }
    if let (Some(c), Some(o)) = (number("coverage"), number("overshoot")) {
        write!(out, ", coverage {:.2} %, overshoot {:.2} %", 100.0 * c, 100.0 * o)?;
    }
    if let (Some(p), Some(d)) = (number("protrusion"), number("equivalent_diameter")) {
        write!(out, ", protrusion {p:.3e} ({:.2} % of d_eq)", 100.0 * p / d)?;
    }
    if let Some(mass) = number("mass") {
        write!(out, ", mass {mass:.6e}")?;
    }
    let seconds = number("seconds").unwrap_or(0.0);
    let stopped = figures["stopped"].as_str().unwrap_or("");
    writeln!(out, ", {:.0} ms, stopped by {stopped}", 1e3 * seconds)
}

/// What deserves a look (fewer spheres than asked for, a thin shape), for a person at a
/// terminal; `--json` holds it for programs.
fn remarks(figures: &Value) {
    let mut err = std::io::stderr();
    if !err.is_terminal() {
        return;
    }
    let notes = figures["notes"].as_array().into_iter().flatten();
    for note in std::iter::once(&figures["note"]).chain(notes) {
        if let Some(text) = note.as_str().filter(|t| !t.is_empty()) {
            let _ = writeln!(err, "note: {text}");
        }
    }
}
