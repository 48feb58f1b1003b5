//! How far the surfaces of clump and target lie apart.

use super::bound::{Greatest, Range, greatest};
use super::pieces;
use super::union::Union;
use crate::error::{Result, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Body;
use crate::solid::nearest::{Nearest, Surface};
use std::f64::consts::PI;

/// Samples worked on together.
const CHUNK: usize = 128;
/// Greatest distances are found to within this, in the unit frame, …
const TOLERANCE: f64 = 1e-4;
/// … and this share of them (protrusion: a tenth of it), …
const SHARE: f64 = 0.01;
/// … or as near as this many pieces allow.
const PIECES: u64 = 40_000;
/// Targets of more triangles than this are only sampled.
const ROOTS: usize = 1 << 17;

/// What is measured against. A trait, so that tests can put formulas in its place.
pub(super) trait Target: Sync {
    fn nearest(&self, p: &Vec3) -> Nearest;
    fn contains(&self, p: &Vec3) -> bool;
}

impl Target for Surface {
    fn nearest(&self, p: &Vec3) -> Nearest {
        Surface::nearest(self, p)
    }
    fn contains(&self, p: &Vec3) -> bool {
        Surface::contains(self, p)
    }
}

/// Surface figures in the unit frame.
#[derive(Debug, Clone, Default)]
pub(super) struct SurfaceFigures {
    pub protrusion: f64,
    pub rms: f64,
    pub hausdorff: f64,
    pub roughness: f64,
    pub areas: Vec<f64>,
    pub never_exposed: u32,
    pub samples: u64,
    pub distances: u64,
    /// How far above `protrusion` and `hausdorff` the true ones may lie.
    pub slack: f64,
}

/// Sums over samples of a surface.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    weight: f64,
    squares: f64,
    angle_weight: f64,
    angles: f64,
    greatest: f64,
    count: u64,
}

impl Sums {
    fn add(&mut self, weight: f64, distance: f64) {
        self.weight += weight;
        self.squares += weight * distance * distance;
        self.greatest = self.greatest.max(distance);
        self.count += 1;
    }
    fn join(mut self, o: &Sums) -> Sums {
        self.weight += o.weight;
        self.squares += o.squares;
        self.angle_weight += o.angle_weight;
        self.angles += o.angles;
        self.greatest = self.greatest.max(o.greatest);
        self.count += o.count;
        self
    }
}

/// The figures of `union` against `target`, whose surface is that of `body`. `whole`: every
/// part of that surface is border of the inside (no walls within). `wanted`: samples of each
/// surface.
pub(super) fn surface(
    target: &impl Target,
    body: &Body,
    whole: bool,
    union: &Union,
    wanted: usize,
    run: &Run,
) -> Result<SurfaceFigures> {
    let n = union.spheres.len();
    let chunks = n.div_ceil(16);
    let areas = run
        .pool()
        .map(chunks, |c| (c * 16..((c + 1) * 16).min(n)).map(|i| union.area(i)).collect::<Vec<_>>())
        .concat();
    let exposed = run
        .pool()
        .map(chunks, |c| {
            let one = |i: usize| areas[i] > 0.0 || union.ever_exposed(i);
            (c * 16..((c + 1) * 16).min(n)).map(one).collect::<Vec<_>>()
        })
        .concat();
    let never_exposed = exposed.iter().filter(|e| !**e).count() as u32;
    run.check(0.0, "measuring the surface")?;

    let from_clump = clump_samples(target, union, &areas, wanted, run);
    run.check(0.0, "measuring the surface")?;
    let (area, triangles) = pieces::area(body);
    let from_target = target_samples(target, body, area, whole, union, wanted, run)?;
    run.check(0.0, "measuring the surface")?;

    let beyond = protrusion(target, union, run)?;
    let start = from_clump.greatest.max(beyond.value);
    let out = clump_to_target(target, union, &exposed, start, run)?;
    let start = from_target.greatest.max(out.value);
    let back = if whole && triangles <= ROOTS {
        target_to_clump(body, triangles, union, start, run)?
    } else {
        // Each point of the target is within about a sample's width of a sample.
        let spacing = (area / wanted as f64).sqrt();
        Greatest { value: start, slack: spacing, looked_at: 0 }
    };

    let weight = from_clump.weight + from_target.weight;
    let squares = from_clump.squares + from_target.squares;
    let root = |sum: f64, weight: f64| if weight > 0.0 { (sum / weight).sqrt() } else { 0.0 };
    Ok(SurfaceFigures {
        protrusion: beyond.value,
        rms: root(squares, weight),
        hausdorff: back.value,
        roughness: root(from_clump.angles, from_clump.angle_weight),
        areas,
        never_exposed,
        samples: from_clump.count + from_target.count,
        distances: from_clump.count + beyond.looked_at + out.looked_at,
        slack: beyond.slack.max(back.slack).max(out.slack),
    })
}

