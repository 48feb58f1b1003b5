//! Whether a surface that is not closed has an inside: by the generalised
//! winding number at points of the surface itself.

use super::topology::{Edges, Union};
use crate::error::{Result, filled};
use crate::math::{Vec3, solid_angle};
use crate::run::Pool;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Above this mean openness the inside is not defined. A closed surface has 0, an open
/// box 0.10, a hemisphere 0.19, a scan of a flat rock without its underside 0.37, a
/// flat sheet and faces at random ½ or more.
pub const MOST_OPEN: f64 = 0.4;

const SAMPLES: usize = 256;
/// Cells along an edge of the unit cube for the clusters of faces.
const CELLS: usize = 16;
/// A cluster is taken as one dipole from this many of its radii.
const FAR: f64 = 3.0;

struct Cluster {
    faces: std::ops::Range<usize>,
    center: Vec3,
    radius: f64,
    /// Sum of the area vectors.
    area: Vec3,
}

/// The winding number of a set of faces, far clusters as dipoles: good to a few
/// thousandths, which is enough to judge openness and nesting. The unit
/// frame's lengths are at most one.
pub struct Field {
    corners: Vec<[Vec3; 3]>,
    clusters: Vec<Cluster>,
}

impl Field {
    /// The field of some faces.
    pub fn new<'a>(faces: impl Iterator<Item = &'a [u32; 3]>, points: &[Vec3]) -> Field {
        let cell = |t: &[Vec3; 3]| {
            let c = (t[0] + t[1] + t[2]) / 3.0 * CELLS as f64;
            (c.x.floor() as i64, c.y.floor() as i64, c.z.floor() as i64)
        };
        let mut corners: Vec<[Vec3; 3]> = faces.map(|f| f.map(|v| points[v as usize])).collect();
        corners.sort_by_cached_key(cell);
        let mut clusters = Vec::new();
        let mut at = 0;
        for group in corners.chunk_by(|a, b| cell(a) == cell(b)) {
            let (mut area, mut center, mut weight) = (Vec3::zeros(), Vec3::zeros(), 0.0);
            for [a, b, c] in group {
                let n = (b - a).cross(&(c - a)) / 2.0;
                let w = n.norm();
                area += n;
                center += (a + b + c) / 3.0 * w;
                weight += w;
            }
            let center = if weight > 0.0 { center / weight } else { group[0][0] };
            let far = group.iter().flatten().map(|v| (v - center).norm());
            clusters.push(Cluster {
                faces: at..at + group.len(),
                center,
                radius: far.fold(0.0, f64::max),
                area,
            });
            at += group.len();
        }
        Field { corners, clusters }
    }

    /// The winding number of `p`. A face in whose plane `p` lies adds nothing: on the
    /// surface this is the mean of both sides.
    pub fn at(&self, p: &Vec3) -> f64 {
        let mut sum = 0.0;
        for c in &self.clusters {
            let d = c.center - p;
            let r = d.norm();
            if r > FAR * c.radius {
                sum += c.area.dot(&d) / (r * r * r);
            } else {
                sum += self.corners[c.faces.clone()].iter().map(|t| facing(t, p)).sum::<f64>();
            }
        }
        sum / (4.0 * PI)
    }
}

/// Points of some faces with the area that each stands for: the middle of every face,
/// or of [`SAMPLES`] faces that are spread evenly over the area.
pub fn samples<'a>(
    faces: impl ExactSizeIterator<Item = &'a [u32; 3]> + Clone,
    points: &[Vec3],
) -> Vec<(Vec3, f64)> {
    let corners = |f: &[u32; 3]| f.map(|v| points[v as usize]);
    let area = |[a, b, c]: [Vec3; 3]| (b - a).cross(&(c - a)).norm() / 2.0;
    let middle = |[a, b, c]: [Vec3; 3]| (a + b + c) / 3.0;
    if faces.len() <= SAMPLES {
        return faces.map(|f| (middle(corners(f)), area(corners(f)))).collect();
    }
    let step = faces.clone().map(|f| area(corners(f))).sum::<f64>() / SAMPLES as f64;
    let mut found = Vec::with_capacity(SAMPLES);
    let mut sum = 0.0;
    for f in faces {
        sum += area(corners(f));
        while found.len() < SAMPLES && sum >= step * (found.len() as f64 + 0.5) {
            found.push((middle(corners(f)), step));
        }
    }
    found
}

