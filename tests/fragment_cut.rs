//! Pieces of meshes between planes: against formulas, against each piece's own surface taken in
//! anew, against counted points; and what they add up to.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::fragments::{lack, made, pieces, plane};
use common::{add, cube, cuboid, particle, solid_of_mesh, sphere, turned, winding};
use morula::fragment::{Cut, CutOptions, Fragments, cut, cut_region, shape};
use morula::generate::HalfSpace;
use morula::math::{Moments, Vec3};
use morula::solid::{Resolution, SolidOptions};
use morula::{Error, Run, Solid};
use proptest::prelude::*;
use std::f64::consts::PI;

/// How far a region's moments are from those of its own surface, taken in anew.
fn recomputed(solid: &Solid, f: &Fragments, i: usize) -> f64 {
    let run = Run::serial();
    let own = shape(solid, &f.regions[i], &run).unwrap();
    assert!(own.report.watertight && own.report.oriented, "{:?}", own.report.notes);
    let options = SolidOptions { resolution: Resolution::CellsLongest(8), ..Default::default() };
    let own = Solid::new(&own, &options, &run).unwrap().moments();
    assert_eq!(own.relative_error, 0.0);
    lack(&own, &[f.regions[i].moments(solid.frame())])
}

#[test]
fn a_box_in_eight() {
    let solid = solid_of_mesh(&cuboid([1.0, 2.0, 3.0], [3.0, 5.0, 4.0]), 16);
    let planes = vec![
        plane([2.0, 0.0, 0.0], 3.0),
        plane([0.0, 1.0, 0.0], 3.0),
        plane([0.0, 0.0, -1.0], -3.25),
    ];
    let f = made(&solid, &Cut::Planes(planes));
    assert_eq!((f.regions.len(), f.dust.len(), f.notes.len()), (8, 0, 0));
    for (i, r) in f.regions.iter().enumerate() {
        let x = if i < 4 { [1.0, 1.5] } else { [1.5, 3.0] };
        let y = if i % 4 < 2 { [2.0, 3.0] } else { [3.0, 5.0] };
        let z = if i % 2 == 0 { [3.25, 4.0] } else { [3.0, 3.25] };
        let [lo, hi] = r.bounds(solid.frame());
        for (a, [from, to]) in [x, y, z].into_iter().enumerate() {
            assert!((lo[a] - from).abs() < 1e-14 && (hi[a] - to).abs() < 1e-14, "{i} {lo} {hi}");
        }
        let e = hi - lo;
        let m = r.moments(solid.frame());
        let volume = e.x * e.y * e.z;
        assert!((m.volume / volume - 1.0).abs() < 1e-14);
        assert!((m.centroid - (lo + hi) * 0.5).norm() < 1e-14);
        assert!((m.inertia.xx - volume * (e.y * e.y + e.z * e.z) / 12.0).abs() < 1e-14);
        assert!(m.inertia.xy.abs() < 1e-14);
        assert_eq!((r.half_spaces(solid.frame()).len(), r.cell()), (3, i));
        assert!(r.bytes() < 1024);
        assert!(recomputed(&solid, &f, i) < 1e-12);
    }
    assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-14);
}

#[test]
fn caps_of_a_ball() {
    let solid = solid_of_mesh(&sphere(256, 512, 1.0, [0.0; 3]), 16);
    for d in [-0.9, -0.3, 0.0, 0.1234, 0.7] {
        let n = Vec3::new(0.3, -0.5, 0.4).normalize();
        let f = made(&solid, &Cut::Planes(vec![plane(n.into(), d)]));
        assert_eq!(f.regions.len(), 2);
        let h = 1.0 + d;
        let m = f.regions[0].moments(solid.frame());
        let volume = PI * h * h * (3.0 - h) / 3.0;
        assert!((m.volume / volume - 1.0).abs() < 1e-3, "{d} {}", m.volume / volume);
        let centre = -3.0 * (2.0 - h).powi(2) / (4.0 * (3.0 - h));
        assert!((m.centroid - n * centre).norm() < 1e-3, "{d}");
        assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-12);
    }
}

