//! The symmetry that a target has about its centre of mass, by how far its surface lies from its
//! image. Looked at are the exchanges of the input's axes and of the principal axes; where
//! principal moments are equal, so that any axis between them is one, mirror planes are looked
//! for among them as well.

use super::group::{FOUND, Group, Matrix, Set, exchanges, mirror};
use crate::error::{Result, reserve};
use crate::generate::balls::field::Field;
use crate::math::{PrincipalFrame, Vec3};
use crate::shape::{Body, Mesh};
use crate::solid::{Grid, Solid};
use wide::f32x8;

/// Points of the surface; a multiple of eight, as are those of a first look.
const POINTS: usize = 512;
const FIRST: usize = 128;
/// How far image and surface may be apart in the mean, beside what the field says of the
/// surface itself: of a cell, or of the size where cells are finer than surfaces are made.
/// A clump that is its own image cannot follow either of two surfaces that differ: it costs
/// about half of what they differ, so this is kept below what the grid shows.
const CELL: f64 = 0.06;
const SIZE: f64 = 6e-4;
/// The same of a cell of voxels: borders are where cells end, on average a quarter of a cell off.
const VOXEL: f64 = 0.35;
/// Principal moments that differ by less than this part may be equal.
const EQUAL: f64 = 0.02;
/// Normals looked at around a circle, and over half a sphere.
const CIRCLE: usize = 180;
const SPHERE: usize = 600;
/// Where more than this part of them are mirror planes, all are: the body is one of revolution.
const MANY: f64 = 0.5;
/// Mirror planes that are looked at more closely, and how far apart their normals are at least.
const CLOSER: usize = 16;
const APART: f64 = 0.1;
/// The first and last step of that.
const STEPS: [f64; 2] = [0.04, 2e-4];

/// Tells how far the surface lies from its image.
struct Probe<'a> {
    field: &'a Field,
    centre: Vec3,
    /// From the centre.
    points: Vec<Vec3>,
    /// The field at the points themselves: how well it knows the surface there.
    own: Vec<f64>,
    /// How far off is not off.
    most: f64,
}

/// The symmetry of the target. `keeps`: whether an image may be one at all.
pub(super) fn find(solid: &Solid, field: &Field, keeps: &dyn Fn(&Matrix) -> bool) -> Result<Group> {
    let probe = Probe::new(solid, field)?;
    let Some(all) = Group::generated(&exchanges(), FOUND) else { return Ok(Group::trivial()) };
    let principal =
        PrincipalFrame::of_rounded(&solid.unit_moments().inertia, solid.frame().noise());
    let mut best = probe.part(&all, keeps);
    for other in [probe.part(&all.turned(&principal.axes), keeps), probe.mirrors(&principal, keeps)]
    {
        if other.len() > best.len() {
            best = other;
        }
    }
    Ok(best)
}

