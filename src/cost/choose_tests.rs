use super::*;
use crate::clump::Stopped;
use crate::cost::StepModel;
use crate::mass::TimeStep;

fn point(n: usize, d: f64) -> Point {
    let step_cost = StepModel { step: [1.0, 1.0, 0.0], lists: [0.0, 0.0], rebuild: 1.0 }.cost(n);
    let time_step = TimeStep {
        clump: 1.0,
        sphere: 0,
        effective_mass: 1.0,
        stiffness: 1.0,
        rayleigh: None,
        overlap: 0.0,
        together: 1.0,
    };
    Point {
        asked: n,
        spheres: n,
        mismatch: d,
        coverage: 1.0 - d,
        overshoot: 0.0,
        surface: 0.3 * d,
        hausdorff: d,
        protrusion: d,
        roughness: 0.1,
        union_inertia: d,
        inertia: 0.0,
        masses: None,
        seconds: 0.001 * n as f64,
        seconds_so_far: 0.0,
        time_step,
        step_factor: 0.5,
        least_radius: 0.1,
        step_cost,
        time_cost: 2.0 * step_cost,
        stopped: Stopped::Spheres,
    }
}

/// D falls steeply to 16 spheres, then hardly.
fn bent() -> Vec<Point> {
    [1, 2, 4, 8, 16, 32, 64]
        .map(|n| point(n, if n <= 16 { 0.3 / n as f64 } else { 0.018 }))
        .to_vec()
}

#[test]
fn one_is_made_best_within_the_others() {
    let points = bent();
    let at = |bounds, goal| choose(&points, &bounds, goal).unwrap();
    let fewest = at(Bounds { mismatch: Some(0.05), ..Bounds::default() }, Goal::Spheres);
    assert_eq!(points[fewest.index].spheres, 8, "{}", fewest.why);
    assert!(fewest.why.contains("fewest spheres of those with D ≤ 0.05"), "{}", fewest.why);
    let best =
        at(Bounds { seconds: Some(0.005), spheres: Some(60), ..Bounds::default() }, Goal::Mismatch);
    assert_eq!(points[best.index].spheres, 4, "{}", best.why);
    assert!(
        best.why.contains("D 0.0375 with 8 spheres would take seconds of 0.008"),
        "{}",
        best.why
    );
    let cheap = at(Bounds { coverage: Some(0.9), ..Bounds::default() }, Goal::StepCost);
    assert_eq!(points[cheap.index].spheres, 4);
    let cheap = at(Bounds { surface: Some(0.01), ..Bounds::default() }, Goal::TimeCost);
    assert_eq!(points[cheap.index].spheres, 16);
    let quick = at(Bounds::default(), Goal::Seconds);
    assert_eq!(points[quick.index].spheres, 1);
    let best = at(
        Bounds { step_cost: Some(9.0), time_cost: Some(18.0), ..Bounds::default() },
        Goal::Mismatch,
    );
    assert_eq!(points[best.index].spheres, 8);
}

#[test]
fn the_knee_is_where_the_curve_bends() {
    let points = bent();
    let choice = choose(&points, &Bounds::default(), Goal::Knee).unwrap();
    assert_eq!(points[choice.index].spheres, 16);
    assert!(choice.why.contains("the knee") && choice.why.contains("beyond it"), "{}", choice.why);
    // A point that is worse than a cheaper one changes nothing.
    let mut odd = points.clone();
    odd.insert(3, point(6, 0.5));
    let choice = choose(&odd, &Bounds::default(), Goal::Knee).unwrap();
    assert_eq!(odd[choice.index].spheres, 16);
    // Within bounds that end before it.
    let few = Bounds { spheres: Some(8), ..Bounds::default() };
    let choice = choose(&points, &few, Goal::Knee).unwrap();
    assert!(points[choice.index].spheres <= 8);
    // A power law has none.
    let costs = [2, 4, 8, 16, 32].map(|n| {
        let p = point(n, 0.3);
        Point { mismatch: 0.3 / p.step_cost.sqrt(), ..p }
    });
    let choice = choose(&costs, &Bounds::default(), Goal::Knee).unwrap();
    assert!(choice.why.contains("no knee") && choice.why.contains("29 %"), "{}", choice.why);
    assert_eq!(costs[choice.index].spheres, 32);
}

#[test]
fn what_cannot_be_met_is_said() {
    let points = bent();
    let none = |b: Bounds| match choose(&points, &b, Goal::Spheres) {
        Err(Error::NoSpheres(text)) => text,
        other => panic!("{other:?}"),
    };
    let text = none(Bounds { mismatch: Some(0.001), spheres: Some(1000), ..Bounds::default() });
    assert!(text.contains("D ≤ 0.001") && text.contains("D of 0.018"), "{text}");
    let text = none(Bounds { mismatch: Some(0.02), spheres: Some(8), ..Bounds::default() });
    assert!(text.contains("all of them by none"), "{text}");
    assert!(matches!(choose(&[], &Bounds::default(), Goal::Knee), Err(Error::Empty(_))));
    let bad = Bounds { seconds: Some(f64::NAN), ..Bounds::default() };
    let error = choose(&points, &bad, Goal::Knee).unwrap_err();
    assert!(matches!(&error, Error::InvalidArgument(t) if t.contains("seconds")), "{error}");
}
