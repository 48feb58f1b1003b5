//! Voxel files: npy, TIFF, raw.
#![cfg(feature = "io")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod arrays;
#[path = "../common/mod.rs"]
mod common;

use arrays::{encoded, npy};
use common::data;
use morula::error::Error;
use morula::shape::read::{FileOptions, Format, Meaning, RawType, bytes_labels, file_labels};
use morula::shape::voxels::Threshold;
use morula::shape::{Bodies, Body, ImportOptions};
use morula::{Result, Run, Shape};
use proptest::prelude::*;
use std::io::Cursor;
use tiff::encoder::{TiffEncoder, colortype};

/// An asymmetric body in 4 x 3 x 2 cells (x, y, z), x fastest.
const BODY: [u8; 24] = [
    1, 1, 1, 1, 0, 1, 0, 0, 0, 1, 1, 0, //
    1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0,
];

fn options() -> FileOptions {
    let import =
        ImportOptions { bodies: Bodies::All, memory_limit: 64 << 20, ..ImportOptions::default() };
    FileOptions { import, ..FileOptions::default() }
}

fn read(bytes: &[u8], name: &str, options: &FileOptions) -> Result<Shape> {
    Shape::from_bytes(bytes, name, options, &Run::serial())
}

fn cells(shape: &Shape) -> ([usize; 3], Vec<u8>) {
    match &*shape.body {
        Body::Voxels(v) => (v.dims, v.cells.clone()),
        Body::Mesh(_) => panic!("a mesh"),
    }
}

/// A TIFF with one page for each z.
fn tiff_u8(planes: &[&[u8]], width: u32, height: u32) -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut out).unwrap();
    for plane in planes {
        encoder.write_image::<colortype::Gray8>(width, height, plane).unwrap();
    }
    out.into_inner()
}

#[test]
fn tiff_pages_are_planes() {
    let bytes = tiff_u8(&[&BODY[..12], &BODY[12..]], 4, 3);
    let shape = read(&bytes, "", &options()).unwrap();
    assert_eq!(cells(&shape), ([4, 3, 2], BODY.to_vec()));

    let mut out = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut out).unwrap();
    let wide: Vec<u16> = BODY.iter().map(|&v| u16::from(v) * 1000 + 7).collect();
    for plane in wide.chunks(12) {
        encoder.write_image::<colortype::Gray16>(4, 3, plane).unwrap();
    }
    let shape = read(&out.into_inner(), "", &options()).unwrap();
    assert_eq!(cells(&shape), ([4, 3, 2], BODY.to_vec()));
    assert_eq!(shape.report.threshold, 7.0);

    let mut out = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut out).unwrap();
    let floats: Vec<f32> = BODY.iter().map(|&v| f32::from(v) - 0.5).collect();
    for plane in floats.chunks(12) {
        encoder.write_image::<colortype::Gray32Float>(4, 3, plane).unwrap();
    }
    let grey = FileOptions { meaning: Meaning::Grey(Threshold::Above(0.0)), ..options() };
    let shape = read(&out.into_inner(), "", &grey).unwrap();
    assert_eq!(cells(&shape), ([4, 3, 2], BODY.to_vec()));
}

#[test]
fn bad_tiff_is_refused() {
    let mut out = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut out).unwrap();
    encoder.write_image::<colortype::Gray8>(4, 3, &BODY[..12]).unwrap();
    encoder.write_image::<colortype::Gray8>(3, 4, &BODY[12..]).unwrap();
    let e = read(&out.into_inner(), "", &options()).unwrap_err();
    assert!(matches!(&e, Error::Format(t) if t.contains("page 1")), "{e}");

    let mut out = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut out).unwrap();
    encoder.write_image::<colortype::Gray8>(2, 1, &[1, 0]).unwrap();
    encoder.write_image::<colortype::Gray16>(2, 1, &[1, 0]).unwrap();
    let e = read(&out.into_inner(), "", &options()).unwrap_err();
    assert!(matches!(&e, Error::Format(t) if t.contains("page 1")), "{e}");

    let mut out = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut out).unwrap();
    encoder.write_image::<colortype::RGB8>(2, 1, &[1; 6]).unwrap();
    let e = read(&out.into_inner(), "", &options()).unwrap_err();
    assert!(matches!(&e, Error::Unsupported(t) if t.contains("RGB")), "{e}");

    let good = tiff_u8(&[&BODY[..12], &BODY[12..]], 4, 3);
    for end in 1..good.len() {
        // A reader may not need the last bytes; it must not fail otherwise.
        if let Err(e) = read(&good[..end], "x.tif", &options()) {
            assert!(matches!(e, Error::Format(_) | Error::Unsupported(_)), "{end}: {e}");
        }
    }
    let mut small = options();
    small.import.memory_limit = 100;
    let e = read(&good, "x.tif", &small).unwrap_err();
    assert!(matches!(e, Error::MemoryLimit(_)), "{e}");
}

