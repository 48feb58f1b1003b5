//! From samples to pixels: light, occlusion by what stands near, edges, and
//! the mean over the samples of a pixel.

use super::buffer::{Buffer, FAR, Sample};
use super::canvas::{Canvas, Mean, Rgb, mix, srgb};
use morula::run::Pool;

/// How strongly light models the form; colours that carry a value get less.
#[derive(Clone, Copy)]
pub enum Light {
    /// A plain body.
    Body,
    /// A body whose colour is to be read off against a scale.
    Data,
}

/// Draws a buffer onto the canvas with its upper left corner at `corner`.
/// `paint` gives the colour of a sample that shows a surface.
pub fn draw(
    canvas: &mut Canvas,
    corner: [usize; 2],
    buffer: &Buffer,
    fine: usize,
    light: Light,
    pool: &Pool,
    paint: impl Fn(usize, usize, &Sample) -> Rgb + Sync,
) {
    let (width, height) = (buffer.width / fine, buffer.height / fine);
    let reach = 0.05 * width.max(height) as f32 * fine as f32;
    // One list of (colour, coverage) a row: rows are independent.
    let rows = pool.map(height, |row| {
        let mut line = vec![Mean::default(); width];
        for (column, pixel) in line.iter_mut().enumerate() {
            for y in row * fine..(row + 1) * fine {
                for x in column * fine..(column + 1) * fine {
                    let s = buffer.samples[x + buffer.width * y];
                    if !s.hit() {
                        continue;
                    }
                    let open = openness(buffer, x, y, &s, reach);
                    let lit = lit(paint(x, y, &s), &s.normal, open, light);
                    let edge = edge(buffer, x, y, &s, fine);
                    let c = mix(lit, srgb(28, 30, 36), edge);
                    pixel.add(c);
                }
            }
        }
        line
    });
    canvas.lay(corner, &rows, fine * fine);
}

/// A key light from the upper left, a faint one from the right, sky and ground.
fn lit(base: Rgb, n: &[f32; 3], open: f32, light: Light) -> Rgb {
    let dot = |l: [f32; 3]| n[0] * l[0] + n[1] * l[1] + n[2] * l[2];
    let key = ((dot([-0.46, 0.66, 0.594]) + 0.15) / 1.15).max(0.0);
    let fill = dot([0.8, 0.1, 0.592]).max(0.0);
    let sky = 0.5 + 0.5 * n[1];
    let strength = match light {
        Light::Body => (0.20 + 0.18 * sky + 0.10 * fill) * open + 0.66 * key * (0.45 + 0.55 * open),
        Light::Data => (0.44 + 0.14 * sky + 0.08 * fill) * open + 0.40 * key * (0.5 + 0.5 * open),
    };
    // A soft highlight, halfway between the key light and the viewer.
    let gloss = match light {
        Light::Body => 0.10 * dot([-0.258, 0.370, 0.893]).max(0.0).powi(24),
        Light::Data => 0.0,
    };
    base.map(|v| v * strength + gloss * open)
}

/// 1 in the open, less in hollows: how much of the half-sphere above a sample
/// is free, from depths around it along a spiral.
fn openness(buffer: &Buffer, x: usize, y: usize, s: &Sample, reach: f32) -> f32 {
    const STEPS: usize = 20;
    // A turn that differs from sample to sample; the mean over a pixel smooths it.
    let turn = ((x as f32 * 0.067_110_56 + y as f32 * 0.005_837_15).fract() * 52.982_92).fract();
    let mut hidden = 0.0;
    let mut count = 0.0;
    for i in 0..STEPS {
        let r = reach * ((i as f32 + 0.5) / STEPS as f32).powf(1.3);
        let angle = std::f32::consts::TAU * (turn + i as f32 * 0.381_966);
        let (dx, dy) = (r * angle.cos(), r * angle.sin());
        let (u, v) = ((x as f32 + dx).round(), (y as f32 - dy).round());
        count += 1.0;
        if u < 0.0 || v < 0.0 || u >= buffer.width as f32 || v >= buffer.height as f32 {
            continue;
        }
        let other = buffer.samples[u as usize + buffer.width * v as usize].depth;
        if other <= FAR {
            continue;
        }
        let d = [dx, dy, other - s.depth];
        let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        if length > 0.0 {
            let rise = (d[0] * s.normal[0] + d[1] * s.normal[1] + d[2] * s.normal[2]) / length;
            let near = (1.0 - length / (2.5 * reach)).max(0.0);
            hidden += (rise - 0.08).max(0.0) * near;
        }
    }
    (1.0 - 1.7 * hidden / count).clamp(0.0, 1.0)
}

/// How dark the line at a sample is: outlines, seams between spheres, creases.
fn edge(buffer: &Buffer, x: usize, y: usize, s: &Sample, fine: usize) -> f32 {
    // About a pixel wide, more on large pictures.
    let width = (buffer.width as f32 / (450.0 * fine as f32)).max(1.0);
    let step = (0.7 * width * fine as f32).round().max(1.0);
    let mut line: f32 = 0.0;
    const ROUND: [(f32, f32); 8] = [
        (1.0, 0.0),
        (0.7, 0.7),
        (0.0, 1.0),
        (-0.7, 0.7),
        (-1.0, 0.0),
        (-0.7, -0.7),
        (0.0, -1.0),
        (0.7, -0.7),
    ];
    for (dx, dy) in ROUND {
        let [u, v] = [x as f32 + dx * step, y as f32 + dy * step].map(|v| v.round() as i64);
        if u < 0 || v < 0 || u >= buffer.width as i64 || v >= buffer.height as i64 {
            continue;
        }
        let o = &buffer.samples[u as usize + buffer.width * v as usize];
        if !o.hit() {
            line = line.max(0.70);
            continue;
        }
        // On a slope the depth changes by itself: only what exceeds it is a step.
        let slope = step * (1.0 - s.normal[2]) / s.normal[2].max(0.05);
        let drop = s.depth - o.depth;
        let facing: f32 = (0..3).map(|i| s.normal[i] * o.normal[i]).sum();
        if drop > 3.0 * slope + 4.0 * fine as f32 {
            line = line.max(0.6);
        } else if s.id != o.id {
            line = line.max(0.28);
        } else if facing < 0.8 {
            line = line.max(0.45);
        }
    }
    line
}
