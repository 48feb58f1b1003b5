//! Distance fields against brute force.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod common;

use common::{cube, solid_of, to_triangle, winding};
use morula::math::Vec3;
use morula::shape::{Bodies, Body, ImportOptions, Layout, Primitive, Shape};
use morula::solid::{Resolution, Solid, SolidOptions};
use morula::{Result, Run};

fn options(resolution: Resolution) -> SolidOptions {
    SolidOptions { resolution, ..SolidOptions::default() }
}

fn any_body() -> ImportOptions {
    ImportOptions { bodies: Bodies::All, ..ImportOptions::default() }
}

/// Greatest error in cells over the whole field, and the number of wrong signs of cell
/// centres farther than a millionth of a cell from the surface.
fn errors(solid: &Solid, step: usize) -> (f64, usize) {
    let Body::Mesh(mesh) = solid.body() else { panic!("not a mesh") };
    let faces: Vec<_> = (0..mesh.faces.len()).map(|i| mesh.corners(i)).collect();
    let grid = solid.grid();
    let field = solid.distance(&Run::serial()).unwrap();
    assert_eq!(field.len(), grid.len());
    let h = grid.spacing.min();
    let (mut worst, mut signs) = (0.0f64, 0);
    for at in (0..grid.len()).step_by(step) {
        let [nx, ny, _] = grid.dims;
        let p = grid.center(at % nx, at / nx % ny, at / nx / ny);
        let exact = faces.iter().map(|t| to_triangle(&p, t)).fold(f64::MAX, f64::min);
        let d = f64::from(field[at]);
        worst = worst.max((exact - d.abs()).abs() / h);
        if exact > 1e-6 * h && (d < 0.0) != (winding(&faces, &p) > 0.5) {
            signs += 1;
        }
    }
    (worst, signs)
}

fn check(name: &str, shape: &Shape, cells: u32, step: usize) {
    let (worst, signs) = errors(&solid_of(shape, cells), step);
    assert!(worst <= 0.01, "{name} at {cells} cells: {worst} cells off");
    assert_eq!(signs, 0, "{name} at {cells} cells");
}

fn primitive(name: &str, segments: usize) -> Shape {
    let p = Primitive::from_name(name).unwrap();
    Shape::from_primitive(&p, segments, &ImportOptions::default(), &Run::serial()).unwrap()
}

#[test]
fn every_primitive_is_within_a_hundredth_of_a_cell() {
    for name in Primitive::NAMES {
        check(name, &primitive(name, 12), 16, 3);
        check(name, &primitive(name, 24), 40, 97);
    }
}

/// Grids that are cut by clusters of features, with faces smaller than a cell and larger.
#[test]
fn large_grids_are_too() {
    check("stone", &primitive("stone", 60), 60, 1999);
    check("torus", &primitive("torus", 40), 100, 2999);
    check("cone", &primitive("cone", 12), 180, 9973);
    check("box", &primitive("box", 8), 130, 4999);
}

#[test]
fn thin_and_sharp_shapes_are_too() {
    let run = Run::serial();
    let make = |p: Primitive| Shape::from_primitive(&p, 20, &any_body(), &run).unwrap();
    check("plate", &make(Primitive::Box { edges: [1.0, 0.8, 0.03] }), 24, 5);
    check("needle", &make(Primitive::Cone { radius: 0.05, height: 1.0 }), 40, 3);
    check("ring", &make(Primitive::Torus { major: 1.0, minor: 0.04 }), 40, 31);
    check("disk", &make(Primitive::Ellipsoid { axes: [1.0, 1.0, 0.05] }), 32, 17);
}

#[test]
fn a_tetrahedron_with_large_faces_is_exact_in_every_cell() {
    let v = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.2, 0.9, 0.1], [0.3, 0.2, 0.8]];
    let f = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let shape = Shape::from_mesh(&v, &f, &ImportOptions::default(), &Run::serial()).unwrap();
    check("tetrahedron", &shape, 30, 1);
}

