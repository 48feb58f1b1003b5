//! How far a clump is from being its own image where its target is.

use super::overlap::{compare, lattice_of};
use super::pieces;
use crate::error::{Error, Result, collected, reserve};
use crate::math::{PrincipalFrame, Sphere, Vec3};
use crate::run::Run;
use crate::shape::Body;
use crate::solid::Solid;
use crate::solid::columns::Rows;
use std::f64::consts::PI;

/// Points of the target's surface that are mirrored.
const POINTS: usize = 1024;
/// A target is its own image where these lie on average nearer to its surface than this: over the
/// equivalent diameter; of voxels, whose borders are where cells end, this part of a cell, if that is no
/// more than a part of the diameter.
const SAME: f64 = 3e-3;
const VOXEL: (f64, f64) = (0.35, 0.02);
/// Columns along each axis, at most, and where these meet no sphere.
const COLUMNS: usize = 128;
const FINEST: usize = 2048;

/// The greatest mismatch D of the clump and its image in a plane of the body frame, over those planes in
/// which the target is its own image; and how many they are.
pub(super) fn asymmetry(
    solid: &Solid,
    spheres: &[Sphere],
    columns: usize,
    run: &Run,
) -> Result<(f64, u32)> {
    let moments = solid.unit_moments();
    let centre = moments.centroid;
    let axes = PrincipalFrame::of_rounded(&moments.inertia, solid.frame().noise()).axes;
    let (area, _) = pieces::area(solid.body());
    let mut points: Vec<Vec3> = reserve("surface samples", POINTS + 1)?;
    pieces::samples(solid.body(), area, POINTS, |p, _| points.push(p));
    let cell = match solid.body() {
        Body::Mesh(_) => 0.0,
        Body::Voxels(v) => v.spacing.amax(),
    };
    let diameter = (6.0 / PI * moments.volume).cbrt();
    let most = (SAME * diameter).max((VOXEL.0 * cell).min(VOXEL.1 * diameter));
    let surface = solid.surface(run)?;
    let (mut worst, mut planes) = (0.0f64, 0);
    for axis in 0..3 {
        let normal: Vec3 = axes.column(axis).into_owned();
        let image = |p: &Vec3| p - normal * (2.0 * normal.dot(&(p - centre)));
        let off = run.pool().map(points.len(), |i| {
            points.get(i).map_or(0.0, |p| surface.nearest(&image(p)).distance)
        });
        run.count(|c| c.exact_distances += points.len() as u64);
        if off.iter().sum::<f64>() > most * points.len() as f64 {
            continue;
        }
        planes += 1;
        let other = spheres.iter().map(|s| Sphere::new(image(&s.center), s.radius));
        let other = collected("images of spheres", other)?;
        worst = worst.max(unlike(spheres, &other, columns.min(COLUMNS), run)?);
    }
    Ok((worst, planes))
}

/// Mismatch of two unions; 1 where spheres are dust beside how far they are apart.
fn unlike(own: &[Sphere], other: &[Sphere], mut columns: usize, run: &Run) -> Result<f64> {
    let both = collected("images of spheres", own.iter().chain(other).copied())?;
    while columns <= FINEST {
        let Some(lattice) = lattice_of(&both, columns) else { break };
        let rows = [Rows::of_spheres(own, lattice)?, Rows::of_spheres(other, lattice)?];
        match compare(&rows[0], &rows[1], 0.0, false, run) {
            Ok(found) => return Ok(found.mismatch),
            // No column meets a sphere.
            Err(Error::ZeroVolume(_)) => columns *= 4,
            Err(error) => return Err(error),
        }
    }
    Ok(1.0)
}
