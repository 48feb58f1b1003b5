//! Free rotation by Euler's equations, body frame at first the world's.

use morula::math::Vec3;
use nalgebra::{Quaternion, UnitQuaternion};

/// What the bodies start with, per second.
pub const SPIN: [f64; 3] = [30.0, 50.0, 20.0];
/// Seconds of a step.
pub const STEP: f64 = 1e-5;

/// Angular velocity in the world frame, after so many steps of the fourth order.
pub fn spin(moments: [f64; 3], steps: usize) -> Vec3 {
    let change = |w: &Vec3, q: &Quaternion<f64>| {
        let [a, b, c] = moments;
        let dw =
            Vec3::new((b - c) * w.y * w.z / a, (c - a) * w.z * w.x / b, (a - b) * w.x * w.y / c);
        (dw, q * Quaternion::from_parts(0.0, *w) * 0.5)
    };
    let (mut w, mut q) = (Vec3::from(SPIN), Quaternion::identity());
    let h = STEP;
    for _ in 0..steps {
        let (w1, q1) = change(&w, &q);
        let (w2, q2) = change(&(w + w1 * (h / 2.0)), &(q + q1 * (h / 2.0)));
        let (w3, q3) = change(&(w + w2 * (h / 2.0)), &(q + q2 * (h / 2.0)));
        let (w4, q4) = change(&(w + w3 * h), &(q + q3 * h));
        w += (w1 + 2.0 * w2 + 2.0 * w3 + w4) * (h / 6.0);
        q += (q1 + q2 * 2.0 + q3 * 2.0 + q4) * (h / 6.0);
    }
    UnitQuaternion::from_quaternion(q) * w
}

/// Holds an angular velocity against it.
pub fn check(program: &str, moments: [f64; 3], steps: usize, found: &[f64], within: f64) {
    let w = spin(moments, steps);
    let off = (w - Vec3::new(found[0], found[1], found[2])).norm() / w.norm();
    println!("{program}: angular velocity off by {off:.1e} after {steps} steps");
    assert!(off < within, "{program}: {w} and {found:?}");
}

#[test]
fn energy_and_momentum_stay() {
    let moments = [2.4, 4.0, 4.8];
    let start = Vec3::from(SPIN);
    let energy = |w: &Vec3| (0..3).map(|k| moments[k] * w[k] * w[k]).sum::<f64>();
    // About an axis of its own nothing changes; else the middle of the motion differs.
    let w = spin(moments, 1000);
    assert!((w - start).norm() > 1.0, "{w}");
    // Twice the energy is ω·L, and L stays in the world frame.
    let l = Vec3::new(moments[0] * start.x, moments[1] * start.y, moments[2] * start.z);
    assert!((w.dot(&l) / energy(&start) - 1.0).abs() < 1e-10);
}
