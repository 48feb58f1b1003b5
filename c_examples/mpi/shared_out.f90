! Shapes shared out over ranks: rank 0 reads them, each rank makes the clumps of
! its share, rank 0 gathers and writes them. The file is the same bytes for any
! number of ranks and threads, and those of the C++ program.
!
!   mpirun -n 4 shared_out_fortran [--threads N] [--out FILE]
program shared_out
  use, intrinsic :: iso_c_binding, only: c_int8_t, c_int32_t, c_int64_t
  use mpi_f08
  use morula
  implicit none
  integer, parameter :: stones = 5
  character(9), parameter :: others(4) = [character(9) :: 'tablet', 'torus', 'capsule', 'ellipsoid']

  type :: bytes_t
    integer(c_int8_t), allocatable :: bytes(:)
  end type bytes_t

  integer :: rank, ranks, i, at, unit, owner, n
  integer(c_int32_t) :: threads
  character(4096) :: out, argument
  type(morula_shape_t) :: shape
  type(morula_clump_t) :: clump
  type(morula_clump_options) :: options
  type(morula_solid_options) :: grid
  type(bytes_t), allocatable :: parts(:)
  integer(c_int8_t), allocatable :: mine(:), made(:), item(:)
  integer, allocatable :: places(:)

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)
  threads = 1
  out = 'clumps.bin'
  do i = 1, command_argument_count() - 1, 2
    call get_command_argument(i, argument)
    if (argument == '--out') call get_command_argument(i + 1, out)
    if (argument == '--threads') then
      call get_command_argument(i + 1, argument)
      read (argument, *) threads
    end if
  end do

  ! Rank 0 makes the particles (a host reads files) and deals them out in turn.
  allocate(parts(ranks), places(ranks))
  do i = 1, ranks
    allocate(parts(i)%bytes(0))
  end do
  if (rank == 0) then
    do i = 1, stones + size(others)
      if (i <= stones) then
        call shape%create_from_primitive('stone', segments=32, seed=int(i, c_int64_t))
      else
        call shape%create_from_primitive(trim(others(i - stones)), segments=32)
      end if
      call shape%serialize(item)
      call pack_item(parts(1 + mod(i - 1, ranks))%bytes, item)
    end do
  end if
  call scatter(parts, mine)

  call morula_init(options)   ! one thread a rank unless asked otherwise
  options%spheres = 20
  options%threads = threads
  call morula_init(grid)
  grid%cells = 32
  allocate(made(0))
  at = 0
  do while (at < size(mine))
    call unpack_item(mine, at, item)
    call shape%deserialize(item)
    call clump%create(shape, options, grid)
    call clump%serialize(item)
    call pack_item(made, item)
  end do

  call gather(made, parts)
  if (rank == 0) then
    places = 0
    open (newunit=unit, file=trim(out), access='stream', form='unformatted', status='replace')
    do i = 1, stones + size(others)
      owner = 1 + mod(i - 1, ranks)
      call unpack_item(parts(owner)%bytes, places(owner), item)
      call clump%deserialize(item)
      call clump%sphere_count(n)
      print '(3(a, i0), a)', 'particle ', i - 1, ' of rank ', owner - 1, ': ', n, ' spheres'
      write (unit) int(size(item), c_int64_t), item
    end do
    close (unit)
  end if
  call clump%destroy()
  call shape%destroy()
  call MPI_Finalize()

contains

  ! Appends an item with its length before it.
  subroutine pack_item(to, item)
    integer(c_int8_t), allocatable, intent(inout) :: to(:)
    integer(c_int8_t), intent(in) :: item(:)
    to = [to, transfer(int(size(item), c_int64_t), to, 8), item]
  end subroutine pack_item

  ! Takes the item after the first `at` bytes, and moves on behind it.
  subroutine unpack_item(from, at, item)
    integer(c_int8_t), intent(in) :: from(:)
    integer, intent(inout) :: at
    integer(c_int8_t), allocatable, intent(out) :: item(:)
    integer :: n
    n = int(transfer(from(at + 1:at + 8), 0_c_int64_t))
    item = from(at + 9:at + 8 + n)
    at = at + 8 + n
  end subroutine unpack_item

  ! Rank 0 has a part for each rank; each gets its own.
  subroutine scatter(parts, mine)
    type(bytes_t), intent(in) :: parts(:)
    integer(c_int8_t), allocatable, intent(out) :: mine(:)
    integer(c_int8_t), allocatable :: all(:)
    integer :: sizes(size(parts)), starts(size(parts)), n, r
    allocate(all(0))
    do r = 1, size(parts)
      starts(r) = size(all)
      sizes(r) = size(parts(r)%bytes)
      all = [all, parts(r)%bytes]
    end do
    call MPI_Scatter(sizes, 1, MPI_INTEGER, n, 1, MPI_INTEGER, 0, MPI_COMM_WORLD)
    allocate(mine(n))
    call MPI_Scatterv(all, sizes, starts, MPI_BYTE, mine, n, MPI_BYTE, 0, MPI_COMM_WORLD)
  end subroutine scatter

  ! The part of each rank, on rank 0.
  subroutine gather(mine, parts)
    integer(c_int8_t), intent(in) :: mine(:)
    type(bytes_t), intent(inout) :: parts(:)
    integer(c_int8_t), allocatable :: all(:)
    integer :: sizes(size(parts)), starts(size(parts)), r
    sizes = 0
    call MPI_Gather(size(mine), 1, MPI_INTEGER, sizes, 1, MPI_INTEGER, 0, MPI_COMM_WORLD)
    starts(1) = 0
    do r = 2, size(parts)
      starts(r) = starts(r - 1) + sizes(r - 1)
    end do
    allocate(all(sum(sizes)))
    call MPI_Gatherv(mine, size(mine), MPI_BYTE, all, sizes, starts, MPI_BYTE, 0, MPI_COMM_WORLD)
    do r = 1, size(parts)
      parts(r)%bytes = all(starts(r) + 1:starts(r) + sizes(r))
    end do
  end subroutine gather
end program shared_out
