//! A tree over spheres: those near a point are found without a look at all of them.

use crate::error::{Result, reserve};
use crate::math::{Sphere, Vec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Most spheres of a leaf.
const LEAF: usize = 4;
/// Boxes are wider than the spheres by this share, so that no rounding shuts one out.
const WIDER: f64 = 1e-12;

/// Spheres halved at the median, along the axis on which they spread most or by radius: a few
/// great ones among many small would widen every box.
pub(crate) struct Tree {
    order: Vec<u32>,
    /// Depth first: the left child of a node is the next one.
    nodes: Vec<Node>,
}

/// The spheres `order[first..last]`.
struct Node {
    lo: Vec3,
    hi: Vec3,
    first: u32,
    last: u32,
    /// The first node that is not below this one.
    skip: u32,
}

/// What a sphere is sorted by: a coordinate of its centre, or its radius.
fn key(s: &Sphere, k: usize) -> f64 {
    if k < 3 { s.center[k] } else { s.radius }
}

impl Tree {
    /// Over those of the spheres that are `wanted`.
    pub(crate) fn new(spheres: &[Sphere], wanted: impl Fn(usize) -> bool) -> Result<Tree> {
        let mut order = reserve("the tree of spheres", spheres.len())?;
        order.extend((0..spheres.len() as u32).filter(|&i| wanted(i as usize)));
        // Halves of more than LEAF hold more than LEAF / 2 each.
        let most = (2 * order.len()).div_ceil(LEAF / 2) + 1;
        let mut tree = Tree { order, nodes: reserve("the tree of spheres", most)? };
        if !tree.order.is_empty() {
            tree.gather(spheres, 0, tree.order.len());
        }
        Ok(tree)
    }

    fn gather(&mut self, spheres: &[Sphere], first: usize, last: usize) {
        let at = self.nodes.len();
        let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
        let mut spread = [[f64::MAX, f64::MIN]; 4];
        for &i in &self.order[first..last] {
            let s = &spheres[i as usize];
            let r = Vec3::repeat(s.radius + WIDER * (s.radius + s.center.amax()));
            (lo, hi) = (lo.inf(&(s.center - r)), hi.sup(&(s.center + r)));
            for (k, range) in spread.iter_mut().enumerate() {
                *range = [range[0].min(key(s, k)), range[1].max(key(s, k))];
            }
        }
        self.nodes.push(Node { lo, hi, first: first as u32, last: last as u32, skip: 0 });
        if last - first > LEAF {
            let widest = spread
                .iter()
                .enumerate()
                .max_by(|x, y| (x.1[1] - x.1[0]).total_cmp(&(y.1[1] - y.1[0])));
            let k = widest.map_or(0, |w| w.0);
            let middle = (last - first) / 2;
            self.order[first..last].select_nth_unstable_by(middle, |&i, &j| {
                let of = |i: u32| key(&spheres[i as usize], k);
                of(i).total_cmp(&of(j)).then(i.cmp(&j))
            });
            self.gather(spheres, first, first + middle);
            self.gather(spheres, first + middle, last);
        }
        self.nodes[at].skip = self.nodes.len() as u32;
    }

    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        (self.order.capacity() * 4 + self.nodes.capacity() * size_of::<Node>()) as u64
    }

    /// Whether `found` holds for one of the spheres in boxes (lower and upper corner) that
    /// `enter` lets in.
    pub(crate) fn any(
        &self,
        enter: impl Fn(&Vec3, &Vec3) -> bool,
        mut found: impl FnMut(u32) -> bool,
    ) -> bool {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let inside = enter(&node.lo, &node.hi);
            if inside && self.leaf(node).iter().any(|&i| found(i)) {
                return true;
            }
            at = if inside { at + 1 } else { node.skip as usize };
        }
        false
    }

    /// The same for spheres about a point.
    pub(crate) fn any_about(&self, p: &Vec3, found: impl FnMut(u32) -> bool) -> bool {
        let holds = |lo: &Vec3, hi: &Vec3| (0..3).all(|a| lo[a] <= p[a] && p[a] <= hi[a]);
        self.any(holds, found)
    }

    /// Visits the spheres by rise of `away`, which is not negative and no less than the distance
    /// of `p` from the sphere's box, as long as it is less than what the last visit gave back.
    pub(crate) fn nearest_first(
        &self,
        p: &Vec3,
        away: impl Fn(u32) -> f64,
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        // Distances are not negative, so their bits sort as they do. Nodes, then spheres.
        let nodes = self.nodes.len();
        let mut next = BinaryHeap::new();
        let mut best = f64::MAX;
        if nodes > 0 {
            next.push(Reverse((0u64, 0usize)));
        }
        while let Some(Reverse((bits, item))) = next.pop() {
            if f64::from_bits(bits) >= best {
                break;
            }
            let Some(node) = self.nodes.get(item) else {
                best = visit((item - nodes) as u32, f64::from_bits(bits));
                continue;
            };
            for &i in self.leaf(node) {
                next.push(Reverse((away(i).to_bits(), nodes + i as usize)));
            }
            let mut child = item + 1;
            while child < node.skip as usize {
                let n = &self.nodes[child];
                let gap = (n.lo - p).sup(&(p - n.hi)).sup(&Vec3::zeros()).norm();
                next.push(Reverse((gap.to_bits(), child)));
                child = n.skip as usize;
            }
        }
    }

    /// The spheres of a node that has none below it.
    fn leaf(&self, node: &Node) -> &[u32] {
        let range = node.first as usize..node.last as usize;
        if range.len() > LEAF { &[] } else { self.order.get(range).unwrap_or(&[]) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    fn scattered(n: u32) -> Vec<Sphere> {
        (0..n)
            .map(|i| {
                let t = f64::from(i);
                let c = Vec3::new((t * 0.37).fract(), (t * 0.617).fract(), (t * 0.8303).fract());
                // A few are great.
                let r = if i % 97 == 0 { 0.4 } else { 0.3 * f64::from(n).cbrt().recip() };
                Sphere::new(c, r * (1.0 + (t * 0.29).fract()))
            })
            .collect()
    }

    #[test]
    fn as_all_spheres_say() {
        for n in [0, 1, 2, 5, 6, 300] {
            let spheres = scattered(n);
            let tree = Tree::new(&spheres, |i| i % 7 != 3).unwrap();
            for k in 0..50 {
                let t = f64::from(k) * 0.71;
                let p = Vec3::new(t.sin(), (1.7 * t).cos(), (0.4 * t).sin());
                let mut about = Vec::new();
                tree.any_about(&p, |i| {
                    if spheres[i as usize].contains(&p) {
                        about.push(i);
                    }
                    false
                });
                about.sort_unstable();
                let wanted = |i: &u32| i % 7 != 3;
                let plain: Vec<u32> =
                    (0..n).filter(wanted).filter(|&i| spheres[i as usize].contains(&p)).collect();
                assert_eq!(about, plain);
                let away = |i: u32| {
                    let s = &spheres[i as usize];
                    ((p - s.center).norm() - s.radius).abs()
                };
                let mut seen = Vec::new();
                tree.nearest_first(&p, away, |i, e| {
                    seen.push((i, e));
                    if seen.len() < 5 { f64::MAX } else { 0.0 }
                });
                let mut plain: Vec<(u32, f64)> =
                    (0..n).filter(wanted).map(|i| (i, away(i))).collect();
                plain.sort_by(|x, y| x.1.total_cmp(&y.1).then(x.0.cmp(&y.0)));
                plain.truncate(5);
                assert_eq!(seen, plain);
            }
        }
    }

    /// The work for a point hardly grows with the number of spheres.
    #[test]
    fn few_are_looked_at() {
        let looks = |n: u32| {
            let spheres = scattered(n);
            let tree = Tree::new(&spheres, |i| i % 97 != 0).unwrap();
            let count = Cell::new(0u64);
            for k in 0..100 {
                let t = f64::from(k);
                let p = Vec3::new((t * 0.31).fract(), (t * 0.77).fract(), (t * 0.53).fract());
                let enter = |lo: &Vec3, hi: &Vec3| {
                    count.set(count.get() + 1);
                    (0..3).all(|a| lo[a] <= p[a] && p[a] <= hi[a])
                };
                tree.any(enter, |_| false);
                let away = |i: u32| {
                    count.set(count.get() + 1);
                    ((p - spheres[i as usize].center).norm() - spheres[i as usize].radius).abs()
                };
                tree.nearest_first(&p, away, |_, e| e);
            }
            count.get() / 100
        };
        let (few, many) = (looks(500), looks(50_000));
        assert!(many < 3 * few && many < 500, "{few} {many}");
    }
}
