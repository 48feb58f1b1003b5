//! Starts in which balls lie as atoms in crystals.

use super::room::Room;
use crate::error::{Result, push};
use crate::math::Vec3;

/// A lattice by its rectangular cell: edges in diameters of a ball, and the balls in it as parts
/// of the edges.
pub(super) struct Lattice {
    edges: [f64; 3],
    basis: &'static [[f64; 3]],
}

/// Face-centred, hexagonal, body-centred and simple cubic.
pub(super) fn lattices() -> [Lattice; 4] {
    let (root2, root3) = (2f64.sqrt(), 3f64.sqrt());
    [
        Lattice {
            edges: [root2; 3],
            basis: &[[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]],
        },
        Lattice {
            edges: [1.0, root3, (8f64 / 3.0).sqrt()],
            basis: &[
                [0.0, 0.0, 0.0],
                [0.5, 0.5, 0.0],
                [0.5, 1.0 / 6.0, 0.5],
                [0.0, 2.0 / 3.0, 0.5],
            ],
        },
        Lattice { edges: [2.0 / root3; 3], basis: &[[0.0, 0.0, 0.0], [0.5, 0.5, 0.5]] },
        Lattice { edges: [1.0; 3], basis: &[[0.0, 0.0, 0.0]] },
    ]
}

/// How a lattice lies in the body.
pub(super) struct Pose {
    /// Axes of the lattice, by rows.
    pub axes: [Vec3; 3],
    /// Bounds of the body along these axes.
    pub lo: [f64; 3],
    pub hi: [f64; 3],
    /// Where its first ball lies: 0 is a radius above the lower bound, else parts of an edge
    /// further.
    pub shift: [f64; 3],
}

/// Most cells of a lattice that are looked at: of bodies that fill so little of their box, none.
const LOOKS: f64 = 1e7;
/// A ball counts with this part of the depth that it needs: the rest is found by pushing.
const NEARLY: f64 = 0.97;

impl Lattice {
    /// Calls `f` with the place and the depth of each ball of the radius `radius` that fits.
    pub fn fitting(&self, room: &Room, pose: &Pose, radius: f64, mut f: impl FnMut(Vec3, f64)) {
        let edge = self.edges.map(|e| 2.0 * radius * e);
        let first = [0, 1, 2].map(|a| pose.lo[a] + radius + (pose.shift[a] - 1.0) * edge[a]);
        let count = [0, 1, 2].map(|a| {
            ((pose.hi[a] - radius - first[a]) / edge[a] + 1e-6).clamp(0.0, 1e4) as usize + 1
        });
        if count.iter().fold(1.0, |n, c| n * *c as f64) > LOOKS {
            return;
        }
        for k in 0..count[2] {
            for j in 0..count[1] {
                for i in 0..count[0] {
                    for part in self.basis {
                        let at = [i, j, k];
                        let q = [0, 1, 2].map(|a| first[a] + (at[a] as f64 + part[a]) * edge[a]);
                        let p = pose.axes[0] * q[0] + pose.axes[1] * q[1] + pose.axes[2] * q[2];
                        let depth = room.nearly(&p).depth;
                        if depth >= NEARLY * radius {
                            f(p, depth);
                        }
                    }
                }
            }
        }
    }

    /// How many balls of the radius fit.
    pub fn count(&self, room: &Room, pose: &Pose, radius: f64) -> usize {
        let mut count = 0;
        self.fitting(room, pose, radius, |_, _| count += 1);
        count
    }

    /// About the greatest radius of which `n` balls fit, at most `most`.
    pub fn radius(&self, room: &Room, pose: &Pose, n: usize, most: f64) -> f64 {
        let (mut fits, mut fails) = (0.0, most);
        for _ in 0..9 {
            let middle = if fits > 0.0 { 0.5 * (fits + fails) } else { 0.7 * fails };
            if self.count(room, pose, middle) >= n { fits = middle } else { fails = middle }
        }
        fits
    }

    /// The `n` deepest balls of the radius, all if fewer fit.
    pub fn places(&self, room: &Room, pose: &Pose, n: usize, radius: f64) -> Result<Vec<Vec3>> {
        let mut all: Vec<(Vec3, f64)> = Vec::new();
        let mut failed = Ok(());
        self.fitting(room, pose, radius, |p, depth| {
            if failed.is_ok() {
                failed = push("the places of a lattice", &mut all, (p, depth));
            }
        });
        failed?;
        // The order among equals stays that of the lattice.
        all.sort_by(|a, b| b.1.total_cmp(&a.1));
        all.truncate(n);
        Ok(all.into_iter().map(|(p, _)| p).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::block;
    use super::*;
    use crate::run::Run;

    #[test]
    fn balls_of_every_lattice_touch_and_none_overlaps() {
        let solid = block();
        let room = Room::new(&solid, &Run::serial()).unwrap();
        let axes = [Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.8, 0.6, 0.0), Vec3::z()];
        for shift in [[1.0; 3], [0.3, 0.7, 0.1]] {
            let pose = Pose { axes, lo: [-1.0; 3], hi: [2.0; 3], shift };
            for (i, lattice) in lattices().iter().enumerate() {
                let places = lattice.places(&room, &pose, usize::MAX, 0.05).unwrap();
                assert!(places.len() > 60 && places.len() == lattice.count(&room, &pose, 0.05));
                let mut touching = 0;
                for (k, p) in places.iter().enumerate() {
                    for q in &places[..k] {
                        let apart = (p - q).norm() / 0.1;
                        assert!(apart > 1.0 - 1e-9, "lattice {i}: {apart}");
                        touching += usize::from(apart < 1.0 + 1e-9);
                    }
                }
                // 12, 12, 8 and 6 neighbours inside, fewer at the surface.
                let each = 2.0 * touching as f64 / places.len() as f64;
                let inside = [12.0, 12.0, 8.0, 6.0][i];
                assert!(each > 0.5 * inside && each < inside, "lattice {i}: {each}");
                let r = lattice.radius(&room, &pose, 40, 0.3);
                assert!(lattice.count(&room, &pose, r) >= 40, "lattice {i}: {r}");
                assert!(lattice.places(&room, &pose, 40, r).unwrap().len() == 40);
            }
        }
    }
}
