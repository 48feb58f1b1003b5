//! What masses must do, and what must not change them.

use super::*;
use crate::math::{Inertia, Moments, Vec3};
use nalgebra::Rotation3;
use proptest::prelude::*;

/// `n` overlapping spheres without any order, in a box of edges about 1, 0.8, 0.6.
pub(in super::super) fn scattered(n: u32, seed: f64) -> Vec<Sphere> {
    let of = |t: f64, k: f64| ((t + seed) * k).fract();
    let size = 0.35 / f64::from(n).cbrt();
    (0..n)
        .map(|i| {
            let t = f64::from(i) + 0.5;
            let c =
                Vec3::new(of(t, 0.819_172_5), 0.8 * of(t, 0.671_043_6), 0.6 * of(t, 0.549_700_5));
            Sphere::new(c, size * (1.0 + of(t, 0.313_7)))
        })
        .collect()
}

pub(in super::super) fn run() -> Run<'static> {
    Run::serial()
}

pub(in super::super) fn of_union(spheres: &[Sphere], density: f64) -> Body {
    Body::of_union(spheres, density, &run()).unwrap()
}

pub(in super::super) fn solve(spheres: &[Sphere], body: &Body, options: &MassOptions) -> Masses {
    correct(spheres, body, options, &run()).unwrap()
}

pub(in super::super) fn ask(objective: Objective) -> MassOptions {
    MassOptions { objective, ..MassOptions::default() }
}

/// A body with the moments of an ellipsoid.
pub(in super::super) fn ellipsoid(a: f64, b: f64, c: f64, density: f64) -> Body {
    let volume = 4.0 / 3.0 * std::f64::consts::PI * a * b * c;
    let s = volume / 5.0;
    let inertia = Inertia::from_second_moments([s * a * a, s * b * b, s * c * c, 0.0, 0.0, 0.0]);
    let moments = Moments { volume, centroid: Vec3::zeros(), inertia, relative_error: 0.0 };
    Body::of_moments(&moments, density).unwrap()
}

pub(in super::super) fn problem(spheres: &[Sphere], body: &Body, least: f64) -> (Problem, Pile) {
    let pile = Pile::new(&unitless(spheres, body).unwrap()).unwrap();
    (Problem::new(&pile, body, least, None).unwrap(), pile)
}

const OBJECTIVES: [Objective; 3] = [Objective::Even, Objective::MaxMin, Objective::MaxLast];

#[test]
fn all_ten_equations_hold() {
    for n in [40, 60, 150] {
        let spheres = scattered(n, 0.0);
        let body = of_union(&spheres, 2500.0);
        for objective in OBJECTIVES {
            let m = solve(&spheres, &body, &ask(objective));
            assert_eq!(m.status, MassStatus::Exact, "{n} {objective:?} {:?}", m.residuals);
            assert!(m.residuals.mass < 1e-13 && m.residuals.center < 1e-12);
            assert!(m.residuals.inertia < 1e-11, "{:?}", m.residuals);
            let least = (body.mass / 1000.0).min(body.mass / f64::from(10 * n));
            assert!((m.m_min / least - 1.0).abs() < 1e-12);
            assert!(m.masses.iter().all(|x| *x >= m.m_min));
            assert_eq!(m.largest_m_min, None);
        }
    }
}

#[test]
fn objectives_are_better_than_each_other_at_their_own() {
    let spheres = scattered(40, 3.0);
    let body = of_union(&spheres, 1.0);
    let [even, most, last] = OBJECTIVES.map(|o| solve(&spheres, &body, &ask(o)));
    let least = |m: &Masses| m.masses.iter().fold(f64::MAX, |a, b| a.min(*b));
    assert!(least(&most) > least(&even) && least(&most) > least(&last));
    assert!(last.masses[39] > even.masses[39] && last.masses[39] > most.masses[39]);
    // Vertices of the set of solutions: all but a few masses at the bound.
    assert!(last.binding.len() >= 30, "{}", last.binding.len());
    let cost = |m: &Masses| {
        let (p, pile) = problem(&spheres, &body, 0.1);
        let s = relative(shares(&pile, &run()).unwrap(), &p);
        let x = pile.order.iter().map(|i| m.masses[*i as usize] * 40.0 / body.mass);
        x.zip(s).map(|(x, s)| (x - s) * (x - s) / s).sum::<f64>()
    };
    assert!(cost(&even) < cost(&most) && cost(&even) < cost(&last));
    assert!((even.spread - (cost(&even) / 40.0).sqrt()).abs() < 1e-9);
}

