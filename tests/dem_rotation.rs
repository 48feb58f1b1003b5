//! Free rotation against what is conserved and against the elliptic formula.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used)]

use morula::dem::{Engine, Placed, Setup, State, Template};
use morula::math::{Sphere, Vec3};
use morula::{Run, dem::energy};
use std::f64::consts::PI;
use std::sync::Arc;

const MASS: f64 = 5.2438;
const MOMENTS: [f64; 3] = [7.843, 15.257, 22.574];

/// A T-bar that turns about its middle axis with 2 rad/s, and a little about the others.
fn tbar(dt: f64, exact: bool) -> Engine {
    let sphere = Sphere::new(Vec3::zeros(), 0.5);
    let mut state = State::new(vec![Arc::new(Template::new(&[sphere], MASS, MOMENTS).unwrap())]);
    let rotation = [0.8, 0.1, -0.5, 0.3];
    let turn = morula::dem::rotate::Orientation::new(rotation).unwrap().matrix();
    let angular_velocity = turn * Vec3::new(0.02, 2.0, 0.01);
    state.add(&Placed { rotation, angular_velocity, ..Placed::at(Vec3::zeros()) }).unwrap();
    Engine::new(Setup { exact_rotation: exact, ..Setup::free(dt) }, state).unwrap()
}

fn turning(e: &Engine) -> f64 {
    energy::kinetic(e.state())[1]
}

/// Angular velocity about the body's own axes.
fn own(e: &Engine) -> Vec3 {
    e.state().orientation[0].matrix().transpose() * e.state().angular_velocity(0)
}

/// Greatest relative errors of angular momentum and energy over a time.
fn errors(dt: f64, exact: bool, time: f64) -> (f64, f64) {
    let mut e = tbar(dt, exact);
    let (l0, e0) = (e.state().momentum[0], turning(&e));
    let (mut worst_l, mut worst_e) = (0.0f64, 0.0f64);
    let run = Run::serial();
    for _ in 0..200 {
        e.advance((time / dt / 200.0).round() as u64, &run).unwrap();
        // Of the body itself: I ω, turned into space, not what is stored.
        let turn = e.state().orientation[0].matrix();
        let l = turn * own(&e).component_mul(&Vec3::from(MOMENTS));
        worst_l = worst_l.max((l - l0).norm() / l0.norm());
        worst_e = worst_e.max((turning(&e) / e0 - 1.0).abs());
    }
    (worst_l, worst_e)
}

#[test]
fn momentum_stays_at_any_step_and_the_energy_error_falls_as_its_square() {
    let found = [0.1, 0.02, 0.004].map(|dt| errors(dt, false, 100.0));
    println!("splitting: {found:?}");
    assert!(found.iter().all(|(l, _)| *l < 1e-12));
    for k in 0..2 {
        let order = (found[k].1 / found[k + 1].1).ln() / 5f64.ln();
        assert!((order - 2.0).abs() < 0.1, "{order}");
    }
}

#[test]
fn exact_rotation_keeps_momentum_and_energy() {
    for dt in [0.5, 0.01, 0.001] {
        let (l, e) = errors(dt, true, 100.0);
        println!("exact {dt}: {l:e} {e:e}");
        assert!(l < 1e-12 && e < 1e-10, "{dt}: {l} {e}");
    }
}

/// Complete elliptic integral of the first kind by the arithmetic-geometric mean.
fn elliptic(k2: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k2).sqrt());
    for _ in 0..30 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    PI / (2.0 * a)
}

#[test]
fn it_flips_with_the_period_of_the_elliptic_formula() {
    for (exact, dt, within) in [(true, 0.01, 1e-7), (false, 0.001, 1e-5)] {
        let mut e = tbar(dt, exact);
        let (w, [mut i1, i2, mut i3]) = (own(&e), MOMENTS);
        let square = |i: f64, w: f64| i * w * w;
        let energy2 = square(i1, w.x) + square(i2, w.y) + square(i3, w.z);
        let m2 = (i1 * w.x).powi(2) + (i2 * w.y).powi(2) + (i3 * w.z).powi(2);
        // Landau and Lifshitz, §37: about the axis of I3 where M² > 2 E I2, else about that of I1.
        if m2 < energy2 * i2 {
            std::mem::swap(&mut i1, &mut i3);
        }
        let k2 = (i2 - i1) * (energy2 * i3 - m2) / ((i3 - i2) * (m2 - energy2 * i1));
        let period = 4.0 * elliptic(k2) * (i1 * i2 * i3 / ((i3 - i2) * (m2 - energy2 * i1))).sqrt();
        // ω2 changes sign twice in a period.
        let (mut crossings, mut last) = (Vec::new(), w.y);
        let run = Run::serial();
        while crossings.len() < 5 {
            e.advance(1, &run).unwrap();
            let now = own(&e).y;
            if now * last < 0.0 {
                crossings.push(e.time() - dt * now / (now - last));
            }
            last = now;
        }
        let measured = 0.5 * (crossings[4] - crossings[0]);
        println!("exact {exact}: {measured} {period}");
        assert!((measured / period - 1.0).abs() < within, "{measured} {period}");
    }
}

#[test]
fn tiny_turns_add_up() {
    // 1e-12 and 1e-19 rad a step about a slant axis, for a million steps.
    for rate in [1e-12, 1e-19] {
        let sphere = Sphere::new(Vec3::zeros(), 1.0);
        let template = Template::new(&[sphere], 1.0, [0.4; 3]).unwrap();
        let mut state = State::new(vec![Arc::new(template)]);
        let axis = Vec3::new(0.3, -0.5, 0.7).normalize();
        let rotation = [0.6, 0.3, 0.2, -0.7];
        let angular_velocity = axis * rate;
        state.add(&Placed { rotation, angular_velocity, ..Placed::at(Vec3::zeros()) }).unwrap();
        let before = state.orientation[0];
        let mut e = Engine::new(Setup::free(1.0), state).unwrap();
        let steps = 1_000_000;
        e.advance(steps, &Run::serial()).unwrap();
        // The vector part of the turn q q₀*, from both parts of the sums.
        let after = e.state().orientation[0];
        let change = |k: usize| {
            (after.quaternion[k] - before.quaternion[k]) + (after.rest[k] - before.rest[k])
        };
        let d = [0, 1, 2, 3].map(change);
        let [w, x, y, z] = before.quaternion;
        let vector = Vec3::new(
            -d[0] * x + d[1] * w - d[2] * z + d[3] * y,
            -d[0] * y + d[1] * z + d[2] * w - d[3] * x,
            -d[0] * z - d[1] * y + d[2] * x + d[3] * w,
        );
        let angle = rate * steps as f64;
        let error = (vector * 2.0 - axis * angle).norm() / angle;
        assert!(error < 1e-6, "{rate}: {error}");
    }
}

#[test]
fn turning_back_leads_back() {
    for exact in [false, true] {
        let mut e = tbar(0.05, exact);
        let before = e.state().orientation[0].matrix();
        let run = Run::serial();
        e.advance(1000, &run).unwrap();
        e.edit(|s| s.momentum[0] = -s.momentum[0]);
        e.advance(1000, &run).unwrap();
        assert!((e.state().orientation[0].matrix() - before).amax() < 1e-10, "{exact}");
    }
}
