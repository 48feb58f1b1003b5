//! A tree of boxes, each turned as the faces in it lie, eight to a node and looked at together.
//!
//! About the centre of a ball that touches the surface, very many faces are nearly as near as the
//! nearest one. A box along the axes of the lattice is as thick as a slanted face is long and
//! tells them apart only far away; one that lies flat on its faces does at once.
//!
//! Boxes are in f32, in a frame about the middle of all: they are a little larger than what they
//! hold, so that no rounding hides a face. Distances to faces are the caller's, in f64.

use crate::error::{Result, push, reserve};
use crate::math::Vec3;
use crate::shape::mesh::tree::{Bounds, Tree};
use std::mem::size_of;
use wide::f32x8;

/// Boxes in a node.
const WIDE: usize = 8;
/// Each half of the tree's splits holds half of the faces, so that it has at most 31 levels, and
/// each level leaves seven nodes for later.
const STACK: usize = 32 * (WIDE - 1) + 1;
/// By how much of its size a box is larger than what it holds: what the rounding of a place in
/// its frame may come to.
const LARGER: f64 = 1e-6;
/// … and by what of its square a distance may be too great, by that and its own rounding.
const SLACK: f64 = 1.0 + 5e-6;
/// Farther than this, in sizes of the body, f32 does not tell faces apart.
const FARTHEST: f64 = 1e12;

/// Bytes of the tree for each face: a leaf has four at least, and what stands above comes to a
/// seventh; and of what building it takes besides.
pub(super) const BYTES: u64 = (size_of::<Node>() * 2 / 7) as u64;
pub(super) const BUILDING: u64 = 64;

pub(super) struct Boxes {
    middle: Vec3,
    scale: f64,
    nodes: Vec<Node>,
    faces: u32,
}

struct Node {
    center: [f32x8; 3],
    axes: [[f32x8; 3]; 3],
    half: [f32x8; 3],
    /// Nodes; faces, where it is a leaf.
    below: [u32; WIDE],
    /// A bit for each of those.
    some: u32,
    leaf: bool,
}

/// A box in the frame of the tree.
#[derive(Clone, Copy)]
struct Turned {
    center: [f32; 3],
    axes: [[f32; 3]; 3],
    half: [f32; 3],
}

const STRAIGHT: [Vec3; 3] =
    [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];

/// Whether boxes are turned, or lie along the axes as their faces do.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Lie {
    Turned,
    Straight,
}

/// Faces by their corners: what the tree is made of.
struct Maker<'a, F> {
    tree: &'a Tree,
    corners: F,
    lie: Lie,
    boxes: Boxes,
}

impl Boxes {
    /// Over `faces` faces, one at least, with these corners, which are finite.
    pub(super) fn new(faces: u32, corners: impl Fn(u32) -> [Vec3; 3], lie: Lie) -> Result<Boxes> {
        let tree = Tree::new(0..faces, |i| Bounds::of(&corners(i)))?;
        let all = tree.nodes().first().map_or(Bounds::empty(), |n| n.bounds);
        let size = 0.5 * (all.hi - all.lo).amax();
        let boxes = Boxes {
            middle: all.lo + (all.hi - all.lo) * 0.5,
            scale: 1.0 / size.clamp(1e-100, 1e100),
            nodes: reserve("the surface tree", faces as usize / 5)?,
            faces,
        };
        let mut maker = Maker { tree: &tree, corners, lie, boxes };
        // Levels of halves by three; those that are left over at the root, where they cost least.
        let last = |&at: &usize| Some(tree.nodes().get(at)?.halves(at)?[1]);
        let levels = std::iter::successors(Some(0), last).count() - 1;
        maker.grow(0, 2 << ((levels + 2) % 3))?;
        let mut boxes = maker.boxes;
        boxes.nodes.shrink_to_fit();
        Ok(boxes)
    }

    pub(super) fn bytes(&self) -> u64 {
        (self.nodes.len() * size_of::<Node>()) as u64
    }

