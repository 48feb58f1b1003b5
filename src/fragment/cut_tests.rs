use super::*;
use crate::generate::HalfSpace;
use crate::math::Vec3;
use crate::shape::{Layout, Shape};
use crate::solid::SolidOptions;
use crate::solid::winding::Winding;

/// Random numbers from 0 to 1.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*state >> 11) as f64 / (1u64 << 53) as f64
}

/// What the marks of two pieces of one cell say is true of every point, and they miss few; balls
/// with their exact depth are missed by fewer.
#[test]
fn marks_tell_components_apart() {
    let run = Run::serial();
    let torus = crate::shape::Primitive::Torus { major: 1.0, minor: 0.4 };
    let shape_of = Shape::from_primitive(&torus, 32, &ImportOptions::default(), &run).unwrap();
    let solid = Solid::new(&shape_of, &SolidOptions::default(), &run).unwrap();
    // A plane that nearly leaves the two arcs joined.
    let by = Cut::Planes(vec![HalfSpace { normal: Vec3::x(), offset: 0.59 }]);
    let f = cut(&solid, &by, &CutOptions::default(), &run).unwrap();
    assert_eq!(f.regions.len(), 2);
    let by = Cut::Planes(vec![HalfSpace { normal: Vec3::new(1.0, 0.1, 0.2), offset: 0.2 }]);
    let f = cut(&solid, &by, &CutOptions::default(), &run).unwrap();
    assert_eq!(f.regions.len(), 2);
    let by = Cut::Planes(vec![
        HalfSpace { normal: Vec3::x(), offset: 0.3 },
        HalfSpace { normal: -Vec3::x(), offset: 0.3 },
    ]);
    let f = cut(&solid, &by, &CutOptions::default(), &run).unwrap();
    let slab: Vec<&Region> = f.regions.iter().filter(|r| r.mark.is_some()).collect();
    assert_eq!(slab.len(), 2);
    let mut state = 1;
    let (mut held, mut missed) = (0, 0);
    let windings: Vec<Winding> = slab
        .iter()
        .map(|r| {
            let own = shape(&solid, r, &run).unwrap();
            let Body::Mesh(mesh) = &*own.body else { panic!("no mesh") };
            // In the parent's frame again.
            let mut mesh = mesh.clone();
            for v in &mut mesh.vertices {
                *v = solid.frame().to_unit(&own.frame.to_input(v));
            }
            Winding::new(&mesh).unwrap()
        })
        .collect();
    for _ in 0..4000 {
        let (lo, hi) = (slab[0].lo.inf(&slab[1].lo), slab[0].hi.sup(&slab[1].hi));
        let p = Vec3::from_fn(|a, _| lo[a] + (hi[a] - lo[a]) * random(&mut state));
        for (i, r) in slab.iter().enumerate() {
            if windings[i].at(&p) > 0.5 {
                if r.holds(&p) {
                    held += 1
                } else {
                    missed += 1
                }
                assert!(!slab[1 - i].holds(&p), "{p}");
            }
        }
    }
    assert!(held > 1000 && missed < held / 50, "{held} {missed}");
}

/// The same of cells that meet at an edge.
#[test]
fn marks_of_cells_refuse_what_is_in_doubt() {
    let run = Run::serial();
    let cells: Vec<u8> = (0..512).map(|c| u8::from((c % 8 < 4) == (c / 8 % 8 < 4))).collect();
    let layout = Layout { dims: [8; 3], spacing: [0.125; 3], origin: [0.0; 3] };
    let options = ImportOptions { bodies: crate::shape::Bodies::All, ..Default::default() };
    let shape = Shape::from_mask(&cells, &layout, &options, &run).unwrap();
    let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let f = cut(&solid, &Cut::Within(vec![]), &CutOptions::default(), &run).unwrap();
    assert_eq!(f.regions.len(), 2);
    let mut state = 1;
    for _ in 0..2000 {
        let p = Vec3::from_fn(|_, _| random(&mut state));
        let own = usize::from(p.x >= 0.5);
        if (p.x < 0.5) == (p.y < 0.5) {
            assert!(!f.regions[1 - own].holds(&p));
            let edge = (p.x - 0.5).abs().max((p.y - 0.5).abs());
            assert!(f.regions[own].holds(&p) || edge < 0.02, "{p}");
            let depth = (p.x - 0.5).abs().min((p.y - 0.5).abs()).min(p.z).min(1.0 - p.z);
            assert!(f.regions[own].holds_ball(&p, depth) || edge < 0.02);
        }
    }
}

