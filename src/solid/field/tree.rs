//! A tree of boxes over the triangles, in units of the shortest cell edge from the
//! grid's origin.

use crate::error::{Result, reserve};
use crate::math::Vec3;
use crate::shape::Mesh;
use crate::solid::grid::Grid;
use crate::solid::triangle;

/// Most triangles of a leaf.
const LEAF: usize = 4;

/// Points of one evaluation.
pub(super) const LANES: usize = 8;
/// A coordinate of each of some points.
pub(super) type Lanes = [f64; LANES];

/// A triangle made ready for many distances.
#[derive(Debug, Clone, Copy)]
pub(super) struct Facet {
    pub corners: [Vec3; 3],
    /// Unit normal, or zero for one too thin to have any.
    normal: Vec3,
    /// Inverse squared length of the edges from each corner to the next; 0 for none.
    inverse: [f64; 3],
}

impl Facet {
    fn new(corners: [Vec3; 3]) -> Facet {
        let edges = edges(&corners);
        let longest2 = edges.iter().map(|e| e.norm_squared()).fold(0.0, f64::max);
        let cross = edges[0].cross(&edges[1]);
        let thin = cross.norm_squared() <= 1e-24 * longest2 * longest2;
        let inverse = edges.map(|e| {
            let l = e.norm_squared();
            if l > 1e-280 { 1.0 / l } else { 0.0 }
        });
        let normal = if thin { Vec3::zeros() } else { triangle::normal(&corners) };
        Facet { corners, normal, inverse }
    }

    /// Squared distances of eight points: over the face where a point lies above it, else to the
    /// nearest edge (the same as [`triangle::closest`], without branches).
    pub(super) fn squared(&self, x: &Lanes, y: &Lanes, z: &Lanes) -> Lanes {
        let mut best = [f64::MAX; LANES];
        let mut above = [f64::MAX; LANES];
        let n = &self.normal;
        for ((v, e), &inverse) in self.corners.iter().zip(edges(&self.corners)).zip(&self.inverse) {
            let m = n.cross(&e);
            for k in 0..LANES {
                let (dx, dy, dz) = (x[k] - v.x, y[k] - v.y, z[k] - v.z);
                let along = (dx * e.x + dy * e.y + dz * e.z) * inverse;
                let t = along.clamp(0.0, 1.0);
                let (rx, ry, rz) = (dx - t * e.x, dy - t * e.y, dz - t * e.z);
                let d = rx * rx + ry * ry + rz * rz;
                best[k] = if d < best[k] { d } else { best[k] };
                let side = dx * m.x + dy * m.y + dz * m.z;
                above[k] = if side < above[k] { side } else { above[k] };
            }
        }
        if *n != Vec3::zeros() {
            let v = &self.corners[0];
            for k in 0..LANES {
                let h = (x[k] - v.x) * n.x + (y[k] - v.y) * n.y + (z[k] - v.z) * n.z;
                best[k] = if above[k] >= 0.0 { h * h } else { best[k] };
            }
        }
        best
    }
}

fn edges(c: &[Vec3; 3]) -> [Vec3; 3] {
    [c[1] - c[0], c[2] - c[1], c[0] - c[2]]
}

/// A box of triangles.
#[derive(Debug, Clone, Copy)]
struct Node {
    lo: Vec3,
    hi: Vec3,
    /// Of a leaf: its first triangle. Otherwise the second child; the first is the next node.
    at: u32,
    /// Triangles of a leaf, 0 for others.
    count: u32,
}

impl Node {
    fn closest(&self, p: &Vec3) -> Vec3 {
        p.sup(&self.lo).inf(&self.hi)
    }
}

/// The tree.
pub(super) struct Tree {
    /// In the tree's order.
    pub facets: Vec<Facet>,
    nodes: Vec<Node>,
}

/// What a tree over so many faces takes, with what it takes to build it.
pub(super) fn bytes(faces: usize) -> u64 {
    (size_of::<Facet>() + size_of::<Node>() + size_of::<(Vec3, u32)>()) as u64 * faces as u64
}

