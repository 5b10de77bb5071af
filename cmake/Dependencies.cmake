# Finds third-party libraries, which come as wheels (the list is in pyproject.toml). `pip install` provides them on the
# path of the building Python. A plain CMake build uses those of the given Python if it has them. Otherwise it installs
# them into a virtual environment below the build folder. A build for another processor takes them from KINEGRAPH_PREFIX.

function(kinegraph_find_prefix result python)
  execute_process(
    COMMAND "${python}" -c "import cmeel, pathlib; print((pathlib.Path(cmeel.__file__).parent.parent / 'cmeel.prefix').as_posix())"
    OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE status ERROR_QUIET)
  if(status EQUAL 0 AND EXISTS "${prefix}/include/boost/json.hpp" AND EXISTS "${prefix}/include/eigen3"
     AND EXISTS "${prefix}/lib/cmake/Qhull" AND EXISTS "${prefix}/lib64/cmake/zlib" AND EXISTS "${prefix}/lib/cmake/tinyxml2"
     AND EXISTS "${prefix}/include/assimp" AND EXISTS "${prefix}/../mujoco/include")
    set(${result} "${prefix}" PARENT_SCOPE)
  else()
    set(${result} "" PARENT_SCOPE)
  endif()
endfunction()

set(KINEGRAPH_REQUIREMENTS_PYTHON "${Python_EXECUTABLE}")  # has the wheels, and pip
if(NOT KINEGRAPH_PREFIX)
  kinegraph_find_prefix(KINEGRAPH_PREFIX "${Python_EXECUTABLE}")
endif()
if(NOT KINEGRAPH_PREFIX)
  set(venv "${PROJECT_BINARY_DIR}/requirements")
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

# The libraries have names of their own: a project that adds this one by add_subdirectory finds its packages as before.
foreach(library qhull_r tinyxml2 z)
  find_library(KINEGRAPH_LIBRARY_${library} ${library} PATHS "${KINEGRAPH_PREFIX}/lib" "${KINEGRAPH_PREFIX}/lib64"
               NO_DEFAULT_PATH NO_CACHE REQUIRED)
  add_library(kinegraph::${library} SHARED IMPORTED GLOBAL)
  set_target_properties(kinegraph::${library} PROPERTIES IMPORTED_LOCATION "${KINEGRAPH_LIBRARY_${library}}"
                        INTERFACE_INCLUDE_DIRECTORIES "${KINEGRAPH_PREFIX}/include")
endforeach()
set(KINEGRAPH_LIBRARIES kinegraph::qhull_r kinegraph::tinyxml2 kinegraph::z)
find_package(Threads REQUIRED)
set_target_properties(Threads::Threads PROPERTIES IMPORTED_GLOBAL ON)
list(APPEND KINEGRAPH_LIBRARIES Threads::Threads ${CMAKE_DL_LIBS})

