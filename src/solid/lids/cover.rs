//! Triangles over one rim.

use crate::math::Vec3;

/// Rims of more vertices than this, and no middle that sees them all, stay open: ears are found in
/// the square of their number.
const MOST_EARS: usize = 2000;
/// Twice the area over the square of the length below which a rim encloses nothing: a crack.
const CRACK: f64 = 1e-9;

/// What covers a rim.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Lid {
    /// A triangle from each edge to this point.
    Fan(Vec3),
    /// These vertices of the rim, by their places on it, in its direction.
    Cut(Vec<[u32; 3]>),
}

/// The lid over a rim: from its middle where that sees all of it, seen along its mean normal;
/// otherwise by cutting off ears. `None` where neither goes.
pub(super) fn over(rim: &[Vec3]) -> Option<Lid> {
    if rim.len() == 3 {
        return Some(Lid::Cut(vec![[0, 1, 2]]));
    }
    let edges = || rim.iter().zip(rim.iter().skip(1).chain(rim.first()));
    let (mut sum, mut length) = (Vec3::zeros(), 0.0);
    for (p, q) in edges() {
        sum += (p + q) * (0.5 * (q - p).norm());
        length += (q - p).norm();
    }
    if length <= 0.0 {
        return None;
    }
    let middle = sum / length;
    let twice = |(p, q): (&Vec3, &Vec3)| (p - middle).cross(&(q - middle));
    let size: f64 = edges().map(|e| twice(e).norm()).sum();
    if size <= CRACK * length * length {
        return Some(Lid::Fan(middle));
    }
    let normal: Vec3 = edges().map(twice).sum();
    if normal.norm() <= CRACK * length * length {
        return None;
    }
    let normal = normal.normalize();
    if edges().all(|e| twice(e).dot(&normal) >= -1e-12 * size) {
        return Some(Lid::Fan(middle));
    }
    if rim.len() > MOST_EARS {
        return None;
    }
    // Seen along the normal.
    let along = Vec3::ith(normal.iamin(), 1.0).cross(&normal).normalize();
    let across = normal.cross(&along);
    let flat = rim.iter().map(|p| [along.dot(&(p - middle)), across.dot(&(p - middle))]);
    ears(&flat.collect::<Vec<_>>()).map(Lid::Cut)
}

/// A polygon, run through counter-clockwise, in triangles (Meisters 1975).
fn ears(points: &[[f64; 2]]) -> Option<Vec<[u32; 3]>> {
    let cross = |a: usize, b: usize, c: usize| {
        let ([ax, ay], [bx, by], [cx, cy]) = (points[a], points[b], points[c]);
        (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    };
    let mut left: Vec<usize> = (0..points.len()).collect();
    let mut out = Vec::with_capacity(points.len());
    let (mut at, mut misses) = (0, 0);
    while left.len() > 3 {
        let n = left.len();
        if misses >= n {
            return None;
        }
        let [a, b, c] = [left[(at + n - 1) % n], left[at % n], left[(at + 1) % n]];
        let holds = |&p: &usize| {
            ![a, b, c].contains(&p)
                && cross(a, b, p) >= 0.0
                && cross(b, c, p) >= 0.0
                && cross(c, a, p) >= 0.0
        };
        if cross(a, b, c) > 0.0 && !left.iter().any(holds) {
            out.push([a as u32, b as u32, c as u32]);
            left.remove(at % n);
            misses = 0;
            // The next one shares a corner with this one; the one after that spreads them.
            at = (at % n) + 1;
        } else {
            at += 1;
            misses += 1;
        }
        at %= left.len();
    }
    let [a, b, c] = left[..] else { return None };
    out.push([a as u32, b as u32, c as u32]);
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[[f64; 2]], t: &[u32; 3]) -> f64 {
        let [[ax, ay], [bx, by], [cx, cy]] = t.map(|i| points[i as usize]);
        0.5 * ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
    }

    #[test]
    fn ears_cover_what_the_polygon_encloses() {
        let spiral: Vec<[f64; 2]> = (0..40)
            .map(|i| (f64::from(i), 1.0))
            .chain((0..40).rev().map(|i| (f64::from(i), 0.6)))
            .map(|(i, r)| {
                [r * 1.1f64.powf(i) * (0.3 * i).cos(), r * 1.1f64.powf(i) * (0.3 * i).sin()]
            })
            .rev()
            .collect();
        let l =
            [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        for points in [spiral, l.to_vec()] {
            let n = points.len();
            let whole: f64 = (1..n - 1).map(|i| area(&points, &[0, i as u32, i as u32 + 1])).sum();
            let sign = whole.signum();
            let points: Vec<_> =
                if sign > 0.0 { points } else { points.into_iter().rev().collect() };
            let found = ears(&points).unwrap();
            assert_eq!(found.len(), n - 2);
            assert!(found.iter().all(|t| area(&points, t) > 0.0));
            let sum: f64 = found.iter().map(|t| area(&points, t)).sum();
            assert!((sum - whole.abs()).abs() < 1e-12 * sum);
        }
        // Run through the other way round it has none.
        assert_eq!(ears(&[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]), None);
    }

    #[test]
    fn a_crack_is_closed_and_a_rim_in_one_point_is_not() {
        let line = [0.0, 0.5, 1.0, 0.25].map(|x| Vec3::new(x, 0.1, 0.2));
        assert!(matches!(over(&line), Some(Lid::Fan(_))));
        assert_eq!(over(&[Vec3::x(); 5]), None);
        let square =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
        assert_eq!(over(&square), Some(Lid::Fan(Vec3::new(0.5, 0.5, 0.0))));
    }
}
