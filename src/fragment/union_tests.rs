use super::*;
use proptest::prelude::*;

fn ball(x: f64, y: f64, z: f64, r: f64) -> Sphere {
    Sphere::new(Vec3::new(x, y, z), r)
}

fn directions(n: usize) -> impl Iterator<Item = Vec3> {
    (0..n).map(move |k| {
        let z = (2 * k + 1) as f64 / n as f64 - 1.0;
        let (y, x) = (2.399_963_229_728_653 * k as f64).sin_cos();
        let s = (1.0 - z * z).sqrt();
        Vec3::new(s * x, s * y, z)
    })
}

/// The nearest of very many exposed points, and how far apart these are. Points of the circles where
/// two spheres meet are among them: a patch may end in a tip too narrow for points of its sphere.
fn sampled(spheres: &[Sphere], p: &Vec3) -> (f64, f64) {
    const MANY: usize = 20_000;
    let mut least = f64::MAX;
    let mut apart = 0.0f64;
    for (i, s) in spheres.iter().enumerate() {
        apart = apart.max(3.0 * s.radius / (MANY as f64).sqrt());
        for d in directions(MANY) {
            let q = s.center + d * s.radius;
            let hidden =
                |(j, o): (usize, &Sphere)| j != i && (q - o.center).norm() < o.radius - 1e-9;
            if !spheres.iter().enumerate().any(hidden) {
                least = least.min((q - p).norm());
            }
        }
        for (j, o) in spheres.iter().enumerate().skip(i + 1) {
            let way = o.center - s.center;
            let along = 0.5
                * (1.0 + (s.radius.powi(2) - o.radius.powi(2)) / way.norm_squared().max(1e-300));
            let radius2 = s.radius.powi(2) - along * along * way.norm_squared();
            if radius2 <= 0.0 {
                continue;
            }
            let u = way.cross(&Vec3::new(0.3, -0.7, 0.2)).normalize() * radius2.sqrt();
            let v = way.normalize().cross(&u);
            for k in 0..MANY {
                let (sin, cos) = (TAU * k as f64 / MANY as f64).sin_cos();
                let q = s.center + way * along + u * cos + v * sin;
                let hidden = |(m, o): (usize, &Sphere)| {
                    m != i && m != j && (q - o.center).norm() < o.radius - 1e-9
                };
                if !spheres.iter().enumerate().any(hidden) {
                    least = least.min((q - p).norm());
                }
            }
        }
    }
    (least, apart)
}

/// Held against the sampled surface; and no point of the ball leaves the union.
fn holds(spheres: &[Sphere], p: &Vec3) {
    let union = Union::new(spheres).unwrap();
    let depth = union.depth(p);
    let single = spheres.iter().map(|s| s.radius - (p - s.center).norm()).fold(f64::MIN, f64::max);
    if single <= 0.0 {
        assert!((depth - single).abs() < 1e-12, "{depth} {single}");
        return;
    }
    let (least, apart) = sampled(spheres, p);
    assert!(depth >= single - 1e-12 && depth <= least + 1e-12, "{depth} {single} {least}");
    assert!(depth > least - 2.0 * apart, "{depth} {least} {apart} {spheres:?} {p:?}");
    for d in directions(2000) {
        let q = p + d * (depth - 1e-9);
        assert!(spheres.iter().any(|s| s.contains(&q)), "{spheres:?} {p:?}");
    }
}

#[test]
fn one_sphere() {
    let union = Union::new(&[ball(0.5, 0.5, 0.5, 0.25)]).unwrap();
    assert_eq!(union.depth(&Vec3::repeat(0.5)), 0.25);
    assert!((union.depth(&Vec3::new(0.5, 0.6, 0.5)) - 0.15).abs() < 1e-15);
    assert!((union.depth(&Vec3::new(0.5, 1.5, 0.5)) + 0.75).abs() < 1e-15);
    assert_eq!(union.arcs.len(), 0);
}

#[test]
fn the_neck_of_two_spheres() {
    // Halfway the nearest exposed point is on the circle where they meet, deeper than either.
    let union = Union::new(&[ball(-0.3, 0.0, 0.0, 0.5), ball(0.3, 0.0, 0.0, 0.5)]).unwrap();
    assert_eq!(union.arcs.len(), 1);
    assert!((union.depth(&Vec3::zeros()) - 0.4).abs() < 1e-15);
    assert!((union.depth(&Vec3::new(0.0, 0.1, 0.0)) - 0.3).abs() < 1e-15);
    assert!((union.depth(&Vec3::new(-0.3, 0.0, 0.0)) - 0.5).abs() < 1e-15);
}

#[test]
fn where_three_spheres_meet() {
    let at = |k: f64| {
        let (y, x) = (k * TAU / 3.0).sin_cos();
        ball(0.3 * x, 0.3 * y, 0.0, 0.5)
    };
    let three = [at(0.0), at(1.0), at(2.0)];
    // The two points in all three surfaces lie 0.4 above and below the middle.
    let union = Union::new(&three).unwrap();
    assert!((union.depth(&Vec3::zeros()) - 0.4).abs() < 1e-12);
    assert!((union.depth(&Vec3::new(0.0, 0.0, 0.1)) - 0.3).abs() < 1e-12);
    holds(&three, &Vec3::new(0.02, 0.01, 0.05));
}

