//! Whether a surface that is not closed has an inside: by the generalised
//! winding number at points of the surface itself.

use super::check::Grain;
use super::field::Field;
use super::topology::{Edges, Union};
use crate::error::{Result, filled, push, reserve};
use crate::math::Vec3;
use crate::run::Pool;

/// Above this mean openness the inside is not defined. A closed surface has 0, an open
/// box 0.10, a hemisphere 0.19, a scan of a flat rock without its underside 0.37, a
/// flat sheet and faces at random ½ or more.
pub const MOST_OPEN: f64 = 0.4;

const SAMPLES: usize = 256;

/// Fewer points than this are not worth a start of the pool.
const FEW: usize = 16;

/// Points of some faces with the area that each stands for: the middle of every face,
/// or of [`SAMPLES`] faces that are spread evenly over the area.
pub fn samples<'a>(
    faces: impl ExactSizeIterator<Item = &'a [u32; 3]> + Clone,
    points: &[Vec3],
) -> Result<Vec<(Vec3, f64)>> {
    let corners =
        |f: &[u32; 3]| [points[f[0] as usize], points[f[1] as usize], points[f[2] as usize]];
    let area = |[a, b, c]: [Vec3; 3]| (b - a).cross(&(c - a)).norm() / 2.0;
    let middle = |[a, b, c]: [Vec3; 3]| (a + b + c) / 3.0;
    let mut found = reserve("samples", faces.len().min(SAMPLES))?;
    if faces.len() <= SAMPLES {
        found.extend(faces.map(|f| (middle(corners(f)), area(corners(f)))));
        return Ok(found);
    }
    let step = faces.clone().map(|f| area(corners(f))).sum::<f64>() / SAMPLES as f64;
    let mut sum = 0.0;
    for f in faces {
        sum += area(corners(f));
        while found.len() < SAMPLES && sum >= step * (found.len() as f64 + 0.5) {
            found.push((middle(corners(f)), step));
        }
    }
    Ok(found)
}

/// The mean openness of a surface at points on it, in `field`. Where a surface bounds
/// the inside, the winding number on it (the mean of both sides) is ½; what it
/// is short of that is the fraction of all directions that the point sees
/// through openings. From 1 on it is wrapped several times, and the nearest of 1½,
/// 2½ … counts. Of the two sides that may be the outer one, the better is taken.
/// `looks` counts the faces that were looked at.
pub fn openness(at: &[(Vec3, f64)], field: &Field, pool: &Pool, looks: &mut u64) -> f64 {
    let short = |w: f64| if w < 1.0 { (w - 0.5).abs() } else { (w - w.floor() - 0.5).abs() };
    let both = |i: usize| {
        let mut looks = 0;
        let w = field.at(&at[i].0, &mut looks);
        (short(w), short(-w), looks)
    };
    let (mut out, mut turned, mut area) = (0.0, 0.0, 0.0);
    let mut add = |b: (f64, f64, u64), a: f64| {
        *looks += b.2;
        out += b.0 * a;
        turned += b.1 * a;
        area += a;
    };
    if at.len() < FEW {
        at.iter().enumerate().for_each(|(i, x)| add(both(i), x.1));
    } else {
        pool.map(at.len(), both).into_iter().zip(at).for_each(|(b, x)| add(b, x.1));
    }
    if area > 0.0 { f64::min(out, turned) / area } else { 1.0 }
}

/// Whether all faces lie in one plane.
pub fn is_flat(faces: &[[u32; 3]], points: &[Vec3], grain: Grain) -> bool {
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
        && faces
            .iter()
            .flat_map(corners)
            .all(|p| (p - origin).dot(&normal).abs() <= grain.touch() * length)
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
        let at = |v: u32| points[v as usize] - o;
        let (a, b, c) = (at(f[0]), at(f[1]), at(f[2]));
        let sum = &mut sums[p as usize];
        sum.volume += a.dot(&b.cross(&c));
        sum.area += (b - a).cross(&(c - a)).norm();
    }
    let rims = rims(part, edges)?;
    let mut union = Union::new(if rims.is_empty() { 0 } else { points.len() })?;
    rims.iter().for_each(|r| union.join(r.from, r.to));
    // The middle of each opening: by part and by what hangs together.
    let mut order: Vec<((u32, u32), u32)> = reserve("openings", rims.len())?;
    order.extend(rims.iter().enumerate().map(|(k, r)| ((r.part, union.root(r.from)), k as u32)));
    order.sort_unstable();
    for opening in order.chunk_by(|a, b| a.0 == b.0) {
        let around = || opening.iter().map(|o| &rims[o.1 as usize]);
        let place = |v: u32| points[v as usize];
        let middle = around().map(|r| (place(r.from) + place(r.to)) / 2.0).sum::<Vec3>()
            / opening.len() as f64;
        let p = opening[0].0.0 as usize;
        let o = origin[p].unwrap_or(middle);
        sums[p].open = true;
        for r in around() {
            let (a, b) = (place(r.from) - o, place(r.to) - o);
            sums[p].volume += (middle - o).dot(&b.cross(&a));
        }
    }
    for s in &mut sums {
        s.volume /= 6.0;
        s.area /= 2.0;
    }
    Ok(sums)
}

/// An edge that a part's faces run along, but not as often back.
struct Rim {
    part: u32,
    from: u32,
    to: u32,
}

fn rims(part: &[u32], edges: &Edges) -> Result<Vec<Rim>> {
    let mut rims: Vec<Rim> = Vec::new();
    let mut here: Vec<(u32, i32)> = Vec::new();
    for e in edges.iter() {
        if let [a, b] = e
            && a.forward != b.forward
            && part[a.face as usize] == part[b.face as usize]
        {
            continue;
        }
        here.clear();
        for s in e {
            push("sides", &mut here, (part[s.face as usize], if s.forward { 1 } else { -1 }))?;
        }
        here.sort_unstable_by_key(|h| h.0);
        let (lo, hi) = ((e[0].key >> 32) as u32, e[0].key as u32);
        for same in here.chunk_by(|a, b| a.0 == b.0) {
            let net: i32 = same.iter().map(|h| h.1).sum();
            let (from, to) = if net > 0 { (lo, hi) } else { (hi, lo) };
            for _ in 0..net.unsigned_abs() {
                push("openings", &mut rims, Rim { part: same[0].0, from, to })?;
            }
        }
    }
    Ok(rims)
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
