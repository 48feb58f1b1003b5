//! Voxels from arrays: masks, bodies, grey volumes, labels.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use morula::error::Error;
use morula::shape::voxels::{F32_BINS, Grey, Threshold, list_labels, otsu, widen_labels};
use morula::shape::{Bodies, Body, ImportOptions, Layout, Voxels};
use morula::{Run, Shape};
use proptest::prelude::*;

fn layout(dims: [usize; 3]) -> Layout {
    Layout { dims, spacing: [1.0; 3], origin: [0.0; 3] }
}

fn all() -> ImportOptions {
    ImportOptions { bodies: Bodies::All, ..ImportOptions::default() }
}

fn voxels(shape: &Shape) -> &Voxels {
    match &*shape.body {
        Body::Voxels(v) => v,
        Body::Mesh(_) => panic!("a mesh"),
    }
}

/// Two blocks: 2 x 3 x 1 cells at the border and 1 x 1 x 2 apart from it.
fn two_blocks() -> (Vec<u8>, [usize; 3]) {
    let mut mask = vec![0; 120];
    let mut set = |i: usize, j: usize, k: usize| mask[i + 6 * (j + 5 * k)] = 255;
    for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1), (0, 2), (1, 2)] {
        set(i, j, 1);
    }
    set(4, 3, 1);
    set(4, 3, 2);
    (mask, [6, 5, 4])
}

#[test]
fn an_anisotropic_block_is_cropped_and_measured() {
    // A 2 x 3 x 4 block whose first cell is (3, 2, 1), spacing (0.5, 1, 2).
    let dims = [8, 7, 6];
    let mut mask = vec![0u8; dims.iter().product()];
    for c in 0..24 {
        mask[3 + c % 2 + 8 * (2 + c / 2 % 3 + 7 * (1 + c / 6))] = 9;
    }
    let layout = Layout { dims, spacing: [0.5, 1.0, 2.0], origin: [10.0, -20.0, 0.25] };
    let options = ImportOptions { length_unit: 2.0, ..ImportOptions::default() };
    let shape = Shape::from_mask(&mask, &layout, &options, &Run::serial()).unwrap();
    let v = voxels(&shape);
    assert_eq!(v.dims, [2, 3, 4]);
    assert_eq!(v.cells, vec![1; 24]);
    let r = &shape.report;
    assert_eq!((r.solid_cells, r.components, r.bodies, r.touches_border), (24, 1, 1, false));
    assert_eq!(r.volume, 24.0 * 8.0);
    assert_eq!(r.box_min, [23.0, -36.0, 4.5]);
    assert_eq!(r.box_max, [25.0, -30.0, 20.5]);
    assert_eq!(r.area, 2.0 * (2.0 * 6.0 + 2.0 * 16.0 + 6.0 * 16.0));
    assert_eq!(shape.frame.scale, 16.0);
    assert_eq!(v.spacing.as_slice(), [1.0 / 16.0, 2.0 / 16.0, 4.0 / 16.0]);
    assert_eq!(r.notes, ["lengths were multiplied by 2 on import"]);
}

#[test]
fn the_choice_of_bodies_is_kept() {
    let (mask, dims) = two_blocks();
    let run = Run::serial();
    let refused = Shape::from_mask(&mask, &layout(dims), &ImportOptions::default(), &run);
    let Err(Error::SeveralBodies(text)) = refused else { panic!("{refused:?}") };
    assert!(text.contains("2 separate bodies"), "{text}");

    let largest = ImportOptions { bodies: Bodies::Largest, ..ImportOptions::default() };
    let shape = Shape::from_mask(&mask, &layout(dims), &largest, &run).unwrap();
    assert_eq!(voxels(&shape).dims, [2, 3, 1]);
    assert_eq!((shape.report.bodies, shape.report.bodies_dropped), (2, 1));
    assert_eq!(shape.report.solid_cells, 6);
    assert!(shape.report.touches_border);

    let shape = Shape::from_mask(&mask, &layout(dims), &all(), &run).unwrap();
    assert_eq!(voxels(&shape).dims, [5, 4, 2]);
    assert_eq!((shape.report.bodies, shape.report.bodies_dropped), (2, 0));
    assert_eq!(shape.report.solid_cells, 8);
}

