//! A wall of triangles.
//!
//! A sphere touches the surface where its centre's distance to it has a local minimum: inside a face; on an edge,
//! if that is nearest on every triangle of the edge; at a corner, if it is on every triangle of the corner. Every such place is
//! counted once, by the triangle of the least number, so that a flat floor of many triangles is a floor.

use crate::dem::narrow::Meeting;
use crate::dem::small::mul;
use crate::dem::template::Template;
use crate::dem::tree::{Near, Tree};
use crate::error::{Error, Result, collected, filled, reserve};
use crate::math::{Sphere, Vec3};
use nalgebra::Matrix3;

/// Where on a triangle a point is nearest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Face,
    /// The edge after this corner.
    Edge(usize),
    Corner(usize),
}

/// Parts of a side within which a point counts as on the edge: seen alike from both triangles.
const GRAIN: f64 = 1e-9;

/// Triangles in the frame of the wall, with who shares which edge and corner.
#[derive(Debug, Clone)]
pub(crate) struct Mesh {
    corners: Vec<[Vec3; 3]>,
    /// Numbers of the vertices, and of the edges after each.
    vertices: Vec<[u32; 3]>,
    edges: Vec<[u32; 3]>,
    /// For each edge and each vertex the triangles, from `starts[k]` to `starts[k + 1]`.
    of_edge: Lists,
    of_vertex: Lists,
    tree: Tree,
    lo: Vec3,
    hi: Vec3,
    reach: f64,
}

#[derive(Debug, Clone)]
struct Lists {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// Items of `count` lists, given as (list, item) in the order of items.
    fn new(count: usize, pairs: &[(u32, u32)]) -> Result<Lists> {
        let mut starts = filled("a mesh wall", count + 1, 0u32)?;
        for (k, _) in pairs {
            starts[*k as usize + 1] += 1;
        }
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        let mut next = collected("a mesh wall", starts.iter().copied())?;
        let mut items = filled("a mesh wall", pairs.len(), 0u32)?;
        for (k, item) in pairs {
            let at = &mut next[*k as usize];
            items[*at as usize] = *item;
            *at += 1;
        }
        Ok(Lists { starts, items })
    }

    fn get(&self, k: u32) -> &[u32] {
        let k = k as usize;
        &self.items[self.starts[k] as usize..self.starts[k + 1] as usize]
    }
}

