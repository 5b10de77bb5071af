# Links against the symbols of an older C library, so that one binary runs on older and newer systems.
#
#   cmake -DKINEGRAPH_GLIBC=2.28 ...    (Linux; the building Python needs the package ziglang, for its list of symbols)
#
# kinegraph_use_old_glibc(target) links `target` so. The C++ library becomes part of the binary, as older systems have an
# older one. Objects are compiled as always: cmake/glibc_compatibility.cpp defines the functions that they use and that
# the old library lacks.
set(KINEGRAPH_GLIBC "" CACHE STRING "Link with the symbols of this version of the C library, such as 2.28")

if(KINEGRAPH_GLIBC)
  set(KINEGRAPH_GLIBC_STUBS "${PROJECT_BINARY_DIR}/glibc-${KINEGRAPH_GLIBC}")
  execute_process(COMMAND "${Python_EXECUTABLE}" "${PROJECT_SOURCE_DIR}/tools/release/glibc_stubs.py" "${KINEGRAPH_GLIBC}" "${KINEGRAPH_GLIBC_STUBS}" "${CMAKE_SYSTEM_PROCESSOR}"
                  COMMAND_ERROR_IS_FATAL ANY)
  add_library(kinegraph_glibc_compatibility STATIC "${PROJECT_SOURCE_DIR}/cmake/glibc_compatibility.cpp")
endif()

function(kinegraph_use_old_glibc target)
  if(KINEGRAPH_GLIBC)
    target_link_libraries(${target} PRIVATE -Wl,--whole-archive kinegraph_glibc_compatibility -Wl,--no-whole-archive)
    target_link_options(${target} PRIVATE "-L${KINEGRAPH_GLIBC_STUBS}" -static-libstdc++ -Wl,--gc-sections)
  endif()
endfunction()
