//! Parts of cells against sums over many points, and their sums against exact moments.

use super::*;
use crate::math::Moments;
use crate::shape::{Bodies, ImportOptions, Layout, Primitive, Shape};
use crate::solid::{Solid, SolidOptions};

fn solid(shape: &Shape) -> Solid {
    Solid::new(shape, &SolidOptions::default(), &Run::serial()).unwrap()
}

fn primitive(name: &str) -> Solid {
    let shape = Primitive::from_name(name).unwrap();
    let shape = Shape::from_primitive(&shape, 24, &ImportOptions::default(), &Run::serial());
    solid(&shape.unwrap())
}

/// Volume and centroid of all parts, in the turned frame.
fn sum(fill: &Fill, grid: &Grid) -> (f64, Vec3) {
    let h3 = grid.spacing.x.powi(3);
    let [nx, ny, _] = grid.dims;
    let full = (0..fill.kind.len()).filter(|&n| fill.kind[n] == FULL);
    let full = full.map(|n| (1.0, grid.center(n % nx, n / nx % ny, n / nx / ny)));
    let (mut volume, mut first) = (0.0, Vec3::zeros());
    for (v, c) in full.chain(fill.cut.iter().map(|p| (p.volume, p.center))) {
        volume += v * h3;
        first += c * (v * h3);
    }
    (volume, first / volume)
}

fn filled_by(solid: &Solid, cells: u32) -> (Turned<'_>, Grid, Fill) {
    let turned = Turned::new(solid).unwrap();
    let grid = turned.lattice(turned.diameter / f64::from(cells), 1, u64::MAX, 1).unwrap();
    let fill = fill(&turned, &grid, u64::MAX, &Run::serial()).unwrap();
    (turned, grid, fill)
}

fn agrees(solid: &Solid, moments: &Moments, cells: u32, close: f64) {
    let (turned, grid, fill) = filled_by(solid, cells);
    let (volume, centroid) = sum(&fill, &grid);
    let error = (volume / moments.volume - 1.0).abs();
    assert!(error < close, "{error:e}");
    assert!((turned.to_unit(&centroid) - moments.centroid).norm() < close);
}

#[test]
fn the_parts_of_closed_meshes_add_up_to_them() {
    for name in ["sphere", "box", "torus", "tablet", "stone"] {
        let solid = primitive(name);
        for cells in [7, 30] {
            agrees(&solid, solid.unit_moments(), cells, 1e-6);
        }
    }
}

#[test]
fn the_parts_of_voxels_add_up_to_them() {
    let dims = [9, 8, 7];
    let mask: Vec<u8> = (0..dims.iter().product::<usize>())
        .map(|n| u8::from(n % 9 + n / 9 % 8 + n / 72 > 6 && !(n * n).is_multiple_of(5)))
        .collect();
    let layout = Layout { dims, spacing: [1.0, 1.3, 0.7], origin: [0.0; 3] };
    let options = ImportOptions { bodies: Bodies::Largest, ..ImportOptions::default() };
    let shape = Shape::from_mask(&mask, &layout, &options, &Run::serial()).unwrap();
    let solid = solid(&shape);
    for cells in [5, 17] {
        agrees(&solid, solid.unit_moments(), cells, 1e-6);
    }
}

/// Two boxes that cross each other: by columns.
#[test]
fn the_parts_of_a_mesh_that_crosses_itself_nearly_do() {
    let run = Run::serial();
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let corner = |n: usize| [n & 1, n >> 1 & 1, n >> 2].map(|b| b as f64);
    for shift in [0.0, 0.37] {
        let first = vertices.len() as u32;
        vertices.extend((0..8).map(|n| corner(n).map(|x| x + shift)));
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for [a, b, c, d] in quads {
            faces.extend([[a, b, c], [a, c, d]].map(|f| f.map(|i| i + first)));
        }
    }
    let shape = Shape::from_mesh(&vertices, &faces, &ImportOptions::default(), &run).unwrap();
    let solid = solid(&shape);
    assert!(!Turned::new(&solid).unwrap().exact);
    let (_, grid, fill) = filled_by(&solid, 40);
    let scale = solid.frame().scale;
    let volume = sum(&fill, &grid).0 * scale.powi(3);
    assert!((volume / (2.0 - 0.63f64.powi(3)) - 1.0).abs() < 5e-3, "{volume}");
}

#[test]
fn each_part_is_what_points_in_the_cell_say() {
    let solid = primitive("tablet");
    let surface = solid.surface(&Run::serial()).unwrap();
    let (turned, grid, fill) = filled_by(&solid, 9);
    const N: usize = 12;
    for part in fill.cut.iter().step_by(17) {
        let [nx, ny, _] = grid.dims;
        let middle = grid.center(part.cell % nx, part.cell / nx % ny, part.cell / nx / ny);
        let (mut count, mut first) = (0.0, Vec3::zeros());
        for n in 0..N * N * N {
            let at = [n % N, n / N % N, n / N / N].map(|i| (i as f64 + 0.5) / N as f64 - 0.5);
            let p = middle + Vec3::from(at) * grid.spacing.x;
            if surface.contains(&turned.to_unit(&p)) {
                count += 1.0;
                first += p;
            }
        }
        let share = count / (N * N * N) as f64;
        assert!((share - part.volume).abs() < 0.02, "{share} {}", part.volume);
        if share > 0.2 {
            let off = (first / count - part.center).norm() / grid.spacing.x;
            assert!(off < 0.03, "{off}");
        }
    }
    // No cell is cut that is not, and none is missed.
    let empty = (0..fill.kind.len()).filter(|&n| fill.kind[n] == 0).step_by(31);
    for n in empty {
        let p = grid.center(
            n % grid.dims[0],
            n / grid.dims[0] % grid.dims[1],
            n / grid.dims[0] / grid.dims[1],
        );
        assert!(!surface.contains(&turned.to_unit(&p)));
    }
}
