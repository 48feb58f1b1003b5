//! A distance field for searches, much cheaper than the exact one: exact in a band about the
//! surface, and beyond it the distance to the nearest of some foot points in the band, about a tenth of
//! a cell too far (the square of how far they lie apart over eight times the distance).
//!
//! Faces are laid over the cells that they may be nearest to, four cells at a time; see
//! [`super::far`] for the rest. Lengths are cells, and cell (i, j, k) has its centre there.

use super::far;
use crate::error::{Result, filled, fits, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Mesh;
use crate::solid::grid::Grid;
use wide::bytemuck::cast;
use wide::{f32x4, i32x4};

/// Half the width of the band: more than the diagonal of a cell, so that every cell that the
/// surface cuts has exact corners.
const BAND: f32 = 1.8;
/// Foot points are taken from cells that are farther than this from the surface.
const SHELL: f32 = 0.7;
/// Layers of cells that a thread makes at once.
const SLAB: usize = 8;
/// What is reserved.
const WHAT: &str = "the distances near the surface";

/// The foot point of a cell.
pub(super) type Foot = ([u32; 3], [f32; 3]);

/// Writes the unsigned distances at the centres of cubic cells that hold the mesh with room for
/// the band. Takes no more than `room` bytes for that; returns what it took.
pub(super) fn distances(
    mesh: &Mesh,
    grid: &Grid,
    room: u64,
    run: &Run,
    out: &mut [f32],
) -> Result<u64> {
    let (cells, faces, vertices) = (grid.len(), mesh.faces.len(), mesh.vertices.len());
    // Slabs and foot points; points; lists of faces.
    let bytes = 20 * cells as u64 + 12 * vertices as u64 + 8 * faces as u64;
    fits(format_args!("distances near {faces} faces in {cells} cells"), bytes, room)?;
    let h = grid.spacing.x;
    let mut points: Vec<[f32; 3]> = reserve(WHAT, vertices)?;
    let local = |v: &Vec3| -> [f32; 3] {
        let p = (v - grid.origin) / h;
        [0, 1, 2].map(|a| (p[a] - 0.5) as f32)
    };
    points.extend(mesh.vertices.iter().map(local));
    let band = Band { mesh, points, dims: grid.dims };
    let [nx, ny, nz] = grid.dims;
    let (starts, lists) = band.by_slab()?;
    run.check(0.0, "making the distance field")?;
    let slabs = run.pool().map(nz.div_ceil(SLAB), |s| {
        let list = &lists[starts[s] as usize..starts[s + 1] as usize];
        band.slab(s * SLAB..nz.min((s + 1) * SLAB), list)
    });
    let mut feet: Vec<Vec<Foot>> = reserve(WHAT, slabs.len())?;
    for (slab, part) in slabs.into_iter().zip(out.chunks_mut(nx * ny * SLAB)) {
        let (values, some) = slab?;
        part.copy_from_slice(&values);
        feet.push(some);
    }
    run.check(0.0, "making the distance field")?;
    far::fill(grid.dims, feet.iter().flatten(), run.pool(), out)?;
    out.iter_mut().for_each(|d| *d = (f64::from(*d) * h) as f32);
    Ok(bytes)
}

struct Band<'a> {
    mesh: &'a Mesh,
    points: Vec<[f32; 3]>,
    dims: [usize; 3],
}

/// The whole numbers from `low` to `high` that are below `n`.
#[inline(always)]
fn between(low: f32, high: f32, n: usize) -> std::ops::Range<usize> {
    let down = low.max(0.0) as i32;
    let first = down + i32::from((down as f32) < low);
    let end = if high < 0.0 { 0 } else { (high as i32 + 1).min(n as i32) };
    first as usize..end.max(first) as usize
}

impl Band<'_> {
    fn corners(&self, f: u32) -> [[f32; 3]; 3] {
        self.mesh.faces[f as usize].map(|v| self.points[v as usize])
    }

    /// For each slab the faces that reach it, in their order.
    fn by_slab(&self) -> Result<(Vec<u32>, Vec<u32>)> {
        let slabs = |f: u32| {
            let [a, b, c] = self.corners(f).map(|p| p[2]);
            let layers = between(a.min(b).min(c) - BAND, a.max(b).max(c) + BAND, self.dims[2]);
            layers.start / SLAB..layers.end.div_ceil(SLAB)
        };
        let count = self.dims[2].div_ceil(SLAB);
        let all = 0..self.mesh.faces.len() as u32;
        let mut starts = filled(WHAT, count + 1, 0u32)?;
        for f in all.clone() {
            slabs(f).for_each(|s| starts[s + 1] += 1);
        }
        for s in 0..count {
            starts[s + 1] += starts[s];
        }
        let mut next = starts.clone();
        let mut lists = filled(WHAT, starts[count] as usize, 0u32)?;
        for f in all {
            for s in slabs(f) {
                lists[next[s] as usize] = f;
                next[s] += 1;
            }
        }
        Ok((starts, lists))
    }

    /// The distances in some layers, −1 beyond the band; and foot points.
    fn slab(&self, layers: std::ops::Range<usize>, list: &[u32]) -> Result<(Vec<f32>, Vec<Foot>)> {
        let [nx, ny, _] = self.dims;
        let mut best = filled(WHAT, nx * ny * layers.len(), BAND * BAND)?;
        let mut who = filled(WHAT, best.len(), -1i32)?;
        for &f in list {
            Facet::new(self.corners(f)).lay(f as i32, self.dims, &layers, &mut best, &mut who);
        }
        let shell = best.iter().zip(&who).filter(|(d, f)| **f >= 0 && **d > SHELL * SHELL);
        let mut feet = reserve(WHAT, shell.count())?;
        for (row, (best, who)) in best.chunks_mut(nx).zip(who.chunks(nx)).enumerate() {
            let (j, k) = (row % ny, layers.start + row / ny);
            for (i, (d, &f)) in best.iter_mut().zip(who).enumerate() {
                if f < 0 {
                    *d = -1.0;
                    continue;
                }
                if *d > SHELL * SHELL {
                    let at = [i, j, k];
                    feet.push((at.map(|x| x as u32), foot(&self.corners(f as u32), at)));
                }
                *d = d.sqrt();
            }
        }
        Ok((best, feet))
    }
}

