//! `morula break`: a shape in, fragments out: meshes, spheres, motion, a picture.

mod figures;
mod how;
mod picture;

use crate::export::Precision;
use crate::fail::{About, Done, Fail};
use crate::input::parse::{above_0, not_negative, numbers, positive, whole};
use crate::input::{self, Fineness, Reading};
use crate::progress::Bar;
use crate::view::{angle, size};
use crate::weighing::Weighing;
use crate::write;
use clap::ValueEnum;
use how::How;
use morula::export::{csv, save_in};
use morula::fragment::{
    CutOptions, Held, Parent, ReclumpOptions, ShatterOptions, Shattered, shape, shatter,
};
use morula::generate::{GenerateOptions, Method, generate};
use morula::mass::Body;
use morula::math::Vec3;
use morula::shape::Body as Surface;
use morula::{Run, Shape};
use serde_json::Value;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// Makes a clump of the shape as `morula clump` does, cuts the shape, fills each piece with spheres
/// and hands the body's motion over to them.
///
/// Into DIR go, for each fragment, fragment_000.stl (its surface) and fragment_000.csv (its spheres),
/// then fragments.json (masses, centres, inertia, poses, velocities, dust, quality, what is conserved)
/// and fragments.png. All of them are in the frame of the shape.
#[derive(clap::Args)]
pub struct Args {
    /// Shape: as for `morula clump`
    input: String,
    #[command(flatten)]
    how: How,
    /// Most spheres of a fragment
    #[arg(short = 'n', long = "spheres", value_name = "N", default_value_t = 20,
          value_parser = whole::<usize>)]
    spheres: usize,
    /// Folder to write into; it is made where there is none
    #[arg(short, long, value_name = "DIR")]
    output: String,
    /// Draw nothing
    #[arg(long)]
    no_picture: bool,
    /// Print fragments.json on stdout as well
    #[arg(long)]
    json: bool,
    /// Least radius of a fragment's sphere, in your length unit
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = not_negative)]
    min_radius: f64,
    /// Distance at least between spheres of two fragments, in your length unit
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = not_negative)]
    gap: f64,
    /// Pieces of less volume are dust [default: a 1e-9th of the shape's]
    #[arg(long, value_name = "VOLUME", default_value_t = 0.0, hide_default_value = true,
          value_parser = not_negative)]
    least_volume: f64,
    /// Let spheres of fragments leave the union of the shape's own spheres, as far as the surface:
    /// more of the volume is covered, but neighbours may be touched at once
    #[arg(long)]
    no_union: bool,
    /// f32: centres and radii are numbers of single precision, the spheres still within all that
    /// bounds them
    #[arg(long, value_enum, default_value_t = Precision::F64)]
    precision: Precision,
    /// Stop looking for better spheres after this many seconds of the break (the shape's own clump
    /// is not counted)
    #[arg(long, value_name = "SECONDS", value_parser = not_negative)]
    deadline: Option<f64>,
    /// Threads; 0: all cores. The result does not depend on it
    #[arg(long, default_value_t = 0, value_parser = whole::<usize>)]
    threads: usize,
    /// No progress bar, no summary, no notes
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    parent: ParentArgs,
    #[command(flatten)]
    weighing: Weighing,
    #[command(flatten)]
    drawing: Drawing,
    #[command(flatten)]
    fineness: Fineness,
    #[command(flatten)]
    reading: Reading,
}

