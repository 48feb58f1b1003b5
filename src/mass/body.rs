//! Mass, centre, inertia and body frame at a density.

use super::union::union_moments;
use crate::error::{Error, Result, figure};
use crate::math::{Inertia, Moments, PrincipalFrame, Sphere, Vec3};
use crate::run::Run;
use crate::solid::Solid;

/// Whose mass, centre and inertia a clump is to have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Target {
    /// The true shape: the mesh or the cells.
    #[default]
    Solid,
    /// The union of the clump's own spheres ("prototypical clump", Yuan 2019, section 4).
    Union,
}

/// What a solver takes of a rigid body. Everything in the caller's units and frame; the body
/// frame has its origin at `center` and `principal.axes` as its axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Mass per volume.
    pub density: f64,
    /// Volume.
    pub volume: f64,
    /// Mass.
    pub mass: f64,
    /// Centre of mass.
    pub center: Vec3,
    /// Inertia about the centre of mass, axes of the caller's frame, products −∫xy dm.
    pub inertia: Inertia,
    /// Principal moments (mass × length², ascending), body axes as columns, and the same rotation
    /// as a quaternion `w, x, y, z`, body to input, w ≥ 0.
    pub principal: PrincipalFrame,
    /// Estimate of the relative error of the integrals, as [`Moments::relative_error`] has it.
    pub relative_error: f64,
}

impl Body {
    /// The body of `target` at a density: of `solid`, or of the union of `spheres` (caller's
    /// frame). Fails as [`Body::of_solid`] and [`Body::of_union`] do.
    pub fn new(
        target: Target,
        solid: &Solid,
        spheres: &[Sphere],
        density: f64,
        run: &Run,
    ) -> Result<Body> {
        match target {
            Target::Solid => Body::of_solid(solid, density),
            Target::Union => Body::of_union(spheres, density, run),
        }
    }

    /// The body of a solid: exact integrals of a closed mesh and of cells, else with the error
    /// that its moments state. Refused: a density that is not a number above 0.
    pub fn of_solid(solid: &Solid, density: f64) -> Result<Body> {
        Body::with_frame(&solid.moments(), solid.principal(), density)
    }

    /// The body that the union of spheres (caller's frame) fills, overlaps counted once.
    /// Refused: no sphere, a sphere that is not finite or has no radius, a density that is not a
    /// number above 0.
    pub fn of_union(spheres: &[Sphere], density: f64, run: &Run) -> Result<Body> {
        Body::of_moments(&union_moments(spheres, run)?, density)
    }

    /// The body of moments at unit density. Refused: moments that no body has, a density that is
    /// not a number above 0.
    pub fn of_moments(moments: &Moments, density: f64) -> Result<Body> {
        let size = if moments.volume > 0.0 { moments.volume.cbrt() } else { 1.0 };
        let far = (moments.centroid.amax() / size).min(1e16);
        let noise = if far.is_finite() { 0.5 * f64::EPSILON * (far + 1.0) } else { 0.0 };
        // The moments of a union are as sure as that: equal ones are then told as such.
        let noise = noise.max(moments.relative_error.clamp(0.0, 1e-10));
        Body::with_frame(moments, PrincipalFrame::of_rounded(&moments.inertia, noise), density)
    }

    pub(crate) fn with_frame(m: &Moments, frame: PrincipalFrame, density: f64) -> Result<Body> {
        if !density.is_finite() {
            return Err(Error::NotFinite(format!("the density is {density}")));
        }
        if density <= 0.0 {
            let density = figure(density);
            return Err(Error::InvalidArgument(format!("the density is {density}, not above 0")));
        }
        let all = m.inertia.to_array();
        if !(m.volume.is_finite() && m.centroid.iter().chain(&all).all(|v| v.is_finite())) {
            return Err(Error::NotFinite(format!(
                "the moments have volume {} and centre ({}, {}, {})",
                m.volume, m.centroid.x, m.centroid.y, m.centroid.z
            )));
        }
        if m.volume <= 0.0 {
            let volume = figure(m.volume);
            return Err(Error::ZeroVolume(format!("the volume of the target is {volume}")));
        }
        let [a, b, c] = frame.moments;
        // The moments of a body about its axes: each at most the sum of the others.
        if !(a > 0.0 && c <= (a + b) * (1.0 + 1e-9)) {
            return Err(Error::InvalidArgument(format!(
                "no body has the principal moments {}, {}, {}",
                figure(a),
                figure(b),
                figure(c)
            )));
        }
        let mass = density * m.volume;
        let principal = PrincipalFrame { moments: frame.moments.map(|v| v * density), ..frame };
        if !(mass.is_normal() && principal.moments.iter().all(|v| v.is_normal())) {
            return Err(Error::InvalidArgument(format!(
                "with density {} the mass is {} and the least moment {}: beyond the numbers",
                figure(density),
                figure(mass),
                figure(principal.moments[0])
            )));
        }
        Ok(Body {
            density,
            volume: m.volume,
            mass,
            center: m.centroid,
            inertia: Inertia::from_matrix(&(m.inertia.matrix() * density)),
            principal,
            relative_error: m.relative_error,
        })
    }

    /// Radius of gyration √(½ tr I / M): the length that errors of the centre are measured by.
    pub fn gyration(&self) -> f64 {
        (0.5 * self.principal.moments.iter().sum::<f64>() / self.mass).sqrt()
    }

    /// Spheres of the caller's frame in the body frame.
    pub fn to_body(&self, spheres: &[Sphere]) -> Vec<Sphere> {
        let turn = self.principal.axes.transpose();
        let place = |s: &Sphere| Sphere::new(turn * (s.center - self.center), s.radius);
        spheres.iter().map(place).collect()
    }

    /// Spheres of the body frame in the caller's frame.
    pub fn to_input(&self, spheres: &[Sphere]) -> Vec<Sphere> {
        let turn = self.principal.axes;
        let place = |s: &Sphere| Sphere::new(turn * s.center + self.center, s.radius);
        spheres.iter().map(place).collect()
    }
}

/// ε_w: how much less the principal moments of `clump` are together than those of `target`,
/// over the latter, both at one density (Yuan 2019, section 4).
pub fn inertia_error(target: &Moments, clump: &Moments) -> f64 {
    // The sum of the principal moments is the trace.
    let trace = |m: &Moments| m.inertia.xx + m.inertia.yy + m.inertia.zz;
    let whole = trace(target);
    if whole > 0.0 { (whole - trace(clump)) / whole } else { 0.0 }
}

/// ε_w of a clump that is its target shrunk to a share `coverage` of the volume:
/// 1 − c^(5/3), which is the 16 % at 90 % and 8.5 % at 95 % of Yuan 2019, section 4.
pub fn coverage_rule(coverage: f64) -> f64 {
    1.0 - coverage.max(0.0).powf(5.0 / 3.0)
}
