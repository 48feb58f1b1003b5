//! Random numbers that depend on nothing but what they are asked for (Steele, Lea and Flood 2014).

use crate::math::Vec3;
use std::f64::consts::TAU;

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub(crate) struct Random(u64);

impl Random {
    /// The stream of some numbers.
    pub fn of(numbers: &[u64]) -> Random {
        let mut r = Random(0x5851_f42d_4c95_7f2d);
        for n in numbers {
            r.0 = r.next() ^ n;
        }
        r
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 up to 1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n.saturating_sub(1))
    }

    /// Any rotation, `w, x, y, z`, each as likely (Shoemake 1992).
    pub fn rotation(&mut self) -> [f64; 4] {
        let (u, a, b) = (self.unit(), TAU * self.unit(), TAU * self.unit());
        let (s, t) = ((1.0 - u).sqrt(), u.sqrt());
        [s * a.sin(), s * a.cos(), t * b.sin(), t * b.cos()]
    }

    /// In a box.
    pub fn within(&mut self, lo: &Vec3, hi: &Vec3) -> Vec3 {
        let mut at = || self.unit();
        let u = Vec3::new(at(), at(), at());
        lo + (hi - lo).component_mul(&u)
    }
}
