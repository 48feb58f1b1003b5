//! Stiff materials, unlike masses and sizes, many contacts at once, deep overlaps, and the time step
//! that they allow.

use super::{About, Bound, Matrix, Miss};
use morula::dem::{
    Coefficients, DampingLaw, Engine, Laws, NormalLaw, Placed, Setup, State, Template, WallSetup,
    WallShape, advice, effects::damping, energy,
};
use morula::math::{Sphere, Vec3};
use morula::run::Run;
use std::f64::consts::PI;
use std::sync::Arc;

const REBOUND: About = About {
    measure: "|rebound / speed - 1|",
    bound: Bound::AtMost(1e-5),
    why: "an elastic blow gives back the speed, at a fiftieth of the contact time",
};

const BLOW: About = About {
    measure: "greatest |speed - exact| / speed of the blow",
    bound: Bound::AtMost(1e-5),
    why: "two balls of any masses part as momentum and energy say",
};

const PLATE: About = About {
    measure: "|restitution - 0.6|",
    bound: Bound::AtMost(5e-3),
    why: "with contact averaging many contacts are as one",
};

const BOUNDED: About = About {
    measure: "greatest kinetic energy over what the springs held",
    bound: Bound::AtMost(1.01),
    why: "an overlap gives back what it holds and no more: speeds are at most √(2 E/m)",
};

const REFUSED: About = About {
    measure: "1 where the run was stopped with its reason, or ended with no energy gained",
    bound: Bound::AtLeast(1.0),
    why: "energy that comes from nothing is found out, whatever the step",
};

const STEP: About = About {
    measure: "advised step over the greatest stable one",
    bound: Bound::Within(0.2 * (1.0 - 1e-3), 0.8),
    why: "safe by a factor of at least 1.25, and of no more than 5; measured to 1e-3",
};

pub fn run(m: &mut Matrix) {
    stiff(m);
    unlike(m);
    plates(m);
    deep(m);
    steps(m);
}

fn engine(
    setup: Setup,
    c: Coefficients,
    templates: Vec<Template>,
    bodies: &[Placed],
) -> Result<Engine, Miss> {
    let mut state = State::new(templates.into_iter().map(Arc::new).collect());
    for body in bodies {
        state.add(body)?;
    }
    let mut setup = setup;
    setup.coefficients[0] = c;
    Ok(Engine::new(setup, state)?)
}

fn floor() -> WallSetup {
    WallSetup::still(WallShape::Plane { normal: Vec3::z(), offset: 0.0 })
}

fn stiff(m: &mut Matrix) {
    for (name, speed) in [("1 mm/s", 1e-3), ("1 m/s", 1.0), ("30 m/s", 30.0)] {
        m.case(format!("ball of 1 cm and 100 GPa at {name}"), &REBOUND, || {
            let (r, modulus) = (0.01, 1e11 / (2.0 * (1.0 - 0.09)));
            let ball = Template::ball(r, 2500.0)?;
            let depth =
                (15.0 / 16.0 * ball.mass() / (modulus * r.sqrt()) * speed * speed).powf(0.4);
            let dt = 2.94 * depth / speed / 50.0;
            let body = Placed {
                velocity: Vec3::new(0.0, 0.0, -speed),
                ..Placed::at(Vec3::new(0.0, 0.0, r + 0.3 * speed * dt))
            };
            let setup = Setup {
                laws: Some(Laws::elastic(NormalLaw::Hertz)),
                walls: vec![floor()],
                ..Setup::free(dt)
            };
            let c = Coefficients { stiffness: modulus, ..Coefficients::default() };
            let mut e = engine(setup, c, vec![ball], &[body])?;
            e.advance(200, &Run::serial())?;
            super::accumulation::off(e.state().velocity[0].z, speed)
        });
    }
}

