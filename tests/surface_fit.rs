//! The generator that fits spheres to the surface, from outside.

#![allow(clippy::unwrap_used)]

mod common;

use common::{Arrays, add, cuboid, data, join, sphere, turned};
use morula::clump::Stopped;
use morula::generate::{GenerateOptions, Method, generate};
use morula::math::Vec3;
use morula::measure::{QualityOptions, quality};
use morula::shape::{ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Clump, Error, Run, Shape, Solid, Sphere};

fn solid_of(shape: &Shape) -> Solid {
    let resolution = Resolution::CellsLongest(24);
    let options = SolidOptions { resolution, ..SolidOptions::default() };
    Solid::new(shape, &options, &Run::serial()).unwrap()
}

fn of_mesh(m: &Arrays) -> Solid {
    let run = Run::serial();
    solid_of(&Shape::from_mesh(&m.0, &m.1, &ImportOptions::default(), &run).unwrap())
}

fn primitive(name: &str) -> Solid {
    let run = Run::serial();
    let primitive = Primitive::from_name(name).unwrap();
    solid_of(&Shape::from_primitive(&primitive, 48, &ImportOptions::default(), &run).unwrap())
}

fn ask(spheres: usize) -> GenerateOptions {
    GenerateOptions { method: Method::SurfaceFit, spheres, ..GenerateOptions::default() }
}

fn fitted(solid: &Solid, spheres: usize, seed: u64) -> Clump {
    generate(solid, &ask(spheres), &Run::serial().with_seed(seed)).unwrap()
}

/// Greatest difference of centre or radius between known spheres and those found.
fn off(known: &[(f64, [f64; 3])], found: &[Sphere]) -> f64 {
    let nearest = |&(r, c): &(f64, [f64; 3])| {
        let off = |s: &Sphere| (s.center - Vec3::from(c)).norm().max((s.radius - r).abs());
        found.iter().map(off).fold(f64::MAX, f64::min)
    };
    known.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn unions_of_spheres_are_found_back() {
    let clumps: [&[(f64, [f64; 3])]; 4] = [
        &[(1.0, [5.0, -3.0, 2.0])],
        &[(1.0, [0.0; 3]), (0.7, [0.9, 0.3, 0.1])],
        &[(1.0, [0.0; 3]), (0.8, [1.1, 0.1, 0.0]), (0.6, [-0.3, 1.0, 0.4])],
        &[
            (0.5, [0.0; 3]),
            (0.45, [0.6, 0.1, 0.0]),
            (0.4, [1.1, 0.3, 0.1]),
            (0.4, [-0.2, 0.55, 0.1]),
            (0.35, [0.1, -0.1, 0.6]),
        ],
    ];
    for known in clumps {
        let parts: Vec<Arrays> = known.iter().map(|&(r, at)| sphere(64, 128, r, at)).collect();
        let solid = of_mesh(&join(&parts));
        for seed in 0..3 {
            let clump = fitted(&solid, 0, seed);
            assert_eq!(clump.spheres.len(), known.len(), "seed {seed}: {:?}", clump.spheres);
            let off = off(known, &clump.spheres);
            assert!(off < 2e-3, "seed {seed}: {off} {:?}", clump.spheres);
        }
    }
}

#[test]
fn the_same_bytes_come_out_for_any_number_of_threads() {
    let solid = primitive("stone");
    for n in [0, 5] {
        let make = |threads: usize, seed: u64| {
            let run = Run::new(threads).unwrap().with_seed(seed);
            generate(&solid, &ask(n), &run).unwrap().spheres
        };
        let one = make(1, 0);
        assert_eq!(one, make(2, 0));
        assert_eq!(one, make(8, 0));
        assert_ne!(one, make(1, 1));
    }
}

#[test]
fn the_number_of_spheres_is_a_limit() {
    let solid = primitive("stone");
    let free = fitted(&solid, 0, 0);
    assert_eq!(free.stopped, Stopped::Exhausted);
    assert!((4..40).contains(&free.spheres.len()), "{}", free.note);
    for n in [1, 3, free.spheres.len()] {
        let clump = fitted(&solid, n, 0);
        assert_eq!((clump.spheres.len(), clump.stopped), (n, Stopped::Spheres));
        assert!(clump.note.is_empty() && clump.spheres.is_sorted_by(|a, b| a.radius >= b.radius));
    }
    let many = fitted(&solid, 500, 0);
    assert_eq!((&many.spheres, many.stopped), (&free.spheres, Stopped::Exhausted));
    assert!(many.note.starts_with(&format!("{} of 500 spheres", free.spheres.len())));
}

#[test]
fn deadline_and_cancel_give_what_there_is() {
    let solid = primitive("stone");
    let run = Run::serial().with_deadline(0.0);
    let clump = generate(&solid, &ask(4), &run).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (4, Stopped::Deadline));
    assert!(clump.note.contains("deadline"), "{}", clump.note);
    let at_once = Run::serial().with_progress(Box::new(|_| true));
    assert!(matches!(generate(&solid, &ask(4), &at_once), Err(Error::Cancelled(_))));
    let before = Run::serial().with_progress(Box::new(|f| f >= 0.1));
    assert!(matches!(generate(&solid, &ask(4), &before), Err(Error::Cancelled(_))));
    for at in [0.11, 0.65] {
        let later = Run::serial().with_progress(Box::new(move |f| f >= at));
        let clump = generate(&solid, &ask(4), &later).unwrap();
        assert_eq!((clump.spheres.len(), clump.stopped), (4, Stopped::Cancelled));
        assert!(clump.note.contains("cancelled"), "{}", clump.note);
    }
}

