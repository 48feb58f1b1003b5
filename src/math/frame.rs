use super::{Inertia, Moments, Sphere, Vec3};

/// The frame in which all work is done: the caller's coordinates less the
/// lower corner of the bounding box, divided by a power of two, so that the
/// longest edge lies in (0.5, 1]. Scaling the input by 2^k, or shifting it by
/// an amount that its coordinates represent exactly, leaves every bit of the
/// unit-frame shape as it was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitFrame {
    /// Lower corner of the bounding box, in the caller's frame.
    pub offset: Vec3,
    /// Caller's length of one unit; a power of two.
    pub scale: f64,
}

impl UnitFrame {
    /// The frame of a bounding box given in the caller's coordinates; `None`
    /// when the box is not finite or has no extent.
    pub fn of_box(lo: Vec3, hi: Vec3) -> Option<Self> {
        let edge = (hi - lo).max();
        if !(edge.is_finite() && edge > 0.0) {
            return None;
        }
        // Exact power of two at or above the edge, without rounding in log2.
        let mut scale = 2f64.powi(edge.log2().ceil() as i32);
        while scale < edge {
            scale *= 2.0;
        }
        while scale * 0.5 >= edge {
            scale *= 0.5;
        }
        (scale.is_normal() && lo.iter().all(|v| v.is_finite()))
            .then_some(UnitFrame { offset: lo, scale })
    }

    /// Caller's point to unit frame.
    pub fn to_unit(&self, p: &Vec3) -> Vec3 {
        (p - self.offset) / self.scale
    }

    /// Unit-frame point to the caller's frame.
    pub fn to_input(&self, p: &Vec3) -> Vec3 {
        p * self.scale + self.offset
    }

    /// Unit-frame sphere to the caller's frame.
    pub fn sphere_to_input(&self, s: &Sphere) -> Sphere {
        Sphere::new(self.to_input(&s.center), s.radius * self.scale)
    }

    /// Caller's sphere to the unit frame.
    pub fn sphere_to_unit(&self, s: &Sphere) -> Sphere {
        Sphere::new(self.to_unit(&s.center), s.radius / self.scale)
    }

    /// Unit-frame moments (unit density) to the caller's frame.
    pub fn moments_to_input(&self, m: &Moments) -> Moments {
        let s3 = self.scale.powi(3);
        let s5 = s3 * self.scale * self.scale;
        Moments {
            volume: m.volume * s3,
            centroid: self.to_input(&m.centroid),
            inertia: Inertia::from_matrix(&(m.inertia.matrix() * s5)),
            relative_error: m.relative_error,
        }
    }
}
