# Configures and builds SOURCE in BINARY, from nothing.
file(REMOVE_RECURSE "${BINARY}")
foreach(step IN ITEMS configure build)
  if(step STREQUAL configure)
    execute_process(COMMAND ${CMAKE_COMMAND} -S "${SOURCE}" -B "${BINARY}" -G "${GENERATOR}"
      ${OPTIONS} RESULT_VARIABLE failed)
  else()
    execute_process(COMMAND ${CMAKE_COMMAND} --build "${BINARY}" RESULT_VARIABLE failed)
  endif()
  if(failed)
    message(FATAL_ERROR "${step} of ${SOURCE} failed")
  endif()
endforeach()
