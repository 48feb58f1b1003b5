use super::*;
use crate::run::{Pool, Run};
use crate::shape::primitive::Primitive;
use crate::shape::voxels::Layout;
use crate::shape::{ImportOptions, Shape};
use crate::solid::SolidOptions;
use nalgebra::Rotation3;

type Arrays = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Images that are found, and the greatest distance of one from the surface, in cells.
fn found(shape: &Shape) -> (usize, f64) {
    let run = Run::serial();
    let solid = Solid::new(shape, &SolidOptions::default(), &run).unwrap();
    let field = Field::new(solid.grid(), solid.distance(&run).unwrap(), &Pool::serial()).unwrap();
    let group = find(&solid, &field, &|_| true).unwrap();
    let probe = Probe::new(&solid, &field).unwrap();
    let off = group.elements().iter().map(|m| probe.off(m, POINTS)).fold(0.0, f64::max);
    (group.len(), off / f64::from(field.cell()))
}

fn of(m: &Arrays, turn: [f64; 3], scale: f64, at: f64) -> (usize, f64) {
    let turn = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
    let place = |v: &[f64; 3]| {
        let p = (turn * Vec3::from(*v)) * scale;
        [p.x + at, p.y - 2.0 * at, p.z + 0.5 * at]
    };
    let vertices: Vec<[f64; 3]> = m.0.iter().map(place).collect();
    let shape =
        Shape::from_mesh(&vertices, &m.1, &ImportOptions::default(), &Run::serial()).unwrap();
    found(&shape)
}

fn named(name: &str) -> Arrays {
    Primitive::from_name(name).unwrap().mesh(64).unwrap()
}

fn cuboid(edges: [f64; 3]) -> Arrays {
    Primitive::Box { edges }.mesh(8).unwrap()
}

/// A prism over a regular polygon.
fn prism(n: u32, height: f64) -> Arrays {
    let corner = |k: u32| (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
    let ring = |z: f64| (0..n).map(corner).map(move |(s, c)| [c, s, z]);
    let mut vertices: Vec<[f64; 3]> = ring(0.0).chain(ring(height)).collect();
    vertices.extend([[0.0, 0.0, 0.0], [0.0, 0.0, height]]);
    let mut faces = Vec::new();
    for k in 0..n {
        let j = (k + 1) % n;
        faces.extend([[k, j, n + j], [k, n + j, n + k], [2 * n, j, k], [2 * n + 1, n + k, n + j]]);
    }
    (vertices, faces)
}

const STRAIGHT: [f64; 3] = [0.0; 3];
const TURNED: [f64; 3] = [0.4, -0.7, 1.1];

#[test]
fn bodies_have_the_symmetry_that_they_have() {
    for (name, m, straight, turned) in [
        ("cube", cuboid([1.0; 3]), 48, 48),
        ("box", cuboid([1.0, 0.8, 0.6]), 8, 8),
        ("square prism", cuboid([1.0, 1.0, 0.6]), 16, 16),
        ("triangular prism", prism(3, 0.8), 12, 12),
        ("hexagonal prism", prism(6, 1.2), 24, 24),
        ("prism of 22 sides", prism(22, 1.2), 8, 8),
        ("ellipsoid", named("ellipsoid"), 8, 8),
        ("sphere", named("sphere"), 48, 48),
        ("torus", named("torus"), 16, 16),
        ("cylinder", named("cylinder"), 16, 16),
        ("tablet", named("tablet"), 16, 16),
        ("cone", named("cone"), 8, 8),
        ("stone", named("stone"), 1, 1),
    ] {
        for (turn, order) in [(STRAIGHT, straight), (TURNED, turned)] {
            let (found, off) = of(&m, turn, 1.0, 0.0);
            assert_eq!(found, order, "{name} {turn:?}");
            // Far from what would not be taken.
            assert!(off < 0.7 * CELL, "{name} {turn:?}: {off}");
        }
        for (scale, at) in [(1e-9, 0.0), (1e6, 3e12)] {
            assert_eq!(of(&m, STRAIGHT, scale, at).0, straight, "{name} {scale} {at}");
        }
    }
}

#[test]
fn bodies_that_nearly_have_a_symmetry_do_not() {
    for (edges, order) in [([1.0, 1.0, 1.02], 16), ([1.0, 0.98, 1.02], 8)] {
        assert_eq!(of(&cuboid(edges), STRAIGHT, 1.0, 0.0).0, order);
    }
    // Two corners moved along z keep one mirror plane; two across it as well, none.
    let mut m = cuboid([1.0, 0.8, 0.6]);
    for v in m.0.iter_mut().filter(|v| v[1] > 0.0 && v[2] > 0.0) {
        v[2] += 0.1;
    }
    m.0.iter_mut().filter(|v| v[1] < 0.0 && v[2] < 0.0).for_each(|v| v[1] -= 0.15);
    assert_eq!(of(&m, STRAIGHT, 1.0, 0.0).0, 2);
    assert_eq!(of(&m, TURNED, 1.0, 0.0).0, 2);
    m.0.iter_mut().filter(|v| v[0] > 0.0).for_each(|v| v[1] *= 1.1);
    assert_eq!(of(&m, STRAIGHT, 1.0, 0.0).0, 1);
}

#[test]
fn voxels_have_it_too() {
    let body = |dims: [usize; 3], inside: &dyn Fn(Vec3) -> bool| {
        let mut cells = Vec::new();
        for k in 0..dims[2] {
            for j in 0..dims[1] {
                for i in 0..dims[0] {
                    let p = Vec3::new(i as f64 + 0.5, j as f64 + 0.5, k as f64 + 0.5);
                    cells.push(u8::from(inside(p)));
                }
            }
        }
        let layout = Layout { dims, spacing: [0.5; 3], origin: [7.0, 8.0, 9.0] };
        found(
            &Shape::from_mask(&cells, &layout, &ImportOptions::default(), &Run::serial()).unwrap(),
        )
        .0
    };
    assert_eq!(body([20, 20, 20], &|_| true), 48);
    assert_eq!(body([30, 20, 20], &|_| true), 16);
    assert_eq!(body([30, 20, 14], &|_| true), 8);
    assert_eq!(body([30, 20, 14], &|p| p.x < 20.0 || p.y < 12.0), 2);
    // Turned: borders are where cells end.
    let turn = Rotation3::from_euler_angles(0.4, -0.7, 1.1);
    let middle = Vec3::new(24.3, 24.1, 23.8);
    let axes = Vec3::new(21.0, 15.0, 10.0);
    let ellipsoid = |p: Vec3| (turn * (p - middle)).component_div(&axes).norm() < 1.0;
    assert_eq!(body([48; 3], &ellipsoid), 8);
    let dented = |p: Vec3| {
        let q = turn * (p - middle);
        ellipsoid(p) && (q - Vec3::new(21.0, 3.0, 4.0)).norm() > 8.0
    };
    assert_eq!(body([48; 3], &dented), 1);
}
