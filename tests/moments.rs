//! Moments against formulas, brute force and the figures of others.

#![allow(clippy::unwrap_used, clippy::expect_used)]

mod common;

use morula::math::{Inertia, Moments, Vec3};
use morula::shape::read::FileOptions;
use morula::shape::{Bodies, Body, ImportOptions, Mesh, Primitive, Voxels};
use morula::solid::moments::moments;
use morula::solid::winding::Winding;
use morula::{Error, Run, Shape};
use proptest::prelude::*;

fn of(mesh: &Mesh) -> Moments {
    moments(&Body::Mesh(mesh.clone()), &Run::serial()).unwrap()
}

fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> Mesh {
    let (vertices, faces) = common::cuboid(lo, hi);
    Mesh { vertices: vertices.into_iter().map(Vec3::from).collect(), faces, clean: true }
}

fn joined(a: &Mesh, b: &Mesh) -> Mesh {
    let n = a.vertices.len() as u32;
    let mut m = a.clone();
    m.vertices.extend(&b.vertices);
    m.faces.extend(b.faces.iter().map(|f| f.map(|v| v + n)));
    m
}

fn inward(mut m: Mesh) -> Mesh {
    m.faces.iter_mut().for_each(|f| f.swap(1, 2));
    m
}

/// The formula for a box.
fn cuboid_moments(lo: [f64; 3], hi: [f64; 3]) -> Moments {
    let e: [f64; 3] = std::array::from_fn(|a| hi[a] - lo[a]);
    let volume = e[0] * e[1] * e[2];
    let square = |a: usize| volume * e[a] * e[a] / 12.0;
    Moments {
        volume,
        centroid: Vec3::from_fn(|a, _| 0.5 * (lo[a] + hi[a])),
        inertia: Inertia::from_second_moments([square(0), square(1), square(2), 0., 0., 0.]),
        relative_error: 0.0,
    }
}

/// The sum of bodies with signs.
fn combined(parts: &[(f64, Moments)]) -> Moments {
    let volume: f64 = parts.iter().map(|(s, m)| s * m.volume).sum();
    let centroid = parts.iter().map(|(s, m)| m.centroid * (s * m.volume)).sum::<Vec3>() / volume;
    let tensor = parts
        .iter()
        .map(|(s, m)| m.inertia.shifted(m.volume, &(m.centroid - centroid)).matrix() * *s)
        .fold(nalgebra::Matrix3::zeros(), |a, b| a + b);
    Moments { volume, centroid, inertia: Inertia::from_matrix(&tensor), relative_error: 0.0 }
}

fn agree(found: &Moments, expected: &Moments, tolerance: f64) {
    let v = expected.volume;
    assert!((found.volume / v - 1.0).abs() <= tolerance, "{found:?} {expected:?}");
    let size = v.cbrt();
    let off = (found.centroid - expected.centroid).abs().max();
    assert!(off <= tolerance * size, "centroid off by {off}");
    let (a, b) = (found.inertia.matrix(), expected.inertia.matrix());
    let off = (a - b).abs().max();
    assert!(off <= tolerance * b.abs().max(), "inertia off by {off}: {a} {b}");
}

#[test]
fn boxes_are_exact() {
    for (lo, hi) in [
        ([0.0; 3], [1.0; 3]),
        ([0.1, 0.2, 0.3], [0.9, 0.5, 0.4]),
        ([0.0; 3], [1.0, 1.0, 0.01]),
        ([0.0; 3], [1.0, 0.01, 0.01]),
    ] {
        let m = of(&cuboid(lo, hi));
        agree(&m, &cuboid_moments(lo, hi), 1e-14);
        assert_eq!(m.relative_error, 0.0);
    }
}

#[test]
fn a_tetrahedron_is_exact() {
    let mesh = Mesh {
        vertices: vec![Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()],
        faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        clean: true,
    };
    let m = of(&mesh);
    // About the origin ∫x² = 1/60 and ∫xy = 1/120; about the centroid less V/16.
    let (x2, xy) = (1.0 / 60.0 - 1.0 / 96.0, 1.0 / 120.0 - 1.0 / 96.0);
    let expected = Moments {
        volume: 1.0 / 6.0,
        centroid: Vec3::repeat(0.25),
        inertia: Inertia::from_second_moments([x2, x2, x2, xy, xy, xy]),
        relative_error: 0.0,
    };
    agree(&m, &expected, 1e-14);
    // The sign of products: this body leans to x + y + z = const, so ∫xy < 0 and I_xy > 0.
    assert!(m.inertia.xy > 0.0);
}

