//! Cutting bodies whose moments are no polyhedral integrals: voxels cell by cell; open meshes and
//! those that cross themselves by the columns of the solid's own moments, with components by the
//! cells of the solid's grid.

use super::Region;
use super::blocks::{Blocks, Found};
use super::cells::{Cells, Cut};
use super::cut::missed;
use super::piece::{Piece, arrange, bounding};
use crate::error::{Result, collected, filled, push, reserve};
use crate::generate::Plane;
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Body;
use crate::solid::Solid;
use crate::solid::columns::Columns;
use crate::solid::moments::{Sums, lattices};

/// The pieces of a solid of cells, or of columns.
pub(super) fn of_blocks(
    solid: &Solid,
    region: Option<&Region>,
    by: &Cut,
    least: f64,
    notes: &mut Vec<String>,
    run: &Run,
) -> Result<Vec<Region>> {
    let limit = solid.memory_limit();
    let (blocks, body, columns) = match solid.body() {
        Body::Voxels(v) => {
            let hi = Vec3::from_fn(|a, _| v.dims[a] as f64 * v.spacing[a]);
            (Blocks::of(v, limit), [Vec3::zeros(), hi], None)
        }
        Body::Mesh(mesh) => {
            let mut columns = reserve("columns", 3)?;
            for lattice in lattices(mesh, solid.unit_moments(), limit, run)?.into_iter().flatten() {
                run.check(0.0, "cutting columns")?;
                columns.push(Columns::within(solid.body(), lattice, limit, 0, run)?);
            }
            (Blocks::of_grid(solid)?, *Piece::whole(mesh).bounds(), Some(columns))
        }
    };
    let members = region.map(|r| blocks.members(r)).transpose()?.flatten();
    let outer = region.map_or(&[][..], |r| r.planes.as_slice());
    let bounds = region.map_or(body, |r| [r.lo, r.hi]);
    let mut lists: Vec<Option<Vec<Plane>>> = Vec::new();
    match Cells::of(by, solid, region, &bounds, notes, run)? {
        Cells::Arranged(planes) => {
            if let Some(base) = Piece::cuboid(&body[0], &body[1]).within(outer)? {
                let (pieces, cuts) = arrange(base, &planes, limit, run)?;
                missed(&cuts, notes);
                for piece in pieces {
                    push("cells of planes", &mut lists, Some(piece.planes))?;
                }
            }
        }
        Cells::Convex(cells) => {
            for planes in cells {
                let both = planes.map(|p| collected("planes", outer.iter().copied().chain(p)));
                push("cells of planes", &mut lists, both.transpose()?)?;
            }
        }
    }
    let one = |i: usize| -> Result<Vec<Region>> {
        let Some(planes) = lists.get(i).and_then(Option::as_ref) else { return Ok(Vec::new()) };
        let planes = bounding(planes, &body)?;
        let Some(cell) = Piece::cuboid(&body[0], &body[1]).within(&planes)? else {
            return Ok(Vec::new());
        };
        let found = blocks.within(&planes, cell.bounds())?;
        let mut regions = blocks.regions(&found, &planes, i, least)?;
        if let Some(columns) = &columns {
            regions = integrated(solid, &blocks, &found, columns, regions, &planes, &cell, i)?;
        }
        let own = |r: &Region| match (&members, r.anchor) {
            (Some(members), Some(a)) => members.get(a as usize).is_some_and(|&m| m),
            _ => true,
        };
        regions.retain(own);
        if found.count < 2 {
            regions.iter_mut().for_each(|r| r.anchor = None);
        }
        Ok(regions)
    };
    let mut all = Vec::new();
    const TOGETHER: usize = 16;
    for first in (0..lists.len()).step_by(TOGETHER) {
        run.check(0.1 + 0.9 * first as f64 / lists.len() as f64, "cutting cells")?;
        let n = TOGETHER.min(lists.len() - first);
        for (k, regions) in run.pool().map(n, |k| one(first + k)).into_iter().enumerate() {
            let regions = regions?;
            if regions.is_empty() && matches!(by, Cut::Points { .. } | Cut::Within(_)) {
                push("notes", notes, format!("cell {} does not meet the body", first + k))?;
            }
            regions.into_iter().try_for_each(|r| push("regions", &mut all, r))?;
        }
    }
    Ok(all)
}