#[test]
fn the_largest_body_is_cropped_to_its_own_box() {
    // The larger body is not the first; the frame must follow it.
    let mut mask = vec![0u8; 10];
    for i in [0, 4, 5, 6] {
        mask[i] = 1;
    }
    let largest = ImportOptions { bodies: Bodies::Largest, ..ImportOptions::default() };
    let shape = Shape::from_mask(&mask, &layout([10, 1, 1]), &largest, &Run::serial()).unwrap();
    assert_eq!(voxels(&shape).dims, [3, 1, 1]);
    assert_eq!(shape.report.box_min, [4.0, 0.0, 0.0]);
    assert_eq!(shape.report.box_max, [7.0, 1.0, 1.0]);
    assert_eq!(shape.frame.offset.as_slice(), [4.0, 0.0, 0.0]);
}

#[test]
fn dust_is_counted_in_the_refusal() {
    let mut mask = vec![0u8; 9 * 9 * 9];
    for c in 0..27 {
        mask[3 + c % 3 + 9 * (3 + c / 3 % 3 + 9 * (3 + c / 9))] = 1;
    }
    mask[0] = 1;
    mask[8] = 1;
    let refused =
        Shape::from_mask(&mask, &layout([9; 3]), &ImportOptions::default(), &Run::serial());
    let Err(Error::SeveralBodies(text)) = refused else { panic!("{refused:?}") };
    assert!(text.contains("3 separate bodies, 2 of them single cells"), "{text}");
}

#[test]
fn diagonal_neighbours_are_two_bodies() {
    for b in [3, 5, 6, 7] {
        let mut mask = [0u8; 8];
        mask[0] = 1;
        mask[b] = 1;
        let r = Shape::from_mask(&mask, &layout([2; 3]), &all(), &Run::serial()).unwrap().report;
        assert_eq!(r.bodies, 2, "cells 0 and {b}");
    }
}

#[test]
fn bad_layouts_are_refused_by_name() {
    let run = Run::serial();
    let options = ImportOptions::default();
    let with = |change: &dyn Fn(&mut Layout)| {
        let mut l = layout([2, 2, 2]);
        change(&mut l);
        Shape::from_mask(&[1; 8], &l, &options, &run).unwrap_err()
    };
    let cases = [
        (with(&|l| l.dims = [2, 2, 3]), 2, "12"),
        (with(&|l| l.dims = [usize::MAX, 2, 3]), 17, "more than can be counted"),
        (with(&|l| l.spacing[1] = f64::NAN), 3, "spacing along y is NaN"),
        (with(&|l| l.spacing[2] = 0.0), 2, "spacing along z is 0"),
        (with(&|l| l.spacing[0] = -1.0), 2, "spacing along x is -1"),
        (with(&|l| l.origin[0] = f64::INFINITY), 3, "origin along x is inf"),
        (with(&|l| l.spacing[0] = 1e300), 2, "1e60"),
        (with(&|l| l.spacing = [9e59; 3]), 2, "1e60"),
        (with(&|l| l.origin[1] = -1e300), 2, "origin along y"),
        (with(&|l| l.spacing = [1e-70; 3]), 2, "1e-60"),
        (with(&|l| l.spacing[2] = 1e-300), 2, "spacing along z"),
        (with(&|l| l.spacing[1] = 1e-7), 2, "spacing along y"),
    ];
    for (error, status, text) in cases {
        assert_eq!(error.status(), status, "{error}");
        assert!(error.to_string().contains(text), "{error}");
    }
    let empty = Shape::from_mask(&[], &layout([0, 4, 4]), &options, &run).unwrap_err();
    assert!(matches!(empty, Error::Empty(_)), "{empty}");
    let none = Shape::from_mask(&[0; 8], &layout([2; 3]), &options, &run).unwrap_err();
    assert!(matches!(none, Error::Empty(_)), "{none}");
    let tight = ImportOptions { memory_limit: 7, ..ImportOptions::default() };
    let tight = Shape::from_mask(&[1; 8], &layout([2; 3]), &tight, &run).unwrap_err();
    assert!(matches!(tight, Error::MemoryLimit(_)), "{tight}");
    let unit = ImportOptions { length_unit: 0.0, ..ImportOptions::default() };
    let unit = Shape::from_mask(&[1; 8], &layout([2; 3]), &unit, &run).unwrap_err();
    assert!(unit.to_string().contains("length_unit is 0"), "{unit}");
}

