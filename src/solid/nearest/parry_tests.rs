//! Against the projection of parry's triangle meshes: another tree, and another way to the
//! nearest point of a triangle.

use super::*;
use parry3d::math::Vector;
use parry3d::query::PointQuery;
use parry3d::shape::TriMesh;
use proptest::prelude::*;

/// Triangles about a ball: neighbours share corners, so that many are as near; some with one
/// corner next to the opposite side, as thin as `thin`.
fn mesh(seed: u64, faces: usize, thin: f64) -> Mesh {
    let mut state = seed | 1;
    let mut next = || {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let mut mesh = Mesh { vertices: Vec::new(), faces: Vec::new(), clean: false };
    for i in 0..faces {
        let at = Vec3::new(next(), next(), next());
        let size = if i % 2 == 0 { 0.3 } else { 2.0 };
        let [a, b, c] = [0; 3].map(|_| at + Vec3::new(next(), next(), next()) * size);
        let c = if i % 3 == 0 { a.lerp(&b, next() + 0.5) + (c - a) * thin } else { c };
        let first = mesh.vertices.len() as u32;
        let back = |k: u32| if i % 4 == 1 && first > 8 { first - 6 + k } else { first + k };
        mesh.vertices.extend([a, b, c]);
        mesh.faces.push([back(0), first + 1, first + 2]);
    }
    mesh
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn distances_are_those_of_parry(
        seed in any::<u64>(),
        faces in prop::sample::select(vec![1usize, 2, 9, 70, 400]),
        thin in prop::sample::select(vec![1.0, 1e-3, 1e-6]),
        size in prop::sample::select(vec![1.0, 1e-9, 1e6]),
        places in prop::collection::vec(
            ([-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0], 0usize..5, any::<u32>()), 16),
    ) {
        let mut mesh = mesh(seed, faces, thin);
        mesh.vertices.iter_mut().for_each(|v| *v *= size);
        let corners = |v: &Vec3| Vector::new(v.x, v.y, v.z);
        let theirs =
            TriMesh::new(mesh.vertices.iter().map(corners).collect(), mesh.faces.clone()).unwrap();
        let surface = Surface::new(&Body::Mesh(mesh.clone())).unwrap();
        for (way, kind, pick) in places {
            let way = Vec3::from(way);
            let t = mesh.corners(pick as usize % faces);
            let [u, v] = [0.5 + 0.5 * way.x, (0.5 - 0.5 * way.x) * (0.5 + 0.5 * way.y)];
            let on = t[0] * u + t[1] * v + t[2] * (1.0 - u - v);
            // Among the faces, on one, at a corner, close to one, far away.
            let p = match kind {
                0 => way * size,
                1 => on,
                2 => t[pick as usize % 3],
                3 => on + way * (1e-6 * size),
                _ => way * (1e4 * size),
            };
            let expected = theirs.project_local_point(corners(&p), false).point;
            let expected = (Vec3::new(expected.x, expected.y, expected.z) - p).norm();
            let found = surface.nearest(&p);
            let grain = 1e-12 * (p.norm() + 2.0 * size);
            // On a thin triangle parry loses some figures: its way is by quotients of areas.
            prop_assert!(
                (found.distance - expected).abs() <= grain + 1e-15 / thin * size,
                "kind {}: {:e}, parry {:e}", kind, found.distance / size, expected / size
            );
            prop_assert!(((found.point - p).norm() - found.distance).abs() <= grain);
        }
    }
}
