use super::*;
use crate::math::solid_angle;
use crate::shape::samples;
use crate::solid::moments::moments;
use crate::solid::nearest::Surface;
use proptest::prelude::*;

/// A mesh without the faces that `drop` names by their middle.
fn without(mesh: Mesh, drop: impl Fn(&Vec3) -> bool) -> Mesh {
    let vertices = &mesh.vertices;
    let middle = |f: &[u32; 3]| f.iter().map(|&v| vertices[v as usize]).sum::<Vec3>() / 3.0;
    let faces = mesh.faces.iter().filter(|f| !drop(&middle(f))).copied().collect();
    Mesh { vertices: mesh.vertices, faces, clean: false }
}

fn closed(mesh: &Mesh) -> (Option<Mesh>, String) {
    let lids = close(mesh, true, u64::MAX, &Run::serial()).unwrap().unwrap();
    (lids.mesh, lids.notes.join("; "))
}

fn cube_without_top() -> Mesh {
    without(samples::cuboid([0.0; 3], [1.0; 3]), |p| p.z > 0.9)
}

#[test]
fn closed_meshes_are_left_alone() {
    let run = Run::serial();
    let mut mesh = samples::cuboid([0.0; 3], [1.0; 3]);
    assert!(close(&mesh, true, u64::MAX, &run).unwrap().is_none());
    mesh.clean = false;
    assert!(close(&mesh, true, u64::MAX, &run).unwrap().is_none());
}

#[test]
fn a_cube_without_its_top_is_a_cube() {
    let mesh = cube_without_top();
    let (lidded, note) = closed(&mesh);
    let lidded = lidded.unwrap();
    assert!(lidded.clean && note.starts_with("lids were put over 1 opening"), "{note}");
    assert_eq!(lidded.faces[..mesh.faces.len()], mesh.faces);
    assert_eq!(lidded.faces.len(), mesh.faces.len() + 4);
    assert!(border(&lidded).unwrap().is_empty());
    let found = moments(&Body::Mesh(mesh.clone()), &Run::serial()).unwrap();
    assert!((found.volume - 1.0).abs() < 1e-14 && found.relative_error == 0.0);
    assert!((found.centroid - Vec3::repeat(0.5)).norm() < 1e-14);
    let text = close(&mesh, true, 100, &Run::serial()).err().unwrap().to_string();
    assert!(text.contains("closing 4 open edges of 10 faces") && text.contains("100"), "{text}");
}

/// The middle of an L lies on its corner: the lid is cut off in ears, and none of it lies beyond.
#[test]
fn a_lid_lies_within_a_rim_that_is_not_convex() {
    let l = [[0.0, 0.0], [0.9, 0.0], [0.9, 0.2], [0.2, 0.2], [0.2, 0.9], [0.0, 0.9]];
    let mut mesh = Mesh::default();
    for z in [0.0, 0.5] {
        mesh.vertices.extend(l.map(|[x, y]| Vec3::new(x, y, z)));
    }
    for i in 0..6u32 {
        let j = (i + 1) % 6;
        mesh.faces.extend([[i, j, 6 + j], [i, 6 + j, 6 + i]]);
    }
    // The floor; the top is open.
    mesh.faces.extend([[3, 1, 0], [3, 2, 1], [3, 0, 5], [3, 5, 4]].map(|[a, b, c]| [a, b, c]));
    let (lidded, _) = closed(&mesh);
    let lidded = lidded.unwrap();
    let top: Vec<_> = (mesh.faces.len()..lidded.faces.len()).map(|i| lidded.corners(i)).collect();
    let up: Vec<f64> = top.iter().map(|[a, b, c]| (b - a).cross(&(c - a)).z / 2.0).collect();
    assert_eq!(top.len(), 4);
    assert!(up.iter().all(|a| *a > 0.0), "{up:?}");
    assert!((up.iter().sum::<f64>() - 0.32).abs() < 1e-12);
    let volume = moments(&Body::Mesh(mesh), &Run::serial()).unwrap().volume;
    assert!((volume - 0.16).abs() < 1e-12, "{volume}");
}

/// Rims that meet in a vertex are cut there, whatever their number.
#[test]
fn openings_that_touch_get_a_lid_each() {
    let ball = || samples::ellipsoid([0.5; 3], [0.45; 3], 24);
    // Every other face about the pole: as many openings, which all meet there.
    let mut mesh = ball();
    let mut k = 0;
    mesh.faces.retain(|f| {
        k += usize::from(f.contains(&0));
        !(f.contains(&0) && k % 2 == 0)
    });
    mesh.clean = false;
    let gone = ball().faces.len() - mesh.faces.len();
    let (lidded, note) = closed(&mesh);
    assert!(gone > 10 && note.contains(&format!("{gone} openings:")), "{gone} {note}");
    let volume = |m: Mesh| moments(&Body::Mesh(m), &Run::serial()).unwrap().volume;
    assert!((volume(lidded.unwrap()) - volume(ball())).abs() < 1e-12);
}

