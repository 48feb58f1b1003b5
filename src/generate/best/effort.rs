//! How much work goes into a clump, by counts: the result never depends on the clock.

/// How long a clump is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Effort {
    /// Seeds and a short refinement: some milliseconds.
    Draft,
    /// A full refinement, and spheres moved to where they help more: about a tenth of a second
    /// for a hundred spheres.
    #[default]
    Normal,
    /// Many more such moves: a few seconds.
    Thorough,
}

/// Of more spheres than this, fewer moves are tried, so that all of them take as long.
const MANY: usize = 50;
/// The same for the most thorough search.
const VERY_MANY: usize = 150;

/// The counts of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plan {
    /// Points to be covered and candidate balls of the greedy start.
    pub points: usize,
    pub candidates: usize,
    /// Directions and iterations of the first refinement.
    pub directions: usize,
    pub iterations: usize,
    /// Cells of the distance field along the longest edge, where the solid has more.
    pub cells: u32,
    /// Columns that meet the target.
    pub columns: usize,
    /// Starts, of which the best is searched on.
    pub starts: usize,
    /// Moves tried, and the most balls that one of them refines.
    pub moves: usize,
    pub around: usize,
    /// Directions and iterations of the last refinement.
    pub polish: [usize; 2],
}

impl Effort {
    /// The counts for `n` spheres.
    pub(super) fn plan(self, n: usize) -> Plan {
        let wide = |least: usize, each: usize| least.max(each.saturating_mul(n));
        let add = |base: usize, each: usize| base.saturating_add(each.saturating_mul(n));
        // Of many spheres a move costs more: each column holds more of them.
        let moves = |few: usize, many: usize| few.saturating_mul(many).div_ceil(n.max(many));
        // Of many spheres a start costs more, and where each came to matters less.
        let starts = |few: usize| (few * MANY / n.max(1)).clamp(1, few);
        match self {
            Effort::Draft => Plan {
                points: wide(1500, 24),
                candidates: wide(300, 5),
                directions: 48,
                iterations: 50,
                cells: (44.0 * (n as f64 / 50.0).cbrt()).clamp(44.0, 1e6) as u32,
                columns: add(600, 10),
                starts: 1,
                moves: 0,
                around: 0,
                polish: [0, 0],
            },
            Effort::Normal => Plan {
                points: wide(4000, 32),
                candidates: wide(800, 6),
                directions: 96,
                iterations: 100,
                cells: u32::MAX,
                columns: add(1500, 15),
                starts: starts(3),
                moves: moves(160, MANY),
                around: 8,
                polish: [192, 50],
            },
            Effort::Thorough => Plan {
                points: wide(6000, 32),
                candidates: wide(1500, 6),
                directions: 96,
                iterations: 100,
                cells: u32::MAX,
                columns: add(4000, 60),
                starts: starts(6),
                moves: moves(4000, VERY_MANY),
                around: 12,
                polish: [384, 60],
            },
        }
    }
}
