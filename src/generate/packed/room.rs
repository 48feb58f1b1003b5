//! Where balls may be: how deep a place lies below the surface, and which way is deeper.

use crate::error::Result;
use crate::math::Vec3;
use crate::run::Run;
use crate::solid::nearest::Surface;
use crate::solid::{Grid, Solid};

/// The inside of the body, unit frame.
pub(super) struct Room<'a> {
    pub grid: &'a Grid,
    pub field: &'a [f32],
    surface: &'a Surface,
    /// The field between the centres of cells is wrong by less.
    error: f64,
    lo: Vec3,
    hi: Vec3,
}

/// Depth of a place (below zero outside) and the way in which it grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Depth {
    pub depth: f64,
    pub inward: Vec3,
}

impl<'a> Room<'a> {
    pub fn new(solid: &'a Solid, run: &Run) -> Result<Room<'a>> {
        let grid = solid.grid();
        let field = solid.distance(run)?;
        let last = grid.dims.map(|n| n.saturating_sub(1));
        Ok(Room {
            grid,
            field,
            surface: solid.surface(run)?,
            error: grid.spacing.norm(),
            lo: grid.center(0, 0, 0),
            hi: grid.center(last[0], last[1], last[2]),
        })
    }

    /// Back onto the grid, whose border is outside.
    pub fn keep(&self, p: &Vec3) -> Vec3 {
        p.sup(&self.lo).inf(&self.hi)
    }

    /// Depth by the field, trilinear, with its slope.
    pub fn nearly(&self, p: &Vec3) -> Depth {
        let grid = self.grid;
        let mut base = [0usize; 3];
        let mut t = [0.0; 3];
        for a in 0..3 {
            let last = grid.dims[a].saturating_sub(2);
            let u = ((p[a] - grid.origin[a]) / grid.spacing[a] - 0.5).max(0.0);
            base[a] = (u as usize).min(last);
            t[a] = (u - base[a] as f64).min(1.0);
        }
        let (nx, nxy) = (grid.dims[0], grid.dims[0] * grid.dims[1]);
        let first = grid.index(base[0], base[1], base[2]);
        let at = |x: usize, y: usize, z: usize| {
            self.field.get(first + x + y * nx + z * nxy).map_or(0.0, |d| f64::from(*d))
        };
        let mix = |a: f64, b: f64, t: f64| a + t * (b - a);
        // Along x, then y, then z; a slope is a difference in one and a mean in the others.
        let (mut value, mut slope_x, mut slope_y) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for z in 0..2 {
            let [a, b] = [at(0, 0, z), at(1, 0, z)];
            let [c, d] = [at(0, 1, z), at(1, 1, z)];
            let (low, high) = (mix(a, b, t[0]), mix(c, d, t[0]));
            value[z] = mix(low, high, t[1]);
            slope_x[z] = mix(b - a, d - c, t[1]);
            slope_y[z] = high - low;
        }
        let slope = Vec3::new(
            mix(slope_x[0], slope_x[1], t[2]),
            mix(slope_y[0], slope_y[1], t[2]),
            value[1] - value[0],
        );
        let inward = -slope.component_div(&grid.spacing);
        let length = inward.norm();
        let unit = inward / length.max(1e-9);
        let inward = if length > 1e-9 { unit } else { Vec3::zeros() };
        Depth { depth: -mix(value[0], value[1], t[2]), inward }
    }

    /// Exact depth, if it is less than `reach`.
    pub fn exact(&self, p: &Vec3, reach: f64) -> Option<Depth> {
        let nearly = self.nearly(p).depth;
        if nearly > reach + self.error {
            return None;
        }
        let inside =
            if nearly.abs() > self.error { nearly > 0.0 } else { self.surface.contains(p) };
        let nearest = match inside {
            true => self.surface.nearest_within(p, reach)?,
            false => self.surface.nearest(p),
        };
        let way = if nearest.distance > 0.0 {
            (p - nearest.point) / nearest.distance
        } else {
            -nearest.normal
        };
        let sign = if inside { 1.0 } else { -1.0 };
        Some(Depth { depth: sign * nearest.distance, inward: way * sign })
    }

    /// Exact depth, whatever it is.
    pub fn depth(&self, p: &Vec3) -> f64 {
        let distance = self.surface.nearest(p).distance;
        if self.surface.contains(p) { distance } else { -distance }
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::{block, size};
    use super::*;

    #[test]
    fn depths_and_ways_are_those_of_a_block() {
        let (solid, run) = (block(), Run::serial());
        let room = Room::new(&solid, &run).unwrap();
        let hi = size();
        let all = |p: &Vec3| {
            let walls = [p.x, hi.x - p.x, p.y, hi.y - p.y, p.z, hi.z - p.z];
            walls.into_iter().fold(f64::MAX, f64::min)
        };
        for i in 0..400 {
            let t = f64::from(i) + 0.5;
            let p = [t * 0.754, t * 0.569, t * 0.321].map(f64::fract);
            let p = Vec3::from(p).component_mul(&hi);
            let depth = all(&p);
            assert!((room.depth(&p) - depth).abs() < 1e-12);
            let nearly = room.nearly(&p);
            assert!((nearly.depth - depth).abs() < room.error, "{p}: {nearly:?}");
            match room.exact(&p, 0.1) {
                None => assert!(depth >= 0.1),
                Some(exact) => {
                    assert!((exact.depth - depth).abs() < 1e-12 && depth < 0.1);
                    let deeper = all(&(p + exact.inward * 1e-6));
                    assert!((deeper - depth - 1e-6).abs() < 1e-9, "{p}: {exact:?}");
                    if depth > room.error && depth + room.error < 0.5 * hi.min() {
                        assert!((nearly.inward.norm() - 1.0).abs() < 1e-9);
                    }
                }
            }
            // Outside, as far as it was inside.
            let beyond = Vec3::new(-depth, p.y, p.z);
            let exact = room.exact(&beyond, 0.1).unwrap();
            assert!((exact.depth + depth).abs() < 1e-12 && exact.inward.x > 0.999, "{exact:?}");
        }
    }
}
