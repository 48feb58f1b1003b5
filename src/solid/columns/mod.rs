//! Exact inside intervals along parallel columns: only two axes are sampled,
//! the third is exact. Used for coverage of cells, for moments of meshes that
//! cross themselves, and by every quality figure.

mod cells;
mod holes;
mod open;
mod raster;
mod spheres;

pub(super) use holes::{Cones, border, loose};

use crate::error::{Error, Result, filled, reserve};
use crate::math::{Sphere, Vec3};
use crate::run::{Pool, Run};
use crate::shape::{Body, Mesh, Voxels};
use open::Open;
use raster::Binned;
use spheres::Chords;

/// Parallel columns through a body and the intervals of them that lie inside.
/// The columns run along `axis`; column (a, b) passes through
/// `lattice_origin + (a + ½) step[0]` and `… (b + ½) step[1]` on the other two
/// axes, taken in cyclic order (axis z: x, y; axis x: y, z; axis y: z, x).
#[derive(Debug, Clone)]
pub struct Columns {
    /// Direction of the columns: 0, 1 or 2.
    pub axis: usize,
    /// Number of columns along the other two axes.
    pub dims: [usize; 2],
    /// Lower corner of the lattice on the other two axes.
    pub lattice_origin: [f64; 2],
    /// Distance between columns.
    pub step: [f64; 2],
    /// Column `c = a + dims[0] * b` owns `intervals[starts[c]..starts[c + 1]]`.
    pub starts: Vec<usize>,
    /// Disjoint ascending intervals.
    pub intervals: Vec<[f64; 2]>,
    /// Length of column counted more than once by a signed sum (overlap of a mesh with itself)
    /// or negatively, times the column's area: what the polyhedral integral gets wrong.
    pub miscounted: f64,
    lattice: Lattice,
}

/// Where the columns stand. Lattice coordinates are a linear map of the two sampled axes: the
/// identity, or one that slants the lattice.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lattice {
    pub axis: usize,
    pub dims: [usize; 2],
    pub origin: [f64; 2],
    pub step: [f64; 2],
    /// Sampled axes to lattice coordinates.
    pub map: [[f64; 2]; 2],
    /// And back.
    pub inverse: [[f64; 2]; 2],
}

fn times(m: &[[f64; 2]; 2], x: [f64; 2]) -> [f64; 2] {
    [m[0][0] * x[0] + m[0][1] * x[1], m[1][0] * x[0] + m[1][1] * x[1]]
}

const IDENTITY: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];

impl Lattice {
    /// About `n` × `n` columns in the window `lo..hi` of the two sampled axes, on the square
    /// lattice turned by the angle whose tangent is the golden section and stretched to the
    /// window. The products of the two coordinates of its points are bounded away from zero
    /// (Frolov 1976), so faces parallel to an axis meet it as evenly as any lattice can: the
    /// error of an area falls like log n / n² there instead of like 1 / n.
    pub(crate) fn slanted(axis: usize, n: usize, lo: [f64; 2], hi: [f64; 2]) -> Lattice {
        let tangent = 0.5 * (5f64.sqrt() - 1.0);
        let cos = 1.0 / (1.0 + tangent * tangent).sqrt();
        let sin = tangent * cos;
        let w = [hi[0] - lo[0], hi[1] - lo[1]];
        let map = [[cos / w[0], -sin / w[1]], [sin / w[0], cos / w[1]]];
        let inverse = [[cos * w[0], sin * w[0]], [-sin * w[1], cos * w[1]]];
        let step = 1.0 / n as f64;
        // The window's lower corner in x is (lo, hi), in y (lo, lo); then a shift of no meaning,
        // so that shapes which are symmetric about the window's middle do not meet a symmetric
        // lattice.
        let origin =
            [times(&map, [lo[0], hi[1]])[0] - 0.618 * step, times(&map, lo)[1] - 0.236 * step];
        let side = ((cos + sin) * n as f64).ceil() as usize + 2;
        Lattice { axis, dims: [side, side], origin, step: [step, step], map, inverse }
    }

    /// Columns parallel to the two sampled axes.
    pub(crate) fn straight(
        axis: usize,
        dims: [usize; 2],
        origin: [f64; 2],
        step: [f64; 2],
    ) -> Lattice {
        Lattice { axis, dims, origin, step, map: IDENTITY, inverse: IDENTITY }
    }

    /// Area that a column stands for.
    pub(crate) fn area(&self) -> f64 {
        let m = &self.inverse;
        self.step[0] * self.step[1] * (m[0][0] * m[1][1] - m[0][1] * m[1][0])
    }

    /// Where the column (a, b) meets the plane of the two sampled axes.
    pub(crate) fn place(&self, a: usize, b: usize) -> [f64; 2] {
        times(&self.inverse, [self.at(0, a), self.at(1, b)])
    }

