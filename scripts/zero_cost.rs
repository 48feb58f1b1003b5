//! A scene without any effect but the one that its name says, for `scripts/zero_cost.sh`.
//!
//!     zero_cost gas STEPS     clumps that push each other by springs in a box, nothing else
//!     zero_cost fall STEPS    the same bodies under gravity, without contacts

use morula::dem::{
    Coefficients, Engine, Laws, NormalLaw, Placed, Setup, State, Template, WallSetup, WallShape,
};
use morula::math::{Sphere, Vec3};
use morula::Run;
use std::sync::Arc;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let steps: u64 = args[2].parse().unwrap();
    let corner = |k: u32| Vec3::from_fn(|a, _| if k >> a & 1 == 1 { 0.006 } else { -0.006 });
    let spheres: Vec<Sphere> = (0..8).map(|k| Sphere::new(corner(k), 0.005)).collect();
    let template = Template::new(&spheres, 0.02, [1e-6, 1.1e-6, 1.2e-6]).unwrap();
    let mut state = State::new(vec![Arc::new(template)]);
    let (n, gap) = (4, 0.033);
    let mut seed = 1u64;
    let mut random = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    for k in 0..n * n * n {
        let at = Vec3::new((k % n) as f64, (k / n % n) as f64, (k / n / n) as f64) * gap;
        let velocity = Vec3::new(random(), random(), random()) * 2.0;
        let angular_velocity = Vec3::new(random(), random(), random()) * 100.0;
        state.add(&Placed { velocity, angular_velocity, ..Placed::at(at) }).unwrap();
    }
    let mut setup = Setup { guard: false, ..Setup::free(5e-5) };
    if args[1] == "gas" {
        let half = 0.5 * gap;
        let lo = Vec3::repeat(-half);
        let hi = Vec3::repeat(gap * n as f64 - half);
        setup.walls = vec![WallSetup::still(WallShape::Box { lo, hi })];
        setup.laws = Some(Laws::elastic(NormalLaw::Linear));
        setup.coefficients[0] = Coefficients { stiffness: 1e4, ..Coefficients::default() };
    } else {
        setup.gravity = Some(Vec3::new(0.0, 0.0, -9.81));
    }
    let mut engine = Engine::new(setup, state).unwrap();
    engine.advance(steps, &Run::serial()).unwrap();
    let sum: f64 = engine.state().position.iter().map(|x| x.sum()).sum();
    println!("{} contacts, {sum:?}", engine.work().contacts);
}
