//! The moves of symmetric clumps: one orbit or two are taken out, and as many balls are put in
//! elsewhere, in the same or in other orbits.

use super::super::moves::{Fans, Mover, PLACES};
use super::super::refine::Schedule;
use super::super::state::State;
use super::orbits::{Orbit, Sites};
use crate::generate::ball::Ball;
use crate::generate::balls::medial;
use crate::generate::balls::random::Random;
use crate::math::Vec3;

/// Part of the moves that take out a second orbit.
const TWO: f64 = 0.3;
/// The second is the one of so many that is worth least.
const AMONG: usize = 3;
/// Part of the moves that put in orbits as large as those taken out.
const SAME: f64 = 0.5;
/// Places looked at for one on a plane or line, of which the closest to it is taken.
const CLOSEST: usize = 3;

impl Mover<'_> {
    /// Takes out the orbit that ball `i` leads, perhaps another one, and puts in others: `of`
    /// is then who leads these, `old` who led. Returns by how much the cost rises, and by how much
    /// it rose before anything was put in.
    pub(in super::super) fn replant(
        &mut self,
        sites: &Sites,
        state: &State,
        fans: &Fans,
        of: &mut Vec<u32>,
        random: &mut Random,
    ) -> [f64; 2] {
        let leads = state.orbits.leads(state.balls.len());
        if random.unit() < TWO {
            let other = (0..AMONG)
                .map(|_| leads[random.below(leads.len())])
                .filter(|j| !of.contains(j))
                .reduce(
                    |a, b| {
                        if state.worth(b as usize) < state.worth(a as usize) { b } else { a }
                    },
                );
            of.extend(other);
        }
        let old: Vec<&Orbit> = of.iter().filter_map(|&i| state.orbits.orbit(i)).collect();
        let free: Vec<u32> = old.iter().flat_map(|o| &o.balls).copied().collect();
        let stays = |i: &u32| !of.contains(i);
        let centre = leads.iter().filter(|i| stays(i)).filter_map(|&i| state.orbits.orbit(i));
        let mut fits = sites.fits(free.len());
        if centre.into_iter().any(|o| sites.kinds[o.kind].is_point()) {
            fits = fits.without_centre();
        }
        let mut sizes: Vec<usize> = Vec::new();
        if random.unit() < SAME {
            sizes.extend(old.iter().map(|o| o.balls.len()));
        } else {
            while fits.left() > 0 {
                let kind = fits.any(random);
                sizes.push(sites.kinds[kind].len());
                fits.take(kind);
            }
        }
        sizes.sort_by(|a, b| b.cmp(a));
        let stood = state.balls[of[0] as usize].center;
        free.iter().for_each(|&j| self.trial[j as usize].radius = 0.0);
        let without = self.cost(state, &free);
        let mut lost = without;
        let mut rest = free.as_slice();
        of.clear();
        for (k, size) in sizes.into_iter().enumerate() {
            let (balls, others) = rest.split_at(size.min(rest.len()));
            rest = others;
            let Some(&first) = balls.first() else { break };
            of.push(first);
            let mut best: Option<(f64, Ball, Orbit)> = None;
            for place in 0..PLACES {
                // Where the old orbit stood, other orbits are tried as well.
                let same = place == 0 && size != state.orbits.size(first) && k == 0;
                let p = if same { Some(stood) } else { None };
                let Some((kind, p)) = self.place(sites, state, size, p, random) else { continue };
                let orbit = Orbit { kind, balls: balls.to_vec() };
                self.orbits.set(&orbit);
                let (field, size) = (state.ground.field, state.ground.size);
                let to = medial::ball(field, p, size).center;
                let t = random.unit() as f32;
                let p = std::array::from_fn(|a| p[a] + t * (to[a] - p[a]));
                let Some(ball) = sites.grown(&state.ground, kind, p) else { continue };
                self.trial[first as usize] = ball;
                self.orbits.follow(&[first], &mut self.trial);
                let schedule = Schedule { iterations: 4, from: 4.0 * state.width, to: state.width };
                self.refine(state, &schedule, &fans.few, &[first], random);
                let cost = self.cost(state, &free);
                if best.as_ref().is_none_or(|b| cost < b.0) {
                    best = Some((cost, self.trial[first as usize], orbit));
                }
            }
            let (cost, ball, orbit) = best.unwrap_or_else(|| {
                let kind = sites.kinds.iter().position(|k| k.len() == size).unwrap_or(0);
                (
                    f64::MAX,
                    Ball { center: stood, radius: 0.0 },
                    Orbit { kind, balls: balls.to_vec() },
                )
            });
            lost = cost;
            self.orbits.set(&orbit);
            self.trial[first as usize] = ball;
            self.orbits.follow(&[first], &mut self.trial);
        }
        [lost, without]
    }

    /// A place for an orbit of this size: where `p` is or at a gap; and the kind it is of.
    fn place(
        &mut self,
        sites: &Sites,
        state: &State,
        size: usize,
        p: Option<[f32; 3]>,
        random: &mut Random,
    ) -> Option<(usize, [f32; 3])> {
        let tries = if p.is_some() || size == sites.order { 1 } else { CLOSEST };
        let mut best: Option<(f64, usize, [f32; 3])> = None;
        for _ in 0..tries {
            let p = p.or_else(|| state.gap(random, &mut self.look, &mut self.gaps));
            let Some(p) = p.map(|p| Vec3::from(p.map(f64::from))) else { continue };
            for (kind, k) in sites.kinds.iter().enumerate() {
                if k.len() != size {
                    continue;
                }
                let q = sites.fold(kind, &p);
                let off = (q - p).norm();
                if best.is_none_or(|b| off < b.0) {
                    best = Some((off, kind, [0, 1, 2].map(|a| q[a] as f32)));
                }
            }
        }
        best.map(|(_, kind, p)| (kind, p))
    }
}
