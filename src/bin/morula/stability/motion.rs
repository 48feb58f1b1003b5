//! Many steps over: rotation, a resting stack, a gas of clumps.

use super::{About, Bound, Found, Matrix, Miss};
use morula::dem::advice::advise;
use morula::dem::{
    Coefficients, DampingLaw, Engine, Laws, NormalLaw, Placed, Setup, State, TangentialLaw,
    Template, WallSetup, WallShape, effects::damping, energy,
};
use morula::math::{Sphere, Vec3};
use morula::run::Run;
use std::f64::consts::PI;
use std::sync::Arc;

const MOMENTUM: About = About {
    measure: "greatest |L/L0 - 1|",
    bound: Bound::AtMost(1e-11),
    why: "angular momentum is carried, the turn is summed with its rounding",
};

const TURNING: About = About {
    measure: "greatest |E/E0 - 1|",
    bound: Bound::AtMost(1e-9),
    why: "the turn between forces is exact, so that only rounding is left",
};

const SPLIT: About = About {
    measure: "greatest |E/E0 - 1|",
    bound: Bound::AtMost(4e-4),
    why: "a splitting swings by (w dt)^2 at most, and does not drift",
};

const TINY: About = About {
    measure: "|angle / exact - 1|",
    bound: Bound::AtMost(1e-6),
    why: "turns far below a rounding of the orientation still add up",
};

const CREEP: About = About {
    measure: "greatest displacement, in diameters",
    bound: Bound::AtMost(1e-6),
    why: "what rests goes on resting",
};

const GAS: About = About {
    measure: "greatest |E/E0 - 1| at a fiftieth of the contact time",
    bound: Bound::AtMost(1e-4),
    why: "a closed elastic gas keeps its energy; that contact time where the clump is felt least",
};

const GAS_FINE: About =
    About { measure: "greatest |E/E0 - 1| at a hundredth of the contact time", ..GAS };

const SECULAR: About = About {
    measure: "|mean of E/E0 - 1| over 8 gases, in its standard errors",
    bound: Bound::AtMost(4.0),
    why: "what is left errs both ways alike: nothing drifts",
};

const MEAN: About = About {
    measure: "|mean of E/E0 - 1| over 8 gases",
    bound: Bound::AtMost(2e-5),
    why: "what is left swings within contacts, by (w dt)^2 of what they hold",
};

const FALLS: About = About {
    measure: "observed order in dt",
    bound: Bound::AtLeast(1.7),
    why: "leapfrog and splitting are of second order",
};

pub fn run(m: &mut Matrix) {
    rotation(m);
    stack(m);
    gas(m);
}

/// A T-bar about its middle axis, which it cannot hold.
fn rotation(m: &mut Matrix) {
    let steps: u64 = if m.full { 10_000_000 } else { 200_000 };
    let split = format!("free rotation by splitting, {steps} steps");
    match tumbling(steps, false) {
        Ok((l, e)) => {
            m.case(split.clone(), &MOMENTUM, || Ok(l));
            m.case(split, &SPLIT, || Ok(e));
        }
        Err(miss) => m.case(split, &MOMENTUM, || Err(miss)),
    }
    let found = tumbling(steps, true);
    let name = format!("free rotation, {steps} steps");
    let (l, e) = match found {
        Ok(found) => found,
        Err(miss) => return m.case(name, &MOMENTUM, || Err(miss)),
    };
    m.case(name.clone(), &MOMENTUM, || Ok(l));
    m.case(name, &TURNING, || Ok(e));
    m.case(format!("1e-12 rad a step, {steps} steps"), &TINY, || tiny(steps));
}

fn tumbling(steps: u64, exact_rotation: bool) -> Result<(f64, f64), Miss> {
    let moments = [7.843, 15.257, 22.574];
    let template = Template::new(&[Sphere::new(Vec3::zeros(), 0.5)], 5.2438, moments)?;
    let mut state = State::new(vec![Arc::new(template)]);
    let angular_velocity = Vec3::new(0.02, 2.0, 0.01);
    state.add(&Placed { angular_velocity, ..Placed::at(Vec3::zeros()) })?;
    let mut e = Engine::new(Setup { exact_rotation, ..Setup::free(0.01) }, state)?;
    let run = Run::serial();
    let spin = |e: &Engine| -> (Vec3, f64) {
        let turn = e.state().orientation[0].matrix();
        let own = turn.transpose() * e.state().angular_velocity(0);
        let l = turn * own.component_mul(&Vec3::from(moments));
        (l, energy::kinetic(e.state())[1])
    };
    let (l0, e0) = spin(&e);
    let (mut worst_l, mut worst_e) = (0.0f64, 0.0f64);
    for _ in 0..100 {
        e.advance(steps / 100, &run)?;
        let (l, energy) = spin(&e);
        worst_l = worst_l.max((l - l0).norm() / l0.norm());
        worst_e = worst_e.max((energy / e0 - 1.0).abs());
    }
    Ok((worst_l, worst_e))
}

