#!/usr/bin/env bash
# Builds the package, and installs it into a virtual environment: install.sh FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
venv=$1
export CXX="${CXX:-g++}" PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_QUIET=1
bash tools/build_venv.sh
echo "Building; the first time takes 10 to 20 minutes on two cores, without further output."
rm -rf build/wheel
PATH="$PWD/build/tools_venv/bin:$PATH" python -m pip wheel --no-build-isolation --no-deps --wheel-dir build/wheel .
"$venv/bin/python" -m pip install --force-reinstall --no-deps build/wheel/*.whl
"$venv/bin/python" -m pip install kinegraph
