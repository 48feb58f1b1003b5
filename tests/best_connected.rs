//! Clumps of the generator of least mismatch that must hang together.

#![allow(clippy::unwrap_used, clippy::panic)]

use morula::clump::Stopped;
use morula::generate::{BestOptions, Effort, GenerateOptions, Method, generate};
use morula::math::Sphere;
use morula::measure::{QualityOptions, quality};
use morula::shape::voxels::Layout;
use morula::shape::{Bodies, ImportOptions, Shape};
use morula::solid::SolidOptions;
use morula::{Clump, Run, Solid};

/// Cells that are solid where `inside` says so.
fn solid(dims: [usize; 3], spacing: f64, inside: impl Fn([usize; 3]) -> bool) -> Solid {
    let mut mask = Vec::new();
    for i in 0..dims[0] * dims[1] * dims[2] {
        let place = [i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]];
        mask.push(u8::from(inside(place)));
    }
    let run = Run::serial();
    let layout = Layout { dims, spacing: [spacing; 3], origin: [0.0; 3] };
    let options = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    let shape = Shape::from_mask(&mask, &layout, &options, &run).unwrap();
    Solid::new(&shape, &SolidOptions::default(), &run).unwrap()
}

/// Two cubes with a gap between them.
fn apart(gap: usize) -> Solid {
    solid([24 + gap, 12, 12], 1.0, |[x, ..]| x < 12 || x >= 12 + gap)
}

/// Two cubes with a thin bar from one to the other, at any scale.
fn dumbbell(spacing: f64) -> Solid {
    solid([44, 14, 14], spacing, |[x, y, z]| {
        !(14..30).contains(&x) || ((6..8).contains(&y) && (6..8).contains(&z))
    })
}

fn ask(n: usize, effort: Effort, connected: bool) -> GenerateOptions {
    let best = BestOptions { connected, ..BestOptions::default() };
    GenerateOptions { method: Method::Best, spheres: n, effort, best, ..GenerateOptions::default() }
}

fn make(solid: &Solid, options: &GenerateOptions) -> Clump {
    generate(solid, options, &Run::serial()).unwrap()
}

/// In how many parts the spheres are, overlaps of half a per cent of the smaller radius counting.
fn parts(spheres: &[Sphere]) -> usize {
    let mut of: Vec<usize> = (0..spheres.len()).collect();
    for _ in spheres {
        for (i, a) in spheres.iter().enumerate() {
            for (j, b) in spheres.iter().enumerate() {
                let depth = a.radius + b.radius - (a.center - b.center).norm();
                if depth > 0.005 * a.radius.min(b.radius) {
                    of[i] = of[i].min(of[j]);
                }
            }
        }
    }
    of.iter().enumerate().filter(|&(i, p)| i == *p).count()
}

fn mismatch(solid: &Solid, clump: &Clump) -> f64 {
    let options = QualityOptions { surface: false, ..QualityOptions::default() };
    quality(solid, &clump.spheres, &options, &Run::serial()).unwrap().mismatch
}

#[test]
fn bodies_that_are_apart_are_joined() {
    for gap in [1, 4, 10] {
        let solid = apart(gap);
        for (n, effort) in [
            (1, Effort::Draft),
            (2, Effort::Normal),
            (4, Effort::Draft),
            (9, Effort::Normal),
            (40, Effort::Normal),
        ] {
            let clump = make(&solid, &ask(n, effort, true));
            assert_eq!((clump.spheres.len(), parts(&clump.spheres)), (n, 1), "{gap} {n}");
            assert!(clump.note.is_empty(), "{}", clump.note);
        }
        // Without the demand they stay apart, or the test would show nothing.
        assert!(parts(&make(&solid, &ask(40, Effort::Normal, false)).spheres) > 1, "{gap}");
    }
}

