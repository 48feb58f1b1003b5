//! Of many balls few matter to the union in a small rectangle of columns: those that in all its
//! columns lie deep within others are left out, rectangle by rectangle, each half of one before.

use super::dexels::Seen;
use std::ops::Range;

/// No rectangle is halved that is no wider than this in both directions, …
const EDGE: usize = 8;
/// … or in which no more balls are left.
const FEW: usize = 24;
/// Room for rounding, as a part of a radius' square.
const ROUNDING: f32 = 1e-5;

/// Columns `a` of rows `b`.
#[derive(Debug, Clone)]
pub(crate) struct Tile<'a> {
    pub a: Range<usize>,
    pub b: Range<usize>,
    /// The balls that may touch them and are left, in the order in which they came.
    pub balls: &'a [u32],
    /// Whether some that touch them are left out.
    pub sifted: bool,
}

/// The greatest of some numbers.
#[derive(Debug, Default)]
pub(crate) struct Top {
    /// Ascending.
    most: Vec<f32>,
}

impl Top {
    pub(crate) fn clear(&mut self) {
        self.most.clear();
    }

    /// Adds a number, and keeps the `deep` greatest.
    #[inline(always)]
    pub(crate) fn add(&mut self, x: f32, deep: usize) {
        if self.most.len() == deep {
            if self.most.first().is_none_or(|&least| x <= least) {
                return;
            }
            self.most.remove(0);
        }
        let at = self.most.partition_point(|&y| y < x);
        self.most.insert(at, x);
    }

    /// Whether `deep` of them are not less than `x`.
    #[inline(always)]
    pub(crate) fn covers(&self, x: f32, deep: usize) -> bool {
        self.most.len() == deep && self.most.first().is_some_and(|&least| least >= x)
    }
}

/// What sifting needs.
#[derive(Debug, Default)]
struct Sieve {
    /// Lowest lower and highest upper end over the columns, and the ball's place in the list.
    outer: Vec<[f32; 2]>,
    /// Highest lower and lowest upper end, of balls that touch all columns.
    inner: Vec<[f32; 2]>,
    order: Vec<u32>,
    top: Top,
    left: Vec<bool>,
}

/// Calls `f` for rectangles that make up all of `dims` columns; `order`: the balls. Left out are
/// only balls each of whose chords in the rectangle lies within those of `deep` others that are left.
pub(crate) fn for_tiles(
    dims: [usize; 2],
    balls: &[Seen],
    order: &[u32],
    deep: usize,
    f: &mut dyn FnMut(Tile),
) {
    let [na, nb] = dims;
    let mut lists = order.to_vec();
    let all = (0..na, 0..nb);
    halve(all, balls, (&mut lists, 0, false), deep, &mut Sieve::default(), f);
}

/// The balls of the rectangle are those of the list from `first` on.
fn halve(
    (a, b): (Range<usize>, Range<usize>),
    balls: &[Seen],
    (lists, first, sifted): (&mut Vec<u32>, usize, bool),
    deep: usize,
    sieve: &mut Sieve,
    f: &mut dyn FnMut(Tile),
) {
    let last = lists.len();
    if last - first <= FEW.max(deep) || a.len().max(b.len()) <= EDGE {
        f(Tile { a, b, balls: &lists[first..last], sifted });
        return;
    }
    let halves = if a.len() >= b.len() {
        let middle = a.start + a.len() / 2;
        [(a.start..middle, b.clone()), (middle..a.end, b)]
    } else {
        let middle = b.start + b.len() / 2;
        [(a.clone(), b.start..middle), (a, middle..b.end)]
    };
    for half in halves {
        lists.extend_from_within(first..last);
        let out = sieve.sift(&half, balls, lists, last, deep);
        halve(half, balls, (lists, last, sifted || out), deep, sieve, f);
        lists.truncate(last);
    }
}

