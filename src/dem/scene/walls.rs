//! Walls and insertions of a scene.

use super::file::{InsertionPart, MeshPart, SceneFile, WallPart};
use super::materials::known;
use super::templates::Source;
use crate::dem::{InsertRegion, Insertion, WallMotion, WallSetup, WallShape};
use crate::error::{Error, Result, figure, push};
use crate::run::Run;
use std::path::Path;

pub(super) fn insertion(
    i: usize,
    part: &InsertionPart,
    file: &SceneFile,
    materials: &[u32],
    dt: f64,
) -> Result<Insertion> {
    let bad = |what: String| Err(Error::InvalidArgument(format!("insertion {i} {what}")));
    let mut templates = Vec::new();
    for name in &part.templates {
        match file.templates.keys().position(|n| n == name) {
            Some(at) => push("templates", &mut templates, at as u32)?,
            None => return bad(format!("is of the template {name}, which is not there")),
        }
    }
    let of = |t: &u32| materials[*t as usize];
    let Some(material) = templates.first().map(of) else {
        return bad("names no template".into());
    };
    if templates.iter().any(|t| of(t) != material) {
        return bad("is of templates of several materials".into());
    }
    if !(part.every.is_finite() && part.every > 0.0) {
        return bad(format!("comes every {}, not a number above 0", figure(part.every)));
    }
    let region = match (&part.cuboid, &part.cylinder) {
        (Some(b), None) => InsertRegion::Box { lo: b.lo.into(), hi: b.hi.into() },
        (None, Some(c)) => {
            InsertRegion::Cylinder { center: c.center.into(), radius: c.radius, height: c.height }
        }
        _ => return bad("needs one of box and cylinder".into()),
    };
    Ok(Insertion {
        templates,
        material,
        region,
        velocity: part.velocity.into(),
        total: part.total,
        batch: part.at_once,
        every: ((part.every / dt).round().max(1.0)) as u64,
        attempts: part.attempts,
        seed: file.run.seed.wrapping_add(i as u64),
    })
}

/// The triangles of a mesh, in the frame of the scene.
fn mesh(i: usize, part: &MeshPart, folder: &Path, run: &Run) -> Result<WallShape> {
    if part.file.is_some() == part.shape.is_some() {
        return Err(Error::InvalidArgument(format!(
            "the mesh of wall {i} needs one of file and shape"
        )));
    }
    let source = Source {
        shape: part.shape.as_deref(),
        set: &part.set,
        segments: part.segments,
        file: part.file.as_deref(),
        scale: part.scale,
        stretch: None,
    };
    let shape = source.shape(folder, run).map_err(|e| e.about(&format!("wall {i}")))?;
    match shape.body.as_ref() {
        crate::shape::Body::Mesh(m) => Ok(WallShape::Mesh {
            vertices: m.vertices.iter().map(|v| shape.frame.to_input(v)).collect(),
            triangles: m.faces.clone(),
        }),
        crate::shape::Body::Voxels(_) => {
            Err(Error::Unsupported(format!("wall {i} is of voxels, not of triangles")))
        }
    }
}

pub(super) fn wall(
    i: usize,
    w: &WallPart,
    file: &SceneFile,
    folder: &Path,
    run: &Run,
) -> Result<WallSetup> {
    let material = known(&file.materials, &w.material, &format!("wall {i}"))?;
    let shape = match (&w.plane, &w.cuboid, &w.cylinder, &w.mesh) {
        (Some(p), None, None, None) => {
            WallShape::Plane { normal: p.normal.into(), offset: p.offset }
        }
        (None, Some(b), None, None) => WallShape::Box { lo: b.lo.into(), hi: b.hi.into() },
        (None, None, Some(c), None) => WallShape::Cylinder {
            center: c.center.into(),
            axis: c.axis.into(),
            radius: c.radius,
            length: c.length,
        },
        (None, None, None, Some(m)) => mesh(i, m, folder, run)?,
        _ => {
            return Err(Error::InvalidArgument(format!(
                "wall {i} needs one of plane, box, cylinder and mesh"
            )));
        }
    };
    let motion = match (w.slide, w.convey, &w.shake, &w.turn) {
        (None, None, None, None) => WallMotion::Still,
        (Some(v), None, None, None) => WallMotion::Slide(v.into()),
        (None, Some(v), None, None) => WallMotion::Convey(v.into()),
        (None, None, Some(s), None) => {
            WallMotion::Shake { amplitude: s.amplitude.into(), frequency: s.frequency }
        }
        (None, None, None, Some(t)) => WallMotion::Turn {
            center: t.center.into(),
            axis: t.axis.into(),
            rate: t.rate,
            spin: t.spin,
        },
        _ => return Err(Error::InvalidArgument(format!("wall {i} moves in more than one way"))),
    };
    Ok(WallSetup { shape, material, motion })
}
