//! `morula view`: a picture of a clump beside its target. Left the target, in
//! the middle the clump, coloured by how far its surface lies from the
//! target's, right a section through both.

pub mod buffer;
pub mod camera;
pub mod canvas;
pub mod colour;
pub mod error;
mod font;
mod section;
pub mod shade;
pub mod surface;

use crate::clump::equivalent_diameter;
use crate::fail::{About, Done, Fail};
use crate::given::Given;
use crate::input;
use crate::input::parse::positive;
use crate::progress::Bar;
use crate::write;
use buffer::Buffer;
use camera::Camera;
use canvas::{Align, Canvas, Rgb};
use morula::measure::{Quality, QualityOptions, quality};
use morula::{Run, Solid, Sphere};
use shade::Light;
use std::path::Path;

/// Samples along each edge of a pixel.
pub const FINE: usize = 3;

#[derive(clap::Args)]
pub struct Args {
    /// The target: as for `morula clump`
    input: String,
    /// The clump: CSV or JSON as written by `morula clump`, or a file of a DEM code (LAMMPS, LIGGGHTS, Kratos,
    /// Chrono, a folder of MercuryDPM)
    clump: String,
    /// Picture to write, a PNG; - is stdout
    #[arg(short, long, value_name = "FILE.png")]
    output: String,
    /// Turn of the viewer about z, degrees
    #[arg(long, default_value_t = -60.0, allow_hyphen_values = true, value_parser = angle)]
    azimuth: f64,
    /// Height of the viewer above the xy plane, degrees
    #[arg(long, default_value_t = 25.0, allow_hyphen_values = true, value_parser = angle)]
    elevation: f64,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1500x600", value_parser = size)]
    size: (usize, usize),
    /// End of the colour scale, in percent of the equivalent diameter [default: what fits]
    #[arg(long, value_name = "PERCENT", value_parser = positive)]
    scale: Option<f64>,
    #[command(flatten)]
    given: Given,
}

pub fn run(args: &Args) -> Done {
    if args.output != "-" {
        input::keep(&[&args.input, &args.clump], &args.output)?;
    }
    let extension = Path::new(&args.output).extension();
    if extension.is_some_and(|e| !e.eq_ignore_ascii_case("png")) {
        return Err(Fail::Usage(format!("{} is no name for a PNG picture", args.output)));
    }
    let bar = Bar::new("view", args.given.quiet);
    let run = bar.attach(Run::new(args.given.threads).about("")?);
    let (mut template, frame) = args.given.clump(&args.clump)?;
    let (shape, solid) = args.given.target(&args.input, (&mut template, frame), &run)?;
    let spheres = template.spheres;
    let measured =
        quality(&solid, &spheres, &QualityOptions::default(), &run).about(&args.clump)?;
    let canvas = picture(args, &solid, &spheres, &measured, &run).about(&args.output)?;
    drop(bar);
    input::warn(&shape, args.given.quiet);
    write::to(&args.output, |out| canvas.write_png(out))
}

/// Where things stand on the picture, in pixels.
struct Layout {
    text: f32,
    panel: [usize; 2],
    top: usize,
    left: [usize; 3],
    foot: f32,
}

impl Layout {
    fn of(width: usize, height: usize) -> Layout {
        let text = (width.min(3 * height) as f32 / 105.0).max(7.0);
        let top = (5.4 * text) as usize;
        let foot = height as f32 - 6.0 * text;
        let gap = (width / 100).max(2);
        let panel = [(width - 4 * gap) / 3, (foot as usize).saturating_sub(top).max(8)];
        let left = [0, 1, 2].map(|i| gap + i * (panel[0] + gap));
        Layout { text, panel, top, left, foot }
    }

    fn middle(&self, i: usize) -> f32 {
        self.left[i] as f32 + 0.5 * self.panel[0] as f32
    }
}