/// Samples of the exposed parts of the spheres: Fibonacci directions, as many to an area on
/// every sphere, weighted so that each sphere counts with its exact exposed area.
fn clump_samples(
    target: &impl Target,
    union: &Union,
    areas: &[f64],
    wanted: usize,
    run: &Run,
) -> Sums {
    let total: f64 = areas.iter().sum();
    let sums = run.pool().map(areas.len(), |i| {
        let s = &union.spheres[i];
        let mut sums = Sums::default();
        if areas[i] <= 0.0 {
            return sums;
        }
        let m = (4.0 * PI * s.radius * s.radius / total * wanted as f64).ceil();
        let m = (m as usize).clamp(16, 4 * wanted);
        let seen: Vec<Vec3> =
            (0..m).map(|k| direction(k, m)).filter(|d| union.exposed(i, d)).collect();
        let weight = areas[i] / seen.len().max(1) as f64;
        for d in &seen {
            let near = target.nearest(&(s.center + d * s.radius));
            sums.add(weight, near.distance);
            if near.normal != Vec3::zeros() {
                let angle = d.dot(&near.normal).clamp(-1.0, 1.0).acos();
                sums.angles += weight * angle * angle;
                sums.angle_weight += weight;
            }
        }
        sums
    });
    sums.iter().fold(Sums::default(), Sums::join)
}

/// Direction `k` of `n` on the Fibonacci sphere.
pub(super) fn direction(k: usize, n: usize) -> Vec3 {
    const GOLDEN: f64 = 2.399_963_229_728_653;
    let z = 1.0 - (2 * k + 1) as f64 / n as f64;
    let s = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = (GOLDEN * k as f64).sin_cos();
    Vec3::new(s * cos, s * sin, z)
}

fn target_samples(
    target: &impl Target,
    body: &Body,
    area: f64,
    whole: bool,
    union: &Union,
    wanted: usize,
    run: &Run,
) -> Result<Sums> {
    let mut points = reserve("surface samples", wanted + 1)?;
    pieces::samples(body, area, wanted, |p, normal| points.push((p, normal)));
    let weight = area / points.len().max(1) as f64;
    let sums = run.pool().map(points.len().div_ceil(CHUNK), |c| {
        let mut sums = Sums::default();
        for (p, normal) in points.iter().skip(c * CHUNK).take(CHUNK) {
            if whole || !target.contains(&(p + normal * 1e-7)) {
                sums.add(weight, union.nearest(p).1);
            }
        }
        sums
    });
    Ok(sums.iter().fold(Sums::default(), Sums::join))
}

/// A piece of a sphere's surface.
#[derive(Clone, Copy)]
enum Piece {
    Ball(u32),
    /// A spherical triangle of directions.
    Patch(u32, [Vec3; 3]),
}

