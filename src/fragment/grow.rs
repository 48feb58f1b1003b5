//! Spheres that grow after a break: inscribed ones leave part of the fragment empty, which would
//! make a bed more porous at once. In steps of the host they grow to the radii of least mismatch,
//! as far as siblings and neighbours leave room.

use super::parent::{Parent, local};
use super::reclump::walls;
use super::region::Region;
use super::room::{Ball, Parts, Room};
use crate::error::{Error, Result, collected, figure, reserve};
use crate::math::{Sphere, Vec3};
use crate::run::Run;

/// Directions on a sphere.
const DIRECTIONS: usize = 64;
/// Rounds, and the widest step of a radius in the first and the last, of the fragment's size.
const ROUNDS: usize = 24;
const WIDTHS: [f32; 2] = [0.05, 0.002];

/// The radii for which `spheres` (caller's frame), their centres kept, have the least mismatch
/// with the region, nearly; none is less than the sphere's own.
///
/// Every exposed point moves with its radius, so that at the least mismatch as much of a sphere's
/// exposed surface is within the region as beyond it.
pub fn grown_radii(
    parent: &Parent,
    region: &Region,
    spheres: &[Sphere],
    run: &Run,
) -> Result<Vec<f64>> {
    let solid = parent.solid();
    let frame = solid.frame();
    let walls = walls(region, &[], frame)?;
    let within = parent.within(false, run)?;
    let parts = Parts {
        grid: solid.grid(),
        depths: within.depths,
        surface: solid.surface(run)?,
        union: None,
        walls: &walls,
        less: 0.0,
        lo: region.lo,
        hi: region.hi,
    };
    let room = Room::new(parts, region.moments.volume)?;
    let to_room = |s: &Sphere| local(&frame.sphere_to_unit(s), &room.middle);
    let first = collected("spheres", spheres.iter().map(to_room))?;
    let mut balls = collected("spheres", first.iter().copied())?;
    let mut near = Vec::new();
    for round in 0..ROUNDS {
        run.check(round as f64 / ROUNDS as f64, "growing spheres")?;
        let part = round as f32 / (ROUNDS - 1) as f32;
        let width = room.size * WIDTHS[0] * (WIDTHS[1] / WIDTHS[0]).powf(part);
        let before = collected("spheres", balls.iter().copied())?;
        for (i, ball) in balls.iter_mut().enumerate() {
            near.clear();
            let meets = |o: &Ball| {
                let reach = o.radius + ball.radius;
                o.apart(&ball.center) < reach * reach
            };
            let others = before.iter().enumerate().filter(|(j, o)| *j != i && meets(o));
            near.extend(others.map(|(_, o)| *o));
            let least = first.get(i).map_or(0.0, |b| b.radius);
            ball.radius = (ball.radius + change(&room, ball, &near, width)).max(least);
        }
    }
    let grown = balls.iter().zip(spheres);
    collected("radii", grown.map(|(b, s)| (f64::from(b.radius) * frame.scale).max(s.radius)))
}

/// The mean depth of the exposed points, each no more than the width.
fn change(room: &Room, ball: &Ball, others: &[Ball], width: f32) -> f32 {
    let (mut sum, mut count) = (0.0, 0.0f32);
    for k in 0..DIRECTIONS {
        let z = (2 * k + 1) as f32 / DIRECTIONS as f32 - 1.0;
        let (y, x) = (2.399_963_3 * k as f32).sin_cos();
        let s = (1.0 - z * z).max(0.0).sqrt();
        let [cx, cy, cz] = ball.center;
        let r = ball.radius;
        let p = [cx + r * s * x, cy + r * s * y, cz + r * z];
        if !others.iter().any(|o| o.apart(&p) < o.radius * o.radius) {
            sum += room.depth(&p).0.clamp(-width, width);
            count += 1.0;
        }
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

/// The spheres with radii `part` (0 to 1) of the way from their own to `radii`, as far as each
/// keeps `gap` off all `others` (siblings' and neighbours' spheres, in the same frame); none less
/// than it is.
///
/// Refused: another number of radii than of spheres, a part that is not from 0 to 1, a gap that is
/// not a number of 0 or more.
pub fn grow(
    spheres: &[Sphere],
    radii: &[f64],
    part: f64,
    others: &[Sphere],
    gap: f64,
) -> Result<Vec<Sphere>> {
    if radii.len() != spheres.len() {
        return Err(Error::InvalidArgument(format!(
            "{} spheres are to grow to {} radii",
            spheres.len(),
            radii.len()
        )));
    }
    if !(0.0..=1.0).contains(&part) {
        return Err(Error::InvalidArgument(format!(
            "the part of the growth is {}, not from 0 to 1",
            figure(part)
        )));
    }
    if !(gap.is_finite() && gap >= 0.0) {
        return Err(Error::InvalidArgument(format!("gap is {}, not a number ≥ 0", figure(gap))));
    }
    let mut out = reserve("spheres", spheres.len())?;
    for (s, &radius) in spheres.iter().zip(radii) {
        let free = |o: &Sphere| (o.center - s.center).norm() * (1.0 - 1e-15) - o.radius - gap;
        let wanted = s.radius + part * (radius - s.radius);
        let most = others.iter().map(free).fold(f64::MAX, f64::min);
        let center: Vec3 = s.center;
        out.push(Sphere::new(center, wanted.min(most).max(s.radius)));
    }
    Ok(out)
}
