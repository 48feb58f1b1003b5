//! Points spread evenly over the outer surface: what the spheres are fitted to.
//!
//! The paper takes the vertices of a mesh whose triangles are all of a size. Those of a mesh at hand
//! may stand anywhere (a cube has eight), and all lie outside of the mean surface; points by area
//! weigh every part alike, and a fit to them keeps the volume.

use super::draw::Draw;
use crate::error::{Error, Result, fits, push, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::{Body, Mesh, Voxels};
use crate::solid::nearest::Surface;

/// How many points; of a surface with walls inside, so many less those that lie within.
pub(super) const POINTS: usize = 4096;
/// How far a point is moved to both sides to see whether the surface passes there, as a part of
/// the unit.
const ASIDE: f64 = 1e-6;
/// Points worked on together.
const CHUNK: usize = 64;
/// The stream of random numbers.
const STREAM: u64 = 1;

/// Points of the surface along a space-filling curve: neighbours in the list are neighbours.
pub(in crate::generate) struct Points {
    pub at: Vec<Vec3>,
    /// Outward normals there.
    pub normals: Vec<Vec3>,
}

/// One of them, before it is known whether it bounds the inside.
struct Point {
    at: Vec3,
    normal: Vec3,
}

impl Points {
    /// Spreads them over the surface of a body; refused where that may take more than `room` bytes.
    pub fn new(body: &Body, surface: &Surface, room: u64, run: &Run) -> Result<Points> {
        let (curve, mut all) = match body {
            Body::Mesh(mesh) => {
                let curve = Curve::around(mesh.vertices.iter().copied());
                let all = on_mesh(mesh, &curve, room, run)?;
                (curve, all)
            }
            Body::Voxels(voxels) => {
                let far = Vec3::from(voxels.dims.map(|n| n as f64)).component_mul(&voxels.spacing);
                (Curve::around([Vec3::zeros(), far].into_iter()), on_voxels(voxels, run)?)
            }
        };
        all.sort_by_key(|p| curve.place(&p.at));
        let bounds = run.pool().map(all.len().div_ceil(CHUNK), |c| {
            let some = all.iter().skip(c * CHUNK).take(CHUNK);
            let bound = |p: &Point| {
                let step = p.normal * ASIDE;
                !surface.contains(&(p.at + step)) && surface.contains(&(p.at - step))
            };
            some.map(bound).collect::<Vec<bool>>()
        });
        let mut kept = Points { at: Vec::new(), normals: Vec::new() };
        for (p, bound) in all.iter().zip(bounds.into_iter().flatten()) {
            if bound {
                push("points of the surface", &mut kept.at, p.at)?;
                push("points of the surface", &mut kept.normals, p.normal)?;
            }
        }
        Ok(kept)
    }
}

/// One point at random in each of equal parts of the area of faces given in order: the number of
/// the face and the numbers of the point.
fn spread(
    areas: impl Iterator<Item = f64>,
    total: f64,
    seed: u64,
    mut put: impl FnMut(usize, &mut Draw),
) {
    let step = total / POINTS as f64;
    let (mut sum, mut k) = (0.0, 0);
    let mut draw = Draw::new(seed, STREAM, 0);
    let mut next = draw.unit() * step;
    for (i, area) in areas.enumerate() {
        sum += area;
        while next < sum && k < POINTS {
            put(i, &mut draw);
            k += 1;
            draw = Draw::new(seed, STREAM, k as u64);
            next = (k as f64 + draw.unit()) * step;
        }
    }
}

fn on_mesh(mesh: &Mesh, curve: &Curve, room: u64, run: &Run) -> Result<Vec<Point>> {
    let what = "points of the surface";
    let n = mesh.faces.len();
    // The faces in order.
    let bytes = (n as u64).saturating_mul(16);
    fits(format_args!("{what} of {n} faces"), bytes, room)?;
    let twice = |i: usize| {
        let [a, b, c] = mesh.corners(i);
        (b - a).cross(&(c - a))
    };
    let mut order: Vec<(u64, usize)> = reserve(what, n)?;
    for i in 0..n {
        let [a, b, c] = mesh.corners(i);
        order.push((curve.place(&((a + b + c) / 3.0)), i));
    }
    order.sort_unstable();
    let area = |&(_, i): &(u64, usize)| twice(i).norm();
    let total = order.iter().map(area).sum::<f64>();
    if total <= 0.0 {
        return Err(Error::Empty("the surface has no area".into()));
    }
    let mut out = reserve(what, POINTS)?;
    spread(order.iter().map(area), total, run.seed(), |k, draw| {
        if let Some(&(_, i)) = order.get(k) {
            let [a, b, c] = from_least(mesh.corners(i));
            let (u, v) = (draw.unit().sqrt(), draw.unit());
            let at = a * (1.0 - u) + b * (u * (1.0 - v)) + c * (u * v);
            let normal = twice(i);
            out.push(Point { at, normal: normal / normal.norm() });
        }
    });
    Ok(out)
}

/// The corners of a triangle from the least on, whichever the mesh names first.
fn from_least([a, b, c]: [Vec3; 3]) -> [Vec3; 3] {
    let before = |p: &Vec3, q: &Vec3| [p.x, p.y, p.z] < [q.x, q.y, q.z];
    if before(&b, &a) && before(&b, &c) {
        [b, c, a]
    } else if before(&c, &a) && before(&c, &b) {
        [c, a, b]
    } else {
        [a, b, c]
    }
}

fn on_voxels(voxels: &Voxels, run: &Run) -> Result<Vec<Point>> {
    let h = voxels.spacing;
    let areas = [h.y * h.z, h.x * h.z, h.x * h.y];
    let faces = || {
        let sides = (0..voxels.cells.len()).flat_map(|i| (0..6).map(move |side| (i, side)));
        sides.filter(|&(i, side)| bare(voxels, i, side))
    };
    let total = faces().map(|(_, side)| areas[side / 2]).sum::<f64>();
    if total <= 0.0 {
        return Err(Error::Empty("the voxels have no outer face".into()));
    }
    let mut out = reserve("points of the surface", POINTS)?;
    let mut walk = faces();
    let (mut at, mut next) = (0, walk.next());
    spread(faces().map(|(_, side)| areas[side / 2]), total, run.seed(), |k, draw| {
        // The face of number k: the walk goes along.
        while at < k {
            next = walk.next();
            at += 1;
        }
        if let Some((i, side)) = next {
            let [nx, ny, _] = voxels.dims;
            let corner = [i % nx, i / nx % ny, i / (nx * ny)].map(|c| c as f64);
            let mut p = Vec3::from_fn(|a, _| corner[a] + draw.unit());
            let (axis, up) = (side / 2, (side % 2) as f64);
            p[axis] = corner[axis] + up;
            let mut normal = Vec3::zeros();
            normal[axis] = 2.0 * up - 1.0;
            out.push(Point { at: p.component_mul(&h), normal });
        }
    });
    Ok(out)
}

/// Whether cell `i` is solid and nothing solid is beside it: sides are 2 axis + (upper: 1).
fn bare(voxels: &Voxels, i: usize, side: usize) -> bool {
    let [nx, ny, nz] = voxels.dims;
    if voxels.cells.get(i).is_none_or(|c| *c == 0) {
        return false;
    }
    let (at, count, stride) = match side / 2 {
        0 => (i % nx, nx, 1),
        1 => (i / nx % ny, ny, nx),
        _ => (i / (nx * ny), nz, nx * ny),
    };
    let beside = match side % 2 {
        1 if at + 1 < count => i + stride,
        0 if at > 0 => i - stride,
        _ => return true,
    };
    voxels.cells.get(beside).is_none_or(|c| *c == 0)
}

/// A Morton curve through a cube about the body, whatever part of the unit frame that fills: the order of
/// points, and with it which are drawn together, is the same in every unit of length.
struct Curve {
    lo: Vec3,
    edge: f64,
}

/// The body within the curve's cube: no plane that halves a body lies where rounding would decide
/// between two parts of the curve.
const MARGIN: f64 = 0.137;
const FILLED: f64 = 0.8;

impl Curve {
    fn around(points: impl Iterator<Item = Vec3>) -> Curve {
        let none = (Vec3::repeat(f64::MAX), Vec3::repeat(-f64::MAX));
        let (lo, hi) = points.fold(none, |(lo, hi), p| (lo.inf(&p), hi.sup(&p)));
        Curve { lo, edge: (hi - lo).max().max(f64::MIN_POSITIVE) }
    }

    /// Place along it.
    fn place(&self, p: &Vec3) -> u64 {
        let spread = |x: f64| {
            let mut v = (x.clamp(0.0, 1.0) * 1_048_575.0) as u64;
            v = (v | v << 32) & 0x001f_0000_0000_ffff;
            v = (v | v << 16) & 0x001f_0000_ff00_00ff;
            v = (v | v << 8) & 0x100f_00f0_0f00_f00f;
            v = (v | v << 4) & 0x10c3_0c30_c30c_30c3;
            (v | v << 2) & 0x1249_2492_4924_9249
        };
        let at = (p - self.lo) / self.edge * FILLED;
        let [x, y, z] = [at.x, at.y, at.z].map(|x| spread(x + MARGIN));
        x | y << 1 | z << 2
    }
}
