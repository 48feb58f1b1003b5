//! The axes and the unit that a body tells by itself: axes in the order of its extents about them, with its
//! centre of mass nearer to the lower side of its box, the longest edge of which is the unit. A body
//! whose axes are exchanged or mirrored tells the same, and one in another unit but for the last digit.

use super::{Grid, Solid, moments};
use crate::error::{Result, collected, filled, reserve};
use crate::math::{Axes, Inertia, Moments, UnitFrame, Vec3};
use crate::run::Run;
use crate::shape::{Body, Mesh, Voxels};
use std::sync::{Arc, OnceLock};

/// Parts of an extent below this tell nothing: rounding of single precision is less.
const EQUAL: f64 = 1e-6;

/// The axes of a body in the box from `lo` to `hi`.
fn axes(m: &Moments, lo: &Vec3, hi: &Vec3) -> Axes {
    let equal = EQUAL + 10.0 * m.relative_error;
    let Inertia { xx, yy, zz, .. } = m.inertia;
    let second = [yy + zz - xx, xx + zz - yy, xx + yy - zz];
    let mut from = [0, 1, 2];
    for (a, b) in [(0, 1), (1, 2), (0, 1)] {
        if second[from[b]] - second[from[a]] > equal * (xx + yy + zz) {
            from.swap(a, b);
        }
    }
    let sum = lo + hi;
    let above = |i: usize| 2.0 * m.centroid[i] - sum[i] > equal * (hi[i] - lo[i]);
    Axes { from, flipped: from.map(above), sum }
}

/// The solid with these axes and this unit; `None` where it has them.
pub(super) fn turned(solid: &Solid) -> Result<Option<Solid>> {
    let bounds = match &*solid.body {
        Body::Mesh(mesh) => moments::bounds(mesh),
        Body::Voxels(v) => Some((Vec3::zeros(), v.spacing.component_mul(&numbers(v.dims)))),
    };
    let Some((lo, hi)) = bounds else { return Ok(None) };
    let unit = (hi - lo).max();
    let axes = axes(&solid.moments, &lo, &hi);
    if axes.are_kept() && unit == 1.0 || !(unit.is_normal() && unit > 0.0) {
        return Ok(None);
    }
    let axes = Axes { sum: axes.sum / unit, ..axes };
    let body = match &*solid.body {
        Body::Mesh(mesh) => Body::Mesh(turned_mesh(mesh, &axes, unit)?),
        Body::Voxels(v) => Body::Voxels(Voxels {
            dims: axes.ordered(v.dims),
            spacing: axes.ordered((v.spacing / unit).into()).into(),
            cells: cells(&v.cells, v.dims, &axes)?,
        }),
    };
    let grid = solid.grid;
    let far = grid.origin + grid.spacing.component_mul(&numbers(grid.dims));
    let [one, other] = [axes.point(&(grid.origin / unit)), axes.point(&(far / unit))];
    let inside = match (&*solid.body, solid.inside.get()) {
        (Body::Voxels(_), Some(inside)) => Some(cells(inside, grid.dims, &axes)?),
        _ => None,
    };
    Ok(Some(Solid {
        body: Arc::new(body),
        frame: UnitFrame { axes, scale: solid.frame.scale * unit, ..solid.frame },
        grid: Grid {
            dims: axes.ordered(grid.dims),
            spacing: axes.ordered((grid.spacing / unit).into()).into(),
            origin: one.inf(&other),
        },
        padding: solid.padding,
        inside: inside.map(OnceLock::from).unwrap_or_default(),
        distance: OnceLock::new(),
        surface: OnceLock::new(),
        moments: Moments {
            volume: solid.moments.volume / unit.powi(3),
            centroid: axes.point(&(solid.moments.centroid / unit)),
            inertia: axes
                .inertia(&Inertia::from_matrix(&(solid.moments.inertia.matrix() / unit.powi(5)))),
            ..solid.moments
        },
        notes: Vec::new(),
        memory_limit: solid.memory_limit,
        told: OnceLock::from(None),
    }))
}

/// The distances of the turned solid at the cells of the other.
pub(super) fn distance_back(solid: &Solid, told: &Solid, run: &Run) -> Result<Vec<f32>> {
    let from = told.distance(run)?;
    let unit = (told.frame.scale / solid.frame.scale) as f32;
    let mut out = filled("the distances of cells", from.len(), 0f32)?;
    each(solid.grid.dims, &told.frame.axes, |new, old| out[old] = from[new] * unit);
    Ok(out)
}

fn numbers(dims: [usize; 3]) -> Vec3 {
    Vec3::from_fn(|a, _| dims[a] as f64)
}

fn turned_mesh(mesh: &Mesh, axes: &Axes, unit: f64) -> Result<Mesh> {
    let mut faces = reserve("faces", mesh.faces.len())?;
    let mirror = axes.mirror();
    faces.extend(mesh.faces.iter().map(|&[a, b, c]| if mirror { [a, c, b] } else { [a, b, c] }));
    let vertices = collected("vertices", mesh.vertices.iter().map(|p| axes.point(&(p / unit))))?;
    Ok(Mesh { vertices, faces, clean: mesh.clean })
}

