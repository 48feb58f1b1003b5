//! Overlap of target and clump by columns: lengths of exact intervals on a
//! lattice of two axes.

use super::QualityOptions;
use crate::error::{Error, Result, fits};
use crate::math::{Inertia, Moments, PrincipalFrame, Sphere, Vec3};
use crate::run::Run;
use crate::shape::Body;
use crate::solid::Solid;
use crate::solid::columns::{BAND, Band, Lattice, Rows};

/// Bands of rows summed between two looks at the caller's cancel.
const GROUP: usize = 64;
/// Bytes of a column of a band, with what making it takes (a few crossings).
const COLUMN: u64 = 256;

/// What the columns say. Unit frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Overlap {
    pub mismatch: f64,
    pub error_bound: f64,
    pub target: f64,
    pub union: f64,
    pub both: f64,
    pub centroid_error: f64,
    pub moment_errors: [f64; 3],
}

/// Sums over columns. Volumes by the parity of the column's two indices, so that four
/// interleaved lattices of twice the step are at hand; first and second moments of all.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    target: [f64; 4],
    union: [f64; 4],
    both: [f64; 4],
    target_moments: Raw,
    union_moments: Raw,
}

/// `∫ 1; u, v, t; u², v², t², uv, ut, vt` with t along the columns.
type Raw = [f64; 10];

/// The lattice for `body` and `spheres`, about n × n columns along the body's shortest edge.
///
/// Meshes: a slanted lattice over the box around both, so that faces parallel to the columns
/// do no harm. Voxels: an even number of columns to each cell, which makes the target's
/// volume exact; a slanted lattice where that would be too many.
pub(super) fn lattice(body: &Body, spheres: &[Sphere], n: usize) -> Option<Lattice> {
    let (lo, hi) = body_box(body)?;
    let edges = hi - lo;
    let axis = (0..3).rev().min_by(|&i, &j| edges[i].total_cmp(&edges[j]))?;
    let (mut all_lo, mut all_hi) = (lo, hi);
    for s in spheres {
        let r = Vec3::repeat(s.radius);
        all_lo = all_lo.inf(&(s.center - r));
        all_hi = all_hi.sup(&(s.center + r));
    }
    let sampled = [(axis + 1) % 3, (axis + 2) % 3];
    if let Body::Voxels(voxels) = body {
        let h = sampled.map(|a| voxels.spacing[a]);
        let first = [0, 1].map(|k| (all_lo[sampled[k]] / h[k]).floor());
        let cells = [0, 1].map(|k| (all_hi[sampled[k]] / h[k]).ceil() - first[k]);
        let even = |k: usize| 2.0 * (n as f64 / (2.0 * cells[k])).ceil();
        let (per, most) = ([even(0), even(1)], 4.0 * n as f64);
        if (0..2).all(|k| cells[k] * per[k] <= most) {
            return Some(Lattice::straight(
                axis,
                [0, 1].map(|k| (cells[k] * per[k]) as usize),
                [0, 1].map(|k| first[k] * h[k]),
                [0, 1].map(|k| h[k] / per[k]),
            ));
        }
    }
    let corner = |p: &Vec3| sampled.map(|a| p[a]);
    Some(Lattice::slanted(axis, n, corner(&all_lo), corner(&all_hi)))
}

/// A slanted lattice of about n × n columns over spheres, along the shortest edge of their box.
pub(super) fn lattice_of(spheres: &[Sphere], n: usize) -> Option<Lattice> {
    let none = (Vec3::repeat(f64::MAX), Vec3::repeat(-f64::MAX));
    let (lo, hi) = spheres.iter().fold(none, |(lo, hi), s| {
        let r = Vec3::repeat(s.radius);
        (lo.inf(&(s.center - r)), hi.sup(&(s.center + r)))
    });
    let edges = hi - lo;
    let axis = (0..3).rev().min_by(|&i, &j| edges[i].total_cmp(&edges[j]))?;
    let corner = |p: &Vec3| [(axis + 1) % 3, (axis + 2) % 3].map(|a| p[a]);
    (!spheres.is_empty()).then(|| Lattice::slanted(axis, n, corner(&lo), corner(&hi)))
}

/// Bounding box of a body; `None` when it is empty.
pub(super) fn body_box(body: &Body) -> Option<(Vec3, Vec3)> {
    match body {
        Body::Voxels(v) => {
            let dims = Vec3::from(v.dims.map(|d| d as f64));
            Some((Vec3::zeros(), dims.component_mul(&v.spacing)))
        }
        Body::Mesh(m) => {
            let first = m.vertices.first()?;
            let mut both = (*first, *first);
            for v in &m.vertices {
                both = (both.0.inf(v), both.1.sup(v));
            }
            Some(both)
        }
    }
}

