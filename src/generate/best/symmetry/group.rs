//! Finite groups of mirrors and turns about a point.

use crate::math::Vec3;
use nalgebra::Matrix3;

pub(super) type Matrix = Matrix3<f64>;

/// Most elements: those of the cube.
pub(super) const MOST: usize = 48;
/// Matrices that differ by less than this in every entry are the same element: of planes that
/// are given to three digits, and of planes that are found. What they make is made exact.
pub(super) const GIVEN: f64 = 1e-2;
pub(super) const FOUND: f64 = 4e-2;
/// The same of exact elements.
pub(super) const SAME: f64 = 1e-6;
/// Rounds of [`Group::tighten`]: each squares the error.
const ROUNDS: usize = 4;
/// Entries closer than this to 0 or ±1 are meant to be that.
pub(super) const EXACT: f64 = 1e-9;

/// Orthogonal matrices that are a group; the identity is the first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Group {
    elements: Vec<Matrix>,
    /// `products[i][j]`: the number of element i after element j.
    products: Vec<Vec<u8>>,
}

/// A set of elements of a group, one bit each.
pub(super) type Set = u64;

/// The mirror image in a plane with this normal, of any length but 0.
pub(super) fn mirror(normal: &Vec3) -> Matrix {
    // By way of the greatest component: no square of the length under- or overflows.
    let n = (normal / normal.amax()).normalize();
    Matrix::identity() - n * n.transpose() * 2.0
}

/// The 48 matrices that exchange the axes and turn them round, the identity first.
pub(super) fn exchanges() -> Vec<Matrix> {
    let mut all = Vec::with_capacity(MOST);
    for order in [[0, 1, 2], [1, 0, 2], [0, 2, 1], [2, 1, 0], [1, 2, 0], [2, 0, 1]] {
        for signs in 0..8u32 {
            let mut m = Matrix::zeros();
            for (row, &column) in order.iter().enumerate() {
                m[(row, column)] = if signs >> row & 1 == 1 { -1.0 } else { 1.0 };
            }
            all.push(m);
        }
    }
    all
}

/// The element of `all` that `m` is.
pub(super) fn find(all: &[Matrix], m: &Matrix, same: f64) -> Option<usize> {
    all.iter().position(|e| (e - m).amax() < same)
}

impl Group {
    /// The identity alone.
    pub(super) fn trivial() -> Group {
        Group { elements: vec![Matrix::identity()], products: vec![vec![0]] }
    }

    /// What these elements make; none when that is more than [`MOST`]. Matrices that differ by less
    /// than `same` are one.
    pub(super) fn generated(by: &[Matrix], same: f64) -> Option<Group> {
        let mut elements = vec![Matrix::identity()];
        let mut done = 0;
        while done < elements.len() {
            for g in by {
                let next = g * elements[done];
                if find(&elements, &next, same).is_none() {
                    if elements.len() == MOST {
                        return None;
                    }
                    elements.push(next);
                }
            }
            done += 1;
        }
        let mut products = Vec::with_capacity(elements.len());
        for x in &elements {
            let row: Option<Vec<u8>> =
                elements.iter().map(|y| find(&elements, &(x * y), same).map(|k| k as u8)).collect();
            products.push(row?);
        }
        let mut group = Group { elements, products };
        group.tighten();
        Some(group)
    }

    /// Makes what is nearly a group one to rounding: each element becomes the mean of all ways
    /// to it, `(xy) y⁻¹`, made orthogonal (Grove, Karcher and Ruh 1974). What is meant to be 0 or
    /// ±1 is that exactly.
    fn tighten(&mut self) {
        for _ in 0..ROUNDS {
            let ways = |(x, row): (usize, &Vec<u8>)| {
                let sum: Matrix = row
                    .iter()
                    .zip(&self.elements)
                    .map(|(&xy, y)| self.elements[xy as usize] * y.transpose())
                    .sum();
                orthogonal(sum / row.len() as f64).unwrap_or(self.elements[x])
            };
            self.elements = self.products.iter().enumerate().map(ways).collect();
        }
        for x in self.elements.iter_mut().flat_map(|m| m.iter_mut()) {
            if (*x - x.round()).abs() < EXACT {
                *x = x.round();
            }
        }
    }

    /// Number of elements.
    pub(super) fn len(&self) -> usize {
        self.elements.len()
    }

    pub(super) fn elements(&self) -> &[Matrix] {
        &self.elements
    }

    /// Number of mirror planes.
    #[cfg(test)]
    pub(super) fn planes(&self) -> usize {
        self.elements.iter().filter(|m| is_mirror(m)).count()
    }

