//! The figures of the set cover's paper (Yuan, update of Granular Matter 21:19, 2019) beside ours:
//! table 2 and the tablet's series in the paper's own count, the trends of figures 6 and 9, and
//! what skeleton and clump cost. The bunny and the stones need `MORULA_DATA`.
//!
//!     MORULA_DATA=… cargo bench --bench cover [-- table2 | figure6 | figure9 | time]

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use morula::generate::cover::{Candidates, CoverOptions, Ends, Problem, Step, thin};
use morula::generate::{GenerateOptions, Method, generate};
use morula::math::Vec3;
use morula::measure::{QualityOptions, quality};
use morula::shape::read::FileOptions;
use morula::shape::{Bodies, Body, ImportOptions, Primitive};
use morula::solid::{Columns, Resolution, SolidOptions};
use morula::{Run, Shape, Solid, Sphere};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

fn data() -> Option<PathBuf> {
    std::env::var_os("MORULA_DATA").map(PathBuf::from)
}

fn solid(shape: &Shape, run: &Run) -> Solid {
    Solid::new(shape, &SolidOptions::default(), run).unwrap()
}

fn primitive(primitive: &Primitive, segments: usize) -> Shape {
    let run = Run::serial();
    Shape::from_primitive(primitive, segments, &ImportOptions::default(), &run).unwrap()
}

/// The bunny of 69 451 faces, each of its holes closed by a fan about the middle of its edge.
fn bunny() -> Option<Shape> {
    let bytes = std::fs::read(data()?.join("benchmark/bunny.stl")).ok()?;
    let (mut numbers, mut vertices, mut faces) = (BTreeMap::new(), Vec::new(), Vec::new());
    for facet in bytes.get(84..)?.chunks_exact(50) {
        let number = |n: usize| f32::from_le_bytes(facet[n..n + 4].try_into().unwrap());
        let corner = |c: usize| [0, 1, 2].map(|a| number(12 + 12 * c + 4 * a));
        faces.push([0, 1, 2].map(|c| {
            let p = corner(c);
            *numbers.entry(p.map(f32::to_bits)).or_insert_with(|| {
                vertices.push(p.map(f64::from));
                vertices.len() as u32 - 1
            })
        }));
    }
    let edges = |f: &[u32; 3]| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]];
    let mut open: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    for [a, b] in faces.iter().flat_map(edges) {
        *open.entry([a, b]).or_default() += 1;
        *open.entry([b, a]).or_default() -= 1;
    }
    // A face beyond the edge runs along it the other way.
    let mut next: BTreeMap<u32, u32> =
        open.iter().filter(|e| *e.1 > 0).map(|(&[a, b], _)| (b, a)).collect();
    while let Some((&first, _)) = next.iter().next() {
        let mut ring = vec![first];
        while let Some(to) = next.remove(ring.last().unwrap()).filter(|&to| to != first) {
            ring.push(to);
        }
        let sum =
            ring.iter().fold([0.0; 3], |s, &v| [0, 1, 2].map(|a| s[a] + vertices[v as usize][a]));
        vertices.push(sum.map(|s: f64| s / ring.len() as f64));
        let middle = vertices.len() as u32 - 1;
        let following = ring.iter().cycle().skip(1);
        faces.extend(ring.iter().zip(following).map(|(&a, &b)| [a, b, middle]));
    }
    let options = ImportOptions { bodies: Bodies::Largest, ..ImportOptions::default() };
    Shape::from_mesh(&vertices, &faces, &options, &Run::serial()).ok()
}

/// Distance to the nearest vertex, as the paper measures radii.
fn to_vertex(solid: &Solid) -> impl Fn(&Vec3) -> f64 {
    let vertices: Vec<[f64; 3]> = match solid.body() {
        Body::Mesh(m) => m.vertices.iter().map(|v| [v.x, v.y, v.z]).collect(),
        Body::Voxels(_) => Vec::new(),
    };
    move |c| {
        let squared = |v: &[f64; 3]| (0..3).map(|a| (v[a] - c[a]) * (v[a] - c[a])).sum::<f64>();
        vertices.iter().map(squared).fold(f64::MAX, f64::min).sqrt()
    }
}

/// How many spheres cover `share`; 0: none do.
fn needed(steps: &[Step], share: f64) -> usize {
    steps.iter().position(|s| s.covered >= share).map_or(0, |n| n + 1)
}

/// Exact coverage of the first `n` spheres.
fn truly(solid: &Solid, steps: &[Step], n: usize) -> f64 {
    let some = steps.iter().take(n.max(1));
    let spheres: Vec<Sphere> = some.map(|s| solid.frame().sphere_to_input(&s.sphere)).collect();
    let options = QualityOptions { surface: false, ..QualityOptions::default() };
    quality(solid, &spheres, &options, &Run::new(0).unwrap()).unwrap().coverage
}