/// The regions with moments by columns. An interval belongs to the component whose cell is nearest
/// to its middle along the column; where no cell is near, to the one of most cells.
#[allow(clippy::too_many_arguments)]
fn integrated(
    solid: &Solid,
    blocks: &Blocks,
    found: &Found,
    columns: &[Columns],
    mut regions: Vec<Region>,
    planes: &[Plane],
    within: &Piece,
    cell: usize,
) -> Result<Vec<Region>> {
    let parent = solid.unit_moments();
    let [lo, hi] = *within.bounds();
    if regions.is_empty() {
        // Thinner than cells, if it is anything.
        let (planes, moments) = (collected("planes", planes.iter().copied())?, *parent);
        regions.push(Region { planes, mark: None, moments, lo, hi, anchor: None, cell });
    } else {
        // Cells cover what is inside to half a cell.
        for r in &mut regions {
            r.lo = (r.lo - blocks.spacing).sup(&lo);
            r.hi = (r.hi + blocks.spacing).inf(&hi);
        }
    }
    let by = |i: &usize, j: &usize| {
        let volume = |i: &usize| regions[*i].moments.volume;
        volume(i).total_cmp(&volume(j)).then(j.cmp(i))
    };
    let most = (0..regions.len()).max_by(by).unwrap_or(0);
    let middle = (lo + hi) * 0.5;
    let mut sums = filled("regions", regions.len(), Sums::default())?;
    for c in columns {
        let (lattice, axis) = (c.lattice(), c.axis);
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for b in 0..lattice.dims[1] {
            for a in 0..lattice.dims[0] {
                let intervals = c.column(a, b);
                if intervals.is_empty() {
                    continue;
                }
                let at = c.point(a, b, 0.0);
                let [from, to] = between(planes, &at, axis);
                for t in intervals {
                    let t = [t[0].max(from), t[1].min(to)];
                    if t[1] <= t[0] {
                        continue;
                    }
                    let i = if found.count > 1 {
                        component(blocks, found, &at, axis, t).unwrap_or(most)
                    } else {
                        0
                    };
                    if let Some(sums) = sums.get_mut(i) {
                        let uv = [at[u] - middle[u], at[v] - middle[v]];
                        sums.column(lattice, uv, t.map(|t| t - middle[axis]));
                    }
                }
            }
        }
    }
    for (r, sums) in regions.iter_mut().zip(&sums) {
        r.moments = sums.times(1.0 / 3.0).moments(&middle);
        if r.moments.volume > 0.0 {
            r.moments.relative_error = parent.relative_error * (parent.volume / r.moments.volume);
        }
    }
    regions.retain(|r| r.moments.volume > 0.0);
    Ok(regions)
}

/// The part of a column within planes.
fn between(planes: &[Plane], at: &Vec3, axis: usize) -> [f64; 2] {
    const FAR: f64 = 1e6;
    let (mut from, mut to) = (-FAR, FAR);
    for plane in planes {
        let (slope, room) = (plane.normal[axis], plane.offset - plane.normal.dot(at));
        // Nearly along the plane: in or out as a whole; in the plane on one of its sides.
        if slope.abs() < 1e-12 {
            if room < 0.0 || room == 0.0 && plane.normal[plane.normal.iamax()] < 0.0 {
                return [0.0, 0.0];
            }
        } else if slope > 0.0 {
            to = to.min(room / slope);
        } else {
            from = from.max(room / slope);
        }
    }
    [from, to]
}

/// The component of an interval of a column, by cells.
fn component(blocks: &Blocks, found: &Found, at: &Vec3, axis: usize, t: [f64; 2]) -> Option<usize> {
    let step = 0.5 * blocks.spacing[axis];
    let (middle, half) = (0.5 * (t[0] + t[1]), 0.5 * (t[1] - t[0]));
    let n = (half / step).ceil() as i64;
    let look = |k: i64| {
        let mut p = *at;
        p[axis] = middle + (k as f64 * step).clamp(-half, half);
        found.component(blocks.cell_of(&p))
    };
    (0..=n).find_map(|k| look(k).or_else(|| look(-k)))
}
