# Installs the package, moves it, and uses it as projects of their own do: compiles every installed header alone, and
# builds and runs examples/cpp. Each example says by its exit status whether it found what it looked for.
set(work "${BUILD}/installed_package")
set(ENV{KINEGRAPH_HEADLESS} 1)
unset(ENV{RAI_PATH})

include("${SOURCE}/tests/run_command.cmake")

file(REMOVE_RECURSE "${work}/first" "${work}/moved")
run("${CMAKE_COMMAND}" --install "${BUILD}" --component cpp --prefix "${work}/first")
file(RENAME "${work}/first" "${work}/moved")

foreach(project IN ITEMS tests/installed_headers examples/cpp)
  file(REMOVE "${work}/${project}/CMakeCache.txt")
  run("${CMAKE_COMMAND}" -S "${SOURCE}/${project}" -B "${work}/${project}" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${work}/moved"
      "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}")
  run("${CMAKE_COMMAND}" --build "${work}/${project}")
endforeach()

# A program that aligns Eigen's matrices otherwise does not compile, and is told why; one that says how does.
if(PROCESSOR MATCHES "x86_64|AMD64")
  file(WRITE "${work}/wide.cpp" "#include <kinegraph/math/pose.h>\n")
  set(compile "${COMPILER}" -std=c++20 -fsyntax-only "-I${work}/moved/include" "-I${work}/moved/include/kinegraph/eigen3" "${work}/wide.cpp")
  execute_process(COMMAND ${compile} -mavx RESULT_VARIABLE status ERROR_VARIABLE output)
  if(status EQUAL 0 OR NOT output MATCHES "Eigen aligns memory otherwise here than in libkinegraph")
    message(FATAL_ERROR "with -mavx the headers compile, or say something else (${status}):\n${output}")
  endif()
  run(${compile} -mavx -DEIGEN_MAX_ALIGN_BYTES=16)
endif()

# The shared library exports what the headers declare, and nothing of the libraries that it is made with.
if(EXISTS "${work}/moved/lib/libkinegraph.so")
  run("${NM}" --dynamic --defined-only --demangle "${work}/moved/lib/libkinegraph.so")
  foreach(wanted IN ITEMS "kinegraph::Config::addFile" "kinegraph::solveIk" "typeinfo for kinegraph::ParseError")
    if(NOT output MATCHES "${wanted}")
      message(FATAL_ERROR "libkinegraph.so does not export ${wanted}")
    endif()
  endforeach()
  if(output MATCHES " [A-Za-z] (typeinfo for |vtable for )?(boost::|std::|kinegraph::BandAlgebra|kinegraph::PageConnection|kinegraph::Parser)[^\n]*")
    message(FATAL_ERROR "libkinegraph.so exports ${CMAKE_MATCH_0}")
  endif()
endif()

file(GLOB examples RELATIVE "${SOURCE}/examples/cpp" "${SOURCE}/examples/cpp/*.cpp")
foreach(example IN LISTS examples)
  get_filename_component(name "${example}" NAME_WE)
  run("${work}/examples/cpp/${name}")
  message(STATUS "${name}\n${output}")
endforeach()