/// Overlap of `solid` with the union of `spheres` (unit frame).
pub(super) fn overlap(
    solid: &Solid,
    spheres: &[Sphere],
    options: &QualityOptions,
    run: &Run,
) -> Result<Overlap> {
    let body = solid.body();
    let (Some(lattice), Some((lo, hi))) = (lattice(body, spheres, options.columns), body_box(body))
    else {
        return Err(Error::Empty("the target has no vertex and no cell".into()));
    };
    let room = solid.memory_limit().saturating_sub(solid.bytes());
    let target = Rows::of_body(body, lattice, room)?;
    let union = Rows::of_spheres(spheres, lattice)?;
    let bands = (run.pool().threads() * BAND) as u64 * lattice.dims[0] as u64 * COLUMN;
    let bytes = target.bytes() + union.bytes() + bands;
    let ([across, rows], n) = (lattice.dims, spheres.len());
    fits(format_args!("{across} × {rows} columns through {n} spheres"), bytes, room)?;
    run.count(|c| {
        c.columns += (lattice.dims[0] * lattice.dims[1]) as u64;
        c.peak_bytes = c.peak_bytes.max(solid.bytes() + bytes);
    });
    // On a lattice of whole cells the target is a set of prisms, each with its own cross-section.
    let prisms = matches!(body, Body::Voxels(_)) && lattice.inverse[0][1] == 0.0;
    match compare(&target, &union, 0.5 * (lo + hi)[lattice.axis], prisms, run) {
        Err(Error::ZeroVolume(_)) => Err(missed(solid, spheres, (lo, hi))),
        done => done,
    }
}

/// Why no column meets the target: a sphere that is far larger or farther away than it, else
/// too few columns.
fn missed(solid: &Solid, spheres: &[Sphere], (lo, hi): (Vec3, Vec3)) -> Error {
    let middle = 0.5 * (lo + hi);
    let reach = |s: &Sphere| (s.center - middle).amax() + s.radius;
    let farthest = spheres.iter().enumerate().max_by(|a, b| reach(a.1).total_cmp(&reach(b.1)));
    match farthest {
        // At twice the target's size the columns still stand half as dense.
        Some((i, s)) if reach(s) > (hi - lo).max() => {
            let s = solid.frame().sphere_to_input(s);
            Error::InvalidArgument(format!(
                "sphere {i} has radius {:.3e} and centre ({:.3e}, {:.3e}, {:.3e}): so far beyond \
                 the target, of size {:.3e}, that no column meets both",
                s.radius,
                s.center.x,
                s.center.y,
                s.center.z,
                (hi - lo).max() * solid.frame().scale
            ))
        }
        _ => Error::ZeroVolume("no column meets the target: ask for more columns".into()),
    }
}

/// Compares two bodies on one lattice, band by band. `middle`: where along the columns the
/// moments are taken about. `prisms`: the target is constant over the area of a column, so its
/// second moments gain step²/12; elsewhere the lattice's mean over all its places is exact
/// without it.
pub(super) fn compare(
    target: &Rows,
    union: &Rows,
    middle: f64,
    prisms: bool,
    run: &Run,
) -> Result<Overlap> {
    let l = &target.lattice;
    let [x, y] = l.place(l.dims[0] / 2, l.dims[1] / 2);
    let center = [x, y, middle];
    let mut sums = Sums::default();
    let total = target.bands();
    for first in (0..total).step_by(GROUP) {
        run.check(0.0, "measuring the overlap")?;
        let found = run.pool().map(GROUP.min(total - first), |i| {
            let i = first + i;
            Ok(band(&target.band(i)?, &union.band(i)?, l, center, i * BAND))
        });
        for b in found {
            sums.add(&b?);
        }
    }
    let area = l.area();
    let [s, c, i] =
        [sums.target, sums.union, sums.both].map(|x| (x[0] + x[1] + x[2] + x[3]) * area);
    if s <= 0.0 {
        return Err(Error::ZeroVolume("no column meets the target: ask for more columns".into()));
    }
    let mismatch = dice(s, c, i);
    // D = (|S∖C| + |C∖S|) / (|S| + |C|): how far the four lattices of twice the step lie from
    // their mean, for each volume by itself so that errors do not cancel by chance.
    let spread = |part: &dyn Fn(usize) -> f64| {
        let x: [f64; 4] = std::array::from_fn(part);
        let mean = 0.25 * (x[0] + x[1] + x[2] + x[3]);
        x.iter().map(|x| (x - mean).abs()).fold(0.0, f64::max) * 4.0 * area
    };
    let beyond = spread(&|q| sums.union[q] - sums.both[q]);
    let missing = spread(&|q| sums.target[q] - sums.both[q]);
    let sizes = spread(&|q| sums.target[q]) + spread(&|q| sums.union[q]);
    let error_bound = (beyond + missing + mismatch * sizes) / (s + c) + 1e-12;
    let mut target_moments = sums.target_moments;
    if prisms {
        for k in 0..2 {
            target_moments[4 + k] += l.step[k] * l.step[k] / 12.0 * target_moments[0];
        }
    }
    let m = [target_moments, sums.union_moments].map(|raw| moments(&raw, l));
    let diameter = (6.0 * s / std::f64::consts::PI).cbrt();
    let principal = m.map(|m| PrincipalFrame::of(&m.inertia).moments);
    let mut moment_errors = [0.0; 3];
    for k in 0..3 {
        if principal[0][k] > 0.0 {
            moment_errors[k] = principal[1][k] / principal[0][k] - 1.0;
        }
    }
    Ok(Overlap {
        mismatch,
        error_bound: error_bound.min(1.0),
        target: s,
        union: c,
        both: i,
        centroid_error: (m[1].centroid - m[0].centroid).norm() / diameter,
        moment_errors,
    })
}

