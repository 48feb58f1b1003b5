//! Where spheres may go: the maxima of E and of 2E − Ẽ, between the cells, and,
//! since these run out on bodies with edges (on a cube 2E − Ẽ has no maximum
//! beside the first), the places from which the deepest cells still
//! uncovered are reached.

use super::lattice::Lattice;
use super::maxima::{WHAT, maxima, thin};
use super::subvoxel::along_axis;
use super::target::{Target, value};
use super::transform;
use crate::error::{Error, Result, collected, filled, push};
use crate::run::Run;
use std::collections::HashSet;

/// A place for a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub center: [f64; 3],
    /// Radius of a sphere here, by E.
    pub deep: f64,
    /// A ball about the place that the clump covers, so that no more than the shell is new.
    pub covered: f64,
    /// A maximum of E itself, that may be refined.
    pub peak: bool,
}

/// The fields that are made anew in every round.
pub(super) struct Fields {
    field: Vec<f32>,
    rest: Vec<u64>,
    /// Blocks of cells of which one has been handed out.
    seen: HashSet<[u32; 4]>,
}

impl Fields {
    pub fn new(target: &Target) -> Result<Fields> {
        Ok(Fields {
            field: filled("the transform of the clump", target.distance.len(), 0f32)?,
            rest: filled("the uncovered cells", target.bits.len(), 0u64)?,
            seen: HashSet::new(),
        })
    }

    pub fn bytes(&self) -> usize {
        self.field.len() * 4 + self.rest.len() * 8
    }

    /// Bits that are overwritten in each round.
    pub fn spare(&mut self) -> &mut [u64] {
        &mut self.rest
    }

    /// The maxima of E.
    pub fn of_target(&mut self, target: &Target, run: &Run) -> Result<Vec<Place>> {
        let mut places = Vec::new();
        for (_, cell) in peaks(target, &target.distance, run)? {
            if self.fresh(target, &cell)? {
                push(WHAT, &mut places, between(target, &target.distance, &cell, true))?;
            }
        }
        Ok(places)
    }

    /// The places that the clump which covers `covered` leaves: the maxima of E* = 2E − Ẽ
    /// (equation 25), and those from which the deepest uncovered cells are reached, as
    /// deep as `part` of the deepest.
    pub fn of_clump(
        &mut self,
        target: &Target,
        covered: &[u64],
        part: f32,
        run: &Run,
    ) -> Result<Vec<Place>> {
        let stops = self.of_rest(target, covered, part, run)?;
        transform::distance(&target.lattice, covered, near(target), &mut self.field, run.pool())?;
        run.count(|c| c.transforms += 1);
        let slab = target.lattice.dims[0] * target.lattice.dims[1];
        run.pool().chunks_mut(&mut self.field, slab, |k, slab| {
            let e = target.distance.get(k * slab.len()..).unwrap_or(&[]);
            for (clump, e) in slab.iter_mut().zip(e) {
                *clump = 2.0 * e - *clump;
            }
        });
        let mut places = Vec::new();
        for (_, cell) in peaks(target, &self.field, run)? {
            if target.at(cell.map(i64::from)) > 0.0 && self.fresh(target, &cell)? {
                push(WHAT, &mut places, between(target, &self.field, &cell, false))?;
            }
        }
        for cell in stops {
            if self.fresh(target, &cell)? {
                let deep = f64::from(target.at(cell.map(i64::from)));
                let deficit = f64::from(value(&self.field, &target.lattice, cell.map(i64::from)));
                let place = Place {
                    center: center(&target.lattice, &cell),
                    deep,
                    covered: (2.0 * deep - deficit).max(0.0),
                    peak: false,
                };
                push(WHAT, &mut places, place)?;
            }
        }
        Ok(places)
    }

    /// Cells from which uncovered ones are reached: from each local maximum of the distance
    /// transform of the uncovered solid cells uphill on E, as far as a ball there
    /// still holds the start; stops on the way count as well.
    fn of_rest(
        &mut self,
        target: &Target,
        covered: &[u64],
        part: f32,
        run: &Run,
    ) -> Result<Vec<[u32; 3]>> {
        for ((rest, solid), covered) in self.rest.iter_mut().zip(&target.bits).zip(covered) {
            *rest = solid & !covered;
        }
        let cells = near(target);
        transform::distance(&target.lattice, &self.rest, cells, &mut self.field, run.pool())?;
        run.count(|c| c.transforms += 1);
        let mut found = peaks(target, &self.field, run)?;
        // The deepest comes first.
        let least = found.first().map_or(0.0, |deepest| deepest.0) * part;
        found.retain(|(depth, _)| *depth >= least);
        let stops = |n: usize| {
            let mut cells = Vec::new();
            for (_, start) in found.iter().skip(n * CHUNK).take(CHUNK) {
                let path = uphill(target, *start)?;
                let last = path.len() - 1;
                let mut stops = [0, last.div_ceil(3), (2 * last).div_ceil(3), last].to_vec();
                stops.dedup();
                for cell in stops.into_iter().filter_map(|s| path.get(s)) {
                    if target.mirrors.stands(cell) {
                        push(WHAT, &mut cells, *cell)?;
                    }
                }
            }
            Ok(cells)
        };
        let cells = run.pool().map(found.len().div_ceil(CHUNK), stops);
        let cells = cells.into_iter().collect::<Result<Vec<_>>>()?;
        collected(WHAT, cells.into_iter().flatten())
    }

