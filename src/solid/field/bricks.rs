//! Unsigned distances from cell centres to triangles, by bricks of 8³, 4³ and 2³ cells.
//!
//! The distance to a triangle is a convex function of the point, so its tangent plane at
//! a brick's centre, `L(x) = d + g·(x − c)` with `g` the unit vector from the nearest point
//! to c, is a lower bound everywhere; the same holds for a box of triangles. The nearest
//! triangle at the centre gives an upper bound, `d* + g*·(x − c) + ρ²/2d*` over a brick of
//! half diagonal ρ. A triangle is dropped for a whole brick when its lower bound is nowhere
//! below the upper bound less a tolerance. Few are left in a brick of 2³ cells, and the
//! tangent planes tell which of them need an exact distance. Each drop is within its
//! tolerance of what was kept, so the error of a cell is at most their sum.

use super::tree::{Facet, LANES, Lanes, Tree};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Mesh;
use crate::solid::grid::Grid;
use crate::solid::triangle;
use std::sync::atomic::{AtomicBool, Ordering};

/// What may be lost at each drop, in shortest cell edges: at bricks of 8³, 4³, 2³ and at cells.
/// Their sum, with the rounding of tangent planes to f32, stays below 0.01.
const TOLERANCE: [f32; 4] = [0.0005, 0.001, 0.002, 0.004];
/// Cells along the edge of a brick.
const EDGE: usize = 8;

/// A triangle that may be nearest somewhere in a brick, with its tangent plane there.
#[derive(Debug, Clone, Copy, Default)]
struct Candidate {
    /// Lower bound at the brick's centre.
    level: f32,
    slope: [f32; 3],
    facet: u32,
}

/// Cells `lo..hi` along each axis.
#[derive(Debug, Clone, Copy)]
struct Brick {
    lo: [usize; 3],
    hi: [usize; 3],
}

/// Coordinates in units of the shortest cell edge, from the grid's origin.
struct Space<'a> {
    tree: &'a Tree,
    spacing: Vec3,
    dims: [usize; 3],
    unit: f64,
}

/// What is nearest at a brick's centre, and how much the bound from it may give.
#[derive(Debug, Clone, Copy, Default)]
struct Reference {
    distance: f32,
    slope: [f32; 3],
    /// Half extents of the cell centres.
    half: [f32; 3],
    /// Upper bound: `distance + slope·e + sag` for every centre at offset e.
    sag: f32,
}

impl Reference {
    fn new(c: &Vec3, nearest: &Vec3, half: &Vec3) -> Reference {
        let (distance, slope) = tangent(c, nearest);
        let (d, rho2) = (f64::from(distance), half.norm_squared());
        let sag = if rho2 < 4.0 * rho2.sqrt() * d { rho2 / (2.0 * d) } else { 2.0 * rho2.sqrt() };
        Reference { distance, slope, half: single(half), sag: sag as f32 }
    }

    /// Whether a tangent plane comes below the bound less the tolerance.
    fn admits(&self, level: f32, slope: &[f32; 3], tolerance: f32) -> bool {
        let reach: f32 = (0..3).map(|a| (slope[a] - self.slope[a]).abs() * self.half[a]).sum();
        level + tolerance <= self.distance + self.sag + reach
    }
}

fn single(v: &Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

/// Distance and unit vector from the nearest point `q` of a convex set to `c`.
fn tangent(c: &Vec3, q: &Vec3) -> (f32, [f32; 3]) {
    let v = c - q;
    let d = v.norm();
    // On the set itself the distance is not negative, which is all that there is to say.
    if d > 1e-9 { (d as f32, single(&(v / d))) } else { (0.0, [0.0; 3]) }
}

/// Writes the unsigned distances at all cell centres.
pub(super) fn distances(mesh: &Mesh, grid: &Grid, run: &Run, out: &mut [f32]) -> Result<()> {
    let unit = grid.spacing.min();
    let tree = Tree::new(mesh, grid, unit)?;
    run.check(0.0, "making the distance field")?;
    if tree.facets.is_empty() {
        return Err(Error::Empty("the mesh has no face".into()));
    }
    let space = Space { tree: &tree, spacing: grid.spacing / unit, dims: grid.dims, unit };
    let slab = EDGE * grid.dims[0] * grid.dims[1];
    let starved = AtomicBool::new(false);
    run.pool().chunks_mut(out, slab, |layer, out| {
        let mut lists = Lists::default();
        if lists.layer(&space, layer * EDGE, out).is_err() {
            starved.store(true, Ordering::Relaxed);
        }
    });
    if starved.into_inner() {
        return Err(Error::OutOfMemory("no memory for the candidates of a brick".into()));
    }
    Ok(())
}

impl Space<'_> {
    /// Middle of the brick's cell centres and their half extents.
    fn middle(&self, b: &Brick) -> (Vec3, Vec3) {
        let (mut c, mut half) = (Vec3::zeros(), Vec3::zeros());
        for a in 0..3 {
            c[a] = 0.5 * (b.lo[a] + b.hi[a]) as f64 * self.spacing[a];
            half[a] = 0.5 * (b.hi[a] - b.lo[a] - 1) as f64 * self.spacing[a];
        }
        (c, half)
    }

    fn facet(&self, i: u32) -> &Facet {
        &self.tree.facets[i as usize]
    }
}