impl Mesh {
    /// Checks the triangles of wall number `i`; vertices at one place are one. Refused: no triangle, a vertex that is not
    /// finite or does not exist, a triangle without area.
    pub fn new(vertices: &[Vec3], triangles: &[[u32; 3]], origin: &Vec3, i: usize) -> Result<Mesh> {
        if triangles.is_empty() {
            return Err(Error::Empty(format!("wall {i} is a mesh without triangles")));
        }
        if triangles.len() > u32::MAX as usize / 3 {
            return Err(Error::TooLarge(format!("wall {i} has {} triangles", triangles.len())));
        }
        for (k, v) in vertices.iter().enumerate() {
            if !v.iter().all(|c| c.is_finite()) {
                return Err(Error::NotFinite(format!(
                    "vertex {k} of wall {i} is at ({}, {}, {})",
                    v.x, v.y, v.z
                )));
            }
        }
        let welded = weld(vertices)?;
        let mut tris: Vec<[u32; 3]> = reserve("a mesh wall", triangles.len())?;
        let mut balls: Vec<Sphere> = reserve("a mesh wall", triangles.len())?;
        for (k, t) in triangles.iter().enumerate() {
            let mut own = [0; 3];
            for (o, v) in own.iter_mut().zip(t) {
                *o = *welded.get(*v as usize).ok_or_else(|| {
                    Error::IndexOutOfRange(format!(
                        "triangle {k} of wall {i} has vertex {v} of {}",
                        vertices.len()
                    ))
                })?;
            }
            let [a, b, c] = own.map(|v| vertices[v as usize] - origin);
            let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
            if (b - a).cross(&(c - a)).norm() <= 1e-14 * longest * longest {
                return Err(Error::InvalidArgument(format!(
                    "triangle {k} of wall {i} has no area"
                )));
            }
            let middle = a.inf(&b).inf(&c) * 0.5 + a.sup(&b).sup(&c) * 0.5;
            let radius = [a, b, c].iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
            balls.push(Sphere::new(middle, radius));
            tris.push(own);
        }
        let mut order = collected("a mesh wall", 0..triangles.len() as u32)?;
        let tree = Tree::new(&mut balls, &mut order)?;
        let own = collected("a mesh wall", order.iter().map(|k| tris[*k as usize]))?;
        let corners: Vec<[Vec3; 3]> =
            collected("a mesh wall", own.iter().map(|t| t.map(|v| vertices[v as usize] - origin)))?;
        // Edges by their ends.
        let mut ends: Vec<([u32; 2], u32, usize)> = reserve("a mesh wall", 3 * own.len())?;
        for (k, t) in own.iter().enumerate() {
            for e in 0..3 {
                let (a, b) = (t[e], t[(e + 1) % 3]);
                ends.push(([a.min(b), a.max(b)], k as u32, e));
            }
        }
        ends.sort_unstable();
        let mut edges = filled("a mesh wall", own.len(), [0u32; 3])?;
        let mut pairs: Vec<(u32, u32)> = reserve("a mesh wall", ends.len())?;
        let (mut number, mut last) = (0u32, None);
        for (e, k, side) in &ends {
            if last.is_some_and(|l| l != *e) {
                number += 1;
            }
            last = Some(*e);
            edges[*k as usize][*side] = number;
            pairs.push((number, *k));
        }
        let of_edge = Lists::new(number as usize + 1, &pairs)?;
        pairs.clear();
        for (k, t) in own.iter().enumerate() {
            pairs.extend(t.iter().map(|v| (*v, k as u32)));
        }
        let of_vertex = Lists::new(vertices.len(), &pairs)?;
        let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
        let mut reach = 0.0f64;
        for p in corners.iter().flatten() {
            (lo, hi) = (lo.inf(p), hi.sup(p));
            reach = reach.max(p.norm());
        }
        Ok(Mesh { corners, vertices: own, edges, of_edge, of_vertex, tree, lo, hi, reach })
    }

    /// How far the farthest point is from the origin.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    pub fn bytes(&self) -> u64 {
        let own = self.corners.capacity() * (72 + 24) + self.tree.bytes() as usize;
        let lists = [&self.of_edge, &self.of_vertex];
        let lists = lists.map(|l| 4 * (l.starts.capacity() + l.items.capacity()));
        (own + lists.iter().sum::<usize>()) as u64
    }

    /// A lower bound of the gap to a ball.
    pub fn far(&self, center: &Vec3, radius: f64) -> f64 {
        (center - center.sup(&self.lo).inf(&self.hi)).norm() - radius
    }

    pub fn search(
        &self,
        body: &Template,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<Near>,
    ) -> u64 {
        let spheres = body.spheres();
        self.tree.pairs(body.tree(), (shift, turn), reach, stack, |p, q| {
            for (s, b) in spheres[q.clone()].iter().zip(q) {
                let center = mul(turn, &s.center) + shift;
                for a in p.clone() {
                    let gap = self.gap(a as u32, &center, s.radius);
                    if gap < reach {
                        found.push(Near { a: a as u32, b: b as u32, gap });
                    }
                }
            }
        })
    }

    /// How far triangle `a` is from a sphere.
    pub fn gap(&self, a: u32, center: &Vec3, radius: f64) -> f64 {
        (center - nearest(&self.corners[a as usize], center).0).norm() - radius
    }

    /// How triangle `a` meets a sphere; `None` where another one does.
    pub fn meet(&self, a: u32, center: &Vec3, radius: f64) -> Option<Meeting> {
        let at = a as usize;
        let (point, place) = nearest(&self.corners[at], center);
        let owned = match place {
            Place::Face => true,
            Place::Edge(e) => {
                let edge = self.edges[at][e];
                self.of_edge.get(edge).iter().all(|&t| {
                    let other = t as usize;
                    t == a
                        || t > a
                            && matches!(nearest(&self.corners[other], center).1,
                                Place::Edge(f) if self.edges[other][f] == edge)
                })
            }
            Place::Corner(c) => {
                let vertex = self.vertices[at][c];
                self.of_vertex.get(vertex).iter().all(|&t| {
                    let other = t as usize;
                    t == a
                        || t > a
                            && matches!(nearest(&self.corners[other], center).1,
                                Place::Corner(d) if self.vertices[other][d] == vertex)
                })
            }
        };
        if !owned {
            return None;
        }
        let d = center - point;
        let distance = d.norm();
        let normal = if distance > 0.0 {
            d / distance
        } else {
            let [p, q, r] = &self.corners[at];
            (q - p).cross(&(r - p)).normalize()
        };
        let gap = distance - radius;
        Some(Meeting { normal, gap, radius, point: center - normal * (radius + 0.5 * gap) })
    }
}

