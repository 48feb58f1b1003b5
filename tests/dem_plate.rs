//! Many coplanar contacts at once: stability, and what the advice says of it.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used, clippy::panic)]

use morula::dem::advice::advise;
use morula::dem::energy;
use morula::dem::{
    Coefficients, Engine, Laws, NormalLaw, Placed, Setup, State, Template, WallSetup, WallShape,
};
use morula::math::Vec3;
use morula::{Run, Sphere};
use std::sync::Arc;

/// A plate of n by n spheres side by side, of the same mass and moments as a plate of such edges.
fn plate(n: u32) -> Template {
    let place = |i: u32| (f64::from(i) - 0.5 * f64::from(n - 1)) * 2.0 / f64::from(n);
    let spheres: Vec<Sphere> = (0..n * n)
        .map(|k| Sphere::new(Vec3::new(place(k % n), place(k / n), 0.0), 1.0 / f64::from(n)))
        .collect();
    Template::new(&spheres, 1.0, [1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0]).unwrap()
}

fn at_rest(n: u32, averaging: bool, stiffness: f64) -> (State, Setup) {
    let mut state = State::new(vec![Arc::new(plate(n))]);
    // A tenth less deep than it rests.
    let springs = if averaging { 1.0 } else { f64::from(n * n) };
    let height = 1.0 / f64::from(n) - 0.9 * 10.0 / (springs * stiffness);
    state.add(&Placed::at(Vec3::new(0.0, 0.0, height))).unwrap();
    let laws = Laws { averaging, ..Laws::elastic(NormalLaw::Linear) };
    let setup = Setup {
        laws: Some(laws),
        coefficients: vec![Coefficients { stiffness, ..Coefficients::default() }],
        walls: vec![WallSetup::still(WallShape::Plane { normal: Vec3::z(), offset: 0.0 })],
        gravity: Some(Vec3::new(0.0, 0.0, -10.0)),
        guard: false,
        ..Setup::free(1e-3)
    };
    (state, setup)
}

/// Whether a plate that rests on a wall comes to jump in 300 steps of this length.
fn jumps(n: u32, averaging: bool, stiffness: f64, dt: f64) -> bool {
    let (state, setup) = at_rest(n, averaging, stiffness);
    let from = state.position[0].z;
    let mut engine = Engine::new(Setup { dt, ..setup }, state).unwrap();
    engine.advance(300, &Run::serial()).unwrap();
    let springs = if averaging { 1.0 } else { f64::from(n * n) };
    let moved = (engine.state().position[0].z - from).abs();
    !moved.is_finite() || moved > 10.0 * 10.0 / (springs * stiffness)
}

#[test]
fn the_advice_stays_below_the_step_at_which_many_contacts_jump() {
    let stiffness = 1e4;
    for (n, averaging) in [(2, false), (3, false), (10, false), (30, false), (3, true), (30, true)]
    {
        let springs = if averaging { 1.0 } else { f64::from(n * n) };
        let formula = 2.0 / (springs * stiffness).sqrt();
        let (mut low, mut high) = (0.2 * formula, 5.0 * formula);
        assert!(!jumps(n, averaging, stiffness, low) && jumps(n, averaging, stiffness, high));
        for _ in 0..20 {
            let middle = (low * high).sqrt();
            if jumps(n, averaging, stiffness, middle) { high = middle } else { low = middle }
        }
        // Of n springs on one mass.
        assert!((low / formula - 1.0).abs() < 0.05, "{n} {averaging}: {low} {formula}");
        let (state, setup) = at_rest(n, averaging, stiffness);
        let laws = setup.laws.unwrap();
        let advice = advise(&laws, &setup.coefficients, &state, 1.0, n * n).unwrap().unwrap();
        // The advice is for two equal bodies: a factor of √2. Of contacts that act as one it takes the worst place, the corner.
        let most = if averaging { 4.0 } else { 1.6 };
        assert!((1.3..most).contains(&(low / advice.limit)), "{n}: {low} {advice:?}");
    }
}

#[test]
fn averaged_contacts_hold_what_was_put_into_them() {
    // Tilted, so that they come one after the other; without damping.
    for (n, law, tilt) in
        [(1, NormalLaw::Linear, 0.0), (4, NormalLaw::Linear, 0.0), (4, NormalLaw::Hertz, 0.02)]
    {
        let laws = Laws { averaging: true, ..Laws::elastic(law) };
        let mut state = State::new(vec![Arc::new(plate(n))]);
        let height = 1.0 / f64::from(n) + 0.03;
        let rotation = [1.0, 0.5 * tilt, 0.3 * tilt, 0.0];
        let at = Placed::at(Vec3::new(0.0, 0.0, height));
        state.add(&Placed { velocity: -Vec3::z(), rotation, ..at }).unwrap();
        let mut engine = Engine::new(
            Setup {
                laws: Some(laws),
                coefficients: vec![Coefficients { stiffness: 1e5, ..Coefficients::default() }],
                walls: vec![WallSetup::still(WallShape::Plane { normal: Vec3::z(), offset: 0.0 })],
                guard: false,
                ..Setup::free(1e-5)
            },
            state,
        )
        .unwrap();
        let (mut before, mut most, mut touched) = (0.5, 0.0f64, 0);
        for _ in 0..1000 {
            engine.advance(10, &Run::serial()).unwrap();
            let contacts = engine.contacts();
            let stored: f64 = contacts.iter().flatten().map(|c| c.energy).sum();
            let [a, b] = energy::kinetic(engine.state());
            if contacts.iter().all(Vec::is_empty) {
                // What the way has kept or given is seen where they part.
                before = a + b;
            } else {
                most = most.max((a + b + stored - before).abs());
                touched += 1;
            }
        }
        assert!(touched > 10 && most < 1e-5, "{n} {law:?}: {most} in {touched}");
    }
}