    /// The least subgroup with these elements.
    pub(super) fn closure(&self, set: Set) -> Set {
        let mut all = set | 1;
        loop {
            let mut more = all;
            for x in bits(all) {
                bits(all).for_each(|y| more |= 1 << self.products[x][y]);
            }
            if more == all {
                return all;
            }
            all = more;
        }
    }

    /// The group about other axes, the columns of `axes`.
    pub(super) fn turned(&self, axes: &Matrix) -> Group {
        let turn = |m: &Matrix| axes * m * axes.transpose();
        let elements = self.elements.iter().map(turn).collect();
        let mut group = Group { elements, products: self.products.clone() };
        group.tighten();
        group
    }

    /// The subgroup `set`, as a group.
    pub(super) fn part(&self, set: Set) -> Group {
        let old: Vec<usize> = bits(set).collect();
        let new = |x: u8| old.iter().position(|&o| o == usize::from(x)).unwrap_or(0) as u8;
        Group {
            elements: old.iter().map(|&i| self.elements[i]).collect(),
            products: old
                .iter()
                .map(|&i| old.iter().map(|&j| new(self.products[i][j])).collect())
                .collect(),
        }
    }

    /// Subgroups that mirrors make, one of each set of those that the group carries into each
    /// other; the group's own first, if mirrors make it, then by falling number of elements.
    pub(super) fn mirror_parts(&self) -> Vec<Set> {
        let mirrors: Vec<usize> =
            (0..self.len()).filter(|&i| is_mirror(&self.elements[i])).collect();
        let mut parts: Vec<Set> = Vec::new();
        // No reflection group in space needs more than three mirrors.
        for (a, &x) in mirrors.iter().enumerate() {
            for (b, &y) in mirrors[..=a].iter().enumerate() {
                for &z in &mirrors[..=b] {
                    let part = self.closure(1 << x | 1 << y | 1 << z);
                    if !parts.iter().any(|&p| self.carried(p).any(|q| q == part)) {
                        parts.push(part);
                    }
                }
            }
        }
        parts.sort_by_key(|p| std::cmp::Reverse(p.count_ones()));
        parts
    }

    /// The images of a subgroup under all elements.
    pub(super) fn carried(&self, part: Set) -> impl Iterator<Item = Set> {
        (0..self.len()).map(move |g| {
            let back = self.products[g].iter().position(|&p| p == 0).unwrap_or(0);
            bits(part)
                .fold(0, |all, x| all | 1 << self.products[usize::from(self.products[g][x])][back])
        })
    }
}

pub(super) fn bits(set: Set) -> impl Iterator<Item = usize> {
    (0..64).filter(move |i| set >> i & 1 == 1)
}

/// Whether a matrix is the image in a plane: −1 once, +1 twice.
fn is_mirror(m: &Matrix) -> bool {
    m.determinant() < 0.0 && (m.trace() - 1.0).abs() < SAME
}