#[test]
fn planes_that_touch_or_miss() {
    let solid = solid_of_mesh(&cube([0.0; 3], 1.0), 16);
    let whole = solid.moments();
    // Beside it, on a face from both sides, at an edge, at a corner.
    let misses = [
        plane([1.0, 0.0, 0.0], 2.0),
        plane([1.0, 0.0, 0.0], -1e300),
        plane([0.0, 0.0, 1.0], 1.0),
        plane([0.0, 0.0, 1.0], 0.0),
        plane([0.0, 0.0, -1.0], 0.0),
        plane([1.0, 1.0, 0.0], 0.0),
        plane([1.0, 1.0, 1.0], 3.0),
    ];
    for p in misses {
        let f = made(&solid, &Cut::Planes(vec![p]));
        assert_eq!((f.regions.len(), f.dust.len()), (1, 0), "{p:?}");
        assert_eq!(f.notes, ["half-space 0 does not cut the body"]);
        assert!(f.regions[0].half_spaces(solid.frame()).is_empty());
        assert_eq!(f.regions[0].moments(solid.frame()).volume, whole.volume);
    }
    let f = made(&solid, &Cut::Within(vec![plane([1.0, 0.0, 0.0], -0.5)]));
    assert!(f.regions.is_empty() && f.notes == ["cell 0 does not meet the body"]);
    // Through corners and edges.
    for p in [
        plane([1.0, -1.0, 0.0], 0.0),
        plane([1.0, 1.0, 1.0], 1.0),
        plane([1.0, 1.0, 1.0], 2.0),
        plane([1.0, 1.0, -1.0], 0.0),
    ] {
        let f = made(&solid, &Cut::Planes(vec![p]));
        assert_eq!((f.regions.len(), f.dust.len()), (2, 0), "{p:?}");
        assert!(lack(&whole, &pieces(&solid, &f)) < 1e-14);
        let parts =
            if p.offset == 0.0 && p.normal.z == 0.0 { [0.5, 0.5] } else { [1.0 / 6.0, 5.0 / 6.0] };
        let least = f.regions.iter().map(|r| r.moments(solid.frame()).volume).fold(1.0, f64::min);
        assert!((least - parts[0]).abs() < 1e-14, "{p:?} {least}");
        (0..2).for_each(|i| assert!(recomputed(&solid, &f, i) < 1e-12));
    }
    // A step: the plane holds one of its faces and cuts below the other.
    let step = solid_of_mesh(&step_mesh(), 16);
    let f = made(&step, &Cut::Planes(vec![plane([0.0, 0.0, 1.0], 1.0)]));
    let volumes: Vec<f64> = f.regions.iter().map(|r| r.moments(step.frame()).volume).collect();
    assert!((volumes[0] - 2.0).abs() < 1e-14 && (volumes[1] - 1.0).abs() < 1e-14, "{volumes:?}");
    (0..2).for_each(|i| assert!(recomputed(&step, &f, i) < 1e-12));
}

/// A polygon in x and z, counter-clockwise seen from −y, given a thickness of 1 along y.
fn prism(outline: &[[f64; 2]], triangles: &[[u32; 3]]) -> common::Arrays {
    let n = outline.len() as u32;
    let at = |y: f64| outline.iter().map(move |p| [p[0], y, p[1]]);
    let vertices = at(0.0).chain(at(1.0)).collect();
    let mut faces: Vec<[u32; 3]> = triangles.to_vec();
    faces.extend(triangles.iter().map(|t| [t[0] + n, t[2] + n, t[1] + n]));
    for i in 0..n {
        let j = (i + 1) % n;
        faces.push([i, i + n, j + n]);
        faces.push([i, j + n, j]);
    }
    (vertices, faces)
}

fn step_mesh() -> common::Arrays {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    prism(&outline, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
}

/// A U: two prongs of width 1 and a bottom of height 1, with a gap of width 1.
fn u_mesh() -> common::Arrays {
    let outline = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [2.0, 3.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [0.0, 3.0],
    ];
    prism(&outline, &[[0, 1, 4], [1, 2, 3], [1, 3, 4], [0, 4, 5], [0, 5, 7], [5, 6, 7]])
}

#[test]
fn prongs_are_a_region_each() {
    let solid = solid_of_mesh(&u_mesh(), 24);
    let by = |p: Vec<HalfSpace>| made(&solid, &Cut::Planes(p));
    let f = by(vec![plane([0.0, 0.0, 1.0], 2.0)]);
    let volumes: Vec<f64> = f.regions.iter().map(|r| r.moments(solid.frame()).volume).collect();
    assert_eq!(f.regions.len(), 3);
    for (v, expected) in volumes.iter().zip([5.0, 1.0, 1.0]) {
        assert!((v - expected).abs() < 1e-13, "{volumes:?}");
    }
    assert_eq!([0, 1, 2].map(|i| f.regions[i].cell()), [0, 1, 1]);
    (0..3).for_each(|i| assert!(recomputed(&solid, &f, i) < 1e-12));
    assert!(f.regions.iter().all(|r| r.bytes() <= 48 << 10));
    // A plane along the prongs first: its cap is a U as well, and is cut in turn.
    let f = by(vec![plane([0.0, 1.0, 0.0], 0.3), plane([0.0, 0.0, 1.0], 2.0)]);
    assert_eq!(f.regions.len(), 6);
    assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-13);
    (0..6).for_each(|i| assert!(recomputed(&solid, &f, i) < 1e-12));
    // One prong again: the other one stays out of it.
    let prong =
        f.regions.iter().find(|r| r.cell() == 1 && r.bounds(solid.frame())[0].x > 1.5).unwrap();
    let across = Cut::Planes(vec![plane([1.0, 0.0, 0.2], 2.9)]);
    let g = cut_region(&solid, prong, &across, &CutOptions::default(), &Run::serial()).unwrap();
    assert_eq!(g.regions.len(), 2);
    assert!(lack(&prong.moments(solid.frame()), &pieces(&solid, &g)) < 1e-13);
}

