//! Columns through meshes that are open or disagree in orientation: crossings
//! split the column, the winding number decides between them.

use super::holes::Cones;
use super::raster::{Binned, Crossing};
use super::{Band, Lattice, empty_band, push};
use crate::error::Result;
use crate::math::Vec3;
use crate::shape::Mesh;
use crate::solid::winding::Winding;
use std::ops::Range;

/// Places looked at along a column of the box's full height, beside the ends of each piece; over
/// a hole the level ½ may lie between crossings, and an interval shorter than this share of the
/// height may be missed there.
const PLACES: f64 = 12.0;
/// Steps at most that find where the decision changes.
const STEPS: usize = 20;
/// They end where the winding number is so near to ½: the tree's own error is some thousandths.
const CLOSE: f64 = 1e-6;

/// How the winding number is found.
enum Rule {
    /// Crossings of the closed mesh, less the cones that close it.
    Closed(Cones),
    /// The tree over all faces: for soups, whose border is longer than they have faces.
    Tree(Winding),
}

impl Rule {
    /// Whether the piece of column through `p` over which the crossing number is `count` is all
    /// in or all out, when that is certain.
    fn certain(&self, p: &Vec3, axis: usize, from: f64, to: f64, count: i32) -> Option<bool> {
        match self {
            Rule::Closed(cones) => cones.small(p, axis, from, to).then_some(count > 0),
            Rule::Tree(_) => None,
        }
    }

    /// The mesh whose crossings are counted.
    fn crossed<'m>(&'m self, mesh: &'m Mesh) -> &'m Mesh {
        match self {
            Rule::Closed(cones) => &cones.closed,
            Rule::Tree(_) => mesh,
        }
    }

    fn bytes(&self) -> u64 {
        match self {
            Rule::Closed(cones) => cones.bytes(),
            Rule::Tree(tree) => tree.bytes(),
        }
    }

    /// By how much the winding number of `p` exceeds ½: inside where it does.
    fn excess(&self, p: &Vec3, count: i32) -> f64 {
        match self {
            Rule::Closed(cones) => f64::from(count) - cones.at(p) - 0.5,
            Rule::Tree(tree) => tree.at(p) - 0.5,
        }
    }
}

/// A mesh made ready for the columns of a lattice.
pub(super) struct Open<'a> {
    mesh: &'a Mesh,
    lattice: Lattice,
    rule: Rule,
    binned: Binned,
    /// The mesh's box on the lattice, and the columns that it lies across.
    lo: [f64; 3],
    hi: [f64; 3],
    across: Range<usize>,
}

impl<'a> Open<'a> {
    /// `mesh` with its `border`, in no more than `limit` bytes.
    pub(super) fn new(
        mesh: &'a Mesh,
        border: &[[u32; 2]],
        lattice: &Lattice,
        limit: u64,
    ) -> Result<Open<'a>> {
        let (mut lo, mut hi) = ([0.0; 3], [0.0; 3]);
        for (i, v) in mesh.vertices.iter().enumerate() {
            let v = lattice.turn(v);
            for k in 0..3 {
                lo[k] = if i == 0 { v[k] } else { v[k].min(lo[k]) };
                hi[k] = if i == 0 { v[k] } else { v[k].max(hi[k]) };
            }
        }
        let across = lattice.below(0, lo[0])..lattice.below(0, hi[0]);
        let rule = if border.len() < mesh.faces.len() {
            Rule::Closed(Cones::new(mesh, border, limit)?)
        } else {
            Rule::Tree(Winding::within(mesh, limit)?)
        };
        let room = limit.saturating_sub(rule.bytes());
        let binned = Binned::new(rule.crossed(mesh), lattice, room)?;
        Ok(Open { mesh, lattice: *lattice, rule, binned, lo, hi, across })
    }

    pub(super) fn bytes(&self) -> u64 {
        self.rule.bytes() + self.binned.bytes()
    }

    /// The intervals of the rows `first..first + rows`.
    pub(super) fn band(&self, first: usize, rows: usize) -> Result<Band> {
        let (lattice, lo, hi) = (&self.lattice, &self.lo, &self.hi);
        let mut band = empty_band(rows * lattice.dims[0])?;
        let crossings = self.binned.crossings(self.rule.crossed(self.mesh), first, rows)?;
        let mut rest = crossings.as_slice();
        for b in first..first + rows {
            if !(lo[1]..=hi[1]).contains(&lattice.at(1, b)) {
                continue;
            }
            for a in self.across.clone() {
                let column = (b - first) * lattice.dims[0] + a;
                let skip = rest.iter().take_while(|c| (c.column as usize) < column).count();
                rest = rest.get(skip..).unwrap_or_default();
                let here = rest.iter().take_while(|c| c.column as usize == column).count();
                let crossings = rest.get(..here).unwrap_or_default();
                let begin = band.intervals.len();
                let foot = lattice.point(a, b, 0.0);
                let ends = [lo[2], hi[2]];
                cut(&self.rule, lattice.axis, &foot, crossings, ends, &mut band.intervals)?;
                if let Some(count) = band.counts.get_mut(column) {
                    *count = (band.intervals.len() - begin) as u32;
                }
            }
        }
        Ok(band)
    }
}