#[test]
fn order_unit_density_and_place_change_nothing() {
    let spheres = scattered(45, 0.0);
    let one = solve(&spheres, &of_union(&spheres, 1.0), &MassOptions::default());
    for objective in [Objective::Even, Objective::MaxMin] {
        let mut order: Vec<usize> = (0..45).collect();
        order.sort_by_key(|i| i * 7 % 45);
        let other: Vec<Sphere> = order.iter().map(|&i| spheres[i]).collect();
        let body = of_union(&spheres, 1.0);
        let straight = solve(&spheres, &body, &ask(objective)).masses;
        let mixed = solve(&other, &of_union(&other, 1.0), &ask(objective)).masses;
        let expected: Vec<f64> = order.iter().map(|&i| straight[i]).collect();
        assert_eq!(mixed, expected);
    }
    // Many of equal x, and copies.
    let mut grid: Vec<Sphere> = (0..45)
        .map(|i| {
            let c = [i % 3, i / 3 % 3, i / 9].map(|k| f64::from(k) * 0.3);
            Sphere::new(Vec3::from(c), 0.2 + 0.01 * f64::from(i % 7))
        })
        .collect();
    grid[7] = grid[31];
    let body = of_union(&grid, 1.0);
    let straight = solve(&grid, &body, &MassOptions::default()).masses;
    let order: Vec<usize> = (0..45).map(|i| i * 7 % 45).collect();
    let other: Vec<Sphere> = order.iter().map(|&i| grid[i]).collect();
    assert_eq!(of_union(&other, 1.0), body);
    let mixed = solve(&other, &body, &MassOptions::default()).masses;
    for (a, &i) in mixed.iter().zip(&order) {
        let copies = [straight[7], straight[31]];
        assert!(*a == straight[i] || (i == 7 || i == 31) && copies.contains(a), "{i}");
    }
    let turn = Rotation3::from_euler_angles(0.3, -0.8, 1.9);
    for (scale, density, turned, at) in [
        (1e-9, 1e-3, false, 0.0),
        (1e6, 1e5, false, 0.0),
        (1e-9, 1e5, true, 0.0),
        (1.0, 2500.0, true, 0.0),
        (1.0, 1.0, false, 1e5),
        (1e-12, 1.0, true, 3e-8),
    ] {
        let place = |s: &Sphere| {
            let c = if turned { turn * s.center } else { s.center };
            Sphere::new((c * scale).add_scalar(at), s.radius * scale)
        };
        let moved: Vec<_> = spheres.iter().map(place).collect();
        let body = of_union(&moved, density);
        let m = solve(&moved, &body, &MassOptions::default());
        assert_eq!(m.status, MassStatus::Exact);
        for (a, b) in m.masses.iter().zip(&one.masses) {
            let b = b * density * scale.powi(3);
            // Far away the coordinates themselves are rounded.
            let noise = 1e-14 * (at / scale).max(1.0);
            assert!((a / b - 1.0).abs() < 1e-7 + 1e3 * noise, "{scale} {density}: {a} {b}");
        }
    }
}

#[test]
fn what_rounding_makes_contradict_itself_keeps_its_mass() {
    // Copies of one ball: the moments of their union are known to 1e-11, and the ten equations
    // hold no better.
    let spheres = [Sphere::new(Vec3::new(0.3, 0.2, 0.1), 0.7); 4];
    let m = solve(&spheres, &of_union(&spheres, 3.0), &MassOptions::default());
    assert_eq!(m.status, MassStatus::Exact);
    assert!(m.residuals.mass < 1e-14 && m.residuals.inertia > 1e-13, "{:?}", m.residuals);
}

#[test]
fn mirror_images_get_equal_masses() {
    // Symmetric about x = 0, which is then a plane of the body frame.
    let mut spheres = scattered(15, 2.0);
    spheres.iter_mut().for_each(|s| s.center.x += 0.02);
    let images: Vec<_> = spheres
        .iter()
        .map(|s| Sphere::new(Vec3::new(-s.center.x, s.center.y, s.center.z), s.radius))
        .collect();
    spheres.extend(images);
    let body = of_union(&spheres, 1.0);
    for objective in [Objective::Even, Objective::MaxMin] {
        let m = solve(&spheres, &body, &ask(objective));
        for i in 0..15 {
            let (a, b) = (m.masses[i], m.masses[i + 15]);
            let tolerance = if objective == Objective::Even { 1e-7 } else { 1e-4 };
            assert!((a / b - 1.0).abs() < tolerance, "{objective:?} {i}: {a} {b}");
        }
    }
}

