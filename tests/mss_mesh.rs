//! MSS on meshes: no bias, confinement, equivariance.

#![allow(clippy::unwrap_used)]

mod common;

use common::{Arrays as Triangles, solid_of_mesh as solid, to_mesh};
use morula::generate::{GenerateOptions, Method, generate};
use morula::math::Vec3;
use morula::shape::{ImportOptions, Primitive};
use morula::solid::SolidOptions;
use morula::{Clump, Run, Shape, Solid, Sphere};

fn make(solid: &Solid, spheres: usize, confine: bool, radius_offset: f64) -> Clump {
    let options = GenerateOptions {
        method: Method::Mss,
        spheres,
        confine,
        radius_offset,
        ..GenerateOptions::default()
    };
    generate(solid, &options, &Run::serial()).unwrap()
}

#[test]
fn a_sphere_is_one_sphere_without_bias() {
    for (cells, shift) in [(24, [0.0; 3]), (41, [0.013, -0.007, 0.021]), (64, [5.0, 0.1, -0.3])] {
        let mut mesh = Primitive::Sphere { radius: 1.0 }.mesh(96).unwrap();
        for v in &mut mesh.0 {
            for (x, s) in v.iter_mut().zip(shift) {
                *x += s;
            }
        }
        let s = make(&solid(&mesh, cells), 1, false, 0.0).spheres[0];
        let cell = 2.0 / f64::from(cells);
        assert!((s.radius - 1.0).abs() < 0.1 * cell, "{cells}: radius {}", s.radius);
        let off = (s.center - Vec3::from(shift)).norm();
        assert!(off < 0.1 * cell, "{cells}: centre {off} off");
    }
}

#[test]
fn two_spheres_off_the_grid_are_found_without_bias() {
    // Unequal parts, so that neither centre lies on a cell or a mirror plane.
    let ball = Primitive::Sphere { radius: 1.0 }.mesh(64).unwrap();
    let mut mesh = ball.clone();
    let n = mesh.0.len() as u32;
    let (c, r) = (Vec3::new(1.713, 0.222, -0.131), 0.41);
    mesh.0.extend(ball.0.iter().map(|v| <[f64; 3]>::from(Vec3::from(*v) * r + c)));
    mesh.1.extend(ball.1.iter().map(|f| f.map(|i| i + n)));
    let run = Run::serial();
    let options = ImportOptions { bodies: morula::shape::Bodies::All, ..ImportOptions::default() };
    let shape = Shape::from_mesh(&mesh.0, &mesh.1, &options, &run).unwrap();
    let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let clump = make(&solid, 2, false, 0.0);
    let cell = 3.2 / 64.0;
    for (center, radius) in [(Vec3::zeros(), 1.0), (c, r)] {
        let near = |s: &&Sphere| (s.center - center).norm() < 0.25 * cell;
        let s = clump.spheres.iter().find(near).unwrap();
        assert!((s.radius - radius).abs() < 0.25 * cell, "{s:?}");
    }
}

/// A cube with a slot of the given width, from the top down to a third of its height.
fn slotted(width: f64) -> Triangles {
    let (xs, ys) = ([0.0, 0.5 - width / 2.0, 0.5 + width / 2.0, 1.0], [0.0, 0.3, 1.0]);
    let at = |i: usize, j: usize, top: usize| (i + 4 * (j + 3 * top)) as u32;
    let mut mesh = Triangles::default();
    for n in 0..24 {
        mesh.0.push([xs[n % 4], ys[n / 4 % 3], (n / 12) as f64]);
    }
    let solid = |i: i32, j: i32| (0..3).contains(&i) && (0..2).contains(&j) && (i, j) != (1, 1);
    let mut quad = |q: [u32; 4]| mesh.1.extend([[q[0], q[1], q[2]], [q[0], q[2], q[3]]]);
    for (i, j) in (0..6).map(|n| (n % 3, n / 3)).filter(|(i, j)| solid(*i, *j)) {
        let (a, b) = (i as usize, j as usize);
        let ring = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)];
        quad(ring.map(|(x, y)| at(x, y, 1)));
        quad([3, 2, 1, 0].map(|n| at(ring[n].0, ring[n].1, 0)));
        for (n, (di, dj)) in [(0, -1), (1, 0), (0, 1), (-1, 0)].into_iter().enumerate() {
            if !solid(i + di, j + dj) {
                let (p, q) = (ring[n], ring[(n + 1) % 4]);
                quad([at(p.0, p.1, 0), at(q.0, q.1, 0), at(q.0, q.1, 1), at(p.0, p.1, 1)]);
            }
        }
    }
    mesh
}

