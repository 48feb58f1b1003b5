//! Thinning against a slow literal transcription of algorithm 1, and the topology against counts
//! of the closed cubes.

use super::*;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

type Place = [i32; 3];
type Set = BTreeSet<Place>;

fn at(p: Place, d: Place) -> Place {
    [p[0] + d[0], p[1] + d[1], p[2] + d[2]]
}

/// All steps to the 26 neighbours.
fn steps() -> impl Iterator<Item = Place> {
    (0..27).filter(|&b| b != 13).map(|b| [b % 3 - 1, b / 3 % 3 - 1, b / 9 - 1])
}

fn length(d: &Place) -> i32 {
    d.iter().map(|x| x.abs()).sum()
}

/// Number of parts of `set` under steps of at most `most` axes.
fn parts(set: &Set, most: i32) -> Vec<Set> {
    let mut left = set.clone();
    let mut found = Vec::new();
    while let Some(first) = left.pop_first() {
        let (mut part, mut open) = (Set::from([first]), vec![first]);
        while let Some(p) = open.pop() {
            for d in steps().filter(|d| length(d) <= most) {
                if left.remove(&at(p, d)) {
                    part.insert(at(p, d));
                    open.push(at(p, d));
                }
            }
        }
        found.push(part);
    }
    found
}

/// Theorem 1.
fn is_simple(p: Place, x: &Set) -> bool {
    let solid: Set = steps().map(|d| at(p, d)).filter(|q| x.contains(q)).collect();
    let near = steps().filter(|d| length(d) <= 2).map(|d| at(p, d));
    let empty: Set = near.filter(|q| !x.contains(q)).collect();
    let faced = |s: &Set| steps().any(|d| length(&d) == 1 && s.contains(&at(p, d)));
    parts(&solid, 3).len() == 1 && parts(&empty, 1).iter().filter(|s| faced(s)).count() == 1
}

/// All cliques of rank `d` (3: single voxels): sets of all voxels around a face of the lattice
/// with nothing else in common.
fn cliques(x: &Set, rank: usize) -> BTreeSet<Vec<Place>> {
    let mut found = BTreeSet::new();
    for &p in x {
        // Faces of the cube p: along each axis the whole edge (0) or one of its ends.
        for f in 0..27 {
            let face: Place = [f % 3 - 1, f / 3 % 3 - 1, f / 9 - 1];
            if face.iter().filter(|&&s| s == 0).count() != rank {
                continue;
            }
            let others = (0..8).map(|m| [0, 1, 2].map(|a| face[a] * (m >> a & 1)));
            let members: Set = others.map(|d| at(p, d)).filter(|q| x.contains(q)).collect();
            let spans = |a: usize| {
                let along: BTreeSet<i32> = members.iter().map(|q| q[a]).collect();
                face[a] == 0 || along.len() == 2
            };
            if (0..3).all(spans) {
                found.insert(members.into_iter().collect());
            }
        }
    }
    found
}

fn critical(clique: &[Place], x: &Set) -> bool {
    let touches = |p: &Place| {
        clique.iter().all(|q| (0..3).all(|a| (p[a] - q[a]).abs() <= 1)) && !clique.contains(p)
    };
    let mut left: Set = x.iter().copied().filter(touches).collect();
    if clique.len() == 1 {
        return !is_simple(clique[0], x);
    }
    while left.len() > 1 {
        let Some(p) = left.iter().copied().find(|p| is_simple(*p, &left)) else { return true };
        left.remove(&p);
    }
    left.is_empty()
}

