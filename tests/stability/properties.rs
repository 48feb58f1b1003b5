//! The same body in another unit, elsewhere or written down otherwise has the same clump: over bodies,
//! methods and changes drawn at random. What ever failed here stands as a case of its own in the matrix.

use crate::stability::bodies::{
    Arrays, Ask, METHODS, apart, inverted, made, mismatch, moved, on_lattice, shuffled, subdivided,
};
use morula::generate::{Effort, Method};
use morula::math::Sphere;
use morula::shape::Primitive;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// A small body: a primitive and how finely it is cut.
#[derive(Debug, Clone, Copy)]
struct Small(Primitive, usize);

impl Small {
    fn mesh(&self) -> Arrays {
        self.0.mesh(self.1).unwrap()
    }

    /// Coordinates multiples of 2⁻²⁰, which bear exact shifts.
    fn short(&self) -> Arrays {
        on_lattice(self.mesh())
    }
}

/// Bodies of unlike extents.
fn bodies() -> impl Strategy<Value = Small> {
    let edge = || 0.2..1.0f64;
    let stones = (0u64..1000, 0.1..0.6f64).prop_map(|(seed, roughness)| Primitive::Stone {
        seed,
        diameter: 1.0,
        roughness,
    });
    let boxes = [edge(), edge(), edge()].prop_map(|edges| Primitive::Box { edges });
    let ellipsoids = [edge(), edge(), edge()].prop_map(|axes| Primitive::Ellipsoid { axes });
    let tori = (0.1..0.4f64).prop_map(|minor| Primitive::Torus { major: 0.5, minor });
    let any = prop_oneof![stones, boxes, ellipsoids, tori];
    (any, 8usize..14).prop_map(|(p, n)| Small(p, n))
}

fn asks() -> impl Strategy<Value = Ask> {
    (0..METHODS.len(), 1usize..12, 0u64..100).prop_map(|(method, spheres, seed)| Ask {
        cells: 16,
        seed,
        ..Ask::new(METHODS[method], spheres)
    })
}

fn clump(mesh: &Arrays, ask: &Ask) -> Result<(Vec<Sphere>, f64), String> {
    let (solid, spheres) = made(mesh, ask).map_err(|e| e.to_string())?;
    let d = mismatch(&solid, &spheres).map_err(|e| e.to_string())?;
    Ok((spheres, d))
}

