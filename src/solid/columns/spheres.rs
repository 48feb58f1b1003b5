//! Columns through the union of spheres: exact chords, merged.

use super::{BAND, Band, Columns, Lattice, check, empty_band, map_bands, push};
use crate::error::{Result, filled};
use crate::math::Sphere;
use crate::run::Pool;

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

impl Columns {
    /// The intervals of the columns of `lattice` in the union of `spheres`.
    pub(crate) fn of_spheres(spheres: &[Sphere], lattice: Lattice, pool: &Pool) -> Result<Columns> {
        let total = check(&lattice)?;
        let [i0, i1] = [0, 1].map(|k| [lattice.inverse[0][k], lattice.inverse[1][k]]);
        let form = Form {
            a: i0[0] * i0[0] + i0[1] * i0[1],
            b: i0[0] * i1[0] + i0[1] * i1[1],
            c: i1[0] * i1[0] + i1[1] * i1[1],
        };
        let row = lattice.map[1];
        let reach = (row[0] * row[0] + row[1] * row[1]).sqrt();
        let mut seen = crate::error::reserve("spheres", spheres.len())?;
        seen.extend(
            spheres.iter().map(|s| Seen { center: lattice.turn(&s.center), radius: s.radius }),
        );
        // Which spheres reach into each band of rows.
        let rows = |s: &Seen| {
            let y = s.center[1];
            lattice.below(1, y - reach * s.radius)..lattice.below(1, y + reach * s.radius)
        };
        let mut bins: Vec<Vec<u32>> = filled("bands", lattice.dims[1].div_ceil(BAND), Vec::new())?;
        for (i, s) in seen.iter().enumerate() {
            let rows = rows(s);
            if !rows.is_empty() {
                for bin in &mut bins[rows.start / BAND..(rows.end - 1) / BAND + 1] {
                    push(bin, i as u32)?;
                }
            }
        }
        let bands = map_bands(&lattice, pool, |first, count| {
            let mut chords = Vec::new();
            for &i in &bins[first / BAND] {
                let s = &seen[i as usize];
                let rows = rows(s);
                for b in rows.start.max(first)..rows.end.min(first + count) {
                    chords_of_row(
                        s,
                        &form,
                        &lattice,
                        b,
                        (b - first) * lattice.dims[0],
                        &mut chords,
                    )?;
                }
            }
            merge(chords, count * lattice.dims[0])
        })?;
        Columns::gather(bands, lattice, total)
    }
}

/// A chord: column within the band, and its ends.
type Chord = (u32, [f64; 2]);

fn chords_of_row(
    s: &Seen,
    form: &Form,
    lattice: &Lattice,
    b: usize,
    base: usize,
    out: &mut Vec<Chord>,
) -> Result<()> {
    let y = lattice.at(1, b) - s.center[1];
    let r2 = s.radius * s.radius;
    let middle = -form.b * y / form.a;
    let half2 = middle * middle - (form.c * y * y - r2) / form.a;
    if half2 <= 0.0 {
        return Ok(());
    }
    let (middle, half) = (s.center[0] + middle, half2.sqrt());
    for a in lattice.below(0, middle - half)..lattice.below(0, middle + half) {
        let x = lattice.at(0, a) - s.center[0];
        let h2 = r2 - (form.a * x * x + 2.0 * form.b * x * y + form.c * y * y);
        if h2 > 0.0 {
            let h = h2.sqrt();
            push(out, ((base + a) as u32, [s.center[2] - h, s.center[2] + h]))?;
        }
    }
    Ok(())
}

/// The chords of each column sorted and joined where they touch.
fn merge(chords: Vec<Chord>, columns: usize) -> Result<Band> {
    let mut band = empty_band(columns)?;
    let mut starts = filled("columns", columns + 1, 0usize)?;
    for c in &chords {
        starts[c.0 as usize + 1] += 1;
    }
    for c in 0..columns {
        starts[c + 1] += starts[c];
    }
    let mut sorted = filled("chords", chords.len(), [0.0; 2])?;
    for c in chords {
        let place = &mut starts[c.0 as usize];
        sorted[*place] = c.1;
        *place += 1;
    }
    let mut begin = 0;
    for (&end, count) in starts.iter().zip(&mut band.counts) {
        let column = &mut sorted[begin..end];
        column.sort_unstable_by(|x, y| x[0].total_cmp(&y[0]).then(x[1].total_cmp(&y[1])));
        let first = band.intervals.len();
        for &c in column.iter() {
            match band.intervals.get_mut(first..).and_then(|v| v.last_mut()) {
                Some(last) if c[0] <= last[1] => last[1] = last[1].max(c[1]),
                _ => push(&mut band.intervals, c)?,
            }
        }
        *count = (band.intervals.len() - first) as u32;
        begin = end;
    }
    Ok(band)
}
