//! Spheres of nearly one size that do not overlap: held against packings known by heart, every
//! pair and every triangle.

#![allow(clippy::unwrap_used)]

mod common;

use common::{Arrays, solid_of_mesh as solid, to_mesh};
use morula::clump::Stopped;
use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::math::{Sphere, Vec3};
use morula::measure::QualityOptions;
use morula::shape::voxels::Layout;
use morula::shape::{ImportOptions, Primitive};
use morula::solid::SolidOptions;
use morula::{Clump, Error, Run, Shape, Solid};

fn asked(spheres: usize, min_radius: f64) -> GenerateOptions {
    GenerateOptions { method: Method::Packed, spheres, min_radius, ..GenerateOptions::default() }
}

fn arrays(name: &str, segments: usize) -> Arrays {
    let mut parts = name.split(',');
    let mut body = Primitive::from_name(parts.next().unwrap()).unwrap();
    for pair in parts {
        let (key, value) = pair.split_once('=').unwrap();
        body.set(key, value.parse().unwrap()).unwrap();
    }
    body.mesh(segments).unwrap()
}

fn make(name: &str, n: usize, min_radius: f64) -> Clump {
    let solid = solid(&arrays(name, 32), 32);
    generate(&solid, &asked(n, min_radius), &Run::serial()).unwrap()
}

/// The least radius, and the greatest over it.
fn sizes(spheres: &[Sphere]) -> (f64, f64) {
    let least = spheres.iter().map(|s| s.radius).fold(f64::MAX, f64::min);
    let most = spheres.iter().map(|s| s.radius).fold(0.0, f64::max);
    (least, most / least)
}

/// No two overlap, none reaches beyond a triangle, radii are within 5 % of each other.
fn hold(mesh: &Arrays, spheres: &[Sphere], size: f64, what: &str) {
    for (i, a) in spheres.iter().enumerate() {
        for b in &spheres[..i] {
            let gap = (a.center - b.center).norm() - a.radius - b.radius;
            assert!(gap >= 0.0, "{what}: two spheres overlap by {:e}", -gap);
        }
        let depth = to_mesh(&a.center, mesh);
        assert!(a.radius <= depth + 1e-14 * size, "{what}: {:e} beyond", a.radius - depth);
    }
    let (_, spread) = sizes(spheres);
    assert!(spread <= 1.05, "{what}: radii differ by the factor {spread}");
}

#[test]
fn none_overlaps_and_none_reaches_beyond_the_surface() {
    for (name, segments, cells, n) in [
        ("stone", 16, 32, 60),
        ("torus", 24, 32, 25),
        ("cone", 24, 16, 12),
        ("tablet", 24, 20, 2),
        // Spheres not much larger than cells.
        ("box", 8, 8, 90),
    ] {
        let arrays = arrays(name, segments);
        for (scale, shift) in [(1.0, 0.0), (1e-7, 0.3), (1e4, -2e7)] {
            let moved = arrays.0.iter().map(|v| v.map(|x| x * scale + shift)).collect();
            let moved = (moved, arrays.1.clone());
            let body = solid(&moved, cells);
            let clump = generate(&body, &asked(n, 0.0), &Run::serial()).unwrap();
            let what = format!("{name} times {scale} at {shift}");
            assert_eq!((clump.spheres.len(), clump.stopped), (n, Stopped::Spheres), "{what}");
            assert_eq!(clump.note, "");
            hold(&moved, &clump.spheres, scale, &what);
            for s in &clump.spheres {
                let p = body.frame().to_unit(&s.center);
                assert!(body.surface(&Run::serial()).unwrap().contains(&p), "{what}: outside");
            }
        }
    }
}