impl Sieve {
    /// Takes balls out of the list from `first` on; whether some were that touch the columns.
    fn sift(
        &mut self,
        (a, b): &(Range<usize>, Range<usize>),
        balls: &[Seen],
        list: &mut Vec<u32>,
        first: usize,
        deep: usize,
    ) -> bool {
        let Sieve { outer, inner, order, top, left } = self;
        let [a, b] = [a, b].map(|r| [r.start as f32, (r.end.max(1) - 1) as f32]);
        outer.clear();
        inner.clear();
        // Only balls that touch the columns.
        let mut kept = first;
        for k in first..list.len() {
            let s = &balls[list[k] as usize];
            let mut near = 0.0f32;
            let mut far = 0.0f32;
            for (x, [low, high]) in [(s.u, a), (s.v, b)] {
                let out = (low - x).max(x - high).max(0.0);
                near += out * out;
                let over = (x - low).max(high - x);
                far += over * over;
            }
            let (r2, more) = (s.r * s.r, ROUNDING * s.r * s.r);
            if near > r2 + more {
                continue;
            }
            let most = (r2 + more - near).max(0.0).sqrt();
            outer.push([s.t - most, s.t + most]);
            if far < r2 - more {
                let least = (r2 - more - far).sqrt();
                inner.push([s.t - least, s.t + least]);
            }
            list[kept] = list[k];
            kept += 1;
        }
        list.truncate(kept);
        // By lower ends: of those that begin before a ball, how far the highest reach.
        order.clear();
        order.extend(0..outer.len() as u32);
        order.sort_unstable_by(|&i, &j| outer[i as usize][0].total_cmp(&outer[j as usize][0]));
        inner.sort_unstable_by(|x, y| x[0].total_cmp(&y[0]));
        left.clear();
        left.resize(outer.len(), true);
        top.clear();
        let mut within = inner.iter().peekable();
        let mut out = false;
        for &i in order.iter() {
            let [low, high] = outer[i as usize];
            // Begins before: never the ball itself, and of two balls not each before the other.
            while let Some(i) = within.next_if(|i| i[0] < low) {
                top.add(i[1], deep);
            }
            if top.covers(high, deep) {
                left[i as usize] = false;
                out = true;
            }
        }
        if out {
            let mut kept = first;
            for (at, &left) in (first..).zip(left.iter()) {
                if left {
                    list[kept] = list[at];
                    kept += 1;
                }
            }
            list.truncate(kept);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    /// Balls that nearly all reach both ends of a round body, and small ones.
    fn balls(n: usize, seed: u64) -> Vec<Seen> {
        let mut random = Random::new(seed, 0);
        let mut balls: Vec<Seen> = (0..n)
            .map(|i| {
                let far = if i % 5 == 0 { 30.0 } else { 12.0 };
                let [u, v, t] = [0; 3].map(|_| random.between(-far, far) as f32);
                let r = random.between(1.0, 45.0 - far);
                Seen { u: u + 50.0, v: v + 40.0, t, r: r as f32 }
            })
            .collect();
        // Some twice.
        for k in 0..n / 10 {
            balls[n - 1 - k] = balls[k];
        }
        balls
    }

    fn chord(s: &Seen, a: usize, b: usize) -> Option<[f32; 2]> {
        let (x, y) = (a as f32 - s.u, b as f32 - s.v);
        let h2 = s.r * s.r - x * x - y * y;
        (h2 > 0.0).then(|| [s.t - h2.sqrt(), s.t + h2.sqrt()])
    }

    #[test]
    fn what_is_left_out_lies_as_deep_as_said_in_what_is_left() {
        for (n, deep) in [(0, 1), (10, 1), (300, 1), (300, 3), (700, 8)] {
            let balls = balls(n, n as u64);
            let order: Vec<u32> = (0..n as u32).collect();
            let dims = [101, 83];
            let mut seen = vec![0; dims[0] * dims[1]];
            let mut most = 0;
            for_tiles(dims, &balls, &order, deep, &mut |tile| {
                most = most.max(tile.balls.len());
                assert!(tile.balls.is_sorted());
                for b in tile.b.clone() {
                    for a in tile.a.clone() {
                        seen[a + dims[0] * b] += 1;
                        let of = |i: &u32| chord(&balls[*i as usize], a, b);
                        for i in order.iter().filter(|i| !tile.balls.contains(i)) {
                            let Some([lo, hi]) = of(i) else { continue };
                            assert!(tile.sifted);
                            let holds = |c: &[f32; 2]| c[0] <= lo && c[1] >= hi;
                            let count = tile.balls.iter().filter_map(of).filter(holds).count();
                            assert!(count >= deep, "{i} of {n} in ({a}, {b}): {count}");
                        }
                    }
                }
            });
            assert!(seen.iter().all(|&s| s == 1));
            assert!(n < 300 || most < n / 2, "{most} of {n}");
        }
    }
}
