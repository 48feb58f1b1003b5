//! Each effect against a formula, and that what is not named does nothing.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used, clippy::panic)]

use morula::Run;
use morula::dem::contact::{CohesionLaw, DampingLaw, Laws, NormalLaw, TangentialLaw};
use morula::dem::effects::{cohesion, damping};
use morula::dem::{
    Coefficients, Drag, Engine, Placed, Setup, State, Template, WallMotion, WallSetup, WallShape,
};
use morula::math::{Sphere, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;

const G: f64 = 9.81;

fn plane(normal: Vec3) -> WallSetup {
    WallSetup::still(WallShape::Plane { normal, offset: 0.0 })
}

/// A floor of n × n squares of two triangles, from −size to size.
fn tiles(n: u32, size: f64) -> WallSetup {
    let side = n + 1;
    let at = |i: u32| 2.0 * size * f64::from(i) / f64::from(n) - size;
    let corner = |k: u32| Vec3::new(at(k % side), at(k / side), 0.0);
    let vertices = (0..side * side).map(corner).collect();
    let square = |k: u32| {
        let a = k % n + k / n * side;
        [[a, a + 1, a + side + 1], [a, a + side + 1, a + side]]
    };
    WallSetup::still(WallShape::Mesh { vertices, triangles: (0..n * n).flat_map(square).collect() })
}

fn setup(laws: Laws, c: Coefficients, wall: WallSetup, dt: f64) -> Setup {
    let mut s = Setup { laws: Some(laws), walls: vec![wall], ..Setup::free(dt) };
    s.coefficients[0] = c;
    s
}

/// A ball of radius 1 cm, 2000 kg/m³.
fn ball() -> Arc<Template> {
    Arc::new(Template::ball(0.01, 2000.0).unwrap())
}

fn rough() -> (Laws, Coefficients) {
    let laws = Laws {
        damping: DampingLaw::Contact,
        tangential: TangentialLaw::Mindlin,
        ..Laws::elastic(NormalLaw::Linear)
    };
    let c = Coefficients {
        stiffness: 1e4,
        shear: 8e3,
        damping: 2.0 * damping::ratio(0.3),
        tangential_damping: 1.0,
        friction: 0.4,
        ..Coefficients::default()
    };
    (laws, c)
}

#[test]
fn a_block_sticks_while_the_slope_is_less_than_friction() {
    // Four feet on a plane; gravity is tilted instead.
    let foot = |x: f64, y: f64| Sphere::new(Vec3::new(0.02 * x, 0.02 * y, 0.0), 0.005);
    let feet = [foot(1.0, 1.0), foot(-1.0, 1.0), foot(1.0, -1.0), foot(-1.0, -1.0)];
    for (tangent, slides) in [(0.39, false), (0.6, true)] {
        let block = Template::new(&feet, 0.02, [4e-6, 4e-6, 7e-6]).unwrap();
        let mut state = State::new(vec![Arc::new(block)]);
        state.add(&Placed::at(Vec3::new(0.0, 0.0, 0.005 - 5e-6))).unwrap();
        let (laws, c) = rough();
        let angle = f64::atan(tangent);
        let down = Vec3::new(angle.sin(), 0.0, -angle.cos()) * G;
        let mut s = setup(laws, c, plane(Vec3::z()), 2e-5);
        s.gravity = Some(down);
        let mut e = Engine::new(s, state).unwrap();
        e.advance(20_000, &Run::serial()).unwrap();
        let (v, t) = (e.state().velocity[0].x, e.time());
        if slides {
            let formula = (angle.sin() - 0.4 * angle.cos()) * G * t;
            assert!((v / formula - 1.0).abs() < 0.01, "{v} {formula}");
        } else {
            assert!(v.abs() < 1e-5, "{v}");
        }
    }
}

#[test]
fn jkr_lets_go_at_three_halves_pi_w_r() {
    let (w, young) = (0.5, 1e7);
    let laws = Laws { cohesion: CohesionLaw::Jkr, ..Laws::elastic(NormalLaw::Hertz) };
    let c = Coefficients { stiffness: young, cohesion: w, ..Coefficients::default() };
    let mut state = State::new(vec![ball()]);
    // A fixed ball is pulled off a wall slowly.
    let mut body = Placed::at(Vec3::new(0.0, 0.0, 0.01 - 1e-6));
    (body.fixed, body.velocity) = (true, Vec3::new(0.0, 0.0, 1e-3));
    state.add(&body).unwrap();
    let mut e = Engine::new(setup(laws, c, plane(Vec3::z()), 1e-5), state).unwrap();
    let (mut most, mut end) = (0.0f64, 0.0);
    let run = Run::serial();
    for _ in 0..6000 {
        e.advance(1, &run).unwrap();
        let pull = e.on_wall(0).unwrap()[0].z;
        if pull != 0.0 {
            end = e.state().position[0].z - 0.01;
        }
        most = most.max(pull);
    }
    assert!((most / (1.5 * PI * w * 0.01) - 1.0).abs() < 1e-4, "{most}");
    let range = cohesion::jkr_range(w, young, 0.01);
    assert!((end / range - 1.0).abs() < 0.02, "{end} {range}");
    // A ball that only comes near is not pulled.
    let mut state = State::new(vec![ball()]);
    state.add(&Placed::at(Vec3::new(0.0, 0.0, 0.01 + 0.5 * range))).unwrap();
    let mut e = Engine::new(setup(laws, c, plane(Vec3::z()), 1e-5), state).unwrap();
    e.advance(10, &run).unwrap();
    assert_eq!(e.state().velocity[0].z, 0.0);
}

#[test]
fn a_stress_of_cohesion_softens_the_contact() {
    let laws = Laws { cohesion: CohesionLaw::Linear, ..Laws::elastic(NormalLaw::Linear) };
    let c = Coefficients { stiffness: 1e4, cohesion: 4e4, ..Coefficients::default() };
    let mut state = State::new(vec![ball()]);
    state.add(&Placed::at(Vec3::new(0.0, 0.0, 0.01 - 1e-5))).unwrap();
    let mut e = Engine::new(setup(laws, c, plane(Vec3::z()), 1e-6), state).unwrap();
    e.start(&Run::serial()).unwrap();
    let force = e.state().force[0].z;
    assert!((force - (1e4 - 2.0 * PI * 0.01 * 4e4) * 1e-5).abs() < 1e-12, "{force}");
}

#[test]
fn a_ball_falls_with_its_terminal_velocity() {
    for (viscosity, density) in [(1.0, 0.0), (0.0, 1000.0), (0.3, 500.0)] {
        let mut state = State::new(vec![ball()]);
        let flow = Vec3::new(0.1, 0.0, 0.05);
        state.add(&Placed::at(Vec3::zeros())).unwrap();
        let mut s = Setup::free(1e-3);
        s.gravity = Some(Vec3::new(0.0, 0.0, -G));
        s.drag = Some(Drag { viscosity, density, coefficient: 0.44, flow });
        let mut e = Engine::new(s, state).unwrap();
        e.advance(5000, &Run::serial()).unwrap();
        let u = e.state().velocity[0] - flow;
        let (r, m) = (0.01, 2000.0 * 4.0 / 3.0 * PI * 1e-6);
        // a u + b u² = m g
        let (a, b) = (6.0 * PI * viscosity * r, 0.5 * density * 0.44 * PI * r * r);
        let formula =
            if b > 0.0 { ((a * a + 4.0 * b * m * G).sqrt() - a) / (2.0 * b) } else { m * G / a };
        assert!((u.z + formula).abs() < 1e-9 * formula && u.x.abs() < 1e-9, "{u} {formula}");
    }
}

#[test]
fn rolling_resistance_stops_a_ball_after_its_distance() {
    // Rolling without slip: (7/5) m a = −μ_r m g, so v₀² 7/(10 μ_r g).
    let (laws, c) = rough();
    let laws = Laws { rolling: true, ..laws };
    let c = Coefficients { rolling: 0.05, friction: 0.8, ..c };
    let (r, v) = (0.01, 0.2);
    let mut state = State::new(vec![ball()]);
    let m = ball().mass();
    let mut body = Placed::at(Vec3::new(0.0, 0.0, r - m * G / 1e4));
    (body.velocity, body.angular_velocity) = (Vec3::new(v, 0.0, 0.0), Vec3::new(0.0, v / r, 0.0));
    state.add(&body).unwrap();
    let mut s = setup(laws, c, plane(Vec3::z()), 2e-5);
    s.gravity = Some(Vec3::new(0.0, 0.0, -G));
    let mut e = Engine::new(s, state).unwrap();
    let run = Run::serial();
    e.advance(50_000, &run).unwrap();
    let stop = e.state().position[0].x;
    let formula = 0.7 * v * v / (0.05 * G);
    assert!((stop / formula - 1.0).abs() < 5e-3, "{stop} {formula}");
    // And it stays there.
    e.advance(20_000, &run).unwrap();
    assert!((e.state().position[0].x - stop).abs() < 1e-9);
}

/// Rebound of a flat plate of n × n spheres that falls on a wall.
fn plate(n: usize, averaging: bool, part: f64) -> f64 {
    let at = |i: usize| 0.01 * (i as f64 - 0.5 * (n as f64 - 1.0));
    let sphere = |k: usize| Sphere::new(Vec3::new(at(k % n), at(k / n), 0.0), 0.01);
    let spheres: Vec<Sphere> = (0..n * n).map(sphere).collect();
    let template = Template::new(&spheres, 1.0, [1.0, 1.0, 1.5]).unwrap();
    let mut state = State::new(vec![Arc::new(template)]);
    let mut body = Placed::at(Vec3::new(0.0, 0.0, 0.0101));
    body.velocity.z = -1.0;
    state.add(&body).unwrap();
    let laws = Laws { damping: DampingLaw::Bodies, averaging, ..Laws::elastic(NormalLaw::Linear) };
    let k: f64 = 1e6;
    let c = Coefficients {
        stiffness: k,
        damping: 2.0 * damping::ratio(0.6),
        ..Coefficients::default()
    };
    let dt = PI / k.sqrt() * part;
    let mut s = setup(laws, c, plane(Vec3::z()), dt);
    s.guard = false;
    let mut e = Engine::new(s, state).unwrap();
    e.advance((0.01 / dt) as u64, &Run::serial()).unwrap();
    e.state().velocity[0].z
}

#[test]
fn averaging_gives_a_plate_the_restitution_asked_for() {
    for n in [1, 2, 3, 10, 60] {
        let e = plate(n, true, 0.02);
        assert!((e - 0.6).abs() < 5e-3, "{n}: {e}");
    }
    // And better with smaller steps; without it many contacts are unstable.
    let finer = plate(10, true, 0.005);
    assert!((finer - 0.6).abs() < 5e-4, "{finer}");
    assert!((plate(10, false, 0.02) - 0.6).abs() > 0.3);
}

#[test]
fn slow_loading_and_unloading_gains_no_energy() {
    // Feet of different heights are pressed into a wall one after the other and lifted again, straight and askew.
    let foot = |k: usize| {
        let (x, y) = ((k % 4) as f64 - 1.5, (k / 4) as f64 - 1.5);
        Sphere::new(Vec3::new(0.01 * x, 0.01 * y, 2e-5 * ((k * 7) % 16) as f64), 0.01)
    };
    let feet: Vec<Sphere> = (0..16).map(foot).collect();
    for normal in [NormalLaw::Linear, NormalLaw::Hertz] {
        for tilt in [0.0, 0.004] {
            let laws = Laws { averaging: true, ..Laws::elastic(normal) };
            let c = Coefficients { stiffness: 1e6, ..Coefficients::default() };
            let template = Template::new(&feet, 1.0, [1.0, 1.0, 1.5]).unwrap();
            let mut state = State::new(vec![Arc::new(template)]);
            let mut body = Placed::at(Vec3::new(0.0, 0.0, 0.0102));
            body.rotation = [1.0, tilt, 0.5 * tilt, 0.0];
            (body.fixed, body.velocity.z) = (true, -0.01);
            state.add(&body).unwrap();
            let mut e = Engine::new(setup(laws, c, plane(Vec3::z()), 1e-4), state).unwrap();
            let run = Run::serial();
            let (mut work, mut most, mut last) = (0.0, 0.0f64, 0.0);
            for n in 0..1400 {
                if n == 700 {
                    e.edit(|s| s.velocity[0].z = 0.01);
                }
                e.advance(1, &run).unwrap();
                let force = e.state().force[0].z;
                let step = e.state().velocity[0].z * 1e-4;
                work += 0.5 * (force + last) * step;
                most = most.min(work);
                last = force;
            }
            assert!(most < -1e-5 && last == 0.0, "{most} {last}");
            // What it gives back is what it took, and no more.
            assert!(
                work < 1e-3 * -most && work > -0.05 * -most,
                "{normal:?} {tilt}: {work} {most}"
            );
        }
    }
}

#[test]
fn a_floor_of_triangles_is_a_floor() {
    // A clump rolls and bounces over a plane, and over the same in triangles.
    let s = |x: f64, y: f64, z: f64, r: f64| Sphere::new(Vec3::new(x, y, z) * 0.01, 0.01 * r);
    let spheres = [s(1.0, 0.0, 0.0, 0.8), s(-0.8, 0.2, 0.1, 1.0), s(0.0, 0.7, -0.3, 0.6)];
    let template = Arc::new(Template::new(&spheres, 0.01, [5e-7, 8e-7, 9e-7]).unwrap());
    let travel = |wall: WallSetup| {
        let mut state = State::new(vec![template.clone()]);
        let mut body = Placed::at(Vec3::new(-0.05, -0.03, 0.022));
        (body.velocity, body.angular_velocity) =
            (Vec3::new(0.5, 0.31, 0.0), Vec3::new(3.0, 9.0, 1.0));
        state.add(&body).unwrap();
        let (laws, c) = rough();
        let mut s = setup(laws, c, wall, 2e-5);
        s.gravity = Some(Vec3::new(0.0, 0.0, -G));
        let mut e = Engine::new(s, state).unwrap();
        let mut path = Vec::new();
        for _ in 0..100 {
            e.advance(200, &Run::serial()).unwrap();
            path.push(e.state().position[0]);
        }
        (path, e.work().contacts)
    };
    let (flat, contacts) = travel(plane(Vec3::z()));
    for n in [1, 7, 40] {
        let (tiled, same) = travel(tiles(n, 0.5));
        assert!(contacts.abs_diff(same) <= contacts / 500, "{n}: {contacts} {same}");
        for (k, (p, q)) in flat.iter().zip(&tiled).enumerate() {
            assert!((p - q).norm() < 1e-6, "{n}, {k}: {p} {q}");
        }
    }
}

#[test]
fn corners_and_edges_of_a_mesh_are_touched_once() {
    // A cube of twelve triangles; spheres about faces, edges and corners, from outside.
    let corner = |k: u32| Vec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
    let vertices: Vec<Vec3> = (0..8).map(corner).collect();
    let triangles: Vec<[u32; 3]> =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
            .iter()
            .flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]])
            .collect();
    let shape = WallShape::Mesh { vertices, triangles };
    let mut touched = 0;
    for k in 0..400u32 {
        let f = |j: u32| {
            f64::from(k.wrapping_mul(2_654_435_761).wrapping_add(j * 40_503) % 1009) / 1009.0
        };
        // Some just on a diagonal or an edge.
        let mut x = Vec3::new(f(1), f(2), f(3)) * 1.6 - Vec3::repeat(0.3);
        if k % 3 == 0 {
            x.y = x.x;
        }
        if k % 5 == 0 {
            x.z = 1.2;
        }
        let nearest = x.sup(&Vec3::zeros()).inf(&Vec3::repeat(1.0));
        let d = (x - nearest).norm();
        if d == 0.0 {
            continue;
        }
        let mut state = State::new(vec![Arc::new(Template::ball(0.25, 1.0).unwrap())]);
        state.add(&Placed::at(x)).unwrap();
        let c = Coefficients { stiffness: 1.0, ..Coefficients::default() };
        let laws = Laws::elastic(NormalLaw::Linear);
        let mut e =
            Engine::new(setup(laws, c, WallSetup::still(shape.clone()), 1e-3), state).unwrap();
        e.start(&Run::serial()).unwrap();
        let expected = if d < 0.25 { (x - nearest) / d * (0.25 - d) } else { Vec3::zeros() };
        assert!((e.state().force[0] - expected).norm() < 1e-12, "{k}: {x} {}", e.state().force[0]);
        touched += u32::from(d < 0.25);
    }
    assert!(touched > 50, "{touched}");
}

