# Untried. An overlay port: vcpkg install kinegraph --overlay-ports=packaging/vcpkg
set(VCPKG_POLICY_DLLS_WITHOUT_EXPORTS enabled)
vcpkg_find_acquire_program(PYTHON3)
vcpkg_cmake_configure(
  SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../.."
  OPTIONS -DPython_EXECUTABLE=${PYTHON3} -DKINEGRAPH_BUILD_PYTHON=OFF -DKINEGRAPH_BUILD_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME kinegraph CONFIG_PATH lib/cmake/kinegraph)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${CMAKE_CURRENT_LIST_DIR}/../../LICENSE")
