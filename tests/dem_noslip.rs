//! Hertz–Mindlin without slip against formulas: stiffness 8 G a, loop of load and unload, periods.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used)]

use morula::Run;
use morula::dem::contact::{Laws, NormalLaw, TangentialLaw};
use morula::dem::{
    Between, Coefficients, Engine, Material, Placed, Setup, State, Template, WallSetup, WallShape,
};
use morula::math::Vec3;
use std::f64::consts::PI;
use std::sync::Arc;

const RADIUS: f64 = 0.01;
const DENSITY: f64 = 2000.0;
const YOUNG: f64 = 1e7;
const POISSON: f64 = 0.3;
const FRICTION: f64 = 0.4;

/// Of two bodies of the same matter: E/(2 (1 − ν²)) and G/(2 (2 − ν)) with G = E/(2 (1 + ν)).
fn moduli() -> [f64; 2] {
    let g = YOUNG / (2.0 * (1.0 + POISSON));
    [YOUNG / (2.0 * (1.0 - POISSON * POISSON)), g / (2.0 * (2.0 - POISSON))]
}

/// A ball on a plane, elastic, with friction that does not slip below μ N.
fn engine(body: Placed, dt: f64, gravity: Option<f64>) -> Engine {
    let laws = Laws { tangential: TangentialLaw::NoSlip, ..Laws::elastic(NormalLaw::Hertz) };
    let material = Material { young: YOUNG, poisson: POISSON };
    let between = Between { friction: Some(FRICTION), ..Between::default() };
    let plane = WallShape::Plane { normal: Vec3::z(), offset: 0.0 };
    let mut s = Setup {
        laws: Some(laws),
        walls: vec![WallSetup::still(plane)],
        gravity: gravity.map(|g| Vec3::new(0.0, 0.0, -g)),
        ..Setup::free(dt)
    };
    s.coefficients[0] = Coefficients::of(&laws, Some([material; 2]), &between).unwrap();
    let mut state = State::new(vec![Arc::new(Template::ball(RADIUS, DENSITY).unwrap())]);
    state.add(&body).unwrap();
    Engine::new(s, state).unwrap()
}

/// A ball pressed into the plane by `overlap` and led along it.
fn led(overlap: f64, velocity: Vec3, dt: f64) -> Engine {
    let at = Placed::at(Vec3::new(0.0, 0.0, RADIUS - overlap));
    engine(Placed { velocity, fixed: true, ..at }, dt, None)
}

#[test]
fn a_loop_of_load_and_unload_is_that_of_a_spring_of_8_g_a_and_a_slide() {
    let run = Run::serial();
    let (overlap, speed, dt) = (1e-5, 1e-3, 1e-6);
    let [e, g] = moduli();
    let k = 8.0 * g * (RADIUS * overlap).sqrt();
    let most = FRICTION * 4.0 / 3.0 * e * RADIUS.sqrt() * overlap.powf(1.5);
    // To and fro by three times what slides first.
    let amplitude = 3.0 * most / k;
    let steps = (amplitude / (speed * dt)).round() as u64;
    assert!(steps > 500);
    let mut engine = led(overlap, Vec3::x() * speed, dt);
    let (mut spring, mut work) = (0.0f64, 0.0);
    let mut first = true;
    for (way, parts) in [(1.0, 1), (-1.0, 2), (1.0, 2)] {
        engine.edit(|s| s.set_velocity(0, Vec3::x() * (way * speed), Vec3::zeros()));
        for _ in 0..parts * steps {
            let before = engine.on_wall(0).unwrap()[0].x;
            engine.advance(1, &run).unwrap();
            let force = engine.on_wall(0).unwrap()[0].x;
            // The first forces have moved the spring by a step already.
            let moved = if first { 2.0 } else { 1.0 } * way * speed * dt;
            first = false;
            spring = (spring + k * moved).clamp(-most, most);
            assert!((force - spring).abs() < 1e-9 * most, "{force} {spring}");
            if parts == 2 {
                work += 0.5 * (before + force) * way * speed * dt;
            }
        }
    }
    let formula = 4.0 * most * (amplitude - most / k);
    assert!((work / formula - 1.0).abs() < 3e-3, "{work} {formula}");
}

