//! A clump on its way down: its balls, what the columns hold of it, what each ball is worth, and
//! where something is missing.

use super::connected;
use super::limits::Limits;
use super::refine::{Radii, Task};
use super::symmetry::Orbits;
use super::watch::Watch;
use crate::error::{Result, filled, reserve};
use crate::generate::ball::Ball;
use crate::generate::balls::cover::{Cover, Lengths, Look};
use crate::generate::balls::dexels::{Dexels, Seen};
use crate::generate::balls::directions::Directions;
use crate::generate::balls::exposed::Weights;
use crate::generate::balls::field::Field;
use crate::generate::balls::near::Near;
use crate::generate::balls::piles::Piles;
use crate::generate::balls::random::Random;
use crate::generate::balls::smooth::{Pull, Smooth};

/// What all parts of the search read.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    pub field: &'a Field,
    pub dexels: &'a Dexels,
    pub radii: Radii,
    pub limits: &'a Limits<'a>,
    /// How many times clump beyond the target counts.
    pub overshoot: f64,
    /// Whether the clump must hang together.
    pub connected: bool,
    /// A length of the order of the body.
    pub size: f32,
    /// Bytes that are left of the memory limit.
    pub room: u64,
}

impl Ground<'_> {
    /// A refinement of balls in these orbits.
    pub(super) fn task<'t>(
        &'t self,
        directions: &'t Directions,
        weights: Weights,
        orbits: &'t Orbits<'t>,
        pull: Option<Pull<'t>>,
    ) -> Task<'t> {
        let Ground { field, limits, radii, .. } = *self;
        Task { field, directions, weights, radii, limits, orbits, pull }
    }
}

/// A clump with its books.
pub(super) struct State<'a> {
    pub ground: Ground<'a>,
    pub balls: Vec<Ball>,
    pub orbits: Orbits<'a>,
    pub seen: Vec<Seen>,
    pub cover: Cover,
    pub piles: Piles,
    lengths: Lengths,
    /// The distance between the surfaces, where it weighs something.
    smooth: Option<Smooth>,
    /// What each ball covers that no other does.
    alone: Vec<Lengths>,
    /// Moves of each ball since it last changed.
    pub tried: Vec<u32>,
    /// For each row of columns, the sum of what its columns weigh when a place is drawn.
    rows: Vec<f64>,
    /// Whether the books are kept that moves need: what columns hold ball by ball.
    books: bool,
    /// Balls of lower numbers stay as they are: those of a smaller clump that this one contains.
    pub fixed: usize,
    /// How many parts the clump has, where it must hang together; else 1.
    pub parts: usize,
    near: Near,
    /// Changes so far.
    pub version: u64,
    /// How far the surfaces of clump and target are apart in the mean: the measure of Huber's
    /// widths.
    pub width: f32,
}

