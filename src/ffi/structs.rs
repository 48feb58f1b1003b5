//! The structs of the header. Each begins with `struct_size`, has no padding
//! and grows only at its end (see `options.rs`; what they begin with is in
//! `defaults.rs`).

use super::callbacks::morula_progress;
use std::ffi::c_void;

/// How a shape is taken in. Fill it with morula_import_options_init().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_import_options {
    /// sizeof(morula_import_options).
    pub struct_size: usize,
    /// Vertices at open edges that are nearer to each other than this times the longest edge of
    /// the bounding box (and than a quarter of the faces' median edge) are one, where that closes
    /// the surface further. Default 1e-6; 0: only equal ones.
    pub weld_tolerance: f64,
    /// Coordinates are multiplied by it (0.001 takes millimetres to metres). Default 1.
    pub length_unit: f64,
    /// Most bytes that the shape's arrays may take. Default 2 GiB.
    pub memory_limit: u64,
    /// One of MORULA_BODIES_*. Default MORULA_BODIES_REFUSE.
    pub bodies: i32,
    /// 0 or 1: the index of the first vertex in an array of triangles. Default 0.
    pub index_base: i32,
    /// Threads of this call; 0: all cores. Default 1.
    pub threads: i32,
    /// Must be 0.
    pub reserved: i32,
    /// Called now and then on the calling thread; NULL: none.
    pub progress: morula_progress,
    /// Handed to `progress`.
    pub user: *mut c_void,
}

/// How a file is read, beside morula_import_options. Fill it with morula_file_options_init().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_file_options {
    /// sizeof(morula_file_options).
    pub struct_size: usize,
    /// One of MORULA_FORMAT_*. Default MORULA_FORMAT_AUTO.
    pub format: i32,
    /// One of MORULA_MEANING_*, for voxel files. Default MORULA_MEANING_AUTO.
    pub meaning: i32,
    /// Grey values above it are solid (MORULA_MEANING_ABOVE). Default 0.
    pub threshold: f64,
    /// The label that is taken (MORULA_MEANING_LABEL). Default 1.
    pub label: u32,
    /// 0: an npy array of shape (a, b, c) has axes z, y, x; 1: x, y, z. Default 0.
    pub npy_xyz: i32,
    /// Edge lengths of a voxel along x, y, z, before length_unit. Default 1, 1, 1.
    pub spacing: [f64; 3],
    /// Lower corner of the first voxel, before length_unit. Default 0, 0, 0.
    pub origin: [f64; 3],
    /// Raw voxels along x, y, z; x is fastest.
    pub raw_dims: [u64; 3],
    /// Bytes before the first raw voxel. Default 0.
    pub raw_skip: u64,
    /// One of MORULA_RAW_*. Default MORULA_RAW_U8.
    pub raw_type: i32,
    /// Must be 0.
    pub reserved: i32,
}

/// How a solid is made. Fill it with morula_solid_options_init().
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_solid_options {
    /// sizeof(morula_solid_options).
    pub struct_size: usize,
    /// One of MORULA_RESOLUTION_*. Default MORULA_RESOLUTION_CELLS_LONGEST. Voxel shapes keep
    /// their own cells.
    pub resolution: i32,
    /// Number of cells for the MORULA_RESOLUTION_CELLS_* kinds. Default 64.
    pub cells: u32,
    /// Edge length of a cell for MORULA_RESOLUTION_CELL_SIZE. Default 0.
    pub cell_size: f64,
    /// Most bytes that the grid's arrays may take together, and what tells the inside of an open
    /// mesh; a tree over the surface (made by the first call that needs exact distances) and
    /// quality figures are held to what is left. Default 2 GiB.
    pub memory_limit: u64,
    /// Empty cells around the shape, at least 2. Default 4.
    pub padding: u32,
    /// Threads of this call; 0: all cores. Default 1. Not read by morula_clump_from_shape().
    pub threads: i32,
    /// Called now and then on the calling thread; NULL: none. Not read by morula_clump_from_shape().
    pub progress: morula_progress,
    /// Handed to `progress`.
    pub user: *mut c_void,
}

