//! The depth between cells from their distances alone, for a solid of which no [`super::field`] is
//! made: each of the eight cells about a place has the slope that it shows on its far side, and the
//! least of what these eight planes make of the place keeps creases of the depth sharp, as they
//! lie between cells with different slopes.

use crate::math::Vec3;
use crate::solid::Grid;
use wide::f32x8;

/// The distances at the cells' centres, about a middle.
#[derive(Debug, Clone)]
pub(super) struct Differences<'a> {
    distance: &'a [f32],
    row: usize,
    layer: usize,
    /// The first cell centre from the middle, cells to a length, and just below the last but one.
    origin: [f32; 3],
    inverse: [f32; 3],
    last: [f32; 3],
    /// More than half a cell's diagonal.
    far: f32,
}

impl<'a> Differences<'a> {
    pub(super) fn new(grid: &Grid, distance: &'a [f32], middle: &Vec3) -> Differences<'a> {
        let first = grid.center(0, 0, 0) - middle;
        Differences {
            distance,
            row: grid.dims[0],
            layer: grid.dims[0] * grid.dims[1],
            origin: [0, 1, 2].map(|a| first[a] as f32),
            inverse: [0, 1, 2].map(|a| (1.0 / grid.spacing[a]) as f32),
            last: grid.dims.map(|n| (n.saturating_sub(2) as f32).next_down().max(1.0)),
            far: 0.51 * grid.spacing.norm() as f32,
        }
    }

    /// The depth at the cell's centre that is nearest, of all but the outermost.
    #[inline]
    fn nearest(&self, p: &[f32; 3]) -> f32 {
        let strides = [1, self.row, self.layer];
        let mut at = 0;
        for a in 0..3 {
            let u = ((p[a] - self.origin[a]) * self.inverse[a]).max(1.0).min(self.last[a]);
            at += (u + 0.5) as u32 as usize * strides[a];
        }
        self.distance.get(at).map_or(0.0, |d| -d)
    }

    /// Whether the nearest cell's centre is inside.
    pub(super) fn inside(&self, p: &Vec3) -> bool {
        self.nearest(&[p.x as f32, p.y as f32, p.z as f32]) > 0.0
    }

    /// Whether the depth at a place is more than a length.
    #[inline]
    pub(super) fn deeper(&self, p: &[f32; 3], than: f32) -> bool {
        let about = self.nearest(p) - than;
        about > self.far || (about > -self.far && self.at(p).0 > than)
    }

    /// The depth at a place, clamped to the grid less its outermost cells, and the way in which it
    /// grows.
    #[inline]
    pub(super) fn at(&self, p: &[f32; 3]) -> (f32, [f32; 3]) {
        let (row, layer) = (self.row, self.layer);
        let strides = [1, row, layer];
        let (mut at, mut t) = (0, [0.0f32; 3]);
        for a in 0..3 {
            let u = ((p[a] - self.origin[a]) * self.inverse[a]).max(1.0).min(self.last[a]);
            let whole = u as u32 as usize;
            at += (whole - 1) * strides[a];
            t[a] = u - whole as f32;
        }
        // Four cells along each axis, those in the middle about the place.
        let four = |j: usize, k: usize| {
            let from = at + j * row + k * layer;
            self.distance.get(from..).and_then(|d| d.first_chunk::<4>()).copied()
        };
        let rows = (four(1, 1), four(2, 1), four(1, 2), four(2, 2));
        let (Some(a), Some(b), Some(c), Some(d)) = rows else { return (0.0, [0.0; 3]) };
        let below = (four(0, 1), four(0, 2), four(1, 0), four(2, 0));
        let above = (four(3, 1), four(3, 2), four(1, 3), four(2, 3));
        let (Some(y0), Some(y1), Some(z0), Some(z1)) = below else { return (0.0, [0.0; 3]) };
        let (Some(v0), Some(v1), Some(w0), Some(w1)) = above else { return (0.0, [0.0; 3]) };
        let here = f32x8::new([a[1], a[2], b[1], b[2], c[1], c[2], d[1], d[2]]);
        let x = f32x8::new([a[1], a[3], b[1], b[3], c[1], c[3], d[1], d[3]])
            - f32x8::new([a[0], a[2], b[0], b[2], c[0], c[2], d[0], d[2]]);
        let y = f32x8::new([a[1], a[2], v0[1], v0[2], c[1], c[2], v1[1], v1[2]])
            - f32x8::new([y0[1], y0[2], b[1], b[2], y1[1], y1[2], d[1], d[2]]);
        let z = f32x8::new([a[1], a[2], b[1], b[2], w0[1], w0[2], w1[1], w1[2]])
            - f32x8::new([z0[1], z0[2], z1[1], z1[2], c[1], c[2], d[1], d[2]]);
        // Where neighbours on different sides of a crease show slopes above 1, less.
        let [u, v, w] = [x * self.inverse[0], y * self.inverse[1], z * self.inverse[2]];
        let one = f32x8::splat(1.0);
        let by = one / (u * u + v * v + w * w).fast_max(one).sqrt();
        let [tx, ty, tz] = t;
        let tx = f32x8::new([tx, tx - 1.0, tx, tx - 1.0, tx, tx - 1.0, tx, tx - 1.0]);
        let ty = f32x8::new([ty, ty, ty - 1.0, ty - 1.0, ty, ty, ty - 1.0, ty - 1.0]);
        let tz = f32x8::new([tz, tz, tz, tz, tz - 1.0, tz - 1.0, tz - 1.0, tz - 1.0]);
        let all = here + (x * tx + y * ty + z * tz) * by;
        let [e, f, g, h, i, j, k, l] = all.to_array();
        let most = (e.max(f).max(g.max(h))).max(i.max(j).max(k.max(l)));
        let lane = all.simd_eq(f32x8::splat(most)).to_bitmask().trailing_zeros() as usize & 7;
        let of = |n: &f32x8| -n.as_array()[lane] * by.as_array()[lane];
        (-most, [of(&u), of(&v), of(&w)])
    }
}

#[cfg(test)]
mod tests {
    use super::super::spread::Random;
    use super::*;

