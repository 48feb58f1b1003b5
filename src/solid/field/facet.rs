//! A triangle that is laid over the cells that it may be nearest to. Lengths are cells.

use super::band::BAND;
use wide::bytemuck::cast;
use wide::{f32x4, i32x4};

/// The whole numbers from `low` to `high` that are below `n`.
#[inline(always)]
pub(super) fn between(low: f32, high: f32, n: usize) -> std::ops::Range<usize> {
    let down = low.max(0.0) as i32;
    let first = down + i32::from((down as f32) < low);
    let end = if high < 0.0 { 0 } else { (high as i32 + 1).min(n as i32) };
    first as usize..end.max(first) as usize
}

/// A triangle, its edges from each corner on, one over their squares, and the normals of its
/// plane and of the sides of the prism over it (inward).
pub(super) struct Facet {
    corners: [[f32; 3]; 3],
    edges: [[f32; 3]; 3],
    inverse: [f32; 3],
    sides: [[f32; 3]; 3],
    normal: [f32; 3],
    /// What is added to places over the sides: nothing is over a triangle without area.
    over: f32,
    /// How far beyond the sides it may be nearest, times the lengths of its edges.
    margins: [f32; 3],
    /// The box about it, and about what is within the margins in its plane.
    low: [f32; 3],
    high: [f32; 3],
    least: [f32; 3],
    most: [f32; 3],
}

/// Parts of four rows.
struct Rows {
    /// A bit for each row that has such a part.
    lanes: u32,
    /// Its first and last cell.
    first: [i32; 4],
    last: [i32; 4],
    /// The height of the place with the first corner's x over the plane of the triangle.
    height: [f32; 4],
}

