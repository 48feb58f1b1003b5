//! Balls about the medial axis, grown from points inside.

use super::field::Field;
use crate::generate::ball::Ball;

/// Of a cell: how much less than the shortest way to the surface a radius may be.
const TOLERANCE: f32 = 0.2;
/// First step from the point and the number of halvings that follow, as a part of the size.
const FIRST: f32 = 0.02;
const HALVINGS: usize = 8;

/// The greatest ball found that holds the ball about `p`: its centre moves away from the nearest
/// surface as long as the depth grows as fast. `size`: a length of the order of the body.
pub(crate) fn ball(field: &Field, p: [f32; 3], size: f32) -> Ball {
    let depth = -field.one(p);
    let slope = field.slope(p);
    let norm = slope.iter().map(|s| s * s).sum::<f32>().sqrt();
    if norm < 0.1 {
        return Ball { center: p, radius: depth.max(0.0) };
    }
    let way = slope.map(|s| -s / norm);
    let at = |t: f32| [0, 1, 2].map(|a| p[a] + t * way[a]);
    let slack = TOLERANCE * field.cell();
    let holds = |t: f32| -field.one(at(t)) >= depth + t - slack;
    let mut low = 0.0;
    let mut high = FIRST * size;
    while high < size && holds(high) {
        low = high;
        high *= 2.0;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let center = at(low);
    Ball { center, radius: (-field.one(center)).max(0.0) }
}