    /// Lattice coordinate `k` (0 or 1) of the column `i`.
    #[inline]
    pub(crate) fn at(&self, k: usize, i: usize) -> f64 {
        // By way of a signed number, which processors convert at once.
        self.origin[k] + (i as i64 as f64 + 0.5) * self.step[k]
    }

    /// Number of columns whose lattice coordinate `k` is less than `x`.
    #[inline]
    pub(crate) fn below(&self, k: usize, x: f64) -> usize {
        self.below_by(k, x, 1.0 / self.step[k])
    }

    /// The same with one over the step, where there are many.
    #[inline]
    pub(crate) fn below_by(&self, k: usize, x: f64, inverse: f64) -> usize {
        let n = self.dims[k];
        // Rounded up, but for whole numbers, which the steps below set right.
        let guess = (x - self.origin[k]) * inverse + 0.5;
        let mut i = if guess > 0.0 { (guess as i64 as usize).min(n) } else { 0 };
        while i > 0 && self.at(k, i - 1) >= x {
            i -= 1;
        }
        while i < n && self.at(k, i) < x {
            i += 1;
        }
        i
    }

    /// One over the distances between columns.
    pub(crate) fn inverse_steps(&self) -> [f64; 2] {
        [1.0 / self.step[0], 1.0 / self.step[1]]
    }

    /// A point as (both lattice coordinates, along the column).
    pub(crate) fn turn(&self, p: &Vec3) -> [f64; 3] {
        let [x, y] = times(&self.map, [p[(self.axis + 1) % 3], p[(self.axis + 2) % 3]]);
        [x, y, p[self.axis]]
    }

    /// The point of column (a, b) at `t` along the axis.
    fn point(&self, a: usize, b: usize, t: f64) -> Vec3 {
        let mut p = Vec3::zeros();
        p[self.axis] = t;
        let [u, v] = self.place(a, b);
        p[(self.axis + 1) % 3] = u;
        p[(self.axis + 2) % 3] = v;
        p
    }
}

/// Rows of columns that are worked on together: fixed, so that results do not
/// depend on the number of threads.
pub(crate) const BAND: usize = 8;

/// The intervals of a band of rows, column after column.
#[derive(Debug, Default)]
pub(crate) struct Band {
    counts: Vec<u32>,
    intervals: Vec<[f64; 2]>,
    /// Miscounted length.
    miscounted: f64,
}

impl Band {
    /// The intervals of each column.
    pub(crate) fn columns(&self) -> impl Iterator<Item = &[[f64; 2]]> {
        let mut rest = self.intervals.as_slice();
        self.counts.iter().map(move |&n| {
            let (column, more) = rest.split_at_checked(n as usize).unwrap_or_default();
            rest = more;
            column
        })
    }
}

impl Columns {
    /// The columns of `body` (unit frame) on the given lattice.
    ///
    /// Meshes whose directed edges cancel (all clean ones): signed crossings, inside where
    /// the winding number is above ½; a column through an edge or a vertex is counted as one
    /// that passes an infinitesimal step beside it. Other meshes: the winding number between
    /// crossings, near holes at a finite number of places. Voxels: runs of cells.
    pub fn new(
        body: &Body,
        axis: usize,
        dims: [usize; 2],
        lattice_origin: [f64; 2],
        step: [f64; 2],
        pool: &Pool,
    ) -> Result<Columns> {
        Columns::on(body, Lattice::straight(axis, dims, lattice_origin, step), pool)
    }

    /// The columns of `body` on any lattice.
    pub(crate) fn on(body: &Body, lattice: Lattice, pool: &Pool) -> Result<Columns> {
        Columns::of(&Rows::of_body(body, lattice, u64::MAX)?, pool)
    }

    /// The same in a run, in no more than `limit` bytes beside the `held` ones.
    pub(crate) fn within(
        body: &Body,
        lattice: Lattice,
        limit: u64,
        held: u64,
        run: &Run,
    ) -> Result<Columns> {
        let rows = Rows::of_body(body, lattice, limit)?;
        // What closed meshes need is less than the mesh.
        if let Source::Open(open) = &rows.source {
            run.count(|c| c.peak_bytes = c.peak_bytes.max(held + open.bytes()));
        }
        Columns::of(&rows, run.pool())
    }

    /// All columns of `rows`.
    pub(crate) fn of(rows: &Rows, pool: &Pool) -> Result<Columns> {
        let lattice = rows.lattice;
        let total = lattice.dims[0] * lattice.dims[1];
        let bands: Result<Vec<Band>> =
            pool.map(rows.bands(), |i| rows.band(i)).into_iter().collect();
        let bands = bands?;
        let mut starts = reserve("columns", total + 1)?;
        let mut intervals =
            reserve("intervals of columns", bands.iter().map(|b| b.intervals.len()).sum())?;
        let (mut sum, mut miscounted) = (0usize, 0.0);
        starts.push(0);
        for band in &bands {
            for &n in &band.counts {
                sum += n as usize;
                starts.push(sum);
            }
            intervals.extend_from_slice(&band.intervals);
            miscounted += band.miscounted;
        }
        miscounted *= lattice.area();
        let Lattice { axis, dims, origin: lattice_origin, step, .. } = lattice;
        Ok(Columns { axis, dims, lattice_origin, step, starts, intervals, miscounted, lattice })
    }

