//! Triangles over one rim.

use crate::error::{Result, collected, reserve};
use crate::math::{Ears, Next, Vec3};

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
pub(super) fn over(rim: &[Vec3]) -> Result<Option<Lid>> {
    if rim.len() == 3 {
        return Ok(Some(Lid::Cut(vec![[0, 1, 2]])));
    }
    let edges = || rim.iter().zip(rim.iter().skip(1).chain(rim.first()));
    let (mut sum, mut length) = (Vec3::zeros(), 0.0);
    for (p, q) in edges() {
        sum += (p + q) * (0.5 * (q - p).norm());
        length += (q - p).norm();
    }
    if length <= 0.0 {
        return Ok(None);
    }
    let middle = sum / length;
    let twice = |(p, q): (&Vec3, &Vec3)| (p - middle).cross(&(q - middle));
    let size: f64 = edges().map(|e| twice(e).norm()).sum();
    if size <= CRACK * length * length {
        return Ok(Some(Lid::Fan(middle)));
    }
    let normal: Vec3 = edges().map(twice).sum();
    if normal.norm() <= CRACK * length * length {
        return Ok(None);
    }
    let normal = normal.normalize();
    if edges().all(|e| twice(e).dot(&normal) >= -1e-12 * size) {
        return Ok(Some(Lid::Fan(middle)));
    }
    if rim.len() > MOST_EARS {
        return Ok(None);
    }
    // Seen along the normal.
    let along = Vec3::ith(normal.iamin(), 1.0).cross(&normal).normalize();
    let across = normal.cross(&along);
    let place = |p: &Vec3| [along, across].map(|axis| axis.dot(&(p - middle)) / length);
    Ok(ears(collected("corners of a lid", rim.iter().map(place))?)?.map(Lid::Cut))
}

/// A polygon, run through counter-clockwise, in triangles; `None` where ears do not make it up.
fn ears(points: Vec<[f64; 2]>) -> Result<Option<Vec<[u32; 3]>>> {
    let mut out = reserve("triangles of a lid", points.len())?;
    let mut ears = Ears::new(points, Next::Farther)?;
    while let Some(t) = ears.cut() {
        out.push(t.map(|i| i as u32));
    }
    let mut left = ears.left();
    let last = [left.next(), left.next(), left.next()];
    let ([Some(a), Some(b), Some(c)], None) = (last, left.next()) else { return Ok(None) };
    out.push([a, b, c].map(|i| i as u32));
    Ok(Some(out))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crack_is_closed_and_a_rim_in_one_point_is_not() {
        let line = [0.0, 0.5, 1.0, 0.25].map(|x| Vec3::new(x, 0.1, 0.2));
        assert!(matches!(over(&line).unwrap(), Some(Lid::Fan(_))));
        assert_eq!(over(&[Vec3::x(); 5]).unwrap(), None);
        let square =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
        assert_eq!(over(&square).unwrap(), Some(Lid::Fan(Vec3::new(0.5, 0.5, 0.0))));
    }
}
