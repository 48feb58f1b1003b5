//! Crossings of columns with triangles, and the intervals of closed meshes.
//!
//! Every row of columns cuts an edge in one place, worked out from the edge
//! alone with its lower end first, so both faces of an edge see the same place
//! to the last bit. A face covers the columns from the place of its falling
//! edge to that of its rising one. On a closed mesh these runs telescope: each
//! column is entered as often as it is left, whatever the rounding, also
//! through edges and vertices. Ties are those of a column shifted by (ε, ε²).

use super::{BAND, Band, Lattice, empty_band, map_bands, push};
use crate::error::{Error, Result, filled, reserve};
use crate::run::Pool;
use crate::shape::Mesh;

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

/// Crossings of one band: 2^26 of them take a GiB.
const MOST_CROSSINGS: usize = 1 << 26;

/// The faces that may cross each band of rows.
pub(super) struct Binned<'a> {
    mesh: &'a Mesh,
    lattice: Lattice,
    vertices: Vec<Turned>,
    starts: Vec<usize>,
    faces: Vec<u32>,
}

/// A vertex on the lattice.
struct Turned {
    /// Both lattice coordinates, and along the column.
    at: [f64; 3],
    /// Number of columns, and of rows, below it.
    below: [u32; 2],
}

impl<'a> Binned<'a> {
    pub(super) fn new(mesh: &'a Mesh, lattice: &Lattice) -> Result<Self> {
        let mut vertices = reserve("vertices on the lattice", mesh.vertices.len())?;
        vertices.extend(mesh.vertices.iter().map(|v| {
            let at = lattice.turn(v);
            let below = [lattice.below(0, at[0]) as u32, lattice.below(1, at[1]) as u32];
            Turned { at, below }
        }));
        let bands = lattice.dims[1].div_ceil(BAND);
        // Bands of a face, from its rows: those at or above its lowest vertex and below its
        // highest. A face between two rows or two columns has none.
        let range = |f: usize| {
            let [columns, rows] = extent(mesh, &vertices, f);
            if columns.is_empty() || rows.is_empty() {
                0..0
            } else {
                rows.start as usize / BAND..(rows.end as usize - 1) / BAND + 1
            }
        };
        let mut starts = filled("bands", bands + 1, 0usize)?;
        for f in 0..mesh.faces.len() {
            for b in range(f) {
                starts[b + 1] += 1;
            }
        }
        for b in 0..bands {
            starts[b + 1] += starts[b];
        }
        let mut next = starts.clone();
        let mut faces = filled("faces in bands", starts[bands], 0u32)?;
        for f in 0..mesh.faces.len() {
            for b in range(f) {
                faces[next[b]] = f as u32;
                next[b] += 1;
            }
        }
        Ok(Binned { mesh, lattice: *lattice, vertices, starts, faces })
    }

    /// The crossings of the rows `first..first + rows` (one band), sorted by column and then
    /// along it.
    pub(super) fn crossings(&self, first: usize, rows: usize) -> Result<Vec<Crossing>> {
        let band = first / BAND;
        let mut found = Vec::new();
        for &f in &self.faces[self.starts[band]..self.starts[band + 1]] {
            self.face(f as usize, first, rows, &mut found)?;
        }
        sort(found, rows * self.lattice.dims[0])
    }

    fn face(&self, f: usize, first: usize, rows: usize, out: &mut Vec<Crossing>) -> Result<()> {
        let l = &self.lattice;
        let [p, q, r] = self.mesh.faces[f];
        let p = [p, q, r].map(|v| self.vertices[v as usize].at);
        // Cut places are clamped to the edges, so no column outside these is reached.
        let [_, range] = extent(self.mesh, &self.vertices, f);
        let begin = (range.start as usize).max(first);
        let end = (range.end as usize).min(first + rows);
        for b in begin..end {
            let v = l.at(1, b);
            let (mut rising, mut falling) = (None, None);
            for (from, to) in [(p[0], p[1]), (p[1], p[2]), (p[2], p[0])] {
                if from[1] <= v && v < to[1] {
                    rising = Some(cut(from, to, v));
                } else if to[1] <= v && v < from[1] {
                    falling = Some(cut(to, from, v));
                }
            }
            let (Some(rising), Some(falling)) = (rising, falling) else { continue };
            let (up, down) = (l.below(0, rising[0]), l.below(0, falling[0]));
            // Counter-clockwise on the lattice: the normal points along the column, a way out.
            let (run, turn) = if down < up { (down..up, -1) } else { (up..down, 1) };
            if out.len() + run.len() > MOST_CROSSINGS {
                return Err(Error::MemoryLimit(format!(
                    "columns cross the faces more than {MOST_CROSSINGS} times in {rows} rows"
                )));
            }
            let width = falling[0] - rising[0];
            for a in run {
                // On the row the face is a segment from rising to falling.
                let t = if width != 0.0 {
                    ((l.at(0, a) - rising[0]) / width).clamp(0.0, 1.0)
                } else {
                    0.5
                };
                let at = rising[1] + t * (falling[1] - rising[1]);
                let column = ((b - first) * l.dims[0] + a) as u32;
                push(out, Crossing { column, turn, at })?;
            }
        }
        Ok(())
    }
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

/// Where the edge from `p` up to `q` meets the row `v`: place on the row, and along the column.
fn cut(p: [f64; 3], q: [f64; 3], v: f64) -> [f64; 2] {
    let t = (v - p[1]) / (q[1] - p[1]);
    let along = |k: usize| (p[k] + t * (q[k] - p[k])).clamp(p[k].min(q[k]), p[k].max(q[k]));
    [along(0), along(2)]
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

/// The intervals of a mesh whose directed edges cancel.
pub(super) fn bands(mesh: &Mesh, lattice: &Lattice, pool: &Pool) -> Result<Vec<Band>> {
    let binned = Binned::new(mesh, lattice)?;
    map_bands(lattice, pool, |first, rows| {
        let mut band = empty_band(rows * lattice.dims[0])?;
        let crossings = binned.crossings(first, rows)?;
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
    })
}