#[derive(clap::Args)]
#[command(next_help_heading = "The body that breaks")]
struct ParentArgs {
    /// How its own clump is made, in the union of whose spheres those of the fragments stay:
    /// best (least mismatch) or inscribed (no sphere beyond the surface)
    #[arg(long, value_enum, default_value_t = MethodOfParent::Best)]
    parent: MethodOfParent,
    /// Spheres of that clump
    #[arg(short = 'N', long, value_name = "N", default_value_t = 50, value_parser = above_0)]
    parent_spheres: u32,
    /// Density, mass per cubed length unit [default: 1]; given, each sphere of a fragment has a mass
    #[arg(long, value_parser = positive)]
    density: Option<f64>,
    /// Velocity of its centre
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, default_value = "0,0,0",
          value_parser = numbers::<3>)]
    velocity: [f64; 3],
    /// Angular velocity, radians per time
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, default_value = "0,0,0",
          value_parser = numbers::<3>)]
    angular_velocity: [f64; 3],
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum MethodOfParent {
    Best,
    Inscribed,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Picture")]
struct Drawing {
    /// Turn of the viewer about z, degrees
    #[arg(long, default_value_t = -60.0, allow_hyphen_values = true, value_parser = angle)]
    azimuth: f64,
    /// Height of the viewer above the xy plane, degrees
    #[arg(long, default_value_t = 25.0, allow_hyphen_values = true, value_parser = angle)]
    elevation: f64,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1500x760", value_parser = size)]
    size: (usize, usize),
    /// How far fragments are drawn apart: this part of their distance from the body's centre
    #[arg(long, value_name = "PART", default_value_t = 0.4, value_parser = not_negative)]
    apart: f64,
}

/// A fragment's surface, or why there is none.
type Surfaces = Vec<Result<Shape, String>>;

pub fn run(args: &Args) -> Done {
    args.check()?;
    let start = Instant::now();
    let bar = Bar::new("break", args.quiet);
    let cut = args.how.cut()?;
    let run = bar.attach(args.new_run()?);
    let whole = args.reading.shape(&args.input, &run)?;
    let solid = args.fineness.solid(&whole, &args.input, &args.reading, &run)?;
    let method = match args.parent.parent {
        MethodOfParent::Best => Method::Best,
        MethodOfParent::Inscribed => Method::Inscribed,
    };
    let spheres = args.parent.parent_spheres as usize;
    let options = GenerateOptions { method, spheres, quality: None, ..Default::default() };
    let clump = generate(&solid, &options, &run).about(&args.input)?;
    let parent = Parent::new(Arc::new(solid), &clump.spheres, &run).about(&args.input)?;
    let body = Body::of_solid(parent.solid(), args.parent.density.unwrap_or(1.0));
    let held = args.held(&body.about(&args.input)?);
    let prepared = start.elapsed().as_secs_f64();
    drop(run);

    let mut run = args.new_run()?;
    if let Some(seconds) = args.deadline {
        run = run.with_deadline(seconds);
    }
    let run = bar.attach(run);
    let broken = shatter(&parent, None, &held, &cut, &args.options(), &run).about(&args.input)?;
    let broke = start.elapsed().as_secs_f64() - prepared;
    drop(run);

    let run = bar.attach(args.new_run()?);
    let surfaces: Surfaces = broken
        .fragments
        .iter()
        .map(|f| shape(parent.solid(), &f.region, &run).map_err(|e| e.to_string()))
        .collect();
    let object = figures::object(args, &parent, &held, &broken, &surfaces, [prepared, broke]);
    let mut files = files(&broken, &surfaces)?;
    files.push(("fragments.json".into(), format!("{object:#}\n").into_bytes()));
    if !args.no_picture {
        bar.say("drawing");
        let canvas = picture::draw(args, parent.solid(), &held, &broken, &surfaces, &run);
        let mut bytes = Vec::new();
        let path = Path::new(&args.output);
        canvas.about(&args.output)?.write_png(&mut bytes).map_err(|e| Fail::file(path, e))?;
        files.push(("fragments.png".into(), bytes));
    }
    drop(bar);
    input::warn(&whole, args.quiet);
    let folder = Path::new(&args.output);
    let inputs: Vec<&str> = std::iter::once(&args.input[..]).chain(args.how.file()).collect();
    for (name, _) in &files {
        input::keep(&inputs, &folder.join(name).to_string_lossy())?;
    }
    save_in(folder, &files).about("")?;
    if args.json {
        return write::to_stdout(|out| writeln!(out, "{object}"));
    }
    if !args.quiet {
        remarks(&object);
        write::to_terminal(|out| summary(out, &args.output, &object))?;
    }
    Ok(())
}

/// The name of what belongs to fragment `i`.
fn name(i: usize, ending: &str) -> String {
    format!("fragment_{i:03}.{ending}")
}

/// The meshes and the spheres.
fn files(broken: &Shattered, surfaces: &Surfaces) -> Done<Vec<(String, Vec<u8>)>> {
    let mut files = Vec::new();
    for (i, (f, surface)) in broken.fragments.iter().zip(surfaces).enumerate() {
        if let Ok(shape) = surface
            && let Surface::Mesh(mesh) = shape.body.as_ref()
        {
            let vertices: Vec<[f64; 3]> =
                mesh.vertices.iter().map(|v| shape.frame.to_input(v).into()).collect();
            let (name, mut bytes) = (name(i, "stl"), Vec::new());
            write::mesh::stl(&mut bytes, &vertices, &mesh.faces)
                .map_err(|e| Fail::file(Path::new(&name), e))?;
            files.push((name, bytes));
        }
        let masses = f.masses.as_ref().map_or(&[][..], |m| &m.masses);
        files.push((name(i, "csv"), csv(&f.clump.spheres, masses).into_bytes()));
    }
    Ok(files)
}

impl Args {
    /// What makes no sense, before any work.
    fn check(&self) -> Done {
        if self.output.is_empty() || self.output == "-" {
            return Err(Fail::Usage("-o takes the name of a folder".into()));
        }
        if self.parent.density.is_none() { self.weighing.needs_density() } else { Ok(()) }
    }

    fn new_run(&self) -> Done<Run<'static>> {
        Ok(Run::new(self.threads).about("")?.with_seed(self.reading.seed.unwrap_or(0)))
    }

    fn options(&self) -> ShatterOptions {
        ShatterOptions {
            cut: CutOptions { least_volume: self.least_volume },
            reclump: ReclumpOptions {
                spheres: self.spheres,
                min_radius: self.min_radius,
                gap: self.gap,
                union: !self.no_union,
                single: self.precision == Precision::F32,
                ..ReclumpOptions::default()
            },
            masses: self.parent.density.and_then(|_| self.weighing.options()),
        }
    }

    /// The body where it stands.
    fn held(&self, body: &Body) -> Held {
        Held {
            mass: body.mass,
            center: body.center,
            inertia: body.inertia,
            scale: 1.0,
            position: body.center,
            rotation: [1.0, 0.0, 0.0, 0.0],
            velocity: Vec3::from(self.parent.velocity),
            angular_velocity: Vec3::from(self.parent.angular_velocity),
        }
    }
}

