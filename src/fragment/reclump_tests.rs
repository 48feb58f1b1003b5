use super::super::union::Union;
use super::*;
use crate::generate::{GenerateOptions, Method, Plane, generate};
use crate::math::{Inertia, Moments};
use crate::shape::primitive::Primitive;
use crate::shape::{Bodies, Body as Form, ImportOptions, Layout, Shape};
use crate::solid::nearest::Surface;
use crate::solid::{Resolution, Solid, SolidOptions};
use std::sync::Arc;

fn solid(name: &str, segments: usize, cells: u32) -> Arc<Solid> {
    let run = Run::serial();
    let primitive = Primitive::from_name(name).unwrap();
    let shape = Shape::from_primitive(&primitive, segments, &ImportOptions::default(), &run);
    let resolution = Resolution::CellsLongest(cells);
    let options = SolidOptions { resolution, ..SolidOptions::default() };
    Arc::new(Solid::new(&shape.unwrap(), &options, &run).unwrap())
}

fn parent(solid: &Arc<Solid>, n: usize) -> Parent {
    let run = Run::serial();
    let options = GenerateOptions { spheres: n, ..GenerateOptions::default() };
    let spheres = if n > 0 { generate(solid, &options, &run).unwrap().spheres } else { Vec::new() };
    Parent::new(Arc::clone(solid), &spheres, &run).unwrap()
}

fn plane(normal: [f64; 3], through: [f64; 3]) -> Plane {
    let normal = Vec3::from(normal).normalize();
    Plane { normal, offset: normal.dot(&Vec3::from(through)) }
}

fn other(p: &Plane) -> Plane {
    Plane { normal: -p.normal, offset: -p.offset }
}

/// What lies within planes, its moments from many points.
fn region(solid: &Solid, planes: &[Plane]) -> Region {
    let run = Run::serial();
    let surface = solid.surface(&run).unwrap();
    let mut random = Random::new(5);
    let grid = solid.grid();
    let edges = Vec3::from(grid.dims.map(|n| n as f64)).component_mul(&grid.spacing);
    let (mut lo, mut hi) = (grid.origin, grid.origin + edges);
    let mut found: Vec<Vec3> = Vec::new();
    let mut volume = 0.0;
    // Twice, so that a thin one has its own box.
    for _ in 0..3 {
        found.clear();
        let box_volume = (hi - lo).product();
        for _ in 0..8000 {
            let at = Vec3::from([0, 1, 2].map(|_| f64::from(random.unit())));
            let p = lo + (hi - lo).component_mul(&at);
            let within = planes.iter().all(|w| w.normal.dot(&p) <= w.offset);
            if within && surface.contains(&p) {
                found.push(p);
            }
        }
        assert!(!found.is_empty());
        volume = box_volume * found.len() as f64 / 8000.0;
        let (l, h) = found.iter().fold((found[0], found[0]), |(l, h), p| (l.inf(p), h.sup(p)));
        let margin = (h - l) * 0.03;
        (lo, hi) = (lo.sup(&(l - margin)), hi.inf(&(h + margin)));
    }
    let n = found.len() as f64;
    let centroid = found.iter().sum::<Vec3>() / n;
    let second = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|(i, j)| {
        let of = |p: &Vec3| (p[i] - centroid[i]) * (p[j] - centroid[j]);
        found.iter().map(of).sum::<f64>() * volume / n
    });
    let inertia = Inertia::from_second_moments(second);
    let moments = Moments { volume, centroid, inertia, relative_error: 0.01 };
    Region { planes: planes.to_vec(), mark: None, moments, lo, hi, anchor: None, cell: 0 }
}

/// How far spheres (caller's frame) reach beyond planes, surface and union: none when not above 0.
fn beyond(parent: &Parent, planes: &[Plane], spheres: &[Sphere], union: bool) -> f64 {
    let solid = parent.solid();
    let surface = solid.surface(&Run::serial()).unwrap();
    let mut worst = f64::MIN;
    for s in spheres {
        let s = solid.frame().sphere_to_unit(s);
        assert!(surface.contains(&s.center) && s.radius > 0.0);
        worst = worst.max(s.radius - surface.nearest(&s.center).distance);
        for p in planes {
            worst = worst.max(p.normal.dot(&s.center) + s.radius - p.offset);
        }
        if union {
            let whole = Union::new(parent.unit_spheres()).unwrap();
            worst = worst.max(s.radius - whole.depth(&s.center));
        }
    }
    worst
}

fn overlap(a: &[Sphere], b: &[Sphere]) -> f64 {
    let of = |s: &Sphere, t: &Sphere| s.radius + t.radius - (s.center - t.center).norm();
    a.iter().flat_map(|s| b.iter().map(move |t| of(s, t))).fold(f64::MIN, f64::max)
}

