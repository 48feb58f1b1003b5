//! The axes and the unit that a body tells by itself: axes in the order of its extents about them, with its
//! centre of mass nearer to the lower side of its box, the longest edge of which is the unit. A body
//! whose axes are exchanged or mirrored tells the same, and one in another unit but for the last digit.

use super::{Grid, Solid, grid, moments};
use crate::error::{Result, collected, filled, fits, reserve};
use crate::math::{Axes, Inertia, Moments, UnitFrame, Vec3};
use crate::run::Run;
use crate::shape::{Body, Mesh, Voxels};
use std::sync::{Arc, OnceLock};

/// Parts of an extent below this tell nothing: rounding of single precision is less.
const EQUAL: f64 = 1e-6;
/// Roundings of places that tell nothing.
const ROUNDINGS: f64 = 16.0;
/// After so many cells the caller is asked whether to go on.
const ASKED: usize = 1 << 22;

/// The axes of a body in the box from `lo` to `hi` whose places are rounded by `noise`.
///
/// Of equal second moments the longer edge of the box comes first, then the side towards which the
/// centre of mass is farther off. Where that is in the middle, the products of inertia tell the side, of bodies
/// that are their own image in a point. Bodies that differ in nothing of this keep their axes.
fn axes(m: &Moments, lo: &Vec3, hi: &Vec3, noise: f64) -> Axes {
    let equal = EQUAL + 10.0 * m.relative_error;
    let edges = hi - lo;
    let slack = edges.map(|edge| equal + ROUNDINGS * noise / edge);
    let Inertia { xx, yy, zz, xy, xz, yz } = m.inertia;
    let second = [yy + zz - xx, xx + zz - yy, xx + yy - zz].map(|s| 0.5 * s);
    let sum = lo + hi;
    let off = 2.0 * m.centroid - sum;
    let longer = |a: usize, b: usize| {
        let slack = slack[a].max(slack[b]);
        for (x, y, size) in [
            (second[a], second[b], second[a] + second[b]),
            (edges[a], edges[b], edges[a] + edges[b]),
            (off[a].abs(), off[b].abs(), edges[a] + edges[b]),
        ] {
            if (x - y).abs() > slack * size {
                return x > y;
            }
        }
        false
    };
    let mut from = [0, 1, 2];
    for (a, b) in [(0, 1), (1, 2), (0, 1)] {
        if longer(from[b], from[a]) {
            from.swap(a, b);
        }
    }
    let products = [[second[0], -xy, -xz], [-xy, second[1], -yz], [-xz, -yz, second[2]]];
    let side = |a: usize, b: usize| {
        let most = (second[a] * second[b]).max(0.0).sqrt();
        let told = products[a][b].abs() > slack[a].max(slack[b]) * most;
        if told { products[a][b].signum() } else { 0.0 }
    };
    let told = from.map(|i| off[i].abs() > slack[i] * edges[i]);
    let above = from.map(|i| off[i] > 0.0);
    let mut best = ([-2.0; 3], [false; 3]);
    for bits in 0..8 {
        let flipped: [bool; 3] = std::array::from_fn(|a| bits >> a & 1 == 1);
        if (0..3).any(|a| told[a] && flipped[a] != above[a]) {
            continue;
        }
        let sign = |a: usize, b: usize| if flipped[a] == flipped[b] { 1.0 } else { -1.0 };
        let sides = [(0, 1), (0, 2), (1, 2)].map(|(a, b)| sign(a, b) * side(from[a], from[b]));
        if sides > best.0 {
            best = (sides, flipped);
        }
    }
    Axes { from, flipped: best.1, sum }
}

