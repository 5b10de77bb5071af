# Installs the package, moves it, and uses it as projects of their own do: compiles every installed header alone, and
# builds and runs examples/cpp. Each example says by its exit status whether it found what it looked for.
set(work "${BUILD}/installed_package")
set(ENV{KINEGRAPH_HEADLESS} 1)
unset(ENV{RAI_PATH})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${work}/first" "${work}/moved")
run("${CMAKE_COMMAND}" --install "${BUILD}" --component cpp --prefix "${work}/first")
file(RENAME "${work}/first" "${work}/moved")

foreach(project IN ITEMS tests/installed_headers examples/cpp)
  file(REMOVE "${work}/${project}/CMakeCache.txt")
  run("${CMAKE_COMMAND}" -S "${SOURCE}/${project}" -B "${work}/${project}" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${work}/moved"
      "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}")
  run("${CMAKE_COMMAND}" --build "${work}/${project}")
endforeach()

file(GLOB examples RELATIVE "${SOURCE}/examples/cpp" "${SOURCE}/examples/cpp/*.cpp")
foreach(example IN LISTS examples)
  get_filename_component(name "${example}" NAME_WE)
  run("${work}/examples/cpp/${name}")
  message(STATUS "${name}\n${output}")
endforeach()