fn asked(spheres: usize, union: bool) -> ReclumpOptions {
    ReclumpOptions { spheres, union, ..ReclumpOptions::default() }
}

fn cuts() -> Vec<Plane> {
    vec![
        plane([1.0, 0.3, -0.2], [0.4, 0.4, 0.3]),
        plane([-0.2, 1.0, 0.5], [0.5, 0.3, 0.4]),
        plane([0.0, 0.0, 1.0], [0.3, 0.3, 0.35]),
    ]
}

#[test]
fn nothing_crosses_cuts_surface_union_or_siblings() {
    for (name, spheres) in [("stone", 30), ("torus", 20), ("box", 0)] {
        let solid = solid(name, 24, 40);
        let parent = parent(&solid, spheres);
        for (k, cut) in cuts().iter().enumerate() {
            let middle = solid.unit_moments().centroid;
            let cut = Plane { offset: cut.normal.dot(&middle) + 0.02 * k as f64, ..*cut };
            let sides = [cut, other(&cut)];
            for (union, gap, single) in
                [(true, 0.0, false), (false, 0.0, true), (true, 0.01, true), (false, 0.02, false)]
            {
                let gap = gap * solid.frame().scale;
                let options = ReclumpOptions { gap, single, ..asked(12, union) };
                let made = sides.map(|side| {
                    let region = region(&solid, &[side]);
                    let run = Run::serial();
                    let made = reclump(&parent, &region, &options, &run).unwrap();
                    assert!(made.spheres.len() >= 6, "{name} {k} {}", made.spheres.len());
                    assert!(
                        made.coverage > 0.01 && made.coverage < 1.05,
                        "{name} {}",
                        made.coverage
                    );
                    // Neither cells nor transforms: the parent's field serves.
                    let counted = run.counters();
                    assert_eq!((counted.cells, counted.transforms), (0, 0));
                    let union = union && spheres > 0;
                    let out = beyond(&parent, &[side], &made.spheres, union);
                    let less = 0.5 * gap / solid.frame().scale;
                    assert!(out <= -less, "{name} {k} {union}: {out:e}");
                    if single {
                        for s in &made.spheres {
                            let c = s.center.map(|x| f64::from(x as f32));
                            assert_eq!((c, f64::from(s.radius as f32)), (s.center, s.radius));
                        }
                    }
                    // The parent's spheres that each overlaps, where they hold it together.
                    for i in 0..made.spheres.len() {
                        assert!(!union || !made.map.of(i).is_empty());
                    }
                    assert_eq!(made.step_factor.is_some(), spheres > 0);
                    made
                });
                let [a, b] = &made;
                let deep = overlap(&a.spheres, &b.spheres);
                assert!(deep <= -gap, "{name} {k}: {deep:e} {gap}");
            }
        }
    }
}

#[test]
fn the_depth_is_that_of_the_clipped_body() {
    // Two boxes of which one is the other cut at x = 0.3: every depth is the same without a field.
    let whole = solid("box", 8, 32);
    let Form::Mesh(mesh) = whole.body() else { panic!("a mesh") };
    let cut = 0.3;
    let mut clipped = mesh.clone();
    for v in &mut clipped.vertices {
        v.x = v.x.min(cut);
    }
    let surface = Surface::new(&Form::Mesh(clipped)).unwrap();
    let parent = parent(&whole, 0);
    let region = region(&whole, &[plane([1.0, 0.0, 0.0], [cut, 0.0, 0.0])]);
    let walls = walls(&region, &[], whole.frame()).unwrap();
    let run = Run::serial();
    let Within { depths, union, .. } = parent.within(false, &run).unwrap();
    let (lo, hi) = (region.lo, region.hi);
    let grid = whole.grid();
    let surface_of = whole.surface(&run).unwrap();
    let parts =
        Parts { grid, depths, surface: surface_of, union, walls: &walls, less: 0.0, lo, hi };
    let room = Room::new(parts, region.moments.volume).unwrap();
    let mut random = Random::new(1);
    let mut inside = 0;
    for _ in 0..2000 {
        let at = Vec3::from([0, 1, 2].map(|_| f64::from(random.unit())));
        let p = lo + (hi - lo).component_mul(&at);
        if p.x < cut && surface.contains(&p) {
            let exact = surface.nearest(&p).distance;
            assert!((room.sphere(p).radius - exact).abs() < 1e-12);
            // And nearly so by the field: flat faces are met but for the steps of directions.
            let local = p - room.middle;
            let near = room.depth(&[local.x as f32, local.y as f32, local.z as f32]).0;
            assert!((f64::from(near) - exact).abs() < 0.05 * grid.spacing.x, "{near} {exact}");
            inside += 1;
        }
    }
    assert!(inside > 500);
}

