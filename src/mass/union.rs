//! Moments of a union of spheres, exactly: integrals over the exposed part of each sphere, turned
//! into integrals along the arcs where spheres meet.
//!
//! With the divergence theorem, the integrals of 1, x and x xᵀ over the union are those of
//! x·n / 3, x (x·n) / 4 and x xᵀ (x·n) / 5 over its surface, where x = c + r n. What is left are
//! the integrals T of 1, n, n n and n n n over the exposed directions. The last three follow from
//! the surface Laplacian, Δ n = −2 n, Δ(n n) = 2·1 − 6 n n, …, as integrals along the arcs; the
//! first is the area, by Gauss and Bonnet, whose whole multiples of 2π a count of directions tells.

use super::pile::{Pile, check};
use crate::error::{Error, Result, reserve};
use crate::math::{Inertia, Moments, Sphere, UnitFrame, Vec3};
use crate::run::Run;
use nalgebra::Matrix3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Spheres worked on together.
const CHUNK: usize = 16;
/// Spheres between two looks at the caller's cancel.
const GROUP: usize = 1024;
/// Hidden angles of a circle before a first look whether they hide all of it.
const LOOK: usize = 16;
/// Directions that tell by how many times 2π an area is off.
const LOOKS: usize = 128;
/// Radii are changed by this share, each a little differently, so that no three circles meet in
/// one point and none touch; it is the error of the moments too.
const NUDGE: f64 = 1e-11;
/// Half of the ten nodes and weights of Gauss and Legendre: exact to rounding over a quarter turn.
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_3),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_1),
];
/// The entries of a symmetric tensor of the third rank.
const TRIPLES: [(usize, usize, usize); 10] = [
    (0, 0, 0),
    (0, 0, 1),
    (0, 0, 2),
    (0, 1, 1),
    (0, 1, 2),
    (0, 2, 2),
    (1, 1, 1),
    (1, 1, 2),
    (1, 2, 2),
    (2, 2, 2),
];

/// Where [`TRIPLES`] has an entry, by how many of its indices are 1 and how many 2.
fn place(i: usize, j: usize, k: usize) -> usize {
    const PLACES: [[usize; 4]; 4] = [[0, 2, 5, 9], [1, 4, 8, 0], [3, 7, 0, 0], [6, 0, 0, 0]];
    let of = |n: usize| [i, j, k].iter().filter(|x| **x == n).count();
    PLACES[of(1)][of(2)]
}

/// Volume, centre and inertia at unit density of the union of spheres, in their frame: overlaps
/// count once.
///
/// `relative_error` is 1e-10, which covers the arithmetic and the 1e-11 by which radii are
/// changed so that no arcs coincide; or ten times what the normals' integral over the closed
/// surface, which is zero, comes out as, where that is more. Refused: no sphere, a sphere that is
/// not finite or has no radius.
pub fn union_moments(spheres: &[Sphere], run: &Run) -> Result<Moments> {
    check(spheres)?;
    let (lo, hi) =
        spheres.iter().fold((Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN)), |(lo, hi), s| {
            let r = Vec3::repeat(s.radius);
            (lo.inf(&(s.center - r)), hi.sup(&(s.center + r)))
        });
    let Some(frame) = UnitFrame::of_box(lo, hi) else {
        return Err(Error::InvalidArgument(format!(
            "the box about the spheres, from ({:e}, {:e}, {:e}) to ({:e}, {:e}, {:e}), is beyond \
             the numbers",
            lo.x, lo.y, lo.z, hi.x, hi.y, hi.z
        )));
    };
    let mut unit = reserve("spheres", spheres.len())?;
    unit.extend(spheres.iter().map(|s| frame.sphere_to_unit(s)));
    Ok(frame.moments_to_input(&of_pile(&Pile::new(&unit)?, run)?))
}

