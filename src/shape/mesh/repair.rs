//! Repair that is safe: faces without area, faces present twice, orientation.

use super::topology::{Edges, Patches};
use crate::error::{Result, filled, reserve};
use crate::math::Vec3;
use crate::shape::Report;

/// Height below which a face has no area, in units of the frame: the rounding of
/// coordinates of size one, with room for a few operations.
const FLAT: f64 = 1e-12;

/// Drops faces that name a vertex twice or whose corners lie on a line; how many.
pub fn drop_degenerate(faces: &mut Vec<[u32; 3]>, points: &[Vec3]) -> Result<u64> {
    let before = faces.len();
    faces.retain(|f| {
        let [a, b, c] = f.map(|v| points[v as usize]);
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        f[0] != f[1] && f[1] != f[2] && f[2] != f[0] && double_area(&a, &b, &c) > FLAT * longest
    });
    Ok((before - faces.len()) as u64)
}

fn double_area(a: &Vec3, b: &Vec3, c: &Vec3) -> f64 {
    (b - a).cross(&(c - a)).norm()
}

/// Keeps one of the faces with the same three vertices; how many were dropped.
pub fn drop_duplicates(faces: &mut Vec<[u32; 3]>) -> Result<u64> {
    let mut order: Vec<([u32; 3], u32)> = reserve("faces", faces.len())?;
    for (i, f) in faces.iter().enumerate() {
        let mut s = *f;
        s.sort_unstable();
        order.push((s, i as u32));
    }
    order.sort_unstable();
    let mut keep = filled("faces", faces.len(), true)?;
    for w in order.windows(2) {
        if w[0].0 == w[1].0 {
            keep[w[1].1 as usize] = false;
        }
    }
    let before = faces.len();
    let mut it = keep.iter();
    faces.retain(|_| it.next().copied().unwrap_or(true));
    Ok((before - faces.len()) as u64)
}

/// Makes neighbours agree, then turns each patch outward by its volume.
pub fn orient(
    faces: &mut [[u32; 3]],
    points: &[Vec3],
    edges: &Edges,
    patches: &Patches,
    report: &mut Report,
) -> Result<()> {
    let turn = flood(faces.len(), edges)?;
    for (f, &t) in faces.iter_mut().zip(&turn) {
        if t {
            f.swap(1, 2);
            report.faces_turned += 1;
        }
    }
    let mut volume = vec![0.0; patches.count];
    for (f, &p) in faces.iter().zip(&patches.of) {
        let [a, b, c] = f.map(|v| points[v as usize]);
        volume[p as usize] += a.dot(&b.cross(&c));
    }
    if volume.iter().all(|&v| v < 0.0) {
        faces.iter_mut().for_each(|f| f.swap(1, 2));
        report.inverted = report.faces_turned == 0;
    }
    Ok(())
}

/// Which faces to turn so that neighbours across edges with two faces agree, starting
/// from the lowest face of each patch.
fn flood(faces: usize, edges: &Edges) -> Result<Vec<bool>> {
    let mut neighbours: Vec<(u32, u32, bool)> = reserve("neighbours", faces * 6)?;
    for e in edges.iter() {
        if let [a, b] = e {
            let same = a.forward == b.forward;
            neighbours.push((a.face, b.face, same));
            neighbours.push((b.face, a.face, same));
        }
    }
    neighbours.sort_unstable();
    let mut start = filled("neighbours", faces + 1, 0u32)?;
    for n in &neighbours {
        start[n.0 as usize + 1] += 1;
    }
    for i in 0..faces {
        start[i + 1] += start[i];
    }
    let mut turn = filled("turns", faces, false)?;
    let mut seen = filled("turns", faces, false)?;
    let mut stack: Vec<u32> = Vec::new();
    for first in 0..faces {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        stack.push(first as u32);
        while let Some(f) = stack.pop() {
            let f = f as usize;
            for &(_, g, same) in &neighbours[start[f] as usize..start[f + 1] as usize] {
                if !seen[g as usize] {
                    seen[g as usize] = true;
                    turn[g as usize] = turn[f] != same;
                    stack.push(g);
                }
            }
        }
    }
    Ok(turn)
}

/// Signed volume and area, summed in the order of the faces.
pub fn volume_and_area(points: &[Vec3], faces: &[[u32; 3]]) -> (f64, f64) {
    let (mut volume, mut area) = (0.0, 0.0);
    // About the middle of the unit box, which keeps the terms small.
    let middle = Vec3::repeat(0.5);
    for f in faces {
        let [a, b, c] = f.map(|v| points[v as usize] - middle);
        volume += a.dot(&b.cross(&c));
        area += double_area(&a, &b, &c);
    }
    (volume / 6.0, area / 2.0)
}