/// Candidates of a row of the table: voxels to be thinned (0: analytic ones), and whether radii
/// reach to the nearest vertex, as the paper measures them, or to the surface.
const ROWS: [(u32, bool); 4] = [(60, false), (100, false), (100, true), (0, false)];

/// What the paper says, for each coverage the number of spheres, beside what comes out here.
fn reproduce(name: &str, shape: &Shape, paper: &[(f64, usize)]) {
    let run = Run::new(0).unwrap();
    let solid = solid(shape, &run);
    println!("\n### {name}\n");
    println!(
        "| candidates | V_p / V | V_cs / V_p | cover % | paper | n on V_p | n on V_cs | true % |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for (thinning, vertex) in ROWS {
        let mut options = CoverOptions::default();
        let kind = match thinning {
            0 => {
                options.candidates = Candidates::Analytic;
                "analytic".into()
            }
            n => {
                options.thinning_cells = n;
                format!("N = {n}{}", if vertex { ", radii to vertices" } else { "" })
            }
        };
        let mut problem = Problem::new(&solid, &options, &run).unwrap();
        if vertex {
            problem.set_radii(to_vertex(&solid));
        }
        let reach = problem.within_reach().unwrap();
        let steps: Vec<Step> = problem.solve(&run).unwrap().collect();
        let volume = problem.volume() / solid.unit_moments().volume;
        let kind = format!("{kind}: {}", problem.candidates().len());
        for &(share, stated) in paper {
            let n = [share, share * reach].map(|share| needed(&steps, share));
            let off = |n: usize| match n {
                0 => "–".into(),
                n => format!("{n} ({:+.0} %)", 100.0 * (n as f64 / stated as f64 - 1.0)),
            };
            println!(
                "| {kind} | {volume:.6} | {reach:.4} | {:.2} | {stated} | {} | {} | {:.2} |",
                100.0 * share,
                off(n[0]),
                off(n[1]),
                100.0 * truly(&solid, &steps, n[1]),
            );
        }
        println!(
            "| all {} cells | | | {:.2} | | | {} | |",
            problem.cells(),
            100.0 * reach,
            steps.len()
        );
    }
}

fn table2() {
    println!("## Table 2 and the tablet");
    let candy = primitive(&Primitive::Ellipsoid { axes: [6.585, 6.585, 3.395] }, 128);
    let table = |n: [usize; 4]| [0.95, 0.99, 0.999, 0.9999].into_iter().zip(n).collect::<Vec<_>>();
    reproduce("M&M", &candy, &table([48, 181, 461, 675]));
    let tablet = primitive(&Primitive::from_name("tablet").unwrap(), 128);
    let series =
        [(0.9504, 96), (0.9785, 250), (0.99, 456), (0.9913, 500), (0.9977, 1000), (0.999, 1329)];
    reproduce("Tablet", &tablet, &series);
    match bunny() {
        Some(bunny) => reproduce("Bunny", &bunny, &table([255, 1147, 2855, 4090])),
        None => println!("\nskipped: the bunny needs MORULA_DATA"),
    }
}

/// Stones and small bodies from round to angular; the paper's three particles are not published.
const STONES: [&str; 9] = [
    "asteroid/ryugu.obj",
    "asteroid/gaspra.obj",
    "asteroid/bacchus.obj",
    "cement/sika-cement07_00575_equant.stl",
    "stone/stone_002_007a.stl",
    "asteroid/toutatis.obj",
    "asteroid/golevka.obj",
    "stone/stone_10.stl",
    "stone/stone_20.stl",
];

fn stones(names: &[&str]) -> Vec<(String, Shape)> {
    let Some(data) = data() else {
        println!("\nskipped: the stones need MORULA_DATA");
        return Vec::new();
    };
    let run = Run::serial();
    let read = |name: &str| {
        let path = data.join("particles").join(name);
        Shape::from_file(&path, &FileOptions::default(), &run).unwrap()
    };
    names.iter().map(|name| (name.to_string(), read(name))).collect()
}

fn sphericity(solid: &Solid) -> f64 {
    let Body::Mesh(mesh) = solid.body() else { return 0.0 };
    let area = |i: usize| {
        let [a, b, c] = mesh.corners(i);
        0.5 * (b - a).cross(&(c - a)).norm()
    };
    let area: f64 = (0..mesh.faces.len()).map(area).sum();
    std::f64::consts::PI.cbrt() * (6.0 * solid.unit_moments().volume).powf(2.0 / 3.0) / area
}

