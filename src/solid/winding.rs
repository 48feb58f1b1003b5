//! The generalised winding number, hierarchical (Barill et al. 2018): the
//! inside of meshes that are open, cross themselves or are soups.
//!
//! Faces are sorted along a Morton curve and gathered in a binary tree. A node
//! that is far away (farther than [`BETA`] times its radius) answers by its
//! expansion: the dipole N·d/|d|³ and the next term tr M/|d|³ − 3 dᵀMd/|d|⁵
//! with N = Σ aₙ, M = Σ aₙ ⊗ (c − p̃). A near leaf sums its solid angles.

use crate::math::Vec3;
use crate::shape::Mesh;

/// A node is far when its distance exceeds this many of its radii.
const BETA: f64 = 2.3;
/// Most faces of a leaf.
const LEAF: usize = 4;
/// Bits of the Morton code per axis.
const BITS: u32 = 16;

/// A tree over the faces of a mesh that answers the winding number of a point.
#[derive(Debug, Clone)]
pub struct Winding {
    /// Corners, in the tree's order.
    faces: Vec<[Vec3; 3]>,
    /// Depth first: the left child of a node is the next one.
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    /// Area-weighted centre p̃ of the faces.
    center: Vec3,
    /// Square of the distance beyond which the expansion answers.
    far2: f64,
    /// Σ a n.
    dipole: Vec3,
    /// tr M.
    trace: f64,
    /// Symmetric part of M, as xx, yy, zz, xy + yx, xz + zx, yz + zy.
    second: [f64; 6],
    /// First face and one past the last.
    first: u32,
    last: u32,
    /// The first node that is not below this one.
    skip: u32,
}

impl Winding {
    /// Builds the tree.
    pub fn new(mesh: &Mesh) -> Winding {
        let mut lo = Vec3::repeat(f64::MAX);
        let mut hi = Vec3::repeat(-f64::MAX);
        for v in &mesh.vertices {
            lo = lo.inf(v);
            hi = hi.sup(v);
        }
        let edge = (hi - lo).max();
        let cells = f64::from(1u32 << BITS);
        let scale = if edge > 0.0 { cells / edge } else { 0.0 };
        let mut order: Vec<(u64, u32)> = (0..mesh.faces.len())
            .map(|i| {
                let [a, b, c] = mesh.corners(i);
                let q = ((a + b + c) / 3.0 - lo) * scale;
                let code =
                    (0..3).fold(0, |m, k| m | spread(q[k].clamp(0.0, cells - 1.0) as u64) << k);
                (code, i as u32)
            })
            .collect();
        order.sort_unstable();
        let faces: Vec<[Vec3; 3]> = order.iter().map(|&(_, i)| mesh.corners(i as usize)).collect();
        let mut tree = Winding { faces, nodes: Vec::with_capacity(order.len()) };
        if !order.is_empty() {
            tree.gather(&order, 0, order.len());
        }
        tree
    }

