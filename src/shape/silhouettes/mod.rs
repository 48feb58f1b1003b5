//! Shapes from silhouettes: the visual hull of masks seen by calibrated cameras (Laurentini 1994),
//! carved out of voxels (Price et al. 2007, section 2).

mod bounds;
mod view;

use super::voxels::drop_specks;
use super::{ImportOptions, Layout, Shape};
use crate::error::{Error, Result, count, filled, fits, push};
use crate::run::{Run, Stage};
use bounds::{Bounds, rough};
use view::View;

/// What one camera sees of a particle.
#[derive(Debug, Clone, Copy)]
pub struct Silhouette<'a> {
    /// A value for each pixel, row by row: not 0 where the particle is seen. The pixel of column i
    /// and row j is element `i + width j` and covers [i, i+1] × [j, j+1].
    pub mask: &'a [u8],
    /// Pixels of a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The 3 × 4 camera matrix by rows: (u, v, w) = P (x, y, z, 1), seen at column u/w and row
    /// v/w, with w > 0 in front of the camera.
    pub camera: [f64; 12],
}

/// Which cells stay.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Carve {
    /// Those of which some part may lie in the hull: the shape contains the hull, and so the
    /// body, and is up to a cell larger all around.
    #[default]
    Touched,
    /// Those whose centre lies in the hull: as much is lost as is won, so that the volume is the
    /// hull's.
    Centres,
}

/// Cells along the longest edge while the box is narrowed.
const COARSE: usize = 48;
/// Empty cells around the hull.
const MARGIN: usize = 2;
/// Parts of the hull that together have no more than this part of its cells are no bodies: stairs
/// of pixels cross in such.
const SPECKS: f64 = 1e-3;
/// Fewest and most cells along the longest edge.
const CELLS: std::ops::RangeInclusive<usize> = 4..=2048;

impl Shape {
    /// The visual hull: all of space that every camera sees within its silhouette, on `cells`
    /// cells along the longest edge of its box (4 to 2048). It contains the body, and comes closer
    /// with more cameras; what no outline shows, a dent for one, stays filled.
    ///
    /// Every silhouette must be seen whole; one that touches the border of its image is noted in
    /// the report. Space outside an image is empty.
    ///
    /// Errors: `InvalidArgument` (sizes, `cells`, cameras that bound no body), `NotFinite`
    /// (a camera), `Empty` (a mask, or nothing lies within all silhouettes), and those of
    /// [`Shape::from_mask`].
    pub fn from_silhouettes(
        silhouettes: &[Silhouette],
        cells: usize,
        carve: Carve,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        if !CELLS.contains(&cells) {
            return Err(Error::InvalidArgument(format!(
                "cells is {cells}, not {} to {}",
                CELLS.start(),
                CELLS.end()
            )));
        }
        let (mask, layout, notes) = run.time(Stage::Check, || {
            run.check(0.0, "reading silhouettes")?;
            let mut views = Vec::new();
            let mut left = options.memory_limit;
            for (i, s) in silhouettes.iter().enumerate() {
                let bytes = View::bytes(i, s)?;
                fits(format_args!("silhouette {i}"), bytes, left)?;
                left -= bytes;
                push("silhouettes", &mut views, View::new(i, s)?)?;
            }
            let nothing = || {
                Error::Empty(format!(
                    "no point of space lies within all of {}",
                    count(views.len() as u64, "silhouette")
                ))
            };
            let mut bounds = rough(&views)?.ok_or_else(nothing)?;
            // The box of the outlines' boxes, then of the cells that stay.
            for _ in 0..2 {
                let grid = Cells::over(&bounds, COARSE)?;
                let kept = grid.carve(&views, Carve::Touched, left, run)?;
                let (lo, hi) = grid.bounds_of(&kept).ok_or_else(nothing)?;
                bounds = (lo.sup(&bounds.0), hi.inf(&bounds.1));
            }
            let grid = Cells::over(&bounds, cells)?;
            let mut mask = grid.carve(&views, carve, left, run)?;
            if mask.iter().all(|c| *c == 0) {
                return Err(nothing());
            }
            let cut = views.iter().enumerate().filter(|(_, v)| v.touches_border);
            let mut notes: Vec<String> = cut
                .map(|(i, _)| {
                    format!(
                        "silhouette {i} touches the border of its image: the hull may be cut off \
                         there"
                    )
                })
                .collect();
            let room = left.saturating_sub(mask.len() as u64);
            let allow = |bytes| fits(format_args!("the bodies of the hull"), bytes, room);
            let specks = drop_specks(&mut mask, grid.dims, SPECKS, allow)?;
            if specks > 0 {
                notes.push(format!(
                    "{} between the stairs of the outlines went",
                    count(specks as u64, "speck")
                ));
            }
            let layout = Layout { dims: grid.dims, spacing: [grid.edge; 3], origin: grid.origin };
            Ok((mask, layout, notes))
        })?;
        let mut shape = Shape::from_mask(&mask, &layout, options, run)?;
        shape.report.notes.extend(notes);
        Ok(shape)
    }
}

