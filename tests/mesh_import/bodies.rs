//! Cavities, separate bodies, and surfaces that are open.

use super::*;

#[test]
fn cavities_stay_and_nests_turn_as_a_whole() {
    let shell = join(&[cube([0.0; 3], 4.0), turned(cube([1.0; 3], 2.0))]);
    for m in [shell.clone(), turned(shell.clone())] {
        let s = import(&m).unwrap();
        assert_eq!((s.report.components, s.report.bodies), (2, 1));
        assert_eq!(s.report.volume, 64.0 - 8.0);
        assert_eq!(s.report.inverted, m != shell);
        assert!(mesh(&s).clean);
    }
    // Both outward: filled, and said so.
    let s = import(&join(&[cube([0.0; 3], 4.0), cube([1.0; 3], 2.0)])).unwrap();
    assert_eq!(s.report.bodies, 1);
    assert!(has_note(&s, "within one another"));
    // A body in the cavity is another body, and faces outward whatever it did.
    for core in [cube([1.5; 3], 1.0), turned(cube([1.5; 3], 1.0))] {
        let m = join(&[shell.clone(), core]);
        assert!(matches!(import(&m), Err(Error::SeveralBodies(s)) if s.contains("2 separate")));
        let all = with(&m, |o| o.bodies = Bodies::All).unwrap();
        assert_eq!((all.report.volume, all.report.bodies, all.report.faces), (57.0, 2, 36));
        let largest = with(&m, |o| o.bodies = Bodies::Largest).unwrap();
        assert_eq!((largest.report.volume, largest.report.bodies_dropped), (56.0, 1));
    }
}

#[test]
fn bodies_are_counted_by_what_joins_them() {
    let bodies = |parts: &[Arrays]| with(&join(parts), |o| o.bodies = Bodies::All).unwrap().report;
    let at = |x: f64, y: f64, z: f64| cube([x, y, z], 1.0);
    let apart = bodies(&[at(0.0, 0.0, 0.0), at(3.0, 0.0, 0.0), at(0.0, 3.0, 0.0)]);
    assert_eq!((apart.bodies, apart.volume), (3, 3.0));
    assert_eq!(bodies(&[at(0.0, 0.0, 0.0), at(0.5, 0.5, 0.5)]).bodies, 1);
    // Two bars across each other, flush: no corner of one lies in the other.
    let bar = |edges: [f64; 3]| {
        let mut m = cube([-0.5; 3], 1.0);
        m.0.iter_mut().for_each(|v| (0..3).for_each(|k| v[k] *= edges[k]));
        m
    };
    assert_eq!(bodies(&[bar([4.0, 1.0, 1.0]), bar([1.0, 4.0, 1.0])]).bodies, 1);
    assert_eq!(bodies(&[bar([4.0, 1.0, 1.0]), bar([1.0, 4.0, 0.6])]).bodies, 1);
    // Touching in a point, along an edge, in part of a face.
    assert_eq!(bodies(&[at(0.0, 0.0, 0.0), at(1.0, 1.0, 1.0)]).bodies, 2);
    assert_eq!(bodies(&[at(0.0, 0.0, 0.0), at(1.0, 1.0, 0.0)]).bodies, 2);
    assert_eq!(bodies(&[at(0.0, 0.0, 0.0), at(1.0, 0.3, 0.4)]).bodies, 1);
    // `Largest` keeps the body, not its neighbour, and its frame.
    let m = join(&[at(0.0, 0.0, 0.0), cube([9.0, 0.0, 0.0], 2.0)]);
    let s = with(&m, |o| o.bodies = Bodies::Largest).unwrap();
    assert_eq!((s.report.volume, s.report.bodies, s.report.bodies_dropped), (8.0, 2, 1));
    assert_eq!((s.report.box_min, s.frame.scale), ([9.0, 0.0, 0.0], 2.0));
    assert!(has_note(&s, "of 2 bodies the largest was kept"));
}

