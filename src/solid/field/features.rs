//! The faces, edges and corners of a mesh, with their regions; neighbours in space lie next
//! to each other in memory.

use super::clusters::{Cluster, TOGETHER, clusters};
use super::corners::corners;
use super::regions::{Corner, Edge, Face, double, rounding};
use super::sides::{Side, Sides};
use super::space::longest;
use crate::error::{Result, filled, fits, reserve};
use crate::math::Vec3;
use crate::shape::Mesh;
use crate::solid::grid::Grid;
use crate::solid::triangle;

pub(super) const WHAT: &str = "the features of the mesh";
/// Edge of the blocks along whose curve the vertices are sorted, in cells.
const BLOCK: f64 = 2.0;

/// All features of a mesh, in units of the shortest cell edge from the grid's origin.
pub(super) struct Features {
    pub faces: Vec<Face>,
    pub edges: Vec<Edge>,
    pub corners: Vec<Corner>,
    pub clusters: Vec<Cluster>,
    /// The vertices, and the vertices of the face of the same index.
    points: Vec<Vec3>,
    list: Vec<Triangle>,
    /// What they take, with what it took to find them.
    pub bytes: u64,
}

/// What the features take, with what it takes to find them.
fn bytes(faces: usize, vertices: usize, edges: usize) -> u64 {
    let vertex = size_of::<Vec3>() + 3 * size_of::<u64>() + size_of::<Corner>();
    let edge = size_of::<Edge>() + size_of::<End>() + 4 * size_of::<u32>();
    let face = size_of::<Face>()
        + size_of::<Normal>()
        + 3 * size_of::<Side>()
        + size_of::<Triangle>()
        + size_of::<u64>();
    let clusters = (vertices / TOGETHER + 1) * size_of::<Cluster>();
    (faces * face + vertices * vertex + edges * edge + clusters) as u64
}

/// A face by its vertices in order of place.
pub(super) type Triangle = [u32; 3];

/// An edge: its ends and unit vector from the first to the second.
pub(super) struct End {
    pub ends: [u32; 2],
    pub along: Vec3,
}

impl Features {
    /// Of a mesh, if they take no more than `room` bytes.
    pub(super) fn new(mesh: &Mesh, grid: &Grid, unit: f64, room: u64) -> Result<Features> {
        let n = mesh.faces.len();
        let held = |edges: usize| {
            let bytes = bytes(n, mesh.vertices.len(), edges);
            fits(format_args!("{WHAT}, of {n} faces,"), bytes, room)?;
            Ok(bytes)
        };
        // Before the edges are counted.
        held(0)?;
        let (points, list) = by_place(mesh, grid, unit)?;
        let round = rounding(longest(grid, unit));
        let (mut faces, mut normals) = (reserve(WHAT, n)?, reserve(WHAT, n)?);
        for f in &list {
            let t = f.map(|v| points[v as usize]);
            let (face, normal) = face(&t, f64::from(round));
            faces.push(face);
            normals.push(normal);
        }
        let sides = Sides::new(&list, points.len())?;
        let count = sides.groups().count();
        let bytes = held(count)?;
        let (mut edges, mut ends) = (reserve(WHAT, count)?, reserve(WHAT, count)?);
        let mut named: Vec<[u32; 2]> = reserve(WHAT, count)?;
        for (first, group) in sides.groups() {
            let names = [first, group[0].other];
            let [a, b] = names.map(|v| points[v as usize]);
            let way = b - a;
            let length = way.norm();
            // A length of none is a corner.
            if length <= 1e-9 {
                continue;
            }
            let along = way * (1.0 / length);
            ends.push(End { ends: names, along });
            let away = |s: &Side| normals[s.face()].away(&along, s.turned());
            let away = [away(&group[0]), group.get(1).and_then(away)];
            if let Some(beyond) = beyond(&away) {
                edges.push(Edge::new(beyond, a, along, length));
                named.push(names);
            }
        }
        let (corners, at) = corners(&points, &ends)?;
        let clusters = clusters(&points, &list, &named, &at, round)?;
        Ok(Features { faces, edges, corners, clusters, points, list, bytes })
    }

    /// The point of face `i` that is nearest to `c`.
    pub(super) fn on_face(&self, i: u32, c: &Vec3) -> Vec3 {
        triangle::closest(&self.list[i as usize].map(|v| self.points[v as usize]), c)
    }

    /// The point of edge `i` that is nearest to `c`.
    pub(super) fn on_edge(&self, i: u32, c: &Vec3) -> Vec3 {
        let e = &self.edges[i as usize];
        let (start, along) = (double(&e.start), double(&e.along()));
        start + along * along.dot(&(c - start)).clamp(0.0, f64::from(e.length))
    }

    /// Corner `i`.
    pub(super) fn on_corner(&self, i: u32) -> Vec3 {
        double(&self.corners[i as usize].at)
    }
}

