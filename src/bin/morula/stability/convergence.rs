//! Finer lattices come closer, with the order they should; more spheres and more work are never
//! worse.

use super::bodies::{Ask, Random, made, mismatch, solid, three};
use super::{About, Bound, Found, Matrix, Miss};
use morula::cost::{CurveOptions, curve};
use morula::generate::{Effort, GenerateOptions, Levels, Method, generate};
use morula::mass::union_moments;
use morula::math::Sphere;
use morula::measure::{Quality, QualityOptions, quality};
use morula::run::Run;
use morula::shape::{ImportOptions, Layout, Primitive, Shape};
use morula::solid::{Solid, SolidOptions};
use std::f64::consts::PI;

const LATTICE: About = About {
    measure: "observed order, 32 to 512 columns",
    bound: Bound::AtLeast(1.5),
    why: "columns are exact along one axis, sampled across two: order 2 but for edges",
};

const STATED: About = About {
    measure: "greatest error over the stated error",
    bound: Bound::AtMost(1.0),
    why: "the stated error is no less than the true one",
};

const SURFACE: About = About {
    measure: "change from 128 to 512 columns, relative",
    bound: Bound::AtMost(0.02),
    why: "distances are exact; only how many of them are asked for changes",
};

const MESHES: About = About {
    measure: "observed order, 16 to 128 segments",
    bound: Bound::Within(1.9, 2.1),
    why: "flat triangles of a smooth body: its moments by the square of their size",
};

const CELLS: About = About {
    measure: "observed order, 8 to 64 cells",
    bound: Bound::AtLeast(1.5),
    why: "a voxel image of a smooth body: better than the cell's size, as cells err both ways",
};

const GRID: About = About {
    measure: "D at 96 cells / at 32 cells",
    bound: Bound::AtMost(1.05),
    why: "a finer grid of the method is not worse",
};

const MORE: About = About {
    measure: "greatest D of a level / of the one before",
    bound: Bound::AtMost(1.0),
    why: "more spheres are never worse along one curve",
};

const EFFORT: About = About {
    measure: "D with more effort / with less",
    bound: Bound::AtMost(1.0),
    why: "what is found with less effort is found with more",
};

const DEEPER: About = About {
    bound: Bound::AtMost(1.02),
    why: "two searches from starts of their own: the longer is better in the mean, and worse by no more than runs differ",
    ..EFFORT
};

const RUNS: About = About {
    measure: "greatest |D / mean - 1| over 5 seeds",
    bound: Bound::AtMost(0.02),
    why: "independent runs lie within 2 % of what they give in the mean",
};

const RUNS_THOROUGH: About = About {
    bound: Bound::AtMost(0.01),
    why: "and within 1 % where the search is given the time",
    ..RUNS
};

pub fn run(m: &mut Matrix) {
    lattices(m);
    inputs(m);
    searches(m);
}

fn measured(
    solid: &Solid,
    spheres: &[Sphere],
    columns: usize,
    surface: bool,
) -> Result<Quality, Miss> {
    let options =
        QualityOptions { columns, overlap: !surface, surface, ..QualityOptions::default() };
    Ok(quality(solid, spheres, &options, &Run::serial())?)
}

/// By how much an error falls each time that the step is halved, by least squares over all of them.
fn order(errors: &[f64]) -> f64 {
    let n = errors.len() as f64;
    let logs: Vec<f64> = errors.iter().map(|e| e.abs().max(1e-300).log2()).collect();
    let (middle, mean) = (0.5 * (n - 1.0), logs.iter().sum::<f64>() / n);
    let top: f64 = logs.iter().enumerate().map(|(k, l)| (k as f64 - middle) * (l - mean)).sum();
    let below: f64 = (0..errors.len()).map(|k| (k as f64 - middle).powi(2)).sum();
    -top / below
}

const COLUMNS: [usize; 5] = [32, 64, 128, 256, 512];

