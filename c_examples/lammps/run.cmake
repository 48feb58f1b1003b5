# From a mesh to a simulation on two ranks, and back: PROGRAM is clump_for_lammps, LAMMPS and MPIEXEC
# are programs, SOURCE this folder, FOLDER where it runs.
cmake_minimum_required(VERSION 3.22)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT_CONFIRM} 1)
set(ENV{OMPI_MCA_rmaps_base_oversubscribe} 1)
set(ENV{OMPI_MCA_mpi_yield_when_idle} 1)
set(ENV{OMP_NUM_THREADS} 1)
file(MAKE_DIRECTORY "${FOLDER}")
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY "${FOLDER}" RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${ARGN}: ${failed}")
  endif()
endfunction()
run("${PROGRAM}" make "${SOURCE}/elbow.obj" elbow.mol body.txt 24)
run("${MPIEXEC}" -np 2 "${LAMMPS}" -in "${SOURCE}/in.elbows" -log none)
run("${PROGRAM}" check body.txt bodies.txt atoms.txt totals.txt)

# The same without what the template's header says: LAMMPS adds mass, centre and inertia up over the
# masses, places and radii of the spheres. 24 spheres have them but for part of the inertia, 50 have all.
foreach(spheres IN ITEMS 24 50)
  run("${PROGRAM}" make "${SOURCE}/elbow.obj" elbow_${spheres}.mol body_${spheres}.txt ${spheres})
  file(READ "${FOLDER}/elbow_${spheres}.mol" bare)
  string(REGEX REPLACE "[^\n]* mass\n[^\n]* com\n[^\n]* inertia\n" "" bare "${bare}")
  if(bare MATCHES " (mass|com|inertia)\n")
    message(FATAL_ERROR "elbow_${spheres}.mol without its header is\n${bare}")
  endif()
  file(WRITE "${FOLDER}/bare.mol" "${bare}")
  run("${LAMMPS}" -in "${SOURCE}/in.elbows" -log none -var template bare.mol -var bodies bodies.txt
    -var atoms atoms.txt -var totals totals.txt)
  run("${PROGRAM}" check body_${spheres}.txt bodies.txt atoms.txt totals.txt added)
endforeach()
