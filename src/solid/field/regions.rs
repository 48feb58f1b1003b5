//! Faces, edges and corners with the regions of space from which each can be nearest, eight
//! points at a time, in units of the shortest cell edge from the grid's origin.
//!
//! A point whose nearest point lies within a face is above it (in the prism over it); one
//! whose nearest lies on an edge is between the edge's ends and beyond the side of every
//! face there; one whose nearest is a corner is behind it along every edge there. That
//! holds for any set of triangles, closed or not. Half-spaces left out only make a region
//! larger. (Mauch 2003 scans these regions; here they prune candidates.)

use crate::math::Vec3;
use wide::bytemuck::cast;
use wide::{f32x4, f32x8};

/// Points of one evaluation.
pub(super) const LANES: usize = 8;
/// One number for each of some points.
pub(super) type Lanes = f32x8;
/// No distance.
pub(super) const FAR: f32 = 1e15;
/// What rounding moves a place by, at most, in a grid of so many cells along its longest edge:
/// some units of f32 in the last place.
pub(super) fn rounding(cells: usize) -> f32 {
    (cells as f32 * 1.5e-6).max(1e-4)
}

/// The corners of a box, x fastest: what two places along each axis make.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Points {
    x: Lanes,
    y: Lanes,
    z: Lanes,
    /// The first corner, and the steps from it along the axes.
    low: [f32x4; 3],
    step: [f32x4; 3],
    /// Points this far out of a face's prism count as in it: what rounding moves.
    round: f32,
}

impl Points {
    /// From the two places along x, y and z.
    #[inline(always)]
    pub(super) fn new([x, y, z]: [[f32; 2]; 3], round: f32) -> Points {
        let ([a, b], [c, d], [e, f]) = (x, y, z);
        Points {
            x: Lanes::new([a, b, a, b, a, b, a, b]),
            y: Lanes::new([c, c, d, d, c, c, d, d]),
            z: Lanes::new([e, e, e, e, f, f, f, f]),
            low: [f32x4::splat(a), f32x4::splat(c), f32x4::splat(e)],
            step: [f32x4::splat(b - a), f32x4::splat(d - c), f32x4::splat(f - e)],
            round,
        }
    }

    /// Points this far out of a region may still be nearest to what it belongs to.
    #[inline(always)]
    pub(super) fn slack(&self) -> f32 {
        4.0 * self.round
    }

    /// The ways to the points from `p`.
    #[inline(always)]
    fn from(&self, p: &[f32; 3]) -> [Lanes; 3] {
        [self.x - p[0], self.y - p[1], self.z - p[2]]
    }
}

/// What can be nearest.
pub(super) trait Feature {
    /// Of each point, how deep any point of a brick of these half extents about it may lie in the
    /// region's worst half-space: less than 0 when the brick misses the region.
    fn touches(&self, x: &Points, half: [f32; 3]) -> Lanes;
    /// The same, and `bound`.
    #[inline(always)]
    fn touches_within(&self, x: &Points, half: [f32; 3]) -> (Lanes, Lanes) {
        (self.touches(x, half), self.bound(x))
    }
    /// The squared distances of points that lie in the region; FAR of others.
    fn within(&self, x: &Points) -> Lanes;
    /// Squared distances from the plane, line or point that the feature lies on.
    fn bound(&self, x: &Points) -> Lanes;
    /// `best`, squared distances, or less where this feature is nearer.
    fn nearer(&self, x: &Points, best: Lanes) -> Lanes;
}

/// Bits of the lanes that are not negative.
#[inline(always)]
pub(super) fn bits(lanes: Lanes) -> u8 {
    !(lanes.to_bitmask() as u8)
}

/// Of some lanes, those of points that lie in the region; at least FAR elsewhere.
#[inline(always)]
fn only(depth: Lanes, lanes: Lanes, round: f32) -> Lanes {
    lanes + (depth.simd_lt(Lanes::splat(-round)) & Lanes::splat(FAR))
}

/// Four half-spaces `n·x + o ≥ 0`, n of unit length, side by side.
#[derive(Debug, Clone, Copy, Default)]
struct Four {
    n: [f32x4; 3],
    o: f32x4,
}

