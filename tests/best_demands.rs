//! What clumps of the generator of least mismatch must keep to.

#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{Arrays, solid_of_mesh};
use morula::clump::Stopped;
use morula::generate::{BestOptions, Effort, GenerateOptions, HalfSpace, Method, generate};
use morula::measure::{Quality, QualityOptions, quality};
use morula::shape::primitive::Primitive;
use morula::shape::{ImportOptions, Shape};
use morula::solid::SolidOptions;
use morula::{Clump, Error, Run, Solid};

fn solid(name: &str) -> Solid {
    solid_of_mesh(&mesh(name), 48)
}

fn mesh(name: &str) -> Arrays {
    Primitive::from_name(name).unwrap().mesh(32).unwrap()
}

fn ask(spheres: usize, effort: Effort, best: BestOptions) -> GenerateOptions {
    GenerateOptions { method: Method::Best, spheres, effort, best, ..GenerateOptions::default() }
}

fn make(solid: &Solid, spheres: usize, best: &BestOptions) -> Clump {
    generate(solid, &ask(spheres, Effort::Normal, best.clone()), &Run::serial()).unwrap()
}

fn overlap(solid: &Solid, clump: &Clump) -> Quality {
    let options = QualityOptions { surface: false, ..QualityOptions::default() };
    quality(solid, &clump.spheres, &options, &Run::serial()).unwrap()
}

#[test]
fn overshoot_falls_with_its_weight() {
    for name in ["box", "torus", "stone"] {
        let solid = solid(name);
        let weights = [0.3, 1.0, 3.0, 10.0];
        let q = weights.map(|overshoot_weight| {
            let best = BestOptions { overshoot_weight, ..BestOptions::default() };
            overlap(&solid, &make(&solid, 12, &best))
        });
        for k in 0..3 {
            assert!(q[k + 1].overshoot < 0.8 * q[k].overshoot, "{name} {}: {q:?}", weights[k]);
            assert!(q[k + 1].coverage < q[k].coverage, "{name} {}: {q:?}", weights[k]);
        }
        // Each is the best of the four by its own measure.
        for (w, mine) in weights.iter().zip(&q) {
            let goal = |q: &Quality| {
                let (missing, beyond) = (1.0 - q.coverage, w * q.overshoot);
                (missing + beyond) / (1.0 + q.coverage + beyond)
            };
            for other in &q {
                assert!(goal(mine) < 1.02 * goal(other), "{name} {w}: {q:?}");
            }
        }
    }
}

#[test]
fn no_radius_is_above_the_greatest() {
    for name in ["box", "torus"] {
        let solid = solid(name);
        let mut before = 0.0;
        for max_radius in [0.3, 0.2, 0.1] {
            let best = BestOptions { max_radius, ..BestOptions::default() };
            let clump = make(&solid, 30, &best);
            assert_eq!(clump.spheres.len(), 30);
            assert!(clump.spheres.iter().all(|s| s.radius <= max_radius));
            let d = overlap(&solid, &clump).mismatch;
            assert!(d > before, "{name} {max_radius}: {d} {before}");
            before = d;
        }
    }
}

/// The greatest n · p of the points of a sphere, less the offset, in units of the rounding.
fn beyond(s: &morula::math::Sphere, h: &HalfSpace) -> f64 {
    let length = h.normal.norm();
    let e = (h.normal / length).dot(&s.center) + s.radius - h.offset / length;
    e / (f64::EPSILON * (s.center.norm() + h.offset.abs() / length + s.radius))
}

fn half(x: f64, y: f64, z: f64, offset: f64) -> HalfSpace {
    HalfSpace { normal: morula::math::Vec3::new(x, y, z), offset }
}

