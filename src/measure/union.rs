//! The surface of a union of spheres: which part of each sphere is exposed,
//! and the nearest point of it, exactly.

use crate::error::{Result, filled, reserve};
use crate::math::{Sphere, Vec3};
use crate::run::Pool;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::{PI, TAU};

/// Spheres worked on together.
const CHUNK: usize = 16;
/// Slices of a sphere in which its exposed area is exact.
const SLICES: usize = 96;

/// The part of a sphere that another hides: directions d with d · axis > cos.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cap {
    pub axis: Vec3,
    pub cos: f64,
    /// The sphere that hides.
    pub by: u32,
}

/// An exposed arc of the circle in which two spheres meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    center: Vec3,
    axis: Vec3,
    e1: Vec3,
    e2: Vec3,
    radius: f64,
    /// From the angle `from` on, `sweep` long; 2π or more is the whole circle.
    from: f64,
    sweep: f64,
}

/// A union of spheres.
pub(super) struct Union<'a> {
    pub spheres: &'a [Sphere],
    /// Spheres that lie wholly in one other; of equal ones, all but the first.
    pub swallowed: Vec<bool>,
    /// Caps of each sphere, the most hiding first.
    pub caps: Vec<Vec<Cap>>,
    /// Exposed arcs on each sphere; an arc is listed with both its spheres.
    pub arcs: Vec<Vec<Arc>>,
}

impl<'a> Union<'a> {
    pub(super) fn new(spheres: &'a [Sphere], pool: &Pool) -> Result<Self> {
        let n = spheres.len();
        let chunks = n.div_ceil(CHUNK);
        let range = |c: usize| c * CHUNK..((c + 1) * CHUNK).min(n);
        let swallowed: Vec<bool> = pool
            .map(chunks, |c| range(c).map(|i| is_swallowed(spheres, i)).collect::<Vec<_>>())
            .concat();
        // Neighbours by a sweep along x.
        let mut order = reserve("spheres", n)?;
        order.extend((0..n as u32).filter(|&i| !swallowed[i as usize]));
        let low = |i: u32| spheres[i as usize].center.x - spheres[i as usize].radius;
        order.sort_by(|&i, &j| low(i).total_cmp(&low(j)));
        let mut caps: Vec<Vec<Cap>> = filled("caps", n, Vec::new())?;
        for (k, &i) in order.iter().enumerate() {
            let a = &spheres[i as usize];
            for &j in &order[k + 1..] {
                if low(j) >= a.center.x + a.radius {
                    break;
                }
                let b = &spheres[j as usize];
                let w = b.center - a.center;
                let d2 = w.norm_squared();
                if d2 >= (a.radius + b.radius).powi(2) || d2 == 0.0 {
                    continue;
                }
                let d = d2.sqrt();
                let axis = w / d;
                let cos = |r: f64, s: f64| (d + (r - s) / d * (r + s)) / (2.0 * r);
                caps[i as usize].push(Cap { axis, cos: cos(a.radius, b.radius), by: j });
                caps[j as usize].push(Cap { axis: -axis, cos: cos(b.radius, a.radius), by: i });
            }
        }
        for list in &mut caps {
            list.sort_by(|x, y| x.cos.total_cmp(&y.cos).then(x.by.cmp(&y.by)));
        }
        let found = pool.map(chunks, |c| {
            range(c).flat_map(|i| arcs_of(spheres, &caps, i)).collect::<Vec<(u32, u32, Arc)>>()
        });
        let mut arcs: Vec<Vec<Arc>> = filled("arcs", n, Vec::new())?;
        for (i, j, arc) in found.into_iter().flatten() {
            arcs[i as usize].push(arc);
            arcs[j as usize].push(arc);
        }
        Ok(Union { spheres, swallowed, caps, arcs })
    }

    /// Whether the point of sphere `i` in direction `d` is in no other sphere.
    pub(super) fn exposed(&self, i: usize, d: &Vec3) -> bool {
        !self.swallowed[i] && self.caps[i].iter().all(|c| d.dot(&c.axis) <= c.cos)
    }