#[test]
fn what_the_method_does_not_read_is_refused() {
    let solid = primitive("sphere");
    let o = ask(5);
    for bad in [
        GenerateOptions { mismatch: 0.1, ..o.clone() },
        GenerateOptions { min_distance: 1.0, ..o.clone() },
        GenerateOptions { radius_offset: 1.0, ..o.clone() },
        GenerateOptions { confine: true, ..o.clone() },
    ] {
        let result = generate(&solid, &bad, &Run::serial());
        assert!(matches!(result, Err(Error::InvalidArgument(_))), "{bad:?}");
    }
}

#[test]
fn radii_stay_above_the_least() {
    let solid = primitive("stone");
    let free = fitted(&solid, 0, 0);
    let least = free.spheres[free.spheres.len() / 2].radius;
    let o = GenerateOptions { min_radius: least, ..ask(0) };
    let clump = generate(&solid, &o, &Run::serial()).unwrap();
    assert!(clump.spheres.iter().all(|s| s.radius >= least));
    let o = GenerateOptions { min_radius: 1e3, ..ask(0) };
    let Err(Error::NoSpheres(text)) = generate(&solid, &o, &Run::serial()) else { panic!() };
    assert!(text.contains("1000"), "{text}");
}

#[test]
fn scaled_by_powers_of_two_the_clump_is_the_same_bit_for_bit() {
    let m = join(&[sphere(24, 40, 1.0, [0.0; 3]), sphere(24, 40, 0.75, [1.0, 0.25, 0.0])]);
    let one = fitted(&of_mesh(&m), 0, 3).spheres;
    for k in [-40, 33] {
        let by = 2f64.powi(k);
        let scaled = (m.0.iter().map(|v| v.map(|x| x * by)).collect(), m.1.clone());
        let back: Vec<Sphere> = fitted(&of_mesh(&scaled), 0, 3)
            .spheres
            .iter()
            .map(|s| Sphere::new(s.center / by, s.radius / by))
            .collect();
        assert_eq!(back, one);
    }
}

#[test]
fn cavities_and_inner_walls_do_not_pull_at_the_spheres() {
    let mut hollow = sphere(48, 96, 1.0, [0.0; 3]);
    add(&mut hollow, &turned(sphere(24, 48, 0.5, [0.1, 0.0, 0.0])));
    let mut nested = sphere(48, 96, 1.0, [0.0; 3]);
    add(&mut nested, &sphere(24, 48, 0.5, [0.1, 0.0, 0.0]));
    for m in [hollow, nested] {
        let clump = fitted(&of_mesh(&m), 0, 0);
        assert_eq!(clump.spheres.len(), 1);
        assert!(off(&[(1.0, [0.0; 3])], &clump.spheres) < 2e-3, "{:?}", clump.spheres);
    }
}

