//! `x,y,z,r`, one sphere a line; the shortest digits that read back the same.

use morula::Sphere;
use std::io::Write;

pub fn write(out: &mut dyn Write, spheres: &[Sphere]) -> std::io::Result<()> {
    writeln!(out, "x,y,z,r")?;
    for s in spheres {
        let c = &s.center;
        writeln!(out, "{:?},{:?},{:?},{:?}", c.x, c.y, c.z, s.radius)?;
    }
    Ok(())
}
