//! Exact moments of the analytic particles, at unit density.

use super::Primitive;
use crate::math::{Inertia, Moments, Vec3};
use std::f64::consts::PI;

/// The moments of a particle whose parameters have been checked.
pub(super) fn of(primitive: &Primitive) -> Option<Moments> {
    Some(match *primitive {
        Primitive::Sphere { radius } => ellipsoid([radius; 3]),
        Primitive::Ellipsoid { axes } => ellipsoid(axes),
        Primitive::Mandm { radius, flatness } => ellipsoid([radius, radius, radius * flatness]),
        Primitive::Superellipsoid { axes, exponents } => superellipsoid(axes, exponents),
        Primitive::Box { edges } => {
            let volume = edges.iter().product();
            centred(volume, edges.map(|e| volume * e * e / 12.0))
        }
        Primitive::Cylinder { radius, height } => {
            let h = height / 2.0;
            revolved(&[(-h, h, &|_| radius * radius)])
        }
        Primitive::Capsule { radius, height } => {
            let h = height / 2.0;
            let cap = |t: f64| radius * radius - t * t;
            revolved(&[
                (-h - radius, -h, &|z| cap(z + h)),
                (-h, h, &|_| radius * radius),
                (h, h + radius, &|z| cap(z - h)),
            ])
        }
        Primitive::Tablet { band_radius, band_height, cap_height } => {
            let (h, top) = (band_height / 2.0, band_height / 2.0 + cap_height);
            let sphere = (band_radius.powi(2) + cap_height.powi(2)) / (2.0 * cap_height);
            // With d below the pole: r² = d (2 R − d).
            let cap = |d: f64| d * (2.0 * sphere - d);
            revolved(&[
                (-top, -h, &|z| cap(top + z)),
                (-h, h, &|_| band_radius * band_radius),
                (h, top, &|z| cap(top - z)),
            ])
        }
        Primitive::Torus { major, minor } => {
            let (big, small) = (major * major, minor * minor);
            let volume = 2.0 * PI * PI * major * small;
            let side = volume * (big / 2.0 + small * 3.0 / 8.0);
            centred(volume, [side, side, volume * small / 4.0])
        }
        Primitive::Cone { radius, height } => {
            let r = |z: f64| radius * (0.75 - z / height);
            revolved(&[(-0.25 * height, 0.75 * height, &|z| r(z) * r(z))])
        }
        Primitive::Stone { .. } => return None,
    })
}

/// From the volume and ∫x², ∫y², ∫z² of a body centred on the origin.
fn centred(volume: f64, [x2, y2, z2]: [f64; 3]) -> Moments {
    Moments {
        volume,
        centroid: Vec3::zeros(),
        inertia: Inertia::from_second_moments([x2, y2, z2, 0.0, 0.0, 0.0]),
        relative_error: 0.0,
    }
}

fn ellipsoid(axes: [f64; 3]) -> Moments {
    let volume = 4.0 / 3.0 * PI * axes.iter().product::<f64>();
    centred(volume, axes.map(|a| volume * a * a / 5.0))
}

/// A body of revolution about z whose centroid is on the origin: pieces from z₀
/// to z₁ with r² a polynomial of z of degree two at most. All integrands then
/// have degree four at most, and three Gauss points are exact to degree five.
#[allow(clippy::type_complexity)]
fn revolved(pieces: &[(f64, f64, &dyn Fn(f64) -> f64)]) -> Moments {
    let (mut volume, mut z2, mut x2) = (0.0, 0.0, 0.0);
    let node = 0.6f64.sqrt();
    for &(from, to, r2) in pieces {
        let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
        for (t, weight) in [(-node, 5.0 / 9.0), (0.0, 8.0 / 9.0), (node, 5.0 / 9.0)] {
            let z = middle + half * t;
            let area = PI * r2(z) * weight * half;
            volume += area;
            z2 += area * z * z;
            x2 += area * r2(z) / 4.0;
        }
    }
    centred(volume, [x2, x2, z2])
}

/// Jaklič, Leonardis and Solina, Segmentation and Recovery of Superquadrics
/// (2000), section 2.4, with the Beta function.
fn superellipsoid([a, b, c]: [f64; 3], [e1, e2]: [f64; 2]) -> Moments {
    let abc = a * b * c * e1 * e2;
    let volume = 2.0 * abc * beta(e1 / 2.0 + 1.0, e1) * beta(e2 / 2.0, e2 / 2.0);
    let flat = 0.5 * abc * beta(1.5 * e2, e2 / 2.0) * beta(e1 / 2.0, 2.0 * e1 + 1.0);
    let tall = 2.0 * abc * beta(e2 / 2.0, e2 / 2.0 + 1.0) * beta(1.5 * e1, e1 + 1.0);
    centred(volume, [flat * a * a, flat * b * b, tall * c * c])
}

fn beta(x: f64, y: f64) -> f64 {
    (ln_gamma(x) + ln_gamma(y) - ln_gamma(x + y)).exp()
}

/// Lanczos' approximation (g = 7, nine terms), relative error 1e-15; x > 0.
fn ln_gamma(x: f64) -> f64 {
    const C: [f64; 9] = [
        0.999_999_999_999_809_9,
        676.520_368_121_885_1,
        -1_259.139_216_722_402_8,
        771.323_428_777_653_1,
        -176.615_029_162_140_6,
        12.507_343_278_686_905,
        -0.138_571_095_265_720_12,
        9.984_369_578_019_572e-6,
        1.505_632_735_149_311_6e-7,
    ];
    if x < 0.5 {
        // Γ(x) = Γ(x + 1) / x
        return ln_gamma(x + 1.0) - x.ln();
    }
    let x = x - 1.0;
    let sum = C[1..].iter().enumerate().fold(C[0], |s, (i, c)| s + c / (x + i as f64 + 1.0));
    let t = x + 7.5;
    0.5 * (2.0 * PI).ln() + (x + 0.5) * t.ln() - t + sum.ln()
}
