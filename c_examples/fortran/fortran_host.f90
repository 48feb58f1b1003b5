! A host in the manner of MFiX: all spheres of all particles in allocatable arrays of a module,
! which grow; a glued particle is known by its number. It reads an STL, makes a clump, prints the
! masses, breaks the particle, and puts the fragments in its place.
module discrete_elements
  use, intrinsic :: iso_c_binding, only: c_double
  implicit none
  integer, parameter :: wp = c_double

  ! Spheres: place, radius, mass, and the particle that they belong to (0: the row is free).
  integer :: rows = 0
  real(wp), allocatable :: des_pos(:, :), des_radius(:), pmass(:)
  integer, allocatable :: glue_id(:)

  ! Glued particles: mass, place, velocity, angular velocity, principal moments, quaternion.
  integer :: glued = 0
  real(wp), allocatable :: glue_mass(:), glue_pos(:, :), glue_vel(:, :), glue_omega(:, :)
  real(wp), allocatable :: glue_inertia(:, :), glue_quat(:, :)

contains

  !> Room for `more` spheres and one glued particle.
  subroutine particle_grow(more)
    integer, intent(in) :: more
    if (.not. allocated(des_radius)) then
      allocate (des_pos(3, 0), des_radius(0), pmass(0), glue_id(0), glue_mass(0), glue_pos(3, 0))
      allocate (glue_vel(3, 0), glue_omega(3, 0), glue_inertia(3, 0), glue_quat(4, 0))
    end if
    if (rows + more > size(des_radius)) then
      call grow2(des_pos, 2 * (rows + more))
      call grow1(des_radius, 2 * (rows + more))
      call grow1(pmass, 2 * (rows + more))
      call grow_integers(glue_id, 2 * (rows + more))
    end if
    if (glued == size(glue_mass)) then
      call grow1(glue_mass, 2 * glued + 1)
      call grow2(glue_pos, 2 * glued + 1)
      call grow2(glue_vel, 2 * glued + 1)
      call grow2(glue_omega, 2 * glued + 1)
      call grow2(glue_inertia, 2 * glued + 1)
      call grow2(glue_quat, 2 * glued + 1)
    end if
  end subroutine particle_grow

  subroutine grow1(array, n)
    real(wp), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    real(wp), allocatable :: larger(:)
    allocate (larger(n), source=0.0_wp)
    larger(:size(array)) = array
    call move_alloc(larger, array)
  end subroutine grow1

  subroutine grow2(array, n)
    real(wp), allocatable, intent(inout) :: array(:, :)
    integer, intent(in) :: n
    real(wp), allocatable :: larger(:, :)
    allocate (larger(size(array, 1), n), source=0.0_wp)
    larger(:, :size(array, 2)) = array
    call move_alloc(larger, array)
  end subroutine grow2

  subroutine grow_integers(array, n)
    integer, allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    integer, allocatable :: larger(:)
    allocate (larger(n), source=0)
    larger(:size(array)) = array
    call move_alloc(larger, array)
  end subroutine grow_integers

  !> Adds a glued particle with its spheres, xyzr in the world.
  subroutine glue(xyzr, masses, mass, place, velocity, omega, inertia, quaternion)
    real(wp), intent(in) :: xyzr(:, :), masses(:), mass, place(3), velocity(3), omega(3)
    real(wp), intent(in) :: inertia(3), quaternion(4)
    integer :: n
    n = size(masses)
    call particle_grow(n)
    glued = glued + 1
    des_pos(:, rows + 1:rows + n) = xyzr(1:3, :)
    des_radius(rows + 1:rows + n) = xyzr(4, :)
    pmass(rows + 1:rows + n) = masses
    glue_id(rows + 1:rows + n) = glued
    rows = rows + n
    glue_mass(glued) = mass
    glue_pos(:, glued) = place
    glue_vel(:, glued) = velocity
    glue_omega(:, glued) = omega
    glue_inertia(:, glued) = inertia
    glue_quat(:, glued) = quaternion
  end subroutine glue

  !> Takes a glued particle and its spheres out.
  subroutine unglue(which)
    integer, intent(in) :: which
    where (glue_id == which)
      glue_id = 0
      pmass = 0
    end where
    glue_mass(which) = 0
  end subroutine unglue
end module discrete_elements