    /// Whether one other sphere hides all points of sphere `i` whose direction is within the
    /// angle of cosine `cos` (at most 90°) from `d`.
    pub(super) fn hides(&self, i: usize, d: &Vec3, cos: f64) -> bool {
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        self.swallowed[i]
            || self.caps[i].iter().any(|c| {
                // The angle to the cap's middle plus the patch's is less than the cap's: its
                // cosine is greater, while their sum stays below 180°.
                let x = d.dot(&c.axis).clamp(-1.0, 1.0);
                x > -cos && x * cos - (1.0 - x * x).sqrt() * sin > c.cos
            })
    }

    /// Exposed area of sphere `i`: exact in each of [`SLICES`] slices of equal area, whose axis
    /// is of no meaning.
    pub(super) fn area(&self, i: usize) -> f64 {
        let r = self.spheres[i].radius;
        if self.swallowed[i] {
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
    /// there is one, its border holds a meeting point of two circles that no third cap
    /// covers, or a circle that meets none: only these are looked at.
    pub(super) fn ever_exposed(&self, i: usize) -> bool {
        let caps = &self.caps[i];
        if self.swallowed[i] {
            return false;
        }
        let free = |d: Vec3, j: usize, k: usize| {
            let mut others = caps.iter().enumerate().filter(|(l, _)| *l != j && *l != k);
            others.all(|(_, c)| d.dot(&c.axis) <= c.cos + 1e-14)
        };
        for (j, a) in caps.iter().enumerate() {
            let (e1, _) = across(&a.axis);
            if free(a.axis * a.cos + e1 * (1.0 - a.cos * a.cos).max(0.0).sqrt(), j, j) {
                return true;
            }
            for (k, b) in caps.iter().enumerate().skip(j + 1) {
                // d · a = cos a, d · b = cos b, |d| = 1.
                let ab = a.axis.dot(&b.axis);
                let det = 1.0 - ab * ab;
                if det <= 1e-14 {
                    continue;
                }
                let (x, y) = ((a.cos - ab * b.cos) / det, (b.cos - ab * a.cos) / det);
                let base = a.axis * x + b.axis * y;
                let rest = 1.0 - base.norm_squared();
                if rest <= 0.0 {
                    continue;
                }
                let out = a.axis.cross(&b.axis) * (rest / det).sqrt();
                if free(base + out, j, k) || free(base - out, j, k) {
                    return true;
                }
            }
        }
        caps.is_empty()
    }

    /// The nearest point of the union's surface and its distance. Outside: on the nearest
    /// sphere. Inside: the nearest point of the surface lies straight out from a centre, or on
    /// an arc where two spheres meet.
    pub(super) fn nearest(&self, p: &Vec3) -> (Vec3, f64) {
        let mut best = (*p, f64::MAX);
        let mut outside = true;
        for s in self.spheres {
            let w = p - s.center;
            let e = w.norm() - s.radius;
            if e <= 0.0 {
                outside = false;
                break;
            }
            if e < best.1 {
                best = (s.center + w * (s.radius / (e + s.radius)), e);
            }
        }
        if outside {
            return best;
        }
        // The nearest sphere surfaces first: the search ends at the first that is no nearer than
        // what was found. Distances are not negative, so their bits sort as they do.
        let away = |i: usize| {
            let s = &self.spheres[i];
            ((p - s.center).norm() - s.radius).abs()
        };
        let mut next: BinaryHeap<_> = (0..self.spheres.len())
            .filter(|&i| !self.swallowed[i])
            .map(|i| Reverse((away(i).to_bits(), i)))
            .collect();
        best = (*p, f64::MAX);
        while let Some(Reverse((bits, i))) = next.pop() {
            let e = f64::from_bits(bits);
            if e >= best.1 {
                break;
            }
            let s = &self.spheres[i];
            let w = p - s.center;
            let length = w.norm();
            let d = if length > 0.0 { w / length } else { Vec3::x() };
            if self.exposed(i, &d) {
                best = (s.center + d * s.radius, e);
                continue;
            }
            for arc in &self.arcs[i] {
                arc.nearer(p, &mut best);
            }
        }
        best
    }
}

impl Arc {
    /// The point at `t` of the sweep, 0 to 1.
    pub(super) fn point(&self, t: f64) -> Vec3 {
        let (sin, cos) = (self.from + t * self.sweep).sin_cos();
        self.center + (self.e1 * cos + self.e2 * sin) * self.radius
    }

    /// Replaces `best` when a point of the arc is nearer to `p`.
    fn nearer(&self, p: &Vec3, best: &mut (Vec3, f64)) {
        let q = p - self.center;
        let (x, y, h) = (q.dot(&self.e1), q.dot(&self.e2), q.dot(&self.axis));
        let flat = x.hypot(y) - self.radius;
        if flat * flat + h * h >= best.1 * best.1 {
            return;
        }
        let turn = (y.atan2(x) - self.from).rem_euclid(TAU);
        let ends = if turn <= self.sweep { [turn; 2] } else { [0.0, self.sweep] };
        for t in ends {
            let (sin, cos) = (self.from + t).sin_cos();
            let point = self.center + (self.e1 * cos + self.e2 * sin) * self.radius;
            let e = (p - point).norm();
            if e < best.1 {
                *best = (point, e);
            }
        }
    }
}

fn is_swallowed(spheres: &[Sphere], i: usize) -> bool {
    let a = &spheres[i];
    spheres.iter().enumerate().any(|(j, b)| {
        let room = b.radius - a.radius;
        if j == i || room < 0.0 {
            return false;
        }
        let d2 = (b.center - a.center).norm_squared();
        // Equal spheres: the first stays.
        d2 <= room * room && (room > 0.0 || j < i)
    })
}

/// Two unit vectors that make a right-handed frame with `axis`.
fn across(axis: &Vec3) -> (Vec3, Vec3) {
    let mut pick = Vec3::zeros();
    pick[axis.iamin()] = 1.0;
    let e1 = axis.cross(&pick).normalize();
    (e1, axis.cross(&e1))
}

/// Exposed arcs of sphere `i` with neighbours of greater index.
fn arcs_of(spheres: &[Sphere], caps: &[Vec<Cap>], i: usize) -> Vec<(u32, u32, Arc)> {
    let s = &spheres[i];
    let mut out = Vec::new();
    let mut hidden = Vec::new();
    'caps: for c in caps[i].iter().filter(|c| c.by as usize > i) {
        let sin = (1.0 - c.cos * c.cos).max(0.0).sqrt();
        let (e1, e2) = across(&c.axis);
        hidden.clear();
        for o in caps[i].iter().filter(|o| o.by != c.by) {
            let (x, y) = (sin * o.axis.dot(&e1), sin * o.axis.dot(&e2));
            match beyond(x, y, o.cos - c.cos * c.axis.dot(&o.axis)) {
                Part::All => continue 'caps,
                Part::None => {}
                Part::Arc(middle, half) => hidden.push((middle, half)),
            }
        }
        for (from, sweep) in free(&mut hidden) {
            let center = s.center + c.axis * (s.radius * c.cos);
            let radius = s.radius * sin;
            out.push((i as u32, c.by, Arc { center, axis: c.axis, e1, e2, radius, from, sweep }));
        }
    }
    out
}

/// Angles φ with x cos φ + y sin φ > least.
enum Part {
    None,
    All,
    /// Middle and half length.
    Arc(f64, f64),
}

fn beyond(x: f64, y: f64, least: f64) -> Part {
    let size = x.hypot(y);
    if least >= size {
        Part::None
    } else if least < -size {
        Part::All
    } else {
        Part::Arc(y.atan2(x), (least / size).clamp(-1.0, 1.0).acos())
    }
}

/// What arcs (middle, half length) leave free of a circle, as (start, length).
fn free(hidden: &mut [(f64, f64)]) -> Vec<(f64, f64)> {
    if hidden.is_empty() {
        return vec![(0.0, TAU)];
    }
    // As (start in 0..2π, length).
    for h in hidden.iter_mut() {
        *h = ((h.0 - h.1).rem_euclid(TAU), 2.0 * h.1);
    }
    hidden.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.total_cmp(&y.1)));
    let first = hidden[0].0;
    let mut end = first;
    let mut out = Vec::new();
    for &(start, length) in hidden.iter() {
        if start > end {
            out.push((end, start - end));
        }
        end = end.max(start + length);
    }
    if first + TAU > end {
        // Arcs that run over 2π may reach into the first gaps.
        out.push((end, first + TAU - end));
    }
    let over = end - TAU;
    if over > first {
        for gap in &mut out {
            let cut = (over - gap.0).clamp(0.0, gap.1);
            gap.0 += cut;
            gap.1 -= cut;
        }
    }
    out.retain(|g| g.1 > 0.0);
    out
}

#[cfg(test)]
#[path = "union_tests.rs"]
mod tests;
