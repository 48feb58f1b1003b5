//! A clump does not depend on the unit, nor on where the body lies.

#![allow(clippy::unwrap_used)]

use morula::generate::{GenerateOptions, Method, generate};
use morula::measure::QualityOptions;
use morula::shape::{ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Clump, Run, Shape, Solid};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn clump(shape: &Shape, n: usize, min_radius: f64) -> Clump {
    let run = Run::serial();
    let options =
        SolidOptions { resolution: Resolution::CellsLongest(32), ..SolidOptions::default() };
    let solid = Solid::new(shape, &options, &run).unwrap();
    let quality = QualityOptions { columns: 128, surface: false, ..QualityOptions::default() };
    let options = GenerateOptions {
        method: Method::Mss,
        spheres: n,
        min_radius,
        quality: Some(quality),
        ..GenerateOptions::default()
    };
    generate(&solid, &options, &run).unwrap()
}

fn of_mesh(mesh: &Mesh, scale: f64, shift: [f64; 3]) -> Clump {
    let at = |v: &[f64; 3]| std::array::from_fn(|a| v[a] * scale + shift[a]);
    let vertices: Vec<[f64; 3]> = mesh.0.iter().map(at).collect();
    let run = Run::serial();
    let shape = Shape::from_mesh(&vertices, &mesh.1, &ImportOptions::default(), &run).unwrap();
    clump(&shape, 30, 0.03 * scale)
}

fn of_voxels(scale: f64, shift: [f64; 3]) -> Clump {
    let dims = [30, 26, 22];
    let cells: Vec<u8> = (0..30 * 26 * 22)
        .map(|n| {
            let q = [(n % 30) as f64 - 14.3, (n / 30 % 26) as f64 - 12.1, (n / 780) as f64 - 10.4];
            let r = (q[0] / 13.0).powi(2) + (q[1] / 11.0).powi(2) + (q[2] / 9.0).powi(2);
            u8::from(r < 1.0 && q[0] + q[1] < 12.0)
        })
        .collect();
    let spacing = [0.05 * scale, 0.05 * scale, 0.055 * scale];
    let layout = Layout { dims, spacing, origin: shift };
    let shape = Shape::from_mask(&cells, &layout, &ImportOptions::default(), &Run::serial());
    clump(&shape.unwrap(), 30, 0.03 * scale)
}

/// Most that two centres or radii differ, over the scale.
fn apart(a: &Clump, b: &Clump, scale: f64, shift: [f64; 3]) -> f64 {
    let pairs = a.spheres.iter().zip(&b.spheres);
    pairs.fold(0.0, |most: f64, (a, b)| {
        let center = (0..3).map(|i| ((a.center[i] - shift[i]) / scale - b.center[i]).abs());
        center.fold(most, f64::max).max((a.radius / scale - b.radius).abs())
    })
}

fn same(what: &str, a: &Clump, b: &Clump, scale: f64, shift: [f64; 3], slack: f64) {
    assert_eq!((a.spheres.len(), a.stopped), (b.spheres.len(), b.stopped), "{what}");
    let d = |c: &Clump| c.quality.as_ref().unwrap().mismatch;
    assert!((d(a) / d(b) - 1.0).abs() < 0.01, "{what}: {} and {}", d(a), d(b));
    let off = apart(a, b, scale, shift);
    assert!(off < slack, "{what}: spheres {off:e} apart");
}

fn meshes() -> Vec<(&'static str, Mesh)> {
    [
        Primitive::Stone { seed: 3, diameter: 1.0, roughness: 0.3 },
        Primitive::Ellipsoid { axes: [0.5, 0.35, 0.2] },
        Primitive::Box { edges: [1.0, 0.7, 0.45] },
    ]
    .map(|p| (p.name(), p.mesh(16).unwrap()))
    .into()
}

#[test]
fn any_unit_gives_the_same_clump() {
    for (name, mesh) in meshes() {
        let first = of_mesh(&mesh, 1.0, [0.0; 3]);
        for scale in [1e-9, 1e6] {
            let made = of_mesh(&mesh, scale, [0.0; 3]);
            same(&format!("{name} × {scale}"), &made, &first, scale, [0.0; 3], 1e-9);
        }
    }
    let first = of_voxels(1.0, [0.0; 3]);
    for scale in [1e-9, 1e6] {
        same("voxels", &of_voxels(scale, [0.0; 3]), &first, scale, [0.0; 3], 1e-9);
    }
}

#[test]
fn far_from_the_origin_is_the_same_clump() {
    for far in [1e3, 1e6] {
        let shift = [far, -far / 3.0, far / 7.0];
        for (name, mesh) in meshes() {
            let first = of_mesh(&mesh, 1.0, [0.0; 3]);
            let made = of_mesh(&mesh, 1.0, shift);
            same(&format!("{name} + {far}"), &made, &first, 1.0, shift, 1e-11 * far);
        }
        same("voxels", &of_voxels(1.0, shift), &of_voxels(1.0, [0.0; 3]), 1.0, shift, 1e-15 * far);
    }
}

#[test]
fn powers_of_two_change_no_bit() {
    for (name, mesh) in meshes() {
        let first = of_mesh(&mesh, 1.0, [0.0; 3]);
        for k in [-30, 20] {
            let scale = 2f64.powi(k);
            assert_eq!(
                apart(&of_mesh(&mesh, scale, [0.0; 3]), &first, scale, [0.0; 3]),
                0.0,
                "{name}"
            );
        }
    }
    let scale = 2f64.powi(-30);
    let first = of_voxels(1.0, [0.0; 3]);
    assert_eq!(apart(&of_voxels(scale, [0.0; 3]), &first, scale, [0.0; 3]), 0.0);
}
