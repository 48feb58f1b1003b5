//! What a solver takes of a clump: mass, centre, inertia and body frame of the true shape or of
//! the union of the spheres, and a mass for each sphere such that the spheres together have them.

mod body;
mod cone;
mod correct;
mod lattice;
mod outside;
mod pile;
mod problem;
mod project;
mod relax;
mod share;
mod single;
mod timestep;
mod together;
mod transform;
mod union;

pub use body::{Body, Target, coverage_rule, inertia_error};
pub use correct::{Infeasible, MassOptions, MassStatus, Masses, Objective, Residuals, correct};
pub(crate) use pile::check as check_spheres;
pub use single::single_precision;
pub use timestep::{Contact, ContactOptions, TimeStep, time_step};
pub use transform::{Placement, random_orientations};
pub use union::union_moments;
