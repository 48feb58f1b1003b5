//! Exact volume, centroid and inertia of a body.

use super::columns::{Cones, Lattice, Rows, border};
use super::winding::Winding;
use super::{Columns, lids};
use crate::error::{Error, Result};
use crate::math::{Inertia, Moments, Vec3};
use crate::run::Run;
use crate::shape::{Body, Mesh, Voxels};

/// Faces summed together: fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 4096;
/// Columns along each sampled axis that look for overlaps, on a slanted lattice, which no long
/// thin one slips through.
const LOOK: usize = 64;
/// Columns along each sampled axis that integrate a mesh whose edges cancel.
const CLOSED: usize = 384;
/// … one with small openings, and one that is wide open, where each column costs many winding
/// numbers.
const OPEN: usize = 96;
const WIDE_OPEN: usize = 40;
/// Share of the volume that may be miscounted before columns integrate better than signed sums.
const OVERLAP: f64 = 1e-4;
/// Columns along the three axes that differ by more than this describe no body.
const UNDEFINED: f64 = 0.5;
/// A share of the volume below this is rounding.
const ROUNDING: f64 = 1e-9;

/// Moments at unit density in the unit frame: polyhedral integrals for a closed mesh
/// that does not cross itself, columns with a stated error otherwise, sums over cells
/// (each with its own inertia) for voxels.
///
/// Whether a mesh crosses itself is seen by 64 × 64 columns along each axis, exact along the
/// column. An overlap whose shadow along each of the three axes is less than about 1/4000 of
/// the box's face may slip between them; the polyhedral integrals count it twice, and
/// `relative_error` is 0. Such a one takes less than 1e-5 of the box.
///
/// Openings of a mesh are closed by the lids that [`super::Solid`] puts over them.
pub fn moments(body: &Body, run: &Run) -> Result<Moments> {
    if let Body::Mesh(mesh) = body
        && let Some(lids) = lids::close(mesh, false, u64::MAX, run)?
        && let Some(closed) = lids.mesh
    {
        return within(&Body::Mesh(closed), u64::MAX, run);
    }
    within(body, u64::MAX, run)
}

/// The same, refused where what an open mesh needs may take more than `limit` bytes.
pub(super) fn within(body: &Body, limit: u64, run: &Run) -> Result<Moments> {
    match body {
        Body::Voxels(v) => of_cells(v),
        Body::Mesh(mesh) => {
            let Some((lo, hi)) = bounds(mesh) else {
                return Err(Error::Empty("the mesh has no face".into()));
            };
            if !(mesh.clean || border(mesh)?.is_empty()) {
                let n = if wide_open(mesh, limit, run)? { WIDE_OPEN } else { OPEN };
                return by_columns(body, [lo, hi], n, limit, run);
            }
            let exact = of_polyhedron(mesh, &((lo + hi) * 0.5), run);
            run.check(0.0, "looking for overlaps")?;
            let pool = run.pool();
            let look = |axis, limit| -> Result<f64> {
                let lattice = lattice(axis, [lo, hi], LOOK, true)?;
                Ok(Columns::of(&Rows::of_body(body, lattice, limit)?, pool)?.miscounted)
            };
            let mut miscounted = 0.0f64;
            for (axis, found) in pool.map(3, |axis| look(axis, limit / 3)).into_iter().enumerate() {
                // What is too much at once may fit one after the other.
                let found = match found {
                    Err(Error::MemoryLimit(_)) => look(axis, limit),
                    found => found,
                };
                miscounted = miscounted.max(found?);
            }
            if miscounted > OVERLAP * exact.volume.abs() {
                return by_columns(body, [lo, hi], CLOSED, limit, run);
            }
            let noise = 1e-14 * (hi - lo).max() * area(mesh);
            if exact.volume <= noise {
                return Err(Error::ZeroVolume(format!(
                    "the mesh encloses no volume: {:e} in units of its box",
                    exact.volume
                )));
            }
            let share = 2.0 * miscounted / exact.volume;
            let felt = if share > 2.0 * ROUNDING { felt(&exact, lo, hi) } else { 0.0 };
            Ok(Moments { relative_error: share * felt, ..exact })
        }
    }
}

