//! The largest ball about a place that stays within the surface.

use super::Bound;
use crate::generate::ball::Ball;
use crate::generate::balls::field::Field;
use crate::generate::balls::medial;
use crate::math::{Sphere, Vec3};
use crate::solid::nearest::Surface;

/// The surface, and what balls may be.
pub(super) struct Depth<'a> {
    pub field: &'a Field,
    pub surface: &'a Surface,
    pub bound: Option<Bound<'a>>,
    /// How far balls may reach beyond it.
    pub tolerance: f64,
    pub least: f64,
    /// A length of the order of the body.
    pub size: f32,
}

/// A ball that touches the surface, and the way in which its place grows deeper.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inside {
    pub ball: Ball,
    pub inward: [f32; 3],
}

impl Depth<'_> {
    /// The ball about a place that is inside.
    fn inside(&self, center: [f32; 3]) -> Option<Inside> {
        let p = Vec3::from(center.map(f64::from));
        let nearest = self.surface.nearest(&p);
        let (mut depth, mut point) = (nearest.distance, nearest.point);
        if let Some((below, other)) = self.bound.map(|bound| bound(&p))
            && below < depth
        {
            (depth, point) = (below, other);
        }
        if depth + self.tolerance < self.least {
            return None;
        }
        let way = if depth > 0.0 { (p - point) / depth } else { -nearest.normal };
        // To single precision, downwards.
        let radius = ((depth + self.tolerance) as f32).next_down();
        Some(Inside { ball: Ball { center, radius }, inward: [0, 1, 2].map(|a| way[a] as f32) })
    }

    /// The ball about `to`, when the way there from `from` does not leave the depth of `from`.
    pub(super) fn step(&self, from: &Ball, to: [f32; 3]) -> Option<Inside> {
        let there = Ball { center: to, radius: 0.0 };
        let reach = (from.radius - self.tolerance as f32).max(0.0);
        // Through a hole of an open mesh a step within the depth may lead outside.
        if from.apart(&there) >= reach * reach || self.field.one(to) >= 0.0 {
            return None;
        }
        self.inside(to)
    }

    /// A medial ball that holds the ball about `p`, as the field has it.
    pub(super) fn nearly(&self, p: [f32; 3]) -> Ball {
        let ball = medial::ball(self.field, p, self.size);
        Ball { radius: ball.radius + self.tolerance as f32, ..ball }
    }

    /// The ball about a place that the field has inside.
    pub(super) fn exact(&self, center: [f32; 3]) -> Option<Inside> {
        // The field is right to a part of a cell.
        let sure = self.field.one(center) < -self.field.cell();
        let at = Vec3::from(center.map(f64::from));
        if sure || self.surface.contains(&at) { self.inside(center) } else { None }
    }

    /// A medial ball that holds the ball about `p`.
    pub(super) fn medial(&self, p: [f32; 3]) -> Option<Inside> {
        self.exact(self.nearly(p).center)
    }

    /// The ball in double precision, with the whole depth that it may have.
    pub(super) fn sphere(&self, ball: &Ball) -> Sphere {
        let center = Vec3::from(ball.center.map(f64::from));
        let depth = self.surface.nearest(&center).distance;
        let depth = self.bound.map_or(depth, |bound| depth.min(bound(&center).0));
        Sphere::new(center, depth + self.tolerance)
    }
}
