//! All chords of a clump, column by column: when a few balls change, the chords of the others are
//! read instead of made again. Most chords of a deep pile lie within others: each knows the next
//! that does not lie within it, so that a union is found in a few steps.
//!
//! Of very many balls most chords lie within so many others that no exchange brings them to light.
//! They are left out, and a column knows how deep they lie; where more change than that, it is made
//! anew. What is found is the same.

use super::chords::{Row, single};
use super::cover::{Lengths, Region};
use super::dexels::{Dexels, Seen};
use super::tiles::{Top, for_tiles};
use crate::error::{Error, Result, filled, fits};

/// Lower end, upper end, number of the ball.
pub(crate) type Chord = (f32, f32, u32);

/// A chord in a pile.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Link {
    lo: f32,
    hi: f32,
    /// The number of the ball, and how many chords farther on is one that reaches higher: all
    /// between lie within this one.
    tag: u32,
}

/// Bits of a ball's number; the others of a tag are the way to the next chord, which may be cut
/// short.
const NUMBER: u32 = 17;
const WAY: u32 = (1 << (32 - NUMBER)) - 1;

/// Of more balls than this, chords are left out that lie within so many others.
const FEW: usize = 128;
const DEEP: usize = 8;

/// Where a column's chords are, and how many may be there before they go elsewhere.
#[derive(Debug, Clone, Copy, Default)]
struct Place {
    start: u32,
    count: u32,
    room: u32,
    /// Chords that are left out lie within so many others; [`ALL`] if none is.
    deep: u32,
}

const ALL: u32 = u32::MAX;

/// The chords of each column by their lower ends, column after column.
#[derive(Debug, Clone)]
pub(crate) struct Piles {
    places: Vec<Place>,
    links: Vec<Link>,
}

/// Balls that change: numbers and new places, and a mark on each of their numbers.
#[derive(Debug, Default, Clone)]
pub(crate) struct Exchange {
    numbers: Vec<u32>,
    seen: Vec<Seen>,
    order: Vec<u32>,
    marked: Vec<bool>,
    row: Row,
    /// Chords of a column that is made anew.
    anew: Vec<Chord>,
    /// The columns' new lengths, run after run of the region.
    pub fresh: Vec<[f32; 2]>,
}

