//! How much of each cell lies inside and where the middle of that part is: exact for faces that
//! bound the body, by clipping each to the cells that it crosses.
//!
//! Along x, a face with outward normal n_x < 0 begins the inside behind it and one with n_x > 0
//! ends it. A piece of a face in one cell so adds −∫ (1 − u) dA_x to the volume of that cell, with
//! u from 0 to 1 along the cell, and −∫ dA_x to all later cells of the row. First moments go
//! alike. The integrands are quadratic over a plane piece, so the three midpoints of a triangle's
//! edges integrate them exactly.

use super::turned::Turned;
use crate::error::{Result, filled, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::{Body, Mesh, Voxels};
use crate::solid::Grid;
use crate::solid::columns::{Columns, Lattice};

/// Columns to a cell along each axis where the faces do not bound the body.
const COLUMNS: usize = 3;
/// Parts of a cell smaller than this are rounding.
const LEAST: f64 = 1e-7;

/// What of a cell is inside.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// Position in the lattice.
    pub cell: usize,
    /// Share of its volume, 0 to 1.
    pub volume: f64,
    /// Centroid of that, in the frame of the lattice.
    pub center: Vec3,
}

/// The inside of the cells of a lattice.
pub(super) struct Fill {
    /// For each cell, 0: empty, 1: cut by the surface, 2: full.
    pub kind: Vec<u8>,
    /// The cut ones, ascending.
    pub cut: Vec<Part>,
}

pub(super) const CUT: u8 = 1;
pub(super) const FULL: u8 = 2;

/// A convex polygon of up to ten corners, in cells from the lattice's lower corner.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [[f64; 3]; 10],
    len: usize,
}

impl Polygon {
    fn new(corners: &[[f64; 3]]) -> Polygon {
        let mut p = Polygon { corners: [[0.0; 3]; 10], len: 0 };
        corners.iter().for_each(|c| p.push(*c));
        p
    }

    fn push(&mut self, corner: [f64; 3]) {
        if let Some(c) = self.corners.get_mut(self.len) {
            *c = corner;
            self.len += 1;
        }
    }

    fn all(&self) -> &[[f64; 3]] {
        self.corners.get(..self.len).unwrap_or_default()
    }

    /// First and last cell that it crosses along an axis; one where it lies in a plane across.
    fn cells(&self, axis: usize, most: usize) -> std::ops::Range<usize> {
        let along = || self.all().iter().map(|c| c[axis]);
        let low = along().fold(f64::MAX, f64::min).max(0.0) as usize;
        let high = along().fold(0.0f64, f64::max).ceil() as usize;
        low.min(most)..high.max(low + 1).min(most)
    }

    /// What of it lies on the side of the plane `axis` = `at` that `sign` says.
    fn side(&self, axis: usize, at: f64, sign: f64) -> Polygon {
        let mut out = Polygon { corners: self.corners, len: 0 };
        let Some(mut last) = self.all().last().copied() else { return out };
        let mut before = sign * (last[axis] - at);
        for &corner in self.all() {
            let here = sign * (corner[axis] - at);
            if (before < 0.0 && here > 0.0) || (before > 0.0 && here < 0.0) {
                let t = before / (before - here);
                let mut cross = [0, 1, 2].map(|a| last[a] + t * (corner[a] - last[a]));
                cross[axis] = at;
                out.push(cross);
            }
            if here >= 0.0 {
                out.push(corner);
            }
            (last, before) = (corner, here);
        }
        out
    }

    /// What of it lies in the cell `i` along an axis.
    fn within(&self, axis: usize, i: usize) -> Polygon {
        let inside =
            |p: &Polygon, at: f64, sign: f64| p.all().iter().all(|c| sign * (c[axis] - at) >= 0.0);
        let (low, high) = (i as f64, (i + 1) as f64);
        let upper = if inside(self, low, 1.0) { *self } else { self.side(axis, low, 1.0) };
        if inside(&upper, high, -1.0) { upper } else { upper.side(axis, high, -1.0) }
    }
}

/// Sums of a cell: its own volume and first moments, and what goes to all later cells of the row.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    own: [f64; 4],
    later: [f64; 3],
}

/// A layer of cells.
struct Layer {
    nx: usize,
    sums: Vec<Sums>,
}

