//! Balls of one radius pushed apart and off the surface while they grow, as far as it goes.
//!
//! Two balls that overlap push each other as if by springs, the surface pushes as a ball's image
//! behind it would. The radius follows: it grows while nothing overlaps by more than a given
//! part of it, else it shrinks; the part falls. In the end every ball that is in the way of
//! a larger radius touches.

use super::near::Near;
use super::room::Room;
use crate::error::{Result, filled};
use crate::math::Vec3;

/// How balls are pushed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Push {
    /// Steps.
    pub steps: usize,
    /// By which part of the radius balls may overlap in the first step and in the last.
    pub overlap: [f64; 2],
    /// Exact distances to the surface, or those of the field.
    pub exact: bool,
}

/// Places of balls, and the greatest radius that all can have there by the distances used.
#[derive(Debug, Clone)]
pub(super) struct Packing {
    pub centers: Vec<Vec3>,
    pub radius: f64,
}

/// Part of the overlap by which a ball is pushed in a step, and what it keeps of its last one.
const STIFF: f64 = 0.12;
const KEEP: f64 = 0.75;
/// Growth of the radius in a step, as a part of the overlap.
const GROW: f64 = 0.1;

/// Pushes the balls from `start`, at first with the radius `radius`.
pub(super) fn relax(room: &Room, start: &[Vec3], radius: f64, push: &Push) -> Result<Packing> {
    let n = start.len();
    let mut at = filled("the places of balls", n, Vec3::zeros())?;
    at.copy_from_slice(start);
    let mut best = Packing { centers: at.clone(), radius: 0.0 };
    let mut speed = filled("the steps of balls", n, Vec3::zeros())?;
    let mut near = Near::default();
    let mut target = radius;
    let [from, to] = push.overlap;
    let last = push.steps.saturating_sub(1).max(1) as f64;
    for step in 0..push.steps {
        let overlap = from * (to / from).powf(step as f64 / last);
        near.sort(&at, 2.0 * target)?;
        // The greatest radius that all can have here, if it is less than the one aimed at.
        let mut room_for = target;
        for (i, p) in at.iter().enumerate() {
            let mut force = Vec3::zeros();
            near.around(p, |j| {
                if j == i {
                    return;
                }
                let way = p - at[j];
                let apart = way.norm();
                if apart < 2.0 * target {
                    room_for = room_for.min(0.5 * apart);
                    let way = if apart > 1e-12 { way / apart } else { aside(i, j) };
                    force += way * (2.0 * target - apart);
                }
            });
            let wall = match push.exact {
                true => room.exact(p, target),
                false => Some(room.nearly(p)),
            };
            if let Some(wall) = wall.filter(|w| w.depth < target) {
                room_for = room_for.min(wall.depth);
                force += wall.inward * (2.0 * (target - wall.depth));
            }
            speed[i] = speed[i] * KEEP + force * STIFF;
            let length = speed[i].norm();
            if length > 0.5 * target {
                speed[i] *= 0.5 * target / length;
            }
        }
        if room_for > best.radius {
            best.radius = room_for;
            best.centers.copy_from_slice(&at);
        }
        for (p, v) in at.iter_mut().zip(&speed) {
            *p = room.keep(&(*p + v));
        }
        let grow = if target - room_for > overlap * target { -GROW } else { GROW };
        target *= 1.0 + grow * overlap;
    }
    Ok(best)
}

/// Balls in one place part in opposite directions.
fn aside(i: usize, j: usize) -> Vec3 {
    let sign = if i < j { 1.0 } else { -1.0 };
    let t = (i.min(j) % 1000) as f64;
    Vec3::new((0.7 * t).sin(), (1.3 * t).cos(), 0.5) * sign
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::{block, size};
    use super::*;
    use crate::run::Run;

    #[test]
    fn two_balls_go_to_the_far_ends_of_a_block() {
        let (solid, hi) = (block(), size());
        let room = Room::new(&solid, &Run::serial()).unwrap();
        let aside = Vec3::new(0.1, 0.03, 0.02);
        let start = [hi * 0.5 - aside, hi * 0.5 + aside];
        for exact in [false, true] {
            let push = Push { steps: 400, overlap: [0.2, 1e-5], exact };
            let found = relax(&room, &start, 0.2, &push).unwrap();
            // As wide as the block is high, one beside the other.
            let most = 0.5 * hi.z;
            // The field rounds off the ridge in the middle, by half a cell.
            let within = if exact { 1e-4 } else { 0.1 };
            assert!((found.radius / most - 1.0).abs() < within, "{} of {most}", found.radius);
        }
    }

    #[test]
    fn places_that_are_returned_have_room_for_the_radius() {
        let solid = block();
        let room = Room::new(&solid, &Run::serial()).unwrap();
        let start: Vec<Vec3> = (0..30)
            .map(|i| {
                let t = f64::from(i) + 0.5;
                Vec3::from([t * 0.754, t * 0.569, t * 0.321].map(f64::fract)).component_mul(&size())
            })
            .collect();
        let push = Push { steps: 200, overlap: [0.1, 1e-5], exact: true };
        let found = relax(&room, &start, 0.1, &push).unwrap();
        let at = &found.centers;
        let mut most = f64::MAX;
        for (i, p) in at.iter().enumerate() {
            most = most.min(room.depth(p));
            for q in &at[..i] {
                most = most.min(0.5 * (p - q).norm());
            }
        }
        assert!(found.radius <= most + 1e-12 && found.radius > 0.99 * most);
        assert!(found.radius > 0.08, "{}", found.radius);
    }
}
