//! The structs of breaks. Their rules are those of `structs.rs`.

use super::callbacks::morula_progress;
use std::ffi::c_void;

/// How a particle breaks. Fill it with morula_break_options_init(). Points, directions and
/// half-spaces are in the frame and unit of the shape.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_break_options {
    /// sizeof(morula_break_options).
    pub struct_size: usize,
    /// MORULA_CUT_PLANES and MORULA_CUT_WITHIN: four numbers each, nx, ny, nz and offset, which
    /// hold the points p with n . p <= offset; n points out and has any length but 0.
    pub half_spaces: *const f64,
    /// How many.
    pub half_space_count: usize,
    /// MORULA_CUT_POINTS: x, y, z each.
    pub points: *const f64,
    /// One a point, in squares of the unit, for power cells; NULL: none.
    pub weights: *const f64,
    /// How many points.
    pub point_count: usize,
    /// Further half-spaces that no sphere may leave (walls of the scene), as half_spaces.
    pub walls: *const f64,
    /// How many.
    pub wall_count: usize,
    /// MORULA_CUT_SEEDED and MORULA_CUT_IMPACT: number of cells. Default 4.
    pub cells: u64,
    /// MORULA_CUT_IMPACT: where the body is hit.
    pub point: [f64; 3],
    /// MORULA_CUT_IMPACT: where to; of any length but 0. Default 1, 0, 0.
    pub direction: [f64; 3],
    /// Seed of every random choice. Default 0.
    pub seed: u64,
    /// Pieces of less volume become dust; 0: a 1e-9th of the parent's. Default 0.
    pub least_volume: f64,
    /// Most spheres of a fragment. Default 20.
    pub spheres: u64,
    /// Least radius. Default 0.
    pub min_radius: f64,
    /// Spheres of two fragments are this far apart at least. Default 0.
    pub gap: f64,
    /// Least mass of a sphere where masses are wanted; negative: a thousandth of the fragment's
    /// mass, or a tenth of the mean where that is less. Default -1.
    pub m_min: f64,
    /// Seconds after which the spheres are taken as they are; 0: no deadline. Default 0.
    pub deadline_seconds: f64,
    /// One of MORULA_CUT_*. Default MORULA_CUT_SEEDED.
    pub kind: i32,
    /// 1: spheres stay within the union of the parent's, which neighbours touch. Default 1.
    pub within_union: i32,
    /// One of MORULA_PRECISION_*: MORULA_PRECISION_F32 gives centres and radii that single
    /// precision holds, in the frame of the shape. Default MORULA_PRECISION_F64.
    pub precision: i32,
    /// 1: coverage, volume_share and step_factor are wanted. Default 1.
    pub quality: i32,
    /// 1: a mass for each sphere is wanted. Default 0.
    pub masses: i32,
    /// Of the masses: one of MORULA_OBJECTIVE_*. Default MORULA_OBJECTIVE_EVEN.
    pub objective: i32,
    /// Of the masses: one of MORULA_INFEASIBLE_*. Default MORULA_INFEASIBLE_REFUSE, which leaves
    /// such a fragment without masses.
    pub infeasible: i32,
    /// Threads of this call; 0: all cores. Default 1. The result does not depend on it.
    pub threads: i32,
    /// Called now and then on the calling thread; NULL: none.
    pub progress: morula_progress,
    /// Handed to `progress`.
    pub user: *mut c_void,
}

/// A rigid body as a solver holds it: the shape in its place, and how it moves. A point x of the
/// shape is at position + quaternion (scale (x - centre)). Fill it with morula_parent_held(),
/// morula_fragments_held() or, before its fields are set by hand, morula_held_init().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_held {
    /// sizeof(morula_held).
    pub struct_size: usize,
    /// Mass.
    pub mass: f64,
    /// Centre of mass, frame and unit of the shape.
    pub centre: [f64; 3],
    /// Inertia about the centre along the axes of the shape (not of the body), in mass x length^2
    /// of the world: xx, yy, zz, xy, xz, yz.
    pub inertia: [f64; 6],
    /// What lengths of the shape are multiplied by. Default 1.
    pub scale: f64,
    /// Where the centre is.
    pub position: [f64; 3],
    /// From the axes of the shape to those of the world: w, x, y, z of any length but 0. Default
    /// 1, 0, 0, 0.
    pub quaternion: [f64; 4],
    /// Velocity of the centre.
    pub velocity: [f64; 3],
    /// Angular velocity, along the axes of the world.
    pub angular_velocity: [f64; 3],
}

/// A fragment, or a piece of dust, which has no spheres.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_fragment {
    /// sizeof(morula_fragment), set by the caller.
    pub struct_size: usize,
    /// Mass.
    pub mass: f64,
    /// Centre of mass, frame and unit of the shape.
    pub centre: [f64; 3],
    /// Inertia about it along the axes of the shape, in mass x length^2 of the world: xx, yy, zz,
    /// xy, xz, yz.
    pub inertia: [f64; 6],
    /// Principal moments, ascending.
    pub principal: [f64; 3],
    /// Body axes in the frame of the shape, by columns.
    pub rotation: [f64; 9],
    /// Where the centre is in the world.
    pub position: [f64; 3],
    /// The body axes in the world: w, x, y, z, w >= 0.
    pub quaternion: [f64; 4],
    /// Velocity of the centre.
    pub velocity: [f64; 3],
    /// Angular velocity, along the axes of the world.
    pub angular_velocity: [f64; 3],
    /// Volume, unit of the shape.
    pub volume: f64,
    /// Share of its volume that its spheres cover; 0 where not wanted.
    pub coverage: f64,
    /// Volume of the union of its spheres over that of the parent's solid; 0 where not wanted.
    pub volume_share: f64,
    /// The time step that it allows over that of the parent's clump, for the same spring and
    /// density; 0: not known (the parent has no spheres, or it was not wanted).
    pub step_factor: f64,
    /// Of its masses: the greatest |error of I_jk| / sqrt(J_j J_k) in the body frame; 0 where
    /// there are none.
    pub inertia_residual: f64,
    /// Spheres.
    pub sphere_count: u64,
    /// Pairs of its map.
    pub map_count: u64,
    /// Half-spaces that bound it within the parent's solid.
    pub half_space_count: u64,
    /// The cell of the cut that it comes from: the number of the point, or of the side.
    pub cell: u64,
    /// Why it has no more spheres: one of MORULA_STOPPED_*.
    pub stopped: i32,
    /// One of MORULA_MASSES_*; MORULA_MASSES_NONE where none were wanted or found (the notes tell).
    pub masses: i32,
}

/// What a break has made of the whole.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_break_totals {
    /// sizeof(morula_break_totals), set by the caller.
    pub struct_size: usize,
    /// Kinetic energy of fragments and dust less that of the parent: rounding where the inertia
    /// of the held body is that of its solid.
    pub energy: f64,
    /// The greatest entry of the held inertia less that of the pieces, over its greatest; the greatest
    /// number where the held body has none.
    pub inertia_error: f64,
    /// How far the held centre lies from that of the pieces, frame and unit of the shape: by so
    /// much the centres of all of them are shifted.
    pub shift: [f64; 3],
}

/// What a cache of parents has done, and what it holds.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_cache_counts {
    /// sizeof(morula_cache_counts), set by the caller.
    pub struct_size: usize,
    /// Parents that were there.
    pub hits: u64,
    /// Parents that were made.
    pub misses: u64,
    /// Parents that had to go, or that were too large to stay.
    pub evicted: u64,
    /// Parents that are held.
    pub parents: u64,
    /// Bytes of these, with their solids.
    pub bytes: u64,
}
