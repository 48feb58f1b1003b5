//! Contact averaging per pair of bodies (Höhner et al. 2011), in its incremental form.
//!
//! A clump on a wall touches with many spheres at once; their springs add up, so that the contact is stiffer and more damped
//! than asked, up to instability. Here the *increments* of the force, not the force, are divided by the number of contacts:
//! with S the sum of the elastic forces and n the contacts of a step, F += ΔS/n, and all that the contacts do is multiplied by F/S.
//! A contact comes and goes with no force of its own, so F stays continuous when n changes; a load that is taken back by the
//! way it came gives back what it took. F stays between S/(the greatest n so far) and S. A genuine support on
//! three points is softened to that of one: that is the price. And F depends on the way: contacts that part in another order than
//! they came in keep some of what was put in, or give more. To bend F/S down on the way out, so that a pair never gives more than it
//! took, was tried and taken back: bodies that shake while they lie on each other then sink in.
//!
//! As the spring of the pair grows by the mean of its contacts' springs, its dashpot is the mean of theirs: 1/n of their sum, not F/S,
//! which is more where contacts came one after the other and damps too much. Each dashpot is eased by (S/F)/n of the step before.

/// What a pair of bodies remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub(crate) struct Average {
    /// S of the last step.
    sum: f64,
    /// F of the last step.
    force: f64,
    /// The greatest number of contacts since the pair touched.
    most: u32,
    /// That of the last step.
    last: u32,
    /// What the springs would hold, each by itself, in the last step.
    alone: f64,
    /// The work that was put into what they do together.
    work: f64,
}

impl Average {
    /// Whether the pair touched in the last step.
    pub fn active(&self) -> bool {
        self.most > 0
    }

    /// What a dashpot is eased by, that F/S of it is the mean.
    #[inline]
    pub fn ease(&self) -> f64 {
        if self.force > 0.0 { self.sum / (self.force * f64::from(self.last)) } else { 1.0 }
    }

    /// What the pair's spring holds over what its springs would hold each by itself. The first is the work that was put
    /// into it: F depends on the way, not on the place alone.
    pub fn scale(&self) -> f64 {
        if self.alone > 0.0 { self.work / self.alone } else { self.part() }
    }

    /// F/S of the last step.
    pub fn part(&self) -> f64 {
        if self.sum > 0.0 { self.force / self.sum } else { 1.0 / f64::from(self.most.max(1)) }
    }

    /// F/S of a step with so many contacts (at least 1), this sum of elastic forces, and this of the energies that they
    /// hold each by itself.
    #[inline]
    pub fn share(&mut self, count: u32, sum: f64, alone: f64) -> f64 {
        let before = self.active().then(|| self.part());
        self.most = self.most.max(count);
        let force = self.force + (sum - self.sum) / f64::from(count);
        self.force = force.clamp(sum.max(0.0) / f64::from(self.most), sum.max(0.0));
        (self.sum, self.last) = (sum, count);
        // ∫ (F/S) dE: what is done to each spring is done F/S times.
        let part = self.part();
        self.work += 0.5 * (part + before.unwrap_or(part)) * (alone - self.alone);
        self.alone = alone;
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::effects::damping::ratio;

    /// The rebound of a mass of 1 on springs of 1 that it meets one after the other.
    fn rebound(springs: u32, eased: bool) -> f64 {
        let (mut z, mut v, dt) = (0.0, -1.0, 1e-4);
        let mut average = Average::default();
        loop {
            z += v * dt;
            // The last is met half way.
            let deep = |i: u32| -z - 0.5 * f64::from(i) / f64::from(springs);
            let touching: Vec<f64> = (0..springs).map(deep).filter(|d| *d > 0.0).collect();
            let Some(_) = touching.first() else { return v };
            let damper = 2.0 * ratio(0.6) * if eased { average.ease() } else { 1.0 };
            let sum: f64 = touching.iter().sum();
            let force: f64 = touching.iter().map(|d| (d - damper * v).max(0.0)).sum();
            v += average.share(touching.len() as u32, sum, 0.0) * force * dt;
        }
    }

    #[test]
    fn springs_met_one_after_the_other_rebound_as_one_does() {
        for n in [1, 2, 5, 20] {
            let e = rebound(n, true);
            assert!((e - 0.6).abs() < 0.03, "{n}: {e}");
        }
        assert!(rebound(20, false) < 0.54);
    }
}
