//! The end of a search: spheres in the caller's frame that keep their limits exactly.

use super::limits::Exact;
use crate::error::{Error, Result, figure, reserve};
use crate::generate::ball::Ball;
use crate::math::{Sphere, UnitFrame};

/// The balls as spheres in the caller's frame, those left out that no place near theirs has room
/// for, and what is to be said about that.
pub(super) fn finish(
    mut balls: Vec<Ball>,
    frame: &UnitFrame,
    exact: &Exact,
) -> Result<(Vec<Sphere>, String)> {
    balls.sort_by(|x, y| y.radius.total_cmp(&x.radius));
    let n = balls.len();
    let mut spheres = reserve("spheres", n)?;
    spheres.extend(balls.iter().map(|b| frame.sphere_to_input(&b.sphere())));
    if exact.none() {
        return Ok((spheres, String::new()));
    }
    let mut held: Vec<Sphere> = reserve("spheres", n)?;
    held.extend(spheres.iter().filter_map(|s| exact.hold(s)));
    let least = figure(exact.least());
    if held.is_empty() {
        return Err(Error::NoSpheres(format!(
            "none of {n} spheres has room for a radius of {least} within the limits"
        )));
    }
    held.sort_by(|x, y| y.radius.total_cmp(&x.radius));
    let note = if held.len() < n {
        format!("{} of {n} spheres have room for a radius of {least} within the limits", held.len())
    } else {
        String::new()
    };
    Ok((held, note))
}
