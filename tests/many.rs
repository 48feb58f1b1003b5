//! Several clumps in one call: each is what a call of its own gives, for any number of threads.

#![allow(clippy::unwrap_used, clippy::panic)]

use morula::clump::Stopped;
use morula::generate::{Effort, GenerateOptions, Method, batch, batch_labels, generate, levels};
use morula::shape::primitive::Primitive;
use morula::shape::voxels::Layout;
use morula::shape::{ImportOptions, Shape};
use morula::solid::{Resolution, SolidOptions};
use morula::{Clump, Error, Run, Solid};
use std::cell::RefCell;

fn shape(name: &str) -> Shape {
    let primitive = Primitive::from_name(name).unwrap();
    Shape::from_primitive(&primitive, 24, &ImportOptions::default(), &Run::serial()).unwrap()
}

fn grid() -> SolidOptions {
    SolidOptions { resolution: Resolution::CellsLongest(32), ..SolidOptions::default() }
}

fn ask() -> GenerateOptions {
    GenerateOptions {
        method: Method::Best,
        spheres: 12,
        effort: Effort::Draft,
        ..GenerateOptions::default()
    }
}

fn alone(shape: &Shape, options: &GenerateOptions) -> Clump {
    let run = Run::serial().with_seed(5);
    generate(&Solid::new(shape, &grid(), &run).unwrap(), options, &run).unwrap()
}

#[test]
fn levels_are_clumps_of_their_own() {
    let torus = shape("torus");
    let counts = [4, 30, 1, 12];
    for threads in [1, 3] {
        let run = Run::new(threads).unwrap().with_seed(5);
        let solid = Solid::new(&torus, &grid(), &run).unwrap();
        let made = levels(&solid, &ask(), &counts, &run);
        for (n, clump) in counts.into_iter().zip(made) {
            let clump = clump.unwrap();
            assert_eq!(clump.spheres.len(), n);
            let one = alone(&torus, &GenerateOptions { spheres: n, ..ask() });
            assert_eq!(clump.spheres, one.spheres);
            // Its own work, not that of the levels before it.
            assert_eq!(clump.counters.columns, one.counters.columns);
        }
    }
}

#[test]
fn a_level_that_fails_stops_no_other() {
    let run = Run::serial();
    let solid = Solid::new(&shape("box"), &grid(), &run).unwrap();
    let made = levels(&solid, &ask(), &[3, 1_000_000, 5], &run);
    assert_eq!(made[0].as_ref().unwrap().spheres.len(), 3);
    assert!(matches!(made[1], Err(Error::InvalidArgument(_))));
    assert_eq!(made[2].as_ref().unwrap().spheres.len(), 5);
    assert!(levels(&solid, &ask(), &[], &run).is_empty());
}

#[test]
fn levels_tell_one_progress_and_stop_together() {
    let told = RefCell::new(Vec::new());
    let torus = shape("torus");
    let solid = Solid::new(&torus, &grid(), &Run::serial()).unwrap();
    let made = {
        let run = Run::serial().with_progress(Box::new(|f| {
            told.borrow_mut().push(f);
            f > 0.55
        }));
        levels(&solid, &ask(), &[4, 4, 4, 4], &run)
    };
    let told = told.into_inner();
    assert!(told.windows(2).all(|w| w[0] <= w[1]) && told[told.len() - 1] < 0.8, "{told:?}");
    assert!(told.iter().any(|&f| f > 0.02 && f < 0.25), "{told:?}");
    assert!(made[..2].iter().all(|c| c.as_ref().unwrap().stopped == Stopped::Spheres));
    assert!(matches!(made[3], Err(Error::Cancelled(_))));
}

#[test]
fn a_batch_is_what_each_shape_gives_alone() {
    let names = ["torus", "box", "sphere", "ellipsoid", "cone", "cylinder", "tablet"];
    let shapes: Vec<Shape> = names.iter().map(|name| shape(name)).collect();
    let all: Vec<&Shape> = shapes.iter().chain(&shapes).collect();
    for threads in [1, 2, 8] {
        let run = Run::new(threads).unwrap().with_seed(5);
        let made = batch(&all, &grid(), &ask(), &run);
        assert_eq!(made.len(), 14);
        for (shape, clump) in all.iter().zip(made) {
            assert_eq!(clump.unwrap().spheres, alone(shape, &ask()).spheres);
        }
    }
}

#[test]
fn a_cancelled_batch_keeps_what_is_made() {
    let body = shape("sphere");
    let all = [&body; 10];
    let run = Run::serial().with_progress(Box::new(|f| f > 0.3));
    let made = batch(&all, &grid(), &ask(), &run);
    let done = made.iter().filter(|c| c.is_ok()).count();
    assert!((1..10).contains(&done), "{done}");
    for clump in &made[done..] {
        assert!(matches!(clump, Err(Error::Cancelled(_))));
    }
}

/// Boxes side by side, each with a label of its own; 0 between them.
fn volume() -> (Vec<u32>, Layout) {
    let dims = [40, 12, 12];
    let mut labels = vec![0; 40 * 12 * 12];
    for (i, v) in labels.iter_mut().enumerate() {
        let [x, y, z] = [i % 40, i / 40 % 12, i / 480];
        let inside = x % 8 > 0 && (1..10).contains(&y) && (2..7).contains(&z);
        *v = if inside { [7, 3, 9, 1, 4][x / 8] } else { 0 };
    }
    (labels, Layout { dims, spacing: [0.5, 0.4, 0.6], origin: [1.0, -2.0, 3.0] })
}

#[test]
fn labels_are_what_each_gives_alone() {
    let (labels, layout) = volume();
    let import = ImportOptions::default();
    for threads in [1, 4] {
        let run = Run::new(threads).unwrap().with_seed(5);
        let some = batch_labels(&labels, &layout, &[], &import, &grid(), &ask(), &run).unwrap();
        assert_eq!(some.iter().map(|(label, _)| *label).collect::<Vec<_>>(), [1, 3, 4, 7, 9]);
        for (label, clump) in some {
            let shape = Shape::from_label(&labels, &layout, label, &import, &Run::serial());
            assert_eq!(clump.unwrap().spheres, alone(&shape.unwrap(), &ask()).spheres, "{label}");
        }
    }
}

#[test]
fn labels_that_are_not_there_are_named() {
    let (labels, layout) = volume();
    let import = ImportOptions::default();
    let run = Run::serial();
    let wanted = [3, 0, 77, 9];
    let some = batch_labels(&labels, &layout, &wanted, &import, &grid(), &ask(), &run).unwrap();
    assert!(some[0].1.is_ok() && some[3].1.is_ok());
    assert!(matches!(&some[1].1, Err(Error::InvalidArgument(t)) if t.contains("label 0")));
    assert!(matches!(&some[2].1, Err(Error::IndexOutOfRange(t)) if t.contains("label 77")));
    let short = batch_labels(&labels[1..], &layout, &[], &import, &grid(), &ask(), &run);
    assert!(short.is_err());
}
