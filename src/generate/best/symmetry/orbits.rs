//! Which balls of a clump are images of which. The first of an orbit leads: it alone is refined,
//! on the line or plane of its kind, and the others are its images.

use super::group::{Group, Matrix};
use super::kinds::Kind;
use crate::generate::ball::Ball;
use crate::math::{Sphere, UnitFrame, Vec3};

/// Fewest columns.
const COLUMNS: usize = 1000;

/// A group about a centre, unit frame, and the kinds of places that it makes.
#[derive(Debug, Clone, PartialEq)]
pub(in super::super) struct Sites {
    pub(super) centre: Vec3,
    pub(super) kinds: Vec<Kind>,
    /// Number of elements.
    pub(super) order: usize,
    /// Of the target's whole symmetry.
    pub(super) found: usize,
}

/// An orbit: its kind and the numbers of its balls.
#[derive(Debug, Clone, PartialEq)]
pub(in super::super) struct Orbit {
    pub kind: usize,
    pub balls: Vec<u32>,
}

/// The orbits of a clump. Without a group every ball leads itself.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct Orbits<'a> {
    sites: Option<&'a Sites>,
    /// For each ball, the first of its orbit.
    lead: Vec<u32>,
    /// For each ball that leads, its orbit; of the others, what it was.
    orbits: Vec<Orbit>,
}

impl Sites {
    pub(in super::super) fn order(&self) -> usize {
        self.order
    }

    /// How many columns do as well as `all` do where nothing is the image of anything.
    pub(in super::super) fn columns(&self, all: usize) -> usize {
        (all / self.order).max(COLUMNS.min(all))
    }

    pub(super) fn new(group: &Group, centre: Vec3, found: usize) -> Sites {
        Sites { centre, kinds: group.kinds(), order: group.len(), found }
    }

    /// The place of `kind` that is closest to `p`.
    pub(super) fn fold(&self, kind: usize, p: &Vec3) -> Vec3 {
        self.centre + self.kinds[kind].projector * (p - self.centre)
    }

    /// Image `k` of a ball of that kind.
    pub(super) fn image(&self, kind: usize, k: usize, ball: &Ball) -> Ball {
        self.moved(&self.kinds[kind].images[k], ball)
    }

    /// The ball of which this is image `k`.
    fn first(&self, kind: usize, k: usize, ball: &Ball) -> Ball {
        self.moved(&self.kinds[kind].images[k].transpose(), ball)
    }

    fn moved(&self, by: &Matrix, ball: &Ball) -> Ball {
        let q = self.centre + by * (Vec3::from(ball.center.map(f64::from)) - self.centre);
        Ball { center: [0, 1, 2].map(|a| q[a] as f32), ..*ball }
    }
}

impl<'a> Orbits<'a> {
    /// No ball yet.
    pub(super) fn new(sites: &'a Sites, n: usize) -> Orbits<'a> {
        let none = Orbit { kind: 0, balls: Vec::new() };
        Orbits { sites: Some(sites), lead: (0..n as u32).collect(), orbits: vec![none; n] }
    }

    pub(in super::super) fn sites(&self) -> Option<&'a Sites> {
        self.sites
    }

    /// The orbit is this from now on.
    pub(in super::super) fn set(&mut self, orbit: &Orbit) {
        let Some(&first) = orbit.balls.first() else { return };
        orbit.balls.iter().for_each(|&j| self.lead[j as usize] = first);
        self.orbits[first as usize].clone_from(orbit);
    }

    /// The orbits of the balls `of` are as in `other` again.
    pub(in super::super) fn restore(&mut self, other: &Orbits<'a>, of: &[u32]) {
        if self.sites.is_some() {
            for &j in of {
                self.lead[j as usize] = other.lead[j as usize];
                self.orbits[j as usize].clone_from(&other.orbits[j as usize]);
            }
        }
    }

    /// The ball that leads ball `i`.
    pub(in super::super) fn lead(&self, i: u32) -> u32 {
        self.lead.get(i as usize).copied().unwrap_or(i)
    }

