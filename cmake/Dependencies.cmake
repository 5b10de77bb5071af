# Finds third-party libraries, which come as wheels (the list is in pyproject.toml). `pip install` provides them on the
# path of the building Python. A plain CMake build uses those of the given Python if it has them. Otherwise it installs
# them into a virtual environment below the build folder.

function(kinegraph_find_prefix result python)
  execute_process(
    COMMAND "${python}" -c "import cmeel, pathlib; print((pathlib.Path(cmeel.__file__).parent.parent / 'cmeel.prefix').as_posix())"
    OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE status ERROR_QUIET)
  if(status EQUAL 0 AND EXISTS "${prefix}/lib/cmake/Qhull" AND EXISTS "${prefix}/include/boost/json.hpp" AND EXISTS "${prefix}/lib64/cmake/zlib" AND EXISTS "${prefix}/lib/cmake/tinyxml2" AND EXISTS "${prefix}/../mujoco/include")
    set(${result} "${prefix}" PARENT_SCOPE)
  else()
    set(${result} "" PARENT_SCOPE)
  endif()
endfunction()

set(KINEGRAPH_REQUIREMENTS_PYTHON "${Python_EXECUTABLE}")  # has the wheels, and pip
kinegraph_find_prefix(KINEGRAPH_PREFIX "${Python_EXECUTABLE}")
if(NOT KINEGRAPH_PREFIX)
  set(venv "${CMAKE_BINARY_DIR}/requirements")
  if(NOT EXISTS "${venv}/bin/python")
    message(STATUS "Installing the build requirements into ${venv}")
    execute_process(COMMAND "${Python_EXECUTABLE}" -m venv "${venv}" COMMAND_ERROR_IS_FATAL ANY)
  endif()
  execute_process(COMMAND "${venv}/bin/python" "${PROJECT_SOURCE_DIR}/tools/build_requirements.py"
                  OUTPUT_FILE "${venv}/requirements.txt" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${venv}/bin/python" -m pip install --quiet --disable-pip-version-check -r "${venv}/requirements.txt"
                  COMMAND_ERROR_IS_FATAL ANY)
  set(KINEGRAPH_REQUIREMENTS_PYTHON "${venv}/bin/python")
  kinegraph_find_prefix(KINEGRAPH_PREFIX "${venv}/bin/python")
  if(NOT KINEGRAPH_PREFIX)
    message(FATAL_ERROR "The build requirements in ${venv} are incomplete; delete that folder and configure again.")
  endif()
endif()
list(PREPEND CMAKE_PREFIX_PATH "${KINEGRAPH_PREFIX}")

find_package(Eigen3 3.4 CONFIG REQUIRED)
find_package(assimp CONFIG REQUIRED)
find_package(boost_headers CONFIG REQUIRED)  # Beast and JSON are header-only
find_package(Qhull CONFIG REQUIRED)
find_package(tinyxml2 CONFIG REQUIRED)
find_package(ZLIB CONFIG REQUIRED HINTS "${KINEGRAPH_PREFIX}/lib64/cmake/zlib")
find_package(Threads REQUIRED)

# Assimp reads mesh files and MuJoCo renders camera images. Both are large and loaded at their first use by these names
# (common/dynamic_library.h).
get_target_property(KINEGRAPH_ASSIMP_LIBRARY assimp::assimp IMPORTED_SONAME_RELEASE)

# The wheel of MuJoCo has the headers and one library, which depends on the C library only.
get_filename_component(KINEGRAPH_MUJOCO "${KINEGRAPH_PREFIX}/../mujoco" ABSOLUTE)
file(GLOB library "${KINEGRAPH_MUJOCO}/libmujoco.so.*")
add_library(mujoco::mujoco SHARED IMPORTED)
set_target_properties(mujoco::mujoco PROPERTIES IMPORTED_LOCATION "${library}"
                      INTERFACE_INCLUDE_DIRECTORIES "${KINEGRAPH_MUJOCO}/include")
get_filename_component(KINEGRAPH_MUJOCO_LIBRARY "${library}" NAME)
set(KINEGRAPH_LIBRARY_FOLDERS "${KINEGRAPH_PREFIX}/lib" "${KINEGRAPH_PREFIX}/lib64" "${KINEGRAPH_MUJOCO}")

# Installs the shared libraries of KINEGRAPH_PREFIX and MuJoCo that `target` needs into `folder`: the linked ones, and
# the loaded ones, which need no others (assimp needs zlib, which is linked).
function(kinegraph_install_libraries target folder component)
  install(CODE "set(prefix [[${KINEGRAPH_PREFIX}]])\nset(mujoco [[${KINEGRAPH_MUJOCO}]])\nset(binary [[$<TARGET_FILE:${target}>]])\nset(folder [[${folder}]])\nset(loaded [[${KINEGRAPH_PREFIX}/lib/${KINEGRAPH_ASSIMP_LIBRARY}]] [[${KINEGRAPH_MUJOCO}/${KINEGRAPH_MUJOCO_LIBRARY}]])" COMPONENT ${component})
  install(CODE [[
    file(GET_RUNTIME_DEPENDENCIES LIBRARIES "${binary}" RESOLVED_DEPENDENCIES_VAR libraries UNRESOLVED_DEPENDENCIES_VAR missing
         DIRECTORIES "${prefix}/lib" "${prefix}/lib64" "${mujoco}" PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|gcc_s|stdc\\+\\+)\\.so")
    foreach(library IN LISTS libraries loaded)
      string(FIND "${library}" "${prefix}" in_prefix)
      string(FIND "${library}" "${mujoco}" in_mujoco)
      if(in_prefix EQUAL 0 OR in_mujoco EQUAL 0)
        file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}" TYPE SHARED_LIBRARY FILES "${library}" FOLLOW_SYMLINK_CHAIN)
      endif()
    endforeach()
    if(missing)
      message(FATAL_ERROR "libraries not found: ${missing}")
    endif()
  ]] COMPONENT ${component})
endfunction()