program fortran_host
  use, intrinsic :: iso_c_binding
  use morula
  use discrete_elements
  implicit none
  real(wp), parameter :: density = 2600
  type(morula_shape_t) :: stone
  type(morula_solid_t) :: solid
  type(morula_clump_t) :: clump
  type(morula_body_t) :: body
  type(morula_parent_t) :: parent
  character(len=200) :: path
  real(wp) :: before, dust = 0
  integer :: i
  logical :: fine

  call get_command_argument(1, path)
  if (len_trim(path) == 0) then
    path = 'fortran_host.stl'
    call write_stl(path)
  end if
  call template(trim(path))
  print '(a, i0, a)', 'masses of the ', rows, ' spheres:'
  do i = 1, rows
    print '(i4, 4f10.6, es12.4)', i, des_pos(:, i), des_radius(i), pmass(i)
  end do
  before = sum(glue_mass(:glued))
  fine = abs(sum(pmass) / before - 1) < 1e-9_wp .and. all(pmass(:rows) > 0)
  call break(1)
  print '(a, i0, a, i0, a)', 'broken into ', glued - 1, ' particles of ', count(glue_id > 0), ' spheres'
  do i = 2, glued
    print '(a, i0, a, es11.4, a, 3f9.4)', '  particle ', i, ': mass ', glue_mass(i), ', velocity ', &
      glue_vel(:, i)
  end do
  print '(a, es9.1)', 'relative error of the mass: ', abs((sum(glue_mass) + dust) / before - 1)
  fine = fine .and. glued > 3 .and. abs((sum(glue_mass) + dust) / before - 1) < 1e-12_wp
  fine = fine .and. abs((sum(pmass) + dust) / before - 1) < 1e-9_wp

  call parent%destroy()
  call body%destroy()
  call clump%destroy()
  call solid%destroy()
  call stone%destroy()
  deallocate (des_pos, des_radius, pmass, glue_id, glue_mass, glue_pos, glue_vel, glue_omega)
  deallocate (glue_inertia, glue_quat)
  if (.not. fine) error stop 'NOT as it should be'
  print '(a)', 'all is well'

contains

  !> Reads the mesh, in millimetres, makes the clump, weighs it, and puts one particle of it down.
  subroutine template(file)
    character(*), intent(in) :: file
    type(morula_import_options) :: read
    type(morula_clump_options) :: options
    type(morula_mass_options) :: weigh
    type(morula_moments) :: m
    real(wp), allocatable :: xyzr(:, :), masses(:)
    integer :: n
    call morula_init(read)
    read%length_unit = 1e-3_wp
    call stone%create_from_file(file, read)
    call solid%create(stone)
    call morula_init(options)
    options%spheres = 20
    options%method = MORULA_METHOD_INSCRIBED
    call clump%create(solid, options)
    call morula_init(weigh)
    weigh%density = density
    call body%create(clump, weigh)
    call parent%create(solid, clump)
    call body%sphere_count(n)
    call body%moments(m)
    allocate (xyzr(4, n), masses(n))
    call body%copy_spheres(xyzr)
    call body%copy_masses(masses)
    call glue(xyzr, masses, m%mass, m%centre, [0.3_wp, 0.0_wp, -2.0_wp], &
      [10.0_wp, -4.0_wp, 1.0_wp], m%principal, m%quaternion)
  end subroutine template

  !> A glued particle breaks where it stands; its fragments take its place.
  subroutine break(which)
    integer, intent(in) :: which
    type(morula_fragments_t) :: fragments
    type(morula_break_options) :: options
    type(morula_held) :: held
    type(morula_fragment) :: f
    real(wp), allocatable :: xyzr(:, :), masses(:)
    integer :: i, n, pieces, status
    call parent%held(held, density, 1.0_wp, glue_pos(:, which), glue_quat(:, which), &
      glue_vel(:, which), glue_omega(:, which))
    call morula_init(options)
    options%cells = 5
    options%spheres = 12
    options%masses = 1
    call fragments%create(parent, held, options)
    call unglue(which)
    call fragments%count(n)
    do i = 1, n
      call fragments%get(i, f)
      allocate (xyzr(4, f%sphere_count), masses(f%sphere_count))
      call fragments%copy_spheres(i, xyzr, MORULA_FRAME_WORLD)
      ! A piece of few spheres may have no masses that add up to its inertia.
      call fragments%copy_masses(i, masses, status)
      if (status /= MORULA_STATUS_OK) masses = f%mass * xyzr(4, :)**3 / sum(xyzr(4, :)**3)
      call glue(xyzr, masses, f%mass, f%position, f%velocity, f%angular_velocity, f%principal, &
        f%quaternion)
      deallocate (xyzr, masses)
    end do
    ! This host has no particles for dust: its mass is kept in the books.
    call fragments%dust_count(pieces)
    do i = 1, pieces
      call fragments%dust(i, f)
      dust = dust + f%mass
    end do
    call fragments%destroy()
  end subroutine break

  !> A crooked octahedron, in millimetres.
  subroutine write_stl(file)
    character(*), intent(in) :: file
    real(wp), parameter :: corners(3, 6) = reshape([real(wp) :: 11, 0, 1, -9, 1, 0, 0, 7, -1, &
      1, -8, 0, 0, 1, 6, -1, 0, -5], [3, 6])
    integer, parameter :: faces(3, 8) = reshape([1, 3, 5, 3, 2, 5, 2, 4, 5, 4, 1, 5, &
      3, 1, 6, 2, 3, 6, 4, 2, 6, 1, 4, 6], [3, 8])
    integer :: unit, i, k
    open (newunit=unit, file=file, status='replace', action='write')
    write (unit, '(a)') 'solid stone'
    do i = 1, 8
      write (unit, '(a)') 'facet normal 0 0 0', 'outer loop'
      do k = 1, 3
        write (unit, '(a, 3(1x, es14.6))') 'vertex', corners(:, faces(k, i))
      end do
      write (unit, '(a)') 'endloop', 'endfacet'
    end do
    write (unit, '(a)') 'endsolid stone'
    close (unit)
  end subroutine write_stl
end program fortran_host
