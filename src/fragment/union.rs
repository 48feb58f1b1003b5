//! How deep a point lies in a union of spheres, exactly: the distance to the nearest point of what
//! is exposed. That is the nearest point of a sphere's exposed patch, of an exposed arc of a circle
//! where two spheres meet, or an end of such an arc, where three meet. The greatest depth in a
//! single sphere is less: where spheres overlap, a ball may lie in none of them and yet in all
//! together.

use crate::error::{Error, Result, collected, push, reserve};
use crate::mass::check_spheres;
use crate::math::{Sphere, Vec3};
use std::f64::consts::{PI, TAU};

/// What lies less than this below a sphere's surface (unit frame) is not hidden by it. A point is
/// then taken for exposed that is not, never the other way: depths come out too small.
const TOUCH: f64 = 1e-12;
/// Arcs that are looked at or passed over together.
const CHUNK: usize = 16;

/// A union of spheres.
#[derive(Debug)]
pub struct Union {
    /// Those that lie in no other.
    spheres: Vec<Sphere>,
    /// Of each whether some of it is exposed.
    exposed: Vec<bool>,
    /// Which overlap each: `near[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    near: Vec<u32>,
    /// Exposed arcs, neighbours in the list near each other.
    arcs: Vec<Arc>,
    /// A ball about each [`CHUNK`] of them.
    chunks: Vec<Sphere>,
}

/// An arc of the circle where two spheres meet.
#[derive(Debug, Clone, Copy)]
struct Arc {
    center: Vec3,
    radius: f64,
    /// Directions that span its plane.
    e1: Vec3,
    e2: Vec3,
    /// From angle `from`, in 0..2π, on by `span`, 2π at most.
    from: f64,
    span: f64,
    /// A ball that holds it.
    about: Sphere,
}

