//! A distance field for searches, much cheaper than the exact one: exact in a band about the
//! surface, and beyond it the distance to the nearest of some foot points in the band, about a tenth of
//! a cell too far (the square of how far they lie apart over eight times the distance).
//!
//! Faces are laid over the cells that they may be nearest to, four cells at a time (how far that
//! is to their sides: [`super::margins`]); see [`super::far`] for the rest. Lengths are cells, and
//! cell (i, j, k) has its centre there.

use super::facet::{Facet, between};
use super::{far, margins};
use crate::error::{Result, filled, fits, reserve};
use crate::math::Vec3;
use crate::run::Run;
use crate::shape::Mesh;
use crate::solid::grid::Grid;

/// Half the width of the band: more than the diagonal of a cell, so that every cell that the
/// surface cuts has exact corners.
pub(super) const BAND: f32 = 1.8;
/// Foot points are taken from cells that are farther than this from the surface.
const SHELL: f32 = 0.7;
/// Layers of cells that a thread makes at once.
const SLAB: usize = 16;
/// What is reserved.
const WHAT: &str = "the distances near the surface";

/// The foot point of a cell.
pub(super) type Foot = ([u32; 3], [f32; 3]);

/// Writes the unsigned distances at the centres of cubic cells that hold the mesh with room for
/// the band. Takes no more than `room` bytes for that; returns what it took.
pub(super) fn distances(
    mesh: &Mesh,
    grid: &Grid,
    room: u64,
    run: &Run,
    out: &mut [f32],
) -> Result<u64> {
    let (cells, faces, vertices) = (grid.len(), mesh.faces.len(), mesh.vertices.len());
    // Slabs and foot points; points and what margins need; lists of faces.
    let bytes = 20 * cells as u64 + 40 * vertices as u64 + 8 * faces as u64;
    fits(format_args!("distances near {faces} faces in {cells} cells"), bytes, room)?;
    let h = grid.spacing.x;
    let mut points: Vec<[f32; 3]> = reserve(WHAT, vertices)?;
    for v in &mesh.vertices {
        let p = (v - grid.origin) / h;
        points.push([(p.x - 0.5) as f32, (p.y - 0.5) as f32, (p.z - 0.5) as f32]);
    }
    let margins = margins::of(mesh, &points)?;
    let band = Band { mesh, points, margins, dims: grid.dims };
    let [nx, ny, nz] = grid.dims;
    let (starts, lists) = band.by_slab()?;
    run.check(0.0, "making the distance field")?;
    let slabs = run.pool().map(nz.div_ceil(SLAB), |s| {
        let list = &lists[starts[s] as usize..starts[s + 1] as usize];
        band.slab(s * SLAB..nz.min((s + 1) * SLAB), list)
    });
    let mut feet: Vec<Vec<Foot>> = reserve(WHAT, slabs.len())?;
    for (slab, part) in slabs.into_iter().zip(out.chunks_mut(nx * ny * SLAB)) {
        let (values, some) = slab?;
        part.copy_from_slice(&values);
        feet.push(some);
    }
    run.check(0.0, "making the distance field")?;
    far::fill(grid.dims, feet.iter().flatten(), run.pool(), out)?;
    out.iter_mut().for_each(|d| *d = (f64::from(*d) * h) as f32);
    Ok(bytes)
}

struct Band<'a> {
    mesh: &'a Mesh,
    points: Vec<[f32; 3]>,
    /// How far beyond their sides the faces at each vertex may be nearest.
    margins: Vec<f32>,
    dims: [usize; 3],
}

