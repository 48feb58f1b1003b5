//! A ball about every cell's centre that reaches to the surface, and greedy choice of those that
//! cover most cells that no other does (Garcia et al. 2009; without the demand that the spheres
//! hang together, Li, Xu and Meng 2015).

use super::super::GenerateOptions;
use super::super::lazy::Lazy;
use super::ground::Ground;
use super::growing::Growing;
use crate::clump::{Clump, Stopped};
use crate::error::{Result, push};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::solid::Solid;
use std::f64::consts::PI;

/// A ball is left out that reaches no farther than this, in cells, beyond a neighbour's.
const WITHIN: f64 = 0.2;

/// Makes a clump.
pub(in super::super) fn uniform_grid(
    solid: &Solid,
    options: &GenerateOptions,
    run: &Run,
) -> Result<Clump> {
    super::check(options, "uniform-grid")?;
    run.check(0.0, "measuring the distances of cells")?;
    let ground = Ground::new(solid, options, run)?;
    let candidates = candidates(&ground, run)?;
    let mut growing = Growing::new(&ground, options)?;
    let mut lazy = Lazy::new(&bounds(&ground, &candidates)?)?;
    let stopped = loop {
        if let Some(stopped) = growing.done(run) {
            break stopped;
        }
        let gain = |i: usize| candidates.get(i).map_or(0, |s| growing.gain(s));
        let Some((i, _)) = lazy.best(gain) else {
            break if ground.least > 0.0 { Stopped::Radius } else { Stopped::Exhausted };
        };
        let Some(s) = candidates.get(i) else { continue };
        // The field is of single precision.
        let radius = ground.depth(&s.center) + ground.tolerance;
        if radius > ground.tolerance && radius >= ground.least {
            growing.add(Sphere::new(s.center, radius))?;
        }
    };
    run.count(|c| c.spheres_tried += candidates.len() as u64);
    growing.end(stopped, "no ball about a cell covers a further cell; a finer grid takes more", run)
}

/// Balls about the centres of cells inside, less those that lie within a neighbour's.
fn candidates(ground: &Ground, run: &Run) -> Result<Vec<Sphere>> {
    let grid = ground.solid.grid();
    let distance = ground.solid.distance(run)?;
    let [nx, ny, nz] = grid.dims;
    let h = grid.spacing;
    let slack = WITHIN * ground.cell;
    // How much deeper a neighbour must be to take the ball's place.
    let mut around = Vec::new();
    for n in 0..27 {
        let [i, j, k] = [n % 3, n / 3 % 3, n / 9].map(|c| c as i64 - 1);
        let way = Vec3::new(i as f64, j as f64, k as f64).component_mul(&h).norm();
        if way > 0.0 {
            around.push(([i, j, k], way - slack));
        }
    }
    let at = |i: i64, j: i64, k: i64| {
        let inside = |c: i64, n: usize| c >= 0 && c < n as i64;
        if !(inside(i, nx) && inside(j, ny) && inside(k, nz)) {
            return 0.0;
        }
        let at = grid.index(i as usize, j as usize, k as usize);
        distance.get(at).map_or(0.0, |d| (-f64::from(*d)).max(0.0))
    };
    let layers = run.pool().map(nz, |k| {
        let mut found = Vec::new();
        for j in 0..ny {
            for i in 0..nx {
                let c = [i, j, k].map(|c| c as i64);
                let depth = at(c[0], c[1], c[2]);
                let radius = depth + ground.tolerance;
                let kept = depth > 0.0
                    && radius >= ground.least
                    && around.iter().all(|(d, more)| {
                        at(c[0] + d[0], c[1] + d[1], c[2] + d[2])
                            < depth + more.max(f64::MIN_POSITIVE)
                    });
                if kept {
                    found.push(Sphere::new(grid.center(i, j, k), radius));
                }
            }
        }
        found
    });
    let mut all = Vec::new();
    for s in layers.into_iter().flatten() {
        push("balls about cells", &mut all, s)?;
    }
    Ok(all)
}

