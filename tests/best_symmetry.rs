//! Clumps that are their own images.

#![allow(clippy::panic, clippy::unwrap_used)]

mod common;

use common::{particle as solid, solid_of};
use morula::clump::Stopped;
use morula::generate::{
    BestOptions, Effort, GenerateOptions, HalfSpace, Method, Symmetry, generate,
};
use morula::math::{Sphere, Vec3};
use morula::measure::{QualityOptions, quality};
use morula::shape::primitive::Primitive;
use morula::shape::{ImportOptions, Layout, Shape};
use morula::{Clump, Error, Run, Solid};

fn planes(normals: &[[f64; 3]]) -> Symmetry {
    Symmetry::Planes(normals.iter().map(|n| Vec3::from(*n)).collect())
}

const THREE: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn ask(spheres: usize, effort: Effort, symmetry: Symmetry) -> GenerateOptions {
    GenerateOptions {
        method: Method::Best,
        spheres,
        effort,
        best: BestOptions { symmetry, ..BestOptions::default() },
        ..GenerateOptions::default()
    }
}

fn make(solid: &Solid, n: usize, effort: Effort, symmetry: Symmetry) -> Clump {
    generate(solid, &ask(n, effort, symmetry), &Run::serial()).unwrap()
}

/// How far the clump is from its image in the plane through `center`, in the worst sphere.
fn off(spheres: &[Sphere], center: &Vec3, normal: &Vec3) -> f64 {
    let n = normal.normalize();
    let apart = |s: &Sphere| {
        let image = s.center - n * (2.0 * n.dot(&(s.center - center)));
        let one = |t: &Sphere| (t.center - image).norm() + (t.radius - s.radius).abs();
        spheres.iter().map(one).fold(f64::MAX, f64::min)
    };
    spheres.iter().map(apart).fold(0.0, f64::max)
}

#[test]
fn spheres_are_images_in_the_planes_given() {
    let h = 0.75f64.sqrt();
    for (name, normals) in [
        ("box", vec![[1.0, 1.0, 0.0]]),
        ("cone", vec![[1.0, 0.0, 0.0], [0.5, h, 0.0]]),
        ("ellipsoid", THREE.to_vec()),
        // Not of the body: the clump has it all the same.
        ("stone", vec![[0.3, -0.2, 0.9]]),
    ] {
        let solid = solid(name, 32);
        let center = solid.moments().centroid;
        for (n, effort) in [(6, Effort::Normal), (40, Effort::Draft), (90, Effort::Normal)] {
            let clump = make(&solid, n, effort, planes(&normals));
            assert_eq!((clump.spheres.len(), clump.stopped), (n, Stopped::Spheres));
            for normal in &normals {
                let off = off(&clump.spheres, &center, &Vec3::from(*normal));
                assert!(off < 1e-14, "{name} {n} {normal:?}: {off}");
            }
        }
    }
}

#[test]
fn any_number_that_images_can_make_up_is_honoured() {
    let solid = solid("ellipsoid", 24);
    for n in (1..=30).chain([50, 100]) {
        let clump = make(&solid, n, Effort::Draft, planes(&THREE));
        assert_eq!((clump.spheres.len(), clump.note.as_str()), (n, ""));
        assert!(clump.spheres.iter().all(|s| s.radius > 0.0));
    }
}

#[test]
fn a_number_that_images_cannot_make_up_is_said() {
    let solid = solid("box", 24);
    let cube = planes(&[[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]]);
    for (n, most) in [(1, 1), (2, 1), (5, 1), (6, 6), (7, 7), (11, 9), (25, 25), (50, 50)] {
        let clump = make(&solid, n, Effort::Draft, cube.clone());
        assert_eq!(clump.spheres.len(), most);
        assert_eq!(clump.stopped == Stopped::Exhausted, most < n);
        assert_eq!(clump.note.contains("48, 24, 12, 8, 6 or 1"), most < n, "{}", clump.note);
    }
}

#[test]
fn planes_with_too_many_images_are_named() {
    let solid = solid("box", 24);
    let bad = planes(&[[1.0, 0.0, 0.0], [1.0, 0.3, 0.0]]);
    let result = generate(&solid, &ask(10, Effort::Draft, bad), &Run::serial());
    let Err(Error::InvalidArgument(text)) = result else { panic!("taken") };
    assert!(text.contains("(1, 0.3, 0)"), "{text}");
}

