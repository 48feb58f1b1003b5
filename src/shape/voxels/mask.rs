//! From solid cells to a shape: bounding box, bodies, crop, report.

use super::bodies::Components;
use super::{Layout, Voxels};
use crate::error::{self, Error, Result, figure};
use crate::math::{UnitFrame, Vec3};
use crate::run::{Run, Stage};
use crate::shape::{Bodies, Body, ImportOptions, Report, Shape};
use std::sync::Arc;

impl Shape {
    /// A shape from a mask: cells other than 0 are solid.
    ///
    /// Solid cells that share a face are one body. Cells may touch the border of
    /// the array: nothing is lost there, and the report says so.
    pub fn from_mask(
        mask: &[u8],
        layout: &Layout,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        Shape::from_read_mask(mask, layout, options, 0, run)
    }

    /// As [`Shape::from_mask`], beside `held` bytes of a file's values.
    pub(crate) fn from_read_mask(
        mask: &[u8],
        layout: &Layout,
        options: &ImportOptions,
        held: u64,
        run: &Run,
    ) -> Result<Shape> {
        layout.check(mask.len())?;
        run.time(Stage::Check, || {
            build(&|i| mask.get(i).is_some_and(|&v| v != 0), layout, None, options, held, run)
        })
    }
}

/// A box of cells, the last one included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CellBox {
    pub first: [usize; 3],
    pub last: [usize; 3],
}

impl CellBox {
    fn dims(&self) -> [usize; 3] {
        [0, 1, 2].map(|a| self.last[a] - self.first[a] + 1)
    }

    fn cells(&self) -> u64 {
        self.dims().iter().map(|&n| n as u64).product()
    }

    /// The smallest box that holds both.
    pub fn join(self, other: CellBox) -> CellBox {
        CellBox {
            first: [0, 1, 2].map(|a| self.first[a].min(other.first[a])),
            last: [0, 1, 2].map(|a| self.last[a].max(other.last[a])),
        }
    }

    /// Whether it reaches the border of an array of `dims` cells.
    pub fn touches(&self, dims: [usize; 3]) -> bool {
        (0..3).any(|a| self.first[a] == 0 || self.last[a] + 1 == dims[a])
    }
}