/// Cubic cells over a box, with a margin.
struct Cells {
    dims: [usize; 3],
    edge: f64,
    origin: [f64; 3],
}

impl Cells {
    fn over((lo, hi): &Bounds, along: usize) -> Result<Cells> {
        let longest = (hi - lo).max();
        let edge = longest / along as f64;
        if !(longest.is_normal() && edge.is_normal()) {
            return Err(Error::InvalidArgument(format!(
                "the silhouettes bound a box of longest edge {longest}"
            )));
        }
        let inner = [0, 1, 2].map(|a| (((hi[a] - lo[a]) / edge - 1e-9).ceil() as usize).max(1));
        let origin = [0, 1, 2].map(|a| {
            let over = inner[a] as f64 * edge - (hi[a] - lo[a]);
            lo[a] - 0.5 * over - MARGIN as f64 * edge
        });
        Ok(Cells { dims: inner.map(|n| n + 2 * MARGIN), edge, origin })
    }

    /// 1 for each cell that stays, else 0; x fastest.
    fn carve(&self, views: &[View], carve: Carve, room: u64, run: &Run) -> Result<Vec<u8>> {
        let [nx, ny, nz] = self.dims;
        let n = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
        let n = n.ok_or_else(|| Error::TooLarge(format!("{nx} x {ny} x {nz} cells")))?;
        fits(format_args!("{nx} x {ny} x {nz} cells of the hull"), n as u64, room)?;
        let mut out = filled("the cells of the hull", n, 0u8)?;
        // Some planes at a time: a look at the caller's cancel between.
        let planes = (1usize << 20).div_ceil(nx * ny);
        for (g, group) in out.chunks_mut(planes * nx * ny).enumerate() {
            run.check(0.0, "carving the hull")?;
            run.pool().chunks_mut(group, nx, |r, row| {
                let r = g * planes * ny + r;
                let at = [0, r % ny, r / ny];
                for (i, cell) in row.iter_mut().enumerate() {
                    let corner = [i, at[1], at[2]];
                    let lo = [0, 1, 2].map(|a| self.origin[a] + corner[a] as f64 * self.edge);
                    let stays = views.iter().all(|v| match carve {
                        Carve::Touched => v.touches(lo, self.edge),
                        Carve::Centres => v.sees(lo.map(|x| x + 0.5 * self.edge)),
                    });
                    *cell = u8::from(stays);
                }
            });
        }
        Ok(out)
    }

    /// The box of the cells that stayed.
    fn bounds_of(&self, kept: &[u8]) -> Option<Bounds> {
        let [nx, ny, _] = self.dims;
        let (mut first, mut last) = (self.dims, [0; 3]);
        let mut any = false;
        for (i, _) in kept.iter().enumerate().filter(|c| *c.1 != 0) {
            any = true;
            let c = [i % nx, i / nx % ny, i / (nx * ny)];
            for a in 0..3 {
                first[a] = first[a].min(c[a]);
                last[a] = last[a].max(c[a] + 1);
            }
        }
        let at = |c: [usize; 3]| {
            nalgebra::Vector3::from_fn(|a, _| self.origin[a] + c[a] as f64 * self.edge)
        };
        any.then(|| (at(first), at(last)))
    }
}
