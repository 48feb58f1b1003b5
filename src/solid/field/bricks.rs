//! Unsigned distances from cell centres to triangles, by bricks that are halved from the
//! whole grid down to 2³ cells.
//!
//! Each brick has the features (faces, edges, corners) that may be nearest somewhere in it.
//! A feature is not handed on to a part of the brick when
//! - its region (see [`super::features`]) misses the part, or
//! - a point p* of the surface is as near everywhere in the part, within [`TOLERANCE`]. The
//!   distance to the feature is no less than a convex function, so no less than its tangent
//!   plane at the part's middle c, `d + g·e` at the offset e; and p* is no farther than
//!   `d* + g*·e + ρ²/2d*`, with ρ the greatest |e|. So it is dropped when
//!   `d − Σ |g − g*|ₐ halfₐ > d* + ρ²/2d* − tolerance`.
//!
//! A cell gets the least distance to the features left and to the points p* on its way down,
//! so its error is at most the tolerance (and the rounding of f32).

use super::features::{self, FAR, Feature, Features, LANES, Lanes, Points};
use crate::error::{Error, Result, filled};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Mesh;
use crate::solid::grid::Grid;

/// Error allowed, in shortest cell edges.
const TOLERANCE: f32 = 0.006;
/// Cells along the edge of the bricks that are shared out to threads.
const SHARE: usize = 32;
/// Most halvings: grids have fewer than 2³² cells along an axis.
const DEPTH: usize = 33;

/// Cells `lo..hi` along each axis; `hi - lo <= edge`, a power of two.
#[derive(Debug, Clone, Copy)]
struct Brick {
    lo: [usize; 3],
    hi: [usize; 3],
    edge: usize,
}

impl Brick {
    fn is_empty(&self) -> bool {
        (0..3).any(|a| self.hi[a] <= self.lo[a])
    }

    /// Its eight parts, x fastest; some may be empty.
    fn parts(&self) -> [Brick; 8] {
        let edge = self.edge / 2;
        std::array::from_fn(|k| {
            let mut part = Brick { edge, ..*self };
            for a in 0..3 {
                let cut = (self.lo[a] + edge).min(self.hi[a]);
                if k >> a & 1 == 0 {
                    part.hi[a] = cut;
                } else {
                    part.lo[a] = cut;
                }
            }
            part
        })
    }
}

/// The features of a brick, by kind.
#[derive(Debug, Default)]
struct Candidates {
    faces: Vec<u32>,
    edges: Vec<u32>,
    corners: Vec<u32>,
}

/// Points of the surface that were nearest to the middles of a brick and those around it.
#[derive(Debug, Clone, Copy)]
struct Witnesses {
    points: [[f32; 3]; DEPTH],
    count: usize,
}

impl Witnesses {
    fn all(&self) -> &[[f32; 3]] {
        &self.points[..self.count]
    }
}

struct Space {
    features: Features,
    /// In shortest cell edges.
    spacing: Vec3,
    unit: f64,
}

/// Writes the unsigned distances at all cell centres.
pub(super) fn distances(mesh: &Mesh, grid: &Grid, run: &Run, out: &mut [f32]) -> Result<()> {
    let unit = grid.spacing.min();
    let features = Features::new(mesh, grid, unit)?;
    let Some(&first) = features.faces.first().and(mesh.faces.first()) else {
        return Err(Error::Empty("the mesh has no face".into()));
    };
    let any = (mesh.vertices[first[0] as usize] - grid.origin) / unit;
    let all = Candidates {
        faces: (0..features.faces.len() as u32).collect(),
        edges: (0..features.edges.len() as u32).collect(),
        corners: (0..features.corners.len() as u32).collect(),
    };
    let space = Space { features, spacing: grid.spacing / unit, unit };
    let longest = grid.dims.iter().fold(2, |m, &n| m.max(n));
    let whole = Brick { lo: [0; 3], hi: grid.dims, edge: longest.next_power_of_two() };
    let mut known = Witnesses { points: [[0.0; 3]; DEPTH], count: 1 };
    known.points[0] = features::single(&any);
    descend(&space, &whole, &all, &known, grid, run, out)
}

/// Halves large bricks on the calling thread and shares out the small ones.
fn descend(
    space: &Space,
    brick: &Brick,
    candidates: &Candidates,
    known: &Witnesses,
    grid: &Grid,
    run: &Run,
    out: &mut [f32],
) -> Result<()> {
    run.check(0.0, "making the distance field")?;
    let parts = brick.parts();
    let mut lists = Lists::default();
    let witnesses = split(space, &parts, candidates, known, &mut lists)?;
    if brick.edge > 2 * SHARE {
        for k in 0..8 {
            if !parts[k].is_empty() {
                let (list, known) = (&lists.parts[k], &witnesses[k]);
                descend(space, &parts[k], list, known, grid, run, out)?;
            }
        }
        return Ok(());
    }
    let blocks = run.pool().map(8, |k| -> Result<Vec<f32>> {
        let part = &parts[k];
        if part.is_empty() {
            return Ok(Vec::new());
        }
        let size = (0..3).map(|a| part.hi[a] - part.lo[a]).product();
        let mut block = filled("a block of the distance field", size, 0.0)?;
        let mut work: Vec<Lists> = (0..DEPTH).map(|_| Lists::default()).collect();
        fill(space, part, &lists.parts[k], &witnesses[k], part, &mut work, &mut block)?;
        Ok(block)
    });
    for (part, block) in parts.iter().zip(blocks) {
        let block = block?;
        let width = part.hi[0].saturating_sub(part.lo[0]);
        for (row, values) in block.chunks(width.max(1)).enumerate() {
            let rows = part.hi[1] - part.lo[1];
            let at = grid.index(part.lo[0], part.lo[1] + row % rows, part.lo[2] + row / rows);
            out[at..at + width].copy_from_slice(values);
        }
    }
    Ok(())
}

