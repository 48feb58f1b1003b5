//! What a cut costs: both sides of a plane through meshes of about 20 000 triangles, with their
//! moments, and eight Voronoi cells.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use morula::fragment::{Cut, CutOptions, cut};
use morula::generate::HalfSpace;
use morula::math::Vec3;
use morula::shape::{Body, ImportOptions, Primitive};
use morula::solid::SolidOptions;
use morula::{Run, Shape, Solid};

fn cuts(c: &mut Criterion) {
    let run = Run::serial();
    let mut group = c.benchmark_group("cut");
    for (name, segments) in [("stone", 156), ("torus", 173)] {
        let p = Primitive::from_name(name).unwrap();
        let shape = Shape::from_primitive(&p, segments, &ImportOptions::default(), &run).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        let Body::Mesh(mesh) = solid.body() else { unreachable!() };
        let faces = mesh.faces.len();
        let m = solid.moments();
        let options = CutOptions::default();
        let mut turn = 0.0f64;
        group.bench_function(format!("{name}, {faces} faces, one plane"), |b| {
            b.iter(|| {
                turn += 1.0;
                let n = Vec3::new(turn.sin(), (1.7 * turn).cos(), (0.3 * turn).sin());
                let by = Cut::Planes(vec![HalfSpace { normal: n, offset: n.dot(&m.centroid) }]);
                cut(&solid, &by, &options, &run).unwrap()
            });
        });
        group.bench_function(format!("{name}, {faces} faces, eight cells"), |b| {
            b.iter(|| cut(&solid, &Cut::Seeded { count: 8 }, &options, &run).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, cuts);
criterion_main!(benches);
