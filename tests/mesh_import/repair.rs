//! Welding, faces that are none or there twice, orientation, T-junctions.

use super::*;

#[test]
fn seams_close_within_the_tolerance_and_no_farther() {
    let seam = |gap: f64| {
        let mut m = soup(&ball(12, 24));
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
    let mut m = ball(8, 16);
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
    let one = import(&ball(8, 16)).unwrap().report;
    for m in [
        join(&[ball(8, 16), ball(8, 16)]),
        join(&[ball(8, 16), turned(ball(8, 16))]),
        join(&[ball(8, 16), ball(8, 16), turned(ball(8, 16))]),
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
fn a_t_junction_is_closed_to_the_winding_number() {
    let mut m = cube([0.0; 3], 1.0);
    m.0.push([0.5, 0.0, 1.0]);
    let top = m.1.iter().position(|f| *f == [4, 5, 7]).unwrap();
    m.1[top] = [4, 8, 7];
    m.1.push([8, 5, 7]);
    let s = import(&m).unwrap();
    assert!(!s.report.watertight && !mesh(&s).clean);
    assert_eq!((s.report.boundary_edges, s.report.volume), (3, 1.0));
    assert!(has_note(&s, "edges with one face: 3, with more than two: 0"));
}

/// A cube with an edge that the faces at it cut at different places, and faces without area
/// between them, from ears of the slit that `ear` chooses.
fn slit(cuts: [u32; 2], ear: &mut dyn FnMut(usize) -> usize) -> Arrays {
    let mut m = cube([0.0; 3], 1.0);
    let mut slit = Vec::new();
    for n in cuts {
        let at = m.1.iter().position(|f| f.contains(&0) && f.contains(&1)).unwrap();
        let mut f = m.1.remove(at);
        while f[0] > 1 || f[1] > 1 {
            f.rotate_left(1);
        }
        // Along the face from 0 to 1 or back: the faces of the slit run the other way.
        let mut line = vec![f[0]];
        for i in 1..=n {
            let x = f64::from(i) / f64::from(n + 1);
            line.push(m.0.len() as u32);
            m.0.push([if f[0] == 0 { x } else { 1.0 - x }, 0.0, 0.0]);
        }
        slit.extend(line.iter().rev());
        line.push(f[1]);
        m.1.extend(line.windows(2).map(|w| [w[0], w[1], f[2]]));
    }
    while slit.len() > 2 {
        let (n, i) = (slit.len(), ear(slit.len()));
        m.1.push([slit[(i + n - 1) % n], slit[i], slit[(i + 1) % n]]);
        slit.remove(i);
    }
    m
}

#[test]
fn chains_of_faces_without_area_open_nothing() {
    let mut k = 0usize;
    let mut ears: [&mut dyn FnMut(usize) -> usize; 4] =
        [&mut |_| 1, &mut |n| n / 2, &mut |n| n - 1, &mut |n| {
            k = (k * 137 + 71) % 9973;
            k % n
        }];
    for cuts in [[300, 0], [0, 40], [299, 196]] {
        for (e, ear) in ears.iter_mut().enumerate() {
            let m = slit(cuts, ear);
            let r = import(&m).unwrap().report;
            assert!(r.watertight && r.oriented, "{cuts:?} {e}: {r:?}");
            assert_eq!(r.degenerate_faces, u64::from(cuts[0] + cuts[1]), "{cuts:?} {e}");
            assert_eq!((r.faces as usize, r.volume), (m.1.len(), 1.0));
        }
    }
    // A ribbon lower than the tolerance hangs on to nothing.
    let mut m = cube([0.0; 3], 1.0);
    let first = m.0.len() as u32;
    for i in 0..102 {
        m.0.push([0.2, 0.005 * f64::from(i), if i % 2 == 0 { 0.5 } else { 0.5 + 1e-8 }]);
        if i >= 2 {
            m.1.push([first + i - 2, first + i - 1, first + i]);
        }
    }
    let r = import(&m).unwrap().report;
    assert_eq!((r.faces, r.degenerate_faces, r.components), (12, 100, 1));
}

#[test]
fn edges_cut_beside_their_ends_open_nothing() {
    // Not welded: the surface is closed as it is.
    for distance in [1e-15, 1e-12, 5e-11] {
        let mut m = ball(12, 24);
        for k in (0..m.1.len()).step_by(3) {
            // The other face at the edge of the face from a to b.
            let [a, b, c] = m.1[k];
            let other = |f: &[u32; 3]| f.contains(&a) && f.contains(&b) && !f.contains(&c);
            let Some(o) = m.1.iter().position(other) else { continue };
            let n = m.0.len() as u32;
            let [p, q] = [a, b].map(|v| m.0[v as usize]);
            m.0.push([0, 1, 2].map(|i| p[i] + distance * (q[i] - p[i])));
            let with = |f: [u32; 3], from: u32| f.map(|v| if v == from { n } else { v });
            m.1.extend([with([a, b, c], a), with(m.1[o], a)]);
            (m.1[k], m.1[o]) = ([a, n, c], with(m.1[o], b));
        }
        let r = import(&m).unwrap().report;
        let (volume, whole) = (r.volume, import(&ball(12, 24)).unwrap().report.volume);
        assert!(r.watertight && r.oriented && (volume - whole).abs() < 1e-9, "{r:?}");
        assert_eq!(r.degenerate_faces + r.faces, m.1.len() as u64, "{distance}");
    }
}