#[test]
fn analytic_particles_in_the_limit() {
    for name in Primitive::NAMES {
        let p = Primitive::from_name(name).unwrap();
        let Some(expected) = p.moments() else { continue };
        let at = |segments| {
            let o = ImportOptions::default();
            let s = Shape::from_primitive(&p, segments, &o, &Run::serial()).unwrap();
            s.frame.moments_to_input(&moments(&s.body, &Run::serial()).unwrap())
        };
        agree(&at(160), &expected, 6e-3);
        let errors = [40, 160].map(|n| (at(n).volume / expected.volume - 1.0).abs());
        // Second order: a sixteenth at four times the segments.
        assert!(errors[1] < 1e-9 || errors[1] < errors[0] / 8.0, "{name}: {errors:?}");
    }
}

#[test]
fn far_from_the_origin_nothing_cancels() {
    let o = ImportOptions::default();
    let (vertices, faces) = Primitive::Ellipsoid { axes: [1.0, 0.75, 0.5] }.mesh(32).unwrap();
    // On a lattice of 2⁻²⁰, so that the shift is exact.
    let near: Vec<[f64; 3]> =
        vertices.iter().map(|v| v.map(|x| (x * 1048576.0).round() / 1048576.0)).collect();
    let far: Vec<[f64; 3]> = near.iter().map(|v| [v[0] + 1e6, v[1] - 2e6, v[2] + 3e6]).collect();
    let [a, b] = [&near, &far].map(|v| {
        let s = Shape::from_mesh(v, &faces, &o, &Run::serial()).unwrap();
        moments(&s.body, &Run::serial()).unwrap()
    });
    assert_eq!(a, b);
}

#[test]
fn a_cavity_is_void_and_a_body_within_a_body_is_filled() {
    let (lo, hi) = ([0.0; 3], [1.0, 0.8, 0.6]);
    let (l, h) = ([0.2, 0.3, 0.1], [0.7, 0.5, 0.4]);
    let shell = joined(&cuboid(lo, hi), &inward(cuboid(l, h)));
    let m = of(&shell);
    let expected = combined(&[(1.0, cuboid_moments(lo, hi)), (-1.0, cuboid_moments(l, h))]);
    agree(&m, &expected, 1e-14);
    assert_eq!(m.relative_error, 0.0);
    let filled = of(&joined(&cuboid(lo, hi), &cuboid(l, h)));
    assert!(filled.relative_error > 0.0 && filled.relative_error < 2e-3);
    agree(&filled, &cuboid_moments(lo, hi), filled.relative_error);
}

#[test]
fn bodies_that_cross_are_integrated_once() {
    let (a, b) = (([0.0; 3], [0.6, 0.7, 0.8]), ([0.37, 0.31, 0.2], [1.0, 0.9, 0.7]));
    let common = ([0.37, 0.31, 0.2], [0.6, 0.7, 0.7]);
    let m = of(&joined(&cuboid(a.0, a.1), &cuboid(b.0, b.1)));
    let expected = combined(&[
        (1.0, cuboid_moments(a.0, a.1)),
        (1.0, cuboid_moments(b.0, b.1)),
        (-1.0, cuboid_moments(common.0, common.1)),
    ]);
    assert!(m.relative_error > 0.0 && m.relative_error < 5e-3, "{}", m.relative_error);
    agree(&m, &expected, m.relative_error);
}

#[test]
fn a_long_thin_overlap_does_not_slip_through() {
    // Two bars that cross along an edge of each, 0.003 wide both ways.
    let (a, b) = (([0.0; 3], [0.5, 0.5, 1.0]), ([0.497, 0.497, 0.0], [1.0; 3]));
    let m = of(&joined(&cuboid(a.0, a.1), &cuboid(b.0, b.1)));
    let expected = combined(&[
        (1.0, cuboid_moments(a.0, a.1)),
        (1.0, cuboid_moments(b.0, b.1)),
        (-1.0, cuboid_moments([0.497, 0.497, 0.0], [0.5, 0.5, 1.0])),
    ]);
    assert!(m.relative_error > 0.0 && m.relative_error < 1e-3, "{}", m.relative_error);
    agree(&m, &expected, m.relative_error);
}