/// The moments of a body whose moments are exact, in other axes or units: of the faces or cells alone.
pub(super) fn of_exact(body: &Body, run: &Run) -> Result<Moments> {
    match body {
        Body::Voxels(v) => of_cells(v),
        Body::Mesh(mesh) => {
            let Some((lo, hi)) = bounds(mesh) else {
                return Err(Error::Empty("the mesh has no face".into()));
            };
            Ok(of_polyhedron(mesh, &((lo + hi) * 0.5), run))
        }
    }
}

/// By how much more than the volume the centroid or the inertia may be wrong when a small share
/// of the volume lies in the wrong place: at most as far off as the box reaches.
fn felt(m: &Moments, lo: Vec3, hi: Vec3) -> f64 {
    let reach = (hi - m.centroid).sup(&(m.centroid - lo)).norm();
    let greatest = m.inertia.to_array().iter().fold(0.0f64, |g, v| g.max(v.abs()));
    let turned = if greatest > 0.0 { reach * reach * m.volume / greatest } else { 1.0 };
    turned.max(reach / m.volume.cbrt()).max(1.0)
}

/// How far `a` and `b` differ: volume, centroid over the cube root of the volume, inertia over
/// its greatest entry.
fn difference(a: &Moments, b: &Moments) -> f64 {
    let (x, y) = (a.inertia.to_array(), b.inertia.to_array());
    let greatest = y.iter().fold(0.0f64, |g, v| g.max(v.abs()));
    let inertia = x.iter().zip(&y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    let inertia = if greatest > 0.0 { inertia / greatest } else { 0.0 };
    let centroid = (a.centroid - b.centroid).norm() / b.volume.cbrt();
    inertia.max(centroid).max((a.volume / b.volume - 1.0).abs())
}

/// Whether the openings are felt in a tenth of the box or more: the winding number there, on
/// 8³ points, is far from whole; or that of what closes the mesh, as both add up to whole ones.
pub(super) fn wide_open(mesh: &Mesh, limit: u64, run: &Run) -> Result<bool> {
    const N: usize = 8;
    let Some((lo, hi)) = bounds(mesh) else { return Ok(false) };
    let felt = |winding: &dyn Fn(&Vec3) -> f64| {
        let felt = (0..N * N * N).filter(|q| {
            let at = [q % N, q / N % N, q / (N * N)].map(|i| (i as f64 + 0.5) / N as f64);
            let w = winding(&(lo + (hi - lo).component_mul(&Vec3::from(at))));
            (w - w.round()).abs() > 0.05
        });
        10 * felt.count() >= N * N * N
    };
    let border = border(mesh)?;
    let (answer, bytes) = if border.len() < mesh.faces.len() {
        let cones = Cones::new(mesh, &border, limit)?;
        (felt(&|p| cones.at(p)), cones.bytes())
    } else {
        let winding = Winding::within(mesh, limit)?;
        (felt(&|p| winding.at(p)), winding.bytes())
    };
    run.count(|c| c.peak_bytes = c.peak_bytes.max(bytes));
    Ok(answer)
}

/// Corners of the box about the faces.
pub(super) fn bounds(mesh: &Mesh) -> Option<(Vec3, Vec3)> {
    let first = mesh.faces.first()?[0];
    let first = mesh.vertices[first as usize];
    let (mut lo, mut hi) = (first, first);
    for &v in mesh.faces.iter().flatten() {
        let v = &mesh.vertices[v as usize];
        lo = lo.inf(v);
        hi = hi.sup(v);
    }
    Some((lo, hi))
}

/// Area of the faces.
pub(crate) fn area(mesh: &Mesh) -> f64 {
    (0..mesh.faces.len())
        .map(|i| {
            let [a, b, c] = mesh.corners(i);
            (b - a).cross(&(c - a)).norm() * 0.5
        })
        .sum()
}

/// Sums over the tetrahedra between the faces and a point: the integrals over the polyhedron,
/// exact up to rounding. Two passes, the second about the centroid, so that nothing cancels.
fn of_polyhedron(mesh: &Mesh, middle: &Vec3, run: &Run) -> Moments {
    let sum = |about: Vec3, whole: bool| {
        let chunks = mesh.faces.len().div_ceil(CHUNK);
        let partial = run.pool().map(chunks, |c| {
            let mut s = Sums::default();
            for i in c * CHUNK..mesh.faces.len().min((c + 1) * CHUNK) {
                let [a, b, c] = mesh.corners(i);
                let corners = [a - about, b - about, c - about];
                if whole {
                    s.tetrahedron(corners);
                } else {
                    s.place(&corners);
                }
            }
            s
        });
        partial.iter().fold(Sums::default(), |mut total, s| {
            total.add(s);
            total
        })
    };
    let first = sum(*middle, false);
    if first.volume == 0.0 {
        return first.moments(middle);
    }
    let centroid = middle + first.first / first.volume;
    sum(centroid, true).moments(&centroid)
}

/// Integrals over a body: 1, x, and xx, yy, zz, xy, xz, yz.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sums {
    pub(crate) volume: f64,
    first: Vec3,
    second: [f64; 6],
}

