//! The analytic particles: closed, outward, well-shaped, symmetric meshes that
//! converge to the exact moments at second order.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use morula::error::Error;
use morula::shape::{ImportOptions, Parameter, Primitive};
use morula::{Run, Shape};
use std::collections::{BTreeMap, BTreeSet};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn all() -> Vec<Primitive> {
    let mut all: Vec<_> =
        Primitive::NAMES.iter().map(|n| Primitive::from_name(n).unwrap()).collect();
    all.extend([
        Primitive::Superellipsoid { axes: [1.0, 0.8, 0.6], exponents: [1.5, 0.4] },
        Primitive::Superellipsoid { axes: [1.0, 1.0, 1.0], exponents: [2.2, 2.2] },
        Primitive::Superellipsoid { axes: [0.4, 0.8, 1.6], exponents: [0.2, 0.3] },
        Primitive::Superellipsoid { axes: [1.0, 0.5, 1.5], exponents: [0.3, 1.0] },
        Primitive::Superellipsoid { axes: [1.0; 3], exponents: [0.1, 0.1] },
        Primitive::Superellipsoid { axes: [1.0; 3], exponents: [0.1, 2.5] },
        Primitive::Superellipsoid { axes: [1.0; 3], exponents: [2.5, 0.1] },
        Primitive::Box { edges: [3.0, 1.0, 0.4] },
        Primitive::Cylinder { radius: 2.0, height: 0.3 },
        Primitive::Cylinder { radius: 0.2, height: 4.0 },
        Primitive::Tablet { band_radius: 1.0, band_height: 0.5, cap_height: 1.0 },
        Primitive::Torus { major: 1.0, minor: 0.05 },
        Primitive::Ellipsoid { axes: [3.0, 2.0, 1.0] },
    ]);
    all
}

/// Volume, first and second moments (xx, yy, zz, xy, xz, yz) by signed
/// tetrahedra from the origin.
fn integrals((vertices, faces): &Mesh) -> (f64, [f64; 3], [f64; 6]) {
    let (mut volume, mut first, mut second) = (0.0, [0.0; 3], [0.0; 6]);
    for f in faces {
        let [a, b, c] = f.map(|v| vertices[v as usize]);
        let v = (a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))
            / 6.0;
        volume += v;
        let s = [0, 1, 2].map(|i| a[i] + b[i] + c[i]);
        for (m, s) in first.iter_mut().zip(s) {
            *m += v * s / 4.0;
        }
        let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        for (m, (i, j)) in second.iter_mut().zip(pairs) {
            *m += v * (s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) / 20.0;
        }
    }
    (volume, first, second)
}

#[test]
fn meshes_are_closed_outward_and_without_slivers() {
    for p in all() {
        for segments in [8, 13, 24, 64] {
            let mesh = p.mesh(segments).unwrap();
            let (vertices, faces) = &mesh;
            let mut edges = BTreeMap::new();
            for f in faces {
                for (a, b) in [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])] {
                    assert_ne!(a, b);
                    *edges.entry((a, b)).or_insert(0) += 1;
                }
            }
            for (&(a, b), &n) in &edges {
                assert_eq!(n, 1, "{p:?} {segments}: edge {a} {b}");
                assert!(edges.contains_key(&(b, a)), "{p:?} {segments}: edge {a} {b} is open");
            }
            let genus = if p.name() == "torus" { 1 } else { 0 };
            let euler = vertices.len() as i64 - edges.len() as i64 / 2 + faces.len() as i64;
            assert_eq!(euler, 2 - 2 * genus, "{p:?} {segments}");
            assert!(vertices.iter().flatten().all(|v| v.is_finite()));
            let distinct: BTreeSet<_> =
                vertices.iter().map(|v| v.map(|x| (x + 0.0).to_bits())).collect();
            assert_eq!(distinct.len(), vertices.len(), "{p:?} {segments}: equal vertices");
            assert!(integrals(&mesh).0 > 0.0, "{p:?} {segments}");
            assert_eq!(mesh, p.mesh(segments).unwrap());
        }
    }
}

