use super::*;
use crate::fragment::{self, Cut, CutOptions, Parent, ReclumpOptions, Region};
use crate::generate::{GenerateOptions, HalfSpace, generate};
use crate::math::{Sphere, Vec3};
use crate::shape::{Body, ImportOptions, Layout, Primitive, Shape};
use crate::solid::SolidOptions;
use crate::{Run, Solid};
use proptest::prelude::*;

fn shapes() -> Vec<Shape> {
    let (run, options) = (Run::serial(), ImportOptions::default());
    let stone = Primitive::from_name("stone").unwrap();
    let mesh = Shape::from_primitive(&stone, 12, &options, &run).unwrap();
    let (mut vertices, faces) = Primitive::Box { edges: [1.0; 3] }.mesh(8).unwrap();
    vertices.iter_mut().for_each(|v| v[0] += 1e3);
    let open = Shape::from_mesh(&vertices, &faces[1..], &options, &run).unwrap();
    let cells: Vec<u8> = (0..7 * 5 * 3).map(|i| u8::from(i % 11 != 3)).collect();
    let layout = Layout { dims: [7, 5, 3], spacing: [0.2, 0.3, 0.1], origin: [-4.0, 5.0, 6.0] };
    let voxels = Shape::from_mask(&cells, &layout, &options, &run).unwrap();
    vec![mesh, open, voxels]
}

fn record() -> ClumpRecord {
    let run = Run::serial();
    let solid = Solid::new(&shapes()[0], &SolidOptions::default(), &run).unwrap();
    let options = GenerateOptions { spheres: 5, ..GenerateOptions::default() };
    let mut clump = generate(&solid, &options, &run).unwrap();
    clump.note = "five".into();
    let given = clump.spheres.iter().flat_map(|s| [s.center.x, s.center.y, s.center.z, s.radius]);
    ClumpRecord {
        given: given.collect(),
        wants: 3,
        planes: false,
        moments: *solid.unit_moments(),
        frame: *solid.frame(),
        clump,
    }
}

#[test]
fn shapes_come_back_to_the_last_bit() {
    for shape in shapes() {
        let bytes = shape_to_bytes(&shape).unwrap();
        let back = shape_from_bytes(&bytes).unwrap();
        assert_eq!(back.body, shape.body);
        assert_eq!(back.frame, shape.frame);
        assert_eq!(back.report, shape.report);
        assert_eq!(shape_to_bytes(&back).unwrap(), bytes);
    }
}

#[test]
fn clumps_come_back_without_what_was_counted() {
    let record = record();
    let bytes = record.to_bytes().unwrap();
    let back = ClumpRecord::from_bytes(&bytes).unwrap();
    let counters = back.clump.counters;
    assert_eq!(counters, crate::run::Counters::default());
    let same = ClumpRecord { clump: crate::Clump { counters, ..record.clump.clone() }, ..record };
    assert_eq!(back, same);
    assert_eq!(back.to_bytes().unwrap(), bytes);
}

/// The format itself: other bytes for the same value are another version.
#[test]
fn the_bytes_are_those_of_this_version() {
    let cells = [1u8, 1, 0, 1];
    let layout = Layout { dims: [2, 2, 1], spacing: [1.0; 3], origin: [0.0; 3] };
    let shape = Shape::from_mask(&cells, &layout, &ImportOptions::default(), &Run::serial());
    let bytes = shape_to_bytes(&shape.unwrap()).unwrap();
    assert_eq!(VERSION, 2);
    assert_eq!((bytes.len(), crc32fast::hash(&bytes)), (264, 737_743_638));
    let mut record = record();
    record.clump.spheres = vec![Sphere::new(Vec3::new(1.0, 2.0, 3.0), 4.0)];
    record.given = vec![1.0, 2.0, 3.0, 4.0];
    record.clump.quality = Some(crate::measure::Quality::default());
    record.moments.inertia = crate::math::Inertia::default();
    (record.moments.volume, record.moments.centroid) = (1.0, Vec3::zeros());
    (record.frame.offset, record.frame.scale) = (Vec3::zeros(), 1.0);
    let bytes = record.to_bytes().unwrap();
    assert_eq!((bytes.len(), crc32fast::hash(&bytes)), (377, 3_222_554_654));
}