impl<'a> State<'a> {
    /// The books that moves need are not kept yet.
    pub(super) fn new(
        ground: Ground<'a>,
        balls: Vec<Ball>,
        orbits: Orbits<'a>,
        smooth: Option<Smooth>,
        look: &mut Look,
    ) -> Result<State<'a>> {
        let n = balls.len();
        let mut state = State {
            ground,
            seen: reserve("balls along the columns", n)?,
            balls,
            orbits,
            cover: Cover::new(ground.dexels)?,
            piles: Piles::new(ground.dexels)?,
            lengths: Lengths::default(),
            smooth,
            alone: filled("what balls are worth", n, Lengths::default())?,
            tried: filled("moves of balls", n, 0)?,
            rows: reserve("rows of columns", ground.dexels.dims[1])?,
            books: false,
            fixed: 0,
            parts: 1,
            near: Near::default(),
            version: 0,
            width: ground.size,
        };
        state.renew(look)?;
        Ok(state)
    }

    /// Bytes of its large arrays.
    pub(super) fn bytes(&self) -> u64 {
        let smooth = self.smooth.as_ref().map_or(0, Smooth::bytes);
        let each = size_of::<Ball>() + size_of::<Seen>() + size_of::<Lengths>() + 4;
        self.cover.bytes() + self.piles.bytes() + smooth + (each * self.balls.len()) as u64
    }

    /// D by the columns.
    pub(super) fn mismatch(&self) -> f64 {
        self.lengths.mismatch(self.ground.dexels.target)
    }

    /// D with the weight of what is beyond the target.
    fn weighed(&self) -> f64 {
        self.lengths.weighed(self.ground.overshoot).mismatch(self.ground.dexels.target)
    }

    /// What is made least: D with the weight of what is beyond the target, and the charge for the
    /// distance between the surfaces.
    pub(super) fn goal(&self) -> f64 {
        self.weighed() + self.smooth.as_ref().map_or(0.0, |s| s.now())
    }

    /// Union and target: what a cost is divided by to be a change of the goal.
    fn both(&self, lengths: &Lengths) -> f64 {
        lengths.weighed(self.ground.overshoot).union + self.ground.dexels.target
    }

    /// By how much more than the target's the clump's volume is, of the target's.
    pub(super) fn excess(&self) -> f64 {
        self.lengths.union / self.ground.dexels.target - 1.0
    }

    /// The weights for which a step down is a step down in the goal.
    pub(super) fn weights(&self) -> Weights {
        let mut weights = Weights::at(self.weighed(), self.ground.overshoot);
        if let Some(smooth) = &self.smooth {
            weights.square = (smooth.slope() * self.both(&self.lengths)) as f32;
        }
        weights
    }

    /// Who leads the balls that may change.
    pub(super) fn free(&self) -> Vec<u32> {
        let mut leads = self.orbits.leads(self.balls.len());
        leads.retain(|&i| i as usize >= self.fixed);
        leads
    }

    /// What draws balls beside the volumes.
    pub(super) fn pull(&self) -> Option<Pull<'_>> {
        let volumes = self.both(&self.lengths) * self.ground.dexels.cell();
        self.smooth.as_ref().map(|s| s.pull(volumes))
    }

    /// What a change of the lengths costs: less than 0 exactly where the weighed D falls.
    fn cost(&self, change: &Lengths) -> f64 {
        change.weighed(self.ground.overshoot).cost(self.weighed())
    }

    /// What it costs to put the balls `of` to the places that `seen` has for them: less than 0
    /// exactly where the goal falls.
    /// `step`: of the rows only one in so many is looked at.
    pub(super) fn price(&self, of: &[u32], seen: &[Seen], step: u32, look: &mut Look) -> f64 {
        self.change(of, seen, step, look).0
    }

    /// The same, with the changes of the lengths and of the distances.
    fn change(
        &self,
        of: &[u32],
        seen: &[Seen],
        step: u32,
        look: &mut Look,
    ) -> (f64, Lengths, [f64; 2]) {
        let dexels = self.ground.dexels;
        self.aim(of, seen, look);
        look.region.thin(step);
        let lengths = look.exchange(&self.cover, &self.piles, dexels, of, seen);
        let cost = f64::from(step) * self.cost(&lengths);
        let Some(smooth) = &self.smooth else { return (cost, lengths, [0.0; 2]) };
        let distances = smooth.change(dexels, &look.region, step, of, seen, &mut look.smooth);
        let both = self.both(&self.lengths.plus(&lengths));
        (cost + both * smooth.rise(distances), lengths, distances)
    }

    /// How much more the goal is than the weighed D.
    fn more(&self) -> f64 {
        match &self.smooth {
            Some(smooth) => 1.0 + smooth.now() / self.weighed().max(1e-6),
            None => 1.0,
        }
    }

    /// All that is missing and too much, in units of the cost.
    pub(super) fn left(&self) -> f64 {
        self.left_of(&self.lengths.weighed(self.ground.overshoot)) * self.more()
    }

    fn left_of(&self, lengths: &Lengths) -> f64 {
        let d = self.weighed();
        lengths.cost(d) + (1.0 + d) * self.ground.dexels.target
    }

    /// The width, from the clump's exposed area.
    pub(super) fn measure_width(&mut self, area: f64) {
        // Of balls that stay no area is known: as much as of the others.
        let (n, free) = (self.balls.len() as f64, (self.balls.len() - self.fixed) as f64);
        let area = if self.fixed > 0 { area * n / free.max(1.0) } else { area };
        let volume = self.left_of(&self.lengths) * self.ground.dexels.cell();
        let least = 1e-5 * f64::from(self.ground.size);
        let width = if area > 0.0 { volume / area } else { 0.0 };
        self.width = width.max(least) as f32;
    }

    /// By how much the cost would rise without ball `i`; of an orbit, the mean.
    pub(super) fn worth(&self, i: usize) -> f64 {
        let cost = match self.orbits.orbit(i as u32) {
            None => self.cost(&self.alone[i]),
            Some(o) => {
                let sum: f64 = o.balls.iter().map(|&j| self.cost(&self.alone[j as usize])).sum();
                sum / o.balls.len() as f64
            }
        };
        -cost * self.more()
    }

    /// Keeps the books that moves of single balls need from the next [`State::renew`] on, or not.
    /// To join parts takes them, too.
    pub(super) fn keep_books(&mut self, moves: bool) {
        self.books = moves || self.ground.connected;
    }

    /// Counts everything anew from the balls.
    pub(super) fn renew(&mut self, look: &mut Look) -> Result<()> {
        let dexels = self.ground.dexels;
        self.version += 1;
        self.seen.clear();
        self.seen.extend(self.balls.iter().map(|b| dexels.seen(b)));
        self.lengths = self.cover.whole(dexels, &self.seen, look);
        if let Some(smooth) = &mut self.smooth {
            smooth.whole(dexels, &self.seen, &mut look.smooth);
        }
        if !self.books {
            self.piles.clear();
            return Ok(());
        }
        self.alone.fill(Lengths::default());
        let order = look.order(dexels, &self.seen);
        self.piles.fill(dexels, &self.seen, order, self.ground.room)?;
        self.piles.alone(dexels, &mut self.alone);
        self.rows.clear();
        for b in 0..dexels.dims[1] {
            self.rows.push(self.row(b));
        }
        Ok(())
    }

    /// Joins the parts of a clump that must hang together.
    pub(super) fn join(&mut self, look: &mut Look, watch: &Watch) -> Result<()> {
        if self.ground.connected {
            self.parts = connected::join(self, look, watch)?;
        }
        Ok(())
    }

    /// How many parts there are now, where the clump must hang together; else 1.
    pub(super) fn pieces(&mut self) -> usize {
        if self.ground.connected { connected::parts(&self.balls, &mut self.near).1 } else { 1 }
    }

    /// Whether the clump would have more parts with `balls` at the places of those `of`.
    fn falls_apart(&mut self, of: &[u32], balls: &[Ball]) -> bool {
        if !self.ground.connected {
            return false;
        }
        let mut all = self.balls.clone();
        for (&j, ball) in of.iter().zip(balls) {
            all[j as usize] = *ball;
        }
        connected::parts(&all, &mut self.near).1 > self.parts
    }

    /// Puts `balls` to the places of those with the numbers `of` if the goal falls; whether it does.
    pub(super) fn take(&mut self, of: &[u32], balls: &[Ball], look: &mut Look) -> bool {
        let dexels = self.ground.dexels;
        let mut seen = self.seen.clone();
        for (&j, ball) in of.iter().zip(balls) {
            seen[j as usize] = dexels.seen(ball);
        }
        let (cost, change, distances) = self.change(of, &seen, 1, look);
        if cost >= 0.0 || self.falls_apart(of, balls) {
            return false;
        }
        self.accept((of, balls), seen, (change, distances), look);
        true
    }

    /// Puts `balls` to the places of those with the numbers `of`, whatever it costs.
    pub(super) fn put(&mut self, of: &[u32], balls: &[Ball], look: &mut Look) {
        let mut seen = self.seen.clone();
        for (&j, ball) in of.iter().zip(balls) {
            seen[j as usize] = self.ground.dexels.seen(ball);
        }
        let (_, change, distances) = self.change(of, &seen, 1, look);
        self.accept((of, balls), seen, (change, distances), look);
    }

    /// Takes over what the last look at a change found.
    fn accept(
        &mut self,
        (of, balls): (&[u32], &[Ball]),
        seen: Vec<Seen>,
        (change, distances): (Lengths, [f64; 2]),
        look: &mut Look,
    ) {
        let dexels = self.ground.dexels;
        if let Some(smooth) = &mut self.smooth {
            smooth.take(dexels, &look.region, distances, &look.smooth);
        }
        look.take(&mut self.cover, &mut self.piles, dexels, &seen, &mut self.alone);
        for b in look.region.rows() {
            self.rows[b] = self.row(b);
        }
        for (&j, ball) in of.iter().zip(balls) {
            self.balls[j as usize] = *ball;
            self.tried[j as usize] = 0;
        }
        self.seen = seen;
        self.lengths = self.lengths.plus(&change);
        self.version += 1;
    }

    /// Looks at the columns that the balls `of` touch now or in `seen`.
    fn aim(&self, of: &[u32], seen: &[Seen], look: &mut Look) {
        let both = [self.seen.as_slice(), seen];
        let changed = both.into_iter().flat_map(|all| of.iter().map(move |&j| all[j as usize]));
        look.region.of(self.ground.dexels, changed);
    }

    /// The weights of a row's columns.
    fn row(&self, b: usize) -> f64 {
        (0..self.ground.dexels.dims[0]).map(|a| self.weight(a, b)).sum()
    }

    /// How likely a place of column (a, b) is drawn: more than its part of what is missing, as
    /// long gaps take larger balls.
    fn weight(&self, a: usize, b: usize) -> f64 {
        long(self.cover.missing(self.ground.dexels, a + self.ground.dexels.dims[0] * b))
    }

    /// A place inside that is not covered.
    pub(super) fn gap(
        &self,
        random: &mut Random,
        look: &mut Look,
        gaps: &mut Vec<[f32; 2]>,
    ) -> Option<[f32; 3]> {
        let dexels = self.ground.dexels;
        let mut at = self.rows.iter().sum::<f64>() * random.unit();
        let b = draw(&mut at, self.rows.iter().copied())?;
        let a = draw(&mut at, (0..dexels.dims[0]).map(|a| self.weight(a, b)))?;
        look.gaps(dexels, [a, b], &self.seen, gaps);
        let mut at = gaps.iter().map(|g| long(g[1] - g[0])).sum::<f64>() * random.unit();
        let g = gaps[draw(&mut at, gaps.iter().map(|g| long(g[1] - g[0])))?];
        Some(dexels.point(a, b, g[0] + (g[1] - g[0]) * random.unit() as f32))
    }
}

/// How likely a gap of this length is drawn.
fn long(length: f32) -> f64 {
    let x = f64::from(length.max(0.0));
    x * x.sqrt()
}

/// The number of the weight in which `at` falls; `at` is then what is left.
fn draw(at: &mut f64, weights: impl Iterator<Item = f64>) -> Option<usize> {
    for (k, w) in weights.enumerate() {
        if *at < w {
            return Some(k);
        }
        *at -= w;
    }
    None
}