/// Least angle of any triangle, in degrees.
fn least_angle((vertices, faces): &Mesh) -> f64 {
    let mut least = 180.0f64;
    for f in faces {
        let p = f.map(|v| vertices[v as usize]);
        for i in 0..3 {
            let to = |j: usize| [0, 1, 2].map(|a| p[j % 3][a] - p[i][a]);
            let (u, v) = (to(i + 1), to(i + 2));
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let cos = dot(u, v) / (dot(u, u) * dot(v, v)).sqrt();
            least = least.min(cos.clamp(-1.0, 1.0).acos().to_degrees());
        }
    }
    least
}

#[test]
fn triangles_are_well_shaped() {
    for (name, bound) in [
        ("sphere", 29.0),
        ("ellipsoid", 15.0),
        ("superellipsoid", 10.0),
        ("box", 44.9),
        ("cylinder", 29.0),
        ("capsule", 29.0),
        ("torus", 20.0),
        ("cone", 15.0),
        ("tablet", 29.0),
        ("mandm", 15.0),
        ("stone", 8.0),
    ] {
        let angle = least_angle(&Primitive::from_name(name).unwrap().mesh(64).unwrap());
        println!("{name}: least angle {angle:.1}");
        assert!(angle > bound, "{name}: least angle {angle}");
    }
}

#[test]
fn meshes_have_the_mirror_planes_of_their_bodies() {
    for p in all().into_iter().filter(|p| p.name() != "stone") {
        let (vertices, faces) = p.mesh(40).unwrap();
        let key = |v: [f64; 3]| v.map(|x| (x + 0.0).to_bits());
        let numbers: BTreeMap<_, _> =
            vertices.iter().enumerate().map(|(i, &v)| (key(v), i as u32)).collect();
        let canonical = |mut f: [u32; 3]| {
            f.sort();
            f
        };
        let set: BTreeSet<_> = faces.iter().map(|&f| canonical(f)).collect();
        for axis in 0..if p.name() == "cone" { 2 } else { 3 } {
            let mirrored = |i: u32| {
                let mut v = vertices[i as usize];
                v[axis] = -v[axis];
                *numbers.get(&key(v)).unwrap_or_else(|| panic!("{p:?}: no mirror of {v:?}"))
            };
            for f in &faces {
                assert!(set.contains(&canonical(f.map(mirrored))), "{p:?}: axis {axis}, {f:?}");
            }
        }
    }
}

#[test]
fn moments_converge_at_second_order() {
    for p in all().into_iter().filter(|p| p.name() != "stone") {
        let exact = p.moments().unwrap();
        let i = exact.inertia;
        assert_eq!((i.xy, i.xz, i.yz), (0.0, 0.0, 0.0));
        let errors = [64, 128].map(|segments| {
            let mesh = p.mesh(segments).unwrap();
            let (volume, first, m) = integrals(&mesh);
            let size = volume.cbrt();
            for c in first {
                assert!((c / volume).abs() < 2e-3 * size, "{p:?}: centroid {first:?}");
            }
            for product in [m[3], m[4], m[5]] {
                assert!(product.abs() < 1e-12 * size.powi(5), "{p:?}: product {product}");
            }
            [
                volume / exact.volume - 1.0,
                (m[1] + m[2]) / i.xx - 1.0,
                (m[0] + m[2]) / i.yy - 1.0,
                (m[0] + m[1]) / i.zz - 1.0,
            ]
            .map(f64::abs)
        });
        println!("{p:?}: {:.1e} then {:.1e}", errors[0][0], errors[1][0]);
        // Exponents above 2 have cusps, where the curvature has no bound.
        let cusps =
            matches!(p, Primitive::Superellipsoid { exponents: [e, f], .. } if e.max(f) > 2.0);
        let rate = if cusps { 0.5 } else { 0.3 };
        for (coarse, fine) in errors[0].iter().zip(errors[1]) {
            assert!(fine < 1e-12 || fine < rate * coarse, "{p:?}: {coarse:e} then {fine:e}");
            assert!(fine < 0.01, "{p:?}: {fine:e}");
        }
    }
}

