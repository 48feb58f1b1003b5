use super::*;
use crate::generate::mss::candidates::Fields;
use crate::shape::{ImportOptions, Layout, Shape};
use crate::solid::{Solid, SolidOptions};

fn ball() -> Solid {
    let inside = |n: usize| {
        [n % 24, n / 24 % 24, n / 576].iter().map(|&x| (x as f64 - 11.2).powi(2)).sum::<f64>()
            < 64.0
    };
    let mask: Vec<u8> = (0..24 * 24 * 24).map(|n| u8::from(inside(n))).collect();
    let layout = Layout { dims: [24; 3], spacing: [1.0; 3], origin: [0.0; 3] };
    let run = Run::serial();
    let shape = Shape::from_mask(&mask, &layout, &ImportOptions::default(), &run).unwrap();
    Solid::new(&shape, &SolidOptions::default(), &run).unwrap()
}

fn rules(min_radius: f64) -> Rules {
    Rules { offset: 0.0, min_radius, min_distance: 0.0, confine: false }
}

#[test]
fn places_that_gained_nothing_come_back_when_spheres_move() {
    let (solid, run) = (ball(), Run::serial());
    let target = Target::of(&solid, false, &run).unwrap();
    let residue = |covered: &[u64]| Residue::count(&target.lattice, &target.bits, covered).unwrap();
    let full = target.bits.clone();
    let empty = vec![0; full.len()];
    let counts = Counts { target: target.cells, ..Counts::default() };
    let mut pool = Pool::new(rules(0.0));
    let places = Fields::new(&target).unwrap().of_target(&target, &run).unwrap();
    pool.add(&target, places, &residue(&empty)).unwrap();
    let first = pool.best(&target, &empty, &counts, &[], 9, &run).unwrap().unwrap();
    pool.put_back(first);
    // While all is covered, nothing gains, and the places are dropped.
    assert!(pool.best(&target, &full, &counts, &[], 9, &run).unwrap().is_none());
    assert!(pool.best(&target, &empty, &counts, &[], 9, &run).unwrap().is_none());
    pool.renew(&target, &residue(&empty)).unwrap();
    let again = pool.best(&target, &empty, &counts, &[], 9, &run).unwrap().unwrap();
    assert!((again.orbit[0].radius - 8.0).abs() < 0.3);
}

#[test]
fn a_place_that_is_too_small_counts_while_it_would_help() {
    let (solid, run) = (ball(), Run::serial());
    let target = Target::of(&solid, false, &run).unwrap();
    let empty = vec![0; target.bits.len()];
    let residue = Residue::count(&target.lattice, &target.bits, &empty).unwrap();
    let counts = Counts { target: target.cells, ..Counts::default() };
    let mut pool = Pool::new(rules(9.0));
    let places = Fields::new(&target).unwrap().of_target(&target, &run).unwrap();
    pool.add(&target, places, &residue).unwrap();
    assert!(pool.best(&target, &empty, &counts, &[], 9, &run).unwrap().is_none());
    assert!(pool.small_one_helps(&target, &empty, &counts, &[]));
    assert!(!pool.small_one_helps(&target, &target.bits, &counts, &[]));
}
