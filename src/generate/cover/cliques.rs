//! Critical cliques of voxels that touch each other (Bertrand and Couprie 2014): of each, one
//! voxel must stay. A clique is all solid voxels around a face, an edge or a vertex of the lattice
//! that have just that in common.
//!
//! A clique is regular when its solid neighbours that touch every voxel of it can be reduced to
//! one voxel by removing simple ones. For two voxels with a common face these neighbours lie in a
//! ring of eight places, two side by side in each. All of them touch the plane of the common face,
//! and as closed cubes they have common points exactly where their traces on that plane have: so
//! the ring decides by its eight places as in the plane. For an edge they lie beyond its two ends,
//! where those at one end share a point: exactly one end must have some. For a vertex there are
//! none: such a clique is always critical.

/// A voxel is solid.
pub(super) const SOLID: u8 = 1;
/// It has an empty neighbour by a face.
pub(super) const BORDER: u8 = 2;
/// It stays: an end.
pub(super) const KEPT: u8 = 4;
/// It may go in this pass.
pub(super) const LOOSE: u8 = 8;

/// Cells with a margin of empty ones on every side, and the way to the next along each axis.
pub(super) struct Lattice<'a> {
    pub state: &'a [u8],
    pub step: [isize; 3],
}

impl Lattice<'_> {
    #[inline(always)]
    pub(super) fn get(&self, at: isize) -> u8 {
        self.state.get(at as usize).copied().unwrap_or(0)
    }

    #[inline(always)]
    pub(super) fn solid(&self, at: isize) -> bool {
        self.get(at) & SOLID != 0
    }

    /// The voxel and its 26 neighbours as bits.
    #[inline]
    pub(super) fn around(&self, at: isize) -> u32 {
        let [_, y, z] = self.step;
        let mut bits = 0;
        let mut shift = 0;
        for layer in [at - z, at, at + z] {
            for row in [layer - y, layer, layer + y] {
                let first = (row - 1) as usize;
                if let Some(&[a, b, c]) = self.state.get(first..first + 3) {
                    bits |= u32::from((a & 1) | (b & 1) << 1 | (c & 1) << 2) << shift;
                }
                shift += 3;
            }
        }
        bits
    }

    /// Whether a critical clique around a face has this voxel as its first.
    pub(super) fn first_by_face(&self, at: isize) -> bool {
        (0..3).any(|axis| {
            let other = at + self.step[axis];
            if self.get(other) & LOOSE == 0 {
                return false;
            }
            let (u, v) = (self.step[(axis + 1) % 3], self.step[(axis + 2) % 3]);
            let places = [u, u + v, v, v - u, -u, -u - v, -v, u - v];
            let mut ring = 0;
            for (i, place) in places.into_iter().enumerate() {
                ring |= ((self.get(at + place) | self.get(other + place)) & SOLID) << i;
            }
            !one_arc(ring)
        })
    }

    /// The same around an edge.
    pub(super) fn first_by_edge(&self, at: isize) -> bool {
        (0..12).any(|edge| {
            let axis = edge / 4;
            let sign = |k: usize| if edge >> k & 1 == 1 { 1 } else { -1 };
            let u = sign(0) * self.step[(axis + 1) % 3];
            let v = sign(1) * self.step[(axis + 2) % 3];
            let others = [at + u, at + v, at + u + v];
            let [a, b, across] = others.map(|o| self.solid(o));
            // Two that face each other across the edge have nothing else in common.
            if !(across || a && b) || !self.is_first(at, &others) {
                return false;
            }
            let beyond =
                |end: isize| [0, u, v, u + v].into_iter().any(|place| self.solid(at + end + place));
            beyond(self.step[axis]) == beyond(-self.step[axis])
        })
    }

    /// The same around a vertex.
    pub(super) fn first_by_vertex(&self, at: isize) -> bool {
        (0..8).any(|corner| {
            let way =
                [0, 1, 2].map(|a| if corner >> a & 1 == 1 { self.step[a] } else { -self.step[a] });
            let place =
                |m: usize| (0..3).filter(|a| m >> a & 1 == 1).map(|a| way[a]).sum::<isize>();
            // This voxel lies on side 0 of each axis: for each there must be one on side 1.
            let mut beyond = 0;
            let mut others = [at; 7];
            for (m, other) in (1..8).zip(&mut others) {
                *other = at + place(m);
                if self.solid(*other) {
                    beyond |= m;
                }
            }
            beyond == 7 && self.is_first(at, &others)
        })
    }

    /// Whether all solid ones of the others may go and come later.
    #[inline]
    fn is_first(&self, at: isize, others: &[isize]) -> bool {
        others.iter().all(|&o| {
            let state = self.get(o);
            state & SOLID == 0 || state & LOOSE != 0 && o > at
        })
    }
}

/// Whether the places of a ring (bit 0 by a face, bit 1 by an edge, and so on round) can be
/// reduced to one: not empty, one part, and not all the way round. Neighbours by faces next to
/// each other touch at the corner between them.
fn one_arc(ring: u8) -> bool {
    let faces = ring & 0x55;
    let full = ring | (faces.rotate_left(1) & faces.rotate_right(1));
    (full & !full.rotate_left(1)).count_ones() == 1
}

#[cfg(test)]
mod tests {
    use super::super::simple::simple;
    use super::*;
    use std::collections::BTreeSet;

    type Place = [i32; 3];

    /// Reduces to one voxel by taking simple ones away, each in the set of those that are left.
    fn reducible(mut left: BTreeSet<Place>) -> bool {
        while left.len() > 1 {
            let is_simple = |p: &Place| {
                let bits = (0..27).filter(|b| {
                    let d = [b % 3 - 1, b / 3 % 3 - 1, b / 9 - 1];
                    left.contains(&[p[0] + d[0], p[1] + d[1], p[2] + d[2]])
                });
                simple(bits.map(|b| 1u32 << b).sum())
            };
            let Some(p) = left.iter().copied().find(is_simple) else { return false };
            left.remove(&p);
        }
        left.len() == 1
    }

    /// All sets of neighbours of two voxels that share a face.
    #[test]
    fn the_ring_decides_for_faces() {
        let ring = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
        for set in 0..1u32 << 16 {
            let chosen = (0..16).filter(|b| set >> b & 1 == 1);
            let places =
                chosen.map(|b: usize| [(b / 8) as i32, ring[b % 8][0], ring[b % 8][1]]).collect();
            assert_eq!(one_arc((set | set >> 8) as u8), reducible(places), "{set:x}");
        }
    }

    #[test]
    fn the_ends_decide_for_edges() {
        for set in 0..1u32 << 8 {
            let chosen = (0..8).filter(|b| set >> b & 1 == 1);
            let places = chosen.map(|b| [b & 1, b >> 1 & 1, 2 * (b >> 2) - 1]).collect();
            assert_eq!((set & 15 != 0) != (set >> 4 != 0), reducible(places), "{set:x}");
        }
    }
}
