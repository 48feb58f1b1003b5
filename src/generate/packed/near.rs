//! Which balls are close: places sorted into cells.

use crate::error::{Result, filled};
use crate::math::Vec3;

/// Places in cells of an edge that is at least the distance asked for.
#[derive(Default)]
pub(super) struct Near {
    lo: Vec3,
    edge: f64,
    dims: [usize; 3],
    /// Where the places of each cell begin, one more than there are cells.
    begins: Vec<u32>,
    /// Numbers of places, cell by cell, rising in each.
    places: Vec<u32>,
}

impl Near {
    /// For searches within `reach`, which is above 0.
    pub fn sort(&mut self, points: &[Vec3], reach: f64) -> Result<()> {
        let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
        for p in points {
            (lo, hi) = (lo.inf(p), hi.sup(p));
        }
        let most = 2 * points.len() + 64;
        self.lo = lo;
        self.edge = reach;
        loop {
            self.dims =
                [0, 1, 2].map(|a| ((hi[a] - lo[a]) / self.edge).clamp(0.0, 1e6) as usize + 1);
            let cells = self.dims.iter().fold(1.0, |n, d| n * *d as f64);
            if cells <= most as f64 {
                break;
            }
            self.edge *= 1.3;
        }
        let cells: usize = self.dims.iter().product();
        if self.begins.len() < cells + 1 {
            self.begins = filled("the cells of balls", most + 1, 0)?;
        }
        if self.places.len() != points.len() {
            self.places = filled("the cells of balls", points.len(), 0)?;
        }
        self.begins.fill(0);
        for p in points {
            let cell = self.index(self.cell(p));
            self.begins[cell + 1] += 1;
        }
        for i in 0..cells {
            self.begins[i + 1] += self.begins[i];
        }
        for (i, p) in points.iter().enumerate().rev() {
            // From the last to the first, each to the end of what is left of its cell.
            let cell = self.index(self.cell(p));
            self.begins[cell + 1] -= 1;
            self.places[self.begins[cell + 1] as usize] = i as u32;
        }
        // Every end has become its cell's begin: move them back by one.
        for i in 0..cells {
            self.begins[i] = self.begins[i + 1];
        }
        self.begins[cells] = points.len() as u32;
        Ok(())
    }

    fn cell(&self, p: &Vec3) -> [usize; 3] {
        [0, 1, 2]
            .map(|a| (((p[a] - self.lo[a]) / self.edge).max(0.0) as usize).min(self.dims[a] - 1))
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.dims[0] * (j + self.dims[1] * k)
    }

    /// Calls `f` for the number of each place that may lie within reach of `p`.
    pub fn around(&self, p: &Vec3, mut f: impl FnMut(usize)) {
        let at = self.cell(p);
        let range = |a: usize| at[a].saturating_sub(1)..=(at[a] + 1).min(self.dims[a] - 1);
        for k in range(2) {
            for j in range(1) {
                let row = range(0);
                let first = self.begins[self.index([*row.start(), j, k])];
                let end = self.begins[self.index([*row.end(), j, k]) + 1];
                for &place in &self.places[first as usize..end as usize] {
                    f(place as usize);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_places_within_reach_are_found_once() {
        let mut near = Near::default();
        for (n, reach) in [(1, 0.1), (40, 0.3), (300, 0.05), (200, 1e-6), (200, 9.0)] {
            let points: Vec<Vec3> = (0..n)
                .map(|i| {
                    let t = i as f64;
                    Vec3::new((t * 0.754).fract(), 2.0 * (t * 0.569).fract(), (t * 0.321).fract())
                })
                .collect();
            near.sort(&points, reach).unwrap();
            for p in &points {
                let mut found = Vec::new();
                near.around(p, |i| found.push(i));
                let all = found.len();
                found.sort_unstable();
                found.dedup();
                assert_eq!(found.len(), all);
                let close = (0..n).filter(|&i| (points[i] - p).norm() <= reach);
                assert!(close.into_iter().all(|i| found.contains(&i)));
            }
        }
    }
}
