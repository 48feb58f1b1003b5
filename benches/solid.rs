//! What a solid costs: the inside test and the distance field of a mesh of about
//! 50 000 triangles at 128 cells, beside their bounds in CPU time.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use criterion::{Criterion, criterion_group, criterion_main};
use morula::math::Vec3;
use morula::shape::read::FileOptions;
use morula::shape::{Body, ImportOptions, Primitive};
use morula::solid::{Grid, coverage, moments};
use morula::{Run, Shape};
use std::time::{Duration, Instant};

const CELLS: usize = 128;
const PADDING: usize = 4;

/// The shapes: built in, and scans when `MORULA_DATA` is set.
fn shapes() -> Vec<(String, Shape)> {
    let run = Run::serial();
    let o = ImportOptions::default();
    let mut out = Vec::new();
    for (name, segments) in [("torus", 220), ("stone", 220)] {
        let p = Primitive::from_name(name).unwrap();
        out.push((name.to_string(), Shape::from_primitive(&p, segments, &o, &run).unwrap()));
    }
    if let Ok(data) = std::env::var("MORULA_DATA") {
        for name in ["classic/armadillo.obj", "classic/bunny.obj"] {
            let path = std::path::Path::new(&data).join(name);
            let shape = Shape::from_file(&path, &FileOptions::default(), &run);
            out.extend(shape.ok().map(|s| (name.to_string(), s)));
        }
    }
    out
}

/// A grid of 128 cells along the longest edge.
fn grid(shape: &Shape) -> Grid {
    let Body::Mesh(m) = &shape.body else { unreachable!() };
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
        let ms = mean(|| drop(coverage::inside(&shape.body, &g, PADDING, &run)));
        let integrals = mean(|| drop(moments::moments(&shape.body, &run)));
        println!(
            "{name}: {faces} faces, {CELLS} cells: inside {ms:.1} ms (bound 50), moments {integrals:.1} ms"
        );
        group.bench_function(&name, |b| {
            b.iter(|| coverage::inside(&shape.body, &g, PADDING, &run).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, inside);
criterion_main!(benches);