#[test]
fn half_spaces_are_as_good_as_a_smaller_body() {
    let run = Run::serial();
    let whole = solid("box");
    let planes = [half(0.0, 0.0, 2.0, 0.2), half(-1.0, 0.0, 0.0, 0.3), half(0.0, 0.5, 0.0, 0.15)];
    // What they leave of the box about the origin.
    let parts = [([1.0, 1.0, 0.6], 1), ([0.8, 1.0, 0.6], 2), ([0.8, 0.8, 0.6], 3)];
    for (edges, n) in parts {
        let shape =
            Shape::from_primitive(&Primitive::Box { edges }, 32, &ImportOptions::default(), &run);
        let part = Solid::new(&shape.unwrap(), &SolidOptions::default(), &run).unwrap();
        let half_spaces = planes[..n].to_vec();
        let best = BestOptions { half_spaces: half_spaces.clone(), ..BestOptions::default() };
        let mut clump = make(&whole, 16, &best);
        assert_eq!(clump.spheres.len(), 16);
        for s in &clump.spheres {
            assert!(half_spaces.iter().all(|h| beyond(s, h) <= 4.0));
        }
        // About the middle of the part.
        for s in &mut clump.spheres {
            s.center += morula::math::Vec3::new(
                if n > 1 { -0.1 } else { 0.0 },
                if n > 2 { 0.1 } else { 0.0 },
                0.2,
            );
        }
        let mine = overlap(&part, &clump).mismatch;
        // The same with the planes drawn on the part itself, and without.
        let at = |x: f64| 0.5 * x;
        let faces = [
            half(0.0, 0.0, 1.0, at(edges[2])),
            half(-1.0, 0.0, 0.0, at(edges[0])),
            half(0.0, 1.0, 0.0, at(edges[1])),
        ];
        let best = BestOptions { half_spaces: faces[..n].to_vec(), ..BestOptions::default() };
        let same = overlap(&part, &make(&part, 16, &best)).mismatch;
        let free = overlap(&part, &make(&part, 16, &BestOptions::default())).mismatch;
        assert!((mine / same - 1.0).abs() < 0.1, "{n}: {mine} {same}");
        assert!(mine > free && mine < 2.5 * free, "{n}: {mine} {free}");
    }
}

#[test]
fn half_spaces_that_leave_nothing_are_an_error() {
    let solid = solid("torus");
    let refused = |half_spaces: Vec<HalfSpace>| {
        let best = BestOptions { half_spaces, ..BestOptions::default() };
        let result = generate(&solid, &ask(5, Effort::Draft, best), &Run::serial());
        let Err(Error::ZeroVolume(text)) = result else { panic!("{result:?}") };
        assert!(text.contains("half-spaces leave nothing"), "{text}");
    };
    refused(vec![half(0.0, 0.0, 1.0, -0.41)]);
    refused(vec![half(1.0, 0.0, 0.0, 0.3), half(-1.0, 0.0, 0.0, -0.6)]);
    // The hole.
    refused(
        [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]]
            .map(|[x, y]| half(x, y, 0.0, 0.3))
            .into(),
    );
}

/// How far a sphere may reach beyond the surface at most: by its centre's distance.
fn reach(solid: &Solid, clump: &Clump) -> f64 {
    let surface = solid.surface(&Run::serial()).unwrap();
    let reach = clump.spheres.iter().map(|s| {
        let s = solid.frame().sphere_to_unit(s);
        surface.signed_distance(&s.center) + s.radius
    });
    reach.fold(f64::MIN, f64::max) * solid.frame().scale
}

#[test]
fn no_sphere_protrudes_farther_than_allowed() {
    for name in ["box", "cone", "stone"] {
        let (mesh, solid) = (mesh(name), solid(name));
        let free = overlap(&solid, &make(&solid, 16, &BestOptions::default())).mismatch;
        let mut before = 1.0;
        for max_protrusion in [1e-4, 0.01, 0.03, 0.3] {
            let best = BestOptions { max_protrusion, ..BestOptions::default() };
            let clump = make(&solid, 16, &best);
            assert_eq!(clump.spheres.len(), 16);
            let beyond = common::beyond(&mesh, &clump.spheres);
            assert!(beyond <= max_protrusion * (1.0 + 1e-12), "{name}: {beyond}");
            let q = quality(&solid, &clump.spheres, &QualityOptions::default(), &Run::serial());
            let q = q.unwrap();
            assert!(q.protrusion <= max_protrusion * (1.0 + 1e-9), "{name}: {}", q.protrusion);
            let d = q.mismatch;
            assert!(d < 1.02 * before, "{name} {max_protrusion}: {d} {before}");
            before = d;
        }
        assert!((before / free - 1.0).abs() < 0.03, "{name}: {before} {free}");
    }
}

