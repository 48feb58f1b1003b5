use super::{Axes, Inertia, Moments, Sphere, Vec3};

/// The frame in which all work is done: the caller's coordinates less the
/// lower corner of the bounding box, divided by a power of two, so that the
/// longest edge lies in (0.5, 1]. Scaling the input by 2^k, or shifting it by
/// an amount that its coordinates represent exactly, leaves every bit of the
/// unit-frame shape as it was. Methods work with the axes and the unit that the
/// body tells by itself, which this leads back from as well.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct UnitFrame {
    /// Lower corner of the bounding box, in the caller's frame.
    pub offset: Vec3,
    /// Caller's length of one unit; a power of two but within methods.
    pub scale: f64,
    /// The unit frame's axes: the caller's but within methods.
    #[serde(skip)]
    pub axes: Axes,
}

impl UnitFrame {
    /// The frame of a bounding box given in the caller's coordinates; `None`
    /// when the box is not finite or has no extent.
    pub fn of_box(lo: Vec3, hi: Vec3) -> Option<Self> {
        // Far from where a difference or a scale would overflow.
        let fits = |v: &Vec3| v.iter().all(|x| x.is_finite() && x.abs() < 1e300);
        if !(fits(&lo) && fits(&hi)) {
            return None;
        }
        let edge = (hi - lo).max();
        if !(edge.is_normal() && edge > 0.0) {
            return None;
        }
        // The power of two at or above the edge, from its bits: exact.
        let below = f64::from_bits(edge.to_bits() & 0x7ff0_0000_0000_0000);
        let scale = if below < edge { 2.0 * below } else { below };
        Some(UnitFrame { offset: lo, scale, axes: Axes::default() })
    }

    /// How far the caller's numbers may round a coordinate, as a share of the unit: far from the
    /// origin they have fewer digits left for the shape.
    pub fn noise(&self) -> f64 {
        0.5 * f64::EPSILON * (self.offset.amax() / self.scale + 1.0)
    }

    /// Caller's point to unit frame.
    pub fn to_unit(&self, p: &Vec3) -> Vec3 {
        self.axes.point(&((p - self.offset) / self.scale))
    }

    /// Unit-frame point to the caller's frame.
    pub fn to_input(&self, p: &Vec3) -> Vec3 {
        self.axes.point_back(p) * self.scale + self.offset
    }

    /// Unit-frame sphere to the caller's frame.
    pub fn sphere_to_input(&self, s: &Sphere) -> Sphere {
        Sphere::new(self.to_input(&s.center), s.radius * self.scale)
    }

    /// A direction of the unit frame in the caller's.
    pub fn direction_to_input(&self, v: &Vec3) -> Vec3 {
        self.axes.direction_back(v)
    }

    /// The caller's half-space normal · p ≤ offset in the unit frame.
    pub fn plane_to_unit(&self, normal: &Vec3, offset: f64) -> (Vec3, f64) {
        let turned = self.axes.direction(normal);
        let mut offset = (offset - normal.dot(&self.offset)) / self.scale;
        for (a, flipped) in self.axes.flipped.into_iter().enumerate() {
            if flipped {
                offset += turned[a] * self.axes.sum[self.axes.from[a]];
            }
        }
        (turned, offset)
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
            inertia: Inertia::from_matrix(&(self.axes.inertia_back(&m.inertia).matrix() * s5)),
            relative_error: m.relative_error,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Inertia;

    #[test]
    fn the_scale_is_the_power_of_two_at_or_above_the_edge() {
        for (edge, scale) in
            [(1.0, 1.0), (1.0000001, 2.0), (0.5, 0.5), (0.51, 1.0), (3.0, 4.0), (1e-3, 1.0 / 512.0)]
        {
            let f = UnitFrame::of_box(Vec3::zeros(), Vec3::new(0.1 * edge, edge, 0.0)).unwrap();
            assert_eq!(f.scale, scale);
        }
        for k in [-900, -40, 40, 900] {
            let hi = Vec3::new(3.0, 1.0, 2.0) * 2f64.powi(k);
            assert_eq!(UnitFrame::of_box(Vec3::zeros(), hi).unwrap().scale, 2f64.powi(k + 2));
        }
    }

    #[test]
    fn boxes_without_extent_or_beyond_numbers_have_no_frame() {
        for hi in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::MAX, f64::MIN_POSITIVE * 0.25] {
            assert!(UnitFrame::of_box(Vec3::zeros(), Vec3::repeat(hi)).is_none(), "{hi}");
        }
        assert!(UnitFrame::of_box(Vec3::repeat(-f64::MAX), Vec3::repeat(f64::MAX)).is_none());
    }

    #[test]
    fn noise_is_half_a_step_of_the_numbers() {
        let lo = Vec3::new(3.0, -3e8, 0.0);
        let f = UnitFrame::of_box(lo, lo + Vec3::repeat(4.0)).unwrap();
        let step = (3e8f64.next_up() - 3e8) / 4.0;
        assert!(f.noise() >= 0.5 * step && f.noise() <= 2.0 * step);
        assert!(UnitFrame::of_box(Vec3::zeros(), Vec3::x()).unwrap().noise() < 1e-15);
    }

    #[test]
    fn there_and_back() {
        let lo = Vec3::new(-3.0, 7.0, 1024.0);
        let f = UnitFrame::of_box(lo, lo + Vec3::new(5.0, 6.0, 7.0)).unwrap();
        let p = Vec3::new(-1.0, 9.5, 1025.0);
        assert_eq!(f.to_input(&f.to_unit(&p)), p);
        let s = Sphere::new(p, 0.75);
        assert_eq!(f.sphere_to_input(&f.sphere_to_unit(&s)), s);
        let m = Moments {
            volume: 1.0,
            centroid: Vec3::repeat(0.5),
            inertia: Inertia { xx: 1.0, ..Inertia::default() },
            relative_error: 0.25,
        };
        let m = f.moments_to_input(&m);
        assert_eq!((m.volume, m.inertia.xx, m.relative_error), (512.0, 32768.0, 0.25));
        assert_eq!(m.centroid, lo + Vec3::repeat(4.0));
    }
}
