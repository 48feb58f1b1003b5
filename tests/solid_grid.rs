//! The grid of a solid: where it lies, which cells are in, what it may cost.

#![allow(clippy::unwrap_used, clippy::expect_used)]

mod common;

use morula::math::Vec3;
use morula::shape::{Bodies, Body, ImportOptions, Layout, Primitive};
use morula::solid::{Resolution, SolidOptions};
use morula::{Error, Run, Shape, Solid};

fn options(resolution: Resolution) -> SolidOptions {
    SolidOptions { resolution, ..SolidOptions::default() }
}

fn primitive(p: Primitive, segments: usize) -> Shape {
    Shape::from_primitive(&p, segments, &ImportOptions::default(), &Run::serial()).unwrap()
}

fn mesh(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Shape {
    let o = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    Shape::from_mesh(vertices, faces, &o, &Run::serial()).unwrap()
}

fn cuboid(edges: [f64; 3]) -> Shape {
    primitive(Primitive::Box { edges }, 8)
}

fn solid(shape: &Shape, resolution: Resolution) -> Solid {
    Solid::new(shape, &options(resolution), &Run::serial()).unwrap()
}

fn cells_in(s: &Solid) -> usize {
    s.inside().unwrap().iter().map(|&c| usize::from(c)).sum()
}

#[test]
fn a_box_is_full_to_its_faces() {
    let s = solid(&cuboid([1.0, 0.5, 0.25]), Resolution::CellsLongest(32));
    assert_eq!(s.grid().dims, [40, 24, 16]);
    assert_eq!(cells_in(&s), 32 * 16 * 8);
    assert!(s.notes().is_empty());
}

#[test]
fn every_resolution_means_what_it_says() {
    let edges = [3.0, 1.5, 0.75];
    let shape = cuboid(edges);
    let h = |r| solid(&shape, r).grid().spacing.x * shape.frame.scale;
    assert!((h(Resolution::CellsLongest(48)) - 3.0 / 48.0).abs() < 1e-12);
    assert!((h(Resolution::CellsShortest(10)) - 0.075).abs() < 1e-12);
    assert!((h(Resolution::CellSize(0.05)) - 0.05).abs() < 1e-12);
    let d = (6.0 / std::f64::consts::PI * edges.iter().product::<f64>()).cbrt();
    assert!((h(Resolution::CellsDiameter(40)) - d / 40.0).abs() < 1e-12);
    let s = solid(&shape, Resolution::CellsShortest(10));
    assert_eq!(s.grid().dims, [48, 28, 18]);
}

#[test]
fn the_grid_is_centred_and_keeps_its_padding() {
    let shape = primitive(Primitive::Ellipsoid { axes: [1.0, 0.61, 0.37] }, 48);
    for padding in [2, 5] {
        let o = SolidOptions { padding, ..options(Resolution::CellsLongest(30)) };
        let s = Solid::new(&shape, &o, &Run::serial()).unwrap();
        let g = s.grid();
        for a in 0..3 {
            let size = g.dims[a] as f64 * g.spacing[a];
            let middle = shape.frame.to_input(&(g.origin + Vec3::repeat(0.5 * size)))[a];
            assert!(middle.abs() < 1e-12);
        }
        for k in 0..g.dims[2] {
            for j in 0..g.dims[1] {
                for i in 0..g.dims[0] {
                    let border =
                        [i, j, k].iter().zip(g.dims).any(|(&x, n)| x < padding || x + padding >= n);
                    assert!(!border || s.inside().unwrap()[g.index(i, j, k)] == 0);
                }
            }
        }
    }
}

/// Whether the mask equals its mirror image along `axis`.
fn mirrored(s: &Solid, axis: usize) -> bool {
    let g = s.grid();
    (0..g.len()).all(|c| {
        let mut at = [c % g.dims[0], c / g.dims[0] % g.dims[1], c / g.dims[0] / g.dims[1]];
        at[axis] = g.dims[axis] - 1 - at[axis];
        s.inside().unwrap()[c] == s.inside().unwrap()[g.index(at[0], at[1], at[2])]
    })
}

#[test]
fn a_symmetric_body_has_a_symmetric_mask() {
    for n in [15, 16, 31, 40] {
        // Faces at cell centres, at places of columns, and anywhere.
        let m = f64::from(n);
        for edges in [[1.0; 3], [1.0, (m - 1.0) / m, 0.6], [1.0, (m - 1.25) / m, (m - 2.5) / m]] {
            let s = solid(&cuboid(edges), Resolution::CellsLongest(n));
            assert!((0..3).all(|a| mirrored(&s, a)), "{n} {edges:?}");
        }
        let s = solid(
            &primitive(Primitive::Torus { major: 1.0, minor: 0.4 }, 48),
            Resolution::CellsLongest(n),
        );
        assert!((0..3).all(|a| mirrored(&s, a)), "{n}");
    }
}

#[test]
fn half_covered_cells_are_out() {
    // Within a box of 16³ cells a block whose faces lie on cell centres along one axis.
    for axis in 0..3 {
        let (mut v, mut f) = (Vec::new(), Vec::new());
        let mut lo = [4.0; 3];
        let mut hi = [12.0; 3];
        (lo[axis], hi[axis]) = (7.5, 10.5);
        for (lo, hi) in [([0.0; 3], [1.0; 3]), ([15.0; 3], [16.0; 3]), (lo, hi)] {
            let (corners, faces) = Primitive::Box { edges: [1.0; 3] }.mesh(8).unwrap();
            let n = v.len() as u32;
            let place =
                |p: [f64; 3]| std::array::from_fn(|a| lo[a] + (p[a] + 0.5) * (hi[a] - lo[a]));
            v.extend(corners.into_iter().map(place));
            f.extend(faces.into_iter().map(|t| t.map(|i| i + n)));
        }
        let s = solid(&mesh(&v, &f), Resolution::CellSize(1.0));
        assert_eq!(s.grid().dims, [24; 3]);
        assert_eq!(cells_in(&s), 1 + 1 + 2 * 8 * 8);
    }
}

#[test]
fn cells_cut_by_a_plane_are_decided_by_their_centre() {
    // A tetrahedron: away from its edges more than half is covered exactly when the centre is in.
    let v = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.2, 0.9, 0.1], [0.3, 0.2, 0.8]];
    let f = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let s = solid(&mesh(&v, &f), Resolution::CellsLongest(40));
    let Body::Mesh(m) = s.body() else { unreachable!() };
    let g = s.grid();
    let planes: Vec<(Vec3, f64)> = (0..4)
        .map(|i| {
            let [a, b, c] = m.corners(i);
            let n = (b - a).cross(&(c - a)).normalize();
            (n, n.dot(&a))
        })
        .collect();
    let mut checked = 0;
    for k in 0..g.dims[2] {
        for j in 0..g.dims[1] {
            for i in 0..g.dims[0] {
                let p = g.center(i, j, k);
                let d: Vec<f64> = planes.iter().map(|(n, o)| n.dot(&p) - o).collect();
                // At most one plane may cut the cell.
                let near = d.iter().filter(|d| d.abs() < 0.87 * g.spacing.x).count();
                if near <= 1 && d.iter().all(|d| d.abs() > 1e-4 * g.spacing.x) {
                    let expected = d.iter().all(|d| *d < 0.0);
                    assert_eq!(s.inside().unwrap()[g.index(i, j, k)] == 1, expected);
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > g.len() / 2);
}

#[test]
fn coverage_of_curved_bodies_is_right_but_for_ties() {
    // A ball: coverage by 12³ points a cell.
    let shape = primitive(Primitive::Sphere { radius: 1.0 }, 96);
    let s = solid(&shape, Resolution::CellsLongest(12));
    let g = s.grid();
    let n = 12;
    let mut wrong = 0;
    for k in 0..g.dims[2] {
        for j in 0..g.dims[1] {
            for i in 0..g.dims[0] {
                let center = g.center(i, j, k);
                let mut covered = 0;
                for q in 0..n * n * n {
                    let at = Vec3::new((q % n) as f64, (q / n % n) as f64, (q / n / n) as f64);
                    let p = center + (at.add_scalar(0.5) / n as f64).add_scalar(-0.5) * g.spacing.x;
                    let p = shape.frame.to_input(&p);
                    covered += usize::from(p.norm() < 1.0);
                }
                let share = covered as f64 / (n * n * n) as f64;
                let found = s.inside().unwrap()[g.index(i, j, k)] == 1;
                if (share - 0.5).abs() > 0.03 {
                    assert_eq!(found, share > 0.5, "coverage {share}");
                } else {
                    wrong += usize::from(found != (share > 0.5));
                }
            }
        }
    }
    assert!(wrong <= 24, "{wrong}");
}

#[test]
fn voxels_keep_their_cells() {
    let dims = [3, 2, 4];
    let cells: Vec<u8> = (0..24).map(|i| u8::from(i % 5 != 1)).collect();
    let layout = Layout { dims, spacing: [0.5, 1.0, 0.25], origin: [3.0, -2.0, 7.0] };
    let o = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    let run = Run::serial();
    let shape = Shape::from_mask(&cells, &layout, &o, &run).unwrap();
    let s = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let g = s.grid();
    assert_eq!(g.dims, dims.map(|n| n + 8));
    for (c, &cell) in cells.iter().enumerate() {
        let (i, j, k) = (c % 3, c / 3 % 2, c / 6);
        assert_eq!(s.inside().unwrap()[g.index(i + 4, j + 4, k + 4)], cell);
        let center = s.frame().to_input(&g.center(i + 4, j + 4, k + 4));
        let expected = Vec3::new(
            3.0 + 0.5 * (i as f64 + 0.5),
            -2.0 + j as f64 + 0.5,
            7.0 + 0.25 * (k as f64 + 0.5),
        );
        assert!((center - expected).abs().max() < 1e-12);
    }
    assert_eq!(cells_in(&s), cells.iter().filter(|c| **c != 0).count());
}

#[test]
fn thin_shapes_get_enough_cells_and_say_so() {
    for edges in [[100.0, 1.0, 1.0], [1.0, 100.0, 1.0], [100.0, 100.0, 1.0], [1.0, 100.0, 100.0]] {
        let s = solid(&cuboid(edges), Resolution::CellsLongest(64));
        let g = s.grid();
        let thinnest = edges.iter().position(|e| *e == 1.0).unwrap();
        assert!(g.dims[thinnest] >= 12);
        let volume = cells_in(&s) as f64 * (g.spacing.x * s.frame().scale).powi(3);
        assert!((volume / edges.iter().product::<f64>() - 1.0).abs() < 1e-6);
        assert!(s.notes().iter().any(|n| n.contains("thin")), "{:?}", s.notes());
    }
    // The box of a plate on its corner is not thin; the plate is.
    let (mut v, f) = common::cuboid([0.0; 3], [1.0, 1.0, 0.02]);
    let r = nalgebra::Rotation3::from_euler_angles(0.4, 0.7, 0.3);
    v.iter_mut().for_each(|p| *p = (r * Vec3::from(*p)).into());
    let s = solid(&mesh(&v, &f), Resolution::CellsLongest(32));
    assert!(s.notes().iter().any(|n| n.contains("thin")), "{:?}", s.notes());
    let volume = cells_in(&s) as f64 * s.grid().spacing.product();
    assert!((volume / s.unit_moments().volume - 1.0).abs() < 0.1);
    // A cell size that was asked for is kept.
    let e =
        Solid::new(&cuboid([100.0, 1.0, 1.0]), &options(Resolution::CellSize(3.0)), &Run::serial());
    assert!(matches!(e, Err(Error::Empty(_))));
}

#[test]
fn a_very_thin_plate_is_a_cell_thick_or_says_what_it_takes() {
    // Four cells across would be 190 million: it gets one, however little was asked for.
    let plate = cuboid([100.0, 100.0, 0.1]);
    for asked in [64, 600] {
        let s = solid(&plate, Resolution::CellsLongest(asked));
        assert_eq!(s.grid().dims[2], 1 + 2 * 4);
        assert!((4 << 20..16 << 20).contains(&s.grid().len()));
        let volume = cells_in(&s) as f64 * (s.grid().spacing.x * s.frame().scale).powi(3);
        assert!((volume / 1000.0 - 1.0).abs() < 0.15, "{volume}");
        let text = s.notes().join("\n");
        assert!(text.contains("about 0.90 cells of 1.109e-1 lie across its thickness of 9.980e-2"));
        assert!(text.contains("for 4.0 ask for cells of 2.500e-2, 4000 along its longest edge"));
    }
    // Where four million cells show some of the shape there are no more.
    let s = solid(&cuboid([100.0, 100.0, 0.11]), Resolution::CellsLongest(64));
    assert!(s.grid().len() <= 4 << 20);
    assert!(s.notes().join("\n").contains("about 0.73 cells"), "{:?}", s.notes());
    // Thinner, one cell would be too many as well: what was asked for is short of it, and what
    // the error names is not.
    let plate = cuboid([160.0, 0.1, 160.0]);
    let e = refused(&plate, &options(Resolution::CellsLongest(64)));
    let text = e.to_string();
    assert!(matches!(e, Error::Empty(_)));
    assert!(
        text.contains("about 0.40 cells of 2.500e-1 lie across its thickness of 9.988e-2"),
        "{text}"
    );
    assert!(text.contains("for 1.5 ask for cells of 6.658e-2, 2403 along its longest"), "{text}");
    assert!(text.contains("1.4e9 bytes"), "{text}");
    assert!(cells_in(&solid(&plate, Resolution::CellsLongest(2403))) > 2400 * 2400);
    // It refers to the caller's unit, and a size that was asked for is kept.
    let e = refused(&plate, &options(Resolution::CellSize(0.3)));
    assert!(e.to_string().contains("about 0.33 cells of 3.000e-1"), "{e}");
}

fn refused(shape: &Shape, o: &SolidOptions) -> Error {
    Solid::new(shape, o, &Run::serial()).err().unwrap()
}

#[test]
fn what_cannot_be_made_is_refused_before_it_is_tried() {
    let shape = cuboid([1.0, 0.5, 0.25]);
    let e = refused(&shape, &options(Resolution::CellSize(1e-4)));
    assert!(matches!(e, Error::MemoryLimit(_)), "{e}");
    let text = e.to_string();
    assert!(text.contains("10008") && text.contains("2147483648"), "{text}");
    let unlimited = SolidOptions { memory_limit: u64::MAX, ..options(Resolution::CellSize(1e-5)) };
    assert!(matches!(refused(&shape, &unlimited), Error::TooLarge(_)));
    for r in [
        Resolution::CellsLongest(0),
        Resolution::CellsShortest(0),
        Resolution::CellsDiameter(0),
        Resolution::CellSize(0.0),
        Resolution::CellSize(-1.0),
        Resolution::CellSize(f64::NAN),
        Resolution::CellSize(f64::INFINITY),
    ] {
        assert!(matches!(refused(&shape, &options(r)), Error::InvalidArgument(_)), "{r:?}");
    }
    for r in [Resolution::CellsLongest(u32::MAX), Resolution::CellSize(f64::MIN_POSITIVE)] {
        assert!(matches!(refused(&shape, &options(r)), Error::MemoryLimit(_)), "{r:?}");
    }
    for padding in [0, 1, usize::MAX] {
        let e = refused(&shape, &SolidOptions { padding, ..SolidOptions::default() });
        assert!(matches!(e, Error::InvalidArgument(_) | Error::MemoryLimit(_)), "{e}");
    }
    let small = SolidOptions { memory_limit: 1 << 20, ..SolidOptions::default() };
    assert!(matches!(refused(&shape, &small), Error::MemoryLimit(_)));
    let cancel = Run::serial().with_progress(Box::new(|_| true));
    let e = Solid::new(&shape, &SolidOptions::default(), &cancel).err().unwrap();
    assert!(matches!(e, Error::Cancelled(_)));
}

#[test]
fn any_number_of_threads_gives_the_same_mask() {
    let shape = primitive(Primitive::from_name("stone").unwrap(), 48);
    let one = solid(&shape, Resolution::CellsLongest(40));
    let run = Run::new(3).unwrap();
    let three = Solid::new(&shape, &options(Resolution::CellsLongest(40)), &run).unwrap();
    assert_eq!(one.inside().unwrap(), three.inside().unwrap());
}

#[test]
fn a_round_body_far_away_keeps_its_axes() {
    // Two equal moments, but for the digits that the place takes.
    let (vertices, faces) = Primitive::Cylinder { radius: 0.5, height: 2.0 }.mesh(11).unwrap();
    let at = |by: f64| {
        let (sin, cos) = 0.3f64.sin_cos();
        let place = |v: &[f64; 3]| {
            let turned = [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]];
            [turned[0] + by, turned[1] - 0.7 * by, turned[2] + 0.4 * by]
        };
        let moved: Vec<[f64; 3]> = vertices.iter().map(place).collect();
        solid(&mesh(&moved, &faces), Resolution::CellsLongest(16)).principal()
    };
    let near = at(0.0);
    for by in [1e8 / 3.0, 1e8, 2e8 / 0.7] {
        let far = at(by);
        assert!((near.axes - far.axes).abs().max() < 1e-5, "{} {}", near.axes, far.axes);
        let off = near.quaternion.iter().zip(far.quaternion).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-5, "{:?} {:?}", near.quaternion, far.quaternion);
    }
}

