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

# Flags with which a program and the library would use memory differently: one error says what to do.
file(WRITE "${work}/program.cpp" "#include <kinegraph/scene/config.h>\nint main() { return kinegraph::Config().getFrameDimension(); }\n")
set(compile "${COMPILER}" -fsyntax-only "-I${work}/moved/include" -isystem "${work}/moved/include/kinegraph/eigen3")
function(refused message)
  execute_process(COMMAND ${compile} ${ARGN} "${work}/program.cpp" RESULT_VARIABLE status ERROR_VARIABLE output)
  string(REGEX MATCHALL "error: " errors "${output}")
  list(LENGTH errors count)
  if(status EQUAL 0 OR NOT output MATCHES "${message}" OR count GREATER 2)
    message(FATAL_ERROR "with ${ARGN} the program compiles, or the compiler says something else (${count} errors):\n${output}")
  endif()
endfunction()
set(align "Eigen aligns memory otherwise in this program than in Kinegraph")
if(PROCESSOR MATCHES "x86_64|AMD64")
  refused("${align}" -std=c++20 -mavx)
  refused("${align}" -std=c++20 -march=haswell -DEIGEN_MAX_ALIGN_BYTES=16)
  refused("${align}" -std=c++20 -mavx2 -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1)
  refused("define EIGEN_MALLOC_ALREADY_ALIGNED=1" -std=c++20 -fsanitize=address)
  run(${compile} -std=c++20 -fsanitize=address -DEIGEN_MALLOC_ALREADY_ALIGNED=1 "${work}/program.cpp")
endif()
refused("${align}" -std=c++20 -DEIGEN_MAX_ALIGN_BYTES=32)
refused("compile without EIGEN_DEFAULT_TO_ROW_MAJOR" -std=c++20 -DEIGEN_DEFAULT_TO_ROW_MAJOR)
refused("_GLIBCXX_DEBUG" -std=c++20 -D_GLIBCXX_DEBUG)
refused("compile with -std=c.+20" -std=c++17)
refused("compile without -fno-exceptions" -std=c++20 -fno-exceptions)
foreach(flag IN ITEMS -std=c++20 -std=c++23 -fno-rtti -O3 -ffast-math)
  run(${compile} -std=c++20 ${flag} "${work}/program.cpp")
endforeach()
file(GLOB_RECURSE headers RELATIVE "${work}/moved/include" "${work}/moved/include/kinegraph/*.h")
list(FILTER headers EXCLUDE REGEX "/eigen3/")
foreach(header IN LISTS headers)  # whichever is included first
  file(READ "${work}/moved/include/${header}" text)
  if(NOT text MATCHES "^#pragma once\n+#include \"kinegraph/common/compiler_check.h\"" AND NOT header MATCHES "_check.h$")
    message(FATAL_ERROR "${header} does not check the compiler first")
  endif()
endforeach()

# The code of the pages.
run("${PYTHON}" "${SOURCE}/tests/consumers/pages_code.py" "${work}/pages.cpp")
run("${COMPILER}" -std=c++20 -fsyntax-only "-I${work}/moved/include" -isystem "${work}/moved/include/kinegraph/eigen3" "${work}/pages.cpp")

# Another version of Eigen, and components that do not exist.
file(MAKE_DIRECTORY "${work}/other/Eigen")
foreach(header IN ITEMS Core Geometry)
  file(WRITE "${work}/other/Eigen/${header}" "#include_next <Eigen/${header}>\n#undef EIGEN_MAJOR_VERSION\n#define EIGEN_MAJOR_VERSION 9\n")
endforeach()
refused("Kinegraph is compiled with Eigen 3.4.*use Eigen 3.4" -std=c++20 "-I${work}/other")
file(WRITE "${work}/components/CMakeLists.txt" "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\nfind_package(kinegraph REQUIRED COMPONENTS core planing)\n")
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${work}/components" -B "${work}/components/build" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${work}/moved"
                        "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" RESULT_VARIABLE status OUTPUT_VARIABLE ignored ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "kinegraph has no component 'planing'")
  message(FATAL_ERROR "the component 'planing' is accepted, or the message is another (${status}):\n${output}")
endif()

include("${SOURCE}/tests/consumers/run_consumers.cmake")
run_consumers("${work}" "${work}/moved")

# The shared library exports what the headers declare, and nothing of the libraries that it is made with.
if(EXISTS "${work}/moved/lib/libkinegraph.so")
  run("${NM}" --dynamic --defined-only --demangle "${work}/moved/lib/libkinegraph.so")
  foreach(wanted IN ITEMS "kinegraph::Config::addFile" "kinegraph::solveIk" "typeinfo for kinegraph::ParseError")
    if(NOT output MATCHES "${wanted}")
      message(FATAL_ERROR "libkinegraph.so does not export ${wanted}")
    endif()
  endforeach()
  if(output MATCHES " [A-Za-z] (typeinfo for |vtable for )?(boost::|std::|kinegraph::[a-z_]+::)[^\n]*")
    message(FATAL_ERROR "libkinegraph.so exports ${CMAKE_MATCH_0}")
  endif()
endif()

# The record of its ABI, and what an earlier release with the same minor version promised.
if(EXISTS "${work}/moved/lib/libkinegraph.so")
  set(ENV{CXX} "${COMPILER}")
  run("${PYTHON}" "${SOURCE}/tools/release/abi.py" record "${work}/moved" "${work}/abi.json")
  string(REGEX MATCH "^[0-9]+\\.[0-9]+" minor "${VERSION}")
  if(EXISTS "${SOURCE}/docs/results/abi-${minor}.json")
    run("${PYTHON}" "${SOURCE}/tools/release/abi.py" compare "${work}/moved" "${SOURCE}/docs/results/abi-${minor}.json")
  endif()
endif()

file(GLOB examples RELATIVE "${SOURCE}/examples/cpp" "${SOURCE}/examples/cpp/*.cpp")
foreach(example IN LISTS examples)
  get_filename_component(name "${example}" NAME_WE)
  run("${work}/examples/cpp/${name}")
  message(STATUS "${name}\n${output}")
endforeach()
