! Calls every function of the module, compares every struct's size with the
! library's, and holds the layouts against an L without symmetry.
module checks
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use morula
  implicit none
  integer :: made = 0, failed = 0
  real(c_double) :: last_fraction = 0
  integer :: lines = 0
contains
  subroutine check(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    made = made + 1
    if (condition) return
    failed = failed + 1
    write (error_unit, '(5a)') 'not so: ', what, ' (last message: "', morula_message(), '")'
  end subroutine check

  subroutine near(a, b, tolerance, what)
    real(c_double), intent(in) :: a, b, tolerance
    character(*), intent(in) :: what
    call check(abs(a - b) <= tolerance, what)
  end subroutine near

  function progress(fraction, user) bind(c) result(cancel)
    real(c_double), value :: fraction
    type(c_ptr), value :: user
    integer(c_int32_t) :: cancel
    call check(.not. c_associated(user), 'user data comes through')
    call check(fraction >= last_fraction .and. fraction <= 1, 'progress never falls')
    last_fraction = fraction
    cancel = 0
  end function progress

  function stop_at_once(fraction, user) bind(c) result(cancel)
    real(c_double), value :: fraction
    type(c_ptr), value :: user
    integer(c_int32_t) :: cancel
    cancel = merge(1_c_int32_t, 2_c_int32_t, fraction > 2 .or. c_associated(user))
  end function stop_at_once

  subroutine sink(level, text)
    integer(c_int32_t), intent(in) :: level
    character(*), intent(in) :: text
    call check(level >= 0 .and. len(text) > 0, 'a line of log')
    lines = lines + 1
  end subroutine sink

  subroutine sizes()
    type(morula_import_options) :: import_options
    type(morula_file_options) :: file_options
    type(morula_solid_options) :: solid_options
    type(morula_clump_options) :: clump_options
    type(morula_report) :: report
    type(morula_moments) :: moments
    type(morula_overlap) :: overlap
    type(morula_surface) :: surface
    type(morula_counters) :: counters
    type(morula_break_options) :: break_options
    type(morula_held) :: held
    type(morula_fragment) :: fragment
    type(morula_break_totals) :: break_totals
    type(morula_cache_counts) :: cache_counts
    type(morula_cost_options) :: cost_options
    type(morula_cost_point) :: cost_point
    type(morula_cost_bounds) :: cost_bounds
    type(morula_sweep_options) :: sweep_options
    type(morula_swept) :: swept
    type(morula_mass_options) :: mass_options
    type(morula_masses) :: masses
    type(morula_contact_options) :: contact_options
    type(morula_timestep) :: timestep
    type(morula_export_options) :: export_options
    call same_size(MORULA_STRUCT_IMPORT_OPTIONS, c_sizeof(import_options))
    call same_size(MORULA_STRUCT_FILE_OPTIONS, c_sizeof(file_options))
    call same_size(MORULA_STRUCT_SOLID_OPTIONS, c_sizeof(solid_options))
    call same_size(MORULA_STRUCT_CLUMP_OPTIONS, c_sizeof(clump_options))
    call same_size(MORULA_STRUCT_REPORT, c_sizeof(report))
    call same_size(MORULA_STRUCT_MOMENTS, c_sizeof(moments))
    call same_size(MORULA_STRUCT_OVERLAP, c_sizeof(overlap))
    call same_size(MORULA_STRUCT_SURFACE, c_sizeof(surface))
    call same_size(MORULA_STRUCT_COUNTERS, c_sizeof(counters))
    call same_size(MORULA_STRUCT_MASS_OPTIONS, c_sizeof(mass_options))
    call same_size(MORULA_STRUCT_MASSES, c_sizeof(masses))
    call same_size(MORULA_STRUCT_CONTACT_OPTIONS, c_sizeof(contact_options))
    call same_size(MORULA_STRUCT_TIMESTEP, c_sizeof(timestep))
    call same_size(MORULA_STRUCT_EXPORT_OPTIONS, c_sizeof(export_options))
    call same_size(MORULA_STRUCT_BREAK_OPTIONS, c_sizeof(break_options))
    call same_size(MORULA_STRUCT_HELD, c_sizeof(held))
    call same_size(MORULA_STRUCT_FRAGMENT, c_sizeof(fragment))
    call same_size(MORULA_STRUCT_BREAK_TOTALS, c_sizeof(break_totals))
    call same_size(MORULA_STRUCT_CACHE_COUNTS, c_sizeof(cache_counts))
    call same_size(MORULA_STRUCT_COST_OPTIONS, c_sizeof(cost_options))
    call same_size(MORULA_STRUCT_COST_POINT, c_sizeof(cost_point))
    call same_size(MORULA_STRUCT_COST_BOUNDS, c_sizeof(cost_bounds))
    call same_size(MORULA_STRUCT_SWEEP_OPTIONS, c_sizeof(sweep_options))
    call same_size(MORULA_STRUCT_SWEPT, c_sizeof(swept))
    call check(morula_sizeof(MORULA_STRUCT_SWEPT + 1) == 0, 'every struct is compared')
  end subroutine sizes

  subroutine same_size(which, ours)
    integer(c_int32_t), intent(in) :: which
    integer(c_size_t), intent(in) :: ours
    call check(morula_sizeof(which) == ours, 'a struct has the size that the library gives it')
  end subroutine same_size

  ! An L of four unit cubes, moved by (10, 20, 30); triangles counted from 1.
  subroutine l_mesh(vertices, triangles)
    real(c_double), intent(out) :: vertices(3, 12)
    integer(c_int32_t), intent(out) :: triangles(3, 20)
    real(c_double), parameter :: corners(2, 6) = reshape([real(c_double) :: &
      0, 0, 3, 0, 3, 1, 1, 1, 1, 2, 0, 2], [2, 6])
    integer :: i, j, t
    do i = 1, 6
      vertices(:, i) = [10 + corners(1, i), 20 + corners(2, i), 30.0_c_double]
      vertices(:, i + 6) = vertices(:, i) + [0, 0, 1]
    end do
    t = 0
    do i = 2, 5
      triangles(:, t + 1) = [i + 1, i, 1]
      triangles(:, t + 2) = [7, i + 6, i + 7]
      t = t + 2
    end do
    do i = 1, 6
      j = mod(i, 6) + 1
      triangles(:, t + 1) = [i, j, j + 6]
      triangles(:, t + 2) = [i, j + 6, i + 6]
      t = t + 2
    end do
  end subroutine l_mesh

  subroutine l_moments(m)
    type(morula_moments), intent(in) :: m
    real(c_double) :: r(3, 3), tensor(3, 3), d(3, 3), i_xy
    integer :: i
    call near(m%volume, 4.0_c_double, 1e-12_c_double, 'volume')
    call near(m%mass, 8.0_c_double, 1e-12_c_double, 'mass')
    call near(m%centre(1), 11.25_c_double, 1e-12_c_double, 'centre x')
    call near(m%centre(2), 20.75_c_double, 1e-12_c_double, 'centre y')
    call near(m%centre(3), 30.5_c_double, 1e-12_c_double, 'centre z')
    ! Cubes of mass 2 at (x, y) less the centre; xy is minus the integral of x y dm.
    i_xy = -2 * ((-0.75d0) * (-0.25d0) + 0.25d0 * (-0.25d0) + 1.25d0 * (-0.25d0) + (-0.75d0) * 0.75d0)
    call near(m%inertia(4), i_xy, 1e-10_c_double, 'product of inertia xy')
    call check(i_xy > 0.1, 'its sign')
    call near(m%inertia(1), 8.0_c_double / 6 + 2 * (3 * 0.25d0**2 + 0.75d0**2), 1e-10_c_double, 'xx')
    ! A rotation by columns reads the same here: r(:, j) is body axis j.
    r = reshape(m%rotation, [3, 3])
    d = 0
    do i = 1, 3
      d(i, i) = m%principal(i)
    end do
    tensor = matmul(r, matmul(d, transpose(r)))
    call near(tensor(1, 1), m%inertia(1), 1e-10_c_double, 'R D R^T xx')
    call near(tensor(2, 2), m%inertia(2), 1e-10_c_double, 'R D R^T yy')
    call near(tensor(3, 3), m%inertia(3), 1e-10_c_double, 'R D R^T zz')
    call near(tensor(1, 2), m%inertia(4), 1e-10_c_double, 'R D R^T xy')
    call near(tensor(1, 3), m%inertia(5), 1e-10_c_double, 'R D R^T xz')
    call near(tensor(2, 3), m%inertia(6), 1e-10_c_double, 'R D R^T yz')
    ! The quaternion's first column.
    associate (q => m%quaternion)
      call near(1 - 2 * (q(3)**2 + q(4)**2), r(1, 1), 1e-12_c_double, 'quaternion xx')
      call near(2 * (q(2) * q(3) + q(1) * q(4)), r(2, 1), 1e-12_c_double, 'quaternion yx')
      call near(2 * (q(2) * q(4) - q(1) * q(3)), r(3, 1), 1e-12_c_double, 'quaternion zx')
      call check(q(1) >= 0, 'w >= 0')
    end associate
  end subroutine l_moments

  subroutine shapes()
    type(morula_shape_t) :: s
    type(morula_report) :: report
    type(morula_moments) :: m
    type(morula_import_options) :: import_options
    type(morula_file_options) :: file_options
    real(c_double) :: vertices(3, 12)
    integer(c_int32_t) :: triangles(3, 20), status
    integer(c_int8_t) :: mask(3, 2, 1), seen(27)
    real(c_double) :: cameras(4, 3, 2)
    integer(c_int16_t) :: grey(4, 1, 1)
    integer(c_int32_t) :: labels(4, 1, 1)
    integer(c_int32_t), allocatable :: ids(:)
    integer(c_int64_t), allocatable :: cells(:), boxes(:, :)
    logical, allocatable :: touches(:)
    integer(c_int8_t), allocatable :: bytes(:)
    character(:), allocatable :: text, off
    character(len=6) :: keys(1)
    real(c_double) :: value
    integer :: i, j, k, unit

    call l_mesh(vertices, triangles)
    call s%create_from_mesh(vertices, triangles)
    call check(c_associated(s%c_handle()), 'a mesh is taken')
    call s%report(report)
    call check(report%faces == 20 .and. report%watertight == 1, 'report of the mesh')
    call s%moments(2.0_c_double, m)
    call l_moments(m)

    ! The same with the options and one triangle too few: notes.
    call morula_init(import_options)
    import_options%progress = c_funloc(progress)
    last_fraction = 0
    call s%create_from_mesh(vertices, triangles(:, :19), import_options, status)
    call check(status == MORULA_STATUS_OK, 'an open L is taken')
    call s%note_count(k)
    call check(k > 0, 'and noted')
    do i = 1, k
      call s%note(i, text)
      call check(len(text) > 10, 'a note is a sentence')
    end do
    call s%note(k + 1, text, status)
    call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE, 'no further note')

    ! Counting starts at 1, also in the message.
    triangles(1, 1) = 0
    call s%create_from_mesh(vertices, triangles, status=status)
    call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE, 'vertex 0 does not exist')
    call check(index(morula_message(), 'triangle 1 ') > 0, 'the first triangle is number 1')
    call check(morula_name_of_status(status) == 'INDEX_OUT_OF_RANGE', 'name of a status')
    call check(.not. c_associated(s%c_handle()), 'a failed create leaves nothing')

    ! Voxels: Fortran arrays have x fastest as they are.
    mask = reshape(int([1, 1, 1, 1, 0, 0], c_int8_t), [3, 2, 1])
    call s%create_from_mask(mask, origin=[10.0_c_double, 20.0_c_double, 30.0_c_double])
    call s%moments(2.0_c_double, m)
    call l_moments(m)
    ! A box of 2 x 1 x 3 from two sides: x and y, then z and y.
    seen = 0_c_int8_t
    seen([6, 7, 18, 19, 20]) = 1_c_int8_t
    cameras = 0
    cameras(1, 1, 1) = 1
    cameras(3, 1, 2) = 1
    cameras(2, 2, :) = 1
    cameras(4, :, :) = 1
    call s%create_from_silhouettes(seen, [4_c_size_t, 5_c_size_t], [3_c_size_t, 3_c_size_t], &
      cameras, cells=6, carve=MORULA_CARVE_CENTRES)
    call s%report(report)
    call check(abs(report%volume - 6) < 1e-3_c_double, 'volume of the hull')
    call s%create_from_grey(mask, threshold=0.5_c_double)
    call s%report(report)
    call check(report%solid_cells == 4, 'grey u8')
    grey = reshape(int([1, 9, 9, 1], c_int16_t), [4, 1, 1])
    call s%create_from_grey(grey)
    call s%report(report)
    call check(report%solid_cells == 2, 'grey u16')
    call s%create_from_grey(real(grey, c_float), spacing=[1.0_c_double, 2.0_c_double, 3.0_c_double])
    call s%report(report)
    call near(report%volume, 12.0_c_double, 1e-12_c_double, 'grey f32')
    labels = reshape([0, 7, 7, 3], [4, 1, 1])
    call s%create_from_label(labels, 7)
    call s%report(report)
    call check(report%solid_cells == 2, 'label')
    call morula_labels(labels, ids, cells, boxes, touches)
    call check(size(ids) == 2 .and. ids(1) == 3 .and. ids(2) == 7, 'labels')
    call check(cells(2) == 2 .and. boxes(1, 2) == 2 .and. boxes(4, 2) == 3, 'their cells and boxes')
    call check(touches(1), 'their border')

    ! The same of a file.
    call morula_init(file_options)
    file_options%format = MORULA_FORMAT_RAW
    file_options%raw_dims = [4_c_int64_t, 1_c_int64_t, 1_c_int64_t]
    bytes = int([0, 7, 7, 3], c_int8_t)
    open (newunit=unit, file='fortran_labels.raw', access='stream', status='replace')
    write (unit) bytes
    close (unit)
    do i = 1, 2
      if (i == 1) call morula_labels(bytes, '', ids, cells, boxes, touches, file_options=file_options)
      if (i == 2) then
        call morula_labels('fortran_labels.raw', ids, cells, boxes, touches, file_options=file_options)
      end if
      call check(size(ids) == 2 .and. ids(1) == 3 .and. ids(2) == 7, 'labels of a file')
      call check(cells(2) == 2 .and. boxes(1, 2) == 2 .and. boxes(4, 2) == 3, 'their cells')
      call check(touches(1), 'their border')
    end do
    open (newunit=unit, file='fortran_labels.raw')
    close (unit, status='delete')
    call morula_labels('fortran_labels.raw', ids, file_options=file_options, status=status)
    call check(status == MORULA_STATUS_IO .and. size(ids) == 0, 'no such file')

    ! A file, and its bytes.
    off = 'OFF' // new_line('a') // '4 4 0' // new_line('a') // '0 0 0' // new_line('a') // &
      '1 0 0' // new_line('a') // '0 1 0' // new_line('a') // '0 0 1' // new_line('a') // &
      '3 0 2 1' // new_line('a') // '3 0 1 3' // new_line('a') // '3 1 2 3' // new_line('a') // &
      '3 2 0 3' // new_line('a')
    bytes = [(int(iachar(off(i:i)), c_int8_t), i=1, len(off))]
    call morula_init(file_options)
    call s%create_from_bytes(bytes, 'tetrahedron.off', file_options=file_options)
    call s%report(report)
    call near(report%volume, 1.0_c_double / 6, 1e-12_c_double, 'bytes of a file')
    open (newunit=unit, file='fortran_tetrahedron.off', access='stream', status='replace')
    write (unit) off
    close (unit)
    call s%create_from_file('fortran_tetrahedron.off')
    call s%report(report)
    call near(report%volume, 1.0_c_double / 6, 1e-12_c_double, 'a file')
    open (newunit=unit, file='fortran_tetrahedron.off')
    close (unit, status='delete')
    call s%create_from_file('no/such.stl', status=status)
    call check(status == MORULA_STATUS_IO, 'no such file')

    ! Built-in particles and their parameters.
    i = 1
    do while (len(morula_name_of_primitive(i)) > 0)
      call morula_parameter_count(morula_name_of_primitive(i), k)
      do j = 1, k
        call morula_parameter(morula_name_of_primitive(i), j, text, value)
        call check(len(text) > 0 .and. abs(value) < 100, 'a parameter')
      end do
      call morula_parameter(morula_name_of_primitive(i), k + 1, text, value, status)
      call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE .and. text == '', 'no more')
      i = i + 1
    end do
    call check(i > 11, 'built-in particles')
    keys(1) = 'radius'
    call s%create_from_primitive('sphere', keys, [2.0_c_double], segments=100)
    call s%moments(1.0_c_double, m)
    call near(m%volume, 33.5_c_double, 0.2_c_double, 'a sphere of radius 2')
    call s%create_from_primitive('stone', seed=5_c_int64_t)
    call s%create_from_primitive('cheese', status=status)
    call check(status == MORULA_STATUS_UNSUPPORTED, 'no such particle')
    ! Goes out of scope here: the finalizer frees what is left, which is nothing.
  end subroutine shapes

  subroutine clumps()
    type(morula_shape_t), allocatable :: s
    type(morula_solid_t) :: solid
    type(morula_clump_t) :: clump, body
    type(morula_solid_options) :: solid_options
    type(morula_clump_options) :: options
    type(morula_moments) :: m
    type(morula_overlap) :: overlap
    type(morula_surface) :: surface
    type(morula_counters) :: counters, of_shape, of_solid
    real(c_double) :: vertices(3, 12), xyzr(4, 15), in_body(4, 15), distances(2), areas(15)
    real(c_double) :: spacing(3), origin(3), r(3, 3), p(3)
    integer(c_int32_t) :: triangles(3, 20), status, stopped, contacts(2)
    integer(c_int32_t), allocatable :: codes(:)
    real(c_double), allocatable :: figures(:), bounds(:)
    integer(c_size_t) :: dims(3)
    character(:), allocatable :: text
    integer :: n, i, k

    allocate(s)
    call l_mesh(vertices, triangles)
    call s%create_from_mesh(vertices, triangles)
    call morula_init(solid_options)
    solid_options%cells = 40
    call solid%create(s, solid_options)
    call solid%grid(dims, spacing, origin)
    call check(all(dims > 8) .and. all(spacing > 0) .and. origin(1) < 10, 'grid')
    call solid%distance(reshape([real(c_double) :: 12.5, 20.5, 30.5, 12.5, 21.75, 30.5], [3, 2]), &
      distances)
    call near(distances(1), -0.5_c_double, 1e-12_c_double, 'distance inside')
    call near(distances(2), 0.75_c_double, 1e-12_c_double, 'distance outside')
    call solid%note_count(k)
    do i = 1, k
      call solid%note(i, text)
    end do
    call solid%note(k + 1, text, status)
    call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE, 'no further note')
    call solid%moments(2.0_c_double, m)
    call l_moments(m)

    call morula_init(options)
    options%spheres = 15
    options%wants = MORULA_WANT_OVERLAP + MORULA_WANT_SURFACE + MORULA_WANT_MOMENTS
    options%progress = c_funloc(progress)
    last_fraction = 0
    call clump%create(solid, options, [0.01_c_double, 0.1_c_double])
    call clump%sphere_count(n)
    call check(n > 0 .and. n <= 15, 'spheres')
    call clump%copy_spheres(xyzr)
    call check(all(xyzr(4, :n) > 0) .and. all(xyzr(4, :n) < 1), 'radii')
    call check(all(xyzr(1, :n) > 10) .and. all(xyzr(1, :n) < 13), 'x of the spheres')
    call check(all(xyzr(2, :n) > 20) .and. all(xyzr(2, :n) < 22), 'y of the spheres')
    call check(all(xyzr(3, :n) > 30) .and. all(xyzr(3, :n) < 31), 'z of the spheres')
    stopped = -1
    call clump%stopped(stopped)
    call check(len(morula_name_of_stop(stopped)) > 0 .and. stopped >= 0, 'stopped')
    call clump%note(text)
    call check((len(text) > 0) .eqv. (n < 15), 'the note says why')
    call clump%warnings(codes, figures, bounds)
    call check((size(codes) > 0) .eqv. (n < 15), 'and a warning says so')
    do i = 1, size(codes)
      call clump%warning(i, text)
      call check(len(text) > 10 .and. figures(i) < bounds(i), 'with its figure')
    end do
    call clump%warning(size(codes) + 1, text, status)
    call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE, 'no further warning')
    call check(morula_name_of_warning(MORULA_WARNING_FAR_AWAY) == 'far away', 'its name')
    call clump%moments(2.0_c_double, m)
    call l_moments(m)
    call clump%overlap(overlap)
    call check(overlap%coverage > 0.4 .and. overlap%mismatch < 0.5, 'overlap')
    call clump%surface(surface)
    call check(surface%samples > 0 .and. surface%hausdorff >= surface%rms_distance, 'surface')
    call check(surface%distance_bound >= 0 .and. surface%distance_bound < 0.1, 'distance bound')
    call clump%copy_exposed_areas(areas)
    call check(sum(areas(:n)) > 5, 'exposed areas')
    call clump%copy_plane_contacts(contacts)
    call check(contacts(1) >= 1 .and. contacts(2) >= contacts(1), 'plane contacts')
    call clump%counters(counters)
    call check(counters%seconds_generate > 0 .and. counters%seconds_check > 0, 'counters')
    call s%counters(of_shape)
    call check(of_shape%seconds_check > 0 .and. of_shape%cells == 0, 'counters of a shape')
    call solid%counters(of_solid)
    call check(of_solid%seconds_check >= of_shape%seconds_check, 'a solid counts its shape')
    call check(of_solid%cells > 0 .and. of_solid%seconds_solid > 0, 'counters of a solid')
    call check(of_solid%seconds_generate <= 0, 'a solid counts no clump')

    ! From the shape, in the body frame; back by p = R b + centre.
    options%frame = MORULA_FRAME_BODY
    options%wants = MORULA_WANT_NOTHING
    last_fraction = 0
    call body%create(s, options, solid_options)
    call body%copy_spheres(in_body)
    r = reshape(m%rotation, [3, 3])
    do i = 1, n
      p = matmul(r, in_body(:3, i)) + m%centre
      call check(all(abs(p - xyzr(:3, i)) < 1e-12), 'body frame')
      call near(in_body(4, i), xyzr(4, i), 1e-15_c_double, 'same radius')
    end do
    call body%overlap(overlap, status)
    call check(status == MORULA_STATUS_NOT_WANTED, 'not wanted')

    options%progress = c_funloc(stop_at_once)
    call body%create(solid, options, status=status)
    call check(status == MORULA_STATUS_OK .or. status == MORULA_STATUS_CANCELLED, 'cancelled')
    if (status == MORULA_STATUS_OK) then
      call body%stopped(stopped)
      call check(stopped == MORULA_STOPPED_CANCELLED, 'cancelled with spheres')
    end if

    call several(solid)

    call body%destroy()
    call body%destroy()
    call clump%destroy()
    deallocate(s) ! the finalizer frees the shape
    ! solid goes out of scope
  end subroutine clumps

  !> A shape and a clump as bytes.
  subroutine handed_on()
    type(morula_shape_t) :: box, again
    type(morula_clump_t) :: clump, copy
    type(morula_clump_options) :: options
    type(morula_moments) :: m
    integer(c_int8_t), allocatable :: bytes(:)
    real(c_double) :: here(4, 3), there(4, 3)
    integer(c_int32_t) :: status
    call box%create_from_primitive('box')
    call box%serialize(bytes)
    call again%deserialize(bytes)
    call again%moments(1.0_c_double, m)
    call check(m%volume > 0, 'a shape comes back')
    call again%deserialize(bytes(:size(bytes) - 1), status)
    call check(status == MORULA_STATUS_FORMAT, 'cut short')
    call morula_init(options)
    options%effort = MORULA_EFFORT_DRAFT
    options%spheres = 3
    call clump%create(box, options)
    call clump%serialize(bytes)
    call copy%deserialize(bytes)
    call clump%copy_spheres(here)
    call copy%copy_spheres(there)
    call check(all(abs(here - there) <= 0), 'a clump comes back')
  end subroutine handed_on

  !> Several clumps in one call.
  subroutine several(solid)
    type(morula_solid_t), intent(in) :: solid
    type(morula_clump_t) :: levels(2)
    type(morula_clump_t), allocatable :: clumps(:)
    type(morula_shape_t) :: shapes(2)
    type(morula_clump_options) :: options
    type(morula_moments) :: m
    integer(c_int32_t) :: labels(6, 1, 1), statuses(3), status
    integer :: i, n
    call morula_init(options)
    options%method = MORULA_METHOD_BEST
    options%effort = MORULA_EFFORT_DRAFT
    options%spheres = 5
    options%threads = 2
    call morula_make_clumps(levels, solid, [3, 7], options)
    do i = 1, 2
      call levels(i)%sphere_count(n)
      call check(n == 4*i - 1, 'levels of detail')
    end do
    call shapes(1)%create_from_primitive('box')
    call shapes(2)%create_from_primitive('sphere')
    allocate(clumps(2))
    call morula_make_clumps(clumps, shapes, options)
    call clumps(2)%moments(1.0_c_double, m)
    call near(m%volume, 4.188_c_double, 0.1_c_double, 'the second shape')
    deallocate(clumps) ! the finalizer frees each
    labels(:, 1, 1) = [1, 1, 0, 2, 2, 2]
    allocate(clumps(3))
    call morula_make_clumps(clumps, labels, [2, 9, 1], clump_options=options, &
      statuses=statuses, status=status)
    call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE, 'one label is not there')
    call check(all(statuses == [MORULA_STATUS_OK, status, MORULA_STATUS_OK]), 'statuses')
    call check(index(morula_message(), 'label at 1') == 1, 'which one')
    call clumps(3)%moments(1.0_c_double, m)
    call near(m%volume, 2.0_c_double, 1e-12_c_double, 'the others are made')
  end subroutine several
end module checks

program fortran_api
  use checks
  implicit none
  call check(morula_version() == 1000000 * MORULA_VERSION_MAJOR + 1000 * MORULA_VERSION_MINOR &
    + MORULA_VERSION_PATCH, 'the version of the module is that of the library')
  call check(index(morula_library_version(), '.') > 0, 'version as text')
  call morula_log_to(sink)
  call sizes()
  call shapes()
  call clumps()
  call handed_on()
  call check(lines > 0, 'the sink was called')
  call morula_log_to()
  print '(i0, a, i0, a)', made, ' checks, ', failed, ' failed'
  if (failed > 0) error stop 1
end program fortran_api