    /// Balls that lead, of `n`.
    pub(in super::super) fn leads(&self, n: usize) -> Vec<u32> {
        (0..n as u32).filter(|&i| self.lead(i) == i).collect()
    }

    /// The orbit that ball `i` leads.
    pub(in super::super) fn orbit(&self, i: u32) -> Option<&Orbit> {
        self.orbits.get(i as usize)
    }

    /// All balls of the orbits that `of` lead.
    pub(in super::super) fn balls(&self, of: &[u32]) -> Vec<u32> {
        if self.sites.is_none() {
            return of.to_vec();
        }
        of.iter().flat_map(|&i| &self.orbits[i as usize].balls).copied().collect()
    }

    /// How many balls `i` leads.
    pub(in super::super) fn size(&self, i: u32) -> usize {
        self.orbit(i).map_or(1, |o| o.balls.len())
    }

    /// Takes from a change of ball `i` what would lead it off its place.
    #[inline(always)]
    pub(in super::super) fn hold(&self, i: u32, change: &mut [f32; 4]) {
        if let (Some(sites), Some(orbit)) = (self.sites, self.orbit(i)) {
            let [x, y, z, _] = change.map(f64::from);
            let held = sites.kinds[orbit.kind].projector * Vec3::new(x, y, z);
            (0..3).for_each(|a| change[a] = held[a] as f32);
        }
    }

    /// Puts the balls `of`, which lead, to the closest places of their kinds, and all others of
    /// their orbits to where these have their images.
    pub(in super::super) fn follow(&self, of: &[u32], balls: &mut [Ball]) {
        let Some(sites) = self.sites else { return };
        for &i in of {
            let orbit = &self.orbits[i as usize];
            let ball = &mut balls[i as usize];
            let p = sites.fold(orbit.kind, &Vec3::from(ball.center.map(f64::from)));
            ball.center = [0, 1, 2].map(|a| p[a] as f32);
            let ball = *ball;
            for (k, &j) in orbit.balls.iter().enumerate().skip(1) {
                balls[j as usize] = sites.image(orbit.kind, k, &ball);
            }
        }
    }

    /// Changes whole orbits where single balls differ from `before`.
    pub(in super::super) fn even(&self, before: &[Ball], balls: &mut [Ball]) {
        let Some(sites) = self.sites else { return };
        for lead in self.leads(before.len()) {
            let orbit = &self.orbits[lead as usize];
            let changed = |&j: &u32| balls[j as usize] != before[j as usize];
            if let Some(k) = orbit.balls.iter().position(changed) {
                let ball = balls[orbit.balls[k] as usize];
                balls[lead as usize] = sites.first(orbit.kind, k, &ball);
                self.follow(&[lead], balls);
            }
        }
    }

    /// The orbit that ball `i` leads with its sphere, unit frame, in the caller's frame: images of
    /// each other to the last digit that their coordinates have.
    pub(in super::super) fn images(&self, i: u32, s: Sphere, frame: &UnitFrame) -> Vec<Sphere> {
        let (Some(sites), Some(orbit)) = (self.sites, self.orbit(i)) else {
            return vec![frame.sphere_to_input(&s)];
        };
        let kind = &sites.kinds[orbit.kind];
        let centre = frame.to_input(&sites.centre);
        let p = kind.projector * (s.center - sites.centre);
        let radius = s.radius * frame.scale;
        let place = |m: &Matrix| centre + frame.direction_to_input(&(m * p)) * frame.scale;
        let image = |m: &Matrix| Sphere::new(place(m), radius);
        kind.images.iter().map(image).collect()
    }

    /// The same with a sphere in the caller's frame.
    pub(in super::super) fn images_of(&self, i: u32, s: Sphere, frame: &UnitFrame) -> Vec<Sphere> {
        match self.sites {
            None => vec![s],
            Some(_) => self.images(i, frame.sphere_to_unit(&s), frame),
        }
    }
}
