//! The exposed surface against formulas and against many samples.

use super::super::surface::direction;
use super::*;

fn scattered(n: u32, seed: f64) -> Vec<Sphere> {
    (0..n)
        .map(|i| {
            let t = f64::from(i) + seed;
            let c = Vec3::new((t * 0.37).fract(), (t * 0.61).fract(), (t * 0.83).fract());
            Sphere::new(c, 0.08 + 0.2 * (t * 0.29).fract())
        })
        .collect()
}

#[test]
fn areas_of_a_lens_by_formula() {
    for k in 0..20 {
        let t = f64::from(k);
        let (r, s) = (0.3, 0.2 + 0.15 * (t * 0.41).fract());
        let d = 0.15 + 0.3 * (t * 0.618).fract();
        let dir = Vec3::new((t * 0.7).sin(), (t * 1.3).cos(), (t * 0.37).sin()).normalize();
        let spheres = [Sphere::new(Vec3::zeros(), r), Sphere::new(dir * d, s)];
        let union = Union::new(&spheres, &Pool::serial()).unwrap();
        for (i, (r, s)) in [(r, s), (s, r)].into_iter().enumerate() {
            let hidden = 2.0 * PI * r * (r - (d * d + r * r - s * s) / (2.0 * d));
            let exact = 4.0 * PI * r * r - hidden;
            let error = (union.area(i) - exact).abs() / (4.0 * PI * r * r);
            assert!(error < 2e-3, "{error} at {k}");
        }
        assert_eq!(union.arcs[0].len(), 1);
    }
}

#[test]
fn areas_against_many_samples() {
    let spheres = scattered(25, 0.0);
    let union = Union::new(&spheres, &Pool::serial()).unwrap();
    let n = 20_000;
    for i in 0..spheres.len() {
        let seen = (0..n).filter(|&k| union.exposed(i, &direction(k, n))).count();
        let share = seen as f64 / n as f64;
        let area = union.area(i) / (4.0 * PI * spheres[i].radius.powi(2));
        assert!((share - area).abs() < 3e-3, "sphere {i}: {share} {area}");
        assert!(seen == 0 || union.ever_exposed(i));
        // The samples agree with the plain definition.
        for k in 0..200 {
            let d = direction(k, 200);
            let p = spheres[i].center + d * spheres[i].radius;
            let plain = spheres
                .iter()
                .enumerate()
                .all(|(j, s)| j == i || (p - s.center).norm() >= s.radius - 1e-12);
            assert!(union.exposed(i, &d) == plain);
        }
    }
}

#[test]
fn hidden_spheres_are_told_from_barely_exposed_ones() {
    for (r, exposed) in [(0.2, false), (0.1415, false), (0.1414, true), (0.13, true)] {
        let mut spheres = vec![Sphere::new(Vec3::zeros(), 0.1)];
        for i in 0..8 {
            let c = [0, 1, 2].map(|k| if i >> k & 1 == 1 { 0.1 } else { -0.1 });
            spheres.push(Sphere::new(Vec3::from(c), r));
        }
        let union = Union::new(&spheres, &Pool::serial()).unwrap();
        assert!(!union.swallowed[0]);
        assert_eq!(union.ever_exposed(0), exposed, "{r}");
        assert!((1..9).all(|i| union.ever_exposed(i)));
    }
    // In one other; equal ones, of which the first stays.
    let a = Sphere::new(Vec3::zeros(), 0.1);
    let spheres = [a, a, Sphere::new(Vec3::new(0.02, 0.0, 0.0), 0.05), a];
    let union = Union::new(&spheres, &Pool::serial()).unwrap();
    assert_eq!([0, 1, 2, 3].map(|i| union.ever_exposed(i)), [true, false, false, false]);
    assert_eq!(union.area(0), 4.0 * PI * 0.1 * 0.1);
}

#[test]
fn nearest_points_against_many_samples() {
    for seed in [0.0, 7.0] {
        let spheres = scattered(14, seed);
        let union = Union::new(&spheres, &Pool::serial()).unwrap();
        let mut surface = Vec::new();
        let n = 6000;
        for (i, s) in spheres.iter().enumerate() {
            for k in 0..n {
                let d = direction(k, n);
                if union.exposed(i, &d) {
                    surface.push(s.center + d * s.radius);
                }
            }
        }
        for k in 0..60 {
            let t = f64::from(k) + 0.5;
            let p = Vec3::new((t * 0.47).fract(), (t * 0.71).fract(), (t * 0.93).fract());
            let (q, e) = union.nearest(&p);
            assert!(((q - p).norm() - e).abs() < 1e-12);
            assert!(spheres.iter().all(|s| (q - s.center).norm() > s.radius - 1e-9));
            let sampled = surface.iter().map(|x| (x - p).norm()).fold(f64::MAX, f64::min);
            // Never above a sample, and no further below than samples are apart.
            assert!(e <= sampled + 1e-12 && sampled < e + 0.012, "{e} {sampled}");
        }
    }
    // At a centre, every direction is as near.
    let one = [Sphere::new(Vec3::zeros(), 0.3)];
    let union = Union::new(&one, &Pool::serial()).unwrap();
    assert_eq!(union.nearest(&Vec3::zeros()).1, 0.3);
}
