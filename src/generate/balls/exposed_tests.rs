//! The fast sums against a slow transcription, and the forces against volumes.

use super::super::cover::{Cover, Lengths, Look};
use super::super::dexels::Seen;
use super::super::directions::Directions;
use super::super::random::Random;
use super::super::test_bodies::{Bodies, bodies};
use super::*;
use crate::run::Pool;

/// Some overlapping balls about the middle of the body.
fn clump(body: &Bodies, n: usize, seed: u64) -> Vec<Ball> {
    let mut random = Random::new(seed, 1);
    let [low, high] = body.bounds;
    (0..n)
        .map(|_| Ball {
            center: [0, 1, 2].map(|a| {
                let middle = 0.5 * (low[a] + high[a]);
                (middle + random.between(-0.35, 0.35) * (high[a] - low[a])) as f32
            }),
            radius: random.between(0.05, 0.2) as f32,
        })
        .collect()
}

/// As [`Sampler::normal`], direction by direction in double precision. Directions nearer than
/// rounding to the edge of a cap are counted, so that both sides of it can be allowed.
fn slow(sampler: &Sampler, i: usize, balls: &[Ball]) -> (Normal, usize) {
    let (mut out, mut doubtful) = (Normal::default(), 0);
    let ball = balls[i].sphere();
    for group in sampler.directions {
        let [x, y, z] = group.map(|v| v.to_array());
        for l in 0..8 {
            let d = [x[l], y[l], z[l]].map(f64::from);
            let p = ball.center + crate::math::Vec3::from(d) * ball.radius;
            let mut hidden = false;
            for (j, other) in balls.iter().enumerate() {
                let depth = f64::from(other.radius) - (other.sphere().center - p).norm();
                hidden |= j != i && depth > 0.0;
                doubtful += usize::from(j != i && depth.abs() < 1e-5);
            }
            if hidden {
                continue;
            }
            let f = f64::from(sampler.field.one([p.x as f32, p.y as f32, p.z as f32]));
            let w =
                f64::from(if f < 0.0 { sampler.weights.inside } else { sampler.weights.outside });
            let pull = f.clamp(-f64::from(sampler.width), f64::from(sampler.width));
            let v = [d[0], d[1], d[2], 1.0];
            let mut at = 0;
            for a in 0..4 {
                for b in a..4 {
                    out.m[at] += w * v[a] * v[b];
                    at += 1;
                }
                out.b[a] -= w * pull * v[a];
            }
            out.exposed += 1;
        }
    }
    (out, doubtful)
}