impl<'a> Probe<'a> {
    fn new(solid: &Solid, field: &'a Field) -> Result<Probe<'a>> {
        let centre = solid.unit_moments().centroid;
        let cell = f64::from(field.cell());
        let size = (solid.unit_moments().volume / 0.2).cbrt();
        let (mut points, most) = match solid.body() {
            Body::Mesh(m) => (of_mesh(m)?, (CELL * cell).max(SIZE * size)),
            Body::Voxels(_) => (of_cells(solid.grid(), solid.inside()?)?, VOXEL * cell),
        };
        // What lies in other parts of the body, or is cut off, is no surface.
        let at = |p: &Vec3| f64::from(field.one([0, 1, 2].map(|a| p[a] as f32))).abs();
        points.retain(|p| at(p) < cell);
        points.truncate(points.len() / 8 * 8);
        let own = points.iter().map(at).collect();
        points.iter_mut().for_each(|p| *p -= centre);
        Ok(Probe { field, centre, points, own, most })
    }

    /// How far image and surface are apart, by so many points.
    fn off(&self, m: &Matrix, points: usize) -> f64 {
        let n = self.points.len().min(points) / 8 * 8;
        if n == 0 {
            return f64::from(f32::MAX);
        }
        // Spread over all points, whatever their order.
        let step = self.points.len() / n;
        let mut sum = 0.0;
        for k in (0..n).step_by(8) {
            let image = |l: usize| self.centre + m * self.points[(k + l) * step];
            let images: [Vec3; 8] = std::array::from_fn(image);
            let at = [0, 1, 2].map(|a| f32x8::new(images.map(|p| p[a] as f32)));
            for (l, f) in self.field.at(at).to_array().into_iter().enumerate() {
                sum += f64::from(f.abs()) - self.own[(k + l) * step];
            }
        }
        sum / n as f64
    }

    /// The largest part of a group that is found to be in the surface's symmetry.
    fn part(&self, group: &Group, keeps: &dyn Fn(&Matrix) -> bool) -> Group {
        let mut found: Vec<(f64, usize)> = Vec::new();
        for (i, m) in group.elements().iter().enumerate() {
            let off = self.off(m, POINTS);
            if i == 0 || (off <= self.most && keeps(m)) {
                found.push((off, i));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let all = found.iter().fold(0 as Set, |all, f| all | 1 << f.1);
        let within = |s: Set| s & !all == 0;
        let mut best = 1;
        if within(group.closure(all)) {
            best = all;
        } else {
            for first in &found {
                let mut part = group.closure(1 << first.1);
                if !within(part) {
                    continue;
                }
                for more in &found {
                    let larger = group.closure(part | 1 << more.1);
                    part = if within(larger) { larger } else { part };
                }
                if part.count_ones() > best.count_ones() {
                    best = part;
                }
            }
        }
        group.part(best)
    }

    /// The group of mirror planes between principal axes with equal moments.
    fn mirrors(&self, principal: &PrincipalFrame, keeps: &dyn Fn(&Matrix) -> bool) -> Group {
        let mut group = Group::trivial();
        let [a, b, c] = principal.moments;
        let equal = [b - a < EQUAL * c, c - b < EQUAL * c];
        let axis = |i: usize| principal.axes.column(i).into_owned();
        let mut normals: Vec<Vec3> = match equal {
            [true, true] => half_sphere(),
            [true, false] => circle(&axis(0), &axis(1)),
            [false, true] => circle(&axis(1), &axis(2)),
            [false, false] => return group,
        };
        let mut found: Vec<(f64, Vec3)> =
            normals.drain(..).map(|n| (self.off(&mirror(&n), FIRST), n)).collect();
        let many = found.iter().filter(|f| f.0 <= self.most).count();
        if many as f64 > MANY * found.len() as f64 {
            return group;
        }
        let mean = found.iter().map(|f| f.0).sum::<f64>() / found.len().max(1) as f64;
        found.sort_by(|x, y| x.0.total_cmp(&y.0));
        let mut closer: Vec<(f64, Vec3)> = Vec::new();
        // The axis that is alone comes first.
        let alone = match equal {
            [true, false] => Some(axis(2)),
            [false, true] => Some(axis(0)),
            _ => None,
        };
        for n in alone.into_iter().chain(found.iter().filter(|f| f.0 < mean).map(|f| f.1)) {
            if closer.len() < CLOSER && closer.iter().all(|k| k.1.cross(&n).norm() > APART) {
                closer.push((0.0, n));
            }
        }
        for k in &mut closer {
            *k = self.closer(k.1);
        }
        closer.retain(|k| k.0 <= self.most);
        closer.sort_by(|x, y| x.0.total_cmp(&y.0));
        for (_, n) in closer {
            let generators = [group.elements(), &[mirror(&n)]].concat();
            if let Some(more) = Group::generated(&generators, FOUND)
                && more.elements()[1..]
                    .iter()
                    .all(|m| !turns_little(m) && self.off(m, POINTS) <= 2.0 * self.most && keeps(m))
            {
                group = more;
            }
        }
        group
    }

    /// The normal near this one for which image and surface are closest, and how close.
    fn closer(&self, mut normal: Vec3) -> (f64, Vec3) {
        let mut off = self.off(&mirror(&normal), POINTS);
        let mut step = STEPS[0];
        while step > STEPS[1] {
            let across = beside(&normal);
            let other = normal.cross(&across);
            let mut better = false;
            for way in [across, -across, other, -other] {
                let n = (normal + way * step).normalize();
                let o = self.off(&mirror(&n), POINTS);
                if o < off {
                    (off, normal, better) = (o, n, true);
                }
            }
            if !better {
                step *= 0.5;
            }
        }
        (off, normal)
    }
}

/// Whether a matrix is a turn by less than an eighth: a body with more folds is one of revolution
/// that a mesh has made a prism.
fn turns_little(m: &Matrix) -> bool {
    m.determinant() > 0.0 && m.trace() > 1.0 + 2f64.sqrt() + 0.05
}

/// A direction across another.
fn beside(n: &Vec3) -> Vec3 {
    let axis = Vec3::from_fn(|i, _| f64::from(u8::from(i == n.iamin())));
    n.cross(&axis).normalize()
}

/// Half of all directions in the plane of two.
fn circle(x: &Vec3, y: &Vec3) -> Vec<Vec3> {
    let turn = |k: usize| (std::f64::consts::PI * k as f64 / CIRCLE as f64).sin_cos();
    (0..CIRCLE).map(turn).map(|(s, c)| x * c + y * s).collect()
}

/// Half of all directions: Fibonacci's lattice.
fn half_sphere() -> Vec<Vec3> {
    let turn = std::f64::consts::PI * (1.0 + 5f64.sqrt());
    let one = |k: usize| {
        let z = (k as f64 + 0.5) / SPHERE as f64;
        let (s, c) = (turn * k as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * c, r * s, z)
    };
    (0..SPHERE).map(one).collect()
}

/// Points of the surface, one in each of equal parts of its area.
fn of_mesh(mesh: &Mesh) -> Result<Vec<Vec3>> {
    let corner = |i: u32| mesh.vertices.get(i as usize).copied().unwrap_or_default();
    let area = |f: &[u32; 3]| {
        let [a, b, c] = f.map(corner);
        (b - a).cross(&(c - a)).norm()
    };
    let part = mesh.faces.iter().map(area).sum::<f64>() / POINTS as f64;
    let mut points = reserve("points of the surface", POINTS)?;
    let mut before = 0.0;
    for f in &mesh.faces {
        let [a, b, c] = f.map(corner);
        let after = before + area(f);
        while points.len() < POINTS && (points.len() as f64 + 0.5) * part < after {
            // Two sequences that are spread evenly together (Roberts 2018).
            let k = points.len() as f64;
            let (s, t) = ((0.754_877_666_2 * k).fract().sqrt(), (0.569_840_291 * k).fract());
            points.push(a + (b - a) * (s * (1.0 - t)) + (c - a) * (s * t));
        }
        before = after;
    }
    Ok(points)
}

/// Middles of faces between cells inside and outside.
fn of_cells(grid: &Grid, inside: &[u8]) -> Result<Vec<Vec3>> {
    let stride = [1, grid.dims[0], grid.dims[0] * grid.dims[1]];
    let each = |f: &mut dyn FnMut(usize, usize)| {
        for (axis, &stride) in stride.iter().enumerate() {
            for (i, pair) in inside.iter().zip(inside.iter().skip(stride)).enumerate() {
                if pair.0 != pair.1 {
                    f(i, axis);
                }
            }
        }
    };
    let mut total = 0;
    each(&mut |_, _| total += 1);
    let mut points = reserve("points of the surface", POINTS)?;
    let mut k = 0;
    each(&mut |i, axis| {
        let [nx, ny, _] = grid.dims;
        let mut p = grid.center(i % nx, i / nx % ny, i / nx / ny);
        p[axis] += 0.5 * grid.spacing[axis];
        while points.len() < POINTS && points.len() * total < (k + 1) * POINTS {
            points.push(p);
        }
        k += 1;
    });
    Ok(points)
}

#[cfg(test)]
#[path = "detect_tests.rs"]
mod tests;