/// The shape of the cells for which `solid(index)` holds, in an array that
/// [`Layout::check`] has passed; `known`: their bounding box, where it is known; `held` bytes of the
/// memory limit are taken.
pub(super) fn build(
    solid: &(impl Fn(usize) -> bool + Sync),
    layout: &Layout,
    known: Option<CellBox>,
    options: &ImportOptions,
    held: u64,
    run: &Run,
) -> Result<Shape> {
    let spacing = scaled("spacing", layout.spacing, options.length_unit, LARGEST)?;
    for (h, axis) in spacing.iter().zip(["x", "y", "z"]) {
        let most = spacing.iter().fold(0.0, |m: f64, s| m.max(*s));
        // Thinner cells than this would have distances that are no normal numbers.
        if *h < SMALLEST || *h < 1e-6 * most {
            return Err(Error::InvalidArgument(format!(
                "the spacing along {axis}, {h:e} after scaling, is less than {SMALLEST:e} or than \
                 1e-6 of the greatest, {most:e}"
            )));
        }
    }
    let origin = scaled("origin", layout.origin, options.length_unit, 1e100)?;
    run.check(0.0, "looking for solid cells")?;
    let [nx, ny, nz] = layout.dims;
    let whole = known
        .or_else(|| extent(solid, layout.dims, run))
        .ok_or_else(|| Error::Empty(format!("none of the {nx} x {ny} x {nz} voxels is solid")))?;

    let limit = |more| limit(whole, more, held, options);
    limit(0)?;
    let (dims, cells) = crop(solid, layout.dims, whole, run)?;
    run.check(0.02, "counting the bodies of the voxels")?;
    let components = Components::of(&cells, dims, limit)?;
    let bodies = components.count();
    let mut report = Report {
        components: bodies as u64,
        bodies: bodies as u64,
        watertight: true,
        oriented: true,
        length_unit: options.length_unit,
        notes: options.unit_note().into_iter().collect(),
        ..Report::default()
    };
    let (mut kept, mut dims, mut cells) = (whole, dims, cells);
    if bodies > 1 {
        match options.bodies {
            Bodies::Refuse => return Err(Error::SeveralBodies(refusal(&components))),
            Bodies::All => report.notes.push(format!("the voxels are {bodies} separate bodies")),
            Bodies::Largest => {
                let (largest, size) = components.largest();
                let all: u64 = components.sizes().iter().sum();
                report.bodies_dropped = bodies as u64 - 1;
                report.notes.push(format!(
                    "of {bodies} bodies the largest was kept ({size} of {all} solid cells), {} \
                     dropped",
                    bodies - 1
                ));
                components.keep(largest, &mut cells);
                drop(components);
                let inner = extent(&|i| cells.get(i).is_some_and(|&v| v != 0), dims, run)
                    .ok_or_else(|| Error::Internal("the largest body is empty".into()))?;
                kept = CellBox {
                    first: [0, 1, 2].map(|a| whole.first[a] + inner.first[a]),
                    last: [0, 1, 2].map(|a| whole.first[a] + inner.last[a]),
                };
                limit(inner.cells())?;
                (dims, cells) = crop(&|i| cells.get(i).is_some_and(|&v| v != 0), dims, inner, run)?;
            }
        }
    }
    run.check(0.04, "measuring the voxels")?;

    report.touches_border = kept.touches(layout.dims);
    if report.touches_border {
        report.notes.push(
            "solid cells touch the border of the array: the particle may be cut off there".into(),
        );
    }
    let (count, faces) = census(&cells, dims, run);
    let [hx, hy, hz] = spacing;
    report.solid_cells = count;
    // The frame of the box at the origin, then moved: the power of two does not
    // depend on how the corner is rounded.
    let extent = Vec3::from_fn(|a, _| dims[a] as f64 * spacing[a]);
    let longest = extent.max();
    let mut frame = UnitFrame::of_box(Vec3::zeros(), extent)
        .filter(|_| (SMALLEST..=LARGEST).contains(&longest))
        .ok_or_else(|| {
            Error::InvalidArgument(format!(
                "the voxels are {longest:e} long in all, not between {SMALLEST:e} and {LARGEST:e}"
            ))
        })?;
    frame.offset = Vec3::from_fn(|a, _| origin[a] + kept.first[a] as f64 * spacing[a]);
    report.volume = count as f64 * (hx * hy * hz);
    report.area =
        faces[0] as f64 * (hy * hz) + faces[1] as f64 * (hx * hz) + faces[2] as f64 * (hx * hy);
    report.box_min = [0, 1, 2].map(|a| frame.offset[a]);
    report.box_max = [0, 1, 2].map(|a| frame.offset[a] + extent[a]);
    let spacing = Vec3::from_fn(|a, _| spacing[a] / frame.scale);
    run.count(|c| c.peak_bytes = c.peak_bytes.max(cells.len() as u64));
    Ok(Shape { body: Arc::new(Body::Voxels(Voxels { dims, spacing, cells })), frame, report })
}

/// Lengths whose fifth power (an inertia) is still a normal number.
const SMALLEST: f64 = 1e-60;
const LARGEST: f64 = 1e60;

/// Lengths in the caller's unit. Sizes are compared by logarithms: a product
/// that overflows would trap in a host that asks for it.
fn scaled(what: &str, v: [f64; 3], unit: f64, most: f64) -> Result<[f64; 3]> {
    if !(unit.is_finite() && unit > 0.0) {
        return Err(Error::InvalidArgument(format!(
            "length_unit is {}, not a number > 0",
            figure(unit)
        )));
    }
    for (x, axis) in v.iter().zip(["x", "y", "z"]) {
        if *x != 0.0 && x.abs().log2() + unit.log2() > most.log2() {
            return Err(Error::InvalidArgument(format!(
                "the {what} along {axis}, {x:e} times the length_unit {unit:e}, is more than {most:e}"
            )));
        }
    }
    Ok(v.map(|x| x * unit))
}

