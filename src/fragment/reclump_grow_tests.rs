//! Radii between inscribed and best.

use super::super::super::grow::{grow, grown_radii};
use super::*;

#[test]
fn spheres_grow_to_a_lesser_mismatch_and_spare_others() {
    let solid = solid("stone", 24, 48);
    let parent = parent(&solid, 0);
    let cut = plane([1.0, 0.3, -0.2], solid.unit_moments().centroid.into());
    let sides = [cut, other(&cut)].map(|side| region(&solid, &[side]));
    let run = Run::serial();
    let made = sides.each_ref().map(|r| reclump(&parent, r, &asked(10, false), &run).unwrap());
    let [a, b] = made.each_ref().map(|m| m.spheres.as_slice());
    let radii = grown_radii(&parent, &sides[0], a, &run).unwrap();
    assert!(radii.iter().zip(a).all(|(r, s)| *r >= s.radius));
    let mismatch = |spheres: &[Sphere]| {
        let spheres: Vec<Sphere> =
            spheres.iter().map(|s| solid.frame().sphere_to_unit(s)).collect();
        let surface = solid.surface(&run).unwrap();
        let mut random = Random::new(3);
        let (mut both, mut sum) = (0.0, 0.0);
        for _ in 0..20_000 {
            let p = Vec3::from([0, 1, 2].map(|_| 1.2 * f64::from(random.unit()) - 0.1));
            let clump = spheres.iter().any(|s| s.contains(&p));
            let target = sides[0].wall(&p) >= 0.0 && surface.contains(&p);
            sum += f64::from(u8::from(clump)) + f64::from(u8::from(target));
            both += f64::from(u8::from(clump && target));
        }
        1.0 - 2.0 * both / sum
    };
    let grown = grow(a, &radii, 1.0, &[], 0.0).unwrap();
    let (before, after) = (mismatch(a), mismatch(&grown));
    assert!(after < 0.8 * before, "{before} {after}");
    for part in [0.0, 0.3, 1.0] {
        let grown = grow(a, &radii, part, b, 1e-3).unwrap();
        let touch = overlap(a, b).max(-1e-3);
        assert!(overlap(&grown, b) <= touch + 1e-15, "{part}");
        assert!(grown.iter().zip(a).all(|(g, s)| g.radius >= s.radius));
    }
    for (part, gap) in [(1.5, 0.0), (f64::NAN, 0.0), (0.5, -1.0)] {
        assert!(grow(a, &radii, part, b, gap).is_err());
    }
    assert!(grow(a, &radii[1..], 0.5, b, 0.0).is_err());
}
