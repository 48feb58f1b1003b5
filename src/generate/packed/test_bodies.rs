//! Bodies for the tests of this folder.

use crate::math::Vec3;
use crate::run::Run;
use crate::shape::{ImportOptions, Primitive, Shape};
use crate::solid::{Resolution, Solid, SolidOptions};

/// A block of 1 x 0.75 x 0.5 with a corner in the origin of the unit frame.
pub(super) fn block() -> Solid {
    let mut body = Primitive::from_name("box").unwrap();
    for (key, value) in [("a", 1.0), ("b", 0.75), ("c", 0.5)] {
        body.set(key, value).unwrap();
    }
    let run = Run::serial();
    let shape = Shape::from_primitive(&body, 8, &ImportOptions::default(), &run).unwrap();
    let resolution = Resolution::CellsLongest(24);
    Solid::new(&shape, &SolidOptions { resolution, ..SolidOptions::default() }, &run).unwrap()
}

/// Its edges.
pub(super) fn size() -> Vec3 {
    Vec3::new(1.0, 0.75, 0.5)
}
