//! Shares of a union by columns that all spheres share.

use super::pile::Pile;
use crate::error::{Result, filled};
use crate::math::Sphere;
use crate::run::Run;
use std::f64::consts::PI;

/// Most columns along the longer side.
const SIDE: f64 = 192.0;
/// Most chords, about: what the work is.
const CHORDS: f64 = 4e6;
/// A sphere of so many steps radius is met by a hundred columns and more.
const RESOLVED: f64 = 6.0;
/// Rows worked on together.
const BAND: usize = 8;
/// Bands between two looks at the caller's cancel.
const GROUP: usize = 16;

/// Columns parallel to z, alike on both sides of the planes x = 0 and y = 0.
pub(super) struct Lattice {
    step: f64,
    /// Rows of columns: those from −`half` to `half`, without a middle one.
    half: usize,
}

impl Lattice {
    /// The lattice over the spheres of a pile.
    pub(super) fn new(pile: &Pile) -> Lattice {
        let reach = |s: &Sphere| s.center.x.abs().max(s.center.y.abs()) + s.radius;
        let extent = pile.spheres.iter().map(reach).fold(0.0, f64::max);
        let area: f64 = pile.spheres.iter().map(|s| PI * s.radius * s.radius).sum();
        let step = (2.0 * extent / SIDE).max((area / CHORDS).sqrt());
        let half = if step > 0.0 { (extent / step).ceil().min(SIDE) as usize } else { 0 };
        Lattice { step, half }
    }

    /// Whether the columns are dense enough for a sphere.
    pub(super) fn resolves(&self, s: &Sphere) -> bool {
        s.radius >= RESOLVED * self.step
    }

    /// Where a row or column is.
    fn at(&self, i: usize) -> f64 {
        (i as f64 - self.half as f64 + 0.5) * self.step
    }

    /// The shares of all spheres that it resolves; what it says of others is of no use.
    pub(super) fn shares(&self, pile: &Pile, run: &Run) -> Result<Vec<f64>> {
        let n = pile.spheres.len();
        let mut sums = filled("shares", n, Sum::default())?;
        if !pile.spheres.iter().any(|s| self.resolves(s)) {
            return filled("shares", n, 0.0);
        }
        let bands = (2 * self.half).div_ceil(BAND);
        for first in (0..bands).step_by(GROUP) {
            run.check(0.2, "sharing the volume among the spheres")?;
            let found = run.pool().map(GROUP.min(bands - first), |b| self.band(pile, first + b));
            for (i, part) in found.into_iter().flatten() {
                let sum = &mut sums[i as usize];
                sum.own += part.own;
                sum.part += part.part;
            }
        }
        let of = |(s, sum): (&Sphere, &Sum)| {
            if sum.own > 0.0 { s.volume() * sum.part / sum.own } else { 0.0 }
        };
        crate::error::collected("shares", pile.spheres.iter().zip(&sums).map(of))
    }

    /// What a band of rows adds to the spheres that it meets.
    fn band(&self, pile: &Pile, band: usize) -> Vec<(u32, Sum)> {
        let mut sums: Vec<(u32, Sum)> = Vec::new();
        let mut chords = Vec::new();
        let mut ends = Vec::new();
        for row in band * BAND..(2 * self.half).min((band + 1) * BAND) {
            let y = self.at(row);
            chords.clear();
            for (i, s) in pile.spheres.iter().enumerate() {
                let left = s.radius * s.radius - (s.center.y - y) * (s.center.y - y);
                if left > 0.0 {
                    let place = sums.len();
                    self.cut(s, left, place as u32, &mut chords);
                    sums.push((i as u32, Sum::default()));
                }
            }
            chords.sort_unstable_by(|a: &Chord, b| a.column.cmp(&b.column).then(a.of.cmp(&b.of)));
            for column in chords.chunk_by(|a, b| a.column == b.column) {
                share(column, &mut ends, &mut sums);
            }
        }
        sums
    }

    /// The chords of a sphere in a row where half its width squared is `left`.
    fn cut(&self, s: &Sphere, left: f64, of: u32, chords: &mut Vec<Chord>) {
        let width = left.sqrt();
        let middle = self.half as f64 - 0.5;
        let from = ((s.center.x - width) / self.step + middle).floor().max(0.0) as usize;
        let to = ((s.center.x + width) / self.step + middle).ceil().max(0.0) as usize;
        for column in from..=to.min((2 * self.half).saturating_sub(1)) {
            let x = self.at(column) - s.center.x;
            let h2 = left - x * x;
            if h2 > 0.0 {
                let (z, h) = (s.center.z, h2.sqrt());
                chords.push(Chord { column: column as u32, of, from: z - h, to: z + h });
            }
        }
    }
}

/// What columns find of a sphere.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    own: f64,
    part: f64,
}

struct Chord {
    column: u32,
    /// Which sum it belongs to.
    of: u32,
    from: f64,
    to: f64,
}

/// Adds one column: with F(z) = ∫ dz / k up to z, a chord has F(to) − F(from).
fn share(column: &[Chord], ends: &mut Vec<(f64, bool, u32)>, sums: &mut [(u32, Sum)]) {
    ends.clear();
    for c in column {
        ends.push((c.from, true, c.of));
        ends.push((c.to, false, c.of));
        sums[c.of as usize].1.own += c.to - c.from;
    }
    ends.sort_unstable_by(|p, q| p.0.total_cmp(&q.0).then(p.2.cmp(&q.2)));
    let (mut f, mut at, mut k) = (0.0, 0.0, 0i64);
    for &(z, begins, of) in ends.iter() {
        if k > 0 {
            f += (z - at) / k as f64;
        }
        at = z;
        k += if begins { 1 } else { -1 };
        sums[of as usize].1.part += if begins { -f } else { f };
    }
}
