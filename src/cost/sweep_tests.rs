use super::*;
use crate::cost::Point;
use crate::measure::QualityOptions;
use crate::shape::Primitive;

#[test]
fn every_combination_has_its_curve() {
    let run = Run::serial();
    let particle = Primitive::from_name("ellipsoid").unwrap();
    let shape = Shape::from_primitive(&particle, 24, &Default::default(), &run).unwrap();
    let quality = QualityOptions { columns: 32, surface: false, ..QualityOptions::default() };
    let options = SweepOptions {
        resolutions: vec![Resolution::CellsLongest(16), Resolution::CellsLongest(24)],
        methods: vec![(Method::Best, Effort::Draft), (Method::Cover, Effort::Normal)],
        seconds: vec![0.0],
        solid: SolidOptions::default(),
        curve: CurveOptions { counts: vec![2, 4], quality, ..CurveOptions::default() },
    };
    let one = sweep(&shape, &options, &run).unwrap();
    assert_eq!(one.len(), 4);
    let two = sweep(&shape, &options, &Run::new(2).unwrap()).unwrap();
    let timeless = |s: &Swept| -> Vec<Point> {
        let points = &s.curve.as_ref().unwrap().points;
        points.iter().map(|p| Point { seconds: 0.0, seconds_so_far: 0.0, ..*p }).collect()
    };
    for (a, b) in one.iter().zip(&two) {
        assert_eq!((a.resolution, a.cells, a.method), (b.resolution, b.cells, b.method));
        assert_eq!(timeless(a), timeless(b));
        assert_eq!(timeless(a).len(), 2);
    }
    assert!(one[0].cells[0] < one[2].cells[0] && one[0].method == one[2].method);
    assert!(one[0].solid_seconds > 0.0);
    // Cancelled in the middle: what was made stays.
    let cancel = Run::serial().with_progress(Box::new(|f| f > 0.6));
    let some = sweep(&shape, &options, &cancel).unwrap();
    assert_eq!(some.len(), 4);
    assert!(some[0].curve.is_ok() && some[3].curve.is_err());
    // One deadline that is no number: refused before anything is made.
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        let never = Run::serial().with_progress(Box::new(|_| panic!("work was begun")));
        let wrong = SweepOptions { seconds: vec![0.0, bad], ..options.clone() };
        let refused = sweep(&shape, &wrong, &never);
        assert!(matches!(refused, Err(Error::InvalidArgument(t)) if t.contains("deadline 1")));
    }
    let nothing = SweepOptions { methods: Vec::new(), ..options };
    assert!(matches!(sweep(&shape, &nothing, &run), Err(Error::Empty(t)) if t.contains("method")));
}
