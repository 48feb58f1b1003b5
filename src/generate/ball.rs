//! A sphere of the clump while it is refined.

use crate::math::{Sphere, Vec3};

/// A sphere, unit frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    pub center: [f32; 3],
    pub radius: f32,
}

impl Ball {
    /// The way from this centre to that of `other`.
    #[inline(always)]
    pub(super) fn way(&self, other: &Ball) -> [f32; 3] {
        let ([x, y, z], [u, v, w]) = (self.center, other.center);
        [u - x, v - y, w - z]
    }

    /// Squared distance of the centres.
    #[inline(always)]
    pub(super) fn apart(&self, other: &Ball) -> f32 {
        let [x, y, z] = self.way(other);
        x * x + y * y + z * z
    }

    /// Whether the balls overlap, or would if one grew by `slack`.
    #[inline(always)]
    pub(super) fn meets(&self, other: &Ball, slack: f32) -> bool {
        let reach = self.radius + other.radius + slack;
        self.apart(other) < reach * reach
    }

    /// In double precision.
    pub(super) fn sphere(&self) -> Sphere {
        Sphere::new(Vec3::from(self.center.map(f64::from)), f64::from(self.radius))
    }
}
