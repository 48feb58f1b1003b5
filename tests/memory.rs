//! What is made only when asked for, and what may not be taken.

#![allow(clippy::unwrap_used)]

use morula::generate::{GenerateOptions, Method, generate};
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

/// The field's own lists count beside the solid and the distances themselves.
#[test]
fn the_distance_field_is_counted_and_limited() {
    let shape = ball(200);
    let with = |memory_limit, threads| {
        let options = SolidOptions {
            resolution: Resolution::CellsLongest(48),
            memory_limit,
            ..SolidOptions::default()
        };
        let run = Run::new(threads).unwrap();
        let solid = Solid::new(&shape, &options, &run).unwrap();
        let distance = solid.distance(&run).map(<[f32]>::to_vec);
        (solid.grid().len() as u64, distance, run.counters().peak_bytes)
    };
    let (cells, distance, peak) = with(1 << 30, 1);
    let distance = distance.unwrap();
    // A closed mesh has 1.5 edges and half a vertex a face: some hundred bytes each.
    let lists = (peak - 5 * cells) / faces(&shape);
    assert!((300..900).contains(&lists), "{lists}");
    let (_, two, peak_of_two) = with(1 << 30, 2);
    assert_eq!((two.unwrap(), peak_of_two), (distance.clone(), peak));
    // Enough, with what tasks leave of their shares; and too little, for each in turn.
    let (_, enough, _) = with(peak + (16 << 20), 1);
    assert_eq!(enough.unwrap(), distance);
    for (limit, words) in [
        (25 * cells, "features of the mesh"),
        (5 * cells + 500 * faces(&shape), "that may be nearest"),
    ] {
        let text = with(limit, 1).1.unwrap_err().to_string();
        assert!(text.contains(words) && text.contains("may take"), "{text}");
    }
}

/// Fewer than 24 bytes a voxel, the surface of the union and the body's own figures included.
#[test]
fn mss_takes_few_bytes_a_voxel() {
    let p = Primitive::Ellipsoid { axes: [2.0, 1.0, 1.0] };
    let shape = Shape::from_primitive(&p, 64, &ImportOptions::default(), &Run::serial()).unwrap();
    for (confine, spheres) in [(false, 10), (false, 300), (true, 50)] {
        let run = Run::serial();
        let options =
            SolidOptions { resolution: Resolution::CellsLongest(128), ..SolidOptions::default() };
        let solid = Solid::new(&shape, &options, &run).unwrap();
        let options = GenerateOptions {
            method: Method::Mss,
            spheres,
            confine,
            quality: None,
            ..GenerateOptions::default()
        };
        let clump = generate(&solid, &options, &run).unwrap();
        let a_voxel = run.counters().peak_bytes as f64 / solid.grid().len() as f64;
        assert!(clump.spheres.len() > 5 && (4.0..24.0).contains(&a_voxel), "{a_voxel}");
    }
}
