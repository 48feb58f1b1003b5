# The module for Python, where there is one with numpy.
set(python_with_numpy "")
foreach(python IN ITEMS "$ENV{MORULA_PYTHON}" python3 /usr/bin/python3 python)
  if(python AND NOT python_with_numpy)
    execute_process(COMMAND "${python}" -c "import numpy" RESULT_VARIABLE failed
      OUTPUT_QUIET ERROR_QUIET)
    if(failed EQUAL 0)
      set(python_with_numpy "${python}")
    endif()
  endif()
endforeach()
if(python_with_numpy)
  add_test(NAME python COMMAND "${python_with_numpy}" -B
    "${CMAKE_CURRENT_SOURCE_DIR}/python/test_morula.py" -v)
  set_tests_properties(python PROPERTIES FIXTURES_REQUIRED stage TIMEOUT 600 ENVIRONMENT
    "MORULA_LIBRARY=${stage}/${CMAKE_INSTALL_LIBDIR}/${shared};MORULA_INCLUDE=${stage}/${CMAKE_INSTALL_INCLUDEDIR}")
else()
  message(STATUS "skipped: the Python module (no python3 with numpy; MORULA_PYTHON names one)")
endif()