fn picture(
    args: &Args,
    solid: &Solid,
    spheres: &[Sphere],
    measured: &Quality,
    run: &Run,
) -> morula::Result<Canvas> {
    let (width, height) = args.size;
    let mut canvas = Canvas::new(width, height)?;
    let layout = Layout::of(width, height);
    let unit: Vec<Sphere> = spheres.iter().map(|s| solid.frame().sphere_to_unit(s)).collect();
    let target = surface::triangles(solid.body());
    let mut camera = Camera::new(args.azimuth, args.elevation);
    let corners = target.iter().flat_map(|t| t.corners).map(|p| (p, 0.0));
    camera.frame(
        corners.chain(unit.iter().map(|s| (s.center, s.radius))),
        layout.panel.map(|p| 0.937 * p as f64),
    );

    let mut body = Buffer::new(layout.panel[0], layout.panel[1], FINE, &camera)?;
    body.triangles(target.into_iter());
    let place = |i: usize| [layout.left[i], layout.top];
    shade::draw(&mut canvas, place(0), &body, FINE, Light::Body, run.pool(), |_, _, _| {
        colour::body()
    });

    let mut clump = Buffer::new(layout.panel[0], layout.panel[1], FINE, &camera)?;
    clump.spheres(&unit, run.pool());
    let diameter = equivalent_diameter(solid.unit_moments().volume);
    let errors = error::errors(solid, &clump, diameter, run)?;
    let end = args.scale.unwrap_or_else(|| error::fitting_scale(&errors));
    shade::draw(&mut canvas, place(1), &clump, FINE, Light::Data, run.pool(), |x, y, _| {
        colour::diverging(errors[x + clump.width * y] / end as f32)
    });
    section::draw(&mut canvas, place(2), layout.panel, &camera, solid, &unit, run)?;
    words(&mut canvas, &layout, args, spheres.len(), measured, solid, end);
    Ok(canvas)
}

fn words(
    canvas: &mut Canvas,
    layout: &Layout,
    args: &Args,
    count: usize,
    q: &Quality,
    solid: &Solid,
    end: f64,
) {
    let (dark, soft) = (colour::dark(), colour::soft());
    let t = layout.text;
    let diameter = equivalent_diameter(solid.moments().volume);
    let name = Path::new(&args.input).file_name().and_then(|n| n.to_str()).unwrap_or(&args.input);
    let figures = format!(
        "n {count}   D {:.4}   coverage {:.1} %   overshoot {:.1} %   protrusion {:.1} % of d_eq",
        q.mismatch,
        100.0 * q.coverage,
        100.0 * q.overshoot,
        100.0 * q.protrusion / diameter,
    );
    let left = layout.left[0] as f32;
    canvas.text(name, left, 2.0 * t, 1.25 * t, Align::Left, dark);
    let after = left + canvas::text_width(name, 1.25 * t) + 2.0 * t;
    canvas.text(&figures, after, 2.0 * t, 1.25 * t, Align::Left, soft);
    for (i, title) in ["target", "clump, coloured by surface error", "section"].iter().enumerate() {
        canvas.text(title, layout.middle(i), 4.6 * t, t, Align::Centre, soft);
    }
    let at = [layout.middle(1), layout.foot + 0.8 * t];
    error::bar(canvas, at, 0.34 * layout.panel[0] as f32, t, end);
    legend(canvas, layout, dark);
}

/// What the colours of the section mean.
fn legend(canvas: &mut Canvas, layout: &Layout, dark: Rgb) {
    let t = layout.text;
    let entries = [
        ("covered", section::both()),
        ("missed", section::missed()),
        ("beyond", section::beyond()),
    ];
    let total: f32 =
        entries.iter().map(|(n, _)| canvas::text_width(n, 0.9 * t) + 3.2 * t).sum::<f32>()
            - 1.8 * t;
    let mut x = layout.middle(2) - 0.5 * total;
    let y = layout.foot + 1.7 * t;
    for (name, colour) in entries {
        canvas.rectangle([x, x + 0.9 * t], [y - 0.9 * t, y], colour);
        canvas.text(name, x + 1.4 * t, y, 0.9 * t, Align::Left, dark);
        x += canvas::text_width(name, 0.9 * t) + 3.2 * t;
    }
}

/// Degrees.
pub fn angle(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(v) if v.abs() <= 360.0 => Ok(v),
        _ => Err(format!("{text} is not an angle within ±360 degrees")),
    }
}

/// Pixels.
pub fn size(text: &str) -> Result<(usize, usize), String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match parsed {
        Some((w, h)) if (120..=8000).contains(&w) && (100..=8000).contains(&h) => Ok((w, h)),
        Some((w, h)) => Err(format!("{w}x{h} is outside 120x100 … 8000x8000")),
        None => Err(format!("{text} is not of the form WIDTHxHEIGHT")),
    }
}
