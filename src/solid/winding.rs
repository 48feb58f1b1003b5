//! The generalised winding number, hierarchical (Barill et al. 2018): the
//! inside of meshes that are open, cross themselves or are soups.
//!
//! Faces are sorted along a Morton curve and gathered in a binary tree. A node
//! that is far away (farther than `BETA` times its radius) answers by its
//! expansion about its centre p̃, with y = x − p̃ and d = p̃ − q:
//! N·d/|d|³ − 3 dᵀMd/|d|⁵ + 15 S:ddd/|d|⁷, where N = ∫n dA, M = ∫n⊗y dA and
//! S = ½∫n⊗y⊗y dA, symmetric and without traces (these give no field, for 1/|d|
//! is harmonic). A near leaf sums its solid angles.

pub use crate::math::solid_angle;

use crate::error::{Error, Result, fits, reserve};
use crate::math::{Vec3, half_solid_angle};
use crate::shape::Mesh;
use std::mem::size_of;

/// A node is far when its distance exceeds this many of its radii. 2.3 keeps the error of the
/// winding number within 3e-3 on the meshes tried (2.0: 5e-3, 2.6: 1.3e-3 at twice the time).
const BETA: f64 = 2.3;
/// Most faces of a leaf.
const LEAF: usize = 4;
/// What is reserved.
const WHAT: &str = "the winding number's tree";
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
    /// N, M and S of the expansion.
    field: Expansion,
    /// First face and one past the last.
    first: u32,
    last: u32,
    /// The first node that is not below this one.
    skip: u32,
}

/// The field of faces far away.
#[derive(Debug, Clone, Copy, Default)]
struct Expansion {
    /// N.
    dipole: Vec3,
    /// M as xx, yy, zz, xy, xz, yz.
    second: [f64; 6],
    /// S as xxx, yyy, zzz, xxy, xxz, xyy, yyz, xzz, yzz, xyz.
    third: [f64; 10],
}

impl Expansion {
    /// The expansion of one face about its centroid.
    fn of_face(f: &[Vec3; 3], centroid: &Vec3, normal: &Vec3) -> Self {
        let mut spread = [0.0; 6];
        for v in f {
            add(&mut spread, &product(&(v - centroid), &(v - centroid)), 1.0 / 24.0);
        }
        Expansion { dipole: *normal, second: [0.0; 6], third: times(&spread, normal) }
    }

    /// Adds the expansion of a part whose centre lies `s` beyond this one's.
    fn gather(&mut self, part: &Expansion, s: &Vec3) {
        let shift = product(&part.dipole, s);
        let mut half = part.second;
        add(&mut half, &shift, 0.5);
        add(&mut self.third, &times(&half, s), 1.0);
        add(&mut self.third, &part.third, 1.0);
        add(&mut self.second, &shift, 1.0);
        add(&mut self.second, &part.second, 1.0);
        self.dipole += part.dipole;
    }

    /// Takes the traces out.
    fn traceless(&mut self) {
        let [xx, yy, zz, ..] = self.second;
        let t = (xx + yy + zz) / 3.0;
        for v in &mut self.second[..3] {
            *v -= t;
        }
        let [xxx, yyy, zzz, xxy, xxz, xyy, yyz, xzz, yzz, _] = self.third;
        let (x, y, z) = ((xxx + xyy + xzz) / 5.0, (yyy + xxy + yzz) / 5.0, (zzz + xxz + yyz) / 5.0);
        let trace = [3.0 * x, 3.0 * y, 3.0 * z, y, z, x, z, x, y, 0.0];
        add(&mut self.third, &trace, -1.0);
    }

    /// The field at distance `d` (from the point to the centre) times 4π.
    fn at(&self, d: &Vec3, d2: f64) -> f64 {
        let [xx, yy, zz, xy, xz, yz] = self.second;
        let (x, y, z) = (d.x, d.y, d.z);
        let (x2, y2, z2) = (x * x, y * y, z * z);
        let quadratic = xx * x2 + yy * y2 + zz * z2 + 2.0 * (x * (xy * y + xz * z) + yz * y * z);
        let [xxx, yyy, zzz, xxy, xxz, xyy, yyz, xzz, yzz, xyz] = self.third;
        let cubic = x * (xxx * x2 + 3.0 * (xyy * y2 + xzz * z2) + 6.0 * xyz * y * z)
            + y * (yyy * y2 + 3.0 * (xxy * x2 + yzz * z2))
            + z * (zzz * z2 + 3.0 * (xxz * x2 + yyz * y2));
        let inverse = 1.0 / d2;
        (self.dipole.dot(d) + inverse * (15.0 * inverse * cubic - 3.0 * quadratic))
            * inverse
            * inverse.sqrt()
    }
}

