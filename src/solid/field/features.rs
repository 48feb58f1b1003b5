//! The faces, edges and corners of a mesh, each with the region of space from which it
//! can be nearest, in units of the shortest cell edge from the grid's origin.
//!
//! A point whose nearest point lies within a face is above it (in the prism over it); one
//! whose nearest lies on an edge is between the edge's ends and beyond the side of every
//! face there; one whose nearest is a corner is behind it along every edge there. That
//! holds for any set of triangles, closed or not. Half-spaces left out only make a region
//! larger. (Mauch 2003 scans these regions; here they prune candidates.)

use crate::error::{Result, filled, reserve};
use crate::math::Vec3;
use crate::shape::Mesh;
use crate::solid::grid::Grid;
use crate::solid::triangle;

/// Points of one evaluation.
pub(super) const LANES: usize = 8;
/// One number for each of some points.
pub(super) type Lanes = [f32; LANES];
/// The corners of a box, x fastest: what two places along each axis make.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Points {
    /// x and y of the four points of each z.
    xy: [[f32; 4]; 2],
    z: [f32; 2],
}

impl Points {
    /// From the two places along x, y and z.
    pub(super) fn new(at: [[f64; 2]; 3]) -> Points {
        let [x, y, z] = at.map(|a| a.map(|v| v as f32));
        Points { xy: [[x[0], x[1], x[0], x[1]], [y[0], y[0], y[1], y[1]]], z }
    }
}

/// A half-space `n·x + o ≥ 0`, n of unit length, with `|n₀| + |n₁| + |n₂|`.
type Plane = [f32; 5];
/// A half-space that holds everything.
const ALL: Plane = [0.0, 0.0, 0.0, 1e9, 0.0];
/// Half-spaces of a corner's region.
const AWAY: usize = 6;
/// No distance.
pub(super) const FAR: f32 = 1e15;
/// Points this far out of a region count as in it (in cells): more than the rounding of
/// coordinates up to 4096 in f32, less than anyone sees.
pub(super) const SLACK: f32 = 1e-3;

/// What can be nearest. All of it is written lane by lane, for the compiler's vectors.
pub(super) trait Feature {
    /// Of each point, how deep any point of a brick of this half extent about it may lie in the
    /// region's worst half-space (less than 0: the brick misses the region); and a squared
    /// distance that this feature is not nearer than.
    fn region(&self, x: &Points, half: f32) -> (Lanes, Lanes);
    /// Bits of the points about which such a brick may touch the region.
    #[inline(always)]
    fn touches(&self, x: &Points, half: f32) -> u8 {
        bits(&self.region(x, half).0)
    }
    /// Squared distances from the plane, line or point that the feature lies on.
    fn bound(&self, x: &Points) -> Lanes;
    /// Lowers `best`, squared distances, where this feature is nearer.
    fn nearer(&self, x: &Points, best: &mut Lanes);
}

/// Heights over a plane; the part of x and y is shared.
#[inline(always)]
fn heights(p: &Plane, x: &Points) -> Lanes {
    let (mut h, mut flat) = ([0.0; LANES], [0.0; 4]);
    for j in 0..4 {
        flat[j] = p[0] * x.xy[0][j] + p[1] * x.xy[1][j];
    }
    let (low, high) = (p[2] * x.z[0] + p[3], p[2] * x.z[1] + p[3]);
    for j in 0..4 {
        h[j] = flat[j] + low;
    }
    for j in 0..4 {
        h[4 + j] = flat[j] + high;
    }
    h
}

/// Lane by lane, the lesser of `a` and `b + c`.
#[inline(always)]
fn lower(a: &mut Lanes, b: &Lanes, c: f32) {
    for k in 0..LANES {
        a[k] = least(a[k], b[k] + c);
    }
}

/// As `f32::min` without its care for NaN, which there is none of.
#[inline(always)]
pub(super) fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Bits of the lanes that are not negative.
#[inline(always)]
pub(super) fn bits(lanes: &Lanes) -> u8 {
    let mut bits = 0;
    for k in 0..LANES {
        bits |= u8::from(lanes[k] >= 0.0) << k;
    }
    bits
}

/// A face: height over its plane and the prism's sides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face {
    plane: Plane,
    sides: [Plane; 3],
}

