# Installs the C++ package below a prefix, with the files for find_package(kinegraph). It contains no absolute path and
# can be moved.
#
#   include/kinegraph        the public headers, see InstallHeaders.cmake
#   include/kinegraph/eigen3 Eigen, for projects without their own
#   lib                      libkinegraph
#   lib/kinegraph/lib        its libraries
#   lib/cmake/kinegraph      kinegraphConfig.cmake
#   lib/pkgconfig            kinegraph.pc
#   share/kinegraph/models   the models
#   share/kinegraph/licenses the licenses of the library and of all that the prefix contains
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/kinegraph")
set(libraries_folder "${CMAKE_INSTALL_LIBDIR}/kinegraph/lib")

# Returns CMake code for the imported targets that an installed static library is linked with.
function(kinegraph_describe_links result)
  set(code "")
  get_target_property(links kinegraph LINK_LIBRARIES)
  foreach(link IN LISTS links)
    if(NOT TARGET "${link}" OR link MATCHES "^(Eigen3|Threads)::")
      continue()
    endif()
    get_target_property(type "${link}" TYPE)
    set(location)
    foreach(property IMPORTED_LOCATION_RELEASE IMPORTED_LOCATION_NOCONFIG IMPORTED_LOCATION)
      if(NOT location AND NOT type STREQUAL "INTERFACE_LIBRARY")
        get_target_property(location "${link}" ${property})
      endif()
    endforeach()
    if(location)
      get_filename_component(name "${location}" NAME)
      string(REGEX REPLACE "[.]so.*" ".so" name "${name}")
      string(APPEND code "kinegraph_shipped(${link} ${name})\n")
    else()
      string(APPEND code "kinegraph_shipped(${link} \"\")\n")
    endif()
  endforeach()
  set(${result} "${code}" PARENT_SCOPE)
endfunction()

get_target_property(library_type kinegraph TYPE)
set(KINEGRAPH_LINKS "")
if(library_type STREQUAL "STATIC_LIBRARY")
  find_package(Threads REQUIRED)
  kinegraph_describe_links(KINEGRAPH_LINKS)
  # An archive does not list its dependencies; this module has the same ones.
  file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/needs.cpp" "")
  add_library(kinegraph_needs MODULE "${CMAKE_CURRENT_BINARY_DIR}/needs.cpp")
  target_link_libraries(kinegraph_needs PRIVATE kinegraph)
  target_link_options(kinegraph_needs PRIVATE -Wl,--no-as-needed)
  kinegraph_install_libraries(kinegraph_needs "${libraries_folder}" cpp)
else()
  kinegraph_install_libraries(kinegraph "${libraries_folder}" cpp)
endif()

install(TARGETS kinegraph EXPORT kinegraphTargets COMPONENT cpp)
install(EXPORT kinegraphTargets NAMESPACE kinegraph:: DESTINATION "${package_folder}" COMPONENT cpp)
install(CODE "set(python [[${Python_EXECUTABLE}]])
set(repository [[${PROJECT_SOURCE_DIR}]])
set(folder [[${CMAKE_INSTALL_INCLUDEDIR}]])
set(work [[${CMAKE_CURRENT_BINARY_DIR}/install]])
set(checks [[${KINEGRAPH_CHECKS}]])" COMPONENT cpp)
install(SCRIPT "${PROJECT_SOURCE_DIR}/cmake/InstallHeaders.cmake" COMPONENT cpp)
install(DIRECTORY "${KINEGRAPH_EIGEN_FOLDER}/Eigen" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/kinegraph/eigen3" COMPONENT cpp)
kinegraph_install_licenses("${CMAKE_INSTALL_DATADIR}/kinegraph/licenses" cpp)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/models" DESTINATION "${CMAKE_INSTALL_DATADIR}/kinegraph" COMPONENT cpp)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/kinegraphConfig.cmake.in" "${CMAKE_CURRENT_BINARY_DIR}/kinegraphConfig.cmake"
                              INSTALL_DESTINATION "${package_folder}"
                              PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_DATADIR libraries_folder)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/kinegraphConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/kinegraphConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/kinegraphConfigVersion.cmake"
        DESTINATION "${package_folder}" COMPONENT cpp)

# For pkg-config. The folders are relative to the file.
file(RELATIVE_PATH prefix_of_pc "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
set(definitions "-DEIGEN_MALLOC_ALREADY_ALIGNED=${KINEGRAPH_EIGEN_MALLOC}")
set(run_path "\${libdir}")
set(needed "")
if(library_type STREQUAL "STATIC_LIBRARY")
  set(run_path "\${libdir}/kinegraph/lib")
  string(APPEND definitions " -DKINEGRAPH_MODELS=\\\"\${prefix}/${CMAKE_INSTALL_DATADIR}/kinegraph/models\\\"")
  foreach(library qhull_r tinyxml2 z)
    execute_process(COMMAND "${CMAKE_OBJDUMP}" -p "${KINEGRAPH_LIBRARY_${library}}" OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCH "SONAME +([^ \n]+)" _ "${text}")
    string(APPEND needed " -l:${CMAKE_MATCH_1}")
  endforeach()
  set(needed " -L${run_path}${needed} -pthread -ldl")
endif()
configure_file("${PROJECT_SOURCE_DIR}/cmake/kinegraph.pc.in" "${CMAKE_CURRENT_BINARY_DIR}/kinegraph.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/kinegraph.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT cpp)

# The build folder has the models in share/kinegraph/models as well: see modelPath.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/share/kinegraph")
file(CREATE_LINK "${PROJECT_SOURCE_DIR}/models" "${PROJECT_BINARY_DIR}/share/kinegraph/models" SYMBOLIC)
