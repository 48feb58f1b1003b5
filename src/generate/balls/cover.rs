//! How much of each column a clump covers, inside the target and in all, and what a change of a
//! few balls does to it: only the columns that these balls touch are looked at.

use super::chords::{Row, lengths, single, whole};
use super::dexels::{Dexels, Seen};
use super::piles::{Exchange, Piles};
use super::smooth::Buffers;
use super::tiles::for_tiles;
use crate::error::{Result, filled};

/// Lengths of columns in units of the lattice.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Lengths {
    /// In the clump.
    pub union: f64,
    /// In clump and target.
    pub both: f64,
}

impl Lengths {
    /// D with a target of this length (Buchele et al. 2026, eq 27).
    pub(crate) fn mismatch(&self, target: f64) -> f64 {
        (1.0 - 2.0 * self.both / (self.union + target)).clamp(0.0, 1.0)
    }

    /// The same when clump beyond the target counts `overshoot` times.
    pub(crate) fn weighed(&self, overshoot: f64) -> Lengths {
        Lengths { union: self.union + (overshoot - 1.0) * (self.union - self.both), ..*self }
    }

    /// `w_out |C∖S| − w_in |S∩C|` with the weights that belong to D.
    pub(crate) fn cost(&self, mismatch: f64) -> f64 {
        (1.0 - mismatch) * (self.union - self.both) - (1.0 + mismatch) * self.both
    }

    pub(crate) fn plus(&self, other: &Lengths) -> Lengths {
        Lengths { union: self.union + other.union, both: self.both + other.both }
    }
}

/// A set of columns: runs in rows.
#[derive(Debug, Clone, Default)]
pub(crate) struct Region {
    /// Row, first column, and the one after the last; ascending, apart from each other.
    runs: Vec<[u32; 3]>,
    /// The box around them: lower and upper ends across the columns, along both axes.
    low: [f32; 2],
    high: [f32; 2],
    /// While it is made, a bit for each column of these rows.
    bits: Vec<u64>,
}

/// What each column holds of a clump.
#[derive(Debug, Clone)]
pub(crate) struct Cover {
    columns: Vec<[f32; 2]>,
}

/// A region that is looked at, with buffers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Look {
    pub region: Region,
    /// Balls that change.
    pub exchange: Exchange,
    /// Its columns' new lengths.
    fresh: Vec<[f32; 2]>,
    row: Row,
    order: Vec<u32>,
    /// For the distance between the surfaces.
    pub smooth: Buffers,
}

impl Region {
    /// All columns.
    pub(crate) fn all(&mut self, dexels: &Dexels) {
        let [na, nb] = dexels.dims;
        self.runs.clear();
        self.runs.extend((0..nb as u32).map(|b| [b, 0, na as u32]));
        (self.low, self.high) = ([0.0; 2], [na as f32, nb as f32]);
    }

    /// One column.
    fn one(&mut self, a: usize, b: usize) {
        self.runs.clear();
        self.runs.push([b as u32, a as u32, a as u32 + 1]);
        self.low = [a as f32, b as f32];
        self.high = self.low;
    }

    /// The columns that any of `balls` touches.
    pub(crate) fn of(&mut self, dexels: &Dexels, balls: impl Iterator<Item = Seen> + Clone) {
        (self.low, self.high) = ([f32::MAX; 2], [f32::MIN; 2]);
        self.runs.clear();
        self.bits.clear();
        let words = dexels.dims[0] / 64 + 1;
        for s in balls.clone() {
            for (k, x) in [s.u, s.v].into_iter().enumerate() {
                self.low[k] = self.low[k].min(x - s.r);
                self.high[k] = self.high[k].max(x + s.r);
            }
        }
        let [first, end] = [self.low[1], self.high[1]].map(|v| whole(v, dexels.dims[1]));
        self.bits.resize(words * end.saturating_sub(first), 0);
        for s in balls {
            let [b0, b1] = [s.v - s.r, s.v + s.r].map(|v| whole(v, dexels.dims[1]));
            for b in b0..b1 {
                let y = b as f32 - s.v;
                let half = (s.r * s.r - y * y).max(0.0).sqrt();
                let [a0, a1] = [s.u - half, s.u + half].map(|u| whole(u, dexels.dims[0]));
                if a0 < a1 {
                    let row = words * (b - first);
                    let (from, to) = (a0 / 64, (a1 - 1) / 64);
                    for (k, word) in self.bits[row + from..=row + to].iter_mut().enumerate() {
                        let (low, high) = (64 * (from + k), 64 * (from + k) + 63);
                        let ones = u64::MAX << (a0.max(low) - low);
                        *word |= ones & u64::MAX >> (high - (a1 - 1).min(high));
                    }
                }
            }
        }
        for (b, row) in (first as u32..).zip(self.bits.chunks_exact(words)) {
            // Where a run begins, and where one ends: the bits that differ from those before.
            let (mut before, mut from) = (0, None);
            for (k, &word) in (0u32..).zip(row) {
                let mut changes = word ^ (word << 1 | before);
                before = word >> 63;
                while changes != 0 {
                    let at = 64 * k + changes.trailing_zeros();
                    changes &= changes - 1;
                    match from.take() {
                        None => from = Some(at),
                        Some(from) => self.runs.push([b, from, at]),
                    }
                }
            }
        }
    }