#[test]
fn a_power_of_two_changes_only_the_frame() {
    let (mask, dims) = two_blocks();
    let one = Layout { dims, spacing: [0.3, 0.7, 0.11], origin: [0.2, 0.1, -3.3] };
    let a = Shape::from_mask(&mask, &one, &all(), &Run::serial()).unwrap();
    for k in [-40, -3, 5, 40] {
        let f = 2f64.powi(k);
        let two =
            Layout { dims, spacing: one.spacing.map(|v| v * f), origin: one.origin.map(|v| v * f) };
        let b = Shape::from_mask(&mask, &two, &all(), &Run::new(3).unwrap()).unwrap();
        assert_eq!(voxels(&a).spacing, voxels(&b).spacing);
        assert_eq!(voxels(&a).cells, voxels(&b).cells);
        assert_eq!(a.frame.scale * f, b.frame.scale);
        assert_eq!(a.frame.offset * f, b.frame.offset);
    }
}

#[test]
fn grey_values_above_the_threshold_are_solid() {
    let run = Run::serial();
    let l = layout([6, 1, 1]);
    let options = ImportOptions::default();
    let values = [10u16, 11, 500, 501, 499, 9];
    let shape =
        Shape::from_grey(Grey::U16(&values), &l, Threshold::Above(10.0), &options, &run).unwrap();
    assert_eq!((shape.report.solid_cells, shape.report.threshold), (4, 10.0));
    let shape = Shape::from_grey(Grey::U16(&values), &l, Threshold::Otsu, &options, &run).unwrap();
    assert_eq!((shape.report.solid_cells, shape.report.threshold), (3, 11.0));

    let floats = values.map(|v| f32::from(v) / 1000.0 - 0.3);
    let shape = Shape::from_grey(Grey::F32(&floats), &l, Threshold::Otsu, &options, &run).unwrap();
    assert_eq!(shape.report.solid_cells, 3);
    assert_eq!(shape.report.threshold, f64::from(floats[1]));

    let mut bad = floats;
    bad[4] = f32::NAN;
    let e = Shape::from_grey(Grey::F32(&bad), &l, Threshold::Above(0.0), &options, &run);
    assert_eq!(e.unwrap_err(), Error::NotFinite("voxel 4 is NaN".into()));
    for constant in [Grey::U8(&[7; 6]), Grey::U16(&[7; 6]), Grey::F32(&[7.0; 6])] {
        let e = Shape::from_grey(constant, &l, Threshold::Otsu, &options, &run).unwrap_err();
        assert!(e.to_string().contains("every voxel is 7"), "{e}");
    }
    let e = Shape::from_grey(Grey::U8(&[7; 6]), &l, Threshold::Above(7.0), &options, &run);
    assert!(matches!(e, Err(Error::Empty(_))), "{e:?}");
}

/// The variance between the classes "≤ t" and "> t", from its definition.
fn variance_between(values: &[f64], t: f64) -> f64 {
    let (low, high): (Vec<f64>, Vec<f64>) = values.iter().partition(|&&v| v <= t);
    if low.is_empty() || high.is_empty() {
        return -1.0;
    }
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (m, m0, m1) = (mean(values), mean(&low), mean(&high));
    low.len() as f64 * (m0 - m).powi(2) + high.len() as f64 * (m1 - m).powi(2)
}

/// That `found` is a threshold of greatest variance, but for `slack`.
fn assert_greatest(values: &[f64], found: morula::Result<f64>, slack: f64) {
    let best = values.iter().map(|&t| variance_between(values, t)).fold(-1.0, f64::max);
    match found {
        Ok(t) => {
            let v = variance_between(values, t);
            assert!(v >= best * (1.0 - slack), "{v} at {t}, best {best}");
        }
        Err(e) => assert!(best < 0.0, "{e}"),
    }
}