/// Algorithm 1, line by line.
fn literal(mut x: Set, ends: Ends) -> Set {
    let index = |p: &Place| [p[2], p[1], p[0]];
    let mut k = Set::new();
    loop {
        let mut y = k.clone();
        for rank in [3, 2, 1, 0] {
            let mut t = Set::new();
            for c in cliques(&x, rank) {
                if c.iter().all(|p| !y.contains(p)) && critical(&c, &x) {
                    t.extend(c.iter().min_by_key(|p| index(p)));
                }
            }
            y.extend(t);
        }
        if y == x {
            return x;
        }
        x = y;
        let faces = || steps().filter(|d| length(d) == 1);
        let interior = |p: Place| x.contains(&p) && faces().all(|d| x.contains(&at(p, d)));
        for &p in &x {
            let end = match ends {
                Ends::Surface => !interior(p) && !faces().any(|d| interior(at(p, d))),
                Ends::Curve => steps().filter(|&d| x.contains(&at(p, d))).count() == 1,
            };
            if end {
                k.insert(p);
            }
        }
    }
}

/// Parts, tunnels and cavities of the union of closed cubes.
fn topology(x: &Set) -> [i64; 3] {
    let mut faces: BTreeMap<Place, i64> = BTreeMap::new();
    let (mut low, mut high) = ([0; 3], [0; 3]);
    for p in x {
        for d in std::iter::once([0; 3]).chain(steps()) {
            // Of doubled coordinates: odd ones run along an edge of the cube.
            let face = [0, 1, 2].map(|a| 2 * p[a] + 1 + d[a]);
            let rank = face.iter().filter(|c| c.rem_euclid(2) == 1).count();
            faces.insert(face, if rank % 2 == 0 { 1 } else { -1 });
        }
        for a in 0..3 {
            low[a] = low[a].min(p[a] - 1);
            high[a] = high[a].max(p[a] + 1);
        }
    }
    let mut outside = Set::new();
    for i in low[0]..=high[0] {
        for j in low[1]..=high[1] {
            outside.extend((low[2]..=high[2]).map(|k| [i, j, k]).filter(|p| !x.contains(p)));
        }
    }
    let solid = parts(x, 3).len() as i64;
    let cavities = parts(&outside, 1).len() as i64 - 1;
    [solid, solid + cavities - faces.values().sum::<i64>(), cavities]
}

fn set_of(dims: [usize; 3], cells: &[u8]) -> Set {
    (0..cells.len()).filter(|&n| cells[n] != 0).map(|n| place(dims, n)).collect()
}

fn place(dims: [usize; 3], n: usize) -> Place {
    [n % dims[0], n / dims[0] % dims[1], n / dims[0] / dims[1]].map(|i| i as i32)
}

fn thinned(dims: [usize; 3], cells: &[u8], ends: Ends) -> Set {
    let skeleton = thin(dims, cells, ends, u64::MAX, &Run::serial()).unwrap();
    assert_eq!(skeleton.simple, 0);
    skeleton.voxels.into_iter().map(|n| place(dims, n)).collect()
}

