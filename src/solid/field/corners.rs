//! The corners of a mesh, each with some of the edges that meet there.

use super::features::{End, WHAT};
use super::regions::Corner;
use crate::error::{Result, filled, reserve};
use crate::math::Vec3;

/// Half-spaces of a corner's region.
const AWAY: usize = 4;
/// Edges that they are chosen from.
const FROM: usize = 32;

/// The corners, where edges end, and their vertices.
pub(super) fn corners(points: &[Vec3], ends: &[End]) -> Result<(Vec<Corner>, Vec<u32>)> {
    // The edges of each vertex, one vertex after the other.
    let mut starts = filled(WHAT, points.len() + 1, 0u32)?;
    for e in ends {
        for v in e.ends {
            starts[v as usize + 1] += 1;
        }
    }
    for v in 1..starts.len() {
        starts[v] += starts[v - 1];
    }
    let mut next = filled(WHAT, points.len(), 0u32)?;
    next.copy_from_slice(&starts[..points.len()]);
    let mut list = filled(WHAT, 2 * ends.len(), 0u32)?;
    for (i, e) in ends.iter().enumerate() {
        for (end, &v) in e.ends.iter().enumerate() {
            list[next[v as usize] as usize] = (2 * i + end) as u32;
            next[v as usize] += 1;
        }
    }
    let mut corners = reserve(WHAT, points.len())?;
    let mut vertices = reserve(WHAT, points.len())?;
    let along = |&e: &u32| ends[e as usize / 2].along * if e & 1 == 0 { 1.0 } else { -1.0 };
    for (v, (at, range)) in points.iter().zip(starts.windows(2)).enumerate() {
        let list = &list[range[0] as usize..range[1] as usize];
        if !list.is_empty() {
            corners.push(Corner::new(behind(list.iter().map(along)), *at));
            vertices.push(v as u32);
        }
    }
    Ok((corners, vertices))
}

/// Normals of half-spaces behind some of a corner's edges and behind the sum of all, which
/// follows. Each edge is the farthest in direction from those before it, so that they leave
/// little.
fn behind(edges: impl Iterator<Item = Vec3>) -> [Vec3; AWAY] {
    let (mut some, mut count) = ([Vec3::zeros(); FROM], 0);
    let mut sum = Vec3::zeros();
    for edge in edges {
        sum += edge;
        if let Some(place) = some.get_mut(count) {
            *place = edge;
            count += 1;
        }
    }
    let mut last = some[0];
    let mut behind = [-last; AWAY];
    let squared = sum.norm_squared();
    if squared > 1e-12 {
        behind[AWAY - 1] = sum * (-1.0 / squared.sqrt());
    }
    // How near each comes to those that are chosen (its greatest cosine).
    let mut near = [f64::MIN; FROM];
    for behind in &mut behind[1..AWAY - 1] {
        let mut least = f64::MAX;
        let before = last;
        for (edge, near) in some[..count].iter().zip(&mut near) {
            *near = near.max(before.dot(edge));
            if *near < least {
                (least, last) = (*near, *edge);
            }
        }
        *behind = -last;
    }
    behind
}
