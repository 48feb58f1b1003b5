//! Free rotation of a rigid body.
//!
//! The angular momentum in the space frame stays as it is, so that it is conserved at any step; only
//! the orientation moves. The splitting (Dullweber, Leimkuhler and McLachlan 1997; NO_SQUISH of Miller et al.
//! 2002) turns about the body's axes one after the other, 3 2 1 2 3, each by its exact angle: symplectic
//! and time-reversible. The exact rotation follows Euler's equations by power series, to rounding.
//!
//! A turn is kept as what it differs from none, (w − 1, x, y, z), and added to the quaternion with the
//! rounding error carried along: turns of 1e-12 rad a step, and far smaller ones, add up.

use crate::math::Vec3;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};

/// A unit quaternion `w, x, y, z` from the body's axes to those of space, with what rounding leaves of it.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Orientation {
    /// `w, x, y, z`.
    pub quaternion: [f64; 4],
    /// What is to be added to it.
    pub rest: [f64; 4],
}

/// What a turn differs from none: (w − 1, x, y, z).
type Turn = [f64; 4];

impl Orientation {
    /// From a quaternion `w, x, y, z` of any length but 0; `None` for 0 or what is not finite.
    pub fn new(quaternion: [f64; 4]) -> Option<Orientation> {
        let most = quaternion.iter().fold(0.0f64, |m, c| m.max(c.abs()));
        if !(quaternion.iter().all(|c| c.is_finite()) && most > 0.0) {
            return None;
        }
        let [w, x, y, z] = quaternion.map(|c| c / most);
        let q = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        Some(Orientation { quaternion: [q.w, q.i, q.j, q.k], rest: [0.0; 4] })
    }

    /// No turn.
    pub fn identity() -> Orientation {
        Orientation { quaternion: [1.0, 0.0, 0.0, 0.0], rest: [0.0; 4] }
    }

    /// The rotation matrix, body to space.
    pub fn matrix(&self) -> Matrix3<f64> {
        let [w, x, y, z] = self.quaternion;
        let (xx, yy, zz) = (x * x, y * y, z * z);
        let (xy, xz, yz) = (x * y, x * z, y * z);
        let (wx, wy, wz) = (w * x, w * y, w * z);
        Matrix3::new(
            1.0 - 2.0 * (yy + zz),
            2.0 * (xy - wz),
            2.0 * (xz + wy),
            2.0 * (xy + wz),
            1.0 - 2.0 * (xx + zz),
            2.0 * (yz - wx),
            2.0 * (xz - wy),
            2.0 * (yz + wx),
            1.0 - 2.0 * (xx + yy),
        )
    }

    /// Appends a turn about axes of the body.
    pub(crate) fn turn(&mut self, t: &Turn) {
        let [w, x, y, z] = self.quaternion;
        let [tw, tx, ty, tz] = *t;
        let rest = self.rest;
        // How much too long it is: towards unit length at once.
        let length = (w * w - 1.0) + x * x + y * y + z * z;
        let more = 2.0 * (w * rest[0] + x * rest[1] + y * rest[2] + z * rest[3]);
        let tw = tw - 0.5 * (length + more);
        let change = [
            w * tw - x * tx - y * ty - z * tz,
            w * tx + x * tw + y * tz - z * ty,
            w * ty - x * tz + y * tw + z * tx,
            w * tz + x * ty - y * tx + z * tw,
        ];
        for k in 0..4 {
            // Knuth's sum: `rest` is what the rounded one lacks.
            let (a, b) = (self.quaternion[k], change[k] + rest[k]);
            let sum = a + b;
            let of_b = sum - a;
            self.quaternion[k] = sum;
            self.rest[k] = (a - (sum - of_b)) + (b - of_b);
        }
    }
}

/// sin x and cos x − 1.
#[inline]
fn half(x: f64) -> (f64, f64) {
    let y = x * x;
    if y < 2.5e-3 {
        let s =
            x * (1.0 + y * (-1.0 / 6.0 + y * (1.0 / 120.0 + y * (-1.0 / 5040.0 + y / 362_880.0))));
        let c = y * (-0.5 + y * (1.0 / 24.0 + y * (-1.0 / 720.0 + y / 40_320.0)));
        return (s, c);
    }
    let h = (0.5 * x).sin();
    (x.sin(), -2.0 * h * h)
}