#[test]
fn what_is_wrong_is_named() {
    let shape = shape_to_bytes(&shapes()[1]).unwrap();
    let clump = record().to_bytes().unwrap();
    let says = |bytes: &[u8], words: &str| {
        let e = shape_from_bytes(bytes).unwrap_err().to_string();
        assert!(e.contains(words), "{e}");
    };
    says(&[], "0 bytes");
    says(&shape[..23], "23 bytes");
    says(&clump, "a clump, not a shape");
    says(&shape[..shape.len() - 1], "the header, which says");
    let with = |at: usize, to: u8| {
        let mut bytes = shape.clone();
        bytes[at] = to;
        bytes
    };
    says(&with(0, b'm'), "do not begin");
    says(&with(8, 9), "version 9");
    says(&with(40, !shape[40]), "checksum");
    // Bytes that someone made on purpose.
    let mut other = shapes().remove(1);
    let Body::Mesh(mesh) = other.body.as_ref() else { panic!("no mesh") };
    let mut mesh = mesh.clone();
    mesh.clean = true;
    other.body = std::sync::Arc::new(Body::Mesh(mesh.clone()));
    says(&shape_to_bytes(&other).unwrap(), "not closed");
    mesh.clean = false;
    mesh.faces[2][1] = 900;
    other.body = std::sync::Arc::new(Body::Mesh(mesh.clone()));
    says(&shape_to_bytes(&other).unwrap(), "face 2");
    mesh.faces[2][1] = 0;
    mesh.vertices[3].y = f64::NAN;
    other.body = std::sync::Arc::new(Body::Mesh(mesh));
    says(&shape_to_bytes(&other).unwrap(), "vertex 3");
    let mut bad = record();
    bad.given[3] = -1.0;
    let e = ClumpRecord::from_bytes(&bad.to_bytes().unwrap()).unwrap_err().to_string();
    assert!(e.contains("sphere 0"), "{e}");
}

fn parent(shape: &Shape) -> Parent {
    let run = Run::serial();
    let resolution = crate::solid::Resolution::CellsLongest(32);
    let options = SolidOptions { resolution, ..SolidOptions::default() };
    let solid = Solid::new(shape, &options, &run).unwrap();
    Parent::new(std::sync::Arc::new(solid), &[], &run).unwrap()
}

fn pieces(parent: &Parent, by: &Cut) -> Vec<(Region, Vec<Sphere>)> {
    let run = Run::serial();
    let found = fragment::cut(parent.solid(), by, &CutOptions::default(), &run).unwrap();
    let options = ReclumpOptions { quality: false, ..ReclumpOptions::default() };
    let spheres = |r: &Region| fragment::reclump(parent, r, &options, &run).unwrap().spheres;
    found.regions.into_iter().map(|r| (r.clone(), spheres(&r))).collect()
}

/// Two ends of a ring between two planes: each has a mark.
fn ring() -> (Parent, Vec<(Region, Vec<Sphere>)>) {
    let torus = Primitive::Torus { major: 1.0, minor: 0.4 };
    let shape = Shape::from_primitive(&torus, 24, &ImportOptions::default(), &Run::serial());
    let parent = parent(&shape.unwrap());
    let slab = |normal: Vec3| HalfSpace { normal, offset: 0.3 };
    let found = pieces(&parent, &Cut::Within(vec![slab(Vec3::x()), slab(-Vec3::x())]));
    (parent, found)
}

#[test]
fn fragments_come_back_and_are_small() {
    let run = Run::serial();
    let stone = &shapes()[0];
    let of_stone = parent(stone);
    let many = pieces(&of_stone, &Cut::Seeded { count: 20 });
    assert_eq!(many.len(), 20);
    let (of_ring, ends) = ring();
    assert!(ends.len() == 2 && ends.iter().all(|(r, _)| r.mark.is_some()));
    for (parent, most, found) in [(&of_stone, 4096, many), (&of_ring, 4096, ends)] {
        for (region, spheres) in found {
            let bytes = fragment_to_bytes(parent, &region, &spheres).unwrap();
            assert!(bytes.len() <= most, "{} bytes, {} spheres", bytes.len(), spheres.len());
            let back = fragment_from_bytes(parent, &bytes).unwrap();
            assert_eq!((&back.region, &back.spheres), (&region, &spheres));
            // It breaks as the one that it stands for.
            let again = |r: &Region| {
                let by = Cut::Seeded { count: 2 };
                fragment::cut_region(parent.solid(), r, &by, &CutOptions::default(), &run).unwrap()
            };
            assert_eq!(again(&back.region), again(&region));
        }
    }
}

