//! A tree over boxes: which of them are near, and which hang together. Split at the
//! median, so that one item far away does not crowd the others into one place.

use super::topology::Union;
use crate::error::{Result, reserve};
use crate::math::Vec3;

/// Most items of a leaf.
const LEAF: usize = 8;

/// A box with its sides along the axes.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Lower corner.
    pub lo: Vec3,
    /// Upper corner.
    pub hi: Vec3,
}

impl Bounds {
    /// Holds nothing yet.
    pub fn empty() -> Bounds {
        Bounds { lo: Vec3::repeat(f64::MAX), hi: Vec3::repeat(f64::MIN) }
    }

    /// The box of some points.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a Vec3>) -> Bounds {
        points.into_iter().fold(Bounds::empty(), |b, p| b.join(&Bounds { lo: *p, hi: *p }))
    }

    /// The box of both.
    pub fn join(&self, other: &Bounds) -> Bounds {
        Bounds { lo: self.lo.inf(&other.lo), hi: self.hi.sup(&other.hi) }
    }

    /// Whether they come within `slack` of each other along every axis.
    pub fn meets(&self, other: &Bounds, slack: f64) -> bool {
        (0..3).all(|k| self.lo[k] <= other.hi[k] + slack && other.lo[k] <= self.hi[k] + slack)
    }

    /// Whether the other one lies in this one.
    pub fn holds(&self, other: &Bounds) -> bool {
        (0..3).all(|k| self.lo[k] <= other.lo[k] && other.hi[k] <= self.hi[k])
    }

    /// The square of the distance between them.
    pub fn distance2(&self, other: &Bounds) -> f64 {
        let gap = (self.lo - other.hi).sup(&(other.lo - self.hi)).sup(&Vec3::zeros());
        gap.norm_squared()
    }
}

/// Some items next to one another.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// The box about them.
    pub bounds: Bounds,
    /// Their places in [`Tree::order`].
    first: u32,
    end: u32,
    /// The second half; the first follows this node. 0 for a leaf.
    second: u32,
}

impl Node {
    /// The place of its first item.
    pub fn first(&self) -> u32 {
        self.first
    }

    /// The two halves, but for a leaf.
    pub fn halves(&self, at: usize) -> Option<[usize; 2]> {
        (self.second > 0).then_some([at + 1, self.second as usize])
    }
}

/// The tree.
pub struct Tree {
    /// The items, those of a node next to one another.
    order: Vec<u32>,
    /// The root first, each one before its halves.
    nodes: Vec<Node>,
}

impl Tree {
    /// A tree over `items`, whose boxes are `bounds`.
    pub fn new(
        items: impl ExactSizeIterator<Item = u32>,
        bounds: impl Fn(u32) -> Bounds,
    ) -> Result<Tree> {
        let count = items.len();
        let mut keyed: Vec<(f64, u32)> = reserve("a tree", count)?;
        keyed.extend(items.map(|i| (0.0, i)));
        // A leaf holds at least half of LEAF, but for the root.
        let mut tree = Tree { order: Vec::new(), nodes: reserve("a tree", 4 * count / LEAF + 1)? };
        if count > 0 {
            tree.grow(&mut keyed, 0, &bounds);
        }
        tree.order = reserve("a tree", count)?;
        tree.order.extend(keyed.iter().map(|k| k.1));
        Ok(tree)
    }

    fn grow(&mut self, keyed: &mut [(f64, u32)], first: usize, bounds: &impl Fn(u32) -> Bounds) {
        let (mut all, mut middles) = (Bounds::empty(), Bounds::empty());
        for k in keyed.iter() {
            let b = bounds(k.1);
            all = all.join(&b);
            let middle = b.lo + b.hi;
            middles = middles.join(&Bounds { lo: middle, hi: middle });
        }
        let at = self.nodes.len();
        let end = (first + keyed.len()) as u32;
        self.nodes.push(Node { bounds: all, first: first as u32, end, second: 0 });
        if keyed.len() <= LEAF {
            keyed.sort_unstable_by_key(|k| k.1);
            return;
        }
        let axis = (middles.hi - middles.lo).imax();
        for k in keyed.iter_mut() {
            let b = bounds(k.1);
            k.0 = b.lo[axis] + b.hi[axis];
        }
        let half = keyed.len() / 2;
        keyed.select_nth_unstable_by(half, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (a, b) = keyed.split_at_mut(half);
        self.grow(a, first, bounds);
        self.nodes[at].second = self.nodes.len() as u32;
        self.grow(b, first + half, bounds);
    }

    /// The nodes, each one before its halves.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The square of the distance between the boxes of two nodes.
    pub fn distance2(&self, a: usize, b: usize) -> f64 {
        self.nodes[a].bounds.distance2(&self.nodes[b].bounds)
    }

    /// The items of a node.
    pub fn items(&self, node: &Node) -> &[u32] {
        &self.order[node.first as usize..node.end as usize]
    }

    /// Goes down from the root, into nodes for which `enter` holds, to their leaves;
    /// until `leaf` says that it is enough.
    pub fn descend(&self, enter: impl Fn(&Node) -> bool, mut leaf: impl FnMut(&[u32]) -> bool) {
        // The depth is the logarithm of 2³² at most.
        let mut stack = [0usize; 40];
        let mut top = usize::from(!self.nodes.is_empty());
        while top > 0 {
            top -= 1;
            let at = stack[top];
            let node = &self.nodes[at];
            if !enter(node) {
                continue;
            }
            match node.halves(at) {
                Some([a, b]) => {
                    stack[top] = b;
                    stack[top + 1] = a;
                    top += 2;
                }
                None if leaf(self.items(node)) => return,
                None => {}
            }
        }
    }

    /// Makes one set of items for which `near` holds, and of what they are near to.
    /// `apart`: whether no items of two nodes (by their numbers) can be near. Nodes that are one set already
    /// are not looked at again, so that a heap of items costs no more than a line.
    pub fn link(
        &self,
        union: &mut Union,
        apart: impl Fn(usize, usize) -> bool,
        near: impl Fn(u32, u32) -> bool,
    ) -> Result<()> {
        let one = crate::error::filled("nodes of a tree", self.nodes.len(), false)?;
        if !self.nodes.is_empty() {
            Linker { tree: self, union, one, apart, near }.within(0);
        }
        Ok(())
    }
}

struct Linker<'a, A, N> {
    tree: &'a Tree,
    union: &'a mut Union,
    /// Whether all items of a node are known to be one set.
    one: Vec<bool>,
    apart: A,
    near: N,
}