#[test]
fn sums_are_those_of_the_slow_transcription() {
    for body in bodies() {
        let field = Field::new(body.solid.grid(), &body.distance, &Pool::serial()).unwrap();
        let directions = Directions::new(96);
        let mut random = Random::new(7, 7);
        let mut turned = Vec::new();
        for (round, n) in [1, 2, 5, 20, 40].into_iter().enumerate() {
            let balls = clump(&body, n, round as u64);
            directions.turned(&random.rotation(), &mut turned);
            let weights = Weights { inside: 1.1, outside: 0.9, square: 0.0 };
            let sampler = Sampler { field: &field, directions: &turned, weights, width: 0.02 };
            let mut scratch = Scratch::default();
            for i in 0..n {
                let others = balls.iter().enumerate().filter(|&(j, _)| j != i).map(|(_, b)| b);
                let fast = sampler.normal(&balls[i], others, &mut scratch);
                let (slow, doubtful) = slow(&sampler, i, &balls);
                assert!(fast.exposed.abs_diff(slow.exposed) <= doubtful);
                if doubtful == 0 {
                    let close = |x: &f64, y: &f64| (x - y).abs() < 1e-3;
                    assert!(
                        fast.m.iter().zip(&slow.m).all(|(x, y)| close(x, y)),
                        "{fast:?} {slow:?}"
                    );
                    assert!(
                        fast.b.iter().zip(&slow.b).all(|(x, y)| close(x, y)),
                        "{fast:?} {slow:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_ball_in_another_is_hidden_and_hides_nothing() {
    let body = &bodies()[0];
    let field = Field::new(body.solid.grid(), &body.distance, &Pool::serial()).unwrap();
    let directions = Directions::new(48);
    let mut turned = Vec::new();
    directions.turned(&Random::new(1, 2).rotation(), &mut turned);
    let weights = Weights::at(0.0, 1.0);
    let sampler = Sampler { field: &field, directions: &turned, weights, width: 0.02 };
    let ball = |radius: f32| Ball { center: [0.3, 0.3, 0.3], radius };
    let mut scratch = Scratch::default();
    let mut exposed =
        |a: f32, b: f32| sampler.normal(&ball(a), std::iter::once(&ball(b)), &mut scratch).exposed;
    assert_eq!((exposed(0.1, 0.2), exposed(0.2, 0.1)), (0, 48));
}

/// The change of `w_out |C∖S| − w_in |S∩C|` with each coordinate: the pull of the exposed surface
/// with a narrow loss, against differences of the volumes by columns.
#[test]
fn pulls_are_the_slopes_of_volumes() {
    for body in bodies() {
        let field = Field::new(body.solid.grid(), &body.distance, &Pool::serial()).unwrap();
        let dexels = body.dexels(100_000);
        let directions = Directions::new(40_000);
        let mut turned = Vec::new();
        directions.turned(&Random::new(5, 5).rotation(), &mut turned);
        let balls = clump(&body, 6, 3);
        let weights = Weights { inside: 1.3, outside: 0.8, square: 0.0 };
        let width = 1e-4;
        let sampler = Sampler { field: &field, directions: &turned, weights, width };
        let mut cover = Cover::new(&dexels).unwrap();
        let mut cost = |balls: &[Ball]| {
            let seen: Vec<Seen> = balls.iter().map(|b| dexels.seen(b)).collect();
            let Lengths { union, both } = cover.whole(&dexels, &seen, &mut Look::default());
            (0.8 * (union - both) - 1.3 * both) * dexels.cell()
        };
        let mut scratch = Scratch::default();
        for i in 0..balls.len() {
            let others = balls.iter().enumerate().filter(|&(j, _)| j != i).map(|(_, b)| b);
            let normal = sampler.normal(&balls[i], others, &mut scratch);
            let r = f64::from(balls[i].radius);
            let area = 4.0 * std::f64::consts::PI * r * r;
            for a in 0..4 {
                let slope = -normal.b[a] / f64::from(width) * area / directions.len() as f64;
                let by = |h: f32| {
                    let mut moved = balls.clone();
                    match a {
                        3 => moved[i].radius += h,
                        a => moved[i].center[a] += h,
                    }
                    moved
                };
                let h = 4e-3;
                let difference = (cost(&by(h)) - cost(&by(-h))) / (2.0 * f64::from(h));
                assert!(
                    (slope - difference).abs() < 0.03 * area,
                    "ball {i} coordinate {a}: {slope} {difference} of {area}"
                );
            }
        }
    }
}

#[test]
fn among_many_balls_the_same_directions_are_exposed() {
    let body = &bodies()[0];
    let field = Field::new(body.solid.grid(), &body.distance, &Pool::serial()).unwrap();
    let (directions, mut turned) = (Directions::new(96), Vec::new());
    let mut random = Random::new(8, 8);
    let mut balls = clump(body, 400, 3);
    let (all, mut scratch) = ((0..400).collect::<Vec<u32>>(), Scratch::default());
    let mut hiders = vec![Hiders::default(); balls.len()];
    let mut exposed = 0;
    for _ in 0..4 {
        directions.turned(&random.rotation(), &mut turned);
        let weights = Weights::at(0.1, 1.0);
        let sampler = Sampler { field: &field, directions: &turned, weights, width: 0.01 };
        for i in 0..balls.len() {
            let others: Vec<u32> = all.iter().copied().filter(|&j| j as usize != i).collect();
            let (some, rest) = others.split_at(300);
            let by_all = others.iter().map(|&j| &balls[j as usize]);
            let slow = sampler.normal(&balls[i], by_all, &mut scratch);
            let lists = [some, rest];
            let fast =
                sampler.normal_among((i as u32, &balls), lists, &mut hiders[i], &mut scratch);
            assert_eq!(slow, fast, "{i}");
            exposed += slow.exposed;
        }
        for ball in &mut balls {
            ball.center[0] += random.between(-0.01, 0.01) as f32;
        }
    }
    assert!(exposed > 1000);
}
