//! Shares against the union and against points.

use super::super::correct::tests::{of_union, run, scattered};
use super::*;
use crate::math::{Sphere, Vec3};

#[test]
fn shares_add_up_to_the_union() {
    for (n, seed) in [(2, 0.0), (30, 1.0), (200, 2.0)] {
        let spheres = scattered(n, seed);
        let pile = Pile::new(&spheres).unwrap();
        let found = shares(&pile, &run()).unwrap();
        let volume = of_union(&spheres, 1.0).volume;
        let sum: f64 = found.iter().sum();
        assert!((sum / volume - 1.0).abs() < 3e-3, "{} for {n}", sum / volume - 1.0);
        assert_eq!(shares(&pile, &Run::new(3).unwrap()).unwrap(), found);
        // Against points of each ball, evenly in r³, z and the angle.
        for (s, share) in pile.spheres.iter().zip(&found) {
            let part: f64 = (0..4000)
                .map(|k| {
                    let t = f64::from(k) + 0.5;
                    let z = 2.0 * (t * 0.754_877_666).fract() - 1.0;
                    let (y, x) = (std::f64::consts::TAU * (t * 0.569_840_29).fract()).sin_cos();
                    let across = (1.0 - z * z).sqrt();
                    let r = s.radius * (t / 4000.0).cbrt();
                    let p = s.center + Vec3::new(across * x, across * y, z) * r;
                    1.0 / spheres.iter().filter(|o| o.contains(&p)).count() as f64
                })
                .sum();
            let off = share / s.volume() - part / 4000.0;
            assert!(off.abs() < 0.01, "{off} of {n}");
        }
    }
    // Two balls share the lens; five of one place have a fifth each.
    let pair = [0.0, 0.7].map(|x| Sphere::new(Vec3::new(x, 0.0, 0.0), 1.0));
    let pile = Pile::new(&pair).unwrap();
    let half = of_union(&pair, 1.0).volume / 2.0;
    for s in shares(&pile, &run()).unwrap() {
        assert!((s / half - 1.0).abs() < 3e-3, "{s} {half}");
    }
    let pile = Pile::new(&[pair[0]; 5]).unwrap();
    for s in shares(&pile, &run()).unwrap() {
        assert!((s * 5.0 / pair[0].volume() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn crowds_share_by_a_lattice_what_they_share_alone() {
    // Two hundred balls of which each meets most others.
    let mut spheres = scattered(200, 3.0);
    spheres.iter_mut().for_each(|s| s.radius *= 3.0);
    let middle = Vec3::new(0.5, 0.4, 0.3);
    spheres.iter_mut().for_each(|s| s.center -= middle);
    let pile = Pile::new(&spheres).unwrap();
    let lattice = Lattice::new(&pile);
    assert!(pile.spheres.iter().all(|s| lattice.resolves(s)));
    let common = lattice.shares(&pile, &run()).unwrap();
    let found = shares(&pile, &run()).unwrap();
    let mut crowded = 0;
    for (i, s) in pile.spheres.iter().enumerate() {
        let mut near = Vec::new();
        pile.neighbours(i, |_, o| {
            let d = o.center - s.center;
            near.push(([d.x, d.y, d.z], o.radius * o.radius));
        });
        let (alone, together) = (share(s, &near) / s.volume(), common[i] / s.volume());
        assert!((alone - together).abs() < 0.01, "{alone} {together}");
        crowded += usize::from(found[i] == common[i]);
    }
    assert!(crowded > 100, "{crowded}");
    let sum: f64 = found.iter().sum();
    assert!((sum / of_union(&spheres, 1.0).volume - 1.0).abs() < 3e-3);
    // Mirror images have equal shares.
    let image: Vec<_> = spheres
        .iter()
        .map(|s| Sphere::new(s.center.component_mul(&Vec3::new(-1.0, 1.0, -1.0)), s.radius))
        .collect();
    let image = Pile::new(&image).unwrap();
    let other = shares(&image, &run()).unwrap();
    let by_caller = |pile: &Pile, shares: &[f64]| {
        let mut out = vec![0.0; shares.len()];
        pile.order.iter().zip(shares).for_each(|(&i, s)| out[i as usize] = *s);
        out
    };
    for (a, b) in by_caller(&pile, &found).iter().zip(by_caller(&image, &other)) {
        assert!((a / b - 1.0).abs() < 1e-11, "{a} {b}");
    }
}
