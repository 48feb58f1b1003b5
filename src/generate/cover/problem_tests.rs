//! The set cover as a whole.

use super::*;
use crate::shape::{ImportOptions, Primitive, Shape};
use crate::solid::SolidOptions;

fn solid(name: &str) -> Solid {
    let run = Run::serial();
    let primitive = Primitive::from_name(name).unwrap();
    let shape = Shape::from_primitive(&primitive, 48, &ImportOptions::default(), &run).unwrap();
    Solid::new(&shape, &SolidOptions::default(), &run).unwrap()
}

const COARSE: CoverOptions = CoverOptions {
    ends: super::super::Ends::Surface,
    candidates: super::super::Candidates::Thinned,
    thinning_cells: 24,
    cells_inside: 20,
};

#[test]
fn the_cells_have_the_volume_of_the_mesh() {
    for name in ["box", "tablet", "torus", "cone"] {
        let solid = solid(name);
        let problem = Problem::new(&solid, &COARSE, &Run::serial()).unwrap();
        let error = problem.volume() / solid.unit_moments().volume - 1.0;
        assert!(error.abs() < 1e-5, "{name} {error:e}");
        // Large cells within: far fewer than all small ones.
        let all = std::f64::consts::FRAC_PI_6 * 40f64.powi(3);
        assert!((problem.cells() as f64) < 0.99 * all, "{name} {}", problem.cells());
    }
}

#[test]
fn each_sphere_adds_less_than_the_one_before_and_all_cover_what_can_be() {
    let solid = solid("tablet");
    let problem = Problem::new(&solid, &COARSE, &Run::serial()).unwrap();
    let reach = problem.within_reach().unwrap();
    let steps: Vec<Step> = problem.solve(&Run::serial()).unwrap().collect();
    let covered: Vec<f64> = std::iter::once(0.0).chain(steps.iter().map(|s| s.covered)).collect();
    let gains: Vec<f64> = covered.windows(2).map(|c| c[1] - c[0]).collect();
    assert!(gains.iter().all(|&g| g > 0.0));
    assert!(gains.windows(2).all(|g| g[1] <= g[0] + 1e-15));
    assert_eq!(steps.last().unwrap().covered, reach);
    assert!(reach > 0.9 && reach <= 1.0, "{reach}");
    assert!(steps.len() < problem.candidates().len());
}

#[test]
fn radii_and_candidates_may_be_chosen() {
    let solid = solid("sphere");
    let mut problem = Problem::new(&solid, &COARSE, &Run::serial()).unwrap();
    problem.set_radii(|_| 2.0);
    assert_eq!(problem.within_reach(), Ok(1.0));
    assert_eq!(problem.solve(&Run::serial()).unwrap().count(), 1);
    problem.keep(|_| false);
    assert_eq!(problem.solve(&Run::serial()).unwrap().count(), 0);
}
