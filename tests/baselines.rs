//! The baselines of the field from outside.

#![allow(clippy::unwrap_used)]

mod common;

use common::{particle as solid, solid_of};
use morula::clump::Stopped;
use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::shape::primitive::Primitive;
use morula::shape::{ImportOptions, Layout, Shape};
use morula::{Clump, Error, Run, Solid, Sphere};

const ALL: [Method; 4] =
    [Method::Euclidean, Method::FerellecMcDowell, Method::Favier, Method::UniformGrid];

/// A thick L of cells that are no cubes.
fn voxels() -> Solid {
    let dims = [24, 20, 9];
    let cells: Vec<u8> =
        (0..24 * 20 * 9).map(|i| u8::from(i % 24 < 9 || i / 24 % 20 < 8)).collect();
    let layout = Layout { dims, spacing: [1.0, 1.0, 1.25], origin: [0.0; 3] };
    let shape = Shape::from_mask(&cells, &layout, &ImportOptions::default(), &Run::serial());
    solid_of(&shape.unwrap(), 24)
}

fn ask(method: Method, spheres: usize) -> GenerateOptions {
    GenerateOptions { method, spheres, ..GenerateOptions::default() }
}

fn make(solid: &Solid, options: &GenerateOptions) -> Clump {
    generate(solid, options, &Run::serial()).unwrap()
}

/// How far a sphere reaches beyond the surface, by the exact distance of its centre.
fn reach(solid: &Solid, s: &Sphere) -> f64 {
    let surface = solid.surface(&Run::serial()).unwrap();
    s.radius + solid.frame().scale * surface.signed_distance(&solid.frame().to_unit(&s.center))
}

#[test]
fn a_sphere_is_one_sphere() {
    let solid = solid("sphere", 40);
    for method in ALL {
        let clump = make(&solid, &ask(method, 1));
        let s = clump.spheres[0];
        assert_eq!((clump.spheres.len(), clump.stopped), (1, Stopped::Spheres));
        assert!(clump.note.is_empty());
        // About a cell's centre at best.
        let off = match method {
            Method::UniformGrid => 0.05,
            // As the first point that it draws has it.
            Method::FerellecMcDowell => 0.03,
            _ => 0.01,
        };
        assert!(s.center.norm() < off && (s.radius - 1.0).abs() < off, "{method:?} {s:?}");
    }
}

#[test]
fn no_sphere_reaches_beyond_the_tolerance() {
    for (body, size) in [(solid("cone", 32), 2.0), (solid("stone", 32), 1.0), (voxels(), 24.0)] {
        for method in ALL {
            let inner = make(&body, &ask(method, 30));
            assert!(inner.spheres.len() > 5, "{method:?} {}", inner.note);
            for s in &inner.spheres {
                assert!(s.radius > 0.0 && reach(&body, s) <= 1e-12 * size, "{method:?} {s:?}");
            }
            let tolerance = 0.01 * size;
            let outer = make(&body, &GenerateOptions { tolerance, ..ask(method, 30) });
            let farthest = outer.spheres.iter().map(|s| reach(&body, s)).fold(0.0, f64::max);
            assert!(farthest <= tolerance * (1.0 + 1e-9), "{method:?} {farthest}");
            assert!(farthest > 0.999 * tolerance, "{method:?} {farthest}");
        }
    }
}

#[test]
fn favier_takes_the_axis_of_a_capsule_apart() {
    let body = solid("capsule", 64);
    for n in [2, 3, 9] {
        let clump = make(&body, &ask(Method::Favier, n));
        assert_eq!(clump.spheres.len(), n);
        for (i, s) in clump.spheres.iter().enumerate() {
            let z = i as f64 / (n - 1) as f64 - 0.5;
            let off = (s.center.x.abs() + s.center.y.abs()).max((s.center.z.abs() - z.abs()).abs());
            assert!(off < 0.02, "{n}: {i}: {s:?}");
            // The prism of 48 sides, and no more than the capsule.
            assert!(s.radius > 0.494 && s.radius < 0.5, "{n}: {i}: {s:?}");
        }
    }
}

