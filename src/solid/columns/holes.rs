//! The border of an open mesh, and cones that close it.
//!
//! The winding number of an open mesh is the crossing number of the mesh with
//! its holes closed, less the winding number of what closes them. A cone over
//! each connected part of the border closes it, whatever the border's form:
//! every vertex has as many edges coming in as going out.

use crate::error::{Result, filled, fits, reserve};
use crate::math::Vec3;
use crate::shape::Mesh;
use crate::solid::winding::Winding;
use std::f64::consts::PI;
use std::mem::size_of;

/// The vertices at which some directed edge is run through more often than the other way round:
/// the vertices that follow it in its faces are not those that come before it. Both are compared
/// by sums of 64 bits, which agree by chance once in 10¹⁹ vertices.
pub(in crate::solid) fn loose(mesh: &Mesh) -> Result<Vec<bool>> {
    let mut sums = filled("vertices of the border", mesh.vertices.len(), 0u64)?;
    for &[a, b, c] in &mesh.faces {
        let (p, q, r) = (mixed(a), mixed(b), mixed(c));
        for (v, after, before) in [(a, q, r), (b, r, p), (c, p, q)] {
            let sum = &mut sums[v as usize];
            *sum = sum.wrapping_add(after).wrapping_sub(before);
        }
    }
    let mut loose = reserve("vertices of the border", sums.len())?;
    loose.extend(sums.iter().map(|&s| s != 0));
    Ok(loose)
}

/// The bits of a number mixed (Steele, Lea and Flood 2014).
fn mixed(v: u32) -> u64 {
    let x = (u64::from(v) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

/// Directed edges that are run through more often than the other way round, once for each time
/// too many. None: the mesh is closed, its winding number an integer, and the signed crossings
/// of a column give it.
pub(in crate::solid) fn border(mesh: &Mesh) -> Result<Vec<[u32; 2]>> {
    let loose = loose(mesh)?;
    let is = |v: u32| loose[v as usize];
    let count = |f: &[u32; 3]| {
        let [a, b, c] = [is(f[0]), is(f[1]), is(f[2])].map(usize::from);
        a * b + b * c + c * a
    };
    let mut edges: Vec<(u32, u32, bool)> = reserve("edges", mesh.faces.iter().map(count).sum())?;
    for f in mesh.faces.iter().filter(|f| count(f) > 0) {
        for (a, b) in [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])] {
            if a != b && is(a) && is(b) {
                edges.push((a.min(b), a.max(b), a < b));
            }
        }
    }
    edges.sort_unstable();
    let excess = |same: &[(u32, u32, bool)]| {
        let up = same.iter().filter(|e| e.2).count();
        (up, same.len() - up)
    };
    let alike = |x: &(u32, u32, bool), y: &(u32, u32, bool)| (x.0, x.1) == (y.0, y.1);
    let counts = edges.chunk_by(alike).map(excess).map(|(up, down)| up.abs_diff(down));
    let mut out = reserve(WHAT, counts.sum())?;
    for same in edges.chunk_by(alike) {
        let (up, down) = excess(same);
        if let Some(&(a, b, _)) = same.first() {
            let edge = if up > down { [a, b] } else { [b, a] };
            out.extend(std::iter::repeat_n(edge, up.abs_diff(down)));
        }
    }
    Ok(out)
}

/// What closes an open mesh.
pub(in crate::solid) struct Cones {
    /// The mesh and its cones.
    pub closed: Mesh,
    winding: Winding,
    /// The cones, and above them groups of cones: depth first, the left one of two that make a
    /// group comes next.
    groups: Vec<Group>,
}

/// Cones over parts of the border: they lie within a ball.
#[derive(Debug, Clone, Copy)]
struct Group {
    center: Vec3,
    radius: f64,
    area: f64,
    /// The first group that is not within this one.
    skip: u32,
}

const WHAT: &str = "the borders of the mesh";

/// The first of what is joined with `i`.
fn find(root: &mut [usize], mut i: usize) -> usize {
    while root[i] != i {
        root[i] = root[root[i]];
        i = root[i];
    }
    i
}

impl Cones {
    /// Most bytes that closing a border of so many edges takes. It has no more vertices, nor
    /// parts, than edges, and fewer groups than twice the parts; what is taken for each of its
    /// vertices while it is closed is counted as well.
    fn most_bytes(mesh: &Mesh, border: usize) -> u64 {
        let each = 24 + 12 + 8 + 8 + 32 + 8 + 3 * size_of::<Group>() as u64;
        mesh.bytes() + border as u64 * each + Winding::most_bytes(border)
    }