/// The same for spheres of about unit size.
pub(super) fn of_pile(pile: &Pile, run: &Run) -> Result<Moments> {
    let about = middle(&pile.spheres);
    let n = pile.spheres.len();
    // A sphere alone meets nothing.
    let share = if n > 1 { NUDGE } else { 0.0 };
    let nudged =
        |i: usize, s: &Sphere| Sphere::new(s.center - about, s.radius * (1.0 + share * nudge(i)));
    let mut total = Integrals::default();
    for first in (0..n).step_by(GROUP) {
        run.check(0.0, "integrating over the union of the spheres")?;
        let last = n.min(first + GROUP);
        let found = run.pool().map((last - first).div_ceil(CHUNK), |c| {
            let from = first + c * CHUNK;
            let mut sum = Integrals::default();
            for i in from..last.min(from + CHUNK) {
                let s = nudged(i, &pile.spheres[i]);
                if let Some(caps) = caps(pile, i, &s, &nudged) {
                    sum.add_sphere(&s, &Exposed::of(&caps));
                }
            }
            sum
        });
        found.iter().for_each(|part| total.add(part));
    }
    if total.volume <= 0.0 {
        return Err(Error::ZeroVolume("the spheres have no volume".into()));
    }
    let c = total.first / total.volume;
    let second = total.second - c * c.transpose() * total.volume;
    let m = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| second[at]);
    let open = total.closure.norm() / total.area;
    Ok(Moments {
        volume: total.volume,
        centroid: about + c,
        inertia: Inertia::from_second_moments(m),
        relative_error: (10.0 * open).max(1e-10),
    })
}