    /// Marks the block of the cell; whether it was new. Where E is great, places that lie
    /// a small part of E apart are as good as one.
    fn fresh(&mut self, target: &Target, cell: &[u32; 3]) -> Result<bool> {
        let across = (f64::from(target.at(cell.map(i64::from))) / FINE).max(1.0) as u32;
        let level = across.ilog2();
        let [i, j, k] = cell.map(|n| n >> level);
        self.seen.try_reserve(1).map_err(|_| {
            Error::OutOfMemory(format!("no memory for more than {} blocks seen", self.seen.len()))
        })?;
        Ok(self.seen.insert([level, i, j, k]))
    }
}

/// Ways up that are looked for together.
const CHUNK: usize = 16;

/// Places nearer to each other than E over this (or half of that) count as one.
const FINE: f64 = 8.0;

/// The maxima of a field that stand for their mirror images, without the crowd of large plateaus:
/// their values and cells, the greatest first, equals in the order of the array.
fn peaks(target: &Target, field: &[f32], run: &Run) -> Result<Vec<(f32, [u32; 3])>> {
    let part = target.mirrors.part_dims(target.lattice.dims);
    let found = maxima(&target.lattice, field, part, run.pool())?;
    run.count(|c| c.maxima += found.len() as u64);
    let value = |c: &[u32; 3]| value(field, &target.lattice, c.map(i64::from));
    let kept = thin(found, value, f64::from)?;
    let mut standing = collected(WHAT, kept.iter().map(|c| (value(c), *c)))?;
    let place = |[i, j, k]: [u32; 3]| [k, j, i];
    standing.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(place(a.1).cmp(&place(b.1))));
    Ok(standing)
}

/// The cells that the maxima on the low side of the mirror planes depend on.
fn near(target: &Target) -> [usize; 3] {
    let dims = target.lattice.dims;
    let part = target.mirrors.part_dims(dims);
    std::array::from_fn(|a| (part[a] + 3).min(dims[a]))
}

fn center(lattice: &Lattice, cell: &[u32; 3]) -> [f64; 3] {
    std::array::from_fn(|a| f64::from(cell[a]) * lattice.step[a])
}

/// The maximum near a cell, between the cells (Buchele et al. 2026, section 3.3).
fn between(target: &Target, field: &[f32], cell: &[u32; 3], peak: bool) -> Place {
    let lattice = &target.lattice;
    let mut at = center(lattice, cell);
    for (a, x) in at.iter_mut().enumerate() {
        let e = std::array::from_fn(|n| {
            let mut q = cell.map(i64::from);
            q[a] += n as i64 - 2;
            f64::from(value(field, lattice, q))
        });
        *x += along_axis(&e).0 * lattice.step[a];
    }
    if !target.solid_at(&at) {
        at = center(lattice, cell);
    }
    let moved: f64 = at.iter().zip(center(lattice, cell)).map(|(x, c)| (x - c).powi(2)).sum();
    let deep = f64::from(target.at(cell.map(i64::from)));
    // Ẽ = 2E − E*.
    let covered = 2.0 * deep - f64::from(value(field, lattice, cell.map(i64::from)));
    let moved = moved.sqrt();
    let covered = if peak { 0.0 } else { (covered - moved).max(0.0) };
    Place { center: at, deep: deep + moved, covered, peak }
}

/// The cells on the way up on E from `start`, while the ball of radius E about the cell holds the start.
fn uphill(target: &Target, start: [u32; 3]) -> Result<Vec<[u32; 3]>> {
    let from = center(&target.lattice, &start);
    let mut path = vec![start];
    let mut here = start;
    loop {
        let mut best = (target.at(here.map(i64::from)), here);
        for n in 0..27 {
            let d = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
            let q: [i64; 3] = std::array::from_fn(|a| i64::from(here[a]) + d[a]);
            let e = target.at(q);
            if e > best.0 {
                let cell = q.map(|v| v as u32);
                let away: f64 = center(&target.lattice, &cell)
                    .iter()
                    .zip(&from)
                    .map(|(x, y)| (x - y).powi(2))
                    .sum();
                let reach = f64::from(e) - 0.5;
                if away < reach * reach {
                    best = (e, cell);
                }
            }
        }
        if best.1 == here {
            return Ok(path);
        }
        here = best.1;
        push("a way up", &mut path, here)?;
    }
}
