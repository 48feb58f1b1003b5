//! What a solid costs: the inside test and the distance field of a mesh of about
//! 50 000 triangles at 128 cells, and the distance transform of 3 million cells, beside
//! their bounds in CPU time.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use morula::math::Vec3;
use morula::run::Pool;
use morula::shape::read::FileOptions;
use morula::shape::{Body, ImportOptions, Primitive};
use morula::solid::edt::{Scratch, squared_distance_into};
use morula::solid::{Grid, Resolution, Solid, SolidOptions, coverage, moments};
use morula::{Run, Shape};
use std::time::{Duration, Instant};

const CELLS: usize = 128;
const PADDING: usize = 4;

/// The shapes: built in, and scans when `MORULA_DATA` is set.
fn shapes() -> Vec<(String, Shape)> {
    let run = Run::serial();
    let o = ImportOptions::default();
    let mut out = Vec::new();
    for (name, segments) in [("torus", 274), ("stone", 247)] {
        let p = Primitive::from_name(name).unwrap();
        out.push((name.to_string(), Shape::from_primitive(&p, segments, &o, &run).unwrap()));
    }
    if let Ok(data) = std::env::var("MORULA_DATA") {
        for name in [
            "particles/stone/stone_10.stl",
            "particles/stone/stone_20.stl",
            "classic/armadillo.obj",
        ] {
            let path = std::path::Path::new(&data).join(name);
            let shape = Shape::from_file(&path, &FileOptions::default(), &run);
            out.extend(shape.ok().map(|s| (name.to_string(), s)));
        }
    }
    out
}

/// A grid of 128 cells along the longest edge.
fn grid(shape: &Shape) -> Grid {
    let Body::Mesh(m) = &*shape.body else { unreachable!() };
    let hi = m.vertices.iter().fold(Vec3::zeros(), |h, v| h.sup(v));
    let h = hi.max() / CELLS as f64;
    let dims = [0, 1, 2].map(|a| (hi[a] / h - 1e-9).ceil() as usize + 2 * PADDING);
    let size = Vec3::from_fn(|a, _| dims[a] as f64 * h);
    Grid { dims, spacing: Vec3::repeat(h), origin: (hi - size) * 0.5 }
}

/// CPU milliseconds of this thread so far; without Linux's figure, wall-clock time.
fn cpu(since: Instant) -> f64 {
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|s| s.split(' ').next()?.parse::<f64>().ok())
        .map_or_else(|| since.elapsed().as_secs_f64() * 1e3, |ns| ns * 1e-6)
}

/// The mean of ten runs, in CPU milliseconds (the system counts them in steps of some ms).
fn mean(mut f: impl FnMut()) -> f64 {
    let since = Instant::now();
    f();
    let start = cpu(since);
    (0..10).for_each(|_| f());
    (cpu(since) - start) / 10.0
}

fn inside(c: &mut Criterion) {
    let run = Run::serial();
    let mut group = c.benchmark_group("inside test");
    group.sample_size(10).measurement_time(Duration::from_secs(1));
    group.warm_up_time(Duration::from_millis(200));
    for (name, shape) in shapes() {
        let (g, faces) = (grid(&shape), shape.report.faces);
        let ms = mean(|| drop(coverage::inside(&shape.body, &g, PADDING, u64::MAX, &run)));
        let integrals = mean(|| drop(moments::moments(&shape.body, &run)));
        println!(
            "{name}: {faces} faces, {CELLS} cells: inside {ms:.1} ms (bound 50), moments {integrals:.1} ms"
        );
        group.bench_function(&name, |b| {
            b.iter(|| coverage::inside(&shape.body, &g, PADDING, u64::MAX, &run).unwrap());
        });
    }
    group.finish();
}

/// The distance field, without the solid that it is made for.
fn distance(c: &mut Criterion) {
    let run = Run::serial();
    let mut group = c.benchmark_group("distance field");
    group.sample_size(10).measurement_time(Duration::from_secs(1));
    group.warm_up_time(Duration::from_millis(200));
    let resolution = Resolution::CellsLongest(CELLS as u32);
    let options = SolidOptions { resolution, padding: PADDING, ..SolidOptions::default() };
    for (name, shape) in shapes() {
        let make = || Solid::new(&shape, &options, &run).unwrap();
        let (mut ms, since) = (0.0, Instant::now());
        for _ in 0..5 {
            let solid = make();
            let start = cpu(since);
            solid.distance(&run).unwrap();
            ms += (cpu(since) - start) / 5.0;
        }
        let (faces, cells) = (shape.report.faces, make().grid().len());
        println!("{name}: {faces} faces, {cells} cells: distance field {ms:.1} ms (bound 250)");
        group.bench_function(&name, |b| {
            b.iter_batched_ref(make, |s| s.distance(&run).unwrap().len(), BatchSize::PerIteration);
        });
    }
    group.finish();
}

/// The distance transform of 3 million cells, half of them solid.
fn transform(c: &mut Criterion) {
    let n = 145;
    let mask: Vec<u8> = (0..n * n * n)
        .map(|i: usize| {
            let c = [i % n, i / n % n, i / n / n].map(|c| (c as f64 - 72.0).powi(2));
            u8::from(c.iter().sum::<f64>() < 71.0 * 71.0)
        })
        .collect();
    let (pool, mut out, mut scratch) = (Pool::serial(), Vec::new(), Scratch::default());
    let mut go = || {
        squared_distance_into(&mask, [n; 3], [1.0; 3], &pool, &mut out, &mut scratch).unwrap();
    };
    println!("distance transform of {} cells: {:.1} ms (bound 60)", n * n * n, mean(&mut go));
    let mut group = c.benchmark_group("distance transform");
    group.sample_size(10).measurement_time(Duration::from_secs(1));
    group.warm_up_time(Duration::from_millis(200));
    group.bench_function("ball", |b| b.iter(&mut go));
    group.finish();
}

criterion_group!(benches, inside, distance, transform);
criterion_main!(benches);
