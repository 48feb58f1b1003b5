/* Morula: the shape of a particle as a clump of overlapping spheres.
 *
 * This file is generated from src/ffi; do not edit it.
 *
 * Status. Every function that can fail returns an int32_t: MORULA_STATUS_OK (0)
 * or another MORULA_STATUS_*; morula_last_error_message() then holds one
 * sentence with the value and index at fault. What a function gives back is
 * written only on success, but for morula_clumps_from_shapes(),
 * morula_clumps_from_labels() and morula_parents_break() with statuses. Each
 * function names what it may return; any may also return INTERNAL (a panic of the
 * library, caught) and INVALID_ARGUMENT for a pointer that is not aligned to its type.
 *
 * Ownership. Handles (morula_shape, morula_solid, morula_clump, morula_body,
 * morula_files, morula_cost, morula_sweep, morula_parent, morula_cache, morula_fragments)
 * are made by the library and taken back by their _free function, which ignores NULL. Arrays and strings
 * that you hand in are copied before the call returns. Results are copied into
 * your arrays; nothing points into the library but the texts of the _name and
 * _version functions and the last message.
 *
 * Structs begin with struct_size = sizeof(the struct). Options are filled by
 * their _init function; NULL options are the defaults. Programs compiled with an
 * older or newer header keep working: fields are only ever appended.
 *
 * Threads. Functions that take a const handle may run at the same time on one
 * handle; others need it for themselves; different handles are independent. A
 * call works on its own threads, 1 unless the options say otherwise, and all of
 * them have ended when it returns. Callbacks are called only on the thread that
 * made the call. Results are the same bytes for any number of threads.
 *
 * Reentrancy. A callback may call any function of the library, also with the const
 * handles of the call that it belongs to; it must not free those. The library keeps
 * nothing between calls but the last message of each thread and the sink of the log.
 *
 * Panics. The first call puts a hook before the one that prints the panics of Rust, for
 * the whole process and for good: a panic that a call catches is not printed, all others
 * are as before. Only Rust code that shares its runtime with the library meets it.
 *
 * Layouts. Points x, y, z; spheres x, y, z, r; inertia xx, yy, zz, xy, xz, yz
 * with the products as they stand in the tensor (xy = -integral of x y dm); a
 * rotation by columns, which are the body axes in the input frame; quaternions
 * w, x, y, z from body to input with w >= 0; voxels with x fastest.
 *
 * Units. The library knows none: lengths are in your unit, a density is mass per
 * (that length)^3.
 */

#ifndef MORULA_H
#define MORULA_H

#include <stddef.h>
#include <stdint.h>

/* The version of this header; morula_version() is that of the library. */
#define MORULA_VERSION_MAJOR 0
#define MORULA_VERSION_MINOR 1
#define MORULA_VERSION_PATCH 0
#define MORULA_VERSION_STRING "0.1.0"
#define MORULA_VERSION \
  (1000000u * MORULA_VERSION_MAJOR + 1000u * MORULA_VERSION_MINOR + MORULA_VERSION_PATCH)

/// The call did what it was asked.
#define MORULA_STATUS_OK 0

/// A pointer that must not be NULL is NULL.
#define MORULA_STATUS_NULL_POINTER 1

/// An option or argument lies outside its range.
#define MORULA_STATUS_INVALID_ARGUMENT 2

/// A coordinate or value is NaN or infinite.
#define MORULA_STATUS_NOT_FINITE 3

/// A triangle, label or sphere index does not exist.
#define MORULA_STATUS_INDEX_OUT_OF_RANGE 4

/// There is nothing to work on: no face, no solid cell.
#define MORULA_STATUS_EMPTY 5

/// The shape has no volume.
#define MORULA_STATUS_ZERO_VOLUME 6

/// The surface is so open that its inside is not defined.
#define MORULA_STATUS_OPEN_SURFACE 7

/// The shape is several disconnected bodies and the choice was to refuse.
#define MORULA_STATUS_SEVERAL_BODIES 8

/// A file is malformed or truncated, or its header lies.
#define MORULA_STATUS_FORMAT 9

/// A file or request of a kind that this build does not handle.
#define MORULA_STATUS_UNSUPPORTED 10

/// The operating system refused to read or write.
#define MORULA_STATUS_IO 11

/// The work would take more memory than the option allows.
#define MORULA_STATUS_MEMORY_LIMIT 12

/// The system has no memory left for a reservation.
#define MORULA_STATUS_OUT_OF_MEMORY 13

/// The caller's array is too short; nothing was written to it.
#define MORULA_STATUS_BUFFER_TOO_SMALL 14

/// The progress callback asked to stop before there was a result.
#define MORULA_STATUS_CANCELLED 15

/// A struct's struct_size is one that this library does not know, or bytes that it does not know are not zero.
#define MORULA_STATUS_STRUCT_SIZE 16

/// A count is larger than the library can index.
#define MORULA_STATUS_TOO_LARGE 17

/// The value asked for was not among the wants of the call that made the clump.
#define MORULA_STATUS_NOT_WANTED 18

/// No sphere satisfies the constraints.
#define MORULA_STATUS_NO_SPHERES 19

/// A defect of the library itself: please report it.
#define MORULA_STATUS_INTERNAL 20

/// No masses of the spheres satisfy the constraints.
#define MORULA_STATUS_NO_MASSES 21

/// Log level: what a call did.
#define MORULA_LOG_INFO 0

/// Log level: something in the input that a user should know.
#define MORULA_LOG_WARNING 1

/// morula_import_options, for morula_sizeof().
#define MORULA_STRUCT_IMPORT_OPTIONS 1

/// morula_file_options, for morula_sizeof().
#define MORULA_STRUCT_FILE_OPTIONS 2

/// morula_solid_options, for morula_sizeof().
#define MORULA_STRUCT_SOLID_OPTIONS 3

/// morula_clump_options, for morula_sizeof().
#define MORULA_STRUCT_CLUMP_OPTIONS 4

/// morula_report, for morula_sizeof().
#define MORULA_STRUCT_REPORT 5

/// morula_moments, for morula_sizeof().
#define MORULA_STRUCT_MOMENTS 6

/// morula_overlap, for morula_sizeof().
#define MORULA_STRUCT_OVERLAP 7

/// morula_surface, for morula_sizeof().
#define MORULA_STRUCT_SURFACE 8

/// morula_counters, for morula_sizeof().
#define MORULA_STRUCT_COUNTERS 9

/// morula_mass_options, for morula_sizeof().
#define MORULA_STRUCT_MASS_OPTIONS 10

/// morula_masses, for morula_sizeof().
#define MORULA_STRUCT_MASSES 11

/// morula_contact_options, for morula_sizeof().
#define MORULA_STRUCT_CONTACT_OPTIONS 12

/// morula_timestep, for morula_sizeof().
#define MORULA_STRUCT_TIMESTEP 13

/// morula_export_options, for morula_sizeof().
#define MORULA_STRUCT_EXPORT_OPTIONS 14

/// morula_break_options, for morula_sizeof().
#define MORULA_STRUCT_BREAK_OPTIONS 15

/// morula_held, for morula_sizeof().
#define MORULA_STRUCT_HELD 16

/// morula_fragment, for morula_sizeof().
#define MORULA_STRUCT_FRAGMENT 17

/// morula_break_totals, for morula_sizeof().
#define MORULA_STRUCT_BREAK_TOTALS 18

/// morula_cache_counts, for morula_sizeof().
#define MORULA_STRUCT_CACHE_COUNTS 19

/// morula_cost_options, for morula_sizeof().
#define MORULA_STRUCT_COST_OPTIONS 20

/// morula_cost_point, for morula_sizeof().
#define MORULA_STRUCT_COST_POINT 21

/// morula_cost_bounds, for morula_sizeof().
#define MORULA_STRUCT_COST_BOUNDS 22

/// morula_sweep_options, for morula_sizeof().
#define MORULA_STRUCT_SWEEP_OPTIONS 23

/// morula_swept, for morula_sizeof().
#define MORULA_STRUCT_SWEPT 24

/// Refuse a shape of several disconnected bodies, with the count (the default).
#define MORULA_BODIES_REFUSE 0

/// Keep the body of greatest volume; the notes say what was dropped.
#define MORULA_BODIES_LARGEST 1

/// Keep all bodies as one particle.
#define MORULA_BODIES_ALL 2

/// Tell the format of a file by its content, then by its name (the default).
#define MORULA_FORMAT_AUTO 0

/// STL, ascii or binary.
#define MORULA_FORMAT_STL 1

/// Wavefront OBJ.
#define MORULA_FORMAT_OBJ 2

/// PLY, ascii or binary.
#define MORULA_FORMAT_PLY 3

/// OFF, COFF, NOFF.
#define MORULA_FORMAT_OFF 4

/// NumPy array.
#define MORULA_FORMAT_NPY 5

/// Multi-page TIFF.
#define MORULA_FORMAT_TIFF 6

/// Raw voxels: the raw_ fields of the options describe them.
#define MORULA_FORMAT_RAW 7

/// Voxel files: two values are a mask, more are grey values with Otsu's threshold (the default).
#define MORULA_MEANING_AUTO 0

/// Voxel files: grey values, solid above Otsu's threshold.
#define MORULA_MEANING_OTSU 1

/// Voxel files: grey values, solid above the option `threshold`.
#define MORULA_MEANING_ABOVE 2

/// Voxel files: labels, of which the option `label` is taken.
#define MORULA_MEANING_LABEL 3

/// Raw voxels of 8 bits, unsigned.
#define MORULA_RAW_U8 0

/// Raw voxels of 16 bits, unsigned, little-endian.
#define MORULA_RAW_U16 1

/// Raw voxels of 32 bits, floating point, little-endian.
#define MORULA_RAW_F32 2

/// Silhouettes: cells of which some part may lie in the hull stay, so that the shape contains the
/// hull, and the body.
#define MORULA_CARVE_TOUCHED 0

/// Silhouettes: cells whose centre lies in the hull stay, so that the volume is the hull's.
#define MORULA_CARVE_CENTRES 1

/// `cells` along the longest edge of the bounding box (the default, 64).
#define MORULA_RESOLUTION_CELLS_LONGEST 0

/// `cells` along the shortest edge of the bounding box.
#define MORULA_RESOLUTION_CELLS_SHORTEST 1

/// `cells` along the diameter of the sphere of equal volume.
#define MORULA_RESOLUTION_CELLS_DIAMETER 2

/// Cells of the edge length `cell_size`.
#define MORULA_RESOLUTION_CELL_SIZE 3

/// MSS: local maxima of the distance transform, iterated.
#define MORULA_METHOD_MSS 0

/// Least mismatch for the number of spheres (the default).
#define MORULA_METHOD_BEST 1

/// Spheres through four points of the surface, fitted to it; the method finds its own number, which
/// `spheres` limits.
#define MORULA_METHOD_SURFACE_FIT 2

/// Most coverage with no sphere beyond the surface.
#define MORULA_METHOD_INSCRIBED 3

/// Largest inscribed spheres about a thinned skeleton by greedy set cover: none reaches beyond the
/// surface.
#define MORULA_METHOD_COVER 4

/// Spheres of nearly one radius (within 5 %) that do not overlap and keep within the surface, as
/// large as their number allows, or as many as fit with at least min_radius: the grains of a body
/// that may break. They cover about half of its volume.
#define MORULA_METHOD_PACKED 5

/// The greatest ball in what is left of the body, again and again.
#define MORULA_METHOD_EUCLIDEAN 10

/// The greatest spheres that touch the surface from inside at its points (Ferellec, McDowell).
#define MORULA_METHOD_FERELLEC_MCDOWELL 11

/// Spheres about the axis of a body of revolution.
#define MORULA_METHOD_FAVIER 12

/// Spheres about the cells of the grid, those that cover most first (Garcia; Li, Xu and Meng).
#define MORULA_METHOD_UNIFORM_GRID 13

/// MORULA_METHOD_BEST and MORULA_METHOD_INSCRIBED: milliseconds.
#define MORULA_EFFORT_DRAFT 0

/// Of the same: about a tenth of a second for a hundred spheres (the default).
#define MORULA_EFFORT_NORMAL 1

/// Of the same: seconds.
#define MORULA_EFFORT_THOROUGH 2

/// Levels of detail that have nothing to do with each other: each is what a call of its own gives
/// (the default).
#define MORULA_LEVELS_FREE 0

/// Each level starts from the one before where the method can (MORULA_METHOD_BEST without
/// symmetry), so that levels are alike; hardly quicker.
#define MORULA_LEVELS_CHAINED 1

/// Each level holds all spheres of the one before, in the same order, and further ones after them:
/// MORULA_METHOD_BEST, MORULA_METHOD_COVER, MORULA_METHOD_EUCLIDEAN.
#define MORULA_LEVELS_NESTED 2

/// Where more spheres stop paying: the line of a price list that lies farthest below the straight
/// one from first to last, on logarithmic axes of the cost of a step and of D (the default).
#define MORULA_GOAL_KNEE 0

/// Fewest spheres.
#define MORULA_GOAL_SPHERES 1

/// Least mismatch D.
#define MORULA_GOAL_MISMATCH 2

/// Fewest seconds of the method.
#define MORULA_GOAL_SECONDS 3

/// Cheapest step of the solver.
#define MORULA_GOAL_STEP_COST 4

/// Cheapest simulated time.
#define MORULA_GOAL_TIME_COST 5

/// MORULA_METHOD_BEST: no symmetry but by chance (the default).
#define MORULA_SYMMETRY_NONE 0

/// MORULA_METHOD_BEST: the target's mirror planes through its centre of mass, and exchanges of axes.
#define MORULA_SYMMETRY_AUTO 1

/// MORULA_METHOD_BEST: the mirror planes in symmetry_planes.
#define MORULA_SYMMETRY_PLANES 2

/// MORULA_METHOD_COVER: thin to a medial surface (the default).
#define MORULA_ENDS_SURFACE 0

/// MORULA_METHOD_COVER: thin to curves, for shapes about an axis.
#define MORULA_ENDS_CURVE 1

/// MORULA_METHOD_COVER: candidates at the voxels of the skeleton (the default).
#define MORULA_CANDIDATES_THINNED 0

/// MORULA_METHOD_COVER: candidates that touch the vertices of a mesh from within.
#define MORULA_CANDIDATES_ANALYTIC 1

/// Spheres in the frame in which the shape was handed in (the default).
#define MORULA_FRAME_INPUT 0

/// Spheres in the body frame: origin at the centre of mass, axes principal.
#define MORULA_FRAME_BODY 1

/// Spheres of fragments where they stand in the world when the particle breaks.
#define MORULA_FRAME_WORLD 2

/// Break along planes: each piece that they leave is a fragment.
#define MORULA_CUT_PLANES 0

/// Keep what lies within all half-spaces; the rest is left out, and its mass goes to what is kept.
#define MORULA_CUT_WITHIN 1

/// Break into the Voronoi cells of given points, or with weights their power cells.
#define MORULA_CUT_POINTS 2

/// Break into the Voronoi cells of seeded points (the default).
#define MORULA_CUT_SEEDED 3

/// Break into the Voronoi cells of seeded points that are the denser the nearer to an impact.
#define MORULA_CUT_IMPACT 4

/// Want nothing but the spheres.
#define MORULA_WANT_NOTHING 0

/// Want morula_clump_overlap(): D, coverage, union volume and moments.
#define MORULA_WANT_OVERLAP 1