    /// Closes `mesh` at its `border`; refused where that may take more than `limit` bytes.
    pub(in crate::solid) fn new(mesh: &Mesh, border: &[[u32; 2]], limit: u64) -> Result<Cones> {
        let (faces, n) = (mesh.faces.len(), border.len());
        let most = Cones::most_bytes(mesh, n);
        fits(format_args!("closing {n} open edges of {faces} faces"), most, limit)?;
        let mut ids: Vec<u32> = reserve(WHAT, border.len().saturating_mul(2))?;
        ids.extend(border.iter().flatten());
        ids.sort_unstable();
        ids.dedup();
        let place = |v: u32| ids.partition_point(|&i| i < v);
        let mut root: Vec<usize> = reserve(WHAT, ids.len())?;
        root.extend(0..ids.len());
        for &[a, b] in border {
            let (a, b) = (find(&mut root, place(a)), find(&mut root, place(b)));
            root[a.max(b)] = a.min(b);
        }
        // The apex is the mean of the part's vertices.
        let mut sums = filled(WHAT, ids.len(), (Vec3::zeros(), 0.0f64))?;
        for (i, &v) in ids.iter().enumerate() {
            let sum = &mut sums[find(&mut root, i)];
            sum.0 += mesh.vertices[v as usize];
            sum.1 += 1.0;
        }
        let mut closed = Mesh {
            vertices: reserve("vertices", mesh.vertices.len() + ids.len())?,
            faces: reserve("faces", mesh.faces.len() + border.len())?,
            clean: false,
        };
        closed.vertices.extend_from_slice(&mesh.vertices);
        let mut parts = reserve(WHAT, ids.len())?;
        let mut part_of = filled(WHAT, ids.len(), usize::MAX)?;
        for (i, (sum, count)) in sums.iter().enumerate() {
            if *count > 0.0 {
                part_of[i] = parts.len();
                let apex = sum / *count;
                closed.vertices.push(apex);
                parts.push(Group { center: apex, radius: 0.0, area: 0.0, skip: 0 });
            }
        }
        for &[a, b] in border {
            let k = part_of[find(&mut root, place(a))];
            let (p, q) = (mesh.vertices[a as usize], mesh.vertices[b as usize]);
            let part = &mut parts[k];
            part.radius = part.radius.max((p - part.center).norm()).max((q - part.center).norm());
            part.area += 0.5 * (p - part.center).cross(&(q - part.center)).norm();
            closed.faces.push([b, a, (mesh.vertices.len() + k) as u32]);
        }
        // The tree wants the cones alone; the mesh's own faces come after.
        let winding = Winding::new(&closed)?;
        closed.faces.extend_from_slice(&mesh.faces);
        let mut groups = reserve(WHAT, 2 * parts.len())?;
        if !parts.is_empty() {
            gather(&mut parts, &mut groups);
        }
        Ok(Cones { closed, winding, groups })
    }

    pub(in crate::solid) fn bytes(&self) -> u64 {
        let groups = (self.groups.capacity() * size_of::<Group>()) as u64;
        self.closed.bytes() + groups + self.winding.bytes()
    }

    /// Winding number of the cones about `p`.
    pub(in crate::solid) fn at(&self, p: &Vec3) -> f64 {
        self.winding.at(p)
    }

    /// Whether the winding number of the cones stays below ½ in size all along the column
    /// through `p` from `from` to `to`: seen from a distance D, a surface of area A within a
    /// ball of radius R covers at most A / (D − R)² of the sphere of directions. Groups that are
    /// near for their size are taken apart.
    pub(super) fn small(&self, p: &Vec3, axis: usize, from: f64, to: f64) -> bool {
        self.look(p, axis, from, to).0
    }

    /// The same, and how many groups were looked at.
    fn look(&self, p: &Vec3, axis: usize, from: f64, to: f64) -> (bool, usize) {
        let (mut sum, mut at, mut looks) = (0.0, 0, 0);
        while let Some(g) = self.groups.get(at) {
            looks += 1;
            let mut w = g.center - p;
            w[axis] = g.center[axis] - g.center[axis].clamp(from, to);
            let gap = w.norm() - g.radius;
            let alone = g.skip as usize == at + 1;
            let share = if gap > 0.0 { g.area / (4.0 * PI * gap * gap) } else { 1.0 };
            if alone || (gap > 3.0 * g.radius && share < 0.01) {
                sum += share;
                if sum >= 0.5 {
                    return (false, looks);
                }
                at = g.skip as usize;
            } else {
                at += 1;
            }
        }
        (true, looks)
    }
}

