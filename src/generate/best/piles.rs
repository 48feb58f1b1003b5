//! All chords of a clump, column by column: when a few balls change, the chords of the others are
//! read instead of made again. Most chords of a deep pile lie within others: each knows the next
//! that does not lie within it, so that a union is found in a few steps.

use super::chords::{Row, single};
use super::cover::{Lengths, Region};
use super::dexels::{Dexels, Seen};
use crate::error::{Result, filled};

/// Lower end, upper end, number of the ball.
pub(super) type Chord = (f32, f32, u32);

/// A chord in a pile, and the place of the first one after it that reaches higher.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Link {
    chord: Chord,
    next: u32,
}

/// The chords of each column by their lower ends.
#[derive(Debug, Clone)]
pub(super) struct Piles {
    columns: Vec<Vec<Link>>,
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
            row.cut_many(b, [0, across], balls, order);
            for (k, column) in columns.iter_mut().enumerate() {
                pile(row.single(k), column);
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
                outer(&self.columns[c], marked, row.single(k), |lo, hi| lengths.add(lo, hi));
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
                count(column.iter().map(|l| l.chord), inside, -1.0, alone);
                merged.clear();
                merge(column, marked, row.single(k), |chord| merged.push(chord));
                // New chords carry their number among those exchanged, beyond all others.
                for chord in &mut merged {
                    if chord.2 & NEW != 0 {
                        chord.2 = numbers[(chord.2 & !NEW) as usize];
                    }
                }
                pile(&merged, column);
                count(merged.iter().copied(), inside, 1.0, alone);
            }
        }
    }

    /// What each ball covers alone, of all columns.
    pub(super) fn alone(&self, dexels: &Dexels, alone: &mut [Lengths]) {
        for (c, column) in self.columns.iter().enumerate() {
            count(column.iter().map(|l| l.chord), dexels.column(c), 1.0, alone);
        }
    }
}

/// The mark of a new chord's number.
const NEW: u32 = 1 << 31;

/// Makes a pile of chords that come by their lower ends.
fn pile(chords: &[Chord], out: &mut Vec<Link>) {
    out.clear();
    out.extend(chords.iter().map(|&chord| Link { chord, next: 0 }));
    for at in (0..out.len()).rev() {
        // What does not reach higher than the one after it is passed over with that.
        let mut next = at + 1;
        while let Some(link) = out.get(next).filter(|l| l.chord.1 <= out[at].chord.1) {
            next = link.next as usize;
        }
        out[at].next = next as u32;
    }
}

/// Calls `f` for the chords of `old` whose balls are not marked and for `new`, by lower ends.
fn merge(old: &[Link], marked: &[bool], new: &[Chord], mut f: impl FnMut(Chord)) {
    let mut new = new.iter().map(|&(lo, hi, i)| (lo, hi, i | NEW)).peekable();
    for link in old.iter().filter(|l| !marked[l.chord.2 as usize]) {
        while let Some(first) = new.next_if(|c| c.0 < link.chord.0) {
            f(first);
        }
        f(link.chord);
    }
    new.for_each(f);
}

/// As [`merge`], without those of `old` that lie within an unmarked one.
#[inline(always)]
fn outer(old: &[Link], marked: &[bool], new: &[Chord], mut f: impl FnMut(f32, f32)) {
    let (mut at, mut fresh) = (0, 0);
    while let Some(&Link { chord: (lo, hi, ball), next }) = old.get(at) {
        if marked[ball as usize] {
            at += 1;
            continue;
        }
        while let Some(&(low, high, _)) = new.get(fresh).filter(|c| c.0 < lo) {
            f(low, high);
            fresh += 1;
        }
        f(lo, hi);
        at = next as usize;
    }
    new[fresh..].iter().for_each(|&(lo, hi, _)| f(lo, hi));
}

/// Adds `sign` times what each ball alone covers of a column.
fn count(
    column: impl Iterator<Item = Chord>,
    inside: &[[f32; 2]],
    sign: f64,
    alone: &mut [Lengths],
) {
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

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    #[test]
    fn chords_within_others_are_passed_over_and_change_no_union() {
        let mut random = Random::new(3, 0);
        for n in [0, 1, 2, 9, 60, 800] {
            let mut chords: Vec<Chord> = (0..n)
                .map(|i| {
                    let lo = random.between(0.0, 4.0) as f32;
                    (lo, lo + random.between(0.0, 2.0) as f32, i)
                })
                .collect();
            chords.sort_by(|x, y| x.0.total_cmp(&y.0));
            let (new, old) = chords.split_at(n as usize / 10);
            let mut links = Vec::new();
            pile(old, &mut links);
            for part in [0.0, 0.05, 0.5] {
                let marked: Vec<bool> = (0..n).map(|_| random.unit() < part).collect();
                let (mut all, mut steps) = (Union::new(&[[1.0, 3.0]]), 0);
                merge(&links, &marked, new, |(lo, hi, _)| all.add(lo, hi));
                let mut few = Union::new(&[[1.0, 3.0]]);
                outer(&links, &marked, new, |lo, hi| {
                    steps += 1;
                    few.add(lo, hi);
                });
                assert_eq!(all.end(), few.end());
                // With none marked, those of a random pile that reach beyond all before.
                assert!(part > 0.0 || steps < 40 + new.len(), "{steps} of {n}");
            }
        }
    }
}