/// The intervals of the column through `foot`.
fn cut(
    rule: &Rule,
    axis: usize,
    foot: &Vec3,
    crossings: &[Crossing],
    [low, high]: [f64; 2],
    out: &mut Vec<[f64; 2]>,
) -> Result<()> {
    let begin = out.len();
    let (mut last, mut count) = (low, 0);
    let ends = crossings.iter().map(|c| (c.at, c.turn)).chain([(high, 0)]);
    for (end, turn) in ends {
        if end > last {
            match rule.certain(foot, axis, last, end, count) {
                Some(true) => extend(out, begin, [last, end])?,
                Some(false) => {}
                None => {
                    let excess = |t: f64| {
                        let mut p = *foot;
                        p[axis] = t;
                        rule.excess(&p, count)
                    };
                    let sure = |t: f64| rule.certain(foot, axis, t, t, count);
                    piece([last, end], high - low, &excess, &sure, begin, out)?;
                }
            }
            last = end;
        }
        count += turn;
    }
    Ok(())
}

/// The inside part of a piece of column that no face crosses: where `excess` is positive. It is
/// only worked out where it is not `sure`, and at both ends of what holds a change.
fn piece(
    [from, to]: [f64; 2],
    height: f64,
    excess: &impl Fn(f64) -> f64,
    sure: &impl Fn(f64) -> Option<bool>,
    begin: usize,
    out: &mut Vec<[f64; 2]>,
) -> Result<()> {
    // The ends as well: beside a crossing of what closes a hole the decision goes on.
    let places = (PLACES * (to - from) / height).ceil().clamp(1.0, PLACES);
    let mut start = from;
    let mut before: Option<Place> = None;
    for i in 0..places as usize + 2 {
        let share = ((i as f64 - 0.5) / places).clamp(1e-6, 1.0 - 1e-6);
        let t = from + share * (to - from);
        let now = match sure(t) {
            Some(inside) => Place { t, inside, excess: None },
            None => {
                let value = excess(t);
                Place { t, inside: value > 0.0, excess: Some(value) }
            }
        };
        if let Some(last) = before
            && last.inside != now.inside
        {
            let [x, y] = [last, now].map(|p| [p.t, p.excess.unwrap_or_else(|| excess(p.t))]);
            // The bound and the tree may differ by its error, at ½ itself.
            let change = if (x[1] > 0.0) != (y[1] > 0.0) {
                change(x, y, excess)
            } else {
                0.5 * (x[0] + y[0])
            };
            if last.inside {
                extend(out, begin, [start, change])?;
            }
            start = change;
        }
        before = Some(now);
    }
    if before.is_some_and(|b| b.inside) {
        extend(out, begin, [start, to])?;
    }
    Ok(())
}

/// A place of a column.
#[derive(Clone, Copy)]
struct Place {
    t: f64,
    inside: bool,
    /// By how much its winding number exceeds ½, where that was worked out.
    excess: Option<f64>,
}

/// Where `excess`, which is smooth between the faces, changes its sign between two places: false
/// position, with a smaller value for an end that stays (Anderson and Björck 1973).
fn change(mut x: [f64; 2], mut y: [f64; 2], excess: &impl Fn(f64) -> f64) -> f64 {
    let was = x[1] > 0.0;
    let mut kept = None;
    for _ in 0..STEPS {
        // One value is positive and the other is not, so that they differ.
        let t = x[0] + (y[0] - x[0]) * (x[1] / (x[1] - y[1]));
        let value = excess(t);
        if value.abs() <= CLOSE {
            return t;
        }
        let first = (value > 0.0) == was;
        let (moved, stays) = if first { (&mut x, &mut y) } else { (&mut y, &mut x) };
        if kept == Some(first) {
            let less = 1.0 - value / moved[1];
            stays[1] *= if less > 0.0 { less } else { 0.5 };
        }
        *moved = [t, value];
        kept = Some(first);
    }
    0.5 * (x[0] + y[0])
}

