//! How far a clump is from its solid, independent of the grid that made it.

mod arcs;
mod asymmetry;
mod bound;
mod matter;
mod overlap;
mod pieces;
mod planes;
mod reach;
mod surface;
pub(crate) mod tree;
mod union;

use crate::error::{Error, Result, figure, reserve};
use crate::math::Sphere;
use crate::run::Run;
use crate::solid::Solid;

/// What is measured, and how finely.
#[derive(Debug, Clone, PartialEq)]
pub struct QualityOptions {
    /// Columns along each of the two sampled axes, 8 to 8192. They run along the shortest edge
    /// of the target's bounding box.
    pub columns: usize,
    /// D, η, IoU, coverage, overshoot, and the union's volume, centroid and principal moments.
    pub overlap: bool,
    /// Greatest protrusion, RMS and Hausdorff surface distance, roughness, exposed areas, asymmetry.
    pub surface: bool,
    /// Most spheres that one plane touches within δ, for each of these δ (caller's unit).
    pub plane_tolerances: Vec<f64>,
}

impl Default for QualityOptions {
    fn default() -> Self {
        QualityOptions { columns: 256, overlap: true, surface: true, plane_tolerances: Vec::new() }
    }
}

/// The quality of a clump. Lengths, areas and volumes in the caller's unit.
/// What was not asked for is 0 or empty.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Quality {
    /// D = 1 − 2|S∩C| / (|S|+|C|) (Buchele et al. 2026, eq 27).
    pub mismatch: f64,
    /// η = |S△C| / |S| (Buchele et al. 2026, eq 7).
    pub eta: f64,
    /// |S∩C| / |S∪C|.
    pub iou: f64,
    /// |S∩C| / |S|.
    pub coverage: f64,
    /// |C∖S| / |S|.
    pub overshoot: f64,
    /// Estimate of the greatest error of D from the sampling of two axes, not a proven bound:
    /// from four interleaved lattices of twice the step, each part of D by itself. It held with
    /// a factor of two to spare on lenses, boxes and ellipsoids; at 256 columns it is about
    /// 2e-4, the error 2e-5.
    pub error_bound: f64,
    /// Volume of the target by the same columns.
    pub target_volume: f64,
    /// Volume of the union.
    pub union_volume: f64,
    /// Union volume over target volume, less one.
    pub volume_error: f64,
    /// Distance between the centroids over the equivalent diameter.
    pub centroid_error: f64,
    /// Each principal moment of the union over the target's, less one; both by the same columns.
    pub moment_errors: [f64; 3],
    /// The greatest distance from the target of any point of the clump: branch and bound over
    /// patches of the spheres against exact distances, and over the inside of balls that may
    /// fill a cavity or a hole. At most 1e-4 of the box's edge or 0.1 % below the true one, unless
    /// `distance_bound` says more.
    pub protrusion: f64,
    /// RMS distance between the two surfaces, both ways, weighted by area: samples of each
    /// surface, exact distances to the other.
    pub rms_distance: f64,
    /// Hausdorff distance between the two surfaces (the greater of both ways): branch and bound,
    /// at most 1e-4 of the box's edge or 1 % below the true one, unless `distance_bound` says
    /// more.
    pub hausdorff: f64,
    /// No true greatest distance exceeds `protrusion` or `hausdorff` by more than this: at most
    /// 0.4 % of the equivalent diameter or 1 % of `hausdorff`, but where a search meets its last
    /// limit of pieces, and where the target's surface can only be sampled (to about a sample's
    /// width, an estimate): more than 131072 triangles, or walls inside the solid.
    pub distance_bound: f64,
    /// RMS angle between the normals of clump and target at the nearest points, radians. A voxel
    /// target has the normals of its cells' faces: there it is the staircase that is measured,
    /// not the shape behind it.
    pub roughness: f64,
    /// Most spheres that one plane from outside touches within δ, for each δ asked for: a lower
    /// bound, from 2048 directions and the exact tangent planes of pairs and triples near them.
    pub plane_contacts: Vec<u32>,
    /// Exposed area of each sphere, to about 0.3 % of its whole area.
    pub exposed_areas: Vec<f64>,
    /// Spheres of which no point is exposed: in one other, or covered by several (an exact test).
    pub never_exposed: u32,
    /// Surface samples used.
    pub samples: u64,
    /// The greatest mismatch D of the clump and its image in a plane of the target's body frame, over those
    /// of the three planes in which the target is its own image: 0 for a clump that is, too. To about 1e-3.
    pub asymmetry: f64,
    /// How many of the three they are: its surface and its image lie on average within 0.3 % of the
    /// equivalent diameter. Of a body with equal moments other planes are not looked at.
    pub symmetry_planes: u32,
}

impl Quality {
    /// Whether all figures are numbers.
    pub(crate) fn is_finite(&self) -> bool {
        let figures = [
            self.mismatch,
            self.eta,
            self.iou,
            self.coverage,
            self.overshoot,
            self.error_bound,
            self.target_volume,
            self.union_volume,
            self.volume_error,
            self.centroid_error,
            self.protrusion,
            self.rms_distance,
            self.hausdorff,
            self.distance_bound,
            self.roughness,
            self.asymmetry,
        ];
        let more = self.moment_errors.iter().chain(&self.exposed_areas);
        figures.iter().chain(more).all(|x| x.is_finite())
    }
}

