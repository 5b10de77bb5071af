#!/usr/bin/env bash
# Runs clang-tidy with the checks of .clang-tidy on the sources of the library: tidy.sh [FILE_OR_FOLDER ...]
set -euo pipefail
cd "$(dirname "$0")/.."
command -v clang-tidy-16 >/dev/null || bash tools/apt_install.sh clang-tidy-16  # older ones reject ranges of libstdc++ 12
if [ ! -f build/tidy/compile_commands.json ]; then
  mkdir -p build
  cmake --preset tidy ${PYTHON:+-DPython_EXECUTABLE="$(command -v "$PYTHON")"} >build/tidy.log 2>&1 ||
    { tail -20 build/tidy.log; exit 1; }
fi
[ $# -gt 0 ] || set -- src/kinegraph
find "$@" -name '*.cpp' -print0 |
  xargs -0 -n 4 -P "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" clang-tidy-16 -p build/tidy --quiet 2>/dev/null