#[test]
fn openings_are_closed_by_lids() {
    // A box without its upper side.
    let mut m = cuboid([0.0; 3], [1.0, 0.8, 0.6]);
    m.1.drain(2..4);
    let open = of_mesh(&m);
    let clump = fitted(&open, 0, 0);
    let options = QualityOptions { surface: false, ..QualityOptions::default() };
    let q = quality(&open, &clump.spheres, &options, &Run::serial()).unwrap();
    assert!(q.volume_error.abs() < 0.05 && q.mismatch < 0.12, "{q:?}");
}

#[test]
fn voxels_are_fitted_on_their_outer_faces() {
    // A ball of radius 9.3 cells of edge 0.1 with a closed hole in it.
    let dims = [20, 20, 20];
    let mut mask = vec![0u8; 8000];
    for (i, cell) in mask.iter_mut().enumerate() {
        let c = [i % 20, i / 20 % 20, i / 400].map(|c| c as f64 + 0.5 - 10.0);
        let q = c.iter().map(|x| x * x).sum::<f64>().sqrt();
        *cell = u8::from(q < 9.3 && q > 3.0);
    }
    let layout = Layout { dims, spacing: [0.1; 3], origin: [-1.0; 3] };
    let run = Run::serial();
    let shape = Shape::from_mask(&mask, &layout, &ImportOptions::default(), &run).unwrap();
    let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let clump = fitted(&solid, 0, 0);
    assert_eq!(clump.spheres.len(), 1, "{:?}", clump.spheres);
    assert!(off(&[(0.93, [0.0; 3])], &clump.spheres) < 0.02, "{:?}", clump.spheres);
}

/// Errors of volume, centroid and spread (the paper's section 3.2).
fn errors(solid: &Solid, clump: &Clump) -> [f64; 3] {
    let options = QualityOptions { surface: false, ..QualityOptions::default() };
    let q = quality(solid, &clump.spheres, &options, &Run::serial()).unwrap();
    let inertia = solid.principal().moments;
    let of =
        |i: [f64; 3], volume: f64| i.map(|x| ((i.iter().sum::<f64>() / 2.0 - x) / volume).sqrt());
    let target = of(inertia, 1.0);
    let mut union = inertia;
    union.iter_mut().zip(q.moment_errors).for_each(|(i, e)| *i *= 1.0 + e);
    let union = of(union, 1.0 + q.volume_error);
    let square = (0..3).map(|k| (union[k] / target[k] - 1.0).powi(2)).sum::<f64>();
    [q.volume_error.abs(), q.centroid_error, (square / 3.0).sqrt()]
}

#[test]
fn mass_properties_of_real_stones_are_those_of_table_2() {
    let Some(root) = data() else { return };
    let run = Run::serial();
    let mut all: [Vec<f64>; 3] = Default::default();
    for (name, most) in [
        // Compact ones.
        ("stone/stone_002_007a.stl", 0.01),
        ("cement/ma160_01731_equant.stl", 0.006),
        ("asteroid/hyperion.obj", 0.006),
        ("asteroid/1998ml14.obj", 0.006),
        ("asteroid/gaspra.obj", 0.01),
        ("stone/stone_15.stl", 0.03),
        ("cement/cement152_00998_flat.stl", 0.03),
    ] {
        let path = root.join("particles").join(name);
        let shape = Shape::from_file(&path, &Default::default(), &run).unwrap();
        let solid = solid_of(&shape);
        let clump = fitted(&solid, 0, 0);
        assert!((6..=24).contains(&clump.spheres.len()), "{name}: {}", clump.note);
        let e = errors(&solid, &clump);
        assert!(e.iter().all(|e| *e < most), "{name}: {e:?}");
        all.iter_mut().zip(e).for_each(|(v, e)| v.push(e));
    }
    for v in &mut all {
        v.sort_by(f64::total_cmp);
        assert!(v[v.len() / 2] < 0.01);
    }
}