/// Want morula_clump_surface() and exposed areas: protrusion, distances, roughness.
#define MORULA_WANT_SURFACE 2

/// Want morula_clump_moments(): mass, centre, inertia of the target (the default).
#define MORULA_WANT_MOMENTS 4

/// The number of spheres asked for was reached.
#define MORULA_STOPPED_SPHERES 0

/// The mismatch asked for was reached.
#define MORULA_STOPPED_MISMATCH 1

/// Every further sphere would be smaller than the least radius.
#define MORULA_STOPPED_RADIUS 2

/// The deadline passed.
#define MORULA_STOPPED_DEADLINE 3

/// The progress callback cancelled; the clump holds the spheres found so far.
#define MORULA_STOPPED_CANCELLED 4

/// The method finds no further sphere that brings the clump closer; the note says why.
#define MORULA_STOPPED_EXHAUSTED 5

/// The coverage asked for was reached.
#define MORULA_STOPPED_COVERAGE 6

/// Fewer spheres than were asked for (the bound); the note says why.
#define MORULA_WARNING_FEWER_SPHERES 1

/// So far from the origin that places are rounded by this part of the size.
#define MORULA_WARNING_FAR_AWAY 2

/// The surface is open or crosses itself: mass, centre and inertia may be off by this part.
#define MORULA_WARNING_INEXACT_TARGET 3

/// So few cells of the grid lie across the mean thickness of the shape.
#define MORULA_WARNING_THIN 4

/// The mismatch is known to this part of itself only.
#define MORULA_WARNING_COARSE_OVERLAP 5

/// Greatest distances may be more by this part of the equivalent diameter.
#define MORULA_WARNING_COARSE_DISTANCE 6

/// The mass, centre and inertia of the true shape, mesh or voxels (the default).
#define MORULA_TARGET_SOLID 0

/// Those of the union of the spheres.
#define MORULA_TARGET_UNION 1

/// Masses with the least spread from each sphere's share of the union's volume (the default).
#define MORULA_OBJECTIVE_EVEN 0

/// Masses of which the least is greatest.
#define MORULA_OBJECTIVE_MAX_MIN 1

/// Masses of which the last is greatest.
#define MORULA_OBJECTIVE_MAX_LAST 2

/// Where no masses have the centre of the body: fail with NO_MASSES (the default).
#define MORULA_INFEASIBLE_REFUSE 0

/// Where no masses have the centre of the body: keep their sum, with the least error of the rest.
#define MORULA_INFEASIBLE_LEAST_ERROR 1

/// Masses that meet all ten equations: mass, centre and inertia.
#define MORULA_MASSES_EXACT 0

/// Masses that meet mass and centre; the inertia has the least error that they allow.
#define MORULA_MASSES_RELAXED 1

/// Masses that meet the mass alone; centre and inertia have the least error.
#define MORULA_MASSES_MASS_ONLY 2

/// A fragment without masses of its spheres.
#define MORULA_MASSES_NONE 3

/// MercuryDPM: a folder with Clump/Clump.txt and Inertia/Mass.txt, TOI.txt, PD.txt.
#define MORULA_EXPORT_MERCURY 0

/// LAMMPS: a molecule template.
#define MORULA_EXPORT_LAMMPS 1

/// LAMMPS: the infile of fix rigid/small.
#define MORULA_EXPORT_LAMMPS_RIGID 2

/// LIGGGHTS: the spheres of fix particletemplate/multisphere, and that command beside it (.in).
#define MORULA_EXPORT_LIGGGHTS 3

/// YADE: a Python module.
#define MORULA_EXPORT_YADE 4

/// Chrono DEM-Engine: the spheres of LoadClumpType, with its numbers as comments.
#define MORULA_EXPORT_DEME 5

/// MFiX: gsp_config.csv of glued-sphere particles.
#define MORULA_EXPORT_MFIX 6

/// Kratos: .clu.
#define MORULA_EXPORT_KRATOS 7

/// PFC: a command file that makes a clump template.
#define MORULA_EXPORT_PFC 8

/// EDEM: a table of spheres, to be pasted.
#define MORULA_EXPORT_EDEM 9

/// A table with the header x,y,z,r,mass.
#define MORULA_EXPORT_CSV 10

/// The whole record as JSON.
#define MORULA_EXPORT_JSON 11

/// VTK: points with radii and masses.
#define MORULA_EXPORT_VTP 12

/// The surface of the spheres, PLY.
#define MORULA_EXPORT_PLY 13

/// The surface of the spheres, STL.
#define MORULA_EXPORT_STL 14

/// Coordinates and radii with all digits of double precision (the default).
#define MORULA_PRECISION_F64 0

/// Coordinates and radii that single precision holds, each sphere within the one it stands for.
#define MORULA_PRECISION_F32 1

/// A weighed clump: its spheres with a mass each, such that all of them, as solid spheres, add up to the
/// mass, centre and inertia of the body. Made by morula_body_from_clump(),
/// morula_body_from_spheres() or morula_body_transform(), freed by morula_body_free().
typedef struct morula_body morula_body;

/// Prepared parents that are used again, within a bound of memory. Made by morula_cache_new(), freed
/// by morula_cache_free(). The parents that it gave do not need it any more.
typedef struct morula_cache morula_cache;

/// A clump: spheres and what was measured on them. Made by
/// morula_clump_from_shape() or morula_clump_from_solid(), freed by
/// morula_clump_free(). It needs neither shape nor solid any more.
typedef struct morula_clump morula_clump;

/// A price list: for each number of spheres how good the clump is, how long it took and what a
/// solver pays for it. Made by morula_cost_curve() or morula_sweep_curve(), freed by morula_cost_free().
/// It needs the solid no more.
typedef struct morula_cost morula_cost;

/// The files of a format in memory. Made by morula_body_export(), freed by morula_files_free().
typedef struct morula_files morula_files;

/// The fragments of one break, and its dust. Made by morula_parent_break(), morula_parents_break(),
/// morula_fragments_from_labels(), morula_reclump_shape() or morula_fragments_deserialize(), freed by
/// morula_fragments_free(). It does not need the handle of its parent any more.
typedef struct morula_fragments morula_fragments;

/// A particle that may break: its solid and the spheres of its clump, with what every break of it
/// reads. Made once a template by morula_parent_from_solid(), morula_parent_from_clump() or
/// morula_cache_parent(), freed by morula_parent_free(). It needs neither the solid nor the clump any more.
typedef struct morula_parent morula_parent;

/// A checked shape: something with an inside. Made by the morula_shape_from_
/// functions, freed by morula_shape_free().
typedef struct morula_shape morula_shape;

/// A shape with a grid. Made by morula_solid_from_shape(), freed by
/// morula_solid_free(). It does not need its shape any more.
typedef struct morula_solid morula_solid;

/// Price lists of one shape: for each resolution, in it for each method, of each for each deadline.
/// Made by morula_sweep_from_shape(), freed by morula_sweep_free(). It needs the shape no more.
typedef struct morula_sweep morula_sweep;

/// Receives one line of log: `level` is one of MORULA_LOG_*, `text` lives until
/// the sink returns. Called on the thread that made the call, maybe from
/// several threads at the same time when several threads make calls. It must
/// return normally: no exception, no longjmp.
typedef void (*morula_log)(int32_t level, const char *text, void *user);

/// Called now and then during a long call, only on the thread that made the
/// call, with a fraction in [0, 1] that never falls. Return 0 to go on, any
/// other number to cancel: then the call returns MORULA_STATUS_CANCELLED, or,
/// when a clump has spheres already, MORULA_STATUS_OK with what there is and
/// MORULA_STOPPED_CANCELLED. It must return normally: no exception, no longjmp.
typedef int32_t (*morula_progress)(double fraction, void *user);

/// How a shape is taken in. Fill it with morula_import_options_init().
typedef struct morula_import_options {
  /// sizeof(morula_import_options).
  size_t struct_size;
  /// Vertices at open edges that are nearer to each other than this times the longest edge of
  /// the bounding box (and than a quarter of the faces' median edge) are one, where that closes
  /// the surface further. Default 1e-6; 0: only equal ones.
  double weld_tolerance;
  /// Coordinates are multiplied by it (0.001 takes millimetres to metres). Default 1.
  double length_unit;
  /// Most bytes that the shape's arrays may take. Default 2 GiB.
  uint64_t memory_limit;
  /// One of MORULA_BODIES_*. Default MORULA_BODIES_REFUSE.
  int32_t bodies;
  /// 0 or 1: the index of the first vertex in an array of triangles. Default 0.
  int32_t index_base;
  /// Threads of this call; 0: all cores. Default 1.
  int32_t threads;
  /// Must be 0.
  int32_t reserved;
  /// Called now and then on the calling thread; NULL: none.
  morula_progress progress;
  /// Handed to `progress`.
  void *user;
} morula_import_options;

/// What was found in an input and what was done about it. Lengths, areas and
/// volumes are in the caller's unit and frame.
typedef struct morula_report {
  /// sizeof(morula_report), set by the caller.
  size_t struct_size;
  /// Vertices as handed in.
  uint64_t input_vertices;
  /// Triangles as handed in, after polygons were cut into triangles.
  uint64_t input_faces;
  /// Vertices after welding; 0 for voxels.
  uint64_t vertices;
  /// Triangles kept; 0 for voxels.
  uint64_t faces;
  /// Solid cells; 0 for meshes.
  uint64_t solid_cells;
  /// Connected surfaces (meshes) or face-connected bodies (voxels), before the choice of bodies.
  uint64_t components;
  /// Disconnected bodies (a cavity belongs to the body around it), before the choice of bodies.
  uint64_t bodies;
  /// Bodies dropped by MORULA_BODIES_LARGEST.
  uint64_t bodies_dropped;
  /// Triangles turned by the repair of orientation (not counting a whole inversion).
  uint64_t faces_turned;
  /// Edges with one triangle, after welding.
  uint64_t boundary_edges;
  /// Edges with more than two triangles, after welding.
  uint64_t nonmanifold_edges;
  /// Triangles without area, dropped.
  uint64_t degenerate_faces;
  /// Triangles present more than once, dropped.
  uint64_t duplicate_faces;
  /// Vertices welded to another.
  uint64_t welded_vertices;
  /// 1 when every edge has exactly two triangles after repair.
  int32_t watertight;
  /// 1 when neighbouring triangles agree in orientation after repair.
  int32_t oriented;
  /// 1 when the whole input was inside out, and was turned.
  int32_t inverted;
  /// 1 when solid cells touch the border of the array (voxels).
  int32_t touches_border;
  /// Signed volume of the surface after repair: each opening closed by a fan to its middle,
  /// overlapping parts counted as often as they overlap. Equal to the volume of morula_moments
  /// for a closed surface that does not cross itself, and for voxels (of the solid cells);
  /// otherwise that one holds for the particle: it integrates where the winding number is
  /// above 1/2, with a stated error.
  double volume;
  /// Area of the surface, or of the cells' outer faces.
  double area;
  /// Lower corner of the bounding box.
  double box_min[3];
  /// Upper corner of the bounding box.
  double box_max[3];
  /// The length unit that was applied to the coordinates.
  double length_unit;
  /// Threshold used on a grey volume; 0 when none was.
  double threshold;
} morula_report;

/// Mass, centre and inertia of a target, always in the input frame.
typedef struct morula_moments {
  /// sizeof(morula_moments), set by the caller.
  size_t struct_size;
  /// Volume of the inside: of the polyhedron where the mesh, with lids over its openings, is closed
  /// and does not cross itself, of the solid cells, otherwise of where the winding number is above
  /// 1/2 (by columns, see relative_error). There the report's volume may be another.
  double volume;
  /// Volume times the density.
  double mass;
  /// Centre of mass.
  double centre[3];
  /// Inertia about the centre: xx, yy, zz, xy, xz, yz; the products carry their sign, xy =
  /// -integral of x y dm.
  double inertia[6];
  /// Principal moments, ascending: the inertia in the body frame.
  double principal[3];
  /// Rotation from body to input frame, by columns: the first three numbers are the first
  /// body axis in the input frame. Right-handed.
  double rotation[9];
  /// The same rotation as a quaternion w, x, y, z with w >= 0.
  double quaternion[4];
  /// Estimate of the relative error, 0 for exact integrals (up to rounding): the greatest of
  /// the volume's, the centre's over the cube root of the volume, and the inertia's over its
  /// greatest entry. Of a mesh that crosses itself only where its shadow along each axis is
  /// less than about 1/4000 of the box's face, the overlap (less than 1e-5 of the box) may go
  /// unseen.
  double relative_error;
} morula_moments;

/// What the calls did that led to a shape, a solid or a clump; zero for work that was not
/// asked for.
typedef struct morula_counters {
  /// sizeof(morula_counters), set by the caller.
  size_t struct_size;
  /// Wall-clock seconds of reading.
  double seconds_read;
  /// Wall-clock seconds of checks and repair.
  double seconds_check;
  /// Wall-clock seconds of grid, inside test and distances.
  double seconds_solid;
  /// Wall-clock seconds of the method.
  double seconds_generate;
  /// Wall-clock seconds of the quality figures.
  double seconds_measure;
  /// Wall-clock seconds of the moments.
  double seconds_moments;
  /// Grid cells made.
  uint64_t cells;
  /// Greatest number of bytes that the large arrays held at once (from their sizes).
  uint64_t peak_bytes;
  /// Distance transforms run.
  uint64_t transforms;
  /// Exact distances to the surface asked for.
  uint64_t exact_distances;
  /// Local maxima looked at.
  uint64_t maxima;
  /// Spheres tried.
  uint64_t spheres_tried;
  /// Columns measured.
  uint64_t columns;
} morula_counters;

/// How a file is read, beside morula_import_options. Fill it with morula_file_options_init().
typedef struct morula_file_options {
  /// sizeof(morula_file_options).
  size_t struct_size;
  /// One of MORULA_FORMAT_*. Default MORULA_FORMAT_AUTO.
  int32_t format;
  /// One of MORULA_MEANING_*, for voxel files. Default MORULA_MEANING_AUTO.
  int32_t meaning;
  /// Grey values above it are solid (MORULA_MEANING_ABOVE). Default 0.
  double threshold;
  /// The label that is taken (MORULA_MEANING_LABEL). Default 1.
  uint32_t label;
  /// 0: an npy array of shape (a, b, c) has axes z, y, x; 1: x, y, z. Default 0.
  int32_t npy_xyz;
  /// Edge lengths of a voxel along x, y, z, before length_unit. Default 1, 1, 1.
  double spacing[3];
  /// Lower corner of the first voxel, before length_unit. Default 0, 0, 0.
  double origin[3];
  /// Raw voxels along x, y, z; x is fastest.
  uint64_t raw_dims[3];
  /// Bytes before the first raw voxel. Default 0.
  uint64_t raw_skip;
  /// One of MORULA_RAW_*. Default MORULA_RAW_U8.
  int32_t raw_type;
  /// Must be 0.
  int32_t reserved;
} morula_file_options;

