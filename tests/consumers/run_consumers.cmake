# Builds the programs of this folder with the package in `prefix`, runs them, and installs one. Needs run() and what the
# tests of packages get.
function(run_consumers work prefix)
  file(REMOVE_RECURSE "${work}/consumers" "${work}/installed")
  file(GLOB libraries "${prefix}/lib/kinegraph/lib/libmujoco.so.*" "${prefix}/lib/kinegraph/lib/libassimp.so.?")
  string(REPLACE ";" "\\;" libraries "${libraries}")
  run("${CMAKE_COMMAND}" -S "${SOURCE}/tests/consumers" -B "${work}/consumers" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${prefix}"
      "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}"
      "-DLIBRARIES=${libraries}" "-DCMAKE_INSTALL_PREFIX=${work}/installed")
  run("${CMAKE_COMMAND}" --build "${work}/consumers")
  run("${work}/consumers/library_memory")
  run("${CMAKE_COMMAND}" -E env ASAN_OPTIONS=detect_leaks=0 "${work}/consumers/library_memory_checked")
  run("${CMAKE_COMMAND}" -E chdir "${work}/consumers" "${work}/consumers/other_libraries")
  run("${work}/consumers/quiet")
  if(NOT output STREQUAL "quiet\n")
    message(FATAL_ERROR "the library prints:\n${output}")
  endif()

  # An installed program finds the libraries; so does one that is built without CMake.
  run("${CMAKE_COMMAND}" --install "${work}/consumers")
  run("${CMAKE_COMMAND}" -E chdir / "${work}/installed/bin/library_memory")
  find_program(PKG_CONFIG pkg-config)
  if(PKG_CONFIG)
    set(ENV{PKG_CONFIG_PATH} "${prefix}/lib/pkgconfig")
    run("${PKG_CONFIG}" --cflags --libs kinegraph)
    separate_arguments(flags UNIX_COMMAND "${output}")
    run("${COMPILER}" -std=c++20 "${SOURCE}/tests/consumers/library_memory.cpp" ${flags} -o "${work}/by_pkg_config")
    run("${CMAKE_COMMAND}" -E chdir / "${work}/by_pkg_config")
  endif()
  if(NOT EXISTS "${prefix}/share/kinegraph/licenses/mujoco.txt" OR NOT EXISTS "${prefix}/share/kinegraph/licenses/eigen.txt")
    message(FATAL_ERROR "the package has no license texts")
  endif()
endfunction()
