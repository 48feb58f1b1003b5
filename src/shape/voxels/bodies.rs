//! Face-connected bodies, by union–find over the runs of solid cells along x:
//! linear in the cells, with memory by runs instead of cells.

use crate::error::{self, Error, Result};
use std::ops::Range;

/// A run of solid cells in one row: first and one past the last.
#[derive(Clone, Copy)]
struct Span {
    start: u32,
    end: u32,
}

/// The face-connected components of a mask.
pub(super) struct Components {
    spans: Vec<Span>,
    /// For each row (j + ny k), its first span; one more at the end.
    rows: Vec<u32>,
    /// For each span, its component, numbered in order of first appearance.
    component: Vec<u32>,
    /// Cells of each component.
    sizes: Vec<u64>,
    nx: usize,
}

impl Components {
    /// Finds them. `allow` is asked, with the bytes, before memory is taken.
    pub fn of(
        cells: &[u8],
        dims: [usize; 3],
        allow: impl Fn(u64) -> Result<()>,
    ) -> Result<Components> {
        let (nx, ny) = (dims[0].max(1), dims[1].max(1));
        let count: usize = cells.chunks(nx).map(|row| spans_of(row).count()).sum();
        if u32::try_from(count).is_err() {
            return Err(Error::TooLarge(format!("{count} runs of solid cells are too many")));
        }
        let row_count = cells.len() / nx;
        // Span, parent that becomes component, and at most one size for each.
        allow(20 * count as u64 + 4 * row_count as u64)?;
        let mut spans = error::reserve("runs of solid cells", count)?;
        let mut rows = error::reserve("rows of solid cells", row_count + 1)?;
        for row in cells.chunks(nx) {
            rows.push(spans.len() as u32);
            spans.extend(spans_of(row));
        }
        rows.push(spans.len() as u32);

        let mut sets = Sets(error::reserve("bodies", count)?);
        sets.0.extend(0..count as u32);
        let mut all = Components { spans, rows, component: Vec::new(), sizes: Vec::new(), nx };
        for row in 0..row_count {
            if row % ny != 0 {
                all.join_rows(row - 1, row, &mut sets);
            }
            if row >= ny {
                all.join_rows(row - ny, row, &mut sets);
            }
        }
        all.number(sets)?;
        Ok(all)
    }

    fn spans_in(&self, row: usize) -> Range<usize> {
        self.rows[row] as usize..self.rows[row + 1] as usize
    }

    /// Joins the spans of two rows that share a cell's place.
    fn join_rows(&self, a: usize, b: usize, sets: &mut Sets) {
        let (a, b) = (self.spans_in(a), self.spans_in(b));
        let (mut i, mut j) = (a.start, b.start);
        while i < a.end && j < b.end {
            let (s, t) = (self.spans[i], self.spans[j]);
            if s.start < t.end && t.start < s.end {
                sets.join(i as u32, j as u32);
            }
            if s.end <= t.end {
                i += 1;
            } else {
                j += 1;
            }
        }
    }

    /// Turns roots into numbers 0, 1, 2 … in order of first appearance. A root
    /// is the smallest of its set, so it is numbered before the others ask.
    fn number(&mut self, mut sets: Sets) -> Result<()> {
        let roots = (0..sets.0.len()).filter(|&i| sets.0[i] as usize == i).count();
        self.sizes = error::reserve("sizes of bodies", roots)?;
        for i in 0..sets.0.len() {
            let parent = sets.0[i] as usize;
            // Parents point to smaller spans, whose entry is a number by now.
            let number = if parent == i {
                self.sizes.push(0);
                self.sizes.len() as u32 - 1
            } else {
                sets.0[parent]
            };
            sets.0[i] = number;
            self.sizes[number as usize] += u64::from(self.spans[i].end - self.spans[i].start);
        }
        self.component = sets.0;
        Ok(())
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.sizes.len()
    }

    /// Cells of each.
    pub fn sizes(&self) -> &[u64] {
        &self.sizes
    }

    /// The one with most cells (the first of equal ones), and its cells.
    pub fn largest(&self) -> (u32, u64) {
        let mut best = (0, 0);
        for (i, &n) in self.sizes.iter().enumerate() {
            if n > best.1 {
                best = (i as u32, n);
            }
        }
        best
    }

    /// Empties the cells of all components but `keep`.
    pub fn keep(&self, keep: u32, cells: &mut [u8]) {
        for (r, row) in cells.chunks_mut(self.nx).enumerate() {
            for s in self.spans_in(r) {
                if self.component[s] != keep {
                    row[self.spans[s].start as usize..self.spans[s].end as usize].fill(0);
                }
            }
        }
    }
}

/// Disjoint sets whose roots are their smallest members.
struct Sets(Vec<u32>);

impl Sets {
    fn root(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            // Path halving.
            let above = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = above;
            i = above;
        }
        i
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

fn spans_of(row: &[u8]) -> impl Iterator<Item = Span> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = at + row[at..].iter().position(|&c| c != 0)?;
        let end = row[start..].iter().position(|&c| c == 0).map_or(row.len(), |n| start + n);
        at = end;
        Some(Span { start: start as u32, end: end as u32 })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Each component by a flood from its first cell, in order of appearance.
    fn flood(cells: &[u8], dims: [usize; 3]) -> Vec<Vec<usize>> {
        let [nx, ny, nz] = dims;
        let mut seen = vec![false; cells.len()];
        let mut all = Vec::new();
        for first in 0..cells.len() {
            if cells[first] == 0 || seen[first] {
                continue;
            }
            let (mut stack, mut body) = (vec![first], Vec::new());
            seen[first] = true;
            while let Some(c) = stack.pop() {
                body.push(c);
                let (i, j, k) = (c % nx, c / nx % ny, c / (nx * ny));
                let mut go = |inside: bool, to: usize| {
                    if inside && cells[to] != 0 && !seen[to] {
                        seen[to] = true;
                        stack.push(to);
                    }
                };
                go(i > 0, c.wrapping_sub(1));
                go(i + 1 < nx, c + 1);
                go(j > 0, c.wrapping_sub(nx));
                go(j + 1 < ny, c + nx);
                go(k > 0, c.wrapping_sub(nx * ny));
                go(k + 1 < nz, c + nx * ny);
            }
            body.sort();
            all.push(body);
        }
        all
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]
        #[test]
        fn bodies_are_those_of_a_flood(
            dims in [1usize..9, 1usize..7, 1usize..6],
            seed in proptest::collection::vec(0u8..100, 9 * 7 * 6),
            density in 5u8..80,
        ) {
            let cells: Vec<u8> = seed[..dims.iter().product()]
                .iter().map(|&v| u8::from(v < density)).collect();
            let found = Components::of(&cells, dims, |_| Ok(())).unwrap();
            let expected = flood(&cells, dims);
            let sizes: Vec<u64> = expected.iter().map(|b| b.len() as u64).collect();
            prop_assert_eq!(found.sizes(), &sizes[..]);
            for (number, body) in expected.iter().enumerate() {
                let mut kept = cells.clone();
                found.keep(number as u32, &mut kept);
                let left: Vec<usize> = (0..kept.len()).filter(|&i| kept[i] != 0).collect();
                prop_assert_eq!(&left, body);
            }
        }
    }
}