#[test]
fn openings_are_judged() {
    let without = |m: &Arrays, drop: &dyn Fn([f64; 3]) -> bool| {
        let middle = |f: &[u32; 3]| {
            let sum = f.iter().fold([0.0; 3], |s, &i| [0, 1, 2].map(|k| s[k] + m.0[i as usize][k]));
            sum.map(|x| x / 3.0)
        };
        (m.0.clone(), m.1.iter().copied().filter(|f| !drop(middle(f))).collect::<Vec<_>>())
    };
    let ball = ball(24, 48);
    // A hole, half a ball, a box without a lid: closed flat, and said so.
    for (m, volume) in [
        (without(&ball, &|p| p[2] > 0.95), 4.16),
        (without(&ball, &|p| p[2] > 0.0), 2.08),
        (without(&cube([0.0; 3], 1.0), &|p| p[2] == 1.0), 1.0),
    ] {
        let s = import(&m).unwrap();
        assert!(!s.report.watertight && !mesh(&s).clean && has_note(&s, "the surface is open"));
        assert!((s.report.volume - volume).abs() < 0.02, "{} {volume}", s.report.volume);
    }
    // A shallow cap, a wavy sheet, faces at random: no inside.
    let cap = without(&ball, &|p| p[2] < 0.93);
    assert!(matches!(import(&cap), Err(Error::OpenSurface(s)) if s.contains("more than 40 %")));
    let mut sheet = (Vec::new(), Vec::new());
    for i in 0..20 {
        for j in 0..20 {
            let (x, y) = (f64::from(i), f64::from(j));
            sheet.0.push([x, y, (x * 0.7).sin() * (y * 0.9).cos()]);
            if i < 19 && j < 19 {
                let k = (i * 20 + j) as u32;
                sheet.1.extend([[k, k + 20, k + 21], [k, k + 21, k + 1]]);
            }
        }
    }
    assert!(matches!(import(&sheet), Err(Error::OpenSurface(_))));
    assert!(matches!(
        import(&(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]])),
        Err(Error::ZeroVolume(s)) if s.contains("one plane")
    ));
    // A two-sided square.
    let square = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let both = vec![[0, 1, 2], [0, 2, 3], [0, 2, 1], [0, 3, 2]];
    assert!(matches!(import(&(square, both)), Err(Error::ZeroVolume(_))));
    // A loose sheet beside a body goes; the faces of a cube, a little apart, stay.
    let s = import(&join(&[cube([0.0; 3], 40.0), sheet.clone()])).unwrap();
    assert!(s.report.watertight && has_note(&s, "loose sheets"));
    let mut apart = soup(&cube([0.0; 3], 1.0));
    for (k, v) in apart.0.iter_mut().enumerate() {
        let push = 1e-4 * ((k / 6) as f64 - 2.0);
        v.iter_mut().for_each(|x| *x += push);
    }
    let s = import(&apart).unwrap();
    assert_eq!((s.report.bodies, s.report.faces), (1, 12));
    assert!((s.report.volume - 1.0).abs() < 0.01, "{}", s.report.volume);
}

#[test]
fn many_cavities_and_one_that_breaks_through() {
    let mut m = cube([0.0; 3], 10.0);
    for n in 0..512 {
        let at = [n % 8, n / 8 % 8, n / 64].map(|k| 1.0 + f64::from(k));
        add(&mut m, &turned(cube(at, 0.5)));
    }
    let s = import(&m).unwrap();
    assert_eq!((s.report.components, s.report.bodies), (513, 1));
    assert!((s.report.volume - (1000.0 - 512.0 * 0.125)).abs() < 1e-9, "{}", s.report.volume);
    assert!(!s.report.inverted && s.report.faces_turned == 0);
    // A body across the outer wall is one with it.
    add(&mut m, &cube([9.75, 5.6, 5.6], 0.4));
    let s = import(&m).unwrap();
    assert_eq!((s.report.components, s.report.bodies), (514, 1));
}
