//! Whether the surfaces of two parts cross or share a wall.

use crate::math::Vec3;

/// Corners of a face, with its box.
#[derive(Clone, Copy)]
pub struct Face {
    /// Corners.
    pub corners: [Vec3; 3],
    /// Lower corner of the box.
    pub lo: Vec3,
    /// Upper corner of the box.
    pub hi: Vec3,
}

impl Face {
    /// The face with these corners.
    pub fn new(corners: [Vec3; 3]) -> Face {
        let [a, b, c] = corners;
        Face { corners, lo: a.inf(&b).inf(&c), hi: a.sup(&b).sup(&c) }
    }
}

/// Two lengths nearer than this touch (unit frame).
pub(super) const TOUCH: f64 = 1e-9;

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

/// How two faces meet.
pub fn meet(a: &Face, b: &Face) -> Contact {
    let apart = |k: usize| a.lo[k] > b.hi[k] + TOUCH || b.lo[k] > a.hi[k] + TOUCH;
    if apart(0) || apart(1) || apart(2) {
        Contact::None
    } else if pierces(a, b) || pierces(b, a) {
        Contact::Cross
    } else {
        lies_on(a, b)
    }
}

/// How two sets of faces meet: those within both boxes are swept along the longest axis.
pub fn contact(a: &[Face], b: &[Face]) -> Contact {
    let bounds = |faces: &[Face]| {
        let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
        for f in faces {
            lo = lo.inf(&f.lo);
            hi = hi.sup(&f.hi);
        }
        (lo, hi)
    };
    let ((alo, ahi), (blo, bhi)) = (bounds(a), bounds(b));
    let (lo, hi) = (alo.sup(&blo), ahi.inf(&bhi));
    let within = |f: &&Face| (0..3).all(|k| f.lo[k] <= hi[k] + TOUCH && f.hi[k] >= lo[k] - TOUCH);
    let axis = (hi - lo).imax();
    let mut both: Vec<(&Face, bool)> = a.iter().filter(within).map(|f| (f, true)).collect();
    both.extend(b.iter().filter(within).map(|f| (f, false)));
    both.sort_by(|p, q| p.0.lo[axis].total_cmp(&q.0.lo[axis]));
    let mut found = Contact::None;
    for (i, (f, of_a)) in both.iter().enumerate() {
        let end = f.hi[axis] + TOUCH;
        for (g, _) in both[i + 1..]
            .iter()
            .take_while(|(g, _)| g.lo[axis] <= end)
            .filter(|(_, other)| other != of_a)
        {
            found = found.max(meet(f, g));
            if found == Contact::Cross {
                return found;
            }
        }
    }
    found
}

/// Whether an edge of `a` runs from one side of `b` to the other within it.
fn pierces(a: &Face, b: &Face) -> bool {
    let [p, q, r] = b.corners;
    let normal = (q - p).cross(&(r - p));
    let length = normal.norm();
    let side = a.corners.map(|v| (v - p).dot(&normal));
    (0..3).any(|k| {
        let (s, t) = (side[k], side[(k + 1) % 3]);
        let beyond = TOUCH * length;
        if !(s > beyond && t < -beyond || s < -beyond && t > beyond) {
            return false;
        }
        let (u, v) = (a.corners[k], a.corners[(k + 1) % 3]);
        let x = u + (v - u) * (s / (s - t));
        let within = |e: Vec3, f: Vec3| {
            let edge = f - e;
            edge.cross(&(x - e)).dot(&normal) > TOUCH * edge.norm() * length
        };
        within(p, q) && within(q, r) && within(r, p)
    })
}

/// How two faces in one plane meet when they overlap.
fn lies_on(a: &Face, b: &Face) -> Contact {
    let normal = |f: &Face| {
        let [p, q, r] = f.corners;
        let n = (q - p).cross(&(r - p));
        let l = n.norm();
        (l > 0.0).then(|| n / l)
    };
    let (Some(n), Some(m)) = (normal(a), normal(b)) else { return Contact::None };
    let parallel = n.dot(&m);
    if parallel.abs() < 1.0 - 1e-9
        || b.corners.iter().any(|v| (v - a.corners[0]).dot(&n).abs() > TOUCH)
    {
        return Contact::None;
    }
    // No edge of either separates them in the plane.
    let separates = |f: &Face, normal: &Vec3, g: &Face| {
        (0..3).any(|k| {
            let (u, v) = (f.corners[k], f.corners[(k + 1) % 3]);
            let inward = normal.cross(&(v - u));
            g.corners.iter().all(|w| (w - u).dot(&inward) <= TOUCH * inward.norm())
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

    fn face(c: [[f64; 3]; 3]) -> Face {
        Face::new(c.map(Vec3::from))
    }

    #[test]
    fn crossing_touching_and_walls() {
        let floor = face([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let through = face([[0.2, 0.2, -0.5], [0.2, 0.2, 0.5], [0.9, 0.9, 0.5]]);
        assert_eq!(meet(&floor, &through), Contact::Cross);
        assert_eq!(meet(&through, &floor), Contact::Cross);
        let above = face([[0.2, 0.2, 0.1], [0.2, 0.2, 0.5], [0.9, 0.9, 0.5]]);
        assert_eq!(meet(&floor, &above), Contact::None);
        // A corner on the floor, an edge in common: touching is not crossing.
        let standing = face([[0.2, 0.2, 0.0], [0.2, 0.2, 0.5], [0.9, 0.9, 0.5]]);
        assert_eq!(meet(&floor, &standing), Contact::None);
        let hinge = face([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.3, 1.0]]);
        assert_eq!(meet(&floor, &hinge), Contact::None);
        // In the same plane: a wall when seen from opposite sides and overlapping.
        let below = face([[0.1, 0.1, 0.0], [0.1, 0.9, 0.0], [0.9, 0.1, 0.0]]);
        let beside = face([[1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
        let flipped = face([[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!(meet(&floor, &below), Contact::Wall);
        let [p, q, r] = below.corners;
        assert_eq!(meet(&floor, &Face::new([p, r, q])), Contact::Cross);
        assert_eq!(meet(&floor, &beside), Contact::None);
        assert_eq!(meet(&floor, &flipped), Contact::None);
        assert_eq!(contact(&[above, floor], &[hinge, through]), Contact::Cross);
    }
}
