//! A box around the hull: that of what lies within the outlines' own boxes, four half-spaces for
//! each camera.

use super::view::View;
use crate::error::{Error, Result, count};
use crate::math::Vec3;
use nalgebra::Matrix3;

/// Lower and upper corner.
pub(super) type Bounds = (Vec3, Vec3);

/// A half-space `normal · x + offset ≥ 0`, the normal of length 1.
type HalfSpace = (Vec3, f64);

/// Most cameras whose half-spaces are intersected, spread over all: the cube of their number counts.
const CAMERAS: usize = 24;
/// Rounding, relative.
const TINY: f64 = 1e-9;

/// The box; `None` where the half-spaces have no point in common.
pub(super) fn rough(views: &[View]) -> Result<Option<Bounds>> {
    let step = views.len().div_ceil(CAMERAS).max(1);
    let mut spaces: Vec<HalfSpace> = Vec::new();
    for (i, view) in views.iter().enumerate().step_by(step) {
        spaces.extend(half_spaces(i, view)?);
    }
    if unbounded(&spaces) {
        return Err(Error::InvalidArgument(format!(
            "{} not bound a body on all sides: more cameras, from other directions, are needed",
            match views.len() {
                1 => "1 silhouette does".into(),
                n => format!("{} do", count(n as u64, "silhouette")),
            }
        )));
    }
    let mut found: Option<Bounds> = None;
    for (i, a) in spaces.iter().enumerate() {
        for (j, b) in spaces.iter().enumerate().skip(i + 1) {
            for c in spaces.iter().skip(j + 1) {
                let normals =
                    Matrix3::from_rows(&[a.0.transpose(), b.0.transpose(), c.0.transpose()]);
                if normals.determinant().abs() < TINY {
                    continue;
                }
                let right = -Vec3::new(a.1, b.1, c.1);
                let Some(p) = normals.lu().solve(&right) else { continue };
                let within = |s: &HalfSpace| s.0.dot(&p) + s.1 >= -TINY * (p.norm() + s.1.abs());
                if spaces.iter().all(within) {
                    found = Some(found.map_or((p, p), |(lo, hi)| (lo.inf(&p), hi.sup(&p))));
                }
            }
        }
    }
    Ok(found)
}

/// What a camera sees within the box of its outline.
fn half_spaces(i: usize, view: &View) -> Result<[HalfSpace; 4]> {
    let row = |k: usize| [0, 1, 2, 3].map(|c| view.camera[4 * k + c]);
    let depth = row(2);
    let mut out = [(Vec3::zeros(), 0.0); 4];
    for (k, space) in out.iter_mut().enumerate() {
        let (axis, lower) = (k % 2, k < 2);
        let edge = if lower { view.from[axis] } else { view.to[axis] } as f64;
        let along = row(axis);
        let sign = if lower { 1.0 } else { -1.0 };
        // u ≥ from · w, or u ≤ to · w.
        let p = [0, 1, 2, 3].map(|c| sign * (along[c] - edge * depth[c]));
        let normal = Vec3::new(p[0], p[1], p[2]);
        let size = along.iter().chain(&depth).fold(0.0f64, |m, x| m.max(x.abs()));
        let length = normal.norm();
        if length <= 1e-14 * size || !(length.is_normal() && (p[3] / length).is_finite()) {
            return Err(Error::InvalidArgument(format!(
                "camera {i} does not see two directions: its matrix has no rank of 3"
            )));
        }
        *space = (normal / length, p[3] / length);
    }
    Ok(out)
}

/// Whether some direction leads out of none of the half-spaces.
fn unbounded(spaces: &[HalfSpace]) -> bool {
    let leads = |d: &Vec3| spaces.iter().all(|s| s.0.dot(d) >= -TINY);
    // The border of such a cone lies along two of the planes; without two there is no border.
    let mut crossing = false;
    for (i, a) in spaces.iter().enumerate() {
        for b in spaces.iter().skip(i + 1) {
            let d = a.0.cross(&b.0);
            let length = d.norm();
            if length < TINY {
                continue;
            }
            crossing = true;
            if leads(&(d / length)) || leads(&(-d / length)) {
                return true;
            }
        }
    }
    !crossing
}
