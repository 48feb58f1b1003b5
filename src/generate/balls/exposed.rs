//! What a sphere's exposed surface says about where the sphere should go: the normal equations of
//! a Gauss–Newton step with Huber's loss on the signed distance.

use super::among::{self, Hiders, among};
use super::field::Field;
use crate::generate::ball::Ball;
use wide::f32x8;

/// What overlap and protrusion weigh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Weights {
    /// Of target that is covered.
    pub inside: f32,
    /// Of clump beyond the target.
    pub outside: f32,
    /// Of the square of the distance, for a unit of length.
    pub square: f32,
}

impl Weights {
    /// Those for which the least w_out |C∖S| − w_in |S∩C| is the least D, near this D, when clump
    /// beyond the target counts `overshoot` times.
    pub(crate) fn at(mismatch: f64, overshoot: f64) -> Weights {
        let outside = ((1.0 - mismatch) * overshoot) as f32;
        Weights { inside: (1.0 + mismatch) as f32, outside, square: 0.0 }
    }
}

/// Of more neighbours, those that hid most before are asked first.
const FEW: usize = 64;

/// Directions that a neighbour hides: d · axis > cos.
#[derive(Debug, Clone, Copy)]
struct Cap {
    axis: [f32; 3],
    cos: f32,
}

/// The normal equations `M δ = b` for a change of centre and radius: the upper triangle of M,
/// row after row, and b.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Normal {
    pub m: [f64; 10],
    pub b: [f64; 4],
    /// Directions that are exposed.
    pub exposed: usize,
}

/// Buffers of [`Sampler::normal`].
#[derive(Debug, Default, Clone)]
pub(crate) struct Scratch {
    caps: Vec<Cap>,
    open: [Vec<f32>; 3],
    among: among::Buffers,
}

/// What all spheres of an iteration have in common.
pub(crate) struct Sampler<'a> {
    pub field: &'a Field,
    /// Directions, turned.
    pub directions: &'a [[f32x8; 3]],
    pub weights: Weights,
    /// Huber's width.
    pub width: f32,
}

impl Sampler<'_> {
    /// The normal equations of `ball` among `others`.
    pub(crate) fn normal<'b>(
        &self,
        ball: &Ball,
        others: impl Iterator<Item = &'b Ball>,
        scratch: &mut Scratch,
    ) -> Normal {
        let Scratch { caps, open, .. } = scratch;
        if !caps_of(ball, others, caps) {
            return Normal::default();
        }
        let exposed = exposed(self.directions, caps, open);
        self.sum(ball, open, exposed)
    }

    /// The same for ball `i` of `balls` among others by their numbers, which may be very many.
    pub(crate) fn normal_among(
        &self,
        (i, balls): (u32, &[Ball]),
        others: [&[u32]; 2],
        hiders: &mut Hiders,
        scratch: &mut Scratch,
    ) -> Normal {
        let ball = &balls[i as usize];
        if others[0].len() + others[1].len() <= FEW {
            let others = others.into_iter().flatten().map(|&j| &balls[j as usize]);
            return self.normal(ball, others, scratch);
        }
        let Scratch { open, among: buffers, .. } = scratch;
        let exposed = among(ball, balls, others, self.directions, hiders, buffers, open);
        self.sum(ball, open, exposed)
    }

    /// Sums over the open directions. Where the field is f, the sample's weight w is that of
    /// inside or outside and v = (d, 1): M = Σ w v vᵀ, b = −Σ w clamp(f, ±e) v;
    /// with the weight q of the square, w + e q and w clamp(f, ±e) + e q f.
    fn sum(&self, ball: &Ball, open: &[Vec<f32>; 3], exposed: usize) -> Normal {
        let zero = f32x8::splat(0.0);
        let (mut m, mut b) = ([zero; 10], [zero; 4]);
        let width = f32x8::splat(self.width);
        let (inside, outside) =
            (f32x8::splat(self.weights.inside), f32x8::splat(self.weights.outside));
        let [cx, cy, cz] = ball.center;
        let radius = f32x8::splat(ball.radius);
        let [ox, oy, oz] = open;
        let groups = ox.chunks_exact(8).zip(oy.chunks_exact(8)).zip(oz.chunks_exact(8));
        for (g, ((x, y), z)) in groups.take(exposed.div_ceil(8)).enumerate() {
            let (x, y, z) = (f32x8::from(x), f32x8::from(y), f32x8::from(z));
            let f = self.field.at([x * radius + cx, y * radius + cy, z * radius + cz]);
            let mut w = outside ^ (f.simd_lt(zero) & (inside ^ outside));
            let mut there = f32x8::splat(1.0);
            if 8 * g + 8 > exposed {
                let mut some = [0.0; 8];
                some[..exposed - 8 * g].fill(1.0);
                there = f32x8::new(some);
                w *= there;
            }
            let mut pull = w * f.fast_max(-width).fast_min(width);
            if self.weights.square > 0.0 {
                let square = there * (self.width * self.weights.square);
                pull += square * f;
                w += square;
            }
            let (wx, wy, wz) = (w * x, w * y, w * z);
            m[0] += wx * x;
            m[1] += wx * y;
            m[2] += wx * z;
            m[3] += wx;
            m[4] += wy * y;
            m[5] += wy * z;
            m[6] += wy;
            m[7] += wz * z;
            m[8] += wz;
            m[9] += w;
            b[0] -= pull * x;
            b[1] -= pull * y;
            b[2] -= pull * z;
            b[3] -= pull;
        }
        let mut out = Normal { exposed, ..Normal::default() };
        let total = |v: &f32x8| v.to_array().iter().map(|&x| f64::from(x)).sum::<f64>();
        out.m.iter_mut().zip(&m).for_each(|(to, v)| *to = total(v));
        out.b.iter_mut().zip(&b).for_each(|(to, v)| *to = total(v));
        out
    }
}