/// `a` and then `b`, about axes that `a` has turned.
#[inline]
fn then(a: &Turn, b: &Turn) -> Turn {
    let ([p, x, y, z], [q, u, v, w]) = (*a, *b);
    [
        p + q + p * q - (x * u + y * v + z * w),
        u + x + p * u + q * x + (y * w - z * v),
        v + y + p * v + q * y + (z * u - x * w),
        w + z + p * w + q * z + (x * v - y * u),
    ]
}

/// Appends a turn about axis `K`, whose component of the momentum is an angle of `rate`, and turns the momentum
/// the other way.
#[inline(always)]
fn about<const K: usize>(whole: &mut Turn, l: &mut Vec3, rate: f64) {
    let (i, j) = ((K + 1) % 3, (K + 2) % 3);
    let (s, c) = half(0.5 * rate * l[K]);
    let [p, ..] = *whole;
    let v = [whole[1], whole[2], whole[3]];
    whole[0] = p + c + (p * c - v[K] * s);
    whole[1 + K] = v[K] + (s + (p * s + v[K] * c));
    whole[1 + i] = v[i] + (v[i] * c + v[j] * s);
    whole[1 + j] = v[j] + (v[j] * c - v[i] * s);
    // sin φ = 2 s (1 + c), cos φ = 1 − 2 s².
    let (sine, less) = (2.0 * s * (1.0 + c), -2.0 * s * s);
    let (li, lj) = (l[i], l[j]);
    l[i] = li + (less * li + sine * lj);
    l[j] = lj + (less * lj - sine * li);
}

/// The turn in `dt` by splitting, of a body with this angular momentum along its own axes.
#[inline]
pub(crate) fn split(momentum: &Vec3, inverse: &Vec3, dt: f64) -> Turn {
    let mut l = *momentum;
    let mut whole = [0.0; 4];
    let rate = inverse * dt;
    about::<2>(&mut whole, &mut l, 0.5 * rate.z);
    about::<1>(&mut whole, &mut l, 0.5 * rate.y);
    about::<0>(&mut whole, &mut l, rate.x);
    about::<1>(&mut whole, &mut l, 0.5 * rate.y);
    about::<2>(&mut whole, &mut l, 0.5 * rate.z);
    whole
}

/// Terms of the power series, and how far a body may turn in one of its steps.
const TERMS: usize = 24;
const ARC: f64 = 0.25;

/// The turn in `dt` to rounding: Euler's equations and the quaternion's by power series, in as many
/// steps as the turn needs.
pub(crate) fn exact(momentum: &Vec3, inverse: &Vec3, dt: f64) -> Turn {
    let spin = momentum.norm() * inverse.max();
    let steps = (spin * dt.abs() / ARC).ceil().clamp(1.0, 1e6) as usize;
    let h = dt / steps as f64;
    let mut l = *momentum;
    let mut whole = [0.0; 4];
    for _ in 0..steps {
        let turn = series(&mut l, inverse, h);
        whole = then(&whole, &turn);
    }
    whole
}

/// One step of the series; moves `l` along, with length and energy as they were.
fn series(l: &mut Vec3, inverse: &Vec3, h: f64) -> Turn {
    // l' = l × ω and q' = ½ q ω, term by term, time in units of h.
    let mut ls = [Vec3::zeros(); TERMS];
    let mut ws = [Vec3::zeros(); TERMS];
    let mut qs = [(0.0, Vec3::zeros()); TERMS];
    (ls[0], ws[0], qs[0]) = (*l, l.component_mul(inverse) * h, (1.0, Vec3::zeros()));
    let mut turn = (0.0, Vec3::zeros());
    let mut sum = Vec3::zeros();
    let size = l.norm();
    for n in 0..TERMS - 1 {
        let (mut dl, mut dw, mut dv) = (Vec3::zeros(), 0.0, Vec3::zeros());
        for k in 0..=n {
            let w = ws[n - k];
            dl += ls[k].cross(&w);
            let (q, v) = qs[k];
            dw -= v.dot(&w);
            dv += w * q + v.cross(&w);
        }
        let over = 1.0 / (n + 1) as f64;
        ls[n + 1] = dl * over;
        ws[n + 1] = ls[n + 1].component_mul(inverse) * h;
        qs[n + 1] = (0.5 * dw * over, dv * (0.5 * over));
        sum += ls[n + 1];
        turn.0 += qs[n + 1].0;
        turn.1 += qs[n + 1].1;
        let left = ls[n + 1].norm() / size.max(f64::MIN_POSITIVE);
        if n > 2 && left < 1e-19 && qs[n + 1].1.norm() + qs[n + 1].0.abs() < 1e-19 {
            break;
        }
    }
    *l += sum;
    [turn.0, turn.1.x, turn.1.y, turn.1.z]
}