impl Layer {
    /// The inside begins (`weight` > 0) or ends at the place (u, v, w) in the cell (i, j).
    fn add(&mut self, i: usize, j: usize, weight: f64, [u, v, w]: [f64; 3]) {
        let rest = 1.0 - u;
        if let Some(s) = self.sums.get_mut(i + self.nx * j) {
            for (sum, x) in s.own.iter_mut().zip([rest, 0.5 * (1.0 - u * u), v * rest, w * rest]) {
                *sum += weight * x;
            }
            for (sum, x) in s.later.iter_mut().zip([1.0, v, w]) {
                *sum += weight * x;
            }
        }
    }

    /// A face in layer `k`.
    fn add_face(&mut self, face: &Polygon, k: usize, ny: usize) {
        let slice = face.within(2, k);
        for j in slice.cells(1, ny) {
            let strip = slice.within(1, j);
            for i in strip.cells(0, self.nx) {
                let piece = strip.within(0, i);
                let base = [i as f64, j as f64, k as f64];
                let Some((&a, rest)) = piece.all().split_first() else { continue };
                for pair in rest.windows(2) {
                    let &[b, c] = pair else { continue };
                    let area =
                        0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (c[1] - a[1]) * (b[2] - a[2]));
                    if area == 0.0 {
                        continue;
                    }
                    for (p, q) in [(a, b), (b, c), (c, a)] {
                        let middle = [0, 1, 2].map(|x| 0.5 * (p[x] + q[x]) - base[x]);
                        self.add(i, j, -area / 3.0, middle);
                    }
                }
            }
        }
    }

    /// Calls `found` for each cell of the layer that is not empty: its number, its volume and
    /// centroid, in cells.
    fn cells(&self, mut found: impl FnMut(usize, f64, [f64; 3])) {
        for (j, row) in self.sums.chunks(self.nx.max(1)).enumerate() {
            let mut before = [0.0; 3];
            for (i, s) in row.iter().enumerate() {
                let [a, y, z] = before;
                let volume = s.own[0] + a;
                if volume > LEAST {
                    let first = [s.own[1] + 0.5 * a, s.own[2] + y, s.own[3] + z];
                    found(i + self.nx * j, volume, first.map(|m| (m / volume).clamp(0.0, 1.0)));
                }
                for (b, l) in before.iter_mut().zip(s.later) {
                    *b += l;
                }
            }
        }
    }
}

/// The inside of the cells of `grid`, of cubes, which has empty ones all around the body.
pub(super) fn fill(turned: &Turned, grid: &Grid, limit: u64, run: &Run) -> Result<Fill> {
    let source = match turned.body.as_ref() {
        Body::Mesh(m) if turned.exact => Source::mesh(m, grid)?,
        Body::Voxels(v) => Source::voxels(v, grid)?,
        Body::Mesh(_) => {
            let k = COLUMNS;
            let step = grid.spacing.x / k as f64;
            let dims = [k * grid.dims[1], k * grid.dims[2]];
            let from = [grid.origin.y, grid.origin.z];
            let lattice = Lattice::straight(0, dims, from, [step, step]);
            Source::Columns(Columns::within(&turned.body, lattice, limit, 0, run)?)
        }
    };
    let [nx, ny, _] = grid.dims;
    let mut kind = filled("the cells of the cover", grid.len(), 0u8)?;
    let layers: Vec<Result<Vec<Part>>> = {
        // A layer's own part of the array, and what is cut in it.
        let mut parts: Vec<(&mut [u8], Result<Vec<Part>>)> =
            kind.chunks_mut((nx * ny).max(1)).map(|kind| (kind, Ok(Vec::new()))).collect();
        run.pool().chunks_mut(&mut parts, 1, |k, part| {
            for (kind, cut) in part {
                *cut = source.layer(grid, k, kind);
            }
        });
        parts.into_iter().map(|(_, cut)| cut).collect()
    };
    let mut cut = reserve("the cut cells", layers.iter().flatten().map(Vec::len).sum())?;
    for layer in layers {
        cut.extend(layer?);
    }
    Ok(Fill { kind, cut })
}

/// What says where the inside begins and ends.
enum Source {
    /// Faces, and for each layer the numbers of those that it meets.
    Faces(Vec<Polygon4>, Vec<u32>, Vec<u32>),
    Columns(Columns),
}

/// A face of three or four corners, in cells.
type Polygon4 = ([[f64; 3]; 4], usize);

impl Source {
    fn mesh(mesh: &Mesh, grid: &Grid) -> Result<Source> {
        let mut faces = reserve("the faces of the body", mesh.faces.len())?;
        for i in 0..mesh.faces.len() {
            let [a, b, c] = mesh.corners(i).map(|p| place(grid, &p));
            faces.push(([a, b, c, c], 3));
        }
        Source::faces(faces, grid)
    }