#[test]
fn volumes_are_equal_for_little_mismatch() {
    let fine = QualityOptions { columns: 1024, surface: false, ..QualityOptions::default() };
    for name in ["box", "torus", "stone"] {
        let solid = solid(name);
        let free = overlap(&solid, &make(&solid, 12, &BestOptions::default()));
        for overshoot_weight in [1.0, 5.0] {
            let best =
                BestOptions { equal_volume: true, overshoot_weight, ..BestOptions::default() };
            let clump = make(&solid, 12, &best);
            assert_eq!(clump.note, "");
            let q = quality(&solid, &clump.spheres, &fine, &Run::serial()).unwrap();
            assert!(q.volume_error.abs() <= 1e-4, "{name}: {}", q.volume_error);
            let more = if overshoot_weight > 1.0 { 1.3 } else { 1.1 };
            assert!(q.mismatch <= more * free.mismatch, "{name}: {} {}", q.mismatch, free.mismatch);
        }
        assert!(free.volume_error.abs() > 1e-3, "{name}: {}", free.volume_error);
    }
    // What half-spaces leave of a unit cube about the origin.
    let solid = solid("box");
    let half_spaces = vec![half(0.0, 0.0, 1.0, 0.1), half(-3.0, 0.0, 0.0, 0.9)];
    let best = BestOptions { equal_volume: true, half_spaces, ..BestOptions::default() };
    let clump = make(&solid, 40, &best);
    let q = quality(&solid, &clump.spheres, &fine, &Run::serial()).unwrap();
    assert!((q.union_volume / 0.48 - 1.0).abs() < 2e-4, "{} {}", q.union_volume, clump.note);
}

#[test]
fn volumes_that_limits_do_not_allow_are_reported() {
    let solid = solid("torus");
    let best = BestOptions { equal_volume: true, max_radius: 0.2, ..BestOptions::default() };
    let clump = make(&solid, 20, &best);
    assert!(clump.spheres.iter().all(|s| s.radius <= 0.2));
    let share = 1.0 + overlap(&solid, &clump).volume_error;
    assert!(share < 0.9 && clump.note.contains("times the volume of the target"), "{}", clump.note);
    let said: f64 = clump.note.split(' ').find_map(|w| w.parse().ok()).unwrap();
    assert!((said - share).abs() < 1e-3, "{share} {}", clump.note);
}

#[test]
fn all_limits_hold_together_at_any_size_and_place() {
    let (vertices, faces) = Primitive::from_name("stone").unwrap().mesh(32).unwrap();
    let run = Run::serial();
    for (scale, at) in [(1.0, 0.0), (1e-9, 0.0), (1e6, 0.0), (1.0, 1e7)] {
        let vertices: Vec<[f64; 3]> = vertices.iter().map(|p| p.map(|x| scale * x + at)).collect();
        let shape = Shape::from_mesh(&vertices, &faces, &ImportOptions::default(), &run).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        let normals = [[1.0, 0.3, -0.2], [-2.0, 1.0, 0.5]].map(morula::math::Vec3::from);
        let half_spaces: Vec<HalfSpace> = normals
            .iter()
            .map(|n| HalfSpace {
                normal: *n,
                offset: n.dot(&morula::math::Vec3::repeat(at)) + 0.2 * scale * n.norm(),
            })
            .collect();
        let best = BestOptions {
            overshoot_weight: 2.0,
            max_protrusion: 0.02 * scale,
            max_radius: 0.25 * scale,
            half_spaces: half_spaces.clone(),
            equal_volume: true,
            smoothness: 0.5,
            ..BestOptions::default()
        };
        let min_radius = 0.05 * scale;
        let options = GenerateOptions { min_radius, ..ask(25, Effort::Normal, best.clone()) };
        let clump = generate(&solid, &options, &run).unwrap();
        assert_eq!(clump.spheres.len(), 25, "{}", clump.note);
        for s in &clump.spheres {
            assert!(s.radius >= min_radius && s.radius <= best.max_radius, "{scale} {at}: {s:?}");
            assert!(half_spaces.iter().all(|h| beyond(s, h) <= 4.0), "{scale} {at}: {s:?}");
        }
        assert!(reach(&solid, &clump) <= best.max_protrusion, "{scale} {at}");
        let error = overlap(&solid, &clump).volume_error;
        // A part of the stone is cut off.
        assert!(error < -0.05 && error > -0.7, "{scale} {at}: {error} {}", clump.note);
    }
}

