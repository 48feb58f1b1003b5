//! What fragments take: alive, handed on, and while they are cut.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::fragments::plane;
use common::{cuboid, join, solid_of, sphere};
use morula::fragment::{Cut, CutOptions, Fragments, Parent, ReclumpOptions, cut, reclump, shape};
use morula::serial::{fragment_from_bytes, fragment_to_bytes};
use morula::shape::{Bodies, ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Error, Run, Shape, Solid};
use std::sync::Arc;

fn of_mesh(mesh: &common::Arrays) -> Solid {
    common::solid_of_mesh(mesh, 32)
}

fn primitive(p: &Primitive) -> Solid {
    let shape = Shape::from_primitive(p, 48, &ImportOptions::default(), &Run::serial()).unwrap();
    solid_of(&shape, 32)
}

/// Random cells of which a bit more than half are solid, in lumps.
fn foam() -> Solid {
    let n = 40;
    let wave = |x: f64, y: f64, z: f64| (x.sin() * y.cos() + y.sin() * z.cos()) + z.sin() * x.cos();
    let at = |i: usize| 0.9 * i as f64;
    let cell = |c: usize| u8::from(wave(at(c % n), at(c / n % n), at(c / (n * n))) > 0.05);
    let cells: Vec<u8> = (0..n * n * n).map(cell).collect();
    let layout = Layout { dims: [n; 3], spacing: [1.0; 3], origin: [0.0; 3] };
    let options = ImportOptions { bodies: Bodies::All, ..Default::default() };
    solid_of(&Shape::from_mask(&cells, &layout, &options, &Run::serial()).unwrap(), 32)
}

/// A comb of thin teeth on a back.
fn comb() -> Solid {
    let back = cuboid([0.0; 3], [4.0, 2.0, 0.5]);
    let mut all = vec![back];
    for i in 0..20 {
        let x = 0.2 * f64::from(i);
        all.push(cuboid([x, 0.1, 0.4], [x + 0.15, 1.9, 3.0]));
    }
    of_mesh(&join(&all))
}

#[test]
fn a_fragment_takes_64_kib_alive_and_4_kib_handed_on() {
    let torus = primitive(&Primitive::Torus { major: 1.0, minor: 0.4 });
    let stone = primitive(&Primitive::from_name("stone").unwrap());
    let slab =
        |x: f64| Cut::Within(vec![plane([1.0, 0.02, 0.03], x), plane([-1.0, -0.02, -0.03], x)]);
    let teeth = Cut::Planes(vec![plane([0.1, 0.2, 1.0], 1.3), plane([0.0, 1.0, 0.1], 1.0)]);
    let cases: [(&str, Solid, Cut); 5] = [
        ("torus", torus, slab(0.5)),
        ("stone", stone, Cut::Seeded { count: 12 }),
        ("comb", comb(), teeth),
        ("foam", foam(), Cut::Planes(vec![plane([0.3, 0.2, 1.0], 30.0)])),
        (
            "balls",
            of_mesh(&join(&[sphere(24, 48, 1.0, [0.0; 3]), sphere(24, 48, 1.0, [1.5, 0.0, 0.0])])),
            Cut::Planes(vec![plane([0.0, 0.1, 1.0], 0.85)]),
        ),
    ];
    let run = Run::serial();
    for (name, solid, by) in cases {
        let solid = Arc::new(solid);
        let parent = Parent::new(Arc::clone(&solid), &[], &run).unwrap();
        let options = CutOptions { least_volume: 1e-4 * solid.moments().volume };
        let made: Fragments = cut(&solid, &by, &options, &run).unwrap();
        let asked = ReclumpOptions { spheres: 20, quality: false, ..ReclumpOptions::default() };
        let (mut alive, mut bytes, mut marked) = (0, 0, 0);
        for region in &made.regions {
            let Ok(clump) = reclump(&parent, region, &asked, &run) else { continue };
            let map = 12 * clump.map.parents.len() + 4 * clump.map.starts.len();
            alive = alive.max(region.bytes() + size_of_val(clump.spheres.as_slice()) + map);
            let made = fragment_to_bytes(&parent, region, &clump.spheres).unwrap();
            bytes = bytes.max(made.len());
            let back = fragment_from_bytes(&parent, &made).unwrap();
            assert_eq!((&back.region, &back.spheres), (region, &clump.spheres));
            marked += usize::from(region.bytes() > 2048);
        }
        println!("{name}: {} fragments, {marked} marked, {alive} and {bytes}", made.regions.len());
        assert!(alive <= 64 << 10 && bytes <= 4 << 10, "{name}: {alive} and {bytes}");
        assert!(made.regions.len() > 1 && (name == "stone" || marked > 1), "{name} {marked}");
    }
}

#[test]
fn cuts_keep_to_the_memory_limit() {
    let ball = Primitive::Sphere { radius: 1.0 };
    let run = Run::serial();
    let shape_of = Shape::from_primitive(&ball, 200, &ImportOptions::default(), &run).unwrap();
    let of = |memory_limit: u64| {
        let resolution = Resolution::CellsLongest(8);
        let options = SolidOptions { resolution, memory_limit, ..SolidOptions::default() };
        Solid::new(&shape_of, &options, &run).unwrap()
    };
    let faces = shape_of.report.faces;
    assert!(faces > 10_000);
    let halves = Cut::Planes(vec![plane([0.0, 0.1, 1.0], 0.0)]);
    let slices = |n: u32| {
        let at = |i: u32| plane([0.0, 0.1, 1.0], -0.9 + 1.8 * f64::from(i) / f64::from(n));
        Cut::Planes((0..=n).map(at).collect())
    };
    let refused = |solid: &Solid, by: &Cut| {
        let e = cut(solid, by, &CutOptions::default(), &run).unwrap_err();
        assert!(matches!(&e, Error::MemoryLimit(t) if t.contains("face") || t.contains("piece")));
    };
    let small = of(64 * faces);
    refused(&small, &halves);
    refused(&small, &Cut::Seeded { count: 3 });
    let enough = of(300 * faces);
    let made = cut(&enough, &Cut::Seeded { count: 30 }, &CutOptions::default(), &run).unwrap();
    let large = cut(&of(1 << 30), &Cut::Seeded { count: 30 }, &CutOptions::default(), &run);
    assert_eq!(made, large.unwrap());
    assert!(cut(&enough, &slices(4), &CutOptions::default(), &run).is_ok());
    // The surface alone too.
    let made = cut(&enough, &halves, &CutOptions::default(), &run).unwrap();
    let e = shape(&small, &made.regions[0], &run).err().unwrap();
    assert!(matches!(e, Error::MemoryLimit(_)), "{e}");
}