impl Four {
    /// From normals and points on the planes. A normal of zero: everywhere 0.
    fn new(planes: [(Vec3, Vec3); 4]) -> Four {
        let [(a, p), (b, q), (c, r), (d, s)] = planes;
        let n = |k: usize| f32x4::new([a[k] as f32, b[k] as f32, c[k] as f32, d[k] as f32]);
        let o = [-a.dot(&p) as f32, -b.dot(&q) as f32, -c.dot(&r) as f32, -d.dot(&s) as f32];
        Four { n: [n(0), n(1), n(2)], o: f32x4::new(o) }
    }

    /// Heights of the corners over each, raised.
    #[inline(always)]
    fn heights(&self, p: &Points, raise: f32x4) -> [Lanes; 4] {
        let [x, y, z] = self.n;
        let c = x * p.low[0] + y * p.low[1] + (z * p.low[2] + (self.o + raise));
        let (dx, dy, dz) = (x * p.step[0], y * p.step[1], z * p.step[2]);
        let (cx, cy) = (c + dx, c + dy);
        let cxy = cx + dy;
        let [a, b, d, e] = f32x4::transpose([c, cx, cy, cxy]);
        let [f, g, h, i] = f32x4::transpose([c + dz, cx + dz, cy + dz, cxy + dz]);
        [cast([a, f]), cast([b, g]), cast([d, h]), cast([e, i])]
    }

    /// How far a brick of these half extents reaches across each, and the slack.
    #[inline(always)]
    fn reach(&self, half: [f32; 3], slack: f32) -> f32x4 {
        let [x, y, z] = self.n;
        x.abs() * half[0] + y.abs() * half[1] + (z.abs() * half[2] + slack)
    }

    /// The normal of the last.
    #[inline(always)]
    fn last(&self) -> [f32; 3] {
        let [x, y, z] = &self.n;
        [x.as_array()[3], y.as_array()[3], z.as_array()[3]]
    }
}

/// A face: the prism's sides and the height over its plane.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Face {
    planes: Four,
}

impl Face {
    /// From the inward normals of its sides and the normal, and points on them.
    pub(super) fn new(planes: [(Vec3, Vec3); 4]) -> Face {
        Face { planes: Four::new(planes) }
    }

    /// Without a prism.
    pub(super) fn none() -> Face {
        Face { planes: Four { n: [f32x4::ZERO; 3], o: f32x4::splat(-FAR) } }
    }
}

impl Feature for Face {
    #[inline(always)]
    fn touches(&self, x: &Points, half: [f32; 3]) -> Lanes {
        let [a, b, c, _] = self.planes.heights(x, self.planes.reach(half, x.slack()));
        a.fast_min(b).fast_min(c)
    }

    #[inline(always)]
    fn touches_within(&self, x: &Points, half: [f32; 3]) -> (Lanes, Lanes) {
        let reach = self.planes.reach(half, x.slack());
        let [a, b, c, h] = self.planes.heights(x, reach);
        let h = h - reach.as_array()[3];
        (a.fast_min(b).fast_min(c), h * h)
    }

    #[inline(always)]
    fn within(&self, x: &Points) -> Lanes {
        let [a, b, c, h] = self.planes.heights(x, f32x4::ZERO);
        only(a.fast_min(b).fast_min(c), h * h, x.round)
    }

    #[inline(always)]
    fn bound(&self, x: &Points) -> Lanes {
        let [a, b, c] = self.planes.last();
        let h = x.x * a + x.y * b + (x.z * c + self.planes.o.as_array()[3]);
        h * h
    }

    #[inline(always)]
    fn nearer(&self, x: &Points, best: Lanes) -> Lanes {
        self.within(x).fast_min(best)
    }
}

/// An edge: beyond the sides of two faces and what follows from both (in front of the edge),
/// and the place along it, from its start.
#[derive(Debug, Clone, Copy)]
#[repr(align(16))]
pub(super) struct Edge {
    planes: Four,
    pub start: [f32; 3],
    pub length: f32,
}