#[test]
fn a_superellipsoid_has_the_moments_of_its_sections() {
    // Sections at height z are superellipses scaled by (1 − |z/c|^(2/e1))^(e1/2);
    // their area and second moments by quadrature too: y(x) in closed form.
    for exponents in [[0.5, 0.5], [1.0, 1.0], [1.6, 0.7], [0.3, 2.0]] {
        let [a, b, c] = [1.3, 0.8, 0.6];
        let [e1, e2] = exponents;
        // Midpoint sums over u in [0, 1], made dense at 1 by x = 1 − (1 − u)³.
        let quadrature = |f: &dyn Fn(f64) -> f64| {
            let n = 200_000;
            (0..n)
                .map(|i| {
                    let u = 1.0 - (i as f64 + 0.5) / n as f64;
                    let v = 1.0 - u * u * u;
                    // Dense at 0 too.
                    let x = v * v * v;
                    f(x) * 3.0 * v * v * 3.0 * u * u / n as f64
                })
                .sum::<f64>()
        };
        let curve = |x: f64, e: f64| (1.0 - x.powf(2.0 / e)).powf(e / 2.0);
        let area = 4.0 * quadrature(&|x| curve(x, e2));
        let wide = 4.0 * quadrature(&|x| x * x * curve(x, e2));
        let volume = 2.0 * a * b * c * area * quadrature(&|z| curve(z, e1).powi(2));
        let fourth = 2.0 * a * b * c * wide * quadrature(&|z| curve(z, e1).powi(4));
        let (x2, y2) = (fourth * a * a, fourth * b * b);
        let z2 = 2.0 * a * b * c.powi(3) * area * quadrature(&|z| z * z * curve(z, e1).powi(2));
        let m = Primitive::Superellipsoid { axes: [a, b, c], exponents }.moments().unwrap();
        for (found, expected) in [
            (m.volume, volume),
            (m.inertia.xx, y2 + z2),
            (m.inertia.yy, x2 + z2),
            (m.inertia.zz, x2 + y2),
        ] {
            assert!((found / expected - 1.0).abs() < 1e-8, "{exponents:?}: {found} {expected}");
        }
    }
}

