//! The surface of a union of spheres: which part of each sphere is exposed,
//! and the nearest point of it, exactly.

use super::arcs::{Arc, Part, arcs_of, beyond, free};
use super::matter::Matter;
use super::tree::Tree;
use crate::error::{Error, Result, filled};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use std::f64::consts::PI;

/// Spheres worked on together.
const CHUNK: usize = 16;
/// Chunks between two looks at the caller's cancel and at the memory.
const GROUP: usize = 64;
/// Slices of a sphere in which its exposed area is exact.
const SLICES: usize = 96;
/// Of more caps than this, those about a direction are found by the tree.
const MANY: usize = 96;

/// The part of a sphere that another hides: directions d with d · axis > cos.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cap {
    pub axis: Vec3,
    pub cos: f64,
    /// The sphere that hides.
    pub by: u32,
}

/// A union of spheres.
pub(super) struct Union<'a> {
    pub spheres: &'a [Sphere],
    /// Spheres that lie wholly in one other; of equal ones, all but the first.
    pub swallowed: Vec<bool>,
    /// Caps of each sphere, the most hiding first, without most that hide nothing alone.
    pub caps: Vec<Vec<Cap>>,
    /// Spheres that are wholly hidden: some of them, told early.
    hidden: Vec<bool>,
    /// Exposed arcs on each sphere; an arc is listed with both its spheres.
    pub arcs: Vec<Vec<Arc>>,
    /// Over those that are not swallowed, and over those that are exposed.
    tree: Tree,
    shown: Tree,
}

impl<'a> Union<'a> {
    /// Refused where the caps may take more than `limit` bytes.
    pub(super) fn new(spheres: &'a [Sphere], limit: u64, run: &Run) -> Result<Self> {
        let n = spheres.len();
        let all = Tree::new(spheres, |_| true)?;
        let swallowed = each(n, run, |i| is_swallowed(spheres, &all, i))?;
        drop(all);
        let tree = Tree::new(spheres, |i| !swallowed.get(i).is_some_and(|s| *s))?;
        let neighbours = |i: usize, f: &mut dyn FnMut(Cap)| {
            let a = &spheres[i];
            let r = Vec3::repeat(a.radius);
            let (lo, hi) = (a.center - r, a.center + r);
            let meets = |l: &Vec3, h: &Vec3| (0..3).all(|k| l[k] <= hi[k] && lo[k] <= h[k]);
            tree.any(meets, |j| {
                if j as usize != i
                    && let Some(cap) = cap(a, &spheres[j as usize], j)
                {
                    f(cap);
                }
                false
            });
        };
        let mut caps: Vec<(Vec<Cap>, bool)> = filled("caps", n, (Vec::new(), false))?;
        let mut bytes = 2 * tree.bytes() + (n * 2 * size_of::<(Vec<Cap>, bool)>()) as u64;
        // On each thread, all caps of a sphere and what is left of them.
        bytes += (run.pool().threads() * 4 * n * size_of::<Cap>()) as u64;
        for (g, group) in caps.chunks_mut(GROUP * CHUNK).enumerate() {
            run.check(0.0, "measuring the surface")?;
            let first = g * GROUP * CHUNK;
            run.pool().chunks_mut(group, CHUNK, |c, lists| {
                let mut matter = Matter::default();
                for (k, (list, hidden)) in lists.iter_mut().enumerate() {
                    let i = first + c * CHUNK + k;
                    if !swallowed[i] {
                        matter.begin();
                        neighbours(i, &mut |cap| matter.add(cap));
                        (*list, *hidden) = matter.take();
                    }
                }
            });
            bytes += group.iter().map(|l| (l.0.capacity() * size_of::<Cap>()) as u64).sum::<u64>();
            if bytes > limit {
                return Err(Error::MemoryLimit(format!(
                    "the places where {n} spheres meet may take more than {bytes} bytes; {limit} \
                     are left of the limit"
                )));
            }
        }
        let (caps, hidden): (Vec<Vec<Cap>>, Vec<bool>) = caps.into_iter().unzip();
        let found = each(n, run, |i| arcs_of(spheres, &caps, &hidden, i))?;
        let mut arcs: Vec<Vec<Arc>> = filled("arcs", n, Vec::new())?;
        for (i, j, arc) in found.into_iter().flatten() {
            arcs[i as usize].push(arc);
            arcs[j as usize].push(arc);
        }
        let free = |i: usize| !swallowed[i] && (caps[i].is_empty() || !arcs[i].is_empty());
        let shown = Tree::new(spheres, free)?;
        Ok(Union { spheres, swallowed, caps, hidden, arcs, tree, shown })
    }

