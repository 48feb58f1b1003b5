//! Columns through the union of spheres: exact chords, merged.

use super::{BAND, Band, Lattice, empty_band, push};
use crate::error::{Result, filled, reserve};
use crate::math::Sphere;
use std::mem::size_of;
use std::ops::Range;

/// About so many chords are sorted at once.
const AT_ONCE: usize = 1 << 18;

/// A sphere seen along the columns: an ellipse of the lattice.
struct Seen {
    /// Centre in lattice coordinates and along the column.
    center: [f64; 3],
    radius: f64,
}

/// Squared distance from the axis of a column at lattice offset (x, y):
/// `a x² + 2 b x y + c y²`.
struct Form {
    a: f64,
    b: f64,
    c: f64,
}

/// The spheres made ready for the columns of a lattice.
pub(super) struct Chords {
    lattice: Lattice,
    seen: Vec<Seen>,
    form: Form,
    /// Which spheres reach into each band of rows.
    bins: Vec<Vec<u32>>,
}

impl Chords {
    pub(super) fn new(spheres: &[Sphere], lattice: &Lattice) -> Result<Chords> {
        let [i0, i1] = [0, 1].map(|k| [lattice.inverse[0][k], lattice.inverse[1][k]]);
        let form = Form {
            a: i0[0] * i0[0] + i0[1] * i0[1],
            b: i0[0] * i1[0] + i0[1] * i1[1],
            c: i1[0] * i1[0] + i1[1] * i1[1],
        };
        // Rows that a length across the columns reaches over.
        let row = lattice.map[1];
        let reach = (row[0] * row[0] + row[1] * row[1]).sqrt();
        let mut seen = reserve("spheres", spheres.len())?;
        seen.extend(
            spheres.iter().map(|s| Seen { center: lattice.turn(&s.center), radius: s.radius }),
        );
        let bins = filled("bands", lattice.dims[1].div_ceil(BAND), Vec::new())?;
        let mut chords = Chords { lattice: *lattice, seen, form, bins };
        for (i, s) in chords.seen.iter().enumerate() {
            let y = s.center[1];
            let rows =
                lattice.below(1, y - reach * s.radius)..lattice.below(1, y + reach * s.radius);
            if !rows.is_empty() {
                for bin in &mut chords.bins[rows.start / BAND..(rows.end - 1) / BAND + 1] {
                    push(bin, i as u32)?;
                }
            }
        }
        Ok(chords)
    }

    pub(super) fn bytes(&self) -> u64 {
        let bins = self.bins.iter().map(|b| b.capacity() * 4 + size_of::<Vec<u32>>());
        (self.seen.len() * size_of::<Seen>() + bins.sum::<usize>()) as u64
    }

    /// The intervals of the rows `first..first + rows` (one band). Chords are made for some
    /// columns at a time, so that deep piles of spheres do not fill the memory.
    pub(super) fn band(&self, first: usize, rows: usize) -> Result<Band> {
        let columns = self.lattice.dims[0];
        let mut band = empty_band(rows * columns)?;
        let mut spans: Vec<(Range<usize>, &Seen)> = Vec::new();
        let (mut chords, mut work) = (Vec::new(), Work::default());
        for (b, counts) in (first..first + rows).zip(band.counts.chunks_mut(columns.max(1))) {
            spans.clear();
            for &i in &self.bins[first / BAND] {
                let s = &self.seen[i as usize];
                let span = self.span(s, b);
                if !span.is_empty() {
                    push(&mut spans, (span, s))?;
                }
            }
            let tile = (AT_ONCE / spans.len().max(1)).max(1);
            for (t, counts) in counts.chunks_mut(tile).enumerate() {
                chords.clear();
                let begin = t * tile;
                for (span, s) in &spans {
                    let from = span.start.max(begin);
                    for a in from..span.end.min(begin + counts.len()) {
                        if let Some(chord) = self.chord(s, a, b) {
                            push(&mut chords, ((a - begin) as u32, chord))?;
                        }
                    }
                }
                merge(&chords, counts, &mut work, &mut band.intervals)?;
            }
        }
        Ok(band)
    }

    /// The columns of row `b` that may meet a sphere.
    fn span(&self, s: &Seen, b: usize) -> Range<usize> {
        let y = self.lattice.at(1, b) - s.center[1];
        let middle = -self.form.b * y / self.form.a;
        let half2 = middle * middle - (self.form.c * y * y - s.radius * s.radius) / self.form.a;
        if half2 <= 0.0 {
            return 0..0;
        }
        let (middle, half) = (s.center[0] + middle, half2.sqrt());
        self.lattice.below(0, middle - half)..self.lattice.below(0, middle + half)
    }

    fn chord(&self, s: &Seen, a: usize, b: usize) -> Option<[f64; 2]> {
        let x = self.lattice.at(0, a) - s.center[0];
        let y = self.lattice.at(1, b) - s.center[1];
        let f = &self.form;
        let h2 = s.radius * s.radius - (f.a * x * x + 2.0 * f.b * x * y + f.c * y * y);
        let h = if h2 > 0.0 { h2.sqrt() } else { return None };
        Some([s.center[2] - h, s.center[2] + h])
    }
}

/// Buffers of [`merge`].
#[derive(Default)]
struct Work {
    starts: Vec<usize>,
    sorted: Vec<[f64; 2]>,
}

/// Appends the chords (column, ends) of each column, sorted and joined where they touch, and
/// counts them.
fn merge(
    chords: &[(u32, [f64; 2])],
    counts: &mut [u32],
    work: &mut Work,
    out: &mut Vec<[f64; 2]>,
) -> Result<()> {
    let Work { starts, sorted } = work;
    clear(starts, counts.len() + 1, 0)?;
    for c in chords {
        starts[c.0 as usize + 1] += 1;
    }
    for c in 0..counts.len() {
        starts[c + 1] += starts[c];
    }
    clear(sorted, chords.len(), [0.0; 2])?;
    for c in chords {
        let place = &mut starts[c.0 as usize];
        sorted[*place] = c.1;
        *place += 1;
    }
    let mut begin = 0;
    for (&end, count) in starts.iter().zip(counts) {
        let column = &mut sorted[begin..end];
        column.sort_unstable_by(|x, y| x[0].total_cmp(&y[0]).then(x[1].total_cmp(&y[1])));
        let first = out.len();
        for &c in column.iter() {
            match out.get_mut(first..).and_then(|v| v.last_mut()) {
                Some(last) if c[0] <= last[1] => last[1] = last[1].max(c[1]),
                _ => push(out, c)?,
            }
        }
        *count = (out.len() - first) as u32;
        begin = end;
    }
    Ok(())
}

/// Makes `v` so long, all `value`.
fn clear<T: Copy>(v: &mut Vec<T>, len: usize, value: T) -> Result<()> {
    v.clear();
    if v.capacity() < len {
        *v = reserve("chords of columns", len)?;
    }
    v.resize(len, value);
    Ok(())
}