    #[test]
    fn creases_between_cells_are_sharp() {
        // The depth in a box, its creases anywhere between the cells.
        let dims = [31, 27, 23];
        let spacing = Vec3::new(0.05, 0.06, 0.055);
        let grid = Grid { dims, spacing, origin: Vec3::new(3.0, 2.0, 1.0) };
        let lo = Vec3::new(3.17, 2.21, 1.18);
        let hi = Vec3::new(4.32, 3.37, 2.09);
        let depth = |p: &Vec3| {
            let (a, b) = (p - lo, hi - p);
            let all = [(a.x, Vec3::x()), (a.y, Vec3::y()), (a.z, Vec3::z())];
            let all = all.into_iter().chain([(b.x, -Vec3::x()), (b.y, -Vec3::y())]);
            all.chain([(b.z, -Vec3::z())])
                .fold((9.0, Vec3::zeros()), |m, n| if n.0 < m.0 { n } else { m })
        };
        let cell = |at: usize| grid.center(at % 31, at / 31 % 27, at / (31 * 27));
        let distance: Vec<f32> = (0..31 * 27 * 23).map(|i| -depth(&cell(i)).0 as f32).collect();
        let middle = Vec3::new(3.7, 2.8, 1.6);
        let differences = Differences::new(&grid, &distance, &middle);
        let mut random = Random::new(5);
        let mut unit = || f64::from(random.unit());
        let (mut sum, mut linear, mut ways, mut deep) = (0.0, 0.0, 0, 0);
        for _ in 0..4000 {
            let part = Vec3::new(unit(), unit(), unit());
            let p = lo + (hi - lo).component_mul(&part);
            let to = p - middle;
            let local = [to.x as f32, to.y as f32, to.z as f32];
            let (found, way) = differences.at(&local);
            let (wanted, out) = depth(&p);
            assert!((f64::from(found) - wanted).abs() < 0.03, "{found} {wanted}");
            sum += (f64::from(found) - wanted).abs();
            linear += (grid.trilinear(&distance, &p) + wanted).abs();
            ways += usize::from((Vec3::from(way.map(f64::from)) - out).norm() < 1e-3);
            if (wanted - 0.2).abs() > 0.03 {
                assert_eq!(differences.deeper(&local, 0.2), wanted > 0.2);
                deep += usize::from(wanted > 0.2);
            }
            assert!(wanted < 0.05 || differences.inside(&to));
        }
        assert!(sum < 0.3 * linear, "{sum} {linear}");
        assert!(ways > 3400 && deep > 500, "{ways} {deep}");
        // Beyond the grid, and of a grid that is none, something finite.
        assert!(differences.at(&[1e9, -1e9, 0.0]).0.is_finite());
        let none = Grid { dims: [1, 2, 1], ..grid };
        assert_eq!(Differences::new(&none, &[1.0; 2], &middle).at(&[0.0; 3]).0, 0.0);
    }
}
