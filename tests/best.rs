//! The generator of least mismatch from outside.

#![allow(clippy::unwrap_used)]

use morula::clump::Stopped;
use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::measure::{QualityOptions, quality};
use morula::shape::primitive::Primitive;
use morula::shape::{ImportOptions, Shape};
use morula::solid::SolidOptions;
use morula::{Clump, Error, Run, Solid};

fn solid(name: &str, cells: u32) -> Solid {
    let run = Run::serial();
    let primitive = Primitive::from_name(name).unwrap();
    let shape = Shape::from_primitive(&primitive, 48, &ImportOptions::default(), &run).unwrap();
    let resolution = morula::solid::Resolution::CellsLongest(cells);
    Solid::new(&shape, &SolidOptions { resolution, ..SolidOptions::default() }, &run).unwrap()
}

fn ask(spheres: usize, effort: Effort) -> GenerateOptions {
    GenerateOptions { method: Method::Best, spheres, effort, ..GenerateOptions::default() }
}

fn mismatch(solid: &Solid, clump: &Clump) -> f64 {
    let options = QualityOptions { surface: false, ..QualityOptions::default() };
    quality(solid, &clump.spheres, &options, &Run::serial()).unwrap().mismatch
}

#[test]
fn any_number_of_spheres_is_honoured() {
    let solid = solid("ellipsoid", 40);
    for n in [1, 2, 3, 7, 64, 450] {
        let clump = generate(&solid, &ask(n, Effort::Draft), &Run::serial()).unwrap();
        assert_eq!((clump.spheres.len(), clump.stopped), (n, Stopped::Spheres));
        assert!(clump.note.is_empty());
        assert!(clump.spheres.iter().all(|s| s.radius > 0.0 && s.radius < 1.0));
    }
}

#[test]
fn a_sphere_is_one_sphere() {
    let solid = solid("sphere", 40);
    let clump = generate(&solid, &ask(1, Effort::Draft), &Run::serial()).unwrap();
    let s = clump.spheres[0];
    assert!(s.center.norm() < 0.01 && (s.radius - 1.0).abs() < 0.01, "{s:?}");
}

#[test]
fn the_same_bytes_come_out_for_any_number_of_threads() {
    let solid = solid("torus", 40);
    for (n, effort) in [(12, Effort::Draft), (12, Effort::Normal), (420, Effort::Draft)] {
        let make = |threads: usize, seed: u64| {
            let run = Run::new(threads).unwrap().with_seed(seed);
            generate(&solid, &ask(n, effort), &run).unwrap().spheres
        };
        let one = make(1, 0);
        assert_eq!(one, make(2, 0));
        assert_eq!(one, make(8, 0));
        assert_ne!(one, make(1, 1));
    }
}

#[test]
fn a_deadline_gives_what_there_is() {
    let solid = solid("torus", 40);
    let run = Run::serial().with_deadline(0.0);
    let clump = generate(&solid, &ask(20, Effort::Thorough), &run).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (20, Stopped::Deadline));
    assert!(clump.note.contains("deadline"), "{}", clump.note);
}

#[test]
fn a_cancel_gives_what_there_is_or_says_that_there_is_nothing() {
    let solid = solid("torus", 40);
    let at_once = Run::serial().with_progress(Box::new(|_| true));
    let result = generate(&solid, &ask(20, Effort::Normal), &at_once);
    assert!(matches!(result, Err(Error::Cancelled(_))));
    let later = Run::serial().with_progress(Box::new(|f| f > 0.2));
    let clump = generate(&solid, &ask(20, Effort::Normal), &later).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (20, Stopped::Cancelled));
}

#[test]
fn it_is_far_closer_than_mss() {
    for (name, n, part) in [("box", 12, 0.7), ("torus", 20, 0.6), ("cone", 20, 0.6)] {
        let solid = solid(name, 64);
        let best = generate(&solid, &ask(n, Effort::Normal), &Run::serial()).unwrap();
        let mss = GenerateOptions { method: Method::Mss, spheres: n, ..GenerateOptions::default() };
        let mss = generate(&solid, &mss, &Run::serial()).unwrap();
        let (best, mss) = (mismatch(&solid, &best), mismatch(&solid, &mss));
        assert!(best < part * mss, "{name}: {best} {mss}");
    }
}

