! Weighs a clump, places it, and writes it for LAMMPS; traps stand on invalid, zero, overflow.
program fortran_masses
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use morula
  implicit none
  integer :: made = 0, failed = 0
  type(morula_shape_t) :: shape
  type(morula_clump_t) :: clump
  type(morula_body_t) :: body, placed
  type(morula_clump_options) :: clump_options
  type(morula_mass_options), target :: options
  type(morula_contact_options) :: contact
  type(morula_export_options) :: export_options
  type(morula_moments) :: m, p
  type(morula_masses) :: result
  type(morula_timestep) :: step, again
  real(c_double), allocatable :: xyzr(:, :)
  real(c_float), allocatable :: single(:, :)
  integer(c_int32_t), allocatable :: binding(:)
  real(c_double) :: turns(4, 2)
  type(c_ptr) :: raw
  integer(c_int32_t) :: status
  character(len=40) :: line
  integer :: n, unit


  call shape%create_from_primitive('stone')
  call morula_init(clump_options)
  clump_options%spheres = 60
  clump_options%effort = MORULA_EFFORT_DRAFT
  call clump%create(shape, clump_options=clump_options)
  call morula_init(options)
  options%density = 2500.0_c_double
  call body%create(clump, options)
  call holds(body)
  call body%sphere_count(n)
  call check(n == 60, 'spheres')
  call body%masses(result)
  call check(result%status == MORULA_MASSES_EXACT, 'exact')
  call check(morula_name_of_masses(result%status) == 'exact', 'its name')
  allocate(binding(result%binding))
  call body%copy_binding(binding)
  call check(all(binding >= 1) .and. all(binding <= n), 'binding spheres count from 1')

  allocate(xyzr(4, n), single(4, n))
  call clump%copy_spheres(xyzr)
  call placed%create(xyzr)
  call holds(placed)
  call body%copy_spheres(xyzr, MORULA_FRAME_BODY)
  call body%copy_spheres_f32(single, MORULA_FRAME_BODY)
  call check(all(abs(single - xyzr) < 1e-6_c_double), 'single precision')

  call morula_orientations(5_c_int64_t, turns)
  call body%transform(placed, 0.5_c_double, [1.0_c_double, 2.0_c_double, 3.0_c_double], turns(:, 1))
  call holds(placed)
  call body%moments(m)
  call placed%moments(p)
  call check(abs(p%mass / m%mass - 0.125_c_double) < 1e-12_c_double, 'an eighth of the mass')
  call morula_init(contact)
  contact%young = 5e7_c_double
  call body%timestep(contact, step)
  call check(step%clump > 0 .and. step%rayleigh > 0, 'a time step')
  contact%contacts = 4_c_int32_t
  call body%timestep(contact, again)
  call check(again%together >= again%clump .and. again%together <= 4 * again%clump .and. &
    again%clump < step%clump, 'of four contacts together')
  contact%contacts = 1_c_int32_t
  call clump%timestep(contact, again, masses=options)
  call check(abs(again%clump - step%clump) < 1e-9_c_double * step%clump, 'weighed for a time step')
  call clump%transform(placed, 2.0_c_double, masses=options)
  call placed%moments(p)
  call check(abs(p%mass / m%mass - 8) < 1e-9_c_double, 'weighed and placed')
  ! The first layer, as C has it: what is not given is NULL.
  raw = c_null_ptr
  call check(morula_clump_transform(clump%c_handle(), c_loc(options), 2.0_c_double, c_null_ptr, &
    c_null_ptr, raw) == MORULA_STATUS_OK .and. c_associated(raw), 'in the first layer')
  call morula_body_free(raw)

  call body%write(MORULA_EXPORT_LAMMPS, 'fortran_masses.mol')
  open (newunit=unit, file='fortran_masses.mol', status='old', action='read')
  read (unit, '(a)') line
  close (unit, status='delete')
  call check(line(1:8) == '# clump:', 'the first line of the molecule')
  call in_memory()
  call clump%write(MORULA_EXPORT_CSV, 'masses.csv', masses=options)
  open (newunit=unit, file='masses.csv', status='old', action='read')
  read (unit, '(a)') line
  close (unit, status='delete')
  call check(line == 'x,y,z,r,mass', 'the header of the table')
  call body%write(MORULA_EXPORT_CSV, 'no_such_folder/a.csv', status=status)
  call check(status == MORULA_STATUS_IO, 'a folder that is not there')
  options%density = 0.0_c_double
  call placed%create(clump, options, status)
  call check(status == MORULA_STATUS_INVALID_ARGUMENT, 'no density')
  call check(.not. c_associated(placed%c_handle()), 'nothing is made')
  call every_method()
  call body%destroy()
  call placed%destroy()
  deallocate (xyzr, single, binding)
  call clump%destroy()
  call shape%destroy()
  print '(i0, a, i0, a)', made, ' checks, ', failed, ' failed'
  if (failed > 0) error stop 1

