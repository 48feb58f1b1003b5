//! Balls about the points of an axis, as large as the body allows (Favier et al. 1999, for bodies
//! of revolution; CLUMP for any body).
//!
//! The radius is the exact depth of the point, not the least distance of vertices near it. Of the
//! balls about the axis only those count that no other holds; the centres are spread evenly over
//! them.

use super::super::GenerateOptions;
use super::ground::Ground;
use super::growing::Growing;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, collected, count};
use crate::math::{PrincipalFrame, Sphere, Vec3};
use crate::run::Run;
use crate::shape::Body;
use crate::solid::Solid;

/// Intervals of the axis.
const STEPS: usize = 1024;
/// A ball is held by another where the radius falls by more than this part of the way from it:
/// the corners of a mesh make no balls of their own.
const FALL: f64 = 0.98;
/// In cells: a longer way between two balls is a gap.
const GAP: f64 = 2.0;
/// Moments of inertia that differ by less of the greatest are those of a body of revolution.
const ALIKE: f64 = 0.02;

/// Makes a clump.
pub(in super::super) fn favier(
    solid: &Solid,
    options: &GenerateOptions,
    run: &Run,
) -> Result<Clump> {
    super::check(options, "favier")?;
    if options.spheres == 0 && options.mismatch == 0.0 {
        return Err(Error::InvalidArgument(
            "the method favier needs a number of spheres or a mismatch, and both are 0".into(),
        ));
    }
    run.check(0.0, "measuring the distances of the axis")?;
    let ground = Ground::new(solid, options, run)?;
    let all = balls(&ground, run)?;
    let mut growing = Growing::new(&ground, options)?;
    let large = all.iter().any(|b| b.sphere.radius >= ground.least);
    if !large {
        let stopped = if all.is_empty() { Stopped::Exhausted } else { Stopped::Radius };
        return growing.end(stopped, "the axis of the body lies outside of it", run);
    }
    let kept = maximal(&all, ground.least, FALL)?;
    let limit = match options.spheres {
        0 => kept.len(),
        n => n.min(kept.len()),
    };
    // With a mismatch to reach, more and more spheres; each time they are spread anew.
    let mut n = if options.mismatch > 0.0 { 1 } else { limit };
    let stopped = loop {
        growing.clear();
        for s in spread(&kept, n, GAP * ground.cell)? {
            growing.add(s)?;
        }
        if let Some(stopped) = growing.done(run) {
            break stopped;
        }
        if n >= limit {
            break Stopped::Exhausted;
        }
        n = (n + (n / 8).max(1)).min(limit);
    };
    let why = format!("no more than {} about the axis", count(kept.len() as u64, "ball"));
    growing.end(stopped, &why, run)
}

/// A ball about a point of the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OnAxis {
    /// Place along the axis.
    at: f64,
    sphere: Sphere,
}

/// The balls about the points of the axis that lie inside, in order.
fn balls(ground: &Ground, run: &Run) -> Result<Vec<OnAxis>> {
    let (centre, way) = axis(ground.solid);
    let (lo, hi) = extent(ground.solid, &centre, &way);
    let step = (hi - lo) / STEPS as f64;
    let found = run.pool().map(STEPS + 1, |i| {
        let at = lo + i as f64 * step;
        let p = centre + way * at;
        let depth = ground.depth(&p);
        let sphere = Sphere::new(p, depth + ground.tolerance);
        (depth > 1e-6 * ground.cell).then_some(OnAxis { at, sphere })
    });
    collected("balls about the axis", found.into_iter().flatten())
}

/// The balls of the least radius or more that no other one holds : none whose radius is greater
/// by `fall` times the way to it or more.
fn maximal(all: &[OnAxis], least: f64, fall: f64) -> Result<Vec<OnAxis>> {
    let mut kept: Vec<OnAxis> = crate::error::reserve("balls about the axis", all.len())?;
    for b in all.iter().filter(|b| b.sphere.radius >= least) {
        // Those kept are in order of both ends; a hair, for rounding.
        let hair = 1e-9 * b.sphere.radius;
        let high = |b: &OnAxis| fall * b.at + b.sphere.radius;
        let low = |b: &OnAxis| fall * b.at - b.sphere.radius;
        while kept.last().is_some_and(|k| low(k) >= low(b) - hair) {
            kept.pop();
        }
        if kept.last().is_none_or(|k| high(b) > high(k) + hair) {
            kept.push(*b);
        }
    }
    Ok(kept)
}

