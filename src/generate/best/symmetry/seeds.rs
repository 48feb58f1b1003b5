//! The start of a symmetric clump: a greedy cover by whole orbits of grown medial balls.

use super::super::dexels::Dexels;
use super::super::effort::Plan;
use super::super::medial;
use super::super::random::Random;
use super::super::seeds::GROWN;
use super::super::state::Ground;
use super::orbits::{Orbit, Orbits, Sites};
use crate::error::{Result, reserve};
use crate::generate::ball::Ball;
use crate::math::Vec3;

/// Fewest points to be covered and fewest candidates.
const POINTS: usize = 500;
const CANDIDATES: usize = 150;
/// Of its radius: how far a ball may be from a plane, line or point to be tried on it as well.
const SNAP: f64 = 1.0;
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
    let points = Points::new(ground.dexels, count(plan.points, POINTS), random)?;
    let mut candidates = Vec::new();
    let starts = ground.dexels.points(count(plan.candidates, CANDIDATES), random)?;
    for p in starts.into_iter().chain([[0, 1, 2].map(|a| sites.centre[a] as f32)]) {
        let ball = medial::ball(ground.field, p, ground.size);
        let center = Vec3::from(ball.center.map(f64::from));
        for kind in 0..sites.kinds.len() {
            let off = (sites.fold(kind, &center) - center).norm();
            let Some(ball) = sites.grown(ground, kind, ball.center) else { continue };
            if off > SNAP * f64::from(ball.radius) {
                continue;
            }
            let held = points.held(sites, kind, &ball);
            let gain = held.iter().map(|w| w.count_ones()).sum();
            candidates.push(Candidate { ball, kind, held, gain });
        }
    }
    let mut fits = sites.fits(n);
    let mut open = points.all();
    let mut balls = reserve("balls", n)?;
    let mut orbits = Orbits::new(sites, n);
    let mut put = |kind: usize, ball: Ball, fits: &mut Fits, balls: &mut Vec<Ball>| {
        let first = balls.len();
        let numbers = (first..first + sites.kinds[kind].len()).map(|j| j as u32).collect();
        balls.extend((0..sites.kinds[kind].len()).map(|k| sites.image(kind, k, &ball)));
        fits.take(kind);
        orbits.set(&Orbit { kind, balls: numbers });
    };
    loop {
        // The gains known are no less than the true ones: the greatest is looked at anew, until
        // one remains the greatest (Minoux 1978).
        let score =
            |c: &Candidate| f64::from(c.gain) / (sites.kinds[c.kind].len() as f64).powf(SIZE);
        let best = candidates
            .iter_mut()
            .filter(|c| c.gain > 0 && fits.fits(c.kind))
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

/// Points to be covered, by their first coordinate.
struct Points(Vec<[f32; 3]>);

impl Points {
    fn new(dexels: &Dexels, n: usize, random: &mut Random) -> Result<Points> {
        let mut all = dexels.points(n, random)?;
        all.sort_by(|p, q| p[0].total_cmp(&q[0]));
        Ok(Points(all))
    }

    /// A bit for each.
    fn all(&self) -> Vec<u64> {
        self.0.chunks(64).map(|c| u64::MAX >> (64 - c.len())).collect()
    }

    /// Those that any ball of an orbit holds.
    fn held(&self, sites: &Sites, kind: usize, ball: &Ball) -> Vec<u64> {
        let mut bits = vec![0; self.0.len().div_ceil(64)];
        for k in 0..sites.kinds[kind].len() {
            let Ball { center: [x, y, z], radius } = sites.image(kind, k, ball);
            let first = self.0.partition_point(|p| p[0] < x - radius);
            for (i, p) in (first..).zip(&self.0[first..]).take_while(|(_, p)| p[0] <= x + radius) {
                let d2 = (p[0] - x).powi(2) + (p[1] - y).powi(2) + (p[2] - z).powi(2);
                bits[i / 64] |= u64::from(d2 <= radius * radius) << (i % 64);
            }
        }
        bits
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
