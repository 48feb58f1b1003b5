//! The moments of unions against formulas and against fine columns.

use super::*;

fn moments(spheres: &[Sphere]) -> Moments {
    union_moments(spheres, &Run::serial()).unwrap()
}

fn ball(x: f64, y: f64, z: f64, r: f64) -> Sphere {
    Sphere::new(Vec3::new(x, y, z), r)
}

fn scattered(n: u32, seed: f64) -> Vec<Sphere> {
    (0..n)
        .map(|i| {
            let t = f64::from(i) + seed;
            let c = Vec3::new((t * 0.37).fract(), (t * 0.61).fract(), (t * 0.83).fract());
            Sphere::new(c, 0.08 + 0.2 * (t * 0.29).fract())
        })
        .collect()
}

/// How far two moments differ, over volume, size and greatest moment.
fn apart(a: &Moments, b: &Moments) -> f64 {
    let size = b.volume.cbrt();
    let (x, y) = (a.inertia.to_array(), b.inertia.to_array());
    let greatest = y.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let inertia = x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / greatest;
    inertia.max((a.volume / b.volume - 1.0).abs()).max((a.centroid - b.centroid).norm() / size)
}

/// 1, z, z² and x² + y² over the part of a ball about the origin where z < h.
fn below(r: f64, h: f64) -> [f64; 4] {
    let (h2, r2) = (h * h, r * r);
    let z0 = PI * (r2 * (h + r) - (h * h2 + r * r2) / 3.0);
    let z1 = -PI / 4.0 * (r2 - h2) * (r2 - h2);
    let z2 = PI * (r2 * (h * h2 + r * r2) / 3.0 - (h2 * h2 * h + r2 * r2 * r) / 5.0);
    let across = PI / 2.0
        * (r2 * r2 * (h + r) - 2.0 * r2 * (h * h2 + r * r2) / 3.0
            + (h2 * h2 * h + r2 * r2 * r) / 5.0);
    [z0, z1, z2, across]
}

/// The union of a ball about the origin and one on the z axis, by formula.
fn pair(r: f64, s: f64, d: f64) -> Moments {
    let h = (d * d + r * r - s * s) / (2.0 * d);
    let a = below(r, h);
    let b = below(s, d - h);
    // The second is mirrored and shifted.
    let volume = a[0] + b[0];
    let first = a[1] + d * b[0] - b[1];
    let second = a[2] + d * d * b[0] - 2.0 * d * b[1] + b[2];
    let across = 0.5 * (a[3] + b[3]);
    let z = first / volume;
    let along = second - z * z * volume;
    Moments {
        volume,
        centroid: Vec3::new(0.0, 0.0, z),
        inertia: Inertia::from_second_moments([across, across, along, 0.0, 0.0, 0.0]),
        relative_error: 0.0,
    }
}

/// By n × n columns along z, exact along them.
fn by_columns(spheres: &[Sphere], n: usize) -> Moments {
    let lo =
        spheres.iter().fold(Vec3::repeat(9e9), |m, s| m.inf(&(s.center.add_scalar(-s.radius))));
    let hi =
        spheres.iter().fold(Vec3::repeat(-9e9), |m, s| m.sup(&(s.center.add_scalar(s.radius))));
    let (dx, dy) = ((hi.x - lo.x) / n as f64, (hi.y - lo.y) / n as f64);
    let mut m = [0.0; 10];
    let mut chords = Vec::new();
    for i in 0..n {
        let x = lo.x + (i as f64 + 0.5) * dx;
        let row: Vec<_> = spheres.iter().filter(|s| (s.center.x - x).abs() < s.radius).collect();
        for j in 0..n {
            let y = lo.y + (j as f64 + 0.5) * dy;
            chords.clear();
            for s in &row {
                let h2 = s.radius.powi(2) - (s.center.x - x).powi(2) - (s.center.y - y).powi(2);
                if h2 > 0.0 {
                    chords.push((s.center.z - h2.sqrt(), s.center.z + h2.sqrt()));
                }
            }
            chords.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut end = f64::MIN;
            for &(a, b) in &chords {
                let a = a.max(end);
                if b > a {
                    let (l, t) = ((b - a) * dx * dy, 0.5 * (a + b));
                    let tt = t * t + (b - a) * (b - a) / 12.0;
                    let all = [1.0, x, y, t, x * x, y * y, tt, x * y, x * t, y * t];
                    m.iter_mut().zip(all).for_each(|(m, v)| *m += l * v);
                    end = b;
                }
            }
        }
    }
    let c = Vec3::new(m[1], m[2], m[3]) / m[0];
    let own = [c.x * c.x, c.y * c.y, c.z * c.z, c.x * c.y, c.x * c.z, c.y * c.z];
    let second = std::array::from_fn(|k| m[4 + k] - m[0] * own[k]);
    Moments {
        volume: m[0],
        centroid: c,
        inertia: Inertia::from_second_moments(second),
        relative_error: 0.0,
    }
}