#[test]
fn raw_data_are_as_long_as_declared() {
    let raw = |kind, skip, bytes: &[u8]| {
        let o = FileOptions { raw: Some(([4, 3, 2], kind, skip)), ..options() };
        read(bytes, "x.raw", &FileOptions { format: Some(Format::Raw), ..o })
    };
    let mut bytes = vec![9; 5];
    bytes.extend(BODY);
    assert_eq!(cells(&raw(RawType::U8, 5, &bytes).unwrap()).1, BODY);
    let wide: Vec<u8> = BODY.iter().flat_map(|&v| (u16::from(v) << 9).to_le_bytes()).collect();
    assert_eq!(cells(&raw(RawType::U16, 0, &wide).unwrap()).1, BODY);
    let floats: Vec<u8> = BODY.iter().flat_map(|&v| f32::from(v).to_le_bytes()).collect();
    assert_eq!(cells(&raw(RawType::F32, 0, &floats).unwrap()).1, BODY);
    for (kind, skip) in [(RawType::U8, 4), (RawType::U16, 0), (RawType::U8, usize::MAX)] {
        let e = raw(kind, skip, &bytes).unwrap_err();
        assert!(matches!(&e, Error::Format(t) if t.contains("byte 29")), "{e}");
    }
    let none = FileOptions { format: Some(Format::Raw), ..options() };
    assert!(matches!(read(&bytes, "x.raw", &none), Err(Error::InvalidArgument(_))));
}

#[test]
fn the_meaning_of_values() {
    let file = |values: &[u8]| npy("|u1", false, [1, 1, values.len()], values);
    let solid = |values: &[u8], meaning| {
        read(&file(values), "", &FileOptions { meaning, ..options() }).map(|s| s.report.solid_cells)
    };
    // One value, or 0 and another, is a mask; else grey.
    assert_eq!(solid(&[3, 3, 3], Meaning::Auto), Ok(3));
    assert_eq!(solid(&[0, 3, 3], Meaning::Auto), Ok(2));
    assert_eq!(solid(&[1, 2, 2], Meaning::Auto), Ok(2));
    assert_eq!(solid(&[0, 10, 90, 91], Meaning::Auto), Ok(2));
    assert!(matches!(solid(&[0, 0], Meaning::Auto), Err(Error::Empty(_))));
    assert_eq!(solid(&[0, 10, 90, 91], Meaning::Grey(Threshold::Above(5.0))), Ok(3));
    assert_eq!(solid(&[0, 7, 9, 9], Meaning::Label(9)), Ok(2));
    assert!(matches!(solid(&[0, 7, 9, 9], Meaning::Label(8)), Err(Error::IndexOutOfRange(_))));

    let labels: Vec<u8> = [0.0f32, 3.0, 3.0, 2.5].iter().flat_map(|v| v.to_le_bytes()).collect();
    let o = FileOptions { meaning: Meaning::Label(3), ..options() };
    let e = read(&npy("<f4", false, [1, 1, 4], &labels), "", &o).unwrap_err();
    assert!(matches!(&e, Error::InvalidArgument(t) if t.contains("voxel 3 is 2.5")), "{e}");
    let s = read(&npy("<f4", false, [1, 1, 3], &labels[..12]), "", &o).unwrap();
    assert_eq!(s.report.solid_cells, 2);
    // 32-bit grey values.
    let wide: Vec<u8> = [1u32, 2, 100_000, 99_999].iter().flat_map(|v| v.to_le_bytes()).collect();
    let s = read(&npy("<u4", false, [1, 1, 4], &wide), "", &options()).unwrap();
    assert_eq!((s.report.solid_cells, s.report.threshold), (2, 2.0));
}

