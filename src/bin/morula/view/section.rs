//! The section: target and clump cut by the plane through the middle that
//! faces the viewer. What both cover, what the clump misses, what it has too much.

use super::buffer::Buffer;
use super::camera::Camera;
use super::canvas::{Canvas, Mean, Rgb, mix, srgb};
use morula::{Run, Solid, Sphere};

/// Covered by both.
pub fn both() -> Rgb {
    srgb(205, 204, 198)
}

/// In the target, not in the clump.
pub fn missed() -> Rgb {
    srgb(70, 130, 194)
}

/// In the clump, not in the target.
pub fn beyond() -> Rgb {
    srgb(206, 84, 68)
}

/// Draws the section with its upper left corner at `corner`, `size` pixels.
pub fn draw(
    canvas: &mut Canvas,
    corner: [usize; 2],
    size: [usize; 2],
    camera: &Camera,
    solid: &Solid,
    spheres: &[Sphere],
    run: &Run,
) -> morula::Result<()> {
    const FINE: usize = 3;
    let (field, surface) = (solid.distance(run)?, solid.surface(run)?);
    let grid = solid.grid();
    let buffer = Buffer::new(size[0], size[1], FINE, camera)?;
    let camera = &buffer.camera;
    // The middle of the section lies in the target's centre of mass.
    let depth = camera.project(&solid.unit_moments().centroid)[2];
    // Circles in which the plane cuts the spheres, in samples.
    let circles: Vec<[f64; 3]> = spheres
        .iter()
        .filter_map(|s| {
            let q = camera.project(&s.center);
            let r = s.radius * camera.scale;
            let r2 = r * r - (q[2] - depth).powi(2);
            (r2 > 0.0).then(|| [q[0], q[1], r2.sqrt()])
        })
        .collect();
    let half = 0.5 * FINE as f64;
    // Near the surface the field rounds sharp corners off: there the exact distance counts.
    let lo = grid.center(0, 0, 0);
    let hi = grid.center(grid.dims[0] - 1, grid.dims[1] - 1, grid.dims[2] - 1);
    let near = 0.75 * grid.spacing.max();
    let lines = run.pool().map(size[1], |row| {
        let mut line = vec![Mean::default(); size[0]];
        for (column, pixel) in line.iter_mut().enumerate() {
            for y in row * FINE..(row + 1) * FINE {
                for x in column * FINE..(column + 1) * FINE {
                    let [u, v] = buffer.plane(x, y);
                    let p = camera.unproject([u, v, depth]);
                    // Off the grid the field says nothing, and nothing of the target is there.
                    let off = (0..3).any(|a| p[a] < lo[a] || p[a] > hi[a]);
                    let mut to_target = if off { 1e30 } else { grid.trilinear(field, &p) };
                    if to_target.abs() < near {
                        to_target = surface.signed_distance(&p);
                    }
                    to_target = (to_target * camera.scale).min(1e30);
                    let mut to_union = f64::MAX;
                    let mut on_circle = false;
                    for c in &circles {
                        let d = (u - c[0]).hypot(v - c[1]) - c[2];
                        on_circle |= d.abs() < 0.5 * half;
                        to_union = to_union.min(d);
                    }
                    let fill = match (to_target < 0.0, to_union < 0.0) {
                        (true, true) => Some(both()),
                        (true, false) => Some(missed()),
                        (false, true) => Some(beyond()),
                        (false, false) => None,
                    };
                    let mut colour = fill;
                    if on_circle {
                        let under = fill.unwrap_or([1.0; 3]);
                        colour = Some(mix(under, srgb(60, 62, 70), 0.45));
                    }
                    if to_target.abs() < half * 1.4 {
                        colour = Some(srgb(28, 30, 36));
                    }
                    if let Some(c) = colour {
                        pixel.add(c);
                    }
                }
            }
        }
        line
    });
    canvas.lay(corner, &lines, FINE * FINE);
    Ok(())
}
