//! Local maxima of a field in the 3×3×3 neighbourhood (Buchele et al. 2026, section 3.3).

use super::lattice::Lattice;
use crate::error::{Result, collected, filled, push};
use crate::run::Pool;

/// What is reserved.
pub(super) const WHAT: &str = "the maxima of a field";

/// The cells with a value above zero whose neighbourhood holds no greater value,
/// in the order of the array. Cells on the border of the array are none. Cells of
/// plateaus all count; [`thin`] leaves representatives of large plateaus. Only cells below
/// `most` along each axis are looked at.
pub(super) fn maxima(
    lattice: &Lattice,
    field: &[f32],
    most: [usize; 3],
    pool: &Pool,
) -> Result<Vec<[u32; 3]>> {
    let [nx, ny, nz] = lattice.dims;
    let [mx, my, mz] = std::array::from_fn(|a| most[a].min(lattice.dims[a].saturating_sub(1)));
    if nx < 3 || ny < 3 || nz < 3 {
        return Ok(Vec::new());
    }
    let row = |j: usize, k: usize| {
        let start = nx * (j + ny * k);
        field.get(start..start + nx).unwrap_or(&[])
    };
    let slab = |k: usize| {
        let k = k + 1;
        let mut found = Vec::new();
        for j in 1..my {
            let here = row(j, k);
            if here.len() < nx {
                continue;
            }
            // The eight rows around, nearest first: they refuse most cells early.
            let around = [
                row(j - 1, k),
                row(j + 1, k),
                row(j, k - 1),
                row(j, k + 1),
                row(j - 1, k - 1),
                row(j + 1, k - 1),
                row(j - 1, k + 1),
                row(j + 1, k + 1),
            ];
            for i in 1..mx {
                let v = here[i];
                if v > 0.0
                    && here[i - 1] <= v
                    && here[i + 1] <= v
                    && around.iter().all(|r| r[i] <= v)
                    && around.iter().all(|r| r[i - 1] <= v && r[i + 1] <= v)
                {
                    push(WHAT, &mut found, [i as u32, j as u32, k as u32])?;
                }
            }
        }
        Ok(found)
    };
    let slabs = pool.map(mz.saturating_sub(1), slab).into_iter().collect::<Result<Vec<_>>>()?;
    collected(WHAT, slabs.into_iter().flatten())
}

/// More cells than this with one value are thinned.
const PLATEAU: usize = 400;

/// Leaves representatives of large plateaus: of the cells that share a value, when they are
/// many, those on a lattice about the centre of their box, with a distance of a sixth of
/// `reach(value)` cells. The lattice is the same from both ends, so mirror images stay.
pub(super) fn thin(
    mut cells: Vec<[u32; 3]>,
    value: impl Fn(&[u32; 3]) -> f32,
    reach: impl Fn(f32) -> f64,
) -> Result<Vec<[u32; 3]>> {
    if cells.len() <= PLATEAU {
        return Ok(cells);
    }
    let mut order: Vec<(f32, usize)> =
        collected(WHAT, cells.iter().enumerate().map(|(n, c)| (value(c), n)))?;
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut keep = filled(WHAT, cells.len(), false)?;
    for group in order.chunk_by(|a, b| a.0 == b.0) {
        let members = || group.iter().filter_map(|(_, n)| cells.get(*n).map(|c| (*n, c)));
        let stride = group.first().map_or(1.0, |(v, _)| reach(*v) / 6.0).floor().max(1.0) as u32;
        if group.len() <= PLATEAU || stride == 1 {
            members().for_each(|(n, _)| keep[n] = true);
            continue;
        }
        let mut lo = [u32::MAX; 3];
        let mut hi = [0; 3];
        for (_, c) in members() {
            for a in 0..3 {
                lo[a] = lo[a].min(c[a]);
                hi[a] = hi[a].max(c[a]);
            }
        }
        for (n, c) in members() {
            keep[n] = (0..3).all(|a| {
                let extent = hi[a] - lo[a];
                // Twice the distance from the middle, from either end the same.
                let off = (2 * (c[a] - lo[a])).abs_diff(extent);
                extent < 2 * stride || off % (2 * stride) <= 1 || off == extent
            });
        }
    }
    let mut keep = keep.into_iter();
    cells.retain(|_| keep.next().unwrap_or(false));
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn equals_brute_force(dims in [1usize..9, 1usize..8, 1usize..7], values in 2u32..9, seed in any::<u32>()) {
            let l = Lattice::new(dims, [1.0; 3]);
            let mut state = seed | 1;
            let field: Vec<f32> = (0..dims.iter().product())
                .map(|_| {
                    state = state.wrapping_mul(1664525).wrapping_add(1013904223);
                    ((state >> 16) % values) as f32
                })
                .collect();
            let mut slow = Vec::new();
            for k in 1..dims[2].max(1) - 1 {
                for j in 1..dims[1].max(1) - 1 {
                    for i in 1..dims[0].max(1) - 1 {
                        let at = |i: usize, j: usize, k: usize| field[i + dims[0] * (j + dims[1] * k)];
                        let v = at(i, j, k);
                        let greater = (0..27).any(|n| at(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1) > v);
                        if v > 0.0 && !greater {
                            slow.push([i as u32, j as u32, k as u32]);
                        }
                    }
                }
            }
            prop_assert_eq!(maxima(&l, &field, dims, &Pool::serial()).unwrap(), slow);
        }
    }

    #[test]
    fn a_thinned_plateau_keeps_its_centre_ends_and_mirror_images() {
        let cells: Vec<[u32; 3]> = (0..60 * 41).map(|n| [3 + n % 60, 7 + n / 60, 5]).collect();
        let kept = thin(cells.clone(), |_| 24.0, f64::from).unwrap();
        assert!(kept.len() < cells.len() / 5);
        for c in &kept {
            assert!(kept.contains(&[65 - c[0], c[1], c[2]]));
            assert!(kept.contains(&[c[0], 54 - c[1], c[2]]));
        }
        assert!(kept.contains(&[32, 27, 5]) && kept.contains(&[33, 27, 5]));
        assert!(kept.contains(&[3, 7, 5]) && kept.contains(&[62, 47, 5]));
    }
}
