! What accuracy costs in time: the list, a choice, and its clump; traps stand on invalid, zero,
! overflow.
program fortran_cost
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use morula
  implicit none
  integer :: made = 0, failed = 0

  call run()
  print '(i0, a, i0, a)', made, ' checks, ', failed, ' failed'
  if (failed /= 0) error stop 1

contains

  ! What is allocated here is freed at the end, as a main program's is not.
  subroutine run()
    type(morula_shape_t) :: shape
    type(morula_solid_t) :: solid
    type(morula_cost_t) :: list
    type(morula_sweep_t) :: sweep
    type(morula_swept), allocatable :: lists(:)
    type(morula_clump_t) :: clump
    type(morula_clump_options) :: how
    type(morula_cost_options) :: options
    type(morula_cost_bounds) :: bounds
    type(morula_cost_point), allocatable :: points(:)
    character(:), allocatable :: why
    integer(c_int64_t), target :: counts(3) = [2_c_int64_t, 6_c_int64_t, 15_c_int64_t]
    integer(c_int32_t) :: status
    integer :: n, chosen
    logical :: cut

    call shape%create_from_primitive('stone')
    call solid%create(shape)
    call morula_init(how)
    how%effort = MORULA_EFFORT_DRAFT
    call morula_init(options)
    options%counts = c_loc(counts)
    options%count = 3
    call list%create(solid, how, options)
    call list%count(n)
    call list%cut(cut)
    call list%points(points)
    call check(n == 3 .and. size(points) == 3 .and. .not. cut, 'three lines')
    call check(all(points%spheres == counts), 'the numbers of spheres')
    call check(points(3)%mismatch < points(2)%mismatch, 'D falls')
    call check(points(3)%step_cost > points(2)%step_cost, 'what a step costs rises')
    call morula_init(bounds)
    bounds%goal = MORULA_GOAL_SPHERES
    bounds%mismatch = points(2)%mismatch
    call list%choose(chosen, why, bounds)
    call check(chosen == 2 .and. index(why, 'fewest spheres') > 0, 'the choice')
    print '(a)', why
    call list%clump(chosen, clump)
    call clump%sphere_count(n)
    call check(n == 6, 'its clump')
    call list%choose(chosen, why)
    call check(chosen >= 1 .and. chosen <= 3, 'the knee')
    bounds%mismatch = 1e-9_c_double
    call list%choose(chosen, why, bounds, status)
    call check(status == MORULA_STATUS_NO_SPHERES, 'what cannot be met')
    call list%clump(4, clump, status)
    call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE, 'no such line')
    call check(c_associated(list%c_handle()), 'the handle')

    ! Two grids, two methods.
    call sweep%create(shape, [16.0_c_double, 24.0_c_double], &
      [MORULA_METHOD_BEST, MORULA_METHOD_MSS], [MORULA_EFFORT_DRAFT, MORULA_EFFORT_NORMAL], &
      options=how, cost=options)
    call sweep%count(n)
    call sweep%lists(lists)
    call check(n == 4 .and. size(lists) == 4, 'four lists')
    call check(all(lists%status == MORULA_STATUS_OK) .and. all(lists%lines == 3), 'all were made')
    call check(lists(1)%method == MORULA_METHOD_BEST .and. lists(2)%method == MORULA_METHOD_MSS, &
      'the methods')
    call check(lists(3)%resolution == 24 .and. lists(1)%cells(1) < lists(3)%cells(1), 'the grids')
    call sweep%curve(3, list)
    call list%count(n)
    call check(n == 3, 'the list of the finer grid')
    call sweep%curve(5, list, status)
    call check(status == MORULA_STATUS_INDEX_OUT_OF_RANGE, 'no such list')
    call check(c_associated(sweep%c_handle()), 'the handle of the sweep')
    call sweep%create(shape, [16.0_c_double], [MORULA_METHOD_BEST], [MORULA_EFFORT_DRAFT], &
      [-1.0_c_double], status=status)
    call check(status == MORULA_STATUS_INVALID_ARGUMENT, 'a deadline before the beginning')
    call sweep%destroy()
    call list%destroy()
    call clump%destroy()
    call solid%destroy()
    call shape%destroy()
  end subroutine run

  subroutine check(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    made = made + 1
    if (.not. condition) then
      failed = failed + 1
      write (error_unit, '(2a)') 'not so: ', what
    end if
  end subroutine check
end program fortran_cost
