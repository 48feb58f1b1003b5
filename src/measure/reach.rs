//! The greatest distances between clump and target, by branch and bound.

use super::bound::{Aim, Greatest, Range, greatest};
use super::union::Union;
use crate::error::{Result, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Body;
use crate::solid::nearest::Surface;

/// Arcs looked at together.
const CHUNK: usize = 128;
/// Greatest distances are found to within this, in the unit frame, …
const TOLERANCE: f64 = 1e-4;
/// … and this share of them (protrusion: a tenth of it), …
const SHARE: f64 = 0.01;

/// … or as near as this many pieces allow.
fn pieces(spheres: usize) -> u64 {
    40_000 + 20 * spheres as u64
}

/// A piece of a sphere's surface.
#[derive(Clone, Copy)]
enum Piece {
    Ball(u32),
    /// A spherical triangle of directions.
    Patch(u32, [Vec3; 3]),
}

impl Piece {
    fn split(&self, out: &mut Vec<Piece>) {
        out.extend(match *self {
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
        });
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

/// How far the clump reaches beyond the target.
pub(super) fn protrusion(
    target: &Surface,
    union: &Union,
    coarse: f64,
    run: &Run,
) -> Result<Greatest> {
    let on = on_spheres(target, union, coarse, run)?;
    // What lies outside has its greatest distance on a sphere, or where the target closes around
    // it: a ball may fill a cavity or a pocket whose walls hold the whole of the sphere.
    let slack = TOLERANCE.max(0.1 * SHARE * on.value).max(0.5 * coarse);
    let spheres = union.spheres;
    let bounds = run
        .pool()
        .map(spheres.len().div_ceil(CHUNK), |c| {
            let part = spheres.iter().skip(c * CHUNK).take(CHUNK);
            part.map(|s| s.radius + target.signed_distance(&s.center)).collect::<Vec<f64>>()
        })
        .concat();
    let mut roots = reserve("spheres", spheres.len())?;
    let mut left = on.slack;
    for (by, (s, bound)) in spheres.iter().zip(bounds).enumerate() {
        if union.swallowed[by] {
            continue;
        }
        if bound > on.value + slack {
            roots.push(Block { center: s.center, half: s.radius, by: by as u32 });
        } else {
            left = left.max(bound - on.value);
        }
    }
    let looked_at = on.looked_at + union.spheres.len() as u64;
    let aim = Aim { length: slack, share: 0.1 * SHARE, most: pieces(roots.len()), coarse };
    let within = greatest(
        roots,
        on.value,
        aim,
        run,
        |block| {
            let s = &union.spheres[block.by as usize];
            let w = block.center - s.center;
            // Nothing of the block is in the ball.
            let gap = w.abs().add_scalar(-block.half).sup(&Vec3::zeros()).norm();
            if gap > s.radius {
                return Range { attained: -1.0, bound: -1.0 };
            }
            let d = target.signed_distance(&block.center);
            let attained = if w.norm() <= s.radius { d.max(0.0) } else { -1.0 };
            Range { attained, bound: d + 3f64.sqrt() * block.half }
        },
        |block, out| {
            let half = 0.5 * block.half;
            out.extend((0..8).map(|i| {
                let side = |k: usize| if i >> k & 1 == 1 { half } else { -half };
                let center = block.center + Vec3::new(side(0), side(1), side(2));
                Block { center, half, by: block.by }
            }));
        },
    )?;
    Ok(Greatest {
        value: within.value,
        slack: if within.looked_at > 0 { within.slack.max(left) } else { left },
        looked_at: looked_at + within.looked_at,
    })
}

/// A cube of points in the ball `by`.
#[derive(Clone, Copy)]
struct Block {
    center: Vec3,
    half: f64,
    by: u32,
}

/// How far the spheres' surfaces and centres reach beyond the target. The point of the surface
/// nearest to one point of a patch bounds the distance of all its points, to the second order of
/// the patch's size.
fn on_spheres(target: &Surface, union: &Union, coarse: f64, run: &Run) -> Result<Greatest> {
    let value = |p: &Vec3| if target.contains(p) { 0.0 } else { target.nearest(p).distance };
    let roots: Vec<_> = (0..union.spheres.len() as u32).map(Piece::Ball).collect();
    let most = pieces(roots.len());
    greatest(
        roots,
        0.0,
        Aim { length: TOLERANCE, share: 0.1 * SHARE, most, coarse },
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
pub(super) fn clump_to_target(
    target: &Surface,
    union: &Union,
    exposed: &[bool],
    start: f64,
    coarse: f64,
    run: &Run,
) -> Result<Greatest> {
    // Clefts between spheres are where the clump falls short of the target: look there first.
    let count: usize = union.arcs.iter().map(Vec::len).sum();
    let arcs: Vec<_> = union.arcs.iter().flatten().step_by(count.div_ceil(4096).max(1)).collect();
    let clefts = run.pool().map(arcs.len().div_ceil(CHUNK), |c| {
        let arcs = arcs.iter().skip(c * CHUNK).take(CHUNK);
        arcs.flat_map(|a| [a.point(0.0), a.point(0.5)])
            .map(|p| target.nearest(&p).distance)
            .fold(0.0, f64::max)
    });
    let start = clefts.into_iter().fold(start, f64::max);
    let seen = |i: &u32| exposed.get(*i as usize).is_some_and(|e| *e);
    let roots: Vec<_> = (0..union.spheres.len() as u32).filter(seen).map(Piece::Ball).collect();
    let most = pieces(roots.len());
    greatest(
        roots,
        start,
        Aim { length: TOLERANCE, share: SHARE, most, coarse },
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
pub(super) fn target_to_clump(
    body: &Body,
    triangles: usize,
    union: &Union,
    start: f64,
    coarse: f64,
    run: &Run,
) -> Result<Greatest> {
    let mut roots = reserve("triangles", triangles)?;
    super::pieces::for_each(body, |t| roots.push(t));
    greatest(
        roots,
        start,
        Aim { length: TOLERANCE, share: SHARE, most: pieces(union.spheres.len()), coarse },
        run,
        |t: &[Vec3; 3]| {
            let (attained, bound) = union.reach(t);
            Range { attained, bound }
        },
        |[a, b, c], out| {
            let [x, y, z] = [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5];
            out.extend([[*a, x, z], [x, *b, y], [z, y, *c], [x, y, z]]);
        },
    )
}