/// How a solid is made. Fill it with morula_solid_options_init().
typedef struct morula_solid_options {
  /// sizeof(morula_solid_options).
  size_t struct_size;
  /// One of MORULA_RESOLUTION_*. Default MORULA_RESOLUTION_CELLS_LONGEST. Voxel shapes keep
  /// their own cells.
  int32_t resolution;
  /// Number of cells for the MORULA_RESOLUTION_CELLS_* kinds. Default 64.
  uint32_t cells;
  /// Edge length of a cell for MORULA_RESOLUTION_CELL_SIZE. Default 0.
  double cell_size;
  /// Most bytes that the grid's arrays may take together, and what tells the inside of an open
  /// mesh; a tree over the surface (made by the first call that needs exact distances) and
  /// quality figures are held to what is left. Default 2 GiB.
  uint64_t memory_limit;
  /// Empty cells around the shape, at least 2. Default 4.
  uint32_t padding;
  /// Threads of this call; 0: all cores. Default 1. Not read by morula_clump_from_shape().
  int32_t threads;
  /// Called now and then on the calling thread; NULL: none. Not read by morula_clump_from_shape().
  morula_progress progress;
  /// Handed to `progress`.
  void *user;
} morula_solid_options;

/// What a clump is asked for. Fill it with morula_clump_options_init(). The
/// criteria (spheres, mismatch, min_radius, deadline_seconds) apply alone or
/// together: the first that is met stops the method. MORULA_METHOD_BEST, which
/// makes all spheres at once, looks for the fewest that have the mismatch, and
/// keeps all radii at min_radius or more.
typedef struct morula_clump_options {
  /// sizeof(morula_clump_options).
  size_t struct_size;
  /// Number of spheres; 0: no limit. Default 50.
  uint64_t spheres;
  /// Stop at this mismatch D (on the method's own grid, but for MORULA_METHOD_BEST: as
  /// morula_clump_overlap() has it); 0: no target. Default 0.
  double mismatch;
  /// Least radius, in the caller's unit. Default 0.
  double min_radius;
  /// Least distance between centres, in cells of the grid. Default 0.
  double min_distance;
  /// Added to every radius, in cells of the grid; 0 has no bias. Default 0.
  double radius_offset;
  /// Seconds from the start of the call after which the method stops with what it has; 0:
  /// none. Default 0.
  double deadline_seconds;
  /// Seed of every random choice. Default 0.
  uint64_t seed;
  /// One of MORULA_METHOD_*. Default MORULA_METHOD_BEST. min_distance, radius_offset and confine
  /// are read by MORULA_METHOD_MSS alone; MORULA_METHOD_INSCRIBED
  /// needs a number of spheres. Every method refuses what it does not read.
  int32_t method;
  /// 1: limit the radii so that no sphere reaches beyond the true surface. Default 0.
  int32_t confine;
  /// Threads of this call; 0: all cores. The spheres do not depend on it. Default 1.
  int32_t threads;
  /// One of MORULA_FRAME_*. Default MORULA_FRAME_INPUT.
  int32_t frame;
  /// Sum of MORULA_WANT_*. What is not wanted is not computed. Default MORULA_WANT_MOMENTS.
  uint32_t wants;
  /// Columns along each of the two sampled axes of the quality figures; 0: the library's
  /// choice. Default 0.
  uint32_t quality_columns;
  /// For each of these distances, count the most spheres that one plane touches within it
  /// (caller's unit); NULL with a count of 0: none. Copied before the call returns.
  const double *plane_tolerances;
  /// Number of plane_tolerances. Default 0.
  size_t plane_tolerance_count;
  /// Called now and then on the calling thread; NULL: none.
  morula_progress progress;
  /// Handed to `progress`.
  void *user;
  /// One of MORULA_EFFORT_*, for MORULA_METHOD_BEST and MORULA_METHOD_INSCRIBED. Default MORULA_EFFORT_NORMAL.
  int32_t effort;
  /// Must be 0.
  int32_t reserved;
  /// Stop when this share of the volume is covered, by the method's own cells; 0: no target.
  /// This and the four below for MORULA_METHOD_COVER alone. Default 0.
  double coverage;
  /// One of MORULA_ENDS_*. Default MORULA_ENDS_SURFACE.
  int32_t ends;
  /// One of MORULA_CANDIDATES_*. Default MORULA_CANDIDATES_THINNED.
  int32_t candidates;
  /// Voxels to be thinned, along the diameter of the sphere of equal volume. Default 60.
  uint32_t thinning_cells;
  /// Cells to be covered, along the same diameter within the body; half their size at its
  /// surface. Default 50.
  uint32_t cells_inside;
  /// How far a sphere may reach beyond the surface, in the caller's unit, for
  /// MORULA_METHOD_INSCRIBED, MORULA_METHOD_EUCLIDEAN and the methods after it. Default 0.
  double tolerance;
  /// MORULA_METHOD_EUCLIDEAN: by which part of its radius a sphere is shrunk before it is taken
  /// from the body; 0: the spheres do not overlap. Default 0.9.
  double overlap;
  /// How many times as much as target that is not covered, clump beyond the target counts. This
  /// and all below for MORULA_METHOD_BEST alone. Default 1.
  double overshoot_weight;
  /// How far a sphere may reach beyond the surface, in the caller's unit; 0: as far as is best.
  /// Default 0.
  double max_protrusion;
  /// Greatest radius, in the caller's unit; 0: as large as is best. Default 0.
  double max_radius;
  /// Weight of the distance between the surfaces against D; 0: D alone. Default 0.
  double smoothness;
  /// 1: the spheres hang together by overlaps. Default 0.
  int32_t connected;
  /// 1: the union of the spheres has the volume of the target. Default 0.
  int32_t equal_volume;
  /// One of MORULA_SYMMETRY_*. Default MORULA_SYMMETRY_NONE.
  int32_t symmetry;
  /// Number of symmetry_planes. Default 0.
  uint32_t symmetry_plane_count;
  /// Of each half-space that no sphere may leave nx, ny, nz, d: the points p with n . p <= d, in
  /// the caller's frame and unit; n of any length but 0. NULL with a count of 0: none. Copied
  /// before the call returns.
  const double *half_spaces;
  /// Number of half_spaces. Default 0.
  size_t half_space_count;
  /// For MORULA_SYMMETRY_PLANES, the normals of mirror planes through the centre of mass: x, y, z
  /// each. Copied before the call returns.
  const double *symmetry_planes;
} morula_clump_options;

/// How far the union of the spheres C is from the target S, by volume.
typedef struct morula_overlap {
  /// sizeof(morula_overlap), set by the caller.
  size_t struct_size;
  /// Mismatch D = 1 - 2|S and C| / (|S| + |C|).
  double mismatch;
  /// Estimate of the greatest error of D from the sampling, not a proven bound: from four
  /// interleaved lattices of twice the step; it held with a factor of two to spare on lenses,
  /// boxes and ellipsoids.
  double error_bound;
  /// eta = (|S without C| + |C without S|) / |S|.
  double eta;
  /// Intersection over union.
  double iou;
  /// |S and C| / |S|.
  double coverage;
  /// |C without S| / |S|.
  double overshoot;
  /// Volume of the target by the same sampling.
  double target_volume;
  /// Volume of the union of the spheres.
  double union_volume;
  /// Union volume over target volume, less one.
  double volume_error;
  /// Distance between the centroids over the target's equivalent diameter.
  double centroid_error;
  /// Each principal moment of the union over the target's, less one.
  double moment_errors[3];
} morula_overlap;

/// How far the surface of the clump is from the target's. Lengths in the caller's unit.
typedef struct morula_surface {
  /// sizeof(morula_surface), set by the caller.
  size_t struct_size;
  /// Greatest distance from the target of any point of the union: balls that fill a cavity or
  /// a hole count by its middle. At most 1e-4 of the box's edge or 0.1 % below the true one,
  /// unless distance_bound says more.
  double protrusion;
  /// RMS distance between the two surfaces.
  double rms_distance;
  /// Hausdorff distance between the two surfaces: at most 1e-4 of the box's edge or 1 %
  /// below the true one, unless distance_bound says more.
  double hausdorff;
  /// No true greatest distance exceeds protrusion or hausdorff by more than this: at most
  /// 0.4 % of the equivalent diameter or 1 % of hausdorff, but where the search meets its
  /// limit of pieces or the target's surface can only be sampled (more than 131072 triangles,
  /// walls inside).
  double distance_bound;
  /// RMS angle between the normals of clump and target, radians. A voxel target has the normals
  /// of its cells' faces: there it is the staircase that is measured.
  double roughness;
  /// Surface samples used.
  uint64_t samples;
  /// Spheres that no direction exposes.
  uint32_t never_exposed;
  /// 0.
  uint32_t reserved;
  /// The greatest mismatch of the clump and its image in a plane of the target's body frame, over those of
  /// the three planes in which the target is its own image; 0 for a clump that is, too. To about 1e-3.
  double asymmetry;
  /// How many of the three they are: there the target's surface and its image lie on average within
  /// 0.3 % of the equivalent diameter. Of a body with equal moments other planes are not looked at.
  uint64_t symmetry_planes;
} morula_surface;

/// What is known of the contacts of a particle. Fill it with morula_contact_options_init().
typedef struct morula_contact_options {
  /// sizeof(morula_contact_options).
  size_t struct_size;
  /// Stiffness of a linear spring, force per length; 0: elastic spheres (Hertz) of `young` and
  /// `poisson`. Default 0.
  double stiffness;
  /// Young's modulus, force per area. Default 0, which is refused where it is read.
  double young;
  /// Poisson's ratio. Default 0.3.
  double poisson;
  /// Greatest speed at which two particles meet. Default 1.
  double speed;
  /// How many contacts act on a particle at once, as far as they push the same way. Default 1.
  uint32_t contacts;
  /// Must be 0.
  uint32_t reserved;
} morula_contact_options;

/// What a price list is made of, beside morula_clump_options. Fill it with
/// morula_cost_options_init().
typedef struct morula_cost_options {
  /// sizeof(morula_cost_options).
  size_t struct_size;
  /// Numbers of spheres, ascending; NULL with a count of 0: from 1 to `most`, about ten between
  /// each and its tenfold. Copied before the call returns.
  const uint64_t *counts;
  /// Number of counts. Default 0.
  size_t count;
  /// The last number of spheres where there are no counts. Default 100.
  uint64_t most;
  /// Seconds that each clump may take; 0: as long as it takes. Default 0.
  double seconds;
  /// Mass per (caller's unit)^3. Default 1.
  double density;
  /// The contacts for which the time step holds; NULL: a spring of stiffness 1.
  const struct morula_contact_options *contact;
  /// What one step of the solver costs with clumps of n spheres, over one with single spheres:
  /// a + b n + c n^2. Default: fitted to LAMMPS; to the engine of `morula simulate`: 1.16, 0, 2.55e-6
  /// with `lists` of 0, 0.
  double step[3];
  /// And what lists of neighbours add: (d n + e n^2) / rebuild. Default: fitted to LAMMPS.
  double lists[2];
  /// Steps from one list to the next. Default 50.
  double rebuild;
  /// What the clumps have to do with each other: one of MORULA_LEVELS_*. Default
  /// MORULA_LEVELS_FREE.
  int32_t levels;
  /// 1: the distance between the surfaces is measured. Default 1.
  int32_t surface;
  /// 1: spheres are weighed, and the error of the inertia that is left is told. Default 1.
  int32_t masses;
  /// Columns along each of the two sampled axes of the quality figures; 0: the library's
  /// choice. Default 0.
  uint32_t quality_columns;
} morula_cost_options;

/// What a clump may cost, how good it must be, and what is made best. Fill it with
/// morula_cost_bounds_init(). 0 bounds nothing.
typedef struct morula_cost_bounds {
  /// sizeof(morula_cost_bounds).
  size_t struct_size;
  /// Most spheres.
  uint64_t spheres;
  /// Greatest mismatch D.
  double mismatch;
  /// Least coverage.
  double coverage;
  /// Greatest RMS distance between the surfaces, over the equivalent diameter.
  double surface;
  /// Most seconds of the method.
  double seconds;
  /// Greatest cost of a step, in steps with single spheres.
  double step_cost;
  /// Greatest cost of simulated time, in the same unit.
  double time_cost;
  /// One of MORULA_GOAL_*. Default MORULA_GOAL_KNEE.
  int32_t goal;
  /// Must be 0.
  int32_t reserved;
} morula_cost_bounds;

/// One line of a price list. Lengths are over the equivalent diameter; what was not wanted is 0.
typedef struct morula_cost_point {
  /// sizeof(morula_cost_point), set by the caller in the first of an array.
  size_t struct_size;
  /// Spheres asked for.
  uint64_t asked;
  /// Spheres of the clump.
  uint64_t spheres;
  /// Mismatch D.
  double mismatch;
  /// |S and C| / |S|.
  double coverage;
  /// |C without S| / |S|.
  double overshoot;
  /// RMS distance between the surfaces, both ways.
  double surface;
  /// Greatest distance between the surfaces.
  double hausdorff;
  /// Greatest distance of the clump beyond the target.
  double protrusion;
  /// RMS angle between the normals, radians.
  double roughness;
  /// By how much the trace of the inertia of the spheres' union is less than that of the target
  /// at one density, over the latter.
  double union_inertia;
  /// The error of the inertia that is left with the masses of the spheres corrected, as
  /// inertia_residual of morula_masses.
  double inertia;
  /// Seconds that this clump takes from a ready solid: of the method with the distance field, and
  /// where the clump starts from those before, theirs, too.
  double seconds;
  /// Seconds so far: distance field, this clump and all before it.
  double seconds_so_far;
  /// The time step that the clump allows, as in morula_timestep.
  double time_step;
  /// The Rayleigh step of its spheres; 0 for a linear spring.
  double rayleigh;
  /// time_step over that of a sphere of the same mass and volume.
  double step_factor;
  /// The least radius over that of the sphere of equal volume.
  double least_radius;
  /// What one step of the solver costs, in units of one with single spheres.
  double step_cost;
  /// What simulated time costs, in the same unit: step_cost / step_factor.
  double time_cost;
  /// How far the masses meet the equations: one of MORULA_MASSES_*; MORULA_MASSES_NONE where
  /// none were wanted.
  int32_t masses;
  /// Why the method stopped: one of MORULA_STOPPED_*.
  int32_t stopped;
} morula_cost_point;

/// What is swept over: every resolution with every method and every deadline. Fill it with
/// morula_sweep_options_init(), which leaves all empty; none may stay so. The arrays are copied
/// before the call returns.
typedef struct morula_sweep_options {
  /// sizeof(morula_sweep_options).
  size_t struct_size;
  /// Numbers of cells, along what morula_solid_options.resolution says; with
  /// MORULA_RESOLUTION_CELL_SIZE edges of a cell. The grid of a voxel shape is its own: one is
  /// enough.
  const double *resolutions;
  /// Number of resolutions.
  size_t resolution_count;
  /// Methods: MORULA_METHOD_*.
  const int32_t *methods;
  /// Their efforts: MORULA_EFFORT_*, as many as methods; NULL: that of the clump options for all.
  const int32_t *efforts;
  /// Number of methods.
  size_t method_count;
  /// Seconds that each clump may take; 0: as long as it takes.
  const double *deadlines;
  /// Number of deadlines.
  size_t deadline_count;
} morula_sweep_options;

