//! Meshes from arrays: checks, welding, repair, report.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use morula::shape::{Body, ImportOptions};
use morula::{Error, Run, Shape};

type Arrays = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A unit cube with its lower corner at `at`.
fn cube(at: [f64; 3], edge: f64) -> Arrays {
    let v = (0..8)
        .map(|i| {
            let bit = |k: usize| if i >> k & 1 == 1 { edge } else { 0.0 };
            [at[0] + bit(0), at[1] + bit(1), at[2] + bit(2)]
        })
        .collect();
    let f = vec![
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
    ];
    (v, f)
}

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
        let Body::Mesh(mesh) = &s.body else { panic!("not a mesh") };
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
