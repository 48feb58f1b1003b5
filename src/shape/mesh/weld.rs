//! Welding: vertices nearer to each other than a tolerance become one.

use super::topology::Union;
use crate::error::{Result, filled, reserve};
use crate::math::Vec3;

/// The vertex that stands for each vertex: the lowest index among those it is one with.
pub struct Weld {
    /// Only equal points are one.
    pub exact: Vec<u32>,
    /// Points that are linked by steps of at most the tolerance are one.
    pub near: Vec<u32>,
}

/// Welds the points that `faces` use, with steps of at most `tolerance` times the
/// longest box edge. Points are in a unit frame.
///
/// They are sorted along a direction to which no plane of a usual part is
/// perpendicular, so that only neighbours in that order are compared.
pub fn weld(points: &[Vec3], faces: &[[u32; 3]], tolerance: f64) -> Result<Weld> {
    let along = Vec3::new(0.531_730_291, 0.637_208_347, 0.557_913_113);
    let mut used = filled("vertex flags", points.len(), false)?;
    faces.iter().flatten().for_each(|&v| used[v as usize] = true);
    let mut order: Vec<(f64, u32)> = reserve("welding order", points.len())?;
    order.extend((0..points.len()).filter(|&i| used[i]).map(|i| (points[i].dot(&along), i as u32)));
    let key = |i: u32| points[i as usize];
    order.sort_unstable_by(|a, b| {
        let (p, q) = (key(a.1), key(b.1));
        a.0.total_cmp(&b.0)
            .then_with(|| p.x.total_cmp(&q.x))
            .then_with(|| p.y.total_cmp(&q.y))
            .then_with(|| p.z.total_cmp(&q.z))
            .then_with(|| a.1.cmp(&b.1))
    });

    let mut union = Union::new(points.len())?;
    // Equal points follow one another: link them, and go on with one of each.
    let mut distinct: Vec<(f64, u32)> = reserve("distinct vertices", order.len())?;
    for &(s, i) in &order {
        match distinct.last() {
            Some(&(_, j)) if key(i) == key(j) => union.join(i, j),
            _ => distinct.push((s, i)),
        }
    }
    drop(order);
    let exact = union.clone().roots();
    let reach = tolerance * longest_edge(points, &distinct);
    // Room for the rounding of the projection, so that no pair is missed.
    let window = reach + 1e-15;
    for (n, &(s, i)) in distinct.iter().enumerate() {
        for &(_, j) in distinct[n + 1..].iter().take_while(|&&(t, _)| t - s <= window) {
            if (key(i) - key(j)).norm_squared() <= reach * reach {
                union.join(i, j);
            }
        }
    }
    Ok(Weld { exact, near: union.roots() })
}

fn longest_edge(points: &[Vec3], some: &[(f64, u32)]) -> f64 {
    let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    for &(_, i) in some {
        lo = lo.inf(&points[i as usize]);
        hi = hi.sup(&points[i as usize]);
    }
    (hi - lo).max().max(0.0)
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
            let n = points.len() as u32;
            let faces: Vec<[u32; 3]> = (0..n).map(|i| [i, i, i]).collect();
            for reach in [0.0, 1.0 / 8192.0, 1.5 / 8192.0] {
                let found = weld(&points, &faces, reach).unwrap();
                prop_assert_eq!(&found.near, &brute(&points, reach));
                prop_assert_eq!(&found.exact, &brute(&points, 0.0));
            }
        }
    }
}