/// What one price list of a sweep is of.
typedef struct morula_swept {
  /// sizeof(morula_swept), set by the caller in the first of an array.
  size_t struct_size;
  /// The resolution, as it stood in the options.
  double resolution;
  /// Cells along x, y, z, padding included; 0 where the solid could not be made.
  uint64_t cells[3];
  /// Seconds that the solid took, once for all lists of one resolution.
  double solid_seconds;
  /// Seconds that each clump was given; 0: as long as it takes.
  double deadline;
  /// Lines of the list; 0 where there is none.
  uint64_t lines;
  /// One of MORULA_METHOD_*.
  int32_t method;
  /// One of MORULA_EFFORT_*.
  int32_t effort;
  /// MORULA_STATUS_OK, or why there is no list.
  int32_t status;
  /// 1: cancel or the sweep's deadline ended the list before its last number of spheres.
  int32_t cut;
} morula_swept;

/// How the spheres of a clump are weighed. Fill it with morula_mass_options_init().
typedef struct morula_mass_options {
  /// sizeof(morula_mass_options).
  size_t struct_size;
  /// Mass per (caller's unit)^3. Default 1.
  double density;
  /// Least mass of a sphere; negative: a thousandth of the body's mass, or a tenth of the mean
  /// where that is less. Default -1.
  double m_min;
  /// Greatest mass of a sphere; 0: no bound. Default 0.
  double m_max;
  /// Whose mass, centre and inertia the clump is to have: one of MORULA_TARGET_*. Default
  /// MORULA_TARGET_SOLID.
  int32_t target;
  /// What is wished of the masses beside: one of MORULA_OBJECTIVE_*. Default
  /// MORULA_OBJECTIVE_EVEN.
  int32_t objective;
  /// What to do where no masses have the centre: one of MORULA_INFEASIBLE_*. Default
  /// MORULA_INFEASIBLE_REFUSE.
  int32_t infeasible;
  /// Threads of this call; 0: all cores. Default 1. The result does not depend on it.
  int32_t threads;
  /// Called now and then on the calling thread; NULL: none.
  morula_progress progress;
  /// Handed to `progress`.
  void *user;
} morula_mass_options;

/// What a clump allows: three figures that answer three questions. A solver takes a part (a tenth to a
/// fifth) of the first, or of the second where it demands that.
typedef struct morula_timestep {
  /// sizeof(morula_timestep), set by the caller.
  size_t struct_size;
  /// What the rigid clump obeys: beyond sqrt(2 m / (N k)) an explicit integration of two equal
  /// clumps that touch in N contacts at their worst points gains energy without bound.
  double clump;
  /// The mass m that is felt there: 1/m = 1/M + (p x n) I^-1 (p x n) at the point of a sphere
  /// where pushing turns the clump most easily.
  double effective_mass;
  /// The stiffness k there: the spring's, or that of Hertz at the greatest overlap.
  double stiffness;
  /// The Rayleigh step of single spheres, pi r sqrt(density/G) / (0.1631 poisson + 0.8766),
  /// least over the spheres, each with the density that its mass gives it: what some codes
  /// demand although in a clump no sphere moves by itself. 0 for a linear spring.
  double rayleigh;
  /// The greatest overlap over the least radius when two clumps meet centrally at that speed, in
  /// one contact of their smallest spheres: contact laws hold far below 0.1.
  double overlap;
  /// The sphere of the worst point.
  uint32_t sphere;
  /// 0.
  uint32_t reserved;
  /// The same limit as `clump` where the N contacts push the same way on N spheres, those that are
  /// stiffest together, instead of all at the worst point: for flat bodies that lie on each other.
  /// Never less than `clump`, at most four times as much, the same for one contact.
  double together;
} morula_timestep;

/// How far the masses of the spheres add up to the body.
typedef struct morula_masses {
  /// sizeof(morula_masses), set by the caller.
  size_t struct_size;
  /// Mass of the body.
  double mass;
  /// The least mass that was demanded.
  double m_min;
  /// Where not all equations are met: the greatest m_min with which they could be, under the same
  /// m_max; 0 where no positive masses meet them, or where they are met.
  double largest_m_min;
  /// |sum of masses - mass| / mass.
  double mass_residual;
  /// Greatest component, along the body axes, of the distance between the centres, over the
  /// radius of gyration.
  double centre_residual;
  /// The greatest |error of I_jk| / sqrt(J_j J_k) in the body frame, J the principal moments.
  double inertia_residual;
  /// MORULA_OBJECTIVE_EVEN: how far the density varies, sqrt(sum (m - s)^2 / s / mass) with each
  /// sphere's share s of the union; else 0.
  double spread;
  /// By how much the trace of the inertia of the spheres' union is less than that of the target
  /// at one density, over the latter; 0 where the union is the target. A target shrunk to a
  /// coverage c would lack 1 - c^(5/3).
  double union_inertia_error;
  /// One of MORULA_MASSES_*.
  int32_t status;
  /// Spheres whose mass is m_min or m_max.
  uint32_t binding;
} morula_masses;

/// How a file for a DEM code is written. Fill it with morula_export_options_init().
typedef struct morula_export_options {
  /// sizeof(morula_export_options).
  size_t struct_size;
  /// How many units of length of the file one of the caller's has (1000 from metres to
  /// millimetres). Default 1.
  double length;
  /// The same of mass. Default 1.
  double mass;
  /// 1: coordinates in the caller's frame instead of the body's, where the format has a choice.
  /// Default 0.
  int32_t placed;
  /// Facets of each sphere where a surface is written: 20 * 4^facets triangles, at most 6.
  /// Default 3.
  uint32_t facets;
  /// Name of the template (UTF-8); NULL: "clump".
  const char *name;
  /// One of MORULA_PRECISION_*: MORULA_PRECISION_F32 writes centres and radii that single
  /// precision holds, each sphere within the one that it stands for. Default MORULA_PRECISION_F64.
  int32_t precision;
  /// Must be 0.
  int32_t reserved;
} morula_export_options;

/// A rigid body as a solver holds it: the shape in its place, and how it moves. A point x of the
/// shape is at position + quaternion (scale (x - centre)). Fill it with morula_parent_held(),
/// morula_fragments_held() or, before its fields are set by hand, morula_held_init().
typedef struct morula_held {
  /// sizeof(morula_held).
  size_t struct_size;
  /// Mass.
  double mass;
  /// Centre of mass, frame and unit of the shape.
  double centre[3];
  /// Inertia about the centre along the axes of the shape (not of the body), in mass x length^2
  /// of the world: xx, yy, zz, xy, xz, yz.
  double inertia[6];
  /// What lengths of the shape are multiplied by. Default 1.
  double scale;
  /// Where the centre is.
  double position[3];
  /// From the axes of the shape to those of the world: w, x, y, z of any length but 0. Default
  /// 1, 0, 0, 0.
  double quaternion[4];
  /// Velocity of the centre.
  double velocity[3];
  /// Angular velocity, along the axes of the world.
  double angular_velocity[3];
} morula_held;

/// What a cache of parents has done, and what it holds.
typedef struct morula_cache_counts {
  /// sizeof(morula_cache_counts), set by the caller.
  size_t struct_size;
  /// Parents that were there.
  uint64_t hits;
  /// Parents that were made.
  uint64_t misses;
  /// Parents that had to go, or that were too large to stay.
  uint64_t evicted;
  /// Parents that are held.
  uint64_t parents;
  /// Bytes of these, with their solids.
  uint64_t bytes;
} morula_cache_counts;

/// How a particle breaks. Fill it with morula_break_options_init(). Points, directions and
/// half-spaces are in the frame and unit of the shape.
typedef struct morula_break_options {
  /// sizeof(morula_break_options).
  size_t struct_size;
  /// MORULA_CUT_PLANES and MORULA_CUT_WITHIN: four numbers each, nx, ny, nz and offset, which
  /// hold the points p with n . p <= offset; n points out and has any length but 0.
  const double *half_spaces;
  /// How many.
  size_t half_space_count;
  /// MORULA_CUT_POINTS: x, y, z each.
  const double *points;
  /// One a point, in squares of the unit, for power cells; NULL: none.
  const double *weights;
  /// How many points.
  size_t point_count;
  /// Further half-spaces that no sphere may leave (walls of the scene), as half_spaces.
  const double *walls;
  /// How many.
  size_t wall_count;
  /// MORULA_CUT_SEEDED and MORULA_CUT_IMPACT: number of cells. Default 4.
  uint64_t cells;
  /// MORULA_CUT_IMPACT: where the body is hit.
  double point[3];
  /// MORULA_CUT_IMPACT: where to; of any length but 0. Default 1, 0, 0.
  double direction[3];
  /// Seed of every random choice. Default 0.
  uint64_t seed;
  /// Pieces of less volume become dust; 0: a 1e-9th of the parent's. Default 0.
  double least_volume;
  /// Most spheres of a fragment. Default 20.
  uint64_t spheres;
  /// Least radius. Default 0.
  double min_radius;
  /// Spheres of two fragments are this far apart at least. Default 0.
  double gap;
  /// Least mass of a sphere where masses are wanted; negative: a thousandth of the fragment's
  /// mass, or a tenth of the mean where that is less. Default -1.
  double m_min;
  /// Seconds after which the spheres are taken as they are; 0: no deadline. Default 0.
  double deadline_seconds;
  /// One of MORULA_CUT_*. Default MORULA_CUT_SEEDED.
  int32_t kind;
  /// 1: spheres stay within the union of the parent's, which neighbours touch. Default 1.
  int32_t within_union;
  /// One of MORULA_PRECISION_*: MORULA_PRECISION_F32 gives centres and radii that single
  /// precision holds, in the frame of the shape. Default MORULA_PRECISION_F64.
  int32_t precision;
  /// 1: coverage, volume_share and step_factor are wanted. Default 1.
  int32_t quality;
  /// 1: a mass for each sphere is wanted. Default 0.
  int32_t masses;
  /// Of the masses: one of MORULA_OBJECTIVE_*. Default MORULA_OBJECTIVE_EVEN.
  int32_t objective;
  /// Of the masses: one of MORULA_INFEASIBLE_*. Default MORULA_INFEASIBLE_REFUSE, which leaves
  /// such a fragment without masses.
  int32_t infeasible;
  /// Threads of this call; 0: all cores. Default 1. The result does not depend on it.
  int32_t threads;
  /// Called now and then on the calling thread; NULL: none.
  morula_progress progress;
  /// Handed to `progress`.
  void *user;
} morula_break_options;

/// A fragment, or a piece of dust, which has no spheres.
typedef struct morula_fragment {
  /// sizeof(morula_fragment), set by the caller.
  size_t struct_size;
  /// Mass.
  double mass;
  /// Centre of mass, frame and unit of the shape.
  double centre[3];
  /// Inertia about it along the axes of the shape, in mass x length^2 of the world: xx, yy, zz,
  /// xy, xz, yz.
  double inertia[6];
  /// Principal moments, ascending.
  double principal[3];
  /// Body axes in the frame of the shape, by columns.
  double rotation[9];
  /// Where the centre is in the world.
  double position[3];
  /// The body axes in the world: w, x, y, z, w >= 0.
  double quaternion[4];
  /// Velocity of the centre.
  double velocity[3];
  /// Angular velocity, along the axes of the world.
  double angular_velocity[3];
  /// Volume, unit of the shape.
  double volume;
  /// Share of its volume that its spheres cover; 0 where not wanted.
  double coverage;
  /// Volume of the union of its spheres over that of the parent's solid; 0 where not wanted.
  double volume_share;
  /// The time step that it allows over that of the parent's clump, for the same spring and
  /// density; 0: not known (the parent has no spheres, or it was not wanted).
  double step_factor;
  /// Of its masses: the greatest |error of I_jk| / sqrt(J_j J_k) in the body frame; 0 where
  /// there are none.
  double inertia_residual;
  /// Spheres.
  uint64_t sphere_count;
  /// Pairs of its map.
  uint64_t map_count;
  /// Half-spaces that bound it within the parent's solid.
  uint64_t half_space_count;
  /// The cell of the cut that it comes from: the number of the point, or of the side.
  uint64_t cell;
  /// Why it has no more spheres: one of MORULA_STOPPED_*.
  int32_t stopped;
  /// One of MORULA_MASSES_*; MORULA_MASSES_NONE where none were wanted or found (the notes tell).
  int32_t masses;
} morula_fragment;

/// What a break has made of the whole.
typedef struct morula_break_totals {
  /// sizeof(morula_break_totals), set by the caller.
  size_t struct_size;
  /// Kinetic energy of fragments and dust less that of the parent: rounding where the inertia
  /// of the held body is that of its solid.
  double energy;
  /// The greatest entry of the held inertia less that of the pieces, over its greatest; the greatest
  /// number where the held body has none.
  double inertia_error;
  /// How far the held centre lies from that of the pieces, frame and unit of the shape: by so
  /// much the centres of all of them are shifted.
  double shift[3];
} morula_break_totals;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/// The version of the library that runs: 1000000 major + 1000 minor + patch.
///
/// Returns: the number; it equals MORULA_VERSION when the program runs with the
/// library whose header it was compiled with.
/// Threads: any thread at any time. Never fails.
uint32_t morula_version(void);

/// The version of the library that runs, as text ("0.1.0").
///
/// Returns: static text, never NULL; do not free it.
/// Threads: any thread at any time. Never fails.
const char *morula_version_string(void);

/// The name of a status ("NOT_FINITE" for MORULA_STATUS_NOT_FINITE).
///
/// Returns: static text, never NULL ("UNKNOWN" for a number that is no status); do not free it.
/// Threads: any thread at any time. Never fails.
const char *morula_status_name(int32_t status);

/// One sentence on why this thread's last call failed, with the value and index
/// at fault; empty when it did not fail. Every call clears it on entry, except
/// the `_free`, `_name`, `_version` and `_sizeof` functions and this one.
///
/// Returns: text, never NULL, owned by the library and valid until this
/// thread's next call of the library; copy it to keep it.
/// Threads: each thread has its own message. Never fails.
const char *morula_last_error_message(void);

/// The size that the library gives one of its structs, for programs that are
/// not written in C to check their own declaration.
///
/// Parameters: `which` is one of MORULA_STRUCT_*.
/// Returns: the size in bytes, 0 for a number that names no struct.
/// Threads: any thread at any time. Never fails.
size_t morula_sizeof(int32_t which);

/// Sets where the library's log lines go. There is none at first: the library
/// never prints.
///
/// Parameters: `sink` is called with each line (NULL: no log any more); `user`
/// is handed to it. Both must stay valid until another sink is set and every
/// call that was running then has returned.
/// Returns: MORULA_STATUS_OK.
/// Threads: any thread; the sink is one for the whole process.
int32_t morula_set_log(morula_log sink, void *user);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_import_options_init(struct morula_import_options *options,
                                   size_t size);

/// Makes a shape from a triangle mesh.
///
/// The mesh is welded, its defects are repaired where that is safe, and what
/// was done is in the report. Open meshes are taken while their inside is
/// defined; a sheet or a single triangle is refused.
///
/// Parameters: `vertices` holds x, y, z of `vertex_count` vertices, one after
/// the other, in the caller's unit and frame; `triangles` holds three vertex
/// indices for each of `triangle_count` triangles, counter-clockwise seen from
/// outside, the first vertex being index_base of the options; `options` may be
/// NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option);
/// STRUCT_SIZE; NOT_FINITE (a vertex); INDEX_OUT_OF_RANGE (a triangle); EMPTY;
/// ZERO_VOLUME; OPEN_SURFACE; SEVERAL_BODIES; TOO_LARGE; MEMORY_LIMIT;
/// OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_from_mesh(const double *vertices,
                               size_t vertex_count,
                               const uint32_t *triangles,
                               size_t triangle_count,
                               const struct morula_import_options *options,
                               struct morula_shape **shape);

