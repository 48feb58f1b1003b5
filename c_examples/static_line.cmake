# What a program is linked to beside libmorula.a: morula.pc and the CMake package say the same, and
# all that rustc asks for. Then it is linked to that alone: nothing is left to the compiler's own list.
cmake_minimum_required(VERSION 3.22)
file(READ "${LIBDIR}/pkgconfig/morula.pc" pc)
if(NOT pc MATCHES "Libs.private: ([^\n]*)")
  message(FATAL_ERROR "morula.pc has no Libs.private")
endif()
separate_arguments(in_pc UNIX_COMMAND "${CMAKE_MATCH_1}")
list(TRANSFORM in_pc REPLACE "^-l" "")

file(READ "${LIBDIR}/cmake/morula/morulaConfig.cmake" config)
if(NOT config MATCHES "INTERFACE_LINK_LIBRARIES \"([^\"]*)\"")
  message(FATAL_ERROR "morulaConfig.cmake has no INTERFACE_LINK_LIBRARIES")
endif()
set(in_cmake "${CMAKE_MATCH_1}")
if(NOT in_pc STREQUAL in_cmake)
  message(SEND_ERROR "morula.pc says ${in_pc}, morulaConfig.cmake ${in_cmake}")
endif()
message(STATUS "beside the archive: ${in_pc}")

# Rust's own need, for any static library of this compiler.
file(MAKE_DIRECTORY "${BINARY}")
file(WRITE "${BINARY}/empty.rs" "")
execute_process(COMMAND ${RUSTC} --edition 2024 --crate-type staticlib --crate-name empty
  --print native-static-libs "${BINARY}/empty.rs" -o "${BINARY}/libempty.a"
  ERROR_VARIABLE said RESULT_VARIABLE failed)
if(failed OR NOT said MATCHES "native-static-libs: ([^\n]*)")
  message(FATAL_ERROR "rustc does not say what a static library needs: ${said}")
endif()
separate_arguments(wanted UNIX_COMMAND "${CMAKE_MATCH_1}")
list(TRANSFORM wanted REPLACE "^-l" "")
foreach(name IN LISTS wanted)
  if(NOT name IN_LIST in_pc)
    message(SEND_ERROR "rustc asks for ${name}, which is not in the list")
  endif()
endforeach()

set(libraries ${in_pc})
list(TRANSFORM libraries PREPEND "-l")
execute_process(COMMAND ${COMPILER} "${SOURCE}" -o "${BINARY}/minimal" "-I${INCLUDEDIR}"
  -nodefaultlibs "${LIBDIR}/libmorula.a" ${libraries} -lgcc RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the list does not link")
endif()
execute_process(COMMAND "${BINARY}/minimal" RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${BINARY}/minimal failed: ${failed}")
endif()
