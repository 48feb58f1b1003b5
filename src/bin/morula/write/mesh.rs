//! Triangle meshes: STL (binary), PLY (binary), OFF and OBJ.

use crate::fail::{Done, Fail};
use morula::math::Vec3;
use std::io::Write;
use std::path::Path;

/// Writes a mesh in the format that the file's name stands for.
pub fn write(path: &str, vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Done {
    let extension = Path::new(path).extension().and_then(|e| e.to_str()).unwrap_or("");
    let writer = match extension.to_ascii_lowercase().as_str() {
        "stl" => stl,
        "ply" => ply,
        "off" => off,
        "obj" => obj,
        _ => {
            return Err(Fail::Usage(format!(
                "{path} ends in none of .stl, .ply, .off, .obj, so its format is not known"
            )));
        }
    };
    super::to(path, |out| writer(out, vertices, faces))
}

type Vertices<'a> = &'a [[f64; 3]];
type Faces<'a> = &'a [[u32; 3]];

/// Binary STL.
pub fn stl(out: &mut dyn Write, vertices: Vertices, faces: Faces) -> std::io::Result<()> {
    let mut header = [b' '; 80];
    let title = b"binary STL by morula";
    header[..title.len()].copy_from_slice(title);
    out.write_all(&header)?;
    out.write_all(&(faces.len() as u32).to_le_bytes())?;
    for f in faces {
        let [a, b, c] = f.map(|i| Vec3::from(vertices[i as usize]));
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_default();
        for v in [normal, a, b, c] {
            for x in v.iter() {
                out.write_all(&(*x as f32).to_le_bytes())?;
            }
        }
        out.write_all(&[0, 0])?;
    }
    Ok(())
}

fn ply(out: &mut dyn Write, vertices: Vertices, faces: Faces) -> std::io::Result<()> {
    writeln!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {}", vertices.len())?;
    writeln!(out, "property double x\nproperty double y\nproperty double z")?;
    writeln!(out, "element face {}", faces.len())?;
    writeln!(out, "property list uchar int vertex_indices\nend_header")?;
    for x in vertices.iter().flatten() {
        out.write_all(&x.to_le_bytes())?;
    }
    for f in faces {
        out.write_all(&[3])?;
        for i in f {
            out.write_all(&i.to_le_bytes())?;
        }
    }
    Ok(())
}

fn off(out: &mut dyn Write, vertices: Vertices, faces: Faces) -> std::io::Result<()> {
    writeln!(out, "OFF\n{} {} 0", vertices.len(), faces.len())?;
    for [x, y, z] in vertices {
        writeln!(out, "{x:?} {y:?} {z:?}")?;
    }
    for [a, b, c] in faces {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    Ok(())
}

fn obj(out: &mut dyn Write, vertices: Vertices, faces: Faces) -> std::io::Result<()> {
    for [x, y, z] in vertices {
        writeln!(out, "v {x:?} {y:?} {z:?}")?;
    }
    for f in faces {
        let [a, b, c] = f.map(|i| i + 1);
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}