fn lattices(m: &mut Matrix) {
    let mut squares = [0.0; COLUMNS.len()];
    for (name, mesh) in three().unwrap_or_default() {
        let ask = Ask::new(Method::Best, 20);
        let all = || -> Result<(Vec<Quality>, Quality, f64), Miss> {
            let (solid, spheres) = made(&mesh, &ask)?;
            let all: Result<Vec<Quality>, Miss> =
                COLUMNS.iter().map(|&n| measured(&solid, &spheres, n, false)).collect();
            let union = union_moments(&spheres, &Run::serial())?.volume;
            Ok((all?, measured(&solid, &spheres, 2048, false)?, union))
        };
        let found = all();
        let (all, fine, union) = match found {
            Ok(found) => found,
            Err(miss) => return m.case(name, &LATTICE, || Err(miss)),
        };
        let off = all.iter().map(|q| (q.union_volume / union - 1.0).powi(2));
        squares.iter_mut().zip(off).for_each(|(sum, off)| *sum += off);
        m.case(format!("D, {name}"), &STATED, || {
            let off = |q: &Quality| (q.mismatch - fine.mismatch).abs() / q.error_bound;
            Ok(all.iter().map(off).fold(0.0, f64::max))
        });
        m.case(format!("D of 512 columns, {name}"), &SURFACE, || {
            Ok((all[4].mismatch / all[2].mismatch - 1.0).abs())
        });
        for (what, of) in [
            ("protrusion", (|q| q.protrusion) as fn(&Quality) -> f64),
            ("Hausdorff distance", |q| q.hausdorff),
            ("RMS distance", |q| q.rms_distance),
        ] {
            m.case(format!("{what}, {name}"), &SURFACE, || {
                let (solid, spheres) = made(&mesh, &ask)?;
                let at = |n| measured(&solid, &spheres, n, true);
                Ok((of(&at(512)?) / of(&at(128)?) - 1.0).abs())
            });
        }
    }
    // Over all of them: one alone may be lucky on one lattice.
    m.case("volume of the union, three bodies", &LATTICE, || Ok(order(&squares.map(f64::sqrt))));
}

fn inputs(m: &mut Matrix) {
    let axes = [0.5, 0.35, 0.2];
    let volume = 4.0 / 3.0 * PI * axes.iter().product::<f64>();
    // ∫ z² over the ellipsoid.
    let along = volume * (axes[0].powi(2) + axes[1].powi(2)) / 5.0;
    let errors = |solid: &Solid| {
        let found = solid.moments();
        [found.volume / volume - 1.0, found.inertia.zz / along - 1.0]
    };
    for (k, what) in ["volume", "moment of inertia"].into_iter().enumerate() {
        m.case(format!("{what} of an ellipsoid's mesh"), &MESHES, || {
            let at = |n| -> Result<f64, Miss> {
                Ok(errors(&solid(&Primitive::Ellipsoid { axes }.mesh(n)?, 8)?)[k])
            };
            Ok(order(&[at(16)?, at(32)?, at(64)?, at(128)?]))
        });
        m.case(format!("{what} of an ellipsoid's voxels"), &CELLS, || {
            // Over several places in the lattice: one alone may be lucky.
            let at = |n| -> Result<f64, Miss> {
                let all: Result<Vec<f64>, Miss> =
                    (0..8).map(|place| Ok(errors(&image(axes, n, place)?)[k].powi(2))).collect();
                Ok((all?.iter().sum::<f64>() / 8.0).sqrt())
            };
            Ok(order(&[at(8)?, at(16)?, at(32)?, at(64)?]))
        });
    }
}