/// The exposed directions, and how many; what comes after them is of no meaning.
fn exposed(directions: &[[f32x8; 3]], caps: &mut [Cap], open: &mut [Vec<f32>; 3]) -> usize {
    let [ox, oy, oz] = open;
    for v in [&mut *ox, &mut *oy, &mut *oz] {
        v.clear();
        v.resize(8 * directions.len() + 8, 0.0);
    }
    let mut n = 0;
    for [x, y, z] in directions {
        let mut hidden = 0u32;
        let last = caps.iter().position(|c| {
            let dot = *x * c.axis[0] + *y * c.axis[1] + *z * c.axis[2];
            hidden |= dot.simd_gt(f32x8::splat(c.cos)).to_bitmask();
            hidden == 0xff
        });
        if let Some(last) = last {
            // The next group is near: likely the same cap hides it.
            caps.swap(0, last);
            continue;
        }
        let (x, y, z) = (x.to_array(), y.to_array(), z.to_array());
        let (tx, ty, tz) = (&mut ox[n..n + 8], &mut oy[n..n + 8], &mut oz[n..n + 8]);
        if hidden == 0 {
            tx.copy_from_slice(&x);
            ty.copy_from_slice(&y);
            tz.copy_from_slice(&z);
            n += 8;
            continue;
        }
        let mut k = 0;
        for l in 0..8 {
            (tx[k & 7], ty[k & 7], tz[k & 7]) = (x[l], y[l], z[l]);
            k += (!hidden >> l & 1) as usize;
        }
        n += k;
    }
    n
}

/// Sum of the exposed directions of `ball` among `others`, and how many there are.
pub(crate) fn outward<'b>(
    ball: &Ball,
    others: impl Iterator<Item = &'b Ball>,
    directions: &[[f32x8; 3]],
    scratch: &mut Scratch,
) -> ([f32; 3], f32) {
    let Scratch { caps, open, .. } = scratch;
    if !caps_of(ball, others, caps) {
        return ([0.0; 3], 0.0);
    }
    let count = exposed(directions, caps, open);
    (open.each_ref().map(|o| o.iter().take(count).sum()), count as f32)
}

/// The caps of `ball` that `others` hide; false when one hides it all.
fn caps_of<'b>(ball: &Ball, others: impl Iterator<Item = &'b Ball>, caps: &mut Vec<Cap>) -> bool {
    caps.clear();
    let r2 = ball.radius * ball.radius;
    for other in others {
        let [x, y, z] = ball.way(other);
        let apart = x * x + y * y + z * z;
        // The point in direction d is hidden when d · way > along.
        let along = (r2 + apart - other.radius * other.radius) / (2.0 * ball.radius);
        let distance = apart.sqrt();
        if along >= distance {
            continue;
        }
        if along < -distance {
            return false;
        }
        // Now the distance is greater than zero, or one of two equal balls hides nothing.
        let inverse = 1.0 / distance.max(f32::MIN_POSITIVE);
        caps.push(Cap { axis: [x * inverse, y * inverse, z * inverse], cos: along * inverse });
    }
    true
}

#[cfg(test)]
#[path = "exposed_tests.rs"]
mod tests;
