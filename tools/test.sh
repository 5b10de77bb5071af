#!/usr/bin/env bash
# Everything that is tested, from a fresh clone: layers, message types, C++ (ctest), TypeScript, Python and the browser (pytest).
set -euo pipefail
cd "$(dirname "$0")/.."
export KINEGRAPH_HEADLESS=1 CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}"

bash tools/apt_install.sh libgtest-dev chromium
venv=build/test_venv
[ -x $venv/bin/python ] || bash tools/make_venv.sh "${PYTHON:-python3}" $venv
$venv/bin/python -m pip install --quiet --disable-pip-version-check "cmake>=3.25" ninja ruff
PATH="$PWD/$venv/bin:$PATH"

python tools/check_layers.py
python tools/generate_messages.py --check
ruff check --quiet .

cmake --preset dev -DPython_EXECUTABLE="$PWD/$venv/bin/python" >build/configure.log || { cat build/configure.log; exit 1; }
cmake --build --preset dev --parallel "$CMAKE_BUILD_PARALLEL_LEVEL" >build/build.log || { tail -60 build/build.log; exit 1; }
(cd build/dev/viewer_client && cp -r ../../../viewer/src . && node_modules/.bin/tsc --noEmit)
python -m pip install --quiet --disable-pip-version-check '.[test]'

ctest --test-dir build/dev --output-on-failure --no-tests=error
python -m pytest -q