#[test]
fn a_slot_finer_than_the_cells_still_bounds_the_radii() {
    let mesh = slotted(0.004);
    let solid = solid(&mesh, 24);
    // No cell shows the slot.
    let full = solid.inside().unwrap().iter().filter(|c| **c != 0).count();
    assert_eq!(full, 24 * 24 * 24);
    let clump = make(&solid, 30, false, 0.0);
    assert_eq!(clump.spheres.len(), 30);
    let surface = solid.surface(&Run::serial()).unwrap();
    for s in &clump.spheres {
        let d = to_mesh(&s.center, &mesh);
        assert!((s.radius - d).abs() < 1e-9, "{s:?} is {d} deep");
        assert!(surface.contains(&solid.frame().to_unit(&s.center)), "{s:?}");
    }
    assert!(clump.counters.exact_distances > 0);
}

#[test]
fn surfaces_within_the_solid_bound_nothing() {
    let ball = Primitive::Sphere { radius: 1.0 }.mesh(32).unwrap();
    let mut mesh = ball.clone();
    mesh.0.extend(ball.0.iter().map(|v| v.map(|x| 0.4 * x)));
    mesh.1.extend(ball.1.iter().map(|f| f.map(|i| i + ball.0.len() as u32)));
    let s = make(&solid(&mesh, 24), 1, false, 0.0).spheres[0];
    assert!((s.radius - 1.0).abs() < 0.05, "{s:?}");
}

#[test]
fn confined_spheres_stay_within_the_triangles() {
    let shapes = [
        Primitive::Stone { seed: 5, diameter: 1.0, roughness: 0.5 },
        Primitive::Box { edges: [1.0, 0.7, 0.4] },
        Primitive::Cone { radius: 0.5, height: 1.1 },
    ];
    for p in shapes {
        let mesh = p.mesh(12).unwrap();
        let solid = solid(&mesh, 32);
        for offset in [0.0, 1.5] {
            let clump = make(&solid, 40, true, offset);
            assert!(clump.spheres.len() == 40 || !clump.note.is_empty());
            for s in &clump.spheres {
                let d = to_mesh(&s.center, &mesh);
                assert!(s.radius <= d + 1e-12, "{}: {} and {d}", p.name(), s.radius);
                let unit = solid.frame().to_unit(&s.center);
                assert!(solid.surface(&Run::serial()).unwrap().contains(&unit));
            }
        }
    }
}

#[test]
fn powers_of_two_and_exact_shifts_give_the_same_clump() {
    let mesh = Primitive::Stone { seed: 3, diameter: 1.0, roughness: 0.3 }.mesh(10).unwrap();
    // Coordinates in multiples of 2⁻²⁰, so that shifts are exact.
    let round = |x: f64| (x * 1048576.0).round() / 1048576.0;
    let base: Triangles = (mesh.0.iter().map(|v| v.map(round)).collect(), mesh.1.clone());
    let first = make(&solid(&base, 32), 25, false, 0.0).spheres;
    for (scale, shift) in [(1024.0, 0.0), (2f64.powi(-30), 0.0), (1.0, 4096.0)] {
        let moved: Triangles =
            (base.0.iter().map(|v| v.map(|x| x * scale + shift)).collect(), base.1.clone());
        let made = make(&solid(&moved, 32), 25, false, 0.0).spheres;
        assert_eq!(made.len(), first.len());
        for (a, b) in made.iter().zip(&first) {
            let back = (a.center - Vec3::repeat(shift)) / scale;
            // Without a shift no bit differs.
            let slack = if shift == 0.0 { 0.0 } else { 4.0 * f64::EPSILON * (1.0 + shift / scale) };
            assert!((back - b.center).norm() <= slack, "{back} and {}", b.center);
            assert_eq!(a.radius / scale, b.radius);
        }
    }
}

#[test]
fn a_mirror_symmetric_mesh_has_a_mirror_symmetric_clump() {
    let mesh = Primitive::Torus { major: 1.0, minor: 0.4 }.mesh(48).unwrap();
    let spheres = make(&solid(&mesh, 48), 40, false, 0.0).spheres;
    let symmetric = |part: &[Sphere]| {
        (0..3).all(|a| {
            part.iter().all(|s| {
                let mut image = s.center;
                image[a] = -image[a];
                part.iter()
                    .any(|t| (t.center - image).norm() < 1e-9 && (t.radius - s.radius).abs() < 1e-6)
            })
        })
    };
    assert!((33..=40).any(|n| n <= spheres.len() && symmetric(&spheres[..n])));
}
