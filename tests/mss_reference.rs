//! MSS against the reference implementation of its paper (the package `multisphere` 1.1.1), on the
//! reference's own voxels: at most its D + 0.003 with as many spheres. Its figures are recorded in
//! `mss_reference.csv` (`scripts/compare_mss.py CACHE --record tests/mss_reference.csv`). The shapes
//! are in `MORULA_DATA`; daily three numbers of spheres of each but the torus, which takes as
//! long as all others, and with `MORULA_FULL` all cells of the table.

#![allow(clippy::unwrap_used)]

mod common;

use morula::generate::{GenerateOptions, Method, generate};
use morula::shape::read::FileOptions;
use morula::shape::{Bodies, ImportOptions, Layout};
use morula::solid::SolidOptions;
use morula::{Run, Shape, Solid, Sphere};
use std::path::Path;

struct Row {
    shape: String,
    across: f64,
    asked: usize,
    mismatch: f64,
    dims: [usize; 3],
    cells: usize,
}

fn rows() -> Vec<Row> {
    let lines = include_str!("mss_reference.csv").lines().skip(1);
    lines
        .map(|line| {
            let f: Vec<&str> = line.split(',').collect();
            let number = |n: usize| f[n].parse::<f64>().unwrap();
            Row {
                shape: f[0].into(),
                across: number(1),
                asked: number(2) as usize,
                mismatch: number(4),
                dims: [5, 6, 7].map(|n| number(n) as usize),
                cells: number(8) as usize,
            }
        })
        .collect()
}

/// Corners of the triangles of a binary STL file.
fn triangles(path: &Path) -> Vec<[[f64; 3]; 3]> {
    let bytes = std::fs::read(path).unwrap();
    let value = |b: &[u8]| f64::from(f32::from_le_bytes(b.try_into().unwrap()));
    let corner = |b: &[u8]| [value(&b[..4]), value(&b[4..8]), value(&b[8..12])];
    let face = |b: &[u8]| [corner(&b[12..24]), corner(&b[24..36]), corner(&b[36..48])];
    bytes[84..].chunks_exact(50).map(face).collect()
}

fn square(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|n| (a[n] - b[n]).powi(2)).sum()
}

/// Points of a triangle: its corners, after all edges longer than `longest` have been halved again
/// and again, as trimesh does.
fn points(triangle: [[f64; 3]; 3], longest: f64, visit: &mut impl FnMut([f64; 3])) {
    let mut stack = vec![triangle];
    while let Some(t) = stack.pop() {
        let mid = |n: usize| {
            let (a, b) = (&t[n], &t[(n + 1) % 3]);
            let long = square(a, b).sqrt() > longest;
            long.then(|| std::array::from_fn(|x| (a[x] + b[x]) / 2.0))
        };
        let halves: [Option<[f64; 3]>; 3] = [mid(0), mid(1), mid(2)];
        match halves {
            [None, None, None] => t.into_iter().for_each(&mut *visit),
            [Some(p), Some(q), Some(r)] => {
                stack.extend([[t[0], p, r], [p, t[1], q], [r, q, t[2]], [p, q, r]]);
            }
            _ if halves.iter().flatten().count() == 1 => {
                let j = halves.iter().position(Option::is_some).unwrap();
                let (a, b, c, p) = (t[j], t[(j + 1) % 3], t[(j + 2) % 3], halves[j].unwrap());
                stack.extend([[a, p, c], [p, b, c]]);
            }
            _ => {
                let j = (halves.iter().position(Option::is_none).unwrap() + 1) % 3;
                let (a, b, c) = (t[j], t[(j + 1) % 3], t[(j + 2) % 3]);
                let (p, q) = (halves[j].unwrap(), halves[(j + 1) % 3].unwrap());
                stack.push([p, b, q]);
                if square(&a, &q) <= square(&p, &c) {
                    stack.extend([[a, p, q], [a, q, c]]);
                } else {
                    stack.extend([[a, p, c], [p, q, c]]);
                }
            }
        }
    }
}

/// The reference's voxels of a mesh: cells that the surface touches and what they enclose.
fn voxels(path: &Path, across: f64) -> ([usize; 3], Vec<u8>) {
    let triangles = triangles(path);
    let corners = || triangles.iter().flatten();
    let [lo, hi] = [f64::min, f64::max].map(|f: fn(f64, f64) -> f64| {
        corners().copied().reduce(|a, b| std::array::from_fn(|n| f(a[n], b[n]))).unwrap()
    });
    let edges: [f64; 3] = std::array::from_fn(|n| hi[n] - lo[n]);
    let pitch = edges[0].min(edges[1]).min(edges[2]) / across;
    let cell = |p: &[f64; 3]| p.map(|x| (x / pitch).round_ties_even() as i64);
    let (first, last) = (cell(&lo), cell(&hi));
    let dims: [usize; 3] = std::array::from_fn(|n| (last[n] - first[n]) as usize + 5);
    let at = |c: [usize; 3]| c[0] + dims[0] * (c[1] + dims[1] * c[2]);
    let mut mask = vec![2u8; dims.iter().product()];
    for t in &triangles {
        points(*t, pitch / 2.0, &mut |p| {
            let c = cell(&p);
            mask[at(std::array::from_fn(|n| (c[n] - first[n]) as usize + 2))] = 1;
        });
    }
    // 2 becomes 0 where it is joined to the corner, 1 elsewhere.
    let mut stack = vec![[0; 3]];
    while let Some(c) = stack.pop() {
        if mask[at(c)] == 2 {
            mask[at(c)] = 0;
            for n in 0..3 {
                for to in [c[n].wrapping_sub(1), c[n] + 1] {
                    if to < dims[n] {
                        let mut next = c;
                        next[n] = to;
                        stack.push(next);
                    }
                }
            }
        }
    }
    mask.iter_mut().for_each(|m| *m = u8::from(*m != 0));
    (dims, mask)
}