/// Appends `parts` and the groups that they make, halved at the median of the longest axis.
fn gather(parts: &mut [Group], out: &mut Vec<Group>) {
    let at = out.len();
    if let [one] = parts {
        out.push(Group { skip: at as u32 + 1, ..*one });
        return;
    }
    let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    let mut area = 0.0;
    for p in parts.iter() {
        let r = Vec3::repeat(p.radius);
        (lo, hi) = (lo.inf(&(p.center - r)), hi.sup(&(p.center + r)));
        area += p.area;
    }
    let center = (lo + hi) * 0.5;
    let reach = parts.iter().map(|p| (p.center - center).norm() + p.radius);
    let radius = reach.fold(0.0, f64::max);
    out.push(Group { center, radius, area, skip: 0 });
    let axis = (hi - lo).imax();
    let middle = parts.len() / 2;
    parts.select_nth_unstable_by(middle, |x, y| {
        // All that a part is, so that the order does not hang on how they came.
        let key = |g: &Group| [g.center[axis], g.center.x, g.center.y, g.center.z, g.area];
        let (x, y) = (key(x), key(y));
        let mut pairs = x.iter().zip(&y).map(|(x, y)| x.total_cmp(y));
        pairs.find(|o| o.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    let (left, right) = parts.split_at_mut(middle);
    gather(left, out);
    gather(right, out);
    out[at].skip = out.len() as u32;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small faces in a plane, each with a border of its own.
    fn faces(n: usize) -> Mesh {
        let mut mesh = Mesh::default();
        let h = 1.0 / n as f64;
        for j in 0..n {
            for i in 0..n {
                let (x, y) = (i as f64 * h, j as f64 * h);
                let first = mesh.vertices.len() as u32;
                for (a, b) in [(0.0, 0.0), (0.1, 0.0), (0.0, 0.1)] {
                    mesh.vertices.push(Vec3::new(x + a * h, y + b * h, 0.0));
                }
                mesh.faces.push([first, first + 1, first + 2]);
            }
        }
        mesh
    }

    #[test]
    fn what_closing_takes_is_known_before() {
        let mesh = faces(30);
        let border = border(&mesh).unwrap();
        let most = Cones::most_bytes(&mesh, border.len());
        let held = Cones::new(&mesh, &border, most).unwrap().bytes();
        assert!(held < most && most < 2 * held, "{held} {most}");
        let text = Cones::new(&mesh, &border, most - 1).err().unwrap().to_string();
        assert!(text.contains(&format!("{most} bytes, more than the {}", most - 1)), "{text}");
    }

    #[test]
    fn groups_never_say_more_than_all_parts_and_look_at_few() {
        let mut mean = Vec::new();
        for n in [12, 120] {
            let mesh = faces(n);
            let border = border(&mesh).unwrap();
            let cones = Cones::new(&mesh, &border, u64::MAX).unwrap();
            let alone: Vec<Group> = cones
                .groups
                .iter()
                .enumerate()
                .filter(|(i, g)| g.skip as usize == i + 1)
                .map(|(_, g)| *g)
                .collect();
            assert_eq!(alone.len(), n * n);
            let (mut looks, mut agree, mut all) = (0, 0, 0);
            for k in 0..400 {
                let t = f64::from(k);
                let p = Vec3::new((t * 0.377).fract(), (t * 0.613).fract(), 0.0);
                let axis = k as usize % 3;
                let z = 0.6 * ((t * 0.77).fract() - 0.5);
                let (from, to) = if axis == 2 { (0.01, 0.01 + z.abs()) } else { (0.2, 0.8) };
                let p = if axis == 2 { p } else { p + Vec3::z() * z };
                let share = |g: &Group| {
                    let mut w = g.center - p;
                    w[axis] = g.center[axis] - g.center[axis].clamp(from, to);
                    let gap = w.norm() - g.radius;
                    if gap > 0.0 { g.area / (4.0 * PI * gap * gap) } else { 1.0 }
                };
                let shares: Vec<f64> = alone.iter().map(share).collect();
                let plain = shares.iter().all(|&s| s <= 0.5) && shares.iter().sum::<f64>() < 0.5;
                let (small, count) = cones.look(&p, axis, from, to);
                assert!(plain || !small);
                looks += count;
                agree += usize::from(plain == small);
                all += 1;
            }
            assert!(agree * 100 >= all * 97, "{agree} of {all}");
            mean.push(looks / all);
        }
        // A hundred times as many holes.
        assert!(mean[1] < 5 * mean[0].max(40), "{mean:?}");
    }
}
