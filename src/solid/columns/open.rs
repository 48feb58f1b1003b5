//! Columns through meshes that are open or disagree in orientation: crossings
//! split the column, the winding number decides between them.

use super::raster::Binned;
use super::{Band, Lattice, empty_band, map_bands, push};
use crate::error::Result;
use crate::run::Pool;
use crate::shape::Mesh;
use crate::solid::winding::Winding;

/// Places looked at along a column of the box's full height; over a hole the level ½ may lie
/// between crossings, and an interval shorter than this share of the height may be missed there.
const PLACES: f64 = 12.0;
/// Halvings that find where the decision changes: to 2^−20 of the distance of two places.
const HALVINGS: usize = 20;

pub(super) fn bands(mesh: &Mesh, lattice: &Lattice, pool: &Pool) -> Result<Vec<Band>> {
    let Some(first) = mesh.vertices.first() else {
        return map_bands(lattice, pool, |_, rows| empty_band(rows * lattice.dims[0]));
    };
    let (mut lo, mut hi) = (lattice.turn(first), lattice.turn(first));
    for v in &mesh.vertices {
        let v = lattice.turn(v);
        for k in 0..3 {
            lo[k] = lo[k].min(v[k]);
            hi[k] = hi[k].max(v[k]);
        }
    }
    let across = lattice.below(0, lo[0])..lattice.below(0, hi[0]);
    let winding = Winding::new(mesh);
    let binned = Binned::new(mesh, lattice)?;
    map_bands(lattice, pool, |first, rows| {
        let mut band = empty_band(rows * lattice.dims[0])?;
        let crossings = binned.crossings(first, rows)?;
        let mut rest = crossings.as_slice();
        for b in first..first + rows {
            if !(lo[1]..=hi[1]).contains(&lattice.at(1, b)) {
                continue;
            }
            for a in across.clone() {
                let column = (b - first) * lattice.dims[0] + a;
                let skip = rest.partition_point(|c| (c.column as usize) < column);
                rest = rest.get(skip..).unwrap_or_default();
                let here = rest.partition_point(|c| c.column as usize == column);
                let begin = band.intervals.len();
                let inside = |t: f64| winding.at(&lattice.point(a, b, t)) > 0.5;
                let mut last = lo[2];
                let ends = rest.iter().take(here).map(|c| c.at).chain([hi[2]]);
                for end in ends {
                    piece(last, end, hi[2] - lo[2], &inside, begin, &mut band.intervals)?;
                    last = end.max(last);
                }
                if let Some(count) = band.counts.get_mut(column) {
                    *count = (band.intervals.len() - begin) as u32;
                }
            }
        }
        Ok(band)
    })
}

/// The inside part of a piece of column that no face crosses.
fn piece(
    from: f64,
    to: f64,
    height: f64,
    inside: &impl Fn(f64) -> bool,
    begin: usize,
    out: &mut Vec<[f64; 2]>,
) -> Result<()> {
    if to <= from {
        return Ok(());
    }
    let places = (PLACES * (to - from) / height).ceil().clamp(1.0, PLACES);
    let step = (to - from) / places;
    let mut start = from;
    let mut before: Option<(f64, bool)> = None;
    for i in 0..places as usize {
        let t = from + (i as f64 + 0.5) * step;
        let now = inside(t);
        if let Some((t0, was)) = before
            && was != now
        {
            let (mut x, mut y) = (t0, t);
            for _ in 0..HALVINGS {
                let m = 0.5 * (x + y);
                if inside(m) == was { x = m } else { y = m }
            }
            let change = 0.5 * (x + y);
            if was {
                extend(out, begin, [start, change])?;
            }
            start = change;
        }
        before = Some((t, now));
    }
    if before.is_some_and(|b| b.1) {
        extend(out, begin, [start, to])?;
    }
    Ok(())
}

/// Appends an interval of the column that began at `begin`, joined to the last when they touch.
fn extend(out: &mut Vec<[f64; 2]>, begin: usize, piece: [f64; 2]) -> Result<()> {
    match out.get_mut(begin..).and_then(|v| v.last_mut()) {
        Some(previous) if previous[1] == piece[0] => previous[1] = piece[1],
        _ => push(out, piece)?,
    }
    Ok(())
}
