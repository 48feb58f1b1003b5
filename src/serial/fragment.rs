//! A fragment: which part of its first parent it is, and its spheres.

use super::{Kind, from_bytes, possible, to_bytes};
use crate::error::{Error, Result, collected};
use crate::fragment::{Mark, Parent, Region};
use crate::generate::Plane;
use crate::math::{Moments, Sphere, Vec3};
use crate::shape::Body;
use serde::{Deserialize, Serialize};

/// A fragment without its parent.
#[derive(Debug, Clone, PartialEq)]
pub struct FragmentRecord {
    /// What of the first parent it is.
    pub region: Region,
    /// Its spheres, in the frame and unit of the parent's shape.
    pub spheres: Vec<Sphere>,
}

/// What is handed on, in the unit frame of the parent.
#[derive(Serialize, Deserialize)]
struct Record {
    /// The parent's hash, little-endian.
    parent: [u8; 16],
    /// Normals and offsets.
    planes: Vec<[f64; 4]>,
    mark: Option<Mark>,
    moments: Moments,
    lo: Vec3,
    hi: Vec3,
    anchor: Option<u64>,
    cell: u64,
    /// In the caller's frame.
    spheres: Vec<[f64; 4]>,
}

/// The bytes of a fragment of a parent: its half-spaces, moments, box and spheres, and the hash of
/// the parent in the parent's place. About 250 bytes, 32 for each half-space and each sphere; a
/// mark, which tells one of several components of a cell, adds up to 2.5 KiB, mostly about 1.
pub fn fragment_to_bytes(parent: &Parent, region: &Region, spheres: &[Sphere]) -> Result<Vec<u8>> {
    let four = |v: &Vec3, w: f64| [v.x, v.y, v.z, w];
    let record = Record {
        parent: parent.hash()?.to_le_bytes(),
        planes: collected("planes", region.planes.iter().map(|p| four(&p.normal, p.offset)))?,
        mark: region.mark.clone(),
        moments: region.moments,
        lo: region.lo,
        hi: region.hi,
        anchor: region.anchor,
        cell: region.cell as u64,
        spheres: collected("spheres", spheres.iter().map(|s| four(&s.center, s.radius)))?,
    };
    to_bytes(Kind::Fragment, &record)
}

/// The fragment of bytes, to the last bit, for a parent of the same shape. Refused with
/// `InvalidArgument`: bytes of a fragment of another parent; with `Format`: bytes that are no
/// fragment's or not whole, and what no fragment has; with `Unsupported`: another version.
pub fn fragment_from_bytes(parent: &Parent, bytes: &[u8]) -> Result<FragmentRecord> {
    let found: Record = from_bytes(Kind::Fragment, bytes)?;
    let (own, of) = (parent.hash()?, u128::from_le_bytes(found.parent));
    if own != of {
        return Err(Error::InvalidArgument(format!(
            "the fragment is one of another parent: its hash is {of:032x}, this one's {own:032x}"
        )));
    }
    let bad = |what: String| Err(Error::Format(what));
    // Half-spaces are cut off at 1e6 sizes of the body.
    let plane = |p: &[f64; 4]| {
        let length = Vec3::new(p[0], p[1], p[2]).norm_squared();
        (length - 1.0).abs() < 1e-9 && p[3].abs() <= 1e9
    };
    if let Some(i) = found.planes.iter().position(|p| !plane(p)) {
        return bad(format!("half-space {i} of the bytes is none"));
    }
    let round = |s: &[f64; 4]| s.iter().all(|x| x.is_finite()) && s[3] > 0.0;
    if let Some(i) = found.spheres.iter().position(|s| !round(s)) {
        return bad(format!("sphere {i} of the bytes is not a sphere"));
    }
    let solid = parent.solid();
    let m = &found.moments;
    let most = solid.unit_moments().volume * (1.0 + 1e-6);
    if !(possible(m) && m.volume <= most) {
        return bad("the moments of the bytes are those of no piece of the parent".into());
    }
    let near = |v: &Vec3| v.iter().all(|x| (-2.0..=3.0).contains(x));
    if !(near(&found.lo) && near(&found.hi) && (0..3).all(|a| found.lo[a] <= found.hi[a])) {
        return bad("the box of the bytes is that of no piece of the parent".into());
    }
    if found.mark.as_ref().is_some_and(|m| !m.is_whole()) {
        return bad("the mark of the bytes is not whole".into());
    }
    let count = match solid.body() {
        Body::Mesh(mesh) => mesh.faces.len().max(solid.grid().len()),
        Body::Voxels(v) => v.cells.len(),
    };
    if found.anchor.is_some_and(|a| a >= count as u64) {
        return bad("the bytes name a face or cell that the parent does not have".into());
    }
    let planes =
        found.planes.iter().map(|&[x, y, z, offset]| Plane { normal: Vec3::new(x, y, z), offset });
    let spheres = found.spheres.iter().map(|&[x, y, z, r]| Sphere::new(Vec3::new(x, y, z), r));
    let Ok(cell) = usize::try_from(found.cell) else {
        return bad(format!("cell {} of the bytes", found.cell));
    };
    Ok(FragmentRecord {
        region: Region {
            planes: collected("planes", planes)?,
            mark: found.mark,
            moments: found.moments,
            lo: found.lo,
            hi: found.hi,
            anchor: found.anchor,
            cell,
        },
        spheres: collected("spheres", spheres)?,
    })
}