fn figure6() {
    println!(
        "\n## Figure 6: candidates and coverage against N (paper, flat particle: 4 500 at 50, 6 800 and 98.8 % at 60, 19 000 and 99.0 % at 100)\n"
    );
    println!("| stone | N | candidates | V_cs / V_p % | n at 80 % | 85 % | 90 % |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    let run = Run::new(0).unwrap();
    for (name, shape) in stones(&STONES[8..]) {
        let solid = solid(&shape, &run);
        let row = |label: String, options: &CoverOptions| {
            let problem = Problem::new(&solid, options, &run).unwrap();
            let steps: Vec<Step> = problem.solve(&run).unwrap().collect();
            let n = [0.8, 0.85, 0.9].map(|share| needed(&steps, share).to_string()).join(" | ");
            let reach = 100.0 * problem.within_reach().unwrap();
            println!("| {name} | {label} | {} | {reach:.2} | {n} |", problem.candidates().len());
        };
        for thinning_cells in [20, 30, 40, 50, 60, 80, 100] {
            row(
                thinning_cells.to_string(),
                &CoverOptions { thinning_cells, ..CoverOptions::default() },
            );
        }
        let candidates = Candidates::Analytic;
        row("analytic".into(), &CoverOptions { candidates, ..CoverOptions::default() });
    }
}

fn figure9() {
    println!("\n## Figure 9: spheres at 90 % and 95 % against sphericity (N = 100)\n");
    println!("| body | sphericity | n at 90 % | n at 95 % | analytic 90 % | analytic 95 % |");
    println!("| --- | --- | --- | --- | --- | --- |");
    println!("| paper, compact | 0.91 | 33 | | 25 | 58 |");
    println!("| paper, elongated | 0.85 | 43 | | 36 | 85 |");
    println!("| paper, flat | 0.84 | 48 | | 41 | 93 |");
    let run = Run::new(0).unwrap();
    for (name, shape) in stones(&STONES) {
        let solid = solid(&shape, &run);
        let n = [Candidates::Thinned, Candidates::Analytic].map(|candidates| {
            let options = CoverOptions { candidates, thinning_cells: 100, ..Default::default() };
            let problem = Problem::new(&solid, &options, &run).unwrap();
            let steps: Vec<Step> = problem.solve(&run).unwrap().collect();
            format!("{} | {}", needed(&steps, 0.9), needed(&steps, 0.95))
        });
        println!("| {name} | {:.3} | {} | {} |", sphericity(&solid), n[0], n[1]);
    }
}

fn time() {
    println!("\n## Time (the least of three)\n");
    let Some(bunny) = bunny() else { return println!("skipped: the bunny needs MORULA_DATA") };
    for threads in [1, 2] {
        let run = Run::new(threads).unwrap();
        let shortest = |work: &dyn Fn()| {
            let timed = (0..3).map(|_| {
                let start = Instant::now();
                work();
                start.elapsed().as_secs_f64()
            });
            timed.fold(f64::MAX, f64::min)
        };
        let solid = solid(&bunny, &run);
        let h = (6.0 / std::f64::consts::PI * solid.unit_moments().volume).cbrt() / 60.0;
        let skeleton = shortest(&|| {
            // Along the axes of the file: as many voxels.
            let dims = [0, 1, 2].map(|a| {
                let Body::Mesh(m) = solid.body() else { return 1 };
                let most = m.vertices.iter().map(|v| v[a]).fold(0.0, f64::max);
                (most / h).ceil() as usize
            });
            let columns =
                Columns::new(solid.body(), 0, [dims[1], dims[2]], [0.0; 2], [h; 2], run.pool())
                    .unwrap();
            let mut cells = vec![0u8; dims.iter().product()];
            for (row, cells) in cells.chunks_mut(dims[0]).enumerate() {
                for [lo, hi] in columns.column(row % dims[1], row / dims[1]) {
                    for (i, cell) in cells.iter_mut().enumerate() {
                        let x = (i as f64 + 0.5) * h;
                        *cell |= u8::from(x >= *lo && x <= *hi);
                    }
                }
            }
            let skeleton = thin(dims, &cells, Ends::Surface, u64::MAX, &run).unwrap();
            assert!(skeleton.voxels.len() > 1000);
        });
        let whole = shortest(&|| {
            let solid = Solid::new(
                &bunny,
                &SolidOptions {
                    resolution: Resolution::CellsLongest(64),
                    ..SolidOptions::default()
                },
                &run,
            )
            .unwrap();
            let options = GenerateOptions {
                method: Method::Cover,
                spheres: 0,
                coverage: 0.99,
                cover: CoverOptions { candidates: Candidates::Analytic, ..Default::default() },
                ..GenerateOptions::default()
            };
            let clump = generate(&solid, &options, &run).unwrap();
            assert!(clump.spheres.len() > 500, "{}", clump.note);
        });
        println!(
            "{threads} threads: voxels and skeleton of the bunny at N = 60 {:.3} s (paper 16 s), \
             whole clump of 99 % {:.2} s (paper: minutes)",
            skeleton, whole
        );
    }
}

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let parts: [(&str, fn()); 4] =
        [("table2", table2), ("figure6", figure6), ("figure9", figure9), ("time", time)];
    for (name, part) in parts {
        if asked.is_empty() || asked.iter().any(|a| a == name) {
            part();
        }
    }
}
