//! Binary PLY: every sphere as an icosphere, with its number at each vertex.
//! The spheres overlap as they are; this is not the surface of the union.

use morula::Sphere;
use morula::math::Vec3;
use std::collections::BTreeMap;
use std::io::Write;

pub fn write(out: &mut dyn Write, spheres: &[Sphere]) -> std::io::Result<()> {
    let (points, faces) = icosphere(3);
    writeln!(out, "ply\nformat binary_little_endian 1.0")?;
    writeln!(out, "comment each sphere as an icosphere, not their union")?;
    writeln!(out, "element vertex {}", spheres.len() * points.len())?;
    writeln!(out, "property double x\nproperty double y\nproperty double z\nproperty int sphere")?;
    writeln!(out, "element face {}", spheres.len() * faces.len())?;
    writeln!(out, "property list uchar int vertex_indices\nend_header")?;
    for (i, s) in spheres.iter().enumerate() {
        for p in &points {
            for v in (s.center + p * s.radius).iter() {
                out.write_all(&v.to_le_bytes())?;
            }
            out.write_all(&(i as i32).to_le_bytes())?;
        }
    }
    for i in 0..spheres.len() {
        for f in &faces {
            out.write_all(&[3])?;
            for v in f {
                out.write_all(&((i * points.len() + v) as i32).to_le_bytes())?;
            }
        }
    }
    Ok(())
}

/// The unit icosahedron, each face cut in four `levels` times.
fn icosphere(levels: usize) -> (Vec<Vec3>, Vec<[usize; 3]>) {
    let t = (1.0 + 5f64.sqrt()) / 2.0;
    let mut points = Vec::new();
    for (a, b) in [(-1.0, t), (1.0, t), (-1.0, -t), (1.0, -t)] {
        points.push(Vec3::new(a, b, 0.0));
    }
    for (b, c) in [(-1.0, t), (1.0, t), (-1.0, -t), (1.0, -t)] {
        points.push(Vec3::new(0.0, b, c));
    }
    for (c, a) in [(-1.0, t), (1.0, t), (-1.0, -t), (1.0, -t)] {
        points.push(Vec3::new(a, 0.0, c));
    }
    for p in &mut points {
        p.normalize_mut();
    }
    #[rustfmt::skip]
    let mut faces = vec![
        [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11],
        [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
        [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9],
        [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
    ];
    for _ in 0..levels {
        let mut middles = BTreeMap::new();
        let mut finer = Vec::with_capacity(4 * faces.len());
        for [a, b, c] in faces {
            let mut middle = |i: usize, j: usize| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    points.push((points[i] + points[j]).normalize());
                    points.len() - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        faces = finer;
    }
    (points, faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_icosphere_is_closed_outward_and_round() {
        let (points, faces) = icosphere(3);
        assert_eq!((points.len(), faces.len()), (642, 1280));
        let volume: f64 =
            faces.iter().map(|f| points[f[0]].dot(&points[f[1]].cross(&points[f[2]])) / 6.0).sum();
        let ball = 4.0 / 3.0 * std::f64::consts::PI;
        assert!(volume > 0.98 * ball && volume < ball, "{volume}");
    }
}