fn dot(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &[f32; 3], b: &[f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Of each lane the first where the mask says so, else the second.
#[inline(always)]
fn choose(mask: f32x4, yes: f32x4, no: f32x4) -> f32x4 {
    no ^ (mask & (no ^ yes))
}

/// The normal of a triangle; zero when it is so thin that rounding decides about its plane.
/// With twice its area, then 0 as well.
#[inline(always)]
pub(super) fn plane(edges: &[[f32; 3]; 3]) -> ([f32; 3], f32) {
    let [a, b, c] = edges;
    let n = cross(a, b);
    let (area2, longest) = (dot(&n, &n), dot(a, a).max(dot(b, b)).max(dot(c, c)));
    let flat = area2 <= 1e-9 * longest * longest || area2 < 1e-24;
    if flat {
        return ([0.0; 3], 0.0);
    }
    let length = area2.sqrt();
    let [normal @ .., _] = (f32x4::new([n[0], n[1], n[2], 0.0]) / length).to_array();
    (normal, length)
}

/// The edges of a triangle.
#[inline(always)]
pub(super) fn edges([a, b, c]: &[[f32; 3]; 3]) -> [[f32; 3]; 3] {
    let way = |p: &[f32; 3], q: &[f32; 3]| [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
    [way(a, b), way(b, c), way(c, a)]
}

impl Facet {
    pub(super) fn new(corners: [[f32; 3]; 3], margins: [f32; 3]) -> Facet {
        let edges = edges(&corners);
        let [a, b, c] = &edges;
        let squares = f32x4::new([dot(a, a), dot(b, b), dot(c, c), 1.0]);
        // So thin that rounding decides about its plane: its edges stand for it.
        let (normal, area) = plane(&edges);
        let flat = area == 0.0;
        let (one, some) = (f32x4::splat(1.0), squares.simd_gt(f32x4::splat(1e-24)));
        let [inverse @ .., _] = ((one / choose(some, squares, one)) & some).to_array();
        let sides = [cross(&normal, a), cross(&normal, b), cross(&normal, c)];
        let [p, q, r] = margins;
        let [p, q, r, _] = (squares.sqrt() * f32x4::new([p, q, r, 0.0])).to_array();
        let margins = if flat { [f32::MAX; 3] } else { [p, q, r] };
        let over = if flat { -1.0 } else { 0.0 };
        let four = |v: &[f32; 3]| f32x4::new([v[0], v[1], v[2], 0.0]);
        let three = |v: f32x4| {
            let [x, y, z, _] = v.to_array();
            [x, y, z]
        };
        let [p, q, r] = &corners;
        let (p, q, r) = (four(p), four(q), four(r));
        let (low, high) = (p.fast_min(q).fast_min(r), p.fast_max(q).fast_max(r));
        let (mut least, mut most) = (low, high);
        if !flat {
            // Where the sides meet when they are moved out.
            let (a, b, c) = (four(a) / area, four(b) / area, four(c) / area);
            let p = p - (a * margins[2] - c * margins[0]);
            let q = q - (b * margins[0] - a * margins[1]);
            let r = r - (c * margins[1] - b * margins[2]);
            least = low.fast_min(p).fast_min(q).fast_min(r);
            most = high.fast_max(p).fast_max(q).fast_max(r);
        }
        let (low, high, least, most) = (three(low), three(high), three(least), three(most));
        Facet { corners, edges, inverse, sides, normal, over, margins, low, high, least, most }
    }

    /// Lowers the squared distances of cells in some layers where this triangle is nearer, and
    /// puts its number there.
    pub(super) fn lay(
        &self,
        name: i32,
        [nx, ny, nz]: [usize; 3],
        layers: &std::ops::Range<usize>,
        best: &mut [f32],
        who: &mut [i32],
    ) {
        let reach = |k: usize, n: usize| {
            let along = if self.over < 0.0 { BAND } else { BAND * self.normal[k].abs() + 1e-3 };
            let least = (self.least[k] - along).max(self.low[k] - BAND);
            between(least, (self.most[k] + along).min(self.high[k] + BAND), n)
        };
        let (rows, some) = (reach(1, ny), reach(2, nz));
        for k in some.start.max(layers.start)..some.end.min(layers.end) {
            for j in rows.clone().step_by(4) {
                let four = self.rows([j, k], nx);
                // The lanes of rows that there are, of which some are to be looked at.
                let mut lanes = four.lanes & ((1 << (rows.end - j).min(4)) - 1);
                while lanes != 0 {
                    let l = lanes.trailing_zeros() as usize & 3;
                    lanes &= lanes - 1;
                    let row = nx * (j + l + ny * (k - layers.start));
                    for i in (four.first[l]..=four.last[l]).step_by(4) {
                        let at = row + (i as usize).min(nx - 4);
                        let (best, who) = (&mut best[at..at + 4], &mut who[at..at + 4]);
                        let place = [(at - row) as f32, (j + l) as f32, k as f32];
                        self.four(name, place, four.height[l], best, who);
                    }
                }
            }
        }
    }

    /// What part of four rows of `nx` cells from `j` on in the layer `k` this triangle may be
    /// nearest to.
    #[inline(always)]
    fn rows(&self, [j, k]: [usize; 2], nx: usize) -> Rows {
        let (low, high) = (&self.low, &self.high);
        let zero = f32x4::splat(0.0);
        let y = f32x4::new([0.0, 1.0, 2.0, 3.0]) + j as f32;
        let z = k as f32;
        let beyond_z = (low[2] - z).max(z - high[2]).max(0.0);
        let beyond_y = (f32x4::splat(low[1]) - y).fast_max(y - high[1]).fast_max(zero);
        let left = -(beyond_y * beyond_y) + (BAND * BAND - beyond_z * beyond_z);
        let reach = left.fast_max(zero).sqrt();
        let (mut from, mut to) = (-reach + low[0], reach + high[0]);
        let a = &self.corners[0];
        let [nrm_x, nrm_y, nrm_z] = self.normal;
        let height = (y - a[1]) * nrm_y + nrm_z * (z - a[2]);
        let nowhere = f32x4::splat(-1.0);
        if nrm_x.abs() > 1e-3 {
            let across = inverse(nrm_x);
            let (middle, half) = (-(height * across) + a[0], (BAND * across).abs());
            from = from.fast_max(middle - half);
            to = to.fast_min(middle + half);
        } else {
            let off = height.abs().simd_gt((to - from) * 1e-3 + BAND);
            to = choose(off, nowhere, to);
        }
        for e in 0..3 {
            let (p, side, margin) = (&self.corners[e], &self.sides[e], self.margins[e]);
            if margin == f32::MAX {
                continue;
            }
            // What is left of the margin at the corner's x.
            let left = (y - p[1]) * side[1] + (side[2] * (z - p[2]) + margin);
            // Along a side, rounding is well within the margin.
            if side[0].abs() > 1e-3 * margin {
                let end = -(left * inverse(side[0])) + p[0];
                if side[0] > 0.0 {
                    from = from.fast_max(end);
                } else {
                    to = to.fast_min(end);
                }
            } else {
                let off = (left + (to - from) * side[0].abs()).simd_lt(zero);
                to = choose(off, nowhere, to);
            }
        }
        // Ends that do not cross may lie anywhere: within the grid first.
        let from = from.fast_max(zero).fast_min(f32x4::splat(nx as f32));
        let to = to.fast_min(f32x4::splat((nx - 1) as f32));
        let whole = from.fast_trunc_int();
        let below = f32x4::from_i32x4(whole).simd_lt(from);
        let first = whole - cast::<f32x4, i32x4>(below);
        let lanes = f32x4::from_i32x4(first).simd_le(to).to_bitmask();
        let last = to.fast_max(zero).fast_trunc_int();
        let (first, last, height) = (first.to_array(), last.to_array(), height.to_array());
        Rows { lanes, first, last, height }
    }

    /// Four cells from `x` on; `height` over the plane through the first corner's x.
    #[inline(always)]
    fn four(&self, name: i32, [x, y, z]: [f32; 3], height: f32, best: &mut [f32], who: &mut [i32]) {
        let (zero, one) = (f32x4::splat(0.0), f32x4::splat(1.0));
        let x = f32x4::new([0.0, 1.0, 2.0, 3.0]) + x;
        let mut over = f32x4::splat(f32::MAX);
        let mut least = f32x4::splat(f32::MAX);
        for k in 0..3 {
            let ([px, py, pz], [ex, ey, ez], [sx, sy, sz]) =
                (self.corners[k], self.edges[k], self.sides[k]);
            let (ax, ay, az) = (x - px, y - py, z - pz);
            let t = (ax * ex + (ay * ey + az * ez)) * self.inverse[k];
            let t = t.fast_max(zero).fast_min(one);
            let (rx, ry, rz) = (ax - t * ex, -(t * ey) + ay, -(t * ez) + az);
            least = least.fast_min(rx * rx + (ry * ry + rz * rz));
            over = over.fast_min(ax * sx + (ay * sy + az * sz));
        }
        let height = (x - self.corners[0][0]) * self.normal[0] + height;
        let squared = choose((over + self.over).simd_ge(zero), height * height, least);
        let (Some(best), Some(who)) = (best.first_chunk_mut::<4>(), who.first_chunk_mut::<4>())
        else {
            return;
        };
        let old = f32x4::new(*best);
        let nearer = squared.simd_lt(old);
        *best = choose(nearer, squared, old).to_array();
        let nearer: i32x4 = cast(nearer);
        let old = i32x4::new(*who);
        *who = (old ^ (nearer & (old ^ i32x4::splat(name)))).to_array();
    }
}

/// 1/x. Also where x is 0 and nobody asks: loops are turned so that it is made all the same.
#[inline(always)]
fn inverse(x: f32) -> f32 {
    1.0 / x.abs().max(1e-30).copysign(x)
}
