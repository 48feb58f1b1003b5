//! The faces, edges and corners of a mesh, with their regions; neighbours in space lie next
//! to each other in memory.

use super::clusters::{Cluster, clusters};
use super::regions::{Corner, Edge, Face, double, rounding};
use super::space::longest;
use crate::error::{Result, filled, reserve};
use crate::math::Vec3;
use crate::shape::Mesh;
use crate::solid::grid::Grid;
use crate::solid::triangle;

pub(super) const WHAT: &str = "the features of the mesh";
/// Edge of the blocks along whose curve the vertices are sorted, in cells.
const BLOCK: f64 = 2.0;

/// Half-spaces of a corner's region.
const AWAY: usize = 4;

/// All features of a mesh, in units of the shortest cell edge from the grid's origin.
pub(super) struct Features {
    pub faces: Vec<Face>,
    pub edges: Vec<Edge>,
    pub corners: Vec<Corner>,
    /// Corners of the face of the same index.
    triangles: Vec<[Vec3; 3]>,
    pub clusters: Vec<Cluster>,
}

/// What the features of so many faces take, with what it takes to find them.
pub(super) fn bytes(faces: usize) -> u64 {
    let vertex =
        size_of::<Vec3>() + 3 * size_of::<u64>() + size_of::<Corner>() + size_of::<Cluster>();
    let edge = size_of::<Edge>() + size_of::<End>() + 3 * size_of::<Vec3>();
    let face = size_of::<Face>() + size_of::<Triangle>() + 4 * size_of::<[Vec3; 3]>();
    // Soups have three vertices and three edges a face.
    (faces * (3 * (vertex + edge + size_of::<Side>()) + face)) as u64
}

/// A face by its vertices in order of place.
pub(super) type Triangle = [u32; 3];

/// A side of a face: its ends, the lesser first, and three times the face's number and 0, 1, 2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    ends: [u32; 2],
    of: u32,
}

/// An edge: its ends and unit vector from the first to the second.
struct End {
    ends: [u32; 2],
    along: Vec3,
}

impl Features {
    pub(super) fn new(mesh: &Mesh, grid: &Grid, unit: f64) -> Result<Features> {
        let (points, list) = by_place(mesh, grid, unit)?;
        let n = list.len();
        let round = rounding(longest(grid, unit));
        let (mut faces, mut triangles) = (reserve(WHAT, n)?, reserve(WHAT, n)?);
        let mut away: Vec<Ways> = reserve(WHAT, n)?;
        let mut sides: Vec<Side> = reserve(WHAT, n.saturating_mul(3))?;
        for (i, f) in list.iter().enumerate() {
            let t = f.map(|v| points[v as usize]);
            let (face, ways) = face(&t, f64::from(round));
            for k in 0..3 {
                let (a, b) = (f[k], f[(k + 1) % 3]);
                if a != b {
                    sides.push(Side { ends: [a.min(b), a.max(b)], of: (3 * i + k) as u32 });
                }
            }
            faces.push(face);
            triangles.push(t);
            away.push(ways);
        }
        sides.sort_unstable();
        let count = sides.chunk_by(|a, b| a.ends == b.ends).count();
        let (mut edges, mut ends) = (reserve(WHAT, count)?, reserve(WHAT, count)?);
        let mut named: Vec<[u32; 2]> = reserve(WHAT, count)?;
        for group in sides.chunk_by(|a, b| a.ends == b.ends) {
            let [a, b] = group[0].ends.map(|v| points[v as usize]);
            let length = (b - a).norm();
            // A length of none is a corner.
            if length > 1e-9 {
                let along = (b - a) / length;
                ends.push(End { ends: group[0].ends, along });
                let way = |s: &Side| away[s.of as usize / 3].of(s.of as usize % 3);
                let ways = [way(&group[0]), group.get(1).and_then(way)];
                if let Some(beyond) = beyond(&ways) {
                    edges.push(Edge::new(beyond, a, along, length));
                    named.push(group[0].ends);
                }
            }
        }
        let (corners, at) = corners(&points, &ends)?;
        let clusters = clusters(&points, &list, &named, &at, round)?;
        Ok(Features { faces, edges, corners, triangles, clusters })
    }

