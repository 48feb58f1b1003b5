! A stone that breaks in the middle of a simulation, in Fortran. The solver is a few lines (gravity
! and a floor); after each time step a handler looks whether something breaks, and replaces it at
! once. What is conserved and how long it took is printed.
module little_solver
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use morula
  implicit none
  private
  public :: particle, solver

  integer, parameter :: wp = c_double

  !> A rigid body of spheres, in its body frame.
  type :: particle
    real(wp) :: mass = 0, principal(3) = 0
    real(wp) :: position(3) = 0, quaternion(4) = [1, 0, 0, 0], velocity(3) = 0, spin(3) = 0
    real(wp), allocatable :: xyzr(:, :)
    real(wp) :: force = 0
  end type particle

  !> Gravity, a floor at z = 0 with a linear spring and a dashpot, explicit steps.
  type :: solver
    type(particle), allocatable :: particles(:)
    real(wp) :: step = 1e-5_wp, time = 0
    real(wp) :: density = 2600, scale = 0.05_wp, strength = huge(1.0_wp)
    integer :: breaks = 0
    logical :: sound = .true.
  contains
    procedure :: solve
    procedure :: actions_after_time_step
  end type solver

  !> Mass, momentum, angular momentum about the origin, kinetic energy.
  type :: totals
    real(wp) :: mass = 0, momentum(3) = 0, angular(3) = 0, energy = 0
  end type totals

contains

  subroutine solve(self, parent, steps)
    class(solver), intent(inout) :: self
    type(morula_parent_t), intent(in) :: parent
    integer, intent(in) :: steps
    integer :: i, k
    do i = 1, steps
      do k = 1, size(self%particles)
        call move(self%particles(k), self%step)
      end do
      call self%actions_after_time_step(parent)
      self%time = self%time + self%step
    end do
  end subroutine solve

  !> Breaks a particle when the floor pushes it too hard.
  subroutine actions_after_time_step(self, parent)
    class(solver), intent(inout) :: self
    type(morula_parent_t), intent(in) :: parent
    type(morula_fragments_t) :: fragments
    type(morula_break_options) :: options
    type(morula_held) :: held
    type(morula_fragment) :: f
    type(particle), allocatable :: made(:)
    type(totals) :: before, after
    integer :: i, n, dust
    integer(c_int64_t) :: start, end, rate
    if (self%breaks > 0 .or. self%particles(1)%force < self%strength) return
    call morula_init(options)
    options%cells = 6
    options%seed = 7
    options%spheres = 20
    call system_clock(start, rate)
    associate (old => self%particles(1))
      call parent%held(held, self%density, self%scale, old%position, old%quaternion, &
        old%velocity, old%spin)
    end associate
    call fragments%create(parent, held, options)
    call system_clock(end)
    call fragments%count(n)
    call fragments%dust_count(dust)
    print '(a, f0.4, a, i0, a, i0, a, f0.2, a)', 't = ', self%time, ' s: ', n, ' fragments and ', &
      dust, ' pieces of dust in ', 1e3_wp * real(end - start, wp) / real(rate, wp), ' ms'
    self%breaks = self%breaks + 1
    call add(before, self%particles(1))
    allocate (made(n))
    do i = 1, n
      call fragments%get(i, f)
      made(i) = taken(f)
      allocate (made(i)%xyzr(4, f%sphere_count))
      call fragments%copy_spheres(i, made(i)%xyzr, MORULA_FRAME_BODY)
      call add(after, made(i))
      print '(a, f0.4, a, i0, a, f0.3, a, f0.2)', '  mass ', f%mass, ', ', f%sphere_count, &
        ' spheres, coverage ', f%coverage, ', time step x ', f%step_factor
    end do
    ! A solver may keep the dust; here it is only counted.
    do i = 1, dust
      call fragments%dust(i, f)
      call add(after, taken(f))
    end do
    self%particles = [self%particles(2:), made]
    call say('relative error of mass', abs(after%mass / before%mass - 1), 1e-12_wp)
    call say('of momentum', off(before%momentum, after%momentum), 1e-12_wp)
    call say('of angular momentum', off(before%angular, after%angular), 1e-11_wp)
    call say('of kinetic energy', abs(after%energy / before%energy - 1), 1e-11_wp)
    call say('deepest overlap of siblings', deepest(made), 1e-15_wp)
  contains
    subroutine say(what, error, most)
      character(*), intent(in) :: what
      real(wp), intent(in) :: error, most
      print '(2x, a, t30, es9.1)', what, error
      if (.not. error <= most) self%sound = .false.
    end subroutine say
  end subroutine actions_after_time_step

  subroutine move(p, step)
    type(particle), intent(inout) :: p
    real(wp), intent(in) :: step
    real(wp) :: force(3), torque(3), arm(3), lever(3), surface(3), w(3), half(3), deep, push, q(4)
    integer :: i
    force = [0.0_wp, 0.0_wp, -9.81_wp * p%mass]
    torque = 0
    p%force = 0
    do i = 1, size(p%xyzr, 2)
      arm = turned(p%quaternion, p%xyzr(1:3, i))
      deep = p%xyzr(4, i) - (p%position(3) + arm(3))
      if (deep <= 0) cycle
      lever = arm - [0.0_wp, 0.0_wp, p%xyzr(4, i)]
      surface = p%velocity + cross(p%spin, lever)
      push = max(0.0_wp, 1e5_wp * deep - 20 * surface(3))
      force(3) = force(3) + push
      torque = torque + cross(lever, [0.0_wp, 0.0_wp, push])
      p%force = p%force + push
    end do
    ! Euler's equations in the body frame.
    w = turned_back(p%quaternion, p%spin)
    w = w + step * (turned_back(p%quaternion, torque) - cross(w, p%principal * w)) / p%principal
    p%spin = turned(p%quaternion, w)
    p%velocity = p%velocity + step / p%mass * force
    p%position = p%position + step * p%velocity
    half = 0.5_wp * step * p%spin
    q = p%quaternion
    p%quaternion(1) = q(1) - dot_product(half, q(2:4))
    p%quaternion(2:4) = q(2:4) + q(1) * half + cross(half, q(2:4))
    p%quaternion = p%quaternion / norm2(p%quaternion)
  end subroutine move

  pure function cross(a, b) result(c)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: c(3)
    c = [a(2) * b(3) - a(3) * b(2), a(3) * b(1) - a(1) * b(3), a(1) * b(2) - a(2) * b(1)]
  end function cross

  !> q v q*
  pure function turned(q, v) result(to)
    real(wp), intent(in) :: q(4), v(3)
    real(wp) :: to(3), t(3)
    t = 2 * cross(q(2:4), v)
    to = v + q(1) * t + cross(q(2:4), t)
  end function turned

  pure function turned_back(q, v) result(to)
    real(wp), intent(in) :: q(4), v(3)
    real(wp) :: to(3)
    to = turned([q(1), -q(2:4)], v)
  end function turned_back

  subroutine add(t, p)
    type(totals), intent(inout) :: t
    type(particle), intent(in) :: p
    real(wp) :: own(3)
    own = turned(p%quaternion, p%principal * turned_back(p%quaternion, p%spin))
    t%mass = t%mass + p%mass
    t%momentum = t%momentum + p%mass * p%velocity
    t%angular = t%angular + own + p%mass * cross(p%position, p%velocity)
    t%energy = t%energy + 0.5_wp * p%mass * dot_product(p%velocity, p%velocity) &
      + 0.5_wp * dot_product(own, p%spin)
  end subroutine add

  pure function off(a, b) result(error)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: error
    error = norm2(a - b) / norm2(a)
  end function off

  function taken(f) result(p)
    type(morula_fragment), intent(in) :: f
    type(particle) :: p
    p%mass = f%mass
    p%principal = f%principal
    p%position = f%position
    p%quaternion = f%quaternion
    p%velocity = f%velocity
    p%spin = f%angular_velocity
  end function taken

  !> The deepest overlap of spheres of two particles.
  function deepest(p) result(most)
    type(particle), intent(in) :: p(:)
    real(wp) :: most, a(3), b(3)
    integer :: i, j, k, l
    most = -huge(most)
    do i = 1, size(p)
      do j = 1, i - 1
        do k = 1, size(p(i)%xyzr, 2)
          a = p(i)%position + turned(p(i)%quaternion, p(i)%xyzr(1:3, k))
          do l = 1, size(p(j)%xyzr, 2)
            b = p(j)%position + turned(p(j)%quaternion, p(j)%xyzr(1:3, l))
            most = max(most, p(i)%xyzr(4, k) + p(j)%xyzr(4, l) - norm2(a - b))
          end do
        end do
      end do
    end do
  end function deepest