/// `n` of the balls, their centres spread evenly from the first to the last; of a single one the
/// largest. A way of more than `gap` counts as no more than that.
fn spread(kept: &[OnAxis], n: usize, gap: f64) -> Result<Vec<Sphere>> {
    if n <= 1 {
        let first = kept.iter().fold(None, |m: Option<&OnAxis>, b| match m {
            Some(m) if m.sphere.radius >= b.sphere.radius => Some(m),
            _ => Some(b),
        });
        return collected("the spheres", first.map(|b| b.sphere));
    }
    let mut along = crate::error::reserve("the axis", kept.len())?;
    let mut sum = 0.0;
    along.push(sum);
    for w in kept.windows(2) {
        sum += (w[1].at - w[0].at).min(gap);
        along.push(sum);
    }
    let mut out = crate::error::reserve("the spheres", n)?;
    let mut from = 0;
    for k in 0..n {
        let want = sum * k as f64 / (n - 1) as f64;
        // The nearest that is free and leaves enough for those after it.
        let last = kept.len() - (n - k);
        let mut i = from;
        while i < last && along[i + 1] <= want {
            i += 1;
        }
        if i < last && along[i + 1] - want < want - along[i] {
            i += 1;
        }
        out.push(kept[i].sphere);
        from = i + 1;
    }
    Ok(out)
}

/// Centre of mass and direction: the axis of revolution if two moments of inertia are alike, else
/// that of the least moment.
fn axis(solid: &Solid) -> (Vec3, Vec3) {
    let m = solid.unit_moments();
    let frame = PrincipalFrame::of_rounded(&m.inertia, solid.frame().noise());
    let [a, b, c] = frame.moments;
    let alike = |x: f64, y: f64| y - x < ALIKE * c;
    let alone = if alike(a, b) && !alike(b, c) { 2 } else { 0 };
    (m.centroid, frame.axes.column(alone).into_owned())
}

/// From where to where the body reaches along the axis.
fn extent(solid: &Solid, centre: &Vec3, way: &Vec3) -> (f64, f64) {
    let along = |p: &Vec3| (p - centre).dot(way);
    let add = |(lo, hi): (f64, f64), p: &Vec3| (lo.min(along(p)), hi.max(along(p)));
    match solid.body() {
        Body::Mesh(mesh) => mesh.vertices.iter().fold((0.0, 0.0), add),
        Body::Voxels(v) => {
            let high = Vec3::from(v.dims.map(|n| n as f64)).component_mul(&v.spacing);
            (0..8u32).fold((0.0, 0.0), |e, n| {
                add(e, &Vec3::from_fn(|a, _| if n >> a & 1 == 1 { high[a] } else { 0.0 }))
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(at: f64, radius: f64) -> OnAxis {
        OnAxis { at, sphere: Sphere::new(Vec3::new(at, 0.0, 0.0), radius) }
    }

    #[test]
    fn balls_that_others_hold_are_left_out() {
        let profile = |at: f64| ball(at, (0.4 - (at - 0.5).abs()).min(0.25));
        let all: Vec<OnAxis> = (0..=100).map(|i| profile(0.1 + f64::from(i) * 0.008)).collect();
        let kept = maximal(&all, 0.0, 1.0).unwrap();
        for b in &all {
            let held = all
                .iter()
                .any(|o| o != b && (o.at - b.at).abs() <= o.sphere.radius - b.sphere.radius + 1e-9);
            // Of the two whose balls meet where the profile bends, rounding may hold either.
            let bend = (b.sphere.radius - 0.25).abs() < 0.009;
            assert!(bend || kept.contains(b) != held, "{b:?} {held}");
        }
        assert!(kept.len() > 30 && kept.len() < 42, "{}", kept.len());
        assert_eq!(maximal(&all, 0.3, 1.0).unwrap(), []);
    }

    #[test]
    fn centres_are_spread_evenly() {
        let kept: Vec<OnAxis> = (0..=60).map(|i| ball(f64::from(i), 5.0)).collect();
        let at =
            |n| -> Vec<f64> { spread(&kept, n, 1.0).unwrap().iter().map(|s| s.center.x).collect() };
        assert_eq!(at(1), [0.0]);
        assert_eq!(at(2), [0.0, 60.0]);
        assert_eq!(at(5), [0.0, 15.0, 30.0, 45.0, 60.0]);
        assert_eq!(at(61), (0..=60).map(f64::from).collect::<Vec<_>>());
        // A gap counts as no way.
        let kept: Vec<OnAxis> =
            (0..=60).map(|i| ball(f64::from(if i > 30 { i + 900 } else { i }), 5.0)).collect();
        let at: Vec<f64> = spread(&kept, 4, 1.0).unwrap().iter().map(|s| s.center.x).collect();
        assert_eq!(at, [0.0, 20.0, 940.0, 960.0]);
    }
}
