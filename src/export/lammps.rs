//! LAMMPS: a molecule template, and the `infile` of `fix rigid/small`.
//!
//! The template's six moments are documented as xx, yy, zz, xy, xz, yz and used as xx, yy, zz, yz,
//! xz, xy by `fix deposit … mol … rigid`; here the last three are 0. The masses of atoms sum to
//! the body's, or gravity would be wrong.

use super::Record;
use crate::error::{Error, Result};
use crate::math::Inertia;
use nalgebra::Matrix3;
use std::fmt::Write;

pub(super) fn molecule(r: &Record) -> Result<String> {
    let n = r.spheres.len();
    several(r)?;
    let mut out = String::new();
    let [a, b, c] = r.moments;
    let _ = writeln!(
        out,
        "# {}: clump of {n} spheres, centre of mass at the origin, principal axes",
        r.title()
    );
    let _ = writeln!(out, "\n{n} atoms\n{:?} mass\n0.0 0.0 0.0 com", r.mass);
    let _ = writeln!(out, "{a:?} {b:?} {c:?} 0.0 0.0 0.0 inertia");
    out.push_str("\nCoords\n\n");
    for (i, s) in r.spheres.iter().enumerate() {
        let c = &s.center;
        let _ = writeln!(out, "{} {:?} {:?} {:?}", i + 1, c.x, c.y, c.z);
    }
    out.push_str("\nTypes\n\n");
    (1..=n).for_each(|i| {
        let _ = writeln!(out, "{i} 1");
    });
    out.push_str("\nDiameters\n\n");
    for (i, s) in r.spheres.iter().enumerate() {
        let _ = writeln!(out, "{} {:?}", i + 1, 2.0 * s.radius);
    }
    out.push_str("\nMasses\n\n");
    for (i, m) in r.masses.iter().enumerate() {
        let _ = writeln!(out, "{} {m:?}", i + 1);
    }
    Ok(out)
}

/// Body 1 at rest: in the frame of the body, or where the caller has it.
pub(super) fn rigid(r: &Record, placed: bool) -> Result<String> {
    several(r)?;
    let principal = Matrix3::from_diagonal(&r.moments.into());
    let (center, tensor) = if placed {
        (r.center, Inertia::from_matrix(&(r.axes * principal * r.axes.transpose())))
    } else {
        (crate::math::Vec3::zeros(), Inertia::from_matrix(&principal))
    };
    let [xx, yy, zz, xy, xz, yz] = tensor.to_array();
    Ok(format!(
        "# {}: id mass x y z ixx iyy izz ixy ixz iyz vx vy vz lx ly lz ix iy iz, world axes\n\
         1\n\
         1 {:?} {:?} {:?} {:?} {xx:?} {yy:?} {zz:?} {xy:?} {xz:?} {yz:?} 0 0 0 0 0 0 0 0 0\n",
        r.title(),
        r.mass,
        center.x,
        center.y,
        center.z
    ))
}

fn several(r: &Record) -> Result<()> {
    if r.spheres.len() < 2 {
        return Err(Error::Unsupported(
            "a rigid body of LAMMPS has two atoms or more, the clump has one sphere".into(),
        ));
    }
    Ok(())
}
