//! Greedy choice by lazy evaluation (Minoux 1978): a gain only falls while others are chosen, so
//! one that was counted earlier is a bound, and few are counted again.

use crate::error::{Result, filled, reserve};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Candidates and the bounds of their gains.
pub(super) struct Lazy {
    heap: BinaryHeap<(u64, Reverse<u32>)>,
    /// The choice for which each gain was counted last.
    counted: Vec<u32>,
    choice: u32,
}

impl Lazy {
    /// Of candidates none of which gains more than its bound.
    pub(super) fn new(bounds: &[u64]) -> Result<Lazy> {
        Lazy::of(bounds.iter().copied(), bounds.len(), 0)
    }

    /// Of `count` candidates whose gains for the first choice are known.
    pub(super) fn counted(gains: impl Iterator<Item = u64>, count: usize) -> Result<Lazy> {
        Lazy::of(gains, count, 1)
    }

    fn of(bounds: impl Iterator<Item = u64>, count: usize, choice: u32) -> Result<Lazy> {
        let mut heap = reserve("the order of candidates", count)?;
        heap.extend(bounds.take(count).zip(0u32..).map(|(bound, i)| (bound, Reverse(i))));
        let counted = filled("the order of candidates", count, choice)?;
        Ok(Lazy { heap: BinaryHeap::from(heap), counted, choice: 0 })
    }

    /// Takes out the candidate that gains most, of equal ones the first, and says what it gains;
    /// none if none gains.
    pub(super) fn best(&mut self, mut gain: impl FnMut(usize) -> u64) -> Option<(usize, u64)> {
        self.choice += 1;
        while let Some((bound, Reverse(i))) = self.heap.pop() {
            if bound == 0 {
                return None;
            }
            let counted = self.counted.get_mut(i as usize)?;
            if *counted == self.choice {
                return Some((i as usize, bound));
            }
            *counted = self.choice;
            self.heap.push((gain(i as usize), Reverse(i)));
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Candidate i holds the numbers of its list; a gain is how many of them are left.
    #[test]
    fn lazy_is_naive_and_counts_less() {
        let mut state = 1u64;
        let mut next = |n: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) % n
        };
        let lists: Vec<Vec<usize>> =
            (0..300).map(|_| (0..1 + next(12)).map(|_| next(400) as usize).collect()).collect();
        let gain = |list: &[usize], left: &[bool]| {
            let mut seen = Vec::new();
            for &n in list {
                if left[n] && !seen.contains(&n) {
                    seen.push(n);
                }
            }
            seen.len() as u64
        };
        let bounds: Vec<u64> = lists.iter().map(|l| l.len() as u64).collect();
        let mut lazy = Lazy::new(&bounds).unwrap();
        let (mut left, mut counts) = (vec![true; 400], 0);
        let mut chosen = Vec::new();
        while let Some((i, most)) = lazy.best(|i| {
            counts += 1;
            gain(&lists[i], &left)
        }) {
            assert_eq!(most, gain(&lists[i], &left));
            lists[i].iter().for_each(|&n| left[n] = false);
            chosen.push(i);
        }
        let (mut left, mut naive) = (vec![true; 400], Vec::new());
        loop {
            let all = lists.iter().map(|l| gain(l, &left)).enumerate();
            let Some((i, 1..)) = all.max_by_key(|&(i, g)| (g, Reverse(i))) else { break };
            lists[i].iter().for_each(|&n| left[n] = false);
            naive.push(i);
        }
        assert_eq!(chosen, naive);
        assert!(chosen.len() > 50 && counts < 300 * chosen.len() / 10, "{counts}");
    }
}
