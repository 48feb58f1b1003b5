//! Pieces of voxels, of open meshes and of those that cross themselves: against the same body as
//! a closed mesh, against formulas; and what they add up to.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::fragments::{lack, made, pieces, plane};
use common::{Arrays, cuboid, join, solid_of, solid_of_mesh, sphere};
use morula::fragment::{
    Cut, CutOptions, Held, Region, ShatterOptions, cut, cut_region, label_solids, shape,
    shatter_labels,
};
use morula::generate::HalfSpace;
use morula::mass::Body;
use morula::math::{Sphere, Vec3};
use morula::shape::{ImportOptions, Layout, Shape};
use morula::solid::SolidOptions;
use morula::{Error, Run, Solid};
use std::f64::consts::PI;

/// Cells of 1/8 for which `f` holds of their middles, in a cube of `n` cells.
fn voxels(n: usize, f: impl Fn([f64; 3]) -> bool) -> Solid {
    let at = |i: usize| (i as f64 + 0.5) / 8.0;
    let cell = |c: usize| u8::from(f([at(c % n), at(c / n % n), at(c / (n * n))]));
    let cells: Vec<u8> = (0..n * n * n).map(cell).collect();
    let layout = Layout { dims: [n; 3], spacing: [0.125; 3], origin: [0.0; 3] };
    let options = ImportOptions { bodies: morula::shape::Bodies::All, ..Default::default() };
    solid_of(&Shape::from_mask(&cells, &layout, &options, &Run::serial()).unwrap(), 16)
}

#[test]
fn a_box_of_cells_is_cut_as_a_box() {
    let mesh = solid_of_mesh(&cuboid([0.0; 3], [2.0, 1.0, 1.5]), 16);
    let cells = voxels(16, |[x, y, z]| x < 2.0 && y < 1.0 && z < 1.5);
    for by in [
        Cut::Planes(vec![plane([0.3, 0.5, -0.7], 0.1), plane([1.0, 0.1, 0.2], 0.9)]),
        Cut::Planes(vec![plane([1.0, 0.0, 0.0], 0.75), plane([0.0, 0.0, 1.0], 0.7)]),
        Cut::Seeded { count: 1 },
        Cut::Points {
            points: [[0.3, 0.2, 0.4], [1.1, 0.8, 0.9], [1.8, 0.3, 0.2]].map(Vec3::from).to_vec(),
            weights: vec![0.0, 0.1, 0.05],
        },
    ] {
        let (f, g) = (made(&mesh, &by), made(&cells, &by));
        assert_eq!(f.regions.len(), g.regions.len(), "{:?}", g.notes);
        for (r, s) in f.regions.iter().zip(&g.regions) {
            let (a, b) = (r.moments(mesh.frame()), s.moments(cells.frame()));
            assert!(lack(&a, &[b]) < 1e-12, "{}", lack(&a, &[b]));
            assert_eq!(r.cell(), s.cell());
        }
        assert!(lack(&cells.moments(), &pieces(&cells, &g)) < 1e-12);
    }
}

