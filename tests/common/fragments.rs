//! What the tests of fragments start from.

use morula::fragment::{Cut, CutOptions, Fragments, cut};
use morula::generate::HalfSpace;
use morula::math::{Moments, Vec3};
use morula::{Run, Solid};

pub fn plane(normal: [f64; 3], offset: f64) -> HalfSpace {
    HalfSpace { normal: Vec3::from(normal), offset }
}

pub fn made(solid: &Solid, by: &Cut) -> Fragments {
    cut(solid, by, &CutOptions::default(), &Run::serial()).unwrap()
}

/// Moments of all pieces.
pub fn pieces(solid: &Solid, f: &Fragments) -> Vec<Moments> {
    let regions = f.regions.iter().map(|r| r.moments(solid.frame()));
    regions.chain(f.dust.iter().map(|d| d.moments)).collect()
}

/// By how much the moments of parts, together, differ from those of the whole.
pub fn lack(whole: &Moments, parts: &[Moments]) -> f64 {
    let volume: f64 = parts.iter().map(|p| p.volume).sum();
    let first = parts.iter().map(|p| (p.centroid - whole.centroid) * p.volume).sum::<Vec3>();
    let inertia = parts.iter().fold(nalgebra::Matrix3::zeros(), |sum, p| {
        sum + p.inertia.shifted(p.volume, &(p.centroid - whole.centroid)).matrix()
    });
    let most = whole.inertia.matrix().amax();
    ((volume - whole.volume) / whole.volume)
        .abs()
        .max(first.norm() / whole.volume.powf(4.0 / 3.0))
        .max((inertia - whole.inertia.matrix()).amax() / most)
}
