//! Distances against all balls one by one, changes against whole sums, pulls against slopes.

use super::super::cover::Look;
use super::super::drawn::Drawn;
use super::super::exposed::Normal;
use super::super::near::Near;
use super::super::test_bodies::{Bodies, bodies};
use super::*;
use crate::run::Pool;

fn clump(n: usize, seed: u64) -> Vec<Ball> {
    let mut random = Random::new(seed, 2);
    (0..n)
        .map(|_| Ball {
            center: [0; 3].map(|_| random.between(0.1, 0.5) as f32),
            radius: random.between(0.05, 0.15) as f32,
        })
        .collect()
}

fn field_and_points(body: &Bodies, balls: usize) -> (Field, Vec<[f32; 3]>, f64) {
    let field = Field::new(body.solid.grid(), &body.distance, &Pool::serial()).unwrap();
    let (points, area) = points(&field, body.solid.grid(), balls, &mut Random::new(3, 3)).unwrap();
    (field, points, area)
}

#[test]
fn points_are_spread_evenly_over_the_surface() {
    let all = bodies();
    let (_, on_box, area) = field_and_points(&all[0], 200);
    assert!(on_box.len() > 5000, "{}", on_box.len());
    let [low, high] = all[0].bounds;
    let edge = high.x - low.x;
    assert!((area / (6.0 * edge * edge) - 1.0).abs() < 0.05, "{area}");
    let mut faces = [0usize; 6];
    for p in &on_box {
        let ends = (0..6).map(|k| {
            let end = if k < 3 { low[k] } else { high[k - 3] };
            (f64::from(p[k % 3]) - end).abs()
        });
        let (face, off) = ends.enumerate().min_by(|x, y| x.1.total_cmp(&y.1)).unwrap();
        assert!(off < 4e-3, "{p:?} {off}");
        faces[face] += 1;
    }
    let mean = on_box.len() / 6;
    assert!(faces.iter().all(|&n| n.abs_diff(mean) < mean / 10), "{faces:?}");

    // The outer half of a torus has more area than the inner: ½ ± r / (π R) of it.
    let (_, on_torus, _) = field_and_points(&all[1], 200);
    let middle = 0.5 * (all[1].bounds[0] + all[1].bounds[1]);
    let scale = all[1].solid.frame().scale;
    let outer = on_torus.iter().filter(|p| {
        let [x, y] = [0, 1].map(|a| f64::from(p[a]) - middle[a]);
        x.hypot(y) * scale > 1.0
    });
    let share = outer.count() as f64 / on_torus.len() as f64;
    assert!((share - 0.5 - 0.4 / std::f64::consts::PI).abs() < 0.015, "{share}");
}

/// The distance of a point from the nearest ball, and its number.
fn slow(p: &[f32; 3], balls: &[Ball]) -> (f64, usize) {
    let each = balls.iter().enumerate().map(|(i, b)| {
        let way = [0, 1, 2].map(|a| f64::from(p[a]) - f64::from(b.center[a]));
        (way.iter().map(|x| x * x).sum::<f64>().sqrt() - f64::from(b.radius), i)
    });
    each.min_by(|x, y| x.0.total_cmp(&y.0)).unwrap()
}