impl<A: Fn(usize, usize) -> bool, N: Fn(u32, u32) -> bool> Linker<'_, A, N> {
    fn within(&mut self, at: usize) {
        let tree = self.tree;
        let node = &tree.nodes[at];
        match node.halves(at) {
            Some([a, b]) => {
                self.within(a);
                self.within(b);
                self.between(a, b);
                self.one[at] = self.are_one(a, b);
            }
            None => {
                let items = tree.items(node);
                for (k, &i) in items.iter().enumerate() {
                    items[k + 1..].iter().for_each(|&j| self.try_join(i, j));
                }
                let root = self.union.root(items[0]);
                self.one[at] = items.iter().all(|&i| self.union.root(i) == root);
            }
        }
    }

    fn between(&mut self, a: usize, b: usize) {
        let tree = self.tree;
        if (self.apart)(a, b) || self.are_one(a, b) {
            return;
        }
        let (p, q) = (&tree.nodes[a], &tree.nodes[b]);
        let larger_first = p.end - p.first >= q.end - q.first;
        match (p.halves(a), q.halves(b)) {
            (Some(halves), other) if larger_first || other.is_none() => {
                halves.into_iter().for_each(|h| self.between(h, b));
            }
            (_, Some(halves)) => halves.into_iter().for_each(|h| self.between(a, h)),
            _ => {
                for &i in tree.items(p) {
                    for &j in tree.items(q) {
                        self.try_join(i, j);
                    }
                    if self.are_one(a, b) {
                        return;
                    }
                }
            }
        }
    }

    fn are_one(&mut self, a: usize, b: usize) -> bool {
        let first = |at: usize| self.tree.order[self.tree.nodes[at].first as usize];
        self.one[a] && self.one[b] && self.union.root(first(a)) == self.union.root(first(b))
    }

    fn try_join(&mut self, i: u32, j: u32) {
        if self.union.root(i) != self.union.root(j) && (self.near)(i, j) {
            self.union.join(i, j);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::cell::Cell;

    fn boxes(seed: &[[u8; 6]]) -> Vec<Bounds> {
        let vector = |c: &[u8]| Vec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2]));
        let lo = seed.iter().map(|s| vector(&s[..3]));
        lo.zip(seed).map(|(lo, s)| Bounds { lo, hi: lo + vector(&s[3..]) / 16.0 }).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 60, ..Default::default() })]
        #[test]
        fn finds_what_all_pairs_find(
            seed in prop::collection::vec(prop::array::uniform6(0u8..40), 1..120),
        ) {
            let all = boxes(&seed);
            let n = all.len() as u32;
            let tree = Tree::new(0..n, |i| all[i as usize]).unwrap();
            let mut plain = Union::new(all.len()).unwrap();
            for (i, b) in all.iter().enumerate() {
                let mut found: Vec<u32> = Vec::new();
                tree.descend(
                    |node| node.bounds.meets(b, 1.0),
                    |leaf| {
                        found.extend(leaf.iter().filter(|&&j| all[j as usize].meets(b, 1.0)));
                        false
                    },
                );
                found.sort_unstable();
                let expected: Vec<u32> =
                    (0..n).filter(|&j| all[j as usize].meets(b, 1.0)).collect();
                prop_assert_eq!(&found, &expected);
                expected.iter().for_each(|&j| plain.join(i as u32, j));
            }
            let mut union = Union::new(all.len()).unwrap();
            tree.link(
                &mut union,
                |p, q| !tree.nodes[p].bounds.meets(&tree.nodes[q].bounds, 1.0),
                |i, j| all[i as usize].meets(&all[j as usize], 1.0),
            ).unwrap();
            prop_assert_eq!(union.roots(), plain.roots());
        }
    }

    #[test]
    fn a_heap_and_one_far_away_are_linked_in_few_looks() {
        let n = 20_000u32;
        let place = |i: u32| {
            let x = |a: f64| (f64::from(i) * a).fract();
            let p = Vec3::new(x(0.618), x(0.414), x(0.732));
            let p = if i == 7 { Vec3::repeat(1e9) } else { p };
            Bounds { lo: p, hi: p }
        };
        let tree = Tree::new(0..n, place).unwrap();
        // All within reach; about thirty neighbours; none.
        for (reach, sets) in [(2.0, Some(2)), (0.07, None), (0.001, None)] {
            let looks = Cell::new(0u64);
            let mut union = Union::new(n as usize).unwrap();
            tree.link(
                &mut union,
                |p, q| tree.distance2(p, q) > reach * reach,
                |i, j| {
                    looks.set(looks.get() + 1);
                    place(i).distance2(&place(j)) <= reach * reach
                },
            )
            .unwrap();
            assert!(looks.get() < 40 * u64::from(n), "{} at {reach}", looks.get());
            assert!(sets.is_none_or(|s| union.numbered().1 == s));
        }
    }
}
