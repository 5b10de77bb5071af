# Installs the library and builds and runs examples/cpp against it, as a project of its own would.
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --component cpp --prefix "${BUILD}/installed" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}/examples/cpp" -B "${BUILD}/example" -G "${GENERATOR}" -DCMAKE_BUILD_TYPE=Release
                        "-DCMAKE_PREFIX_PATH=${BUILD}/installed" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${BUILD}/example" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${BUILD}/example/reach" "${BUILD}/installed/share/kinegraph/models" COMMAND_ERROR_IS_FATAL ANY)
