//! The structs of masses, time steps and export. Their rules are those of `structs.rs`.

use super::callbacks::morula_progress;
use std::ffi::{c_char, c_void};

/// How the spheres of a clump are weighed. Fill it with morula_mass_options_init().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_mass_options {
    /// sizeof(morula_mass_options).
    pub struct_size: usize,
    /// Mass per (caller's unit)^3. Default 1.
    pub density: f64,
    /// Least mass of a sphere; negative: a thousandth of the body's mass, or a tenth of the mean
    /// where that is less. Default -1.
    pub m_min: f64,
    /// Greatest mass of a sphere; 0: no bound. Default 0.
    pub m_max: f64,
    /// Whose mass, centre and inertia the clump is to have: one of MORULA_TARGET_*. Default
    /// MORULA_TARGET_SOLID.
    pub target: i32,
    /// What is wished of the masses beside: one of MORULA_OBJECTIVE_*. Default
    /// MORULA_OBJECTIVE_EVEN.
    pub objective: i32,
    /// What to do where no masses have the centre: one of MORULA_INFEASIBLE_*. Default
    /// MORULA_INFEASIBLE_REFUSE.
    pub infeasible: i32,
    /// Threads of this call; 0: all cores. Default 1. The result does not depend on it.
    pub threads: i32,
    /// Called now and then on the calling thread; NULL: none.
    pub progress: morula_progress,
    /// Handed to `progress`.
    pub user: *mut c_void,
}

/// How far the masses of the spheres add up to the body.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_masses {
    /// sizeof(morula_masses), set by the caller.
    pub struct_size: usize,
    /// Mass of the body.
    pub mass: f64,
    /// The least mass that was demanded.
    pub m_min: f64,
    /// Where not all equations are met: the greatest m_min with which they could be, under the same
    /// m_max; 0 where no positive masses meet them, or where they are met.
    pub largest_m_min: f64,
    /// |sum of masses - mass| / mass.
    pub mass_residual: f64,
    /// Greatest component, along the body axes, of the distance between the centres, over the
    /// radius of gyration.
    pub centre_residual: f64,
    /// The greatest |error of I_jk| / sqrt(J_j J_k) in the body frame, J the principal moments.
    pub inertia_residual: f64,
    /// MORULA_OBJECTIVE_EVEN: how far the density varies, sqrt(sum (m - s)^2 / s / mass) with each
    /// sphere's share s of the union; else 0.
    pub spread: f64,
    /// By how much the trace of the inertia of the spheres' union is less than that of the target
    /// at one density, over the latter; 0 where the union is the target. A target shrunk to a
    /// coverage c would lack 1 - c^(5/3).
    pub union_inertia_error: f64,
    /// One of MORULA_MASSES_*.
    pub status: i32,
    /// Spheres whose mass is m_min or m_max.
    pub binding: u32,
}

/// What is known of the contacts of a particle. Fill it with morula_contact_options_init().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_contact_options {
    /// sizeof(morula_contact_options).
    pub struct_size: usize,
    /// Stiffness of a linear spring, force per length; 0: elastic spheres (Hertz) of `young` and
    /// `poisson`. Default 0.
    pub stiffness: f64,
    /// Young's modulus, force per area. Default 0, which is refused where it is read.
    pub young: f64,
    /// Poisson's ratio. Default 0.3.
    pub poisson: f64,
    /// Greatest speed at which two particles meet. Default 1.
    pub speed: f64,
    /// How many contacts act on a particle at once, as far as they push the same way. Default 1.
    pub contacts: u32,
    /// Must be 0.
    pub reserved: u32,
}

/// What a clump allows: three figures that answer three questions. A solver takes a part (a tenth to a
/// fifth) of the first, or of the second where it demands that.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_timestep {
    /// sizeof(morula_timestep), set by the caller.
    pub struct_size: usize,
    /// What the rigid clump obeys: beyond sqrt(2 m / (N k)) an explicit integration of two equal
    /// clumps that touch in N contacts at their worst points gains energy without bound.
    pub clump: f64,
    /// The mass m that is felt there: 1/m = 1/M + (p x n) I^-1 (p x n) at the point of a sphere
    /// where pushing turns the clump most easily.
    pub effective_mass: f64,
    /// The stiffness k there: the spring's, or that of Hertz at the greatest overlap.
    pub stiffness: f64,
    /// The Rayleigh step of single spheres, pi r sqrt(density/G) / (0.1631 poisson + 0.8766),
    /// least over the spheres, each with the density that its mass gives it: what some codes
    /// demand although in a clump no sphere moves by itself. 0 for a linear spring.
    pub rayleigh: f64,
    /// The greatest overlap over the least radius when two clumps meet centrally at that speed, in
    /// one contact of their smallest spheres: contact laws hold far below 0.1.
    pub overlap: f64,
    /// The sphere of the worst point.
    pub sphere: u32,
    /// 0.
    pub reserved: u32,
    /// The same limit as `clump` where the N contacts push the same way on N spheres, those that are
    /// stiffest together, instead of all at the worst point: for flat bodies that lie on each other.
    /// Never less than `clump`, at most four times as much, the same for one contact.
    pub together: f64,
}

/// How a file for a DEM code is written. Fill it with morula_export_options_init().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_export_options {
    /// sizeof(morula_export_options).
    pub struct_size: usize,
    /// How many units of length of the file one of the caller's has (1000 from metres to
    /// millimetres). Default 1.
    pub length: f64,
    /// The same of mass. Default 1.
    pub mass: f64,
    /// 1: coordinates in the caller's frame instead of the body's, where the format has a choice.
    /// Default 0.
    pub placed: i32,
    /// Facets of each sphere where a surface is written: 20 * 4^facets triangles, at most 6.
    /// Default 3.
    pub facets: u32,
    /// Name of the template (UTF-8); NULL: "clump".
    pub name: *const c_char,
    /// One of MORULA_PRECISION_*: MORULA_PRECISION_F32 writes centres and radii that single
    /// precision holds, each sphere within the one that it stands for. Default MORULA_PRECISION_F64.
    pub precision: i32,
    /// Must be 0.
    pub reserved: i32,
}
