//! Candidates: the largest spheres within the body about places of its medial surface.

use super::CoverOptions;
use super::thinning::thin;
use super::turned::Turned;
use crate::error::{Error, Result, filled, reserve};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::shape::{Body, Mesh};
use crate::solid::Solid;
use crate::solid::nearest::Surface;

/// Where candidates have their centres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Candidates {
    /// At the voxels of the thinned skeleton.
    #[default]
    Thinned,
    /// For each vertex of a mesh, where the largest ball that touches it from within has its
    /// centre: the "analytic" medial surface (Yuan 2019, section 3.3). As many as there are
    /// vertices; for meshes that are fine against their features.
    Analytic,
}

/// Radii that differ by less, in sizes, are equal.
const EQUAL: f64 = 1e-9;
/// Places that a thread takes at once, and between looks at the caller's wish to cancel.
const CHUNK: usize = 32;
const BATCH: usize = 64 * CHUNK;

/// Spheres in the unit frame, the largest first.
pub(super) fn candidates(
    turned: &Turned,
    solid: &Solid,
    options: &CoverOptions,
    limit: u64,
    run: &Run,
) -> Result<Vec<Sphere>> {
    let mut spheres = match options.candidates {
        Candidates::Thinned => {
            let centers = skeleton(turned, options, limit, run)?;
            let surface = solid.surface(run)?;
            each(&centers, run, |c| Sphere::new(*c, surface.nearest(c).distance))?
        }
        Candidates::Analytic => analytic(solid, run)?,
    };
    spheres.retain(|s| s.radius > 0.0);
    run.count(|c| c.exact_distances += spheres.len() as u64);
    // Stable: of ones that are equal but for rounding the first of the lattice stays first.
    let size = solid.unit_moments().volume.cbrt();
    let steps = |s: &Sphere| (s.radius / size / EQUAL).round();
    spheres.sort_by(|a, b| steps(b).total_cmp(&steps(a)));
    Ok(spheres)
}

/// `f` of each place.
fn each<P: Sync, T: Send>(places: &[P], run: &Run, f: impl Fn(&P) -> T + Sync) -> Result<Vec<T>> {
    let mut found = reserve("the candidates", places.len())?;
    for (n, batch) in places.chunks(BATCH).enumerate() {
        run.check(0.4 + 0.2 * (n * BATCH) as f64 / places.len() as f64, "measuring candidates")?;
        let chunks: Vec<&[P]> = batch.chunks(CHUNK).collect();
        let some = run.pool().map(chunks.len(), |i| {
            chunks.get(i).copied().unwrap_or_default().iter().map(&f).collect::<Vec<T>>()
        });
        found.extend(some.into_iter().flatten());
    }
    Ok(found)
}

/// Centres of the voxels of the skeleton, in the unit frame.
fn skeleton(turned: &Turned, options: &CoverOptions, limit: u64, run: &Run) -> Result<Vec<Vec3>> {
    let (grid, inside) = turned.voxels(options.thinning_cells, limit, run)?;
    let left = limit.saturating_sub(inside.len() as u64);
    let skeleton = thin(grid.dims, &inside, options.ends, left, run)?;
    if skeleton.voxels.is_empty() {
        return Err(Error::Empty(format!(
            "the shape is too thin for thinning: the centre of no cell of {:.3e} of the \
             equivalent diameter lies in it",
            grid.spacing.x / turned.diameter
        )));
    }
    let [nx, ny, _] = grid.dims;
    let mut centers = reserve("the candidates", skeleton.voxels.len())?;
    centers.extend(
        skeleton
            .voxels
            .into_iter()
            .map(|n| turned.to_unit(&grid.center(n % nx, n / nx % ny, n / (nx * ny)))),
    );
    Ok(centers)
}

/// The largest balls that touch the vertices from within, in the unit frame.
fn analytic(solid: &Solid, run: &Run) -> Result<Vec<Sphere>> {
    let Body::Mesh(mesh) = solid.body() else {
        return Err(Error::InvalidArgument(
            "analytic candidates need the vertices of a mesh, and the shape is voxels".into(),
        ));
    };
    let surface = solid.surface(run)?;
    let (grid, distance) = (solid.grid(), solid.distance(run)?);
    let within = Within { surface, depth: &|p| -grid.trilinear(distance, p), cell: grid.spacing.x };
    let touched = touches(mesh)?;
    let most = solid.unit_moments().volume.cbrt();
    let found = each(&touched, run, |t| within.touching(t, most))?;
    let mut spheres = reserve("the candidates", found.len())?;
    spheres.extend(found.into_iter().flatten());
    Ok(spheres)
}

/// A vertex to be touched: its place, normal, and how far its faces reach.
struct Touch {
    at: Vec3,
    normal: Vec3,
    reach: f64,
}

