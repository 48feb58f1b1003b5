//! The set cover of inscribed spheres from outside.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use morula::clump::Stopped;
use morula::generate::cover::{Candidates, CoverOptions, Ends, thin};
use morula::generate::{GenerateOptions, Method, generate};
use morula::measure::{QualityOptions, quality};
use morula::shape::read::FileOptions;
use morula::shape::{ImportOptions, Layout, Primitive};
use morula::solid::SolidOptions;
use morula::{Clump, Error, Run, Shape, Solid};

fn solid(name: &str) -> Solid {
    let run = Run::serial();
    let primitive = Primitive::from_name(name).unwrap();
    let shape = Shape::from_primitive(&primitive, 48, &ImportOptions::default(), &run).unwrap();
    Solid::new(&shape, &SolidOptions::default(), &run).unwrap()
}

fn ask(spheres: usize, coverage: f64) -> GenerateOptions {
    let cover = CoverOptions { thinning_cells: 30, cells_inside: 25, ..CoverOptions::default() };
    GenerateOptions { method: Method::Cover, spheres, coverage, cover, ..Default::default() }
}

fn make(solid: &Solid, options: &GenerateOptions) -> Clump {
    generate(solid, options, &Run::serial()).unwrap()
}

#[test]
fn no_sphere_reaches_beyond_the_surface() {
    for name in ["tablet", "torus", "stone"] {
        let solid = solid(name);
        for candidates in [Candidates::Thinned, Candidates::Analytic] {
            let mut o = ask(60, 0.0);
            o.cover.candidates = candidates;
            let clump = make(&solid, &o);
            assert_eq!((clump.spheres.len(), clump.stopped), (60, Stopped::Spheres));
            let surface = solid.surface(&Run::serial()).unwrap();
            for s in &clump.spheres {
                let unit = solid.frame().sphere_to_unit(s);
                let out = surface.signed_distance(&unit.center) + unit.radius;
                assert!(out < 1e-12, "{name} {out:e}");
            }
        }
    }
}

#[test]
fn the_coverage_asked_for_is_reached_and_measured_so() {
    let solid = solid("ellipsoid");
    let mut last = 0;
    for target in [0.8, 0.9, 0.95] {
        let clump = make(&solid, &ask(0, target));
        assert_eq!(clump.stopped, Stopped::Coverage);
        assert!(clump.spheres.len() > last && clump.note.is_empty());
        last = clump.spheres.len();
        let o = QualityOptions { surface: false, ..QualityOptions::default() };
        let q = quality(&solid, &clump.spheres, &o, &Run::serial()).unwrap();
        assert!(q.coverage > target - 0.01 && q.coverage < target + 0.03, "{}", q.coverage);
        assert!(q.overshoot < 1e-4);
    }
}

#[test]
fn other_criteria_stop_it_too() {
    let solid = solid("ellipsoid");
    let o = GenerateOptions { mismatch: 0.06, ..ask(0, 0.0) };
    assert_eq!(make(&solid, &o).stopped, Stopped::Mismatch);
    let o = GenerateOptions { min_radius: 0.48, ..ask(0, 0.0) };
    let clump = make(&solid, &o);
    assert_eq!(clump.stopped, Stopped::Radius);
    assert!(clump.spheres.iter().all(|s| s.radius >= 0.48) && clump.note.contains("least radius"));
    let clump = make(&solid, &ask(100_000, 0.0));
    assert_eq!(clump.stopped, Stopped::Exhausted);
    assert!(clump.note.contains("candidate"), "{}", clump.note);
    let o = GenerateOptions { min_radius: 2.0, ..ask(9, 0.0) };
    assert!(matches!(generate(&solid, &o, &Run::serial()), Err(Error::NoSpheres(_))));
}