/// The orthogonal matrix closest to one that nearly is (Higham 1986).
fn orthogonal(mut m: Matrix) -> Option<Matrix> {
    for _ in 0..6 {
        m = (m + m.try_inverse()?.transpose()) * 0.5;
    }
    Some(m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    fn is_group(g: &Group) {
        assert_eq!(g.elements[0], Matrix::identity());
        for (i, x) in g.elements.iter().enumerate() {
            assert!((x * x.transpose() - Matrix::identity()).amax() < 1e-14);
            for (j, y) in g.elements.iter().enumerate() {
                let k = usize::from(g.products[i][j]);
                assert!((x * y - g.elements[k]).amax() < 1e-14, "{i} {j}");
            }
        }
    }

    fn of(normals: &[[f64; 3]]) -> Option<Group> {
        let mirrors: Vec<Matrix> = normals.iter().map(|n| mirror(&Vec3::from(*n))).collect();
        Group::generated(&mirrors, GIVEN)
    }

    #[test]
    fn mirrors_make_groups_of_the_right_size() {
        let h = 0.75f64.sqrt();
        for (normals, order, planes) in [
            (vec![], 1, 0),
            (vec![[0.0, 0.0, 3e200]], 2, 1),
            (vec![[1.0, 0.0, 0.0], [0.0, 1e-300, 0.0]], 4, 2),
            (vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 8, 3),
            (vec![[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], 8, 4),
            (vec![[1.0, 0.0, 0.0], [0.5, h, 0.0], [0.0, 0.0, 1.0]], 12, 4),
            (vec![[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 16, 5),
            (vec![[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 1.0]], 24, 6),
            (vec![[1.0, 0.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, -1.0]], 48, 9),
        ] {
            let g = of(&normals).unwrap();
            assert_eq!((g.len(), g.planes()), (order, planes), "{normals:?}");
            is_group(&g);
            // Nothing remains of the way in which it was given, to rounding.
            let turn = Rotation3::from_euler_angles(0.3, 0.4, 0.5);
            let turned: Vec<_> = normals
                .iter()
                .map(|n| mirror(&(turn * (Vec3::from(*n) / Vec3::from(*n).amax()))))
                .collect();
            let t = Group::generated(&turned, GIVEN).unwrap();
            assert_eq!((t.len(), t.planes()), (order, planes));
            is_group(&t);
        }
        // The icosahedron's 120 are too many, and so is a turn that does not come round.
        let golden = 0.5 * (1.0 + 5f64.sqrt());
        assert!(of(&[[1.0, 0.0, 0.0], [golden, 1.0, golden - 1.0], [0.0, 0.0, 1.0]]).is_none());
        assert!(of(&[[1.0, 0.0, 0.0], [1.0, 0.3, 0.0]]).is_none());
    }

    #[test]
    fn normals_of_three_digits_are_made_exact() {
        let g = of(&[[1.0, 0.0, 0.0], [0.5, 0.866, 0.0]]).unwrap();
        assert_eq!(g.len(), 6);
        is_group(&g);
        let g = of(&[[1.0, 0.0, 0.0], [0.7075, 0.7068, 0.0]]).unwrap();
        assert_eq!(g.len(), 8);
        is_group(&g);
    }

    #[test]
    fn exchanges_are_a_group() {
        let all = exchanges();
        let g = Group::generated(&all, GIVEN).unwrap();
        assert_eq!((g.len(), g.planes()), (48, 9));
        assert!(g.elements.iter().flat_map(|m| m.iter()).all(|x| [-1.0, 0.0, 1.0].contains(x)));
        // Oh, Td, D4h, D3d has no mirrors of its own; C3v, C4v, D2h twice, C2v twice, Cs twice.
        let orders: Vec<u32> = g.mirror_parts().iter().map(|p| p.count_ones()).collect();
        assert_eq!(orders[..3], [48, 24, 16]);
        assert_eq!(orders.last(), Some(&2));
        for p in g.mirror_parts() {
            assert_eq!(g.closure(p), p);
            is_group(&g.part(p));
        }
    }

    #[test]
    fn kinds_are_planes_lines_and_points() {
        let count = |g: &Group| {
            let mut sizes: Vec<(usize, usize)> = Vec::new();
            for k in g.kinds() {
                assert!((k.projector * k.projector - k.projector).amax() < 1e-14);
                assert_eq!(k.len() * k.fixing.count_ones() as usize, g.len());
                assert_eq!(k.images[0], Matrix::identity());
                // A general place of the kind has as many images as it says, and no other.
                let p = k.projector * Vec3::new(0.3, 0.5, 0.9);
                for (i, a) in k.images.iter().enumerate() {
                    for b in &k.images[..i] {
                        assert!((a * p - b * p).norm() > 0.01);
                    }
                }
                for e in &g.elements {
                    assert!(k.images.iter().any(|m| (m * p - e * p).norm() < 1e-12));
                }
                match sizes.iter_mut().find(|s| s.0 == k.len()) {
                    Some(s) => s.1 += 1,
                    None => sizes.push((k.len(), 1)),
                }
            }
            sizes
        };
        assert_eq!(count(&Group::trivial()), [(1, 1)]);
        assert_eq!(count(&of(&[[1.0, 2.0, 0.0]]).unwrap()), [(2, 1), (1, 1)]);
        let all = Group::generated(&exchanges(), GIVEN).unwrap();
        let mut classes: Vec<usize> = all.kinds().iter().map(|k| k.class).collect();
        classes.sort();
        classes.dedup();
        assert_eq!(classes.len(), 7);
        assert_eq!(count(&all), [(48, 1), (24, 9), (12, 6), (8, 4), (6, 3), (1, 1)]);
        let cell = of(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap();
        assert_eq!(count(&cell), [(8, 1), (4, 3), (2, 3), (1, 1)]);
        assert!(cell.kinds().last().unwrap().is_point());
        let cone = of(&[[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]).unwrap();
        assert_eq!(count(&cone), [(8, 1), (4, 4), (1, 1)]);
        assert!(!cone.kinds().last().unwrap().is_point());
    }
}
