//! Where the balls may begin: spread greedily, as crystals, by lot.

use super::lattice::{Pose, lattices};
use super::room::Room;
use crate::error::{Result, collected, filled, reserve};
use crate::generate::balls::random::Random;
use crate::math::Vec3;
use crate::run::Run;

/// Places, and the radius to begin with.
pub(super) struct Start {
    pub centers: Vec<Vec3>,
    pub radius: f64,
}

/// Cells that stand for all inside.
const CELLS: usize = 20_000;
/// Cells times balls that the greedy start may look at.
const LOOKS: usize = 1 << 24;

/// Places inside with their depth, and the ways in which lattices are laid into the body.
pub(super) struct Ground<'a> {
    room: &'a Room<'a>,
    inside: Vec<(Vec3, f64)>,
    poses: Vec<Pose>,
    volume: f64,
}

impl<'a> Ground<'a> {
    /// `axes`: the principal axes of the body; some poses follow these, some the frame, the rest
    /// is turned by lot.
    pub fn new(
        room: &'a Room,
        volume: f64,
        axes: [Vec3; 3],
        poses: usize,
        random: &mut Random,
    ) -> Result<Ground<'a>> {
        let grid = room.grid;
        let [nx, ny, _] = grid.dims;
        let center = |i: usize| grid.center(i % nx, i / nx % ny, i / (nx * ny));
        let cells = room.field.iter().filter(|d| **d < 0.0).count();
        let stride = cells.div_ceil(CELLS).max(1);
        let all = room.field.iter().enumerate().filter(|(_, d)| **d < 0.0).step_by(stride);
        let inside = collected("places inside", all.map(|(i, d)| (center(i), -f64::from(*d))))?;
        let half = grid.spacing.norm() * 0.3;
        let mut turned = reserve("the poses of lattices", poses)?;
        for i in 0..poses {
            let (which, shifted) = (i % 8, i / 8);
            let axes = match which {
                0 | 1 => [Vec3::x(), Vec3::y(), Vec3::z()],
                2 => axes,
                _ => random.rotation().map(|row| Vec3::from(row.map(f64::from))),
            };
            let (mut lo, mut hi) = ([f64::MAX; 3], [f64::MIN; 3]);
            for (p, _) in &inside {
                for a in 0..3 {
                    let q = axes[a].dot(p);
                    lo[a] = lo[a].min(q - half);
                    hi[a] = hi[a].max(q + half);
                }
            }
            let shift = match shifted {
                0 => [1.0; 3],
                _ => [(); 3].map(|()| random.unit()),
            };
            turned.push(Pose { axes, lo, hi, shift });
        }
        Ok(Ground { room, inside, poses: turned, volume })
    }

    /// No `n` balls within the body are larger.
    pub fn bound(&self, n: usize) -> f64 {
        (self.volume / n.max(1) as f64 * 0.75 / std::f64::consts::PI).cbrt()
    }

    /// Volume over that of a ball of this radius.
    pub fn by_volume(&self, radius: f64) -> f64 {
        // A radius may be so small that the quotient has no number.
        let part = self.bound(1) / radius.max(1e-9 * self.bound(1));
        part * part * part
    }

    /// How many balls of this radius a lattice has within the body: more may fit.
    pub fn fitting(&self, radius: f64, run: &Run) -> usize {
        let all = lattices();
        let counts = run.pool().map(all.len() * self.poses.len(), |i| {
            all[i % all.len()].count(self.room, &self.poses[i / all.len()], radius)
        });
        counts.into_iter().max().unwrap_or(0)
    }

    /// Every ball where it has most room, after those before it.
    pub fn greedy(&self, n: usize) -> Result<Option<Start>> {
        if self.inside.is_empty() {
            return Ok(None);
        }
        let most = (LOOKS / n.max(1)).clamp(1, self.inside.len());
        if most < 4 * n {
            return Ok(None);
        }
        let stride = self.inside.len().div_ceil(most);
        let mut left: Vec<(Vec3, f64)> =
            collected("places inside", self.inside.iter().step_by(stride).copied())?;
        let mut centers = reserve("the places of balls", n)?;
        let mut radius = f64::MAX;
        for _ in 0..n {
            let mut top = 0;
            for (i, place) in left.iter().enumerate() {
                if place.1 > left[top].1 {
                    top = i;
                }
            }
            let (p, room) = left[top];
            radius = radius.min(room);
            centers.push(p);
            for (q, room) in &mut left {
                *room = room.min(0.5 * (*q - p).norm());
            }
        }
        Ok(Some(Start { centers, radius: radius.max(0.7 * self.bound(n)) }))
    }

    /// The lattices whose balls are largest, at most `keep`.
    pub fn crystals(&self, n: usize, keep: usize, run: &Run) -> Result<Vec<Start>> {
        let all = lattices();
        let most = self.bound(n);
        let radii = run.pool().map(all.len() * self.poses.len(), |i| {
            all[i % all.len()].radius(self.room, &self.poses[i / all.len()], n, most)
        });
        let mut order: Vec<usize> = (0..radii.len()).filter(|&i| radii[i] > 0.0).collect();
        order.sort_by(|&a, &b| radii[b].total_cmp(&radii[a]));
        order.truncate(keep);
        let mut starts = reserve("starts", order.len())?;
        for i in order {
            let (lattice, pose) = (&all[i % all.len()], &self.poses[i / all.len()]);
            let centers = lattice.places(self.room, pose, n, radii[i])?;
            if centers.len() == n {
                starts.push(Start { centers, radius: radii[i] });
            }
        }
        Ok(starts)
    }

    /// Places by lot.
    pub fn lot(&self, n: usize, random: &mut Random) -> Result<Option<Start>> {
        if self.inside.is_empty() {
            return Ok(None);
        }
        let mut centers = filled("the places of balls", n, Vec3::zeros())?;
        for p in &mut centers {
            let jitter = [(); 3].map(|()| random.between(-0.5, 0.5));
            let cell = self.inside[random.below(self.inside.len())].0;
            *p = cell + self.room.grid.spacing.component_mul(&Vec3::from(jitter));
        }
        Ok(Some(Start { centers, radius: 0.75 * self.bound(n) }))
    }
}
