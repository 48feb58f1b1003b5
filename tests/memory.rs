//! What is made only when asked for, and what may not be taken.

#![allow(clippy::unwrap_used)]

use morula::math::{Sphere, Vec3};
use morula::measure::{QualityOptions, quality};
use morula::shape::{Bodies, ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Error, Run, Shape, Solid};

fn ball(segments: usize) -> Shape {
    let p = Primitive::Sphere { radius: 1.0 };
    Shape::from_primitive(&p, segments, &ImportOptions::default(), &Run::serial()).unwrap()
}

fn faces(shape: &Shape) -> u64 {
    shape.report.faces
}

#[test]
fn the_tree_over_the_surface_is_made_when_asked_for() {
    let shape = ball(200);
    let run = Run::serial();
    let options =
        SolidOptions { resolution: Resolution::CellsLongest(16), ..SolidOptions::default() };
    let solid = Solid::new(&shape, &options, &run).unwrap();
    let cells = solid.grid().len() as u64;
    assert!(faces(&shape) > 10_000, "{}", faces(&shape));
    assert_eq!(run.counters().peak_bytes, cells);
    // The overlap needs no tree either.
    let overlap = QualityOptions { surface: false, columns: 32, ..QualityOptions::default() };
    let spheres = [Sphere::new(Vec3::zeros(), 0.9)];
    let run = Run::serial();
    quality(&solid, &spheres, &overlap, &run).unwrap();
    assert!(run.counters().peak_bytes < 200 * faces(&shape));
    solid.surface(&run).unwrap();
    // Corners, nodes and boxes: some hundred bytes a face.
    let tree = run.counters().peak_bytes - cells;
    assert!((200..700).contains(&(tree / faces(&shape))), "{tree}");
}

#[test]
fn a_tree_beyond_the_limit_is_refused() {
    let shape = ball(200);
    let limit = 8 << 20;
    let options = SolidOptions {
        resolution: Resolution::CellsLongest(16),
        memory_limit: limit,
        ..SolidOptions::default()
    };
    let solid = Solid::new(&shape, &options, &Run::serial()).unwrap();
    let e = solid.surface(&Run::serial()).err().unwrap();
    let room = limit - solid.grid().len() as u64;
    let text = e.to_string();
    assert!(matches!(e, Error::MemoryLimit(_)), "{text}");
    assert!(text.contains(&room.to_string()) && text.contains("may take"), "{text}");
}

#[test]
fn voxel_faces_beyond_the_limit_are_refused() {
    // A sponge: every second cell along each axis is missing, so no two faces merge for long.
    let n = 48usize;
    let mask: Vec<u8> = (0..n * n * n)
        .map(|c| u8::from([c % n, c / n % n, c / (n * n)].iter().any(|i| i & 1 == 0)))
        .collect();
    let layout = Layout { dims: [n; 3], spacing: [1.0; 3], origin: [0.0; 3] };
    let import = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    let shape = Shape::from_mask(&mask, &layout, &import, &Run::serial()).unwrap();
    let with = |memory_limit| {
        let options = SolidOptions { memory_limit, ..SolidOptions::default() };
        Solid::new(&shape, &options, &Run::serial()).unwrap()
    };
    let run = Run::serial();
    let solid = with(1 << 30);
    let tree = {
        solid.surface(&run).unwrap();
        run.counters().peak_bytes - solid.grid().len() as u64
    };
    let limit = 24 * solid.grid().len() as u64;
    assert!(tree > limit);
    let e = with(limit).surface(&Run::serial()).err().unwrap();
    assert!(matches!(e, Error::MemoryLimit(_)) && e.to_string().contains("bytes"), "{e}");
}

/// A great many columns are compared band by band: the memory they take grows with one side.
#[test]
fn columns_take_little_memory_or_are_refused() {
    let shape = ball(24);
    let spheres = [Sphere::new(Vec3::zeros(), 0.9), Sphere::new(Vec3::new(0.2, 0.1, 0.0), 0.8)];
    let with = |memory_limit, columns| {
        let options = SolidOptions {
            resolution: Resolution::CellsLongest(16),
            memory_limit,
            ..SolidOptions::default()
        };
        let solid = Solid::new(&shape, &options, &Run::serial()).unwrap();
        let options = QualityOptions { surface: false, columns, ..QualityOptions::default() };
        let run = Run::serial();
        let q = quality(&solid, &spheres, &options, &run);
        (q, run.counters().peak_bytes)
    };
    // 1400² columns: as many bytes as columns would do for none but a single byte of each.
    let (q, peak) = with(6 << 20, 1024);
    assert!(q.unwrap().mismatch > 0.0 && peak > 1 << 20 && peak < 6 << 20, "{peak}");
    let (q, _) = with(6 << 20, 8192);
    let e = q.unwrap_err();
    assert!(matches!(e, Error::MemoryLimit(_)), "{e}");
    assert!(e.to_string().contains("columns") && e.to_string().contains("left of"), "{e}");
}
