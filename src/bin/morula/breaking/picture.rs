//! The picture of a break: the fragments, drawn apart, and their spheres in the same places.

use super::{Args, Surfaces};
use crate::view::buffer::Buffer;
use crate::view::camera::Camera;
use crate::view::canvas::{Align, Canvas, text_width};
use crate::view::shade::{self, Light};
use crate::view::surface::{self, Triangle};
use crate::view::{FINE, colour};
use morula::fragment::{Held, Shattered};
use morula::math::Vec3;
use morula::{Run, Solid, Sphere};
use std::path::Path;

pub fn draw(
    args: &Args,
    solid: &Solid,
    held: &Held,
    broken: &Shattered,
    surfaces: &Surfaces,
    run: &Run,
) -> morula::Result<Canvas> {
    let (drawing, frame) = (&args.drawing, solid.frame());
    let middle = frame.to_unit(&held.center);
    let (mut spheres, mut owners): (Vec<Sphere>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut triangles: Vec<Triangle> = Vec::new();
    for (i, (f, surface)) in broken.fragments.iter().zip(surfaces).enumerate() {
        let away: Vec3 = (frame.to_unit(&f.moving.center) - middle) * drawing.apart;
        for s in &f.clump.spheres {
            let s = frame.sphere_to_unit(s);
            spheres.push(Sphere::new(s.center + away, s.radius));
            owners.push(i);
        }
        if let Ok(shape) = surface {
            let place = |p: Vec3| frame.to_unit(&shape.frame.to_input(&p)) + away;
            triangles.extend(surface::triangles(&shape.body).into_iter().map(|t| Triangle {
                corners: t.corners.map(place),
                id: i as u32 + 1,
                ..t
            }));
        }
    }
    let (width, height) = drawing.size;
    let mut canvas = Canvas::new(width, height)?;
    let t = (width.min(2 * height) as f32 / 90.0).max(7.0);
    let (top, gap) = ((5.4 * t) as usize, (width / 100).max(2));
    let meshes = !triangles.is_empty();
    let panels = if meshes { 2 } else { 1 };
    let wide = (width - (panels + 1) * gap) / panels;
    let panel = [wide, height.saturating_sub(top + 2 * gap).max(8)];
    let corner = |i: usize| [gap + i * (panel[0] + gap), top];

    let mut camera = Camera::new(drawing.azimuth, drawing.elevation);
    let corners = triangles.iter().flat_map(|t| t.corners).map(|p| (p, 0.0));
    camera.frame(
        corners.chain(spheres.iter().map(|s| (s.center, s.radius))),
        panel.map(|p| 0.96 * p as f64),
    );
    let mut titles = Vec::new();
    if meshes {
        let mut body = Buffer::new(panel[0], panel[1], FINE, &camera)?;
        body.triangles(triangles.into_iter());
        shade::draw(&mut canvas, corner(0), &body, FINE, Light::Body, run.pool(), |_, _, s| {
            colour::of_number((s.id as usize).saturating_sub(1))
        });
        titles.push("fragments, drawn apart");
    }
    let mut clumps = Buffer::new(panel[0], panel[1], FINE, &camera)?;
    clumps.spheres(&spheres, run.pool());
    let last = corner(panels - 1);
    shade::draw(&mut canvas, last, &clumps, FINE, Light::Body, run.pool(), |_, _, s| {
        let owner = owners.get((s.id as usize).saturating_sub(1));
        colour::of_number(owner.copied().unwrap_or(0))
    });
    titles.push("their spheres");

    let name = Path::new(&args.input).file_name().and_then(|n| n.to_str()).unwrap_or(&args.input);
    let count = |n: usize, what| morula::error::count(n as u64, what);
    let figures = format!(
        "{}   {}   {} of dust",
        count(broken.fragments.len(), "fragment"),
        count(spheres.len(), "sphere"),
        count(broken.dust.len(), "crumb"),
    );
    let left = gap as f32;
    canvas.text(name, left, 2.0 * t, 1.25 * t, Align::Left, colour::dark());
    let after = left + text_width(name, 1.25 * t) + 2.0 * t;
    canvas.text(&figures, after, 2.0 * t, 1.25 * t, Align::Left, colour::soft());
    for (i, title) in titles.iter().enumerate() {
        let x = corner(i)[0] as f32 + 0.5 * panel[0] as f32;
        canvas.text(title, x, 4.6 * t, t, Align::Centre, colour::soft());
    }
    Ok(canvas)
}
