! Morula for Fortran: the shape of a particle as a clump of overlapping spheres.
!
! Compile this file with your own compiler (CMake: link morula::fortran). It has
! two layers. The first is one bind(c) interface for each function of morula.h,
! with the same names, and its structs as bind(c) types. The second are the types
! morula_shape_t, morula_solid_t and morula_clump_t, which hold a handle:
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
! Triangle indices are counted from 1 here, notes and plane tolerances too.
! C's unsigned integers are Fortran's signed ones of the same size.
module morula
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  private

  ! ---- constants of morula.h ----

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
  integer(c_int32_t), parameter, public :: MORULA_RESOLUTION_CELLS_LONGEST = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RESOLUTION_CELLS_SHORTEST = 1_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RESOLUTION_CELLS_DIAMETER = 2_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_RESOLUTION_CELL_SIZE = 3_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_METHOD_MSS = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FRAME_INPUT = 0_c_int32_t
  integer(c_int32_t), parameter, public :: MORULA_FRAME_BODY = 1_c_int32_t
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
    real(c_double) :: roughness = 0.0_c_double
    integer(c_int64_t) :: samples = 0_c_int64_t
    integer(c_int32_t) :: never_exposed = 0_c_int32_t
    integer(c_int32_t) :: reserved = 0_c_int32_t
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

  ! ---- functions of morula.h ----

  public :: morula_version
  public :: morula_version_string
  public :: morula_status_name
  public :: morula_last_error_message
  public :: morula_sizeof
  public :: morula_set_log
  public :: morula_import_options_init
  public :: morula_shape_from_mesh
  public :: morula_shape_free
  public :: morula_shape_report
  public :: morula_shape_note_count
  public :: morula_shape_copy_note
  public :: morula_shape_moments
  public :: morula_file_options_init
  public :: morula_shape_from_file
  public :: morula_shape_from_bytes
  public :: morula_shape_from_mask
  public :: morula_shape_from_grey_u8
  public :: morula_shape_from_grey_u16
  public :: morula_shape_from_grey_f32
  public :: morula_shape_from_label
  public :: morula_labels_count
  public :: morula_labels_copy
  public :: morula_primitive_name
  public :: morula_primitive_parameter_count
  public :: morula_primitive_copy_parameter
  public :: morula_shape_from_primitive
  public :: morula_solid_options_init
  public :: morula_solid_from_shape
  public :: morula_solid_free
  public :: morula_solid_grid
  public :: morula_solid_distance
  public :: morula_solid_note_count
  public :: morula_solid_copy_note
  public :: morula_solid_moments
  public :: morula_clump_options_init
  public :: morula_clump_from_shape
  public :: morula_clump_from_solid
  public :: morula_clump_free
  public :: morula_clump_sphere_count
  public :: morula_clump_copy_spheres
  public :: morula_clump_stopped
  public :: morula_stopped_name
  public :: morula_clump_copy_note
  public :: morula_clump_moments
  public :: morula_clump_overlap
  public :: morula_clump_surface
  public :: morula_clump_copy_exposed_areas
  public :: morula_clump_copy_plane_contacts
  public :: morula_clump_counters

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
      type(morula_import_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: shape
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
      integer(c_size_t), intent(inout), optional :: length
      integer(c_int32_t) :: r
    end function morula_shape_copy_note
    function morula_shape_moments(shape, density, moments) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      real(c_double), value :: density
      type(morula_moments), intent(inout) :: moments
      integer(c_int32_t) :: r
    end function morula_shape_moments
    function morula_file_options_init(options, size) bind(c) result(r)
      import
      type(morula_file_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_file_options_init
    function morula_shape_from_file(path, import, file, shape) bind(c) result(r)
      import
      character(kind=c_char), intent(in) :: path(*)
      type(morula_import_options), intent(in), optional :: import
      type(morula_file_options), intent(in), optional :: file
      type(c_ptr), intent(out) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_file
    function morula_shape_from_bytes(bytes, count, name, import, file, shape) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: bytes(*)
      integer(c_size_t), value :: count
      character(kind=c_char), intent(in) :: name(*)
      type(morula_import_options), intent(in), optional :: import
      type(morula_file_options), intent(in), optional :: file
      type(c_ptr), intent(out) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_bytes
    function morula_shape_from_mask(mask, dims, spacing, origin, options, shape) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: mask(*)
      integer(c_size_t), intent(in) :: dims(*)
      real(c_double), intent(in), optional :: spacing(*)
      real(c_double), intent(in), optional :: origin(*)
      type(morula_import_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_mask
    function morula_shape_from_grey_u8(values, dims, spacing, origin, threshold, options, &
        shape) bind(c) result(r)
      import
      integer(c_int8_t), intent(in) :: values(*)
      integer(c_size_t), intent(in) :: dims(*)
      real(c_double), intent(in), optional :: spacing(*)
      real(c_double), intent(in), optional :: origin(*)
      real(c_double), intent(in), optional :: threshold(*)
      type(morula_import_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_grey_u8
    function morula_shape_from_grey_u16(values, dims, spacing, origin, threshold, options, &
        shape) bind(c) result(r)
      import
      integer(c_int16_t), intent(in) :: values(*)
      integer(c_size_t), intent(in) :: dims(*)
      real(c_double), intent(in), optional :: spacing(*)
      real(c_double), intent(in), optional :: origin(*)
      real(c_double), intent(in), optional :: threshold(*)
      type(morula_import_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_grey_u16
    function morula_shape_from_grey_f32(values, dims, spacing, origin, threshold, options, &
        shape) bind(c) result(r)
      import
      real(c_float), intent(in) :: values(*)
      integer(c_size_t), intent(in) :: dims(*)
      real(c_double), intent(in), optional :: spacing(*)
      real(c_double), intent(in), optional :: origin(*)
      real(c_double), intent(in), optional :: threshold(*)
      type(morula_import_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: shape
      integer(c_int32_t) :: r
    end function morula_shape_from_grey_f32
    function morula_shape_from_label(labels, dims, spacing, origin, label, options, &
        shape) bind(c) result(r)
      import
      integer(c_int32_t), intent(in) :: labels(*)
      integer(c_size_t), intent(in) :: dims(*)
      real(c_double), intent(in), optional :: spacing(*)
      real(c_double), intent(in), optional :: origin(*)
      integer(c_int32_t), value :: label
      type(morula_import_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: shape
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
      integer(c_int32_t), intent(inout), optional :: ids(*)
      integer(c_int64_t), intent(inout), optional :: cells(*)
      integer(c_int64_t), intent(inout), optional :: boxes(*)
      integer(c_int32_t), intent(inout), optional :: touches_border(*)
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
      integer(c_size_t), intent(inout), optional :: length
      real(c_double), intent(inout), optional :: value
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
      type(morula_import_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: shape
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
      type(morula_solid_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: solid
      integer(c_int32_t) :: r
    end function morula_solid_from_shape
    subroutine morula_solid_free(solid) bind(c)
      import
      type(c_ptr), value :: solid
    end subroutine morula_solid_free
    function morula_solid_grid(solid, dims, spacing, origin) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      integer(c_size_t), intent(inout), optional :: dims(*)
      real(c_double), intent(inout), optional :: spacing(*)
      real(c_double), intent(inout), optional :: origin(*)
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
      integer(c_size_t), intent(inout), optional :: length
      integer(c_int32_t) :: r
    end function morula_solid_copy_note
    function morula_solid_moments(solid, density, moments) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      real(c_double), value :: density
      type(morula_moments), intent(inout) :: moments
      integer(c_int32_t) :: r
    end function morula_solid_moments
    function morula_clump_options_init(options, size) bind(c) result(r)
      import
      type(morula_clump_options), intent(out) :: options
      integer(c_size_t), value :: size
      integer(c_int32_t) :: r
    end function morula_clump_options_init
    function morula_clump_from_shape(shape, solid_options, options, clump) bind(c) result(r)
      import
      type(c_ptr), value :: shape
      type(morula_solid_options), intent(in), optional :: solid_options
      type(morula_clump_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: clump
      integer(c_int32_t) :: r
    end function morula_clump_from_shape
    function morula_clump_from_solid(solid, options, clump) bind(c) result(r)
      import
      type(c_ptr), value :: solid
      type(morula_clump_options), intent(in), optional :: options
      type(c_ptr), intent(out) :: clump
      integer(c_int32_t) :: r
    end function morula_clump_from_solid
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
      integer(c_size_t), intent(inout), optional :: length
      integer(c_int32_t) :: r
    end function morula_clump_copy_note
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
  end interface
