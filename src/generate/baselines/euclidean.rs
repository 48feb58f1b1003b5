//! The greatest ball in what is left of the body, again and again: the Euclidean method of CLUMP
//! (Angelidakis et al. 2021). Each ball is shrunk by the overlap and taken from the body.
//!
//! What is left has, at p, the depth min(d(p), minᵢ |p − cᵢ| − (1 − overlap) rᵢ): only the first
//! needs the surface, so no transform is repeated. The deepest cell is where the search starts;
//! the ball's centre is found between the cells.

use super::super::GenerateOptions;
use super::climb::climb;
use super::ground::Ground;
use super::growing::Growing;
use crate::clump::{Clump, Stopped};
use crate::error::{Result, filled, reserve};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::solid::{Grid, Solid};

/// Depths that differ by less count as equal, and less counts as none, in cells.
const EQUAL: f64 = 1e-4;

/// Makes a clump.
pub(in super::super) fn euclidean(
    solid: &Solid,
    options: &GenerateOptions,
    run: &Run,
) -> Result<Clump> {
    super::check(options, "euclidean")?;
    run.check(0.0, "measuring the distances of cells")?;
    let ground = Ground::new(solid, options, run)?;
    let mut left = Left::new(&ground, run)?;
    let mut growing = Growing::new(&ground, options)?;
    let part = 1.0 - options.overlap;
    let stopped = loop {
        if let Some(stopped) = growing.done(run) {
            break stopped;
        }
        let Some(cell) = left.deepest() else { break Stopped::Exhausted };
        left.drop(cell);
        run.count(|c| c.spheres_tried += 1);
        let Some(sphere) = greatest(&ground, &left.center(cell), growing.spheres(), part)? else {
            continue;
        };
        if sphere.radius < ground.least {
            break Stopped::Radius;
        }
        left.cut(&sphere.center, part * sphere.radius);
        growing.add(sphere)?;
    };
    growing.end(stopped, "nothing is left of the cells; a finer grid takes more", run)
}

/// The greatest ball about a place near `p`, if `p` is in what is left: it keeps to the surface
/// and out of `part` of the radius of each ball before it.
fn greatest(ground: &Ground, p: &Vec3, before: &[Sphere], part: f64) -> Result<Option<Sphere>> {
    let apart = |p: &Vec3, all: &[Sphere]| {
        let room = all.iter().map(|s| (p - s.center).norm() - part * s.radius);
        room.fold(f64::MAX, f64::min)
    };
    let depth = ground.depth(p);
    let value = (depth + ground.tolerance).min(apart(p, before));
    if depth <= 0.0 || value <= 0.0 {
        return Ok(None);
    }
    // What can matter where the search may come to: it seldom leaves the cells around.
    let reach = 2.0 * ground.cell;
    let mut close = reserve("the spheres around", before.len())?;
    close.extend(
        before
            .iter()
            .copied()
            .filter(|s| (p - s.center).norm() - part * s.radius < value + 2.0 * reach),
    );
    let f = |q: &Vec3| {
        let away = (q - p).norm();
        let room = apart(q, &close);
        if away > reach || room <= value {
            return room.min(0.0);
        }
        let depth = ground.depth_from(q, p, depth);
        if depth > 0.0 { (depth + ground.tolerance).min(room) } else { depth }
    };
    let (center, radius) = climb(*p, value, 0.5 * ground.cell, f);
    Ok(Some(Sphere::new(center, radius)))
}

/// The depth of cells in what is left.
struct Left<'a> {
    grid: &'a Grid,
    depth: Vec<f32>,
    /// The greatest of each row along x.
    rows: Vec<f32>,
    centroid: Vec3,
    equal: f32,
}

impl<'a> Left<'a> {
    fn new(ground: &'a Ground, run: &Run) -> Result<Left<'a>> {
        let grid = ground.solid.grid();
        let distance = ground.solid.distance(run)?;
        let mut depth = filled("the depths of cells", distance.len(), 0f32)?;
        for (to, d) in depth.iter_mut().zip(distance) {
            if *d < 0.0 {
                *to = (ground.tolerance - f64::from(*d)) as f32;
            }
        }
        let mut rows = filled("the depths of rows", grid.dims[1] * grid.dims[2], 0f32)?;
        for (to, row) in rows.iter_mut().zip(depth.chunks_exact(grid.dims[0].max(1))) {
            *to = greatest_of(row);
        }
        let centroid = ground.solid.unit_moments().centroid;
        Ok(Left { grid, depth, rows, centroid, equal: (EQUAL * ground.cell) as f32 })
    }

    fn center(&self, cell: usize) -> Vec3 {
        let [nx, ny, _] = self.grid.dims;
        self.grid.center(cell % nx, cell / nx % ny, cell / (nx * ny))
    }

    /// The deepest cell; of equal ones that nearest to the centre of mass, then the first.
    fn deepest(&self) -> Option<usize> {
        let best = greatest_of(&self.rows);
        if best <= self.equal {
            return None;
        }
        let nx = self.grid.dims[0];
        let mut found: Option<(f64, usize)> = None;
        // Ways that rounding alone tells apart are equal.
        let equal = f64::from(self.equal) * self.grid.spacing.amax();
        for (row, top) in self.rows.iter().enumerate() {
            if *top < best - self.equal {
                continue;
            }
            for (i, d) in self.depth.iter().enumerate().skip(row * nx).take(nx) {
                if *d < best - self.equal {
                    continue;
                }
                let away = (self.center(i) - self.centroid).norm_squared();
                if found.is_none_or(|(least, _)| away < least - equal) {
                    found = Some((away, i));
                }
            }
        }
        found.map(|(_, i)| i)
    }

    /// No ball starts from this cell again.
    fn drop(&mut self, cell: usize) {
        if let Some(d) = self.depth.get_mut(cell) {
            *d = 0.0;
        }
        self.sum_up(cell / self.grid.dims[0].max(1));
    }

    fn sum_up(&mut self, row: usize) {
        let nx = self.grid.dims[0];
        if let (Some(to), Some(of)) =
            (self.rows.get_mut(row), self.depth.get(row * nx..(row + 1) * nx))
        {
            *to = greatest_of(of);
        }
    }

    /// Takes a ball away.
    fn cut(&mut self, center: &Vec3, radius: f64) {
        // Farther away no depth is as great as the way to the ball.
        let reach = radius + f64::from(greatest_of(&self.rows));
        let range = |a: usize| {
            let at = |x: f64| ((x - self.grid.origin[a]) / self.grid.spacing[a]).max(0.0) as usize;
            let last = self.grid.dims[a];
            at(center[a] - reach).min(last)..(at(center[a] + reach) + 1).min(last)
        };
        let [x, y, z] = [range(0), range(1), range(2)];
        for k in z {
            for j in y.clone() {
                let row = j + self.grid.dims[1] * k;
                if self.rows.get(row).is_none_or(|top| *top <= 0.0) {
                    continue;
                }
                for i in x.clone() {
                    let way = ((self.grid.center(i, j, k) - center).norm() - radius) as f32;
                    let at = self.grid.index(i, j, k);
                    if let Some(d) = self.depth.get_mut(at) {
                        *d = d.min(way);
                    }
                }
                self.sum_up(row);
            }
        }
    }
}

fn greatest_of(values: &[f32]) -> f32 {
    values.iter().fold(0.0, |m, v| m.max(*v))
}
