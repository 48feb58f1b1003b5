//! How much of each column a clump covers, inside the target and in all, and what a change of a
//! few balls does to it: only the columns that these balls touch are looked at.

use super::dexels::{Dexels, Seen};
use crate::error::{Result, filled};

/// Lengths of columns in units of the lattice.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Lengths {
    /// In the clump.
    pub union: f64,
    /// In clump and target.
    pub both: f64,
}

impl Lengths {
    /// D with a target of this length (Buchele et al. 2026, eq 27).
    pub(super) fn mismatch(&self, target: f64) -> f64 {
        (1.0 - 2.0 * self.both / (self.union + target)).clamp(0.0, 1.0)
    }

    /// `w_out |C∖S| − w_in |S∩C|` with the weights that belong to D.
    pub(super) fn cost(&self, mismatch: f64) -> f64 {
        (1.0 - mismatch) * (self.union - self.both) - (1.0 + mismatch) * self.both
    }

    pub(super) fn less(&self, other: &Lengths) -> Lengths {
        Lengths { union: self.union - other.union, both: self.both - other.both }
    }

    pub(super) fn plus(&self, other: &Lengths) -> Lengths {
        Lengths { union: self.union + other.union, both: self.both + other.both }
    }
}

/// A set of columns: for each of some rows, a run.
#[derive(Debug, Clone, Default)]
pub(super) struct Region {
    first: usize,
    runs: Vec<[u32; 2]>,
}

/// Chords of one row of columns, sorted by their lower ends in each column.
#[derive(Debug, Clone, Default)]
struct Row {
    counts: Vec<u32>,
    /// Ends and number of the ball; `most` of them for each column.
    chords: Vec<(f32, f32, u32)>,
    most: usize,
    touching: Vec<u32>,
}

/// What each column holds now.
#[derive(Debug, Clone, Default)]
pub(super) struct Cover {
    columns: Vec<[f32; 2]>,
    /// Of the region that was looked at last, the columns' new lengths.
    fresh: Vec<[f32; 2]>,
    row: Row,
    order: Vec<u32>,
}

impl Region {
    /// All columns.
    pub(super) fn all(&mut self, dexels: &Dexels) {
        self.first = 0;
        self.runs.clear();
        self.runs.resize(dexels.dims[1], [0, dexels.dims[0] as u32]);
    }

    /// The columns that any of `balls` touches.
    pub(super) fn of(&mut self, dexels: &Dexels, balls: impl Iterator<Item = Seen> + Clone) {
        let (mut low, mut high) = (f32::MAX, f32::MIN);
        for s in balls.clone() {
            low = low.min(s.v - s.r);
            high = high.max(s.v + s.r);
        }
        let [low, high] = [low, high + 1.0].map(|v| whole(v, dexels.dims[1]));
        self.first = low;
        self.runs.clear();
        self.runs.resize(high.saturating_sub(low), [u32::MAX, 0]);
        for s in balls {
            let [b0, b1] = [s.v - s.r, s.v + s.r + 1.0].map(|v| whole(v, dexels.dims[1]));
            for b in b0..b1 {
                let y = b as f32 - s.v;
                let q = s.r * s.r - y * y;
                if q > 0.0 {
                    let half = q.sqrt();
                    let run = &mut self.runs[b - low];
                    run[0] = run[0].min(whole(s.u - half, dexels.dims[0]) as u32);
                    run[1] = run[1].max(whole(s.u + half + 1.0, dexels.dims[0]) as u32);
                }
            }
        }
    }

    /// Rows with their runs.
    fn rows(&self) -> impl Iterator<Item = (usize, [usize; 2])> {
        self.runs.iter().enumerate().map(|(k, r)| (self.first + k, r.map(|a| a as usize)))
    }

    /// Whether a ball's box may meet it.
    fn may_meet(&self, s: &Seen) -> bool {
        s.v + s.r >= self.first as f32 && s.v - s.r <= (self.first + self.runs.len()) as f32
    }
}

