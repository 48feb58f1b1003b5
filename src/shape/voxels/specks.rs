//! Specks beside a body, where it is known that they are none of it.

use super::bodies::Components;
use crate::error::Result;

/// Empties all but the largest body if the others have together at most this `part` of the cells;
/// returns how many went. `allow` is asked, with the bytes, before memory is taken.
pub(crate) fn drop_specks(
    cells: &mut [u8],
    dims: [usize; 3],
    part: f64,
    allow: impl Fn(u64) -> Result<()>,
) -> Result<usize> {
    let bodies = Components::of(cells, dims, allow)?;
    let (largest, size) = bodies.largest();
    let all: u64 = bodies.sizes().iter().sum();
    if bodies.count() < 2 || (all - size) as f64 > part * all as f64 {
        return Ok(0);
    }
    bodies.keep(largest, cells);
    Ok(bodies.count() - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn specks_go_and_bodies_stay() {
        // A row: ten solid, a gap, one, a gap, one.
        let mut row = [1u8; 14];
        (row[10], row[12]) = (0, 0);
        let whole = row;
        let mut drop = |part| drop_specks(&mut row, [14, 1, 1], part, |_| Ok(()));
        assert_eq!(drop(0.16), Ok(0));
        assert_eq!(drop(0.17), Ok(2));
        assert_eq!(drop(0.17), Ok(0));
        assert_eq!((&row[..10], &row[10..]), (&whole[..10], &[0; 4][..]));
    }
}