/// What a clump is asked for. Fill it with morula_clump_options_init(). The
/// criteria (spheres, mismatch, min_radius, deadline_seconds) apply alone or
/// together: the first that is met stops the method. MORULA_METHOD_BEST, which
/// makes all spheres at once, looks for the fewest that have the mismatch, and
/// keeps all radii at min_radius or more.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_clump_options {
    /// sizeof(morula_clump_options).
    pub struct_size: usize,
    /// Number of spheres; 0: no limit. Default 50.
    pub spheres: u64,
    /// Stop at this mismatch D (on the method's own grid, but for MORULA_METHOD_BEST: as
    /// morula_clump_overlap() has it); 0: no target. Default 0.
    pub mismatch: f64,
    /// Least radius, in the caller's unit. Default 0.
    pub min_radius: f64,
    /// Least distance between centres, in cells of the grid. Default 0.
    pub min_distance: f64,
    /// Added to every radius, in cells of the grid; 0 has no bias. Default 0.
    pub radius_offset: f64,
    /// Seconds from the start of the call after which the method stops with what it has; 0:
    /// none. Default 0.
    pub deadline_seconds: f64,
    /// Seed of every random choice. Default 0.
    pub seed: u64,
    /// One of MORULA_METHOD_*. Default MORULA_METHOD_BEST. min_distance, radius_offset and confine
    /// are read by MORULA_METHOD_MSS alone; MORULA_METHOD_INSCRIBED
    /// needs a number of spheres. Every method refuses what it does not read.
    pub method: i32,
    /// 1: limit the radii so that no sphere reaches beyond the true surface. Default 0.
    pub confine: i32,
    /// Threads of this call; 0: all cores. The spheres do not depend on it. Default 1.
    pub threads: i32,
    /// One of MORULA_FRAME_*. Default MORULA_FRAME_INPUT.
    pub frame: i32,
    /// Sum of MORULA_WANT_*. What is not wanted is not computed. Default MORULA_WANT_MOMENTS.
    pub wants: u32,
    /// Columns along each of the two sampled axes of the quality figures; 0: the library's
    /// choice. Default 0.
    pub quality_columns: u32,
    /// For each of these distances, count the most spheres that one plane touches within it
    /// (caller's unit); NULL with a count of 0: none. Copied before the call returns.
    pub plane_tolerances: *const f64,
    /// Number of plane_tolerances. Default 0.
    pub plane_tolerance_count: usize,
    /// Called now and then on the calling thread; NULL: none.
    pub progress: morula_progress,
    /// Handed to `progress`.
    pub user: *mut c_void,
    /// One of MORULA_EFFORT_*, for MORULA_METHOD_BEST and MORULA_METHOD_INSCRIBED. Default MORULA_EFFORT_NORMAL.
    pub effort: i32,
    /// Must be 0.
    pub reserved: i32,
    /// Stop when this share of the volume is covered, by the method's own cells; 0: no target.
    /// This and the four below for MORULA_METHOD_COVER alone. Default 0.
    pub coverage: f64,
    /// One of MORULA_ENDS_*. Default MORULA_ENDS_SURFACE.
    pub ends: i32,
    /// One of MORULA_CANDIDATES_*. Default MORULA_CANDIDATES_THINNED.
    pub candidates: i32,
    /// Voxels to be thinned, along the diameter of the sphere of equal volume. Default 60.
    pub thinning_cells: u32,
    /// Cells to be covered, along the same diameter within the body; half their size at its
    /// surface. Default 50.
    pub cells_inside: u32,
    /// How far a sphere may reach beyond the surface, in the caller's unit, for
    /// MORULA_METHOD_INSCRIBED, MORULA_METHOD_EUCLIDEAN and the methods after it. Default 0.
    pub tolerance: f64,
    /// MORULA_METHOD_EUCLIDEAN: by which part of its radius a sphere is shrunk before it is taken
    /// from the body; 0: the spheres do not overlap. Default 0.9.
    pub overlap: f64,
    /// How many times as much as target that is not covered, clump beyond the target counts. This
    /// and all below for MORULA_METHOD_BEST alone. Default 1.
    pub overshoot_weight: f64,
    /// How far a sphere may reach beyond the surface, in the caller's unit; 0: as far as is best.
    /// Default 0.
    pub max_protrusion: f64,
    /// Greatest radius, in the caller's unit; 0: as large as is best. Default 0.
    pub max_radius: f64,
    /// Weight of the distance between the surfaces against D; 0: D alone. Default 0.
    pub smoothness: f64,
    /// 1: the spheres hang together by overlaps. Default 0.
    pub connected: i32,
    /// 1: the union of the spheres has the volume of the target. Default 0.
    pub equal_volume: i32,
    /// One of MORULA_SYMMETRY_*. Default MORULA_SYMMETRY_NONE.
    pub symmetry: i32,
    /// Number of symmetry_planes. Default 0.
    pub symmetry_plane_count: u32,
    /// Of each half-space that no sphere may leave nx, ny, nz, d: the points p with n . p <= d, in
    /// the caller's frame and unit; n of any length but 0. NULL with a count of 0: none. Copied
    /// before the call returns.
    pub half_spaces: *const f64,
    /// Number of half_spaces. Default 0.
    pub half_space_count: usize,
    /// For MORULA_SYMMETRY_PLANES, the normals of mirror planes through the centre of mass: x, y, z
    /// each. Copied before the call returns.
    pub symmetry_planes: *const f64,
}