#[test]
fn cells_that_a_plane_parts_are_regions_of_their_own() {
    // Two prongs on a bottom, and a cell that hangs on by an edge.
    let u = |[x, y, z]: [f64; 3]| {
        let prong = !(0.75..1.25).contains(&x) && x < 2.0;
        y < 0.5 && (z < 0.5 && x < 2.0 || prong && z < 1.5)
    };
    let solid = voxels(16, u);
    let f = made(&solid, &Cut::Planes(vec![plane([0.05, 0.0, 1.0], 1.03)]));
    assert_eq!(f.regions.len(), 3);
    assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-12);
    assert!(f.regions.iter().all(|r| r.bytes() <= 48 << 10));
    // Each prong: what is between the plane and the top.
    for r in f.regions.iter().filter(|r| r.cell() == 1) {
        let [lo, hi] = r.bounds(solid.frame());
        let middle = 0.5 * (lo.x + hi.x);
        let volume = 0.75 * 0.5 * (1.5 - (1.03 - 0.05 * middle));
        assert!((r.moments(solid.frame()).volume - volume).abs() < 1e-13);
    }
    // A prong again, and again.
    let mut prong = f.regions[2].clone();
    for i in 0..6 {
        let m = prong.moments(solid.frame());
        let n = Vec3::new(f64::from(i % 3), 1.0, f64::from(i % 2) - 0.3);
        let by = Cut::Planes(vec![HalfSpace { normal: n, offset: n.dot(&m.centroid) }]);
        let g = cut_region(&solid, &prong, &by, &CutOptions::default(), &Run::serial()).unwrap();
        assert_eq!(g.regions.len(), 2);
        assert!(lack(&m, &pieces(&solid, &g)) < 1e-12, "{i}");
        prong = g.regions[1].clone();
    }
    // Cells that touch along an edge alone are not one, and neither are those whose common face
    // lies beyond the plane.
    let corner = voxels(8, |[x, y, z]| z < 0.5 && (x < 0.5) == (y < 0.5));
    let f = made(&corner, &Cut::Planes(vec![plane([0.0, 0.0, 1.0], 0.3)]));
    assert_eq!(f.regions.len(), 4);
    let two = voxels(8, |[x, y, z]| y < 0.125 && z < 0.125 && x < 0.25);
    let f = made(&two, &Cut::Planes(vec![plane([1.0, 0.0, 0.0], 0.125)]));
    assert_eq!(f.regions.len(), 2);
}

#[test]
fn a_ball_of_cells_in_random_pieces() {
    let ball = |[x, y, z]: [f64; 3]| (Vec3::new(x, y, z) - Vec3::repeat(1.0)).norm() < 0.95;
    let solid = voxels(16, ball);
    for seed in 0..4 {
        let of = |threads| {
            let run = Run::new(threads).unwrap().with_seed(seed);
            cut(&solid, &Cut::Seeded { count: 9 }, &CutOptions::default(), &run).unwrap()
        };
        let f = of(1);
        assert_eq!(f, of(3));
        assert!(f.regions.len() >= 9);
        assert!(lack(&solid.moments(), &pieces(&solid, &f)) < 1e-12);
    }
}

/// Two balls that cross.
fn crossing() -> Arrays {
    join(&[sphere(48, 96, 1.0, [0.0; 3]), sphere(48, 96, 1.0, [1.2, 0.0, 0.0])])
}

#[test]
fn crossing_balls_add_up() {
    let solid = solid_of_mesh(&crossing(), 32);
    let whole = solid.moments();
    assert!(whole.relative_error > 0.0);
    for n in [[1.0, 0.0, 0.0], [0.3, 0.4, -0.8]] {
        let n = Vec3::from(n).normalize();
        let by = Cut::Planes(vec![HalfSpace { normal: n, offset: n.dot(&whole.centroid) }]);
        let f = made(&solid, &by);
        assert_eq!(f.regions.len(), 2);
        assert!(lack(&whole, &pieces(&solid, &f)) < 1e-12);
        for r in &f.regions {
            let m = r.moments(solid.frame());
            // Half of two balls less their lens, by symmetry.
            let lens = PI / 12.0 * 5.2 * 0.8f64.powi(2);
            let volume = 4.0 / 3.0 * PI - 0.5 * lens;
            assert!((m.volume / volume - 1.0).abs() < 5e-3, "{}", m.volume / volume);
            assert!(m.relative_error > 0.0);
        }
    }
    // Both caps at once: two components of one cell.
    let by = Cut::Planes(vec![plane([0.0, 0.0, 1.0], 0.85)]);
    let f = made(&solid, &by);
    assert_eq!(f.regions.len(), 3, "{:?}", f.notes);
    assert!(lack(&whole, &pieces(&solid, &f)) < 1e-12);
    let cap = PI * 0.15 * 0.15 * (3.0 - 0.15) / 3.0;
    for r in f.regions.iter().filter(|r| r.cell() == 1) {
        assert!((r.moments(solid.frame()).volume / cap - 1.0).abs() < 0.05);
    }
}

