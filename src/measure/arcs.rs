//! Arcs of circles: where two spheres meet and no third hides it.

use super::union::Cap;
use crate::math::{Sphere, Vec3};
use std::f64::consts::TAU;

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

impl Arc {
    /// The point at `t` of the sweep, 0 to 1.
    pub(super) fn point(&self, t: f64) -> Vec3 {
        let (sin, cos) = (self.from + t * self.sweep).sin_cos();
        self.center + (self.e1 * cos + self.e2 * sin) * self.radius
    }

    /// Replaces `best` when a point of the arc is nearer to `p`.
    pub(super) fn nearer(&self, p: &Vec3, best: &mut (Vec3, f64)) {
        let q = p - self.center;
        let (x, y, h) = (q.dot(&self.e1), q.dot(&self.e2), q.dot(&self.axis));
        let flat = x.hypot(y) - self.radius;
        // So far there may be none, as far away as numbers go.
        let reach = best.1.min(1e150);
        if flat * flat + h * h >= reach * reach {
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

/// Two unit vectors that make a right-handed frame with `axis`.
fn across(axis: &Vec3) -> (Vec3, Vec3) {
    let mut pick = Vec3::zeros();
    pick[axis.iamin()] = 1.0;
    let e1 = axis.cross(&pick).normalize();
    (e1, axis.cross(&e1))
}

/// Exposed arcs of sphere `i` with neighbours that have more caps (of as many, the later).
/// `never`: spheres that are wholly hidden.
pub(super) fn arcs_of(
    spheres: &[Sphere],
    caps: &[Vec<Cap>],
    never: &[bool],
    i: usize,
) -> Vec<(u32, u32, Arc)> {
    let s = &spheres[i];
    let mut out = Vec::new();
    if never[i] {
        return out;
    }
    let mut hidden = Vec::new();
    let rank = |i: usize| (caps[i].len(), i);
    let later = |c: &&Cap| !never[c.by as usize] && rank(c.by as usize) > rank(i);
    'caps: for c in caps[i].iter().filter(later) {
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
pub(super) enum Part {
    None,
    All,
    /// Middle and half length.
    Arc(f64, f64),
}

pub(super) fn beyond(x: f64, y: f64, least: f64) -> Part {
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
pub(super) fn free(hidden: &mut [(f64, f64)]) -> Vec<(f64, f64)> {
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