/// What was found in an input and what was done about it. Lengths, areas and
/// volumes are in the caller's unit and frame.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_report {
    /// sizeof(morula_report), set by the caller.
    pub struct_size: usize,
    /// Vertices as handed in.
    pub input_vertices: u64,
    /// Triangles as handed in, after polygons were cut into triangles.
    pub input_faces: u64,
    /// Vertices after welding; 0 for voxels.
    pub vertices: u64,
    /// Triangles kept; 0 for voxels.
    pub faces: u64,
    /// Solid cells; 0 for meshes.
    pub solid_cells: u64,
    /// Connected surfaces (meshes) or face-connected bodies (voxels), before the choice of bodies.
    pub components: u64,
    /// Disconnected bodies (a cavity belongs to the body around it), before the choice of bodies.
    pub bodies: u64,
    /// Bodies dropped by MORULA_BODIES_LARGEST.
    pub bodies_dropped: u64,
    /// Triangles turned by the repair of orientation (not counting a whole inversion).
    pub faces_turned: u64,
    /// Edges with one triangle, after welding.
    pub boundary_edges: u64,
    /// Edges with more than two triangles, after welding.
    pub nonmanifold_edges: u64,
    /// Triangles without area, dropped.
    pub degenerate_faces: u64,
    /// Triangles present more than once, dropped.
    pub duplicate_faces: u64,
    /// Vertices welded to another.
    pub welded_vertices: u64,
    /// 1 when every edge has exactly two triangles after repair.
    pub watertight: i32,
    /// 1 when neighbouring triangles agree in orientation after repair.
    pub oriented: i32,
    /// 1 when the whole input was inside out, and was turned.
    pub inverted: i32,
    /// 1 when solid cells touch the border of the array (voxels).
    pub touches_border: i32,
    /// Signed volume of the surface after repair: each opening closed by a fan to its middle,
    /// overlapping parts counted as often as they overlap. Equal to the volume of morula_moments
    /// for a closed surface that does not cross itself, and for voxels (of the solid cells);
    /// otherwise that one holds for the particle: it integrates where the winding number is
    /// above 1/2, with a stated error.
    pub volume: f64,
    /// Area of the surface, or of the cells' outer faces.
    pub area: f64,
    /// Lower corner of the bounding box.
    pub box_min: [f64; 3],
    /// Upper corner of the bounding box.
    pub box_max: [f64; 3],
    /// The length unit that was applied to the coordinates.
    pub length_unit: f64,
    /// Threshold used on a grey volume; 0 when none was.
    pub threshold: f64,
}

/// Mass, centre and inertia of a target, always in the input frame.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_moments {
    /// sizeof(morula_moments), set by the caller.
    pub struct_size: usize,
    /// Volume of the inside: of the polyhedron where the mesh, with lids over its openings, is closed
    /// and does not cross itself, of the solid cells, otherwise of where the winding number is above
    /// 1/2 (by columns, see relative_error). There the report's volume may be another.
    pub volume: f64,
    /// Volume times the density.
    pub mass: f64,
    /// Centre of mass.
    pub centre: [f64; 3],
    /// Inertia about the centre: xx, yy, zz, xy, xz, yz; the products carry their sign, xy =
    /// -integral of x y dm.
    pub inertia: [f64; 6],
    /// Principal moments, ascending: the inertia in the body frame.
    pub principal: [f64; 3],
    /// Rotation from body to input frame, by columns: the first three numbers are the first
    /// body axis in the input frame. Right-handed.
    pub rotation: [f64; 9],
    /// The same rotation as a quaternion w, x, y, z with w >= 0.
    pub quaternion: [f64; 4],
    /// Estimate of the relative error, 0 for exact integrals (up to rounding): the greatest of
    /// the volume's, the centre's over the cube root of the volume, and the inertia's over its
    /// greatest entry. Of a mesh that crosses itself only where its shadow along each axis is
    /// less than about 1/4000 of the box's face, the overlap (less than 1e-5 of the box) may go
    /// unseen.
    pub relative_error: f64,
}