/// The mean openness of a surface at points on it, in `field`. Where a surface bounds
/// the inside, the winding number on it (the mean of both sides) is ½; what it
/// is short of that is the fraction of all directions that the point sees
/// through openings. From 1 on it is wrapped several times, and the nearest of 1½,
/// 2½ … counts. Of the two sides that may be the outer one, the better is taken.
pub fn openness(at: &[(Vec3, f64)], field: &Field, pool: &Pool) -> f64 {
    let short = |w: f64| if w < 1.0 { (w - 0.5).abs() } else { (w - w.floor() - 0.5).abs() };
    let both = pool.map(at.len(), |i| {
        let w = field.at(&at[i].0);
        (short(w), short(-w))
    });
    let (mut out, mut turned, mut area) = (0.0, 0.0, 0.0);
    for (b, (_, a)) in both.iter().zip(at) {
        out += b.0 * a;
        turned += b.1 * a;
        area += a;
    }
    if area > 0.0 { f64::min(out, turned) / area } else { 1.0 }
}

/// The solid angle, zero for points in the plane of the face.
fn facing(t: &[Vec3; 3], p: &Vec3) -> f64 {
    let [a, b, c] = t.map(|v| v - p);
    let volume = a.dot(&b.cross(&c));
    // Relative to the product of the lengths: the centroid of the face itself.
    if volume.abs() <= 1e-12 * a.norm() * b.norm() * c.norm() { 0.0 } else { solid_angle(t, p) }
}

/// Whether all faces lie in one plane.
pub fn is_flat(faces: &[[u32; 3]], points: &[Vec3]) -> bool {
    let corners = |f: &[u32; 3]| f.map(|v| points[v as usize]);
    let mut normal = Vec3::zeros();
    let mut origin = Vec3::zeros();
    for f in faces {
        let [a, b, c] = corners(f);
        let n = (b - a).cross(&(c - a));
        if n.norm_squared() > normal.norm_squared() {
            (normal, origin) = (n, a);
        }
    }
    let length = normal.norm();
    length > 0.0
        && faces.iter().flat_map(corners).all(|p| (p - origin).dot(&normal).abs() <= 1e-9 * length)
}

/// What the faces of a part enclose.
#[derive(Debug, Clone, Copy, Default)]
pub struct Extent {
    /// Signed volume, with every opening closed by a fan to its middle: so it does not
    /// depend on the origin.
    pub volume: f64,
    /// Area.
    pub area: f64,
    /// Whether there are edges that are not run along equally in both ways.
    pub open: bool,
}