#[test]
fn it_costs_little_where_the_body_is_one() {
    let solid = dumbbell(1.0);
    for n in [4, 10, 30] {
        let (one, free) = (
            make(&solid, &ask(n, Effort::Normal, true)),
            make(&solid, &ask(n, Effort::Normal, false)),
        );
        assert_eq!(parts(&one.spheres), 1, "{n}");
        let (d, least) = (mismatch(&solid, &one), mismatch(&solid, &free));
        assert!(d < 1.35 * least, "{n}: {d} {least}");
        if parts(&free.spheres) == 1 {
            assert!(d < 1.05 * least, "{n}: {d} {least}");
        }
    }
}

#[test]
fn the_unit_of_length_does_not_matter() {
    for scale in [1e-9, 1e6] {
        let clump = make(&dumbbell(scale), &ask(6, Effort::Normal, true));
        assert_eq!(parts(&clump.spheres), 1);
    }
}

#[test]
fn threads_do_not_change_a_byte() {
    let solid = apart(3);
    let make = |threads: usize| {
        generate(&solid, &ask(20, Effort::Normal, true), &Run::new(threads).unwrap()).unwrap()
    };
    let one = make(1);
    assert_eq!(one.spheres, make(2).spheres);
    assert_eq!(one.spheres, make(8).spheres);
}

#[test]
fn limits_that_forbid_it_are_told() {
    // No sphere may be as large as a part of the gap.
    let solid = apart(10);
    let options = GenerateOptions {
        best: BestOptions { connected: true, max_protrusion: 1.0, ..BestOptions::default() },
        ..ask(6, Effort::Normal, true)
    };
    let clump = make(&solid, &options);
    assert!(parts(&clump.spheres) > 1 && clump.note.contains("2 parts"), "{}", clump.note);
    // And those that allow it, kept.
    let options = GenerateOptions {
        best: BestOptions { connected: true, max_radius: 5.0, ..BestOptions::default() },
        ..ask(12, Effort::Normal, true)
    };
    let clump = make(&solid, &options);
    assert!(clump.spheres.iter().all(|s| s.radius <= 5.0));
    assert_eq!(parts(&clump.spheres), 1, "{}", clump.note);
}

#[test]
fn symmetric_clumps_are_joined_as_well() {
    let solid = apart(4);
    let x = morula::math::Vec3::x();
    for n in [4, 16] {
        let symmetry = morula::generate::Symmetry::Planes(vec![x]);
        let best = BestOptions { connected: true, symmetry, ..BestOptions::default() };
        let clump = make(&solid, &GenerateOptions { best, ..ask(n, Effort::Normal, true) });
        assert_eq!((clump.spheres.len(), parts(&clump.spheres)), (n, 1), "{}", clump.note);
        for s in &clump.spheres {
            // The mirror is the middle of the gap, x = 14.
            let image =
                |o: &Sphere| (o.center.x + s.center.x - 28.0).abs() < 1e-9 && o.radius == s.radius;
            assert!(clump.spheres.iter().any(image), "{s:?}");
        }
    }
}

/// Draft effort makes no moves: what is asked more often than without the demand is asked while
/// parts are joined.
#[test]
fn a_cancel_is_heard_while_parts_are_joined() {
    let solid = apart(4);
    let asked = |connected: bool, most: usize| {
        let mut asked = 0;
        let run = Run::serial().with_progress(Box::new(|_| {
            asked += 1;
            asked > most
        }));
        let clump = generate(&solid, &ask(40, Effort::Draft, connected), &run).unwrap();
        drop(run);
        (asked, clump)
    };
    let (without, _) = asked(false, usize::MAX);
    let (with, clump) = asked(true, usize::MAX);
    assert_eq!((parts(&clump.spheres), clump.stopped), (1, Stopped::Spheres));
    assert!(with > without + 3, "{with} {without}");
    let (_, clump) = asked(true, without + 1);
    assert_eq!((clump.spheres.len(), clump.stopped), (40, Stopped::Cancelled));
    assert!(parts(&clump.spheres) > 1);
}
