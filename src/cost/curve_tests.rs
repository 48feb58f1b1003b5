use super::*;
use crate::generate::{Effort, Method, generate};
use crate::shape::{Primitive, Shape};
use crate::solid::{Resolution, SolidOptions};
use std::cell::Cell;

fn solid(name: &str) -> Solid {
    let run = Run::serial();
    let particle = Primitive::from_name(name).unwrap();
    let shape = Shape::from_primitive(&particle, 32, &Default::default(), &run).unwrap();
    let options =
        SolidOptions { resolution: Resolution::CellsLongest(24), ..SolidOptions::default() };
    Solid::new(&shape, &options, &run).unwrap()
}

fn quick(counts: &[usize]) -> CurveOptions {
    CurveOptions {
        generate: GenerateOptions { effort: Effort::Draft, ..GenerateOptions::default() },
        counts: counts.to_vec(),
        quality: QualityOptions { columns: 64, ..QualityOptions::default() },
        ..CurveOptions::default()
    }
}

/// All but the seconds.
fn timeless(curve: &Curve) -> Vec<Point> {
    let without = |p: &Point| Point { seconds: 0.0, seconds_so_far: 0.0, ..*p };
    curve.points.iter().map(without).collect()
}

#[test]
fn ladders_climb_to_their_end() {
    assert!(ladder(0).is_empty());
    assert_eq!(ladder(1), [1]);
    assert_eq!(ladder(9), [1, 2, 3, 4, 5, 6, 8, 9]);
    assert_eq!(ladder(10), [1, 2, 3, 4, 5, 6, 8, 10]);
    let long = ladder(1000);
    assert!(long.windows(2).all(|w| w[0] < w[1]) && long.len() == 28, "{long:?}");
    assert_eq!(long.last(), Some(&1000));
}

#[test]
fn a_sphere_alone_costs_what_a_sphere_costs() {
    let c = curve(&solid("sphere"), &quick(&[1]), &Run::serial()).unwrap();
    let p = c.points[0];
    assert!((p.step_factor - 1.0).abs() < 0.02, "{p:?}");
    assert!((p.least_radius - 1.0).abs() < 0.02, "{p:?}");
    assert_eq!(p.step_cost, 1.0);
    assert!(p.mismatch < 0.02 && p.surface < 0.02, "{p:?}");
}

#[test]
fn points_are_what_single_calls_give() {
    let (solid, options) = (solid("ellipsoid"), quick(&[1, 3, 8, 20]));
    let c = curve(&solid, &options, &Run::serial()).unwrap();
    assert!(!c.cut && c.failed.is_empty());
    let volume = solid.moments().volume;
    assert!((c.diameter.powi(3) * std::f64::consts::PI / 6.0 / volume - 1.0).abs() < 1e-12);
    let mut so_far = c.prepared;
    for (p, clump) in c.points.iter().zip(&c.clumps) {
        let asked = GenerateOptions { spheres: p.asked, ..options.generate.clone() };
        let alone = generate(&solid, &asked, &Run::serial()).unwrap();
        assert_eq!(alone.spheres, clump.spheres, "{}", p.asked);
        let q = quality(&solid, &clump.spheres, &options.quality, &Run::serial()).unwrap();
        assert_eq!((p.mismatch, p.coverage, p.overshoot), (q.mismatch, q.coverage, q.overshoot));
        assert_eq!((p.surface, p.roughness), (q.rms_distance / c.diameter, q.roughness));
        assert!(p.seconds > 0.0);
        so_far += p.seconds - c.prepared;
        assert!((p.seconds_so_far - so_far).abs() < 1e-9);
        assert!(p.step_factor > 0.2 && p.step_factor <= 1.1, "{p:?}");
        assert!(p.time_cost == p.step_cost / p.step_factor);
    }
    assert!(c.points.windows(2).all(|w| w[0].step_cost < w[1].step_cost));
    assert!(c.points[3].mismatch < 0.3 * c.points[0].mismatch);
    assert_eq!(c.points[0].masses, Some(MassStatus::MassOnly));
    // Spheres about the middle of an ellipsoid cannot weigh what its ends do.
    assert!(c.points[3].inertia > 0.0 && c.points[3].inertia < 0.3, "{:?}", c.points[3]);
}

#[test]
fn curves_do_not_depend_on_threads() {
    let (solid, options) = (solid("ellipsoid"), quick(&[2, 5]));
    let one = curve(&solid, &options, &Run::serial()).unwrap();
    let three = curve(&solid, &options, &Run::new(3).unwrap()).unwrap();
    assert_eq!(timeless(&one), timeless(&three));
    let spheres = |c: &Curve| c.clumps.iter().map(|c| c.spheres.clone()).collect::<Vec<_>>();
    assert_eq!(spheres(&one), spheres(&three));
}

