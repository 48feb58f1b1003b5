//! How far clumps are from being their own images, against brute force.

#![allow(clippy::unwrap_used)]

mod common;

use morula::math::{Sphere, Vec3};
use morula::measure::{Quality, QualityOptions, quality};
use morula::shape::{ImportOptions, Layout, Primitive};
use morula::solid::SolidOptions;
use morula::{Run, Shape, Solid};

type Arrays = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn solid((vertices, faces): &Arrays) -> Solid {
    let run = Run::serial();
    let shape = Shape::from_mesh(vertices, faces, &ImportOptions::default(), &run).unwrap();
    Solid::new(&shape, &SolidOptions::default(), &run).unwrap()
}

fn measure(solid: &Solid, spheres: &[Sphere]) -> Quality {
    let options = QualityOptions { overlap: false, columns: 128, ..QualityOptions::default() };
    quality(solid, spheres, &options, &Run::serial()).unwrap()
}

fn sphere(x: f64, y: f64, z: f64, r: f64) -> Sphere {
    Sphere::new(Vec3::new(x, y, z), r)
}

/// 1 − |C ∩ C'| / |C| for the image in the plane across `axis` through the origin, point by point.
fn by_points(spheres: &[Sphere], axis: usize) -> f64 {
    let inside = |p: &Vec3| spheres.iter().any(|s| s.contains(p));
    let (mut all, mut both) = (0, 0);
    for i in 0..400_000 {
        // Roberts' sequence over the box.
        let at = |k: f64| (0.5 + f64::from(i) * k).fract() * 1.6 - 0.8;
        let p = Vec3::new(at(0.819_172_513_4), at(0.671_043_606_7), at(0.549_700_477_9));
        if inside(&p) {
            all += 1;
            let mut image = p;
            image[axis] = -image[axis];
            both += i32::from(inside(&image));
        }
    }
    1.0 - f64::from(both) / f64::from(all)
}

const AXES: [f64; 3] = [1.0, 0.7, 0.45];

fn lumps() -> Vec<Sphere> {
    vec![
        sphere(0.3, 0.05, 0.02, 0.2),
        sphere(-0.25, -0.04, 0.0, 0.24),
        sphere(0.0, 0.15, -0.03, 0.19),
        sphere(0.1, -0.2, 0.05, 0.12),
    ]
}

#[test]
fn the_worst_plane_of_three_as_points_have_it() {
    let cuboid = Primitive::Box { edges: AXES }.mesh(8).unwrap();
    let expected = (0..3).map(|axis| by_points(&lumps(), axis)).fold(0.0, f64::max);
    let q = measure(&solid(&cuboid), &lumps());
    assert_eq!(q.symmetry_planes, 3);
    assert!((q.asymmetry - expected).abs() < 4e-3, "{} {expected}", q.asymmetry);
    assert!(expected > 0.2);
    // Turned and moved, with another unit: the same.
    let turn = nalgebra::Rotation3::from_euler_angles(0.4, -0.9, 1.7);
    let put = |p: &Vec3| (turn * p) * 1e-6 + Vec3::new(0.5, 3.0, -1.0);
    let moved = cuboid.0.iter().map(|p| put(&Vec3::from(*p)).into()).collect();
    let spheres: Vec<Sphere> =
        lumps().iter().map(|s| Sphere::new(put(&s.center), 1e-6 * s.radius)).collect();
    let again = measure(&solid(&(moved, cuboid.1)), &spheres);
    assert_eq!(again.symmetry_planes, 3);
    assert!((again.asymmetry - expected).abs() < 4e-3, "{} {expected}", again.asymmetry);
}

#[test]
fn a_clump_that_is_its_own_image_has_none() {
    let cuboid = solid(&Primitive::Box { edges: AXES }.mesh(8).unwrap());
    let corner = |k: usize| {
        let sign = |b: usize| if k >> b & 1 == 1 { 1.0 } else { -1.0 };
        sphere(0.3 * sign(0), 0.15 * sign(1), 0.02 * sign(2), 0.21)
    };
    let mut spheres: Vec<Sphere> = (0..8).map(corner).collect();
    let q = measure(&cuboid, &spheres);
    assert!(q.asymmetry < 1e-12, "{}", q.asymmetry);
    // One of them by a tenth smaller.
    spheres[5].radius *= 0.9;
    let q = measure(&cuboid, &spheres);
    let expected = (0..3).map(|axis| by_points(&spheres, axis)).fold(0.0, f64::max);
    assert!((q.asymmetry - expected).abs() < 4e-3 && expected > 0.01, "{} {expected}", q.asymmetry);
}

#[test]
fn planes_are_those_of_the_target() {
    let planes = |p: Primitive| {
        let q = measure(&solid(&p.mesh(24).unwrap()), &[sphere(0.1, 0.2, 0.3, 0.2)]);
        (q.symmetry_planes, q.asymmetry > 0.1)
    };
    assert_eq!(planes(Primitive::Ellipsoid { axes: [0.5, 0.35, 0.2] }), (3, true));
    assert_eq!(planes(Primitive::Cylinder { radius: 0.4, height: 1.5 }), (3, true));
    // A cone is no image of itself across its axis.
    assert_eq!(planes(Primitive::Cone { radius: 0.5, height: 1.5 }), (2, true));
    // Of a stone no plane is one, and nothing is asked of its clump.
    assert_eq!(planes(Primitive::Stone { seed: 3, diameter: 1.0, roughness: 0.5 }), (0, false));
    // An L of cells: its layer alone, and the diagonal, where its arms are as long.
    let layout = Layout { dims: [8, 8, 3], spacing: [0.1; 3], origin: [0.0; 3] };
    let cells: Vec<u8> = (0..192).map(|i| u8::from(i % 8 < 4 || i / 8 % 8 < 4)).collect();
    let run = Run::serial();
    let shape = Shape::from_mask(&cells, &layout, &ImportOptions::default(), &run).unwrap();
    let body = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let q = measure(&body, &[sphere(0.2, 0.2, 0.2, 0.1)]);
    assert_eq!(q.symmetry_planes, 2);
}