    /// Keeps every `step`th row.
    pub(crate) fn thin(&mut self, step: u32) {
        if step > 1 {
            self.runs.retain(|r| r[0].is_multiple_of(step));
        }
    }

    /// Numbers of its rows.
    pub(crate) fn rows(&self) -> impl Iterator<Item = usize> {
        self.runs.chunk_by(|x, y| x[0] == y[0]).filter_map(|r| r.first()).map(|r| r[0] as usize)
    }

    /// Rows with a run of columns.
    pub(crate) fn runs(&self) -> impl Iterator<Item = (usize, [usize; 2])> {
        self.runs.iter().map(|&[b, from, to]| (b as usize, [from as usize, to as usize]))
    }

    /// Whether a ball's box may meet it.
    pub(crate) fn may_meet(&self, s: &Seen) -> bool {
        let [u, v] = [s.u, s.v];
        u + s.r >= self.low[0]
            && u - s.r <= self.high[0]
            && v + s.r >= self.low[1]
            && v - s.r <= self.high[1]
    }
}

impl Cover {
    /// Of no ball.
    pub(crate) fn new(dexels: &Dexels) -> Result<Cover> {
        let columns = filled("covered columns", dexels.dims[0] * dexels.dims[1], [0.0; 2])?;
        Ok(Cover { columns })
    }

    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        self.columns.len() as u64 * 8
    }

    /// Takes over what the last [`Look::change`] found.
    pub(crate) fn take(&mut self, dexels: &Dexels, look: &Look) {
        let mut fresh = look.fresh.iter();
        for (b, [from, to]) in look.region.runs() {
            let first = b * dexels.dims[0];
            for (old, new) in self.columns[first + from..first + to].iter_mut().zip(&mut fresh) {
                *old = *new;
            }
        }
    }

    /// Takes over what the last [`Look::exchange`] found.
    fn take_exchange(&mut self, dexels: &Dexels, look: &Look) {
        let mut fresh = look.exchange.fresh.iter();
        for (b, [from, to]) in look.region.runs() {
            let first = b * dexels.dims[0];
            for (old, new) in self.columns[first + from..first + to].iter_mut().zip(&mut fresh) {
                *old = *new;
            }
        }
    }

    /// All columns anew.
    pub(crate) fn whole(&mut self, dexels: &Dexels, balls: &[Seen], look: &mut Look) -> Lengths {
        self.columns.fill([0.0; 2]);
        let lengths = look.change_all(self, dexels, balls);
        self.take(dexels, look);
        lengths
    }

    /// Length of the target in column `c` that is not covered.
    pub(crate) fn missing(&self, dexels: &Dexels, c: usize) -> f32 {
        let inside: f32 = dexels.column(c).iter().map(|i| i[1] - i[0]).sum();
        (inside - self.columns[c][1]).max(0.0)
    }
}

