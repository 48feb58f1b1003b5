//! Limits by the field, as conditions of a least square, and exactly.

use super::*;
use crate::generate::balls::random::Random;
use crate::generate::balls::test_bodies::bodies;
use crate::generate::best::HalfSpace;
use crate::run::Pool;
use crate::shape::primitive::Primitive;
use crate::shape::{ImportOptions, Shape};
use crate::solid::SolidOptions;

fn planes() -> Vec<Plane> {
    let plane = |x, y, z, offset| Plane { normal: Vec3::new(x, y, z).normalize(), offset };
    vec![plane(1.0, 0.2, 0.1, 0.35), plane(-0.3, -1.0, 0.2, 0.0)]
}

#[test]
fn balls_are_held_within_by_small_changes() {
    for body in bodies() {
        let field = Field::new(body.solid.grid(), &body.distance, &Pool::serial()).unwrap();
        let limits =
            Limits::new(&planes(), Some((0.02, body.solid.surface(&Run::serial()).unwrap())));
        let radii = Radii { least: 0.01, most: f32::MAX };
        let mut random = Random::new(4, 4);
        let (mut all, mut small, mut beyond) = (0, 0, 0);
        for _ in 0..400 {
            let center = [0; 3].map(|_| random.between(0.05, 0.65) as f32);
            let mut ball = Ball { center, radius: random.between(0.02, 0.12) as f32 };
            // As steps leave them: with the centre not far out.
            if limits.excess(&field, &Ball { radius: 0.0, ..ball }) > 0.02 {
                continue;
            }
            all += 1;
            let before = (ball, limits.excess(&field, &ball));
            limits.hold(&field, &radii, &mut ball);
            assert!(ball.radius >= radii.least);
            if before.1 <= 0.0 {
                assert_eq!(ball, before.0);
                continue;
            }
            // Where nothing is left the ball is small and still too far out.
            let after = limits.excess(&field, &ball);
            beyond += usize::from(after > 1e-6);
            let way = ball.apart(&before.0).sqrt() + (ball.radius - before.0.radius).abs();
            small += usize::from(way < 3.0 * before.1);
        }
        assert!(all > 20 && beyond < all / 8 && small > all / 2, "{all} {beyond} {small}");
    }
}

/// The least of ½ xᵀ M x − bᵀ x where `rows` · x + excess ≤ 0, by steps against the slope of a
/// penalty.
fn slow(m: &[[f64; 4]; 4], b: &[f64; 4], rows: &[([f64; 4], f64)]) -> [f64; 4] {
    let mut x = [0.0; 4];
    let mut lambda = vec![0.0; rows.len()];
    // Uzawa's method: steps of the multipliers, and exact least squares by relaxation.
    for _ in 0..4000 {
        for _ in 0..4 {
            for i in 0..4 {
                let pull: f64 = rows.iter().zip(&lambda).map(|((a, _), l)| l * a[i]).sum();
                let rest: f64 = (0..4).filter(|&j| j != i).map(|j| m[i][j] * x[j]).sum();
                x[i] = (b[i] - pull - rest) / m[i][i];
            }
        }
        for ((a, e), l) in rows.iter().zip(&mut lambda) {
            let over: f64 = e + a.iter().zip(&x).map(|(a, x)| a * x).sum::<f64>();
            *l = (*l + 0.5 * over).max(0.0);
        }
    }
    x
}

#[test]
fn steps_are_the_least_within_the_limits() {
    let body = &bodies()[0];
    let field = Field::new(body.solid.grid(), &body.distance, &Pool::serial()).unwrap();
    let limits = Limits::new(&planes(), Some((0.02, body.solid.surface(&Run::serial()).unwrap())));
    let mut random = Random::new(9, 1);
    let mut bound = 0;
    for _ in 0..200 {
        let center = [0; 3].map(|_| random.between(0.1, 0.4) as f32);
        let ball = Ball { center, radius: random.between(0.02, 0.2) as f32 };
        let mut rows: Vec<([f64; 4], f64)> = Vec::new();
        limits.each(&field, &mut { ball }, |_, [x, y, z], e| {
            rows.push(([x, y, z, 1.0].map(f64::from), f64::from(e)));
        });
        let b = [0; 4].map(|_| random.between(-0.3, 0.3));
        let mut m = [[0.0; 4]; 4];
        for _ in 0..8 {
            let v = [0; 4].map(|_| random.between(-0.5, 0.5));
            (0..16).for_each(|k| m[k / 4][k % 4] += v[k / 4] * v[k % 4]);
        }
        (0..4).for_each(|k| m[k][k] += 0.5);
        let upper = (0..4).flat_map(|i| (i..4).map(move |j| (i, j)));
        let mut packed = upper.map(|(i, j)| m[i][j]);
        let mut normal =
            Normal { m: [0; 10].map(|_| packed.next().unwrap()), b, ..Normal::default() };
        let solve = |n: &Normal| super::super::refine::solve(n, 0.0);
        let free = solve(&normal);
        let step = limits.step(&field, &ball, &mut normal, solve);
        let breaks = |x: &[f64; 4]| {
            let over =
                |(a, e): &([f64; 4], f64)| e + a.iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
            rows.iter().map(over).fold(f64::MIN, f64::max)
        };
        if breaks(&free) <= 0.0 {
            assert_eq!(step, free);
            continue;
        }
        assert!(breaks(&step) < 2e-3, "{}", breaks(&step));
        // One limit: the least. Several: made stiff one after the other, near it.
        if rows.iter().filter(|r| breaks_one(r, &free)).count() == 1 && breaks(&step) < 1e-3 {
            let least = slow(&m, &b, &rows);
            let off = (0..4).map(|k| (least[k] - step[k]).abs()).fold(0.0, f64::max);
            bound += usize::from(off < 5e-3);
        }
    }
    assert!(bound > 30, "{bound}");
}