/// The vertices along a space-filling curve (Morton's), and the faces by their first vertex.
fn by_place(mesh: &Mesh, grid: &Grid, unit: f64) -> Result<(Vec<Vec3>, Vec<Triangle>)> {
    let n = mesh.vertices.len();
    let local = |v: u32| (mesh.vertices[v as usize] - grid.origin) / unit;
    let mut order = reserve(WHAT, n)?;
    order.extend((0..n as u32).map(|v| {
        let p = local(v);
        let place = [0, 1, 2].map(|a| spread((p[a] / BLOCK).clamp(0.0, 1023.0) as u32) << a);
        u64::from(place[0] | place[1] | place[2]) << 32 | u64::from(v)
    }));
    order.sort_unstable();
    let (mut points, mut rank) = (reserve(WHAT, n)?, filled(WHAT, n, 0u32)?);
    for (k, &v) in order.iter().enumerate() {
        points.push(local(v as u32));
        rank[v as u32 as usize] = k as u32;
    }
    let mut order = reserve(WHAT, mesh.faces.len())?;
    order.extend(mesh.faces.iter().enumerate().map(|(i, f)| {
        let first = f.iter().map(|&v| rank[v as usize]).fold(u32::MAX, u32::min);
        u64::from(first) << 32 | i as u64
    }));
    order.sort_unstable();
    let mut list = reserve(WHAT, mesh.faces.len())?;
    let face = |&i: &u64| mesh.faces[i as u32 as usize].map(|v| rank[v as usize]);
    list.extend(order.iter().map(face));
    Ok((points, list))
}

/// The lowest ten bits, three apart.
fn spread(x: u32) -> u32 {
    let x = (x | x << 16) & 0x0300_00FF;
    let x = (x | x << 8) & 0x0300_F00F;
    let x = (x | x << 4) & 0x030C_30C3;
    (x | x << 2) & 0x0924_9249
}

/// A face's normal, none of one without area; and whether a corner is sharp.
#[derive(Debug, Clone, Copy)]
struct Normal {
    n: Option<Vec3>,
    sharp: bool,
}

impl Normal {
    /// The unit vector in the face away from a side, which goes along, or against that; and
    /// whether a corner of the face is sharp.
    fn away(&self, along: &Vec3, against: bool) -> Option<(Vec3, bool)> {
        let n = self.n?;
        Some((if against { n.cross(along) } else { along.cross(&n) }, self.sharp))
    }
}

/// Normals beyond two faces at an edge, and the one between them, which holds what they both
/// hold. None when the faces are flat there: their prisms meet, unless one is narrowed.
fn beyond(away: &[Option<(Vec3, bool)>; 2]) -> Option<[Vec3; 3]> {
    let one = |n: &Option<(Vec3, bool)>| n.map_or(Vec3::zeros(), |n| n.0);
    let mut front = Vec3::zeros();
    if let [Some((a, sharp)), Some((b, other))] = away {
        let sum = a + b;
        let length = sum.norm();
        if length >= 1e-6 {
            front = sum / length;
        } else if !sharp && !other {
            return None;
        }
    }
    Some([one(&away[0]), one(&away[1]), front])
}

/// How far a prism may reach beyond a corner of its face by what rounding allows at the sides.
const OVERRUN: f64 = 0.005;

/// A face and its normal. One without area has no prism (its edges stand for it)
/// and no sides. The prism of one with a sharp corner, which it would overrun, ends within the
/// face: what lies over the rim is left to the edges.
fn face(t: &[Vec3; 3], round: f64) -> (Face, Normal) {
    let edges = [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let squared = edges.map(|e| e.norm_squared());
    let longest2 = squared.into_iter().fold(0.0, f64::max);
    let cross = edges[0].cross(&edges[1]);
    let area2 = cross.norm_squared();
    if longest2 < 1e-200 || area2 <= 1e-24 * longest2 * longest2 {
        return (Face::none(), Normal { n: None, sharp: true });
    }
    let n = cross * (1.0 / area2.sqrt());
    let [a, b, c]: [Vec3; 3] =
        std::array::from_fn(|k| n.cross(&edges[k]) * (1.0 / squared[k].sqrt()));
    // The half angle at a corner, from the normals of its sides: |a + c| = 2 sin(θ/2).
    let sharpest2 = 0.5 * (1.0 + a.dot(&c).min(a.dot(&b)).min(b.dot(&c)));
    let sharp = round * round > OVERRUN * OVERRUN * sharpest2;
    let within = if sharp { 2.0 * round } else { 0.0 };
    let at = |n: &Vec3, v: &Vec3| (*n, v + n * within);
    let face = Face::new([at(&a, &t[0]), at(&b, &t[1]), at(&c, &t[2]), (n, t[0])]);
    (face, Normal { n: Some(n), sharp })
}
