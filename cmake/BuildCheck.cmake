# Writes kinegraph/build_check.h, which all public headers include. It describes how Eigen aligns and requests memory in
# this library. A program with other flags would free memory that the library has requested in another way: it does not
# compile, and the error says what to do. The library itself includes the check, too.
#
#   KINEGRAPH_CHECKS         the folder of the header, for #include <kinegraph/build_check.h>
#   KINEGRAPH_EIGEN_MALLOC   Eigen's EIGEN_MALLOC_ALREADY_ALIGNED
set(KINEGRAPH_CHECKS "${PROJECT_BINARY_DIR}/checks")
get_directory_property(options COMPILE_OPTIONS)
get_directory_property(definitions COMPILE_DEFINITIONS)
list(TRANSFORM definitions PREPEND -D)
# The flags on which Eigen's memory depends, those inside of generator expressions included.
string(REGEX MATCHALL "-(m[^ ;>]+|fsanitize=[^ ;>]+|D *EIGEN_[^ ;>]+|D *_GLIBCXX_DEBUG[^ ;>]*)"
       flags "${KINEGRAPH_USER_FLAGS} ${options} ${definitions}")
list(REMOVE_DUPLICATES flags)
string(JOIN " " KINEGRAPH_FLAGS ${flags})
file(WRITE "${KINEGRAPH_CHECKS}/memory.cpp" "#include <Eigen/Core>
#ifdef _GLIBCXX_DEBUG
#define DEBUG_LIBRARY 1
#else
#define DEBUG_LIBRARY 0
#endif
memory: EIGEN_MAX_ALIGN_BYTES EIGEN_MAX_STATIC_ALIGN_BYTES EIGEN_DEFAULT_ALIGN_BYTES EIGEN_MALLOC_ALREADY_ALIGNED, EIGEN_WORLD_VERSION EIGEN_MAJOR_VERSION EIGEN_MINOR_VERSION DEBUG_LIBRARY
")
execute_process(COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 ${flags} "-I${KINEGRAPH_EIGEN_FOLDER}" -E -P "${KINEGRAPH_CHECKS}/memory.cpp"
                OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
if(NOT text MATCHES "memory: ([0-9]+) ([0-9]+) ([0-9]+) ([01]), ([0-9]+) ([0-9]+) ([0-9]+) ([01])")
  message(FATAL_ERROR "Eigen does not say how it aligns memory:\n${text}")
endif()
set(dynamic "${CMAKE_MATCH_1}")
set(static "${CMAKE_MATCH_2}")
set(default "${CMAKE_MATCH_3}")
set(KINEGRAPH_EIGEN_MALLOC "${CMAKE_MATCH_4}")
set(world "${CMAKE_MATCH_5}")
set(major "${CMAKE_MATCH_6}")
set(eigen_version "${CMAKE_MATCH_5}.${CMAKE_MATCH_6}.${CMAKE_MATCH_7}")
set(debug "${CMAKE_MATCH_8}")
configure_file("${PROJECT_SOURCE_DIR}/cmake/build_check.h.in" "${KINEGRAPH_CHECKS}/kinegraph/build_check.h" @ONLY)
