//! Whether a voxel may go without changing the topology, from its 26 neighbours as bits.
//!
//! Bit `i + 3 j + 9 k` is the voxel at (i − 1, j − 1, k − 1) from the middle one, which is bit 13.
//! Connected parts grow along all axes at once by shifts of the whole mask: a few steps of a dozen
//! operations, where a table would take 2^26 bits of the host's memory and of its caches.

/// The voxel itself.
const MIDDLE: u32 = 1 << 13;
/// All 27.
const ALL: u32 = (1 << 27) - 1;
/// First and last voxels along x, y, z.
const X0: u32 = 0o111_111_111;
const X2: u32 = X0 << 2;
const Y0: u32 = 0o007_007_007;
const Y2: u32 = Y0 << 6;
const Z0: u32 = 0o777;
const Z2: u32 = Z0 << 18;
/// Neighbours by a face; the middle ones along two axes.
const FACES: u32 = (1 << 4) | (1 << 10) | (1 << 12) | (1 << 14) | (1 << 16) | (1 << 22);
/// The eight neighbours by a corner only.
const CORNERS: u32 = (X0 | X2) & (Y0 | Y2) & (Z0 | Z2);

/// One step to both sides along x, y, z.
fn along_x(m: u32) -> u32 {
    ((m & !X2) << 1) | ((m & !X0) >> 1)
}
fn along_y(m: u32) -> u32 {
    ((m & !Y2) << 3) | ((m & !Y0) >> 3)
}
fn along_z(m: u32) -> u32 {
    ((m & !Z2) << 9) | (m >> 9)
}

/// What of `of` is joined to the lowest voxel of `from` by steps of `grow`.
fn joined(from: u32, of: u32, grow: impl Fn(u32) -> u32) -> u32 {
    let mut part = from & from.wrapping_neg();
    loop {
        let more = (part | grow(part)) & of;
        if more == part {
            return part;
        }
        part = more;
    }
}

/// Theorem 1 of Bertrand and Couprie (2014): the solid neighbours are one part (by corners, edges
/// or faces), and the empty ones at its faces are one part (by faces, among the 18 that share at
/// least an edge with it), neither of them empty.
pub(super) fn simple(around: u32) -> bool {
    let solid = around & ALL & !MIDDLE;
    let empty = !around & ALL & !MIDDLE & !CORNERS;
    let open = empty & FACES;
    if solid == 0 || open == 0 {
        return false;
    }
    let by_faces = |m: u32| along_x(m) | along_y(m) | along_z(m);
    if joined(open, empty, by_faces) & FACES != open {
        return false;
    }
    let by_all = |m: u32| {
        let m = m | along_x(m);
        let m = m | along_y(m);
        m | along_z(m)
    };
    joined(solid, solid, by_all) == solid
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By search over lists of neighbours.
    fn slow(around: u32) -> bool {
        let place = |b: usize| [b % 3, b / 3 % 3, b / 9].map(|i| i as i32);
        let apart = |a: usize, b: usize| {
            let (p, q) = (place(a), place(b));
            let d = [0, 1, 2].map(|i| (p[i] - q[i]).abs());
            (d.iter().sum::<i32>(), d.into_iter().max().unwrap())
        };
        let parts = |members: &[usize], near: &dyn Fn(usize, usize) -> bool| {
            let mut label: Vec<usize> = (0..members.len()).collect();
            for _ in 0..members.len() {
                for i in 0..members.len() {
                    for j in 0..members.len() {
                        if near(members[i], members[j]) {
                            label[i] = label[i].min(label[j]);
                        }
                    }
                }
            }
            label
        };
        let is_solid = |&b: &usize| b != 13 && around >> b & 1 == 1;
        let solid: Vec<usize> = (0..27).filter(is_solid).collect();
        let empty: Vec<usize> =
            (0..27).filter(|b| around >> b & 1 == 0 && *b != 13 && apart(*b, 13).0 <= 2).collect();
        let mut a = parts(&solid, &|i, j| apart(i, j).1 == 1);
        let labels = parts(&empty, &|i, j| apart(i, j).0 == 1);
        let faced = |i: &usize| apart(empty[*i], 13).0 == 1;
        let mut b: Vec<usize> = (0..empty.len()).filter(faced).map(|i| labels[i]).collect();
        for l in [&mut a, &mut b] {
            l.sort_unstable();
            l.dedup();
        }
        a.len() == 1 && b.len() == 1
    }

    #[test]
    fn bits_are_what_a_search_finds() {
        let mut seen = [0u32; 2];
        let mut n = 0x2545_f491u32;
        for turn in 0..20_000u32 {
            n ^= n << 13;
            n ^= n >> 17;
            n ^= n << 5;
            // Sparse, even and dense ones.
            let m = [n & n.rotate_left(11), n, n | n.rotate_left(9) | n.rotate_left(21)];
            let around = m[turn as usize % 3] & ALL;
            let found = simple(around);
            seen[usize::from(found)] += 1;
            assert_eq!(found, slow(around), "{around:o}");
        }
        assert!(seen.iter().all(|&s| s > 1000), "{seen:?}");
        assert!(!simple(0) && !simple(ALL) && !simple(MIDDLE));
        assert!(simple(1) && simple(ALL & !(1 << 12)));
        assert!(!simple(ALL & !(1 << 12) & !(1 << 14)));
    }
}
