//! Clumps within the surface: held against every triangle, one by one.

#![allow(clippy::unwrap_used)]

mod common;

use common::{Arrays, beyond, solid_of_mesh as solid};
use morula::clump::Stopped;
use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::measure::QualityOptions;
use morula::shape::Primitive;
use morula::{Clump, Error, Run};

fn asked(spheres: usize, effort: Effort) -> GenerateOptions {
    let quality = QualityOptions { surface: false, columns: 256, ..QualityOptions::default() };
    GenerateOptions {
        method: Method::Inscribed,
        spheres,
        effort,
        quality: Some(quality),
        ..GenerateOptions::default()
    }
}

fn arrays(name: &str, segments: usize) -> Arrays {
    Primitive::from_name(name).unwrap().mesh(segments).unwrap()
}

fn make(arrays: &Arrays, cells: u32, n: usize, effort: Effort) -> Clump {
    generate(&solid(arrays, cells), &asked(n, effort), &Run::serial()).unwrap()
}

#[test]
fn no_sphere_reaches_beyond_a_triangle() {
    for (name, segments, cells, n) in [
        ("stone", 24, 48, 40),
        ("box", 8, 32, 25),
        ("torus", 40, 48, 20),
        // Also where the grid is far too coarse to tell the depth.
        ("cone", 24, 16, 15),
        ("tablet", 24, 20, 10),
    ] {
        let arrays = arrays(name, segments);
        let clump = make(&arrays, cells, n, Effort::Draft);
        assert_eq!((clump.spheres.len(), clump.stopped), (n, Stopped::Spheres), "{name}");
        let beyond = beyond(&arrays, &clump.spheres);
        assert!(beyond <= 1e-12, "{name}: {beyond:e}");
        let q = clump.quality.unwrap();
        assert!(q.overshoot < 1e-9 && q.coverage > 0.5, "{name}: {} {}", q.overshoot, q.coverage);
    }
}

#[test]
fn spheres_reach_as_far_as_they_may() {
    for name in ["stone", "box", "torus"] {
        let arrays = arrays(name, 24);
        let solid = solid(&arrays, 40);
        let size = solid.moments().volume.cbrt();
        let mut before = 0.0;
        for part in [0.0, 0.005, 0.02, 0.05] {
            let tolerance = part * size;
            let options = GenerateOptions { tolerance, ..asked(20, Effort::Normal) };
            let clump = generate(&solid, &options, &Run::serial()).unwrap();
            assert_eq!(clump.spheres.len(), 20, "{name}");
            let beyond = beyond(&arrays, &clump.spheres);
            assert!((beyond - tolerance).abs() < 1e-9 * size, "{name}: {beyond:e} {tolerance:e}");
            let coverage = clump.quality.unwrap().coverage;
            assert!(coverage > before, "{name} {part}: {coverage} {before}");
            before = coverage;
        }
        assert!(before > 0.93, "{name}: {before}");
    }
    let solid = solid(&arrays("box", 8), 16);
    let far = GenerateOptions { tolerance: 1e3, ..asked(5, Effort::Draft) };
    assert!(matches!(generate(&solid, &far, &Run::serial()), Err(Error::InvalidArgument(_))));
}

#[test]
fn one_sphere_is_the_largest_that_fits() {
    for name in ["sphere", "box", "ellipsoid"] {
        let arrays = arrays(name, 48);
        let most = (0..3)
            .map(|a| arrays.0.iter().map(|v| v[a]).fold(f64::MIN, f64::max))
            .fold(f64::MAX, f64::min);
        let clump = make(&arrays, 48, 1, Effort::Normal);
        let r = clump.spheres[0].radius;
        assert!(r <= most * (1.0 + 1e-12) && r > 0.98 * most, "{name}: {r} of {most}");
    }
}

#[test]
fn more_work_covers_more() {
    let arrays = arrays("stone", 24);
    let coverage = |effort| make(&arrays, 32, 16, effort).quality.unwrap().coverage;
    let [draft, normal, thorough] = [Effort::Draft, Effort::Normal, Effort::Thorough].map(coverage);
    assert!(draft < normal && normal < thorough, "{draft} {normal} {thorough}");
}

#[test]
fn threads_change_nothing() {
    let solid = solid(&arrays("stone", 24), 40);
    let spheres = |threads| {
        let run = Run::new(threads).unwrap();
        generate(&solid, &asked(12, Effort::Thorough), &run).unwrap().spheres
    };
    let one = spheres(1);
    assert_eq!(spheres(2), one);
    assert_eq!(spheres(8), one);
}

#[test]
fn size_and_place_change_nothing_but_rounding() {
    let (vertices, faces) = arrays("cone", 24);
    let at = |scale: f64, shift: f64| {
        let moved = vertices.iter().map(|v| v.map(|x| x * scale + shift)).collect();
        make(&(moved, faces.clone()), 32, 12, Effort::Normal).spheres
    };
    let plain = at(1.0, 0.0);
    let k = 2f64.powi(-30);
    for (s, p) in at(k, 0.0).iter().zip(&plain) {
        assert_eq!((s.center, s.radius), (p.center * k, p.radius * k));
    }
    assert_eq!(at(1e9, 1e10).len(), plain.len());
}

#[test]
fn what_it_does_not_read_is_refused() {
    let solid = solid(&arrays("box", 8), 16);
    let refused = |options: GenerateOptions| {
        let e = generate(&solid, &options, &Run::serial()).unwrap_err();
        assert!(matches!(e, Error::InvalidArgument(_)), "{e}");
        e.to_string()
    };
    let ask = asked(5, Effort::Draft);
    assert!(refused(GenerateOptions { confine: true, ..ask.clone() }).contains("confine"));
    let offset = GenerateOptions { radius_offset: 0.5, ..ask.clone() };
    assert!(refused(offset).contains("radius_offset"));
    let apart = GenerateOptions { min_distance: 1.0, ..ask.clone() };
    assert!(refused(apart).contains("min_distance"));
    assert!(refused(GenerateOptions { mismatch: 0.1, ..ask.clone() }).contains("mismatch"));
    let none = GenerateOptions { spheres: 0, min_radius: 0.1, ..ask.clone() };
    assert!(refused(none).contains("0 spheres"));
    // Larger than fits.
    let large = GenerateOptions { min_radius: 1e3, ..ask };
    let e = generate(&solid, &large, &Run::serial()).unwrap_err();
    assert!(matches!(e, Error::NoSpheres(_)), "{e}");
}

#[test]
fn a_deadline_leaves_what_there_is() {
    let solid = solid(&arrays("stone", 24), 32);
    let run = Run::serial().with_deadline(1e-9);
    let clump = generate(&solid, &asked(20, Effort::Thorough), &run).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (20, Stopped::Deadline));
    assert!(clump.note.contains("deadline"), "{}", clump.note);
}