#[test]
fn the_body_frame_loses_no_digits_far_from_the_origin() {
    use morula::math::{PrincipalFrame, Sphere};
    let shape = primitive(Primitive::Ellipsoid { axes: [0.5, 1.0, 0.25] }, 24);
    let here = solid(&shape, Resolution::CellsLongest(16));
    let principal = here.principal();
    assert!(principal.moments[0] > 0.0 && principal.moments[0] <= principal.moments[2]);
    let same = PrincipalFrame::of(&here.moments().inertia);
    for i in 0..3 {
        assert!((principal.moments[i] / same.moments[i] - 1.0).abs() < 1e-12);
    }
    let m = here.moments().centroid;
    let on_axis = Sphere::new(m + principal.axes.column(0) * 0.25, 0.1);
    let body = here.to_body(&[Sphere::new(m, 0.1), on_axis]);
    assert!(body[0].center.norm() < 1e-15 && body[0].radius == 0.1);
    assert!((body[1].center - Vec3::new(0.25, 0.0, 0.0)).norm() < 1e-15);
    // Moved by a number that keeps every bit of multiples of 2⁻¹⁰: the same, though the
    // centroid of the caller's frame has lost ten digits.
    let on_lattice = |v: f64| (v * 1024.0).round() / 1024.0;
    let Body::Mesh(mesh) = &*shape.body else { unreachable!() };
    let vertices = |by: f64| -> Vec<[f64; 3]> {
        let place = |p: &Vec3| shape.frame.to_input(p).map(|v| on_lattice(v) + by).into();
        mesh.vertices.iter().map(place).collect()
    };
    let spheres = |by: f64| [Sphere::new(Vec3::new(0.125, 0.25, -0.0625).add_scalar(by), 0.1)];
    let by = 2f64.powi(40);
    let at = |by: f64| {
        let s = solid(&self::mesh(&vertices(by), &mesh.faces), Resolution::CellsLongest(16));
        s.to_body(&spheres(by))
    };
    assert_eq!(at(0.0), at(by));
}
