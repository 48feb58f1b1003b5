//! The mirror planes of the target's cells, so that spheres are added in whole orbits.

use super::lattice::{Lattice, distance_squared};

/// For each axis, twice the position of the mirror plane (in cells) when the cells of the
/// target are their own mirror image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mirrors {
    doubled: [Option<f64>; 3],
    step: [f64; 3],
}

impl Mirrors {
    /// Compares the cells with their mirror images about the middle of their box, exactly.
    pub fn find(lattice: &Lattice, bits: &[u64]) -> Mirrors {
        let mut mirrors = Mirrors { doubled: [None; 3], step: lattice.step };
        let Some((lo, hi)) = bounds(lattice, bits) else { return mirrors };
        for a in 0..3 {
            let same = |p: [usize; 3]| {
                let mut q = p;
                q[a] = lo[a] + hi[a] - p[a];
                lattice.get(bits, p[0], p[1], p[2]) == lattice.get(bits, q[0], q[1], q[2])
            };
            let mut top = hi;
            top[a] = (lo[a] + hi[a]) / 2;
            let symmetric = (lo[2]..=top[2])
                .all(|k| (lo[1]..=top[1]).all(|j| (lo[0]..=top[0]).all(|i| same([i, j, k]))));
            if symmetric {
                mirrors.doubled[a] = Some((lo[a] + hi[a]) as f64);
            }
        }
        mirrors
    }

    /// Whether the cell is the one of its orbit that stands for all: on the low side of
    /// every plane, or on it.
    pub fn stands(&self, cell: &[u32; 3]) -> bool {
        (0..3).all(|a| self.doubled[a].is_none_or(|d| 2.0 * f64::from(cell[a]) <= d))
    }

    /// How many cells along each axis there are up to the planes, on them included.
    pub fn part_dims(&self, dims: [usize; 3]) -> [usize; 3] {
        std::array::from_fn(|a| match self.doubled[a] {
            Some(d) => ((0.5 * d) as usize + 1).min(dims[a]),
            None => dims[a],
        })
    }

    /// Moves the point onto the planes that are nearer than half a cell.
    pub fn snap(&self, p: &mut [f64; 3]) {
        for (a, x) in p.iter_mut().enumerate() {
            if let Some(d) = self.doubled[a] {
                let plane = 0.5 * d * self.step[a];
                if (*x - plane).abs() < 0.5 * self.step[a] {
                    *x = plane;
                }
            }
        }
    }

    /// The images of the point, itself first; none twice. Prefixes are fair: each next image is
    /// the one farthest from those before.
    pub fn orbit(&self, p: &[f64; 3]) -> Vec<[f64; 3]> {
        let mut images = vec![*p];
        for a in 0..3 {
            if let Some(d) = self.doubled[a] {
                let plane = 0.5 * d * self.step[a];
                if p[a] != plane {
                    for n in 0..images.len() {
                        let mut q = images[n];
                        q[a] = 2.0 * plane - q[a];
                        images.push(q);
                    }
                }
            }
        }
        for done in 1..images.len() {
            let apart = |q: &[f64; 3]| {
                images[..done].iter().map(|o| distance_squared(o, q)).fold(f64::INFINITY, f64::min)
            };
            let next = (done..images.len())
                .reduce(|a, b| if apart(&images[b]) > apart(&images[a]) { b } else { a });
            if let Some(next) = next {
                images.swap(done, next);
            }
        }
        images
    }

    /// The last cell along each axis that belongs to the part of space that `p` stands for. Of
    /// a ball about `p` and its images, `p`'s own holds all cells of that part that any holds.
    pub fn part(&self, p: &[f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| match self.doubled[a] {
            Some(d) if p[a] != 0.5 * d * self.step[a] => 0.5 * d,
            _ => f64::INFINITY,
        })
    }

    /// Squared distance from the centre of symmetry, along the axes that have a plane.
    pub fn off_centre(&self, p: &[f64; 3]) -> f64 {
        (0..3)
            .filter_map(|a| self.doubled[a].map(|d| p[a] - 0.5 * d * self.step[a]))
            .map(|d| d * d)
            .sum()
    }
}

/// First and last set cell along each axis.
fn bounds(lattice: &Lattice, bits: &[u64]) -> Option<([usize; 3], [usize; 3])> {
    let mut lo = [usize::MAX; 3];
    let mut hi = [0; 3];
    for (n, row) in bits.chunks_exact(lattice.words.max(1)).enumerate() {
        let first = row.iter().position(|w| *w != 0);
        let last = row.iter().rposition(|w| *w != 0);
        if let (Some(f), Some(l)) = (first, last) {
            let ends = [
                f * 64 + row[f].trailing_zeros() as usize,
                l * 64 + 63 - row[l].leading_zeros() as usize,
            ];
            let (j, k) = (n % lattice.dims[1], n / lattice.dims[1]);
            for (a, (x, y)) in [(ends[0], ends[1]), (j, j), (k, k)].into_iter().enumerate() {
                lo[a] = lo[a].min(x);
                hi[a] = hi[a].max(y);
            }
        }
    }
    (lo[0] <= hi[0]).then_some((lo, hi))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_planes_and_orbits() {
        let l = Lattice::new([12, 10, 9], [1.0, 1.0, 2.0]);
        let mut mask = vec![0u8; 12 * 10 * 9];
        let mut set = |i: usize, j: usize, k: usize| mask[i + 12 * (j + 10 * k)] = 1;
        for i in 2..8 {
            for j in 3..6 {
                for k in 2..7 {
                    set(i, j, k);
                }
            }
        }
        set(3, 4, 7); // no mirror image in x or z
        let bits = l.pack(&mask).unwrap();
        let m = Mirrors::find(&l, &bits);
        assert_eq!(m.doubled, [None, Some(8.0), None]);
        mask[3 + 12 * (4 + 10 * 7)] = 0;
        let m = Mirrors::find(&l, &l.pack(&mask).unwrap());
        assert_eq!(m.doubled, [Some(9.0), Some(8.0), Some(8.0)]);
        assert_eq!(m.orbit(&[4.5, 4.0, 8.0]), vec![[4.5, 4.0, 8.0]]);
        let orbit = m.orbit(&[3.0, 3.0, 8.0]);
        assert_eq!(orbit.len(), 4);
        assert_eq!(orbit[..2], [[3.0, 3.0, 8.0], [6.0, 5.0, 8.0]]);
        assert_eq!(m.orbit(&[3.0, 3.0, 6.0]).len(), 8);
        let mut p = [4.2, 4.4, 7.5];
        m.snap(&mut p);
        assert_eq!(p, [4.5, 4.0, 8.0]);
        assert!(m.stands(&[4, 4, 4]) && !m.stands(&[5, 4, 4]));
    }
}