#[test]
fn the_same_bytes_come_out_for_any_number_of_threads() {
    let solid = solid("stone");
    for ends in [Ends::Surface, Ends::Curve] {
        let mut o = ask(0, 0.9);
        o.spheres = 200;
        o.cover.ends = ends;
        let make = |threads: usize| generate(&solid, &o, &Run::new(threads).unwrap()).unwrap();
        let one = make(1).spheres;
        assert_eq!(one, make(2).spheres);
        assert_eq!(one, make(8).spheres);
    }
}

#[test]
fn deadline_and_cancel_give_what_there_is() {
    let solid = solid("torus");
    let run = Run::serial().with_deadline(0.0);
    let clump = generate(&solid, &ask(20, 0.0), &run).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (1, Stopped::Deadline));
    let at_once = Run::serial().with_progress(Box::new(|_| true));
    let result = generate(&solid, &ask(20, 0.0), &at_once);
    assert!(matches!(result, Err(Error::Cancelled(_))));
    let later = Run::serial().with_progress(Box::new(|f| f > 0.7));
    let clump = generate(&solid, &ask(0, 0.99), &later).unwrap();
    assert_eq!(clump.stopped, Stopped::Cancelled);
    assert!(!clump.spheres.is_empty());
}

#[test]
fn options_out_of_range_or_of_other_methods_are_refused() {
    let solid = solid("sphere");
    let o = ask(5, 0.0);
    let coarse = CoverOptions { thinning_cells: 3, ..CoverOptions::default() };
    let fine = CoverOptions { cells_inside: 5000, ..CoverOptions::default() };
    for bad in [
        GenerateOptions { min_distance: 1.0, ..o.clone() },
        GenerateOptions { radius_offset: 1.0, ..o.clone() },
        GenerateOptions { coverage: 1.1, ..o.clone() },
        GenerateOptions { coverage: f64::NAN, ..o.clone() },
        GenerateOptions { cover: coarse, ..o.clone() },
        GenerateOptions { cover: fine, ..o.clone() },
        GenerateOptions { spheres: 0, ..o.clone() },
        GenerateOptions { method: Method::Mss, ..o.clone() },
        GenerateOptions { method: Method::Best, coverage: 0.5, ..GenerateOptions::default() },
    ] {
        let result = generate(&solid, &bad, &Run::serial());
        assert!(matches!(result, Err(Error::InvalidArgument(_))), "{bad:?}");
    }
    let fine = CoverOptions { cells_inside: 4000, ..CoverOptions::default() };
    let result = generate(&solid, &GenerateOptions { cover: fine, ..o }, &Run::serial());
    assert!(matches!(result, Err(Error::MemoryLimit(_) | Error::TooLarge(_))));
}

/// Voxels are covered as they are; other sizes and places of a mesh change nothing but those.
#[test]
fn voxels_and_scaled_meshes() {
    let run = Run::serial();
    let dims = [22, 16, 12];
    let mask: Vec<u8> = (0..dims.iter().product::<usize>())
        .map(|n| {
            let at = [n % 22, n / 22 % 16, n / 352];
            let q: f64 =
                (0..3).map(|a| ((at[a] as f64 + 0.5) / (0.5 * dims[a] as f64) - 1.0).powi(2)).sum();
            u8::from(q <= 1.0)
        })
        .collect();
    let layout = Layout { dims, spacing: [1.0; 3], origin: [5.0; 3] };
    let shape = Shape::from_mask(&mask, &layout, &ImportOptions::default(), &run).unwrap();
    let voxels = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let clump = make(&voxels, &ask(0, 0.75));
    assert_eq!(clump.stopped, Stopped::Coverage);
    let first = clump.spheres[0];
    assert!(first.radius > 5.0 && first.radius <= 6.0, "{first:?}");
    let mut analytic = ask(5, 0.0);
    analytic.cover.candidates = Candidates::Analytic;
    assert!(matches!(generate(&voxels, &analytic, &run), Err(Error::InvalidArgument(_))));

    let corners: Vec<[f64; 3]> =
        (0..8).map(|n| [n & 1, n >> 1 & 1, n >> 2].map(f64::from)).collect();
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces: Vec<[u32; 3]> =
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let made = |scale: f64, shift: f64| {
        let edges = [3.0, 2.0, 1.0];
        let place = |c: &[f64; 3]| [0, 1, 2].map(|a| scale * edges[a] * c[a] + shift);
        let vertices: Vec<[f64; 3]> = corners.iter().map(place).collect();
        let shape = Shape::from_mesh(&vertices, &faces, &ImportOptions::default(), &run).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        make(&solid, &ask(40, 0.0)).spheres
    };
    let one = made(1.0, 0.0);
    for (a, b) in one.iter().zip(made(1024.0, 8.0)) {
        assert_eq!(a.radius * 1024.0, b.radius);
        assert_eq!(a.center * 1024.0, b.center - morula::math::Vec3::repeat(8.0));
    }
}

