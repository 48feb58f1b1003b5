//! `morula measure`: what a clump is that a file holds, alone or against its target.

use crate::clump::equivalent_diameter;
use crate::fail::{About, Done};
use crate::given::Given;
use crate::input;
use crate::input::parse::{positive, whole};
use crate::progress::Bar;
use crate::{figures, weighing, write};
use morula::Run;
use morula::error::count;
use morula::mass::{Body, inertia_error, union_moments};
use morula::measure::{QualityOptions, quality};
use serde_json::{Value, json};
use std::f64::consts::PI;

#[derive(clap::Args)]
pub struct Args {
    /// The clump: CSV or JSON as written by `morula clump`, or a file of a DEM code (LAMMPS, LIGGGHTS,
    /// Kratos, Chrono, a folder of MercuryDPM)
    clump: String,
    /// The shape that the clump stands for, as for `morula clump`
    #[arg(long, value_name = "IN")]
    target: Option<String>,
    /// Density, mass per cubed length unit: adds mass, centre and inertia of the union of the spheres
    #[arg(long, value_parser = positive)]
    density: Option<f64>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Columns along each of the two sampled axes of the quality figures, 8 to 8192 [default: 256]
    #[arg(long, value_name = "N", value_parser = whole::<usize>, requires = "target")]
    columns: Option<usize>,
    #[command(flatten)]
    given: Given,
}

pub fn run(args: &Args) -> Done {
    let bar = Bar::new("measure", args.given.quiet);
    let run = bar.attach(Run::new(args.given.threads).about("")?);
    let (mut template, frame) = args.given.clump(&args.clump)?;
    let mut map = serde_json::Map::new();
    if let Some(path) = &args.target {
        let (shape, solid) = args.given.target(path, (&mut template, frame), &run)?;
        let mut options = QualityOptions::default();
        options.columns = args.columns.unwrap_or(options.columns);
        let q = quality(&solid, &template.spheres, &options, &run).about(&args.clump)?;
        input::warn(&shape, args.given.quiet);
        let union = union_moments(&template.spheres, &run).about(&args.clump)?;
        let moments = solid.moments();
        let lacking = inertia_error(&moments, &union);
        map.extend(figures::quality(Some(&q), Some(&q), Some(lacking)));
        map.insert("volume".into(), moments.volume.into());
        map.insert("equivalent_diameter".into(), equivalent_diameter(moments.volume).into());
    } else {
        args.given.unread()?;
    }
    let spheres = &template.spheres;
    let union = union_moments(spheres, &run).about(&args.clump)?;
    let radii = || spheres.iter().map(|s| s.radius);
    map.extend(
        match json!({
            "clump": args.clump,
            "n": spheres.len(),
            "least_radius": radii().fold(f64::MAX, f64::min),
            "greatest_radius": radii().fold(0.0, f64::max),
            "sum_of_volumes": radii().map(|r| 4.0 / 3.0 * PI * r.powi(3)).sum::<f64>(),
            "union_volume": union.volume,
            "union_centre": union.centroid.as_slice(),
            "stated_volume": template.volume,
            "stated_mass": template.mass,
        }) {
            Value::Object(more) => more,
            _ => serde_json::Map::new(),
        },
    );
    if let Some(density) = args.density {
        let body = Body::of_moments(&union, density).about(&args.clump)?;
        map.extend(weighing::body_keys(&body, false));
    }
    drop(bar);
    let figures = Value::Object(map);
    write::to_stdout(
        |out| {
            if args.json { writeln!(out, "{figures}") } else { table(out, &figures) }
        },
    )
}

fn table(out: &mut dyn std::io::Write, figures: &Value) -> std::io::Result<()> {
    let number = |key: &str| figures.get(key).and_then(Value::as_f64);
    let n = figures["n"].as_u64().unwrap_or(0);
    writeln!(out, "{}: {}", figures["clump"].as_str().unwrap_or(""), count(n, "sphere"))?;
    let rows = [
        ("radii from", "least_radius"),
        ("to", "greatest_radius"),
        ("sum of the spheres' volumes", "sum_of_volumes"),
        ("volume of their union", "union_volume"),
        ("volume stated in the file", "stated_volume"),
        ("mass stated in the file", "stated_mass"),
        ("volume of the target", "volume"),
        ("mismatch D", "D"),
        ("coverage", "coverage"),
        ("overshoot", "overshoot"),
        ("protrusion", "protrusion"),
        ("RMS distance of the surfaces", "rms_distance"),
        ("Hausdorff distance", "hausdorff"),
        ("distance of the centres / d_eq", "centroid_error"),
        ("inertia missing, of the target's", "inertia_error"),
        ("  of a target shrunk to coverage", "inertia_error_of_coverage"),
        ("mass of the union", "mass"),
    ];
    for (name, key) in rows {
        if let Some(value) = number(key) {
            writeln!(out, "{name:33} {value:.6e}")?;
        }
    }
    Ok(())
}
