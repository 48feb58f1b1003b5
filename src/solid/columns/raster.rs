//! Crossings of columns with triangles, and the intervals of closed meshes.
//!
//! Every row of columns cuts an edge in one place, worked out from the edge
//! alone with its lower end first, so both faces of an edge see the same place
//! to the last bit. A face covers the columns from the place of its falling
//! edge to that of its rising one. On a closed mesh these runs telescope: each
//! column is entered as often as it is left, whatever the rounding, also
//! through edges and vertices. Ties are those of a column shifted by (ε, ε²).

use super::{BAND, Band, Lattice, empty_band, push};
use crate::error::{Error, Result, filled, fits, reserve};
use crate::shape::Mesh;
use std::mem::size_of;

/// Where a column crosses a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    /// Column within the band.
    pub column: u32,
    /// 1 into the body, −1 out of it.
    pub turn: i32,
    /// Along the column.
    pub at: f64,
}

/// Most crossings of one band: with their sorted copy they take two GiB.
const MOST_CROSSINGS: u64 = 1 << 26;

/// The faces that may cross each band of rows.
pub(super) struct Binned {
    lattice: Lattice,
    vertices: Vec<Turned>,
    starts: Vec<usize>,
    faces: Vec<u32>,
    /// Most crossings of one band.
    most: u64,
}

/// A vertex on the lattice.
struct Turned {
    /// Both lattice coordinates, and along the column.
    at: [f64; 3],
    /// Number of columns, and of rows, below it.
    below: [u32; 2],
}

impl Binned {
    /// The faces of `mesh`, in no more than `limit` bytes.
    pub(super) fn new(mesh: &Mesh, lattice: &Lattice, limit: u64) -> Result<Self> {
        let mut vertices = reserve("vertices on the lattice", mesh.vertices.len())?;
        let inverse = lattice.inverse_steps();
        for v in &mesh.vertices {
            let at = lattice.turn(v);
            let below = lattice.below_by(0, at[0], inverse[0]);
            let below = [below as u32, lattice.below_by(1, at[1], inverse[1]) as u32];
            vertices.push(Turned { at, below });
        }
        let bands = lattice.dims[1].div_ceil(BAND);
        // Bands of a face, from its rows: those at or above its lowest vertex and below its
        // highest. A face between two rows or two columns has none.
        let range = |f: u32| {
            let [_, rows] = extent(mesh, &vertices, f as usize);
            rows.start as usize / BAND..(rows.end as usize - 1) / BAND + 1
        };
        let mut some = filled("faces in bands", mesh.faces.len(), 0u32)?;
        let mut met = 0;
        for f in 0..mesh.faces.len() {
            let [columns, rows] = extent(mesh, &vertices, f);
            some[met] = f as u32;
            // Without a jump: of a fine mesh half of the faces do, no one knows which.
            met += usize::from(!columns.is_empty() & !rows.is_empty());
        }
        some.truncate(met);
        let mut starts = filled("bands", bands + 1, 0usize)?;
        for &f in &some {
            for b in range(f) {
                starts[b + 1] += 1;
            }
        }
        for b in 0..bands {
            starts[b + 1] += starts[b];
        }
        let bytes = bytes(mesh.vertices.len(), bands, starts[bands]);
        let count = mesh.faces.len();
        fits(format_args!("{count} faces in {bands} bands of columns"), bytes, limit)?;
        let mut next = filled("bands", bands + 1, 0usize)?;
        next.copy_from_slice(&starts);
        let mut faces = filled("faces in bands", starts[bands], 0u32)?;
        for &f in &some {
            for b in range(f) {
                faces[next[b]] = f;
                next[b] += 1;
            }
        }
        let most = (limit / (2 * size_of::<Crossing>() as u64)).min(MOST_CROSSINGS);
        Ok(Binned { lattice: *lattice, vertices, starts, faces, most })
    }

    pub(super) fn bytes(&self) -> u64 {
        bytes(self.vertices.len(), self.starts.len(), self.faces.len())
    }

    /// The crossings of `mesh` with the rows `first..first + rows` (one band), sorted by column
    /// and then along it.
    pub(super) fn crossings(
        &self,
        mesh: &Mesh,
        first: usize,
        rows: usize,
    ) -> Result<Vec<Crossing>> {
        let band = first / BAND;
        let mut found = Vec::new();
        for &f in &self.faces[self.starts[band]..self.starts[band + 1]] {
            self.face(mesh, f as usize, first, rows, &mut found)?;
        }
        sort(found, rows * self.lattice.dims[0])
    }