/// No more cells can be counted in each: every row that is counted stands for others that lie no
/// farther from it than it is long to the next.
fn bounds(ground: &Ground, candidates: &[Sphere]) -> Result<Vec<u64>> {
    let half = 0.5 * ground.solid.grid().spacing.norm();
    let bound = |s: &Sphere| {
        let r = s.radius / ground.cell;
        let r = r + half / ground.cell * (0.1 * r).max(1.0);
        (4.0 / 3.0 * PI * r * r * r) as u64 + 1
    };
    crate::error::collected("the order of candidates", candidates.iter().map(bound))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::primitive::Primitive;
    use crate::shape::{ImportOptions, Shape};
    use crate::solid::{Resolution, SolidOptions};

    #[test]
    fn lazy_choice_is_naive_choice() {
        let run = Run::serial();
        let shape = Shape::from_primitive(
            &Primitive::from_name("torus").unwrap(),
            24,
            &ImportOptions::default(),
            &run,
        );
        let o =
            SolidOptions { resolution: Resolution::CellsLongest(18), ..SolidOptions::default() };
        let solid = Solid::new(&shape.unwrap(), &o, &run).unwrap();
        let options = GenerateOptions {
            method: super::super::super::Method::UniformGrid,
            spheres: 25,
            ..GenerateOptions::default()
        };
        let clump = uniform_grid(&solid, &options, &run).unwrap();
        // Cell by cell, each gain counted anew for each choice.
        let ground = Ground::new(&solid, &options, &run).unwrap();
        let all = candidates(&ground, &run).unwrap();
        let grid = solid.grid();
        let cells: Vec<Vec3> = (0..grid.len())
            .filter(|&i| solid.inside().unwrap()[i] == 1)
            .map(|i| {
                let [nx, ny, _] = grid.dims;
                grid.center(i % nx, i / nx % ny, i / (nx * ny))
            })
            .collect();
        let mut left = vec![true; cells.len()];
        for found in &clump.spheres {
            let gain = |s: &Sphere| {
                cells.iter().zip(&left).filter(|(c, left)| **left && s.contains(c)).count()
            };
            let (i, _) = all
                .iter()
                .map(gain)
                .enumerate()
                .max_by_key(|&(i, g)| (g, std::cmp::Reverse(i)))
                .unwrap();
            let naive = solid.frame().sphere_to_input(&all[i]);
            assert!((naive.center - found.center).norm() < 1e-12, "{naive:?} {found:?}");
            for (c, left) in cells.iter().zip(&mut left) {
                *left &= !all[i].contains(c);
            }
        }
        assert_eq!(clump.spheres.len(), 25);
    }

    #[test]
    fn what_is_left_out_lies_within_what_is_kept() {
        let run = Run::serial();
        let shape = Shape::from_primitive(
            &Primitive::from_name("ellipsoid").unwrap(),
            32,
            &ImportOptions::default(),
            &run,
        );
        let o =
            SolidOptions { resolution: Resolution::CellsLongest(32), ..SolidOptions::default() };
        let solid = Solid::new(&shape.unwrap(), &o, &run).unwrap();
        let options = GenerateOptions::default();
        let ground = Ground::new(&solid, &options, &run).unwrap();
        let kept = candidates(&ground, &run).unwrap();
        let grid = solid.grid();
        let (mut inside, mut farthest) = (0, 0.0f64);
        for (i, d) in solid.distance(&run).unwrap().iter().enumerate() {
            if *d < 0.0 {
                inside += 1;
                let [nx, ny, _] = grid.dims;
                let (p, r) = (grid.center(i % nx, i / nx % ny, i / (nx * ny)), -f64::from(*d));
                let beyond = kept.iter().map(|s| (p - s.center).norm() + r - s.radius);
                farthest = farthest.max(beyond.fold(f64::MAX, f64::min));
            }
        }
        assert!(kept.len() < inside / 4, "{} of {inside}", kept.len());
        assert!(farthest < ground.cell, "{farthest} {}", ground.cell);
    }
}