fn breaks_one((a, e): &([f64; 4], f64), x: &[f64; 4]) -> bool {
    e + a.iter().zip(x).map(|(a, x)| a * x).sum::<f64>() > 0.0
}

#[test]
fn half_spaces_of_any_length_and_place_are_the_same() {
    let frame = UnitFrame {
        offset: Vec3::new(1e6, -3.0, 8.0),
        scale: 4.0,
        axes: crate::math::Axes::default(),
    };
    for length in [1.0, 1e-300, 3e200] {
        let normal = Vec3::new(2.0, -1.0, 2.0) * length;
        let offset = normal.dot(&frame.offset) + 6.0 * length;
        let half_spaces = vec![HalfSpace { normal, offset }];
        let o = BestOptions { half_spaces, ..BestOptions::default() };
        let plane = planes_of(&o, &frame);
        assert!((plane.normal - Vec3::new(2.0, -1.0, 2.0) / 3.0).norm() < 1e-15);
        assert!((plane.offset - 0.5).abs() < 1e-9);
    }
    for (offset, far) in [(1e308, FAR), (-1e308, -FAR)] {
        let half_spaces = vec![HalfSpace { normal: Vec3::x() * 1e-300, offset }];
        let o = BestOptions { half_spaces, ..BestOptions::default() };
        assert_eq!(planes_of(&o, &frame).offset, far);
    }
}

fn planes_of(o: &BestOptions, frame: &UnitFrame) -> Plane {
    super::planes(o, frame)[0]
}

#[test]
fn the_end_is_exact_at_any_size_and_place() {
    let run = Run::serial();
    let (vertices, faces) = Primitive::from_name("stone").unwrap().mesh(24).unwrap();
    for (scale, at) in [(1.0, 0.0), (1e-9, 0.0), (3e6, 0.0), (1.0, 1e7)] {
        let vertices: Vec<[f64; 3]> = vertices.iter().map(|p| p.map(|x| scale * x + at)).collect();
        let shape = Shape::from_mesh(&vertices, &faces, &ImportOptions::default(), &run).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        let normal = Vec3::new(3.0, 1.0, -2.0);
        let offset = normal.dot(&Vec3::repeat(at)) + 0.2 * scale;
        let o = BestOptions {
            max_protrusion: 0.01 * scale,
            max_radius: 0.2 * scale,
            half_spaces: vec![HalfSpace { normal, offset }],
            ..BestOptions::default()
        };
        let least = 0.03 * scale;
        let exact = Exact::new(&solid, &o, [least, 0.01 * scale], &run).unwrap();
        assert!(!exact.none());
        let mut random = Random::new(6, 6);
        let (mut held, mut moved) = (0, 0);
        for _ in 0..100 {
            let center = Vec3::from([0; 3].map(|_| at + scale * random.between(-0.5, 0.5)));
            let sphere = Sphere::new(center, scale * random.between(0.001, 0.4));
            let Some(s) = exact.hold(&sphere) else { continue };
            held += 1;
            moved += usize::from(s.center != center);
            assert!(s.radius >= least && s.radius <= o.max_radius);
            let surface = solid.surface(&run).unwrap();
            let unit = solid.frame().sphere_to_unit(&s);
            let over = surface.signed_distance(&unit.center) + unit.radius;
            assert!(over * solid.frame().scale <= o.max_protrusion);
            let length = normal.norm();
            let noise = 4.0 * f64::EPSILON * (scale + 2.0 * at);
            assert!((normal / length).dot(&s.center) + s.radius <= offset / length + noise);
        }
        assert!(held > 30 && moved > 5, "{held} {moved}");
    }
}