    /// The face whose square of the distance, by `measure`, is the least and below `reach2`, with
    /// what `measure` says of it.
    pub(super) fn nearest<T>(
        &self,
        p: &Vec3,
        reach2: f64,
        measure: impl Fn(u32) -> (f64, T),
    ) -> Option<(u32, f64, T)> {
        let mut best = None;
        let mut least = reach2;
        let at = (p - self.middle) * self.scale;
        let size = at.amax();
        if size > FARTHEST {
            for face in 0..self.faces {
                let (d2, what) = measure(face);
                if d2 < least {
                    (least, best) = (d2, Some((face, d2, what)));
                }
            }
            return best;
        }
        let place = at.map(|x| x as f32);
        // How far the rounded place is from the place.
        let off = (at - place.map(f64::from)).norm() + 1e-15 * (1.0 + size);
        let limit = |least: f64| {
            let far =
                if least < 1e150 { (least.sqrt() * self.scale).min(1e18) + off } else { 1e18 };
            (far * far * SLACK) as f32
        };
        let place: [f32x8; 3] = [place.x, place.y, place.z].map(f32x8::splat);
        let mut within = limit(least);
        let mut stack = [(0.0f32, 0u32); STACK];
        let mut top = 1;
        while top > 0 {
            top -= 1;
            let (near, node) = stack[top];
            if near > within {
                continue;
            }
            let Some(node) = self.nodes.get(node as usize) else { continue };
            let near = node.distances2(&place);
            let mut some = near.simd_le(f32x8::splat(within)).to_bitmask() & node.some;
            let near = near.to_array();
            // In order: the farthest lies lowest.
            let first = top;
            while some != 0 {
                let lane = some.trailing_zeros() as usize;
                some &= some - 1;
                let mut hole = top;
                top += 1;
                while hole > first && stack[hole - 1].0 < near[lane] {
                    stack[hole] = stack[hole - 1];
                    hole -= 1;
                }
                stack[hole] = (near[lane], node.below[lane]);
            }
            if node.leaf {
                while top > first {
                    top -= 1;
                    let (near, face) = stack[top];
                    if near > within {
                        top = first;
                        break;
                    }
                    let (d2, what) = measure(face);
                    if d2 < least {
                        (least, best) = (d2, Some((face, d2, what)));
                        within = limit(least);
                    }
                }
            }
        }
        best
    }
}

impl Node {
    fn empty(leaf: bool) -> Node {
        let nothing = [f32x8::ZERO; 3];
        Node { center: nothing, axes: [nothing; 3], half: nothing, below: [0; 8], some: 0, leaf }
    }

    fn of(all: &[(u32, Turned)], leaf: bool) -> Node {
        let mut node = Node::empty(leaf);
        let lanes = |f: &dyn Fn(&Turned) -> f32| {
            f32x8::new(std::array::from_fn(|l| all.get(l).map_or(0.0, |(_, t)| f(t))))
        };
        for a in 0..3 {
            node.center[a] = lanes(&|t| t.center[a]);
            node.half[a] = lanes(&|t| t.half[a]);
            for b in 0..3 {
                node.axes[a][b] = lanes(&|t| t.axes[a][b]);
            }
        }
        for (l, (below, _)) in all.iter().enumerate().take(WIDE) {
            node.below[l] = *below;
            node.some |= 1 << l;
        }
        node
    }

    /// Squares of the distances to the boxes.
    #[inline(always)]
    fn distances2(&self, p: &[f32x8; 3]) -> f32x8 {
        let c = &self.center;
        let (x, y, z) = (p[0] - c[0], p[1] - c[1], p[2] - c[2]);
        let mut sum = f32x8::ZERO;
        for (axis, half) in self.axes.iter().zip(&self.half) {
            let along = x * axis[0] + y * axis[1] + z * axis[2];
            let out = (along.abs() - *half).fast_max(f32x8::ZERO);
            sum += out * out;
        }
        sum
    }
}