impl Tree {
    pub(super) fn new(mesh: &Mesh, grid: &Grid, unit: f64) -> Result<Tree> {
        let n = mesh.faces.len();
        let local = |v: Vec3| (v - grid.origin) / unit;
        let mut order: Vec<(Vec3, u32)> = reserve("the tree of triangles", n)?;
        order.extend((0..n).map(|i| {
            let [a, b, c] = mesh.corners(i).map(local);
            ((a.inf(&b).inf(&c) + a.sup(&b).sup(&c)) * 0.5, i as u32)
        }));
        let mut tree = Tree {
            facets: reserve("the tree of triangles", n)?,
            nodes: reserve("the tree of triangles", n)?,
        };
        if n > 0 {
            tree.split(&mut order, &|i| mesh.corners(i as usize).map(local));
        }
        Ok(tree)
    }

    /// The node over `order` and all below it; medians along the longest axis.
    fn split(&mut self, order: &mut [(Vec3, u32)], corners: &impl Fn(u32) -> [Vec3; 3]) {
        let at = self.nodes.len();
        let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(-f64::MAX));
        if order.len() <= LEAF {
            let first = self.facets.len() as u32;
            for (_, i) in order.iter() {
                let t = corners(*i);
                lo = t.iter().fold(lo, |m, v| m.inf(v));
                hi = t.iter().fold(hi, |m, v| m.sup(v));
                self.facets.push(Facet::new(t));
            }
            self.nodes.push(Node { lo, hi, at: first, count: order.len() as u32 });
            return;
        }
        for (c, _) in order.iter() {
            lo = lo.inf(c);
            hi = hi.sup(c);
        }
        let axis = (hi - lo).imax();
        let middle = order.len() / 2;
        order.select_nth_unstable_by(middle, |a, b| {
            a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1))
        });
        self.nodes.push(Node { lo, hi, at: 0, count: 0 });
        let (left, right) = order.split_at_mut(middle);
        self.split(left, corners);
        let second = self.nodes.len();
        self.split(right, corners);
        let (a, b) = (self.nodes[at + 1], self.nodes[second]);
        self.nodes[at] =
            Node { lo: a.lo.inf(&b.lo), hi: a.hi.sup(&b.hi), at: second as u32, count: 0 };
    }

    /// The nearest point of the surface to `p`, given that one is nearer than `reach`.
    pub(super) fn nearest(&self, p: &Vec3, reach: f64) -> Vec3 {
        let mut best = (reach * reach, *p);
        let to = |i: usize| (self.nodes[i].closest(p) - p).norm_squared();
        let mut stack = [(0.0, 0u32); 64];
        stack[0].0 = to(0);
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (d, i) = stack[height];
            if d >= best.0 {
                continue;
            }
            let node = &self.nodes[i as usize];
            if node.count > 0 {
                for f in &self.facets[node.at as usize..][..node.count as usize] {
                    let q = triangle::closest(&f.corners, p);
                    let d = (q - p).norm_squared();
                    if d < best.0 {
                        best = (d, q);
                    }
                }
                continue;
            }
            let (a, b) = (i + 1, node.at);
            let (da, db) = (to(a as usize), to(b as usize));
            let (near, far) = if da <= db { ((da, a), (db, b)) } else { ((db, b), (da, a)) };
            // Medians halve: the height stays far below 64.
            stack[height] = far;
            stack[height + 1] = near;
            height += 2;
        }
        best.1
    }

    /// Calls `leaf` for each triangle in boxes that `open` says yes to; `open` sees the nearest
    /// point of a box to `p`.
    pub(super) fn gather(
        &self,
        p: &Vec3,
        open: impl Fn(&Vec3) -> bool,
        mut leaf: impl FnMut(u32, &Facet),
    ) {
        let mut stack = [0u32; 64];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let i = stack[height];
            let node = &self.nodes[i as usize];
            if !open(&node.closest(p)) {
                continue;
            }
            if node.count > 0 {
                for t in node.at..node.at + node.count {
                    leaf(t, &self.facets[t as usize]);
                }
            } else {
                stack[height] = node.at;
                stack[height + 1] = i + 1;
                height += 2;
            }
        }
    }
}
