//! Small geometry that every room uses: spheres, the unit frame, inertia,
//! directions.

mod frame;
mod inertia;
mod sphere;

pub use frame::UnitFrame;
pub use inertia::{Inertia, Moments, PrincipalFrame};
pub use sphere::Sphere;

/// A point or vector in three dimensions.
pub type Vec3 = nalgebra::Vector3<f64>;