/// Takes a shape back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_shape_free(struct morula_shape *shape);

/// What was found in the input and what was done about it.
///
/// Parameters: `report` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_shape_report(const struct morula_shape *shape, struct morula_report *report);

/// How many notes there are on the input: sentences that a user should know.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_shape_note_count(const struct morula_shape *shape, size_t *count);

/// Copies note `index` (from 0) with its closing NUL.
///
/// Parameters: `text` has room for `capacity` bytes; `length` (may be NULL)
/// becomes the length without the NUL. With `text` NULL and `capacity` 0 only
/// `length` is written.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_shape_copy_note(const struct morula_shape *shape,
                               size_t index,
                               size_t capacity,
                               char *text,
                               size_t *length);

/// Mass, centre and inertia of a shape, exact for closed meshes and voxels.
///
/// Parameters: `density` is mass per (caller's unit)^3; `moments` is filled:
/// set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INVALID_ARGUMENT (the
/// density is not a number greater than 0, or so great that mass or inertia
/// overflow); OUT_OF_MEMORY; INTERNAL.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_shape_moments(const struct morula_shape *shape,
                             double density,
                             struct morula_moments *moments);

/// What was done to make the shape: stage times and counters of the call that
/// made it. What comes later (solids, moments, clumps) does not count.
///
/// Parameters: `counters` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_shape_counters(const struct morula_shape *shape,
                              struct morula_counters *counters);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_file_options_init(struct morula_file_options *options,
                                 size_t size);

/// Makes a shape from a file: STL, OBJ, PLY, OFF, npy, TIFF or raw voxels.
///
/// The format is told by the content, then by the name, unless the options
/// force one. What a header declares is checked against the file's length
/// before memory is taken.
///
/// Parameters: `path` is the file's name (UTF-8); `import` and `file` may be
/// NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option); IO;
/// FORMAT (with the byte or line); UNSUPPORTED; STRUCT_SIZE; NOT_FINITE;
/// INDEX_OUT_OF_RANGE; EMPTY; ZERO_VOLUME; OPEN_SURFACE; SEVERAL_BODIES;
/// TOO_LARGE; MEMORY_LIMIT; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: free *shape with morula_shape_free(). *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_from_file(const char *path,
                               const struct morula_import_options *import,
                               const struct morula_file_options *file,
                               struct morula_shape **shape);

/// Makes a shape from the bytes of a file in memory, as morula_shape_from_file().
///
/// Parameters: `bytes` holds `count` bytes; `name` is the file's name, which
/// helps where the content does not tell the format (may be NULL); `import` and
/// `file` may be NULL for the defaults.
/// Returns: as morula_shape_from_file(), but never IO.
/// Ownership: the bytes are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_from_bytes(const uint8_t *bytes,
                                size_t count,
                                const char *name,
                                const struct morula_import_options *import,
                                const struct morula_file_options *file,
                                struct morula_shape **shape);

/// Lists the labels of a label volume in a file, ascending, without 0;
/// morula_shape_from_file() makes a shape of one of them with the meaning
/// MORULA_MEANING_LABEL. The file is read as by that function; values of 8 or 16
/// bits or whole floating-point numbers are labels as well.
///
/// Parameters: `path` is the file's name (UTF-8); `import` (memory_limit,
/// progress) and `file` (not its meaning) may be NULL for the defaults;
/// `capacity`, `ids`, `cells`, `boxes`, `touches_border` as
/// morula_labels_copy(), and with all of the arrays NULL the labels are only
/// counted; `count` becomes their number.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option, a mesh,
/// or a value that is no label); BUFFER_TOO_SMALL (nothing is written); IO;
/// FORMAT (with the byte); UNSUPPORTED; STRUCT_SIZE; EMPTY; TOO_LARGE;
/// MEMORY_LIMIT; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Threads: any thread; calls are independent of each other.
int32_t morula_labels_from_file(const char *path,
                                const struct morula_import_options *import,
                                const struct morula_file_options *file,
                                size_t capacity,
                                uint32_t *ids,
                                uint64_t *cells,
                                uint64_t *boxes,
                                int32_t *touches_border,
                                size_t *count);

/// Lists the labels of a label volume in the bytes of a file in memory, as
/// morula_labels_from_file().
///
/// Parameters: `bytes` holds `byte_count` bytes; `name` is the file's name, which
/// helps where the content does not tell the format (may be NULL); the others as
/// morula_labels_from_file().
/// Returns: as morula_labels_from_file(), but never IO.
/// Threads: any thread; calls are independent of each other.
int32_t morula_labels_from_bytes(const uint8_t *bytes,
                                 size_t byte_count,
                                 const char *name,
                                 const struct morula_import_options *import,
                                 const struct morula_file_options *file,
                                 size_t capacity,
                                 uint32_t *ids,
                                 uint64_t *cells,
                                 uint64_t *boxes,
                                 int32_t *touches_border,
                                 size_t *count);

/// Makes a shape from a mask of voxels: those that are not 0 are solid.
///
/// Parameters: `dims` holds the numbers of cells nx, ny, nz along x, y, z and
/// `mask` a byte for each, x fastest: the cell (i, j, k) is element
/// i + nx (j + ny k) and covers origin + (i, j, k) times spacing up to
/// origin + (i+1, j+1, k+1) times spacing; `spacing` the edge lengths of a cell (NULL: 1, 1, 1);
/// `origin` the lower corner of the first cell (NULL: 0, 0, 0). No empty border
/// is needed. `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (spacing or an
/// option); NOT_FINITE (origin); EMPTY; SEVERAL_BODIES; STRUCT_SIZE; TOO_LARGE;
/// MEMORY_LIMIT; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_from_mask(const uint8_t *mask,
                               const size_t *dims,
                               const double *spacing,
                               const double *origin,
                               const struct morula_import_options *options,
                               struct morula_shape **shape);

/// Makes a shape from a grey volume of 8 bits.
///
/// Parameters: `values`, `dims`, `spacing`, `origin`, `options` as
/// morula_shape_from_mask(); cells greater than *threshold are solid, NULL
/// means Otsu's threshold.
/// Returns: as morula_shape_from_mask(); NOT_FINITE also for the threshold.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_from_grey_u8(const uint8_t *values,
                                  const size_t *dims,
                                  const double *spacing,
                                  const double *origin,
                                  const double *threshold,
                                  const struct morula_import_options *options,
                                  struct morula_shape **shape);

/// Makes a shape from a grey volume of 16 bits.
///
/// Parameters, returns, ownership, threads: as morula_shape_from_grey_u8().
int32_t morula_shape_from_grey_u16(const uint16_t *values,
                                   const size_t *dims,
                                   const double *spacing,
                                   const double *origin,
                                   const double *threshold,
                                   const struct morula_import_options *options,
                                   struct morula_shape **shape);

/// Makes a shape from a grey volume of single precision.
///
/// Parameters, returns, ownership, threads: as morula_shape_from_grey_u8();
/// NOT_FINITE also for a value.
int32_t morula_shape_from_grey_f32(const float *values,
                                   const size_t *dims,
                                   const double *spacing,
                                   const double *origin,
                                   const double *threshold,
                                   const struct morula_import_options *options,
                                   struct morula_shape **shape);

/// Makes a shape from one label of a label volume.
///
/// Parameters: `labels`, `dims`, `spacing`, `origin`, `options` as
/// morula_shape_from_mask(); the cells that hold `label` are solid. The report
/// says whether they touch the border of the array.
/// Returns: as morula_shape_from_mask(); INDEX_OUT_OF_RANGE when no cell holds the label;
/// INVALID_ARGUMENT for label 0, which is background.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_from_label(const uint32_t *labels,
                                const size_t *dims,
                                const double *spacing,
                                const double *origin,
                                uint32_t label,
                                const struct morula_import_options *options,
                                struct morula_shape **shape);

/// How many labels other than 0 a label volume holds.
///
/// Parameters: `labels` and `dims` as morula_shape_from_label().
/// Returns: MORULA_STATUS_OK; NULL_POINTER; TOO_LARGE; EMPTY (no cell);
/// OUT_OF_MEMORY; INTERNAL.
/// Threads: any thread.
int32_t morula_labels_count(const uint32_t *labels, const size_t *dims, size_t *count);

/// Lists the labels of a label volume, ascending, without 0.
///
/// Parameters: `labels` and `dims` as morula_shape_from_label(); each of the
/// arrays may be NULL when it is not asked for, the others have room for
/// `capacity` labels: `ids` the labels, `cells` their numbers of cells, `boxes`
/// six numbers each (the first cell along x, y, z and the last, inclusive),
/// `touches_border` 1 where the label touches the border of the array, so that
/// the particle may be cut off.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is
/// written); TOO_LARGE; EMPTY (no cell); OUT_OF_MEMORY; INTERNAL.
/// Threads: any thread.
int32_t morula_labels_copy(const uint32_t *labels,
                           const size_t *dims,
                           size_t capacity,
                           uint32_t *ids,
                           uint64_t *cells,
                           uint64_t *boxes,
                           int32_t *touches_border);

/// Makes a shape from silhouettes of a particle seen by calibrated cameras: the
/// visual hull, carved out of voxels. It contains the body, and comes closer with
/// more cameras; a dent that no outline shows stays filled.
///
/// Parameters: `count` silhouettes. `masks` holds all of them one behind the other,
/// a byte for each pixel, row by row: not 0 where the particle is seen. Silhouette k
/// has `widths[k]` columns and `heights[k]` rows; the pixel of column i and row j is
/// element i + j times width and covers [i, i+1] x [j, j+1]. Space outside an image
/// is empty; a silhouette that touches the border of its image is noted. `cameras`
/// holds 12 numbers for each, the 3 x 4 matrix P row by row: (u, v, w) = P (x, y, z, 1)
/// is seen at column u/w and row v/w, with w > 0 in front of the camera. `cells`
/// along the longest edge of the hull's box, 4 to 2048. `carve` is one of
/// MORULA_CARVE_*. `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (no pixel, cells,
/// carve, a camera without rank 3, cameras that bound no body, an option);
/// NOT_FINITE (a camera); EMPTY (a silhouette without particle, or no point lies
/// within all of them); SEVERAL_BODIES; STRUCT_SIZE; TOO_LARGE; MEMORY_LIMIT;
/// OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_from_silhouettes(size_t count,
                                      const uint8_t *masks,
                                      const size_t *widths,
                                      const size_t *heights,
                                      const double *cameras,
                                      size_t cells,
                                      int32_t carve,
                                      const struct morula_import_options *options,
                                      struct morula_shape **shape);

/// The name of the built-in analytic particle number `index`, counted from 0.
///
/// Returns: static text; NULL when there are no more. Do not free it.
/// Threads: any thread at any time.
const char *morula_primitive_name(size_t index);

/// How many parameters a built-in particle has.
///
/// Parameters: `name` is one of morula_primitive_name().
/// Returns: MORULA_STATUS_OK; NULL_POINTER; UNSUPPORTED (no such name).
/// Threads: any thread.
int32_t morula_primitive_parameter_count(const char *name, size_t *count);

/// Copies the key of parameter `index` (from 0) with its closing NUL, and its default.
///
/// Parameters: `key` has room for `capacity` bytes; `length` (may be NULL)
/// becomes the length without the NUL; with `key` NULL and `capacity` 0 the key
/// is not copied. `value` (may be NULL) becomes the default.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; UNSUPPORTED (no such name);
/// INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is written).
/// Threads: any thread.
int32_t morula_primitive_copy_parameter(const char *name,
                                        size_t index,
                                        size_t capacity,
                                        char *key,
                                        size_t *length,
                                        double *value);

/// Makes a shape of a built-in analytic particle, centred on the origin, its
/// axis of revolution along z. Their names, parameters and defaults (lengths in
/// the caller's unit; a tablet and an M&M of millimetres):
///
///   sphere          radius = 1.0            radius
///   ellipsoid       a = 1.0                 semi-axis along x
///                   b = 0.75                semi-axis along y
///                   c = 0.5                 semi-axis along z
///   superellipsoid  a = 1.0                 semi-axis along x
///                   b = 0.75                semi-axis along y
///                   c = 0.5                 semi-axis along z
///                   e1 = 0.5                exponent along z, 0.1 to 2.5; 1 is round, less boxier
///                   e2 = 0.5                exponent in the xy plane, likewise
///   box             a = 1.0                 edge along x
///                   b = 1.0                 edge along y
///                   c = 1.0                 edge along z
///   cylinder        radius = 0.5            radius
///                   height = 1.0            height along z
///   capsule         radius = 0.5            radius, also of the caps
///                   height = 1.0            height along z of the cylinder, without the caps
///   torus           major = 1.0             radius of the centre line, about z
///                   minor = 0.4             radius of the tube, less than major
///   cone            radius = 1.0            radius of the base, which is below
///                   height = 2.0            height along z; the centroid is at the origin
///   tablet          band_radius = 5.675     radius of the band
///                   band_height = 4.0       height of the band along z
///                   cap_height = 1.23       height of each cap, at most band_radius
///   mandm           radius = 6.7            equatorial radius
///                   flatness = 6.93/13.4    short axis (along z) over the long one, at most 1
///   stone           seed = 1.0              which stone, a whole number from 0 to 2^53
///                   diameter = 1.0          diameter of the sphere of equal volume
///                   roughness = 0.5         size of the facets and roughness, 0 to 1
///
/// A superellipsoid is the body (|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) <= 1.
///
/// Parameters: `name` is one of morula_primitive_name(); `keys` and `values`
/// set `count` of its parameters (the keys of the table, which
/// morula_primitive_copy_parameter() gives as well; NULL with a count of 0 keeps
/// the defaults); `segments` is about the number of edges around the body (0:
/// 64); `seed` is that of a stone unless a key sets it, and is not read by the
/// others; `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; UNSUPPORTED (no such name);
/// INVALID_ARGUMENT (a key, a value or an option); STRUCT_SIZE; NOT_FINITE;
/// TOO_LARGE; MEMORY_LIMIT; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: strings and arrays are copied; free *shape with
/// morula_shape_free(). *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_from_primitive(const char *name,
                                    const char *const *keys,
                                    const double *values,
                                    size_t count,
                                    uint32_t segments,
                                    uint64_t seed,
                                    const struct morula_import_options *options,
                                    struct morula_shape **shape);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_solid_options_init(struct morula_solid_options *options,
                                  size_t size);

/// Makes the solid of a shape: grid, inside, exact moments. One solid serves many clumps.
///
/// Parameters: `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option);
/// STRUCT_SIZE; EMPTY; ZERO_VOLUME; OPEN_SURFACE; MEMORY_LIMIT (with both
/// figures); TOO_LARGE; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: the shape stays the caller's and may be freed at once; free
/// *solid with morula_solid_free(). *solid is written only on success.
/// Threads: any thread; the shape is only read.
int32_t morula_solid_from_shape(const struct morula_shape *shape,
                                const struct morula_solid_options *options,
                                struct morula_solid **solid);

/// Takes a solid back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_solid_free(struct morula_solid *solid);

/// The grid of a solid.
///
/// Parameters (each may be NULL when it is not asked for): `dims` becomes the
/// numbers of cells along x, y, z, padding included; `spacing` the edge lengths
/// of a cell and `origin` the lower corner of the first cell, in the caller's
/// unit and frame.
/// Returns: MORULA_STATUS_OK; NULL_POINTER (the solid).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_solid_grid(const struct morula_solid *solid,
                          size_t *dims,
                          double *spacing,
                          double *origin);

