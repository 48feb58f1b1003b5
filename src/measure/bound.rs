//! The greatest value of a distance over a surface cut into pieces: best-first
//! branch and bound, so that no maximum is missed.

use crate::error::Result;
use crate::run::Run;
use std::collections::BinaryHeap;

/// Pieces that one thread looks at together: fixed, so that the result does not depend on the
/// threads.
const BATCH: usize = 64;

/// What is known of a piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Range {
    /// A value that the piece attains; less than zero: none.
    pub attained: f64,
    /// No point of the piece exceeds this.
    pub bound: f64,
}

/// The result.
#[derive(Debug, Clone, Copy)]
pub(super) struct Greatest {
    /// The greatest value attained.
    pub value: f64,
    /// How far the true greatest value may lie above.
    pub slack: f64,
    /// Pieces looked at.
    pub looked_at: u64,
}

struct Entry<T> {
    bound: f64,
    /// Earlier pieces first among equals.
    order: u64,
    piece: T,
}

impl<T> PartialEq for Entry<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl<T> Eq for Entry<T> {}
impl<T> PartialOrd for Entry<T> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl<T> Ord for Entry<T> {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.bound.total_cmp(&other.bound).then(other.order.cmp(&self.order))
    }
}

/// How near the greatest value is to be found.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aim {
    /// Within the greater of a length and a share of the value, …
    pub length: f64,
    pub share: f64,
    /// … or as near as this many pieces allow, …
    pub most: u64,
    /// … which go on, up to [`MORE`] times as many, while it is not known to within this length.
    pub coarse: f64,
}

/// See [`Aim`].
const MORE: u64 = 16;

/// The greatest value over `roots`, at least `start` (a value already attained). `split` appends
/// the parts of a piece.
pub(super) fn greatest<T: Copy + Send + Sync>(
    roots: Vec<T>,
    start: f64,
    aim: Aim,
    run: &Run,
    look: impl Fn(&T) -> Range + Sync + Send,
    split: impl Fn(&T, &mut Vec<T>),
) -> Result<Greatest> {
    let mut value = start;
    let mut heap: BinaryHeap<Entry<T>> = BinaryHeap::new();
    let mut order = 0u64;
    let mut pieces = roots;
    let fine = aim.most + pieces.len() as u64;
    let allowed = MORE * aim.most + pieces.len() as u64;
    loop {
        let chunks = pieces.len().div_ceil(BATCH);
        let ranges = run
            .pool()
            .map(chunks, |c| {
                let part = &pieces[c * BATCH..((c + 1) * BATCH).min(pieces.len())];
                part.iter().map(&look).collect::<Vec<_>>()
            })
            .concat();
        value = ranges.iter().map(|r| r.attained).fold(value, f64::max);
        let slack = aim.length.max(aim.share * value);
        for (&piece, range) in pieces.iter().zip(&ranges) {
            order += 1;
            if range.bound > value + slack {
                heap.push(Entry { bound: range.bound, order, piece });
            }
        }
        // The greatest bound that is still open.
        let top = heap.peek().map_or(value, |e| e.bound);
        pieces.clear();
        while pieces.len() < 4 * BATCH
            && let Some(e) = heap.pop()
            && e.bound > value + slack
        {
            split(&e.piece, &mut pieces);
        }
        run.check(0.0, "measuring the surface")?;
        let after = order + pieces.len() as u64;
        let enough = after > allowed || after > fine && top - value <= aim.coarse;
        if pieces.is_empty() || enough {
            let slack = if pieces.is_empty() { slack } else { slack.max(top - value) };
            return Ok(Greatest { value, slack, looked_at: order });
        }
    }
}
