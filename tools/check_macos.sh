#!/usr/bin/env bash
# Compiles all sources of the library and of the Python module for macOS on 64-bit ARM, on Linux: `make check-macos`.
# The package ziglang has the compiler, libc++ and the headers of macOS; the other libraries come from wheels for macOS.
# Nothing is run.
set -euo pipefail
cd "$(dirname "$0")/.."
export PIP_DISABLE_PIP_VERSION_CHECK=1
work=$PWD/build/macos
environment=$work/venv
[ -x "$environment/bin/python" ] || bash tools/make_venv.sh "${PYTHON:-python3}" "$environment"
python=$environment/bin/python
"$python" -m pip install --quiet ziglang==0.17.1 "cmake>=3.25" ninja numpy "nanobind>=3.1,<4"
"$python" tools/build_requirements.py | grep -E '^(cmeel|mujoco)' > "$work/libraries.txt"
platforms=()
for version in 11 12 13 14; do platforms+=(--platform "macosx_${version}_0_arm64"); done
"$python" -m pip install --quiet --upgrade --target "$work/wheels" "${platforms[@]}" --python-version 3.11 \
  --only-binary=:all: --no-deps --requirement "$work/libraries.txt"
mkdir -p "$work/zig"
printf '#!/bin/sh\nexec "%s" -m ziglang c++ -target aarch64-macos "$@"\n' "$python" > "$work/zig/zig-c++"
for tool in ar ranlib; do
  printf '#!/bin/sh\nexec "%s" -m ziglang %s "$@"\n' "$python" "$tool" > "$work/zig/zig-$tool"
done
chmod +x "$work"/zig/*
export PATH=$environment/bin:$PATH
cmake --toolchain cmake/aarch64-macos.cmake -S . -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
  -DKINEGRAPH_ZIG="$work/zig" -DKINEGRAPH_PREFIX="$work/wheels/cmeel.prefix" -DBUILD_SHARED_LIBS=OFF \
  -DKINEGRAPH_BUILD_PYTHON=ON -DPython_EXECUTABLE="$python"
cmake --build "$work/build" --target _core
echo "all sources compile for macOS on ARM"
