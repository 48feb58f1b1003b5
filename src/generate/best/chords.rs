//! Chords of balls along one row of columns, and what they add up to.

use super::dexels::Seen;
use wide::f32x8;

/// Chords of one row of columns, sorted by their lower ends in each column.
#[derive(Debug, Clone, Default)]
pub(super) struct Row {
    counts: Vec<u32>,
    /// Ends and number of the ball; `most` of them for each column.
    chords: Vec<(f32, f32, u32)>,
    most: usize,
    touching: Vec<u32>,
}

impl Row {
    /// The chords of columns `from..to` of row `b`.
    pub(super) fn cut(&mut self, b: usize, [from, to]: [usize; 2], balls: &[Seen], order: &[u32]) {
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
        let steps = f32x8::new([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        for &i in touching.iter() {
            let s = &balls[i as usize];
            let y = b as f32 - s.v;
            let q = s.r * s.r - y * y;
            let half = q.max(0.0).sqrt();
            let a0 = whole(s.u - half, to).max(from);
            let a1 = whole(s.u + half, to);
            let mut a = a0;
            while a < a1 {
                let x = steps + (a as f32 - s.u);
                let h = (f32x8::splat(q) - x * x).fast_max(f32x8::splat(0.0)).sqrt().to_array();
                for (k, h) in (a - from..a1 - from).zip(h) {
                    let (lo, hi) = (s.t - h, s.t + h);
                    let count = counts[k] as usize;
                    let column = &mut chords[k * *most..k * *most + count + 1];
                    counts[k] += 1;
                    let mut at = count;
                    while at > 0 && column[at - 1].0 > lo {
                        column[at] = column[at - 1];
                        at -= 1;
                    }
                    column[at] = (lo, hi, i);
                }
                a += 8;
            }
        }
    }

    /// The chords of the column `from + k`.
    #[inline(always)]
    pub(super) fn column(&self, k: usize) -> &[(f32, f32, u32)] {
        &self.chords[k * self.most..k * self.most + self.counts[k] as usize]
    }
}

/// Length of the union of `chords`, and of its part in the intervals `inside`.
#[inline(always)]
pub(super) fn lengths(chords: &[(f32, f32, u32)], inside: &[[f32; 2]]) -> [f32; 2] {
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
pub(super) fn single(chords: &[(f32, f32, u32)], mut f: impl FnMut(u32, f32, f32)) {
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

/// The number rounded up, from 0 to `most`.
#[inline(always)]
pub(super) fn whole(x: f32, most: usize) -> usize {
    // Towards zero, and one more where something was cut off.
    let down = x.max(0.0).min(most as f32) as usize;
    (down + usize::from((down as f32) < x)).min(most)
}
