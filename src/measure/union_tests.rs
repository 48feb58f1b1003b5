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
        let union = Union::new(&spheres, u64::MAX, &Run::serial()).unwrap();
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
    let union = Union::new(&spheres, u64::MAX, &Run::serial()).unwrap();
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
        let union = Union::new(&spheres, u64::MAX, &Run::serial()).unwrap();
        assert!(!union.swallowed[0]);
        assert_eq!(union.ever_exposed(0), exposed, "{r}");
        assert!((1..9).all(|i| union.ever_exposed(i)));
    }
    // In one other; equal ones, of which the first stays.
    let a = Sphere::new(Vec3::zeros(), 0.1);
    let spheres = [a, a, Sphere::new(Vec3::new(0.02, 0.0, 0.0), 0.05), a];
    let union = Union::new(&spheres, u64::MAX, &Run::serial()).unwrap();
    assert_eq!([0, 1, 2, 3].map(|i| union.ever_exposed(i)), [true, false, false, false]);
    assert_eq!(union.area(0), 4.0 * PI * 0.1 * 0.1);
}

#[test]
fn nearest_points_against_many_samples() {
    for seed in [0.0, 7.0] {
        let spheres = scattered(14, seed);
        let union = Union::new(&spheres, u64::MAX, &Run::serial()).unwrap();
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
    let union = Union::new(&one, u64::MAX, &Run::serial()).unwrap();
    assert_eq!(union.nearest(&Vec3::zeros()).1, 0.3);
}

/// The plain definition, sphere by sphere.
fn plain_nearest(spheres: &[Sphere], union: &Union, p: &Vec3) -> f64 {
    let mut best = (*p, f64::MAX);
    for (i, s) in spheres.iter().enumerate() {
        let d = (p - s.center).normalize();
        let x = s.center + d * s.radius;
        let free = |(j, o): (usize, &Sphere)| j == i || (x - o.center).norm() >= o.radius - 1e-12;
        let e = (x - p).norm();
        if e < best.1 && spheres.iter().enumerate().all(free) {
            best = (x, e);
        }
        union.arcs[i].iter().for_each(|a| a.nearer(p, &mut best));
    }
    best.1
}

#[test]
fn many_spheres_as_by_the_plain_definition() {
    // Small ones on a great one, so that it has many caps, and some inside.
    let mut spheres = vec![Sphere::new(Vec3::repeat(0.5), 0.4)];
    for k in 0..600 {
        let t = f64::from(k);
        let depth = 0.35 + 0.08 * (t * 0.531).fract();
        let r = 0.01 + 0.06 * (t * 0.29).fract();
        spheres.push(Sphere::new(Vec3::repeat(0.5) + direction(k as usize, 600) * depth, r));
    }
    let out = |s: &&Sphere| (s.center - spheres[0].center).norm() + s.radius > 0.41;
    let twin = *spheres.iter().find(out).unwrap();
    spheres.push(twin);
    let union = Union::new(&spheres, u64::MAX, &Run::serial()).unwrap();
    let n = spheres.len();
    for i in 0..n {
        let a = &spheres[i];
        let inside = |(j, b): (usize, &Sphere)| {
            j != i
                && (b.center - a.center).norm() <= b.radius - a.radius
                && (b.radius > a.radius || j < i)
        };
        assert_eq!(union.swallowed[i], spheres.iter().enumerate().any(inside), "{i}");
    }
    assert!(union.swallowed[n - 1] && union.caps[0].len() > 300);
    for k in 0..3000 {
        let d = direction(k, 3000);
        let p = spheres[0].center + d * spheres[0].radius;
        let free = spheres[1..].iter().all(|s| (p - s.center).norm() >= s.radius);
        assert_eq!(union.exposed(0, &d), free);
        let cos = 0.9999;
        let hides = |s: &Sphere| cap(&spheres[0], s, 0).is_some_and(|c| c.holds(&d, cos, 0.0));
        let by_one = spheres[1..].iter().any(hides);
        assert_eq!(union.hides(0, &d, cos), by_one);
    }
    for k in 0..200 {
        let t = f64::from(k) + 0.5;
        let p = Vec3::new((t * 0.47).fract(), (t * 0.71).fract(), (t * 0.93).fract());
        let e = union.nearest(&p).1;
        assert!((e - plain_nearest(&spheres, &union, &p)).abs() < 1e-12, "{k}");
    }
}

#[test]
fn piles_beyond_the_limit_are_refused() {
    let spheres: Vec<Sphere> = scattered(300, 0.5)
        .iter()
        .map(|s| Sphere::new(s.center * 0.1, 0.5 + 0.1 * s.radius))
        .collect();
    let e = Union::new(&spheres, 1 << 16, &Run::serial()).err().unwrap();
    assert!(matches!(e, Error::MemoryLimit(_)) && e.to_string().contains("65536"), "{e}");
}

/// No point of a triangle is farther than the bound says, and of a small one above an exposed part
/// the bound is close.
#[test]
fn triangles_are_no_farther_than_their_bound() {
    let spheres = scattered(30, 0.5);
    let union = Union::new(&spheres, u64::MAX, &Run::serial()).unwrap();
    let mut close = 0;
    for k in 0..600 {
        let i = k % spheres.len();
        let d = direction(k, 600);
        let p = spheres[i].center + d * (spheres[i].radius * 1.02);
        let size = if k % 2 == 0 { 0.02 } else { 0.1 };
        let corner = |j: usize| p + direction(5 * k + j, 3000 + 7 * j) * size;
        let t = [corner(0), corner(1), corner(2)].map(|v| v + d.cross(&v) * size);
        let (distance, bound) = union.reach(&t);
        let wide = t.iter().map(|v| (v - (t[0] + t[1] + t[2]) / 3.0).norm()).fold(0.0, f64::max);
        close += usize::from(wide > 0.0 && bound - distance < 0.3 * wide);
        for a in 0..=8 {
            for b in 0..=8 - a {
                let [x, y] = [a, b].map(|m| m as f64 / 8.0);
                let q = t[0] + (t[1] - t[0]) * x + (t[2] - t[0]) * y;
                assert!(union.nearest(&q).1 <= bound + 1e-12, "{k}: {a} {b}");
            }
        }
    }
    assert!(close > 35, "{close}");
}
