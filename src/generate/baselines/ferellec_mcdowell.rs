//! The greatest balls that touch the surface from inside at its points (Ferellec and McDowell
//! 2010).
//!
//! The source draws vertices at random and lets each ball grow step by step until a vertex lies
//! in it. Here the points are spread over the surface by area, whatever the triangles; a ball
//! shrinks to the exact surface instead of growing to vertices (Ma, Bae and Choi 2012); and the
//! ball is taken next that comes near most of the points that none is near yet.

use super::super::GenerateOptions;
use super::super::lazy::Lazy;
use super::super::surface_fit::points::Points;
use super::ground::Ground;
use super::growing::Growing;
use crate::clump::{Clump, Stopped};
use crate::error::{Result, filled, push};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::shape::Body;
use crate::solid::Solid;

/// How near counts as near: over the equivalent diameter, first and least; halved in between.
const NEAR: (f64, f64) = (0.04, 1e-4);
/// … when a ball gains less than this part of the points, until it is about [`BEYOND`].
const FEW: f64 = 0.01;
/// While a ball shrinks it may reach beyond the surface by so many cells, or the edges of
/// triangles would keep it small.
const BEYOND: f64 = 0.1;
/// The same along the slope of the distance over so many cells, where the surface has steps: its
/// normals then say little of the body. Taken where the cosine to the normal is less.
const STEPPED: f64 = 0.9;
/// … and in voxels also by so many cells: at a point on a step, other steps are as far within.
const STEPS_APART: f64 = 3.0;
const OVER: f64 = 4.0;
const ALIKE: f64 = 0.95;
/// Most steps of shrinking.
const STEPS: usize = 40;
/// Points worked on together.
const CHUNK: usize = 64;

/// Makes a clump.
pub(in super::super) fn ferellec_mcdowell(
    solid: &Solid,
    options: &GenerateOptions,
    run: &Run,
) -> Result<Clump> {
    super::check(options, "ferellec-mcdowell")?;
    run.check(0.0, "spreading points over the surface")?;
    let ground = Ground::new(solid, options, run)?;
    let room = solid.memory_limit().saturating_sub(solid.bytes());
    let points = Points::new(solid.body(), ground.surface, room, run)?;
    run.check(0.1, "growing balls from points of the surface")?;
    let tangents = Tangents::new(&ground, run)?;
    let chunks = points.at.len().div_ceil(CHUNK);
    let found = run.pool().map(chunks, |c| {
        let some = points.at.iter().zip(&points.normals).skip(c * CHUNK).take(CHUNK);
        some.flat_map(|(p, n)| tangents.at(p, n)).flatten().collect::<Vec<Sphere>>()
    });
    let mut balls = Vec::new();
    for s in found.into_iter().flatten().filter(|s| s.radius >= ground.least) {
        push("balls", &mut balls, s)?;
    }
    run.count(|c| c.spheres_tried += points.at.len() as u64);
    let size = (6.0 * solid.unit_moments().volume / std::f64::consts::PI).cbrt();
    let mut growing = Growing::new(&ground, options)?;
    let mut near = NEAR.0 * size;
    let stopped = 'all: loop {
        let mut left = points.at.clone();
        for s in growing.spheres() {
            left.retain(|p| !is_near(s, near, p));
        }
        let few = match 0.5 * near > BEYOND * ground.cell {
            true => (FEW * points.at.len() as f64) as u64,
            false => 0,
        };
        let mut lazy = Lazy::new(&filled("the order of balls", balls.len(), u64::MAX)?)?;
        loop {
            if let Some(stopped) = growing.done(run) {
                break 'all stopped;
            }
            let gain = |i: usize| balls.get(i).map_or(0, |s| gain_of(s, near, &left));
            let Some((i, gained)) = lazy.best(gain) else { break };
            let Some(s) = balls.get(i) else { break };
            if !growing.spheres().is_empty() && gained < few {
                break;
            }
            left.retain(|p| !is_near(s, near, p));
            growing.add(*s)?;
        }
        if near <= NEAR.1 * size {
            break if ground.least > 0.0 { Stopped::Radius } else { Stopped::Exhausted };
        }
        near = (0.5 * near).max(NEAR.1 * size);
    };
    growing.end(stopped, "a ball touches every point of the surface that one can touch", run)
}

fn is_near(s: &Sphere, near: f64, p: &Vec3) -> bool {
    let reach = s.radius + near;
    (p - s.center).norm_squared() <= reach * reach
}

fn gain_of(s: &Sphere, near: f64, left: &[Vec3]) -> u64 {
    left.iter().filter(|p| is_near(s, near, p)).count() as u64
}

/// What balls at points of the surface are made with.
struct Tangents<'a> {
    ground: &'a Ground<'a>,
    distance: &'a [f32],
    /// No ball inside is greater.
    most: f64,
}

impl<'a> Tangents<'a> {
    fn new(ground: &'a Ground, run: &Run) -> Result<Tangents<'a>> {
        let distance = ground.solid.distance(run)?;
        let deepest = distance.iter().fold(0.0f32, |m, d| m.max(-d));
        let most = f64::from(deepest) + ground.solid.grid().spacing.norm();
        Ok(Tangents { ground, distance, most })
    }

    /// The greatest balls at `p` along the normal and, where it differs, the slope; in voxels
    /// one more along the slope that minds no steps.
    fn at(&self, p: &Vec3, n: &Vec3) -> [Option<Sphere>; 3] {
        let slope = self.slope(p, OVER * self.ground.cell);
        let other = slope.filter(|s| s.dot(n) < ALIKE);
        let stepped = slope.filter(|_| matches!(self.ground.solid.body(), Body::Voxels(_)));
        [
            self.touching(p, n, BEYOND),
            other.and_then(|s| self.touching(p, &s, STEPPED)),
            stepped.and_then(|s| self.touching(p, &s, STEPS_APART)),
        ]
    }

    /// Direction in which the distance grows.
    fn slope(&self, p: &Vec3, over: f64) -> Option<Vec3> {
        let grid = self.ground.solid.grid();
        let slope = Vec3::from_fn(|a, _| {
            let mut way = Vec3::zeros();
            way[a] = over;
            grid.trilinear(self.distance, &(p + way)) - grid.trilinear(self.distance, &(p - way))
        });
        let norm = slope.norm();
        (norm > 0.1 * over).then(|| slope / norm)
    }

    /// The greatest ball that touches the surface from inside at `p`, with the outward normal `n`.
    fn touching(&self, p: &Vec3, n: &Vec3, beyond: f64) -> Option<Sphere> {
        let ground = self.ground;
        let slack = ground.tolerance.max(beyond * ground.cell);
        let mut radius = self.most + slack;
        for _ in 0..STEPS {
            let Some(q) = ground.nearer(&(p - n * radius), radius - slack) else { break };
            let v = q - p;
            // The ball of which q lies at the slack within: |p − r n − q| = r − slack.
            let along = -n.dot(&v) - slack;
            if along <= 1e-12 {
                break;
            }
            let smaller = 0.5 * (v.norm_squared() - slack * slack) / along;
            if smaller >= radius * (1.0 - 1e-9) {
                break;
            }
            radius = smaller;
        }
        let center = p - n * radius;
        let depth = ground.depth(&center);
        (depth > 0.0).then(|| Sphere::new(center, depth + ground.tolerance))
    }
}