contains

  subroutine check(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    made = made + 1
    if (condition) return
    failed = failed + 1
    write (error_unit, '(5a)') 'not so: ', what, ' (last message: "', morula_message(), '")'
  end subroutine check

  !> Every method makes spheres, weighs and writes them, or refuses the stone; none springs a trap.
  subroutine every_method()
    integer(c_int32_t), parameter :: methods(10) = [MORULA_METHOD_MSS, MORULA_METHOD_BEST, &
      MORULA_METHOD_SURFACE_FIT, MORULA_METHOD_INSCRIBED, MORULA_METHOD_COVER, &
      MORULA_METHOD_PACKED, MORULA_METHOD_EUCLIDEAN, MORULA_METHOD_FERELLEC_MCDOWELL, &
      MORULA_METHOD_FAVIER, MORULA_METHOD_UNIFORM_GRID]
    type(morula_clump_t) :: other
    type(morula_clump_options) :: asked
    integer :: k, good
    good = 0
    do k = 1, 10
      call morula_init(asked)
      asked%spheres = 12
      asked%method = methods(k)
      call other%create(shape, clump_options=asked, status=status)
      call check(status /= MORULA_STATUS_INTERNAL, 'a method')
      if (status /= MORULA_STATUS_OK) cycle
      good = good + 1
      options%density = 2500.0_c_double
      options%infeasible = MORULA_INFEASIBLE_LEAST_ERROR
      call placed%create(other, options, status)
      call check(status == MORULA_STATUS_OK, 'its masses')
      call placed%write(MORULA_EXPORT_CSV, 'fortran_method.csv')
      open (newunit=unit, file='fortran_method.csv', status='old')
      close (unit, status='delete')
    end do
    call check(good >= 9, 'nearly all methods take a stone')
    call other%destroy()
  end subroutine every_method

  !> The files of a format in memory.
  subroutine in_memory()
    type(morula_files_t) :: files
    integer :: count
    character(:), allocatable :: name
    integer(c_int8_t), allocatable :: text(:)
    call morula_init(export_options)
    call files%create(body, MORULA_EXPORT_MERCURY, export_options)
    call files%count(count)
    call check(count == 4, 'four files')
    call files%name(3, name)
    call check(name == 'Inertia/TOI.txt', 'a name')
    call files%bytes(2, text)
    call check(text(size(text)) == 10, 'which end in a line')
    call files%name(5, name, status)
    call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE .and. name == '', 'no fifth')
    call check(c_associated(files%c_handle()), 'the C handle')
    call files%destroy()
  end subroutine in_memory

  !> The masses add up to the body, in its frame.
  subroutine holds(of)
    type(morula_body_t), intent(in) :: of
    type(morula_moments) :: whole
    integer :: count, k
    real(c_double), allocatable :: s(:, :), weights(:)
    real(c_double) :: moment
    call of%sphere_count(count)
    allocate(s(4, count), weights(count))
    call of%copy_spheres(s, MORULA_FRAME_BODY)
    call of%copy_masses(weights)
    call of%moments(whole)
    call check(abs(sum(weights) / whole%mass - 1) < 1e-10_c_double, 'mass')
    do k = 1, 3
      moment = sum(weights * (0.4_c_double * s(4, :)**2 + sum(s(1:3, :)**2, dim=1) - s(k, :)**2))
      call check(abs(moment / whole%principal(k) - 1) < 1e-9_c_double, 'moment')
    end do
    moment = sum(weights * s(1, :) * s(2, :))
    call check(abs(moment) < 1e-9_c_double * whole%principal(3), 'product')
  end subroutine holds
end program fortran_masses
