//! Whether the surfaces of two parts cross or share a wall.

use super::field::Field;
use super::tree::Bounds;
use crate::math::Vec3;

/// How two surfaces meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Contact {
    /// Not at all, or in points or along lines only.
    None,
    /// They lie on each other with opposed normals: a wall between two parts.
    Wall,
    /// An edge of one runs through a face of the other, or they lie on each other with the
    /// same normals: their insides overlap.
    Cross,
}

/// How two faces meet; lengths below `touch` touch.
pub fn meet(a: &[Vec3; 3], b: &[Vec3; 3], touch: f64) -> Contact {
    if !Bounds::of(a).meets(&Bounds::of(b), touch) {
        Contact::None
    } else if pierces(a, b, touch) || pierces(b, a, touch) {
        Contact::Cross
    } else {
        lies_on(a, b, touch)
    }
}

/// How some faces, within `bounds`, and those of a field meet. `looks` counts the faces
/// that were looked at.
pub fn contact<'a>(
    some: impl IntoIterator<Item = &'a u32>,
    of: &Field,
    with: &Field,
    bounds: &Bounds,
    touch: f64,
    looks: &mut u64,
) -> Contact {
    let mut found = Contact::None;
    for &f in some {
        *looks += 1;
        let face = of.corners(f);
        let own = Bounds::of(&face);
        if own.meets(bounds, touch) {
            with.within(&own, |g| {
                *looks += 1;
                found = found.max(meet(&face, &with.corners(g), touch));
                found == Contact::Cross
            });
        }
        if found == Contact::Cross {
            break;
        }
    }
    found
}

/// Whether an edge of `a` runs from one side of `b` to the other within it.
fn pierces(a: &[Vec3; 3], b: &[Vec3; 3], touch: f64) -> bool {
    let [p, q, r] = *b;
    let normal = (q - p).cross(&(r - p));
    let length = normal.norm();
    let side = a.map(|v| (v - p).dot(&normal));
    (0..3).any(|k| {
        let (s, t) = (side[k], side[(k + 1) % 3]);
        let beyond = touch * length;
        if !(s > beyond && t < -beyond || s < -beyond && t > beyond) {
            return false;
        }
        let (u, v) = (a[k], a[(k + 1) % 3]);
        let x = u + (v - u) * (s / (s - t));
        let within = |e: Vec3, f: Vec3| {
            let edge = f - e;
            edge.cross(&(x - e)).dot(&normal) > touch * edge.norm() * length
        };
        within(p, q) && within(q, r) && within(r, p)
    })
}

/// How two faces in one plane meet when they overlap.
fn lies_on(a: &[Vec3; 3], b: &[Vec3; 3], touch: f64) -> Contact {
    // The normal, and how much it may turn when the corners move by `touch`.
    let normal = |[p, q, r]: &[Vec3; 3]| {
        let n = (q - p).cross(&(r - p));
        let l = n.norm();
        let longest = (q - p).norm().max((r - q).norm()).max((p - r).norm());
        (l > 0.0).then(|| (n / l, touch * longest / l))
    };
    let (Some((n, s)), Some((m, t))) = (normal(a), normal(b)) else { return Contact::None };
    let parallel = n.dot(&m);
    let turned = (s + t).min(0.1);
    if parallel.abs() < 1.0 - f64::max(1e-9, turned * turned)
        || b.iter().any(|v| (v - a[0]).dot(&n).abs() > touch)
    {
        return Contact::None;
    }
    // No edge of either separates them in the plane.
    let separates = |f: &[Vec3; 3], normal: &Vec3, g: &[Vec3; 3]| {
        (0..3).any(|k| {
            let (u, v) = (f[k], f[(k + 1) % 3]);
            let inward = normal.cross(&(v - u));
            g.iter().all(|w| (w - u).dot(&inward) <= touch * inward.norm())
        })
    };
    match (separates(a, &n, b) || separates(b, &m, a), parallel > 0.0) {
        (true, _) => Contact::None,
        (_, true) => Contact::Cross,
        (_, false) => Contact::Wall,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face(c: [[f64; 3]; 3]) -> [Vec3; 3] {
        c.map(Vec3::from)
    }

    #[test]
    fn crossing_touching_and_walls() {
        let at = |a: &[Vec3; 3], b: &[Vec3; 3]| meet(a, b, 1e-9);
        let floor = face([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let through = face([[0.2, 0.2, -0.5], [0.2, 0.2, 0.5], [0.9, 0.9, 0.5]]);
        assert_eq!(at(&floor, &through), Contact::Cross);
        assert_eq!(at(&through, &floor), Contact::Cross);
        let above = face([[0.2, 0.2, 0.1], [0.2, 0.2, 0.5], [0.9, 0.9, 0.5]]);
        assert_eq!(at(&floor, &above), Contact::None);
        // A corner on the floor, an edge in common: touching is not crossing.
        let standing = face([[0.2, 0.2, 0.0], [0.2, 0.2, 0.5], [0.9, 0.9, 0.5]]);
        assert_eq!(at(&floor, &standing), Contact::None);
        let hinge = face([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.3, 1.0]]);
        assert_eq!(at(&floor, &hinge), Contact::None);
        // In the same plane: a wall when seen from opposite sides and overlapping.
        let below = face([[0.1, 0.1, 0.0], [0.1, 0.9, 0.0], [0.9, 0.1, 0.0]]);
        let beside = face([[1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
        let flipped = face([[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!(at(&floor, &below), Contact::Wall);
        let [p, q, r] = below;
        assert_eq!(at(&floor, &[p, r, q]), Contact::Cross);
        assert_eq!(at(&floor, &beside), Contact::None);
        assert_eq!(at(&floor, &flipped), Contact::None);
        // Farther than `touch` apart, and within it.
        let lower = below.map(|v| v - Vec3::new(0.0, 0.0, 1e-8));
        assert_eq!(at(&floor, &lower), Contact::None);
        assert_eq!(meet(&floor, &lower, 1e-7), Contact::Wall);
    }
}
