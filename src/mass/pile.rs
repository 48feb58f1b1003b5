//! Spheres in an order of their own, so that results do not depend on the caller's, and their
//! neighbours.

use crate::error::{Error, Result, collected};
use crate::math::Sphere;

/// Spheres by rising x (then y, z, radius).
pub(super) struct Pile {
    /// The spheres, sorted.
    pub spheres: Vec<Sphere>,
    /// Where each stood before.
    pub order: Vec<u32>,
    /// Greatest radius.
    largest: f64,
}

impl Pile {
    /// Sorts `spheres`, which are finite.
    pub(super) fn new(spheres: &[Sphere]) -> Result<Pile> {
        let mut order = collected("spheres", 0..spheres.len() as u32)?;
        let key = |i: u32| {
            let s = &spheres[i as usize];
            [s.center.x, s.center.y, s.center.z, s.radius]
        };
        order.sort_by(|&i, &j| {
            let (a, b) = (key(i), key(j));
            (0..4).fold(std::cmp::Ordering::Equal, |o, k| o.then(a[k].total_cmp(&b[k])))
        });
        let spheres = collected("spheres", order.iter().map(|&i| spheres[i as usize]))?;
        let largest = spheres.iter().map(|s| s.radius).fold(0.0, f64::max);
        Ok(Pile { spheres, order, largest })
    }

    /// Calls `f` with each sphere that shares some volume with sphere `i`.
    pub(super) fn neighbours(&self, i: usize, mut f: impl FnMut(usize, &Sphere)) {
        let s = &self.spheres[i];
        let reach = s.radius + self.largest;
        let from = self.spheres.partition_point(|o| o.center.x < s.center.x - reach);
        for (j, o) in self.spheres.iter().enumerate().skip(from) {
            if o.center.x > s.center.x + reach {
                break;
            }
            let touch = s.radius + o.radius;
            if j != i && (o.center - s.center).norm_squared() < touch * touch {
                f(j, o);
            }
        }
    }
}

/// Refuses an empty list, and spheres that are not finite or have no radius.
pub(crate) fn check(spheres: &[Sphere]) -> Result<()> {
    if spheres.is_empty() {
        return Err(Error::Empty("the clump has no sphere".into()));
    }
    if spheres.len() > u32::MAX as usize {
        return Err(Error::TooLarge(format!("{} spheres are too many", spheres.len())));
    }
    for (i, s) in spheres.iter().enumerate() {
        let c = &s.center;
        if !(c.iter().all(|x| x.is_finite()) && s.radius.is_finite()) {
            return Err(Error::NotFinite(format!(
                "sphere {i} has centre ({}, {}, {}) and radius {}",
                c.x, c.y, c.z, s.radius
            )));
        }
        if s.radius <= 0.0 {
            return Err(Error::InvalidArgument(format!(
                "sphere {i} has radius {}, not above 0",
                s.radius
            )));
        }
    }
    Ok(())
}