/// The area of the cells' outer faces, counted one by one.
fn face_area(mask: &[u8], dims: [usize; 3], spacing: [f64; 3]) -> f64 {
    let at = |p: [i64; 3]| {
        (0..3).all(|a| p[a] >= 0 && p[a] < dims[a] as i64)
            && mask[p[0] as usize + dims[0] * (p[1] as usize + dims[1] * p[2] as usize)] != 0
    };
    let mut area = 0.0;
    for c in 0..mask.len() {
        let p = [c % dims[0], c / dims[0] % dims[1], c / dims[0] / dims[1]].map(|v| v as i64);
        for (a, s) in [(0, -1), (0, 1), (1, -1), (1, 1), (2, -1), (2, 1)] {
            let mut q = p;
            q[a] += s;
            if at(p) && !at(q) {
                area += spacing[(a + 1) % 3] * spacing[(a + 2) % 3];
            }
        }
    }
    area
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn volume_is_cells_times_cell_volume(
        dims in [1usize..12, 1usize..9, 1usize..7],
        values in proptest::collection::vec(0u8..3, 12 * 9 * 7),
        spacing in [0.01..10.0, 0.01..10.0, 0.01..10.0f64],
    ) {
        let mask = &values[..dims.iter().product()];
        let count = mask.iter().filter(|&&v| v != 0).count();
        let layout = Layout { dims, spacing, origin: [0.0; 3] };
        let shape = Shape::from_mask(mask, &layout, &all(), &Run::serial());
        if count == 0 {
            prop_assert!(matches!(shape, Err(Error::Empty(_))));
        } else {
            let shape = shape.unwrap();
            let volume = count as f64 * spacing[0] * spacing[1] * spacing[2];
            prop_assert!((shape.report.volume - volume).abs() <= 1e-12 * volume);
            let area = face_area(mask, dims, spacing);
            prop_assert!((shape.report.area - area).abs() <= 1e-12 * area);
            let v = voxels(&shape);
            prop_assert_eq!(v.cells.iter().filter(|&&c| c == 1).count(), count);
        }
    }

    #[test]
    fn otsu_has_the_greatest_variance(
        low in proptest::collection::vec(0u16..400, 1..60),
        high in proptest::collection::vec(200u16..1200, 1..60),
    ) {
        let values: Vec<u16> = low.into_iter().chain(high).collect();
        let wide: Vec<f64> = values.iter().map(|&v| f64::from(v)).collect();
        assert_greatest(&wide, otsu(Grey::U16(&values)), 1e-12);
        let bytes: Vec<u8> = values.iter().map(|v| (v / 5) as u8).collect();
        let wide: Vec<f64> = bytes.iter().map(|&v| f64::from(v)).collect();
        assert_greatest(&wide, otsu(Grey::U8(&bytes)), 1e-12);
        // Bins of single precision move a value by less than one bin.
        let floats: Vec<f32> = values.iter().map(|&v| f32::from(v) * 0.37 - 55.0).collect();
        let wide: Vec<f64> = floats.iter().map(|&v| f64::from(v)).collect();
        assert_greatest(&wide, otsu(Grey::F32(&floats)), 20.0 / F32_BINS as f64);
    }

    #[test]
    fn labels_are_listed_and_taken_one_by_one(
        dims in [1usize..8, 1usize..7, 1usize..6],
        values in proptest::collection::vec(0usize..5, 8 * 7 * 6),
    ) {
        let names = [0, 7, 3, 4_000_000_000, 0];
        let labels: Vec<u32> =
            values[..dims.iter().product()].iter().map(|&v| names[v]).collect();
        let l = layout(dims);
        let list = list_labels(&labels, &l).unwrap();
        let mut expected: Vec<u32> = labels.iter().copied().filter(|&v| v != 0).collect();
        expected.sort();
        expected.dedup();
        prop_assert_eq!(list.iter().map(|i| i.label).collect::<Vec<_>>(), expected);
        for info in list {
            let shape = Shape::from_label(&labels, &l, info.label, &all(), &Run::serial()).unwrap();
            prop_assert_eq!(shape.report.solid_cells, info.cells);
            prop_assert_eq!(shape.report.touches_border, info.touches_border);
            prop_assert_eq!(shape.report.box_min, info.first.map(|v| v as f64));
            prop_assert_eq!(shape.report.box_max, info.last.map(|v| (v + 1) as f64));
        }
    }
}

#[test]
fn labels_that_are_not_there_are_named() {
    let l = layout([3, 1, 1]);
    let run = Run::serial();
    let take = |label| Shape::from_label(&[0, 5, 5], &l, label, &ImportOptions::default(), &run);
    assert!(matches!(take(0), Err(Error::InvalidArgument(t)) if t.contains("label 0")));
    assert!(matches!(take(6), Err(Error::IndexOutOfRange(t)) if t.contains("label 6")));
    assert_eq!(take(5).unwrap().report.solid_cells, 2);
    assert_eq!(widen_labels(&[0u8, 5, 255]).unwrap(), [0, 5, 255]);
    assert_eq!(widen_labels(&[0u16, 5, 65535]).unwrap(), [0, 5, 65535]);
}

#[test]
fn a_cancel_stops_the_import() {
    let run = Run::serial().with_progress(Box::new(|_| true));
    let e = Shape::from_mask(&[1; 8], &layout([2; 3]), &ImportOptions::default(), &run);
    assert!(matches!(e, Err(Error::Cancelled(_))), "{e:?}");
}