fn limit(whole: CellBox, more: u64, held: u64, options: &ImportOptions) -> Result<()> {
    let bytes = whole.cells().saturating_add(more);
    if bytes.saturating_add(held) > options.memory_limit {
        let beside = if held > 0 { format!(" beside the {held} as read") } else { String::new() };
        return Err(Error::MemoryLimit(format!(
            "the voxels need {bytes} bytes{beside}, the limit is {}",
            options.memory_limit
        )));
    }
    Ok(())
}

/// The bounding box of the solid cells; `None` without any.
fn extent(solid: &(impl Fn(usize) -> bool + Sync), dims: [usize; 3], run: &Run) -> Option<CellBox> {
    let [nx, ny, nz] = dims;
    let planes = run.pool().map(nz, |k| {
        let rows = (0..ny).filter_map(|j| {
            let row = nx * (j + ny * k);
            let first = (0..nx).find(|&i| solid(row + i))?;
            let last = (first..nx).rev().find(|&i| solid(row + i)).unwrap_or(first);
            Some(CellBox { first: [first, j, k], last: [last, j, k] })
        });
        rows.reduce(CellBox::join)
    });
    planes.into_iter().flatten().reduce(CellBox::join)
}

/// The cells of a box as 0 and 1.
fn crop(
    solid: &(impl Fn(usize) -> bool + Sync),
    from: [usize; 3],
    part: CellBox,
    run: &Run,
) -> Result<([usize; 3], Vec<u8>)> {
    let dims = part.dims();
    let [nx, ny, nz] = dims;
    let mut cells = error::filled("the voxels", nx * ny * nz, 0u8)?;
    run.pool().chunks_mut(&mut cells, nx * ny, |k, plane| {
        for (j, row) in plane.chunks_mut(nx).enumerate() {
            let start =
                part.first[0] + from[0] * (part.first[1] + j + from[1] * (part.first[2] + k));
            for (i, cell) in row.iter_mut().enumerate() {
                *cell = u8::from(solid(start + i));
            }
        }
    });
    Ok((dims, cells))
}

/// How many cells are solid, and how many of their faces towards x, y and z
/// have no solid neighbour: the pairs of unlike neighbours, void beyond the box.
fn census(cells: &[u8], dims: [usize; 3], run: &Run) -> (u64, [u64; 3]) {
    let [nx, ny, nz] = dims;
    let sum = |a: &[u8]| a.iter().map(|&v| u64::from(v)).sum::<u64>();
    let unlike = |a: &[u8], b: &[u8]| {
        // Sums of 255 at most stay in a byte lane.
        a.chunks(255)
            .zip(b.chunks(255))
            .map(|(a, b)| u64::from(a.iter().zip(b).map(|(x, y)| x ^ y).sum::<u8>()))
            .sum::<u64>()
    };
    let planes = run.pool().map(nz, |k| {
        let at = |j: usize, k: usize| {
            let start = nx * (j + ny * k);
            cells.get(start..start + nx).unwrap_or_default()
        };
        let (mut count, mut faces) = (0, [0; 3]);
        for j in 0..ny {
            let row = at(j, k);
            let solid = sum(row);
            count += solid;
            faces[0] += u64::from(row.first().copied().unwrap_or(0))
                + u64::from(row.last().copied().unwrap_or(0))
                + unlike(row, row.get(1..).unwrap_or_default());
            faces[1] += if j == 0 { solid } else { unlike(row, at(j - 1, k)) };
            faces[2] += if k == 0 { solid } else { unlike(row, at(j, k - 1)) };
            faces[1] += if j + 1 == ny { solid } else { 0 };
            faces[2] += if k + 1 == nz { solid } else { 0 };
        }
        (count, faces)
    });
    planes
        .into_iter()
        .fold((0, [0; 3]), |(n, f), (m, g)| (n + m, [f[0] + g[0], f[1] + g[1], f[2] + g[2]]))
}

fn refusal(components: &Components) -> String {
    let sizes = components.sizes();
    let dust = sizes.iter().filter(|&&n| n == 1).count();
    let (_, largest) = components.largest();
    let dust = match dust {
        0 => String::new(),
        1 => ", one of them a single cell".into(),
        n => format!(", {n} of them single cells"),
    };
    format!(
        "the voxels are {} separate bodies{dust}; the largest has {largest} of {} solid cells: \
         choose the largest or all",
        sizes.len(),
        sizes.iter().sum::<u64>()
    )
}
