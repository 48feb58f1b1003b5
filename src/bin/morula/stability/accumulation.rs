//! Many times over: what is rounded once must not add up.

use super::bodies::{apart, solid};
use super::{About, Bound, Found, Matrix, Miss};
use morula::fragment::{
    Cut, CutOptions, Fragments, Parent, ReclumpOptions, Region, cut, cut_region, reclump,
};
use morula::generate::{GenerateOptions, HalfSpace, generate};
use morula::math::Vec3;
use morula::run::Run;
use morula::shape::Primitive;
use morula::solid::Solid;
use std::sync::Arc;

const HALVES: About = About {
    measure: "|volume / exact - 1| after 20 generations",
    bound: Bound::AtMost(1e-9),
    why: "each generation is cut out of the first parent anew, so that rounding does not add up",
};

const LOST: About = About {
    measure: "greatest |sum of volumes / cut region's - 1|",
    bound: Bound::AtMost(1e-9),
    why: "nothing is lost in a break, in no generation",
};

const CENTRE: About = About {
    measure: "greatest shift of the common centre, in sizes",
    bound: Bound::AtMost(1e-9),
    why: "nor is the first moment",
};

const SAME: About = About {
    measure: "greatest difference of spheres, in sizes",
    bound: Bound::AtMost(0.0),
    why: "a handle does not remember what was asked of it",
};

const GROWTH: About = About {
    measure: "growth of the handle, bytes",
    bound: Bound::AtMost(0.0),
    why: "re-clumping takes no memory that it does not give back",
};

const RESIDENT: About = About {
    measure: "growth of the process after the first tenth, bytes a call",
    bound: Bound::AtMost(64.0),
    why: "the same, as the system sees it: some pages of the allocator's, not of the calls",
};

pub fn run(m: &mut Matrix) {
    generations(m);
    reclumping(m);
    #[cfg(feature = "dem")]
    super::motion::run(m);
}

fn half(normal: Vec3, through: &Vec3) -> Cut {
    Cut::Planes(vec![HalfSpace { normal, offset: normal.dot(through) }])
}

/// Both sides of a plane.
fn broken(solid: &Solid, region: Option<&Region>, by: &Cut) -> Result<Fragments, Miss> {
    let options = CutOptions { least_volume: 1e-14 * solid.moments().volume };
    Ok(match region {
        Some(region) => cut_region(solid, region, by, &options, &Run::serial())?,
        None => cut(solid, by, &options, &Run::serial())?,
    })
}

fn generations(m: &mut Matrix) {
    m.case("box halved 20 times along its axes", &HALVES, || {
        let solid = solid(&Primitive::Box { edges: [1.0, 0.8, 0.6] }.mesh(8)?, 16)?;
        let mut region: Option<Region> = None;
        for k in 0..20 {
            let moments = region.as_ref().map_or(solid.moments(), |r| r.moments(solid.frame()));
            let mut normal = Vec3::zeros();
            normal[k % 3] = 1.0;
            let made = broken(&solid, region.as_ref(), &half(normal, &moments.centroid))?;
            region = made.regions.into_iter().last();
        }
        let last = region.ok_or(Miss("nothing is left".into()))?.moments(solid.frame()).volume;
        Ok((last / (solid.moments().volume * 0.5f64.powi(20)) - 1.0).abs())
    });
    for (name, p) in [
        ("stone", Primitive::Stone { seed: 5, diameter: 1.0, roughness: 0.5 }),
        ("torus", Primitive::Torus { major: 1.0, minor: 0.4 }),
    ] {
        let found = oblique(&p);
        let (lost, shift) = match found {
            Ok(found) => found,
            Err(miss) => return m.case(name, &LOST, || Err(miss)),
        };
        m.case(format!("{name} cut askew 20 times"), &LOST, || Ok(lost));
        m.case(format!("{name} cut askew 20 times"), &CENTRE, || Ok(shift));
    }
}

