//! Masses against slow and plain ways to find them.

use super::*;
use nalgebra::{DMatrix, DVector};

#[test]
fn newton_and_the_cone_solver_agree() {
    for (n, seed) in [(40, 1.0), (60, 2.0), (200, 4.0)] {
        let spheres = scattered(n, seed);
        let (p, pile) = problem(&spheres, &of_union(&spheres, 1.0), 0.05);
        let s = relative(shares(&pile, &run()).unwrap(), &p);
        let one = project(&p, ROWS, &s, &s, EXACT);
        let two = best(&p, Goal::Even(&s), ALL, 0.0).unwrap();
        let (Some(one), Some(two)) = (one, two) else { panic!("no masses for {n}") };
        let apart = one.iter().zip(&two).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-6, "{apart:e} for {n}");
    }
}

/// Every set of `k` of `n`.
fn sets(n: usize, k: usize) -> impl Iterator<Item = Vec<usize>> {
    (0u32..1 << n)
        .filter(move |s| s.count_ones() as usize == k)
        .map(move |s| (0..n).filter(|i| s >> i & 1 == 1).collect())
}

#[test]
fn even_masses_against_every_set_of_bounds() {
    // Mass and centre alone, eight spheres: the best of all choices of which are at the bound.
    for seed in 0..12 {
        let spheres = scattered(8, f64::from(seed));
        let body = ellipsoid(0.3, 0.2, 0.15, 1.0);
        let about: Vec<_> = spheres
            .iter()
            .map(|s| Sphere::new(s.center - Vec3::new(0.45, 0.4, 0.25), s.radius))
            .collect();
        let least = 0.3;
        let (p, pile) = problem(&about, &body, least);
        let s = relative(shares(&pile, &run()).unwrap(), &p);
        let cost =
            |x: &[f64]| -> f64 { x.iter().zip(&s).map(|(x, s)| (x - s) * (x - s) / s).sum() };
        let mut found = f64::MAX;
        for k in 0..=8 {
            for free in sets(8, k) {
                // Free ones: x = s + s Aᵀλ, A x = b less what the others give.
                let mut x = vec![least; 8];
                free.iter().for_each(|&i| x[i] = s[i]);
                let r = DVector::from_fn(4, |r, _| -p.residuals(&x)[r]);
                let a = DMatrix::from_fn(4, k, |r, j| p.rows[r][free[j]]);
                let w = DMatrix::from_fn(k, k, |i, j| if i == j { s[free[i]] } else { 0.0 });
                let Ok(inverse) = (&a * &w * a.transpose()).pseudo_inverse(1e-12) else { continue };
                let step = &w * a.transpose() * inverse * r;
                free.iter().zip(step.iter()).for_each(|(&i, d)| x[i] += d);
                let fits = p.residuals(&x)[..4].iter().all(|r| r.abs() < 1e-9);
                if fits && x.iter().all(|x| *x >= least - 1e-9) {
                    found = found.min(cost(&x));
                }
            }
        }
        match project(&p, 4, &s, &s, 1e-12) {
            Some(x) => assert!((cost(&x) - found).abs() < 1e-8 * (1.0 + found), "{seed}"),
            None => assert_eq!(found, f64::MAX, "{seed}"),
        }
    }
}