/// Volume within the surface of a region, and the edge of the grid's cells.
fn surface_of(solid: &Solid, region: &Region) -> (f64, f64) {
    let own = shape(solid, region, &Run::serial()).unwrap();
    let morula::shape::Body::Mesh(mesh) = &*own.body else { panic!("no mesh") };
    let corners = |f: &[u32; 3]| f.map(|v| mesh.vertices[v as usize]);
    let six = |f: &[u32; 3]| {
        let [a, b, c] = corners(f);
        a.cross(&b).dot(&c)
    };
    // Closed: the areas of all faces add up to nothing.
    let area = mesh.faces.iter().map(corners).map(|[a, b, c]| (b - a).cross(&(c - a)));
    assert!(area.sum::<Vec3>().norm() < 1e-12);
    let volume = mesh.faces.iter().map(six).sum::<f64>() / 6.0 * own.frame.scale.powi(3);
    (volume, solid.grid().spacing.max() * solid.frame().scale)
}

#[test]
fn cells_stand_in_for_surfaces_that_cannot_be_cut() {
    let (v, mut f) = cuboid([0.0; 3], [1.0, 1.0, 1.0]);
    f.drain(2..4);
    let open = solid_of_mesh(&(v, f), 24);
    let balls = solid_of_mesh(&crossing(), 48);
    let slanted = vec![plane([1.0, 0.2, 0.3], 0.6), plane([0.1, 1.0, 0.0], 0.3)];
    // Both caps are of one cell: each has a surface of its own.
    let caps = vec![plane([0.0, 0.0, 1.0], 0.85)];
    for (solid, by, count) in [(&open, &slanted, 4), (&balls, &slanted, 4), (&balls, &caps, 3)] {
        let f = made(solid, &Cut::Planes(by.clone()));
        assert_eq!(f.regions.len(), count);
        let mut sum = 0.0;
        for r in &f.regions {
            let (volume, cell) = surface_of(solid, r);
            let told = r.moments(solid.frame()).volume;
            // To half a cell of the whole surface, at most.
            let most = 3.0 * told.powf(2.0 / 3.0) * cell;
            assert!((volume - told).abs() < most, "{volume} {told} {most}");
            sum += volume;
        }
        let whole = solid.moments().volume;
        assert!((sum / whole - 1.0).abs() < 0.03, "{sum} {whole}");
    }
    // Thinner than cells: that there is none is said.
    let thin = vec![plane([0.0, 0.0, 1.0], 1.0), plane([0.0, 0.0, -1.0], -0.9999)];
    for r in &made(&balls, &Cut::Within(thin)).regions {
        if let Err(e) = shape(&balls, r, &Run::serial()) {
            assert!(matches!(&e, Error::Empty(t) if t.contains("thinner than cells")), "{e}");
        }
    }
}

#[test]
fn a_box_without_a_lid_adds_up() {
    let (v, mut f) = cuboid([0.0; 3], [1.0, 1.0, 1.0]);
    f.drain(2..4);
    let solid = solid_of_mesh(&(v, f), 24);
    let whole = solid.moments();
    let f =
        made(&solid, &Cut::Planes(vec![plane([1.0, 0.0, 0.3], 0.6), plane([0.0, 1.0, 0.0], 0.5)]));
    assert_eq!(f.regions.len(), 4);
    assert!(lack(&whole, &pieces(&solid, &f)) < 1e-12);
    let g = cut_region(
        &solid,
        &f.regions[0],
        &Cut::Seeded { count: 3 },
        &CutOptions::default(),
        &Run::serial(),
    )
    .unwrap();
    assert!(lack(&f.regions[0].moments(solid.frame()), &pieces(&solid, &g)) < 1e-12);
}