/// The number rounded up, from 0 to `most`.
#[inline(always)]
fn whole(x: f32, most: usize) -> usize {
    // Towards zero, and one more where something was cut off.
    let down = x.max(0.0).min(most as f32) as usize;
    (down + usize::from((down as f32) < x)).min(most)
}

impl Cover {
    pub(super) fn new(dexels: &Dexels) -> Result<Cover> {
        let columns = filled("covered columns", dexels.dims[0] * dexels.dims[1], [0.0; 2])?;
        Ok(Cover { columns, ..Cover::default() })
    }

    /// What the columns of `region` would hold of the union of `balls`, less what they hold now.
    pub(super) fn change(&mut self, dexels: &Dexels, region: &Region, balls: &[Seen]) -> Lengths {
        let Cover { columns, fresh, row, order } = self;
        fresh.clear();
        sort(order, region, balls);
        let mut sum = Lengths::default();
        for (b, [from, to]) in region.rows() {
            if from >= to {
                continue;
            }
            row.cut(b, [from, to], balls, order);
            let first = b * dexels.dims[0] + from;
            let mut part = [0.0f32; 2];
            for (k, old) in columns[first..first + (to - from)].iter().enumerate() {
                let new = lengths(row.column(k), dexels.column(first + k));
                part[0] += new[0] - old[0];
                part[1] += new[1] - old[1];
                fresh.push(new);
            }
            sum.union += f64::from(part[0]);
            sum.both += f64::from(part[1]);
        }
        sum
    }

    /// Takes over what the last [`Cover::change`] found for this region.
    pub(super) fn take(&mut self, dexels: &Dexels, region: &Region) {
        let mut fresh = self.fresh.iter();
        for (b, [from, to]) in region.rows() {
            if from < to {
                let first = b * dexels.dims[0];
                for (old, new) in self.columns[first + from..first + to].iter_mut().zip(&mut fresh)
                {
                    *old = *new;
                }
            }
        }
    }

    /// All columns anew.
    pub(super) fn whole(&mut self, dexels: &Dexels, balls: &[Seen]) -> Lengths {
        let mut region = Region::default();
        region.all(dexels);
        self.columns.fill([0.0; 2]);
        let lengths = self.change(dexels, &region, balls);
        self.take(dexels, &region);
        lengths
    }

    /// Length of the target in column `c` that is not covered.
    pub(super) fn missing(&self, dexels: &Dexels, c: usize) -> f32 {
        let inside: f32 = dexels.column(c).iter().map(|i| i[1] - i[0]).sum();
        (inside - self.columns[c][1]).max(0.0)
    }

    /// Adds `sign` times what each ball alone covers in the columns of `region`.
    pub(super) fn alone(
        &mut self,
        dexels: &Dexels,
        region: &Region,
        balls: &[Seen],
        sign: f64,
        out: &mut [Lengths],
    ) {
        let Cover { row, order, .. } = self;
        sort(order, region, balls);
        for (b, [from, to]) in region.rows() {
            if from >= to {
                continue;
            }
            row.cut(b, [from, to], balls, order);
            let first = b * dexels.dims[0] + from;
            for k in 0..to - from {
                let inside = dexels.column(first + k);
                single(row.column(k), |ball, lo, hi| {
                    let both: f32 =
                        inside.iter().map(|i| (hi.min(i[1]) - lo.max(i[0])).max(0.0)).sum();
                    let of = &mut out[ball as usize];
                    of.union += sign * f64::from(hi - lo);
                    of.both += sign * f64::from(both);
                });
            }
        }
    }

    /// Parts of column (a, b) inside the target and not in the union of `balls`.
    pub(super) fn gaps(
        &mut self,
        dexels: &Dexels,
        [a, b]: [usize; 2],
        balls: &[Seen],
        out: &mut Vec<[f32; 2]>,
    ) {
        out.clear();
        let region = Region { first: b, runs: vec![[a as u32, a as u32 + 1]] };
        sort(&mut self.order, &region, balls);
        self.row.cut(b, [a, a + 1], balls, &self.order);
        for i in dexels.column(a + dexels.dims[0] * b) {
            let mut low = i[0];
            for &(lo, hi, _) in self.row.column(0) {
                if lo > low && low < i[1] {
                    out.push([low, lo.min(i[1])]);
                }
                low = low.max(hi);
            }
            if low < i[1] {
                out.push([low, i[1]]);
            }
        }
    }
}

