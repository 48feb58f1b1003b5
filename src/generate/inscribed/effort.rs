//! How much work goes into an inscribed clump, by counts.

use crate::generate::Effort;

/// The counts of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plan {
    /// Points to be covered and candidate balls of the greedy start.
    pub points: usize,
    pub candidates: usize,
    /// Columns that meet the target.
    pub columns: usize,
    /// Sweeps of the climb.
    pub sweeps: usize,
    /// Swaps tried.
    pub swaps: usize,
}

/// The counts for `n` spheres.
pub(super) fn plan(effort: Effort, n: usize) -> Plan {
    let wide = |least: usize, each: usize| least.max(each.saturating_mul(n));
    match effort {
        Effort::Draft => Plan {
            points: wide(4000, 64),
            candidates: wide(1000, 12),
            columns: 2700,
            sweeps: 8,
            swaps: 0,
        },
        Effort::Normal => Plan {
            points: wide(16_000, 64),
            candidates: wide(4000, 24),
            columns: 6000,
            sweeps: 25,
            swaps: 0,
        },
        Effort::Thorough => Plan {
            points: wide(16_000, 64),
            candidates: wide(16_000, 24),
            columns: 10_600,
            sweeps: 40,
            swaps: 4 * n,
        },
    }
}
