! Breaks a stone, and a fragment of it again; traps stand on invalid, zero, overflow.
program fortran_fragments
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use morula
  implicit none
  integer :: made = 0, failed = 0
  type(morula_shape_t) :: shape, part
  type(morula_solid_t) :: solid
  type(morula_clump_t) :: clump
  type(morula_parent_t) :: parents(2), elsewhere
  type(morula_cache_t) :: cache
  type(morula_cache_counts) :: counters
  type(morula_fragments_t) :: broken, again, both(2), arrived
  type(morula_clump_options) :: clump_options
  type(morula_break_options) :: options
  type(morula_held) :: held, bodies(2)
  type(morula_fragment) :: f, g
  integer(c_int8_t), allocatable :: packed(:)
  type(morula_break_totals) :: totals
  real(c_double), allocatable :: spheres(:, :), xyzr(:, :), grown(:, :), masses(:), shares(:)
  real(c_double), allocatable :: planes(:, :)
  real(c_double) :: none(4, 0)
  real(c_double), target :: flat(4, 1)
  integer(c_int32_t), allocatable :: starts(:), of(:)
  integer(c_int32_t) :: status, statuses(2)
  integer(c_int64_t) :: bytes
  character(:), allocatable :: text
  integer(c_int32_t) :: labels(8, 8, 8)
  integer :: n, k, dust, notes

  call shape%create_from_primitive('stone')
  call solid%create(shape)
  call morula_init(clump_options)
  clump_options%spheres = 40
  clump_options%method = MORULA_METHOD_INSCRIBED
  clump_options%effort = MORULA_EFFORT_DRAFT
  call clump%create(solid, clump_options)
  call clump%sphere_count(n)
  allocate(spheres(4, n))
  call clump%copy_spheres(spheres)
  call parents(1)%create(solid, clump)
  call parents(2)%create(solid, spheres)
  call parents(1)%bytes(bytes)
  call check(bytes > 0, 'bytes')

  call morula_init(held)
  call check(held%scale > 0.5_c_double .and. held%mass < 0.5_c_double, 'a body to be set by hand')
  call parents(1)%held(held, 2600.0_c_double, position=[1.0_c_double, 2.0_c_double, 3.0_c_double], &
    quaternion=[0.9_c_double, 0.1_c_double, -0.3_c_double, 0.2_c_double], &
    velocity=[1.0_c_double, 0.0_c_double, -4.0_c_double], &
    angular_velocity=[5.0_c_double, -3.0_c_double, 8.0_c_double])
  call morula_init(options)
  options%cells = 5
  options%seed = 4
  options%masses = 1
  call broken%create(parents(1), held, options)
  call conserves(broken)
  call broken%totals(totals)
  call check(totals%inertia_error < 1e-10_c_double, 'the inertia of the pieces is the solid''s')
  call broken%count(n)
  do k = 1, n
    call look_at(broken, k)
  end do
  call broken%note_count(notes)
  do k = 1, notes
    call broken%note(k, text)
    call check(len(text) > 0, 'a note')
  end do

  ! The first breaks again, where it stands.
  call broken%held(1, held)
  call again%create(broken, 1, held, options)
  call conserves(again)

  ! It goes to another rank, where a cache has the parent, and breaks there into the same.
  call cache%create(int(10, c_int64_t)**9)
  do k = 1, 2
    call elsewhere%create(cache, shape, spheres)
  end do
  call cache%counters(counters)
  call check(counters%hits == 1 .and. counters%misses == 1, 'made once')
  call broken%serialize(1, packed)
  call check(size(packed) < 4096, 'few bytes')
  call arrived%deserialize(elsewhere, packed, held)
  call broken%get(1, f)
  call arrived%get(1, g)
  call check(f%sphere_count == g%sphere_count, 'as many spheres')
  call check(maxval(abs(f%position - g%position)) < 1e-12_c_double, 'where it was')
  call both(1)%create(arrived, 1, held, options)
  call again%count(n)
  call both(1)%count(k)
  call check(n == k, 'as many pieces')
  call again%get(n, f)
  call both(1)%get(n, g)
  call check(f%volume == g%volume .and. f%sphere_count == g%sphere_count, 'the same pieces')
  packed(30) = ieor(packed(30), 1_c_int8_t)
  call arrived%deserialize(elsewhere, packed, held, status)
  call check(status == MORULA_STATUS_FORMAT, 'changed on the way')
  call cache%clear()
  call cache%counters(counters)
  call check(counters%parents == 0 .and. counters%bytes == 0, 'empty')
  call cache%destroy()
  call elsewhere%destroy()

  ! A cube of two halves and a cell of dust, as a fracture model gives them.
  labels = 1
  labels(5:, :, :) = 2
  labels(8, 8, 8) = 3
  held = morula_held(struct_size=c_sizeof(held), mass=64.0_c_double, centre=2.0_c_double, &
    inertia=[512 / 3.0_c_double, 512 / 3.0_c_double, 512 / 3.0_c_double, 0.0_c_double, &
    0.0_c_double, 0.0_c_double], scale=1.0_c_double, &
    quaternion=[1.0_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double])
  options%least_volume = 0.2_c_double
  call again%create_from_labels(labels, none, held, spacing=spread(0.5_c_double, 1, 3), options=options)
  call conserves(again)
  call again%count(n)
  call check(n == 2, 'two halves')
  call check(dust == 1, 'a cell of dust')
  call again%get(2, f)
  call check(f%cell == 2 .and. abs(f%mass - 31.875_c_double) < 1e-12_c_double, 'the second half')
  call again%totals(totals)
  call check(totals%inertia_error < 1e-12_c_double, 'the cube''s inertia')
  options%least_volume = 0

  ! Two in one step.
  call parents(1)%held(bodies(1), 2600.0_c_double)
  bodies(2) = bodies(1)
  call morula_break_all(parents, bodies, both, [options, options], statuses=statuses)
  call check(all(statuses == MORULA_STATUS_OK), 'both break')
  held = bodies(2)
  call conserves(both(2))

  ! A flat pressed into the stone.
  held = bodies(1)
  call morula_init(options)
  options%spheres = 30
  flat(:, 1) = [1.0_c_double, 0.0_c_double, 0.0_c_double, &
    maxval(spheres(1, :) + 0.5_c_double * spheres(4, :))]
  options%half_spaces = c_loc(flat)
  options%half_space_count = 1
  call again%reclump_shape(solid, spheres, held, options)
  call conserves(again)
  call again%get(1, f)
  allocate(xyzr(4, f%sphere_count))
  call again%copy_spheres(1, xyzr)
  call check(all(xyzr(1, :) + xyzr(4, :) <= flat(4, 1)), 'within the flat')
  deallocate (xyzr)

  options%kind = 9
  call again%create(parents(1), held, options, status)
  call check(status == MORULA_STATUS_INVALID_ARGUMENT, 'no such cut')
  call check(.not. c_associated(again%c_handle()), 'nothing is made')
  do k = 1, 2
    call both(k)%destroy()
    call parents(k)%destroy()
  end do
  call broken%destroy()
  call again%destroy()
  call part%destroy()
  call clump%destroy()
  call solid%destroy()
  call shape%destroy()
  ! A main program frees nothing by itself.
  deallocate (spheres)
  if (allocated(packed)) deallocate (packed)
  if (allocated(grown)) deallocate (grown)
  if (allocated(masses)) deallocate (masses)
  if (allocated(shares)) deallocate (shares)
  if (allocated(planes)) deallocate (planes)
  if (allocated(starts)) deallocate (starts)
  if (allocated(of)) deallocate (of)
  if (allocated(text)) deallocate (text)
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

  !> Mass and momentum of all pieces are those of the held body.
  subroutine conserves(pieces)
    type(morula_fragments_t), intent(in) :: pieces
    type(morula_fragment) :: piece
    real(c_double) :: mass, momentum(3)
    integer :: i, count
    mass = 0
    momentum = 0
    call pieces%count(count)
    do i = 1, count
      call pieces%get(i, piece)
      mass = mass + piece%mass
      momentum = momentum + piece%mass * piece%velocity
    end do
    call pieces%dust_count(dust)
    do i = 1, dust
      call pieces%dust(i, piece)
      mass = mass + piece%mass
      momentum = momentum + piece%mass * piece%velocity
    end do
    call check(abs(mass / held%mass - 1) < 1e-13_c_double, 'mass')
    call check(maxval(abs(momentum / held%mass - held%velocity)) < 1e-12_c_double, 'momentum')
  end subroutine conserves

  !> All that can be asked of a fragment.
  subroutine look_at(pieces, i)
    type(morula_fragments_t), intent(in) :: pieces
    integer, intent(in) :: i
    real(c_double) :: offset
    call pieces%get(i, f)
    allocate(xyzr(4, f%sphere_count), grown(4, f%sphere_count), masses(f%sphere_count))
    call pieces%copy_spheres(i, xyzr)
    call pieces%grow(i, 1.0_c_double, none, grown)
    call check(all(grown(4, :) >= xyzr(4, :)) .and. any(grown(4, :) > xyzr(4, :)), 'grown')
    call pieces%copy_masses(i, masses, status)
    if (status == MORULA_STATUS_OK) then
      call check(abs(sum(masses) / f%mass - 1) < 1e-10_c_double, 'masses of spheres')
    else
      call check(status == MORULA_STATUS_NO_MASSES, 'why there are none')
    end if
    call pieces%copy_map(i, starts, of, shares)
    call check(starts(size(starts)) == size(of) + 1 .and. all(of >= 1), 'a map from 1')
    call check(all(shares > 0) .and. all(shares <= 1), 'shares')
    allocate(planes(4, f%half_space_count))
    call pieces%copy_half_spaces(i, planes)
    offset = maxval(matmul(transpose(planes(1:3, :)), xyzr(1:3, 1)) - planes(4, :))
    call check(offset <= -xyzr(4, 1), 'within its half-spaces')
    call pieces%shape(i, part)
    call check(c_associated(part%c_handle()), 'a surface')
    deallocate (xyzr, grown, masses, planes)
  end subroutine look_at
end program fortran_fragments