#[test]
fn the_force_shrinks_with_the_radius_of_contact_and_does_not_grow_again() {
    let run = Run::serial();
    let (overlap, speed, dt) = (4e-5, 1e-3, 1e-6);
    let mut engine = led(overlap, Vec3::x() * speed, dt);
    engine.advance(500, &run).unwrap();
    let force = |e: &Engine| e.on_wall(0).unwrap()[0].x;
    let full = force(&engine);
    let k = 8.0 * moduli()[1] * (RADIUS * overlap).sqrt();
    assert!((full / (k * speed * dt * 501.0) - 1.0).abs() < 1e-9, "{full}");
    // Up, until a quarter of the overlap is left, and down again.
    for (way, left) in [(1.0, 0.25), (-1.0, 1.0)] {
        engine.edit(|s| s.set_velocity(0, Vec3::z() * (way * speed), Vec3::zeros()));
        engine.advance((0.75 * overlap / (speed * dt)).round() as u64, &run).unwrap();
        let now = RADIUS - engine.state().position[0].z;
        assert!((now / (left * overlap) - 1.0).abs() < 1e-6);
        assert!((force(&engine) / full - 0.5).abs() < 1e-6, "{} {full}", force(&engine));
    }
}

/// The mean time between two rises through 0.
fn period(values: &[f64], dt: f64) -> f64 {
    let rises = values.windows(2).enumerate().filter(|(_, w)| w[0] < 0.0 && w[1] >= 0.0);
    let at: Vec<f64> = rises.map(|(k, w)| k as f64 + w[0] / (w[0] - w[1])).collect();
    assert!(at.len() > 3);
    (at[at.len() - 1] - at[0]) / (at.len() - 1) as f64 * dt
}

#[test]
fn a_ball_at_rest_swings_along_and_across_the_plane_with_mindlin_s_ratio() {
    let run = Run::serial();
    let (weight, dt) = (9.81, 4e-6);
    let mass = DENSITY * 4.0 / 3.0 * PI * RADIUS.powi(3);
    let [e, g] = moduli();
    let overlap = (0.75 * mass * weight / (e * RADIUS.sqrt())).powf(2.0 / 3.0);
    let radius = (RADIUS * overlap).sqrt();
    let swing = |velocity: Vec3, of: &dyn Fn(&State) -> f64| {
        let at = Placed::at(Vec3::new(0.0, 0.0, RADIUS - overlap));
        let mut engine = engine(Placed { velocity, ..at }, dt, Some(weight));
        let values: Vec<f64> = (0..15_000)
            .map(|_| {
                engine.advance(1, &run).unwrap();
                of(engine.state())
            })
            .collect();
        period(&values, dt)
    };
    let small = 1e-6;
    let across = swing(Vec3::z() * small, &|s| s.velocity[0].z);
    // Of the matter at the place of contact; 2/7 of the mass moves with it.
    let slides = |s: &State| s.velocity[0].x - RADIUS * s.angular_velocity(0).y;
    let along = swing(Vec3::x() * small, &slides);
    let formula = |k: f64, m: f64| 2.0 * PI * (m / k).sqrt();
    let (normal, shear) = (2.0 * e * radius, 8.0 * g * radius);
    assert!((across / formula(normal, mass) - 1.0).abs() < 2e-3, "{across}");
    assert!((along / formula(shear, 2.0 / 7.0 * mass) - 1.0).abs() < 5e-3, "{along}");
    // (2 − ν)/(2 (1 − ν)) is the ratio of the stiffnesses.
    let ratio = (2.0 / 7.0 * (2.0 - POISSON) / (2.0 * (1.0 - POISSON))).sqrt();
    assert!((along / across / ratio - 1.0).abs() < 5e-3);
}