/// Appends an interval of the column that began at `begin`, joined to the last when they touch.
fn extend(out: &mut Vec<[f64; 2]>, begin: usize, piece: [f64; 2]) -> Result<()> {
    match out.get_mut(begin..).and_then(|v| v.last_mut()) {
        Some(previous) if previous[1] == piece[0] => previous[1] = piece[1],
        _ => push(out, piece)?,
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::holes::border;
    use super::super::{Columns, Rows};
    use super::*;
    use crate::run::Pool;
    use crate::shape::{Body, samples};

    /// The winding number is asked for seldom, and the change is where it is.
    #[test]
    fn a_change_is_found_in_few_steps() {
        let forms: [fn(f64) -> f64; 5] = [
            |d| d,
            |d| (8.0 * d).atan() / 3.2,
            |d| 0.3 * d + 4.0 * d * d * d,
            |d| if d > 0.0 { 0.4 * d } else { 5.0 * d },
            |d| 0.5 - 1.0 / (1.0 + (12.0 * d).exp()),
        ];
        for (form, f) in forms.iter().enumerate() {
            for at in [0.013, 0.31, 0.5, 0.777, 0.99] {
                for sign in [1.0, -1.0] {
                    let asked = std::cell::Cell::new(0);
                    let excess = |t: f64| {
                        asked.set(asked.get() + 1);
                        sign * f(t - at)
                    };
                    let mut found = Vec::new();
                    piece([0.0, 1.0], 1.0, &excess, &|_| None, 0, &mut found).unwrap();
                    let change = found[0][if sign > 0.0 { 0 } else { 1 }];
                    assert_eq!(found.len(), 1);
                    assert!((change - at).abs() < 5e-6, "form {form}: {change} for {at}");
                    let steps = asked.get() - PLACES as usize - 2;
                    assert!(steps <= 9, "form {form} at {at}: {steps} steps");
                    // Where the side is known but near the change, it is not asked for.
                    asked.set(0);
                    let sure = |t: f64| ((t - at).abs() > 0.1).then_some((sign * (t - at)) > 0.0);
                    let mut again = Vec::new();
                    piece([0.0, 1.0], 1.0, &excess, &sure, 0, &mut again).unwrap();
                    assert_eq!(again, found);
                    assert!(asked.get() <= steps + 5, "{}", asked.get());
                }
            }
        }
    }

    /// A sphere without the faces whose middle `drop` names.
    fn sphere(drop: impl Fn(&Vec3) -> bool) -> Mesh {
        let mut m = samples::ellipsoid([0.5; 3], [0.45; 3], 16);
        let vertices = &m.vertices;
        m.faces.retain(|f| !drop(&(f.iter().map(|&v| vertices[v as usize]).sum::<Vec3>() / 3.0)));
        Mesh { clean: false, ..m }
    }

    /// Both rules give the inside of the plain winding number.
    #[test]
    fn cones_and_tree_agree_with_the_exact_winding_number() {
        type Drop = fn(&Vec3) -> bool;
        let holes: [Drop; 4] = [
            |_| false,
            |p| p.z > 0.9,
            |p| p.z > 0.7 || (p.x < 0.15),
            |p| (p.x * 13.0).sin() > 0.6 && p.y > 0.2,
        ];
        for (hole, drop) in holes.into_iter().enumerate() {
            let mesh = sphere(drop);
            let border = border(&mesh).unwrap();
            assert_eq!(border.is_empty(), hole == 0);
            let cones = Cones::new(&mesh, &border, u64::MAX).unwrap();
            assert!(super::super::border(&cones.closed).unwrap().is_empty());
            let exact = Winding::new(&mesh).unwrap();
            let body = Body::Mesh(mesh);
            for axis in 0..3 {
                let n = 14;
                let lattice = Lattice::straight(axis, [n, n], [0.0; 2], [1.0 / n as f64; 2]);
                let rows = Rows::of_body(&body, lattice, u64::MAX).unwrap();
                let columns = Columns::of(&rows, &Pool::serial()).unwrap();
                for b in 0..n {
                    for a in 0..n {
                        for k in 0..29 {
                            let t = (f64::from(k) + 0.5) / 29.0;
                            let w = exact.exact(&lattice.point(a, b, t));
                            let by = columns.column(a, b).iter().any(|i| i[0] < t && t < i[1]);
                            // The tree's own error is some thousandths.
                            if (w - 0.5).abs() > 0.01 {
                                assert_eq!(by, w > 0.5, "hole {hole}: {a} {b} {t} {w}");
                            }
                        }
                    }
                }
            }
        }
    }
}
