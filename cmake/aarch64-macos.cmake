# Compiles for macOS on 64-bit ARM on Linux, with the compiler of the package ziglang: tools/check_macos.sh.
#
#   cmake --toolchain cmake/aarch64-macos.cmake -DKINEGRAPH_ZIG=FOLDER -DKINEGRAPH_PREFIX=WHEELS/cmeel.prefix ...
#
# FOLDER has the programs zig-c++, zig-ar and zig-ranlib, which call `python -m ziglang`.
set(CMAKE_SYSTEM_NAME Darwin)
set(CMAKE_SYSTEM_PROCESSOR arm64)
set(CMAKE_CXX_COMPILER "${KINEGRAPH_ZIG}/zig-c++")
set(CMAKE_AR "${KINEGRAPH_ZIG}/zig-ar")
set(CMAKE_RANLIB "${KINEGRAPH_ZIG}/zig-ranlib")
set(CMAKE_INSTALL_NAME_TOOL true)
set(CMAKE_OSX_SYSROOT "")
set(CMAKE_OSX_DEPLOYMENT_TARGET "")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES KINEGRAPH_ZIG)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
