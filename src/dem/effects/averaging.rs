//! Contact averaging per pair of bodies (Höhner et al. 2011), in its incremental form.
//!
//! A clump on a wall touches with many spheres at once; their springs add up, so that the contact is stiffer and more damped
//! than asked, up to instability. Here the *increments* of the force, not the force, are divided by the number of contacts:
//! with S the sum of the elastic forces and n the contacts of a step, F += ΔS/n, and all that the contacts do is multiplied by F/S.
//! A contact comes and goes with no force of its own, so F stays continuous when n changes; a load that is taken back by the
//! way it came gives back what it took. F stays between S/(the greatest n so far) and S. A genuine support on
//! three points is softened to that of one: that is the price.

/// What a pair of bodies remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub(crate) struct Average {
    /// S of the last step.
    sum: f64,
    /// F of the last step.
    force: f64,
    /// The greatest number of contacts since the pair touched.
    most: u32,
}

impl Average {
    /// Whether the pair touched in the last step.
    pub fn active(&self) -> bool {
        self.most > 0
    }

    /// F/S of a step with so many contacts (at least 1) and this sum of elastic forces.
    #[inline]
    pub fn share(&mut self, count: u32, sum: f64) -> f64 {
        self.most = self.most.max(count);
        let force = self.force + (sum - self.sum) / f64::from(count);
        self.force = force.clamp(sum.max(0.0) / f64::from(self.most), sum.max(0.0));
        self.sum = sum;
        if sum > 0.0 { self.force / sum } else { 1.0 / f64::from(self.most) }
    }
}