impl Feature for Face {
    #[inline(always)]
    fn region(&self, x: &Points, half: f32) -> (Lanes, Lanes) {
        let (mut touch, mut out) = ([FAR; LANES], [0.0; LANES]);
        for side in &self.sides {
            let h = heights(side, x);
            lower(&mut touch, &h, side[4] * half + SLACK);
            lower(&mut out, &h, 0.0);
        }
        let mut score = heights(&self.plane, x);
        for k in 0..LANES {
            score[k] = score[k] * score[k] + out[k] * out[k];
        }
        (touch, score)
    }

    #[inline(always)]
    fn bound(&self, x: &Points) -> Lanes {
        let mut h = heights(&self.plane, x);
        for k in 0..LANES {
            h[k] *= h[k];
        }
        h
    }

    #[inline(always)]
    fn nearer(&self, x: &Points, best: &mut Lanes) {
        let mut depth = [FAR; LANES];
        for side in &self.sides {
            lower(&mut depth, &heights(side, x), 0.0);
        }
        let h = heights(&self.plane, x);
        for k in 0..LANES {
            let d = if depth[k] >= -SLACK { h[k] * h[k] } else { FAR };
            best[k] = least(d, best[k]);
        }
    }
}

/// An edge: its start, direction and length, and the sides of two faces there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    start: [f32; 3],
    along: [f32; 3],
    length: f32,
    /// Sum of the absolute parts of `along`.
    spread: f32,
    /// Beyond the sides of two faces, and what follows from both: in front of the edge.
    beyond: [Plane; 3],
}

impl Edge {
    /// Places along the edge, and the squared distance from the line, or from the segment.
    #[inline(always)]
    fn foot(&self, x: &Points, segment: bool) -> (Lanes, Lanes) {
        let (s, e) = (&self.start, &self.along);
        let (mut along, mut squared) = ([0.0; LANES], [0.0; LANES]);
        let (mut dx, mut dy, mut flat) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for j in 0..4 {
            dx[j] = x.xy[0][j] - s[0];
            dy[j] = x.xy[1][j] - s[1];
            flat[j] = dx[j] * e[0] + dy[j] * e[1];
        }
        for k in 0..LANES {
            let dz = x.z[k / 4] - s[2];
            let t = flat[k % 4] + dz * e[2];
            let f = if segment { least(if t > 0.0 { t } else { 0.0 }, self.length) } else { t };
            let (rx, ry, rz) = (dx[k % 4] - f * e[0], dy[k % 4] - f * e[1], dz - f * e[2]);
            along[k] = t;
            squared[k] = rx * rx + ry * ry + rz * rz;
        }
        (along, squared)
    }
}

impl Feature for Edge {
    #[inline(always)]
    fn region(&self, x: &Points, half: f32) -> (Lanes, Lanes) {
        let mut touch = [FAR; LANES];
        for side in &self.beyond {
            lower(&mut touch, &heights(side, x), side[4] * half + SLACK);
        }
        let ends = self.spread * half + SLACK;
        let (t, mut score) = self.foot(x, false);
        for k in 0..LANES {
            let within = least(t[k], self.length - t[k]);
            touch[k] = least(touch[k], within + ends);
            let out = least(within, 0.0);
            score[k] += out * out;
        }
        (touch, score)
    }

    #[inline(always)]
    fn bound(&self, x: &Points) -> Lanes {
        self.foot(x, false).1
    }

    #[inline(always)]
    fn nearer(&self, x: &Points, best: &mut Lanes) {
        let (_, squared) = self.foot(x, true);
        lower(best, &squared, 0.0);
    }
}

/// A corner, and half-spaces behind it along edges from it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    at: [f32; 3],
    away: [Plane; AWAY],
}

impl Feature for Corner {
    #[inline(always)]
    fn region(&self, x: &Points, half: f32) -> (Lanes, Lanes) {
        let mut touch = [FAR; LANES];
        for n in &self.away {
            lower(&mut touch, &heights(n, x), n[4] * half + SLACK);
        }
        let mut score = [FAR; LANES];
        nearer_point(&self.at, x, &mut score);
        (touch, score)
    }

