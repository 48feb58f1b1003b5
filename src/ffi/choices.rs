//! The numbers that name choices: struct numbers, options, reasons to stop.

/// morula_import_options, for morula_sizeof().
pub const MORULA_STRUCT_IMPORT_OPTIONS: i32 = 1;
/// morula_file_options, for morula_sizeof().
pub const MORULA_STRUCT_FILE_OPTIONS: i32 = 2;
/// morula_solid_options, for morula_sizeof().
pub const MORULA_STRUCT_SOLID_OPTIONS: i32 = 3;
/// morula_clump_options, for morula_sizeof().
pub const MORULA_STRUCT_CLUMP_OPTIONS: i32 = 4;
/// morula_report, for morula_sizeof().
pub const MORULA_STRUCT_REPORT: i32 = 5;
/// morula_moments, for morula_sizeof().
pub const MORULA_STRUCT_MOMENTS: i32 = 6;
/// morula_overlap, for morula_sizeof().
pub const MORULA_STRUCT_OVERLAP: i32 = 7;
/// morula_surface, for morula_sizeof().
pub const MORULA_STRUCT_SURFACE: i32 = 8;
/// morula_counters, for morula_sizeof().
pub const MORULA_STRUCT_COUNTERS: i32 = 9;
/// morula_mass_options, for morula_sizeof().
pub const MORULA_STRUCT_MASS_OPTIONS: i32 = 10;
/// morula_masses, for morula_sizeof().
pub const MORULA_STRUCT_MASSES: i32 = 11;
/// morula_contact_options, for morula_sizeof().
pub const MORULA_STRUCT_CONTACT_OPTIONS: i32 = 12;
/// morula_timestep, for morula_sizeof().
pub const MORULA_STRUCT_TIMESTEP: i32 = 13;
/// morula_export_options, for morula_sizeof().
pub const MORULA_STRUCT_EXPORT_OPTIONS: i32 = 14;
/// morula_break_options, for morula_sizeof().
pub const MORULA_STRUCT_BREAK_OPTIONS: i32 = 15;
/// morula_held, for morula_sizeof().
pub const MORULA_STRUCT_HELD: i32 = 16;
/// morula_fragment, for morula_sizeof().
pub const MORULA_STRUCT_FRAGMENT: i32 = 17;
/// morula_break_totals, for morula_sizeof().
pub const MORULA_STRUCT_BREAK_TOTALS: i32 = 18;
/// morula_cache_counts, for morula_sizeof().
pub const MORULA_STRUCT_CACHE_COUNTS: i32 = 19;
/// morula_cost_options, for morula_sizeof().
pub const MORULA_STRUCT_COST_OPTIONS: i32 = 20;
/// morula_cost_point, for morula_sizeof().
pub const MORULA_STRUCT_COST_POINT: i32 = 21;
/// morula_cost_bounds, for morula_sizeof().
pub const MORULA_STRUCT_COST_BOUNDS: i32 = 22;
/// morula_sweep_options, for morula_sizeof().
pub const MORULA_STRUCT_SWEEP_OPTIONS: i32 = 23;
/// morula_swept, for morula_sizeof().
pub const MORULA_STRUCT_SWEPT: i32 = 24;

/// Refuse a shape of several disconnected bodies, with the count (the default).
pub const MORULA_BODIES_REFUSE: i32 = 0;
/// Keep the body of greatest volume; the notes say what was dropped.
pub const MORULA_BODIES_LARGEST: i32 = 1;
/// Keep all bodies as one particle.
pub const MORULA_BODIES_ALL: i32 = 2;

/// Tell the format of a file by its content, then by its name (the default).
pub const MORULA_FORMAT_AUTO: i32 = 0;
/// STL, ascii or binary.
pub const MORULA_FORMAT_STL: i32 = 1;
/// Wavefront OBJ.
pub const MORULA_FORMAT_OBJ: i32 = 2;
/// PLY, ascii or binary.
pub const MORULA_FORMAT_PLY: i32 = 3;
/// OFF, COFF, NOFF.
pub const MORULA_FORMAT_OFF: i32 = 4;
/// NumPy array.
pub const MORULA_FORMAT_NPY: i32 = 5;
/// Multi-page TIFF.
pub const MORULA_FORMAT_TIFF: i32 = 6;
/// Raw voxels: the raw_ fields of the options describe them.
pub const MORULA_FORMAT_RAW: i32 = 7;

