//! Welding: vertices nearer to each other than a tolerance become one.

use super::topology::Union;
use super::tree::{Bounds, Tree};
use crate::error::{Result, reserve};
use crate::math::Vec3;

/// For each point, the lowest index of those equal to it, among the `used` ones.
///
/// They are sorted along a direction to which no plane of a usual part is
/// perpendicular, so that the sums seldom tie.
pub fn equal(points: &[Vec3], used: &[bool]) -> Result<Vec<u32>> {
    let along = Vec3::new(0.531_730_291, 0.637_208_347, 0.557_913_113);
    let mut order: Vec<(i64, u32)> = reserve("welding order", points.len())?;
    let sum = |i: usize| {
        // In the order of `total_cmp`.
        let bits = points[i].dot(&along).to_bits() as i64;
        bits ^ (((bits >> 63) as u64) >> 1) as i64
    };
    order.extend((0..points.len()).filter(|&i| used[i]).map(|i| (sum(i), i as u32)));
    order.sort_unstable();
    let key = |i: u32| points[i as usize];
    for tied in order.chunk_by_mut(|a, b| a.0 == b.0).filter(|t| t.len() > 1) {
        tied.sort_unstable_by(|a, b| {
            let (p, q) = (key(a.1), key(b.1));
            p.x.total_cmp(&q.x)
                .then_with(|| p.y.total_cmp(&q.y))
                .then_with(|| p.z.total_cmp(&q.z))
                .then_with(|| a.1.cmp(&b.1))
        });
    }
    let mut root = reserve("welded vertices", points.len())?;
    root.extend(0..points.len() as u32);
    for group in order.chunk_by(|a, b| key(a.1) == key(b.1)) {
        group.iter().for_each(|g| root[g.1 as usize] = group[0].1);
    }
    Ok(root)
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
