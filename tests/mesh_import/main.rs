//! Meshes from arrays: checks, welding, repair, report.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod bodies;
#[path = "../common/mod.rs"]
mod common;
mod repair;

use common::{Arrays, add, cube, join, soup, sphere, turned};
use morula::shape::{Bodies, Body, ImportOptions, Mesh};
use morula::{Error, Run, Shape};

fn import(m: &Arrays) -> Result<Shape, Error> {
    Shape::from_mesh(&m.0, &m.1, &ImportOptions::default(), &Run::serial())
}

fn with(m: &Arrays, change: impl FnOnce(&mut ImportOptions)) -> Result<Shape, Error> {
    let mut options = ImportOptions::default();
    change(&mut options);
    Shape::from_mesh(&m.0, &m.1, &options, &Run::serial())
}

fn mesh(s: &Shape) -> &Mesh {
    let Body::Mesh(mesh) = &*s.body else { panic!("not a mesh") };
    mesh
}

/// A sphere of radius 1 about the origin.
fn ball(rings: usize, segments: usize) -> Arrays {
    sphere(rings, segments, 1.0, [0.0; 3])
}

fn has_note(s: &Shape, words: &str) -> bool {
    s.report.notes.iter().any(|n| n.contains(words))
}

#[test]
fn a_cube_is_clean() {
    for m in [cube([3.0, -2.0, 1.0], 2.0), soup(&cube([3.0, -2.0, 1.0], 2.0))] {
        let s = import(&m).unwrap();
        let r = &s.report;
        assert_eq!((r.vertices, r.faces, r.components, r.bodies), (8, 12, 1, 1));
        assert!(r.watertight && r.oriented && !r.inverted);
        assert_eq!((r.boundary_edges, r.nonmanifold_edges), (0, 0));
        assert_eq!((r.volume, r.area), (8.0, 24.0));
        assert_eq!((r.box_min, r.box_max), ([3.0, -2.0, 1.0], [5.0, 0.0, 3.0]));
        assert!(r.notes.is_empty(), "{:?}", r.notes);
        let Body::Mesh(mesh) = &*s.body else { panic!("not a mesh") };
        assert!(mesh.clean);
    }
}

#[test]
fn faults_name_value_and_index() {
    let mut m = cube([0.0; 3], 1.0);
    m.0[5][1] = f64::NAN;
    let e = import(&m).unwrap_err();
    assert!(matches!(&e, Error::NotFinite(s) if s.contains("vertex 5 has y = NaN")), "{e}");
    let mut m = cube([0.0; 3], 1.0);
    m.1[3][2] = 8;
    let e = import(&m).unwrap_err();
    assert!(matches!(&e, Error::IndexOutOfRange(s) if s.contains("face 3 names vertex 8")), "{e}");
    let (v, _) = cube([0.0; 3], 1.0);
    assert!(matches!(import(&(v, vec![])).unwrap_err(), Error::Empty(_)));
    assert!(matches!(import(&cube([0.0; 3], 1e70)).unwrap_err(), Error::InvalidArgument(_)));
    assert!(matches!(import(&cube([1.0; 3], 0.0)).unwrap_err(), Error::ZeroVolume(_)));
}

#[test]
fn options_are_checked() {
    let m = cube([0.0; 3], 1.0);
    for t in [-1e-9, 0.1, f64::NAN] {
        let e = with(&m, |o| o.weld_tolerance = t).unwrap_err();
        assert!(matches!(&e, Error::InvalidArgument(s) if s.contains("weld_tolerance")), "{e}");
    }
    for u in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let e = with(&m, |o| o.length_unit = u).unwrap_err();
        assert!(matches!(&e, Error::InvalidArgument(s) if s.contains("length_unit")), "{e}");
    }
    let e = with(&m, |o| o.memory_limit = 1000).unwrap_err();
    assert!(matches!(&e, Error::MemoryLimit(s) if s.contains("1000")), "{e}");
    let s = with(&m, |o| o.length_unit = 0.001).unwrap();
    assert!((s.report.volume - 1e-9).abs() < 1e-21 && s.report.length_unit == 0.001);
    assert!(has_note(&s, "multiplied by 0.001"));
}

#[test]
fn a_cancel_is_obeyed() {
    let m = cube([0.0; 3], 1.0);
    let run = Run::serial().with_progress(Box::new(|_| true));
    let e = Shape::from_mesh(&m.0, &m.1, &ImportOptions::default(), &run).unwrap_err();
    assert!(matches!(e, Error::Cancelled(_)));
}

#[test]
fn scale_and_exact_shifts_change_no_bit() {
    // A seam, a duplicate, a turned face, an opening: every repair is at work.
    let mut m = soup(&ball(12, 24));
    for (i, v) in m.0.iter_mut().enumerate() {
        v.iter_mut().for_each(|x| *x = (*x * 1048576.0).round() / 1048576.0);
        v[0] += if i % 2 == 0 { 2f64.powi(-22) } else { 0.0 };
    }
    m.1[7].swap(0, 1);
    m.1.push(m.1[20]);
    m.1.remove(40);
    let base = import(&m).unwrap();
    assert!(!base.report.notes.is_empty());
    for (power, shift) in [(40, 0.0), (-40, 0.0), (3, 0.0), (0, 4096.0), (20, 2f64.powi(40))] {
        let scale = 2f64.powi(power);
        let moved = m.0.iter().map(|v| v.map(|x| x * scale + shift)).collect();
        let s = import(&(moved, m.1.clone())).unwrap();
        assert_eq!(mesh(&s).vertices, mesh(&base).vertices, "2^{power}, {shift}");
        assert_eq!(mesh(&s).faces, mesh(&base).faces);
        assert_eq!(s.report.volume, base.report.volume * scale.powi(3));
        assert_eq!(s.report.boundary_edges, base.report.boundary_edges);
    }
    let many = Run::new(3).unwrap();
    let s = Shape::from_mesh(&m.0, &m.1, &ImportOptions::default(), &many).unwrap();
    assert_eq!(s.report, base.report);
    assert_eq!(mesh(&s).vertices, mesh(&base).vertices);
}
