//! MSS on small shapes: what it must find, and what it must not do.

#![allow(clippy::unwrap_used)]

#[path = "common/cells.rs"]
mod shared;

use morula::clump::Stopped;
use morula::generate::{GenerateOptions, generate};
use morula::{Run, Sphere};
use shared::{Cell, ask, balls, cells, make, mismatch, square};

/// A clump of as many spheres as there are balls has each of them, to `off` at the centre and in
/// the radius.
fn recovers(list: &[([f64; 3], f64)], dims: [usize; 3], off: [f64; 2], most: f64) {
    let (solid, mask) = cells(dims, [1.0; 3], &balls(list));
    let clump = make(&solid, &ask(list.len()));
    for (c, r) in list {
        let near = |s: &Sphere| square(s.center.into(), *c).sqrt() < off[0];
        let found = clump.spheres.iter().any(|s| near(s) && (s.radius - r).abs() < off[1]);
        assert!(found, "{c:?} {r}: {:?}", clump.spheres);
    }
    assert!(mismatch(&mask, dims, [1.0; 3], &clump.spheres) < most);
}

#[test]
fn two_overlapping_balls_are_both_found() {
    // Figure 6 of Buchele et al. 2026: the smaller one shows in 2E − Ẽ only.
    let two = [([20.0, 18.0, 18.0], 14.0), ([33.0, 18.0, 18.0], 10.0)];
    recovers(&two, [50, 37, 37], [1.0, 0.6], 0.02);
}

#[test]
fn four_balls_are_recovered() {
    let four = [
        ([24.0, 24.0, 22.0], 14.0),
        ([40.0, 27.0, 22.0], 10.0),
        ([22.0, 42.0, 24.0], 9.0),
        ([38.0, 38.0, 26.0], 11.0),
    ];
    recovers(&four, [56, 56, 46], [1.5, 1.0], 0.03);
}

#[test]
fn a_cube_does_not_stall() {
    let dims = [46; 3];
    let inside = |p: [f64; 3]| p.iter().all(|x| *x > 2.5 && *x < 42.5);
    let (solid, mask) = cells(dims, [1.0; 3], &inside);
    let clump = make(&solid, &ask(30));
    assert_eq!((clump.spheres.len(), clump.stopped), (30, Stopped::Spheres));
    assert!(clump.note.is_empty());
    assert!(mismatch(&mask, dims, [1.0; 3], &clump.spheres) < 0.11);
}

#[test]
fn d_falls_with_every_sphere() {
    let dims = [64, 44, 36];
    let inside = |p: [f64; 3]| {
        let q = [(p[0] - 31.3) / 28.0, (p[1] - 21.1) / 18.0, (p[2] - 17.6) / 14.0];
        q.iter().map(|x: &f64| x.abs().powf(3.0)).sum::<f64>() < 1.0 && p[0] + p[1] < 70.0
    };
    let (solid, mask) = cells(dims, [1.0; 3], &inside);
    let many = make(&solid, &ask(25)).spheres;
    assert_eq!(many.len(), 25);
    let mut last = 1.0;
    for n in 1..=25 {
        let spheres = make(&solid, &ask(n)).spheres;
        let d = mismatch(&mask, dims, [1.0; 3], &spheres);
        assert!(d < last, "D is {d} with {n} spheres and {last} with one less");
        last = d;
        // The first ten settle among themselves; those after stay where they are.
        if n > 10 {
            assert_eq!(spheres, many[..n]);
        }
    }
}

#[test]
fn mirror_images_go_together() {
    let torus = |p: [f64; 3]| {
        let ring = ((p[0] - 30.5).powi(2) + (p[1] - 30.5).powi(2)).sqrt() - 20.0;
        ring * ring + (p[2] - 12.0).powi(2) < 49.0
    };
    let ellipsoid = |p: [f64; 3]| {
        ((p[0] - 30.5) / 27.0).powi(2)
            + ((p[1] - 30.5) / 13.0).powi(2)
            + ((p[2] - 12.0) / 9.0).powi(2)
            < 1.0
    };
    let slab = |p: [f64; 3]| {
        p[0] > 3.5 && p[0] < 57.5 && p[1] > 10.5 && p[1] < 50.5 && p[2] > 2.5 && p[2] < 21.5
    };
    let shapes: [(&str, Cell); 3] = [("torus", &torus), ("ellipsoid", &ellipsoid), ("box", &slab)];
    for (name, inside) in shapes {
        let (solid, _) = cells([62, 62, 25], [1.0; 3], inside);
        let spheres = make(&solid, &ask(60)).spheres;
        // The greatest number up to 60 that cuts no orbit.
        let whole = (20..=spheres.len()).rev().find(|n| {
            let part = &spheres[..*n];
            [30.5, 30.5, 12.0].iter().enumerate().all(|(a, plane)| {
                part.iter().all(|s| {
                    let mut image = s.center;
                    image[a] = 2.0 * plane - image[a];
                    part.iter().any(|t| {
                        (t.center - image).norm() < 1e-9 && (t.radius - s.radius).abs() < 1e-9
                    })
                })
            })
        });
        assert!(whole.is_some_and(|n| n + 8 > spheres.len()), "{name}: {whole:?}");
    }
}