/// The extent of each part; `part` is the number of each face's part.
pub fn extents(
    faces: &[[u32; 3]],
    points: &[Vec3],
    part: &[u32],
    parts: usize,
    edges: &Edges,
) -> Result<Vec<Extent>> {
    let mut sums = filled("parts", parts, Extent::default())?;
    // About a corner of each part, which keeps the terms of small parts small.
    let mut origin = filled("parts", parts, None)?;
    for (f, &p) in faces.iter().zip(part) {
        let o = *origin[p as usize].get_or_insert(points[f[0] as usize]);
        let [a, b, c] = f.map(|v| points[v as usize] - o);
        let sum = &mut sums[p as usize];
        sum.volume += a.dot(&b.cross(&c));
        sum.area += (b - a).cross(&(c - a)).norm();
    }
    // Directed edges that no other face of the part runs back along.
    let mut rims: Vec<(u32, u32, u32)> = Vec::new();
    let mut net: Vec<(u32, i32)> = Vec::new();
    for e in edges.iter() {
        net.clear();
        for s in e {
            let (p, d) = (part[s.face as usize], if s.forward { 1 } else { -1 });
            match net.iter_mut().find(|n| n.0 == p) {
                Some(n) => n.1 += d,
                None => net.push((p, d)),
            }
        }
        let (lo, hi) = ((e[0].key >> 32) as u32, e[0].key as u32);
        for &(p, d) in &net {
            let edge = if d > 0 { (p, lo, hi) } else { (p, hi, lo) };
            rims.extend(std::iter::repeat_n(edge, d.unsigned_abs() as usize));
        }
    }
    let mut union = Union::new(points.len())?;
    rims.iter().for_each(|r| union.join(r.1, r.2));
    let mut middle: BTreeMap<(u32, u32), (Vec3, f64)> = BTreeMap::new();
    for r in &rims {
        let m = middle.entry((r.0, union.root(r.1))).or_insert((Vec3::zeros(), 0.0));
        m.0 += (points[r.1 as usize] + points[r.2 as usize]) / 2.0;
        m.1 += 1.0;
    }
    for r in &rims {
        let sum = &mut sums[r.0 as usize];
        sum.open = true;
        if let (Some(m), Some(o)) = (middle.get(&(r.0, union.root(r.1))), origin[r.0 as usize]) {
            let (a, b) = (points[r.1 as usize] - o, points[r.2 as usize] - o);
            sum.volume += (m.0 / m.1 - o).dot(&b.cross(&a));
        }
    }
    for s in &mut sums {
        s.volume /= 6.0;
        s.area /= 2.0;
    }
    Ok(sums)
}

/// The signed volume of patches that close each other's openings but for cracks: about
/// their middle, so that cracks count little.
pub fn volume_of_patches<'a>(
    faces: impl Iterator<Item = &'a [u32; 3]> + Clone,
    points: &[Vec3],
) -> f64 {
    let corners = |f: &[u32; 3]| f.map(|v| points[v as usize]);
    let (mut middle, mut area) = (Vec3::zeros(), 0.0);
    for [a, b, c] in faces.clone().map(corners) {
        let w = (b - a).cross(&(c - a)).norm();
        middle += (a + b + c) / 3.0 * w;
        area += w;
    }
    if area > 0.0 {
        middle /= area;
    }
    let six = faces.map(|f| {
        let [a, b, c] = corners(f).map(|v| v - middle);
        a.dot(&b.cross(&c))
    });
    six.sum::<f64>() / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_clusters_are_close_to_the_sum_of_all_faces() {
        // A bumpy sphere without its north.
        let (n, m) = (24, 48);
        let mut points = Vec::new();
        for i in 0..=n {
            for j in 0..m {
                let (t, f) = (PI * i as f64 / n as f64, 2.0 * PI * j as f64 / m as f64);
                let r = 0.4 + 0.05 * (5.0 * f).sin() * t.sin();
                points.push(
                    Vec3::repeat(0.5)
                        + Vec3::new(t.sin() * f.cos(), t.sin() * f.sin(), t.cos()) * r,
                );
            }
        }
        let at = |i: usize, j: usize| (i * m + j % m) as u32;
        let mut faces = Vec::new();
        for i in 4..n {
            for j in 0..m {
                faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        let field = Field::new(faces.iter(), &points);
        for k in 0..200 {
            let g = |a: f64| (f64::from(k) * a).fract();
            let p = Vec3::new(g(0.618), g(0.414), g(0.732));
            let all: f64 = faces.iter().map(|f| facing(&f.map(|v| points[v as usize]), &p)).sum();
            assert!((field.at(&p) - all / (4.0 * PI)).abs() < 5e-3);
        }
    }
}