#[test]
fn it_covers_nearly_what_the_full_generator_does() {
    let run = Run::serial();
    for (name, n, less) in [("stone", 10, 0.02), ("stone", 50, 0.012), ("cylinder", 10, 0.02)] {
        let solid = solid(name, 24, 64);
        let parent = parent(&solid, 0);
        let mut whole = region(&solid, &[]);
        whole.moments = *solid.unit_moments();
        let made = reclump(&parent, &whole, &asked(n, false), &run).unwrap();
        assert_eq!((made.spheres.len(), made.stopped), (n, Stopped::Spheres));
        let options =
            GenerateOptions { method: Method::Inscribed, spheres: n, ..GenerateOptions::default() };
        let full = generate(&solid, &options, &run).unwrap();
        let full = union_moments(&full.spheres, &run).unwrap().volume / solid.moments().volume;
        assert!(made.coverage > full - less, "{name} {n}: {} {full}", made.coverage);
        assert!((made.coverage - made.volume_share).abs() < 1e-12);
    }
}

#[test]
fn slivers_and_crumbs_have_few_spheres_or_none_but_none_outside() {
    let solid = solid("stone", 24, 40);
    let parent = parent(&solid, 12);
    let middle: [f64; 3] = solid.unit_moments().centroid.into();
    let cell = solid.grid().spacing.x;
    let mut some = 0;
    for thick in [2.0 * cell, cell, 0.3 * cell, 1e-3 * cell] {
        for normal in [[1.0, 0.0, 0.0], [0.6, -0.5, 0.3]] {
            let lower = plane(normal, middle);
            let upper = other(&lower);
            let planes = [Plane { offset: lower.offset + thick, ..lower }, upper];
            let region = sliver(&region(&solid, &[upper]), &planes, thick);
            for union in [false, true] {
                match reclump(&parent, &region, &asked(20, union), &Run::serial()) {
                    Ok(made) => {
                        some += 1;
                        assert!(beyond(&parent, &planes, &made.spheres, union) <= 0.0);
                    }
                    Err(e) => assert!(matches!(e, Error::NoSpheres(_)), "{e}"),
                }
            }
        }
    }
    assert!(some >= 4, "{some}");
    // Crumbs of a hundredth of a cell to three cells, in the middle and at the surface.
    for size in [3.0 * cell, 0.5 * cell, 0.01 * cell] {
        let mut at = Vec3::from(middle);
        for _ in 0..2 {
            let planes: Vec<Plane> = (0..6)
                .map(|k| {
                    let mut normal = Vec3::zeros();
                    normal[k / 2] = if k % 2 == 0 { 1.0 } else { -1.0 };
                    Plane { normal, offset: normal.dot(&at) + 0.5 * size }
                })
                .collect();
            let crumb = crumb(&planes, &at, size);
            for union in [false, true] {
                let made = reclump(&parent, &crumb, &asked(8, union), &Run::serial());
                if let Ok(made) = &made {
                    assert!(beyond(&parent, &planes, &made.spheres, union) <= 0.0);
                } else {
                    // Of a crumb in the middle there is always some.
                    assert!(at != Vec3::from(middle), "{made:?}");
                }
            }
            at = solid.surface(&Run::serial()).unwrap().nearest(&at).point;
        }
    }
}

fn sliver(half: &Region, planes: &[Plane], thick: f64) -> Region {
    let edge = (half.hi - half.lo).amax();
    let volume = 0.4 * edge * edge * thick;
    let moments = Moments { volume, ..half.moments };
    Region { planes: planes.to_vec(), moments, ..half.clone() }
}

fn crumb(planes: &[Plane], at: &Vec3, size: f64) -> Region {
    let inertia = Inertia { xx: size, yy: size, zz: size, ..Inertia::default() };
    let moments = Moments { volume: size.powi(3), centroid: *at, inertia, relative_error: 0.0 };
    let half = Vec3::repeat(0.5 * size);
    let (lo, hi) = (at - half, at + half);
    Region { planes: planes.to_vec(), mark: None, moments, lo, hi, anchor: None, cell: 0 }
}

