//! Overlap against formulas, and the stated error against the true one.

use super::*;
use crate::run::Pool;
use crate::shape::{Mesh, samples};
use crate::solid::columns::Columns;
use std::f64::consts::PI;

fn cap_lens(r: f64, s: f64, d: f64) -> f64 {
    if d >= r + s {
        return 0.0;
    }
    if d <= (r - s).abs() {
        return 4.0 / 3.0 * PI * r.min(s).powi(3);
    }
    PI * (r + s - d).powi(2) * (d * d + 2.0 * d * (r + s) - 3.0 * (r - s).powi(2)) / (12.0 * d)
}

fn against_spheres(target: &[Sphere], clump: &[Sphere], n: usize) -> Overlap {
    let all: Vec<Sphere> = target.iter().chain(clump).copied().collect();
    let (mut lo, mut hi) = ([f64::MAX; 2], [f64::MIN; 2]);
    for s in &all {
        for k in 0..2 {
            lo[k] = lo[k].min(s.center[k] - s.radius);
            hi[k] = hi[k].max(s.center[k] + s.radius);
        }
    }
    let l = Lattice::slanted(2, n, lo, hi);
    let t = Rows::of_spheres(target, l).unwrap();
    let c = Rows::of_spheres(clump, l).unwrap();
    compare(&t, &c, 0.5, false, &Run::serial()).unwrap()
}

fn against_box(m: Mesh, clump: &[Sphere], n: usize) -> Overlap {
    let body = Body::Mesh(m);
    let l = lattice(&body, clump, n).unwrap();
    let t = Rows::of_body(&body, l, u64::MAX).unwrap();
    let c = Rows::of_spheres(clump, l).unwrap();
    compare(&t, &c, 0.5, false, &Run::serial()).unwrap()
}

/// A mesh of an ellipsoid and its exact polyhedral volume.
fn ellipsoid(axes: [f64; 3], n: usize) -> (Mesh, f64) {
    let m = samples::ellipsoid(axes, axes, n);
    let volume = (0..m.faces.len()).map(|f| {
        let [a, b, c] = m.corners(f);
        a.dot(&b.cross(&c)) / 6.0
    });
    let volume = volume.sum();
    (m, volume)
}

/// The error of D is below the stated bound, and the bound below `most`.
fn held(o: &Overlap, exact: f64, most: f64) {
    let error = (o.mismatch - exact).abs();
    assert!(error <= o.error_bound, "D {} exact {exact} bound {}", o.mismatch, o.error_bound);
    assert!(o.error_bound < most, "bound {}", o.error_bound);
}

/// Bound on D that is expected of n columns.
fn expected(n: usize) -> f64 {
    (30.0 / n as f64).powi(2).max(1e-6)
}

#[test]
fn lenses_are_within_the_bound() {
    for n in [32, 64, 128] {
        for k in 0..60 {
            let t = f64::from(k);
            let d = 0.05 + 0.3 * (t * 0.618).fract();
            let dir = Vec3::new((t * 0.7).sin(), (t * 1.3).cos(), (t * 0.37).sin()).normalize();
            let (r, s) = (0.3, 0.2 + 0.15 * (t * 0.41).fract());
            let a = Sphere::new(Vec3::new(0.5, 0.5, 0.5), r);
            let b = Sphere::new(a.center + dir * d, s);
            let lens = cap_lens(r, s, d);
            let exact = 1.0 - 2.0 * lens / (a.volume() + b.volume());
            let o = against_spheres(&[a], &[b], n);
            held(&o, exact, expected(n));
            // The two as a union against the first: their union by the same formula.
            let union = a.volume() + b.volume() - lens;
            let o = against_spheres(&[a], &[a, b], n);
            held(&o, 1.0 - 2.0 * a.volume() / (a.volume() + union), expected(n));
            assert!((o.union / union - 1.0).abs() < expected(n));
        }
    }
}

#[test]
fn boxes_are_within_the_bound() {
    for n in [32, 64, 128] {
        for k in 0..60 {
            let t = f64::from(k);
            let edges = [0.9, 0.5 + 0.4 * (t * 0.618).fract(), 0.3 + 0.5 * (t * 0.73).fract()];
            let r = 0.15 - 0.1 * (t * 0.31).fract();
            let s = Sphere::new(Vec3::from(edges.map(|e| e * 0.5)), r);
            let v = edges[0] * edges[1] * edges[2];
            let o = against_box(samples::cuboid([0.0; 3], edges), &[s], n);
            held(&o, 1.0 - 2.0 * s.volume() / (v + s.volume()), expected(n));
            // Faces parallel to the columns: no error of the first order in the step.
            assert!((o.target / v - 1.0).abs() < 2.0 / (n * n) as f64);
        }
    }
}

#[test]
fn a_needle_is_as_exact_as_a_cube() {
    let edges = [0.02, 0.03, 1.0];
    let s = Sphere::new(Vec3::new(0.01, 0.015, 0.5), 0.009);
    let o = against_box(samples::cuboid([0.0; 3], edges), &[s], 64);
    assert!((o.target / 6e-4 - 1.0).abs() < 1e-3, "{}", o.target / 6e-4);
}

#[test]
fn ellipsoids_are_within_the_bound() {
    for n in [32, 64, 128] {
        for k in 0..12 {
            let t = f64::from(k);
            let axes = [0.5, 0.3 + 0.2 * (t * 0.618).fract(), 0.2 + 0.1 * (t * 0.73).fract()];
            let (m, volume) = ellipsoid(axes, 24);
            let off = Vec3::new((t * 0.3).sin(), (t * 0.9).sin(), (t * 0.5).cos()) * 0.03;
            let s = Sphere::new(Vec3::from(axes) + off, 0.14);
            let o = against_box(m, &[s], n);
            held(&o, 1.0 - 2.0 * s.volume() / (volume + s.volume()), expected(n));
        }
    }
}

