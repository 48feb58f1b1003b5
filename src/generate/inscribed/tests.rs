use super::climb::Climb;
use super::depth::{Depth, Inside};
use super::swap::Swaps;
use crate::generate::balls::bounds;
use crate::generate::balls::dexels::Dexels;
use crate::generate::balls::field::Field;
use crate::generate::balls::random::Random;
use crate::generate::{GenerateOptions, Method, inscribed_within};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::shape::primitive::Primitive;
use crate::shape::{ImportOptions, Shape};
use crate::solid::{Resolution, Solid, SolidOptions};

fn stone() -> Solid {
    let run = Run::serial();
    let primitive = Primitive::from_name("stone").unwrap();
    let shape = Shape::from_primitive(&primitive, 24, &ImportOptions::default(), &run).unwrap();
    let resolution = Resolution::CellsLongest(32);
    Solid::new(&shape, &SolidOptions { resolution, ..SolidOptions::default() }, &run).unwrap()
}

/// Has balls about places by chance climb, and hands them to `f`.
fn with_balls(solid: &Solid, n: usize, f: impl FnOnce(Climb, Random)) {
    let run = Run::serial();
    let field = Field::new(solid.grid(), solid.distance(&run).unwrap(), run.pool()).unwrap();
    let dexels = Dexels::new(solid, &bounds(solid).unwrap(), 2700, run.pool()).unwrap();
    let surface = solid.surface(&run).unwrap();
    let bound = None;
    let depth = Depth { field: &field, surface, bound, tolerance: 0.0, least: 1e-3, size: 1.0 };
    let mut random = Random::new(7, 0);
    let places = dexels.points(n, &mut random).unwrap();
    let balls: Vec<Inside> = places.into_iter().filter_map(|p| depth.exact(p)).collect();
    assert!(balls.len() > n / 2);
    f(Climb::new(&dexels, &depth, balls).unwrap(), random);
}

#[test]
fn what_a_ball_covers_alone_is_what_is_lost_without_it() {
    let solid = stone();
    with_balls(&solid, 12, |mut climb, _| {
        for i in 0..climb.balls.len() {
            let all = climb.coverage();
            let ball = climb.balls.remove(i);
            let lost = (all - climb.coverage()) * climb.dexels.target;
            climb.balls.insert(i, ball);
            let own = climb.own(&ball.ball, i);
            assert!((own - lost).abs() < 1e-4 * climb.dexels.target, "{i}: {own} {lost}");
        }
    });
}

#[test]
fn no_ball_leaves_a_further_bound() {
    let solid = stone();
    let ball = Sphere::new(solid.unit_moments().centroid, 0.3);
    let bound = |p: &Vec3| {
        let way = p - ball.center;
        let apart = way.norm().max(1e-9);
        (ball.radius - apart, ball.center + way * (ball.radius / apart))
    };
    let options = GenerateOptions { method: Method::Inscribed, spheres: 8, ..Default::default() };
    let made = inscribed_within(&solid, &options, &bound, &Run::serial()).unwrap().spheres;
    let made: Vec<Sphere> = made.iter().map(|s| solid.frame().sphere_to_unit(s)).collect();
    let surface = solid.surface(&Run::serial()).unwrap();
    for s in &made {
        let depth = surface.nearest(&s.center).distance.min(bound(&s.center).0);
        assert!(surface.contains(&s.center) && (s.radius - depth).abs() < 1e-9);
    }
    assert!(made[0].radius > 0.1 && made.len() > 1, "{made:?}");
    let others = GenerateOptions::default();
    assert!(inscribed_within(&solid, &others, &bound, &Run::serial()).is_err());
}

#[test]
fn no_sweep_and_no_swap_covers_less() {
    let solid = stone();
    with_balls(&solid, 14, |mut climb, mut random| {
        let all: Vec<u32> = (0..climb.balls.len() as u32).collect();
        let mut before = climb.coverage();
        let first = before;
        for k in 0..12 {
            climb.sweep(&all, k as f32 / 11.0, &mut random);
            let now = climb.coverage();
            assert!(now >= before - 1e-6, "{before} {now}");
            before = now;
        }
        assert!(before > first + 0.05, "{first} {before}");
        // A ball that covers nothing is soon put elsewhere.
        climb.put(0, climb.balls[1], None);
        let with_a_double = climb.coverage();
        let mut swaps = Swaps::new(climb.balls.len());
        swaps.search(&mut climb, 20, &mut random, &mut |_| true);
        let now = climb.coverage();
        assert!(now > with_a_double + 1e-3, "{with_a_double} {now}");
        // What the columns hold is what the balls cover.
        let d = climb.depth;
        assert!(climb.balls.iter().all(|b| {
            let s = d.sphere(&b.ball);
            (s.radius - f64::from(b.ball.radius)).abs() < 1e-6
        }));
    });
}