impl Sums {
    /// Adds the volume of the tetrahedron between the origin and a face, and its place; gives its
    /// volume times six, and the sum of its corners.
    #[inline(always)]
    fn place(&mut self, [a, b, c]: &[Vec3; 3]) -> (f64, Vec3) {
        let det = a.dot(&b.cross(c));
        let s = a + b + c;
        self.volume += det / 6.0;
        self.first += s * (det / 24.0);
        (det, s)
    }

    /// Adds the tetrahedron between the origin and a face.
    #[inline]
    pub(crate) fn tetrahedron(&mut self, corners: [Vec3; 3]) {
        let (det, s) = self.place(&corners);
        let [a, b, c] = corners;
        let share = det / 120.0;
        for (second, &(i, j)) in self.second.iter_mut().zip(&PAIRS) {
            let products = s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j];
            *second += products * share;
        }
    }

    /// Adds a box.
    pub(crate) fn cuboid(&mut self, lo: &Vec3, hi: &Vec3) {
        let (edges, x) = (hi - lo, (lo + hi) * 0.5);
        let volume = edges.x * edges.y * edges.z;
        self.volume += volume;
        self.first += x * volume;
        for (k, (i, j)) in PAIRS.into_iter().enumerate() {
            let own = if i == j { edges[i] * edges[i] / 12.0 } else { 0.0 };
            self.second[k] += (x[i] * x[j] + own) * volume;
        }
    }

    /// The same integrals about a point from which the former one lies `by` away.
    pub(crate) fn shifted(&self, by: &Vec3) -> Sums {
        let mut second = self.second;
        for (k, (i, j)) in PAIRS.into_iter().enumerate() {
            second[k] +=
                self.first[i] * by[j] + by[i] * self.first[j] + by[i] * by[j] * self.volume;
        }
        Sums { volume: self.volume, first: self.first + by * self.volume, second }
    }

    /// The same integrals times a number.
    pub(crate) fn times(&self, by: f64) -> Sums {
        Sums {
            volume: self.volume * by,
            first: self.first * by,
            second: self.second.map(|s| s * by),
        }
    }

    /// Adds the part from `t[0]` to `t[1]` of the column at `uv`.
    pub(crate) fn column(&mut self, c: &Lattice, uv: [f64; 2], t: [f64; 2]) {
        let length = t[1] - t[0];
        let volume = length * c.area();
        let (p, q) = ((c.axis + 1) % 3, (c.axis + 2) % 3);
        let mut x = Vec3::zeros();
        x[c.axis] = 0.5 * (t[0] + t[1]);
        x[p] = uv[0];
        x[q] = uv[1];
        // The cross section is the lattice's parallelogram, with edges i and j.
        let mut own = nalgebra::Matrix3::zeros();
        own[(c.axis, c.axis)] = length * length / 12.0;
        let [i, j] = [0, 1].map(|k| [c.inverse[0][k] * c.step[k], c.inverse[1][k] * c.step[k]]);
        own[(p, p)] = (i[0] * i[0] + j[0] * j[0]) / 12.0;
        own[(q, q)] = (i[1] * i[1] + j[1] * j[1]) / 12.0;
        own[(p, q)] = (i[0] * i[1] + j[0] * j[1]) / 12.0;
        own[(q, p)] = own[(p, q)];
        self.volume += volume;
        self.first += x * volume;
        for (k, (i, j)) in PAIRS.into_iter().enumerate() {
            self.second[k] += (x[i] * x[j] + own[(i, j)]) * volume;
        }
    }

    pub(crate) fn add(&mut self, other: &Sums) {
        self.volume += other.volume;
        self.first += other.first;
        for k in 0..6 {
            self.second[k] += other.second[k];
        }
    }

    /// The moments of a body whose integrals are taken about `about`.
    pub(crate) fn moments(&self, about: &Vec3) -> Moments {
        let c = if self.volume != 0.0 { self.first / self.volume } else { Vec3::zeros() };
        let mut second = self.second;
        for (k, (i, j)) in PAIRS.into_iter().enumerate() {
            second[k] -= c[i] * c[j] * self.volume;
        }
        Moments {
            volume: self.volume,
            centroid: about + c,
            inertia: Inertia::from_second_moments(second),
            relative_error: 0.0,
        }
    }
}

