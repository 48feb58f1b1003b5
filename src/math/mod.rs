//! Small geometry that every room uses: spheres, the unit frame, inertia,
//! directions.

mod angle;
mod axes;
mod ears;
mod frame;
mod inertia;
mod principal;
mod sphere;

pub(crate) use angle::half_solid_angle;
pub use angle::solid_angle;
pub use axes::Axes;
pub(crate) use ears::{Ears, Next, turn};
pub use frame::UnitFrame;
pub use inertia::{Inertia, Moments};
pub use principal::PrincipalFrame;
pub use sphere::Sphere;

/// A point or vector in three dimensions.
pub type Vec3 = nalgebra::Vector3<f64>;
