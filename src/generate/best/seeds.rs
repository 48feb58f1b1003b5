//! The start of a search: a greedy cover of points inside by grown medial balls.

use super::dexels::Dexels;
use super::effort::Plan;
use super::field::Field;
use super::medial;
use super::random::Random;
use super::refine::Radii;
use crate::error::{Result, reserve};
use crate::generate::ball::Ball;
use crate::generate::select::choose;

/// Candidates are larger than fits by this factor: balls that reach out a little everywhere cover
/// better for the same mismatch.
const GROWN: f32 = 1.05;

/// `n` balls. `size`: a length of the order of the body.
pub(super) fn seeds(
    field: &Field,
    dexels: &Dexels,
    plan: &Plan,
    n: usize,
    radii: &Radii,
    size: f32,
    random: &mut Random,
) -> Result<Vec<Ball>> {
    let fit = |b: Ball| Ball { radius: (b.radius * GROWN).max(radii.least).min(radii.most), ..b };
    let mut candidates = reserve("candidates", plan.candidates)?;
    candidates.extend(
        dexels
            .points(plan.candidates, random)?
            .into_iter()
            .map(|p| fit(medial::ball(field, p, size))),
    );
    let points = dexels.points(plan.points, random)?;
    let mut balls = reserve("balls", n)?;
    balls.extend(choose(points, &candidates, n)?.into_iter().map(|i| candidates[i]));
    // Where all points are held before there are enough: balls about more of the medial axis.
    let more = n - balls.len();
    balls.extend(
        dexels.points(more, random)?.into_iter().map(|p| fit(medial::ball(field, p, size))),
    );
    Ok(balls)
}
