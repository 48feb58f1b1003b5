//! How far what is seen of a clump lies from the target's surface, and the scale of its colours.

use super::buffer::Buffer;
use super::canvas::{Align, Canvas};
use super::colour;
use morula::{Run, Solid};

/// Signed distance from the target's surface at every sample of the clump, in
/// percent of the equivalent diameter; positive beyond the surface.
pub fn errors(solid: &Solid, clump: &Buffer, diameter: f64, run: &Run) -> morula::Result<Vec<f32>> {
    let (field, surface) = (solid.distance(run)?, solid.surface(run)?);
    let grid = solid.grid();
    let last = grid.center(grid.dims[0] - 1, grid.dims[1] - 1, grid.dims[2] - 1);
    let first = grid.center(0, 0, 0);
    let mut out = morula::error::filled("surface errors", clump.samples.len(), 0f32)?;
    run.pool().chunks_mut(&mut out, clump.width, |y, row| {
        for (x, e) in row.iter_mut().enumerate() {
            let s = &clump.samples[x + clump.width * y];
            if s.hit() {
                let [u, v] = clump.plane(x, y);
                let p = clump.camera.unproject([u, v, f64::from(s.depth)]);
                let on_grid = (0..3).all(|a| p[a] >= first[a] && p[a] <= last[a]);
                let d =
                    if on_grid { grid.trilinear(field, &p) } else { surface.signed_distance(&p) };
                *e = (100.0 * d / diameter) as f32;
            }
        }
    });
    Ok(out)
}

/// A round figure that all but 2 % of what is seen lies within.
pub fn fitting_scale(errors: &[f32]) -> f64 {
    let mut sizes: Vec<f32> = errors.iter().filter(|e| **e != 0.0).map(|e| e.abs()).collect();
    sizes.sort_by(f32::total_cmp);
    let at = (sizes.len() * 98 / 100).min(sizes.len().saturating_sub(1));
    colour::round_up(f64::from(sizes.get(at).copied().unwrap_or(1.0)))
}

/// The scale of the colours, which ends at `end`: about `middle` and as wide as twice `half`, its
/// upper edge at `top`, with text of the size `t`.
pub fn bar(canvas: &mut Canvas, [middle, top]: [f32; 2], half: f32, t: f32, end: f64) {
    let [x0, x1] = [-half, half].map(|d| (middle + d).round());
    let [y0, y1] = [0.0, 0.9].map(|d| (top + d * t).round());
    let steps = (x1 - x0) as usize;
    for i in 0..steps {
        let value = 2.0 * (i as f32 + 0.5) / steps as f32 - 1.0;
        let x = x0 + i as f32;
        canvas.rectangle([x, x + 1.0], [y0, y1], colour::diverging(value));
    }
    for k in 0..5 {
        let f = k as f32 / 4.0;
        let x = x0 + f * (x1 - x0);
        canvas.rectangle([x - 0.5, x + 0.5], [y1, y1 + 0.3 * t], colour::dark());
        let label = colour::short(end * (2.0 * f64::from(f) - 1.0));
        canvas.text(&label, x, y1 + 1.5 * t, 0.9 * t, Align::Centre, colour::dark());
    }
    let caption = "inside    % of equivalent diameter    beyond";
    canvas.text(caption, middle, y1 + 3.0 * t, 0.8 * t, Align::Centre, colour::soft());
}