/// Measures `spheres` (caller's frame) against `solid`.
pub fn quality(
    solid: &Solid,
    spheres: &[Sphere],
    options: &QualityOptions,
    run: &Run,
) -> Result<Quality> {
    // In the body's own axes and unit, as the methods: what they keep to is what is measured.
    let solid = solid.with_told_axes(run)?;
    let unit = check(solid, spheres, options)?;
    let scale = solid.frame().scale;
    let mut q = Quality::default();
    if options.overlap {
        let o = overlap::overlap(solid, &unit, options, run)?;
        let cube = scale.powi(3);
        q.mismatch = o.mismatch;
        q.error_bound = o.error_bound;
        q.eta = (o.target + o.union - 2.0 * o.both).max(0.0) / o.target;
        q.iou = o.both / (o.target + o.union - o.both);
        q.coverage = o.both / o.target;
        q.overshoot = (o.union - o.both).max(0.0) / o.target;
        q.target_volume = o.target * cube;
        q.union_volume = o.union * cube;
        q.volume_error = o.union / o.target - 1.0;
        q.centroid_error = o.centroid_error;
        q.moment_errors = o.moment_errors;
    }
    if options.surface {
        // As many samples to the lattice's finest area for any number of columns.
        let wanted = (64 * options.columns).clamp(1024, 1 << 16);
        let f = surface::surface(solid, &unit, wanted, run)?;
        run.count(|c| c.exact_distances += f.distances);
        q.protrusion = f.protrusion * scale;
        q.rms_distance = f.rms * scale;
        q.hausdorff = f.hausdorff * scale;
        q.distance_bound = f.slack * scale;
        q.roughness = f.roughness;
        q.exposed_areas = f.areas.iter().map(|a| a * scale * scale).collect();
        q.never_exposed = f.never_exposed;
        q.samples = f.samples;
        (q.asymmetry, q.symmetry_planes) =
            asymmetry::asymmetry(solid, &unit, options.columns, run)?;
    }
    if !options.plane_tolerances.is_empty() {
        // Beyond a great many sizes all spheres count; the division stays finite.
        let unit_of = |&d: &f64| if d * 1e-9 > scale { 1e9 } else { d / scale };
        let tolerances: Vec<f64> = options.plane_tolerances.iter().map(unit_of).collect();
        q.plane_contacts = planes::contacts(&unit, &tolerances, run)?;
    }
    Ok(q)
}

/// The spheres in the unit frame.
fn check(solid: &Solid, spheres: &[Sphere], options: &QualityOptions) -> Result<Vec<Sphere>> {
    if !(8..=8192).contains(&options.columns) {
        return Err(Error::InvalidArgument(format!(
            "columns is {}, not 8 to 8192",
            options.columns
        )));
    }
    for (i, &delta) in options.plane_tolerances.iter().enumerate() {
        if !(delta.is_finite() && delta >= 0.0) {
            return Err(Error::InvalidArgument(format!(
                "plane tolerance {i} is {}, not a number ≥ 0",
                figure(delta)
            )));
        }
    }
    if spheres.is_empty() {
        return Err(Error::Empty("there is no sphere to measure".into()));
    }
    let mut unit = reserve("spheres", spheres.len())?;
    for (i, s) in spheres.iter().enumerate() {
        if !(s.center.iter().all(|x| x.is_finite()) && s.radius.is_finite()) {
            return Err(Error::NotFinite(format!(
                "sphere {i} has centre ({}, {}, {}) and radius {}",
                s.center.x, s.center.y, s.center.z, s.radius
            )));
        }
        let u = solid.frame().sphere_to_unit(s);
        // Far beyond any clump, squares would overflow; below this, they vanish.
        if !(u.radius >= 1e-100 && u.radius <= 1e100 && u.center.amax() <= 1e100) {
            return Err(Error::InvalidArgument(format!(
                "sphere {i} has radius {} and lies {} from the target: out of proportion",
                figure(s.radius),
                figure(u.center.amax() * solid.frame().scale)
            )));
        }
        unit.push(u);
    }
    Ok(unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{ImportOptions, Primitive, Shape};
    use crate::solid::SolidOptions;

    #[test]
    fn a_clump_and_its_image_have_the_same_quality() {
        let run = Run::serial();
        let stone = Primitive::Stone { seed: 6, diameter: 1.0, roughness: 0.4 };
        let (vertices, faces) = stone.mesh(12).unwrap();
        let exact = vertices.iter().map(|p| p.map(|x| (x * 1048576.0).round() / 1048576.0));
        let of = |image: fn([f64; 3]) -> [f64; 3]| {
            let vertices: Vec<[f64; 3]> = exact.clone().map(image).collect();
            let shape = Shape::from_mesh(&vertices, &faces, &ImportOptions::default(), &run);
            let solid = Solid::new(&shape.unwrap(), &SolidOptions::default(), &run).unwrap();
            let spheres = [([0.125, 0.0, -0.0625], 0.375), ([-0.1875, 0.25, 0.125], 0.25)]
                .map(|(c, r)| Sphere::new(image(c).into(), r));
            let options = QualityOptions { columns: 64, ..QualityOptions::default() };
            quality(&solid, &spheres, &options, &run).unwrap()
        };
        let one = of(|p| p);
        assert!(one.mismatch > 0.0 && one.protrusion > 0.0);
        assert_eq!(one, of(|p| [p[2], p[0], p[1]]));
        assert_eq!(one, of(|p| [p[0], -p[1], p[2]]));
    }
}
