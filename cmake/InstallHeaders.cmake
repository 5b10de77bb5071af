# Installs the public headers (run by `cmake --install`) with a guard. The library and its programs must align Eigen's
# matrices equally; otherwise one frees memory that the other allocated differently. Needs `python`, `repository`,
# `folder` (of the headers, below the prefix), `work` and `preprocess` (a compiler command with its flags).
execute_process(COMMAND "${python}" "${repository}/tools/public_headers.py" "${repository}/src"
                OUTPUT_VARIABLE public OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" public "${public}")
foreach(header IN LISTS public)
  get_filename_component(room "${header}" DIRECTORY)
  file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}/${room}" TYPE FILE FILES "${repository}/src/${header}")
endforeach()

# The alignment of the compiled library, and its check in the header through which all others include Eigen.
file(WRITE "${work}/alignment.cpp" "#include <Eigen/Core>\nalignment: EIGEN_MAX_ALIGN_BYTES EIGEN_MAX_STATIC_ALIGN_BYTES\n")
execute_process(COMMAND ${preprocess} -E -P "${work}/alignment.cpp" OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
if(NOT text MATCHES "alignment: ([0-9]+) ([0-9]+)")
  message(FATAL_ERROR "Eigen does not say how it aligns memory:\n${text}")
endif()
set(dynamic "${CMAKE_MATCH_1}")
set(static "${CMAKE_MATCH_2}")
configure_file("${repository}/cmake/eigen_alignment.h.in" "${work}/eigen_alignment.h" @ONLY)
file(READ "${repository}/src/kinegraph/math/pose.h" pose)
string(REPLACE "#include <Eigen/Core>\n" "#include <Eigen/Core>\n#include \"kinegraph/math/eigen_alignment.h\"\n" guarded "${pose}")
if(guarded STREQUAL pose)
  message(FATAL_ERROR "kinegraph/math/pose.h does not include Eigen/Core: the guard has no place there")
endif()
file(WRITE "${work}/pose.h" "${guarded}")
file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}/kinegraph/math" TYPE FILE FILES "${work}/eigen_alignment.h" "${work}/pose.h")