    /// Bytes that it holds.
    pub(super) fn bytes(&self) -> u64 {
        let caps: usize = self.caps.iter().map(|c| c.capacity() * size_of::<Cap>()).sum();
        let arcs: usize = self.arcs.iter().map(|a| a.capacity() * size_of::<Arc>()).sum();
        let lists = self.spheres.len() * (2 * size_of::<Vec<Cap>>() + 2);
        (caps + arcs + lists) as u64 + self.tree.bytes() + self.shown.bytes()
    }

    /// Whether `test` holds for a cap of sphere `i` that may hold the direction `d`.
    fn any_cap(&self, i: usize, d: &Vec3, mut test: impl FnMut(&Cap) -> bool) -> bool {
        let caps = &self.caps[i];
        if caps.len() <= MANY {
            return caps.iter().any(test);
        }
        let s = &self.spheres[i];
        self.tree.any_about(&(s.center + d * s.radius), |j| {
            j as usize != i && cap(s, &self.spheres[j as usize], j).is_some_and(|c| test(&c))
        })
    }

    /// Whether sphere `i` is known to be wholly hidden.
    fn never(&self, i: usize) -> bool {
        self.swallowed[i] || self.hidden[i]
    }

    /// Whether the point of sphere `i` in direction `d` is in no other sphere.
    pub(super) fn exposed(&self, i: usize, d: &Vec3) -> bool {
        !self.never(i) && !self.any_cap(i, d, |c| d.dot(&c.axis) > c.cos)
    }

    /// Whether one other sphere hides all points of sphere `i` whose direction is within the
    /// angle of cosine `cos` (at most 90°) from `d`.
    pub(super) fn hides(&self, i: usize, d: &Vec3, cos: f64) -> bool {
        self.never(i) || self.any_cap(i, d, |c| c.holds(d, cos, 0.0))
    }

    /// Exposed area of sphere `i`: exact in each of [`SLICES`] slices of equal area, whose axis
    /// is of no meaning.
    pub(super) fn area(&self, i: usize) -> f64 {
        let r = self.spheres[i].radius;
        if self.never(i) {
            return 0.0;
        }
        if self.caps[i].is_empty() {
            return 4.0 * PI * r * r;
        }
        let axis = Vec3::new(0.376, 0.513, 0.771).normalize();
        let e1 = axis.cross(&Vec3::x()).normalize();
        let e2 = axis.cross(&e1);
        let mut hidden = Vec::new();
        let mut sum = 0.0;
        for k in 0..SLICES {
            let z = (2 * k + 1) as f64 / SLICES as f64 - 1.0;
            let s = (1.0 - z * z).sqrt();
            hidden.clear();
            let mut whole = false;
            for c in &self.caps[i] {
                let (x, y) = (s * c.axis.dot(&e1), s * c.axis.dot(&e2));
                match beyond(x, y, c.cos - z * c.axis.dot(&axis)) {
                    Part::All => whole = true,
                    Part::None => {}
                    Part::Arc(middle, half) => hidden.push((middle, half)),
                }
                if whole {
                    break;
                }
            }
            if !whole {
                sum += free(&mut hidden).iter().map(|a| a.1).sum::<f64>();
            }
        }
        r * r * sum * 2.0 / SLICES as f64
    }

    /// Whether some point of sphere `i` is in no other sphere. The exposed part is open; where
    /// it is not the whole sphere, exposed arcs are its border.
    pub(super) fn ever_exposed(&self, i: usize) -> bool {
        !self.swallowed[i] && (self.caps[i].is_empty() || !self.arcs[i].is_empty())
    }

    /// The nearest point of the union's surface and its distance. It lies straight towards or
    /// away from a centre, or on an arc where two spheres meet: the nearest sphere surfaces
    /// first, up to the first that is no nearer than what was found.
    pub(super) fn nearest(&self, p: &Vec3) -> (Vec3, f64) {
        let (point, distance, _) = self.nearest_of(p);
        (point, distance)
    }

    /// The same, and the sphere on which it lies, where that is not on an arc.
    fn nearest_of(&self, p: &Vec3) -> (Vec3, f64, Option<usize>) {
        let mut best = (*p, f64::MAX);
        let mut on = None;
        let away = |i: u32| {
            let s = &self.spheres[i as usize];
            ((p - s.center).norm() - s.radius).abs()
        };
        self.shown.nearest_first(p, away, |i, e| {
            let s = &self.spheres[i as usize];
            let w = p - s.center;
            let length = w.norm();
            let d = if length > 0.0 { w / length } else { Vec3::x() };
            if self.exposed(i as usize, &d) {
                if e < best.1 {
                    best = (s.center + d * s.radius, e);
                    on = Some(i as usize);
                }
            } else {
                let before = best.1;
                for arc in &self.arcs[i as usize] {
                    arc.nearer(p, &mut best);
                }
                if best.1 < before {
                    on = None;
                }
            }
            best.1
        });
        (best.0, best.1, on)
    }

