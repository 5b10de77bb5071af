#!/usr/bin/env bash
# Tests FrankaDriver against franky-sim: installs it into build/franka_venv (.7 GB), with Kinegraph unless this tree has a
# built module, and runs tests/franka. Arguments are passed to pytest.
set -euo pipefail
cd "$(dirname "$0")/.."
export KINEGRAPH_HEADLESS=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_QUIET=1
venv=$PWD/build/franka_venv
mkdir -p build
[ -x "$venv/bin/python" ] || bash tools/make_venv.sh "${PYTHON:-python3}" "$venv"
"$venv/bin/python" -m pip install pylibfranka==0.21.3 franky-sim==1.0.4 mujoco==4.0.0 pin==4.1.0 pytest
if compgen -G "python/kinegraph/_core.*.so" >/dev/null; then
  export PYTHONPATH=$PWD/python
else
  "$venv/bin/python" -m pip install .
fi
"$venv/bin/python" -m pytest -q tests/franka "$@"
