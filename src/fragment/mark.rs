//! Which of several components of one cell a point belongs to: a bit a cell over the piece's box.
//!
//! A bit is set where no other component reaches into the cell. So a point of the parent within
//! the planes that lies in such a cell is of this piece, and cells in doubt, where two components
//! come nearer than a cell, count as not held: what needs more looks at a whole ball, which is of
//! the piece when it meets one cell that is set.

use super::mark_bits;
use crate::error::{Result, filled, push};
use crate::math::Vec3;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Most cells: 32 KiB of bits.
const CELLS: f64 = 262_144.0;
/// Most borders between cells that are set and others, along x: with two bits for each, which are
/// seldom needed, 2.5 KiB.
const BORDERS: u32 = 10_000;
/// A mark of fewer cells than this has as many borders as it has.
const COARSEST: f64 = 8192.0;
/// Bytes that making one takes: what is known of the cells, and those still to be visited.
pub(super) const MAKING: u64 = 2 * CELLS as u64;
/// Cells along the longest edge, at most.
const LONGEST: f64 = 512.0;

/// The mark of one component.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    lo: Vec3,
    step: f64,
    dims: [usize; 3],
    bits: Vec<u64>,
}

/// The same as it is handed on.
#[derive(Serialize, Deserialize)]
struct Packed {
    lo: Vec3,
    step: f64,
    dims: [u32; 3],
    bytes: Vec<u8>,
}

impl Serialize for Mark {
    fn serialize<S: Serializer>(&self, to: S) -> std::result::Result<S::Ok, S::Error> {
        let bytes = mark_bits::pack(&self.bits, self.dims).map_err(serde::ser::Error::custom)?;
        let dims = self.dims.map(|n| n as u32);
        Packed { lo: self.lo, step: self.step, dims, bytes }.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Mark {
    fn deserialize<D: Deserializer<'de>>(from: D) -> std::result::Result<Mark, D::Error> {
        let Packed { lo, step, dims, bytes } = Packed::deserialize(from)?;
        let cells: u64 = dims.iter().map(|&n| u64::from(n)).fold(1, u64::saturating_mul);
        if cells == 0 || cells > CELLS as u64 || dims.iter().any(|&n| f64::from(n) > LONGEST) {
            return Err(D::Error::custom(format!("a mark of {cells} cells is none")));
        }
        let dims = dims.map(|n| n as usize);
        let bits = mark_bits::unpack(&bytes, dims).map_err(D::Error::custom)?;
        Ok(Mark { lo, step, dims, bits })
    }
}

/// What is known of the cells while a mark is made.
const FREE: u8 = 0;
const OTHER: u8 = 1;
const OWN: u8 = 2;

impl Mark {
    /// Of the component with the box `lo`, `hi`, whose surface and that of all others, closed
    /// triangle by triangle, are given.
    pub(super) fn of_triangles(
        lo: &Vec3,
        hi: &Vec3,
        own: impl Iterator<Item = [Vec3; 3]> + Clone,
        others: impl Iterator<Item = [Vec3; 3]> + Clone,
    ) -> Result<Mark> {
        Mark::plain(lo, hi, |mark| mark.with_triangles(own.clone(), others.clone()))
    }

    fn with_triangles(
        mut self,
        own: impl Iterator<Item = [Vec3; 3]>,
        others: impl Iterator<Item = [Vec3; 3]>,
    ) -> Result<Mark> {
        let mark = &mut self;
        let mut cells = filled("cells of a mark", mark.len(), FREE)?;
        for t in others {
            mark.paint(&t, &mut cells, OTHER);
        }
        let mut next: Vec<[usize; 3]> = Vec::new();
        for t in own {
            mark.paint(&t, &mut cells, OWN);
        }
        // From the own surface to all that is reached without a step over the others': nothing of
        // them is there. Cells with some of both stay in doubt.
        for (i, cell) in cells.iter().enumerate() {
            if *cell == OWN {
                push("cells of a mark", &mut next, mark.place(i))?;
            }
        }
        while let Some(at) = next.pop() {
            for axis in 0..3 {
                for up in [false, true] {
                    let mut to = at;
                    to[axis] = if up { at[axis] + 1 } else { at[axis].wrapping_sub(1) };
                    if to[axis] >= mark.dims[axis] {
                        continue;
                    }
                    let i = mark.index(to);
                    if let Some(cell) = cells.get_mut(i).filter(|c| **c == FREE) {
                        *cell = OWN;
                        push("cells of a mark", &mut next, to)?;
                    }
                }
            }
        }
        for (i, _) in cells.iter().enumerate().filter(|(_, c)| **c == OWN) {
            mark.set(i);
        }
        Ok(self)
    }

