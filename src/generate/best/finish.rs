//! The end of a search: spheres in the caller's frame that keep their limits exactly.

use super::connected;
use super::limits::Exact;
use super::symmetry::Orbits;
use super::volume;
use super::watch::Watch;
use crate::error::{Error, Result, figure, reserve};
use crate::generate::ball::Ball;
use crate::math::{Sphere, UnitFrame};
use crate::run::Pool;

/// The balls as spheres in the caller's frame, those left out that no place near theirs has room
/// for, and what is to be said about that. `volume`: that of the union, unit frame, if it matters.
pub(super) fn finish(
    balls: &[Ball],
    orbits: &Orbits,
    frame: &UnitFrame,
    exact: &Exact,
    (volume, pool, watch): (Option<f64>, &Pool, &Watch),
) -> Result<(Vec<Sphere>, String)> {
    let n = balls.len();
    let mut leads = orbits.leads(n);
    let radius = |i: u32| balls[i as usize].radius;
    leads.sort_by(|&i, &j| radius(j).total_cmp(&radius(i)));
    let mut spheres = reserve("spheres", n)?;
    // How many are images of each other, one after the other.
    let mut sizes = reserve("orbits", leads.len())?;
    for i in leads {
        let sphere = balls[i as usize].sphere();
        let before = spheres.len();
        if exact.none() {
            spheres.extend(orbits.images(i, sphere, frame));
        } else if let Some(held) = exact.hold(&frame.sphere_to_input(&sphere)) {
            spheres.extend(together(exact, orbits.images_of(i, held, frame)));
        }
        sizes.push(spheres.len() - before);
    }
    let least = figure(exact.least());
    if spheres.is_empty() {
        return Err(Error::NoSpheres(format!(
            "none of {n} spheres has room for a radius of {least} within the limits"
        )));
    }
    let mut note = match volume {
        Some(volume) => volume::fit(&mut spheres, &sizes, frame, exact, volume, (pool, watch))?,
        None => String::new(),
    };
    spheres.sort_by(|x, y| y.radius.total_cmp(&x.radius));
    let kept = spheres.len();
    if kept < n {
        let and = if note.is_empty() { "" } else { "; " };
        note = format!(
            "{kept} of {n} spheres have room for a radius of {least} within the limits{and}{note}"
        );
    }
    Ok((spheres, note))
}

/// Spheres that are images of each other with the greatest radius for which all have room; none
/// where one has to move.
fn together(exact: &Exact, mut images: Vec<Sphere>) -> Vec<Sphere> {
    if images.len() == 1 {
        return images;
    }
    let mut radius = f64::MAX;
    for s in &images {
        match exact.hold(s) {
            Some(held) if held.center == s.center => radius = radius.min(held.radius),
            _ => return Vec::new(),
        }
    }
    images.iter_mut().for_each(|s| s.radius = radius);
    images
}

/// The note, and what is to be said of spheres that should hang together and do not.
pub(super) fn pieces(spheres: &[Sphere], mut note: String) -> Result<String> {
    let parts = connected::count(spheres)?;
    if parts > 1 {
        if !note.is_empty() {
            note.push_str("; ");
        }
        note +=
            &format!("the spheres are {parts} parts that the limits keep from hanging together");
    }
    Ok(note)
}