/// The halves of a brick, x fastest; some may be empty.
fn halves(b: &Brick, edge: usize) -> [Brick; 8] {
    std::array::from_fn(|k| {
        let (mut lo, mut hi) = (b.lo, b.hi);
        for a in 0..3 {
            let cut = (b.lo[a] + edge).min(b.hi[a]);
            if k >> a & 1 == 0 { hi[a] = cut } else { lo[a] = cut }
        }
        Brick { lo, hi }
    })
}

/// The candidates of the bricks in work: of one of 8³, its eight of 4³, and eight of 2³.
#[derive(Default)]
struct Lists {
    whole: Vec<Candidate>,
    quarter: [Vec<Candidate>; 8],
    pair: [Vec<Candidate>; 8],
}

impl Lists {
    /// A layer of bricks from the slice `z0` on.
    fn layer(&mut self, space: &Space, z0: usize, out: &mut [f32]) -> Result<()> {
        let [nx, ny, nz] = space.dims;
        let mut last: Option<(Vec3, Vec3)> = None;
        for y0 in (0..ny).step_by(EDGE) {
            for x0 in (0..nx).step_by(EDGE) {
                let brick = Brick {
                    lo: [x0, y0, z0],
                    hi: [(x0 + EDGE).min(nx), (y0 + EDGE).min(ny), (z0 + EDGE).min(nz)],
                };
                let (c, half) = space.middle(&brick);
                // The nearest point of the brick before is a first bound.
                let reach = last.map_or(1e100, |(_, q)| (q - c).norm() * (1.0 + 1e-9) + 1e-9);
                let nearest = space.tree.nearest(&c, reach);
                last = Some((c, nearest));
                let reference = Reference::new(&c, &nearest, &half);
                self.gather(space, &c, &reference)?;
                split(
                    space,
                    &c,
                    &self.whole,
                    &halves(&brick, 4),
                    TOLERANCE[1],
                    true,
                    &mut self.quarter,
                )?;
                for (k, quarter) in halves(&brick, 4).iter().enumerate() {
                    if self.quarter[k].is_empty() {
                        continue;
                    }
                    let (c, _) = space.middle(quarter);
                    let parts = halves(quarter, 2);
                    split(
                        space,
                        &c,
                        &self.quarter[k],
                        &parts,
                        TOLERANCE[2],
                        false,
                        &mut self.pair,
                    )?;
                    for (pair, list) in parts.iter().zip(&self.pair) {
                        if !list.is_empty() {
                            finish(space, pair, list, z0, out);
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// The candidates of a whole brick.
    fn gather(&mut self, space: &Space, c: &Vec3, reference: &Reference) -> Result<()> {
        self.whole.clear();
        let mut starved = false;
        let admits = |q: &Vec3| {
            let (level, slope) = tangent(c, q);
            reference.admits(level, &slope, TOLERANCE[0])
        };
        space.tree.gather(c, admits, |i, facet| {
            let (level, slope) = tangent(c, &triangle::closest(&facet.corners, c));
            if reference.admits(level, &slope, TOLERANCE[0]) {
                starved |= push(&mut self.whole, Candidate { level, slope, facet: i }).is_err();
            }
        });
        if starved { Err(out_of_memory()) } else { Ok(()) }
    }
}

fn out_of_memory() -> Error {
    Error::OutOfMemory("no memory for the candidates of a brick".into())
}

fn push(list: &mut Vec<Candidate>, c: Candidate) -> Result<()> {
    if list.len() == list.capacity() {
        list.try_reserve(list.len().max(64)).map_err(|_| out_of_memory())?;
    }
    list.push(c);
    Ok(())
}

/// Hands the candidates of a brick about `c` to those of its parts that they may matter to.
fn split(
    space: &Space,
    c: &Vec3,
    list: &[Candidate],
    parts: &[Brick; 8],
    tolerance: f32,
    sharpen: bool,
    to: &mut [Vec<Candidate>; 8],
) -> Result<()> {
    for t in to.iter_mut() {
        t.clear();
    }
    // Offsets of the parts' centres.
    let mut offset = [[0f32; LANES]; 3];
    let mut middles = [(Vec3::zeros(), Vec3::zeros()); 8];
    let mut there = [false; 8];
    for (k, part) in parts.iter().enumerate() {
        there[k] = (0..3).all(|a| part.hi[a] > part.lo[a]);
        if there[k] {
            middles[k] = space.middle(part);
            for a in 0..3 {
                offset[a][k] = (middles[k].0[a] - c[a]) as f32;
            }
        }
    }
    let level_at = |t: &Candidate| -> [f32; LANES] {
        std::array::from_fn(|k| {
            t.level
                + (t.slope[0] * offset[0][k]
                    + t.slope[1] * offset[1][k]
                    + t.slope[2] * offset[2][k])
        })
    };
    let mut least = [f32::MAX; LANES];
    let mut first = [0u32; LANES];
    for t in list {
        let level = level_at(t);
        for k in 0..LANES {
            first[k] = if level[k] < least[k] { t.facet } else { first[k] };
            least[k] = if level[k] < least[k] { level[k] } else { least[k] };
        }
    }
    let mut slope = [[0f32; LANES]; 3];
    let mut half = [[0f32; LANES]; 3];
    let mut bound = [-f32::MAX; LANES];
    for k in 0..8 {
        if there[k] {
            let (c, h) = &middles[k];
            let nearest = triangle::closest(&space.facet(first[k]).corners, c);
            let r = Reference::new(c, &nearest, h);
            for a in 0..3 {
                slope[a][k] = r.slope[a];
                half[a][k] = r.half[a];
            }
            bound[k] = r.distance + r.sag - tolerance;
        }
    }
    for t in list {
        let level = level_at(t);
        let mut keep = 0u32;
        for k in 0..LANES {
            let reach = (t.slope[0] - slope[0][k]).abs() * half[0][k]
                + (t.slope[1] - slope[1][k]).abs() * half[1][k]
                + (t.slope[2] - slope[2][k]).abs() * half[2][k];
            keep |= u32::from(level[k] - reach <= bound[k]) << k;
        }
        while keep != 0 {
            let k = keep.trailing_zeros() as usize;
            keep &= keep - 1;
            let mut part = Candidate { level: level[k], slope: t.slope, facet: t.facet };
            if sharpen {
                // A tangent plane at the part's own centre.
                let (c, _) = &middles[k];
                let q = triangle::closest(&space.facet(t.facet).corners, c);
                (part.level, part.slope) = tangent(c, &q);
                let reach: f32 =
                    (0..3).map(|a| (part.slope[a] - slope[a][k]).abs() * half[a][k]).sum();
                if part.level - reach > bound[k] {
                    continue;
                }
            }
            push(&mut to[k], part)?;
        }
    }
    Ok(())
}

/// The distances of at most 2³ cells.
fn finish(space: &Space, brick: &Brick, list: &[Candidate], z0: usize, out: &mut [f32]) {
    let (c, _) = space.middle(brick);
    // Absent cells are copies of the present ones.
    let cell = |k: usize| -> [usize; 3] {
        std::array::from_fn(|a| (brick.lo[a] + (k >> a & 1)).min(brick.hi[a] - 1))
    };
    let at: [Lanes; 3] = std::array::from_fn(|a| {
        std::array::from_fn(|k| (cell(k)[a] as f64 + 0.5) * space.spacing[a])
    });
    let offset: [[f32; LANES]; 3] =
        std::array::from_fn(|a| std::array::from_fn(|k| (at[a][k] - c[a]) as f32));
    let mut first = list[0];
    for t in list {
        if t.level < first.level {
            first = *t;
        }
    }
    let mut best = space.facet(first.facet).squared(&at[0], &at[1], &at[2]);
    let bound = |best: &Lanes| -> [f32; LANES] {
        std::array::from_fn(|k| best[k].sqrt() as f32 - TOLERANCE[3])
    };
    let mut limit = bound(&best);
    for t in list {
        let mut needed = false;
        for k in 0..LANES {
            let level = t.level
                + (t.slope[0] * offset[0][k]
                    + t.slope[1] * offset[1][k]
                    + t.slope[2] * offset[2][k]);
            needed |= level < limit[k];
        }
        if needed && t.facet != first.facet {
            let d = space.facet(t.facet).squared(&at[0], &at[1], &at[2]);
            for k in 0..LANES {
                best[k] = if d[k] < best[k] { d[k] } else { best[k] };
            }
            limit = bound(&best);
        }
    }
    let [nx, ny, _] = space.dims;
    for (k, d) in best.iter().enumerate() {
        let [i, j, l] = cell(k);
        out[i + nx * (j + ny * (l - z0))] = (d.sqrt() * space.unit) as f32;
    }
}