/// How far the union of the spheres C is from the target S, by volume.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_overlap {
    /// sizeof(morula_overlap), set by the caller.
    pub struct_size: usize,
    /// Mismatch D = 1 - 2|S and C| / (|S| + |C|).
    pub mismatch: f64,
    /// Estimate of the greatest error of D from the sampling, not a proven bound: from four
    /// interleaved lattices of twice the step; it held with a factor of two to spare on lenses,
    /// boxes and ellipsoids.
    pub error_bound: f64,
    /// eta = (|S without C| + |C without S|) / |S|.
    pub eta: f64,
    /// Intersection over union.
    pub iou: f64,
    /// |S and C| / |S|.
    pub coverage: f64,
    /// |C without S| / |S|.
    pub overshoot: f64,
    /// Volume of the target by the same sampling.
    pub target_volume: f64,
    /// Volume of the union of the spheres.
    pub union_volume: f64,
    /// Union volume over target volume, less one.
    pub volume_error: f64,
    /// Distance between the centroids over the target's equivalent diameter.
    pub centroid_error: f64,
    /// Each principal moment of the union over the target's, less one.
    pub moment_errors: [f64; 3],
}

/// How far the surface of the clump is from the target's. Lengths in the caller's unit.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_surface {
    /// sizeof(morula_surface), set by the caller.
    pub struct_size: usize,
    /// Greatest distance from the target of any point of the union: balls that fill a cavity or
    /// a hole count by its middle. At most 1e-4 of the box's edge or 0.1 % below the true one,
    /// unless distance_bound says more.
    pub protrusion: f64,
    /// RMS distance between the two surfaces.
    pub rms_distance: f64,
    /// Hausdorff distance between the two surfaces: at most 1e-4 of the box's edge or 1 %
    /// below the true one, unless distance_bound says more.
    pub hausdorff: f64,
    /// No true greatest distance exceeds protrusion or hausdorff by more than this: at most
    /// 0.4 % of the equivalent diameter or 1 % of hausdorff, but where the search meets its
    /// limit of pieces or the target's surface can only be sampled (more than 131072 triangles,
    /// walls inside).
    pub distance_bound: f64,
    /// RMS angle between the normals of clump and target, radians. A voxel target has the normals
    /// of its cells' faces: there it is the staircase that is measured.
    pub roughness: f64,
    /// Surface samples used.
    pub samples: u64,
    /// Spheres that no direction exposes.
    pub never_exposed: u32,
    /// 0.
    pub reserved: u32,
    /// The greatest mismatch of the clump and its image in a plane of the target's body frame, over those of
    /// the three planes in which the target is its own image; 0 for a clump that is, too. To about 1e-3.
    pub asymmetry: f64,
    /// How many of the three they are: there the target's surface and its image lie on average within
    /// 0.3 % of the equivalent diameter. Of a body with equal moments other planes are not looked at.
    pub symmetry_planes: u64,
}

/// What the calls did that led to a shape, a solid or a clump; zero for work that was not
/// asked for.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct morula_counters {
    /// sizeof(morula_counters), set by the caller.
    pub struct_size: usize,
    /// Wall-clock seconds of reading.
    pub seconds_read: f64,
    /// Wall-clock seconds of checks and repair.
    pub seconds_check: f64,
    /// Wall-clock seconds of grid, inside test and distances.
    pub seconds_solid: f64,
    /// Wall-clock seconds of the method.
    pub seconds_generate: f64,
    /// Wall-clock seconds of the quality figures.
    pub seconds_measure: f64,
    /// Wall-clock seconds of the moments.
    pub seconds_moments: f64,
    /// Grid cells made.
    pub cells: u64,
    /// Greatest number of bytes that the large arrays held at once (from their sizes).
    pub peak_bytes: u64,
    /// Distance transforms run.
    pub transforms: u64,
    /// Exact distances to the surface asked for.
    pub exact_distances: u64,
    /// Local maxima looked at.
    pub maxima: u64,
    /// Spheres tried.
    pub spheres_tried: u64,
    /// Columns measured.
    pub columns: u64,
}