#[test]
fn spheres_that_cross_have_the_volume_of_their_union() {
    let o = ImportOptions::default();
    let sphere = Primitive::Sphere { radius: 0.25 };
    let s = Shape::from_primitive(&sphere, 96, &o, &Run::serial()).unwrap();
    let Body::Mesh(unit) = &*s.body else { unreachable!() };
    let scale = s.frame.scale;
    let at = |c: Vec3| {
        let mut m = unit.clone();
        m.vertices.iter_mut().for_each(|v| *v = *v * scale + c);
        m
    };
    let gap = 0.2f64;
    let m = of(&joined(&at(Vec3::zeros()), &at(Vec3::new(0.0, gap, 0.0))));
    let r = 0.25f64;
    let lens = std::f64::consts::PI * (4.0 * r + gap) * (2.0 * r - gap).powi(2) / 12.0;
    let union = 2.0 * sphere.volume() - lens;
    // The inscribed mesh itself lacks about 1e-3.
    let mesh = moments(&s.body, &Run::serial()).unwrap().volume * scale.powi(3);
    let lacks = 1.0 - mesh / sphere.volume();
    assert!(lacks > 0.0 && lacks < 3e-3);
    let error = m.volume / union - 1.0;
    assert!(error.abs() < 2.0 * lacks + m.relative_error, "{error} {lacks} {}", m.relative_error);
    assert!(m.relative_error > 0.0 && m.relative_error < 1e-3);
}

trait Volume {
    fn volume(&self) -> f64;
}

impl Volume for Primitive {
    fn volume(&self) -> f64 {
        self.moments().unwrap().volume
    }
}

