//! The last step: exact radii, none overlapping and none beyond the surface.

use super::near::Near;
use super::room::Room;
use crate::error::{Result, filled, reserve};
use crate::math::{Sphere, Vec3};

/// How much larger than the smallest a ball may be.
const SPREAD: f64 = 1.05;
/// Roundings that a distance may take, in units of the last digit of the caller's coordinates.
pub(super) const ROUNDINGS: f64 = 16.0;

/// Balls about the centres, in the unit frame: first all as large as the tightest one can be, then
/// each, one after the other, as large as what is around it allows, by a twentieth at most. `noise`
/// is the rounding of the caller's coordinates: balls keep so far apart that it takes none into
/// another.
pub(super) fn spheres(room: &Room, at: &[Vec3], noise: f64) -> Result<Vec<Sphere>> {
    let slack = ROUNDINGS * noise;
    let mut depths = reserve("the depths of balls", at.len())?;
    depths.extend(at.iter().map(|p| room.depth(p) - slack));
    let least = depths.iter().copied().fold(f64::MAX, f64::min);
    if least <= 0.0 {
        return Ok(Vec::new());
    }
    let mut near = Near::default();
    near.sort(at, 2.0 * SPREAD * least)?;
    let mut common = least;
    for (i, p) in at.iter().enumerate() {
        near.around(p, |j| {
            if j != i {
                common = common.min(0.5 * ((p - at[j]).norm() - slack));
            }
        });
    }
    if common <= 0.0 {
        return Ok(Vec::new());
    }
    let top = SPREAD * common * (1.0 - ROUNDINGS * f64::EPSILON);
    let mut radii = filled("the radii of balls", at.len(), common)?;
    for (i, p) in at.iter().enumerate() {
        let mut most = depths[i].min(top);
        near.around(p, |j| {
            if j != i {
                most = most.min((p - at[j]).norm() - slack - radii[j]);
            }
        });
        radii[i] = radii[i].max(most);
    }
    let mut spheres = reserve("the spheres", at.len())?;
    spheres.extend(at.iter().zip(&radii).map(|(p, r)| Sphere::new(*p, *r)));
    spheres.sort_by(|a, b| b.radius.total_cmp(&a.radius));
    Ok(spheres)
}