#[test]
fn a_turning_wall_lifts_and_a_drum_carries() {
    let (laws, c) = rough();
    let run = Run::serial();
    // A plane that turns about the y axis through the origin pushes what lies on it as its law says.
    let rate = 0.5;
    let turn =
        WallMotion::Turn { center: Vec3::zeros(), axis: Vec3::y(), rate: -rate, spin: false };
    let mut state = State::new(vec![ball()]);
    state.add(&Placed::at(Vec3::new(0.3, 0.0, 0.01))).unwrap();
    let wall = WallSetup { motion: turn, ..plane(Vec3::z()) };
    let smooth = Laws { tangential: TangentialLaw::None, ..laws };
    let mut s = setup(smooth, c, wall, 2e-5);
    s.gravity = Some(Vec3::new(0.0, 0.0, -G));
    let mut e = Engine::new(s, state).unwrap();
    e.advance(10_000, &run).unwrap();
    let (x, angle) = (e.state().position[0], rate * e.time());
    let normal = Vec3::new(-angle.sin(), 0.0, angle.cos());
    assert!((normal.dot(&x) - 0.01).abs() < 2e-5, "{x}");
    // A ball in a turning drum with friction is carried up to where it slips or rolls: it gets a spin.
    let spin = WallMotion::Turn { center: Vec3::zeros(), axis: Vec3::x(), rate: 2.0, spin: true };
    let drum = WallShape::Cylinder {
        center: Vec3::zeros(),
        axis: Vec3::x(),
        radius: 0.1,
        length: Some(0.1),
    };
    let mut state = State::new(vec![ball()]);
    state.add(&Placed::at(Vec3::new(0.0, 0.0, -0.09))).unwrap();
    let mut s = setup(laws, c, WallSetup { motion: spin, shape: drum, material: 0 }, 2e-5);
    s.gravity = Some(Vec3::new(0.0, 0.0, -G));
    let mut e = Engine::new(s, state).unwrap();
    // It swings about a place where it rolls: r ω = R Ω.
    let mut sum = 0.0;
    for _ in 0..600 {
        e.advance(200, &run).unwrap();
        sum += e.state().angular_velocity(0).x / 600.0;
    }
    assert!((sum / 20.0 - 1.0).abs() < 0.05, "{sum}");
}