#[test]
fn one_sphere_and_apart_ones() {
    for r in [1e-9, 0.7, 1e6] {
        let m = moments(&[ball(3.0 * r, -r, 0.5 * r, r)]);
        let v = 4.0 / 3.0 * PI * r.powi(3);
        assert!((m.volume / v - 1.0).abs() < 1e-10 && m.relative_error <= 1e-10);
        assert!((m.inertia.xx / (0.4 * v * r * r) - 1.0).abs() < 1e-10);
        assert!(m.inertia.xy.abs() < 1e-10 * m.inertia.xx);
        assert!((m.centroid - Vec3::new(3.0, -1.0, 0.5) * r).norm() < 1e-10 * r);
    }
    // Two that touch in a point: twice one, by Steiner.
    let m = moments(&[ball(0.0, 0.0, 0.0, 1.0), ball(2.0, 0.0, 0.0, 1.0)]);
    let v = 4.0 / 3.0 * PI;
    assert!((m.volume / (2.0 * v) - 1.0).abs() < 1e-10);
    assert!((m.inertia.yy / (2.0 * v * 1.4) - 1.0).abs() < 1e-10);
    assert!((m.inertia.xx / (2.0 * v * 0.4) - 1.0).abs() < 1e-10);
}

#[test]
fn two_spheres_by_formula() {
    for k in 0..200 {
        let t = f64::from(k) + 0.5;
        let (r, s) = (0.2 + (t * 0.37).fract(), 0.2 + (t * 0.61).fract());
        let d = (r - s).abs() + (r + s - (r - s).abs()) * (t * 0.83).fract();
        let m = moments(&[ball(0.0, 0.0, 0.0, r), ball(0.0, 0.0, d, s)]);
        let far = apart(&m, &pair(r, s, d));
        assert!(far < 1e-10, "{far:e} for {r} {s} {d}");
        assert!(m.relative_error <= 1e-9, "{:e}", m.relative_error);
    }
}

#[test]
fn hardly_different_spheres_by_formula() {
    for d in [1e-3, 1e-5, 1e-7, 1e-9, 1e-12] {
        let m = moments(&[ball(0.0, 0.0, 0.0, 1.0), ball(0.0, 0.0, d, 1.0)]);
        let far = apart(&m, &pair(1.0, 1.0, d));
        assert!(far < 1e-10, "{far:e} at {d}");
    }
    for gap in [1e-3, 1e-6, 1e-9, 1e-12] {
        // All but touching, from outside and from inside.
        for (s, d) in [(0.5, 1.5 - gap), (0.5, 0.5 + gap)] {
            let m = moments(&[ball(0.0, 0.0, 0.0, 1.0), ball(0.0, 0.0, d, s)]);
            let far = apart(&m, &pair(1.0, s, d));
            assert!(far < 1e-9, "{far:e} at {s} {d}");
        }
    }
}

#[test]
fn three_and_four_spheres_of_a_reuleaux_tetrahedron() {
    // Centres one radius apart: what all four share has a volume known in closed form.
    let h = 0.75f64.sqrt();
    let four = [
        ball(0.0, 0.0, 0.0, 1.0),
        ball(1.0, 0.0, 0.0, 1.0),
        ball(0.5, h, 0.0, 1.0),
        ball(0.5, h / 3.0, (2.0f64 / 3.0).sqrt(), 1.0),
    ];
    let one = 4.0 / 3.0 * PI;
    let two = 5.0 / 12.0 * PI;
    let three = moments(&four[..3]).volume - 3.0 * one + 3.0 * two;
    let all = -(moments(&four).volume - 4.0 * one + 6.0 * two - 4.0 * three);
    let exact = (3.0 * 2f64.sqrt() - 49.0 * PI + 162.0 * 2f64.sqrt().atan()) / 12.0;
    assert!((all - exact).abs() < 1e-9, "{all} {exact}");
}