/// The distances of a brick, within the block that is being made.
fn fill(
    space: &Space,
    brick: &Brick,
    candidates: &Candidates,
    known: &Witnesses,
    block: &Brick,
    work: &mut [Lists],
    out: &mut [f32],
) -> Result<()> {
    if brick.edge <= 2 {
        cells(space, brick, candidates, known, block, out);
        return Ok(());
    }
    let Some((lists, work)) = work.split_first_mut() else {
        return Err(Error::Internal("a brick was halved too often".into()));
    };
    let parts = brick.parts();
    let witnesses = split(space, &parts, candidates, known, lists)?;
    for (k, part) in parts.iter().enumerate() {
        if !part.is_empty() {
            fill(space, part, &lists.parts[k], &witnesses[k], block, work, out)?;
        }
    }
    Ok(())
}

/// The candidates of the parts of a brick, and which of them the regions admit.
#[derive(Debug, Default)]
struct Lists {
    parts: [Candidates; 8],
    faces: Vec<u8>,
    edges: Vec<u8>,
    corners: Vec<u8>,
}

/// The nearest candidate to each part's middle.
struct Nearest {
    /// An estimate of its squared distance.
    score: Lanes,
    /// Three times its index, and 0, 1, 2 for a face, an edge, a corner.
    name: [u32; LANES],
}

/// The upper bounds over the parts of a brick.
struct Bounds {
    middle: Points,
    half: Points,
    /// Greatest half extents of all parts.
    reach: [f32; 3],
    slope: Points,
    /// d* + ρ²/2d* − tolerance.
    bound: Lanes,
    /// Bits of the parts that are not empty.
    there: u8,
}

/// Hands the candidates of a brick to its parts; returns their witnesses.
fn split(
    space: &Space,
    parts: &[Brick; 8],
    candidates: &Candidates,
    known: &Witnesses,
    lists: &mut Lists,
) -> Result<[Witnesses; 8]> {
    let mut b = Bounds {
        middle: [[0.0; LANES]; 3],
        half: [[0.0; LANES]; 3],
        reach: [0.0; 3],
        slope: [[0.0; LANES]; 3],
        bound: [-FAR; LANES],
        there: 0,
    };
    let mut centers = [Vec3::zeros(); 8];
    for (k, part) in parts.iter().enumerate() {
        if part.is_empty() {
            continue;
        }
        b.there |= 1 << k;
        for a in 0..3 {
            centers[k][a] = 0.5 * (part.lo[a] + part.hi[a]) as f64 * space.spacing[a];
            let half = 0.5 * (part.hi[a] - part.lo[a] - 1) as f64 * space.spacing[a];
            b.middle[a][k] = centers[k][a] as f32;
            b.half[a][k] = half as f32;
            b.reach[a] = b.reach[a].max(half as f32);
        }
    }
    let f = &space.features;
    let mut nearest = Nearest { score: [FAR; LANES], name: [u32::MAX; LANES] };
    touch(&f.faces, &candidates.faces, &b, 0, &mut nearest, &mut lists.faces)?;
    touch(&f.edges, &candidates.edges, &b, 1, &mut nearest, &mut lists.edges)?;
    touch(&f.corners, &candidates.corners, &b, 2, &mut nearest, &mut lists.corners)?;

    let mut witnesses = [*known; 8];
    for k in 0..8 {
        if b.there >> k & 1 == 0 {
            continue;
        }
        let c = &centers[k];
        let mut best = match (nearest.name[k] / 3, nearest.name[k] % 3) {
            _ if nearest.name[k] == u32::MAX => None,
            (i, 0) => Some(f.on_face(i, c)),
            (i, 1) => Some(f.on_edge(i, c)),
            (i, _) => Some(f.on_corner(i)),
        };
        // One of those known may be nearer still.
        let mut found = best.map_or(f64::MAX, |q| (q - c).norm_squared());
        let new = best;
        for p in known.all() {
            let p = Vec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]));
            if (p - c).norm_squared() < found {
                (best, found) = (Some(p), (p - c).norm_squared());
            }
        }
        let w = &mut witnesses[k];
        if let (Some(q), true) = (new, w.count < DEPTH) {
            w.points[w.count] = features::single(&q);
            w.count += 1;
        }
        let Some(q) = best else { continue };
        let d = found.sqrt();
        let rho2: f64 = (0..3).map(|a| f64::from(b.half[a][k]).powi(2)).sum();
        let rho = rho2.sqrt();
        let sag = if rho < 4.0 * d { rho2 / (2.0 * d) } else { 2.0 * rho };
        if d > 1e-4 {
            for a in 0..3 {
                b.slope[a][k] = ((c[a] - q[a]) / d) as f32;
            }
        }
        b.bound[k] = (d + sag) as f32 - TOLERANCE;
    }
    for part in &mut lists.parts {
        part.faces.clear();
        part.edges.clear();
        part.corners.clear();
    }
    hand_on(&f.faces, &candidates.faces, &b, &lists.faces, &mut lists.parts, |c| &mut c.faces)?;
    hand_on(&f.edges, &candidates.edges, &b, &lists.edges, &mut lists.parts, |c| &mut c.edges)?;
    let to = &mut lists.parts;
    hand_on(&f.corners, &candidates.corners, &b, &lists.corners, to, |c| &mut c.corners)?;
    Ok(witnesses)
}