/// Best known packings of equal balls in the cube of edge 1 (Gensane 2004).
#[test]
fn known_packings_are_found() {
    let cube = [
        (1, 0.5),
        (2, 0.316_987),
        (3, 0.292_893),
        (4, 0.292_893),
        (5, 0.263_932),
        (6, 0.257_359),
        (8, 0.25),
        (9, 0.232_051),
        (14, 0.207_107),
    ];
    for (n, known) in cube {
        let (r, _) = sizes(&make("box", n, 0.0).spheres);
        assert!(r < known * (1.0 + 1e-5), "{n}: {r} is too good to be true");
        assert!(r > known * (1.0 - 1e-4), "{n}: {r} of {known}");
    }
    // Simple cubic, touching on all sides: a quarter, 2 x 2 x 2, is in the list; and 3 x 3 x 3.
    let (r, _) = sizes(&make("box", 27, 0.0).spheres);
    assert!(r > 0.999 / 6.0 && r <= 1.0 / 6.0, "{r}");
    let spheres = make("box,a=2", 2, 0.0).spheres;
    assert!(sizes(&spheres).0 > 0.5 * (1.0 - 1e-6), "{spheres:?}");
    for s in &spheres {
        assert!((s.center.x.abs() - 0.5).abs() < 1e-5 && s.center.yz().norm() < 1e-5, "{s:?}");
    }
}

#[test]
fn one_sphere_is_the_largest_that_fits() {
    for name in ["sphere", "ellipsoid", "torus", "cone,radius=1,height=2"] {
        let arrays = arrays(name, 48);
        let body = solid(&arrays, 32);
        let r = generate(&body, &asked(1, 0.0), &Run::serial()).unwrap().spheres[0].radius;
        // By brute force, from cells and then about the best of them.
        let run = Run::serial();
        let surface = body.surface(&run).unwrap();
        let (grid, mut best) = (body.grid(), (Vec3::zeros(), 0.0));
        for (i, _) in body.inside().unwrap().iter().enumerate().filter(|(_, c)| **c == 1) {
            let [nx, ny, _] = grid.dims;
            let p = grid.center(i % nx, i / nx % ny, i / (nx * ny));
            let depth = -surface.signed_distance(&p);
            if depth > best.1 {
                best = (p, depth);
            }
        }
        let mut step = grid.spacing.max();
        while step > 1e-6 {
            let from = best;
            for k in 0..125 {
                let way = [k % 5, k / 5 % 5, k / 25].map(|c| (f64::from(c) - 2.0) * 0.5 * step);
                let p = from.0 + Vec3::from(way);
                let depth = -surface.signed_distance(&p);
                if depth > best.1 {
                    best = (p, depth);
                }
            }
            if best == from {
                step *= 0.5;
            }
        }
        let most = best.1 * body.frame().scale;
        // Along a ridge that rises by less than a hundredth of the way it may fall short.
        assert!((r / most - 1.0).abs() < 2e-3, "{name}: {r} of {most}");
    }
}

/// The greatest radius, from `most` downwards, of which `n` balls of a face-centred lattice fit into
/// the body at one of 64 places, each ball looked at exactly.
fn by_lattice(body: &Solid, n: usize, most: f64) -> f64 {
    let run = Run::serial();
    let surface = body.surface(&run).unwrap();
    let grid = body.grid();
    let size = grid.dims.map(|d| d as f64 * grid.spacing.x);
    let mut best = 0.0;
    let mut r = most / body.frame().scale;
    while best == 0.0 {
        let edge = 8f64.sqrt() * r;
        for k in 0..64 {
            let shift = [k % 4, k / 4 % 4, k / 16].map(|c| f64::from(c) * 0.25 * edge);
            let mut count = 0;
            let cells = size.map(|s| (s / edge) as usize + 1);
            for c in 0..cells[0] * cells[1] * cells[2] {
                let at = [c % cells[0], c / cells[0] % cells[1], c / cells[0] / cells[1]];
                for half in [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]] {
                    let p = [0, 1, 2]
                        .map(|a| grid.origin[a] + shift[a] + (at[a] as f64 + half[a]) * edge);
                    let p = Vec3::from(p);
                    let fits = surface.nearest(&p).distance >= r && surface.contains(&p);
                    count += usize::from(fits);
                }
            }
            if count >= n {
                best = r;
            }
        }
        r *= 0.98;
    }
    best * body.frame().scale
}