    /// The intervals of column (a, b).
    pub fn column(&self, a: usize, b: usize) -> &[[f64; 2]] {
        let c = a + self.dims[0] * b;
        &self.intervals[self.starts[c]..self.starts[c + 1]]
    }

    /// The point of column (a, b) at `t` along the axis.
    pub fn point(&self, a: usize, b: usize, t: f64) -> Vec3 {
        self.lattice.point(a, b, t)
    }

    /// Length of all intervals times the area of a column: the volume inside, by the midpoint
    /// rule over the two sampled axes.
    pub fn volume(&self) -> f64 {
        self.intervals.iter().map(|i| i[1] - i[0]).sum::<f64>() * self.lattice.area()
    }

    pub(crate) fn lattice(&self) -> &Lattice {
        &self.lattice
    }
}

/// A body, or spheres, made ready for the columns of a lattice, of which bands of rows are cut
/// one by one: what is done with columns need not hold them all.
pub(crate) struct Rows<'a> {
    pub lattice: Lattice,
    source: Source<'a>,
}

enum Source<'a> {
    Cells(&'a Voxels),
    Closed(&'a Mesh, Binned),
    Open(Box<Open<'a>>),
    Spheres(Chords),
}

impl<'a> Rows<'a> {
    /// Of a body, in no more than `limit` bytes.
    pub(crate) fn of_body(body: &'a Body, lattice: Lattice, limit: u64) -> Result<Rows<'a>> {
        check(&lattice)?;
        let source = match body {
            Body::Voxels(voxels) => {
                cells::check(voxels)?;
                Source::Cells(voxels)
            }
            Body::Mesh(mesh) => {
                let border = if mesh.clean { Vec::new() } else { holes::border(mesh)? };
                if border.is_empty() {
                    Source::Closed(mesh, Binned::new(mesh, &lattice, limit)?)
                } else {
                    Source::Open(Box::new(Open::new(mesh, &border, &lattice, limit)?))
                }
            }
        };
        Ok(Rows { lattice, source })
    }

    /// Of the union of `spheres`.
    pub(crate) fn of_spheres(spheres: &[Sphere], lattice: Lattice) -> Result<Rows<'static>> {
        check(&lattice)?;
        Ok(Rows { lattice, source: Source::Spheres(Chords::new(spheres, &lattice)?) })
    }

    /// Number of bands.
    pub(crate) fn bands(&self) -> usize {
        self.lattice.dims[1].div_ceil(BAND)
    }

    /// The columns of band `i`, row after row.
    pub(crate) fn band(&self, i: usize) -> Result<Band> {
        let first = i * BAND;
        let rows = BAND.min(self.lattice.dims[1].saturating_sub(first));
        match &self.source {
            Source::Cells(voxels) => cells::band(voxels, &self.lattice, first, rows),
            Source::Closed(mesh, binned) => raster::band(mesh, binned, first, rows),
            Source::Open(open) => open.band(first, rows),
            Source::Spheres(chords) => chords.band(first, rows),
        }
    }

    /// Bytes that it holds, but for the bands.
    pub(crate) fn bytes(&self) -> u64 {
        match &self.source {
            Source::Cells(_) => 0,
            Source::Closed(_, binned) => binned.bytes(),
            Source::Open(open) => open.bytes(),
            Source::Spheres(chords) => chords.bytes(),
        }
    }
}

/// The number of columns.
fn check(l: &Lattice) -> Result<usize> {
    if l.axis > 2 {
        return Err(Error::InvalidArgument(format!("the axis of columns is {}, not 0–2", l.axis)));
    }
    for k in 0..2 {
        if !(l.step[k].is_normal() && l.step[k] > 0.0 && l.origin[k].is_finite()) {
            return Err(Error::InvalidArgument(format!(
                "the lattice of columns starts at {} with step {}",
                l.origin[k], l.step[k]
            )));
        }
    }
    l.dims[0].checked_mul(l.dims[1]).filter(|&n| n < u32::MAX as usize).ok_or_else(|| {
        Error::TooLarge(format!("{} × {} columns are too many", l.dims[0], l.dims[1]))
    })
}

/// Pushes without aborting when memory is short.
fn push<T>(v: &mut Vec<T>, value: T) -> Result<()> {
    if v.len() == v.capacity() {
        v.try_reserve(v.len().max(256)).map_err(|_| {
            Error::OutOfMemory(format!("no memory for {} crossings of columns", v.len()))
        })?;
    }
    v.push(value);
    Ok(())
}

/// A band without intervals.
fn empty_band(columns: usize) -> Result<Band> {
    Ok(Band { counts: filled("columns", columns, 0)?, ..Band::default() })
}
