#!/usr/bin/env bash
# Tests data sets, plugins and environments with the package lerobot: installs it with torch (8 GB) into
# build/lerobot_venv, with Kinegraph unless this tree has a built module, and runs tests/lerobot. Arguments are passed to
# pytest.
set -euo pipefail
cd "$(dirname "$0")/.."
export KINEGRAPH_HEADLESS=1 HF_HUB_OFFLINE=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_QUIET=1
venv=$PWD/build/lerobot_venv
mkdir -p build
[ -x "$venv/bin/python" ] || bash tools/make_venv.sh "${PYTHON:-python3}" "$venv"
"$venv/bin/python" -m pip install lerobot==0.4.4 "pyarrow>=21" av pytest
if compgen -G "python/kinegraph/_core.*.so" >/dev/null; then
  export PYTHONPATH=$PWD/python
else
  "$venv/bin/python" -m pip install .
fi
for plugin in python/plugins/*; do
  rm -rf build/plugin && cp -r "$plugin" build/plugin  # a build leaves files in its folder
  "$venv/bin/python" -m pip install --no-deps --force-reinstall build/plugin
done
"$venv/bin/python" -m pytest -q tests/lerobot "$@"