#[test]
fn no_plain_lattice_does_better() {
    for (name, n) in [("ellipsoid", 40), ("box,c=0.6", 30), ("stone", 100)] {
        let body = solid(&arrays(name, 16), 32);
        let clump = generate(&body, &asked(n, 0.0), &Run::serial()).unwrap();
        let (r, _) = sizes(&clump.spheres);
        let plain = by_lattice(&body, n, 1.2 * r);
        assert!(r > 1.02 * plain, "{name}: {r}, a lattice has {plain}");
    }
}

#[test]
fn the_least_radius_limits_the_number() {
    // A cube holds at most 8 balls of a radius between the ninth's and a quarter.
    for (n, min_radius, fit) in [(0, 0.249, 8), (20, 0.249, 8), (5, 0.4, 1), (1, 0.4, 1)] {
        let clump = make("box", n, min_radius);
        let (r, spread) = sizes(&clump.spheres);
        assert_eq!(clump.spheres.len(), fit, "{n} of {min_radius}");
        assert!(r >= min_radius && spread <= 1.05, "{r} {spread}");
        if n == fit {
            assert_eq!((clump.stopped, clump.note.as_str()), (Stopped::Spheres, ""));
        } else {
            assert_eq!(clump.stopped, Stopped::Radius);
            assert!(clump.note.contains(&format!("{min_radius}")), "{}", clump.note);
        }
    }
    let many = make("stone", 0, 0.1);
    let fewer = make("stone", many.spheres.len(), 0.0);
    assert!(sizes(&fewer.spheres).0 >= 0.1 && many.spheres.len() > 30);
    // Larger than any that fits.
    let body = solid(&arrays("box", 8), 16);
    for n in [0, 1, 7] {
        let error = generate(&body, &asked(n, 0.7), &Run::serial()).unwrap_err();
        assert!(
            matches!(error, Error::NoSpheres(_)) && error.to_string().contains("0.7"),
            "{error}"
        );
    }
}

#[test]
fn threads_change_nothing_and_sizes_only_the_size() {
    let (vertices, faces) = arrays("stone", 16);
    let spheres = |threads: usize, scale: f64| {
        let moved = vertices.iter().map(|v| v.map(|x| x * scale)).collect();
        let run = Run::new(threads).unwrap();
        generate(&solid(&(moved, faces.clone()), 24), &asked(30, 0.0), &run).unwrap().spheres
    };
    let one = spheres(1, 1.0);
    assert_eq!(spheres(2, 1.0), one);
    assert_eq!(spheres(8, 1.0), one);
    let k = 2f64.powi(-20);
    for (s, p) in spheres(1, k).iter().zip(&one) {
        assert_eq!((s.center, s.radius), (p.center * k, p.radius * k));
    }
    let seeded = Run::serial().with_seed(5);
    let body = solid(&(vertices.clone(), faces.clone()), 24);
    let other = generate(&body, &asked(30, 0.0), &seeded).unwrap().spheres;
    assert!((sizes(&other).0 / sizes(&one).0 - 1.0).abs() < 0.05);
}