impl Edge {
    /// From normals through the edge (zero: none), its start, direction and length.
    pub(super) fn new(beyond: [Vec3; 3], start: Vec3, along: Vec3, length: f64) -> Edge {
        let [a, b, c] = beyond;
        let planes = Four::new([(a, start), (b, start), (c, start), (along, start)]);
        Edge { planes, start: single(&start), length: length as f32 }
    }

    pub(super) fn along(&self) -> [f32; 3] {
        self.planes.last()
    }

    /// Squared distance from the place `t` along the edge.
    #[inline(always)]
    fn squared(&self, [dx, dy, dz]: [Lanes; 3], t: Lanes) -> Lanes {
        let [a, b, c] = self.along();
        let (rx, ry, rz) = (dx - t * a, dy - t * b, dz - t * c);
        rx * rx + ry * ry + rz * rz
    }

    #[inline(always)]
    fn place(&self, [dx, dy, dz]: &[Lanes; 3]) -> Lanes {
        let [a, b, c] = self.along();
        *dx * a + *dy * b + *dz * c
    }
}

impl Feature for Edge {
    #[inline(always)]
    fn touches(&self, x: &Points, half: [f32; 3]) -> Lanes {
        let reach = self.planes.reach(half, x.slack());
        let [a, b, c, t] = self.planes.heights(x, reach);
        let end = self.length + 2.0 * reach.as_array()[3];
        a.fast_min(b).fast_min(c).fast_min(t).fast_min(-t + end)
    }

    #[inline(always)]
    fn within(&self, x: &Points) -> Lanes {
        let [a, b, c, t] = self.planes.heights(x, f32x4::ZERO);
        let depth = a.fast_min(b).fast_min(c).fast_min(t).fast_min(-t + self.length);
        only(depth, self.squared(x.from(&self.start), t), x.round)
    }

    #[inline(always)]
    fn bound(&self, x: &Points) -> Lanes {
        let d = x.from(&self.start);
        let t = self.place(&d);
        self.squared(d, t)
    }

    #[inline(always)]
    fn nearer(&self, x: &Points, best: Lanes) -> Lanes {
        let d = x.from(&self.start);
        let t = self.place(&d).fast_max(Lanes::ZERO).fast_min(Lanes::splat(self.length));
        self.squared(d, t).fast_min(best)
    }
}

/// A corner, and half-spaces behind it along edges from it.
#[derive(Debug, Clone, Copy)]
#[repr(align(16))]
pub(super) struct Corner {
    planes: Four,
    pub at: [f32; 3],
}

impl Corner {
    pub(super) fn new(away: [Vec3; 4], at: Vec3) -> Corner {
        let [a, b, c, d] = away;
        Corner { planes: Four::new([(a, at), (b, at), (c, at), (d, at)]), at: single(&at) }
    }
}

impl Feature for Corner {
    #[inline(always)]
    fn touches(&self, x: &Points, half: [f32; 3]) -> Lanes {
        let [a, b, c, d] = self.planes.heights(x, self.planes.reach(half, x.slack()));
        a.fast_min(b).fast_min(c.fast_min(d))
    }

    #[inline(always)]
    fn within(&self, x: &Points) -> Lanes {
        let [a, b, c, d] = self.planes.heights(x, f32x4::ZERO);
        only(a.fast_min(b).fast_min(c.fast_min(d)), from_point(&self.at, x), x.round)
    }

    #[inline(always)]
    fn bound(&self, x: &Points) -> Lanes {
        from_point(&self.at, x)
    }

    #[inline(always)]
    fn nearer(&self, x: &Points, best: Lanes) -> Lanes {
        from_point(&self.at, x).fast_min(best)
    }
}

/// Squared distances from the point `p`.
#[inline(always)]
pub(super) fn from_point(p: &[f32; 3], x: &Points) -> Lanes {
    let [dx, dy, dz] = x.from(p);
    dx * dx + dy * dy + dz * dz
}

pub(super) fn single(v: &Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

pub(super) fn double(v: &[f32; 3]) -> Vec3 {
    Vec3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2]))
}