#[test]
fn options_of_other_methods_are_refused() {
    let solid = solid("sphere", 24);
    let o = ask(5, Effort::Draft);
    for bad in [
        GenerateOptions { min_distance: 1.0, ..o.clone() },
        GenerateOptions { radius_offset: 1.0, ..o.clone() },
        GenerateOptions { confine: true, ..o.clone() },
        GenerateOptions { spheres: usize::MAX, ..o.clone() },
    ] {
        let result = generate(&solid, &bad, &Run::serial());
        assert!(matches!(result, Err(Error::InvalidArgument(_))), "{bad:?}");
    }
}

#[test]
fn radii_stay_above_the_least() {
    let solid = solid("box", 40);
    let o = GenerateOptions { min_radius: 0.11, ..ask(40, Effort::Normal) };
    let clump = generate(&solid, &o, &Run::serial()).unwrap();
    assert_eq!(clump.spheres.len(), 40);
    assert!(clump.spheres.iter().all(|s| s.radius >= 0.11));
    let o = GenerateOptions { min_radius: 0.7, ..ask(1, Effort::Draft) };
    assert!(matches!(generate(&solid, &o, &Run::serial()), Err(Error::NoSpheres(_))));
}

#[test]
fn a_mismatch_is_reached_with_few_spheres() {
    let solid = solid("torus", 40);
    for (goal, effort) in [(0.3, Effort::Draft), (0.05, Effort::Draft), (0.1, Effort::Normal)] {
        let options = GenerateOptions { mismatch: goal, ..ask(0, effort) };
        let clump = generate(&solid, &options, &Run::serial()).unwrap();
        let n = clump.spheres.len();
        let d = mismatch(&solid, &clump);
        assert!(d <= goal && clump.stopped == Stopped::Mismatch, "{goal}: {d} with {n}");
        let less = generate(&solid, &ask(n - 1, effort), &Run::serial()).unwrap();
        assert!(mismatch(&solid, &less) > goal, "{goal}: {n} are not the fewest");
        // A limit above them changes nothing; one below is kept.
        let limited = GenerateOptions { spheres: n + 5, ..options.clone() };
        assert!(mismatch(&solid, &generate(&solid, &limited, &Run::serial()).unwrap()) <= goal);
        let limited = GenerateOptions { spheres: n / 2, ..options };
        let half = generate(&solid, &limited, &Run::serial()).unwrap();
        assert_eq!((half.spheres.len(), half.stopped), (n / 2, Stopped::Spheres));
    }
}

#[test]
fn as_many_spheres_as_a_least_radius_allows() {
    let solid = solid("box", 40);
    let options = GenerateOptions { min_radius: 0.15, ..ask(0, Effort::Draft) };
    let clump = generate(&solid, &options, &Run::serial()).unwrap();
    assert_eq!(clump.stopped, Stopped::Radius);
    assert!(clump.spheres.len() >= 8 && clump.spheres.iter().all(|s| s.radius >= 0.1499));
    let twice = ask(2 * clump.spheres.len(), Effort::Draft);
    let twice = generate(&solid, &GenerateOptions { min_radius: 0.15, ..twice }, &Run::serial());
    assert!(mismatch(&solid, &twice.unwrap()) > 0.95 * mismatch(&solid, &clump));
}

