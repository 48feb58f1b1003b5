! Handles are not assigned: each way stops with one clear line, before anything is freed twice.
!   fortran_assignment one | array | inside | absent | failed
program fortran_assignment
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t
  use morula
  implicit none

  !> A particle as hosts hold it: intrinsic assignment of it assigns the handle within.
  type :: particle
    real(c_double) :: position(3) = 0
    type(morula_shape_t) :: shape
  end type particle

  character(len=20) :: way
  call get_command_argument(1, way)
  select case (way)
  case ('one')
    call one()
  case ('array')
    call array()
  case ('inside')
    call inside()
  case ('absent')
    call absent()
  case ('failed')
    call failed()
  case default
    error stop 'which way?'
  end select
  print '(a)', 'done'

contains

  subroutine one()
    type(morula_shape_t) :: a, b
    call a%create_from_primitive('tablet')
    b = a
    print '(a)', 'copied'
  end subroutine one

  subroutine array()
    type(morula_shape_t) :: a(2), b(2)
    call a(2)%create_from_primitive('tablet')
    b = a
    print '(a)', 'copied'
  end subroutine array

  subroutine inside()
    type(particle) :: a, b
    call a%shape%create_from_primitive('tablet')
    b = a
    print '(a)', 'copied'
  end subroutine inside

  !> What holds no handle may be assigned, and handles in allocatable variables may be moved.
  subroutine absent()
    type(particle) :: a, b
    type(particle), allocatable :: some(:), others(:)
    type(morula_report) :: report
    integer(c_int32_t) :: status
    b = a
    allocate (some(3))
    call some(2)%shape%create_from_primitive('tablet')
    call move_alloc(some, others)
    call others(2)%shape%report(report)
    if (report%vertices == 0) error stop 'the handle was moved'
    call others(1)%shape%report(report, status)
    if (status /= MORULA_STATUS_NULL_POINTER) error stop 'there is none'
  end subroutine absent

  !> Without the optional status a failure stops, with its sentence.
  subroutine failed()
    type(morula_shape_t) :: a
    call a%create_from_primitive('cheese')
  end subroutine failed
end program fortran_assignment