#[test]
fn limits_are_kept_by_all_images() {
    let solid = solid("box", 32);
    let center = solid.moments().centroid;
    let half = |x: f64, offset: f64| HalfSpace { normal: Vec3::new(x, 0.0, 0.0), offset };
    let with = |half_spaces: Vec<HalfSpace>| {
        let mut options = ask(30, Effort::Normal, planes(&THREE));
        options.best =
            BestOptions { half_spaces, max_protrusion: 0.01, max_radius: 0.3, ..options.best };
        options
    };
    let both = with(vec![half(1.0, 0.4), half(-2.0, 0.8)]);
    let clump = generate(&solid, &both, &Run::serial()).unwrap();
    assert_eq!(clump.spheres.len(), 30, "{}", clump.note);
    let reach = |s: &Sphere| s.center.x.abs() + s.radius;
    assert!(clump.spheres.iter().all(|s| s.radius <= 0.3 && reach(s) <= 0.4 + 1e-12));
    for normal in THREE {
        assert!(off(&clump.spheres, &center, &Vec3::from(normal)) < 1e-14);
    }
    let one = with(vec![half(1.0, 0.4)]);
    let Err(Error::InvalidArgument(text)) = generate(&solid, &one, &Run::serial()) else {
        panic!("taken")
    };
    assert!(text.contains("half-space 0"), "{text}");
}

#[test]
fn no_plane_is_no_symmetry() {
    let solid = solid("torus", 24);
    let none = make(&solid, 12, Effort::Normal, Symmetry::None);
    assert_eq!(none.spheres, make(&solid, 12, Effort::Normal, planes(&[])).spheres);
}

#[test]
fn the_same_bytes_come_out_for_any_number_of_threads() {
    let solid = solid("torus", 32);
    for (n, effort) in [(12, Effort::Normal), (420, Effort::Draft)] {
        let options = ask(n, effort, planes(&THREE[..2]));
        let make = |threads: usize, seed: u64| {
            let run = Run::new(threads).unwrap().with_seed(seed);
            generate(&solid, &options, &run).unwrap().spheres
        };
        let one = make(1, 0);
        assert_eq!(one, make(2, 0));
        assert_eq!(one, make(8, 0));
        assert_ne!(one, make(1, 1));
    }
}

#[test]
fn deadline_and_cancel_give_symmetric_clumps() {
    let solid = solid("ellipsoid", 32);
    let center = solid.moments().centroid;
    let options = ask(20, Effort::Thorough, planes(&THREE));
    let late = Run::serial().with_deadline(0.0);
    let cancelled = Run::serial().with_progress(Box::new(|f| f > 0.2));
    for (run, stopped) in [(late, Stopped::Deadline), (cancelled, Stopped::Cancelled)] {
        let clump = generate(&solid, &options, &run).unwrap();
        assert_eq!((clump.spheres.len(), clump.stopped), (20, stopped));
        for normal in THREE {
            assert!(off(&clump.spheres, &center, &Vec3::from(normal)) < 1e-14);
        }
    }
}

/// An ellipsoid or a box, turned, scaled and moved; and its axes.
fn placed(name: &str, scale: f64, at: f64) -> (Solid, [Vec3; 3]) {
    let (mut vertices, faces) = match name {
        "box" => Primitive::Box { edges: [1.0, 0.8, 0.6] }.mesh(8).unwrap(),
        _ => Primitive::from_name(name).unwrap().mesh(48).unwrap(),
    };
    let axes = [[0.6, 0.64, 0.48], [-0.8, 0.48, 0.36], [0.0, -0.6, 0.8]].map(Vec3::from);
    for v in &mut vertices {
        let p = (axes[0] * v[0] + axes[1] * v[1] + axes[2] * v[2]) * scale;
        *v = [p.x + at, p.y - at, p.z + 2.0 * at];
    }
    let options = ImportOptions::default();
    let shape = Shape::from_mesh(&vertices, &faces, &options, &Run::serial()).unwrap();
    (solid_of(&shape, 40), axes)
}