    fn face(
        &self,
        mesh: &Mesh,
        f: usize,
        first: usize,
        rows: usize,
        out: &mut Vec<Crossing>,
    ) -> Result<()> {
        let l = &self.lattice;
        let [p, q, r] = mesh.faces[f];
        let at = |v: u32| &self.vertices[v as usize];
        let (p, q, r) = (at(p), at(q), at(r));
        // Cut places are clamped to the edges, so no column outside these is reached.
        let low = p.below[1].min(q.below[1]).min(r.below[1]) as usize;
        let high = p.below[1].max(q.below[1]).max(r.below[1]) as usize;
        for b in low.max(first)..high.min(first + rows) {
            let v = l.at(1, b);
            let (lower_p, lower_q, lower_r) = (p.at[1] <= v, q.at[1] <= v, r.at[1] <= v);
            // One corner is alone on its side of the row.
            let (before, alone, after, lower) = if lower_p == lower_q {
                (q, r, p, lower_r)
            } else if lower_q == lower_r {
                (r, p, q, lower_p)
            } else {
                (p, q, r, lower_q)
            };
            let [rising, falling] = if lower {
                [Cut { low: alone, high: after }, Cut { low: alone, high: before }]
            } else {
                [Cut { low: before, high: alone }, Cut { low: after, high: alone }]
            };
            let (up, down) = (rising.below(l, v), falling.below(l, v));
            if up == down {
                continue;
            }
            // Counter-clockwise on the lattice: the normal points along the column, a way out.
            let (run, turn) = if down < up { (down..up, -1) } else { (up..down, 1) };
            let count = (out.len() + run.len()) as u64;
            if count > self.most {
                return Err(Error::MemoryLimit(format!(
                    "columns cross the faces {count} times in {rows} rows, more than the {} that \
                     the limit allows",
                    self.most
                )));
            }
            let (from, to) = (
                [rising.along(0, v), rising.along(2, v)],
                [falling.along(0, v), falling.along(2, v)],
            );
            let width = to[0] - from[0];
            for a in run {
                // On the row the face is a segment from rising to falling.
                let t = if width != 0.0 {
                    within((l.at(0, a) - from[0]) / width, 0.0, 1.0)
                } else {
                    0.5
                };
                let at = from[1] + t * (to[1] - from[1]);
                let column = ((b - first) * l.dims[0] + a) as u32;
                push(out, Crossing { column, turn, at })?;
            }
        }
        Ok(())
    }
}

/// Where a row cuts the edge from its lower end to its higher one.
#[derive(Clone, Copy)]
struct Cut<'a> {
    low: &'a Turned,
    high: &'a Turned,
}

impl Cut<'_> {
    /// The place on the row `v` (coordinate 0), or along the column (2).
    #[inline(always)]
    fn along(&self, k: usize, v: f64) -> f64 {
        let (p, q) = (&self.low.at, &self.high.at);
        let t = (v - p[1]) / (q[1] - p[1]);
        let x = p[k] + t * (q[k] - p[k]);
        if p[k] < q[k] { within(x, p[k], q[k]) } else { within(x, q[k], p[k]) }
    }

    /// Number of columns below the place: between those of the ends, which seldom differ.
    #[inline(always)]
    fn below(&self, l: &Lattice, v: f64) -> usize {
        let (p, q) = (self.low.below[0], self.high.below[0]);
        let (least, most) = (p.min(q) as usize, p.max(q) as usize);
        match most - least {
            0 => least,
            1 => least + usize::from(l.at(0, least) < self.along(0, v)),
            _ => l.below(0, self.along(0, v)),
        }
    }
}

/// `x`, no less than `low` and no more than `high`.
#[inline(always)]
fn within(x: f64, low: f64, high: f64) -> f64 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

/// Bytes of so many vertices, bands and faces in bands.
fn bytes(vertices: usize, bands: usize, faces: usize) -> u64 {
    vertices as u64 * size_of::<Turned>() as u64 + 16 * bands as u64 + 4 * faces as u64
}

/// Columns and rows that the face `f` may cross.
fn extent(mesh: &Mesh, vertices: &[Turned], f: usize) -> [std::ops::Range<u32>; 2] {
    let [a, b, c] = mesh.faces[f];
    let [a, b, c] = [&vertices[a as usize], &vertices[b as usize], &vertices[c as usize]];
    let range = |k: usize| {
        let [a, b, c] = [a.below[k], b.below[k], c.below[k]];
        a.min(b).min(c)..a.max(b).max(c)
    };
    [range(0), range(1)]
}

/// Sorted by column (counting sort) and then along the column.
fn sort(found: Vec<Crossing>, columns: usize) -> Result<Vec<Crossing>> {
    let mut starts = filled("columns", columns + 1, 0usize)?;
    for c in &found {
        starts[c.column as usize + 1] += 1;
    }
    for c in 0..columns {
        starts[c + 1] += starts[c];
    }
    let mut sorted = filled("crossings", found.len(), Crossing { column: 0, turn: 0, at: 0.0 })?;
    for c in found {
        let place = &mut starts[c.column as usize];
        sorted[*place] = c;
        *place += 1;
    }
    // `starts[c]` is now the end of column c.
    let mut begin = 0;
    for &end in &starts[..columns] {
        if end - begin > 1 {
            sorted[begin..end].sort_by(|x, y| x.at.total_cmp(&y.at));
        }
        begin = end;
    }
    Ok(sorted)
}

/// The intervals of a mesh whose directed edges cancel, in the rows `first..first + rows`.
pub(super) fn band(mesh: &Mesh, binned: &Binned, first: usize, rows: usize) -> Result<Band> {
    let mut band = empty_band(rows * binned.lattice.dims[0])?;
    let crossings = binned.crossings(mesh, first, rows)?;
    for column in crossings.chunk_by(|x, y| x.column == y.column) {
        let Some(head) = column.first() else { continue };
        let begin = band.intervals.len();
        let (mut winding, mut last) = (0i32, head.at);
        for c in column {
            let length = c.at - last;
            if winding > 0 && length > 0.0 {
                match band.intervals.get_mut(begin..).and_then(|v| v.last_mut()) {
                    Some(previous) if previous[1] == last => previous[1] = c.at,
                    _ => push(&mut band.intervals, [last, c.at])?,
                }
            }
            let counted = winding - i32::from(winding > 0);
            band.miscounted += length * f64::from(counted.abs());
            winding += c.turn;
            last = c.at;
        }
        if let Some(count) = band.counts.get_mut(head.column as usize) {
            *count = (band.intervals.len() - begin) as u32;
        }
    }
    Ok(band)
}
