//! Open meshes: lids close their openings, for the inside and for distances alike.

#![allow(clippy::unwrap_used)]

mod common;

use common::{Arrays, cube, cuboid, data, pieces, solid_of, solid_of_mesh, sphere};
use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::math::Vec3;
use morula::measure::QualityOptions;
use morula::shape::read::FileOptions;
use morula::{Clump, Run, Shape, Solid};
use std::path::Path;

/// The mesh without the faces whose corners all are where `drop` says.
fn without((vertices, faces): Arrays, drop: impl Fn(&[f64; 3]) -> bool) -> Arrays {
    let gone = |f: &[u32; 3]| f.iter().all(|&v| drop(&vertices[v as usize]));
    let faces = faces.iter().filter(|f| !gone(f)).copied().collect();
    (vertices, faces)
}

fn make(solid: &Solid, method: Method, n: usize) -> Clump {
    let options = GenerateOptions {
        method,
        spheres: n,
        effort: if method == Method::Inscribed { Effort::Draft } else { Effort::default() },
        quality: Some(QualityOptions { columns: 256, ..QualityOptions::default() }),
        ..GenerateOptions::default()
    };
    generate(solid, &options, &Run::serial()).unwrap()
}

fn has_note(solid: &Solid, text: &str) -> bool {
    solid.notes().iter().any(|n| n.contains(text))
}

#[test]
fn no_sphere_bulges_out_of_an_opening() {
    let cup = without(cube([0.0; 3], 1.0), |v| v[2] > 0.5);
    let bowl = without(sphere(24, 48, 1.0, [0.0; 3]), |v| v[2] > -1e-9);
    for (mesh, top, volume, least) in [(cup, 1.0, 1.0, 0.78), (bowl, 0.0, 2.08, 0.8)] {
        let solid = solid_of_mesh(&mesh, 48);
        let found = solid.moments();
        assert!((found.volume / volume - 1.0).abs() < 0.005, "{}", found.volume);
        assert!(found.relative_error < 1e-6, "{}", found.relative_error);
        assert!(has_note(&solid, "lids were put over 1 opening"), "{:?}", solid.notes());
        for method in [Method::Inscribed, Method::Cover, Method::Euclidean] {
            let clump = make(&solid, method, 30);
            for s in &clump.spheres {
                assert!(s.center.z + s.radius <= top + 1e-9, "{method:?}: {s:?}");
            }
            let q = clump.quality.unwrap();
            assert!(q.overshoot < 1e-9 && q.protrusion < 1e-9, "{method:?}: {q:?}");
            let enough = if method == Method::Inscribed { least } else { 0.5 };
            assert!(q.coverage > enough, "{method:?}: {}", q.coverage);
        }
    }
}

/// What reaches out of an opening is seen by the figures, and held back by the demand.
#[test]
fn protrusion_counts_beyond_the_lid() {
    let cup = without(cuboid([0.0; 3], [1.0, 1.0, 0.7]), |v| v[2] > 0.5);
    let solid = solid_of_mesh(&cup, 48);
    let mut options = GenerateOptions {
        spheres: 4,
        quality: Some(QualityOptions::default()),
        ..GenerateOptions::default()
    };
    let free = generate(&solid, &options, &Run::serial()).unwrap();
    let above = free.spheres.iter().map(|s| s.center.z + s.radius - 0.7).fold(0.0, f64::max);
    let q = free.quality.unwrap();
    assert!(above > 0.01 && q.protrusion > 0.99 * above, "{above} {q:?}");
    options.best.max_protrusion = 0.005;
    let held = generate(&solid, &options, &Run::serial()).unwrap();
    assert!(held.spheres.iter().all(|s| s.center.z + s.radius <= 0.705 + 1e-9));
}

/// The sign, the field and the tree say the same everywhere.
#[test]
fn field_and_tree_agree_at_an_opening_that_is_not_flat() {
    let tube = |v: &[f64; 3]| v[0] * v[0] + v[1] * v[1] < 0.3 && v[0].abs() > 0.2 && v[2] > 0.0;
    let cut = |v: &[f64; 3]| tube(v) || v[2] > 0.75;
    let solid = solid_of_mesh(&without(sphere(40, 80, 1.0, [0.0; 3]), cut), 40);
    assert!(has_note(&solid, "lids were put over"), "{:?}", solid.notes());
    let run = Run::serial();
    let (grid, field) = (*solid.grid(), solid.distance(&run).unwrap());
    let surface = solid.surface(&run).unwrap();
    let h = grid.spacing.x;
    let mut inside = 0;
    for k in 0..grid.dims[2] {
        for j in 0..grid.dims[1] {
            for i in 0..grid.dims[0] {
                let d = f64::from(field[grid.index(i, j, k)]);
                let exact = surface.signed_distance(&grid.center(i, j, k));
                assert!((d - exact).abs() < 0.01 * h, "{i} {j} {k}: {d} {exact}");
                inside += usize::from(d < 0.0);
            }
        }
    }
    let volume = inside as f64 * h * h * h;
    assert!((volume / solid.unit_moments().volume - 1.0).abs() < 0.01);
}

#[test]
fn what_is_not_joined_stays_as_it_is() {
    let solid = solid_of_mesh(&pieces(&sphere(16, 32, 1.0, [0.0; 3])), 32);
    assert!(has_note(&solid, "gets no lids"), "{:?}", solid.notes());
    let middle = solid.frame().to_unit(&Vec3::zeros());
    let depth = solid.surface(&Run::serial()).unwrap().signed_distance(&middle);
    assert!(depth * solid.frame().scale < -0.95);
    let closed = solid_of_mesh(&sphere(16, 32, 1.0, [0.0; 3]), 32);
    assert!(!has_note(&closed, "lid"), "{:?}", closed.notes());
}

#[test]
fn the_bunny_stands_on_its_lids() {
    let Some(data) = data() else { return };
    let options = FileOptions::default();
    let path = data.join(Path::new("benchmark/bunny.stl"));
    let shape = Shape::from_file(&path, &options, &Run::serial()).unwrap();
    let solid = solid_of(&shape, 48);
    assert!(has_note(&solid, "lids were put over 5 openings"), "{:?}", solid.notes());
    let (found, report) = (solid.moments(), &shape.report);
    assert!((found.volume / report.volume - 1.0).abs() < 1e-3 && found.relative_error < 1e-6);
    let q = make(&solid, Method::Inscribed, 30).quality.unwrap();
    assert!(q.overshoot < 1e-9 && q.protrusion < 1e-9 && q.coverage > 0.82, "{q:?}");
}