#[test]
fn odd_numbers_keep_the_symmetry_where_they_can() {
    let c = [30.0, 15.0, 14.0];
    let inside = |p: [f64; 3]| {
        ((p[0] - c[0]) / 27.0).powi(2)
            + ((p[1] - c[1]) / 12.0).powi(2)
            + ((p[2] - c[2]) / 11.0).powi(2)
            < 1.0
    };
    let (solid, _) = cells([61, 31, 29], [1.0; 3], &inside);
    for n in [1, 3, 5, 7] {
        let spheres = make(&solid, &ask(n)).spheres;
        assert_eq!(spheres.len(), n);
        let off: f64 = spheres.iter().map(|s| s.center.x - c[0]).sum();
        assert!(off.abs() < 1e-6, "{n}: {spheres:?}");
    }
}

#[test]
fn a_closed_cavity_stays_empty() {
    let dims = [52; 3];
    let c = [25.6; 3];
    let shell = |p: [f64; 3]| square(p, c) <= 22.0 * 22.0 && square(p, c) > 12.0 * 12.0;
    let (solid, mask) = cells(dims, [1.0; 3], &shell);
    let clump = make(&solid, &ask(80));
    assert_eq!(clump.spheres.len(), 80);
    assert!(clump.spheres.iter().all(|s| !s.contains(&c.into())));
    assert!(mismatch(&mask, dims, [1.0; 3], &clump.spheres) < 0.2);
}

#[test]
fn criteria_apply_alone_and_together() {
    let dims = [46, 40, 36];
    let inside = |p: [f64; 3]| {
        p.iter().all(|x| *x > 2.5 && *x < 32.5) || square(p, [32.0, 20.0, 16.0]) < 150.0
    };
    let (solid, mask) = cells(dims, [1.0; 3], &inside);

    let by_mismatch = make(&solid, &GenerateOptions { spheres: 0, mismatch: 0.1, ..ask(0) });
    assert_eq!(by_mismatch.stopped, Stopped::Mismatch);
    let n = by_mismatch.spheres.len();
    assert!(mismatch(&mask, dims, [1.0; 3], &by_mismatch.spheres) <= 0.1);
    assert!(mismatch(&mask, dims, [1.0; 3], &by_mismatch.spheres[..n - 1]) > 0.1);

    let by_radius = make(&solid, &GenerateOptions { spheres: 0, min_radius: 3.0, ..ask(0) });
    assert_eq!(by_radius.stopped, Stopped::Radius);
    assert!(by_radius.spheres.iter().all(|s| s.radius >= 3.0));

    let all = GenerateOptions { mismatch: 0.1, min_radius: 3.0, ..ask(n - 3) };
    let clump = make(&solid, &all);
    assert_eq!((clump.stopped, clump.spheres.len()), (Stopped::Spheres, n - 3));
    let few = GenerateOptions { mismatch: 0.001, min_radius: 6.0, ..ask(500) };
    let clump = make(&solid, &few);
    assert_eq!(clump.stopped, Stopped::Radius);
    assert!(clump.note.contains("of 500 spheres") && clump.note.contains('6'), "{}", clump.note);

    let apart = GenerateOptions { min_distance: 5.0, ..ask(500) };
    let clump = make(&solid, &apart);
    assert_eq!(clump.stopped, Stopped::Exhausted);
    assert!(clump.note.contains("500") && clump.note.contains('5'), "{}", clump.note);
    for (n, a) in clump.spheres.iter().enumerate() {
        for b in &clump.spheres[..n] {
            assert!((a.center - b.center).norm() >= 5.0 - 1e-9);
        }
    }

    // The small ball is too small, but too near as well: that alone is no reason.
    let knob = balls(&[([20.0; 3], 14.0), ([36.0, 20.0, 20.0], 4.0)]);
    let (solid, _) = cells([44, 40, 40], [1.0; 3], &knob);
    let far = GenerateOptions { min_radius: 5.0, min_distance: 30.0, ..ask(5) };
    let clump = make(&solid, &far);
    assert_eq!((clump.spheres.len(), clump.stopped), (1, Stopped::Exhausted), "{}", clump.note);
    let clump = make(&solid, &GenerateOptions { min_distance: 12.0, ..far });
    assert_eq!((clump.spheres.len(), clump.stopped), (1, Stopped::Radius), "{}", clump.note);

    let none = GenerateOptions { min_radius: 100.0, ..ask(3) };
    let refusal = generate(&solid, &none, &Run::serial()).unwrap_err();
    assert!(matches!(refusal, morula::Error::NoSpheres(_)), "{refusal}");
}