fn touches(mesh: &Mesh) -> Result<Vec<Touch>> {
    let nothing = (Vec3::zeros(), 0.0f64);
    let mut sums = filled("the normals of vertices", mesh.vertices.len(), nothing)?;
    for (i, face) in mesh.faces.iter().enumerate() {
        let corners = mesh.corners(i);
        for k in 0..3 {
            let [u, v] = [1, 2].map(|m| corners[(k + m) % 3] - corners[k]);
            let normal = u.cross(&v);
            let size = normal.norm();
            if let Some((sum, reach)) = sums.get_mut(face[k] as usize)
                && size > 0.0
            {
                // Each face counts by its angle, so that the cut into triangles does not matter.
                *sum += normal * (size.atan2(u.dot(&v)) / size);
                *reach = reach.max(u.norm()).max(v.norm());
            }
        }
    }
    let mut touched = reserve("the normals of vertices", sums.len())?;
    for (at, (sum, reach)) in mesh.vertices.iter().zip(sums) {
        let size = sum.norm();
        if size > 1e-9 {
            touched.push(Touch { at: *at, normal: sum / size, reach });
        }
    }
    Ok(touched)
}

/// A surface, and the depth below it by a field of cells, which is nearly right.
struct Within<'a> {
    surface: &'a Surface,
    depth: &'a (dyn Fn(&Vec3) -> f64 + Sync),
    cell: f64,
}

/// A ball is empty where the surface comes no nearer than this share of its radius.
const EMPTY: f64 = 1.0 - 1e-9;

impl Within<'_> {
    /// A radius a little above that of the largest ball: as far as the field's depth grows as
    /// fast as the distance from the vertex, which saves most exact searches.
    fn start(&self, t: &Touch, most: f64) -> f64 {
        let holds = |r: f64| (self.depth)(&(t.at - t.normal * r)) >= r - self.cell;
        let (mut low, mut high) = (0.0, self.cell);
        while high < most && holds(high) {
            low = high;
            high *= 2.0;
        }
        for _ in 0..6 {
            let middle = 0.5 * (low + high);
            if holds(middle) { low = middle } else { high = middle }
        }
        high
    }

    /// Shrinks a ball that touches the vertex until nothing else is in it but the faces at the
    /// vertex, which cut a little off any ball.
    fn touching(&self, t: &Touch, most: f64) -> Option<Sphere> {
        let mut radius = self.start(t, most);
        for _ in 0..32 {
            let center = t.at - t.normal * radius;
            let mut free = radius * EMPTY;
            if let Some(near) = self.surface.nearest_within(&center, free) {
                let apart = t.at - near.point;
                if apart.norm() > t.reach {
                    // The ball through both: |p − q|² = 2 r n·(p − q).
                    let along = 2.0 * t.normal.dot(&apart);
                    if along <= 0.0 {
                        return None;
                    }
                    let smaller = apart.norm_squared() / along;
                    if smaller < radius * EMPTY {
                        radius = smaller;
                        continue;
                    }
                }
                free = near.distance;
            }
            return ((self.depth)(&center) > 0.0).then(|| Sphere::new(center, free));
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::{CoverOptions, Ends};
    use super::*;
    use crate::shape::{ImportOptions, Primitive, Shape};
    use crate::solid::SolidOptions;

    fn made(name: &str, options: &CoverOptions) -> (Solid, Vec<Sphere>) {
        let run = Run::serial();
        let primitive = Primitive::from_name(name).unwrap();
        let shape = Shape::from_primitive(&primitive, 64, &ImportOptions::default(), &run).unwrap();
        let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
        let turned = Turned::new(&solid).unwrap();
        let found = candidates(&turned, &solid, options, u64::MAX, &run).unwrap();
        (solid, found)
    }

    /// Both kinds lie within, and near the medial surface of a torus: its middle circle.
    #[test]
    fn spheres_lie_within_and_about_the_middle() {
        for candidates in [Candidates::Thinned, Candidates::Analytic] {
            // A medial surface would keep a branch for each step of the voxels' surface.
            let ends = Ends::Curve;
            let options = CoverOptions { candidates, ends, ..CoverOptions::default() };
            let (solid, spheres) = made("torus", &options);
            let surface = solid.surface(&Run::serial()).unwrap();
            assert!(spheres.len() > 100, "{}", spheres.len());
            let most = spheres[0].radius;
            assert!(spheres.is_sorted_by(|a, b| a.radius >= b.radius - 1e-8 * most));
            for s in &spheres {
                let beyond = surface.signed_distance(&s.center) + s.radius;
                assert!(beyond < 1e-12 && beyond > -1e-8, "{beyond:e}");
            }
            let central = spheres.iter().filter(|s| s.radius > 0.9 * most).count();
            assert!(2 * central > spheres.len(), "{candidates:?} {central} of {}", spheres.len());
        }
    }
}