#[test]
fn what_is_not_named_does_nothing_and_holds_nothing() {
    let named = |laws: Option<Laws>, gravity: bool| {
        let mut state = State::new(vec![ball()]);
        state.add(&Placed::at(Vec3::new(0.0, 0.0, 0.01 - 1e-6))).unwrap();
        state.add(&Placed::at(Vec3::new(0.0, 0.0, 0.03 - 1e-6))).unwrap();
        let (_, c) = rough();
        let mut s =
            setup(laws.unwrap_or(Laws::elastic(NormalLaw::Linear)), c, plane(Vec3::z()), 1e-5);
        s.laws = laws;
        s.gravity = gravity.then_some(Vec3::new(0.0, 0.0, -G));
        let mut e = Engine::new(s, state).unwrap();
        e.advance(100, &Run::serial()).unwrap();
        e.effects()
            .iter()
            .filter(|r| r.calls > 0 || r.bytes > 0)
            .map(|r| r.name)
            .collect::<Vec<_>>()
    };
    let elastic = Laws::elastic(NormalLaw::Linear);
    assert!(named(None, false).is_empty());
    assert_eq!(named(None, true), ["gravity"]);
    assert_eq!(named(Some(elastic), false), ["normal"]);
    let (rough, _) = rough();
    assert_eq!(named(Some(rough), true), ["gravity", "normal", "damping", "tangential"]);
    let viscous = Laws { tangential: TangentialLaw::Viscous, averaging: true, ..elastic };
    assert_eq!(named(Some(viscous), false), ["normal", "tangential", "averaging"]);
}

