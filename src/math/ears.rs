//! A polygon in the plane cut into triangles, ear by ear (Meisters 1975).

use crate::error::{Result, filled, reserve};

/// A corner turns left when the triangle there has more than this area, in units of the size.
const LEFT: f64 = 1e-14;
const WHAT: &str = "corners of a polygon";

/// Twice the area of a triangle, positive when it turns left.
#[inline]
pub(crate) fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Where the next ear is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Next {
    /// At the same corner, so that a convex polygon becomes a fan.
    Here,
    /// A corner farther on: triangles stay broader than those of a fan.
    Farther,
}

/// A polygon whose ears are cut off: what is an ear changes only beside the cut, and only
/// corners that do not turn left can lie in one. So the work is the number of corners times the
/// number of those.
pub(crate) struct Ears {
    flat: Vec<[f64; 2]>,
    /// The corners before and after each one that are left.
    before: Vec<usize>,
    after: Vec<usize>,
    count: usize,
    ear: Vec<bool>,
    /// Corners that do not turn left, among those that are left or were.
    hollow: Vec<usize>,
    is_hollow: Vec<bool>,
    at: usize,
    next: Next,
}

impl Ears {
    /// Of at least one corner, counter-clockwise, in a unit of the polygon's size.
    pub(crate) fn new(flat: Vec<[f64; 2]>, next: Next) -> Result<Ears> {
        let n = flat.len();
        let mut before = reserve(WHAT, n)?;
        before.extend((0..n).map(|i| (i + n - 1) % n));
        let mut after = reserve(WHAT, n)?;
        after.extend((0..n).map(|i| (i + 1) % n));
        let mut ears = Ears {
            flat,
            before,
            after,
            count: n,
            ear: filled(WHAT, n, false)?,
            hollow: reserve(WHAT, n)?,
            is_hollow: filled(WHAT, n, false)?,
            at: 0,
            next,
        };
        (0..n).for_each(|i| ears.judge_turn(i));
        (0..n).for_each(|i| ears.judge_ear(i));
        Ok(ears)
    }

    /// Cuts an ear off; `None` at the last triangle, or where there is no ear.
    pub(crate) fn cut(&mut self) -> Option<[usize; 3]> {
        if self.count <= 3 {
            return None;
        }
        let mut b = self.at;
        for _ in 0..self.count {
            if self.ear[b] {
                break;
            }
            b = self.after[b];
        }
        if !self.ear[b] {
            return None;
        }
        let (a, c) = (self.before[b], self.after[b]);
        self.after[a] = c;
        self.before[c] = a;
        self.count -= 1;
        self.is_hollow[b] = false;
        self.at = if self.next == Next::Here { c } else { self.after[c] };
        self.judge_turn(a);
        self.judge_turn(c);
        self.judge_ear(a);
        self.judge_ear(c);
        Some([a, b, c])
    }

    /// The corners that are left, in their order.
    pub(crate) fn left(&self) -> impl Iterator<Item = usize> {
        // From the lowest, as if those that are gone had been taken out of a row.
        let mut first = self.at;
        let mut i = self.after[first];
        while i != self.at {
            first = first.min(i);
            i = self.after[i];
        }
        std::iter::successors(Some(first), |&i| Some(self.after[i])).take(self.count)
    }

    fn corner(&self, b: usize) -> [[f64; 2]; 3] {
        [self.before[b], b, self.after[b]].map(|i| self.flat[i])
    }

    fn judge_turn(&mut self, b: usize) {
        let [p, q, r] = self.corner(b);
        let hollow = turn(p, q, r) <= LEFT;
        if hollow && !self.is_hollow[b] {
            self.hollow.push(b);
        }
        self.is_hollow[b] = hollow;
    }

    /// Whether the corner turns left and no other one lies in the triangle.
    fn judge_ear(&mut self, b: usize) {
        let [p, q, r] = self.corner(b);
        let is_hollow = &self.is_hollow;
        self.hollow.retain(|&i| is_hollow[i]);
        self.ear[b] = !self.is_hollow[b]
            && self.hollow.iter().all(|&i| {
                let s = self.flat[i];
                // Corners at the same place, as at the ends of a bridge to a hole, do not count.
                s == p
                    || s == q
                    || s == r
                    || turn(p, q, s) < 0.0
                    || turn(q, r, s) < 0.0
                    || turn(r, p, s) < 0.0
            });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[[f64; 2]], t: &[usize; 3]) -> f64 {
        let [a, b, c] = t.map(|i| points[i]);
        0.5 * turn(a, b, c)
    }

    /// The triangles, and whether the last one turns left.
    fn all(points: &[[f64; 2]], next: Next) -> (Vec<[usize; 3]>, Vec<usize>) {
        let mut ears = Ears::new(points.to_vec(), next).unwrap();
        let found = std::iter::from_fn(|| ears.cut()).collect();
        (found, ears.left().collect())
    }

    #[test]
    fn ears_cover_what_the_polygon_encloses() {
        let spiral: Vec<[f64; 2]> = (0..40)
            .map(|i| (f64::from(i), 1.0))
            .chain((0..40).rev().map(|i| (f64::from(i), 0.6)))
            .map(|(i, r)| {
                let r = r * 1.1f64.powf(i - 40.0);
                [r * (0.3 * i).cos(), r * (0.3 * i).sin()]
            })
            .collect();
        let l =
            [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        for mut points in [spiral, l.to_vec()] {
            let n = points.len();
            let whole: f64 = (1..n - 1).map(|i| area(&points, &[0, i, i + 1])).sum();
            if whole < 0.0 {
                points.reverse();
            }
            for next in [Next::Here, Next::Farther] {
                let (mut found, left) = all(&points, next);
                let [a, b, c] = left[..] else { panic!("{} corners are left", left.len()) };
                found.push([a, b, c]);
                assert_eq!(found.len(), n - 2);
                assert!(found.iter().all(|t| area(&points, t) > 0.0));
                let sum: f64 = found.iter().map(|t| area(&points, t)).sum();
                assert!((sum - whole.abs()).abs() < 1e-12 * sum);
            }
        }
        // Run through the other way round it has none.
        let square = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
        assert_eq!(all(&square, Next::Here), (vec![], vec![0, 1, 2, 3]));
    }

    #[test]
    fn a_convex_polygon_is_a_fan_where_that_is_asked_for() {
        let points: Vec<[f64; 2]> =
            (0..9).map(|i| f64::from(i) * 0.698).map(|t| [t.cos(), t.sin()]).collect();
        let (found, _) = all(&points, Next::Here);
        assert!(found.iter().all(|t| t.contains(&found[0][0])));
        let (found, _) = all(&points, Next::Farther);
        assert!(!found.iter().all(|t| t.contains(&found[0][0])));
    }
}
