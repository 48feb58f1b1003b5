//! Cutting a solid, or a region of one, into regions and dust.

use super::Region;
use super::blocks::Blocks;
use super::by_cells::of_blocks;
use super::cells::{Cells, Cut};
use super::mark;
use super::piece::{Kin, Piece, arrange};
use crate::error::{Error, Result, count, figure, fits, push};
use crate::math::Moments;
use crate::run::Run;
use crate::shape::{Body, ImportOptions, Mesh, Shape};
use crate::solid::Solid;
use crate::solid::moments::lattices;

/// What a cut keeps to.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CutOptions {
    /// Pieces of less volume (in the caller's unit) become dust. 0: a 1e-9th of the first parent.
    pub least_volume: f64,
}

/// Share of the first parent's volume below which a piece is dust when nothing is asked for, and
/// below which it is rounding.
const DUST: f64 = 1e-9;
const ROUNDING: f64 = 1e-15;

/// A piece that is too small to be a fragment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dust {
    /// Volume, centroid and inertia at unit density, in the caller's frame.
    pub moments: Moments,
    /// The cell of the cut that it comes from.
    pub cell: usize,
}

/// What a body is cut into: the volumes of regions and dust add up to the body's, as do their
/// first and second moments, but for what [`Cut::Within`] leaves out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fragments {
    /// The pieces, by the numbers of their cells.
    pub regions: Vec<Region>,
    /// Those that are too small.
    pub dust: Vec<Dust>,
    /// What a user should know: planes that miss, cells that are empty.
    pub notes: Vec<String>,
}

/// Cuts a solid. Cells of several components make a region of each.
///
/// The moments are exact for meshes whose own are (polyhedral integrals of the clipped surface)
/// and for voxels (cells cut by planes count as what is left of them); of open meshes and those
/// that cross themselves they come from the same columns as the solid's own. In each case they add
/// up to the solid's.
///
/// Errors: `InvalidArgument`, `NotFinite` (which plane or point), `TooLarge` (more than 16384
/// cells of planes), `MemoryLimit`, `Cancelled`.
pub fn cut(solid: &Solid, by: &Cut, options: &CutOptions, run: &Run) -> Result<Fragments> {
    cut_part(solid, None, by, options, run)
}

/// Cuts a region of a solid again, with the planes in the frame of the first parent. It is cut out
/// of the first parent anew, so that any number of generations lose nothing.
pub fn cut_region(
    solid: &Solid,
    region: &Region,
    by: &Cut,
    options: &CutOptions,
    run: &Run,
) -> Result<Fragments> {
    cut_part(solid, Some(region), by, options, run)
}

fn cut_part(
    solid: &Solid,
    region: Option<&Region>,
    by: &Cut,
    options: &CutOptions,
    run: &Run,
) -> Result<Fragments> {
    let least = options.least_volume;
    if !(least.is_finite() && least >= 0.0) {
        return Err(Error::InvalidArgument(format!(
            "least_volume is {}, not a number ≥ 0",
            figure(least)
        )));
    }
    let (parent, whole) = (solid.unit_moments().volume, solid.moments().volume);
    // By shares: a volume in the caller's unit may be far from what numbers hold in another.
    let least = match least {
        0.0 => DUST * parent,
        least if least < whole => least / whole * parent,
        _ => 2.0 * parent,
    };
    let mut fragments = Fragments::default();
    let notes = &mut fragments.notes;
    let found = match exact_mesh(solid, run)? {
        Some(mesh) => of_mesh(solid, mesh, region, by, least, notes, run)?,
        None => of_blocks(solid, region, by, least, notes, run)?,
    };
    for region in found {
        if region.moments.volume >= least {
            push("regions", &mut fragments.regions, region)?;
        } else if region.moments.volume > ROUNDING * parent {
            let moments = solid.frame().moments_to_input(&region.moments);
            push("dust", &mut fragments.dust, Dust { moments, cell: region.cell })?;
        }
    }
    if !fragments.dust.is_empty() {
        let n = fragments.dust.len() as u64;
        fragments.notes.push(format!("{} too small for a fragment became dust", count(n, "piece")));
    }
    Ok(fragments)
}

/// The mesh of a solid whose moments are polyhedral integrals.
pub(super) fn exact_mesh<'a>(solid: &'a Solid, run: &Run) -> Result<Option<&'a Mesh>> {
    let Body::Mesh(mesh) = solid.body() else { return Ok(None) };
    if solid.unit_moments().relative_error == 0.0 {
        return Ok(Some(mesh));
    }
    let lattices = lattices(mesh, solid.unit_moments(), solid.memory_limit(), run)?;
    Ok(lattices.is_none().then_some(mesh))
}