/// A number in −1..1 that has nothing to do with those of other spheres (the mixing of
/// splitmix64): spheres on a lattice must not have sums that agree.
fn nudge(i: usize) -> f64 {
    let mut z = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// The middle of the spheres, weighted by volume.
fn middle(spheres: &[Sphere]) -> Vec3 {
    let (mut sum, mut weight) = (Vec3::zeros(), 0.0);
    for s in spheres {
        sum += s.center * s.volume();
        weight += s.volume();
    }
    if weight > 0.0 { sum / weight } else { spheres.first().map_or(sum, |s| s.center) }
}

/// The directions of a sphere that another hides: d · axis > cos.
struct Cap {
    axis: Vec3,
    cos: f64,
    sin: f64,
}

/// What hides parts of sphere `i`; `None` when it lies in another.
fn caps(
    pile: &Pile,
    i: usize,
    s: &Sphere,
    nudged: &impl Fn(usize, &Sphere) -> Sphere,
) -> Option<Vec<Cap>> {
    let mut caps = Vec::new();
    let mut swallowed = false;
    pile.neighbours(i, |j, o| {
        let o = nudged(j, o);
        let w = o.center - s.center;
        let d = w.norm();
        let more = o.radius - s.radius;
        // One of equal spheres is the larger by its nudge.
        if d <= more {
            swallowed = true;
        } else if d > -more && d < s.radius + o.radius && d > 0.0 {
            let cos = 0.5 * (d - more * (s.radius + o.radius) / d) / s.radius;
            if cos.abs() < 1.0 {
                caps.push(Cap { axis: w / d, cos, sin: ((1.0 - cos) * (1.0 + cos)).sqrt() });
            }
        }
    });
    if swallowed {
        return None;
    }
    // The most hiding first; those that lie in another do nothing.
    caps.sort_by(|a, b| a.cos.total_cmp(&b.cos));
    let mut kept: Vec<Cap> = Vec::new();
    for c in caps {
        let within = |k: &Cap| k.cos < c.cos && k.axis.dot(&c.axis) > k.cos * c.cos + k.sin * c.sin;
        if !kept.iter().any(within) {
            kept.push(c);
        }
    }
    Some(kept)
}

/// Integrals over exposed directions n of a sphere.
struct Exposed {
    /// ∫ 1
    t0: f64,
    /// ∫ n
    t1: Vec3,
    /// ∫ n nᵀ
    t2: Matrix3<f64>,
    /// ∫ n n n, by [`TRIPLES`].
    t3: [f64; 10],
}

/// Integrals along the border of the exposed directions, ν its normal outward.
#[derive(Default)]
struct Border {
    /// Area by Gauss and Bonnet, but for multiples of 2π.
    area: f64,
    /// ∮ ν
    b1: Vec3,
    /// ∮ n νᵀ
    b2: Matrix3<f64>,
    /// ∮ ν n n + n ν n + n n ν, by [`TRIPLES`].
    b3: [f64; 10],
}

impl Exposed {
    fn of(caps: &[Cap]) -> Exposed {
        let mut b = Border::default();
        let mut hidden = Vec::new();
        for (k, cap) in caps.iter().enumerate() {
            b.circle(caps, k, cap, &mut hidden);
        }
        let t0 = if caps.is_empty() { 4.0 * PI } else { whole(caps, b.area) };
        let t1 = b.b1 * -0.5;
        let t2 = (Matrix3::identity() * (2.0 * t0) - b.b2 - b.b2.transpose()) / 6.0;
        let mut t3 = [0.0; 10];
        for ((t, b), (i, j, k)) in t3.iter_mut().zip(b.b3).zip(TRIPLES) {
            let d = |i: usize, j: usize, k: usize| if i == j { 2.0 * t1[k] } else { 0.0 };
            *t = (d(i, j, k) + d(j, k, i) + d(i, k, j) - b) / 12.0;
        }
        Exposed { t0, t1, t2, t3 }
    }
}

/// The area that is `area` but for a multiple of 2π.
fn whole(caps: &[Cap], area: f64) -> f64 {
    let seen = (0..LOOKS)
        .filter(|&k| {
            // A spiral from pole to pole (Swinbank and Purser 2006).
            let z = (2 * k + 1) as f64 / LOOKS as f64 - 1.0;
            let s = (1.0 - z * z).sqrt();
            let (y, x) = (TAU * (0.618_033_988_749_894_9 * k as f64).fract()).sin_cos();
            let d = Vec3::new(s * x, s * y, z);
            !caps.iter().any(|c| d.dot(&c.axis) > c.cos)
        })
        .count();
    let about = 4.0 * PI * seen as f64 / LOOKS as f64;
    (area + TAU * ((about - area) / TAU).round()).max(0.0)
}

impl Border {
    /// Adds what is exposed of the circle about cap `k`.
    fn circle(&mut self, caps: &[Cap], k: usize, cap: &Cap, hidden: &mut Vec<Hidden>) {
        let Cap { axis, cos, sin } = *cap;
        let e1 = axis.cross(&if axis.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() }).normalize();
        let e2 = axis.cross(&e1);
        hidden.clear();
        let mut looked = LOOK;
        for (j, o) in caps.iter().enumerate().filter(|(j, _)| *j != k) {
            let (x, y) = (sin * o.axis.dot(&e1), sin * o.axis.dot(&e2));
            let least = o.cos - cos * axis.dot(&o.axis);
            let size = x.hypot(y);
            if least < -size {
                return;
            }
            if least < size {
                let half = (least / size).clamp(-1.0, 1.0).acos();
                let from = (y.atan2(x) - half).rem_euclid(TAU);
                hidden.push(Hidden { from, to: from + 2.0 * half, by: j });
            }
            // Few caps, the most hiding, mostly hide all: then the others need no look.
            if hidden.len() == looked {
                looked *= 2;
                if gaps(hidden, |_, _| ()) == 0 {
                    return;
                }
            }
        }
        if hidden.is_empty() {
            self.arc(cap, &e1, &e2, 0.0, TAU);
            return;
        }
        gaps(hidden, |(from, begins), (to, ends)| {
            self.arc(cap, &e1, &e2, from, to);
            for (phi, by) in [(from, begins), (to, ends)] {
                self.area -= 0.5 * turn(cap, &caps[by], &e1, &e2, phi);
            }
        });
    }

    /// Adds an arc of the circle about a cap, from angle `from` to `to`.
    fn arc(&mut self, cap: &Cap, e1: &Vec3, e2: &Vec3, from: f64, to: f64) {
        // The curvature of the border is −cos / sin, its length sin times the angle.
        self.area += cap.cos * (to - from);
        let pieces = ((to - from) / FRAC_PI_2).ceil().max(1.0);
        let half = 0.5 * (to - from) / pieces;
        for p in 0..pieces as usize {
            let middle = from + half * (2 * p + 1) as f64;
            for (x, w) in GAUSS {
                for phi in [middle - half * x, middle + half * x] {
                    let (n, nu) = on_circle(cap, e1, e2, phi);
                    self.add(&n, &(nu * (w * half * cap.sin)));
                }
            }
        }
    }

    fn add(&mut self, n: &Vec3, nu: &Vec3) {
        self.b1 += nu;
        self.b2 += n * nu.transpose();
        for (b, (i, j, k)) in self.b3.iter_mut().zip(TRIPLES) {
            *b += nu[i] * n[j] * n[k] + n[i] * nu[j] * n[k] + n[i] * n[j] * nu[k];
        }
    }
}

