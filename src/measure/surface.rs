//! How far the surfaces of clump and target lie apart.

use super::pieces;
use super::reach;
use super::union::Union;
use crate::error::{Result, fits, reserve};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::shape::Body;
use crate::solid::Solid;
use crate::solid::nearest::Surface;
use std::f64::consts::PI;

/// Samples worked on together.
const CHUNK: usize = 128;
/// Targets of more triangles than this are only sampled.
const ROOTS: usize = 1 << 17;
/// Directions tried for each sample of the clump, at most: where spheres hide each other deep.
const TRIES: f64 = 64.0;
/// Greatest distances are known to within this share of the equivalent diameter, where the
/// search may go on.
const COARSE: f64 = 0.004;
/// Bytes of a sample of the target, and of a piece of surface that is searched.
const SAMPLE: u64 = 48;
const PIECE: u64 = 256;

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

/// The figures of the union of `spheres` against `solid`. `wanted`: samples of each surface.
pub(super) fn surface(
    solid: &Solid,
    spheres: &[Sphere],
    wanted: usize,
    run: &Run,
) -> Result<SurfaceFigures> {
    let (target, body) = (solid.surface(run)?, solid.body());
    // Every part of the target's surface is border of its inside: there are no walls within.
    let whole = match body {
        Body::Mesh(m) => m.clean && solid.unit_moments().relative_error == 0.0,
        Body::Voxels(_) => true,
    };
    let (area, triangles) = pieces::area(body);
    let whole_search = whole && triangles <= ROOTS;
    let n = spheres.len();
    let room = solid.memory_limit().saturating_sub(solid.bytes());
    let roots = if whole_search { triangles as u64 } else { 0 };
    let own = wanted as u64 * SAMPLE + (roots + 20 * n as u64) * PIECE;
    fits(
        format_args!("measuring the surfaces of {n} spheres and {triangles} triangles"),
        own,
        room,
    )?;
    let union = &Union::new(spheres, room - own, run)?;
    run.count(|c| {
        c.peak_bytes = c.peak_bytes.max(solid.bytes() + union.bytes() + own);
    });
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
    let from_target = target_samples(target, body, area, whole, union, wanted, run)?;
    run.check(0.0, "measuring the surface")?;

    let diameter = (6.0 / PI * solid.unit_moments().volume).cbrt();
    let coarse = COARSE * diameter;
    let beyond = reach::protrusion(target, union, coarse, run)?;
    let start = from_clump.greatest.max(beyond.value);
    let out = reach::clump_to_target(target, union, &exposed, start, coarse, run)?;
    let start = from_target.greatest.max(out.value);
    let back = if whole_search {
        Some(reach::target_to_clump(body, triangles, union, start, coarse, run)?)
    } else {
        None
    };
    // Each point of the target is within about a sample's width of a sample.
    let sampled = (area / wanted as f64).sqrt();
    let slack = back.map_or(sampled, |b| b.slack);

    let weight = from_clump.weight + from_target.weight;
    let squares = from_clump.squares + from_target.squares;
    let root = |sum: f64, weight: f64| if weight > 0.0 { (sum / weight).sqrt() } else { 0.0 };
    Ok(SurfaceFigures {
        protrusion: beyond.value,
        rms: root(squares, weight),
        hausdorff: back.map_or(start, |b| b.value),
        roughness: root(from_clump.angles, from_clump.angle_weight),
        areas,
        never_exposed,
        samples: from_clump.count + from_target.count,
        distances: from_clump.count + beyond.looked_at + out.looked_at,
        slack: beyond.slack.max(out.slack).max(slack),
    })
}

/// Samples of the exposed parts of the spheres: Fibonacci directions, as many to an area on
/// every sphere, weighted so that each sphere counts with its exact exposed area.
fn clump_samples(target: &Surface, union: &Union, areas: &[f64], wanted: usize, run: &Run) -> Sums {
    let total: f64 = areas.iter().sum();
    let whole = |i: usize| 4.0 * PI * union.spheres[i].radius.powi(2);
    // Hidden directions are tried in vain: fewer of all where most are.
    let tried: f64 =
        (0..areas.len()).filter(|&i| areas[i] > 0.0).map(|i| whole(i) / total.max(areas[i])).sum();
    let density = wanted as f64 * (TRIES / tried.max(TRIES));
    let sums = run.pool().map(areas.len(), |i| {
        let s = &union.spheres[i];
        let mut sums = Sums::default();
        if areas[i] <= 0.0 {
            return sums;
        }
        let m = ((whole(i) / total * density).ceil() as usize).clamp(16, 4 * wanted);
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
    target: &Surface,
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