/// Six times the volume of a surface, and whether each edge has as many faces one way as the other.
fn six_volumes(mesh: &crate::shape::Mesh) -> (f64, bool) {
    let mut edges = std::collections::BTreeMap::<[u32; 2], i32>::new();
    let mut sum = 0.0;
    for (i, f) in mesh.faces.iter().enumerate() {
        let [a, b, c] = mesh.corners(i);
        sum += a.cross(&b).dot(&c);
        for k in 0..3 {
            let (v, w) = (f[k], f[(k + 1) % 3]);
            *edges.entry([v.min(w), v.max(w)]).or_default() += if v < w { 1 } else { -1 };
        }
    }
    (sum, edges.values().all(|n| *n == 0))
}

#[test]
fn surfaces_of_cells_hold_what_the_moments_say() {
    let run = Run::serial();
    // A ring with arms, cells that touch at edges alone among them; edges of three lengths.
    let dims = [17, 15, 12];
    let cells: Vec<u8> = (0..dims[0] * dims[1] * dims[2])
        .map(|i| {
            let at = [i % 17, i / 17 % 15, i / 255].map(|x| x as f64);
            let r = ((at[0] - 8.0).powi(2) + (at[1] - 7.0).powi(2)).sqrt();
            u8::from((3.0..7.6).contains(&r) && (i % 7 != 0 || at[2] < 5.0))
        })
        .collect();
    let layout = Layout { dims, spacing: [0.2, 0.3, 0.25], origin: [5.0, -3.0, 1e3] };
    let import = ImportOptions { bodies: crate::shape::Bodies::All, ..ImportOptions::default() };
    let body = Shape::from_mask(&cells, &layout, &import, &run).unwrap();
    let solid = Solid::new(&body, &SolidOptions::default(), &run).unwrap();
    let slab = |x: f64, normal: Vec3| HalfSpace {
        normal,
        offset: normal.dot(&Vec3::new(x, -0.8, 1001.5)),
    };
    let slanted = vec![
        slab(6.7, Vec3::new(1.0, 0.2, 0.3)),
        slab(6.5, Vec3::new(-0.1, 1.0, 0.4)),
        slab(7.0, Vec3::new(0.3, -0.7, 1.0)),
    ];
    // Along faces of cells, too.
    let straight = vec![
        HalfSpace { normal: Vec3::x(), offset: 5.0 + 8.0 * 0.2 },
        HalfSpace { normal: Vec3::z(), offset: 1e3 + 6.1 * 0.25 },
    ];
    let cuts = [
        Cut::Planes(slanted),
        Cut::Planes(straight),
        Cut::Within(vec![slab(7.2, Vec3::x()), slab(6.2, -Vec3::x())]),
        Cut::Seeded { count: 9 },
    ];
    let mut open = Vec::new();
    for by in cuts {
        let f = cut(&solid, &by, &CutOptions { least_volume: 1e-6 }, &run).unwrap();
        assert!(f.regions.len() > 1, "{by:?}");
        for (i, r) in f.regions.iter().enumerate() {
            let own = shape(&solid, r, &run).unwrap();
            let Body::Mesh(mesh) = &*own.body else { panic!("no mesh") };
            let (six, closed) = six_volumes(mesh);
            let volume = six / 6.0 * own.frame.scale.powi(3);
            let told = r.moments(solid.frame()).volume;
            assert!((volume / told - 1.0).abs() < 1e-9, "{by:?} {i}: {volume} {told}");
            let Body::Voxels(v) = solid.body() else { panic!("no voxels") };
            let skin = Blocks::of(v, solid.memory_limit()).skin(r).unwrap();
            let raw =
                crate::shape::Mesh { vertices: skin.vertices, faces: skin.faces, clean: false };
            let (six, whole) = six_volumes(&raw);
            let off = six / 6.0 - r.moments.volume;
            assert!(off.abs() < 1e-14 + 1e-12 * r.moments.volume, "{by:?} {i}: {off}");
            open.push((format!("{by:?} {i}"), whole, closed, own.report.notes));
        }
    }
    open.retain(|(_, whole, closed, _)| !(*whole && *closed));
    assert!(open.is_empty(), "{open:#?}");
    // The fragment of a fragment.
    let halves = Cut::Planes(vec![slab(6.7, Vec3::new(0.0, 1.0, 0.3))]);
    let f = cut(&solid, &Cut::Seeded { count: 3 }, &CutOptions::default(), &run).unwrap();
    let again = cut_region(&solid, &f.regions[0], &halves, &CutOptions::default(), &run).unwrap();
    let sum: f64 = again
        .regions
        .iter()
        .map(|r| {
            let own = shape(&solid, r, &run).unwrap();
            let Body::Mesh(mesh) = &*own.body else { panic!("no mesh") };
            six_volumes(mesh).0 / 6.0 * own.frame.scale.powi(3)
        })
        .sum();
    let whole = f.regions[0].moments(solid.frame()).volume;
    assert!((sum / whole - 1.0).abs() < 1e-9, "{sum} {whole}");
}