/// Cells of a box with the axes turned.
fn cells(of: &[u8], dims: [usize; 3], axes: &Axes) -> Result<Vec<u8>> {
    let mut out = filled("cells", of.len(), 0u8)?;
    each(dims, axes, |new, old| out[new] = of[old]);
    Ok(out)
}

/// Each cell's number with the new axes and with the old ones, along which there are `dims`.
fn each(dims: [usize; 3], axes: &Axes, mut f: impl FnMut(usize, usize)) {
    let [nx, ny, nz] = axes.ordered(dims);
    let at = |i, j, k| {
        let [x, y, z] = axes.cell_back([i, j, k], dims);
        x + dims[0] * (y + dims[1] * z)
    };
    let mut new = 0;
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                f(new, at(i, j, k));
                new += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::voxels::Layout;
    use crate::shape::{ImportOptions, Primitive, Shape};
    use crate::solid::{Resolution, SolidOptions, field};

    /// All 48 ways to exchange and mirror axes, on points.
    fn images() -> impl Iterator<Item = ([usize; 3], [f64; 3])> {
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let sign = |bits: u32, a: u32| if bits >> a & 1 == 1 { -1.0 } else { 1.0 };
        orders
            .into_iter()
            .flat_map(move |o| (0..8).map(move |bits| (o, [0, 1, 2].map(|a| sign(bits, a)))))
    }

    fn solid(shape: &Shape) -> Solid {
        let options =
            SolidOptions { resolution: Resolution::CellsLongest(12), ..SolidOptions::default() };
        Solid::new(shape, &options, &Run::serial()).unwrap()
    }

    #[test]
    fn images_of_a_mesh_tell_the_same() {
        let stone = Primitive::Stone { seed: 4, diameter: 1.0, roughness: 0.4 };
        let (vertices, faces) = stone.mesh(8).unwrap();
        let mut first: Option<Solid> = None;
        let mut others = 0;
        for (order, sign) in images() {
            let image: Vec<[f64; 3]> =
                vertices.iter().map(|p| [0, 1, 2].map(|a| sign[a] * p[order[a]])).collect();
            // The import turns what is inside out.
            let shape = Shape::from_mesh(&image, &faces, &ImportOptions::default(), &Run::serial());
            let here = solid(&shape.unwrap());
            let told = here.with_told_axes().unwrap();
            others += u32::from(!told.frame().axes.are_kept());
            // What it says in the caller's frame is what the solid itself says.
            let (a, b) = (here.moments(), told.moments());
            assert!((a.centroid - b.centroid).norm() < 1e-14);
            assert!((a.inertia.matrix() - b.inertia.matrix()).norm() < 1e-14);
            let Some(first) = &first else {
                first = turned(&here).unwrap().or(Some(here));
                continue;
            };
            assert_eq!(first.grid.dims, told.grid.dims);
            assert!((first.grid.origin - told.grid.origin).norm() < 1e-14);
            let (a, b) = (&first.moments, &told.moments);
            assert!((a.centroid - b.centroid).norm() < 1e-14);
            assert!((a.inertia.matrix() - b.inertia.matrix()).norm() < 1e-14);
            let far = first.inside().unwrap().iter().zip(told.inside().unwrap());
            assert!(far.filter(|(a, b)| a != b).count() <= 1);
        }
        assert_eq!(others, 47);
    }

    #[test]
    fn distances_are_those_of_the_body_as_it_stands() {
        let dims = [7, 5, 4];
        let cells: Vec<u8> = (0..140).map(|i| u8::from(i % 7 > i / 35 && i / 7 % 5 < 4)).collect();
        let run = Run::serial();
        let layout = Layout { dims, spacing: [1.0; 3], origin: [0.0; 3] };
        let shape = Shape::from_mask(&cells, &layout, &ImportOptions::default(), &run);
        let voxels = solid(&shape.unwrap());
        assert!(voxels.told().unwrap().is_some());
        let own = field::signed_distance(&voxels, &run).unwrap();
        let back = voxels.distance(&run).unwrap();
        assert!(own.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-6));
        let stone = Primitive::Stone { seed: 9, diameter: 1.0, roughness: 0.3 };
        let shape = Shape::from_primitive(&stone, 8, &ImportOptions::default(), &run).unwrap();
        let mesh = solid(&shape);
        assert!(mesh.told().unwrap().is_some());
        let own = field::signed_distance(&mesh, &run).unwrap();
        let back = mesh.distance(&run).unwrap();
        assert!(own.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-6));
    }

    #[test]
    fn what_is_alike_both_ways_keeps_its_axes() {
        for p in [
            Primitive::Sphere { radius: 1.0 },
            Primitive::Box { edges: [3.0, 2.0, 1.0] },
            Primitive::Ellipsoid { axes: [3.0, 2.0, 1.0] },
        ] {
            let shape =
                Shape::from_primitive(&p, 16, &ImportOptions::default(), &Run::serial()).unwrap();
            assert!(solid(&shape).with_told_axes().unwrap().frame().axes.are_kept());
        }
    }
}
