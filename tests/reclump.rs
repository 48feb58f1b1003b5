//! Spheres of fragments, held against the surface of the fragment itself, made anew.

#![allow(clippy::panic, clippy::unwrap_used)]

mod common;

use common::solid_of_mesh as solid;
use morula::fragment::{
    Cut, CutOptions, Fragments, Parent, ReclumpOptions, Region, cut, cut_region, reclump, shape,
};
use morula::generate::{GenerateOptions, HalfSpace, generate};
use morula::math::Vec3;
use morula::shape::Primitive;
use morula::solid::SolidOptions;
use morula::{Error, Run, Solid, Sphere};
use std::sync::Arc;

fn body(name: &str) -> Arc<Solid> {
    Arc::new(solid(&Primitive::from_name(name).unwrap().mesh(24).unwrap(), 48))
}

fn points(solid: &Solid, n: usize) -> Cut {
    let (middle, size) = (solid.moments().centroid, solid.moments().volume.cbrt());
    let point = |k: usize| {
        let t = k as f64;
        let c = [0.37, 0.61, 0.83].map(|a| (a * (t + 1.0)).fract() - 0.5);
        middle + Vec3::from(c) * size
    };
    Cut::Points { points: (0..n).map(point).collect(), weights: Vec::new() }
}

fn broken(solid: &Solid, by: &Cut) -> Fragments {
    let options = CutOptions { least_volume: 1e-4 * solid.moments().volume };
    cut(solid, by, &options, &Run::serial()).unwrap()
}

fn overlap(a: &[Sphere], b: &[Sphere]) -> f64 {
    let of = |s: &Sphere, t: &Sphere| s.radius + t.radius - (s.center - t.center).norm();
    a.iter().flat_map(|s| b.iter().map(move |t| of(s, t))).fold(f64::MIN, f64::max)
}

/// Spheres of each region; none overlaps one of another.
fn spheres(parent: &Parent, regions: &[Region], options: &ReclumpOptions) -> Vec<Vec<Sphere>> {
    let mut all: Vec<Vec<Sphere>> = Vec::new();
    for region in regions {
        let made = match reclump(parent, region, options, &Run::serial()) {
            Ok(made) => made.spheres,
            Err(Error::NoSpheres(_)) => Vec::new(),
            Err(e) => panic!("{e}"),
        };
        assert!(all.iter().all(|other| overlap(&made, other) <= 0.0));
        all.push(made);
    }
    all
}

#[test]
fn every_radius_is_the_depth_in_the_clipped_body_made_anew() {
    for name in ["stone", "torus"] {
        let solid = body(name);
        let parent = Parent::new(Arc::clone(&solid), &[], &Run::serial()).unwrap();
        let made = broken(&solid, &points(&solid, 6));
        assert!(made.regions.len() >= 5);
        let options = ReclumpOptions { spheres: 15, ..ReclumpOptions::default() };
        for (region, spheres) in made.regions.iter().zip(spheres(&parent, &made.regions, &options))
        {
            let run = Run::serial();
            let own = shape(&solid, region, &run).unwrap();
            let own = Solid::new(&own, &SolidOptions::default(), &run).unwrap();
            let surface = own.surface(&run).unwrap();
            assert!(!spheres.is_empty());
            for s in &spheres {
                let unit = own.frame().sphere_to_unit(s);
                assert!(surface.contains(&unit.center));
                let depth = surface.nearest(&unit.center).distance;
                assert!((unit.radius - depth).abs() < 1e-12, "{name}: {} {depth}", unit.radius);
            }
        }
    }
}

#[test]
fn components_of_one_cell_have_spheres_of_their_own() {
    // A slab through the hole of a torus: two pieces within the same two planes.
    let solid = body("torus");
    let parent = Parent::new(Arc::clone(&solid), &[], &Run::serial()).unwrap();
    let middle = solid.moments().centroid;
    let plane = |x: f64| HalfSpace { normal: Vec3::x(), offset: middle.x + x };
    let made = broken(&solid, &Cut::Planes(vec![plane(-0.3), plane(0.3)]));
    assert_eq!(made.regions.len(), 4);
    let options = ReclumpOptions { spheres: 12, ..ReclumpOptions::default() };
    let all = spheres(&parent, &made.regions, &options);
    for (region, spheres) in made.regions.iter().zip(&all) {
        assert!(spheres.len() >= 8, "{}", spheres.len());
        let [lo, hi] = region.bounds(solid.frame());
        let within = |s: &Sphere| s.center >= lo && s.center <= hi;
        assert!(spheres.iter().all(within));
    }
}

#[test]
fn a_fragment_of_a_fragment_down_to_a_millionth() {
    let solid = body("stone");
    let run = Run::serial();
    let options = GenerateOptions { spheres: 20, ..GenerateOptions::default() };
    let clump = generate(&solid, &options, &run).unwrap().spheres;
    let parent = Parent::new(Arc::clone(&solid), &clump, &run).unwrap();
    let whole = solid.moments().volume;
    let mut region: Option<Region> = None;
    let options = CutOptions { least_volume: 1e-12 * whole };
    for generation in 0..20 {
        let moments = region.as_ref().map_or(solid.moments(), |r| r.moments(solid.frame()));
        let normal = Vec3::from([0, 1, 2].map(|a| f64::from((generation * 7 + a * 5) % 11) - 4.7));
        let by = Cut::Planes(vec![HalfSpace { normal, offset: normal.dot(&moments.centroid) }]);
        let made = match &region {
            Some(r) => cut_region(&solid, r, &by, &options, &run).unwrap(),
            None => cut(&solid, &by, &options, &run).unwrap(),
        };
        if generation % 3 == 0 || generation == 19 {
            let asked = ReclumpOptions { spheres: 8, ..ReclumpOptions::default() };
            let all = spheres(&parent, &made.regions, &asked);
            assert!(all.iter().all(|s| s.len() >= 4), "{generation}");
            for (r, s) in made.regions.iter().zip(&all) {
                let covered = morula::mass::union_moments(s, &run).unwrap().volume;
                assert!(covered > 0.2 * r.moments(solid.frame()).volume, "{generation}");
            }
        }
        region = made.regions.into_iter().next();
    }
    assert!(region.unwrap().moments(solid.frame()).volume < 2e-6 * whole);
}
