//! How far to the side of itself a triangle may be nearest.
//!
//! A place whose nearest point lies within a triangle is over it. One that is nearest to an edge or a
//! corner lies between the normals of the triangles there. So none of a triangle's places within a
//! height h is farther from the prism over it than h times the tangent of how much the normals
//! differ, times three: for an edge twice the angle to the mean normal; for a corner the slope of its
//! edges, seen from a triangle, over the cosine of half the angle between two of them.
//!
//! That no place is left out needs less, one angle: planes through the edges of a corner and the
//! mean normal there part all places about it among its triangles, when these surround it and
//! none is turned away from the mean. Where they do not, triangles reach as far as the band does.

use super::band::BAND;
use super::facet::{edges, plane};
use crate::error::{Result, filled};
use crate::shape::Mesh;
use crate::solid::columns::loose;

/// Room for rounding.
const ROOM: f32 = 0.01;
const WHAT: &str = "the normals of vertices";

/// For each vertex how far beyond their sides there the faces may be nearest, in cells, at most
/// [`BAND`] and the room for rounding. `points` are the vertices in cells.
pub(super) fn of(mesh: &Mesh, points: &[[f32; 3]]) -> Result<Vec<f32>> {
    let normal = |f: &[u32; 3]| {
        let corners = [points[f[0] as usize], points[f[1] as usize], points[f[2] as usize]];
        plane(&edges(&corners)).0
    };
    let mut sums = filled(WHAT, points.len(), [0.0f32; 3])?;
    for f in &mesh.faces {
        let n = normal(f);
        for &v in f {
            let sum = &mut sums[v as usize];
            *sum = [sum[0] + n[0], sum[1] + n[1], sum[2] + n[2]];
        }
    }
    // The least cosine between a face's normal and the mean; first times the length of the sum.
    let mut least = filled(WHAT, points.len(), f32::MAX)?;
    for f in &mesh.faces {
        let n = normal(f);
        // Faces without area reach as far as the band does in any case.
        if n != [0.0; 3] {
            for &v in f {
                let (sum, least) = (&sums[v as usize], &mut least[v as usize]);
                *least = least.min(n[0] * sum[0] + n[1] * sum[1] + n[2] * sum[2]);
            }
        }
    }
    for (least, n) in least.iter_mut().zip(&sums) {
        let along = *least;
        let square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        // The tangent is at most a third.
        *least = ROOM
            + if along > 0.0 && along < f32::MAX && 10.0 * along * along > 9.0 * square {
                let across = (square - along * along).max(0.0);
                (3.0 * BAND * (across / (along * along)).sqrt()).min(BAND)
            } else {
                BAND
            };
    }
    if !mesh.clean {
        for (margin, loose) in least.iter_mut().zip(loose(mesh)?) {
            *margin = if loose { BAND + ROOM } else { *margin };
        }
    }
    Ok(least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{ImportOptions, Primitive, Shape, samples};

    /// The vertices of a mesh, cells of which there are `n` along the unit.
    fn cells(mesh: &Mesh, n: f64) -> Vec<[f32; 3]> {
        mesh.vertices.iter().map(|v| (v * n).map(|x| x as f32).into()).collect()
    }

    #[test]
    fn flat_places_have_narrow_margins_and_edges_wide_ones() {
        let ball = samples::ellipsoid([0.5; 3], [0.45; 3], 60);
        let margins = of(&ball, &cells(&ball, 44.0)).unwrap();
        assert!(margins.iter().all(|m| (ROOM..0.5).contains(m)));
        let square = Primitive::Box { edges: [1.0; 3] };
        let (run, options) = (crate::run::Run::serial(), ImportOptions::default());
        let shape = Shape::from_primitive(&square, 8, &options, &run).unwrap();
        let crate::shape::Body::Mesh(mesh) = &*shape.body else { panic!("no mesh") };
        let margins = of(mesh, &cells(mesh, 44.0)).unwrap();
        for (v, m) in mesh.vertices.iter().zip(margins) {
            let edge = v.iter().any(|x| x.min(1.0 - x) < 1e-9)
                && v.iter().filter(|x| x.min(1.0 - **x) < 1e-9).count() > 1;
            assert_eq!(m, if edge { BAND + ROOM } else { ROOM }, "{v}");
        }
    }

    #[test]
    fn at_holes_and_where_faces_turn_margins_are_as_wide_as_the_band() {
        let mut mesh = samples::ellipsoid([0.5; 3], [0.45; 3], 60);
        let top = |v: u32, mesh: &Mesh| mesh.vertices[v as usize].z > 0.9;
        let hole: Vec<[u32; 3]> =
            mesh.faces.iter().filter(|f| f.iter().any(|&v| top(v, &mesh))).copied().collect();
        mesh.faces.retain(|f| !hole.contains(f));
        mesh.clean = false;
        let turned = mesh.faces[500];
        mesh.faces[500].swap(1, 2);
        let margins = of(&mesh, &cells(&mesh, 44.0)).unwrap();
        let rim = |v: &u32| hole.iter().flatten().any(|h| h == v) && !top(*v, &mesh);
        for v in mesh.faces.iter().flatten() {
            let wide = rim(v) || turned.contains(v);
            assert_eq!(margins[*v as usize] == BAND + ROOM, wide, "{v}");
        }
    }
}