impl Exchange {
    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        let balls = 4 * (self.numbers.capacity() + self.order.capacity())
            + size_of::<Seen>() * self.seen.capacity()
            + self.marked.capacity();
        let chords = size_of::<Chord>() * self.anew.capacity() + 8 * self.fresh.capacity();
        (balls + chords) as u64 + self.row.bytes()
    }

    /// The balls `of` of `n` are at the places that `seen` has for them.
    pub(crate) fn set(&mut self, of: &[u32], seen: &[Seen]) {
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

impl Link {
    #[inline(always)]
    fn ball(&self) -> u32 {
        self.tag & ((1 << NUMBER) - 1)
    }

    #[inline(always)]
    fn way(&self) -> usize {
        (self.tag >> NUMBER) as usize
    }

    fn chord(&self) -> Chord {
        (self.lo, self.hi, self.ball())
    }
}

impl Piles {
    /// Bytes that it may take for so many balls, of which all meet in all of `met` columns of so
    /// many: as many chords lie within fewer than [`DEEP`] others as of chords at random.
    pub(crate) fn expected(columns: usize, met: usize, balls: usize) -> u64 {
        let (n, deep) = (balls as f64, DEEP as f64);
        let each = if balls > FEW { deep * (1.0 + (n / deep).ln()) } else { n };
        let links = 1.6 * met as f64 * each * size_of::<Link>() as f64;
        (columns * size_of::<Place>()) as u64 + links as u64
    }

    /// Of no ball.
    pub(crate) fn new(dexels: &Dexels) -> Result<Piles> {
        let n = dexels.dims[0] * dexels.dims[1];
        Ok(Piles { places: filled("chords of columns", n, Place::default())?, links: Vec::new() })
    }

    /// Gives back what chords took.
    pub(crate) fn clear(&mut self) {
        self.places.fill(Place::default());
        self.links = Vec::new();
    }

    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        let places = self.places.len() * size_of::<Place>();
        (places + self.links.capacity() * size_of::<Link>()) as u64
    }

    /// The chords of column `c`.
    #[inline(always)]
    fn column(&self, c: usize) -> &[Link] {
        let Place { start, count, .. } = self.places[c];
        &self.links[start as usize..(start + count) as usize]
    }

    /// All columns anew; `order`: the balls by their lower ends. In no more than `room` bytes.
    pub(crate) fn fill(
        &mut self,
        dexels: &Dexels,
        balls: &[Seen],
        order: &[u32],
        room: u64,
    ) -> Result<()> {
        let mut row = Row::default();
        let across = dexels.dims[0];
        let deep = if balls.len() > FEW { DEEP } else { balls.len().max(1) };
        let Piles { places, links } = self;
        links.clear();
        let (mut sieve, mut done) = (Sieve::default(), Ok(()));
        for_tiles(dexels.dims, balls, order, deep, &mut |tile| {
            if done.is_err() {
                return;
            }
            for b in tile.b.clone() {
                row.cut_many(b, [tile.a.start, tile.a.end], balls, tile.balls);
                for (k, a) in tile.a.clone().enumerate() {
                    let (chords, sifted) = sieve.sift(row.single(k), deep);
                    let deep = if sifted || tile.sifted { deep as u32 } else { ALL };
                    places[a + across * b] = match lay(links, chords, room) {
                        Ok(place) => Place { deep, ..place },
                        Err(e) => return done = Err(e),
                    };
                }
            }
        });
        done
    }

    /// Puts other chords into a column.
    fn put(&mut self, c: usize, chords: &[Chord], deep: u32) {
        let count = chords.len() as u32;
        let place = &mut self.places[c];
        if count > place.room {
            // To the end: not often, as there is room for some more, and all are made anew now and
            // then.
            (place.start, place.room) = (self.links.len() as u32, room(count));
            let end = self.links.len() + place.room as usize;
            if end > self.links.capacity() {
                // Not twice as much, as it would be else.
                self.links.reserve_exact(end / 8 + place.room as usize);
            }
            self.links.resize(end, Link::default());
        }
        place.count = count;
        place.deep = deep;
        pile(chords, &mut self.links[place.start as usize..]);
    }

    /// How deep chords of column `c` that are left out still lie without the marked balls.
    #[inline(always)]
    fn left(&self, c: usize, marked: &[bool]) -> u32 {
        let deep = self.places[c].deep;
        if deep == ALL {
            return ALL;
        }
        let gone = self.column(c).iter().filter(|l| marked[l.ball() as usize]).count();
        deep.saturating_sub(gone as u32)
    }

    /// What the region's columns hold after the exchange, less `now`; `all`: the balls after it.
    pub(crate) fn change(
        &self,
        dexels: &Dexels,
        region: &Region,
        exchange: &mut Exchange,
        all: &[Seen],
        now: &[[f32; 2]],
    ) -> Lengths {
        let Exchange { numbers, seen, order, marked, row, anew, fresh } = exchange;
        fresh.clear();
        let mut sum = Lengths::default();
        for (b, [from, to]) in region.runs() {
            row.cut(b, [from, to], seen, order);
            let first = b * dexels.dims[0] + from;
            let mut part = [0.0f32; 2];
            for k in 0..to - from {
                let c = first + k;
                let mut lengths = Union::new(dexels.column(c));
                if numbers.len() as u32 >= self.places[c].deep && self.left(c, marked) == 0 {
                    cut(b, from + k, all, anew);
                    anew.iter().for_each(|&(lo, hi, _)| lengths.add(lo, hi));
                } else {
                    outer(self.column(c), marked, row.single(k), |lo, hi| lengths.add(lo, hi));
                }
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
    pub(crate) fn take(
        &mut self,
        dexels: &Dexels,
        region: &Region,
        exchange: &mut Exchange,
        all: &[Seen],
        alone: &mut [Lengths],
    ) {
        let Exchange { numbers, seen, order, marked, row, anew, .. } = exchange;
        let mut merged: Vec<Chord> = Vec::new();
        let mut sieve = Sieve::default();
        for (b, [from, to]) in region.runs() {
            row.cut(b, [from, to], seen, order);
            let first = b * dexels.dims[0] + from;
            for k in 0..to - from {
                let column = self.column(first + k);
                let inside = dexels.column(first + k);
                count(column.iter().map(Link::chord), inside, -1.0, alone);
                merged.clear();
                let left = self.left(first + k, marked);
                if left < 2 {
                    // What one ball covers alone must be seen.
                    cut(b, from + k, all, anew);
                    let (chords, sifted) = sieve.sift(anew, DEEP);
                    self.put(first + k, chords, if sifted { DEEP as u32 } else { ALL });
                    count(chords.iter().copied(), inside, 1.0, alone);
                    continue;
                }
                merge(column, marked, row.single(k), |chord| merged.push(chord));
                // New chords carry their number among those exchanged, beyond all others.
                for chord in &mut merged {
                    if chord.2 & NEW != 0 {
                        chord.2 = numbers[(chord.2 & !NEW) as usize];
                    }
                }
                self.put(first + k, &merged, left);
                count(merged.iter().copied(), inside, 1.0, alone);
            }
        }
    }

    /// What each ball covers alone, of all columns.
    pub(crate) fn alone(&self, dexels: &Dexels, alone: &mut [Lengths]) {
        for c in 0..self.places.len() {
            count(self.column(c).iter().map(Link::chord), dexels.column(c), 1.0, alone);
        }
    }
}

/// The mark of a new chord's number.
const NEW: u32 = 1 << 31;

/// Leaves chords out that lie within many others.
#[derive(Debug, Default)]
struct Sieve {
    top: Top,
    left: Vec<Chord>,
}

impl Sieve {
    /// Of chords that come by their lower ends those that do not lie within `deep` others, and
    /// whether there are more.
    fn sift<'a>(&'a mut self, chords: &'a [Chord], deep: usize) -> (&'a [Chord], bool) {
        if chords.len() <= deep {
            return (chords, false);
        }
        let Sieve { top, left } = self;
        top.clear();
        left.clear();
        for chord in chords {
            if !top.covers(chord.1, deep) {
                left.push(*chord);
            }
            top.add(chord.1, deep);
        }
        (left, left.len() < chords.len())
    }
}

/// All chords of the column (a, b), by their lower ends.
fn cut(b: usize, a: usize, balls: &[Seen], out: &mut Vec<Chord>) {
    out.clear();
    for (i, s) in (0u32..).zip(balls) {
        let (x, y) = (a as f32 - s.u, b as f32 - s.v);
        let q = s.r * s.r - y * y - x * x;
        if q > 0.0 {
            out.push((s.t - q.sqrt(), s.t + q.sqrt(), i));
        }
    }
    out.sort_by(|x, y| x.0.total_cmp(&y.0));
}

/// Adds a column's chords.
fn lay(links: &mut Vec<Link>, chords: &[Chord], most: u64) -> Result<Place> {
    let (start, count) = (links.len(), chords.len() as u32);
    let place = Place { start: start as u32, count, room: room(count), deep: ALL };
    let end = start + place.room as usize;
    if end > links.capacity() {
        let wanted = (end + end / 4) as u64 * size_of::<Link>() as u64;
        fits(format_args!("the chords of columns"), wanted, most)?;
        let missing = end + end / 4 - links.len();
        links.try_reserve_exact(missing).map_err(|_| {
            Error::OutOfMemory(format!("no memory for the chords of columns: {wanted} bytes"))
        })?;
    }
    links.resize(end, Link::default());
    pile(chords, &mut links[start..]);
    Ok(place)
}

/// Chords of a column for which there is room when so many are there.
fn room(count: u32) -> u32 {
    count + count / 4 + u32::from(count > 0) * 3
}

/// Makes a pile of chords that come by their lower ends.
fn pile(chords: &[Chord], out: &mut [Link]) {
    let out = &mut out[..chords.len()];
    for at in (0..chords.len()).rev() {
        let (lo, hi, ball) = chords[at];
        // What does not reach higher than the one after it is passed over with that.
        let mut next = at + 1;
        while let Some(link) = out.get(next).filter(|l| l.hi <= hi) {
            next += link.way();
        }
        out[at] = Link { lo, hi, tag: ball | ((next - at) as u32).min(WAY) << NUMBER };
    }
}

/// Calls `f` for the chords of `old` whose balls are not marked and for `new`, by lower ends.
fn merge(old: &[Link], marked: &[bool], new: &[Chord], mut f: impl FnMut(Chord)) {
    let mut new = new.iter().map(|&(lo, hi, i)| (lo, hi, i | NEW)).peekable();
    for link in old.iter().filter(|l| !marked[l.ball() as usize]) {
        while let Some(first) = new.next_if(|c| c.0 < link.lo) {
            f(first);
        }
        f(link.chord());
    }
    new.for_each(f);
}

/// As [`merge`], without those of `old` that lie within an unmarked one.
#[inline(always)]
fn outer(old: &[Link], marked: &[bool], new: &[Chord], mut f: impl FnMut(f32, f32)) {
    let (mut at, mut fresh) = (0, 0);
    while let Some(link) = old.get(at) {
        if marked[link.ball() as usize] {
            at += 1;
            continue;
        }
        while let Some(&(low, high, _)) = new.get(fresh).filter(|c| c.0 < link.lo) {
            f(low, high);
            fresh += 1;
        }
        f(link.lo, link.hi);
        at += link.way();
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
            let mut links = vec![Link::default(); old.len()];
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