/// D of three volumes (Buchele et al. 2026, eq 27).
fn dice(s: f64, c: f64, both: f64) -> f64 {
    (1.0 - 2.0 * both / (s + c)).clamp(0.0, 1.0)
}

/// The sums over one band, whose first row is `first`.
fn band(target: &Band, union: &Band, l: &Lattice, center: [f64; 3], first: usize) -> Sums {
    let mut sums = Sums::default();
    let mut columns = target.columns().zip(union.columns());
    for b in first..l.dims[1].min(first + BAND) {
        for (a, (s, c)) in (0..l.dims[0]).zip(&mut columns) {
            if s.is_empty() && c.is_empty() {
                continue;
            }
            let q = (a & 1) + 2 * (b & 1);
            let [u, v] = l.place(a, b);
            let at = [u - center[0], v - center[1]];
            sums.target[q] += add_column(&mut sums.target_moments, s, at, center[2]);
            sums.union[q] += add_column(&mut sums.union_moments, c, at, center[2]);
            sums.both[q] += common(s, c);
        }
    }
    sums
}

/// Adds one column's integrals and returns its length.
fn add_column(raw: &mut Raw, intervals: &[[f64; 2]], [u, v]: [f64; 2], center: f64) -> f64 {
    let mut m = [0.0; 3];
    for i in intervals {
        // About the interval's own middle: no cancellation of cubes.
        let (length, mid) = (i[1] - i[0], 0.5 * (i[0] + i[1]) - center);
        m[0] += length;
        m[1] += length * mid;
        m[2] += length * (mid * mid + length * length / 12.0);
    }
    for (sum, x) in raw.iter_mut().zip([
        m[0],
        u * m[0],
        v * m[0],
        m[1],
        u * u * m[0],
        v * v * m[0],
        m[2],
        u * v * m[0],
        u * m[1],
        v * m[1],
    ]) {
        *sum += x;
    }
    m[0]
}

/// Length common to two lists of disjoint ascending intervals.
fn common(x: &[[f64; 2]], y: &[[f64; 2]]) -> f64 {
    let (mut i, mut j, mut sum) = (0, 0, 0.0);
    while let (Some(p), Some(q)) = (x.get(i), y.get(j)) {
        sum += (p[1].min(q[1]) - p[0].max(q[0])).max(0.0);
        if p[1] < q[1] { i += 1 } else { j += 1 }
    }
    sum
}

/// Moments from raw integrals, about the sums' own centre: differences are all that is used.
fn moments(raw: &Raw, l: &Lattice) -> Moments {
    let area = l.area();
    let volume = raw[0] * area;
    if volume <= 0.0 {
        return Moments {
            volume: 0.0,
            centroid: Vec3::zeros(),
            inertia: Inertia::default(),
            relative_error: 0.0,
        };
    }
    let mean = [raw[1], raw[2], raw[3]].map(|x| x / raw[0]);
    // Central second moments, turned from (u, v, t) to x, y, z.
    let mut second = nalgebra::Matrix3::zeros();
    for (k, (i, j)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
        let value = (raw[4 + k] - raw[0] * mean[i] * mean[j]) * area;
        let [i, j] = [i, j].map(|m| (l.axis + 1 + m) % 3);
        second[(i, j)] = value;
        second[(j, i)] = value;
    }
    let mut centroid = Vec3::zeros();
    for (k, m) in mean.into_iter().enumerate() {
        centroid[(l.axis + 1 + k) % 3] = m;
    }
    let m = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| second[at]);
    Moments { volume, centroid, inertia: Inertia::from_second_moments(m), relative_error: 0.0 }
}

impl Sums {
    fn add(&mut self, other: &Sums) {
        let add = |x: &mut [f64], y: &[f64]| x.iter_mut().zip(y).for_each(|(x, y)| *x += y);
        add(&mut self.target, &other.target);
        add(&mut self.union, &other.union);
        add(&mut self.both, &other.both);
        add(&mut self.target_moments, &other.target_moments);
        add(&mut self.union_moments, &other.union_moments);
    }
}

#[cfg(test)]
#[path = "overlap_tests.rs"]
mod tests;
