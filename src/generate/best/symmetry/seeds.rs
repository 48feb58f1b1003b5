//! The start of a symmetric clump: a greedy cover by whole orbits of grown medial balls.

use super::super::effort::Plan;
use super::super::seeds::GROWN;
use super::super::state::Ground;
use super::kinds::Kind;
use super::orbits::{Orbit, Orbits, Sites};
use crate::error::{Result, filled, push, reserve};
use crate::generate::ball::Ball;
use crate::generate::balls::dexels::Dexels;
use crate::generate::balls::medial;
use crate::generate::balls::random::Random;
use crate::generate::select::Points;
use crate::math::Vec3;

/// Fewest points to be covered and fewest candidates.
const POINTS: usize = 500;
const CANDIDATES: usize = 150;
/// Of its radius: how far a ball may be from a plane, line or point to be tried on it as well.
const SNAP: f64 = 1.0;
/// Bytes that candidates may take together for what they hold.
const HELD: usize = 64 << 20;
/// What an orbit covers is divided by its number of balls to this power.
const SIZE: f64 = 0.9;

/// A ball that stands for an orbit.
struct Candidate {
    ball: Ball,
    kind: usize,
    /// The points that the orbit holds, a bit each.
    held: Vec<u64>,
    /// No less than how many of them no orbit chosen holds.
    gain: u32,
}

/// The balls of a clump of `n`, which orbits can make up, and the orbits.
pub(in super::super) fn seeds<'a>(
    sites: &'a Sites,
    ground: &Ground,
    plan: &Plan,
    n: usize,
    random: &mut Random,
) -> Result<(Vec<Ball>, Orbits<'a>)> {
    let count = |all: usize, least: usize| (all / sites.order).max(least.min(all));
    let number = count(plan.points, POINTS);
    let points = points(sites, ground.dexels, number, random)?;
    let mut open = filled("points", number.div_ceil(64), u64::MAX)?;
    let mut candidates = Vec::new();
    // Each candidate of each kind keeps a bit for each point.
    let each = 8 * open.len() * sites.kinds.len();
    let starts = count(plan.candidates, CANDIDATES).min(HELD / each.max(1)).max(1);
    let starts = ground.dexels.points(starts, random)?;
    for p in starts.into_iter().chain([[0, 1, 2].map(|a| sites.centre[a] as f32)]) {
        let ball = medial::ball(ground.field, p, ground.size);
        let center = Vec3::from(ball.center.map(f64::from));
        let off = |k: usize| (sites.fold(k, &center) - center).norm();
        for class in 0..sites.kinds.len() {
            // Of kinds that are carried into each other the closest.
            let same = (0..sites.kinds.len()).filter(|&k| sites.kinds[k].class == class);
            let Some(kind) = same.min_by(|&j, &k| off(j).total_cmp(&off(k))) else { continue };
            let Some(ball) = sites.grown(ground, kind, ball.center) else { continue };
            if off(kind) > SNAP * f64::from(ball.radius) {
                continue;
            }
            let held = sites.held(&points, open.len(), kind, &ball)?;
            let gain = held.iter().map(|w| w.count_ones()).sum();
            push("candidates", &mut candidates, Candidate { ball, kind, held, gain })?;
        }
    }
    let mut fits = sites.fits(n);
    let mut balls = reserve("balls", n)?;
    let mut orbits = Orbits::new(sites, n);
    let mut put = |kind: usize, ball: Ball, fits: &mut Fits, balls: &mut Vec<Ball>| {
        let first = balls.len();
        let numbers = (first..first + sites.kinds[kind].len()).map(|j| j as u32).collect();
        balls.extend((0..sites.kinds[kind].len()).map(|k| sites.image(kind, k, &ball)));
        fits.take(kind);
        orbits.set(&Orbit { kind, balls: numbers });
    };
    let size = |k: &Kind| 1.0 / (k.len() as f64).powf(SIZE);
    let sizes: Vec<f64> = sites.kinds.iter().map(size).collect();
    let mut fit: Vec<bool> = (0..sizes.len()).map(|k| fits.fits(k)).collect();
    loop {
        // The gains known are no less than the true ones: the greatest is looked at anew, until
        // one remains the greatest (Minoux 1978).
        let score = |c: &Candidate| f64::from(c.gain) * sizes[c.kind];
        let best = candidates
            .iter_mut()
            .filter(|c| c.gain > 0 && fit[c.kind])
            .reduce(|a, b| if score(b) > score(a) { b } else { a });
        let Some(best) = best else { break };
        let gain = best.held.iter().zip(&open).map(|(h, o)| (h & o).count_ones()).sum();
        if gain < best.gain {
            best.gain = gain;
            continue;
        }
        put(best.kind, best.ball, &mut fits, &mut balls);
        open.iter_mut().zip(&best.held).for_each(|(o, h)| *o &= !h);
        best.gain = 0;
        fit.iter_mut().enumerate().for_each(|(k, f)| *f = fits.fits(k));
    }
    // Where all points are held before there are enough: orbits about more of the medial axis.
    while balls.len() < n {
        let kind = fits.any(random);
        let p = ground.dexels.points(1, random)?.pop().unwrap_or_default();
        let p = medial::ball(ground.field, p, ground.size).center;
        let least = Ball { center: p, radius: ground.radii.least };
        let ball = sites.grown(ground, kind, p).unwrap_or(least);
        put(kind, ball, &mut fits, &mut balls);
    }
    orbits.follow(&orbits.leads(n), &mut balls);
    Ok((balls, orbits))
}