/// The nearest point of a triangle.
fn foot(t: &[[f32; 3]; 3], at: [usize; 3]) -> [f32; 3] {
    let t = t.map(|p| Vec3::from(p.map(f64::from)));
    let p = Vec3::from(at.map(|x| x as f64));
    crate::solid::triangle::closest(&t, &p).map(|x| x as f32).into()
}

/// A triangle, its edges from each corner on, one over their squares, and the normals of its
/// plane and of the sides of the prism over it (inward).
struct Facet {
    corners: [[f32; 3]; 3],
    edges: [[f32; 3]; 3],
    inverse: [f32; 3],
    sides: [[f32; 3]; 3],
    normal: [f32; 3],
    /// What is added to places over the sides: nothing is over a triangle without area.
    over: f32,
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

impl Facet {
    fn new(corners: [[f32; 3]; 3]) -> Facet {
        let way = |p: [f32; 3], q: [f32; 3]| [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
        let [a, b, c] = corners;
        let edges = [way(a, b), way(b, c), way(c, a)];
        let squares = edges.each_ref().map(|e| dot(e, e));
        let n = cross(&edges[0], &edges[1]);
        let (area2, longest) = (dot(&n, &n), squares[0].max(squares[1]).max(squares[2]));
        // So thin that rounding decides about its plane: its edges stand for it.
        let flat = area2 <= 1e-9 * longest * longest || area2 < 1e-24;
        let normal = if flat { [0.0; 3] } else { n.map(|x| x / area2.sqrt()) };
        let inverse = squares.map(|s| if s > 1e-24 { 1.0 / s } else { 0.0 });
        let sides = edges.each_ref().map(|e| cross(&normal, e));
        Facet { corners, edges, inverse, sides, normal, over: if flat { -1.0 } else { 0.0 } }
    }

    /// Lowers the squared distances of cells in some layers where this triangle is nearer, and
    /// puts its number there.
    fn lay(
        &self,
        name: i32,
        [nx, ny, nz]: [usize; 3],
        layers: &std::ops::Range<usize>,
        best: &mut [f32],
        who: &mut [i32],
    ) {
        let [a, b, c] = &self.corners;
        let low: [f32; 3] = std::array::from_fn(|k| a[k].min(b[k]).min(c[k]));
        let high: [f32; 3] = std::array::from_fn(|k| a[k].max(b[k]).max(c[k]));
        let beyond = |k: usize, x: f32| (low[k] - x).max(x - high[k]).max(0.0);
        let [nrm_x, nrm_y, nrm_z] = self.normal;
        let steep = nrm_x.abs() > 1e-3;
        let across = if steep { 1.0 / nrm_x } else { 0.0 };
        let rows = between(low[1] - BAND, high[1] + BAND, ny);
        let some = between(low[2] - BAND, high[2] + BAND, nz);
        for k in some.start.max(layers.start)..some.end.min(layers.end) {
            let z = k as f32;
            let left = BAND * BAND - beyond(2, z) * beyond(2, z);
            for j in rows.clone() {
                let y = j as f32;
                let left = left - beyond(1, y) * beyond(1, y);
                if left <= 0.0 {
                    continue;
                }
                let reach = left.sqrt();
                let (mut from, mut to) = (low[0] - reach, high[0] + reach);
                let height = nrm_y * (y - a[1]) + nrm_z * (z - a[2]);
                if steep {
                    let (middle, half) = (a[0] - height * across, (BAND * across).abs());
                    from = from.max(middle - half);
                    to = to.min(middle + half);
                } else if height.abs() > BAND + 1e-3 * (to - from) {
                    continue;
                }
                let row = nx * (j + ny * (k - layers.start));
                let run = between(from, to, nx);
                for i in run.step_by(4) {
                    let at = row + i.min(nx - 4);
                    let (best, who) = (&mut best[at..at + 4], &mut who[at..at + 4]);
                    self.four(name, [(at - row) as f32, y, z], height, best, who);
                }
            }
        }
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