#[test]
fn spheres_without_room_are_left_out_and_said_so() {
    let solid = solid("torus");
    // A tube of radius 0.4: no larger sphere keeps within it and a little more.
    let ask = |min_radius: f64, max_protrusion: f64| {
        let best = BestOptions { max_protrusion, ..BestOptions::default() };
        let options = GenerateOptions { min_radius, ..ask(20, Effort::Draft, best) };
        generate(&solid, &options, &Run::serial())
    };
    let Err(Error::NoSpheres(text)) = ask(0.45, 0.01) else { panic!("there is no room") };
    assert!(text.contains("0.45"), "{text}");
    let clump = ask(0.395, 0.01).unwrap();
    assert!(clump.spheres.iter().all(|s| s.radius >= 0.395));
    assert!(reach(&solid, &clump) <= 0.01);
    assert!(clump.spheres.len() == 20 || clump.note.contains("of 20 spheres"), "{}", clump.note);
}

#[test]
fn surfaces_come_closer_for_some_mismatch() {
    for name in ["box", "cone", "stone", "torus"] {
        let solid = solid(name);
        let q = [0.0, 1.0, 4.0].map(|smoothness| {
            let best = BestOptions { smoothness, ..BestOptions::default() };
            let spheres = make(&solid, 14, &best).spheres;
            quality(&solid, &spheres, &QualityOptions::default(), &Run::serial()).unwrap()
        });
        let d = q.each_ref().map(|q| q.mismatch);
        let rms = q.each_ref().map(|q| q.rms_distance);
        assert!(rms[1] < rms[0] && rms[2] < rms[0], "{name}: {rms:?} {d:?}");
        assert!(d[1] < 1.15 * d[0] && d[2] < 1.3 * d[0], "{name}: {rms:?} {d:?}");
        // Each is the best by its own measure.
        let diameter = solid.moments().volume * 6.0 / std::f64::consts::PI;
        let goal = |s: f64, k: usize| d[k] + s * 3.0 * rms[k] / diameter.cbrt();
        for (k, s) in [0.0, 1.0, 4.0].into_iter().enumerate() {
            for other in 0..3 {
                assert!(goal(s, k) < 1.03 * goal(s, other), "{name} {s}: {rms:?} {d:?}");
            }
        }
    }
}

#[test]
fn a_greatest_protrusion_is_used_to_the_full() {
    for name in ["ellipsoid", "stone", "tablet"] {
        let solid = solid(name);
        let tolerance = 0.01 * solid.moments().volume.cbrt();
        let best = BestOptions { max_protrusion: tolerance, ..BestOptions::default() };
        let clump = make(&solid, 24, &best);
        let reach = reach(&solid, &clump);
        assert!(reach > 0.95 * tolerance, "{name}: {reach} of {tolerance}");
        // As close as clumps whose radii are all as large as they may be.
        let method = Method::Inscribed;
        let full = GenerateOptions {
            method,
            tolerance,
            ..ask(24, Effort::Normal, BestOptions::default())
        };
        let full = overlap(&solid, &generate(&solid, &full, &Run::serial()).unwrap()).mismatch;
        let d = overlap(&solid, &clump).mismatch;
        assert!(d < 1.05 * full, "{name}: {d} {full}");
    }
}

/// A cancel that comes while the volume is made equal, after all moves, is heard.
#[test]
fn a_cancel_is_heard_while_the_volume_is_made_equal() {
    let solid = solid("stone");
    let best = BestOptions { equal_volume: true, ..BestOptions::default() };
    let options = ask(20, Effort::Normal, best);
    let mut asked = 0;
    let run = Run::serial().with_progress(Box::new(|f| {
        asked += usize::from(f >= 0.95);
        f >= 0.95 && asked > 3
    }));
    let clump = generate(&solid, &options, &run).unwrap();
    assert_eq!((clump.spheres.len(), clump.stopped), (20, Stopped::Cancelled));
    drop(run);
    assert!((4..12).contains(&asked), "{asked}");
}