impl Sites {
    /// The ball at the place of `kind` closest to `p`, a little larger than fits; none outside.
    pub(super) fn grown(&self, ground: &Ground, kind: usize, p: [f32; 3]) -> Option<Ball> {
        let at = |p: [f32; 3]| {
            let q = self.fold(kind, &Vec3::from(p.map(f64::from)));
            [0, 1, 2].map(|a| q[a] as f32)
        };
        let Ground { field, radii, limits, .. } = *ground;
        let center = at(p);
        let depth = -field.one(center);
        let radius = (depth * GROWN).max(radii.least).min(radii.most);
        let mut ball = Ball { center, radius };
        if !limits.none() {
            limits.hold(field, &radii, &mut ball);
            ball.center = at(ball.center);
        }
        (depth > 0.0).then_some(ball)
    }
}

/// Lies in no mirror plane and on no axis that anyone would think of.
const GENERIC: [f64; 3] = [0.521_379, 0.682_813, 0.511_877];

/// About `n` points to be covered, in chunks of 64: all brought by images to one part of space, as
/// an orbit holds a point when it holds its images. Most balls of an orbit are far from there.
fn points(sites: &Sites, dexels: &Dexels, n: usize, random: &mut Random) -> Result<Points> {
    let mut all = dexels.points(n, random)?;
    let way = Vec3::from(GENERIC);
    for point in &mut all {
        let p = Vec3::from(point.map(f64::from)) - sites.centre;
        let images = sites.kinds[0].images.iter().map(|m| m * p);
        let q = images.fold(p, |a, b| if b.dot(&way) > a.dot(&way) { b } else { a });
        *point = [0, 1, 2].map(|a| (sites.centre[a] + q[a]) as f32);
    }
    Points::new(vec![all.into_iter().map(|p| (p, 1)).collect()])
}

impl Sites {
    /// The points that any ball of an orbit holds.
    fn held(&self, points: &Points, chunks: usize, kind: usize, ball: &Ball) -> Result<Vec<u64>> {
        let mut bits = filled("points that an orbit holds", chunks, 0u64)?;
        for k in 0..self.kinds[kind].len() {
            points.held(&self.image(kind, k, ball), |c, held| bits[c] |= held);
        }
        Ok(bits)
    }
}

/// Which orbits still fit where so many balls are wanted.
#[derive(Debug, Clone)]
pub(super) struct Fits<'a> {
    sites: &'a Sites,
    left: usize,
    /// Whether the centre is free, where one orbit of one ball fits.
    centre: bool,
    /// Whether orbits without that one can be so many balls.
    sums: Vec<bool>,
}

impl Sites {
    /// The greatest number up to `n` that orbits can make up.
    pub(in super::super) fn most(&self, n: usize) -> usize {
        let fits = self.fits(n);
        (0..=n).rev().find(|&m| fits.can(m, true)).unwrap_or(0)
    }

    pub(super) fn fits(&self, n: usize) -> Fits<'_> {
        let mut sums = vec![false; n + 1];
        sums[0] = true;
        for m in 1..=n {
            sums[m] = self.kinds.iter().any(|k| !k.is_point() && m >= k.len() && sums[m - k.len()]);
        }
        Fits { sites: self, left: n, centre: true, sums }
    }
}

impl Fits<'_> {
    /// Whether `m` balls can be made up.
    fn can(&self, m: usize, centre: bool) -> bool {
        let point = || self.sites.kinds.iter().any(|k| k.is_point());
        self.sums[m] || (m > 0 && centre && self.sums[m - 1] && point())
    }

    /// The centre is not free.
    pub(super) fn without_centre(mut self) -> Self {
        self.centre = false;
        self
    }

    /// Whether what is left without an orbit of this kind can be made up.
    pub(super) fn fits(&self, kind: usize) -> bool {
        let kind = &self.sites.kinds[kind];
        let point = kind.is_point();
        kind.len() <= self.left
            && (self.centre || !point)
            && self.can(self.left - kind.len(), self.centre && !point)
    }

    pub(super) fn take(&mut self, kind: usize) {
        let kind = &self.sites.kinds[kind];
        self.left = self.left.saturating_sub(kind.len());
        self.centre &= !kind.is_point();
    }

    pub(super) fn left(&self) -> usize {
        self.left
    }

    /// A kind that fits, each size as likely as the others.
    pub(super) fn any(&self, random: &mut Random) -> usize {
        let kinds: Vec<usize> = (0..self.sites.kinds.len()).filter(|&k| self.fits(k)).collect();
        let sizes: Vec<&[usize]> = kinds
            .chunk_by(|&a, &b| self.sites.kinds[a].len() == self.sites.kinds[b].len())
            .collect();
        if sizes.is_empty() {
            return 0;
        }
        let size = sizes[random.below(sizes.len())];
        size[random.below(size.len())]
    }
}