fn tiny(steps: u64) -> Found {
    let template = Template::new(&[Sphere::new(Vec3::zeros(), 1.0)], 1.0, [0.4; 3])?;
    let mut state = State::new(vec![Arc::new(template)]);
    let rate = 1e-12;
    let angular_velocity = Vec3::new(0.0, 0.0, rate);
    state.add(&Placed { angular_velocity, ..Placed::at(Vec3::zeros()) })?;
    let mut e = Engine::new(Setup::free(1.0), state)?;
    e.advance(steps, &Run::serial())?;
    let q = &e.state().orientation[0];
    // About z from rest: the half angle is the third of the vector's parts.
    super::accumulation::off(2.0 * (q.quaternion[3] + q.rest[3]), rate * steps as f64)
}

fn plane() -> WallSetup {
    WallSetup::still(WallShape::Plane { normal: Vec3::z(), offset: 0.0 })
}

/// Bricks of 3 × 3 overlapping spheres of radius 1 cm, on each other on a floor.
fn stack(m: &mut Matrix) {
    for (name, slope) in
        [("three bricks at rest", 0.0f64), ("three bricks on a slope of 12°", 12.0)]
    {
        resting(m, name, slope.to_radians());
    }
}

fn resting(m: &mut Matrix, name: &str, slope: f64) {
    let steps: u64 = if m.full { 1_000_000 } else { 20_000 };
    m.case(format!("{name}, {steps} steps"), &CREEP, || {
        let r = 0.01;
        let at = |k: usize| Vec3::new((k % 3) as f64 - 1.0, (k / 3) as f64 - 1.0, 0.0) * r;
        let spheres: Vec<Sphere> = (0..9).map(|k| Sphere::new(at(k), r)).collect();
        let mass = 0.05;
        let i = mass * r * r;
        let brick = Template::new(&spheres, mass, [i, i, 1.4 * i])?;
        let mut state = State::new(vec![Arc::new(brick)]);
        for k in 0..3 {
            // On a slope none lies straight on another.
            let aside = if slope > 0.0 { 0.1 * r * f64::from(k) } else { 0.0 };
            state.add(&Placed::at(Vec3::new(aside, 0.0, r * (1.0 + 2.0 * f64::from(k)))))?;
        }
        let laws = Laws {
            damping: DampingLaw::Contact,
            tangential: TangentialLaw::Mindlin,
            ..Laws::elastic(NormalLaw::Linear)
        };
        let mut setup = Setup { laws: Some(laws), walls: vec![plane()], ..Setup::free(1e-5) };
        setup.gravity = Some(Vec3::new(slope.sin(), 0.0, -slope.cos()) * 9.81);
        setup.coefficients[0] = Coefficients {
            stiffness: 1e4,
            shear: 8e3,
            damping: 2.0 * damping::ratio(0.3),
            tangential_damping: 1.0,
            friction: 0.4,
            ..Coefficients::default()
        };
        let mut e = Engine::new(setup, state)?;
        let run = Run::serial();
        // Leaning ones rock for two seconds.
        e.advance(if slope > 0.0 { 400_000 } else { 20_000 }, &run)?;
        let before = e.state().position.clone();
        let mut most = 0.0f64;
        for _ in 0..100 {
            e.advance(steps / 100, &run)?;
            let moved = before.iter().zip(&e.state().position).map(|(a, b)| (a - b).norm());
            most = moved.fold(most, f64::max);
        }
        Ok(most / (2.0 * r))
    });
}

/// Three spheres of unlike moments, mass 1.
fn lump() -> Result<Template, Miss> {
    let r = 0.3;
    let spheres = [
        Sphere::new(Vec3::new(-0.25, 0.05, 0.0), r),
        Sphere::new(Vec3::new(0.25, 0.05, 0.0), r),
        Sphere::new(Vec3::new(0.0, -0.1, 0.1), 0.8 * r),
    ];
    Ok(Template::new(&spheres, 1.0, [0.05, 0.09, 0.1])?)
}