/// For each vertex the first one at its place.
fn weld(vertices: &[Vec3]) -> Result<Vec<u32>> {
    let mut order = collected("a mesh wall", 0..vertices.len() as u32)?;
    let key = |k: u32| vertices[k as usize];
    let compare = |i: &u32, j: &u32| {
        let (p, q) = (key(*i), key(*j));
        let by = |k: usize| (p[k] + 0.0).total_cmp(&(q[k] + 0.0));
        by(0).then(by(1)).then(by(2)).then(i.cmp(j))
    };
    order.sort_unstable_by(compare);
    let mut first = filled("a mesh wall", vertices.len(), 0u32)?;
    let mut last: Option<u32> = None;
    for k in order {
        let leader = match last {
            Some(l) if key(l) == key(k) => l,
            _ => k,
        };
        last = Some(leader);
        first[k as usize] = leader;
    }
    Ok(first)
}

/// The nearest point of a triangle, and what it lies on (Ericson 2005, 5.1.5).
fn nearest(t: &[Vec3; 3], p: &Vec3) -> (Vec3, Place) {
    let [a, b, c] = t;
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    let sum = va + vb + vc;
    let grain = GRAIN * sum;
    if va > grain && vb > grain && vc > grain {
        return (a + ab * (vb / sum) + ac * (vc / sum), Place::Face);
    }
    // Nearest on one of the edges: of the three the nearest, corners told apart.
    let mut best = (f64::MAX, *a, Place::Corner(0));
    for e in 0..3 {
        let (from, to) = (&t[e], &t[(e + 1) % 3]);
        let side = to - from;
        let s = side.dot(&(p - from)) / side.norm_squared();
        let (q, place) = if s <= GRAIN {
            (*from, Place::Corner(e))
        } else if s >= 1.0 - GRAIN {
            (*to, Place::Corner((e + 1) % 3))
        } else {
            (from + side * s, Place::Edge(e))
        };
        let d = (p - q).norm_squared();
        if d < best.0 {
            best = (d, q, place);
        }
    }
    (best.1, best.2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_is_that_of_a_fine_grid() {
        let t = [Vec3::new(0.1, 0.0, 0.2), Vec3::new(1.3, 0.2, -0.1), Vec3::new(0.4, 0.9, 0.3)];
        let n = 300;
        for k in 0..200 {
            let s = f64::from(k);
            let p = Vec3::new((1.7 * s).sin() * 2.0, (2.3 * s).cos() * 2.0, (0.9 * s).sin());
            let mut best = f64::MAX;
            for i in 0..=n {
                for j in 0..=n - i {
                    let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                    let q = t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v;
                    best = best.min((p - q).norm());
                }
            }
            let (q, place) = nearest(&t, &p);
            let d = (p - q).norm();
            assert!(d <= best + 1e-12 && d > best - 0.01, "{k}: {d} {best} {place:?}");
        }
    }
}