impl<F: Fn(u32) -> [Vec3; 3]> Maker<'_, F> {
    /// The node of `wide` parts of a node of the tree, and the sum of its faces' normals, as long
    /// as they are large.
    fn grow(&mut self, at: usize, wide: usize) -> Result<(u32, Vec3)> {
        let place = self.boxes.nodes.len();
        let tree = self.tree;
        let Some(node) = tree.nodes().get(at) else { return Ok((0, Vec3::zeros())) };
        push("the surface tree", &mut self.boxes.nodes, Node::empty(true))?;
        let mut found = Vec::with_capacity(WIDE);
        let mut sum = Vec3::zeros();
        let leaf = node.halves(at).is_none();
        if leaf {
            for &face in tree.items(node) {
                let corners = (self.corners)(face);
                sum += (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
                found.push((face, self.turned(&[face], self.face_axes(&corners))));
            }
        } else {
            for part in self.split(at, wide) {
                let (node, normal) = self.grow(part, WIDE)?;
                sum += normal;
                let Some(of) = tree.nodes().get(part) else { continue };
                let axes = self.axes(&normal, &of.bounds);
                found.push((node, self.turned(tree.items(of), axes)));
            }
        }
        self.boxes.nodes[place] = Node::of(&found, leaf);
        Ok((place as u32, sum))
    }

    /// Halves the node, and the largest of its parts, until there are so many.
    fn split(&self, at: usize, wide: usize) -> Vec<usize> {
        let nodes = self.tree.nodes();
        let mut parts = vec![at];
        while parts.len() < wide {
            let large = |n: usize| match nodes.get(n) {
                Some(node) if node.halves(n).is_some() => self.tree.items(node).len(),
                _ => 0,
            };
            let largest = (0..parts.len()).max_by_key(|&i| large(parts[i])).unwrap_or(0);
            let halves = nodes.get(parts[largest]).and_then(|n| n.halves(parts[largest]));
            let Some([a, b]) = halves else { break };
            parts[largest] = a;
            parts.push(b);
        }
        parts
    }

    /// Axes of a box about faces of this normal: it lies flat on them.
    fn axes(&self, normal: &Vec3, bounds: &Bounds) -> [Vec3; 3] {
        if self.lie == Lie::Straight {
            return STRAIGHT;
        }
        let extent = bounds.hi - bounds.lo;
        let Some(normal) = unit(normal) else { return STRAIGHT };
        let flat = |a: usize| STRAIGHT[a] - normal * normal[a];
        let longest = (0..3)
            .map(|a| flat(a) * extent[a])
            .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        along(&normal, longest)
    }

    fn face_axes(&self, [a, b, c]: &[Vec3; 3]) -> [Vec3; 3] {
        if self.lie == Lie::Straight {
            return STRAIGHT;
        }
        let edges = [b - a, c - b, a - c];
        let longest =
            edges.into_iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        unit(&edges[0].cross(&edges[1])).map_or(STRAIGHT, |normal| along(&normal, longest))
    }

    /// The box with these axes about faces.
    fn turned(&self, faces: &[u32], axes: [Vec3; 3]) -> Turned {
        let axes = axes.map(|a| a.map(|x| x as f32));
        let wide = axes.map(|a| a.map(f64::from));
        let (mut low, mut high) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
        let mut size = 0.0f64;
        for corner in faces.iter().flat_map(|&f| (self.corners)(f)) {
            let at = (corner - self.boxes.middle) * self.boxes.scale;
            let along = Vec3::from(wide.map(|a| a.dot(&at)));
            (low, high) = (low.inf(&along), high.sup(&along));
            size = size.max(at.amax());
        }
        let middle = (low + high) * 0.5;
        let center =
            (wide[0] * middle.x + wide[1] * middle.y + wide[2] * middle.z).map(|x| x as f32);
        let from = center.map(f64::from);
        // The axes are rounded, so that the rounded centre is not quite in the middle.
        let half = Vec3::from([0, 1, 2].map(|k| {
            let at = wide[k].dot(&from);
            (at - low[k]).max(high[k] - at).max(0.0)
        }));
        let half = half.add_scalar(LARGER * half.sum() + 1e-15 * size);
        let half = half.map(|x| (x * (1.0 + 1e-7)) as f32);
        Turned { center: center.into(), axes: axes.map(Into::into), half: half.into() }
    }
}

fn unit(v: &Vec3) -> Option<Vec3> {
    let size = v.amax();
    (size > 1e-150).then(|| (v / size).normalize())
}

/// Axes with this normal and `long` as near as may be to it.
fn along(normal: &Vec3, long: Option<Vec3>) -> [Vec3; 3] {
    match long.and_then(|l| unit(&(l - normal * normal.dot(&l)))) {
        Some(long) => [*normal, long, normal.cross(&long)],
        None => STRAIGHT,
    }
}

#[cfg(test)]
#[path = "boxes_tests.rs"]
mod tests;