/// The symmetric part of a ⊗ b.
fn product(a: &Vec3, b: &Vec3) -> [f64; 6] {
    [
        a.x * b.x,
        a.y * b.y,
        a.z * b.z,
        0.5 * (a.x * b.y + a.y * b.x),
        0.5 * (a.x * b.z + a.z * b.x),
        0.5 * (a.y * b.z + a.z * b.y),
    ]
}

/// The symmetric part of m ⊗ a.
fn times(&[xx, yy, zz, xy, xz, yz]: &[f64; 6], a: &Vec3) -> [f64; 10] {
    [
        xx * a.x,
        yy * a.y,
        zz * a.z,
        (xx * a.y + 2.0 * xy * a.x) / 3.0,
        (xx * a.z + 2.0 * xz * a.x) / 3.0,
        (yy * a.x + 2.0 * xy * a.y) / 3.0,
        (yy * a.z + 2.0 * yz * a.y) / 3.0,
        (zz * a.x + 2.0 * xz * a.z) / 3.0,
        (zz * a.y + 2.0 * yz * a.z) / 3.0,
        (xy * a.z + xz * a.y + yz * a.x) / 3.0,
    ]
}

/// `sum += term * factor`.
fn add<const N: usize>(sum: &mut [f64; N], term: &[f64; N], factor: f64) {
    for (s, t) in sum.iter_mut().zip(term) {
        *s += t * factor;
    }
}

/// The sum of the solid angles of a few faces. Half of each is the argument of a complex
/// number; the product of these has the sum as its argument, up to turns, which are counted:
/// one arc tangent instead of one for each face.
fn solid_angles(faces: &[[Vec3; 3]], p: &Vec3) -> f64 {
    let (mut re, mut im, mut turns) = (1.0, 0.0, 0.0);
    for f in faces {
        let (a, b) = half_solid_angle(f, p);
        // At a corner of the face, or along a face without area, nothing is seen of it.
        if a == 0.0 && b == 0.0 {
            continue;
        }
        let product = (re * a - im * b, re * b + im * a);
        if im >= 0.0 && b >= 0.0 && product.1 < 0.0 {
            turns += 1.0;
        } else if im < 0.0 && b < 0.0 && (product.1 > 0.0 || product.1 == 0.0 && product.0 < 0.0) {
            turns -= 1.0;
        }
        (re, im) = product;
    }
    2.0 * (im.atan2(re) + 2.0 * std::f64::consts::PI * turns)
}

impl Winding {
    /// Most bytes that the tree over so many faces takes, while it is built as well. A node
    /// with more than [`LEAF`] faces has two below it, so there are fewer nodes than twice the
    /// faces; hardly ever more than faces.
    pub(super) fn most_bytes(faces: usize) -> u64 {
        let per = size_of::<[Vec3; 3]>() + size_of::<Node>() + size_of::<(u64, u32)>();
        (faces as u64).saturating_mul(per as u64)
    }

    /// Bytes that it holds.
    pub(super) fn bytes(&self) -> u64 {
        let nodes = self.nodes.capacity() * size_of::<Node>();
        (self.faces.capacity() * size_of::<[Vec3; 3]>() + nodes) as u64
    }

    /// The tree, refused where it may take more than `limit` bytes.
    pub(super) fn within(mesh: &Mesh, limit: u64) -> Result<Winding> {
        let faces = mesh.faces.len();
        fits(format_args!("{WHAT} over {faces} faces"), Winding::most_bytes(faces), limit)?;
        Winding::new(mesh)
    }

    /// Builds the tree.
    pub fn new(mesh: &Mesh) -> Result<Winding> {
        let mut lo = Vec3::repeat(f64::MAX);
        let mut hi = Vec3::repeat(-f64::MAX);
        for v in &mesh.vertices {
            lo = lo.inf(v);
            hi = hi.sup(v);
        }
        let edge = (hi - lo).max();
        let cells = f64::from(1u32 << BITS);
        let scale = if edge > 0.0 { cells / edge } else { 0.0 };
        let n = mesh.faces.len();
        let mut order: Vec<(u64, u32)> = reserve(WHAT, n)?;
        order.extend((0..n).map(|i| {
            let [a, b, c] = mesh.corners(i);
            let q = ((a + b + c) / 3.0 - lo) * scale;
            let code = (0..3).fold(0, |m, k| m | spread(q[k].clamp(0.0, cells - 1.0) as u64) << k);
            (code, i as u32)
        }));
        order.sort_unstable();
        let mut faces: Vec<[Vec3; 3]> = reserve(WHAT, n)?;
        faces.extend(order.iter().map(|&(_, i)| mesh.corners(i as usize)));
        let mut tree = Winding { faces, nodes: reserve(WHAT, n)? };
        if !order.is_empty() {
            tree.gather(&order, 0, order.len())?;
        }
        tree.nodes.shrink_to_fit();
        Ok(tree)
    }