    /// Faces across x between solid and empty cells.
    fn voxels(v: &Voxels, grid: &Grid) -> Result<Source> {
        let mut faces = Vec::new();
        let h = v.spacing;
        for (row, cells) in v.cells.chunks(v.dims[0].max(1)).enumerate() {
            let (j, k) = ((row % v.dims[1].max(1)) as f64, (row / v.dims[1].max(1)) as f64);
            let mut before = 0;
            for (i, &here) in cells.iter().chain([&0]).enumerate() {
                if (here != 0) != (before != 0) {
                    let at = |y: f64, z: f64| {
                        place(grid, &Vec3::new(i as f64 * h.x, (j + y) * h.y, (k + z) * h.z))
                    };
                    let mut corners = [at(0.0, 0.0), at(0.0, 1.0), at(1.0, 1.0), at(1.0, 0.0)];
                    if here == 0 {
                        corners.reverse();
                    }
                    crate::error::push("the faces of the body", &mut faces, (corners, 4))?;
                }
                before = here;
            }
        }
        Source::faces(faces, grid)
    }

    fn faces(faces: Vec<Polygon4>, grid: &Grid) -> Result<Source> {
        let nz = grid.dims[2];
        let layers = |(corners, n): &Polygon4| {
            corners.get(..*n).map_or(0..0, |c| Polygon::new(c).cells(2, nz))
        };
        let mut starts = filled("the faces of layers", nz + 1, 0u32)?;
        for face in &faces {
            for k in layers(face) {
                if let Some(s) = starts.get_mut(k + 1) {
                    *s += 1;
                }
            }
        }
        for k in 0..nz {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut list = filled("the faces of layers", starts[nz] as usize, 0u32)?;
        for (f, face) in faces.iter().enumerate() {
            for k in layers(face) {
                if let Some(place) = list.get_mut(next[k] as usize) {
                    *place = f as u32;
                    next[k] += 1;
                }
            }
        }
        Ok(Source::Faces(faces, starts, list))
    }

    /// The cells of layer `k`: their kinds, and those that are cut.
    fn layer(&self, grid: &Grid, k: usize, kind: &mut [u8]) -> Result<Vec<Part>> {
        let nx = grid.dims[0];
        let sums = filled("a layer of cells", kind.len(), Sums::default())?;
        let mut layer = Layer { nx, sums };
        self.add(&mut layer, grid, k);
        let mut cut = Vec::new();
        layer.cells(|n, volume, center| {
            let full = volume > 1.0 - LEAST;
            if let Some(kind) = kind.get_mut(n) {
                *kind = if full { FULL } else { CUT };
            }
            if !full {
                let lower = Vec3::new((n % nx) as f64, (n / nx) as f64, k as f64);
                let center = grid.origin + (lower + Vec3::from(center)) * grid.spacing.x;
                cut.push(Part { cell: n + kind.len() * k, volume, center });
            }
        });
        Ok(cut)
    }

    /// All that meets layer `k`.
    fn add(&self, layer: &mut Layer, grid: &Grid, k: usize) {
        let ny = grid.dims[1];
        match self {
            Source::Faces(faces, starts, list) => {
                let range = starts[k] as usize..starts[k + 1] as usize;
                for &f in list.get(range).unwrap_or_default() {
                    if let Some((corners, n)) = faces.get(f as usize) {
                        layer.add_face(&Polygon::new(&corners[..*n]), k, ny);
                    }
                }
            }
            Source::Columns(columns) => {
                let m = COLUMNS;
                let weight = 1.0 / (m * m) as f64;
                let within = |n: usize| (n as f64 + 0.5) / m as f64;
                for (b, a) in (0..m).flat_map(|b| (0..m * ny).map(move |a| (b, a))) {
                    for ends in columns.column(a, m * k + b) {
                        for (x, sign) in ends.iter().zip([1.0, -1.0]) {
                            let x = ((x - grid.origin.x) / grid.spacing.x).max(0.0);
                            let place = [x - x.floor(), within(a % m), within(b)];
                            layer.add(x as usize, a / m, sign * weight, place);
                        }
                    }
                }
            }
        }
    }
}

/// In cells from the lattice's lower corner.
fn place(grid: &Grid, p: &Vec3) -> [f64; 3] {
    ((p - grid.origin) / grid.spacing.x).into()
}

#[cfg(test)]
#[path = "fill_tests.rs"]
mod tests;