#[test]
fn cavities_and_holes() {
    // A ball in a hollow ball, seen as one particle: the shell, and what rattles in it.
    let mut mesh = sphere(24, 48, 1.0, [0.0; 3]);
    add(&mut mesh, &turned(sphere(24, 48, 0.8, [0.0; 3])));
    let hollow = solid_of_mesh(&mesh, 24);
    for d in [0.0, 0.31, 0.79, 0.81, 0.95] {
        let f = made(&hollow, &Cut::Planes(vec![plane([0.1, 0.2, 1.0], d)]));
        assert_eq!((f.regions.len(), f.dust.len()), (2, 0), "{d}");
        assert!(lack(&hollow.moments(), &pieces(&hollow, &f)) < 1e-13);
        (0..2).for_each(|i| assert!(recomputed(&hollow, &f, i) < 1e-11, "{d} {i}"));
    }
    // A second plane cuts the ring that is the first one's cap.
    let f = made(
        &hollow,
        &Cut::Planes(vec![plane([0.1, 0.2, 1.0], 0.2), plane([1.0, 0.3, 0.1], 0.85)]),
    );
    assert_eq!(f.regions.len(), 4);
    (0..4).for_each(|i| assert!(recomputed(&hollow, &f, i) < 1e-11, "{i}"));
    let f =
        made(&hollow, &Cut::Planes(vec![plane([0.1, 0.2, 1.0], 0.2), plane([1.0, 0.3, 0.1], 0.1)]));
    assert_eq!(f.regions.len(), 4);
    assert!(lack(&hollow.moments(), &pieces(&hollow, &f)) < 1e-13);
    let all: f64 = pieces(&hollow, &f).iter().map(|m| m.volume).sum();
    assert!((all / hollow.moments().volume - 1.0).abs() < 1e-13);
}

#[test]
fn a_torus_falls_into_arcs() {
    let solid = particle("torus", 24);
    let f = made(&solid, &Cut::Planes(vec![plane([1.0, 0.0, 0.0], 0.01)]));
    assert_eq!((f.regions.len(), f.dust.len()), (2, 0));
    let f = made(
        &solid,
        &Cut::Planes(vec![plane([1.0, 0.0, 0.0], 0.01), plane([0.0, 1.0, 0.0], 0.02)]),
    );
    assert_eq!((f.regions.len(), f.dust.len()), (4, 0));
    assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-13);
    (0..4).for_each(|i| assert!(recomputed(&solid, &f, i) < 1e-11));
    // A slab across the hole leaves two pieces on each side and two arcs within it.
    let f = made(
        &solid,
        &Cut::Planes(vec![plane([1.0, 0.0, 0.0], -0.05), plane([1.0, 0.0, 0.0], 0.05)]),
    );
    assert_eq!(f.regions.len(), 4, "{:?}", f.notes);
}