    /// Of the component with the box `lo`, `hi`, where all others lie within the given boxes.
    pub(super) fn of_boxes(
        lo: &Vec3,
        hi: &Vec3,
        others: impl Iterator<Item = [Vec3; 2]> + Clone,
    ) -> Result<Mark> {
        Mark::plain(lo, hi, |mark| mark.with_boxes(others.clone()))
    }

    fn with_boxes(mut self, others: impl Iterator<Item = [Vec3; 2]>) -> Result<Mark> {
        let mark = &mut self;
        let mut cells = filled("cells of a mark", mark.len(), FREE)?;
        for [lo, hi] in others {
            mark.each(&lo, &hi, |i, _| {
                if let Some(cell) = cells.get_mut(i) {
                    *cell = OTHER;
                }
            });
        }
        for (i, _) in cells.iter().enumerate().filter(|(_, c)| **c == FREE) {
            mark.set(i);
        }
        Ok(self)
    }

    /// A mark of fewer cells where there would be too many borders for what is handed on.
    fn plain(lo: &Vec3, hi: &Vec3, make: impl Fn(Mark) -> Result<Mark>) -> Result<Mark> {
        let mut most = CELLS;
        loop {
            let mark = make(Mark::over(lo, hi, most)?)?;
            if mark.borders() <= BORDERS || most < COARSEST {
                return Ok(mark);
            }
            most /= 4.0;
        }
    }

    /// How often a cell is set and the next is not, or the other way round.
    fn borders(&self) -> u32 {
        let mut last = 0;
        let of = |word: &u64| {
            let before = word << 1 | last;
            last = word >> 63;
            (word ^ before).count_ones()
        };
        self.bits.iter().map(of).sum()
    }

    /// No cell set.
    fn over(lo: &Vec3, hi: &Vec3, most: f64) -> Result<Mark> {
        let edges = (hi - lo).map(|e| e.max(f64::MIN_POSITIVE));
        // Grown until it fits: flat boxes have few cells across.
        let mut step = (edges.max() / LONGEST).max(f64::MIN_POSITIVE);
        let count = |step: f64| edges.map(|e| (e / step).ceil().max(1.0));
        while count(step).product() > most {
            step *= 1.1;
        }
        let dims = count(step).map(|n| n as usize);
        let dims = [dims.x, dims.y, dims.z];
        let len = dims[0] * dims[1] * dims[2];
        let bits = filled("a mark", len.div_ceil(64), 0u64)?;
        Ok(Mark { lo: *lo, step, dims, bits })
    }

    fn len(&self) -> usize {
        self.dims[0] * self.dims[1] * self.dims[2]
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.dims[0] * (j + self.dims[1] * k)
    }

    fn place(&self, i: usize) -> [usize; 3] {
        let [nx, ny, _] = self.dims;
        [i % nx, i / nx % ny, i / (nx * ny)]
    }

    fn set(&mut self, i: usize) {
        if let Some(word) = self.bits.get_mut(i / 64) {
            *word |= 1 << (i % 64);
        }
    }

    fn is_set(&self, i: usize) -> bool {
        self.bits.get(i / 64).is_some_and(|word| word >> (i % 64) & 1 == 1)
    }

    /// The cells along one axis that an interval touches, a rounding to each side.
    fn span(&self, axis: usize, from: f64, to: f64) -> std::ops::Range<usize> {
        const ROUNDING: f64 = 1e-9;
        let n = self.dims[axis] as f64;
        let at = |x: f64| ((x - self.lo[axis]) / self.step).clamp(-1.0, n + 1.0);
        let (first, last) = (at(from) - ROUNDING, at(to) + ROUNDING);
        if last < 0.0 || first > n {
            return 0..0;
        }
        let end = (last.floor() as usize + 1).min(self.dims[axis]);
        (first.max(0.0).floor() as usize).min(end)..end
    }

    /// Calls `f` with each cell that a box touches and the middle of the cell.
    fn each(&self, lo: &Vec3, hi: &Vec3, mut f: impl FnMut(usize, Vec3)) {
        let [x, y, z] = [0, 1, 2].map(|a| self.span(a, lo[a], hi[a]));
        for k in z {
            for j in y.clone() {
                for i in x.clone() {
                    let middle = Vec3::new(i as f64 + 0.5, j as f64 + 0.5, k as f64 + 0.5);
                    f(self.index([i, j, k]), self.lo + middle * self.step);
                }
            }
        }
    }