    /// The node of faces `first..last`, made after the nodes below it are known;
    /// returns its area and bounding box.
    fn gather(
        &mut self,
        order: &[(u64, u32)],
        first: usize,
        last: usize,
    ) -> Result<(f64, Vec3, Vec3)> {
        let at = self.nodes.len();
        self.nodes.try_reserve(1).map_err(|_| {
            Error::OutOfMemory(format!("no memory for {WHAT}: {at} nodes are too many"))
        })?;
        self.nodes.push(Node {
            center: Vec3::zeros(),
            far2: 0.0,
            field: Expansion::default(),
            first: first as u32,
            last: last as u32,
            skip: 0,
        });
        let mut area = 0.0;
        let mut weighted = Vec3::zeros();
        let mut parts: [(Vec3, Expansion); LEAF] = Default::default();
        let mut count = 0;
        let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(-f64::MAX));
        if last - first <= LEAF {
            for f in &self.faces[first..last] {
                let n = (f[1] - f[0]).cross(&(f[2] - f[0])) * 0.5;
                let c = (f[0] + f[1] + f[2]) / 3.0;
                let a = n.norm();
                area += a;
                weighted += c * a;
                parts[count] = (c, Expansion::of_face(f, &c, &n));
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
                let (a, l, h) = self.gather(order, from, to)?;
                let node = &self.nodes[child];
                area += a;
                weighted += node.center * a;
                parts[count] = (node.center, node.field);
                count += 1;
                lo = lo.inf(&l);
                hi = hi.sup(&h);
            }
        }
        let center = if area > 0.0 { weighted / area } else { (lo + hi) * 0.5 };
        let mut field = Expansion::default();
        for (c, part) in &parts[..count] {
            field.gather(part, &(c - center));
        }
        field.traceless();
        let radius2 = (center - lo).sup(&(hi - center)).norm_squared();
        let skip = self.nodes.len() as u32;
        let node = &mut self.nodes[at];
        node.center = center;
        // Never so near that the expansion divides by an underflow.
        node.far2 = (BETA * BETA * radius2).max(1e-40);
        node.field = field;
        node.skip = skip;
        Ok((area, lo, hi))
    }

    /// The winding number of `p`: 1 inside, 0 outside of a closed mesh; above ½ counts as inside.
    pub fn at(&self, p: &Vec3) -> f64 {
        let mut sum = 0.0;
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let d = node.center - p;
            let d2 = d.norm_squared();
            if d2 > node.far2 {
                sum += node.field.at(&d, d2);
                at = node.skip as usize;
            } else if node.last - node.first <= LEAF as u32 {
                let faces = self.faces.get(node.first as usize..node.last as usize);
                sum += solid_angles(faces.unwrap_or(&[]), p);
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn one_arc_tangent_gives_the_sum(
            numbers in prop::collection::vec(-1.0f64..1.0, 9 * LEAF),
            all_one_way in any::<bool>(),
            scale in prop::sample::select(vec![1.0, 1e-6, 1e-12]),
        ) {
            let corners: Vec<Vec3> = numbers.chunks(3).map(Vec3::from_column_slice).collect();
            let p = Vec3::zeros();
            let mut faces: Vec<[Vec3; 3]> =
                corners.chunks(3).map(|c| [c[0], c[1], c[2]].map(|v| v * scale)).collect();
            for f in &mut faces {
                if all_one_way && solid_angle(f, &p) < 0.0 {
                    f.swap(1, 2);
                }
            }
            let sum: f64 = faces.iter().map(|f| solid_angle(f, &p)).sum();
            prop_assert!((solid_angles(&faces, &p) - sum).abs() < 1e-9, "{}", sum);
            // From a corner nothing is seen of the face.
            let others: f64 = faces.iter().map(|f| solid_angle(f, &faces[0][1])).sum();
            prop_assert!((solid_angles(&faces, &faces[0][1]) - others).abs() < 1e-9);
        }
    }
}