/// A plate much thinner than the voxels asked for still has its middle plane.
#[test]
fn thin_plates_have_spheres() {
    let run = Run::serial();
    let primitive = Primitive::Box { edges: [1.0, 1.0, 0.01] };
    let shape = Shape::from_primitive(&primitive, 16, &ImportOptions::default(), &run).unwrap();
    let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let clump = make(&solid, &ask(30, 0.0));
    assert_eq!(clump.spheres.len(), 30);
    assert!(clump.spheres.iter().all(|s| (s.radius - 0.005).abs() < 1e-6), "{:?}", clump.spheres);
}

/// Cement grains as voxels keep their topology: the count of vertices less edges and so on.
#[test]
fn real_volumes_keep_their_euler_number() {
    let Ok(data) = std::env::var("MORULA_DATA") else {
        println!("skipped: MORULA_DATA is not set");
        return;
    };
    let folder = std::path::Path::new(&data).join("voxels");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "npy"));
    files.sort();
    assert!(!files.is_empty());
    let run = Run::new(0).unwrap();
    for file in files.iter().take(6) {
        let shape = Shape::from_file(file, &FileOptions::default(), &run).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        let dims = solid.grid().dims;
        let before = euler(dims, solid.inside().unwrap());
        for ends in [Ends::Surface, Ends::Curve] {
            let skeleton = thin(dims, solid.inside().unwrap(), ends, u64::MAX, &run).unwrap();
            let mut after = vec![0u8; solid.inside().unwrap().len()];
            skeleton.voxels.iter().for_each(|&n| after[n] = 1);
            assert_eq!(euler(dims, &after), before, "{file:?}");
            assert_eq!(skeleton.simple, 0);
            println!("{file:?} {ends:?}: {} voxels of {} stay", skeleton.voxels.len(), after.len());
        }
    }
}

/// Vertices less edges plus faces less cubes of the union of closed cubes.
fn euler([nx, ny, nz]: [usize; 3], cells: &[u8]) -> i64 {
    let solid = |i: usize, j: usize, k: usize| {
        (1..=nx).contains(&i)
            && (1..=ny).contains(&j)
            && (1..=nz).contains(&k)
            && cells[i - 1 + nx * (j - 1 + ny * (k - 1))] != 0
    };
    let mut sum = 0;
    // The element with lower corner (i, j, k) that runs along the axes of `along`.
    for n in 0..(nx + 1) * (ny + 1) * (nz + 1) {
        let [i, j, k] = [n % (nx + 1), n / (nx + 1) % (ny + 1), n / ((nx + 1) * (ny + 1))];
        for along in 0..8usize {
            let reach = |a: usize| if along >> a & 1 == 1 { 1..2 } else { 0..2 };
            let touched =
                reach(2).any(|c| reach(1).any(|b| reach(0).any(|a| solid(i + a, j + b, k + c))));
            if touched {
                sum += if along.count_ones() % 2 == 0 { 1 } else { -1 };
            }
        }
    }
    sum
}