#[test]
fn a_sphere_all_hidden_by_bumps() {
    // No bump holds the middle; the nearest exposed points lie where three bumps meet.
    let mut all = vec![ball(0.0, 0.0, 0.0, 0.4)];
    all.extend(directions(60).map(|d| Sphere::new(d * 0.4, 0.15)));
    let union = Union::new(&all).unwrap();
    let depth = union.depth(&Vec3::zeros());
    assert!(depth > 0.42 && depth < 0.55, "{depth}");
    assert!(!union.exposed[union.spheres.iter().position(|s| s.radius == 0.4).unwrap()]);
    holds(&all, &Vec3::zeros());
    holds(&all, &Vec3::new(0.1, -0.07, 0.2));
}

#[test]
fn tangent_nested_and_equal_spheres() {
    let big = ball(0.0, 0.0, 0.0, 0.5);
    // Outside tangent: nothing goes through the point where they touch.
    let kiss = [big, ball(0.8, 0.0, 0.0, 0.3)];
    holds(&kiss, &Vec3::new(0.4, 0.0, 0.0));
    assert!((Union::new(&kiss).unwrap().depth(&Vec3::new(0.4, 0.0, 0.0)) - 0.1).abs() < 1e-9);
    // Inside tangent, nested, equal, twice the same.
    for other in [
        ball(0.2, 0.0, 0.0, 0.3),
        ball(0.1, 0.1, 0.0, 0.2),
        big,
        ball(1e-13, 0.0, 0.0, 0.5),
        ball(1e-9, 0.0, 0.0, 0.5),
        ball(0.2 + 1e-9, 0.0, 0.0, 0.3),
    ] {
        let union = Union::new(&[big, other, other]).unwrap();
        for p in [[0.1, 0.2, 0.0], [0.3, 0.0, 0.0], [0.0, 0.0, 0.0], [-0.49, 0.0, 0.0]] {
            let p = Vec3::from(p);
            let depth = union.depth(&p);
            assert!((depth - (0.5 - p.norm())).abs() < 1e-8, "{other:?} {p:?} {depth}");
        }
    }
}

#[test]
fn spheres_on_a_lattice_meet_in_common_points() {
    let mut all = Vec::new();
    for i in 0..27 {
        let c = [i % 3, i / 3 % 3, i / 9].map(|k| 0.2 * f64::from(k));
        all.push(Sphere::new(Vec3::from(c), 0.2));
    }
    for p in [[0.2, 0.2, 0.2], [0.1, 0.1, 0.1], [0.3, 0.2, 0.15], [0.0, 0.1, 0.1]] {
        holds(&all, &Vec3::from(p));
    }
    // Four circles meet above the middle of a face's cell: (0.1, 0.1, 0.4 + √0.02).
    let depth = Union::new(&all).unwrap().depth(&Vec3::new(0.1, 0.1, 0.4));
    assert!((depth - 0.02f64.sqrt()).abs() < 1e-6, "{depth}");
}

#[test]
fn bad_spheres_are_refused() {
    assert_eq!(Union::new(&[]).unwrap_err().status(), 5);
    let e = Union::new(&[ball(0.0, 0.0, 0.0, 1.0), ball(0.0, f64::NAN, 0.0, 1.0)]).unwrap_err();
    assert!(e.to_string().starts_with("sphere 1 has centre (0, NaN, 0)"), "{e}");
    assert!(Union::new(&[ball(0.0, 0.0, 0.0, 0.0)]).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn depth_is_the_distance_to_what_is_exposed(
        spheres in prop::collection::vec(
            ([0.0f64..0.6, 0.0f64..0.6, 0.0f64..0.6], 0.1f64..0.35), 1..14),
        [x, y, z] in [0.0f64..0.6, 0.0f64..0.6, 0.0f64..0.6],
    ) {
        let spheres: Vec<Sphere> =
            spheres.into_iter().map(|(c, r)| Sphere::new(Vec3::from(c), r)).collect();
        holds(&spheres, &Vec3::new(x, y, z));
    }

    #[test]
    fn more_spheres_are_never_less_deep(
        spheres in prop::collection::vec(
            ([0.0f64..1.0, 0.0f64..1.0, 0.0f64..1.0], 0.05f64..0.3), 2..60),
        points in prop::collection::vec([0.0f64..1.0, 0.0f64..1.0, 0.0f64..1.0], 40),
    ) {
        let spheres: Vec<Sphere> =
            spheres.into_iter().map(|(c, r)| Sphere::new(Vec3::from(c), r)).collect();
        let all = Union::new(&spheres).unwrap();
        let fewer = Union::new(&spheres[1..]).unwrap();
        for p in points.into_iter().map(Vec3::from) {
            let depth = all.depth(&p);
            prop_assert!(depth >= fewer.depth(&p) - 1e-9);
            // What it is in a tree is what it is arc by arc.
            let each = all.arcs.iter().map(|a| (a.nearest(&p) - p).norm()).fold(f64::MAX, f64::min);
            prop_assert!(depth <= each + 1e-15);
        }
    }
}
