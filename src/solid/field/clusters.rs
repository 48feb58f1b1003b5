//! Features that lie together, for bricks much larger than they are.

use super::features::{Triangle, WHAT};
use super::regions::single;
use crate::error::{Result, reserve};
use crate::math::Vec3;
use std::ops::Range;

/// Vertices of a cluster (4 to 12 cost the same).
pub(super) const TOGETHER: usize = 6;

/// Ranges of faces, edges and corners, and a ball around them.
#[derive(Debug, Clone)]
pub(super) struct Cluster {
    pub faces: Range<u32>,
    pub edges: Range<u32>,
    pub corners: Range<u32>,
    pub center: [f32; 3],
    pub radius: f32,
}

/// Cuts the vertices, which are sorted by place, into runs; each feature (by its vertices, in
/// order of the first) goes with its first vertex.
pub(super) fn clusters(
    points: &[Vec3],
    faces: &[Triangle],
    edges: &[[u32; 2]],
    corners: &[u32],
    round: f32,
) -> Result<Vec<Cluster>> {
    let mut out = reserve(WHAT, points.len() / TOGETHER + 1)?;
    let (mut faces, mut edges, mut corners) =
        (Runs::new(faces), Runs::new(edges), Runs::new(corners));
    for start in (0..points.len()).step_by(TOGETHER) {
        let end = (start + TOGETHER).min(points.len());
        let (f, face_range) = faces.up_to(|f| (f[0].min(f[1]).min(f[2]) as usize) < end);
        let (e, edge_range) = edges.up_to(|e| (e[0].min(e[1]) as usize) < end);
        let (c, corner_range) = corners.up_to(|&c| (c as usize) < end);
        if f.is_empty() && e.is_empty() && c.is_empty() {
            continue;
        }
        // The ball is about the vertices of the run, and reaches those of all features.
        let run = &points[start..end];
        let (lo, hi) = run.iter().fold((run[0], run[0]), |(l, h), p| (l.inf(p), h.sup(p)));
        let center = (lo + hi) * 0.5;
        let mut squared = 0.0f64;
        for &v in f.iter().flatten().chain(e.iter().flatten()).chain(c) {
            squared = squared.max((points[v as usize] - center).norm_squared());
        }
        let radius = squared.sqrt();
        out.push(Cluster {
            faces: face_range,
            edges: edge_range,
            corners: corner_range,
            center: single(&center),
            // And what rounding to f32 moves.
            radius: radius as f32 + round,
        });
    }
    Ok(out)
}

/// A list that is taken run by run.
struct Runs<'a, T> {
    all: &'a [T],
    next: usize,
}

impl<'a, T> Runs<'a, T> {
    fn new(all: &'a [T]) -> Self {
        Runs { all, next: 0 }
    }

    fn up_to(&mut self, holds: impl Fn(&T) -> bool) -> (&'a [T], Range<u32>) {
        let start = self.next;
        let rest = self.all.get(start..).unwrap_or_default();
        let count = rest.iter().take_while(|t| holds(t)).count();
        self.next += count;
        (&rest[..count], start as u32..self.next as u32)
    }
}