fn solid(data: &Path, row: &Row, run: &Run) -> Solid {
    let shape = if row.shape == "example_voxels" {
        let mut file = FileOptions::default();
        file.import.bodies = Bodies::All;
        file.npy_xyz = true;
        Shape::from_file(&data.join("example_voxels.npy"), &file, run).unwrap()
    } else {
        let (dims, mask) = voxels(&data.join(format!("{}.stl", row.shape)), row.across);
        assert_eq!(dims, row.dims, "{}", row.shape);
        let layout = Layout { dims, spacing: [1.0; 3], origin: [0.0; 3] };
        let import = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
        Shape::from_mask(&mask, &layout, &import, run).unwrap()
    };
    let solid = Solid::new(&shape, &SolidOptions { padding: 2, ..SolidOptions::default() }, run);
    solid.unwrap()
}

/// D over the cells whose centres lie in a sphere.
fn mismatch(solid: &Solid, spheres: &[Sphere]) -> f64 {
    let (grid, mut clump) = (solid.grid(), vec![0u8; solid.grid().len()]);
    for s in spheres {
        let s = solid.frame().sphere_to_unit(s);
        let range = |a: usize| {
            let cell = |x: f64| ((x - grid.origin[a]) / grid.spacing[a]).max(0.0) as usize;
            cell(s.center[a] - s.radius)..(cell(s.center[a] + s.radius) + 1).min(grid.dims[a])
        };
        for k in range(2) {
            for j in range(1) {
                for i in range(0) {
                    if (grid.center(i, j, k) - s.center).norm_squared() <= s.radius * s.radius {
                        clump[grid.index(i, j, k)] = 1;
                    }
                }
            }
        }
    }
    let count = |f: &dyn Fn(u8, u8) -> bool| {
        let pairs = solid.inside().unwrap().iter().zip(&clump);
        pairs.filter(|(s, c)| f(**s, **c)).count() as f64
    };
    let both = count(&|s, c| s != 0 && c != 0);
    1.0 - 2.0 * both / (count(&|s, _| s != 0) + count(&|_, c| c != 0))
}

#[test]
fn d_is_at_most_the_reference_s_on_its_own_voxels() {
    let Some(data) = common::data() else { return };
    let data = data.join("benchmark");
    let full = std::env::var_os("MORULA_FULL").is_some();
    let run = Run::serial();
    let mut last: Option<(String, f64, Solid)> = None;
    let (mut logarithms, mut count, mut worse) = ([0.0; 2], 0.0, Vec::new());
    for row in rows() {
        // The paper's own grids have 102 cells across.
        let daily =
            row.shape != "torus" && (matches!(row.asked, 5 | 10 | 30) || row.across == 102.0);
        if !(full || daily) {
            continue;
        }
        if last.as_ref().is_none_or(|(s, a, _)| (s, *a) != (&row.shape, row.across)) {
            last = Some((row.shape.clone(), row.across, solid(&data, &row, &run)));
        }
        let (_, _, solid) = last.as_ref().unwrap();
        let cells = solid.inside().unwrap().iter().filter(|c| **c != 0).count();
        assert_eq!(cells, row.cells, "{}: not the reference's voxels", row.shape);
        for (n, radius_offset) in [1.0, 0.0].into_iter().enumerate() {
            let options = GenerateOptions {
                method: Method::Mss,
                spheres: row.asked,
                radius_offset,
                ..GenerateOptions::default()
            };
            let clump = generate(solid, &options, &run).unwrap();
            assert!(clump.spheres.len() == row.asked || !clump.note.is_empty());
            let d = mismatch(solid, &clump.spheres);
            if n == 0 && d > row.mismatch + 0.003 {
                worse.push(format!("{} {}: {d:.4}, {:.4}", row.shape, row.asked, row.mismatch));
            }
            logarithms[n] += (d / row.mismatch).ln();
        }
        count += 1.0;
    }
    let means = logarithms.map(|l: f64| (l / count).exp());
    let [with, without] = means;
    println!(
        "{count} cells; D over the reference's: {with:.3} with the offset, {without:.3} without"
    );
    assert!(worse.is_empty(), "{worse:#?}");
    assert!(with < 0.7);
    assert!(without <= 1.0);
}