/// The volume of the lens of two balls.
fn lens(r: f64, s: f64, d: f64) -> f64 {
    let both = r + s - d;
    PI * both * both * (d * d + 2.0 * d * (r + s) - 3.0 * (r - s) * (r - s)) / (12.0 * d)
}

/// The part of all directions that the corner at `o` of a tetrahedron takes.
fn corner(o: &Vec3, others: [&Vec3; 3]) -> f64 {
    let [a, b, c] = others.map(|p| p - o);
    let [x, y, z] = [a.norm(), b.norm(), c.norm()];
    let above = x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y;
    2.0 * a.dot(&b.cross(&c)).abs().atan2(above) / (4.0 * PI)
}

/// The part of a full turn between the faces of a tetrahedron that meet in the edge `p`, `q`.
fn edge(p: &Vec3, q: &Vec3, others: [&Vec3; 2]) -> f64 {
    let along = (q - p).normalize();
    let [u, v] = others.map(|o| (o - p) - along * along.dot(&(o - p)));
    u.cross(&v).norm().atan2(u.dot(&v)) / (2.0 * PI)
}

#[test]
fn three_spheres_by_formula() {
    // The centres and a point where all three surfaces meet span a tetrahedron that the balls cover:
    // by inclusion and exclusion within it (Edelsbrunner 1995), half of what is common to all three.
    let mut seen = 0;
    for k in 0..400 {
        let t = f64::from(k) + 0.5;
        let of = |f: f64| (t * f).fract();
        let r = [0.7 + 0.5 * of(0.371), 0.7 + 0.5 * of(0.613), 0.7 + 0.5 * of(0.829)];
        let p = [
            Vec3::zeros(),
            Vec3::new(0.2 + of(0.287), 0.0, 0.0),
            Vec3::new(of(0.541), 0.2 + of(0.717), 0.0),
        ];
        let d = |i: usize, j: usize| (p[i] - p[j]).norm();
        let pairs = [(0, 1, 2), (0, 2, 1), (1, 2, 0)];
        let x = (r[0] * r[0] - r[1] * r[1] + p[1].x * p[1].x) / (2.0 * p[1].x);
        let (i, j) = (p[2].x, p[2].y);
        let y = (r[0] * r[0] - r[2] * r[2] + i * i + j * j - 2.0 * i * x) / (2.0 * j);
        let z2 = r[0] * r[0] - x * x - y * y;
        let within = |&(i, j, _): &(usize, usize, usize)| (r[i] - r[j]).abs() >= d(i, j);
        if z2 <= 0.0 || pairs.iter().any(within) {
            continue;
        }
        seen += 1;
        let top = Vec3::new(x, y, z2.sqrt());
        let volume = r.map(|r| 4.0 / 3.0 * PI * r.powi(3));
        let mut half = p[1].x * j * top.z / 6.0;
        let mut union = volume.iter().sum::<f64>();
        for (i, j, k) in pairs {
            half -= corner(&p[k], [&p[i], &p[j], &top]) * volume[k];
            half += edge(&p[i], &p[j], [&p[k], &top]) * lens(r[i], r[j], d(i, j));
            union -= lens(r[i], r[j], d(i, j));
        }
        union += 2.0 * half;
        let balls = [0, 1, 2].map(|i| Sphere::new(p[i], r[i]));
        let found = moments(&balls).volume;
        assert!((found / union - 1.0).abs() < 1e-9, "{found} {union} of {balls:?}");
    }
    assert!(seen > 150, "{seen}");
}

#[test]
fn scattered_spheres_against_columns() {
    for (n, seed) in [(3, 0.0), (5, 3.0), (12, 1.0), (40, 7.0), (150, 2.0)] {
        let spheres = scattered(n, seed);
        let m = moments(&spheres);
        let far = apart(&m, &by_columns(&spheres, 700));
        println!("{n} {far:e} {:e}", m.relative_error);
        assert!(far < 5e-5, "{far:e} for {n}");
        assert!(m.relative_error < 1e-8, "{:e} for {n}", m.relative_error);
    }
}