#[test]
fn a_body_against_itself_is_exact() {
    let spheres =
        [Sphere::new(Vec3::new(0.3, 0.4, 0.5), 0.2), Sphere::new(Vec3::new(0.5, 0.5, 0.4), 0.25)];
    let o = against_spheres(&spheres, &spheres, 64);
    assert!(o.mismatch == 0.0 && o.centroid_error == 0.0 && o.moment_errors == [0.0; 3]);
}

#[test]
fn disjoint_bodies_mismatch_wholly() {
    let a = Sphere::new(Vec3::new(0.2, 0.2, 0.2), 0.1);
    let b = Sphere::new(Vec3::new(0.7, 0.7, 0.7), 0.1);
    assert_eq!(against_spheres(&[a], &[b], 64).mismatch, 1.0);
}

#[test]
fn moments_of_a_pair_by_formula() {
    // Target: one sphere of radius r; union: two of them a distance d apart along x.
    let (r, d) = (0.2, 0.5);
    let a = Sphere::new(Vec3::new(0.3, 0.5, 0.5), r);
    let b = Sphere::new(Vec3::new(0.3 + d, 0.5, 0.5), r);
    let o = against_spheres(&[a], &[a, b], 256);
    let v = a.volume();
    let one = 0.4 * v * r * r;
    let across = 2.0 * one + v * d * d / 2.0;
    let exact = [2.0 * one, across, across].map(|x| x / one - 1.0);
    for (error, exact) in o.moment_errors.iter().zip(exact) {
        assert!((error - exact).abs() < 2e-3 * (1.0 + exact));
    }
    assert!((o.centroid_error - d / 2.0 / (2.0 * r)).abs() < 1e-4);
    assert!((o.union / o.target - 2.0).abs() < 1e-4);
}

#[test]
fn voxels_have_their_exact_volume() {
    let dims = [3, 2, 2];
    let cells = vec![1, 0, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1];
    let spacing = Vec3::new(0.3, 0.25, 0.2);
    let body = Body::Voxels(crate::shape::Voxels { dims, spacing, cells });
    // A sphere that reaches beyond the array.
    let s = Sphere::new(Vec3::new(0.8, 0.4, 0.2), 0.15);
    let l = lattice(&body, &[s], 64).unwrap();
    let t = Rows::of_body(&body, l, u64::MAX).unwrap();
    let c = Rows::of_spheres(&[s], l).unwrap();
    let o = compare(&t, &c, 0.2, true, &Run::serial()).unwrap();
    assert!((o.target - 10.0 * spacing.product()).abs() < 1e-14);
    assert!((o.union / s.volume() - 1.0).abs() < 1e-3);
}

#[test]
fn threads_change_nothing() {
    let spheres: Vec<Sphere> = (0..40)
        .map(|i| {
            let t = f64::from(i);
            let c = Vec3::new((t * 0.37).fract(), (t * 0.61).fract(), (t * 0.83).fract());
            Sphere::new(c, 0.05 + 0.1 * (t * 0.29).fract())
        })
        .collect();
    let l = Lattice::slanted(2, 50, [-0.2, -0.2], [1.2, 1.2]);
    let of = |threads| {
        let t = Rows::of_spheres(&spheres[..20], l).unwrap();
        let c = Rows::of_spheres(&spheres[10..], l).unwrap();
        let o = compare(&t, &c, 0.5, false, &Run::new(threads).unwrap()).unwrap();
        [o.mismatch, o.error_bound, o.both, o.centroid_error, o.moment_errors[1]].map(f64::to_bits)
    };
    assert_eq!(of(1), of(3));
}

/// Band by band against all columns at once, and deep piles of spheres against a plain merge.
#[test]
fn bands_give_what_all_columns_give() {
    let spheres: Vec<Sphere> = (0..3000)
        .map(|i| {
            let t = f64::from(i);
            let c = Vec3::new((t * 0.37).fract(), (t * 0.61).fract(), (t * 0.83).fract());
            Sphere::new(c * 0.3, 0.3 + 0.3 * (t * 0.29).fract())
        })
        .collect();
    let l = Lattice::slanted(2, 150, [-0.6, -0.6], [1.0, 1.0]);
    let rows = Rows::of_spheres(&spheres, l).unwrap();
    let pool = Pool::serial();
    let all = Columns::of(&rows, &pool).unwrap();
    let o = compare(&rows, &rows, 0.2, false, &Run::serial()).unwrap();
    assert!((o.union / all.volume() - 1.0).abs() < 1e-12 && o.both == o.union);
    for (a, b) in [(0, 0), (60, 70), (100, 100), (130, 90), (75, 140)] {
        let [x, y] = l.place(a, b);
        let mut chords: Vec<[f64; 2]> = Vec::new();
        for s in &spheres {
            let h2 = s.radius.powi(2) - (x - s.center.x).powi(2) - (y - s.center.y).powi(2);
            if h2 > 0.0 {
                chords.push([s.center.z - h2.sqrt(), s.center.z + h2.sqrt()]);
            }
        }
        chords.sort_by(|p, q| p[0].total_cmp(&q[0]));
        let mut length = 0.0;
        let mut end = f64::MIN;
        for [from, to] in chords {
            length += (to - from.max(end)).max(0.0);
            end = end.max(to);
        }
        let found: f64 = all.column(a, b).iter().map(|i| i[1] - i[0]).sum();
        assert!((found - length).abs() < 1e-12, "{a} {b}: {found} {length}");
    }
}