#[test]
fn favier_says_when_the_axis_is_of_no_use() {
    let body = solid("torus", 32);
    let result = generate(&body, &ask(Method::Favier, 5), &Run::serial());
    assert!(matches!(result, Err(Error::NoSpheres(text)) if text.contains("axis")));
}

#[test]
fn euclidean_takes_the_greatest_ball_that_is_left() {
    for (name, overlap) in [("cone", 0.9), ("torus", 0.5), ("box", 0.0)] {
        let body = solid(name, 20);
        let clump = make(&body, &GenerateOptions { overlap, ..ask(Method::Euclidean, 12) });
        let (grid, surface) = (body.grid(), body.surface(&Run::serial()).unwrap());
        let spheres: Vec<Sphere> =
            clump.spheres.iter().map(|s| body.frame().sphere_to_unit(s)).collect();
        for (k, s) in spheres.iter().enumerate() {
            let room = |p: &morula::math::Vec3| {
                spheres[..k]
                    .iter()
                    .map(|b| (p - b.center).norm() - (1.0 - overlap) * b.radius)
                    .fold(-surface.signed_distance(p), f64::min)
            };
            // Every cell anew, each time.
            let mut best = 0.0f64;
            for i in 0..grid.len() {
                let [nx, ny, _] = grid.dims;
                best = best.max(room(&grid.center(i % nx, i / nx % ny, i / (nx * ny))));
            }
            assert!((room(&s.center) - s.radius).abs() < 1e-9, "{name} {k}");
            let cell = grid.spacing.x;
            assert!(s.radius > best - 2e-3 * cell, "{name} {k}: {} {best}", s.radius);
            // The depth rises no faster than by the way from the nearest cell's centre.
            assert!(s.radius < best + 0.87 * cell, "{name} {k}: {} {best}", s.radius);
        }
    }
}

#[test]
fn spheres_that_shall_not_overlap_do_not() {
    let body = solid("stone", 32);
    let clump = make(&body, &GenerateOptions { overlap: 0.0, ..ask(Method::Euclidean, 40) });
    for (i, a) in clump.spheres.iter().enumerate() {
        for b in &clump.spheres[..i] {
            let gap = (a.center - b.center).norm() - a.radius - b.radius;
            assert!(gap > -1e-12, "{gap}");
        }
    }
    assert_eq!(clump.spheres.len(), 40);
}

#[test]
fn the_same_bytes_come_out_for_any_number_of_threads_and_any_power_of_two() {
    let primitive = Primitive::Stone { seed: 4, diameter: 1.0, roughness: 0.6 };
    let (vertices, faces) = primitive.mesh(32).unwrap();
    let body = |scale: f64| {
        let v: Vec<[f64; 3]> = vertices.iter().map(|p| p.map(|x| x * scale)).collect();
        let shape = Shape::from_mesh(&v, &faces, &ImportOptions::default(), &Run::serial());
        solid_of(&shape.unwrap(), 32)
    };
    let (plain, tiny) = (body(1.0), body(2f64.powi(-30)));
    for method in ALL {
        let run = |solid: &Solid, threads: usize, scale: f64| {
            let options = GenerateOptions { tolerance: 0.01 * scale, ..ask(method, 25) };
            generate(solid, &options, &Run::new(threads).unwrap()).unwrap().spheres
        };
        let one = run(&plain, 1, 1.0);
        assert_eq!(one, run(&plain, 2, 1.0), "{method:?}");
        assert_eq!(one, run(&plain, 8, 1.0), "{method:?}");
        let small = run(&tiny, 1, 2f64.powi(-30));
        let large = small.iter().map(|s| s.radius * 2f64.powi(30));
        assert!(one.iter().map(|s| s.radius).eq(large), "{method:?}");
    }
}