#[test]
fn a_deadline_leaves_a_sphere_and_a_cancel_what_there_is() {
    let inside = |p: [f64; 3]| p.iter().all(|x| *x > 2.5 && *x < 32.5);
    let (solid, _) = cells([36; 3], [1.0; 3], &inside);
    let clump = generate(&solid, &ask(30), &Run::serial().with_deadline(0.0)).unwrap();
    assert_eq!(clump.stopped, Stopped::Deadline);
    assert!(!clump.spheres.is_empty() && clump.spheres.len() < 30);
    assert!(clump.note.contains("deadline"));

    let mut calls = 0;
    let run = Run::serial().with_progress(Box::new(move |_| {
        calls += 1;
        calls > 5
    }));
    let clump = generate(&solid, &ask(200), &run).unwrap();
    assert_eq!(clump.stopped, Stopped::Cancelled);
    assert!(!clump.spheres.is_empty() && clump.spheres.len() < 200);

    let run = Run::serial().with_progress(Box::new(|_| true));
    let refusal = generate(&solid, &ask(30), &run).unwrap_err();
    assert!(matches!(refusal, morula::Error::Cancelled(_)));
}

#[test]
fn the_caller_is_asked_while_spheres_settle() {
    let inside = |p: [f64; 3]| {
        ((p[0] - 23.3) / 20.0).powi(2)
            + ((p[1] - 14.2) / 11.0).powi(2)
            + ((p[2] - 12.9) / 9.0).powi(2)
            < 1.0
    };
    let (solid, mask) = cells([47, 29, 26], [1.0; 3], &inside);
    let asked = |stop_at: usize| {
        let mut calls = 0;
        let run = Run::serial().with_progress(Box::new(|_| {
            calls += 1;
            calls > stop_at
        }));
        let clump = generate(&solid, &ask(10), &run);
        drop(run);
        (calls, clump)
    };
    let (calls, whole) = asked(usize::MAX);
    // Each of ten spheres is asked about once, and moving those before it once for each.
    assert!(calls > 40, "{calls}");
    assert_eq!(whole.unwrap().spheres.len(), 10);
    let mut last = 1.0;
    for stop_at in (4..calls).step_by(9) {
        let (after, clump) = asked(stop_at);
        let clump = clump.unwrap();
        // All were there already when the last of them settled.
        let last_ones = clump.stopped == Stopped::Spheres && clump.spheres.len() == 10;
        assert!(clump.stopped == Stopped::Cancelled || last_ones, "{stop_at}: {}", clump.note);
        assert_eq!(after, stop_at + 1);
        let d = mismatch(&mask, [47, 29, 26], [1.0; 3], &clump.spheres);
        assert!(d <= last, "{d} after {last}");
        last = d;
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let inside = |p: [f64; 3]| {
        square(p, [20.3, 21.1, 19.6]) < 300.0 || square(p, [33.3, 28.1, 24.6]) < 120.0
    };
    let (solid, _) = cells([48, 44, 40], [1.0, 1.0, 1.0], &inside);
    let one = make(&solid, &ask(40)).spheres;
    for threads in [2, 8] {
        let run = Run::new(threads).unwrap();
        assert_eq!(generate(&solid, &ask(40), &run).unwrap().spheres, one);
    }
}

#[test]
fn a_single_cell_is_one_sphere() {
    let (solid, _) = cells([3; 3], [1.0; 3], &|p| p == [1.0; 3]);
    let clump = make(&solid, &ask(5));
    assert_eq!(clump.spheres.len(), 1);
    assert_eq!(clump.stopped, Stopped::Exhausted);
    assert!(!clump.note.contains("distance"), "{}", clump.note);
    assert!((clump.spheres[0].radius - 0.5).abs() < 0.01);
}

#[test]
fn thousands_of_spheres() {
    let inside = |p: [f64; 3]| square(p, [24.3, 25.0, 24.6]) < 500.0 && p[0] + p[1] > 30.0;
    let dims = [50; 3];
    let (solid, mask) = cells(dims, [1.0; 3], &inside);
    let clump = make(&solid, &ask(5000));
    assert!(clump.spheres.len() == 5000 || !clump.note.is_empty());
    assert!(mismatch(&mask, dims, [1.0; 3], &clump.spheres) < 0.005);
    // Places that would gain as little as the best are not all looked at again for each sphere.
    let tried = clump.counters.spheres_tried as usize;
    assert!(tried < 150 * clump.spheres.len(), "{tried} for {}", clump.spheres.len());
}