/// Exact signed distances from points to the surface, negative inside.
///
/// Parameters: `points` holds x, y, z of `count` points, one after the other,
/// in the caller's unit and frame; `distances` has room for `count` numbers.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; NOT_FINITE (a coordinate);
/// INVALID_ARGUMENT (a point farther than 1e100 sizes of the body); TOO_LARGE;
/// MEMORY_LIMIT (the tree over the surface, which the first call makes);
/// OUT_OF_MEMORY; INTERNAL.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_solid_distance(const struct morula_solid *solid,
                              size_t count,
                              const double *points,
                              double *distances);

/// How many notes there are on the solid: sentences that a user should know,
/// such as too few cells across its thinnest part.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_solid_note_count(const struct morula_solid *solid, size_t *count);

/// Copies note `index` (from 0) with its closing NUL.
///
/// Parameters: `text` has room for `capacity` bytes; `length` (may be NULL)
/// becomes the length without the NUL. With `text` NULL and `capacity` 0 only
/// `length` is written.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_solid_copy_note(const struct morula_solid *solid,
                               size_t index,
                               size_t capacity,
                               char *text,
                               size_t *length);

/// Mass, centre and inertia of a solid.
///
/// Parameters, returns, threads: as morula_shape_moments(); nothing is computed anew.
int32_t morula_solid_moments(const struct morula_solid *solid,
                             double density,
                             struct morula_moments *moments);

/// What was done on the road to the solid: stage times and counters of the
/// calls that made its shape and itself, added up (of peak_bytes the greatest).
/// Clumps made from it do not count.
///
/// Parameters: `counters` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_solid_counters(const struct morula_solid *solid,
                              struct morula_counters *counters);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_clump_options_init(struct morula_clump_options *options,
                                  size_t size);

/// Makes a clump of a shape; the solid is made inside. For several clumps of
/// one shape make the solid once and use morula_clump_from_solid().
///
/// Parameters: `solid_options` and `options` may be NULL for the defaults;
/// threads, progress and user are those of `options`.
/// Returns: MORULA_STATUS_OK; the statuses of morula_solid_from_shape() and of
/// morula_clump_from_solid().
/// Ownership: the shape stays the caller's and may be freed at once; free
/// *clump with morula_clump_free(). *clump is written only on success.
/// Threads: any thread; the shape is only read. The same bytes come out for any
/// number of threads.
int32_t morula_clump_from_shape(const struct morula_shape *shape,
                                const struct morula_solid_options *solid_options,
                                const struct morula_clump_options *options,
                                struct morula_clump **clump);

/// Makes a clump of a solid.
///
/// Parameters: `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK, also when the deadline passed or the callback
/// cancelled after there were spheres (ask morula_clump_stopped());
/// NULL_POINTER; INVALID_ARGUMENT (an option); STRUCT_SIZE; CANCELLED (before
/// there was a sphere); NO_SPHERES; ZERO_VOLUME (half-spaces that leave nothing of the body);
/// UNSUPPORTED; TOO_LARGE; MEMORY_LIMIT; OUT_OF_MEMORY; INTERNAL.
/// Ownership: the solid stays the caller's and may be freed at once; free
/// *clump with morula_clump_free(). *clump is written only on success.
/// Threads: any thread; the solid is only read. The same bytes come out for any
/// number of threads.
int32_t morula_clump_from_solid(const struct morula_solid *solid,
                                const struct morula_clump_options *options,
                                struct morula_clump **clump);

/// Takes a clump back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_clump_free(struct morula_clump *clump);

/// How many spheres a clump has; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_sphere_count(const struct morula_clump *clump, size_t *count);

/// Copies the spheres, in the order in which the method chose them, or by falling radius where it
/// makes all at once.
///
/// Parameters: `xyzr` has room for `capacity` spheres of four numbers each: x,
/// y, z and radius, in the caller's unit and in the frame that the options
/// asked for (in Fortran an array xyzr(4, n)).
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_copy_spheres(const struct morula_clump *clump,
                                  size_t capacity,
                                  double *xyzr);

/// Why the method stopped: one of MORULA_STOPPED_*.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_stopped(const struct morula_clump *clump, int32_t *stopped);

/// The word for a MORULA_STOPPED_* number ("deadline").
///
/// Returns: static text, never NULL ("unknown" for other numbers); do not free it.
/// Threads: any thread at any time. Never fails.
const char *morula_stopped_name(int32_t stopped);

/// Copies the clump's note with its closing NUL: what is to be
/// said of it (fewer spheres than were asked for, a deadline, a demand that could not be met), else
/// empty.
///
/// Parameters: `text` has room for `capacity` bytes; `length` (may be NULL)
/// becomes the length without the NUL. With `text` NULL and `capacity` 0 only
/// `length` is written.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_copy_note(const struct morula_clump *clump,
                               size_t capacity,
                               char *text,
                               size_t *length);

/// Mass, centre and inertia of the clump's target: what the solver should give
/// the body (not the sum over the spheres, which overlap).
///
/// All of it is in the input frame, whatever the frame of the spheres: `centre`
/// and `rotation` are the pose that takes body-frame spheres back to the input
/// frame, and `principal` is the inertia in the body frame.
///
/// Parameters: `density` is mass per (caller's unit)^3; `moments` is filled:
/// set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; NOT_WANTED (without
/// MORULA_WANT_MOMENTS); INVALID_ARGUMENT (the density is not a number greater
/// than 0, or so great that mass or inertia overflow).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_moments(const struct morula_clump *clump,
                             double density,
                             struct morula_moments *moments);

/// How far the clump is from its target by volume.
///
/// Parameters: `overlap` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; NOT_WANTED (without
/// MORULA_WANT_OVERLAP); CANCELLED (the call was cancelled before it was measured).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_overlap(const struct morula_clump *clump, struct morula_overlap *overlap);

/// How far the clump's surface is from its target's.
///
/// Parameters: `surface` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; NOT_WANTED (without
/// MORULA_WANT_SURFACE); CANCELLED (the call was cancelled before it was measured).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_surface(const struct morula_clump *clump, struct morula_surface *surface);

/// Copies the exposed area of each sphere, in the order of the spheres.
///
/// Parameters: `areas` has room for `capacity` numbers, as many as there are spheres.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is
/// written); NOT_WANTED (without MORULA_WANT_SURFACE); CANCELLED (the call was
/// cancelled before they were measured).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_copy_exposed_areas(const struct morula_clump *clump,
                                        size_t capacity,
                                        double *areas);

/// Copies the greatest number of spheres that one plane touches within each of
/// the plane_tolerances of the options, in their order.
///
/// Parameters: `counts` has room for `capacity` numbers, as many as there were tolerances.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is
/// written); NOT_WANTED (without plane_tolerances); CANCELLED (the call was
/// cancelled before they were counted).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_copy_plane_contacts(const struct morula_clump *clump,
                                         size_t capacity,
                                         uint32_t *counts);

/// What was done on the whole road to the clump: stage times and counters of
/// the calls that made its shape, its solid and itself, added up (of peak_bytes
/// the greatest). What was not wanted stays 0. The calls that made a solid or a
/// shape count in every clump that was made from it.
///
/// Parameters: `counters` is filled; set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_counters(const struct morula_clump *clump,
                              struct morula_counters *counters);

/// How many limits of the method, of the numbers or of the measure a clump meets; mostly 0.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_warning_count(const struct morula_clump *clump, size_t *count);

/// Copies what limits a clump: of each limit its number, the figure found and the bound that it misses.
///
/// Parameters: `codes`, `figures` and `bounds` have room for `capacity` numbers each; the codes are
/// of MORULA_WARNING_*.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written); OUT_OF_MEMORY.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_copy_warnings(const struct morula_clump *clump,
                                   size_t capacity,
                                   int32_t *codes,
                                   double *figures,
                                   double *bounds);

/// Copies the sentence of warning `index` (counted from 0) with its closing NUL.
///
/// Parameters: `text`, `capacity` and `length` as morula_clump_copy_note().
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_clump_copy_warning(const struct morula_clump *clump,
                                  size_t index,
                                  size_t capacity,
                                  char *text,
                                  size_t *length);

/// The word for a MORULA_WARNING_* number ("far away").
///
/// Returns: static text, never NULL ("unknown" for other numbers); do not free it.
/// Threads: any thread at any time. Never fails.
const char *morula_warning_name(int32_t warning);

/// Makes clumps of one solid with several numbers of spheres: levels of detail.
///
/// Parameters: `spheres` holds `count` numbers of spheres, which stand in for that of `options`;
/// `options` may be NULL for the defaults; `clumps` has room for `count` handles, in the same
/// order. Each clump is, byte for byte, what morula_clump_from_solid() gives for its number;
/// the deadline is one for all.
/// Returns: MORULA_STATUS_OK; the statuses of morula_clump_from_solid(), of the first that
/// failed: then none is written.
/// Ownership: the solid stays the caller's; free each clump with morula_clump_free().
/// Threads: any thread; the solid is only read.
int32_t morula_clumps_from_solid(const struct morula_solid *solid,
                                 const struct morula_clump_options *options,
                                 const uint64_t *spheres,
                                 size_t count,
                                 struct morula_clump **clumps);

/// Makes a clump of each of many shapes; their solids are made inside. Threads share the
/// shapes, one each.
///
/// Parameters: `shapes` holds `count` handles; `solid_options` and `options` may be NULL for the
/// defaults; threads, progress and user are those of `options`, its deadline is one for all;
/// memory limits are for each shape by itself. `clumps` has room for `count` handles, and
/// `statuses`, which may be NULL, for `count` statuses, in the same order. Each clump is, byte
/// for byte, what morula_clump_from_shape() gives.
/// Returns: MORULA_STATUS_OK; the statuses of morula_clump_from_shape(), of the first shape that
/// failed. Then, with `statuses`, both arrays are written all the same, with NULL for each clump
/// that failed, and the log is told each failure; without, none is written.
/// Ownership: the shapes stay the caller's; free each clump with morula_clump_free().
/// Threads: any thread; the shapes are only read. The same bytes come out for any number of
/// threads.
int32_t morula_clumps_from_shapes(const struct morula_shape *const *shapes,
                                  size_t count,
                                  const struct morula_solid_options *solid_options,
                                  const struct morula_clump_options *options,
                                  struct morula_clump **clumps,
                                  int32_t *statuses);

/// Makes a clump of each of many labels of a label volume. Threads share the labels, one
/// each, and look at a label's own box alone.
///
/// Parameters: `labels`, `dims`, `spacing`, `origin`, `import_options` as
/// morula_shape_from_label(); `wanted` holds the `count` labels, see morula_labels_copy();
/// all others as morula_clumps_from_shapes().
/// Returns: as morula_clumps_from_shapes() and morula_shape_from_label().
/// Ownership: free each clump with morula_clump_free().
/// Threads: any thread. The same bytes come out for any number of threads.
int32_t morula_clumps_from_labels(const uint32_t *labels,
                                  const size_t *dims,
                                  const double *spacing,
                                  const double *origin,
                                  const uint32_t *wanted,
                                  size_t count,
                                  const struct morula_import_options *import_options,
                                  const struct morula_solid_options *solid_options,
                                  const struct morula_clump_options *options,
                                  struct morula_clump **clumps,
                                  int32_t *statuses);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_cost_options_init(struct morula_cost_options *options,
                                 size_t size);

/// Fills bounds that bound nothing, with the goal MORULA_GOAL_KNEE.
///
/// Parameters: `size` is sizeof *bounds.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_cost_bounds_init(struct morula_cost_bounds *bounds,
                                size_t size);

/// Makes the price list of a solid.
///
/// Parameters: `options` says how each clump is made and may be NULL for the defaults; its
/// `spheres`, `mismatch`, `wants` and quality are not read, its deadline is one for the whole list;
/// `cost` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK, also when the deadline passed or the callback cancelled after there
/// was a line (ask morula_cost_cut()); the statuses of morula_clump_from_solid() and
/// morula_clump_timestep() where no line can be made; EMPTY; UNSUPPORTED (levels that the method
/// cannot nest); OUT_OF_MEMORY (at any line). A number of spheres that else fails while others do
/// not is left out.
/// Ownership: the solid stays the caller's and may be freed at once; free *curve with
/// morula_cost_free(). *curve is written only on success.
/// Threads: any thread; the solid is only read. But for seconds the same bytes come out for any
/// number of threads, as long as no deadline is met.
int32_t morula_cost_curve(const struct morula_solid *solid,
                          const struct morula_clump_options *options,
                          const struct morula_cost_options *cost,
                          struct morula_cost **curve);

/// How many lines a price list has; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_cost_count(const struct morula_cost *curve, size_t *count);

/// Whether cancel or the deadline ended a price list before its last number of spheres: 0 or 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_cost_cut(const struct morula_cost *curve, int32_t *cut);

/// Copies the lines, by the number of spheres.
///
/// Parameters: `points` has room for `capacity` structs, one after the other, all of the size that
/// struct_size of the first says; that of the others is set.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written); STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_cost_copy(const struct morula_cost *curve,
                         size_t capacity,
                         struct morula_cost_point *points);

/// The clump of a line, with overlap, moments and, where they were wanted, surface.
///
/// Parameters: `index` counts lines from 0.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; OUT_OF_MEMORY.
/// Ownership: free *clump with morula_clump_free(); it lives on without the list. *clump is
/// written only on success.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_cost_clump(const struct morula_cost *curve,
                          size_t index,
                          struct morula_clump **clump);

/// Chooses a line within bounds, and says why in one sentence.
///
/// Parameters: `bounds` may be NULL for the knee: where more spheres stop paying; *index becomes
/// the number of the line; the sentence goes to `text`, which has room for `capacity` bytes;
/// `length` (may be NULL) becomes its length without the closing NUL. With `text` NULL and
/// `capacity` 0 no sentence is copied.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (a bound that is not a number, a goal
/// that is none); NO_SPHERES (no line is within the bounds; the message names the nearest);
/// BUFFER_TOO_SMALL; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_cost_choose(const struct morula_cost *curve,
                           const struct morula_cost_bounds *bounds,
                           size_t *index,
                           size_t capacity,
                           char *text,
                           size_t *length);

/// Takes a price list back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_cost_free(struct morula_cost *curve);

/// Fills options that sweep over nothing yet.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_sweep_options_init(struct morula_sweep_options *options,
                                  size_t size);

/// Makes the price lists of a shape over resolutions, methods and deadlines.
///
/// Parameters: `solid_options` and `options` may be NULL for the defaults; of the former the
/// number of cells (with MORULA_RESOLUTION_CELL_SIZE the edge of a cell) is not read, of the latter
/// neither the method nor, where the sweep has efforts, the effort, nor what morula_cost_curve()
/// does not read. Threads, progress and user are those of `options`, whose deadline is one for the
/// whole sweep: the lists that are begun after it have a line each. `cost` may be NULL for the
/// defaults; its `seconds` are not read. `what` says what is swept over.
/// Returns: MORULA_STATUS_OK, also when some lists could not be made, or the callback cancelled
/// after there was a line: morula_swept has the status of each list; NULL_POINTER; EMPTY (nothing
/// to sweep over); INVALID_ARGUMENT (a resolution, method, effort or deadline that is none, an
/// option); STRUCT_SIZE; TOO_LARGE; OUT_OF_MEMORY; INTERNAL; where there is no list at all, the
/// statuses of morula_solid_from_shape() and morula_cost_curve(), of the first list.
/// Ownership: the shape stays the caller's and may be freed at once; free *sweep with
/// morula_sweep_free(). *sweep is written only on success.
/// Threads: any thread; the shape is only read. But for seconds the same bytes come out for any
/// number of threads, as long as no deadline is met.
int32_t morula_sweep_from_shape(const struct morula_shape *shape,
                                const struct morula_solid_options *solid_options,
                                const struct morula_clump_options *options,
                                const struct morula_cost_options *cost,
                                const struct morula_sweep_options *what,
                                struct morula_sweep **sweep);