#[test]
fn places_where_many_surfaces_meet() {
    let cubic = |r: f64| {
        let at = |i: i32, k: i32| f64::from(i >> k & 1);
        (0..8).map(|i| ball(at(i, 0), at(i, 1), at(i, 2), r)).collect::<Vec<_>>()
    };
    let ring = |n: i32, r: f64| {
        let at = |i: i32| f64::from(i) / f64::from(n) * TAU;
        (0..n).map(|i| ball(at(i).cos(), at(i).sin(), 0.0, r)).collect::<Vec<_>>()
    };
    let mut row: Vec<_> = (0..6).map(|i| ball(0.3 * f64::from(i), 0.0, 0.0, 0.5)).collect();
    row.push(row[2]);
    row.push(row[2]);
    row.push(ball(0.6, 0.0, 0.0, 0.2));
    let mut inside = cubic(0.75f64.sqrt());
    inside.push(ball(0.5, 0.5, 0.5, 0.3));
    let cases = [
        ("faces touch", cubic(0.5)),
        ("four meet in a point", cubic(0.5f64.sqrt())),
        ("eight meet in a point", cubic(0.75f64.sqrt())),
        ("one covered by eight", inside),
        ("all share a point", ring(7, 1.0)),
        ("a ring", ring(12, 0.4)),
        ("a row with copies", row),
    ];
    for (name, spheres) in cases {
        let m = moments(&spheres);
        let far = apart(&m, &by_columns(&spheres, 900));
        println!("{name}: {far:e} {:e}", m.relative_error);
        assert!(far < 3e-5, "{name}: {far:e}");
        assert!(m.relative_error < 1e-7, "{name}: {:e}", m.relative_error);
    }
    // A copy changes nothing.
    let far =
        apart(&moments(&[ball(0.0, 0.0, 0.0, 1.0); 5]), &moments(&[ball(0.0, 0.0, 0.0, 1.0)]));
    assert!(far < 1e-10);
}

#[test]
fn order_and_powers_of_two_change_no_bit() {
    let spheres = scattered(30, 5.0);
    let m = moments(&spheres);
    let mut other = spheres.clone();
    other.reverse();
    assert_eq!(moments(&other), m);
    assert_eq!(union_moments(&spheres, &Run::new(3).unwrap()).unwrap(), m);
    for k in [-40, 20] {
        let f = 2f64.powi(k);
        let scaled: Vec<_> =
            spheres.iter().map(|s| Sphere::new(s.center * f, s.radius * f)).collect();
        let s = moments(&scaled);
        assert_eq!((s.volume, s.inertia.yz), (m.volume * f.powi(3), m.inertia.yz * f.powi(5)));
    }
    let far: Vec<_> =
        spheres.iter().map(|s| Sphere::new(s.center.add_scalar(1e6), s.radius)).collect();
    let mut back = moments(&far);
    back.centroid -= Vec3::repeat(1e6);
    assert!(apart(&back, &m) < 1e-8);
}

#[test]
fn what_is_no_clump_is_refused() {
    let run = Run::serial();
    assert!(matches!(union_moments(&[], &run), Err(Error::Empty(_))));
    let e = union_moments(&[ball(0.0, 0.0, 0.0, 1.0), ball(0.0, f64::NAN, 0.0, 1.0)], &run);
    assert_eq!(e, Err(Error::NotFinite("sphere 1 has centre (0, NaN, 0) and radius 1".into())));
    let e = union_moments(&[ball(0.0, 0.0, 0.0, 0.0)], &run).unwrap_err();
    assert_eq!(e.to_string(), "sphere 0 has radius 0, not above 0");
    let e = union_moments(&[ball(1e308, 0.0, 0.0, 1e308)], &run);
    assert!(matches!(e, Err(Error::InvalidArgument(_))));
    let cancelled = Run::serial().with_progress(Box::new(|_| true));
    assert!(matches!(union_moments(&scattered(3, 0.0), &cancelled), Err(Error::Cancelled(_))));
}