/// A ball at rest is hit by another: central, elastic.
fn unlike(m: &mut Matrix) {
    for (name, radius, density) in [
        ("mass ratio 1e6, equal sizes", 1.0, 1e-6),
        ("mass ratio 1e-6, equal sizes", 1.0, 1e6),
        ("size ratio 100, mass ratio 1e6", 0.01, 1.0),
        ("size ratio 100, equal masses", 0.01, 1e6),
    ] {
        m.case(name, &BLOW, || {
            let balls = vec![Template::ball(1.0, 1.0)?, Template::ball(radius, density)?];
            let (a, b) = (balls[0].mass(), balls[1].mass());
            let (k, speed) = (1e4, 0.01);
            let dt = PI * (a * b / (a + b) / k).sqrt() / 50.0;
            let bodies = [
                Placed { velocity: Vec3::new(speed, 0.0, 0.0), ..Placed::at(Vec3::zeros()) },
                Placed {
                    template: 1,
                    ..Placed::at(Vec3::new(1.0 + radius + 0.3 * speed * dt, 0.0, 0.0))
                },
            ];
            let setup = Setup { laws: Some(Laws::elastic(NormalLaw::Linear)), ..Setup::free(dt) };
            let c = Coefficients { stiffness: k, ..Coefficients::default() };
            let mut e = engine(setup, c, balls, &bodies)?;
            e.advance(100, &Run::serial())?;
            let exact = [speed * (a - b) / (a + b), speed * 2.0 * a / (a + b)];
            let off = |i: usize| (e.state().velocity[i].x - exact[i]).abs() / speed;
            Ok(off(0).max(off(1)))
        });
    }
}

/// n × n spheres in a plane, mass 1.
fn plate(n: usize) -> Result<Template, Miss> {
    let at = |i: usize| 0.01 * (i as f64 - 0.5 * (n as f64 - 1.0));
    let sphere = |k: usize| Sphere::new(Vec3::new(at(k % n), at(k / n), 0.0), 0.01);
    let spheres: Vec<Sphere> = (0..n * n).map(sphere).collect();
    // Of a plate as wide as its spheres reach.
    let i = (0.01 * n as f64 + 0.01).powi(2) / 12.0;
    Ok(Template::new(&spheres, 1.0, [i, i, 2.0 * i])?)
}

fn plates(m: &mut Matrix) {
    for n in [1, 10, 60] {
        m.case(format!("plate of {} coplanar contacts, averaged", n * n), &PLATE, || {
            let laws = Laws {
                damping: DampingLaw::Bodies,
                averaging: true,
                ..Laws::elastic(NormalLaw::Linear)
            };
            let k: f64 = 1e6;
            let dt = PI / k.sqrt() / 50.0;
            let setup = Setup { laws: Some(laws), walls: vec![floor()], ..Setup::free(dt) };
            let c = Coefficients {
                stiffness: k,
                damping: 2.0 * damping::ratio(0.6),
                ..Coefficients::default()
            };
            let body = Placed {
                velocity: Vec3::new(0.0, 0.0, -1.0),
                ..Placed::at(Vec3::new(0.0, 0.0, 0.01 + 0.3 * dt))
            };
            let mut e = engine(setup, c, vec![plate(n)?], &[body])?;
            e.advance(100, &Run::serial())?;
            Ok((e.state().velocity[0].z - 0.6).abs())
        });
    }
}

/// Two clumps of four spheres, half a radius in each other, 100 GPa.
fn overlapping(part: f64) -> Result<(Engine, f64), Miss> {
    let (r, modulus) = (0.01, 1e11 / (2.0 * (1.0 - 0.09)));
    let corner = |k: usize| {
        let sign = |b: usize| if k >> b & 1 == 1 { 1.0 } else { -1.0 };
        Vec3::new(sign(0), sign(1), sign(0) * sign(1)) * 0.6 * r
    };
    let spheres: Vec<Sphere> = (0..4).map(|k| Sphere::new(corner(k), r)).collect();
    let mass = 0.03;
    let clump = Template::new(&spheres, mass, [1.3e-6; 3])?;
    // The stiffness at that depth.
    let k = 2.0 * modulus * (0.5 * r * 0.5 * r).sqrt();
    let dt = part * (mass / k).sqrt();
    let bodies = [Placed::at(Vec3::zeros()), Placed::at(Vec3::new(2.7 * r, 0.0, 0.0))];
    let setup = Setup { laws: Some(Laws::elastic(NormalLaw::Hertz)), ..Setup::free(dt) };
    let c = Coefficients { stiffness: modulus, ..Coefficients::default() };
    let mut e = engine(setup, c, vec![clump], &bodies)?;
    e.start(&Run::serial())?;
    let held = e.contacts().iter().flatten().map(|c| c.energy).sum();
    Ok((e, held))
}