/// How many price lists a sweep has, those that could not be made among them.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_sweep_count(const struct morula_sweep *sweep, size_t *count);

/// Copies what each price list is of: the resolutions one after the other, in each the methods, of
/// each the deadlines.
///
/// Parameters: `lists` has room for `capacity` structs, one after the other, all of the size that
/// struct_size of the first says; that of the others is set.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written); STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_sweep_copy(const struct morula_sweep *sweep,
                          size_t capacity,
                          struct morula_swept *lists);

/// A price list of a sweep.
///
/// Parameters: `index` counts lists from 0, in the order of morula_sweep_copy().
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; where the list could not be made,
/// the status that morula_swept has, with its sentence: CANCELLED for one that was not begun.
/// Ownership: free *curve with morula_cost_free(); it lives on without the sweep. *curve is
/// written only on success.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_sweep_curve(const struct morula_sweep *sweep,
                           size_t index,
                           struct morula_cost **curve);

/// Takes a sweep back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_sweep_free(struct morula_sweep *sweep);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_mass_options_init(struct morula_mass_options *options,
                                 size_t size);

/// Weighs the spheres of a clump.
///
/// Parameters: `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK, also where only masses with an error of the inertia exist (ask
/// morula_body_masses()); NULL_POINTER; INVALID_ARGUMENT (an option; bounds of masses that leave no
/// choice; spheres far from the target); NOT_FINITE; STRUCT_SIZE; NOT_WANTED (the clump was made
/// without MORULA_WANT_MOMENTS, and the target is the solid); NO_MASSES (no masses have the centre
/// of the body); TOO_LARGE; CANCELLED; OUT_OF_MEMORY; INTERNAL.
/// Ownership: the clump stays the caller's and may be freed at once; free *body with
/// morula_body_free(). *body is written only on success.
/// Threads: any thread; the clump is only read. The same bytes come out for any number of
/// threads.
int32_t morula_body_from_clump(const struct morula_clump *clump,
                               const struct morula_mass_options *options,
                               struct morula_body **body);

/// Weighs spheres that were made elsewhere.
///
/// Parameters: `xyzr` holds `count` spheres of four numbers each, in the caller's unit and frame;
/// `solid` is their true shape in the same frame, or NULL for the union of the spheres; `options` may
/// be NULL for the defaults (of a solid, `target` says whose moments are taken).
/// Returns: as morula_body_from_clump(); EMPTY (no sphere); INVALID_ARGUMENT also for a radius that
/// is not above 0.
/// Ownership: inputs are copied; free *body with morula_body_free(). *body is written only on
/// success.
/// Threads: any thread; the solid is only read.
int32_t morula_body_from_spheres(const double *xyzr,
                                 size_t count,
                                 const struct morula_solid *solid,
                                 const struct morula_mass_options *options,
                                 struct morula_body **body);

/// The same body in another size, place, orientation and density: x becomes position + rotation
/// (scale x). Masses scale by scale^3, inertia by scale^5, both by the ratio of the densities;
/// nothing is solved again.
///
/// Parameters: `position` holds three numbers, or is NULL for 0, 0, 0; `quaternion` holds w, x, y,
/// z of any length but 0, or is NULL for no turn; `density` 0 leaves the body's.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (scale or density not above 0, a
/// quaternion of 0, a size beyond the numbers); NOT_FINITE; OUT_OF_MEMORY; INTERNAL.
/// Ownership: the body stays the caller's; free *placed with morula_body_free(). *placed is
/// written only on success.
/// Threads: any thread; the body is only read.
int32_t morula_body_transform(const struct morula_body *body,
                              double scale,
                              const double *position,
                              const double *quaternion,
                              double density,
                              struct morula_body **placed);

/// Weighs a clump and puts it in another size, place and orientation, as morula_body_from_clump()
/// and morula_body_transform() do. For many particles of one template weigh it once and use those.
///
/// Parameters: `masses` may be NULL for the defaults; its density is that of the particle; the rest as
/// morula_body_transform().
/// Returns: the statuses of morula_body_from_clump() and morula_body_transform().
/// Ownership: the clump stays the caller's; free *placed with morula_body_free(). *placed is
/// written only on success.
/// Threads: any thread; the clump is only read.
int32_t morula_clump_transform(const struct morula_clump *clump,
                               const struct morula_mass_options *masses,
                               double scale,
                               const double *position,
                               const double *quaternion,
                               struct morula_body **placed);

/// Rotations drawn evenly from all, for the orientations of many particles: the same for the same
/// seed, and the first ones the same for any count.
///
/// Parameters: `quaternions` has room for 4 * `count` numbers: w, x, y, z each, w >= 0.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; TOO_LARGE; OUT_OF_MEMORY.
/// Threads: any thread.
int32_t morula_random_orientations(uint64_t seed,
                                   size_t count,
                                   double *quaternions);

/// Takes a body back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_body_free(struct morula_body *body);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_contact_options_init(struct morula_contact_options *options,
                                    size_t size);

/// The time step that a weighed clump allows.
///
/// Parameters: `options` says what is known of its contacts; `timestep` is filled: set its
/// struct_size first. Units are the caller's, mass by those of the density.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INVALID_ARGUMENT (an option out of its
/// range, or figures beyond the numbers).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_timestep(const struct morula_body *body,
                             const struct morula_contact_options *options,
                             struct morula_timestep *timestep);

/// Weighs a clump and tells the time step that it allows, as morula_body_from_clump() and
/// morula_body_timestep() do.
///
/// Parameters: `masses` may be NULL for the defaults; `options` and `timestep` as
/// morula_body_timestep().
/// Returns: the statuses of morula_body_from_clump() and morula_body_timestep().
/// Threads: any thread; the clump is only read.
int32_t morula_clump_timestep(const struct morula_clump *clump,
                              const struct morula_mass_options *masses,
                              const struct morula_contact_options *options,
                              struct morula_timestep *timestep);

/// How many spheres a weighed clump has; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_sphere_count(const struct morula_body *body, size_t *count);

/// Copies the spheres, in their order.
///
/// Parameters: `frame` is one of MORULA_FRAME_*; `xyzr` has room for `capacity` spheres of four
/// numbers each: x, y, z and radius (in Fortran an array xyzr(4, n)).
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (the frame); BUFFER_TOO_SMALL (nothing
/// is written); OUT_OF_MEMORY.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_copy_spheres(const struct morula_body *body,
                                 int32_t frame,
                                 size_t capacity,
                                 double *xyzr);

/// Copies the spheres for a code that reads single precision: each lies within the one it stands
/// for, so that what was inside before is inside after.
///
/// Parameters: as morula_body_copy_spheres().
/// Returns: as morula_body_copy_spheres(); INVALID_ARGUMENT also for a sphere that single
/// precision cannot hold.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_copy_spheres_f32(const struct morula_body *body,
                                     int32_t frame,
                                     size_t capacity,
                                     float *xyzr);

/// Copies the mass of each sphere, in their order.
///
/// Parameters: `masses` has room for `capacity` numbers.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_copy_masses(const struct morula_body *body,
                                size_t capacity,
                                double *masses);

/// Copies the numbers of the spheres whose mass is m_min or m_max, ascending.
///
/// Parameters: `spheres` has room for `capacity` numbers, as many as morula_masses.binding says.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_copy_binding(const struct morula_body *body,
                                 size_t capacity,
                                 uint32_t *spheres);

/// Mass, centre, inertia and body frame of the whole: what a solver that takes them is given.
///
/// Parameters: `moments` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_moments(const struct morula_body *body, struct morula_moments *moments);

/// How far the masses of the spheres add up to the body.
///
/// Parameters: `masses` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_masses(const struct morula_body *body, struct morula_masses *masses);

/// The word for a MORULA_MASSES_* number ("relaxed").
///
/// Returns: static text, never NULL ("unknown" for other numbers); do not free it.
/// Threads: any thread at any time. Never fails.
const char *morula_masses_status_name(int32_t status);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_export_options_init(struct morula_export_options *options,
                                   size_t size);

/// Writes a weighed clump as the file or files that a DEM code reads. Each is written under another
/// name and renamed when all are whole; a device or a link stays what it is.
///
/// Parameters: `format` is one of MORULA_EXPORT_*; `options` may be NULL for the defaults; `path`
/// (UTF-8) names the file, for MORULA_EXPORT_MERCURY the folder.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (an option; a format that has no other
/// frame; spheres that single precision cannot hold); UNSUPPORTED (a clump of one sphere for LAMMPS; a build without file formats); IO (what
/// the system said, and nothing half-written); STRUCT_SIZE; TOO_LARGE; OUT_OF_MEMORY; INTERNAL.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_write(const struct morula_body *body,
                          int32_t format,
                          const struct morula_export_options *options,
                          const char *path);

/// Weighs a clump and writes it, as morula_body_from_clump() and morula_body_write() do.
///
/// Parameters: `masses` and `options` may be NULL for the defaults; the rest as morula_body_write().
/// Returns: the statuses of morula_body_from_clump() and morula_body_write().
/// Threads: any thread; the clump is only read.
int32_t morula_clump_write(const struct morula_clump *clump,
                           const struct morula_mass_options *masses,
                           int32_t format,
                           const struct morula_export_options *options,
                           const char *path);

/// Makes the same files in memory.
///
/// Parameters: as morula_body_write().
/// Returns: as morula_body_write(), but never IO.
/// Ownership: the body stays the caller's; free *files with morula_files_free(). *files is
/// written only on success.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_body_export(const struct morula_body *body,
                           int32_t format,
                           const struct morula_export_options *options,
                           struct morula_files **files);

/// How many files there are; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_files_count(const struct morula_files *files, size_t *count);

/// Copies what a file's name adds to the path, with its closing NUL: nothing for the file itself, an ending
/// (".in") for what stands beside it, a path below the folder for the files of a folder.
///
/// Parameters: `index` from 0; `text` has room for `capacity` bytes; `length` (may be NULL) becomes
/// the length without the NUL. With `text` NULL and `capacity` 0 only `length` is written.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is
/// written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_files_copy_name(const struct morula_files *files,
                               size_t index,
                               size_t capacity,
                               char *text,
                               size_t *length);

/// How many bytes a file has.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_files_size(const struct morula_files *files, size_t index, size_t *size);

/// Copies the bytes of a file; text has no closing NUL.
///
/// Parameters: `bytes` has room for `capacity`.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is
/// written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_files_copy_bytes(const struct morula_files *files,
                                size_t index,
                                size_t capacity,
                                uint8_t *bytes);

/// Takes the files back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_files_free(struct morula_files *files);

/// Makes ready for breaks a particle of spheres that were made elsewhere.
///
/// Parameters: `xyzr` holds the `count` spheres of its clump in the frame and unit of the shape, x,
/// y, z and radius each, or none: then fragments fill the solid, and nothing is known of time steps;
/// `threads` is the number of threads of this call, 0: all cores.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (threads, a radius); NOT_FINITE (a
/// sphere); TOO_LARGE (the count); MEMORY_LIMIT (of the solid's options); OUT_OF_MEMORY; INTERNAL.
/// Ownership: inputs stay the caller's and may be freed at once; free *parent with
/// morula_parent_free(). *parent is written only on success.
/// Threads: any thread; the solid is only read. The same bytes come out for any number of threads.
int32_t morula_parent_from_solid(const struct morula_solid *solid,
                                 const double *xyzr,
                                 size_t count,
                                 int32_t threads,
                                 struct morula_parent **parent);

/// Makes a particle with its clump ready for breaks.
///
/// Parameters: `clump` was made of `solid`; `threads` as morula_parent_from_solid().
/// Returns: as morula_parent_from_solid(); INVALID_ARGUMENT also for a clump of another solid.
/// Ownership: as morula_parent_from_solid().
/// Threads: any thread; solid and clump are only read.
int32_t morula_parent_from_clump(const struct morula_solid *solid,
                                 const struct morula_clump *clump,
                                 int32_t threads,
                                 struct morula_parent **parent);

/// Bytes that a parent holds beside its solid.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_parent_bytes(const struct morula_parent *parent, uint64_t *bytes);

/// Takes a parent back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_parent_free(struct morula_parent *parent);

/// Fills a body at rest at the origin, with mass, centre and inertia of 0, to be set by hand.
///
/// Parameters: `size` is sizeof *held.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_held_init(struct morula_held *held,
                         size_t size);

/// The body of a whole parent: mass, centre and inertia of its solid, in its place.
///
/// Parameters: `density` is mass per (unit of the world)^3; `scale` is what lengths of the shape are
/// multiplied by; `position` is where the centre is (NULL: where the shape has it, times the
/// scale); `quaternion` turns the body axes (those of morula_solid_moments()) into the world: w, x,
/// y, z of any length but 0 (NULL: the shape is not turned); `velocity` and `angular_velocity` hold
/// three numbers of the world (NULL: 0). `held` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INVALID_ARGUMENT (density or scale not
/// above 0, a quaternion of 0, a size beyond the numbers); NOT_FINITE (the density, or a number of
/// position, quaternion and velocities).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_parent_held(const struct morula_parent *parent,
                           double density,
                           double scale,
                           const double *position,
                           const double *quaternion,
                           const double *velocity,
                           const double *angular_velocity,
                           struct morula_held *held);

/// An empty cache of parents, the caller's own: nothing is global.
///
/// Parameters: `limit` is how many bytes the parents that it keeps may hold, with their solids; those
/// not used for longest go first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; OUT_OF_MEMORY.
/// Ownership: free *cache with morula_cache_free(). *cache is written only on success.
/// Threads: any thread.
int32_t morula_cache_new(uint64_t limit,
                         struct morula_cache **cache);

/// The parent of a shape with its spheres: the one that was made before of the same shape, grid and
/// spheres, else a new one, which stays in the cache when there is room. The parent, and all that
/// is made of it, does not depend on what the cache holds.
///
/// Parameters: `options` are those of its solid, NULL for the defaults; their threads, progress and
/// user are those of the call. `xyzr` and `count` as morula_parent_from_solid().
/// Returns: the statuses of morula_solid_from_shape() and morula_parent_from_solid().
/// Ownership: inputs stay the caller's and may be freed at once; free *parent with
/// morula_parent_free(): the cache keeps its own. *parent is written only on success.
/// Threads: may run at the same time as other functions on this handle but morula_cache_free().
int32_t morula_cache_parent(const struct morula_cache *cache,
                            const struct morula_shape *shape,
                            const struct morula_solid_options *options,
                            const double *xyzr,
                            size_t count,
                            struct morula_parent **parent);

/// What a cache has done, and what it holds.
///
/// Parameters: `counters` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: as morula_cache_parent().
int32_t morula_cache_counters(const struct morula_cache *cache,
                              struct morula_cache_counts *counters);