#[test]
fn bad_input_is_named() {
    let solid = solid_of_mesh(&cube([0.0; 3], 1.0), 8);
    let good = plane([0.0, 0.0, 1.0], 0.5);
    let said = |by: Cut, words: &[&str]| {
        let e = cut(&solid, &by, &CutOptions::default(), &Run::serial()).unwrap_err();
        let text = e.to_string();
        assert!(words.iter().all(|w| text.contains(w)), "{text}");
        e
    };
    said(Cut::Planes(vec![good, plane([0.0; 3], 1.0)]), &["half-space 1", "length 0"]);
    said(Cut::Within(vec![plane([0.0, f64::NAN, 1.0], 1.0)]), &["half-space 0", "y = NaN"]);
    said(Cut::Planes(vec![plane([0.0, 0.0, 1.0], f64::INFINITY)]), &["half-space 0", "inf"]);
    let points = |p: &[[f64; 3]], w: &[f64]| Cut::Points {
        points: p.iter().map(|p| Vec3::from(*p)).collect(),
        weights: w.to_vec(),
    };
    let [a, b] = [[0.2, 0.3, 0.4], [0.7, 0.3, 0.4]];
    said(points(&[a, b, a], &[]), &["points 0 and 2"]);
    said(points(&[a, [0.0, 0.0, f64::NAN]], &[]), &["point 1", "z = NaN"]);
    said(points(&[a, b], &[0.0]), &["1 weights", "2 points"]);
    said(points(&[a, b], &[0.0, f64::NAN]), &["weight 1 is NaN"]);
    said(points(&[], &[]), &["points is 0"]);
    said(Cut::Seeded { count: 0 }, &["points is 0"]);
    let impact = |direction: [f64; 3]| Cut::Impact {
        point: Vec3::zeros(),
        direction: direction.into(),
        count: 4,
    };
    said(impact([0.0; 3]), &["direction", "length 0"]);
    said(impact([0.0, f64::NAN, 0.0]), &["direction", "y = NaN"]);
    let options = CutOptions { least_volume: f64::NAN };
    let e = cut(&solid, &Cut::Planes(vec![good]), &options, &Run::serial()).unwrap_err();
    assert!(matches!(e, Error::InvalidArgument(t) if t.contains("least_volume is NaN")));
}

/// A random number from 0 to 1 for each call.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*state >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn cells_of_points_hold_what_is_nearest_to_them() {
    let mesh = sphere(24, 48, 1.0, [0.0; 3]);
    let solid = solid_of_mesh(&mesh, 16);
    let faces: Vec<[Vec3; 3]> =
        mesh.1.iter().map(|f| f.map(|v| Vec3::from(mesh.0[v as usize]))).collect();
    let mut state = 5;
    let mut any = || Vec3::from_fn(|_, _| 2.0 * random(&mut state) - 1.0);
    let points: Vec<Vec3> = (0..12).map(|_| any()).collect();
    for weighted in [false, true] {
        let weight = |i: usize| if weighted { 0.03 * (i % 5) as f64 } else { 0.0 };
        let weights: Vec<f64> = (0..12).map(weight).collect();
        let by = Cut::Points { points: points.clone(), weights };
        let f = made(&solid, &by);
        assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-12);
        let mut counts = [0usize; 12];
        let n = 20_000;
        for _ in 0..n {
            let p = any();
            if winding(&faces, &p) < 0.5 {
                continue;
            }
            let power = |i: &usize| (p - points[*i]).norm_squared() - weight(*i);
            let nearest = (0..12).min_by(|i, j| power(i).total_cmp(&power(j))).unwrap();
            counts[nearest] += 1;
            // The region of that point holds it, and no other does.
            for r in &f.regions {
                let within =
                    r.half_spaces(solid.frame()).iter().all(|h| h.normal.dot(&p) <= h.offset);
                assert_eq!(within, r.cell() == nearest, "{p}");
            }
        }
        for r in &f.regions {
            let found = 8.0 * counts[r.cell()] as f64 / f64::from(n);
            let volume = r.moments(solid.frame()).volume;
            assert!(
                (found - volume).abs() < 4.0 * (8.0 * volume / f64::from(n)).sqrt(),
                "{found} {volume}"
            );
        }
        (0..f.regions.len()).for_each(|i| assert!(recomputed(&solid, &f, i) < 1e-11));
    }
}

#[test]
fn seeds_are_the_same_for_any_threads_and_finer_near_an_impact() {
    let solid = particle("superellipsoid", 24);
    // On top of its box.
    let hit = solid.moments().centroid + Vec3::z() * 0.5;
    for by in
        [Cut::Seeded { count: 30 }, Cut::Impact { point: hit, direction: -Vec3::z(), count: 30 }]
    {
        let of = |threads| {
            let run = Run::new(threads).unwrap().with_seed(7);
            cut(&solid, &by, &CutOptions::default(), &run).unwrap()
        };
        let (one, three) = (of(1), of(3));
        assert_eq!(one, three);
        assert!(one.regions.len() >= 28, "{}", one.regions.len());
        assert!(lack(&solid.moments(), &pieces(&solid, &one)) < 1e-12);
        let other = cut(&solid, &by, &CutOptions::default(), &Run::serial().with_seed(8)).unwrap();
        assert_ne!(one, other);
        if matches!(by, Cut::Impact { .. }) {
            let mut m: Vec<Moments> =
                one.regions.iter().map(|r| r.moments(solid.frame())).collect();
            m.sort_by(|a, b| (a.centroid - hit).norm().total_cmp(&(b.centroid - hit).norm()));
            let mean = |m: &[Moments]| m.iter().map(|m| m.volume).sum::<f64>() / m.len() as f64;
            assert!(mean(&m[..8]) < 0.3 * mean(&m[m.len() - 8..]));
        }
    }
}