    /// The node of faces `first..last`, made after the nodes below it are known;
    /// returns its area and bounding box.
    fn gather(&mut self, order: &[(u64, u32)], first: usize, last: usize) -> (f64, Vec3, Vec3) {
        let at = self.nodes.len();
        self.nodes.push(Node {
            center: Vec3::zeros(),
            far2: 0.0,
            dipole: Vec3::zeros(),
            trace: 0.0,
            second: [0.0; 6],
            first: first as u32,
            last: last as u32,
            skip: 0,
        });
        let mut area = 0.0;
        let mut weighted = Vec3::zeros();
        let mut dipole = Vec3::zeros();
        let mut parts: [(Vec3, Vec3, nalgebra::Matrix3<f64>); LEAF] = Default::default();
        let mut count = 0;
        let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(-f64::MAX));
        if last - first <= LEAF {
            for f in &self.faces[first..last] {
                let n = (f[1] - f[0]).cross(&(f[2] - f[0])) * 0.5;
                let c = (f[0] + f[1] + f[2]) / 3.0;
                let a = n.norm();
                area += a;
                weighted += c * a;
                dipole += n;
                parts[count] = (c, n, nalgebra::Matrix3::zeros());
                count += 1;
                for v in f {
                    lo = lo.inf(v);
                    hi = hi.sup(v);
                }
            }
        } else {
            let middle = split(order, first, last);
            for (from, to) in [(first, middle), (middle, last)] {
                let child = self.nodes.len();
                let (a, l, h) = self.gather(order, from, to);
                let node = &self.nodes[child];
                area += a;
                weighted += node.center * a;
                dipole += node.dipole;
                let [xx, yy, zz, xy, xz, yz] = node.second;
                let m = nalgebra::Matrix3::new(xx, xy, xz, 0.0, yy, yz, 0.0, 0.0, zz);
                parts[count] = (node.center, node.dipole, m);
                count += 1;
                lo = lo.inf(&l);
                hi = hi.sup(&h);
            }
        }
        let center = if area > 0.0 { weighted / area } else { (lo + hi) * 0.5 };
        let mut m = nalgebra::Matrix3::<f64>::zeros();
        for (c, n, own) in &parts[..count] {
            m += own + n * (c - center).transpose();
        }
        let radius2 = (center - lo).sup(&(hi - center)).norm_squared();
        let skip = self.nodes.len() as u32;
        let node = &mut self.nodes[at];
        node.center = center;
        // Never so near that the expansion divides by an underflow.
        node.far2 = (BETA * BETA * radius2).max(1e-40);
        node.dipole = dipole;
        node.trace = m.trace();
        node.second = [
            m[(0, 0)],
            m[(1, 1)],
            m[(2, 2)],
            m[(0, 1)] + m[(1, 0)],
            m[(0, 2)] + m[(2, 0)],
            m[(1, 2)] + m[(2, 1)],
        ];
        node.skip = skip;
        (area, lo, hi)
    }

    /// The winding number of `p`: 1 inside, 0 outside of a closed mesh; above ½ counts as inside.
    pub fn at(&self, p: &Vec3) -> f64 {
        let mut sum = 0.0;
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let d = node.center - p;
            let d2 = d.norm_squared();
            if d2 > node.far2 {
                let [xx, yy, zz, xy, xz, yz] = node.second;
                let quadratic = d.x * (xx * d.x + xy * d.y + xz * d.z)
                    + d.y * (yy * d.y + yz * d.z)
                    + zz * d.z * d.z;
                sum += (node.dipole.dot(&d) + node.trace - 3.0 * quadratic / d2) / (d2 * d2.sqrt());
                at = node.skip as usize;
            } else if node.last - node.first <= LEAF as u32 {
                let faces = self.faces.get(node.first as usize..node.last as usize);
                for f in faces.unwrap_or(&[]) {
                    sum += solid_angle(f, p);
                }
                at = node.skip as usize;
            } else {
                at += 1;
            }
        }
        sum / (4.0 * std::f64::consts::PI)
    }

    /// The same by the exact sum over all faces: slow, what the tree is held against.
    pub fn exact(&self, p: &Vec3) -> f64 {
        self.faces.iter().map(|f| solid_angle(f, p)).sum::<f64>() / (4.0 * std::f64::consts::PI)
    }
}

/// Spreads the low 16 bits of `v` to every third bit.
fn spread(v: u64) -> u64 {
    let mut v = v & 0xffff;
    v = (v | v << 16) & 0x0000_ff00_00ff;
    v = (v | v << 8) & 0x00f0_0f00_f00f;
    v = (v | v << 4) & 0x0c30_c30c_30c3;
    (v | v << 2) & 0x2492_4924_9249
}

/// Where the highest bit that differs changes in the sorted codes; the middle when none does.
fn split(order: &[(u64, u32)], first: usize, last: usize) -> usize {
    let (a, b) = (order[first].0, order[last - 1].0);
    if a == b {
        return first + (last - first) / 2;
    }
    let bit = 1u64 << (63 - (a ^ b).leading_zeros());
    first + order[first..last].partition_point(|o| o.0 & bit == 0)
}

/// Signed solid angle of a triangle from `p` (van Oosterom and Strackee 1983).
pub fn solid_angle(t: &[Vec3; 3], p: &Vec3) -> f64 {
    let [a, b, c] = t.map(|v| v - p);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let numerator = a.dot(&b.cross(&c));
    let denominator = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    2.0 * numerator.atan2(denominator)
}