/// Lets all parents of a cache go; its counters of what was done stay.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: as morula_cache_parent().
int32_t morula_cache_clear(const struct morula_cache *cache);

/// Takes a cache back, not the parents that it gave. NULL is ignored; a handle must not be used
/// afterwards.
/// Threads: no other thread may use the handle.
void morula_cache_free(struct morula_cache *cache);

/// The body of fragment `index` (from 0) as the solver holds it now, for it to break again.
///
/// Parameters: `position`, `quaternion`, `velocity` and `angular_velocity` as
/// morula_parent_held(), the quaternion that of the fragment's body axes; NULL: as they were handed
/// over. `held` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INDEX_OUT_OF_RANGE; INVALID_ARGUMENT (a
/// quaternion of 0); NOT_FINITE (a number of position, quaternion and velocities).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_held(const struct morula_fragments *fragments,
                              size_t index,
                              const double *position,
                              const double *quaternion,
                              const double *velocity,
                              const double *angular_velocity,
                              struct morula_held *held);

/// Fills options with the defaults.
///
/// Parameters: `size` is sizeof *options.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE when no release had a struct of this size.
/// Threads: any thread.
int32_t morula_break_options_init(struct morula_break_options *options,
                                  size_t size);

/// Breaks a particle, or a fragment of an earlier break, in one call: cuts it, fills the pieces with
/// spheres, and hands mass, place and velocities over, so that mass, momentum and angular momentum
/// of fragments and dust are those of the held body.
///
/// No sphere crosses a cut, the surface, or a wall, and none of two fragments overlap; in the world
/// that holds to rounding. A fragment that breaks again is cut out of the first parent anew.
///
/// Parameters: `from` is NULL for the whole parent; else fragment `index` (from 0) of `from` breaks,
/// and `parent` is its parent or NULL; `held` is the body as the solver holds it; `options` may be
/// NULL for the defaults.
/// Returns: MORULA_STATUS_OK, also when the deadline passed: then the spheres are coarse;
/// NULL_POINTER; INVALID_ARGUMENT (an option, a plane; the held body; a fragment of another parent);
/// STRUCT_SIZE; NOT_FINITE (a point, a wall, the held body); INDEX_OUT_OF_RANGE; NO_SPHERES (no
/// piece holds one); ZERO_VOLUME; EMPTY (nothing is left); TOO_LARGE; MEMORY_LIMIT; CANCELLED;
/// UNSUPPORTED; OUT_OF_MEMORY; INTERNAL.
/// Ownership: all inputs stay the caller's and may be freed at once; free *fragments with
/// morula_fragments_free(). *fragments is written only on success.
/// Threads: any thread; parent and fragments are only read. The same bytes come out for any number
/// of threads.
int32_t morula_parent_break(const struct morula_parent *parent,
                            const struct morula_fragments *from,
                            size_t index,
                            const struct morula_held *held,
                            const struct morula_break_options *options,
                            struct morula_fragments **fragments);

/// Breaks all particles that break in one time step. Threads share them, one each; each break is,
/// byte for byte, what morula_parent_break() gives, and one that fails does not stop the others.
///
/// Parameters: `count` breaks; `parents` holds a handle each; `from` a handle or NULL each, with
/// `indices`, or both are NULL: whole parents break; `held` holds a struct each, one after another;
/// `options` too, of which the first one's threads, deadline, progress and user are those of the
/// call; NULL: the defaults. `fragments` has room for `count` handles, and `statuses`, which may be
/// NULL, for `count` statuses, in the same order.
/// Returns: MORULA_STATUS_OK; the statuses of morula_parent_break(), of the first break that
/// failed. Then, with `statuses`, both arrays are written all the same, with NULL for each break
/// that failed, and the log is told each failure; without, none is written. Arrays that cannot be
/// read fail as a whole.
/// Ownership: as morula_parent_break().
/// Threads: as morula_parent_break().
int32_t morula_parents_break(const struct morula_parent *const *parents,
                             const struct morula_fragments *const *from,
                             const size_t *indices,
                             const struct morula_held *held,
                             const struct morula_break_options *options,
                             size_t count,
                             struct morula_fragments **fragments,
                             int32_t *statuses);

/// Takes fragments back. NULL is ignored; a handle must not be used afterwards.
/// Threads: no other thread may use the handle.
void morula_fragments_free(struct morula_fragments *fragments);

/// Breaks a particle into the pieces of a label volume, as a fracture model of the host's gives them:
/// fills each with spheres and hands mass, place and velocities over, as morula_parent_break() does.
/// A label of several pieces, which share no face, makes a fragment of each; its cell is its label.
///
/// Parameters: `labels`, `dims`, `spacing` and `origin` as morula_shape_from_label(), in the frame and
/// unit of the particle's shape; 0 is background; `solid_options` is for the grids of the pieces, NULL:
/// the defaults; `xyzr` holds the `count` spheres of the particle's clump, x, y, z and radius each,
/// within the union of which those of the fragments stay, or none; `held` is the body as the solver
/// holds it; `options` may be NULL for the defaults: what they say of the cut is not read.
/// Returns: as morula_parent_break(); EMPTY (no label); the statuses of morula_shape_from_label() and
/// morula_solid_from_shape().
/// Ownership: inputs stay the caller's and may be freed at once; free *fragments with
/// morula_fragments_free(). *fragments is written only on success. Each fragment is the whole of a
/// parent of its own, which *fragments keeps: to break one again, `parent` is NULL.
/// Threads: any thread. The same bytes come out for any number of threads.
int32_t morula_fragments_from_labels(const uint32_t *labels,
                                     const size_t *dims,
                                     const double *spacing,
                                     const double *origin,
                                     const struct morula_solid_options *solid_options,
                                     const double *xyzr,
                                     size_t count,
                                     const struct morula_held *held,
                                     const struct morula_break_options *options,
                                     struct morula_fragments **fragments);

/// New spheres for a particle whose shape has changed without breaking: dented, worn, grown.
///
/// The old spheres are the start of the search, the map tells which of them each new one comes
/// from, and mass, momentum and angular momentum of the held body are kept.
///
/// Parameters: `xyzr` holds the `count` old spheres (there may be none) in the frame of the new
/// `solid`, x, y, z and radius each; `held` is the body as the solver holds it, in that frame;
/// `options` may be NULL for the defaults: half_spaces, if any, are what bounds the body (flats
/// pressed into it), kind is not read, and within_union is not heeded.
/// Returns: as morula_parent_break(). *fragments holds one fragment, or as many as the half-spaces
/// leave components.
/// Ownership: inputs stay the caller's and may be freed at once; free *fragments with
/// morula_fragments_free(). *fragments is written only on success.
/// Threads: any thread; the solid is only read. The same bytes come out for any number of threads.
int32_t morula_reclump_shape(const struct morula_solid *solid,
                             const double *xyzr,
                             size_t count,
                             const struct morula_held *held,
                             const struct morula_break_options *options,
                             struct morula_fragments **fragments);

/// How many fragments there are; at least 1.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_count(const struct morula_fragments *fragments, size_t *count);

/// How many pieces of dust there are: too small for a sphere or for the volume asked for.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_dust_count(const struct morula_fragments *fragments, size_t *count);

/// What a solver takes of fragment `index` (from 0), and its quality.
///
/// Parameters: `fragment` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INDEX_OUT_OF_RANGE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_get(const struct morula_fragments *fragments,
                             size_t index,
                             struct morula_fragment *fragment);

/// What piece `index` (from 0) of the dust takes over. Its stopped, sphere_count and what concerns
/// spheres say nothing.
///
/// Parameters: `dust` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE; INDEX_OUT_OF_RANGE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_dust(const struct morula_fragments *fragments,
                              size_t index,
                              struct morula_fragment *dust);

/// What the break has made of the whole.
///
/// Parameters: `totals` is filled: set its struct_size first.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; STRUCT_SIZE.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_totals(const struct morula_fragments *fragments,
                                struct morula_break_totals *totals);

/// Copies the spheres of fragment `index` (from 0), the largest first.
///
/// Parameters: `frame` is one of MORULA_FRAME_*: that of the shape, in its unit, or the fragment's
/// body frame or the world, in the unit of the world; `xyzr` has room for `capacity` spheres of four
/// numbers each: x, y, z and radius (in Fortran an array xyzr(4, n)).
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; INVALID_ARGUMENT (the frame);
/// BUFFER_TOO_SMALL (nothing is written); OUT_OF_MEMORY.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_copy_spheres(const struct morula_fragments *fragments,
                                      size_t index,
                                      int32_t frame,
                                      size_t capacity,
                                      double *xyzr);

/// Copies the masses of the spheres of fragment `index` (from 0), in their order. Where their status
/// is not MORULA_MASSES_EXACT they add up to the fragment's mass, but not to its inertia, which is
/// exact in morula_fragment.
///
/// Parameters: `masses` has room for `capacity` numbers.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; NOT_WANTED (no masses were wanted);
/// NO_MASSES (none were found: the notes tell why); BUFFER_TOO_SMALL (nothing is written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_copy_masses(const struct morula_fragments *fragments,
                                     size_t index,
                                     size_t capacity,
                                     double *masses);

/// Copies which spheres of what broke those of fragment `index` (from 0) come from, so that the
/// history of contacts can be carried over: for each sphere those of the parent's clump (or, where a
/// fragment broke, of its own) that it overlaps, the greatest common volume first.
///
/// Parameters: `starts` has room for sphere_count + 1 numbers: those of sphere i are the pairs
/// starts[i] up to starts[i + 1], the last excluded; `parents` (numbers of spheres, from 0) and
/// `shares` (common volume over the volume of the fragment's sphere) have room for `capacity`
/// pairs, of which there are map_count.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is
/// written).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_copy_map(const struct morula_fragments *fragments,
                                  size_t index,
                                  uint32_t *starts,
                                  size_t capacity,
                                  uint32_t *parents,
                                  double *shares);

/// Copies the half-spaces that bound fragment `index` (from 0) within the first parent's solid: nx,
/// ny, nz and offset each, in the frame of the shape.
///
/// Parameters: `half_spaces` has room for `capacity` of them, of which there are half_space_count.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is
/// written); OUT_OF_MEMORY.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_copy_half_spaces(const struct morula_fragments *fragments,
                                          size_t index,
                                          size_t capacity,
                                          double *half_spaces);

/// The surface of fragment `index` (from 0) as a shape of its own, in the frame of the shape.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INDEX_OUT_OF_RANGE; UNSUPPORTED (the parent is a mesh that
/// is open or crosses itself); the statuses of morula_shape_from_mesh().
/// Ownership: free *shape with morula_shape_free(). *shape is written only on success.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_shape(const struct morula_fragments *fragments,
                               size_t index,
                               struct morula_shape **shape);

/// Copies the spheres of fragment `index` (from 0) grown: inscribed spheres leave part of a fragment
/// empty, which makes a bed more porous at once; in steps of the host they grow to the radii of least
/// mismatch. The fragment itself keeps its spheres.
///
/// Parameters: `part` is how far, from 0 (as they are) to 1; `others` holds the `other_count` spheres
/// of siblings and neighbours, x, y, z and radius each, that the grown ones keep `gap` off at
/// least, as far as they do so now; `frame`, `capacity` and `xyzr` as
/// morula_fragments_copy_spheres(): others and gap are in that frame and its unit.
/// Returns: as morula_fragments_copy_spheres(); INVALID_ARGUMENT also for a part, gap or radius out
/// of its range; NOT_FINITE (a sphere of the others); TOO_LARGE (other_count).
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_grow(const struct morula_fragments *fragments,
                              size_t index,
                              double part,
                              const double *others,
                              size_t other_count,
                              double gap,
                              int32_t frame,
                              size_t capacity,
                              double *xyzr);

/// How many notes there are on a break: sentences that a user should know.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_fragments_note_count(const struct morula_fragments *fragments, size_t *count);

/// Copies note `index` (from 0) with its closing NUL.
///
/// Parameters, returns, threads: as morula_shape_copy_note().
int32_t morula_fragments_copy_note(const struct morula_fragments *fragments,
                                   size_t index,
                                   size_t capacity,
                                   char *text,
                                   size_t *length);

/// Writes a shape as bytes, for another rank or a restart file: little-endian, with a version and a
/// checksum. The same shape gives the same bytes.
///
/// Parameters: `bytes` takes `capacity` bytes, or is NULL with a capacity of 0 to learn the size
/// alone; *size is the number of bytes; `size` may be NULL when `bytes` is not.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; BUFFER_TOO_SMALL; OUT_OF_MEMORY; INTERNAL.
/// Threads: may run at the same time as other const functions on this handle.
int32_t morula_shape_serialize(const struct morula_shape *shape,
                               size_t capacity,
                               uint8_t *bytes,
                               size_t *size);

/// Makes the shape again, to the last bit: nothing is checked, welded or repaired anew.
///
/// Returns: MORULA_STATUS_OK; NULL_POINTER; FORMAT (bytes that are cut short, changed, of
/// something else or of no shape); UNSUPPORTED (another version); TOO_LARGE (the size);
/// OUT_OF_MEMORY; INTERNAL.
/// Ownership: the bytes are copied; free *shape with morula_shape_free(). *shape is written only
/// on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_shape_deserialize(const uint8_t *bytes,
                                 size_t size,
                                 struct morula_shape **shape);

/// Writes a clump as bytes, as morula_shape_serialize() does a shape. The counters of the calls
/// that made it are left out.
///
/// Parameters, returns, threads: as morula_shape_serialize().
int32_t morula_clump_serialize(const struct morula_clump *clump,
                               size_t capacity,
                               uint8_t *bytes,
                               size_t *size);

/// Makes the clump again, to the last bit; its counters are 0.
///
/// Returns: as morula_shape_deserialize().
/// Ownership: the bytes are copied; free *clump with morula_clump_free(). *clump is written only
/// on success.
/// Threads: any thread; calls are independent of each other.
int32_t morula_clump_deserialize(const uint8_t *bytes,
                                 size_t size,
                                 struct morula_clump **clump);

/// Writes fragment `index` (from 0) as bytes, as morula_shape_serialize() does a shape: which part of
/// its first parent it is, and its spheres; 20 spheres make about 1.5 KiB. What the solver holds of it
/// (morula_held) travels with the solver's own data.
///
/// Parameters, returns, threads: as morula_shape_serialize(); INDEX_OUT_OF_RANGE.
int32_t morula_fragments_serialize(const struct morula_fragments *fragments,
                                   size_t index,
                                   size_t capacity,
                                   uint8_t *bytes,
                                   size_t *size);

/// Makes a fragment again, beside a parent of the same shape and grid: fragment 0 of *fragments, which
/// can be read, grown and broken as the one that was written. Its spheres are the same to the last bit.
/// It has no masses of spheres and no map, its coverage, volume_share and step_factor are 0.
///
/// Parameters: `held` is the fragment as the solver holds it: what it takes over.
/// Returns: as morula_shape_deserialize(); INVALID_ARGUMENT (bytes of a fragment of another parent;
/// the held body); NOT_FINITE and STRUCT_SIZE (the held body).
/// Ownership: inputs are copied; free *fragments with morula_fragments_free(). *fragments is written
/// only on success.
/// Threads: any thread; the parent is only read.
int32_t morula_fragments_deserialize(const struct morula_parent *parent,
                                     const uint8_t *bytes,
                                     size_t size,
                                     const struct morula_held *held,
                                     struct morula_fragments **fragments);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MORULA_H */