    /// How far the middle of a triangle is from the union's surface, and a distance that none of
    /// its points exceeds.
    pub(super) fn reach(&self, t: &[Vec3; 3]) -> (f64, f64) {
        let c = (t[0] + t[1] + t[2]) / 3.0;
        let (x, distance, on) = self.nearest_of(&c);
        let wide = t.iter().map(|v| (v - c).norm()).fold(0.0, f64::max);
        let farthest = t.iter().map(|v| (v - x).norm()).fold(0.0, f64::max);
        let mut bound = farthest.min(distance + wide);
        // Straight above or below a part of a sphere that is all exposed, the distance is that
        // from the sphere: to the second order of the triangle's size.
        if let Some(i) = on {
            let s = &self.spheres[i];
            let middle = (c - s.center).normalize();
            let ways = t.map(|v| v - s.center);
            let along = ways.map(|w| w.dot(&middle));
            let cos = ways.iter().zip(along).map(|(w, a)| a / w.norm()).fold(1.0, f64::min);
            if cos > 0.5 && !self.any_cap_beside(i, &middle, cos) {
                let over = ways.iter().map(|w| w.norm()).fold(0.0, f64::max) - s.radius;
                let under = s.radius - along.into_iter().fold(f64::MAX, f64::min);
                bound = bound.min(over.max(under).max(distance));
            }
        }
        (distance, bound)
    }

    /// Whether something hides a point of sphere `i` in a direction within the angle of cosine
    /// `cos` from `d`, as far as caps one by one tell.
    fn any_cap_beside(&self, i: usize, d: &Vec3, cos: f64) -> bool {
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        self.caps[i].iter().any(|c| {
            let x = d.dot(&c.axis).clamp(-1.0, 1.0);
            x >= cos || x * cos + (1.0 - x * x).sqrt() * sin > c.cos - 1e-12
        })
    }
}

impl Cap {
    /// Whether the cap holds all directions within the angle of cosine `cos` from `d`, and some
    /// more in cosine: the angle to its middle and that angle are together less than its own,
    /// and less than 180°.
    pub(super) fn holds(&self, d: &Vec3, cos: f64, more: f64) -> bool {
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let x = d.dot(&self.axis).clamp(-1.0, 1.0);
        x > -cos && x * cos - (1.0 - x * x).sqrt() * sin > self.cos + more
    }
}

/// What `b`, of index `by`, hides of `a`, neither of which swallows the other.
fn cap(a: &Sphere, b: &Sphere, by: u32) -> Option<Cap> {
    let w = b.center - a.center;
    let d2 = w.norm_squared();
    if d2 >= (a.radius + b.radius).powi(2) || d2 == 0.0 {
        return None;
    }
    let d = d2.sqrt();
    let cos = (d + (a.radius - b.radius) / d * (a.radius + b.radius)) / (2.0 * a.radius);
    Some(Cap { axis: w / d, cos, by })
}

/// `f(0), f(1), …, f(n−1)`, with looks at the caller's cancel between.
fn each<T: Send>(n: usize, run: &Run, f: impl Fn(usize) -> T + Sync + Send) -> Result<Vec<T>> {
    let mut out = crate::error::reserve("spheres", n)?;
    for first in (0..n).step_by(GROUP * CHUNK) {
        run.check(0.0, "measuring the surface")?;
        let last = n.min(first + GROUP * CHUNK);
        let found = run.pool().map((last - first).div_ceil(CHUNK), |c| {
            let from = first + c * CHUNK;
            (from..last.min(from + CHUNK)).map(&f).collect::<Vec<T>>()
        });
        out.extend(found.into_iter().flatten());
    }
    Ok(out)
}

fn is_swallowed(spheres: &[Sphere], tree: &Tree, i: usize) -> bool {
    let a = &spheres[i];
    tree.any_about(&a.center, |j| {
        let b = &spheres[j as usize];
        let room = b.radius - a.radius;
        if j as usize == i || room < 0.0 {
            return false;
        }
        let d2 = (b.center - a.center).norm_squared();
        // Equal spheres: the first stays.
        d2 <= room * room && (room > 0.0 || (j as usize) < i)
    })
}

#[cfg(test)]
#[path = "union_tests.rs"]
mod tests;