impl Piece {
    fn split(&self) -> [Piece; 4] {
        match *self {
            Piece::Ball(i) => {
                let c = |x, y, z| Vec3::new(x, y, z) / 3f64.sqrt();
                let v =
                    [c(1.0, 1.0, 1.0), c(1.0, -1.0, -1.0), c(-1.0, 1.0, -1.0), c(-1.0, -1.0, 1.0)];
                [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
                    .map(|f: [usize; 3]| Piece::Patch(i, f.map(|k| v[k])))
            }
            Piece::Patch(i, [a, b, c]) => {
                let [x, y, z] = [a + b, b + c, c + a].map(|m| m.normalize());
                [[a, x, z], [x, b, y], [z, y, c], [x, y, z]].map(|t| Piece::Patch(i, t))
            }
        }
    }
}

/// Middle of a patch and the cosine of its angular radius.
fn disc(t: &[Vec3; 3]) -> (Vec3, f64) {
    let d = (t[0] + t[1] + t[2]).normalize();
    (d, t.iter().map(|v| v.dot(&d)).fold(1.0, f64::min))
}

/// The greatest distance from `q` to the points `center + radius d` with d within the angle of
/// cosine `cos` from `middle`.
fn farthest(center: &Vec3, radius: f64, middle: &Vec3, cos: f64, q: &Vec3) -> f64 {
    let w = center - q;
    let length = w.norm();
    if length == 0.0 {
        return radius;
    }
    let c = (middle.dot(&w) / length).clamp(-1.0, 1.0);
    // cos(max(θ − α, 0))
    let nearest =
        if c >= cos { 1.0 } else { c * cos + ((1.0 - c * c) * (1.0 - cos * cos)).max(0.0).sqrt() };
    (radius * radius + length * length + 2.0 * radius * length * nearest.clamp(-1.0, 1.0))
        .max(0.0)
        .sqrt()
}

/// How far the spheres reach beyond the target. The point of the surface nearest to one point
/// of a patch bounds the distance of all its points, to the second order of the patch's size.
pub(super) fn protrusion(target: &impl Target, union: &Union, run: &Run) -> Result<Greatest> {
    let value = |p: &Vec3| if target.contains(p) { 0.0 } else { target.nearest(p).distance };
    let roots = (0..union.spheres.len() as u32).map(Piece::Ball).collect();
    greatest(
        roots,
        0.0,
        [TOLERANCE, 0.1 * SHARE],
        PIECES,
        run,
        |piece| match *piece {
            Piece::Ball(i) => {
                let s = &union.spheres[i as usize];
                if union.swallowed[i as usize] {
                    return Range { attained: 0.0, bound: 0.0 };
                }
                let near = target.nearest(&s.center);
                let inside = target.contains(&s.center);
                let away = near.point - s.center;
                let (signed, way) =
                    if inside { (-near.distance, away) } else { (near.distance, -away) };
                let bound = s.radius + signed;
                if bound <= 0.0 || near.distance == 0.0 {
                    return Range { attained: 0.0, bound };
                }
                let far = s.center + way * (s.radius / near.distance);
                Range { attained: value(&far).max(signed), bound }
            }
            Piece::Patch(i, t) => {
                let s = &union.spheres[i as usize];
                let (d, cos) = disc(&t);
                let p = s.center + d * s.radius;
                let chord = s.radius * (2.0 * (1.0 - cos)).max(0.0).sqrt();
                let near = target.nearest(&p);
                if target.contains(&p) {
                    return Range { attained: 0.0, bound: chord - near.distance };
                }
                let farthest = farthest(&s.center, s.radius, &d, cos, &near.point);
                Range { attained: near.distance, bound: farthest.min(near.distance + chord) }
            }
        },
        Piece::split,
    )
}

/// The greatest distance of an exposed point from the target's surface.
fn clump_to_target(
    target: &impl Target,
    union: &Union,
    exposed: &[bool],
    start: f64,
    run: &Run,
) -> Result<Greatest> {
    // Clefts between spheres are where the clump falls short of the target: look there first.
    let arcs: Vec<_> = union.arcs.iter().flatten().collect();
    let clefts = run.pool().map(arcs.len().min(4096).div_ceil(CHUNK), |c| {
        let arcs = arcs.iter().skip(c * CHUNK).take(CHUNK.min(4096 - c * CHUNK));
        arcs.flat_map(|a| [a.point(0.0), a.point(0.5)])
            .map(|p| target.nearest(&p).distance)
            .fold(0.0, f64::max)
    });
    let start = clefts.into_iter().fold(start, f64::max);
    let seen = |i: &u32| exposed.get(*i as usize).is_some_and(|e| *e);
    let roots: Vec<_> = (0..union.spheres.len() as u32).filter(seen).map(Piece::Ball).collect();
    let most = PIECES + 20 * roots.len() as u64;
    greatest(
        roots,
        start,
        [TOLERANCE, SHARE],
        most,
        run,
        |piece| match *piece {
            Piece::Ball(i) => {
                let s = &union.spheres[i as usize];
                let near = target.nearest(&s.center);
                Range { attained: -1.0, bound: s.radius + near.distance }
            }
            Piece::Patch(i, t) => {
                let s = &union.spheres[i as usize];
                let (d, cos) = disc(&t);
                if union.hides(i as usize, &d, cos) {
                    return Range { attained: -1.0, bound: -1.0 };
                }
                let p = s.center + d * s.radius;
                let chord = s.radius * (2.0 * (1.0 - cos)).max(0.0).sqrt();
                let near = target.nearest(&p);
                let farthest = farthest(&s.center, s.radius, &d, cos, &near.point);
                let attained = if union.exposed(i as usize, &d) { near.distance } else { -1.0 };
                Range { attained, bound: farthest.min(near.distance + chord) }
            }
        },
        Piece::split,
    )
}

/// The greatest distance of a point of the target from the clump's surface.
fn target_to_clump(
    body: &Body,
    triangles: usize,
    union: &Union,
    start: f64,
    run: &Run,
) -> Result<Greatest> {
    let mut roots = reserve("triangles", triangles)?;
    pieces::for_each(body, |t| roots.push(t));
    greatest(
        roots,
        start,
        [TOLERANCE, SHARE],
        PIECES,
        run,
        |t: &[Vec3; 3]| {
            let c = (t[0] + t[1] + t[2]) / 3.0;
            let (x, distance) = union.nearest(&c);
            let reach = t.iter().map(|v| (v - c).norm()).fold(0.0, f64::max);
            let farthest = t.iter().map(|v| (v - x).norm()).fold(0.0, f64::max);
            Range { attained: distance, bound: farthest.min(distance + reach) }
        },
        |[a, b, c]| {
            let [x, y, z] = [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5];
            [[*a, x, z], [x, *b, y], [z, y, *c], [x, y, z]]
        },
    )
}
