//! Orientation: neighbours made to agree.

use super::topology::{Edges, Side};
use crate::error::{Result, filled, reserve};
use crate::math::Vec3;

/// What to turn so that neighbours agree.
pub struct Agreement {
    /// Faces to turn.
    pub turn: Vec<bool>,
    /// Whether there are neighbours that cannot agree: the surface has one side only.
    pub one_sided: bool,
}

/// Goes over edges with exactly two faces from the lowest face of each connected
/// patch; of the two ways to agree within a patch, the one that turns less area.
pub fn agree(faces: &[[u32; 3]], points: &[Vec3], edges: &Edges) -> Result<Agreement> {
    let n = faces.len();
    let agrees = |e: &[Side]| !matches!(e, [a, b] if a.forward == b.forward);
    if edges.iter().all(agrees) {
        return Ok(Agreement { turn: filled("turns", n, false)?, one_sided: false });
    }
    let mut neighbours: Vec<(u32, u32, bool)> = reserve("neighbours", n * 3)?;
    for e in edges.iter() {
        if let [a, b] = e {
            let same = a.forward == b.forward;
            neighbours.push((a.face, b.face, same));
            neighbours.push((b.face, a.face, same));
        }
    }
    neighbours.sort_unstable();
    let mut start = filled("neighbours", n + 1, 0u32)?;
    neighbours.iter().for_each(|x| start[x.0 as usize + 1] += 1);
    for i in 0..n {
        start[i + 1] += start[i];
    }
    let mut turn = filled("turns", n, false)?;
    let mut seen = filled("turns", n, false)?;
    let mut one_sided = false;
    let mut patch: Vec<u32> = reserve("a patch", n)?;
    for first in 0..n {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        patch.clear();
        patch.push(first as u32);
        let mut at = 0;
        while let Some(&f) = patch.get(at) {
            at += 1;
            let f = f as usize;
            for &(_, g, same) in &neighbours[start[f] as usize..start[f + 1] as usize] {
                let g = g as usize;
                if !seen[g] {
                    seen[g] = true;
                    turn[g] = turn[f] != same;
                    patch.push(g as u32);
                } else {
                    one_sided |= turn[g] != (turn[f] != same);
                }
            }
        }
        let area = |f: u32| {
            let [a, b, c] = faces[f as usize].map(|v| points[v as usize]);
            (b - a).cross(&(c - a)).norm()
        };
        let balance: f64 =
            patch.iter().map(|&f| if turn[f as usize] { area(f) } else { -area(f) }).sum();
        if balance > 0.0 {
            patch.iter().for_each(|&f| turn[f as usize] = !turn[f as usize]);
        }
    }
    Ok(Agreement { turn, one_sided })
}
