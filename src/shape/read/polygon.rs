//! Polygons cut into triangles.

use crate::error::{Result, push, reserve};
use crate::math::{Ears, Next, Vec3};

/// More corners than this are cut as a fan: a fan of a polygon that is not convex
/// folds over itself, but its boundary and its signed volume are right.
const MOST_EARS: usize = 2048;

/// Cuts the polygon with the given corners into triangles: ears in the polygon's
/// mean plane (Newell's normal), which for a convex polygon is a fan.
pub fn triangulate(corners: &[u32], vertices: &[[f64; 3]], out: &mut Vec<[u32; 3]>) -> Result<()> {
    // A loop that is gone round several times is one polygon.
    let n = corners.len();
    let rounds =
        |p: &usize| n.is_multiple_of(*p) && corners.iter().eq(corners[..*p].iter().cycle().take(n));
    let n = (3..=n / 2).take(MOST_EARS).find(rounds).unwrap_or(n);
    let corners = &corners[..n];
    let mut polygon = None;
    if (4..=MOST_EARS).contains(&n) {
        let place = |&c: &u32| vertices.get(c as usize).map_or(Vec3::zeros(), |v| Vec3::from(*v));
        let mut points = reserve("corners of a polygon", n)?;
        points.extend(corners.iter().map(place));
        polygon = project(&points)?.map(|flat| Ears::new(flat, Next::Here)).transpose()?;
    }
    let mut left: Vec<usize> = reserve("corners of a polygon", n)?;
    match polygon {
        Some(mut ears) => {
            while let Some([a, b, c]) = ears.cut() {
                push("faces", out, [corners[a], corners[b], corners[c]])?;
            }
            left.extend(ears.left());
        }
        None => left.extend(0..n),
    }
    if let [a, rest @ ..] = left.as_slice() {
        for w in rest.windows(2) {
            push("faces", out, [*a, w[0], w[1]].map(|i| corners[i]))?;
        }
    }
    Ok(())
}

/// The corners in the plane of the polygon, scaled to size one.
fn project(points: &[Vec3]) -> Result<Option<Vec<[f64; 2]>>> {
    let Some(first) = points.first() else { return Ok(None) };
    let size = points.iter().map(|p| (p - first).amax()).fold(0.0, f64::max);
    if !(size.is_finite() && size > f64::MIN_POSITIVE) {
        return Ok(None);
    }
    let unit = |p: &Vec3| (p - first) / size;
    let mut normal = Vec3::zeros();
    for (p, q) in points.iter().zip(points.iter().cycle().skip(1)) {
        normal += unit(p).cross(&unit(q));
    }
    // Drop the axis along which the normal is largest; keep the turning sense.
    let axis = normal.iamax();
    let sign = normal[axis];
    if sign == 0.0 || !sign.is_finite() {
        return Ok(None);
    }
    let (u, v) = match (axis, sign > 0.0) {
        (0, true) => (1, 2),
        (0, false) => (2, 1),
        (1, true) => (2, 0),
        (1, false) => (0, 2),
        (_, true) => (0, 1),
        (_, false) => (1, 0),
    };
    let mut flat = reserve("corners of a polygon", points.len())?;
    flat.extend(points.iter().map(unit).map(|p| [p[u], p[v]]));
    Ok(Some(flat))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

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
            triangulate(&corners, &v, &mut out).unwrap();
            let (signed, sum) = area(&v, &out);
            assert_eq!(out.len(), v.len() - 2);
            assert!((signed.abs() - sum).abs() < 1e-12, "{signed} {sum}");
            assert_eq!(signed > 0.0, !reversed);
        }
    }

    /// A comb with `teeth` teeth, and its area.
    fn comb(teeth: u32) -> (Vec<[f64; 3]>, f64) {
        let width = 2.0 * f64::from(teeth);
        let mut v = vec![[0.0, -1.0, 0.0], [width, -1.0, 0.0]];
        for i in (0..teeth).rev() {
            let x = 2.0 * f64::from(i);
            v.extend([[x + 2.0, 0.0, 0.0], [x + 1.0, 90.0, 0.0]]);
        }
        v.push([0.0, 0.0, 0.0]);
        (v, width + 90.0 * f64::from(teeth))
    }

    #[test]
    fn large_polygons_that_are_not_convex_are_cut_in_time() {
        // With the cube of the corners this would take hours.
        let (v, expected) = comb(1020);
        let corners: Vec<u32> = (0..v.len() as u32).collect();
        for turn in 0..60 {
            let mut corners = corners.clone();
            corners.rotate_left(turn * 31);
            let mut out = Vec::new();
            triangulate(&corners, &v, &mut out).unwrap();
            let (signed, sum) = area(&v, &out);
            assert_eq!(out.len(), v.len() - 2);
            assert!((signed - expected).abs() < 1e-6 && (sum - expected).abs() < 1e-6);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 60, ..Default::default() })]
        #[test]
        fn star_shaped_ones_are_covered_once(
            radii in prop::collection::vec(0.2f64..1.0, 3..60),
            from in 0usize..60,
        ) {
            let n = radii.len();
            let v: Vec<[f64; 3]> = radii
                .iter()
                .enumerate()
                .map(|(i, r)| {
                    let t = i as f64 / n as f64 * std::f64::consts::TAU;
                    [r * t.cos(), r * t.sin(), 0.3 * t.cos()]
                })
                .collect();
            let mut corners: Vec<u32> = (0..n as u32).collect();
            corners.rotate_left(from % n);
            let mut out = Vec::new();
            triangulate(&corners, &v, &mut out).unwrap();
            let (signed, sum) = area(&v, &out);
            let expected: f64 = (0..n)
                .map(|i| {
                    let (p, q) = (v[i], v[(i + 1) % n]);
                    (p[0] * q[1] - p[1] * q[0]) / 2.0
                })
                .sum();
            prop_assert_eq!(out.len(), n - 2);
            prop_assert!((signed - expected).abs() < 1e-9 && (sum - expected).abs() < 1e-9);
        }
    }

    #[test]
    fn a_loop_gone_round_twice_is_one_polygon() {
        let v = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let mut out = Vec::new();
        triangulate(&[0, 1, 2, 3, 0, 1, 2, 3], &v, &mut out).unwrap();
        assert_eq!((out.len(), area(&v, &out)), (2, (1.0, 1.0)));
    }

    #[test]
    fn a_convex_one_is_a_fan() {
        let v =
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
        let mut out = Vec::new();
        triangulate(&[0, 1, 2, 3, 4], &v, &mut out).unwrap();
        assert_eq!(area(&v, &out).0, 3.0);
        assert_eq!(out.len(), 3);
    }
}