/// Voxel files: two values are a mask, more are grey values with Otsu's threshold (the default).
pub const MORULA_MEANING_AUTO: i32 = 0;
/// Voxel files: grey values, solid above Otsu's threshold.
pub const MORULA_MEANING_OTSU: i32 = 1;
/// Voxel files: grey values, solid above the option `threshold`.
pub const MORULA_MEANING_ABOVE: i32 = 2;
/// Voxel files: labels, of which the option `label` is taken.
pub const MORULA_MEANING_LABEL: i32 = 3;

/// Raw voxels of 8 bits, unsigned.
pub const MORULA_RAW_U8: i32 = 0;
/// Raw voxels of 16 bits, unsigned, little-endian.
pub const MORULA_RAW_U16: i32 = 1;
/// Raw voxels of 32 bits, floating point, little-endian.
pub const MORULA_RAW_F32: i32 = 2;

/// Silhouettes: cells of which some part may lie in the hull stay, so that the shape contains the
/// hull, and the body.
pub const MORULA_CARVE_TOUCHED: i32 = 0;
/// Silhouettes: cells whose centre lies in the hull stay, so that the volume is the hull's.
pub const MORULA_CARVE_CENTRES: i32 = 1;

/// `cells` along the longest edge of the bounding box (the default, 64).
pub const MORULA_RESOLUTION_CELLS_LONGEST: i32 = 0;
/// `cells` along the shortest edge of the bounding box.
pub const MORULA_RESOLUTION_CELLS_SHORTEST: i32 = 1;
/// `cells` along the diameter of the sphere of equal volume.
pub const MORULA_RESOLUTION_CELLS_DIAMETER: i32 = 2;
/// Cells of the edge length `cell_size`.
pub const MORULA_RESOLUTION_CELL_SIZE: i32 = 3;

/// MSS: local maxima of the distance transform, iterated.
pub const MORULA_METHOD_MSS: i32 = 0;
/// Least mismatch for the number of spheres (the default).
pub const MORULA_METHOD_BEST: i32 = 1;
/// Spheres through four points of the surface, fitted to it; the method finds its own number, which
/// `spheres` limits.
pub const MORULA_METHOD_SURFACE_FIT: i32 = 2;
/// Most coverage with no sphere beyond the surface.
pub const MORULA_METHOD_INSCRIBED: i32 = 3;
/// Largest inscribed spheres about a thinned skeleton by greedy set cover: none reaches beyond the
/// surface.
pub const MORULA_METHOD_COVER: i32 = 4;
/// Spheres of nearly one radius (within 5 %) that do not overlap and keep within the surface, as
/// large as their number allows, or as many as fit with at least min_radius: the grains of a body
/// that may break. They cover about half of its volume.
pub const MORULA_METHOD_PACKED: i32 = 5;
/// The greatest ball in what is left of the body, again and again.
pub const MORULA_METHOD_EUCLIDEAN: i32 = 10;
/// The greatest spheres that touch the surface from inside at its points (Ferellec, McDowell).
pub const MORULA_METHOD_FERELLEC_MCDOWELL: i32 = 11;
/// Spheres about the axis of a body of revolution.
pub const MORULA_METHOD_FAVIER: i32 = 12;
/// Spheres about the cells of the grid, those that cover most first (Garcia; Li, Xu and Meng).
pub const MORULA_METHOD_UNIFORM_GRID: i32 = 13;

/// MORULA_METHOD_BEST and MORULA_METHOD_INSCRIBED: milliseconds.
pub const MORULA_EFFORT_DRAFT: i32 = 0;
/// Of the same: about a tenth of a second for a hundred spheres (the default).
pub const MORULA_EFFORT_NORMAL: i32 = 1;
/// Of the same: seconds.
pub const MORULA_EFFORT_THOROUGH: i32 = 2;

/// Levels of detail that have nothing to do with each other: each is what a call of its own gives
/// (the default).
pub const MORULA_LEVELS_FREE: i32 = 0;
/// Each level starts from the one before where the method can (MORULA_METHOD_BEST without
/// symmetry), so that levels are alike; hardly quicker.
pub const MORULA_LEVELS_CHAINED: i32 = 1;
/// Each level holds all spheres of the one before, in the same order, and further ones after them:
/// MORULA_METHOD_BEST, MORULA_METHOD_COVER, MORULA_METHOD_EUCLIDEAN.
pub const MORULA_LEVELS_NESTED: i32 = 2;