/// The order of second moments.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// How the moments of a solid's mesh were found: nothing for the polyhedral integrals, else the
/// lattices of the columns along the three axes.
pub(crate) fn lattices(
    mesh: &Mesh,
    found: &Moments,
    limit: u64,
    run: &Run,
) -> Result<Option<[Lattice; 3]>> {
    let Some((lo, hi)) = bounds(mesh) else {
        return Err(Error::Empty("the mesh has no face".into()));
    };
    let n = if !(mesh.clean || border(mesh)?.is_empty()) {
        if wide_open(mesh, limit, run)? { WIDE_OPEN } else { OPEN }
    } else if of_polyhedron(mesh, &((lo + hi) * 0.5), run).volume == found.volume {
        return Ok(None);
    } else {
        CLOSED
    };
    let of = |axis| lattice(axis, [lo, hi], n, n > OPEN);
    Ok(Some([of(0)?, of(1)?, of(2)?]))
}

/// `n` × `n` columns over the box `lo`, `hi`: slanted, so that faces parallel to an axis are
/// sampled as evenly as others; or straight, and half as many, for open meshes.
fn lattice(axis: usize, [lo, hi]: [Vec3; 2], n: usize, slanted: bool) -> Result<Lattice> {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    if hi[u] <= lo[u] || hi[v] <= lo[v] {
        return Err(Error::ZeroVolume("the mesh is flat: its box has no volume".into()));
    }
    let (a, b) = ([lo[u], lo[v]], [hi[u], hi[v]]);
    Ok(if slanted {
        Lattice::slanted(axis, n, a, b)
    } else {
        Lattice::straight(axis, [n, n], a, [0, 1].map(|k| (b[k] - a[k]) / n as f64))
    })
}