/// What a person wants to know after a break.
fn summary(out: &mut dyn Write, folder: &str, object: &Value) -> std::io::Result<()> {
    let number = |v: &Value| v.as_f64().unwrap_or(0.0);
    let fragments = object["fragments"].as_array().map_or(&[][..], |f| f);
    writeln!(
        out,
        "{folder}: {}, {} of dust, {:.1} ms",
        morula::error::count(fragments.len() as u64, "fragment"),
        morula::error::count(object["dust"].as_array().map_or(0, Vec::len) as u64, "crumb"),
        1e3 * number(&object["seconds"]["break"]),
    )?;
    writeln!(out, "   spheres        mass  of volume  coverage")?;
    let whole = number(&object["parent"]["volume"]);
    for f in fragments {
        writeln!(
            out,
            "{:10}  {:10.4e}  {:7.2} %  {:6.2} %",
            f["n"].as_u64().unwrap_or(0),
            number(&f["mass"]),
            100.0 * number(&f["volume"]) / whole,
            100.0 * number(&f["coverage"]),
        )?;
    }
    Ok(())
}

/// What deserves a look, for a person at a terminal.
fn remarks(object: &Value) {
    let mut err = std::io::stderr();
    if !err.is_terminal() {
        return;
    }
    for note in object["notes"].as_array().into_iter().flatten() {
        let _ = writeln!(err, "note: {}", note.as_str().unwrap_or(""));
    }
}
