//! Lids over the openings of a mesh, so that its inside ends at faces everywhere: distances are
//! then those to the body that the columns see, and no ball bulges out of a hole.
//!
//! The winding number w of an open mesh is ½ on a flat lid, whatever the rest is: there the inside
//! ended before. So a rim is taken for that of an opening where w is about ½ over its lid; over the
//! rim of a crack within the body, of a flap or of a loose triangle it is about 1 or 0, and a lid would
//! be a wall. What gets no lid stays open: its inside is told by w > ½, and ends at no face.

mod cover;
mod rims;

use super::columns::border;
use super::winding::Winding;
use crate::error::{Result, count, fits, push, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::{Body, Mesh, Shape};
use cover::{Lid, over};
use rims::Rims;
use std::mem::size_of;
use std::sync::Arc;

/// By how much w may differ from ½ over an opening, on average: non-planar rims and other
/// openings near by move it, …
const NEAR_HALF: f64 = 0.25;
/// … as seen from so many triangles of a lid.
const LOOKS: usize = 6;
/// Rims looked at together.
const CHUNK: usize = 64;
const WHAT: &str = "the lids of openings";

/// What became of the openings of a mesh.
pub(super) struct Lids {
    /// The mesh and its lids, which come last; `None` when none was made.
    pub mesh: Option<Mesh>,
    /// What a user should know.
    pub notes: Vec<String>,
}

/// The shape with its openings closed, as far as they can be, and notes on that; `None` where
/// nothing changes.
pub(super) fn of_shape(
    shape: &Shape,
    limit: u64,
    notes: &mut Vec<String>,
    run: &Run,
) -> Result<Option<Shape>> {
    let Body::Mesh(mesh) = &*shape.body else { return Ok(None) };
    let manifold = shape.report.nonmanifold_edges == 0 && shape.report.oriented;
    let Some(lids) = close(mesh, manifold, limit, run)? else { return Ok(None) };
    notes.extend(lids.notes);
    let closed = |mesh| Shape { body: Arc::new(Body::Mesh(mesh)), ..shape.clone() };
    Ok(lids.mesh.map(closed))
}

/// Closes the openings of `mesh`; `None` when it has none. `manifold`: no edge has more than two
/// faces, or two that disagree.
pub(super) fn close(mesh: &Mesh, manifold: bool, limit: u64, run: &Run) -> Result<Option<Lids>> {
    if mesh.clean {
        return Ok(None);
    }
    let border = border(mesh)?;
    if border.is_empty() {
        return Ok(None);
    }
    if border.len() >= mesh.faces.len() {
        let note = format!(
            "the surface is open along {} and gets no lids, as most of its faces are not joined: there \
             the inside ends where the winding number is ½, at no face, and spheres may reach out as far \
             as the edges let them",
            count(border.len() as u64, "edge")
        );
        return Ok(Some(Lids { mesh: None, notes: vec![note] }));
    }
    let bytes = most_bytes(mesh, border.len());
    let (edges, faces) = (border.len(), mesh.faces.len());
    fits(format_args!("closing {edges} open edges of {faces} faces"), bytes, limit)?;
    run.count(|c| c.peak_bytes = c.peak_bytes.max(bytes));
    run.check(0.0, "closing the openings")?;
    let rims = Rims::of(mesh, &border)?;
    let winding = Winding::new(mesh)?;
    let chunks = run.pool().map(rims.len().div_ceil(CHUNK), |c| {
        let some = (c * CHUNK..rims.len().min((c + 1) * CHUNK)).map(|i| {
            let points = rims.points(mesh, i)?;
            let lid = if rims.plain(i) { over(&points)? } else { None };
            Ok(lid.filter(|lid| is_opening(lid, &points, &winding)))
        });
        some.collect::<Result<Vec<Option<Lid>>>>()
    });
    run.check(0.0, "closing the openings")?;
    let mut closed = Mesh {
        vertices: reserve(WHAT, mesh.vertices.len() + rims.len())?,
        faces: reserve(WHAT, mesh.faces.len() + border.len())?,
        clean: false,
    };
    closed.vertices.extend_from_slice(&mesh.vertices);
    closed.faces.extend_from_slice(&mesh.faces);
    let (mut made, mut left) = (0, 0);
    let mut at = 0;
    for chunk in chunks {
        for lid in chunk? {
            let rim = rims.vertices(at);
            at += 1;
            match lid {
                Some(lid) => add(&mut closed, rim, &lid)?,
                None => {
                    left += 1;
                    continue;
                }
            }
            made += 1;
        }
    }
    closed.clean = manifold && left == 0;
    let mut notes = Vec::new();
    if made > 0 {
        notes.push(format!("lids were put over {}: they count as surface", count(made, "opening")));
    }
    if left > 0 {
        notes.push(format!(
            "{} of the surface got no lid (cracks, or rims that are no plain loop): there the inside ends \
             where the winding number is ½, at no face, and spheres may reach out as far as the edges let \
             them",
            count(left, "opening")
        ));
    }
    Ok(Some(Lids { mesh: (made > 0).then_some(closed), notes }))
}

/// Most bytes that closing takes.
fn most_bytes(mesh: &Mesh, border: usize) -> u64 {
    let each = 24 + 12 + 4 * 16 + 3 * 24 + size_of::<Option<Lid>>() as u64;
    let marks = mesh.vertices.len() as u64;
    mesh.bytes() + marks + border as u64 * each + Winding::most_bytes(mesh.faces.len())
}

/// The corners of a lid's triangle `i`; they face outward as the faces beside them do.
fn corners(lid: &Lid, points: &[Vec3], i: usize) -> Option<[Vec3; 3]> {
    let point = |k: usize| points.get(k).copied();
    match lid {
        Lid::Fan(apex) => Some([point((i + 1) % points.len().max(1))?, point(i)?, *apex]),
        Lid::Cut(all) => {
            let [a, b, c] = *all.get(i)?;
            Some([point(c as usize)?, point(b as usize)?, point(a as usize)?])
        }
    }
}

fn triangles(lid: &Lid, points: &[Vec3]) -> usize {
    match lid {
        Lid::Fan(_) => points.len(),
        Lid::Cut(all) => all.len(),
    }
}

/// Whether the inside of the open mesh ends about where the lid is.
fn is_opening(lid: &Lid, points: &[Vec3], winding: &Winding) -> bool {
    let n = triangles(lid, points);
    let looks = n.min(LOOKS);
    let off = (0..looks).filter_map(|k| corners(lid, points, k * n / looks)).map(|[a, b, c]| {
        let w = winding.at(&((a + b + c) / 3.0));
        (w - 0.5).abs()
    });
    off.sum::<f64>() <= NEAR_HALF * looks as f64
}

/// Adds a lid over a rim.
fn add(mesh: &mut Mesh, rim: &[u32], lid: &Lid) -> Result<()> {
    match lid {
        Lid::Fan(apex) => {
            let top = mesh.vertices.len() as u32;
            push(WHAT, &mut mesh.vertices, *apex)?;
            for (i, &a) in rim.iter().enumerate() {
                let b = rim.get(i + 1).or(rim.first()).copied().unwrap_or(a);
                push(WHAT, &mut mesh.faces, [b, a, top])?;
            }
        }
        Lid::Cut(all) => {
            let at = |i: u32| rim.get(i as usize).copied().unwrap_or_default();
            for &[a, b, c] in all {
                push(WHAT, &mut mesh.faces, [at(c), at(b), at(a)])?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