/// What 20 generations of oblique cuts lose of volume and first moment, at worst.
fn oblique(p: &Primitive) -> Result<(f64, f64), Miss> {
    let solid = solid(&p.mesh(24)?, 24)?;
    let mut region: Option<Region> = None;
    let (mut lost, mut shift) = (0.0f64, 0.0f64);
    for k in 0..20 {
        let whole = region.as_ref().map_or(solid.moments(), |r| r.moments(solid.frame()));
        let normal = Vec3::from([0, 1, 2].map(|a| f64::from((k * 7 + a * 5) % 11) - 4.7));
        let made = broken(&solid, region.as_ref(), &half(normal, &whole.centroid))?;
        let parts = made.regions.iter().map(|r| r.moments(solid.frame()));
        let parts: Vec<_> = parts.chain(made.dust.iter().map(|d| d.moments)).collect();
        let volume: f64 = parts.iter().map(|p| p.volume).sum();
        let centre = parts.iter().map(|p| p.centroid * p.volume).sum::<Vec3>() / volume;
        lost = lost.max((volume / whole.volume - 1.0).abs());
        shift = shift.max((centre - whole.centroid).norm() / whole.volume.cbrt());
        let largest = |a: &Region, b: &Region| {
            let of = |r: &Region| r.moments(solid.frame()).volume;
            of(a).total_cmp(&of(b))
        };
        region = made.regions.into_iter().max_by(largest);
    }
    Ok((lost, shift))
}

/// Bytes of memory that the process has in use, where the system tells.
fn resident() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    Some(text.split_whitespace().nth(1)?.parse::<f64>().ok()? * 4096.0)
}

fn reclumping(m: &mut Matrix) {
    let times = if m.full { 10_000 } else { 300 };
    let name = format!("{times} re-clumpings of one handle");
    let (off, growth, pages) = match repeated(times) {
        Ok(found) => found,
        Err(miss) => return m.case(name, &SAME, || Err(miss)),
    };
    m.case(name.clone(), &SAME, || Ok(off));
    m.case(name.clone(), &GROWTH, || Ok(growth));
    match pages {
        // Few calls, beside other work of the process, say nothing.
        _ if !m.full => {}
        Some(pages) => m.case(name, &RESIDENT, || Ok(pages)),
        None => m.skip(name, &RESIDENT, "the system does not tell"),
    }
}

fn repeated(times: usize) -> Result<(f64, f64, Option<f64>), Miss> {
    let run = Run::serial();
    let stone = Primitive::Stone { seed: 5, diameter: 1.0, roughness: 0.5 };
    let solid = Arc::new(solid(&stone.mesh(24)?, 32)?);
    let options = GenerateOptions { spheres: 20, ..GenerateOptions::default() };
    let clump = generate(&solid, &options, &run)?.spheres;
    let parent = Parent::new(Arc::clone(&solid), &clump, &run)?;
    let middle = solid.moments().centroid;
    let made = broken(&solid, None, &half(Vec3::new(0.3, -0.5, 0.8), &middle))?;
    let options = ReclumpOptions { spheres: 8, ..ReclumpOptions::default() };
    let one = |k: usize| reclump(&parent, &made.regions[k % made.regions.len()], &options, &run);
    let first = [one(0)?.spheres, one(1)?.spheres];
    let bytes = parent.bytes();
    let (mut off, mut before) = (0.0f64, resident());
    for k in 0..times {
        let again = one(k % 2)?.spheres;
        off = off.max(apart(&again, &first[k % 2], 1.0, [0.0; 3])?);
        if k == times / 10 {
            before = resident();
        }
    }
    let calls = times as f64 * 0.9;
    let pages = before.zip(resident()).map(|(a, b)| ((b - a) / calls).max(0.0));
    Ok((off, parent.bytes() as f64 - bytes as f64, pages))
}

/// How far a value is from another, relative.
#[cfg(feature = "dem")]
pub(super) fn off(value: f64, from: f64) -> Found {
    Ok((value / from - 1.0).abs())
}