/// Where more spheres stop paying: the line of a price list that lies farthest below the straight
/// one from first to last, on logarithmic axes of the cost of a step and of D (the default).
pub const MORULA_GOAL_KNEE: i32 = 0;
/// Fewest spheres.
pub const MORULA_GOAL_SPHERES: i32 = 1;
/// Least mismatch D.
pub const MORULA_GOAL_MISMATCH: i32 = 2;
/// Fewest seconds of the method.
pub const MORULA_GOAL_SECONDS: i32 = 3;
/// Cheapest step of the solver.
pub const MORULA_GOAL_STEP_COST: i32 = 4;
/// Cheapest simulated time.
pub const MORULA_GOAL_TIME_COST: i32 = 5;

/// MORULA_METHOD_BEST: no symmetry but by chance (the default).
pub const MORULA_SYMMETRY_NONE: i32 = 0;
/// MORULA_METHOD_BEST: the target's mirror planes through its centre of mass, and exchanges of axes.
pub const MORULA_SYMMETRY_AUTO: i32 = 1;
/// MORULA_METHOD_BEST: the mirror planes in symmetry_planes.
pub const MORULA_SYMMETRY_PLANES: i32 = 2;

/// MORULA_METHOD_COVER: thin to a medial surface (the default).
pub const MORULA_ENDS_SURFACE: i32 = 0;
/// MORULA_METHOD_COVER: thin to curves, for shapes about an axis.
pub const MORULA_ENDS_CURVE: i32 = 1;

/// MORULA_METHOD_COVER: candidates at the voxels of the skeleton (the default).
pub const MORULA_CANDIDATES_THINNED: i32 = 0;
/// MORULA_METHOD_COVER: candidates that touch the vertices of a mesh from within.
pub const MORULA_CANDIDATES_ANALYTIC: i32 = 1;

/// Spheres in the frame in which the shape was handed in (the default).
pub const MORULA_FRAME_INPUT: i32 = 0;
/// Spheres in the body frame: origin at the centre of mass, axes principal.
pub const MORULA_FRAME_BODY: i32 = 1;
/// Spheres of fragments where they stand in the world when the particle breaks.
pub const MORULA_FRAME_WORLD: i32 = 2;

/// Break along planes: each piece that they leave is a fragment.
pub const MORULA_CUT_PLANES: i32 = 0;
/// Keep what lies within all half-spaces; the rest is left out, and its mass goes to what is kept.
pub const MORULA_CUT_WITHIN: i32 = 1;
/// Break into the Voronoi cells of given points, or with weights their power cells.
pub const MORULA_CUT_POINTS: i32 = 2;
/// Break into the Voronoi cells of seeded points (the default).
pub const MORULA_CUT_SEEDED: i32 = 3;
/// Break into the Voronoi cells of seeded points that are the denser the nearer to an impact.
pub const MORULA_CUT_IMPACT: i32 = 4;

/// Want nothing but the spheres.
pub const MORULA_WANT_NOTHING: u32 = 0;
/// Want morula_clump_overlap(): D, coverage, union volume and moments.
pub const MORULA_WANT_OVERLAP: u32 = 1;
/// Want morula_clump_surface() and exposed areas: protrusion, distances, roughness.
pub const MORULA_WANT_SURFACE: u32 = 2;
/// Want morula_clump_moments(): mass, centre, inertia of the target (the default).
pub const MORULA_WANT_MOMENTS: u32 = 4;

/// The number of spheres asked for was reached.
pub const MORULA_STOPPED_SPHERES: i32 = 0;
/// The mismatch asked for was reached.
pub const MORULA_STOPPED_MISMATCH: i32 = 1;
/// Every further sphere would be smaller than the least radius.
pub const MORULA_STOPPED_RADIUS: i32 = 2;
/// The deadline passed.
pub const MORULA_STOPPED_DEADLINE: i32 = 3;
/// The progress callback cancelled; the clump holds the spheres found so far.
pub const MORULA_STOPPED_CANCELLED: i32 = 4;
/// The method finds no further sphere that brings the clump closer; the note says why.
pub const MORULA_STOPPED_EXHAUSTED: i32 = 5;
/// The coverage asked for was reached.
pub const MORULA_STOPPED_COVERAGE: i32 = 6;

