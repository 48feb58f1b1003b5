//! From shape to solid nothing depends on the unit or on where the body lies.

#![allow(clippy::unwrap_used, clippy::expect_used)]

use morula::shape::{Bodies, ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Run, Shape, Solid};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Meshes whose coordinates are multiples of 2⁻²⁰, so that shifts by whole numbers are exact.
fn meshes() -> Vec<(&'static str, Mesh)> {
    let on_lattice = |p: Primitive, segments| {
        let (v, f) = p.mesh(segments).unwrap();
        let v = v.into_iter().map(|p| p.map(|x| (x * 1048576.0).round() / 1048576.0));
        (v.collect::<Vec<_>>(), f)
    };
    let stone = on_lattice(Primitive::Stone { seed: 3, diameter: 1.0, roughness: 0.5 }, 40);
    let ellipsoid = on_lattice(Primitive::Ellipsoid { axes: [1.0, 0.7, 0.4] }, 32);
    // Without a face: the winding number decides.
    let mut open = ellipsoid.clone();
    open.1.pop();
    // Twice, shifted: crosses itself.
    let mut crossing = ellipsoid.clone();
    let n = crossing.0.len() as u32;
    crossing.0.extend(ellipsoid.0.iter().map(|p| [p[0] + 0.75, p[1] + 0.25, p[2]]));
    crossing.1.extend(ellipsoid.1.iter().map(|f| f.map(|v| v + n)));
    vec![("stone", stone), ("open", open), ("crossing", crossing)]
}

fn solid(mesh: &Mesh, map: impl Fn([f64; 3]) -> [f64; 3]) -> Solid {
    let run = Run::serial();
    let vertices: Vec<[f64; 3]> = mesh.0.iter().map(|&p| map(p)).collect();
    let o = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    let shape = Shape::from_mesh(&vertices, &mesh.1, &o, &run).unwrap();
    let o = SolidOptions { resolution: Resolution::CellsLongest(20), ..SolidOptions::default() };
    Solid::new(&shape, &o, &run).unwrap()
}

fn same_bits(a: &Solid, b: &Solid, what: &str) {
    assert_eq!(a.grid(), b.grid(), "{what}");
    assert!(a.inside().unwrap() == b.inside().unwrap(), "{what}: the mask differs");
    assert_eq!(a.unit_moments(), b.unit_moments(), "{what}");
    let run = Run::serial();
    let (x, y) = (a.distance(&run).unwrap(), b.distance(&run).unwrap());
    assert!(x.iter().zip(y).all(|(x, y)| x.to_bits() == y.to_bits()), "{what}: distances differ");
}

#[test]
fn powers_of_two_and_exact_shifts_change_no_bit() {
    for (name, mesh) in meshes() {
        let reference = solid(&mesh, |p| p);
        for k in [-40, -7, 1, 40] {
            let s = 2f64.powi(k);
            let scaled = solid(&mesh, |p| p.map(|x| x * s));
            same_bits(&reference, &scaled, &format!("{name} times 2^{k}"));
            assert_eq!(scaled.moments().volume, reference.moments().volume * s.powi(3));
            assert_eq!(scaled.moments().inertia.xy, reference.moments().inertia.xy * s.powi(5));
        }
        let shifted = solid(&mesh, |p| [p[0] + 1e6, p[1] - 3e6, p[2] + 17.0]);
        same_bits(&reference, &shifted, &format!("{name} shifted"));
        let both = solid(&mesh, |p| [p[0] * 8.0 - 4096.0, p[1] * 8.0, p[2] * 8.0 + 256.0]);
        same_bits(&reference, &both, &format!("{name} scaled and shifted"));
    }
}

#[test]
fn any_size_and_offset_gives_the_same_solid_but_for_rounding() {
    for (name, mesh) in meshes() {
        let reference = solid(&mesh, |p| p);
        let cells: usize = reference.inside().unwrap().iter().map(|&c| usize::from(c)).sum();
        let near = |s: &Solid, scale: f64, tolerance: f64| {
            let n: usize = s.inside().unwrap().iter().map(|&c| usize::from(c)).sum();
            assert!(n.abs_diff(cells) <= cells / 100, "{name} × {scale}: {n} {cells}");
            let (a, b) = (s.moments(), reference.moments());
            let v = a.volume / (b.volume * scale.powi(3));
            assert!((v - 1.0).abs() < tolerance, "{name} × {scale}: {v}");
            let size = b.inertia.matrix().abs().max() * scale.powi(5);
            let off = (a.inertia.matrix() - b.inertia.matrix() * scale.powi(5)).abs().max() / size;
            assert!(off < tolerance, "{name} × {scale}: {off}");
        };
        // Columns meet rounded vertices a little elsewhere.
        let tolerance = if reference.unit_moments().relative_error > 0.0 { 1e-4 } else { 1e-9 };
        // Winding numbers along every column take their time.
        let scales: &[f64] =
            if name == "open" { &[1e-9, 1e9] } else { &[1e-12, 1e-9, 3e-3, 7.7, 1e9, 1e12] };
        for &scale in scales {
            near(&solid(&mesh, |p| p.map(|x| x * scale)), scale, tolerance);
        }
        let far = solid(&mesh, |p| [p[0] + 1e6 / 3.0, p[1] + 1e6 / 7.0, p[2] - 1e6 / 9.0]);
        near(&far, 1.0, tolerance.max(1e-8));
    }
}

#[test]
fn voxels_too() {
    let dims = [9, 7, 5];
    let cells: Vec<u8> = (0..315)
        .map(|c| {
            let at = [c % 9, c / 9 % 7, c / 63].map(f64::from);
            let d = [(at[0] - 4.0) / 4.5, (at[1] - 3.0) / 3.5, (at[2] - 2.0) / 2.5];
            u8::from(d.iter().map(|x| x * x).sum::<f64>() < 1.0)
        })
        .collect();
    let at = |scale: f64, origin: [f64; 3]| {
        let run = Run::serial();
        let layout = Layout { dims, spacing: [scale, scale, 1.5 * scale], origin };
        let shape = Shape::from_mask(&cells, &layout, &ImportOptions::default(), &run).unwrap();
        Solid::new(&shape, &SolidOptions::default(), &run).unwrap()
    };
    let reference = at(1.0, [0.0; 3]);
    for k in [-30, 3, 30] {
        same_bits(&reference, &at(2f64.powi(k), [0.0; 3]), "voxels scaled");
    }
    let shifted = at(1.0, [1e6, -3e6, 17.0]);
    same_bits(&reference, &shifted, "voxels shifted");
}