/// The voxels of an ellipsoid, number `place` of its places in the lattice.
fn image(axes: [f64; 3], n: usize, place: u64) -> Result<Solid, Miss> {
    let mut random = Random::new(place);
    let shift = [0; 3].map(|_| random.unit());
    let step = 1.1 / n as f64;
    let at = |i: usize, a: usize| (i as f64 - 0.5 * n as f64 + shift[a]) * step / axes[a];
    let inside = |c: usize| {
        let i = [c % n, c / n % n, c / n / n];
        u8::from((0..3).map(|a| at(i[a], a).powi(2)).sum::<f64>() < 1.0)
    };
    let cells: Vec<u8> = (0..n * n * n).map(inside).collect();
    let layout = Layout { dims: [n; 3], spacing: [step; 3], origin: [0.0; 3] };
    let run = Run::serial();
    let shape = Shape::from_mask(&cells, &layout, &ImportOptions::default(), &run)?;
    Ok(Solid::new(&shape, &SolidOptions::default(), &run)?)
}

fn searches(m: &mut Matrix) {
    for (name, mesh) in three().unwrap_or_default() {
        for (word, method) in
            [("mss", Method::Mss), ("best", Method::Best), ("cover", Method::Cover)]
        {
            m.case(format!("{word}, {name}"), &GRID, || {
                let at = |cells| -> Found {
                    let (solid, spheres) = made(&mesh, &Ask { cells, ..Ask::new(method, 20) })?;
                    Ok(mismatch(&solid, &spheres)?)
                };
                Ok(at(96)? / at(32)?)
            });
        }
        for (word, levels) in
            [("free", Levels::Free), ("chained", Levels::Chained), ("nested", Levels::Nested)]
        {
            m.case(format!("{word} levels, {name}"), &MORE, || {
                let options = CurveOptions {
                    generate: Ask::new(Method::Best, 0).options(),
                    counts: vec![1, 2, 3, 5, 8, 12, 20, 32, 50],
                    levels,
                    quality: QualityOptions {
                        columns: 128,
                        surface: false,
                        ..QualityOptions::default()
                    },
                    masses: false,
                    ..CurveOptions::default()
                };
                let found = curve(&solid(&mesh, 32)?, &options, &Run::serial())?;
                let steps = found.points.windows(2).map(|w| w[1].mismatch / w[0].mismatch);
                Ok(steps.fold(0.0, f64::max))
            });
        }
        let at = |effort, seed| -> Found {
            let ask = Ask { effort, seed, ..Ask::new(Method::Best, 20) };
            let (solid, spheres) = made(&mesh, &ask)?;
            Ok(mismatch(&solid, &spheres)?)
        };
        m.case(format!("normal and draft, {name}"), &EFFORT, || {
            Ok(at(Effort::Normal, 0)? / at(Effort::Draft, 0)?)
        });
        if m.full {
            m.case(format!("thorough and normal, {name}"), &DEEPER, || {
                Ok(at(Effort::Thorough, 0)? / at(Effort::Normal, 0)?)
            });
        }
        m.case(format!("without and with a deadline of 0 s, {name}"), &EFFORT, || {
            let solid = solid(&mesh, 32)?;
            let options = GenerateOptions { spheres: 20, ..GenerateOptions::default() };
            let late = Run::serial().with_deadline(0.0);
            let late = generate(&solid, &options, &late)?.spheres;
            let whole = generate(&solid, &options, &Run::serial())?.spheres;
            Ok(mismatch(&solid, &whole)? / mismatch(&solid, &late)?)
        });
        let spread = |effort| -> Found {
            let ds: Result<Vec<f64>, Miss> = (0..5).map(|seed| at(effort, seed)).collect();
            let ds = ds?;
            let mean = ds.iter().sum::<f64>() / ds.len() as f64;
            Ok(ds.iter().map(|d| (d / mean - 1.0).abs()).fold(0.0, f64::max))
        };
        m.case(format!("normal effort, {name}"), &RUNS, || spread(Effort::Normal));
        if m.full {
            m.case(format!("thorough effort, {name}"), &RUNS_THOROUGH, || spread(Effort::Thorough));
        }
    }
}
