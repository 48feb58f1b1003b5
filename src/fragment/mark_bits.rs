//! The cells of a mark as few bytes, for what is handed on: each cell is told by what the cells
//! before it say (eight of them, as pictures of two colours are coded), by an adaptive binary range
//! coder (Martin 1979). Neighbours are mostly alike: a mark of 32 KiB takes about 1 KiB.

use crate::error::{Result, filled};

/// Odds are parts of this.
const ONE: u32 = 1 << 12;
/// How fast odds follow what is seen.
const FOLLOW: u32 = 4;
/// The range is widened below this.
const LEAST: u32 = 1 << 24;

/// Cells with a border of none: two before and one after along x, one to each side along y, one
/// before along z.
struct Cells {
    dims: [usize; 3],
    row: usize,
    layer: usize,
    cells: Vec<u8>,
    /// How often a cell is not set, by what is before it.
    odds: [u32; 256],
}

impl Cells {
    fn new(dims: [usize; 3]) -> Result<Cells> {
        let row = dims[0].saturating_add(3);
        let layer = row.saturating_mul(dims[1].saturating_add(2));
        let len = layer.saturating_mul(dims[2].saturating_add(1));
        let cells = filled("cells of a mark", len, 0u8)?;
        Ok(Cells { dims, row, layer, cells, odds: [ONE / 2; 256] })
    }

    /// Visits the cells in order; `f` is given the number of each, and the odds of it not being
    /// set, and says whether it is.
    fn each(&mut self, mut f: impl FnMut(usize, u32) -> bool) {
        let [nx, ny, nz] = self.dims;
        let (row, layer) = (self.row, self.layer);
        let mut i = 0;
        for z in 1..=nz {
            for y in 1..=ny {
                for x in 2..nx + 2 {
                    let at = x + y * row + z * layer;
                    let before = [
                        at - 1,
                        at - 2,
                        at - row,
                        at - row + 1,
                        at - layer,
                        at - layer + 1,
                        at - layer + row,
                        at - layer - row,
                    ];
                    let of = |c: &usize| self.cells.get(*c).map_or(0, |&b| usize::from(b));
                    let context = before.iter().fold(0, |sum, c| 2 * sum + of(c));
                    let odds = &mut self.odds[context & 255];
                    let set = f(i, *odds);
                    // From 31 to 4065: never sure.
                    if set {
                        *odds -= *odds >> FOLLOW;
                    } else {
                        *odds += (ONE - *odds) >> FOLLOW;
                    }
                    *odds = (*odds).clamp(8, ONE - 8);
                    if let Some(cell) = self.cells.get_mut(at) {
                        *cell = u8::from(set);
                    }
                    i += 1;
                }
            }
        }
    }
}

/// The bytes of the cells of a mark, `words` with a bit each, x fastest.
pub(super) fn pack(words: &[u64], dims: [usize; 3]) -> Result<Vec<u8>> {
    let mut out: Vec<u8> = Vec::new();
    let (mut low, mut range) = (0u64, u32::MAX);
    // Of what may still be carried into: a byte, and how many of 255 follow it.
    let (mut held, mut full, mut first) = (0u8, 0usize, true);
    let mut shift = |low: &mut u64, out: &mut Vec<u8>| {
        if *low < 0xff00_0000 || *low > u64::from(u32::MAX) {
            let carry = (*low >> 32) as u8;
            if !first {
                out.push(held.wrapping_add(carry));
            }
            first = false;
            out.extend(std::iter::repeat_n(255u8.wrapping_add(carry), full));
            (held, full) = ((*low >> 24) as u8, 0);
        } else {
            full += 1;
        }
        *low = (*low << 8) & u64::from(u32::MAX);
    };
    Cells::new(dims)?.each(|i, odds| {
        let set = words.get(i / 64).is_some_and(|w| w >> (i % 64) & 1 == 1);
        let bound = range / ONE * odds;
        if set {
            low += u64::from(bound);
            range -= bound;
        } else {
            range = bound;
        }
        while range < LEAST {
            range <<= 8;
            shift(&mut low, &mut out);
        }
        set
    });
    (0..5).for_each(|_| shift(&mut low, &mut out));
    // Beyond the end zeros are read.
    while out.last() == Some(&0) {
        out.pop();
    }
    Ok(out)
}

/// The words of bytes; of any bytes some.
pub(super) fn unpack(bytes: &[u8], dims: [usize; 3]) -> Result<Vec<u64>> {
    let count = dims.iter().try_fold(1usize, |n, d| n.checked_mul(*d)).unwrap_or(usize::MAX);
    let mut words = filled("a mark", count.div_ceil(64), 0u64)?;
    let mut rest = bytes.iter().copied();
    let mut next = || u32::from(rest.next().unwrap_or(0));
    let (mut code, mut range) = (0u32, u32::MAX);
    (0..4).for_each(|_| code = code << 8 | next());
    Cells::new(dims)?.each(|i, odds| {
        let bound = range / ONE * odds;
        let set = code >= bound;
        if set {
            code -= bound;
            range -= bound;
            if let Some(word) = words.get_mut(i / 64) {
                *word |= 1 << (i % 64);
            }
        } else {
            range = bound;
        }
        while range < LEAST {
            range <<= 8;
            code = code << 8 | next();
        }
        set
    });
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_come_back() {
        let dims = [40, 31, 29];
        let len = (40 * 31 * 29usize).div_ceil(64);
        let mask = |words: &mut Vec<u64>| {
            let rest = (40 * 31 * 29) % 64;
            *words.last_mut().unwrap() &= (1 << rest) - 1;
        };
        let mut noise: Vec<u64> = (1..=len as u64)
            .map(|i| {
                let z = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
                let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
                z ^ z >> 27
            })
            .collect();
        let mut full = vec![u64::MAX; len];
        mask(&mut noise);
        mask(&mut full);
        let mut ball = vec![0; len];
        for i in 0..40 * 31 * 29usize {
            let at = [i % 40, i / 40 % 31, i / 1240].map(|x| x as f64);
            let r2 = (at[0] - 19.3).powi(2) + (at[1] - 15.1).powi(2) + (at[2] - 14.0).powi(2);
            ball[i / 64] |= u64::from(r2 < 180.0) << (i % 64);
        }
        for (words, most) in [(noise, 5200), (vec![0; len], 60), (full, 80), (ball, 420)] {
            let bytes = pack(&words, dims).unwrap();
            assert!(bytes.len() <= most, "{} bytes", bytes.len());
            assert_eq!(unpack(&bytes, dims).unwrap(), words);
        }
        // Bytes that are none of a mark's, and too few or too many.
        for bytes in [&[][..], &[255; 30], &[7; 9000]] {
            assert_eq!(unpack(bytes, dims).unwrap().len(), len);
        }
        assert!(unpack(&[], [usize::MAX, 2, 2]).is_err());
        assert!(pack(&[], [0, 5, 5]).unwrap().is_empty());
    }
}
