//! What is covered: the body, or what half-spaces leave of it; its distance field and its columns.

use crate::error::{Error, Result, filled};
use crate::generate::balls::Plane;
use crate::generate::balls::bounds;
use crate::generate::balls::dexels::Dexels;
use crate::generate::balls::field::Field;
use crate::math::Vec3;
use crate::run::Run;
use crate::solid::field::rough;
use crate::solid::{Grid, Solid};

/// Relative error of a volume that is exact enough.
const EXACT: f64 = 1e-6;
/// Columns for a volume that is to be exact.
const FINE: usize = 200_000;

/// The distance field of the target, of about so many cells or fewer along its longest edge; and
/// its cells before half-spaces cut it.
pub(super) fn field(
    solid: &Solid,
    planes: &[Plane],
    cells: u32,
    run: &Run,
) -> Result<(Field, (Grid, Vec<f32>))> {
    let (grid, values) = rough(solid, cells, run)?;
    let mut field = Field::new(&grid, &values, run.pool())?;
    field.cut(&grid, planes, run.pool());
    Ok((field, (grid, values)))
}

/// About so many columns that meet the target, and its volume, unit frame.
pub(super) fn dexels(
    solid: &Solid,
    planes: &[Plane],
    (grid, values): (Grid, Vec<f32>),
    wanted: usize,
    run: &Run,
) -> Result<(Dexels, f64)> {
    if planes.is_empty() {
        let mut inside = filled("cells inside", values.len(), 0u8)?;
        inside.iter_mut().zip(&values).for_each(|(i, d)| *i = u8::from(*d < 0.0));
        let cells = (&grid, inside.as_slice());
        let dexels = Dexels::among(solid, cells, &bounds(solid)?, wanted, run.pool())?;
        return Ok((dexels, solid.unit_moments().volume));
    }
    drop(values);
    let dexels = columns(solid, planes, wanted, run)?;
    let volume = dexels.target * dexels.cell();
    Ok((dexels, volume))
}

/// About so many columns that meet the target.
fn columns(solid: &Solid, planes: &[Plane], wanted: usize, run: &Run) -> Result<Dexels> {
    let bounds = bounds(solid)?;
    if planes.is_empty() {
        return Dexels::new(solid, &bounds, wanted, run.pool());
    }
    let (inside, [low, high]) = left(solid, planes)?;
    // The lattice needs an extent.
    let room = Vec3::repeat(1e-9);
    let bounds = [low.sup(&bounds[0]).inf(&(bounds[1] - room)), high.inf(&bounds[1])];
    let mut dexels = Dexels::among(solid, (solid.grid(), &inside), &bounds, wanted, run.pool())?;
    dexels.clip(planes);
    if dexels.target <= 0.0 {
        return Err(nothing());
    }
    Ok(dexels)
}

/// The volume of the target as exactly as it is known, unit frame.
pub(super) fn volume(solid: &Solid, planes: &[Plane], run: &Run) -> Result<f64> {
    let moments = solid.unit_moments();
    if planes.is_empty() && moments.relative_error < EXACT {
        return Ok(moments.volume);
    }
    let dexels = columns(solid, planes, FINE, run)?;
    Ok(dexels.target * dexels.cell())
}

fn nothing() -> Error {
    Error::ZeroVolume("the half-spaces leave nothing of the target".into())
}

/// The cells inside that half-spaces leave, if only a corner, and their box.
fn left(solid: &Solid, planes: &[Plane]) -> Result<(Vec<u8>, [Vec3; 2])> {
    let (grid, all) = (solid.grid(), solid.inside()?);
    let mut inside = filled("cells in the half-spaces", all.len(), 0u8)?;
    let reach: Vec<f64> =
        planes.iter().map(|p| 0.5 * p.normal.abs().dot(&grid.spacing) + p.offset).collect();
    let mut found: Option<[Vec3; 2]> = None;
    let [nx, ny, _] = grid.dims;
    for (i, out) in inside.iter_mut().enumerate() {
        // Cells that are less than half in stand beside one that is not.
        if all.get(i).is_none_or(|&c| c == 0) {
            continue;
        }
        let p = grid.center(i % nx, i / nx % ny, i / nx / ny);
        if planes.iter().zip(&reach).all(|(h, &reach)| h.normal.dot(&p) <= reach) {
            *out = 1;
            let [low, high] = found.unwrap_or([p, p]);
            found = Some([low.inf(&p), high.sup(&p)]);
        }
    }
    let [low, high] = found.ok_or_else(nothing)?;
    Ok((inside, [low - grid.spacing, high + grid.spacing]))
}