#[test]
fn what_may_be_labels_is_said() {
    let told = |descr: &str, values: &[u8], meaning| {
        let cells = values.len() / if descr == "<f4" { 4 } else { 1 };
        let file = npy(descr, false, [1, 1, cells], values);
        let r = read(&file, "", &FileOptions { meaning, ..options() }).unwrap().report;
        assert_eq!(r.label_like > 0, r.notes.iter().any(|n| n.contains("labels")), "{:?}", r.notes);
        r.label_like
    };
    let floats = |v: [f32; 4]| v.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let scan: Vec<u8> = (0..=64).collect();
    assert_eq!(told("|u1", &[0, 5, 5, 9, 0, 5], Meaning::Auto), 3);
    assert_eq!(told("|u1", &scan[..64], Meaning::Auto), 64);
    assert_eq!(told("<f4", &floats([0.0, 2.0, 2.0, 7.0]), Meaning::Auto), 3);
    // Apart from each other they are refused, and the way out is named.
    let file = npy("|u1", false, [1, 1, 5], &[5, 0, 9, 0, 5]);
    let refused = read(&file, "", &FileOptions::default());
    let Err(Error::SeveralBodies(text)) = refused else { panic!("{refused:?}") };
    assert!(text.contains("one label, if its 3 different"), "{text}");
    // A scan; values that are no labels; masks; and what the caller has said.
    assert_eq!(told("|u1", &scan, Meaning::Auto), 0);
    assert_eq!(told("<f4", &floats([0.0, 2.5, 2.0, 7.0]), Meaning::Auto), 0);
    assert_eq!(told("<f4", &floats([0.0, 2.0, -2.0, 7.0]), Meaning::Auto), 0);
    assert_eq!(told("|u1", &[0, 5, 5, 0], Meaning::Auto), 0);
    assert_eq!(told("|u1", &[0, 5, 9, 0], Meaning::Grey(Threshold::Otsu)), 0);
    assert_eq!(told("|u1", &[0, 5, 9, 0], Meaning::Label(5)), 0);
}

#[test]
fn the_file_its_values_and_the_cells_count_together() {
    let raw = ([10, 10, 10], RawType::U16, 0);
    let path = std::env::temp_dir().join(format!("morula-held-{}.raw", std::process::id()));
    std::fs::write(&path, vec![1u8; 2000]).unwrap();
    let with = |limit: u64| {
        let mut options = FileOptions { raw: Some(raw), ..options() };
        options.import.memory_limit = limit;
        Shape::from_file(&path, &options, &Run::serial())
    };
    // Each of them alone would fit.
    let file = with(3000).unwrap_err();
    // The values, a mask and the crop, with the runs of the bodies.
    let cells = with(4100).unwrap_err();
    let enough = with(8000);
    std::fs::remove_file(&path).unwrap();
    let words = "1000 voxels need 2000 bytes beside the 2000 of the file, the limit is 3000";
    assert!(matches!(&file, Error::MemoryLimit(s) if s == words), "{file}");
    let words = "beside the 3000 as read, the limit is 4100";
    assert!(matches!(&cells, Error::MemoryLimit(s) if s.contains(words)), "{cells}");
    enough.unwrap();
}

