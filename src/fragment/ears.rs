//! Caps cut into triangles.
//!
//! Whatever loops there are, the triangles that are made of them have them as their border: a
//! surface stays closed even where rounding makes an outline cross itself.

use super::cap::{Cap, Flat};
use crate::error::{Result, collected, push, reserve};
use crate::math::{Ears, Next, Vec3, turn};

/// More corners than this are cut as a fan.
const MOST_EARS: usize = 1 << 15;

/// Cuts a cap into triangles.
pub(super) fn triangulate(
    cap: &Cap,
    vertices: &[Vec3],
    normal: &Vec3,
    out: &mut Vec<[u32; 3]>,
) -> Result<()> {
    let flat = Flat::new(vertices, normal);
    let Some((outline, holes)) = cap.loops.split_first() else { return Ok(()) };
    let mut ring = collected("corners of a cap", outline.iter().copied())?;
    let right = |h: &Vec<u32>| {
        let by = |i: &usize, j: &usize| flat.at(h[*i])[0].total_cmp(&flat.at(h[*j])[0]);
        (0..h.len()).max_by(by).unwrap_or(0)
    };
    let mut order: Vec<(usize, &Vec<u32>)> = reserve("holes of a cap", holes.len())?;
    order.extend(holes.iter().map(|h| (right(h), h)));
    // From the right: a bridge then meets no hole that has none yet.
    order.sort_by(|(i, g), (j, h)| flat.at(h[*j])[0].total_cmp(&flat.at(g[*i])[0]));
    for (at, hole) in order {
        match bridge(&ring, flat.at(hole[at]), &flat) {
            Some(k) => {
                let mut whole = reserve("corners of a cap", ring.len() + hole.len() + 2)?;
                whole.extend_from_slice(&ring[..=k]);
                whole.extend_from_slice(&hole[at..]);
                whole.extend_from_slice(&hole[..=at]);
                whole.extend_from_slice(&ring[k..]);
                ring = whole;
            }
            None => ears(hole, &flat, out)?,
        }
    }
    ears(&ring, &flat, out)
}

/// The corner of a ring that a point sees (Eberly 2002): that at the next edge to the right, or the
/// hollow corner that hides it.
fn bridge(ring: &[u32], p: [f64; 2], flat: &Flat) -> Option<usize> {
    let n = ring.len();
    let mut best: Option<(f64, usize)> = None;
    for i in 0..n {
        let j = (i + 1) % n;
        let (a, b) = (flat.at(ring[i]), flat.at(ring[j]));
        // An edge of an outline on the right runs upward.
        if a[1] <= p[1] && p[1] <= b[1] && a[1] < b[1] {
            let x = a[0] + (b[0] - a[0]) * ((p[1] - a[1]) / (b[1] - a[1]));
            if x >= p[0] && best.is_none_or(|(least, _)| x < least) {
                best = Some((x, if a[0] > b[0] { i } else { j }));
            }
        }
    }
    let (x, corner) = best?;
    let (hit, q) = ([x, p[1]], flat.at(ring[corner]));
    // Corners in the triangle of the point, the hit and the edge's end hide the end.
    let [a, b, c] = if turn(p, hit, q) >= 0.0 { [p, hit, q] } else { [p, q, hit] };
    let slope = |s: [f64; 2]| (s[1] - p[1]).abs() / (s[0] - p[0]);
    let mut found: Option<(f64, f64, usize)> = None;
    for (k, &v) in ring.iter().enumerate() {
        let s = flat.at(v);
        let within = turn(a, b, s) >= 0.0 && turn(b, c, s) >= 0.0 && turn(c, a, s) >= 0.0;
        if within && s[0] > p[0] {
            let (before, after) = (flat.at(ring[(k + n - 1) % n]), flat.at(ring[(k + 1) % n]));
            // Of places that a bridge has made twice, the one whose corner opens to the point.
            if !opens(before, s, after, p) {
                continue;
            }
            let steep = slope(s);
            if found.is_none_or(|(least, x, _)| steep < least || steep == least && s[0] < x) {
                found = Some((steep, s[0], k));
            }
        }
    }
    Some(found.map_or(corner, |(_, _, k)| k))
}

/// Whether a point lies in the angle of a corner.
fn opens(before: [f64; 2], at: [f64; 2], after: [f64; 2], p: [f64; 2]) -> bool {
    let (in_first, in_second) = (turn(before, at, p) >= 0.0, turn(at, after, p) >= 0.0);
    if turn(before, at, after) > 0.0 { in_first && in_second } else { in_first || in_second }
}

/// Cuts a ring into triangles, ear by ear; what has none becomes a fan.
fn ears(ring: &[u32], flat: &Flat, out: &mut Vec<[u32; 3]>) -> Result<()> {
    let n = ring.len();
    let mut left: Vec<usize> = reserve("corners of a cap", n)?;
    if n > 3 && n <= MOST_EARS {
        let mut ears = Ears::new(unit(ring, flat)?, Next::Farther)?;
        while let Some(t) = ears.cut() {
            push("faces of a cap", out, t.map(|i| ring[i]))?;
        }
        left.extend(ears.left());
    } else {
        left.extend(0..n);
    }
    if let [a, rest @ ..] = left.as_slice() {
        for w in rest.windows(2) {
            push("faces of a cap", out, [*a, w[0], w[1]].map(|i| ring[i]))?;
        }
    }
    Ok(())
}

/// The corners of a ring in units of its size.
fn unit(ring: &[u32], flat: &Flat) -> Result<Vec<[f64; 2]>> {
    let first = ring.first().map_or([0.0; 2], |&v| flat.at(v));
    let off = |v: &u32| {
        let p = flat.at(*v);
        [p[0] - first[0], p[1] - first[1]]
    };
    let size = ring.iter().map(off).fold(0.0f64, |m, p| m.max(p[0].abs()).max(p[1].abs()));
    let scale = if size > 1e-150 { 1.0 / size } else { 1.0 };
    collected("corners of a cap", ring.iter().map(off).map(|p| p.map(|x| x * scale)))
}
