//! The signed distance field as the refinement reads it: trilinear between cell centres, clamped
//! to the grid outside it, eight places at a time.

use super::Plane;
use crate::error::{Result, filled};
use crate::math::Vec3;
use crate::run::Pool;
use crate::solid::Grid;
use wide::f32x8;

/// Values at cell centres.
#[derive(Debug, Clone)]
pub(crate) struct Field {
    values: Vec<f32>,
    /// Cells along x, and of a layer.
    stride: [usize; 2],
    /// The first cell centre, and cells to a length.
    origin: [f32; 3],
    inverse: [f32; 3],
    /// Just below the last cell centre, in cells from the first.
    last: [f32; 3],
}

impl Field {
    /// Of a grid with at least two cells along each axis.
    ///
    /// Linear interpolation lies beyond a curved function by h²/12 of its second derivative on
    /// average: the balls of a smooth body would all be too small. This much is taken off before.
    pub(crate) fn new(grid: &Grid, values: &[f32], pool: &Pool) -> Result<Field> {
        let first = grid.center(0, 0, 0);
        let mut field = Field {
            values: filled("the field of the refinement", values.len(), 0.0)?,
            stride: [grid.dims[0], grid.dims[0] * grid.dims[1]],
            origin: [0, 1, 2].map(|a| first[a] as f32),
            inverse: [0, 1, 2].map(|a| (1.0 / grid.spacing[a]) as f32),
            last: grid.dims.map(|n| (n.saturating_sub(1) as f32).next_down().max(0.0)),
        };
        let [nx, layer] = field.stride;
        let [_, ny, nz] = grid.dims;
        pool.chunks_mut(&mut field.values, nx, |row, out| {
            let at = row * nx;
            let here = &values[at..at + nx];
            out.copy_from_slice(here);
            let (j, k) = (row % ny, row / ny);
            if j == 0 || j + 1 == ny || k == 0 || k + 1 == nz {
                return;
            }
            // Slices of one length, so that four cells are done at a time.
            let n = nx.saturating_sub(2);
            let row = |first: usize| &values[first..first + n];
            let (before, after) = (row(at), row(at + 2));
            let (below, above) = (row(at + 1 - nx), row(at + 1 + nx));
            let (under, over) = (row(at + 1 - layer), row(at + 1 + layer));
            for (i, out) in out[1..1 + n].iter_mut().enumerate() {
                let mut around = before[i] + after[i];
                around += below[i] + above[i];
                around += under[i] + over[i];
                *out -= (around - 6.0 * *out) / 12.0;
            }
        });
        Ok(field)
    }

    /// The field of what half-spaces leave: inside, the distance to the nearer of surface and
    /// planes; outside at most that.
    pub(crate) fn cut(&mut self, grid: &Grid, planes: &[Plane], pool: &Pool) {
        if planes.is_empty() {
            return;
        }
        let [nx, ny, _] = grid.dims;
        pool.chunks_mut(&mut self.values, nx, |row, out| {
            for (i, value) in out.iter_mut().enumerate() {
                let p = grid.center(i, row % ny, row / ny);
                for plane in planes {
                    *value = value.max((plane.normal.dot(&p) - plane.offset) as f32);
                }
            }
        });
    }

