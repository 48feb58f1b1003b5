//! Where the spheres of a fragment may be: within the parent's surface, half-spaces, and the union
//! of the parent's spheres if wanted. The inside distance of the whole is the least of theirs, so
//! that no field is made for a fragment; what is nearly so, fast and in single precision, is read
//! from the parent's, and every sphere handed out is measured exactly.

use super::lookup::{Depths, Lookup};
use super::union::Union;
use crate::error::{Result, collected};
use crate::math::{Sphere, Vec3};
use crate::solid::Grid;
use crate::solid::nearest::Surface;
use wide::f32x8;

/// Of a cell: how much less than the way to what is nearest a grown radius may be.
const TOLERANCE: f32 = 0.2;
/// First way of a growing ball, as a part of the size, and the most steps back from there.
const REACH: f32 = 0.6;
const STEPS: usize = 6;
/// By what part of the depth a settled sphere may be too small to hold the one before, and how far
/// it may move.
const SETTLED: f64 = 0.002;
const FARTHEST: f64 = 0.2;
/// Halvings that follow.
const HALVINGS: usize = 3;

/// A sphere while it is looked for, about the room's own middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    pub center: [f32; 3],
    pub radius: f32,
}

impl Ball {
    /// Squared distance of the centre from a point.
    #[inline(always)]
    pub(super) fn apart(&self, p: &[f32; 3]) -> f32 {
        let [x, y, z] = [p[0] - self.center[0], p[1] - self.center[1], p[2] - self.center[2]];
        x * x + y * y + z * z
    }
}

// `array::map` is not inlined where code is made in several units: what is called for every place
// is written out.

/// A place some way on.
#[inline(always)]
pub(super) fn along(p: &[f32; 3], t: f32, way: &[f32; 3]) -> [f32; 3] {
    [p[0] + t * way[0], p[1] + t * way[1], p[2] + t * way[2]]
}

#[inline(always)]
pub(super) fn dot(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn times(a: &[f32; 3], by: f32) -> [f32; 3] {
    [a[0] * by, a[1] * by, a[2] * by]
}

/// A half-space, unit frame: normal · p ≤ offset, the normal of length 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wall {
    pub normal: Vec3,
    pub offset: f64,
}

/// The parts of a room.
pub(super) struct Parts<'a> {
    pub grid: &'a Grid,
    /// The depth in what spheres must stay in: the solid, or what it has in common with the
    /// union.
    pub depths: Depths<'a>,
    pub surface: &'a Surface,
    pub union: Option<&'a Union>,
    /// Half-spaces of the fragment and further ones.
    pub walls: &'a [Wall],
    /// What every radius is less than the depth.
    pub less: f64,
    pub lo: Vec3,
    pub hi: Vec3,
}

/// A room.
pub(super) struct Room<'a> {
    parts: Parts<'a>,
    pub middle: Vec3,
    lookup: Lookup<'a>,
    walls: Vec<[f32; 4]>,
    /// The same, eight by eight.
    planes: Vec<[f32x8; 4]>,
    /// Too small for the grid: distances to the surface itself.
    exact: bool,
    slack: f32,
    /// A length of the order of the room.
    pub size: f32,
}