    /// Marks the cells that a triangle may touch: those of its box that its plane touches.
    fn paint(&self, t: &[Vec3; 3], cells: &mut [u8], with: u8) {
        let [a, b, c] = t;
        let normal = (b - a).cross(&(c - a));
        let (lo, hi) = (a.inf(b).inf(c), a.sup(b).sup(c));
        let size = (hi - lo).amax();
        let reach = 0.5 * self.step * normal.abs().sum() * (1.0 + 1e-9) + 1e-15 * size * size;
        self.each(&lo, &hi, |i, middle| {
            if normal.dot(&(middle - a)).abs() <= reach
                && let Some(cell) = cells.get_mut(i).filter(|c| **c != OTHER)
            {
                *cell = with;
            }
        });
    }

    /// Whether the cell of a point is set.
    pub(crate) fn holds(&self, p: &Vec3) -> bool {
        let mut at = [0; 3];
        for (axis, at) in at.iter_mut().enumerate() {
            let x = (p[axis] - self.lo[axis]) / self.step;
            // The upper border of the box may be that of the last cell.
            let n = self.dims[axis];
            if !(x >= 0.0 && x <= n as f64 * (1.0 + 1e-12)) {
                return false;
            }
            *at = (x as usize).min(n - 1);
        }
        self.is_set(self.index(at))
    }

    /// Whether a ball meets a cell that is set.
    pub(crate) fn meets(&self, center: &Vec3, radius: f64) -> bool {
        if self.holds(center) {
            return true;
        }
        let around = Vec3::repeat(radius);
        let mut found = false;
        self.each(&(center - around), &(center + around), |i, middle| {
            let beyond = (middle - center).map(|d| (d.abs() - 0.5 * self.step).max(0.0));
            found |= beyond.norm_squared() < radius * radius && self.is_set(i);
        });
        found
    }

    /// Whether its numbers are those of a mark: for bytes that come from outside.
    pub(crate) fn is_whole(&self) -> bool {
        let [nx, ny, nz] = self.dims.map(|n| n as u64);
        let cells = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
        let fits = cells.is_some_and(|n| n > 0 && n.div_ceil(64) == self.bits.len() as u64);
        fits && self.step.is_normal() && self.step > 0.0 && self.lo.iter().all(|x| x.is_finite())
    }

    /// Bytes of its bits.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.bits.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The twelve triangles of a box.
    fn surface(lo: Vec3, hi: Vec3) -> Vec<[Vec3; 3]> {
        let corner = |c: usize| Vec3::from_fn(|a, _| if c >> a & 1 == 1 { hi[a] } else { lo[a] });
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let both = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
        quads.into_iter().flat_map(both).map(|t| t.map(corner)).collect()
    }

    #[test]
    fn two_boxes_side_by_side_are_told_apart() {
        // The other one stands in a notch of this one's box.
        let own = surface(Vec3::zeros(), Vec3::new(1.0, 0.4, 1.0));
        let near = surface(Vec3::new(0.2, 0.41, 0.2), Vec3::new(0.8, 1.0, 0.8));
        let mut all = own.clone();
        all.extend(surface(Vec3::new(0.9, 0.3, 0.0), Vec3::repeat(1.0)));
        let (lo, hi) = (Vec3::zeros(), Vec3::repeat(1.0));
        let box_of = [Vec3::new(0.2, 0.41, 0.2), Vec3::new(0.8, 1.0, 0.8)];
        let by_surface = Mark::of_triangles(&lo, &hi, all.into_iter(), near.into_iter()).unwrap();
        let by_boxes = Mark::of_boxes(&lo, &hi, [box_of].into_iter()).unwrap();
        for mark in [&by_surface, &by_boxes] {
            assert!(mark.bytes() <= 32 << 10);
            assert!(mark.holds(&Vec3::new(0.5, 0.2, 0.5)));
            assert!(mark.holds(&Vec3::new(1.0, 1.0, 1.0)));
            // Within the other one, deep and just so.
            assert!(!mark.holds(&Vec3::new(0.5, 0.7, 0.5)));
            assert!(!mark.holds(&Vec3::new(0.5, 0.4101, 0.5)));
            assert!(!mark.holds(&Vec3::new(0.5, -0.1, 0.5)) && !mark.holds(&Vec3::repeat(1.1)));
            // In doubt as a point, not as a ball.
            assert!(!mark.holds(&Vec3::new(0.5, 0.3999, 0.5)));
            assert!(mark.meets(&Vec3::new(0.5, 0.38, 0.5), 0.02));
            assert!(!mark.meets(&Vec3::new(0.5, 0.7, 0.5), 0.29));
        }
    }
}
