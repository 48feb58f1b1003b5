//! The start of a search: a greedy cover of points inside by grown medial balls.

use super::effort::Plan;
use super::state::Ground;
use crate::error::{Result, reserve};
use crate::generate::ball::Ball;
use crate::generate::balls::medial;
use crate::generate::balls::random::Random;
use crate::generate::select::choose;

/// Candidates are larger than fits by this factor: balls that reach out a little everywhere cover
/// better for the same mismatch.
pub(super) const GROWN: f32 = 1.05;
/// How far beyond the limits a candidate may reach, of its radius.
const SLACK: f32 = 0.01;

/// Bytes that seeds take: of each point, three copies; of each candidate, two, its gain and its
/// place in the queue.
pub(super) fn bytes(plan: &Plan) -> u64 {
    44 * plan.points as u64 + 72 * plan.candidates as u64
}

/// `n` balls.
pub(super) fn seeds(
    ground: &Ground,
    plan: &Plan,
    n: usize,
    random: &mut Random,
) -> Result<Vec<Ball>> {
    more(ground, plan, &[], n, random)
}

/// `n` balls, of which those `before` are the first.
pub(super) fn more(
    ground: &Ground,
    plan: &Plan,
    before: &[Ball],
    n: usize,
    random: &mut Random,
) -> Result<Vec<Ball>> {
    let Ground { field, dexels, radii, limits, size, .. } = *ground;
    let fit = |p: [f32; 3]| {
        let medial = medial::ball(field, p, size);
        let mut ball = Ball { radius: (medial.radius * GROWN).max(radii.least), ..medial };
        if ball.radius > radii.most {
            // As far from the point as the depth reaches that the radius can have.
            let way = [0, 1, 2].map(|a| medial.center[a] - p[a]);
            let length = way.iter().map(|x| x * x).sum::<f32>().sqrt();
            let part = (radii.most / GROWN + field.one(p)) / length.max(f32::MIN_POSITIVE);
            ball.center = [0, 1, 2].map(|a| p[a] + part.clamp(0.0, 1.0) * way[a]);
            ball.radius = radii.most;
        }
        if !limits.none() {
            limits.hold(field, &radii, &mut ball);
        }
        ball
    };
    let mut candidates = reserve("candidates", plan.candidates)?;
    candidates.extend(dexels.points(plan.candidates, random)?.into_iter().map(fit));
    let fits = |b: &Ball| limits.none() || limits.excess(field, b) <= SLACK * b.radius;
    if candidates.iter().any(fits) {
        candidates.retain(fits);
    }
    let mut points = dexels.points(plan.points, random)?;
    let covers = |p: &[f32; 3], b: &Ball| {
        let square = |a: usize| (p[a] - b.center[a]) * (p[a] - b.center[a]);
        square(0) + square(1) + square(2) <= b.radius * b.radius
    };
    points.retain(|p| !before.iter().any(|b| covers(p, b)));
    let mut balls = reserve("balls", n)?;
    balls.extend(before.iter().take(n));
    let left = n - balls.len();
    balls.extend(choose(points, &candidates, left)?.into_iter().map(|i| candidates[i]));
    // Where all points are held before there are enough: balls about more of the medial axis.
    let more = n - balls.len();
    balls.extend(dexels.points(more, random)?.into_iter().map(fit));
    Ok(balls)
}
