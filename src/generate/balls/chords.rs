//! Chords of balls along one row of columns, and what they add up to.

use super::dexels::Seen;
use wide::f32x8;

/// Chords of one row of columns.
#[derive(Debug, Clone, Default)]
pub(crate) struct Row {
    counts: Vec<u32>,
    /// In each column, disjoint ascending intervals; `most` places for each.
    joined: Vec<[f32; 2]>,
    /// In each column, the ends of chords by their lower ends, and the balls' numbers.
    single: Vec<(f32, f32, u32)>,
    most: usize,
    touching: Vec<u32>,
}

impl Row {
    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        let numbers = self.counts.capacity() + self.touching.capacity();
        (4 * numbers + 8 * self.joined.capacity() + 12 * self.single.capacity()) as u64
    }

    /// Gets ready for columns `from..to` of row `b`.
    fn begin(&mut self, b: usize, [from, to]: [usize; 2], balls: &[Seen], order: &[u32]) {
        self.touching.clear();
        self.touching.extend(order.iter().filter(|&&i| {
            let s = &balls[i as usize];
            (b as f32 - s.v).abs() < s.r && s.u + s.r >= from as f32 && s.u - s.r <= to as f32
        }));
        self.most = self.touching.len();
        self.counts.clear();
        self.counts.resize(to - from, 0);
    }

    /// The union of the balls in columns `from..to` of row `b`.
    pub(crate) fn join(&mut self, b: usize, run: [usize; 2], balls: &[Seen], order: &[u32]) {
        self.join_part(b, run[0], run, balls, order);
    }

    /// The same, to the last bit as in a run that begins at `start`.
    pub(crate) fn join_part(
        &mut self,
        b: usize,
        start: usize,
        run: [usize; 2],
        balls: &[Seen],
        order: &[u32],
    ) {
        self.begin(b, run, balls, order);
        let Row { counts, joined, most, touching, .. } = self;
        if joined.len() < *most * counts.len() {
            joined.resize(*most * counts.len(), [0.0; 2]);
        }
        for &i in touching.iter() {
            chords(b, start, run, &balls[i as usize], |k, lo, hi| {
                let first = k * *most;
                counts[k] = add(&mut joined[first..first + *most], counts[k] as usize, lo, hi);
            });
        }
    }

    /// As [`Row::cut`], for many balls; to the last bit as in a run that begins at 0.
    pub(crate) fn cut_many(&mut self, b: usize, run: [usize; 2], balls: &[Seen], order: &[u32]) {
        self.begin(b, run, balls, order);
        let Row { counts, single, most, touching, .. } = self;
        if single.len() < *most * counts.len() {
            single.resize(*most * counts.len(), (0.0, 0.0, 0));
        }
        for &i in touching.iter() {
            chords(b, 0, run, &balls[i as usize], |k, lo, hi| {
                single[k * *most + counts[k] as usize] = (lo, hi, i);
                counts[k] += 1;
            });
        }
        for (k, &n) in counts.iter().enumerate() {
            single[k * *most..k * *most + n as usize].sort_by(|x, y| x.0.total_cmp(&y.0));
        }
    }

    /// The chords of each ball in columns `from..to` of row `b`.
    pub(crate) fn cut(&mut self, b: usize, run: [usize; 2], balls: &[Seen], order: &[u32]) {
        self.begin(b, run, balls, order);
        let Row { counts, single, most, touching, .. } = self;
        if single.len() < *most * counts.len() {
            single.resize(*most * counts.len(), (0.0, 0.0, 0));
        }
        for &i in touching.iter() {
            chords(b, run[0], run, &balls[i as usize], |k, lo, hi| {
                let mut at = counts[k] as usize;
                let column = &mut single[k * *most..k * *most + at + 1];
                counts[k] += 1;
                while at > 0 && column[at - 1].0 > lo {
                    column[at] = column[at - 1];
                    at -= 1;
                }
                column[at] = (lo, hi, i);
            });
        }
    }

    /// After [`Row::join`], the union in the column `from + k`.
    #[inline(always)]
    pub(crate) fn joined(&self, k: usize) -> &[[f32; 2]] {
        &self.joined[k * self.most..k * self.most + self.counts[k] as usize]
    }

    /// After [`Row::cut`], the chords of the column `from + k`.
    #[inline(always)]
    pub(crate) fn single(&self, k: usize) -> &[(f32, f32, u32)] {
        &self.single[k * self.most..k * self.most + self.counts[k] as usize]
    }
}

/// Calls `f(column less from, lower end, upper end)` for the chords of a ball in a row, as in a run
/// that begins at `start`: columns are worked on by eights from there or from the ball's first on.
#[inline(always)]
fn chords(
    b: usize,
    start: usize,
    [from, to]: [usize; 2],
    s: &Seen,
    mut f: impl FnMut(usize, f32, f32),
) {
    let y = b as f32 - s.v;
    let q = s.r * s.r - y * y;
    let half = q.max(0.0).sqrt();
    let a1 = whole(s.u + half, to);
    let mut a = whole(s.u - half, to).max(start);
    a += from.saturating_sub(a) / 8 * 8;
    let steps = f32x8::new([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    while a < a1 {
        let x = steps + (a as f32 - s.u);
        let h = (f32x8::splat(q) - x * x).fast_max(f32x8::splat(0.0)).sqrt().to_array();
        for (at, h) in (a..a1).zip(h).skip(from.saturating_sub(a)) {
            f(at - from, s.t - h, s.t + h);
        }
        a += 8;
    }
}

/// Joins an interval to the first `count` of `column`; returns how many there are then.
#[inline(always)]
fn add(column: &mut [[f32; 2]], count: usize, mut lo: f32, mut hi: f32) -> u32 {
    // The first that does not end before, and the first that begins after.
    let mut first = count;
    while first > 0 && column[first - 1][1] >= lo {
        first -= 1;
    }
    let mut last = first;
    while last < count && column[last][0] <= hi {
        lo = lo.min(column[last][0]);
        hi = hi.max(column[last][1]);
        last += 1;
    }
    if last == first {
        column.copy_within(first..count, first + 1);
        column[first] = [lo, hi];
        return count as u32 + 1;
    }
    column[first] = [lo, hi];
    column.copy_within(last..count, first + 1);
    (count - (last - first) + 1) as u32
}

/// Length of `union`, and of its part in the intervals `inside`.
#[inline(always)]
pub(crate) fn lengths(union: &[[f32; 2]], inside: &[[f32; 2]]) -> [f32; 2] {
    let mut out = [0.0f32; 2];
    for c in union {
        out[0] += c[1] - c[0];
        for i in inside {
            out[1] += (c[1].min(i[1]) - c[0].max(i[0])).max(0.0);
        }
    }
    out
}

/// Calls `f(ball, from, to)` for each part of a column that lies in one chord only.
#[inline(always)]
pub(crate) fn single(
    mut chords: impl Iterator<Item = (f32, f32, u32)>,
    mut f: impl FnMut(u32, f32, f32),
) {
    let Some((mut at, mut end, mut ball)) = chords.next() else { return };
    // Up to `second` there are two; up to `end`, one: `ball`.
    let mut second = f32::MIN;
    let mut part = |ball: u32, from: f32, to: f32| {
        if from < to {
            f(ball, from, to);
        }
    };
    for (from, to, i) in chords {
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

/// The number rounded up, from 0 to `most`.
#[inline(always)]
pub(crate) fn whole(x: f32, most: usize) -> usize {
    // Towards zero, and one more where something was cut off.
    let down = x.max(0.0).min(most as f32) as usize;
    (down + usize::from((down as f32) < x)).min(most)
}
