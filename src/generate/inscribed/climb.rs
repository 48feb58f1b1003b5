//! The climb: balls take steps that cover more, one after the other; no other step is taken.

use super::depth::{Depth, Inside};
use crate::error::{Result, filled};
use crate::generate::ball::Ball;
use crate::generate::balls::cover::{Cover, Lengths, Look};
use crate::generate::balls::dexels::{Dexels, Seen};
use crate::generate::balls::directions::Directions;
use crate::generate::balls::exposed::{Scratch, outward};
use crate::generate::balls::random::Random;
use wide::f32x8;

/// Directions on a ball.
const DIRECTIONS: usize = 48;
/// Longest and shortest step of a climb, of the mean radius.
const STEPS: [f32; 2] = [0.3, 0.02];
/// Steps proposed to a ball in a sweep, until one promises to cover more.
const TRIES: usize = 6;
/// Part of the steps that end on the medial axis.
const MEDIAL: f64 = 0.6;

/// Balls within the surface.
pub(super) struct Climb<'a> {
    pub dexels: &'a Dexels,
    pub depth: &'a Depth<'a>,
    pub balls: Vec<Inside>,
    /// What each ball covers alone, where known.
    worth: Vec<Option<f64>>,
    /// What the columns hold.
    pub cover: Cover,
    directions: Directions,
    turned: Vec<[f32x8; 3]>,
    scratch: Scratch,
    others: Vec<Ball>,
    seen: Vec<Seen>,
    own: Vec<Lengths>,
    pub look: Look,
}

impl<'a> Climb<'a> {
    pub(super) fn new(
        dexels: &'a Dexels,
        depth: &'a Depth<'a>,
        balls: Vec<Inside>,
    ) -> Result<Climb<'a>> {
        Ok(Climb {
            cover: Cover::new(dexels)?,
            directions: Directions::new(DIRECTIONS),
            turned: Vec::new(),
            scratch: Scratch::default(),
            others: Vec::new(),
            seen: Vec::new(),
            own: Vec::new(),
            look: Look::default(),
            dexels,
            depth,
            worth: filled("balls", balls.len(), None)?,
            balls,
        })
    }

    /// Covered part of the target; all columns anew.
    pub(super) fn coverage(&mut self) -> f64 {
        self.seen.clear();
        self.seen.extend(self.balls.iter().map(|b| self.dexels.seen(&b.ball)));
        self.cover.whole(self.dexels, &self.seen, &mut self.look).both / self.dexels.target
    }

    /// What `ball` covers of the target that no other does, ball `i` not counted.
    pub(super) fn own(&mut self, ball: &Ball, i: usize) -> f64 {
        let first = self.dexels.seen(ball);
        self.seen.clear();
        self.seen.push(first);
        let others = (0..).zip(&self.balls).filter(|(j, o)| *j != i && o.ball.meets(ball, 0.0));
        self.seen.extend(others.map(|(_, o)| self.dexels.seen(&o.ball)));
        self.look.region.of(self.dexels, std::iter::once(first));
        self.own.clear();
        self.own.resize(self.seen.len(), Lengths::default());
        self.look.alone(self.dexels, &self.seen, 1.0, &mut self.own);
        self.own.first().map_or(0.0, |l| l.both)
    }

    /// What ball `i` covers alone.
    pub(super) fn worth(&mut self, i: usize) -> f64 {
        if let Some(worth) = self.worth[i] {
            return worth;
        }
        let ball = self.balls[i].ball;
        let worth = self.own(&ball, i);
        *self.worth[i].insert(worth)
    }

    /// Puts a ball in the place of ball `i`; `worth`: what it covers alone, if known.
    pub(super) fn put(&mut self, i: usize, new: Inside, worth: Option<f64>) {
        let old = std::mem::replace(&mut self.balls[i], new);
        for (b, worth) in self.balls.iter().zip(&mut self.worth) {
            if b.ball.meets(&old.ball, 0.0) || b.ball.meets(&new.ball, 0.0) {
                *worth = None;
            }
        }
        self.worth[i] = worth;
    }

    /// So many sweeps over all balls, by ever shorter steps.
    pub(super) fn climb(
        &mut self,
        sweeps: usize,
        random: &mut Random,
        go: &mut dyn FnMut(f64) -> bool,
    ) {
        let all: Vec<u32> = (0..self.balls.len() as u32).collect();
        for k in 0..sweeps {
            if !go(k as f64 / sweeps as f64) {
                return;
            }
            self.sweep(&all, k as f32 / (sweeps.max(2) - 1) as f32, random);
        }
    }

    /// One step of each of the balls `of`; `part` of the way from long steps to short ones.
    pub(super) fn sweep(&mut self, of: &[u32], part: f32, random: &mut Random) {
        let sum: f32 = of.iter().map(|&i| self.balls[i as usize].ball.radius).sum();
        let length = sum / of.len().max(1) as f32 * STEPS[0] * (STEPS[1] / STEPS[0]).powf(part);
        self.directions.turned(&random.rotation(), &mut self.turned);
        for &i in of {
            self.step(i as usize, length, random);
        }
    }

    fn step(&mut self, i: usize, length: f32, random: &mut Random) {
        let old = self.balls[i];
        self.others.clear();
        let others =
            (0..).zip(&self.balls).filter(|(j, o)| *j != i && o.ball.meets(&old.ball, 0.0));
        self.others.extend(others.map(|(_, o)| o.ball));
        let (sum, count) = outward(&old.ball, self.others.iter(), &self.turned, &mut self.scratch);
        // The radius grows with the depth: dV = ∫ (n + ∇depth) · dc over the exposed surface.
        let way = [0, 1, 2].map(|a| sum[a] + count * old.inward[a]);
        let norm = way.iter().map(|w| w * w).sum::<f32>().sqrt().max(f32::MIN_POSITIVE);
        for _ in 0..TRIES {
            let (weight, any) = (random.unit() as f32, random.rotation()[0]);
            let to = [0, 1, 2].map(|a| {
                let by = weight * way[a] / norm + (1.0 - weight) * any[a];
                old.ball.center[a] + length * by
            });
            let Some(mut new) = self.depth.step(&old.ball, to) else { continue };
            if random.unit() < MEDIAL
                && let Some(medial) = self.depth.medial(to)
            {
                new = medial;
            }
            // Of the steps that the exposed surface speaks against, one in fifty is good; of the
            // others, every second.
            let by = [0, 1, 2].map(|a| new.ball.center[a] - old.ball.center[a]);
            let grown = new.ball.radius - old.ball.radius;
            if sum[0] * by[0] + sum[1] * by[1] + sum[2] * by[2] + count * grown <= 0.0 {
                continue;
            }
            let worth = self.own(&new.ball, i);
            if worth > self.worth(i) {
                self.put(i, new, Some(worth));
            }
            break;
        }
    }
}