/// A box whose top has slivers with their tips on the rim, along planes of cell centres: a
/// prism with slack runs far beyond a sharp tip. Every cell.
#[test]
fn slivers_do_not_reach_beyond_their_tips() {
    for width in [0.003, 0.0003, 0.00003] {
        // Corners of the box, 31 cells long; the tip T on the rim of the top; A and B within it.
        let (l, w) = (31.0, 11.0);
        let v: Vec<[f64; 3]> = vec![
            [0.0, 0.0, 0.0],
            [l, 0.0, 0.0],
            [l, w, 0.0],
            [0.0, w, 0.0],
            [0.0, 0.0, w],
            [l, 0.0, w],
            [l, w, w],
            [0.0, w, w],
            [0.0, 5.5, w],
            [30.0, 5.5, w],
            [30.0, 5.5 + width, w],
        ];
        let f: Vec<[u32; 3]> = vec![
            [0, 2, 1],
            [0, 3, 2],
            [0, 1, 5],
            [0, 5, 4],
            [1, 2, 6],
            [1, 6, 5],
            [2, 3, 7],
            [2, 7, 6],
            [0, 4, 8],
            [0, 8, 3],
            [3, 8, 7],
            [8, 9, 10],
            [8, 4, 9],
            [4, 5, 9],
            [5, 10, 9],
            [5, 6, 10],
            [6, 7, 10],
            [7, 8, 10],
        ];
        let options = ImportOptions { weld_tolerance: 0.0, ..any_body() };
        let shape = Shape::from_mesh(&v, &f, &options, &Run::serial()).unwrap();
        assert_eq!(shape.report.faces, 18, "{width}");
        check(&format!("sliver of {width}"), &shape, 31, 1);
    }
}

/// A box with a face left out, two boxes across each other, a box within a box: defective or
/// not simply nested, the sign is that of the winding number.
#[test]
fn defective_meshes_follow_the_winding_number() {
    let run = Run::serial();
    let (mut v, mut f) = cube([0.0; 3], 1.0);
    let (w, g) = cube([0.53, 0.41, 0.37], 1.0);
    v.extend(w);
    f.extend(g.iter().map(|t| t.map(|i| i + 8)));
    let crossing = Shape::from_mesh(&v, &f, &any_body(), &run).unwrap();
    check("crossing boxes", &crossing, 24, 3);

    let (v, mut f) = cube([0.0; 3], 1.0);
    f.pop();
    let open = Shape::from_mesh(&v, &f, &any_body(), &run).unwrap();
    let (worst, signs) = errors(&solid_of(&open, 20), 1);
    assert!(worst <= 0.01);
    // The hierarchical winding number may differ where it is ½ itself.
    assert!(signs <= 20, "{signs}");
}

#[test]
fn fields_are_the_same_bytes_for_any_threads_and_scale_exactly() {
    let stone = primitive("stone", 30);
    let field = |shape: &Shape, threads: usize| {
        let run = Run::new(threads).unwrap();
        let solid = Solid::new(shape, &options(Resolution::CellsLongest(70)), &run).unwrap();
        solid.distance(&run).unwrap().iter().map(|d| d.to_bits()).collect::<Vec<_>>()
    };
    let one = field(&stone, 1);
    assert!(one == field(&stone, 2) && one == field(&stone, 8));

    let p = Primitive::from_name("stone").unwrap();
    let (vertices, faces) = p.mesh(30).unwrap();
    let scaled: Vec<_> = vertices.iter().map(|v| v.map(|c| c * 1024.0)).collect();
    let large =
        Shape::from_mesh(&scaled, &faces, &ImportOptions::default(), &Run::serial()).unwrap();
    assert!(one == field(&large, 1));

    let ball = voxel_ball(9.3, [1.0, 1.2, 0.9]).unwrap();
    let one = field(&ball, 1);
    assert!(one == field(&ball, 2) && one == field(&ball, 8));
}

#[test]
fn a_cancel_is_honoured() {
    let solid = solid_of(&primitive("box", 12), 16);
    let run = Run::serial().with_progress(Box::new(|_| true));
    assert_eq!(solid.distance(&run).unwrap_err().status(), 15);
}