impl Union {
    /// Of spheres in a frame in which they are of about unit size. Refused: no sphere, a sphere
    /// that is not finite or has no radius.
    pub fn new(spheres: &[Sphere]) -> Result<Union> {
        check_spheres(spheres)?;
        let spheres = outermost(spheres)?;
        let (starts, near) = neighbours(&spheres)?;
        let mut union = Union {
            exposed: Vec::new(),
            arcs: Vec::new(),
            chunks: Vec::new(),
            spheres,
            starts,
            near,
        };
        let mut hidden = Vec::new();
        let mut bare = collected("spheres", union.spheres.iter().map(|_| false))?;
        for i in 0..union.spheres.len() {
            for at in 0..union.near_of(i).len() {
                let j = union.near_of(i)[at] as usize;
                if i < j && union.circle(i, j, &mut hidden)? {
                    bare[i] = true;
                    bare[j] = true;
                }
            }
        }
        // Without an exposed arc a sphere is exposed as a whole or not at all.
        for (i, bare) in bare.iter_mut().enumerate() {
            let s = union.spheres[i];
            *bare |= !union.hides(i, &(s.center + Vec3::x() * s.radius));
        }
        union.exposed = bare;
        gather(&mut union.arcs);
        union.chunks = collected("arcs", union.arcs.chunks(CHUNK).map(ball_about))?;
        Ok(union)
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> u64 {
        let of = |n: usize, size: usize| (n * size) as u64;
        of(self.spheres.len(), size_of::<Sphere>() + 1)
            + of(self.starts.len() + self.near.len(), 4)
            + of(self.arcs.len(), size_of::<Arc>())
            + of(self.chunks.len(), size_of::<Sphere>())
    }

    /// How deep `p` lies in the union: the radius of the largest ball about it that leaves the
    /// union nowhere, but for rounding. Outside, the distance to the nearest sphere, negative.
    pub fn depth(&self, p: &Vec3) -> f64 {
        self.nearest(p).0
    }

    /// The same, and the nearest exposed point; outside the nearest of a sphere.
    pub fn nearest(&self, p: &Vec3) -> (f64, Vec3) {
        let (mut most, mut deepest) = (f64::MIN, 0);
        for (i, s) in self.spheres.iter().enumerate() {
            let depth = s.radius - (p - s.center).norm();
            if depth > most {
                (most, deepest) = (depth, i);
            }
        }
        // Nothing exposed is nearer than the surface of a sphere about the point.
        if most <= 0.0 || self.open(deepest, p) {
            return (most, self.below(deepest, p));
        }
        let (mut least, mut found) = (f64::MAX, None);
        for (i, s) in self.spheres.iter().enumerate() {
            let depth = s.radius - (p - s.center).norm();
            // From outside a sphere, what is exposed of others is met before it.
            if depth > 0.0 && depth < least && self.open(i, p) {
                (least, found) = (depth, Some(self.below(i, p)));
            }
        }
        for (chunk, arcs) in self.chunks.iter().zip(self.arcs.chunks(CHUNK)) {
            if (p - chunk.center).norm() - chunk.radius >= least {
                continue;
            }
            for arc in arcs {
                if (p - arc.about.center).norm() - arc.about.radius < least {
                    let point = arc.nearest(p);
                    let distance = (p - point).norm();
                    if distance < least {
                        (least, found) = (distance, Some(point));
                    }
                }
            }
        }
        // Without any arc a sphere about the point is exposed as a whole.
        found.map_or_else(|| (most, self.below(deepest, p)), |point| (least, point))
    }

    /// The point of sphere `i` nearest to `p`.
    fn below(&self, i: usize, p: &Vec3) -> Vec3 {
        let s = &self.spheres[i];
        let way = p - s.center;
        let apart = way.norm();
        let unit = way / apart.max(f64::MIN_POSITIVE);
        let way = if apart <= f64::MIN_POSITIVE { Vec3::x() } else { unit };
        s.center + way * s.radius
    }

    /// Whether the point of sphere `i` nearest to `p` is exposed; about its centre, any point.
    fn open(&self, i: usize, p: &Vec3) -> bool {
        if (p - self.spheres[i].center).norm() <= f64::MIN_POSITIVE {
            return self.exposed[i];
        }
        !self.hides(i, &self.below(i, p))
    }

    /// Whether a point of sphere `i` lies in another.
    fn hides(&self, i: usize, q: &Vec3) -> bool {
        let within = |j: &u32| {
            let o = &self.spheres[*j as usize];
            (q - o.center).norm() < o.radius - TOUCH
        };
        self.near_of(i).iter().any(within)
    }

    fn near_of(&self, i: usize) -> &[u32] {
        &self.near[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// Adds what is exposed of the circle where spheres `i` and `j` meet, and says whether there
    /// is any.
    fn circle(&mut self, i: usize, j: usize, hidden: &mut Vec<[f64; 2]>) -> Result<bool> {
        let (a, b) = (self.spheres[i], self.spheres[j]);
        let way = b.center - a.center;
        let apart = way.norm();
        if apart <= 0.0 {
            return Ok(false);
        }
        let along = 0.5 * (apart + (a.radius - b.radius) * (a.radius + b.radius) / apart);
        let radius2 = (a.radius - along) * (a.radius + along);
        if radius2 <= 0.0 {
            return Ok(false);
        }
        let (axis, radius) = (way / apart, radius2.sqrt());
        let center = a.center + axis * along;
        let e1 = axis.cross(&if axis.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() }).normalize();
        let e2 = axis.cross(&e1);
        hidden.clear();
        for &k in self.near_of(i) {
            if k as usize == j {
                continue;
            }
            // Hidden where (c − m)·(e1 cos φ + e2 sin φ) is more than this.
            let s = &self.spheres[k as usize];
            let to = s.center - center;
            let kept = (s.radius - TOUCH).max(0.0);
            let least = 0.5 * (radius + (to.norm_squared() - kept * kept) / radius);
            let (x, y) = (to.dot(&e1), to.dot(&e2));
            let size = x.hypot(y);
            if least >= size {
                continue;
            }
            if least <= -size {
                return Ok(false);
            }
            let half = (least / size).acos();
            let from = (y.atan2(x) - half).rem_euclid(TAU);
            push("arcs", hidden, [from, from + 2.0 * half])?;
        }
        let before = self.arcs.len();
        let circle = Arc {
            center,
            radius,
            e1,
            e2,
            from: 0.0,
            span: TAU,
            about: Sphere::new(center, radius),
        };
        if hidden.is_empty() {
            push("arcs", &mut self.arcs, circle)?;
        }
        hidden.sort_unstable_by(|p, q| p[0].total_cmp(&q[0]));
        // How far those that run over a full turn reach into the next.
        let mut end = hidden.iter().map(|h| h[1] - TAU).fold(f64::MIN, f64::max);
        for h in hidden.iter() {
            if h[0] > end {
                push("arcs", &mut self.arcs, circle.part(end, h[0] - end))?;
            }
            end = end.max(h[1]);
        }
        Ok(self.arcs.len() > before)
    }
}

impl Arc {
    fn at(&self, angle: f64) -> Vec3 {
        let (y, x) = angle.sin_cos();
        self.center + (self.e1 * x + self.e2 * y) * self.radius
    }

    /// The part from an angle on.
    fn part(&self, from: f64, span: f64) -> Arc {
        let middle = self.at(from + 0.5 * span);
        let about = if span < PI {
            // Over the chord at the middle, a little larger for rounding.
            let reach = 2.0 * self.radius * (0.25 * span).sin();
            Sphere::new(middle, reach * (1.0 + 1e-12))
        } else {
            self.about
        };
        Arc { from: from.rem_euclid(TAU), span, about, ..*self }
    }

    fn nearest(&self, p: &Vec3) -> Vec3 {
        let to = p - self.center;
        let (x, y) = (to.dot(&self.e1), to.dot(&self.e2));
        let angle = if x == 0.0 && y == 0.0 { self.from } else { y.atan2(x) };
        if (angle - self.from).rem_euclid(TAU) <= self.span {
            return self.at(angle);
        }
        let ends = [self.at(self.from), self.at(self.from + self.span)];
        let [a, b] = ends.map(|q| (p - q).norm_squared());
        if a <= b { ends[0] } else { ends[1] }
    }
}

/// A ball about some arcs.
fn ball_about(arcs: &[Arc]) -> Sphere {
    let sum: Vec3 = arcs.iter().map(|a| a.about.center).sum();
    let center = sum / arcs.len().max(1) as f64;
    let reach = |a: &Arc| (a.about.center - center).norm() + a.about.radius;
    Sphere::new(center, arcs.iter().map(reach).fold(0.0, f64::max))
}

/// Sorts so that arcs next to each other in the list are near each other.
fn gather(arcs: &mut [Arc]) {
    if arcs.len() <= CHUNK {
        return;
    }
    let ends = arcs.iter().fold([Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN)], |[l, h], a| {
        [l.inf(&a.about.center), h.sup(&a.about.center)]
    });
    let longest = (ends[1] - ends[0]).imax();
    let half = arcs.len().div_ceil(2 * CHUNK) * CHUNK;
    let by = |a: &Arc| a.about.center[longest];
    arcs.select_nth_unstable_by(half, |a, b| by(a).total_cmp(&by(b)));
    let (low, high) = arcs.split_at_mut(half);
    gather(low);
    gather(high);
}

/// The spheres that lie in no other, by rising x.
fn outermost(spheres: &[Sphere]) -> Result<Vec<Sphere>> {
    let mut sorted = collected("spheres", spheres.iter().copied())?;
    // The larger first, so that of equal spheres one is left and what holds another comes before.
    sorted.sort_by(|a, b| b.radius.total_cmp(&a.radius));
    let mut kept: Vec<Sphere> = reserve("spheres", sorted.len())?;
    for s in sorted {
        let holds = |o: &Sphere| {
            let room = o.radius - s.radius + TOUCH;
            (o.center - s.center).norm_squared() <= room * room
        };
        if !kept.iter().any(holds) {
            kept.push(s);
        }
    }
    kept.sort_by(|a, b| a.center.x.total_cmp(&b.center.x));
    Ok(kept)
}

/// Which of the spheres, sorted by x, overlap.
fn neighbours(spheres: &[Sphere]) -> Result<(Vec<u32>, Vec<u32>)> {
    let largest = spheres.iter().map(|s| s.radius).fold(0.0, f64::max);
    let mut starts = reserve("neighbours", spheres.len() + 1)?;
    let mut near = Vec::new();
    starts.push(0);
    for (i, s) in spheres.iter().enumerate() {
        let reach = s.radius + largest;
        let from = spheres.partition_point(|o| o.center.x < s.center.x - reach);
        for (j, o) in spheres.iter().enumerate().skip(from) {
            if o.center.x > s.center.x + reach {
                break;
            }
            let touch = s.radius + o.radius - TOUCH;
            if i != j && (o.center - s.center).norm_squared() < touch * touch {
                push("neighbours", &mut near, j as u32)?;
            }
        }
        let end = u32::try_from(near.len())
            .map_err(|_| Error::TooLarge("the spheres have too many overlaps".into()))?;
        starts.push(end);
    }
    Ok((starts, near))
}

#[cfg(test)]
#[path = "union_tests.rs"]
mod tests;