/// An angle of a circle that another cap hides.
struct Hidden {
    from: f64,
    to: f64,
    by: usize,
}

/// Calls `f` with the ends of what is not hidden of a circle, and the caps that end it there;
/// returns how many such arcs there are.
fn gaps(hidden: &mut [Hidden], mut f: impl FnMut((f64, usize), (f64, usize))) -> usize {
    hidden.sort_unstable_by(|p, q| p.from.total_cmp(&q.from).then(p.by.cmp(&q.by)));
    // How far those that run over a full turn reach into the next.
    let over = hidden.iter().map(|h| (h.to - TAU, h.by));
    let mut end = over.fold((f64::MIN, 0), |a, b| if b.0 > a.0 { b } else { a });
    let mut count = 0;
    for h in hidden.iter() {
        if h.from > end.0 {
            f(end, (h.from, h.by));
            count += 1;
        }
        if h.to > end.0 {
            end = (h.to, h.by);
        }
    }
    count
}

/// The direction at angle `phi` of the circle about a cap, and the normal there, into the cap.
fn on_circle(cap: &Cap, e1: &Vec3, e2: &Vec3, phi: f64) -> (Vec3, Vec3) {
    let (y, x) = phi.sin_cos();
    let across = e1 * x + e2 * y;
    (cap.axis * cap.cos + across * cap.sin, cap.axis * cap.sin - across * cap.cos)
}

/// By what angle the border turns where the circles about two caps meet: that between their normals.
fn turn(cap: &Cap, other: &Cap, e1: &Vec3, e2: &Vec3, phi: f64) -> f64 {
    let (n, nu) = on_circle(cap, e1, e2, phi);
    let mu = other.axis - n * n.dot(&other.axis);
    nu.cross(&mu).norm().atan2(nu.dot(&mu))
}

/// Integrals over the union, about a point near its middle.
#[derive(Default)]
struct Integrals {
    volume: f64,
    first: Vec3,
    second: Matrix3<f64>,
    /// ∮ n dA
    closure: Vec3,
    area: f64,
}

impl Integrals {
    fn add_sphere(&mut self, s: &Sphere, e: &Exposed) {
        let (c, r) = (s.center, s.radius);
        let a = r * r;
        let along = c.dot(&e.t1);
        let t2c = e.t2 * c;
        let t3c = Matrix3::from_fn(|i, j| (0..3).map(|k| e.t3[place(i, j, k)] * c[k]).sum());
        self.volume += a / 3.0 * (r * e.t0 + along);
        self.first += (c * (r * e.t0 + along) + e.t1 * a + t2c * r) * (a / 4.0);
        let mixed = (c * e.t1.transpose() + e.t1 * c.transpose()) * a
            + (c * t2c.transpose() + t2c * c.transpose()) * r;
        self.second +=
            (c * c.transpose() * (r * e.t0 + along) + mixed + e.t2 * (a * r) + t3c * a) * (a / 5.0);
        self.closure += e.t1 * a;
        self.area += 4.0 * PI * a;
    }

    fn add(&mut self, other: &Integrals) {
        self.volume += other.volume;
        self.first += other.first;
        self.second += other.second;
        self.closure += other.closure;
        self.area += other.area;
    }
}

#[cfg(test)]
#[path = "union_tests.rs"]
mod tests;