/// Marks the parts that the candidates' regions touch, and finds the nearest to the middles.
fn touch<F: Feature>(
    features: &[F],
    candidates: &[u32],
    b: &Bounds,
    kind: u32,
    nearest: &mut Nearest,
    marks: &mut Vec<u8>,
) -> Result<()> {
    marks.clear();
    marks.try_reserve(candidates.len()).map_err(|_| out_of_memory())?;
    for &i in candidates {
        let feature = &features[i as usize];
        let (touch, score) = feature.region(&b.middle, &b.reach);
        let mut mark = 0;
        for (k, &t) in touch.iter().enumerate() {
            mark |= u8::from(t >= 0.0) << k;
        }
        mark &= b.there;
        marks.push(mark);
        let n = &mut *nearest;
        let name = i * 3 + kind;
        for k in 0..LANES {
            let better = touch[k] >= 0.0 && score[k] < n.score[k];
            n.score[k] = if better { score[k] } else { n.score[k] };
            n.name[k] = if better { name } else { n.name[k] };
        }
    }
    Ok(())
}

/// Hands the marked candidates on to the parts where they may be nearer than the bounds.
fn hand_on<F: Feature>(
    features: &[F],
    candidates: &[u32],
    b: &Bounds,
    marks: &[u8],
    parts: &mut [Candidates; 8],
    list: impl Fn(&mut Candidates) -> &mut Vec<u32>,
) -> Result<()> {
    for (&i, &mark) in candidates.iter().zip(marks) {
        if mark == 0 {
            continue;
        }
        let (level, slope) = features[i as usize].tangent(&b.middle);
        let mut keep = 0;
        for k in 0..LANES {
            let reach = (slope[0][k] - b.slope[0][k]).abs() * b.half[0][k]
                + (slope[1][k] - b.slope[1][k]).abs() * b.half[1][k]
                + (slope[2][k] - b.slope[2][k]).abs() * b.half[2][k];
            keep |= u8::from(level[k] - reach <= b.bound[k]) << k;
        }
        keep &= mark;
        while keep != 0 {
            let k = keep.trailing_zeros() as usize;
            keep &= keep - 1;
            let to = list(&mut parts[k]);
            if to.len() == to.capacity() {
                to.try_reserve(to.len().max(64)).map_err(|_| out_of_memory())?;
            }
            to.push(i);
        }
    }
    Ok(())
}

fn out_of_memory() -> Error {
    Error::OutOfMemory("no memory for the candidates of a brick".into())
}

/// The distances of at most 2³ cells.
fn cells(
    space: &Space,
    brick: &Brick,
    candidates: &Candidates,
    known: &Witnesses,
    block: &Brick,
    out: &mut [f32],
) {
    // Absent cells are copies of present ones.
    let cell = |k: usize| -> [usize; 3] {
        std::array::from_fn(|a| (brick.lo[a] + (k >> a & 1)).min(brick.hi[a] - 1))
    };
    let mut x: Points = [[0.0; LANES]; 3];
    for k in 0..LANES {
        let c = cell(k);
        for a in 0..3 {
            x[a][k] = ((c[a] as f64 + 0.5) * space.spacing[a]) as f32;
        }
    }
    let mut best = [FAR; LANES];
    let f = &space.features;
    candidates.faces.iter().for_each(|&i| f.faces[i as usize].nearer(&x, &mut best));
    candidates.edges.iter().for_each(|&i| f.edges[i as usize].nearer(&x, &mut best));
    candidates.corners.iter().for_each(|&i| f.corners[i as usize].nearer(&x, &mut best));
    known.all().iter().for_each(|p| features::nearer_point(p, &x, &mut best));
    let size: [usize; 3] = std::array::from_fn(|a| block.hi[a] - block.lo[a]);
    for (k, &d) in best.iter().enumerate() {
        let c = cell(k);
        let [i, j, l]: [usize; 3] = std::array::from_fn(|a| c[a] - block.lo[a]);
        out[i + size[0] * (j + size[1] * l)] = (f64::from(d).sqrt() * space.unit) as f32;
    }
}