/// Cells of which about `fill` in 16 are solid, then closed or opened so that there are lumps.
fn lumps(dims: [usize; 3], seed: u64, fill: u64) -> Vec<u8> {
    let noise: Vec<u8> = (0..dims.iter().product::<usize>() as u64)
        .map(|i| {
            let n = (i + 1).wrapping_mul(seed | 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            u8::from((n ^ n >> 29) >> 40 & 15 < fill)
        })
        .collect();
    if seed & 2 == 0 {
        return noise;
    }
    let x = set_of(dims, &noise);
    (0..noise.len())
        .map(|n| {
            let near = steps().filter(|&d| x.contains(&at(place(dims, n), d))).count();
            u8::from(near as u64 >= 26 - fill)
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn it_is_the_algorithm(
        dims in [3usize..8, 3usize..8, 3usize..7],
        seed in any::<u64>(),
        fill in 5u64..16,
    ) {
        let cells = lumps(dims, seed, fill);
        for ends in [Ends::Surface, Ends::Curve] {
            let expected = literal(set_of(dims, &cells), ends);
            prop_assert_eq!(thinned(dims, &cells, ends), expected);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_topology_stays(
        dims in [4usize..13, 4usize..13, 4usize..13],
        seed in any::<u64>(),
        fill in 4u64..17,
    ) {
        let cells = lumps(dims, seed, fill);
        let before = set_of(dims, &cells);
        for ends in [Ends::Surface, Ends::Curve] {
            let after = thinned(dims, &cells, ends);
            prop_assert!(after.is_subset(&before));
            prop_assert_eq!(topology(&after), topology(&before));
        }
    }
}

/// Cells of a shape given by a formula about the middle.
fn shape(n: usize, inside: impl Fn([f64; 3]) -> bool) -> ([usize; 3], Vec<u8>) {
    let half = 0.5 * (n as f64 - 1.0);
    let cell = |m: usize| inside(place([n; 3], m).map(|i| f64::from(i) - half));
    ([n; 3], (0..n * n * n).map(|m| u8::from(cell(m))).collect())
}

#[test]
fn known_bodies_have_known_skeletons() {
    let norm = |p: [f64; 3]| p.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (dims, ball) = shape(25, |p| norm(p) < 11.0);
    assert_eq!(thinned(dims, &ball, Ends::Curve).len(), 1);
    let (dims, shell) = shape(25, |p| norm(p) < 11.0 && norm(p) > 5.0);
    let after = thinned(dims, &shell, Ends::Surface);
    assert_eq!(topology(&after), [1, 0, 1]);
    let (dims, ring) = shape(25, |p| (p[0].hypot(p[1]) - 7.0).hypot(p[2]) < 4.0);
    let after = thinned(dims, &ring, Ends::Curve);
    assert_eq!(topology(&after), [1, 1, 0]);
    assert!(after.len() < 60, "{}", after.len());
    // The medial axis of an ellipsoid about its longest axis, as the paper's figure 3d.
    let (dims, ellipsoid) = shape(31, |p| norm([p[0] / 14.0, p[1] / 9.0, p[2] / 9.0]) < 1.0);
    let after = thinned(dims, &ellipsoid, Ends::Curve);
    assert!(after.iter().all(|p| p[1] == 15 && p[2] == 15) && after.len() < 20, "{after:?}");
    // A box has its medial surface: 13 sheets, one of them the middle rectangle.
    let (dims, block) = shape(27, |p| p[0].abs() < 12.0 && p[1].abs() < 9.0 && p[2].abs() < 6.0);
    let after = thinned(dims, &block, Ends::Surface);
    assert!(after.contains(&[13, 13, 13]) && after.contains(&[16, 13, 13]));
    assert!(after.contains(&[18, 14, 13]) && !after.contains(&[13, 13, 15]));
    assert_eq!(topology(&after), [1, 0, 0]);
}

#[test]
fn threads_do_not_matter() {
    let (dims, cells) =
        shape(48, |p| (p[0].hypot(p[1]) - 14.0).hypot(p[2]) < 6.0 || p[0].abs() + p[2].abs() < 3.5);
    for ends in [Ends::Surface, Ends::Curve] {
        let with = |threads| thin(dims, &cells, ends, u64::MAX, &Run::new(threads).unwrap());
        let one = with(1).unwrap();
        assert!(one.voxels.len() > 40 && one.passes > 3);
        assert_eq!(Ok(&one), with(2).as_ref());
        assert_eq!(Ok(&one), with(8).as_ref());
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let run = Run::serial();
    let thin = |dims, cells: &[u8], limit| thin(dims, cells, Ends::Surface, limit, &run);
    assert!(matches!(thin([2, 2, 2], &[1; 7], 1000), Err(Error::InvalidArgument(_))));
    assert!(matches!(thin([2, 2, 2], &[1; 8], 63), Err(Error::MemoryLimit(_))));
    assert!(matches!(thin([usize::MAX, 2, 2], &[], 1000), Err(Error::TooLarge(_))));
    assert!(thin([0, 2, 2], &[], 1000).unwrap().voxels.is_empty());
    assert_eq!(thin([1, 1, 1], &[1], 1000).unwrap().voxels, [0]);
    let cancel = Run::serial().with_progress(Box::new(|_| true));
    let cancelled = super::thin([1; 3], &[1], Ends::Surface, 1000, &cancel);
    assert!(matches!(cancelled, Err(Error::Cancelled(_))));
}