/// The balls that may meet the region, by their lower ends.
fn sort(order: &mut Vec<u32>, region: &Region, balls: &[Seen]) {
    order.clear();
    order.extend((0u32..).zip(balls).filter(|(_, s)| region.may_meet(s)).map(|(i, _)| i));
    let low = |i: u32| balls[i as usize].t - balls[i as usize].r;
    order.sort_unstable_by(|&i, &j| low(i).total_cmp(&low(j)).then(i.cmp(&j)));
}

impl Row {
    /// The chords of columns `from..to` of row `b`.
    fn cut(&mut self, b: usize, [from, to]: [usize; 2], balls: &[Seen], order: &[u32]) {
        let Row { counts, chords, most, touching } = self;
        touching.clear();
        touching.extend(order.iter().filter(|&&i| {
            let s = &balls[i as usize];
            (b as f32 - s.v).abs() < s.r && s.u + s.r >= from as f32 && s.u - s.r <= to as f32
        }));
        *most = touching.len();
        counts.clear();
        counts.resize(to - from, 0);
        if chords.len() < *most * (to - from) {
            chords.resize(*most * (to - from), (0.0, 0.0, 0));
        }
        for &i in touching.iter() {
            let s = &balls[i as usize];
            let y = b as f32 - s.v;
            let q = s.r * s.r - y * y;
            let half = q.max(0.0).sqrt();
            let a0 = whole(s.u - half, to).max(from);
            let a1 = whole(s.u + half, to);
            for a in a0..a1 {
                let x = a as f32 - s.u;
                let h2 = q - x * x;
                if h2 <= 0.0 {
                    continue;
                }
                let h = h2.sqrt();
                let (lo, hi) = (s.t - h, s.t + h);
                let k = a - from;
                let column = &mut chords[k * *most..(k + 1) * *most];
                let mut at = counts[k] as usize;
                counts[k] += 1;
                while at > 0 && column[at - 1].0 > lo {
                    column[at] = column[at - 1];
                    at -= 1;
                }
                column[at] = (lo, hi, i);
            }
        }
    }

    /// The chords of the column `from + k`.
    #[inline(always)]
    fn column(&self, k: usize) -> &[(f32, f32, u32)] {
        &self.chords[k * self.most..k * self.most + self.counts[k] as usize]
    }
}

/// Length of the union of `chords`, and of its part in the intervals `inside`.
#[inline(always)]
fn lengths(chords: &[(f32, f32, u32)], inside: &[[f32; 2]]) -> [f32; 2] {
    let mut out = [0.0f32; 2];
    let Some(&(mut lo, mut hi, _)) = chords.first() else { return out };
    let mut add = |lo: f32, hi: f32| {
        out[0] += hi - lo;
        for i in inside {
            out[1] += (hi.min(i[1]) - lo.max(i[0])).max(0.0);
        }
    };
    for &(from, to, _) in &chords[1..] {
        if from <= hi {
            hi = hi.max(to);
        } else {
            add(lo, hi);
            (lo, hi) = (from, to);
        }
    }
    add(lo, hi);
    out
}

/// Calls `f(ball, from, to)` for each part of a column that lies in one chord only.
#[inline(always)]
fn single(chords: &[(f32, f32, u32)], mut f: impl FnMut(u32, f32, f32)) {
    let Some(&(mut at, mut end, mut ball)) = chords.first() else { return };
    // Up to `second` there are two; up to `end`, one: `ball`.
    let mut second = f32::MIN;
    let mut part = |ball: u32, from: f32, to: f32| {
        if from < to {
            f(ball, from, to);
        }
    };
    for &(from, to, i) in &chords[1..] {
        part(ball, at.max(second), from.min(end));
        at = from;
        if to > end {
            (second, end, ball) = (end, to, i);
        } else {
            second = second.max(to);
        }
    }
    part(ball, at.max(second), end);
}

#[cfg(test)]
#[path = "cover_tests.rs"]
mod tests;