#[test]
fn labels_are_a_solid_each() {
    // Label 7 in two places that meet at an edge, label 3 in one, and a single cell of 9.
    let label = |c: usize| match [c % 8, c / 8 % 8, c / 64] {
        [i, j, k] if k < 4 && (i < 4) == (j < 4) => 7,
        [_, _, k] if k > 4 => 3,
        [7, 0, 0] => 9,
        _ => 0u32,
    };
    let labels: Vec<u32> = (0..512).map(label).collect();
    let layout = Layout { dims: [8; 3], spacing: [0.5; 3], origin: [1.0; 3] };
    let solids = Default::default();
    let run = Run::serial();
    let options = CutOptions { least_volume: 0.2 };
    let (made, dust) = label_solids(&labels, &layout, &options, &solids, &run).unwrap();
    assert_eq!((dust.len(), dust[0].cell, dust[0].moments.volume), (1, 9, 0.125));
    assert!((dust[0].moments.centroid - Vec3::new(4.75, 1.25, 1.25)).norm() < 1e-14);
    let found: Vec<(u32, f64)> = made.iter().map(|l| (l.label, l.solid.moments().volume)).collect();
    assert_eq!(found, [(3, 24.0), (7, 8.0), (7, 8.0)]);
    assert_eq!(made[2].solid.moments().centroid, Vec3::new(4.0, 4.0, 2.0));
    let all = label_solids(&labels, &layout, &CutOptions::default(), &solids, &run).unwrap();
    assert_eq!((all.0.len(), all.1.len()), (4, 0));
}

#[test]
fn a_break_by_labels_keeps_everything() {
    // A ball of cells in eight octants; one is cut off its neighbours by background.
    let n = 20;
    let middle = Vec3::repeat(n as f64 / 2.0);
    let label = |c: usize| {
        let at = Vec3::new((c % n) as f64, (c / n % n) as f64, (c / (n * n)) as f64);
        let p = at.add_scalar(0.5) - middle;
        let octant = u32::from(p.x > 0.0) + 2 * u32::from(p.y > 0.0) + 4 * u32::from(p.z > 0.0);
        if p.norm() < 9.0 { octant + 1 } else { 0 }
    };
    let labels: Vec<u32> = (0..n * n * n).map(label).collect();
    let layout = Layout { dims: [n; 3], spacing: [0.1; 3], origin: [5.0; 3] };
    let mask: Vec<u8> = labels.iter().map(|&l| u8::from(l > 0)).collect();
    let run = Run::serial();
    let whole = Shape::from_mask(&mask, &layout, &ImportOptions::default(), &run).unwrap();
    let whole = Solid::new(&whole, &SolidOptions::default(), &run).unwrap();
    let body = Body::of_solid(&whole, 3.0).unwrap();
    let held = Held {
        velocity: Vec3::new(1.0, -2.0, 0.5),
        angular_velocity: Vec3::new(3.0, 1.0, -4.0),
        ..Held::of_body(&body, 1.0).unwrap()
    };
    let solids = SolidOptions::default();
    let options = ShatterOptions::default();
    let broken = |threads: usize| {
        let run = Run::new(threads).unwrap();
        shatter_labels(&labels, &layout, &solids, &[], &held, &options, &run).unwrap()
    };
    let (parents, found) = broken(1);
    assert_eq!((parents.len(), found.fragments.len(), found.dust.len()), (8, 8, 0));
    assert_eq!(found, broken(2).1);
    let mass: f64 = found.fragments.iter().map(|f| f.moving.mass).sum();
    assert!((mass / body.mass - 1.0).abs() < 1e-14);
    assert!(found.inertia_error < 1e-12 && found.energy.abs() < 1e-10 * body.mass);
    assert!(found.shift.norm() < 1e-12);
    let mut share = 0.0;
    for (i, f) in found.fragments.iter().enumerate() {
        assert_eq!(f.region.cell(), i + 1);
        share += f.clump.volume_share;
        for g in &found.fragments[..i] {
            for s in &f.clump.spheres {
                let apart = |t: &Sphere| (s.center - t.center).norm() >= s.radius + t.radius;
                assert!(g.clump.spheres.iter().all(apart));
            }
        }
    }
    assert!(share > 0.6 && share < 1.0, "{share}");
}
