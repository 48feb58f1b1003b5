//! Unsigned distances from cell centres to triangles, by bricks that are cut in eight
//! from the whole grid down to 4³ cells.
//!
//! Each brick has the features (faces, edges, corners) that may be nearest somewhere in
//! it, and a witness: a point w of the surface near its middle. A feature is not handed on
//! to a part of the brick when its region (see [`super::features`]) misses the part, or when
//! the part's witness is nearer everywhere in the part. The squared distances to a plane, to
//! a line and to a point are all |x|² plus a concave function of x, and so is |x − w|² with a
//! linear one: their difference is concave, and least at a corner of the part. So eight
//! points decide, exactly. Nothing that is nearest anywhere is ever dropped: the distances
//! are right up to the rounding of f32 (and [`features::SLACK`], where regions meet).

use super::features::{self, FAR, Feature, Features, LANES, Lanes, Points};
use crate::error::{Error, Result, filled, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Mesh;
use crate::solid::grid::Grid;

/// Cells along the edge of the bricks that are shared out to threads.
const SHARE: usize = 40;
/// More cuts than a grid needs: fewer than 2³² cells along an axis.
const DEPTH: usize = 33;

/// Cells `lo..hi` along each axis.
#[derive(Debug, Clone, Copy)]
struct Brick {
    lo: [usize; 3],
    hi: [usize; 3],
}

impl Brick {
    fn size(&self) -> [usize; 3] {
        std::array::from_fn(|a| self.hi[a].saturating_sub(self.lo[a]))
    }

    fn longest(&self) -> usize {
        self.size().into_iter().fold(0, usize::max)
    }

    fn is_empty(&self) -> bool {
        self.size().contains(&0)
    }

    /// Its eight parts, x fastest; some may be empty. Cut where both sides are whole numbers
    /// of bricks of 8 cells, or of 4, or of 2.
    fn parts(&self) -> [Brick; 8] {
        let unit = match self.longest() {
            9.. => 8,
            5.. => 4,
            _ => 2,
        };
        std::array::from_fn(|k| {
            let mut part = *self;
            for (a, n) in self.size().into_iter().enumerate() {
                let cut = self.lo[a] + n.min(n.div_ceil(unit).div_ceil(2) * unit);
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

struct Space {
    features: Features,
    /// In shortest cell edges.
    spacing: Vec3,
    unit: f64,
}

impl Space {
    /// Middle of the brick's cell centres and their half extents.
    fn middle(&self, b: &Brick) -> (Vec3, Vec3) {
        let c = Vec3::from_fn(|a, _| 0.5 * (b.lo[a] + b.hi[a]) as f64);
        let half = Vec3::from_fn(|a, _| 0.5 * b.size()[a].saturating_sub(1) as f64);
        (c.component_mul(&self.spacing), half.component_mul(&self.spacing))
    }

    /// The middles of the eight parts of a brick.
    fn middles(&self, parts: &[Brick; 8]) -> Points {
        let (low, _) = self.middle(&parts[0]);
        let (high, _) = self.middle(&parts[7]);
        Points::new(std::array::from_fn(|a| [low[a], high[a]]))
    }

    /// The centres of a group of at most 2³ cells; absent ones are copies of present ones.
    fn centers(&self, group: &Brick) -> Points {
        let at = |i: usize, a: usize| (i as f64 + 0.5) * self.spacing[a];
        Points::new(std::array::from_fn(|a| {
            [at(group.lo[a], a), at(group.hi[a].saturating_sub(1).max(group.lo[a]), a)]
        }))
    }
}

/// Writes the unsigned distances at all cell centres.
pub(super) fn distances(mesh: &Mesh, grid: &Grid, run: &Run, out: &mut [f32]) -> Result<()> {
    let unit = grid.spacing.min();
    let features = Features::new(mesh, grid, unit)?;
    let Some(first) = mesh.faces.first() else {
        return Err(Error::Empty("the mesh has no face".into()));
    };
    let witness = (mesh.vertices[first[0] as usize] - grid.origin) / unit;
    let all = |n: usize| -> Result<Vec<u32>> {
        let mut list = reserve("the candidates of a brick", n)?;
        list.extend(0..n as u32);
        Ok(list)
    };
    let candidates = Candidates {
        faces: all(features.faces.len())?,
        edges: all(features.edges.len())?,
        corners: all(features.corners.len())?,
    };
    let space = Space { features, spacing: grid.spacing / unit, unit };
    let whole = Brick { lo: [0; 3], hi: grid.dims };
    descend(&space, &whole, &candidates, &witness, grid, run, out)
}

/// Cuts large bricks on the calling thread and shares out the small ones.
fn descend(
    space: &Space,
    brick: &Brick,
    candidates: &Candidates,
    witness: &Vec3,
    grid: &Grid,
    run: &Run,
    out: &mut [f32],
) -> Result<()> {
    run.check(0.0, "making the distance field")?;
    let parts = brick.parts();
    let mut lists = Lists::default();
    let witnesses = split(space, &parts, candidates, witness, &mut lists)?;
    if brick.longest() > 2 * SHARE {
        for (k, part) in parts.iter().enumerate() {
            if !part.is_empty() {
                descend(space, part, &lists.parts[k], &witnesses[k], grid, run, out)?;
            }
        }
        return Ok(());
    }
    let blocks = run.pool().map(8, |k| -> Result<Vec<f32>> {
        let part = &parts[k];
        if part.is_empty() {
            return Ok(Vec::new());
        }
        let size = part.size().iter().product();
        let mut block = filled("a block of the distance field", size, 0.0)?;
        let mut work: Vec<Lists> = (0..DEPTH).map(|_| Lists::default()).collect();
        fill(space, part, &lists.parts[k], &witnesses[k], part, &mut work, &mut block)?;
        Ok(block)
    });
    for (part, block) in parts.iter().zip(blocks) {
        let block = block?;
        let [width, rows, _] = part.size();
        for (row, values) in block.chunks(width.max(1)).enumerate() {
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
    witness: &Vec3,
    block: &Brick,
    work: &mut [Lists],
    out: &mut [f32],
) -> Result<()> {
    if brick.longest() <= 4 {
        Cells::new(space, brick).fill(space, candidates, witness, block, out);
        return Ok(());
    }
    let Some((lists, work)) = work.split_first_mut() else {
        return Err(Error::Internal("a brick was cut too often".into()));
    };
    let parts = brick.parts();
    let witnesses = split(space, &parts, candidates, witness, lists)?;
    for (k, part) in parts.iter().enumerate() {
        if !part.is_empty() {
            fill(space, part, &lists.parts[k], &witnesses[k], block, work, out)?;
        }
    }
    Ok(())
}

/// The candidates of a brick's parts, and for each candidate of the brick the parts that its
/// region touches.
#[derive(Debug, Default)]
struct Lists {
    parts: [Candidates; 8],
    marks: Vec<u8>,
}

/// The parts of a brick, lane by lane.
struct Parts {
    middle: Points,
    /// Greatest half extent of any.
    reach: f32,
    /// Bits of the parts that are not empty.
    there: u8,
    /// The candidate nearest to each middle, as far as an estimate of its squared distance tells:
    /// three times its index, and 0, 1, 2 for a face, an edge, a corner.
    score: Lanes,
    name: [u32; LANES],
    /// The corners of each part (cell centres), and their squared distances from its witness.
    corners: [Points; 8],
    limit: [Lanes; 8],
}

/// Hands the candidates of a brick to its parts; returns their witnesses.
fn split(
    space: &Space,
    parts: &[Brick; 8],
    candidates: &Candidates,
    witness: &Vec3,
    lists: &mut Lists,
) -> Result<[Vec3; 8]> {
    let mut p = Parts {
        middle: space.middles(parts),
        reach: 0.0,
        there: 0,
        score: [FAR; LANES],
        name: [u32::MAX; LANES],
        corners: [Points::default(); 8],
        limit: [[FAR; LANES]; 8],
    };
    for (k, part) in parts.iter().enumerate() {
        if !part.is_empty() {
            p.there |= 1 << k;
            p.reach = p.reach.max(space.middle(part).1.max() as f32);
        }
    }
    let f = &space.features;
    lists.marks.clear();
    touch(&f.faces, &candidates.faces, 0, &mut p, &mut lists.marks)?;
    touch(&f.edges, &candidates.edges, 1, &mut p, &mut lists.marks)?;
    touch(&f.corners, &candidates.corners, 2, &mut p, &mut lists.marks)?;
    let mut witnesses = [*witness; 8];
    for (k, part) in parts.iter().enumerate() {
        lists.parts[k].faces.clear();
        lists.parts[k].edges.clear();
        lists.parts[k].corners.clear();
        if p.there >> k & 1 == 0 {
            continue;
        }
        let (c, _) = space.middle(part);
        let q = match (p.name[k] / 3, p.name[k] % 3) {
            _ if p.name[k] == u32::MAX => *witness,
            (i, 0) => f.on_face(i, &c),
            (i, 1) => f.on_edge(i, &c),
            (i, _) => f.on_corner(i),
        };
        if (q - c).norm_squared() < (witness - c).norm_squared() {
            witnesses[k] = q;
        }
        p.corners[k] = space.centers(part);
        features::nearer_point(&features::single(&witnesses[k]), &p.corners[k], &mut p.limit[k]);
        for limit in &mut p.limit[k] {
            let d = limit.sqrt() + features::SLACK;
            *limit = d * d;
        }
    }
    let (faces, marks) = lists.marks.split_at(candidates.faces.len());
    let (edges, corners) = marks.split_at(candidates.edges.len());
    hand_on(&f.faces, &candidates.faces, faces, &p, &mut lists.parts, |c| &mut c.faces)?;
    hand_on(&f.edges, &candidates.edges, edges, &p, &mut lists.parts, |c| &mut c.edges)?;
    hand_on(&f.corners, &candidates.corners, corners, &p, &mut lists.parts, |c| &mut c.corners)?;
    Ok(witnesses)
}

/// Marks the parts that the regions of candidates of one kind touch, and finds the nearest.
#[inline(never)]
fn touch<F: Feature>(
    features: &[F],
    candidates: &[u32],
    kind: u32,
    p: &mut Parts,
    marks: &mut Vec<u8>,
) -> Result<()> {
    marks.try_reserve(candidates.len()).map_err(|_| out_of_memory())?;
    for &i in candidates {
        let (touch, score) = features[i as usize].region(&p.middle, p.reach);
        let name = i * 3 + kind;
        for k in 0..LANES {
            let here = if touch[k] >= 0.0 { score[k] } else { FAR };
            p.name[k] = if here < p.score[k] { name } else { p.name[k] };
            p.score[k] = features::least(here, p.score[k]);
        }
        marks.push(features::bits(&touch) & p.there);
    }
    Ok(())
}

/// Hands candidates of one kind on to the parts that they touch and may be nearest in.
#[inline(never)]
fn hand_on<F: Feature>(
    features: &[F],
    candidates: &[u32],
    marks: &[u8],
    p: &Parts,
    lists: &mut [Candidates; 8],
    list: impl Fn(&mut Candidates) -> &mut Vec<u32>,
) -> Result<()> {
    for (&i, &mark) in candidates.iter().zip(marks) {
        let mut mark = mark;
        while mark != 0 {
            let k = mark.trailing_zeros() as usize;
            mark &= mark - 1;
            let mut margin = features[i as usize].bound(&p.corners[k]);
            for (m, limit) in margin.iter_mut().zip(&p.limit[k]) {
                *m = limit - *m;
            }
            if features::bits(&margin) == 0 {
                continue;
            }
            let to = list(&mut lists[k]);
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

/// At most 4³ cells, in eight groups of at most 2³.
struct Cells {
    parts: [Brick; 8],
    there: u8,
    /// Middles of the groups, and the greatest half extent of any.
    middle: Points,
    reach: f32,
    /// The cell centres of each group, and their squared distances.
    at: [Points; 8],
    best: [Lanes; 8],
}

impl Cells {
    fn new(space: &Space, brick: &Brick) -> Cells {
        let parts = brick.parts();
        let mut c = Cells {
            there: 0,
            middle: space.middles(&parts),
            reach: 0.0,
            at: [Points::default(); 8],
            best: [[FAR; LANES]; 8],
            parts,
        };
        for (g, part) in parts.iter().enumerate() {
            if !part.is_empty() {
                c.there |= 1 << g;
                c.reach = c.reach.max(space.middle(part).1.max() as f32);
                c.at[g] = space.centers(part);
            }
        }
        c
    }

    fn fill(
        &mut self,
        space: &Space,
        candidates: &Candidates,
        witness: &Vec3,
        block: &Brick,
        out: &mut [f32],
    ) {
        let f = &space.features;
        self.take(&f.faces, &candidates.faces);
        self.take(&f.edges, &candidates.edges);
        self.take(&f.corners, &candidates.corners);
        let [nx, ny, _] = block.size();
        for (g, part) in self.parts.iter().enumerate() {
            if self.there >> g & 1 == 0 {
                continue;
            }
            let best = &mut self.best[g];
            // Only where rounding has opened a gap between regions.
            features::nearer_point(&features::single(witness), &self.at[g], best);
            for (k, &d) in best.iter().enumerate() {
                let c = cell(part, k);
                let [i, j, l]: [usize; 3] = std::array::from_fn(|a| c[a] - block.lo[a]);
                out[i + nx * (j + ny * l)] = (f64::from(d).sqrt() * space.unit) as f32;
            }
        }
    }

    /// Lowers the distances of the groups that the candidates' regions touch.
    #[inline(never)]
    fn take<F: Feature>(&mut self, features: &[F], candidates: &[u32]) {
        for &i in candidates {
            let feature = &features[i as usize];
            let mut mark = feature.touches(&self.middle, self.reach) & self.there;
            while mark != 0 {
                let g = mark.trailing_zeros() as usize;
                mark &= mark - 1;
                feature.nearer(&self.at[g], &mut self.best[g]);
            }
        }
    }
}

/// Cell `k` of a group; absent ones are copies of present ones.
fn cell(part: &Brick, k: usize) -> [usize; 3] {
    std::array::from_fn(|a| (part.lo[a] + (k >> a & 1)).min(part.hi[a] - 1))
}
