# The examples under valgrind: no definite leak, no read or write that is not theirs. By default the
# smallest; all of them with MORULA_VALGRIND, which takes minutes.
option(MORULA_VALGRIND "Run every example under valgrind" OFF)
find_program(valgrind valgrind)
set(c_programs minimal layout structs serial)
if(MORULA_VALGRIND)
  # Not host: valgrind has no floating-point traps and flags of its own.
  list(APPEND c_programs api bad_arguments refused cancel threads many demands masses cost sweep fragments moving
    grown reentrant limits stress)
endif()

# Undefined values are not asked for: optimised Rust reads what an Option might hold before it looks
# whether it does, and valgrind takes that for a choice made on it.
set(leaks full)
function(valgrind_test folder program)
  add_test(NAME valgrind.${program} COMMAND "${valgrind}" --quiet --leak-check=${leaks}
    --show-leak-kinds=definite --errors-for-leak-kinds=definite --undef-value-errors=no
    --error-exitcode=99
    "${work}/${folder}/${program}" ${ARGN} WORKING_DIRECTORY "${work}/${folder}")
  set_tests_properties(valgrind.${program} PROPERTIES FIXTURES_REQUIRED ${folder} TIMEOUT 1800
    LABELS valgrind)
endfunction()

if(valgrind AND NOT MORULA_SANITIZE)
  foreach(program IN LISTS c_programs)
    valgrind_test(c.shared ${program})
  endforeach()
  if(MORULA_VALGRIND)
    # Pages in memory are here what valgrind keeps, so that much is allowed; lost blocks are not.
    valgrind_test(c.shared unload "${stage}/${CMAKE_INSTALL_LIBDIR}/${shared}" 65536)
    # What the parent's other threads hold is lost to a forked child whatever one does.
    set(leaks no)
    valgrind_test(c.shared forks)
    set(leaks full)
    if(CMAKE_CXX_COMPILER)
      valgrind_test(cpp.shared cpp_driver)
      foreach(program IN ITEMS cpp_face cpp_masses cpp_cost cpp_views)
        valgrind_test(cpp.shared ${program})
      endforeach()
      valgrind_test(fragmentation.shared fragmentation_cpp)
      valgrind_test(fragmentation.shared fragmentation_c)
      valgrind_test(mercurydpm breaking_stones)
    endif()
    if(CMAKE_Fortran_COMPILER)
      foreach(program IN ITEMS minimal api masses cost fragments host)
        valgrind_test(fortran.shared fortran_${program})
      endforeach()
      valgrind_test(fragmentation.shared fragmentation_fortran)
    endif()
  endif()
elseif(NOT valgrind)
  message(STATUS "skipped: the examples under valgrind (no valgrind)")
endif()