#[test]
fn few_spheres_keep_mass_and_centre() {
    // A dumb-bell for a long ellipsoid: along the axis right, across it as well as can be.
    let body = ellipsoid(1.0, 0.4, 0.4, 2.0);
    let pair = [0.5, -0.5].map(|x| Sphere::new(Vec3::new(x, 0.0, 0.0), 0.4));
    for objective in OBJECTIVES {
        let m = solve(&pair, &body, &ask(objective));
        assert_eq!(m.status, MassStatus::Relaxed);
        assert!((m.masses[0] / m.masses[1] - 1.0).abs() < 1e-9);
        let sum = m.masses[0] + m.masses[1];
        assert!((sum / body.mass - 1.0).abs() < 1e-12 && m.residuals.center < 1e-12);
        // Along the axis 2/5 · 0.4² for 2/5 · 0.4²; across 2/5 · 0.4² + 0.5² for (1 + 0.16) / 5.
        let across = (0.064f64 + 0.25) / 0.232 - 1.0;
        assert!((m.residuals.inertia - across).abs() < 1e-9, "{:?}", m.residuals);
        assert_eq!(m.largest_m_min, None);
    }
    // Of what only positive masses cannot do, it is told how far they can.
    let spheres = scattered(40, 5.0);
    let body = of_union(&spheres, 1.0);
    let free = MassOptions { m_min: Some(0.0), ..MassOptions::default() };
    let easy = solve(&spheres, &body, &MassOptions { objective: Objective::MaxMin, ..free });
    let least = easy.masses.iter().fold(f64::MAX, |a, b| a.min(*b));
    assert_eq!(easy.status, MassStatus::Exact);
    let hard = solve(&spheres, &body, &MassOptions { m_min: Some(1.05 * least), ..free });
    assert_eq!(hard.status, MassStatus::Relaxed);
    let told = hard.largest_m_min.unwrap();
    assert!((told / least - 1.0).abs() < 1e-6, "{told} {least}");
    assert!(!hard.binding.is_empty());
}

#[test]
fn bounds_hold() {
    let spheres = scattered(60, 1.0);
    let body = of_union(&spheres, 1.0);
    let mean = body.mass / 60.0;
    for objective in OBJECTIVES {
        let options =
            MassOptions { m_min: Some(0.2 * mean), m_max: Some(3.0 * mean), ..ask(objective) };
        let m = solve(&spheres, &body, &options);
        assert!(m.masses.iter().all(|m| (0.2 * mean..=3.0 * mean).contains(m)), "{objective:?}");
        assert!(m.residuals.mass < 1e-12);
    }
    // A bound below what was the greatest mass binds, and is told.
    let free = solve(&spheres, &body, &MassOptions::default());
    let m_max = 0.9 * free.masses.iter().fold(0.0, |a, b| b.max(a));
    let m = solve(&spheres, &body, &MassOptions { m_max: Some(m_max), ..MassOptions::default() });
    let greatest: Vec<u32> =
        (0..60).filter(|&i| m.masses[i as usize] > (1.0 - 1e-9) * m_max).collect();
    assert!(!greatest.is_empty() && greatest.iter().all(|i| m.binding.contains(i)), "{m:?}");
    // Nothing but equal masses is left.
    let options = MassOptions {
        m_min: Some(mean),
        infeasible: Infeasible::LeastError,
        ..MassOptions::default()
    };
    let m = solve(&spheres, &body, &options);
    assert!(m.masses.iter().all(|m| (m / mean - 1.0).abs() < 1e-9));
    assert_eq!(m.status, MassStatus::MassOnly);
}

fn refused(spheres: &[Sphere], body: &Body, options: &MassOptions) -> Error {
    correct(spheres, body, options, &run()).unwrap_err()
}

