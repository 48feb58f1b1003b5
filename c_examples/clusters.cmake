# Programs on several ranks: shapes shared out over MPI, and a simulation of LAMMPS.
find_program(mpiexec NAMES mpirun mpiexec)
find_program(mpicxx NAMES mpicxx mpic++)
find_program(mpifort NAMES mpifort mpif90)
if(CMAKE_CXX_COMPILER AND mpiexec AND mpicxx)
  # Leaks within MPI itself are not ours: these run without the sanitizers.
  set(fortran OFF)
  set(programs shared_out_cpp)
  if(CMAKE_Fortran_COMPILER AND mpifort)
    set(fortran ON)
    list(APPEND programs shared_out_fortran)
  else()
    message(STATUS "skipped: the MPI example in Fortran (no mpifort)")
  endif()
  project_test(mpi mpi mpi stage "-DCMAKE_PREFIX_PATH=${stage}"
    -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DEXAMPLE_FORTRAN=${fortran})
  add_test(NAME mpi.checksums COMMAND ${CMAKE_COMMAND} "-DPROGRAMS=${programs}"
    "-DMPIEXEC=${mpiexec}" "-DFOLDER=${work}/mpi"
    -P "${CMAKE_CURRENT_SOURCE_DIR}/mpi/checksums.cmake")
  # Ranks wait for each other at every step: with cores of their own.
  set_tests_properties(mpi.checksums PROPERTIES FIXTURES_REQUIRED mpi TIMEOUT 900 PROCESSORS 2)
else()
  message(STATUS "skipped: the MPI examples (no mpirun and mpicxx: packages openmpi-bin and libopenmpi-dev)")
endif()

find_program(lammps NAMES lmp lmp_mpi lammps)
if(lammps AND mpiexec)
  project_test(lammps lammps lammps stage "-DCMAKE_PREFIX_PATH=${stage}")
  add_test(NAME lammps.elbows COMMAND ${CMAKE_COMMAND} "-DPROGRAM=${work}/lammps/clump_for_lammps"
    "-DLAMMPS=${lammps}" "-DMPIEXEC=${mpiexec}" "-DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/lammps"
    "-DFOLDER=${work}/lammps/run" -P "${CMAKE_CURRENT_SOURCE_DIR}/lammps/run.cmake")
  set_tests_properties(lammps.elbows PROPERTIES FIXTURES_REQUIRED lammps TIMEOUT 600 PROCESSORS 2)
else()
  message(STATUS "skipped: the LAMMPS example (no lmp and mpirun: packages lammps and openmpi-bin)")
endif()
