//! The nearest top of a function with creases: a compass search whose directions turn.

use crate::math::Vec3;
use std::f64::consts::PI;

/// Directions of a round.
const WAYS: usize = 16;
/// Halvings of the step.
const HALVINGS: usize = 12;
/// A step must gain this part of its length: no crawling.
const WORTH: f64 = 0.01;
/// Most steps that are tried.
const MOST: usize = 1000;

/// From `start`, where the function is `value`, by steps no longer than `step`: the place reached
/// and the value there. The function may not rise faster than by its argument's way.
pub(in crate::generate) fn climb(
    start: Vec3,
    value: f64,
    mut step: f64,
    mut f: impl FnMut(&Vec3) -> f64,
) -> (Vec3, f64) {
    let (mut at, mut top) = (start, value);
    let (mut round, mut tried, mut halvings) = (0, 0, 0);
    while halvings <= HALVINGS && tried < MOST {
        let mut moved = false;
        for k in 0..WAYS {
            let to = at + way(k, round) * step;
            let here = f(&to);
            tried += 1;
            if here > top + WORTH * step {
                (at, top) = (to, here);
                moved = true;
                break;
            }
        }
        round += 1;
        if !moved {
            halvings += 1;
            step *= 0.5;
        }
    }
    (at, top)
}

/// Directions of a Fibonacci lattice, turned from round to round.
fn way(k: usize, round: usize) -> Vec3 {
    let z = 1.0 - (2 * k + 1) as f64 / WAYS as f64;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let angle = PI * (1.0 + 5f64.sqrt()) * k as f64 + round as f64;
    let (x, y) = (r * angle.cos(), r * angle.sin());
    match round % 3 {
        0 => Vec3::new(x, y, z),
        1 => Vec3::new(y, z, x),
        _ => Vec3::new(z, x, y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cones_and_roofs_are_climbed() {
        let top = Vec3::new(0.3, -0.2, 0.1);
        let (at, value) = climb(Vec3::zeros(), 1.0 - top.norm(), 0.1, |p| 1.0 - (p - top).norm());
        assert!((at - top).norm() < 1e-3 && value > 0.999, "{at} {value}");
        // Four slopes that meet in ridges along no axis, the top ridge rising slowly.
        let n = [
            Vec3::new(1.0, 2.0, 0.5),
            Vec3::new(-1.0, -1.0, 1.5),
            Vec3::new(0.5, -2.0, -1.0),
            Vec3::new(-0.3, 0.8, -1.1),
        ]
        .map(|v| v.normalize());
        let roof = |p: &Vec3| n.iter().map(|n| 1.0 + n.dot(p)).fold(f64::MAX, f64::min);
        // The top in a box, by brute force.
        let mut best = f64::MIN;
        for i in 0..61 * 61 * 61 {
            let p = [i % 61, i / 61 % 61, i / 3721].map(|c| (f64::from(c) - 30.0) / 30.0);
            best = best.max(roof(&Vec3::from(p)));
        }
        let (at, value) = climb(Vec3::repeat(0.5), roof(&Vec3::repeat(0.5)), 0.1, roof);
        assert!(value > best - 0.01, "{at} {value} {best}");
    }
}