#[test]
fn every_end_is_told() {
    let body = solid("ellipsoid", 32);
    for method in ALL {
        let o = ask(method, 0);
        let by_mismatch = make(&body, &GenerateOptions { mismatch: 0.2, ..o.clone() });
        assert_eq!(by_mismatch.stopped, Stopped::Mismatch, "{method:?} {}", by_mismatch.note);
        let least = GenerateOptions { min_radius: 0.3, spheres: 5000, ..o.clone() };
        let by_radius = make(&body, &least);
        assert!(by_radius.spheres.iter().all(|s| s.radius >= 0.3), "{method:?}");
        let ends = matches!(by_radius.stopped, Stopped::Radius | Stopped::Exhausted);
        assert!(ends && by_radius.note.contains("of 5000"), "{method:?} {}", by_radius.note);
        let none = GenerateOptions { min_radius: 0.6, spheres: 5, ..o.clone() };
        let result = generate(&body, &none, &Run::serial());
        assert!(matches!(result, Err(Error::NoSpheres(_))), "{method:?} {result:?}");
        let late = Run::serial().with_deadline(0.0);
        let wanted = GenerateOptions { mismatch: 1e-6, spheres: 500, ..o.clone() };
        let clump = generate(&body, &wanted, &late).unwrap();
        assert_eq!(clump.stopped, Stopped::Deadline, "{method:?}");
        assert!(clump.note.contains("of 500 spheres: the deadline"), "{}", clump.note);
        let at_once = Run::serial().with_progress(Box::new(|_| true));
        let result = generate(&body, &wanted, &at_once);
        assert!(matches!(result, Err(Error::Cancelled(_))), "{method:?}");
        let calls = std::cell::Cell::new(0);
        let later = Run::serial().with_progress(Box::new(|f| {
            calls.set(calls.get() + u32::from(f >= 0.2));
            calls.get() > 3
        }));
        let clump = generate(&body, &wanted, &later).unwrap();
        assert_eq!(clump.stopped, Stopped::Cancelled, "{method:?}");
    }
    // No grid covers itself with fewer balls than it takes.
    let coarse = solid("box", 8);
    for method in [Method::Euclidean, Method::UniformGrid, Method::FerellecMcDowell] {
        let clump = make(&coarse, &ask(method, 100_000));
        assert_eq!(clump.stopped, Stopped::Exhausted, "{method:?}");
        assert!(clump.note.contains("of 100000 spheres"), "{}", clump.note);
    }
}

#[test]
fn what_a_method_does_not_read_is_refused() {
    let body = solid("sphere", 24);
    let refused = |o: &GenerateOptions| {
        let result = generate(&body, o, &Run::serial());
        assert!(matches!(result, Err(Error::InvalidArgument(_))), "{o:?}");
    };
    for method in ALL {
        let o = ask(method, 5);
        refused(&GenerateOptions { min_distance: 1.0, ..o.clone() });
        refused(&GenerateOptions { radius_offset: 1.0, ..o.clone() });
        refused(&GenerateOptions { confine: true, ..o.clone() });
        refused(&GenerateOptions { effort: Effort::Thorough, ..o.clone() });
        refused(&GenerateOptions { tolerance: f64::NAN, ..o.clone() });
        refused(&GenerateOptions { tolerance: 1e3, ..o.clone() });
        if method != Method::Euclidean {
            refused(&GenerateOptions { overlap: 0.5, ..o.clone() });
        }
        refused(&GenerateOptions { overlap: 1.5, ..o });
    }
    refused(&ask(Method::Favier, 0));
    for method in [Method::Mss, Method::Best, Method::SurfaceFit] {
        refused(&GenerateOptions { tolerance: 0.1, ..ask(method, 5) });
        refused(&GenerateOptions { overlap: 0.5, ..ask(method, 5) });
    }
}