/// The pieces of a closed mesh.
fn of_mesh(
    solid: &Solid,
    mesh: &Mesh,
    region: Option<&Region>,
    by: &Cut,
    least: f64,
    notes: &mut Vec<String>,
    run: &Run,
) -> Result<Vec<Region>> {
    // A piece takes no more than the whole, and a mark's cells.
    let limit = solid.memory_limit();
    let most = Piece::cutting(mesh.vertices.len(), mesh.faces.len()) + mark::MAKING;
    fits(format_args!("a cut of a mesh of {}", faces_of(mesh)), most, limit)?;
    let (base, kin) = match region {
        Some(region) => Piece::of_region(mesh, region)?,
        None => (Piece::whole(mesh), Kin(None)),
    };
    let bounds = region.map_or(*base.bounds(), |r| [r.lo, r.hi]);
    let cells = Cells::of(by, solid, region, &bounds, notes, run)?;
    let mut found = Vec::new();
    let mut all = |i: usize, regions: Result<Option<Vec<Region>>>| -> Result<()> {
        match regions? {
            Some(regions) => regions.into_iter().try_for_each(|r| push("regions", &mut found, r)),
            None => {
                notes.push(format!("cell {i} does not meet the body"));
                Ok(())
            }
        }
    };
    match cells {
        Cells::Arranged(planes) => {
            let (pieces, cuts) = arrange(base.lend()?, &planes, limit, run)?;
            run.check(0.5, "cutting by planes")?;
            let mut slots: Vec<(usize, Option<Piece>, Result<Vec<Region>>)> = Vec::new();
            for (i, piece) in pieces.into_iter().enumerate() {
                push("cells of planes", &mut slots, (i, Some(piece), Ok(Vec::new())))?;
            }
            run.pool().chunks_mut(&mut slots, 1, |_, slots| {
                for (i, piece, regions) in slots {
                    if let Some(piece) = piece.take() {
                        *regions = piece.regions(*i, least, &base, &kin);
                    }
                }
            });
            for (i, _, regions) in slots {
                all(i, regions.map(Some))?;
            }
            missed(&cuts, notes);
        }
        Cells::Convex(cells) => {
            // So many that they fit, whatever the number of threads.
            let together = (limit / most.max(1)).clamp(1, 64) as usize;
            for first in (0..cells.len()).step_by(together) {
                run.check(0.1 + 0.9 * first as f64 / cells.len() as f64, "cutting cells")?;
                let n = together.min(cells.len() - first);
                let made = run.pool().map(n, |k| -> Result<Option<Vec<Region>>> {
                    let i = first + k;
                    let Some(planes) = cells.get(i).and_then(Option::as_ref) else {
                        return Ok(None);
                    };
                    match base.lend()?.within(planes)? {
                        Some(piece) => Ok(Some(piece.regions(i, least, &base, &kin)?)),
                        None => Ok(None),
                    }
                });
                for (k, regions) in made.into_iter().enumerate() {
                    all(first + k, regions)?;
                }
            }
        }
    }
    Ok(found)
}

fn faces_of(mesh: &Mesh) -> String {
    count(mesh.faces.len() as u64, "face")
}

/// Says which planes cut nothing.
pub(super) fn missed(cuts: &[bool], notes: &mut Vec<String>) {
    let none: Vec<String> =
        cuts.iter().enumerate().filter(|(_, c)| !**c).map(|(i, _)| i.to_string()).collect();
    match none.as_slice() {
        [] => {}
        [i] => notes.push(format!("half-space {i} does not cut the body")),
        [first, .., last] => notes.push(format!(
            "{} of {} half-spaces do not cut the body, from {first} to {last}",
            none.len(),
            cuts.len()
        )),
    }
}

/// The surface of a region as a shape of its own, in the caller's frame.
///
/// Of voxels it is a mesh: the faces of cells, with what planes cut of them cut. A mesh that is open
/// or crosses itself has no surface that could be cut: its regions are known by their columns. For
/// these the cells of the solid's grid stand in, as voxels do, so that the shape is right to a cell's
/// edge; [`Region::moments`] is more exact.
///
/// Errors: `Empty` where no cell is in a region of these, thinner than cells; as those of
/// [`Shape::from_mesh`]. Several bodies that touch are kept as one.
pub fn shape(solid: &Solid, region: &Region, run: &Run) -> Result<Shape> {
    let surface = match (exact_mesh(solid, run)?, solid.body()) {
        (Some(mesh), _) => {
            let most = Piece::cutting(mesh.vertices.len(), mesh.faces.len());
            fits(
                format_args!("a cut of a mesh of {}", faces_of(mesh)),
                most,
                solid.memory_limit(),
            )?;
            let (piece, kin) = Piece::of_region(mesh, region)?;
            piece.own(&kin)?
        }
        (None, Body::Voxels(v)) => Blocks::of(v, solid.memory_limit()).skin(region)?,
        (None, Body::Mesh(_)) => {
            solid.find_inside(run)?;
            let skin = Blocks::of_grid(solid)?.skin(region)?;
            if skin.faces.is_empty() {
                return Err(Error::Empty(
                    "no cell of the grid is in the fragment: it is thinner than cells".into(),
                ));
            }
            skin
        }
    };
    let frame = solid.frame();
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    for v in &surface.vertices {
        push("vertices", &mut vertices, frame.to_input(v).into())?;
    }
    let options = ImportOptions {
        weld_tolerance: 0.0,
        bodies: crate::shape::Bodies::All,
        memory_limit: solid.memory_limit(),
        ..ImportOptions::default()
    };
    Shape::from_mesh(&vertices, &surface.faces, &options, run)
}

#[cfg(test)]
#[path = "cut_tests.rs"]
mod tests;
