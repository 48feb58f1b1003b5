//! The structs of price lists. Their rules are those of `structs.rs`.

use super::mass_structs::morula_contact_options;

/// What a price list is made of, beside morula_clump_options. Fill it with
/// morula_cost_options_init().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_cost_options {
    /// sizeof(morula_cost_options).
    pub struct_size: usize,
    /// Numbers of spheres, ascending; NULL with a count of 0: from 1 to `most`, about ten between
    /// each and its tenfold. Copied before the call returns.
    pub counts: *const u64,
    /// Number of counts. Default 0.
    pub count: usize,
    /// The last number of spheres where there are no counts. Default 100.
    pub most: u64,
    /// Seconds that each clump may take; 0: as long as it takes. Default 0.
    pub seconds: f64,
    /// Mass per (caller's unit)^3. Default 1.
    pub density: f64,
    /// The contacts for which the time step holds; NULL: a spring of stiffness 1.
    pub contact: *const morula_contact_options,
    /// What one step of the solver costs with clumps of n spheres, over one with single spheres:
    /// a + b n + c n^2. Default: fitted to LAMMPS; to the engine of `morula simulate`: 1.16, 0, 2.55e-6
    /// with `lists` of 0, 0.
    pub step: [f64; 3],
    /// And what lists of neighbours add: (d n + e n^2) / rebuild. Default: fitted to LAMMPS.
    pub lists: [f64; 2],
    /// Steps from one list to the next. Default 50.
    pub rebuild: f64,
    /// What the clumps have to do with each other: one of MORULA_LEVELS_*. Default
    /// MORULA_LEVELS_FREE.
    pub levels: i32,
    /// 1: the distance between the surfaces is measured. Default 1.
    pub surface: i32,
    /// 1: spheres are weighed, and the error of the inertia that is left is told. Default 1.
    pub masses: i32,
    /// Columns along each of the two sampled axes of the quality figures; 0: the library's
    /// choice. Default 0.
    pub quality_columns: u32,
}

/// One line of a price list. Lengths are over the equivalent diameter; what was not wanted is 0.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_cost_point {
    /// sizeof(morula_cost_point), set by the caller in the first of an array.
    pub struct_size: usize,
    /// Spheres asked for.
    pub asked: u64,
    /// Spheres of the clump.
    pub spheres: u64,
    /// Mismatch D.
    pub mismatch: f64,
    /// |S and C| / |S|.
    pub coverage: f64,
    /// |C without S| / |S|.
    pub overshoot: f64,
    /// RMS distance between the surfaces, both ways.
    pub surface: f64,
    /// Greatest distance between the surfaces.
    pub hausdorff: f64,
    /// Greatest distance of the clump beyond the target.
    pub protrusion: f64,
    /// RMS angle between the normals, radians.
    pub roughness: f64,
    /// By how much the trace of the inertia of the spheres' union is less than that of the target
    /// at one density, over the latter.
    pub union_inertia: f64,
    /// The error of the inertia that is left with the masses of the spheres corrected, as
    /// inertia_residual of morula_masses.
    pub inertia: f64,
    /// Seconds that this clump takes from a ready solid: of the method with the distance field, and
    /// where the clump starts from those before, theirs, too.
    pub seconds: f64,
    /// Seconds so far: distance field, this clump and all before it.
    pub seconds_so_far: f64,
    /// The time step that the clump allows, as in morula_timestep.
    pub time_step: f64,
    /// The Rayleigh step of its spheres; 0 for a linear spring.
    pub rayleigh: f64,
    /// time_step over that of a sphere of the same mass and volume.
    pub step_factor: f64,
    /// The least radius over that of the sphere of equal volume.
    pub least_radius: f64,
    /// What one step of the solver costs, in units of one with single spheres.
    pub step_cost: f64,
    /// What simulated time costs, in the same unit: step_cost / step_factor.
    pub time_cost: f64,
    /// How far the masses meet the equations: one of MORULA_MASSES_*; MORULA_MASSES_NONE where
    /// none were wanted.
    pub masses: i32,
    /// Why the method stopped: one of MORULA_STOPPED_*.
    pub stopped: i32,
}

/// What a clump may cost, how good it must be, and what is made best. Fill it with
/// morula_cost_bounds_init(). 0 bounds nothing.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_cost_bounds {
    /// sizeof(morula_cost_bounds).
    pub struct_size: usize,
    /// Most spheres.
    pub spheres: u64,
    /// Greatest mismatch D.
    pub mismatch: f64,
    /// Least coverage.
    pub coverage: f64,
    /// Greatest RMS distance between the surfaces, over the equivalent diameter.
    pub surface: f64,
    /// Most seconds of the method.
    pub seconds: f64,
    /// Greatest cost of a step, in steps with single spheres.
    pub step_cost: f64,
    /// Greatest cost of simulated time, in the same unit.
    pub time_cost: f64,
    /// One of MORULA_GOAL_*. Default MORULA_GOAL_KNEE.
    pub goal: i32,
    /// Must be 0.
    pub reserved: i32,
}

/// What is swept over: every resolution with every method and every deadline. Fill it with
/// morula_sweep_options_init(), which leaves all empty; none may stay so. The arrays are copied
/// before the call returns.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_sweep_options {
    /// sizeof(morula_sweep_options).
    pub struct_size: usize,
    /// Numbers of cells, along what morula_solid_options.resolution says; with
    /// MORULA_RESOLUTION_CELL_SIZE edges of a cell. The grid of a voxel shape is its own: one is
    /// enough.
    pub resolutions: *const f64,
    /// Number of resolutions.
    pub resolution_count: usize,
    /// Methods: MORULA_METHOD_*.
    pub methods: *const i32,
    /// Their efforts: MORULA_EFFORT_*, as many as methods; NULL: that of the clump options for all.
    pub efforts: *const i32,
    /// Number of methods.
    pub method_count: usize,
    /// Seconds that each clump may take; 0: as long as it takes.
    pub deadlines: *const f64,
    /// Number of deadlines.
    pub deadline_count: usize,
}

/// What one price list of a sweep is of.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_swept {
    /// sizeof(morula_swept), set by the caller in the first of an array.
    pub struct_size: usize,
    /// The resolution, as it stood in the options.
    pub resolution: f64,
    /// Cells along x, y, z, padding included; 0 where the solid could not be made.
    pub cells: [u64; 3],
    /// Seconds that the solid took, once for all lists of one resolution.
    pub solid_seconds: f64,
    /// Seconds that each clump was given; 0: as long as it takes.
    pub deadline: f64,
    /// Lines of the list; 0 where there is none.
    pub lines: u64,
    /// One of MORULA_METHOD_*.
    pub method: i32,
    /// One of MORULA_EFFORT_*.
    pub effort: i32,
    /// MORULA_STATUS_OK, or why there is no list.
    pub status: i32,
    /// 1: cancel or the sweep's deadline ended the list before its last number of spheres.
    pub cut: i32,
}