#[test]
fn a_cancel_keeps_what_there_is() {
    let (solid, options) = (solid("ellipsoid"), quick(&[1, 2, 3, 4]));
    let whole = curve(&solid, &options, &Run::serial()).unwrap();
    for stop in [0.0, 0.4, 0.7] {
        let last = Cell::new(0.0);
        let run = Run::serial().with_progress(Box::new(|f| {
            assert!(f >= last.get());
            last.set(f);
            f > stop
        }));
        match curve(&solid, &options, &run) {
            Ok(c) => {
                assert!(c.cut && c.points.len() < 4 && stop > 0.0, "{stop}");
                assert_eq!(timeless(&c), timeless(&whole)[..c.points.len()]);
            }
            Err(e) => assert!(matches!(e, Error::Cancelled(_)) && stop == 0.0, "{stop}: {e}"),
        }
    }
    // A deadline that has passed leaves the first clump.
    let c = curve(&solid, &options, &Run::serial().with_deadline(0.0)).unwrap();
    assert!(c.cut && c.points.len() == 1);
    assert_eq!(c.points[0].stopped, Stopped::Deadline);
    // One of its own ends each clump, not the curve.
    let hasty = CurveOptions { seconds: 1e-9, ..options };
    let c = curve(&solid, &hasty, &Run::serial()).unwrap();
    assert!(!c.cut && c.points.len() == 4);
    assert!(c.points.iter().all(|p| p.stopped == Stopped::Deadline));
}

#[test]
fn numbers_that_fail_are_left_out() {
    let solid = solid("ellipsoid");
    let mut options = quick(&[1, 8]);
    // No single ball of this size keeps within the surface; of more, some do.
    options.generate.min_radius = 2.0 * solid.frame().scale;
    let error = curve(&solid, &options, &Run::serial()).unwrap_err();
    assert!(matches!(error, Error::NoSpheres(_)), "{error}");
    for (counts, words) in
        [(&[][..], "no number"), (&[0, 1], "is 0"), (&[3, 3], "number of spheres 1 is 3")]
    {
        let error = curve(&solid, &quick(counts), &Run::serial()).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
    let mut options = quick(&[2]);
    options.step.step[1] = f64::NAN;
    assert!(curve(&solid, &options, &Run::serial()).is_err());
}

#[test]
fn nested_levels_hold_the_ones_before() {
    let solid = solid("stone");
    for (method, effort) in [
        (Method::Best, Effort::Draft),
        (Method::Best, Effort::Normal),
        (Method::Cover, Effort::Normal),
        (Method::Euclidean, Effort::Normal),
    ] {
        let mut options = quick(&[2, 5, 12, 30]);
        (options.generate.method, options.generate.effort) = (method, effort);
        options.levels = Levels::Nested;
        let nested = curve(&solid, &options, &Run::serial()).unwrap();
        let sizes: Vec<usize> = nested.points.iter().map(|p| p.spheres).collect();
        assert_eq!(sizes, [2, 5, 12, 30], "{method:?}");
        for pair in nested.clumps.windows(2) {
            assert_eq!(pair[0].spheres, pair[1].spheres[..pair[0].spheres.len()], "{method:?}");
        }
        options.levels = Levels::Free;
        let free = curve(&solid, &options, &Run::serial()).unwrap();
        for (n, f) in nested.points.iter().zip(&free.points) {
            println!(
                "{method:?} {effort:?} n {}: nested D {:.4}, free D {:.4}",
                n.spheres, n.mismatch, f.mismatch
            );
            let lost = if method == Method::Best { 1.6 } else { 1.0 + 1e-12 };
            assert!(
                n.mismatch <= lost * f.mismatch,
                "{method:?} {}: {} for {}",
                n.spheres,
                n.mismatch,
                f.mismatch
            );
        }
    }
    let mut options = quick(&[2, 5]);
    options.levels = Levels::Nested;
    options.generate.method = Method::Inscribed;
    options.generate.effort = Effort::Normal;
    assert!(matches!(curve(&solid, &options, &Run::serial()), Err(Error::Unsupported(_))));
    options.generate = GenerateOptions::default();
    options.generate.best.connected = true;
    let error = curve(&solid, &options, &Run::serial()).unwrap_err();
    assert!(error.to_string().contains("connected"), "{error}");
}

#[test]
fn chained_levels_are_as_good_as_free_ones() {
    let solid = solid("stone");
    let mut options = quick(&[3, 10, 20, 30]);
    options.generate.effort = Effort::Normal;
    let free = curve(&solid, &options, &Run::serial()).unwrap();
    options.levels = Levels::Chained;
    let chained = curve(&solid, &options, &Run::serial()).unwrap();
    for (c, f) in chained.points.iter().zip(&free.points) {
        println!("n {}: chained D {:.4}, free D {:.4}", c.spheres, c.mismatch, f.mismatch);
        assert!(c.mismatch < 1.1 * f.mismatch, "{}: {} for {}", c.spheres, c.mismatch, f.mismatch);
        assert_eq!(c.seconds, c.seconds_so_far);
    }
}
