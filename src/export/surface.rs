//! Each sphere as an icosphere: closed shells that overlap as the spheres do, not the surface of
//! their union. Spheres that lie within another are left out.

use crate::error::{Error, Result, collected, reserve};
use crate::math::{Sphere, Vec3};
use std::collections::BTreeMap;

/// Most levels of facets.
const MOST: u32 = 6;

/// Binary PLY: double precision, and the number of its sphere at each vertex.
pub fn ply(spheres: &[Sphere], facets: u32) -> Result<Vec<u8>> {
    let (points, faces) = icosphere(facets)?;
    let shown = shown(spheres)?;
    let (vertices, triangles) = count(shown.len(), points.len(), faces.len())?;
    let header = format!(
        "ply\nformat binary_little_endian 1.0\n\
         comment each sphere as an icosphere, not their union\n\
         element vertex {vertices}\n\
         property double x\nproperty double y\nproperty double z\nproperty int sphere\n\
         element face {triangles}\nproperty list uchar int vertex_indices\nend_header\n"
    );
    let mut out = reserve("a surface", header.len() + 28 * vertices + 13 * triangles)?;
    out.extend(header.bytes());
    for &(i, s) in &shown {
        for p in &points {
            let v = s.center + p * s.radius;
            v.iter().for_each(|x| out.extend(x.to_le_bytes()));
            out.extend((i as i32).to_le_bytes());
        }
    }
    for k in 0..shown.len() {
        for f in &faces {
            out.push(3);
            f.iter().for_each(|v| out.extend(((k * points.len() + v) as i32).to_le_bytes()));
        }
    }
    Ok(out)
}

/// Binary STL, which holds single precision.
pub fn stl(spheres: &[Sphere], facets: u32) -> Result<Vec<u8>> {
    let (points, faces) = icosphere(facets)?;
    let shown = shown(spheres)?;
    let (_, triangles) = count(shown.len(), points.len(), faces.len())?;
    let mut out = reserve("a surface", 84 + 50 * triangles)?;
    out.extend(format!("{:80}", "binary STL by morula: each sphere as an icosphere").bytes());
    out.extend((triangles as u32).to_le_bytes());
    for (_, s) in shown {
        for f in &faces {
            let [a, b, c] = f.map(|i| s.center + points[i] * s.radius);
            let normal = (points[f[0]] + points[f[1]] + points[f[2]]).normalize();
            for v in [normal, a, b, c] {
                v.iter().for_each(|x| out.extend((*x as f32).to_le_bytes()));
            }
            out.extend([0, 0]);
        }
    }
    Ok(out)
}

/// Vertices and triangles of so many spheres, as far as the formats can number them.
fn count(spheres: usize, points: usize, faces: usize) -> Result<(usize, usize)> {
    let most = i32::MAX as usize / faces;
    if spheres > most {
        return Err(Error::TooLarge(format!(
            "{spheres} spheres of {faces} facets are more than a file can number"
        )));
    }
    Ok((spheres * points, spheres * faces))
}

/// The spheres that lie in no other, with their numbers; of equal ones the first.
fn shown(spheres: &[Sphere]) -> Result<Vec<(usize, &Sphere)>> {
    let hidden = |i: usize, s: &Sphere| {
        spheres.iter().enumerate().any(|(j, o)| {
            let apart = (o.center - s.center).norm();
            apart + s.radius <= o.radius && (j < i || o.radius > s.radius || apart > 0.0) && i != j
        })
    };
    collected("spheres of a surface", spheres.iter().enumerate().filter(|(i, s)| !hidden(*i, s)))
}

/// The unit icosahedron, each face cut in four so many times.
fn icosphere(levels: u32) -> Result<(Vec<Vec3>, Vec<[usize; 3]>)> {
    if levels > MOST {
        return Err(Error::InvalidArgument(format!("facets is {levels}, more than {MOST}")));
    }
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
    Ok((points, faces))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_icosphere_is_closed_outward_and_round() {
        let (points, faces) = icosphere(3).unwrap();
        assert_eq!((points.len(), faces.len()), (642, 1280));
        let volume: f64 =
            faces.iter().map(|f| points[f[0]].dot(&points[f[1]].cross(&points[f[2]])) / 6.0).sum();
        let ball = 4.0 / 3.0 * std::f64::consts::PI;
        assert!(volume > 0.98 * ball && volume < ball, "{volume}");
        assert!(icosphere(7).is_err());
    }

    #[test]
    fn what_lies_within_another_is_left_out() {
        let sphere = |x: f64, r: f64| Sphere::new(Vec3::new(x, 0.0, 0.0), r);
        let all = [sphere(0.0, 1.0), sphere(0.2, 0.5), sphere(0.0, 1.0), sphere(0.5, 0.6)];
        let numbers: Vec<usize> = shown(&all).unwrap().iter().map(|(i, _)| *i).collect();
        assert_eq!(numbers, [0, 3]);
        assert_eq!(stl(&all, 1).unwrap().len(), 84 + 50 * 2 * 80);
    }
}
