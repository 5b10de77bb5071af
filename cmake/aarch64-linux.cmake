# Compiles for 64-bit ARM on another Linux (Debian: apt install g++-aarch64-linux-gnu). tools/release/aarch64.py uses it:
#
#   cmake --toolchain cmake/aarch64-linux.cmake -DKINEGRAPH_PREFIX=WHEELS/cmeel.prefix ...
#
# KINEGRAPH_PREFIX is the folder of libraries in wheels for ARM, as `pip install --target WHEELS --platform
# manylinux_2_28_aarch64` makes it.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
