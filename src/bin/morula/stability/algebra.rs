//! Degenerate algebra: equal moments, spheres in a line or a plane, equations that only just have an
//! answer, points on one sphere.

use super::bodies::{Ask, mismatch, solid, spheres, three};
use super::{About, Bound, Found, Matrix, Miss};
use morula::fragment::{Cut, CutOptions, cut};
use morula::generate::Method;
use morula::mass::{
    Body, Infeasible, MassOptions, MassStatus, Masses, Objective, correct, union_moments,
};
use morula::math::{Inertia, PrincipalFrame, Sphere, Vec3};
use morula::run::Run;
use morula::shape::Primitive;
use nalgebra::{DMatrix, Matrix3};
use std::f64::consts::PI;

const FRAME: About = About {
    measure: "worst of |R'R - 1|, |det R - 1|, |R'IR - diag|/I, | |q| - 1|",
    bound: Bound::AtMost(1e-14),
    why: "a body frame is a rotation whatever the moments are",
};

const TEN: About = About {
    measure: "greatest residual of the ten equations",
    bound: Bound::AtMost(1e-10),
    why: "where positive masses meet all ten equations they are found",
};

const FOUR: About = About {
    measure: "greatest residual of mass and centre",
    bound: Bound::AtMost(1e-10),
    why: "mass and centre stay exact where inertia cannot be met",
};

const CONDITION: About = About {
    measure: "condition number of the ten equations",
    bound: Bound::Told,
    why: "how much of the digits the masses can lose; 1e14 stands for more, as where spheres lie in a line",
};

const UNION: About = About {
    measure: "|union volume / formula - 1|",
    bound: Bound::AtMost(1e-10),
    why: "spheres that touch, coincide or meet in one circle are as any others: integrals to 1e-10",
};

const CELLS: About = About {
    measure: "|sum of the cells' volumes / whole - 1|",
    bound: Bound::AtMost(1e-12),
    why: "eight points on one sphere, four in one plane: cells meet in one corner and nothing is lost",
};

const FITTED: About = About {
    measure: "D of surface_fit",
    bound: Bound::AtMost(0.02),
    why: "any four points of a ball lie on the same sphere: one remains, and least squares stay on it",
};

const COPLANAR: About = About {
    measure: "D of surface_fit over that of the greatest ball inside",
    bound: Bound::AtMost(1.05),
    why: "four points of one face are refused as coplanar; what is left fits no worse than one ball",
};

pub fn run(m: &mut Matrix) {
    fits(m);
    frames(m);
    masses(m);
    feasibility(m);
    unions(m);
    cells(m);
    depths(m);
}

/// Spheres through four points that lie on one sphere, or mostly in one plane.
fn fits(m: &mut Matrix) {
    for (name, segments) in [("ball of 24 segments", 24), ("ball of 96 segments", 96)] {
        m.case(name, &FITTED, || {
            let solid = solid(&Primitive::Sphere { radius: 0.5 }.mesh(segments)?, 32)?;
            let found = spheres(&solid, &Ask::new(Method::SurfaceFit, 5))?;
            mismatch(&solid, &found).map_err(Into::into)
        });
    }
    for (name, edges) in [("cube", [1.0; 3]), ("plate 1:5", [1.0, 1.0, 0.2])] {
        m.case(name, &COPLANAR, || {
            let solid = solid(&Primitive::Box { edges }.mesh(8)?, 32)?;
            let found = spheres(&solid, &Ask::new(Method::SurfaceFit, 20))?;
            let middle = solid.moments().centroid;
            let one = Sphere::new(middle, 0.5 * edges[2]);
            Ok(mismatch(&solid, &found)? / mismatch(&solid, &[one])?)
        });
    }
}

