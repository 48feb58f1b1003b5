//! Limits that a clump meets are found out and told with their figures.

#![allow(clippy::unwrap_used)]

use morula::clump::{Limit, Warning};
use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::measure::QualityOptions;
use morula::shape::{Bodies, ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Run, Shape, Solid};

fn options(spheres: usize) -> GenerateOptions {
    GenerateOptions { spheres, effort: Effort::Draft, ..GenerateOptions::default() }
}

fn solid(vertices: &[[f64; 3]], faces: &[[u32; 3]], resolution: Resolution) -> Solid {
    let import = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    let shape = Shape::from_mesh(vertices, faces, &import, &Run::serial()).unwrap();
    let options = SolidOptions { resolution, ..SolidOptions::default() };
    Solid::new(&shape, &options, &Run::serial()).unwrap()
}

fn warnings(solid: &Solid, options: &GenerateOptions) -> Vec<Warning> {
    generate(solid, options, &Run::serial()).unwrap().warnings
}

fn of(all: &[Warning], limit: Limit) -> Option<Warning> {
    let found = all.iter().find(|w| w.limit == limit).copied();
    if let Some(w) = found {
        assert!(w.to_string().len() > 10 && !w.limit.name().is_empty());
    }
    found
}

const CELLS: Resolution = Resolution::CellsLongest(32);

#[test]
fn what_is_well_has_none() {
    let (vertices, faces) =
        Primitive::Stone { seed: 3, diameter: 1.0, roughness: 0.4 }.mesh(16).unwrap();
    let body = solid(&vertices, &faces, CELLS);
    let asked = GenerateOptions { quality: Some(QualityOptions::default()), ..options(10) };
    assert_eq!(warnings(&body, &asked), []);
}

#[test]
fn fewer_spheres_than_were_asked_for() {
    let layout = Layout { dims: [1; 3], spacing: [1.0; 3], origin: [0.0; 3] };
    let run = Run::serial();
    let shape = Shape::from_mask(&[1], &layout, &ImportOptions::default(), &run).unwrap();
    let body = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let asked = GenerateOptions {
        spheres: 40,
        method: Method::SurfaceFit,
        effort: Effort::Normal,
        ..GenerateOptions::default()
    };
    let clump = generate(&body, &asked, &run).unwrap();
    let found = of(&clump.warnings, Limit::FewerSpheres).unwrap();
    assert_eq!((found.figure, found.bound), (clump.spheres.len() as f64, 40.0));
    assert!(clump.spheres.len() < 40);
}

#[test]
fn places_that_are_rounded() {
    let (mut vertices, faces) = Primitive::Box { edges: [1.0; 3] }.mesh(8).unwrap();
    assert_eq!(warnings(&solid(&vertices, &faces, CELLS), &options(4)), []);
    vertices.iter_mut().for_each(|v| v[1] += 1e9);
    let found = of(&warnings(&solid(&vertices, &faces, CELLS), &options(4)), Limit::FarAway);
    let step = 1e9f64.next_up() - 1e9;
    let found = found.unwrap();
    assert!(found.figure >= 0.5 * step && found.figure <= 2.0 * step && found.bound < 1e-8);
}

/// Two cubes that cross each other.
fn crossing() -> Solid {
    let (mut vertices, mut faces) = Primitive::Box { edges: [1.0; 3] }.mesh(8).unwrap();
    let n = vertices.len() as u32;
    faces.extend(faces.clone().iter().map(|f| f.map(|v| v + n)));
    let (s, c) = 0.5f64.sin_cos();
    let other: Vec<[f64; 3]> = vertices
        .iter()
        .map(|p| [c * p[0] - s * p[1] + 0.3, s * p[0] + c * p[1] + 0.2, p[2] + 0.1])
        .collect();
    vertices.extend(other);
    solid(&vertices, &faces, CELLS)
}

#[test]
fn a_target_and_distances_that_are_known_poorly() {
    let body = crossing();
    let coarse = QualityOptions { columns: 8, ..QualityOptions::default() };
    let asked = GenerateOptions { quality: Some(coarse), ..options(4) };
    let clump = generate(&body, &asked, &Run::serial()).unwrap();
    let q = clump.quality.unwrap();
    let off = body.moments().relative_error;
    assert!(off > 0.0);
    assert_eq!(
        of(&clump.warnings, Limit::InexactTarget).map(|w| w.figure),
        (off > 1e-4).then_some(off)
    );
    let found = of(&clump.warnings, Limit::CoarseDistance).unwrap();
    let size = (6.0 / std::f64::consts::PI * body.moments().volume).cbrt();
    assert!((found.figure / (q.distance_bound / size) - 1.0).abs() < 1e-12);
    let found = of(&clump.warnings, Limit::CoarseOverlap).unwrap();
    assert!((found.figure / (q.error_bound / q.mismatch) - 1.0).abs() < 1e-12);
    assert!(found.figure > found.bound);
}

#[test]
fn a_plate_of_one_cell() {
    let (vertices, faces) = Primitive::Box { edges: [20.0, 20.0, 1.0] }.mesh(8).unwrap();
    let body = solid(&vertices, &faces, Resolution::CellSize(0.9));
    let found = of(&warnings(&body, &options(10)), Limit::Thin).unwrap();
    let thickness = 2.0 * 400.0 / (800.0 + 80.0);
    assert!((found.figure / (thickness / 0.9) - 1.0).abs() < 1e-9 && found.bound == 1.5);
    let fine = solid(&vertices, &faces, Resolution::CellSize(0.5));
    assert_eq!(of(&warnings(&fine, &options(10)), Limit::Thin), None);
}