#[test]
fn twenty_generations_lose_nothing() {
    let solid = particle("tablet", 24);
    let mut state = 11;
    let run = Run::serial();
    let options = CutOptions { least_volume: 1e-14 * solid.moments().volume };
    let mut region = made(&solid, &Cut::Planes(vec![])).regions.remove(0);
    for generation in 0..20 {
        let m = region.moments(solid.frame());
        let n = Vec3::from_fn(|_, _| 2.0 * random(&mut state) - 1.0);
        let by = Cut::Planes(vec![HalfSpace { normal: n, offset: n.dot(&m.centroid) }]);
        let f = cut_region(&solid, &region, &by, &options, &run).unwrap();
        assert_eq!(f.regions.len(), 2, "{generation}");
        assert!(lack(&m, &pieces(&solid, &f)) < 1e-12, "{generation}");
        if generation % 5 == 4 {
            assert!(recomputed(&solid, &f, 0) < 1e-9, "{generation}");
        }
        region = f.regions[0].clone();
        // Planes that it no longer touches are left out.
        assert!(region.half_spaces(solid.frame()).len() <= 14, "{generation}");
    }
    let share = region.moments(solid.frame()).volume / solid.moments().volume;
    assert!(share < 1e-5 && share > 1e-8, "{share}");
}

#[test]
fn a_thousand_planes_and_slivers() {
    // Of many short rows, that planes run along: a face that a hundred of them cross, one after
    // the other, gets ever more corners.
    let solid = solid_of_mesh(&sphere(400, 12, 1.0, [0.0; 3]), 16);
    let planes = (0..1000).map(|i| plane([0.001, 0.003, 1.0], -1.0 + 2.0 * f64::from(i) / 999.0));
    let f = made(&solid, &Cut::Planes(planes.collect()));
    assert!(f.regions.len() > 850, "{}", f.regions.len());
    assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-12);
    // Slices from thin to thinner than dust.
    for e in 1..16 {
        let d = 10f64.powi(-e);
        let f = made(
            &solid,
            &Cut::Planes(vec![plane([0.1, 0.2, 1.0], 0.0), plane([0.1, 0.2, 1.0], d)]),
        );
        assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-12, "{d}");
        assert_eq!(f.regions.len() + f.dust.len(), if e < 15 { 3 } else { 2 }, "{d}");
    }
    let random_planes = |n: usize| {
        let mut state = 3;
        let mut next = || 2.0 * random(&mut state) - 1.0;
        (0..n).map(|_| plane([next(), next(), next()], 0.3 * next())).collect::<Vec<_>>()
    };
    // A cube has few faces, so that all those cells are soon there.
    let few = solid_of_mesh(&cube([-0.5; 3], 1.0), 8);
    let e = cut(&few, &Cut::Planes(random_planes(1000)), &CutOptions::default(), &Run::serial());
    assert!(matches!(e, Err(Error::TooLarge(t)) if t.contains("16384")));
    let f = made(&solid, &Cut::Within(random_planes(1000)));
    assert!(f.regions.len() <= 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn pieces_add_up(
        kind in 0..6usize,
        normals in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 1..5),
        depths in prop::array::uniform4(-0.3..0.3f64),
    ) {
        let names = ["ellipsoid", "torus", "stone", "superellipsoid", "cone", "tablet"];
        let solid = particle(names[kind], 16);
        let m = solid.moments();
        let size = m.volume.cbrt();
        let planes = normals.iter().zip(depths).filter(|(n, _)| Vec3::from(**n).norm() > 0.1);
        let planes = planes.map(|(n, d)| {
            let n = Vec3::from(*n).normalize();
            HalfSpace { normal: n, offset: n.dot(&m.centroid) + d * size }
        });
        let f = made(&solid, &Cut::Planes(planes.collect()));
        prop_assert!(lack(&m, &pieces(&solid, &f)) < 1e-12);
        for i in 0..f.regions.len() {
            if f.regions[i].moments(solid.frame()).volume > 1e-4 * m.volume {
                prop_assert!(recomputed(&solid, &f, i) < 1e-9, "{}", i);
            }
        }
    }
}