#[test]
fn labels_of_a_file_are_listed() {
    let folder = std::env::temp_dir().join(format!("morula-labels-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("labels.npy");
    let data: Vec<u8> = [0u16, 7, 7, 300].iter().flat_map(|v| v.to_le_bytes()).collect();
    let bytes = npy("<u2", false, [1, 1, 4], &data);
    std::fs::write(&path, &bytes).unwrap();
    let run = Run::serial();
    let list = file_labels(&path, &options(), &run).unwrap();
    assert_eq!(bytes_labels(&bytes, "", &options(), &run).unwrap(), list);
    let found: Vec<_> = list.iter().map(|l| (l.label, l.cells, l.first[0], l.last[0])).collect();
    assert_eq!(found, [(7, 2, 1, 2), (300, 1, 3, 3)]);
    // Two bytes a voxel as read, four as labels.
    let mut small = options();
    small.import.memory_limit = 23;
    let e = bytes_labels(&bytes, "", &small, &run).unwrap_err();
    assert!(matches!(&e, Error::MemoryLimit(s) if s.contains("need 24 bytes")), "{e}");
    let cancel = Run::serial().with_progress(Box::new(|fraction| fraction > 0.0));
    let e = bytes_labels(&bytes, "", &options(), &cancel).unwrap_err();
    assert!(matches!(e, Error::Cancelled(_)), "{e}");
    let e = bytes_labels(b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "", &options(), &run);
    assert!(matches!(e, Err(Error::InvalidArgument(s)) if s.starts_with("the file is a mesh")));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn spacing_origin_and_unit_reach_the_shape() {
    let mut o = options();
    o.spacing = [1.0, 2.0, 4.0];
    o.origin = [10.0, 20.0, 30.0];
    o.import.length_unit = 0.5;
    let shape = read(&npy("|u1", false, [2, 3, 4], &BODY), "", &o).unwrap();
    assert_eq!(shape.report.box_min, [5.0, 10.0, 15.0]);
    assert_eq!(shape.report.box_max, [7.0, 13.0, 19.0]);
    assert_eq!(shape.report.length_unit, 0.5);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_files_give_a_shape_or_an_error(
        which in 0usize..2,
        changes in proptest::collection::vec((0usize..400, any::<u8>()), 1..6),
        cut in 0usize..60,
    ) {
        let mut bytes = match which {
            0 => npy("<f4", false, [2, 3, 4], &encoded(true, &|v| f32::from(v).to_le_bytes().into())),
            _ => tiff_u8(&[&BODY[..12], &BODY[12..]], 4, 3),
        };
        bytes.truncate(bytes.len() - cut.min(bytes.len() / 2));
        for (at, value) in changes {
            let n = bytes.len();
            bytes[at % n] = value;
        }
        // Any answer will do, but for a panic.
        let name = ["x.npy", "x.tif"][which];
        let format = Some([Format::Npy, Format::Tiff][which]);
        let _ = read(&bytes, name, &FileOptions { format, ..options() });
    }
}

#[test]
fn real_voxels_match_their_mesh_twins() {
    let Some(data) = data() else { return };
    let csv = std::fs::read_to_string(data.join("nist_reference.csv")).unwrap();
    let volume = |grain: &str| {
        let line = csv.lines().find(|l| l.contains(grain)).unwrap();
        line.split(',').nth(4).unwrap().parse::<f64>().unwrap()
    };
    let run = Run::serial();
    let take = |path: &str, options: &FileOptions| {
        Shape::from_file(&data.join(path), options, &run).unwrap()
    };
    // Cells of 1 µm: the volume of a grain 20 to 90 µm long is within 1.5 %.
    for (path, grain, count) in [
        ("voxels/cement133_00137_flat_1um.npy", "cement133_00137_flat", 5926),
        ("voxels/cement140_02475_rough_1um.npy", "cement140_02475_rough", 27031),
        ("voxels/cement140_02475_rough_1um.tif", "cement140_02475_rough", 27031),
        ("voxels/ma160_01731_equant_1um.npy", "ma160_01731_equant", 11091),
    ] {
        let r = take(path, &FileOptions::default()).report;
        assert_eq!((r.solid_cells, r.bodies), (count, 1), "{path}");
        let error = r.volume / volume(grain) - 1.0;
        println!("{path}: {} cells, volume {:+.2} %", r.solid_cells, 100.0 * error);
        assert!(error.abs() < 0.015, "{path}: {error}");
    }
    let cone = take("classic/ice_cream_cone.npy", &FileOptions::default()).report;
    assert_eq!(cone.solid_cells, 9577);
    // Its mesh is the staircase of these cells.
    let mesh = take("benchmark/ice_cream_cone.stl", &FileOptions::default()).report;
    println!("cone: voxels {} and mesh {}", cone.volume, mesh.volume);
    let voxels = take("benchmark/example_voxels.npy", &options()).report;
    println!("example: {} cells, {} bodies", voxels.solid_cells, voxels.bodies);

    let a = take("voxels/cement140_02475_rough_1um.npy", &FileOptions::default());
    let b = take("voxels/cement140_02475_rough_1um.tif", &FileOptions::default());
    assert_eq!(cells(&a), cells(&b));
}

#[test]
fn real_tomograms_are_cut_by_otsu() {
    let Some(data) = data() else { return };
    let take = |name: &str, bodies| {
        let mut o = FileOptions::default();
        o.import.bodies = bodies;
        Shape::from_file(&data.join(name), &o, &Run::serial()).map(|s| s.report)
    };
    // Thresholds and counts by NumPy and scipy.ndimage.label on the same files.
    let snow = "ct/snow_microCT_100.tif";
    let refused = take(snow, Bodies::Refuse).unwrap_err();
    assert!(matches!(&refused, Error::SeveralBodies(t) if t.contains("27 separate")), "{refused}");
    let r = take(snow, Bodies::Largest).unwrap();
    assert_eq!((r.threshold, r.solid_cells, r.bodies_dropped), (22779.0, 590_508, 26));
    assert!(r.touches_border);
    let r = take("ct/concrete_xray_CT_100.tif", Bodies::Refuse).unwrap();
    assert_eq!((r.threshold, r.solid_cells, r.bodies), (20165.0, 617_431, 1));
    assert!(!r.touches_border);
}