/// Fewer spheres than were asked for (the bound); the note says why.
pub const MORULA_WARNING_FEWER_SPHERES: i32 = 1;
/// So far from the origin that places are rounded by this part of the size.
pub const MORULA_WARNING_FAR_AWAY: i32 = 2;
/// The surface is open or crosses itself: mass, centre and inertia may be off by this part.
pub const MORULA_WARNING_INEXACT_TARGET: i32 = 3;
/// So few cells of the grid lie across the mean thickness of the shape.
pub const MORULA_WARNING_THIN: i32 = 4;
/// The mismatch is known to this part of itself only.
pub const MORULA_WARNING_COARSE_OVERLAP: i32 = 5;
/// Greatest distances may be more by this part of the equivalent diameter.
pub const MORULA_WARNING_COARSE_DISTANCE: i32 = 6;

/// The mass, centre and inertia of the true shape, mesh or voxels (the default).
pub const MORULA_TARGET_SOLID: i32 = 0;
/// Those of the union of the spheres.
pub const MORULA_TARGET_UNION: i32 = 1;

/// Masses with the least spread from each sphere's share of the union's volume (the default).
pub const MORULA_OBJECTIVE_EVEN: i32 = 0;
/// Masses of which the least is greatest.
pub const MORULA_OBJECTIVE_MAX_MIN: i32 = 1;
/// Masses of which the last is greatest.
pub const MORULA_OBJECTIVE_MAX_LAST: i32 = 2;

/// Where no masses have the centre of the body: fail with NO_MASSES (the default).
pub const MORULA_INFEASIBLE_REFUSE: i32 = 0;
/// Where no masses have the centre of the body: keep their sum, with the least error of the rest.
pub const MORULA_INFEASIBLE_LEAST_ERROR: i32 = 1;

/// Masses that meet all ten equations: mass, centre and inertia.
pub const MORULA_MASSES_EXACT: i32 = 0;
/// Masses that meet mass and centre; the inertia has the least error that they allow.
pub const MORULA_MASSES_RELAXED: i32 = 1;
/// Masses that meet the mass alone; centre and inertia have the least error.
pub const MORULA_MASSES_MASS_ONLY: i32 = 2;
/// A fragment without masses of its spheres.
pub const MORULA_MASSES_NONE: i32 = 3;

/// MercuryDPM: a folder with Clump/Clump.txt and Inertia/Mass.txt, TOI.txt, PD.txt.
pub const MORULA_EXPORT_MERCURY: i32 = 0;
/// LAMMPS: a molecule template.
pub const MORULA_EXPORT_LAMMPS: i32 = 1;
/// LAMMPS: the infile of fix rigid/small.
pub const MORULA_EXPORT_LAMMPS_RIGID: i32 = 2;
/// LIGGGHTS: the spheres of fix particletemplate/multisphere, and that command beside it (.in).
pub const MORULA_EXPORT_LIGGGHTS: i32 = 3;
/// YADE: a Python module.
pub const MORULA_EXPORT_YADE: i32 = 4;
/// Chrono DEM-Engine: the spheres of LoadClumpType, with its numbers as comments.
pub const MORULA_EXPORT_DEME: i32 = 5;
/// MFiX: gsp_config.csv of glued-sphere particles.
pub const MORULA_EXPORT_MFIX: i32 = 6;
/// Kratos: .clu.
pub const MORULA_EXPORT_KRATOS: i32 = 7;
/// PFC: a command file that makes a clump template.
pub const MORULA_EXPORT_PFC: i32 = 8;
/// EDEM: a table of spheres, to be pasted.
pub const MORULA_EXPORT_EDEM: i32 = 9;
/// A table with the header x,y,z,r,mass.
pub const MORULA_EXPORT_CSV: i32 = 10;
/// The whole record as JSON.
pub const MORULA_EXPORT_JSON: i32 = 11;
/// VTK: points with radii and masses.
pub const MORULA_EXPORT_VTP: i32 = 12;
/// The surface of the spheres, PLY.
pub const MORULA_EXPORT_PLY: i32 = 13;
/// The surface of the spheres, STL.
pub const MORULA_EXPORT_STL: i32 = 14;

/// Coordinates and radii with all digits of double precision (the default).
pub const MORULA_PRECISION_F64: i32 = 0;
/// Coordinates and radii that single precision holds, each sphere within the one it stands for.
pub const MORULA_PRECISION_F32: i32 = 1;
