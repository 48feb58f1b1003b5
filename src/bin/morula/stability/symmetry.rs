//! Clumps of symmetric bodies, asked to be symmetric or not.

use super::bodies::Ask;
use super::{About, Bound, Found, Matrix, Miss};
use morula::generate::{BestOptions, Method, Symmetry, generate};
use morula::math::{Sphere, Vec3};
use morula::measure::{QualityOptions, quality};
use morula::run::Run;
use morula::shape::Primitive;
use morula::solid::Solid;

const UNASKED: About = About {
    measure: "asymmetry, as the quality figures have it",
    bound: Bound::Told,
    why: "a clump that is not asked to be its own image: 1 less the part that its image covers",
};

const FIGURE: About = About {
    measure: "asymmetry, as the quality figures have it",
    bound: Bound::AtMost(1e-9),
    why: "the figure is 0 for a clump that is its own image",
};

const IMAGE: About = About {
    measure: "greatest distance of a sphere from its image, in sizes",
    bound: Bound::AtMost(1e-12),
    why: "a clump asked to be symmetric is its own image to rounding",
};

/// How far spheres are from their images in the planes of the axes through the origin.
fn asymmetry(spheres: &[Sphere]) -> f64 {
    let image = |s: &Sphere, axis: usize| {
        let mut center = s.center;
        center[axis] = -center[axis];
        let off = |t: &Sphere| (t.center - center).norm().max((t.radius - s.radius).abs());
        spheres.iter().map(off).fold(f64::MAX, f64::min)
    };
    let all = spheres.iter().flat_map(|s| (0..3).map(move |axis| image(s, axis)));
    all.fold(0.0, f64::max)
}

/// The figure of a body that is its own image in all three planes.
fn figure(solid: &Solid, spheres: &[Sphere]) -> Found {
    let options = QualityOptions { overlap: false, columns: 64, ..QualityOptions::default() };
    let q = quality(solid, spheres, &options, &Run::serial())?;
    match q.symmetry_planes {
        3 => Ok(q.asymmetry),
        n => Err(Miss(format!("{n} planes of symmetry are seen"))),
    }
}

pub fn run(m: &mut Matrix) {
    for name in ["ellipsoid", "box", "cylinder", "torus", "capsule", "tablet"] {
        m.case(format!("{name} of 24 spheres"), &UNASKED, || {
            let solid = super::bodies::solid(&Primitive::from_name(name)?.mesh(32)?, 32)?;
            let clump = super::bodies::spheres(&solid, &Ask::new(Method::Best, 24))?;
            figure(&solid, &clump)
        });
        m.case(format!("{name} of 24 spheres, symmetric"), &FIGURE, || {
            let solid = super::bodies::solid(&Primitive::from_name(name)?.mesh(32)?, 32)?;
            let symmetry = Symmetry::Planes(vec![Vec3::x(), Vec3::y(), Vec3::z()]);
            let mut options = Ask::new(Method::Best, 24).options();
            options.best = BestOptions { symmetry, ..BestOptions::default() };
            figure(&solid, &generate(&solid, &options, &Run::serial())?.spheres)
        });
        for n in [24, 27] {
            m.case(format!("{name} of {n} spheres, symmetric"), &IMAGE, || {
                let mesh = Primitive::from_name(name)?.mesh(32)?;
                let solid = super::bodies::solid(&mesh, 32)?;
                let symmetry = Symmetry::Planes(vec![Vec3::x(), Vec3::y(), Vec3::z()]);
                let mut options = Ask::new(Method::Best, n).options();
                options.best = BestOptions { symmetry, ..BestOptions::default() };
                let clump = generate(&solid, &options, &Run::serial())?;
                let size = solid.moments().volume.cbrt();
                Ok(asymmetry(&clump.spheres) / size)
            });
        }
    }
}