impl<'a> Room<'a> {
    pub(super) fn new(parts: Parts<'a>, volume: f64) -> Result<Room<'a>> {
        let middle = parts.lo + (parts.hi - parts.lo) * 0.5;
        let edges = parts.hi - parts.lo;
        let cell = parts.grid.spacing.max();
        let about = parts.walls.iter().map(|w| {
            let n = w.normal;
            [n.x as f32, n.y as f32, n.z as f32, (w.offset - n.dot(&middle)) as f32]
        });
        let walls = collected("half-spaces", about)?;
        let eight = walls.chunks(8).map(|some| {
            // Those that are missing are far away.
            let of = |l: usize, a: usize| some.get(l).map_or([0.0, 0.0, 0.0, FAR][a], |w| w[a]);
            std::array::from_fn(|a| f32x8::new(std::array::from_fn(|l| of(l, a))))
        });
        let planes = collected("half-spaces", eight)?;
        let size = volume.max(0.0).cbrt() as f32;
        let exact = edges.max() < FEW_CELLS * cell;
        Ok(Room {
            lookup: Lookup::new(parts.grid, parts.depths, &middle),
            slack: if exact { 1e-3 * size } else { TOLERANCE * cell as f32 },
            walls,
            planes,
            exact,
            size,
            middle,
            parts,
        })
    }

    #[inline]
    pub(super) fn global(&self, p: &[f32; 3]) -> Vec3 {
        self.middle + Vec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]))
    }

    /// The depth at a place, nearly, and the way in which it falls fastest.
    #[inline]
    pub(super) fn depth(&self, p: &[f32; 3]) -> (f32, [f32; 3]) {
        let (mut depth, mut out) = self.below(p);
        if depth <= 0.0 {
            return (depth - self.parts.less as f32, out);
        }
        let (own, way) = if self.exact { self.signed(p, depth) } else { self.lookup.at(p) };
        if own < depth {
            (depth, out) = (own, times(&way, -1.0));
        }
        (depth - self.parts.less as f32, out)
    }

    /// The least depth below the half-spaces, and the normal of that one.
    #[inline]
    fn below(&self, p: &[f32; 3]) -> (f32, [f32; 3]) {
        let mut found = (FAR, [0.0; 3]);
        for [x, y, z, offset] in &self.planes {
            let below = *offset - (*x * p[0] + *y * p[1] + *z * p[2]);
            let [a, b, c, d, e, f, g, h] = below.to_array();
            let least = (a.min(b).min(c.min(d))).min(e.min(f).min(g.min(h)));
            if least < found.0 {
                let lane =
                    below.simd_eq(f32x8::splat(least)).to_bitmask().trailing_zeros() as usize;
                let of = |n: &f32x8| n.as_array()[lane & 7];
                found = (least, [of(x), of(y), of(z)]);
            }
        }
        found
    }

    /// Whether the depth at a place within the half-spaces is above 0.
    #[inline]
    pub(super) fn open(&self, p: &[f32; 3]) -> bool {
        if self.exact {
            self.depth(p).0 > 0.0
        } else {
            self.lookup.deeper(p, self.parts.less as f32)
        }
    }

    /// The depth in surface and union themselves, as far as it is less than `reach`, and the way
    /// in which it grows.
    fn signed(&self, p: &[f32; 3], reach: f32) -> (f32, [f32; 3]) {
        let at = self.global(p);
        let inside = self.parts.surface.contains(&at);
        let sign = if inside { 1.0 } else { -1.0 };
        let of = |depth: f64, from: Vec3| {
            let way = (at - from) * (1.0 / if depth.abs() > 1e-300 { depth } else { 1e-300 });
            (depth as f32, [way.x as f32, way.y as f32, way.z as f32])
        };
        let near = self.parts.surface.nearest_within(&at, f64::from(reach));
        let mut found =
            near.map_or((sign as f32 * reach, [0.0; 3]), |n| of(sign * n.distance, n.point));
        if let Some(union) = self.parts.union.filter(|_| inside) {
            let (depth, point) = union.nearest(&at);
            if depth < f64::from(found.0) {
                found = of(depth, point);
            }
        }
        found
    }

    /// The ball about a place.
    #[inline]
    pub(super) fn ball(&self, center: [f32; 3]) -> Ball {
        Ball { center, radius: self.depth(&center).0.max(0.0) }
    }

    /// The greatest ball found that holds the ball about `p`: its centre moves away from what is
    /// nearest as long as the depth grows as fast.
    pub(super) fn grown(&self, p: [f32; 3]) -> Ball {
        let (depth, out) = self.depth(&p);
        let still = Ball { center: p, radius: depth.max(0.0) };
        let norm = dot(&out, &out).sqrt();
        if norm < 0.1 || depth <= 0.0 {
            return still;
        }
        let way = times(&out, -1.0 / norm);
        let at = |t: f32| along(&p, t, &way);
        let slack = self.slack.min(0.05 * depth);
        // What hinders the ball is nearly flat: from a place too far on, back to where a plane with
        // the slope found there would let it be, as Newton's method does.
        let mut ball = still;
        let (mut low, mut high) = (0.0f32, REACH * self.size);
        let mut last = high;
        for _ in 0..STEPS {
            let (there, out) = self.depth(&at(high));
            let missing = depth + high - slack - there;
            if missing <= 0.0 {
                (low, ball) = (high, Ball { center: at(high), radius: there });
                break;
            }
            // How much less the depth grows there than the way.
            let less = 1.0 + dot(&out, &way);
            let back = high - (missing + 0.5 * slack) / less.max(0.05);
            if back <= 0.02 * depth {
                break;
            }
            last = high;
            high = back.min(0.9 * high);
        }
        for _ in 0..HALVINGS {
            if last - low < 0.1 * depth {
                break;
            }
            let middle = 0.5 * (low + last);
            let next = self.ball(at(middle));
            if next.radius >= depth + middle - slack {
                (low, ball) = (middle, next);
            } else {
                last = middle;
            }
        }
        ball
    }

    /// Least depth below the half-spaces, exactly; a large number where there are none.
    pub(super) fn wall(&self, p: &Vec3) -> f64 {
        let below = |w: &Wall| w.offset - w.normal.dot(p);
        self.parts.walls.iter().map(below).fold(1e100, f64::min)
    }

    /// The greatest radius that a sphere about `p` may have, exactly but for rounding, and the
    /// way to what hinders it; not above 0 outside.
    fn allowed(&self, p: &Vec3) -> (f64, Vec3) {
        let (mut depth, mut out) = (1e100, Vec3::zeros());
        for wall in self.parts.walls {
            let below = wall.offset - wall.normal.dot(p);
            if below < depth {
                (depth, out) = (below, wall.normal);
            }
        }
        let less = self.parts.less;
        if depth <= less {
            return (depth - less, out);
        }
        let to = |q: Vec3, distance: f64| (q - p) * (1.0 / distance.max(1e-300));
        let near = self.parts.surface.nearest_within(p, depth);
        if !self.inside(p, near.map_or(depth, |n| n.distance)) {
            return (0.0, out);
        }
        if let Some(near) = near {
            (depth, out) = (near.distance, to(near.point, near.distance));
        }
        if let Some(union) = self.parts.union {
            let (below, point) = union.nearest(p);
            if below < depth {
                (depth, out) = (below, to(point, below.abs()));
            }
        }
        (depth - less, out)
    }

    /// A sphere about a place with the whole radius that it may have.
    pub(super) fn sphere(&self, center: Vec3) -> Sphere {
        Sphere::new(center, self.allowed(&center).0)
    }

    /// The greatest sphere found that holds the one about a place, by exact distances: what the
    /// field has not told of the crease of the depth.
    pub(super) fn settled(&self, center: Vec3) -> Sphere {
        let (depth, out) = self.allowed(&center);
        let mut best = Sphere::new(center, depth);
        if depth <= 0.0 {
            return best;
        }
        let slack = SETTLED * depth;
        let mut t = FARTHEST * depth;
        for _ in 0..STEPS {
            let at = center - out * t;
            let (there, other) = self.allowed(&at);
            let missing = depth + t - slack - there;
            if missing <= 0.0 {
                best = Sphere::new(at, there);
                break;
            }
            let back = t - (missing + 0.5 * slack) / (1.0 - other.dot(&out)).max(0.05);
            t = back.min(0.9 * t);
            if t <= slack {
                break;
            }
        }
        best
    }

    /// Whether a place is inside the solid; no surface is nearer than `free`.
    fn inside(&self, p: &Vec3, free: f64) -> bool {
        // The nearest cell centre is then on the same side.
        let far = free > HALF_DIAGONAL * self.parts.grid.spacing.max();
        (far && self.lookup.inside(&(p - self.middle))) || self.parts.surface.contains(p)
    }

    /// The half-spaces about the middle.
    pub(super) fn walls(&self) -> &[[f32; 4]] {
        &self.walls
    }
}

/// Below no half-space.
const FAR: f32 = 1e30;
/// From a place to the nearest cell centre it is at most this, in edges, and a little for rounding.
const HALF_DIAGONAL: f64 = 0.88;
/// A fragment smaller than so many cells of its parent's grid is not told by them.
const FEW_CELLS: f64 = 4.0;
