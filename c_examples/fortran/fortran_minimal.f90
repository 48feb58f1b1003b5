! A particle as 30 spheres.
program fortran_minimal
  use, intrinsic :: iso_c_binding, only: c_double
  use morula
  implicit none
  type(morula_shape_t) :: shape
  type(morula_clump_t) :: clump
  type(morula_clump_options) :: options
  type(morula_moments) :: body
  real(c_double) :: xyzr(4, 30)
  integer :: i, n

  call shape%create_from_primitive('tablet')
  call morula_init(options)
  options%spheres = 30
  call clump%create(shape, options)
  call clump%sphere_count(n)
  call clump%copy_spheres(xyzr)
  call clump%moments(1.0_c_double, body)
  do i = 1, n
    print '(4(g0, 1x))', xyzr(:, i)
  end do
  print '(a, g0)', 'mass ', body%mass
  ! As a test it fails on another number of spheres or another mass: that of a tablet in closed form.
  if (n /= 30 .or. abs(body%mass - 530.10276_c_double) > 1e-4_c_double) error stop 1
  call clump%destroy()
  call shape%destroy()
end program fortran_minimal