    /// The field of what lies within a further bound, too: the distance to the nearer one.
    pub(crate) fn narrow(
        &mut self,
        grid: &Grid,
        bound: &(dyn Fn(&Vec3) -> (f64, Vec3) + Sync),
        pool: &Pool,
    ) {
        let [nx, ny, _] = grid.dims;
        pool.chunks_mut(&mut self.values, nx, |row, out| {
            for (i, value) in out.iter_mut().enumerate().filter(|(_, v)| **v < 0.0) {
                let p = grid.center(i, row % ny, row / ny);
                *value = value.max(-bound(&p).0 as f32);
            }
        });
    }

    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        self.values.len() as u64 * 4
    }

    /// Cell edge, the longest.
    pub(crate) fn cell(&self) -> f32 {
        let [x, y, z] = self.inverse;
        1.0 / x.min(y).min(z)
    }

    /// The values at eight places.
    #[inline(always)]
    pub(crate) fn at(&self, [x, y, z]: [f32x8; 3]) -> f32x8 {
        let (i, tx) = self.split(x, 0);
        let (j, ty) = self.split(y, 1);
        let (k, tz) = self.split(z, 2);
        let [row, layer] = self.stride;
        // Corners x fastest, each of eight places.
        let mut c = [[0.0f32; 8]; 8];
        for l in 0..8 {
            let at = i[l] as usize + row * j[l] as usize + layer * k[l] as usize;
            let (low, high) = (&self.values[at..at + row + 2], &self.values[at + layer..]);
            let high = &high[..row + 2];
            (c[0][l], c[1][l], c[2][l], c[3][l]) = (low[0], low[1], low[row], low[row + 1]);
            (c[4][l], c[5][l], c[6][l], c[7][l]) = (high[0], high[1], high[row], high[row + 1]);
        }
        let along = |a: f32x8, b: f32x8, t: f32x8| a + (b - a) * t;
        let edge = |k: usize| along(f32x8::new(c[k]), f32x8::new(c[k + 1]), tx);
        along(along(edge(0), edge(2), ty), along(edge(4), edge(6), ty), tz)
    }

    /// The cells below places along an axis, and how far on from their centres.
    #[inline(always)]
    fn split(&self, x: f32x8, a: usize) -> ([i32; 8], f32x8) {
        let u = (x - self.origin[a]) * self.inverse[a];
        let u = u.fast_max(f32x8::splat(0.0)).fast_min(f32x8::splat(self.last[a]));
        let whole = u.fast_trunc_int();
        (whole.to_array(), u - f32x8::from_i32x8(whole))
    }

    /// The value at one place.
    pub(crate) fn one(&self, p: [f32; 3]) -> f32 {
        let mut at = 0;
        let mut t = [0.0; 3];
        let stride = [1, self.stride[0], self.stride[1]];
        for a in 0..3 {
            let u = ((p[a] - self.origin[a]) * self.inverse[a]).max(0.0).min(self.last[a]);
            at += u as usize * stride[a];
            t[a] = u - (u as usize) as f32;
        }
        let along = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let [row, layer] = self.stride;
        let x = [at, at + row, at + layer, at + layer + row]
            .map(|at| along(self.values[at], self.values[at + 1], t[0]));
        along(along(x[0], x[1], t[1]), along(x[2], x[3], t[1]), t[2])
    }

    /// The slope at a place, over a cell.
    pub(crate) fn slope(&self, p: [f32; 3]) -> [f32; 3] {
        [0, 1, 2].map(|a| {
            let (mut q, h) = (p, 0.5 / self.inverse[a]);
            q[a] = p[a] + h;
            let up = self.one(q);
            q[a] = p[a] - h;
            (up - self.one(q)) * self.inverse[a]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    fn grid() -> Grid {
        let dims = [12, 14, 13];
        Grid { dims, spacing: Vec3::new(0.1, 0.08, 0.09), origin: Vec3::new(-0.2, -0.3, -0.1) }
    }

    #[test]
    fn eight_places_are_as_one() {
        let grid = grid();
        let values: Vec<f32> = (0..grid.len()).map(|i| ((i * 7919) % 101) as f32 * 0.01).collect();
        let field = Field::new(&grid, &values, &Pool::serial()).unwrap();
        let mut random = super::super::random::Random::new(1, 1);
        for _ in 0..200 {
            // Also outside the grid.
            let mut p = [[0.0f32; 8]; 3];
            for v in p.iter_mut().flatten() {
                *v = random.between(-0.8, 1.6) as f32;
            }
            let all = field.at(p.map(f32x8::new)).to_array();
            for l in 0..8 {
                let q = [p[0][l], p[1][l], p[2][l]];
                let exact = grid.trilinear(&field.values, &Vec3::from(q.map(f64::from)));
                assert!((f64::from(all[l]) - exact).abs() < 1e-5, "{q:?} {} {exact}", all[l]);
                assert!((f64::from(field.one(q)) - exact).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn curved_fields_are_met_on_average() {
        let grid = grid();
        let middle = Vec3::new(0.4, 0.26, 0.49);
        let depth = |p: &Vec3| (p - middle).norm() - 0.35;
        let mut values = Vec::new();
        for k in 0..grid.dims[2] {
            for j in 0..grid.dims[1] {
                values.extend((0..grid.dims[0]).map(|i| depth(&grid.center(i, j, k)) as f32));
            }
        }
        let field = Field::new(&grid, &values, &Pool::serial()).unwrap();
        let mut random = super::super::random::Random::new(1, 1);
        let (mut plain, mut ours) = (0.0, 0.0);
        for _ in 0..4000 {
            let z = random.between(-1.0, 1.0);
            let (s, c) = random.between(0.0, std::f64::consts::TAU).sin_cos();
            let r = 0.35 * (1.0 - z * z).sqrt();
            let p = middle + Vec3::new(r * c, r * s, 0.35 * z);
            plain += grid.trilinear(&values, &p) / 4000.0;
            ours += f64::from(field.one([0, 1, 2].map(|a| p[a] as f32))) / 4000.0;
        }
        assert!(plain > 0.003 && ours.abs() < 0.1 * plain, "{plain} {ours}");
    }
}