#[test]
fn fragments_of_another_parent_are_refused() {
    let (of_ring, ends) = ring();
    let bytes = fragment_to_bytes(&of_ring, &ends[0].0, &ends[0].1).unwrap();
    // The same again is the same parent, and with other spheres too.
    let (again, _) = ring();
    assert!(fragment_from_bytes(&again, &bytes).is_ok());
    let spheres = [Sphere::new(Vec3::x(), 0.3)];
    let with = Parent::new(of_ring.solid().clone(), &spheres, &Run::serial()).unwrap();
    assert!(fragment_from_bytes(&with, &bytes).is_ok());
    for other in shapes().iter().map(parent) {
        let e = fragment_from_bytes(&other, &bytes).unwrap_err();
        assert!(matches!(e, Error::InvalidArgument(_)) && e.to_string().contains("another parent"));
    }
    let e = fragment_from_bytes(&of_ring, &shape_to_bytes(&shapes()[0]).unwrap()).unwrap_err();
    assert!(e.to_string().contains("a shape, not a fragment"), "{e}");
    // Made on purpose.
    let says = |change: &dyn Fn(&mut Region, &mut Vec<Sphere>), words: &str| {
        let (mut region, mut spheres) = ends[0].clone();
        change(&mut region, &mut spheres);
        let bytes = fragment_to_bytes(&of_ring, &region, &spheres).unwrap();
        let e = fragment_from_bytes(&of_ring, &bytes).unwrap_err().to_string();
        assert!(e.contains(words), "{e}");
    };
    says(&|r, _| r.planes[1].normal.x = 0.5, "half-space 1");
    says(&|r, _| r.planes[0].offset = f64::NAN, "half-space 0");
    says(&|_, s| s[2].radius = 0.0, "sphere 2");
    says(&|r, _| r.moments.volume = 9.0, "moments");
    says(&|r, _| r.lo.x = f64::INFINITY, "box");
    says(&|r, _| r.anchor = Some(1 << 40), "face or cell");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// With a checksum that is right again, too: no panic, whatever is done with the region.
    #[test]
    fn changed_bytes_of_fragments_do_no_harm(
        changes in proptest::collection::vec((0usize..4000, any::<u8>()), 1..4),
        mend: bool,
    ) {
        static RING: std::sync::OnceLock<(Parent, Vec<u8>)> = std::sync::OnceLock::new();
        let (parent, bytes) = RING.get_or_init(|| {
            let (parent, ends) = ring();
            let bytes = fragment_to_bytes(&parent, &ends[0].0, &ends[0].1).unwrap();
            (parent, bytes)
        });
        let (mut bytes, run) = (bytes.clone(), Run::serial());
        let from = if mend { 40 } else { 0 };
        for (at, to) in changes {
            let at = from + at % (bytes.len() - from);
            bytes[at] = to;
        }
        if mend {
            let sum = crc32fast::hash(&bytes[24..]).to_le_bytes();
            bytes[12..16].copy_from_slice(&sum);
        }
        if let Ok(found) = fragment_from_bytes(parent, &bytes) {
            let by = Cut::Seeded { count: 2 };
            let options = CutOptions::default();
            let _ = fragment::cut_region(parent.solid(), &found.region, &by, &options, &run);
            let _ = fragment::reclump(parent, &found.region, &ReclumpOptions::default(), &run);
            let _ = fragment::shape(parent.solid(), &found.region, &run);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// With a checksum that is right again, too: no panic, and what is taken for a shape makes
    /// the same bytes again.
    #[test]
    fn changed_bytes_do_no_harm(at in 24usize..3000, to: u8, cut in 0usize..40, mend: bool) {
        let shapes = shapes();
        let mut bytes = shape_to_bytes(&shapes[at % shapes.len()]).unwrap();
        let len = bytes.len();
        bytes[24 + at % (len - 24)] = to;
        bytes.truncate(len - cut.saturating_sub(20));
        if mend {
            let sum = crc32fast::hash(&bytes[24..]).to_le_bytes();
            bytes[12..16].copy_from_slice(&sum);
            let count = (bytes.len() as u64 - 24).to_le_bytes();
            bytes[16..24].copy_from_slice(&count);
        }
        if let Ok(shape) = shape_from_bytes(&bytes) {
            let _ = Solid::new(&shape, &SolidOptions::default(), &Run::serial());
        }
    }
}