#[test]
fn a_step_that_is_too_large_is_told_with_its_pair_and_overlap() {
    let mut state = State::new(vec![ball()]);
    state.add(&Placed::at(Vec3::new(0.0, 0.0, 0.0099))).unwrap();
    let mut body = Placed::at(Vec3::new(0.0, 0.0, 0.031));
    body.velocity.z = -1.0;
    state.add(&body).unwrap();
    let laws = Laws::elastic(NormalLaw::Linear);
    let c = Coefficients { stiffness: 1e6, ..Coefficients::default() };
    let room = WallShape::Box { lo: Vec3::new(-0.1, -0.1, 0.0), hi: Vec3::new(0.1, 0.1, 0.05) };
    let mut e = Engine::new(setup(laws, c, WallSetup::still(room), 5e-4), state).unwrap();
    let error = e.advance(100_000, &Run::serial()).unwrap_err().to_string();
    assert!(error.contains("blew up at step") && error.contains("deep"), "{error}");
}

#[test]
fn bad_input_is_told() {
    let state = || {
        let mut s = State::new(vec![ball()]);
        s.add(&Placed::at(Vec3::zeros())).unwrap();
        s
    };
    let error = |s: Setup| Engine::new(s, state()).err().unwrap().to_string();
    assert!(error(Setup::free(0.0)).contains("time step is 0"));
    assert!(error(Setup::free(f64::NAN)).contains("time step is NaN"));
    let mut s = Setup::free(1.0);
    s.coefficients[0].friction = -1.0;
    assert!(error(s).contains("friction of materials 0 and 0 is -1"));
    let mut s = Setup::free(1.0);
    s.laws = Some(Laws { tangential: TangentialLaw::NoSlip, ..Laws::elastic(NormalLaw::Linear) });
    assert!(error(s).contains("hertz"));
    let mut s = Setup::free(1.0);
    s.walls.push(plane(Vec3::zeros()));
    assert!(error(s).contains("wall 0 has the normal (0, 0, 0)"));
    let mut bad = State::new(vec![ball()]);
    for (body, text) in [
        (Placed { template: 3, ..Placed::at(Vec3::zeros()) }, "template 3 of 1"),
        (Placed::at(Vec3::new(f64::NAN, 0.0, 0.0)), "position (NaN, 0, 0)"),
        (Placed { rotation: [0.0; 4], ..Placed::at(Vec3::zeros()) }, "rotation (0, 0, 0, 0)"),
    ] {
        let e = bad.add(&body).unwrap_err().to_string();
        assert!(e.contains(text), "{e}");
    }
    assert!(Template::new(&[Sphere::new(Vec3::zeros(), 1.0)], 0.0, [1.0; 3]).is_err());
    assert!(Template::new(&[Sphere::new(Vec3::zeros(), 1.0)], 1.0, [1.0, 1.0, 3.0]).is_err());
}

#[test]
fn a_body_that_is_fixed_against_a_wall_is_not_damped() {
    for damping in [DampingLaw::None, DampingLaw::Bodies, DampingLaw::Contact] {
        let laws = Laws { damping, ..Laws::elastic(NormalLaw::Linear) };
        let (_, c) = rough();
        let mut state = State::new(vec![ball()]);
        let velocity = Vec3::new(0.1, 0.0, -0.1);
        let at = Placed::at(Vec3::new(0.0, 0.0, 0.01 - 1e-5));
        state.add(&Placed { fixed: true, velocity, ..at }).unwrap();
        let mut e = Engine::new(setup(laws, c, plane(Vec3::z()), 1e-6), state).unwrap();
        e.advance(10, &Run::serial()).unwrap();
        let force = e.on_wall(0).unwrap()[0];
        assert!((force.z / -(1e4 * (1e-5 + 1e-6)) - 1.0).abs() < 1e-9, "{damping:?}: {force}");
    }
}
