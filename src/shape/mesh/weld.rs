//! Welding: vertices nearer to each other than a tolerance become one.

use super::topology::Union;
use super::tree::{Bounds, Tree};
use crate::error::{Result, filled, reserve};
use crate::math::Vec3;

/// For each point, the lowest index of those equal to it, among the `used` ones.
///
/// They are put one after the other into a table with twice as many places, each into the first
/// one that is free from where the bits of its coordinates say.
pub fn equal(points: &[Vec3], used: &[bool]) -> Result<Vec<u32>> {
    const FREE: u32 = u32::MAX;
    let count = used.iter().filter(|&&u| u).count();
    let mut table = filled("a table of vertices", (2 * count).next_power_of_two(), FREE)?;
    let last = table.len() - 1;
    let mut root = reserve("welded vertices", points.len())?;
    root.extend(0..points.len() as u32);
    for (i, p) in points.iter().enumerate().filter(|p| used[p.0]) {
        let mut at = mixed(p) as usize & last;
        while table[at] != FREE && points[table[at] as usize] != *p {
            at = (at + 1) & last;
        }
        if table[at] == FREE {
            table[at] = i as u32;
        } else {
            root[i] = table[at];
        }
    }
    Ok(root)
}

/// The bits of the coordinates mixed, with those of 0 for −0.
fn mixed(p: &Vec3) -> u64 {
    let mut sum = 0u64;
    for x in [p.x, p.y, p.z] {
        sum = (sum ^ (x + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        sum ^= sum >> 29;
    }
    sum = sum.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    sum ^ sum >> 32
}

/// As [`equal`], whose answer is given, with those `loose` points made one, too, that are linked
/// by steps of at most `reach`.
pub fn near(points: &[Vec3], equal: &[u32], loose: &[bool], reach: f64) -> Result<Vec<u32>> {
    let mut some: Vec<u32> = reserve("loose vertices", points.len())?;
    some.extend((0..points.len() as u32).filter(|&i| loose[i as usize] && equal[i as usize] == i));
    let place = |i: u32| points[i as usize];
    let tree = Tree::new(some.into_iter(), |i| Bounds { lo: place(i), hi: place(i) })?;
    let mut union = Union::new(points.len())?;
    tree.link(
        &mut union,
        |p, q| tree.distance2(p, q) > reach * reach,
        |i, j| (place(i) - place(j)).norm_squared() <= reach * reach,
    )?;
    let mut root = union.roots();
    for i in 0..root.len() {
        // Equal ones have lower indices than those that they stand for.
        root[i] = root[equal[i] as usize];
    }
    Ok(root)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// All pairs, linked until nothing changes.
    fn brute(points: &[Vec3], reach: f64) -> Vec<u32> {
        let mut root: Vec<u32> = (0..points.len() as u32).collect();
        loop {
            let mut changed = false;
            for i in 0..points.len() {
                for j in 0..points.len() {
                    let near = (points[i] - points[j]).norm_squared() <= reach * reach;
                    if near && root[j] < root[i] {
                        root[i] = root[j];
                        changed = true;
                    }
                }
            }
            if !changed {
                return root;
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 40, ..Default::default() })]
        #[test]
        fn equals_all_pairs(cells in prop::collection::vec((0u8..8, 0u8..8, 0u8..8), 3..80)) {
            // Points on a lattice of which some steps are within reach: many ties and chains.
            let mut points: Vec<Vec3> = cells
                .iter()
                .map(|c| Vec3::new(f64::from(c.0), f64::from(c.1), f64::from(c.2)) / 8192.0)
                .collect();
            points.push(Vec3::new(1.0, 1.0, 1.0));
            points.push(Vec3::zeros());
            points.push(-Vec3::zeros());
            let all = vec![true; points.len()];
            let same = equal(&points, &all).unwrap();
            prop_assert_eq!(&same, &brute(&points, 0.0));
            for reach in [0.0, 1.0 / 8192.0, 1.5 / 8192.0] {
                prop_assert_eq!(near(&points, &same, &all, reach).unwrap(), brute(&points, reach));
            }
            // Only loose ones move.
            let loose: Vec<bool> = (0..points.len()).map(|i| same[i].is_multiple_of(2)).collect();
            let found = near(&points, &same, &loose, 0.1).unwrap();
            for i in (0..points.len()).filter(|&i| !loose[i]) {
                prop_assert_eq!(found[i], same[i]);
            }
        }
    }
}