#[test]
fn what_cannot_be_is_refused_with_the_reason() {
    let body = ellipsoid(1.0, 0.8, 0.6, 1.0);
    let plain = MassOptions::default();
    assert!(matches!(refused(&[], &body, &plain), Error::Empty(_)));
    let ball = |x: f64, y: f64, z: f64| Sphere::new(Vec3::new(x, y, z), 0.3);
    let e = refused(&[ball(0.0, 0.0, 0.0), ball(f64::NAN, 0.0, 0.0)], &body, &plain);
    assert_eq!(e, Error::NotFinite("sphere 1 has centre (NaN, 0, 0) and radius 0.3".into()));
    let e = refused(&[ball(0.0, 0.0, 0.0), ball(1e9, 0.0, 0.0)], &body, &plain);
    assert!(matches!(&e, Error::InvalidArgument(t) if t.starts_with("sphere 1 has radius")), "{e}");
    let two = [ball(0.2, 0.0, 0.0), ball(-0.2, 0.0, 0.0)];
    let mass = body.mass;
    for (m_min, m_max, text) in [
        (Some(-1.0), None, "m_min is -1, below 0"),
        (Some(f64::NAN), None, "m_min is NaN"),
        (None, Some(f64::INFINITY), "m_max is inf"),
        (Some(0.5), Some(0.25), "m_max is 0.25, less than m_min = 0.5"),
        (Some(mass), None, "2 spheres of that mass are heavier than the target"),
        (None, Some(0.1 * mass), "2 spheres of that mass are lighter than the target"),
    ] {
        let e = refused(&two, &body, &MassOptions { m_min, m_max, ..plain });
        assert!(e.to_string().contains(text), "{e}");
    }
    let line: Vec<_> = (0..5).map(|i| ball(f64::from(i) * 0.1, 0.2, 0.0)).collect();
    let plane: Vec<_> = (0..12)
        .map(|i| ball(f64::from(i % 4) * 0.2 - 0.3, f64::from(i / 4) * 0.2 - 0.2, 0.25))
        .collect();
    for (spheres, text) in [
        (vec![ball(0.5, 0.0, 0.0)], "lies 5.000e-1 outside the hull of the 1 sphere centres"),
        (vec![ball(0.3, 0.4, 0.0)], "lies 5.000e-1 outside the hull of the 1 sphere centres"),
        (vec![ball(0.9, 0.0, 0.0), ball(0.5, 0.0, 0.0)], "on one line; sphere 1 reaches farthest"),
        (vec![ball(0.5, 0.0, 0.0); 3], "3 sphere centres, which are all in one place; sphere"),
        (line, "5 sphere centres, which lie on one line; sphere"),
        (plane, "lies 2.500e-1 outside the hull of the 12 sphere centres, which lie in one plane"),
    ] {
        let e = refused(&spheres, &body, &plain);
        assert!(matches!(&e, Error::NoMasses(t) if t.contains(text)), "{e}");
        let options = MassOptions { infeasible: Infeasible::LeastError, ..plain };
        let m = solve(&spheres, &body, &options);
        assert_eq!(m.status, MassStatus::MassOnly);
        assert!(m.residuals.mass < 1e-12 && m.masses.iter().all(|x| *x >= m.m_min));
    }
    // The nearest point of the hull, (0.4, 0.3, 0), lies between the first and the last.
    let edge = [
        ball(0.6, 0.033_333_333_333_333_33, 0.0),
        ball(2.0, 2.0, 0.0),
        ball(0.0, 0.833_333_333_333_333_4, 0.0),
    ];
    let e = refused(&edge, &body, &plain).to_string();
    assert!(e.contains("lies 5.000e-1 outside the hull of the 3 sphere centres"), "{e}");
    let lopsided = [ball(0.5, 0.0, 0.0), ball(-0.1, 0.0, 0.0)];
    let e = refused(&lopsided, &body, &MassOptions { m_min: Some(0.4 * mass), ..plain });
    assert!(matches!(&e, Error::NoMasses(t) if t.contains("the bounds are too narrow")), "{e}");
    // Coincident, collinear and coplanar centres that do hold the centre: relaxed.
    let flat: Vec<_> = (0..9)
        .map(|i| ball(f64::from(i % 3) * 0.3 - 0.3, f64::from(i / 3) * 0.3 - 0.3, 0.0))
        .collect();
    for spheres in [vec![ball(0.0, 0.0, 0.0); 4], two.to_vec(), flat] {
        for objective in OBJECTIVES {
            let m = solve(&spheres, &body, &ask(objective));
            assert_eq!(m.status, MassStatus::Relaxed, "{objective:?}");
            assert!(m.residuals.center < 1e-12);
        }
    }
    let cancelled = Run::serial().with_progress(Box::new(|_| true));
    let e = correct(&two, &body, &plain, &cancelled).unwrap_err();
    assert!(matches!(e, Error::Cancelled(_)));
}