fn deep(m: &mut Matrix) {
    m.case("clumps half a radius in each other, small steps", &BOUNDED, || {
        let (mut e, held) = overlapping(0.02)?;
        let mut most = 0.0f64;
        for _ in 0..500 {
            e.advance(1, &Run::serial())?;
            most = most.max(energy::kinetic(e.state()).iter().sum());
        }
        Ok(most / held)
    });
    m.case("clumps half a radius in each other, steps far too large", &REFUSED, || {
        let (mut e, held) = overlapping(20.0)?;
        match e.advance(500, &Run::serial()) {
            Err(error) => Ok(f64::from(u8::from(error.to_string().contains("blew up")))),
            Ok(()) if energy::kinetic(e.state()).iter().sum::<f64>() > 1.01 * held => Ok(0.0),
            Ok(()) => Ok(1.0),
        }
    });
}

/// Whether two plates pressed against each other, each sphere on its twin, stay as they are.
fn stays(template: &Template, k: f64, dt: f64) -> Result<bool, Miss> {
    let radius = template.spheres()[0].radius;
    let depth = 1e-2 * radius;
    let apart = 2.0 * radius - depth;
    let mut setup = Setup { laws: Some(Laws::elastic(NormalLaw::Linear)), ..Setup::free(dt) };
    setup.guard = false;
    let c = Coefficients { stiffness: k, ..Coefficients::default() };
    // Both pressed together by the wall of their own weight: they swing about their rest.
    let n = template.spheres().len() as f64;
    let pull = n * k * depth / template.mass();
    let fixed = Placed { fixed: true, ..Placed::at(Vec3::zeros()) };
    let above = Placed {
        velocity: Vec3::new(0.0, 0.0, 1e-3 * depth / dt),
        ..Placed::at(Vec3::new(0.0, 0.0, apart))
    };
    setup.gravity = Some(Vec3::new(0.0, 0.0, -pull));
    let mut e = engine(setup, c, vec![template.clone()], &[fixed, above])?;
    let _ = e.advance(400, &Run::serial());
    let z = e.state().position[1].z;
    Ok(z.is_finite() && (z - apart).abs() < 0.5 * depth)
}

fn steps(m: &mut Matrix) {
    for n in [1usize, 2, 3, 10, 30, 60] {
        m.case(format!("{} contacts at once", n * n), &STEP, || {
            let (template, k) = (plate(n)?, 1e6);
            let mut state = State::new(vec![Arc::new(template.clone())]);
            state.add(&Placed::at(Vec3::zeros()))?;
            let c = Coefficients { stiffness: k, ..Coefficients::default() };
            let laws = Laws::elastic(NormalLaw::Linear);
            let found = advice::advise(&laws, &[c], &state, 1.0, (n * n) as u32)?;
            let found = found.ok_or(Miss("no advice".into()))?;
            // Against a fixed one the greatest step is √2 times that of two that move.
            let (mut lo, mut hi) = (0.1 * found.limit, 10.0 * found.limit);
            while hi / lo > 1.0 + 5e-4 {
                let middle = (lo * hi).sqrt();
                if stays(&template, k, middle)? { lo = middle } else { hi = middle }
            }
            Ok(found.step / (lo / 2f64.sqrt()))
        });
    }
}
