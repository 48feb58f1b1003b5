//! Meshes from arrays: checks, welding, repair, report.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Arrays, cube};
use morula::shape::{Bodies, Body, ImportOptions, Mesh};
use morula::{Error, Run, Shape};

/// Every face with corners of its own, as STL has them.
fn soup(m: &Arrays) -> Arrays {
    let v: Vec<_> = m.1.iter().flatten().map(|&i| m.0[i as usize]).collect();
    let f = (0..m.1.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    (v, f)
}

fn import(m: &Arrays) -> Result<Shape, Error> {
    Shape::from_mesh(&m.0, &m.1, &ImportOptions::default(), &Run::serial())
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

fn with(m: &Arrays, change: impl FnOnce(&mut ImportOptions)) -> Result<Shape, Error> {
    let mut options = ImportOptions::default();
    change(&mut options);
    Shape::from_mesh(&m.0, &m.1, &options, &Run::serial())
}

fn mesh(s: &Shape) -> &Mesh {
    let Body::Mesh(mesh) = &*s.body else { panic!("not a mesh") };
    mesh
}

fn join(parts: &[Arrays]) -> Arrays {
    let mut all = (Vec::new(), Vec::new());
    for (v, f) in parts {
        let base = all.0.len() as u32;
        all.0.extend(v);
        all.1.extend(f.iter().map(|f| f.map(|i| i + base)));
    }
    all
}

fn turned(mut m: Arrays) -> Arrays {
    m.1.iter_mut().for_each(|f| f.swap(1, 2));
    m
}

/// A sphere of rings, poles at the ends, radius 1.
fn sphere(rings: usize, segments: usize) -> Arrays {
    use std::f64::consts::PI;
    let mut v = vec![[0.0, 0.0, 1.0]];
    for i in 1..rings {
        let t = PI * i as f64 / rings as f64;
        for j in 0..segments {
            let p = 2.0 * PI * j as f64 / segments as f64;
            v.push([t.sin() * p.cos(), t.sin() * p.sin(), t.cos()]);
        }
    }
    v.push([0.0, 0.0, -1.0]);
    let at = |i: usize, j: usize| (1 + (i - 1) * segments + j % segments) as u32;
    let last = v.len() as u32 - 1;
    let mut f = Vec::new();
    for j in 0..segments {
        f.push([0, at(1, j), at(1, j + 1)]);
        for i in 1..rings - 1 {
            f.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            f.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
        f.push([last, at(rings - 1, j + 1), at(rings - 1, j)]);
    }
    (v, f)
}

fn has_note(s: &Shape, words: &str) -> bool {
    s.report.notes.iter().any(|n| n.contains(words))
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
fn seams_close_within_the_tolerance_and_no_farther() {
    let seam = |gap: f64| {
        let mut m = soup(&sphere(12, 24));
        for (i, v) in m.0.iter_mut().enumerate() {
            for (k, x) in v.iter_mut().enumerate() {
                *x += gap * ((i * 3 + k) as f64 * 12.9898).sin();
            }
        }
        import(&m).unwrap()
    };
    let s = seam(2e-7);
    assert!(s.report.watertight && mesh(&s).clean);
    assert_eq!(s.report.vertices, 2 + 11 * 24);
    assert!(has_note(&s, "welded"));
    // Ten times the tolerance: open by its edges, closed to the winding number.
    let s = seam(2e-5);
    assert!(!s.report.watertight && !mesh(&s).clean && s.report.boundary_edges > 0);
    assert_eq!((s.report.bodies, s.report.faces), (1, 2 * 11 * 24));
    assert!((s.report.volume - seam(0.0).report.volume).abs() < 1e-3);
}

#[test]
fn a_closed_surface_is_not_welded_further() {
    // A plate thinner than the tolerance: welding would glue its sides together.
    let mut m = cube([0.0; 3], 1.0);
    m.0.iter_mut().for_each(|v| v[2] *= 1e-7);
    let s = import(&m).unwrap();
    assert_eq!((s.report.welded_vertices, s.report.faces), (0, 12));
    assert!(s.report.watertight && (s.report.volume - 1e-7).abs() < 1e-19);
    let s = import(&soup(&m)).unwrap();
    assert_eq!((s.report.welded_vertices, s.report.faces), (28, 12));
}

#[test]
fn faces_without_area_go_and_leave_no_hole() {
    // A vertex in the middle of an edge, stitched in with a face without area.
    let mut m = cube([0.0; 3], 1.0);
    m.0.push([0.5, 0.0, 0.0]);
    let bottom = m.1.iter().position(|f| *f == [0, 3, 1]).unwrap();
    m.1[bottom] = [0, 3, 8];
    m.1.push([8, 3, 1]);
    m.1.push([0, 8, 1]);
    let s = import(&m).unwrap();
    assert_eq!((s.report.degenerate_faces, s.report.faces), (1, 14));
    assert!(s.report.watertight && mesh(&s).clean && s.report.volume == 1.0);
    // Points and lines that hang on to a face.
    let mut m = sphere(8, 16);
    let faces = m.1.clone();
    for (k, f) in faces.iter().enumerate().step_by(3) {
        let [a, b] = [f[0], f[1]].map(|i| m.0[i as usize]);
        let n = m.0.len() as u32;
        m.0.push([0, 1, 2].map(|i| (a[i] + b[i]) / 2.0));
        m.1.push(if k % 2 == 0 { [f[0], f[1], n] } else { [f[0], f[0], f[1]] });
    }
    let s = import(&m).unwrap();
    assert_eq!(s.report.faces as usize, faces.len());
    assert_eq!(s.report.degenerate_faces as usize, faces.len().div_ceil(3));
    assert!(s.report.watertight && s.report.oriented && has_note(&s, "without area"));
}

#[test]
fn duplicates_are_dropped_and_inner_walls_taken_out() {
    let one = import(&sphere(8, 16)).unwrap().report;
    for m in [
        join(&[sphere(8, 16), sphere(8, 16)]),
        join(&[sphere(8, 16), turned(sphere(8, 16))]),
        join(&[sphere(8, 16), sphere(8, 16), turned(sphere(8, 16))]),
    ] {
        let r = import(&m).unwrap().report;
        assert_eq!((r.faces, r.bodies), (one.faces, 1));
        assert_eq!(r.duplicate_faces as usize, m.1.len() - one.faces as usize);
        assert!(r.watertight && r.oriented && (r.volume - one.volume).abs() < 1e-12);
    }
    // Two cubes that share a wall: one box. The walls' diagonals agree.
    let s = import(&join(&[cube([0.0; 3], 1.0), cube([1.0, 0.0, 0.0], 1.0)])).unwrap();
    let diagonals_agree = s.report.duplicate_faces == 4;
    assert!(diagonals_agree || !s.report.watertight);
    assert_eq!((s.report.bodies, s.report.volume), (1, 2.0));
    // A hole covered by two opposed faces is covered once.
    let mut m = cube([0.0; 3], 1.0);
    let f = m.1[4];
    m.1.push([f[0], f[2], f[1]]);
    let s = import(&m).unwrap();
    assert_eq!((s.report.faces, s.report.duplicate_faces), (12, 1));
    assert!(s.report.watertight && s.report.volume == 1.0);
}

#[test]
fn orientation_is_repaired_and_reported() {
    let r = import(&turned(cube([0.0; 3], 1.0))).unwrap().report;
    assert!(r.inverted && r.faces_turned == 0 && r.volume == 1.0);
    let mut m = cube([0.0; 3], 1.0);
    for i in [1, 5, 8] {
        m.1[i].swap(0, 1);
    }
    let r = import(&m).unwrap().report;
    assert!(!r.inverted && r.oriented && r.faces_turned == 3 && r.volume == 1.0);
    // Most faces are wrong: these are turned, not the others.
    let r = import(&turned(m)).unwrap().report;
    assert!(!r.inverted && r.oriented && r.faces_turned == 9 && r.volume == 1.0);
}

#[test]
fn cavities_stay_and_nests_turn_as_a_whole() {
    let shell = join(&[cube([0.0; 3], 4.0), turned(cube([1.0; 3], 2.0))]);
    for m in [shell.clone(), turned(shell.clone())] {
        let s = import(&m).unwrap();
        assert_eq!((s.report.components, s.report.bodies), (2, 1));
        assert_eq!(s.report.volume, 64.0 - 8.0);
        assert_eq!(s.report.inverted, m != shell);
        assert!(mesh(&s).clean);
    }
    // Both outward: filled, and said so.
    let s = import(&join(&[cube([0.0; 3], 4.0), cube([1.0; 3], 2.0)])).unwrap();
    assert_eq!(s.report.bodies, 1);
    assert!(has_note(&s, "within one another"));
    // A body in the cavity is another body, and faces outward whatever it did.
    for core in [cube([1.5; 3], 1.0), turned(cube([1.5; 3], 1.0))] {
        let m = join(&[shell.clone(), core]);
        assert!(matches!(import(&m), Err(Error::SeveralBodies(s)) if s.contains("2 separate")));
        let all = with(&m, |o| o.bodies = Bodies::All).unwrap();
        assert_eq!((all.report.volume, all.report.bodies, all.report.faces), (57.0, 2, 36));
        let largest = with(&m, |o| o.bodies = Bodies::Largest).unwrap();
        assert_eq!((largest.report.volume, largest.report.bodies_dropped), (56.0, 1));
    }
}

#[test]
fn bodies_are_counted_by_what_joins_them() {
    let bodies = |parts: &[Arrays]| with(&join(parts), |o| o.bodies = Bodies::All).unwrap().report;
    let at = |x: f64, y: f64, z: f64| cube([x, y, z], 1.0);
    let apart = bodies(&[at(0.0, 0.0, 0.0), at(3.0, 0.0, 0.0), at(0.0, 3.0, 0.0)]);
    assert_eq!((apart.bodies, apart.volume), (3, 3.0));
    assert_eq!(bodies(&[at(0.0, 0.0, 0.0), at(0.5, 0.5, 0.5)]).bodies, 1);
    // Two bars across each other, flush: no corner of one lies in the other.
    let bar = |edges: [f64; 3]| {
        let mut m = cube([-0.5; 3], 1.0);
        m.0.iter_mut().for_each(|v| (0..3).for_each(|k| v[k] *= edges[k]));
        m
    };
    assert_eq!(bodies(&[bar([4.0, 1.0, 1.0]), bar([1.0, 4.0, 1.0])]).bodies, 1);
    assert_eq!(bodies(&[bar([4.0, 1.0, 1.0]), bar([1.0, 4.0, 0.6])]).bodies, 1);
    // Touching in a point, along an edge, in part of a face.
    assert_eq!(bodies(&[at(0.0, 0.0, 0.0), at(1.0, 1.0, 1.0)]).bodies, 2);
    assert_eq!(bodies(&[at(0.0, 0.0, 0.0), at(1.0, 1.0, 0.0)]).bodies, 2);
    assert_eq!(bodies(&[at(0.0, 0.0, 0.0), at(1.0, 0.3, 0.4)]).bodies, 1);
    // `Largest` keeps the body, not its neighbour, and its frame.
    let m = join(&[at(0.0, 0.0, 0.0), cube([9.0, 0.0, 0.0], 2.0)]);
    let s = with(&m, |o| o.bodies = Bodies::Largest).unwrap();
    assert_eq!((s.report.volume, s.report.bodies, s.report.bodies_dropped), (8.0, 2, 1));
    assert_eq!((s.report.box_min, s.frame.scale), ([9.0, 0.0, 0.0], 2.0));
    assert!(has_note(&s, "of 2 bodies the largest was kept"));
}

#[test]
fn openings_are_judged() {
    let without = |m: &Arrays, drop: &dyn Fn([f64; 3]) -> bool| {
        let middle = |f: &[u32; 3]| {
            let sum = f.iter().fold([0.0; 3], |s, &i| [0, 1, 2].map(|k| s[k] + m.0[i as usize][k]));
            sum.map(|x| x / 3.0)
        };
        (m.0.clone(), m.1.iter().copied().filter(|f| !drop(middle(f))).collect::<Vec<_>>())
    };
    let ball = sphere(24, 48);
    // A hole, half a ball, a box without a lid: closed flat, and said so.
    for (m, volume) in [
        (without(&ball, &|p| p[2] > 0.95), 4.16),
        (without(&ball, &|p| p[2] > 0.0), 2.08),
        (without(&cube([0.0; 3], 1.0), &|p| p[2] == 1.0), 1.0),
    ] {
        let s = import(&m).unwrap();
        assert!(!s.report.watertight && !mesh(&s).clean && has_note(&s, "the surface is open"));
        assert!((s.report.volume - volume).abs() < 0.02, "{} {volume}", s.report.volume);
    }
    // A shallow cap, a wavy sheet, faces at random: no inside.
    let cap = without(&ball, &|p| p[2] < 0.93);
    assert!(matches!(import(&cap), Err(Error::OpenSurface(s)) if s.contains("more than 40 %")));
    let mut sheet = (Vec::new(), Vec::new());
    for i in 0..20 {
        for j in 0..20 {
            let (x, y) = (f64::from(i), f64::from(j));
            sheet.0.push([x, y, (x * 0.7).sin() * (y * 0.9).cos()]);
            if i < 19 && j < 19 {
                let k = (i * 20 + j) as u32;
                sheet.1.extend([[k, k + 20, k + 21], [k, k + 21, k + 1]]);
            }
        }
    }
    assert!(matches!(import(&sheet), Err(Error::OpenSurface(_))));
    assert!(matches!(
        import(&(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]])),
        Err(Error::ZeroVolume(s)) if s.contains("one plane")
    ));
    // A two-sided square.
    let square = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let both = vec![[0, 1, 2], [0, 2, 3], [0, 2, 1], [0, 3, 2]];
    assert!(matches!(import(&(square, both)), Err(Error::ZeroVolume(_))));
    // A loose sheet beside a body goes; the faces of a cube, a little apart, stay.
    let s = import(&join(&[cube([0.0; 3], 40.0), sheet.clone()])).unwrap();
    assert!(s.report.watertight && has_note(&s, "loose sheets"));
    let mut apart = soup(&cube([0.0; 3], 1.0));
    for (k, v) in apart.0.iter_mut().enumerate() {
        let push = 1e-4 * ((k / 6) as f64 - 2.0);
        v.iter_mut().for_each(|x| *x += push);
    }
    let s = import(&apart).unwrap();
    assert_eq!((s.report.bodies, s.report.faces), (1, 12));
    assert!((s.report.volume - 1.0).abs() < 0.01, "{}", s.report.volume);
}

#[test]
fn a_t_junction_is_closed_to_the_winding_number() {
    let mut m = cube([0.0; 3], 1.0);
    m.0.push([0.5, 0.0, 1.0]);
    let top = m.1.iter().position(|f| *f == [4, 5, 7]).unwrap();
    m.1[top] = [4, 8, 7];
    m.1.push([8, 5, 7]);
    let s = import(&m).unwrap();
    assert!(!s.report.watertight && !mesh(&s).clean);
    assert_eq!((s.report.boundary_edges, s.report.volume), (3, 1.0));
    assert!(has_note(&s, "3 edges have one face"));
}

#[test]
fn scale_and_exact_shifts_change_no_bit() {
    // A seam, a duplicate, a turned face, an opening: every repair is at work.
    let mut m = soup(&sphere(12, 24));
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

#[test]
fn many_cavities_and_one_that_breaks_through() {
    let mut m = cube([0.0; 3], 10.0);
    let mut add = |at: [f64; 3]| {
        let (v, f) = cube(at, 0.5);
        let base = m.0.len() as u32;
        m.0.extend(v);
        m.1.extend(f.iter().map(|f| [f[0] + base, f[2] + base, f[1] + base]));
    };
    for n in 0..512 {
        add([n % 8, n / 8 % 8, n / 64].map(|k| 1.0 + f64::from(k)));
    }
    let s = import(&m).unwrap();
    assert_eq!((s.report.components, s.report.bodies), (513, 1));
    assert!((s.report.volume - (1000.0 - 512.0 * 0.125)).abs() < 1e-9, "{}", s.report.volume);
    assert!(!s.report.inverted && s.report.faces_turned == 0);
    // A body across the outer wall is one with it.
    let (v, f) = cube([9.75, 5.6, 5.6], 0.4);
    let base = m.0.len() as u32;
    m.0.extend(v);
    m.1.extend(f.iter().map(|f| f.map(|i| i + base)));
    let s = import(&m).unwrap();
    assert_eq!((s.report.components, s.report.bodies), (514, 1));
}
