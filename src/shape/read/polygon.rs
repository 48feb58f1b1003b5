//! Polygons cut into triangles.

use crate::math::Vec3;

/// More corners than this are cut as a fan: a fan of a polygon that is not convex
/// folds over itself, but its boundary and its signed volume are right.
const MOST_EARS: usize = 2048;

/// Cuts the polygon with the given corners into triangles: ears in the polygon's
/// mean plane (Newell's normal), which for a convex polygon is a fan.
pub fn triangulate(corners: &[u32], vertices: &[[f64; 3]], out: &mut Vec<[u32; 3]>) {
    // A loop that is gone round several times is one polygon.
    let n = corners.len();
    let rounds =
        |p: &usize| n.is_multiple_of(*p) && corners.iter().eq(corners[..*p].iter().cycle().take(n));
    let n = (3..=n / 2).take(MOST_EARS).find(rounds).unwrap_or(n);
    let corners = &corners[..n];
    let fan = |left: &[u32], out: &mut Vec<[u32; 3]>| {
        if let [a, rest @ ..] = left {
            out.extend(rest.windows(2).map(|w| [*a, w[0], w[1]]));
        }
    };
    let points: Vec<Vec3> = corners
        .iter()
        .map(|&c| vertices.get(c as usize).map_or(Vec3::zeros(), |v| Vec3::from(*v)))
        .collect();
    let Some(flat) = (4..=MOST_EARS).contains(&n).then(|| project(&points)).flatten() else {
        return fan(corners, out);
    };
    let mut left: Vec<usize> = (0..n).collect();
    let mut at = 0;
    while left.len() > 3 {
        let m = left.len();
        let ear = (0..m)
            .map(|k| (at + k) % m)
            .find(|&k| is_ear(&flat, &left, left[(k + m - 1) % m], left[k], left[(k + 1) % m]));
        let Some(k) = ear else { break };
        let [a, b, c] = [left[(k + m - 1) % m], left[k], left[(k + 1) % m]];
        out.push([corners[a], corners[b], corners[c]]);
        left.remove(k);
        // Stay at the same corner: the next ear then shares it, as in a fan.
        at = if k == 0 { 0 } else { k % left.len() };
    }
    let left: Vec<u32> = left.into_iter().map(|i| corners[i]).collect();
    fan(&left, out);
}

/// The corners in the plane of the polygon, scaled to size one.
fn project(points: &[Vec3]) -> Option<Vec<[f64; 2]>> {
    let first = points.first()?;
    let size = points.iter().map(|p| (p - first).amax()).fold(0.0, f64::max);
    if !(size.is_finite() && size > f64::MIN_POSITIVE) {
        return None;
    }
    let unit: Vec<Vec3> = points.iter().map(|p| (p - first) / size).collect();
    let mut normal = Vec3::zeros();
    for (i, p) in unit.iter().enumerate() {
        normal += p.cross(&unit[(i + 1) % unit.len()]);
    }
    // Drop the axis along which the normal is largest; keep the turning sense.
    let axis = normal.iamax();
    let sign = normal[axis];
    if sign == 0.0 || !sign.is_finite() {
        return None;
    }
    let (u, v) = match (axis, sign > 0.0) {
        (0, true) => (1, 2),
        (0, false) => (2, 1),
        (1, true) => (2, 0),
        (1, false) => (0, 2),
        (_, true) => (0, 1),
        (_, false) => (1, 0),
    };
    Some(unit.iter().map(|p| [p[u], p[v]]).collect())
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether the corner b turns left and no other corner lies in the triangle.
fn is_ear(flat: &[[f64; 2]], left: &[usize], a: usize, b: usize, c: usize) -> bool {
    let [p, q, r] = [flat[a], flat[b], flat[c]];
    turn(p, q, r) > 1e-14
        && left.iter().all(|&i| {
            let s = flat[i];
            // Corners at the same place, as at the ends of a bridge to a hole, do not count.
            s == p
                || s == q
                || s == r
                || turn(p, q, s) < 0.0
                || turn(q, r, s) < 0.0
                || turn(r, p, s) < 0.0
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(v: &[[f64; 3]], faces: &[[u32; 3]]) -> (f64, f64) {
        let each = faces.iter().map(|f| {
            let [a, b, c] = f.map(|i| Vec3::from(v[i as usize]));
            (b - a).cross(&(c - a)).z / 2.0
        });
        each.fold((0.0, 0.0), |s, a| (s.0 + a, s.1 + a.abs()))
    }

    #[test]
    fn a_polygon_that_is_not_convex_is_covered_once() {
        // A comb with deep notches, whose fan from any corner folds.
        let mut v = vec![[0.0, 0.0, 3.0], [9.0, 0.0, 3.0]];
        for i in 0..5 {
            let x = 9.0 - 2.0 * f64::from(i);
            v.push([x, 4.0, 3.0]);
            v.push([x - 1.0, 0.5, 3.0]);
        }
        v.pop();
        v.push([0.0, 4.0, 3.0]);
        for reversed in [false, true] {
            let mut corners: Vec<u32> = (0..v.len() as u32).collect();
            if reversed {
                corners.reverse();
            }
            let mut out = Vec::new();
            triangulate(&corners, &v, &mut out);
            let (signed, sum) = area(&v, &out);
            assert_eq!(out.len(), v.len() - 2);
            assert!((signed.abs() - sum).abs() < 1e-12, "{signed} {sum}");
            assert_eq!(signed > 0.0, !reversed);
        }
    }

    #[test]
    fn a_loop_gone_round_twice_is_one_polygon() {
        let v = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let mut out = Vec::new();
        triangulate(&[0, 1, 2, 3, 0, 1, 2, 3], &v, &mut out);
        assert_eq!((out.len(), area(&v, &out)), (2, (1.0, 1.0)));
    }

    #[test]
    fn a_convex_one_is_a_fan() {
        let v =
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
        let mut out = Vec::new();
        triangulate(&[0, 1, 2, 3, 4], &v, &mut out);
        assert_eq!(area(&v, &out).0, 3.0);
        assert_eq!(out.len(), 3);
    }
}