#[test]
fn an_open_mesh_has_the_moments_of_its_winding_number() {
    let mut mesh = cuboid([0.0; 3], [1.0, 0.8, 0.6]);
    // Without its top and one half of a side.
    mesh.faces = mesh
        .faces
        .iter()
        .enumerate()
        .filter(|(i, _)| ![2, 3, 11].contains(i))
        .map(|(_, f)| *f)
        .collect();
    mesh.clean = false;
    // Joined, they get a lid over the bent rim: not the same surface, but near it.
    let lidded = of(&mesh);
    mesh.vertices = mesh.faces.iter().flatten().map(|&v| mesh.vertices[v as usize]).collect();
    mesh.faces = (0..mesh.faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let m = of(&mesh);
    let w = Winding::new(&mesh).unwrap();
    // Brute force: the winding number at the centres of 40³ cells.
    let n = 40;
    let mut cells = vec![0u8; n * n * n];
    for (c, cell) in cells.iter_mut().enumerate() {
        let i = [c % n, c / n % n, c / n / n].map(|i| (i as f64 + 0.5) / n as f64);
        *cell = u8::from(w.exact(&Vec3::new(i[0], 0.8 * i[1], 0.6 * i[2])) > 0.5);
    }
    let spacing = Vec3::new(1.0, 0.8, 0.6) / n as f64;
    let voxels = Body::Voxels(Voxels { dims: [n; 3], spacing, cells });
    let brute = moments(&voxels, &Run::serial()).unwrap();
    assert!(m.relative_error > 0.0);
    assert!((m.volume / brute.volume - 1.0).abs() < 5e-3, "{} {}", m.volume, brute.volume);
    agree(&m, &brute, 0.02);
    assert!(lidded.relative_error == 0.0 && (lidded.volume / brute.volume - 1.0).abs() < 0.05);
}

#[test]
fn cells_have_their_own_inertia() {
    let dims = [3, 4, 5];
    let spacing = Vec3::new(0.1, 0.05, 0.2);
    let cells: Vec<u8> = (0..60).map(|i| u8::from(i * 7 % 5 < 3)).collect();
    let mut parts = Vec::new();
    for (c, _) in cells.iter().enumerate().filter(|(_, s)| **s != 0) {
        let at = [c % 3, c / 3 % 4, c / 12];
        let lo: [f64; 3] = std::array::from_fn(|a| at[a] as f64 * spacing[a]);
        let hi: [f64; 3] = std::array::from_fn(|a| lo[a] + spacing[a]);
        parts.push((1.0, cuboid_moments(lo, hi)));
    }
    let found = moments(&Body::Voxels(Voxels { dims, spacing, cells }), &Run::serial()).unwrap();
    agree(&found, &combined(&parts), 1e-13);
    // A full array is a box.
    let full = Voxels { dims, spacing, cells: vec![1; 60] };
    let found = moments(&Body::Voxels(full), &Run::serial()).unwrap();
    agree(&found, &cuboid_moments([0.0; 3], [0.3, 0.2, 1.0]), 1e-13);
}

#[test]
fn shapes_without_volume_are_refused() {
    let refused = |m: &Mesh| moments(&Body::Mesh(m.clone()), &Run::serial()).unwrap_err();
    assert!(matches!(refused(&Mesh::default()), Error::Empty(_)));
    let flat = cuboid([0.0; 3], [1.0, 1.0, 0.0]);
    assert!(matches!(refused(&flat), Error::ZeroVolume(_)));
    let two_sided = joined(&cuboid([0.0; 3], [1.0; 3]), &inward(cuboid([0.0; 3], [1.0; 3])));
    assert!(matches!(refused(&two_sided), Error::ZeroVolume(_)));
    let mut sheet = cuboid([0.0; 3], [1.0; 3]);
    sheet.faces.truncate(2);
    sheet.faces.push([3, 5, 7]);
    sheet.clean = false;
    assert!(matches!(refused(&sheet), Error::OpenSurface(_) | Error::ZeroVolume(_)));
    let none = Voxels { dims: [2; 3], spacing: Vec3::repeat(0.5), cells: vec![0; 8] };
    let e = moments(&Body::Voxels(none), &Run::serial()).unwrap_err();
    assert!(matches!(e, Error::Empty(_)));
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let o = ImportOptions::default();
    let stone = Primitive::from_name("stone").unwrap();
    let s = Shape::from_primitive(&stone, 120, &o, &Run::serial()).unwrap();
    let one = moments(&s.body, &Run::serial()).unwrap();
    for threads in [2, 3] {
        assert_eq!(one, moments(&s.body, &Run::new(threads).unwrap()).unwrap());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn a_turned_body_has_the_turned_tensor(
        corners in prop::array::uniform4(prop::array::uniform3(0.0..1.0f64)),
        angles in prop::array::uniform3(-3.0..3.0f64),
    ) {
        let mut v = corners.map(Vec3::from);
        let det = (v[1] - v[0]).dot(&(v[2] - v[0]).cross(&(v[3] - v[0])));
        prop_assume!(det.abs() > 1e-3);
        if det < 0.0 {
            v.swap(1, 2);
        }
        let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        let mesh = Mesh { vertices: v.to_vec(), faces, clean: true };
        let r = nalgebra::Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
        let mut turned = mesh.clone();
        turned.vertices.iter_mut().for_each(|p| *p = r * *p);
        let (a, b) = (of(&mesh), of(&turned));
        let r = r.into_inner();
        let expected = Moments {
            volume: det.abs() / 6.0,
            centroid: r * a.centroid,
            inertia: Inertia::from_matrix(&(r * a.inertia.matrix() * r.transpose())),
            relative_error: 0.0,
        };
        agree(&b, &expected, 1e-12);
    }
}

/// The columns of a CSV file without quotes before those asked for.
fn table(path: &std::path::Path, columns: &[&str]) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    let at: Vec<usize> =
        columns.iter().map(|c| head.iter().position(|h| h == c).unwrap()).collect();
    lines
        .map(|l| {
            let cells: Vec<&str> = l.split(',').collect();
            at.iter().map(|&i| cells.get(i).copied().unwrap_or("").to_string()).collect()
        })
        .collect()
}

#[test]
fn real_particles_have_the_volumes_that_others_found() {
    let Some(data) = common::data() else { return };
    let mut options = FileOptions::default();
    options.import.bodies = Bodies::All;
    let volume = |path: &str| {
        let s = Shape::from_file(&data.join(path), &options, &Run::serial()).unwrap();
        s.frame.moments_to_input(&moments(&s.body, &Run::serial()).unwrap())
    };
    let columns = ["path", "class", "watertight", "self_intersecting_pairs", "signed_volume"];
    let mut seen = 0;
    for row in table(&data.join("MANIFEST.csv"), &columns) {
        let [path, class, tight, crossing, signed] = &row[..] else { unreachable!() };
        let Ok(signed) = signed.parse::<f64>() else { continue };
        let particle = path.starts_with("particles/") && class == "A";
        if !particle || tight != "True" || crossing != "0" {
            continue;
        }
        let m = volume(path);
        seen += 1;
        assert!((m.volume / signed - 1.0).abs() < 1e-6, "{path}: {} {signed}", m.volume);
        assert_eq!(m.relative_error, 0.0, "{path}");
    }
    assert!(seen >= 5, "{seen}");
    for row in table(&data.join("nist_reference.csv"), &["path", "volume_um3"]) {
        let Ok(nist) = row[1].parse::<f64>() else { continue };
        let v = volume(&row[0]).volume;
        // The meshes are inscribed: up to 0.7 % low.
        assert!((v / nist - 1.0).abs() < 0.01, "{}: {v} {nist}", row[0]);
    }
}