#[test]
fn as_many_spheres_as_there_is_time_for() {
    let solid = solid("torus", 40);
    // The callback stands for a clock: it stops the search at a fixed place.
    let calls = std::cell::Cell::new(0);
    let run = Run::serial().with_progress(Box::new(|_| {
        calls.set(calls.get() + 1);
        calls.get() > 400
    }));
    let clump = generate(&solid, &ask(0, Effort::Draft), &run).unwrap();
    assert_eq!(clump.stopped, Stopped::Cancelled);
    assert!(clump.spheres.len().is_power_of_two() && clump.spheres.len() >= 16);
    let late = Run::serial().with_deadline(1e-9);
    let clump = generate(&solid, &ask(0, Effort::Normal), &late).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (8, Stopped::Deadline));
}

#[test]
fn a_power_of_two_scales_every_byte() {
    let (vertices, faces) = Primitive::from_name("stone").unwrap().mesh(24).unwrap();
    let made = |k: f64| {
        let run = Run::serial();
        let scaled: Vec<[f64; 3]> = vertices.iter().map(|v| v.map(|x| x * k)).collect();
        let shape = Shape::from_mesh(&scaled, &faces, &ImportOptions::default(), &run).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        generate(&solid, &ask(20, Effort::Normal), &run).unwrap().spheres
    };
    let plain = made(1.0);
    for k in [2f64.powi(-40), 2f64.powi(30)] {
        for (s, p) in made(k).iter().zip(&plain) {
            assert_eq!((s.center, s.radius), (p.center * k, p.radius * k));
        }
    }
}

/// A cancel between two numbers of spheres gives the last clump.
#[test]
fn a_cancel_between_numbers_of_spheres_gives_the_last_clump() {
    let solid = solid("stone", 24);
    let ask =
        GenerateOptions { method: Method::Best, mismatch: 0.05, ..GenerateOptions::default() };
    let mut ends = 0;
    for most in [150, 200, 250, 300, 350, 400, 450, 500] {
        let mut asked = 0;
        let run = Run::serial().with_progress(Box::new(|_| {
            asked += 1;
            asked > most
        }));
        let clump = generate(&solid, &ask, &run).unwrap();
        assert!(!clump.spheres.is_empty());
        ends += usize::from(clump.stopped == Stopped::Cancelled);
    }
    assert!(ends > 3, "{ends}");
}

/// What many spheres take grows no faster than they do, is counted, and is refused beforehand
/// where it is too much.
#[test]
fn many_spheres_take_what_is_counted_and_no_more_than_allowed() {
    let shape = Primitive::from_name("ellipsoid").unwrap();
    let run = Run::serial();
    let shape = Shape::from_primitive(&shape, 32, &ImportOptions::default(), &run).unwrap();
    let with = |memory_limit: u64| {
        let options = SolidOptions {
            memory_limit,
            resolution: morula::solid::Resolution::CellsLongest(40),
            ..SolidOptions::default()
        };
        Solid::new(&shape, &options, &Run::serial()).unwrap()
    };
    let solid = with(1 << 30);
    let taken = |spheres: usize, effort: Effort| {
        let run = Run::serial();
        let options =
            GenerateOptions { method: Method::Best, spheres, effort, ..GenerateOptions::default() };
        generate(&solid, &options, &run).unwrap();
        run.counters().peak_bytes
    };
    let (few, many) = (taken(300, Effort::Normal), taken(1200, Effort::Normal));
    assert!(many < 5 * few, "{few} {many}");
    let options =
        GenerateOptions { method: Method::Best, spheres: 1200, ..GenerateOptions::default() };
    let e = generate(&with(many / 2), &options, &Run::serial()).err().unwrap();
    assert!(matches!(e, Error::MemoryLimit(_)), "{e}");
    assert!(e.to_string().contains("may take"), "{e}");
    let options = GenerateOptions { method: Method::Inscribed, effort: Effort::Draft, ..options };
    let run = Run::serial();
    generate(&solid, &options, &run).unwrap();
    let limit = run.counters().peak_bytes / 10 * 9;
    let e = generate(&with(limit), &options, &Run::serial()).err().unwrap();
    assert!(matches!(e, Error::MemoryLimit(_)), "{e}");
    assert!(e.to_string().contains("1200 spheres of the method inscribed"), "{e}");
}
