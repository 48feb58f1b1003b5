//! Against a look at every face, and in how few looks.

use super::*;
use crate::run::Run;
use crate::shape::{Body, ImportOptions, Primitive, Shape};
use crate::solid::triangle;
use std::cell::Cell;

fn faces(name: &str, segments: usize) -> Vec<[Vec3; 3]> {
    let primitive = Primitive::from_name(name).unwrap();
    let run = Run::serial();
    let shape = Shape::from_primitive(&primitive, segments, &ImportOptions::default(), &run);
    let shape = shape.unwrap();
    let Body::Mesh(mesh) = &*shape.body else { panic!("a mesh") };
    (0..mesh.faces.len()).map(|i| mesh.corners(i)).collect()
}

fn tree(all: &[[Vec3; 3]], lie: Lie) -> Boxes {
    Boxes::new(all.len() as u32, |i| all[i as usize], lie).unwrap()
}

/// The square of the distance, and how many faces were looked at.
fn found(tree: &Boxes, all: &[[Vec3; 3]], p: &Vec3, reach2: f64) -> (Option<f64>, usize) {
    let looks = Cell::new(0);
    let found = tree.nearest(p, reach2, |i| {
        looks.set(looks.get() + 1);
        ((triangle::closest(&all[i as usize], p) - p).norm_squared(), i)
    });
    assert!(found.is_none_or(|(i, _, j)| i == j));
    (found.map(|f| f.1), looks.get())
}

fn least(all: &[[Vec3; 3]], p: &Vec3) -> f64 {
    all.iter().map(|t| (triangle::closest(t, p) - p).norm_squared()).fold(f64::MAX, f64::min)
}

/// Sizes and offsets far from one, on the surface, within it, and far away.
#[test]
fn nothing_nearer_is_missed() {
    for name in ["torus", "stone", "box", "cylinder"] {
        for (size, offset) in [(1.0, 0.0), (1e-9, 0.0), (1e6, 3e8), (1e-3, 1e3)] {
            let shift = Vec3::new(1.0, -0.3, 0.2) * offset;
            let all = faces(name, 24).into_iter().map(|t| t.map(|v| v * size + shift));
            let all: Vec<[Vec3; 3]> = all.collect();
            for lie in [Lie::Turned, Lie::Straight] {
                let tree = tree(&all, lie);
                let far = [0.0, 1e-7, 0.01, 0.3, 1.0, 30.0, 1e5, 1e13];
                for n in 0..40 {
                    let [a, b] = [n as f64 * 2.4, (n as f64 - 19.5) / 20.0];
                    let round = (1.0 - b * b).sqrt();
                    let d = Vec3::new(a.cos() * round, a.sin() * round, b);
                    let from = all[n * 17 % all.len()][n % 3];
                    let p = from + d * (size * far[n % far.len()]);
                    let expected = least(&all, &p);
                    assert_eq!(found(&tree, &all, &p, f64::MAX).0, Some(expected), "{name} {p}");
                    assert_eq!(found(&tree, &all, &p, expected).0, None);
                    let more = expected * 1.0001 + 1e-300;
                    assert_eq!(found(&tree, &all, &p, more).0, Some(expected));
                }
            }
        }
    }
}

/// Faces without area, all in one place, and one alone.
#[test]
fn faces_may_be_points_and_lines() {
    let o = Vec3::new(0.1, 0.2, 0.3);
    for all in [
        vec![[o; 3]],
        vec![[o; 3]; 100],
        vec![[o, o, o + Vec3::x()]; 30],
        (0..300).map(|i| [o * f64::from(i), o * f64::from(i + 1), o]).collect(),
    ] {
        let tree = tree(&all, Lie::Turned);
        for p in [o, Vec3::zeros(), Vec3::new(-1.0, 2.0, 1e3)] {
            assert_eq!(found(&tree, &all, &p, f64::MAX).0, Some(least(&all, &p)));
        }
    }
}

/// On the middle line of a long bar, where all four sides are as near.
#[test]
fn few_faces_are_looked_at() {
    let n = 120usize;
    let turn = nalgebra::Rotation3::from_euler_angles(0.4, 0.7, 0.2);
    let mut all = Vec::new();
    for side in 0..4 {
        let quarter = nalgebra::Rotation3::from_axis_angle(
            &Vec3::x_axis(),
            f64::from(side) * std::f64::consts::FRAC_PI_2,
        );
        let at = |i: usize, j: usize| {
            let [i, j] = [i, j].map(|x| x as f64 / n as f64);
            turn * (quarter * Vec3::new(4.0 * i - 2.0, 2.0 * j - 1.0, 1.0))
        };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            all.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            all.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    let looks = [Lie::Turned, Lie::Straight].map(|lie| {
        let tree = tree(&all, lie);
        let looks = (0..100).map(|k| {
            let p = turn * Vec3::new(0.031 * f64::from(k) - 1.5, 0.0, 0.0);
            let (d2, looks) = found(&tree, &all, &p, f64::MAX);
            assert!((d2.unwrap() - 1.0).abs() < 1e-12);
            looks
        });
        looks.sum::<usize>()
    });
    // Along the axes hundreds each time.
    assert!(looks[0] < 100 * 60 && looks[1] > 10 * looks[0], "{looks:?}");
}
