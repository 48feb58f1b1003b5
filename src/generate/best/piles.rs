//! All chords of a clump, column by column: when a few balls change, the chords of the others are
//! read instead of made again.

use super::chords::{Row, single};
use super::cover::{Lengths, Region};
use super::dexels::{Dexels, Seen};
use crate::error::{Result, filled};

/// Lower end, upper end, number of the ball.
pub(super) type Chord = (f32, f32, u32);

/// The chords of each column by their lower ends.
#[derive(Debug, Clone)]
pub(super) struct Piles {
    columns: Vec<Vec<Chord>>,
}

/// Balls that change: numbers and new places, and a mark on each of their numbers.
#[derive(Debug, Default, Clone)]
pub(super) struct Exchange {
    numbers: Vec<u32>,
    seen: Vec<Seen>,
    order: Vec<u32>,
    marked: Vec<bool>,
    row: Row,
    /// The columns' new lengths, run after run of the region.
    pub fresh: Vec<[f32; 2]>,
}

impl Exchange {
    /// The balls `of` of `n` are at the places that `seen` has for them.
    pub(super) fn set(&mut self, of: &[u32], seen: &[Seen]) {
        for &j in &self.numbers {
            if let Some(mark) = self.marked.get_mut(j as usize) {
                *mark = false;
            }
        }
        self.marked.resize(seen.len(), false);
        self.numbers.clear();
        self.numbers.extend(of);
        self.seen.clear();
        self.seen.extend(of.iter().map(|&j| seen[j as usize]));
        of.iter().for_each(|&j| self.marked[j as usize] = true);
        self.order.clear();
        self.order.extend(0..of.len() as u32);
        let low = |i: u32| self.seen[i as usize].t - self.seen[i as usize].r;
        self.order.sort_unstable_by(|&i, &j| low(i).total_cmp(&low(j)).then(i.cmp(&j)));
    }
}

impl Piles {
    /// Of no ball.
    pub(super) fn new(dexels: &Dexels) -> Result<Piles> {
        let n = dexels.dims[0] * dexels.dims[1];
        Ok(Piles { columns: filled("chords of columns", n, Vec::new())? })
    }

    /// All columns anew; `order`: the balls by their lower ends.
    pub(super) fn fill(&mut self, dexels: &Dexels, balls: &[Seen], order: &[u32]) {
        let mut row = Row::default();
        let across = dexels.dims[0];
        for (b, columns) in self.columns.chunks_mut(across.max(1)).enumerate() {
            row.cut(b, [0, across], balls, order);
            for (k, column) in columns.iter_mut().enumerate() {
                column.clear();
                column.extend_from_slice(row.single(k));
            }
        }
    }

    /// What the region's columns hold after the exchange, less `now`.
    pub(super) fn change(
        &self,
        dexels: &Dexels,
        region: &Region,
        exchange: &mut Exchange,
        now: &[[f32; 2]],
    ) -> Lengths {
        let Exchange { seen, order, marked, row, fresh, .. } = exchange;
        fresh.clear();
        let mut sum = Lengths::default();
        for (b, [from, to]) in region.runs() {
            row.cut(b, [from, to], seen, order);
            let first = b * dexels.dims[0] + from;
            let mut part = [0.0f32; 2];
            for k in 0..to - from {
                let c = first + k;
                let mut lengths = Union::new(dexels.column(c));
                merge(&self.columns[c], marked, row.single(k), |(lo, hi, _)| lengths.add(lo, hi));
                let (new, old) = (lengths.end(), now[c]);
                part[0] += new[0] - old[0];
                part[1] += new[1] - old[1];
                fresh.push(new);
            }
            sum.union += f64::from(part[0]);
            sum.both += f64::from(part[1]);
        }
        sum
    }

    /// Takes the exchange over, and keeps the books of what each ball covers alone.
    pub(super) fn take(
        &mut self,
        dexels: &Dexels,
        region: &Region,
        exchange: &mut Exchange,
        alone: &mut [Lengths],
    ) {
        let Exchange { numbers, seen, order, marked, row, .. } = exchange;
        let mut merged: Vec<Chord> = Vec::new();
        for (b, [from, to]) in region.runs() {
            row.cut(b, [from, to], seen, order);
            let first = b * dexels.dims[0] + from;
            for k in 0..to - from {
                let column = &mut self.columns[first + k];
                let inside = dexels.column(first + k);
                count(column, inside, -1.0, alone);
                merged.clear();
                merge(column, marked, row.single(k), |chord| merged.push(chord));
                // New chords carry their number among those exchanged, beyond all others.
                for chord in &mut merged {
                    if chord.2 & NEW != 0 {
                        chord.2 = numbers[(chord.2 & !NEW) as usize];
                    }
                }
                std::mem::swap(column, &mut merged);
                count(column, inside, 1.0, alone);
            }
        }
    }

    /// What each ball covers alone, of all columns.
    pub(super) fn alone(&self, dexels: &Dexels, alone: &mut [Lengths]) {
        for (c, column) in self.columns.iter().enumerate() {
            count(column, dexels.column(c), 1.0, alone);
        }
    }
}

/// The mark of a new chord's number.
const NEW: u32 = 1 << 31;

/// Calls `f` for the chords of `old` whose balls are not marked and for `new`, by lower ends.
#[inline(always)]
fn merge(old: &[Chord], marked: &[bool], new: &[Chord], mut f: impl FnMut(Chord)) {
    let mut new = new.iter().map(|&(lo, hi, i)| (lo, hi, i | NEW)).peekable();
    for &chord in old {
        if marked[chord.2 as usize] {
            continue;
        }
        while let Some(first) = new.next_if(|c| c.0 < chord.0) {
            f(first);
        }
        f(chord);
    }
    new.for_each(f);
}

/// Adds `sign` times what each ball alone covers of a column.
fn count(column: &[Chord], inside: &[[f32; 2]], sign: f64, alone: &mut [Lengths]) {
    single(column, |ball, lo, hi| {
        let both: f32 = inside.iter().map(|i| (hi.min(i[1]) - lo.max(i[0])).max(0.0)).sum();
        let of = &mut alone[ball as usize];
        of.union += sign * f64::from(hi - lo);
        of.both += sign * f64::from(both);
    });
}

/// Lengths of a union of chords that come by their lower ends.
struct Union<'a> {
    inside: &'a [[f32; 2]],
    sum: [f32; 2],
    lo: f32,
    hi: f32,
}

impl<'a> Union<'a> {
    fn new(inside: &'a [[f32; 2]]) -> Union<'a> {
        Union { inside, sum: [0.0; 2], lo: 0.0, hi: f32::MIN }
    }

    #[inline(always)]
    fn add(&mut self, lo: f32, hi: f32) {
        if lo <= self.hi {
            self.hi = self.hi.max(hi);
        } else {
            self.flush();
            (self.lo, self.hi) = (lo, hi);
        }
    }

    #[inline(always)]
    fn flush(&mut self) {
        if self.hi > f32::MIN {
            self.sum[0] += self.hi - self.lo;
            for i in self.inside {
                self.sum[1] += (self.hi.min(i[1]) - self.lo.max(i[0])).max(0.0);
            }
        }
    }

    #[inline(always)]
    fn end(mut self) -> [f32; 2] {
        self.flush();
        self.sum
    }
}