#[test]
fn linear_programs_against_every_vertex() {
    let demand = Demand { hard: 4, soft: 4 };
    let mut feasible = 0;
    for seed in 0..12 {
        let body = ellipsoid(0.3, 0.2, 0.15, 1.0);
        let spheres: Vec<_> = scattered(9, f64::from(seed))
            .iter()
            .map(|s| Sphere::new(s.center - Vec3::new(0.45, 0.4, 0.3), s.radius))
            .collect();
        let (p, _) = problem(&spheres, &body, 0.2);
        // Solves for what is in the basis; what is not is `rest`.
        let vertex = |basis: &[usize], rest: f64, common: bool| -> Option<(Vec<f64>, f64)> {
            let k = basis.len() + usize::from(common);
            let x0 = vec![rest; 9];
            let r = DVector::from_fn(4, |r, _| -p.residuals(&x0)[r]);
            let a = DMatrix::from_fn(4, k, |r, j| match basis.get(j) {
                Some(&i) => p.rows[r][i],
                None => p.rows[r].iter().sum(),
            });
            let step = a.lu().solve(&r)?;
            let t = if common { step[k - 1] } else { 0.0 };
            let mut x: Vec<f64> = x0.iter().map(|x| x + t).collect();
            basis.iter().zip(step.iter()).for_each(|(&i, d)| x[i] += d);
            let ok = basis.iter().zip(step.iter()).all(|(_, d)| *d >= -1e-9);
            ok.then_some((x, t))
        };
        let one = sets(9, 4).filter_map(|b| vertex(&b, 0.2, false)).map(|v| v.0[5]);
        let one = one.fold(f64::MIN, f64::max);
        match best(&p, Goal::MaxOne(5), demand, 0.0).unwrap() {
            Some(x) => assert!((x[5] - one).abs() < 1e-6, "{seed}: {} {one}", x[5]),
            None => assert_eq!(one, f64::MIN, "{seed}"),
        }
        let most = sets(9, 3).filter_map(|b| vertex(&b, 0.0, true)).map(|v| v.1);
        let most = most.fold(f64::MIN, f64::max);
        match best(&p, Goal::MaxMin, demand, 0.0).unwrap() {
            Some(x) => {
                feasible += 1;
                let least = x.iter().fold(f64::MAX, |a, b| a.min(*b));
                assert!((least - most).abs() < 1e-6, "{seed}: {least} {most}");
            }
            None => assert!(most < 0.2 + 1e-6, "{seed}: {most}"),
        }
    }
    assert!(feasible > 3, "{feasible}");
}

#[test]
fn least_errors_by_formula_and_against_many_tries() {
    // One sphere of radius r at the centre of a ball of radius 1: 2/5 r² for 2/5.
    for r in [0.5, 0.9, 1.0, 1.2] {
        let body = ellipsoid(1.0, 1.0, 1.0, 1.0);
        let m = solve(&[Sphere::new(Vec3::zeros(), r)], &body, &MassOptions::default());
        assert!((m.residuals.inertia - (r * r - 1.0).abs()).abs() < 1e-9, "{:?}", m.residuals);
        let status = if r == 1.0 { MassStatus::Exact } else { MassStatus::Relaxed };
        assert_eq!((m.status, m.binding.len()), (status, 0));
    }
    // Nothing that has mass and centre is nearer.
    for seed in 0..4 {
        let spheres = scattered(7, f64::from(seed));
        let body = of_union(&spheres, 1.0);
        let (p, _) = problem(&spheres, &body, 0.05);
        let demand = Demand { hard: INERTIA, soft: ROWS };
        let Some((eps, _)) = least_error(&p, demand).unwrap() else { continue };
        let m = solve(
            &spheres,
            &body,
            &MassOptions { m_min: Some(0.05 / 7.0 * body.mass), ..ask(Objective::Even) },
        );
        assert!((m.residuals.inertia - eps).abs() < 2e-4 * eps + 1e-8, "{eps} {:?}", m.residuals);
        let ones = [1.0; 7];
        for k in 0..2000 {
            let t = f64::from(k);
            let near: Vec<f64> =
                (0..7).map(|i| 3.0 * ((t + 0.37) * (0.618 + 0.1 * f64::from(i))).fract()).collect();
            if let Some(x) = project(&p, INERTIA, &near, &ones, 1e-12) {
                assert!(greatest(&p.residuals(&x)[INERTIA..]) > eps - 1e-8);
            }
        }
    }
}

#[test]
fn seven_equations_in_the_principal_frame_leave_the_products() {
    let spheres = scattered(40, 0.0);
    let body = of_union(&spheres, 1.0);
    let (p, pile) = problem(&spheres, &body, 0.1);
    let s = relative(shares(&pile, &run()).unwrap(), &p);
    // Mass, centre and the three moments, as Yuan 2019 has it.
    let seven = project(&p, 7, &s, &s, EXACT).unwrap();
    let r = p.residuals(&seven);
    assert!(greatest(&r[..7]) < 1e-12);
    assert!(greatest(&r[7..]) > 0.01, "{r:?}");
    let ten = project(&p, ROWS, &s, &s, EXACT).unwrap();
    assert!(greatest(&p.residuals(&ten)) < 1e-12);
}