/// 27 of them in a box, elastic, thrown otherwise for each `seed`: the error of the energy over a time, the
/// greatest and the last.
fn drift(law: NormalLaw, dt: f64, steps: u64, seed: u32) -> Result<[f64; 2], Miss> {
    let template = lump()?;
    let mut state = State::new(vec![Arc::new(template)]);
    for k in 0..27u32 {
        let at = |a: u32| f64::from(k / 3u32.pow(a) % 3) * 1.6 - 1.6;
        let turned = |a: u32| f64::from((k * 7 + seed * 3 + a * (5 + seed)) % 13) / 6.5 - 1.0;
        state.add(&Placed {
            rotation: [0.4, turned(0), turned(1), turned(2)],
            velocity: Vec3::new(turned(3), turned(5), turned(8)),
            angular_velocity: Vec3::new(turned(4), turned(6), turned(7)),
            ..Placed::at(Vec3::new(at(0), at(1), at(2)))
        })?;
    }
    let wall = WallShape::Box { lo: Vec3::repeat(-2.6), hi: Vec3::repeat(2.6) };
    let mut setup = Setup {
        laws: Some(Laws::elastic(law)),
        walls: vec![WallSetup::still(wall)],
        ..Setup::free(dt)
    };
    setup.coefficients[0] = Coefficients { stiffness: STIFFNESS, ..Coefficients::default() };
    let mut e = Engine::new(setup, state)?;
    let run = Run::serial();
    e.start(&run)?;
    let total = |e: &Engine| {
        let [a, b] = energy::kinetic(e.state());
        a + b + e.contacts().iter().flatten().map(|c| c.energy).sum::<f64>()
    };
    let first = total(&e);
    let (mut worst, mut last) = (0.0f64, 0.0);
    for _ in 0..200 {
        e.advance(steps / 200, &run)?;
        last = total(&e) / first - 1.0;
        worst = worst.max(last.abs());
    }
    Ok([worst, last])
}

const STIFFNESS: f64 = 1e5;
/// The speed of the fastest.
const SPEED: f64 = 2.0;

/// Of two in contact at the points where they are felt least: the advice is √(2 m/k). A spring is done
/// after π √(m/2k), Hertz's contact after 2.94 δ/v, where v² = 8 k δ²/(15 m/2).
fn contact_time(law: NormalLaw) -> Found {
    let state = State::new(vec![Arc::new(lump()?)]);
    let c = Coefficients { stiffness: STIFFNESS, ..Coefficients::default() };
    let found = advise(&Laws::elastic(law), &[c], &state, SPEED, 1)?;
    let of_limit = match law {
        NormalLaw::Linear => 0.5 * PI,
        NormalLaw::Hertz => 2.94 * (15.0f64 / 32.0).sqrt(),
    };
    Ok(of_limit * found.ok_or(Miss("no advice".into()))?.limit)
}

fn gas(m: &mut Matrix) {
    let steps: u64 = if m.full { 1_000_000 } else { 20_000 };
    let [linear, hertz] = [NormalLaw::Linear, NormalLaw::Hertz];
    let worst = |law, part: f64| Ok(drift(law, contact_time(law)? / part, steps, 0)?[0]);
    m.case(format!("gas of 27 clumps of Hertz's law, {steps} steps"), &GAS, || worst(hertz, 50.0));
    m.case(format!("gas of 27 clumps, {steps} steps"), &GAS, || worst(linear, 50.0));
    m.case(format!("gas of 27 clumps, {steps} steps"), &GAS_FINE, || worst(linear, 100.0));
    m.case(format!("gases of 27 clumps, {} steps", steps / 4), &SECULAR, || {
        let dt = contact_time(linear)? / 50.0;
        let all: Result<Vec<f64>, Miss> =
            (0..8).map(|seed| Ok(drift(linear, dt, steps / 4, seed)?[1])).collect();
        let all = all?;
        let mean = all.iter().sum::<f64>() / 8.0;
        let spread = (all.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / 56.0).sqrt();
        Ok(mean.abs() / spread)
    });
    m.case(format!("gases of 27 clumps, {} steps", steps / 4), &MEAN, || {
        let dt = contact_time(linear)? / 50.0;
        let all: Result<Vec<f64>, Miss> =
            (0..8).map(|seed| Ok(drift(linear, dt, steps / 4, seed)?[1])).collect();
        Ok((all?.iter().sum::<f64>() / 8.0).abs())
    });
    m.case("gas of 27 clumps, a fiftieth and a two-hundredth", &FALLS, || {
        let (dt, steps) = (contact_time(linear)? / 50.0, steps.min(100_000));
        let coarse = drift(linear, dt, steps, 0)?[0];
        Ok((coarse / drift(linear, 0.25 * dt, 4 * steps, 0)?[0]).log2() / 2.0)
    });
}
