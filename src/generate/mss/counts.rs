//! The mismatch as counts of cells.

/// Cell counts of the clump and the target.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::generate) struct Counts {
    pub target: u64,
    pub inside: u64,
    pub outside: u64,
}

impl Counts {
    /// D of equation 27.
    pub fn mismatch(&self) -> f64 {
        1.0 - 2.0 * self.inside as f64 / (self.target + self.inside + self.outside) as f64
    }

    /// How much D falls with a gain, in cells: the new inside ones less what the outside ones
    /// cost, the more the lower D is.
    pub fn score(&self, gain: (f64, f64)) -> f64 {
        let d = self.mismatch();
        gain.0 - gain.1 * (1.0 - d) / (1.0 + d)
    }

    /// The counts after a gain.
    pub fn with(&self, gain: (u64, u64)) -> Counts {
        Counts { inside: self.inside + gain.0, outside: self.outside + gain.1, ..*self }
    }
}