/// Moments from `n` × `n` columns along each axis: the mean of the three, and as error
/// twice their greatest difference from it, at least ½ n^−1.5.
fn by_columns(
    body: &Body,
    [lo, hi]: [Vec3; 2],
    n: usize,
    limit: u64,
    run: &Run,
) -> Result<Moments> {
    let middle = (lo + hi) * 0.5;
    let mut total = Sums::default();
    let mut volumes = [0.0; 3];
    let mut parts = [Sums::default(); 3];
    for axis in 0..3 {
        run.check(0.0, "integrating by columns")?;
        let lattice = lattice(axis, [lo, hi], n, n > OPEN)?;
        let c = Columns::within(body, lattice, limit, 0, run)?;
        let lattice = c.lattice();
        let m = [middle[(axis + 1) % 3], middle[(axis + 2) % 3]];
        let mut sums = Sums::default();
        for b in 0..lattice.dims[1] {
            for a in 0..lattice.dims[0] {
                let [u, v] = lattice.place(a, b);
                for t in c.column(a, b) {
                    sums.column(lattice, [u - m[0], v - m[1]], t.map(|t| t - middle[axis]));
                }
            }
        }
        volumes[axis] = sums.volume;
        parts[axis] = sums;
        total.add(&sums);
    }
    total.volume /= 3.0;
    total.first /= 3.0;
    total.second = total.second.map(|s| s / 3.0);
    if total.volume <= 0.0 {
        return Err(Error::OpenSurface(
            "the surface encloses nothing: no point has a winding number above ½".into(),
        ));
    }
    let spread = volumes.iter().map(|v| (v - total.volume).abs()).fold(0.0, f64::max);
    if 2.0 * spread / total.volume > UNDEFINED {
        let [x, y, z] = volumes.map(|v| v / total.volume);
        return Err(Error::OpenSurface(format!(
            "the surface is so open that its inside is not defined: columns along x, y, z find \
             {x:.2}, {y:.2}, {z:.2} of their mean volume"
        )));
    }
    let mean = total.moments(&middle);
    let apart = parts.iter().map(|p| difference(&p.moments(&middle), &mean)).fold(0.0, f64::max);
    // Where the outline crosses the lattice at random the three agree to about n^−1.5.
    let relative_error = (2.0 * apart).max(0.5 / (n as f64).powf(1.5));
    Ok(Moments { relative_error, ..mean })
}

/// Integer sums over the cells, so neither order nor size matters, then the cells' own inertia.
fn of_cells(v: &Voxels) -> Result<Moments> {
    let mut n = 0i128;
    let mut first = [0i128; 3];
    let mut second = [0i128; 6];
    let nx = v.dims[0].max(1);
    for (row, cells) in v.cells.chunks(nx).enumerate() {
        let (mut count, mut si, mut sii) = (0i128, 0i128, 0i128);
        for (i, _) in cells.iter().enumerate().filter(|(_, c)| **c != 0) {
            let i = i as i128;
            count += 1;
            si += i;
            sii += i * i;
        }
        let (j, k) = ((row % v.dims[1].max(1)) as i128, (row / v.dims[1].max(1)) as i128);
        n += count;
        let own = [si, count * j, count * k];
        let squares = [sii, count * j * j, count * k * k, si * j, si * k, count * j * k];
        for a in 0..3 {
            first[a] += own[a];
        }
        for a in 0..6 {
            second[a] += squares[a];
        }
    }
    if n == 0 {
        return Err(Error::Empty("no cell is solid".into()));
    }
    let cell = v.spacing.x * v.spacing.y * v.spacing.z;
    let volume = n as f64 * cell;
    let mut m = [0.0; 6];
    for (k, (i, j)) in PAIRS.into_iter().enumerate() {
        let central = (n * second[k] - first[i] * first[j]) as f64 / n as f64;
        let own = if i == j { n as f64 / 12.0 } else { 0.0 };
        m[k] = (central + own) * v.spacing[i] * v.spacing[j] * cell;
    }
    let centroid = Vec3::from_fn(|a, _| (first[a] as f64 / n as f64 + 0.5) * v.spacing[a]);
    Ok(Moments { volume, centroid, inertia: Inertia::from_second_moments(m), relative_error: 0.0 })
}
