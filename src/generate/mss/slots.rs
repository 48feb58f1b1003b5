//! Gaps of a mesh that are finer than the cells: no cell shows them, but they bound the spheres
//! beside them, so they must bound E as well, or its maxima lie in the gap.

use super::lattice::Lattice;
use super::target::value;
use crate::error::{Result, reserve};
use crate::math::Vec3;
use crate::shape::Mesh;
use crate::solid::Grid;

/// The surface never crosses a solid cell that is farther than this from every empty one, in
/// cells, but in such a gap: beyond a cell that a plane cuts lies an empty one within √2.
const FAR: f32 = 2.0;

/// The solid cells without those that a gap crosses; none when there is no gap. `distance` is
/// the distance to the nearest empty cell.
pub(super) fn without_slots(
    mesh: &Mesh,
    grid: &Grid,
    lattice: &Lattice,
    bits: &[u64],
    distance: &[f32],
) -> Result<Option<Vec<u64>>> {
    let far = lattice.step.iter().fold(0.0, |m: f64, s| m.max(*s)) as f32 * FAR;
    let mut open: Option<Vec<u64>> = None;
    for face in 0..mesh.faces.len() {
        let corners = mesh.corners(face).map(|p| (p - grid.origin).component_div(&grid.spacing));
        for_points(&corners, |p| {
            let cell: [i64; 3] = std::array::from_fn(|a| p[a].floor() as i64);
            if value(distance, lattice, cell) <= far {
                return Ok(());
            }
            let [i, j, k] = cell.map(|n| n as usize);
            let bits = match &mut open {
                Some(bits) => bits,
                None => {
                    let mut copy = reserve("the cells without gaps", bits.len())?;
                    copy.extend_from_slice(bits);
                    open.insert(copy)
                }
            };
            if let Some(word) = bits.get_mut(i / 64 + lattice.words * (j + lattice.dims[1] * k)) {
                *word &= !(1 << (i % 64));
            }
            Ok(())
        })?;
    }
    Ok(open)
}

/// Points of a triangle, no farther than half a cell apart.
fn for_points(corners: &[Vec3; 3], mut visit: impl FnMut(Vec3) -> Result<()>) -> Result<()> {
    let [a, b, c] = corners;
    let (u, v) = (b - a, c - a);
    let longest = u.norm().max(v.norm()).max((c - b).norm());
    let n = (2.0 * longest).ceil().max(1.0) as usize;
    for i in 0..=n {
        for j in 0..=n - i {
            visit(a + u * (i as f64 / n as f64) + v * (j as f64 / n as f64))?;
        }
    }
    Ok(())
}