#[test]
fn charges_are_those_of_all_distances_and_changes_add_up() {
    for body in bodies() {
        let dexels = body.dexels(4000);
        let (field, points, area) = field_and_points(&body, 20);
        let volume = body.solid.unit_moments().volume;
        let charge = |balls: &[Ball]| {
            let sum: f64 = points.iter().map(|p| slow(p, balls).0.powi(2)).sum();
            let diameter = (6.0 * volume / std::f64::consts::PI).cbrt();
            let mut whole = Between::new(&field, &dexels, u64::MAX).unwrap();
            let seen: Vec<Seen> = balls.iter().map(|b| dexels.seen(b)).collect();
            whole.whole(&dexels, &seen, &mut Fresh::default());
            let back = 2.0 * whole.sum(0.0) * dexels.cell() / area;
            2.5 * 3.0 * (0.5 * (sum / points.len() as f64 + back)).sqrt() / diameter
        };
        let mut smooth = Smooth::of(
            2.5,
            (points.clone(), area),
            Between::new(&field, &dexels, u64::MAX).unwrap(),
            &dexels,
            volume,
        )
        .unwrap();
        let mut balls = clump(20, 3);
        let mut seen: Vec<Seen> = balls.iter().map(|b| dexels.seen(b)).collect();
        let mut look = Look::default();
        smooth.whole(&dexels, &seen, &mut look.smooth);
        for some in clump(40, 9).chunks(2) {
            assert!((smooth.now() / charge(&balls) - 1.0).abs() < 1e-4);
            let of = [0, 9].map(|k| (some[0].radius.to_bits() + k) % 20);
            let old = of.map(|j| seen[j as usize]);
            for (&j, ball) in of.iter().zip(some) {
                balls[j as usize] = *ball;
                seen[j as usize] = dexels.seen(ball);
            }
            let new = of.map(|j| seen[j as usize]);
            look.region.of(&dexels, old.into_iter().chain(new));
            let change = smooth.change(&dexels, &look.region, 1, &of, &seen, &mut look.smooth);
            let (now, rise) = (smooth.now(), smooth.rise(change));
            smooth.take(&dexels, &look.region, change, &look.smooth);
            assert!((smooth.now() - now - rise).abs() < 1e-9);
        }
        assert!((smooth.now() / charge(&balls) - 1.0).abs() < 1e-4);
    }
}

#[test]
fn pulls_are_the_slopes_of_the_charge() {
    let body = &bodies()[1];
    let dexels = body.dexels(4000);
    let (field, points, area) = field_and_points(body, 20);
    let balls = clump(25, 6);
    let mut smooth = Smooth::of(
        1.5,
        (points.clone(), area),
        Between::new(&field, &dexels, u64::MAX).unwrap(),
        &dexels,
        0.1,
    )
    .unwrap();
    let seen: Vec<Seen> = balls.iter().map(|b| dexels.seen(b)).collect();
    let mut look = Look::default();
    smooth.whole(&dexels, &seen, &mut look.smooth);
    let back = smooth.distance([0.0; 2]).powi(2)
        - 0.5 * smooth.step.powi(2) * smooth.sum / points.len() as f64;
    let volumes = 0.3;
    let pull = smooth.pull(volumes);
    let all: Vec<u32> = (0..25).collect();
    for of in [all.as_slice(), &[3, 7, 19], &[11]] {
        let mut near = Near::default();
        near.make(&balls, of, 0.05);
        let mut drawn = Drawn::default();
        drawn.begin(&pull, &balls, of, of.iter().copied());
        for anew in [true, false] {
            drawn.draw(&balls, of, &near, anew);
            for (k, &j) in of.iter().enumerate() {
                let mut normal = Normal::default();
                drawn.add(&pull, k, 1.0, 1.0, &mut normal);
                for a in 0..4 {
                    let charge = |by: f32| {
                        let mut moved = balls.clone();
                        let ball = &mut moved[j as usize];
                        if a < 3 {
                            ball.center[a] += by
                        } else {
                            ball.radius += by
                        }
                        let sum: f64 = points.iter().map(|p| slow(p, &moved).0.powi(2)).sum();
                        let mean = 0.5 * sum / points.len() as f64 + back;
                        1.5 * smooth.scale * mean.sqrt()
                    };
                    let slope = (charge(2e-4) - charge(-2e-4)) / 4e-4 * volumes;
                    let mine = -normal.b[a];
                    assert!((slope - mine).abs() < 0.02 * slope.abs() + 2e-4, "{slope} {mine}");
                }
            }
        }
    }
}