/// Written down otherwise, in one of seven ways.
fn rewritten(mesh: &Arrays, way: usize, seed: u64) -> Arrays {
    let (vertices, faces) = mesh.clone();
    match way {
        0 => {
            let order = shuffled(faces.len(), seed);
            (vertices, order.iter().map(|i| faces[*i as usize]).collect())
        }
        1 => {
            let order = shuffled(vertices.len(), seed);
            let mut at = vec![0; order.len()];
            order.iter().enumerate().for_each(|(i, o)| at[*o as usize] = i as u32);
            let vertices = order.iter().map(|i| vertices[*i as usize]).collect();
            (vertices, faces.iter().map(|f| f.map(|v| at[v as usize])).collect())
        }
        2 => (vertices, faces.iter().map(|f| [f[1], f[2], f[0]]).collect()),
        3 => inverted(mesh),
        4 => {
            let corners = faces.iter().flatten().map(|v| vertices[*v as usize]).collect();
            (corners, (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
        }
        5 => moved(mesh, |p| p.map(|x| f64::from(x as f32))),
        _ => subdivided(mesh),
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24, max_shrink_iters: 20, failure_persistence: None, rng_seed: RngSeed::Fixed(8),
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_power_of_two_changes_no_bit(body in bodies(), ask in asks(), k in -40i32..40) {
        let scale = 2f64.powi(k);
        let mesh = body.mesh();
        let here = clump(&mesh, &ask);
        let there = clump(&moved(&mesh, |p| p.map(|x| x * scale)), &ask);
        match (here, there) {
            (Ok((a, _)), Ok((b, _))) => {
                let off = apart(&b, &a, scale, [0.0; 3]).map_err(|_| TestCaseError::fail("unlike"))?;
                prop_assert_eq!(off, 0.0);
            }
            (a, b) => prop_assert!(a.is_err() && b.is_err(), "{:?} {:?}", a, b),
        }
    }

    #[test]
    fn an_exact_shift_changes_the_last_digit_at_most(
        body in bodies(), ask in asks(), shift in [-1000i32..1000, -1000..1000, -1000..1000]
    ) {
        // Packed keeps roundings of the place free.
        prop_assume!(ask.method != Method::Packed);
        let shift = shift.map(|s| 1e5 * f64::from(s));
        let far = shift.iter().fold(1.0f64, |m, s| m.max(s.abs()));
        let mesh = body.short();
        let here = clump(&mesh, &ask);
        let there = clump(&moved(&mesh, |p| [0, 1, 2].map(|i| p[i] + shift[i])), &ask);
        match (here, there) {
            (Ok((a, _)), Ok((b, _))) => {
                let off = apart(&b, &a, 1.0, shift).map_err(|_| TestCaseError::fail("unlike"))?;
                prop_assert!(off <= far * f64::EPSILON, "{}", off / far);
            }
            (a, b) => prop_assert!(a.is_err() && b.is_err(), "{:?} {:?}", a, b),
        }
    }

    #[test]
    fn threads_change_no_bit(body in bodies(), ask in asks(), threads in 2usize..9) {
        let mesh = body.mesh();
        match (clump(&mesh, &ask), clump(&mesh, &Ask { threads, ..ask })) {
            (Ok((a, _)), Ok((b, _))) => prop_assert_eq!(a, b),
            (a, b) => prop_assert!(a.is_err() && b.is_err(), "{:?} {:?}", a, b),
        }
    }

    #[test]
    fn another_unit_changes_d_by_no_more_than_a_percent(
        body in bodies(), ask in asks(), power in -12.0..12.0f64
    ) {
        let (mesh, ask) = (body.mesh(), Ask { effort: Effort::Normal, ..ask });
        let scale = 10f64.powf(power);
        match (clump(&mesh, &ask), clump(&moved(&mesh, |p| p.map(|x| x * scale)), &ask)) {
            (Ok((a, da)), Ok((b, db))) => {
                prop_assert_eq!(a.len(), b.len());
                prop_assert!((db / da - 1.0).abs() <= 0.01, "{:?}: {} {}", ask, da, db);
            }
            (a, b) => prop_assert!(a.is_err() && b.is_err(), "{:?} {:?}", a, b),
        }
    }

    #[test]
    fn other_words_for_a_body_change_d_by_no_more_than_a_percent(
        body in bodies(), ask in asks(), way in 0usize..7, seed in 0u64..1000
    ) {
        let (mesh, ask) = (body.mesh(), Ask { effort: Effort::Normal, ..ask });
        match (clump(&mesh, &ask), clump(&rewritten(&mesh, way, seed), &ask)) {
            (Ok((a, da)), Ok((b, db))) => {
                prop_assert_eq!(a.len(), b.len());
                prop_assert!((db / da - 1.0).abs() <= 0.01, "{:?}, {}: {} {}", ask, way, da, db);
            }
            (a, b) => prop_assert!(a.is_err() && b.is_err(), "{:?} {:?}", a, b),
        }
    }

    #[test]
    fn axes_exchanged_and_mirrored_change_d_by_no_more_than_a_percent(
        body in bodies(), ask in asks(), way in 1usize..12
    ) {
        let (mesh, ask) = (body.mesh(), Ask { effort: Effort::Normal, ..ask });
        let image = moved(&mesh, |p| {
            let p = [p[way % 3], p[(way + 1) % 3], p[(way + 2) % 3]];
            [if way / 3 % 2 == 1 { -p[0] } else { p[0] }, if way > 5 { -p[1] } else { p[1] }, p[2]]
        });
        let image = if (way / 3).count_ones() % 2 == 1 { inverted(&image) } else { image };
        match (clump(&mesh, &ask), clump(&image, &ask)) {
            (Ok((a, da)), Ok((b, db))) => {
                prop_assert_eq!(a.len(), b.len());
                prop_assert!((db / da - 1.0).abs() <= 0.01, "{:?}, {}: {} {}", ask, way, da, db);
            }
            (a, b) => prop_assert!(a.is_err() && b.is_err(), "{:?} {:?}", a, b),
        }
    }
}