end module little_solver

program fragmentation
  use, intrinsic :: iso_c_binding, only: c_double
  use morula
  use little_solver
  implicit none
  type(morula_shape_t) :: shape
  type(morula_solid_t) :: solid
  type(morula_clump_t) :: clump
  type(morula_parent_t) :: parent
  type(morula_clump_options) :: options
  type(morula_moments) :: m
  type(solver) :: s
  logical :: fine
  integer :: i, n

  call shape%create_from_primitive('stone')
  call solid%create(shape)
  call morula_init(options)
  options%spheres = 40
  options%method = MORULA_METHOD_INSCRIBED
  options%frame = MORULA_FRAME_BODY
  call clump%create(solid, options)
  call parent%create(solid, clump)

  ! The stone as this solver holds it: its spheres in the body frame, five centimetres in size.
  allocate (s%particles(1))
  call solid%moments(s%density, m)
  call clump%sphere_count(n)
  associate (stone => s%particles(1))
    stone%mass = m%mass * s%scale**3
    stone%principal = m%principal * s%scale**5
    allocate (stone%xyzr(4, n))
    call clump%copy_spheres(stone%xyzr)
    stone%xyzr = stone%xyzr * s%scale
    stone%position = [0.0_c_double, 0.0_c_double, 0.3_c_double]
    stone%velocity = [0.5_c_double, 0.0_c_double, -3.0_c_double]
    stone%spin = [4.0_c_double, -7.0_c_double, 2.0_c_double]
    s%strength = 60 * stone%mass * 9.81_c_double
  end associate
  call s%solve(parent, 20000)
  print '(a, f0.4, a, i0, a)', 't = ', s%time, ' s: ', size(s%particles), ' particles'
  fine = s%breaks == 1 .and. s%sound .and. size(s%particles) >= 4
  do i = 1, size(s%particles)
    fine = fine .and. abs(s%particles(i)%position(3)) < 1
  end do
  call parent%destroy()
  call clump%destroy()
  call solid%destroy()
  call shape%destroy()
  if (fine) then
    print '(a)', 'all is well'
  else
    print '(a)', 'NOT as it should be'
    error stop 1
  end if
end program fragmentation
