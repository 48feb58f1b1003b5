//! Random numbers: one stream for each seed and purpose, the same on every machine.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub(crate) struct Random(Pcg64);

impl Random {
    /// The stream `stream` of `seed`: streams of one seed have nothing in common.
    pub(crate) fn new(seed: u64, stream: u64) -> Random {
        let (low, high) = (mix(seed ^ mix(stream)), mix(stream ^ mix(!seed)));
        Random(Pcg64::new(u128::from(low) | u128::from(high) << 64, u128::from(stream)))
    }

    /// From 0 to 1, without 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Between two numbers.
    pub(crate) fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// One of `n` numbers from 0; `n` is at least 1.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n.saturating_sub(1))
    }

    /// A rotation, uniform over all of them, by rows (Shoemake 1992, with points of the disc by
    /// rejection, so that only correctly rounded functions are used).
    pub(crate) fn rotation(&mut self) -> [[f32; 3]; 3] {
        let mut disc = || loop {
            let (x, y) = (self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            let s = x * x + y * y;
            if s < 1.0 && s > 1e-6 {
                break (x, y, s);
            }
        };
        // Marsaglia 1972: two points of the disc make a point of the sphere in four dimensions.
        let ((a, b, s), (c, d, t)) = (disc(), disc());
        let k = ((1.0 - s) / t).sqrt();
        let (x, y, z, w) = (a, b, c * k, d * k);
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
            [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
            [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
        ]
        .map(|row| row.map(|v| v as f32))
    }
}

/// Every bit of the result depends on every bit of `x` (Steele, Lea and Flood 2014).
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_are_rotations_without_a_preferred_way() {
        let mut random = Random::new(3, 4);
        let mut mean = [[0.0f64; 3]; 3];
        for _ in 0..4000 {
            let m = random.rotation().map(|r| r.map(f64::from));
            let dot = |a: usize, b: usize| (0..3).map(|k| m[a][k] * m[b][k]).sum::<f64>();
            for a in 0..3 {
                for b in 0..3 {
                    assert!((dot(a, b) - f64::from(u8::from(a == b))).abs() < 1e-6);
                    mean[a][b] += m[a][b] / 4000.0;
                }
            }
            let cross = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
                - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
                + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
            assert!((cross - 1.0).abs() < 1e-6);
        }
        assert!(mean.iter().flatten().all(|m| m.abs() < 0.04), "{mean:?}");
    }
}