    #[inline(always)]
    fn bound(&self, x: &Points) -> Lanes {
        let mut squared = [FAR; LANES];
        nearer_point(&self.at, x, &mut squared);
        squared
    }

    #[inline(always)]
    fn nearer(&self, x: &Points, best: &mut Lanes) {
        nearer_point(&self.at, x, best);
    }
}

/// Lowers `best`, squared distances, where the point `p` is nearer.
#[inline(always)]
pub(super) fn nearer_point(p: &[f32; 3], x: &Points, best: &mut Lanes) {
    let mut flat = [0.0; 4];
    for j in 0..4 {
        let (dx, dy) = (x.xy[0][j] - p[0], x.xy[1][j] - p[1]);
        flat[j] = dx * dx + dy * dy;
    }
    for k in 0..LANES {
        let dz = x.z[k / 4] - p[2];
        best[k] = least(flat[k % 4] + dz * dz, best[k]);
    }
}

/// All features of a mesh.
pub(super) struct Features {
    pub faces: Vec<Face>,
    pub edges: Vec<Edge>,
    pub corners: Vec<Corner>,
    /// Corners of the face of the same index.
    triangles: Vec<[Vec3; 3]>,
}

/// What the features of so many faces take, with what it takes to find them.
pub(super) fn bytes(faces: usize) -> u64 {
    let per = size_of::<Face>()
        + size_of::<[Vec3; 3]>()
        + 3 * size_of::<Side>()
        + 3 * size_of::<Vec3>()
        + 2 * size_of::<Edge>()
        + size_of::<Corner>()
        + 6 * 8;
    per as u64 * faces as u64
}

/// A side of a face: its ends in order, and the unit vector in the face away from it, or none.
#[derive(Debug, Clone, Copy)]
struct Side {
    ends: [u32; 2],
    away: Option<Vec3>,
}

impl Features {
    pub(super) fn new(mesh: &Mesh, grid: &Grid, unit: f64) -> Result<Features> {
        const WHAT: &str = "the features of the mesh";
        let n = mesh.faces.len();
        let local = |v: &Vec3| (v - grid.origin) / unit;
        let mut faces = reserve(WHAT, n)?;
        let mut triangles = reserve(WHAT, n)?;
        let mut sides: Vec<Side> = reserve(WHAT, n.saturating_mul(3))?;
        for (i, f) in mesh.faces.iter().enumerate() {
            let t = mesh.corners(i).map(|v| local(&v));
            let (face, away) = face(&t);
            for k in 0..3 {
                let (a, b) = (f[k], f[(k + 1) % 3]);
                if a != b {
                    sides.push(Side { ends: [a.min(b), a.max(b)], away: away[k] });
                }
            }
            faces.push(face);
            triangles.push(t);
        }
        sides.sort_by_key(|s| s.ends);
        let count = sides.chunk_by(|a, b| a.ends == b.ends).count();
        let mut edges = reserve(WHAT, count)?;
        let mut ends = reserve(WHAT, count)?;
        for group in sides.chunk_by(|a, b| a.ends == b.ends) {
            let [a, b] = group[0].ends.map(|v| local(&mesh.vertices[v as usize]));
            let length = (b - a).norm();
            // A length of none is a corner.
            if length > 1e-9 {
                let along = (b - a) / length;
                ends.push((group[0].ends, along));
                let sides = [group[0].away, group.get(1).and_then(|s| s.away)];
                if let Some(beyond) = beyond(&sides, &a) {
                    edges.push(Edge {
                        start: single(&a),
                        along: single(&along),
                        length: length as f32,
                        spread: along.lp_norm(1) as f32,
                        beyond,
                    });
                }
            }
        }
        let corners = corners(mesh, &ends, local)?;
        Ok(Features { faces, edges, corners, triangles })
    }

    /// The point of face `i` that is nearest to `c`.
    pub(super) fn on_face(&self, i: u32, c: &Vec3) -> Vec3 {
        triangle::closest(&self.triangles[i as usize], c)
    }

    /// The point of edge `i` that is nearest to `c`.
    pub(super) fn on_edge(&self, i: u32, c: &Vec3) -> Vec3 {
        let e = &self.edges[i as usize];
        let (start, along) = (double(&e.start), double(&e.along));
        start + along * along.dot(&(c - start)).clamp(0.0, f64::from(e.length))
    }

