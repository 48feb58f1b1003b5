//! Bodies for the tests of this folder.

use super::dexels::Dexels;
use crate::math::Vec3;
use crate::run::{Pool, Run};
use crate::shape::primitive::Primitive;
use crate::shape::{ImportOptions, Shape};
use crate::solid::{Solid, SolidOptions};

pub(crate) struct Bodies {
    pub solid: Solid,
    pub distance: Vec<f32>,
    pub bounds: [Vec3; 2],
}

impl Bodies {
    pub(crate) fn dexels(&self, columns: usize) -> Dexels {
        Dexels::new(&self.solid, &self.bounds, columns, &Pool::serial()).unwrap()
    }
}

/// A box, and a torus: flat and round, with and without a hole.
pub(crate) fn bodies() -> Vec<Bodies> {
    ["box", "torus"]
        .map(|name| {
            let run = Run::serial();
            let primitive = Primitive::from_name(name).unwrap();
            let shape =
                Shape::from_primitive(&primitive, 48, &ImportOptions::default(), &run).unwrap();
            let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
            let distance = solid.distance(&run).unwrap().to_vec();
            let bounds = super::bounds(&solid).unwrap();
            Bodies { solid, distance, bounds }
        })
        .into()
}
