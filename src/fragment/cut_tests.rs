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