#[test]
fn cut_through_the_only_thick_part() {
    // A dumbbell's bar and heads as cells; cut in the middle of one head.
    let dims = [48, 20, 20];
    let mut cells = vec![0u8; 48 * 400];
    for (i, c) in cells.iter_mut().enumerate() {
        let p = [i % 48, i / 48 % 20, i / 960].map(|k| k as f64 + 0.5);
        let apart =
            |x: f64| ((p[0] - x).powi(2) + (p[1] - 10.0).powi(2) + (p[2] - 10.0).powi(2)).sqrt();
        let bar = (p[1] - 10.0).hypot(p[2] - 10.0) < 1.5 && p[0] > 8.0 && p[0] < 40.0;
        *c = u8::from(apart(10.0) < 8.0 || bar);
    }
    let layout = Layout { dims, spacing: [1e-3; 3], origin: [5.0; 3] };
    let options = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    let run = Run::serial();
    let shape = Shape::from_mask(&cells, &layout, &options, &run).unwrap();
    let solid = Arc::new(Solid::new(&shape, &SolidOptions::default(), &run).unwrap());
    let parent = parent(&solid, 10);
    let head = solid.frame().to_unit(&Vec3::new(5.0101, 5.01, 5.01));
    let cut = Plane { normal: Vec3::x(), offset: head.x };
    for side in [cut, other(&cut)] {
        let region = region(&solid, &[side]);
        for union in [false, true] {
            let made = reclump(&parent, &region, &asked(10, union), &run).unwrap();
            assert!(beyond(&parent, &[side], &made.spheres, union) <= 0.0);
        }
    }
}

#[test]
fn walls_least_radius_deadline_and_cancel() {
    let solid = solid("stone", 24, 40);
    let parent = parent(&solid, 0);
    let cut = plane([1.0, 0.3, -0.2], solid.unit_moments().centroid.into());
    let region = region(&solid, &[cut]);
    let frame = *solid.frame();
    let wall = plane([0.0, 0.1, 1.0], solid.unit_moments().centroid.into());
    let input = HalfSpace {
        normal: wall.normal * 1e-200,
        offset: (wall.offset * frame.scale + wall.normal.dot(&frame.offset)) * 1e-200,
    };
    let min_radius = 0.04 * frame.scale;
    let options = ReclumpOptions { walls: vec![input], min_radius, ..asked(30, false) };
    let run = Run::serial();
    let made = reclump(&parent, &region, &options, &run).unwrap();
    assert!(beyond(&parent, &[cut, wall], &made.spheres, false) < 1e-12);
    assert!(made.spheres.iter().all(|s| s.radius >= min_radius));
    // As often as it is made.
    assert_eq!(reclump(&parent, &region, &options, &Run::serial()).unwrap(), made);

    let late = Run::serial().with_deadline(0.0);
    let coarse = reclump(&parent, &region, &asked(10, false), &late).unwrap();
    assert!(!coarse.spheres.is_empty() && coarse.stopped == Stopped::Deadline);
    assert!(beyond(&parent, &[cut], &coarse.spheres, false) <= 0.0);
    let cancelled = Run::serial().with_progress(Box::new(|_| true));
    let e = reclump(&parent, &region, &asked(10, false), &cancelled).unwrap_err();
    assert!(matches!(e, Error::Cancelled(_)));
    let later = Run::serial().with_progress(Box::new(|f| f > 0.1));
    let some = reclump(&parent, &region, &asked(10, false), &later).unwrap();
    assert_eq!(some.stopped, Stopped::Cancelled);

    let no = HalfSpace { normal: Vec3::zeros(), offset: 0.0 };
    let nan = HalfSpace { normal: Vec3::x(), offset: f64::NAN };
    for (bad, says) in [
        (asked(0, false), "0 spheres are asked"),
        (ReclumpOptions { gap: -1.0, ..asked(5, false) }, "gap is -1"),
        (ReclumpOptions { min_radius: f64::NAN, ..asked(5, false) }, "min_radius is NaN"),
        (ReclumpOptions { walls: vec![input, no], ..asked(5, false) }, "wall 1 has a normal"),
        (ReclumpOptions { walls: vec![nan], ..asked(5, false) }, "wall 0 has normal (1, 0, 0)"),
    ] {
        let e = reclump(&parent, &region, &bad, &run).unwrap_err().to_string();
        assert!(e.contains(says), "{e}");
    }
    let huge = ReclumpOptions { gap: frame.scale, ..asked(5, false) };
    assert!(matches!(reclump(&parent, &region, &huge, &run), Err(Error::NoSpheres(_))));
}

#[test]
fn a_parent_is_the_same_for_any_thread_count() {
    let solid = solid("stone", 24, 32);
    let options = GenerateOptions { spheres: 12, ..GenerateOptions::default() };
    let spheres = generate(&solid, &options, &Run::serial()).unwrap().spheres;
    let region = region(&solid, &cuts()[..1]);
    let made = [1, 2].map(|threads| {
        let run = Run::new(threads).unwrap();
        let parent = Parent::new(Arc::clone(&solid), &spheres, &run).unwrap();
        assert!(parent.bytes() > 16 * solid.grid().len() as u64);
        reclump(&parent, &region, &asked(10, true), &run).unwrap()
    });
    assert_eq!(made[0], made[1]);
}

#[path = "reclump_grow_tests.rs"]
mod growth;