    /// The point of face `i` that is nearest to `c`.
    pub(super) fn on_face(&self, i: u32, c: &Vec3) -> Vec3 {
        triangle::closest(&self.triangles[i as usize], c)
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

/// The unit vectors in a face away from its sides, or none; and whether a corner is sharp.
#[derive(Debug, Clone, Copy)]
struct Ways {
    away: Option<[Vec3; 3]>,
    sharp: bool,
}

impl Ways {
    fn of(&self, side: usize) -> Option<(Vec3, bool)> {
        self.away.map(|away| (away[side], self.sharp))
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

/// A face and the ways from its sides. One without area has no prism (its edges stand for it)
/// and no sides. The prism of one with a sharp corner, which it would overrun, ends within the
/// face: what lies over the rim is left to the edges.
fn face(t: &[Vec3; 3], round: f64) -> (Face, Ways) {
    let edges = [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let longest2 = edges.iter().map(|e| e.norm_squared()).fold(0.0, f64::max);
    let cross = edges[0].cross(&edges[1]);
    if longest2 < 1e-200 || cross.norm_squared() <= 1e-24 * longest2 * longest2 {
        return (Face::none(), Ways { away: None, sharp: true });
    }
    let n = cross.normalize();
    let [a, b, c] = edges.map(|e| n.cross(&e).normalize());
    // The half angle at a corner, from the normals of its sides: |a + c| = 2 sin(θ/2).
    let sharpest = (a + c).norm().min((a + b).norm()).min((b + c).norm()) * 0.5;
    let sharp = round > OVERRUN * sharpest;
    let within = if sharp { 2.0 * round } else { 0.0 };
    let at = |n: &Vec3, v: &Vec3| (*n, v + n * within);
    let face = Face::new([at(&a, &t[0]), at(&b, &t[1]), at(&c, &t[2]), (n, t[0])]);
    (face, Ways { away: Some([-a, -b, -c]), sharp })
}

/// The corners, each with some of the edges that meet there; and their vertices.
fn corners(points: &[Vec3], ends: &[End]) -> Result<(Vec<Corner>, Vec<u32>)> {
    // The edges of each vertex, one vertex after the other.
    let mut starts = filled(WHAT, points.len() + 1, 0u32)?;
    for e in ends {
        for v in e.ends {
            starts[v as usize + 1] += 1;
        }
    }
    for v in 1..starts.len() {
        starts[v] += starts[v - 1];
    }
    let mut next = filled(WHAT, points.len(), 0u32)?;
    next.copy_from_slice(&starts[..points.len()]);
    let mut list = filled(WHAT, 2 * ends.len(), Vec3::zeros())?;
    for e in ends {
        for (v, way) in [(e.ends[0], e.along), (e.ends[1], -e.along)] {
            list[next[v as usize] as usize] = way;
            next[v as usize] += 1;
        }
    }
    let mut corners = reserve(WHAT, points.len())?;
    let mut vertices = reserve(WHAT, points.len())?;
    for (v, (at, range)) in points.iter().zip(starts.windows(2)).enumerate() {
        let edges = &list[range[0] as usize..range[1] as usize];
        if edges.is_empty() {
            continue;
        }
        let some = (AWAY - 1).min(edges.len());
        // Evenly among them, in the order of the other ends.
        let mut away: [Vec3; AWAY] =
            std::array::from_fn(|k| -edges[k.min(some - 1) * edges.len() / some]);
        // And what follows from all: behind along their sum.
        let sum = edges.iter().fold(Vec3::zeros(), |s, e| s + e);
        if sum.norm() > 1e-6 {
            away[AWAY - 1] = -sum.normalize();
        }
        corners.push(Corner::new(away, *at));
        vertices.push(v as u32);
    }
    Ok((corners, vertices))
}