    /// Corner `i`.
    pub(super) fn on_corner(&self, i: u32) -> Vec3 {
        double(&self.corners[i as usize].at)
    }
}

/// The half-spaces away from two faces at an edge through `v`, and the one between them, which
/// holds what they both hold. None when the faces are flat there: their prisms meet.
fn beyond(sides: &[Option<Vec3>; 2], v: &Vec3) -> Option<[Plane; 3]> {
    let one = |n: &Option<Vec3>| n.as_ref().map_or(ALL, |n| plane(n, v));
    let mut front = ALL;
    if let [Some(a), Some(b)] = sides {
        let sum = a + b;
        let length = sum.norm();
        if length < 1e-6 {
            return None;
        }
        front = plane(&(sum / length), v);
    }
    Some([one(&sides[0]), one(&sides[1]), front])
}

pub(super) fn single(v: &Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

fn double(v: &[f32; 3]) -> Vec3 {
    Vec3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2]))
}

/// The half-space through `v` on the side of the unit vector `n`.
fn plane(n: &Vec3, v: &Vec3) -> Plane {
    [n.x as f32, n.y as f32, n.z as f32, -n.dot(v) as f32, n.lp_norm(1) as f32]
}

/// A face and the unit vectors away from its sides. One without area has no prism (its edges
/// stand for it) and no sides.
fn face(t: &[Vec3; 3]) -> (Face, [Option<Vec3>; 3]) {
    let edges = [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let longest2 = edges.iter().map(|e| e.norm_squared()).fold(0.0, f64::max);
    let cross = edges[0].cross(&edges[1]);
    const NONE: Plane = [0.0, 0.0, 0.0, -FAR, 0.0];
    if longest2 < 1e-200 || cross.norm_squared() <= 1e-24 * longest2 * longest2 {
        return (Face { plane: NONE, sides: [NONE; 3] }, [None; 3]);
    }
    let n = cross.normalize();
    let inward: [Vec3; 3] = std::array::from_fn(|k| n.cross(&edges[k]).normalize());
    let sides = std::array::from_fn(|k| plane(&inward[k], &t[k]));
    (Face { plane: plane(&n, &t[0]), sides }, inward.map(|m| Some(-m)))
}

/// The corners, each with some of the edges that meet there.
fn corners(
    mesh: &Mesh,
    ends: &[([u32; 2], Vec3)],
    local: impl Fn(&Vec3) -> Vec3,
) -> Result<Vec<Corner>> {
    const WHAT: &str = "the corners of the mesh";
    // The edges of each vertex, one vertex after the other.
    let mut starts = filled(WHAT, mesh.vertices.len() + 1, 0u32)?;
    for (ends, _) in ends {
        for &v in ends {
            starts[v as usize + 1] += 1;
        }
    }
    for v in 1..starts.len() {
        starts[v] += starts[v - 1];
    }
    let mut next = filled(WHAT, mesh.vertices.len(), 0u32)?;
    next.copy_from_slice(&starts[..mesh.vertices.len()]);
    let mut list = filled(WHAT, 2 * ends.len(), Vec3::zeros())?;
    for ([a, b], along) in ends {
        for (v, direction) in [(a, *along), (b, -along)] {
            list[next[*v as usize] as usize] = direction;
            next[*v as usize] += 1;
        }
    }
    let mut corners = reserve(WHAT, mesh.vertices.len())?;
    for (v, range) in starts.windows(2).enumerate() {
        let edges = &list[range[0] as usize..range[1] as usize];
        if let Some(first) = edges.first() {
            // Evenly among them, in the order of the other ends.
            let at = local(&mesh.vertices[v]);
            let mut away: [Plane; AWAY] = std::array::from_fn(|k| {
                let i = k * edges.len() / (AWAY - 1).min(edges.len());
                plane(&-edges.get(i).unwrap_or(first), &at)
            });
            // And what follows from all: behind along their sum.
            let sum = edges.iter().fold(Vec3::zeros(), |s, e| s + e);
            if sum.norm() > 1e-6 {
                away[AWAY - 1] = plane(&-sum.normalize(), &at);
            }
            corners.push(Corner { at: single(&at), away });
        }
    }
    Ok(corners)
}
