//! The grid of a solid: where it lies, which cells are in, what it may cost.

#![allow(clippy::unwrap_used, clippy::expect_used)]

use morula::math::Vec3;
use morula::shape::{ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Error, Run, Shape, Solid};

fn solid_of(p: Primitive, resolution: Resolution) -> Solid {
    let run = Run::serial();
    let shape = Shape::from_primitive(&p, 48, &ImportOptions::default(), &run).unwrap();
    Solid::new(&shape, &SolidOptions { resolution, ..SolidOptions::default() }, &run).unwrap()
}

fn mesh(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Shape {
    Shape::from_mesh(vertices, faces, &ImportOptions::default(), &Run::serial()).unwrap()
}

/// A box from its corners.
fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let v = (0..8)
        .map(|c| std::array::from_fn(|a| if c >> a & 1 == 1 { hi[a] } else { lo[a] }))
        .collect();
    let f = [
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
    (v, f.to_vec())
}

#[test]
fn a_box_is_full_to_its_faces() {
    let (v, f) = cuboid([0.0; 3], [1.0, 0.5, 0.25]);
    let options =
        SolidOptions { resolution: Resolution::CellsLongest(32), ..SolidOptions::default() };
    let s = Solid::new(&mesh(&v, &f), &options, &Run::serial()).unwrap();
    assert_eq!(s.grid().dims, [40, 24, 16]);
    let n: usize = s.inside().iter().map(|&c| c as usize).sum();
    assert_eq!(n, 32 * 16 * 8);
}