impl Band<'_> {
    fn corners(&self, f: u32) -> [[f32; 3]; 3] {
        let [a, b, c] = self.mesh.faces[f as usize];
        [self.points[a as usize], self.points[b as usize], self.points[c as usize]]
    }

    fn facet(&self, f: u32) -> Facet {
        let [a, b, c] = self.mesh.faces[f as usize];
        let [p, q, r] = [a, b, c].map(|v| self.margins[v as usize]);
        Facet::new(self.corners(f), [p.max(q), q.max(r), r.max(p)])
    }

    /// For each slab the faces that reach it, in their order.
    fn by_slab(&self) -> Result<(Vec<u32>, Vec<u32>)> {
        let slabs = |f: u32| {
            let [[_, _, a], [_, _, b], [_, _, c]] = self.corners(f);
            let layers = between(a.min(b).min(c) - BAND, a.max(b).max(c) + BAND, self.dims[2]);
            layers.start / SLAB..layers.end.div_ceil(SLAB)
        };
        let count = self.dims[2].div_ceil(SLAB);
        let all = 0..self.mesh.faces.len() as u32;
        let mut starts = filled(WHAT, count + 1, 0u32)?;
        for f in all.clone() {
            slabs(f).for_each(|s| starts[s + 1] += 1);
        }
        for s in 0..count {
            starts[s + 1] += starts[s];
        }
        let mut next = starts.clone();
        let mut lists = filled(WHAT, starts[count] as usize, 0u32)?;
        for f in all {
            for s in slabs(f) {
                lists[next[s] as usize] = f;
                next[s] += 1;
            }
        }
        Ok((starts, lists))
    }

    /// The distances in some layers, −1 beyond the band; and foot points.
    fn slab(&self, layers: std::ops::Range<usize>, list: &[u32]) -> Result<(Vec<f32>, Vec<Foot>)> {
        let [nx, ny, _] = self.dims;
        let mut best = filled(WHAT, nx * ny * layers.len(), BAND * BAND)?;
        let mut who = filled(WHAT, best.len(), -1i32)?;
        for &f in list {
            self.facet(f).lay(f as i32, self.dims, &layers, &mut best, &mut who);
        }
        let shell = best.iter().zip(&who).filter(|(d, f)| **f >= 0 && **d > SHELL * SHELL);
        let mut feet = reserve(WHAT, shell.count())?;
        for (row, (best, who)) in best.chunks_mut(nx).zip(who.chunks(nx)).enumerate() {
            let (j, k) = (row % ny, layers.start + row / ny);
            for (i, (d, &f)) in best.iter_mut().zip(who).enumerate() {
                if f < 0 {
                    *d = -1.0;
                    continue;
                }
                if *d > SHELL * SHELL {
                    let at = [i, j, k];
                    feet.push((at.map(|x| x as u32), foot(&self.corners(f as u32), at)));
                }
                *d = d.sqrt();
            }
        }
        Ok((best, feet))
    }
}

/// The nearest point of a triangle.
fn foot(t: &[[f32; 3]; 3], at: [usize; 3]) -> [f32; 3] {
    let t = t.map(|p| Vec3::from(p.map(f64::from)));
    let p = Vec3::from(at.map(|x| x as f64));
    crate::solid::triangle::closest(&t, &p).map(|x| x as f32).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Body, ImportOptions, Primitive, Shape, samples};

    fn of(mesh: &Mesh, n: usize, margins: Option<f32>) -> (Vec<f32>, Vec<Foot>) {
        let scale = (n - 10) as f64;
        let points: Vec<[f32; 3]> =
            mesh.vertices.iter().map(|v| (v * scale).map(|x| x as f32 + 4.7).into()).collect();
        let own = margins::of(mesh, &points).unwrap();
        let margins = margins.map_or(own, |m| vec![m; points.len()]);
        let band = Band { mesh, points, margins, dims: [n; 3] };
        let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
        band.slab(0..n, &all).unwrap()
    }

    /// What triangles leave out beyond their margins others are nearer to.
    #[test]
    fn margins_leave_nothing_out() {
        let (run, options) = (crate::run::Run::serial(), ImportOptions::default());
        let mut meshes = vec![
            samples::ellipsoid([0.5; 3], [0.45, 0.3, 0.08], 24),
            samples::ellipsoid([0.5; 3], [0.45; 3], 90),
        ];
        for (name, segments) in [("torus", 30), ("stone", 40), ("box", 8), ("cone", 14)] {
            let primitive = Primitive::from_name(name).unwrap();
            let shape = Shape::from_primitive(&primitive, segments, &options, &run).unwrap();
            let Body::Mesh(mesh) = &*shape.body else { panic!("no mesh") };
            meshes.push(mesh.clone());
        }
        // Rough, from a little to folds; then with holes.
        for size in [0.002, 0.01, 0.05] {
            let mut mesh = samples::ellipsoid([0.5; 3], [0.45, 0.35, 0.4], 30);
            for (i, v) in mesh.vertices.iter_mut().enumerate() {
                let part = |a: f64| ((i as f64 * a).fract() - 0.5) * size;
                *v += Vec3::new(part(0.618), part(0.414), part(0.732));
            }
            meshes.push(mesh.clone());
            let mut i = 0;
            mesh.faces.retain(|_| {
                i += 1;
                i % 37 > 2
            });
            mesh.clean = false;
            meshes.push(mesh);
        }
        for (m, mesh) in meshes.iter().enumerate() {
            let (found, feet) = of(mesh, 40, None);
            let (whole, all) = of(mesh, 40, Some(2.0 * BAND));
            assert!(whole.iter().filter(|d| **d >= 0.0).count() > 1000);
            for (x, y) in found.iter().zip(&whole) {
                assert!((x - y).abs() < 1e-6, "mesh {m}: {x} for {y}");
            }
            assert_eq!(feet.len(), all.len());
        }
    }
}