#[test]
fn every_particle_is_a_clean_shape() {
    for name in Primitive::NAMES {
        let p = Primitive::from_name(name).unwrap();
        let shape =
            Shape::from_primitive(&p, 64, &ImportOptions::default(), &Run::serial()).unwrap();
        let r = &shape.report;
        assert!(r.watertight && r.oriented && !r.inverted, "{name}: {r:?}");
        assert_eq!((r.components, r.bodies, r.welded_vertices), (1, 1, 0), "{name}");
        assert_eq!((r.degenerate_faces, r.duplicate_faces, r.faces_turned), (0, 0, 0), "{name}");
        assert!(r.notes.is_empty(), "{name}: {:?}", r.notes);
        let volume = integrals(&p.mesh(64).unwrap()).0;
        assert!((r.volume / volume - 1.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn known_volumes() {
    let volume = |name: &str| Primitive::from_name(name).unwrap().moments().unwrap().volume;
    let pi = std::f64::consts::PI;
    let tablet = pi * 5.675f64.powi(2) * 4.0
        + 2.0 * pi * 1.23 * (3.0 * 5.675f64.powi(2) + 1.23f64.powi(2)) / 6.0;
    for (name, expected) in [
        ("sphere", 4.0 / 3.0 * pi),
        ("cylinder", pi / 4.0),
        ("capsule", pi / 4.0 + pi / 6.0),
        ("cone", 2.0 / 3.0 * pi),
        ("tablet", tablet),
        ("torus", 2.0 * pi * pi * 0.16),
    ] {
        assert!((volume(name) / expected - 1.0).abs() < 1e-14, "{name}");
    }
    assert!(Primitive::from_name("stone").unwrap().moments().is_none());
}

#[test]
fn vertices_of_smooth_bodies_lie_on_them() {
    let (vertices, _) = Primitive::from_name("torus").unwrap().mesh(32).unwrap();
    for [x, y, z] in vertices {
        assert!((((x * x + y * y).sqrt() - 1.0).hypot(z) - 0.4).abs() < 1e-14);
    }
    let (vertices, _) = Primitive::from_name("tablet").unwrap().mesh(32).unwrap();
    let sphere = (5.675f64.powi(2) + 1.23f64.powi(2)) / 2.46;
    for [x, y, z] in vertices {
        let r = x.hypot(y);
        let cap = (z.abs() - (3.23 - sphere)).hypot(r) - sphere;
        assert!(cap.abs() < 1e-12 || (r - 5.675).abs() < 1e-12 && z.abs() <= 2.0, "{r} {z}");
    }
}

#[test]
fn stones_differ_by_seed_and_only_by_seed() {
    let stone =
        |seed, roughness| Primitive::Stone { seed, diameter: 2.0, roughness }.mesh(48).unwrap();
    assert_eq!(stone(7, 0.5), stone(7, 0.5));
    assert_ne!(stone(7, 0.5), stone(8, 0.5));
    assert_ne!(stone(7, 0.5), stone(7, 0.6));
    // +, −, ×, ÷ and √ only, so these are the bytes on every platform.
    let hash = stone(7, 0.5).0.iter().flatten().fold(0u64, |h, v| h.rotate_left(5) ^ v.to_bits());
    assert_eq!(hash, 0x4b20_cc0c_787c_8412);
    for seed in 0..20 {
        for roughness in [0.0, 0.5, 1.0] {
            let mesh = stone(seed, roughness);
            let (volume, first, m) = integrals(&mesh);
            let ball = 4.0 / 3.0 * std::f64::consts::PI;
            assert!((volume / ball - 1.0).abs() < 1e-12, "volume {volume}");
            assert!(first.iter().all(|c| c.abs() < 1e-12), "centroid {first:?}");
            // Neither flat nor a needle.
            let (low, high) = (m[0].min(m[1]).min(m[2]), m[0].max(m[1]).max(m[2]));
            assert!(high / low < 8.0, "seed {seed}: second moments {m:?}");
        }
    }
}

#[test]
fn parameters_are_named_set_and_checked() {
    for name in Primitive::NAMES {
        let mut p = Primitive::from_name(name).unwrap();
        assert_eq!(p.name(), name);
        for Parameter { key, value, meaning } in p.parameters() {
            assert!(!meaning.is_empty());
            let before = p;
            p.set(key, value).unwrap();
            assert_eq!(p, before);
            assert!(matches!(
                p.set(key, f64::NAN),
                Err(Error::NotFinite(_) | Error::InvalidArgument(_))
            ));
            assert!(matches!(p.set(key, -1.0), Err(Error::InvalidArgument(t)) if t.contains(key)));
            p.set(key, 1.0).unwrap();
            assert_eq!(p.parameters().iter().find(|q| q.key == key).unwrap().value, 1.0);
            p = before;
        }
        let e = p.set("colour", 1.0).unwrap_err();
        assert!(e.to_string().contains("no parameter \"colour\""), "{e}");
        for segments in [0, 7, 2049, usize::MAX] {
            assert!(matches!(p.mesh(segments), Err(Error::InvalidArgument(_))));
        }
    }
    assert!(
        matches!(Primitive::from_name("potato"), Err(Error::Unsupported(t)) if t.contains("potato"))
    );
    let mut stone = Primitive::from_name("stone").unwrap();
    assert!(stone.set("seed", 1.5).is_err());
    assert!(stone.set("seed", 1e17).is_err());
    stone.set("seed", 12.0).unwrap();
    let seed = stone.parameters()[0];
    assert_eq!((seed.key, seed.value), ("seed", 12.0));
    for bad in [
        Primitive::Torus { major: 1.0, minor: 1.0 },
        Primitive::Tablet { band_radius: 1.0, band_height: 1.0, cap_height: 1.1 },
        Primitive::Sphere { radius: f64::INFINITY },
        Primitive::Superellipsoid { axes: [1.0; 3], exponents: [1.0, 3.0] },
    ] {
        assert!(bad.mesh(32).is_err() && bad.moments().is_none(), "{bad:?}");
    }
}