impl Look {
    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        let own = 8 * self.fresh.capacity() + 4 * self.order.capacity();
        let region = 12 * self.region.runs.capacity() + 8 * self.region.bits.capacity();
        (own + region) as u64 + self.row.bytes() + self.exchange.bytes()
    }

    /// What the region's columns would hold if the balls `of` were at the places that `seen` has
    /// for them, less what they hold now.
    pub(crate) fn exchange(
        &mut self,
        cover: &Cover,
        piles: &Piles,
        dexels: &Dexels,
        of: &[u32],
        seen: &[Seen],
    ) -> Lengths {
        self.exchange.set(of, seen);
        piles.change(dexels, &self.region, &mut self.exchange, seen, &cover.columns)
    }

    /// Takes over what the last [`Look::exchange`] found for these balls.
    pub(crate) fn take(
        &mut self,
        cover: &mut Cover,
        piles: &mut Piles,
        dexels: &Dexels,
        seen: &[Seen],
        alone: &mut [Lengths],
    ) {
        cover.take_exchange(dexels, self);
        piles.take(dexels, &self.region, &mut self.exchange, seen, alone);
    }

    /// All balls by their lower ends.
    pub(crate) fn order(&mut self, dexels: &Dexels, balls: &[Seen]) -> &[u32] {
        self.region.all(dexels);
        sort(&mut self.order, &self.region, balls);
        &self.order
    }

    /// What the region's columns would hold of the union of `balls`, less what they hold now.
    pub(crate) fn change(&mut self, cover: &Cover, dexels: &Dexels, balls: &[Seen]) -> Lengths {
        let Look { region, fresh, row, order, .. } = self;
        fresh.clear();
        sort(order, region, balls);
        let mut sum = Lengths::default();
        for (b, [from, to]) in region.runs() {
            row.join(b, [from, to], balls, order);
            let first = b * dexels.dims[0] + from;
            let mut part = [0.0f32; 2];
            for (k, old) in cover.columns[first..first + (to - from)].iter().enumerate() {
                let new = lengths(row.joined(k), dexels.column(first + k));
                part[0] += new[0] - old[0];
                part[1] += new[1] - old[1];
                fresh.push(new);
            }
            sum.union += f64::from(part[0]);
            sum.both += f64::from(part[1]);
        }
        sum
    }

    /// The same for all columns: of many balls only those are looked at that reach the ends of the
    /// union.
    pub(crate) fn change_all(&mut self, cover: &Cover, dexels: &Dexels, balls: &[Seen]) -> Lengths {
        let across = dexels.dims[0];
        self.order(dexels, balls);
        let Look { fresh, row, order, .. } = self;
        fresh.clear();
        fresh.resize(cover.columns.len(), [0.0; 2]);
        for_tiles(dexels.dims, balls, order, 1, &mut |tile| {
            for b in tile.b {
                row.join_part(b, 0, [tile.a.start, tile.a.end], balls, tile.balls);
                for (k, a) in tile.a.clone().enumerate() {
                    let c = a + across * b;
                    fresh[c] = lengths(row.joined(k), dexels.column(c));
                }
            }
        });
        let mut sum = Lengths::default();
        let rows = fresh.chunks(across.max(1)).zip(cover.columns.chunks(across.max(1)));
        for (new, old) in rows {
            let mut part = [0.0f32; 2];
            for (new, old) in new.iter().zip(old) {
                part[0] += new[0] - old[0];
                part[1] += new[1] - old[1];
            }
            sum.union += f64::from(part[0]);
            sum.both += f64::from(part[1]);
        }
        sum
    }

    /// Adds `sign` times what each ball alone covers in the region's columns.
    pub(crate) fn alone(
        &mut self,
        dexels: &Dexels,
        balls: &[Seen],
        sign: f64,
        out: &mut [Lengths],
    ) {
        let Look { region, row, order, .. } = self;
        sort(order, region, balls);
        for (b, [from, to]) in region.runs() {
            row.cut(b, [from, to], balls, order);
            let first = b * dexels.dims[0] + from;
            for k in 0..to - from {
                let inside = dexels.column(first + k);
                single(row.single(k).iter().copied(), |ball, lo, hi| {
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
    pub(crate) fn gaps(
        &mut self,
        dexels: &Dexels,
        [a, b]: [usize; 2],
        balls: &[Seen],
        out: &mut Vec<[f32; 2]>,
    ) {
        out.clear();
        self.region.one(a, b);
        sort(&mut self.order, &self.region, balls);
        self.row.join(b, [a, a + 1], balls, &self.order);
        for i in dexels.column(a + dexels.dims[0] * b) {
            let mut low = i[0];
            for &[lo, hi] in self.row.joined(0) {
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

#[cfg(test)]
#[path = "cover_tests.rs"]
mod tests;