/// The solid with these axes and this unit; `None` where it has them.
pub(super) fn turned(solid: &Solid, run: &Run) -> Result<Option<Solid>> {
    let bounds = match &*solid.body {
        Body::Mesh(mesh) => moments::bounds(mesh),
        Body::Voxels(v) => Some((Vec3::zeros(), v.spacing.component_mul(&numbers(v.dims)))),
    };
    let Some((lo, hi)) = bounds else { return Ok(None) };
    let unit = (hi - lo).max();
    let axes = axes(&solid.moments, &lo, &hi, solid.frame.noise());
    if axes.are_kept() && unit == 1.0 || !(unit.is_normal() && unit > 0.0) {
        return Ok(None);
    }
    let copies = solid.grid.len() as u64 + solid.body.bytes();
    let room = solid.memory_limit.saturating_sub(solid.bytes());
    fits(format_args!("the body in the axes that it tells"), copies, room)?;
    // Mirrored before anything rounds, so that a body and its image have the same bytes.
    let (body, grid, inside) = match &*solid.body {
        Body::Mesh(mesh) => {
            let mesh = turned_mesh(mesh, &axes, unit)?;
            let bounds = moments::bounds(&mesh).unwrap_or_default();
            let dims = axes.ordered(solid.grid.dims);
            let grid = grid::about(bounds.into(), dims, solid.grid.spacing.x / unit);
            (Body::Mesh(mesh), grid, solid.inside.get().filter(|_| solid.early))
        }
        Body::Voxels(v) => {
            let spacing: Vec3 = axes.ordered((v.spacing / unit).into()).into();
            let cells = cells(&v.cells, v.dims, &axes, run)?;
            let voxels = Voxels { dims: axes.ordered(v.dims), spacing, cells };
            let dims = axes.ordered(solid.grid.dims);
            let grid = Grid { dims, spacing, origin: -spacing * solid.padding as f64 };
            (Body::Voxels(voxels), grid, solid.inside.get())
        }
    };
    let inside = match inside {
        Some(inside) => Some(cells(inside, solid.grid.dims, &axes, run)?),
        None => None,
    };
    let moments = if solid.moments.relative_error == 0.0 {
        moments::of_exact(&body, run)?
    } else {
        let m = &solid.moments;
        Moments {
            volume: m.volume / unit.powi(3),
            centroid: axes.point(&m.centroid) / unit,
            inertia: Inertia::from_matrix(&(axes.inertia(&m.inertia).matrix() / unit.powi(5))),
            relative_error: m.relative_error,
        }
    };
    let scaled = Axes { sum: axes.sum / unit, ..axes };
    Ok(Some(Solid {
        body: Arc::new(body),
        frame: UnitFrame { axes: scaled, scale: solid.frame.scale * unit, ..solid.frame },
        grid,
        padding: solid.padding,
        early: inside.is_some(),
        inside: inside.map(OnceLock::from).unwrap_or_default(),
        distance: OnceLock::new(),
        surface: OnceLock::new(),
        moments,
        notes: Vec::new(),
        memory_limit: solid.memory_limit,
        held: Arc::clone(&solid.held),
        told: OnceLock::from(None),
    }))
}

fn numbers(dims: [usize; 3]) -> Vec3 {
    Vec3::from_fn(|a, _| dims[a] as f64)
}

/// The mesh with other axes and another unit. Where they mirror it, its faces turn and its vertices are
/// numbered anew as its faces come, which is how the import of the image numbers them.
fn turned_mesh(mesh: &Mesh, axes: &Axes, unit: f64) -> Result<Mesh> {
    let mut faces = collected("faces", mesh.faces.iter().copied())?;
    let place = |p: &Vec3| axes.point(p) / unit;
    if !axes.mirror() {
        let vertices = collected("vertices", mesh.vertices.iter().map(place))?;
        return Ok(Mesh { vertices, faces, clean: mesh.clean });
    }
    let none = u32::MAX;
    let mut number = filled("vertices", mesh.vertices.len(), none)?;
    let mut vertices = reserve("vertices", mesh.vertices.len())?;
    for face in &mut faces {
        face.swap(1, 2);
        for v in face {
            let old = *v as usize;
            if number[old] == none {
                number[old] = vertices.len() as u32;
                vertices.push(place(&mesh.vertices[old]));
            }
            *v = number[old];
        }
    }
    Ok(Mesh { vertices, faces, clean: mesh.clean })
}