# Eigen is that of the parent project, if it has one.
if(TARGET Eigen3::Eigen)
  set(KINEGRAPH_EIGEN Eigen3::Eigen)
  get_target_property(KINEGRAPH_EIGEN_FOLDERS Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  list(GET KINEGRAPH_EIGEN_FOLDERS 0 KINEGRAPH_EIGEN_FOLDER)
else()
  set(KINEGRAPH_EIGEN kinegraph::eigen)
  set(KINEGRAPH_EIGEN_FOLDER "${KINEGRAPH_PREFIX}/include/eigen3")
  add_library(kinegraph::eigen INTERFACE IMPORTED GLOBAL)
  target_include_directories(kinegraph::eigen SYSTEM INTERFACE "${KINEGRAPH_EIGEN_FOLDER}")
endif()

# Assimp reads mesh files and MuJoCo renders camera images. Both are large and loaded at their first use by these names
# (common/dynamic_library.h). Assimp's has the first number of its version: libassimp.so.6, libassimp.6.dylib.
file(GLOB assimp RELATIVE "${KINEGRAPH_PREFIX}/lib" "${KINEGRAPH_PREFIX}/lib/libassimp.*")
list(FILTER assimp INCLUDE REGEX "assimp([.]so)?[.][0-9]+([.]dylib)?$")
list(GET assimp 0 KINEGRAPH_ASSIMP_LIBRARY)

# The wheel of MuJoCo has the headers and one library, which depends on the C library only.
get_filename_component(KINEGRAPH_MUJOCO "${KINEGRAPH_PREFIX}/../mujoco" ABSOLUTE)
file(GLOB library "${KINEGRAPH_MUJOCO}/libmujoco.so.*" "${KINEGRAPH_MUJOCO}/libmujoco.*.dylib")
add_library(mujoco::mujoco SHARED IMPORTED)
set_target_properties(mujoco::mujoco PROPERTIES IMPORTED_LOCATION "${library}"
                      INTERFACE_INCLUDE_DIRECTORIES "${KINEGRAPH_MUJOCO}/include")
get_filename_component(KINEGRAPH_MUJOCO_LIBRARY "${library}" NAME)
set(KINEGRAPH_LIBRARY_FOLDERS "${KINEGRAPH_PREFIX}/lib" "${KINEGRAPH_PREFIX}/lib64" "${KINEGRAPH_MUJOCO}")

# Installs the shared libraries of KINEGRAPH_PREFIX and MuJoCo that `target` needs into `folder`: the linked ones, and
# the loaded ones, which need no others (assimp needs zlib, which is linked).
function(kinegraph_install_libraries target folder component)
  install(CODE "set(prefix [[${KINEGRAPH_PREFIX}]])\nset(mujoco [[${KINEGRAPH_MUJOCO}]])\nset(binary [[$<TARGET_FILE:${target}>]])\nset(folder [[${folder}]])\nset(loaded [[${KINEGRAPH_PREFIX}/lib/${KINEGRAPH_ASSIMP_LIBRARY}]] [[${KINEGRAPH_MUJOCO}/${KINEGRAPH_MUJOCO_LIBRARY}]])\nset(strip [[${CMAKE_STRIP}]])" COMPONENT ${component})
  install(CODE [[
    file(GET_RUNTIME_DEPENDENCIES LIBRARIES "${binary}" RESOLVED_DEPENDENCIES_VAR libraries UNRESOLVED_DEPENDENCIES_VAR missing
         DIRECTORIES "${prefix}/lib" "${prefix}/lib64" "${mujoco}" PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|gcc_s|stdc\\+\\+)\\.so")
    foreach(library IN LISTS libraries loaded)
      string(FIND "${library}" "${prefix}" in_prefix)
      string(FIND "${library}" "${mujoco}" in_mujoco)
      if(in_prefix EQUAL 0 OR in_mujoco EQUAL 0)
        file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}" TYPE SHARED_LIBRARY FILES "${library}" FOLLOW_SYMLINK_CHAIN)
        get_filename_component(file "${library}" REALPATH)
        get_filename_component(file "${file}" NAME)
        list(APPEND installed "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${folder}/${file}")
      endif()
    endforeach()
    list(REMOVE_DUPLICATES installed)
    foreach(file IN LISTS installed)
      execute_process(COMMAND "${strip}" --strip-unneeded "${file}" COMMAND_ERROR_IS_FATAL ANY)
      # Qhull's wheel looks for libraries in a folder of the working directory; it needs none but the C library.
      if(file MATCHES "libqhull_r")
        file(RPATH_REMOVE FILE "${file}")
      endif()
    endforeach()
    if(missing)
      message(FATAL_ERROR "libraries not found: ${missing}")
    endif()
  ]] COMPONENT ${component})
endfunction()

# Installs the license texts of this library and of all software that a package contains.
function(kinegraph_install_licenses folder component)
  file(GLOB texts "${PROJECT_SOURCE_DIR}/licenses/*")
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" ${texts} DESTINATION "${folder}" COMPONENT ${component})
  file(GLOB mujoco "${KINEGRAPH_MUJOCO}/../mujoco_core-*.dist-info/licenses/LICENSE")
  if(NOT mujoco)
    message(FATAL_ERROR "The wheel of MuJoCo has no license text below ${KINEGRAPH_MUJOCO}/..")
  endif()
  get_filename_component(mujoco "${mujoco}" DIRECTORY)
  install(FILES "${mujoco}/LICENSE" RENAME mujoco.txt DESTINATION "${folder}" COMPONENT ${component})
  install(FILES "${mujoco}/LICENSES_THIRD_PARTY.md" RENAME mujoco_third_party.md DESTINATION "${folder}" COMPONENT ${component})
endfunction()