/// Cells whose centres lie in a ball; spacing as given, radius in its first.
fn voxel_ball(radius: f64, spacing: [f64; 3]) -> Result<Shape> {
    let n = spacing.map(|s| (2.0 * radius / s).ceil() as usize + 3);
    let mut mask = vec![0u8; n[0] * n[1] * n[2]];
    for (i, m) in mask.iter_mut().enumerate() {
        let c = [i % n[0], i / n[0] % n[1], i / n[0] / n[1]];
        let r2: f64 = (0..3)
            // Off the lattice, so that nothing is symmetric.
            .map(|a| ((c[a] as f64 + 0.5 - 0.5 * n[a] as f64) * spacing[a] - 0.13).powi(2))
            .sum();
        *m = u8::from(r2 < radius * radius);
    }
    let layout = Layout { dims: n, spacing, origin: [0.0; 3] };
    Shape::from_mask(&mask, &layout, &ImportOptions::default(), &Run::serial())
}

#[test]
fn planes_of_voxels_are_exact() {
    for spacing in [[1.0; 3], [0.7, 1.0, 1.6]] {
        let dims = [12, 9, 7];
        let layout = Layout { dims, spacing, origin: [3.0, -2.0, 1.0] };
        let mask = vec![1; 12 * 9 * 7];
        let run = Run::serial();
        let shape = Shape::from_mask(&mask, &layout, &ImportOptions::default(), &run).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        let field = solid.distance(&run).unwrap();
        let grid = solid.grid();
        let scale = solid.frame().scale;
        let hi = Vec3::new(12.0, 9.0, 7.0).component_mul(&Vec3::from(spacing));
        for k in 0..grid.dims[2] {
            for j in 0..grid.dims[1] {
                for i in 0..grid.dims[0] {
                    let d = f64::from(field[grid.index(i, j, k)]) * scale;
                    let p = grid.center(i, j, k) * scale;
                    let depth = (0..3).map(|a| p[a].min(hi[a] - p[a])).fold(f64::MAX, f64::min);
                    let outside: Vec<_> =
                        (0..3).map(|a| (-p[a]).max(p[a] - hi[a]).max(0.0)).collect();
                    // Inside, and outside over a face: exact. (With unequal spacing, the nearest
                    // centre of the other side is that over the nearest face only if no other
                    // face is about as near: up to half the difference of the spacings off.)
                    // Beyond edges and corners: up to a cell's half diagonal too far.
                    if depth > 0.0 {
                        let slack = if spacing[0] == spacing[2] { 1e-5 } else { 0.45 };
                        assert!((d + depth).abs() < slack, "{d} at depth {depth}");
                    } else if outside.iter().filter(|&&o| o > 0.0).count() == 1 {
                        assert!((d - outside.iter().sum::<f64>()).abs() < 1e-5);
                    } else {
                        let exact = outside.iter().map(|o| o * o).sum::<f64>().sqrt();
                        let half: f64 = spacing.iter().map(|s| s * s).sum::<f64>().sqrt() * 0.5;
                        assert!((d - exact).abs() < half, "{d} for {exact}");
                    }
                }
            }
        }
    }
}

/// Against the ideal ball: next to no bias inside, where spheres take their radii from.
#[test]
fn balls_of_voxels_are_nearly_unbiased() {
    let run = Run::serial();
    for radius in [4.0, 8.0, 16.0, 32.0] {
        let shape = voxel_ball(radius, [1.0; 3]).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        let field = solid.distance(&run).unwrap();
        let grid = solid.grid();
        let centre = solid.moments().centroid;
        let (mut sum, mut sum2, mut worst) = ([0.0; 2], [0.0; 2], 0.0f64);
        let mut n = [0.0; 2];
        for (at, &d) in field.iter().enumerate() {
            let [nx, ny, _] = grid.dims;
            let p = grid.center(at % nx, at / nx % ny, at / nx / ny);
            let exact = (solid.frame().to_input(&p) - centre).norm() - radius;
            let d = f64::from(d) * solid.frame().scale;
            let side = usize::from(d > 0.0);
            // In size: too deep inside and too far outside are positive.
            let e = if side == 1 { d - exact } else { exact - d };
            n[side] += 1.0;
            sum[side] += e;
            sum2[side] += e * e;
            worst = worst.max(e.abs());
        }
        for side in 0..2 {
            let (bias, rms) = (sum[side] / n[side], (sum2[side] / n[side]).sqrt());
            println!(
                "ball of {radius} cells, {}: bias {bias:.3}, rms {rms:.3}, worst {worst:.3}",
                ["inside", "outside"][side]
            );
            assert!(bias.abs() < [0.05, 0.2][side] && rms < 0.25);
        }
        assert!(worst < 0.75, "{worst}");
    }
}
