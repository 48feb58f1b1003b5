//! Clumps that are exactly their own images: orbits of spheres under the group of the target's
//! symmetry, of which one sphere each is looked for.

mod detect;
mod group;
mod kinds;
mod orbits;
mod replant;
mod seeds;

pub(super) use orbits::{Orbit, Orbits, Sites};
pub(super) use seeds::seeds;

use super::options::{BestOptions, Symmetry};
use crate::error::{Error, Result, collected, figure};
use crate::generate::balls::Plane;
use crate::generate::balls::field::Field;
use crate::math::Vec3;
use crate::solid::Solid;
use group::{GIVEN, Group, MOST, Matrix, mirror};

/// Planes whose normals and offsets differ by less are the same, unit frame.
const SAME_PLANE: f64 = 1e-7;
/// From so many spheres for each image on, the target's whole symmetry is taken.
const MANY: usize = 4;

/// The symmetries that a clump of `n` spheres may have, about the centre of mass, the largest
/// first; nothing where it is to have none. `half_spaces`: those that the clump keeps within.
pub(super) fn choices(
    solid: &Solid,
    field: &Field,
    options: &BestOptions,
    half_spaces: &[Plane],
    n: usize,
) -> Result<Vec<Sites>> {
    let centre = solid.unit_moments().centroid;
    let mut groups = match &options.symmetry {
        Symmetry::None => Vec::new(),
        Symmetry::Auto => {
            let keeps = |m: &Matrix| broken(m, &centre, half_spaces).is_none();
            let group = detect::find(solid, field, &keeps)?;
            // Of many spheres a symmetry costs nothing.
            let mut parts = if n < MANY * group.len() { group.mirror_parts() } else { Vec::new() };
            // Those with axes of three have few small orbits.
            parts.retain(|p| p.count_ones() as usize != group.len() && p.count_ones() % 3 != 0);
            let parts = parts.into_iter().map(|p| group.part(p));
            std::iter::once(group.clone()).chain(parts).collect()
        }
        Symmetry::Planes(normals) => {
            let axes = &solid.frame().axes;
            let turned = normals.iter().map(|n| axes.direction(n));
            let group = planes(&collected("symmetry planes", turned)?)?;
            let broken = |m: &Matrix| broken(m, &centre, half_spaces);
            if let Some(i) = group.elements().iter().find_map(broken) {
                return Err(Error::InvalidArgument(format!(
                    "the symmetry planes have an image of half-space {i} that is not among the \
                     half-spaces"
                )));
            }
            vec![group]
        }
    };
    groups.retain(|g| g.len() > 1);
    let found = groups.first().map_or(1, |g| g.len());
    let mut choices: Vec<Sites> = groups.iter().map(|g| Sites::new(g, centre, found)).collect();
    if choices.len() > 1 {
        choices.retain(|s| s.most(n) == n);
    }
    Ok(choices)
}

/// A half-space of which the image is none of them.
fn broken(m: &Matrix, centre: &Vec3, half_spaces: &[Plane]) -> Option<usize> {
    let offset = |p: &Plane| p.offset - p.normal.dot(centre);
    half_spaces.iter().position(|p| {
        let normal = m * p.normal;
        let same = |q: &Plane| {
            (q.normal - normal).amax() < SAME_PLANE && (offset(q) - offset(p)).abs() < SAME_PLANE
        };
        !half_spaces.iter().any(same)
    })
}

/// The group of mirror planes with these normals.
fn planes(normals: &[Vec3]) -> Result<Group> {
    let mirrors: Vec<_> = normals.iter().map(mirror).collect();
    Group::generated(&mirrors, GIVEN).ok_or_else(|| {
        let name = |n: &Vec3| format!("({}, {}, {})", figure(n.x), figure(n.y), figure(n.z));
        let names: Vec<String> = normals.iter().map(name).collect();
        Error::InvalidArgument(format!(
            "the symmetry planes with the normals {} make more than {MOST} images of a sphere",
            names.join(", ")
        ))
    })
}

/// What is to be said about a clump of `n` spheres where `asked` were asked for, with the
/// symmetry `chosen` of these.
pub(super) fn note(chosen: &Sites, asked: usize, n: usize) -> String {
    let (order, found) = (chosen.order, chosen.found);
    if n == asked && order == found {
        return String::new();
    }
    if n == asked {
        return format!(
            "of the {found} images that the target's symmetry makes of a sphere the clump has \
             {order}: with all of them it would be farther from the target or have other numbers of \
             spheres"
        );
    }
    let mut sizes: Vec<usize> = chosen.kinds.iter().map(|k| k.len()).collect();
    sizes.dedup();
    let sizes: Vec<String> = sizes.iter().map(usize::to_string).collect();
    let sizes = match sizes.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => sizes.concat(),
    };
    format!("under its symmetry the clump has {n} spheres, not {asked}: one has {sizes} images")
}
