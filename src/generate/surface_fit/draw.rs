//! Random numbers by counter: what is drawn depends on seed, stream and place alone, never on
//! who drew before.

/// Numbers of one place of one stream.
#[derive(Debug, Clone)]
pub(super) struct Draw {
    key: u64,
    count: u64,
}

const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014).
fn mix(x: u64) -> u64 {
    let x = (x ^ x >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ x >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ x >> 31
}

impl Draw {
    /// The numbers of `place` in `stream`.
    pub fn new(seed: u64, stream: u64, place: u64) -> Draw {
        let key = mix(mix(seed.wrapping_add(STEP)) ^ stream.wrapping_mul(STEP));
        Draw { key: mix(key.wrapping_add(place.wrapping_mul(STEP))), count: 0 }
    }

    fn next(&mut self) -> u64 {
        self.count = self.count.wrapping_add(STEP);
        mix(self.key.wrapping_add(self.count))
    }

    /// From 0 to 1, without 1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// One of `n` numbers from 0; 0 when `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n.saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_even_and_depend_on_seed_stream_and_place() {
        let mut counts = [0; 8];
        let mut draw = Draw::new(1, 2, 3);
        for _ in 0..8000 {
            counts[draw.below(8)] += 1;
        }
        assert!(counts.iter().all(|c| (880..1120).contains(c)), "{counts:?}");
        let first = |s, t, p| Draw::new(s, t, p).next();
        let all = [first(0, 0, 0), first(1, 0, 0), first(0, 1, 0), first(0, 0, 1), first(1, 1, 1)];
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a != b));
        }
        assert_eq!(first(7, 8, 9), first(7, 8, 9));
        assert_eq!(draw.below(0), 0);
    }
}