#[test]
fn the_symmetry_of_bodies_is_found_however_they_lie() {
    for (name, scale, at) in [("ellipsoid", 1.0, 0.0), ("box", 1e-9, 3e-8), ("box", 1e6, -1e8)] {
        let (solid, axes) = placed(name, scale, at);
        let center = solid.moments().centroid;
        for (n, effort) in [(33, Effort::Normal), (100, Effort::Draft)] {
            let clump = make(&solid, n, effort, Symmetry::Auto);
            assert_eq!((clump.spheres.len(), clump.note.as_str()), (n, ""));
            for axis in axes {
                // The axes are found from the moments, to so much.
                let close = 1e-9 * scale + 1e-14 * at.abs();
                let off = off(&clump.spheres, &center, &axis);
                assert!(off < close, "{name} {scale} {n}: {off}");
            }
        }
    }
}

#[test]
fn all_images_of_a_cube_are_made_where_there_are_enough_spheres() {
    let solid = solid("box", 32);
    let center = solid.moments().centroid;
    let clump = make(&solid, 200, Effort::Draft, Symmetry::Auto);
    assert_eq!((clump.spheres.len(), clump.note.as_str()), (200, ""));
    let diagonals = [[1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 0.0, -1.0]];
    for normal in THREE.iter().chain(&diagonals) {
        assert!(off(&clump.spheres, &center, &Vec3::from(*normal)) < 1e-14);
    }
}

#[test]
fn any_number_of_spheres_is_honoured_with_the_symmetry_found() {
    for name in ["box", "ellipsoid"] {
        let solid = solid(name, 24);
        for n in (1..=30).chain([50, 100]) {
            let clump = make(&solid, n, Effort::Draft, Symmetry::Auto);
            assert_eq!((clump.spheres.len(), clump.stopped), (n, Stopped::Spheres), "{name}");
        }
    }
    // Where the whole symmetry is not to be had, that is said.
    let clump = make(&solid("box", 24), 5, Effort::Draft, Symmetry::Auto);
    assert!(clump.note.contains("of the 48 images"), "{}", clump.note);
}

#[test]
fn a_body_without_symmetry_has_the_clump_that_it_has_anyway() {
    let solid = solid("stone", 40);
    let none = make(&solid, 20, Effort::Normal, Symmetry::None);
    assert_eq!(none.spheres, make(&solid, 20, Effort::Normal, Symmetry::Auto).spheres);
}

#[test]
fn symmetry_costs_little() {
    let wanted = QualityOptions { surface: false, ..QualityOptions::default() };
    let run = Run::serial();
    for (name, n) in [
        ("box", 20),
        ("box", 100),
        ("ellipsoid", 10),
        ("ellipsoid", 50),
        ("torus", 20),
        ("tablet", 20),
        ("cone", 50),
    ] {
        let solid = solid(name, 64);
        let d = |symmetry: Symmetry| {
            let clump = make(&solid, n, Effort::Normal, symmetry);
            quality(&solid, &clump.spheres, &wanted, &run).unwrap().mismatch
        };
        let (auto, none) = (d(Symmetry::Auto), d(Symmetry::None));
        assert!(auto < 1.25 * none, "{name} {n}: {auto} {none}");
    }
}

#[test]
fn the_symmetry_found_does_not_depend_on_threads() {
    let solid = solid("box", 32);
    for n in [10, 50] {
        let make = |threads: usize| {
            let run = Run::new(threads).unwrap();
            generate(&solid, &ask(n, Effort::Normal, Symmetry::Auto), &run).unwrap().spheres
        };
        let one = make(1);
        assert_eq!(one, make(2));
        assert_eq!(one, make(8));
    }
}

#[test]
fn voxels_have_symmetric_clumps() {
    let dims = [24, 16, 12];
    let mask: Vec<u8> =
        (0..24 * 16 * 12).map(|i| u8::from(i % 24 < 16 || i / 24 % 16 < 8)).collect();
    let layout = Layout { dims, spacing: [0.5; 3], origin: [3.0, 4.0, 5.0] };
    let options = ImportOptions::default();
    let shape = Shape::from_mask(&mask, &layout, &options, &Run::serial()).unwrap();
    let solid = solid_of(&shape, 24);
    let clump = make(&solid, 25, Effort::Normal, Symmetry::Auto);
    assert_eq!((clump.spheres.len(), clump.note.as_str()), (25, ""));
    assert!(off(&clump.spheres, &solid.moments().centroid, &Vec3::z()) < 1e-13);
}

