//! `morula info`: what a shape is.

use crate::clump::equivalent_diameter;
use crate::fail::{About, Done};
use crate::input::parse::{positive, whole};
use crate::input::{self, Reading};
use crate::labels;
use crate::progress::Bar;
use crate::write;
use morula::error::{count, figure};
use morula::math::{Inertia, Moments, PrincipalFrame};
use morula::shape::Report;
use morula::{Run, solid};
use serde_json::{Value, json};
use std::io::Write;

#[derive(clap::Args)]
pub struct Args {
    /// Shape: STL, OBJ, PLY, OFF, npy, TIFF or raw voxels, or sample:NAME[,key=value…]
    input: String,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// List the labels of a label volume instead
    #[arg(long)]
    labels: bool,
    /// Density, mass per cubed length unit [default: 1]
    #[arg(long, value_parser = positive, conflicts_with = "labels")]
    density: Option<f64>,
    /// Threads; 0: all cores
    #[arg(long, default_value_t = 0, value_parser = whole::<usize>)]
    threads: usize,
    /// No progress bar
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    reading: Reading,
}

pub fn run(args: &Args) -> Done {
    args.reading.seed_is_of_stone(&args.input)?;
    if args.labels {
        return labels::run(&args.input, &args.reading, args.json);
    }
    let bar = Bar::new("info", args.quiet);
    let run = bar.attach(Run::new(args.threads).about("")?);
    let shape = args.reading.shape(&args.input, &run)?;
    let unit = solid::moments::moments(&shape.body, &run).about(&args.input)?;
    drop(bar);
    input::warn(&shape, args.quiet);
    let moments = shape.frame.moments_to_input(&unit);
    // In the unit frame, as for a solid: the axes do not depend on the caller's unit.
    let mut principal = PrincipalFrame::of_rounded(&unit.inertia, shape.frame.noise());
    principal.moments = principal.moments.map(|m| m * shape.frame.scale.powi(5));
    write::to_stdout(|out| {
        if args.json {
            writeln!(out, "{}", object(args, &shape.report, &moments, &principal))
        } else {
            text(out, args, &shape.report, &moments, &principal)
        }
    })
}

impl Args {
    fn density(&self) -> f64 {
        self.density.unwrap_or(1.0)
    }
}

fn object(args: &Args, r: &Report, m: &Moments, p: &PrincipalFrame) -> Value {
    let rho = args.density();
    let axis = |i: usize| json!(p.axes.column(i).as_slice());
    json!({
        "input": args.input,
        "report": {
            "input_vertices": r.input_vertices, "input_faces": r.input_faces,
            "vertices": r.vertices, "faces": r.faces, "solid_cells": r.solid_cells,
            "components": r.components, "bodies": r.bodies,
            "bodies_dropped": r.bodies_dropped,
            "watertight": r.watertight, "oriented": r.oriented, "inverted": r.inverted,
            "faces_turned": r.faces_turned, "boundary_edges": r.boundary_edges,
            "nonmanifold_edges": r.nonmanifold_edges, "degenerate_faces": r.degenerate_faces,
            "duplicate_faces": r.duplicate_faces, "welded_vertices": r.welded_vertices,
            "touches_border": r.touches_border, "volume": r.volume, "area": r.area,
            "box_min": r.box_min, "box_max": r.box_max, "length_unit": r.length_unit,
            "threshold": r.threshold, "notes": r.notes,
        },
        "volume": m.volume,
        "relative_error": m.relative_error,
        "equivalent_diameter": equivalent_diameter(m.volume),
        "density": rho,
        "mass": rho * m.volume,
        "centre": m.centroid.as_slice(),
        "inertia": scaled(&m.inertia, rho),
        "principal_moments": p.moments.map(|i| rho * i),
        "axes": [axis(0), axis(1), axis(2)],
        "quaternion": p.quaternion,
    })
}

fn scaled(inertia: &Inertia, density: f64) -> [f64; 6] {
    inertia.to_array().map(|i| density * i)
}

fn text(
    out: &mut dyn Write,
    args: &Args,
    r: &Report,
    m: &Moments,
    p: &PrincipalFrame,
) -> std::io::Result<()> {
    let density = args.density();
    writeln!(out, "{}", args.input)?;
    if r.solid_cells > 0 {
        writeln!(out, "  voxels            {}", count(r.solid_cells, "solid cell"))?;
    } else {
        let (vertices, faces) = (count(r.vertices, "vertex"), count(r.faces, "face"));
        writeln!(out, "  mesh              {vertices}, {faces}")?;
    }
    writeln!(out, "  bodies            {} ({})", r.bodies, count(r.components, "component"))?;
    for (what, count) in [
        ("bodies dropped", r.bodies_dropped),
        ("vertices welded", r.welded_vertices),
        ("faces turned", r.faces_turned),
        ("boundary edges", r.boundary_edges),
        ("non-manifold", r.nonmanifold_edges),
        ("degenerate faces", r.degenerate_faces),
        ("duplicate faces", r.duplicate_faces),
    ] {
        if count > 0 {
            writeln!(out, "  {what:<16}  {count}")?;
        }
    }
    if r.solid_cells == 0 {
        let yes = |b: bool| if b { "yes" } else { "no" };
        writeln!(out, "  watertight        {}", yes(r.watertight))?;
        writeln!(out, "  oriented          {}", yes(r.oriented))?;
    }
    // No -0.
    let number = |x: &f64| format!("{:.6e}", x + 0.0);
    let numbers = |v: &[f64]| v.iter().map(number).collect::<Vec<_>>().join(" ");
    writeln!(out, "  box               {}", numbers(&r.box_min))?;
    writeln!(out, "                    {}", numbers(&r.box_max))?;
    writeln!(out, "  area              {:.6e}", r.area)?;
    writeln!(out, "  volume            {:.6e}", m.volume)?;
    if m.relative_error > 0.0 {
        writeln!(out, "  within            {:.1e} (relative)", m.relative_error)?;
    }
    writeln!(out, "  d_eq              {:.6e}", equivalent_diameter(m.volume))?;
    writeln!(out, "  mass              {:.6e} at density {}", density * m.volume, figure(density))?;
    writeln!(out, "  centre            {}", numbers(m.centroid.as_slice()))?;
    writeln!(out, "  inertia xx yy zz  {}", numbers(&scaled(&m.inertia, density)[..3]))?;
    writeln!(out, "  inertia xy xz yz  {}", numbers(&scaled(&m.inertia, density)[3..]))?;
    writeln!(out, "  principal         {}", numbers(&p.moments.map(|i| density * i)))?;
    for (i, name) in ["axis 1", "axis 2", "axis 3"].iter().enumerate() {
        writeln!(out, "  {name}            {}", numbers(p.axes.column(i).as_slice()))?;
    }
    writeln!(out, "  quaternion wxyz   {}", numbers(&p.quaternion))?;
    for note in &r.notes {
        writeln!(out, "  note: {note}")?;
    }
    Ok(())
}
