//! Clumps that are exactly their own images: orbits of spheres under the group of the target's
//! symmetry, of which one sphere each is looked for.

mod group;
mod orbits;
mod replant;
mod seeds;

pub(super) use orbits::{Orbit, Orbits, Sites};
pub(super) use seeds::seeds;

use super::limits::Plane;
use super::options::{BestOptions, Symmetry};
use crate::error::{Error, Result, figure};
use crate::math::Vec3;
use crate::solid::Solid;
use group::{Group, MOST, mirror};

/// Planes whose normals and offsets differ by less are the same, unit frame.
const SAME_PLANE: f64 = 1e-7;

/// The symmetry that a clump is to have, about the centre of mass; none where it is none.
/// `half_spaces`: those that the clump keeps within.
pub(super) fn sites(
    solid: &Solid,
    options: &BestOptions,
    half_spaces: &[Plane],
) -> Result<Option<Sites>> {
    let centre = solid.unit_moments().centroid;
    let group = match &options.symmetry {
        Symmetry::None => return Ok(None),
        Symmetry::Auto => {
            return Err(Error::Unsupported("the target's symmetry is not looked for yet".into()));
        }
        Symmetry::Planes(normals) => {
            let group = planes(normals)?;
            if let Some(i) = broken(&group, &centre, half_spaces) {
                return Err(Error::InvalidArgument(format!(
                    "the symmetry planes have an image of half-space {i} that is not among the \
                     half-spaces"
                )));
            }
            group
        }
    };
    Ok((group.len() > 1).then(|| Sites::new(&group, centre)))
}

/// A half-space with an image that is none of them.
fn broken(group: &Group, centre: &Vec3, half_spaces: &[Plane]) -> Option<usize> {
    let offset = |p: &Plane| p.offset - p.normal.dot(centre);
    half_spaces.iter().position(|p| {
        group.elements().iter().any(|g| {
            let normal = g * p.normal;
            let same = |q: &Plane| {
                (q.normal - normal).amax() < SAME_PLANE
                    && (offset(q) - offset(p)).abs() < SAME_PLANE
            };
            !half_spaces.iter().any(same)
        })
    })
}

/// The group of mirror planes with these normals.
fn planes(normals: &[Vec3]) -> Result<Group> {
    let mirrors: Vec<_> = normals.iter().map(mirror).collect();
    Group::generated(&mirrors).ok_or_else(|| {
        let name = |n: &Vec3| format!("({}, {}, {})", figure(n.x), figure(n.y), figure(n.z));
        let names: Vec<String> = normals.iter().map(name).collect();
        Error::InvalidArgument(format!(
            "the symmetry planes with the normals {} make more than {MOST} images of a sphere",
            names.join(", ")
        ))
    })
}

/// Why there are fewer spheres than were asked for.
pub(super) fn note(sites: &Option<Sites>, asked: usize, n: usize) -> String {
    let Some(sites) = sites else { return String::new() };
    let mut sizes: Vec<usize> = sites.kinds.iter().map(|k| k.len()).collect();
    sizes.dedup();
    let sizes: Vec<String> = sizes.iter().map(usize::to_string).collect();
    let sizes = match sizes.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => sizes.concat(),
    };
    format!("under its symmetry the clump has {n} spheres, not {asked}: one has {sizes} images")
}
