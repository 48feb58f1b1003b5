! Morula for Fortran: the shape of a particle as a clump of overlapping spheres.
!
! Compile this file with your own compiler (CMake: link morula::fortran). It has
! two layers. The first is one bind(c) interface for each function of morula.h,
! with the same names, and its structs as bind(c) types. The second are the types
! morula_shape_t, morula_solid_t, morula_clump_t, morula_body_t, morula_files_t,
! morula_cost_t, morula_parent_t, morula_cache_t and morula_fragments_t, which hold
! a handle:
!
!   type(morula_shape_t) :: shape
!   type(morula_clump_t) :: clump
!   call shape%create_from_file('stone.stl')
!   call clump%create(shape, clump_options=options)
!   call clump%copy_spheres(xyzr)          ! real(c_double) :: xyzr(4, n)
!   call clump%destroy()
!   call shape%destroy()
!
! A handle is destroyed by destroy, by the next create, and when a variable goes
! out of scope (but never for variables of a main program: call destroy there).
! Assignment of one such variable to another stops the program: it would
! free the handle twice. The optional last argument `status` of each procedure
! receives MORULA_STATUS_*; without it a failure prints its sentence and stops.
!
! Triangle indices are counted from 1 here, notes and plane tolerances too; in the
! first layer all counting is C's. What may be NULL in C is a type(c_ptr) there.
! C's unsigned integers are Fortran's signed ones of the same size.
module morula
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  private

  ! ---- constants of morula.h ----

  integer(c_int32_t), parameter, public :: MORULA_VERSION_MAJOR = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_VERSION_MINOR = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_VERSION_PATCH = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_OK = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_NULL_POINTER = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_INVALID_ARGUMENT = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_NOT_FINITE = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_INDEX_OUT_OF_RANGE = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_EMPTY = 5_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_ZERO_VOLUME = 6_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_OPEN_SURFACE = 7_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_SEVERAL_BODIES = 8_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_FORMAT = 9_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_UNSUPPORTED = 10_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_IO = 11_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_MEMORY_LIMIT = 12_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_OUT_OF_MEMORY = 13_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_BUFFER_TOO_SMALL = 14_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_CANCELLED = 15_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_STRUCT_SIZE = 16_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_TOO_LARGE = 17_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_NOT_WANTED = 18_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_NO_SPHERES = 19_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_INTERNAL = 20_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STATUS_NO_MASSES = 21_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_LOG_INFO = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_LOG_WARNING = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_IMPORT_OPTIONS = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_FILE_OPTIONS = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_SOLID_OPTIONS = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_CLUMP_OPTIONS = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_REPORT = 5_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_MOMENTS = 6_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_OVERLAP = 7_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_SURFACE = 8_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_COUNTERS = 9_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_MASS_OPTIONS = 10_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_MASSES = 11_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_CONTACT_OPTIONS = 12_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_TIMESTEP = 13_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_EXPORT_OPTIONS = 14_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_BREAK_OPTIONS = 15_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_HELD = 16_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_FRAGMENT = 17_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_BREAK_TOTALS = 18_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_CACHE_COUNTS = 19_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_COST_OPTIONS = 20_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_COST_POINT = 21_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_COST_BOUNDS = 22_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_SWEEP_OPTIONS = 23_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STRUCT_SWEPT = 24_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_BODIES_REFUSE = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_BODIES_LARGEST = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_BODIES_ALL = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FORMAT_AUTO = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FORMAT_STL = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FORMAT_OBJ = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FORMAT_PLY = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FORMAT_OFF = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FORMAT_NPY = 5_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FORMAT_TIFF = 6_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FORMAT_RAW = 7_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_MEANING_AUTO = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_MEANING_OTSU = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_MEANING_ABOVE = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_MEANING_LABEL = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RAW_U8 = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RAW_U16 = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RAW_F32 = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CARVE_TOUCHED = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CARVE_CENTRES = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RESOLUTION_CELLS_LONGEST = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RESOLUTION_CELLS_SHORTEST = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RESOLUTION_CELLS_DIAMETER = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RESOLUTION_CELL_SIZE = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_MSS = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_BEST = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_SURFACE_FIT = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_INSCRIBED = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_COVER = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_PACKED = 5_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_EUCLIDEAN = 10_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_FERELLEC_MCDOWELL = 11_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_FAVIER = 12_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_UNIFORM_GRID = 13_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EFFORT_DRAFT = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EFFORT_NORMAL = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EFFORT_THOROUGH = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_LEVELS_FREE = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_LEVELS_CHAINED = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_LEVELS_NESTED = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_GOAL_KNEE = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_GOAL_SPHERES = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_GOAL_MISMATCH = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_GOAL_SECONDS = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_GOAL_STEP_COST = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_GOAL_TIME_COST = 5_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_SYMMETRY_NONE = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_SYMMETRY_AUTO = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_SYMMETRY_PLANES = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_ENDS_SURFACE = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_ENDS_CURVE = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CANDIDATES_THINNED = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CANDIDATES_ANALYTIC = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FRAME_INPUT = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FRAME_BODY = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FRAME_WORLD = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CUT_PLANES = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CUT_WITHIN = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CUT_POINTS = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CUT_SEEDED = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_CUT_IMPACT = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WANT_NOTHING = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WANT_OVERLAP = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WANT_SURFACE = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WANT_MOMENTS = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STOPPED_SPHERES = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STOPPED_MISMATCH = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STOPPED_RADIUS = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STOPPED_DEADLINE = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STOPPED_CANCELLED = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STOPPED_EXHAUSTED = 5_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_STOPPED_COVERAGE = 6_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WARNING_FEWER_SPHERES = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WARNING_FAR_AWAY = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WARNING_INEXACT_TARGET = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WARNING_THIN = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WARNING_COARSE_OVERLAP = 5_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_WARNING_COARSE_DISTANCE = 6_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_TARGET_SOLID = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_TARGET_UNION = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_OBJECTIVE_EVEN = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_OBJECTIVE_MAX_MIN = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_OBJECTIVE_MAX_LAST = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_INFEASIBLE_REFUSE = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_INFEASIBLE_LEAST_ERROR = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_MASSES_EXACT = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_MASSES_RELAXED = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_MASSES_MASS_ONLY = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_MASSES_NONE = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_MERCURY = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_LAMMPS = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_LAMMPS_RIGID = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_LIGGGHTS = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_YADE = 4_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_DEME = 5_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_MFIX = 6_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_KRATOS = 7_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_PFC = 8_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_EDEM = 9_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_CSV = 10_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_JSON = 11_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_VTP = 12_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_PLY = 13_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_EXPORT_STL = 14_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_PRECISION_F64 = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_PRECISION_F32 = 1_c_int32_t

  ! ---- structs of morula.h; fill options with the _init functions ----

  type, bind(c), public :: morula_import_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: weld_tolerance = 0.0_c_double
    real(c_double) :: length_unit = 0.0_c_double
    integer(c_int64_t) :: memory_limit = 0_c_int64_t
    integer(c_int32_t) :: bodies = 0_c_int32_t
    integer(c_int32_t) :: index_base = 0_c_int32_t
    integer(c_int32_t) :: threads = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
  end type morula_import_options

  type, bind(c), public :: morula_report
    integer(c_size_t) :: struct_size = 0_c_size_t
    integer(c_int64_t) :: input_vertices = 0_c_int64_t
    integer(c_int64_t) :: input_faces = 0_c_int64_t
    integer(c_int64_t) :: vertices = 0_c_int64_t
    integer(c_int64_t) :: faces = 0_c_int64_t
    integer(c_int64_t) :: solid_cells = 0_c_int64_t
    integer(c_int64_t) :: components = 0_c_int64_t
    integer(c_int64_t) :: bodies = 0_c_int64_t
    integer(c_int64_t) :: bodies_dropped = 0_c_int64_t
    integer(c_int64_t) :: faces_turned = 0_c_int64_t
    integer(c_int64_t) :: boundary_edges = 0_c_int64_t
    integer(c_int64_t) :: nonmanifold_edges = 0_c_int64_t
    integer(c_int64_t) :: degenerate_faces = 0_c_int64_t
    integer(c_int64_t) :: duplicate_faces = 0_c_int64_t
    integer(c_int64_t) :: welded_vertices = 0_c_int64_t
    integer(c_int32_t) :: watertight = 0_c_int32_t
    integer(c_int32_t) :: oriented = 0_c_int32_t
    integer(c_int32_t) :: inverted = 0_c_int32_t
    integer(c_int32_t) :: touches_border = 0_c_int32_t
    real(c_double) :: volume = 0.0_c_double
    real(c_double) :: area = 0.0_c_double
    real(c_double) :: box_min(3) = 0.0_c_double
    real(c_double) :: box_max(3) = 0.0_c_double
    real(c_double) :: length_unit = 0.0_c_double
    real(c_double) :: threshold = 0.0_c_double
  end type morula_report

  type, bind(c), public :: morula_moments
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: volume = 0.0_c_double
    real(c_double) :: mass = 0.0_c_double
    real(c_double) :: centre(3) = 0.0_c_double
    real(c_double) :: inertia(6) = 0.0_c_double
    real(c_double) :: principal(3) = 0.0_c_double
    real(c_double) :: rotation(9) = 0.0_c_double
    real(c_double) :: quaternion(4) = 0.0_c_double
    real(c_double) :: relative_error = 0.0_c_double
  end type morula_moments

  type, bind(c), public :: morula_file_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    integer(c_int32_t) :: format = 0_c_int32_t
    integer(c_int32_t) :: meaning = 0_c_int32_t
    real(c_double) :: threshold = 0.0_c_double
    integer(c_int32_t) :: label = 0_c_int32_t
    integer(c_int32_t) :: npy_xyz = 0_c_int32_t
    real(c_double) :: spacing(3) = 0.0_c_double
    real(c_double) :: origin(3) = 0.0_c_double
    integer(c_int64_t) :: raw_dims(3) = 0_c_int64_t
    integer(c_int64_t) :: raw_skip = 0_c_int64_t
    integer(c_int32_t) :: raw_type = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
  end type morula_file_options

  type, bind(c), public :: morula_solid_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    integer(c_int32_t) :: resolution = 0_c_int32_t
    integer(c_int32_t) :: cells = 0_c_int32_t
    real(c_double) :: cell_size = 0.0_c_double
    integer(c_int64_t) :: memory_limit = 0_c_int64_t
    integer(c_int32_t) :: padding = 0_c_int32_t
    integer(c_int32_t) :: threads = 0_c_int32_t
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
  end type morula_solid_options

  type, bind(c), public :: morula_clump_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    integer(c_int64_t) :: spheres = 0_c_int64_t
    real(c_double) :: mismatch = 0.0_c_double
    real(c_double) :: min_radius = 0.0_c_double
    real(c_double) :: min_distance = 0.0_c_double
    real(c_double) :: radius_offset = 0.0_c_double
    real(c_double) :: deadline_seconds = 0.0_c_double
    integer(c_int64_t) :: seed = 0_c_int64_t
    integer(c_int32_t) :: method = 0_c_int32_t
    integer(c_int32_t) :: confine = 0_c_int32_t
    integer(c_int32_t) :: threads = 0_c_int32_t
    integer(c_int32_t) :: frame = 0_c_int32_t
    integer(c_int32_t) :: wants = 0_c_int32_t
    integer(c_int32_t) :: quality_columns = 0_c_int32_t
    type(c_ptr) :: plane_tolerances = c_null_ptr
    integer(c_size_t) :: plane_tolerance_count = 0_c_size_t
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
    integer(c_int32_t) :: effort = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
    real(c_double) :: coverage = 0.0_c_double
    integer(c_int32_t) :: ends = 0_c_int32_t
    integer(c_int32_t) :: candidates = 0_c_int32_t
    integer(c_int32_t) :: thinning_cells = 0_c_int32_t
    integer(c_int32_t) :: cells_inside = 0_c_int32_t
    real(c_double) :: tolerance = 0.0_c_double
    real(c_double) :: overlap = 0.0_c_double
    real(c_double) :: overshoot_weight = 0.0_c_double
    real(c_double) :: max_protrusion = 0.0_c_double
    real(c_double) :: max_radius = 0.0_c_double
    real(c_double) :: smoothness = 0.0_c_double
    integer(c_int32_t) :: connected = 0_c_int32_t
    integer(c_int32_t) :: equal_volume = 0_c_int32_t
    integer(c_int32_t) :: symmetry = 0_c_int32_t
    integer(c_int32_t) :: symmetry_plane_count = 0_c_int32_t
    type(c_ptr) :: half_spaces = c_null_ptr
    integer(c_size_t) :: half_space_count = 0_c_size_t
    type(c_ptr) :: symmetry_planes = c_null_ptr
  end type morula_clump_options

  type, bind(c), public :: morula_overlap
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: mismatch = 0.0_c_double
    real(c_double) :: error_bound = 0.0_c_double
    real(c_double) :: eta = 0.0_c_double
    real(c_double) :: iou = 0.0_c_double
    real(c_double) :: coverage = 0.0_c_double
    real(c_double) :: overshoot = 0.0_c_double
    real(c_double) :: target_volume = 0.0_c_double
    real(c_double) :: union_volume = 0.0_c_double
    real(c_double) :: volume_error = 0.0_c_double
    real(c_double) :: centroid_error = 0.0_c_double
    real(c_double) :: moment_errors(3) = 0.0_c_double
  end type morula_overlap

  type, bind(c), public :: morula_surface
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: protrusion = 0.0_c_double
    real(c_double) :: rms_distance = 0.0_c_double
    real(c_double) :: hausdorff = 0.0_c_double
    real(c_double) :: distance_bound = 0.0_c_double
    real(c_double) :: roughness = 0.0_c_double
    integer(c_int64_t) :: samples = 0_c_int64_t
    integer(c_int32_t) :: never_exposed = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
    real(c_double) :: asymmetry = 0.0_c_double
    integer(c_int64_t) :: symmetry_planes = 0_c_int64_t
  end type morula_surface

  type, bind(c), public :: morula_counters
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: seconds_read = 0.0_c_double
    real(c_double) :: seconds_check = 0.0_c_double
    real(c_double) :: seconds_solid = 0.0_c_double
    real(c_double) :: seconds_generate = 0.0_c_double
    real(c_double) :: seconds_measure = 0.0_c_double
    real(c_double) :: seconds_moments = 0.0_c_double
    integer(c_int64_t) :: cells = 0_c_int64_t
    integer(c_int64_t) :: peak_bytes = 0_c_int64_t
    integer(c_int64_t) :: transforms = 0_c_int64_t
    integer(c_int64_t) :: exact_distances = 0_c_int64_t
    integer(c_int64_t) :: maxima = 0_c_int64_t
    integer(c_int64_t) :: spheres_tried = 0_c_int64_t
    integer(c_int64_t) :: columns = 0_c_int64_t
  end type morula_counters

  type, bind(c), public :: morula_mass_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: density = 0.0_c_double
    real(c_double) :: m_min = 0.0_c_double
    real(c_double) :: m_max = 0.0_c_double
    integer(c_int32_t) :: target = 0_c_int32_t
    integer(c_int32_t) :: objective = 0_c_int32_t
    integer(c_int32_t) :: infeasible = 0_c_int32_t
    integer(c_int32_t) :: threads = 0_c_int32_t
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
  end type morula_mass_options

  type, bind(c), public :: morula_masses
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: mass = 0.0_c_double
    real(c_double) :: m_min = 0.0_c_double
    real(c_double) :: largest_m_min = 0.0_c_double
    real(c_double) :: mass_residual = 0.0_c_double
    real(c_double) :: centre_residual = 0.0_c_double
    real(c_double) :: inertia_residual = 0.0_c_double
    real(c_double) :: spread = 0.0_c_double
    real(c_double) :: union_inertia_error = 0.0_c_double
    integer(c_int32_t) :: status = 0_c_int32_t
    integer(c_int32_t) :: binding = 0_c_int32_t
  end type morula_masses

  type, bind(c), public :: morula_contact_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: stiffness = 0.0_c_double
    real(c_double) :: young = 0.0_c_double
    real(c_double) :: poisson = 0.0_c_double
    real(c_double) :: speed = 0.0_c_double
    integer(c_int32_t) :: contacts = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
  end type morula_contact_options

  type, bind(c), public :: morula_timestep
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: clump = 0.0_c_double
    real(c_double) :: effective_mass = 0.0_c_double
    real(c_double) :: stiffness = 0.0_c_double
    real(c_double) :: rayleigh = 0.0_c_double
    real(c_double) :: overlap = 0.0_c_double
    integer(c_int32_t) :: sphere = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
    real(c_double) :: together = 0.0_c_double
  end type morula_timestep

  type, bind(c), public :: morula_export_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: length = 0.0_c_double
    real(c_double) :: mass = 0.0_c_double
    integer(c_int32_t) :: placed = 0_c_int32_t
    integer(c_int32_t) :: facets = 0_c_int32_t
    type(c_ptr) :: name = c_null_ptr
    integer(c_int32_t) :: precision = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
  end type morula_export_options

  type, bind(c), public :: morula_break_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    type(c_ptr) :: half_spaces = c_null_ptr
    integer(c_size_t) :: half_space_count = 0_c_size_t
    type(c_ptr) :: points = c_null_ptr
    type(c_ptr) :: weights = c_null_ptr
    integer(c_size_t) :: point_count = 0_c_size_t
    type(c_ptr) :: walls = c_null_ptr
    integer(c_size_t) :: wall_count = 0_c_size_t
    integer(c_int64_t) :: cells = 0_c_int64_t
    real(c_double) :: point(3) = 0.0_c_double
    real(c_double) :: direction(3) = 0.0_c_double
    integer(c_int64_t) :: seed = 0_c_int64_t
    real(c_double) :: least_volume = 0.0_c_double
    integer(c_int64_t) :: spheres = 0_c_int64_t
    real(c_double) :: min_radius = 0.0_c_double
    real(c_double) :: gap = 0.0_c_double
    real(c_double) :: m_min = 0.0_c_double
    real(c_double) :: deadline_seconds = 0.0_c_double
    integer(c_int32_t) :: kind = 0_c_int32_t
    integer(c_int32_t) :: within_union = 0_c_int32_t
    integer(c_int32_t) :: precision = 0_c_int32_t
    integer(c_int32_t) :: quality = 0_c_int32_t
    integer(c_int32_t) :: masses = 0_c_int32_t
    integer(c_int32_t) :: objective = 0_c_int32_t
    integer(c_int32_t) :: infeasible = 0_c_int32_t
    integer(c_int32_t) :: threads = 0_c_int32_t
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
  end type morula_break_options

  type, bind(c), public :: morula_held
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: mass = 0.0_c_double
    real(c_double) :: centre(3) = 0.0_c_double
    real(c_double) :: inertia(6) = 0.0_c_double
    real(c_double) :: scale = 0.0_c_double
    real(c_double) :: position(3) = 0.0_c_double
    real(c_double) :: quaternion(4) = 0.0_c_double
    real(c_double) :: velocity(3) = 0.0_c_double
    real(c_double) :: angular_velocity(3) = 0.0_c_double
  end type morula_held

  type, bind(c), public :: morula_fragment
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: mass = 0.0_c_double
    real(c_double) :: centre(3) = 0.0_c_double
    real(c_double) :: inertia(6) = 0.0_c_double
    real(c_double) :: principal(3) = 0.0_c_double
    real(c_double) :: rotation(9) = 0.0_c_double
    real(c_double) :: position(3) = 0.0_c_double
    real(c_double) :: quaternion(4) = 0.0_c_double
    real(c_double) :: velocity(3) = 0.0_c_double
    real(c_double) :: angular_velocity(3) = 0.0_c_double
    real(c_double) :: volume = 0.0_c_double
    real(c_double) :: coverage = 0.0_c_double
    real(c_double) :: volume_share = 0.0_c_double
    real(c_double) :: step_factor = 0.0_c_double
    real(c_double) :: inertia_residual = 0.0_c_double
    integer(c_int64_t) :: sphere_count = 0_c_int64_t
    integer(c_int64_t) :: map_count = 0_c_int64_t
    integer(c_int64_t) :: half_space_count = 0_c_int64_t
    integer(c_int64_t) :: cell = 0_c_int64_t
    integer(c_int32_t) :: stopped = 0_c_int32_t
    integer(c_int32_t) :: masses = 0_c_int32_t
  end type morula_fragment

  type, bind(c), public :: morula_break_totals
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: energy = 0.0_c_double
    real(c_double) :: inertia_error = 0.0_c_double
    real(c_double) :: shift(3) = 0.0_c_double
  end type morula_break_totals

  type, bind(c), public :: morula_cache_counts
    integer(c_size_t) :: struct_size = 0_c_size_t
    integer(c_int64_t) :: hits = 0_c_int64_t
    integer(c_int64_t) :: misses = 0_c_int64_t
    integer(c_int64_t) :: evicted = 0_c_int64_t
    integer(c_int64_t) :: parents = 0_c_int64_t
    integer(c_int64_t) :: bytes = 0_c_int64_t
  end type morula_cache_counts

  type, bind(c), public :: morula_cost_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    type(c_ptr) :: counts = c_null_ptr
    integer(c_size_t) :: count = 0_c_size_t
    integer(c_int64_t) :: most = 0_c_int64_t
    real(c_double) :: seconds = 0.0_c_double
    real(c_double) :: density = 0.0_c_double
    type(c_ptr) :: contact = c_null_ptr
    real(c_double) :: step(3) = 0.0_c_double
    real(c_double) :: lists(2) = 0.0_c_double
    real(c_double) :: rebuild = 0.0_c_double
    integer(c_int32_t) :: levels = 0_c_int32_t
    integer(c_int32_t) :: surface = 0_c_int32_t
    integer(c_int32_t) :: masses = 0_c_int32_t
    integer(c_int32_t) :: quality_columns = 0_c_int32_t
  end type morula_cost_options

  type, bind(c), public :: morula_cost_point
    integer(c_size_t) :: struct_size = 0_c_size_t
    integer(c_int64_t) :: asked = 0_c_int64_t
    integer(c_int64_t) :: spheres = 0_c_int64_t
    real(c_double) :: mismatch = 0.0_c_double
    real(c_double) :: coverage = 0.0_c_double
    real(c_double) :: overshoot = 0.0_c_double
    real(c_double) :: surface = 0.0_c_double
    real(c_double) :: hausdorff = 0.0_c_double
    real(c_double) :: protrusion = 0.0_c_double
    real(c_double) :: roughness = 0.0_c_double
    real(c_double) :: union_inertia = 0.0_c_double
    real(c_double) :: inertia = 0.0_c_double
    real(c_double) :: seconds = 0.0_c_double
    real(c_double) :: seconds_so_far = 0.0_c_double
    real(c_double) :: time_step = 0.0_c_double
    real(c_double) :: rayleigh = 0.0_c_double
    real(c_double) :: step_factor = 0.0_c_double
    real(c_double) :: least_radius = 0.0_c_double
    real(c_double) :: step_cost = 0.0_c_double
    real(c_double) :: time_cost = 0.0_c_double
    integer(c_int32_t) :: masses = 0_c_int32_t
    integer(c_int32_t) :: stopped = 0_c_int32_t
  end type morula_cost_point

  type, bind(c), public :: morula_cost_bounds
    integer(c_size_t) :: struct_size = 0_c_size_t
    integer(c_int64_t) :: spheres = 0_c_int64_t
    real(c_double) :: mismatch = 0.0_c_double
    real(c_double) :: coverage = 0.0_c_double
    real(c_double) :: surface = 0.0_c_double
    real(c_double) :: seconds = 0.0_c_double
    real(c_double) :: step_cost = 0.0_c_double
    real(c_double) :: time_cost = 0.0_c_double
    integer(c_int32_t) :: goal = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
  end type morula_cost_bounds

  type, bind(c), public :: morula_sweep_options
    integer(c_size_t) :: struct_size = 0_c_size_t
    type(c_ptr) :: resolutions = c_null_ptr
    integer(c_size_t) :: resolution_count = 0_c_size_t
    type(c_ptr) :: methods = c_null_ptr
    type(c_ptr) :: efforts = c_null_ptr
    integer(c_size_t) :: method_count = 0_c_size_t
    type(c_ptr) :: deadlines = c_null_ptr
    integer(c_size_t) :: deadline_count = 0_c_size_t
  end type morula_sweep_options

  type, bind(c), public :: morula_swept
    integer(c_size_t) :: struct_size = 0_c_size_t
    real(c_double) :: resolution = 0.0_c_double
    integer(c_int64_t) :: cells(3) = 0_c_int64_t
    real(c_double) :: solid_seconds = 0.0_c_double
    real(c_double) :: deadline = 0.0_c_double
    integer(c_int64_t) :: lines = 0_c_int64_t
    integer(c_int32_t) :: method = 0_c_int32_t
    integer(c_int32_t) :: effort = 0_c_int32_t
    integer(c_int32_t) :: status = 0_c_int32_t
    integer(c_int32_t) :: cut = 0_c_int32_t
  end type morula_swept

  ! ---- functions of morula.h ----

  public :: morula_version, morula_version_string, morula_status_name, morula_last_error_message
  public :: morula_sizeof, morula_set_log, morula_import_options_init, morula_shape_from_mesh
  public :: morula_shape_serialize, morula_shape_deserialize
  public :: morula_clump_serialize, morula_clump_deserialize
  public :: morula_shape_free, morula_shape_report, morula_shape_note_count
  public :: morula_shape_copy_note, morula_shape_moments, morula_file_options_init
  public :: morula_shape_from_file, morula_shape_from_bytes, morula_shape_from_mask
  public :: morula_shape_from_grey_u8, morula_shape_from_grey_u16, morula_shape_from_grey_f32
  public :: morula_shape_from_silhouettes
  public :: morula_shape_from_label, morula_labels_count, morula_labels_copy
  public :: morula_labels_from_file, morula_labels_from_bytes
  public :: morula_primitive_name, morula_primitive_parameter_count
  public :: morula_primitive_copy_parameter, morula_shape_from_primitive
  public :: morula_solid_options_init, morula_solid_from_shape, morula_solid_free
  public :: morula_solid_grid, morula_solid_distance, morula_solid_note_count
  public :: morula_shape_counters, morula_solid_counters
  public :: morula_solid_copy_note, morula_solid_moments, morula_clump_options_init
  public :: morula_clump_from_shape, morula_clump_from_solid, morula_clump_free
  public :: morula_clumps_from_solid, morula_clumps_from_shapes, morula_clumps_from_labels
  public :: morula_mass_options_init, morula_body_from_clump, morula_body_from_spheres
  public :: morula_body_transform, morula_random_orientations, morula_body_free
  public :: morula_contact_options_init, morula_body_timestep, morula_body_sphere_count
  public :: morula_body_copy_spheres, morula_body_copy_spheres_f32, morula_body_copy_masses
  public :: morula_body_copy_binding, morula_body_moments, morula_body_masses
  public :: morula_masses_status_name, morula_export_options_init, morula_body_write
  public :: morula_clump_transform, morula_clump_timestep
  public :: morula_clump_write, morula_body_export, morula_files_count, morula_files_copy_name
  public :: morula_files_size, morula_files_copy_bytes, morula_files_free
  public :: morula_clump_sphere_count, morula_clump_copy_spheres, morula_clump_stopped
  public :: morula_stopped_name, morula_clump_copy_note, morula_clump_moments
  public :: morula_clump_warning_count, morula_clump_copy_warnings, morula_clump_copy_warning
  public :: morula_warning_name
  public :: morula_clump_overlap, morula_clump_surface, morula_clump_copy_exposed_areas
  public :: morula_clump_copy_plane_contacts, morula_clump_counters
  public :: morula_fragments_serialize, morula_fragments_deserialize
  public :: morula_cost_options_init, morula_cost_bounds_init, morula_cost_curve
  public :: morula_cost_count, morula_cost_cut, morula_cost_copy, morula_cost_clump
  public :: morula_cost_choose, morula_cost_free
  public :: morula_sweep_options_init, morula_sweep_from_shape, morula_sweep_count
  public :: morula_sweep_copy, morula_sweep_curve, morula_sweep_free
  public :: morula_cache_new, morula_cache_parent, morula_cache_counters, morula_cache_clear
  public :: morula_cache_free
  public :: morula_parent_from_solid, morula_parent_from_clump, morula_parent_bytes
  public :: morula_parent_free, morula_held_init, morula_parent_held, morula_fragments_held
  public :: morula_break_options_init, morula_parent_break, morula_parents_break
  public :: morula_fragments_from_labels
  public :: morula_reclump_shape, morula_fragments_free, morula_fragments_count
  public :: morula_fragments_dust_count, morula_fragments_get, morula_fragments_dust
  public :: morula_fragments_totals, morula_fragments_copy_spheres, morula_fragments_copy_masses
  public :: morula_fragments_copy_map, morula_fragments_copy_half_spaces, morula_fragments_shape
  public :: morula_fragments_grow, morula_fragments_note_count, morula_fragments_copy_note

  interface
    function morula_version() bind(c) result(r)
      import
      integer(c_int32_t) :: r
    end function morula_version
    function morula_version_string() bind(c) result(r)
      import
      type(c_ptr) :: r
    end function morula_version_string
    function morula_status_name(status) bind(c) result(r)
      import
      integer(c_int32_t), value :: status
      type(c_ptr) :: r
    end function morula_status_name
    function morula_last_error_message() bind(c) result(r)
      import
      type(c_ptr) :: r
    end function morula_last_error_message
    function morula_sizeof(which) bind(c) result(r)
      import
      integer(c_int32_t), value :: which
      integer(c_size_t) :: r
    end function morula_sizeof
    function morula_set_log(sink, user) bind(c) result(r)
      import
      type(c_funptr), value :: sink
      type(c_ptr), value :: user
      integer(c_int32_t) :: r
    end function morula_set_log
    function morula_import_options_init(options, size) bind(c) result(r)
      import
      type(morula_import_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_import_options_init
    function morula_shape_from_mesh(vertices, vertex_count, triangles, triangle_count, options, &
        shape) bind(c) result(r)
      import
      real(c_double), intent(in) :: vertices(*)
      integer(c_size_t), value :: vertex_count
      integer(c_int32_t), intent(in) :: triangles(*)
      integer(c_size_t), value :: triangle_count
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_mesh
    subroutine morula_shape_free(shape) bind(c)
      import
      type(c_ptr), value :: shape
    end subroutine morula_shape_free
    function morula_shape_report(shape, report) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      type(morula_report), intent(inout) :: report
      integer(c_int32_t) :: r
    end function morula_shape_report
    function morula_shape_note_count(shape, count) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_shape_note_count
    function morula_shape_copy_note(shape, index, capacity, text, length) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: text
      type(c_ptr), value :: length
      integer(c_int32_t) :: r
    end function morula_shape_copy_note
    function morula_shape_moments(shape, density, moments) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      real(c_double), value :: density
      type(morula_moments), intent(inout) :: moments
      integer(c_int32_t) :: r
    end function morula_shape_moments
    function morula_shape_counters(shape, counters) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      type(morula_counters), intent(inout) :: counters
      integer(c_int32_t) :: r
    end function morula_shape_counters
    function morula_file_options_init(options, size) bind(c) result(r)
      import
      type(morula_file_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_file_options_init
    function morula_shape_from_file(path, import_options, file_options, shape) bind(c) result(r)
      import
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), value :: import_options
      type(c_ptr), value :: file_options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_file
    function morula_shape_from_bytes(bytes, count, name, import_options, file_options, shape) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: count
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), value :: import_options
      type(c_ptr), value :: file_options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_bytes
    function morula_labels_from_file(path, import_options, file_options, capacity, ids, cells, &
        boxes, touches_border, count) bind(c) result(r)
      import
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), value :: import_options
      type(c_ptr), value :: file_options
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: ids
      type(c_ptr), value :: cells
      type(c_ptr), value :: boxes
      type(c_ptr), value :: touches_border
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_labels_from_file
    function morula_labels_from_bytes(bytes, byte_count, name, import_options, file_options, &
        capacity, ids, cells, boxes, touches_border, count) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: byte_count
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), value :: import_options
      type(c_ptr), value :: file_options
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: ids
      type(c_ptr), value :: cells
      type(c_ptr), value :: boxes
      type(c_ptr), value :: touches_border
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_labels_from_bytes
    function morula_shape_from_mask(mask, dims, spacing, origin, options, shape) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: mask(*)
      integer(c_size_t), intent(in) :: dims(*)
      type(c_ptr), value :: spacing
      type(c_ptr), value :: origin
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_mask
    function morula_shape_from_silhouettes(count, masks, widths, heights, cameras, cells, carve, &
        options, shape) bind(c) result(r)
      import
      integer(c_size_t), value :: count
      integer(c_int8_t), intent(in) :: masks(*)
      integer(c_size_t), intent(in) :: widths(*)
      integer(c_size_t), intent(in) :: heights(*)
      real(c_double), intent(in) :: cameras(*)
      integer(c_size_t), value :: cells
      integer(c_int32_t), value :: carve
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_silhouettes
    function morula_shape_from_grey_u8(values, dims, spacing, origin, threshold, options, &
        shape) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: values(*)
      integer(c_size_t), intent(in) :: dims(*)
      type(c_ptr), value :: spacing
      type(c_ptr), value :: origin
      type(c_ptr), value :: threshold
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_grey_u8
    function morula_shape_from_grey_u16(values, dims, spacing, origin, threshold, options, &
        shape) bind(c) result(r)
      import
      integer(c_int16_t), intent(in) :: values(*)
      integer(c_size_t), intent(in) :: dims(*)
      type(c_ptr), value :: spacing
      type(c_ptr), value :: origin
      type(c_ptr), value :: threshold
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_grey_u16
    function morula_shape_from_grey_f32(values, dims, spacing, origin, threshold, options, &
        shape) bind(c) result(r)
      import
      real(c_float), intent(in) :: values(*)
      integer(c_size_t), intent(in) :: dims(*)
      type(c_ptr), value :: spacing
      type(c_ptr), value :: origin
      type(c_ptr), value :: threshold
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_grey_f32
    function morula_shape_from_label(labels, dims, spacing, origin, label, options, &
        shape) bind(c) result(r)
      import
      integer(c_int32_t), intent(in) :: labels(*)
      integer(c_size_t), intent(in) :: dims(*)
      type(c_ptr), value :: spacing
      type(c_ptr), value :: origin
      integer(c_int32_t), value :: label
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_label
    function morula_labels_count(labels, dims, count) bind(c) result(r)
      import
      integer(c_int32_t), intent(in) :: labels(*)
      integer(c_size_t), intent(in) :: dims(*)
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_labels_count
    function morula_labels_copy(labels, dims, capacity, ids, cells, boxes, &
        touches_border) bind(c) result(r)
      import
      integer(c_int32_t), intent(in) :: labels(*)
      integer(c_size_t), intent(in) :: dims(*)
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: ids
      type(c_ptr), value :: cells
      type(c_ptr), value :: boxes
      type(c_ptr), value :: touches_border
      integer(c_int32_t) :: r
    end function morula_labels_copy
    function morula_primitive_name(index) bind(c) result(r)
      import
      integer(c_size_t), value :: index
      type(c_ptr) :: r
    end function morula_primitive_name
    function morula_primitive_parameter_count(name, count) bind(c) result(r)
      import
      character(kind=c_char), intent(in) :: name(*)
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_primitive_parameter_count
    function morula_primitive_copy_parameter(name, index, capacity, key, length, &
        value) bind(c) result(r)
      import
      character(kind=c_char), intent(in) :: name(*)
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: key
      type(c_ptr), value :: length
      type(c_ptr), value :: value
      integer(c_int32_t) :: r
    end function morula_primitive_copy_parameter
    function morula_shape_from_primitive(name, keys, values, count, segments, seed, options, &
        shape) bind(c) result(r)
      import
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), intent(in) :: keys(*)
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_int32_t), value :: segments
      integer(c_int64_t), value :: seed
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_primitive
    function morula_solid_options_init(options, size) bind(c) result(r)
      import
      type(morula_solid_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_solid_options_init
    function morula_solid_from_shape(shape, options, solid) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: solid
      integer(c_int32_t) :: r
    end function morula_solid_from_shape
    subroutine morula_solid_free(solid) bind(c)
      import
      type(c_ptr), value :: solid
    end subroutine morula_solid_free
    function morula_solid_grid(solid, dims, spacing, origin) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      type(c_ptr), value :: dims
      type(c_ptr), value :: spacing
      type(c_ptr), value :: origin
      integer(c_int32_t) :: r
    end function morula_solid_grid
    function morula_solid_distance(solid, count, points, distances) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: points(*)
      real(c_double), intent(inout) :: distances(*)
      integer(c_int32_t) :: r
    end function morula_solid_distance
    function morula_solid_note_count(solid, count) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_solid_note_count
    function morula_solid_copy_note(solid, index, capacity, text, length) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: text
      type(c_ptr), value :: length
      integer(c_int32_t) :: r
    end function morula_solid_copy_note
    function morula_solid_moments(solid, density, moments) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      real(c_double), value :: density
      type(morula_moments), intent(inout) :: moments
      integer(c_int32_t) :: r
    end function morula_solid_moments
    function morula_solid_counters(solid, counters) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      type(morula_counters), intent(inout) :: counters
      integer(c_int32_t) :: r
    end function morula_solid_counters
    function morula_clump_options_init(options, size) bind(c) result(r)
      import
      type(morula_clump_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_clump_options_init
    function morula_clump_from_shape(shape, solid_options, options, clump) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      type(c_ptr), value :: solid_options
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: clump
      integer(c_int32_t) :: r
    end function morula_clump_from_shape
    function morula_clump_from_solid(solid, options, clump) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: clump
      integer(c_int32_t) :: r
    end function morula_clump_from_solid
    function morula_clumps_from_solid(solid, options, spheres, count, clumps) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      type(c_ptr), value :: options
      integer(c_int64_t), intent(in) :: spheres(*)
      integer(c_size_t), value :: count
      type(c_ptr), intent(inout) :: clumps(*)
      integer(c_int32_t) :: r
    end function morula_clumps_from_solid
    function morula_clumps_from_shapes(shapes, count, solid_options, options, clumps, &
        statuses) bind(c) result(r)
      import
      type(c_ptr), intent(in) :: shapes(*)
      integer(c_size_t), value :: count
      type(c_ptr), value :: solid_options
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: clumps(*)
      type(c_ptr), value :: statuses
      integer(c_int32_t) :: r
    end function morula_clumps_from_shapes
    function morula_clumps_from_labels(labels, dims, spacing, origin, wanted, count, &
        import_options, solid_options, options, clumps, statuses) bind(c) result(r)
      import
      integer(c_int32_t), intent(in) :: labels(*)
      integer(c_size_t), intent(in) :: dims(*)
      type(c_ptr), value :: spacing
      type(c_ptr), value :: origin
      integer(c_int32_t), intent(in) :: wanted(*)
      integer(c_size_t), value :: count
      type(c_ptr), value :: import_options
      type(c_ptr), value :: solid_options
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: clumps(*)
      type(c_ptr), value :: statuses
      integer(c_int32_t) :: r
    end function morula_clumps_from_labels
    subroutine morula_clump_free(clump) bind(c)
      import
      type(c_ptr), value :: clump
    end subroutine morula_clump_free
    function morula_clump_sphere_count(clump, count) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_clump_sphere_count
    function morula_clump_copy_spheres(clump, capacity, xyzr) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), value :: capacity
      real(c_double), intent(inout) :: xyzr(4, *)
      integer(c_int32_t) :: r
    end function morula_clump_copy_spheres
    function morula_clump_stopped(clump, stopped) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_int32_t), intent(inout) :: stopped
      integer(c_int32_t) :: r
    end function morula_clump_stopped
    function morula_stopped_name(stopped) bind(c) result(r)
      import
      integer(c_int32_t), value :: stopped
      type(c_ptr) :: r
    end function morula_stopped_name
    function morula_clump_copy_note(clump, capacity, text, length) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: text
      type(c_ptr), value :: length
      integer(c_int32_t) :: r
    end function morula_clump_copy_note
    function morula_clump_warning_count(clump, count) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_clump_warning_count
    function morula_clump_copy_warnings(clump, capacity, codes, figures, bounds) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), value :: capacity
      integer(c_int32_t), intent(inout) :: codes(*)
      real(c_double), intent(inout) :: figures(*)
      real(c_double), intent(inout) :: bounds(*)
      integer(c_int32_t) :: r
    end function morula_clump_copy_warnings
    function morula_clump_copy_warning(clump, index, capacity, text, length) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: text
      type(c_ptr), value :: length
      integer(c_int32_t) :: r
    end function morula_clump_copy_warning
    function morula_warning_name(warning) bind(c) result(r)
      import
      integer(c_int32_t), value :: warning
      type(c_ptr) :: r
    end function morula_warning_name
    function morula_clump_moments(clump, density, moments) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      real(c_double), value :: density
      type(morula_moments), intent(inout) :: moments
      integer(c_int32_t) :: r
    end function morula_clump_moments
    function morula_clump_overlap(clump, overlap) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      type(morula_overlap), intent(inout) :: overlap
      integer(c_int32_t) :: r
    end function morula_clump_overlap
    function morula_clump_surface(clump, surface) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      type(morula_surface), intent(inout) :: surface
      integer(c_int32_t) :: r
    end function morula_clump_surface
    function morula_clump_copy_exposed_areas(clump, capacity, areas) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), value :: capacity
      real(c_double), intent(inout) :: areas(*)
      integer(c_int32_t) :: r
    end function morula_clump_copy_exposed_areas
    function morula_clump_copy_plane_contacts(clump, capacity, counts) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), value :: capacity
      integer(c_int32_t), intent(inout) :: counts(*)
      integer(c_int32_t) :: r
    end function morula_clump_copy_plane_contacts
    function morula_clump_counters(clump, counters) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      type(morula_counters), intent(inout) :: counters
      integer(c_int32_t) :: r
    end function morula_clump_counters
    function morula_mass_options_init(options, size) bind(c) result(r)
      import
      type(morula_mass_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_mass_options_init
    function morula_body_from_clump(clump, options, body) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: body
      integer(c_int32_t) :: r
    end function morula_body_from_clump
    function morula_body_from_spheres(xyzr, count, solid, options, body) bind(c) result(r)
      import
      real(c_double), intent(in) :: xyzr(4, *)
      integer(c_size_t), value :: count
      type(c_ptr), value :: solid
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: body
      integer(c_int32_t) :: r
    end function morula_body_from_spheres
    function morula_body_transform(body, scale, position, quaternion, density, &
        placed) bind(c) result(r)
      import
      type(c_ptr), value :: body
      real(c_double), value :: scale
      type(c_ptr), value :: position
      type(c_ptr), value :: quaternion
      real(c_double), value :: density
      type(c_ptr), intent(inout) :: placed
      integer(c_int32_t) :: r
    end function morula_body_transform
    function morula_clump_transform(clump, masses, scale, position, quaternion, &
        placed) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      type(c_ptr), value :: masses
      real(c_double), value :: scale
      type(c_ptr), value :: position
      type(c_ptr), value :: quaternion
      type(c_ptr), intent(inout) :: placed
      integer(c_int32_t) :: r
    end function morula_clump_transform
    function morula_random_orientations(seed, count, quaternions) bind(c) result(r)
      import
      integer(c_int64_t), value :: seed
      integer(c_size_t), value :: count
      real(c_double), intent(inout) :: quaternions(4, *)
      integer(c_int32_t) :: r
    end function morula_random_orientations
    subroutine morula_body_free(body) bind(c)
      import
      type(c_ptr), value :: body
    end subroutine morula_body_free
    function morula_contact_options_init(options, size) bind(c) result(r)
      import
      type(morula_contact_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_contact_options_init
    function morula_body_timestep(body, options, timestep) bind(c) result(r)
      import
      type(c_ptr), value :: body
      type(morula_contact_options), intent(in) :: options
      type(morula_timestep), intent(inout) :: timestep
      integer(c_int32_t) :: r
    end function morula_body_timestep
    function morula_clump_timestep(clump, masses, options, timestep) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      type(c_ptr), value :: masses
      type(morula_contact_options), intent(in) :: options
      type(morula_timestep), intent(inout) :: timestep
      integer(c_int32_t) :: r
    end function morula_clump_timestep
    function morula_body_sphere_count(body, count) bind(c) result(r)
      import
      type(c_ptr), value :: body
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_body_sphere_count
    function morula_body_copy_spheres(body, frame, capacity, xyzr) bind(c) result(r)
      import
      type(c_ptr), value :: body
      integer(c_int32_t), value :: frame
      integer(c_size_t), value :: capacity
      real(c_double), intent(inout) :: xyzr(4, *)
      integer(c_int32_t) :: r
    end function morula_body_copy_spheres
    function morula_body_copy_spheres_f32(body, frame, capacity, xyzr) bind(c) result(r)
      import
      type(c_ptr), value :: body
      integer(c_int32_t), value :: frame
      integer(c_size_t), value :: capacity
      real(c_float), intent(inout) :: xyzr(4, *)
      integer(c_int32_t) :: r
    end function morula_body_copy_spheres_f32
    function morula_body_copy_masses(body, capacity, masses) bind(c) result(r)
      import
      type(c_ptr), value :: body
      integer(c_size_t), value :: capacity
      real(c_double), intent(inout) :: masses(*)
      integer(c_int32_t) :: r
    end function morula_body_copy_masses
    function morula_body_copy_binding(body, capacity, spheres) bind(c) result(r)
      import
      type(c_ptr), value :: body
      integer(c_size_t), value :: capacity
      integer(c_int32_t), intent(inout) :: spheres(*)
      integer(c_int32_t) :: r
    end function morula_body_copy_binding
    function morula_body_moments(body, moments) bind(c) result(r)
      import
      type(c_ptr), value :: body
      type(morula_moments), intent(inout) :: moments
      integer(c_int32_t) :: r
    end function morula_body_moments
    function morula_body_masses(body, masses) bind(c) result(r)
      import
      type(c_ptr), value :: body
      type(morula_masses), intent(inout) :: masses
      integer(c_int32_t) :: r
    end function morula_body_masses
    function morula_masses_status_name(status) bind(c) result(r)
      import
      integer(c_int32_t), value :: status
      type(c_ptr) :: r
    end function morula_masses_status_name
    function morula_export_options_init(options, size) bind(c) result(r)
      import
      type(morula_export_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_export_options_init
    function morula_body_write(body, format, options, path) bind(c) result(r)
      import
      type(c_ptr), value :: body
      integer(c_int32_t), value :: format
      type(c_ptr), value :: options
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: r
    end function morula_body_write
    function morula_clump_write(clump, masses, format, options, path) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      type(c_ptr), value :: masses
      integer(c_int32_t), value :: format
      type(c_ptr), value :: options
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: r
    end function morula_clump_write
    function morula_body_export(body, format, options, files) bind(c) result(r)
      import
      type(c_ptr), value :: body
      integer(c_int32_t), value :: format
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: files
      integer(c_int32_t) :: r
    end function morula_body_export
    function morula_files_count(files, count) bind(c) result(r)
      import
      type(c_ptr), value :: files
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_files_count
    function morula_files_copy_name(files, index, capacity, text, length) bind(c) result(r)
      import
      type(c_ptr), value :: files
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: text
      type(c_ptr), value :: length
      integer(c_int32_t) :: r
    end function morula_files_copy_name
    function morula_files_size(files, index, size) bind(c) result(r)
      import
      type(c_ptr), value :: files
      integer(c_size_t), value :: index
      integer(c_size_t), intent(inout) :: size
      integer(c_int32_t) :: r
    end function morula_files_size
    function morula_files_copy_bytes(files, index, capacity, bytes) bind(c) result(r)
      import
      type(c_ptr), value :: files
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      integer(c_int8_t), intent(inout) :: bytes(*)
      integer(c_int32_t) :: r
    end function morula_files_copy_bytes
    function morula_shape_serialize(shape, capacity, bytes, size) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: bytes
      type(c_ptr), value :: size
      integer(c_int32_t) :: r
    end function morula_shape_serialize
    function morula_shape_deserialize(bytes, size, shape) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: size
      type(c_ptr), intent(out) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_deserialize
    function morula_clump_serialize(clump, capacity, bytes, size) bind(c) result(r)
      import
      type(c_ptr), value :: clump
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: bytes
      type(c_ptr), value :: size
      integer(c_int32_t) :: r
    end function morula_clump_serialize
    function morula_clump_deserialize(bytes, size, clump) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: size
      type(c_ptr), intent(out) :: clump
      integer(c_int32_t) :: r
    end function morula_clump_deserialize
    function morula_fragments_serialize(fragments, index, capacity, bytes, size) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: bytes
      type(c_ptr), value :: size
      integer(c_int32_t) :: r
    end function morula_fragments_serialize
    function morula_fragments_deserialize(parent, bytes, size, held, fragments) bind(c) result(r)
      import
      type(c_ptr), value :: parent
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: size
      type(morula_held), intent(in) :: held
      type(c_ptr), intent(inout) :: fragments
      integer(c_int32_t) :: r
    end function morula_fragments_deserialize
    subroutine morula_files_free(files) bind(c)
      import
      type(c_ptr), value :: files
    end subroutine morula_files_free
    function morula_parent_from_solid(solid, xyzr, count, threads, parent) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      real(c_double), intent(in) :: xyzr(4, *)
      integer(c_size_t), value :: count
      integer(c_int32_t), value :: threads
      type(c_ptr), intent(inout) :: parent
      integer(c_int32_t) :: r
    end function morula_parent_from_solid
    function morula_parent_from_clump(solid, clump, threads, parent) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      type(c_ptr), value :: clump
      integer(c_int32_t), value :: threads
      type(c_ptr), intent(inout) :: parent
      integer(c_int32_t) :: r
    end function morula_parent_from_clump
    function morula_parent_bytes(parent, bytes) bind(c) result(r)
      import
      type(c_ptr), value :: parent
      integer(c_int64_t), intent(inout) :: bytes
      integer(c_int32_t) :: r
    end function morula_parent_bytes
    subroutine morula_parent_free(parent) bind(c)
      import
      type(c_ptr), value :: parent
    end subroutine morula_parent_free
    function morula_cache_new(limit, cache) bind(c) result(r)
      import
      integer(c_int64_t), value :: limit
      type(c_ptr), intent(inout) :: cache
      integer(c_int32_t) :: r
    end function morula_cache_new
    function morula_cache_parent(cache, shape, options, xyzr, count, parent) bind(c) result(r)
      import
      type(c_ptr), value :: cache
      type(c_ptr), value :: shape
      type(c_ptr), value :: options
      real(c_double), intent(in) :: xyzr(4, *)
      integer(c_size_t), value :: count
      type(c_ptr), intent(inout) :: parent
      integer(c_int32_t) :: r
    end function morula_cache_parent
    function morula_cache_counters(cache, counters) bind(c) result(r)
      import
      type(c_ptr), value :: cache
      type(morula_cache_counts), intent(inout) :: counters
      integer(c_int32_t) :: r
    end function morula_cache_counters
    function morula_cache_clear(cache) bind(c) result(r)
      import
      type(c_ptr), value :: cache
      integer(c_int32_t) :: r
    end function morula_cache_clear
    subroutine morula_cache_free(cache) bind(c)
      import
      type(c_ptr), value :: cache
    end subroutine morula_cache_free
    function morula_held_init(held, size) bind(c) result(r)
      import
      type(morula_held), intent(out) :: held
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_held_init
    function morula_parent_held(parent, density, scale, position, quaternion, velocity, &
        angular_velocity, held) bind(c) result(r)
      import
      type(c_ptr), value :: parent
      real(c_double), value :: density
      real(c_double), value :: scale
      type(c_ptr), value :: position
      type(c_ptr), value :: quaternion
      type(c_ptr), value :: velocity
      type(c_ptr), value :: angular_velocity
      type(morula_held), intent(inout) :: held
      integer(c_int32_t) :: r
    end function morula_parent_held
    function morula_fragments_held(fragments, index, position, quaternion, velocity, &
        angular_velocity, held) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      type(c_ptr), value :: position
      type(c_ptr), value :: quaternion
      type(c_ptr), value :: velocity
      type(c_ptr), value :: angular_velocity
      type(morula_held), intent(inout) :: held
      integer(c_int32_t) :: r
    end function morula_fragments_held
    function morula_cost_options_init(options, size) bind(c) result(r)
      import
      type(morula_cost_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_cost_options_init
    function morula_cost_bounds_init(bounds, size) bind(c) result(r)
      import
      type(morula_cost_bounds), intent(out) :: bounds
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_cost_bounds_init
    function morula_cost_curve(solid, options, cost, curve) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      type(c_ptr), value :: options
      type(c_ptr), value :: cost
      type(c_ptr), intent(inout) :: curve
      integer(c_int32_t) :: r
    end function morula_cost_curve
    function morula_cost_count(curve, count) bind(c) result(r)
      import
      type(c_ptr), value :: curve
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_cost_count
    function morula_cost_cut(curve, cut) bind(c) result(r)
      import
      type(c_ptr), value :: curve
      integer(c_int32_t), intent(inout) :: cut
      integer(c_int32_t) :: r
    end function morula_cost_cut
    function morula_cost_copy(curve, capacity, points) bind(c) result(r)
      import
      type(c_ptr), value :: curve
      integer(c_size_t), value :: capacity
      type(morula_cost_point), intent(inout) :: points(*)
      integer(c_int32_t) :: r
    end function morula_cost_copy
    function morula_cost_clump(curve, index, clump) bind(c) result(r)
      import
      type(c_ptr), value :: curve
      integer(c_size_t), value :: index
      type(c_ptr), intent(inout) :: clump
      integer(c_int32_t) :: r
    end function morula_cost_clump
    function morula_cost_choose(curve, bounds, index, capacity, text, length) bind(c) result(r)
      import
      type(c_ptr), value :: curve
      type(c_ptr), value :: bounds
      integer(c_size_t), intent(inout) :: index
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: text
      type(c_ptr), value :: length
      integer(c_int32_t) :: r
    end function morula_cost_choose
    subroutine morula_cost_free(curve) bind(c)
      import
      type(c_ptr), value :: curve
    end subroutine morula_cost_free
    function morula_sweep_options_init(options, size) bind(c) result(r)
      import
      type(morula_sweep_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_sweep_options_init
    function morula_sweep_from_shape(shape, solid_options, options, cost, what, sweep) bind(c) &
        result(r)
      import
      type(c_ptr), value :: shape
      type(c_ptr), value :: solid_options
      type(c_ptr), value :: options
      type(c_ptr), value :: cost
      type(morula_sweep_options), intent(in) :: what
      type(c_ptr), intent(inout) :: sweep
      integer(c_int32_t) :: r
    end function morula_sweep_from_shape
    function morula_sweep_count(sweep, count) bind(c) result(r)
      import
      type(c_ptr), value :: sweep
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_sweep_count
    function morula_sweep_copy(sweep, capacity, lists) bind(c) result(r)
      import
      type(c_ptr), value :: sweep
      integer(c_size_t), value :: capacity
      type(morula_swept), intent(inout) :: lists(*)
      integer(c_int32_t) :: r
    end function morula_sweep_copy
    function morula_sweep_curve(sweep, index, curve) bind(c) result(r)
      import
      type(c_ptr), value :: sweep
      integer(c_size_t), value :: index
      type(c_ptr), intent(inout) :: curve
      integer(c_int32_t) :: r
    end function morula_sweep_curve
    subroutine morula_sweep_free(sweep) bind(c)
      import
      type(c_ptr), value :: sweep
    end subroutine morula_sweep_free
    function morula_break_options_init(options, size) bind(c) result(r)
      import
      type(morula_break_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_break_options_init
    function morula_parent_break(parent, from, index, held, options, fragments) bind(c) result(r)
      import
      type(c_ptr), value :: parent
      type(c_ptr), value :: from
      integer(c_size_t), value :: index
      type(morula_held), intent(in) :: held
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: fragments
      integer(c_int32_t) :: r
    end function morula_parent_break
    function morula_parents_break(parents, from, indices, held, options, count, fragments, &
        statuses) bind(c) result(r)
      import
      type(c_ptr), intent(in) :: parents(*)
      type(c_ptr), value :: from
      type(c_ptr), value :: indices
      type(morula_held), intent(in) :: held(*)
      type(c_ptr), value :: options
      integer(c_size_t), value :: count
      type(c_ptr), intent(inout) :: fragments(*)
      type(c_ptr), value :: statuses
      integer(c_int32_t) :: r
    end function morula_parents_break
    function morula_fragments_from_labels(labels, dims, spacing, origin, solid_options, xyzr, &
        count, held, options, fragments) bind(c) result(r)
      import
      integer(c_int32_t), intent(in) :: labels(*)
      integer(c_size_t), intent(in) :: dims(*)
      type(c_ptr), value :: spacing
      type(c_ptr), value :: origin
      type(c_ptr), value :: solid_options
      real(c_double), intent(in) :: xyzr(4, *)
      integer(c_size_t), value :: count
      type(morula_held), intent(in) :: held
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: fragments
      integer(c_int32_t) :: r
    end function morula_fragments_from_labels
    function morula_reclump_shape(solid, xyzr, count, held, options, fragments) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      real(c_double), intent(in) :: xyzr(4, *)
      integer(c_size_t), value :: count
      type(morula_held), intent(in) :: held
      type(c_ptr), value :: options
      type(c_ptr), intent(inout) :: fragments
      integer(c_int32_t) :: r
    end function morula_reclump_shape
    subroutine morula_fragments_free(fragments) bind(c)
      import
      type(c_ptr), value :: fragments
    end subroutine morula_fragments_free
    function morula_fragments_count(fragments, count) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_fragments_count
    function morula_fragments_dust_count(fragments, count) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_fragments_dust_count
    function morula_fragments_get(fragments, index, fragment) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      type(morula_fragment), intent(inout) :: fragment
      integer(c_int32_t) :: r
    end function morula_fragments_get
    function morula_fragments_dust(fragments, index, dust) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      type(morula_fragment), intent(inout) :: dust
      integer(c_int32_t) :: r
    end function morula_fragments_dust
    function morula_fragments_totals(fragments, totals) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      type(morula_break_totals), intent(inout) :: totals
      integer(c_int32_t) :: r
    end function morula_fragments_totals
    function morula_fragments_copy_spheres(fragments, index, frame, capacity, &
        xyzr) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      integer(c_int32_t), value :: frame
      integer(c_size_t), value :: capacity
      real(c_double), intent(inout) :: xyzr(4, *)
      integer(c_int32_t) :: r
    end function morula_fragments_copy_spheres
    function morula_fragments_copy_masses(fragments, index, capacity, masses) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      real(c_double), intent(inout) :: masses(*)
      integer(c_int32_t) :: r
    end function morula_fragments_copy_masses
    function morula_fragments_copy_map(fragments, index, starts, capacity, parents, &
        shares) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      integer(c_int32_t), intent(inout) :: starts(*)
      integer(c_size_t), value :: capacity
      integer(c_int32_t), intent(inout) :: parents(*)
      real(c_double), intent(inout) :: shares(*)
      integer(c_int32_t) :: r
    end function morula_fragments_copy_map
    function morula_fragments_copy_half_spaces(fragments, index, capacity, &
        half_spaces) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      real(c_double), intent(inout) :: half_spaces(4, *)
      integer(c_int32_t) :: r
    end function morula_fragments_copy_half_spaces
    function morula_fragments_shape(fragments, index, shape) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      type(c_ptr), intent(inout) :: shape
      integer(c_int32_t) :: r
    end function morula_fragments_shape
    function morula_fragments_grow(fragments, index, part, others, other_count, gap, frame, &
        capacity, xyzr) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      real(c_double), value :: part
      real(c_double), intent(in) :: others(4, *)
      integer(c_size_t), value :: other_count
      real(c_double), value :: gap
      integer(c_int32_t), value :: frame
      integer(c_size_t), value :: capacity
      real(c_double), intent(inout) :: xyzr(4, *)
      integer(c_int32_t) :: r
    end function morula_fragments_grow
    function morula_fragments_note_count(fragments, count) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), intent(inout) :: count
      integer(c_int32_t) :: r
    end function morula_fragments_note_count
    function morula_fragments_copy_note(fragments, index, capacity, text, &
        length) bind(c) result(r)
      import
      type(c_ptr), value :: fragments
      integer(c_size_t), value :: index
      integer(c_size_t), value :: capacity
      type(c_ptr), value :: text
      type(c_ptr), value :: length
      integer(c_int32_t) :: r
    end function morula_fragments_copy_note
  end interface

  interface
    pure function c_strlen(text) bind(c, name='strlen') result(length)
      import
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function c_strlen
  end interface

  ! ---- types that hold a handle ----

  !> A checked shape: something with an inside.
  type, public :: morula_shape_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    !> From vertices(3, n) and triangles(3, m), whose vertices are counted from 1.
    procedure :: create_from_mesh => shape_from_mesh
    !> From a file.
    procedure :: create_from_file => shape_from_file
    !> From the bytes of a file.
    procedure :: create_from_bytes => shape_from_bytes
    !> From voxels mask(nx, ny, nz): those that are not 0 are solid.
    procedure :: create_from_mask => shape_from_mask
    procedure :: create_from_silhouettes => shape_from_silhouettes
    procedure, private :: shape_from_grey_u8, shape_from_grey_u16, shape_from_grey_f32
    !> From grey values(nx, ny, nz): c_int8_t and c_int16_t are read as unsigned, or c_float.
    !> Solid above `threshold`; without it, above Otsu's.
    generic :: create_from_grey => shape_from_grey_u8, shape_from_grey_u16, shape_from_grey_f32
    !> From one label of labels(nx, ny, nz).
    procedure :: create_from_label => shape_from_label
    !> A built-in analytic particle, with keys(:) and values(:) of its parameters. The particles
    !> and what their parameters mean: the table at morula_shape_from_primitive() in morula.h.
    procedure :: create_from_primitive => shape_from_primitive
    procedure :: report => shape_report
    procedure :: note_count => shape_note_count
    !> Note `index`, counted from 1.
    procedure :: note => shape_note
    procedure :: moments => shape_moments
    !> Stage times and counters of what made it.
    procedure :: counters => shape_counters
    !> As bytes, for another rank or a restart file, and from such bytes.
    procedure :: serialize => shape_serialize
    procedure :: deserialize => shape_deserialize
    procedure :: destroy => shape_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => shape_handle
    procedure, private :: shape_assign
    generic :: assignment(=) => shape_assign
    final :: shape_final
  end type morula_shape_t

  !> A shape with a grid.
  type, public :: morula_solid_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: create => solid_create
    procedure :: grid => solid_grid
    !> Exact signed distances of points(3, n), negative inside.
    procedure :: distance => solid_distance
    procedure :: note_count => solid_note_count
    !> Note `index`, counted from 1.
    procedure :: note => solid_note
    procedure :: moments => solid_moments
    !> Stage times and counters of what made it.
    procedure :: counters => solid_counters
    procedure :: destroy => solid_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => solid_handle
    procedure, private :: solid_assign
    generic :: assignment(=) => solid_assign
    final :: solid_final
  end type morula_solid_t

  !> A clump.
  type, public :: morula_clump_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, private :: clump_from_shape, clump_from_solid
    !> From a shape (its solid is made inside) or from a solid. With plane_tolerances the
    !> options' own are replaced.
    generic :: create => clump_from_shape, clump_from_solid
    procedure :: sphere_count => clump_sphere_count
    !> The spheres as xyzr(4, n): x, y, z, radius.
    procedure :: copy_spheres => clump_copy_spheres
    procedure :: stopped => clump_stopped
    !> What limits it: numbers of MORULA_WARNING_*, figures found and bounds that they miss.
    procedure :: warnings => clump_warnings
    !> The sentence of warning `index`, counted from 1.
    procedure :: warning => clump_warning
    procedure :: note => clump_note
    procedure :: moments => clump_moments
    procedure :: overlap => clump_overlap
    procedure :: surface => clump_surface
    procedure :: copy_exposed_areas => clump_copy_exposed_areas
    procedure :: copy_plane_contacts => clump_copy_plane_contacts
    procedure :: counters => clump_counters
    !> Weighed and placed, its time step, or its file, in one call: for one particle, not for many.
    procedure :: transform => clump_transform
    procedure :: timestep => clump_timestep
    procedure :: write => clump_write
    !> As bytes, for another rank or a restart file, and from such bytes.
    procedure :: serialize => clump_serialize
    procedure :: deserialize => clump_deserialize
    procedure :: destroy => clump_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => clump_handle
    procedure, private :: clump_assign
    generic :: assignment(=) => clump_assign
    final :: clump_final
  end type morula_clump_t

  !> A weighed clump: spheres with masses, and what a solver takes of the whole.
  type, public :: morula_body_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, private :: body_from_clump, body_from_spheres
    !> From a clump, or from xyzr(4, n) in the frame of a solid; without one their union is weighed.
    generic :: create => body_from_clump, body_from_spheres
    procedure :: sphere_count => body_sphere_count
    !> The spheres as xyzr(4, n): x, y, z, radius, in MORULA_FRAME_INPUT or the frame given.
    procedure :: copy_spheres => body_copy_spheres
    !> The same in single precision, each within the sphere it stands for.
    procedure :: copy_spheres_f32 => body_copy_spheres_f32
    procedure :: copy_masses => body_copy_masses
    !> Numbers, from 1, of the spheres whose mass is m_min or m_max.
    procedure :: copy_binding => body_copy_binding
    procedure :: moments => body_moments
    procedure :: masses => body_masses
    !> Into another variable: the same body in another size, place, orientation (w, x, y, z), density.
    procedure :: transform => body_transform
    procedure :: timestep => body_timestep
    !> Writes the file or files of a format, one of MORULA_EXPORT_*.
    procedure :: write => body_write
    procedure :: destroy => body_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => body_handle
    procedure, private :: body_assign
    generic :: assignment(=) => body_assign
    final :: body_final
  end type morula_body_t

  !> The files of a format in memory.
  type, public :: morula_files_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    !> From a body, in the format MORULA_EXPORT_*.
    procedure :: create => files_create
    procedure :: count => files_count
    !> What the name of file `index`, counted from 1, adds to the path, and its bytes.
    procedure :: name => files_name
    procedure :: bytes => files_bytes
    procedure :: destroy => files_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => files_handle
    procedure, private :: files_assign
    generic :: assignment(=) => files_assign
    final :: files_final
  end type morula_files_t

  !> A particle that may break: its solid and the spheres of its clump.
  type, public :: morula_parent_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, private :: parent_from_clump, parent_from_spheres, parent_from_cache
    !> Of a solid and its clump, or spheres xyzr(4, n) in its frame, of which there may be none; or
    !> of a shape and spheres, when a cache does not hold it.
    generic :: create => parent_from_clump, parent_from_spheres, parent_from_cache
    !> The body of the whole in its place, quaternion (w, x, y, z) that of the body axes.
    procedure :: held => parent_held
    procedure :: bytes => parent_bytes
    procedure :: destroy => parent_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => parent_handle
    procedure, private :: parent_assign
    generic :: assignment(=) => parent_assign
    final :: parent_final
  end type morula_parent_t

  !> A price list: for each number of spheres how good the clump is and what it costs.
  type, public :: morula_cost_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: create => cost_create
    procedure :: count => cost_count
    !> Whether cancel or the deadline ended it early.
    procedure :: cut => cost_cut
    !> All lines, by the number of spheres.
    procedure :: points => cost_points
    !> The clump of a line, counted from 1.
    procedure :: clump => cost_clump
    !> The line, counted from 1, that is best within bounds (the knee without), and why.
    procedure :: choose => cost_choose
    procedure :: destroy => cost_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => cost_handle
    procedure, private :: cost_assign
    generic :: assignment(=) => cost_assign
    final :: cost_final
  end type morula_cost_t

  !> Price lists of one shape over resolutions, methods and deadlines.
  type, public :: morula_sweep_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    !> Every resolution with every method and every deadline (by default: as long as it takes);
    !> efforts, where there are some, are as many as methods.
    procedure :: create => sweep_create
    procedure :: count => sweep_count
    !> What each list is of: the resolutions one after the other, in each the methods, of each
    !> the deadlines.
    procedure :: lists => sweep_lists
    !> A list, counted from 1; the status says why it could not be made.
    procedure :: curve => sweep_curve
    procedure :: destroy => sweep_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => sweep_handle
    procedure, private :: sweep_assign
    generic :: assignment(=) => sweep_assign
    final :: sweep_final
  end type morula_sweep_t

  !> Prepared parents that are used again, within a bound of bytes.
  type, public :: morula_cache_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    !> An empty one that holds so many bytes at most.
    procedure :: create => cache_create
    procedure :: counters => cache_counters
    procedure :: clear => cache_clear
    procedure :: destroy => cache_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => cache_handle
    procedure, private :: cache_assign
    generic :: assignment(=) => cache_assign
    final :: cache_final
  end type morula_cache_t

  !> The fragments of one break, counted from 1, and its dust.
  type, public :: morula_fragments_t
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, private :: fragments_of_parent, fragments_of_fragment
    !> Breaks a parent, or fragment `index` of an earlier break (another variable).
    generic :: create => fragments_of_parent, fragments_of_fragment
    !> New spheres for a shape that has changed, from the old ones xyzr(4, n): one fragment.
    procedure :: reclump_shape => fragments_reclump
    !> The pieces of a label volume labels(:, :, :); xyzr(4, n) are the body's spheres, or none.
    procedure :: create_from_labels => fragments_from_labels
    procedure :: count => fragments_count
    procedure :: dust_count => fragments_dust_count
    !> What a solver takes of a fragment, and its quality.
    procedure :: get => fragments_get
    procedure :: dust => fragments_dust
    procedure :: totals => fragments_totals
    !> A fragment as the solver holds it now, for it to break again.
    procedure :: held => fragments_held
    !> The spheres as xyzr(4, n): x, y, z, radius, in MORULA_FRAME_INPUT or the frame given.
    procedure :: copy_spheres => fragments_copy_spheres
    procedure :: copy_masses => fragments_copy_masses
    !> Those of sphere i are the pairs starts(i) up to starts(i + 1) - 1; spheres count from 1.
    procedure :: copy_map => fragments_copy_map
    !> Normal and offset each, half_spaces(4, n).
    procedure :: copy_half_spaces => fragments_copy_half_spaces
    !> The surface of a fragment.
    procedure :: shape => fragments_shape
    !> A fragment as bytes, and again fragment 1, beside a parent of the same shape and grid.
    procedure :: serialize => fragments_serialize
    procedure :: deserialize => fragments_deserialize
    !> The spheres, grown by a part from 0 to 1 as far as others(4, m) leave room.
    procedure :: grow => fragments_grow
    procedure :: note_count => fragments_note_count
    procedure :: note => fragments_note
    procedure :: destroy => fragments_destroy
    !> The C handle; it stays this variable's.
    procedure :: c_handle => fragments_handle
    procedure, private :: fragments_assign
    generic :: assignment(=) => fragments_assign
    final :: fragments_final
  end type morula_fragments_t

  !> Options with the defaults.
  interface morula_init
    procedure :: init_import, init_file, init_solid, init_clump, init_mass, init_contact, init_export
    procedure :: init_break, init_held, init_cost, init_cost_bounds, init_sweep
  end interface morula_init

  !> The labels of an array labels(nx, ny, nz), of a file (its path), of the bytes of a file.
  interface morula_labels
    procedure :: labels_of_array, labels_of_file, labels_of_bytes
  end interface morula_labels

  !> Several clumps in one call, into clumps(n): of a solid with spheres(n) spheres each, of
  !> shapes(n), of the labels wanted(n) of an array labels(nx, ny, nz). With statuses(n) every
  !> one that succeeds is made; without, all of them or none.
  interface morula_make_clumps
    procedure :: clumps_from_solid, clumps_from_shapes, clumps_from_labels
  end interface morula_make_clumps

  public :: morula_make_clumps, morula_break_all
  public :: morula_init, morula_text, morula_message, morula_name_of_status
  public :: morula_name_of_primitive, morula_name_of_stop, morula_labels
  public :: morula_name_of_warning
  public :: morula_name_of_masses, morula_library_version, morula_parameter_count
  public :: morula_parameter, morula_orientations, morula_log_to, morula_log_sink

  abstract interface
    !> Receives one line of log; level is one of MORULA_LOG_*.
    subroutine morula_log_sink(level, text)
      import
      integer(c_int32_t), intent(in) :: level
      character(*), intent(in) :: text
    end subroutine morula_log_sink
  end interface

  procedure(morula_log_sink), pointer :: the_sink => null()

contains

  ! ---- text, status, options ----

  !> A C string as Fortran text.
  function morula_text(pointer) result(text)
    type(c_ptr), intent(in) :: pointer
    character(:), allocatable :: text
    character(kind=c_char), pointer :: chars(:)
    integer :: i, length
    if (.not. c_associated(pointer)) then
      text = ''
      return
    end if
    length = int(c_strlen(pointer))
    call c_f_pointer(pointer, chars, [length])
    allocate(character(length) :: text)
    do i = 1, length
      text(i:i) = chars(i)
    end do
  end function morula_text

  !> The sentence of this thread's last failure.
  function morula_message() result(text)
    character(:), allocatable :: text
    text = morula_text(morula_last_error_message())
  end function morula_message

  !> The name of a status.
  function morula_name_of_status(status) result(text)
    integer(c_int32_t), intent(in) :: status
    character(:), allocatable :: text
    text = morula_text(morula_status_name(status))
  end function morula_name_of_status

  !> The word for a MORULA_STOPPED_* number.
  function morula_name_of_stop(stopped) result(text)
    integer(c_int32_t), intent(in) :: stopped
    character(:), allocatable :: text
    text = morula_text(morula_stopped_name(stopped))
  end function morula_name_of_stop

  !> The word for a MORULA_WARNING_* number.
  function morula_name_of_warning(warning) result(text)
    integer(c_int32_t), intent(in) :: warning
    character(:), allocatable :: text
    text = morula_text(morula_warning_name(warning))
  end function morula_name_of_warning

  !> The name of built-in particle `index`, counted from 1; empty when there are no more.
  function morula_name_of_primitive(index) result(text)
    integer, intent(in) :: index
    character(:), allocatable :: text
    text = morula_text(morula_primitive_name(int(index - 1, c_size_t)))
  end function morula_name_of_primitive

  !> The word for a MORULA_MASSES_* number.
  function morula_name_of_masses(status) result(text)
    integer(c_int32_t), intent(in) :: status
    character(:), allocatable :: text
    text = morula_text(morula_masses_status_name(status))
  end function morula_name_of_masses

  !> The version of the library; morula_version() is it as a number.
  function morula_library_version() result(text)
    character(:), allocatable :: text
    text = morula_text(morula_version_string())
  end function morula_library_version

  !> How many parameters a built-in particle has.
  subroutine morula_parameter_count(name, count, status)
    character(*), intent(in) :: name
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_primitive_parameter_count(terminated(name), n), status)
    count = int(n)
  end subroutine morula_parameter_count

  !> The key of parameter `index`, counted from 1, of a built-in particle, and its default.
  subroutine morula_parameter(name, index, key, value, status)
    character(*), intent(in) :: name
    integer, intent(in) :: index
    character(:), allocatable, intent(out) :: key
    real(c_double), intent(out), target :: value
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t), target :: length
    integer(c_size_t) :: at
    integer(c_int32_t) :: code
    at = int(index - 1, c_size_t)
    length = 0
    value = 0
    code = morula_primitive_copy_parameter(terminated(name), at, 0_c_size_t, c_null_ptr, &
      at_size(length), at_double(value))
    allocate(buffer(length + 1))
    buffer = c_null_char
    if (code == MORULA_STATUS_OK) then
      code = morula_primitive_copy_parameter(terminated(name), at, length + 1, c_loc(buffer), &
        c_null_ptr, c_null_ptr)
    end if
    key = morula_text(c_loc(buffer))
    call finish(code, status)
  end subroutine morula_parameter

  !> Rotations w, x, y, z as quaternions(4, n), drawn evenly from all: the same for the same seed.
  subroutine morula_orientations(seed, quaternions, status)
    integer(c_int64_t), intent(in) :: seed
    real(c_double), intent(inout), contiguous :: quaternions(:, :)
    integer(c_int32_t), intent(out), optional :: status
    if (size(quaternions, 1) /= 4) error stop 'morula: quaternions is an array (4, n)'
    call finish(morula_random_orientations(seed, size(quaternions, 2, c_size_t), quaternions), &
      status)
  end subroutine morula_orientations

  !> Sets where the lines of the library's log go, for the whole program; without a sink, nowhere.
  !> Call it while no other call runs.
  subroutine morula_log_to(sink, status)
    procedure(morula_log_sink), optional :: sink
    integer(c_int32_t), intent(out), optional :: status
    the_sink => null()
    if (present(sink)) then
      the_sink => sink
      call finish(morula_set_log(c_funloc(log_line), c_null_ptr), status)
    else
      call finish(morula_set_log(c_null_funptr, c_null_ptr), status)
    end if
  end subroutine morula_log_to

  subroutine log_line(level, text, user) bind(c, name='')
    integer(c_int32_t), value :: level
    type(c_ptr), value :: text, user
    if (associated(the_sink) .and. .not. c_associated(user)) call the_sink(level, morula_text(text))
  end subroutine log_line

  subroutine finish(code, status)
    integer(c_int32_t), intent(in) :: code
    integer(c_int32_t), intent(out), optional :: status
    if (present(status)) then
      status = code
    else if (code /= MORULA_STATUS_OK) then
      write (error_unit, '(4a)') 'morula: ', morula_name_of_status(code), ': ', morula_message()
      error stop 'a call of the morula library failed'
    end if
  end subroutine finish

  subroutine refuse_assignment()
    error stop 'a morula handle cannot be assigned: it would be freed twice'
  end subroutine refuse_assignment

  pure function terminated(text) result(with_nul)
    character(*), intent(in) :: text
    character(kind=c_char) :: with_nul(len_trim(text) + 1)
    integer :: i
    do i = 1, len_trim(text)
      with_nul(i) = text(i:i)
    end do
    with_nul(len_trim(text) + 1) = c_null_char
  end function terminated

  subroutine init_import(options, status)
    type(morula_import_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_import_options_init(options, c_sizeof(options)), status)
  end subroutine init_import

  subroutine init_file(options, status)
    type(morula_file_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_file_options_init(options, c_sizeof(options)), status)
  end subroutine init_file

  subroutine init_solid(options, status)
    type(morula_solid_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_solid_options_init(options, c_sizeof(options)), status)
  end subroutine init_solid

  subroutine init_clump(options, status)
    type(morula_clump_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_clump_options_init(options, c_sizeof(options)), status)
  end subroutine init_clump

  subroutine init_mass(options, status)
    type(morula_mass_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_mass_options_init(options, c_sizeof(options)), status)
  end subroutine init_mass

  subroutine init_contact(options, status)
    type(morula_contact_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_contact_options_init(options, c_sizeof(options)), status)
  end subroutine init_contact

  subroutine init_export(options, status)
    type(morula_export_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_export_options_init(options, c_sizeof(options)), status)
  end subroutine init_export

  subroutine init_break(options, status)
    type(morula_break_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_break_options_init(options, c_sizeof(options)), status)
  end subroutine init_break

  subroutine init_cost(options, status)
    type(morula_cost_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_cost_options_init(options, c_sizeof(options)), status)
  end subroutine init_cost

  subroutine init_cost_bounds(bounds, status)
    type(morula_cost_bounds), intent(out) :: bounds
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_cost_bounds_init(bounds, c_sizeof(bounds)), status)
  end subroutine init_cost_bounds

  subroutine init_sweep(options, status)
    type(morula_sweep_options), intent(out) :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_sweep_options_init(options, c_sizeof(options)), status)
  end subroutine init_sweep

  subroutine init_held(held, status)
    type(morula_held), intent(out) :: held
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_held_init(held, c_sizeof(held)), status)
  end subroutine init_held

  !> The labels of labels(nx, ny, nz), ascending, without 0: ids(n), their cells(n), boxes(6, n)
  !> (first and last cell, counted from 1), and whether they touch the border.
  subroutine labels_of_array(labels, ids, cells, boxes, touches_border, status)
    integer(c_int32_t), intent(in), contiguous :: labels(:, :, :)
    integer(c_int32_t), allocatable, intent(out), target :: ids(:)
    integer(c_int64_t), allocatable, intent(out), optional :: cells(:), boxes(:, :)
    logical, allocatable, intent(out), optional :: touches_border(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    integer(c_int32_t) :: code
    integer(c_int32_t), allocatable, target :: touches(:)
    integer(c_int64_t), allocatable, target :: numbers(:), corners(:, :)
    n = 0
    code = morula_labels_count(labels, shape(labels, c_size_t), n)
    allocate(ids(n), numbers(n), corners(6, n), touches(n))
    if (code == MORULA_STATUS_OK) then
      code = morula_labels_copy(labels, shape(labels, c_size_t), n, at_int32s(ids), &
        at_int64s(numbers), at_int64s(corners), at_int32s(touches))
    end if
    if (code == MORULA_STATUS_OK) then
      call hand_over(numbers, corners, touches, cells, boxes, touches_border)
    end if
    call finish(code, status)
  end subroutine labels_of_array

  !> The same of a label volume in a file.
  subroutine labels_of_file(path, ids, cells, boxes, touches_border, options, file_options, status)
    character(*), intent(in) :: path
    integer(c_int32_t), allocatable, intent(out), target :: ids(:)
    integer(c_int64_t), allocatable, intent(out), optional :: cells(:), boxes(:, :)
    logical, allocatable, intent(out), optional :: touches_border(:)
    type(morula_import_options), intent(in), optional, target :: options
    type(morula_file_options), intent(in), optional, target :: file_options
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    integer(c_int32_t) :: code
    integer(c_int32_t), allocatable, target :: touches(:)
    integer(c_int64_t), allocatable, target :: numbers(:), corners(:, :)
    n = 0
    code = morula_labels_from_file(terminated(path), at_import(options), at_file(file_options), &
      n, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, n)
    allocate(ids(n), numbers(n), corners(6, n), touches(n))
    if (code == MORULA_STATUS_OK) then
      code = morula_labels_from_file(terminated(path), at_import(options), at_file(file_options), &
        size(ids, kind=c_size_t), at_int32s(ids), at_int64s(numbers), at_int64s(corners), &
        at_int32s(touches), n)
    end if
    if (code == MORULA_STATUS_OK) then
      ids = ids(:n)
      call hand_over(numbers(:n), corners(:, :n), touches(:n), cells, boxes, touches_border)
    end if
    call finish(code, status)
  end subroutine labels_of_file

  !> The same of the bytes of a file; the name helps where they do not tell the format.
  subroutine labels_of_bytes(bytes, name, ids, cells, boxes, touches_border, options, &
      file_options, status)
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    character(*), intent(in) :: name
    integer(c_int32_t), allocatable, intent(out), target :: ids(:)
    integer(c_int64_t), allocatable, intent(out), optional :: cells(:), boxes(:, :)
    logical, allocatable, intent(out), optional :: touches_border(:)
    type(morula_import_options), intent(in), optional, target :: options
    type(morula_file_options), intent(in), optional, target :: file_options
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    integer(c_int32_t) :: code
    integer(c_int32_t), allocatable, target :: touches(:)
    integer(c_int64_t), allocatable, target :: numbers(:), corners(:, :)
    n = 0
    code = morula_labels_from_bytes(bytes, size(bytes, kind=c_size_t), terminated(name), &
      at_import(options), at_file(file_options), n, c_null_ptr, c_null_ptr, c_null_ptr, &
      c_null_ptr, n)
    allocate(ids(n), numbers(n), corners(6, n), touches(n))
    if (code == MORULA_STATUS_OK) then
      code = morula_labels_from_bytes(bytes, size(bytes, kind=c_size_t), terminated(name), &
        at_import(options), at_file(file_options), n, at_int32s(ids), at_int64s(numbers), &
        at_int64s(corners), at_int32s(touches), n)
    end if
    if (code == MORULA_STATUS_OK) then
      call hand_over(numbers, corners, touches, cells, boxes, touches_border)
    end if
    call finish(code, status)
  end subroutine labels_of_bytes

  !> What is known of labels, in Fortran's counting, as far as it is asked for.
  subroutine hand_over(numbers, corners, touches, cells, boxes, touches_border)
    integer(c_int64_t), intent(in) :: numbers(:), corners(:, :)
    integer(c_int32_t), intent(in) :: touches(:)
    integer(c_int64_t), allocatable, intent(out), optional :: cells(:), boxes(:, :)
    logical, allocatable, intent(out), optional :: touches_border(:)
    if (present(cells)) cells = numbers
    if (present(boxes)) boxes = corners + 1
    if (present(touches_border)) touches_border = touches /= 0
  end subroutine hand_over

  ! ---- addresses of arguments, NULL for what is absent ----

  function at_break(x) result(address)
    type(morula_break_options), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_break

  function at_breaks(x) result(address)
    type(morula_break_options), intent(in), target, optional :: x(*)
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_breaks

  function at_clump(x) result(address)
    type(morula_clump_options), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_clump

  function at_cost(x) result(address)
    type(morula_cost_options), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_cost

  function at_cost_bounds(x) result(address)
    type(morula_cost_bounds), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_cost_bounds

  function at_double(x) result(address)
    real(c_double), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_double

  function at_doubles(x) result(address)
    real(c_double), intent(in), target, optional :: x(*)
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_doubles

  function at_export(x) result(address)
    type(morula_export_options), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_export

  function at_file(x) result(address)
    type(morula_file_options), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_file

  function at_import(x) result(address)
    type(morula_import_options), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_import

  function at_int32s(x) result(address)
    integer(c_int32_t), intent(in), target, optional :: x(*)
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_int32s

  function at_int64s(x) result(address)
    integer(c_int64_t), intent(in), target, optional :: x(*)
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_int64s

  function at_int8s(x) result(address)
    integer(c_int8_t), intent(in), target, optional :: x(*)
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_int8s

  function at_mass(x) result(address)
    type(morula_mass_options), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_mass

  function at_pointers(x) result(address)
    type(c_ptr), intent(in), target, optional :: x(*)
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_pointers

  function at_size(x) result(address)
    integer(c_size_t), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_size

  function at_sizes(x) result(address)
    integer(c_size_t), intent(in), target, optional :: x(*)
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_sizes

  function at_solid(x) result(address)
    type(morula_solid_options), intent(in), target, optional :: x
    type(c_ptr) :: address
    address = c_null_ptr
    if (present(x)) address = c_loc(x)
  end function at_solid

  ! ---- morula_shape_t ----

  subroutine shape_from_mesh(self, vertices, triangles, options, status)
    class(morula_shape_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: vertices(:, :)
    integer(c_int32_t), intent(in), contiguous :: triangles(:, :)
    type(morula_import_options), intent(in), optional :: options
    integer(c_int32_t), intent(out), optional :: status
    type(morula_import_options), target :: from_one
    call self%destroy()
    if (size(vertices, 1) /= 3 .or. size(triangles, 1) /= 3) then
      error stop 'morula: vertices and triangles are arrays (3, n)'
    end if
    call morula_init(from_one)
    if (present(options)) from_one = options
    from_one%index_base = 1
    call finish(morula_shape_from_mesh(vertices, size(vertices, 2, c_size_t), triangles, &
      size(triangles, 2, c_size_t), at_import(from_one), self%handle), status)
  end subroutine shape_from_mesh

  subroutine shape_from_file(self, path, options, file_options, status)
    class(morula_shape_t), intent(inout) :: self
    character(*), intent(in) :: path
    type(morula_import_options), intent(in), optional, target :: options
    type(morula_file_options), intent(in), optional, target :: file_options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_shape_from_file(terminated(path), at_import(options), &
      at_file(file_options), self%handle), status)
  end subroutine shape_from_file

  subroutine shape_from_bytes(self, bytes, name, options, file_options, status)
    class(morula_shape_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    character(*), intent(in) :: name
    type(morula_import_options), intent(in), optional, target :: options
    type(morula_file_options), intent(in), optional, target :: file_options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_shape_from_bytes(bytes, size(bytes, kind=c_size_t), terminated(name), &
      at_import(options), at_file(file_options), self%handle), status)
  end subroutine shape_from_bytes

  subroutine shape_from_mask(self, mask, spacing, origin, options, status)
    class(morula_shape_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: mask(:, :, :)
    real(c_double), intent(in), optional, target :: spacing(3), origin(3)
    type(morula_import_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_shape_from_mask(mask, shape(mask, c_size_t), at_doubles(spacing), &
      at_doubles(origin), at_import(options), self%handle), status)
  end subroutine shape_from_mask

  !> The visual hull of silhouettes, one behind the other in masks. cameras(:, k, i) is row k of the
  !> matrix of camera i.
  subroutine shape_from_silhouettes(self, masks, widths, heights, cameras, cells, carve, options, &
      status)
    class(morula_shape_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: masks(:)
    integer(c_size_t), intent(in), contiguous :: widths(:), heights(:)
    real(c_double), intent(in), contiguous :: cameras(:, :, :)
    integer, intent(in), optional :: cells
    integer(c_int32_t), intent(in), optional :: carve
    type(morula_import_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    integer(c_int32_t) :: way
    call self%destroy()
    n = 64
    if (present(cells)) n = int(cells, c_size_t)
    way = MORULA_CARVE_TOUCHED
    if (present(carve)) way = carve
    if (any(shape(cameras) /= [4, 3, size(widths)]) .or. size(heights) /= size(widths) .or. &
        size(masks, kind=c_size_t) /= sum(widths * heights)) then
      error stop 'morula: masks has sum(widths*heights) elements and cameras is an array (4, 3, n)'
    end if
    call finish(morula_shape_from_silhouettes(size(widths, kind=c_size_t), masks, widths, &
      heights, cameras, n, way, at_import(options), self%handle), status)
  end subroutine shape_from_silhouettes

  subroutine shape_from_grey_u8(self, values, threshold, spacing, origin, options, status)
    class(morula_shape_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: values(:, :, :)
    real(c_double), intent(in), optional, target :: threshold, spacing(3), origin(3)
    type(morula_import_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_shape_from_grey_u8(values, shape(values, c_size_t), at_doubles(spacing), &
      at_doubles(origin), at_double(threshold), at_import(options), self%handle), status)
  end subroutine shape_from_grey_u8

  subroutine shape_from_grey_u16(self, values, threshold, spacing, origin, options, status)
    class(morula_shape_t), intent(inout) :: self
    integer(c_int16_t), intent(in), contiguous :: values(:, :, :)
    real(c_double), intent(in), optional, target :: threshold, spacing(3), origin(3)
    type(morula_import_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_shape_from_grey_u16(values, shape(values, c_size_t), at_doubles(spacing), &
      at_doubles(origin), at_double(threshold), at_import(options), self%handle), status)
  end subroutine shape_from_grey_u16

  subroutine shape_from_grey_f32(self, values, threshold, spacing, origin, options, status)
    class(morula_shape_t), intent(inout) :: self
    real(c_float), intent(in), contiguous :: values(:, :, :)
    real(c_double), intent(in), optional, target :: threshold, spacing(3), origin(3)
    type(morula_import_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_shape_from_grey_f32(values, shape(values, c_size_t), at_doubles(spacing), &
      at_doubles(origin), at_double(threshold), at_import(options), self%handle), status)
  end subroutine shape_from_grey_f32

  subroutine shape_from_label(self, labels, label, spacing, origin, options, status)
    class(morula_shape_t), intent(inout) :: self
    integer(c_int32_t), intent(in), contiguous :: labels(:, :, :)
    integer(c_int32_t), intent(in) :: label
    real(c_double), intent(in), optional, target :: spacing(3), origin(3)
    type(morula_import_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_shape_from_label(labels, shape(labels, c_size_t), at_doubles(spacing), &
      at_doubles(origin), label, at_import(options), self%handle), status)
  end subroutine shape_from_label

  subroutine shape_from_primitive(self, name, keys, values, segments, seed, options, status)
    class(morula_shape_t), intent(inout) :: self
    character(*), intent(in) :: name
    character(*), intent(in), optional :: keys(:)
    real(c_double), intent(in), optional :: values(:)
    integer, intent(in), optional :: segments
    integer(c_int64_t), intent(in), optional :: seed
    type(morula_import_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: texts(:, :)
    type(c_ptr), allocatable :: pointers(:)
    real(c_double), allocatable :: numbers(:)
    integer(c_int32_t) :: edges
    integer(c_int64_t) :: which
    integer :: i, n
    call self%destroy()
    n = 0
    if (present(keys)) n = size(keys)
    if (present(values)) n = n - size(values)
    if (n /= 0) error stop 'morula: keys and values have one element for each parameter'
    if (present(keys)) n = size(keys)
    if (present(keys)) then
      allocate(texts(len(keys) + 1, max(n, 1)))
    else
      allocate(texts(1, 1))
    end if
    texts = c_null_char
    allocate(pointers(n), numbers(n))
    do i = 1, n
      texts(:len_trim(keys(i)) + 1, i) = terminated(keys(i))
      pointers(i) = c_loc(texts(1, i))
      numbers(i) = values(i)
    end do
    edges = 0
    if (present(segments)) edges = int(segments, c_int32_t)
    which = 0
    if (present(seed)) which = seed
    call finish(morula_shape_from_primitive(terminated(name), pointers, numbers, &
      int(n, c_size_t), edges, which, at_import(options), self%handle), status)
  end subroutine shape_from_primitive

  subroutine shape_report(self, report, status)
    class(morula_shape_t), intent(in) :: self
    type(morula_report), intent(out) :: report
    integer(c_int32_t), intent(out), optional :: status
    report%struct_size = c_sizeof(report)
    call finish(morula_shape_report(self%handle, report), status)
  end subroutine shape_report

  subroutine shape_note_count(self, count, status)
    class(morula_shape_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_shape_note_count(self%handle, n), status)
    count = int(n)
  end subroutine shape_note_count

  subroutine shape_note(self, index, text, status)
    class(morula_shape_t), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable, intent(out) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t), target :: at, length
    integer(c_int32_t) :: code
    at = int(index - 1, c_size_t)
    length = 0
    code = morula_shape_copy_note(self%handle, at, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(buffer(length + 1))
    buffer = c_null_char
    if (code == MORULA_STATUS_OK) then
      code = morula_shape_copy_note(self%handle, at, length + 1, c_loc(buffer), c_null_ptr)
    end if
    text = morula_text(c_loc(buffer))
    call finish(code, status)
  end subroutine shape_note

  subroutine shape_moments(self, density, moments, status)
    class(morula_shape_t), intent(in) :: self
    real(c_double), intent(in) :: density
    type(morula_moments), intent(out) :: moments
    integer(c_int32_t), intent(out), optional :: status
    moments%struct_size = c_sizeof(moments)
    call finish(morula_shape_moments(self%handle, density, moments), status)
  end subroutine shape_moments

  subroutine shape_counters(self, counters, status)
    class(morula_shape_t), intent(in) :: self
    type(morula_counters), intent(out) :: counters
    integer(c_int32_t), intent(out), optional :: status
    counters%struct_size = c_sizeof(counters)
    call finish(morula_shape_counters(self%handle, counters), status)
  end subroutine shape_counters

  subroutine shape_destroy(self)
    class(morula_shape_t), intent(inout) :: self
    call morula_shape_free(self%handle)
    self%handle = c_null_ptr
  end subroutine shape_destroy

  function shape_handle(self) result(handle)
    class(morula_shape_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function shape_handle

  impure elemental subroutine shape_assign(self, other)
    class(morula_shape_t), intent(inout) :: self
    class(morula_shape_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine shape_assign

  impure elemental subroutine shape_final(self)
    type(morula_shape_t), intent(inout) :: self
    call self%destroy()
  end subroutine shape_final

  ! ---- morula_solid_t ----

  subroutine solid_create(self, shape, options, status)
    class(morula_solid_t), intent(inout) :: self
    class(morula_shape_t), intent(in) :: shape
    type(morula_solid_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_solid_from_shape(shape%handle, at_solid(options), self%handle), status)
  end subroutine solid_create

  subroutine solid_grid(self, dims, spacing, origin, status)
    class(morula_solid_t), intent(in) :: self
    integer(c_size_t), intent(out), optional, target :: dims(3)
    real(c_double), intent(out), optional, target :: spacing(3), origin(3)
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_solid_grid(self%handle, at_sizes(dims), at_doubles(spacing), &
      at_doubles(origin)), status)
  end subroutine solid_grid

  subroutine solid_distance(self, points, distances, status)
    class(morula_solid_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: points(:, :)
    real(c_double), intent(inout), contiguous :: distances(:)
    integer(c_int32_t), intent(out), optional :: status
    if (size(points, 1) /= 3 .or. size(distances) < size(points, 2)) then
      error stop 'morula: points is an array (3, n) and distances has n elements'
    end if
    call finish(morula_solid_distance(self%handle, size(points, 2, c_size_t), points, distances), &
      status)
  end subroutine solid_distance

  subroutine solid_note_count(self, count, status)
    class(morula_solid_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_solid_note_count(self%handle, n), status)
    count = int(n)
  end subroutine solid_note_count

  subroutine solid_note(self, index, text, status)
    class(morula_solid_t), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable, intent(out) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t), target :: at, length
    integer(c_int32_t) :: code
    at = int(index - 1, c_size_t)
    length = 0
    code = morula_solid_copy_note(self%handle, at, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(buffer(length + 1))
    buffer = c_null_char
    if (code == MORULA_STATUS_OK) then
      code = morula_solid_copy_note(self%handle, at, length + 1, c_loc(buffer), c_null_ptr)
    end if
    text = morula_text(c_loc(buffer))
    call finish(code, status)
  end subroutine solid_note

  subroutine solid_moments(self, density, moments, status)
    class(morula_solid_t), intent(in) :: self
    real(c_double), intent(in) :: density
    type(morula_moments), intent(out) :: moments
    integer(c_int32_t), intent(out), optional :: status
    moments%struct_size = c_sizeof(moments)
    call finish(morula_solid_moments(self%handle, density, moments), status)
  end subroutine solid_moments

  subroutine solid_counters(self, counters, status)
    class(morula_solid_t), intent(in) :: self
    type(morula_counters), intent(out) :: counters
    integer(c_int32_t), intent(out), optional :: status
    counters%struct_size = c_sizeof(counters)
    call finish(morula_solid_counters(self%handle, counters), status)
  end subroutine solid_counters

  subroutine solid_destroy(self)
    class(morula_solid_t), intent(inout) :: self
    call morula_solid_free(self%handle)
    self%handle = c_null_ptr
  end subroutine solid_destroy

  function solid_handle(self) result(handle)
    class(morula_solid_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function solid_handle

  impure elemental subroutine solid_assign(self, other)
    class(morula_solid_t), intent(inout) :: self
    class(morula_solid_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine solid_assign

  impure elemental subroutine solid_final(self)
    type(morula_solid_t), intent(inout) :: self
    call self%destroy()
  end subroutine solid_final

  ! ---- morula_clump_t ----

  subroutine clump_from_shape(self, shape, clump_options, solid_options, plane_tolerances, status)
    class(morula_clump_t), intent(inout) :: self
    class(morula_shape_t), intent(in) :: shape
    type(morula_clump_options), intent(in), optional :: clump_options
    type(morula_solid_options), intent(in), optional, target :: solid_options
    real(c_double), intent(in), contiguous, target, optional :: plane_tolerances(:)
    integer(c_int32_t), intent(out), optional :: status
    type(morula_clump_options), target :: options
    call self%destroy()
    call morula_init(options)
    if (present(clump_options)) options = clump_options
    if (present(plane_tolerances)) call set_planes(options, plane_tolerances)
    call finish(morula_clump_from_shape(shape%handle, at_solid(solid_options), at_clump(options), &
      self%handle), status)
  end subroutine clump_from_shape

  subroutine clump_from_solid(self, solid, clump_options, plane_tolerances, status)
    class(morula_clump_t), intent(inout) :: self
    class(morula_solid_t), intent(in) :: solid
    type(morula_clump_options), intent(in), optional :: clump_options
    real(c_double), intent(in), contiguous, target, optional :: plane_tolerances(:)
    integer(c_int32_t), intent(out), optional :: status
    type(morula_clump_options), target :: options
    call self%destroy()
    call morula_init(options)
    if (present(clump_options)) options = clump_options
    if (present(plane_tolerances)) call set_planes(options, plane_tolerances)
    call finish(morula_clump_from_solid(solid%handle, at_clump(options), self%handle), status)
  end subroutine clump_from_solid

  subroutine clumps_from_solid(clumps, solid, spheres, clump_options, status)
    type(morula_clump_t), intent(inout) :: clumps(:)
    class(morula_solid_t), intent(in) :: solid
    integer, intent(in) :: spheres(:)
    type(morula_clump_options), intent(in), optional, target :: clump_options
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: handles(size(clumps))
    integer(c_int32_t) :: code
    call empty(clumps, size(spheres), handles)
    code = morula_clumps_from_solid(solid%handle, at_clump(clump_options), &
      int(spheres, c_int64_t), size(spheres, kind=c_size_t), handles)
    clumps%handle = handles
    call finish(code, status)
  end subroutine clumps_from_solid

  subroutine clumps_from_shapes(clumps, shapes, clump_options, solid_options, statuses, status)
    type(morula_clump_t), intent(inout) :: clumps(:)
    type(morula_shape_t), intent(in) :: shapes(:)
    type(morula_clump_options), intent(in), optional, target :: clump_options
    type(morula_solid_options), intent(in), optional, target :: solid_options
    integer(c_int32_t), intent(inout), contiguous, optional :: statuses(:)
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: handles(size(clumps)), from(size(shapes))
    integer(c_int32_t), target :: code, told(size(clumps))
    call empty(clumps, size(shapes), handles)
    if (present(statuses)) call as_long(statuses, clumps)
    told = MORULA_STATUS_OK
    if (present(statuses)) told = statuses
    from = shapes%handle
    code = morula_clumps_from_shapes(from, size(from, kind=c_size_t), at_solid(solid_options), &
      at_clump(clump_options), handles, at_int32s(told))
    if (present(statuses)) statuses = told
    clumps%handle = handles
    call finish(code, status)
  end subroutine clumps_from_shapes

  subroutine clumps_from_labels(clumps, labels, wanted, spacing, origin, clump_options, &
      import_options, solid_options, statuses, status)
    type(morula_clump_t), intent(inout) :: clumps(:)
    integer(c_int32_t), intent(in), contiguous :: labels(:, :, :)
    integer(c_int32_t), intent(in), contiguous :: wanted(:)
    real(c_double), intent(in), optional, target :: spacing(3), origin(3)
    type(morula_clump_options), intent(in), optional, target :: clump_options
    type(morula_import_options), intent(in), optional, target :: import_options
    type(morula_solid_options), intent(in), optional, target :: solid_options
    integer(c_int32_t), intent(inout), contiguous, optional :: statuses(:)
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: handles(size(clumps))
    integer(c_int32_t), target :: code, told(size(clumps))
    call empty(clumps, size(wanted), handles)
    if (present(statuses)) call as_long(statuses, clumps)
    told = MORULA_STATUS_OK
    if (present(statuses)) told = statuses
    code = morula_clumps_from_labels(labels, shape(labels, c_size_t), at_doubles(spacing), &
      at_doubles(origin), wanted, size(wanted, kind=c_size_t), at_import(import_options), &
      at_solid(solid_options), at_clump(clump_options), handles, at_int32s(told))
    if (present(statuses)) statuses = told
    clumps%handle = handles
    call finish(code, status)
  end subroutine clumps_from_labels

  !> Clumps without content, one for each that is to be made.
  subroutine empty(clumps, count, handles)
    type(morula_clump_t), intent(inout) :: clumps(:)
    integer, intent(in) :: count
    type(c_ptr), intent(out) :: handles(:)
    integer :: i
    if (size(clumps) /= count) error stop 'morula: clumps is not as long as what it is made of'
    do i = 1, count
      call clumps(i)%destroy()
      handles(i) = c_null_ptr
    end do
  end subroutine empty

  subroutine as_long(statuses, clumps)
    integer(c_int32_t), intent(in) :: statuses(:)
    type(morula_clump_t), intent(in) :: clumps(:)
    if (size(statuses) /= size(clumps)) error stop 'morula: statuses is not as long as clumps'
  end subroutine as_long

  subroutine set_planes(options, planes)
    type(morula_clump_options), intent(inout) :: options
    real(c_double), intent(in), contiguous, target :: planes(:)
    if (size(planes) > 0) options%plane_tolerances = c_loc(planes)
    options%plane_tolerance_count = size(planes, kind=c_size_t)
  end subroutine set_planes

  subroutine clump_sphere_count(self, count, status)
    class(morula_clump_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_clump_sphere_count(self%handle, n), status)
    count = int(n)
  end subroutine clump_sphere_count

  subroutine clump_copy_spheres(self, xyzr, status)
    class(morula_clump_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: xyzr(:, :)
    integer(c_int32_t), intent(out), optional :: status
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call finish(morula_clump_copy_spheres(self%handle, size(xyzr, 2, c_size_t), xyzr), status)
  end subroutine clump_copy_spheres

  subroutine clump_stopped(self, stopped, status)
    class(morula_clump_t), intent(in) :: self
    integer(c_int32_t), intent(inout) :: stopped
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_clump_stopped(self%handle, stopped), status)
  end subroutine clump_stopped

  subroutine clump_warnings(self, codes, figures, bounds, status)
    class(morula_clump_t), intent(in) :: self
    integer(c_int32_t), allocatable, intent(out) :: codes(:)
    real(c_double), allocatable, intent(out) :: figures(:), bounds(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    integer(c_int32_t) :: code
    n = 0
    code = morula_clump_warning_count(self%handle, n)
    allocate(codes(n), figures(n), bounds(n))
    if (code == MORULA_STATUS_OK) then
      code = morula_clump_copy_warnings(self%handle, n, codes, figures, bounds)
    end if
    call finish(code, status)
  end subroutine clump_warnings

  subroutine clump_warning(self, index, text, status)
    class(morula_clump_t), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable, intent(out) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t), target :: at, length
    integer(c_int32_t) :: code
    at = int(index - 1, c_size_t)
    length = 0
    code = morula_clump_copy_warning(self%handle, at, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(buffer(length + 1))
    buffer = c_null_char
    if (code == MORULA_STATUS_OK) then
      code = morula_clump_copy_warning(self%handle, at, length + 1, c_loc(buffer), c_null_ptr)
    end if
    text = morula_text(c_loc(buffer))
    call finish(code, status)
  end subroutine clump_warning

  subroutine clump_note(self, text, status)
    class(morula_clump_t), intent(in) :: self
    character(:), allocatable, intent(out) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t), target :: length
    integer(c_int32_t) :: code
    length = 0
    code = morula_clump_copy_note(self%handle, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(buffer(length + 1))
    buffer = c_null_char
    if (code == MORULA_STATUS_OK) then
      code = morula_clump_copy_note(self%handle, length + 1, c_loc(buffer), c_null_ptr)
    end if
    text = morula_text(c_loc(buffer))
    call finish(code, status)
  end subroutine clump_note

  subroutine shape_serialize(self, bytes, status)
    class(morula_shape_t), intent(in) :: self
    integer(c_int8_t), allocatable, intent(out), target :: bytes(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t), target :: length
    integer(c_int32_t) :: code
    length = 0
    code = morula_shape_serialize(self%handle, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(bytes(length))
    if (code == MORULA_STATUS_OK) then
      code = morula_shape_serialize(self%handle, length, at_int8s(bytes), c_null_ptr)
    end if
    call finish(code, status)
  end subroutine shape_serialize

  subroutine shape_deserialize(self, bytes, status)
    class(morula_shape_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_shape_deserialize(bytes, size(bytes, kind=c_size_t), self%handle), status)
  end subroutine shape_deserialize

  subroutine clump_serialize(self, bytes, status)
    class(morula_clump_t), intent(in) :: self
    integer(c_int8_t), allocatable, intent(out), target :: bytes(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t), target :: length
    integer(c_int32_t) :: code
    length = 0
    code = morula_clump_serialize(self%handle, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(bytes(length))
    if (code == MORULA_STATUS_OK) then
      code = morula_clump_serialize(self%handle, length, at_int8s(bytes), c_null_ptr)
    end if
    call finish(code, status)
  end subroutine clump_serialize

  subroutine clump_deserialize(self, bytes, status)
    class(morula_clump_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_clump_deserialize(bytes, size(bytes, kind=c_size_t), self%handle), status)
  end subroutine clump_deserialize

  subroutine clump_moments(self, density, moments, status)
    class(morula_clump_t), intent(in) :: self
    real(c_double), intent(in) :: density
    type(morula_moments), intent(out) :: moments
    integer(c_int32_t), intent(out), optional :: status
    moments%struct_size = c_sizeof(moments)
    call finish(morula_clump_moments(self%handle, density, moments), status)
  end subroutine clump_moments

  subroutine clump_overlap(self, overlap, status)
    class(morula_clump_t), intent(in) :: self
    type(morula_overlap), intent(out) :: overlap
    integer(c_int32_t), intent(out), optional :: status
    overlap%struct_size = c_sizeof(overlap)
    call finish(morula_clump_overlap(self%handle, overlap), status)
  end subroutine clump_overlap

  subroutine clump_surface(self, surface, status)
    class(morula_clump_t), intent(in) :: self
    type(morula_surface), intent(out) :: surface
    integer(c_int32_t), intent(out), optional :: status
    surface%struct_size = c_sizeof(surface)
    call finish(morula_clump_surface(self%handle, surface), status)
  end subroutine clump_surface

  subroutine clump_copy_exposed_areas(self, areas, status)
    class(morula_clump_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: areas(:)
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_clump_copy_exposed_areas(self%handle, size(areas, kind=c_size_t), areas), &
      status)
  end subroutine clump_copy_exposed_areas

  subroutine clump_copy_plane_contacts(self, counts, status)
    class(morula_clump_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: counts(:)
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_clump_copy_plane_contacts(self%handle, size(counts, kind=c_size_t), &
      counts), status)
  end subroutine clump_copy_plane_contacts

  subroutine clump_counters(self, counters, status)
    class(morula_clump_t), intent(in) :: self
    type(morula_counters), intent(out) :: counters
    integer(c_int32_t), intent(out), optional :: status
    counters%struct_size = c_sizeof(counters)
    call finish(morula_clump_counters(self%handle, counters), status)
  end subroutine clump_counters

  subroutine clump_transform(self, placed, scale, position, quaternion, masses, status)
    class(morula_clump_t), intent(in) :: self
    type(morula_body_t), intent(inout) :: placed
    real(c_double), intent(in) :: scale
    real(c_double), intent(in), optional, target :: position(3), quaternion(4)
    type(morula_mass_options), intent(in), optional, target :: masses
    integer(c_int32_t), intent(out), optional :: status
    call placed%destroy()
    call finish(morula_clump_transform(self%handle, at_mass(masses), scale, at_doubles(position), &
      at_doubles(quaternion), placed%handle), status)
  end subroutine clump_transform

  subroutine clump_timestep(self, contact, timestep, masses, status)
    class(morula_clump_t), intent(in) :: self
    type(morula_contact_options), intent(in) :: contact
    type(morula_timestep), intent(out) :: timestep
    type(morula_mass_options), intent(in), optional, target :: masses
    integer(c_int32_t), intent(out), optional :: status
    timestep%struct_size = c_sizeof(timestep)
    call finish(morula_clump_timestep(self%handle, at_mass(masses), contact, timestep), status)
  end subroutine clump_timestep

  subroutine clump_write(self, format, path, masses, options, status)
    class(morula_clump_t), intent(in) :: self
    integer(c_int32_t), intent(in) :: format
    character(*), intent(in) :: path
    type(morula_mass_options), intent(in), optional, target :: masses
    type(morula_export_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_clump_write(self%handle, at_mass(masses), format, at_export(options), &
      terminated(path)), status)
  end subroutine clump_write

  subroutine clump_destroy(self)
    class(morula_clump_t), intent(inout) :: self
    call morula_clump_free(self%handle)
    self%handle = c_null_ptr
  end subroutine clump_destroy

  function clump_handle(self) result(handle)
    class(morula_clump_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function clump_handle

  impure elemental subroutine clump_assign(self, other)
    class(morula_clump_t), intent(inout) :: self
    class(morula_clump_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine clump_assign

  impure elemental subroutine clump_final(self)
    type(morula_clump_t), intent(inout) :: self
    call self%destroy()
  end subroutine clump_final

  ! ---- weighed clumps ----

  subroutine body_from_clump(self, clump, options, status)
    class(morula_body_t), intent(inout) :: self
    class(morula_clump_t), intent(in) :: clump
    type(morula_mass_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_body_from_clump(clump%handle, at_mass(options), self%handle), status)
  end subroutine body_from_clump

  subroutine body_from_spheres(self, xyzr, solid, options, status)
    class(morula_body_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: xyzr(:, :)
    class(morula_solid_t), intent(in), optional :: solid
    type(morula_mass_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: of
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call self%destroy()
    of = c_null_ptr
    if (present(solid)) of = solid%handle
    call finish(morula_body_from_spheres(xyzr, size(xyzr, 2, c_size_t), of, at_mass(options), &
      self%handle), status)
  end subroutine body_from_spheres

  subroutine body_sphere_count(self, count, status)
    class(morula_body_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_body_sphere_count(self%handle, n), status)
    count = int(n)
  end subroutine body_sphere_count

  !> The frame that is asked for.
  pure function frame_or_input(frame) result(f)
    integer(c_int32_t), intent(in), optional :: frame
    integer(c_int32_t) :: f
    f = MORULA_FRAME_INPUT
    if (present(frame)) f = frame
  end function frame_or_input

  subroutine body_copy_spheres(self, xyzr, frame, status)
    class(morula_body_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: xyzr(:, :)
    integer(c_int32_t), intent(in), optional :: frame
    integer(c_int32_t), intent(out), optional :: status
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call finish(morula_body_copy_spheres(self%handle, frame_or_input(frame), &
      size(xyzr, 2, c_size_t), xyzr), status)
  end subroutine body_copy_spheres

  subroutine body_copy_spheres_f32(self, xyzr, frame, status)
    class(morula_body_t), intent(in) :: self
    real(c_float), intent(inout), contiguous :: xyzr(:, :)
    integer(c_int32_t), intent(in), optional :: frame
    integer(c_int32_t), intent(out), optional :: status
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call finish(morula_body_copy_spheres_f32(self%handle, frame_or_input(frame), &
      size(xyzr, 2, c_size_t), xyzr), status)
  end subroutine body_copy_spheres_f32

  subroutine body_copy_masses(self, masses, status)
    class(morula_body_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: masses(:)
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_body_copy_masses(self%handle, size(masses, kind=c_size_t), masses), status)
  end subroutine body_copy_masses

  subroutine body_copy_binding(self, spheres, status)
    class(morula_body_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: spheres(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int32_t) :: code
    code = morula_body_copy_binding(self%handle, size(spheres, kind=c_size_t), spheres)
    if (code == MORULA_STATUS_OK) spheres = spheres + 1
    call finish(code, status)
  end subroutine body_copy_binding

  subroutine body_moments(self, moments, status)
    class(morula_body_t), intent(in) :: self
    type(morula_moments), intent(out) :: moments
    integer(c_int32_t), intent(out), optional :: status
    moments%struct_size = c_sizeof(moments)
    call finish(morula_body_moments(self%handle, moments), status)
  end subroutine body_moments

  subroutine body_masses(self, masses, status)
    class(morula_body_t), intent(in) :: self
    type(morula_masses), intent(out) :: masses
    integer(c_int32_t), intent(out), optional :: status
    masses%struct_size = c_sizeof(masses)
    call finish(morula_body_masses(self%handle, masses), status)
  end subroutine body_masses

  subroutine body_transform(self, placed, scale, position, quaternion, density, status)
    class(morula_body_t), intent(in) :: self
    type(morula_body_t), intent(inout) :: placed
    real(c_double), intent(in) :: scale
    real(c_double), intent(in), optional, target :: position(3), quaternion(4), density
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: made
    real(c_double) :: rho
    integer(c_int32_t) :: code
    rho = 0.0_c_double
    if (present(density)) rho = density
    made = c_null_ptr
    code = morula_body_transform(self%handle, scale, at_doubles(position), &
      at_doubles(quaternion), rho, made)
    call placed%destroy()
    placed%handle = made
    call finish(code, status)
  end subroutine body_transform

  subroutine body_timestep(self, contact, timestep, status)
    class(morula_body_t), intent(in) :: self
    type(morula_contact_options), intent(in) :: contact
    type(morula_timestep), intent(out) :: timestep
    integer(c_int32_t), intent(out), optional :: status
    timestep%struct_size = c_sizeof(timestep)
    call finish(morula_body_timestep(self%handle, contact, timestep), status)
  end subroutine body_timestep

  subroutine body_write(self, format, path, options, status)
    class(morula_body_t), intent(in) :: self
    integer(c_int32_t), intent(in) :: format
    character(*), intent(in) :: path
    type(morula_export_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_body_write(self%handle, format, at_export(options), terminated(path)), &
      status)
  end subroutine body_write

  subroutine body_destroy(self)
    class(morula_body_t), intent(inout) :: self
    call morula_body_free(self%handle)
    self%handle = c_null_ptr
  end subroutine body_destroy

  function body_handle(self) result(handle)
    class(morula_body_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function body_handle

  impure elemental subroutine body_assign(self, other)
    class(morula_body_t), intent(inout) :: self
    class(morula_body_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine body_assign

  impure elemental subroutine body_final(self)
    type(morula_body_t), intent(inout) :: self
    call self%destroy()
  end subroutine body_final

  ! ---- files in memory ----

  subroutine files_create(self, body, format, options, status)
    class(morula_files_t), intent(inout) :: self
    class(morula_body_t), intent(in) :: body
    integer(c_int32_t), intent(in) :: format
    type(morula_export_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_body_export(body%handle, format, at_export(options), self%handle), status)
  end subroutine files_create

  subroutine files_count(self, count, status)
    class(morula_files_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_files_count(self%handle, n), status)
    count = int(n)
  end subroutine files_count

  subroutine files_name(self, index, text, status)
    class(morula_files_t), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable, intent(out) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t), target :: length
    integer(c_size_t) :: at
    integer(c_int32_t) :: code
    at = int(index - 1, c_size_t)
    length = 0
    code = morula_files_copy_name(self%handle, at, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(buffer(length + 1))
    buffer = c_null_char
    if (code == MORULA_STATUS_OK) then
      code = morula_files_copy_name(self%handle, at, length + 1, c_loc(buffer), c_null_ptr)
    end if
    text = morula_text(c_loc(buffer))
    call finish(code, status)
  end subroutine files_name

  subroutine files_bytes(self, index, bytes, status)
    class(morula_files_t), intent(in) :: self
    integer, intent(in) :: index
    integer(c_int8_t), allocatable, intent(out) :: bytes(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: at, size
    integer(c_int32_t) :: code
    at = int(index - 1, c_size_t)
    size = 0
    code = morula_files_size(self%handle, at, size)
    allocate(bytes(size))
    if (code == MORULA_STATUS_OK) code = morula_files_copy_bytes(self%handle, at, size, bytes)
    call finish(code, status)
  end subroutine files_bytes

  subroutine files_destroy(self)
    class(morula_files_t), intent(inout) :: self
    call morula_files_free(self%handle)
    self%handle = c_null_ptr
  end subroutine files_destroy

  function files_handle(self) result(handle)
    class(morula_files_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function files_handle

  impure elemental subroutine files_assign(self, other)
    class(morula_files_t), intent(inout) :: self
    class(morula_files_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine files_assign

  impure elemental subroutine files_final(self)
    type(morula_files_t), intent(inout) :: self
    call self%destroy()
  end subroutine files_final

  ! ---- price lists ----

  subroutine cost_create(self, solid, options, cost, status)
    class(morula_cost_t), intent(inout) :: self
    class(morula_solid_t), intent(in) :: solid
    type(morula_clump_options), intent(in), optional, target :: options
    type(morula_cost_options), intent(in), optional, target :: cost
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_cost_curve(solid%handle, at_clump(options), at_cost(cost), self%handle), status)
  end subroutine cost_create

  subroutine cost_count(self, count, status)
    class(morula_cost_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_cost_count(self%handle, n), status)
    count = int(n)
  end subroutine cost_count

  subroutine cost_cut(self, cut, status)
    class(morula_cost_t), intent(in) :: self
    logical, intent(out) :: cut
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int32_t) :: is
    is = 0
    call finish(morula_cost_cut(self%handle, is), status)
    cut = is /= 0
  end subroutine cost_cut

  subroutine cost_points(self, points, status)
    class(morula_cost_t), intent(in) :: self
    type(morula_cost_point), allocatable, intent(out) :: points(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    integer(c_int32_t) :: code
    n = 0
    code = morula_cost_count(self%handle, n)
    allocate(points(n))
    if (code == MORULA_STATUS_OK) then
      points%struct_size = c_sizeof(points(1))
      code = morula_cost_copy(self%handle, n, points)
    end if
    call finish(code, status)
  end subroutine cost_points

  subroutine cost_clump(self, index, clump, status)
    class(morula_cost_t), intent(in) :: self
    integer, intent(in) :: index
    class(morula_clump_t), intent(inout) :: clump
    integer(c_int32_t), intent(out), optional :: status
    call clump%destroy()
    call finish(morula_cost_clump(self%handle, int(index - 1, c_size_t), clump%handle), status)
  end subroutine cost_clump

  subroutine cost_choose(self, index, why, bounds, status)
    class(morula_cost_t), intent(in) :: self
    integer, intent(out) :: index
    character(:), allocatable, intent(out) :: why
    type(morula_cost_bounds), intent(in), optional, target :: bounds
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t), target :: at, length
    integer(c_int32_t) :: code
    at = 0
    length = 0
    code = morula_cost_choose(self%handle, at_cost_bounds(bounds), at, 0_c_size_t, c_null_ptr, &
      at_size(length))
    allocate(buffer(length + 1))
    buffer = c_null_char
    if (code == MORULA_STATUS_OK) then
      code = morula_cost_choose(self%handle, at_cost_bounds(bounds), at, length + 1, &
        c_loc(buffer), c_null_ptr)
    end if
    why = morula_text(c_loc(buffer))
    index = int(at) + 1
    call finish(code, status)
  end subroutine cost_choose

  subroutine cost_destroy(self)
    class(morula_cost_t), intent(inout) :: self
    call morula_cost_free(self%handle)
    self%handle = c_null_ptr
  end subroutine cost_destroy

  function cost_handle(self) result(handle)
    class(morula_cost_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function cost_handle

  impure elemental subroutine cost_assign(self, other)
    class(morula_cost_t), intent(inout) :: self
    class(morula_cost_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine cost_assign

  impure elemental subroutine cost_final(self)
    type(morula_cost_t), intent(inout) :: self
    call self%destroy()
  end subroutine cost_final

  subroutine sweep_create(self, shape, resolutions, methods, efforts, deadlines, solid, options, &
      cost, status)
    class(morula_sweep_t), intent(inout) :: self
    class(morula_shape_t), intent(in) :: shape
    real(c_double), intent(in) :: resolutions(:)
    integer(c_int32_t), intent(in) :: methods(:)
    integer(c_int32_t), intent(in), optional :: efforts(:)
    real(c_double), intent(in), optional :: deadlines(:)
    type(morula_solid_options), intent(in), optional, target :: solid
    type(morula_clump_options), intent(in), optional, target :: options
    type(morula_cost_options), intent(in), optional, target :: cost
    integer(c_int32_t), intent(out), optional :: status
    real(c_double), target :: grids(max(1, size(resolutions)))
    integer(c_int32_t), target :: ways(max(1, size(methods))), hard(max(1, size(methods)))
    real(c_double), allocatable, target :: seconds(:)
    type(morula_sweep_options) :: what
    call self%destroy()
    call morula_init(what)
    grids(:size(resolutions)) = resolutions
    ways(:size(methods)) = methods
    what%resolutions = c_loc(grids)
    what%resolution_count = size(resolutions, kind=c_size_t)
    what%methods = c_loc(ways)
    what%method_count = size(methods, kind=c_size_t)
    if (present(efforts)) then
      if (size(efforts) /= size(methods)) error stop 'morula: as many efforts as methods are needed'
      hard(:size(efforts)) = efforts
      what%efforts = c_loc(hard)
    end if
    if (present(deadlines)) then
      seconds = [deadlines, 0.0_c_double]
      what%deadline_count = size(deadlines, kind=c_size_t)
    else
      seconds = [0.0_c_double]
      what%deadline_count = 1
    end if
    what%deadlines = c_loc(seconds)
    call finish(morula_sweep_from_shape(shape%handle, at_solid(solid), at_clump(options), &
      at_cost(cost), what, self%handle), status)
  end subroutine sweep_create

  subroutine sweep_count(self, count, status)
    class(morula_sweep_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_sweep_count(self%handle, n), status)
    count = int(n)
  end subroutine sweep_count

  subroutine sweep_lists(self, lists, status)
    class(morula_sweep_t), intent(in) :: self
    type(morula_swept), allocatable, intent(out) :: lists(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    integer(c_int32_t) :: code
    n = 0
    code = morula_sweep_count(self%handle, n)
    allocate(lists(n))
    if (code == MORULA_STATUS_OK) then
      lists%struct_size = c_sizeof(lists(1))
      code = morula_sweep_copy(self%handle, n, lists)
    end if
    call finish(code, status)
  end subroutine sweep_lists

  subroutine sweep_curve(self, index, list, status)
    class(morula_sweep_t), intent(in) :: self
    integer, intent(in) :: index
    class(morula_cost_t), intent(inout) :: list
    integer(c_int32_t), intent(out), optional :: status
    call list%destroy()
    call finish(morula_sweep_curve(self%handle, int(index - 1, c_size_t), list%handle), status)
  end subroutine sweep_curve

  subroutine sweep_destroy(self)
    class(morula_sweep_t), intent(inout) :: self
    call morula_sweep_free(self%handle)
    self%handle = c_null_ptr
  end subroutine sweep_destroy

  function sweep_handle(self) result(handle)
    class(morula_sweep_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function sweep_handle

  impure elemental subroutine sweep_assign(self, other)
    class(morula_sweep_t), intent(inout) :: self
    class(morula_sweep_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine sweep_assign

  impure elemental subroutine sweep_final(self)
    type(morula_sweep_t), intent(inout) :: self
    call self%destroy()
  end subroutine sweep_final

  ! ---- particles that may break ----

  subroutine parent_from_clump(self, solid, clump, threads, status)
    class(morula_parent_t), intent(inout) :: self
    class(morula_solid_t), intent(in) :: solid
    class(morula_clump_t), intent(in) :: clump
    integer, intent(in), optional :: threads
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_parent_from_clump(solid%handle, clump%handle, threads_or_1(threads), &
      self%handle), status)
  end subroutine parent_from_clump

  subroutine parent_from_spheres(self, solid, xyzr, threads, status)
    class(morula_parent_t), intent(inout) :: self
    class(morula_solid_t), intent(in) :: solid
    real(c_double), intent(in), contiguous :: xyzr(:, :)
    integer, intent(in), optional :: threads
    integer(c_int32_t), intent(out), optional :: status
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call self%destroy()
    call finish(morula_parent_from_solid(solid%handle, xyzr, size(xyzr, 2, c_size_t), &
      threads_or_1(threads), self%handle), status)
  end subroutine parent_from_spheres

  subroutine parent_from_cache(self, cache, shape, xyzr, options, status)
    class(morula_parent_t), intent(inout) :: self
    class(morula_cache_t), intent(in) :: cache
    class(morula_shape_t), intent(in) :: shape
    real(c_double), intent(in), contiguous :: xyzr(:, :)
    type(morula_solid_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call self%destroy()
    call finish(morula_cache_parent(cache%handle, shape%handle, at_solid(options), xyzr, &
      size(xyzr, 2, c_size_t), self%handle), status)
  end subroutine parent_from_cache

  pure function threads_or_1(threads) result(n)
    integer, intent(in), optional :: threads
    integer(c_int32_t) :: n
    n = 1_c_int32_t
    if (present(threads)) n = int(threads, c_int32_t)
  end function threads_or_1

  subroutine parent_held(self, held, density, scale, position, quaternion, velocity, &
      angular_velocity, status)
    class(morula_parent_t), intent(in) :: self
    type(morula_held), intent(out) :: held
    real(c_double), intent(in) :: density
    real(c_double), intent(in), optional, target :: scale, position(3), quaternion(4), velocity(3)
    real(c_double), intent(in), optional, target :: angular_velocity(3)
    integer(c_int32_t), intent(out), optional :: status
    real(c_double) :: factor
    factor = 1.0_c_double
    if (present(scale)) factor = scale
    held%struct_size = c_sizeof(held)
    call finish(morula_parent_held(self%handle, density, factor, at_doubles(position), &
      at_doubles(quaternion), at_doubles(velocity), at_doubles(angular_velocity), held), status)
  end subroutine parent_held

  subroutine parent_bytes(self, bytes, status)
    class(morula_parent_t), intent(in) :: self
    integer(c_int64_t), intent(out) :: bytes
    integer(c_int32_t), intent(out), optional :: status
    bytes = 0
    call finish(morula_parent_bytes(self%handle, bytes), status)
  end subroutine parent_bytes

  !> All breaks of one time step: of parents(n), or of fragment indices(i) of from(i), as they are
  !> held; options(n), if given, say how, and whose threads are options(1)'s. With statuses(n)
  !> every break that succeeds is made; without, all of them or none.
  subroutine morula_break_all(parents, held, fragments, options, from, indices, statuses, status)
    class(morula_parent_t), intent(in) :: parents(:)
    type(morula_held), intent(in), contiguous :: held(:)
    class(morula_fragments_t), intent(inout) :: fragments(:)
    type(morula_break_options), intent(in), contiguous, optional, target :: options(:)
    class(morula_fragments_t), intent(in), optional :: from(:)
    integer, intent(in), optional :: indices(:)
    integer(c_int32_t), intent(out), contiguous, optional, target :: statuses(:)
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr), target :: handles(size(parents)), origins(size(parents)), made(size(parents))
    integer(c_size_t), target :: numbers(size(parents))
    integer(c_int32_t) :: code
    integer :: i
    if (size(held) /= size(parents) .or. size(fragments) /= size(parents)) then
      error stop 'morula: a held body and fragments for each parent'
    end if
    origins = c_null_ptr
    made = c_null_ptr
    numbers = 0
    do i = 1, size(parents)
      handles(i) = parents(i)%handle
      if (present(from) .and. present(indices)) then
        origins(i) = from(i)%handle
        numbers(i) = int(indices(i) - 1, c_size_t)
      end if
    end do
    code = morula_parents_break(handles, at_pointers(origins), at_sizes(numbers), held, &
      at_breaks(options), size(parents, kind=c_size_t), made, at_int32s(statuses))
    do i = 1, size(parents)
      call fragments(i)%destroy()
      fragments(i)%handle = made(i)
    end do
    call finish(code, status)
  end subroutine morula_break_all

  subroutine parent_destroy(self)
    class(morula_parent_t), intent(inout) :: self
    call morula_parent_free(self%handle)
    self%handle = c_null_ptr
  end subroutine parent_destroy

  function parent_handle(self) result(handle)
    class(morula_parent_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function parent_handle

  impure elemental subroutine parent_assign(self, other)
    class(morula_parent_t), intent(inout) :: self
    class(morula_parent_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine parent_assign

  impure elemental subroutine parent_final(self)
    type(morula_parent_t), intent(inout) :: self
    call self%destroy()
  end subroutine parent_final

  ! ---- parents that are used again ----

  subroutine cache_create(self, limit, status)
    class(morula_cache_t), intent(inout) :: self
    integer(c_int64_t), intent(in) :: limit
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_cache_new(limit, self%handle), status)
  end subroutine cache_create

  subroutine cache_counters(self, counters, status)
    class(morula_cache_t), intent(in) :: self
    type(morula_cache_counts), intent(out) :: counters
    integer(c_int32_t), intent(out), optional :: status
    counters%struct_size = c_sizeof(counters)
    call finish(morula_cache_counters(self%handle, counters), status)
  end subroutine cache_counters

  subroutine cache_clear(self, status)
    class(morula_cache_t), intent(in) :: self
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_cache_clear(self%handle), status)
  end subroutine cache_clear

  subroutine cache_destroy(self)
    class(morula_cache_t), intent(inout) :: self
    call morula_cache_free(self%handle)
    self%handle = c_null_ptr
  end subroutine cache_destroy

  function cache_handle(self) result(handle)
    class(morula_cache_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function cache_handle

  impure elemental subroutine cache_assign(self, other)
    class(morula_cache_t), intent(inout) :: self
    class(morula_cache_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine cache_assign

  impure elemental subroutine cache_final(self)
    type(morula_cache_t), intent(inout) :: self
    call self%destroy()
  end subroutine cache_final

  ! ---- fragments ----

  subroutine fragments_serialize(self, index, bytes, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    integer(c_int8_t), allocatable, intent(out), target :: bytes(:)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t), target :: length, at
    integer(c_int32_t) :: code
    length = 0
    at = int(index - 1, c_size_t)
    code = morula_fragments_serialize(self%handle, at, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(bytes(length))
    if (code == MORULA_STATUS_OK) then
      code = morula_fragments_serialize(self%handle, at, length, at_int8s(bytes), c_null_ptr)
    end if
    call finish(code, status)
  end subroutine fragments_serialize

  subroutine fragments_deserialize(self, parent, bytes, held, status)
    class(morula_fragments_t), intent(inout) :: self
    class(morula_parent_t), intent(in) :: parent
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    type(morula_held), intent(in) :: held
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_fragments_deserialize(parent%handle, bytes, size(bytes, kind=c_size_t), &
      held, self%handle), status)
  end subroutine fragments_deserialize

  subroutine fragments_of_parent(self, parent, held, options, status)
    class(morula_fragments_t), intent(inout) :: self
    class(morula_parent_t), intent(in) :: parent
    type(morula_held), intent(in) :: held
    type(morula_break_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    call self%destroy()
    call finish(morula_parent_break(parent%handle, c_null_ptr, 0_c_size_t, held, &
      at_break(options), self%handle), status)
  end subroutine fragments_of_parent

  subroutine fragments_of_fragment(self, from, index, held, options, status)
    class(morula_fragments_t), intent(inout) :: self
    class(morula_fragments_t), intent(in) :: from
    integer, intent(in) :: index
    type(morula_held), intent(in) :: held
    type(morula_break_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: made
    integer(c_int32_t) :: code
    made = c_null_ptr
    code = morula_parent_break(c_null_ptr, from%handle, int(index - 1, c_size_t), held, &
      at_break(options), made)
    call self%destroy()
    self%handle = made
    call finish(code, status)
  end subroutine fragments_of_fragment

  subroutine fragments_from_labels(self, labels, xyzr, held, spacing, origin, options, &
      solid_options, status)
    class(morula_fragments_t), intent(inout) :: self
    integer(c_int32_t), intent(in), contiguous :: labels(:, :, :)
    real(c_double), intent(in), contiguous :: xyzr(:, :)
    type(morula_held), intent(in) :: held
    real(c_double), intent(in), optional, target :: spacing(3), origin(3)
    type(morula_break_options), intent(in), optional, target :: options
    type(morula_solid_options), intent(in), optional, target :: solid_options
    integer(c_int32_t), intent(out), optional :: status
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call self%destroy()
    call finish(morula_fragments_from_labels(labels, shape(labels, c_size_t), &
      at_doubles(spacing), at_doubles(origin), at_solid(solid_options), xyzr, &
      size(xyzr, 2, c_size_t), held, at_break(options), self%handle), status)
  end subroutine fragments_from_labels

  subroutine fragments_reclump(self, solid, xyzr, held, options, status)
    class(morula_fragments_t), intent(inout) :: self
    class(morula_solid_t), intent(in) :: solid
    real(c_double), intent(in), contiguous :: xyzr(:, :)
    type(morula_held), intent(in) :: held
    type(morula_break_options), intent(in), optional, target :: options
    integer(c_int32_t), intent(out), optional :: status
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call self%destroy()
    call finish(morula_reclump_shape(solid%handle, xyzr, size(xyzr, 2, c_size_t), held, &
      at_break(options), self%handle), status)
  end subroutine fragments_reclump

  subroutine fragments_count(self, count, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_fragments_count(self%handle, n), status)
    count = int(n)
  end subroutine fragments_count

  subroutine fragments_dust_count(self, count, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_fragments_dust_count(self%handle, n), status)
    count = int(n)
  end subroutine fragments_dust_count

  subroutine fragments_get(self, index, fragment, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    type(morula_fragment), intent(out) :: fragment
    integer(c_int32_t), intent(out), optional :: status
    fragment%struct_size = c_sizeof(fragment)
    call finish(morula_fragments_get(self%handle, int(index - 1, c_size_t), fragment), status)
  end subroutine fragments_get

  subroutine fragments_dust(self, index, dust, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    type(morula_fragment), intent(out) :: dust
    integer(c_int32_t), intent(out), optional :: status
    dust%struct_size = c_sizeof(dust)
    call finish(morula_fragments_dust(self%handle, int(index - 1, c_size_t), dust), status)
  end subroutine fragments_dust

  subroutine fragments_totals(self, totals, status)
    class(morula_fragments_t), intent(in) :: self
    type(morula_break_totals), intent(out) :: totals
    integer(c_int32_t), intent(out), optional :: status
    totals%struct_size = c_sizeof(totals)
    call finish(morula_fragments_totals(self%handle, totals), status)
  end subroutine fragments_totals

  subroutine fragments_held(self, index, held, position, quaternion, velocity, &
      angular_velocity, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    type(morula_held), intent(out) :: held
    real(c_double), intent(in), optional, target :: position(3), quaternion(4), velocity(3)
    real(c_double), intent(in), optional, target :: angular_velocity(3)
    integer(c_int32_t), intent(out), optional :: status
    held%struct_size = c_sizeof(held)
    call finish(morula_fragments_held(self%handle, int(index - 1, c_size_t), &
      at_doubles(position), at_doubles(quaternion), at_doubles(velocity), &
      at_doubles(angular_velocity), held), status)
  end subroutine fragments_held

  subroutine fragments_copy_spheres(self, index, xyzr, frame, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    real(c_double), intent(inout), contiguous :: xyzr(:, :)
    integer(c_int32_t), intent(in), optional :: frame
    integer(c_int32_t), intent(out), optional :: status
    if (size(xyzr, 1) /= 4) error stop 'morula: xyzr is an array (4, n)'
    call finish(morula_fragments_copy_spheres(self%handle, int(index - 1, c_size_t), &
      frame_or_input(frame), size(xyzr, 2, c_size_t), xyzr), status)
  end subroutine fragments_copy_spheres

  subroutine fragments_copy_masses(self, index, masses, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    real(c_double), intent(inout), contiguous :: masses(:)
    integer(c_int32_t), intent(out), optional :: status
    call finish(morula_fragments_copy_masses(self%handle, int(index - 1, c_size_t), &
      size(masses, kind=c_size_t), masses), status)
  end subroutine fragments_copy_masses

  subroutine fragments_copy_map(self, index, starts, parents, shares, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    integer(c_int32_t), allocatable, intent(out) :: starts(:), parents(:)
    real(c_double), allocatable, intent(out) :: shares(:)
    integer(c_int32_t), intent(out), optional :: status
    type(morula_fragment) :: fragment
    integer(c_size_t) :: at
    integer(c_int32_t) :: code
    at = int(index - 1, c_size_t)
    fragment%struct_size = c_sizeof(fragment)
    code = morula_fragments_get(self%handle, at, fragment)
    allocate(starts(fragment%sphere_count + 1), parents(fragment%map_count))
    allocate(shares(fragment%map_count))
    if (code == MORULA_STATUS_OK) then
      code = morula_fragments_copy_map(self%handle, at, starts, size(parents, kind=c_size_t), &
        parents, shares)
    end if
    if (code == MORULA_STATUS_OK) then
      starts = starts + 1
      parents = parents + 1
    end if
    call finish(code, status)
  end subroutine fragments_copy_map

  subroutine fragments_copy_half_spaces(self, index, half_spaces, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    real(c_double), intent(inout), contiguous :: half_spaces(:, :)
    integer(c_int32_t), intent(out), optional :: status
    if (size(half_spaces, 1) /= 4) error stop 'morula: half_spaces is an array (4, n)'
    call finish(morula_fragments_copy_half_spaces(self%handle, int(index - 1, c_size_t), &
      size(half_spaces, 2, c_size_t), half_spaces), status)
  end subroutine fragments_copy_half_spaces

  subroutine fragments_shape(self, index, shape, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    class(morula_shape_t), intent(inout) :: shape
    integer(c_int32_t), intent(out), optional :: status
    call shape%destroy()
    call finish(morula_fragments_shape(self%handle, int(index - 1, c_size_t), shape%handle), status)
  end subroutine fragments_shape

  subroutine fragments_grow(self, index, part, others, xyzr, gap, frame, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    real(c_double), intent(in) :: part
    real(c_double), intent(in), contiguous :: others(:, :)
    real(c_double), intent(inout), contiguous :: xyzr(:, :)
    real(c_double), intent(in), optional :: gap
    integer(c_int32_t), intent(in), optional :: frame
    integer(c_int32_t), intent(out), optional :: status
    real(c_double) :: apart
    if (size(xyzr, 1) /= 4 .or. size(others, 1) /= 4) error stop 'morula: spheres are arrays (4, n)'
    apart = 0.0_c_double
    if (present(gap)) apart = gap
    call finish(morula_fragments_grow(self%handle, int(index - 1, c_size_t), part, others, &
      size(others, 2, c_size_t), apart, frame_or_input(frame), size(xyzr, 2, c_size_t), xyzr), &
      status)
  end subroutine fragments_grow

  subroutine fragments_note_count(self, count, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(out) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_size_t) :: n
    n = 0
    call finish(morula_fragments_note_count(self%handle, n), status)
    count = int(n)
  end subroutine fragments_note_count

  subroutine fragments_note(self, index, text, status)
    class(morula_fragments_t), intent(in) :: self
    integer, intent(in) :: index
    character(:), allocatable, intent(out) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t), target :: at, length
    integer(c_int32_t) :: code
    at = int(index - 1, c_size_t)
    length = 0
    code = morula_fragments_copy_note(self%handle, at, 0_c_size_t, c_null_ptr, at_size(length))
    allocate(buffer(length + 1))
    buffer = c_null_char
    if (code == MORULA_STATUS_OK) then
      code = morula_fragments_copy_note(self%handle, at, length + 1, c_loc(buffer), c_null_ptr)
    end if
    text = morula_text(c_loc(buffer))
    call finish(code, status)
  end subroutine fragments_note

  subroutine fragments_destroy(self)
    class(morula_fragments_t), intent(inout) :: self
    call morula_fragments_free(self%handle)
    self%handle = c_null_ptr
  end subroutine fragments_destroy

  function fragments_handle(self) result(handle)
    class(morula_fragments_t), intent(in) :: self
    type(c_ptr) :: handle
    handle = self%handle
  end function fragments_handle

  impure elemental subroutine fragments_assign(self, other)
    class(morula_fragments_t), intent(inout) :: self
    class(morula_fragments_t), intent(in) :: other
    if (c_associated(self%handle) .or. c_associated(other%handle)) call refuse_assignment()
  end subroutine fragments_assign

  impure elemental subroutine fragments_final(self)
    type(morula_fragments_t), intent(inout) :: self
    call self%destroy()
  end subroutine fragments_final

end module morula