/// Cells of a box with the axes turned, `dims` along the old ones.
fn cells(of: &[u8], dims: [usize; 3], axes: &Axes, run: &Run) -> Result<Vec<u8>> {
    let mut out = filled("cells", of.len(), 0u8)?;
    let [nx, ny, nz] = axes.ordered(dims);
    let at = |i, j, k| {
        let [x, y, z] = axes.cell_back([i, j, k], dims);
        x + dims[0] * (y + dims[1] * z)
    };
    let mut rows = out.chunks_mut(nx.max(1));
    for k in 0..nz {
        if ((k + 1) * nx * ny) / ASKED > (k * nx * ny) / ASKED {
            run.check(0.0, "turning the cells of the body")?;
        }
        for (j, row) in rows.by_ref().take(ny).enumerate() {
            row.iter_mut().enumerate().for_each(|(i, cell)| *cell = of[at(i, j, k)]);
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::voxels::Layout;
    use crate::shape::{ImportOptions, Primitive, Shape};
    use crate::solid::{Resolution, SolidOptions};

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

    /// The images of a mesh and what each tells.
    fn all_tell_the_same(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> usize {
        let run = Run::serial();
        let mut first: Option<Solid> = None;
        let mut others = 0;
        for (order, sign) in images() {
            let image: Vec<[f64; 3]> =
                vertices.iter().map(|p| [0, 1, 2].map(|a| sign[a] * p[order[a]])).collect();
            // The import turns what is inside out.
            let shape = Shape::from_mesh(&image, faces, &ImportOptions::default(), &run);
            let here = solid(&shape.unwrap());
            // What it says in the caller's frame is what the solid itself says.
            let told = turned(&here, &run).unwrap().unwrap();
            let (a, b) = (here.moments(), told.moments());
            assert!((a.centroid - b.centroid).norm() < 1e-14);
            assert!((a.inertia.matrix() - b.inertia.matrix()).norm() < 1e-14);
            others += usize::from(!told.frame.axes.are_kept());
            let Some(first) = &first else {
                first = Some(told);
                continue;
            };
            assert_eq!(first.grid, told.grid);
            assert_eq!(first.moments, told.moments);
            let (Body::Mesh(a), Body::Mesh(b)) = (first.body(), told.body()) else { panic!() };
            assert!(a.vertices == b.vertices && a.faces == b.faces, "{order:?} {sign:?}");
        }
        others
    }

    /// A mesh with coordinates that mirroring does not round.
    fn exact(p: Primitive, segments: usize) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let (vertices, faces) = p.mesh(segments).unwrap();
        let grain = f64::from(1 << 20);
        (vertices.iter().map(|p| p.map(|x| (x * grain).round() / grain)).collect(), faces)
    }

    #[test]
    fn images_of_a_mesh_tell_the_same_bytes() {
        let (vertices, faces) =
            exact(Primitive::Stone { seed: 4, diameter: 1.0, roughness: 0.4 }, 8);
        assert_eq!(all_tell_the_same(&vertices, &faces), 47);
    }

    #[test]
    fn images_of_what_is_its_own_image_in_a_point_alone_tell_the_same() {
        // Parallelepipeds: nothing but the products of inertia tells a side. A needle's short edges
        // differ, though not in parts of its length.
        for (edges, slant) in [([3.0, 2.0, 1.0], 0.25), ([1024.0, 1.0, 0.875], 0.0)] {
            let (mut vertices, faces) = exact(Primitive::Box { edges }, 8);
            for p in &mut vertices {
                *p = [p[0] + slant * p[1] + 0.5 * slant * p[2], p[1] + 0.5 * slant * p[2], p[2]];
            }
            let others = all_tell(&vertices, &faces);
            assert!(others >= 5, "{others}");
        }
    }

    /// The same where images are the same body, with its corners in another order.
    fn all_tell(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> usize {
        let mut first: Option<Vec<[f64; 3]>> = None;
        let mut others = 0;
        for (order, sign) in images() {
            let image: Vec<[f64; 3]> =
                vertices.iter().map(|p| [0, 1, 2].map(|a| sign[a] * p[order[a]])).collect();
            let run = Run::serial();
            let shape = Shape::from_mesh(&image, faces, &ImportOptions::default(), &run);
            let here = solid(&shape.unwrap());
            let told = here.with_told_axes(&run).unwrap();
            others += usize::from(!told.frame.axes.are_kept());
            let Body::Mesh(mesh) = told.body() else { panic!() };
            let mut corners: Vec<[f64; 3]> = mesh.vertices.iter().map(|p| (*p).into()).collect();
            corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
            match &first {
                None => first = Some(corners),
                Some(first) => assert_eq!(first, &corners, "{order:?} {sign:?}"),
            }
        }
        others
    }

    #[test]
    fn images_of_voxels_tell_the_same_bytes() {
        let dims = [7, 5, 4];
        let cells: Vec<u8> = (0..140).map(|i| u8::from(i % 7 > i / 35 && i / 7 % 5 < 4)).collect();
        let (run, spacing) = (Run::serial(), [1.0, 0.75, 1.5]);
        let mut first: Option<Solid> = None;
        for (from, sign) in images() {
            let axes = Axes { from, flipped: sign.map(|s| s < 0.0), sum: Vec3::zeros() };
            let image = super::cells(&cells, dims, &axes, &run).unwrap();
            let (dims, spacing) = (axes.ordered(dims), axes.ordered(spacing));
            let layout = Layout { dims, spacing, origin: [0.0; 3] };
            let shape = Shape::from_mask(&image, &layout, &ImportOptions::default(), &run);
            let here = solid(&shape.unwrap());
            let told = turned(&here, &run).unwrap().unwrap();
            let Some(first) = &first else {
                first = Some(told);
                continue;
            };
            assert_eq!((first.grid, &first.moments), (told.grid, &told.moments));
            assert_eq!(first.inside().unwrap(), told.inside().unwrap());
            let (Body::Voxels(a), Body::Voxels(b)) = (first.body(), told.body()) else { panic!() };
            assert_eq!((&a.cells, a.dims), (&b.cells, b.dims));
        }
    }

    #[test]
    fn what_a_solid_and_its_turned_self_hold_is_within_its_memory() {
        let run = Run::serial();
        let stone = Primitive::Stone { seed: 9, diameter: 1.0, roughness: 0.3 };
        let shape = Shape::from_primitive(&stone, 8, &ImportOptions::default(), &run).unwrap();
        let here = solid(&shape);
        let cells = here.grid.len() as u64;
        assert_eq!(here.bytes(), cells);
        let told = here.with_told_axes(&run).unwrap();
        assert!(!std::ptr::eq(told, &here));
        let copies = cells + here.body.bytes();
        assert_eq!((here.bytes(), told.bytes()), (cells + copies, cells + copies));
        told.distance(&run).unwrap();
        here.distance(&run).unwrap();
        let trees = told.surface(&run).unwrap().bytes() + here.surface(&run).unwrap().bytes();
        let held = cells + copies + 8 * cells + trees;
        assert_eq!((here.bytes(), told.bytes()), (held, held));
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
            assert!(solid(&shape).with_told_axes(&Run::serial()).unwrap().frame().axes.are_kept());
        }
    }
}