#[test]
fn symmetric_clumps_hang_together_where_that_is_asked_for() {
    // Two balls far apart on a thin rod.
    let ball = |x: f64, i: f64, j: f64, k: f64| {
        (i - x).powi(2) + (j - 11.5).powi(2) + (k - 11.5).powi(2) < 110.0
    };
    let mut mask = Vec::new();
    for k in 0..24 {
        for j in 0..24 {
            for i in 0..80 {
                let [x, y, z] = [i, j, k].map(f64::from);
                let rod = (10..70).contains(&i) && (11..13).contains(&j) && (11..13).contains(&k);
                mask.push(u8::from(rod || ball(11.5, x, y, z) || ball(67.5, x, y, z)));
            }
        }
    }
    let layout = Layout { dims: [80, 24, 24], spacing: [1.0; 3], origin: [0.0; 3] };
    let options = ImportOptions::default();
    let shape = Shape::from_mask(&mask, &layout, &options, &Run::serial()).unwrap();
    let solid = solid_of(&shape, 80);
    let mut options = ask(24, Effort::Normal, planes(&THREE));
    options.best.connected = true;
    let clump = generate(&solid, &options, &Run::serial()).unwrap();
    assert_eq!((clump.spheres.len(), clump.note.as_str()), (24, ""));
    let center = solid.moments().centroid;
    for normal in THREE {
        assert!(off(&clump.spheres, &center, &Vec3::from(normal)) < 1e-12);
    }
    let meet = |a: &Sphere, b: &Sphere| (a.center - b.center).norm() < a.radius + b.radius;
    let (mut rest, mut open) = (clump.spheres[1..].to_vec(), vec![clump.spheres[0]]);
    while let Some(s) = open.pop() {
        open.extend(rest.iter().filter(|t| meet(&s, t)));
        rest.retain(|t| !meet(&s, t));
    }
    assert!(rest.is_empty(), "{rest:?}");
}

/// Both bodies have mirrors across the axes, which `auto` finds.
fn demanding(n: usize, symmetry: Symmetry, with: BestOptions) -> GenerateOptions {
    let best = BestOptions { symmetry, ..with };
    GenerateOptions { best, ..ask(n, Effort::Normal, Symmetry::None) }
}

#[test]
fn symmetric_clumps_have_the_volume_of_the_target_where_that_is_asked_for() {
    let fine = QualityOptions { columns: 1024, surface: false, ..QualityOptions::default() };
    for (name, n, symmetry) in [
        ("box", 24, Symmetry::Auto),
        ("ellipsoid", 40, Symmetry::Auto),
        ("ellipsoid", 31, planes(&THREE)),
    ] {
        let solid = solid(name, 32);
        let center = solid.moments().centroid;
        let equal = BestOptions { equal_volume: true, ..BestOptions::default() };
        let clump = generate(&solid, &demanding(n, symmetry, equal), &Run::serial()).unwrap();
        assert_eq!(clump.spheres.len(), n, "{name}: {}", clump.note);
        for normal in THREE {
            let off = off(&clump.spheres, &center, &Vec3::from(normal));
            assert!(off < 1e-14, "{name} {normal:?}: {off}");
        }
        let q = quality(&solid, &clump.spheres, &fine, &Run::serial()).unwrap();
        assert!(q.volume_error.abs() <= 1e-4, "{name}: {} {}", q.volume_error, clump.note);
    }
}

#[test]
fn symmetric_clumps_come_closer_to_the_surface_where_that_is_asked_for() {
    for (name, normals, symmetry, n) in [
        ("cone", vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], None, 24),
        ("box", THREE.to_vec(), Some(Symmetry::Auto), 24),
    ] {
        let solid = solid(name, 32);
        let center = solid.moments().centroid;
        let symmetry = symmetry.unwrap_or(planes(&normals));
        let distance = |smoothness: f64| {
            let with = BestOptions { smoothness, ..BestOptions::default() };
            let options = demanding(n, symmetry.clone(), with);
            let clump = generate(&solid, &options, &Run::serial()).unwrap();
            assert_eq!(clump.spheres.len(), n, "{name}: {}", clump.note);
            for normal in &normals {
                assert!(off(&clump.spheres, &center, &Vec3::from(*normal)) < 1e-14);
            }
            let q = quality(&solid, &clump.spheres, &QualityOptions::default(), &Run::serial());
            q.unwrap().rms_distance
        };
        let (free, smooth) = (distance(0.0), distance(2.0));
        assert!(smooth < 0.995 * free, "{name}: {smooth} {free}");
    }
}
