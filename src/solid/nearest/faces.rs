//! The faces between solid and empty cells, merged to rectangles.

use crate::error::{Error, Result, filled};
use crate::math::Vec3;
use crate::shape::Voxels;

/// A rectangle of cell faces, on the lattice of cell corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    lo: [u32; 3],
    hi: [u32; 3],
    /// Axis of the normal, and whether it points towards greater coordinates.
    axis: u8,
    up: bool,
}

impl Rectangle {
    /// Its corners.
    pub(super) fn bounds(&self, spacing: &Vec3) -> (Vec3, Vec3) {
        let at = |c: [u32; 3]| Vec3::from(c.map(f64::from)).component_mul(spacing);
        (at(self.lo), at(self.hi))
    }

    /// Its outward normal.
    pub(super) fn normal(&self) -> Vec3 {
        let mut n = Vec3::zeros();
        n[usize::from(self.axis)] = if self.up { 1.0 } else { -1.0 };
        n
    }
}

/// All faces between solid and empty cells (or the end of the array), at most `most` and one
/// row more: then there are too many.
pub(super) fn rectangles(v: &Voxels, most: u64) -> Result<Vec<Rectangle>> {
    let [nx, ny, nz] = v.dims;
    let cells = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
    if cells != Some(v.cells.len()) {
        return Err(Error::InvalidArgument(format!(
            "there are {} cells, not {nx} × {ny} × {nz}",
            v.cells.len()
        )));
    }
    if let Some(n) = v.dims.iter().find(|&&n| n >= u32::MAX as usize) {
        return Err(Error::TooLarge(format!("{n} cells along an axis")));
    }
    let mut all = Vec::new();
    let stride = [1, nx, nx * ny];
    for axis in 0..3 {
        // Plane by plane, rows along `u`, row after row along `w`.
        let (u, w) = if axis == 0 { (1, 2) } else { (0, 3 - axis) };
        let mut open = filled("voxel faces", v.dims[u], NONE)?;
        for up in [false, true] {
            for n in 0..v.dims[axis] {
                let edge = if up { n + 1 == v.dims[axis] } else { n == 0 };
                open.fill(NONE);
                for b in 0..v.dims[w] {
                    let row = n * stride[axis] + b * stride[w];
                    let exposed = |a: usize| {
                        let c = row + a * stride[u];
                        v.cells[c] != 0
                            && (edge
                                || v.cells[if up { c + stride[axis] } else { c - stride[axis] }]
                                    == 0)
                    };
                    let place = Place { axis, up, u, w, plane: n + usize::from(up), b };
                    merge_row(&place, v.dims[u], exposed, &mut open, &mut all)?;
                    if all.len() as u64 > most {
                        return Ok(all);
                    }
                }
            }
        }
    }
    Ok(all)
}

/// No rectangle begins here.
const NONE: u32 = u32::MAX;

/// A row of faces.
struct Place {
    axis: usize,
    up: bool,
    u: usize,
    w: usize,
    plane: usize,
    b: usize,
}

/// Turns the runs of a row into rectangles; a run that is the same as one of the row before
/// makes that rectangle longer. `open[a]` is the rectangle of the last row that begins at a.
fn merge_row(
    place: &Place,
    length: usize,
    exposed: impl Fn(usize) -> bool,
    open: &mut [u32],
    all: &mut Vec<Rectangle>,
) -> Result<()> {
    let mut a = 0;
    while a < length {
        if !exposed(a) {
            open[a] = NONE;
            a += 1;
            continue;
        }
        let begin = a;
        while a < length && exposed(a) {
            if a > begin {
                open[a] = NONE;
            }
            a += 1;
        }
        if let Some(r) = all.get_mut(open[begin] as usize)
            && r.hi[place.u] as usize == a
        {
            r.hi[place.w] = place.b as u32 + 1;
            continue;
        }
        let (mut lo, mut hi) = ([place.plane as u32; 3], [place.plane as u32; 3]);
        (lo[place.u], hi[place.u]) = (begin as u32, a as u32);
        (lo[place.w], hi[place.w]) = (place.b as u32, place.b as u32 + 1);
        if all.len() == all.capacity() && all.try_reserve(all.len().max(64)).is_err() {
            return Err(Error::OutOfMemory(format!("no memory for {} voxel faces", all.len())));
        }
        open[begin] = all.len().min(NONE as usize) as u32;
        all.push(Rectangle { lo, hi, axis: place.axis as u8, up: place.up });
    }
    Ok(())
}

/// Which cells are solid, one bit each.
pub(super) struct Occupied {
    dims: [usize; 3],
    pub(super) spacing: Vec3,
    bits: Vec<u64>,
}

impl Occupied {
    pub(super) fn new(v: &Voxels) -> Result<Occupied> {
        let mut bits = filled("voxels", v.cells.len().div_ceil(64), 0u64)?;
        for (word, cells) in bits.iter_mut().zip(v.cells.chunks(64)) {
            for (i, &c) in cells.iter().enumerate() {
                *word |= u64::from(c != 0) << i;
            }
        }
        Ok(Occupied { dims: v.dims, spacing: v.spacing, bits })
    }

    /// Whether the cell of `p` is solid; a cell owns its lower faces.
    pub(super) fn at(&self, p: &Vec3) -> bool {
        let mut cell = [0; 3];
        for a in 0..3 {
            let u = p[a] / self.spacing[a];
            if !(u >= 0.0 && u < self.dims[a] as f64) {
                return false;
            }
            cell[a] = u as usize;
        }
        let c = cell[0] + self.dims[0] * (cell[1] + self.dims[1] * cell[2]);
        self.bits.get(c / 64).is_some_and(|word| word >> (c % 64) & 1 == 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_six_rectangles() {
        let v = Voxels { dims: [3, 4, 5], spacing: Vec3::repeat(1.0), cells: vec![1; 60] };
        let all = rectangles(&v, u64::MAX).unwrap();
        assert_eq!(all.len(), 6);
        let areas: Vec<_> = all.iter().map(|r| [0, 1, 2].map(|a| r.hi[a] - r.lo[a])).collect();
        assert_eq!(areas, [[0, 4, 5], [0, 4, 5], [3, 0, 5], [3, 0, 5], [3, 4, 0], [3, 4, 0]]);
    }

    #[test]
    fn merging_keeps_the_area() {
        let dims = [9, 8, 7];
        let cells: Vec<u8> =
            (0..504u64).map(|i| u8::from(i.wrapping_mul(0x9E3779B97F4A7C15) >> 60 < 8)).collect();
        let v = Voxels { dims, spacing: Vec3::repeat(1.0), cells };
        let at = |c: [usize; 3]| v.cells[c[0] + 9 * (c[1] + 8 * c[2])] != 0;
        let mut expected = 0;
        for i in 0..504 {
            let c = [i % 9, i / 9 % 8, i / 72];
            for a in 0..3 {
                let (mut l, mut r) = (c, c);
                let low = c[a] == 0 || {
                    l[a] -= 1;
                    !at(l)
                };
                let high = c[a] + 1 == dims[a] || {
                    r[a] += 1;
                    !at(r)
                };
                expected += u32::from(at(c)) * (u32::from(low) + u32::from(high));
            }
        }
        let area = |r: &Rectangle| (0..3).map(|a| (r.hi[a] - r.lo[a]).max(1)).product::<u32>();
        let all = rectangles(&v, u64::MAX).unwrap();
        assert_eq!(all.iter().map(area).sum::<u32>(), expected);
        assert!((all.len() as u32) < expected);
    }
}
