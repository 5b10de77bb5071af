# Makes the static library of the objects that are compiled already, installs its package, moves it, and builds an
# example with it as a project of its own does. The example says by its exit status whether it found what it looked for.
set(work "${BUILD}/static_package")
set(example 06_inverse_kinematics)
set(ENV{KINEGRAPH_HEADLESS} 1)
unset(ENV{RAI_PATH})
include("${SOURCE}/tests/run_command.cmake")

set(tools -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
    "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}")
file(REMOVE_RECURSE "${work}")
run("${CMAKE_COMMAND}" -S "${SOURCE}" -B "${work}/build" ${tools} -DBUILD_SHARED_LIBS=OFF "-DPython_EXECUTABLE=${PYTHON}"
    "-DKINEGRAPH_OBJECTS=${BUILD}/kinegraph_objects.txt")
run("${CMAKE_COMMAND}" --build "${work}/build")
run("${CMAKE_COMMAND}" --install "${work}/build" --component cpp --prefix "${work}/first")
file(REMOVE_RECURSE "${work}/build")
file(RENAME "${work}/first" "${work}/moved")
if(NOT EXISTS "${work}/moved/lib/libkinegraph.a" OR EXISTS "${work}/moved/lib/libkinegraph.so")
  message(FATAL_ERROR "the package has no static library, or a shared one, too")
endif()

run("${CMAKE_COMMAND}" -S "${SOURCE}/examples/cpp" -B "${work}/examples" ${tools} "-DCMAKE_PREFIX_PATH=${work}/moved")
run("${CMAKE_COMMAND}" --build "${work}/examples" --target ${example})
run("${work}/examples/${example}")
message(STATUS "${example}\n${output}")

include("${SOURCE}/tests/consumers/run_consumers.cmake")
run_consumers("${work}" "${work}/moved")
