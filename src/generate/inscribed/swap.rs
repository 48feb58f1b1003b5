//! Swaps: the ball that covers least alone goes where most is missing, and what is around both
//! places climbs. Kept when the clump covers more.

use super::climb::Climb;
use super::depth::Inside;
use crate::generate::ball::Ball;
use crate::generate::balls::dexels::Seen;
use crate::generate::balls::random::Random;

/// Places tried for a ball.
const PLACES: usize = 12;
/// Sweeps of the balls around.
const SWEEPS: usize = 6;
/// Most balls that climb.
const AROUND: usize = 14;
/// Part of the balls that are taken by chance.
const CHANCE: f64 = 0.15;
/// A place must give this part of what the ball covers now, for the climb to be tried.
const PROMISE: f64 = 0.5;

/// A search by swaps.
pub(super) struct Swaps {
    /// How often each ball was tried.
    tries: Vec<u32>,
    seen: Vec<Seen>,
    gaps: Vec<[f32; 2]>,
    /// Sums of what columns miss.
    missing: Vec<f64>,
}

impl Swaps {
    pub(super) fn new(n: usize) -> Swaps {
        Swaps { tries: vec![0; n], seen: Vec::new(), gaps: Vec::new(), missing: Vec::new() }
    }

    /// Tries so many swaps.
    pub(super) fn search(
        &mut self,
        climb: &mut Climb,
        swaps: usize,
        random: &mut Random,
        go: &mut dyn FnMut(f64) -> bool,
    ) {
        climb.coverage();
        self.count(climb);
        for k in 0..swaps {
            if k % 16 == 0 && !go(k as f64 / swaps as f64) {
                break;
            }
            let i = self.least(climb, random);
            self.tries[i] += 1;
            if let Some(new) = self.place(climb, i, random) {
                self.swap(climb, i, new, random);
            }
        }
    }

    /// The ball to be moved.
    fn least(&mut self, climb: &mut Climb, random: &mut Random) -> usize {
        if random.unit() < CHANCE {
            return random.below(climb.balls.len());
        }
        let mut least = (f64::MAX, 0);
        for i in 0..climb.balls.len() {
            let loss = climb.worth(i);
            let seems = loss * (1.0 + 0.5 * f64::from(self.tries[i])) * random.between(0.7, 1.3);
            if seems < least.0 {
                least = (seems, i);
            }
        }
        least.1
    }

    /// The place found where ball `i` would cover most, if it promises to be enough.
    fn place(&mut self, climb: &mut Climb, i: usize, random: &mut Random) -> Option<Inside> {
        let total = *self.missing.last()?;
        if total <= 0.0 {
            return None;
        }
        let mut best = (0.0, None);
        for _ in 0..PLACES {
            let at = total * random.unit();
            let c = self.missing.partition_point(|&m| m <= at);
            let width = climb.dexels.dims[0];
            let (a, b) = (c % width, c / width);
            self.see(climb);
            climb.look.gaps(climb.dexels, [a, b], &self.seen, &mut self.gaps);
            let gap = self
                .gaps
                .iter()
                .copied()
                .reduce(|x, y| if y[1] - y[0] > x[1] - x[0] { y } else { x });
            let Some(gap) = gap else { continue };
            let t = random.between(f64::from(gap[0]), f64::from(gap[1])) as f32;
            let new = climb.depth.nearly(climb.dexels.point(a, b, t));
            let gain = climb.own(&new, i);
            if gain > best.0 {
                best = (gain, Some(new));
            }
        }
        let (gain, new) = best;
        if gain > PROMISE * climb.worth(i) { climb.depth.exact(new?.center) } else { None }
    }

    /// Puts ball `i` there and has the balls around climb; undone if the clump covers no more.
    fn swap(&mut self, climb: &mut Climb, i: usize, new: Inside, random: &mut Random) {
        let old = climb.balls[i].ball;
        let around = around(climb, i, [&old, &new.ball]);
        let before: Vec<Inside> = around.iter().map(|&j| climb.balls[j as usize]).collect();
        climb.put(i, new, None);
        for k in 0..SWEEPS {
            climb.sweep(&around, 0.2 + 0.8 * k as f32 / (SWEEPS - 1) as f32, random);
        }
        self.see(climb);
        let now = around.iter().map(|&j| climb.balls[j as usize]);
        let changed: Vec<Seen> =
            before.iter().copied().chain(now).map(|b| climb.dexels.seen(&b.ball)).collect();
        climb.look.region.of(climb.dexels, changed.iter().copied());
        let change = climb.look.change(&climb.cover, climb.dexels, &self.seen);
        if change.both > 1e-9 * climb.dexels.target {
            climb.cover.take(climb.dexels, &climb.look);
            self.tries[i] = 0;
            self.count(climb);
        } else {
            for (&j, ball) in around.iter().zip(before) {
                climb.put(j as usize, ball, None);
            }
        }
    }

    fn see(&mut self, climb: &Climb) {
        self.seen.clear();
        self.seen.extend(climb.balls.iter().map(|b| climb.dexels.seen(&b.ball)));
    }

    /// Sums up what the columns miss.
    fn count(&mut self, climb: &Climb) {
        self.missing.clear();
        let mut sum = 0.0;
        for c in 0..climb.dexels.dims[0] * climb.dexels.dims[1] {
            sum += f64::from(climb.cover.missing(climb.dexels, c));
            self.missing.push(sum);
        }
    }
}

/// Ball `i` and those nearest to two places, of the ones that meet a ball there.
fn around(climb: &Climb, i: usize, places: [&Ball; 2]) -> Vec<u32> {
    let mut found: Vec<(f32, u32)> = (0u32..)
        .zip(&climb.balls)
        .filter(|(j, _)| *j as usize != i)
        .filter_map(|(j, b)| {
            let meets = places.iter().filter(|p| p.meets(&b.ball, 0.0));
            let apart = meets.map(|p| p.apart(&b.ball)).reduce(f32::min)?;
            Some((apart, j))
        })
        .collect();
    found.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    found.truncate(AROUND - 1);
    std::iter::once(i as u32).chain(found.into_iter().map(|(_, j)| j)).collect()
}