/// So many that a look at all faces for each would not end.
#[test]
fn pinholes_are_closed_by_the_thousand() {
    let whole = samples::ellipsoid([0.5; 3], [0.45, 0.4, 0.3], 170);
    let mut mesh = whole.clone();
    let mut i = 0;
    mesh.faces.retain(|_| {
        i += 1;
        i % 6 != 0
    });
    mesh.clean = false;
    let gone = whole.faces.len() - mesh.faces.len();
    let (lidded, note) = closed(&mesh);
    assert!(
        gone > 19_000 && note.contains("lids were put over") && !note.contains("no lid"),
        "{note}"
    );
    let [a, b] =
        [lidded.unwrap(), whole].map(|m| moments(&Body::Mesh(m), &Run::serial()).unwrap().volume);
    assert!((a - b).abs() < 1e-3 * b, "{a} {b}");
}

/// Two halves of a ball that meet but are not joined, with other vertices at the seam: a lid over
/// either would be a wall through the middle.
#[test]
fn cracks_and_loose_triangles_get_no_lid() {
    let half = |n: usize, up: bool| {
        without(samples::ellipsoid([0.5; 3], [0.45; 3], n), |p| (p.z > 0.5) != up)
    };
    let (mut mesh, other) = (half(20, true), half(28, false));
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(&other.vertices);
    mesh.faces.extend(other.faces.iter().map(|f| f.map(|v| v + first)));
    let (lidded, note) = closed(&mesh);
    assert!(lidded.is_none() && note.starts_with("2 openings of the surface got no lid"), "{note}");
    let surface = Surface::new(&Body::Mesh(mesh)).unwrap();
    assert!(surface.signed_distance(&Vec3::repeat(0.5)) < -0.43);

    let ball = samples::ellipsoid([0.5; 3], [0.45; 3], 12);
    let mut soup = Mesh::default();
    for i in 0..ball.faces.len() {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(ball.corners(i));
        soup.faces.push([first, first + 1, first + 2]);
    }
    let (lidded, note) = closed(&soup);
    assert!(lidded.is_none() && note.contains("not joined"), "{note}");
}

/// An inner wall that hangs on the surface has a border too, but three faces at some edges.
#[test]
fn a_wall_within_the_body_gets_no_lid() {
    let mut mesh = samples::cuboid([0.0; 3], [1.0; 3]);
    mesh.vertices.push(Vec3::new(0.5, 0.5, 0.3));
    mesh.faces.push([0, 1, 8]);
    mesh.clean = false;
    let (lidded, note) = closed(&mesh);
    assert!(lidded.is_none() && note.starts_with("1 opening of the surface got no lid"), "{note}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Through the openings of a rough ball the signed distance goes on without a jump, and the
    /// inside is that of the closed mesh by solid angles.
    #[test]
    fn the_signed_distance_is_continuous_through_openings(
        cuts in prop::collection::vec(
            ([-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0], 0.1f64..0.4), 1..4),
        rough in 0.0f64..0.03,
        ends in prop::collection::vec([-0.5f64..0.5, -0.5f64..0.5, -0.5f64..0.5], 6),
    ) {
        let mut ball = samples::ellipsoid([0.5; 3], [0.4; 3], 16);
        for (i, v) in ball.vertices.iter_mut().enumerate() {
            let part = |a: f64| ((i as f64 * a).fract() - 0.5) * rough;
            *v += Vec3::new(part(0.618), part(0.414), part(0.732));
        }
        let cuts: Vec<_> = cuts
            .iter()
            .map(|(d, size)| (Vec3::repeat(0.5) + Vec3::from(*d).normalize() * 0.4, *size))
            .collect();
        let open = without(ball, |p| cuts.iter().any(|(at, size)| (p - at).norm() < *size));
        prop_assume!(!border(&open).unwrap().is_empty());
        let (Some(lidded), _) = closed(&open) else { return Ok(()) };
        prop_assume!(lidded.clean);
        let all: Vec<_> = (0..lidded.faces.len()).map(|i| lidded.corners(i)).collect();
        let surface = Surface::new(&Body::Mesh(lidded)).unwrap();
        for (at, _) in &cuts {
            for end in &ends {
                let (a, b) = (at + Vec3::from(*end), at - Vec3::from(*end) * 0.7);
                let mut before: Option<(Vec3, f64)> = None;
                for k in 0..=200 {
                    let p = a.lerp(&b, f64::from(k) / 200.0);
                    let d = surface.signed_distance(&p);
                    if let Some((q, e)) = before {
                        prop_assert!((d - e).abs() <= (p - q).norm() + 1e-9, "{} {}", d, e);
                    }
                    before = Some((p, d));
                    if k % 40 == 0 && d.abs() > 1e-6 {
                        let w: f64 = all.iter().map(|t| solid_angle(t, &p)).sum();
                        prop_assert_eq!(d < 0.0, w > 2.0 * std::f64::consts::PI);
                    }
                }
            }
        }
    }
}