fn frame_error(inertia: &Inertia) -> f64 {
    let f = PrincipalFrame::of(inertia);
    let i = inertia.matrix();
    let size = i.abs().max();
    let r = f.axes;
    let off = |a: Matrix3<f64>| a.abs().max();
    let q = f.quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
    [
        off(r.transpose() * r - Matrix3::identity()),
        (r.determinant() - 1.0).abs(),
        off((r.transpose() * i * r - Matrix3::from_diagonal(&f.moments.into())) / size),
        (q - 1.0).abs(),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

fn frames(m: &mut Matrix) {
    let cases: [(&str, [f64; 3]); 6] = [
        ("three equal moments", [1.0; 3]),
        ("two equal moments", [0.5, 1.0, 1.0]),
        ("moments equal to 1e-15", [1.0, 1.0 + 1e-15, 1.0 + 2e-15]),
        ("a needle's moments, 1e-12 : 1 : 1", [1e-12, 1.0, 1.0]),
        ("moments near 1e-150", [1e-150, 2e-150, 2.5e-150]),
        ("moments near 1e150", [1e150, 2e150, 2.5e150]),
    ];
    for (name, d) in cases {
        m.case(name, &FRAME, || {
            let turned = (0..20).map(|k| {
                let rows = super::bodies::rotation(k);
                let r = Matrix3::from_rows(&rows.map(|v| v.transpose()));
                let i = r * Matrix3::from_diagonal(&d.into()) * r.transpose();
                frame_error(&Inertia::from_matrix(&((i + i.transpose()) * 0.5)))
            });
            Ok(turned.fold(0.0, f64::max))
        });
    }
}

fn ball(x: f64, y: f64, z: f64, r: f64) -> Sphere {
    Sphere::new(Vec3::new(x, y, z), r)
}

fn row(n: usize, step: f64, radius: f64) -> Vec<Sphere> {
    (0..n).map(|i| ball(step * i as f64, 0.3 * step * i as f64, 0.0, radius)).collect()
}

fn plane(step: f64, radius: f64) -> Vec<Sphere> {
    (0..9).map(|i| ball(step * (i % 3) as f64, step * (i / 3) as f64, 0.1, radius)).collect()
}

fn weighed(spheres: &[Sphere], options: &MassOptions) -> Result<Masses, Miss> {
    let run = Run::serial();
    let body = Body::of_union(spheres, 2500.0, &run)?;
    Ok(correct(spheres, &body, options, &run)?)
}

fn all_ten(m: &Masses) -> f64 {
    m.residuals.mass.max(m.residuals.center).max(m.residuals.inertia)
}

/// The ten equations of unit spheres' masses about the middle, rows and columns of like size.
fn condition(spheres: &[Sphere]) -> Found {
    let n = spheres.len();
    let middle = spheres.iter().map(|s| s.center).sum::<Vec3>() / n as f64;
    let far = |s: &Sphere| (s.center - middle).norm() + s.radius;
    let size = spheres.iter().map(far).fold(0.0, f64::max);
    let column = |s: &Sphere| {
        let c = (s.center - middle) / size;
        let r2 = 0.4 * (s.radius / size).powi(2);
        [
            1.0,
            c.x,
            c.y,
            c.z,
            c.y * c.y + c.z * c.z + r2,
            c.x * c.x + c.z * c.z + r2,
            c.x * c.x + c.y * c.y + r2,
            c.x * c.y,
            c.x * c.z,
            c.y * c.z,
        ]
    };
    let columns: Vec<[f64; 10]> = spheres.iter().map(column).collect();
    let values = DMatrix::from_fn(10, n, |i, j| columns[j][i]).singular_values();
    let (hi, lo) = (values.max(), values.min());
    if lo <= 1e-14 * hi {
        return Ok(1e14);
    }
    Ok(hi / lo)
}

fn masses(m: &mut Matrix) {
    let plain = MassOptions::default();
    let lone = |spheres: Vec<Sphere>| move || Ok(all_ten(&weighed(&spheres, &plain)?));
    m.case("one sphere", &TEN, lone(vec![ball(3.0, -1.0, 2.0, 0.5)]));
    m.case("five balls apart in a line", &TEN, lone(row(5, 3.0, 1.0)));
    m.case("nine balls apart in a plane", &TEN, lone(plane(3.0, 1.0)));
    m.case("two coincident spheres", &TEN, lone(vec![ball(0.0, 0.0, 0.0, 1.0); 2]));
    let near = vec![ball(0.0, 0.0, 0.0, 1.0), ball(1e-9, 0.0, 0.0, 1.0)];
    m.case("two spheres 1e-9 apart", &FOUR, || {
        let found = weighed(&near, &plain)?;
        Ok(found.residuals.mass.max(found.residuals.center))
    });
    m.case("a ball and one of a hundredth, apart", &TEN, || {
        let options = MassOptions { m_min: Some(0.0), ..plain };
        let two = [ball(0.0, 0.0, 0.0, 1.0), ball(2.0, 0.0, 0.0, 1e-2)];
        Ok(all_ten(&weighed(&two, &options)?))
    });
    m.case("a ball and one of a millionth: no centre, but the mass", &FOUR, || {
        let options = MassOptions { infeasible: Infeasible::LeastError, ..plain };
        let two = [ball(0.0, 0.0, 0.0, 1.0), ball(2.0, 0.0, 0.0, 1e-6)];
        let found = weighed(&two, &options)?;
        if found.status != MassStatus::MassOnly {
            return Err(Miss(format!("{:?} for masses out of bounds", found.status)));
        }
        Ok(found.residuals.mass)
    });
    for (name, spheres) in [
        ("five overlapping spheres in a line", row(5, 1.0, 1.0)),
        ("nine overlapping spheres in a plane", plane(1.0, 1.0)),
    ] {
        m.case(name, &FOUR, || {
            let found = weighed(&spheres, &plain)?;
            Ok(found.residuals.mass.max(found.residuals.center))
        });
        m.case(name, &CONDITION, || condition(&spheres));
    }
}

/// Least masses just below, at and just above the greatest that has an answer.
fn feasibility(m: &mut Matrix) {
    let bodies = three().unwrap_or_default();
    for (name, mesh) in &bodies {
        let clump = || -> Result<(Body, Vec<Sphere>), Miss> {
            let solid = solid(mesh, 32)?;
            let found = spheres(&solid, &Ask::new(Method::Best, 20))?;
            Ok((Body::of_solid(&solid, 2500.0)?, found))
        };
        m.case(format!("clump, {name}"), &CONDITION, || condition(&clump()?.1));
        m.case(format!("{name}, least mass at the edge of what is possible"), &FOUR, || {
            let (body, found) = clump()?;
            let run = Run::serial();
            let most = MassOptions { objective: Objective::MaxMin, ..MassOptions::default() };
            let best = correct(&found, &body, &MassOptions { m_min: Some(0.0), ..most }, &run)?;
            let least = best.masses.iter().fold(f64::MAX, |m, x| m.min(*x));
            let mut worst = 0.0f64;
            for part in [1.0 - 1e-6, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1.0 + 1e-6, 1.01] {
                for objective in [Objective::Even, Objective::MaxMin, Objective::MaxLast] {
                    let m_min = Some((least * part).min(body.mass / found.len() as f64));
                    let infeasible = Infeasible::LeastError;
                    let o = MassOptions { objective, m_min, m_max: None, infeasible };
                    let made = correct(&found, &body, &o, &run)?;
                    worst = worst.max(made.residuals.mass);
                    // Where inertia is given up, the centre is not; where all is, that is said.
                    if made.status != MassStatus::MassOnly {
                        worst = worst.max(made.residuals.center);
                    }
                    if best.status == MassStatus::Exact && part < 1.0 - 1e-9 {
                        worst = worst.max(made.residuals.inertia);
                    }
                }
            }
            Ok(worst)
        });
    }
}

fn unions(m: &mut Matrix) {
    let whole = |r: f64| 4.0 / 3.0 * PI * r * r * r;
    let cap = |h: f64| PI * h * h * (3.0 - h) / 3.0;
    let lens = 2.0 * whole(1.0) - 2.0 * cap(0.5);
    let far = 1.0 + 1e-9;
    // Of six spheres about a circle and one within their hole each circle runs through two points.
    let cases: Vec<(&str, Vec<Sphere>, f64)> = vec![
        ("a sphere twice", vec![ball(0.1, 0.2, 0.3, 1.0); 2], whole(1.0)),
        ("a sphere a hundred times", vec![ball(0.1, 0.2, 0.3, 1.0); 100], whole(1.0)),
        (
            "one touching another from within",
            { vec![ball(0.0, 0.0, 0.0, 1.0), ball(0.5, 0.0, 0.0, 0.5)] },
            whole(1.0),
        ),
        (
            "two that touch",
            { vec![ball(0.0, 0.0, 0.0, 1.0), ball(2.0, 0.0, 0.0, 1.0)] },
            2.0 * whole(1.0),
        ),
        (
            "two that touch but for 1e-9",
            { vec![ball(0.0, 0.0, 0.0, 1.0), ball(2.0 * far, 0.0, 0.0, 1.0)] },
            2.0 * whole(1.0),
        ),
        (
            "two and one through their circle",
            {
                // The third has the circle of the first two as a great circle.
                vec![
                    ball(-0.5, 0.0, 0.0, 1.0),
                    ball(0.5, 0.0, 0.0, 1.0),
                    ball(0.0, 0.0, 0.0, 0.75f64.sqrt()),
                ]
            },
            lens,
        ),
        (
            "a ball and one of 1e-6 on its surface",
            { vec![ball(0.0, 0.0, 0.0, 1.0), ball(1.0 + 1e-6, 0.0, 0.0, 1e-6)] },
            whole(1.0) + whole(1e-6),
        ),
    ];
    for (name, spheres, volume) in cases {
        m.case(name, &UNION, || {
            Ok((union_moments(&spheres, &Run::serial())?.volume / volume - 1.0).abs())
        });
    }
}

fn cells(m: &mut Matrix) {
    for (name, noise) in [("27 points of a lattice", 0.0), ("the same but for 1e-13", 1e-13)] {
        m.case(name, &CELLS, || {
            let solid = solid(&Primitive::Box { edges: [3.0; 3] }.mesh(8)?, 24)?;
            let at = |k: usize, a: usize| (k / 3usize.pow(a as u32) % 3) as f64 - 1.0;
            let shift = |k: usize, a: usize| noise * ((k * 7 + a * 3) % 5) as f64;
            let point = |k: usize| Vec3::from([0, 1, 2].map(|a| at(k, a) + shift(k, a)));
            let points = (0..27).map(point).collect();
            let by = Cut::Points { points, weights: Vec::new() };
            let made = cut(&solid, &by, &CutOptions::default(), &Run::serial())?;
            if made.regions.len() != 27 {
                return Err(Miss(format!("{} cells of 27", made.regions.len())));
            }
            let sum: f64 = made.regions.iter().map(|r| r.moments(solid.frame()).volume).sum();
            let dust: f64 = made.dust.iter().map(|d| d.moments.volume).sum();
            Ok(((sum + dust) / solid.moments().volume - 1.0).abs())
        });
    }
}

/// Where the gradient of the distance is zero or jumps.
fn depths(m: &mut Matrix) {
    let about = About {
        measure: "|distance - exact|, in sizes",
        bound: Bound::AtMost(1e-14),
        why: "at centres, on edges and in corners, where the distance has no gradient, it is exact",
    };
    m.case("centre, faces, edges and corners of a cube", &about, || {
        let solid = solid(&Primitive::Box { edges: [2.0; 3] }.mesh(8)?, 24)?;
        let surface = solid.surface(&Run::serial())?;
        let mut worst = 0.0f64;
        for k in 0..125usize {
            let p = Vec3::from([k % 5, k / 5 % 5, k / 25].map(|i| 0.5 * i as f64 - 1.0));
            let found = surface.signed_distance(&solid.frame().to_unit(&p)) * solid.frame().scale;
            worst = worst.max((found - (p.amax() - 1.0)).abs());
        }
        Ok(worst)
    });
}
