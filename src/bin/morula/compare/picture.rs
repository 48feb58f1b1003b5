//! The picture of a comparison: the target, then each clump, seen from the same side and coloured
//! on one scale by how far its surface lies from the target's.

use super::Args;
use super::entry::{Made, Row};
use crate::view::buffer::Buffer;
use crate::view::camera::Camera;
use crate::view::canvas::{Align, Canvas, text_width};
use crate::view::shade::{self, Light};
use crate::view::{FINE, colour, error, surface};
use morula::{Run, Solid, Sphere};

/// Where things stand on the picture, in pixels.
struct Layout {
    size: [usize; 2],
    columns: usize,
    /// A panel, without its caption.
    panel: [usize; 2],
    gap: usize,
    top: usize,
    caption: usize,
    text: f32,
}

/// Columns of a grid of so many panels: as few empty places as can be, no more than five columns.
fn columns(panels: usize) -> usize {
    let empty = |columns: usize| panels.div_ceil(columns) * columns - panels;
    (3..=5).min_by_key(|&c| (empty(c), usize::MAX - c)).unwrap_or(3).min(panels.max(1))
}

impl Layout {
    /// `shape`: height of a panel over its width, where the picture's height is free.
    fn of(panels: usize, size: Option<(usize, usize)>, shape: f64) -> Layout {
        let columns = columns(panels);
        let rows = panels.div_ceil(columns);
        let width = size.map_or(1500, |s| s.0);
        let gap = (width / 100).max(2);
        let wide = ((width - gap) / columns).saturating_sub(gap).max(8);
        let text = (wide as f32 / 25.0).clamp(6.0, 18.0);
        let (top, caption) = ((3.4 * text) as usize, (4.4 * text) as usize);
        let foot = (6.0 * text) as usize;
        let high = match size {
            None => (shape * wide as f64) as usize,
            Some((_, height)) => (height.saturating_sub(top + foot) / rows).saturating_sub(caption),
        };
        let panel = [wide, high.max(8)];
        let height = size.map_or(top + rows * (panel[1] + caption) + foot, |s| s.1);
        Layout { size: [width, height], columns, panel, gap, top, caption, text }
    }

    /// The upper left corner of a panel.
    fn corner(&self, i: usize) -> [usize; 2] {
        let [column, row] = [i % self.columns, i / self.columns];
        [
            self.gap + column * (self.panel[0] + self.gap),
            self.top + row * (self.panel[1] + self.caption),
        ]
    }

    /// Two lines under a panel.
    fn caption(&self, canvas: &mut Canvas, i: usize, lines: [&str; 2]) {
        let [x, y] = self.corner(i);
        let middle = x as f32 + 0.5 * self.panel[0] as f32;
        let (t, foot) = (self.text, (y + self.panel[1]) as f32);
        canvas.text(lines[0], middle, foot + 1.5 * t, t, Align::Centre, colour::dark());
        canvas.text(lines[1], middle, foot + 3.2 * t, 0.9 * t, Align::Centre, colour::soft());
    }
}

/// Draws the rows that have a clump.
pub fn draw(
    args: &Args,
    title: &str,
    solid: &Solid,
    rows: &[Row],
    run: &Run,
) -> morula::Result<Canvas> {
    let made: Vec<(&Row, &Made)> =
        rows.iter().filter_map(|r| r.made.as_ref().ok().map(|m| (r, m))).collect();
    let unit = |m: &Made| -> Vec<Sphere> {
        m.clump.spheres.iter().map(|s| solid.frame().sphere_to_unit(s)).collect()
    };
    let clumps: Vec<Vec<Sphere>> = made.iter().map(|(_, m)| unit(m)).collect();
    let target = surface::triangles(solid.body());

    let mut camera = Camera::new(args.azimuth, args.elevation);
    let seen = || {
        let corners = target.iter().flat_map(|t| t.corners).map(|p| (p, 0.0));
        corners.chain(clumps.iter().flatten().map(|s| (s.center, s.radius)))
    };
    // Pixels to a length when only the width, only the height may limit it.
    let [wide, high] = [[1.0, 1e9], [1e9, 1.0]].map(|limits| {
        camera.frame(seen(), limits);
        camera.scale
    });
    let layout = Layout::of(1 + made.len(), args.size, (wide / high).clamp(0.3, 1.3));
    camera.frame(seen(), layout.panel.map(|p| 0.95 * p as f64));

    let [width, height] = layout.size;
    let mut canvas = Canvas::new(width, height)?;
    let t = layout.text;
    let left = layout.gap as f32;
    canvas.text(title, left, 2.0 * t, 1.2 * t, Align::Left, colour::dark());
    let after = left + text_width(title, 1.2 * t) + 2.0 * t;
    let what = "target and clumps, coloured by surface error";
    if after + text_width(what, t) < width as f32 {
        canvas.text(what, after, 2.0 * t, t, Align::Left, colour::soft());
    }

    let buffer = |fine: usize| Buffer::new(layout.panel[0], layout.panel[1], fine, &camera);
    let mut body = buffer(FINE)?;
    body.triangles(target.into_iter());
    shade::draw(&mut canvas, layout.corner(0), &body, FINE, Light::Body, run.pool(), |_, _, _| {
        colour::body()
    });
    drop(body);
    layout.caption(&mut canvas, 0, ["target", ""]);

    let diameter = crate::clump::equivalent_diameter(solid.unit_moments().volume);
    let end = match args.scale {
        Some(percent) => percent,
        None => {
            // One sample a pixel tells enough; the middle one of the clumps' own scales.
            let mut ends = Vec::new();
            for spheres in &clumps {
                let mut clump = buffer(1)?;
                clump.spheres(spheres, run.pool());
                ends.push(error::fitting_scale(&error::errors(solid, &clump, diameter, run)?));
            }
            ends.sort_by(f64::total_cmp);
            ends.get(ends.len() / 2).copied().unwrap_or(1.0)
        }
    };
    for (i, ((row, m), spheres)) in made.iter().zip(&clumps).enumerate() {
        let mut clump = buffer(FINE)?;
        clump.spheres(spheres, run.pool());
        let errors = error::errors(solid, &clump, diameter, run)?;
        let corner = layout.corner(i + 1);
        shade::draw(&mut canvas, corner, &clump, FINE, Light::Data, run.pool(), |x, y, _| {
            colour::diverging(errors[x + clump.width * y] / end as f32)
        });
        let figures = format!("n {}   D {:.4}", spheres.len(), m.quality.mismatch);
        layout.caption(&mut canvas, i + 1, [&row.entry.name(), &figures]);
    }
    let at = [0.5 * width as f32, height as f32 - 4.9 * t];
    error::bar(&mut canvas, at, (0.2 * width as f32).min(20.0 * t), t, end);
    Ok(canvas)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_have_few_empty_places() {
        for panels in 1..=40 {
            let c = columns(panels);
            assert!(c <= 5 && (panels.div_ceil(c) * c - panels) <= 2, "{panels}: {c} columns");
        }
        assert_eq!([1, 2, 4, 9, 11, 12].map(columns), [1, 2, 4, 3, 4, 4]);
    }
}
