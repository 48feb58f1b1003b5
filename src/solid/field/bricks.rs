//! Unsigned distances from cell centres to triangles, by bricks that are cut in eight
//! from the whole grid down to 4³ cells.
//!
//! Each brick has the features (faces, edges, corners) that may be nearest somewhere in
//! it, or clusters of them while it is large, and a witness: a point of the surface near its
//! middle. What is nearest anywhere is never dropped (see [`super::split`]): the distances
//! are right up to the rounding of f32 (and [`super::regions::SLACK`], where regions meet).

use super::features::Features;
use super::leaf;
use super::regions::LANES;
use super::space::{Brick, Space};
use super::split::{Candidates, Lists, open, split, split_clusters};
use crate::error::{Error, Result, filled, fits, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Mesh;
use crate::solid::grid::Grid;

/// Cells along the edge of the bricks that are shared out to threads.
const SHARE: usize = 32;
/// More cuts than such a brick needs.
const DEPTH: usize = 8;

/// What all bricks have in common.
struct Work {
    features: Features,
    space: Space,
}

/// A brick that one thread makes, with the clusters that may be nearest in it.
struct Task {
    brick: Brick,
    clusters: Vec<u32>,
    witness: Vec3,
}

/// Writes the unsigned distances at all cell centres. Takes no more than `room` bytes for that;
/// returns the most that it took at a time.
pub(super) fn distances(
    mesh: &Mesh,
    grid: &Grid,
    room: u64,
    run: &Run,
    out: &mut [f32],
) -> Result<u64> {
    let unit = grid.spacing.min();
    let features = Features::new(mesh, grid, unit, room)?;
    let room = room - features.bytes;
    let mut most = features.bytes;
    let Some(first) = mesh.faces.first() else {
        return Err(Error::Empty("the mesh has no face".into()));
    };
    let witness = (mesh.vertices[first[0] as usize] - grid.origin) / unit;
    let mut clusters = reserve("the candidates of a brick", features.clusters.len())?;
    clusters.extend(0..features.clusters.len() as u32);
    let work = Work { features, space: Space::new(grid, unit)? };
    let whole = Task { brick: Brick { lo: [0; 3], hi: grid.dims }, clusters, witness };
    let mut done = 0;
    let mut make = |tasks: &[Task]| {
        run.check(done as f64 / grid.len() as f64, "making the distance field")?;
        // Any number of threads may be at work on as many of them.
        let share = room / tasks.len().max(1) as u64;
        let blocks = run.pool().map(tasks.len(), |k| work.block(&tasks[k], share));
        let mut bytes = work.features.bytes;
        for (task, block) in tasks.iter().zip(blocks) {
            let ((block, taken), part) = (block?, &task.brick);
            bytes += taken;
            let [width, rows, _] = part.size();
            for (row, values) in block.chunks(width.max(1)).enumerate() {
                let at = grid.index(part.lo[0], part.lo[1] + row % rows, part.lo[2] + row / rows);
                for (o, v) in out[at..at + width].iter_mut().zip(values) {
                    *o = (f64::from(*v) * unit) as f32;
                }
            }
            done += block.len();
        }
        most = most.max(bytes);
        Ok(())
    };
    work.cut(whole, &mut make)?;
    Ok(most)
}

impl Work {
    /// Cuts large bricks into tasks, and has those that come from one brick made together.
    fn cut(&self, task: Task, make: &mut dyn FnMut(&[Task]) -> Result<()>) -> Result<()> {
        if task.brick.longest() <= SHARE {
            return make(&[task]);
        }
        let (f, clusters) = (&self.features, &task.clusters);
        let parts = self.space.parts(&task.brick);
        let (witnesses, marks) = split_clusters(f, &self.space, &parts, clusters, &task.witness)?;
        let mut tasks = reserve("the parts of a brick", LANES)?;
        for (k, &brick) in parts.bricks.iter().enumerate() {
            if parts.there >> k & 1 == 1 {
                let mut kept = reserve("the candidates of a brick", clusters.len())?;
                let held = clusters.iter().zip(&marks).filter(|(_, m)| **m >> k & 1 == 1);
                kept.extend(held.map(|(c, _)| c));
                tasks.push(Task { brick, clusters: kept, witness: witnesses[k] });
            }
        }
        if tasks.iter().all(|t| t.brick.longest() <= SHARE) {
            return make(&tasks);
        }
        tasks.into_iter().try_for_each(|task| self.cut(task, make))
    }

    /// The distances of a task's brick, in shortest cell edges; and the bytes that it took, which
    /// are no more than `room` but for the last doubling of a list.
    fn block(&self, task: &Task, room: u64) -> Result<(Vec<f32>, u64)> {
        let mut out =
            filled("a block of the distance field", task.brick.size().iter().product(), 0.0)?;
        let (f, parts) = (&self.features, self.space.parts(&task.brick));
        let clusters = &task.clusters;
        let (witnesses, marks) = split_clusters(f, &self.space, &parts, clusters, &task.witness)?;
        let mut lists = <[Candidates; 8]>::default();
        open(f, &self.space, &parts, clusters, &marks, &witnesses, &mut lists)?;
        let mut work: Vec<Lists> = (0..DEPTH).map(|_| Lists::default()).collect();
        let held = 4 * out.len() as u64 + 5 * clusters.len() as u64;
        let mut bytes = held;
        for (k, part) in parts.bricks.iter().enumerate() {
            if parts.there >> k & 1 == 1 {
                self.fill(part, &lists[k], &witnesses[k], &task.brick, &mut work, &mut out)?;
                let candidates = lists.iter().map(Candidates::bytes).sum::<u64>();
                bytes = held + candidates + work.iter().map(Lists::bytes).sum::<u64>();
                let what = format_args!("the faces that may be nearest to {} cells", out.len());
                fits(what, bytes, room)?;
            }
        }
        Ok((out, bytes))
    }

    /// The distances of a brick, within the block that is being made.
    fn fill(
        &self,
        brick: &Brick,
        candidates: &Candidates,
        witness: &Vec3,
        block: &Brick,
        work: &mut [Lists],
        out: &mut [f32],
    ) -> Result<()> {
        if brick.longest() <= 4 {
            leaf::fill(&self.features, &self.space, brick, candidates, witness, block, out);
            return Ok(());
        }
        let Some((lists, work)) = work.split_first_mut() else {
            return Err(Error::Internal("a brick was cut too often".into()));
        };
        let parts = self.space.parts(brick);
        let witnesses = split(&self.features, &self.space, &parts, candidates, witness, lists)?;
        for (k, part) in parts.bricks.iter().enumerate() {
            if !part.is_empty() {
                self.fill(part, &lists.parts[k], &witnesses[k], block, work, out)?;
            }
        }
        Ok(())
    }
}