#[test]
fn spheres_too_small_for_a_volume_take_the_least_mass() {
    let mut spheres = scattered(40, 3.0);
    let body = of_union(&spheres, 1.0);
    let at = spheres[7].center;
    for radius in [1e-100, 1e-160, 1e-309] {
        spheres.push(Sphere::new(at, radius));
        let m = correct(&spheres, &body, &MassOptions::default(), &run()).unwrap();
        assert!(m.spread.is_finite() && m.spread < 10.0, "{radius:e}: {}", m.spread);
        assert!(m.residuals.mass < 1e-12 && m.masses.iter().all(|m| m.is_finite()));
        spheres.pop();
    }
}

#[test]
fn planes_and_lines_of_spheres_may_lie_anyhow() {
    // Across them the equations hold nothing but rounding where they are turned.
    let plane: Vec<_> = (0..9)
        .map(|i| {
            let (x, y) = (f64::from(i % 3) * 0.3 - 0.3, f64::from(i / 3) * 0.3 - 0.3);
            let x = if i == 4 { 0.02 } else { x };
            Sphere::new(Vec3::new(x, y, 0.0), 0.5 + 0.03 * f64::from(i))
        })
        .collect();
    let line: Vec<_> = (0..5)
        .map(|i| {
            Sphere::new(Vec3::new(0.25 * f64::from(i) - 0.5, 0.0, 0.0), 0.5 + 0.02 * f64::from(i))
        })
        .collect();
    let straight = ellipsoid(1.3, 1.0, 0.8, 2.0);
    for spheres in [plane, line] {
        for objective in OBJECTIVES {
            let least = solve(&spheres, &straight, &ask(objective)).residuals.inertia;
            for k in 0..8 {
                let t = f64::from(k);
                let turn = Rotation3::from_euler_angles(0.3 + t, 1.1 * t - 0.8, 1.9 - 0.7 * t);
                let place = |s: &Sphere| Sphere::new(turn * s.center, s.radius);
                let turned: Vec<_> = spheres.iter().map(place).collect();
                let tensor = turn.matrix() * straight.inertia.matrix() * turn.matrix().transpose();
                let moments = Moments {
                    volume: straight.volume,
                    centroid: Vec3::zeros(),
                    inertia: Inertia::from_matrix(&(tensor / 2.0)),
                    relative_error: 0.0,
                };
                let body = Body::of_moments(&moments, 2.0).unwrap();
                let m = solve(&turned, &body, &ask(objective));
                assert_eq!(m.status, MassStatus::Relaxed);
                assert!(m.residuals.mass < 1e-12 && m.residuals.center < 1e-12);
                let off = m.residuals.inertia / least - 1.0;
                assert!(off.abs() < 1e-6, "{objective:?} {k}: {off:e}");
            }
        }
    }
}

#[path = "oracle_tests.rs"]
mod oracle;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn masses_are_positive_and_exact_or_least_wrong(
        n in 1u32..60, seed in 0.0..100.0f64, objective in 0usize..3, least in 0.0..0.5f64,
    ) {
        let spheres = scattered(n, seed);
        let body = of_union(&spheres, 7.0);
        let m_min = least * body.mass / f64::from(n);
        let options = MassOptions {
            m_min: Some(m_min),
            infeasible: Infeasible::LeastError,
            ..ask(OBJECTIVES[objective])
        };
        let m = solve(&spheres, &body, &options);
        prop_assert!(m.masses.iter().all(|m| *m > 0.0 && *m >= m_min && m.is_finite()));
        prop_assert!(m.residuals.mass < 1e-12);
        match m.status {
            MassStatus::Exact => prop_assert!(m.residuals.inertia <= 1e-10),
            MassStatus::Relaxed => {
                prop_assert!(m.residuals.center < 1e-10);
                prop_assert!(m.largest_m_min.is_none_or(|t| t < m_min.max(1e-9 * body.mass) * (1.0 + 1e-4)));
            }
            MassStatus::MassOnly => {}
        }
    }
}