#[test]
fn voxels_are_packed_within_their_faces() {
    let (dims, spacing) = ([12, 8, 8], [0.5, 0.5, 0.5]);
    let cells = vec![1u8; 12 * 8 * 8];
    let run = Run::serial();
    let layout = Layout { dims, spacing, origin: [1.0, 2.0, 3.0] };
    let shape = Shape::from_mask(&cells, &layout, &ImportOptions::default(), &run).unwrap();
    let body = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    // A box of 6 x 4 x 4: two rows of balls of radius 1 in each direction, three along x.
    let clump = generate(&body, &asked(12, 0.0), &run).unwrap();
    assert!(sizes(&clump.spheres).0 > 0.999, "{:?}", sizes(&clump.spheres));
    for s in &clump.spheres {
        let inside = [1.0, 2.0, 3.0].iter().zip([7.0, 6.0, 7.0]).enumerate();
        for (a, (lo, hi)) in inside {
            assert!(s.center[a] - s.radius >= lo - 1e-12 && s.center[a] + s.radius <= hi + 1e-12);
        }
    }
}

#[test]
fn deadlines_and_cancels_leave_what_there_is() {
    let body = solid(&arrays("stone", 16), 24);
    let late = Run::serial().with_deadline(0.0);
    let clump = generate(&body, &asked(20, 0.0), &late).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (20, Stopped::Deadline));
    hold(&arrays("stone", 16), &clump.spheres, 1.0, "late");
    let late = Run::serial().with_deadline(0.0);
    let least = generate(&body, &asked(5000, 0.1), &late).unwrap();
    assert!(!least.spheres.is_empty() && sizes(&least.spheres).0 >= 0.1);

    let calls = std::cell::Cell::new(0);
    let cancel_at = |n: u32| {
        calls.set(0);
        let calls = &calls;
        Run::serial().with_progress(Box::new(move |_| {
            calls.set(calls.get() + 1);
            calls.get() >= n
        }))
    };
    let early = generate(&body, &asked(20, 0.0), &cancel_at(1)).unwrap_err();
    assert!(matches!(early, Error::Cancelled(_)), "{early}");
    let count = {
        generate(&body, &asked(20, 0.0), &cancel_at(u32::MAX)).unwrap();
        calls.get()
    };
    let clump = generate(&body, &asked(20, 0.0), &cancel_at(count)).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (20, Stopped::Cancelled));
}

#[test]
fn what_it_does_not_read_is_refused() {
    let body = solid(&arrays("box", 8), 16);
    let ask = asked(5, 0.0);
    for (wrong, what) in [
        (GenerateOptions { confine: true, ..ask.clone() }, "confine"),
        (GenerateOptions { radius_offset: 0.5, ..ask.clone() }, "radius_offset"),
        (GenerateOptions { min_distance: 1.0, ..ask.clone() }, "min_distance"),
        (GenerateOptions { mismatch: 0.1, ..ask.clone() }, "mismatch"),
        (GenerateOptions { effort: Effort::Draft, ..ask.clone() }, "effort"),
        (GenerateOptions { tolerance: 0.1, ..ask.clone() }, "tolerance"),
        (GenerateOptions { coverage: 0.5, ..ask.clone() }, "coverage"),
        (GenerateOptions { spheres: 200_000, ..ask.clone() }, "200000"),
        (GenerateOptions { spheres: 0, min_radius: 1e-4, ..ask.clone() }, "100000"),
    ] {
        let error = generate(&body, &wrong, &Run::serial()).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument(_)), "{error}");
        assert!(error.to_string().contains(what), "{error}");
    }
    // A deadline alone is a criterion elsewhere.
    let run = Run::serial().with_deadline(1.0);
    let error = generate(&body, &asked(0, 0.0), &run).unwrap_err();
    assert!(error.to_string().contains("min_radius"), "{error}");
}

#[test]
fn quality_says_how_little_is_covered() {
    let body = solid(&arrays("stone", 16), 32);
    let options = GenerateOptions { quality: Some(QualityOptions::default()), ..asked(100, 0.0) };
    let q = generate(&body, &options, &Run::serial()).unwrap().quality.unwrap();
    assert!(q.coverage > 0.45 && q.coverage < 0.75 && q.overshoot < 1e-9, "{}", q.coverage);
    assert!(q.protrusion < 1e-12, "{:e}", q.protrusion);
}
