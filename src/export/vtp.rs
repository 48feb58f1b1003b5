//! VTK XML PolyData: a vertex for each sphere with the arrays `radius`, `sphere` (its number) and
//! `mass` (in ParaView: Point Gaussian, or Glyph with a sphere of radius 1 scaled by `radius`).

use crate::math::{Sphere, Vec3};
use std::fmt::{Display, Write};

/// The file; without masses where there are none.
pub fn vtp(spheres: &[Sphere], masses: &[f64]) -> String {
    points(spheres, |out| {
        array(out, ("Int64", "sphere", 1), 0..spheres.len());
        if !masses.is_empty() {
            array(out, ("Float64", "mass", 1), masses.iter().map(|m| format!("{m:?}")));
        }
    })
}

/// Spheres of many bodies, with the arrays `radius`, `body` (its label) and `velocity`.
pub fn vtp_points(spheres: &[Sphere], bodies: &[u64], velocities: &[Vec3]) -> String {
    points(spheres, |out| {
        array(out, ("Int64", "body", 1), bodies.iter());
        let three = |v: &Vec3| format!("{:?} {:?} {:?}", v.x, v.y, v.z);
        array(out, ("Float64", "velocity", 3), velocities.iter().map(three));
    })
}

fn points(spheres: &[Sphere], further: impl FnOnce(&mut String)) -> String {
    let n = spheres.len();
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <PolyData>\n\
         <Piece NumberOfPoints=\"{n}\" NumberOfVerts=\"{n}\" NumberOfLines=\"0\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n\
         <PointData Scalars=\"radius\">\n"
    );
    array(&mut out, ("Float64", "radius", 1), spheres.iter().map(|s| format!("{:?}", s.radius)));
    further(&mut out);
    out.push_str("</PointData>\n<Points>\n");
    let point = |s: &Sphere| format!("{:?} {:?} {:?}", s.center.x, s.center.y, s.center.z);
    array(&mut out, ("Float64", "points", 3), spheres.iter().map(point));
    out.push_str("</Points>\n<Verts>\n");
    array(&mut out, ("Int64", "connectivity", 1), 0..n);
    array(&mut out, ("Int64", "offsets", 1), 1..=n);
    out.push_str("</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    out
}

fn array<T: Display>(
    out: &mut String,
    (kind, name, components): (&str, &str, usize),
    values: impl Iterator<Item = T>,
) {
    let _ = writeln!(
        out,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"ascii\">"
    );
    values.for_each(|v| {
        let _ = writeln!(out, "{v}");
    });
    out.push_str("</DataArray>\n");
}
