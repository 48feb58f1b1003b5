//! A tree of bounding spheres over the spheres of a template.

use super::small::mul;
use crate::error::{Result, reserve};
use crate::math::{Sphere, Vec3};
use nalgebra::Matrix3;
use std::ops::Range;

/// At most so many spheres in a leaf.
const LEAF: usize = 4;

/// A ball around the spheres `from .. to`; its two children follow unless it is a leaf.
#[derive(Debug, Clone, Copy)]
struct Node {
    center: Vec3,
    radius: f64,
    from: u32,
    to: u32,
    /// The second child; the first is the next node. 0 for a leaf.
    other: u32,
}

/// A tree over spheres that it has put in order.
#[derive(Debug, Clone)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
}

/// Two spheres, one of each body, or a sphere and a feature of a wall, and the gap between their surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Near {
    pub a: u32,
    pub b: u32,
    pub gap: f64,
}

impl Tree {
    /// Builds the tree and puts the spheres, and with them `order`, in its order.
    pub fn new(spheres: &mut [Sphere], order: &mut [u32]) -> Result<Tree> {
        let mut nodes = reserve("the sphere tree", 2 * spheres.len())?;
        let mut both: Vec<(Sphere, u32)> = reserve("the sphere tree", spheres.len())?;
        both.extend(spheres.iter().copied().zip(order.iter().copied()));
        split(&mut both, 0, &mut nodes);
        for ((s, o), (sphere, at)) in spheres.iter_mut().zip(order.iter_mut()).zip(both) {
            (*s, *o) = (sphere, at);
        }
        Ok(Tree { nodes })
    }

    pub fn bytes(&self) -> u64 {
        (self.nodes.capacity() * size_of::<Node>()) as u64
    }

    /// Every sphere for which `within` a ball (centre, radius) says that it is not surely too far. Returns how many balls were
    /// looked at.
    pub fn each(
        &self,
        stack: &mut Vec<[u32; 2]>,
        within: impl Fn(&Vec3, f64) -> bool,
        mut found: impl FnMut(u32),
    ) -> u64 {
        let mut looked = 0;
        stack.clear();
        if !self.nodes.is_empty() {
            stack.push([0, 0]);
        }
        while let Some([n, _]) = stack.pop() {
            looked += 1;
            let node = &self.nodes[n as usize];
            if !within(&node.center, node.radius) {
                continue;
            }
            if node.other == 0 {
                looked += u64::from(node.to - node.from);
                (node.from..node.to).for_each(&mut found);
            } else {
                stack.push([node.other, 0]);
                stack.push([n + 1, 0]);
            }
        }
        looked
    }

    /// Every pair of leaves, each as the range of its spheres, whose balls come within `reach` of each other, `other` being turned by
    /// `turn` and shifted by `shift` into the frame of `self`. Returns how many pairs of balls were looked at.
    pub fn pairs(
        &self,
        other: &Tree,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        mut found: impl FnMut(Range<usize>, Range<usize>),
    ) -> u64 {
        let mut looked = 0;
        stack.clear();
        if !self.nodes.is_empty() && !other.nodes.is_empty() {
            stack.push([0, 0]);
        }
        while let Some([n, m]) = stack.pop() {
            looked += 1;
            let (p, q) = (&self.nodes[n as usize], &other.nodes[m as usize]);
            let far = p.radius + q.radius + reach;
            if (mul(turn, &q.center) + shift - p.center).norm_squared() > far * far {
                continue;
            }
            match (p.other, q.other) {
                (0, 0) => {
                    looked += u64::from((p.to - p.from) * (q.to - q.from));
                    let range = |n: &Node| n.from as usize..n.to as usize;
                    found(range(p), range(q));
                }
                // The larger ball is opened.
                (second, m2) if second != 0 && (m2 == 0 || p.radius >= q.radius) => {
                    stack.push([second, m]);
                    stack.push([n + 1, m]);
                }
                (_, second) => {
                    stack.push([n, second]);
                    stack.push([n, m + 1]);
                }
            }
        }
        looked
    }
}

/// Appends the node of these spheres, of which the first is number `from`, and those below it.
fn split(spheres: &mut [(Sphere, u32)], from: u32, nodes: &mut Vec<Node>) {
    let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    for (s, _) in spheres.iter() {
        lo = lo.inf(&s.center.add_scalar(-s.radius));
        hi = hi.sup(&s.center.add_scalar(s.radius));
    }
    let center = lo + (hi - lo) * 0.5;
    let radius =
        spheres.iter().map(|(s, _)| (s.center - center).norm() + s.radius).fold(0.0, f64::max);
    // A little more, for the rounding of what is compared with it.
    let radius = radius * (1.0 + 1e-14);
    let (at, count) = (nodes.len(), spheres.len());
    nodes.push(Node { center, radius, from, to: from + count as u32, other: 0 });
    if count <= LEAF {
        return;
    }
    let axis = (hi - lo).imax();
    let middle = count / 2;
    spheres.select_nth_unstable_by(middle, |(s, i), (t, j)| {
        s.center[axis].total_cmp(&t.center[axis]).then(i.cmp(j))
    });
    let (left, right) = spheres.split_at_mut(middle);
    split(left, from, nodes);
    nodes[at].other = nodes.len() as u32;
    split(right, from + middle as u32, nodes);
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{UnitQuaternion, Vector3};

    /// Spheres along a spiral, of many sizes.
    fn spiral(n: usize) -> Vec<Sphere> {
        let at = |i: usize| {
            let t = i as f64;
            Vec3::new((0.7 * t).cos(), (0.7 * t).sin(), 0.05 * t) * (1.0 + 0.3 * (1.3 * t).sin())
        };
        (0..n).map(|i| Sphere::new(at(i), 0.05 + 0.1 * ((i * 7) % 5) as f64)).collect()
    }

    #[test]
    fn pairs_are_those_of_all_against_all() {
        for (n, m) in [(1, 1), (1, 40), (37, 61), (4, 5)] {
            let (mut a, mut b) = (spiral(n), spiral(m));
            let (mut oa, mut ob): (Vec<u32>, Vec<u32>) =
                ((0..n as u32).collect(), (0..m as u32).collect());
            let (ta, tb) =
                (Tree::new(&mut a, &mut oa).unwrap(), Tree::new(&mut b, &mut ob).unwrap());
            let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.8, 1.1));
            let turn = turn.to_rotation_matrix().into_inner();
            let mut stack = Vec::new();
            for (x, reach) in [(0.5, 0.0), (1.5, 0.2), (2.4, 0.01), (9.0, 0.1)] {
                let shift = Vec3::new(x, 0.2, 0.1);
                let gap = |i: usize, j: usize| {
                    let d = (turn * b[j].center + shift - a[i].center).norm();
                    d - a[i].radius - b[j].radius
                };
                let mut found = Vec::new();
                ta.pairs(&tb, (&shift, &turn), reach, &mut stack, |p, q| {
                    let all = p.flat_map(|i| q.clone().map(move |j| (i, j)));
                    found.extend(all.filter(|&(i, j)| gap(i, j) < reach));
                });
                found.sort_unstable();
                let all = (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
                let slow: Vec<_> = all.filter(|&(i, j)| gap(i, j) < reach).collect();
                assert_eq!(found, slow, "{n} {m} {x}");
            }
        }
    }
}
