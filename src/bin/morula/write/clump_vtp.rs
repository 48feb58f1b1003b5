//! VTK XML PolyData: one vertex a sphere with the array `radius` (in ParaView:
//! Point Gaussian, or Glyph with a sphere of radius 1 scaled by `radius`).

use morula::Sphere;
use std::io::Write;

pub fn write(out: &mut dyn Write, spheres: &[Sphere]) -> std::io::Result<()> {
    let n = spheres.len();
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(out, "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">")?;
    writeln!(out, "<PolyData>")?;
    writeln!(
        out,
        "<Piece NumberOfPoints=\"{n}\" NumberOfVerts=\"{n}\" NumberOfLines=\"0\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">"
    )?;
    writeln!(out, "<PointData Scalars=\"radius\">")?;
    array(out, "Float64", "radius", 1, spheres.iter().map(|s| format!("{:?}", s.radius)))?;
    array(out, "Int32", "sphere", 1, (0..n).map(|i| i.to_string()))?;
    writeln!(out, "</PointData>\n<Points>")?;
    let point = |s: &Sphere| format!("{:?} {:?} {:?}", s.center.x, s.center.y, s.center.z);
    array(out, "Float64", "points", 3, spheres.iter().map(point))?;
    writeln!(out, "</Points>\n<Verts>")?;
    array(out, "Int32", "connectivity", 1, (0..n).map(|i| i.to_string()))?;
    array(out, "Int32", "offsets", 1, (1..=n).map(|i| i.to_string()))?;
    writeln!(out, "</Verts>\n</Piece>\n</PolyData>\n</VTKFile>")
}

fn array(
    out: &mut dyn Write,
    kind: &str,
    name: &str,
    components: usize,
    values: impl Iterator<Item = String>,
) -> std::io::Result<()> {
    writeln!(
        out,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"ascii\">"
    )?;
    for value in values {
        writeln!(out, "{value}")?;
    }
    writeln!(out, "</DataArray>")
}
